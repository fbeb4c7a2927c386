/* SPDX-License-Identifier: BSD-3-Clause */
/* The writers of a run's files: each uses the history so far, or the last step of the evolution. */
#ifndef CAPSTAN_SRC_IO_RESULTS_WRITERS_H
#define CAPSTAN_SRC_IO_RESULTS_WRITERS_H

#include "io/history.h"

/* Beyond so many lines, as of a net, tables and summaries say nothing of each one: result.nc and
 * the files for ParaView do. */
enum { CPSI_LISTED_LINES = 2000 };
static inline int cpsi_listed_lines(const CpsResults *results) {
    return results->line_count <= CPSI_LISTED_LINES ? results->line_count : 0;
}

/* snapshot.c: copy the last step for the pictures if it is among those to be drawn. */
bool cpsi_snapshot_append(CpsResults *results, const CpsEvolution *evolution);
void cpsi_snapshot_free(CpsiSnapshot *snapshot);

/* summary.c, history_csv.c: the rows as JSON and CSV. */
void cpsi_summary_write(const CpsResults *results, double wall, FILE *out);
/* The same with the list of the run's files. */
CpsStatus cpsi_summary_file(const CpsResults *results, double wall, FILE *out, CpsError *err);
void cpsi_history_write(const CpsResults *results, FILE *out);
/* out_table.c: of a history in time, the columns of MoorDyn */
void cpsi_out_table_write(const CpsResults *results, FILE *out);
/* stiffness_csv.c, points_csv.c: of lines, of points and of bodies, of points and of bodies */
void cpsi_stiffness_write(const CpsResults *results, FILE *out);
void cpsi_point_stiffness_write(const CpsResults *results, FILE *out);
void cpsi_body_stiffness_write(const CpsResults *results, FILE *out);
void cpsi_points_write(const CpsResults *results, FILE *out);
void cpsi_bodies_write(const CpsResults *results, FILE *out);

/* run_names.c: whether the run, which is a CpsResults, writes a file of this name if it takes all
 * its steps. Pictures of loops are not among them: what they are called is known at the end. */
bool cpsi_results_writes(const void *results, const char *name);

/* run_names.c: whether a file of this name belongs to the set of a run by any method, so that a run
 * which does not write it removes it. */
bool cpsi_results_replaces(const char *name);

/* journal.c: before a run, refuse a file .journal in the directory that is no journal. Before
 * results of the `other` method, which take the place of the run's, refuse the journal of an
 * interrupted run, or with `force` remove it. */
CpsStatus cpsi_journal_check(const char *directory, bool other, bool force, CpsError *err);

/* netcdf_run.c: result.nc. */
CpsStatus cpsi_netcdf_open(const char *path, const CpsScene *scene, const CpsEvolution *evolution,
                           const CpsResultsOptions *options, CpsiNetcdf **out, CpsError *err);
CpsStatus cpsi_netcdf_append(CpsiNetcdf *netcdf, const CpsEvolution *evolution, CpsError *err);
/* Close and free; accepts NULL. Reports a failure of any earlier write. */
CpsStatus cpsi_netcdf_close(CpsiNetcdf *netcdf, CpsError *err);

/* paraview.c: one step as .vtp, the list of steps as .pvd. */
CpsStatus cpsi_paraview_step(CpsResults *results, const CpsEvolution *evolution, CpsError *err);
CpsStatus cpsi_paraview_list(CpsResults *results, CpsError *err);
/* paraview_points.c: the points and bodies after the last step, if there are any. */
CpsStatus cpsi_paraview_points(CpsResults *results, CpsError *err);
/* paraview_sets.c: the outlines of the sets to which ends are held, if there are any: sets.vtp. */
CpsStatus cpsi_paraview_sets(CpsResults *results, CpsError *err);
/* paraview_obstacles.c: the surfaces of the obstacles, if there are any: obstacles.vtp, and one
 * more file for each step in which an obstacle turns or moves. */
CpsStatus cpsi_paraview_obstacles(CpsResults *results, CpsError *err);
/* Whether an obstacle turns or moves in the step; and the name of the file of that step, or of the
 * start
 * (-1). */
bool cpsi_paraview_obstacles_move(const CpsResults *results, int step);
void cpsi_paraview_obstacles_name(int step, char name[32]);

#endif
