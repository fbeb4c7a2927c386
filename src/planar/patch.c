/* SPDX-License-Identifier: BSD-3-Clause */
/* Closed forms of the dissipation of one patch, with the wrench of friction.
 *
 * The dissipation is phi(v, w) = integral of q |v + w x r| over the patch, q = friction x pressure;
 * the wrench is its gradient. About the instantaneous centre of rotation |v + w x r| = |w| rho, rho
 * the distance from it: for rods and polygons rho is then integrated along lines, and for rings and
 * discs in elliptic integrals. Far from the centre the forms would cancel, but there the integrand
 * is analytic and Gauss's rule is exact to rounding. */
#include <float.h>
#include <math.h>

#include "base/math.h"
#include "linalg/elliptic.h"
#include "linalg/gauss.h"
#include "planar/planar.h"

/* Where the centre of rotation is farther than this many sizes from the patch's middle, Gauss's
 * rule with 8 points has the relative error (4 + sqrt(15))^-16 = 4e-15 (Bernstein's ellipse through
 * the centre). */
static const double FAR = 4;

/* Integrals over y0 < y < y1 at distance d from a point, rho = sqrt(d^2 + y^2). */
typedef struct Line {
    double j0, j1, j2; /* of 1/rho, y/rho, y^2/rho */
    double i0, i1;     /* of rho, y rho */
} Line;

static Line along_line(double d, double y0, double y1) {
    const double r0 = hypot(d, y0), r1 = hypot(d, y1), far = fmax(fabs(y0), fabs(y1)),
                 near = fabs(d);

    /* j0 only occurs multiplied by d, which is negligible below 1e-30 of the length */
    const double j0 = near > 1e-30 * far ? asinh(y1 / near) - asinh(y0 / near) : 0;
    const double products = y1 * r1 - y0 * r0;
    return (Line){.j0 = j0,
                  .j1 = r1 - r0,
                  .j2 = 0.5 * (products - d * d * j0),
                  .i0 = 0.5 * (products + d * d * j0),
                  .i1 = (r1 * r1 * r1 - r0 * r0 * r0) / 3};
}

/* Add friction of strength q at r to the sum. */
static void add_point(double q, const double r[2], const double velocity[2], double w,
                      CpsiPatchDissipation *out) {
    const double v[2] = {velocity[0] - w * r[1], velocity[1] + w * r[0]}, speed = hypot(v[0], v[1]);
    if (!(speed > 0)) return;
    const double f[2] = {-q * v[0] / speed, -q * v[1] / speed};
    out->power += q * speed;
    out->force[0] += f[0];
    out->force[1] += f[1];
    out->torque += r[0] * f[1] - r[1] * f[0];
}

/* ---- points and wheels ---- */

/* v = (x along the axis, y to its left) */
static void to_axis(const CpsiPatch *patch, const double v[2], double out[2]) {
    out[0] = patch->axis[0] * v[0] + patch->axis[1] * v[1];
    out[1] = patch->axis[0] * v[1] - patch->axis[1] * v[0];
}

static void from_axis(const CpsiPatch *patch, const double v[2], double out[2]) {
    out[0] = patch->axis[0] * v[0] - patch->axis[1] * v[1];
    out[1] = patch->axis[1] * v[0] + patch->axis[0] * v[1];
}

static CpsStatus law_dissipation(const CpsiPatch *patch, const double velocity[2],
                                 CpsiPatchDissipation *out, CpsError *err) {
    double local[2], force[2] = {0, 0};
    CpsSetAnswer answer;
    /* at rest any force of the set is admissible; 0 is returned */
    if (velocity[0] == 0 && velocity[1] == 0) return CPS_OK;
    to_axis(patch, velocity, local);
    const CpsStatus status = cps_set_dissipation(patch->set, local, force, &answer, err);
    if (status != CPS_OK) return status;
    out->outcome = answer.outcome;
    out->exact = answer.exact;
    out->power = answer.value;
    out->gap = answer.gap;
    from_axis(patch, force, out->force);
    return CPS_OK;
}

