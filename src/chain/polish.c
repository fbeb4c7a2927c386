/* SPDX-License-Identifier: BSD-3-Clause */
/* The last digits of a solution (polish.h). Until Newton's method ends it changes u, e, the
 * tensions and reactions, and of the friction discs the first number of s, which holds their
 * status. */
#include "chain/polish.h"

#include <math.h>
#include <string.h>

#include "chain/active_set.h"

/* The compliance of an inextensible line, per length and force of the program, where slips are told
 * from forces below their bounds. */
static const double LEAST_COMPLIANCE = 1e-9;

/* The elements beside a node of the program, or the element of a point: first to last. */
static void elements_beside(const CpsiChainProgram *program, int node, int *first, int *last) {
    const int n = program->n;
    *first = node < n ? node : node - n;
    *last = node < n ? node + 1 : node - n;
    if (*first < 1) *first = 1;
    if (*last > n - 1) *last = n - 1;
}

/* The stiffness of the elements beside a node, against its slip. */
static double stiffness_beside(const CpsiChainProgram *program, int node) {
    const CpsiSegment *segment = &program->segment;
    int first, last;
    double most = 0;
    elements_beside(program, node, &first, &last);
    for (int i = first; i <= last; i++)
        most = fmax(most, 1 / (fmax(cpsi_segment_compliance(segment, i), LEAST_COMPLIANCE) *
                               segment->length[i]));
    return most;
}

bool cpsi_chain_disc_slips(const CpsiChainProgram *program, int d) {
    const CpsiFrictionDisc *disc = &program->disc;
    const double *s = disc->s[d], *z = disc->z[d];
    const double stiffness = stiffness_beside(program, disc->node[d]) / disc->weight[d];
    return stiffness * hypot(s[1], s[2]) > z[0] - hypot(z[1], z[2]);
}

bool cpsi_chain_conic_slips(const CpsiChainProgram *program, int k) {
    const CpsiFrictionConic *conic = &program->conic;
    const double stiffness = stiffness_beside(program, conic->node[k]) / conic->weight[k];
    return stiffness * cpsi_friction_conic_slip(program, k) >
           conic->bound[k] * cpsi_friction_conic_margin(conic, k);
}

/* Does the line press on contact k in the solution of the loop? Of the distance, times the
 * stiffness of the node across the line, and the reaction, the larger one is not zero. On a fine
 * mesh the first distances are far smaller than the reactions that the loop leaves there. A node in
 * a corner is held by more than the line. */
static bool presses(const CpsiChainProgram *program, int k) {
    const CpsiUnilateral *unilateral = &program->unilateral;
    const CpsiSegment *segment = &program->segment;
    const int node = unilateral->node[k];
    const bool is_second = unilateral->normal && unilateral->second[k];
    const double weight = unilateral->weight[k];
    int first, last;
    double across = program->field && node < program->n ? program->field[6 * node + 5] : 0;
    elements_beside(program, node, &first, &last);
    for (int i = first; i <= last; i++) across += segment->z[i][0] / segment->length[i];
    const double stiffness = is_second ? weight : fmax(across, weight);
    return weight * unilateral->z[k] > stiffness * unilateral->s[k];
}

static void keep(const CpsiChainProgram *program, const CpsiKept *kept) {
    const CpsiSegment *segment = &program->segment;
    const CpsiUnilateral *unilateral = &program->unilateral;
    const size_t n = (size_t)program->n;
    memcpy(kept->u, program->base.u, 3 * n * sizeof *kept->u);
    if (program->matrix.share)
        memcpy(kept->points, &program->base.u[3 * n], 3 * n * sizeof *kept->points);
    for (int i = 1; i < program->n; i++) {
        memcpy(&kept->e[3 * (i - 1)], &segment->s[i][1], 3 * sizeof *kept->e);
        kept->tension[i - 1] = segment->z[i][0];
    }
    memcpy(unilateral->dz, unilateral->z, (size_t)unilateral->count * sizeof *unilateral->z);
    for (int d = 0; d < program->disc.count; d++) program->disc.g[d] = program->disc.s[d][0];
}

static void restore(CpsiChainProgram *program, const CpsiKept *kept) {
    const CpsiSegment *segment = &program->segment;
    const CpsiUnilateral *unilateral = &program->unilateral;
    const size_t n = (size_t)program->n;
    memcpy(program->base.u, kept->u, 3 * n * sizeof *kept->u);
    if (program->matrix.share)
        memcpy(&program->base.u[3 * n], kept->points, 3 * n * sizeof *kept->points);
    for (int i = 1; i < program->n; i++) {
        memcpy(&segment->s[i][1], &kept->e[3 * (i - 1)], 3 * sizeof *kept->e);
        segment->z[i][0] = kept->tension[i - 1];
    }
    memcpy(unilateral->z, unilateral->dz, (size_t)unilateral->count * sizeof *unilateral->z);
    for (int d = 0; d < program->disc.count; d++) program->disc.s[d][0] = program->disc.g[d];
}

/* Behind the discs, one for each friction conic, with its set as its shape. False where that is not
 * known. */
static bool put_discs(CpsiChainProgram *program) {
    const CpsiFrictionConic *conic = &program->conic;
    CpsiFrictionDisc *disc = &program->disc;
    for (int k = 0, d = disc->count; k < conic->count; k++, d++) {
        if (!disc->shape[d]) return false;
        const double bound = program->bounds_coupled
                                 ? conic->friction[k] * program->unilateral.z[conic->unilateral[k]]
                                 : conic->bound[k];
        double force[2];
        cpsi_friction_conic_force(conic, k, force);
        disc->node[d] = conic->node[k];
        disc->contact[d] = conic->contact[k];
        disc->weight[d] = conic->weight[k];
        disc->unilateral[d] = conic->unilateral[k];
        disc->friction[d] = conic->friction[k];
        disc->s[d][0] = cpsi_chain_conic_slips(program, k);
        disc->z[d][0] = bound;
        for (int a = 0; a < 2; a++) disc->z[d][1 + a] = bound > 0 ? force[a] / bound : 0;
        if (disc->map) memcpy(disc->map[d], conic->tangent[k], sizeof disc->map[d]);
        if (disc->offset) memcpy(disc->offset[d], conic->offset[k], sizeof disc->offset[d]);
    }
    return true;
}

CpsiIpmReport cpsi_chain_polish(CpsiChainProgram *program, const CpsiKept *kept,
                                int max_iterations) {
    const int conics = program->conic.count, discs = program->disc.count;
    const CpsiUnilateral *unilateral = &program->unilateral;
    CpsiFrictionDisc *disc = &program->disc;
    if (!put_discs(program)) return (CpsiIpmReport){.outcome = CPSI_IPM_STALLED};
    keep(program, kept);
    for (int d = 0; d < discs; d++) disc->s[d][0] = cpsi_chain_disc_slips(program, d);
    for (int k = 0; k < unilateral->count; k++)
        if (!presses(program, k)) unilateral->z[k] = 0;
    disc->count += conics;
    program->conic.count = 0;
    const CpsiIpmReport report = cpsi_chain_active_set(program, max_iterations, true, 0);
    if (report.outcome == CPSI_IPM_SOLVED) return report;
    disc->count = discs;
    program->conic.count = conics;
    restore(program, kept);
    return report;
}
