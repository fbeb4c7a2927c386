/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/planar.h: rigid bodies that slide on a plane: limit surfaces, pushing, vehicles, towing,
 * planimeters, sweeping, ropes on a table. (Moreau 1977, M77, sections 10-12)
 *
 * A body rests on patches: points, wheels, rods, rings, discs, polygons. Its velocity is a twist
 * (vx, vy, w): velocity [m/s] of the body's origin and yaw rate [rad/s]; friction acts on it by a
 * wrench (Fx, Fy, M) [N, N m] about that origin. Both are in body axes. The law of the body in
 * these three components is the sum of its patches,
 *
 *     phi(vx, vy, w) = sum over patches of the integral of phi_r(v + w x r)
 *
 * and the boundary of its set of wrenches is the limit surface of planar sliding. Every shape here
 * has a closed form (far from the centre of rotation, where it would cancel, Gauss's rule), correct
 * to rounding; cps_planar_bounds proves any value of it by sums from below and from above that
 * share nothing with the closed form; cps_planar_law gives laws (law.h) inside and outside the true
 * one.
 *
 * Velocities may be displacements over a step: powers are then work. Outcomes are those of
 * set.h. */
#ifndef CAPSTAN_PLANAR_H
#define CAPSTAN_PLANAR_H

#include "capstan/drive.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- bodies ---- */

typedef enum CpsPatchKind {
    CPS_PATCH_POINT,  /* one contact; `law` for the two components of its velocity, or Coulomb's */
    CPS_PATCH_WHEEL,  /* a wheel of radius `size` with `brake`: M77 (26), its spin eliminated */
    CPS_PATCH_ROD,    /* line of half length `size` */
    CPS_PATCH_RING,   /* circle of radius `size` */
    CPS_PATCH_DISC,   /* full disc of radius `size` */
    CPS_PATCH_POLYGON /* convex, corners counterclockwise */
} CpsPatchKind;

/* What a patch stands on. Members that its kind does not use stay 0, as cps_patch_default() has
 * them. */
typedef struct CpsPatch {
    uint32_t cookie; /* of cps_patch_default(); a patch made otherwise is refused */
    CpsPatchKind kind;
    double position[2]; /* [m] contact; middle of rod, ring, disc; origin of the corners */
    double angle; /* [rad] of the first axis: of the rod, the wheel's rolling direction, the law */
    double friction; /* [-] coefficient >= 0; 0 with a law */
    double load;     /* [N] >= 0, carried by the whole patch; 0 with a law */
    double size;     /* [m] > 0: half length or radius; not of points and polygons */
    double brake;    /* [N m] wheel: largest torque of its brake, >= 0; INFINITY: locked */
    /* [1/m] areas: the pressure is mean x (1 + tilt . (r - centroid)) >= 0, in patch axes; a rod
     * has tilt[0] only */
    double tilt[2];
    int corner_count;     /* polygon: >= 3 */
    const double *corner; /* [m] (corner_count, 2) in patch axes from `position` */
    const CpsLaw *law;    /* of a point, optional: a bounded law of R^2 in patch axes */
} CpsPatch;
CPS_API CpsPatch cps_patch_default(void); /* a point without friction or load */

typedef struct CpsPlanar CpsPlanar;

/* Limits on the number of patches of a body and of cells of a patch. */
#define CPS_PLANAR_MAX_PATCHES 65536
#define CPS_PLANAR_MAX_CELLS   16777216

/* Would this patch be accepted by cps_planar_create?  Messages call it "this patch". */
CPS_API CpsStatus cps_patch_check(const CpsPatch *patch, CpsError *err);

/* A body on `count` >= 1 patches, which are checked and copied; threads may share it. */
CPS_API CpsStatus cps_planar_create(int count, const CpsPatch *patch, CpsPlanar **out,
                                    CpsError *err);
CPS_API void cps_planar_destroy(CpsPlanar *body); /* NULL is accepted */
CPS_API int cps_planar_patch_count(const CpsPlanar *body);

/* ---- the law of a body ---- */

/* phi at a twist [W], by closed forms.
 *
 *   wrench    (3) out: a wrench of friction there, -<twist, wrench> = phi; may be NULL
 *   by_patch  (patches) out: what each dissipates [W]; may be NULL
 *   answer    exact, except where the law of a point has to be solved for: gap bounds that error */
CPS_API CpsStatus cps_planar_dissipation(const CpsPlanar *body, const double twist[3],
                                         double wrench[3], double *by_patch, CpsSetAnswer *answer,
                                         CpsError *err);

/* lower <= phi <= upper at a twist, proved. Each patch is cut into cells. |v + w x r| is convex in
 * r, so the load of a cell at its centroid gives too little (Jensen), and the load spread over
 * corners that enclose the cell too much. No closed form and no extrapolation enters; rounding of
 * the sums is added to the bounds. INACCURATE: the largest number of cells did not reach the
 * tolerance; the bounds hold. */
typedef struct CpsPlanarBounds {
    CpsSetOutcome outcome;
    double lower, upper; /* [W] */
    double cell_count;   /* in all patches */
} CpsPlanarBounds;
/*   tolerance  [-] upper - lower wanted, relative to upper; 0 stands for 1e-6. The number of cells
 *              grows as its inverse: 1e6 of them at 1e-6 */
CPS_API CpsStatus cps_planar_bounds(const CpsPlanar *body, const double twist[3], double tolerance,
                                    CpsPlanarBounds *bounds, CpsError *err);

/* A law of R^3 on wrenches, the sum of the contacts of all cells: its set lies inside the true one
 * or encloses it. Points and wheels are as they are, so for a body on these alone both sides are
 * the exact law. Of areas the distance falls as 1/cells.
 *
 *   cells  at most this many for each patch, from 1 to CPS_PLANAR_MAX_CELLS */
typedef enum CpsPlanarSide { CPS_PLANAR_INNER, CPS_PLANAR_OUTER } CpsPlanarSide;
CPS_API CpsStatus cps_planar_law(const CpsPlanar *body, CpsPlanarSide side, int cells, CpsLaw **out,
                                 CpsError *err);

/* The body as a system of drive.h, without a drive. Parameters are the twist and then the spin
 * [rad/s] of each wheel with a finite brake, in the order of the patches. Laws have the order of
 * the patches and names such as "patch 2": one of each cell (a point is one), and of a wheel the
 * contact and then its brake (M77 section 9). `side` and `cells` as for cps_planar_law. */
CPS_API CpsStatus cps_planar_system(const CpsPlanar *body, CpsPlanarSide side, int cells,
                                    CpsSystem **out, CpsError *err);

/* What a wheel does while its body moves, by minimum dissipation (M77 section 11). As there, slip =
 * velocity + spin x radius along the rolling direction, so a wheel that rolls forward has a
 * negative spin. Axes: i sideways, j = up x i the rolling direction. */
typedef struct CpsWheelMotion {
    double velocity[2];   /* [m/s] of the wheel's centre, along i and j */
    double slip[2];       /* [m/s] of the contact over the ground, along i and j */
    double spin;          /* [rad/s] of the wheel against the body, about i */
    double ground, brake; /* [W] dissipated in the contact and in the brake */
} CpsWheelMotion;
/*   patch  number of a patch, from 0; refused where it is no wheel */
CPS_API CpsStatus cps_planar_wheel(const CpsPlanar *body, int patch, const double twist[3],
                                   CpsWheelMotion *motion, CpsError *err);

/* ---- driven bodies (M77 section 12) ---- */

/* Some components of the motion are imposed: map x twist = velocity; the others follow by minimum
 * dissipation. NOT_ATTAINED: no motion up to 1e6 times the driven speed has the least dissipation.
 * INACCURATE: the bounds are apart by more than 1e-8 of the upper one. */
typedef struct CpsPlanarMotion {
    CpsSetOutcome outcome;
    /* [W] lower <= gamma(velocity) <= upper: by a wrench that obeys the law, and by `twist` */
    double lower, upper;
    double scale; /* [W] twist x largest wrench met: what a gap is compared with where gamma is 0 */
    double twist[3];
    double wrench[3]; /* of friction, in balance with the drive to rounding; gives `lower` */
    double drive[3];  /* (rows) driving forces; the sum of drive x velocity is `lower` */
    double centre[2]; /* [m] centre of rotation, in body axes; infinite for a translation */
} CpsPlanarMotion;

/*   rows      1 to 3
 *   map       (rows, 3) of independent rows. A point at (x, y) of the body moves with (1, 0, -y)
 *             and (0, 1, x)
 *   velocity  (rows) */
CPS_API CpsStatus cps_planar_drive(const CpsPlanar *body, int rows, const double *map,
                                   const double *velocity, CpsPlanarMotion *motion, CpsError *err);

/* The least and largest of each component of the twist over all motions that dissipate at most
 * gamma (1 + tolerance); INFINITY where friction does not hold it. A motion that is unique shows a
 * width of the order of sqrt(tolerance). `tolerance` > 0; 0 stands for 1e-9. */
CPS_API CpsStatus cps_planar_motions(const CpsPlanar *body, int rows, const double *map,
                                     const double *velocity, double tolerance, double low[3],
                                     double high[3], CpsError *err);

/* Carry a pose (x, y, angle) exactly along the screw motion of a constant twist increment
 * [m, m, rad] in body axes: with cps_planar_drive, one step of a body whose drive is fixed to it.
 * Does nothing where one of them is NULL. */
CPS_API void cps_planar_move(double pose[3], const double twist[3]);

/* ---- towing: a body drawn along a path, quasi-static, finite rotations ---- */

/* State and ledger. Begin with cps_tow_default() and set pose, hitch, rope, end. */
typedef struct CpsTow {
    uint32_t cookie;   /* of cps_tow_default(); a state made otherwise is refused */
    double pose[3];    /* [m, m, rad] of the body's origin and axes in the plane */
    double hitch[2];   /* [m] where it is held, in body axes */
    double rope;       /* [m] >= 0, length of an inextensible rope; 0: the hitch itself is moved */
    double end[2];     /* [m] where the far end of the rope is; not used without a rope */
    double work;       /* [J] of the driver so far: force x displacement of the hitch */
    double dissipated; /* [J] so far */
} CpsTow;
CPS_API CpsTow cps_tow_default(void);

typedef struct CpsTowStep {
    /* other than ANSWERED: the state is unchanged. INACCURATE also for a turn of more than 2 rad */
    CpsSetOutcome outcome;
    bool pulled; /* false: the rope is slack, or the end did not move, and the body stays */
    /* false: the motion jumps with the orientation, so the step is first order; or too long */
    bool converged;
    double twist[3];     /* [m, m, rad] of the screw motion, constant in body axes */
    double force[2];     /* [N] on the hitch, in the plane, in the middle of the step */
    double work;         /* [J] of this step, force x displacement of the hitch */
    double dissipated;   /* [J] of the screw motion */
    double lower, upper; /* [J] bounds of `dissipated` */
} CpsTowStep;

/* Move the driven end (the hitch or the far end of the rope) to `target` [m]. The body makes the
 * screw motion of least dissipation that brings the hitch there, or to the rope's length from
 * there: second order in the step. Work and dissipation differ by the order of the step squared.
 * Where converged, the hitch is there to rounding. Where the least is not unique
 * (cps_planar_motions) one of the motions is taken. */
CPS_API CpsStatus cps_planar_tow(const CpsPlanar *body, CpsTow *tow, const double target[2],
                                 CpsTowStep *step, CpsError *err);

/* ---- sweeping: a block on a spring whose end is moved ---- */

/* State and ledger. Begin with cps_sweep_default() and set stiffness, position, end. As many
 * components as the law has, 1 to 3. */
typedef struct CpsSweep {
    uint32_t cookie;    /* of cps_sweep_default(); a state made otherwise is refused */
    double stiffness;   /* [N/m] > 0, the same in all directions */
    double position[3]; /* [m] of the block, u */
    double end[3];      /* [m] of the spring's far end, X */
    double work;        /* [J] of the moved end so far (trapezium) */
    double dissipated;  /* [J] so far */
} CpsSweep;
CPS_API CpsSweep cps_sweep_default(void);

typedef struct CpsSweepStep {
    CpsSetOutcome outcome;
    double force[3];         /* [N] friction on the block, = stiffness (u - X) */
    double slid[3];          /* [m] */
    double work, dissipated; /* [J] of this step */
    double stored;           /* [J] in the spring after it */
} CpsSweepStep;

/* Move the end to `end` (components of the law): u becomes the point of X + C/stiffness nearest to
 * u (catching-up scheme, first order). In one component this is the play operator, and exact. work
 * = dissipated + change of stored + a defect of second order in the step. */
CPS_API CpsStatus cps_sweep_step(const CpsLaw *law, CpsSweep *sweep, const double *end,
                                 CpsSweepStep *step, CpsError *err);

/* ---- polar planimeter ---- */

/* Pole arm from `pole` to a hinge, tracer arm from there to the tracer; a wheel without brake (b =
 * 0) on the tracer arm, its axis along it, `wheel` from the hinge towards the tracer. */
typedef struct CpsPlanimeter {
    uint32_t cookie; /* of cps_planimeter_default(); one made otherwise is refused */
    double pole[2];
    double pole_arm, tracer_arm, wheel; /* [m] arms > 0 */
    double friction, load;              /* of the wheel, for what its side-slip dissipates */
    bool left_elbow;                    /* the hinge lies left of the line from pole to tracer */
} CpsPlanimeter;
CPS_API CpsPlanimeter cps_planimeter_default(void);

typedef struct CpsPlanimeterReading {
    double roll; /* [m] rolled by the wheel, against its normal, positive to the left of the arm */
    double side_slip;             /* [m] length of side-slip */
    double dissipated;            /* [J] by it */
    double pole_turns, arm_turns; /* whole turns of pole arm and tracer arm, counterclockwise */
    double area;  /* [m2] tracer_arm x roll + circles of the turns; > 0 counterclockwise */
    double exact; /* [m2] of the polygon of the points */
} CpsPlanimeterReading;

/* Would this planimeter be accepted for this polygon?  Checks its numbers, and whether the tracer
 * reaches the corners; a side may still come nearer to the pole than the arms allow. */
CPS_API CpsStatus cps_planimeter_check(const CpsPlanimeter *planimeter, int count,
                                       const double *point, CpsError *err);

/* Trace the closed polygon of `count` >= 3 points (count, 2), every side in `steps` >= 1 equal
 * steps. The arms are placed exactly at each step, the wheel's law is taken at the mean of its two
 * headings: second order in the step. Refused: a tracer out of reach, or nearer to its limits than
 * 1e-6 of the arms, where the elbow could fold over. */
CPS_API CpsStatus cps_planimeter_trace(const CpsPlanimeter *planimeter, int count,
                                       const double *point, int steps,
                                       CpsPlanimeterReading *reading, CpsError *err);

/* ---- ropes on a table (M77, remark of section 11) ---- */

/* A heavy inextensible rope that lies on a rough table: a chain of nodes joined by straight
 * elements. Each node carries the friction of the half elements next to it, a disc. Each element
 * asks t . (v of its far node - v of its near node) = 0 with its unit direction t: M77's rope keeps
 * its length, so it can push as well. Where it may go slack the sum is <= 0 instead. The velocity
 * field has the least dissipation among those that the rope and the driven ends admit: a system of
 * drive.h, solved in time linear in the nodes. The force of an element's law is minus its tension.
 */
typedef struct CpsRope {
    uint32_t cookie;    /* of cps_rope_default(); a rope made otherwise is refused */
    int node_count;     /* 2 to CPS_ROPE_MAX_NODES */
    const double *node; /* [m] (node_count, 2); neighbours differ */
    double resistance;  /* [N/m] friction coefficient x weight per length, >= 0 */
    bool driven[2];     /* is the velocity of the first, of the last node imposed? */
    bool slack; /* may elements become shorter, without tension?  false: inextensible, as in M77 */
} CpsRope;
CPS_API CpsRope cps_rope_default(void);

#define CPS_ROPE_MAX_NODES 1000000

/* Would this rope be accepted? */
CPS_API CpsStatus cps_rope_check(const CpsRope *rope, CpsError *err);

/* The rope as a system. Parameters are vx, vy of node 0, 1, ..; laws 0 .. node_count - 1 are the
 * friction of the nodes ("node k"), the laws after them the elements ("element k"); the drive has
 * vx, vy of the driven ends, first end first. */
CPS_API CpsStatus cps_rope_system(const CpsRope *rope, CpsSystem **out, CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
