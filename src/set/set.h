/* SPDX-License-Identifier: BSD-3-Clause */
/* The node of a set's expression, as the files of this folder use it. Nodes never change after
 * construction. */
#ifndef CAPSTAN_SRC_SET_SET_H
#define CAPSTAN_SRC_SET_SET_H

#include <stdatomic.h>

#include "base/status.h"
#include "capstan/set.h"
#include "set/conic_form.h"
#include "set/hull.h"

/* kind: the arrays of its data */
typedef enum CpsiSetKind {
    CPSI_SET_POINTS,    /* a: points (count, n): hull of points, segment, point */
    CPSI_SET_BALL,      /* a: centre (n); scalar: radius */
    CPSI_SET_ELLIPSOID, /* a: centre (n); b: shape (n, n); c: inverse of its lower Cholesky factor
                           (n, n) */
    CPSI_SET_BOX,       /* a: low (n); b: high (n) */
    CPSI_SET_INEQUALITIES, /* a: rows (count, n); b: offsets (count): half-space, strip, polyhedron
                            */
    CPSI_SET_SUBSPACE,     /* a: orthonormal rows (n, n), the first `count` span the subspace, the
                              others its normals */
    CPSI_SET_RAYS,         /* a: rays (count, n) */
    CPSI_SET_USER,
    CPSI_SET_CONIC, /* its own conic form: written by a constructor (conic_set.c), or a face or
                       cone that the solver found */
    CPSI_SET_PRODUCT,
    CPSI_SET_INTERSECTION,
    CPSI_SET_PREIMAGE, /* a: map (part's n, n); b: shift (part's n) */
    CPSI_SET_IMAGE,    /* a: map (n, part's n) */
    CPSI_SET_SUM,
    CPSI_SET_TRANSLATE, /* a: shift (n) */
    CPSI_SET_SCALE,     /* scalar: factor */
    CPSI_SET_HULL,
    CPSI_SET_POLAR /* dual: the part's form */
} CpsiSetKind;

struct CpsSet {
    atomic_int refcount;
    CpsiSetKind kind;
    int n;     /* of R^n */
    int count; /* points, rows, rays or parts */
    /* the expression may describe a set that is not closed; the node stands for its closure */
    bool closure;
    bool bounded;      /* of a conic form: it is a face of a bounded set */
    CpsSet **part;     /* (count) for operations */
    double *a, *b, *c; /* see the kind; inside the node's memory block */
    double scalar;
    CpsSetSupport *support; /* of a user's set */
    void *user;
    CpsiConicForm *form; /* conic form where every query needs it, else NULL */
    CpsiConicForm *dual;
    CpsiHull *hull; /* of points: the facets, where they are known */
    /* its parts have no common interior point; its rows are written from its form (touching.c) */
    bool touching;
};

/* A node with memory for `doubles` numbers at a; parts are retained, their array copied. */
CpsStatus cpsi_set_new(CpsiSetKind kind, int n, int count, const CpsSet *const *parts,
                       size_t doubles, CpsSet **out, CpsError *err);

/* A set from a reduced form. The form then belongs to the set, or is freed on failure. */
CpsStatus cpsi_set_from_conic_form(CpsiConicForm *form, CpsSet **out, CpsError *err);

/* Check that all `count` numbers are finite; otherwise CPS_ERR_ARGUMENT with the name of the
 * argument and the index. */
CpsStatus cpsi_set_finite(const char *name, size_t count, const double *numbers, CpsError *err);

/* Whether the set is known to be bounded from its expression; false means unknown. */
bool cpsi_set_known_bounded(const CpsSet *set);

/* Whether the expression contains a user's set. */
bool cpsi_set_has_user(const CpsSet *set);

/* A point farther away than this many sizes does not count as attained. */
#define CPSI_SET_FAR 1e6

/* A typical length of the data, > 0, the unit for relative tolerances. */
double cpsi_set_size(const CpsSet *set);
/* Whether the set is a cone by its expression, since no part of it has a length; its size is then 1
 * by convention. */
bool cpsi_set_is_cone(const CpsSet *set);

/* An array of a node's size, on the stack where it is small. */
typedef struct CpsiScratch {
    double few[64];
    double *many;
} CpsiScratch;
/* NULL when memory does not suffice */
double *cpsi_scratch_take(CpsiScratch *scratch, size_t count);
void cpsi_scratch_give(CpsiScratch *scratch);

/* ---- closed forms (closed_forms.c, closed_margin.c, ellipsoid.c): false where there is none for
 * this expression ---- */

/* For primitives. point may be NULL; where the value is INFINITY it is a ray. */
bool cpsi_closed_support(const CpsSet *set, const double *w, double *point, double *value);
/* The radius of the largest ball round p inside the set, or minus the distance of p and the unit
 * separating direction (may be NULL). */
bool cpsi_closed_margin(const CpsSet *set, const double *p, double *separating, double *margin);
/* Nearest point in the Euclidean norm. */
bool cpsi_closed_project(const CpsSet *set, const double *p, double *nearest);
/* The point of an ellipsoid's boundary that is nearest to p, and whether p is inside. */
bool cpsi_ellipsoid_nearest(const CpsSet *set, const double *p, double *nearest, double *distance,
                            bool *inside);
/* For a set that contains 0. */
bool cpsi_closed_gauge(const CpsSet *set, const double *p, double *value);

/* ---- queries without the checks of the public calls ---- */

/* Check the arguments of a query: a set, finite numbers, and memory for the answer. */
CpsStatus cpsi_set_check(const CpsSet *set, const char *name, const double *numbers,
                         const void *answer, CpsError *err);
/* The position of 0, as far as the expression shows it (zero.c). */
typedef enum CpsiZero { CPSI_ZERO_UNKNOWN, CPSI_ZERO_INSIDE, CPSI_ZERO_RELATIVE } CpsiZero;
CpsStatus cpsi_set_locate_zero(const CpsSet *set, CpsiZero *known, CpsError *err);
CpsStatus cpsi_support(const CpsSet *set, const double *w, double *point, CpsSetAnswer *answer,
                       CpsError *err);
/* Is the support function a formula in every direction, which allocates nothing? */
bool cpsi_support_is_closed(const CpsSet *set);
/* back = L'w for an image by L; components that are the rounding of cancelled terms are set to 0,
 * so that they do not become infinite with an unbounded part. */
void cpsi_pull_back(const CpsSet *image, const double *w, double *back);
/* The largest t with p + t d in the set (INFINITY if every t is), for p in the set. */
CpsStatus cpsi_reach(const CpsSet *set, const double *p, const double *d, CpsSetAnswer *answer,
                     CpsError *err);
CpsStatus cpsi_gauge(const CpsSet *set, const double *p, CpsSetAnswer *answer, CpsError *err);
/* The normal cone at p of a sum of many balls and their images, where formulas exist; *known is
 * false where they do not (smooth_sum.c). */
CpsStatus cpsi_smooth_sum_cone(const CpsSet *set, const double *p, double share, bool *known,
                               CpsSet **cone, CpsSetAnswer *answer, CpsError *err);
/* The recession cone of a set without users' parts. */
CpsStatus cpsi_set_recession(const CpsSet *set, CpsSet **out, CpsError *err);
/* The form of a set: its own, or one made for the caller, who frees *made. */
CpsStatus cpsi_set_conic_form(const CpsSet *set, const CpsiConicForm **form, CpsiConicForm **made,
                              CpsError *err);

#endif
