/* SPDX-License-Identifier: BSD-3-Clause */
/* What a scene gives of a body for steps in time (body_motion_check.h). */
#include "evolve/body_motion_check.h"

#include <math.h>

#include "base/status.h"
#include "evolve/ranges.h"
#include "linalg/dense.h"

/* Of the largest entry in its unit: a matrix that is given is symmetric to this, and what is 0 in a
 * direction may be below it by no more. */
static const double ROUNDING = 1e-9;

enum { SIX = CPS_BODY_DIRECTIONS, BOUND_ROUNDS = 10000 };

static bool are_usable(const double *v, int count) {
    bool all = true;
    for (int i = 0; i < count; i++) all = all && cpsi_is_usable(v[i]);
    return all;
}

static bool is_symmetric(const double m[36]) {
    double most = 0;
    for (int i = 0; i < 36; i++) most = fmax(most, fabs(m[i]));
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < i; k++)
            if (!(fabs(m[SIX * i + k] - m[SIX * k + i]) <= ROUNDING * most)) return false;
    return true;
}

/* Is the symmetric part of m, in the units in which its diagonal is 1, above `least` in every
 * direction? A row of nothing counts as one. */
static bool is_above(const double m[36], double least) {
    double scaled[36], factor[36];
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < SIX; k++) {
            const double unit = sqrt(fabs(m[7 * i]) * fabs(m[7 * k])),
                         entry = 0.5 * (m[SIX * i + k] + m[SIX * k + i]);
            if (i == k && entry < 0) return false;
            if (!(unit > 0) && i != k && entry != 0) return false;
            scaled[SIX * i + k] = i == k ? 1 - least : unit > 0 ? entry / unit : 0;
        }
    return cpsi_cholesky(SIX, scaled, factor);
}

bool cpsi_takes_energy(const double m[36]) { return is_above(m, -ROUNDING); }

/* Is the power u'E(|u| u) of quadratic damping never negative? With u_i = d_i a_i, and a b^2 <=
 * (a^3 + 2 b^3)/3, it is not if for some d > 0 every E_jj d_j^2 is at least the sum over i != j of
 * (2 |E_ij| d_i d_j + |E_ji| d_i^2)/3. The least such d above a first one is found from below;
 * where it grows for ever there is none. */
static bool takes_energy(const double e[36]) {
    double d[SIX], growth = INFINITY;
    for (int i = 0; i < SIX; i++) {
        if (e[7 * i] < 0) return false;
        d[i] = e[7 * i] > 0 ? 1 / cbrt(e[7 * i]) : 0;
        for (int k = 0; k < SIX; k++)
            if (!(e[7 * i] > 0 && e[7 * k] > 0) && e[SIX * i + k] != 0) return false;
    }
    for (int round = 0; round < BOUND_ROUNDS && growth > 1 + ROUNDING; round++) {
        growth = 1;
        for (int j = 0; j < SIX; j++) {
            double by = 0, square = 0;
            for (int i = 0; i < SIX; i++) {
                if (i == j) continue;
                by += 2 * fabs(e[SIX * i + j]) * d[i] / 3;
                square += fabs(e[SIX * j + i]) * d[i] * d[i] / 3;
            }
            if (!(by + square > 0)) continue;
            const double least = (by + sqrt(by * by + 4 * e[7 * j] * square)) / (2 * e[7 * j]);
            if (!isfinite(least)) return false;
            growth = fmax(growth, least / d[j]);
            d[j] = fmax(d[j], least);
        }
    }
    return growth <= 1 + ROUNDING;
}

/* The inertia matrix about the centre of gravity is that of masses: no moment of inertia about a
 * principal axis is above the sum of the other two. So with the trace t, (t/2) I - J >= 0. */
static bool is_inertia(const double j[SIX]) {
    const double half = 0.5 * (j[0] + j[1] + j[2]);
    const double m[9] = {half - j[0], -j[3], -j[4], -j[3],      half - j[1],
                         -j[5],       -j[4], -j[5], half - j[2]};
    double padded[36] = {0};
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) padded[SIX * i + k] = m[3 * i + k];
    /* rows that rounding alone makes negative */
    for (int i = 0; i < 3; i++)
        if (fabs(padded[7 * i]) <= ROUNDING * half) padded[7 * i] = ROUNDING * half;
    return half >= 0 && (half == 0 || is_above(padded, -ROUNDING));
}