/* Half the length of the chord at the edge of the strip |j.G| <= s in the disc of radius r; M77
 * figure 1. */
static double half_chord(double r, double s) { return sqrt((r - s) * (r + s)); }

CpsWheelMotion cpsi_wheel_motion(const CpsiPatch *patch, const double velocity[2]) {
    const double r = patch->strength, s = patch->strip;
    double along[2];
    to_axis(patch, velocity, along);
    CpsWheelMotion motion = {.velocity = {-along[1], along[0]}};
    const double wi = motion.velocity[0], wj = motion.velocity[1];

    /* The brake holds the wheel, which then slides; otherwise it rolls until the friction along j
     * reaches the brake's limit: Vj/|V| = s/r. */
    const bool held = s >= r || r * fabs(wj) <= s * hypot(wi, wj);
    motion.slip[0] = wi;
    motion.slip[1] = held ? wj : copysign(fabs(wi) * s / half_chord(r, s), wj);
    motion.spin = held ? 0 : (motion.slip[1] - wj) / patch->size;
    motion.ground = r * hypot(motion.slip[0], motion.slip[1]);
    motion.brake = held ? 0 : s * patch->size * fabs(motion.spin);
    return motion;
}

static void wheel_dissipation(const CpsiPatch *patch, const double velocity[2],
                              CpsiPatchDissipation *out) {
    const double r = patch->strength, s = patch->strip;
    const CpsWheelMotion motion = cpsi_wheel_motion(patch, velocity);
    const double wi = motion.velocity[0], wj = motion.velocity[1], speed = hypot(wi, wj);
    if (!(speed > 0)) return;

    /* on the arcs */
    double fi = -r * wi / speed, fj = -r * wj / speed;
    out->power = r * speed;
    if (s < r && r * fabs(wj) > s * speed) {
        /* at the corners; or, rolling straight ahead up to rounding, at the middle of an edge */
        const double c = half_chord(r, s);
        fi = fabs(wi) <= 4 * DBL_EPSILON * speed ? 0 : -copysign(c, wi);
        fj = -copysign(s, wj);
        out->power = s * fabs(wj) + c * fabs(wi);
    }
    from_axis(patch, (double[2]){fj, -fi}, out->force);
}

/* ---- rod ---- */

/* q = q0 (1 + tilt s) at s from -a to a. With y = vy + w s, the speed is hypot(vx, y). */
static void rod_dissipation(const CpsiPatch *patch, const double velocity[2], double w,
                            CpsiPatchDissipation *out) {
    const double a = patch->size, tilt = patch->tilt[0], q0 = patch->strength / (2 * a);
    double v[2];
    to_axis(patch, velocity, v);
    CpsiPatchDissipation local = {0};
    if (fabs(w) * a * FAR <= hypot(v[0], v[1])) {
        for (int i = 0; i < CPSI_GAUSS; i++) {
            const double s = a * CPSI_GAUSS_NODE[i];
            add_point(q0 * (1 + tilt * s) * a * CPSI_GAUSS_WEIGHT[i], (double[2]){s, 0}, v, w,
                      &local);
        }
    } else {
        const Line line = along_line(v[0], v[1] - w * a, v[1] + w * a);
        const double even = q0 / w * (1 - tilt * v[1] / w), odd = q0 * tilt / (w * w);
        local.power = even * line.i0 + odd * line.i1;
        local.force[0] = -v[0] * (even * line.j0 + odd * line.j1);
        local.force[1] = -(even * line.j1 + odd * line.j2);
        local.torque = -(local.power + local.force[0] * v[0] + local.force[1] * v[1]) / w;
    }
    out->power = local.power;
    out->torque = local.torque;
    from_axis(patch, local.force, out->force);
}

/* ---- ring and disc ---- */

