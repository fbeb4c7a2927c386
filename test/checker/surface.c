/* SPDX-License-Identifier: BSD-3-Clause */
/* Geometry and friction sets of obstacles (surface.h).
 *
 * Ways: on a cylinder the helix, an angle about the axis and a shift along it; on a ball the great
 * circle, whose angle comes from the chord of the two normals. */
#include "surface.h"

#include <math.h>

#include "shape.h"

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }

static void cross(const Real *a, const Real *b, Real *out) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* from the plane's point, the axis or the centre */
static void arm(const Surface *s, const Real *x, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = x[k] - s->point[k];
    Real along = s->kind == SURFACE_CYLINDER ? dot(out, s->axis) : 0;
    for (int k = 0; k < 3; k++) out[k] -= along * s->axis[k];
}

void surface_free(Surface *s) {
    conic_free(s->set);
    ground_free(s->ground);
    mesh_free(s->mesh);
}

bool surface_is_round(const Surface *s) {
    return (s->kind == SURFACE_CYLINDER || s->kind == SURFACE_SPHERE) && !s->inside;
}

bool surface_is_cut(const Surface *s) {
    if (s->gives > 0) return false;
    return surface_is_round(s) || (shape_is(s) && (!s->inside || s->kind == SURFACE_TORUS));
}

bool surface_may_be_third(const Surface *s) {
    return s->kind == SURFACE_PLANE || s->kind == SURFACE_MESH;
}

bool surface_has_elements(const Surface *s) {
    return surface_is_cut(s) || (s->mesh && s->mesh->has_elements);
}

Surface surface_within(const Surface *s, Real depth) {
    Surface within = *s;
    within.radius += s->inside ? depth : -depth;
    return within;
}

Real surface_factor(const Surface *s, const Real *x) {
    return s->ground ? ground_factor(s->ground, x[0] - s->point[0], x[1] - s->point[1]) : 1;
}

bool surface_ends(const Surface *s, const Real *x, Real rounding) {
    const Ground *g = s->ground;
    if (!g || g->extends) return false;
    const Real a = x[0] - s->point[0], b = x[1] - s->point[1];
    return !(a >= g->x[0] - rounding && a <= g->x[g->columns - 1] + rounding &&
             b >= g->y[0] - rounding && b <= g->y[g->rows - 1] + rounding);
}

/* The normal of ground above or below which x is, and the distance to first order: the height times
 * the cosine of the slope. */
static Real above_ground(const Surface *s, const Real *x, Real *n) {
    Real slope[2];
    const Real height = x[2] - s->point[2] -
                        ground_height(s->ground, x[0] - s->point[0], x[1] - s->point[1], slope),
               cosine = 1 / sqrtl(1 + slope[0] * slope[0] + slope[1] * slope[1]);
    n[0] = -cosine * slope[0];
    n[1] = -cosine * slope[1];
    n[2] = cosine;
    return height * cosine;
}

/* x in the axes of a mesh, where it is now, and a normal out of them. */
static void into_mesh(const Surface *s, const Real *x, Real *inside) {
    Real second[3], from[3];
    cross(s->axis, s->side, second);
    for (int k = 0; k < 3; k++) from[k] = x[k] - s->point[k];
    inside[0] = dot(from, s->side);
    inside[1] = dot(from, second);
    inside[2] = dot(from, s->axis);
}

static void out_of_mesh(const Surface *s, const Real *m, Real *n) {
    Real second[3];
    cross(s->axis, s->side, second);
    for (int k = 0; k < 3; k++) n[k] = m[0] * s->side[k] + m[1] * second[k] + m[2] * s->axis[k];
}

/* [-] Of its radius: how far above a mesh a place may have other feet than the nearest. */
static const Real OTHER_FEET = 0.25L;

size_t surface_feet(const Surface *s, const Real *x, Real gap[MESH_FEET],
                    Real normal[MESH_FEET][3]) {
    MeshFoot foot[MESH_FEET];
    Real inside[3];
    if (!s->mesh || s->gives > 0) {
        gap[0] = surface_distance(s, x);
        surface_normal(s, x, normal[0]);
        return 1;
    }
    into_mesh(s, x, inside);
    const size_t count = mesh_feet(s->mesh, inside, (1 + OTHER_FEET) * s->radius, foot);
    for (size_t i = 0; i < count; i++) {
        gap[i] = foot[i].distance - s->radius;
        out_of_mesh(s, foot[i].normal, normal[i]);
    }
    return count;
}

