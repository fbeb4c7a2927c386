/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/results.h: write results, studies and pictures (library capstan-io).
 *
 * docs/results.md describes the files. Files appear completely or not at all; a failure leaves
 * those that were there before. Structs that the caller fills need to live during the call only. */
#ifndef CAPSTAN_RESULTS_H
#define CAPSTAN_RESULTS_H

#include <stdio.h>

#include "capstan/evolve.h"
#include "capstan/io.h"
#include "capstan/regularized.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A directory of results: summary.json, history.csv, result.nc, of a scene with points points.csv,
 * one .vtp per step with a .pvd, SVG pictures. */
typedef struct CpsResults CpsResults;

/* What is written of a run. */
typedef struct CpsResultsOptions {
    uint32_t cookie;  /* of cps_results_options_default(): options made otherwise are refused */
    bool no_paraview; /* no .vtp and .pvd files */
    bool stiffness;   /* stiffness.csv: both stiffnesses of all ends after each step */
    bool out_table;   /* history.out: columns of MoorDyn; only of a history with a duration */
    /* files are synced at the end only: a power cut, though not a kill, may lose the whole run, and
     * result.nc cannot be read before the end */
    bool sync_at_end;
    /* arrays that result.nc has for every step: names of docs/results.md without that of the line,
     * separated by commas. "none": numbers only; NULL: all arrays, which the checker needs */
    const char *fields;
} CpsResultsOptions;
CPS_API CpsResultsOptions cps_results_options_default(void); /* without these two tables */

/* Whether the options are valid and name existing fields: CPS_OK or CPS_ERR_ARGUMENT. */
CPS_API CpsStatus cps_results_check_options(const CpsResultsOptions *options, CpsError *err);

/* Open `directory`, made if missing (one level), for the results of `evolution`. Files there remain
 * until cps_results_finish renames each finished one into place. The .capstan there lists what
 * capstan has written: a directory that is not empty and has none is refused, as is one where a
 * directory or an unlisted file has a name of the results; only listed files are replaced or
 * removed. `options` NULL: the default; the caller destroys *out. CPS_OK, CPS_ERR_ARGUMENT (also
 * for an unknown field, or out_table without a step in time), CPS_ERR_IO or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_results_open(const char *directory, const CpsScene *scene,
                                   const CpsEvolution *evolution, const CpsResultsOptions *options,
                                   CpsResults **out, CpsError *err);

/* What is to be written; each by the function of that name. */
typedef enum CpsResultsKind {
    CPS_RESULTS_KIND_RUN = 0,
    CPS_RESULTS_KIND_REGULARIZED = 1, /* line_count lines */
    CPS_RESULTS_KIND_STUDY = 2,
    CPS_RESULTS_KIND_METHODS = 3,
    CPS_RESULTS_KIND_COMPLETED = 4,
    CPS_RESULTS_KIND_OFFSET = 5 /* offset.h */
} CpsResultsKind;

/* Check before a computation whether results can be written to `directory`. Refused are: one that
 * is not empty and that capstan has not written to; unfinished files, .NAME.part, that no killed
 * run has listed in .capstan.run; names of these results (of a run: by cps_results_open) that a
 * directory or an unlisted file has. With `force` files in it with names of results may be replaced
 * from then on, and such .NAME.part are removed. After a refusal it is as before; a missing one is
 * created later. Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_IO or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_results_prepare(const char *directory, CpsResultsKind kind, int line_count,
                                      bool force, CpsError *err);

/* Find out whether the files in `directory` belong to two runs because their replacement was
 * interrupted. Then the summary, which is renamed last, is missing: `missing` is its name, else
 * "". Writing the files once more replaces them all. Returns CPS_OK, also where there is no such
 * directory, CPS_ERR_ARGUMENT for NULL or an empty name, CPS_ERR_IO or CPS_ERR_MEMORY. */
enum { CPS_RESULT_NAME = 256 };
CPS_API CpsStatus cps_results_missing(const char *directory, char missing[CPS_RESULT_NAME],
                                      CpsError *err);

/* Append the last step of all lines. result.nc is synced unless the options say otherwise. */
CPS_API CpsStatus cps_results_append(CpsResults *results, const CpsEvolution *evolution,
                                     CpsError *err);

/* Write what needs the whole history (summary, pictures), close all files and rename them into
 * place. `wall`: [s] time of the whole run, for the summary. On failure temporary files are
 * removed, and the files that were there before remain. Where a file could not be renamed after
 * others were, the message says that the files belong to two runs, and summary.json is missing
 * (cps_results_missing). */
CPS_API CpsStatus cps_results_finish(CpsResults *results, double wall, CpsError *err);

/* Free the handle, also after cps_results_finish; unfinished files are removed. Accepts NULL. */
CPS_API void cps_results_destroy(CpsResults *results);

