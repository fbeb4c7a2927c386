/* SPDX-License-Identifier: BSD-3-Clause */
/* Keys, sentences and kinds of outcomes, and keys of ranges, from the lists in step.h. */
#include "base/words.h"
#include "capstan/step.h"

static const CpsiWords OUTCOME[] = {CPS_OUTCOME_LIST(CPSI_WORDS_WITH_KEY)};

const char *cps_outcome_name(CpsOutcome outcome) { return CPSI_WORDS(OUTCOME, outcome).name; }

const char *cps_outcome_text(CpsOutcome outcome) { return CPSI_WORDS(OUTCOME, outcome).text; }

bool cps_outcome_is_certified(CpsOutcome outcome) {
    return outcome == CPS_OUTCOME_SOLVED || outcome == CPS_OUTCOME_TAUT;
}

bool cps_outcome_is_final(CpsOutcome outcome) {
    return outcome == CPS_OUTCOME_UNBOUNDED || outcome == CPS_OUTCOME_INFEASIBLE ||
           outcome == CPS_OUTCOME_SLIDES;
}

/* From best to worst: certified solutions, solutions that are not certified, proofs that there is
 * none. */
static int badness(CpsOutcome outcome) {
    switch (outcome) {
    case CPS_OUTCOME_SOLVED: return 0;
    case CPS_OUTCOME_TAUT: return 1;
    case CPS_OUTCOME_MESH_TOO_COARSE: return 2;
    case CPS_OUTCOME_PASSES: return 3;
    case CPS_OUTCOME_STALLED: return 4;
    case CPS_OUTCOME_ITERATION_LIMIT: return 5;
    case CPS_OUTCOME_SLIDES: return 6;
    case CPS_OUTCOME_UNBOUNDED: return 7;
    case CPS_OUTCOME_INFEASIBLE: return 8;
    }
    return 9;
}

CpsOutcome cps_outcome_worse(CpsOutcome a, CpsOutcome b) { return badness(b) > badness(a) ? b : a; }

static const CpsiWords RANGE[] = {CPS_RANGE_LIST(CPSI_WORDS_WITH_KEY)};

const char *cps_range_name(CpsRange range) { return CPSI_WORDS(RANGE, range).name; }
const char *cps_range_text(CpsRange range) { return CPSI_WORDS(RANGE, range).text; }
