/* SPDX-License-Identifier: BSD-3-Clause */
/* The certificate of one step (docs/theory.md, "Certificate").
 *
 * With positions x that keep clear of the obstacle and forces (p, F, R) that balance, |F_j| <= w_j,
 * R_j >= 0, P - D is the sum of
 *
 *     segment    l [W(e) + W*(p) - p.e] = l [ (c/2) (T_x - |p|)^2 + (|p||e| - p.e) ]
 *         |e| >= 1, T_x = (|e| - 1)/c
 *                                       = l [ |p| (1 - |e|) + (c/2) |p|^2 + (|p||e| - p.e) ]
 *                                           |e| < 1
 *                with springs (base/element_law.h) W and W* are sums over them
 *     friction   phi(s) + F.s, for a disc of radius w: (w - |F|) |s| + (|F||s| + F.s); a given
 *                set's phi is its support
 *     contact    R |n.u + gap|, which a place below the surface by rounding increases too
 *                where the obstacle gives, with its spring of the stiffness k that begins at the
 *                depth r (soft.h), d = -(n.u + gap + r),   (d^+ - R/k)^2 k/2 + R d^-
 *     end set    sup over y in K of -r.(y - x), r the reaction of a set K that holds an end
 *     field      y'K y/2, its force being taken at x + y (field.h)
 *
 * where u and s of a contact of an element are those of its point, (1 - beta) u_j + beta u_{j+1},
 * on whose nodes its forces act by these shares, with s the slip, u_T on a plane. Each is >= 0,
 * where |p||e| - p.e = |p x e|^2/(|p||e| + p.e) has no cancellation. An inextensible element has
 * the length found, |e| <= 1 up to rounding; the excess is reported as stretch_residual. */
#include "cable/certificate.h"

#include <float.h>
#include <math.h>

#include "base/larger.h"
#include "cable/contact.h"
#include "cable/end_set.h"
#include "cable/field.h"
#include "cable/flow.h"
#include "cable/friction_law.h"
#include "cable/held.h"
#include "cable/moving_flow.h"
#include "cable/potential.h"
#include "cable/soft.h"
#include "chain/frame.h"
#include "linalg/dense.h"

/* Smallest gap that is required of any step, relative to the length times the largest force or the
 * sum of loads: the loop (to 1e-13) and rounding leave as much where nothing is strained and no
 * work is done. */
static const double GAP_FLOOR = 1e-12;

Vec3 cpsi_add_element_contacts(const CpsiLine *line, int j, Vec3 sum) {
    if (line->element_contacts > 0)
        for (int e = j - 1; e <= j; e++) {
            const int c = cpsi_line_contacts(line) + e;
            if (e < 0 || e + 1 >= line->n || line->obstacle_index[c] < 0) continue;
            const double part = cpsi_line_part(line, e, j);
            sum = vec3_axpy(part, vec3_load(&line->friction_force[3 * c]), sum);
            sum = vec3_axpy(part * line->reaction[c], vec3_load(&line->normal[3 * c]), sum);
        }
    return sum;
}

/* The sum of the forces on node j except those of the segments. */
static inline Vec3 node_force(const CpsiLine *line, int j) {
    Vec3 sum = vec3_load(&line->load[3 * j]);
    if (cpsi_line_has_field(line)) sum = vec3_add(sum, cpsi_line_field_balanced(line, j));
    if (cpsi_line_is_in_set(line, j)) sum = vec3_add(sum, cpsi_line_set_reaction(line, j));
    for (int c = j; c < cpsi_line_contacts(line); c += line->n) {
        sum = vec3_add(sum, vec3_load(&line->friction_force[3 * c]));
        sum = vec3_axpy(line->reaction[c], vec3_load(&line->normal[3 * c]), sum);
    }
    return line->element_contacts > 0 ? cpsi_add_element_contacts(line, j, sum) : sum;
}

static Vec3 segment_force(const CpsiLine *line, int e) {
    return vec3_load(&line->segment_force[3 * e]);
}

/* By how much the friction of contact c may still grow, in any direction. */
static double friction_margin(const CpsiLine *line, int c) {
    double f[3];
    cpsi_frame_to(f, cpsi_line_axes(line, c), &line->friction_force[3 * c]);
    return cpsi_friction_law_margin(&line->friction_law[c], line->friction_bound[c], f);
}

/* Is the bound of contact c coupled to its reaction? A frozen one is not, also where both are the
 * same because nothing has changed. */
