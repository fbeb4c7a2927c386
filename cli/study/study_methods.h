/* SPDX-License-Identifier: BSD-3-Clause */
/* A whole history by three methods: regularised, frozen, consistent. */
#ifndef CAPSTAN_CLI_STUDY_STUDY_METHODS_H
#define CAPSTAN_CLI_STUDY_STUDY_METHODS_H

#include "capstan/io.h"
#include "options.h"

/* Run the scene three times, print the positions of end B of the line, write methods.csv and
 * methods.svg. Returns the exit code. */
int study_methods(const CpsScene *scene, const CliOptions *options, const char *directory);

#endif
