/* SPDX-License-Identifier: BSD-3-Clause */
/* Sliding without end (endless_slide.h; docs/theory.md section 5).
 *
 * No equilibrium at a configuration.  Let a velocity v of the nodes satisfy, with t_i the direction
 * of element i,
 *
 *     t_i.(v_i - v_{i-1}) <= 0  for every element,      n.v_j >= phi_j(v_j)  at every contact
 *         (a)
 *
 * where phi_j(v) = max -<f, v> over the friction forces f per unit normal force. For any tensions T
 * >= 0 and contact forces R (n + f) in balance with the loads, the power of the loads is
 *
 *     sum b_j.v_j = sum T_i t_i.(v_i - v_{i-1}) - sum R_j (n + f_j).v_j <= - sum R_j (n.v_j -
 *         phi_j(v_j)) <= 0,
 *
 * so sum b.v > 0 proves that nothing balances them there, whatever the reactions are.
 *
 * Along itself. v_j = alpha_j (tau_j + phi_j(tau_j) n_j) with tau_j the line's own direction on the
 * obstacle: slip at its limit. Equality in (a) for the elements gives alpha from node to node; on a
 * polygonal line with turns d round a drum it decreases by (1 - mu tan(d/2))/(1 + mu tan(d/2)), the
 * capstan's exp(-mu theta) in the limit.
 *
 * Without end. When k elements have passed, the line from its trailing end at node k on lies at the
 * same positions, and its leading end has moved straight on by their length s_k. Nothing of (a)
 * changes for the rest, so the power that must be positive is, for every k,
 *
 *     P_k = f_trailing.v_k + sum over the line beyond k of w.v + s_k w.t t.v_last +
 *         f_leading.v_last. */
#include "cable/endless_slide.h"

#include <math.h>

#include "cable/end_set.h"
#include "cable/friction_law.h"
#include "cable/held.h"
#include "chain/frame.h"

/* A node this near to an obstacle, per length of the line, counts as touching; the proof remains
 * valid with one contact more than there is. */
static const double TOUCHING = 1e-6;
/* An element whose penetration exceeds this share of its allowance rests on the obstacle; chords of
 * a line on the surface penetrate by half the allowance. */
static const double NEARLY = 0.9;

/* The line with its nodes numbered in the direction in which it slides: node 0 trails, node n - 1
 * leads. */
typedef struct OrientedLine {
    CpsiLine *line;
    bool to_a;     /* towards end A */
    double factor; /* the largest factor of a zone: zones move with the line */
} OrientedLine;

static int node(const OrientedLine *a, int i) { return a->to_a ? a->line->n - 1 - i : i; }
static Vec3 place(const OrientedLine *a, int i) {
    return vec3_load(&a->line->reference[3 * node(a, i)]);
}
static double length(const OrientedLine *a, int i) {
    return a->line->element_length[a->to_a ? a->line->n - 1 - i : i - 1];
}
static Vec3 motion(const OrientedLine *a, int i) {
    return vec3_load(&a->line->motion[3 * node(a, i)]);
}
static Vec3 unit(Vec3 v) { return vec3_scale(1 / vec3_norm(v), v); }
/* Direction of element i, from node i - 1 to node i. */
static Vec3 direction(const OrientedLine *a, int i) {
    return unit(vec3_sub(place(a, i), place(a, i - 1)));
}

/* phi per unit normal force of contact c for the tangential velocity v. */
static double friction_of(const OrientedLine *a, int c, Vec3 v) {
    double along[3], slip[3];
    const CpsiFrictionLaw *law = &a->line->friction_law[c];
    const CpsiObstacle *obstacle = cpsi_line_obstacle(a->line, c);
    vec3_store(along, v);
    cpsi_frame_to(slip, cpsi_line_axes(a->line, c), along);
    return cpsi_friction_law_dissipation(
        law, a->factor * (law->given ? 1 : fmax(obstacle->friction[0], obstacle->friction[1])),
        slip);
}

/* The velocity of node i for slip at the friction limit with tangential speed 1. False at a node in
 * a corner. */
static bool slip(const OrientedLine *a, int i, Vec3 *out) {
    const int n = a->line->n;
    const Vec3 before = i > 0 ? direction(a, i) : vec3(0, 0, 0),
               after = i + 1 < n ? direction(a, i + 1) : vec3(0, 0, 0);
    Vec3 tangent = vec3_add(before, after), normal = vec3(0, 0, 0);
    int touched = -1;
    for (int c = node(a, i); c < cpsi_line_contacts(a->line); c += n) {
        const CpsiObstacle *obstacle = cpsi_line_obstacle(a->line, c);
        if (!obstacle || !(cpsi_obstacle_gap(obstacle, place(a, i)) <= TOUCHING * a->line->length))
            continue;
        if (touched >= 0) return false;
        touched = c;
        normal = cpsi_obstacle_normal(obstacle, place(a, i));
    }
    tangent = unit(vec3_reject(tangent, normal));
    *out = touched < 0 ? tangent : vec3_axpy(friction_of(a, touched, tangent), normal, tangent);
    return isfinite(vec3_norm(*out));
}

/* Velocities with equality in (a), scaled so that the fastest node has speed 1. False where the
 * line cannot slide over its own bends. */
