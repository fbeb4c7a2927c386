/* SPDX-License-Identifier: BSD-3-Clause */
/* The mesh estimate (docs/theory.md 4, "What it says of the mesh").
 *
 * The forces of a step balance for the continuous line too, p(a) = p_i - q s at s from the middle
 * of element i, q the weight per length; only the shape has an error. The chord of an element is l
 * (t + c p_i), that of the continuous line is the integral of t(p) + c p, and they differ by
 *
 *     e_i = (l^3/24 T^2) (2 (q.t) q_n + |q_n|^2 t),      q_n = q - (q.t) t
 *
 * A span is held at its two supports: the sum of its e_i must be compensated by a change f of the
 * force in it, with
 *
 *     [ sum l ((1/T + c)(I - t t^T) + c t t^T) + sliding lengths beside it c d d^T ] f = - sum e_i
 *
 * At a touchdown on a plane the curve begins between nodes, where the force's normal part is 0:
 * with v = p.n/|q.n| for the element there this adds (|q.n|/2H) (l/2 - v)^2 along the normal. Bends
 * over curved obstacles add the difference between the friction of a polygonal line and exp(mu
 * turn). The force in a span with a free end is given. There is no estimate where a line bears on
 * what gives, which is no support of its spans. */
#include "cable/mesh_error.h"
#include "cable/winch.h"

#include <math.h>

#include "base/larger.h"
#include "cable/field.h"
#include "cable/soft.h"
#include "linalg/dense.h"

typedef struct Span {
    double compliance[9]; /* [m/N] */
    Vec3 defect;          /* [m] */
} Span;

static Vec3 force_of(const CpsiLine *line, int e) { return vec3_at(line->segment_force, e); }

/* [N/m] q of node j; and of element e: of a line with loads beside its weight the mean of that of
 * its nodes. */
static Vec3 load_at(const CpsiLine *line, int j) {
    return line->has_field || line->has_node_loads ? cpsi_line_load_at(line, j) : vec3(0, 0, 0);
}
static Vec3 load_of(const CpsiLine *line, int e, Vec3 before, Vec3 after) {
    if (!line->has_field && !line->has_node_loads) return cpsi_line_weight(line, e);
    return vec3_scale(0.5, vec3_add(before, after));
}

/* The contact of node j with the largest reaction, or -1. */
static int carrying_contact(const CpsiLine *line, int j) {
    int best = -1;
    for (int c = j; c < cpsi_line_contacts(line); c += line->n)
        if (line->state[c] != CPS_NODE_STATE_FREE &&
            (best < 0 || line->reaction[c] > line->reaction[best]))
            best = c;
    return best;
}

static bool is_support(const CpsiLine *line, int j) {
    return cpsi_line_is_held(line, j) || carrying_contact(line, j) >= 0;
}

/* m += along d d^T + across (I - d d^T), d a unit vector */
static void add_compliance(double m[9], Vec3 d, double along, double across) {
    const double v[3] = {d.x, d.y, d.z};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) m[3 * i + k] += (along - across) * v[i] * v[k];
        m[4 * i] += across;
    }
}

/* Add element e of a span, whose load is q; false: its weight exceeds its tension. */
static bool add_element(const CpsiLine *line, int e, Vec3 q, Span *span) {
    const Vec3 p = force_of(line, e);
    const CpsiElementLaw law = cpsi_line_law(line, e);
    const double l = line->natural_length[e], tension = vec3_norm(p), /* l c: that of its rest */
        c = cpsi_law_compliance(&law, tension) * (line->element_length[e] / l);
    if (!(tension > l * vec3_norm(q)) || !(tension > 0)) return false;
    const double over = 1 / tension;
    const Vec3 t = vec3_scale(over, p);
    const double along = vec3_dot(q, t);
    const Vec3 across = vec3_axpy(-along, t, q);
    const Vec3 chord = vec3_axpy(2 * along, across, vec3_scale(vec3_dot(across, across), t));
    span->defect = vec3_axpy(l * l * l / 24 * over * over, chord, span->defect);
    add_compliance(span->compliance, t, l * c, l * (over + c));
    return true;
}

/* Add the support of the span at node j, with e the span's element beside it and j + `inward` the
 * next node outside the span. */
