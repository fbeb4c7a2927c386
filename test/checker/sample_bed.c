/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines on a bed: one dragged, one taut, one that does not reach, one pulled away. */
#include "sample_bed.h"

#include <math.h>
#include <netcdf.h>
#include <string.h>

#include "sample.h"

/* Drag by H = 10 N: bounds 4 N inside and 2 N at the tip take the tension from 8 N to 4 N to 0 over
 * two elements, which stretch by c T = 4 C and 8 C. Energies by hand; the second member is the
 * largest load, sqrt(10^2 + 4^2). */
static void drag_claims(double *claim) {
    double tip = hypot(10, 4), primal = 40 * C + 40 * C - 10 * (4 + 12 * C);
    double scale = 12 + 80 * C + 40 * C + 120 * C +
                   least_scale(28 + tip, 4); // the pull of 10 N works over 12 C
    const double values[CLAIMS] = {primal, primal, 0, scale, 0, 0, 0, tip};
    memcpy(claim, values, sizeof values);
}

static void fill(SampleLine line[4]) {
    line[0] = (SampleLine){.name = "drag",
                           .end_kind = {0, 1},
                           .compliance = C,
                           .move = {0, 0, 0, 4 * C, 12 * C},
                           .load = {0, 0, 0, 0, 10},
                           .friction = {0, 0, -4, -4, -2},
                           .segment = {0, 0, 4, 8},
                           .tension = {0, 0, 4, 8},
                           .end_b = 10};
    drag_claims(line[0].claim);
    line[1] = (SampleLine){.name = "tight", .outcome = 1, .end_b = 4};
    line[2] =
        (SampleLine){.name = "far", .outcome = 5, .end_b = 4.5, .proof = 1, .proof_value = 0.5};
    line[3] = (SampleLine){.name = "loose",
                           .outcome = 4,
                           .end_kind = {1, 1},
                           .load = {0, 0, 0, 0, 17},
                           .proof = 1,
                           .proof_value = 1,
                           .end_b = 17};
}

size_t describe_on_bed(const SampleLine *line, int again, Field *field) {
    size_t n = 0;
    const double work = line->compliance > 0 ? 40 * C : 0;
    double reference[NODES], position[NODES], weight[NODES] = {-4, -8, -8, -8, -4};
    for (int j = 0; j < NODES; j++) {
        position[j] = j + line->move[j];
        reference[j] = again ? position[j] : j;
    }
    field[n++] = vectors("reference", NODES, reference, 0);
    field[n++] = vectors("position", NODES, position, 0);
    field[n] = vectors("load", NODES, line->load, 0);
    for (int j = 0; j < NODES; j++) field[n].value[3 * j + 2] = weight[j];
    n++;
    field[n++] = vectors("normal", NODES, NULL, 1);
    field[n++] = vectors("friction_force", NODES, line->friction, 0);
    field[n++] = vectors("slip", NODES, again ? NULL : line->move, 0);
    field[n++] = vectors("segment_force", ELEMENTS, line->segment, 0);
    field[n++] = constant("contact_gap", NODES, 0, 0);
    field[n++] = constant("friction_bound", NODES, 4, 2);
    field[n++] = constant("reaction", NODES, 8, 4);
    field[n] = constant("tension", ELEMENTS, 0, 0);
    memcpy(field[n++].value, line->tension, sizeof line->tension);
    field[n++] = scalar("outcome", line->outcome);
    field[n++] = scalar("iterations", 1);
    field[n++] = scalar("substeps", 1);
    field[n++] = scalar("share", 1);
    n += imposed(&field[n], line->end_kind, (double[]){0, 0, 0, line->end_b, 0, 0});
    // the bed carries the half element at A, next to which there is no friction
    field[n++] = (Field){"end_force", 2, 3, {0, 0, 0, line->end_b, 0, 0}};
    field[n++] = (Field){"end_friction_force", 2, 3, {0}};
    field[n++] = (Field){"end_tension", 2, 0, {0, line->end_b}};
    for (int k = 0; k < RANGES; k++) field[n++] = (Field){RANGE_NAME[k], 2, 0, {NAN, NAN}};
    field[n++] = scalar("dissipated", again ? 0 : work);
    // the pull of 10 N on its path of 12 C; half is too much for a step that begins without it
    const double pull = again || line->compliance == 0 ? 0 : 120 * C;
    field[n++] = scalar("ledger_ends", pull);
    field[n++] = scalar("ledger_obstacles", 0);
    field[n++] = scalar("ledger_elastic", pull / 3);
    field[n++] = scalar("ledger_gravity", 0);
    field[n++] = scalar("ledger_imbalance", pull / 3);
    field[n++] = scalar("unaccounted", 0);
    field[n++] = (Field){"proof", 3, 0, {line->proof, 0, 0}};
    field[n++] = scalar("proof_length", line->outcome == 5 ? line->proof_value : 0);
    field[n++] = scalar("proof_force", line->outcome == 4 ? line->proof_value : 0);
    field[n++] = scalar("bend_turn", 0);
    field[n++] = scalar("bend_friction", 0);
    field[n++] = scalar("bend_at", 0);
    for (int k = 0; k < CLAIMS; k++) {
        // primal and dual lose the work of friction, the scale that of the pull as well
        const double less = k == 0 || k == 1 ? work : k == 3 ? 4 * work : 0;
        field[n++] = scalar(CLAIM_NAME[k], line->claim[k] - (again ? less : 0));
    }
    return n;
}

int sample_write(const char *path) {
    static const Bed BED = {.axis = {0, 0, 2}, .axial = 0.5, .lateral = 0.5};
    SampleLine line[4];
    fill(line);
    int nc, dims[3], status = begin_file(path, "drag tight far loose", "frozen", &nc, dims);
    if (status) return status;
    status = write_beds(nc, dims, &BED, 1);
    for (int i = 0; i < 4 && !status; i++) {
        Field field[2][MAX_FIELDS];
        size_t count = describe_on_bed(&line[i], 0, field[0]);
        describe_on_bed(&line[i], 1, field[1]);
        status =
            write_line(nc, dims, line[i].name, ONES, line[i].compliance, field[0], field[1], count);
    }
    int closed = nc_close(nc);
    return status ? status : closed;
}