Surface surface_seen(const Surface *s, const double *normal) {
    Surface seen = *s;
    seen.faces =
        s->mesh && !(s->gives > 0) && !(normal[0] == 0 && normal[1] == 0 && normal[2] == 0);
    for (int k = 0; k < 3; k++) seen.facing[k] = normal[k];
    return seen;
}

/* Height and normal of x above a mesh: of the nearest foot, or of that with the normal nearest to
 * `facing`. */
static Real above_mesh_from(const Surface *s, const Real *x, const Real *facing, Real *n) {
    Real inside[3], m[3];
    if (facing) {
        Real gap[MESH_FEET], normal[MESH_FEET][3];
        const size_t count = surface_feet(s, x, gap, normal);
        size_t best = 0;
        for (size_t i = 1; i < count; i++)
            if (dot(normal[i], facing) > dot(normal[best], facing)) best = i;
        for (int k = 0; k < 3; k++) n[k] = normal[best][k];
        return gap[best];
    }
    into_mesh(s, x, inside);
    const Real distance = mesh_distance(s->mesh, inside, m);
    out_of_mesh(s, m, n);
    return distance - s->radius;
}

static Real above_mesh(const Surface *s, const Real *x, Real *n) {
    return above_mesh_from(s, x, s->faces ? s->facing : NULL, n);
}

/* The feet of a way on a mesh as vectors, and the normals there. Does the surface turn towards the
 * line on it: do the normals at its ends come nearer to each other? */
static bool way_on_mesh(const Surface *s, const Real *from, const Real *to, Real *chord, Real *n0,
                        Real *n1) {
    const Real g1 = above_mesh(s, to, n1), g0 = above_mesh_from(s, from, s->faces ? n1 : NULL, n0);
    Real closing = 0;
    for (int k = 0; k < 3; k++) {
        chord[k] = (to[k] - g1 * n1[k]) - (from[k] - g0 * n0[k]);
        closing += chord[k] * (n1[k] - n0[k]);
    }
    return s->faces && closing < 0;
}

Real surface_distance(const Surface *s, const Real *x) {
    Real from[3];
    if (s->mesh) return above_mesh(s, x, from);
    if (shape_is(s)) return shape_distance(s, x, NULL);
    if (s->ground) return above_ground(s, x, from);
    arm(s, x, from);
    return s->kind == SURFACE_PLANE ? dot(from, s->axis) : size(from) - s->radius;
}

void surface_normal(const Surface *s, const Real *x, Real *n) {
    if (s->mesh) {
        above_mesh(s, x, n);
        return;
    }
    if (shape_is(s)) {
        shape_distance(s, x, n);
        return;
    }
    if (s->ground) {
        above_ground(s, x, n);
        return;
    }
    arm(s, x, n);
    Real length = size(n);
    for (int k = 0; k < 3; k++) n[k] = s->kind == SURFACE_PLANE ? s->axis[k] : n[k] / length;
}

Real surface_pierced(const Surface *s, const Real *a, const Real *b, Real l) {
    Real from[3], to[3], chord[3], moment[3];
    if (shape_is(s)) {
        Real at, x[3];
        if (!shape_facing(s, a, b, &at)) return -INFINITY;
        for (int k = 0; k < 3; k++) x[k] = (1 - at) * a[k] + at * b[k];
        return -shape_distance(s, x, NULL) - surface_allowance(s, l);
    }
    if (!surface_is_round(s)) return -INFINITY;
    arm(s, a, from);
    arm(s, b, to);
    for (int k = 0; k < 3; k++) chord[k] = to[k] - from[k];
    /* coming nearer at the start and going away at the end */
    if (!(dot(from, chord) < 0 && dot(to, chord) > 0)) return -INFINITY;
    cross(from, to, moment);
    return s->radius - surface_allowance(s, l) - size(moment) / size(chord);
}

