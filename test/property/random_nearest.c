/* SPDX-License-Identifier: BSD-3-Clause */
/* Where a free point goes whose lines are all slack: to the nearest place that all of them reach.
 *                                     usage: random_nearest [--scenes N] [--seed S] [--class C]
 *
 * One to five elastic lines lead from a free point to held ones, which move: by nothing, a little,
 * or so far that lines pull the point after them. Nothing acts on the point (class float); or its
 * weight presses it onto a smooth bed, where lines without weight lead up to their anchors (bed),
 * or lines with weight lie about (lying). Far from the origin, of any size, stiffness, number of
 * elements and order of ends. No force is left in any line, so the places that balance are those
 * that all lines reach: an intersection of balls, or on the bed of discs.
 *
 * Its place nearest to x is one of finitely many: x itself, its nearest place on a sphere, on the
 * circle where two meet, or a point where three do. All of them are computed here, and the nearest
 * of those that lie in all balls is the answer, for no more than three normals are needed to span
 * the direction from there to x. Each step is compared from where the step before has led. A point
 * that has to move may say that its place need not be the nearest; one that all lines reach stays.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "dice.h"
#include "scenes_given.h"

enum { MOST_LINES = 5, STAGES = 4, CLASSES = 3 };
typedef enum Class { FLOAT, BED, LYING } Class;
static const char *const CLASS[CLASSES] = {"float", "bed", "lying"};

/* [-] Places over the size of the scene: what is asked of the nearest place, and of what is
 * reached. */
static const double NEAR = 1e-6, REACHED = 1e-8;
/* Share of the steps that may be open. */
static const double OPEN_SHARE = 0.005;

typedef struct Tally {
    int scenes, steps, open, moved, chosen, undecided, wrong;
    double off;
} Tally;

typedef struct Net {
    CpsObstacle bed;
    CpsLine line[MOST_LINES];
    CpsPoint point[MOST_LINES + 1];
    CpsPointChange change[STAGES][MOST_LINES];
    CpsStage stage[STAGES];
    CpsScene scene;
    double size, base[3];
} Net;

typedef struct Ball {
    double centre[3], radius;
} Ball;

static const char *const LINE[] = {"l1", "l2", "l3", "l4", "l5"}, *const POINT[] = {"free", "a1",
                                                                                    "a2",   "a3",
                                                                                    "a4",   "a5"};

/* balls ---------------------------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static void difference(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++) out[i] = a[i] - b[i];
}
static double apart(const double a[3], const double b[3]) {
    double d[3];
    difference(a, b, d);
    return sqrt(dot(d, d));
}

/* The nearest candidate so far. */
typedef struct Best {
    const Ball *ball;
    int count;
    double from[3], place[3], distance, slack;
} Best;

static void offer(Best *best, const double place[3]) {
    for (int i = 0; i < best->count; i++)
        if (!(apart(place, best->ball[i].centre) <= best->ball[i].radius + best->slack)) return;
    const double distance = apart(place, best->from);
    if (!(distance < best->distance)) return;
    best->distance = distance;
    memcpy(best->place, place, sizeof best->place);
}

/* The circle on which two spheres meet: its middle, axis and radius; false where they do not. */
static bool circle_of(const Ball *a, const Ball *b, double middle[3], double axis[3],
                      double *radius) {
    difference(b->centre, a->centre, axis);
    const double d = sqrt(dot(axis, axis));
    if (!(d > 0)) return false;
    const double along = 0.5 * (d + (a->radius - b->radius) * (a->radius + b->radius) / d),
                 square = (a->radius - along) * (a->radius + along);
    if (!(square >= 0)) return false;
    for (int i = 0; i < 3; i++) {
        axis[i] /= d;
        middle[i] = a->centre[i] + along * axis[i];
    }
    *radius = sqrt(square);
    return true;
}

/* What of v is across a unit vector. */
static void across(const double v[3], const double axis[3], double out[3]) {
    const double along = dot(v, axis);
    for (int i = 0; i < 3; i++) out[i] = v[i] - along * axis[i];
}

/* A circle's points that are nearest to x, or in a third sphere. */
static void offer_pair(Best *best, const Ball *a, const Ball *b, const Ball *third) {
    double middle[3], axis[3], radius, d[3], u[3], w[3], place[3];
    if (!circle_of(a, b, middle, axis, &radius)) return;
    difference(third ? third->centre : best->from, middle, d);
    across(d, axis, u);
    const double size = sqrt(dot(u, u));
    if (!(size > 0)) return;
    for (int i = 0; i < 3; i++) u[i] /= size;
    if (!third) {
        for (int i = 0; i < 3; i++) place[i] = middle[i] + radius * u[i];
        offer(best, place);
        return;
    }
    /* |middle + radius (c u + s w) - centre|^2 = r^2 */
    const double c =
        (dot(d, d) + radius * radius - third->radius * third->radius) / (2 * radius * size);
    if (!(fabs(c) <= 1)) return;
    w[0] = axis[1] * u[2] - axis[2] * u[1];
    w[1] = axis[2] * u[0] - axis[0] * u[2];
    w[2] = axis[0] * u[1] - axis[1] * u[0];
    for (int side = -1; side <= 1; side += 2) {
        const double s = side * sqrt((1 - c) * (1 + c));
        for (int i = 0; i < 3; i++) place[i] = middle[i] + radius * (c * u[i] + s * w[i]);
        offer(best, place);
    }
}

