/* SPDX-License-Identifier: BSD-3-Clause */
/* Configurations of a line side by side: a column for each method, line or shape, with the curves
 * of its steps. */
#ifndef CAPSTAN_SRC_IO_DRAW_STUDY_METHODS_PICTURE_H
#define CAPSTAN_SRC_IO_DRAW_STUDY_METHODS_PICTURE_H

#include <stdio.h>

#include "capstan/results.h"

typedef struct CpsiMethods {
    const char *title, *note;
    int methods, steps, points;
    const CpsMethodHistory *method; /* (methods) */
    const char *const *step_name;   /* (steps) */
    bool plan_only; /* else plan and elevation, and both once more near the path of end B */
} CpsiMethods;

void cpsi_picture_methods(const CpsiMethods *methods, FILE *out);

#endif
