/* SPDX-License-Identifier: BSD-3-Clause */
/* Bodies that are each stable while the others stay, from a scene to the checker: two masts which
 * lean on each other, by a line and by way of a knot, fall together, and two with stiffer stays do
 * not. */
#include "check.h"
#include "falsified.h"

#define MAST(name, x)        \
    "  " name ": {free: [" x \
    "], fixed: [x, y, z, rx, rz], weight: 100, centre_of_gravity: [0, 0, 1]}\n"
#define LINE(name, length, stiffness, from, to)                           \
    "  " name ": {length: " length ", elements: 1, stiffness: " stiffness \
    ", weight: 0, start: static, ends: {A: {" from "}, B: {" to "}}}\n"

/* All lines are stretched by 0.1, and have 60 N/m or 120 N/m. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "bodies:\n" MAST("a", "0, 0, 0") MAST("b", "2, 0, 0") MAST("c", "0, 5, 0") MAST("d", "4, 5, 0")
        MAST("e", "0, 9, 0")
            MAST("f",
                 "2, 9, 0") "points:\n"
                            "  ta: {body: a, at: [0, 0, 1]}\n"
                            "  tb: {body: b, at: [0, 0, 1]}\n"
                            "  tc: {body: c, at: [0, 0, 1]}\n"
                            "  td: {body: d, at: [0, 0, 1]}\n"
                            "  te: {body: e, at: [0, 0, 1]}\n"
                            "  tf: {body: f, at: [0, 0, 1]}\n"
                            "  knot: {free: [2, 5, 1]}\n"
                            "lines:\n" LINE("wa", "9.9", "594", "held: [-10, 0, 1]", "point: ta")
                                LINE("ab", "1.9", "114", "point: ta", "point: tb")
                                    LINE("eb", "9.9", "594", "held: [12, 0, 1]", "point: tb")
                                        LINE("wc", "9.9", "594", "held: [-10, 5, 1]", "point: tc")
                                            LINE("ck", "1.95", "234", "point: tc", "point: knot")
                                                LINE("kd", "1.95", "234", "point: knot",
                                                     "point: td") LINE("ed", "9.9", "594",
                                                                       "held: [14, 5, 1]",
                                                                       "point: td")
                                                    LINE("we", "9.9", "1188", "held: [-10, 9, 1]",
                                                         "point: te") LINE("ef", "1.9", "228",
                                                                           "point: te", "point: tf")
                                                        LINE("ff", "9.9", "1188",
                                                             "held: [12, 9, 1]", "point: tf");
enum { STEPS = 1, LINES = 10, BODIES = 6, A = 0, B = 1, C = 2, E = 4 };

static const FalseNumber FALSE[] = {
    {"stable_of_body", A, 1, "body a: it is said to be stable, but its stiffness is not with that"},
    {"stable_of_body", B, 1, "body b: it is said to be stable, but its stiffness is not with that"},
    {"stable_of_body", C, 1, "body c: it is said to be stable, but its stiffness is not with that"},
    {"stable_of_body", E, 0, "body e: it is said to be not stable, but its stiffness is positive"},
    {"stiffness_rr_of_body", 9 * A + 4, 500, "body a: it is said to be not stable"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = LINES * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE)};
    return falsified_main(&FALSIFIED);
}
