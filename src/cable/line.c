/* SPDX-License-Identifier: BSD-3-Clause */
/* A line's arrays, its mesh, and the reaction at its initial shape. */
#include "cable/line.h"

#include "base/larger.h"
#include "chain/frame.h"

static void layout_inertia(CpsiInertia *inertia, CpsiArena *arena, size_t n) {
    CPSI_PLACE(arena, inertia->mass, n);
    CPSI_PLACE(arena, inertia->span, n);
    CPSI_PLACE(arena, inertia->rest_velocity, 3 * n);
    CPSI_PLACE(arena, inertia->start, 3 * n);
    CPSI_PLACE(arena, inertia->start_velocity, 3 * n);
    CPSI_PLACE(arena, inertia->velocity, 3 * n);
    CPSI_PLACE(arena, inertia->before, 3 * n);
    CPSI_PLACE(arena, inertia->before_velocity, 3 * n);
    CPSI_PLACE(arena, inertia->past, 3 * n);
    CPSI_PLACE(arena, inertia->restarts, n);
    CPSI_PLACE(arena, inertia->late, n);
    CPSI_PLACE(arena, inertia->is_euler, n);
    if (!(inertia->damping.coefficient > 0)) return;
    CPSI_PLACE(arena, inertia->damping.elongation, n);
    CPSI_PLACE(arena, inertia->damping.before, n);
    CPSI_PLACE(arena, inertia->damping.rest, n);
    CPSI_PLACE(arena, inertia->damping.own_factor, n);
}

/* The arrays of both stiffnesses of a line of n nodes; spring_count of both is set. */
static void layout_two_stiffnesses(CpsiTwoStiffnesses *two, CpsiArena *arena, int n) {
    CPSI_PLACE(arena, two->rest_strain, n);
    for (int k = 0; k < 2; k++) {
        CpsiElasticity *own = &two->elasticity[k];
        CPSI_PLACE(arena, own->compliance_factor, n);
        CPSI_PLACE(arena, own->spring_at, n);
        CPSI_PLACE(arena, own->spring_element, own->spring_count);
        CPSI_PLACE(arena, own->spring_start, own->spring_count);
        CPSI_PLACE(arena, own->spring_stiffness, own->spring_count);
    }
}

