/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of the ends of lines, of points and of bodies (capstan/stiffness.h). */
#include "capstan/evolve.h"

#include <string.h>

#include "base/status.h"
#include "base/words.h"
#include "evolve/body_motion.h"
#include "evolve/following.h"
#include "evolve/points.h"

static const CpsiWords KIND[] = {CPS_STIFFNESS_LIST(CPSI_WORDS_WITH_KEY)},
                       OUTCOME[] = {CPS_STIFFNESS_OUTCOME_LIST(CPSI_WORDS_WITH_KEY)};

const char *cps_stiffness_name(CpsStiffnessKind kind) { return CPSI_WORDS(KIND, kind).name; }
const char *cps_stiffness_text(CpsStiffnessKind kind) { return CPSI_WORDS(KIND, kind).text; }
const char *cps_stiffness_outcome_name(CpsStiffnessOutcome outcome) {
    return CPSI_WORDS(OUTCOME, outcome).name;
}
const char *cps_stiffness_outcome_text(CpsStiffnessOutcome outcome) {
    return CPSI_WORDS(OUTCOME, outcome).text;
}

static CpsStatus check_kind(CpsStiffnessKind kind, CpsError *err) {
    if (kind == CPS_STIFFNESS_STEP || kind == CPS_STIFFNESS_STICK) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "kind %d, expected CPS_STIFFNESS_STEP or CPS_STIFFNESS_STICK", (int)kind);
}

/* Is there a step of which there may be a stiffness? */
static bool has_step(const CpsEvolution *evolution) {
    return evolution->done + evolution->move_count > 0 && !cpsi_move_failed(evolution);
}

static void take_matrix(CpsiMovedStiffness found, CpsStiffness *out) {
    out->outcome = found.outcome;
    if (found.outcome != CPS_STIFFNESS_OUTCOME_FOUND) return;
    memcpy(out->matrix, found.matrix, sizeof out->matrix);
    out->has_smooth = found.has_smooth;
    if (found.has_smooth) memcpy(out->smooth, found.smooth, sizeof out->smooth);
}

CpsStatus cps_evolution_stiffness(const CpsEvolution *evolution, int line, int end,
                                  CpsStiffnessKind kind, CpsStiffness *out, CpsError *err) {
    if (!evolution || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL", evolution ? "out" : "evolution");
    *out = (CpsStiffness){.outcome = CPS_STIFFNESS_OUTCOME_NO_STEP};
    if (line < 0 || line >= evolution->line_count)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "line %d: the scene has %d", line,
                         evolution->line_count);
    if (end != CPS_END_A && end != CPS_END_B)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "end %d, expected CPS_END_A or CPS_END_B", end);
    const CpsStatus status = check_kind(kind, err);
    if (status || !has_step(evolution)) return status;
    const CpsiMoved moved = {line, end, evolution->points.tie[2 * line + end], -1};
    take_matrix(cpsi_moved_stiffness(evolution, &moved, kind), out);
    return CPS_OK;
}

CpsStatus cps_evolution_point_stiffness(const CpsEvolution *evolution, int point,
                                        CpsStiffnessKind kind, CpsStiffness *out, CpsError *err) {
    if (!evolution || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL", evolution ? "out" : "evolution");
    *out = (CpsStiffness){.outcome = CPS_STIFFNESS_OUTCOME_NO_STEP};
    if (point < 0 || point >= evolution->points.count)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "point %d: the scene has %d", point,
                         evolution->points.count);
    const CpsStatus status = check_kind(kind, err);
    if (status || !has_step(evolution)) return status;
    /* also of a point without lines */
    if (!cps_outcome_is_certified(cps_evolution_report(evolution).outcome)) return CPS_OK;
    const CpsiMoved moved = {-1, CPS_END_A, point, -1};
    take_matrix(cpsi_moved_stiffness(evolution, &moved, kind), out);
    return CPS_OK;
}

CpsStatus cps_evolution_body_stiffness(const CpsEvolution *evolution, int body,
                                       CpsStiffnessKind kind, CpsBodyStiffness *out,
                                       CpsError *err) {
    if (!evolution || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s is NULL", evolution ? "out" : "evolution");
    *out = (CpsBodyStiffness){.outcome = CPS_STIFFNESS_OUTCOME_NO_STEP};
    if (body < 0 || body >= evolution->bodies.count)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "body %d: the scene has %d", body,
                         evolution->bodies.count);
    const CpsStatus status = check_kind(kind, err);
    if (status || !has_step(evolution)) return status;
    /* also of a body without lines */
    if (!cps_outcome_is_certified(cps_evolution_report(evolution).outcome)) return CPS_OK;
    const CpsiBody *of = &evolution->bodies.body[body];
    const CpsiMoved moved = {-1, CPS_END_A, CPSI_NO_POINT, body};
    CpsiMovedStiffness found = cpsi_moved_stiffness(evolution, &moved, kind);
    out->outcome = found.outcome;
    if (found.outcome != CPS_STIFFNESS_OUTCOME_FOUND) return CPS_OK;
    cpsi_body_whole_stiffness(evolution, of, &of->pose, found.matrix);
    memcpy(out->matrix, found.matrix, sizeof out->matrix);
    out->has_smooth = found.has_smooth;
    if (!found.has_smooth) return CPS_OK;
    cpsi_body_whole_stiffness(evolution, of, &of->pose, found.smooth);
    memcpy(out->smooth, found.smooth, sizeof out->smooth);
    return CPS_OK;
}
