/* SPDX-License-Identifier: BSD-3-Clause */
/* A journal of steps (io.h): a head that identifies the program and the scene, then one record per
 * step: its number, a checksum and the state of cps_evolution_save. Each record is synced before
 * the next step begins, unless that is postponed to the end. The journal ends where no complete
 * record follows: an incomplete record of a killed run, and a tail damaged by a power cut, are
 * dropped. */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/status.h"
#include "io/results/writers.h"

static const char NAME[] = ".journal";

struct CpsJournal {
    char *directory;
    int folder, file; /* the directory, the journal in it */
    bool late;        /* synced by cps_journal_sync only */
    bool begun;       /* begun in this process, not resumed */
    /* whether the bytes after the last complete record have not been cut off yet */
    bool tail;
    uint64_t steps;       /* number of records read or written */
    off_t end;            /* end of the last of them */
    size_t size;          /* of a state */
    unsigned char *state; /* (size) */
};

/* The head of a journal. The scene is identified by the state of its evolution before the first
 * step. */
typedef struct JournalHead {
    char magic[8], program[64];
    uint64_t build, scene,
        /* checksums of the program's version and build and of that state; size of a state in
         * bytes */
        size;
    uint64_t checksum; /* of all the above */
} JournalHead;

static const char MAGIC[8] = {'c', 'a', 'p', 's', 't', 'n', 'J', '2'},
                  PROGRAM[] = CAPSTAN_COMMIT " " CAPSTAN_BUILD;

typedef struct Record {
    uint64_t step, checksum; /* the checksum is that of the number and of the state */
} Record;

/* FNV-1a over 64-bit words, the last one filled with zeros; `hash` is the initial value. */
static uint64_t checksum(uint64_t hash, const void *bytes, size_t size) {
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < size; i += 8) {
        uint64_t word = 0;
        memcpy(&word, byte + i, size - i < 8 ? size - i : 8);
        hash = (hash ^ word) * 1099511628211u;
    }
    return hash;
}

static const uint64_t CHECKSUM_BEGINS = 14695981039346656037u;

static uint64_t record_checksum(uint64_t step, const CpsJournal *journal) {
    return checksum(checksum(CHECKSUM_BEGINS, &step, sizeof step), journal->state, journal->size);
}

/* Read all bytes at an offset. Returns false after a failure; a short read is not a failure: *got
 * is the number of bytes read. */
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
    return cpsi_fail(err, CPS_ERR_IO, "cannot %s the journal %s/%s: %s", what, journal->directory,
                     NAME, strerror(errno));
}

/* refuse the journal, which remains unchanged */
static CpsStatus refuse_file(const char *directory, CpsStatus status, const char *why,
                             CpsError *err) {
    return cpsi_fail(err, status, "%s/%s %s", directory, NAME, why);
}

static CpsStatus refuse(const CpsJournal *journal, CpsStatus status, const char *why,
                        CpsError *err) {
    return refuse_file(journal->directory, status, why, err);
}

/* open ----------------------------------------------------------------------------------------- */

enum { HOW = O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC };

static const char NO_FILE[] =
    "is not a file but a link or a device: move it away, or choose another directory";
static const char OTHER_NAMES[] =
    "has other names as well (hard links), whose content would change: copy it instead, or choose "
    "another directory";
static const char NO_JOURNAL[] =
    "is no journal of capstan: move it away, or choose another directory";

/* Whether this is the beginning of a journal; a run that was killed before it wrote anything leaves
 * an empty file. */
static bool is_magic(const char *found, size_t got) {
    return got == 0 || (got >= sizeof MAGIC && memcmp(found, MAGIC, sizeof MAGIC) == 0);
}

