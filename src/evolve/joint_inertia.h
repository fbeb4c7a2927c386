/* SPDX-License-Identifier: BSD-3-Clause */
/* The state of points and bodies that move in time (point_motion.h, body_motion.h). */
#ifndef CAPSTAN_SRC_EVOLVE_JOINT_INERTIA_H
#define CAPSTAN_SRC_EVOLVE_JOINT_INERTIA_H

#include "base/rotation.h"
#include "capstan/motion.h"

typedef struct CpsiPointInertia {
    double mass;               /* [kg] */
    bool is_moving;            /* the last step, or the one under way, is one in time */
    bool restarts;             /* its next step is an Euler step */
    double span;               /* [s] k */
    double reference[3];       /* [m] x* */
    double rest_velocity[3];   /* [m/s] v* */
    double velocity[3];        /* [m/s] now */
    double before[3];          /* [m] x_{n-1} of the next step's x_n, changed where it bears */
    double before_velocity[3]; /* [m/s] v_{n-1}, likewise */
    double past[3];            /* [m] x_{n-1} of the step as it was */
    bool bore;                 /* it touched an obstacle when the step began */
    bool landed;
    bool crossed; /* it came to the surface of the water in the step, or left it */
    bool velocity_given;
    double given_velocity[3]; /* [m/s] after the step under way, with the flag */
    double error;             /* [m] of the step by its estimate (pace.h) */
    double kinetic;           /* [J] */
    double afloat;            /* [J] by which the energy of its buoyancy grew in the step */
    CpsMotionLedger ledger;
} CpsiPointInertia;

/* What moves of a body: places [m], velocities [m/s], momenta. */
typedef struct CpsiBodyPhase {
    Vec3 place, centre; /* of reference point and centre of gravity */
    Rotation turn;
    Vec3 velocity, centre_velocity, rate;
    Vec3 angular;              /* [kg m2/s] L about the centre of gravity */
    Vec3 water, water_angular; /* [kg m/s, kg m2/s] of the added mass about the reference point */
} CpsiBodyPhase;

typedef struct CpsiBodyInertia {
    bool is_moving, restarts;
    bool held_now, held_before; /* in the steps n and n - 1 */
    double span;                /* [s] k */
    CpsiBodyPhase now, before;  /* of the steps n and n - 1 */
    /* x*, t*, v* and momenta of the scheme; the turn is Q_n, the rate's place is t* */
    CpsiBodyPhase rest;
    bool velocity_given;
    Vec3 given_velocity, given_rate; /* after the step under way, with the flag */
    double error;                    /* [m] of the step by its estimate (pace.h) */
    double kinetic, dissipated;      /* [J] */
    CpsMotionLedger ledger;
} CpsiBodyInertia;

#endif
