/* SPDX-License-Identifier: BSD-3-Clause */
/* One motion for a driving velocity: kinematics, load factor, the program and its certificate. */
#include "drive/motion.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/larger.h"
#include "base/status.h"
#include "base/words.h"
#include "drive/kinematics.h"

/* Rows of drive and constraints contradict W where the residual exceeds this share of W; rounding
 * of W and refinement leave less. */
static const double CONTRADICTION = 1e-9;

/* [m/s] Without W there is no speed to compare with, and velocities below this are rest. */
static const double REST = 1e-12;

/* Bounds whose distance is below this share of the power scale, plus EACH for each component of the
 * laws, are as near as rounding permits. Velocities are then known to the square root of that
 * distance. */
static const double FEW = 1e-12, EACH = 1e-15;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a motion");
}

static const CpsiWords OUTCOME[] = {CPS_MOTION_OUTCOME_LIST(CPSI_WORDS_WITH_NAME)};

const char *cps_motion_outcome_name(CpsMotionOutcome outcome) {
    return CPSI_WORDS(OUTCOME, outcome).name;
}

const char *cps_motion_outcome_text(CpsMotionOutcome outcome) {
    return CPSI_WORDS(OUTCOME, outcome).text;
}

CpsMotionOptions cps_motion_options_default(void) {
    return (CpsMotionOptions){.cookie = CPSI_MOTION_COOKIE,
                              .tolerance = 1e-8,
                              .boundary = 1e-6,
                              .composition = true};
}

/* ---- memory ---- */

void cps_motion_destroy(CpsMotion *motion) {
    if (!motion) return;
    free(motion->driving);
    free(motion->balance);
    free(motion->piece_at);
    free(motion->share);
    free(motion);
}

static CpsStatus motion_new(const CpsSystem *system, const double *driving, CpsMotion **out,
                            CpsError *err) {
    CpsMotion *motion = calloc(1, sizeof *motion);
    if (!motion) return out_of_memory(err);
    const size_t n = (size_t)system->n, m = (size_t)system->drive.rows,
                 rows = (size_t)system->constraint.rows, components = (size_t)system->components;
    size_t forces = 0;
    motion->system = system;
    motion->piece_at = calloc((size_t)system->pieces + 1, sizeof *motion->piece_at);
    motion->share = calloc((size_t)system->laws + 1, sizeof *motion->share);
    for (int k = 0; motion->piece_at && k < system->pieces; k++) {
        motion->piece_at[k] = forces;
        forces += (size_t)system->piece[k].space;
    }
    motion->balance = calloc(n + 1, sizeof *motion->balance);
    motion->driving =
        calloc(2 * m + 2 * n + rows + 2 * components + forces + 1, sizeof *motion->driving);
    if (!motion->driving || !motion->balance || !motion->piece_at || !motion->share) {
        cps_motion_destroy(motion);
        return out_of_memory(err);
    }
    motion->resistance = motion->driving + m;
    motion->velocity = motion->resistance + m;
    motion->direction = motion->velocity + n;
    motion->constraint = motion->direction + n;
    motion->law_velocity = motion->constraint + rows;
    motion->law_force = motion->law_velocity + components;
    motion->piece_force = motion->law_force + components;
    if (m > 0) memcpy(motion->driving, driving, m * sizeof *driving);
    motion->report.load_factor = INFINITY;
    motion->report.composition = CPS_COMPOSITION_NOT_SATISFIED;
    *out = motion;
    return CPS_OK;
}

static double largest_of(int n, const double *a) {
    double largest = 0;
    for (int i = 0; i < n; i++) largest = cpsi_max_nan(largest, fabs(a[i]));
    return largest;
}

