/* SPDX-License-Identifier: BSD-3-Clause */
/* Proofs that a body turns for ever (turning.h).
 *
 * Let the body turn about an axis v through the point at which all its lines end. That point stays,
 * and with it every line, and whatever friction does to them. Per radian the given moment does the
 * work v.M, and a force f at c, seen from that point at R a with a = c - s, the work v.(R a x f) =
 * (R a).(f x v). With A = F x v, at -s, and B = g x v, at d = W (c_W - s) - B (c_B - s), all forces
 * together do
 *
 *     -(R s).A + (R d).B >= -|A s' - B d'|,
 *
 * the sum of the singular values, which is attained: a matrix of two columns has a third singular
 * value of 0, so that no sign counts. For A s' - B d' it is the root of
 *
 *     |A|^2 |s|^2 + |B|^2 |d|^2 - 2 A.B s.d + 2 |A x B| |s x d|.
 *
 * So in every pose the work is at least v.M less that. Where the body cannot move in a direction,
 * what holds it there has a moment about v unless v is that direction, or acts at the point itself;
 * and v may have no part along an axis about which it cannot turn. */
#include "turning.h"

#include <math.h>
#include <stdio.h>

/* Numbers of the file in sums of a few terms; a unit vector. */
static const Real SUMS = 1e-9, UNIT = 1e-9;

typedef Real Triple[3];

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }
static void cross(const Real *a, const Real *b, Real *out) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* The one point of the body at which lines end, all of them without equilibrium. */
static bool find_eye(const Turning *of, Triple eye) {
    bool any = false;
    for (size_t i = 0; i < of->source->lines; i++)
        for (int e = 0; e < 2; e++) {
            const int point = of->line[i].end_point[e];
            if (point < 0 || of->bodies->of_point[point] != (int)of->body) continue;
            if (of->line[i].outcome != OUTCOME_UNBOUNDED) return false;
            for (int a = 0; a < 3; a++) {
                if (any && eye[a] != of->bodies->place[point][a]) return false;
                eye[a] = of->bodies->place[point][a];
            }
            any = true;
        }
    return any;
}

/* May something that is not known have a moment about v? */
static bool is_held_about(const BodyData *data, const Triple eye, const Triple v) {
    for (int i = 0; i < SIX; i++) {
        bool held = data->fixed[i];
        for (int k = 0; k < SIX; k++) {
            if (data->hydrostatics[SIX * i + k] == 0) continue;
            if (i >= 3 || k >= 3) return true;
            held = true;
        }
        if (!held) continue;
        if (i >= 3 && v[i - 3] != 0) return true;
        if (i < 3 && size(eye) > 0 && (v[(i + 1) % 3] != 0 || v[(i + 2) % 3] != 0)) return true;
    }
    return false;
}

const char *turning_fault(const Turning *of, char *sentence, size_t bytes) {
    const BodyData *data = &of->bodies->data[of->body];
    Triple v, s, m, f, g, d, a, b, across, area;
    Real sizes = 0, more = 0;
    for (int i = 0; i < 3; i++) {
        v[i] = of->at->proof[i];
        f[i] = of->given[i];
        m[i] = of->given[3 + i];
        g[i] = of->pull[i];
    }
    if (of->at->kind != BODY_FREE || of->at->has_place || of->other_moments || !find_eye(of, s))
        return "turned for ever, but it is held, or not at one point alone";
    if (!(fabsl(size(v) - 1) <= UNIT)) return "turned for ever about an axis of no unit length";
    if (is_held_about(data, s, v)) return "turned for ever, but it does not turn so";
    for (int i = 0; i < 3; i++) {
        const Real weight = data->centre_of_gravity[i] - s[i],
                   lift = data->centre_of_buoyancy[i] - s[i];
        d[i] = data->weight * weight - data->buoyancy * lift;
        sizes += (data->weight * fabsl(weight) + data->buoyancy * fabsl(lift)) * size(g);
    }
    cross(f, v, a);
    cross(g, v, b);
    cross(a, b, across);
    cross(s, d, area);
    more = dot(a, a) * dot(s, s) + dot(b, b) * dot(d, d) - 2 * dot(a, b) * dot(s, d) +
           2 * size(across) * size(area);
    sizes += size(m) + size(f) * size(s);
    const Real least = dot(v, m) - sqrtl(fmaxl(0, more)), said = of->at->proof_moment;
    if (least > 0 && fabsl(least - said) <= SUMS * sizes) return NULL;
    snprintf(sentence, bytes, "turned for ever by %.9g N m, recomputed %.9g N m", (double)said,
             (double)least);
    return sentence;
}
