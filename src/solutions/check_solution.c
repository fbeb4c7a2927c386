/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether a configuration is a solution of a solved step, and if not, why not: S90 theorem 6.3, in
 * the form of the local gaps of docs/theory.md (3). With forces p, F, R in equilibrium,
 *
 *    J** + j at y - minimum = sum l (W(e) + W*(p) - p.e) + sum (A |u_T| + F.u_T)
 *                             + sum R (n.u + gap),
 *
 * up to the gap of the step itself. Each sum is 0 exactly where y has the tension field p, slides
 * in the normal cone of F, and keeps contact where R > 0. Every term is written without
 * cancellation. */
#include <math.h>

#include "base/element_law.h"
#include "base/larger.h"
#include "base/status.h"
#include "base/words.h"
#include "capstan/evolve.h"
#include "regularized/band_blocks.h"

static const CpsiWords JUDGEMENT[] = {CPS_JUDGEMENT_LIST(CPSI_WORDS_WITH_KEY)};

const char *cps_judgement_name(CpsJudgement judgement) {
    return CPSI_WORDS(JUDGEMENT, judgement).name;
}

const char *cps_judgement_text(CpsJudgement judgement) {
    return CPSI_WORDS(JUDGEMENT, judgement).text;
}

/* A sum, and the place of its largest term. */
typedef struct Worst {
    double sum, most, arc;
} Worst;

static void accept(Worst *worst, double value, double arc) {
    worst->sum += value;
    if (value > worst->most || value != value) {
        worst->most = value;
        worst->arc = arc;
    }
}

/* W(e) + W*(p) - p.e with W = ((|e| - 1)^+)^2/(2c), W* = |p| + c |p|^2/2, written as a sum of
 * nonnegative terms: |p||e| - p.e = |p x e|^2/(|p||e| + p.e), and (d - c|p|)^2/(2c) or |p| (1 -
 * |e|) with d = (|e| - 1)^+, and the like of springs beside it (base/element_law.h). For an
 * inextensible line d has to be 0, which is checked as a length. */
static double segment_gap(const CpsiElementLaw *law, Vec3 e, Vec3 p) {
    const double c = law->compliance;
    const double length = vec3_norm(e), force = vec3_norm(p);
    const double longer = fmax(0, length - 1), shorter = fmax(0, 1 - length);
    const double stretched = c > 0 ? cpsi_law_gap(law, longer, force) : 0;
    return vec3_angle_defect(p, e, force, length) + stretched + force * shorter;
}

/* A |u| + F.u, at least 0 for |F| <= A */
static double slip_gap(double bound, Vec3 slip, Vec3 friction_force) {
    const double length = vec3_norm(slip), force = vec3_norm(friction_force);
    return fmax(0, bound - force) * length +
           vec3_angle_defect(vec3_scale(-1, friction_force), slip, force, length);
}

/* Smallest limit of a gap, per length and force, where the force is the largest or that of all
 * loads together (docs/theory.md (5)). */
static const double GAP_FLOOR = 1e-12;

static bool held(const CpsLineView *step, int node) {
    return (node == 0 && step->end[CPS_END_A].kind == CPS_END_KIND_HELD) ||
           (node == step->element_count && step->end[CPS_END_B].kind == CPS_END_KIND_HELD);
}

/* The law of element i, whose springs begin at *spring, which moves on to those of the next; a view
 * that is not of an evolution may have no factors */
static CpsiElementLaw law_of(const CpsLineView *step, int i, int *spring) {
    CpsiElementLaw law = {.compliance = step->compliance, .longer = 1, .stiffer = 1};
    if (step->compliance_factor) law.compliance *= step->compliance_factor[i];
    if (*spring >= step->spring_count || step->spring_element[*spring] != i) return law;
    law.start = &step->spring_strain[*spring];
    law.stiffness = &step->spring_stiffness[*spring];
    for (; *spring < step->spring_count && step->spring_element[*spring] == i; ++*spring)
        law.count++;
    return law;
}

/* S of docs/theory.md (5), for the step's own solution */
static double scale_of(const CpsLineView *step, double tolerance) {
    double scale = 0, work = 0, moment = 0, loads = 0, largest = 0;
    for (int i = 0, spring = 0; i < step->element_count; ++i) {
        const CpsiElementLaw law = law_of(step, i, &spring);
        const double force = vec3_norm(vec3_at(step->segment_force, i));
        scale += step->element_length[i] * (force + cpsi_law_strain(&law, force) * force);
        largest = cpsi_max_nan(largest, force);
    }
    for (int j = 0; j <= step->element_count; ++j) {
        const Vec3 x = vec3_at(step->position, j), u = vec3_sub(x, vec3_at(step->reference, j)),
                   n = vec3_at(step->normal, j), b = vec3_at(step->load, j);
        if (!held(step, j)) scale += step->friction_bound[j] * vec3_norm(vec3_reject(u, n));
        work += fabs(vec3_dot(b, u));
        loads += vec3_norm(b);
        moment += vec3_norm(b) * vec3_norm(vec3_sub(x, vec3_at(step->position, 0)));
        largest = cpsi_max_nan(largest, vec3_norm(vec3_at(step->friction_force, j)));
        if (!held(step, j)) largest = cpsi_max_nan(largest, step->reaction[j]);
    }
    work += GAP_FLOOR * cpsi_max_nan(loads, largest) * step->arc_length[step->element_count] /
            tolerance;
    return scale + (work <= moment ? work : moment);
}

