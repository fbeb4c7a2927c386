/* SPDX-License-Identifier: BSD-3-Clause */
/* Points and bodies in time (joint_motion.h).
 *
 * By the scheme every quantity y has a rate (y - y*)/k: y* = (4 y_n - y_{n-1})/3 and k = 2 h/3, or
 * y* = y_n and k = h. Of a point y is its place and its velocity. Of a body y is the place of its
 * reference point and of its centre of gravity, the rotation vector t of Q Q_n', and the momenta:
 *
 *     R dt:  w = V(t) dt/dt,  V(t) = integral over s from 0 to 1 of exp(s [t])
 *
 * is its rate of rotation (V by Simpson's rule on rotation matrices of quaternions). Force and
 * moment of inertia are minus the rates of m v_c and J w about the centre of gravity, and of A (u,
 * w) about the reference point u, with -u x (A (u, w)) as a moment. */
#include "joint_motion.h"

#include <float.h>
#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

#include "formula.h"

/* Rounding of places, per largest coordinate; of rotations; of forces and energies, per sizes. */
static const double PLACES = 1e-13, TURNS = 1e-13, FORCES = 1e-10, ENERGIES = 1e-9, SUMS = 1e-14;
/* Roundings of coordinates in a depth, and in a difference of places that are turned. */
static const double ROUNDINGS = 16;
enum { SIMPSON = 64, SIMPSON_PER_RADIAN = 1024 };

/* ---- reading ---- */

static int complain(FILE *log, const char *what) {
    if (log) fprintf(log, "missing or senseless motion: %s\n", what);
    return -1;
}

double step_length_of(const Source *source, size_t step) {
    int id;
    double length = 0;
    if (nc_inq_varid(source->nc, "time_step", &id) ||
        nc_get_var1_double(source->nc, id, &step, &length))
        return 0;
    return length;
}

static bool has_time(const Source *source) {
    int id;
    return nc_inq_varid(source->nc, "time", &id) == NC_NOERR;
}

/* `width` numbers of each of `count` things, every `stride` bytes; step < 0: a constant. */
static int read_all(const Source *source, const char *name, long step, size_t count, size_t width,
                    double *out, size_t stride) {
    int id;
    const bool varies = step >= 0;
    for (size_t k = 0; k < count; k++) {
        const size_t start[] = {varies ? (size_t)step : k, varies ? k : 0, 0, 0};
        const size_t each[] = {1, varies ? 1 : width, width, 1};
        double *to = (double *)(void *)((char *)out + k * stride);
        if (nc_inq_varid(source->nc, name, &id) ||
            nc_get_vara_double(source->nc, id, start, each, to))
            return -1;
        for (size_t i = 0; i < width; i++)
            if (!isfinite(to[i])) return -1;
    }
    return 0;
}

/* A flag of each of `count` things in a step, 0 or 1. */
static int read_flags(const Source *source, const char *name, size_t step, size_t count, int *out,
                      size_t stride) {
    int id;
    for (size_t k = 0; k < count; k++) {
        const size_t at[] = {step, k};
        int *to = (int *)(void *)((char *)out + k * stride);
        if (nc_inq_varid(source->nc, name, &id) || nc_get_var1_int(source->nc, id, at, to) ||
            (*to != 0 && *to != 1))
            return -1;
    }
    return 0;
}

int point_motions_read(const Source *source, size_t step, PointMotion *all, FILE *log) {
    const size_t n = source->points, each = sizeof *all;
    const long s = (long)step;
    for (size_t k = 0; k < n; k++) all[k] = (PointMotion){0};
    if (n == 0 || !has_time(source)) return 0;
    if (read_all(source, "mass_of_point", -1, n, 1, &all->mass, each) ||
        read_all(source, "inertia_of_point", s, n, 3, all->inertia, each) ||
        read_all(source, "velocity_of_point", s, n, 3, all->velocity, each) ||
        read_all(source, "reference_of_point", s, n, 3, all->reference, each) ||
        read_all(source, "rest_velocity_of_point", s, n, 3, all->rest_velocity, each) ||
        read_all(source, "span_of_point", s, n, 1, &all->span, each) ||
        read_all(source, "kinetic_of_point", s, n, 1, &all->kinetic, each) ||
        read_all(source, "ledger_kinetic_of_point", s, n, 1, &all->growth, each) ||
        read_all(source, "ledger_impact_of_point", s, n, 1, &all->impact, each) ||
        read_all(source, "ledger_scheme_of_point", s, n, 1, &all->scheme, each) ||
        read_all(source, "ledger_settling_of_point", s, n, 1, &all->settling, each) ||
        read_all(source, "ledger_damping_of_point", s, n, 1, &all->damped, each) ||
        read_flags(source, "velocity_given_of_point", step, n, &all->velocity_given, each))
        return complain(log, "points");
    return 0;
}

