/* SPDX-License-Identifier: BSD-3-Clause */
/* The part of a JSON schema that says what sets and laws are. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_SET_JSON_H
#define CAPSTAN_SRC_IO_SCHEMA_SET_JSON_H

#include <stdio.h>

/* The definitions of sets and of what they are made of, the last ones of "$defs". */
void cpsi_write_set_definitions(FILE *out);

/* The same with those of the terms of resistance laws before them. */
void cpsi_write_law_definitions(FILE *out);

#endif