Real surface_allowance(const Surface *s, Real l) {
    /* from inside a tube only its side towards the axis is convex */
    const Real r = s->inside ? s->main_radius - s->radius : s->radius;
    return fminl(l * l / r, r) / 4;
}

Real surface_facing(const Surface *s, const Real *a, const Real *b) {
    Real from[3], to[3], chord[3], share;
    if (shape_is(s)) return shape_facing(s, a, b, &share) ? share : -1;
    arm(s, a, from);
    arm(s, b, to);
    for (int k = 0; k < 3; k++) chord[k] = to[k] - from[k];
    return (dot(from, from) - dot(from, to)) / dot(chord, chord);
}

bool surface_moves(const Surface *s) { return size(s->by) != 0 || size(s->spin) != 0; }

void surface_spin(const Real *v, const Real *spin, Real *out) {
    const Real angle = size(spin), half = sinl(angle / 2), versine = 2 * half * half;
    Real unit[3] = {0, 0, 1}, around[3];
    if (angle > 0)
        for (int k = 0; k < 3; k++) unit[k] = spin[k] / angle;
    cross(unit, v, around);
    const Real along = dot(unit, v);
    /* 1 - cos without cancellation */
    for (int k = 0; k < 3; k++)
        out[k] = v[k] + sinl(angle) * around[k] - versine * (v[k] - along * unit[k]);
}

void surface_shift(const Surface *s, const Real *x, Real share, Real *out) {
    Real centre[3], arm[3], spin[3], turned[3];
    for (int k = 0; k < 3; k++) {
        centre[k] = s->about[k] + (1 - share) * s->by[k];
        arm[k] = x[k] - centre[k];
        spin[k] = share * s->spin[k];
    }
    surface_spin(arm, spin, turned);
    for (int k = 0; k < 3; k++) out[k] = x[k] + (turned[k] - arm[k]) + share * s->by[k];
}

void surface_unshift(const Surface *s, const Real *x, Real share, Real *out) {
    Real arm[3], spin[3], turned[3];
    for (int k = 0; k < 3; k++) { /* about where the point is in the end */
        arm[k] = x[k] - s->about[k] - s->by[k];
        spin[k] = -share * s->spin[k];
    }
    surface_spin(arm, spin, turned);
    for (int k = 0; k < 3; k++) out[k] = x[k] + (turned[k] - arm[k]) - share * s->by[k];
}

void surface_carry(const Surface *s, const Real *x, Real share, Real turn, Real *out) {
    Real here[3], v[3], spin[3], turned[3];
    surface_shift(s, x, share, here);
    for (int k = 0; k < 3; k++) {
        v[k] = here[k] - s->point[k];
        spin[k] = share * turn * s->axis[k];
    }
    surface_spin(v, spin, turned);
    for (int k = 0; k < 3; k++) out[k] = here[k] + (turned[k] - v[k]);
}

void surface_uncarry(const Surface *s, const Real *x, Real share, Real turn, Real *out) {
    Real v[3], spin[3], turned[3], here[3];
    for (int k = 0; k < 3; k++) {
        v[k] = x[k] - s->point[k];
        spin[k] = -share * turn * s->axis[k];
    }
    surface_spin(v, spin, turned);
    for (int k = 0; k < 3; k++) here[k] = x[k] + (turned[k] - v[k]);
    surface_unshift(s, here, share, out);
}

void surface_own(const Surface *s, const Real *x, const Real *reference, Real share, Real *out) {
    Real from[3], was[3];
    surface_shift(s, reference, share, from);
    surface_slip(s, from, x, out);
    surface_unshift(s, x, share, was);
    for (int k = 0; k < 3; k++) out[k] += x[k] - was[k];
}

/* From foot to foot in the plane that the chord and the normal at its end span: an arc whose ends
 * differ in direction by the angle between the normals is longer than its chord by half of that
 * angle over the sine of the half. */
