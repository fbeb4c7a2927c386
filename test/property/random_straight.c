/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows of inextensible lines that are pulled exactly straight, with loads across them.
 *                                                       usage: random_straight [--scenes N]
 *
 * The points between two to five lines in a row, which together are as long as the distance of
 * their held ends, have only one place. A load across has no finite tension to balance it; the
 * answer is that of lines a little longer, or none. Whatever is certified must balance at every
 * point, by the loads on it and the forces that the lines say they have, to a share of what acts on
 * the row and not of the tension in it; friction must obey Coulomb's law. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "dice.h"

enum { MOST_LINES = 5, MOST_POINTS = MOST_LINES + 1, STAGES = 3 };
/* What may be left at a point, per what acts: the tolerance of a balance is 1e-6. */
static const double LEFT = 1.5e-6;
/* No place is farther off, per length of the row: a line may be longer by 1e-9, which lets a row of
 * two equal ones give way sideways by sqrt(2e-9 / 4). */
static const double OFF = 2.3e-5;
/* A line longer by 1e-9 and pulled in the middle has a tension of a hundredth of a million loads at
 * most; in a row of several with small loads beside a large one, and along it, somewhat more. */
static const double STRONGEST = 2e5;

static double norm(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

typedef struct Row {
    CpsObstacle bed;
    CpsLine line[MOST_LINES];
    CpsPoint point[MOST_POINTS];
    CpsPointChange change[STAGES][MOST_POINTS];
    CpsStage stage[STAGES];
    CpsScene scene;
    double place[MOST_POINTS][3], length, force, friction;
    bool has_bed;
} Row;

static const char *const LINE[] = {"l0", "l1", "l2", "l3", "l4"}, *const POINT[] = {"p0", "p1",
                                                                                    "p2", "p3",
                                                                                    "p4", "p5"},
                         *const STAGE[] = {"s0", "s1", "s2"};

/* Unit direction: level where a bed is below. */
static void draw_direction(bool level, double d[3]) {
    const double turn = uniform(0, 6.3), up = level ? 0 : uniform(-1, 1);
    d[0] = cos(turn) * sqrt(1 - up * up);
    d[1] = sin(turn) * sqrt(1 - up * up);
    d[2] = up;
}

static void make_lines(Row *row, int lines) {
    double from[3], along[3], size = pow(10, uniform(-1, 3)), sum = 0;
    draw_direction(row->has_bed, along);
    for (int a = 0; a < 3; a++) from[a] = a == 2 && row->has_bed ? 0 : uniform(-1, 1) * size;
    memcpy(row->place[0], from, sizeof from);
    for (int i = 0; i < lines; i++) {
        CpsLine *line = &row->line[i];
        *line = cps_line_default();
        line->name = LINE[i];
        line->length = size * uniform(0.3, 1);
        line->element_count = whole(1, 4);
        line->weight = uniform(0, 1) < 0.4 ? 0 : row->force / size * uniform(0, 1);
        line->stiffness = INFINITY;
        line->start.kind = CPS_START_STATIC;
        const bool turned = uniform(0, 1) < 0.5;
        for (int end = 0; end < 2; end++) {
            line->end[end].kind = CPS_END_KIND_POINT;
            line->end_point[end] = turned ? i + 1 - end : i + end;
        }
        sum += line->length;
        for (int a = 0; a < 3; a++) row->place[i + 1][a] = from[a] + sum * along[a];
    }
    row->length = sum;
}

static void make(Row *row, uint64_t seed) {
    memset(row, 0, sizeof *row);
    state = 0x51c6d27f2c3e6c1fu * (seed + 1);
    const int lines = whole(2, MOST_LINES);
    row->force = pow(10, uniform(-1, 4));
    row->has_bed = uniform(0, 1) < 0.5;
    row->bed = cps_obstacle_default();
    row->bed.name = "bed";
    row->bed.friction = row->friction = uniform(0, 1) < 0.2 ? 0 : uniform(0.05, 5);
    row->scene = cps_scene_default();
    row->scene.obstacle = &row->bed;
    row->scene.obstacle_count = row->has_bed;
    make_lines(row, lines);
    for (int i = 0; i <= lines; i++) {
        const bool held = i == 0 || i == lines;
        row->point[i] = cps_point_default();
        row->point[i].name = POINT[i];
        row->point[i].kind = held ? CPS_POINT_KIND_HELD : CPS_POINT_KIND_FREE;
        memcpy(row->point[i].position, row->place[i], sizeof row->place[i]);
        row->point[i].weight = held ? 0 : row->force * uniform(0, 1);
    }
    for (int k = 0; k < STAGES; k++) {
        CpsStage *stage = &row->stage[k];
        *stage = cps_stage_default();
        stage->name = STAGE[k];
        stage->point_change = row->change[k];
        for (int i = 1; i < lines; i++) {
            CpsPointChange *change = &row->change[k][stage->point_change_count++];
            *change = (CpsPointChange){.point = i, .kind = CPS_POINT_KIND_FREE};
            for (int a = 0; a < 3; a++) change->value[a] = 3 * row->force * uniform(-1, 1);
        }
    }
    row->scene.line = row->line;
    row->scene.line_count = lines;
    row->scene.point = row->point;
    row->scene.point_count = lines + 1;
    row->scene.stage = row->stage;
    row->scene.stage_count = STAGES;
}

/* Add what the lines say that they do to the points, and what acts on them; returns the largest
 * tension. */
static double add_lines(const Row *row, const CpsEvolution *evolution, double sum[][3],
                        double *acts) {
    double most = 0;
    for (int i = 0; i < row->scene.line_count; i++) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        const CpsLine *line = &row->line[i];
        *acts = fmax(*acts, line->weight * line->length);
        for (int end = 0; end < 2; end++) {
            const int e = end == CPS_END_A ? 0 : view.element_count - 1;
            const double *p = &view.segment_force[3 * e], by = end == CPS_END_A ? 1 : -1;
            double *to = sum[line->end_point[end]];
            for (int a = 0; a < 3; a++) to[a] += by * p[a];
            to[2] -= 0.5 * view.element_length[e] * line->weight;
            most = fmax(most, norm(p));
        }
    }
    return most;
}

