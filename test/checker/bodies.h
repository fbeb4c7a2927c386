/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies, recomputed from a file (docs/results.md, docs/theory.md 6e). */
#ifndef CAPSTAN_CHECKER_BODIES_H
#define CAPSTAN_CHECKER_BODIES_H

#include "record.h"

enum { BODY_HELD, BODY_FREE, BODY_KINDS };
enum { ON_NO_BODY = -1, SIX = 6, FOUR = 4 };

/* What a body is: numbers of the scene. */
typedef struct BodyData {
    char *name;
    int kind; /* where the run begins */
    bool fixed[SIX];
    double weight, buoyancy; /* [N] under the gravity of the scene */
    Vector centre_of_gravity, centre_of_buoyancy, start_position;
    double start_rotation[FOUR], hydrostatics[SIX * SIX];
} BodyData;

/* A body after a step; forces, then moments about its reference point, are on the body. */
typedef struct BodyState {
    Vector position;
    double rotation[FOUR], lines[SIX], load[SIX], support[SIX], residual[SIX], stiffness[SIX * SIX];
    Vector proof;        /* an axis about which it is turned in every pose, else 0 */
    double proof_moment; /* [N m] */
    int kind;
    bool is_stable, has_place;
} BodyState;

/* The bodies of a file, and the points on them. */
typedef struct Bodies {
    size_t count;
    BodyData *data; /* (count) */
    int *of_point;  /* (points of the source) the body that it is on */
    Vector *place;  /* (points of the source) [m] where on it */
} Bodies;

/* All return 0, or -1 after one sentence on log. A file without bodies has none. */
int bodies_open(const Source *source, Bodies *bodies, FILE *log);
int bodies_read(const Source *source, const Bodies *bodies, size_t step, BodyState *all, FILE *log);
void bodies_close(Bodies *bodies); /* accepts a zeroed struct */

/* What weight, buoyancy and hydrostatics do to a body in a pose; gravity per that of the scene. */
void body_load(const BodyData *data, const Vector position, const double rotation[FOUR],
               const double gravity[3], Real load[SIX]);

/* The same where, beyond half a turn from the start, the vector of the turn goes on as it does on
 * the side of the rotation `side`. */
void body_load_beside(const BodyData *data, const Vector position, const double rotation[FOUR],
                      const double side[FOUR], const double gravity[3], Real load[SIX]);

/* The matrix of a rotation, a quaternion of any length but 0. */
void body_matrix(const double rotation[FOUR], Real m[3][3]);

/* Where a point of the body's axes is. */
void body_place(const Vector position, const double rotation[FOUR], const Vector on_body,
                Real place[3]);

/* Check the bodies of all steps: the places of their points, the forces and moments of the lines,
 * the balance, and what is claimed of them. As points_check. */
typedef void BodyFinding(void *user, const char *name, size_t step, const char *sentence);
int bodies_check(const Source *source, bool (*certified)(int outcome), BodyFinding *find,
                 void *user, FILE *log);

#endif
