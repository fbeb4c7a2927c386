/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that give (soft.h). */
#include "soft.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>

#include "grasps.h"
#include "inertia.h"

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
    const bool damps = nc_inq_attlen(source->nc, NC_GLOBAL, "obstacle_damping", &count) == NC_NOERR;
    const bool sound =
        !damps || (all && k < count &&
                   nc_get_att_double(source->nc, NC_GLOBAL, "obstacle_damping", all) == NC_NOERR &&
                   isfinite(all[k]) && all[k] >= 0 && (all[k] == 0 || surface->gives > 0));
    if (damps && sound) surface->damps = all[k];
    free(all);
    return good && sound ? 0 : complain(log, NAME);
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

int soft_areas_read(const Source *source, double *area, FILE *log) {
    static const char NAME[] = "bearing_area_of_point";
    size_t count = 0;
    bool any = false, good = true;
    for (size_t k = 0; k < source->points; k++) area[k] = 0;
    for (size_t k = 0; k < source->surfaces; k++) any = any || source->surface[k].gives > 0;
    if (!any) return 0;
    good = nc_inq_attlen(source->nc, NC_GLOBAL, NAME, &count) == NC_NOERR &&
           count == source->points &&
           nc_get_att_double(source->nc, NC_GLOBAL, NAME, area) == NC_NOERR;
    for (size_t k = 0; k < source->points && good; k++) good = isfinite(area[k]) && area[k] >= 0;
    return good ? 0 : complain(log, NAME);
}

Real soft_point_area(const Source *source, const Record *line, size_t point, double area) {
    Real all = area;
    for (size_t i = 0; i < source->lines; i++)
        for (int e = 0; e < 2; e++) {
            const Record *r = &line[i];
            if (r->end_point[e] == (int)point)
                all += (Real)r->bearing_width * r->element_length[e == 0 ? 0 : r->elements - 1] / 2;
        }
    return all;
}

SoftPush soft_point_push(const Surface *surface, Real area, const Real *x, const Real *reference,
                         double span) {
    const Real deep = -surface_distance(surface, x);
    SoftPush out = {.force = area * surface->gives * deep, .steep = area * surface->gives};
    if (surface->damps > 0 && span > 0) {
        const Real c = area * surface->damps / span,
                   past = fmaxl(0, -surface_distance(surface, reference));
        out.force += c * (deep - past);
        out.steep += c;
    }
    if (!(deep > 0) || out.force < 0) out.force = 0;
    return out;
}

/* The surface in which x lies deepest, and how deep; NULL: it lies in none. `moved`: x is carried
 * along first, by the motion of each in the step. */
static const Surface *deepest(const Source *source, const Real *x, bool moved, Real *depth) {
    const Surface *found = NULL;
    *depth = 0;
    for (size_t k = 0; k < source->surfaces; k++) {
        Real at[3];
        surface_shift(&source->surface[k], x, moved ? 1 : 0, at);
        const Real d = -surface_distance(&source->surface[k], at);
        if (!(d > *depth)) continue;
        *depth = d;
        found = &source->surface[k];
    }
    return found;
}

SoftWork soft_point_work(const Source *source, Real area, const double *from, const double *to,
                         double reaction) {
    Real x[3], was_at[3], moved[3], now, was;
    for (int a = 0; a < 3; a++) {
        x[a] = to[a];
        was_at[a] = from[a];
    }
    const Surface *on = deepest(source, x, false, &now),
                  *before = deepest(source, was_at, true, &was);
    SoftWork out = {0, 0, 0, 0};
    const Real pushes = on ? area * on->gives * now : 0,
               pushed = before ? area * before->gives * was : 0;
    out.stored = pushes * now / 2 - pushed * was / 2;
    out.presses = pushes + pushed;
    if (!on || !(on->damps > 0)) return out;
    surface_shift(on, was_at, 1, moved);
    const Real sunk = now - fmaxl(0, -surface_distance(on, moved));
    const Real beyond = reaction - pushes;
    out.damped = beyond * sunk;
    out.slope = fabsl(beyond) + area * on->gives * fabsl(sunk);
    return out;
}

/* [N/m] */
static Real stiffness(const Record *r, const Surface *surface, size_t j) {
    const Real before = j > 0 ? r->element_length[j - 1] : 0,
               after = j < r->elements ? r->element_length[j] : 0;
    return surface->gives * r->bearing_width * (before + after) / 2;
}

/* How far the ground below node j has risen along n since the reference. */
static Real risen(const Record *r, const Surface *surface, size_t j, const Real *n) {
    Real x[3], was[3], sum = 0;
    for (int a = 0; a < 3; a++) x[a] = r->position[j][a];
    surface_unshift(surface, x, r->share, was);
    for (int a = 0; a < 3; a++) sum += (x[a] - was[a]) * n[a];
    return sum;
}

