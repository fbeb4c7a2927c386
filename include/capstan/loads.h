/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/loads.h: what acts on a line beside its weight and what it touches: springs to the
 * ground, given forces, the drag of the water, and a potential that a program gives as a function.
 *
 *     CpsSpring bed = {.from = 0, .to = 40, .stiffness = {200, 200, 0}, .at_start = true};
 *     CpsLineLoads loads = {.spring_count = 1, .spring = &bed};
 *     line.loads = &loads;
 *
 * These are plain structs like those of scene.h, as whose part they are given. */
#ifndef CAPSTAN_LOADS_H
#define CAPSTAN_LOADS_H

#include <stdbool.h>

#include "capstan/base.h"
#include "capstan/waves.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Springs from a piece of a line to the ground, or a quadratic field that it is in: the energy (x -
 * a)'K (x - a)/2 per metre of line (S90 annexes, U), K symmetric and nowhere negative, a the place
 * of the spring or the centre of the field. */
typedef struct CpsSpring {
    double from, to;     /* [m] unstretched length from end A, 0 <= from <= to <= length */
    double stiffness[3]; /* [N/m2] >= 0, per metre of line, along x, y and z; where from = to [N/m]
                            of one spring at the node nearest to it */
    bool at_start;       /* a is where each node is at the start, which must be a shape; else */
    double place[3];     /* [m] a, the same for all: a field towards a place */
    double coupling[3];  /* [N/m2] likewise, of x and y, x and z, y and z; default 0 */
} CpsSpring;

/* A force that does not depend on the place. */
typedef struct CpsLineForce {
    double from, to; /* [m] as of a spring, from < to */
    double force[3]; /* [N/m] per metre of unstretched line */
} CpsLineForce;

/* A load of a program's own: force [N/m] per metre of unstretched line at the abscissa s [m] from
 * end A, at the time [s] since the history began, after the step. A node has that at its abscissa
 * times the length that it stands for. */
typedef void CpsLineForceFunction(void *user, double time, double s, double force[3]);

/* The force of the water of a current on a line, per metre of unstretched line (Morison):
 *
 *     (rho/2) d (normal |u_n| u_n + pi tangential |u_t| u_t),
 *
 * u_n and u_t the velocity of the water across and along the line where the line comes to be. In
 * time (motion.h) they are those relative to the line, and with a its acceleration
 *
 *     -rho (pi/4) d^2 (added_normal a_n + added_tangential a_t)
 *
 * acts beside it: water that is moved along. This is not to be counted in `inertia` as well. In
 * waves (waves.h) a is the acceleration of the line less that of the water, and with b that of the
 * water rho (pi/4) d^2 b acts as well (Froude and Krylov), all of it: the tension is the effective
 * one, with the pressure of the water in it, as the submerged weight has it. */
typedef struct CpsDrag {
    double diameter;                       /* [m] >= 0, default 0: no drag */
    double normal, tangential;             /* [-] >= 0 */
    double added_normal, added_tangential; /* [-] >= 0, default 0; in time only */
} CpsDrag;

/* A potential U(x) of a program's own (S90 annexes, U): energy [J/m] per metre of unstretched line
 * at x [m] in the axes of the scene, its gradient [N/m] and its second derivatives [N/m2] xx, xy,
 * yy, xz, yz, zz. The force on the line is minus the gradient. U is convex and twice
 * differentiable, and depends on x alone. Several threads may call it at once where the scene has
 * threads. */
typedef double CpsPotentialFunction(void *user, const double x[3], double gradient[3],
                                    double second[6]);

typedef struct CpsPotential {
    CpsPotentialFunction *function; /* default NULL: none */
    void *user;                     /* argument of the function */
    double from, to;                /* [m] as of a spring, from < to */
} CpsPotential;

/* Of a line; all is 0 in a struct that is initialised so. */
typedef struct CpsLineLoads {
    int spring_count;
    const CpsSpring *spring; /* (spring_count) they add up where they overlap */
    int force_count;
    const CpsLineForce *force; /* (force_count) the same */
    CpsDrag drag;
    /* of a line that is elastic, or whose ends are not at points; the elements add up U at their
     * nodes by half of their lengths */
    CpsPotential potential;
    CpsLineForceFunction *force_function; /* default NULL: none */
    void *force_user;                     /* its first argument */
} CpsLineLoads;

typedef struct CpsCurrentRow {
    double z;           /* [m] height */
    double velocity[3]; /* [m/s] of the water there */
} CpsCurrentRow;

/* The motion of the water that a program gives: velocity [m/s] and acceleration [m/s2] in the place
 * x [m], in the axes of the scene, at the time [s] since the history began, after the step; both
 * are 0 before the call. It gives the same whenever it is asked for the same, and several threads
 * may call it at once where the scene has threads. */
typedef void CpsWaterFunction(void *user, double time, const double x[3], double velocity[3],
                              double acceleration[3]);

/* A steady current; in still water one row of velocity 0. Between rows it is interpolated, below
 * the first and above the last one it is as there. */
typedef struct CpsCurrent {
    double density;           /* [kg/m3] > 0 of the water */
    int row_count;            /* >= 1 */
    const CpsCurrentRow *row; /* (row_count) with z that rises from row to row */
    const CpsWaves *waves;    /* beside it, in time (waves.h); NULL, the default: none */
    /* beside both, on lines and members of bodies in steps in time; it does not lift the surface up
     * to which members are wet; default NULL: none */
    CpsWaterFunction *function;
    void *user; /* its first argument */
} CpsCurrent;

/* The potential of a line after the last step. The arrays are valid until the evolution changes. */
typedef struct CpsPotentialView {
    bool is_there; /* otherwise all else is 0 */
    int node_count;
    const double *energy; /* (node_count) [J] of each node */
    const double *force;  /* (node_count, 3) [N] on it; part of node_load (step.h) */
    double total;         /* [J] */
} CpsPotentialView;

struct CpsEvolution;
/* The motion of the water in the middle of each element of a line with drag where it is after the
 * last step, a step in time: of current, waves and function, (element_count, 3) each, which the
 * caller has. 0 of other lines and steps. */
CPS_API void cps_evolution_water(const struct CpsEvolution *evolution, int line, double *velocity,
                                 double *acceleration);
CPS_API CpsPotentialView cps_evolution_potential(const struct CpsEvolution *evolution, int line);

#ifdef __cplusplus
}
#endif
#endif
