/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps without a solution at a drum: a line that slides without end, one that falls, one that is
 * too short. */
#include <math.h>
#include <netcdf.h>
#include <string.h>

#include "sample.h"
#include "sample_bed.h"

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
    size_t n = describe_on_bed(&line, 1, field);
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
    size_t n = describe_on_bed(&line, 1, field);
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
    const double path_length = lead - edge + q * (pi + atan(1.5) - atan2(lead, q) + atan2(edge, q));
    size_t n = describe_on_bed(&line, 1, field);
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
        if (strcmp(f->name, "proof_length") == 0) f->value[0] = path_length - 4;
    }
    return n;
}

int sample_write_reel(const char *path) {
    Field field[MAX_FIELDS];
    const size_t count = describe_reel(field);
    const double rigid = 0, width = 0.1;
    int nc, status = write_alone(path, "reel", &DRUM, ONES, 0, field, count);
    if (!status) status = nc_open(path, NC_WRITE, &nc);
    if (status) return status;
    (void)nc_redef(nc);
    status = nc_put_att_double(nc, NC_GLOBAL, "obstacle_stiffness", NC_DOUBLE, 1, &rigid);
    if (!status)
        status = nc_put_att_double(nc, NC_GLOBAL, "reel_bearing_width", NC_DOUBLE, 1, &width);
    int closed = nc_close(nc);
    return status ? status : closed;
}
