/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness at points, ends and bodies of random graphs, whose free points follow.
 *                                            usage: random_following [--soft] [--scenes N] [--seed
 * S]
 *
 * Lines join three to five held points, of which up to two are on a held body, by way of one to six
 * free points, with clumps and given forces, on a bed, on a ball or off both; some with a buoy at
 * the surface, a point in a ball or on a rail, or an anchor that drags. All go by one or two random
 * moves; after the last one the stiffness of one held point, of the ends there, and of the body is
 * compared with
 *
 *   step   the same move taken again from the saved state before it, to places beside its own;
 *   stick  a scene that begins where lines and points now are, with three times the friction, so
 *          that all that touches is inside its bound, moved to these places.
 *
 * In both the free points find their places anew. Central differences by two distances,
 * extrapolated, are the stiffness where no node and no point changes its state between them and the
 * two agree. Of what is compared a given share must have points that lie, that slide, and more than
 * one that follows.
 *
 * The last move is also taken with the body free under the force and moment that held it. It
 * comes to the same pose, and the stiffness in its report is to be that of the step. With --soft
 * beds and balls give: the lines have no stiffness there, and that in the report of the body alone
 * is compared. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "dice.h"
#include "scenes_given.h"

enum { POINTS = 12, LINES = 24, ELEMENTS = 12, MOVES = 2, UNKNOWNS = 6, HELD = 5, FREE = 6 };
/* beside the kinds of stiffness: what a free body reports */
enum { REPORT = CPS_STIFFNESS_STICK + 1 };

/* Differences from the matrix per size of it, lengths in sizes of the scene: forces of a step are
 * known to 1e-10 of the largest one, and the distances are 1e-5 of the size. */
static const double AGREE = 1e-5, SMOOTH = 2e-5, DISTANCE = 2e-5;
/* Steps whose gap is rounding, and what nothing balances at their points over the largest force. */
static const double ROUNDING = 1e-12, BALANCED = 1e-10;
/* A pose is the same, per size and in radians: what forces balanced to 1e-10 leave of places. */
static const double SAME_POSE = 1e-7;
/* The stiffness of the water at a body in units of a line's weight. */
static const double STEADY = 100;
/* Shares of what is compared. */
static const double LYING = 0.3, SLIDING = 0.1, SEVERAL = 0.3;

typedef struct Graph {
    double size, weight;
    CpsObstacle obstacle[2];
    CpsLine line[LINES];
    CpsPoint point[POINTS];
    CpsBody body;
    char name[LINES + POINTS][16];
    CpsPointChange change[MOVES][POINTS];
    CpsBodyChange pose[MOVES];
    CpsStage move[MOVES];
    CpsScene scene;
    int moves, target; /* target: the held point that moves */
} Graph;

typedef struct Tally {
    int scenes, open, compared[2][3], reported, elsewhere, changed, rough, wrong, not_finite;
    int lying, sliding, several, floating, dragging, in_set, outcome[2][8];
    double worst[REPORT + 1];
} Tally;

static void need(CpsStatus status, const CpsError *err) {
    if (status == CPS_OK) return;
    fprintf(stderr, "%s: %s\n", err->where, err->message);
    exit(1);
}

/* the scene ------------------------------------------------------------------------------------ */

static int add_point(Graph *g, CpsPointKind kind, double x, double y, double z) {
    const int i = g->scene.point_count++;
    CpsPoint *point = &g->point[i];
    *point = cps_point_default();
    snprintf(g->name[LINES + i], sizeof g->name[0], "p%d", i);
    point->name = g->name[LINES + i];
    point->kind = kind;
    point->position[0] = x;
    point->position[1] = y;
    point->position[2] = z;
    return i;
}

static void place_of(const Graph *g, int i, double out[3]) {
    for (int a = 0; a < 3; a++)
        out[a] = g->point[i].position[a] +
                 (g->point[i].kind == CPS_POINT_KIND_ON_BODY ? g->body.position[a] : 0);
}