void cpsi_line_layout(CpsiLine *line, CpsiArena *arena) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    CPSI_PLACE(arena, line->turn, line->obstacle_count + 1);
    CPSI_PLACE(arena, line->shift, line->obstacle_count + 1);
    CPSI_PLACE(arena, line->arc_length, n);
    CPSI_PLACE(arena, line->element_length, n);
    line->natural_length = line->element_length;
    const bool damped = line->has_inertia && line->inertia.damping.coefficient > 0;
    if (line->two.exists || damped) CPSI_PLACE(arena, line->natural_length, n);
    if (line->two.exists) {
        layout_two_stiffnesses(&line->two, arena, line->n);
    }
    CPSI_PLACE(arena, line->reference, 3 * n);
    CPSI_PLACE(arena, line->start_element, 3 * (n - 1));
    CPSI_PLACE(arena, line->position, 3 * n);
    CPSI_PLACE(arena, line->load, 3 * n);
    if (line->has_node_loads) {
        CPSI_PLACE(arena, line->field.load, 3 * n);
        CPSI_PLACE(arena, line->field.own_load, 3 * n);
        if (line->field.function) CPSI_PLACE(arena, line->field.base_load, 3 * n);
        CPSI_PLACE(arena, line->field.drag, 3 * n);
        CPSI_PLACE(arena, line->field.all, 3 * n);
        if (line->has_potential) {
            CPSI_PLACE(arena, line->field.share, n);
            CPSI_PLACE(arena, line->field.pull, 3 * n);
            CPSI_PLACE(arena, line->field.energy, n);
        }
        if (line->has_inertia) {
            CPSI_PLACE(arena, line->field.added, 3 * n);
            CPSI_PLACE(arena, line->field.wave, 3 * n);
            CPSI_PLACE(arena, line->field.seen, (n + CPSI_LANES - 1) / CPSI_LANES);
            line->field.see = cpsi_water_loop(cpsi_width_once(&arena->width));
        }
        cpsi_anderson_layout(&line->field.rounds, arena, line->n);
    }
    if (line->has_field) {
        CPSI_PLACE(arena, line->field.stiffness, 6 * n);
        CPSI_PLACE(arena, line->field.place, 3 * n);
        CPSI_PLACE(arena, line->field.beside, 3 * n);
        CPSI_PLACE(arena, line->field.program, 6 * n);
        CPSI_PLACE(arena, line->field.own_stiffness, 6 * n);
        CPSI_PLACE(arena, line->field.own_place, 3 * n);
        CPSI_PLACE(arena, line->field.diagonal, 3 * n);
        CPSI_PLACE(arena, line->field.coupling, 3 * n);
    }
    CPSI_PLACE(arena, line->normal, 3 * contacts);
    CPSI_PLACE(arena, line->gap, contacts);
    if (line->drums.on[CPS_END_A] || line->drums.on[CPS_END_B]) {
        CPSI_PLACE(arena, line->drums.length, n);
        CPSI_PLACE(arena, line->drums.place, n);
        CPSI_PLACE(arena, line->drums.hung, n);
    }
    if (line->has_zones) CPSI_PLACE(arena, line->friction_factor, n);
    if (line->has_sections) {
        CPSI_PLACE(arena, line->weight_factor, n);
        CPSI_PLACE(arena, line->weight_length, n);
    }
    if (line->has_sections || damped) CPSI_PLACE(arena, line->compliance_factor, n);
    const int springs = cpsi_line_most_springs(line);
    if (springs > 0) {
        CPSI_PLACE(arena, line->spring_at, n);
        CPSI_PLACE(arena, line->spring_element, springs);
        CPSI_PLACE(arena, line->spring_start, springs);
        CPSI_PLACE(arena, line->spring_stiffness, springs);
    }
    if (line->has_breaking_load) CPSI_PLACE(arena, line->breaking_load, n);
    if (line->has_break_at) CPSI_PLACE(arena, line->break_at, n);
    if (line->has_inertia) layout_inertia(&line->inertia, arena, n);
    CPSI_PLACE(arena, line->friction_law, contacts);
    CPSI_PLACE(arena, line->friction_bound, contacts);
    CPSI_PLACE(arena, line->friction_force, 3 * contacts);
    CPSI_PLACE(arena, line->reaction, contacts);
    CPSI_PLACE(arena, line->segment_force, 3 * n);
    CPSI_PLACE(arena, line->tension, n);
    CPSI_PLACE(arena, line->motion, 3 * n);
    CPSI_PLACE(arena, line->state, contacts);
    CPSI_PLACE(arena, line->active, contacts);
    CPSI_PLACE(arena, line->at_bound, contacts);
    CPSI_PLACE(arena, line->slip, 3 * contacts);
    if (line->has_local_axes) {
        CPSI_PLACE(arena, line->winding, contacts);
        CPSI_PLACE(arena, line->base, 3 * n);
        CPSI_PLACE(arena, line->axes, 9 * contacts);
        CPSI_PLACE(arena, line->reference_axes, 9 * contacts);
        CPSI_PLACE(arena, line->curvature, 3 * contacts);
        CPSI_PLACE(arena, line->obstacle_index, contacts);
        if (line->has_folds) CPSI_PLACE(arena, line->face, contacts);
        CPSI_PLACE(arena, line->node_reaction, n);
        CPSI_PLACE(arena, line->watched, 6 * n);
        cpsi_anderson_layout(&line->anderson, arena, line->n);
    }
    if (line->element_contacts > 0) CPSI_PLACE(arena, line->beta, n);
    if (line->compliance > 0) return;
    CPSI_PLACE(arena, line->tension_before, n);
    CPSI_PLACE(arena, line->reaction_before, contacts);
    if (line->has_local_axes) CPSI_PLACE(arena, line->obstacle_index_before, contacts);
}

int cpsi_line_most_springs(const CpsiLine *line) {
    const int other = line->two.exists ? line->two.elasticity[CPSI_DYNAMIC].spring_count : 0;
    return line->spring_count > other ? line->spring_count : other;
}

