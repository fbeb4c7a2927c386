/* SPDX-License-Identifier: BSD-3-Clause */
/* Where what no hold keeps in place slips off planes with friction: the directions in which
 * friction cannot stop it, and the one along which its loads fall most steeply. */
#ifndef CAPSTAN_SRC_CABLE_SLOPES_H
#define CAPSTAN_SRC_CABLE_SLOPES_H

#include "cable/line.h"

/* A plane as friction on it cannot hold: whatever moves along a unit vector v with n.v >= rise, but
 * for what it takes along its tangential part. */
typedef struct CpsiSlope {
    Vec3 n;
    double rise;
    double bound; /* [N] friction on it at most, whatever the reactions; 0 if it follows them */
} CpsiSlope;

/* More planes are not examined, since all pairs of them are. */
enum { CPSI_MOST_SLOPES = 16 };

typedef struct CpsiSlopes {
    int count;
    CpsiSlope slope[CPSI_MOST_SLOPES];
} CpsiSlopes;

/* [-] The largest factor of the friction zones of a line. */
double cpsi_largest_friction_factor(const CpsiLine *line);

/* The slopes of the obstacles of a line, with friction up to `factor` times theirs: with bounds
 * that follow the reactions their rise is the sine of the friction angle, with frozen ones, or
 * without friction (factor 0), it is 0. False where an obstacle is round or has a given set, or
 * there are too many. */
bool cpsi_slopes_fill(const CpsiLine *line, double factor, bool frozen, CpsiSlopes *slopes);
/* Add the frozen bounds of the line to those of its slopes. */
void cpsi_slopes_add_bounds(const CpsiLine *line, CpsiSlopes *slopes);

/* The steepest fall of the loads `sum` along a unit vector v: their power, less what frozen bounds
 * can take. */
typedef struct CpsiFall {
    Vec3 sum, v;
    double power;
} CpsiFall;

/* Find it; a power of 0 where there is none. The best v is the point of the cone of directions that
 * leave every plane that is nearest to the sum: the sum itself, or one on the boundary of one slope
 * or of two. With frozen bounds the same directions are tried, of which none need be the best. */
void cpsi_slopes_fall(const CpsiSlopes *slopes, CpsiFall *fall);

#endif
