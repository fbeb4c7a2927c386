/* SPDX-License-Identifier: BSD-3-Clause */
/* The equilibrium of rigid bodies on elastic catenaries, by Newton's method on the closed forms.
 *
 * Between two points at the horizontal distance x and the rise z a line of pieces has one
 * horizontal force H, and a vertical force that falls from V at the upper end B by w L over a piece
 * and by P at a clump (P < 0: a buoy). A piece with V at its upper end and v at its lower one spans
 *
 *     x = (H/w) [asinh(V/H) - asinh(v/H)] + H L/EA
 *     z = (1/w) [sqrt(H^2 + V^2) - sqrt(H^2 + v^2)] + (V^2 - v^2)/(2 w EA).
 *
 * Where a line may rest at the level of its end A without friction, all that is below the first
 * point with V <= 0 lies there with the force H: x = L (1 + H/EA), z = 0. If the line is longer
 * than that with H = 0, it is loose: V is the weight of what hangs straight down.
 *
 * A body in the pose (r, R) has the forces of its lines, weight and buoyancy at their centres, a
 * load, and of the hydrostatics C, whose energy is q' C q/2 with q = (r - r0, phi), phi the
 * rotation vector of R R0', the force -(C q)_1 and the moment -J' (C q)_2, J = dphi/dtheta the
 * inverse left Jacobian of the rotations. */
#ifndef CAPSTAN_TEST_MOORING_NEWTON_H
#define CAPSTAN_TEST_MOORING_NEWTON_H

#include <stdbool.h>

enum { NEWTON_PIECES = 3, NEWTON_LINES = 12, NEWTON_BODIES = 3 };

typedef struct NewtonPiece {
    double length, weight, stiffness;
    double drop; /* [N] weight of the clump at its lower end */
} NewtonPiece;

typedef struct NewtonLine {
    int body[2];        /* of the ends A and B; -1: fixed */
    double place[2][3]; /* in the axes of the body, or of the scene */
    int count;
    NewtonPiece piece[NEWTON_PIECES]; /* from B to A */
    bool rests;                       /* on the level of its end A, where it is below B */
    double h, v;                      /* [N] at end B: out; h = 0: not yet known */
    double force[2][3];               /* [N] of the line on what holds A and B: out */
    double grounded;                  /* [m] natural length: out */
    bool loose;                       /* no horizontal force is left: out */
} NewtonLine;

typedef struct NewtonBody {
    double position[3], rotation[4];             /* out */
    double first_position[3], first_rotation[4]; /* reference of the hydrostatics */
    double weight, gravity_centre[3], buoyancy, buoyancy_centre[3], hydrostatics[36], load[6];
} NewtonBody;

typedef struct NewtonMooring {
    int lines, bodies;
    double size; /* [m] */
    NewtonLine line[NEWTON_LINES];
    NewtonBody body[NEWTON_BODIES];
    bool is_stable; /* the symmetric part of the stiffness is positive definite: out */
} NewtonMooring;

/* Find the poses from those in the struct; false: not found. */
bool newton_solve(NewtonMooring *m);

/* Where end e of a line is, and the arm from the reference point of its body. */
void newton_place(const NewtonMooring *m, const NewtonLine *line, int e, double at[3],
                  double arm[3]);

/* The least height of the hanging part of a line above its lower end; negative: it sags below. */
double newton_lowest(const NewtonLine *line);

void newton_matrix(const double rotation[4], double matrix[9]);
/* out = by exp(vector) applied after `rotation`. */
void newton_turn(const double rotation[4], const double vector[3], double out[4]);
/* The rotation vector of to from'. */
void newton_vector(const double to[4], const double from[4], double out[3]);

#endif
