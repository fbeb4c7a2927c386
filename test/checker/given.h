/* SPDX-License-Identifier: BSD-3-Clause */
/* The data that a file takes from its scene, compared with the scene. A copy in which an end force,
 * a weight or a coefficient has been changed together with everything that follows from it is a
 * valid record of another scene. The scene is read through the C interface, and only read. */
#ifndef CAPSTAN_CHECKER_GIVEN_H
#define CAPSTAN_CHECKER_GIVEN_H

#include <stdio.h>

#include "capstan/scene.h"

/* Lines, meshes, weights, stiffness, zones, obstacles, gravity, tolerance, modes; per step the
 * kinds and values of the ends, loads and turns. Friction sets are compared by their supports.
 *
 * Returns the number of findings, each a sentence on log (NULL accepted); -1 when the file cannot
 * be read. A file with fewer steps than the history is that of a run which was stopped, and no
 * finding. */
int given_file(const char *path, const CpsScene *scene, FILE *log);

#endif
