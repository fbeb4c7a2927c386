/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points that follow what moves (following.h).
 *
 * By the places u of what moves and y of the points that lines join to it, also by way of others,
 * the forces on the lines there change by
 *
 *     K_uu u + K_uy y,      K_yu u + K_yy y,
 *
 * sums of the stiffnesses of the lines for both of their ends (cable/stiffness.h). A point keeps to
 * the equation of its state (section 6d), P (K_yu u + K_yy y) + Q y = 0: off everything P = 1 and
 * Q = 0; at rest, or where an anchor holds, y = 0; on a surface n.y = 0, and where it slides by s
 * with the friction -b e, e = s/|s| and b = mu R,
 *
 *     P = 1 - n n' + mu e n',      Q = b/|s| (1 - n n' - e e') - R C + mu e (C F)',
 *
 * C the curvature of the surface, with which the reaction turns, and across which friction bears on
 * it; in what gives by the spring k
 *
 *     P = 1,                  Q = b/|s| (1 - n n' - e e') - R C + k (n - mu e) n' + n (C F)'.
 *
 * So K = K_uu - K_uy (P K_yy + Q)^-1 P K_yu. Bodies other than the one that moves stay. */
#include "evolve/following.h"

#include <math.h>
#include <string.h>

#include "cable/soft.h"
#include "cable/stiffness.h"
#include "evolve/anchors.h"
#include "evolve/bodies.h"
#include "evolve/point_motion.h"
#include "evolve/points.h"
#include "evolve/soft_point.h"
#include "evolve/trial.h"

/* A point that follows by more than so many times what moves, lengths of bodies by their arm, is
 * held by rounding alone. */
static const double TOO_FAR = 1e8;

/* What moves, and what follows it. */
typedef struct Following {
    const CpsEvolution *evolution;
    CpsiBalance *balance; /* lends its arrays; NULL: no point ever follows */
    const CpsiMoved *moved;
    CpsStiffnessKind kind;
    bool is_static; /* the step has placed the lines by statics */
    int width;      /* unknowns of what moves */
} Following;

/* what follows --------------------------------------------------------------------------------- */

/* Has an anchor given way in the step? */
static bool has_dragged(const CpsEvolution *evolution, int point) {
    const CpsiPoint *of = &evolution->points.point[point];
    return cpsi_point_drags(&evolution->points, point) &&
           vec3_norm(vec3_load(of->report.drag)) > CPS_TOUCH * of->length;
}

static bool may_follow(const Following *f, int point) {
    if (!f->balance || point == CPSI_NO_POINT || point == f->moved->point) return false;
    return f->evolution->points.point[point].kind == CPS_POINT_KIND_FREE ||
           (f->kind == CPS_STIFFNESS_STEP && has_dragged(f->evolution, point));
}

/* Does an end of a line move as what moves, or follow it? */
static bool is_moved(const Following *f, int line, int end) {
    const CpsiMoved *moved = f->moved;
    const int point = f->evolution->points.tie[2 * line + end];
    if (point == CPSI_NO_POINT) return line == moved->line && end == moved->end;
    const CpsPoint *given = &f->evolution->points.given[point];
    if (moved->body >= 0)
        return given->kind == CPS_POINT_KIND_ON_BODY && given->body == moved->body;
    return point == moved->point;
}
static int follower(const Following *f, int line, int end) {
    const int point = f->evolution->points.tie[2 * line + end];
    return f->balance && point != CPSI_NO_POINT ? f->balance->number[point] : -1;
}
static bool takes_part(const Following *f, int line) {
    for (int end = 0; end < 2; end++)
        if (is_moved(f, line, end) || follower(f, line, end) >= 0) return true;
    return false;
}

/* A point of the group of those that lines join to what moves, also by way of others. */
static int find_group(const Following *f, int *group) {
    const CpsEvolution *evolution = f->evolution;
    const int *tie = evolution->points.tie;
    int first = CPSI_NO_POINT;
    for (int i = 0; i < evolution->points.count; i++)
        group[i] = may_follow(f, i) ? i : CPSI_NO_POINT;
    for (int i = 0; i < evolution->line_count; i++)
        cpsi_group_unite(group, tie[2 * i], tie[2 * i + 1]);
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++) {
            const int point = tie[2 * i + !end];
            if (!is_moved(f, i, end) || point == CPSI_NO_POINT || group[point] == CPSI_NO_POINT)
                continue;
            cpsi_group_unite(group, first, point);
            if (first == CPSI_NO_POINT) first = point;
        }
    return first;
}

