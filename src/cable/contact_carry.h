/* SPDX-License-Identifier: BSD-3-Clause */
/* Where an obstacle that moves has taken what friction is measured from (docs/theory.md 6g, 9). */
#ifndef CAPSTAN_SRC_CABLE_CONTACT_CARRY_H
#define CAPSTAN_SRC_CABLE_CONTACT_CARRY_H

#include "cable/line.h"

/* The reference of contact c, carried along by obstacle k as that is shifted in the step, and with
 * `turns` as it turns about its own axis as well. */
Vec3 cpsi_contact_carry(const CpsiLine *line, int k, int c, bool turns);

/* [m] The way in a whole step in time of what obstacle k has at x after it. */
Vec3 cpsi_contact_ground_way(const CpsiLine *line, int k, Vec3 x);

#endif
