/* SPDX-License-Identifier: BSD-3-Clause */
/* Free bodies on inextensible lines that are hardly longer than their ways.
 *                                          usage: random_taut_bodies [--scenes N] [--seed S]
 *
 * One or two bodies are on one to seven lines, some by way of free knots. In a pose drawn at random
 * every line is longer than its way by a share of 1e-8 to 0.5, the same for all; so there is a pose
 * within reach, and what acts has its least energy in one. The bodies begin elsewhere, turned by
 * any rotation, and are pulled by forces that change. Every step is to be certified, but for a few:
 * the lines obey their laws by the forces that they say they have (graph_proofs.h), and these
 * forces, with the weights of the half elements, balance what acts on bodies and knots, the moments
 * too. What is left is measured by loads, not by tensions, which may be ten thousand times as
 * large. */
#include <stdio.h>
#include <stdlib.h>

#include "capstan/evolve.h"
#include "dice.h"
#include "graph_proofs.h"
#include "scenes_given.h"
#include "turns.h"

enum { BODIES = 2, MOST_LINES = 28, MOST_POINTS = 2 * MOST_LINES, STAGES = 2 };
/* What may be left at a body or knot, per what acts: the tolerance of a balance is 1e-6. */
static const double LEFT = 1.5e-6;
/* What a line may leave of its laws, per largest force: its certificate is of second order, to
 * 1e-8. */
static const double LINE = 2e-4;
/* An end is where its point is, per size of the scene. */
static const double OFF = 1e-9;
static const double OPEN_SHARE = 0.005;

typedef struct Scene {
    CpsObstacle far;
    CpsLine line[MOST_LINES];
    CpsPoint point[MOST_POINTS];
    CpsBody body[BODIES];
    CpsBodyChange change[STAGES][BODIES];
    CpsStage stage[STAGES];
    char name[MOST_LINES + MOST_POINTS][12];
    CpsScene scene;
    double at[3], size, weight, share;
    double place[BODIES][3], turn[BODIES][4]; /* the pose within reach */
} Scene;

typedef struct Tally {
    int scenes, steps, open, wrong, lone, far;
    double left, strongest;
} Tally;

static void any(double size, double out[3]) {
    for (int a = 0; a < 3; a++) out[a] = size * uniform(-1, 1);
}

static void any_rotation(double q[4]) {
    double size = 0;
    for (int i = 0; i < 4; i++) q[i] = uniform(-1, 1);
    for (int i = 0; i < 4; i++) size += q[i] * q[i];
    for (int i = 0; i < 4; i++) q[i] /= sqrt(size);
}

static int add_point(Scene *s, CpsPointKind kind, const double x[3]) {
    const int i = s->scene.point_count++;
    CpsPoint *point = &s->point[i];
    *point = cps_point_default();
    snprintf(s->name[MOST_LINES + i], sizeof s->name[0], "p%d", i);
    point->name = s->name[MOST_LINES + i];
    point->kind = kind;
    memcpy(point->position, x, sizeof point->position);
    return i;
}

/* A new eye of a body; `place`: where it is in the pose within reach. */
static int add_eye(Scene *s, int body, double arm, double place[3]) {
    double own[3], r[3][3];
    any(arm, own);
    matrix_of(s->turn[body], r);
    turn_to(r, own, place);
    for (int a = 0; a < 3; a++) place[a] += s->place[body][a];
    const int i = add_point(s, CPS_POINT_KIND_ON_BODY, own);
    s->point[i].body = body;
    return i;
}

static void add_line(Scene *s, int from, int to, const double x[3], const double y[3]) {
    const int i = s->scene.line_count++;
    CpsLine *line = &s->line[i];
    double way[3];
    for (int a = 0; a < 3; a++) way[a] = y[a] - x[a];
    *line = cps_line_default();
    snprintf(s->name[i], sizeof s->name[0], "l%d", i);
    line->name = s->name[i];
    line->length = (1 + s->share) * norm(way);
    line->element_count = whole(1, 4);
    line->weight = chance(0.4) ? 0 : s->weight / s->size * uniform(0, 0.3);
    line->stiffness = INFINITY;
    line->start.kind = CPS_START_STATIC;
    const bool turned = chance(0.5);
    line->end[0].kind = line->end[1].kind = CPS_END_KIND_POINT;
    line->end_point[turned] = from;
    line->end_point[!turned] = to;
}