typedef struct Case {
    Worst tension, contact, sliding, sunk, end, shorter, longer;
} Case;

static void check_node(const CpsLineView *step, const double *position, int j, Case *c) {
    const double arc = step->arc_length[j];
    if (held(step, j)) {
        accept(&c->end, vec3_norm(vec3_sub(vec3_at(position, j), vec3_at(step->position, j))), arc);
        return;
    }
    const Vec3 u = vec3_sub(vec3_at(position, j), vec3_at(step->reference, j)),
               n = vec3_at(step->normal, j);
    const double across = vec3_dot(u, n);
    accept(&c->sliding,
           slip_gap(step->friction_bound[j], vec3_axpy(-across, n, u),
                    vec3_at(step->friction_force, j)),
           arc);
    if (!isfinite(step->gap[j])) return;
    accept(&c->contact, step->reaction[j] * fmax(0, across + step->gap[j]), arc);
    accept(&c->sunk, fmax(0, -across - step->gap[j]), arc);
}

static void check_nodes(const CpsLineView *step, const double *position, Case *c) {
    for (int i = 0, spring = 0; i < step->element_count; ++i) {
        const CpsiElementLaw law = law_of(step, i, &spring);
        const double l = step->element_length[i], arc = step->arc_length[i] + l / 2;
        const Vec3 e = vec3_scale(1 / l, vec3_sub(vec3_at(position, i + 1), vec3_at(position, i)));
        const double stretch = vec3_norm(e);
        accept(&c->tension, l * segment_gap(&law, e, vec3_at(step->segment_force, i)), arc);
        accept(&c->shorter, fmax(0, 1 - stretch), arc);
        accept(&c->longer, step->compliance > 0 ? 0 : fmax(0, stretch - 1), arc);
    }
    for (int j = 0; j <= step->element_count; ++j) check_node(step, position, j, c);
}

CpsStatus cps_solution_judge(const CpsLineView *step, const double *position, double tolerance,
                             CpsJudgementReport *report, CpsError *err) {
    if (!step || !position || !report || step->element_count < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "step, position or report is NULL, or the step has no elements");
    if (!(tolerance > 0 && tolerance < 1))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "tolerance: found %g, expected a number between 0 and 1", tolerance);
    if (!step->one_plane)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "line '%s': more than one obstacle, or one that is curved, gives or has directions, a "
            "node that is grasped, a winch, springs, loads or drag; only planes with isotropic "
            "friction "
            "are judged",
            step->name);
    for (int j = 0; j <= step->element_count; ++j)
        if (!vec3_finite(position + 3 * (size_t)j))
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "position of node %d is not finite", j);
    Case c = {0};
    check_nodes(step, position, &c);
    const double scale = scale_of(step, tolerance), gap = tolerance * scale,
                 strain = sqrt(tolerance);
    const double length = tolerance * step->arc_length[step->element_count];
    const struct {
        bool fails;
        CpsJudgement judgement;
        const Worst *worst;
    } order[] = {{!(c.end.most <= length), CPS_JUDGEMENT_ENDS, &c.end},
                 {!(c.sunk.most <= length), CPS_JUDGEMENT_PENETRATES, &c.sunk},
                 {!(c.longer.most <= strain), CPS_JUDGEMENT_TENSION, &c.longer},
                 {!(c.tension.sum <= gap), CPS_JUDGEMENT_TENSION, &c.tension},
                 {!(c.contact.sum <= gap), CPS_JUDGEMENT_CONTACT, &c.contact},
                 {!(c.sliding.sum <= gap), CPS_JUDGEMENT_SLIDING, &c.sliding},
                 {!(c.shorter.most <= strain), CPS_JUDGEMENT_RELAXED, &c.shorter}};
    *report = (CpsJudgementReport){.scale = scale,
                                   .energy = c.tension.sum + c.contact.sum + c.sliding.sum,
                                   .tension = c.tension.sum,
                                   .contact = c.contact.sum,
                                   .sliding = c.sliding.sum,
                                   .penetration = c.sunk.most,
                                   .end_error = c.end.most,
                                   .shortening = c.shorter.most};
    for (size_t i = 0; i < sizeof order / sizeof *order; ++i)
        if (order[i].fails) {
            report->judgement = order[i].judgement;
            report->arc_length = order[i].worst->arc;
            break;
        }
    return CPS_OK;
}
