/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/set.h: closed convex sets in R^n as expressions, and questions answered with sets and
 * certificates.
 *
 * A set is an immutable expression: primitives (ball, box, strip, ...) joined by operations
 * (product, intersection, preimage, ...). Constructors copy their arrays and keep their own hold on
 * the sets they are given, so the caller releases each set that it made, in any order. Holds are
 * counted atomically: a set may be shared between threads.
 *
 * Matrices are row-major. Directions and points have the set's n components. <w, x> is the dual
 * pairing.
 *
 * Every question separates three things:
 *   - the CpsStatus: whether the call worked (an argument may be wrong, memory may be missing);
 *   - the outcome: what the mathematics says, or the reason why there is no answer
 *     (CPS_SET_OUTCOME_LIST);
 *   - the value and its gap: the number asked for, and a bound on its distance from the true one.
 *     `exact` says that the number is a closed form, with rounding errors only. docs/sets.md has a
 *     table of what is exact. */
#ifndef CAPSTAN_SET_H
#define CAPSTAN_SET_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CpsSet CpsSet;

/* Why a question has no answer. One list: name, fixed number, sentence. Numbers are never
 * reused. */
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

/* ---- holds ---- */

/* One more hold on the set; returns it. */
CPS_API CpsSet *cps_set_retain(const CpsSet *set);
/* Let go; NULL is accepted. The last hold frees the set. */
CPS_API void cps_set_release(CpsSet *set);

/* n of R^n. */
CPS_API int cps_set_space(const CpsSet *set);
/* The expression as text, "intersection(ball(2; 0 0; r 500), inequalities(0 1 <= 200; -0 -1 <=
 * 200))", cut to `size` with a final zero; returns the length that the whole text has, as snprintf
 * does. */
CPS_API size_t cps_set_text(const CpsSet *set, char *text, size_t size);

/* ---- primitives: *out is a new set, or untouched on failure ---- */

/* Limits on n and on the number of points or rows, so that no size overflows. */
#define CPS_SET_MAX_SPACE 4096
#define CPS_SET_MAX_ITEMS 65536

CPS_API CpsStatus cps_set_point(int n, const double *point, CpsSet **out, CpsError *err);
/* {x : |x - centre| <= radius}, radius >= 0; centre NULL means 0 (here and below). */
CPS_API CpsStatus cps_set_ball(int n, const double *centre, double radius, CpsSet **out,
                               CpsError *err);
/* {x : (x - centre)' S^-1 (x - centre) <= 1}, S symmetric positive definite (n x n): support <w,
 * centre> + sqrt(w'Sw). */
CPS_API CpsStatus cps_set_ellipsoid(int n, const double *centre, const double *shape, CpsSet **out,
                                    CpsError *err);
/* [low, high] in R; ends may be infinite. */
CPS_API CpsStatus cps_set_interval(double low, double high, CpsSet **out, CpsError *err);
/* low <= x <= high component by component; -INFINITY and INFINITY allowed. */
CPS_API CpsStatus cps_set_box(int n, const double *low, const double *high, CpsSet **out,
                              CpsError *err);
/* {x : <normal, x> <= offset}, normal not 0. */
CPS_API CpsStatus cps_set_half_space(int n, const double *normal, double offset, CpsSet **out,
                                     CpsError *err);
/* {x : low <= <normal, x> <= high}, normal not 0. */
CPS_API CpsStatus cps_set_strip(int n, const double *normal, double low, double high, CpsSet **out,
                                CpsError *err);
/* Convex hull of `count` >= 1 points (count x n). */
CPS_API CpsStatus cps_set_hull_of_points(int n, int count, const double *points, CpsSet **out,
                                         CpsError *err);
/* {x : <row_i, x> <= offset_i}, rows (count x n); may turn out empty or unbounded, which the
 * questions tell. */
CPS_API CpsStatus cps_set_inequalities(int n, int count, const double *rows, const double *offsets,
                                       CpsSet **out, CpsError *err);
/* The span of `count` >= 0 vectors (count x n); none gives {0}. They need not be independent. */
CPS_API CpsStatus cps_set_subspace(int n, int count, const double *spanning, CpsSet **out,
                                   CpsError *err);
/* The convex cone of `count` >= 0 rays (count x n): all their sums with factors >= 0. */
CPS_API CpsStatus cps_set_cone_of_rays(int n, int count, const double *rays, CpsSet **out,
                                       CpsError *err);
/* The second-order cone {(F, N) : |F| <= friction N}, F of n - 1 components, N the last; n >= 2,
 * friction >= 0. */
CPS_API CpsStatus cps_set_friction_cone(int n, double friction, CpsSet **out, CpsError *err);
CPS_API CpsStatus cps_set_segment(int n, const double *from, const double *to, CpsSet **out,
                                  CpsError *err);

