/* SPDX-License-Identifier: BSD-3-Clause */
/* Pictures of a study of the 1990 method. */
#ifndef CAPSTAN_SRC_IO_DRAW_STUDY_STUDY_PICTURE_H
#define CAPSTAN_SRC_IO_DRAW_STUDY_STUDY_PICTURE_H

#include "capstan/results.h"

/* The final tensions of the stages, over those of P4.2; below, errors and residuals of all
 * solves. */
void cpsi_picture_study(const CpsStudyFiles *files, FILE *out);

/* Strain and tension of P10.1 along the line beside those of P2.1, with the region that (86)
 * excludes. */
void cpsi_picture_first_order(const CpsStudyFiles *files, FILE *out);

/* J and J** of remark 4.6.1, K in units of the step's largest force: figure 4 where that is 8. */
void cpsi_picture_relaxed(const CpsStudyFiles *files, FILE *out);

#endif