static void add_support(const CpsiLine *line, int j, int e, int inward, Span *span) {
    const int c = carrying_contact(line, j);
    if (cpsi_line_is_held(line, j) || c < 0) return;
    const Vec3 n = vec3_at(line->normal, c), q = cpsi_line_load_at(line, j), p = force_of(line, e);
    const double normal_load = -vec3_dot(q, n), l = line->element_length[e];
    const Vec3 flat = vec3_reject(p, n);
    const double tight = vec3_norm(flat);
    if (!(tight > 0)) return;
    if (!cpsi_obstacle_is_round(cpsi_line_obstacle(line, c)) && normal_load > 0) {
        const double off = 0.5 * l - fabs(vec3_dot(p, n)) / normal_load;
        span->defect = vec3_axpy(inward * normal_load / (2 * tight) * off * off, n, span->defect);
    }
    /* the sliding part beside the span stretches; if it reaches a free end it is drawn along */
    double slides = 0; /* [m] of mean compliance */
    int k = j;
    for (int next; next = k + inward, next >= 0 && next < line->n; k = next) {
        const int at = carrying_contact(line, k);
        if (at < 0 || line->state[at] != CPS_NODE_STATE_SLIP) break;
        const int beside = inward < 0 ? next : k;
        const CpsiElementLaw law = cpsi_line_law(line, beside);
        slides += line->element_length[beside] *
                  (law.count > 0 ? cpsi_law_compliance(&law, vec3_norm(force_of(line, beside))) /
                                       line->compliance
                   : line->compliance_factor ? line->compliance_factor[beside]
                                             : 1);
    }
    const int last = carrying_contact(line, k);
    const bool drawn = (k == 0 || k == line->n - 1) && !cpsi_line_is_held(line, k) && last >= 0 &&
                       line->state[last] == CPS_NODE_STATE_SLIP;
    const double compliance =
        drawn ? 1e6 * (span->compliance[0] + span->compliance[4] + span->compliance[8])
              : slides * line->compliance;
    add_compliance(span->compliance, vec3_scale(1 / tight, flat), compliance, 0);
}

/* [N] Largest change of the tension in the span of elements first..last. */
static double span_error(const CpsiLine *line, int first, int last) {
    const bool ends_free = !is_support(line, first) || !is_support(line, last + 1);
    if (ends_free) return 0;
    Span span = {.defect = vec3(0, 0, 0)};
    Vec3 before = load_at(line, first);
    for (int e = first; e <= last; e++) {
        const Vec3 after = load_at(line, e + 1);
        if (!add_element(line, e, load_of(line, e, before, after), &span)) return NAN;
        before = after;
    }
    add_support(line, first, first, -1, &span);
    add_support(line, last + 1, last, 1, &span);
    double *m = span.compliance, change[3], worst = 0;
    int pivot[3];
    const double trace = m[0] + m[4] + m[8];
    for (int i = 0; i < 3; i++)
        m[4 * i] +=
            1e-14 * trace; /* an inextensible line pulled straight has no compliance along it */
    vec3_store(change, span.defect);
    if (!(trace > 0) || !cpsi_lu_factor(3, m, pivot)) return NAN;
    cpsi_lu_solve(3, m, pivot, change);
    for (int e = first; e <= last; e++) {
        const Vec3 p = force_of(line, e);
        worst = cpsi_max_nan(worst, fabs(vec3_dot(vec3_load(change), p)) / vec3_norm(p));
    }
    return worst;
}

/* The difference of the logarithms of the tension ratios over the bend at node j and over an arc,
 * where the node slips on a curved obstacle. */
static double bend_error(const CpsiLine *line, int j) {
    const int c = carrying_contact(line, j);
    if (j == 0 || j == line->n - 1 || c < 0 || line->state[c] != CPS_NODE_STATE_SLIP ||
        !(line->reaction[c] > 0))
        return 0;
    if (cpsi_line_obstacle(line, c)->kind == CPS_OBSTACLE_PLANE) return 0;
    const Vec3 before = force_of(line, j - 1), after = force_of(line, j);
    const double mu = line->friction_bound[c] / line->reaction[c];
    const double turn = atan2(vec3_norm(vec3_cross(before, after)), vec3_dot(before, after)),
                 half = mu * tan(0.5 * turn);
    return half < 1 ? fabs(log1p(half) - log1p(-half) - mu * turn) : INFINITY;
}

bool cpsi_mesh_error(const CpsiLine *line, double *error) {
    *error = 0;
    for (int c = 0; c < cpsi_line_contacts(line); c++)
        if (line->state[c] == CPS_NODE_STATE_UNRESOLVED ||
            (line->state[c] != CPS_NODE_STATE_FREE && cpsi_soft_spring(line, c).stiffness > 0))
            return false;
    double worst = 0, bends = 0, largest = 0;
    for (int e = 0; e + 1 < line->n; e++)
        largest = cpsi_max_nan(largest, vec3_norm(force_of(line, e)));
    for (int j = 0; j < line->n; j++) bends += bend_error(line, j);
    for (int first = 0, e = 0; e + 1 < line->n; e++) {
        if (e + 2 < line->n && !is_support(line, e + 1)) continue;
        /* an element whose two nodes touch does not hang */
        const bool lies =
            cpsi_line_is_on_drum(line, e) ||
            (e == first && carrying_contact(line, e) >= 0 && carrying_contact(line, e + 1) >= 0);
        const double of_span = lies ? 0 : span_error(line, first, e);
        if (isnan(of_span)) return false;
        worst = fmax(worst, of_span);
        first = e + 1;
    }
    *error = worst + largest * expm1(bends);
    return !isnan(*error);
}
