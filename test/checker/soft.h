/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that give: a node at the depth d bears k d, k = pressure over depth x bearing width x
 * half of the elements beside the node; at no depth it bears nothing. In a step in time one with
 * damping opposes c d' besides, c by pressure over velocity likewise, but never pulls. */
#ifndef CAPSTAN_CHECKER_SOFT_H
#define CAPSTAN_CHECKER_SOFT_H

#include "record.h"

/* What the file has of obstacle k, and of a line. 0, or -1 after one sentence on log. */
int soft_read(const Source *source, size_t k, Surface *surface, FILE *log);
int soft_create(const Source *source, const char *line, Record *record, FILE *log);
/* [m2] The bearing areas of the points (points) themselves; 0 where nothing gives. */
int soft_areas_read(const Source *source, double *area, FILE *log);
/* [m2] With what a point of this area bears at which these lines of a step end: of each the half of
 * its last element besides, with its width. */
Real soft_point_area(const Source *source, const Record *line, size_t point, double area);
/* What a surface opposes to a free point with so much in all, at x: k d + c d' per area, in a step
 * in time by the velocity from the reference, which begins in the ground or on it; never a pull. */
typedef struct SoftPush {
    Real force, steep; /* [N], [N/m] by its derivative */
} SoftPush;
SoftPush soft_point_push(const Surface *surface, Real area, const Real *x, const Real *reference,
                         double span);
/* [J] What gives below a free point that was at `from`: by how much it has stored more, in each
 * place in that in which it lies deepest; and what its damping took, with this reaction. */
typedef struct SoftWork {
    Real stored, damped;
    Real presses, slope; /* [N] by which they change with the depths */
} SoftWork;
SoftWork soft_point_work(const Source *source, Real area, const double *from, const double *to,
                         double reaction);

/* What is below node j, `distance` above it along the normal n, where the reference was `gap`, with
 * the force R: its energy, the conjugate of that at R, and their sum plus R x distance, each >= 0.
 * In a step in time the velocity is that from the reference, which begins in the ground or on it,
 * less that of the ground; the energy is that of which the force is the derivative. */
typedef struct Soft {
    Real energy, conjugate, gap, begins; /* begins [m]: the depth at which it begins to press */
} Soft;
Soft soft_spring(const Record *r, const Surface *surface, size_t j, const Real *n, Real gap,
                 Real distance, Real R);

/* [J] What is stored in what gives below nodes that are not held; of the step before, on obstacles
 * that have been shifted by a share of the step since. And [N] per length of line at node j. */
Real soft_energy(const Source *source, const Record *r, Real shifted);
Real soft_energy_per_length(const Source *source, const Record *r, size_t j);

/* The surface along which a node at x slips: in what is round and gives its parallel there, not
 * deeper than half of the radius. */
Surface soft_level(const Surface *surface, const Real *x);

/* Is obstacle k that of a contact of node j? */
bool soft_bears(const Record *r, size_t j, size_t k);

/* [J] By how much what gives has stored more below node j since it was at `from`, before what gives
 * took the last part, a share, of its motion. */
Real soft_growth(const Source *source, const Record *r, size_t j, const double *from, double share);
/* [J] What the damping below all nodes that are not held took in the step from that before it. */
double soft_damped(const Source *source, const Record *r, const Record *before);

#endif
