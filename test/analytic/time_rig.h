/* SPDX-License-Identifier: BSD-3-Clause */
/* One line that moves in time, perhaps on one plane, and an audit of every step.
 *
 * The audit shares no code with the library. From positions before and after the step it knows the
 * velocity, from that the acceleration, and compares mass times acceleration with the forces on
 * each node; it asks of friction that it lies within mu R and is opposite to the velocity, and of a
 * node that bears that it is on the plane, or as deep in it as the reaction says. */
#ifndef CAPSTAN_TEST_TIME_RIG_H
#define CAPSTAN_TEST_TIME_RIG_H

#include "capstan/evolve.h"
#include "check.h"

enum { TIME_STAGES = 8, TIME_POINTS = 500 };

typedef struct TimeRig {
    CpsScene scene;
    CpsLine line;
    CpsObstacle plane;
    CpsStage stage[TIME_STAGES];
    CpsChange change[TIME_STAGES];
    CpsSway sway[TIME_STAGES];
    CpsPointWeight clump;
    CpsLineLoads loads;
    CpsCurrentRow row;
    CpsCurrent current;
    double point[3 * TIME_POINTS];
    double gravity; /* [m/s2] */
} TimeRig;

/* A line of `mass` kg/m, gravity along -z; end A held, end B free; nodes start at `point`. */
void time_begin(TimeRig *rig, double length, int elements, double mass, double stiffness);
void time_plane(TimeRig *rig, double height, double friction);
void time_node(TimeRig *rig, int j, double x, double y, double z);
/* A heavy node between two stretched springs of 400 N/m each on a plane with friction 0.1, 0.2 m
 * from the middle. */
void time_block(TimeRig *rig);
/* Water of this density that flows with `velocity` everywhere, and the line's drag in it. */
void time_water(TimeRig *rig, double density, const double velocity[3], CpsDrag drag);
/* A stage of a duration in steps; it changes nothing yet. Duration 0: quasi-static. */
CpsStage *time_stage(TimeRig *rig, double duration, int steps);
/* ... changes end B in it; and lets it oscillate. */
CpsChange *time_change(TimeRig *rig, CpsEndKind kind, double x, double y, double z);
CpsSway *time_sway(TimeRig *rig, double period);

/* A run, and what was found at worst, as shares. */
typedef struct TimeRun {
    const TimeRig *rig;
    CpsEvolution *evolution;
    CpsLineView view;
    CpsLineMotion motion;
    CpsLineReport report;
    double balance;   /* imbalance of a node over the largest force */
    double outside;   /* friction beyond its bound, over the largest force */
    double opposed;   /* work of friction and of its bound against the slip, over force x length */
    double lifted;    /* height of a node that bears, over the length; where the plane gives, how
                         far a node is from the depth that belongs to its reaction */
    double remainder; /* what the ledger does not close by, over the sum of its turnover */
    double imbalance, turnover;           /* [J] sums */
    double kinetic, impact, scheme, lost; /* [J] sums; of friction */
    double drag, added, damping;          /* [J] sums: works on the water, internal damping */
    double waves;                         /* [J] sum: work of the water's own acceleration */
    int landed, changed, snatched, steps, certified;
} TimeRun;

TimeRun time_open(TimeRig *rig);
/* The next step; it is audited, and must be certified. */
void time_step(TimeRun *run);
/* All that remains of the history, or `count` steps. */
void time_steps(TimeRun *run, int count);
/* Print what was found, require it to be rounding, and close. */
void time_close(TimeRun *run, const char *name);

/* Print a figure; returns found - expected. */
double time_report(const char *name, const char *figure, double expected, double found);
/* [rad] The angle of theta'' = -rate sin theta at a time, from rest, by the Runge-Kutta method of
 * fourth order in fine steps. */
double time_pendulum_angle(double angle, double rate, double time);

#endif