/* The order of magnitude of the largest force of laws and load; 1 N where all laws are cones. */
static double force_size(const CpsSystem *system) {
    double size = system->load ? largest_of(system->n, system->load) : 0;
    for (int k = 0; k < system->forms; k++) {
        bool bounded = false; /* a cone has no size */
        for (int i = 0; i < system->form[k]->rows; i++) bounded |= system->form[k]->b[i] != 0;
        if (bounded) size = fmax(size, system->form[k]->size);
    }
    return size > 0 ? size : 1;
}

/* ---- the steps ---- */

/* No velocity is admissible; the minimum over the empty set is infinite. */
static void block(CpsMotionReport *report) {
    report->outcome = CPS_MOTION_OUTCOME_BLOCKED;
    report->value = report->lower = report->upper = INFINITY;
}

/* The nearest velocity that agrees with W; BLOCKED where there is none. */
static void start_velocity(CpsMotion *motion, CpsiKinematics *kinematics) {
    cpsi_kinematics_project(kinematics, motion->driving, motion->velocity);
    motion->speed = motion->driven = largest_of(motion->system->n, motion->velocity);
    const double left = cpsi_kinematics_contradiction(kinematics, motion->driving, motion->velocity,
                                                      motion->resistance, motion->constraint);
    if (left > CONTRADICTION)
        block(&motion->report);
    else if (motion->system->drive.rows > 0 || motion->system->constraint.rows > 0) {
        memset(motion->resistance, 0,
               (size_t)motion->system->drive.rows * sizeof *motion->resistance);
        memset(motion->constraint, 0,
               (size_t)motion->system->constraint.rows * sizeof *motion->constraint);
    }
}

/* The largest factor on the load. Where it is below one, V of the program has <load, V> = 1 and
 * phi(V) = factor, which proves that the load cannot be balanced if phi(V) < <load, V> beyond
 * rounding. */
static CpsStatus balance_load(CpsMotion *motion, CpsiKinematics *kinematics, double band,
                              CpsError *err) {
    CpsMotionReport *report = &motion->report;
    CpsiDriveProgram program;
    CpsStatus status =
        cpsi_drive_program_new(motion->system, CPSI_AIM_FACTOR, NULL, 1, false, &program, err);
    if (status != CPS_OK) return status;
    cpsi_drive_program_solve(&program);
    report->iteration_count += program.result.iterations;
    const CpsiConicOutcome outcome = program.result.outcome;
    if (outcome == CPSI_CONIC_SOLVED)
        report->load_factor = cpsi_drive_program_factor(&program);
    else if (outcome != CPSI_CONIC_UNBOUNDED)
        report->load_factor = NAN;
    if (outcome == CPSI_CONIC_FAILED) report->outcome = CPS_MOTION_OUTCOME_INACCURATE;
    if (report->load_factor < 1 + band) report->outcome = CPS_MOTION_OUTCOME_LIMIT_LOAD;
    if (report->load_factor < 1) {
        const size_t m = (size_t)motion->system->drive.rows;
        double *driving = malloc((m + 1) * sizeof *driving);
        if (!driving)
            status = out_of_memory(err);
        else {
            memcpy(driving, motion->driving, m * sizeof *driving);
            memset(motion->driving, 0, m * sizeof *driving);
            cpsi_drive_program_velocity(&program, motion->velocity);
            cpsi_kinematics_project(kinematics, motion->driving, motion->velocity);
            cpsi_motion_recover_forces(motion, &program);
            status = cpsi_motion_certify(motion, &program, err);
            if (report->upper < 0) {
                report->outcome = CPS_MOTION_OUTCOME_NO_BALANCE;
                report->value = report->lower = report->upper = -INFINITY;
            } else {
                memcpy(motion->driving, driving, m * sizeof *driving);
                start_velocity(motion, kinematics);
            }
        }
        free(driving);
    }
    cpsi_drive_program_clear(&program);
    return status;
}

static bool has_resistance(const CpsSystem *system) {
    for (int l = 0; l < system->laws; l++)
        if (system->law[l].resistance) return true;
    return false;
}

/* Whether the bounds are near to each other, and their velocities and forces admissible. Powers
 * below `least` do not count. */
