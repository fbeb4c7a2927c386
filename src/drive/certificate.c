/* SPDX-License-Identifier: BSD-3-Clause */
/* The bounds on gamma(W) and the residuals of all relations, from V, F, G and lambda alone.
 *
 * With V any velocity and F_k any forces, r = sum of B_k*F_k + load - D*G - C*lambda,
 *
 *     upper = sum of phi_k(U_k) - <load, V>     >=  gamma                       if D V = W, C V = 0
 *     lower = - <W, G> - sum of phi_k*(-F_k)    <=  gamma
 *         if r = 0, F_k in C_k
 *
 * The conditions are violated only by rounding. Each violation is multiplied by its factor in the
 * power, |V_i|, |U_k|, |G| or |lambda|, and included in the bounds. So is the rounding of the
 * bounds' own arithmetic, so that lower <= upper is a reliable gap. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/larger.h"
#include "base/status.h"
#include "drive/motion.h"
#include "ipm/cones.h"
#include "linalg/dense.h"

/* Velocities that one-sided laws forbid count as on the boundary up to this share of the largest
 * velocity. */
static const double ON_BOUNDARY = 1e-8;

/* Forces whose imbalance exceeds this share of the largest force are not in equilibrium: a hundred
 * times the allowed error of a solution. */
static const double BALANCED = 1e-6;

/* Error of the closed forms of potentials, conjugates and distances, and of the few additions in a
 * bound, relative to their size: each is accurate to a few eps. Sums over rows, columns and laws
 * are computed with twice the digits. */
static const double ROUNDING = 16 * DBL_EPSILON;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a certificate");
}

/* A sum with twice the digits: the rounding errors of additions and products are stored beside
 * it. */
static void add(CpsiSum *sum, double x) {
    const double next = sum->high + x;
    if (isfinite(next))
        sum->low += fabs(sum->high) >= fabs(x) ? (sum->high - next) + x : (x - next) + sum->high;
    sum->high = next;
}

static void add_product(CpsiSum *sum, double a, double b) {
    const double product = a * b;
    add(sum, product);
    if (isfinite(product)) sum->low += fma(a, b, -product);
}

static double total(const CpsiSum *sum) {
    return isfinite(sum->high) ? sum->high + sum->low : sum->high;
}

/* <row i, x> - y, computed as the residual itself, since <row i, x> alone is only accurate to the
 * rounding of y */
static double row_residual(const CpsiRows *rows, int i, const double *x, double y) {
    CpsiSum sum = {-y, 0};
    for (size_t e = rows->start[i]; e < rows->start[i + 1]; e++)
        add_product(&sum, rows->value[e], x[rows->column[e]]);
    return total(&sum);
}

static void add_row(const CpsiRows *rows, int i, double factor, CpsiSum *out) {
    for (size_t e = rows->start[i]; e < rows->start[i + 1]; e++)
        add_product(&out[rows->column[e]], factor, rows->value[e]);
}

void cpsi_motion_carry(CpsMotion *motion) {
    for (int i = 0; i < motion->system->components; i++)
        motion->law_velocity[i] = cpsi_rows_times(&motion->system->map, i, motion->velocity);
}

void cpsi_motion_recover_forces(CpsMotion *motion, const CpsiDriveProgram *program) {
    const CpsSystem *system = motion->system;
    memset(motion->law_force, 0, (size_t)system->components * sizeof *motion->law_force);
    for (int k = 0; k < system->pieces; k++) {
        const CpsiPiece *piece = &system->piece[k];
        double *force = &motion->piece_force[motion->piece_at[k]];
        double *whole = &motion->law_force[system->law[piece->law].first + piece->offset];
        cpsi_drive_program_force(program, k, force);
        for (int i = 0; i < piece->space; i++) whole[i] += force[i];
    }
    cpsi_drive_program_multipliers(program, motion->resistance, motion->constraint);
}

/* Contribution of one piece. */
typedef struct Contribution {
    double potential, conjugate, outside, forbidden, missing;
} Contribution;

