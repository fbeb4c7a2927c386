/* SPDX-License-Identifier: BSD-3-Clause */
/* The choice of the form of a mesh file (mesh_file.h). */
#include "io/read/shapes/mesh/mesh_file.h"

#include <stdlib.h>
#include <string.h>

#include "io/base/file/read_file.h"
#include "io/base/yaml/yaml.h"

CpsStatus cpsi_mesh_file_read(const char *path, CpsiMeshForm form, size_t max_bytes, CpsiPool *pool,
                              CpsiMeshFile *out, CpsError *err) {
    char *bytes = NULL;
    size_t size = 0;
    CpsStatus status = cpsi_read_file_itself(path, max_bytes, &bytes, &size, err);
    if (status != CPS_OK) return status;
    CpsiGridText text = {.path = path,
                         .bytes = bytes,
                         .size = size,
                         .pool = pool,
                         .err = err,
                         .blanks_only = true, /* a decimal comma must not become two numbers */
                         .at = bytes,
                         .line_start = bytes,
                         .line = 1,
                         .column = 1};
    *out = (CpsiMeshFile){0};
    if (form == CPSI_MESH_STL)
        status = cpsi_mesh_read_stl(&text, out);
    else if (memchr(bytes, '\0', size))
        status = cpsi_fail_at(err, CPS_ERR_INPUT, path, 0, 0, "found a zero byte: is this text?");
    else
        status = cpsi_mesh_read_obj(&text, out);
    free(bytes);
    return status;
}