static JournalHead make_head(const CpsJournal *journal) {
    JournalHead head = {.build = checksum(CHECKSUM_BEGINS, PROGRAM, sizeof PROGRAM),
                        .size = journal->size};
    memcpy(head.magic, MAGIC, sizeof MAGIC);
    snprintf(head.program, sizeof head.program, "%s", cps_version());
    head.build = checksum(head.build, head.program, sizeof head.program);
    snprintf(head.program, sizeof head.program, "capstan %s, %s", cps_version(), CAPSTAN_COMMIT);
    head.scene = checksum(CHECKSUM_BEGINS, journal->state, journal->size);
    head.checksum = checksum(CHECKSUM_BEGINS, &head, offsetof(JournalHead, checksum));
    return head;
}

/* An empty journal, synced to the disk together with its name. */
static CpsStatus begin(CpsJournal *journal, CpsError *err) {
    const JournalHead head = make_head(journal);
    journal->begun = true;
    journal->end = (off_t)sizeof head;
    if (ftruncate(journal->file, 0) != 0 || !write_at(journal->file, &head, sizeof head, 0) ||
        fdatasync(journal->file) != 0)
        return fail(journal, "write", err);
    /* a file system that cannot sync a directory is accepted */
    return fsync(journal->folder) == 0 || errno == EINVAL ? CPS_OK : fail(journal, "write", err);
}

/* Accept what is there as a journal as far as it is complete: `got` bytes of its head. */
static CpsStatus take_up(CpsJournal *journal, CpsJournalMode mode, const JournalHead *found,
                         size_t got, CpsError *err) {
    if (!is_magic(found->magic, got)) return refuse(journal, CPS_ERR_IO, NO_JOURNAL, err);
    struct stat about;
    if (fstat(journal->file, &about) != 0) return fail(journal, "read", err);
    const JournalHead own = make_head(journal);
    const bool empty = about.st_size <= (off_t)sizeof own;
    if (mode == CPS_JOURNAL_REPLACE || empty) return begin(journal, err);
    if (mode == CPS_JOURNAL_NEW)
        return refuse(journal, CPS_ERR_IO,
                      "keeps the steps of a run that was interrupted: go on with it (--resume), or "
                      "begin anew without them (--force)",
                      err);
    if (found->checksum != checksum(CHECKSUM_BEGINS, found, offsetof(JournalHead, checksum)))
        return refuse(journal, CPS_ERR_ARGUMENT,
                      "has a damaged head: nothing can be taken from it; begin anew (--force)",
                      err);
    if (found->build != own.build)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s/%s is of another program, %.*s; this is %s, or another build of it: "
                         "go on with that one, or begin anew (--force)",
                         journal->directory, NAME, (int)sizeof found->program - 1, found->program,
                         own.program);
    if (found->scene != own.scene || found->size != own.size)
        return refuse(
            journal, CPS_ERR_ARGUMENT,
            "is of another scene than this one, or of other settings: begin anew (--force)", err);
    journal->end = (off_t)sizeof own;
    return CPS_OK;
}

