/* SPDX-License-Identifier: BSD-3-Clause */
/* A program over a chain of nodes in space, three unknowns each: the line of cable/.
 *
 *     min   sum_i l_i d_i^2/(2 c)  +  sum_k w_k A_k t_k  -  sum_j b_j.u_j
 *
 *     s.t.  segment, one per element i = 1..n-1
 *               (1 + d_i, e_i) in Q4,  e_i = e_i^0 + (u_i - u_{i-1})/l_i
 *               where stiffness grows with d_i, springs add theirs (springs.c)
 *           friction disc, at node k: forces in a disc of radius A_k, mapped by B_k^T
 *               (t_k, o_k + B_k u_xy) in Q3
 *           friction conic, at node k: forces in any planar set, energy per bound A_k
 *               A_k's_k = P_k'(o_k + u_xy), s_k in K_k,  phi = s_k.b_k - <o_k + u_xy, origin_k>
 *           unilateral contact, at node k: a half-line
 *               g_k + n_k.u >= 0;  where the obstacle gives, energy w_k min(0, g_k + n_k.u)^2/(2
 * c_k) constraint, at an end node: rows in half-lines, second-order cones, or 0 (constraint.c) A_k
 * u + b_k in K_k u_j = given at held nodes
 *
 * Where the nodes have axes of their own (`frame`), u_j and the loads are in them: x, y tangent to
 * the obstacle there, z its normal; e_i is in the common axes. A node may have two unilateral
 * contacts, each with its friction discs or its friction conic. The normal of the first contact is
 * z, and its friction acts on u_xy. The axes of the `second` contact are general; for its friction,
 * u_xy above means the components of u along its own tangents. On a curved obstacle the normal
 * turns as the node moves: R turns by u_xy over the radius, which `curvature` holds.
 *
 * A line whose nodes have axes of their own may have points on its elements (chain_system.h): the
 * point of element i is node n + i to its contact and friction, and its position follows from those
 * of nodes i - 1 and i. Its normal is z, and its surface has no curvature here.
 *
 * All quantities are dimensionless and of order one. The duals are (T, -p) of a segment, (A, F) of
 * a friction disc and R of a unilateral contact, each per unit weight, where the weight of an
 * element is its share of the line (l_i, w_k). With weights the complementarity s.z is a density,
 * and the same target serves a fine and a coarse element. The elements' own unknowns (d_i, t_k) are
 * eliminated cone by cone; each segment keeps its tension in the linear system.
 *
 * Iterate: s primal, z dual, both interior. s of a friction disc is exact by construction; s of a
 * segment or a unilateral contact may differ from its value at u by the residual rho, which a full
 * step removes. */
#ifndef CAPSTAN_SRC_CHAIN_CHAIN_PROGRAM_H
#define CAPSTAN_SRC_CHAIN_CHAIN_PROGRAM_H

#include "chain/elements.h"

/* Place the arrays of segments, unilateral contacts and friction discs, at most `stops` and `discs`
 * of them, and the linear system of a program whose kinds are set; with second directions and
 * points, or without. The factor comes last. */
void cpsi_chain_layout(CpsiChainProgram *program, CpsiArena *arena, int n, int stops, int discs,
                       bool second, bool points, const CpsiLinsysOps *ops);

/* Place a program for at most n nodes in the arena; `contacts`: 0, or nodes may have axes of their
 * own and 1 or 2 unilateral contacts, with two friction discs each; `points`: elements may also
 * have a point, with one such contact; `springs`: at most so many beside segments; `largest`: the
 * sizes that no friction conic exceeds, or NULL where there is none. */
void cpsi_chain_program_layout(CpsiChainProgram *program, CpsiArena *arena, int n, int contacts,
                               bool points, int springs, const CpsiConicSet *largest,
                               const CpsiLinsysOps *ops);

/* After it: place the compliances of contacts, which without them do not give. */
void cpsi_chain_program_layout_compliance(CpsiChainProgram *program, CpsiArena *arena, int n,
                                          int contacts, bool points);

/* Use n of the nodes it was laid out for, with axes of their own or without. */
void cpsi_chain_program_resize(CpsiChainProgram *program, int n, bool own_axes);

/* Use the points of node_frames.share until the next resize. Their positions and axes stand behind
 * those of the nodes; no loads act on them. */
void cpsi_chain_program_use_points(CpsiChainProgram *program);
/* Set the entry of u (2 n, 3) that belongs to the point of element i from those of its nodes, in
 * its own axes. */
void cpsi_chain_point_place(const CpsiChainProgram *program, int i, double *u);

/* One step of Newton's method from fixed to coupled bounds. At a solution with given bounds
 * disc.z[.][0] = A, and with disc.unilateral set: how the reactions change when every A moves to
 * friction R and all other pairs keep their s o z. The change is written to unilateral.dz; s, z and
 * u are not changed. False: the matrix is singular. */
bool cpsi_chain_program_couple_bounds(CpsiChainProgram *program);

#endif
