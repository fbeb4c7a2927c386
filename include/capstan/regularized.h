/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/regularized.h: the methods of S90 as they stand in the paper, applied to a step that
 * evolve.h has solved exactly.
 *
 *   - The method of section 5 and annex 4: friction smoothed by delta, a vanishing stiffness 1/n, a
 *     penalty lambda for contact, finite differences of size h. There is one solve, and a study in
 *     which h, lambda, n and delta go to their limits in this order (theorems 9.1 and 9.2, result
 *     5.6), compared with the solution of P4.2.
 *   - The consistent first-order problem P10.1 of annex 5. It may have no solution; then the report
 *     says which of its conditions fails.
 *
 * The step is a view of one line after cps_evolution_step: its reference, loads, normals, friction
 * bounds and ends are the problem, its configuration and tensions the answer to compare with. End A
 * must be held, the line elastic, the obstacle a plane with isotropic friction, and the step taken
 * in one part. */
#ifndef CAPSTAN_REGULARIZED_H
#define CAPSTAN_REGULARIZED_H

#include "capstan/step.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- the method of section 5 ---- */

/* P5.5 with its four parameters. The stiffness enters the energy as (1/2n) |x''|^2, so that (46)
 * holds as printed. */
typedef struct CpsRegularizedParameters {
    uint32_t cookie; /* of one of the three calls below; parameters made otherwise are refused */
    int cell_count; /* N of (47)-(48), h = length/N; 0: the step's own elements, each with one slope
                     * x'
                     */
    double penalty; /* [N/m2] lambda > 0: energy (lambda/2) (penetration)^2 per length */
    double stiffness; /* [N m2] 1/n >= 0; 0: P5.1, with the relaxed tension and the penalty, and no
                         condition on x'(0) */
    double delta;     /* [m] > 0: friction energy A sqrt(delta^2 + |u_T|^2) per length */
} CpsRegularizedParameters;
/* All 0: penalty and delta are still to be set. */
CPS_API CpsRegularizedParameters cps_regularized_parameters_default(void);

/* One solve: how it went, its energies, how far it is from the step's solution, and what its
 * parameters leave. */
typedef struct CpsRegularizedReport {
    bool converged;         /* the gradient is as small as asked, or as rounding allows */
    int iteration_count;    /* Newton steps, those of the way there (see cps_regularized_solve)
                               included */
    int evaluation_count;   /* gradients */
    double gradient;        /* [N] largest force left on a node */
    double gradient_limit;  /* [N] what it was compared with */
    double total;           /* [J] what is minimised: the five parts below */
    double elastic;         /* [J] relaxed: only |x'| > 1 costs */
    double potential;       /* [J] of the loads */
    double friction_energy; /* [J] j_delta */
    double bending;         /* [J] of the vanishing stiffness */
    double contact;         /* [J] of the penalty */
    double relaxed;         /* [J] J** + j at the configuration found, without any of the four */
    double energy_error;    /* [J] total less J** + j of the step's solution */
    double tension_rms; /* [N] root mean square along the line of the difference of tensions (45) */
    double tension_max; /* [N] largest */
    double position_max; /* [m] largest distance of a node; not small where slack leaves a choice */
    double compression; /* [N] largest axial push, carried by the stiffness: a tension below zero */
    double shortening;  /* [-] largest 1 - |x'|: strain below zero, free in J**, forbidden in Kin */
    double penetration; /* [m] deepest node below what contact allows */
    double creep; /* [m] largest |u_T| of a node whose friction force is below its bound by 1 % or
                     more */
    double
        friction_excess; /* [N] largest force that a node needs beyond what friction and contact may
                            give it when the line carries the tensions (45) and nothing else */
    double
        end_tension[2]; /* [N] at the ends A and B, of the same meaning as that of CpsEndReport */
} CpsRegularizedReport;

/* The configuration of the last solve; n = cell_count + 1 nodes, arrays (n, 3) node after node. */
typedef struct CpsRegularizedView {
    int cell_count;
    const double *arc_length; /* (n) [m] */
    const double *position;   /* (n, 3) [m] */
    const double *tension;    /* (cell_count) [N] (45) */
    const double *exact; /* (cell_count) [N] tension of the step's solution at the same places */
} CpsRegularizedView;

typedef struct CpsRegularized CpsRegularized;

/* Copy what the method needs of a step.
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT (end A is free, the line is inextensible, its obstacles are not
 * planes with isotropic friction, or nothing moves) or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_regularized_create(const CpsLineView *step, CpsRegularized **out,
                                         CpsError *err);
CPS_API void cps_regularized_destroy(CpsRegularized *classic); /* NULL is accepted */

/* The step's solution that all is compared with. Views into the handle. */
typedef struct CpsRegularizedStep {
    int element_count;
    double length, stiffness; /* [m], [N] K */
    double energy;            /* [J] J** + j */
    double force; /* [N] the largest tension, or the sum of the loads if that is larger */
    const double *arc_length; /* (element_count + 1) [m] */
    const double *reference;  /* (element_count + 1, 3) [m] x_R */
    const double *position;   /* (element_count + 1, 3) [m] */
    const double *tension;    /* (element_count) [N] */
} CpsRegularizedStep;
CPS_API CpsRegularizedStep cps_regularized_step(const CpsRegularized *classic);