/* The four blocks of a matrix. */
static int read_matrix(const Source *source, const char *name, size_t count, double *out,
                       size_t stride) {
    static const char *const BLOCK[] = {"xx", "xr", "rx", "rr"};
    for (int b = 0; b < 4; b++)
        for (size_t k = 0; k < count; k++) {
            char full[80];
            int id;
            double block[9];
            const size_t start[] = {k, 0, 0}, each[] = {1, 3, 3};
            double *to = (double *)(void *)((char *)out + k * stride);
            snprintf(full, sizeof full, "%s_%s_of_body", name, BLOCK[b]);
            if (nc_inq_varid(source->nc, full, &id) ||
                nc_get_vara_double(source->nc, id, start, each, block))
                return -1;
            for (int i = 0; i < 9; i++)
                to[SIX * (3 * (b / 2) + i / 3) + 3 * (b % 2) + i % 3] = block[i];
        }
    return 0;
}

int body_motions_read(const Source *source, size_t n, size_t step, BodyMotion *all, FILE *log) {
    const size_t each = sizeof *all;
    const long s = (long)step;
    for (size_t k = 0; k < n; k++) all[k] = (BodyMotion){0};
    if (n == 0 || !has_time(source)) return 0;
    if (read_all(source, "mass_of_body", -1, n, 1, &all->mass, each) ||
        read_all(source, "moments_of_inertia_of_body", -1, n, 3, all->moments, each) ||
        read_all(source, "products_of_inertia_of_body", -1, n, 3, all->products, each) ||
        read_matrix(source, "added_mass", n, all->added, each) ||
        read_matrix(source, "damping_matrix", n, all->damping, each) ||
        read_matrix(source, "quadratic_damping", n, all->quadratic, each) ||
        read_all(source, "inertia_of_body", s, n, 3, all->inertia, each) ||
        read_all(source, "inertia_moment_of_body", s, n, 3, &all->inertia[3], each) ||
        read_all(source, "damping_of_body", s, n, 3, all->damped, each) ||
        read_all(source, "damping_moment_of_body", s, n, 3, &all->damped[3], each) ||
        read_all(source, "velocity_of_body", s, n, 3, all->velocity, each) ||
        read_all(source, "turn_rate_of_body", s, n, 3, all->rate, each) ||
        read_all(source, "centre_velocity_of_body", s, n, 3, all->centre_velocity, each) ||
        read_all(source, "span_of_body", s, n, 1, &all->span, each) ||
        read_all(source, "kinetic_of_body", s, n, 1, &all->kinetic, each) ||
        read_all(source, "damped_of_body", s, n, 1, &all->lost, each) ||
        read_all(source, "ledger_kinetic_of_body", s, n, 1, &all->growth, each) ||
        read_all(source, "ledger_scheme_of_body", s, n, 1, &all->scheme, each) ||
        read_all(source, "ledger_settling_of_body", s, n, 1, &all->settling, each) ||
        read_all(source, "ledger_drag_of_body", s, n, 1, &all->drag, each) ||
        read_all(source, "ledger_waves_of_body", s, n, 1, &all->waves, each) ||
        read_flags(source, "velocity_given_of_body", step, n, &all->velocity_given, each))
        return complain(log, "bodies");
    return 0;
}

/* ---- points ---- */

static double size(const double *v) { return hypot(hypot(v[0], v[1]), v[2]); }