/* The place in all balls that is nearest to x; false where there is none. */
static bool nearest(const Ball *ball, int count, const double x[3], double slack, double out[3]) {
    Best best = {.ball = ball, .count = count, .distance = INFINITY, .slack = slack};
    memcpy(best.from, x, sizeof best.from);
    offer(&best, x);
    for (int i = 0; i < count; i++) {
        double place[3];
        const double d = apart(x, ball[i].centre);
        if (d > 0) {
            for (int a = 0; a < 3; a++)
                place[a] = ball[i].centre[a] + ball[i].radius * (x[a] - ball[i].centre[a]) / d;
            offer(&best, place);
        }
        for (int j = i + 1; j < count; j++) {
            offer_pair(&best, &ball[i], &ball[j], NULL);
            for (int k = j + 1; k < count; k++) offer_pair(&best, &ball[i], &ball[j], &ball[k]);
        }
    }
    memcpy(out, best.place, sizeof best.place);
    return best.distance < INFINITY;
}

/* scenes --------------------------------------------------------------------------------------- */

static void random_place(const Net *n, bool on_bed, double reach, double out[3]) {
    for (int a = 0; a < 3; a++) out[a] = n->base[a] + uniform(-reach, reach) * n->size;
    if (n->scene.obstacle_count > 0) out[2] = n->base[2] + (on_bed ? 0 : uniform(0, 0.5) * n->size);
}

static void make_line(Net *n, int i, Class class) {
    CpsLine *line = &n->line[i];
    *line = cps_line_default();
    line->name = LINE[i];
    line->length = apart(n->point[0].position, n->point[i + 1].position) * uniform(1.01, 2);
    line->element_count = whole(1, 8);
    line->stiffness = pow(10, uniform(2, 8));
    line->weight = class == LYING ? pow(10, uniform(-1, 3)) : 0;
    line->start.kind = CPS_START_STATIC;
    const bool turned = chance(0.5);
    line->end[0].kind = line->end[1].kind = CPS_END_KIND_POINT;
    line->end_point[turned] = 0;
    line->end_point[!turned] = i + 1;
}

/* Anchors move by nothing, a little or far, and some twice. */
static void make_stage(Net *n, int k, Class class) {
    CpsStage *stage = &n->stage[k];
    *stage = cps_stage_default();
    stage->name = "stage";
    stage->step_count = whole(1, 2);
    stage->point_change = n->change[k];
    for (int i = 0; i < n->scene.line_count; i++) {
        if (!chance(0.5)) continue;
        CpsPointChange *change = &n->change[k][stage->point_change_count++];
        *change = (CpsPointChange){.point = i + 1, .kind = CPS_POINT_KIND_HELD};
        double by[3];
        random_place(n, class == LYING, pow(10, uniform(-3, 0)), by);
        for (int a = 0; a < 3; a++)
            change->value[a] =
                n->point[i + 1].position[a] + (a == 2 && class != FLOAT ? 0 : by[a] - n->base[a]);
    }
}

static void make(Net *n, Class class, uint64_t seed) {
    memset(n, 0, sizeof *n);
    state = 0x3c6ef372fe94f82bu * (seed + 1) + (uint64_t) class;
    n->scene = cps_scene_default();
    n->size = pow(10, uniform(-1, 3));
    for (int a = 0; a < 3; a++) n->base[a] = chance(0.5) ? 0 : uniform(-1e3, 1e3) * n->size;
    n->scene.line = n->line;
    n->scene.point = n->point;
    n->scene.line_count = whole(1, MOST_LINES);
    n->scene.point_count = n->scene.line_count + 1;
    if (class != FLOAT) {
        n->bed = cps_obstacle_default();
        n->bed.name = "bed";
        n->bed.point[2] = n->base[2];
        n->scene.obstacle = &n->bed;
        n->scene.obstacle_count = 1;
    }
    for (int i = 0; i < n->scene.point_count; i++) {
        n->point[i] = cps_point_default();
        n->point[i].name = POINT[i];
        n->point[i].kind = i == 0 ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_HELD;
        random_place(n, i == 0 || class == LYING, 0.5, n->point[i].position);
    }
    n->point[0].weight = class == FLOAT ? 0 : pow(10, uniform(-1, 4));
    for (int i = 0; i < n->scene.line_count; i++) make_line(n, i, class);
    for (int k = 0; k < STAGES; k++) make_stage(n, k, class);
    n->scene.stage = n->stage;
    n->scene.stage_count = STAGES;
}

