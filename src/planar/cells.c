/* SPDX-License-Identifier: BSD-3-Clause */
/* Cells of an area, and the two bounds of an integral of a convex function over each.
 *
 * Inner (Jensen): the load of a cell at its centroid. Outer: every point of the cell is a convex
 * combination of the corners of a polygon that contains the cell, so the load is given to these
 * corners in the same proportions. Proportions are linear in the point, or nearly, and integrate in
 * closed form.
 *
 *   rod       pieces; corners are their ends
 *   polygon   triangles (middle, corner, corner), each divided into n^2 equal ones; with pressures
 *             p_i at the three corners of area A, sum s: load A s/3, at barycentric (s + p_i)/(4s);
 *             corner i gets A (s + p_i)/12
 *   sector    r1 < rho < r2, |theta| < h: contained in the trapezium between the rays theta = +-h
 *             and the lines x = r1 cos h and x = r2, with corners at r1 and r2/cos h. A point is
 *             distributed to the lines according to its x and to the rays according to
 *             y/(x tan h). A ring is the case r1 = r2 */
#include "planar/cells.h"

#include <math.h>

#include "base/math.h"

/* Number of sectors of ring i of a disc: about as long as wide, and at least 4. */
static int sectors(int i) {
    const double around = 2 * CPSI_PI * (i + 0.5);
    return around < 4 ? 4 : (int)around;
}

double cpsi_cell_count(const CpsiPatch *patch, int n) {
    double count = 0;
    switch (patch->kind) {
    case CPS_PATCH_DISC:
        for (int i = 0; i < n; i++) count += sectors(i);
        return count;
    case CPS_PATCH_POLYGON: return (double)patch->corner_count * n * n;
    case CPS_PATCH_RING: return n + 3.0;
    default: return n;
    }
}

