/* SPDX-License-Identifier: BSD-3-Clause */
/* Arithmetic of the checker: long double, compensated sums, no quantity formed as a difference of large ones.
 *
 * With e the stretch vector of an element (x_i - x_{i-1}) / l, d = (|e| - 1)^+ and W* (p) = |p| + c |p|^2 / 2, the
 * local gaps are written as sums of non-negative terms (docs/theory.md): segment   W(e) + W*(p) - p.e = (d - c|p|)^2 /
 * (2 c) + |p| (1 - |e|)^+ + |p||e| - p.e         c > 0 |p| (1 - |e|) + |p||e| - p.e c = 0 friction  w|u_T| + F.u_T = (w
 * - |F|) |u_T| + |F||u_T| + F.u_T contact   R (n.u + gap) where |a||b| - a.b = |a||b| |a/|a| - b/|b||^2 / 2. The
 * certificate adds their absolute values, so that a configuration or a force slightly outside its set makes the gap
 * larger and never smaller. */
#include "measure.h"

#include <math.h>

typedef long double Real;
typedef Real Triple[3];

/* Neumaier's compensated sum */
typedef struct Sum {
    Real value, rest;
} Sum;

static void add(Sum *sum, Real term) {
    Real total = sum->value + term;
    sum->rest += fabsl(sum->value) >= fabsl(term) ? (sum->value - total) + term : (term - total) + sum->value;
    sum->value = total;
}

static Real total(const Sum *sum) { return sum->value + sum->rest; }

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return sqrtl(dot(a, a)); }
static void widen(const double *a, Triple out) {
    for (int k = 0; k < 3; k++) out[k] = (Real)a[k];
}
static void subtract(const double *a, const double *b, Triple out) {
    for (int k = 0; k < 3; k++) out[k] = (Real)a[k] - (Real)b[k];
}

/* maximum that keeps a NaN */
static void raise_to(double *worst, Real value) {
    if (!((double)value <= *worst)) *worst = (double)value;
}

/* |a||b| - a.b without cancellation */
static Real misalignment(const Real *a, const Real *b) {
    Real la = size(a), lb = size(b);
    if (la == 0 || lb == 0) return 0;
    Triple difference;
    for (int k = 0; k < 3; k++) difference[k] = a[k] / la - b[k] / lb;
    return la * lb * dot(difference, difference) / 2;
}

static bool all_within(const double *value, size_t count, double low, double high) {
    for (size_t i = 0; i < count; i++) {
        if (!(value[i] >= low && value[i] <= high)) return false;
    }
    return true;
}

/* The first variable with a value that cannot be. Infinite may be: the gap to an obstacle that is not looked for; NaN
 * may be: the rms bound, where it says nothing. */
static const char *missing_variable(const Record *r) {
    const double most = 1.7976931348623157e308, tiny = 4.9e-324;
    size_t n = r->nodes, m = r->elements;
    const struct {
        const char *name;
        const double *value;
        size_t count;
        double low, high;
    } table[] = {
        {"element_length", r->element_length, m, tiny, most},
        {"compliance", &r->compliance, 1, 0, most},
        {"reference", r->reference[0], 3 * n, -most, most},
        {"position", r->position[0], 3 * n, -most, most},
        {"load", r->load[0], 3 * n, -most, most},
        {"normal", r->normal[0], 3 * n, -most, most},
        {"friction", r->friction[0], 3 * n, -most, most},
        {"segment_force", r->segment_force[0], 3 * m, -most, most},
        {"tension", r->tension, m, -most, most},
        {"friction_bound", r->friction_bound, n, 0, most},
        {"reaction", r->reaction, n, -most, most},
        {"contact_gap", r->gap, n, -most, INFINITY},
        {"end_value", r->end_value[0], 6, -most, most},
        {"proof", r->proof, 3, -most, most},
        {"proof_value", &r->proof_value, 1, -most, most},
        {"dissipated", &r->dissipated, 1, -most, most},
    };
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        if (!all_within(table[k].value, table[k].count, table[k].low, table[k].high)) return table[k].name;
    }
    for (int k = 0; k < CLAIMS; k++) {
        bool may_miss = k == CLAIM_TENSION_BOUND && isnan(r->claim[k]);
        if (!isfinite(r->claim[k]) && !may_miss) return CLAIM_NAME[k];
    }
    return NULL;
}

