/* SPDX-License-Identifier: BSD-3-Clause */
/* The proof of a step: forces that balance, and the gap between what they prove and the
 * configuration found. */
#ifndef CAPSTAN_SRC_CABLE_CERTIFICATE_H
#define CAPSTAN_SRC_CABLE_CERTIFICATE_H

#include "cable/line.h"

/* Make the forces of a step balance at every node that is not held, by summation along the line
 * from a free end; what a line free at both ends has left over is shared out among friction and
 * reactions that have room for it. Changes segment_force, and for two free ends friction_force and
 * reaction. */
void cpsi_balance_forces(CpsiLine *line);

/* Add to `sum` what the contacts of the elements beside node j do on it. */
Vec3 cpsi_add_element_contacts(const CpsiLine *line, int j, Vec3 sum);

/* The certificate of the fields in `line`: theory.md section 4, each local gap computed without
 * cancellation. The gap will be compared with `tolerance` times its scale, whose floor is that of
 * the gap. O(nodes); reads only. */
CpsCertificate cpsi_certificate(const CpsiLine *line, double tolerance);

/* Does friction's law hold to `tolerance` of w L at every node, and of what friction dissipates in
 * sum?  Less what rounding leaves where nothing slides: 1e-14 of the largest force times L, and
 * 1e-12 of all w L. Asked where rounds settle it. */
bool cpsi_law_refcount(const CpsiLine *line, double tolerance);

#endif
