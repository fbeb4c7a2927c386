/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/drive.h: systems of laws under perfect constraints, eliminated and driven.
 * (Moreau 1977, M77, sections 9-12; Moreau 1970, M70, sections 8-11)
 *
 * A system has n velocity parameters V. Each law k acts on velocities U_k = B_k V by forces F_k;
 * perfect constraints ask C V = 0; a driving device imposes W = D V, and feels the resistance G; a
 * constant load may act as well. Without inertia, with multipliers lambda of the constraints,
 *
 *     U_k = B_k V,    D V = W,    C V = 0                   kinematics   M77 (18), (22)
 *     sum of B_k* F_k + load = D* G + C* lambda             equilibrium  M77 (19), (20), (23), (33)
 *     -U_k in N_Ck(F_k)                                     laws         M77 (14)-(16), (31)
 *
 * Eliminating V and F leaves a law between W and G, as good as any other (Proposition 1:
 * cps_system_eliminate). For one W, the motions are the minimisers of
 *
 *     gamma(W) = min { sum of phi_k(B_k V) - <load, V> : D V = W, C V = 0 }    M77 (35), Prop. 2
 *
 * (cps_system_solve). All maps are sparse lists of entries, so a system may have from 1 to about a
 * million parameters.
 *
 *     CpsSystem *wheel;                             V = (omega, V_i, V_j), M77 section 9
 *     cps_system_create(3, &wheel, &err);
 *     cps_system_add_friction(wheel, "brake", brake, 1, (CpsEntry[]){{0, 0, 1}}, &err);
 *     cps_system_add_friction(wheel, "ground", coulomb, 2, (CpsEntry[]){{0, 1, 1}, {1, 2, 1}},
 *                             &err);
 *     cps_system_set_drive(wheel, 2, 3, (CpsEntry[]){{0, 1, 1}, {1, 2, 1}, {1, 0, -radius}}, &err);
 *
 *     cps_system_eliminate(wheel, &law, NULL, NULL, &err);            -W in N_C(G), M77 (26)
 *     cps_system_solve(wheel, (double[]){1, 0}, NULL, &motion, &err);  omega and V, section 11 */
#ifndef CAPSTAN_DRIVE_H
#define CAPSTAN_DRIVE_H

#include <stdbool.h>

#include "capstan/law.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- building a system ---- */

typedef struct CpsSystem CpsSystem;

/* One number of a sparse matrix; rows and columns count from 0, and entries at one place add up. */
typedef struct CpsEntry {
    int row, column;
    double value;
} CpsEntry;

/* Most velocity parameters. */
#define CPS_SYSTEM_MAX_PARAMETERS 4000000

/* A system of `parameters` >= 1 velocity parameters, at rest in all of them: no law, constraint,
 * drive or load yet. */
CPS_API CpsStatus cps_system_create(int parameters, CpsSystem **out, CpsError *err);
CPS_API void cps_system_destroy(CpsSystem *system); /* NULL is accepted */
CPS_API int cps_system_parameter_count(const CpsSystem *system);

/* A friction law acting on U = B V. The system retains the law: the caller may release it.
 * Laws are numbered from 0 in the order in which they, and resistances, are added; many laws made
 * of one set share its conic form.
 *
 *   name          for messages and reports; copied, NULL means "law k"
 *   count, map    the entries of B, rows below cps_law_space(law), columns below n; none: U = 0
 *
 * Refused: a law with a user's set (it has no conic form), entries out of range or not finite. */
CPS_API CpsStatus cps_system_add_friction(CpsSystem *system, const char *name, const CpsLaw *law,
                                          int count, const CpsEntry *map, CpsError *err);

/* A resistance law acting on U = B V: dry, viscous, table, and power terms of degree 2. Refused: a
 * power of another degree, which is no conic program (write it as a table); a user's set. */
CPS_API CpsStatus cps_system_add_resistance(CpsSystem *system, const char *name,
                                            const CpsResistance *law, int count,
                                            const CpsEntry *map, CpsError *err);

CPS_API int cps_system_law_count(const CpsSystem *system);
/* Of law k: its name, and the number of its components. */
CPS_API const char *cps_system_law_name(const CpsSystem *system, int k);
CPS_API int cps_system_law_space(const CpsSystem *system, int k);

