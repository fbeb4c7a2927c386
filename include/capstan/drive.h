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
 * Eliminating V and F leaves a law between W and G (Proposition 1: cps_system_eliminate). For one
 * W, the motions are the minimisers of
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

#define CPS_SYSTEM_MAX_PARAMETERS 4000000 /* most velocity parameters of a system */

/* A system of `parameters` >= 1 velocity parameters, at rest in all of them: no law, constraint,
 * drive or load yet. */
CPS_API CpsStatus cps_system_create(int parameters, CpsSystem **out, CpsError *err);
CPS_API void cps_system_destroy(CpsSystem *system); /* NULL is accepted */
CPS_API int cps_system_parameter_count(const CpsSystem *system);

/* A friction law acting on U = B V. The system retains the law, so the caller may release it. Laws
 * and resistances are numbered from 0 in the order in which they are added. Laws made of one set
 * share its conic form.
 *
 *   name   for messages and reports; copied. NULL gives "law k"
 *   count  entries of B, >= 0. Without entries U = 0
 *   map    (count) rows below cps_law_space(law), columns below n
 *
 * Refused: a law with a user's set, which has no conic form; entries out of range or not finite. */
CPS_API CpsStatus cps_system_add_friction(CpsSystem *system, const char *name, const CpsLaw *law,
                                          int count, const CpsEntry *map, CpsError *err);

/* A resistance law acting on U = B V; as above. It may have dry, viscous and table terms, and power
 * terms of degree 2. Refused: a power of another degree, which is no conic program (write it as a
 * table); a user's set. */
CPS_API CpsStatus cps_system_add_resistance(CpsSystem *system, const char *name,
                                            const CpsResistance *law, int count,
                                            const CpsEntry *map, CpsError *err);

CPS_API int cps_system_law_count(const CpsSystem *system);
/* The name of law k and the number of its components; NULL and 0 where there is no such law. */
CPS_API const char *cps_system_law_name(const CpsSystem *system, int k);
CPS_API int cps_system_law_space(const CpsSystem *system, int k);

/* `rows` >= 0 more perfect constraints C V = 0. Rows may depend on each other. A constraint that
 * gives way at a bounded force, or that holds on one side only, is a friction law: its set of
 * forces is an interval or a half-line. */
CPS_API CpsStatus cps_system_add_constraints(CpsSystem *system, int rows, int count,
                                             const CpsEntry *map, CpsError *err);

/* Constraints as a subspace: V lies in the span of `count` >= 0 vectors, spanning (count, n). n may
 * be at most CPS_SET_MAX_SPACE. */
CPS_API CpsStatus cps_system_add_subspace(CpsSystem *system, int count, const double *spanning,
                                          CpsError *err);

/* The drive W = D V, with m = `rows` >= 0 components; it replaces the drive set before. The device
 * is firm: it bears every G. A device that slips at a bounded force is a friction law between the
 * driven parameters and parameters of its own. */
CPS_API CpsStatus cps_system_set_drive(CpsSystem *system, int rows, int count, const CpsEntry *map,
                                       CpsError *err);
CPS_API int cps_system_drive_space(const CpsSystem *system); /* m */

/* The constant load (n): forces dual to V. It replaces the load set before; at first it is 0. */
CPS_API CpsStatus cps_system_set_load(CpsSystem *system, const double *load, CpsError *err);

/* ---- Proposition 1: the law between W and G ---- */

