/* SPDX-License-Identifier: BSD-3-Clause */
/* Writer of the sample files: the layout of docs/results.md, reduced to what the checker reads. */
#include "sample.h"

#include "record.h"

#include <math.h>
#include <netcdf.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { NODES = 5, ELEMENTS = 4, MAX_FIELDS = 80 };

/* all lines have four elements of 1 m, weigh 8 N/m and lie along x on a bed with mu = 1/2 */
typedef struct SampleLine {
    const char *name;
    int outcome, end_kind[2];
    double compliance;
    double move[NODES], load[NODES], friction[NODES], segment[ELEMENTS],
        tension[ELEMENTS]; /* components along x */
    double end_b, proof, proof_value;
    double claim[CLAIMS];
} SampleLine;

static const double ONES[ELEMENTS] = {1, 1, 1, 1};
static const double C = 1.0 / 1024, TOLERANCE = 1e-8;

/* The least part of the scale that a line's loads and its largest force have, by its length. */
static double least_scale(double force, double length) {
    return 1e-12 / TOLERANCE * force * length;
}

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

/* variables of one line: name, rank 1 or 2 within the step, values */
typedef struct Field {
    const char *name;
    size_t rows, columns;
    double value[3 * NODES];
} Field;

static Field vectors(const char *name, size_t rows, const double *along_x, double z) {
    Field field = {name, rows, 3, {0}};
    for (size_t j = 0; j < rows; j++) {
        field.value[3 * j] = along_x ? along_x[j] : 0;
        field.value[3 * j + 2] = z;
    }
    return field;
}

static Field constant(const char *name, size_t rows, double value, double at_ends) {
    Field field = {name, rows, 0, {0}};
    for (size_t j = 0; j < rows; j++) field.value[j] = j == 0 || j + 1 == rows ? at_ends : value;
    return field;
}

static Field scalar(const char *name, double value) { return (Field){name, 0, 0, {value}}; }

/* What is imposed on the ends: 0 a position, 1 a force; the other of the two is missing. */
static const int HELD_FREE[2] = {0, 1};
static size_t imposed(Field *field, const int kind[2], const double value[6]) {
    field[0] = (Field){"end_kind", 2, 0, {kind[0], kind[1]}};
    field[1] = (Field){"end_held_position", 2, 3, {0}};
    field[2] = (Field){"end_applied_force", 2, 3, {0}};
    for (int k = 0; k < 6; k++) {
        field[1 + kind[k / 3]].value[k] = value[k];
        field[2 - kind[k / 3]].value[k] = NAN;
    }
    return 3;
}

/* the second step repeats the first from where that ended: nothing moves, friction stays and does
 * no work */
