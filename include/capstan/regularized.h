/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/regularized.h: the methods of Souza de Cursi (1990), S90, as the paper gives them,
 * applied to a step that evolve.h has solved exactly.
 *
 *   - The method of section 5 and annex 4: friction regularised by delta, a vanishing stiffness
 * 1/n, a penalty lambda for contact, finite differences of size h. It can be solved once, or as a
 *     study in which h, lambda, n and delta go to their limits in this order (theorems 9.1 and 9.2,
 *     result 5.6) and are compared with the solution of P4.2.
 *   - The consistent first-order problem P10.1 of annex 5. It may have no solution; then the report
 *     says which of its conditions fails.
 *
 * The step is a view of one line after cps_evolution_step. Its reference, loads, normals, friction
 * bounds and ends define the problem; its configuration and tensions are the answer to compare
 * with. End A must be held, the line elastic, the obstacles planes with isotropic friction
 * (CpsLineView.one_plane), and the step taken as one substep. */
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
    uint32_t cookie;  /* of one of the three calls below; parameters made otherwise are refused */
    int cell_count;   /* N of (47)-(48), h = length/N; 0: the elements of the step */
    double penalty;   /* [N/m2] lambda > 0: energy (lambda/2) (penetration)^2 per length */
    double stiffness; /* [N m2] 1/n >= 0; 0 is P5.1, without a condition on x'(0) */
    double delta;     /* [m] > 0: friction energy A sqrt(delta^2 + |u_T|^2) per length */
} CpsRegularizedParameters;
/* All numbers are 0; penalty and delta have to be set. */
CPS_API CpsRegularizedParameters cps_regularized_parameters_default(void);

/* One solution: its convergence, its energies, its distance from the solution of the step, and the
 * errors that its parameters cause. */
