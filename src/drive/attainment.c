/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether the infimum gamma(W) is attained.
 *
 * It is attained where the balancing forces meet the relative interiors of the sets, or miss them
 * in polyhedral factors only (Rockafellar 1970, theorem 31.1). Otherwise phi may decrease forever
 * along a direction d that changes no driving velocity and dissipates nothing. To decide this, a
 * friction of s on every parameter is added: the minimum over E of phi + s |V|_1 is then attained
 * by some V(s). As s decreases, V(s) converges to a motion where there is one, and grows without
 * bound where there is none (a limit of V(s) would be a motion). phi decreases like a power of the
 * distance: where it decreases like its -p-th power, |V(s)| grows like s to the -1/(1 + p). */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/larger.h"
#include "base/status.h"
#include "drive/kinematics.h"
#include "drive/motion.h"

/* The two frictions, relative to the size of forces, and the growth of |V| above which there is no
 * motion: |V| grows at least as s^(-1/5) for sets as flat as |x|^(4/3), and remains constant where
 * a motion needs less than 1e4 times the driving velocity. */
static const double STRONG = 1e-8, WEAK = 1e-11, GROWTH = 3, FAR = 100;

/* As for the bounds in certificate.c. */
static const double ROUNDING = 16 * DBL_EPSILON;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a motion");
}

/* Rows `first` to `first` + count - 1 as a list of entries. */
static CpsStatus entries_of(const CpsiRows *rows, int first, int count, CpsEntry **entry,
                            int *entries, CpsError *err) {
    const size_t from = count > 0 ? rows->start[first] : 0,
                 to = count > 0 ? rows->start[first + count] : 0;
    *entry = malloc((to - from + 1) * sizeof **entry);
    *entries = 0;
    if (!*entry) return out_of_memory(err);
    for (int i = first; i < first + count; i++)
        for (size_t e = rows->start[i]; e < rows->start[i + 1]; e++)
            (*entry)[(*entries)++] = (CpsEntry){i - first, rows->column[e], rows->value[e]};
    return CPS_OK;
}

/* A copy of the system. */
static CpsStatus copy_system(const CpsSystem *system, CpsSystem **out, CpsError *err) {
    CpsSystem *copy = NULL;
    CpsEntry *entry = NULL;
    int count = 0;
    CpsStatus status = cps_system_create(system->n, &copy, err);
    for (int k = 0; status == CPS_OK && k < system->laws; k++) {
        const CpsiSystemLaw *law = &system->law[k];
        status = entries_of(&system->map, law->first, law->space, &entry, &count, err);
        if (status == CPS_OK && law->friction_law)
            status = cps_system_add_friction(copy, law->name, law->friction_law, count, entry, err);
        else if (status == CPS_OK)
            status = cps_system_add_resistance(copy, law->name, law->resistance, count, entry, err);
        free(entry);
        entry = NULL;
    }
    if (status == CPS_OK && system->constraint.rows > 0) {
        status = entries_of(&system->constraint, 0, system->constraint.rows, &entry, &count, err);
        if (status == CPS_OK)
            status = cps_system_add_constraints(copy, system->constraint.rows, count, entry, err);
        free(entry);
        entry = NULL;
    }
    if (status == CPS_OK) {
        status = entries_of(&system->drive, 0, system->drive.rows, &entry, &count, err);
        if (status == CPS_OK)
            status = cps_system_set_drive(copy, system->drive.rows, count, entry, err);
        free(entry);
    }
    if (status == CPS_OK && system->load) status = cps_system_set_load(copy, system->load, err);
    if (status == CPS_OK)
        *out = copy;
    else
        cps_system_destroy(copy);
    return status;
}

