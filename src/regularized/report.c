/* SPDX-License-Identifier: BSD-3-Clause */
/* The report on a configuration of S90 section 5: its energies, its distance from the step's
 * solution, and the remaining errors due to its parameters. */
#include <math.h>

#include "base/larger.h"
#include "regularized/band_blocks.h"
#include "regularized/regularized.h"

/* a friction force below this share of its bound is one for which (36) allows no slip */
static const double BELOW_BOUND = 0.99;

static Vec3 slope(const CpsiRegularized *f, int cell) {
    return vec3_scale(1 / f->cells->width[cell],
                      vec3_sub(vec3_at(f->place, cell + 1), vec3_at(f->place, cell)));
}

/* ---- cells ---- */

static void measure_cells(const CpsiRegularized *f, CpsRegularizedReport *r, double *length) {
    const CpsiCells *c = f->cells;
    Vec3 before = vec3(0, 0, 0);
    double square = 0;
    for (int i = 0; i < c->cells; ++i) {
        const Vec3 u = slope(f, i), turn = vec3_sub(u, before);
        const double stretched = vec3_norm(u), tension = cpsi_regularized_tension(f, i);
        const double error = tension - c->tension[i];
        r->elastic += c->width[i] * f->step->compliance * tension * tension / 2;
        r->bending += f->parameters.stiffness * c->bend[i] * vec3_dot(turn, turn) / 2;
        r->shortening = cpsi_max_nan(r->shortening, 1 - stretched);
        r->tension_max = cpsi_max_nan(r->tension_max, fabs(error));
        square += c->width[i] * error * error;
        *length += c->width[i];
        before = u;
    }
    r->tension_rms = sqrt(square / *length);
}

/* (1/n) x'' at the beginning of a cell; 0 beyond end B */
static Vec3 moment(const CpsiRegularized *f, int cell) {
    if (cell == f->cells->cells) return vec3(0, 0, 0);
    const Vec3 before = cell > 0 ? slope(f, cell - 1) : vec3(0, 0, 0);
    return vec3_scale(f->parameters.stiffness * f->cells->bend[cell],
                      vec3_sub(slope(f, cell), before));
}

/* The force in a cell is its tension and the bending force, which is the difference of moments over
 * its width. A negative component along the cell is a compression. */
static void measure_compression(const CpsiRegularized *f, CpsRegularizedReport *r) {
    for (int i = 0; i < f->cells->cells; ++i) {
        const Vec3 u = slope(f, i), shear = vec3_sub(moment(f, i), moment(f, i + 1));
        const double length = vec3_norm(u) * f->cells->width[i];
        const double along = length > 0 ? vec3_dot(shear, u) / length : 0;
        r->compression = cpsi_max_nan(r->compression, -(cpsi_regularized_tension(f, i) + along));
    }
}

/* ---- places ---- */

/* by how much friction and contact would have to exceed what they can give for tensions (45) alone
 * to carry the loads */
static double excess(const CpsiRegularized *f, int j, double distance) {
    const CpsiCells *c = f->cells;
    Vec3 need = vec3_scale(-1, vec3_at(c->load, j));
    for (int side = 0; side < 2; ++side) {
        const int cell = j - 1 + side;
        if (cell < 0 || cell >= c->cells) continue;
        const Vec3 u = slope(f, cell);
        const double length = vec3_norm(u);
        if (length > 1)
            need = vec3_axpy((side ? -1 : 1) * cpsi_regularized_tension(f, cell) / length, u, need);
    }
    const Vec3 n = vec3_at(c->normal, j);
    const double push = vec3_dot(need, n), tangential = vec3_norm(vec3_axpy(-push, n, need));
    const bool touches = distance <= 0;
    return hypot(fmax(0, tangential - c->bound[j]), touches ? fmin(0, push) : push);
}

static void measure_place(const CpsiRegularized *f, int j, CpsRegularizedReport *r) {
    const CpsiCells *c = f->cells;
    const Vec3 x = vec3_at(f->place, j), u = vec3_sub(x, vec3_at(c->reference, j)),
               n = vec3_at(c->normal, j);
    const double distance = vec3_dot(u, n) + c->gap[j];
    const double slip = vec3_norm(vec3_reject(u, n)), smooth = hypot(f->parameters.delta, slip);
    r->potential -= vec3_dot(vec3_at(c->load, j), x);
    r->friction_energy += c->bound[j] * smooth;
    r->relaxed += c->bound[j] * slip;
    if (distance < 0) r->contact += f->parameters.penalty * c->share[j] * distance * distance / 2;
    if (c->bound[j] > 0 && slip < BELOW_BOUND * smooth) r->creep = cpsi_max_nan(r->creep, slip);
    r->penetration = cpsi_max_nan(r->penetration, -distance);
    r->position_max =
        cpsi_max_nan(r->position_max, vec3_norm(vec3_sub(x, vec3_at(c->position, j))));
    const bool fixed = j == 0 || (j == c->cells && f->step->held);
    if (!fixed) r->friction_excess = cpsi_max_nan(r->friction_excess, excess(f, j, distance));
}

void cpsi_regularized_measure(const CpsiRegularized *f, CpsRegularizedReport *r) {
    double length = 0;
    measure_cells(f, r, &length);
    measure_compression(f, r);
    for (int j = 0; j <= f->cells->cells; ++j) measure_place(f, j, r);
    r->relaxed += r->elastic + r->potential;
    r->total = r->elastic + r->potential + r->friction_energy + r->bending + r->contact;
    r->energy_error = r->total - f->step->energy;
}
