/* SPDX-License-Identifier: BSD-3-Clause */
/* The files of a run with their sizes and checksums, for its summary (see file_list.h). */
#include "io/base/directory/file_list.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/status.h"
#include "io/base/text/escape.h"

enum { CHUNK = 1 << 16 };

/* CRC-32 of ISO 3309, reflected, polynomial 0xedb88320: that of gzip and zlib. */
static void make_table(uint32_t table[256]) {
    for (uint32_t i = 0; i < 256; ++i) {
        uint32_t value = i;
        for (int bit = 0; bit < 8; ++bit)
            value = value & 1 ? 0xedb88320u ^ (value >> 1) : value >> 1;
        table[i] = value;
    }
}

/* Checksum and size of a file. False after an error; errno gives the reason. */
static bool sum_up(int fd, const uint32_t table[256], unsigned char *chunk, uint64_t *bytes,
                   uint32_t *crc) {
    *bytes = 0;
    *crc = 0xffffffffu;
    for (;;) {
        const ssize_t n = read(fd, chunk, CHUNK);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        if (n == 0) break;
        for (ssize_t i = 0; i < n; ++i) *crc = table[(*crc ^ chunk[i]) & 0xff] ^ (*crc >> 8);
        *bytes += (uint64_t)n;
    }
    *crc ^= 0xffffffffu;
    return true;
}

CpsStatus cpsi_result_list_add(const CpsiDirectory *directory, FILE *out, CpsError *err) {
    uint32_t table[256];
    make_table(table);
    unsigned char *chunk = malloc(CHUNK);
    if (!chunk)
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while listing the files of the run");
    const size_t files = cpsi_directory_count(directory) - 1;
    CpsStatus status = CPS_OK;
    fputs("  \"files\": [", out);
    for (size_t i = 0; i < files && status == CPS_OK; ++i) {
        const char *name = cpsi_directory_name(directory, i);
        uint64_t bytes = 0;
        uint32_t crc = 0;
        const int fd = cpsi_directory_reopen(directory, name);
        if (fd < 0 || !sum_up(fd, table, chunk, &bytes, &crc))
            status =
                cpsi_fail(err, CPS_ERR_IO, "cannot read %s/%s again: %s; earlier results are kept",
                          cpsi_directory_path(directory), name, strerror(errno));
        if (fd >= 0) close(fd);
        if (status != CPS_OK) break;
        fputs(i ? ",\n    {\"name\": " : "\n    {\"name\": ", out);
        cpsi_write_json_string(out, name);
        fprintf(out, ", \"bytes\": %" PRIu64 ", \"crc32\": \"%08" PRIx32 "\"}", bytes, crc);
    }
    fputs("\n  ]\n", out);
    free(chunk);
    return status;
}
