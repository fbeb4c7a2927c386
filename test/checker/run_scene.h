/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene from its file to its results, within a test program. */
#ifndef CAPSTAN_CHECKER_RUN_SCENE_H
#define CAPSTAN_CHECKER_RUN_SCENE_H

#include "capstan/step.h"

/* The scene's file, and result.nc, in a directory that these make before the tests of a program and
 * remove after them. */
extern char scene_path[64], scene_result[64];
int make_scene_directory(void **state);
int remove_scene_directory(void **state);

/* Take the steps of the scene in scene_path, write their results beside it, and return the last
 * report on its first line. What fails on the way fails the test. */
CpsLineReport run_scene(void);

#endif
