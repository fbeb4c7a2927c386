/* SPDX-License-Identifier: BSD-3-Clause */
/* The equations of active cones (active_cone.h). */
#include "conic/active_cone.h"

#include <string.h>

#include "linalg/dense.h"

CpsiActive cpsi_active(const double *s, const double *z, int d) {
    const double s1 = cpsi_norm(d - 1, s + 1), z1 = cpsi_norm(d - 1, z + 1);
    if (z[0] + z1 < s[0] - s1) return CPSI_FREE;
    return d > 1 && s[0] + s1 > z[0] - z1 ? CPSI_RAY : CPSI_TIP;
}

CpsiActive cpsi_active_corrected(CpsiActive kind, const double *z, int d) {
    /* of a ray both terms of the sum are as large */
    const bool curved = d > 1,
               pressed = kind == CPSI_RAY ? z[0] > 0 : z[0] + cpsi_norm(d - 1, z + 1) > 0;
    if (kind == CPSI_FREE) return curved ? CPSI_RAY : CPSI_TIP;
    if (!curved || !pressed) return CPSI_FREE;
    return kind == CPSI_TIP ? CPSI_RAY : CPSI_TIP;
}

bool cpsi_active_place(CpsiActive kind, const double *s, double *z, int d) {
    if (kind == CPSI_TIP) return z[0] >= cpsi_norm(d - 1, z + 1);
    const double size = cpsi_norm(d - 1, s + 1);
    if (kind == CPSI_FREE) {
        memset(z, 0, (size_t)d * sizeof *z);
        return s[0] >= size;
    }
    if (!(size > 0)) return false;
    for (int r = 1; r < d; r++) z[r] = -z[0] * s[r] / size;
    return z[0] >= 0;
}

int cpsi_active_values(CpsiActive kind, const double *s, int d, double *out) {
    const int count = cpsi_active_count(kind, d);
    for (int r = 0; r < count; r++) out[r] = -s[r];
    if (kind == CPSI_RAY) out[0] = cpsi_norm(d - 1, s + 1) - s[0];
    return count;
}

int cpsi_active_gradients(CpsiActive kind, int n, const double *a, const double *s, int d,
                          size_t stride, double *out) {
    const size_t width = (size_t)n;
    const int count = cpsi_active_count(kind, d);
    for (int r = 0; r < count; r++)
        memcpy(&out[(size_t)r * stride], &a[(size_t)r * width], width * sizeof *out);
    if (kind != CPSI_RAY) return count;
    const double size = cpsi_norm(d - 1, s + 1);
    for (int r = 1; r < d; r++)
        for (size_t j = 0; j < width; j++) out[j] -= s[r] / size * a[(size_t)r * width + j];
    return count;
}