static bool bound_follows(const CpsiLine *line, CpsFrictionPolicy friction, int c) {
    const double bound = line->friction_law[c].friction * line->reaction[c];
    return friction == CPS_FRICTION_POLICY_CONSISTENT && bound > 0 &&
           fabs(line->friction_bound[c] - bound) <= 1e-12 * bound;
}

/* Add what a unit of lambda, a change of the field's `beside` by -lambda L, adds to the forces;
 * returns its trace. */
static double add_field(const CpsiLine *line, double m[3][3]) {
    static const int AT[9] = {0, 1, 3, 1, 2, 4, 3, 4, 5};
    double trace = 0;
    for (int j = 0; j < line->n; j++)
        for (int i = 0; i < 9; i++) {
            const double by = line->length * line->field.stiffness[6 * j + AT[i]];
            m[i / 3][i % 3] += by;
            if (i % 4 == 0) trace += by;
        }
    return trace;
}

/* Distribute the remaining force `rest` on a line free at both ends. With one vector lambda for all
 * contacts, a contact contributes R (n.lambda) n, the friction F (n.lambda) where its bound is
 * coupled to R, and margin lambda_T within its bound; the sum is a 3 x 3 system. */
static void distribute_excess(CpsiLine *line, CpsFrictionPolicy friction, Vec3 rest) {
    double m[3][3] = {{0}}, lambda[3] = {-rest.x, -rest.y, -rest.z}, trace = 0;
    int pivot[3];
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const Vec3 n = vec3_load(&line->normal[3 * c]);
        const double margin = friction_margin(line, c);
        vec3_add_outer(m, line->reaction[c] - margin, n, n);
        if (line->keeps_reference_axes) {
            vec3_add_outer(m, margin, n, n);
            vec3_add_outer(m, -margin, cpsi_line_friction_normal(line, c),
                           cpsi_line_friction_normal(line, c));
        }
        if (bound_follows(line, friction, c))
            vec3_add_outer(m, 1, vec3_load(&line->friction_force[3 * c]), n);
        vec3_add_identity(m, margin);
        trace += line->reaction[c] + 2 * margin;
    }
    if (cpsi_line_has_field(line)) trace += add_field(line, m);
    /* A direction without friction or reaction keeps its residual, which shows in
     * force_residual. */
    vec3_add_identity(m, DBL_EPSILON * trace);
    if (!(trace > 0) || !cpsi_lu_factor(3, &m[0][0], pivot)) return;
    cpsi_lu_solve(3, &m[0][0], pivot, lambda);
    const Vec3 by = vec3_load(lambda);
    if (!(vec3_norm(by) < 1)) return;
    for (int j = 0; cpsi_line_has_field(line) && j < line->n; j++)
        vec3_store(&line->field.beside[3 * j],
                   vec3_axpy(-line->length, by, vec3_at(line->field.beside, j)));
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const Vec3 n = vec3_load(&line->normal[3 * c]), f = vec3_load(&line->friction_force[3 * c]);
        const double along = vec3_dot(n, by),
                     follow = bound_follows(line, friction, c) ? 1 + along : 1;
        /* the force is inside its set before it is scaled with its bound, and so it is after */
        const Vec3 more = vec3_axpy(friction_margin(line, c),
                                    vec3_reject(by, cpsi_line_friction_normal(line, c)), f);
        vec3_store(&line->friction_force[3 * c], vec3_scale(follow, more));
        line->friction_bound[c] *= follow;
        line->reaction[c] *= 1 + along;
    }
}

/* Where the field is taken: it carries what the forces found leave at each node that is not held.
 */
static void balance_field(CpsiLine *line) {
    double most = 0;
    for (int e = 0; e + 1 < line->n; e++)
        most = cpsi_max_nan(most, vec3_norm(segment_force(line, e)));
    for (int j = 0; j < line->n; j++) {
        vec3_store(&line->field.beside[3 * j], vec3(0, 0, 0));
        Vec3 rest = node_force(line, j);
        if (j > 0) rest = vec3_sub(rest, segment_force(line, j - 1));
        if (j + 1 < line->n) rest = vec3_add(rest, segment_force(line, j));
        if (cpsi_line_is_held(line, j)) continue;
        /* inertia takes all of it */
        cpsi_line_field_take(line, j, rest, line->inertia.is_moving ? 0 : most / line->length);
    }
}

