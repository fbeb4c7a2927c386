/* SPDX-License-Identifier: BSD-3-Clause */
/* The views of the lines of an evolution (view.h). */
#include "evolve/view.h"
#include "cable/damping.h"
#include "cable/end_set.h"
#include "cable/flow.h"
#include "cable/winch.h"

#include "capstan/two_stiffnesses.h"

void cpsi_view_layout(CpsiViewFill *fill, CpsiArena *arena, int n) {
    CPSI_PLACE(arena, fill->zero, 3 * n);
    CPSI_PLACE(arena, fill->one, n);
    CPSI_PLACE(arena, fill->first, n);
    CPSI_PLACE(arena, fill->none, n);
    CPSI_PLACE(arena, fill->state, n);
}

void cpsi_view_fill(CpsiViewFill *fill, int n) {
    for (int j = 0; j < n; j++) {
        fill->one[j] = 1;
        fill->none[j] = -1;
        fill->state[j] = CPS_NODE_STATE_FREE;
    }
}

void cpsi_view_update(CpsiLine *line) {
    if (line->has_local_axes) return;
    for (int j = 0; j < line->n; j++) {
        const bool slides = vec3_norm(vec3_at(line->normal, j)) > 0;
        vec3_store(&line->slip[3 * j], slides ? cpsi_line_slip(line, j) : vec3(0, 0, 0));
    }
}

/* The contacts of elements, which follow those of the nodes in a line's arrays. */
static void view_elements(const CpsiLine *from, const CpsiViewFill *fill, CpsLineView *view) {
    const size_t first = (size_t)cpsi_line_contacts(from);
    view->has_element_contacts = from->element_contacts > 0;
    if (view->has_element_contacts) {
        view->element_obstacle = from->obstacle_index + first;
        view->element_share = from->beta;
        view->element_normal = from->normal + 3 * first;
        view->element_gap = from->gap + first;
        view->element_friction_bound = from->friction_bound + first;
        view->element_friction_force = from->friction_force + 3 * first;
        view->element_reaction = from->reaction + first;
        view->element_slip = from->slip + 3 * first;
        view->element_state = from->state + first;
    } else {
        view->element_obstacle = fill->none;
        view->element_share = view->element_normal = view->element_gap = fill->zero;
        view->element_friction_bound = view->element_friction_force = fill->zero;
        view->element_reaction = view->element_slip = fill->zero;
        view->element_state = fill->state;
    }
}

CpsLineView cps_evolution_line_view(const CpsEvolution *evolution, int line) {
    if (!evolution || line < 0 || line >= evolution->line_count) return (CpsLineView){.name = ""};
    const CpsiLine *from = &evolution->line[line];
    const CpsiViewFill *fill = &evolution->fill;
    const int *const only = from->obstacle_count > 0 ? fill->first : fill->none;
    CpsLineView view = {
        .name = from->name,
        .element_count = from->n - 1,
        .contact_count = from->contacts,
        .one_plane = !from->has_local_axes && from->grasp_count == 0 && !cpsi_line_has_sets(from) &&
                     !cpsi_line_has_winch(from) && !from->has_field && !from->has_node_loads,
        .arc_length = cpsi_line_has_winch(from) ? from->drums.place : from->arc_length,
        .element_length = cpsi_line_has_damping(from) ? from->natural_length : from->element_length,
        .compliance = from->compliance,
        .compliance_factor = !from->has_sections           ? fill->one
                             : cpsi_line_has_damping(from) ? from->inertia.damping.own_factor
                                                           : from->compliance_factor,
        .uniform = !from->has_sections,
        .weight_length = from->has_sections ? from->weight_length : fill->zero,
        .spring_count = from->spring_count,
        .spring_element = from->spring_element,
        .spring_strain = from->spring_start,
        .spring_stiffness = from->spring_stiffness,
        .has_breaking_load = from->has_breaking_load,
        .breaking_load = from->has_breaking_load ? from->breaking_load : fill->zero,
        .end = {from->end[0], from->end[1]},
        .grasp_count = from->grasp_count,
        .grasp = from->grasp,
        .reference = from->reference,
        .position = from->position,
        .load = from->load,
        .weight_before = {from->weight_before[0], from->weight_before[1], from->weight_before[2]},
        .normal = from->normal,
        .gap = from->gap,
        .friction_bound = from->friction_bound,
        .friction_factor = from->has_zones ? from->friction_factor : fill->one,
        .friction_force = from->friction_force,
        .reaction = from->reaction,
        .slip = from->slip,
        .segment_force = from->segment_force,
        .tension = from->tension,
        .motion = from->motion,
        .state = from->state,
        .obstacle = from->has_local_axes ? from->obstacle_index : only,
        .origin = {evolution->origin[0], evolution->origin[1], evolution->origin[2]},
    };
    view.has_springs = from->field.diagonal && !from->has_inertia;
    view.node_stiffness = view.has_springs ? from->field.diagonal : fill->zero;
    view.node_coupling = view.has_springs ? from->field.coupling : fill->zero;
    view.node_place = view.has_springs ? from->field.own_place : fill->zero;
    view.node_beside = view.has_springs ? from->field.beside : fill->zero;
    view.has_node_loads = from->has_node_loads;
    view.node_load = view.has_node_loads ? from->field.all : fill->zero;
    view_elements(from, fill, &view);
    return view;
}

static CpsElasticity elasticity(const CpsiElasticity *own) {
    return (CpsElasticity){own->compliance_factor, own->spring_count, own->spring_element,
                           own->spring_start, own->spring_stiffness};
}

CpsTwoStiffnesses cps_evolution_two_stiffnesses(const CpsEvolution *evolution, int line) {
    if (!evolution || line < 0 || line >= evolution->line_count ||
        !evolution->line[line].two.exists)
        return (CpsTwoStiffnesses){.exists = false};
    const CpsiLine *from = &evolution->line[line];
    return (CpsTwoStiffnesses){.exists = true,
                               .is_dynamic = from->two.is_dynamic,
                               .element_length = from->natural_length,
                               .rest_strain = from->two.rest_strain,
                               .at_static = elasticity(&from->two.elasticity[CPSI_STATIC]),
                               .at_dynamic = elasticity(&from->two.elasticity[CPSI_DYNAMIC])};
}

CpsPotentialView cps_evolution_potential(const CpsEvolution *evolution, int line) {
    CpsPotentialView out = {.is_there = false};
    if (!evolution || line < 0 || line >= evolution->line_count ||
        !evolution->line[line].has_potential)
        return out;
    const CpsiLine *from = &evolution->line[line];
    out = (CpsPotentialView){.is_there = true,
                             .node_count = from->n,
                             .energy = from->field.energy,
                             .force = from->field.pull};
    for (int j = 0; j < from->n; j++) out.total += from->field.energy[j];
    return out;
}

void cps_evolution_water(const CpsEvolution *evolution, int line, double *velocity,
                         double *acceleration) {
    if (!evolution || !velocity || !acceleration || line < 0 || line >= evolution->line_count)
        return;
    const CpsiLine *from = &evolution->line[line];
    const bool swims = from->field.flow && from->has_inertia && from->inertia.is_moving;
    for (int e = 0; e + 1 < from->n; e++) {
        const Vec3 middle =
            vec3_scale(0.5, vec3_add(vec3_at(from->position, e), vec3_at(from->position, e + 1)));
        CpsiWaterMotion water = {.velocity = {0, 0, 0}};
        if (swims) water = cpsi_flow_motion(from->field.flow, middle);
        vec3_store(&velocity[3 * e], water.velocity);
        vec3_store(&acceleration[3 * e], water.acceleration);
    }
}
