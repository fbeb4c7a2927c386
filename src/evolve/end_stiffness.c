/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of the ends of lines, and of bodies (capstan/stiffness.h). */
#include "capstan/evolve.h"

#include "base/status.h"
#include "base/words.h"
#include "cable/stiffness.h"
#include "evolve/bodies.h"
#include "evolve/state.h"

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
    if (kind != CPS_STIFFNESS_STEP && kind != CPS_STIFFNESS_STICK)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "kind %d, expected CPS_STIFFNESS_STEP or CPS_STIFFNESS_STICK", (int)kind);
    if (evolution->done + evolution->move_count == 0 || cpsi_move_failed(evolution)) return CPS_OK;
    cpsi_workspace_attach(&evolution->workspace[0], &evolution->line[line]);
    *out = cpsi_line_stiffness(&evolution->line[line], &evolution->workspace[0].program,
                               &evolution->options, kind, end);
    return CPS_OK;
}

/* Add A' K A, A = [I, -[a]], for the stiffness K of an end at the arm a. */
static void add_end(const double k[9], Vec3 a, double out[36]) {
    const double by[3][6] = {{1, 0, 0, 0, a.z, -a.y},
                             {0, 1, 0, -a.z, 0, a.x},
                             {0, 0, 1, a.y, -a.x, 0}};
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            for (int b = 0; b < 3; b++)
                for (int c = 0; c < 3; c++) out[6 * i + j] += by[b][i] * k[3 * b + c] * by[c][j];
}

/* The body that an end is on, or -1. */
static int body_of(const CpsEvolution *evolution, int line, int end) {
    const int point = evolution->points.tie[2 * line + end];
    if (point == CPSI_NO_POINT) return -1;
    const CpsPoint *given = &evolution->points.given[point];
    return given->kind == CPS_POINT_KIND_ON_BODY ? given->body : -1;
}

/* Add what a line brings at one of its ends; false, with the outcome, where it has no stiffness. */
static bool add_line(const CpsEvolution *evolution, int line, int end, CpsStiffnessKind kind,
                     CpsBodyStiffness *out) {
    const int index = body_of(evolution, line, end);
    const CpsiBody *body = &evolution->bodies.body[index];
    const CpsPoint *given = &evolution->points.given[evolution->points.tie[2 * line + end]];
    const CpsiLine *of = &evolution->line[line];
    const Vec3 arm = rotation_apply(body->pose.turn, vec3_load(given->position));
    out->outcome = CPS_STIFFNESS_OUTCOME_NOT_GIVEN;
    if (body_of(evolution, line, !end) == index) return false;
    cpsi_workspace_attach(&evolution->workspace[0], &evolution->line[line]);
    const CpsStiffness found =
        cpsi_line_stiffness(of, &evolution->workspace[0].program, &evolution->options, kind, end);
    out->outcome = found.outcome;
    if (found.outcome != CPS_STIFFNESS_OUTCOME_FOUND) return false;
    const Vec3 pull = vec3_scale(-1, vec3_load(of->report.end[end].force));
    add_end(found.matrix, arm, out->matrix);
    add_end(found.smooth, arm, out->smooth);
    out->has_smooth = out->has_smooth && found.has_smooth;
    cpsi_add_turning_force(pull, arm, out->matrix);
    cpsi_add_turning_force(pull, arm, out->smooth);
    return true;
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
    if (kind != CPS_STIFFNESS_STEP && kind != CPS_STIFFNESS_STICK)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "kind %d, expected CPS_STIFFNESS_STEP or CPS_STIFFNESS_STICK", (int)kind);
    if (evolution->done + evolution->move_count == 0 || cpsi_move_failed(evolution)) return CPS_OK;
    const CpsiBody *of = &evolution->bodies.body[body];
    bool found = true;
    out->has_smooth = true;
    for (int i = 0; found && i < evolution->line_count; i++)
        for (int end = 0; found && end < 2; end++)
            if (body_of(evolution, i, end) == body) found = add_line(evolution, i, end, kind, out);
    if (found) {
        cpsi_body_stiffness(of, &of->pose, evolution->gravity, out->matrix);
        cpsi_body_stiffness(of, &of->pose, evolution->gravity, out->smooth);
    }
    out->has_smooth = found && out->has_smooth;
    for (int i = 0; i < 36; i++) {
        if (!found) out->matrix[i] = 0;
        if (!out->has_smooth) out->smooth[i] = 0;
    }
    return CPS_OK;
}
