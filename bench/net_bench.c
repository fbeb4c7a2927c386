/* SPDX-License-Identifier: BSD-3-Clause */
/* How the time of a net grows with its points.
 *
 * A square net of n x n meshes, one element from knot to knot, hangs from its four corners over a
 * ball and four pegs. Its first step places it by statics, without friction; two more pull two of
 * its corners outwards, with mu = 0.3. All nets have the same size, weight and stiffness. Each runs
 * in a process of its own, so that its peak memory is its own. Uses the public interface only. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "capstan/evolve.h"

enum { MOST_SIZES = 16, PEGS = 4, STEPS = 3, NAME = 16 };

/* What --check asks. */
static const double MOST_SLOPE = 1.6;

static const char usage[] =
    "usage: net_bench [--meshes LIST] [--threads N] [--check]\n"
    "  --meshes LIST   meshes on a side of the net, with commas (default 10,20,30,50,70,100)\n"
    "  --threads N     threads that share the lines (default 1)\n"
    "  --check         exit 1 unless all steps are certified and time grows as the points to no\n"
    "                  more than the power 1.6";

/* [m], [N/m] and [N] of the whole: side of the net as cut, half the side between the corners,
 * weight per area, stiffness over the whole side. */
static const double SIDE = 4, HALF = 1.9, HEIGHT = 0.3, WEIGHT = 20, STIFFNESS = 1e5;

typedef struct Net {
    int n;
    CpsObstacle obstacle[1 + PEGS];
    CpsLine *line;
    CpsPoint *point;
    char (*name)[NAME];
    CpsPointChange change[2];
    CpsStage stage;
    CpsScene scene;
} Net;

typedef struct Row {
    int points, lines, trials;
    CpsOutcome outcome;
    double create, step[STEPS], bytes;
} Row;

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void add_ball(Net *net, const char *name, double x, double y, double z, double radius) {
    CpsObstacle *ball = &net->obstacle[net->scene.obstacle_count++];
    *ball = cps_obstacle_default();
    ball->name = name;
    ball->kind = CPS_OBSTACLE_SPHERE;
    ball->point[0] = x;
    ball->point[1] = y;
    ball->point[2] = z;
    ball->radius = radius;
    ball->friction = 0.3;
}

static void add_line(Net *net, int from, int to) {
    const int i = net->scene.line_count++;
    CpsLine *line = &net->line[i];
    *line = cps_line_default();
    snprintf(net->name[i], NAME, "l%d", i);
    line->name = net->name[i];
    line->length = SIDE / net->n;
    line->element_count = 1;
    line->weight = WEIGHT * SIDE / (2 * (net->n + 1));
    line->stiffness = STIFFNESS / net->n;
    line->start.kind = CPS_START_STATIC;
    line->end[0].kind = line->end[1].kind = CPS_END_KIND_POINT;
    line->end_point[0] = from;
    line->end_point[1] = to;
}

static void make(Net *net, int n) {
    const int points = (n + 1) * (n + 1), lines = 2 * n * (n + 1);
    *net = (Net){.n = n, .scene = cps_scene_default()};
    net->line = calloc((size_t)lines, sizeof *net->line);
    net->point = calloc((size_t)points, sizeof *net->point);
    net->name = calloc((size_t)(lines + points), sizeof *net->name);
    if (!net->line || !net->point || !net->name) exit(1);
    add_ball(net, "ball", 0, 0, -0.6, 0.8);
    add_ball(net, "peg1", 1.2, 1.2, -0.3, 0.4);
    add_ball(net, "peg2", -1.2, 1.2, -0.3, 0.4);
    add_ball(net, "peg3", -1.2, -1.2, -0.3, 0.4);
    add_ball(net, "peg4", 1.2, -1.2, -0.3, 0.4);
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++) {
            const int k = net->scene.point_count++;
            CpsPoint *point = &net->point[k];
            *point = cps_point_default();
            snprintf(net->name[lines + k], NAME, "p%d", k);
            point->name = net->name[lines + k];
            const bool corner = (i == 0 || i == n) && (j == 0 || j == n);
            point->kind = corner ? CPS_POINT_KIND_HELD : CPS_POINT_KIND_FREE;
            point->position[0] = HALF * (2.0 * i / n - 1);
            point->position[1] = HALF * (2.0 * j / n - 1);
            point->position[2] = HEIGHT;
        }
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++) {
            const int k = i * (n + 1) + j;
            if (i < n) add_line(net, k, k + n + 1);
            if (j < n) add_line(net, k, k + 1);
        }
    net->stage = cps_stage_default();
    net->stage.name = "pull";
    net->stage.step_count = STEPS - 1;
    net->stage.point_change = net->change;
    net->stage.point_change_count = 2;
    for (int k = 0; k < 2; k++) {
        const int at = n * (n + 1) + k * n;
        net->change[k] = (CpsPointChange){.point = at, .kind = CPS_POINT_KIND_HELD};
        memcpy(net->change[k].value, net->point[at].position, sizeof net->change[k].value);
        net->change[k].value[0] += 0.05;
    }
    net->scene.obstacle = net->obstacle;
    net->scene.line = net->line;
    net->scene.point = net->point;
    net->scene.stage = &net->stage;
    net->scene.stage_count = 1;
}