/* `rows` more perfect constraints C V = 0; rows may depend on each other. A constraint that gives
 * way at a bounded force, or on one side only, is a law: an interval of forces, a half-line. */
CPS_API CpsStatus cps_system_add_constraints(CpsSystem *system, int rows, int count,
                                             const CpsEntry *map, CpsError *err);

/* The same as a subspace: V in the span of `count` >= 0 vectors (count x n), n up to
 * CPS_SET_MAX_SPACE. */
CPS_API CpsStatus cps_system_add_subspace(CpsSystem *system, int count, const double *spanning,
                                          CpsError *err);

/* The drive W = D V, with m = `rows` >= 0 components; replaces the one before. A firm device: it
 * can bear every G. One that slips at a bounded force is a law between the driven parameters and
 * its own. */
CPS_API CpsStatus cps_system_set_drive(CpsSystem *system, int rows, int count, const CpsEntry *map,
                                       CpsError *err);
CPS_API int cps_system_drive_space(const CpsSystem *system); /* m */

/* The constant load (n), forces dual to V; replaces the one before. */
CPS_API CpsStatus cps_system_set_load(CpsSystem *system, const double *load, CpsError *err);

/* ---- Proposition 1: the law between W and G ---- */

/* The reduced law: -W in N_D(G), D = { G : some F_k in C_k balance it } (M77 (26), (34)). It is a
 * law like any other: ask, plot, compose it. Dense: for systems up to a few hundred parameters and
 * force components.
 *
 *   law          the law; NULL: not wanted. Refused where the load is not 0: its set need not
 * contain 0 forces       D as a set, also with a load (M77 section 12, remark), empty where the
 * laws cannot balance that; NULL: not wanted. The caller releases it composition  whether the
 * reverse of Proposition 1 holds, that every (W, G) of the law belongs to a motion: the forces that
 * balance meet the C_k in their interior, relative interior, ..; NULL: not wanted
 *
 * Refused: resistance laws, which are no sets; no drive; drive rows that depend on each other or on
 * the constraints (W is then not free, and G not unique); a load that nothing balances. */
CPS_API CpsStatus cps_system_eliminate(const CpsSystem *system, CpsLaw **law, CpsSet **forces,
                                       CpsComposition *composition, CpsError *err);

/* ---- Proposition 2: the motion for one W ---- */

/* One list: name, fixed number, sentence. Numbers are never reused. */
#define CPS_MOTION_OUTCOME_LIST(X)                                                         \
    X(CPS_MOTION_OUTCOME_SOLVED, 0,                                                        \
      "a motion and its forces, with bounds as near as the tolerance asks")                \
    X(CPS_MOTION_OUTCOME_LIMIT_LOAD, 1,                                                    \
      "the load is at the limit of what the laws balance: a motion may fail to exist")     \
    X(CPS_MOTION_OUTCOME_NO_BALANCE, 2,                                                    \
      "no forces of the laws balance the load: its power exceeds what they can dissipate") \
    X(CPS_MOTION_OUTCOME_BLOCKED, 3,                                                       \
      "no velocity that constraints and one-sided laws admit agrees with the drive")       \
    X(CPS_MOTION_OUTCOME_INACCURATE, 4,                                                    \
      "rounding kept the bounds from the tolerance; they hold as they are")                \
    X(CPS_MOTION_OUTCOME_NOT_ATTAINED, 5,                                                  \
      "no motion: the least dissipation is approached by ever faster velocities only")

typedef enum CpsMotionOutcome {
#define CPS_MOTION_OUTCOME_ENUM(name, number, sentence) name = number,
    CPS_MOTION_OUTCOME_LIST(CPS_MOTION_OUTCOME_ENUM)
#undef CPS_MOTION_OUTCOME_ENUM
} CpsMotionOutcome;

CPS_API const char *cps_motion_outcome_name(CpsMotionOutcome outcome);
CPS_API const char *cps_motion_outcome_text(CpsMotionOutcome outcome);

typedef struct CpsMotionOptions {
    uint32_t cookie; /* of cps_motion_options_default(): options made otherwise are refused */
    /* of upper - lower, relative to |gamma| or the power scale; and of residuals; default 1e-8 */
    double tolerance;
    /* relative to a law's size: forces nearer to its boundary are on it, which decides composition
     * and limit loads (width of the band round load factor 1); default 1e-6 */
    double boundary;
    bool composition; /* find Proposition 1's condition: one more program; default true */
} CpsMotionOptions;
CPS_API CpsMotionOptions cps_motion_options_default(void);

