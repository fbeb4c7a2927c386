/* SPDX-License-Identifier: BSD-3-Clause */
/* Random scenes and the same with the ends of every line named the other way round.
 *
 *   random_ends [--share S] [--class C --seed K]
 *
 * Nothing in the physics knows which end is A. Where a problem has one solution both histories lead
 * through the same places, to 1e-6 of the line's length, or what the certificates so far leave
 * open; where they part the program has to say why, in one of the two at least: a step is not
 * certified, a line jumps, or energy is not accounted for; or part of a line is slack, whose places
 * are not unique (docs/theory.md, 2). A history is compared up to the first step of which this is
 * so. Every scene is run as it is and with each stage in one load step. Each pair prints its class
 * and seed with a complaint. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "random_scene.h"

enum { SEEDS = 6 };
static const double SAME = 1e-6;

typedef double Nodes[SCENE_LINES][3 * (SCENE_ELEMENTS + 1)];

/* Give the start of every line that is an arc as its nodes, from A to B or from B to A. */
static bool by_nodes(RandomScene *s, Nodes nodes, bool backwards) {
    CpsEvolution *start;
    if (cps_evolution_create(&s->scene, &start, NULL) != CPS_OK) return false;
    for (int i = 0; i < s->scene.line_count; i++) {
        const CpsLineView view = cps_evolution_line_view(start, i);
        CpsLine *line = &s->line[i];
        if (line->start.kind != CPS_START_ARC) continue;
        for (int j = 0; j <= view.element_count; j++)
            memcpy(&nodes[i][3 * (backwards ? view.element_count - j : j)], &view.position[3 * j],
                   3 * sizeof(double));
        line->start.kind = CPS_START_POLYLINE;
        line->start.point = nodes[i];
        line->start.point_count = view.element_count + 1;
    }
    cps_evolution_destroy(start);
    return true;
}

static void turn_round(double *point, int count) {
    for (int k = 0, last = count - 1; k < last - k; k++)
        for (int a = 0; a < 3; a++) {
            const double keep = point[3 * k + a];
            point[3 * k + a] = point[3 * (last - k) + a];
            point[3 * (last - k) + a] = keep;
        }
}

/* Sections and point weights from the other end. */
static void turn_sections_round(CpsLine *line, CpsSection *section, CpsPointWeight *weight) {
    for (int k = 0, last = line->section_count - 1; k < last - k; k++) {
        const CpsSection keep = section[k];
        section[k] = section[last - k];
        section[last - k] = keep;
    }
    for (int k = 0; k < line->point_weight_count; k++)
        weight[k].arc_length = line->length - weight[k].arc_length;
    for (int k = 0, last = line->point_weight_count - 1; k < last - k; k++) {
        const CpsPointWeight keep = weight[k];
        weight[k] = weight[last - k];
        weight[last - k] = keep;
    }
}

/* The same scene, its lines from B to A; arcs are given as nodes and have been turned round. */
static void exchange(RandomScene *s) {
    for (int i = 0; i < s->scene.line_count; i++) {
        CpsLine *line = &s->line[i];
        const CpsEnd a = line->end[CPS_END_A];
        line->end[CPS_END_A] = line->end[CPS_END_B];
        line->end[CPS_END_B] = a;
        if (line->start.point == s->point[i])
            turn_round(s->point[i],
                       line->start.kind == CPS_START_STRAIGHT ? 2 : line->start.point_count);
        turn_sections_round(line, s->section[i], s->point_weight[i]);
        double *length = s->element_length[i];
        if (line->element_length)
            for (int k = 0, last = line->element_count - 1; k < last - k; k++) {
                const double keep = length[k];
                length[k] = length[last - k];
                length[last - k] = keep;
            }
    }
    for (int k = 0; k < s->scene.stage_count; k++)
        for (int i = 0; i < s->stage[k].change_count; i++)
            s->change[k][i].end = 1 - s->change[k][i].end;
}

/* [-] The farthest node of a line from that of the other, over the length. */
static double apart(const CpsLineView *one, const CpsLineView *other) {
    double most = 0;
    for (int j = 0; j <= one->element_count; j++) {
        const double *x = &one->position[3 * j],
                     *y = &other->position[3 * (one->element_count - j)];
        most = fmax(most, hypot(hypot(x[0] - y[0], x[1] - y[1]), x[2] - y[2]));
    }
    return most / one->arc_length[one->element_count];
}

/* [-] How far the certificate lets a node be off, over the length: the strain that its bound of the
 * tension's error leaves. */
