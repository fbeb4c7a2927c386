/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/ground.h: measured ground, and surfaces that a program gives as a function.
 *
 * A ground is the surface z = f(x, y) through the points of a grid: bicubic in each cell, with
 * continuous slopes. It is made once, does not change, and may be shared by obstacles, scenes and
 * threads. A surface is a smooth function psi, with psi(x) >= 0 where lines may be (S90 section
 * 2 d i). Both are kinds of obstacles (scene.h). */
#ifndef CAPSTAN_GROUND_H
#define CAPSTAN_GROUND_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct CpsGround CpsGround;

enum { CPS_MAX_GROUND_COUNT = 20000, CPS_MAX_GROUND_POINTS = 100000000 };

/* The points of a grid. Begin with cps_ground_grid_default(). Coordinates are relative to the point
 * of the obstacle. */
typedef struct CpsGroundGrid {
    uint32_t cookie;
    int x_count, y_count; /* 2..CPS_MAX_GROUND_COUNT each, CPS_MAX_GROUND_POINTS together */
    const double *x, *y;  /* (x_count), (y_count) [m] increasing; they need not be equally spaced */
    const double *z;      /* (y_count, x_count) [m] upwards */
    /* (y_count, x_count) [-] >= 0, by which the obstacle's friction is multiplied, bilinear between
     * the points; NULL, the default: 1 everywhere */
    const double *friction_factor;
    /* beyond its edges the surface goes on with their slopes; false, the default: lines that leave
     * the grid are refused */
    bool extends;
} CpsGroundGrid;

CPS_API CpsGroundGrid cps_ground_grid_default(void);

/* Make a ground of the points of a grid, which are copied.
 *
 *   out   with one reference, which the caller releases; NULL on failure
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_LIMIT or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_ground_create(const CpsGroundGrid *grid, CpsGround **out, CpsError *err);
CPS_API CpsGround *cps_ground_retain(const CpsGround *ground); /* NULL is accepted */
CPS_API void cps_ground_release(CpsGround *ground);            /* NULL is accepted */

/* The grid that it was made of; the arrays belong to the ground. */
CPS_API CpsGroundGrid cps_ground_grid(const CpsGround *ground);
/* [m] The height at (x, y) [m], relative to the obstacle's point, and its slopes [-] along x and y;
 * beyond the edges as if `extends`. slope may be NULL. */
CPS_API double cps_ground_height(const CpsGround *ground, double x, double y, double slope[2]);

/* psi [of any unit] at x [m], relative to the point of the obstacle, and its gradient, which is not
 * 0 near the surface. It is differentiable with a continuous gradient, and its value depends on x
 * alone. Several threads may call it at once where the scene has threads. */
typedef double CpsSurfaceFunction(void *user, const double x[3], double gradient[3]);

typedef struct CpsSurface {
    CpsSurfaceFunction *function; /* default NULL */
    void *user;                   /* argument of the function */
    /* [m] > 0: a length over which its normal changes little, as a tenth of the smallest radius of
     * curvature; paths of held ends are examined in steps of it */
    double size;
} CpsSurface;

#ifdef __cplusplus
}
#endif
#endif
