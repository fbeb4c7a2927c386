/* SPDX-License-Identifier: BSD-3-Clause */
/* The field of a line: a quadratic energy of each node (node_field.h). Springs to the ground are
 * one, and so is what a mass adds to a step of time. */
#ifndef CAPSTAN_SRC_CABLE_FIELD_H
#define CAPSTAN_SRC_CABLE_FIELD_H

#include "cable/line.h"

static inline bool cpsi_line_has_field(const CpsiLine *line) { return line->field.stiffness; }

/* Do loads depend on where the line comes to be? */
static inline bool cpsi_line_loads_follow(const CpsiLine *line) {
    return line->field.flow || line->has_potential;
}

/* K v of node j, and the force -K (x - a) of the field on it at x; 0 without a field. */
static inline Vec3 cpsi_line_field_pull(const CpsiLine *line, int j, Vec3 v) {
    if (!cpsi_line_has_field(line)) return vec3(0, 0, 0);
    return cpsi_node_field_product(&line->field.stiffness[6 * j], v);
}
static inline Vec3 cpsi_line_field_force(const CpsiLine *line, int j, Vec3 x) {
    return cpsi_node_field_force(&line->field, j, x);
}

/* [N/m] What acts on node j per length of the line: its weight, given loads, drag and field. */
Vec3 cpsi_line_load_at(const CpsiLine *line, int j);

/* [J] (x - a)'K (x - a)/2 */
static inline double cpsi_line_field_energy(const CpsiLine *line, int j, Vec3 x) {
    if (!cpsi_line_has_field(line)) return 0;
    const Vec3 off = vec3_sub(x, vec3_at(line->field.place, j));
    return 0.5 * vec3_dot(off, cpsi_line_field_pull(line, j, off));
}

/* Set K and load of all nodes to what the scene gives, 0 without. */
void cpsi_line_field_clear(CpsiLine *line);
/* Add (x - place)'K (x - place)/2 to the energy of node j: K (6) [N/m] >= 0, place [m]. */
void cpsi_line_field_add(CpsiLine *line, int j, const double stiffness[6], Vec3 place);

/* An orthonormal basis of the directions that K (6) resists; returns their number. */
int cpsi_field_range(const double stiffness[6], Vec3 basis[3]);
/* Does the field hold node j in all directions? */
bool cpsi_line_field_holds(const CpsiLine *line, int j);
/* v without what the field, as a whole, resists: so v is if there is none. */
Vec3 cpsi_line_field_free_part(const CpsiLine *line, Vec3 v);
/* Does the field resist no motion of the line along the unit vector v? */
bool cpsi_line_field_lets(const CpsiLine *line, Vec3 v);

/* [N] The size of the forces of the field, for a step from the reference. */
double cpsi_line_field_size(const CpsiLine *line);

/* [N] The force of the field that is in the balance of node j: at its position, and beside it by
 * `beside`. */
static inline Vec3 cpsi_line_field_balanced(const CpsiLine *line, int j) {
    if (!cpsi_line_has_field(line)) return vec3(0, 0, 0);
    const Vec3 here = cpsi_line_field_force(line, j, vec3_at(line->position, j));
    return vec3_sub(here, cpsi_line_field_pull(line, j, vec3_at(line->field.beside, j)));
}
/* Choose `beside` so that the field takes over what is left of the balance of node j with the field
 * at its position, where its stiffness is large beside `unit` [N/m]. */
void cpsi_line_field_take(CpsiLine *line, int j, Vec3 rest, double unit);

#endif
