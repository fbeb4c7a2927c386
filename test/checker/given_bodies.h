/* SPDX-License-Identifier: BSD-3-Clause */
/* Comparison of the bodies of a file with their scene. */
#ifndef CAPSTAN_CHECKER_GIVEN_BODIES_H
#define CAPSTAN_CHECKER_GIVEN_BODIES_H

#include "capstan/scene.h"
#include "part.h"
#include "record.h"

/* What the scene does in a step of the file. */
typedef struct GivenStep {
    const CpsStage *stage; /* NULL: the statics of lines laid, or a scene without stages */
    Part part;
    double gravity[3]; /* [m/s2] after it */
} GivenStep;

/* Called with one sentence for each finding. */
typedef void GivenFinding(void *user, const char *sentence);

/* Names, kinds, numbers and points of the bodies, and per step their poses or loads. Returns 0, or
 * -1 after one sentence on log. */
int given_bodies(const Source *source, const CpsScene *scene,
                 GivenStep (*step_of)(const void *user, size_t step), GivenFinding *find,
                 void *user, FILE *log);

#endif