void cpsi_balance_forces(CpsiLine *line, CpsFrictionPolicy friction) {
    const int n = line->n, elements = n - 1;
    if (cpsi_line_has_field(line)) balance_field(line);
    if (cpsi_line_is_loose(line)) {
        for (int round = 0; round < 2;
             round++) { /* the second round removes the rounding error of the first */
            Vec3 rest = vec3(0, 0, 0);
            for (int j = 0; j < n; j++) rest = vec3_add(rest, node_force(line, j));
            distribute_excess(line, friction, cpsi_line_sets_take(line, rest));
        }
    }
    /* from A to the first held node, starting from zero beyond the free end, if a node is held at
     * all */
    const int held = cpsi_line_next_held(line, 0), first = held < n ? held : 0;
    if (first > 0) {
        Vec3 p = vec3_scale(-1, node_force(line, 0));
        vec3_store(&line->segment_force[0], p);
        for (int e = 1; e < first; e++) {
            p = vec3_sub(p, node_force(line, e));
            vec3_store(&line->segment_force[3 * e], p);
        }
    }
    if (first == elements) return;
    /* from B to there, starting from zero beyond a free end, or at a held node from the computed
     * force of the element before it */
    Vec3 p = segment_force(line, elements - 1);
    if (line->end[CPS_END_B].kind == CPS_END_KIND_FREE) p = node_force(line, n - 1);
    vec3_store(&line->segment_force[3 * (elements - 1)], p);
    for (int e = elements - 2; e >= first; e--) {
        p = cpsi_line_is_held(line, e + 1) ? segment_force(line, e)
                                           : vec3_add(p, node_force(line, e + 1));
        vec3_store(&line->segment_force[3 * e], p);
    }
}

/* A strain up to this in an element without force counts as zero: it is rounding, and the accuracy
 * to which a program satisfies |e| <= 1. Without any force there is no scale to compare the gap
 * with. */
static const double LEAST_STRAIN = 1e-12;

/* Rounding error of an element's strain from that of its nodes' coordinates. */
static double coordinate_rounding(const CpsiLine *line, int e) {
    const double sum = vec3_norm(vec3_load(&line->position[3 * e])) +
                       vec3_norm(vec3_load(&line->position[3 * (e + 1)]));
    return 4 * DBL_EPSILON * sum / line->element_length[e];
}

static void raise_to(double *largest, double value) { *largest = cpsi_max_nan(*largest, value); }

/* Elongation: the segments' part of P, D, gap, scale and tension errors. */
static void add_segments(const CpsiLine *line, CpsCertificate *out) {
    for (int e = 0; e + 1 < line->n; e++) {
        const CpsiElementLaw law = cpsi_line_law(line, e);
        const double l = line->element_length[e], c = law.compliance;
        const Vec3 dx =
            vec3_sub(vec3_load(&line->position[3 * (e + 1)]), vec3_load(&line->position[3 * e]));
        const Vec3 strain = vec3_scale(1 / l, dx), p = segment_force(line, e);
        double size = vec3_norm(strain);
        const double force = vec3_norm(p), along = cpsi_law_strain(&law, force),
                     stored = law.count > 0 ? cpsi_law_conjugate(&law, force) : force * 0.5 * along;
        if (!(force > 0) && size > 1 && size <= 1 + LEAST_STRAIN + coordinate_rounding(line, e))
            size = 1;
        const double over = size - 1;
        double gap = vec3_angle_defect(p, strain, force, size);
        if (size > 0) raise_to(&out->element_push, -vec3_dot(p, strain) / size);
        if (c > 0) raise_to(&out->elongation_residual, over - along);
        if (over > 0 && c > 0) {
            gap += cpsi_law_gap(&law, over, force);
            out->primal +=
                law.count > 0 ? l * cpsi_law_energy(&law, over) : l * 0.5 * over * (over / c);
        } else if (over > 0) {
            raise_to(&out->stretch_residual, over);
            gap *= 1 / size; /* as if scaled back to |e| = 1 */
        } else {
            gap += law.count > 0 ? force * -over + stored : force * (-over + 0.5 * along);
        }
        out->gap += l * gap;
        out->dual -= law.count > 0 ? l * (force + stored) : l * force * (1 + 0.5 * along);
        out->scale += l * force * (1 + along);
        raise_to(&out->tension_estimate, fabs(line->tension[e] - force));
        raise_to(&out->largest_force, force);
    }
}

/* Add what contact c adds with an obstacle that gives, beside the terms of a rigid one: the energy
 * E of its spring, its conjugate R^2/(2 k), and the local gap E + E* + R (n.u + gap + r). */
