/* SPDX-License-Identifier: BSD-3-Clause */
/* Parts of the comparison of a file with its scene (given.h): findings, and numbers that are the
 * same. */
#ifndef CAPSTAN_CHECKER_COMPARE_H
#define CAPSTAN_CHECKER_COMPARE_H

#include "capstan/scene.h"
#include "part.h"
#include "record.h"

typedef struct Compare {
    const CpsScene *scene;
    Source source;
    double *time; /* (steps of the source) [s] NULL: the file has no steps in time */
    FILE *log;
    int findings;
} Compare;

/* A finding: one sentence on the log. */
__attribute__((format(printf, 2, 3))) void find(Compare *compare, const char *format, ...);

/* |v| of three components. */
double size(const double *v);

/* Numbers of the scene are copied; a share of a stage, a weight vector and a load are a few
 * products and sums of them. */
#define COPIED   1e-14
#define COMPUTED 1e-12

/* count numbers equal to within `noise` of the largest, else a finding */
void same(Compare *compare, const char *what, const char *of, const double *file,
          const double *scene, size_t count, double noise);
void same_number(Compare *compare, const char *what, const char *of, double file, double scene);

/* The stage of a step and what it is of that; a break is that of the step before it. False: the
 * statics of lines laid, or a scene without stages. */
bool stage_of(const Compare *compare, size_t step, Part *part);
/* How many steps the scene has, with the breaks of the file; of a stage with an error, whose steps
 * end where its duration has passed, as many as in the file, or one more where that ends before. */
size_t planned(const Compare *compare);
/* The times of all steps; none of a file without. False: memory. */
bool read_times(Compare *compare);

/* What a line has on the drums of its winches after a step. */
void winches_compare(Compare *compare, const CpsLine *line, int index, size_t step,
                     const Record *r);

/* The sets that ends of a line are held to. */
void sets_compare(Compare *compare, const CpsLine *line, const Record *r);
/* ... and of points. */
void point_sets_compare(Compare *compare, const CpsScene *scene);

/* Kind, place, shape and friction of an obstacle. */
void compare_obstacle(Compare *compare, const CpsObstacle *o, const Surface *s);

/* What holds for a line in the whole run: its elements, their makes, its friction zones and what
 * its ends are at. */
void compare_line(Compare *compare, const CpsLine *line, const Record *r);

/* The errors of steps, against those asked for. 0, or -1 after one sentence on the log. */
int compare_pace(Compare *compare);

/* The velocities that stages give at the end of their step. 0, or -1 after one sentence. */
int compare_velocities(Compare *compare);

/* The waves of the file are those of the scene. */
struct Sea;
void compare_waves(Compare *compare, const struct Sea *sea);

/* Springs, given loads and drag, after a step. */
void compare_node_loads(Compare *compare, const CpsLine *line, const Record *r, size_t step);

/* [N] What the nodes weigh in the scene, (nodes), and the sum of the sizes of its terms; and [N/m]
 * all weights over the length, the unit of the file's weights. */
void node_weights(const CpsLine *line, const Record *r, double *weight, double *sizes);
double mean_weight(const CpsLine *line);

#endif
