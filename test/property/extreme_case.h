/* SPDX-License-Identifier: BSD-3-Clause */
/* The classes of random_extremes.c: reporting of failures, and comparison of a cone of velocities
 * with the expected one. */
#ifndef CAPSTAN_TEST_EXTREME_CASE_H
#define CAPSTAN_TEST_EXTREME_CASE_H

#include "capstan/law.h"
#include "random_case.h"

enum { CLASSES = 11, MOST = 4 };

/* Directions and points of sizes of order one to ten: what the sets promise, 1e-9 of the size, with
 * a factor for cones made of normals that are known to 1e-7. */
static const double CLOSE = 1e-6;

extern int failures, failed[CLASSES], class_of_case;

void fail(const char *what, double got, double expected);

void near(const char *what, double got, double expected, double allowed);

/* Wide enough for every enumeration, with a sign or without. */
void same(const char *what, long long got, long long expected);

double dot(int n, const double *a, const double *b);

/* The cone of velocities at a force, against the generators that it should have: -normals (count,
 * n), lines both ways. All of them lie in the cone; it has the dimension; and what is a generator's
 * opposite, but in no cone of these normals, does not lie in it. `outside` (n): a direction that is
 * not in it, or NULL. */
void compare_cone(const CpsSet *law, int n, const double *force, int count, const double *normals,
                  int dimension, const double *outside);

/* A unit vector of n components whose entries are Pythagorean. */
void unit_vector(int n, double *u);

/* The friction law of a set, which it takes over. */
CpsLaw *law_of(CpsSet *set);

/* ---- the classes ---- */

/* extreme_hulls.c */
void try_polygon(void);
void try_solid(void);

/* extreme_cones.c */
void try_lines(void);
void try_cone(void);

/* extreme_sets.c */
void try_touching(void);
void try_unbounded(void);
void try_polar(void);

/* extreme_motions.c */
void try_flat(void);
void try_limit(void);
void try_wheel(void);

/* extreme_table.c */
void try_table(void);

#endif
