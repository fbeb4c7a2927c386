/* SPDX-License-Identifier: BSD-3-Clause */
/* Offsets by moves that the history does not hold (offset_run.h). */
#include "offset/offset_run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "signals.h"

static const double DEGREES = 57.29577951308232;

CpsEvolution *offset_begin(const CpsScene *scene, CpsOutcome *worst, CpsError *err) {
    CpsEvolution *evolution = NULL;
    CpsStatus status = cli_evolution_create(scene, &evolution, err);
    *worst = CPS_OUTCOME_SOLVED;
    while (status == CPS_OK && cps_evolution_remaining_count(evolution) > 0 &&
           cps_outcome_is_certified(*worst)) {
        status = cps_evolution_step(evolution, err);
        if (status == CPS_OK) *worst = cps_evolution_report(evolution).outcome;
    }
    if (status == CPS_OK) return evolution;
    cps_evolution_destroy(evolution);
    return NULL;
}

/* The largest tension of all lines, its line, and the largest utilisation. */
static double largest_tension(const CpsEvolution *evolution, int *line, double *utilisation) {
    double most = 0;
    *line = 0;
    *utilisation = 0;
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i) {
        const CpsLineReport report = cps_evolution_line_report(evolution, i);
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        double own = fmax(report.end[CPS_END_A].tension, report.end[CPS_END_B].tension);
        for (int e = 0; e < view.element_count; ++e) own = fmax(own, view.tension[e]);
        if (own > most) *line = i;
        most = fmax(most, own);
        if (report.has_utilisation) *utilisation = fmax(*utilisation, report.utilisation);
    }
    return most;
}

static CpsOffsetPlace place_now(const CpsEvolution *evolution, int body, double heading,
                                double offset) {
    const CpsBodyReport report = cps_evolution_body_report(evolution, body);
    const double x = cos(heading / DEGREES), y = sin(heading / DEGREES);
    CpsOffsetPlace out = {.offset = offset,
                          .restoring = -(report.lines[0] * x + report.lines[1] * y),
                          .across = report.lines[1] * x - report.lines[0] * y,
                          .certified =
                              cps_outcome_is_certified(cps_evolution_report(evolution).outcome)};
    memcpy(out.lines, report.lines, sizeof out.lines);
    out.tension = largest_tension(evolution, &out.tension_line, &out.utilisation);
    return out;
}

/* Hold the body at the offset. */
static CpsStatus go_to(CpsEvolution *evolution, int body, const CpsBodyReport *from, double heading,
                       double offset, CpsError *err) {
    CpsBodyChange change = {.body = body, .kind = CPS_BODY_KIND_HELD};
    memcpy(change.position, from->position, sizeof change.position);
    memcpy(change.rotation, from->rotation, sizeof change.rotation);
    change.position[0] += offset * cos(heading / DEGREES);
    change.position[1] += offset * sin(heading / DEGREES);
    CpsStage move = cps_stage_default();
    move.static_stiffness = true; /* an offset that is held */
    move.body_change_count = 1;
    move.body_change = &change;
    return cps_evolution_move(evolution, &move, err);
}

static CpsStatus walk(CpsEvolution *evolution, int body, double heading, double to, int steps,
                      CpsOffsetPlace *place, int *count, CpsError *err) {
    const CpsBodyReport from = cps_evolution_body_report(evolution, body);
    int farthest = steps;
    CpsStatus status = CPS_OK;
    *count = 0;
    for (int k = 0; status == CPS_OK && k <= 2 * farthest; ++k) {
        const double offset = to * (k <= farthest ? k : 2 * farthest - k) / steps;
        bool parted = false;
        status = go_to(evolution, body, &from, heading, offset, err);
        while (status == CPS_OK && cps_evolution_breaks(evolution)) {
            status = cps_evolution_step(evolution, err);
            parted = true;
        }
        if (status != CPS_OK) break;
        place[*count] = place_now(evolution, body, heading, offset);
        if (!place[(*count)++].certified && k <= farthest) {
            if (k == 0 || parted) break; /* a break is not taken back */
            farthest = k - 1;
            status = cps_evolution_take_back(evolution, err);
            k = farthest;
        }
    }
    return status;
}

CpsStatus offset_curve(CpsEvolution *evolution, int body, double heading, double to, int steps,
                       CpsOffsetPlace *place, int *count, CpsError *err) {
    const size_t size = cps_evolution_state_size(evolution);
    void *state = malloc(size);
    *count = 0;
    if (!state) {
        *err = (CpsError){.status = CPS_ERR_MEMORY, .message = "out of memory"};
        return CPS_ERR_MEMORY;
    }
    cps_evolution_save(evolution, state);
    CpsStatus status = walk(evolution, body, heading, to, steps, place, count, err);
    if (status == CPS_OK) status = cps_evolution_load(evolution, state, size, err);
    free(state);
    return status;
}

/* Is the end at a point on a body? */
static bool is_on_body(const CpsScene *scene, int line, int end) {
    const CpsLine *of = &scene->line[line];
    return of->end[end].kind == CPS_END_KIND_POINT &&
           scene->point[of->end_point[end]].kind == CPS_POINT_KIND_ON_BODY;
}

void offset_case(const CpsScene *scene, const CpsEvolution *evolution, int body,
                 CpsOffsetCase *out) {
    const CpsBodyReport report = cps_evolution_body_report(evolution, body);
    const double *q = report.rotation;
    int line;
    memcpy(out->position, report.position, sizeof out->position);
    out->heel = DEGREES * acos(fmax(-1, fmin(1, 1 - 2 * (q[1] * q[1] + q[2] * q[2]))));
    out->tension = largest_tension(evolution, &line, &out->utilisation);
    out->tension_line = scene->line[line].name;
    out->uplift = -INFINITY;
    for (int i = 0; i < scene->line_count; ++i)
        for (int end = 0; end < 2; ++end)
            if (!is_on_body(scene, i, end))
                out->uplift =
                    fmax(out->uplift, cps_evolution_line_report(evolution, i).end[end].uplift);
}