double body_acting(const Source *source, const BodyData *data, const BodyState *at,
                   const BodyMotion *motion, double arm) {
    const double down = size(source->gravity);
    double per[3], given[SIX], most = 0;
    Real own[SIX];
    for (int a = 0; a < 3; a++) per[a] = down > 0 ? source->gravity[a] / down : 0;
    body_load(data, at->position, at->rotation, per, own);
    for (int i = 0; i < SIX; i++) given[i] = at->load[i] - (double)own[i];
    const double *all[] = {at->load, given, motion->inertia};
    for (int k = 0; k < 3; k++) most = fmax(most, fmax(size(all[k]), size(&all[k][3]) / arm));
    return most;
}

static Real dot(const Real *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static double size_of(const Real *v) { return (double)hypotl(hypotl(v[0], v[1]), v[2]); }

static void compare(const char *what, double said, double expected, double noise, MotionFind *find,
                    void *user) {
    if (!(fabs(said - expected) <= noise)) find(user, what, said, expected);
}

/* Take the part along n out of v; n may be 0. */
static void across(Real *v, const double *n) {
    const Real along = dot(v, n);
    for (int a = 0; a < 3; a++) v[a] -= along * n[a];
}

/* y* by the scheme. */
static Real star(Real back, Real y, Real older) { return back > 0 ? y + back * (y - older) : y; }

static void check_span(double span, const Formula *formula, MotionFind *find, void *user) {
    if (!(fabs(span - (double)formula->span) <= FORMULA_TIMES * span))
        find(user, "span of the scheme", span, (double)formula->span);
}

/* What bore before has forgotten its motion along the normal, and has that of the ground: its place
 * before that is h times the ground's velocity back, and both velocities are the ground's. */
static void check_past(const PointSteps *s, Real back, MotionFind *find, void *user) {
    const PointMotion *m = s->motion;
    const double noise = PLACES * s->reach;
    Real place = 0, velocity = 0;
    if (!s->was_stopped) return;
    for (int a = 0; a < 3; a++) {
        place += ((Real)m->reference[a] - s->before->position[a]) * s->before->normal[a];
        velocity += (Real)m->rest_velocity[a] * s->before->normal[a];
    }
    compare("reference off that of the ground, along the normal", (double)place,
            (double)back * s->h_before * s->rate_before, noise, find, user);
    compare("v* off the velocity of the ground, along the normal, times k",
            (double)velocity * m->span, s->rate_before * m->span, noise, find, user);
}

/* The reference and v* against the two steps before. */
static void check_point_scheme(const PointSteps *s, MotionFind *find, void *user) {
    const PointMotion *m = s->motion;
    const Real back = formula_of(m->span, s->h, s->h_before).back;
    const bool euler = !(back > 0), bore = s->was_stopped;
    if (!euler && !s->older) return;
    Real place[3], velocity[3];
    for (int a = 0; a < 3; a++) {
        place[a] = m->reference[a] -
                   star(back, s->before->position[a], s->older ? s->older->position[a] : 0);
        velocity[a] = m->rest_velocity[a] - star(back, s->motion_before->velocity[a],
                                                 s->older ? s->motion_older->velocity[a] : 0);
    }
    if (!euler) check_past(s, back, find, user);
    if (bore && !euler) across(place, s->before->normal);
    if (bore && !euler) across(velocity, s->before->normal);
    if (m->velocity_given && s->is_free) find(user, "given velocity of a point that is free", 1, 0);
    if (!m->velocity_given && !(size_of(place) <= PLACES * s->reach))
        find(user, "reference off that of the scheme", size_of(place), 0);
    if (!(size_of(velocity) * m->span <= PLACES * s->reach))
        find(user, "v* off that of the scheme, times k", size_of(velocity) * m->span, 0);
}

/* Of what is brought to rest, or of what moves, `had` before. */
static void check_rest(double said, double growth, double had, bool moves, MotionFind *find,
                       void *user) {
    compare("energy lost by coming to rest", said, moves ? 0 : had, 0, find, user);
    if (!moves) compare("growth of the kinetic energy", growth, -had, 0, find, user);
}

void point_motion_check(const PointSteps *s, MotionFind *find, void *user) {
    const PointMotion *m = s->motion;
    if (s->before)
        check_rest(m->settling, m->growth, s->motion_before->kinetic, m->span > 0, find, user);
    if (!(m->span > 0)) {
        if (m->span != 0 || size(m->velocity) + size(m->inertia) + m->kinetic != 0)
            find(user, "motion in a quasi-static step", size(m->velocity), 0);
        return;
    }
    const Formula formula = formula_of(m->span, s->h, s->h_before);
    check_span(m->span, &formula, find, user);
    const double noise = 4 * PLACES * s->reach * m->mass / (m->span * m->span) + 1e-300;
    const bool bears = s->is_stopped;
    Real v[3], off[3], work = 0, sizes = 0, rounding = 0;
    for (int a = 0; a < 3; a++) {
        v[a] = ((Real)s->now->position[a] - m->reference[a]) / m->span;
        off[a] = m->inertia[a] + m->mass * (v[a] - m->rest_velocity[a]) / m->span;
    }
    compare("inertia of the mass, off", size_of(off), 0, noise, find, user);
    for (int a = 0; a < 3; a++) off[a] = v[a] - m->velocity[a];
    if (bears) across(off, s->now->normal);
    compare("velocity off that of the places, times k", size_of(off) * m->span, 0,
            PLACES * s->reach, find, user);
    const double kinetic = 0.5 * m->mass * size(m->velocity) * size(m->velocity);
    compare("kinetic energy", m->kinetic, kinetic, ENERGIES * kinetic + 1e-300, find, user);
    if (bears) {
        Real along = 0;
        for (int a = 0; a < 3; a++) along += (Real)m->velocity[a] * s->now->normal[a];
        compare("velocity out of the ground, times k", ((double)along - s->rate) * m->span, 0,
                PLACES * s->reach, find, user);
    }
    if (!s->before) return;
    check_point_scheme(s, find, user);
    compare("growth of the kinetic energy", m->growth, kinetic - s->motion_before->kinetic,
            ENERGIES * (kinetic + s->motion_before->kinetic) + 1e-300, find, user);
    if (!(m->impact >= 0)) find(user, "energy lost by impact", m->impact, 0);
    if (!bears || s->was_stopped)
        compare("energy lost by impact of what does not land", m->impact, 0, 0, find, user);
    if (!s->is_free) return;
    for (int a = 0; a < 3; a++) {
        const Real way = (Real)s->now->position[a] - s->before->position[a];
        const Real force = (Real)s->now->lines[a] + s->now->load[a] - s->now->residual[a];
        const Real push =
            ((Real)s->now->friction[a] + (Real)s->now->reaction * s->now->normal[a]) * s->ground[a];
        work += force * way + push;
        sizes += fabsl(force * way) + fabsl(push);
        rounding += SUMS * s->largest * fabsl(way);
    }
    work += s->waves - s->afloat;
    sizes += fabsl(s->waves) + fabsl(s->afloat);
    rounding += SUMS * s->reach * s->buoyancy; /* of its height, in the energy of its buoyancy */
    compare("energy lost to the damping of what gives", m->damped, (double)s->soft.damped,
            ENERGIES * fabs(m->damped) + PLACES * s->reach * (double)s->soft.slope + 1e-300, find,
            user);
    /* the ways of point and ground, which may be one, are differences of places */
    if (size(s->ground) > 0)
        rounding +=
            ROUNDINGS * DBL_EPSILON * s->reach * (size(s->now->friction) + s->now->reaction);
    const double spent =
        s->now->dissipated + m->growth + m->impact + m->scheme + m->damped + (double)s->soft.stored;
    sizes += fabs(s->now->dissipated) + fabs(m->growth) + m->impact + fabs(m->scheme) +
             fabs(m->damped) + fabsl(s->soft.stored) +
             PLACES * s->reach * (size(s->now->lines) + size(s->now->load));
    rounding += ROUNDINGS * DBL_EPSILON * s->reach * s->soft.presses;
    compare("ledger, work of lines and load", (double)work, spent,
            ENERGIES * (double)sizes + (double)rounding, find, user);
}

/* ---- bodies ---- */

static void turn(Real m[3][3], const Real *v, bool back, Real *out) {
    for (int i = 0; i < 3; i++)
        out[i] = back ? m[0][i] * v[0] + m[1][i] * v[1] + m[2][i] * v[2]
                      : m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

static void cross(const Real *a, const Real *b, Real *out) {
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        out[i] = a[k] * b[l] - a[l] * b[k];
    }
}

static void widen(const double *a, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = a[k];
}

/* The rotation vector from q0 to q. */
static void vector_between(const double q0[FOUR], const double q[FOUR], Real t[3]) {
    const Real w =
        (Real)q[0] * q0[0] + (Real)q[1] * q0[1] + (Real)q[2] * q0[2] + (Real)q[3] * q0[3];
    Real a[3], b[3], both[3];
    widen(&q0[1], a);
    widen(&q[1], b);
    cross(a, b, both); /* q q0* has the vector part q0w b - qw a + a x b */
    for (int i = 0; i < 3; i++) t[i] = (Real)q0[0] * b[i] - (Real)q[0] * a[i] + both[i];
    const Real sine = hypotl(hypotl(t[0], t[1]), t[2]), sign = w < 0 ? -1 : 1,
               by = sine > 0 ? sign * 2 * atan2l(sine, sign * w) / sine : 2 * sign;
    for (int i = 0; i < 3; i++) t[i] *= by;
}

/* V(t) v: the mean of the rotations by s t, s = 0 .. 1. Simpson's rule errs by the fourth power of
 * the angle of an interval, which has to be rounding for turns of any size. */
static void mean_rotation(const Real t[3], const Real v[3], Real out[3]) {
    const Real angle = hypotl(hypotl(t[0], t[1]), t[2]);
    const int count = SIMPSON + 2 * (int)(SIMPSON_PER_RADIAN / 2 * angle);
    for (int i = 0; i < 3; i++) out[i] = 0;
    for (int k = 0; k <= count; k++) {
        const Real share = (Real)k / count, half = share * angle / 2,
                   weight = (k == 0 || k == count ? 1
                             : k % 2              ? 4
                                                  : 2) /
                            (3.0L * count);
        double q[FOUR] = {(double)cosl(half), 0, 0, 0};
        Real m[3][3], turned[3];
        for (int i = 0; i < 3; i++) q[1 + i] = angle > 0 ? (double)(sinl(half) * t[i] / angle) : 0;
        body_matrix(q, m);
        turn(m, v, false, turned);
        for (int i = 0; i < 3; i++) out[i] += weight * turned[i];
    }
}

/* Momenta at a step: of the mass about the centre of gravity, of the water about the reference
 * point; in the axes of the scene. */
typedef struct Momenta {
    Real mass[3], spin[3], water[3], water_spin[3];
} Momenta;

static Momenta momenta_of(const BodyMotion *m, const double rotation[FOUR]) {
    Momenta out;
    Real r[3][3], u[SIX], w[3], p[SIX] = {0};
    const double *j = m->moments, *o = m->products;
    body_matrix(rotation, r);
    widen(m->rate, w);
    turn(r, w, true, &u[3]);
    widen(m->velocity, w);
    turn(r, w, true, u);
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < SIX; k++) p[i] += m->added[SIX * i + k] * u[k];
    const Real l[3] = {j[0] * u[3] + o[0] * u[4] + o[1] * u[5],
                       o[0] * u[3] + j[1] * u[4] + o[2] * u[5],
                       o[1] * u[3] + o[2] * u[4] + j[2] * u[5]};
    for (int i = 0; i < 3; i++) out.mass[i] = (Real)m->mass * m->centre_velocity[i];
    turn(r, l, false, out.spin);
    turn(r, p, false, out.water);
    turn(r, &p[3], false, out.water_spin);
    return out;
}

