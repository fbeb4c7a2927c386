/* SPDX-License-Identifier: BSD-3-Clause */
/* Queries of the history of a run (see history.h). */
#include "io/history.h"

#include <math.h>
#include <string.h>

#include "base/math.h"
#include "base/rotation.h"

enum {
    SHORT_HISTORY = 14, /* every step of a history up to this length is drawn */
    EVEN_SELECTION = 12
};

/* A step that is not taken yet is none. */
static bool is_break(const CpsResults *results, int step) {
    return step < results->row_count && results->row[step].parted.is_break;
}

bool cpsi_results_passes(const CpsResults *results, int step, int parts) {
    const double all = results->stage_count > 0 ? results->stage[results->stage_count - 1].end : 0;
    if (step < 1 || step >= results->row_count || !(all > 0)) return false;
    const double share = parts / all;
    return floor(results->row[step].motion.time * share) >
           floor(results->row[step - 1].motion.time * share);
}

/* ... of a run whose number of steps is not known before: evenly in time, and where a stage ends.
 */
static bool is_pictured_in_time(const CpsResults *results, int step) {
    const int stages = results->stage_count <= SHORT_HISTORY ? results->stage_count : 0;
    bool is_last = step == 0 || cpsi_results_passes(results, step, EVEN_SELECTION);
    for (int i = 0; i < stages; ++i) is_last = is_last || results->stage[i].last == step;
    return is_last;
}

bool cpsi_results_pictured(const CpsResults *results, int step) {
    const int steps = results->planned_steps;
    if (results->has_pace) return is_pictured_in_time(results, step);
    if (steps <= SHORT_HISTORY || step == 0 || step == steps - 1 || is_break(results, step))
        return true;
    if (results->stage_count < 4 || results->stage_count > SHORT_HISTORY)
        return step % ((steps + EVEN_SELECTION - 1) / EVEN_SELECTION) == 0;
    for (int i = 0; i < results->stage_count; ++i)
        if (results->stage[i].last == step) return true;
    return false;
}

bool cpsi_has_duration(const CpsScene *scene) {
    bool any = scene->in_time;
    for (int i = 0; i < scene->stage_count; ++i) any = any || scene->stage[i].duration > 0;
    return any;
}

CpsiMotionRow cpsi_motion_row(const CpsEvolution *evolution) {
    CpsiMotionRow row = {.time = cps_evolution_time(evolution),
                         .pace = cps_evolution_pace(evolution),
                         .of = cps_evolution_motion(evolution)};
    row.rejected = row.pace.rejected;
    row.landed = row.of.landed;
    row.changed = row.of.changed;
    row.snatched = row.of.snatched;
    return row;
}

bool cpsi_has_winch(const CpsLine *line) {
    return line->winch[CPS_END_A].is_there || line->winch[CPS_END_B].is_there;
}

bool cpsi_has_set(const CpsLine *line) {
    return line->constraint[CPS_END_A].kind != CPS_CONSTRAINT_KIND_NONE ||
           line->constraint[CPS_END_B].kind != CPS_CONSTRAINT_KIND_NONE;
}

bool cpsi_has_point_set(const CpsScene *scene) {
    bool found = false;
    for (int k = 0; k < scene->point_count; ++k)
        found = found || scene->point[k].constraint.kind != CPS_CONSTRAINT_KIND_NONE;
    return found;
}

bool cpsi_lets_go(const CpsScene *scene) {
    bool found = false;
    for (int i = 0; i < scene->line_count; ++i) {
        const CpsLine *line = &scene->line[i];
        found = found || (line->section_count == 0 && line->has_break_at);
        for (int k = 0; k < line->section_count; ++k)
            found = found || line->section[k].has_break_at;
    }
    for (int s = 0; s < scene->stage_count; ++s)
        for (int k = 0; k < scene->stage[s].change_count; ++k)
            found = found || scene->stage[s].change[k].to.kind == CPS_END_KIND_RELEASED;
    return found;
}

enum { LINES_IN_PLANES = 12 };

int cpsi_results_point_of(const CpsResults *results, const CpsiRow *row, int line, int end) {
    const bool is_there = row->line[line].failure.release[end] == CPS_RELEASE_NONE;
    return is_there ? results->line_point[line][end] : CPSI_AT_NO_POINT;
}

bool cpsi_results_is_on_body(const CpsResults *results, const CpsiRow *row, int line, int body) {
    for (int end = 0; end < 2; ++end) {
        const int point = cpsi_results_point_of(results, row, line, end);
        if (point != CPSI_AT_NO_POINT && results->point[point].kind == CPS_POINT_KIND_ON_BODY &&
            results->point[point].body == body)
            return true;
    }
    return false;
}