/* Axes in which a round patch of radius a is computed: e1 from its middle to the centre of
 * rotation, at the distance d, e2 to its left. With u = |w| a, v = |w| d and r at the angle x from
 * e1, the distance from the centre of rotation is
 *
 *     rho = sqrt(a^2 + d^2 - 2 a d cos x) = (a + d) sqrt(1 - k^2 sin^2 y),
 *         k^2 = 4 u v/(u + v)^2,   x = pi - 2 y.
 *
 * i is the integral of s^2 c^2/d over a quarter turn (elliptic.h), (D - C)/3. Without rotation u =
 * 0 and v is the speed. */
typedef struct Round {
    double u, v, a;
    double e1[2], e2[2];
    double tilt[2]; /* x a, along e1, e2 */
    CpsiElliptic q;
    double k2, i;
} Round;

static Round round_axes(const CpsiPatch *patch, const double velocity[2], double w) {
    Round round = {.u = patch->size * fabs(w),
                   .v = hypot(velocity[0], velocity[1]),
                   .a = patch->size,
                   .e1 = {1, 0}};
    const double turn = copysign(1, w), sum = round.u + round.v, x = round.u / sum,
                 y = round.v / sum;
    if (round.v > 0) {
        round.e1[0] = -turn * velocity[1] / round.v;
        round.e1[1] = turn * velocity[0] / round.v;
    }
    round.e2[0] = -round.e1[1];
    round.e2[1] = round.e1[0];
    round.tilt[0] = round.a * (patch->tilt[0] * round.e1[0] + patch->tilt[1] * round.e1[1]);
    round.tilt[1] = round.a * (patch->tilt[0] * round.e2[0] + patch->tilt[1] * round.e2[1]);
    round.k2 = 4 * x * y;
    round.q = cpsi_elliptic(sqrt(round.k2), fabs(x - y));
    round.i = (round.q.d - round.q.c) / 3;
    return round;
}

/* (u1, u2) is the sum of the unit vectors away from the centre of rotation; friction is this sum,
 * turned back by a right angle. */
static void set_round_force(const Round *round, double u1, double u2, double w,
                            CpsiPatchDissipation *out) {
    const double turn = copysign(1, w);
    out->force[0] = turn * (u1 * round->e1[1] + u2 * round->e2[1]);
    out->force[1] = -turn * (u1 * round->e1[0] + u2 * round->e2[0]);
}

/* q = N (1 + tilt . r)/(2 pi): integrals of q rho, q (r - c)/rho and q r.(r - c)/rho round the
 * circle; 4/(u + v) times K, k^2 C and K - 4 i are those of 1/rho with 1, cos x, cos^2 x, in units
 * of |w|. */
static void ring_dissipation(const CpsiPatch *patch, const double velocity[2], double w,
                             CpsiPatchDissipation *out) {
    if (velocity[0] == 0 && velocity[1] == 0 && w == 0) return;
    const Round r = round_axes(patch, velocity, w);
    const double sum = r.u + r.v, n = patch->strength * 2 / CPSI_PI, m = n / sum;
    const double one = r.q.b + r.q.d, cosine = r.k2 * r.q.c, square = one - 4 * r.i;
    out->power = n * sum * (r.q.e - r.tilt[0] * r.k2 * r.i);
    set_round_force(&r, m * (r.u * cosine - r.v * one + r.tilt[0] * (r.u * square - r.v * cosine)),
                    m * r.tilt[1] * r.u * 4 * r.i, w, out);
    out->torque = -copysign(m * r.a, w) *
                  (r.u * one - r.v * cosine + r.tilt[0] * (r.u * cosine - r.v * square));
}

