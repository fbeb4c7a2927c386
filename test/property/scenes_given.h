/* SPDX-License-Identifier: BSD-3-Clause */
/* The arguments --scenes N and --seed S of random programs: with a seed that scene alone. */
#ifndef CAPSTAN_PROPERTY_SCENES_GIVEN_H
#define CAPSTAN_PROPERTY_SCENES_GIVEN_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* How many scenes, `scenes` by default; `*first` is the seed of the first one, 0 by default. */
static inline int scenes_given(int argc, char **argv, int scenes, uint64_t *first) {
    *first = 0;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--scenes") == 0) scenes = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--seed") == 0) {
            *first = strtoull(argv[i + 1], NULL, 10);
            scenes = 1;
        }
    }
    return scenes;
}

#endif