static double kinetic_of(const BodyMotion *m, const Momenta *p) {
    Real sum = 0;
    for (int i = 0; i < 3; i++)
        sum += p->mass[i] * m->centre_velocity[i] + p->water[i] * m->velocity[i] +
               (p->spin[i] + p->water_spin[i]) * m->rate[i];
    return (double)sum / 2;
}

static void centre_of(const BodyData *data, const BodyState *at, Real out[3]) {
    body_place(at->position, at->rotation, data->centre_of_gravity, out);
}

/* A given velocity is that of a rigid body; the scene has its numbers (given_velocities.c). */
static void check_given(const BodySteps *s, MotionFind *find, void *user) {
    const BodyMotion *m = s->motion;
    Real centre[3], rate[3], around[3], off[3];
    if (s->now->kind != 0) find(user, "given velocity of a body that is free", 1, 0);
    centre_of(s->data, s->now, centre);
    widen(m->rate, rate);
    for (int i = 0; i < 3; i++) centre[i] -= s->now->position[i];
    cross(rate, centre, around);
    for (int i = 0; i < 3; i++) off[i] = m->centre_velocity[i] - m->velocity[i] - around[i];
    compare("velocity of the centre of gravity off that of the body, times k",
            size_of(off) * m->span, 0, 4 * PLACES * (s->reach + size(s->data->centre_of_gravity)),
            find, user);
}

