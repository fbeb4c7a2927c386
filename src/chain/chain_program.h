/* SPDX-License-Identifier: BSD-3-Clause */
/* A program over a chain of nodes in space, three unknowns each: the line of cable/.
 *
 *     min   sum_i l_i d_i^2/(2 c)  +  sum_k w_k A_k t_k  -  sum_j b_j.u_j
 *
 *     s.t.  stretch, one per element i = 1..n-1
 *               (1 + d_i, e_i) in Q4,  e_i = e_i^0 + (u_i - u_{i-1})/l_i
 *           rub, at node k: a disc of forces of radius A_k, mapped by B_k^T
 *               (t_k, o_k + B_k u_xy) in Q3
 *           shape, at node k: any planar set of forces, energy per bound A_k
 *               A_k's_k = P_k'(o_k + u_xy), s_k in K_k,  phi = s_k.b_k - <o_k + u_xy, origin_k>
 *           stop, at node k: a half-line
 *               g_k + n_k.u >= 0
 *           u_j = given at held nodes
 *
 * Where the nodes have axes of their own (`frame`), u_j and the loads are in them: x, y tangent to
 * the obstacle there, z its normal; e_i is in the common axes. A node may have two stops, each with
 * its rubs or its shape. The first one's normal is z and its rubs act on u_xy; those of the
 * `second` lie as they come, and u_xy above means what u does in their own tangents. On a curved
 * obstacle the normal follows the node: R turns by u_xy over the radius, the stop's `curvature`.
 *
 * A line whose nodes have axes of their own may have points on its elements (chain_system.h): one
 * that goes with element i is node n + i to its stop, rubs or shape, its place following from those
 * of nodes i - 1 and i. Its normal is z, and its surface has no curvature here.
 *
 * All quantities are dimensionless and of order one; the program knows no mechanics, but its names
 * are those of a line: stretch duals are (T, -p), rub duals (A, F), stop duals R, each per unit
 * weight, where the weight of an element is its share of the line (l_i, w_k). With weights the
 * complementarity s.z is a density, and the same target serves a fine and a coarse element. Private
 * unknowns (d_i, t_k) are condensed out cone by cone; each stretch keeps its tension in the linear
 * system.
 *
 * Iterate: s primal, z dual, both interior. s of a rub is exact by construction, s of a stretch or
 * stop may differ from what u says by the residual rho, which a full step removes. */
#ifndef CAPSTAN_SRC_CHAIN_CHAIN_PROGRAM_H
#define CAPSTAN_SRC_CHAIN_CHAIN_PROGRAM_H

#include "chain/elements.h"

/* Place a program for at most n nodes in the arena; `contacts`: 0, or nodes may have axes of their
 * own and so many stops, 1 or 2, with two rubs each; `points`: and elements may have a point, with
 * one such stop; `largest`: the sizes that no shape exceeds, or NULL where there are none. */
void cpsi_chain_program_layout(CpsiChainProgram *program, CpsiArena *arena, int n, int contacts,
                               bool points, const CpsiConicSet *largest, const CpsiLinsysOps *ops);

/* Use n of the nodes it was laid out for, with axes of their own or without. */
void cpsi_chain_program_resize(CpsiChainProgram *program, int n, bool own_axes);

/* The points of own.share are in use from here to the next resize: their places and axes beside the
 * nodes', no loads on them. */
void cpsi_chain_program_use_points(CpsiChainProgram *program);
/* Where the nodes have the point of element i: its entry of u (2 n, 3), in its own axes. */
void cpsi_chain_point_place(const CpsiChainProgram *program, int i, double *u);

/* Newton's step from bounds that were given to bounds that follow. At a solution with rub.z[.][0] =
 * A given, and rub.stop set: what the reactions become when every A moves to friction R and all
 * else keeps its s o z. The change goes to stop.dz; s, z, u stay. False: the matrix is singular. */
bool cpsi_chain_program_couple_bounds(CpsiChainProgram *program);

#endif
