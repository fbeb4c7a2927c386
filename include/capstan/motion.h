/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/motion.h: lines, points and bodies that move with inertia.
 *
 * A stage or a move (scene.h, evolve.h) with a `duration` is taken in time: each of its steps is of
 * length h = duration / step_count, and nodes of lines, points and bodies have mass. Lines that are
 * `quasi_static` have none: they follow what moves them (S90, figure 1), and loads, springs and the
 * drag of the current act on them as at rest. A stage without a duration is quasi-static, and
 * leaves the lines at rest.
 *
 *     line.inertia = 7.5;
 *     CpsStage swing = cps_stage_default();
 *     swing.duration = 10;
 *     swing.step_count = 200;
 *
 * A line with the `damping` BA has the tension EA d + BA d', d its elongation per natural length,
 * but never a negative one; where it is slack its elongation goes back to 0 as if alone.
 *
 * A time step is the same convex program as a quasi-static one, with a quadratic term for each node
 * (docs/theory.md 9): friction stays a set, and the step has a certificate. The scheme is the
 * backward difference formula of second order, or the implicit Euler method; the first step in
 * time, those in which an end or a node is let go at once, and those at which an element is
 * snatched taut are Euler steps. A node that lands does not rebound, but for what the ground gives
 * (CpsObstacle). It needs Coulomb's law, contact that is reached, and a scene without lines that
 * part, winches and anchors that drag. Beside free points and bodies lines are elastic. The path
 * tolerance has no effect on lines with inertia. Motions and loads that a function of the program
 * makes of time and state are those of follow.h.
 *
 * The velocity of what is held is that of the scheme by its places. A program that is coupled to
 * this one, and knows the velocity at the end of a step, may give it beside the place there
 * (`has_velocity` of a change), in a stage or move of one step with a duration: of all the motion,
 * that of oscillations included. It is in the inertia, the drag and the damping of what is held, so
 * in the force that holds it, in friction beside it, and in the motion from which it is let go. At
 * an end of a line without inertia (`quasi_static`) it changes nothing. */
#ifndef CAPSTAN_MOTION_H
#define CAPSTAN_MOTION_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CpsEvolution;
struct CpsLedger;

typedef enum CpsTimeScheme {
    CPS_TIME_SCHEME_BDF2, /* the default: of second order where the motion is smooth */
    CPS_TIME_SCHEME_EULER /* of first order; never gains energy */
} CpsTimeScheme;

typedef enum CpsSwayOf { CPS_SWAY_OF_END, CPS_SWAY_OF_POINT, CPS_SWAY_OF_BODY } CpsSwayOf;

/* An oscillation of an end, point or body that the stage changes, beside its way to its value:
 *
 *     sine sin(w t) + cosine (1 - cos(w t)),    w = 2 pi / period,
 *
 * t from the beginning of the stage, in a stage with a duration. It is 0 where the stage begins.
 * Oscillations of one thing add up. A held body gets the rotation of the last three components, a
 * rotation vector in the axes of the scene, after the rotation of its way.
 *
 * With rows it is a time series in their place: through its rows goes a cubic of each component in
 * each interval, with the slope of the parabola through a row and its neighbours, so that values
 * and velocities are continuous. What is held has 0 at the time 0, for a place does not jump. A
 * move has none, for it is one step. */
typedef struct CpsSway {
    CpsSwayOf of;
    int owner; /* index of the line, point or body in the scene */
    int end;   /* of a line: CPS_END_A or CPS_END_B */
    /* [m] of what is held, [N] of what is free, then of a body [rad] or [N m] about x, y and z, of
     * an end or point 0; default 0 */
    double sine[6], cosine[6];
    double period; /* [s] > 0; not read with rows */
    int row_count; /* default 0; or at least 2 */
    /* (row_count, 7) time [s], which increases from at most 0 to at least the duration, and value
     */
    const double *row;
} CpsSway;

