/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan drive: answers by kind of file, as text and as JSON. */
#ifndef CAPSTAN_CLI_DRIVE_SYSTEM_ANSWER_H
#define CAPSTAN_CLI_DRIVE_SYSTEM_ANSWER_H

#include "capstan/io.h"
#include "law/law_query.h"

/* One run of the command. */
typedef struct DriveRun {
    const CpsDriveFile *file;
    const CliOptions *options;
    bool json;
    /* every query so far was answered; otherwise the command ends with EXIT_NOT_CERTIFIED */
    bool answered;
    bool none; /* a motion that was asked for is proved not to exist: EXIT_NO_SOLUTION */
    CpsError err;
} DriveRun;

/* Answer and, with --plot, draw. Each returns an exit code, after a message where it is not
 * EXIT_OK. The caller begins the JSON object with the title, and ends it. */
int drive_answer_system(DriveRun *run);
int drive_answer_body(DriveRun *run);
int drive_answer_planimeter(DriveRun *run);
int drive_answer_rope(DriveRun *run);
int drive_answer_sweep(DriveRun *run);

/* `, "key": 1.5`, and the same with a vector, or a text. */
void drive_json(const char *key, double x);
void drive_json_list(const char *key, int n, const double *x);
void drive_json_word(const char *key, const char *text);
/* Rows of n numbers as a list of lists. */
void drive_json_rows(const char *key, int n, int count, const double *x);

int drive_no_memory(void);

#endif
