/* SPDX-License-Identifier: BSD-3-Clause */
/* Patches divided into cells: contacts that dissipate less, or more, than the patch for every
 * twist. */
#ifndef CAPSTAN_SRC_PLANAR_CELLS_H
#define CAPSTAN_SRC_PLANAR_CELLS_H

#include "planar/planar.h"

/* Called with a contact of friction force `strength` at r from the patch's position, in body axes.
 * Returning false ends the loop. */
typedef bool CpsiCell(void *user, double strength, const double r[2]);

/* Number of cells of an area at fineness n >= 1, where they are about the patch's size/n wide. */
double cpsi_cell_count(const CpsiPatch *patch, int n);

/* The largest fineness with at most `cells` cells, or 0. */
int cpsi_cell_fineness(const CpsiPatch *patch, double cells);

/* Largest number of contacts that `cpsi_cells` visits on that side. */
double cpsi_cell_contacts(const CpsiPatch *patch, CpsPlanarSide side, int n);

/* Visit the contacts of an area. For every convex function g of r, with q = friction x pressure,
 *     inner: sum of strength g(r) <= integral of q g <= outer: sum of strength g(r). */
bool cpsi_cells(const CpsiPatch *patch, CpsPlanarSide side, int n, CpsiCell *visit, void *user);

#endif
