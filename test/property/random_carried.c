/* SPDX-License-Identifier: BSD-3-Clause */
/* A point that a table carries along as it is moved, turned and tilted.
 *                                     usage: random_carried [--scenes N] [--seed S]
 *
 * A weight rests at a free point on a rough plane that begins level, on a slack line without weight
 * to an anchor far above; it may lie at the point about which the table turns, or far from it. As
 * long as the table is tilted by no more than the friction angle the point moves as a part of it,
 * x -> c + s d + R(s v) (x - c), with R by Rodrigues' formula here; gravity is borne by a reaction
 * W n.e and a friction force W (e - (n.e) n), n the normal turned by all turns, e upwards. From
 * where it would slide a scene is no more followed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "dice.h"
#include "scenes_given.h"

enum { STAGES = 4 };
/* [-] Places over the size, forces over the weight; rounding of places up to 1e3 sizes away. */
static const double NEAR = 1e-9, FORCE = 1e-7, OPEN_SHARE = 0.005;

typedef struct Tally {
    int scenes, steps, open, wrong, tilted, spun;
    double off, force;
} Tally;

typedef struct Table {
    CpsObstacle plane;
    CpsLine line;
    CpsPoint point[2];
    CpsShift shift[STAGES];
    CpsStage stage[STAGES];
    CpsScene scene;
    double size, base[3];
} Table;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* v turned by share * turn */
static void rotate(const double turn[3], double share, double v[3]) {
    const double angle = share * sqrt(dot(turn, turn));
    if (angle == 0) return;
    double k[3], out[3];
    for (int a = 0; a < 3; a++) k[a] = turn[a] / sqrt(dot(turn, turn));
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = v[a] * cos(angle) + (k[b] * v[c] - k[c] * v[b]) * sin(angle) +
                 k[a] * dot(k, v) * (1 - cos(angle));
    }
    memcpy(v, out, sizeof out);
}

static void make(Table *t, uint64_t seed) {
    memset(t, 0, sizeof *t);
    state = 0x510e527fade682d1u * (seed + 1);
    t->scene = cps_scene_default();
    t->size = pow(10, uniform(-1, 3));
    for (int a = 0; a < 3; a++) t->base[a] = chance(0.5) ? 0 : uniform(-3, 3) * t->size;
    t->plane = cps_obstacle_default();
    t->plane.name = "table";
    t->plane.moves = true;
    t->plane.friction = uniform(0.1, 1.2);
    memcpy(t->plane.point, t->base, sizeof t->base);
    for (int i = 0; i < 2; i++) {
        t->point[i] = cps_point_default();
        t->point[i].name = i ? "anchor" : "weight";
        t->point[i].kind = i ? CPS_POINT_KIND_HELD : CPS_POINT_KIND_FREE;
        for (int a = 0; a < 3; a++)
            t->point[i].position[a] = t->base[a] + (a < 2 ? uniform(-1, 1) : 6.0 * i) * t->size;
    }
    t->point[0].weight = pow(10, uniform(-1, 4));
    t->line = cps_line_default();
    t->line.name = "line";
    t->line.length = 30 * t->size;
    t->line.element_count = whole(1, 6);
    t->line.stiffness = t->point[0].weight * pow(10, uniform(1, 5));
    t->line.start.kind = CPS_START_STATIC;
    const bool turned = chance(0.5);
    for (int end = 0; end < 2; end++) {
        t->line.end[end].kind = CPS_END_KIND_POINT;
        t->line.end_point[end] = turned ? !end : end;
    }
    for (int k = 0; k < STAGES; k++) {
        CpsShift *by = &t->shift[k];
        t->stage[k] = cps_stage_default();
        t->stage[k].name = "stage";
        t->stage[k].step_count = whole(1, 4);
        t->stage[k].shift_count = chance(0.9);
        t->stage[k].shift = by;
        const bool at_point = chance(0.2);
        for (int a = 0; a < 3; a++) {
            by->by[a] = chance(0.7) ? uniform(-0.5, 0.5) * t->size : 0;
            by->turn[a] = chance(0.7) ? uniform(-1, 1) * (a < 2 ? 0.3 * t->plane.friction : 3) : 0;
            by->about[a] = at_point ? t->point[0].position[a]
                                    : t->base[a] + (a < 2 ? uniform(-1, 1) * t->size : 0);
        }
    }
    t->scene.obstacle = &t->plane;
    t->scene.line = &t->line;
    t->scene.point = t->point;
    t->scene.stage = t->stage;
    t->scene.obstacle_count = t->scene.line_count = 1;
    t->scene.point_count = 2;
    t->scene.stage_count = STAGES;
}