static size_t describe(const SampleLine *line, int again, Field *field) {
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
    // the bed carries the half element at A, next to which nothing rubs
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

/* A line of four elements from its fields in two steps, first[] and second[]. */
static int write_line(int nc, const int dims[3], const char *line, const double *lengths,
                      double compliance, const Field *first, const Field *second, size_t count) {
    char name[128];
    int node, element, id[MAX_FIELDS], length, soft, status = nc_redef(nc);
    (void)status; // a file just created is in define mode already
    snprintf(name, sizeof name, "%s_node", line);
    status = nc_def_dim(nc, name, NODES, &node);
    snprintf(name, sizeof name, "%s_element", line);
    if (!status) status = nc_def_dim(nc, name, ELEMENTS, &element);
    snprintf(name, sizeof name, "%s_element_length", line);
    if (!status) status = nc_def_var(nc, name, NC_DOUBLE, 1, &element, &length);
    snprintf(name, sizeof name, "%s_compliance", line);
    if (!status) status = nc_def_var(nc, name, NC_DOUBLE, 0, NULL, &soft);
    for (size_t k = 0; k < count && !status; k++) {
        size_t rows = first[k].rows;
        int row = rows == NODES ? node : rows == ELEMENTS ? element : rows == 2 ? dims[2] : dims[1];
        int dimension[3] = {dims[0], row, dims[1]}, rank = 1 + (rows > 0) + (first[k].columns > 0);
        snprintf(name, sizeof name, "%s_%s", line, first[k].name);
        status = nc_def_var(nc, name, NC_DOUBLE, rank, dimension, &id[k]);
    }
    if (!status) status = nc_enddef(nc);
    if (!status) status = nc_put_var_double(nc, length, lengths);
    if (!status) status = nc_put_var_double(nc, soft, &compliance);
    for (int again = 0; again < 2 && !status; again++) {
        const Field *field = again ? second : first;
        for (size_t k = 0; k < count && !status; k++) {
            size_t start[3] = {(size_t)again}, extent[3] = {1, field[k].rows, field[k].columns};
            status = nc_put_vara_double(nc, id[k], start, extent, field[k].value);
        }
    }
    return status;
}

/* An obstacle: kind, point, axis, radius, axial and lateral coefficients, and by how much it turns
 * in each step. */
typedef struct Bed {
    double kind, point[3], axis[3], radius, axial, lateral, turn;
    double shape, half[2]; /* shape 2: an ellipse of these half-axes, given as a set */
} Bed;

/* {P v : (1, v) in the cone}, P = diag(half), with a row and an unknown more than it needs. */
static int write_set(int nc, int obstacle, const double half[2]) {
    const double none[2] = {0, 0}, map[6] = {half[0], 0, 0, 0, half[1], 0}, cone[4] = {3, 0, 0, 0};
    const double rows[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0}, offset[4] = {1, 0, 0, 0};
    const struct {
        const char *name;
        const double *value;
    } field[] = {{"obstacle_friction_set_origin", none},
                 {"obstacle_friction_set_map", map},
                 {"obstacle_friction_set_cone", cone},
                 {"obstacle_friction_set_rows", rows},
                 {"obstacle_friction_set_offset", offset}};
    int tangent, unknown, row, id[5], status = nc_redef(nc);
    if (!status) status = nc_def_dim(nc, "tangent", 2, &tangent);
    if (!status) status = nc_def_dim(nc, "set_unknown", 3, &unknown);
    if (!status) status = nc_def_dim(nc, "set_row", 4, &row);
    for (int k = 0; k < 5 && !status; k++) {
        const int shape[3] = {obstacle, k < 2 ? tangent : row, unknown};
        status = nc_def_var(nc, field[k].name, NC_DOUBLE, k == 1 || k == 3 ? 3 : 2, shape, &id[k]);
    }
    if (!status) status = nc_enddef(nc);
    for (int k = 0; k < 5 && !status; k++) status = nc_put_var_double(nc, id[k], field[k].value);
    return status;
}

/* Friction zones of a line: the part up to `middle` and the rest. */
static int write_zones(int nc, const char *line, double middle, double length,
                       const double factor[2]) {
    const double from[2] = {0, middle}, to[2] = {middle, length}, *value[3] = {from, to, factor};
    static const char *const NAME[] = {"from", "to", "factor"};
    char name[64];
    int zone, id[3], status = nc_redef(nc);
    snprintf(name, sizeof name, "%s_zone", line);
    if (!status) status = nc_def_dim(nc, name, 2, &zone);
    for (int k = 0; k < 3 && !status; k++) {
        snprintf(name, sizeof name, "%s_zone_%s", line, NAME[k]);
        status = nc_def_var(nc, name, NC_DOUBLE, 1, &zone, &id[k]);
    }
    if (!status) status = nc_enddef(nc);
    for (int k = 0; k < 3 && !status; k++) status = nc_put_var_double(nc, id[k], value[k]);
    return status;
}

static const char *const BED_NAME[] = {"kind",           "point",          "axis",
                                       "radius",         "friction_axial", "friction_lateral",
                                       "friction_shape", "friction_grain"};
enum { BED_NUMBERS = sizeof BED_NAME / sizeof *BED_NAME };

static int write_bed(int nc, const int id[BED_NUMBERS], int turn, size_t k, const Bed *bed) {
    const double none[3] = {0, 0, 0};
    const double *value[BED_NUMBERS] = {&bed->kind,  bed->point,    bed->axis,   &bed->radius,
                                        &bed->axial, &bed->lateral, &bed->shape, none};
    const size_t start[2] = {k, 0}, count[2] = {1, 3};
    int status = NC_NOERR;
    for (int i = 0; i < BED_NUMBERS && !status; i++)
        status = nc_put_vara_double(nc, id[i], start, count, value[i]);
    for (size_t step = 0; step < 2 && !status; step++)
        status = nc_put_var1_double(nc, turn, (size_t[]){step, k}, &bed->turn);
    return status;
}

/* A set is written of one bed alone. */
static int write_beds(int nc, const int dims[3], const Bed *bed, size_t count) {
    int obstacle, turn, id[BED_NUMBERS], status = nc_def_dim(nc, "obstacle", count, &obstacle);
    char name[64];
    const int shape[2] = {obstacle, dims[1]}, turned[2] = {dims[0], obstacle};
    for (int k = 0; k < BED_NUMBERS && !status; k++) {
        const bool vector = k == 1 || k == 2 || k == BED_NUMBERS - 1;
        snprintf(name, sizeof name, "obstacle_%s", BED_NAME[k]);
        status = nc_def_var(nc, name, NC_DOUBLE, 1 + vector, shape, &id[k]);
    }
    if (!status) status = nc_def_var(nc, "obstacle_turn", NC_DOUBLE, 2, turned, &turn);
    if (!status) status = nc_enddef(nc);
    for (size_t k = 0; k < count && !status; k++) status = write_bed(nc, id, turn, k, &bed[k]);
    return status || bed->shape != 2 ? status : write_set(nc, obstacle, bed->half);
}

/* dims: step, xyz, end */
static int begin_file(const char *path, const char *names, const char *policy, int *nc,
                      int dims[3]) {
    const double gravity[3] = {0, 0, -8};
    int status = nc_create(path, NC_CLOBBER | NC_64BIT_OFFSET, nc);
    if (status) return status;
    status = nc_def_dim(*nc, "step", NC_UNLIMITED, &dims[0]);
    if (!status) status = nc_def_dim(*nc, "xyz", 3, &dims[1]);
    if (!status) status = nc_def_dim(*nc, "end", 2, &dims[2]);
    if (!status) status = nc_put_att_text(*nc, NC_GLOBAL, "lines", strlen(names), names);
    if (!status)
        status = nc_put_att_text(*nc, NC_GLOBAL, "friction_policy", strlen(policy), policy);
    if (!status) status = nc_put_att_double(*nc, NC_GLOBAL, "tolerance", NC_DOUBLE, 1, &TOLERANCE);
    if (!status) status = nc_put_att_double(*nc, NC_GLOBAL, "gravity", NC_DOUBLE, 3, gravity);
    return status;
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
        size_t count = describe(&line[i], 0, field[0]);
        describe(&line[i], 1, field[1]);
        status =
            write_line(nc, dims, line[i].name, ONES, line[i].compliance, field[0], field[1], count);
    }
    int closed = nc_close(nc);
    return status ? status : closed;
}

