/* SPDX-License-Identifier: BSD-3-Clause */
/* What a thread needs, beside the line itself, to solve a load step of a line. A line does not
 * depend on the workspace in which it is solved: nothing in it is read before it is written. */
#ifndef CAPSTAN_SRC_EVOLVE_WORKSPACE_H
#define CAPSTAN_SRC_EVOLVE_WORKSPACE_H

#include "cable/force_set.h"
#include "cable/friction_set.h"
#include "cable/least_motion.h"
#include "capstan/scene.h"
#include "evolve/substeps.h"

/* The friction sets of the obstacles, (obstacles), NULL for those without one; `set` is NULL where
 * there is none at all. They have scratch memory of their own, so each workspace has its copy. */
typedef struct CpsiFrictionSets {
    int count; /* obstacles */
    CpsiFrictionSet **set;
} CpsiFrictionSets;

/* Make those of the scene; on failure nothing is left. `largest` has the largest sizes of all. */
CpsStatus cpsi_friction_sets_make(const CpsScene *scene, CpsiFrictionSets *out,
                                  CpsiConicSet *largest, CpsError *err);
void cpsi_friction_sets_free(CpsiFrictionSets *sets);

/* The largest sizes of the lines that are solved in a workspace. */
typedef struct CpsiWorkspaceSize {
    int nodes, inextensible_nodes, springs, obstacles;
    int contacts, element_contacts;                    /* of a node, of an element */
    bool has_local_axes, has_path_tolerance, has_soft; /* soft: an obstacle gives */
    const CpsiConicSet *largest; /* of the friction sets, NULL: there are none */
    const CpsiLinsysOps *ops;
} CpsiWorkspaceSize;

typedef struct CpsiWorkspace {
    CpsiSubsteps scratch;
    CpsiChainProgram program;
    CpsiForceSet forces; /* of inextensible lines */
    CpsiLeastMotion least;
    CpsiInterrupt interrupt; /* of all programs */
    CpsiFrictionSets friction_sets;
} CpsiWorkspace;

void cpsi_workspace_layout(CpsiWorkspace *workspace, CpsiArena *arena,
                           const CpsiWorkspaceSize *size);

/* Once its place is final: let its programs be interrupted. */
void cpsi_workspace_connect(CpsiWorkspace *workspace);

/* Let a line be solved in the workspace. */
void cpsi_workspace_attach(CpsiWorkspace *workspace, CpsiLine *line);

#endif
