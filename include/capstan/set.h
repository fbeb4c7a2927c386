/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/set.h: closed convex sets in R^n, made of primitives and operations, and queries about
 * them: support function, projection, faces, normal cones, area.
 *
 * A set is an immutable expression: primitives (ball, box, strip, ..) joined by operations
 * (product, intersection, preimage, ..). Constructors copy their arrays and retain the sets that
 * they are given, so the caller releases each set that it has made, in any order. References are
 * counted atomically: threads may share a set.
 *
 * Matrices are stored row by row. Directions and points have the n components of the set. <w, x> is
 * the scalar product, or the power where w is a velocity and x a force.
 *
 * The answer to a query has three parts:
 *   - the CpsStatus: whether the call worked (an argument may be wrong, memory may be missing);
 *   - the outcome: what the mathematics says, or why there is no answer (CPS_SET_OUTCOME_LIST);
 *   - the value and its gap: the number, and a bound of its distance from the true one. `exact`
 *     says that the number comes from a closed form, with rounding errors only; docs/sets.md has a
 *     table of what is exact. */
#ifndef CAPSTAN_SET_H
#define CAPSTAN_SET_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CpsSet CpsSet;

/* Why a query has no answer: name, fixed number, sentence. Numbers are never reused. */
#define CPS_SET_OUTCOME_LIST(X)                                                                \
    X(CPS_SET_OUTCOME_ANSWERED, 0, "answered")                                                 \
    X(CPS_SET_OUTCOME_EMPTY, 1, "the set is empty")                                            \
    X(CPS_SET_OUTCOME_UNBOUNDED, 2, "the set is unbounded where the question needs a bound")   \
    X(CPS_SET_OUTCOME_NOT_ATTAINED, 3,                                                         \
      "the least upper bound is reached by no point that is near enough")                      \
    X(CPS_SET_OUTCOME_OUTSIDE, 4, "the point lies outside the set by more than the tolerance") \
    X(CPS_SET_OUTCOME_NO_ZERO, 5, "the set does not contain 0")                                \
    X(CPS_SET_OUTCOME_NOT_PLANAR, 6, "the set has a dimension other than the question is for") \
    X(CPS_SET_OUTCOME_NOT_AVAILABLE, 7, "a user's set answers its support, not this question") \
    X(CPS_SET_OUTCOME_INACCURATE, 8, "rounding errors kept the answer from the accuracy promised")

typedef enum CpsSetOutcome {
#define CPS_SET_OUTCOME_ENUM(name, number, sentence) name = number,
    CPS_SET_OUTCOME_LIST(CPS_SET_OUTCOME_ENUM)
#undef CPS_SET_OUTCOME_ENUM
} CpsSetOutcome;

CPS_API const char *cps_set_outcome_name(CpsSetOutcome outcome);
CPS_API const char *cps_set_outcome_text(CpsSetOutcome outcome);

/* ---- references ---- */

/* Add a reference to the set, and return the set. */
CPS_API CpsSet *cps_set_retain(const CpsSet *set);
/* Remove a reference; the last one frees the set. NULL is accepted. */
CPS_API void cps_set_release(CpsSet *set);

/* The dimension n of its space R^n. */
CPS_API int cps_set_space(const CpsSet *set);
/* Write the expression as text, "intersection(ball(2; 0 0; r 500), inequalities(0 1 <= 200; -0 -1
 * <= 200))", cut to `size` bytes with a final zero. Returns the length of the whole text, as
 * snprintf does. */
CPS_API size_t cps_set_text(const CpsSet *set, char *text, size_t size);

/* ---- primitives: *out is a new set, and is not changed on failure ---- */

/* The largest n, and the largest number of points or rows. */
#define CPS_SET_MAX_SPACE 4096
#define CPS_SET_MAX_ITEMS 65536

/* {point}. */
CPS_API CpsStatus cps_set_point(int n, const double *point, CpsSet **out, CpsError *err);
/* {x : |x - centre| <= radius}, radius >= 0; centre NULL means 0 (here and below). */
CPS_API CpsStatus cps_set_ball(int n, const double *centre, double radius, CpsSet **out,
                               CpsError *err);
/* {x : (x - centre)' S^-1 (x - centre) <= 1}, S symmetric positive definite (n x n): support <w,
 * centre> + sqrt(w'Sw). */