static void add_line(Graph *g, int from, int to, double longer) {
    const int i = g->scene.line_count++;
    CpsLine *line = &g->line[i];
    double a[3], b[3], far = 0;
    place_of(g, from, a);
    place_of(g, to, b);
    for (int k = 0; k < 3; k++) far += (a[k] - b[k]) * (a[k] - b[k]);
    *line = cps_line_default();
    snprintf(g->name[i], sizeof g->name[0], "l%d", i);
    line->name = g->name[i];
    line->length = longer * sqrt(far);
    line->element_count = whole(3, ELEMENTS);
    line->weight = g->weight * uniform(0.5, 1.5);
    line->stiffness = g->weight * g->size * pow(10, uniform(1, 3.5));
    line->start.kind = CPS_START_STATIC;
    const bool turned = chance(0.5);
    line->end[turned].kind = line->end[!turned].kind = CPS_END_KIND_POINT;
    line->end_point[turned] = from;
    line->end_point[!turned] = to;
}

static void make_obstacles(Graph *g) {
    g->scene.obstacle = g->obstacle;
    for (int k = 0; k < 2; k++) {
        g->obstacle[k] = cps_obstacle_default();
        g->obstacle[k].friction = chance(0.2) ? 0 : uniform(0.05, 1);
    }
    g->obstacle[0].name = "bed";
    g->obstacle[1].name = "ball";
    g->obstacle[1].kind = CPS_OBSTACLE_SPHERE;
    g->obstacle[1].radius = 0.45 * g->size;
    g->obstacle[1].point[2] = -0.45 * g->size;
    g->scene.obstacle_count = chance(0.8) ? 1 : 0;
    if (g->scene.obstacle_count > 0 && chance(0.3)) g->obstacle[0] = g->obstacle[1];
}

/* Held points about the middle, the first two on the body where there is one. */
static void make_held(Graph *g, int held) {
    const bool has_body = chance(0.4);
    g->body = cps_body_default();
    g->body.name = "body";
    g->body.kind = CPS_BODY_KIND_HELD;
    g->body.position[2] = g->size;
    g->body.weight = g->weight * g->size;
    for (int i = 0; i < UNKNOWNS; i++) /* so that it is stable as well where it is free */
        g->body.hydrostatics[7 * i] = STEADY * g->weight * (i < 3 ? 1 : g->size * g->size);
    g->scene.body_count = has_body;
    g->scene.body = &g->body;
    for (int i = 0; i < held; i++) {
        const double turn = 6.2831853 * i / held + uniform(-0.3, 0.3);
        const bool on = has_body && i < 2;
        const double out = (on ? 0.2 : uniform(0.7, 1.2)) * g->size,
                     z = on            ? -0.1 * g->size
                         : chance(0.5) ? 0.01 * g->size
                                       : uniform(0.2, 1) * g->size;
        const int point = add_point(g, on ? CPS_POINT_KIND_ON_BODY : CPS_POINT_KIND_HELD,
                                    out * cos(turn), out * sin(turn), z);
        g->point[point].body = 0;
        if (!on) g->target = point;
    }
}

/* A buoy, a point in a set, or an anchor that drags. */
static void make_special(Graph *g, int held) {
    CpsPoint *knot = &g->point[held];
    if (g->scene.obstacle_count > 0) {
        CpsPoint *anchor = &g->point[g->scene.body_count ? 2 : 0];
        if (anchor == &g->point[g->target] || !chance(0.3)) return;
        anchor->has_holding_capacity = anchor->drags = true;
        anchor->holding_capacity = g->weight * g->size * pow(10, uniform(-1, 0.5));
    } else if (chance(0.4)) {
        g->scene.has_water_surface = true;
        g->scene.water_surface = 0.5 * g->size;
        knot->weight = -g->weight * g->size * uniform(1, 3);
        knot->displaced_weight = g->weight * g->size * uniform(2, 6);
    } else if (chance(0.6)) {
        CpsConstraint *on = &knot->constraint;
        on->kind = chance(0.5) ? CPS_CONSTRAINT_KIND_BALL : CPS_CONSTRAINT_KIND_RAIL;
        on->radius = 0.2 * g->size;
        on->length = INFINITY;
        for (int a = 0; a < 3; a++) on->axis[a] = uniform(-1, 1);
        memcpy(on->point, knot->position, sizeof on->point);
    }
}