typedef struct CpsRegularizedReport {
    bool converged;         /* the gradient is as small as asked, or as rounding allows */
    int iteration_count;    /* Newton steps, with those of coarser parameters on the way */
    int evaluation_count;   /* evaluations of the gradient */
    double gradient;        /* [N] largest force on a node that nothing balances */
    double gradient_limit;  /* [N] the bound that it was compared with */
    double total;           /* [J] the energy minimised: the sum of the next five */
    double elastic;         /* [J] relaxed: of |x'| > 1 only */
    double potential;       /* [J] of the loads */
    double friction_energy; /* [J] j_delta */
    double bending;         /* [J] of the vanishing stiffness */
    double contact;         /* [J] of the penalty */
    double relaxed;      /* [J] J** + j at the configuration found, without the four parameters */
    double energy_error; /* [J] total less J** + j of the solution of the step */
    double tension_rms;  /* [N] rms difference of the tensions (45) along the line */
    double tension_max;  /* [N] largest difference of the tensions */
    double position_max; /* [m] largest distance of a node; not small where slack leaves a choice */
    double compression;  /* [N] largest compression, a negative tension carried by the stiffness */
    double shortening;   /* [-] largest 1 - |x'|, which costs nothing in J** and is outside Kin */
    double penetration;  /* [m] largest depth of a node below what contact allows */
    /* [m] largest |u_T| of a node whose friction force is below its bound by 1 % or more */
    double creep;
    /* [N] largest force on a node beyond what friction and contact can bear, where the line carries
     * the tensions (45) and nothing else */
    double friction_excess;
    double end_tension[2]; /* [N] at the ends A and B, with the meaning of CpsEndReport.tension */
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

/* Copy the data of a step that the method needs; the caller destroys *out.
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT (end A is free, the line is inextensible, its obstacles are not
 * planes with isotropic friction, or nothing moves) or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_regularized_create(const CpsLineView *step, CpsRegularized **out,
                                         CpsError *err);
CPS_API void cps_regularized_destroy(CpsRegularized *regularized); /* NULL is accepted */

/* The solution of the step, with which all others are compared. Its arrays belong to the handle. */
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
CPS_API CpsRegularizedStep cps_regularized_step(const CpsRegularized *regularized);

/* Parameters with which a study may begin: coarse ones for which the problem is easy, in proportion
 * to length, forces and elements of the step. */
CPS_API CpsRegularizedParameters cps_regularized_coarse(const CpsRegularized *regularized);

/* Minimise by damped Newton steps: from the last solution on the same cells if there is one,
 * otherwise from the reference, first with larger delta and stiffness and a smaller penalty.
 *
 *   parameters      lambda and delta > 0, 1/n >= 0, cell_count 0 or 2..1000000
 *   max_iterations  Newton steps in all, >= 1
 *
 * Returns CPS_OK also when not converged (the report says so), CPS_ERR_ARGUMENT or
 * CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_regularized_solve(CpsRegularized *regularized,
                                        const CpsRegularizedParameters *parameters,
                                        int max_iterations, CpsRegularizedReport *report,
                                        CpsError *err);
CPS_API CpsRegularizedView cps_regularized_view(const CpsRegularized *regularized);

/* Parameters with which a study ends: fine ones, whose errors are small. */
CPS_API CpsRegularizedParameters cps_regularized_fine(const CpsRegularized *regularized);

/* Begin the next step of a history of the regularised method alone. Loads, ends and normals are
 * those of `step`. The reference is the last solution of `previous` on the elements of the step,
 * and the friction bound is `friction` times the force of the penalty there (mu R_R of section 2 d
 * 2), times the factor of the friction zones. The errors of one step enter the next.
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

/* One solution of a study. A rate is the observed order in the parameter p of the stage (h,
 * 1/lambda, 1/n, delta): the exponent of v(p) = limit + C p^rate through this value and the two
 * before it. Where there is none, as for the first two, its flag is false and it is 0. */
typedef struct CpsStudyRow {
    CpsStudyStage stage;
    CpsRegularizedParameters parameters;
    CpsRegularizedReport report;
    bool has_rate_energy, has_rate_tension;
    double rate_energy;  /* [-] of the total energy */
    double rate_tension; /* [-] of the tension field, by the rms of its changes */
    double wall;         /* [s] */
} CpsStudyRow;

typedef struct CpsStudyOptions {
    uint32_t cookie;               /* of the two calls below; options made otherwise are refused */
    CpsRegularizedParameters from; /* cell_count: of the coarsest external approximation */
    int value_count[CPS_STUDY_STAGE_COUNT]; /* solutions per stage, 1..64 */
    /* > 1: each value of the parameter is the one before it divided by this; of h it is 2 */
    double factor[CPS_STUDY_STAGE_COUNT];
    int max_iterations; /* of each solution, >= 1 */
} CpsStudyOptions;

typedef struct CpsStudy CpsStudy;

/* From coarse parameters down to cps_regularized_fine. */
CPS_API CpsStudyOptions cps_study_options_default(const CpsRegularized *regularized);

/* From coarse parameters down to given ones, by factors of 10 at most.
 *
 *   to   as for cps_regularized_solve. Stage h ends with its cell_count or a few more, or with four
 *        times the elements of the step where it is 0. A stiffness of 0 holds for the whole study
 */
CPS_API CpsStudyOptions cps_study_options_to(const CpsRegularized *regularized,
                                             const CpsRegularizedParameters *to);

/* Called after each solve; false ends the study there. */
typedef bool CpsStudyProgress(void *user, const CpsStudyRow *row, int done, int of);

/* Run the study; the caller destroys *out. Stage h uses the external approximations (47)-(48). From
 * then on the cells are the elements of the step, on which the solution of P4.2 is known, so that
 * the final error is due to lambda, n and delta alone.
 *
 *   progress  may be NULL
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT or CPS_ERR_MEMORY. Rows that did not converge are kept and
 * say so. */
CPS_API CpsStatus cps_study_run(CpsRegularized *regularized, const CpsStudyOptions *options,
                                CpsStudyProgress *progress, void *user, CpsStudy **out,
                                CpsError *err);
CPS_API void cps_study_destroy(CpsStudy *study); /* NULL is accepted */
CPS_API int cps_study_row_count(const CpsStudy *study);
/* Row 0 .. by value; zeros where there is no such row. */
CPS_API CpsStudyRow cps_study_row(const CpsStudy *study, int row);
/* The tensions with which a stage ended; cell_count = 0 when it was not reached. */
CPS_API CpsRegularizedView cps_study_stage_end(const CpsStudy *study, CpsStudyStage stage);

/* ---- the consistent first-order problem P10.1 ---- */

/* The result. P10.1 minimises a convex quadratic energy plus friction over the displacements u that
 * contact allows, and requires that the minimiser shorten no slack part, (86). The strain t_R.u' of
 * all minimisers is the same, so that the result does not depend on which one is found. */
#define CPS_FIRST_ORDER_OUTCOME_LIST(X)                                                            \
    X(CPS_FIRST_ORDER_OUTCOME_SOLVED, 0, "solved", "a solution of P10.1")                          \
    X(CPS_FIRST_ORDER_OUTCOME_SHORTENS, 1, "shortens",                                             \
      "no solution: the balance (90) shortens a slack part, t_R.u' < 0 where (86) asks for >= 0")  \
    X(CPS_FIRST_ORDER_OUTCOME_UNBALANCED, 2, "unbalanced",                                         \
      "no solution: a force across the line, which (84) lets nothing carry where the reference "   \
      "is slack")                                                                                  \
    X(CPS_FIRST_ORDER_OUTCOME_UNDECIDED, 3, "undecided",                                           \
      "not decided: the iteration came to no end")                                                 \
    X(CPS_FIRST_ORDER_OUTCOME_MESH, 4, "mesh_only",                                                \
      "a solution on this mesh only: (87) has none, half an element carries the force on a slack " \
      "end")

typedef enum CpsFirstOrderOutcome {
#define CPS_FIRST_ORDER_OUTCOME_ENUM(name, number, key, sentence) name = number,
    CPS_FIRST_ORDER_OUTCOME_LIST(CPS_FIRST_ORDER_OUTCOME_ENUM)
#undef CPS_FIRST_ORDER_OUTCOME_ENUM
} CpsFirstOrderOutcome;

/* The nodes that the obstacle keeps out. (77) requires u.n >= 0 on D(x_R), where the reference is
 * in contact, and nothing elsewhere. With `reached` contact the step itself requires n.u + psi(x_R)
 * >= 0 of every node, (16). The answers differ where a node comes into contact. */
typedef enum CpsFirstOrderContact {
    CPS_FIRST_ORDER_CONTACT_REFERENCE,
    CPS_FIRST_ORDER_CONTACT_REACHED
} CpsFirstOrderContact;

CPS_API const char *cps_first_order_outcome_name(CpsFirstOrderOutcome outcome);
CPS_API const char *cps_first_order_outcome_text(CpsFirstOrderOutcome outcome);

typedef struct CpsFirstOrderReport {
    CpsFirstOrderOutcome outcome;
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
 * Returns CPS_OK whatever the outcome, CPS_ERR_ARGUMENT or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_first_order_solve(const CpsRegularized *regularized,
                                        CpsFirstOrderContact contact, CpsFirstOrder **out,
                                        CpsError *err);
CPS_API void cps_first_order_destroy(CpsFirstOrder *solution); /* NULL is accepted */
CPS_API CpsFirstOrderReport cps_first_order_report(const CpsFirstOrder *solution);
CPS_API CpsFirstOrderView cps_first_order_view(const CpsFirstOrder *solution);

#ifdef __cplusplus
}
#endif
#endif