/* What an oscillation adds `time` [s] after its stage began, in the units of its amplitudes; 0 of
 * none, and of one without a period or rows. */
CPS_API void cps_sway_at(const CpsSway *sway, double time, double out[6]);

/* Energy of a step in time [J]. With the ledger of the line (step.h):
 *
 *     ends + obstacles + loads + waves
 *         = elastic + gravity + dissipated + kinetic + impact + scheme + damping + drag + added
 *           + imbalance
 *
 * where each but the last has a formula of its own (docs/theory.md 9), and forces do their work at
 * their values after the step. So the imbalance is rounding. The first quasi-static step after
 * steps in time loses the kinetic energy, and `settling` is on the right. */
typedef struct CpsMotionLedger {
    double kinetic;  /* increase of the kinetic energy */
    double impact;   /* lost where nodes land */
    double scheme;   /* lost by the scheme: what a shorter step does not lose */
    double settling; /* lost where a quasi-static step brings to rest what moved before it */
    double damping;  /* lost by internal damping, and in what gives */
    double drag;     /* work done on the water against its drag; of a current also negative */
    double added;    /* work done on the water that is moved along (CpsDrag), which gives it back */
    double waves;    /* work of the water's own acceleration in waves (waves.h) on the line */
    double turnover; /* sum of the sizes of all entries: what the imbalance is compared with */
} CpsMotionLedger;

/* The motion of a line in the last step. */
typedef struct CpsLineMotion {
    /* the last step had a duration, and the line has inertia; otherwise the next ones are 0, but
     * for `kinetic` and `settling` of the ledger where it came to rest, and for `scheme` of a
     * quasi-static line at points in a step in time: what its pull after the step does on them
     * beyond the work in its own ledger */
    bool is_moving;
    double kinetic;         /* [J] kinetic energy now */
    CpsMotionLedger ledger; /* of the step */
    int landed;             /* contacts of nodes that began to bear */
    int changed;            /* contacts that went from rest to sliding or back */
    int snatched;           /* elements that went from slack to taut */
    /* [m] >= 0: no further, in the mean weighted by mass over the square of `span`, is the line
     * from the exact solution of the step's program */
    double position_bound;
    /* of a scene in time; otherwise NULL. After a quasi-static step 0 but for the masses */
    const double *mass;          /* (n) [kg] of the nodes */
    const double *velocity;      /* (n, 3) [m/s] after the step, and after the landing */
    const double *before;        /* (n, 3) [m] x_n, where the step began */
    const double *rest_velocity; /* (n, 3) [m/s] v*: the acceleration is (v - v*)/k, v = (x - x*)/k,
                                    and x* is the reference of the view */
    const double *span;          /* (n) [s] k */
    bool velocity_given[2];      /* that of ends A and B (CpsChange), also by their points */
    double damping;              /* [N s] BA; 0: the next ones are NULL */
    const double *elongation;    /* (n - 1) [-] d of the elements, at least the strain and 0 */
    const double *rest;          /* (n - 1) [-] at which the tension of the step begins */
} CpsLineMotion;

/* The motion of a point in the last step, in the axes of the scene: v = (x - x*)/k, and the force
 * of its inertia is -m (v - v*)/k. Of a free point with the ledger
 *
 *     work of load and lines + waves = afloat + dissipated + kinetic + impact + scheme + damping
 *                              + growth of what obstacles that give have stored below it,
 *
 * dissipated that of its report, damping what these obstacles lose, up to the work of what nothing
 * balances there. Of one that floats `afloat` is the growth of the energy of its buoyancy
 * (docs/theory.md 6d), and `waves` what the surface of the water does on it as it rises. */
typedef struct CpsPointMotion {
    /* the last step had a duration; otherwise the next ones are 0, but the ledger where it came to
     * rest */
    bool is_moving;
    double mass;             /* [kg] its own */
    double velocity[3];      /* [m/s] after the step, and after the landing */
    double reference[3];     /* [m] x*, in the coordinates of the scene */
    double rest_velocity[3]; /* [m/s] v* */
    double span;             /* [s] k */
    double kinetic;          /* [J] */
    CpsMotionLedger ledger;
    bool landed;
    bool velocity_given; /* by a change of it, or of its body */
} CpsPointMotion;

