/* SPDX-License-Identifier: BSD-3-Clause */
/* The choice of the form of a grid file (grid_file.h). */
#include "io/read/shapes/ground/grid_file.h"

#include <stdlib.h>
#include <string.h>

#include "io/base/file/read_file.h"
#include "io/base/yaml/yaml.h"

static CpsStatus read_form(CpsiGridText *text, CpsiGridForm form, const char *variable,
                           CpsiGridFile *out) {
    if (form == CPSI_GRID_NETCDF) return cpsi_grid_read_netcdf(text, variable, out);
    if (memchr(text->bytes, '\0', text->size))
        return cpsi_fail_at(text->err, CPS_ERR_INPUT, text->path, 0, 0,
                            "found a zero byte: is this text?");
    switch (form) {
    case CPSI_GRID_ESRI: return cpsi_grid_read_esri(text, out);
    case CPSI_GRID_XYZ: return cpsi_grid_read_xyz(text, out);
    case CPSI_GRID_MOORDYN_C: return cpsi_grid_read_moordyn_c(text, out);
    default: return cpsi_grid_read_moordyn_f(text, out);
    }
}

CpsStatus cpsi_grid_file_read(const char *path, CpsiGridForm form, const char *variable,
                              size_t max_bytes, CpsiPool *pool, CpsiGridFile *out, CpsError *err) {
    char *bytes = NULL;
    size_t size = 0;
    CpsStatus status = cpsi_read_file_itself(path, max_bytes, &bytes, &size, err);
    if (status != CPS_OK) return status;
    CpsiGridText text = {.path = path,
                         .bytes = bytes,
                         .size = size,
                         .pool = pool,
                         .err = err,
                         .at = bytes,
                         .line_start = bytes,
                         .line = 1,
                         .column = 1};
    status = read_form(&text, form, variable, out);
    free(bytes);
    return status;
}