/* Velocities against places and rotations. */
static void check_velocities(const BodySteps *s, Real back, MotionFind *find, void *user) {
    const bool euler = !(back > 0);
    const BodyMotion *m = s->motion;
    Real centre[3], before[3], older[3] = {0}, t[3], past[3] = {0}, rate[3], wanted[3], off[3][3];
    centre_of(s->data, s->now, centre);
    centre_of(s->data, s->before, before);
    if (!euler) centre_of(s->data, s->older, older);
    vector_between(s->before->rotation, s->now->rotation, t);
    if (!euler) vector_between(s->before->rotation, s->older->rotation, past);
    for (int i = 0; i < 3; i++) rate[i] = (t[i] - star(back, 0, past[i])) / m->span;
    mean_rotation(t, rate, wanted);
    for (int i = 0; i < 3; i++) {
        off[0][i] =
            m->velocity[i] - (s->now->position[i] - star(back, s->before->position[i],
                                                         euler ? 0 : s->older->position[i])) /
                                 m->span;
        off[1][i] = m->centre_velocity[i] - (centre[i] - star(back, before[i], older[i])) / m->span;
        off[2][i] = m->rate[i] - wanted[i];
    }
    const double places = 4 * PLACES * (s->reach + size(s->data->centre_of_gravity));
    compare("velocity off that of the places, times k", size_of(off[0]) * m->span, 0, places, find,
            user);
    compare("velocity of the centre of gravity off that of its places, times k",
            size_of(off[1]) * m->span, 0, places, find, user);
    compare("rate of rotation off that of the rotations, times k", size_of(off[2]) * m->span, 0,
            TURNS * 10, find, user);
}