/* Where a study may begin: parameters coarse enough for the method to be easy, in proportion to the
 * step's own length, forces and elements. */
CPS_API CpsRegularizedParameters cps_regularized_coarse(const CpsRegularized *classic);

/* Minimise by damped Newton steps, from the last solution on the same cells if there is one, else
 * from the reference by way of larger delta and stiffness and a smaller penalty.
 *
 *   parameters      lambda and delta > 0, 1/n >= 0, cell_count 0 or 2..1000000
 *   max_iterations  Newton steps in all, >= 1
 *
 * Returns CPS_OK also when not converged (the report says so), CPS_ERR_ARGUMENT or
 * CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_regularized_solve(CpsRegularized *classic,
                                        const CpsRegularizedParameters *parameters,
                                        int max_iterations, CpsRegularizedReport *report,
                                        CpsError *err);
CPS_API CpsRegularizedView cps_regularized_view(const CpsRegularized *classic);

/* Parameters at which what they leave is small: those with which a study ends. */
CPS_API CpsRegularizedParameters cps_regularized_fine(const CpsRegularized *classic);

/* The next step of a history of the regularised method by itself: loads, ends and normals of
 * `step`, but the reference is the last solution of `previous` on the step's own elements, and the
 * friction bound is `friction` times the push of the penalty there, mu R_R of section 2 d 2, times
 * the friction factor of the step's zones. Errors of one step go into the next.
 *
 *   step      of the exact history, on a plane obstacle or none
 *   friction  mu of the obstacle, >= 0
 *   previous  solved last with cell_count = 0
 *
 * Returns as cps_regularized_create. */
CPS_API CpsStatus cps_regularized_next(const CpsLineView *step, double friction,
                                       const CpsRegularized *previous, CpsRegularized **out,
                                       CpsError *err);

/* ---- the study: h, then lambda, then n, then delta ---- */

typedef enum CpsStudyStage {
    CPS_STUDY_STAGE_H,
    CPS_STUDY_STAGE_LAMBDA,
    CPS_STUDY_STAGE_N,
    CPS_STUDY_STAGE_DELTA,
    CPS_STUDY_STAGE_COUNT
} CpsStudyStage;

CPS_API const char *cps_study_stage_name(CpsStudyStage stage); /* "h", "lambda", "n", "delta" */

/* One solve of a study. Rates are observed orders in the stage's parameter p (h, 1/lambda, 1/n,
 * delta): the exponent of v(p) = limit + C p^rate through this value and the two before it; NaN
 * where there are not two. */
typedef struct CpsStudyRow {
    CpsStudyStage stage;
    CpsRegularizedParameters parameters;
    CpsRegularizedReport report;
    double rate_energy;  /* [-] of the total energy */
    double rate_tension; /* [-] of the tension field, by the rms of its changes */
    double wall;         /* [s] */
} CpsStudyRow;

typedef struct CpsStudyOptions {
    uint32_t cookie;               /* of the two calls below; options made otherwise are refused */
    CpsRegularizedParameters from; /* cell_count: of the coarsest external approximation */
    int value_count[CPS_STUDY_STAGE_COUNT]; /* solves per stage, 1..64 */
    double factor[CPS_STUDY_STAGE_COUNT];   /* each value is the one before it divided by this, > 1;
                                               h: 2 */
    int max_iterations;                     /* per solve */
} CpsStudyOptions;

typedef struct CpsStudy CpsStudy;

/* From coarse parameters down to cps_regularized_fine. */
CPS_API CpsStudyOptions cps_study_options_default(const CpsRegularized *classic);

/* Down to parameters of one's own, by factors of 10 at most.
 *
 *   to   as for cps_regularized_solve. cell_count: with which stage h ends, or a few more; 0: four
 * times the step's elements. A stiffness of 0 is that of the whole study */
CPS_API CpsStudyOptions cps_study_options_to(const CpsRegularized *classic,
                                             const CpsRegularizedParameters *to);

/* Called after each solve; false ends the study there. */
typedef bool CpsStudyProgress(void *user, const CpsStudyRow *row, int done, int of);

/* Run the study. Stage h uses the external approximations (47)-(48); from then on the cells are the
 * step's own elements, of which the solution of P4.2 is known, so that what is left at the end is
 * due to lambda, n and delta alone.
 *
 *   progress  may be NULL
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT or CPS_ERR_MEMORY. Rows that did not converge say so and are
 * kept. */
CPS_API CpsStatus cps_study_run(CpsRegularized *classic, const CpsStudyOptions *options,
                                CpsStudyProgress *progress, void *user, CpsStudy **out,
                                CpsError *err);