/* running sums of a record */
typedef struct Sums {
    Sum primal, dual, signed_gap, gap, scale, slid, law, contact, imbalance_work, magnitude, length;
} Sums;

static bool held(const Record *r, size_t j) {
    return (j == 0 && r->end_kind[0] == END_HELD) || (j == r->elements && r->end_kind[1] == END_HELD);
}

static void measure_segment(const Record *r, size_t i, Measures *m, Sums *s) {
    Real l = r->element_length[i], c = r->compliance, T = r->tension[i];
    Triple p, e;
    widen(r->segment_force[i], p);
    subtract(r->position[i + 1], r->position[i], e);
    for (int k = 0; k < 3; k++) e[k] /= l;
    Real force = size(p), stretch = size(e), strain = stretch > 1 ? stretch - 1 : 0;

    // energy, conjugate and local gap
    Real energy = c > 0 ? strain * strain / (2 * c) : 0;
    Real mismatch = c > 0 ? (strain - c * force) * (strain - c * force) / (2 * c) : 0;
    Real slack = c > 0 && stretch > 1 ? 0 : force * (1 - stretch), turn = misalignment(p, e);
    add(&s->length, l);
    add(&s->primal, l * energy);
    add(&s->dual, -l * (force + c * force * force / 2));
    add(&s->signed_gap, l * (mismatch + slack + turn));
    add(&s->gap, l * (mismatch + fabsl(slack) + turn));
    add(&s->scale, l * (force + c * force * force));
    add(&s->magnitude, l * (energy + force + c * force * force));

    // residuals
    if (c == 0) raise_to(&m->stretch, stretch - 1);
    if (slack < 0) m->overlong -= (double)(l * slack);
    // coordinates are doubles: their last bits over l are no strain
    Triple here, there;
    widen(r->position[i], here), widen(r->position[i + 1], there);
    raise_to(&m->strain_error, stretch - 1 - c * T - 2 * 0x1p-53L * (size(here) + size(there)) / l);
    raise_to(&m->tension_estimate, fabsl(T - force));
    raise_to(&m->largest_force, force);
    raise_to(&m->tension_least, -T);
}

/* friction and contact of a node; `pull` gathers the forces on it */
static void measure_contact(const Record *r, size_t j, Triple pull, Measures *m, Sums *s) {
    Triple n, F, u, tangential, reference;
    widen(r->normal[j], n), widen(r->friction[j], F), widen(r->reference[j], reference);
    subtract(r->position[j], r->reference[j], u);
    Real w = r->friction_bound[j], R = r->reaction[j], gap = r->gap[j], force = size(F), has_normal = size(n);
    bool active = !held(r, j);
    if (R < m->reaction_least) m->reaction_least = (double)R;
    // at a held end the obstacle may share the load with the support, which needs no friction
    if (has_normal == 0) raise_to(&m->stray_force, fabsl(R));
    if (has_normal == 0 || !active) raise_to(&m->stray_force, force);
    if (!active) return;

    // friction
    Real along = dot(n, u);
    for (int k = 0; k < 3; k++) tangential[k] = u[k] - along * n[k], pull[k] += F[k] + R * n[k];
    Real slide = size(tangential), opposite[3] = {-F[0], -F[1], -F[2]};
    Real spare = (w - force) * slide, turn = misalignment(opposite, tangential), off = dot(F, n) * along;
    add(&s->primal, w * slide);
    add(&s->scale, w * slide);
    add(&s->signed_gap, spare + turn), add(&s->signed_gap, off);
    add(&s->gap, fabsl(spare) + turn);
    add(&s->law, fabsl(spare) + turn);
    add(&s->slid, w * slide);
    add(&s->dual, dot(F, reference) + R * dot(n, reference));
    add(&s->magnitude, (force + R) * size(reference) + w * slide);
    raise_to(&m->friction_excess, force - w);
    raise_to(&m->friction_normal, fabsl(dot(F, n)));
    raise_to(&m->largest_force, force), raise_to(&m->largest_force, R);

    // contact
    if (has_normal > 0) raise_to(&m->normal_error, fabsl(has_normal - 1));
    if (isinf(gap)) {
        raise_to(&m->stray_force, fabsl(R));
        m->watched = m->watched && has_normal == 0;
        return;
    }
    Real distance = along + gap;
    raise_to(&m->penetration, -distance);
    add(&s->signed_gap, R * distance);
    add(&s->gap, fabsl(R * distance));
    add(&s->contact, fabsl(R * distance));
    add(&s->dual, -R * gap);
    add(&s->magnitude, fabsl(R * gap));
}