static void add_soft(const CpsiLine *line, int c, CpsiSoft soft, CpsCertificate *out) {
    if (!isfinite(line->gap[c])) return;
    const Vec3 u = vec3_sub(cpsi_line_place(line, line->position, c),
                            cpsi_line_place(line, line->reference, c));
    const double gives = soft.stiffness,
                 depth = -(vec3_dot(vec3_at(line->normal, c), u) + line->gap[c] + soft.rest),
                 reaction = line->reaction[c], sunk = fmax(0, depth), off = sunk - reaction / gives;
    out->primal += 0.5 * gives * sunk * sunk;
    out->dual -= 0.5 * reaction * (reaction / gives);
    out->scale += 0.5 * gives * sunk * sunk;
    out->contact_residual += 0.5 * gives * off * off + reaction * fmax(0, -depth);
}

/* Add the terms of friction and reaction of contact c; returns the force on the node. */
static Vec3 add_contact(const CpsiLine *line, int c, CpsCertificate *out) {
    if (cpsi_contact_is_idle(line, c)) return vec3(0, 0, 0);
    const Vec3 x = cpsi_line_place(line, line->position, c),
               reference = cpsi_line_place(line, line->reference, c);
    const Vec3 n = vec3_load(&line->normal[3 * c]), f = vec3_load(&line->friction_force[3 * c]);
    const double w = line->friction_bound[c], reaction = line->reaction[c];
    const CpsiFrictionLaw *law = &line->friction_law[c];
    const CpsiSoft soft = cpsi_soft_spring(line, c);
    double force[3], slip[3];
    cpsi_line_local_slip(line, c, slip);
    cpsi_frame_to(force, cpsi_line_axes(line, c), &line->friction_force[3 * c]);
    const double law_gap = cpsi_friction_law_gap(law, w, force, slip),
                 dissipation = cpsi_friction_law_dissipation(law, w, slip);
    out->law_residual += law_gap > 0 ? law_gap : 0;
    out->friction_residual += fabs(w - law->friction * reaction);
    out->primal += dissipation;
    out->scale += dissipation;
    /* the position from which it slipped, on the tangent plane: the reference there */
    out->dual += vec3_dot(f, vec3_sub(x, cpsi_line_slip(line, c)));
    raise_to(&out->largest_force, vec3_norm(f));
    if (reaction > 0) {
        /* on either side: an end is put into its set, which may be below the surface by rounding */
        const double distance = vec3_dot(n, vec3_sub(x, reference)) + line->gap[c];
        if (!(soft.stiffness > 0)) out->contact_residual += reaction * fabs(distance);
        out->dual += reaction * (vec3_dot(n, reference) - line->gap[c] - soft.rest);
        raise_to(&out->largest_force, reaction);
    }
    if (soft.stiffness > 0) add_soft(line, c, soft, out);
    return vec3_axpy(reaction, n, f);
}

/* The loads' part of S: the work that they do in the step, node by node and without sign, and the
 * floor; never more than the moments |b_j| |x_j - x_A|. */
static double load_scale(const CpsiLine *line, double largest_force, double tolerance) {
    const Vec3 anchor = vec3_load(&line->position[0]);
    const bool has_field = cpsi_line_has_field(line), swims = cpsi_line_swims(line);
    double work = 0, moment = 0, loads = 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_load(&line->position[3 * j]), b = vec3_load(&line->load[3 * j]);
        const Vec3 moved = vec3_sub(x, vec3_at(line->reference, j));
        double load = vec3_norm(b);
        if (swims) { /* where drag and weight are opposite, each by itself */
            const Vec3 flow = vec3_at(line->field.all, j);
            work += fabs(vec3_dot(flow, moved)) + fabs(vec3_dot(vec3_sub(b, flow), moved));
            load = vec3_norm(flow) + vec3_norm(vec3_sub(b, flow));
        } else {
            work += fabs(vec3_dot(b, moved));
        }
        if (has_field) {
            const Vec3 field = cpsi_line_field_force(line, j, x);
            work += fabs(vec3_dot(field, moved));
            load += vec3_norm(field);
        }
        moment += load * vec3_norm(vec3_sub(x, anchor));
        loads += load;
    }
    work += GAP_FLOOR * fmax(loads, largest_force) * line->length / tolerance;
    return work <= moment ? work : moment;
}

/* Add the terms of the field at node j; returns its force. With E and E* its energy and the
 * conjugate, -E*(-f) = E(z) + f.z, z = x + y. */
