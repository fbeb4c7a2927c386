/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines on a bed along x, as the fields of a step. */
#ifndef CAPSTAN_CHECKER_SAMPLE_BED_H
#define CAPSTAN_CHECKER_SAMPLE_BED_H

#include "record.h"
#include "sample_file.h"

/* All lines have four elements of 1 m, weigh 8 N/m and lie along x on a bed with mu = 1/2. */
typedef struct SampleLine {
    const char *name;
    int outcome, end_kind[2];
    double compliance;
    double move[NODES], load[NODES], friction[NODES], segment[ELEMENTS],
        tension[ELEMENTS]; /* components along x */
    double end_b, proof, proof_value;
    double claim[CLAIMS];
} SampleLine;

/* The fields of a line. The second step repeats the first from where that ended: nothing moves,
 * friction stays and does no work. Returns how many there are. */
size_t describe_on_bed(const SampleLine *line, int again, Field *field);

#endif
