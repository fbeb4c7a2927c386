/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends that are let go and lines that part, from a scene to the checker: the file is sound and the
 * scene's, and copies with a number changed are refused, by themselves or beside their scene. */
#include "check.h"
#include "falsified.h"

/* Three legs on a bed hold a buoy. It is pulled until the first leg parts, and then, in the same
 * stage, while a drum turns aside, on; the second leg is let go by the history, and its end taken
 * hold of again. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\nobstacles:\n"
    "  bed: {plane: {point: [0, 0, -9]}, friction: 0.2}\n"
    "  drum: {cylinder: {point: [0, 0, 90], axis: [0, 1, 0], radius: 2}, friction: 0.3}\n"
    "points:\n"
    "  buoy: {free: [0, 0, 0], weight: -400}\n"
    "lines:\n"
    "  a: {length: 16, elements: 8, weight: 10, stiffness: 1e5, break_at: 600, start: static, "
    "ends: "
    "{A: {held: [12, 0, -9]}, B: {point: buoy}}}\n"
    "  b: {length: 16, elements: 8, weight: 10, stiffness: 1e5, break_at: 3000, start: static, "
    "ends: "
    "{B: {held: [-6, 10, -9]}, A: {point: buoy}}}\n"
    "  c: {length: 16, elements: 8, weight: 10, stiffness: 1e5, start: static, ends: {A: {held: "
    "[-6, "
    "-10, -9]}, B: {point: buoy}}}\n"
    "history:\n"
    "  - {name: pull, steps: 3, buoy.point: {force: [-900, 0, 0]}, drum.turn: 30, gravity: [0, 0, "
    "-10.5]}\n"
    "  - {name: let go, steps: 2, b.A: {release: true}}\n"
    "  - {name: take, steps: 2, b.A: {position: [2, 3, -6]}}\n"
    "  - {name: last, a.A: {move: [1, 0, 0]}}\n";
enum { STEPS = 10, LINES = 3, BREAK = 3, A = 0, B = 1 };

/* Ends A and B of a line in a step. */
#define END(step, end) (2 * (step) + (end))

static const FalseNumber FALSE[] = {
    {"break_line", BREAK, -1, "no line, end or tension"},
    {"break_line", BREAK, 1, "line b: it parts, but was at"},
    {"break_line", BREAK, 3, "no line, end or tension"},
    {"break_line", BREAK - 1, 0, "no line, end or tension"},
    {"break_end", BREAK, 0, "line a: end B has parted, but the step is no break of it"},
    {"break_end", BREAK, 2, "no line, end or tension"},
    {"break_tension", BREAK, 599, "line a: it parts at end B with 599 N, which is not where"},
    {"a_end_release", END(BREAK, B), 0, "end of line a is free"},
    {"a_end_release", END(BREAK, B), 1, "line a: it parts, but end_release"},
    {"a_end_release", END(BREAK + 1, B), 0, "line a: end B was let go, and is again as if"},
    {"a_end_release", END(BREAK + 1, B), 1, "line a: end B has parted, but the step is no break"},
    {"a_end_release", END(STEPS - 1, B), 1, NULL},
    {"a_end_release", END(BREAK - 1, B), 2, "line a: end B was let go, but something acts on it"},
    {"a_end_release", END(BREAK, A), 1, "line a: end A was let go, but something acts on it"},
    {"a_end_release", END(BREAK, B), 4, "unknown way of letting go"},
    {"b_end_release", END(6, A), 2, "line b: end A has parted, but the step is no break of it"},
    {"b_end_release", END(6, A), 0, "end of line b is free"},
    {"b_end_release", END(8, A), 0, "line b: end A was let go, and is again as if"},
    {"b_end_release", END(8, A), 1, "line b: end A was let go, but something acts on it"},
    {"a_break_at", 7, 3000, "line a: it parts at end B with"},
    {"b_break_at", 0, 300, "line b: it was at"},
    {"a_break_at", 3, 601, NULL},
    {"b_break_at", 3, -1, "senseless tension"},
    {"obstacle_turn", 2 * BREAK + 1, 0.1, "an obstacle turns in a step in which a line parts"},
    {"c_end_held_position", 6 * BREAK, -6.5, "line c: end A changes in a step in which a line"},
};

/* Scenes in which something else parts or is let go. */
static const OtherScene OTHER[] = {
    {"break_at: 600", "break_at: 601"},
    {", break_at: 3000", ""},
    {"b.A: {release: true}", "b.A: {release: true}, b.B: {release: true}"},
    {"b.A: {release: true}", "b.A: {release: true}, c.B: {release: true}"},
    {"b.A: {position: [2, 3, -6]}", "b.A: {position: [2, 3, -6.00001]}"},
    {"b.A: {position: [2, 3, -6]}", "b.A: {release: true}"},
    {"steps: 3, buoy.point", "steps: 4, buoy.point"},
    {"force: [-900, 0, 0]", "force: [-900, 0, 1e-6]"},
    {"drum.turn: 30", "drum.turn: 30.0001"},
    {"-10.5", "-10.5001"},
    {"  - {name: last, a.A: {move: [1, 0, 0]}}\n", ""},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = LINES * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