/* phi(U) and the distance of F from C by the conic form, F = o + P v. With z of the program, A'z =
 * P'U + e,
 *
 *     phi(U) <= -<U, o> + b.z + <e, v'> for every v' of the form,
 *         F is outside by at most the distance of A v + b from K.
 *
 * It is used for sets without a closed form, and for velocities that the recession of an unbounded
 * set forbids because of rounding. */
static Contribution by_form(const CpsMotion *motion, const CpsiDriveProgram *program, int k,
                            const double *u) {
    const CpsiConicForm *form = program->form[k];
    const double *z = program->result.z + program->row[k];
    const double *v = program->result.x + program->first[k];
    const int space = motion->system->piece[k].space, n = form->unknowns;
    const double unit = n > 0 ? program->column_scale[program->first[k]] : 1,
                 power = program->power / unit; /* v in units of `unit` */
    Contribution part = {0};
    CpsiSum potential = {0};
    for (int i = 0; i < form->rows; i++) add_product(&potential, power * form->b[i], z[i]);
    for (int i = 0; i < space; i++) add_product(&potential, -u[i], form->origin[i]);
    part.potential = total(&potential);
    for (int j = 0; j < n; j++) {
        CpsiSum sum = {0};
        for (int i = 0; i < form->rows; i++)
            add_product(&sum, power * form->a[(size_t)i * (size_t)n + (size_t)j], z[i]);
        for (int i = 0; i < space; i++)
            add_product(&sum, -form->p[(size_t)i * (size_t)n + (size_t)j], u[i]);
        const double e = total(&sum);
        part.forbidden = fmax(part.forbidden, fabs(e) / form->size);
        part.missing += fabs(e) * unit * (1 + fabs(v[j])); /* v is of order one */
    }
    CPSI_FOR_CONES(c, i, form->cones, form->dim) {
        double first = 0, rest = 0;
        for (int r = 0; r < form->dim[c]; r++) {
            const double s =
                form->b[i + r] + unit * cpsi_dot(n, &form->a[(size_t)(i + r) * (size_t)n], v);
            if (r == 0)
                first = s;
            else
                rest = hypot(rest, s);
        }
        part.outside = fmax(part.outside, (rest - first) * form->size);
    }
    return part;
}

static CpsStatus friction_part(const CpsMotion *motion, const CpsiDriveProgram *program, int k,
                               const double *u, const double *f, Contribution *part,
                               CpsError *err) {
    const CpsiPiece *piece = &motion->system->piece[k];
    CpsSetAnswer phi, margin;
    CpsStatus status = cps_set_dissipation(piece->set, u, NULL, &phi, err);
    if (status == CPS_OK) status = cps_set_contains(piece->set, f, NULL, &margin, err);
    if (status != CPS_OK) return status;
    part->potential =
        phi.outcome == CPS_SET_OUTCOME_ANSWERED || phi.outcome == CPS_SET_OUTCOME_NOT_ATTAINED
            ? phi.value + phi.gap
            : INFINITY;
    part->outside = margin.outcome == CPS_SET_OUTCOME_ANSWERED ? fmax(0, -margin.value) : INFINITY;
    if (!program || (phi.exact && isfinite(part->potential) && margin.exact)) return CPS_OK;

    /* the tighter of the two certificates, each with its own violations */
    const Contribution form = by_form(motion, program, k, u);
    if (form.potential + form.missing < part->potential || !isfinite(part->potential)) {
        part->potential = form.potential;
        part->missing = form.missing;
        if (phi.outcome == CPS_SET_OUTCOME_UNBOUNDED) part->forbidden = form.forbidden;
    }
    part->outside = fmin(part->outside, form.outside);
    return CPS_OK;
}