/* Number the points that follow. */
static void find_followers(const Following *f) {
    const CpsEvolution *evolution = f->evolution;
    CpsiBalance *balance = f->balance;
    if (!balance) return;
    int *group = balance->joined;
    balance->count = balance->body_count = 0;
    for (int i = 0; i < evolution->points.count; i++) balance->number[i] = -1;
    const int first = find_group(f, group);
    const int ends = first == CPSI_NO_POINT ? 0 : 2 * evolution->line_count;
    for (int i = 0; i < ends; i++) {
        const int point = evolution->points.tie[i];
        if (point == CPSI_NO_POINT || group[point] == CPSI_NO_POINT ||
            balance->number[point] >= 0 ||
            cpsi_group_first(group, point) != cpsi_group_first(group, first))
            continue;
        balance->number[point] = balance->count;
        balance->at[balance->count++] = (CpsiFree){.point = point};
    }
    balance->unknowns = 3 * balance->count;
    for (int k = 0; k < balance->count; k++) balance->node[k] = balance->at[k].point;
    cpsi_graph_matrix_use(balance->matrix, balance->count, balance->node);
}

/* From the reference point of the body that moves to a point on it. */
static Vec3 arm_of(const Following *f, int point) {
    return cpsi_pose_arm(&f->evolution->bodies.body[f->moved->body].pose,
                         f->evolution->points.given[point].position);
}

/* How an end follows from the unknowns of what moves; from those of the points. */
static CpsiJointMap map_of_moved(const Following *f, int line, int end) {
    if (!is_moved(f, line, end)) return (CpsiJointMap){.width = 0};
    if (f->moved->body < 0) return cpsi_joint_map_of_point(0);
    return cpsi_joint_map_on_body(0, arm_of(f, f->evolution->points.tie[2 * line + end]));
}
static CpsiJointMap map_of_follower(const Following *f, int line, int end) {
    const int k = follower(f, line, end);
    return k >= 0 ? cpsi_joint_map_of_point(3 * k) : (CpsiJointMap){.width = 0};
}

/* Does the force on a line at an end count? */
static bool counts(const Following *f, int line, int end) {
    return is_moved(f, line, end) &&
           (f->moved->line < 0 || (line == f->moved->line && end == f->moved->end));
}

/* the equations of points ---------------------------------------------------------------------- */

typedef CpsiFollowerRows Rows;

static Rows held(double size) {
    Rows out = {{{0}}, {{0}}};
    vec3_add_identity(out.q, size);
    return out;
}
static Rows off_everything(void) {
    Rows out = {{{0}}, {{0}}};
    vec3_add_identity(out.p, 1);
    return out;
}

/* In the plane across n, with friction of a given bound that turns with the slip s. */
static Rows in_plane(double size, Vec3 n, Vec3 s, double bound, double turns) {
    Rows out = off_everything();
    vec3_add_outer(out.p, -1, n, n);
    vec3_add_outer(out.q, size, n, n);
    if (!(bound > 0)) return out;
    const Vec3 e = vec3_scale(1 / vec3_norm(s), s);
    vec3_add_identity(out.q, bound * turns);
    vec3_add_outer(out.q, -bound * turns, n, n);
    vec3_add_outer(out.q, -bound * turns, e, e);
    return out;
}

/* [1/m] By how much the direction of a slip turns with the place across it. */
static double turn_of(const CpsiObstacle *on, double slip) {
    return on->kind == CPS_OBSTACLE_SPHERE ? 1 / (on->radius * tan(slip / on->radius)) : 1 / slip;
}