static bool fill_motion(const OrientedLine *a) {
    Vec3 before;
    double speed = 1, most = 0;
    if (!slip(a, 0, &before)) return false;
    for (int i = 0; i < a->line->n; i++) {
        Vec3 here;
        if (!slip(a, i, &here)) return false;
        if (i > 0) {
            const double pulled = vec3_dot(direction(a, i), here),
                         pulls = vec3_dot(direction(a, i), before);
            if (!(pulled > 0 && pulls > 0)) return false;
            speed *= pulls / pulled;
        }
        vec3_store(&a->line->motion[3 * node(a, i)], vec3_scale(speed, here));
        most = fmax(most, speed * vec3_norm(here));
        before = here;
    }
    for (int i = 0; i < 3 * a->line->n; i++) a->line->motion[i] /= most;
    return isfinite(most);
}

/* Does the straight path of the leading end stay clear of obstacle o, for the length of the line?
 * The distance from a plane, cylinder or ball is convex along it; of the rest nothing is said. */
static bool is_clear(const CpsiObstacle *o, Vec3 x, Vec3 t, double reach) {
    double nearest = reach;
    if (o->kind != CPS_OBSTACLE_PLANE && !cpsi_obstacle_is_round(o)) return false;
    if (cpsi_obstacle_gap(o, x) <= TOUCHING * reach)
        return vec3_dot(cpsi_obstacle_normal(o, x), t) > TOUCHING;
    if (o->kind !=
        CPS_OBSTACLE_PLANE) { /* the point of the path nearest to the axis or the centre */
        const Vec3 arm = vec3_sub(o->frame.point, x), axis = o->frame.axis[2];
        const Vec3 slip = o->kind == CPS_OBSTACLE_CYLINDER ? vec3_reject(t, axis) : t;
        const double square = vec3_dot(slip, slip);
        nearest = square > 0 ? fmin(reach, fmax(0, vec3_dot(arm, slip) / square)) : 0;
    }
    return cpsi_obstacle_gap(o, vec3_axpy(nearest, t, x)) > TOUCHING * reach;
}

static bool leading_path_is_clear(const OrientedLine *a) {
    const Vec3 x = place(a, a->line->n - 1), t = direction(a, a->line->n - 1);
    for (int k = 0; k < a->line->obstacle_count; k++)
        if (!is_clear(&a->line->obstacle[k], x, t, a->line->length)) return false;
    return true;
}

/* The least of all P_k; 0 where one of them does not exceed `margin` times the sum of the sizes of
 * its terms. */
static double least_power(const OrientedLine *a, double margin) {
    const int n = a->line->n;
    const Vec3 weight = vec3_load(a->line->weight), t = direction(a, n - 1),
               last = motion(a, n - 1);
    const CpsEnd *trailing = &a->line->end[a->to_a ? CPS_END_B : CPS_END_A],
                 *leading = &a->line->end[a->to_a ? CPS_END_A : CPS_END_B];
    const double lead = vec3_dot(vec3_load(leading->value), last),
                 gain = vec3_dot(weight, t) * vec3_dot(t, last);
    double beyond = 0, sizes = 0, gone = a->line->length, least = INFINITY;
    for (int i = n - 1; i >= 0;
         i--) { /* beyond: the power of the weight of the elements after node i */
        const double power = vec3_dot(weight, motion(a, i));
        if (i + 1 < n) {
            const double half = 0.5 * length(a, i + 1), next = vec3_dot(weight, motion(a, i + 1));
            beyond += half * (power + next);
            sizes += half * (fabs(power) + fabs(next));
            gone -= 2 * half;
        }
        const double trail = vec3_dot(vec3_load(trailing->value), motion(a, i)),
                     on = i > 0 ? gone * gain : 0;
        const double sum = trail + beyond + on + lead;
        if (!(sum > margin * (fabs(trail) + sizes + fabs(on) + fabs(lead)))) return 0;
        least = fmin(least, sum);
    }
    return least;
}

/* Does an element rest, or nearly rest, on a round obstacle between its nodes? Its contact is not
 * part of (a), and nothing can be proved then. */
static bool has_resting_element(const CpsiLine *line) {
    for (int e = 0; e + 1 < line->n; e++)
        for (int k = 0; k < line->obstacle_count; k++) {
            const CpsiObstacle *o = &line->obstacle[k];
            const Vec3 from = vec3_at(line->reference, e), to = vec3_at(line->reference, e + 1);
            double share;
            if (!cpsi_obstacle_faces(o, from, to, &share)) continue;
            const double allowance = cpsi_obstacle_allowance(o, line->natural_length[e]);
            if (cpsi_obstacle_gap(o, vec3_axpy(share, vec3_sub(to, from), from)) <
                -NEARLY * allowance)
                return true;
        }
    return false;
}

static bool slides_towards(CpsiLine *line, bool to_a, double margin) {
    OrientedLine a = {.line = line, .to_a = to_a, .factor = line->friction_factor ? 0 : 1};
    if (line->friction_factor)
        for (int j = 0; j < line->n; j++) a.factor = fmax(a.factor, line->friction_factor[j]);
    const double power = fill_motion(&a) && leading_path_is_clear(&a) ? least_power(&a, margin) : 0;
    if (power > 0) {
        line->report.proof_force = power;
        vec3_store(line->report.proof, motion(&a, line->n - 1));
        return true;
    }
    for (int i = 0; i < 3 * line->n; i++) line->motion[i] = 0;
    return false;
}

bool cpsi_line_slides_endlessly(CpsiLine *line, double margin) {
    if (!cpsi_line_is_loose(line) || line->grasp_count > 0 || cpsi_line_has_sets(line))
        return false;
    /* sections move along with the line, so that its weight beyond a place changes */
    if (line->has_sections) return false;
    if (line->element_contacts > 0 && has_resting_element(line)) return false;
    return slides_towards(line, false, margin) || slides_towards(line, true, margin);
}
