/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines that meet at joints, as one program (network.h). All lines have the units of the longest
 * one, and of the largest force. */
#include "cable/network.h"

#include <math.h>
#include <string.h>

#include "cable/contact.h"
#include "cable/contact_detection.h"
#include "cable/end_set.h"
#include "cable/line_solve.h"
#include "cable/rounds.h"
#include "cable/soft.h"
#include "chain/frame.h"

enum { ITERATIONS = 100 };
/* A solution that has come so near is one, whether or not it was to be better. */
static const double ENOUGH = 1e-10;
/* Bounded forces that are far larger than those of the lines slow the first iterations, in which
 * their joints hardly move; and so does the slack of nets, most of whose sides are not to be taut.
 */
enum { PATIENT = 40 };
/* Lines that are pulled far by what is held may suggest a unit of force far above all forces found,
 * and the loop ends early: then it is begun again in smaller units, down to this share. */
static const double SMALLER = 0.1, SMALLEST = 1e-4;
/* The cosine of the angle at which planes are the same. */
static const double LEVEL = 1 - 1e-12;
/* An anchor holds this many times the largest force across its plane. */
static const double ACROSS = 1e3;

static void place_bases(CpsiNetwork *network, CpsiArena *arena, const CpsiLine *line, int count) {
    CPSI_PLACE(arena, network->base, count);
    CPSI_PLACE(arena, network->obstacle_index, count);
    for (int k = 0; k < count; k++) {
        double *none, **base = network->base ? &network->base[k] : &none;
        int *no_index, **index = network->obstacle_index ? &network->obstacle_index[k] : &no_index;
        CPSI_PLACE(arena, *base, 3 * (size_t)line[k].n);
        CPSI_PLACE(arena, *index, cpsi_line_all_contacts(&line[k]));
    }
}

void cpsi_network_place(CpsiNetwork *network, CpsiArena *arena, const CpsiLine *line, int count,
                        int joints, int bodies, const CpsiLinsysOps *ops,
                        const CpsiNetworkTools *tools) {
    const bool own_axes = count > 0 && line[0].has_local_axes,
               soft = count > 0 && cpsi_line_has_soft(&line[0]);
    int most = 1;
    for (int k = 0; k < count; k++) most = line[k].n > most ? line[k].n : most;
    *network = (CpsiNetwork){.lines = count, .joints = joints};
    cpsi_network_layout(&network->program, arena, count + joints, 2 * most, joints, bodies, tools);
    CPSI_PLACE(arena, network->chain, count + joints);
    CPSI_PLACE(arena, network->joined, count);
    if (own_axes) place_bases(network, arena, line, count);
    for (int k = 0; k < count + joints; k++) {
        CpsiChainProgram none, *chain = network->chain ? &network->chain[k] : &none;
        if (k < count)
            cpsi_chain_program_layout(chain, arena, line[k].n, own_axes ? line[k].contacts : 0,
                                      line[k].element_contacts > 0,
                                      cpsi_line_most_springs(&line[k]), NULL, ops);
        else
            cpsi_chain_program_layout(chain, arena, 1, own_axes ? 1 : 0, false, 0, NULL, ops);
        if (soft)
            cpsi_chain_program_layout_compliance(chain, arena, k < count ? line[k].n : 1,
                                                 own_axes ? (k < count ? line[k].contacts : 1) : 0,
                                                 k < count && line[k].element_contacts > 0);
    }
}

/* Along the ground an anchor that drags is held by friction of a given bound. Its disc lies in the
 * third plane of the axes: of its own, or of the common ones where these lie in the ground. */
static bool has_disc(const CpsiJoint *joint, bool own_axes, const double axes[9]) {
    return joint->drags && (own_axes || fabs(vec3_dot(vec3_load(&axes[6]), joint->normal)) > LEVEL);
}

static void fill_anchor(const CpsiJoint *joint, CpsiChainProgram *chain,
                        const CpsiStepScale *scale) {
    CpsiFrictionDisc *disc = &chain->disc;
    chain->bounds_coupled = false;
    disc->count = 1;
    disc->node[0] = disc->contact[0] = disc->unilateral[0] = 0;
    disc->weight[0] = joint->share / scale->length;
    disc->z[0][0] = joint->capacity / (scale->force * disc->weight[0]);
    if (!chain->frame) return;
    const Vec3 n = joint->normal,
               across = vec3_cross(n, fabs(n.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0)),
               one = vec3_scale(1 / vec3_norm(across), across);
    vec3_store(&chain->frame[0], one);
    vec3_store(&chain->frame[3], vec3_cross(n, one));
    vec3_store(&chain->frame[6], n);
    memset(disc->map[0], 0, sizeof disc->map[0]);
    disc->map[0][0] = disc->map[0][4] = 1;
    double gone[3], own[3];
    vec3_store(gone, joint->dragged);
    cpsi_frame_to(own, chain->frame, gone);
    for (int a = 0; a < 2; a++) disc->offset[0][a] = own[a] / scale->length;
}

