/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows of numbers in text (cps_row_read of capstan/io.h; text_rows.h). */
#include "io/base/file/text_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/io.h"
#include "io/base/file/read_file.h"
#include "io/base/yaml/yaml.h"

static const char BLANKS[] = " \t\r\n";

int cps_row_read(const char *text, const char *separators, int most, double *value,
                 const char **rest) {
    if (!text || !separators || !value || !rest) return 0;
    int n = 0;
    *rest = text + strspn(text, BLANKS);
    for (const char *at = *rest; n < most; n++) {
        char *end;
        value[n] = strtod(at, &end);
        if (end == at || !(fabs(value[n]) <= 1e100)) break;
        at = *rest = end + strspn(end, BLANKS);
        if (*at && strchr(separators, *at))
            at++;
        else if (at == end || !strchr(separators, ' '))
            return n + 1;
    }
    return n;
}

CpsStatus cpsi_text_rows_open(CpsiTextRows *rows, const char *path, size_t max_bytes,
                              CpsError *err) {
    *rows = (CpsiTextRows){.lines = 1};
    size_t size = 0;
    CpsStatus status = cpsi_read_file_itself(path, max_bytes, &rows->bytes, &size, err);
    if (status == CPS_OK && strlen(rows->bytes) != size)
        status = cpsi_fail_at(err, CPS_ERR_INPUT, path, 0, 0, "found a zero byte: is this text?");
    /* spreadsheets begin UTF-8 with the mark of its bytes' order */
    rows->next =
        rows->bytes && strncmp(rows->bytes, "\xEF\xBB\xBF", 3) == 0 ? rows->bytes + 3 : rows->bytes;
    for (const char *c = rows->bytes; c && *c; c++) rows->lines += *c == '\n';
    return status;
}

char *cpsi_text_rows_next(CpsiTextRows *rows) {
    while (rows->next) {
        char *text = rows->next;
        rows->line++;
        if ((rows->next = strchr(text, '\n'))) *rows->next++ = '\0';
        const char first = text[strspn(text, " \t\r")];
        if (first && first != '#') return text;
    }
    return NULL;
}
