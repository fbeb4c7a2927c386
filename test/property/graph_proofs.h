/* SPDX-License-Identifier: BSD-3-Clause */
/* What random_graphs derives from places, forces and the scene: proofs that a graph has no
 * equilibrium, and the laws of an inextensible line. */
#ifndef CAPSTAN_PROPERTY_GRAPH_PROOFS_H
#define CAPSTAN_PROPERTY_GRAPH_PROOFS_H

#include <stdbool.h>

#include "capstan/evolve.h"

/* What a step imposes on a scene in which every line ends at points: held points are at `at`, loads
 * act on free ones; the bed is the plane z = 0 with the coefficient mu, negative: there is none. */
typedef struct GraphStep {
    const CpsScene *scene;
    const CpsEvolution *evolution;
    const double (*at)[3], (*load)[3]; /* (points) */
    double mu, size;
} GraphStep;

/* Is the proof of every line that has one a proof of its group? Prints what is wrong. */
bool graph_proofs_hold(const GraphStep *step);

/* Does an inextensible line obey its laws: no element is too long, tension along it, none in what
 * is shorter, balance at every node inside, with Coulomb's law; to `force` [N]? */
bool graph_line_holds(const GraphStep *step, int line, double force);

#endif
