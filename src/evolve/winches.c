/* SPDX-License-Identifier: BSD-3-Clause */
/* Winches of a scene (winches.h). */
#include "evolve/winches.h"

#include <math.h>
#include <stdio.h>

#include "base/status.h"
#include "cable/winch.h"
#include "evolve/ranges.h"
#include "evolve/sections.h"

/* So much of its shortest element is always off the drums: an element of no length has no
 * direction. */
static const double LEAST_OFF = 0.1;
/* [-] Rounding of lengths that are added up over a history, per length of the line. */
static const double ROUNDING = 1e-12;

/* [m] The most that the drums of a line may have on them. */
static double most_stored(const CpsLine *line) {
    double shortest = INFINITY;
    for (int e = 0; e < line->element_count; e++)
        shortest = fmin(shortest, cpsi_element_length(line, e));
    return line->length - LEAST_OFF * shortest;
}

static CpsStatus check_winch(const CpsLine *line, int end, CpsError *err) {
    const CpsWinch *winch = &line->winch[end];
    const char *letter = cpsi_end_letter(end);
    char place[24];
    snprintf(place, sizeof place, "ends.%s.stored", letter);
    if (!winch->is_there && winch->stored == 0) return CPS_OK;
    if (!winch->is_there)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': ends: end %s has %g m stored, but no winch", line->name,
                            letter, winch->stored);
    if (!cpsi_is_not_negative(winch->stored))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': ends: the winch at end %s has %g m stored, expected a "
                            "finite number >= 0",
                            line->name, letter, winch->stored);
    if (line->end[end].kind == CPS_END_KIND_FREE)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': ends: a winch is at end %s, which is free: a winch holds "
                            "its end, or is at a point",
                            line->name, letter);
    if (line->start.kind == CPS_START_NODES)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': ends: a line with a winch has no start from nodes: use a "
                            "shape, or 'static'",
                            line->name);
    if (line->loads)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': ends: a line with a winch has no springs, loads or drag: "
                            "leave them out, or the winch",
                            line->name);
    if (cpsi_has_break_at(line))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': ends: a line with a winch has no break_at: give it a "
                            "breaking_load, which is only reported",
                            line->name);
    if (cpsi_has_dynamic_stiffness(line))
        return CPSI_FAIL_AT(
            place, err, CPS_ERR_ARGUMENT,
            "line '%s': ends: a line with a winch has no dynamic stiffness: give it "
            "one stiffness",
            line->name);
    return CPS_OK;
}

CpsStatus cpsi_winches_check(const CpsLine *line, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int end = 0; end < 2 && status == CPS_OK; end++) status = check_winch(line, end, err);
    const double stored = line->winch[CPS_END_A].stored + line->winch[CPS_END_B].stored;
    if (status != CPS_OK || stored == 0 || stored <= most_stored(line)) return status;
    return CPSI_FAIL_AT(line->winch[CPS_END_B].stored > 0 ? "ends.B.stored" : "ends.A.stored", err,
                        CPS_ERR_ARGUMENT,
                        "line '%s': ends: %g m of the line's %g m are stored, expected at most "
                        "%.9g m, so that a tenth of an element is off the drum",
                        line->name, stored, line->length, most_stored(line));
}

static CpsStatus check_pay_out(const CpsScene *scene, const CpsStage *stage, int index,
                               const char *what, CpsError *err) {
    const CpsPayOut *pay = &stage->pay_out[index];
    if (pay->line < 0 || pay->line >= scene->line_count ||
        (pay->end != CPS_END_A && pay->end != CPS_END_B))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: pay_out %d names line %d, end %d: there are %d lines, ends are 0 and "
                         "1",
                         what, index + 1, pay->line, pay->end, scene->line_count);
    const CpsLine *line = &scene->line[pay->line];
    const char *letter = cpsi_end_letter(pay->end);
    char place[80];
    snprintf(place, sizeof place, "%s.pay_out_%s", line->name, letter);
    if (!line->winch[pay->end].is_there)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s.%s pays out, but has no winch: give this end of the line "
                            "'stored', the length on the drum, which may be 0",
                            what, line->name, letter);
    if (!cpsi_is_usable(pay->length))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s.%s pays out %g m, expected a finite number", what, line->name,
                            letter, pay->length);
    for (int k = 0; k < index; k++)
        if (stage->pay_out[k].line == pay->line && stage->pay_out[k].end == pay->end)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT, "%s: %s.%s pays out twice", what,
                                line->name, letter);
    return CPS_OK;
}

/* What holds an end with a winch goes on holding it, and what is between its ends is not grasped.
 */
static CpsStatus check_others(const CpsScene *scene, const CpsStage *stage, const char *what,
                              CpsError *err) {
    for (int i = 0; i < stage->change_count; i++) {
        const CpsChange *change = &stage->change[i];
        const CpsLine *line = &scene->line[change->line];
        const char *letter = cpsi_end_letter(change->end);
        char place[80];
        snprintf(place, sizeof place, "%s.%s", line->name, letter);
        if (line->winch[change->end].is_there && change->to.kind != CPS_END_KIND_HELD)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: %s.%s is %s, but a winch holds it: a winch can be moved, not "
                                "let go",
                                what, line->name, letter,
                                change->to.kind == CPS_END_KIND_FREE ? "loaded" : "released");
    }
    for (int i = 0; i < stage->grasp_change_count; i++) {
        const CpsLine *line = &scene->line[stage->grasp_change[i].line];
        char place[80];
        snprintf(place, sizeof place, "%s.node", line->name);
        if (line->winch[CPS_END_A].is_there || line->winch[CPS_END_B].is_there)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: a node of line '%s' is grasped, which has a winch: a node "
                                "may come to the drum",
                                what, line->name);
    }
    return CPS_OK;
}

