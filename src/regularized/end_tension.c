/* SPDX-License-Identifier: BSD-3-Clause */
/* The tension of a regularised solution at an end, defined as the reported tension of an exact step
 * (src/cable/report.c): the force of the last element, with the weight, the reaction and the
 * friction of its half next to the end. The friction is the neighbouring node's per length, with
 * the end's own zone factor. */
#include <math.h>

#include "regularized/band_blocks.h"
#include "regularized/handle.h"

/* An end at most this far from the obstacle, per length of the line, lies on it. */
static const double TOUCH = 1e-9;

/* Friction on place j. */
static Vec3 friction_force(const CpsRegularized *regularized, int j) {
    const CpsiCells *c = &regularized->cells;
    const double delta = regularized->f.parameters.delta;
    const Vec3 u = vec3_sub(vec3_at(regularized->f.place, j), vec3_at(c->reference, j)),
               n = vec3_at(c->normal, j);
    const Vec3 slip = vec3_reject(u, n);
    return vec3_scale(-c->bound[j] / sqrt(delta * delta + vec3_dot(slip, slip)), slip);
}

/* The height of the held place j above the plane, from that of its neighbour. */
static double height(const CpsiCells *c, const double *place, int j, int next) {
    return c->gap[next] + vec3_dot(vec3_at(c->normal, next),
                                   vec3_sub(vec3_at(place, j), vec3_at(c->reference, next)));
}

/* The force of the support on the held place j [N]. *up is its component along the normal where j
 * lies on the obstacle and is pressed against it, else 0. */
static Vec3 support(const CpsRegularized *regularized, int j, double *up) {
    const CpsiCells *c = &regularized->cells;
    const int next = j == 0 ? 1 : j - 1;
    const double *place = regularized->f.place;
    const Vec3 dx = vec3_sub(vec3_at(place, next), vec3_at(place, j));
    const double size = vec3_norm(dx), tension = regularized->tension[j == 0 ? 0 : j - 1];
    const Vec3 pull = vec3_scale(size > 0 ? tension / size : 0, dx);
    const Vec3 force = vec3_scale(-1, vec3_add(pull, vec3_at(c->load, j)));
    const double across = vec3_dot(force, vec3_at(c->normal, next));
    *up = across > 0 && height(c, place, j, next) <= TOUCH * regularized->step.length ? across : 0;
    return force;
}

double cpsi_end_push(const CpsRegularized *regularized, int end) {
    double up;
    support(regularized, end == CPS_END_A ? 0 : regularized->cells.cells, &up);
    return up;
}

double cpsi_end_tension(const CpsRegularized *regularized, int end) {
    const CpsiCells *c = &regularized->cells;
    if (end == CPS_END_B && !regularized->step.held)
        return vec3_norm(vec3_load(regularized->step.end_force));
    const int j = end == CPS_END_A ? 0 : c->cells, next = end == CPS_END_A ? 1 : j - 1;
    double up;
    const Vec3 force = support(regularized, j, &up);
    if (!(up > 0)) return vec3_norm(force);
    const Vec3 half = vec3_scale(cpsi_zone_ratio(c, j, next) * c->share[j] / c->share[next],
                                 friction_force(regularized, next));
    return vec3_norm(vec3_sub(vec3_axpy(-up, vec3_at(c->normal, next), force), half));
}