/* Circles at Gauss's radii with 24 points each, whose relative error is FAR^-24. */
static void disc_far(const CpsiPatch *patch, const double velocity[2], double w,
                     CpsiPatchDissipation *out) {
    enum { AROUND = 24 };
    for (int i = 0; i < AROUND; i++)
        for (int j = 0; j < CPSI_GAUSS; j++) {
            const double t = 0.5 * (1 + CPSI_GAUSS_NODE[j]), x = 2 * CPSI_PI * i / (double)AROUND;
            const double r[2] = {patch->size * t * cos(x), patch->size * t * sin(x)};
            const double pressure = 1 + patch->tilt[0] * r[0] + patch->tilt[1] * r[1];
            add_point(patch->strength * CPSI_GAUSS_WEIGHT[j] * t / (double)AROUND * pressure, r,
                      velocity, w, out);
        }
}

/* q = p (1 + tilt . r), p = N/(pi a^2). With r' = r - c, by the divergence theorem, round the
 * circle with n = r/a,
 *
 *     of q rho      = integral of r'.n (q(c)/3 + grad q . r'/4) rho      over the disc, and
 *     of q r'/rho   = integral of q rho n - grad q x integral of rho     over the disc;
 *
 * rho0, rho1, rho2: integrals of rho with 1, cos x, cos^2 x in units of a^2. (Uniform: Farkas et
 * al. 2003.) */
static void disc_near(const CpsiPatch *patch, const double velocity[2], double w,
                      CpsiPatchDissipation *out) {
    const Round r = round_axes(patch, velocity, w);
    const double d = r.v / r.u, p = patch->strength / CPSI_PI, four = 4 * (1 + d);
    const double sine = four * 4 * (r.i + 0.5 * (r.q.e - r.k2 * r.i)) / 5;
    const double rho0 = four * r.q.e, rho1 = -four * r.k2 * r.i, rho2 = rho0 - sine,
                 mean = (rho0 - d * rho1) / 3;
    const double whole =
        p * (mean * (1 + 0.25 * d * r.tilt[0]) + 0.25 * r.tilt[0] * (rho1 - d * rho2));
    const double u1 = p * (rho1 + r.tilt[0] * (rho2 - mean)), u2 = p * r.tilt[1] * (sine - mean);
    out->power = r.u * whole;
    set_round_force(&r, u1, u2, w, out);
    out->torque = -copysign(r.a, w) * (whole + d * u1);
}

static void disc_dissipation(const CpsiPatch *patch, const double velocity[2], double w,
                             CpsiPatchDissipation *out) {
    if (fabs(w) * patch->size * FAR <= hypot(velocity[0], velocity[1]))
        disc_far(patch, velocity, w, out);
    else if (w != 0)
        disc_near(patch, velocity, w, out);
}

/* ---- polygon ---- */

/* Triangles from the centroid to each side, Gauss's rule in both directions. */
static void polygon_far(const CpsiPatch *patch, const double velocity[2], double w,
                        CpsiPatchDissipation *out) {
    const double density = patch->strength / patch->area;
    for (int i = 0; i < patch->corner_count; i++) {
        const double *a = patch->corner + 2 * i,
                     *b = patch->corner + 2 * ((i + 1) % patch->corner_count);
        const double twice = a[0] * b[1] - a[1] * b[0];
        for (int j = 0; j < CPSI_GAUSS; j++)
            for (int k = 0; k < CPSI_GAUSS; k++) {
                const double t = 0.5 * (1 + CPSI_GAUSS_NODE[j]), u = 0.5 * (1 + CPSI_GAUSS_NODE[k]);
                const double r[2] = {t * (a[0] + u * (b[0] - a[0])),
                                     t * (a[1] + u * (b[1] - a[1]))};
                const double weight =
                    0.25 * CPSI_GAUSS_WEIGHT[j] * CPSI_GAUSS_WEIGHT[k] * t * twice;
                add_point(density * weight * (1 + patch->tilt[0] * r[0] + patch->tilt[1] * r[1]), r,
                          velocity, w, out);
            }
    }
}