/* V(s), and its size; 0 where there is no answer. */
static CpsStatus with_friction(const CpsMotion *motion, double s, double *velocity, double *size,
                               CpsError *err) {
    CpsSystem *system = NULL;
    CpsSet *interval = NULL;
    CpsLaw *law = NULL;
    CpsMotion *found = NULL;
    CpsiKinematics *kinematics = NULL;
    const CpsMotionOptions options = cps_motion_options_default();
    *size = 0;
    CpsStatus status = copy_system(motion->system, &system, err);
    if (status == CPS_OK) status = cps_set_interval(-s, s, &interval, err);
    if (status == CPS_OK) status = cps_law_friction(interval, &law, err);
    for (int j = 0; status == CPS_OK && j < motion->system->n; j++)
        status = cps_system_add_friction(system, "at rest", law, 1, &(CpsEntry){0, j, 1}, err);
    if (status == CPS_OK)
        status = cpsi_motion_find(system, motion->driving, &options, &found, &kinematics, err);
    if (status == CPS_OK)
        for (int j = 0; j < motion->system->n; j++) {
            velocity[j] = found->velocity[j];
            *size = cpsi_max_nan(*size, fabs(velocity[j]));
        }
    cpsi_kinematics_free(kinematics);
    cps_motion_destroy(found);
    cps_law_release(law);
    cps_set_release(interval);
    cps_system_destroy(system);
    return status;
}

/* phi less the load's power at V, plus the rounding of both, since the powers may cancel to
 * zero. */
static double value_at(const CpsMotion *motion) {
    double phi = 0, terms = fabs(motion->report.load_power), speed = 0;
    for (int j = 0; j < motion->system->n; j++)
        speed = cpsi_max_nan(speed, fabs(motion->velocity[j]));
    for (int l = 0; l < motion->system->laws; l++) {
        phi += motion->share[l].potential;
        terms += fabs(motion->share[l].potential);
    }
    return phi - motion->report.load_power + ROUNDING * (terms + motion->force * speed);
}

/* The least value at V + t direction. Farther out phi is lower, but it is lost in the rounding of
 * two large powers. The forces are those that were found, and so is the lower bound. */
static CpsStatus lower_value(CpsMotion *motion, const double *from, CpsError *err) {
    const size_t n = (size_t)motion->system->n;
    const CpsMotionReport found = motion->report;
    double *best = malloc(n * sizeof *best), least = found.upper;
    if (!best) return out_of_memory(err);
    memcpy(best, motion->velocity, n * sizeof *best);
    CpsStatus status = CPS_OK;
    for (double t = 1e3; status == CPS_OK && t < 1e9; t *= 10) {
        for (size_t j = 0; j < n; j++)
            motion->velocity[j] = from[j] + t * motion->driven * motion->direction[j];
        status = cpsi_motion_certify(motion, NULL, err);
        const double value = value_at(motion);
        if (value < least) {
            least = value;
            memcpy(best, motion->velocity, n * sizeof *best);
        }
    }
    memcpy(motion->velocity, best, n * sizeof *best);
    free(best);
    if (status == CPS_OK) status = cpsi_motion_certify(motion, NULL, err);
    motion->report.lower = fmin(found.lower, least);
    motion->report.value = motion->report.upper = least;
    motion->report.minimum = least - motion->report.lower;
    return status;
}

CpsStatus cpsi_motion_attained(CpsMotion *motion, CpsiKinematics *kinematics, CpsError *err) {
    const size_t n = (size_t)motion->system->n;
    if (!(motion->driven > 0)) return CPS_OK; /* rest dissipates nothing */
    double *near = calloc(2 * n, sizeof *near), *far = near ? near + n : NULL, near_size,
           far_size = 0, most = 0;
    if (!near) return out_of_memory(err);
    CpsStatus status = with_friction(motion, STRONG * motion->force, near, &near_size, err);
    if (status == CPS_OK) status = with_friction(motion, WEAK * motion->force, far, &far_size, err);
    if (status == CPS_OK && near_size > 0 && far_size > GROWTH * near_size &&
        far_size > FAR * motion->driven) {
        motion->report.outcome = CPS_MOTION_OUTCOME_NOT_ATTAINED;
        /* the velocity imposed by the drive is not part of the direction */
        memset(near, 0, n * sizeof *near);
        cpsi_kinematics_project(kinematics, motion->driving, near);
        for (size_t j = 0; j < n; j++) {
            near[j] = far[j] - near[j];
            most = fmax(most, fabs(near[j]));
        }
        for (size_t j = 0; j < n; j++) motion->direction[j] = near[j] / most;
        status = lower_value(motion, far, err);
    }
    free(near);
    return status;
}