static void fail(uint64_t seed, const CpsError *err) {
    printf("seed %llu: %s\n", (unsigned long long)seed, err->message);
    exit(1);
}

/* The point after a share of a shift from x, and the normal turned with it. */
static void carry(const CpsShift *by, double share, const double x[3], const double n[3],
                  double place[3], double normal[3]) {
    for (int a = 0; a < 3; a++) place[a] = x[a] - by->about[a];
    memcpy(normal, n, 3 * sizeof *n);
    rotate(by->turn, share, place);
    rotate(by->turn, share, normal);
    for (int a = 0; a < 3; a++) place[a] += by->about[a] + share * by->by[a];
}

/* Compare a step; false where it is wrong. */
static bool check(const Table *t, const CpsEvolution *evolution, const double place[3],
                  const double normal[3], Tally *tally) {
    const CpsPointReport point = cps_evolution_point_report(evolution, 0);
    const double weight = t->point[0].weight, up[3] = {0, 0, 1};
    double off = 0, force = fabs(point.reaction - weight * normal[2]);
    for (int a = 0; a < 3; a++) {
        off = fmax(off, fabs(point.position[a] - place[a]));
        force = fmax(force, fabs(point.friction[a] - weight * (up[a] - normal[2] * normal[a])));
        force = fmax(force, weight * fabs(point.normal[a] - normal[a]));
    }
    off /= t->size;
    force /= weight;
    tally->off = fmax(tally->off, off);
    tally->force = fmax(tally->force, force);
    return off <= NEAR && force <= FORCE && point.state == CPS_POINT_STATE_STICK;
}

static void run(uint64_t seed, Tally *tally) {
    Table t;
    CpsError err;
    CpsEvolution *evolution = NULL;
    make(&t, seed);
    if (cps_evolution_create(&t.scene, &evolution, &err) != CPS_OK) fail(seed, &err);
    if (cps_evolution_step(evolution, &err) != CPS_OK) fail(seed, &err);
    double x[3], n[3] = {0, 0, 1}, place[3], normal[3];
    memcpy(x, cps_evolution_point_report(evolution, 0).position, sizeof x);
    tally->scenes++;
    bool rests = true;
    for (int k = 0; rests && k < STAGES; k++) {
        for (int step = 1; rests && step <= t.stage[k].step_count; step++) {
            const double share =
                t.stage[k].shift_count > 0 ? (double)step / t.stage[k].step_count : 0;
            carry(&t.shift[k], share, x, n, place, normal);
            const double tilt = hypot(normal[0], normal[1]) / normal[2];
            if (!(normal[2] > 0) || tilt > 0.99 * t.plane.friction) {
                rests = false;
                break;
            }
            if (cps_evolution_step(evolution, &err) != CPS_OK) fail(seed, &err);
            tally->steps++;
            tally->tilted += tilt > 0.3 * t.plane.friction;
            tally->spun += share > 0 && t.shift[k].turn[2] != 0;
            if (!cps_outcome_is_certified(cps_evolution_report(evolution).outcome)) {
                printf("seed %llu stage %d step %d: %s\n", (unsigned long long)seed, k, step,
                       cps_outcome_name(cps_evolution_report(evolution).outcome));
                tally->open++;
                rests = false;
            } else if (!check(&t, evolution, place, normal, tally)) {
                printf("seed %llu stage %d step %d: not carried along\n", (unsigned long long)seed,
                       k, step);
                tally->wrong++;
                rests = false;
            }
        }
        memcpy(x, place, sizeof x);
        memcpy(n, normal, sizeof n);
    }
    cps_evolution_destroy(evolution);
}

int main(int argc, char **argv) {
    uint64_t first;
    const int scenes = scenes_given(argc, argv, 100, &first);
    Tally t = {0};
    for (int i = 0; i < scenes; i++) run(first + (uint64_t)i, &t);
    printf("%d scenes, %d steps: %d open, %d wrong; %d tilted, %d spun; off by up to %.2g of the "
           "size, forces by %.2g of the weight\n",
           t.scenes, t.steps, t.open, t.wrong, t.tilted, t.spun, t.off, t.force);
    return t.wrong > 0 || t.open > OPEN_SHARE * t.steps ||
           (scenes > 1 && (t.tilted == 0 || t.spun == 0));
}