/* The file in the directory itself, never the target of a link. */
static CpsStatus open_file(CpsJournal *journal, CpsJournalMode mode, CpsError *err) {
    journal->folder = open(journal->directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (journal->folder < 0) return fail(journal, "open", err);
    journal->file = openat(journal->folder, NAME, HOW | O_RDWR | O_CREAT | O_EXCL, 0666);
    if (journal->file >= 0) return begin(journal, err);
    if (errno != EEXIST) return fail(journal, "open", err);
    struct stat about;
    journal->file = openat(journal->folder, NAME, HOW | O_RDWR);
    if (journal->file < 0 && errno != ELOOP) return fail(journal, "open", err);
    if (journal->file < 0 || fstat(journal->file, &about) != 0 || !S_ISREG(about.st_mode))
        return refuse(journal, CPS_ERR_IO, NO_FILE, err);
    if (about.st_nlink > 1) return refuse(journal, CPS_ERR_IO, OTHER_NAMES, err);
    JournalHead found = {0};
    size_t got;
    if (!read_at(journal->file, &found, sizeof found, 0, &got)) return fail(journal, "read", err);
    return take_up(journal, mode, &found, got, err);
}

/* The file .journal of a directory; *there: it is one that keeps steps. */
static CpsStatus look_at(int folder, const char *directory, bool *there, CpsError *err) {
    struct stat about;
    char magic[sizeof MAGIC];
    size_t got;
    *there = false;
    const int file = openat(folder, NAME, HOW | O_RDONLY);
    if (file < 0 && errno == ENOENT) return CPS_OK;
    CpsStatus status = CPS_OK;
    if (file < 0 || fstat(file, &about) != 0 || !S_ISREG(about.st_mode))
        status = refuse_file(directory, CPS_ERR_IO, NO_FILE, err);
    else if (!read_at(file, magic, sizeof magic, 0, &got) || !is_magic(magic, got))
        status = refuse_file(directory, CPS_ERR_IO, NO_JOURNAL, err);
    else
        *there = about.st_size > (off_t)sizeof(JournalHead);
    if (file >= 0) close(file);
    return status;
}

/* Give the steps of an interrupted run up, if `force` says so. */
static CpsStatus give_up(int folder, const char *directory, bool force, CpsError *err) {
    if (!force)
        return refuse_file(directory, CPS_ERR_IO,
                           "keeps the steps of a run that was interrupted: go on with it "
                           "(run --resume), choose another directory, or give them up (--force)",
                           err);
    if (unlinkat(folder, NAME, 0) == 0) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_IO, "cannot remove the journal %s/%s: %s", directory, NAME,
                     strerror(errno));
}

CpsStatus cpsi_journal_check(const char *directory, bool other, bool force, CpsError *err) {
    const int folder = open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return CPS_OK; /* the directory itself is another matter */
    bool there;
    CpsStatus status = look_at(folder, directory, &there, err);
    if (other) status = CPS_OK; /* a file that is not touched */
    if (other && there) status = give_up(folder, directory, force, err);
    close(folder);
    return status;
}

CpsStatus cps_journal_open(const char *directory, const CpsEvolution *evolution,
                           CpsJournalMode mode, CpsJournal **out, CpsError *err) {
    if (!out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "out is NULL; give the address of a CpsJournal pointer");
    *out = NULL;
    if (!directory || !evolution)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "directory and evolution are both needed");
    if (mode != CPS_JOURNAL_NEW && mode != CPS_JOURNAL_RESUME && mode != CPS_JOURNAL_REPLACE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%d is no mode of a journal", (int)mode);
    if (cps_evolution_report(evolution).step_count > 0)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "the evolution has taken steps already: open its journal before the first one");
    CpsJournal *journal = calloc(1, sizeof *journal);
    if (journal)
        *journal = (CpsJournal){.folder = -1,
                                .file = -1,
                                .size = cps_evolution_state_size(evolution),
                                .directory = strdup(directory)};
    if (journal) journal->state = malloc(journal->size);
    if (!journal || !journal->directory || !journal->state) {
        cps_journal_destroy(journal);
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while opening the journal");
    }
    cps_evolution_save(evolution, journal->state);
    const CpsStatus status = open_file(journal, mode, err);
    if (status) {
        cps_journal_destroy(journal);
        return status;
    }
    *out = journal;
    return CPS_OK;
}

/* steps ---------------------------------------------------------------------------------------- */

