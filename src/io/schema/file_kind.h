/* SPDX-License-Identifier: BSD-3-Clause */
/* Which of the three kinds of YAML file a file is: a scene, a law or a driven system. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_FILE_KIND_H
#define CAPSTAN_SRC_IO_SCHEMA_FILE_KIND_H

#include "io/base/yaml.h"

typedef enum CpsiFileKind { CPSI_FILE_SCENE, CPSI_FILE_LAW, CPSI_FILE_DRIVE } CpsiFileKind;

/* Does the file look like one of `expected`? Where none of that kind's own keys is given but one of
 * another kind's is, it fails with what the file is and with the commands that take it; all else is
 * left to the reader of that kind. Returns CPS_OK or CPS_ERR_INPUT. */
CpsStatus cpsi_file_expect(const char *file, const CpsiYaml *root, CpsiFileKind expected,
                           CpsError *err);

#endif