/* A line from an eye at x: to an anchor, to a knot on three lines, or to the first body. */
static void add_leg(Scene *s, int eye, const double x[3], bool to_body) {
    double y[3], z[3];
    if (to_body) {
        const int other = add_eye(s, 0, 0.3 * s->size, y);
        add_line(s, eye, other, x, y);
        return;
    }
    any(s->size, y);
    for (int a = 0; a < 3; a++) y[a] += x[a];
    const int end = add_point(s, chance(0.15) ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_HELD, y);
    add_line(s, eye, end, x, y);
    if (s->point[end].kind == CPS_POINT_KIND_HELD) return;
    s->point[end].weight = s->weight * uniform(0, 0.5);
    for (int k = 0; k < 3; k++) {
        any(s->size, z);
        for (int a = 0; a < 3; a++) z[a] += y[a];
        add_line(s, end, add_point(s, CPS_POINT_KIND_HELD, z), y, z);
    }
}

static void add_body(Scene *s, int k) {
    CpsBody *body = &s->body[k];
    static const char *const NAME[BODIES] = {"b0", "b1"};
    double away[3];
    const double arm = s->size * uniform(0.05, 1);
    any(s->size, s->place[k]);
    any_rotation(s->turn[k]);
    *body = cps_body_default();
    body->name = NAME[k];
    body->kind = CPS_BODY_KIND_FREE;
    any(chance(0.2) ? 0 : 2 * s->size, away);
    any_rotation(body->rotation);
    for (int a = 0; a < 3; a++) s->place[k][a] += s->at[a];
    for (int a = 0; a < 3; a++) body->fixed[a] = chance(0.07);
    for (int a = 0; a < 3; a++) body->position[a] = s->place[k][a] + (body->fixed[a] ? 0 : away[a]);
    if (chance(0.1)) {
        for (int a = 3; a < 6; a++) body->fixed[a] = true;
        memcpy(body->rotation, s->turn[k], sizeof body->rotation);
    }
    body->weight = s->weight;
    any(0.3 * arm, body->centre_of_gravity);
    if (chance(0.3)) {
        body->buoyancy = s->weight * uniform(0, 2);
        any(0.3 * arm, body->centre_of_buoyancy);
    }
    const int lines = chance(0.2) ? 1 : whole(2, 7);
    for (int i = 0; i < lines; i++) {
        double x[3];
        const int eye = add_eye(s, k, arm, x);
        add_leg(s, eye, x, k > 0 && (i == 0 || chance(0.2)));
    }
}

static void make(Scene *s, uint64_t seed) {
    memset(s, 0, sizeof *s);
    state = 0x3c6ef372a54ff53au * (seed + 1);
    s->scene = cps_scene_default();
    s->size = pow(10, uniform(-2, 3));
    s->weight = pow(10, uniform(-1, 4));
    s->share = pow(10, uniform(-8, -0.3));
    any(chance(0.7) ? 0 : 100 * s->size, s->at);
    s->scene.body_count = whole(1, BODIES);
    for (int k = 0; k < s->scene.body_count; k++) add_body(s, k);
    if (chance(0.2)) { /* all axes are the lines' own then, and nothing comes near it */
        s->far = cps_obstacle_default();
        s->far.name = "far";
        s->far.kind = CPS_OBSTACLE_SPHERE;
        s->far.radius = s->size;
        for (int a = 0; a < 3; a++) s->far.point[a] = s->at[a] + (a == 0 ? 50 * s->size : 0);
        s->scene.obstacle = &s->far;
        s->scene.obstacle_count = 1;
    }
    static const char *const STAGE[STAGES] = {"s0", "s1"};
    for (int k = 0; k < STAGES; k++) {
        s->stage[k] = cps_stage_default();
        s->stage[k].name = STAGE[k];
        s->stage[k].step_count = whole(1, 2);
        s->stage[k].body_change = s->change[k];
        s->stage[k].body_change_count = s->scene.body_count;
        for (int i = 0; i < s->scene.body_count; i++) {
            s->change[k][i] = (CpsBodyChange){.body = i, .kind = CPS_BODY_KIND_FREE};
            any(s->weight * uniform(0, 2), s->change[k][i].force);
        }
    }
    s->scene.line = s->line;
    s->scene.point = s->point;
    s->scene.body = s->body;
    s->scene.stage = s->stage;
    s->scene.stage_count = STAGES;
}