CpsiElementLaw cpsi_line_spring_law(const CpsiLine *line, int e) {
    CpsiElementLaw law = {.compliance = cpsi_line_compliance(line, e)};
    const int first = line->spring_at[e];
    law.count = line->spring_at[e + 1] - first;
    law.start = &line->spring_start[first];
    law.stiffness = &line->spring_stiffness[first];
    law.longer = line->compliance / line->spring_compliance;
    law.stiffer = 1 / law.longer;
    return law;
}

double cpsi_line_least_compliance(const CpsiLine *line) {
    double least = INFINITY;
    for (int e = 0; e + 1 < line->n; e++) {
        const CpsiElementLaw law = cpsi_line_law(line, e);
        double own = cpsi_law_least_compliance(&law);
        if (line->natural_length != line->element_length)
            own *= line->element_length[e] / line->natural_length[e];
        least = fmin(least, own);
    }
    return least;
}

double cpsi_line_largest_displacement(const CpsiLine *line, const double *from) {
    double longest = 0;
    for (int j = 0; j < line->n; j++)
        longest = cpsi_max_nan(longest,
                               vec3_norm(vec3_sub(vec3_at(line->position, j), vec3_at(from, j))));
    return longest;
}

static int nearest_of(const CpsiLine *line, Vec3 x, bool rigid, double *gap) {
    int nearest = CPS_NO_OBSTACLE;
    *gap = INFINITY;
    for (int k = 0; k < line->obstacle_count; k++) {
        if (rigid && line->obstacle[k].stiffness > 0) continue;
        const double distance = cpsi_obstacle_gap(&line->obstacle[k], x);
        if (!(distance < *gap)) continue;
        *gap = distance;
        nearest = k;
    }
    return nearest;
}

int cpsi_line_nearest(const CpsiLine *line, Vec3 x, double *gap) {
    return nearest_of(line, x, false, gap);
}

int cpsi_line_nearest_rigid(const CpsiLine *line, Vec3 x, double *gap) {
    return nearest_of(line, x, true, gap);
}

double cpsi_line_pierces(const CpsiLine *line, int *obstacle) {
    double worst = 0;
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiObstacle *o = &line->obstacle[k];
        if (!cpsi_obstacle_is_round(o) && !cpsi_obstacle_is_rounded(o)) continue;
        for (int e = 0; e + 1 < line->n; e++) {
            const Vec3 a = vec3_at(line->position, e), b = vec3_at(line->position, e + 1);
            double share;
            if (!cpsi_obstacle_faces(o, a, b, &share)) continue;
            const Vec3 nearest = vec3_axpy(share, vec3_sub(b, a), a);
            const double depth = -cpsi_obstacle_gap(o, nearest) -
                                 cpsi_obstacle_allowance(o, line->natural_length[e]);
            if (!(depth > worst)) continue;
            worst = depth;
            *obstacle = k;
        }
    }
    return worst;
}

bool cpsi_line_grasp_holds(const CpsiLine *line, int j) {
    for (int k = 0; k < line->grasp_count; k++)
        if (line->grasp[k].node == j) return line->grasp[k].imposed.kind == CPS_END_KIND_HELD;
    return false;
}

void cpsi_line_set_arc_length(CpsiLine *line) {
    /* compensated summation: the last abscissa is the length to rounding, for any number of
     * elements */
    double sum = 0, carry = 0;
    line->arc_length[0] = 0;
    for (int e = 0; e + 1 < line->n; e++) {
        const double next = line->element_length[e] - carry, total = sum + next;
        carry = (total - sum) - next;
        sum = line->arc_length[e + 1] = total;
    }
}

/* The force T(|x'| - 1) t of element e at `position`; 0 for an inextensible line, whose tension
 * its shape does not determine. */
static Vec3 start_force(const CpsiLine *line, int e) {
    const Vec3 dx = vec3_sub(vec3_at(line->position, e + 1), vec3_at(line->position, e));
    const double size = vec3_norm(dx), strain = size / line->element_length[e] - 1;
    if (!(line->compliance > 0) || !(strain > 0)) return vec3(0, 0, 0);
    const CpsiElementLaw law = cpsi_line_law(line, e);
    if (law.count > 0) return vec3_scale(cpsi_law_tension(&law, strain) / size, dx);
    return vec3_scale(strain / (law.compliance * size), dx);
}

