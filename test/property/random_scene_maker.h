/* SPDX-License-Identifier: BSD-3-Clause */
/* What the two halves of the generator share: random numbers, the frame of a plane, and a scene
 * under construction. */
#ifndef CAPSTAN_TEST_RANDOM_SCENE_MAKER_H
#define CAPSTAN_TEST_RANDOM_SCENE_MAKER_H

#include "random_scene.h"

typedef struct Random {
    uint64_t state;
} Random;

double random_uniform(Random *random, double low, double high);
double random_decades(Random *random, double low, double high); /* 10^low .. 10^high */
int random_below(Random *random, int bound);
bool random_chance(Random *random, double probability);

typedef struct Frame {
    double origin[3], axis[3][3]; /* two tangents and the normal */
} Frame;

/* A direction or a place given in the frame, in the axes of the world. */
void maker_direction(const Frame *frame, const double local[3], double scale, double out[3]);
void maker_place(const Frame *frame, const double local[3], double out[3]);

typedef struct Maker {
    Random random;
    Frame frame;
    RandomScene *out;
    double length, weight, friction; /* of the line in hand */
    double foot[3];                  /* end A in the frame */
} Maker;

/* The scene with its plane; a new line (elements 0: 5 to 60) without a start; the line in hand. */
void maker_begin(Maker *maker, double tilt, double friction, bool obstacle);
void maker_begin_line(Maker *maker, int elements);
CpsLine *maker_line(Maker *maker);
/* EA is `ratio` times the larger of the force and a third of the line's weight. */
void maker_stiffness(Maker *maker, double ratio, double force);
void maker_any_stiffness(Maker *maker);
void maker_stage(Maker *maker, int steps);
void maker_change(Maker *maker, int end, CpsEndKind kind, const double value[3]);
/* A line on a mostly flat bed, pulled about at its free end; returns the largest force. */
double maker_common(Maker *maker, int elements);

/* random_scene_sections.c: give the lines of a scene sections, clumps and buoys. */
void random_scene_add_sections(Maker *maker);
/* ... and give those that are elastic tables of strain and tension. */
void random_scene_add_tables(Maker *maker);

/* random_scene_curved.c: the classes on curved obstacles and with friction that has directions. */
void random_scene_curved(int class_index, Maker *maker);

#endif
