/* SPDX-License-Identifier: BSD-3-Clause */
/* Buoys and anchors of random moorings, checked from the places alone.
 *                                       usage: random_buoys [--scenes N] [--seed S] [--class C]
 *
 * Single legs, spreads, strings of buoys and buoys near a beach, of any size, weight and volume and
 * at any level, their lines drawn in either direction; anchors move, forces act, gravity changes.
 * The tension of an element follows from the distance of its nodes, T = EA (|x'| - 1)^+. With half
 * the weight of the end elements, the weight in air and the given force, what is missing on a free
 * point must come from the water and from an obstacle: upwards from the water, all of the displaced
 * weight where the point is below the surface, nothing above it, and anything between where it is
 * at the surface; from the obstacle as Coulomb's law has it. Some anchors drag: then the part of
 * the lines' pull along the ground is no more than the holding capacity, and where the anchor has
 * gone it is that, in the direction in which it went. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "balance_at_points.h"
#include "capstan/evolve.h"
#include "dice.h"
#include "scenes_given.h"

enum { MOST_LINES = 12, MOST_POINTS = 16, STAGES = 3, CLASSES = 4 };
typedef enum Class { LEG, SPREAD, STRING, BEACH } Class;
static const char *const CLASS[CLASSES] = {"leg", "spread", "string", "beach"};

/* Places at the surface per size of the mooring: touch, 1e-9 of the longest line, which is no
 * longer than 3 sizes, and the rounding of a level up to 1e4 sizes away. */
static const double PLACE = 1e-8;
/* Share of the steps that may be open, as in random_graphs.c. */
static const double OPEN_SHARE = 0.015;

typedef struct Tally {
    int scenes, steps, open, trials, most_trials, water[4], touching, sliding, dragged, wrong;
    double left;
} Tally;

typedef struct Mooring {
    CpsObstacle obstacle;
    CpsLine line[MOST_LINES];
    CpsPoint point[MOST_POINTS];
    char name[MOST_LINES + MOST_POINTS][16];
    CpsPointChange change[STAGES][MOST_POINTS];
    CpsStage stage[STAGES];
    CpsScene scene;
    int anchors;
    double size, weight, stiffness, depth, base[3]; /* base: where x = y = 0 and the surface meet */
} Mooring;

static int add_point(Mooring *m, CpsPointKind kind, double x, double y, double z) {
    const int i = m->scene.point_count++;
    const double at[3] = {x, y, z};
    CpsPoint *point = &m->point[i];
    *point = cps_point_default();
    snprintf(m->name[MOST_LINES + i], sizeof m->name[0], "p%d", i);
    point->name = m->name[MOST_LINES + i];
    point->kind = kind;
    for (int a = 0; a < 3; a++) point->position[a] = m->base[a] + at[a];
    return i;
}

/* A buoy of a weight in air and a displaced weight; some sink, some have no volume. */
static int add_buoy(Mooring *m, double x, double y, double z) {
    const int i = add_point(m, CPS_POINT_KIND_FREE, x, y, z);
    const double line = m->weight * m->size, air = line * pow(10, uniform(-2, 0.5)),
                 water = chance(0.1) ? 0 : line * pow(10, uniform(-2, 1));
    m->point[i].displaced_weight = water;
    m->point[i].weight = air - water;
    return i;
}

static void add_line(Mooring *m, int from, int to, double longer, int elements) {
    const int i = m->scene.line_count++;
    CpsLine *line = &m->line[i];
    double distance = 0;
    for (int a = 0; a < 3; a++)
        distance += pow(m->point[from].position[a] - m->point[to].position[a], 2);
    *line = cps_line_default();
    snprintf(m->name[i], sizeof m->name[0], "l%d", i);
    line->name = m->name[i];
    line->length = longer * sqrt(distance);
    line->element_count = elements;
    line->weight = m->weight * uniform(0.2, 1.5);
    line->stiffness = m->stiffness * uniform(0.5, 1.5);
    line->start.kind = CPS_START_STATIC;
    const bool turned = chance(0.5);
    line->end[turned].kind = CPS_END_KIND_POINT;
    line->end_point[turned] = from;
    line->end[!turned].kind = CPS_END_KIND_POINT;
    line->end_point[!turned] = to;
}

/* Some drag, with a capacity from far below to far above what the lines weigh. The first one does
 * not: a mooring on anchors that all drag may have no equilibrium. */
