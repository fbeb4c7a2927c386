/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/body.h: rigid bodies that lines hold: a spar, a barge, a buoy with two eyes. Lines end at
 * points (point.h) that are on the body. A body is held in a pose, or free: then each load step
 * finds the pose in which the forces and moments on it balance (docs/theory.md 6e).
 *
 * A pose is the position of the body's reference point, the origin of its own axes, and a rotation
 * that turns these axes to those of the scene: a unit quaternion w, x, y, z, which turns by the
 * angle 2 acos(w) about (x, y, z) by the right-hand rule. Moments are about the reference point,
 * and in the axes of the scene. */
#ifndef CAPSTAN_BODY_H
#define CAPSTAN_BODY_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum CpsBodyKind {
    CPS_BODY_KIND_HELD, /* in its pose, which stages may change */
    CPS_BODY_KIND_FREE  /* where the forces and moments on it balance */
} CpsBodyKind;

/* Directions of a body: along x, y and z of the scene, and about them. */
enum { CPS_BODY_DIRECTIONS = 6 };

/* The first-order force of waves (waves.h) of one period and direction on a body that stays where
 * it begins, in the axes of the scene: component j is amplitude_j times that of the wave, and is
 * largest by lead_j of the phase before the crest is at the place of the reference point. */
typedef struct CpsExcitation {
    double period;                         /* [s] > 0 */
    double direction;                      /* [rad] as of the wave */
    double amplitude[CPS_BODY_DIRECTIONS]; /* [N/m, N] >= 0 of force and moment */
    double lead[CPS_BODY_DIRECTIONS];      /* [rad] */
} CpsExcitation;

/* A row of the table of memory of radiation: the force and moment per displacement that a body has
 * had this long ago, K_ij of component i by direction j, in the axes of the body. */
typedef struct CpsRadiation {
    double time;       /* [s] >= 0 */
    double kernel[36]; /* (6, 6) [N/m, N, N m] */
} CpsRadiation;

enum { CPS_MAX_RADIATION = 10000 };

enum { CPS_MAX_MEMBERS = 200, CPS_MAX_STRIPS = 1000, CPS_MEMBER_STRIPS = 20 };

/* A straight cylinder of a body, on which the water acts by Morison's formula as far as it is below
 * the surface, in steps in time that of the waves: per length
 *
 *     (rho/2) d (normal |u_n| u_n + pi tangential |u_t| u_t) + rho (pi/4) d^2 (1 + added_normal)
 * a_n,
 *
 * u the velocity of the water (CpsCurrent, CpsWaves) less that of the cylinder, a the acceleration
 * of the water in waves, across (n) and along it (t). The part of the body's own acceleration,
 * -rho (pi/4) d^2 added_normal times that across, is an added mass of the body that stays what it
 * is where the scene begins, in water at rest. Buoyancy and what is at the ends of the cylinder are
 * no part of it. In a quasi-static step there is the drag of the current alone. It needs the water
 * of CpsScene.current. */
typedef struct CpsMember {
    double from[3], to[3];                   /* [m] apart, in the body's axes */
    double diameter;                         /* [m] d > 0 */
    double normal, tangential, added_normal; /* [-] >= 0 */
    int strip_count; /* 1..CPS_MAX_STRIPS of equal length, each with the load of the middle of what
                        of it is wet; 0, the default: CPS_MEMBER_STRIPS */
} CpsMember;

typedef struct CpsBody {
    uint32_t cookie;
    const char *name;
    CpsBodyKind kind;                /* default held */
    bool fixed[CPS_BODY_DIRECTIONS]; /* directions in which it does not move while it is free;
                                        default none */
    double position[3];           /* [m] of its reference point, where it begins; default 0 0 0 */
    double rotation[4];           /* of any length but 0; default 1 0 0 0 */
    double weight;                /* [N] >= 0 along gravity, with which it changes; default 0 */
    double centre_of_gravity[3];  /* [m] in the body's axes */
    double buoyancy;              /* [N] >= 0 against gravity, with which it changes; default 0 */
    double centre_of_buoyancy[3]; /* [m] in the body's axes */
    /* (6, 6) [N/m, N, N m] C about the reference point, of the waterplane: the energy q' C q/2, q
     * the displacement from the pose above with the rotation as a vector; so the force and moment
     * are -C q in small rotations. Symmetric; weight is no part of it, nor is buoyancy where that
     * is given above. Default 0 */
    double hydrostatics[36];
    double force[3], moment[3]; /* [N], [N m] on a free body, beside all that; default 0 */
    /* Of steps in time (motion.h), all 0 by default, in the axes of the body: [kg] its mass, and
     * [kg m2] its inertia matrix about the centre of gravity, entries xx, yy, zz, xy, xz, yz */
    double mass, inertia[CPS_BODY_DIRECTIONS];
    /* (6, 6) [kg, kg m, kg m2] about the reference point, symmetric and >= 0: of the water that
     * moves with it; and [N s/m, N s, N m s] symmetric part >= 0: damping, force and moment -D u, u
     * the velocity of the reference point and the rate of rotation in the axes of the body */
    double added_mass[36], damping[36];
    /* (6, 6) [N s2/m2, N s2, N s2/m, N m s2] E: force and moment -E (|u_i| u_i). It is refused
     * unless a bound shows that it takes energy, or none, in every motion: any diagonal >= 0 does
     */
    double quadratic_damping[36];
    double velocity[CPS_BODY_DIRECTIONS]; /* [m/s, rad/s] as the history begins, of a free body, in
                                             the axes of the scene */
    /* In steps in time, of at most CPS_MAX_WAVES rows in any order, no two for one direction and
     * period; default 0 and NULL: waves do nothing to it. Between two rows amplitude exp(i lead)
     * is linear in the frequency; each of the scene's waves is at a row or between two of its
     * direction. Drift and the second order are not in it */
    int excitation_count;
    const CpsExcitation *excitation;
    /* In steps in time, of 0, the default, or 2 to CPS_MAX_RADIATION rows at the times 0, g, 2 g
     * ..: force and moment minus the integral of K(s) u(t - s) over s, with K linear between rows
     * and 0 after them, and u the velocities as of damping, which were 0 before the history began
     * and are so again after a quasi-static step. added_mass is that of infinite frequency then.
     * The first row takes energy in every motion, or none; whether the table does at all
     * frequencies, as that of a body in water does, is not checked */
    int radiation_count;
    const CpsRadiation *radiation;
    int member_count; /* <= CPS_MAX_MEMBERS, default 0 */
    const CpsMember *member;
} CpsBody;