/* A set known by its support function: write max over x of <direction, x> to *value and a point
 * that attains it to `point`; return false when there is none. The set must be closed, convex,
 * bounded and not empty, and the function fit for every thread that asks. It answers support and
 * extent, also inside sums, images, products, translates, scales and hulls, and what only needs
 * these (dimension, vertices, area of the plane); everything else is CPS_SET_OUTCOME_NOT_AVAILABLE.
 */
typedef bool CpsSetSupport(void *user, int n, const double *direction, double *value,
                           double *point);
CPS_API CpsStatus cps_set_user(int n, CpsSetSupport *support, void *user, CpsSet **out,
                               CpsError *err);

/* ---- operations ---- */

/* A x B x ... : the components of the parts one after the other. */
CPS_API CpsStatus cps_set_product(int count, const CpsSet *const *parts, CpsSet **out,
                                  CpsError *err);
CPS_API CpsStatus cps_set_intersection(int count, const CpsSet *const *parts, CpsSet **out,
                                       CpsError *err);
/* {x in R^n : L x + shift in set}, L (space of set x n); shift may be NULL. */
CPS_API CpsStatus cps_set_preimage(int n, const double *map, const double *shift, const CpsSet *set,
                                   CpsSet **out, CpsError *err);
/* The closure of {L x : x in set}, L (m x space of set). */
CPS_API CpsStatus cps_set_image(int m, const double *map, const CpsSet *set, CpsSet **out,
                                CpsError *err);
/* The closure of the Minkowski sum; every sum of bounded sets is closed already. */
CPS_API CpsStatus cps_set_sum(int count, const CpsSet *const *parts, CpsSet **out, CpsError *err);
CPS_API CpsStatus cps_set_translate(const double *shift, const CpsSet *set, CpsSet **out,
                                    CpsError *err);
/* {factor x : x in set}, any finite factor; 0 gives {0}. */
CPS_API CpsStatus cps_set_scale(double factor, const CpsSet *set, CpsSet **out, CpsError *err);
/* The closed convex hull of the union. */
CPS_API CpsStatus cps_set_hull(int count, const CpsSet *const *parts, CpsSet **out, CpsError *err);
/* {x : <x, y> <= 1 for every y in set}. */
CPS_API CpsStatus cps_set_polar(const CpsSet *set, CpsSet **out, CpsError *err);

/* ---- questions ---- */

/* An answer. Only outcome and tolerance mean something where the outcome is not
 * CPS_SET_OUTCOME_ANSWERED (but see support). */
typedef struct CpsSetAnswer {
    CpsSetOutcome outcome;
    bool exact;   /* by a closed form: wrong by rounding only */
    bool closure; /* a sum, image or hull of unbounded sets need not be closed: that of its closure
                   */
    double value;
    double gap;       /* |value - true value| <= gap, in the units of value; 0 where exact */
    double tolerance; /* the angle or length that decided between dimensions, 0 where none did */
} CpsSetAnswer;

/* h(w) = sup over the set of <w, x>, and a point that attains it (n, or NULL). Empty: value
 * -INFINITY. Unbounded: value INFINITY and the point is a ray of the set with <w, ray> > 0, or = 0
 * where no ray leads there (a paraboloid across its axis). Not attained: the value holds to its
 * gap, and no point within a million times the size of the data reaches it (w along the normal of
 * an asymptote); the point is one that comes near. */
CPS_API CpsStatus cps_set_support(const CpsSet *set, const double *direction, double *point,
                                  CpsSetAnswer *answer, CpsError *err);

/* Least and largest <w, x> over the set; an end that is not there is infinite and its
 * `..._attained` false. */
typedef struct CpsSetExtent {
    CpsSetOutcome outcome;
    bool exact, closure, low_attained, high_attained;
    double low, high, gap;
} CpsSetExtent;
CPS_API CpsStatus cps_set_extent(const CpsSet *set, const double *direction, CpsSetExtent *extent,
                                 CpsError *err);

/* Margin of a point: minus its distance from the set where it lies outside, with the unit
 * `separating` direction (n, or NULL): <separating, x> <= <separating, point> - distance for every
 * x of the set. Inside: the radius of a ball round the point that is certain to fit; the largest
 * one is not larger than value + gap. In the plane, and where a closed form is known, that is the
 * largest one to rounding; in more dimensions the gap may be as large as the value and more,
 * because the largest ball is no convex problem (docs/sets.md). */
CPS_API CpsStatus cps_set_contains(const CpsSet *set, const double *point, double *separating,
                                   CpsSetAnswer *answer, CpsError *err);

/* The nearest point of the set in the norm sqrt(d'Md), M symmetric positive definite (n x n; NULL:
 * the identity); value: the distance in that norm. */
CPS_API CpsStatus cps_set_project(const CpsSet *set, const double *point, const double *metric,
                                  double *nearest, CpsSetAnswer *answer, CpsError *err);

/* inf {t >= 0 : point in t set}, INFINITY where there is no such t; the set must contain 0. */
CPS_API CpsStatus cps_set_gauge(const CpsSet *set, const double *point, CpsSetAnswer *answer,
                                CpsError *err);

