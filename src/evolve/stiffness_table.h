/* SPDX-License-Identifier: BSD-3-Clause */
/* Tables of strain and tension in place of one stiffness. */
#ifndef CAPSTAN_SRC_EVOLVE_STIFFNESS_TABLE_H
#define CAPSTAN_SRC_EVOLVE_STIFFNESS_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "capstan/scene.h"

/* What is wrong with a table, or NULL: written to `found` (size). */
const char *cpsi_stiffness_table_fault(const CpsStiffnessRow *row, int count, char *found,
                                       size_t size);

/* [-] The strain at a tension by a table, or by a stiffness where it has no rows. */
double cpsi_stiffness_strain(double stiffness, const CpsStiffnessRow *row, int count,
                             double tension);

/* Is the other stiffness softer than this one: has it the larger strain at a tension? Then at which
 * `at` [N], and both strains there. */
bool cpsi_stiffness_is_softer(double stiffness, const CpsStiffnessRow *row, int count,
                              const CpsDynamicStiffness *other, double *at, double strain[2]);

/* [N] The slope of a table at its first row. */
double cpsi_stiffness_table_first(const CpsStiffnessRow *row);

/* The springs beside the first slope (base/element_law.h): returns their number; `start` [-] and
 * `stiffness` [N] (number) may be NULL. */
int cpsi_stiffness_table_springs(const CpsStiffnessRow *row, int count, double *start,
                                 double *stiffness);

#endif
