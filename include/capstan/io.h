/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/io.h: read scenes from YAML, write results and pictures.
 *     (library capstan-io; docs/formats.md) */
#ifndef CAPSTAN_IO_H
#define CAPSTAN_IO_H

#include <stdio.h>

#include "capstan/evolve.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A scene read from a file, with the memory it lives in. */
typedef struct CpsSceneFile CpsSceneFile;

/* Limits on what is read; all have generous defaults. */
typedef struct CpsReadLimits {
    size_t max_bytes;     /* file size, default 64 MiB */
    int max_depth;        /* nesting of mappings and sequences, default 64 */
    int64_t max_elements; /* of all lines together, default 10 000 000 */
    int64_t max_pairs;    /* elements of all lines times obstacles, default 100 000 000 */
    int64_t max_steps;    /* load steps of the history, default 1 000 000 */
} CpsReadLimits;
CPS_API CpsReadLimits cps_read_limits_default(void);

/* Read a scene.
 *
 *   path    a regular file; "-" reads standard input
 *   limits  NULL: defaults
 *   err     on bad input: file, line and column (from 1), what was found, what was expected
 *
 * Returns CPS_OK, CPS_ERR_INPUT, CPS_ERR_IO, CPS_ERR_LIMIT or CPS_ERR_MEMORY. The scene has also
 * passed cps_scene_check. */
CPS_API CpsStatus cps_scene_read(const char *path, const CpsReadLimits *limits, CpsSceneFile **out,
                                 CpsError *err);
CPS_API void cps_scene_file_destroy(CpsSceneFile *file);
CPS_API const CpsScene *cps_scene_file_scene(const CpsSceneFile *file);

/* Write the JSON schema (draft 2020-12) of scenes, from the same table of keys that the reader
 * uses. */
CPS_API CpsStatus cps_scene_write_schema(FILE *out, CpsError *err);

/* Text and numbers of JSON: text in quotes and made safe, as in summary.json, a number with as many
 * digits as bring it back, null where it is not finite. The calling thread's locale must have a
 * decimal point. */
CPS_API void cps_json_text(FILE *out, const char *text);
CPS_API void cps_json_number(FILE *out, double x);

/* A directory of results: summary.json, history.csv, result.nc, one .vtp per step with a .pvd, SVG
 * pictures. */
typedef struct CpsResults CpsResults;

/* Open `directory` (made if missing; one level) for the results of `evolution`. Nothing that was
 * there is touched until cps_results_finish, which renames each finished file into place. The file
 * .capstan in it lists what capstan has written there: a directory that is not empty and has none
 * is refused, and only listed files are ever replaced or removed.
 *
 * Returns CPS_OK, CPS_ERR_IO or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_results_open(const char *directory, const CpsScene *scene,
                                   const CpsEvolution *evolution, CpsResults **out, CpsError *err);

/* What is written of a run. */
typedef struct CpsResultsOptions {
    bool no_paraview; /* no .vtp and .pvd files */
    bool sync_at_end; /* files are synced at the end alone: what a power cut, not a kill, may take
                         in between is the whole run's; result.nc cannot be read before */
    /* of result.nc, per step: names of docs/results.md without the line's, separated by commas;
     * "none": numbers alone; NULL: all, which is what the checker needs */
    const char *fields;
} CpsResultsOptions;

/* Are there such fields?  Returns CPS_OK or CPS_ERR_ARGUMENT. */
CPS_API CpsStatus cps_results_check_options(const CpsResultsOptions *options, CpsError *err);

/* The same with options; NULL or zeros: everything. Returns CPS_ERR_ARGUMENT also for a field that
 * there is not. */
CPS_API CpsStatus cps_results_open_with(const char *directory, const CpsScene *scene,
                                        const CpsEvolution *evolution,
                                        const CpsResultsOptions *options, CpsResults **out,
                                        CpsError *err);

/* May results be written to `directory`?  Asked before anything is computed. One that is not empty
 * and that capstan has not written to is refused, or with `force` taken over: what lies in it under
 * names of results counts as capstan's from then on and may be replaced. One that is missing will
 * be made. Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_IO or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_results_prepare(const char *directory, bool force, CpsError *err);

/* Are files in `directory` of two runs, because replacing them was interrupted?  Then the one that
 * is put in place last is missing, the summary of its set: `missing` is its name, else "". Writing
 * that set again replaces them all. Returns CPS_OK, also where there is no such directory,
 * CPS_ERR_ARGUMENT for NULL or an empty name, CPS_ERR_IO or CPS_ERR_MEMORY. */
