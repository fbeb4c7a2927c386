/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines with a static and a dynamic stiffness, from a scene to the checker: the file is sound and
 * the scene's, and copies with a number changed are refused. */
#include "check.h"
#include "falsified.h"

/* A line in two sections, one with tables, that lies on a bed; slowly, fast, back, slowly, fast. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "obstacles: {bed: {plane: {point: [0, 0, 0]}, friction: 0.4}}\n"
    "types:\n"
    "  chain: {weight: 90, stiffness: 2e6, friction: 0.7}\n"
    "  rope: {weight: 5, stiffness: {strain: [0, 0.01, 0.03], tension: [0, 1000, 5000]},"
    " dynamic_stiffness: {strain: [0, 0.002, 0.01], tension: [0, 500, 4000]}}\n"
    "lines:\n"
    "  leg:\n"
    "    sections: [{type: chain, length: 40, elements: 4}, {type: rope, length: 30, elements: "
    "4}]\n"
    "    start: static\n"
    "    ends: {A: {held: [0, 0, 0]}, B: {held: [60, 0, 20]}}\n"
    "history:\n"
    "  - {name: mean, stiffness: static, leg.B: {position: [64, 0, 20]}}\n"
    "  - {name: surge, leg.B: {position: [65, 0, 20]}}\n"
    "  - {name: back, leg.B: {position: [63, 0, 20]}}\n"
    "  - {name: slow, stiffness: static, leg.B: {position: [64, 1, 20]}}\n"
    "  - {name: fast, leg.B: {position: [64.5, 1, 20]}}\n";
enum { STEPS = 6, ELEMENTS = 8 };

#define REST(step, element) ((step)*ELEMENTS + (element))

static const FalseNumber FALSE[] = {
    {"leg_rest_strain", REST(1, 5), 1e-9, "rest strains by the static stiffness"},
    {"leg_rest_strain", REST(2, 5), 0.006, "rest strains that are not those of the state reached"},
    {"leg_rest_strain", REST(2, 2), 1e-9, "rest strains that are not those of the state reached"},
    {"leg_rest_strain", REST(3, 6), 0.006, "rest strains that change while the dynamic stiffness"},
    {"leg_rest_strain", REST(2, 5), -1e-3, "senseless rest strain"},
    {"leg_stiffness", 2, 0, "rest strains by the static stiffness"},
    {"leg_stiffness", 3, 2, "senseless stiffness"},
    {"leg_dynamic_compliance_factor", 4, 1, "rest strains that are not those of the state"},
    {"leg_dynamic_compliance_factor", 1, -1, "senseless dynamic stiffness"},
    {"leg_dynamic_spring_strain", 0, 0.001, "sum of local gaps"},
    {"leg_dynamic_spring_stiffness", 1, 1e5, "sum of local gaps"},
    {"leg_dynamic_spring_element", 0, 1, "sum of local gaps"},
    {"leg_ledger_ends", 4, 0, "claimed ledger_ends"},
    {"leg_ledger_elastic", 2, 0, "claimed ledger_elastic"},
};

static const OtherScene OTHER[] = {
    {"strain: [0, 0.002, 0.01]", "strain: [0, 0.002, 0.0101]"},
    {"tension: [0, 500, 4000]", "tension: [0, 501, 4000]"},
    {", dynamic_stiffness: {strain: [0, 0.002, 0.01], tension: [0, 500, 4000]}}\n",
     ", dynamic_stiffness: 6e5}\n"},
    {"stiffness: 2e6,", "stiffness: 2e6, dynamic_stiffness: 3e6,"},
    {"name: surge,", "name: surge, stiffness: static,"},
    {"name: slow, stiffness: static,", "name: slow,"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
