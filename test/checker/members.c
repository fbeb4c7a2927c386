/* SPDX-License-Identifier: BSD-3-Clause */
/* The water on members (members.h), in long double.
 *
 * Here a strip is a pair of places in the axes of the scene, and what of it is wet is found by the
 * depths of both below the surface. The part of a vector along the member is taken out by its
 * product with the difference of these places. The added mass is the second derivative of the
 * kinetic energy of the water, integrated along the wet piece by Simpson's rule. */
#include "members.h"

#include <math.h>

#include "sea.h"

static const Real TAU = 6.283185307179586476925286766559L;

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void cross(const Real *a, const Real *b, Real *out) {
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        out[i] = a[k] * b[l] - a[l] * b[k];
    }
}

/* A place of the body, relative to its reference point, in the axes of the scene. */
static void turned(Real m[3][3], const Real *x, Real *out) {
    for (int i = 0; i < 3; i++) out[i] = m[i][0] * x[0] + m[i][1] * x[1] + m[i][2] * x[2];
}

/* ---- the water ---- */

static Real grown_at(const CpsWaves *waves, Real time) {
    return time < waves->ramp ? (1 - cosl(TAU / 2 * time / waves->ramp)) / 2 : 1;
}

/* z of the surface above x; infinite without one. */
static Real surface_at(const CpsScene *scene, const Real *x, Real time) {
    const CpsWaves *waves = scene->current->waves;
    Real z = scene->water_surface;
    if (!scene->has_water_surface) return INFINITY;
    if (!waves || time < 0) return z;
    for (int i = 0; i < waves->wave_count; i++) {
        const CpsWave *of = &waves->wave[i];
        const Real w = TAU / of->period, k = sea_number(w, -(Real)scene->gravity[2], waves->depth),
                   way = x[0] * cosl(of->direction) + x[1] * sinl(of->direction);
        z += grown_at(waves, time) * of->amplitude * cosl(k * way - w * time + of->phase);
    }
    return z;
}

/* Velocity and acceleration at x. */
static void water_at(const CpsScene *scene, const Real *x, Real time, Real *u, Real *a) {
    const CpsCurrent *current = scene->current;
    const CpsCurrentRow *row = current->row;
    int k = current->row_count - 1;
    while (k > 0 && row[k].z > x[2]) k--;
    const bool inside = k + 1 < current->row_count && x[2] > row[k].z;
    const Real share = inside ? (x[2] - row[k].z) / ((Real)row[k + 1].z - row[k].z) : 0;
    for (int i = 0; i < 3; i++) {
        u[i] = row[k].velocity[i];
        if (inside) u[i] += share * ((Real)row[k + 1].velocity[i] - row[k].velocity[i]);
        a[i] = 0;
    }
    if (time < 0) return;
    if (current->function) {
        const double place[3] = {(double)x[0], (double)x[1], (double)x[2]};
        double velocity[3] = {0, 0, 0}, acceleration[3] = {0, 0, 0};
        current->function(current->user, (double)time, place, velocity, acceleration);
        for (int i = 0; i < 3; i++) {
            u[i] += velocity[i];
            a[i] += acceleration[i];
        }
    }
    const CpsWaves *waves = current->waves;
    const int count = waves ? waves->wave_count : 0;
    for (int i = 0; i < count; i++) {
        const CpsWave *of = &waves->wave[i];
        const Real w = TAU / of->period;
        Wave wave = {.amplitude = of->amplitude,
                     .frequency = w,
                     .number = sea_number(w, -(Real)scene->gravity[2], waves->depth),
                     .heading = {cosl(of->direction), sinl(of->direction)},
                     .phase = of->phase};
        const Sea sea = {.waves = 1,
                         .wave = &wave,
                         .surface = scene->water_surface,
                         .depth = waves->depth,
                         .ramp = waves->ramp};
        sea_motion(&sea, time, x, u, a);
    }
}

/* ---- loads ---- */

static void add(Real out[SIX], const Real *force, const Real *arm, double sizes[2]) {
    Real moment[3];
    cross(arm, force, moment);
    for (int i = 0; i < 3; i++) {
        out[i] += force[i];
        out[3 + i] += moment[i];
    }
    const Real size = sqrtl(dot(force, force));
    sizes[0] += (double)size;
    sizes[1] += (double)(size * sqrtl(dot(arm, arm)));
}