static void make_moves(Graph *g) {
    g->moves = whole(1, MOVES);
    for (int k = 0; k < g->moves; k++) {
        CpsStage *move = &g->move[k];
        *move = cps_stage_default();
        move->name = "move";
        move->point_change = g->change[k];
        for (int i = 0; i < g->scene.point_count; i++) {
            if (g->point[i].kind == CPS_POINT_KIND_ON_BODY) continue;
            CpsPointChange *change = &g->change[k][move->point_change_count++];
            *change = (CpsPointChange){.point = i, .kind = g->point[i].kind};
            for (int a = 0; a < 3; a++)
                change->value[a] = g->point[i].kind == CPS_POINT_KIND_FREE
                                       ? uniform(-0.2, 0.2) * g->weight * g->size
                                       : g->point[i].position[a] + uniform(0, 0.08) * g->size;
        }
        move->body_change = &g->pose[k];
        move->body_change_count = g->scene.body_count;
        g->pose[k] = (CpsBodyChange){.kind = CPS_BODY_KIND_HELD, .rotation = {1, 0, 0, 0}};
        for (int a = 0; a < 3; a++)
            g->pose[k].position[a] = g->body.position[a] + uniform(-0.05, 0.05) * g->size;
    }
}

/* Obstacles give, by no more than some hundredths of the size under the weights there are. */
static void make_soft(Graph *g) {
    g->obstacle[0].stiffness = g->weight / (g->size * g->size) * pow(10, uniform(2, 5));
    for (int i = 0; i < g->scene.line_count; i++)
        g->line[i].bearing_width = g->size * uniform(0.001, 0.02);
    for (int i = 0; i < g->scene.point_count; i++)
        if (g->point[i].kind == CPS_POINT_KIND_FREE && chance(0.7))
            g->point[i].bearing_area = g->size * g->size * uniform(0.001, 0.05);
}

static void make(Graph *g, bool soft, uint64_t seed) {
    memset(g, 0, sizeof *g);
    state = 0x6a09e667f3bcc909u * (seed + 1);
    g->scene = cps_scene_default();
    g->size = pow(10, uniform(0, 2));
    g->weight = pow(10, uniform(0, 3));
    make_obstacles(g);
    const int held = whole(3, HELD), knots = whole(1, FREE);
    make_held(g, held);
    for (int k = 0; k < knots; k++) {
        const double z = uniform(0.01, 0.4) * g->size, y = uniform(-0.3, 0.3) * g->size,
                     x = uniform(-0.3, 0.3) * g->size;
        const int knot = add_point(g, CPS_POINT_KIND_FREE, x, y, z);
        if (chance(0.6)) g->point[knot].weight = uniform(0, 1.5) * g->weight * g->size;
        for (int j = 0; j < k; j++)
            if (j == k - 1 || chance(0.3)) add_line(g, held + j, knot, uniform(0.95, 1.2));
    }
    for (int i = 0; i <= held; i++) {
        const double longer = uniform(0.95, 1.15);
        add_line(g, i < held ? i : g->target, held + whole(0, knots - 1), longer);
    }
    g->scene.line = g->line;
    g->scene.point = g->point;
    g->scene.solver.max_halvings = 0; /* the step is one substep, or it is not compared */
    make_special(g, held);
    make_moves(g);
    if (soft && g->scene.obstacle_count > 0) make_soft(g);
}

/* differences ---------------------------------------------------------------------------------- */

