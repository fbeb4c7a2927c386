/* SPDX-License-Identifier: BSD-3-Clause */
/* A history of the regularised method of 1990, step by step: each step continues from its own last
 * configuration and reactions. Loads, ends and normals are those of the exact history, which is
 * computed in parallel. */
#ifndef CAPSTAN_CLI_RUN_REGULARIZED_RUN_H
#define CAPSTAN_CLI_RUN_REGULARIZED_RUN_H

#include "capstan/io.h"
#include "capstan/regularized.h"
#include "options.h"
#include "run/regularized_options.h"

/* The history of one line. To be initialised with friction, mu of its obstacle, and the parameters
 * given. */
typedef struct Regularized {
    double friction;
    RegularizedOptions given;
    CpsRegularized *last; /* the last step, NULL before the first; destroyed by the caller */
} Regularized;

/* mu of the scene's obstacle, 0 without one; -1 after a message of `command` where there are
 * several. */
double regularized_friction(const CpsScene *scene, const char *command);

/* The scene with the settings that the method requires: frozen friction, whole steps. */
CpsScene regularized_scene(const CpsScene *scene);

/* Report where these differ from the settings of the scene: its friction, its division into
 * substeps. */
void regularized_print_friction(const CpsScene *scene);
void regularized_print_steps(const CpsScene *scene);

/* Compute the present step of the exact history, with the final parameters of a study or those
 * given, on the step's own elements. */
CpsStatus regularized_step(Regularized *method, const CpsLineView *exact,
                           CpsRegularizedParameters *parameters, CpsRegularizedReport *report,
                           CpsError *err);

/* capstan run --method regularized: compute all steps of all lines, print a table, write the
 * results. A signal (signals.h) ends it after the present step. Returns the exit code. */
int run_regularized(const CpsScene *scene, const char *directory, const CliOptions *options);

#endif