/* The chain of one node that holds what the obstacle does to a joint. */
static void fill_joint(const CpsiJoint *joint, bool own_axes, const double axes[9],
                       CpsiChainProgram *chain, const CpsiStepScale *scale) {
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
    if (joint->on)
        cpsi_end_set_fill(joint->on, 0, joint->position, chain->frame ? chain->frame : axes,
                          scale->length, &chain->constraints);
    if (has_disc(joint, own_axes, axes)) fill_anchor(joint, chain, scale);
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
    unilateral->gap[0] = (joint->gives ? joint->gap : fmax(0, joint->gap)) / scale->length;
    if (unilateral->compliance) {
        const double gives = joint->spring * scale->length;
        unilateral->compliance[0] = joint->gives && gives > 0 ? share * scale->force / gives : 0;
    }
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
        double slip[3], own[3];
        vec3_store(slip, joint->slip);
        cpsi_frame_to(own, chain->frame, slip);
        for (int a = 0; a < 2; a++) disc->offset[0][a] = own[a] / scale->length;
    }
}

/* Where forces of the given size on joint k may be found along d: R d, -A < R < 0. */
static void add_hinge(const CpsiJoint *joint, int k, Vec3 d, double size, double gap,
                      const double axes[9], const CpsiStepScale *scale, CpsiHinges *hinges) {
    const int i = hinges->count++;
    double own[3];
    vec3_store(own, d);
    hinges->first[i] = 3 * k;
    cpsi_frame_to(hinges->direction[i], axes, own);
    hinges->weight[i] = joint->share / scale->length;
    hinges->bound[i] = size / (scale->force * hinges->weight[i]);
    hinges->gap[i] = gap / scale->length;
}

/* Forces between -A and A: those of a hinge of 2 A and the load A. */
static void add_both_ways(const CpsiJoint *joint, int k, Vec3 d, double size, const double axes[9],
                          const CpsiStepScale *scale, CpsiNetworkProgram *program) {
    const int i = program->hinges.count;
    add_hinge(joint, k, d, 2 * size, -vec3_dot(joint->dragged, d), axes, scale, &program->hinges);
    for (int a = 0; a < 3; a++)
        program->base.load[3 * k + a] += size / scale->force * program->hinges.direction[i][a];
}

/* What holds a joint back that leaves the water, whose load has the buoyancy of one that is in it;
 * and an anchor, without its disc with a square in place of it. */