/* What must stay the same for the forces to be smooth. */
typedef struct States {
    unsigned char state[LINES][ELEMENTS + 1], taut[LINES][ELEMENTS], point[POINTS], water[POINTS],
        drags[POINTS], set[POINTS];
} States;

static States states_of(const CpsEvolution *evolution) {
    States out = {0};
    for (int i = 0; i < cps_evolution_line_count(evolution); i++) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        memcpy(out.state[i], view.state, (size_t)view.element_count + 1);
        for (int e = 0; e < view.element_count; e++) out.taut[i][e] = view.tension[e] > 0;
    }
    for (int i = 0; i < cps_evolution_point_count(evolution); i++) {
        const CpsPointReport report = cps_evolution_point_report(evolution, i);
        out.point[i] = (unsigned char)report.state;
        out.water[i] = (unsigned char)report.water;
        out.drags[i] = report.dissipated > 0;
        out.set[i] = cps_evolution_point_constraint_report(evolution, i).is_active;
    }
    return out;
}

/* Solved to rounding, in one substep. */
static bool is_clean(const CpsEvolution *evolution) {
    double most = 0;
    if (cps_evolution_report(evolution).outcome != CPS_OUTCOME_SOLVED) return false;
    for (int i = 0; i < cps_evolution_line_count(evolution); i++) {
        const CpsLineReport report = cps_evolution_line_report(evolution, i);
        most = fmax(most, report.certificate.largest_force);
        if (report.outcome != CPS_OUTCOME_SOLVED || report.substep_count != 1 ||
            !(report.certificate.gap <= ROUNDING * report.certificate.scale))
            return false;
    }
    for (int i = 0; i < cps_evolution_point_count(evolution); i++) {
        const double *left = cps_evolution_point_report(evolution, i).residual;
        for (int a = 0; a < 3; a++)
            if (!(fabs(left[a]) <= BALANCED * most)) return false;
    }
    return true;
}

/* Where displaced steps begin, and the targets beside which they end. */
typedef struct Origin {
    CpsEvolution *evolution;
    void *saved;
    CpsPointChange point[POINTS];
    CpsBodyChange pose;
    CpsStage move;
} Origin;

static void save(Origin *origin) {
    free(origin->saved);
    origin->saved = malloc(cps_evolution_state_size(origin->evolution));
    if (!origin->saved) exit(1);
    cps_evolution_save(origin->evolution, origin->saved);
}

/* The forces on the lines at what moves: of the target all lines, and then each end there; or of
 * the body, with moments about its reference point. */
typedef struct Forces {
    double all[UNKNOWNS], end[LINES][3];
} Forces;

static Forces forces_of(const Graph *g, const CpsEvolution *evolution, bool of_body) {
    Forces out = {{0}, {{0}}};
    const CpsPointReport point = cps_evolution_point_report(evolution, g->target);
    const CpsBodyReport body = cps_evolution_body_report(evolution, 0);
    for (int a = 0; a < UNKNOWNS; a++)
        out.all[a] = of_body ? -body.lines[a] - body.load[a] : a < 3 ? -point.lines[a] : 0;
    if (of_body) return out;
    for (int i = 0; i < g->scene.line_count; i++)
        for (int end = 0; end < 2; end++)
            if (g->line[i].end_point[end] == g->target)
                memcpy(out.end[i], cps_evolution_line_report(evolution, i).end[end].force,
                       sizeof out.end[i]);
    return out;
}