/* Triangles from the centre of rotation c to each side, in polar coordinates about c: pressure p(c)
 * + g.r, side at distance d along its normal n, with tangent t:
 *
 *     integral of p rho          = d (p(c)/3 + d g.n/4) i0 + d g.t i1/4
 *     integral of p r/rho (n)    = d^2 (p(c)/2 + d g.n/3) j0 + d^2 g.t j1/3
 *     integral of p r/rho (t)    = d (p(c)/2 + d g.n/3) j1 + d g.t j2/3  */
static void polygon_near(const CpsiPatch *patch, const double velocity[2], double w,
                         CpsiPatchDissipation *out) {
    const double density = patch->strength / patch->area,
                 c[2] = {-velocity[1] / w, velocity[0] / w};
    const double g[2] = {density * patch->tilt[0], density * patch->tilt[1]};
    const double pressure = density + g[0] * c[0] + g[1] * c[1];
    double rho = 0, direction[2] = {0, 0};
    for (int i = 0; i < patch->corner_count; i++) {
        const double *p = patch->corner + 2 * i,
                     *q = patch->corner + 2 * ((i + 1) % patch->corner_count);
        const double a[2] = {p[0] - c[0], p[1] - c[1]}, b[2] = {q[0] - c[0], q[1] - c[1]};
        const double length = hypot(q[0] - p[0], q[1] - p[1]);
        const double t[2] = {(q[0] - p[0]) / length, (q[1] - p[1]) / length}, n[2] = {t[1], -t[0]};
        const double d = a[0] * n[0] + a[1] * n[1], gn = g[0] * n[0] + g[1] * n[1],
                     gt = g[0] * t[0] + g[1] * t[1];
        const Line line = along_line(d, a[0] * t[0] + a[1] * t[1], b[0] * t[0] + b[1] * t[1]);
        const double along_n = d * d * ((pressure / 2 + d * gn / 3) * line.j0 + gt * line.j1 / 3);
        const double along_t = d * ((pressure / 2 + d * gn / 3) * line.j1 + gt * line.j2 / 3);
        rho += d * ((pressure / 3 + d * gn / 4) * line.i0 + gt * line.i1 / 4);
        for (int k = 0; k < 2; k++) direction[k] += along_n * n[k] + along_t * t[k];
    }
    const double turn = copysign(1, w);
    out->power = fabs(w) * rho;
    out->force[0] = turn * direction[1];
    out->force[1] = -turn * direction[0];
    out->torque = -(out->power + out->force[0] * velocity[0] + out->force[1] * velocity[1]) / w;
}

static void polygon_dissipation(const CpsiPatch *patch, const double velocity[2], double w,
                                CpsiPatchDissipation *out) {
    if (fabs(w) * patch->size * FAR <= hypot(velocity[0], velocity[1]))
        polygon_far(patch, velocity, w, out);
    else
        polygon_near(patch, velocity, w, out);
}

CpsStatus cpsi_patch_dissipation_rate(const CpsiPatch *patch, const double velocity[2], double w,
                                      CpsiPatchDissipation *out, CpsError *err) {
    *out = (CpsiPatchDissipation){.outcome = CPS_SET_OUTCOME_ANSWERED, .exact = true};
    switch (patch->kind) {
    case CPS_PATCH_POINT:
        if (patch->set) return law_dissipation(patch, velocity, out, err);
        add_point(patch->strength, (double[2]){0, 0}, velocity, 0, out);
        break;
    case CPS_PATCH_WHEEL: wheel_dissipation(patch, velocity, out); break;
    case CPS_PATCH_ROD: rod_dissipation(patch, velocity, w, out); break;
    case CPS_PATCH_RING: ring_dissipation(patch, velocity, w, out); break;
    case CPS_PATCH_DISC: disc_dissipation(patch, velocity, w, out); break;
    case CPS_PATCH_POLYGON: polygon_dissipation(patch, velocity, w, out); break;
    }
    return CPS_OK;
}
