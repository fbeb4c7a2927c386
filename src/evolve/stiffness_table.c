/* SPDX-License-Identifier: BSD-3-Clause */
/* Tables of strain and tension (stiffness_table.h). */
#include "evolve/stiffness_table.h"

#include <math.h>
#include <stdio.h>

#include "evolve/ranges.h"

/* Slopes that differ by no more than this share are the same: that of rows written in decimals. */
static const double SAME_SLOPE = 1e-12;

/* [N] Slope of the piece from row i to the next. */
static double slope_of(const CpsStiffnessRow *row, int i) {
    return (row[i + 1].tension - row[i].tension) / (row[i + 1].strain - row[i].strain);
}

static const char *row_fault(const CpsStiffnessRow *row, int i, char *found, size_t size) {
    if (!cpsi_is_usable(row[i].strain) || !cpsi_is_usable(row[i].tension)) {
        snprintf(found, size, "row %d is %g, %g N, expected finite numbers", i + 1, row[i].strain,
                 row[i].tension);
        return found;
    }
    if (i == 0) {
        if (row->strain == 0 && row->tension == 0) return NULL;
        snprintf(found, size, "begins with %g, %g N, expected 0, 0", row->strain, row->tension);
        return found;
    }
    if (!(row[i].strain > row[i - 1].strain) || !(row[i].tension > row[i - 1].tension)) {
        snprintf(found, size,
                 "goes from %g, %g N to %g, %g N in row %d, expected a larger strain and a larger "
                 "tension",
                 row[i - 1].strain, row[i - 1].tension, row[i].strain, row[i].tension, i + 1);
        return found;
    }
    if (!cpsi_is_positive(slope_of(row, i - 1))) {
        snprintf(found, size, "rises by %g N from row %d to row %d, too steeply for a number",
                 row[i].tension - row[i - 1].tension, i, i + 1);
        return found;
    }
    if (i < 2 || slope_of(row, i - 1) >= (1 - SAME_SLOPE) * slope_of(row, i - 2)) return NULL;
    snprintf(found, size,
             "becomes softer at row %d, from %g N to %g N: expected slopes that do not fall; give "
             "the chord over the rows between",
             i, slope_of(row, i - 2), slope_of(row, i - 1));
    return found;
}

const char *cpsi_stiffness_table_fault(const CpsStiffnessRow *row, int count, char *found,
                                       size_t size) {
    if (count < 2 || count > CPS_MAX_STIFFNESS_ROWS || !row) {
        snprintf(found, size, "has %d rows, expected 2 to %d", row ? count : 0,
                 CPS_MAX_STIFFNESS_ROWS);
        return found;
    }
    for (int i = 0; i < count; i++) {
        const char *fault = row_fault(row, i, found, size);
        if (fault) return fault;
    }
    return NULL;
}

double cpsi_stiffness_strain(double stiffness, const CpsStiffnessRow *row, int count,
                             double tension) {
    int k = 1;
    if (count == 0) return tension / stiffness;
    while (k + 1 < count && row[k].tension < tension) k++;
    return row[k].strain + (tension - row[k].tension) * (row[k].strain - row[k - 1].strain) /
                               (row[k].tension - row[k - 1].tension);
}

/* The slope beyond the last row. */
static double last_slope(double stiffness, const CpsStiffnessRow *row, int count) {
    return count > 0 ? slope_of(row, count - 2) : stiffness;
}

bool cpsi_stiffness_is_softer(double stiffness, const CpsStiffnessRow *row, int count,
                              const CpsDynamicStiffness *other, double *at, double strain[2]) {
    double most = 0; /* largest tension of a row */
    for (int k = 0; k < count + other->row_count; k++) {
        const double tension = k < count ? row[k].tension : other->row[k - count].tension;
        if (!(tension > 0)) continue;
        most = fmax(most, tension);
        *at = tension;
        strain[0] = cpsi_stiffness_strain(stiffness, row, count, tension);
        strain[1] = cpsi_stiffness_strain(other->stiffness, other->row, other->row_count, tension);
        if (strain[1] > (1 + SAME_SLOPE) * strain[0]) return true;
    }
    if (last_slope(other->stiffness, other->row, other->row_count) >=
        (1 - SAME_SLOPE) * last_slope(stiffness, row, count))
        return false;
    /* it is so from some tension on */
    *at = most > 0 ? most : stiffness;
    do {
        *at *= 2;
        strain[0] = cpsi_stiffness_strain(stiffness, row, count, *at);
        strain[1] = cpsi_stiffness_strain(other->stiffness, other->row, other->row_count, *at);
    } while (strain[1] <= strain[0] && *at < 1e300);
    return true;
}

double cpsi_stiffness_table_first(const CpsStiffnessRow *row) { return slope_of(row, 0); }

int cpsi_stiffness_table_springs(const CpsStiffnessRow *row, int count, double *start,
                                 double *stiffness) {
    int springs = 0;
    for (int i = 1; i + 1 < count; i++) {
        const double slope = slope_of(row, i), more = slope - slope_of(row, i - 1);
        if (!(more > SAME_SLOPE * slope)) continue;
        if (start) start[springs] = row[i].strain;
        if (stiffness) stiffness[springs] = more;
        springs++;
    }
    return springs;
}
