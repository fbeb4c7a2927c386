/* SPDX-License-Identifier: BSD-3-Clause */
/* Writing a JSON schema. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_JSON_SCHEMA_H
#define CAPSTAN_SRC_IO_SCHEMA_JSON_SCHEMA_H

#include <stdio.h>

#include "io/schema/keys.h"

/* What definitions call the mapping of this number. */
typedef const char *(*CpsiName)(int mapping);

/* What values a row accepts, without braces; and the same with description and default, as an object. */
void cpsi_write_value(FILE *out, const CpsiKey *key, CpsiName name);
void cpsi_draw_key(FILE *out, const CpsiKey *key, CpsiName name);

/* Let `put` write all of it, with decimal points whatever the locale. Returns CPS_OK, CPS_ERR_ARGUMENT (out is NULL),
 * CPS_ERR_IO or CPS_ERR_MEMORY. */
CpsStatus cpsi_write_schema(FILE *out, void (*put)(FILE *out), CpsError *err);

#endif