static Vec3 add_field_energy(const CpsiLine *line, int j, CpsCertificate *out) {
    const Vec3 x = vec3_at(line->position, j), y = vec3_at(line->field.beside, j),
               f = cpsi_line_field_balanced(line, j);
    const double energy = cpsi_line_field_energy(line, j, x),
                 gap = 0.5 * vec3_dot(y, cpsi_line_field_pull(line, j, y));
    out->gap += gap;
    out->primal += energy;
    out->dual += energy - gap + vec3_dot(f, x);
    raise_to(&out->largest_force, vec3_norm(f));
    return f;
}

/* Add the terms of the set that holds an end, node j; returns its reaction r. With v = -r the part
 * of D is minus the support function, v.x + gap. */
static Vec3 add_set(const CpsiLine *line, int j, CpsCertificate *out) {
    const Vec3 r = cpsi_line_set_reaction(line, j);
    const double gap = cpsi_line_set_gap(line, j);
    out->gap += gap;
    out->dual += vec3_dot(r, vec3_at(line->position, j)) - gap;
    raise_to(&out->largest_force, vec3_norm(r));
    return r;
}

/* Nodes: friction, contact, loads and the balance of forces. */
static void add_nodes(const CpsiLine *line, CpsCertificate *out) {
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_load(&line->position[3 * j]), b = vec3_load(&line->load[3 * j]);
        out->primal -= vec3_dot(b, x);
        raise_to(&out->largest_force, vec3_norm(b));
        /* in motion drag and weight may be equal and opposite */
        if (cpsi_line_swims(line))
            raise_to(&out->largest_force, vec3_norm(vec3_at(line->field.all, j)));
        Vec3 balance = cpsi_line_has_field(line) ? vec3_add(b, add_field_energy(line, j, out)) : b;
        if (j > 0) balance = vec3_sub(balance, segment_force(line, j - 1));
        if (j + 1 < line->n) balance = vec3_add(balance, segment_force(line, j));
        if (cpsi_line_is_in_set(line, j)) balance = vec3_add(balance, add_set(line, j, out));
        double distance;
        if (cpsi_line_nearest_rigid(line, x, &distance) >= 0)
            raise_to(&out->penetration, -distance);
        balance = cpsi_add_element_contacts(line, j, balance);
        if (cpsi_line_is_held(line, j)) {
            /* the held node's term of D: the force of its support times its position */
            out->dual -= vec3_dot(balance, cpsi_line_held_place(line, j));
            continue;
        }
        for (int c = j; c < cpsi_line_contacts(line); c += line->n)
            balance = vec3_add(balance, add_contact(line, c, out));
        raise_to(&out->force_residual, vec3_norm(balance));
    }
    for (int c = cpsi_line_contacts(line); c < cpsi_line_all_contacts(line); c++)
        if (line->obstacle_index[c] >= 0) add_contact(line, c, out);
    out->gap += out->law_residual + out->contact_residual;
}

bool cpsi_friction_law_is_satisfied(const CpsiLine *line, double tolerance) {
    const double rounding = 1e-14 * line->report.certificate.largest_force * line->length;
    double law_gap = 0, dissipated = 0, bounds = 0;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const double w = line->friction_bound[c];
        if (!(w > 0)) continue;
        const CpsiFrictionLaw *law = &line->friction_law[c];
        double force[3], slip[3];
        cpsi_line_local_slip(line, c, slip);
        cpsi_frame_to(force, cpsi_line_axes(line, c), &line->friction_force[3 * c]);
        const double off = fabs(cpsi_friction_law_gap(law, w, force, slip));
        if (off > tolerance * w * line->length + rounding) return false;
        law_gap += off;
        bounds += w * line->length;
        dissipated += cpsi_friction_law_dissipation(law, w, slip);
    }
    return law_gap <= tolerance * dissipated + 1e-12 * bounds + rounding;
}

CpsCertificate cpsi_certificate(const CpsiLine *line, double tolerance) {
    CpsCertificate out = {0};
    add_segments(line, &out);
    add_nodes(line, &out);
    out.scale += load_scale(line, out.largest_force, tolerance);
    out.load_residual = cpsi_line_flow_change(line) + cpsi_potential_change(line);
    out.element_penetration = cpsi_line_pierces(line, &(int){0});
    /* P - D >= sum (l c/2) (T - T*)^2, so rms(T - T*) <= sqrt(2 gap/(c L)) with the least c; it
     * says nothing beyond the tension itself */
    if (line->compliance > 0) {
        const double bound = sqrt(2 * out.gap / (cpsi_line_least_compliance(line) * line->length));
        out.has_tension_bound = bound <= out.largest_force;
        if (out.has_tension_bound) out.tension_bound = bound;
    }
    return out;
}