Soft soft_spring(const Record *r, const Surface *surface, size_t j, const Real *n, Real gap,
                 Real distance, Real R) {
    const Real own = stiffness(r, surface, j);
    Real k = own, begins = 0;
    if (surface->damps > 0 && in_time(r)) {
        /* k d + c (d - past)/s is k' (d - begins) with k' = k + c/s */
        const Real c = own * surface->damps / surface->gives, s = r->span[j],
                   past = fmaxl(0, -(gap + risen(r, surface, j, n)));
        k = own + c / s;
        begins = c / s * past / k;
    }
    const Real sunk = fmaxl(0, -distance - begins), off = sunk - R / k;
    return (Soft){.energy = k * sunk * sunk / 2,
                  .conjugate = R * R / (2 * k),
                  .gap = k * off * off / 2 + R * fmaxl(0, distance + begins),
                  .begins = begins};
}

Surface soft_level(const Surface *surface, const Real *x) {
    static const bool IS_ROUND[SURFACE_KINDS] = {
        [SURFACE_CYLINDER] = true, [SURFACE_SPHERE] = true, [SURFACE_CAPSULE] = true,
        [SURFACE_TORUS] = true,    [SURFACE_CONE] = true,   [SURFACE_BOX] = true};
    if (!(surface->gives > 0) || !IS_ROUND[surface->kind]) return *surface;
    const Real depth = -surface_distance(surface, x);
    return depth > 0 ? surface_within(surface, fminl(depth, (Real)surface->radius / 2)) : *surface;
}

bool soft_bears(const Record *r, size_t j, size_t k) {
    if (node_is_held(r, j)) return true;
    for (size_t c = j; c < r->contacts * r->nodes; c += r->nodes)
        if ((size_t)r->obstacle[c] == k) return true;
    return r->has_elements && j > 0 && r->obstacle[r->contacts * r->nodes + j - 1] == (int)k;
}

/* [m] The depth of node j at x in `on`. */
static Real depth_of(const Surface *on, const Real *x) {
    return fmaxl(0, -surface_distance(on, x));
}

Real soft_growth(const Source *source, const Record *r, size_t j, const double *from,
                 double share) {
    Real sum = 0, x[3], was_at[3];
    for (int a = 0; a < 3; a++) {
        x[a] = r->position[j][a];
        was_at[a] = from[a];
    }
    for (size_t k = 0; k < source->surfaces; k++) {
        const Surface *on = &source->surface[k];
        Real before[3];
        if (!(on->gives > 0)) continue;
        surface_shift(on, was_at, share, before);
        const Real now = depth_of(on, x), was = depth_of(on, before);
        sum += stiffness(r, on, j) * (now - was) * (now + was) / 2;
    }
    return sum;
}

Real soft_energy_per_length(const Source *source, const Record *r, size_t j) {
    Real sum = 0, x[3];
    for (int a = 0; a < 3; a++) x[a] = r->position[j][a];
    for (size_t k = 0; k < source->surfaces && !node_is_held(r, j); k++)
        if (source->surface[k].gives > 0) {
            const Real d = depth_of(&source->surface[k], x);
            sum += source->surface[k].gives * r->bearing_width * d * d / 2;
        }
    return sum;
}

Real soft_energy(const Source *source, const Record *r, Real shifted) {
    Real sum = 0;
    for (size_t j = 0; j < r->nodes; j++)
        for (size_t k = 0; k < source->surfaces && !node_is_held(r, j); k++) {
            const Surface *on = &source->surface[k];
            Real x[3], at[3];
            if (!(on->gives > 0)) continue;
            for (int a = 0; a < 3; a++) x[a] = r->position[j][a];
            surface_shift(on, x, shifted, at);
            const Real d = depth_of(on, at);
            sum += stiffness(r, on, j) * d * d / 2;
        }
    return sum;
}

/* [J] What the damping at contact c, of node j, took. */
static Real damped_at(const Source *source, const Record *r, const Record *before, size_t j,
                      size_t c) {
    if (r->obstacle[c] < 0) return 0;
    const Surface *on = &source->surface[(size_t)r->obstacle[c]];
    if (!(on->damps > 0)) return 0;
    Real x[3], from[3], moved[3];
    for (int a = 0; a < 3; a++) {
        x[a] = r->position[j][a];
        from[a] = before->position[j][a];
    }
    surface_shift(on, from, 1, moved);
    const Real now = depth_of(on, x), was = depth_of(on, moved);
    return (r->reaction[c] - stiffness(r, on, j) * now) * (now - was);
}

double soft_damped(const Source *source, const Record *r, const Record *before) {
    Real sum = 0;
    bool any = false;
    for (size_t k = 0; k < source->surfaces; k++) any = any || source->surface[k].damps > 0;
    if (!any) return 0;
    for (size_t j = 0; j < r->nodes; j++) {
        if (node_is_held(r, j)) continue;
        for (size_t c = j; c < r->contacts * r->nodes; c += r->nodes)
            sum += damped_at(source, r, before, j, c);
        if (r->has_elements && j > 0)
            sum += damped_at(source, r, before, j, r->contacts * r->nodes + j - 1);
    }
    return (double)sum;
}