void cpsi_line_start_reaction(CpsiLine *line, double touch) {
    for (int j = 0; j < line->n; j++) {
        line->reaction[j] = 0;
        line->state[j] = CPS_NODE_STATE_FREE;
        const Vec3 x = vec3_at(line->position, j);
        double gap;
        const int on = cpsi_line_nearest(line, x, &gap);
        if (!(gap <= touch)) continue;
        if (line->obstacle[on].stiffness > 0) {
            line->reaction[j] = line->obstacle[on].stiffness * line->bearing_width *
                                cpsi_line_share(line, j) * fmax(0, -gap);
            line->state[j] = CPS_NODE_STATE_STICK;
            if (line->has_local_axes) line->obstacle_index[j] = on;
            continue;
        }
        Vec3 sum = vec3_scale(cpsi_line_weight_length(line, j), vec3_load(line->weight));
        sum = vec3_add(sum, cpsi_node_field_at(&line->field, j, x));
        if (j > 0) sum = vec3_sub(sum, start_force(line, j - 1));
        if (j + 1 < line->n) sum = vec3_add(sum, start_force(line, j));
        const double reaction = -vec3_dot(sum, cpsi_obstacle_normal(&line->obstacle[on], x));
        line->reaction[j] = reaction > 0 ? reaction : 0;
        line->state[j] = CPS_NODE_STATE_STICK;
        if (line->has_local_axes) line->obstacle_index[j] = on;
    }
}

Vec3 cpsi_line_start_pull(const CpsiLine *line, int end) {
    const int j = cpsi_line_end_node(line, end);
    const Vec3 own = vec3_scale(cpsi_line_weight_length(line, j), vec3_load(line->weight));
    const Vec3 weight =
        vec3_add(own, cpsi_node_field_at(&line->field, j, vec3_at(line->position, j)));
    return end == CPS_END_A ? vec3_add(weight, start_force(line, j))
                            : vec3_sub(weight, start_force(line, j - 1));
}

/* The factor of the friction zones at contact c: that of its node, or between those of its
 * element's nodes. */
static double zone_factor(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    if (!line->friction_factor) return 1;
    if (e < 0) return line->friction_factor[cpsi_line_node(line, c)];
    return (1 - line->beta[e]) * line->friction_factor[e] +
           line->beta[e] * line->friction_factor[e + 1];
}

CpsiFrictionLaw cpsi_line_friction_law(const CpsiLine *line, int c) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    const CpsiFrictionSet *given =
        obstacle && obstacle->has_set ? line->friction_set[obstacle - line->obstacle] : NULL;
    if (!obstacle || (obstacle->has_set && !given)) return (CpsiFrictionLaw){.ratio = {1, 1}};
    double factor = zone_factor(line, c);
    if (obstacle->ground)
        factor *= cpsi_obstacle_friction_factor(obstacle, cpsi_line_place(line, line->base, c));
    if (obstacle->has_set)
        return (CpsiFrictionLaw){.friction = factor, .ratio = {1, 1}, .given = given};
    const double *mu = obstacle->friction, friction = fmax(mu[0], mu[1]),
                 by = friction > 0 ? 1 / friction : 0;
    return (
        CpsiFrictionLaw){.friction = factor * friction,
                         .ratio = {friction > 0 ? mu[0] * by : 1, friction > 0 ? mu[1] * by : 1},
                         .box = obstacle->shape == CPS_FRICTION_SHAPE_BOX};
}

void cpsi_line_local_slip(const CpsiLine *line, int c, double slip[3]) {
    double global[3];
    vec3_store(global, cpsi_line_slip(line, c));
    cpsi_frame_to(slip, cpsi_line_axes(line, c), global);
}

void cpsi_line_lay_out_friction(CpsiLine *line) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++)
        line->friction_law[c] = cpsi_line_friction_law(line, c);
}