static int add_anchor(Mooring *m, double x, double y, double z) {
    const int i = add_point(m, CPS_POINT_KIND_HELD, x, y, z);
    CpsPoint *point = &m->point[i];
    point->drags = m->anchors++ > 0 && chance(0.4);
    point->has_holding_capacity = point->drags || chance(0.2);
    point->holding_capacity = m->weight * m->size * pow(10, uniform(-2.5, 1.5));
    return i;
}

static int anchor(Mooring *m, double angle, double radius) {
    return add_anchor(m, radius * cos(angle), radius * sin(angle), -m->depth);
}

static void make_leg(Mooring *m) {
    const double z = uniform(-0.8, 0.3) * m->depth;
    const int buoy = add_buoy(m, uniform(0.1, 1) * m->size, 0, z);
    const int elements = whole(1, 30);
    const double longer = uniform(0.7, 1.6), radius = uniform(0.1, 1) * m->size;
    add_line(m, anchor(m, uniform(2, 4), radius), buoy, longer, elements);
    for (int a = 0; a < 2; a++) m->point[buoy].force[a] = uniform(-0.5, 0.5) * m->weight * m->size;
}

static void make_spread(Mooring *m) {
    const int legs = whole(2, 5);
    const double z = uniform(-0.9, 0.1) * m->depth, y = uniform(-0.3, 0.3) * m->size,
                 x = uniform(-0.3, 0.3) * m->size;
    const int buoy = add_buoy(m, x, y, z);
    for (int k = 0; k < legs; k++) {
        const int elements = whole(1, 25);
        const double longer = uniform(0.9, 2.2), radius = uniform(0.5, 1.2) * m->size,
                     angle = 6.28 * k / legs + uniform(-0.3, 0.3);
        add_line(m, anchor(m, angle, radius), buoy, longer, elements);
    }
}

/* Buoys one after the other between two anchors. */
static void make_string(Mooring *m) {
    const int pieces = whole(3, 6);
    int from = anchor(m, 3.1416, m->size);
    for (int k = 1; k <= pieces; k++) {
        const double x = m->size * (2.0 * k / pieces - 1);
        const double z = k < pieces ? uniform(-0.7, 0.1) * m->depth : 0;
        const int to =
            k < pieces ? add_buoy(m, x, uniform(-0.1, 0.1) * m->size, z) : anchor(m, 0, m->size);
        const int elements = whole(1, 20);
        add_line(m, from, to, uniform(0.95, 1.5), elements);
        from = to;
    }
}

/* Near a slope that comes out of the water at x = y = 0. */
static void make_beach(Mooring *m) {
    CpsObstacle *beach = &m->obstacle;
    const double slope = uniform(0.05, 1);
    *beach = cps_obstacle_default();
    beach->name = "beach";
    beach->friction = chance(0.3) ? 0 : uniform(0.1, 1);
    beach->normal[0] = -slope;
    memcpy(beach->point, m->base, sizeof beach->point);
    m->scene.obstacle_count = 1;
    m->scene.obstacle = beach;
    const int buoy = add_buoy(m, -0.2 * m->size, 0, uniform(-0.2, 0.1) * 0.2 * slope * m->size);
    const int legs = whole(1, 3);
    for (int k = 0; k < legs; k++) {
        const double angle = uniform(2, 4.3), radius = uniform(0.5, 1.2) * m->size;
        const int foot =
            add_anchor(m, radius * cos(angle), radius * sin(angle), slope * radius * cos(angle));
        const int elements = whole(1, 20);
        add_line(m, foot, buoy, uniform(0.95, 1.6), elements);
    }
    m->point[buoy].force[0] = uniform(0, 1) * m->weight * m->size;
}

static void change_point(Mooring *m, CpsStage *stage, CpsPointChange *change, int i) {
    const CpsPoint *point = &m->point[i];
    const bool is_free = point->kind == CPS_POINT_KIND_FREE;
    /* anchors stay on the beach, and where they have dragged */
    if (!is_free && (m->scene.obstacle_count > 0 || point->drags)) return;
    *change = (CpsPointChange){.point = i, .kind = point->kind};
    for (int a = 0; a < 3; a++)
        change->value[a] = is_free ? uniform(-1, a == 2 ? 4 : 1) * m->weight * m->size
                                   : point->position[a] + uniform(-0.2, 0.2) * m->size;
    stage->point_change_count++;
}

