/* SPDX-License-Identifier: BSD-3-Clause */
/* Keys and sentences of outcomes, from the list in evolve.h. */
#include "capstan/evolve.h"

const char *cps_outcome_key(CpsOutcome outcome) {
    switch (outcome) {
#define CASE(name, number, key, sentence)                                                                              \
    case name: return key;
        CPS_OUTCOME_LIST(CASE)
#undef CASE
    }
    return "unknown";
}

const char *cps_outcome_sentence(CpsOutcome outcome) {
    switch (outcome) {
#define CASE(name, number, key, sentence)                                                                              \
    case name: return sentence;
        CPS_OUTCOME_LIST(CASE)
#undef CASE
    }
    return "unknown outcome";
}
