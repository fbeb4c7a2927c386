/* SPDX-License-Identifier: BSD-3-Clause */
/* Queries of the history of a run (see history.h). */
#include "io/history.h"

#include <math.h>

#include "base/math.h"

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

double cpsi_results_turn(const CpsResults *results, int step, int obstacle) {
    if (is_break(results, step)) return 0;
    for (int i = 0; i < results->stage_count; ++i)
        if (step >= results->stage[i].first && step <= results->stage[i].last)
            return results->stage[i].turn[obstacle];
    return 0;
}

double cpsi_results_turned(const CpsResults *results, int step, int obstacle) {
    double sum = 0;
    for (int i = 0; i < results->stage_count && results->stage[i].first <= step; ++i) {
        const CpsiStage *stage = &results->stage[i];
        const int last = step < stage->last ? step : stage->last;
        int count = last - stage->first + 1;
        for (int row = stage->first; row <= last; ++row) count -= is_break(results, row);
        sum += count * stage->turn[obstacle];
    }
    return sum;
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