/* ... with the target, or the body, displaced by `by` in direction d; false: another state. */
static bool forces_at(const Graph *g, Origin *from, bool of_body, int d, double by,
                      const States *same, Forces *out) {
    CpsError err;
    CpsPointChange point[POINTS];
    CpsBodyChange pose = from->pose;
    CpsStage move = from->move;
    memcpy(point, from->point, sizeof point);
    move.point_change = point;
    move.body_change = &pose;
    const int shifted = of_body ? 0 : move.point_change_count;
    for (int i = 0; i < shifted; i++)
        if (point[i].point == g->target) point[i].value[d] += by;
    if (of_body && d < 3) pose.position[d] += by;
    if (of_body && d >= 3) { /* after a rotation of 0 */
        pose.rotation[0] = cos(by / 2);
        pose.rotation[1 + d - 3] = sin(by / 2);
    }
    const size_t size = cps_evolution_state_size(from->evolution);
    need(cps_evolution_load(from->evolution, from->saved, size, &err), &err);
    need(cps_evolution_move(from->evolution, &move, &err), &err);
    *out = forces_of(g, from->evolution, of_body);
    const States now = states_of(from->evolution);
    return is_clean(from->evolution) && memcmp(&now, same, sizeof now) == 0;
}

/* Derivatives of the forces by two distances, extrapolated, into column d of `k`; returns how far
 * the two differ. */
static double column_of(const double far[2], const double near[2], double h, double *out) {
    const double wide = (far[0] - far[1]) / (2 * h), narrow = (near[0] - near[1]) / h;
    *out = narrow + (narrow - wide) / 3;
    return fabs(narrow - wide);
}

typedef struct Matrices {
    double all[UNKNOWNS][UNKNOWNS], end[LINES][3][3], rough, size;
} Matrices;

static bool differences(const Graph *g, Origin *from, bool of_body, const States *same,
                        Matrices *out) {
    *out = (Matrices){.rough = 0};
    for (int d = 0; d < (of_body ? UNKNOWNS : 3); d++) {
        Forces at[4];
        const double unit = d < 3 ? 1 : g->size, h = DISTANCE * g->size / unit;
        for (int i = 0; i < 4; i++)
            if (!forces_at(g, from, of_body, d, h * (i % 2 ? -1 : 1) / (i / 2 ? 2 : 1), same,
                           &at[i]))
                return false;
        for (int b = 0; b < UNKNOWNS; b++) {
            const double units = unit * (b < 3 ? 1 : g->size);
            const double rough =
                column_of((const double[2]){at[0].all[b], at[1].all[b]},
                          (const double[2]){at[2].all[b], at[3].all[b]}, h, &out->all[b][d]) /
                units;
            out->rough = fmax(out->rough, rough);
            out->size += pow(out->all[b][d] / units, 2);
        }
        if (of_body) continue;
        for (int i = 0; i < g->scene.line_count; i++)
            for (int b = 0; b < 3; b++)
                column_of((const double[2]){at[0].end[i][b], at[1].end[i][b]},
                          (const double[2]){at[2].end[i][b], at[3].end[i][b]}, h,
                          &out->end[i][b][d]);
    }
    /* all that hangs at one point alone goes with it, and has no stiffness: that of a weight */
    out->size = fmax(sqrt(out->size), g->weight);
    return true;
}

/* Everything where it is, as the start of a scene in which all that touches sticks. */
static CpsEvolution *stuck(const Graph *g, const CpsEvolution *now) {
    static double point[LINES][3 * (ELEMENTS + 1)], tension[LINES][ELEMENTS];
    static Graph n;
    CpsError err;
    CpsEvolution *out = NULL;
    n = *g;
    for (int k = 0; k < 2; k++) n.obstacle[k].friction *= 3;
    n.scene.obstacle = n.obstacle;
    n.scene.line = n.line;
    n.scene.point = n.point;
    n.scene.body = &n.body;
    for (int i = 0; i < n.scene.line_count; i++) {
        const CpsLineView view = cps_evolution_line_view(now, i);
        const size_t elements = (size_t)view.element_count;
        memcpy(point[i], view.position, 3 * (elements + 1) * sizeof *point[i]);
        memcpy(tension[i], view.tension, elements * sizeof *tension[i]);
        n.line[i].start = (CpsStart){.kind = CPS_START_NODES,
                                     .point_count = view.element_count + 1,
                                     .point = point[i],
                                     .tension = tension[i]};
    }
    for (int k = 0; k < g->move[g->moves - 1].point_change_count; k++) {
        const CpsPointChange *change = &g->change[g->moves - 1][k];
        CpsPoint *to = &n.point[change->point];
        memcpy(to->position, cps_evolution_point_report(now, change->point).position,
               sizeof to->position);
        to->drags = false;
        if (to->kind == CPS_POINT_KIND_FREE) memcpy(to->force, change->value, sizeof to->force);
    }
    memcpy(n.body.position, cps_evolution_body_report(now, 0).position, sizeof n.body.position);
    need(cps_evolution_create(&n.scene, &out, &err), &err);
    return out;
}