/* The motion of a body in the last step, in the axes of the scene. With the places x* and rotation
 * vectors t* of the scheme (docs/theory.md 9), u its velocity and w its rate of rotation, the
 * momentum of the mass is m times the velocity of its centre of gravity, its angular momentum about
 * that L = J w; those of the added mass are about the reference point. */
typedef struct CpsBodyMotion {
    /* the last step had a duration; otherwise the next ones are 0, but the ledger where it came to
     * rest */
    bool is_moving;
    double velocity[3];         /* [m/s] of the reference point */
    double turn_rate[3];        /* [rad/s] w */
    double centre_velocity[3];  /* [m/s] of the centre of gravity */
    double angular_momentum[3]; /* [kg m2/s] about it, without added mass */
    double span;                /* [s] k */
    double kinetic;             /* [J] with that of the added mass */
    double dissipated;          /* [J] by damping */
    CpsMotionLedger ledger;     /* no body lands; drag is that of members and of radiation, waves
                                   are those on members */
    bool velocity_given;        /* by a change of it */
} CpsBodyMotion;

/* The motion of a point, or of a body; of what is none one of zeros. */
CPS_API CpsPointMotion cps_evolution_point_motion(const struct CpsEvolution *evolution, int point);
CPS_API CpsBodyMotion cps_evolution_body_motion(const struct CpsEvolution *evolution, int body);

/* The same with `reference` relative to the origin of the views (CpsLineView), from which it loses
 * no digits far from 0. */
CPS_API CpsPointMotion cps_evolution_point_motion_view(const struct CpsEvolution *evolution,
                                                       int point);

/* The motion of a line; of what is no line one of zeros. Arrays belong to the evolution, until its
 * next step. */
CPS_API CpsLineMotion cps_evolution_line_motion(const struct CpsEvolution *evolution, int line);

/* All lines, points and bodies in the last step: sums, of the bound the largest. `turnover` has
 * that of lines without inertia too, also in a quasi-static step: the sizes of the entries of their
 * ledgers. What lines, points and bodies do to each other counts in it where they have it apart. */
typedef struct CpsStepMotion {
    double kinetic;         /* [J] now */
    CpsMotionLedger ledger; /* of the step, beside that of its report */
    double position_bound;  /* [m] as of a line */
    int landed, changed, snatched;
} CpsStepMotion;

CPS_API CpsStepMotion cps_evolution_motion(const struct CpsEvolution *evolution);

/* Add the entries of the energy of a step to sums: `ledger` that of its report (step.h). */
CPS_API void cps_ledgers_add(const struct CpsLedger *ledger, const CpsMotionLedger *motion,
                             struct CpsLedger *sum, CpsMotionLedger *motion_sum);

/* How long the last step was. Of a stage with an `error` (CpsStage) steps have different lengths,
 * at most duration / step_count: such that by its own estimate no step moves anything by more than
 * that beyond where it belongs (docs/theory.md 9). A step that would is taken back, and a shorter
 * one is tried; so is one that is not certified. No step is shorter than 1e-4 of the longest: there
 * it is kept, with its error here, as it is. */
typedef struct CpsPace {
    double length; /* [s] 0: quasi-static */
    double error;  /* [m] by its estimate, in steps of a stage with an `error`; else 0 */
    int rejected;  /* tries that were taken back */
} CpsPace;

CPS_API CpsPace cps_evolution_pace(const struct CpsEvolution *evolution);

/* [s] The time since the history began: the sum of the durations of the steps taken. */
CPS_API double cps_evolution_time(const struct CpsEvolution *evolution);

#ifdef __cplusplus
}
#endif
#endif