static bool close_enough(const CpsMotionReport *report, double tolerance, double least) {
    const double residual = cpsi_max_nan(cpsi_max_nan(report->drive, report->constraint),
                                         cpsi_max_nan(report->equilibrium, report->outside));
    return report->minimum <= tolerance * fmax(fmax(report->scale, fabs(report->value)), least) &&
           residual <= tolerance;
}

/* Solve the program for velocities of size `speed`, and compute the bounds of the result. */
static CpsStatus attempt(CpsMotion *motion, CpsiKinematics *kinematics, double speed, bool even,
                         bool still, CpsError *err) {
    CpsMotionReport *report = &motion->report;
    CpsiDriveProgram program;
    CpsStatus status = cpsi_drive_program_new(motion->system, CPSI_AIM_MOTION, motion->driving,
                                              speed, even, &program, err);
    if (status != CPS_OK) return status;
    cpsi_drive_program_solve(&program);
    report->iteration_count += program.result.iterations;
    if (!still) {
        cpsi_drive_program_velocity(&program, motion->velocity);
        if (program.result.outcome == CPSI_CONIC_SOLVED ||
            program.result.outcome == CPSI_CONIC_FAILED)
            cpsi_kinematics_project(kinematics, motion->driving, motion->velocity);
        if (motion->speed == 0 && largest_of(motion->system->n, motion->velocity) <= REST)
            memset(motion->velocity, 0, (size_t)motion->system->n * sizeof *motion->velocity);
    }
    cpsi_motion_recover_forces(motion, &program);
    if (program.result.outcome == CPSI_CONIC_UNBOUNDED)
        block(report);
    else
        status = cpsi_motion_certify(motion, &program, err);
    cpsi_drive_program_clear(&program);
    return status;
}

/* The conditions of an attempt, and its quality: whether the bounds are within the tolerance, and
 * their distance. */
typedef struct Attempt {
    CpsMotion *motion;
    CpsiKinematics *kinematics;
    double first; /* the speed that it is compared with as long as no motion is known */
    CpsMotionOutcome so_far;
    double tolerance, least; /* arguments of close_enough */
    bool still;
} Attempt;

static CpsStatus try_once(const Attempt *trial, double speed, bool even, bool *near,
                          CpsError *err) {
    trial->motion->speed = trial->first;
    trial->motion->report.outcome = trial->so_far;
    const CpsStatus status =
        attempt(trial->motion, trial->kinematics, speed, even, trial->still, err);
    *near =
        status == CPS_OK && close_enough(&trial->motion->report, trial->tolerance, trial->least);
    return status;
}

/* Dividing each equation by its own forces resolves weak laws beside strong ones best. Where a weak
 * law's equation determines velocities that a strong law resists, one divisor for all equations is
 * better. So where the first scaling leaves bounds farther apart than rounding, the second is tried
 * as well, and the result with the nearer bounds is kept. */
static CpsStatus try_both(const Attempt *trial, double speed, bool *near, CpsError *err) {
    const CpsMotionReport *report = &trial->motion->report;
    CpsStatus status = try_once(trial, speed, false, near, err);
    if (status != CPS_OK || report->outcome == CPS_MOTION_OUTCOME_BLOCKED) return status;
    if (*near &&
        report->minimum <= (FEW + EACH * trial->motion->system->components) * report->scale)
        return CPS_OK;
    const double apart = *near ? report->minimum : INFINITY;
    status = try_once(trial, speed, true, near, err);
    if (status != CPS_OK || report->outcome == CPS_MOTION_OUTCOME_BLOCKED ||
        (*near && report->minimum < apart))
        return status;
    return isfinite(apart) ? try_once(trial, speed, false, near, err) : CPS_OK;
}

/* Compute a motion. The size of velocities is a guess, which matters only for resistances; the
 * computation is repeated with another one where the guess was wrong. */
