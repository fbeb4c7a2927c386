/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/results.h: write results, studies and pictures.
 *     (library capstan-io; docs/results.md) */
#ifndef CAPSTAN_RESULTS_H
#define CAPSTAN_RESULTS_H

#include <stdio.h>

#include "capstan/evolve.h"
#include "capstan/io.h"
#include "capstan/regularized.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- results of a run ---- */

/* A directory of results: summary.json, history.csv, result.nc, one .vtp per step with a .pvd, SVG
 * pictures. */
typedef struct CpsResults CpsResults;

/* What is written of a run. */
typedef struct CpsResultsOptions {
    uint32_t cookie;  /* of cps_results_options_default(): options made otherwise are refused */
    bool no_paraview; /* no .vtp and .pvd files */
    bool sync_at_end; /* files are synced at the end alone: what a power cut, not a kill, may take
                         in between is the whole run's; result.nc cannot be read before */
    /* of result.nc, per step: names of docs/results.md without the line's, separated by commas;
     * "none": numbers alone; NULL: all, which is what the checker needs */
    const char *fields;
} CpsResultsOptions;
CPS_API CpsResultsOptions cps_results_options_default(void); /* everything */

/* Are there such fields?  Returns CPS_OK or CPS_ERR_ARGUMENT. */
CPS_API CpsStatus cps_results_check_options(const CpsResultsOptions *options, CpsError *err);

/* Open `directory` (made if missing; one level) for the results of `evolution`. Nothing that was
 * there is touched until cps_results_finish, which renames each finished file into place. The file
 * .capstan in it lists what capstan has written there: a directory that is not empty and has none
 * is refused, and only listed files are ever replaced or removed.
 *
 *   options  NULL: everything
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT (also for a field that there is not), CPS_ERR_IO or
 * CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_results_open(const char *directory, const CpsScene *scene,
                                   const CpsEvolution *evolution, const CpsResultsOptions *options,
                                   CpsResults **out, CpsError *err);

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
 *     while (cps_evolution_remaining_count(evolution) > 0) {    and those that are not
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

/* ---- studies of the method of 1990 ---- */

/* What belongs together in one directory. */
typedef struct CpsStudyFiles {
    const char *title; /* of the pictures */
    const CpsRegularized *classic;
    const CpsStudy *study;
    const CpsFirstOrder *first_order;
} CpsStudyFiles;

/* Write study.csv, study.svg (tensions and errors on the way to the limits), first-order.csv and
 * first-order.svg (P10.1 beside P2.1), relaxed.svg (J and J** of S90 remark 4.6.1), and study.json,
 * the title and the list of the others with sizes and checksums, into `directory`, made if missing
 * (one level). All appear whole and together, or not at all; where they replace others study.json
 * is removed first and comes last (cps_results_missing).
 *
 * Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_IO or CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_study_write(const char *directory, const CpsStudyFiles *files, CpsError *err);

/* Configurations that a method has gone through. */
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

/* A step with its slack laid out in every way (evolve.h). */
typedef struct CpsCompletedLine {
    const char *title;
    const CpsLineView *view;
    const double *position[CPS_COMPLETION_COUNT]; /* (element_count + 1, 3) [m] each */
    CpsCompletion chosen;
} CpsCompletedLine;

/* Write completed.csv (the chosen one, a row per node), completed.svg (the longest loose part in
 * plan: as found, and laid out in each way) and completed.json (the list) into `directory`, as
 * cps_study_write. */
CPS_API CpsStatus cps_completed_write(const char *directory, const CpsCompletedLine *line,
                                      CpsError *err);

/* A history of the regularised method by itself. */
typedef struct CpsRegularizedLine {
    const char *name;
    int point_count;
    const double *position; /* (step_count, point_count, 3) [m]; step 0 is the start */
    const CpsRegularizedParameters *parameters; /* (step_count); of the start: not used, as below */
    /* (step_count) errors are against the exact step with frozen friction */
    const CpsRegularizedReport *report;
} CpsRegularizedLine;

typedef struct CpsRegularizedRun {
    const char *title;
    int step_count, line_count;
    const char *const *step_name;
    const CpsRegularizedLine *line;
    bool complete; /* no step of the history is missing */
    double wall;   /* [s] */
} CpsRegularizedRun;

/* Write history.csv (a row per step and line: parameters, energies, what the parameters leave,
 * ends), summary.json, and line-1.svg, line-2.svg, .. (plan and elevation of all steps of a line)
 * into `directory`, as cps_study_write. There is no certificate: the summary says so. */
CPS_API CpsStatus cps_regularized_write(const char *directory, const CpsRegularizedRun *run,
                                        CpsError *err);

/* summary.json alone, on a stream. */
CPS_API CpsStatus cps_regularized_summary(const CpsRegularizedRun *run, FILE *out, CpsError *err);

/* ---- pictures of laws ---- */

/* What a picture shows. */
typedef struct CpsLawPicture {
    const char *title;
    int axis[2]; /* components drawn to the right and up, from 0 */
    int velocity_count;
    const double *velocity; /* (velocity_count x n) drawn with their force sets */
    int force_count;
    const double *force; /* (force_count x n) drawn with their velocities */
} CpsLawPicture;

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

/* Called between parts of long work. */
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
