/* SPDX-License-Identifier: BSD-3-Clause */
/* A line as one and as several that are joined at free points is the same line.
 *                                              usage: random_joined [--scenes N] [--seed S]
 *
 * A random elastic line, with or without a bed, goes by random moves of its upper end; where it is
 * cut are clumps and buoys, given as point weights of the one line and as weights of the points. A
 * node of the one line is a point of the others: with the same reaction and the same friction on
 * the bed the two are one discrete problem. The pieces are named in any order, and some the other
 * way round. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "dice.h"
#include "scenes_given.h"

enum { MOST_PIECES = 5, MOST_ELEMENTS = 40, MOVES = 3 };

/* Places agree to this share of the length beside what the two solutions lack, by their own
 * reports: the energy of each is above the least by its gap, and so places differ from those of the
 * least by about the root of gap over scale; and a force that is left at a point, of the largest
 * one, moves a line by as much of its length. Both have been so since the same reference. Of most
 * steps these are nothing: this share of all agrees to PLACE alone. */
static const double PLACE = 1e-9, WITHIN = 0.98;
/* Forces agree to this share of the largest one beside what this strain makes, to which the tension
 * of what rests slack on the bed is known: points balance to 1e-6 of the largest force (balance.c),
 * and a soft part of the line then moves by as much of it. */
static const double FORCE = 3e-6, STRAIN = 3e-8;
/* Steps that are certified as one line and not when joined. */
static const double OPEN_SHARE = 0.005;

typedef struct Tally {
    int scenes, steps, compared, within, open_one, open_joined, not_unique, sliding, wrong;
    double place, force;
    int trials;
} Tally;

typedef struct Pair {
    CpsObstacle bed;
    double length, stiffness, weight, ends[6];
    int elements, pieces, cut[MOST_PIECES + 1]; /* node at which piece k begins */
    double hung[MOST_PIECES];                   /* [N] at the beginning of piece k */
    double friction_factor;
    bool frozen, loaded;
    CpsStage stage[MOVES], joined_stage[MOVES];
    CpsChange change[MOVES];
    CpsPointChange point_change[MOVES];
    /* the one line */
    CpsLine one;
    CpsPointWeight point_weight[MOST_PIECES];
    CpsScene one_scene;
    /* the pieces */
    CpsLine piece[MOST_PIECES];
    bool turned[MOST_PIECES];
    double piece_ends[MOST_PIECES][6];
    char name[2 * MOST_PIECES + 2][20];
    CpsPoint point[MOST_PIECES + 1];
    CpsScene joined_scene;
} Pair;

static void at_arc(const Pair *p, int node, double x[3]) {
    for (int a = 0; a < 3; a++)
        x[a] = p->ends[a] + (p->ends[3 + a] - p->ends[a]) * node / p->elements;
}

static void make_moves(Pair *p, int last_point) {
    double at[3];
    memcpy(at, &p->ends[3], sizeof at);
    const double size = p->weight * p->length;
    for (int k = 0; k < MOVES; k++) {
        p->stage[k] = cps_stage_default();
        p->stage[k].name = "move";
        p->stage[k].step_count = whole(1, 3);
        p->change[k] = (CpsChange){.line = 0, .end = CPS_END_B};
        p->point_change[k] = (CpsPointChange){.point = last_point};
        for (int a = 0; a < 3; a++) {
            at[a] += uniform(-0.15, 0.15) * p->length;
            if (a == 2 && at[a] < 0) at[a] = 0;
            const double value =
                p->loaded ? uniform(-1, 1) * size + (a == 2 ? 0.7 * size : 0) : at[a];
            p->change[k].to.value[a] = p->point_change[k].value[a] = value;
        }
        p->change[k].to.kind = p->loaded ? CPS_END_KIND_FREE : CPS_END_KIND_HELD;
        p->point_change[k].kind = p->loaded ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_HELD;
        p->stage[k].change_count = 1;
        p->stage[k].change = &p->change[k];
        p->joined_stage[k] = p->stage[k];
        p->joined_stage[k].change_count = 0;
        p->joined_stage[k].point_change_count = 1;
        p->joined_stage[k].point_change = &p->point_change[k];
    }
}

static void make_one(Pair *p) {
    p->one = cps_line_default();
    p->one.name = "one";
    p->one.length = p->length;
    p->one.element_count = p->elements;
    p->one.weight = p->weight;
    p->one.stiffness = p->stiffness;
    p->one.start = (CpsStart){.kind = CPS_START_STRAIGHT,
                              .point_count = 2,
                              .point = p->ends,
                              .axis = {0, 0, 1}};
    p->one.end[CPS_END_B].kind = CPS_END_KIND_AT_START;
    for (int k = 1; k < p->pieces; k++)
        p->point_weight[k - 1] = (CpsPointWeight){.arc_length = p->length * p->cut[k] / p->elements,
                                                  .weight = p->hung[k]};
    p->one.point_weight_count = p->pieces - 1;
    p->one.point_weight = p->point_weight;
    p->one_scene = cps_scene_default();
    p->one_scene.obstacle_count = p->bed.name ? 1 : 0;
    p->one_scene.obstacle = &p->bed;
    p->one_scene.line_count = 1;
    p->one_scene.line = &p->one;
    p->one_scene.stage_count = MOVES;
    p->one_scene.stage = p->stage;
    p->one_scene.friction_policy =
        p->frozen ? CPS_FRICTION_POLICY_FROZEN : CPS_FRICTION_POLICY_CONSISTENT;
}

