/* SPDX-License-Identifier: BSD-3-Clause */
/* A line wound on a drum that turns back under it, slipping everywhere. */
#include <math.h>
#include <netcdf.h>
#include <string.h>

#include "record.h"
#include "sample.h"
#include "sample_file.h"

/* Nodes every DELTA along a drum of radius 1 that lies along y; the line is at rest and the drum
 * turns back under it by SLIP. It slips everywhere, so T grows from element to element by (cos + mu
 * sin)/(cos - mu sin) of DELTA/2, the exact law of equal angles. */
static const double DELTA = 0.25, SLIP = 0.125, MU = 0.5;
static const double CENTER[3] = {0.5, 0.75, 0.25};

typedef struct Wound {
    double tension[ELEMENTS], length[ELEMENTS], place[3 * NODES], normal[3 * NODES],
        chord[3 * ELEMENTS], slip[3 * NODES];
} Wound;

/* direction at an angle from z towards x, the sense of a turn about y */
static void spoke(double angle, double *out) {
    out[0] = sin(angle);
    out[1] = 0;
    out[2] = cos(angle);
}

static Wound wind(void) {
    Wound w = {.tension = {8}};
    const double c = cos(DELTA / 2), s = sin(DELTA / 2);
    for (int i = 0; i < ELEMENTS; i++) {
        if (i > 0) w.tension[i] = w.tension[i - 1] * (c + MU * s) / (c - MU * s);
        w.length[i] = 2 * s / (1 + C * w.tension[i]);
        spoke((i + 0.5) * DELTA + 1.57079632679489661923, &w.chord[3 * i]);
    }
    for (int j = 0; j < NODES; j++) {
        spoke(j * DELTA, &w.normal[3 * j]);
        spoke(j * DELTA + 1.57079632679489661923, &w.slip[3 * j]);
        for (int k = 0; k < 3; k++) {
            w.slip[3 * j + k] *= SLIP;
            w.place[3 * j + k] = CENTER[k] * (k != 1) + w.normal[3 * j + k];
        }
    }
    return w;
}