bool cpsi_results_has_planes(const CpsResults *results) {
    return results->point_count > 0 && results->line_count >= 2 &&
           results->line_count <= LINES_IN_PLANES;
}

CpsObstacle cpsi_results_obstacle(const CpsResults *results, int step, int obstacle) {
    CpsObstacle now = results->obstacle[obstacle];
    if (step < 0 || !now.moves) return now;
    const CpsiObstacleRow *place = &results->row[step].place[obstacle];
    const bool plane = now.kind == CPS_OBSTACLE_PLANE;
    memcpy(now.point, place->point, sizeof now.point);
    memcpy(plane ? now.normal : now.axis, place->axis, sizeof now.axis);
    if (now.kind == CPS_OBSTACLE_BOX || now.kind == CPS_OBSTACLE_MESH)
        rotation_store(now.shape.rotation, rotation_after(rotation_load(place->rotation),
                                                          rotation_load(now.shape.rotation)));
    return now;
}

double cpsi_results_turned(const CpsResults *results, int step, int obstacle) {
    return step < 0 ? 0 : results->row[step].place[obstacle].turned;
}

bool cpsi_results_turns(const CpsResults *results, int step, int obstacle) {
    return results->row[step].place[obstacle].turn != 0;
}

bool cpsi_results_moves(const CpsResults *results, int step, int obstacle) {
    return results->row[step].place[obstacle].moved;
}

void cpsi_obstacle_rows(const CpsResults *results, const CpsEvolution *evolution,
                        CpsiObstacleRow *out) {
    for (int k = 0; k < results->obstacle_count; ++k) {
        const CpsObstacleReport report = cps_evolution_obstacle_view(evolution, k);
        out[k] = (CpsiObstacleRow){.turn = report.turned, .turned = report.turned};
        memcpy(out[k].axis, report.axis, sizeof report.axis);
        const CpsiRow *last = results->row_count > 0 ? &results->row[results->row_count - 1] : NULL;
        static const double NONE[4] = {1, 0, 0, 0};
        rotation_store(out[k].rotation,
                       rotation_after(rotation_of(vec3_load(report.turn)),
                                      rotation_load(last ? last->place[k].rotation : NONE)));
        for (int a = 0; a < 3; ++a) {
            out[k].point[a] = report.point[a];
            out[k].moved = out[k].moved || report.by[a] != 0 || report.turn[a] != 0;
        }
        if (results->row_count > 0)
            out[k].turned += results->row[results->row_count - 1].place[k].turned;
    }
}

const char *cpsi_point_state(CpsPointState state) {
    static const char *const NAME[] = {[CPS_POINT_STATE_HELD] = "held",
                                       [CPS_POINT_STATE_FREE] = "free",
                                       [CPS_POINT_STATE_STICK] = "stick",
                                       [CPS_POINT_STATE_SLIP] = "slip",
                                       [CPS_POINT_STATE_ON_BODY] = "on_body"};
    return NAME[state];
}

const char *cpsi_point_water(CpsPointWater water) {
    static const char *const NAME[] = {[CPS_POINT_WATER_NONE] = "",
                                       [CPS_POINT_WATER_SUBMERGED] = "submerged",
                                       [CPS_POINT_WATER_FLOATING] = "floating",
                                       [CPS_POINT_WATER_ABOVE] = "above"};
    return NAME[water];
}

double cpsi_point_residual(const CpsPointReport *report) {
    return hypot(hypot(report->residual[0], report->residual[1]), report->residual[2]);
}

const char *cpsi_body_kind(CpsBodyKind kind) {
    return kind == CPS_BODY_KIND_HELD ? "held" : "free";
}

static double size(const double x[3]) { return hypot(hypot(x[0], x[1]), x[2]); }

void cpsi_body_row(const CpsEvolution *evolution, int body, bool stiffness, CpsiBodyRow *out) {
    *out = (CpsiBodyRow){.report = cps_evolution_body_report(evolution, body),
                         .motion = cps_evolution_body_motion(evolution, body)};
    cps_body_angles(&out->report, out->angle, &out->heel);
    for (int i = 0; i < 3; ++i) out->angle[i] /= CPSI_DEGREE;
    out->heel /= CPSI_DEGREE;
    for (int i = 0; i < 2; ++i) out->residual[i] = size(&out->report.residual[3 * i]);
    if (!stiffness) return;
    for (int kind = 0; kind < 2; ++kind)
        cps_evolution_body_stiffness(evolution, body, (CpsStiffnessKind)kind, &out->stiffness[kind],
                                     NULL);
}

CpsOutcome cpsi_results_outcome(const CpsResults *results) {
    CpsOutcome worst = CPS_OUTCOME_SOLVED;
    for (int i = 0; i < results->row_count; ++i)
        worst = cps_outcome_worse(worst, results->row[i].report.outcome);
    return worst;
}

