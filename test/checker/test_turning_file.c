/* SPDX-License-Identifier: BSD-3-Clause */
/* A body that a moment turns for ever, from a scene to the checker: the proof is accepted, and
 * copies with a number changed, or scenes in which it does not hold, are refused. */
#include "check.h"
#include "falsified.h"

/* A buoy on two lines from one eye, turned about the vertical by more than the force on it bears,
 * and a stone beside it that hangs. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "bodies:\n"
    "  stone: {free: [9, 0, -5], weight: 50}\n"
    "  buoy: {free: [0, 0, 9], weight: 1000, buoyancy: 5000, centre_of_buoyancy: [0, 0, 0.5],"
    " centre_of_gravity: [0, 0.1, -0.2], force: [300, 100, 0], moment: [40, 0, 900]}\n"
    "points:\n"
    "  hook: {held: [9, 0, 0]}\n"
    "  ring: {body: stone}\n"
    "  eye: {body: buoy, at: [0.4, 0, -1]}\n"
    "lines:\n"
    "  string: {length: 5, elements: 2, weight: 1, stiffness: 1e6, start: static, ends: {A: "
    "{point: "
    "hook}, B: {point: ring}}}\n"
    "  a: {length: 9, elements: 4, weight: 5, stiffness: 1e6, start: static, ends: {A: {held: [0, "
    "0, 0]}, B: {point: eye}}}\n"
    "  b: {length: 9, elements: 4, weight: 5, stiffness: 1e6, start: static, ends: {A: {point: "
    "eye}, B: {held: [3, 0, 0]}}}\n";
enum { LINES = 3, BUOY = 1 };

/* A finding NULL: only beside the scene. */
static const FalseNumber FALSE[] = {
    {"proof_moment_of_body", BUOY, 500, NULL},
    {"proof_moment_of_body", BUOY, 0, "unbounded"},
    {"proof_moment_of_body", 0, 1, NULL},
    {"proof_of_body", 3 * BUOY, 0.1, NULL},
    {"proof_of_body", 3 * BUOY + 2, -1, NULL},
    {"proof_of_body", 3 * BUOY + 2, 2, NULL},
    {"proof_of_body", 0, 1, NULL},
    {"a_proof_force", 0, 1, "its lines move"},
    {"b_proof", 2, 1, "its lines move"},
    {"b_outcome", 0, 2, "its lines do not claim the same"},
    {"place_on_body_of_point", 3 * 2, 0.5, NULL},
    {"state_of_body", BUOY, 0, NULL},
    {"has_place_of_body", BUOY, 1, NULL},
};

/* Scenes in which it turns otherwise, or may rest. */
static const OtherScene OTHER[] = {
    {"moment: [40, 0, 900]", "moment: [40, 0, 300]"},
    {"moment: [40, 0, 900]", "moment: [40, 0, 901]"},
    {"force: [300", "force: [301"},
    {"force: [300, 100, 0]", "fixed: [rz], force: [300, 100, 0]"},
    {"force: [300, 100, 0]", "fixed: [x], force: [300, 100, 0]"},
    {"force: [300, 100, 0]", "hydrostatics: {rz: 1}, force: [300, 100, 0]"},
    {"at: [0.4, 0, -1]", "at: [0.4, 0.1, -1]"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = LINES,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
