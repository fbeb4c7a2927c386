/* SPDX-License-Identifier: BSD-3-Clause */
/* Workspaces (workspace.h). */
#include "evolve/workspace.h"

#include <stdlib.h>

#include "base/status.h"

void cpsi_friction_sets_free(CpsiFrictionSets *sets) {
    if (sets->set)
        for (int k = 0; k < sets->count; k++) cpsi_friction_set_free(sets->set[k]);
    free(sets->set);
    *sets = (CpsiFrictionSets){0};
}

static void enlarge(CpsiConicSet *largest, const CpsiConicSet *form) {
    if (form->unknowns > largest->unknowns) largest->unknowns = form->unknowns;
    if (form->rows > largest->rows) largest->rows = form->rows;
    if (form->cones > largest->cones) largest->cones = form->cones;
    if (form->spread > largest->spread) largest->spread = form->spread;
}

CpsStatus cpsi_friction_sets_make(const CpsScene *scene, CpsiFrictionSets *out,
                                  CpsiConicSet *largest, CpsError *err) {
    *out = (CpsiFrictionSets){.count = scene->obstacle_count};
    *largest = (CpsiConicSet){0};
    bool any = false;
    for (int k = 0; k < scene->obstacle_count; k++) any = any || scene->obstacle[k].friction_set;
    if (!any) return CPS_OK;
    out->set = calloc((size_t)scene->obstacle_count, sizeof *out->set);
    if (!out->set) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for friction sets");
    for (int k = 0; k < scene->obstacle_count; k++) {
        const CpsObstacle *obstacle = &scene->obstacle[k];
        if (!obstacle->friction_set) continue;
        const CpsStatus status =
            cpsi_friction_set_make(obstacle->friction_set, obstacle->name, &out->set[k], err);
        if (status) {
            cpsi_friction_sets_free(out);
            return status;
        }
        if (out->set[k]) enlarge(largest, cpsi_friction_set_conic(out->set[k]));
    }
    return CPS_OK;
}

void cpsi_workspace_layout(CpsiWorkspace *workspace, CpsiArena *arena,
                           const CpsiWorkspaceSize *size) {
    const int contacts = size->contacts + size->element_contacts;
    CPSI_PLACE(arena, workspace->scratch.obstacle, size->obstacles + 1);
    cpsi_substeps_layout(&workspace->scratch, arena, size->nodes, contacts, size->has_local_axes,
                         size->has_path_tolerance);
    if (size->inextensible_nodes > 0)
        cpsi_force_set_layout(&workspace->forces, arena, size->inextensible_nodes, contacts);
    cpsi_chain_program_layout(&workspace->program, arena, size->nodes,
                              size->has_local_axes ? size->contacts : 0, size->element_contacts > 0,
                              size->springs, size->largest, size->ops);
    if (size->has_soft)
        cpsi_chain_program_layout_compliance(&workspace->program, arena, size->nodes,
                                             size->has_local_axes ? size->contacts : 0,
                                             size->element_contacts > 0);
    cpsi_least_motion_layout(&workspace->least, arena, size->nodes, size->contacts,
                             &workspace->program);
}

void cpsi_workspace_connect(CpsiWorkspace *workspace) {
    workspace->program.base.interrupt = &workspace->interrupt;
    workspace->forces.program.base.interrupt = &workspace->interrupt;
    workspace->least.program.chain.base.interrupt = &workspace->interrupt;
}

void cpsi_workspace_attach(CpsiWorkspace *workspace, CpsiLine *line) {
    line->friction_set = (const CpsiFrictionSet *const *)workspace->friction_sets.set;
    if (line->compliance == 0) line->forces = &workspace->forces;
}