static void slip_on_ground(const Surface *s, const Real *from, const Real *to, Real *out) {
    Real n0[3], n1[3], chord[3], less[3], sum[3];
    const Real g0 = above_ground(s, from, n0), g1 = above_ground(s, to, n1);
    for (int k = 0; k < 3; k++) {
        chord[k] = (to[k] - g1 * n1[k]) - (from[k] - g0 * n0[k]);
        less[k] = n1[k] - n0[k];
        sum[k] = n1[k] + n0[k];
    }
    const Real half = atan2l(size(less), size(sum)), rise = dot(chord, n1);
    for (int k = 0; k < 3; k++) out[k] = chord[k] - rise * n1[k];
    const Real flat = size(out), longer = half > 0 ? half / sinl(half) : 1;
    for (int k = 0; k < 3; k++) out[k] = flat > 0 ? out[k] * (longer * size(chord) / flat) : 0;
}

/* The chord from foot to foot, turned into the tangent plane at its end; where the surface turns
 * towards the line, the way in that plane. */
static void slip_on_mesh(const Surface *s, const Real *from, const Real *to, Real *out) {
    Real n0[3], n1[3], chord[3];
    const bool closes = way_on_mesh(s, from, to, chord, n0, n1);
    if (closes)
        for (int k = 0; k < 3; k++) chord[k] = to[k] - from[k];
    const Real rise = dot(chord, n1);
    for (int k = 0; k < 3; k++) out[k] = chord[k] - rise * n1[k];
    if (closes) return;
    const Real flat = size(out);
    for (int k = 0; k < 3; k++) out[k] = flat > 0 ? out[k] * (size(chord) / flat) : 0;
}

void surface_slip(const Surface *s, const Real *from, const Real *to, Real *out) {
    if (s->mesh) {
        slip_on_mesh(s, from, to, out);
        return;
    }
    if (s->ground) {
        slip_on_ground(s, from, to, out);
        return;
    }
    if (shape_is(s)) {
        shape_slip(s, from, to, out);
        return;
    }
    Real n0[3], n1[3], shift[3];
    surface_normal(s, from, n0);
    surface_normal(s, to, n1);
    for (int k = 0; k < 3; k++) shift[k] = to[k] - from[k];
    if (s->kind == SURFACE_PLANE) {
        Real rise = dot(shift, s->axis);
        for (int k = 0; k < 3; k++) out[k] = shift[k] - rise * s->axis[k];
    } else if (s->kind == SURFACE_CYLINDER) {
        Real turn[3], tangent[3];
        cross(n0, n1, turn);
        cross(s->axis, n1, tangent);
        Real angle = atan2l(dot(turn, s->axis), dot(n0, n1)), along = dot(shift, s->axis);
        for (int k = 0; k < 3; k++) out[k] = s->radius * angle * tangent[k] + along * s->axis[k];
    } else {
        Real chord[3], tangent[3];
        for (int k = 0; k < 3; k++) chord[k] = n1[k] - n0[k];
        Real normal = dot(chord, n1), angle = 2 * asinl(fminl(1, size(chord) / 2));
        for (int k = 0; k < 3; k++) tangent[k] = chord[k] - normal * n1[k];
        Real length = size(tangent);
        for (int k = 0; k < 3; k++)
            out[k] = length > 0 ? s->radius * angle * tangent[k] / length : 0;
    }
}

Real surface_angle(const Surface *s, const Real *a, const Real *b) {
    Real n[3], m[3], less[3], sum[3];
    if (s->kind == SURFACE_PLANE) return 0;
    if (s->mesh) {
        if (way_on_mesh(s, a, b, less, n, m)) return 0;
    } else {
        surface_normal(s, a, n);
        surface_normal(s, b, m);
    }
    for (int k = 0; k < 3; k++) {
        less[k] = n[k] - m[k];
        sum[k] = n[k] + m[k];
    }
    return 2 * atan2l(size(less), size(sum));
}

bool surface_axes(const Surface *s, const Real *n, const Real *along, Real axes[2][3]) {
    const Real *wanted = s->grained ? s->grain : along;
    Real rise = dot(wanted, n);
    for (int k = 0; k < 3; k++) axes[0][k] = wanted[k] - rise * n[k];
    Real length = size(axes[0]);
    if (!(length > 1e-9L * size(wanted)))
        return false; // what rounding leaves of a direction along the normal
    for (int k = 0; k < 3; k++) axes[0][k] /= length;
    cross(n, axes[0], axes[1]);
    return true;
}