static bool is_wrong(const Row *row, const CpsEvolution *evolution, int step) {
    double sum[MOST_POINTS][3] = {{0}}, acts = 0, worst = 0, off = 0;
    bool slips = false;
    const double strongest = add_lines(row, evolution, sum, &acts);
    for (int i = 1; i < row->scene.line_count; i++) {
        const double *force = row->change[step > 0 ? step - 1 : 0][i - 1].value;
        const double share = step > 0 ? 1 : 0;
        double load[3] = {0, 0, -row->point[i].weight};
        for (int a = 0; a < 3; a++) load[a] += share * force[a];
        acts = fmax(acts, norm(load));
        for (int a = 0; a < 3; a++) sum[i][a] += load[a];
    }
    for (int i = 1; i < row->scene.line_count; i++) {
        const CpsPointReport at = cps_evolution_point_report(evolution, i);
        const double mu = step > 0 ? row->friction : 0;
        double away[3];
        for (int a = 0; a < 3; a++) {
            sum[i][a] += at.reaction * at.normal[a] + at.friction[a];
            away[a] = at.position[a] - row->place[i][a];
        }
        worst = fmax(worst, norm(sum[i]) / acts);
        off = fmax(off, norm(away) / row->length);
        slips = slips || at.reaction < 0 || norm(at.friction) > mu * at.reaction + LEFT * acts;
    }
    const bool wrong =
        !(worst <= LEFT) || !(off <= OFF) || slips || !(strongest <= STRONGEST * acts);
    if (wrong)
        printf("  left %.3g of what acts, off by %.3g of the length, tension %.3g times what acts, "
               "friction %s\n",
               worst, off, strongest / acts, slips ? "beyond its bound" : "obeys");
    return wrong;
}

int main(int argc, char **argv) {
    int scenes = 200, steps = 0, certified = 0, wrong = 0;
    for (int i = 1; i + 1 < argc; i += 2)
        if (strcmp(argv[i], "--scenes") == 0) scenes = atoi(argv[i + 1]);
    for (int seed = 0; seed < scenes; seed++) {
        static Row row;
        CpsEvolution *evolution = NULL;
        CpsError err;
        make(&row, (uint64_t)seed);
        if (cps_evolution_create(&row.scene, &evolution, &err) != CPS_OK) {
            printf("seed %d: %s\n", seed, err.message);
            return 1;
        }
        for (int step = 0; cps_evolution_remaining_count(evolution) > 0; step++, steps++) {
            if (cps_evolution_step(evolution, &err) != CPS_OK) return 1;
            const CpsOutcome outcome = cps_evolution_report(evolution).outcome;
            if (!cps_outcome_is_certified(outcome)) {
                printf("seed %d step %d: %s\n", seed, step, cps_outcome_name(outcome));
                continue;
            }
            certified++;
            if (!is_wrong(&row, evolution, step)) continue;
            printf("seed %d step %d: wrong\n", seed, step);
            wrong++;
        }
        cps_evolution_destroy(evolution);
    }
    printf("%d scenes, %d steps, %d certified, %d wrong\n", scenes, steps, certified, wrong);
    /* one in 200 may have no answer, of few a few more */
    return wrong > 0 || steps - certified > fmax(6, 0.005 * steps);
}