static void check_inertia(const BodySteps *s, Real back, MotionFind *find, void *user) {
    const bool euler = !(back > 0);
    const BodyMotion *m = s->motion;
    const Momenta now = momenta_of(m, s->now->rotation),
                  before = momenta_of(s->motion_before, s->before->rotation),
                  older = euler ? before : momenta_of(s->motion_older, s->older->rotation);
    Real force[3], water[3], moment[3], arm[3], centre[3], u[3], along[3], off[2][3];
    double sizes[2] = {0, 0};
    centre_of(s->data, s->now, centre);
    widen(m->velocity, u);
    for (int i = 0; i < 3; i++) {
        arm[i] = centre[i] - s->now->position[i];
        force[i] = -(now.mass[i] - star(back, before.mass[i], older.mass[i])) / m->span;
        water[i] = -(now.water[i] - star(back, before.water[i], older.water[i])) / m->span;
        moment[i] = -(now.spin[i] - star(back, before.spin[i], older.spin[i]) + now.water_spin[i] -
                      star(back, before.water_spin[i], older.water_spin[i])) /
                    m->span;
        sizes[0] = fmax(sizes[0], (double)(fabsl(now.mass[i]) + fabsl(now.water[i]) +
                                           fabsl(before.mass[i]) + fabsl(before.water[i])));
        sizes[1] = fmax(sizes[1], (double)(fabsl(now.spin[i]) + fabsl(now.water_spin[i]) +
                                           fabsl(before.spin[i]) + fabsl(before.water_spin[i])));
    }
    cross(arm, force, along);
    for (int i = 0; i < 3; i++) moment[i] += along[i];
    cross(u, now.water, along);
    for (int i = 0; i < 3; i++) {
        off[0][i] = m->inertia[i] - (force[i] + water[i]);
        off[1][i] = m->inertia[3 + i] - (moment[i] - along[i]);
    }
    /* momenta are rounded as velocities are, which are places over k */
    const double mass = m->mass + fabs(m->added[0]) + fabs(m->added[7]) + fabs(m->added[14]),
                 spin = m->moments[0] + m->moments[1] + m->moments[2] + fabs(m->added[21]) +
                        fabs(m->added[28]) + fabs(m->added[35]),
                 length = size_of(arm), square = m->span * m->span,
                 places = 8 * PLACES * (s->reach + length);
    const double noise = FORCES * sizes[0] / m->span + places * mass / square;
    compare("force of inertia, off", size_of(off[0]), 0, noise, find, user);
    compare("moment of inertia, off", size_of(off[1]), 0,
            noise * length + FORCES * (sizes[1] / m->span + size(m->velocity) * sizes[0]) +
                20 * TURNS * spin / square + places * mass * length / square,
            find, user);
}

