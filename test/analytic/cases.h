/* SPDX-License-Identifier: BSD-3-Clause */
/* One line on a plane bed, its history, and a run of it that the independent checker re-checks at
 * the end. */
#ifndef CAPSTAN_TEST_CASES_H
#define CAPSTAN_TEST_CASES_H

#include "capstan/results.h"
#include "check.h"

enum { CASE_STAGES = 16, CASE_POINTS = 8 };

typedef struct Case {
    CpsScene scene;
    CpsObstacle bed;
    CpsLine line;
    double point[3 * CASE_POINTS];
    CpsStage stage[CASE_STAGES];
    CpsChange change[CASE_STAGES];
} Case;

/* A line of length, elements, weight per length and EA; gravity along -z; end A held, end B free.
 * The returned struct points into itself: fill it where it stays. */
void case_begin(Case *c, double length, int elements, double weight, double stiffness);
void case_bed(Case *c, double friction);
void case_straight(Case *c, double x_from, double x_to);
/* along the x axis up to `corner`, then straight up to the full length */
void case_corner(Case *c, double corner);
void case_arc(Case *c, double radius);
/* laid by statics between two held ends */
void case_laid(Case *c, double x, double z);
/* add a stage that gives end B a force or a position */
void case_force(Case *c, int steps, double x, double y, double z);
void case_move(Case *c, int steps, double x, double y, double z);

/* A run. Each step must be solved and certified. */
typedef struct Run {
    CpsEvolution *evolution;
    CpsResults *results;
    char directory[64];
    double dissipated;    /* [J] since case_open or the last reset by the test */
    double tension_error; /* [N] rms error that the last certificate leaves possible */
    double motion_error; /* [m] sum over the steps of c L times that: no node of a line held at A is
                            farther off */
} Run;

Run case_open(const Case *c);
CpsLineView case_step(Run *run);
/* close, let the checker read result.nc, remove the files */
void case_close(Run *run);

/* Print "case | figure | expected | found | difference"; returns found - expected. */
double show(const char *name, const char *figure, double expected, double found);

/* observed order between errors at h and h / 2 */
double order(double coarse, double fine);

#endif