enum { CPS_RESULT_NAME = 256 };
CPS_API CpsStatus cps_results_missing(const char *directory, char missing[CPS_RESULT_NAME],
                                      CpsError *err);

/* Append the step just taken (all lines). result.nc is synced. */
CPS_API CpsStatus cps_results_append(CpsResults *results, const CpsEvolution *evolution,
                                     CpsError *err);

/* Write what needs the whole history (summary, pictures), close and rename everything into place.
 *   wall   [s] time of the whole run, for the summary
 * On failure the temporary files are removed and what was there before stays; or, where a file
 * could not be renamed after others were, the message says that the files are of two runs,
 * summary.json is missing, and the next run recognises it (cps_results_missing). */
CPS_API CpsStatus cps_results_finish(CpsResults *results, double wall, CpsError *err);

/* Close without keeping unfinished files; accepts NULL; needed after cps_results_finish too. */
CPS_API void cps_results_destroy(CpsResults *results);

/* A journal of the steps taken, `directory`/.journal: after a run has been killed, another one goes
 * on from it and ends with the same bits.
 *
 *     cps_journal_open(directory, evolution, resume ? CPS_JOURNAL_RESUME : CPS_JOURNAL_NEW,
 *         &journal, &err);
 *     for (found = resume; found;) {                      the steps that are there already
 *         cps_journal_next(journal, evolution, &found, &err);
 *         if (found) cps_results_append(results, evolution, &err);
 *     }
 *     while (cps_evolution_remaining(evolution) > 0) {    and those that are not
 *         cps_evolution_step(evolution, &err);
 *         cps_journal_append(journal, evolution, &err);
 *         cps_results_append(results, evolution, &err);
 *     }
 *     cps_journal_remove(journal);
 *
 * A journal is of one version and build of the program and of one scene with its settings. */
typedef struct CpsJournal CpsJournal;

typedef enum CpsJournalMode {
    CPS_JOURNAL_NEW = 0, /* an empty one; the steps of an interrupted run are refused, not lost */
    CPS_JOURNAL_RESUME = 1, /* the one that is there, if any */
    CPS_JOURNAL_REPLACE = 2 /* an empty one, in place of an interrupted run's */
} CpsJournalMode;

/* Open the journal of an evolution that has taken no step yet, in an existing directory. A file of
 * that name that is no journal, a link or a device is refused and stays. On return the journal and
 * its name are on the disk. Returns CPS_OK, CPS_ERR_IO, CPS_ERR_MEMORY, or CPS_ERR_ARGUMENT where
 * it is to be resumed and is of another scene, version or build. */
CPS_API CpsStatus cps_journal_open(const char *directory, const CpsEvolution *evolution,
                                   CpsJournalMode mode, CpsJournal **out, CpsError *err);
/* Load the next step into the evolution: *found tells whether there was one. Where no whole record
 * follows, the journal ends. Returns CPS_OK, CPS_ERR_IO, CPS_ERR_MEMORY, or CPS_ERR_ARGUMENT where
 * the record is no state of this evolution. */
CPS_API CpsStatus cps_journal_next(CpsJournal *journal, CpsEvolution *evolution, bool *found,
                                   CpsError *err);
/* Append the step just taken, which follows the last one of the journal; on return it is on the
 * disk. */
CPS_API CpsStatus cps_journal_append(CpsJournal *journal, const CpsEvolution *evolution,
                                     CpsError *err);
/* From now on steps are given to the system and not waited for: a killed run loses none of them, a
 * power cut may take the last ones, which the next run takes again. cps_journal_sync waits for
 * all. */
CPS_API void cps_journal_sync_late(CpsJournal *journal);
CPS_API CpsStatus cps_journal_sync(CpsJournal *journal, CpsError *err);
/* Remove the file, once its run is finished; destroy the journal all the same. */
CPS_API void cps_journal_remove(CpsJournal *journal);
CPS_API void
cps_journal_destroy(CpsJournal *journal); /* NULL is accepted; a journal without steps is removed */

/* A running JSON summary, the object that `capstan run --json` prints. */
CPS_API CpsStatus cps_results_write_summary(const CpsResults *results, double wall, FILE *out,
                                            CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