CPS_API CpsStatus cps_set_ellipsoid(int n, const double *centre, const double *shape, CpsSet **out,
                                    CpsError *err);
/* [low, high] in R; the ends may be infinite. */
CPS_API CpsStatus cps_set_interval(double low, double high, CpsSet **out, CpsError *err);
/* {x : low_i <= x_i <= high_i for every i}; bounds may be infinite. */
CPS_API CpsStatus cps_set_box(int n, const double *low, const double *high, CpsSet **out,
                              CpsError *err);
/* {x : <normal, x> <= offset}; the normal is not 0. */
CPS_API CpsStatus cps_set_half_space(int n, const double *normal, double offset, CpsSet **out,
                                     CpsError *err);
/* {x : low <= <normal, x> <= high}; the normal is not 0. */
CPS_API CpsStatus cps_set_strip(int n, const double *normal, double low, double high, CpsSet **out,
                                CpsError *err);
/* The convex hull of `count` >= 1 points (count x n). */
CPS_API CpsStatus cps_set_hull_of_points(int n, int count, const double *points, CpsSet **out,
                                         CpsError *err);
/* {x : <row_i, x> <= offset_i}, rows (count x n). The set may be empty or unbounded; the outcome of
 * a query says so. */
CPS_API CpsStatus cps_set_inequalities(int n, int count, const double *rows, const double *offsets,
                                       CpsSet **out, CpsError *err);
/* The span of `count` >= 0 vectors (count x n), which may depend on each other; {0} without any. */
CPS_API CpsStatus cps_set_subspace(int n, int count, const double *spanning, CpsSet **out,
                                   CpsError *err);
/* The convex cone of `count` >= 0 rays (count x n): all their sums with factors >= 0. */
CPS_API CpsStatus cps_set_cone_of_rays(int n, int count, const double *rays, CpsSet **out,
                                       CpsError *err);
/* The second-order cone {(F, N) : |F| <= friction N}, F of n - 1 components, N the last; n >= 2,
 * friction >= 0. */
CPS_API CpsStatus cps_set_friction_cone(int n, double friction, CpsSet **out, CpsError *err);
/* The segment between two points. */
CPS_API CpsStatus cps_set_segment(int n, const double *from, const double *to, CpsSet **out,
                                  CpsError *err);

/* A set given by its support function, which writes the maximum over x of <direction, x> to *value
 * and a point that attains it to `point`, and returns false when there is none. The set must be
 * closed, convex, bounded and not empty; the function may be called from every thread that queries
 * the set. Support and extent are answered, also within sums, images, products, translates, scales
 * and hulls, and so is what needs only these (dimension, vertices, area in the plane). All else is
 * CPS_SET_OUTCOME_NOT_AVAILABLE. */
typedef bool CpsSetSupport(void *user, int n, const double *direction, double *value,
                           double *point);
CPS_API CpsStatus cps_set_user(int n, CpsSetSupport *support, void *user, CpsSet **out,
                               CpsError *err);

/* ---- operations ---- */

/* The product A x B x ..: the components of the parts one after the other. */
CPS_API CpsStatus cps_set_product(int count, const CpsSet *const *parts, CpsSet **out,
                                  CpsError *err);
/* The points that all parts have in common. */
CPS_API CpsStatus cps_set_intersection(int count, const CpsSet *const *parts, CpsSet **out,
                                       CpsError *err);
/* {x in R^n : L x + shift in set}, L (space of set x n); shift may be NULL. */
CPS_API CpsStatus cps_set_preimage(int n, const double *map, const double *shift, const CpsSet *set,
                                   CpsSet **out, CpsError *err);
/* The closure of {L x : x in set}, L (m x space of set). */
CPS_API CpsStatus cps_set_image(int m, const double *map, const CpsSet *set, CpsSet **out,
                                CpsError *err);
/* The closure of the Minkowski sum; the sum of bounded sets is closed itself. */
CPS_API CpsStatus cps_set_sum(int count, const CpsSet *const *parts, CpsSet **out, CpsError *err);
/* {shift + x : x in set}. */
CPS_API CpsStatus cps_set_translate(const double *shift, const CpsSet *set, CpsSet **out,
                                    CpsError *err);