CPS_API CpsBody cps_body_default(void);

struct CpsScene;
/* (6, 6) The added mass of a body of a scene with that of its members, as steps in time have it; 0
 * of what is none. The scene has been checked. NULL: nothing is done. */
CPS_API void cps_body_added_mass(const struct CpsScene *scene, int body, double added[36]);

/* What a stage changes at a body, in equal increments over the stage: the pose of one that is held
 * then, its reference point on a straight line and its axes about one direction; or the load on one
 * that is free then. A held body that becomes free is released, and its load begins with that which
 * held it. */
typedef struct CpsBodyChange {
    int body; /* index in the scene */
    CpsBodyKind kind;
    double position[3], rotation[4]; /* of one that is held */
    double force[3], moment[3];      /* of one that is free */
    bool has_velocity;               /* default false */
    /* [m/s, rad/s] with the flag: of the reference point of a held body and about it, in the axes
     * of the scene, after the step (motion.h) */
    double velocity[CPS_BODY_DIRECTIONS];
} CpsBodyChange;

/* The report on a body: forces [N], then moments [N m] about its reference point, on the body. */
typedef struct CpsBodyReport {
    CpsBodyKind kind;
    double position[3]; /* [m] in the coordinates of the scene */
    double rotation[4];
    double lines[CPS_BODY_DIRECTIONS];    /* of all lines at its points */
    double load[CPS_BODY_DIRECTIONS];     /* weight, hydrostatics, all of the water, given load */
    double support[CPS_BODY_DIRECTIONS];  /* of what holds it, or its fixed directions */
    double inertia[CPS_BODY_DIRECTIONS];  /* of its mass and added mass, in a step in time */
    double damping[CPS_BODY_DIRECTIONS];  /* likewise */
    double residual[CPS_BODY_DIRECTIONS]; /* sum of all these: what nothing balances */
    /* (6, 6) derivative of `residual` by the pose, without support, with the sign of a stiffness,
     * in the axes of the scene: of the step (stiffness.h), where its nodes have such a derivative.
     * Free points to which its lines lead follow it, other bodies stay.
     * Not symmetric in a pose with a moment. 0 of a held body */
    double stiffness[36];
    /* The proof that no pose balances (theory 5a), else 0: its lines end at one of its points, and
     * in every rotation the moment about the axis `proof` through it, of unit length, is at least
     * this [N m]. They are unbounded then, with a `proof` of 0 */
    double proof[3], proof_moment;
    bool is_stable; /* its symmetric part is positive definite in the directions not fixed, and that
                       of all such bodies which lines connect, together; of a held body true */
    bool has_place; /* the residual is no larger than the tolerance of points */
    int trial_count; /* as of points */
} CpsBodyReport;

/* The rotation of a report in angles [rad]: roll, pitch and yaw, that is yaw about z, then pitch
 * about the y axis so turned, then roll about the x axis so turned, pitch in -pi/2 .. pi/2, the
 * others in -pi .. pi, and roll 0 where pitch is at an end of its range. And the heel, the angle
 * between the z axes of body and scene, 0 .. pi. NULL: nothing is done. */
CPS_API void cps_body_angles(const CpsBodyReport *report, double roll_pitch_yaw[3], double *heel);

struct CpsEvolution;

/* cps_evolution_body_report (evolve.h) with places relative to the origin of the views
 * (CpsLineView), from which they lose no digits far from 0. */
CPS_API CpsBodyReport cps_evolution_body_view(const struct CpsEvolution *evolution, int body);

#ifdef __cplusplus
}
#endif
#endif