/* h*(gauge of C at F), or <F, D^-1 F>/2 */
static CpsStatus term_conjugate(const CpsiPiece *piece, const double *f, Contribution *part,
                                CpsError *err) {
    const size_t n = (size_t)piece->space;
    if (piece->term->kind == CPSI_VISCOUS) {
        double *factor = calloc(2 * n * n, sizeof *factor), *inverse = factor + n * n;
        if (!factor) return out_of_memory(err);
        if (cpsi_cholesky(piece->space, piece->term->data, factor)) {
            cpsi_lower_inverse(piece->space, factor, inverse);
            for (size_t i = 0; i < n; i++) {
                const double y = cpsi_dot((int)i + 1, &inverse[i * n], f);
                part->conjugate += 0.5 * y * y;
            }
        } else
            part->conjugate = INFINITY;
        free(factor);
        return CPS_OK;
    }
    CpsSetAnswer gauge;
    CpsiTermDual dual = {.value = INFINITY};
    CpsStatus status = cps_set_gauge(piece->set, f, &gauge, err);
    if (status != CPS_OK) return status;
    /* beyond the end of a table: replaced by the end; the difference counts as outside */
    const double end =
        piece->term->kind == CPSI_TABLE ? piece->term->data[2 * piece->term->count - 1] : INFINITY;
    const double s = fmin(gauge.value, end);
    if (gauge.value > end) part->outside = (1 - end / gauge.value) * cpsi_norm(piece->space, f);
    if (gauge.outcome == CPS_SET_OUTCOME_ANSWERED)
        status = cpsi_term_dual(piece->term, s, &dual, err);
    part->conjugate = dual.value;
    return status;
}

static CpsStatus piece_part(const CpsMotion *motion, const CpsiDriveProgram *program, int k,
                            Contribution *part, CpsError *err) {
    const CpsiPiece *piece = &motion->system->piece[k];
    const double *u = &motion->law_velocity[motion->system->law[piece->law].first + piece->offset];
    const double *f = &motion->piece_force[motion->piece_at[k]];
    *part = (Contribution){0};
    if (!piece->term || piece->term->kind == CPSI_DRY)
        return friction_part(motion, program, k, u, f, part, err);
    return term_conjugate(piece, f, part, err);
}

/* Sums over the laws; `terms` are the sizes of the terms of the bounds. */
typedef struct Totals {
    CpsiSum potential, conjugate;
    double terms, missing, gap, dissipated, size, outside, forbidden;
} Totals;

static CpsStatus law_totals(CpsMotion *motion, const CpsiDriveProgram *program, int l,
                            Totals *totals, CpsError *err) {
    const CpsiSystemLaw *law = &motion->system->law[l];
    const double *u = &motion->law_velocity[law->first], *f = &motion->law_force[law->first];
    CpsMotionShare share = {0};
    double conjugate = 0;
    for (int k = law->piece; k < law->piece + law->pieces; k++) {
        Contribution part;
        const CpsStatus status = piece_part(motion, program, k, &part, err);
        if (status != CPS_OK) return status;
        share.potential += part.potential;
        share.outside = cpsi_max_nan(share.outside, part.outside);
        conjugate += part.conjugate;
        totals->missing += part.missing;
        totals->forbidden = cpsi_max_nan(totals->forbidden, part.forbidden);
    }
    if (law->resistance) {
        CpsResistanceValue value;
        const CpsStatus status = cps_resistance_value(law->resistance, u, &value, NULL, err);
        if (status != CPS_OK) return status;
        share.potential = value.outcome == CPS_SET_OUTCOME_ANSWERED ||
                                  value.outcome == CPS_SET_OUTCOME_NOT_ATTAINED
                              ? value.potential + value.gap
                              : INFINITY;
    }
    const double speed = cpsi_norm(law->space, u), force = cpsi_norm(law->space, f);
    const double power = cpsi_dot(law->space, u, f);
    share.dissipated = power == 0 ? 0 : -power;
    share.gap = share.potential + conjugate + power;
    motion->share[l] = share;
    add(&totals->potential, share.potential);
    add(&totals->conjugate, conjugate);
    totals->terms += fabs(share.potential) + fabs(conjugate) + speed * force;
    totals->missing += share.outside * speed;
    /* phi is evaluated at U, to which V adds a rounding error */
    for (int i = 0; i < law->space; i++)
        totals->missing +=
            fabs(f[i] * row_residual(&motion->system->map, law->first + i, motion->velocity, u[i]));
    totals->gap += share.gap;
    totals->dissipated += share.dissipated;
    totals->size += speed * force;
    if (share.outside > 0)
        totals->outside = cpsi_max_nan(totals->outside, share.outside / fmax(force, motion->force));
    return CPS_OK;
}

