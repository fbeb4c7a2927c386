/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/classic_io.h: a study of the 1990 method as files and pictures.       (library capstan-io) */
#ifndef CAPSTAN_CLASSIC_IO_H
#define CAPSTAN_CLASSIC_IO_H

#include "capstan/classic.h"
#include "capstan/io.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What belongs together in one directory. */
typedef struct CpsStudyFiles {
    const char *title; /* of the pictures */
    const CpsClassic *classic;
    const CpsStudy *study;
    const CpsFirstOrder *first_order;
} CpsStudyFiles;

/* Write study.csv, study.svg (tensions and errors on the way to the limits), first-order.csv and first-order.svg (P10.1
 * beside P2.1) and relaxed.svg (J and J** of S90 remark 4.6.1) into `directory`, made if missing (one level). All
 * appear whole and together, or not at all.
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_IO or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_study_write(const char *directory, const CpsStudyFiles *files, CpsError *err);

/* Configurations that a method has gone through. */
typedef struct CpsMethodHistory {
    const char *name;
    const double *position; /* (steps, points, 3) [m] */
} CpsMethodHistory;

/* Write methods.csv (where end B is after each step, and how far each method is from the first one) and methods.svg
 * (plan and elevation of all steps, a column per method) into `directory`, as cps_study_write.
 *
 *   methods    1..4 of them; steps >= 1, points >= 2 are the same for all
 *   step_name  (steps) */
CPS_API CpsStatus cps_methods_write(const char *directory, const char *title, int methods,
                                    const CpsMethodHistory *method, int steps, int points, const char *const *step_name,
                                    CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