/* A journal of the steps taken, the file .journal in a directory of results. After a run has been
 * killed, another one continues from it and ends with the same bits.
 *
 *     cps_journal_open(directory, evolution, resume ? CPS_JOURNAL_RESUME : CPS_JOURNAL_NEW,
 *         &journal, &err);
 *     for (found = resume; found;) {                      the steps that are there already
 *         cps_journal_next(journal, evolution, &found, &err);
 *         if (found) cps_results_append(results, evolution, &err);
 *     }
 *     while (cps_evolution_remaining_count(evolution) > 0) {    and those that are not
 *         cps_evolution_step(evolution, &err);
 *         cps_journal_append(journal, evolution, &err);
 *         cps_results_append(results, evolution, &err);
 *     }
 *     cps_journal_remove(journal, &err);
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
/* Load the next step into the evolution; *found says whether there was one. The journal ends where
 * no complete record follows. Returns CPS_OK, CPS_ERR_IO, CPS_ERR_MEMORY, or CPS_ERR_ARGUMENT where
 * the record is no state of this evolution. */
CPS_API CpsStatus cps_journal_next(CpsJournal *journal, CpsEvolution *evolution, bool *found,
                                   CpsError *err);
/* Append the last step of the evolution, which must follow the last one of the journal. On return
 * it is on the disk. */
CPS_API CpsStatus cps_journal_append(CpsJournal *journal, const CpsEvolution *evolution,
                                     CpsError *err);
/* From now on do not wait until steps are on the disk: a killed run loses none of them, but a power
 * cut may lose the last ones, which the next run takes again. cps_journal_sync waits for all. */
CPS_API void cps_journal_sync_late(CpsJournal *journal);
CPS_API CpsStatus cps_journal_sync(CpsJournal *journal, CpsError *err);
/* Remove the file after its run has finished; the journal must still be destroyed. */
CPS_API CpsStatus cps_journal_remove(CpsJournal *journal, CpsError *err);
/* Free the journal; the file of one without steps is removed. Accepts NULL. */
CPS_API void cps_journal_destroy(CpsJournal *journal);

/* Write a summary of the steps so far, the JSON object that `capstan run --json` prints. */
CPS_API CpsStatus cps_results_write_summary(const CpsResults *results, double wall, FILE *out,
                                            CpsError *err);

/* ---- studies of the method of 1990 ---- */

/* The results of a study, written into one directory. */
typedef struct CpsStudyFiles {
    uint32_t cookie;   /* of cps_study_files_default(); files made otherwise are refused */
    const char *title; /* of the pictures */
    const CpsRegularized *regularized;
    const CpsStudy *study;
    const CpsFirstOrder *first_order;
} CpsStudyFiles;
CPS_API CpsStudyFiles cps_study_files_default(void);

/* Write study.csv, study.svg (tensions and errors on the way to the limits), first-order.csv and
 * first-order.svg (P10.1 beside P2.1), relaxed.svg (J and J** of S90 remark 4.6.1), and study.json,
 * the title and the list of the others with sizes and checksums, into `directory`, made if missing
 * (one level). All appear whole and together, or not at all; where they replace others study.json
 * is removed first and comes last (cps_results_missing).
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_IO or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_study_write(const char *directory, const CpsStudyFiles *files, CpsError *err);

/* The configurations of a line by one method, step by step. */
typedef struct CpsMethodHistory {
    const char *name;
    const double *position; /* (steps, points, 3) [m] */
} CpsMethodHistory;

/* Write methods.csv (where end B is after each step, and how far each method is from the first
 * one), methods.svg (plan and elevation of all steps, a column per method) and methods.json (the
 * list) into `directory`, as cps_study_write.
 *
 *   methods    1..4 of them; steps >= 1, points >= 2 are the same for all
 *   step_name  (steps) */
CPS_API CpsStatus cps_methods_write(const char *directory, const char *title, int methods,
                                    const CpsMethodHistory *method, int steps, int points,
                                    const char *const *step_name, CpsError *err);

/* A step with its slack laid out in each of the ways of CpsCompletion (evolve.h). */
typedef struct CpsCompletedLine {
    uint32_t cookie; /* of cps_completed_line_default(); a line made otherwise is refused */
    const char *title;
    const CpsLineView *view;
    const double *position[CPS_COMPLETION_COUNT]; /* (element_count + 1, 3) [m] each */
    CpsCompletion chosen;
} CpsCompletedLine;
CPS_API CpsCompletedLine cps_completed_line_default(void);

/* Write completed.csv (the chosen one, a row per node), completed.svg (the longest loose part in
 * plan: as found, and laid out in each way) and completed.json (the list) into `directory`, as
 * cps_study_write. */
CPS_API CpsStatus cps_completed_write(const char *directory, const CpsCompletedLine *line,
                                      CpsError *err);

