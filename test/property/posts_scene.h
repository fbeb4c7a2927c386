/* SPDX-License-Identifier: BSD-3-Clause */
/* Random lines beside posts and balls, thick and thin beside their elements: one to three cylinders
 * and balls, a line of 4 to 70 elements, h/R from 0.05 to 10; both ends are carried past them, or
 * one end is carried and the other pulled, and then one end goes back. Friction has one
 * coefficient, two, or is a planar set of forces; bounds follow the reactions or are those of the
 * step before. */
#ifndef CAPSTAN_TEST_POSTS_SCENE_H
#define CAPSTAN_TEST_POSTS_SCENE_H

#include "rig.h"

typedef struct PostsScene {
    Rig rig;
    double thickest;            /* h/R of the thinnest obstacle */
    bool flat;                  /* all stays in the plane z = 0 */
    bool sets;                  /* friction by sets of forces */
    CpsSet *set[RIG_OBSTACLES]; /* the friction of an obstacle; NULL: coefficients */
} PostsScene;

/* Scene `number`, the same on every machine. The struct points into itself: fill it where it
 * stays. */
void posts_scene_make(PostsScene *scene, int number);

/* Its sets. */
void posts_scene_release(PostsScene *scene);

#endif