/* The face {x in set : <w, x> = h(w)} as a set of its own; value: h(w). The direction 0 exposes the
 * whole set. `tolerance`: an angle in radians by which the direction may be off, > 0 (1e-9 is a
 * good one); 0 picks 1e-9. *face is a new set, or NULL where the outcome is not
 * CPS_SET_OUTCOME_ANSWERED. */
CPS_API CpsStatus cps_set_face(const CpsSet *set, const double *direction, double tolerance,
                               CpsSet **face, CpsSetAnswer *answer, CpsError *err);

/* The normal cone {w : <w, x - point> <= 0 for every x of the set} as a set; value: the distance of
 * the point from the set. `tolerance`: relative to the size of the set, how far from a constraint
 * the point still touches it; 0 picks 1e-9. A point outside by more is CPS_SET_OUTCOME_OUTSIDE.
 * *cone is a new set or NULL. */
CPS_API CpsStatus cps_set_normal_cone(const CpsSet *set, const double *point, double tolerance,
                                      CpsSet **cone, CpsSetAnswer *answer, CpsError *err);

/* What a set is like. `tolerance`: width below which the set counts as flat, relative to its
 * largest width; 0 picks 1e-7. */
typedef struct CpsSetFacts {
    CpsSetOutcome outcome; /* CPS_SET_OUTCOME_EMPTY: dimension -1 */
    bool exact;
    bool closure; /* see CpsSetAnswer */
    bool bounded;
    bool has_zero;      /* 0 in the set */
    bool zero_interior; /* ... in its interior */
    bool zero_relative; /* ... in its relative interior */
    int dimension;      /* of its affine hull */
    double tolerance;   /* the width used, a length */
} CpsSetFacts;
/* Also a point of the relative interior (n, or NULL) and, in its first `dimension` rows, an
 * orthonormal basis of the directions of the affine hull, completed to one of R^n (n x n, or
 * NULL). */
CPS_API CpsStatus cps_set_facts(const CpsSet *set, double tolerance, CpsSetFacts *facts,
                                double *centre, double *basis, CpsError *err);

/* The extreme points of a set of dimension <= 2 (in any R^n), counterclockwise in the plane R^2:
 * the ends of a segment, the corners of a planar set, which may have arcs between them; points
 * whose normal cone has full dimension. Other sets: the points of a hull of points or a box with at
 * most 2^16 corners, else CPS_SET_OUTCOME_NOT_PLANAR. At most `capacity` are written to points
 * (capacity x n); *count is how many there are. `tolerance`: the least angle [rad] by which the
 * normal cone of a corner opens, up to 0.5; 0 picks 1e-6. */
CPS_API CpsStatus cps_set_vertices(const CpsSet *set, double tolerance, int capacity,
                                   double *points, int *count, CpsSetAnswer *answer, CpsError *err);

/* Unit generators of a cone whose pointed part has dimension <= 2, or that was made of rays: every
 * element is a sum of them with factors >= 0. At most `capacity` are written (capacity x n); *count
 * is how many there are. */
CPS_API CpsStatus cps_set_rays(const CpsSet *set, double tolerance, int capacity, double *rays,
                               int *count, CpsSetAnswer *answer, CpsError *err);

/* Area and perimeter of a bounded set of R^2 (a segment has area 0 and twice its length as
 * perimeter; what is so flat that it counts as one has a gap for its width). */
typedef struct CpsSetMeasure {
    CpsSetOutcome outcome;
    bool exact;
    double area, perimeter;
    /* 0 where exact. Else what the supports' gaps, corners that were not quite points and
     * quadrature along arcs leave: bounds, but for the quadrature, which is judged by halving. */
    double area_gap, perimeter_gap;
} CpsSetMeasure;
CPS_API CpsStatus cps_set_measure(const CpsSet *set, CpsSetMeasure *measure, CpsError *err);

/* ---- for other programs ---- */

/* A bounded set as a conic program, for files and for other solvers: {origin + P v : A v + b in K},
 * K a product of half-lines and second-order cones, A of full column rank with each cone's rows of
 * size one. */
typedef struct CpsSetConic {
    CpsSetOutcome outcome; /* CPS_SET_OUTCOME_EMPTY, CPS_SET_OUTCOME_UNBOUNDED (it holds a line) or
                              CPS_SET_OUTCOME_NOT_AVAILABLE: all else is 0 */
    int space, unknown_count, row_count, cone_count;
    const int *dim;           /* (cones) 1: z >= 0; d: z_1 >= |(z_2, .., z_d)| */
    const double *origin, *p; /* (space), (space x unknowns) */
    const double *a, *b;      /* (rows x unknowns), (rows) */
    void *owner;
} CpsSetConic;
CPS_API CpsStatus cps_set_conic(const CpsSet *set, CpsSetConic *conic, CpsError *err);
CPS_API void cps_set_conic_free(CpsSetConic *conic); /* a zeroed one is accepted */

#ifdef __cplusplus
}
#endif
#endif