/* The history of a line by the regularised method alone. */
typedef struct CpsRegularizedLine {
    const char *name;
    int point_count;
    const double *position; /* (step_count, point_count, 3) [m]; step 0 is the start */
    const CpsRegularizedParameters *parameters; /* (step_count); that of the start is not used */
    /* (step_count) errors refer to the exact step with frozen friction; that of the start is not
     * used */
    const CpsRegularizedReport *report;
} CpsRegularizedLine;

typedef struct CpsRegularizedRun {
    uint32_t cookie; /* of cps_regularized_run_default(); a run made otherwise is refused */
    const char *title;
    int step_count, line_count;
    const char *const *step_name;
    const CpsRegularizedLine *line;
    bool complete; /* no step of the history is missing */
    double wall;   /* [s] */
} CpsRegularizedRun;
CPS_API CpsRegularizedRun cps_regularized_run_default(void);

/* Write history.csv (a row per step and line: parameters, energies, what the parameters leave,
 * ends), summary.json, and line-1.svg, line-2.svg, .. (plan and elevation of all steps of a line)
 * into `directory`, as cps_study_write. There is no certificate: the summary says so. */
CPS_API CpsStatus cps_regularized_write(const char *directory, const CpsRegularizedRun *run,
                                        CpsError *err);

/* summary.json alone, on a stream. */
CPS_API CpsStatus cps_regularized_summary(const CpsRegularizedRun *run, FILE *out, CpsError *err);

/* ---- pictures of laws ---- */

/* The contents of a picture of a law. */
typedef struct CpsLawPicture {
    uint32_t cookie; /* of cps_law_picture_default(); a picture made otherwise is refused */
    const char *title;
    int axis[2]; /* components drawn to the right and up, from 0 */
    int velocity_count;
    const double *velocity; /* (velocity_count x n) drawn with their force sets */
    int force_count;
    const double *force; /* (force_count x n) drawn with their velocities */
} CpsLawPicture;
CPS_API CpsLawPicture cps_law_picture_default(void); /* axes 0 and 1 */

/* Draw a set of forces as SVG: a planar one with the normal cones at its corners; of more
 * dimensions the section through 0 along two axes and, dashed, the shadow on them (alone where the
 * plane misses a set that a load has moved); with each velocity and its set of forces. A set
 * without bounds goes on beyond the frame; of one component it is drawn as the graph of forces over
 * velocity.
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT (also where the set is empty) or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_law_draw(const CpsSet *set, const CpsLawPicture *picture, FILE *out,
                               CpsError *err);

/* Draw a resistance law as SVG: of one component the graph of forces over velocity, of more the
 * forces at five speeds, up to the largest of the velocities asked for, in all directions of the
 * plane of two components. */
CPS_API CpsStatus cps_resistance_draw(const CpsResistance *law, const CpsLawPicture *picture,
                                      FILE *out, CpsError *err);

/* ---- pictures of driven systems ---- */

/* Called repeatedly during a long computation, of which `done` of `all` parts are finished. */
typedef void CpsDriveProgress(void *user, int done, int all);

/* Of a system with two driven components and W from -map_radius to map_radius: the resistance G and
 * gamma as one map, every parameter (the first six) as one more. Each is solved for on a grid. */
CPS_API CpsStatus cps_drive_draw_system(const CpsDriveFile *file, CpsDriveProgress *progress,
                                        void *user, FILE *out, CpsError *err);

/* Of a body: its limit surface seen along two components, with the ellipsoid of equal axes; its
 * outline with pushes, their motions and centres of rotation.
 *
 *   poses  (count, 3) poses along the tow; NULL: none
 *   ends   (count, 2) hitch or rope's end */
CPS_API CpsStatus cps_drive_draw_body(const CpsDriveFile *file, int count, const double *poses,
                                      const double *ends, FILE *out, CpsError *err);

CPS_API CpsStatus cps_drive_draw_planimeter(const CpsDriveFile *file,
                                            const CpsPlanimeterReading *reading, FILE *out,
                                            CpsError *err);

/* Of a rope: its shape with velocities, sliding and resting parts, tension along it; and shapes on
 * its path.
 *
 *   motion  of cps_rope_system
 *   shots   (count, nodes, 2) shapes, the first being the start; NULL: none
 */
CPS_API CpsStatus cps_drive_draw_rope(const CpsDriveFile *file, const CpsMotion *motion, int count,
                                      const double *shots, FILE *out, CpsError *err);

/* Of a block on a spring: its path, or in one component position and force over the moved end.
 *
 *   end, position, force  (count, space) */
CPS_API CpsStatus cps_drive_draw_sweep(const CpsDriveFile *file, int count, const double *end,
                                       const double *position, const double *force, FILE *out,
                                       CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