static void check_damping(const BodySteps *s, MotionFind *find, void *user) {
    const BodyMotion *m = s->motion;
    Real r[3][3], u[SIX], f[SIX], wide[3], out[SIX], off[2][3];
    double sizes[2] = {0, 0};
    body_matrix(s->now->rotation, r);
    widen(m->velocity, wide);
    turn(r, wide, true, u);
    widen(m->rate, wide);
    turn(r, wide, true, &u[3]);
    for (int i = 0; i < SIX; i++) {
        f[i] = 0;
        for (int k = 0; k < SIX; k++) {
            const Real linear = m->damping[SIX * i + k] * u[k],
                       square = m->quadratic[SIX * i + k] * (u[k] < 0 ? -u[k] * u[k] : u[k] * u[k]);
            f[i] -= linear + square;
            sizes[i / 3] += (double)(fabsl(linear) + fabsl(square));
        }
    }
    turn(r, f, false, out);
    turn(r, &f[3], false, &out[3]);
    for (int i = 0; i < 3; i++) {
        off[0][i] = m->damped[i] - out[i];
        off[1][i] = m->damped[3 + i] - out[3 + i];
    }
    compare("force of damping, off", size_of(off[0]), 0, FORCES * sizes[0] + 1e-300, find, user);
    compare("moment of damping, off", size_of(off[1]), 0, FORCES * sizes[1] + 1e-300, find, user);
}

void body_motion_check(const BodySteps *s, MotionFind *find, void *user) {
    const BodyMotion *m = s->motion;
    if (s->before)
        check_rest(m->settling, m->growth, s->motion_before->kinetic, m->span > 0, find, user);
    if (!(m->span > 0)) {
        if (m->span != 0 || size(m->velocity) + size(m->rate) + size(m->inertia) + m->kinetic != 0)
            find(user, "motion in a quasi-static step", size(m->velocity), 0);
        return;
    }
    const Formula formula = formula_of(m->span, s->h, s->h_before);
    check_span(m->span, &formula, find, user);
    check_damping(s, find, user);
    const Momenta now = momenta_of(m, s->now->rotation);
    const double kinetic = kinetic_of(m, &now);
    compare("kinetic energy", m->kinetic, kinetic, ENERGIES * kinetic + 1e-300, find, user);
    if (!s->before || (formula.back > 0 && !s->older)) return;
    if (m->velocity_given)
        check_given(s, find, user);
    else
        check_velocities(s, formula.back, find, user);
    check_inertia(s, formula.back, find, user);
    compare("growth of the kinetic energy", m->growth, kinetic - s->motion_before->kinetic,
            ENERGIES * (kinetic + s->motion_before->kinetic) + 1e-300, find, user);
    Real t[3], lost = 0, sizes = 0, rounding = 0;
    vector_between(s->before->rotation, s->now->rotation, t);
    for (int i = 0; i < 3; i++) {
        const Real way = (Real)s->now->position[i] - s->before->position[i];
        lost -= m->damped[i] * way + m->damped[3 + i] * t[i];
        sizes += fabsl(m->damped[i]) * fabsl(way) + fabsl(m->damped[3 + i]) * fabsl(t[i]);
        /* ways of a body at rest are differences of places and turns that are rounded */
        rounding += fabsl(m->damped[i]) * PLACES * s->reach + fabsl(m->damped[3 + i]) * TURNS;
    }
    compare("energy dissipated by damping", m->lost, (double)lost,
            ENERGIES * (double)sizes + (double)rounding + 1e-300, find, user);
}
