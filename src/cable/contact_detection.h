/* SPDX-License-Identifier: BSD-3-Clause */
/* Which obstacles the nodes and elements of a line have contact with. */
#ifndef CAPSTAN_SRC_CABLE_CONTACT_DETECTION_H
#define CAPSTAN_SRC_CABLE_CONTACT_DETECTION_H

#include "cable/line.h"

/* Detect the contacts at `base` (lines with local axes): the nearest obstacles. A contact with the
 * same obstacle as before keeps its data, as the first or the second of its node. `keep_active`: an
 * active contact stays with its obstacle even if others are as near. */
void cpsi_contact_detect(CpsiLine *line, bool keep_active);

/* Does contact c enter the program where its node is `gap` away from the obstacle? A second contact
 * does so only within the range of its tangent plane, for the plane of a round obstacle far away
 * would exclude free space. A contact that keeps its obstacle always does. */
bool cpsi_contact_is_watched(const CpsiLine *line, int c, double gap);

/* Normal of obstacle k at the reference of contact c; 0 0 0 without an obstacle. */
Vec3 cpsi_contact_reference_normal(const CpsiLine *line, int k, int c);

/* The point of element e, at positions x, that is nearest to obstacle k: its share of the element,
 * and its distance from the surface plus the allowance. False where that point is a node. */
bool cpsi_contact_clearance(const CpsiLine *line, const double *x, int e, int k, double *share,
                            double *gap);

#endif
