/* SPDX-License-Identifier: BSD-3-Clause */
/* A line over a post, which it touches with an element. */
#include <math.h>
#include <string.h>

#include "record.h"
#include "sample.h"
#include "sample_file.h"

static const double MU = 0.5;

/* An inextensible line over a post of radius 1 about z, which element 1 touches at 0.6 of its way:
 * it lies a quarter of the radius deep. Before and after it the line goes up and down by 3 in 5;
 * tensions 4 N and 6 N there and R = 0.6 (4 + 6) N on the element, shared as 0.4 to 0.6. Friction
 * holds the difference along the element, 1.6 N. */
static size_t describe_post(Field *field) {
    static const double PLACE[3 * NODES] = {-2.8, -0.45, 0,     -1.2, 0.75, 0,     0.8, 0.75,
                                            0,    2.4,   -0.45, 0,    4,    -1.65, 0};
    static const double FORCE[3 * ELEMENTS] = {3.2, 2.4, 0, 3.84, 0, 0, 4.8, -3.6, 0, 4.8, -3.6, 0};
    static const double TENSION[ELEMENTS] = {4, 3.84, 6, 6}, PULL[3] = {4.8, -3.6, 0}, R = 6,
                        F = -1.6;
    const double primal = -(4.8 * 4 + 3.6 * 1.65);
    size_t n = no_elements(field);
    field[0].value[4] = 1;
    field[1].value[3] = F;
    field[3].value[1] = 0;
    field[4].value[1] = MU * R;
    field[5].value[1] = R;
    field[6].value[1] = 0;
    field[7].value[1] = 0.6;
    of_nodes(&field[n++], "reference", PLACE);
    of_nodes(&field[n++], "position", PLACE);
    Field *normal = of_nodes(&field[n++], "normal", NULL);
    of_nodes(&field[n++], "slip", NULL);
    of_nodes(&field[n++], "friction_force", NULL);
    memcpy(&of_nodes(&field[n++], "load", NULL)->value[3 * ELEMENTS], PULL, sizeof PULL);
    field[n] = constant("contact_gap", NODES, 0, 0);
    Field *gap = &field[n++];
    for (int j = 0; j < NODES; j++) {
        const double from = hypot(PLACE[3 * j], PLACE[3 * j + 1]);
        gap->value[j] = j > 0 ? from - 1 : INFINITY;
        for (int k = 0; k < 2; k++) normal->value[3 * j + k] = PLACE[3 * j + k] / from;
    }
    field[n] = (Field){"segment_force", ELEMENTS, 3, {0}};
    memcpy(field[n++].value, FORCE, sizeof FORCE);
    field[n++] = constant("friction_bound", NODES, 0, 0);
    field[n++] = constant("reaction", NODES, 0, 0);
    field[n] = constant("tension", ELEMENTS, 0, 0);
    memcpy(field[n++].value, TENSION, sizeof TENSION);
    field[n++] = scalar("outcome", 0);
    field[n++] = scalar("iterations", 1);
    field[n++] = scalar("substeps", 1);
    field[n++] = scalar("share", 1);
    n += imposed(&field[n], HELD_FREE, (double[]){PLACE[0], PLACE[1], 0, PULL[0], PULL[1], 0});
    field[n++] = (Field){"end_force", 2, 3, {-FORCE[0], -FORCE[1], 0, PULL[0], PULL[1], 0}};
    field[n++] = (Field){"end_friction_force", 2, 3, {0}};
    field[n++] = (Field){"end_tension", 2, 0, {4, 6}};
    for (int k = 0; k < RANGES; k++) field[n++] = (Field){RANGE_NAME[k], 2, 0, {NAN, NAN}};
    field[n++] = (Field){"proof", 3, 0, {0}};
    static const char *const NONE[] = {
        "dissipated",         "proof_length",        "proof_force",      "ledger_ends",
        "ledger_elastic",     "ledger_gravity",      "ledger_imbalance", "gap",
        "tension_bound",      "force_residual",      "law_residual",     "contact_residual",
        "ledger_obstacles",   "penetration",         "stretch_residual", "friction_residual",
        "tension_estimate",   "element_penetration", "unaccounted",      "element_push",
        "elongation_residual"};
    field[n++] = scalar("bend_turn", 2 * asin(0.6));
    field[n++] = scalar("bend_friction", MU);
    field[n++] = scalar("bend_at", 2 + 0.6 * 2);
    for (size_t k = 0; k < sizeof NONE / sizeof *NONE; k++) field[n++] = scalar(NONE[k], 0);
    field[n++] = scalar("primal", primal);
    field[n++] = scalar("dual", primal);
    field[n++] = scalar("scale", 2 * (4 + 3.84 + 6 + 6) + least_scale(6, 8));
    field[n++] = scalar("largest_force", 6);
    return n;
}

int sample_write_post(const char *path) {
    static const double TWOS[ELEMENTS] = {2, 2, 2, 2};
    static const Bed POST = {.kind = 1, .axis = {0, 0, 2}, .radius = 1, .axial = MU, .lateral = MU};
    Field field[MAX_FIELDS];
    const size_t count = describe_post(field);
    return write_alone(path, "line", &POST, TWOS, 0, field, count);
}