/* {factor x : x in set} for a finite factor; {0} for the factor 0. */
CPS_API CpsStatus cps_set_scale(double factor, const CpsSet *set, CpsSet **out, CpsError *err);
/* The closed convex hull of the union. */
CPS_API CpsStatus cps_set_hull(int count, const CpsSet *const *parts, CpsSet **out, CpsError *err);
/* {x : <x, y> <= 1 for every y in set}. */
CPS_API CpsStatus cps_set_polar(const CpsSet *set, CpsSet **out, CpsError *err);

/* ---- queries ---- */

/* An answer. Where the outcome is not CPS_SET_OUTCOME_ANSWERED only outcome and tolerance have a
 * meaning, except in cps_set_support. */
typedef struct CpsSetAnswer {
    CpsSetOutcome outcome;
    bool exact;   /* from a closed form, with rounding errors only */
    bool closure; /* the answer for the closure of a sum, image or hull that need not be closed */
    double value;
    double gap;       /* |value - true value| <= gap, in the units of value; 0 where exact */
    double tolerance; /* the angle or length by which dimensions were decided; 0 without one */
} CpsSetAnswer;

/* The support function h(w) = sup of <w, x> over the set, and a point that attains it (n, or NULL).
 * Of an empty set the value is -INFINITY. UNBOUNDED: the value is INFINITY, and the point is a ray
 * of the set with <w, ray> > 0, or = 0 where no ray leads there (a paraboloid across its axis).
 * NOT_ATTAINED: the value holds to its gap, but no point within a million times the size of the
 * data reaches it (w is normal to an asymptote); the point comes near. */
CPS_API CpsStatus cps_set_support(const CpsSet *set, const double *direction, double *point,
                                  CpsSetAnswer *answer, CpsError *err);

/* The least and largest <w, x> over the set. Without a bound the value is infinite, and its flag
 * `.._attained` is false. */
typedef struct CpsSetExtent {
    CpsSetOutcome outcome;
    bool exact, closure, low_attained, high_attained;
    double low, high, gap;
} CpsSetExtent;
CPS_API CpsStatus cps_set_extent(const CpsSet *set, const double *direction, CpsSetExtent *extent,
                                 CpsError *err);

/* The margin of a point. Outside, it is minus the distance from the set, and `separating` (n, or
 * NULL) is a unit vector with <separating, x> <= <separating, point> - distance for every x of the
 * set. Inside, it is the radius of a ball round the point that lies in the set; the largest such
 * radius is at most value + gap. In the plane, and where a closed form is known, the radius is the
 * largest one up to rounding; in more dimensions the gap may exceed the value, because the largest
 * ball is not a convex problem (docs/sets.md). */
CPS_API CpsStatus cps_set_contains(const CpsSet *set, const double *point, double *separating,
                                   CpsSetAnswer *answer, CpsError *err);

/* The nearest point of the set in the norm sqrt(d'Md), M symmetric positive definite (n x n; NULL:
 * the identity); value: the distance in that norm. */
CPS_API CpsStatus cps_set_project(const CpsSet *set, const double *point, const double *metric,
                                  double *nearest, CpsSetAnswer *answer, CpsError *err);

/* The gauge inf {t >= 0 : point in t set}, INFINITY where there is no such t. The set must contain
 * 0. */
CPS_API CpsStatus cps_set_gauge(const CpsSet *set, const double *point, CpsSetAnswer *answer,
                                CpsError *err);

/* The face {x in set : <w, x> = h(w)} as a new set; the value is h(w). The face of direction 0 is
 * the whole set.
 *
 *   tolerance  [rad] by which the direction may be wrong, up to 0.1; 0 stands for 1e-9
 *   face       out: the caller releases it; NULL where the outcome is not ANSWERED */
CPS_API CpsStatus cps_set_face(const CpsSet *set, const double *direction, double tolerance,
                               CpsSet **face, CpsSetAnswer *answer, CpsError *err);

/* The normal cone {w : <w, x - point> <= 0 for every x of the set} as a new set; the value is the
 * distance of the point from the set.
 *
 *   tolerance  [-] distance relative to the size of the set at which the point counts as being on a
 *              constraint, up to 0.1; 0 stands for 1e-9. A point outside by more is OUTSIDE
 *   cone       out: the caller releases it; NULL where the outcome is not ANSWERED */
