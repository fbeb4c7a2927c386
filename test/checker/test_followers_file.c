/* SPDX-License-Identifier: BSD-3-Clause */
/* A body whose lines lead to free points, from a scene to the checker: what it loses as they follow
 * is that of the file, and copies in which it is that with the points held are refused. */
#include "check.h"
#include "falsified.h"

/* A mast on a hinge between two stays of two pieces each, which meet at knots: by knots that were
 * held it would be stable. A buoy with a leg to a clump
 * on the bed, where it rests and is dragged. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -10]\n"
    "obstacles: {bed: {plane: {point: [0, 0, -20]}, friction: 0.5}}\n"
    "bodies:\n"
    "  mast: {free: [0, 0, 0], fixed: [x, y, z, rx, rz], weight: 981, centre_of_gravity: [0, 0, "
    "1]}\n"
    "  buoy: {free: [40, 0, 0], weight: 500, buoyancy: 1500, centre_of_buoyancy: [0, 0, 0.5],"
    " hydrostatics: {z: 500, rx: 300, ry: 300, rz: 300}, force: [100, 5, 0]}\n"
    "points:\n"
    "  top: {body: mast, at: [0, 0, 1]}\n"
    "  west: {free: [-5, 0, 1]}\n"
    "  east: {free: [5, 0, 1]}\n"
    "  bow: {body: buoy, at: [1, 0, -1]}\n"
    "  stern: {body: buoy, at: [-1, 0, -1]}\n"
    "  fore: {free: [50, 0, -20], weight: 900}\n"
    "lines:\n"
    "  a: {length: 4.9, elements: 1, stiffness: 3430, weight: 0, start: static, ends: {A: {held: "
    "[-10, 0, 1]}, B:"
    " {point: west}}}\n"
    "  b: {length: 4.9, elements: 1, stiffness: 3430, weight: 0, start: static, ends: {A: {point: "
    "west}, B: {point:"
    " top}}}\n"
    "  c: {length: 4.9, elements: 1, stiffness: 3430, weight: 0, start: static, ends: {A: {point: "
    "top}, B: {point:"
    " east}}}\n"
    "  d: {length: 4.9, elements: 1, stiffness: 3430, weight: 0, start: static, ends: {A: {point: "
    "east}, B: {held:"
    " [10, 0, 1]}}}\n"
    "  e: {length: 21, elements: 4, weight: 1, stiffness: 2e4, start: static, ends: {A: {point: "
    "bow}, B: {point:"
    " fore}}}\n"
    "  f: {length: 33, elements: 4, weight: 1, stiffness: 2e4, start: static, ends: {A: {point: "
    "stern}, B: {held:"
    " [15, 0, -20]}}}\n"
    "  g: {length: 9, elements: 3, weight: 1, stiffness: 2e4, start: static, ends: {A: {point: "
    "fore}, B: {held: [60,"
    " 0, -19]}}}\n"
    "history:\n"
    "  - {name: push, steps: 2, buoy.body: {force: [-300, 20, 0]}}\n";
enum { STEPS = 3, LINES = 7, BODIES = 2, MAST = 0, BUOY = 1 };

#define NUMBER(step, body)   ((step)*BODIES + (body))
#define OF(step, body, n, i) ((n)*NUMBER(step, body) + (i))

/* A finding NULL: only beside the scene. With its knots held the mast has 2 EA/l - W = 419 Nm. */
static const FalseNumber FALSE[] = {
    {"stable_of_body", NUMBER(1, MAST), 1, "body mast: it is said to be stable"},
    {"stiffness_rr_of_body", OF(1, MAST, 9, 4), 419, "body mast: it is said to be not stable"},
    {"stiffness_rr_of_body", OF(1, MAST, 9, 4), -281.01, NULL},
    {"stiffness_xx_of_body", OF(0, MAST, 9, 0), 1400, NULL},
    {"stiffness_xx_of_body", OF(0, BUOY, 9, 0), 1e4, NULL},
    {"stiffness_xx_of_body", OF(1, BUOY, 9, 0), 1e4, NULL},
    {"stiffness_xx_of_body", OF(2, BUOY, 9, 0), 1e4, NULL},
    {"stiffness_rr_of_body", OF(2, BUOY, 9, 8), 1e4, NULL},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = LINES * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE)};
    return falsified_main(&FALSIFIED);
}