static CpsStatus move(CpsMotion *motion, CpsiKinematics *kinematics,
                      const CpsMotionOptions *options, CpsError *err) {
    static const double GUESS[] = {1, 100, 0.01, 1e4};
    const double speed = motion->speed > 0 ? motion->speed : 1;
    const bool resistance = has_resistance(motion->system);
    /* there is no drive, and no load whose power a resistance would have to dissipate: rest is a
     * solution */
    const bool still = motion->speed == 0 && !(resistance && cpsi_system_loaded(motion->system));
    const Attempt trial = {.motion = motion,
                           .kinematics = kinematics,
                           .first = motion->speed,
                           .so_far = motion->report.outcome,
                           .tolerance = options->tolerance,
                           .least = motion->force * REST,
                           .still = still};
    for (size_t k = 0; k < (resistance ? sizeof GUESS / sizeof *GUESS : 1); k++) {
        bool near = false;
        const CpsStatus status = try_both(&trial, speed * GUESS[k], &near, err);
        if (status != CPS_OK || motion->report.outcome == CPS_MOTION_OUTCOME_BLOCKED || near)
            return status;
        motion->report.outcome = CPS_MOTION_OUTCOME_INACCURATE;
    }
    return CPS_OK;
}

CpsStatus cpsi_motion_find(const CpsSystem *system, const double *driving,
                           const CpsMotionOptions *options, CpsMotion **out,
                           CpsiKinematics **kinematics, CpsError *err) {
    CpsMotion *motion = NULL;
    CpsiKinematics *made = NULL;
    CpsStatus status = motion_new(system, driving, &motion, err);
    if (status == CPS_OK) status = cpsi_kinematics_new(system, &made, err);
    if (status == CPS_OK) {
        motion->force = force_size(system);
        start_velocity(motion, made);
        /* check whether the load can be balanced, and by what factor */
        if (motion->report.outcome == CPS_MOTION_OUTCOME_SOLVED && cpsi_system_loaded(system))
            status = balance_load(motion, made, options->boundary, err);
        motion->possible = motion->report.outcome == CPS_MOTION_OUTCOME_SOLVED ||
                           motion->report.outcome == CPS_MOTION_OUTCOME_LIMIT_LOAD;
        if (status == CPS_OK && motion->possible) status = move(motion, made, options, err);
    }
    if (status == CPS_OK) {
        *out = motion;
        *kinematics = made;
    } else {
        cps_motion_destroy(motion);
        cpsi_kinematics_free(made);
    }
    return status;
}

/* ---- views ---- */

CpsMotionReport cps_motion_report(const CpsMotion *motion) {
    return motion ? motion->report : (CpsMotionReport){.outcome = CPS_MOTION_OUTCOME_INACCURATE};
}
const double *cps_motion_velocity(const CpsMotion *motion) {
    return motion ? motion->velocity : NULL;
}
const double *cps_motion_direction(const CpsMotion *motion) {
    return motion ? motion->direction : NULL;
}
const double *cps_motion_resistance(const CpsMotion *motion) {
    return motion ? motion->resistance : NULL;
}
const double *cps_motion_constraint_forces(const CpsMotion *motion) {
    return motion ? motion->constraint : NULL;
}
int cps_motion_constraint_count(const CpsMotion *motion) {
    return motion ? motion->system->constraint.rows : 0;
}

static bool has_law(const CpsMotion *motion, int k) {
    return motion && k >= 0 && k < motion->system->laws;
}

const double *cps_motion_law_velocity(const CpsMotion *motion, int k) {
    return has_law(motion, k) ? &motion->law_velocity[motion->system->law[k].first] : NULL;
}

const double *cps_motion_law_force(const CpsMotion *motion, int k) {
    return has_law(motion, k) ? &motion->law_force[motion->system->law[k].first] : NULL;
}

CpsMotionShare cps_motion_law_share(const CpsMotion *motion, int k) {
    return has_law(motion, k) ? motion->share[k] : (CpsMotionShare){0};
}