/* The reduced law -W in N_D(G) with D = { G : some F_k in C_k balance it } (M77 (26), (34)). It is
 * a law like any other, for all questions, pictures and compositions. The computation is dense: for
 * systems of up to a few hundred parameters and force components. The caller releases what it gets.
 *
 *   law          the law; refused where there is a load, because its set need not contain 0
 *   forces       D as a set, also with a load (M77 section 12, remark); empty where the laws cannot
 *                balance the load
 *   composition  whether the reverse of Proposition 1 holds, that every (W, G) of the law has a
 *                motion: where the forces that balance meet the C_k (CpsComposition in law.h)
 *
 * Each of the three may be NULL if it is not wanted. Refused: resistance laws, which are no sets; a
 * system without drive; drive rows that depend on each other or on the constraints, because W is
 * then not free and G not unique; a load that nothing balances. */
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
    uint32_t cookie; /* of cps_motion_options_default(); options made otherwise are refused */
    /* [-] > 0, default 1e-8: of residuals, and of upper - lower relative to max(|gamma|, scale) */
    double tolerance;
    /* [-] > 0, default 1e-6, relative to the size of a law: forces nearer to its boundary count as
     * on it. Decides composition and limit loads (the width of the band round load factor 1) */
    double boundary;
    bool composition; /* find the condition of Proposition 1, by one more program; default true */
} CpsMotionOptions;
CPS_API CpsMotionOptions cps_motion_options_default(void);

/* A motion with its proof, in the order of the relations above, recomputed from V and F alone. */
typedef struct CpsMotionReport {
    CpsMotionOutcome outcome;
    /* [W] gamma(W), which is the upper bound; -INFINITY for NO_BALANCE, INFINITY for BLOCKED */
    double value;
    /* [W] lower <= gamma <= upper: from forces in equilibrium, and from a velocity that agrees with
     * W. They count what rounding leaves of residuals and of their own arithmetic */
    double lower, upper;
    /* [W] what "relative" means: the largest of three powers: |U_k| |F_k| summed over the laws,
     * that of load and drive, and the largest force of a law times the largest |V_i| */
    double scale;
    double drive;      /* [-] largest |D V - W|, relative to |W|; M77 (18), (22) */
    double constraint; /* [-] largest |C V| or velocity that a one-sided law forbids, rel. to V */
    double
        equilibrium; /* [-] largest imbalance, relative to the largest force; M77 (19)-(23), (33) */
    double outside;  /* [-] largest distance of F_k from C_k, relative to F_k; M77 (4) */
    double law;      /* [W] sum of the gaps phi_k(U_k) + <U_k, F_k>; M77 (8), (14)-(16), (31) */
    double minimum;  /* [W] upper - lower, the gap of M77 (34), (35), (37) */
    double dissipated;          /* [W] sum over the laws of -<U_k, F_k> */
    double load_power;          /* [W] <load, V> */
    double load_factor;         /* [-] largest factor on the load that is balanced; INFINITY: any */
    CpsComposition composition; /* where asked for, otherwise CPS_COMPOSITION_NOT_SATISFIED */
    int iteration_count;        /* of the interior point, all programs together */
} CpsMotionReport;

/* The share of one law. */
typedef struct CpsMotionShare {
    double potential;  /* [W] phi_k(U_k); for a friction law the power dissipated */
    double dissipated; /* [W] -<U_k, F_k> */
    double outside; /* [N] distance of F_k from C_k; of resistances that of their terms' forces */
    double gap;     /* [W] Fenchel gap phi_k(U_k) + phi_k*(-F_k) + <U_k, F_k> */
} CpsMotionShare;

typedef struct CpsMotion CpsMotion;

/* One motion for the driving velocity W, `driving` (m), which may be NULL where m = 0. A motion is
 * made for every outcome and carries the proof of that outcome:
 *   SOLVED, LIMIT_LOAD  V, F_k, G, lambda and the bounds
 *   NOT_ATTAINED        the same; the bounds are those of the infimum, and V is a velocity near it
 *   NO_BALANCE          V with D V = 0, C V = 0 and <load, V> > sum of phi_k(B_k V): how the load
 *                       runs off
 *   BLOCKED             G, lambda, and F_k in the recession cones of the C_k, in equilibrium
 *                       without the load, with <W, G> < 0: the resistance grows beyond all bounds
 *
 * `options` may be NULL for the defaults. Where composition is CPS_COMPOSITION_NOT_SATISFIED a
 * minimum need not be attained, which two more programs find out; by Proposition 1 the pairs (W, G)
 * of motions still obey the reduced law. `lower` counts residuals against V, and the sets against
 * F, so it is a bound up to what velocities much faster than V could add.
 *
 * Time and memory are linear in the size for chains, trees and stars. The system must outlive the
 * motion and stay unchanged. Returns CPS_OK for every outcome, CPS_ERR_ARGUMENT (W or options out
 * of range), and CPS_ERR_MEMORY or CPS_ERR_LIMIT before work begins. */
