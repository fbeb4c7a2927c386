/* SPDX-License-Identifier: BSD-3-Clause */
/* What `capstan check` prints of a scene in time: what has inertia, drag and damping, and how long
 * the history takes; and matrices of bodies. */
#ifndef CAPSTAN_CLI_CHECK_MOTION_H
#define CAPSTAN_CLI_CHECK_MOTION_H

#include "capstan/evolve.h"

/* An entry of the history has a duration. */
bool check_in_time(const CpsScene *scene);

/* The six rows of a matrix beside a head, as "[1 2 3 4 5 6]", without what is rounding of sums;
 * nothing of 0. */
void check_print_matrix(const char *head, const double *matrix);
void check_print_current(const CpsScene *scene);
void check_print_body_motion(const CpsScene *scene, int body);
void check_print_point_motion(const CpsPoint *point);
void check_print_line_motion(const CpsScene *scene, const CpsLine *line);
/* ", 600 s in time by bdf2, steps of 0.5 s" */
void check_print_times(const CpsScene *scene);

#endif
