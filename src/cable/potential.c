/* SPDX-License-Identifier: BSD-3-Clause */
/* The potential of a program on a line (potential.h). */
#include "cable/potential.h"

#include <math.h>
#include <string.h>

#include "cable/field.h"

static const double NOT_USABLE = 1e300; /* [N] */

/* What a node has of the potential at a place; without force where it is not usable. */
typedef struct Local {
    bool is_usable; /* finite and nowhere concave */
    double energy;  /* [J] */
    Vec3 force;     /* [N] */
    double stiffness[6];
} Local;

/* Is v'K v nowhere negative, but for rounding? So no minor of K about its diagonal may be. */
static bool is_convex(const double k[6]) {
    const double xy = k[0] * k[2], xz = k[0] * k[5], yz = k[2] * k[5], all = xy * k[5],
                 noise = 1e-10;
    if (!(k[0] >= 0 && k[2] >= 0 && k[5] >= 0)) return false;
    return xy * (1 + noise) >= k[1] * k[1] && xz * (1 + noise) >= k[3] * k[3] &&
           yz * (1 + noise) >= k[4] * k[4] &&
           all + 2 * k[1] * k[3] * k[4] - k[0] * k[4] * k[4] - k[2] * k[3] * k[3] -
                   k[5] * k[1] * k[1] >=
               -noise * all;
}

static Local local(const CpsiLine *line, int j, Vec3 x) {
    const CpsiPotential *potential = &line->field.potential;
    const double share = line->field.share[j];
    double place[3], gradient[3] = {0}, second[6] = {0};
    Local out = {.is_usable = true};
    if (!(share > 0)) return out;
    vec3_store(place, vec3_add(x, vec3_load(potential->origin)));
    out.energy = share * potential->given.function(potential->given.user, place, gradient, second);
    out.force = vec3_scale(-share, vec3_load(gradient));
    for (int i = 0; i < 6; i++) out.stiffness[i] = share * second[i];
    if (isfinite(out.energy) && isfinite(vec3_norm(out.force)) && is_convex(out.stiffness))
        return out;
    return (Local){.is_usable = false};
}

void cpsi_potential_model(CpsiLine *line, const double *x) {
    if (!line->has_potential) return;
    cpsi_line_field_clear(line);
    for (int j = 0; j < line->n; j++) {
        const Local at = local(line, j, vec3_at(x, j));
        vec3_store(&line->field.pull[3 * j], at.force);
        line->field.energy[j] = at.energy;
        cpsi_line_field_add(line, j, at.stiffness, vec3_at(x, j));
    }
}

/* The force of the model on node j at the position: the pull, and what the field has beyond the
 * springs. */
static Vec3 model_force(const CpsiLine *line, int j) {
    const CpsiNodeField *field = &line->field;
    const Vec3 x = vec3_at(line->position, j), pull = vec3_at(field->pull, j),
               springs = cpsi_node_field_product(&field->own_stiffness[6 * j],
                                                 vec3_sub(x, vec3_at(field->own_place, j)));
    return vec3_add(vec3_add(pull, springs), cpsi_line_field_force(line, j, x));
}

void cpsi_potential_settle(CpsiLine *line) {
    if (!line->has_potential) return;
    for (int j = 0; j < line->n; j++) {
        vec3_store(&line->field.pull[3 * j], model_force(line, j));
        line->field.energy[j] = local(line, j, vec3_at(line->position, j)).energy;
    }
    cpsi_line_field_clear(line);
}

double cpsi_potential_change(const CpsiLine *line) {
    double changed = 0;
    if (!line->has_potential) return 0;
    for (int j = 0; j < line->n; j++) {
        const Local at = local(line, j, vec3_at(line->position, j));
        if (!at.is_usable) return NOT_USABLE;
        changed += vec3_norm(vec3_sub(at.force, model_force(line, j)));
    }
    return changed;
}

void cpsi_potential_stiffness(const CpsiLine *line, int j, double out[6]) {
    memcpy(out, &line->field.stiffness[6 * j], 6 * sizeof *out);
    if (!line->has_potential) return;
    const Local at = local(line, j, vec3_at(line->position, j));
    for (int i = 0; i < 6; i++) out[i] += at.stiffness[i];
}

double cpsi_potential_energy(const CpsiLine *line, const double *x) {
    double sum = 0;
    if (!line->has_potential) return 0;
    for (int j = 0; j < line->n; j++) sum += local(line, j, vec3_at(x, j)).energy;
    return sum;
}