/* checks --------------------------------------------------------------------------------------- */

/* The balls or discs about the anchors as they are; false where a line does not reach the bed. */
static bool balls_of(const Net *n, const CpsEvolution *evolution, Ball *ball) {
    for (int i = 0; i < n->scene.line_count; i++) {
        const CpsPointReport anchor = cps_evolution_point_report(evolution, i + 1);
        const double length = n->line[i].length;
        memcpy(ball[i].centre, anchor.position, sizeof ball[i].centre);
        ball[i].radius = length;
        if (n->scene.obstacle_count == 0) continue;
        const double height = anchor.position[2] - n->base[2];
        if (!(height < length)) return false;
        ball[i].centre[2] = n->base[2];
        ball[i].radius = sqrt((length - height) * (length + height));
    }
    return true;
}

static CpsPlaces places_of(const Net *n, const CpsEvolution *evolution) {
    CpsPlaces out = CPS_PLACES_UNIQUE;
    for (int i = 0; i < n->scene.line_count; i++) {
        const CpsPlaces own = cps_evolution_line_report(evolution, i).places;
        if (own > out) out = own;
    }
    return out;
}

static void fail(uint64_t seed, const CpsError *err) {
    printf("seed %llu: %s\n", (unsigned long long)seed, err->message);
    exit(1);
}

static void run(Class class, uint64_t seed, Tally *tally) {
    Net n;
    CpsError err;
    CpsEvolution *evolution = NULL;
    make(&n, class, seed);
    if (cps_evolution_create(&n.scene, &evolution, &err) != CPS_OK) fail(seed, &err);
    tally->scenes++;
    for (int step = 0; cps_evolution_remaining_count(evolution) > 0; step++) {
        Ball ball[MOST_LINES];
        double before[3], want[3];
        memcpy(before, cps_evolution_point_report(evolution, 0).position, sizeof before);
        if (cps_evolution_step(evolution, &err) != CPS_OK) fail(seed, &err);
        if (!balls_of(&n, evolution, ball) ||
            !nearest(ball, n.scene.line_count, before, 1e-12 * n.size, want))
            break; /* a line is taut from here on */
        tally->steps++;
        if (!cps_outcome_is_certified(cps_evolution_report(evolution).outcome)) {
            printf("%s seed %llu step %d: %s\n", CLASS[class], (unsigned long long)seed, step,
                   cps_outcome_name(cps_evolution_report(evolution).outcome));
            tally->open++;
            break;
        }
        const CpsPointReport point = cps_evolution_point_report(evolution, 0);
        const CpsPlaces places = places_of(&n, evolution);
        const double off = apart(point.position, want) / n.size,
                     moved = apart(want, before) / n.size;
        bool out = false;
        for (int i = 0; i < n.scene.line_count; i++)
            out = out || apart(point.position, ball[i].centre) > ball[i].radius + REACHED * n.size;
        tally->moved += moved > 1e-9;
        tally->chosen += places == CPS_PLACES_NEAREST;
        tally->undecided += places == CPS_PLACES_ANY;
        const bool laid = class == LYING && step == 0, /* by statics: nothing was there before */
            claimed = !laid && (places != CPS_PLACES_ANY || !(moved > 0));
        if (claimed) tally->off = fmax(tally->off, off);
        if (out || (claimed && off > NEAR)) {
            printf("%s seed %llu step %d: %s, %d lines, %g off of %g\n", CLASS[class],
                   (unsigned long long)seed, step, out ? "out of reach" : "not the nearest",
                   n.scene.line_count, off, moved);
            tally->wrong++;
        }
    }
    cps_evolution_destroy(evolution);
}

int main(int argc, char **argv) {
    int only = -1;
    uint64_t first;
    bool failed = false;
    const int scenes = scenes_given(argc, argv, 20, &first);
    for (int i = 1; i + 1 < argc; i += 2)
        if (strcmp(argv[i], "--class") == 0) only = atoi(argv[i + 1]);
    for (int class = 0; class < CLASSES; class ++) {
        Tally t = {0};
        if (only >= 0 && class != only) continue;
        for (int i = 0; i < scenes; i++) run((Class) class, first + (uint64_t)i, &t);
        printf(
            "%-5s %d scenes, %d steps: %d open, %d wrong; %d moved, %d a choice and the nearest, "
            "%d a choice; off by up to %.2g\n",
            CLASS[class], t.scenes, t.steps, t.open, t.wrong, t.moved, t.chosen, t.undecided,
            t.off);
        failed =
            failed || t.wrong > 0 || t.open > OPEN_SHARE * t.steps || (scenes > 1 && t.moved == 0);
    }
    return failed;
}
