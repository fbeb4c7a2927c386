/* SPDX-License-Identifier: BSD-3-Clause */
/* A journal of steps (io.h): one record per step, size, checksum and the state of cps_evolution_save, each synced before the next step
 * begins unless that is left to the end. A record that a killed run left unfinished, or that a power cut took a part of, is found by its
 * size or its checksum and dropped with all that follow it. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/status.h"
#include "capstan/io.h"

struct CpsJournal {
    char *path;
    int file;
    bool late;            /* synced by cps_journal_sync alone */
    off_t end;            /* of the last whole record read or written */
    size_t size;          /* of a state */
    unsigned char *state; /* (size) */
};

typedef struct Record {
    uint64_t size, checksum;
} Record;

/* FNV-1a over 64-bit words, the last one filled with zeros. */
static uint64_t checksum(const unsigned char *byte, size_t size) {
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < size; i += 8) {
        uint64_t word = 0;
        memcpy(&word, byte + i, size - i < 8 ? size - i : 8);
        hash = (hash ^ word)*1099511628211u;
    }
    return hash;
}

/* All bytes or a failure, at an offset; a short read is no failure: *got says how many. */
static bool read_at(int file, void *to, size_t size, off_t at, size_t *got) {
    for (*got = 0; *got < size;) {
        const ssize_t n = pread(file, (char *)to + *got, size - *got, at + (off_t)*got);
        if (n < 0 && errno == EINTR) continue;
        if (n < 0) return false;
        if (n == 0) return true;
        *got += (size_t)n;
    }
    return true;
}

static bool write_at(int file, const void *from, size_t size, off_t at) {
    for (size_t done = 0; done < size;) {
        const ssize_t n = pwrite(file, (const char *)from + done, size - done, at + (off_t)done);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) return false;
        done += (size_t)n;
    }
    return true;
}

static CpsStatus fail(const CpsJournal *journal, const char *what, CpsError *err) {
    return cpsi_fail(err, CPS_ERR_IO, "cannot %s the journal %s: %s", what, journal->path, strerror(errno));
}

CpsStatus cps_journal_open(const char *directory, const CpsEvolution *evolution, bool resume, CpsJournal **out, CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL; give the address of a CpsJournal pointer");
    *out = NULL;
    if (!directory || !evolution) return cpsi_fail(err, CPS_ERR_ARGUMENT, "directory and evolution are both needed");
    CpsJournal *journal = calloc(1, sizeof *journal);
    const size_t length = strlen(directory) + sizeof "/.journal";
    if (journal) *journal = (CpsJournal){.file = -1, .size = cps_evolution_state_size(evolution), .path = malloc(length)};
    if (journal) journal->state = malloc(journal->size);
    if (!journal || !journal->path || !journal->state) {
        cps_journal_destroy(journal);
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while opening the journal");
    }
    memcpy(journal->path, directory, length - sizeof "/.journal");
    memcpy(journal->path + length - sizeof "/.journal", "/.journal", sizeof "/.journal");
    journal->file = open(journal->path, O_RDWR | O_CREAT | O_CLOEXEC | (resume ? 0 : O_TRUNC), 0666);
    if (journal->file < 0) {
        const CpsStatus status = fail(journal, "open", err);
        cps_journal_destroy(journal);
        return status;
    }
    *out = journal;
    return CPS_OK;
}

CpsStatus cps_journal_next(CpsJournal *journal, CpsEvolution *evolution, bool *found, CpsError *err) {
    if (!journal || !evolution || !found) return cpsi_fail(err, CPS_ERR_ARGUMENT, "journal, evolution and found are all needed");
    *found = false;
    Record record;
    size_t got;
    if (!read_at(journal->file, &record, sizeof record, journal->end, &got)) return fail(journal, "read", err);
    if (got < sizeof record) return CPS_OK;
    if (record.size != journal->size)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the journal %s is of another scene than this one: remove it, or run without going on",
                         journal->path);
    if (!read_at(journal->file, journal->state, journal->size, journal->end + (off_t)sizeof record, &got))
        return fail(journal, "read", err);
    if (got < journal->size || checksum(journal->state, journal->size) != record.checksum) return CPS_OK;
    CpsError inner;
    if (cps_evolution_load(evolution, journal->state, journal->size, &inner) != CPS_OK)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the journal %s: %s: remove it, or run without going on", journal->path,
                         inner.message);
    journal->end += (off_t)(sizeof record + journal->size);
    *found = true;
    return CPS_OK;
}

CpsStatus cps_journal_append(CpsJournal *journal, const CpsEvolution *evolution, CpsError *err) {
    if (!journal || !evolution) return cpsi_fail(err, CPS_ERR_ARGUMENT, "journal and evolution are both needed");
    cps_evolution_save(evolution, journal->state);
    const Record record = {journal->size, checksum(journal->state, journal->size)};
    const off_t body = journal->end + (off_t)sizeof record;
    if (!write_at(journal->file, &record, sizeof record, journal->end) ||
        !write_at(journal->file, journal->state, journal->size, body) || (!journal->late && fdatasync(journal->file) != 0))
        return fail(journal, "write", err);
    journal->end = body + (off_t)journal->size;
    return CPS_OK;
}

void cps_journal_sync_late(CpsJournal *journal) {
    if (journal) journal->late = true;
}

CpsStatus cps_journal_sync(CpsJournal *journal, CpsError *err) {
    if (!journal) return cpsi_fail(err, CPS_ERR_ARGUMENT, "journal is NULL");
    return fdatasync(journal->file) == 0 ? CPS_OK : fail(journal, "write", err);
}

void cps_journal_remove(CpsJournal *journal) {
    if (journal) unlink(journal->path);
}

void cps_journal_destroy(CpsJournal *journal) {
    if (!journal) return;
    if (journal->file >= 0) close(journal->file);
    free(journal->path);
    free(journal->state);
    free(journal);
}
