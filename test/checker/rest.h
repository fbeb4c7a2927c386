/* SPDX-License-Identifier: BSD-3-Clause */
/* Smallest and largest tension of an inextensible line that is held where it is, by the checker's
 * conic solver.
 *
 * The unknowns are the tensions of all taut elements. The remaining force at a node is that of its
 * contacts,
 *
 *     c_j = T_j t_j - T_j+1 t_j+1 - b_j,
 *
 * and must lie in their cone: 0 at a free node, R n + F with |F| <= mu R where it sticks, R (n - mu
 * u/|u|) where it slips. At a node with two contacts the force of the first is an unknown too. */
#ifndef CAPSTAN_CHECKER_REST_H
#define CAPSTAN_CHECKER_REST_H

#include <stdbool.h>
#include <stddef.h>

#include "conic.h"

typedef enum RestContact { REST_APART, REST_STICKS, REST_SLIPS } RestContact;

/* Nodes 0..elements; contact c is the first of node c, or the second of node c - nodes. */
typedef struct RestLine {
    size_t elements, contacts;
    const double *element_length, (*position)[3], (*load)[3];
    const double (*normal)[3], (*slip)[3]; /* (contacts, nodes) */
    const double *friction;                /* (contacts, nodes) mu, or the bound [N] where frozen */
    const RestContact *contact;            /* (contacts, nodes) */
    bool frozen;
    const bool *held; /* (nodes) */
    double force;     /* [N] of the size of the largest */
} RestLine;

/* Tensions above so many times the force are not looked at: "unbounded". */
#define REST_MOST 1e2

/* The least (sign -1) or greatest (1) tension of an element [N]; NAN: not found, INFINITY:
 * unbounded. */
double rest_tension(const RestLine *line, size_t element, int sign);

/* The same with forces that need to balance no better than places are known: no range of the line
 * is wider. */
double rest_tension_about(const RestLine *line, size_t element, int sign);

#endif