/* The pieces in the order of `place`, of points in their own order. */
static void make_pieces(Pair *p, const int place[MOST_PIECES]) {
    p->joined_scene = p->one_scene;
    for (int k = 0; k <= p->pieces; k++) {
        CpsPoint *point = &p->point[k];
        *point = cps_point_default();
        snprintf(p->name[MOST_PIECES + k], sizeof p->name[0], "point%d", k);
        point->name = p->name[MOST_PIECES + k];
        at_arc(p, p->cut[k], point->position);
        if (k > 0 && k < p->pieces) {
            point->kind = CPS_POINT_KIND_FREE;
            point->weight = p->hung[k];
        }
    }
    for (int k = 0; k < p->pieces; k++) {
        CpsLine *line = &p->piece[place[k]];
        const int from = p->turned[k] ? k + 1 : k, to = p->turned[k] ? k : k + 1;
        *line = p->one;
        snprintf(p->name[k], sizeof p->name[0], "piece%d", k);
        line->name = p->name[k];
        line->element_count = p->cut[k + 1] - p->cut[k];
        line->length = p->length * line->element_count / p->elements;
        line->point_weight_count = 0;
        line->point_weight = NULL;
        memcpy(&p->piece_ends[k][0], p->point[from].position, 3 * sizeof(double));
        memcpy(&p->piece_ends[k][3], p->point[to].position, 3 * sizeof(double));
        line->start.point = p->piece_ends[k];
        line->end[CPS_END_A].kind = CPS_END_KIND_POINT;
        line->end_point[CPS_END_A] = from;
        line->end[CPS_END_B].kind = CPS_END_KIND_POINT;
        line->end_point[CPS_END_B] = to;
    }
    p->joined_scene.line_count = p->pieces;
    p->joined_scene.line = p->piece;
    p->joined_scene.point_count = p->pieces + 1;
    p->joined_scene.point = p->point;
    p->joined_scene.stage = p->joined_stage;
}

static void make(Pair *p, uint64_t seed, int place[MOST_PIECES]) {
    *p = (Pair){0};
    state = 0x6a09e667f3bcc909u * (seed + 1);
    p->pieces = whole(2, MOST_PIECES);
    p->elements = whole(2 * MOST_PIECES, MOST_ELEMENTS);
    p->length = pow(10, uniform(-1, 3));
    p->weight = pow(10, uniform(-1, 4));
    p->stiffness = p->weight * p->length * pow(10, uniform(1.5, 5));
    p->frozen = chance(0.3);
    p->loaded = chance(0.3);
    if (chance(0.7)) {
        p->bed = cps_obstacle_default();
        p->bed.name = "bed";
        p->bed.friction = chance(0.2) ? 0 : uniform(0.05, 1.2);
    }
    const double turn = uniform(-3, 3), rise = chance(0.5) ? 0 : uniform(0, 0.5);
    p->ends[3] = p->length * cos(turn) * sqrt(1 - rise * rise);
    p->ends[4] = p->length * sin(turn) * sqrt(1 - rise * rise);
    p->ends[5] = p->length * rise;
    for (int k = 0; k <= p->pieces; k++) p->cut[k] = k * p->elements / p->pieces;
    for (int k = 1; k < p->pieces; k++)
        p->hung[k] = chance(0.5) ? 0 : uniform(-0.2, 0.6) * p->weight * p->length;
    for (int k = 0; k < p->pieces; k++) {
        p->turned[k] = chance(0.4);
        place[k] = k;
    }
    for (int k = p->pieces - 1; k > 0; k--) {
        const int other = whole(0, k), kept = place[k];
        place[k] = place[other];
        place[other] = kept;
    }
    make_moves(p, p->pieces);
    make_one(p);
    make_pieces(p, place);
}

static void fail(uint64_t seed, const CpsError *err) {
    printf("seed %llu: %s\n", (unsigned long long)seed, err->message);
    exit(1);
}

/* By how much the two solutions may differ, by their reports, per length. */
static double lacking(const Pair *p, const CpsEvolution *one, const CpsEvolution *joined) {
    const CpsCertificate whole_line = cps_evolution_line_report(one, 0).certificate;
    double worst = whole_line.gap / whole_line.scale, left = 0, force = whole_line.largest_force;
    for (int k = 0; k < p->pieces; k++) {
        const CpsCertificate piece = cps_evolution_line_report(joined, k).certificate;
        worst = fmax(worst, piece.gap / piece.scale);
        force = fmax(force, piece.largest_force);
    }
    for (int k = 1; k < p->pieces; k++) {
        const CpsPointReport report = cps_evolution_point_report(joined, k);
        const double *r = report.residual;
        left = fmax(left, hypot(hypot(r[0], r[1]), r[2]));
    }
    return 2 * sqrt(worst) + left / force;
}