/* ---- surfaces of shapes ---- */

/* Parts of a quarter of a circle. */
enum { QUARTER = 12 };

void cpsi_shape_grid(const CpsObstacle *o, int *rows, int *columns) {
    *columns = 4 * QUARTER;
    *rows = 0;
    if (o->kind == CPS_OBSTACLE_CAPSULE) *rows = 2 * QUARTER + 1;
    if (o->kind == CPS_OBSTACLE_TORUS) *rows = 4 * QUARTER;
    if (o->kind == CPS_OBSTACLE_CONE) *rows = QUARTER + 1;
    if (o->kind != CPS_OBSTACLE_BOX) return;
    *rows = 2 * QUARTER + 3;
    *columns = 4 * QUARTER + 4;
}

/* Away from the axis, and along it: of what is round about an axis. */
static void profile(const CpsObstacle *o, double end, int row, double out[2]) {
    const double r = o->radius, part = 0.5 * CPSI_PI / QUARTER;
    const bool second = row > QUARTER;
    if (o->kind == CPS_OBSTACLE_TORUS) {
        out[0] = o->shape.main_radius - r * cos(part * row);
        out[1] = r * sin(part * row);
    } else if (o->kind == CPS_OBSTACLE_CAPSULE) {
        const double angle = part * (row - second);
        out[0] = r * sin(angle);
        out[1] = (second ? -0.5 : 0.5) * o->shape.length + r * cos(angle);
    } else {
        const double angle = (0.5 * CPSI_PI - o->shape.angle) / QUARTER * (second ? QUARTER : row);
        out[0] = r * sin(angle);
        out[1] = r - r * cos(angle);
        if (!second) return;
        const double more = fmax(0, end - out[1]);
        out[0] += more * tan(o->shape.angle);
        out[1] += more;
    }
}

/* In the axes of the box: round every corner an eighth of a ball. */
static Vec3 box_point(const CpsObstacle *o, int row, int column) {
    const int last = 2 * QUARTER + 3, corner = column / (QUARTER + 1) % 4;
    const double r = o->radius, *size = o->shape.size, part = 0.5 * CPSI_PI / QUARTER,
                 sign[3] = {corner == 0 || corner == 3 ? 1 : -1, corner < 2 ? 1 : -1,
                            row <= QUARTER + 1 ? 1 : -1};
    if (row == 0 || row == last) return vec3(0, 0, 0.5 * sign[2] * size[2]);
    const int step = row <= QUARTER + 1 ? row - 1 : row - 2;
    const double angle = part * (corner * QUARTER + column % (QUARTER + 1)), polar = part * step;
    return vec3(sign[0] * (0.5 * size[0] - r) + r * sin(polar) * cos(angle),
                sign[1] * (0.5 * size[1] - r) + r * sin(polar) * sin(angle),
                sign[2] * (0.5 * size[2] - r) + r * cos(polar));
}

static Vec3 unit(Vec3 v) { return vec3_scale(1 / vec3_norm(v), v); }

Vec3 cpsi_shape_point(const CpsObstacle *o, double end, double turned, int row, int column) {
    const Vec3 centre = vec3_load(o->point);
    if (o->kind == CPS_OBSTACLE_BOX) {
        const int round = 4 * QUARTER + 4;
        return vec3_add(centre, rotation_apply(rotation_load(o->shape.rotation),
                                               box_point(o, row, column % round)));
    }
    const Vec3 axis = unit(vec3_load(o->axis)),
               seed = fabs(axis.x) <= 0.75 ? vec3(1, 0, 0) : vec3(0, 1, 0),
               first = unit(vec3_reject(seed, axis)), second = vec3_cross(axis, first);
    const double angle = turned + 0.5 * CPSI_PI * column / QUARTER;
    double at[2];
    profile(o, end, row, at);
    return vec3_add(vec3_axpy(at[1], axis, centre),
                    vec3_axpy(at[0] * cos(angle), first, vec3_scale(at[0] * sin(angle), second)));
}

/* ---- outlines of sets ---- */

/* A circle about the centre, through `first` and `second` from it. */
static int circle(Vec3 centre, Vec3 first, Vec3 second, Vec3 out[CPSI_OUTLINE_POINTS]) {
    for (int i = 0; i < CPSI_OUTLINE_POINTS; ++i) {
        const double angle = 2 * CPSI_PI * i / (CPSI_OUTLINE_POINTS - 1);
        out[i] = vec3_axpy(cos(angle), first, vec3_axpy(sin(angle), second, centre));
    }
    return CPSI_OUTLINE_POINTS;
}