static void measure_node(const Record *r, size_t j, Measures *m, Sums *s) {
    Triple b, x, arm, pull;
    widen(r->load[j], b), widen(r->load[j], pull), widen(r->position[j], x);
    subtract(r->position[j], r->position[0], arm);
    for (int k = 0; k < 3; k++) {
        if (j < r->elements) pull[k] += r->segment_force[j][k];
        if (j > 0) pull[k] -= r->segment_force[j - 1][k];
        raise_to(&m->extent, fabsl(x[k]));
    }
    add(&s->primal, -dot(b, x));
    add(&s->scale, size(b) * size(arm));
    add(&s->magnitude, size(b) * size(x) + size(pull) * size(x));
    raise_to(&m->largest_force, size(b));
    measure_contact(r, j, pull, m, s);

    // a held node: the dual pairs the force of the support with the imposed position; a free one must balance
    if (held(r, j)) {
        Triple imposed, off;
        widen(r->end_value[j == 0 ? 0 : 1], imposed);
        subtract(r->position[j], r->end_value[j == 0 ? 0 : 1], off);
        raise_to(&m->held_error, size(off));
        add(&s->dual, -dot(pull, imposed));
        add(&s->imbalance_work, dot(pull, off));
    } else {
        raise_to(&m->force, size(pull));
        add(&s->imbalance_work, dot(pull, x));
    }
}

/* What proves that nothing can balance: distance of the ends, or the fall of the energy along a rigid motion v,
 * sum b.v - sum w |v_T|, which must not lead into the obstacle. */
static void measure_proof(const Record *r, Measures *m) {
    m->ends_distance = m->rigid_fall = NAN;
    m->rigid_rise_least = INFINITY;
    if (r->end_kind[0] == END_HELD && r->end_kind[1] == END_HELD) {
        Triple apart;
        subtract(r->end_value[1], r->end_value[0], apart);
        m->ends_distance = (double)size(apart);
    }
    Triple v;
    widen(r->proof, v);
    if (size(v) == 0) return;
    Sum fall = {0, 0};
    for (size_t j = 0; j < r->nodes; j++) {
        Triple b, n, tangential;
        widen(r->load[j], b), widen(r->normal[j], n);
        Real rise = dot(n, v);
        for (int k = 0; k < 3; k++) tangential[k] = v[k] - rise * n[k];
        add(&fall, dot(b, v));
        add(&fall, -(Real)r->friction_bound[j] * size(tangential));
        if (isfinite(r->gap[j]) && (double)rise < m->rigid_rise_least) m->rigid_rise_least = (double)rise;
    }
    m->rigid_fall = (double)total(&fall);
}

Measures measure(const Record *r) {
    Measures m = {.missing = missing_variable(r), .watched = true, .stretch = -INFINITY, .strain_error = -INFINITY};
    m.friction_excess = m.tension_least = -INFINITY;
    Sums s = {0};
    for (size_t i = 0; i < r->elements; i++) measure_segment(r, i, &m, &s);
    for (size_t j = 0; j < r->nodes; j++) measure_node(r, j, &m, &s);
    measure_proof(r, &m);

    m.length = (double)total(&s.length);
    m.primal = (double)total(&s.primal);
    m.dual = (double)total(&s.dual);
    m.gap = (double)total(&s.gap);
    m.scale = (double)total(&s.scale);
    m.slid = (double)total(&s.slid);
    m.law = (double)total(&s.law);
    m.contact = (double)total(&s.contact);
    m.tension_least = -m.tension_least;

    /* primal - dual = sum of local gaps - sum over nodes of imbalance.x, an identity of the exact record;
     * what is left is rounding of 64-bit mantissas */
    Sum identity = s.primal;
    add(&identity, -s.dual.value), add(&identity, -s.dual.rest);
    add(&identity, -s.signed_gap.value), add(&identity, -s.signed_gap.rest);
    add(&identity, s.imbalance_work.value), add(&identity, s.imbalance_work.rest);
    m.identity = (double)total(&identity);
    m.identity_noise = (double)(1024 * 0x1p-63L * total(&s.magnitude));
    m.tension_bound = r->compliance > 0 ? sqrt(2 * m.gap / (r->compliance * m.length)) : NAN;
    return m;
}