static void add_bounded_forces(const CpsiJoint *joint, int k, bool has_disc, const double axes[9],
                               const CpsiStepScale *scale, CpsiNetworkProgram *program) {
    if (joint->displaced > 0)
        add_hinge(joint, k, vec3(0, 0, 1), joint->displaced, joint->depth, axes, scale,
                  &program->hinges);
    if (!joint->drags) return;
    const Vec3 n = joint->normal, away = fabs(n.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const Vec3 across = vec3_cross(n, away), one = vec3_scale(1 / vec3_norm(across), across);
    if (!has_disc) {
        add_both_ways(joint, k, one, joint->capacity, axes, scale, program);
        add_both_ways(joint, k, vec3_cross(n, one), joint->capacity, axes, scale, program);
    }
    add_both_ways(joint, k, n, ACROSS * scale->force, axes, scale, program);
}

/* The units of all lines. */
static CpsiStepScale scale_of(const CpsiLine *line, const CpsiNetworkPart *part,
                              CpsiBounds bounds) {
    CpsiStepScale scale = {.longer = part->longer, .bounds = bounds};
    for (int k = 0; k < part->lines; k++) {
        const CpsiLine *one = &line[part->number[k]];
        scale.length = fmax(scale.length, one->length);
        scale.force = fmax(scale.force, cpsi_line_unit_force(one, bounds));
    }
    for (int k = 0; k < part->own; k++)
        scale.force = fmax(scale.force, vec3_norm(part->joint[k].load));
    for (int k = 0; k < part->bodies; k++)
        scale.force = fmax(scale.force, vec3_norm(part->body[k].force));
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

/* Contacts where the last guess left the line. */
static void update_base(CpsiLine *line) {
    cpsi_contact_detect(line, false);
    cpsi_contact_update_geometry(line);
}

/* The ends of a line with axes of its own are where the joints are. */
static void move_ends(CpsiLine *line, const CpsiNetworkPart *part, int item) {
    for (int end = 0; end < 2 && line->has_local_axes; end++) {
        const int k = part->at[item][end], beyond = line->drums.nodes[end],
                  first = end == CPS_END_A ? 0 : line->n - 1 - beyond;
        if (k == CPSI_NO_JOINT || k >= part->own) continue;
        for (int j = first; j <= first + beyond; j++)
            vec3_store(&line->base[3 * j], part->joint[k].position);
    }
}

/* The joint of the program that joint k is, in units of the program. */
static void fill_map(const CpsiNetworkPart *part, int k, const double axes[9],
                     const CpsiStepScale *scale, CpsiJointMap *map) {
    const CpsiJoint *joint = &part->joint[k];
    *map = cpsi_joint_map_of_point(3 * k);
    if (k < part->own) return;
    const bool *fixed = part->body[joint->body].fixed;
    double arm[3], a[3], free[2][9] = {{0}};
    vec3_store(arm, vec3_scale(1 / scale->length, joint->arm));
    cpsi_frame_to(a, axes, arm);
    for (int half = 0; half < 2; half++) {
        for (int i = 0; i < 3; i++) free[half][4 * i] = !fixed[3 * half + i];
        cpsi_frame_turn(free[half], axes, free[half]);
    }
    *map = cpsi_joint_map_on_body(3 * part->own + 6 * joint->body, vec3_load(a));
    for (int i = 0; i < 3; i++) {
        const Vec3 turned = vec3_load(&map->by[i][3]);
        for (int j = 0; j < 3; j++) {
            map->by[i][j] = free[0][3 * i + j];
            map->by[i][3 + j] =
                turned.x * free[1][j] + turned.y * free[1][3 + j] + turned.z * free[1][6 + j];
        }
    }
}

/* A stiffness (6, 6) in the common axes and the units of the program. */
static void fill_stiffness(const double given[36], const double axes[9], const CpsiStepScale *scale,
                           double out[36]) {
    for (int row = 0; row < 2; row++)
        for (int column = 0; column < 2; column++) {
            const double unit =
                (column == 0 ? scale->length : 1) / (scale->force * (row == 0 ? 1 : scale->length));
            double block[9];
            for (int i = 0; i < 9; i++)
                block[i] = given[6 * (3 * row + i / 3) + 3 * column + i % 3];
            cpsi_frame_turn(block, axes, block);
            for (int i = 0; i < 9; i++)
                out[6 * (3 * row + i / 3) + 3 * column + i % 3] = unit * block[i];
        }
}

/* A load in the common axes and the units of the program; returns the sum of its numbers. */
static double fill_load(Vec3 load, double unit, const double axes[9], double *out) {
    double own[3];
    vec3_store(own, vec3_scale(1 / unit, load));
    cpsi_frame_to(out, axes, own);
    return fabs(out[0]) + fabs(out[1]) + fabs(out[2]);
}

/* Returns the sum of the loads. */
static double fill(CpsiNetwork *network, const CpsiLine *line, const CpsiNetworkPart *part,
                   const CpsiStepScale *scale) {
    CpsiNetworkProgram *program = &network->program;
    const CpsiLine *first = &line[part->number[0]];
    const double *axes = first->common_axes;
    double loads = 0, *load = program->base.load;
    program->count = part->lines;
    program->joints = part->joints;
    program->bodies = part->bodies;
    program->hinges.count = 0;
    program->base.size = 3 * part->own + 6 * part->bodies;
    memset(load, 0, (size_t)program->base.size * sizeof *load);
    memset(program->base.u, 0, (size_t)program->base.size * sizeof *load);
    for (int k = 0; k < part->lines; k++) {
        CpsiChainProgram *chain = &program->chain[k];
        *chain = network->chain[part->number[k]];
        cpsi_step_program_fill(&line[part->number[k]], chain, scale);
        for (int i = 0; i < 3 * chain->n; i++) loads += fabs(chain->base.load[i]);
        memcpy(program->joint[k], part->at[k], sizeof program->joint[k]);
        memcpy(program->beyond[k], line[part->number[k]].drums.nodes, sizeof program->beyond[k]);
    }
    for (int k = 0; k < part->joints; k++) {
        fill_map(part, k, axes, scale, &program->map[k]);
        if (k >= part->own) continue;
        CpsiChainProgram *chain = &program->chain[program->count];
        *chain = network->chain[network->lines + k];
        fill_joint(&part->joint[k], first->has_local_axes, axes, chain, scale);
        program->joint[program->count][CPSI_FIRST_NODE] = k;
        program->joint[program->count][CPSI_LAST_NODE] = CPSI_NO_JOINT;
        memset(program->beyond[program->count], 0, sizeof program->beyond[0]);
        program->count++;
        loads += fill_load(part->joint[k].load, scale->force, axes, &load[3 * k]);
        add_bounded_forces(&part->joint[k], k,
                           has_disc(&part->joint[k], first->has_local_axes, axes), axes, scale,
                           program);
    }
    for (int k = 0; k < part->bodies; k++) {
        const CpsiNetworkBody *body = &part->body[k];
        const int at = program->body_first[k] = 3 * part->own + 6 * k;
        fill_stiffness(body->stiffness, axes, scale, program->stiffness[k]);
        loads += fill_load(body->force, scale->force, axes, &load[at]);
        loads += fill_load(body->moment, scale->force * scale->length, axes, &load[at + 3]);
    }
    return loads;
}

/* What the larger of each pair of the solution says. */
static CpsiJointState state_of(const CpsiChainProgram *chain) {
    const CpsiUnilateral *unilateral = &chain->unilateral;
    const CpsiFrictionDisc *disc = &chain->disc;
    if (unilateral->count == 0 || !(unilateral->z[0] > unilateral->s[0])) return CPSI_JOINT_OFF;
    if (disc->count == 0) return CPSI_JOINT_SLIDES;
    const double *z = disc->z[0], inside = z[0] - sqrt(z[1] * z[1] + z[2] * z[2]);
    return inside > disc->s[0][0] ? CPSI_JOINT_STICKS : CPSI_JOINT_SLIDES;
}

/* The part of the solution of line `item`. */
static CpsiJoined part_of(const CpsiNetwork *network, const CpsiLine *line,
                          const CpsiNetworkPart *part, int item, const CpsiStepScale *scale,
                          const CpsiIpmReport *report) {
    CpsiJoined out = {.program = &network->program.chain[item], .scale = *scale, .ipm = *report};
    if (!line->has_local_axes) return out;
    double *base = network->base[part->number[item]];
    int *index = network->obstacle_index[part->number[item]];
    memcpy(base, line->base, 3 * (size_t)line->n * sizeof *base);
    memcpy(index, line->obstacle_index, (size_t)cpsi_line_all_contacts(line) * sizeof *index);
    out.base = base;
    out.obstacle_index = index;
    return out;
}

/* Solve the program as `ipm` says, in units of its loads, and of a share of the force that its
 * lines suggest. */
static bool solve(CpsiNetwork *network, CpsiLine *line, const CpsiNetworkPart *part,
                  const CpsiStepOptions *options, CpsiIpmOptions ipm, double unit,
                  const CpsiNetworkMove *out) {
    const bool coupled = options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT &&
                         !options->frictionless && line->obstacle_count > 0;
    const double *axes = line[part->number[0]].common_axes, *u = network->program.base.u;
    for (int k = 0; k < part->lines; k++) {
        CpsiLine *one = &line[part->number[k]];
        if (!part->continues) set_reference(one, options);
        move_ends(one, part, k);
        if (part->continues && one->has_local_axes) update_base(one);
    }
    CpsiStepScale scale = scale_of(line, part, coupled ? CPSI_BOUNDS_COUPLED : CPSI_BOUNDS_FIXED);
    scale.force *= unit;
    network->unit_force = scale.force;
    const double loads = fill(network, line, part, &scale);
    ipm.scale = loads > 0 ? loads : 1;
    ipm.patience = PATIENT;
    const CpsiIpmReport report = cpsi_ipm_solve(&network->program.base, &ipm);
    network->found = report.outcome;
    for (int k = 0; k < part->lines; k++)
        network->joined[k] = part_of(network, &line[part->number[k]], part, k, &scale, &report);
    for (int k = 0; k < part->own; k++) {
        cpsi_frame_from(&out->joint[3 * k], axes, &u[3 * k]);
        for (int a = 0; a < 3; a++) out->joint[3 * k + a] *= scale.length;
        out->state[k] = state_of(&network->program.chain[part->lines + k]);
    }
    for (int k = 0; k < part->bodies; k++) {
        const double *move = &u[3 * part->own + 6 * k];
        cpsi_frame_from(&out->body[6 * k], axes, move);
        cpsi_frame_from(&out->body[6 * k + 3], axes, &move[3]);
        for (int a = 0; a < 3; a++) out->body[6 * k + a] *= scale.length;
    }
    for (int k = 0; k < part->lines; k++)
        for (int end = 0; end < 2; end++) {
            const CpsiChainProgram *chain = &network->program.chain[k];
            const int node = cpsi_line_end_node(&line[part->number[k]], end);
            const double *z = chain->segment.z[end == CPS_END_A ? node + 1 : node],
                         by = end == CPS_END_A ? -scale.force : scale.force;
            double *pull = &out->pull[6 * k + 3 * end];
            cpsi_frame_from(pull, axes, &z[1]);
            for (int a = 0; a < 3; a++) pull[a] *= by;
        }
    return report.outcome == CPSI_IPM_SOLVED ||
           (part->is_refined && report.gap + fmax(report.imbalance, report.residual) <= ENOUGH);
}

/* Move the tangent planes of a line to where its part of the solution leads. */
static void follow(CpsiLine *line, const CpsiJoined *joined, const CpsiStepOptions *options,
                   double *turned) {
    double own;
    if (!line->has_local_axes) return;
    cpsi_step_program_unpack(line, joined->program, &joined->scale);
    (void)cpsi_rounds_refresh_axes(line, !options->frictionless, &own);
    *turned = fmax(*turned, own);
}

/* Is a line inextensible? */
static bool has_inextensible(const CpsiLine *line, const CpsiNetworkPart *part) {
    for (int k = 0; k < part->lines; k++)
        if (line[part->number[k]].compliance == 0) return true;
    return false;
}

/* [N] The largest force that the program has found at an end of a line. */
static double largest_pull(const CpsiNetworkPart *part, const CpsiNetworkMove *move) {
    double most = 0;
    for (int k = 0; k < 2 * part->lines; k++)
        most = fmax(most, vec3_norm(vec3_load(&move->pull[3 * k])));
    return most;
}

/* Solve the program as that of a line alone is solved. Of thousands of elastic lines rounding may
 * end the loop before its target: it is solved again in units of the largest force found, and if
 * that is not enough it has to come less near. */
static bool solve_to_the_end(CpsiNetwork *network, CpsiLine *line, const CpsiNetworkPart *part,
                             const CpsiStepOptions *options, const CpsiNetworkMove *out) {
    CpsiIpmOptions ipm = {.target = CPSI_TARGET,
                          .max_iterations = ITERATIONS,
                          .centering_steps = CPSI_CENTERING_STEPS,
                          .sharpenings = CPSI_REFINEMENT_STEPS};
    const bool inextensible = has_inextensible(line, part);
    bool solved = solve(network, line, part, options, ipm, 1, out);
    double unit = 1;
    if (network->found == CPSI_IPM_STALLED && part->bodies == 0 && !inextensible) {
        const double found = largest_pull(part, out) / network->unit_force;
        if (found < SMALLER) unit = fmax(found, SMALLEST);
        if (unit < 1) solved = solve(network, line, part, options, ipm, unit, out);
    }
    while (network->found == CPSI_IPM_STALLED && ipm.target < ENOUGH &&
           (part->bodies > 0 || !inextensible)) {
        ipm.target *= 10;
        solved = solve(network, line, part, options, ipm, unit, out);
    }
    return solved;
}

bool cpsi_network_guess(CpsiNetwork *network, CpsiLine *line, const CpsiNetworkPart *part,
                        const CpsiStepOptions *options, const CpsiNetworkMove *out) {
    const CpsiIpmOptions ipm = {.target = part->target,
                                .max_iterations = ITERATIONS,
                                .centering_steps = part->is_refined ? CPSI_CENTERING_STEPS : 0,
                                .sharpenings = part->is_refined ? CPSI_REFINEMENT_STEPS : 0};
    bool solved = part->is_exact ? solve_to_the_end(network, line, part, options, out)
                                 : solve(network, line, part, options, ipm, 1, out);
    if (!part->is_exact && part->bodies == 0)
        for (double unit = SMALLER;
             !solved && network->found == CPSI_IPM_STALLED && unit >= SMALLEST; unit *= SMALLER)
            solved = solve(network, line, part, options, ipm, unit, out);
    network->turned = 0;
    if (!solved) return false;
    for (int k = 0; k < part->lines; k++)
        follow(&line[part->number[k]], &network->joined[k], options, &network->turned);
    return true;
}

bool cpsi_network_solve(CpsiNetwork *network, CpsiLine *line, const CpsiNetworkPart *part,
                        const CpsiStepOptions *options, const CpsiNetworkMove *out) {
    return solve_to_the_end(network, line, part, options, out);
}
