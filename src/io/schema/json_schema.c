/* SPDX-License-Identifier: BSD-3-Clause */
/* Writing a JSON schema (see json_schema.h). */
#include "io/schema/json_schema.h"

#include <locale.h>

#include "base/status.h"

CpsStatus cpsi_write_schema(FILE *out, void (*put)(FILE *out), CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected an open file");
    const locale_t numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!numbers) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const locale_t before = uselocale(numbers);
    put(out);
    uselocale(before);
    freelocale(numbers);
    if (fflush(out) != 0 || ferror(out)) return cpsi_fail(err, CPS_ERR_IO, "the schema could not be written");
    return CPS_OK;
}