/* On an obstacle, or in one that gives by the spring k, R = k depth. */
static Rows rows_on_surface(const Following *f, int point, double size) {
    const CpsEvolution *evolution = f->evolution;
    const CpsiPoint *of = &evolution->points.point[point];
    const CpsPointReport *report = &of->report;
    const CpsiObstacle *on = &evolution->obstacle[report->obstacle];
    const bool stick = f->kind == CPS_STIFFNESS_STICK, gives = on->stiffness > 0,
               follows = evolution->options.friction_policy != CPS_FRICTION_POLICY_FROZEN;
    const Vec3 x = vec3_load(report->position), n = vec3_load(report->normal),
               s = vec3_load(report->slip), friction = vec3_load(report->friction);
    const double mu =
        stick || !f->is_static ? on->friction[0] * cpsi_obstacle_friction_factor(on, x) : 0;
    const double slip = vec3_norm(s), bound = follows ? mu * report->reaction : vec3_norm(friction),
                 spring =
                     gives ? cpsi_soft_point_spring(evolution, point, report->obstacle, x).stiffness
                           : 0;
    const bool rests = mu > 0 && (stick || !(slip > CPS_TOUCH * of->length));
    const CpsiObstacle level = cpsi_obstacle_within(on, gives ? cpsi_soft_way_depth(on, x) : 0);
    Rows out = rests ? held(size) : in_plane(size, n, s, mu > 0 ? bound : 0, turn_of(&level, slip));
    if (gives) {
        vec3_add_outer(out.p, 1, n, n);
        vec3_add_outer(out.q, spring - size, n, n);
    }
    if (rests) return out;
    const Vec3 e = mu > 0 ? vec3_scale(1 / slip, s) : vec3(0, 0, 0);
    if (follows && gives)
        vec3_add_outer(out.q, -mu * spring, e, n);
    else if (follows)
        vec3_add_outer(out.p, mu, e, n);
    double axes[9], curvature[3];
    cpsi_obstacle_axes(on, x, vec3(1, 0, 0), axes, curvature);
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++) {
            const Vec3 to = vec3_load(&axes[3 * a]), from = vec3_load(&axes[3 * b]);
            const double turned = curvature[a + b] * vec3_dot(friction, to);
            vec3_add_outer(out.q, -report->reaction * curvature[a + b], to, from);
            if (gives)
                vec3_add_outer(out.q, turned, n, from);
            else if (follows)
                vec3_add_outer(out.q, mu * turned, e, from);
        }
    return out;
}

/* Held to a set: the place to which it brings x + r/rho, r all but its reaction (point_set.c). */
static Rows rows_in_set(CpsiEndSet *on, const CpsPointReport *report, double size) {
    const Vec3 back = vec3_sub(vec3_load(report->residual), vec3_load(report->set_reaction));
    CpsiInSet in = {.on = on, .place = vec3_load(report->position), .rest = back, .yields = size};
    Rows out;
    (void)cpsi_in_set_hold(&in);
    cpsi_in_set_slopes(&in, out.p);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) out.q[a][b] = size * ((a == b) - out.p[a][b]);
    return out;
}

/* The equation of a point; `size`: of the stiffness of the lines. */
static CpsStiffnessOutcome rows_of(const Following *f, int point, double size, Rows *out) {
    const CpsEvolution *evolution = f->evolution;
    const CpsiPoint *of = &evolution->points.point[point];
    const CpsPointReport *report = &of->report;
    CpsiEndSet *set = cpsi_set_of_point(&evolution->points, point);
    if (!report->has_place) return CPS_STIFFNESS_OUTCOME_NO_STEP;
    *out = off_everything();
    if (set) {
        *out = rows_in_set(set, report, size);
    } else if (of->kind == CPS_POINT_KIND_HELD) { /* an anchor that drags */
        const Vec3 s = vec3_load(report->drag);
        *out = in_plane(size, cpsi_anchor_normal(evolution, point), s,
                        evolution->points.given[point].holding_capacity, 1 / vec3_norm(s));
    } else if (report->water == CPS_POINT_WATER_FLOATING) {
        if (report->obstacle != CPS_NO_OBSTACLE) return CPS_STIFFNESS_OUTCOME_NOT_GIVEN;
        const Vec3 n = vec3_load(report->water_direction);
        const double square = vec3_dot(n, n),
                     spring = of->extent > 0 ? report->displaced / of->extent : 0;
        if (!(of->extent > 0)) vec3_add_outer(out->p, -1 / square, n, n);
        vec3_add_outer(out->q, of->extent > 0 ? spring : size / square, n, n);
    } else if (report->obstacle != CPS_NO_OBSTACLE) {
        *out = rows_on_surface(f, point, size);
    } else if (vec3_norm(vec3_load(report->friction)) > 0) {
        return CPS_STIFFNESS_OUTCOME_NOT_GIVEN; /* frozen friction off the obstacle */
    }
    return CPS_STIFFNESS_OUTCOME_FOUND;
}

bool cpsi_follower_rows(const CpsEvolution *evolution, bool is_static, int point, double size,
                        CpsiFollowerRows *out) {
    const Following f = {.evolution = evolution,
                         .kind = CPS_STIFFNESS_STEP,
                         .is_static = is_static};
    const bool is_free = evolution->points.point[point].kind == CPS_POINT_KIND_FREE;
    const bool known = (is_free || has_dragged(evolution, point)) &&
                       rows_of(&f, point, size, out) == CPS_STIFFNESS_OUTCOME_FOUND;
    if (!known) *out = held(size);
    return known;
}

/* elimination ---------------------------------------------------------------------------------- */

