/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene from its file to its results, within a test program. */
#ifndef CAPSTAN_CHECKER_RUN_SCENE_H
#define CAPSTAN_CHECKER_RUN_SCENE_H

#include "capstan/step.h"

/* Take the steps of the scene in the file `path`, write their results to a directory, and return
 * the last report on its first line. What fails on the way fails the test. */
CpsLineReport run_scene(const char *path, const char *directory);

#endif
