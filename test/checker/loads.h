/* SPDX-License-Identifier: BSD-3-Clause */
/* What acts on the nodes of a line beside its weight: springs, given loads, and the drag of a
 * current, all from the file. */
#ifndef CAPSTAN_CHECKER_LOADS_H
#define CAPSTAN_CHECKER_LOADS_H

#include "record.h"
#include "sea.h"

/* Of one line and step; arrays are NULL where the file has none. */
typedef struct Loads {
    /* (nodes) of springs: K, its xx, yy, zz and xy, xz, yz; a; y */
    Vector *stiffness, *coupling, *place, *beside;
    Vector *given; /* (nodes) [N] given loads and drag */
    /* (nodes) of a potential that the program gives: its force, part of `given`, and its energy
     * [J], with those of the step before, where there is one; NULL without */
    Vector *pull, *pull_before;
    double *energy, *energy_before;
    bool has_before;
    double ledger, residual; /* as claimed */
    bool has_drag;
    double drag[3];  /* diameter, coefficients across and along */
    double added[2]; /* coefficients of the water that is moved along, across and along */
    double density;
    size_t rows;
    double *row; /* (rows, 4) z and velocity */
    Sea sea;     /* of a line with drag */
    /* (elements) [m/s], [m/s2] in the middle of each, where the program moves the water; else NULL
     */
    Vector *water, *water_rate;
} Loads;

/* What the file has of a line; record->loads is NULL where that is nothing. Both return 0, or -1
 * after one sentence on log. */
int loads_create(const Source *source, const char *line, Record *record, FILE *log);
int loads_read(const Source *source, const char *line, size_t step, Record *record, FILE *log);
void loads_free(Record *record);

/* Of the springs of a node: their force in the balance, what they have of energy, dual and gap, and
 * by how much their energy has fallen since the reference. */
typedef struct Spring {
    Real force[3], energy, dual, gap, fall;
} Spring;
Spring loads_spring(const Record *record, size_t j);

/* Add what the springs of node j do on it, and the contacts of its elements: reaction and friction
 * by their shares. */
void loads_add_others(const Record *record, size_t j, Real *sum);

/* [J] The work of springs, given loads and drag in the step: of drag the mean of before and after.
 */
Real loads_work(const Record *record);

/* Does the potential rise faster between the places of this step and of the one before than its
 * forces there say? No convex function does: U(y) >= U(x) - F(x).(y - x), of each node, both ways.
 * Of a step in one part. */
bool loads_are_convex(const Record *record);
/* [J] What the drag used and that of where the nodes are may differ by in it. */
double loads_open_work(const Record *record);

/* [m/s] The velocity of the current at height z. */
void loads_current(const Loads *loads, Real z, Real *u);

/* [N] The drag on node j at the places x, at rest. */
void loads_drag(const Record *record, Vector *x, size_t j, Real *out);
/* [N] ... of a step in time, where the line has come to be: drag in the water relative to the node,
 * what the water that is moved along opposes to its acceleration, and what the water does that
 * waves accelerate. */
typedef struct Flow {
    Real drag[3], added[3], wave[3];
} Flow;
Flow loads_flow(const Record *record, size_t j);
/* [N] What the rounding of the places of all nodes leaves of the forces of inertia and flow. */
double loads_rounding(const Record *record);

#endif