/* Block (to, from) of the stiffness (6, 6) of a line. */
static const double *block_of(const double *k, int to, int from) { return &k[18 * to + 3 * from]; }

/* Set P K_yy + Q; the rows P of point i go into p. */
static CpsStiffnessOutcome set_matrix(const Following *f, const double *k, double (*p)[3][3]) {
    CpsiBalance *balance = f->balance;
    cpsi_graph_matrix_clear(balance->matrix);
    for (int i = 0; i < f->evolution->line_count; i++)
        for (int to = 0; takes_part(f, i) && to < 2; to++)
            for (int from = 0; from < 2; from++) {
                const CpsiJointMap row = map_of_follower(f, i, to),
                                   column = map_of_follower(f, i, from);
                cpsi_graph_matrix_add(balance->matrix, &row, &column,
                                      block_of(&k[36 * (size_t)i], to, from), 6);
            }
    for (int i = 0; i < balance->count; i++) {
        const int point = balance->at[i].point;
        const CpsiGraphBlock own = cpsi_graph_matrix_block(balance->matrix, i, i);
        double size = 0;
        Rows rows;
        for (size_t a = 0; a < 3; a++) {
            if (f->evolution->interval > 0)
                own.at[a * own.stride + a] +=
                    cpsi_point_inertia_stiffness(&f->evolution->points.point[point]);
            size += fabs(own.at[a * own.stride + a]) / 3;
        }
        const CpsStiffnessOutcome outcome = rows_of(f, point, size, &rows);
        if (outcome != CPS_STIFFNESS_OUTCOME_FOUND) return outcome;
        cpsi_graph_matrix_turn(balance->matrix, i, (const double(*)[3])rows.p);
        for (size_t a = 0; a < 3; a++)
            for (size_t b = 0; b < 3; b++) own.at[a * own.stride + b] += rows.q[a][b];
        memcpy(p[i], rows.p, sizeof rows.p);
    }
    return cpsi_graph_matrix_factor(balance->matrix) ? CPS_STIFFNESS_OUTCOME_FOUND
                                                     : CPS_STIFFNESS_OUTCOME_LOOSE;
}

/* out = - P K_yu u for unknown number `column` of what moves. */
static void set_right(const Following *f, const double *k, double (*p)[3][3], int column,
                      double *out) {
    const CpsiBalance *balance = f->balance;
    memset(out, 0, (size_t)balance->unknowns * sizeof *out);
    for (int i = 0; i < f->evolution->line_count; i++)
        for (int to = 0; to < 2; to++) {
            const int row = follower(f, i, to);
            const CpsiJointMap from = map_of_moved(f, i, !to);
            if (row < 0 || from.width == 0) continue;
            const double *block = block_of(&k[36 * (size_t)i], to, !to);
            for (int a = 0; a < 3; a++)
                for (int b = 0; b < 3; b++)
                    out[3 * row + a] -= block[6 * a + b] * from.by[b][column];
        }
    for (int i = 0; i < balance->count; i++) {
        const Vec3 b = vec3_load(&out[3 * i]);
        for (int a = 0; a < 3; a++) out[3 * i + a] = vec3_dot(vec3_load(p[i][a]), b);
    }
}

/* Add A' K v, A the map of an end that moves, to a column of the result; its rows are `width`. */
static void add_to_column(const Following *f, const CpsiJointMap *to, const double *block,
                          const double v[3], int column, double *out) {
    for (int i = 0; i < f->width; i++)
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++)
                out[f->width * i + column] += to->by[a][i] * block[6 * a + b] * v[b];
}

/* Add K_uu of a line. */
static void add_own(const Following *f, int line, const double k[36], double *out) {
    for (int to = 0; to < 2; to++)
        for (int from = 0; from < 2; from++) {
            const CpsiJointMap row = map_of_moved(f, line, to), by = map_of_moved(f, line, from);
            if (!counts(f, line, to) || by.width == 0) continue;
            for (int column = 0; column < f->width; column++) {
                const double v[3] = {by.by[0][column], by.by[1][column], by.by[2][column]};
                add_to_column(f, &row, block_of(k, to, from), v, column, out);
            }
        }
}

