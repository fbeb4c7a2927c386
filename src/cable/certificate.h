/* SPDX-License-Identifier: BSD-3-Clause */
/* The certificate of a step: forces that balance, and the gap between the lower bound that they
 * prove and the energy of the configuration found. */
#ifndef CAPSTAN_SRC_CABLE_CERTIFICATE_H
#define CAPSTAN_SRC_CABLE_CERTIFICATE_H

#include "cable/line.h"

/* Make the forces of a step balance at every node that is not held, by summation along the line
 * from a free end; the remaining force on a line free at both ends is distributed among friction
 * and reactions that can change. Changes segment_force, and for two free ends friction_force,
 * reaction and, where friction follows it, friction_bound. */
void cpsi_balance_forces(CpsiLine *line, CpsFrictionPolicy friction);

/* Add to `sum` the forces on node j of the contacts of the elements beside it. */
Vec3 cpsi_add_element_contacts(const CpsiLine *line, int j, Vec3 sum);

/* The certificate of the fields in `line`: theory.md section 4, each local gap computed without
 * cancellation. The gap will be compared with `tolerance` times its scale, whose floor is that of
 * the gap. O(nodes); reads only. */
CpsCertificate cpsi_certificate(const CpsiLine *line, double tolerance);

/* Does the friction law hold to `tolerance` times w L at every node, and in sum to `tolerance`
 * times the energy dissipated by friction? Rounding where nothing slides is allowed for: 1e-14 of
 * the largest force times L, and 1e-12 of the sum of all w L. Used where the friction law is
 * satisfied by rounds. */
bool cpsi_friction_law_is_satisfied(const CpsiLine *line, double tolerance);

#endif
