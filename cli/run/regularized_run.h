/* SPDX-License-Identifier: BSD-3-Clause */
/* A history of the regularised method of 1990, step by step: each step goes on from its own last
 * configuration and reactions. Loads, ends and normals are those of the exact history, which goes
 * along. */
#ifndef CAPSTAN_CLI_RUN_REGULARIZED_RUN_H
#define CAPSTAN_CLI_RUN_REGULARIZED_RUN_H

#include "capstan/io.h"
#include "capstan/regularized.h"
#include "options.h"
#include "run/regularized_options.h"

/* One line's history so far. Begin with friction, mu of its obstacle, and the parameters given. */
typedef struct Regularized {
    double friction;
    RegularizedOptions given;
    CpsRegularized *last; /* the last step, NULL before the first; the caller's to destroy */
} Regularized;

/* mu of the scene's obstacle, 0 without one; -1 after a message of `command` where there are
 * several. */
double regularized_friction(const CpsScene *scene, const char *command);

/* The scene with what the method asks for: friction frozen, steps whole. */
CpsScene regularized_scene(const CpsScene *scene);

/* Say where that is not what the scene asks for: its friction; its steps in parts. */
void regularized_tell_friction(const CpsScene *scene);
void regularized_tell_steps(const CpsScene *scene);

/* The step that the exact history has just taken, at the parameters with which a study ends or
 * those given, on the step's own elements. */
CpsStatus regularized_step(Regularized *method, const CpsLineView *exact,
                           CpsRegularizedParameters *parameters, CpsRegularizedReport *report,
                           CpsError *err);

/* capstan run --method regularized: all steps of all lines; prints a table, writes the results. A
 * signal (signals.h) ends it after the current step. Returns the exit code. */
int run_regularized(const CpsScene *scene, const char *directory, const CliOptions *options);

#endif
