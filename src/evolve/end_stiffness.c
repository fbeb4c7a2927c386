/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of the ends of lines, of points and of bodies (capstan/stiffness.h). */
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

static CpsStatus check_kind(CpsStiffnessKind kind, CpsError *err) {
    if (kind == CPS_STIFFNESS_STEP || kind == CPS_STIFFNESS_STICK) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "kind %d, expected CPS_STIFFNESS_STEP or CPS_STIFFNESS_STICK", (int)kind);
}

/* Is there a step of which there may be a stiffness? */
static bool has_step(const CpsEvolution *evolution) {
    return evolution->done + evolution->move_count > 0 && !cpsi_move_failed(evolution);
}

static CpsiLineStiffness stiffness_of_line(const CpsEvolution *evolution, int line,
                                           CpsStiffnessKind kind, const bool moves[2]) {
    cpsi_workspace_attach(&evolution->workspace[0], &evolution->line[line]);
    return cpsi_line_stiffness(&evolution->line[line], &evolution->workspace[0].program,
                               &evolution->options, kind, moves);
}

/* Where entry i of a block (3, 3) of two ends is in their matrix (6, 6). */
static int block_entry(int to, int from, int i) { return 6 * (3 * to + i / 3) + 3 * from + i % 3; }

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
    const CpsiLineStiffness found =
        stiffness_of_line(evolution, line, kind,
                          (const bool[2]){end == CPS_END_A, end == CPS_END_B});
    out->outcome = found.outcome;
    out->has_smooth = found.has_smooth;
    for (int i = 0; i < 9; i++) {
        out->matrix[i] = found.matrix[block_entry(end, end, i)];
        out->smooth[i] = found.smooth[block_entry(end, end, i)];
    }
    return CPS_OK;
}

/* Add what a line brings at its ends at a point; false, with the outcome, where it has none. */
static bool add_to_point(const CpsEvolution *evolution, int line, int point, CpsStiffnessKind kind,
                         CpsStiffness *out) {
    const int *tie = &evolution->points.tie[2 * line];
    const bool moves[2] = {tie[0] == point, tie[1] == point};
    if (!moves[0] && !moves[1]) return true;
    const CpsiLineStiffness found = stiffness_of_line(evolution, line, kind, moves);
    out->outcome = found.outcome;
    out->has_smooth = out->has_smooth && found.has_smooth;
    if (found.outcome != CPS_STIFFNESS_OUTCOME_FOUND) return false;
    for (int k = 0; k < 4; k++) /* blocks of an end that does not move are 0 */
        for (int i = 0; i < 9; i++) {
            out->matrix[i] += found.matrix[block_entry(k / 2, k % 2, i)];
            out->smooth[i] += found.smooth[block_entry(k / 2, k % 2, i)];
        }
    return true;
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
    out->has_smooth = true;
    if (cps_outcome_is_certified(cps_evolution_report(evolution).outcome))
        out->outcome = CPS_STIFFNESS_OUTCOME_FOUND; /* also of a point without lines */
    bool found = true;
    for (int i = 0; found && i < evolution->line_count; i++)
        found = add_to_point(evolution, i, point, kind, out);
    found = found && out->outcome == CPS_STIFFNESS_OUTCOME_FOUND;
    out->has_smooth = found && out->has_smooth;
    for (int i = 0; i < 9; i++) {
        if (!found) out->matrix[i] = 0;
        if (!out->has_smooth) out->smooth[i] = 0;
    }
    return CPS_OK;
}

/* Add A' K B, A = [I, -[a]] and B = [I, -[b]], of the force at the arm a by the place at the arm b:
 * block (to, from) of the stiffness of a line. */
static void add_block(const double stiffness[36], int to, int from, const Vec3 arm[2],
                      double out[36]) {
    const Vec3 a = arm[to], b = arm[from];
    const double by[2][3][6] = {
        {{1, 0, 0, 0, a.z, -a.y}, {0, 1, 0, -a.z, 0, a.x}, {0, 0, 1, a.y, -a.x, 0}},
        {{1, 0, 0, 0, b.z, -b.y}, {0, 1, 0, -b.z, 0, b.x}, {0, 0, 1, b.y, -b.x, 0}}};
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            for (int k = 0; k < 9; k++)
                out[6 * i + j] +=
                    by[0][k / 3][i] * stiffness[block_entry(to, from, k)] * by[1][k % 3][j];
}

/* The body that an end is on, or -1. */
static int body_of(const CpsEvolution *evolution, int line, int end) {
    const int point = evolution->points.tie[2 * line + end];
    if (point == CPSI_NO_POINT) return -1;
    const CpsPoint *given = &evolution->points.given[point];
    return given->kind == CPS_POINT_KIND_ON_BODY ? given->body : -1;
}

/* Add what a line brings at its ends on a body; false, with the outcome, where it has no stiffness.
 */
static bool add_line(const CpsEvolution *evolution, int line, int body, CpsStiffnessKind kind,
                     CpsBodyStiffness *out) {
    const CpsiLine *of = &evolution->line[line];
    const CpsiPose *pose = &evolution->bodies.body[body].pose;
    const bool moves[2] = {body_of(evolution, line, 0) == body,
                           body_of(evolution, line, 1) == body};
    Vec3 arm[2] = {{0}};
    if (!moves[0] && !moves[1]) return true;
    const CpsiLineStiffness found = stiffness_of_line(evolution, line, kind, moves);
    out->outcome = found.outcome;
    out->has_smooth = out->has_smooth && found.has_smooth;
    if (found.outcome != CPS_STIFFNESS_OUTCOME_FOUND) return false;
    for (int end = 0; end < 2; end++) {
        if (!moves[end]) continue;
        const CpsPoint *point = &evolution->points.given[evolution->points.tie[2 * line + end]];
        const Vec3 pull = vec3_scale(-1, vec3_load(of->report.end[end].force));
        arm[end] = rotation_apply(pose->turn, vec3_load(point->position));
        cpsi_add_turning_force(pull, arm[end], out->matrix);
        cpsi_add_turning_force(pull, arm[end], out->smooth);
    }
    for (int k = 0; k < 4; k++) { /* blocks of an end that does not move are 0 */
        add_block(found.matrix, k / 2, k % 2, arm, out->matrix);
        add_block(found.smooth, k / 2, k % 2, arm, out->smooth);
    }
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
    const CpsStatus status = check_kind(kind, err);
    if (status || !has_step(evolution)) return status;
    const CpsiBody *of = &evolution->bodies.body[body];
    bool found = true;
    out->has_smooth = true;
    if (cps_outcome_is_certified(cps_evolution_report(evolution).outcome))
        out->outcome = CPS_STIFFNESS_OUTCOME_FOUND; /* also of a body without lines */
    for (int i = 0; found && i < evolution->line_count; i++)
        found = add_line(evolution, i, body, kind, out);
    found = found && out->outcome == CPS_STIFFNESS_OUTCOME_FOUND;
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
