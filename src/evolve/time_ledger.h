/* SPDX-License-Identifier: BSD-3-Clause */
/* The ledger of a step in time:
 *
 *     ends + obstacles
 *         = elastic + gravity + dissipated + kinetic + impact + scheme + imbalance
 *
 * Every force does its work at its value after the step, on the displacement D of the step. With M
 * a the inertia, E the elastic energy and p the forces of the elements,
 *
 *     scheme = sum (M a . D) - increase of the kinetic energy  +  sum (p . D) - increase of E
 *
 * where the second difference is at least 0 because E is convex. A node that begins to bear loses
 * the energy that it had, when the step began, along the normal of the ground, m (v_n . n)^2/2:
 * that is `impact`; one on an obstacle that gives does not, whose spring and damping are among E
 * and what is damped. What reactions take beyond that, -R n . D and what is lost where nodes that
 * bear are stopped along their normals, belongs to the scheme: it is 0 for what rests or slides on
 * a plane.
 */
#ifndef CAPSTAN_SRC_EVOLVE_TIME_LEDGER_H
#define CAPSTAN_SRC_EVOLVE_TIME_LEDGER_H

#include "cable/line.h"

/* The ledger of the step that the line has taken, before nodes that bear are stopped: in the line's
 * report and in line->inertia. `length` [s] is that of the step, `state` are the contacts' states
 * before it. */
void cpsi_time_ledger(CpsiLine *line, double length, const unsigned char *state);

/* [J] What the scheme has lost at node j in such a step, which bears on nothing rigid: to inertia
 * and to what gives. Below 0 the node has gained it. */
double cpsi_node_loss(const CpsiLine *line, int j, double length);

/* [J] The kinetic energy of the line. */
double cpsi_kinetic_energy(const CpsiLine *line);

/* Close it, when nodes that bear have been stopped, by which the energy `stopped` is lost. */
void cpsi_time_ledger_close(CpsiLine *line, double stopped);

#endif