CPS_API CpsStatus cps_set_normal_cone(const CpsSet *set, const double *point, double tolerance,
                                      CpsSet **cone, CpsSetAnswer *answer, CpsError *err);

/* Properties of a set. */
typedef struct CpsSetFacts {
    CpsSetOutcome outcome;
    bool exact;
    bool closure; /* see CpsSetAnswer */
    bool bounded;
    bool has_zero;      /* 0 is in the set */
    bool zero_interior; /* 0 is in its interior */
    bool zero_relative; /* 0 is in its relative interior */
    bool has_dimension; /* false of an empty set, and where the directions have no answer */
    int dimension;      /* of its affine hull */
    double tolerance;   /* the width that was used, as a length */
} CpsSetFacts;
/*   tolerance  [-] width, relative to the largest width, below which the set counts as flat; 0
 *              stands for 1e-7
 *   centre     (n) out: a point of the relative interior; may be NULL
 *   basis      (n x n) out: orthonormal rows, of which the first `dimension` span the directions of
 *              the affine hull; may be NULL */
CPS_API CpsStatus cps_set_facts(const CpsSet *set, double tolerance, CpsSetFacts *facts,
                                double *centre, double *basis, CpsError *err);

/* The vertices of a set of dimension 2 or less (in any R^n), counterclockwise in R^2: the ends of a
 * segment, or the corners of a planar set, which may have arcs between them. Of other sets: the
 * points of a hull of points, or the corners of a box with at most 2^16 of them; otherwise
 * CPS_SET_OUTCOME_NOT_PLANAR.
 *
 *   tolerance  [rad] least angle of the normal cone of a corner, up to 0.5; 0 stands for 1e-6
 *   points     (capacity x n) out: at most `capacity` are written
 *   count      out: how many there are */
CPS_API CpsStatus cps_set_vertices(const CpsSet *set, double tolerance, int capacity,
                                   double *points, int *count, CpsSetAnswer *answer, CpsError *err);

/* Unit generators of a cone whose pointed part has dimension 2 or less, or that was made of rays:
 * every element of the cone is a sum of them with factors >= 0. Written as vertices are. */
CPS_API CpsStatus cps_set_rays(const CpsSet *set, double tolerance, int capacity, double *rays,
                               int *count, CpsSetAnswer *answer, CpsError *err);

/* The area and perimeter of a bounded set of R^2. A segment has area 0, and twice its length as
 * perimeter; a set so flat that it counts as one has a gap for its width. */
typedef struct CpsSetMeasure {
    CpsSetOutcome outcome;
    bool exact;
    double area, perimeter;
    /* 0 where exact. Otherwise bounds of the errors from gaps of the support function and from
     * rounded corners, plus an estimate, by halving, of that of the quadrature along arcs. */
    double area_gap, perimeter_gap;
} CpsSetMeasure;
CPS_API CpsStatus cps_set_measure(const CpsSet *set, CpsSetMeasure *measure, CpsError *err);

/* ---- for other programs ---- */

/* A bounded set as a conic program, for files and for other solvers: {origin + P v : A v + b in K}.
 * K is a product of half-lines and second-order cones; A has full column rank, and the rows of each
 * cone are scaled to size one. */
typedef struct CpsSetConic {
    CpsSetOutcome outcome; /* CPS_SET_OUTCOME_EMPTY, CPS_SET_OUTCOME_UNBOUNDED (it holds a line) or
                              CPS_SET_OUTCOME_NOT_AVAILABLE: all else is 0 */
    int space, unknown_count, row_count, cone_count;
    const int *dim;           /* (cones) 1: z >= 0; d: z_1 >= |(z_2, .., z_d)| */
    const double *origin, *p; /* (space), (space x unknowns) */
    const double *a, *b;      /* (rows x unknowns), (rows) */
    void *owner;              /* of the library */
} CpsSetConic;
/* The caller clears it by cps_set_conic_clear, which accepts a zeroed one. */
CPS_API CpsStatus cps_set_conic(const CpsSet *set, CpsSetConic *conic, CpsError *err);
CPS_API void cps_set_conic_clear(CpsSetConic *conic);

#ifdef __cplusplus
}
#endif
#endif
