/* SPDX-License-Identifier: BSD-3-Clause */
/* The internal damping of a line (damping.h).
 *
 * An element has the private elongation d, at least the strain of its nodes, and the energy per
 * length EA d^2/2 + BA (d - d*)^2/(2 k), d* the elongation by the scheme, not below 0. It is the
 * element of the stiffness EA + BA/k that is without tension at d = r,
 *
 *     T = ((EA + BA/k) (d - r))^+,      (EA + BA/k) r = (BA/k) d*,
 *
 * which is an elastic one of the length at rest (1 + r) l and the stiffness (1 + r) (EA + BA/k).
 * Its tension is never negative; where the strain is below r the elongation is r. */
#include "cable/damping.h"

#include <math.h>
#include <string.h>

#include "base/larger.h"

/* [N] EA of element e. */
static double stiffness_of(const CpsiLine *line, int e) {
    return 1 / (line->compliance * line->inertia.damping.own_factor[e]);
}

/* [s] k of element e, and d*: an Euler step where one is of either of its nodes. */
static double span_of(const CpsiLine *line, int e, double *before) {
    const CpsiInertia *inertia = &line->inertia;
    const CpsiDamping *damping = &inertia->damping;
    const bool euler = inertia->is_euler[e] || inertia->is_euler[e + 1];
    const double d = damping->elongation[e];
    *before = euler ? d : cpsi_max_nan(0, d + inertia->formula.back * (d - damping->before[e]));
    return cpsi_max_nan(inertia->span[e], inertia->span[e + 1]);
}

static double strain_of(const CpsiLine *line, int e) {
    const Vec3 d = vec3_sub(vec3_at(line->position, e + 1), vec3_at(line->position, e));
    return vec3_norm(d) / line->natural_length[e] - 1;
}

void cpsi_line_begin_damping(CpsiLine *line) {
    CpsiDamping *damping = &line->inertia.damping;
    for (int e = 0; e + 1 < line->n; e++)
        damping->elongation[e] = damping->before[e] = fmax(0, strain_of(line, e));
}

void cpsi_line_damp(CpsiLine *line) {
    CpsiDamping *damping = &line->inertia.damping;
    for (int e = 0; e + 1 < line->n; e++) {
        double before;
        const double viscous = damping->coefficient / span_of(line, e, &before),
                     all = stiffness_of(line, e) + viscous, rest = viscous * before / all;
        damping->rest[e] = rest;
        line->element_length[e] = (1 + rest) * line->natural_length[e];
        line->compliance_factor[e] = 1 / (line->compliance * (1 + rest) * all);
    }
}

void cpsi_line_undamp(CpsiLine *line) {
    CpsiDamping *damping = &line->inertia.damping;
    memset(damping->rest, 0, (size_t)line->n * sizeof *damping->rest);
    for (int e = 0; e + 1 < line->n; e++) {
        line->element_length[e] = line->natural_length[e];
        line->compliance_factor[e] = damping->own_factor[e];
    }
}

CpsiDamped cpsi_line_damped(const CpsiLine *line, int e) {
    const CpsiDamping *damping = &line->inertia.damping;
    double before;
    const double viscous = damping->coefficient / span_of(line, e, &before),
                 d = cpsi_max_nan(damping->rest[e], strain_of(line, e)),
                 from = damping->elongation[e], longer = line->natural_length[e] * (d - from);
    return (CpsiDamped){.stored = 0.5 * stiffness_of(line, e) * longer * (d + from),
                        .damped = viscous * (d - before) * longer,
                        .elongation = d};
}

double cpsi_line_kept_energy(const CpsiLine *line) {
    double sum = 0;
    for (int e = 0; e + 1 < line->n; e++) {
        const double d = line->inertia.damping.elongation[e], strain = fmax(0, strain_of(line, e));
        sum += 0.5 * line->natural_length[e] * stiffness_of(line, e) * (d - strain) * (d + strain);
    }
    return sum;
}

void cpsi_line_advance_damping(CpsiLine *line) {
    CpsiDamping *damping = &line->inertia.damping;
    for (int e = 0; e + 1 < line->n; e++) {
        const double now = cpsi_line_damped(line, e).elongation;
        damping->before[e] = damping->elongation[e];
        damping->elongation[e] = now;
    }
}