/* A motion with its proof, in the order of the relations above; recomputed from V and F alone. */
typedef struct CpsMotionReport {
    CpsMotionOutcome outcome;
    double value; /* [W] gamma(W): the upper bound; -INFINITY: NO_BALANCE, INFINITY: BLOCKED */
    /* [W] lower <= gamma <= upper: from forces in equilibrium, from a velocity that agrees with W;
     * what rounding leaves of residuals, and of the bounds' own arithmetic, is counted into them */
    double lower, upper;
    /* [W] what "relative" means: the largest of |U_k| |F_k| summed over the laws, the powers of
     * load and drive, and the largest force of a law times the largest |V_i| */
    double scale;
    double drive;       /* largest |D V - W|, relative to |W|; M77 (18), (22) */
    double constraint;  /* largest |C V|, or velocity that a one-sided law forbids, relative to max
                           |V_i| */
    double equilibrium; /* largest imbalance, relative to the largest force; M77 (19), (20), (23),
                           (33) */
    double outside;     /* largest distance of F_k from C_k, relative to F_k; M77 (4) */
    double law;         /* [W] sum of the gaps phi_k(U_k) + <U_k, F_k>; M77 (8), (14)-(16), (31) */
    double minimum;     /* [W] upper - lower, the gap of M77 (34), (35), (37) */
    double dissipated;  /* [W] sum over the laws of -<U_k, F_k> */
    double load_power;  /* [W] <load, V> */
    double load_factor; /* largest factor on a load that is balanced; INFINITY: any, or no load */
    CpsComposition composition; /* where asked for; else CPS_COMPOSITION_NOT_SATISFIED */
    int iterations;             /* of the interior point, all programs together */
} CpsMotionReport;

/* One law's share. */
typedef struct CpsMotionShare {
    double potential;  /* [W] phi_k(U_k); for a friction law the power dissipated */
    double dissipated; /* [W] -<U_k, F_k> */
    double outside;    /* [N] distance of F_k from C_k; of resistances: of their terms' forces from
                          their sets */
    double gap;        /* [W] Fenchel gap: phi_k(U_k) + phi_k*(-F_k) + <U_k, F_k> */
} CpsMotionShare;

typedef struct CpsMotion CpsMotion;

/* One motion for the driving velocity W (m; NULL where m = 0). *out is made for every outcome, and
 * for each carries its proof:
 *
 *   SOLVED, LIMIT_LOAD   V, F_k, G, lambda and the bounds
 *   NOT_ATTAINED         the same, the bounds being those of the infimum; V is a velocity near it
 *   NO_BALANCE           V with D V = 0, C V = 0 and <load, V> > sum of phi_k(B_k V): how the load
 * runs off BLOCKED              G, lambda, and F_k in the recession cones of the C_k, in
 * equilibrium without the load, with <W, G> < 0: the resistance grows beyond all bounds
 *
 *   options  NULL: the default
 *
 * Where composition is CPS_COMPOSITION_NOT_SATISFIED a minimum need not be attained, which is then
 * found out by two more programs; by Proposition 1 the pairs (W, G) of motions still obey the
 * reduced law. `lower` counts residuals against V and the sets against F, so it is a bound up to
 * what velocities much faster than V could add.
 *
 * Time and memory are linear in the size for chains, trees and stars. The system must outlive the
 * motion and not be changed. Refused: inconsistent sizes; CPS_ERR_MEMORY and CPS_ERR_LIMIT before
 * work begins. */
CPS_API CpsStatus cps_system_solve(const CpsSystem *system, const double *driving,
                                   const CpsMotionOptions *options, CpsMotion **out, CpsError *err);
CPS_API void cps_motion_destroy(CpsMotion *motion); /* NULL is accepted */

/* Views, valid until the motion is destroyed. */
CPS_API const CpsMotionReport *cps_motion_report(const CpsMotion *motion);
CPS_API const double *cps_motion_velocity(const CpsMotion *motion); /* V (n) */
/* For NOT_ATTAINED (n), largest component 1: velocities V + t direction dissipate less and less as
 * t grows; else NULL. */