static double left(const CpsLineView *view, const CpsLineReport *report) {
    const double bound = view->compliance * report->certificate.tension_bound;
    return bound > 0 ? bound : 0;
}

static bool says_so(const CpsLineReport *report) {
    return !cps_outcome_is_certified(report->outcome) || report->jump_count > 0 ||
           report->unaccounted > 0 || report->slack > 0;
}

typedef struct Count {
    int pairs, steps, said, apart, silent; /* apart: of those that said so */
    double worst;
    double left[SCENE_LINES]; /* of the history so far */
} Count;

/* Compare a step of both; false: no further. */
static bool compare(Count *count, CpsEvolution *const run[2], int class_index, int seed) {
    bool goes_on = true;
    count->steps++;
    for (int i = 0; i < cps_evolution_line_count(run[0]); i++) {
        const CpsLineView view[2] = {cps_evolution_line_view(run[0], i),
                                     cps_evolution_line_view(run[1], i)};
        const CpsLineReport report[2] = {cps_evolution_line_report(run[0], i),
                                         cps_evolution_line_report(run[1], i)};
        if (cps_outcome_is_final(report[0].outcome) && report[0].outcome == report[1].outcome)
            return false;
        const double distance = apart(&view[0], &view[1]);
        count->left[i] += left(&view[0], &report[0]) + left(&view[1], &report[1]);
        if (says_so(&report[0]) || says_so(&report[1])) {
            count->said++;
            count->apart += !(distance <= SAME);
            goes_on = false;
        } else if (!(distance <= fmax(SAME, count->left[i]))) {
            const CpsLedger l[2] = {report[0].ledger, report[1].ledger};
            printf("%s, seed %d, step %d, line %d: %.1e of the length apart; imbalance %.2e and "
                   "%.2e J, dissipated %.2e and %.2e J\n",
                   random_scene_class_name(class_index), seed,
                   cps_evolution_report(run[0]).step_count - 1, i, distance, l[0].imbalance,
                   l[1].imbalance, l[0].dissipated, l[1].dissipated);
            count->silent++;
            goes_on = false;
        } else {
            count->worst = fmax(count->worst, distance);
        }
    }
    return goes_on;
}

/* A pair, in the steps of the scene or with each stage in one. */
static void run_pair(Count *count, int class_index, int seed, bool coarse) {
    static RandomScene scene[2];
    static Nodes nodes[2];
    CpsEvolution *run[2] = {NULL, NULL};
    CpsError err = {0};
    for (int k = 0; k < 2; k++) random_scene_make(class_index, (uint64_t)seed, &scene[k]);
    if (coarse)
        for (int k = 0; k < scene[0].scene.stage_count; k++)
            scene[0].stage[k].step_count = scene[1].stage[k].step_count = 1;
    bool open = by_nodes(&scene[0], nodes[0], false) && by_nodes(&scene[1], nodes[1], true);
    exchange(&scene[1]);
    for (int k = 0; k < 2; k++)
        open = open && cps_evolution_create(&scene[k].scene, &run[k], &err) == CPS_OK;
    if (!open) {
        printf("%s, seed %d: %s\n", random_scene_class_name(class_index), seed, err.message);
        count->silent++;
    }
    count->pairs++;
    memset(count->left, 0, sizeof count->left);
    while (open && cps_evolution_remaining_count(run[0]) > 0 &&
           cps_evolution_remaining_count(run[1]) > 0) {
        for (int k = 0; k < 2; k++)
            if (cps_evolution_step(run[k], &err) != CPS_OK) abort();
        open = compare(count, run, class_index, seed);
    }
    for (int k = 0; k < 2; k++) cps_evolution_destroy(run[k]);
}

int main(int argc, char **argv) {
    double share = 1;
    int only = -1, seed = -1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--share") == 0) share = atof(argv[i + 1]);
        if (strcmp(argv[i], "--class") == 0) only = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--seed") == 0) seed = atoi(argv[i + 1]);
    }
    Count count = {0};
    const int every = share < 1 ? (int)(1 / share) : 1;
    for (int k = 0, number = 0; k < SCENE_CLASSES; k++)
        for (int s = 0; s < SEEDS; s++, number++)
            if (only >= 0 ? k == only && (seed < 0 || s == seed) : number % every == 0)
                for (int coarse = 0; coarse < 2; coarse++) run_pair(&count, k, s, coarse);
    printf("%d pairs, %d steps: largest distance of those that agree %.1e of the length; %d said "
           "why they may differ, %d of them do; %d differ and did not say so\n",
           count.pairs, count.steps, count.worst, count.said, count.apart, count.silent);
    return count.silent > 0 || count.pairs == 0;
}