CPS_API CpsStatus cps_system_solve(const CpsSystem *system, const double *driving,
                                   const CpsMotionOptions *options, CpsMotion **out, CpsError *err);
CPS_API void cps_motion_destroy(CpsMotion *motion); /* NULL is accepted */

/* Reports by value. Of no motion: outcome INACCURATE, numbers 0; of no such law: zeros. */
CPS_API CpsMotionReport cps_motion_report(const CpsMotion *motion);
CPS_API CpsMotionShare cps_motion_law_share(const CpsMotion *motion, int k);

/* Views, valid until the motion is destroyed; NULL only of a motion or law that there is not. */
CPS_API const double *cps_motion_velocity(const CpsMotion *motion); /* V (n) */
/* (n) For NOT_ATTAINED, with largest component 1: velocities V + t direction dissipate less and
 * less as t grows. 0 for all other outcomes. */
CPS_API const double *cps_motion_direction(const CpsMotion *motion);
CPS_API const double *cps_motion_resistance(const CpsMotion *motion); /* G (m) */
/* lambda, in the order of the rows of the constraints; and how many these are. */
CPS_API const double *cps_motion_constraint_forces(const CpsMotion *motion);
CPS_API int cps_motion_constraint_count(const CpsMotion *motion);
CPS_API const double *cps_motion_law_velocity(const CpsMotion *motion, int k); /* U_k = B_k V */
CPS_API const double *cps_motion_law_force(const CpsMotion *motion, int k);    /* F_k */

/* Is phi finite and continuous at a velocity that agrees with W?  Then its minima are the motions,
 * also where there is none (Proposition 2, second half). This holds wherever the laws' sets are
 * bounded. The computation is dense. *known becomes false where rounding kept the answer; *holds
 * has no meaning then. */
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

/* Drive a system along a path of driving velocities, constant over each interval. The motion is
 * quasi-static: each interval has a motion of its own (Proposition 2). The maps stay as they are;
 * where bodies turn, planar.h steps them with finite rotations.
 *
 *   count     intervals, >= 1
 *   duration  (count) [s] > 0
 *   driving   (count, m) W of each interval
 *   options   may be NULL for the defaults
 *   step      (count) out: the first *done are written
 *   travel    (count, n) out: sum of V x duration at the end of each interval; NULL if not wanted
 *   done      out: intervals taken; the path ends after one that has no motion */
CPS_API CpsStatus cps_system_drive_path(const CpsSystem *system, int count, const double *duration,
                                        const double *driving, const CpsMotionOptions *options,
                                        CpsPathStep *step, double *travel, int *done,
                                        CpsError *err);

/* A set of solutions, its dimension and how sure that is. NOT_AVAILABLE: the motion has no V and F,
 * or a term whose velocities are not known. INACCURATE: faces and cones would have to be moved by
 * 1000 tolerances or more. */
typedef struct CpsSolutionSet {
    CpsSetOutcome outcome;
    CpsSet *set;          /* where ANSWERED: of V in R^n, or of F = (F_0, F_1, ..) */
    int dimension;        /* of the set */
    bool unique, bounded; /* unique: the dimension is 0 */
    double tolerance;     /* the one used */
    double moved;         /* [-] how far faces and cones were moved to contain the solution found */
} CpsSolutionSet;

/* All V that go with W: { V : D V = W, C V = 0, -B_k V in N_Ck(F_k) }, with any F_k of a solution
 * (Proposition 2). Dense: for n and force components of up to a few hundred.
 *
 *   tolerance  [-] 0 <= tolerance < 1: relatively smaller velocities, and distances from a
 *              boundary, count as 0. The value 0 stands for 1e-6
 *   all        out: clear it with cps_solution_set_clear
 *   low, high  (n) out: extent of each component, infinite without a bound; NULL: not wanted */
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
