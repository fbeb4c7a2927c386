/* SPDX-License-Identifier: BSD-3-Clause */
/* All motions and all forces for one W.
 *
 * Solutions combine freely: every V of a solution is a solution with every F of another (phi(V) = -
 * <V, F> for both, Proposition 2). So with one pair (V*, F*), in coordinates V = V* + N y, F = F* +
 * L t of null_space.h,
 *
 *     motions   { y : -(U* + B N y) in N_C(F*) }          an intersection of preimages of cones
 *     forces    { t : F* + L t in the face of C at -U* }   an intersection of preimages of faces
 *
 * U* and F* are known up to rounding, so a cone or face is translated by the shortest vector for
 * which it contains them; the length of that vector is reported. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "drive/motion.h"
#include "drive/null_space.h"
#include "linalg/dense.h"

/* Distance from rest or from a boundary that counts as zero, where the caller gives none. */
static const double TOLERANCE = 1e-6;
/* A neighbour of V is at this distance, relative to its size. */
static const double NEIGHBOUR = 1e-2;
/* A set moved by more than this many tolerances does not belong to the solution. */
static const double MOST_MOVED = 1000;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the set of solutions");
}

void cps_solution_set_clear(CpsSolutionSet *all) {
    if (!all) return;
    cps_set_release(all->set);
    *all = (CpsSolutionSet){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
}

/* The set under construction: parts in the coordinates y or t. */
typedef struct Gather {
    const CpsMotion *motion;
    CpsiDense dense;
    int space;           /* number of coordinates */
    const double *basis; /* (space, size of V or F) */
    double tolerance;
    double *map, *point; /* scratch: (components, space), (components) */
    CpsSet **part;
    int parts;
    CpsSolutionSet found;
} Gather;

static void clear(Gather *g) {
    for (int k = 0; k < g->parts; k++) cps_set_release(g->part[k]);
    free(g->part);
    free(g->map);
    cpsi_dense_clear(&g->dense);
}

static CpsStatus begin(const CpsMotion *motion, double tolerance, bool forces, Gather *g,
                       CpsError *err) {
    *g = (Gather){.motion = motion, .tolerance = tolerance > 0 ? tolerance : TOLERANCE};
    g->found.tolerance = g->tolerance;
    if (!(tolerance >= 0) || !(tolerance < 1))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the tolerance is %g, expected 0, or a number between 0 and 1", tolerance);
    CpsStatus status = cpsi_dense_new(motion->system, &g->dense, err);
    if (status != CPS_OK) return status;
    const CpsiDense *d = &g->dense;
    g->space = forces ? d->balanced : d->free;
    g->basis = forces ? d->forces : d->kernel;
    g->map = calloc(((size_t)g->space + 1) * (size_t)d->components + 1, sizeof *g->map);
    g->part = calloc((size_t)motion->system->pieces + 1, sizeof *g->part);
    if (!g->map || !g->part) return out_of_memory(err);
    g->point = g->map + (size_t)g->space * (size_t)d->components;
    return CPS_OK;
}

/* Require that x + map (y or t) lies in `set`, which is translated so that it contains x; `size` is
 * the unit of that distance. */
static CpsStatus require(Gather *g, const CpsSet *set, const double *x, double size,
                         CpsError *err) {
    CpsSetAnswer near;
    CpsStatus status = cps_set_project(set, x, NULL, g->point, &near, err);
    if (status != CPS_OK) return status;
    if (near.outcome != CPS_SET_OUTCOME_ANSWERED) {
        g->found.outcome = near.outcome;
        return CPS_OK;
    }
    if (near.value > 0)
        g->found.moved = fmax(g->found.moved, size > 0 ? near.value / size : near.value);
    if (g->space == 0) return CPS_OK;
    status = cps_set_preimage(g->space, g->map, g->point, set, &g->part[g->parts], err);
    if (status == CPS_OK) g->parts++;
    return status;
}

static double scale_of(int n, const double *a) {
    double largest = 0;
    for (int i = 0; i < n; i++) largest = fmax(largest, fabs(a[i]));
    return largest;
}

/* R^n, where there is no condition */
static CpsStatus whole_space(int n, CpsSet **out, CpsError *err) {
    double *ends = malloc(2 * (size_t)n * sizeof *ends);
    if (!ends) return out_of_memory(err);
    for (int i = 0; i < n; i++) {
        ends[i] = -INFINITY;
        ends[n + i] = INFINITY;
    }
    const CpsStatus status = cps_set_box(n, ends, ends + n, out, err);
    free(ends);
    return status;
}

/* Extents of the components, the dimension, and the set in the components of V or F. */
static CpsStatus finish(Gather *g, int n, const double *origin, double size, double *low,
                        double *high, CpsError *err) {
    CpsSolutionSet *found = &g->found;
    const size_t w = (size_t)n, q = (size_t)g->space;
    if (found->outcome == CPS_SET_OUTCOME_ANSWERED && found->moved > MOST_MOVED * g->tolerance)
        found->outcome = CPS_SET_OUTCOME_INACCURATE;
    if (found->outcome != CPS_SET_OUTCOME_ANSWERED) return CPS_OK;
    found->bounded = true;
    for (size_t i = 0; i < w; i++) {
        if (low) low[i] = origin[i];
        if (high) high[i] = origin[i];
    }
    if (q == 0) {
        found->unique = true;
        return cps_set_point(n, origin, &found->set, err);
    }
    CpsSet *inside = NULL, *image = NULL;
    double *turned = malloc((w * q + q + 1) * sizeof *turned),
           *direction = turned ? turned + w * q : NULL, widest = 0;
    CpsStatus status = turned ? CPS_OK : out_of_memory(err);
    if (status == CPS_OK && g->parts > 0)
        status = cps_set_intersection(g->parts, (const CpsSet *const *)g->part, &inside, err);
    else if (status == CPS_OK)
        status = whole_space(g->space, &inside, err);
    for (size_t i = 0; status == CPS_OK && i < w && found->outcome == CPS_SET_OUTCOME_ANSWERED;
         i++) {
        CpsSetExtent extent;
        for (size_t j = 0; j < q; j++) direction[j] = turned[i * q + j] = g->basis[j * w + i];
        if (scale_of(g->space, direction) == 0) continue;
        status = cps_set_extent(inside, direction, &extent, err);
        if (status != CPS_OK) break;
        found->outcome = extent.outcome;
        if (extent.outcome != CPS_SET_OUTCOME_ANSWERED) break;
        if (!isfinite(extent.low) || !isfinite(extent.high)) found->bounded = false;
        widest = fmax(widest, extent.high - extent.low);
        if (low) low[i] = origin[i] + extent.low;
        if (high) high[i] = origin[i] + extent.high;
    }
    /* a set no wider than the tolerance is a point; otherwise widths below the tolerance are
     * flat */
    CpsSetFacts facts = {.outcome = CPS_SET_OUTCOME_ANSWERED, .has_dimension = true};
    if (status == CPS_OK && found->outcome == CPS_SET_OUTCOME_ANSWERED &&
        !(widest <= g->tolerance * size)) {
        const double flat =
            isfinite(widest) ? fmin(0.1, g->tolerance * size / widest) : g->tolerance;
        status = cps_set_facts(inside, fmax(flat, 1e-9), &facts, NULL, NULL, err);
        found->outcome = facts.outcome;
    }
    found->dimension = facts.dimension;
    found->unique = facts.has_dimension && facts.dimension == 0;
    if (status == CPS_OK && found->outcome == CPS_SET_OUTCOME_ANSWERED)
        status = cps_set_image(n, turned, inside, &image, err);
    if (status == CPS_OK && image) status = cps_set_translate(origin, image, &found->set, err);
    cps_set_release(inside);
    cps_set_release(image);
    free(turned);
    return status;
}

static bool has_solution(const CpsMotion *motion) {
    const CpsMotionReport *report = &motion->report;
    const CpsMotionOutcome outcome = report->outcome;
    return (outcome == CPS_MOTION_OUTCOME_SOLVED || outcome == CPS_MOTION_OUTCOME_LIMIT_LOAD ||
            outcome == CPS_MOTION_OUTCOME_INACCURATE) &&
           isfinite(report->value);
}

/* ---- motions ---- */

static CpsStatus velocities_of_piece(Gather *g, int k, CpsError *err) {
    const CpsMotion *motion = g->motion;
    const CpsiPiece *piece = &motion->system->piece[k];
    const int first = motion->system->law[piece->law].first + piece->offset, n = g->dense.n;
    const double *u = &motion->law_velocity[first], *f = &motion->piece_force[motion->piece_at[k]];
    CpsSet *cone = NULL;
    CpsSetAnswer answer = {.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    const bool term = piece->term && piece->term->kind != CPSI_DRY;
    CpsStatus status;
    if (term && piece->term->kind == CPSI_VISCOUS)
        status = cps_set_point(piece->space, u, &cone, err);
    else if (term)
        status = cpsi_term_velocities(piece->space, piece->term, f, g->tolerance, &cone, err);
    else
        status = cps_set_velocities(piece->set, f, g->tolerance, &cone, &answer, err);
    if (status != CPS_OK) return status;
    if (!cone) {
        g->found.outcome = term ? CPS_SET_OUTCOME_NOT_AVAILABLE : answer.outcome;
        return CPS_OK;
    }
    for (int i = 0; i < piece->space; i++)
        for (int j = 0; j < g->space; j++)
            g->map[(size_t)i * (size_t)g->space + (size_t)j] =
                cpsi_dot(n, &g->dense.map[(size_t)(first + i) * (size_t)n],
                         &g->basis[(size_t)j * (size_t)n]);
    for (int i = 0; i < piece->space; i++)
        cpsi_dense_round((size_t)g->space,
                         cpsi_norm(n, &g->dense.map[(size_t)(first + i) * (size_t)n]),
                         &g->map[(size_t)i * (size_t)g->space]);
    status = require(g, cone, u, motion->speed, err);
    cps_set_release(cone);
    return status;
}

/* phi less the load's power at V + step d, INFINITY where it has no value; work (n + largest
 * law). */
static CpsStatus value_beside(const CpsMotion *motion, const double *d, double step, double *work,
                              double *value, CpsError *err) {
    const CpsSystem *system = motion->system;
    double *v = work, *u = work + system->n;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < system->n; i++) v[i] = motion->velocity[i] + step * d[i];
    *value = system->load ? -cpsi_dot(system->n, system->load, v) : 0;
    for (int l = 0; status == CPS_OK && l < system->laws; l++) {
        const CpsiSystemLaw *law = &system->law[l];
        for (int i = 0; i < law->space; i++)
            u[i] = cpsi_rows_times(&system->map, law->first + i, v);
        if (law->resistance) {
            CpsResistanceValue of = {0};
            status = cps_resistance_value(law->resistance, u, &of, NULL, err);
            *value += of.outcome == CPS_SET_OUTCOME_ANSWERED ? of.potential : INFINITY;
        } else {
            CpsSetAnswer phi = {0};
            status = cps_set_dissipation(cps_law_set(law->friction_law), u, NULL, &phi, err);
            *value += phi.outcome == CPS_SET_OUTCOME_ANSWERED ? phi.value : INFINITY;
        }
    }
    return status;
}

/* Whether the bounds distinguish V from its neighbours. They do not where a step of a hundredth
 * along a free direction raises phi by less than the distance of the bounds: the motion found is
 * then one of several within the bounds, and the answer `unique` would be unfounded. */
static CpsStatus check_distinguished(Gather *g, CpsError *err) {
    const CpsMotion *motion = g->motion;
    const size_t n = (size_t)motion->system->n;
    double *work = malloc((n + (size_t)motion->system->components + 1) * sizeof *work), beside;
    CpsStatus status = work ? CPS_OK : out_of_memory(err);
    for (int k = 0; status == CPS_OK && k < 2 * g->space; k++) {
        const double *d = &g->basis[(size_t)(k / 2) * n];
        const double step =
            (k % 2 ? -1 : 1) * NEIGHBOUR * motion->speed / fmax(scale_of((int)n, d), 1e-300);
        status = value_beside(motion, d, step, work, &beside, err);
        if (status == CPS_OK && beside - motion->report.upper < motion->report.minimum)
            g->found.outcome = CPS_SET_OUTCOME_INACCURATE;
    }
    if (g->found.outcome != CPS_SET_OUTCOME_ANSWERED) {
        cps_set_release(g->found.set);
        g->found.set = NULL;
    }
    free(work);
    return status;
}

CpsStatus cps_motion_velocities(const CpsMotion *motion, double tolerance, CpsSolutionSet *all,
                                double *low, double *high, CpsError *err) {
    if (!motion || !all) return cpsi_fail(err, CPS_ERR_ARGUMENT, "motion or all is NULL");
    *all = (CpsSolutionSet){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    if (!has_solution(motion)) return CPS_OK;
    Gather g;
    CpsStatus status = begin(motion, tolerance, false, &g, err);
    for (int k = 0; status == CPS_OK && k < motion->system->pieces &&
                    g.found.outcome == CPS_SET_OUTCOME_ANSWERED;
         k++)
        status = velocities_of_piece(&g, k, err);
    if (status == CPS_OK)
        status = finish(&g, motion->system->n, motion->velocity, motion->speed, low, high, err);
    if (status == CPS_OK && g.found.unique && motion->speed > 0 && motion->report.minimum > 0)
        status = check_distinguished(&g, err);
    if (status == CPS_OK)
        *all = g.found;
    else
        cps_set_release(g.found.set);
    clear(&g);
    return status;
}

/* ---- forces ---- */

/* A set for some components of all forces, from `first` on. */
static CpsStatus require_forces(Gather *g, const CpsSet *face, int first, int space,
                                CpsError *err) {
    const size_t c = (size_t)g->dense.components, p = (size_t)g->space;
    for (size_t i = 0; i < (size_t)space; i++)
        for (size_t j = 0; j < p; j++) g->map[i * p + j] = g->basis[j * c + (size_t)first + i];
    return require(g, face, &g->motion->law_force[first], g->motion->force, err);
}

static CpsStatus forces_of_piece(Gather *g, const CpsiPiece *piece, CpsError *err) {
    const CpsMotion *motion = g->motion;
    const int first = motion->system->law[piece->law].first + piece->offset;
    const double *u = &motion->law_velocity[first];
    CpsSet *face = NULL;
    CpsSetAnswer answer = {.outcome = CPS_SET_OUTCOME_ANSWERED};
    CpsStatus status = CPS_OK;
    /* a law at rest may have any of its forces */
    if (scale_of(piece->space, u) <= g->tolerance * motion->speed)
        face = cps_set_retain(piece->set);
    else
        status = cps_set_forces(piece->set, u, g->tolerance, &face, &answer, err);
    if (status == CPS_OK && face) status = require_forces(g, face, first, piece->space, err);
    if (!face) g->found.outcome = answer.outcome;
    cps_set_release(face);
    return status;
}

static CpsStatus forces_of_resistance(Gather *g, const CpsiSystemLaw *law, CpsError *err) {
    CpsSet *forces = NULL;
    CpsSetAnswer answer = {.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    const double *u = &g->motion->law_velocity[law->first];
    double *still = calloc((size_t)law->space + 1, sizeof *still);
    if (!still) return out_of_memory(err);
    const bool rest = scale_of(law->space, u) <= g->tolerance * g->motion->speed;
    CpsStatus status = cps_resistance_forces(law->resistance, rest ? still : u, g->tolerance,
                                             &forces, &answer, err);
    if (status == CPS_OK && forces) status = require_forces(g, forces, law->first, law->space, err);
    if (!forces) g->found.outcome = answer.outcome;
    cps_set_release(forces);
    free(still);
    return status;
}

CpsStatus cps_motion_forces(const CpsMotion *motion, double tolerance, CpsSolutionSet *all,
                            double *low, double *high, CpsError *err) {
    if (!motion || !all) return cpsi_fail(err, CPS_ERR_ARGUMENT, "motion or all is NULL");
    *all = (CpsSolutionSet){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    if (!has_solution(motion) || motion->system->components == 0) return CPS_OK;
    const CpsSystem *system = motion->system;
    Gather g;
    CpsStatus status = begin(motion, tolerance, true, &g, err);
    for (int l = 0;
         status == CPS_OK && l < system->laws && g.found.outcome == CPS_SET_OUTCOME_ANSWERED; l++) {
        const CpsiSystemLaw *law = &system->law[l];
        if (law->resistance) {
            status = forces_of_resistance(&g, law, err);
            continue;
        }
        for (int k = law->piece; status == CPS_OK && k < law->piece + law->pieces; k++)
            status = forces_of_piece(&g, &system->piece[k], err);
    }
    if (status == CPS_OK)
        status = finish(&g, system->components, motion->law_force, motion->force, low, high, err);
    if (status == CPS_OK)
        *all = g.found;
    else
        cps_set_release(g.found.set);
    clear(&g);
    return status;
}