/* Mass and added mass about the reference point, in the axes of the body. */
static void whole_mass(const CpsBody *body, double m[36]) {
    const double *c = body->centre_of_gravity, *j = body->inertia, mass = body->mass;
    const double square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
    const double cross[9] = {0, -c[2], c[1], c[2], 0, -c[0], -c[1], c[0], 0};
    const double about[9] = {j[0], j[3], j[4], j[3], j[1], j[5], j[4], j[5], j[2]};
    for (int i = 0; i < 36; i++) m[i] = body->added_mass[i];
    for (int i = 0; i < 3; i++) {
        m[7 * i] += mass;
        for (int k = 0; k < 3; k++) {
            m[SIX * i + 3 + k] -= mass * cross[3 * i + k];
            m[SIX * (3 + i) + k] += mass * cross[3 * i + k];
            m[SIX * (3 + i) + 3 + k] +=
                about[3 * i + k] + mass * ((i == k ? square : 0) - c[i] * c[k]);
        }
    }
}

/* Does every direction in which it may move have mass? */
static bool has_mass(const CpsBody *body) {
    double m[36];
    whole_mass(body, m);
    const bool turns = !(body->fixed[3] && body->fixed[4] && body->fixed[5]);
    for (int i = 0; i < SIX; i++) {
        if (turns || i < 3) {
            if (!(m[7 * i] > 0)) return false;
            continue;
        }
        for (int k = 0; k < SIX; k++) m[SIX * i + k] = m[SIX * k + i] = i == k;
    }
    return is_above(m, ROUNDING);
}

CpsStatus cpsi_body_motion_check(const CpsBody *body, bool in_time, CpsError *err) {
    const double *v = body->velocity;
    bool moves = false;
    for (int i = 0; i < SIX; i++) moves = moves || v[i] != 0;
    if (!cpsi_is_not_negative(body->mass))
        return CPSI_FAIL_AT("mass", err, CPS_ERR_ARGUMENT,
                            "body '%s': mass is %g kg, expected a finite number >= 0", body->name,
                            body->mass);
    if (!are_usable(body->inertia, SIX) || !is_inertia(body->inertia))
        return CPSI_FAIL_AT("moments_of_inertia", err, CPS_ERR_ARGUMENT,
                            "body '%s': moments_of_inertia: no body has moments of inertia %g, %g "
                            "and %g kg m2 with products %g, %g and %g: about no axis is one above "
                            "the sum of the other two",
                            body->name, body->inertia[0], body->inertia[1], body->inertia[2],
                            body->inertia[3], body->inertia[4], body->inertia[5]);
    if (!are_usable(body->added_mass, 36) || !is_symmetric(body->added_mass) ||
        !is_above(body->added_mass, -ROUNDING))
        return CPSI_FAIL_AT("added_mass", err, CPS_ERR_ARGUMENT,
                            "body '%s': added_mass is not a symmetric matrix of finite numbers "
                            "that has no negative energy",
                            body->name);
    if (!are_usable(body->damping, 36) || !cpsi_takes_energy(body->damping))
        return CPSI_FAIL_AT("damping", err, CPS_ERR_ARGUMENT,
                            "body '%s': damping is not a matrix of finite numbers that takes "
                            "energy, or none, in every motion",
                            body->name);
    if (!are_usable(body->quadratic_damping, 36) || !takes_energy(body->quadratic_damping))
        return CPSI_FAIL_AT("quadratic_damping", err, CPS_ERR_ARGUMENT,
                            "body '%s': quadratic_damping is not a matrix of finite numbers of "
                            "which a bound shows that it takes energy, or none, in every motion: "
                            "what couples directions is too large for its diagonal",
                            body->name);
    if (!are_usable(v, SIX))
        return CPSI_FAIL_AT("velocity", err, CPS_ERR_ARGUMENT,
                            "body '%s': velocity is (%g, %g, %g) m/s and turn_rate (%g, %g, %g) "
                            "rad/s, expected finite numbers",
                            body->name, v[0], v[1], v[2], v[3], v[4], v[5]);
    for (int i = 0; i < SIX; i++)
        if ((body->kind != CPS_BODY_KIND_FREE || body->fixed[i]) && v[i] != 0)
            return CPSI_FAIL_AT(i < 3 ? "velocity" : "turn_rate", err, CPS_ERR_ARGUMENT,
                                "body '%s': %s: only a free body begins with one, and in none of "
                                "its fixed directions",
                                body->name, i < 3 ? "velocity" : "turn_rate");
    if (in_time && body->kind == CPS_BODY_KIND_FREE && !has_mass(body))
        return CPSI_FAIL_AT("mass", err, CPS_ERR_ARGUMENT,
                            "body '%s': mass: a step of the history has a duration, and in a "
                            "direction in which the body may move it has no mass: give its mass "
                            "and moments_of_inertia",
                            body->name);
    return CPS_OK;
}