static void die(const char *what) {
    fprintf(stderr, "net_bench: %s\n", what);
    exit(1);
}

static Row measure(int n, int threads) {
    Net net;
    CpsError err;
    CpsEvolution *evolution = NULL;
    Row row = {.outcome = CPS_OUTCOME_SOLVED};
    make(&net, n);
    net.scene.solver.thread_count = threads;
    row.points = net.scene.point_count;
    row.lines = net.scene.line_count;
    double begin = seconds();
    if (cps_evolution_create(&net.scene, &evolution, &err) != CPS_OK) die(err.message);
    row.create = seconds() - begin;
    for (int k = 0; k < STEPS; k++) {
        begin = seconds();
        if (cps_evolution_step(evolution, &err) != CPS_OK) die(err.message);
        row.step[k] = seconds() - begin;
        const CpsOutcome outcome = cps_evolution_report(evolution).outcome;
        if (!cps_outcome_is_certified(outcome)) row.outcome = outcome;
        row.trials += cps_evolution_point_report(evolution, 1).trial_count;
    }
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    row.bytes = 1024.0 * (double)used.ru_maxrss;
    cps_evolution_destroy(evolution);
    free(net.line);
    free(net.point);
    free(net.name);
    return row;
}

/* ... in a process of its own. */
static Row measure_apart(int n, int threads) {
    int pipes[2];
    Row row;
    if (pipe(pipes) != 0) die("no pipe");
    const pid_t child = fork();
    if (child < 0) die("no process");
    if (child == 0) {
        row = measure(n, threads);
        _exit(write(pipes[1], &row, sizeof row) != (ssize_t)sizeof row);
    }
    close(pipes[1]);
    if (read(pipes[0], &row, sizeof row) != (ssize_t)sizeof row) exit(1);
    close(pipes[0]);
    waitpid(child, NULL, 0);
    return row;
}

/* [s] of the steps */
static double time_of(const Row *row) {
    double sum = 0;
    for (int k = 0; k < STEPS; k++) sum += row->step[k];
    return sum;
}

/* The slope of log(time) against log(points), by least squares. */
static double slope_of(const Row *row, int count) {
    double x = 0, y = 0, xx = 0, xy = 0;
    for (int k = 0; k < count; k++) {
        const double a = log(row[k].points), b = log(time_of(&row[k]));
        x += a / count;
        y += b / count;
        xx += a * a / count;
        xy += a * b / count;
    }
    return (xy - x * y) / (xx - x * x);
}

int main(int argc, char **argv) {
    char sizes[256] = "10,20,30,50,70,100";
    int threads = 1, count = 0, open = 0;
    bool check = false;
    for (int i = 1; i < argc; i++) {
        const bool last = i + 1 == argc;
        if (strcmp(argv[i], "--check") == 0)
            check = true;
        else if (strcmp(argv[i], "--meshes") == 0 && !last)
            snprintf(sizes, sizeof sizes, "%s", argv[++i]);
        else if (strcmp(argv[i], "--threads") == 0 && !last)
            threads = atoi(argv[++i]);
        else
            die(usage);
    }
    Row row[MOST_SIZES];
    printf("meshes points  lines  create s   step 1 s   step 2 s   step 3 s  ms/point  trials  "
           "KB/point  "
           "outcome\n");
    for (char *next = strtok(sizes, ","); next && count < MOST_SIZES; next = strtok(NULL, ",")) {
        const int n = atoi(next);
        if (n < 10 || n > 200) die("from 10 to 200 meshes on a side");
        const Row is = row[count++] = measure_apart(n, threads);
        printf("%6d %6d %6d %9.3f %10.3f %10.3f %10.3f %9.3f %7d %9.1f  %s\n", n, is.points,
               is.lines, is.create, is.step[0], is.step[1], is.step[2],
               1e3 * time_of(&is) / is.points, is.trials, is.bytes / 1e3 / is.points,
               cps_outcome_name(is.outcome));
        fflush(stdout);
        open += !cps_outcome_is_certified(is.outcome);
    }
    if (count < 2) return check && open > 0;
    const double slope = slope_of(row, count);
    printf("time grows as points to the power %.2f\n", slope);
    return check && (open > 0 || !(slope <= MOST_SLOPE));
}