/* Compare the configurations after a step; `lacks`: lacking() since the same reference. */
static void compare(const Pair *p, double lacks, const int place[MOST_PIECES],
                    const CpsEvolution *one, const CpsEvolution *joined, uint64_t seed, int step,
                    Tally *tally) {
    const CpsLineView whole_line = cps_evolution_line_view(one, 0);
    double off = 0, force_off = 0, force = p->weight * p->length;
    for (int e = 0; e < p->elements; e++) force = fmax(force, whole_line.tension[e]);
    for (int k = 0; k < p->pieces; k++) {
        const CpsLineView piece = cps_evolution_line_view(joined, place[k]);
        const int n = piece.element_count;
        for (int j = 0; j <= n; j++)
            for (int a = 0; a < 3; a++)
                off = fmax(off, fabs(piece.position[3 * (p->turned[k] ? n - j : j) + a] -
                                     whole_line.position[3 * (p->cut[k] + j) + a]));
        for (int e = 0; e < n; e++)
            force_off = fmax(force_off, fabs(piece.tension[p->turned[k] ? n - 1 - e : e] -
                                             whole_line.tension[p->cut[k] + e]));
    }
    off /= p->length;
    if (force > 0) force_off /= force;
    tally->compared++;
    tally->within += off <= PLACE;
    tally->place = fmax(tally->place, off);
    tally->force = fmax(tally->force, force_off);
    if (off <= PLACE + lacks && force_off <= FORCE + STRAIN * p->stiffness / force) return;
    tally->wrong++;
    printf("seed %llu step %d: places differ by %.2g L, forces by %.2g (bed %d, mu %.3g, frozen "
           "%d, loaded %d, %d pieces, %d elements)\n",
           (unsigned long long)seed, step, off, force_off, p->bed.name != NULL, p->bed.friction,
           p->frozen, p->loaded, p->pieces, p->elements);
}

static void run(uint64_t seed, Tally *tally) {
    static Pair pair;
    int place[MOST_PIECES];
    make(&pair, seed, place);
    CpsError err;
    CpsEvolution *one = NULL, *joined = NULL;
    if (cps_evolution_create(&pair.one_scene, &one, &err) != CPS_OK) fail(seed, &err);
    if (cps_evolution_create(&pair.joined_scene, &joined, &err) != CPS_OK) fail(seed, &err);
    tally->scenes++;
    bool same = true; /* so far, and so from the same reference */
    double lacks = 0;
    for (int step = 0; same && cps_evolution_remaining_count(one) > 0; step++) {
        if (cps_evolution_step(one, &err) != CPS_OK) fail(seed, &err);
        if (cps_evolution_step(joined, &err) != CPS_OK) fail(seed, &err);
        const CpsStepReport a = cps_evolution_report(one), b = cps_evolution_report(joined);
        tally->steps++;
        tally->trials += cps_evolution_point_report(joined, 1).trial_count;
        const bool good = cps_outcome_is_certified(a.outcome),
                   found = cps_outcome_is_certified(b.outcome);
        tally->open_one += !good;
        tally->open_joined += good && !found;
        if (good && !found)
            printf("seed %llu step %d: joined is %s\n", (unsigned long long)seed, step,
                   cps_outcome_name(b.outcome));
        const bool divided = a.substep_count > 1 || b.substep_count > 1;
        same = good && found && !divided && a.places == CPS_PLACES_UNIQUE &&
               b.places == CPS_PLACES_UNIQUE;
        tally->not_unique += good && found && !same;
        tally->sliding += cps_evolution_line_report(one, 0).slipping > 0;
        lacks = fmax(lacks, lacking(&pair, one, joined));
        if (same) compare(&pair, lacks, place, one, joined, seed, step, tally);
    }
    cps_evolution_destroy(one);
    cps_evolution_destroy(joined);
}

int main(int argc, char **argv) {
    uint64_t first;
    const int scenes = scenes_given(argc, argv, 100, &first);
    Tally tally = {0};
    for (int i = 0; i < scenes; i++) run(first + (uint64_t)i, &tally);
    printf("%d scenes, %d steps, %.1f trials a step: %d compared, of which places differ by up to "
           "%.2g L and forces by up to %.2g, %d by no more than %g L; %d with sliding; %d open as "
           "one line, %d only when "
           "joined, %d divided or not unique; %d wrong\n",
           tally.scenes, tally.steps, (double)tally.trials / tally.steps, tally.compared,
           tally.place, tally.force, tally.within, PLACE, tally.sliding, tally.open_one,
           tally.open_joined, tally.not_unique, tally.wrong);
    if (scenes > 1 && tally.within < WITHIN * tally.compared) return 1;
    return tally.wrong > 0 || tally.open_joined > fmax(1, OPEN_SHARE * tally.steps);
}
