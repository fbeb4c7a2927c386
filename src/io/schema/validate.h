/* SPDX-License-Identifier: BSD-3-Clause */
/* Check a parsed scene file against the table of keys: after it, building the scene needs no checks of form. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_VALIDATE_H
#define CAPSTAN_SRC_IO_SCHEMA_VALIDATE_H

#include "io/base/yaml.h"

/* Every key is known and given where it must be, every value has its type and is within its range. Writes `number` of
 * each scalar: the number, or which of its key's words it is, from 0.
 *
 * Returns CPS_OK or CPS_ERR_INPUT. */
CpsStatus cpsi_scene_validate(const char *file, CpsiYaml *root, CpsError *err);

#endif