/* ---- the drum ---- */

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

static Field *of_nodes(Field *field, const char *name, const double *value) {
    *field = (Field){name, NODES, 3, {0}};
    if (value) memcpy(field->value, value, sizeof field->value);
    return field;
}

/* contacts of elements, none of which touches anything */
static size_t no_elements(Field *field) {
    static const char *const NAME[] = {"element_normal", "element_friction_force", "element_slip"};
    static const struct {
        const char *name;
        double value;
    } OTHER[5] = {{"element_contact_gap", INFINITY},
                  {"element_friction_bound", 0},
                  {"element_reaction", 0},
                  {"element_obstacle", -1},
                  {"element_share", 0}};
    for (int k = 0; k < 3; k++) field[k] = (Field){NAME[k], ELEMENTS, 3, {0}};
    for (int k = 0; k < 5; k++) {
        field[3 + k] = (Field){OTHER[k].name, ELEMENTS, 0, {0}};
        for (int i = 0; i < ELEMENTS; i++) field[3 + k].value[i] = OTHER[k].value;
    }
    return 8;
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
    double held = T[0] * s, rub[3], sense[3], ends = MU * held * SLIP;
    spoke(1.57079632679489661923, sense);
    for (int k = 0; k < 3; k++) rub[k] = -MU * held * sense[k];
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
        field[n].value[k] = -T[0] * w->chord[k] - held * w->normal[k] - rub[k];
        field[n].value[3 + k] = load->value[3 * ELEMENTS + k];
    }
    const double *at_a = field[n].value;
    field[n + 1] = (Field){"end_tension", 2, 0, {hypot(hypot(at_a[0], at_a[1]), at_a[2]), largest}};
    n += 2;
    for (int k = 0; k < RANGES; k++) field[n++] = (Field){RANGE_NAME[k], 2, 0, {NAN, NAN}};
    field[n++] = (Field){"end_friction_force", 2, 3, {rub[0], rub[1], rub[2]}};
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