/* [N] The given force on a body in a step of the scene, of which the first is the statics. */
static void force_at(const Scene *s, int body, int step, double out[3]) {
    double from[3] = {0};
    int at = 1;
    memset(out, 0, 3 * sizeof *out);
    for (int k = 0; k < STAGES; k++) {
        const double *to = s->change[k][body].force;
        for (int part = 1; part <= s->stage[k].step_count; part++, at++)
            if (at == step)
                for (int a = 0; a < 3; a++)
                    out[a] = from[a] + (to[a] - from[a]) * part / s->stage[k].step_count;
        memcpy(from, to, sizeof from);
    }
}

typedef struct Sum {
    double force[3], moment[3];
} Sum;

static void add(Sum *to, const double force[3], const double arm[3]) {
    double moment[3];
    cross(arm, force, moment);
    for (int a = 0; a < 3; a++) {
        to->force[a] += force[a];
        to->moment[a] += moment[a];
    }
}

/* What the lines do to bodies and knots; false where an end is not where its point is. */
static bool add_lines(const Scene *s, const CpsEvolution *evolution, double r[BODIES][3][3],
                      Sum body[BODIES], double knot[][3], double *acts) {
    bool good = true;
    for (int i = 0; i < s->scene.line_count; i++) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        *acts = fmax(*acts, s->line[i].weight * s->line[i].length);
        for (int end = 0; end < 2; end++) {
            const int k = s->line[i].end_point[end], on = s->point[k].body;
            const int e = end == 0 ? 0 : view.element_count - 1, j = end == 0 ? 0 : e + 1;
            double force[3], arm[3], off[3];
            const double *x = &view.position[3 * j], *p = &view.segment_force[3 * e];
            for (int a = 0; a < 3; a++) force[a] = end == 0 ? p[a] : -p[a];
            force[2] -= 0.5 * view.element_length[e] * s->line[i].weight;
            if (s->point[k].kind == CPS_POINT_KIND_ON_BODY) {
                const CpsBodyReport at = cps_evolution_body_report(evolution, on);
                turn_to(r[on], s->point[k].position, arm);
                for (int a = 0; a < 3; a++) off[a] = at.position[a] + arm[a] - x[a];
                add(&body[on], force, arm);
            } else {
                const CpsPointReport at = cps_evolution_point_report(evolution, k);
                for (int a = 0; a < 3; a++) off[a] = at.position[a] - x[a];
                for (int a = 0; a < 3; a++) knot[k][a] += force[a];
            }
            good = good && norm(off) <= OFF * (s->size + norm(s->at));
        }
    }
    return good;
}