CpsStatus cpsi_pay_outs_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                              CpsError *err) {
    const int count = stage->pay_out_count, most = 2 * scene->line_count;
    if (count < 0 || (count > 0 && !stage->pay_out))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: found %d pay_outs, expected 0 or more", what,
                         count);
    CpsStatus status = check_others(scene, stage, what, err);
    for (int i = 0; i < count && status == CPS_OK; i++)
        status = check_pay_out(scene, stage, i, what, err);
    if (status == CPS_OK && count > most)
        status =
            cpsi_fail(err, CPS_ERR_LIMIT, "%s: %d pay_outs, the limit is %d", what, count, most);
    return status;
}

/* What a stage pays out at an end. */
static double paid_by(int count, const CpsPayOut *pay, int line, int end) {
    for (int i = 0; i < count; i++)
        if (pay[i].line == line && pay[i].end == end) return pay[i].length;
    return 0;
}

/* Can the drums of a line, with so much on them, pay out what the stage says? */
static CpsStatus check_stock(const CpsLine *line, const double stored[2], const double pays[2],
                             const char *what, CpsError *err) {
    const double allowed = ROUNDING * line->length, most = most_stored(line);
    double left = 0;
    for (int end = 0; end < 2; end++) {
        const double after = stored[end] - pays[end];
        const char *letter = cpsi_end_letter(end);
        char place[80];
        snprintf(place, sizeof place, "%s.pay_out_%s", line->name, letter);
        left += after;
        if (!(after >= -allowed))
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "%s: %s.%s pays out %g m, but only %.9g m are on its drum", what,
                                line->name, letter, pays[end], stored[end]);
    }
    const int hauls = pays[CPS_END_A] < 0 ? CPS_END_A : CPS_END_B;
    char place[80];
    snprintf(place, sizeof place, "%s.pay_out_%s", line->name, cpsi_end_letter(hauls));
    if (!(left <= most + allowed))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: %s.%s hauls in %g m, but of %.9g m that are off the drum at least "
                            "%.6g m stay there, a tenth of an element",
                            what, line->name, cpsi_end_letter(hauls), -pays[hauls],
                            line->length - stored[CPS_END_A] - stored[CPS_END_B],
                            line->length - most);
    return CPS_OK;
}

CpsStatus cpsi_pay_outs_check_history(const CpsScene *scene, CpsError *err) {
    for (int i = 0; i < scene->line_count; i++) {
        const CpsLine *line = &scene->line[i];
        double stored[2] = {line->winch[0].stored, line->winch[1].stored};
        if (!line->winch[0].is_there && !line->winch[1].is_there) continue;
        for (int k = 0; k < scene->stage_count; k++) {
            const CpsStage *stage = &scene->stage[k];
            const double pays[2] = {paid_by(stage->pay_out_count, stage->pay_out, i, CPS_END_A),
                                    paid_by(stage->pay_out_count, stage->pay_out, i, CPS_END_B)};
            char what[32];
            snprintf(what, sizeof what, "stage %d", k + 1);
            const CpsStatus status = check_stock(line, stored, pays, what, err);
            if (status != CPS_OK) return cpsi_fail_inside(err, status, "history[%d]", k + 1);
            for (int end = 0; end < 2; end++) stored[end] -= pays[end];
        }
    }
    return CPS_OK;
}

CpsStatus cpsi_pay_outs_check_now(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                                  const char *what, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int k = 0; k < stage->pay_out_count && status == CPS_OK; k++) {
        const int i = stage->pay_out[k].line;
        const double pays[2] = {paid_by(stage->pay_out_count, stage->pay_out, i, CPS_END_A),
                                paid_by(stage->pay_out_count, stage->pay_out, i, CPS_END_B)};
        status = check_stock(&evolution->given_line[i], evolution->line[i].drums.stored, pays, what,
                             err);
    }
    return status;
}

void cpsi_pay_outs_plan(CpsEvolution *evolution, const CpsiEvolutionStage *stage) {
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++)
            evolution->move[i].stored_from[end] = evolution->move[i].stored_to[end] =
                evolution->line[i].drums.stored[end];
    for (int k = 0; k < stage->pay_out_count; k++) {
        const CpsPayOut *pay = &stage->pay_out[k];
        double *to = &evolution->move[pay->line].stored_to[pay->end];
        *to = fmax(0, *to - pay->length / stage->steps);
    }
}

bool cpsi_drums_are_sound(const CpsiLine *line, const double stored[2]) {
    double sum = 0;
    for (int end = 0; end < 2; end++) {
        if (!(stored[end] >= 0) || (!line->drums.on[end] && stored[end] != 0)) return false;
        sum += stored[end];
    }
    return sum == 0 || sum < line->drums.place[line->n - 1];
}

CpsWinchReport cps_evolution_winch_report(const CpsEvolution *evolution, int line, int end) {
    CpsWinchReport out = {.is_there = false};
    if (!evolution || line < 0 || line >= evolution->line_count ||
        (end != CPS_END_A && end != CPS_END_B))
        return out;
    const CpsiLine *of = &evolution->line[line];
    if (!of->drums.on[end]) return out;
    out = (CpsWinchReport){.is_there = true,
                           .node = cpsi_line_end_node(of, end),
                           .stored = of->drums.stored[end],
                           .paid = of->length,
                           .length = of->drums.length};
    if (evolution->report.step_count > 0) out.pull = cpsi_winch_pull(of, end, false);
    return out;
}