int cpsi_cell_fineness(const CpsiPatch *patch, double cells) {
    int low = 0, high = 1;
    while (cpsi_cell_count(patch, high) <= cells) high *= 2;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (cpsi_cell_count(patch, middle) <= cells)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double cpsi_cell_contacts(const CpsiPatch *patch, CpsPlanarSide side, int n) {
    const double cells = cpsi_cell_count(patch, n);
    if (side == CPS_PLANAR_INNER) return cells;
    return patch->kind == CPS_PATCH_ROD       ? cells + 1
           : patch->kind == CPS_PATCH_POLYGON ? 3 * cells
                                              : 2 * cells;
}

/* ---- rod ---- */

static bool rod_cells(const CpsiPatch *patch, CpsPlanarSide side, int n, CpsiCell *visit,
                      void *user) {
    const double h = patch->size / n, tilt = patch->tilt[0];
    double carried = 0; /* force on the end that this piece shares with the preceding one */
    for (int i = 0; i < n; i++) {
        const double middle = h * (2 * i + 1 - n), pressure = 1 + tilt * middle,
                     load = patch->strength / n * pressure;
        const double off =
            /* distance of the centroid from the middle */
            pressure > 0 ? tilt * h * h / (3 * pressure) : 0;
        const double s = side == CPS_PLANAR_INNER ? middle + off : middle - h;
        const double here = side == CPS_PLANAR_INNER ? load : carried + load * 0.5 * (1 - off / h);
        if (!visit(user, here, (double[2]){s * patch->axis[0], s * patch->axis[1]})) return false;
        carried = load * 0.5 * (1 + off / h);
    }
    const double end[2] = {patch->size * patch->axis[0], patch->size * patch->axis[1]};
    return side == CPS_PLANAR_INNER || visit(user, carried, end);
}

/* ---- ring and disc ---- */

/* A sector of r1 < rho < r2, |theta| <= h, under the load 1 + along x + across y per unit of its
 * mean: means of x, x^2, y^2; radius of the corners on lines 0 and 1. The left corner of a line
 * gets even + along x along + across x across, the right one even + along x along - across x
 * across. */
typedef struct RingSector {
    double x, xx, yy;
    double radius[2], even[2], along[2], across[2];
} RingSector;

static RingSector sector_of(double r1, double r2, int count) {
    const double h = CPSI_PI / count, mean = r2 > r1 ? (r1 + r2 * r2 / (r1 + r2)) * 2 / 3
                                                     : r1; /* 2/3 (r2^3 - r1^3)/(r2^2 - r1^2) */
    const double square = 0.5 * (r1 * r1 + r2 * r2), wobble = sin(2 * h) / (4 * h),
                 x1 = r1 * cos(h);
    const double yy_x = mean * (asinh(tan(h)) - sin(h)) / h; /* mean of y^2/x */
    RingSector sector = {.x = mean * sin(h) / h,
                         .xx = square * (0.5 + wobble),
                         .yy = square * (0.5 - wobble),
                         .radius = {r1, r2 / cos(h)}};

    /* means of load x l(x) (1 +- y/(x tan h))/2, where l = zero + slope x is 1 on the line and 0 on
     * the other */
    for (int line = 0; line < 2; line++) {
        const double slope = (line ? 1 : -1) / (r2 - x1), zero = (line ? 0 : 1) - x1 * slope;
        sector.even[line] = 0.5 * (zero + slope * sector.x);
        sector.along[line] = 0.5 * (zero * sector.x + slope * sector.xx);
        sector.across[line] = 0.5 * (zero * yy_x + slope * sector.yy) / tan(h);
    }
    return sector;
}

/* `count` equal sectors of r1 < rho < r2, which carry `load` together under uniform pressure. The
 * corners on a ray belong to the sectors on both of its sides. */
static bool sector_cells(const CpsiPatch *patch, double load, double r1, double r2, int count,
                         CpsPlanarSide side, CpsiCell *visit, void *user) {
    const RingSector sector = sector_of(r1, r2, count);
    const double share = load / count, h = CPSI_PI / count;
    double first[2] = {0, 0}, carried[2] = {0, 0};
    for (int i = 0; i < count; i++) {
        const double c = cos(h * (2 * i + 1)), s = sin(h * (2 * i + 1));
        const double along = patch->tilt[0] * c + patch->tilt[1] * s,
                     across = patch->tilt[1] * c - patch->tilt[0] * s;
        if (side == CPS_PLANAR_INNER) {
            const double all = 1 + along * sector.x, part = all > 0 ? 1 / all : 0;
            const double x = part * (sector.x + along * sector.xx), y = part * across * sector.yy;
            if (!visit(user, share * all, (double[2]){x * c - y * s, x * s + y * c})) return false;
            continue;
        }
        const double ray[2] = {cos(2 * h * i), sin(2 * h * i)};
        for (int line = 0; line < 2; line++) {
            const double even = sector.even[line] + along * sector.along[line],
                         odd = across * sector.across[line];
            const double right = share * fmax(even - odd, 0), radius = sector.radius[line];
            if (i == 0) first[line] = right;
            if (i > 0 &&
                !visit(user, carried[line] + right, (double[2]){radius * ray[0], radius * ray[1]}))
                return false;
            carried[line] = share * fmax(even + odd, 0);
        }
    }
    if (side == CPS_PLANAR_INNER) return true;
    return visit(user, carried[0] + first[0], (double[2]){sector.radius[0], 0}) &&
           visit(user, carried[1] + first[1], (double[2]){sector.radius[1], 0});
}

static bool disc_cells(const CpsiPatch *patch, CpsPlanarSide side, int n, CpsiCell *visit,
                       void *user) {
    for (int i = 0; i < n; i++) {
        const double load = patch->strength * (2 * i + 1) / ((double)n * n),
                     r1 = patch->size * i / n, r2 = patch->size * (i + 1) / n;
        if (!sector_cells(patch, load, r1, r2, sectors(i), side, visit, user)) return false;
    }
    return true;
}

/* ---- polygon ---- */

/* Position of node (i, j) of a triangle's lattice, and the pressure there relative to the mean. */
typedef struct LatticeNode {
    double r[2], pressure;
} LatticeNode;

static LatticeNode lattice_node(const CpsiPatch *patch, const double *a, const double *b, double i,
                                double j) {
    LatticeNode node = {.r = {a[0] * i + b[0] * j, a[1] * i + b[1] * j}};
    node.pressure = 1 + patch->tilt[0] * node.r[0] + patch->tilt[1] * node.r[1];
    return node;
}

/* `strength`: friction force of the triangle under mean pressure */
static bool triangle_cell(double strength, const LatticeNode corner[3], CpsPlanarSide side,
                          CpsiCell *visit, void *user) {
    const double sum = corner[0].pressure + corner[1].pressure + corner[2].pressure;
    double centroid[2] = {0, 0};
    for (int k = 0; k < 3; k++) {
        const double weight = (sum + corner[k].pressure) / 12;
        if (side == CPS_PLANAR_OUTER && !visit(user, strength * weight, corner[k].r)) return false;
        for (int x = 0; x < 2; x++) centroid[x] += sum > 0 ? 3 * weight / sum * corner[k].r[x] : 0;
    }
    return side == CPS_PLANAR_OUTER || visit(user, strength * sum / 3, centroid);
}

static bool polygon_cells(const CpsiPatch *patch, CpsPlanarSide side, int n, CpsiCell *visit,
                          void *user) {
    const double h = 1.0 / n;
    for (int edge = 0; edge < patch->corner_count; edge++) {
        const double *a = patch->corner + 2 * edge;
        const double *b = patch->corner + 2 * ((edge + 1) % patch->corner_count);
        const double strength =
            patch->strength * 0.5 * (a[0] * b[1] - a[1] * b[0]) / patch->area * h * h;
        for (int i = 0; i < n; i++)
            for (int j = 0; i + j < n; j++) {
                const LatticeNode right = lattice_node(patch, a, b, h * (i + 1), h * j);
                const LatticeNode left = lattice_node(patch, a, b, h * i, h * (j + 1));
                const LatticeNode near = lattice_node(patch, a, b, h * i, h * j);
                if (!triangle_cell(strength, (LatticeNode[3]){near, right, left}, side, visit,
                                   user))
                    return false;
                if (i + j + 2 > n) continue;
                const LatticeNode far = lattice_node(patch, a, b, h * (i + 1), h * (j + 1));
                if (!triangle_cell(strength, (LatticeNode[3]){right, far, left}, side, visit, user))
                    return false;
            }
    }
    return true;
}

bool cpsi_cells(const CpsiPatch *patch, CpsPlanarSide side, int n, CpsiCell *visit, void *user) {
    switch (patch->kind) {
    case CPS_PATCH_ROD: return rod_cells(patch, side, n, visit, user);
    case CPS_PATCH_RING:
        return sector_cells(patch, patch->strength, patch->size, patch->size, n + 3, side, visit,
                            user);
    case CPS_PATCH_DISC: return disc_cells(patch, side, n, visit, user);
    case CPS_PATCH_POLYGON: return polygon_cells(patch, side, n, visit, user);
    default: return true;
    }
}
