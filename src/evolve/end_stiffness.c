/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of the ends of lines (capstan/stiffness.h). */
#include "capstan/evolve.h"

#include "base/status.h"
#include "base/words.h"
#include "cable/stiffness.h"
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
