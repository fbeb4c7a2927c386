/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines that meet at joints, as one program (network.h). All lines have the units of the longest
 * one, and of the largest force. */
#include "cable/network.h"

#include <math.h>
#include <string.h>

#include "cable/contact.h"
#include "cable/contact_detection.h"
#include "cable/line_solve.h"
#include "chain/frame.h"

/* A guess needs no more: relative gap and iterations. */
static const double TARGET = 1e-10;
enum { ITERATIONS = 100 };

void cpsi_network_place(CpsiNetwork *network, CpsiArena *arena, const CpsiLine *line, int count,
                        int joints, const CpsiLinsysOps *ops) {
    const bool own_axes = count > 0 && line[0].has_local_axes;
    int most = 1;
    for (int k = 0; k < count; k++) most = line[k].n > most ? line[k].n : most;
    *network = (CpsiNetwork){.lines = count, .joints = joints};
    cpsi_network_layout(&network->program, arena, count + joints, 2 * most, joints);
    CPSI_PLACE(arena, network->chain, count + joints);
    for (int k = 0; k < count + joints; k++) {
        CpsiChainProgram none, *chain = network->chain ? &network->chain[k] : &none;
        if (k < count)
            cpsi_chain_program_layout(chain, arena, line[k].n, own_axes ? line[k].contacts : 0,
                                      line[k].element_contacts > 0, NULL, ops);
        else
            cpsi_chain_program_layout(chain, arena, 1, own_axes ? 1 : 0, false, NULL, ops);
    }
}

/* The chain of one node that holds what the obstacle does to a joint. */
static void fill_joint(const CpsiJoint *joint, bool own_axes, CpsiChainProgram *chain,
                       const CpsiStepScale *scale) {
    cpsi_chain_program_resize(chain, 1, own_axes);
    chain->held[0] = 1;
    chain->drag = 0;
    chain->disc.count = chain->unilateral.count = 0;
    chain->bounds_coupled = scale->bounds == CPSI_BOUNDS_COUPLED;
    memset(chain->base.load, 0, 3 * sizeof(double));
    memset(chain->base.u, 0, 3 * sizeof(double));
    if (chain->frame) {
        static const double own[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
        memcpy(chain->frame, own, sizeof own);
    }
    if (!joint->obstacle) return;
    double curvature[3];
    if (chain->frame)
        cpsi_obstacle_axes(joint->obstacle, joint->position, vec3(1, 0, 0), chain->frame,
                           curvature);
    CpsiUnilateral *unilateral = &chain->unilateral;
    const double share = joint->share / scale->length;
    unilateral->count = 1;
    unilateral->node[0] = unilateral->contact[0] = 0;
    unilateral->second[0] = false;
    unilateral->weight[0] = share;
    unilateral->gap[0] = fmax(0, joint->gap) / scale->length;
    if (chain->frame) {
        memset(unilateral->normal[0], 0, sizeof unilateral->normal[0]);
        unilateral->normal[0][2] = 1;
        memset(unilateral->curvature[0], 0, sizeof unilateral->curvature[0]);
    }
    if (!(scale->bounds == CPSI_BOUNDS_COUPLED ? joint->friction > 0 : joint->bound > 0)) return;
    CpsiFrictionDisc *disc = &chain->disc;
    disc->count = 1;
    disc->node[0] = disc->contact[0] = disc->unilateral[0] = 0;
    disc->weight[0] = share;
    disc->friction[0] = joint->friction;
    disc->z[0][0] = joint->bound / (scale->force * share);
    if (chain->frame) {
        memset(disc->map[0], 0, sizeof disc->map[0]);
        disc->map[0][0] = disc->map[0][4] = 1;
        disc->offset[0][0] = disc->offset[0][1] = 0;
    }
}

/* The units of all lines. */
static CpsiStepScale scale_of(const CpsiLine *line, const CpsiNetworkPart *part,
                              CpsiBounds bounds) {
    CpsiStepScale scale = {.longer = 1, .bounds = bounds};
    for (int k = 0; k < part->lines; k++) {
        const CpsiLine *one = &line[part->number[k]];
        scale.length = fmax(scale.length, one->length);
        scale.force = fmax(scale.force, cpsi_line_unit_force(one, bounds));
    }
    for (int k = 0; k < part->joints; k++)
        scale.force = fmax(scale.force, vec3_norm(part->joint[k].load));
    if (!(scale.force > 0)) scale.force = 1;
    return scale;
}

/* Contacts at the reference, in axes of their own where lines have them. */
static void set_reference(CpsiLine *line, const CpsiStepOptions *options) {
    cpsi_line_set_reference(line, options);
    if (!line->has_local_axes) return;
    cpsi_contact_detect(line, false);
    cpsi_contact_update_geometry(line);
}

/* Returns the sum of the loads. */
static double fill(CpsiNetwork *network, const CpsiLine *line, const CpsiNetworkPart *part,
                   const CpsiStepScale *scale) {
    CpsiNetworkProgram *program = &network->program;
    const CpsiLine *first = &line[part->number[0]];
    double loads = 0;
    program->count = part->lines + part->joints;
    program->joints = part->joints;
    program->base.size = 3 * part->joints;
    for (int k = 0; k < part->lines; k++) {
        CpsiChainProgram *chain = &program->chain[k];
        *chain = network->chain[part->number[k]];
        cpsi_step_program_fill(&line[part->number[k]], chain, scale);
        for (int i = 0; i < 3 * chain->n; i++) loads += fabs(chain->base.load[i]);
        memcpy(program->joint[k], part->at[k], sizeof program->joint[k]);
    }
    for (int k = 0; k < part->joints; k++) {
        CpsiChainProgram *chain = &program->chain[part->lines + k];
        double load[3];
        *chain = network->chain[network->lines + k];
        fill_joint(&part->joint[k], first->has_local_axes, chain, scale);
        program->joint[part->lines + k][CPSI_FIRST_NODE] = k;
        program->joint[part->lines + k][CPSI_LAST_NODE] = CPSI_NO_JOINT;
        vec3_store(load, vec3_scale(1 / scale->force, part->joint[k].load));
        cpsi_frame_to(&program->base.load[3 * k], first->common_axes, load);
        for (int a = 0; a < 3; a++) {
            loads += fabs(program->base.load[3 * k + a]);
            program->base.u[3 * k + a] = 0;
        }
    }
    return loads;
}

bool cpsi_network_guess(CpsiNetwork *network, CpsiLine *line, const CpsiNetworkPart *part,
                        const CpsiStepOptions *options, double *place, int *iterations) {
    const bool coupled = options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT &&
                         !options->frictionless && line->obstacle_count > 0;
    for (int k = 0; k < part->lines; k++) set_reference(&line[part->number[k]], options);
    const CpsiStepScale scale =
        scale_of(line, part, coupled ? CPSI_BOUNDS_COUPLED : CPSI_BOUNDS_FIXED);
    const double loads = fill(network, line, part, &scale);
    const CpsiIpmOptions ipm = {.target = TARGET,
                                .scale = loads > 0 ? loads : 1,
                                .max_iterations = ITERATIONS};
    const CpsiIpmReport report = cpsi_ipm_solve(&network->program.base, &ipm);
    *iterations = report.iterations;
    for (int k = 0; k < part->joints; k++) {
        double move[3];
        cpsi_frame_from(move, line[part->number[0]].common_axes, &network->program.base.u[3 * k]);
        vec3_store(&place[3 * k],
                   vec3_axpy(scale.length, vec3_load(move), part->joint[k].position));
    }
    return report.outcome == CPSI_IPM_SOLVED;
}
