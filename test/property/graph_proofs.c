/* SPDX-License-Identifier: BSD-3-Clause */
/* Proofs and inextensible lines of random graphs (graph_proofs.h). */
#include "graph_proofs.h"

#include <math.h>
#include <stdio.h>

enum { MOST = 2000 };
/* Balance of a self-stress, unit vectors, and numbers that are computed twice. */
static const double BALANCED = 1e-8, UNIT = 1e-9, SAME = 1e-9;
/* An inextensible element is longer by no more than this, and loose where it is shorter by LOOSE:
 * what rests slack has the strain RESTING as elsewhere. */
static const double LONGER = 2e-9, LOOSE = 1e-5;

static double norm(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }
static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static bool is_held(const GraphStep *step, int point) {
    return step->scene->point[point].kind == CPS_POINT_KIND_HELD;
}

/* Mark the lines of a group from one of them on. */
static void mark(const GraphStep *step, int from, bool in[MOST]) {
    const CpsScene *scene = step->scene;
    in[from] = true;
    for (bool more = true; more;) {
        more = false;
        for (int i = 0; i < scene->line_count; i++)
            for (int k = 0; k < scene->line_count; k++)
                for (int e = 0; e < 4; e++) {
                    const int point = scene->line[i].end_point[e / 2];
                    if (!in[i] || in[k] || is_held(step, point) ||
                        scene->line[k].end_point[e % 2] != point)
                        continue;
                    in[k] = more = true;
                }
    }
}

static void place_of(const GraphStep *step, int point, double x[3]) {
    const CpsPointReport report = cps_evolution_point_report(step->evolution, point);
    for (int a = 0; a < 3; a++)
        x[a] = is_held(step, point) ? step->at[point][a] : report.position[a];
}

static bool self_stress_holds(const GraphStep *step, const bool in[MOST], double claimed) {
    const CpsScene *scene = step->scene;
    double left[MOST][3] = {{0}}, sum = 0, reach = 0, most = 0, imbalance = 0;
    for (int i = 0; i < scene->line_count; i++) {
        const CpsLine *line = &scene->line[i];
        const CpsLineReport report = cps_evolution_line_report(step->evolution, i);
        if (!in[i]) continue;
        double x[2][3], span[3];
        for (int end = 0; end < 2; end++) place_of(step, line->end_point[end], x[end]);
        for (int a = 0; a < 3; a++) {
            span[a] = x[1][a] - x[0][a];
            left[line->end_point[0]][a] += report.proof[a];
            left[line->end_point[1]][a] -= report.proof[a];
        }
        if (isfinite(line->stiffness) && norm(report.proof) != 0) return false;
        if (report.outcome != CPS_OUTCOME_INFEASIBLE || report.proof_length != claimed)
            return false;
        sum += dot(report.proof, span) - norm(report.proof) * line->length;
        reach += line->length + norm(span);
        most = fmax(most, norm(report.proof));
    }
    for (int i = 0; i < scene->point_count; i++)
        if (!is_held(step, i)) imbalance = fmax(imbalance, norm(left[i]));
    const bool good = sum > scene->point_count * imbalance * reach && imbalance <= BALANCED &&
                      fabs(most - 1) <= UNIT && fabs(sum - claimed) <= SAME * reach;
    if (!good)
        printf("  self-stress lacks %g, claimed %g, imbalance %g, largest %g\n", sum, claimed,
               imbalance, most);
    return good;
}

static bool fall_holds(const GraphStep *step, const bool in[MOST], const CpsLineReport *claim) {
    const CpsScene *scene = step->scene;
    const double *v = claim->proof, across = hypot(v[0], v[1]);
    double fall = 0, loads = 0;
    bool counted[MOST] = {false}, held = false;
    for (int i = 0; i < scene->line_count; i++) {
        const CpsLine *line = &scene->line[i];
        if (!in[i]) continue;
        fall -= line->weight * line->length * v[2];
        loads += fabs(line->weight * line->length);
        for (int end = 0; end < 2; end++) {
            const int point = line->end_point[end];
            held = held || is_held(step, point);
            if (counted[point]) continue;
            counted[point] = true;
            fall += dot(step->load[point], v);
            loads += norm(step->load[point]);
        }
    }
    const bool good = !held && fabs(norm(v) - 1) <= UNIT && fall > 0 &&
                      (step->mu < 0 || v[2] >= step->mu * across) &&
                      fabs(fall - claim->proof_force) <= SAME * loads;
    if (!good)
        printf("  falls by %g, claimed %g, along (%g %g %g)%s\n", fall, claim->proof_force, v[0],
               v[1], v[2], held ? ", held" : "");
    return good;
}

bool graph_proofs_hold(const GraphStep *step) {
    bool good = true;
    for (int i = 0; i < step->scene->line_count; i++) {
        const CpsLineReport report = cps_evolution_line_report(step->evolution, i);
        bool in[MOST] = {false};
        if (!cps_outcome_is_final(report.outcome)) continue;
        mark(step, i, in);
        good = good && (report.outcome == CPS_OUTCOME_INFEASIBLE
                            ? self_stress_holds(step, in, report.proof_length)
                            : fall_holds(step, in, &report));
    }
    return good;
}

bool graph_line_holds(const GraphStep *step, int index, double force) {
    const CpsLineView view = cps_evolution_line_view(step->evolution, index);
    const double weight = step->scene->line[index].weight, largest = fmax(force, 1e-300);
    double worst = 0;
    for (int e = 0; e < view.element_count; e++) {
        const double *p = &view.segment_force[3 * e], l = view.element_length[e];
        double d[3], tension = 0;
        for (int a = 0; a < 3; a++)
            d[a] = (view.position[3 * e + 3 + a] - view.position[3 * e + a]) / l;
        const double size = norm(d);
        if (!(size <= 1 + LONGER)) worst = INFINITY;
        tension = dot(p, d);
        worst = fmax(worst, size < 1 - LOOSE ? norm(p) : norm(p) - tension / fmax(size, 1e-300));
    }
    for (int j = 1; j < view.element_count; j++) {
        const double share = 0.5 * (view.element_length[j - 1] + view.element_length[j]),
                     R = step->mu < 0 ? 0 : view.reaction[j], *F = &view.friction_force[3 * j];
        double left[3];
        for (int a = 0; a < 3; a++)
            left[a] = view.segment_force[3 * j + a] - view.segment_force[3 * (j - 1) + a] +
                      (step->mu < 0 ? 0 : F[a]);
        left[2] += R - weight * share;
        worst = fmax(worst, norm(left));
        if (step->mu < 0) continue;
        worst = fmax(worst, norm(F) - step->mu * R);
        if (view.position[3 * j + 2] > 1e-8 * step->size) worst = fmax(worst, R);
        if (!(view.position[3 * j + 2] >= -1e-8 * step->size)) worst = INFINITY;
    }
    if (!(worst <= largest))
        printf("  line %d: %g of its laws, allowed %g\n", index, worst, largest);
    return worst <= largest;
}