/* energies by hand: elongation, friction over SLIP, and the pull at B */
static size_t describe_wound(const Wound *w, Field *field) {
    size_t n = 0;
    const double c = cos(DELTA / 2), s = sin(DELTA / 2), *T = w->tension;
    n += no_elements(field);
    of_nodes(&field[n++], "reference", w->place);
    of_nodes(&field[n++], "position", w->place);
    of_nodes(&field[n++], "normal", w->normal);
    of_nodes(&field[n++], "slip", w->slip);
    Field *load = of_nodes(&field[n++], "load", NULL),
          *friction = of_nodes(&field[n++], "friction_force", NULL);
    field[n] = (Field){"segment_force", ELEMENTS, 3, {0}};
    Field *segment = &field[n++];
    field[n++] = constant("contact_gap", NODES, 0, 0);
    field[n] = constant("friction_bound", NODES, 0, 0);
    Field *bound = &field[n++];
    field[n] = constant("reaction", NODES, 0, 0);
    Field *reaction = &field[n++];
    field[n] = constant("tension", ELEMENTS, 0, 0);
    memcpy(field[n++].value, T, sizeof w->tension);
    double primal = 0, scale = 0, work = 0, length = 0, largest = T[ELEMENTS - 1];
    for (int i = 0; i < ELEMENTS; i++) {
        for (int k = 0; k < 3; k++) segment->value[3 * i + k] = T[i] * w->chord[3 * i + k];
        primal += w->length[i] * C * T[i] * T[i] / 2;
        scale += w->length[i] * (T[i] + C * T[i] * T[i]);
        length += w->length[i];
    }
    for (int j = 1; j < ELEMENTS; j++) {
        reaction->value[j] = (T[j] + T[j - 1]) * s;
        bound->value[j] = MU * reaction->value[j];
        for (int k = 0; k < 3; k++)
            friction->value[3 * j + k] = -(T[j] - T[j - 1]) * c / SLIP * w->slip[3 * j + k];
        work += SLIP * bound->value[j];
    }
    for (int k = 0; k < 3; k++) {
        load->value[3 * ELEMENTS + k] = largest * w->chord[3 * (ELEMENTS - 1) + k];
        primal -= load->value[3 * ELEMENTS + k] * w->place[3 * ELEMENTS + k];
    }
    /* at A the drum carries what presses there, and the half element takes as large a part of its
     * bound as node 1: all */
    double held = T[0] * s, end_friction[3], sense[3], ends = MU * held * SLIP;
    spoke(1.57079632679489661923, sense);
    for (int k = 0; k < 3; k++) end_friction[k] = -MU * held * sense[k];
    reaction->value[0] = held;
    primal += work;
    scale += work + least_scale(largest, length); // nothing moves but the drum
    field[n++] = scalar("outcome", 0);
    field[n++] = scalar("iterations", 1);
    field[n++] = scalar("substeps", 1);
    field[n++] = scalar("share", 1);
    const double *place = w->place, *pull = &load->value[3 * ELEMENTS];
    n += imposed(&field[n], HELD_FREE,
                 (double[]){place[0], place[1], place[2], pull[0], pull[1], pull[2]});
    field[n] = (Field){"end_force", 2, 3, {0}};
    for (int k = 0; k < 3; k++) {
        field[n].value[k] = -T[0] * w->chord[k] - held * w->normal[k] - end_friction[k];
        field[n].value[3 + k] = load->value[3 * ELEMENTS + k];
    }
    const double *at_a = field[n].value;
    field[n + 1] = (Field){"end_tension", 2, 0, {hypot(hypot(at_a[0], at_a[1]), at_a[2]), largest}};
    n += 2;
    for (int k = 0; k < RANGES; k++) field[n++] = (Field){RANGE_NAME[k], 2, 0, {NAN, NAN}};
    field[n++] =
        (Field){"end_friction_force", 2, 3, {end_friction[0], end_friction[1], end_friction[2]}};
    field[n++] = scalar("dissipated", work + ends);
    field[n++] = (Field){"proof", 3, 0, {0}};
    field[n++] = scalar("proof_length", 0);
    field[n++] = scalar("proof_force", 0);
    field[n++] = scalar("ledger_obstacles", work + ends); // which is all dissipated
    field[n++] = scalar("bend_turn", DELTA);
    field[n++] = scalar("bend_friction", MU); // the same at all inner nodes
    field[n++] = scalar("bend_at", w->length[0] + w->length[1]);
    static const char *const NONE[] = {"ledger_ends",         "ledger_elastic",
                                       "ledger_gravity",      "ledger_imbalance",
                                       "unaccounted",         "gap",
                                       "tension_bound",       "tension_estimate",
                                       "force_residual",      "law_residual",
                                       "contact_residual",    "friction_residual",
                                       "stretch_residual",    "penetration",
                                       "element_penetration", "element_push",
                                       "elongation_residual"};
    for (size_t k = 0; k < sizeof NONE / sizeof *NONE; k++) field[n++] = scalar(NONE[k], 0);
    field[n++] = scalar("primal", primal);
    field[n++] = scalar("dual", primal);
    field[n++] = scalar("scale", scale);
    field[n++] = scalar("largest_force", largest);
    return n;
}

/* `factor` of all friction, in two zones; 0: no zones and no set. */
static int write_drum(const char *path, double factor) {
    Bed drum = {
        .kind = 1, .axis = {0, 3, 0}, .radius = 1, .axial = MU, .lateral = MU / 2, .turn = -SLIP};
    memcpy(drum.point, CENTER, sizeof drum.point);
    if (factor > 0) {
        drum.shape = 2;
        drum.half[0] = MU / factor;
        drum.half[1] = MU / 2 / factor;
    }
    const Wound w = wind();
    Field field[MAX_FIELDS];
    size_t count = describe_wound(&w, field);
    if (factor > 0)
        for (size_t k = 0; k < count; k++)
            for (int j = 0; j < NODES && strcmp(field[k].name, "friction_bound") == 0; j++)
                field[k].value[j] *= factor / MU;
    int nc, dims[3], status = begin_file(path, "wound", "consistent", &nc, dims);
    if (status) return status;
    status = write_beds(nc, dims, &drum, 1);
    if (!status) status = write_line(nc, dims, "wound", w.length, C, field, field, count);
    const double length = w.length[0] + w.length[1] + w.length[2] + w.length[3],
                 both[2] = {factor, factor};
    if (!status && factor > 0) status = write_zones(nc, "wound", 0.375, length, both);
    int closed = nc_close(nc);
    return status ? status : closed;
}

int sample_write_drum(const char *path) { return write_drum(path, 0); }
int sample_write_set(const char *path) { return write_drum(path, 1.25); }