static void make_stages(Mooring *m) {
    for (int k = 0; k < STAGES; k++) {
        CpsStage *stage = &m->stage[k];
        *stage = cps_stage_default();
        stage->name = "stage";
        stage->step_count = whole(1, 3);
        stage->point_change = m->change[k];
        for (int i = 0; i < m->scene.point_count; i++)
            if (chance(0.4)) change_point(m, stage, &m->change[k][stage->point_change_count], i);
        if (!chance(0.2)) continue;
        stage->gravity_changes = true;
        stage->gravity[2] = -9.81 * uniform(0.3, 2);
    }
}

static void make(Mooring *m, Class class, uint64_t seed) {
    static void (*const MAKE[CLASSES])(Mooring *) = {make_leg, make_spread, make_string,
                                                     make_beach};
    memset(m, 0, sizeof *m);
    state = 0x3c6ef372fe94f82bu * (seed + 1) + (uint64_t) class;
    m->scene = cps_scene_default();
    m->size = pow(10, uniform(-0.5, 3));
    m->depth = m->size * uniform(0.2, 1);
    m->weight = pow(10, uniform(-1, 4));
    m->stiffness = m->weight * m->size * pow(10, uniform(1, 4.5));
    if (chance(0.3))
        for (int a = 0; a < 3; a++) m->base[a] = uniform(-1, 1) * 1e4 * m->size;
    m->scene.has_water_surface = true;
    m->scene.water_surface = m->base[2];
    MAKE[class](m);
    make_stages(m);
    m->scene.line = m->line;
    m->scene.point = m->point;
    m->scene.stage = m->stage;
    m->scene.stage_count = STAGES;
}

