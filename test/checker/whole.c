/* SPDX-License-Identifier: BSD-3-Clause */
/* A result file against the list in the summary beside it (see whole.h). */
#include "whole.h"

#include <inttypes.h>
#include <stdint.h>
#include <string.h>

/* `name` in the directory of `path`; NULL where it cannot be opened */
static FILE *open_beside(const char *path, const char *name) {
    char full[4096];
    const char *slash = strrchr(path, '/');
    const int length = snprintf(full, sizeof full, "%.*s%s", slash ? (int)(slash + 1 - path) : 0, path, name);
    return length > 0 && (size_t)length < sizeof full ? fopen(full, "rb") : NULL;
}

/* Does .capstan say that files were being replaced, and is the one missing that comes last? */
static int is_interrupted(const char *path) {
    char line[512], last[512] = "";
    FILE *marker = open_beside(path, ".capstan");
    while (marker && fgets(line, sizeof line, marker))
        if (strncmp(line, "x ", 2) == 0) sscanf(line + 2, "%511s", last);
    if (marker) fclose(marker);
    FILE *there = *last ? open_beside(path, last) : NULL;
    if (there) fclose(there);
    return *last && !there;
}

/* bit by bit, as the standard has it */
static uint32_t crc_of(FILE *file, uint64_t *bytes) {
    uint32_t crc = 0xffffffffu;
    *bytes = 0;
    for (int c; (c = getc(file)) != EOF; ++*bytes) {
        crc ^= (uint32_t)c;
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
    }
    return ~crc;
}

int whole_file(const char *path, FILE *out) {
    if (is_interrupted(path)) {
        fprintf(out, "%s: the files beside it are of two runs, because replacing them was interrupted: run again into this directory\n", path);
        return 1;
    }
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    FILE *summary = open_beside(path, "summary.json"), *file = summary ? fopen(path, "rb") : NULL;
    char line[4096], quoted[512];
    snprintf(quoted, sizeof quoted, "{\"name\": \"%s\", ", name);
    int findings = 0;
    while (file && fgets(line, sizeof line, summary)) {
        const char *entry = strstr(line, quoted);
        uint64_t listed, bytes;
        uint32_t listed_crc;
        if (!entry || sscanf(entry + strlen(quoted), "\"bytes\": %" SCNu64 ", \"crc32\": \"%" SCNx32, &listed, &listed_crc) != 2) continue;
        rewind(file);
        const uint32_t crc = crc_of(file, &bytes);
        if (bytes == listed && crc == listed_crc) continue;
        findings++;
        fprintf(out, "%s: %" PRIu64 " bytes, crc32 %08" PRIx32 "; the summary beside it lists %" PRIu64 " bytes, crc32 %08" PRIx32 ": not of its run\n",
                path, bytes, crc, listed, listed_crc);
    }
    if (file) fclose(file);
    if (summary) fclose(summary);
    return findings;
}
