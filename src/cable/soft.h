/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that give (CpsObstacle.stiffness, CpsLine.bearing_width): the obstacle opposes to a
 * node that lies deeper than its surface by d the reaction R = k d, k = stiffness x width x the
 * length of line that the node stands for, and pulls at none. Friction has the bound mu R as on a
 * rigid one. Only nodes bear on it: the integral of the pressure over the line is taken by their
 * values. */
#ifndef CAPSTAN_SRC_CABLE_SOFT_H
#define CAPSTAN_SRC_CABLE_SOFT_H

#include "cable/line.h"

/* Does an obstacle of the line give? */
bool cpsi_line_has_soft(const CpsiLine *line);

/* What opposes a contact in the step under way, R = stiffness (d - rest)^+. In a step in time of a
 * span s the obstacle damps the motion along its normal by c = damping x width x length, R = (k d +
 * c d')^+, d' = (d - e)/s with the depth e >= 0 of the reference x* on ground that has moved along:
 * a spring of the stiffness k + c/s that begins at the depth rest = e (c/s)/(k + c/s). */
typedef struct CpsiSoft {
    double stiffness; /* [N/m]; 0 where the obstacle is rigid, or there is none */
    double rest;      /* [m] >= 0; 0 in a quasi-static step */
} CpsiSoft;
CpsiSoft cpsi_soft_spring(const CpsiLine *line, int c);
/* ... of a stiffness k on an obstacle, with e in `past` and s in `span`. */
CpsiSoft cpsi_soft_damp(const CpsiObstacle *obstacle, double stiffness, double span, double past);

/* [m] How deep a place lies in an obstacle. */
double cpsi_soft_depth(const CpsiObstacle *obstacle, Vec3 x);
/* Does what was at `before`, on the obstacle as it is now, and is at `now` go into it or out of it,
 * and it gives? */
bool cpsi_soft_crosses(const CpsiObstacle *obstacle, Vec3 before, Vec3 now);
/* Does node j go into or out of what gives in the step in time, whose length [s] is `length`? */
bool cpsi_soft_is_crossed(const CpsiLine *line, int j, double length);
/* [J] What the step in time has stored more in what gives below node j, 0 if that is held, and what
 * it has lost to the damping of contact c; `length` [s] is that of the step. */
double cpsi_soft_growth(const CpsiLine *line, int j, double length);
double cpsi_soft_damped(const CpsiLine *line, int c, double length);

/* [m] How much deeper than the surface slip at x is measured, in what is round: as deep as x, up to
 * half of the radius, so that it is continuous and does not count angles about the axis as ways. */
double cpsi_soft_way_depth(const CpsiObstacle *obstacle, Vec3 x);

/* [m] The least height, over an obstacle that gives and is no contact of its, of node j at the
 * position; INFINITY: there is none. */
double cpsi_soft_missed(const CpsiLine *line, int j);

/* [N] What is stored in what gives below node j, if it is not held, per length of line there;
 * `before`: before it was shifted to where it is now. */
double cpsi_soft_per_length(const CpsiLine *line, int j, bool before);

/* [J] Stored in what gives, at the position; `before`: before it was shifted to where it is now. */
double cpsi_soft_energy(const CpsiLine *line, bool before);

#endif
