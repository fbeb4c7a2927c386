/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends of a line that are held to convex sets (capstan/constraint.h). Such an end is free: it has a
 * load, and beside it the reaction of its set. */
#ifndef CAPSTAN_SRC_CABLE_END_SET_H
#define CAPSTAN_SRC_CABLE_END_SET_H

#include <stdbool.h>

#include "base/vec3.h"

struct CpsiEndSet;
struct CpsiLine;
struct CpsiChainProgram;
struct CpsiConstraints;

bool cpsi_line_has_sets(const struct CpsiLine *line);

/* The place of the set nearest to x; NAN where it is not found. */
Vec3 cpsi_end_set_project(const struct CpsiEndSet *on, Vec3 x);

/* [J] The gap of a set with its reaction at x: as of a node below. */
double cpsi_end_set_gap(const struct CpsiEndSet *on, Vec3 x);

/* [m] sup over y in the set of v.(y - x): its support function seen from x. INFINITY: v leads along
 * a direction in which the set has no end, by more than rounding of a unit vector. */
double cpsi_end_set_beyond(const struct CpsiEndSet *on, Vec3 v, Vec3 x);

/* Add a set as a constraint of node j of a program, from its base [m] and with its axes (9), in
 * units of `length` [m]. */
void cpsi_end_set_fill(const struct CpsiEndSet *on, int j, Vec3 base, const double *axes,
                       double length, struct CpsiConstraints *out);

/* Is node j an end that is held to a set? */
bool cpsi_line_is_in_set(const struct CpsiLine *line, int j);

/* [N] The reaction of the set of node j; 0 where there is none. */
Vec3 cpsi_line_set_reaction(const struct CpsiLine *line, int j);

/* [J] The gap of the set of node j: its support function at -r, plus r.x. INFINITY: r leads along a
 * direction in which the set has no end. */
double cpsi_line_set_gap(const struct CpsiLine *line, int j);

void cpsi_line_clear_set_reactions(struct CpsiLine *line);

/* Let the sets take `rest`, what the forces on a line without a held node leave, where their
 * reactions may grow; returns what they do not take. */
Vec3 cpsi_line_sets_take(struct CpsiLine *line, Vec3 rest);

/* Write the sets as constraints of the program, in lengths of the line, from the base (n, 3) [m]
 * and the axes of the nodes, (9) each, of which there is one for all where `common`. */
void cpsi_line_fill_sets(const struct CpsiLine *line, struct CpsiChainProgram *program,
                         const double *base, const double *axes, bool common);
/* Read the reactions back, and put the ends into their sets, by rounding. */
void cpsi_line_unpack_sets(struct CpsiLine *line, const struct CpsiChainProgram *program,
                           double force);

/* [m] The least distance between the places of two nodes that are held, or in a set, the last one
 * of which is an end in its set; what an inextensible line between them needs. `apart`: the unit
 * vector from the first to the second. *length is the natural length between. False: there is no
 * such end, or nothing else holds the line. */
bool cpsi_line_set_distance(const struct CpsiLine *line, double *distance, double *length,
                            Vec3 *apart);

/* The part of v along which all sets of a line without held nodes let it go. */
Vec3 cpsi_line_sets_let(const struct CpsiLine *line, Vec3 v);

#endif
