/* SPDX-License-Identifier: BSD-3-Clause */
/* P10.1 solved by the method of multipliers, and the outcome of its solution (see first_order.h
 * and capstan/regularized.h). */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/larger.h"
#include "base/status.h"
#include "base/words.h"
#include "regularized/band_blocks.h"
#include "regularized/first_order.h"
#include "regularized/handle.h"

enum { MAX_ROUNDS = 200, NEWTON_LIMIT = 500, STUCK_ROUNDS = 6 };

/* A smaller reference strain counts as zero: it is the rounding of 1 in positions of a slack
 * line. */
static const double SLACK_STRAIN = 1e-9;

/* Forces below the first share of the step's force count as zero; where displacements diverge,
 * rounding errors up to the second share are allowed. A strain below the third share of the step's
 * force over K counts as zero. */
static const double FORCE_TOLERANCE = 1e-9, FORCE_ROUNDING = 1e-7, STRAIN_TOLERANCE = 1e-6;

/* stiffness of the multipliers, initial and largest, and of the anchor, in K over length^2 */
static const double AUGMENT_FIRST = 1e2, AUGMENT_MOST = 1e7, AUGMENT_GROWTH = 10, ANCHOR = 1e-4;

/* a round that leaves more than this share of the residual counts as slow */
static const double SLOW = 0.3;

struct CpsFirstOrder {
    CpsiArena arena;
    CpsiFirstOrder f; /* f.step is valid only during a solve */
    int elements;
    double *arc, *tension, *along, *friction_force;
    double *unknown, *work;
    CpsFirstOrderReport report;
};

static const CpsiWords OUTCOME[] = {CPS_FIRST_ORDER_OUTCOME_LIST(CPSI_WORDS_WITH_KEY)};

const char *cps_first_order_outcome_name(CpsFirstOrderOutcome outcome) {
    return CPSI_WORDS(OUTCOME, outcome).name;
}

const char *cps_first_order_outcome_text(CpsFirstOrderOutcome outcome) {
    return CPSI_WORDS(OUTCOME, outcome).text;
}

/* ---- memory and the reference ---- */

static void layout(CpsFirstOrder *s, int elements, CpsiArena *arena) {
    const size_t m = (size_t)elements, n = m + 1;
    CpsiFirstOrder *f = &s->f;
    CPSI_PLACE(arena, f->tangent, 3 * m);
    CPSI_PLACE(arena, f->stretch, m);
    CPSI_PLACE(arena, f->strain, m);
    CPSI_PLACE(arena, f->gap, n);
    CPSI_PLACE(arena, f->u, 3 * n);
    CPSI_PLACE(arena, f->before, 3 * n);
    CPSI_PLACE(arena, f->friction_force, 3 * n);
    CPSI_PLACE(arena, f->push, n);
    CPSI_PLACE(arena, f->gradient, 3 * n);
    CPSI_PLACE(arena, s->arc, n);
    CPSI_PLACE(arena, s->tension, 3 * m);
    CPSI_PLACE(arena, s->along, m);
    CPSI_PLACE(arena, s->friction_force, 3 * n);
    CPSI_PLACE(arena, s->unknown, 3 * n);
    CPSI_PLACE(arena, s->work, 3 * n * (4 + CPSI_FIRST_ORDER_BAND + 1));
}

/* a node at most this far from the obstacle, per length of the line, touches it, as with contact
 * of the reference */
static const double TOUCH = 1e-9;

/* (77), or (16) at every node */
static void set_contact(CpsiFirstOrder *f, CpsFirstOrderContact contact) {
    const CpsiCells *c = &f->step->own;
    for (int j = 0; j <= c->cells; ++j) {
        const bool touches = c->gap[j] <= TOUCH * f->step->length;
        f->gap[j] = contact == CPS_FIRST_ORDER_CONTACT_REACHED ? c->gap[j] : touches ? 0 : INFINITY;
    }
}

/* (71), (85); the imposed displacements of the ends */
static void set_reference(CpsiFirstOrder *f, CpsFirstOrderReport *r) {
    const CpsiCells *c = &f->step->own;
    for (int i = 0; i < c->cells; ++i) {
        const Vec3 slope = vec3_scale(1 / c->width[i], vec3_sub(vec3_at(c->reference, i + 1),
                                                                vec3_at(c->reference, i)));
        const double s = vec3_norm(slope);
        vec3_store(f->tangent + 3 * (size_t)i, vec3_scale(s > 0 ? 1 / s : 1, slope));
        f->strain[i] = s - 1 > SLACK_STRAIN ? s - 1 : 0;
        f->stretch[i] = f->strain[i] > 0 ? s : 1;
        if (f->strain[i] == 0) r->slack += c->width[i];
        if (s - 1 < -SLACK_STRAIN) r->outside += c->width[i];
    }
    const int last = c->cells;
    vec3_store(f->u, vec3_sub(vec3_at(c->position, 0), vec3_at(c->reference, 0)));
    if (f->step->held)
        vec3_store(f->u + 3 * (size_t)last,
                   vec3_sub(vec3_at(c->position, last), vec3_at(c->reference, last)));
}