static double norm(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* [N] The force on the point at an end of a line, from the places of its nodes. */
static void add_pull(const CpsLineView *view, double stiffness, double weight, int end,
                     double sum[3]) {
    const int e = end == CPS_END_A ? 0 : view->element_count - 1;
    const int near = end == CPS_END_A ? 0 : e + 1, far = end == CPS_END_A ? 1 : e;
    double d[3];
    for (int a = 0; a < 3; a++) d[a] = view->position[3 * far + a] - view->position[3 * near + a];
    const double size = norm(d), l = view->element_length[e];
    sum[2] -= 0.5 * l * weight;
    if (!(size > 0)) return;
    for (int a = 0; a < 3; a++) sum[a] += stiffness * fmax(0, size / l - 1) * d[a] / size;
}

/* What a point has before the water and the obstacle, the largest force, and how well it is known.
 */
typedef struct Sum {
    double force[3], largest, known;
} Sum;

static Sum sum_at(const Mooring *m, const CpsEvolution *evolution, int i, const double load[3],
                  double gravity) {
    const CpsPoint *point = &m->point[i];
    Sum s = {
        .force = {load[0], load[1], load[2] - gravity * (point->weight + point->displaced_weight)}};
    s.largest = fmax(norm(s.force), gravity * point->displaced_weight);
    for (int k = 0; k < m->scene.line_count; k++) {
        const CpsLineView view = cps_evolution_line_view(evolution, k);
        const CpsCertificate line = cps_evolution_line_report(evolution, k).certificate;
        const double stiffness = m->line[k].stiffness;
        s.largest = fmax(s.largest, line.largest_force);
        for (int end = 0; end < 2; end++) {
            if (m->line[k].end_point[end] != i) continue;
            add_pull(&view, stiffness, gravity * m->line[k].weight, end, s.force);
            s.known += stiffness * (RESTING + fmin(line.elongation_residual, STRAIN)) +
                       fmin(line.tension_estimate, TENSION * line.largest_force);
            /* rounding of coordinates far from the origin */
            s.known += stiffness * 4e-16 * norm(m->base) / view.element_length[0];
        }
    }
    return s;
}

/* What the obstacle gives by the report, checked against Coulomb's law at the slip that the places
 * tell; added to the sum. */
static bool obstacle_is_wrong(const Mooring *m, const CpsPointReport *report,
                              const double before[3], bool smooth, double allowed, Sum *s,
                              Tally *tally) {
    const CpsObstacle *beach = &m->obstacle;
    if (m->scene.obstacle_count == 0) return report->reaction != 0 || norm(report->friction) != 0;
    const double size = norm(beach->normal), mu = smooth ? 0 : beach->friction;
    double gap = 0, along = 0, slip[3], across = 0, lazy = 0;
    for (int a = 0; a < 3; a++) {
        const double n = beach->normal[a] / size;
        gap += n * (report->position[a] - m->base[a]);
        along += n * report->friction[a];
        slip[a] = report->position[a] - before[a];
        across += n * slip[a];
    }
    for (int a = 0; a < 3; a++) {
        const double n = beach->normal[a] / size;
        slip[a] -= across * n;
        s->force[a] += report->reaction * n + report->friction[a];
    }
    const double slid = norm(slip), bound = mu * report->reaction;
    if (slid > 1e-6 * m->size)
        for (int a = 0; a < 3; a++)
            lazy = fmax(lazy, fabs(report->friction[a] + bound * slip[a] / slid));
    tally->touching += report->reaction > 0;
    tally->sliding += report->reaction > 0 && slid > 1e-6 * m->size;
    return gap < -PLACE * m->size || (report->reaction > 0 && gap > PLACE * m->size) ||
           report->reaction < 0 || norm(report->friction) > bound + allowed ||
           fabs(along) > allowed || lazy > 10 * allowed;
}

/* Check a free point after a step; returns what is left over the largest force. */
static double check_point(const Mooring *m, const CpsEvolution *evolution, int i,
                          const double before[3], const double load[3], double gravity, bool smooth,
                          bool *wrong, Tally *tally) {
    const CpsPointReport report = cps_evolution_point_report(evolution, i);
    Sum s = sum_at(m, evolution, i, load, gravity);
    const double allowed = LEFT * s.largest + s.known, touch = PLACE * m->size,
                 height = report.position[2] - m->base[2],
                 displaced = gravity * m->point[i].displaced_weight,
                 least = height < -touch ? displaced : 0, most = height > touch ? 0 : displaced;
    const bool obstacle = obstacle_is_wrong(m, &report, before, smooth, allowed, &s, tally);
    const double water = fmin(fmax(-s.force[2], least), most);
    s.force[2] += water;
    const double left = norm(s.force);
    const bool told = displaced > 0 ? fabs(report.buoyancy - water) <= 2 * allowed
                                    : report.buoyancy == 0 && report.water == 0;
    tally->water[report.water]++;
    if (obstacle || !told || !(left <= allowed)) {
        *wrong = true;
        printf("  point %d: obstacle %d, buoyancy %g for %g N, left %g allowed %g, height %g\n", i,
               obstacle, report.buoyancy, water, left, allowed, height);
    }
    return left / s.largest;
}

/* Check an anchor with a capacity after a step. */
static void check_anchor(const Mooring *m, const CpsEvolution *evolution, int i,
                         const double before[3], double gravity, bool *wrong, Tally *tally) {
    static const double none[3];
    const CpsPointReport report = cps_evolution_point_report(evolution, i);
    const CpsPoint *point = &m->point[i];
    const Sum s = sum_at(m, evolution, i, none, gravity);
    const double allowed = LEFT * fmax(s.largest, point->holding_capacity) + s.known,
                 slope = m->scene.obstacle_count > 0 ? -m->obstacle.normal[0] : 0,
                 normal[3] = {-slope / hypot(slope, 1), 0, 1 / hypot(slope, 1)};
    double drag[3], pull[3], across = 0, off = 0, told = 0, along = 0;
    for (int a = 0; a < 3; a++) {
        drag[a] = point->drags ? report.position[a] - before[a] : 0;
        across += normal[a] * s.force[a];
        off += normal[a] * drag[a];
    }
    for (int a = 0; a < 3; a++) {
        pull[a] = s.force[a] - across * normal[a];
        along += pull[a] * drag[a];
        told = fmax(told, fabs(report.drag[a] - drag[a]));
    }
    const double capacity = point->holding_capacity, far = norm(drag),
                 rounded = PLACE * m->size + 1e-15 * norm(m->base);
    const bool gone = far > 1e-6 * m->size, over = point->drags && norm(pull) > capacity + allowed,
               lazy = gone && along < (capacity - 10 * allowed) * far,
               unasked = norm(pull) < capacity - 10 * allowed && far > rounded,
               untold = told > rounded ||
                        fabs(report.capacity_used * capacity - norm(pull)) > 2 * allowed;
    tally->dragged += gone;
    if (!over && !lazy && !unasked && !untold && fabs(off) <= rounded) return;
    *wrong = true;
    printf("  anchor %d: over %d lazy %d unasked %d untold %d off %g: pull %g of %g, drag %g\n", i,
           over, lazy, unasked, untold, off, norm(pull), capacity, far);
}

static void fail(uint64_t seed, const CpsError *err) {
    printf("seed %llu: %s\n", (unsigned long long)seed, err->message);
    exit(1);
}

/* The force on a point [N], and gravity over that of the scene, after a step of the history. */
static double load_at(const Mooring *m, int point, int step, double load[3]) {
    double from[3], gravity_from = 1, gravity = 1;
    int at = 1;
    memcpy(from, m->point[point].force, sizeof from);
    memcpy(load, from, sizeof from);
    for (int k = 0; k < STAGES; k++) {
        const CpsStage *stage = &m->stage[k];
        const double gravity_to =
            stage->gravity_changes ? stage->gravity[2] / m->scene.gravity[2] : gravity_from;
        double to[3];
        memcpy(to, from, sizeof to);
        for (int i = 0; i < stage->point_change_count; i++)
            if (m->change[k][i].point == point) memcpy(to, m->change[k][i].value, sizeof to);
        for (int part = 1; part <= stage->step_count; part++, at++) {
            if (at != step) continue;
            const double share = (double)part / stage->step_count;
            gravity = gravity_from + (gravity_to - gravity_from) * share;
            for (int a = 0; a < 3; a++) load[a] = from[a] + (to[a] - from[a]) * share;
        }
        memcpy(from, to, sizeof from);
        gravity_from = gravity_to;
    }
    return gravity;
}

static void run(Class class, uint64_t seed, Tally *tally) {
    static Mooring mooring;
    make(&mooring, class, seed);
    CpsError err;
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(&mooring.scene, &evolution, &err) != CPS_OK) fail(seed, &err);
    double before[MOST_POINTS][3];
    bool sound = true;
    tally->scenes++;
    for (int step = 0; sound && cps_evolution_remaining_count(evolution) > 0; step++) {
        int trials = 0;
        for (int i = 0; i < mooring.scene.point_count; i++)
            memcpy(before[i], cps_evolution_point_report(evolution, i).position, sizeof before[i]);
        if (cps_evolution_step(evolution, &err) != CPS_OK) fail(seed, &err);
        const CpsStepReport report = cps_evolution_report(evolution);
        tally->steps++;
        sound = cps_outcome_is_certified(report.outcome);
        bool wrong = false;
        for (int i = 0; i < mooring.scene.point_count; i++) {
            double load[3];
            const double gravity = load_at(&mooring, i, step, load);
            if (sound && mooring.point[i].has_holding_capacity)
                check_anchor(&mooring, evolution, i, before[i], gravity, &wrong, tally);
            if (mooring.point[i].kind != CPS_POINT_KIND_FREE) continue;
            trials = cps_evolution_point_report(evolution, i).trial_count;
            if (sound)
                tally->left = fmax(tally->left, check_point(&mooring, evolution, i, before[i], load,
                                                            gravity, step == 0, &wrong, tally));
        }
        tally->trials += trials;
        if (trials > tally->most_trials) tally->most_trials = trials;
        tally->wrong += wrong;
        tally->open += !sound;
        if (wrong || !sound)
            printf("%s seed %llu step %d: %s%s\n", CLASS[class], (unsigned long long)seed, step,
                   cps_outcome_name(report.outcome), wrong ? ", refuted" : "");
    }
    cps_evolution_destroy(evolution);
}

