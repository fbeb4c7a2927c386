/* SPDX-License-Identifier: BSD-3-Clause */
/* The three kinds of YAML file: scene, law and driven system. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_FILE_KIND_H
#define CAPSTAN_SRC_IO_SCHEMA_FILE_KIND_H

#include "io/base/yaml/yaml.h"

typedef enum CpsiFileKind { CPSI_FILE_SCENE, CPSI_FILE_LAW, CPSI_FILE_DRIVE } CpsiFileKind;

/* Check that the file may be of the kind `expected`. Where none of that kind's own keys is given
 * but one of another kind's is, the error names the kind of the file and the commands that read it.
 * All other checks are made by the reader of the kind. Returns CPS_OK or CPS_ERR_INPUT. */
CpsStatus cpsi_file_expect(const char *file, const CpsiYaml *root, CpsiFileKind expected,
                           CpsError *err);

#endif