CPS_API void cps_study_destroy(CpsStudy *study); /* NULL is accepted */
CPS_API int cps_study_row_count(const CpsStudy *study);
/* Row 0 .. by value; zeros where there is no such row. */
CPS_API CpsStudyRow cps_study_row(const CpsStudy *study, int row);
/* The tensions with which a stage ended; cell_count = 0 when it was not reached. */
CPS_API CpsRegularizedView cps_study_stage_end(const CpsStudy *study, CpsStudyStage stage);

/* ---- the consistent first-order problem P10.1 ---- */

/* What became of it. P10.1 minimises a convex quadratic energy plus friction over the displacements
 * u that contact allows and then asks the minimiser to shorten no slack part, (86): the strain
 * t_R.u' of all minimisers is the same, so the question has one answer. */
#define CPS_FIRST_ORDER_VERDICT_LIST(X)                                                            \
    X(CPS_FIRST_ORDER_VERDICT_SOLVED, 0, "solved", "a solution of P10.1")                          \
    X(CPS_FIRST_ORDER_VERDICT_SHORTENS, 1, "shortens",                                             \
      "no solution: the balance (90) shortens a slack part, t_R.u' < 0 where (86) asks for >= 0")  \
    X(CPS_FIRST_ORDER_VERDICT_UNBALANCED, 2, "unbalanced",                                         \
      "no solution: a force across the line, which (84) lets nothing carry where the reference "   \
      "is slack")                                                                                  \
    X(CPS_FIRST_ORDER_VERDICT_UNDECIDED, 3, "undecided",                                           \
      "not decided: the iteration came to no end")                                                 \
    X(CPS_FIRST_ORDER_VERDICT_MESH, 4, "mesh_only",                                                \
      "a solution on this mesh only: (87) has none, half an element carries the force on a slack " \
      "end")

typedef enum CpsFirstOrderVerdict {
#define CPS_FIRST_ORDER_VERDICT_ENUM(name, number, key, sentence) name = number,
    CPS_FIRST_ORDER_VERDICT_LIST(CPS_FIRST_ORDER_VERDICT_ENUM)
#undef CPS_FIRST_ORDER_VERDICT_ENUM
} CpsFirstOrderVerdict;

/* Which nodes the obstacle keeps out. (77) asks u.n >= 0 on D(x_R), where the reference touches,
 * and nothing elsewhere; with `reached` contact the step itself asks n.u + psi(x_R) >= 0 of every
 * node, (16). The answers differ where a node comes down. */
typedef enum CpsFirstOrderContact {
    CPS_FIRST_ORDER_CONTACT_REFERENCE,
    CPS_FIRST_ORDER_CONTACT_REACHED
} CpsFirstOrderContact;

CPS_API const char *cps_first_order_verdict_name(CpsFirstOrderVerdict verdict);
CPS_API const char *cps_first_order_verdict_text(CpsFirstOrderVerdict verdict);

typedef struct CpsFirstOrderReport {
    CpsFirstOrderVerdict verdict;
    CpsFirstOrderContact contact;
    int round_count, iteration_count; /* of multipliers, of Newton steps in all */
    double residual;     /* [N] largest force by which balance, friction or contact still fail */
    double least_strain; /* [-] least t_R.u' where the reference is slack, +infinity where it is
                            nowhere */
    double least_strain_arc; /* [m] where */
    double shortened;        /* [m] natural length where (86) fails */
    double unbalanced[3];    /* [N] the largest force on a place that nothing balances, of the mesh
                                alone: on the slack end; and where [m] */
    double unbalanced_arc;
    double slack;        /* [m] natural length without tension in the reference, D of (85) */
    double outside;      /* [m] of it with |x_R'| < 1, a reference outside Kin: taken as slack with
                            strain 0 */
    double against_step; /* [m] largest distance of x_R + u from the step's solution of P2.1 */
} CpsFirstOrderReport;

/* Views into the handle; n = element_count + 1 nodes. */
typedef struct CpsFirstOrderView {
    int element_count;
    const double *arc_length;     /* (n) [m] */
    const double *displacement;   /* (n, 3) [m] u */
    const double *strain;         /* (element_count) [-] t_R.u' */
    const double *tension;        /* (element_count, 3) [N] T_R + the tension of (84) */
    const double *friction_force; /* (n, 3) [N] */
    const double *reaction;       /* (n) [N] */
} CpsFirstOrderView;

typedef struct CpsFirstOrder CpsFirstOrder;

/* Assemble P10.1 about the step's reference and solve it, on the step's own elements.
 *
 *   contact  CPS_FIRST_ORDER_CONTACT_REFERENCE is the paper's, (77)
 *
 * Returns CPS_OK whatever the verdict, CPS_ERR_ARGUMENT or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_first_order_solve(const CpsRegularized *classic, CpsFirstOrderContact contact,
                                        CpsFirstOrder **out, CpsError *err);
CPS_API void cps_first_order_destroy(CpsFirstOrder *solution); /* NULL is accepted */
CPS_API CpsFirstOrderReport cps_first_order_report(const CpsFirstOrder *solution);
CPS_API CpsFirstOrderView cps_first_order_view(const CpsFirstOrder *solution);

#ifdef __cplusplus
}
#endif
#endif
