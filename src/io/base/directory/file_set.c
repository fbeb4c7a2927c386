/* SPDX-License-Identifier: BSD-3-Clause */
/* Several files written together (see file_set.h). */
#include "io/base/directory/file_set.h"

#include "base/status.h"
#include "io/base/directory/file_list.h"
#include "io/base/text/escape.h"
#include "io/base/text/numbers.h"

static bool nothing_stale(const char *name) {
    (void)name;
    return false;
}

void cpsi_file_set_title(const void *title, FILE *out) {
    fprintf(out, "{\n  \"capstan\": \"%s\",\n  \"title\": ", cps_version());
    cpsi_write_json_string(out, title);
}

static CpsStatus write_file(CpsiDirectory *directory, const CpsiFile *file, bool listed,
                            CpsError *err) {
    FILE *out = NULL;
    CpsStatus status = cpsi_directory_create(directory, file->name, &out, err);
    if (status != CPS_OK) return status;
    file->put(file->what, out);
    if (listed) {
        fputs(",\n", out);
        status = cpsi_result_list_add(directory, out, err);
        fputs("}\n", out);
    }
    const CpsStatus closed =
        cpsi_directory_close_file(directory, out, status == CPS_OK ? err : NULL);
    return status != CPS_OK ? status : closed;
}

static CpsStatus write_all(CpsiDirectory *directory, const CpsiFile *file, int count,
                           const CpsiFile *summary, bool (*stale)(const char *name),
                           CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int i = 0; i < count && status == CPS_OK; ++i)
        status = write_file(directory, &file[i], false, err);
    if (status == CPS_OK) status = write_file(directory, summary, true, err);
    return status == CPS_OK ? cpsi_directory_commit(directory, stale ? stale : nothing_stale, err)
                            : status;
}

CpsStatus cpsi_file_set_write(const char *directory, const CpsiFile *file, int count,
                              const CpsiFile *summary, bool (*stale)(const char *name),
                              CpsError *err) {
    CpsiNumbers numbers;
    if (!cpsi_numbers_begin(&numbers)) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    CpsiDirectory *open = NULL;
    CpsStatus status = cpsi_directory_open(directory, &open, err);
    if (status == CPS_OK) status = write_all(open, file, count, summary, stale, err);
    cpsi_directory_destroy(open);
    cpsi_numbers_end(&numbers);
    return status;
}

CpsStatus cpsi_file_set_write_member(const CpsiFile *summary, FILE *out, CpsError *err) {
    CpsiNumbers numbers;
    if (!cpsi_numbers_begin(&numbers)) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    summary->put(summary->what, out);
    fputs("\n}\n", out);
    cpsi_numbers_end(&numbers);
    return CPS_OK;
}
