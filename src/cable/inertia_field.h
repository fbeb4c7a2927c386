/* SPDX-License-Identifier: BSD-3-Clause */
/* The inertia of a line as its field in a step in time (inertia.h, field.h). */
#ifndef CAPSTAN_SRC_CABLE_INERTIA_FIELD_H
#define CAPSTAN_SRC_CABLE_INERTIA_FIELD_H

#include "cable/line.h"

/* [m] x* + k v* of node j, where its inertia alone would take it from the reference x*. */
static inline Vec3 cpsi_line_free_place(const CpsiLine *line, int j, Vec3 reference) {
    return vec3_axpy(line->inertia.span[j], vec3_at(line->inertia.rest_velocity, j), reference);
}

/* [m] Where node j is expected after the step: on the parabola through its last two places that
 * leaves the first one with the velocity that it had there, which goes through four places of steps
 * that are equally long; of an Euler step from its reference with the velocity that it has. */
Vec3 cpsi_line_expected_place(const CpsiLine *line, int j, Vec3 reference);

/* Let the field of node j be that of its inertia, from the reference given. Returns [N] the size of
 * the force that it causes: a node that goes on has none, so by how its velocity changes. */
static inline double cpsi_line_set_inertia(CpsiLine *line, int j, Vec3 reference) {
    const CpsiInertia *inertia = &line->inertia;
    const double rate = 1 / inertia->span[j], mass = inertia->mass[j];
    double *k = &line->field.stiffness[6 * j];
    k[0] = k[2] = k[5] = mass * rate * rate;
    k[1] = k[3] = k[4] = 0;
    vec3_store(&line->field.place[3 * j], cpsi_line_free_place(line, j, reference));
    const Vec3 change =
        vec3_sub(vec3_at(inertia->rest_velocity, j), vec3_at(inertia->start_velocity, j));
    return mass * rate * vec3_norm(change);
}

#endif
