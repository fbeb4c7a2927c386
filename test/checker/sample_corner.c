/* SPDX-License-Identifier: BSD-3-Clause */
/* A line in the corner of a bed and a wall. */
#include <math.h>
#include <netcdf.h>
#include <string.h>

#include "sample.h"
#include "sample_bed.h"

/* The line of "drag" under weight that presses it on the bed, mu = 1/2, as hard as on a wall, mu =
 * 1/4, both along x: bounds 4 N and 2 N of an inner node, half of them at the tip. Pulled by 15 N
 * the tension falls to 12 N, to 6 N, to 0.
 */
static size_t describe_corner(int again, Field *field) {
    const SampleLine line = {.name = "corner",
                             .end_kind = {0, 1},
                             .compliance = C,
                             .move = {0, 0, 0, 6 * C, 18 * C},
                             .load = {0, 0, 0, 0, 15},
                             .friction = {0, 0, -4, -4, -2},
                             .segment = {0, 0, 6, 12},
                             .tension = {0, 0, 6, 12},
                             .end_b = 15};
    size_t n = describe_on_bed(&line, again, field);
    /* by hand: elongation (6^2 + 12^2) C/2, friction 6 6 C + 3 18 C, and the pull on its way */
    const double work = again ? 0 : 90 * C, tip = sqrt(15 * 15 + 4 * 4 + 4 * 4),
                 primal = 90 * C - 15 * (4 + 18 * C);
    const struct {
        const char *name;
        double value;
    } other[] = {{"dissipated", work},
                 {"ledger_ends", 3 * work},
                 {"ledger_elastic", work},
                 {"ledger_imbalance", work},
                 {"primal", primal + work},
                 {"dual", primal + work},
                 {"scale",
                  18 + 180 * C + 4 * work +
                      least_scale(28 * sqrt(2) + tip, 4)}, // the pull works three times that
                 {"largest_force", tip}};
    static const double PRESS[NODES] = {-4, -8, -8, -8, -4}, SECOND[NODES] = {0, 0, -2, -2, -1};
    for (size_t k = 0; k < n; k++) {
        for (size_t i = 0; i < sizeof other / sizeof *other; i++)
            if (strcmp(field[k].name, other[i].name) == 0) field[k].value[0] = other[i].value;
        for (int j = 0; j < NODES && strcmp(field[k].name, "load") == 0; j++)
            field[k].value[3 * j + 1] = PRESS[j];
        // the bed alone carries a held end: what presses it on the wall is left to the support
        if (strcmp(field[k].name, "end_force") == 0) field[k].value[1] = -PRESS[0];
        if (strcmp(field[k].name, "end_tension") == 0) field[k].value[0] = -PRESS[0];
    }
    Field *normal = &field[n++];
    *normal = vectors("normal_second", NODES, NULL, 0);
    for (int j = 0; j < NODES; j++) normal->value[3 * j + 1] = 1;
    field[n++] = vectors("friction_force_second", NODES, SECOND, 0);
    field[n++] = vectors("slip_second", NODES, again ? NULL : line.move, 0);
    field[n++] = constant("contact_gap_second", NODES, 0, 0);
    field[n++] = constant("friction_bound_second", NODES, 2, 1);
    field[n] = constant("reaction_second", NODES, 8, 4);
    field[n++].value[0] = 0;
    field[n++] = constant("obstacle", NODES, 0, 0);
    field[n++] = constant("obstacle_second", NODES, 1, 1);
    return n + no_elements(&field[n]);
}

int sample_write_corner(const char *path) {
    static const Bed BEDS[3] = {
        {.axis = {0, 0, 2}, .axial = 0.5, .lateral = 0.5},
        {.axis = {0, 1, 0}, .axial = 0.25, .lateral = 0.25},
        {.point = {0, 0, 10}, .axis = {0, 0, -1}, .axial = 0.5, .lateral = 0.5}};
    Field field[2][MAX_FIELDS];
    const size_t count = describe_corner(0, field[0]);
    describe_corner(1, field[1]);
    int nc, dims[3], status = begin_file(path, "corner", "consistent", &nc, dims);
    if (status) return status;
    status = write_beds(nc, dims, BEDS, 3);
    if (!status) status = write_line(nc, dims, "corner", ONES, C, field[0], field[1], count);
    int closed = nc_close(nc);
    return status ? status : closed;
}
