/* SPDX-License-Identifier: BSD-3-Clause */
/* Result files compared with the list in their summary (see whole.h). */
#include "whole.h"

#include <inttypes.h>
#include <stdint.h>
#include <string.h>

/* `name` in the directory of `path`; NULL where it cannot be opened */
static FILE *open_beside(const char *path, const char *name) {
    char full[4096];
    const char *slash = strrchr(path, '/');
    const int length =
        snprintf(full, sizeof full, "%.*s%s", slash ? (int)(slash + 1 - path) : 0, path, name);
    return length > 0 && (size_t)length < sizeof full ? fopen(full, "rb") : NULL;
}

/* Does .capstan say that files were being replaced, and is the summary `wanted` missing, which
 * comes last? */
static int is_interrupted(const char *path, const char *wanted) {
    char line[512], last[512];
    int interrupted = 0;
    FILE *marker = open_beside(path, ".capstan");
    if (marker)
        while (fgets(line, sizeof line, marker)) {
            if (strncmp(line, "x ", 2) != 0 || sscanf(line + 2, "%511s", last) != 1 ||
                strcmp(last, wanted) != 0)
                continue;
            FILE *there = open_beside(path, last);
            if (there) fclose(there);
            interrupted = interrupted || !there;
        }
    if (marker) fclose(marker);
    return interrupted;
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

static int of_two_runs(const char *path, FILE *out) {
    fprintf(out,
            "%s: the files beside it are of two runs, because replacing them was interrupted: run "
            "again into this directory\n",
            path);
    return 1;
}

/* What a line of a summary lists. */
typedef struct Entry {
    char name[512];
    uint64_t bytes;
    uint32_t crc;
} Entry;

static int read_entry(const char *line, Entry *entry) {
    const char *at = strstr(line, "{\"name\": \"");
    return at &&
           sscanf(at, "{\"name\": \"%511[^\"]\", \"bytes\": %" SCNu64 ", \"crc32\": \"%" SCNx32,
                  entry->name, &entry->bytes, &entry->crc) == 3;
}

/* A file against its entry; 1 after a finding. */
static int differs(const char *path, const Entry *entry, FILE *out) {
    uint64_t bytes;
    FILE *file = open_beside(path, entry->name);
    if (!file) {
        fprintf(out, "%s: %s is listed and cannot be read\n", path, entry->name);
        return 1;
    }
    const uint32_t crc = crc_of(file, &bytes);
    fclose(file);
    if (bytes == entry->bytes && crc == entry->crc) return 0;
    fprintf(out,
            "%s: %s: %" PRIu64 " bytes, crc32 %08" PRIx32 "; the summary beside it lists %" PRIu64
            " bytes, crc32 %08" PRIx32 ": not of its run\n",
            path, entry->name, bytes, crc, entry->bytes, entry->crc);
    return 1;
}

/* Findings about the files that a summary lists, all or the one of that name; *listed: how many
 * these are. */
static int against_list(const char *path, const char *summary, const char *name, int *listed,
                        FILE *out) {
    char line[4096];
    Entry entry;
    int findings = 0;
    FILE *list = open_beside(path, summary);
    *listed = 0;
    if (list)
        while (fgets(line, sizeof line, list)) {
            if (!read_entry(line, &entry) || (name && strcmp(entry.name, name) != 0)) continue;
            ++*listed;
            findings += differs(path, &entry, out);
        }
    if (list) fclose(list);
    return findings;
}

static const char *name_of(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

int whole_file(const char *path, FILE *out) {
    int listed;
    if (is_interrupted(path, "summary.json")) return of_two_runs(path, out);
    return against_list(path, "summary.json", name_of(path), &listed, out);
}

int whole_set(const char *path, FILE *out) {
    int listed;
    if (is_interrupted(path, name_of(path))) return of_two_runs(path, out);
    const int findings = against_list(path, name_of(path), NULL, &listed, out);
    if (listed == 0) fprintf(out, "%s: no summary of a set of files\n", path);
    return findings + (listed == 0);
}