/* Add what the points that follow bring; k: of all lines, (lines, 36). */
static CpsStiffnessOutcome add_followers(const Following *f, const double *k, double *out) {
    CpsiBalance *balance = f->balance;
    if (!balance || balance->count == 0) return CPS_STIFFNESS_OUTCOME_FOUND;
    double *y = balance->step;
    const CpsStiffnessOutcome outcome = set_matrix(f, k, balance->rows);
    if (outcome != CPS_STIFFNESS_OUTCOME_FOUND) return outcome;
    for (int column = 0; column < f->width; column++) {
        const double unit =
            column < 3 ? 1 : fmax(f->evolution->bodies.body[f->moved->body].arm, 1e-300);
        set_right(f, k, balance->rows, column, y);
        cpsi_graph_matrix_solve(balance->matrix, y);
        for (int i = 0; i < balance->unknowns; i++)
            if (!(fabs(y[i]) <= TOO_FAR * unit)) return CPS_STIFFNESS_OUTCOME_LOOSE;
        for (int i = 0; i < f->evolution->line_count; i++)
            for (int to = 0; to < 2; to++) {
                const int from = follower(f, i, !to);
                if (!counts(f, i, to) || from < 0) continue;
                const CpsiJointMap row = map_of_moved(f, i, to);
                add_to_column(f, &row, block_of(&k[36 * (size_t)i], to, !to), &y[3 * from], column,
                              out);
            }
    }
    return CPS_STIFFNESS_OUTCOME_FOUND;
}

static CpsiLineStiffness stiffness_of_line(const Following *f, int line) {
    const CpsEvolution *evolution = f->evolution;
    bool moves[2];
    for (int end = 0; end < 2; end++)
        moves[end] = is_moved(f, line, end) || follower(f, line, end) >= 0;
    cpsi_workspace_attach(&evolution->workspace[0], &evolution->line[line]);
    return cpsi_line_stiffness(&evolution->line[line], &evolution->workspace[0].program,
                               &evolution->options, f->kind, moves);
}

/* Add what turns with a body that moves: the pulls of the lines on it. */
static void add_turning(const Following *f, int line, double *out) {
    if (f->moved->body < 0) return;
    for (int end = 0; end < 2; end++) {
        if (!is_moved(f, line, end)) continue;
        const Vec3 a = arm_of(f, f->evolution->points.tie[2 * line + end]);
        const CpsLineReport *report = &f->evolution->line[line].report;
        cpsi_add_turning_force(vec3_scale(-1, vec3_load(report->end[end].force)), a, out);
    }
}

/* Add the followers' part to both sums; where no line touches down they are the same. */
static CpsStiffnessOutcome finish(const Following *f, bool same, CpsiMovedStiffness *out) {
    const CpsStiffnessOutcome outcome = add_followers(f, f->balance->tangent, out->matrix);
    if (outcome != CPS_STIFFNESS_OUTCOME_FOUND) return outcome;
    if (same)
        memcpy(out->smooth, out->matrix, sizeof out->smooth);
    else if (out->has_smooth)
        out->has_smooth =
            add_followers(f, f->balance->smooth, out->smooth) == CPS_STIFFNESS_OUTCOME_FOUND;
    return outcome;
}

CpsiMovedStiffness cpsi_moved_stiffness(const CpsEvolution *evolution, const CpsiMoved *moved,
                                        CpsStiffnessKind kind) {
    CpsiMovedStiffness out = {.outcome = CPS_STIFFNESS_OUTCOME_FOUND, .has_smooth = true};
    const Following f = {.evolution = evolution,
                         .balance = evolution->points.balance,
                         .moved = moved,
                         .kind = kind,
                         .is_static =
                             evolution->has_static && evolution->done + evolution->move_count == 1,
                         .width = moved->body >= 0 ? 6 : 3};
    bool same = true;
    find_followers(&f);
    for (int i = 0; i < evolution->line_count; i++) {
        if (!takes_part(&f, i)) continue;
        const CpsiLineStiffness found = stiffness_of_line(&f, i);
        if (found.outcome != CPS_STIFFNESS_OUTCOME_FOUND)
            return (CpsiMovedStiffness){.outcome = found.outcome};
        out.has_smooth = out.has_smooth && found.has_smooth;
        for (int k = 0; k < 36; k++) same = same && found.matrix[k] == found.smooth[k];
        add_own(&f, i, found.matrix, out.matrix);
        add_own(&f, i, found.smooth, out.smooth);
        add_turning(&f, i, out.matrix);
        add_turning(&f, i, out.smooth);
        if (!f.balance) continue;
        memcpy(&f.balance->tangent[36 * (size_t)i], found.matrix, sizeof found.matrix);
        memcpy(&f.balance->smooth[36 * (size_t)i], found.smooth, sizeof found.smooth);
    }
    if (f.balance) out.outcome = finish(&f, same, &out);
    return out.outcome == CPS_STIFFNESS_OUTCOME_FOUND
               ? out
               : (CpsiMovedStiffness){.outcome = out.outcome};
}