CpsStatus cps_journal_next(CpsJournal *journal, CpsEvolution *evolution, bool *found,
                           CpsError *err) {
    if (!journal || !evolution || !found)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "journal, evolution and found are all needed");
    *found = false;
    if (cps_evolution_state_size(evolution) != journal->size)
        return refuse(journal, CPS_ERR_ARGUMENT, "was opened for another evolution than this one",
                      err);
    Record record;
    size_t got;
    if (!read_at(journal->file, &record, sizeof record, journal->end, &got))
        return fail(journal, "read", err);
    const bool begun = got == sizeof record && record.step == journal->steps;
    const off_t body = journal->end + (off_t)sizeof record;
    if (begun && !read_at(journal->file, journal->state, journal->size, body, &got))
        return fail(journal, "read", err);
    if (!begun || got < journal->size || record_checksum(record.step, journal) != record.checksum) {
        journal->tail = true;
        return CPS_OK;
    }
    CpsError inner;
    const CpsStatus status = cps_evolution_load(evolution, journal->state, journal->size, &inner);
    if (status == CPS_OK && cps_evolution_report(evolution).step_count != (int)journal->steps + 1)
        return refuse(journal, CPS_ERR_ARGUMENT,
                      "has its steps in another order: begin anew (--force)", err);
    if (status != CPS_OK)
        return cpsi_fail(err, status, "%s/%s: %s: begin anew (--force)", journal->directory, NAME,
                         inner.message);
    journal->end = body + (off_t)journal->size;
    journal->steps++;
    *found = true;
    return CPS_OK;
}

CpsStatus cps_journal_append(CpsJournal *journal, const CpsEvolution *evolution, CpsError *err) {
    if (!journal || !evolution)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "journal and evolution are both needed");
    if (cps_evolution_state_size(evolution) != journal->size)
        return refuse(journal, CPS_ERR_ARGUMENT, "was opened for another evolution than this one",
                      err);
    if (cps_evolution_report(evolution).step_count != (int)journal->steps + 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "step %d follows the %d steps of the journal; append every step once",
                         cps_evolution_report(evolution).step_count - 1, (int)journal->steps);
    if (journal->tail && ftruncate(journal->file, journal->end) != 0)
        return fail(journal, "write", err);
    journal->tail = false;
    cps_evolution_save(evolution, journal->state);
    const Record record = {journal->steps, record_checksum(journal->steps, journal)};
    const off_t body = journal->end + (off_t)sizeof record;
    if (!write_at(journal->file, &record, sizeof record, journal->end) ||
        !write_at(journal->file, journal->state, journal->size, body) ||
        (!journal->late && fdatasync(journal->file) != 0))
        return fail(journal, "write", err);
    journal->end = body + (off_t)journal->size;
    journal->steps++;
    return CPS_OK;
}

void cps_journal_sync_late(CpsJournal *journal) {
    if (journal) journal->late = true;
}

CpsStatus cps_journal_sync(CpsJournal *journal, CpsError *err) {
    if (!journal) return cpsi_fail(err, CPS_ERR_ARGUMENT, "journal is NULL");
    return fdatasync(journal->file) == 0 ? CPS_OK : fail(journal, "write", err);
}

/* Remove only the file that was opened (every journal that a caller has is open): a file that has
 * replaced it belongs to someone else. */
CpsStatus cps_journal_remove(CpsJournal *journal, CpsError *err) {
    struct stat own, named;
    if (!journal) return cpsi_fail(err, CPS_ERR_ARGUMENT, "journal is NULL");
    if (fstat(journal->file, &own) == 0 &&
        fstatat(journal->folder, NAME, &named, AT_SYMLINK_NOFOLLOW) == 0) {
        if (own.st_dev != named.st_dev || own.st_ino != named.st_ino) return CPS_OK;
        if (unlinkat(journal->folder, NAME, 0) == 0) return CPS_OK;
    }
    return errno == ENOENT ? CPS_OK : fail(journal, "remove", err);
}

void cps_journal_destroy(CpsJournal *journal) {
    if (!journal) return;
    if (journal->begun && journal->steps == 0)
        cps_journal_remove(journal, NULL); /* there are no steps to continue from */
    if (journal->file >= 0) close(journal->file);
    if (journal->folder >= 0) close(journal->folder);
    free(journal->directory);
    free(journal->state);
    free(journal);
}
