/* SPDX-License-Identifier: BSD-3-Clause */
/* What acts on the nodes of a line beside its weight (field.h): on node j the force
 *
 *     load_j - K_j (x_j - a_j),      with the energy  (x_j - a_j)'K_j (x_j - a_j)/2 - load_j.x_j
 *
 * K_j is symmetric, and 0 or more in every direction. Whoever takes a step fills the arrays before
 * it; they may change from one substep to the next, and are 0 until they are filled. Several terms
 * add up: K is their sum, and K a the sum of their K a (cpsi_line_field_add). */
#ifndef CAPSTAN_SRC_CABLE_NODE_FIELD_H
#define CAPSTAN_SRC_CABLE_NODE_FIELD_H

#include "base/vec3.h"
#include "cable/anderson.h"
#include "cable/water_lanes.h"
#include "cable/waves.h"
#include "capstan/loads.h"

/* The motion of the water that a program gives. */
typedef struct CpsiGivenWater {
    CpsWaterFunction *function;
    void *user;
    double origin[3]; /* [m] of line->position, in the axes of the scene */
    double time;      /* [s] of the motion asked for */
} CpsiGivenWater;

/* A current about a line. */
typedef struct CpsiFlow {
    double density; /* [kg/m3] */
    CpsDrag drag;
    int row_count;
    const CpsCurrentRow *row;
    const CpsiWaves *waves;      /* NULL: none */
    const CpsiGivenWater *given; /* NULL: none */
} CpsiFlow;

/* A potential of a program's own (potential.h). */
typedef struct CpsiPotential {
    CpsPotential given;
    double origin[3]; /* [m] of line->position, in the axes of the scene */
} CpsiPotential;

typedef struct CpsiNodeField {
    double *load; /* (n, 3) [N] a load of each node; NULL: none */
    /* (n, 6) [N/m] K as xx, xy, yy, xz, yz, zz; NULL: there is none, and the rest is not read */
    double *stiffness;
    double *place; /* (n, 3) [m] a, in the axes and from the origin of line->position */
    /* [N] size of the forces that it causes, where K (x_R - a) is no measure of it as for a mass
     * that goes on; 0: the sum of the |K (x_R - a)| */
    double size;
    /* left by a step: (n, 3) [m] y, small: in the balance of forces the field is taken at x + y,
     * whose part of the gap is y'K y/2 */
    double *beside;
    double *program; /* (n, 6) K in the axes and units of a program */
    /* what the scene gives, to which cpsi_line_field_clear sets load, K and a; NULL as these */
    double *own_load, *own_stiffness, *own_place;
    double *base_load; /* (n, 3) [N] own_load without that of the function; NULL: there is none */
    CpsLineForceFunction *function; /* of a load along the line, and its argument */
    void *user;
    double *diagonal, *coupling; /* (n, 3) [N/m] of own_stiffness: xx, yy, zz; xy, xz, yz */
    const CpsiFlow *flow;        /* NULL: none */
    double *all;                 /* (n, 3) [N] load, drag, pull, added and wave; NULL as load */
    CpsiAnderson rounds;         /* of the drag */
    CpsiPotential potential;     /* without a function: none, and the next arrays are not there */
    double *share;               /* (n) [m] length of the line at each node that has it */
    double *pull;                /* (n, 3) [N] its force where the line was last seen */
    double *energy;              /* (n) [J] its energy there */
    double *drag; /* (n, 3) [N] of the flow, where the line was last seen; NULL: none */
    /* of a step in time (moving_flow.h): */
    double *added; /* (n, 3) [N] of the water that is moved along; NULL without inertia or loads */
    double *wave;  /* (n, 3) [N] of the water's own acceleration; likewise */
    /* (n, eight at a time) of the water where the line was last seen, and how that is found;
     * likewise */
    CpsiWaterForces *seen;
    CpsiWaterLoop *see;
    double left; /* [N] sum over the nodes of what the last program lacked of the flow's forces */
} CpsiNodeField;

/* K v for K (6). */
static inline Vec3 cpsi_node_field_product(const double k[6], Vec3 v) {
    return vec3(k[0] * v.x + k[1] * v.y + k[3] * v.z, k[1] * v.x + k[2] * v.y + k[4] * v.z,
                k[3] * v.x + k[4] * v.y + k[5] * v.z);
}

/* [N] The force -K (x - a) on node j at x, 0 where there is no K; and with the load of the node. */
static inline Vec3 cpsi_node_field_force(const CpsiNodeField *field, int j, Vec3 x) {
    if (!field->stiffness) return vec3(0, 0, 0);
    return cpsi_node_field_product(&field->stiffness[6 * j], vec3_sub(vec3_at(field->place, j), x));
}
static inline Vec3 cpsi_node_field_at(const CpsiNodeField *field, int j, Vec3 x) {
    const Vec3 force = cpsi_node_field_force(field, j, x);
    return field->load ? vec3_add(vec3_at(field->load, j), force) : force;
}

#endif
