/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends that are let go, and lines that part (failure.h).
 *
 * Which ends were let go is the only state; the ties of ends to points follow from it. Whether a
 * line is above its break_at follows from its tensions. */
#include "evolve/failure.h"

#include <math.h>

/* Shares that differ by less are equal: a line that is equally taut everywhere parts at the same
 * end whatever the rounding of its tensions. */
static const double EQUAL = 1e-9;

const char *cps_release_name(CpsRelease release) {
    return release == CPS_RELEASE_BY_STAGE   ? "released"
           : release == CPS_RELEASE_BY_BREAK ? "parted"
           : release == CPS_RELEASE_TAKEN    ? "taken"
                                             : "none";
}

void cpsi_follow_releases(CpsEvolution *evolution) {
    CpsiPoints *points = &evolution->points;
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++) {
            const int k = 2 * i + end, given = points->tie_given[k];
            if (given == CPSI_NO_POINT) continue;
            points->tie[k] = evolution->release[k] == CPS_RELEASE_NONE ? given : CPSI_NO_POINT;
            const bool is_there = points->tie[k] != CPSI_NO_POINT;
            evolution->line[i].is_at_point[end] = is_there;
            evolution->given_line[i].end[end].kind =
                is_there ? CPS_END_KIND_POINT : CPS_END_KIND_FREE;
        }
}

void cpsi_release_end(CpsEvolution *evolution, int line, int end, CpsRelease by) {
    evolution->release[2 * line + end] = by;
    cpsi_follow_releases(evolution);
}

CpsEnd cpsi_end_now(const CpsEvolution *evolution, int line, int end) {
    const CpsRelease release = evolution->release[2 * line + end];
    const bool is_let_go = release == CPS_RELEASE_BY_STAGE || release == CPS_RELEASE_BY_BREAK;
    return is_let_go ? (CpsEnd){.kind = CPS_END_KIND_FREE} : evolution->line[line].end[end];
}

bool cpsi_change_is_lost(const CpsEvolution *evolution, const CpsiEvolutionStage *stage,
                         const CpsChange *change) {
    return stage != &evolution->live &&
           evolution->release[2 * change->line + change->end] == CPS_RELEASE_BY_BREAK;
}

/* The largest share of a line, and where. */
typedef struct Share {
    double most, arc_length, tension, break_at;
} Share;

static void raise(Share *share, double *largest, double tension, double break_at,
                  double arc_length) {
    const double own = tension / break_at;
    *largest = fmax(*largest, own);
    if (!(own > share->most * (1 + EQUAL))) return;
    *share = (Share){own, arc_length, tension, break_at};
}

static Share share_of(const CpsiLine *line) {
    Share share = {0};
    double largest = 0;
    const int last = line->n - 2;
    if (!line->has_break_at) return share;
    raise(&share, &largest, line->report.end[CPS_END_B].tension, line->break_at[last],
          line->length);
    raise(&share, &largest, line->report.end[CPS_END_A].tension, line->break_at[0], 0);
    for (int e = 0; e <= last; e++)
        raise(&share, &largest, line->tension[e], line->break_at[e],
              0.5 * (line->arc_length[e] + line->arc_length[e + 1]));
    share.most = largest;
    return share;
}

/* Is there something to let go at an end: is it held, or does a force act on it? */
static bool is_loaded(const CpsEvolution *evolution, int line, int end) {
    const CpsEnd now = cpsi_end_now(evolution, line, end);
    return now.kind == CPS_END_KIND_HELD || now.value[0] != 0 || now.value[1] != 0 ||
           now.value[2] != 0;
}

CpsBreak cpsi_break_due(const CpsEvolution *evolution) {
    CpsBreak due = {0};
    if (evolution->report.step_count == 0 || evolution->ended ||
        !cps_outcome_is_certified(evolution->report.outcome))
        return due;
    double most = 1;
    for (int i = 0; i < evolution->line_count; i++) {
        const CpsiLine *line = &evolution->line[i];
        if (!line->has_break_at ||
            !(is_loaded(evolution, i, CPS_END_A) || is_loaded(evolution, i, CPS_END_B)))
            continue;
        const Share share = share_of(line);
        if (!(share.most > most * (due.is_break ? 1 + EQUAL : 1))) continue;
        most = share.most;
        const int nearest = share.arc_length < 0.5 * line->length ? CPS_END_A : CPS_END_B;
        due = (CpsBreak){.is_break = true,
                         .line = i,
                         .end = is_loaded(evolution, i, nearest) ? nearest : 1 - nearest,
                         .tension = share.tension,
                         .break_at = share.break_at,
                         .arc_length = share.arc_length};
    }
    return due;
}

/* queries -------------------------------------------------------------------------------------- */

CpsLineFailure cps_evolution_line_failure(const CpsEvolution *evolution, int line) {
    if (!evolution || line < 0 || line >= evolution->line_count) return (CpsLineFailure){0};
    const CpsiLine *of = &evolution->line[line];
    const CpsRelease *release = &evolution->release[2 * (size_t)line];
    const Share share = share_of(of);
    return (CpsLineFailure){.release = {release[0], release[1]},
                            .has_break_at = of->has_break_at,
                            .share = share.most,
                            .arc_length = share.arc_length,
                            .break_at = of->has_break_at ? of->break_at : NULL};
}

CpsBreak cps_evolution_break(const CpsEvolution *evolution) {
    return evolution ? evolution->parted : (CpsBreak){0};
}

bool cps_evolution_breaks(const CpsEvolution *evolution) {
    return evolution && cpsi_break_due(evolution).is_break;
}