Real surface_friction(const Surface *s) { return s->set ? 1 : fmaxl(s->mu[0], s->mu[1]); }

bool surface_follows(const Surface *s) {
    return s->kind != SURFACE_PLANE || s->set || s->box || s->mu[0] != s->mu[1];
}

/* half-axes of the set for a bound of 1 */
static void half_axes(const Surface *s, Real ratio[2]) {
    for (int a = 0; a < 2; a++)
        ratio[a] = surface_friction(s) > 0 ? s->mu[a] / surface_friction(s) : 1;
}

Real surface_excess(const Surface *s, Real w, const Real F[2]) {
    Real ratio[2], gauge[2], flat = 0;
    if (s->set)
        return w > 0 ? w * conic_distance(s->set, (Real[2]){F[0] / w, F[1] / w})
                     : hypotl(F[0], F[1]);
    half_axes(s, ratio);
    for (int a = 0; a < 2; a++) {
        gauge[a] = ratio[a] > 0 ? fabsl(F[a]) / ratio[a] : 0;
        if (!(ratio[a] > 0)) flat = fmaxl(flat, fabsl(F[a]));
    }
    /* along the ray through F: |F| (1 - w/gauge) is too much */
    Real worst = s->box ? fmaxl(gauge[0], gauge[1]) : hypotl(gauge[0], gauge[1]);
    Real beyond = worst > 0 ? hypotl(F[0], F[1]) * (1 - w / worst) : -w;
    return fmaxl(beyond, flat);
}

/* (w - |f|)|u| + |f||u| + f.u >= 0, the second part from the angle between f and -u; absolute
 * values, so that a force outside its set makes it larger */
static Real disc_gap(Real w, const Real f[2], const Real u[2]) {
    Real force = hypotl(f[0], f[1]), slip = hypotl(u[0], u[1]);
    if (force == 0 || slip == 0) return fabsl(w - force) * slip;
    Real x = f[0] / force + u[0] / slip, y = f[1] / force + u[1] / slip;
    return fabsl(w - force) * slip + force * slip * (x * x + y * y) / 2;
}

Real surface_gap(const Surface *s, Real w, const Real F[2], const Real slip[2], Real *phi) {
    Real ratio[2], f[2], u[2], gap = 0;
    if (s->set) { // phi is max -F.s
        Real size = hypotl(slip[0], slip[1]);
        *phi = w > 0 && size > 0
                   ? w * size * conic_support(s->set, (Real[2]){-slip[0] / size, -slip[1] / size})
                   : 0;
        return fabsl(*phi + F[0] * slip[0] + F[1] * slip[1]);
    }
    half_axes(s, ratio);
    for (int a = 0; a < 2; a++) {
        f[a] = ratio[a] > 0 ? F[a] / ratio[a] : 0;
        u[a] = ratio[a] * slip[a];
        if (!(ratio[a] > 0)) gap += fabsl(F[a] * slip[a]);
    }
    *phi = w * (s->box ? fabsl(u[0]) + fabsl(u[1]) : hypotl(u[0], u[1]));
    if (!s->box) return gap + disc_gap(w, f, u);
    for (int a = 0; a < 2; a++) gap += disc_gap(w, (Real[2]){f[a], 0}, (Real[2]){u[a], 0});
    return gap;
}

/* By how much a disc that contains the forces of a box is larger than its longer half-axis. */
Real surface_disc_factor(const Surface *on) {
    const Real most = fmaxl(on->mu[0], on->mu[1]);
    return on->box && most > 0 ? hypotl(on->mu[0], on->mu[1]) / most : 1;
}

/* The part of v in the surface's tangent plane; returns its part along the normal. */
Real surface_split(const Surface *on, const Real *v, Real *across) {
    Real n[3];
    surface_normal(on, v, n);
    const Real rise = n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
    for (int a = 0; a < 3; a++) across[a] = v[a] - rise * n[a];
    return rise;
}