/* ---- rounds ---- */

/* Accept the multipliers and displacements of a round. Returns the largest force by which they
 * changed, including that of the anchor, and records the largest force of the anchor. */
static double accept_solution(CpsiFirstOrder *f, CpsFirstOrderReport *r) {
    const CpsiCells *c = &f->step->own;
    double change = 0, held_most = 0;
    const int end = f->unknowns / 3;
    for (int j = 1; j <= end; ++j) {
        double friction_force[3], push;
        cpsi_first_order_multipliers(f, j, friction_force, &push);
        const Vec3 drag =
            vec3_scale(f->anchor * c->share[j], vec3_sub(vec3_at(f->u, j), vec3_at(f->before, j)));
        const double held = vec3_norm(drag);
        change = cpsi_max_nan(change, vec3_norm(vec3_sub(vec3_load(friction_force),
                                                         vec3_at(f->friction_force, j))));
        change = cpsi_max_nan(change, fabs(push - f->push[j]));
        change = cpsi_max_nan(change, held);
        if (held > held_most) {
            held_most = held;
            vec3_store(r->unbalanced, drag);
            r->unbalanced_arc = c->arc[j];
        }
        memcpy(f->friction_force + 3 * (size_t)j, friction_force, sizeof friction_force);
        f->push[j] = push;
    }
    memcpy(f->before, f->u, 3 * ((size_t)c->cells + 1) * sizeof(double));
    return change;
}

/* rounding error of a force at the present displacements */
static double rounding(const CpsiFirstOrder *f) {
    const CpsiCells *c = &f->step->own;
    double far = 0, stiffest = 0;
    for (int j = 0; j <= c->cells; ++j) far = fmax(far, vec3_norm(vec3_at(f->u, j)));
    for (int i = 0; i < c->cells; ++i)
        stiffest = fmax(stiffest, 1 / c->width[i] / f->step->compliance);
    return 8 * DBL_EPSILON * far * (stiffest + f->augment * f->step->length);
}

/* Rounds of multipliers until they converge, until the anchor has carried the same force for
 * several rounds, or up to the limit of rounds. */
static void run_rounds(CpsFirstOrder *s) {
    CpsiFirstOrder *f = &s->f;
    CpsFirstOrderReport *r = &s->report;
    const double unit = 1 / f->step->compliance / (f->step->length * f->step->length),
                 force = f->step->force;
    const CpsiSmooth smooth = cpsi_first_order_smooth(f);
    f->augment = AUGMENT_FIRST * unit;
    f->anchor = ANCHOR * unit;
    r->outcome = CPS_FIRST_ORDER_OUTCOME_UNDECIDED;
    double held_before = 0;
    for (int stuck = 0; r->round_count < MAX_ROUNDS && stuck < STUCK_ROUNDS; ++r->round_count) {
        const double noise = fmin(rounding(f), FORCE_ROUNDING * force);
        CpsiDampedNewton newton = {.tolerance = fmax(0.1 * FORCE_TOLERANCE * force, noise),
                                   .max_iterations = NEWTON_LIMIT};
        cpsi_newton_minimise(&smooth, s->unknown, &newton, s->work);
        cpsi_first_order_store(f, s->unknown);
        r->iteration_count += newton.iterations;
        const double residual_before = r->round_count > 0 ? r->residual : INFINITY;
        r->residual = fmax(accept_solution(f, r), newton.residual);
        if (r->residual <= fmax(FORCE_TOLERANCE * force, 10 * newton.tolerance)) {
            r->outcome = CPS_FIRST_ORDER_OUTCOME_SOLVED;
            return;
        }

        /* a force on the anchor that does not decrease is balanced by nothing else */
        const double held = vec3_norm(vec3_load(r->unbalanced));
        stuck = held > 1e-6 * force && held > 0.99 * held_before ? stuck + 1 : 0;
        held_before = held;
        if (r->residual > SLOW * residual_before)
            f->augment = fmin(AUGMENT_GROWTH * f->augment, AUGMENT_MOST * unit);
        if (stuck == STUCK_ROUNDS) r->outcome = CPS_FIRST_ORDER_OUTCOME_UNBALANCED;
    }
}

/* ---- the answer ---- */

/* At a slack free end (84) has T only along t_R, and by (86) it can only pull: the part of the end
 * force for which (87) then cannot hold. The obstacle balances what presses on it. In the lumped
 * model friction and weight of half an element may balance it too. */