/* The largest that is left on a body or knot, per what acts. */
static double left_of(const Scene *s, const CpsEvolution *evolution, int step, bool *placed) {
    static double knot[MOST_POINTS][3];
    Sum body[BODIES] = {{{0}, {0}}};
    double r[BODIES][3][3], acts = 0, most = 0;
    memset(knot, 0, sizeof knot);
    for (int k = 0; k < s->scene.body_count; k++)
        matrix_of(cps_evolution_body_report(evolution, k).rotation, r[k]);
    *placed = add_lines(s, evolution, r, body, knot, &acts);
    for (int k = 0; k < s->scene.body_count; k++) {
        const CpsBody *b = &s->body[k];
        double arm[3], force[3], moment[3], reach = 0;
        turn_to(r[k], b->centre_of_gravity, arm);
        add(&body[k], (const double[3]){0, 0, -b->weight}, arm);
        turn_to(r[k], b->centre_of_buoyancy, arm);
        add(&body[k], (const double[3]){0, 0, b->buoyancy}, arm);
        force_at(s, k, step, force);
        add(&body[k], force, (const double[3]){0, 0, 0});
        force[2] += b->buoyancy - b->weight;
        acts = fmax(acts, norm(force));
        for (int i = 0; i < s->scene.point_count; i++)
            if (s->point[i].kind == CPS_POINT_KIND_ON_BODY && s->point[i].body == k)
                reach = fmax(reach, norm(s->point[i].position));
        for (int a = 0; a < 3; a++)
            moment[a] =
                b->weight * b->centre_of_gravity[a] - b->buoyancy * b->centre_of_buoyancy[a];
        acts = fmax(acts, norm(moment) / reach);
        for (int a = 0; a < 3; a++) {
            if (b->fixed[a]) body[k].force[a] = 0;
            if (b->fixed[3 + a]) body[k].moment[a] = 0;
            body[k].moment[a] /= reach;
        }
    }
    for (int k = 0; k < s->scene.body_count; k++)
        most = fmax(most, fmax(norm(body[k].force), norm(body[k].moment)));
    for (int i = 0; i < s->scene.point_count; i++) {
        if (s->point[i].kind != CPS_POINT_KIND_FREE) continue;
        acts = fmax(acts, s->point[i].weight);
        knot[i][2] -= s->point[i].weight;
        most = fmax(most, norm(knot[i]));
    }
    return most / acts;
}

static bool is_wrong(const Scene *s, const CpsEvolution *evolution, int step, Tally *tally) {
    const GraphStep at = {&s->scene, evolution, NULL, NULL, -1, s->size};
    bool good = true, placed;
    double force = 0;
    for (int i = 0; i < s->scene.line_count; i++)
        force = fmax(force, cps_evolution_line_report(evolution, i).certificate.largest_force);
    for (int i = 0; i < s->scene.line_count; i++)
        good = graph_line_holds(&at, i, LINE * force) && good;
    const double left = left_of(s, evolution, step, &placed);
    tally->left = fmax(tally->left, left);
    tally->strongest = fmax(tally->strongest, force / s->weight);
    if (good && placed && left <= LEFT) return false;
    printf("  left %.3g of what acts%s\n", left, placed ? "" : ", an end is off its point");
    return true;
}

static void run(uint64_t seed, Tally *tally) {
    static Scene s;
    CpsEvolution *evolution = NULL;
    CpsError err;
    make(&s, seed);
    if (cps_evolution_create(&s.scene, &evolution, &err) != CPS_OK) {
        printf("seed %llu: %s\n", (unsigned long long)seed, err.message);
        exit(1);
    }
    tally->scenes++;
    tally->lone += s.scene.line_count == 1;
    tally->far += s.scene.obstacle_count > 0;
    for (int step = 0; cps_evolution_remaining_count(evolution) > 0; step++) {
        if (cps_evolution_step(evolution, &err) != CPS_OK) exit(1);
        const CpsOutcome outcome = cps_evolution_report(evolution).outcome;
        const bool final = cps_outcome_is_final(outcome), open = !cps_outcome_is_certified(outcome);
        tally->steps++;
        tally->open += open && !final;
        const bool wrong = final || (!open && is_wrong(&s, evolution, step, tally));
        tally->wrong += wrong;
        if (open || wrong)
            printf("seed %llu step %d: %s%s, %d lines, %d bodies, %d obstacles, share %.2g\n",
                   (unsigned long long)seed, step, cps_outcome_name(outcome),
                   wrong ? ", wrong" : "", s.scene.line_count, s.scene.body_count,
                   s.scene.obstacle_count, s.share);
        if (open) break;
    }
    cps_evolution_destroy(evolution);
}

int main(int argc, char **argv) {
    uint64_t first;
    const int scenes = scenes_given(argc, argv, 60, &first);
    Tally t = {0};
    for (int i = 0; i < scenes; i++) run(first + (uint64_t)i, &t);
    printf(
        "%d scenes, %d on one line, %d beside a far sphere; %d steps: %d open, %d wrong; left up "
        "to %.2g of what acts, tensions up to %.2g weights\n",
        t.scenes, t.lone, t.far, t.steps, t.open, t.wrong, t.left, t.strongest);
    /* one of few may be open */
    return t.wrong > 0 || t.open > fmax(1, OPEN_SHARE * t.steps);
}
