/* SPDX-License-Identifier: BSD-3-Clause */
/* The force of a quadratic energy of nodes (node_field.h). */
#include "cable/node_field.h"

Vec3 cpsi_node_field_product(const double k[6], Vec3 v) {
    return vec3(k[0] * v.x + k[1] * v.y + k[3] * v.z, k[1] * v.x + k[2] * v.y + k[4] * v.z,
                k[3] * v.x + k[4] * v.y + k[5] * v.z);
}

Vec3 cpsi_node_field_force(const CpsiNodeField *field, int j, Vec3 x) {
    if (!field->stiffness) return vec3(0, 0, 0);
    return cpsi_node_field_product(&field->stiffness[6 * j], vec3_sub(vec3_at(field->place, j), x));
}

Vec3 cpsi_node_field_at(const CpsiNodeField *field, int j, Vec3 x) {
    const Vec3 force = cpsi_node_field_force(field, j, x);
    return field->load ? vec3_add(vec3_at(field->load, j), force) : force;
}
