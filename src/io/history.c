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

bool cpsi_results_pictured(const CpsResults *results, int step) {
    const int steps = results->planned_steps;
    if (steps <= SHORT_HISTORY || step == 0 || step == steps - 1 || is_break(results, step))
        return true;
    if (results->stage_count < 4 || results->stage_count > SHORT_HISTORY)
        return step % ((steps + EVEN_SELECTION - 1) / EVEN_SELECTION) == 0;
    for (int i = 0; i < results->stage_count; ++i)
        if (results->stage[i].last == step) return true;
    return false;
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

int cpsi_results_point_of(const CpsResults *results, const CpsiRow *row, int line, int end) {
    const bool is_there = row->line[line].failure.release[end] == CPS_RELEASE_NONE;
    return is_there ? results->line_point[line][end] : CPSI_AT_NO_POINT;
}

CpsObstacle cpsi_results_obstacle(const CpsResults *results, int step, int obstacle) {
    CpsObstacle now = results->obstacle[obstacle];
    if (step < 0 || !now.moves) return now;
    const CpsiObstacleRow *place = &results->row[step].place[obstacle];
    const bool plane = now.kind == CPS_OBSTACLE_PLANE;
    memcpy(now.point, place->point, sizeof now.point);
    memcpy(plane ? now.normal : now.axis, place->axis, sizeof now.axis);
    return now;
}

void cpsi_results_rotation(const CpsResults *results, int step, int obstacle, double out[4]) {
    static const double NONE[4] = {1, 0, 0, 0};
    memcpy(out, step < 0 ? NONE : results->row[step].place[obstacle].rotation, 4 * sizeof *out);
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
        const CpsObstacleReport report = cps_evolution_obstacle_report(evolution, k);
        out[k] = (CpsiObstacleRow){.turn = report.turned, .turned = report.turned};
        memcpy(out[k].axis, report.axis, sizeof report.axis);
        for (int a = 0; a < 3; ++a) {
            out[k].point[a] = report.point[a] - results->origin[a];
            out[k].moved = out[k].moved || report.by[a] != 0 || report.turn[a] != 0;
        }
        double before[4];
        cpsi_results_rotation(results, results->row_count - 1, k, before);
        rotation_store(out[k].rotation,
                       rotation_after(rotation_of(vec3_load(report.turn)), rotation_load(before)));
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
    *out = (CpsiBodyRow){.report = cps_evolution_body_report(evolution, body)};
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