int main(int argc, char **argv) {
    int only = -1;
    uint64_t first;
    const int scenes = scenes_given(argc, argv, 20, &first);
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--class") == 0) only = atoi(argv[i + 1]);
    }
    bool failed = false;
    for (int class = 0; class < CLASSES; class ++) {
        if (only >= 0 && class != only) continue;
        Tally t = {0};
        for (int i = 0; i < scenes; i++) run((Class) class, first + (uint64_t)i, &t);
        printf("%-6s %d scenes, %d steps: %d open, %d wrong; %d submerged, %d floating, %d above, "
               "%d without; %.1f trials a step, at most %d; left of the forces up to %.2g; %d "
               "points touch, %d slide; %d anchors drag\n",
               CLASS[class], t.scenes, t.steps, t.open, t.wrong, t.water[1], t.water[2], t.water[3],
               t.water[0], (double)t.trials / t.steps, t.most_trials, t.left, t.touching, t.sliding,
               t.dragged);
        /* one of few may be open; every state is there */
        failed = failed || t.wrong > 0 || (scenes >= 20 && class != LEG && t.dragged == 0) ||
                 t.open > fmax(1, OPEN_SHARE * t.steps) ||
                 (scenes >= 20 && (t.water[1] == 0 || t.water[2] == 0 || t.water[3] == 0));
    }
    return failed;
}