/* comparison ----------------------------------------------------------------------------------- */

static void compare_entries(const Graph *g, const double *said, const double *expected, int width,
                            double size, const char *what, uint64_t seed, int kind, Tally *tally) {
    double most = 0;
    for (int i = 0; i < width * width; i++) {
        const double unit = (i / width < 3 ? 1 : g->size) * (i % width < 3 ? 1 : g->size);
        most = fmax(most, fabs(said[i] - expected[i]) / unit / size);
    }
    tally->worst[kind] = fmax(tally->worst[kind], most);
    if (most <= AGREE) return;
    fprintf(stderr, "seed %llu, %s of %s: differs by %.2g\n", (unsigned long long)seed,
            kind == REPORT ? "report" : cps_stiffness_name((CpsStiffnessKind)kind), what, most);
    tally->wrong++;
}

static bool all_finite(const double *k, int count) {
    for (int i = 0; i < count; i++)
        if (!isfinite(k[i])) return false;
    return true;
}

/* The matrices of the target and its ends, or of the body, against differences; false: not both
 * exist. */
static bool compare(const Graph *g, const CpsEvolution *now, Origin *from, const States *same,
                    CpsStiffnessKind kind, bool of_body, uint64_t seed, Tally *tally) {
    CpsError err;
    CpsStiffness point;
    CpsBodyStiffness body;
    static Matrices k;
    need(of_body ? cps_evolution_body_stiffness(now, 0, kind, &body, &err)
                 : cps_evolution_point_stiffness(now, g->target, kind, &point, &err),
         &err);
    const CpsStiffnessOutcome outcome = of_body ? body.outcome : point.outcome;
    tally->outcome[kind][outcome]++;
    tally->not_finite += of_body ? !all_finite(body.matrix, 36) || !all_finite(body.smooth, 36)
                                 : !all_finite(point.matrix, 9) || !all_finite(point.smooth, 9);
    if (outcome != CPS_STIFFNESS_OUTCOME_FOUND) return false;
    if (!differences(g, from, of_body, same, &k)) {
        tally->changed++;
        return false;
    }
    if (k.rough > SMOOTH * k.size) {
        tally->rough++;
        return false;
    }
    tally->compared[kind][of_body ? 1 : 0]++;
    if (of_body) {
        compare_entries(g, body.matrix, k.all[0], 6, k.size, "the body", seed, kind, tally);
        return true;
    }
    double all[9];
    for (int i = 0; i < 9; i++) all[i] = k.all[i / 3][i % 3];
    compare_entries(g, point.matrix, all, 3, k.size, "a point", seed, kind, tally);
    for (int i = 0; i < g->scene.line_count; i++)
        for (int end = 0; end < 2; end++) {
            if (g->line[i].end_point[end] != g->target) continue;
            need(cps_evolution_stiffness(now, i, end, kind, &point, &err), &err);
            tally->compared[kind][2]++;
            compare_entries(g, point.matrix, k.end[i][0], 3, k.size, "an end", seed, kind, tally);
        }
    return true;
}

