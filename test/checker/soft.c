/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that give (soft.h). */
#include "soft.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>

#include "grasps.h"

static int complain(FILE *log, const char *what) {
    if (log) fprintf(log, "a value that cannot be: %s\n", what);
    return -1;
}

int soft_read(const Source *source, size_t k, Surface *surface, FILE *log) {
    static const char NAME[] = "obstacle_stiffness";
    size_t count = 0;
    if (nc_inq_attlen(source->nc, NC_GLOBAL, NAME, &count) != NC_NOERR) return 0;
    double *all = k < count ? calloc(count, sizeof *all) : NULL;
    const bool good = all && nc_get_att_double(source->nc, NC_GLOBAL, NAME, all) == NC_NOERR &&
                      isfinite(all[k]) && all[k] >= 0;
    if (good) surface->gives = all[k];
    free(all);
    return good ? 0 : complain(log, NAME);
}

int soft_create(const Source *source, const char *line, Record *record, FILE *log) {
    char name[400];
    snprintf(name, sizeof name, "%s_bearing_width", line);
    double width = 0;
    bool any = false;
    for (size_t k = 0; k < source->surfaces; k++) any = any || source->surface[k].gives > 0;
    if (!any) return 0;
    if (nc_get_att_double(source->nc, NC_GLOBAL, name, &width) != NC_NOERR || !isfinite(width) ||
        !(width > 0))
        return complain(log, name);
    record->bearing_width = width;
    return 0;
}

/* [N/m] */
static Real stiffness(const Record *r, const Surface *surface, size_t j) {
    const Real before = j > 0 ? r->element_length[j - 1] : 0,
               after = j < r->elements ? r->element_length[j] : 0;
    return surface->gives * r->bearing_width * (before + after) / 2;
}

Soft soft_spring(const Record *r, const Surface *surface, size_t j, Real distance, Real R) {
    const Real k = stiffness(r, surface, j), sunk = fmaxl(0, -distance), off = sunk - R / k;
    return (Soft){.energy = k * sunk * sunk / 2,
                  .conjugate = R * R / (2 * k),
                  .gap = k * off * off / 2 + R * fmaxl(0, distance)};
}

Surface soft_level(const Surface *surface, const Real *x) {
    static const bool IS_ROUND[SURFACE_KINDS] = {
        [SURFACE_CYLINDER] = true, [SURFACE_SPHERE] = true, [SURFACE_CAPSULE] = true,
        [SURFACE_TORUS] = true,    [SURFACE_CONE] = true,   [SURFACE_BOX] = true};
    if (!(surface->gives > 0) || !IS_ROUND[surface->kind]) return *surface;
    const Real depth = -surface_distance(surface, x);
    return depth > 0 && depth < surface->radius / 2 ? surface_within(surface, depth) : *surface;
}

bool soft_bears(const Record *r, size_t j, size_t k) {
    if (node_is_held(r, j)) return true;
    for (size_t c = j; c < r->contacts * r->nodes; c += r->nodes)
        if ((size_t)r->obstacle[c] == k) return true;
    return r->has_elements && j > 0 && r->obstacle[r->contacts * r->nodes + j - 1] == (int)k;
}

Real soft_growth(const Source *source, const Record *r, size_t j) {
    Real sum = 0, x[3], from[3];
    for (int a = 0; a < 3; a++) {
        x[a] = r->position[j][a];
        from[a] = r->reference[j][a];
    }
    for (size_t k = 0; k < source->surfaces; k++) {
        const Surface *on = &source->surface[k];
        Real before[3];
        if (!(on->gives > 0)) continue;
        surface_shift(on, from, r->share, before);
        const Real now = fmaxl(0, -surface_distance(on, x)),
                   was = fmaxl(0, -surface_distance(on, before));
        sum += stiffness(r, on, j) * (now - was) * (now + was) / 2;
    }
    return sum;
}