/* ---- the corner ---- */

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
    size_t n = describe(&line, again, field);
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

/* ---- the post ---- */

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

/* Two equal steps of one line with consistent friction on one obstacle. */
static int write_alone(const char *path, const char *name, const Bed *bed, const double *length,
                       double compliance, const Field *field, size_t count) {
    int nc, dims[3], status = begin_file(path, name, "consistent", &nc, dims);
    if (status) return status;
    status = write_beds(nc, dims, bed, 1);
    if (!status) status = write_line(nc, dims, name, length, compliance, field, field, count);
    int closed = nc_close(nc);
    return status ? status : closed;
}

int sample_write_post(const char *path) {
    static const double TWOS[ELEMENTS] = {2, 2, 2, 2};
    static const Bed POST = {.kind = 1, .axis = {0, 0, 2}, .radius = 1, .axial = MU, .lateral = MU};
    Field field[MAX_FIELDS];
    const size_t count = describe_post(field);
    return write_alone(path, "line", &POST, TWOS, 0, field, count);
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

/* ---- a line that slides without end ---- */

static const Bed DRUM = {.kind = 1, .axis = {0, 1, 0}, .radius = 1, .axial = 0.5, .lateral = 0.5};

/* Straight up to a drum of radius 1, two chords of a quarter turn over it, straight down. At half
 * an eighth of a turn the pull falls by k = (1 - mu)/(1 + mu) = 1/3 from the first node on the drum
 * to the top, and again to the last: 1 N at A holds 9 N at B, which is 10 N here. */
static size_t describe_spill(Field *field) {
    static const double PLACE[3 * NODES] = {-1, 0, -1, -1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, -1};
    static const double MOTION[3 * NODES] = {0,      0,       1, -0.5,    0, 1, 1 / 3., 0,
                                             1 / 6., 1 / 18., 0, -1 / 9., 0, 0, -1 / 9.};
    const SampleLine line = {.name = "spill", .outcome = 7, .end_kind = {1, 1}};
    const double fastest = sqrt(1.25);
    size_t n = describe(&line, 1, field);
    field[n++] = vectors("motion", NODES, NULL, 0);
    n += no_elements(&field[n]);
    for (size_t k = 0; k < n; k++) {
        Field *f = &field[k];
        if (strcmp(f->name, "reference") == 0 || strcmp(f->name, "position") == 0)
            memcpy(f->value, PLACE, sizeof PLACE);
        for (int i = 0; i < 3 * NODES && strcmp(f->name, "motion") == 0; i++)
            f->value[i] = MOTION[i] / fastest;
        for (int j = 0; j < NODES && strcmp(f->name, "load") == 0; j++)
            f->value[3 * j + 2] = j == 0 ? -1 : j + 1 == NODES ? -10 : 0;
        if (strcmp(f->name, "end_applied_force") == 0) {
            f->value[2] = -1;
            f->value[3] = 0;
            f->value[5] = -10;
        }
        if (strcmp(f->name, "proof_force") == 0) f->value[0] = (10 / 9. - 1) / fastest;
    }
    return n;
}

int sample_write_spill(const char *path) {
    const double length[ELEMENTS] = {1, sqrt(2), sqrt(2), 1};
    Field field[MAX_FIELDS];
    const size_t count = describe_spill(field);
    int nc, dims[3], status = begin_file(path, "spill", "consistent", &nc, dims);
    if (status) return status;
    // its chords are deeper than elements may lie: contact of the reference keeps out nodes alone
    (void)nc_redef(nc);
    status = nc_put_att_text(nc, NC_GLOBAL, "contact_policy", 9, "reference");
    if (!status) status = write_beds(nc, dims, &DRUM, 1);
    if (!status) status = write_line(nc, dims, "spill", length, C, field, field, count);
    int closed = nc_close(nc);
    return status ? status : closed;
}

/* ---- the fall ---- */

/* Straight and level below a drum of radius 1, half of that away from it, under 1 N down at each
 * node. */
static size_t describe_fall(Field *field) {
    static const double ALONG[NODES] = {-2, -1, 0, 1, 2};
    const SampleLine line = {.name = "fall", .outcome = 4, .end_kind = {1, 1}};
    size_t n = describe(&line, 1, field);
    n += no_elements(&field[n]);
    for (size_t k = 0; k < n; k++) {
        Field *f = &field[k];
        const bool places = strcmp(f->name, "reference") == 0 || strcmp(f->name, "position") == 0;
        if (places)
            for (int j = 0; j < NODES; j++) {
                f->value[3 * j] = ALONG[j];
                f->value[3 * j + 2] = -1.5;
            }
        for (int j = 0; j < NODES && strcmp(f->name, "load") == 0; j++) {
            f->value[3 * j] = f->value[3 * j + 1] = 0;
            f->value[3 * j + 2] = -1;
        }
        for (int j = 0; j < NODES && strcmp(f->name, "contact_gap") == 0; j++)
            f->value[j] = INFINITY;
        if (strcmp(f->name, "proof") == 0) {
            f->value[0] = f->value[1] = 0;
            f->value[2] = -1;
        }
        if (strcmp(f->name, "proof_force") == 0) f->value[0] = 5;
    }
    return n;
}

int sample_write_fall(const char *path) {
    Field field[MAX_FIELDS];
    const size_t count = describe_fall(field);
    return write_alone(path, "fall", &DRUM, ONES, C, field, count);
}

/* ---- the reel ---- */

/* Inextensible, half round a drum of radius 1 by its tangents; end B is drawn 1.5 m down from the
 * drum's height and the line, 4 m long, does not reach there: its chords of 1 m are 3/pi of their
 * arcs, so the way is a tangent to the radius q = 3/pi, less that from 1, and the rest at q. */
static size_t describe_reel(Field *field) {
    static const double PLACE[3 * NODES] = {-1, 0, 0, -1, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 0};
    const SampleLine line = {.name = "reel", .outcome = 5};
    const double pi = acos(-1), q = 3 / pi, far = hypot(1, 1.5), edge = sqrt(1 - q * q),
                 lead = sqrt(far * far - q * q);
    const double way = lead - edge + q * (pi + atan(1.5) - atan2(lead, q) + atan2(edge, q));
    size_t n = describe(&line, 1, field);
    n += no_elements(&field[n]);
    field[n++] = scalar("proof_obstacle", 0);
    for (size_t k = 0; k < n; k++) {
        Field *f = &field[k];
        const bool places = strcmp(f->name, "reference") == 0 || strcmp(f->name, "position") == 0;
        if (places) memcpy(f->value, PLACE, sizeof PLACE);
        if (strcmp(f->name, "end_held_position") == 0) {
            f->value[0] = -1;
            f->value[3] = 1;
            f->value[5] = -1.5;
        }
        if (strcmp(f->name, "proof") == 0) {
            f->value[0] = 0;
            f->value[2] = 1;
        }
        if (strcmp(f->name, "proof_length") == 0) f->value[0] = way - 4;
    }
    return n;
}

int sample_write_reel(const char *path) {
    Field field[MAX_FIELDS];
    const size_t count = describe_reel(field);
    return write_alone(path, "reel", &DRUM, ONES, 0, field, count);
}

int sample_poke(const char *path, const char *variable, size_t index, double value) {
    int nc, id, rank = 0, dimension[3], status = nc_open(path, NC_WRITE, &nc);
    if (status) return status;
    size_t at[3] = {0}, length[3] = {1, 1, 1};
    status = nc_inq_varid(nc, variable, &id);
    if (!status) status = nc_inq_varndims(nc, id, &rank);
    if (!status) status = nc_inq_vardimid(nc, id, dimension);
    for (int k = 0; k < rank && !status; k++) status = nc_inq_dimlen(nc, dimension[k], &length[k]);
    if (!status)
        for (int k = rank - 1; k >= 0; k--) {
            at[k] = index % length[k];
            index /= length[k];
        }
    if (!status) status = nc_put_var1_double(nc, id, at, &value);
    int closed = nc_close(nc);
    return status ? status : closed;
}
