/* SPDX-License-Identifier: BSD-3-Clause */
/* One line on planes, cylinders and spheres with consistent friction, its history, and an audit of
 * every step.
 *
 * The audit shares no code with the library: it takes the obstacles of the scene, of those that a
 * node is said to touch the distance, the normal and the node's slip on it (the reference carried
 * along by an obstacle that turns) and recomputes balance, friction bound, set of forces, phi(s) +
 * <s, F> and depth from the view of the line. */
#ifndef CAPSTAN_TEST_RIG_H
#define CAPSTAN_TEST_RIG_H

#include "capstan/evolve.h"
#include "check.h"

enum { RIG_OBSTACLES = 3, RIG_STAGES = 16, RIG_POINTS = 1700 };

typedef struct Rig {
    CpsScene scene;
    CpsLine line;
    CpsObstacle obstacle[RIG_OBSTACLES];
    CpsStage stage[RIG_STAGES];
    CpsChange change[RIG_STAGES][2];
    CpsTurn turn[RIG_STAGES];
    double point[3 * RIG_POINTS], element_length[RIG_POINTS];
} Rig;

/* A line; gravity along -z; end A held, end B free. The struct points into itself: fill it where it
 * stays. */
void rig_begin(Rig *rig, int elements, double weight, double stiffness);
/* Its natural length where all elements are alike; else fill element_length and say so. */
void rig_length(Rig *rig, double length);
void rig_graded(Rig *rig);
CpsObstacle *rig_obstacle(Rig *rig, CpsObstacleKind kind, double friction);
/* Give an obstacle another coefficient across the first direction. */
void rig_lateral(CpsObstacle *obstacle, double friction);
/* add a point of a polyline start */
void rig_point(Rig *rig, double x, double y, double z);
void rig_end(Rig *rig, int end, CpsEndKind kind, double x, double y, double z);
/* add a stage; what it changes */
void rig_stage(Rig *rig, int steps);
void rig_change(Rig *rig, int end, CpsEndKind kind, double x, double y, double z);
void rig_turn(Rig *rig, int obstacle, double angle);

/* What the audit found at worst. */
typedef struct Audit {
    double balance;     /* largest imbalance of a node over the largest force */
    double open;        /* sum of reaction times distance over the scale below */
    double bound;       /* sum of |w - mu R| over the sum of w */
    double outside;     /* how far a friction force sticks out of its set, over w */
    double node_law;    /* phi(s) + <s, F> of a node over w l */
    double law;         /* its sum [J] */
    double dissipated;  /* sum of phi(s) [J] */
    double bounds;      /* sum of w [N] */
    double penetration; /* over the length of the line */
    double scale;       /* largest force times length [J] */
} Audit;

/* turn: of each obstacle since the reference, in the last part of the step */
Audit rig_audit(const CpsScene *scene, const double *turn, const CpsLineView *view);

/* A run. */
typedef struct RigRun {
    const Rig *rig;
    CpsEvolution *evolution;
    int stage, part;
    CpsLineView view;
    CpsLineReport report;
    double dissipated, law; /* [J] sums over the steps */
    double motion; /* [m] sum over the steps of c L times the rms tension error that a certificate
                      leaves possible: no node of a line held at one end is farther off */
    int steps, solved;
} RigRun;

RigRun rig_open(const Rig *rig);
/* The next step; what is solved passes the audit or fails the test. */
CpsOutcome rig_try(RigRun *run);
/* The next step, which must be solved. */
CpsLineView rig_step(RigRun *run);
/* All steps of the next stage. */
CpsLineView rig_next(RigRun *run);
void rig_close(RigRun *run);

/* [N] size of the force in element e */
double rig_tension(const CpsLineView *view, int e);
/* Print "case | figure | expected | found | difference"; returns found - expected. */
double rig_show(const char *name, const char *figure, double expected, double found);

#endif