/* The last move with the body free; false where it does not come to the same pose and states. */
static bool set_free(const Graph *g, const CpsEvolution *now, Origin *from, const States *same,
                     CpsBodyReport *out) {
    CpsError err;
    const CpsBodyReport held = cps_evolution_body_report(now, 0);
    CpsBodyChange change = {.kind = CPS_BODY_KIND_FREE};
    CpsStage move = from->move;
    double far = 0;
    memcpy(change.force, held.support, sizeof change.force);
    memcpy(change.moment, &held.support[3], sizeof change.moment);
    move.point_change = from->point;
    move.body_change = &change;
    const size_t size = cps_evolution_state_size(from->evolution);
    need(cps_evolution_load(from->evolution, from->saved, size, &err), &err);
    need(cps_evolution_move(from->evolution, &move, &err), &err);
    *out = cps_evolution_body_report(from->evolution, 0);
    for (int a = 0; a < 3; a++)
        far = fmax(far, fabs(out->position[a] - held.position[a]) / g->size);
    const States states = states_of(from->evolution);
    return is_clean(from->evolution) && far <= SAME_POSE &&
           fabs(out->rotation[0]) >= 1 - SAME_POSE && memcmp(&states, same, sizeof states) == 0;
}

/* The stiffness that the free body reports, against differences with it held. */
static bool compare_report(const Graph *g, const CpsEvolution *now, Origin *from,
                           const States *same, uint64_t seed, Tally *tally) {
    static Matrices k;
    CpsBodyReport report;
    if (!set_free(g, now, from, same, &report)) {
        tally->elsewhere++;
        return false;
    }
    if (!differences(g, from, true, same, &k) || k.rough > SMOOTH * k.size) return false;
    tally->reported++;
    compare_entries(g, report.stiffness, k.all[0], 6, k.size, "the body", seed, REPORT, tally);
    return true;
}

static void note(const Graph *g, const CpsEvolution *now, Tally *tally) {
    bool lying = false, sliding = false;
    int knots = 0;
    const States states = states_of(now);
    for (int i = 0; i < g->scene.point_count; i++) {
        const CpsPointReport report = cps_evolution_point_report(now, i);
        tally->floating += report.water == CPS_POINT_WATER_FLOATING;
        tally->in_set += states.set[i];
        tally->dragging += g->point[i].drags && states.drags[i];
        if (g->point[i].kind != CPS_POINT_KIND_FREE) continue;
        knots++;
        lying = lying || report.reaction > 0;
        sliding = sliding || report.state == CPS_POINT_STATE_SLIP;
    }
    tally->lying += lying;
    tally->sliding += sliding;
    tally->several += knots > 1;
}

static void set_targets(const Graph *g, Origin *origin) {
    const int last = g->moves - 1;
    memcpy(origin->point, g->change[last], sizeof origin->point);
    origin->pose = g->pose[last];
    origin->move = g->move[last];
}

/* Of the step, the target and the body; false: not of the target. */
static bool compare_step(const Graph *g, const CpsEvolution *now, Origin *beside,
                         const States *same, uint64_t seed, Tally *tally) {
    const bool done = compare(g, now, beside, same, CPS_STIFFNESS_STEP, false, seed, tally);
    if (g->scene.body_count == 0) return done;
    (void)compare(g, now, beside, same, CPS_STIFFNESS_STEP, true, seed, tally);
    (void)compare_report(g, now, beside, same, seed, tally);
    return done;
}

/* Of a small cycle, likewise. */
static void compare_stick(const Graph *g, const CpsEvolution *now, const Origin *beside,
                          uint64_t seed, Tally *tally) {
    CpsError err;
    Origin rest = *beside;
    rest.saved = NULL;
    for (int k = 0; k < rest.move.point_change_count; k++) /* an anchor stays where it has come */
        if (g->point[rest.point[k].point].kind == CPS_POINT_KIND_HELD)
            memcpy(rest.point[k].value,
                   cps_evolution_point_report(now, rest.point[k].point).position,
                   sizeof rest.point[k].value);
    rest.evolution = stuck(g, now);
    need(cps_evolution_step(rest.evolution, &err), &err);
    save(&rest);
    Forces unused;
    const States none = {0};
    (void)forces_at(g, &rest, false, 0, 0, &none, &unused);
    const States sticking = states_of(rest.evolution);
    (void)compare(g, now, &rest, &sticking, CPS_STIFFNESS_STICK, false, seed, tally);
    if (g->scene.body_count > 0)
        (void)compare(g, now, &rest, &sticking, CPS_STIFFNESS_STICK, true, seed, tally);
    cps_evolution_destroy(rest.evolution);
    free(rest.saved);
}