static Vec3 end_excess(const CpsiFirstOrder *f) {
    const int last = f->step->own.cells;
    if (f->step->held || f->strain[last - 1] > 0) return vec3(0, 0, 0);
    const Vec3 force = vec3_load(f->step->end_force), t = vec3_at(f->tangent, last - 1),
               n = vec3_at(f->step->own.normal, last);
    const Vec3 rest = vec3_axpy(-fmax(0, vec3_dot(force, t)), t, force);
    const double down = isfinite(f->gap[last]) ? fmin(0, vec3_dot(rest, n)) : 0;
    return vec3_axpy(-down, n, rest);
}

static void judge_end(CpsFirstOrder *s) {
    CpsFirstOrderReport *r = &s->report;
    const Vec3 excess = end_excess(&s->f);
    if (r->outcome != CPS_FIRST_ORDER_OUTCOME_SOLVED ||
        !(vec3_norm(excess) > FORCE_TOLERANCE * s->f.step->force))
        return;
    r->outcome = CPS_FIRST_ORDER_OUTCOME_MESH;
    vec3_store(r->unbalanced, excess);
    r->unbalanced_arc = s->f.step->length;
}

static void finish(CpsFirstOrder *s) {
    CpsiFirstOrder *f = &s->f;
    CpsFirstOrderReport *r = &s->report;
    const CpsiCells *c = &f->step->own;
    const double tolerance = STRAIN_TOLERANCE * f->step->force * f->step->compliance;
    r->least_strain = INFINITY;
    for (int i = 0; i < c->cells; ++i) {
        double slope[3];
        cpsi_first_order_slope(f, i, slope);
        cpsi_first_order_tension(f, i, s->tension + 3 * (size_t)i);
        s->along[i] = vec3_dot(vec3_load(slope), vec3_at(f->tangent, i));
        if (f->strain[i] > 0) continue;
        if (s->along[i] < -tolerance) r->shortened += c->width[i];
        if (s->along[i] < r->least_strain) {
            r->least_strain = s->along[i];
            r->least_strain_arc = (c->arc[i] + c->arc[i + 1]) / 2;
        }
    }
    for (int j = 0; j <= c->cells; ++j) {
        const Vec3 reached = vec3_add(vec3_at(c->reference, j), vec3_at(f->u, j));
        vec3_store(s->friction_force + 3 * (size_t)j,
                   vec3_scale(-1, vec3_at(f->friction_force, j)));
        r->against_step =
            cpsi_max_nan(r->against_step, vec3_norm(vec3_sub(reached, vec3_at(c->position, j))));
    }
    if (r->outcome == CPS_FIRST_ORDER_OUTCOME_SOLVED && r->shortened > 0)
        r->outcome = CPS_FIRST_ORDER_OUTCOME_SHORTENS;
    if (r->outcome != CPS_FIRST_ORDER_OUTCOME_UNBALANCED) {
        memset(r->unbalanced, 0, sizeof r->unbalanced);
        r->unbalanced_arc = 0;
    }
    judge_end(s);
}

CpsStatus cps_first_order_solve(const CpsRegularized *regularized, CpsFirstOrderContact contact,
                                CpsFirstOrder **out, CpsError *err) {
    if (!regularized || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "regularized or out is NULL");
    *out = NULL;
    if (contact != CPS_FIRST_ORDER_CONTACT_REFERENCE && contact != CPS_FIRST_ORDER_CONTACT_REACHED)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "contact: found %d, expected reference or reached",
                         (int)contact);
    CpsFirstOrder *s = calloc(1, sizeof *s);
    if (!s) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const CpsiStep *step = &regularized->step;
    layout(s, step->own.cells, &s->arena);
    if (!cpsi_arena_allocate(&s->arena)) {
        free(s);
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    }
    layout(s, step->own.cells, &s->arena);
    s->f.step = step;
    s->elements = step->own.cells;
    s->f.unknowns = 3 * (step->own.cells - (step->held ? 1 : 0));
    memcpy(s->arc, step->own.arc, ((size_t)step->own.cells + 1) * sizeof(double));
    set_reference(&s->f, &s->report);
    set_contact(&s->f, contact);
    s->report.contact = contact;
    run_rounds(s);
    finish(s);
    *out = s;
    return CPS_OK;
}

void cps_first_order_destroy(CpsFirstOrder *solution) {
    if (!solution) return;
    cpsi_arena_free(&solution->arena);
    free(solution);
}

CpsFirstOrderReport cps_first_order_report(const CpsFirstOrder *solution) {
    return solution ? solution->report
                    : (CpsFirstOrderReport){.outcome = CPS_FIRST_ORDER_OUTCOME_UNDECIDED};
}

CpsFirstOrderView cps_first_order_view(const CpsFirstOrder *solution) {
    if (!solution) return (CpsFirstOrderView){0};
    return (CpsFirstOrderView){.element_count = solution->elements,
                               .arc_length = solution->arc,
                               .displacement = solution->f.u,
                               .strain = solution->along,
                               .tension = solution->tension,
                               .friction_force = solution->friction_force,
                               .reaction = solution->f.push};
}