static double largest_of(int n, const double *a) {
    double largest = 0;
    for (int i = 0; i < n; i++) largest = cpsi_max_nan(largest, fabs(a[i]));
    return largest;
}

/* Kinematics and equilibrium: residuals, and their contribution to the bounds. */
static void measure_balance(CpsMotion *motion, double *above, double *below) {
    const CpsSystem *system = motion->system;
    CpsMotionReport *report = &motion->report;
    CpsiSum *r = motion->balance;
    double moved = 0, held = 0, left = 0, force = largest_of(system->components, motion->law_force);
    for (int i = 0; i < system->n; i++) r[i] = (CpsiSum){system->load ? system->load[i] : 0, 0};
    for (int i = 0; i < system->components; i++) add_row(&system->map, i, motion->law_force[i], r);
    for (int i = 0; i < system->n; i++) force = cpsi_max_nan(force, fabs(total(&r[i])));
    for (int j = 0; j < system->drive.rows; j++) {
        const double miss = row_residual(&system->drive, j, motion->velocity, motion->driving[j]);
        add_row(&system->drive, j, -motion->resistance[j], r);
        moved = cpsi_max_nan(moved, fabs(miss));
        *above += fabs(miss * motion->resistance[j]);
    }
    for (int j = 0; j < system->constraint.rows; j++) {
        const double miss = row_residual(&system->constraint, j, motion->velocity, 0);
        add_row(&system->constraint, j, -motion->constraint[j], r);
        held = cpsi_max_nan(held, fabs(miss));
        *above += fabs(miss * motion->constraint[j]);
    }
    for (int i = 0; i < system->n; i++) {
        left = cpsi_max_nan(left, fabs(total(&r[i])));
        *below += fabs(total(&r[i]) * motion->velocity[i]);
    }
    const double drive = largest_of(system->drive.rows, motion->driving);
    report->drive = drive > 0 ? moved / drive : moved;
    report->constraint = motion->speed > 0 ? held / motion->speed : held;
    force = fmax(force, motion->force);
    report->equilibrium = left / force;
}

CpsStatus cpsi_motion_certify(CpsMotion *motion, const CpsiDriveProgram *program, CpsError *err) {
    const CpsSystem *system = motion->system;
    CpsMotionReport *report = &motion->report;
    Totals totals = {0};
    CpsiSum load = {0}, drive = {0};
    double above = 0, below = 0;
    cpsi_motion_carry(motion);
    motion->speed = cpsi_max_nan(motion->speed, largest_of(system->n, motion->velocity));
    for (int l = 0; l < system->laws; l++) {
        const CpsStatus status = law_totals(motion, program, l, &totals, err);
        if (status != CPS_OK) return status;
    }
    measure_balance(motion, &above, &below);
    for (int j = 0; j < system->drive.rows; j++)
        add_product(&drive, motion->driving[j], motion->resistance[j]);
    for (int i = 0; i < system->n && system->load; i++)
        add_product(&load, system->load[i], motion->velocity[i]);
    const double drive_power = total(&drive);
    report->load_power = total(&load);
    const double rounding =
        ROUNDING * (totals.terms + fabs(drive_power) + fabs(report->load_power));
    report->upper =
        total(&totals.potential) - report->load_power + above + totals.missing + rounding;
    report->lower = -drive_power - total(&totals.conjugate) - below - totals.missing - rounding;
    report->value = report->upper;
    report->minimum = report->upper - report->lower;
    report->law = totals.gap;
    report->dissipated = totals.dissipated;
    report->outside = totals.outside;
    const double forbidden =
        motion->speed > 0 ? totals.forbidden / motion->speed : totals.forbidden;
    report->constraint = cpsi_max_nan(report->constraint, forbidden);
    if (!(forbidden <= ON_BOUNDARY)) report->upper = report->value = report->minimum = INFINITY;
    /* forces that are not in equilibrium prove nothing about velocities other than V */
    if (!(report->equilibrium <= BALANCED)) {
        report->lower = -INFINITY;
        report->minimum = INFINITY;
    }
    report->scale = fmax(fmax(totals.size, motion->force * motion->driven),
                         fabs(report->load_power) + fabs(drive_power));
    return CPS_OK;
}
