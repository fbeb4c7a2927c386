/* SPDX-License-Identifier: BSD-3-Clause */
/* Shapes on file (shape.h). */
#include <math.h>
#include <netcdf.h>

#include "shape.h"

static int complain(FILE *log, const char *name) {
    if (log) fprintf(log, "obstacles: senseless %s\n", name);
    return -1;
}

/* n finite numbers of obstacle k. */
static int read_numbers(int nc, const char *name, size_t n, size_t k, Real *out, FILE *log) {
    const size_t start[2] = {k, 0}, count[2] = {1, n};
    double value[3];
    int id, rank = 0;
    if (nc_inq_varid(nc, name, &id) || nc_inq_varndims(nc, id, &rank) || rank != (n > 1 ? 2 : 1) ||
        nc_get_vara_double(nc, id, start, count, value))
        return complain(log, name);
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(value[i])) return complain(log, name);
        out[i] = value[i];
    }
    return 0;
}

static int check_box(Surface *s, FILE *log) {
    Real length = 0, tilt = 0;
    for (int i = 0; i < 3; i++) {
        length += s->side[i] * s->side[i];
        if (!(s->size[i] > 2 * s->radius)) return complain(log, "obstacle_size");
    }
    for (int i = 0; i < 3; i++) {
        s->side[i] /= sqrtl(length);
        tilt += s->side[i] * s->axis[i];
    }
    return fabsl(tilt) <= 1e-12L ? 0 : complain(log, "obstacle_side");
}

int shape_read(int nc, size_t k, Surface *s, FILE *log) {
    Real inside;
    int id;
    if (nc_inq_varid(nc, "obstacle_inside", &id) != NC_NOERR)
        return shape_is(s) ? complain(log, "obstacle_kind without the numbers of its shape") : 0;
    if (read_numbers(nc, "obstacle_inside", 1, k, &inside, log) ||
        read_numbers(nc, "obstacle_length", 1, k, &s->length, log) ||
        read_numbers(nc, "obstacle_main_radius", 1, k, &s->main_radius, log) ||
        read_numbers(nc, "obstacle_angle", 1, k, &s->angle, log) ||
        read_numbers(nc, "obstacle_size", 3, k, s->size, log) ||
        read_numbers(nc, "obstacle_side", 3, k, s->side, log))
        return -1;
    if (!(inside == 0 || inside == 1)) return complain(log, "obstacle_inside");
    s->inside = inside != 0;
    if (s->kind == SURFACE_CAPSULE && !(s->length >= 0)) return complain(log, "obstacle_length");
    if (s->kind == SURFACE_TORUS && !(s->main_radius > s->radius))
        return complain(log, "obstacle_main_radius");
    if (s->kind == SURFACE_CONE && !(s->angle > 0 && s->angle < acosl(0)))
        return complain(log, "obstacle_angle");
    return s->kind == SURFACE_BOX ? check_box(s, log) : 0;
}
