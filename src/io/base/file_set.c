/* SPDX-License-Identifier: BSD-3-Clause */
/* Several files written together (see file_set.h). */
#include "io/base/file_set.h"

#include <locale.h>

#include "base/status.h"
#include "io/base/write_directory.h"

static bool nothing_stale(const char *name) {
    (void)name;
    return false;
}

static CpsStatus write_all(CpsiDirectory *directory, const CpsiFile *file, int count, CpsError *err) {
    for (int i = 0; i < count; ++i) {
        FILE *out = NULL;
        CpsStatus status = cpsi_directory_create(directory, file[i].name, &out, err);
        if (status != CPS_OK) return status;
        file[i].put(file[i].what, out);
        status = cpsi_directory_close_file(directory, out, err);
        if (status != CPS_OK) return status;
    }
    return cpsi_directory_commit(directory, nothing_stale, err);
}

CpsStatus cpsi_file_set_write(const char *directory, const CpsiFile *file, int count, CpsError *err) {
    const locale_t numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!numbers) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const locale_t before = uselocale(numbers);
    CpsiDirectory *open = NULL;
    CpsStatus status = cpsi_directory_open(directory, &open, err);
    if (status == CPS_OK) status = write_all(open, file, count, err);
    cpsi_directory_destroy(open);
    uselocale(before);
    freelocale(numbers);
    return status;
}

CpsStatus cpsi_file_set_put(const CpsiFile *file, FILE *out, CpsError *err) {
    const locale_t numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!numbers) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const locale_t before = uselocale(numbers);
    file->put(file->what, out);
    uselocale(before);
    freelocale(numbers);
    return CPS_OK;
}