/* The strip between two places relative to the reference point. */
static void add_strip(const CpsScene *scene, const CpsMember *member, const MemberBody *at,
                      Real end[2][3], MemberLoad *out) {
    Real depth[2], x[2][3], along[3], arm[3], place[3], u[3], a[3], spin[3], rate[3];
    for (int e = 0; e < 2; e++) {
        for (int i = 0; i < 3; i++) x[e][i] = at->position[i] + end[e][i];
        depth[e] = surface_at(scene, x[e], at->time) - x[e][2];
    }
    if (depth[0] < 0 && depth[1] < 0) return;
    /* the shares of the strip at which what is wet begins and ends */
    Real begin = 0, stop = 1;
    if (depth[0] < 0) begin = depth[0] / (depth[0] - depth[1]);
    if (depth[1] < 0) stop = depth[0] / (depth[0] - depth[1]);
    const Real middle = (begin + stop) / 2;
    for (int i = 0; i < 3; i++) {
        along[i] = end[1][i] - end[0][i];
        arm[i] = end[0][i] + middle * along[i];
        place[i] = at->position[i] + arm[i];
        rate[i] = at->rate[i];
    }
    const Real length = sqrtl(dot(along, along)), wet = (stop - begin) * length;
    water_at(scene, place, at->time, u, a);
    cross(rate, arm, spin);
    for (int i = 0; i < 3; i++) u[i] -= at->velocity[i] + spin[i];
    /* across and along */
    const Real forward = dot(u, along) / length, pushed = dot(a, along) / length;
    Real side = 0, force[2][3];
    for (int i = 0; i < 3; i++) {
        u[i] -= forward * along[i] / length;
        a[i] -= pushed * along[i] / length;
        side += u[i] * u[i];
    }
    const Real d = member->diameter, rho = scene->current->density;
    for (int i = 0; i < 3; i++) {
        force[0][i] = wet * rho * d / 2 *
                      (member->normal * sqrtl(side) * u[i] +
                       TAU / 2 * member->tangential * fabsl(forward) * forward * along[i] / length);
        force[1][i] = wet * rho * d * d * TAU / 8 * (1 + (Real)member->added_normal) * a[i];
    }
    add(out->drag, force[0], arm, out->sizes);
    add(out->waves, force[1], arm, out->sizes);
}

MemberLoad members_load(const CpsScene *scene, int index, const MemberBody *at) {
    const CpsBody *body = &scene->body[index];
    MemberLoad out = {.sizes = {0, 0}};
    Real m[3][3];
    body_matrix(at->rotation, m);
    if (!scene->current) return out;
    for (int k = 0; k < body->member_count; k++) {
        const CpsMember *member = &body->member[k];
        const int strips = member->strip_count > 0 ? member->strip_count : CPS_MEMBER_STRIPS;
        for (int s = 0; s < strips; s++) {
            Real own[3], end[2][3];
            for (int e = 0; e < 2; e++) {
                for (int i = 0; i < 3; i++)
                    own[i] = member->from[i] +
                             ((Real)member->to[i] - member->from[i]) * (s + e) / strips;
                turned(m, own, end[e]);
            }
            add_strip(scene, member, at, end, &out);
        }
    }
    return out;
}

/* ---- added mass ---- */

/* v_n of the place r of a body by its motion `of` alone. */
static void moved(int of, const Real *r, const Real *axis, Real *v) {
    Real unit[3] = {0, 0, 0};
    unit[of % 3] = 1;
    if (of < 3)
        for (int i = 0; i < 3; i++) v[i] = unit[i];
    else
        cross(unit, r, v);
    const Real along = dot(v, axis);
    for (int i = 0; i < 3; i++) v[i] -= along * axis[i];
}

void members_added(const CpsScene *scene, int index, double added[SIX * SIX]) {
    const CpsBody *body = &scene->body[index];
    Real m[3][3];
    body_matrix(body->rotation, m);
    for (int i = 0; i < SIX * SIX; i++) added[i] = body->added_mass[i];
    if (!scene->current) return;
    for (int k = 0; k < body->member_count; k++) {
        const CpsMember *member = &body->member[k];
        Real axis[3], z[2], low = 0, high = 1;
        for (int i = 0; i < 3; i++) axis[i] = (Real)member->to[i] - member->from[i];
        const Real length = sqrtl(dot(axis, axis));
        for (int e = 0; e < 2; e++) {
            Real own[3], out[3];
            for (int i = 0; i < 3; i++) own[i] = e ? member->to[i] : member->from[i];
            turned(m, own, out);
            z[e] = body->position[2] + out[2] - scene->water_surface;
        }
        if (scene->has_water_surface && z[0] > 0 && z[1] > 0) continue;
        if (scene->has_water_surface && z[0] > 0) low = z[0] / (z[0] - z[1]);
        if (scene->has_water_surface && z[1] > 0) high = z[0] / (z[0] - z[1]);
        for (int i = 0; i < 3; i++) axis[i] /= length;
        const Real whole = scene->current->density * TAU / 8 * member->diameter * member->diameter *
                           member->added_normal * length * (high - low);
        for (int p = 0; p < 3; p++) {
            const Real s = (low + (high - low) * p / 2) * length, weight = (p == 1 ? 4 : 1) / 6.0L;
            Real r[3], v[SIX][3];
            for (int i = 0; i < 3; i++) r[i] = member->from[i] + s * axis[i];
            for (int j = 0; j < SIX; j++) moved(j, r, axis, v[j]);
            for (int i = 0; i < SIX * SIX; i++)
                added[i] += (double)(weight * whole * dot(v[i / SIX], v[i % SIX]));
        }
    }
}