/* Face below, face above, and the edges between. */
static int box_outline(const CpsConstraint *on, int piece, Vec3 out[CPSI_OUTLINE_POINTS]) {
    static const double X[5] = {-1, 1, 1, -1, -1}, Y[5] = {-1, -1, 1, 1, -1};
    static const double NONE[4] = {1, 0, 0, 0};
    const double *q = on->rotation;
    const bool turned = q[0] != 0 || q[1] != 0 || q[2] != 0 || q[3] != 0;
    const Rotation turn = rotation_load(turned ? q : NONE);
    const int count = piece < 2 ? 5 : 2;
    if (piece > 5) return 0;
    for (int i = 0; i < count; ++i) {
        const int corner = piece < 2 ? i : piece - 2, up = piece < 2 ? piece : i;
        const Vec3 own = vec3(0.5 * X[corner] * on->size[0], 0.5 * Y[corner] * on->size[1],
                              (up - 0.5) * on->size[2]);
        out[i] = vec3_add(vec3_load(on->point), rotation_apply(turn, own));
    }
    return count;
}

/* The places of a set that are farthest along the directions of one of the planes of the axes: what
 * is seen of it along the third axis lies within this curve. */
static int silhouette(const CpsConstraint *on, int piece, Vec3 out[CPSI_OUTLINE_POINTS]) {
    CpsSetAnswer answer;
    if (piece > 2) return 0;
    for (int i = 0; i < CPSI_OUTLINE_POINTS; ++i) {
        const double angle = 2 * CPSI_PI * i / (CPSI_OUTLINE_POINTS - 1);
        double along[3] = {0}, x[3] = {0};
        along[piece] = cos(angle);
        along[(piece + 1) % 3] = sin(angle);
        if (cps_set_support(on->set, along, x, &answer, NULL) != CPS_OK ||
            answer.outcome != CPS_SET_OUTCOME_ANSWERED)
            return 0;
        out[i] = vec3_add(vec3_load(on->point), vec3_load(x));
    }
    return CPSI_OUTLINE_POINTS;
}

int cpsi_set_outline(const CpsConstraint *on, Vec3 about, double reach, int piece,
                     Vec3 out[CPSI_OUTLINE_POINTS]) {
    static const double X[5] = {-1, 1, 1, -1, -1}, Y[5] = {-1, -1, 1, 1, -1};
    const Vec3 point = vec3_load(on->point), from = vec3_sub(about, point);
    if (on->kind == CPS_CONSTRAINT_KIND_BOX) return box_outline(on, piece, out);
    if (on->kind == CPS_CONSTRAINT_KIND_SET) return silhouette(on, piece, out);
    if (on->kind == CPS_CONSTRAINT_KIND_NONE ||
        piece > (on->kind == CPS_CONSTRAINT_KIND_BALL ? 2 : 0))
        return 0;
    const double r = on->radius;
    if (on->kind == CPS_CONSTRAINT_KIND_BALL) {
        const Vec3 axis[3] = {vec3(r, 0, 0), vec3(0, r, 0), vec3(0, 0, r)};
        return circle(point, axis[piece], axis[(piece + 1) % 3], out);
    }
    const Vec3 n = unit(vec3_load(on->axis)),
               seed = fabs(n.x) <= 0.75 ? vec3(1, 0, 0) : vec3(0, 1, 0),
               first = unit(vec3_reject(seed, n)), second = vec3_cross(n, first);
    if (on->kind == CPS_CONSTRAINT_KIND_DISC)
        return circle(point, vec3_scale(r, first), vec3_scale(r, second), out);
    if (on->kind == CPS_CONSTRAINT_KIND_RAIL) {
        const double middle = isinf(on->length) ? vec3_dot(from, n) : 0.5 * on->length,
                     half = isinf(on->length) ? reach : 0.5 * on->length;
        out[0] = vec3_axpy(middle - half, n, point);
        out[1] = vec3_axpy(middle + half, n, point);
        return 2;
    }
    for (int i = 0; i < 5; ++i)
        out[i] = vec3_add(vec3_add(point, vec3_reject(from, n)),
                          vec3_axpy(reach * X[i], first, vec3_scale(reach * Y[i], second)));
    return 5;
}

bool cpsi_next_outline(const CpsResults *results, CpsiOutlineWalk *walk) {
    for (; walk->line < results->line_count; walk->line++, walk->end = 0)
        for (; walk->end < 2; walk->end++, walk->piece = 0) {
            const CpsEndReport *end = &results->row[0].line[walk->line].report.end[walk->end];
            const double reach = walk->reach > 0 ? walk->reach : results->line_length[walk->line];
            walk->count = cpsi_set_outline(&results->line_constraint[walk->line][walk->end],
                                           vec3_load(end->position), reach, walk->piece, walk->x);
            walk->piece++;
            if (walk->count > 0) return true;
        }
    return false;
}