static void try_graph(bool soft, uint64_t seed, Tally *tally) {
    static Graph g;
    CpsError err;
    Origin now = {NULL};
    make(&g, soft, seed);
    if (soft && (g.scene.body_count == 0 || g.scene.obstacle_count == 0)) return;
    tally->scenes++;
    need(cps_evolution_create(&g.scene, &now.evolution, &err), &err);
    need(cps_evolution_step(now.evolution, &err), &err);
    for (int k = 0; k < g.moves; k++) {
        save(&now);
        need(cps_evolution_move(now.evolution, &g.move[k], &err), &err);
    }
    set_targets(&g, &now);
    Origin beside = now; /* the displaced steps are those of another evolution */
    need(cps_evolution_create(&g.scene, &beside.evolution, &err), &err);
    const States same = states_of(now.evolution);
    if (!is_clean(now.evolution)) {
        tally->open++;
    } else if (soft) {
        if (compare_report(&g, now.evolution, &beside, &same, seed, tally))
            note(&g, now.evolution, tally);
    } else {
        if (compare_step(&g, now.evolution, &beside, &same, seed, tally))
            note(&g, now.evolution, tally);
        compare_stick(&g, now.evolution, &beside, seed, tally);
    }
    cps_evolution_destroy(beside.evolution);
    cps_evolution_destroy(now.evolution);
    free(now.saved);
}

/* Was enough of each kind compared? */
static bool is_enough(const Tally *t, bool soft) {
    const int of = soft ? t->reported : t->compared[CPS_STIFFNESS_STEP][0];
    return 4 * of >= t->scenes && t->lying >= LYING * of && t->sliding >= SLIDING * of &&
           t->several >= SEVERAL * of && t->dragging > 0 && t->reported > 0 &&
           (soft || (t->floating > 0 && t->in_set > 0));
}

int main(int argc, char **argv) {
    Tally t = {0};
    uint64_t first;
    const bool soft = argc > 1 && strcmp(argv[1], "--soft") == 0;
    const int scenes = scenes_given(argc - soft, &argv[soft], 100, &first);
    for (int i = 0; i < scenes; i++) try_graph(soft, first + (uint64_t)i, &t);
    printf("%d scenes, %d not solved to rounding, %d with another state beside, %d rough; of those "
           "of a point%s: %d lie, %d slide, %d with several free points; %d buoys float, %d points "
           "are on the boundary of a set, %d anchors drag\n",
           t.scenes, t.open, t.changed, t.rough, soft ? " by the report" : "", t.lying, t.sliding,
           t.several, t.floating, t.in_set, t.dragging);
    const int kinds = soft ? 0 : REPORT;
    for (int k = 0; k < kinds; k++) {
        printf("%-5s: %d points, %d bodies and %d ends, largest difference %.2g",
               cps_stiffness_name((CpsStiffnessKind)k), t.compared[k][0], t.compared[k][1],
               t.compared[k][2], t.worst[k]);
        for (int o = 1; o < 5; o++)
            printf(", %d %s", t.outcome[k][o], cps_stiffness_outcome_name((CpsStiffnessOutcome)o));
        printf("\n");
    }
    printf("reports of free bodies: %d, largest difference %.2g, %d elsewhere\n", t.reported,
           t.worst[REPORT], t.elsewhere);
    printf("%d not finite, %d wrong\n", t.not_finite, t.wrong);
    return t.wrong > 0 || t.not_finite > 0 || (scenes > 1 && !is_enough(&t, soft));
}