CPS_API const double *cps_motion_direction(const CpsMotion *motion);
CPS_API const double *cps_motion_resistance(const CpsMotion *motion); /* G (m) */
/* lambda, in the order of the rows */
CPS_API const double *cps_motion_constraint_forces(const CpsMotion *motion);
CPS_API int cps_motion_constraint_count(const CpsMotion *motion); /* how many there are */
CPS_API const double *cps_motion_law_velocity(const CpsMotion *motion, int k); /* U_k = B_k V */
CPS_API const double *cps_motion_law_force(const CpsMotion *motion, int k);    /* F_k */
CPS_API const CpsMotionShare *cps_motion_law_share(const CpsMotion *motion, int k);

/* Is phi finite and continuous at a velocity that agrees with W?  Then its minima are the motions,
 * also where there is none (Proposition 2, second half). It is wherever the laws' sets are bounded.
 * Dense; *known false: rounding kept the answer. */
CPS_API CpsStatus cps_motion_continuous(const CpsMotion *motion, bool *known, bool *holds,
                                        CpsError *err);

/* ---- paths W(t) ---- */

/* One interval of a path, with its ledger [J]: driven + load = dissipated + imbalance. */
typedef struct CpsPathStep {
    CpsMotionOutcome outcome;
    double driven;       /* work of the driving device, -<W, G> x duration */
    double load;         /* work of the constant load */
    double dissipated;   /* by the laws, >= 0 where all are dissipative */
    double imbalance;    /* what rounding leaves */
    double lower, upper; /* bounds of the least work, duration x those of gamma(W) */
} CpsPathStep;

/* Drive a system along a path of driving velocities, constant over each interval: quasi-static, so
 * each is a motion of its own (Proposition 2) and only durations tie them together. Kinematics stay
 * as they are; where bodies turn, planar.h steps them with finite rotations.
 *
 *   count      intervals >= 1
 *   duration   (count) [s] > 0
 *   driving    (count, m) W of each
 *   step       (count) written up to *done
 *   travel     (count, n) parameters' ways at the end of each interval, the sum of V x duration; or
 * NULL done       intervals taken: the path ends after one without a motion, whose outcome says why
 */
CPS_API CpsStatus cps_system_drive_path(const CpsSystem *system, int count, const double *duration,
                                        const double *driving, const CpsMotionOptions *options,
                                        CpsPathStep *step, double *travel, int *done,
                                        CpsError *err);

/* ---- all motions, all forces ---- */

/* A set of solutions, its dimension and how sure that is. */
typedef struct CpsSolutionSet {
    /* NOT_AVAILABLE: the motion has no V and F, or a term whose velocities are not known;
     * INACCURATE: faces and cones would have to be moved by 1000 tolerances or more */
    CpsSetOutcome outcome;
    CpsSet *set; /* of V in R^n, or of F = (F_0, F_1, ..) in the laws' space; NULL: no answer */
    int dimension;
    bool unique, bounded; /* unique: dimension 0 */
    double tolerance;     /* the one used */
    double moved; /* relative: how far faces and cones were moved to contain the solution found */
} CpsSolutionSet;

/* All V that go with W: { V : D V = W, C V = 0, -B_k V in N_Ck(F_k) }, any F_k of a solution
 * (Proposition 2); dense, for n and force components up to a few hundred.
 *
 *   tolerance   relative, 0 <= tolerance < 1: velocities and distances from a boundary below it are
 *               0; 0 picks 1e-6
 *   low, high   (n) extent of each component, infinite where there is none; NULL: not wanted
 *
 * Release with cps_solution_set_clear. */
CPS_API CpsStatus cps_motion_velocities(const CpsMotion *motion, double tolerance,
                                        CpsSolutionSet *all, double *low, double *high,
                                        CpsError *err);
/* All forces that go with W: F_k of the laws at U_k that are in equilibrium; extents in the order
 * of all laws' components. */
CPS_API CpsStatus cps_motion_forces(const CpsMotion *motion, double tolerance, CpsSolutionSet *all,
                                    double *low, double *high, CpsError *err);
/* All resistances G (m) that go with W. They leave directions open where rows of the drive depend
 * on each other or on the constraints. */
CPS_API CpsStatus cps_motion_resistances(const CpsMotion *motion, double tolerance,
                                         CpsSolutionSet *all, double *low, double *high,
                                         CpsError *err);
CPS_API void cps_solution_set_clear(CpsSolutionSet *all);

#ifdef __cplusplus
}
#endif
#endif
