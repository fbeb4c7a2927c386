/* SPDX-License-Identifier: BSD-3-Clause */
/* Writing a JSON schema. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_SCENE_JSON_H
#define CAPSTAN_SRC_IO_SCHEMA_SCENE_JSON_H

#include <stdio.h>

#include "capstan/base.h"

/* Let `put` write all of it, with decimal points whatever the locale. Returns CPS_OK, CPS_ERR_ARGUMENT (out is NULL),
 * CPS_ERR_IO or CPS_ERR_MEMORY. */
CpsStatus cpsi_write_schema(FILE *out, void (*put)(FILE *out), CpsError *err);

/* The definitions of sets and of what they are made of, the last ones of "$defs" (set_json.c). */
void cpsi_put_set_definitions(FILE *out);

/* The same with those of the terms of resistance laws before them. */
void cpsi_put_law_definitions(FILE *out);

#endif
