/* SPDX-License-Identifier: BSD-3-Clause */
/* A directory of results: open, append each step, finish. The writers are beside this file, the
 * pictures in ../draw; this file owns the memory, and determines the order of the files and what
 * happens when one of them fails. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "base/vec3.h"
#include "io/draw/run/run_picture.h"
#include "io/results/fields.h"
#include "io/results/writers.h"

/* [-] Times are sums of the lengths of steps. */
static const double PASSED = 1e-9;

static CpsStatus fail_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while keeping the history of the results");
}

static char *copy_text(const char *text) { return strdup(text ? text : ""); }

/* stages in terms of steps; a static start is a step before the first stage */
static bool copy_stages(CpsResults *results, const CpsScene *scene) {
    if (scene->stage_count == 0) return true;
    results->stage = calloc((size_t)scene->stage_count, sizeof *results->stage);
    if (!results->stage) return false;
    int64_t first = results->planned_steps;
    double time = 0;
    for (int i = 0; i < scene->stage_count; ++i) first -= scene->stage[i].step_count;
    for (int i = 0; i < scene->stage_count; ++i) {
        CpsiStage *stage = &results->stage[results->stage_count++];
        stage->name = copy_text(scene->stage[i].name);
        stage->first = (int)first;
        first += scene->stage[i].step_count;
        stage->last = (int)first - 1;
        stage->end = time += scene->stage[i].duration;
        stage->has_pace = scene->stage[i].error > 0;
        results->has_pace = results->has_pace || stage->has_pace;
        if (!stage->name) return false;
        for (int k = 0; k < scene->stage[i].turn_count; ++k)
            stage->moves = stage->moves || scene->stage[i].turn[k].angle != 0;
        for (int k = 0; k < scene->stage[i].shift_count; ++k)
            for (int a = 0; a < 3; ++a)
                stage->moves = stage->moves || scene->stage[i].shift[k].by[a] != 0 ||
                               scene->stage[i].shift[k].turn[a] != 0;
    }
    return true;
}

static bool copy_obstacles(CpsResults *results, const CpsScene *scene) {
    if (scene->obstacle_count == 0) return true;
    results->obstacle = calloc((size_t)scene->obstacle_count, sizeof *results->obstacle);
    if (!results->obstacle) return false;
    for (int k = 0; k < scene->obstacle_count; ++k) {
        results->obstacle[k] = scene->obstacle[k];
        results->obstacle[k].name = copy_text(scene->obstacle[k].name);
        results->obstacle[k].friction_set = NULL;
        results->obstacle[k].ground = NULL;
        if (scene->obstacle[k].kind == CPS_OBSTACLE_GROUND)
            results->obstacle[k].ground = cps_ground_retain(scene->obstacle[k].ground);
        results->obstacle[k].mesh = NULL;
        if (scene->obstacle[k].kind == CPS_OBSTACLE_MESH)
            results->obstacle[k].mesh = cps_mesh_retain(scene->obstacle[k].mesh);
        results->obstacle_count = k + 1;
        if (!results->obstacle[k].name) return false;
        for (int a = 0; a < 3; ++a) results->obstacle[k].point[a] -= results->origin[a];
    }
    return true;
}

static bool copy_points(CpsResults *results, const CpsScene *scene) {
    if (scene->point_count == 0) return true;
    results->point = calloc((size_t)scene->point_count, sizeof *results->point);
    if (!results->point) return false;
    for (int i = 0; i < scene->point_count; ++i) {
        results->point[i] = scene->point[i];
        results->point[i].name = copy_text(scene->point[i].name);
        results->point_count = i + 1;
        if (!results->point[i].name) return false;
    }
    return true;
}

static bool copy_bodies(CpsResults *results, const CpsScene *scene) {
    if (scene->body_count == 0) return true;
    results->body = calloc((size_t)scene->body_count, sizeof *results->body);
    if (!results->body) return false;
    for (int i = 0; i < scene->body_count; ++i) {
        results->body[i] = scene->body[i];
        results->body[i].name = copy_text(scene->body[i].name);
        results->body_count = i + 1;
        if (!results->body[i].name) return false;
    }
    return true;
}

/* The point of an end of a line of the scene. */
static int point_of(const CpsLine *line, int end) {
    return line->end[end].kind == CPS_END_KIND_POINT ? line->end_point[end] : CPSI_AT_NO_POINT;
}

/* The set of an end, or of a point where no end before it is, `seen` otherwise; the caller releases
 * it. */
static CpsConstraint set_at(const CpsScene *scene, const double origin[3], int line, int end,
                            bool *seen) {
    const int point = point_of(&scene->line[line], end);
    CpsConstraint on = scene->line[line].constraint[end];
    if (point != CPSI_AT_NO_POINT) {
        if (!seen[point]) on = scene->point[point].constraint;
        seen[point] = true;
    }
    for (int a = 0; a < 3; ++a) on.point[a] -= origin[a];
    on.set = on.kind == CPS_CONSTRAINT_KIND_SET ? cps_set_retain(on.set) : NULL;
    return on;
}

/* The sets of ends and points, each where it is first met. */
static bool copy_sets(CpsResults *results, const CpsScene *scene, size_t lines) {
    bool *seen = calloc((size_t)scene->point_count + 1, sizeof *seen);
    if (!seen) return false;
    for (size_t i = 0; i < lines; ++i)
        for (int e = 0; e < 2; ++e)
            results->line_constraint[i][e] = set_at(scene, results->origin, (int)i, e, seen);
    free(seen);
    return true;
}

static bool copy_scene(CpsResults *results, const CpsScene *scene, const CpsEvolution *evolution) {
    results->planned_steps = cps_evolution_step_count(evolution);
    results->lets_go = cpsi_lets_go(scene);
    results->in_time = cpsi_has_duration(scene);
    for (int i = 0; i < scene->line_count; ++i) {
        results->has_sets = results->has_sets || cpsi_has_set(&scene->line[i]);
        results->winds = results->winds || cpsi_has_winch(&scene->line[i]);
        results->has_loads = results->has_loads || scene->line[i].loads;
    }
    results->draws_sets = results->has_sets || cpsi_has_point_set(scene);
    results->title = copy_text(scene->title);
    memcpy(results->gravity, scene->gravity, sizeof results->gravity);
    results->has_water_surface = scene->has_water_surface;
    memcpy(results->origin, cps_evolution_line_view(evolution, 0).origin, sizeof results->origin);
    results->water_surface = scene->water_surface - results->origin[2];
    const size_t lines = (size_t)cps_evolution_line_count(evolution);
    results->line_name = calloc(lines, sizeof *results->line_name);
    results->line_length = calloc(lines, sizeof *results->line_length);
    results->line_elements = calloc(lines, sizeof *results->line_elements);
    results->line_point = calloc(lines, sizeof *results->line_point);
    results->line_constraint = calloc(lines, sizeof *results->line_constraint);
    if (!results->title || !results->line_name || !results->line_length ||
        !results->line_elements || !results->line_point || !results->line_constraint)
        return false;
    if (!copy_obstacles(results, scene) || !copy_points(results, scene) ||
        !copy_bodies(results, scene))
        return false;
    for (size_t i = 0; i < lines; ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, (int)i);
        results->line_length[i] = view.arc_length[view.element_count];
        results->line_elements[i] = view.element_count;
        results->line_name[i] = copy_text(view.name);
        for (int e = 0; e < 2; ++e) results->line_point[i][e] = point_of(&scene->line[i], e);
        results->begins_static |= scene->line[i].start.kind == CPS_START_STATIC;
        results->line_count = (int)i + 1;
        if (!results->line_name[i]) return false;
    }
    return copy_sets(results, scene, lines) && copy_stages(results, scene);
}

static CpsStatus open_files(CpsResults *results, const char *directory, const CpsScene *scene,
                            const CpsEvolution *evolution, const CpsResultsOptions *options,
                            CpsError *err) {
    CpsStatus status = cpsi_directory_open(directory, &results->directory, err);
    if (status) return status;
    status = cpsi_directory_check(results->directory, cpsi_results_writes, results, err);
    if (status) return status;
    if (options->sync_at_end) cpsi_directory_sync_late(results->directory);
    char *path = NULL;
    status = cpsi_directory_reserve(results->directory, "result.nc", &path, err);
    if (!status) status = cpsi_netcdf_open(path, scene, evolution, options, &results->netcdf, err);
    free(path);
    return status;
}

CpsStatus cps_results_missing(const char *directory, char missing[CPS_RESULT_NAME], CpsError *err) {
    if (missing) missing[0] = '\0';
    if (!directory || !*directory || !missing)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "directory and missing are both needed");
    return cpsi_directory_missing(directory, missing, err);
}

/* marks options that were initialised by their default function */
static const uint32_t OPTIONS_COOKIE = 0x5245534c;

CpsResultsOptions cps_results_options_default(void) {
    return (CpsResultsOptions){.cookie = OPTIONS_COOKIE};
}

CpsStatus cps_results_check_options(const CpsResultsOptions *options, CpsError *err) {
    unsigned wanted;
    if (!options) return CPS_OK;
    if (options->cookie != OPTIONS_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the options were not made by cps_results_options_default()");
    return cpsi_fields_choose(options->fields, &wanted, err);
}

CpsStatus cps_results_open(const char *directory, const CpsScene *scene,
                           const CpsEvolution *evolution, const CpsResultsOptions *options,
                           CpsResults **out, CpsError *err) {
    const CpsResultsOptions all = cps_results_options_default();
    if (!options) options = &all;
    if (!out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "out is NULL; give the address of a CpsResults pointer");
    *out = NULL;
    if (!directory || !*directory || !scene || !evolution)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "directory, scene and evolution are all needed to open results");
    CpsStatus status = cps_results_check_options(options, err);
    if (status) return status;
    if (options->out_table && !cpsi_has_duration(scene))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "history.out is a table over time, but no step of the history has a "
                         "duration: give an entry of the history one, or take history.csv");
    CpsResults *results = calloc(1, sizeof *results);
    if (!results) return fail_memory(err);
    results->paraview = !options->no_paraview;
    results->stiffness = options->stiffness;
    results->out_table = options->out_table;
    results->locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!results->locale || !copy_scene(results, scene, evolution)) status = fail_memory(err);
    if (!status) status = open_files(results, directory, scene, evolution, options, err);
    if (status) {
        cps_results_destroy(results);
        return status;
    }
    *out = results;
    return CPS_OK;
}

/* Largest reaction of an obstacle on a node that does not touch it [N], which complementarity
 * excludes. For a held end the support takes the force; its reaction is only a part of that and is
 * left out. */
static double open_reaction(const CpsLineView *view, const CpsWinchReport winch[2]) {
    const double touch = CPS_TOUCH * view->arc_length[view->element_count];
    double worst = 0;
    const int a = winch[CPS_END_A].is_there ? winch[CPS_END_A].node : 0,
              b = winch[CPS_END_B].is_there ? winch[CPS_END_B].node : view->element_count;
    const int first = a + (view->end[CPS_END_A].kind == CPS_END_KIND_HELD);
    const int last = b - (view->end[CPS_END_B].kind == CPS_END_KIND_HELD);
    for (int j = first; j <= last; ++j) {
        const Vec3 moved = vec3_sub(vec3_load(view->position + 3 * (size_t)j),
                                    vec3_load(view->reference + 3 * (size_t)j));
        for (int i = 0; i < view->contact_count; ++i) {
            const size_t c = (size_t)j + (size_t)i * ((size_t)view->element_count + 1);
            const double distance = vec3_dot(vec3_load(view->normal + 3 * c), moved) + view->gap[c];
            /* written so that a NaN is kept */
            if (!(distance <= touch) && !(view->reaction[c] <= worst)) worst = view->reaction[c];
        }
    }
    return worst;
}

static void free_row(CpsiRow *row) {
    free(row->name);
    free(row->line);
    free(row->point);
    free(row->body);
    free(row->place);
    free(row->stiffness);
    free(row->point_stiffness);
}

/* Both stiffnesses of both ends of line i. */
static void find_stiffness(const CpsEvolution *evolution, int i, CpsStiffness found[2][2]) {
    for (int end = 0; end < 2; ++end)
        for (int kind = 0; kind < 2; ++kind)
            cps_evolution_stiffness(evolution, i, end, (CpsStiffnessKind)kind, &found[end][kind],
                                    NULL);
}

/* Whether the position of an end of a line is imposed: its own, or that of its point, or of the
 * body with that. */
static bool is_held(const CpsResults *results, const CpsiRow *row, const CpsLineView *view, int l,
                    int e) {
    const int point = cpsi_results_point_of(results, row, l, e);
    if (point == CPSI_AT_NO_POINT) return view->end[e].kind == CPS_END_KIND_HELD;
    if (row->point[point].report.state != CPS_POINT_STATE_ON_BODY)
        return row->point[point].report.state == CPS_POINT_STATE_HELD;
    return row->body[results->point[point].body].report.kind == CPS_BODY_KIND_HELD;
}

/* Memory of what was asked for of stiffness. */
static bool reserve_stiffness(const CpsResults *results, CpsiRow *row) {
    if (!results->stiffness) return true;
    row->stiffness = calloc((size_t)results->line_count, sizeof *row->stiffness);
    if (results->point_count > 0)
        row->point_stiffness = calloc((size_t)results->point_count, sizeof *row->point_stiffness);
    return row->stiffness && (row->point_stiffness || results->point_count == 0);
}

/* Memory of a row beside its lines. */
static bool reserve_points(const CpsResults *results, CpsiRow *row) {
    if (results->point_count > 0)
        row->point = calloc((size_t)results->point_count, sizeof *row->point);
    if (results->body_count > 0) row->body = calloc((size_t)results->body_count, sizeof *row->body);
    if (results->obstacle_count > 0)
        row->place = calloc((size_t)results->obstacle_count, sizeof *row->place);
    return (row->point || results->point_count == 0) && (row->body || results->body_count == 0) &&
           (row->place || results->obstacle_count == 0);
}

/* The last row is a break, of which the stages know nothing: it belongs to the one under way, or to
 * the one that has just ended, and those to come begin later. */
static void insert_break(CpsResults *results) {
    const int row = results->row_count - 1;
    results->planned_steps++;
    for (int i = 0; i < results->stage_count; ++i) {
        CpsiStage *stage = &results->stage[i];
        if (stage->first >= row) stage->first++;
        if (stage->last >= row - 1) stage->last++;
    }
}

/* The last row is a step of a stage with a pace that goes on: it has one more step at least. */
static void extend_stage(CpsResults *results, const CpsEvolution *evolution) {
    const int row = results->row_count - 1;
    const double time = results->row[row].motion.time;
    bool longer = false;
    for (int i = 0; i < results->stage_count; ++i) {
        CpsiStage *stage = &results->stage[i];
        if (longer) stage->first++;
        longer = longer || (stage->has_pace && stage->last == row &&
                            time < stage->end * (1 - PASSED) && row >= stage->first);
        if (longer) stage->last++;
    }
    if (results->has_pace) results->planned_steps = cps_evolution_step_count(evolution);
}

static bool append_row(CpsResults *results, const CpsEvolution *evolution) {
    if (results->row_count == results->row_capacity) {
        const size_t capacity = results->row_capacity ? 2 * (size_t)results->row_capacity : 64;
        CpsiRow *grown = realloc(results->row, capacity * sizeof *grown);
        if (!grown) return false;
        results->row = grown;
        results->row_capacity = (int)capacity;
    }
    CpsiRow row = {.report = cps_evolution_report(evolution),
                   .parted = cps_evolution_break(evolution),
                   .motion = cpsi_motion_row(evolution)};
    row.name = copy_text(row.report.name);
    row.report.name = row.name;
    row.line = calloc((size_t)results->line_count, sizeof *row.line);
    if (!reserve_points(results, &row) || !reserve_stiffness(results, &row) || !row.name ||
        !row.line) {
        free_row(&row);
        return false;
    }
    for (int i = 0; i < results->point_count; ++i)
        row.point[i] = (CpsiPointRow){cps_evolution_point_report(evolution, i),
                                      cps_evolution_point_motion(evolution, i)};
    for (int i = 0; i < results->point_count && row.point_stiffness; ++i)
        for (int kind = 0; kind < 2; ++kind)
            cps_evolution_point_stiffness(evolution, i, (CpsStiffnessKind)kind,
                                          &row.point_stiffness[i][kind], NULL);
    for (int i = 0; i < results->body_count; ++i)
        cpsi_body_row(evolution, i, results->stiffness, &row.body[i]);
    cpsi_obstacle_rows(results, evolution, row.place);
    for (int i = 0; i < results->line_count; ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        CpsiLineRow *line = &row.line[i];
        line->report = cps_evolution_line_report(evolution, i);
        line->failure = cps_evolution_line_failure(evolution, i);
        line->failure.break_at = NULL;
        for (int e = 0; e < 2; ++e) line->winch[e] = cps_evolution_winch_report(evolution, i, e);
        for (int e = 0; e < 2; ++e)
            line->constraint[e] = cps_evolution_constraint_report(evolution, i, e);
        line->open_reaction = open_reaction(&view, line->winch);
        for (int e = 0; e < 2; ++e) line->held[e] = is_held(results, &row, &view, i, e);
        if (!(line->open_reaction <= row.open_reaction)) row.open_reaction = line->open_reaction;
        if (row.stiffness) find_stiffness(evolution, i, row.stiffness[i]);
    }
    results->row[results->row_count++] = row;
    if (row.parted.is_break) insert_break(results);
    extend_stage(results, evolution);
    return true;
}

static CpsStatus append(CpsResults *results, const CpsEvolution *evolution, CpsError *err) {
    if (!append_row(results, evolution) || !cpsi_snapshot_append(results, evolution))
        return fail_memory(err);
    const CpsStatus status = cpsi_netcdf_append(results->netcdf, evolution, err);
    if (status || !results->paraview) return status;
    const CpsStatus written = cpsi_paraview_step(results, evolution, err);
    return written ? written : cpsi_paraview_points(results, err);
}

/* Whether lines, points and bodies are those for which the results were opened. */
static bool has_these_lines(const CpsResults *results, const CpsEvolution *evolution) {
    if (cps_evolution_line_count(evolution) != results->line_count) return false;
    if (cps_evolution_point_count(evolution) != results->point_count) return false;
    if (cps_evolution_body_count(evolution) != results->body_count) return false;
    for (int i = 0; i < results->line_count; ++i)
        if (cps_evolution_line_view(evolution, i).element_count != results->line_elements[i])
            return false;
    return true;
}

static bool has_let_go(const CpsEvolution *evolution) {
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i) {
        const CpsLineFailure failure = cps_evolution_line_failure(evolution, i);
        for (int end = 0; end < 2; ++end)
            if (failure.release[end] != CPS_RELEASE_NONE) return true;
    }
    return false;
}

static CpsStatus refuse_failed(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "these results have failed or are finished; destroy them and open new ones");
}

CpsStatus cps_results_append(CpsResults *results, const CpsEvolution *evolution, CpsError *err) {
    if (!results || !evolution)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "results and evolution are both needed");
    if (results->failed) return refuse_failed(err);
    if (!has_these_lines(results, evolution))
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "the evolution has other lines, points or bodies than the one that these results were "
            "opened for");
    if (!results->lets_go && has_let_go(evolution))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "an end of a line was let go, but these results were opened for a scene "
                         "in which none can be: give a line a break_at, however large");
    const CpsStepReport report = cps_evolution_report(evolution);
    if (report.step_count != results->row_count + 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "step %d follows step %d of the results; append every step once",
                         report.step_count - 1, results->row_count - 1);
    const locale_t before = uselocale(results->locale);
    const CpsStatus status = append(results, evolution, err);
    uselocale(before);
    results->failed = status != CPS_OK;
    return status;
}

/* one text file of the directory, written by a function */
static CpsStatus write_table(CpsResults *results, const char *name,
                             void (*write)(const CpsResults *results, FILE *out), CpsError *err) {
    FILE *out = NULL;
    const CpsStatus status = cpsi_directory_create(results->directory, name, &out, err);
    if (status) return status;
    write(results, out);
    return cpsi_directory_close_file(results->directory, out, err);
}

static CpsStatus write_summary(CpsResults *results, double wall, CpsError *err) {
    FILE *out = NULL;
    const CpsStatus status = cpsi_directory_create(results->directory, "summary.json", &out, err);
    if (status) return status;
    const CpsStatus listed = cpsi_summary_file(results, wall, out, err);
    const CpsStatus closed =
        cpsi_directory_close_file(results->directory, out, listed ? NULL : err);
    return listed ? listed : closed;
}

static CpsStatus finish(CpsResults *results, double wall, CpsError *err) {
    CpsiNetcdf *netcdf = results->netcdf;
    results->netcdf = NULL;
    CpsStatus status = cpsi_netcdf_close(netcdf, err);
    if (!status) status = cpsi_directory_sync(results->directory, "result.nc", err);
    if (!status && results->paraview) status = cpsi_paraview_list(results, err);
    if (!status && results->paraview) status = cpsi_paraview_obstacles(results, err);
    if (!status && results->paraview) status = cpsi_paraview_sets(results, err);
    if (!status) status = cpsi_pictures_write(results, err);
    if (!status) status = write_table(results, "history.csv", cpsi_history_write, err);
    if (!status && results->out_table)
        status = write_table(results, "history.out", cpsi_out_table_write, err);
    if (!status && results->point_count > 0)
        status = write_table(results, "points.csv", cpsi_points_write, err);
    if (!status && results->body_count > 0)
        status = write_table(results, "bodies.csv", cpsi_bodies_write, err);
    if (!status && results->stiffness)
        status = write_table(results, "stiffness.csv", cpsi_stiffness_write, err);
    if (!status && results->stiffness && results->point_count > 0)
        status = write_table(results, "point-stiffness.csv", cpsi_point_stiffness_write, err);
    if (!status && results->stiffness && results->body_count > 0)
        status = write_table(results, "body-stiffness.csv", cpsi_body_stiffness_write, err);
    /* last: when there is a new summary, all files that it lists are in place */
    if (!status) status = write_summary(results, wall, err);
    return status ? status : cpsi_directory_commit(results->directory, cpsi_results_replaces, err);
}

CpsStatus cps_results_finish(CpsResults *results, double wall, CpsError *err) {
    if (!results) return cpsi_fail(err, CPS_ERR_ARGUMENT, "results is NULL; open them first");
    if (results->failed) return refuse_failed(err);
    const locale_t before = uselocale(results->locale);
    const CpsStatus status = finish(results, wall, err);
    uselocale(before);
    results->failed = true; /* nothing can be added to finished results */
    cpsi_directory_destroy(results->directory);
    results->directory = NULL;
    return status;
}

CpsStatus cps_results_write_summary(const CpsResults *results, double wall, FILE *out,
                                    CpsError *err) {
    if (!results || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "results and out are both needed");
    const locale_t before = uselocale(results->locale);
    errno = 0;
    cpsi_summary_write(results, wall, out);
    uselocale(before);
    if (fflush(out) != 0 || ferror(out))
        return cpsi_fail(err, CPS_ERR_IO, "cannot write the summary: %s",
                         strerror(errno ? errno : EIO));
    return CPS_OK;
}

void cps_results_destroy(CpsResults *results) {
    if (!results) return;
    cpsi_netcdf_close(results->netcdf, NULL);
    cpsi_directory_destroy(results->directory);
    for (int i = 0; i < results->row_count; ++i) free_row(&results->row[i]);
    for (int i = 0; i < results->snapshot_count; ++i) cpsi_snapshot_free(&results->snapshot[i]);
    for (int i = 0; i < results->stage_count; ++i) free(results->stage[i].name);
    for (int i = 0; i < results->line_count; ++i) free(results->line_name[i]);
    for (int i = 0; i < results->obstacle_count; ++i) {
        free((char *)results->obstacle[i].name);
        cps_ground_release((CpsGround *)results->obstacle[i].ground);
        cps_mesh_release((CpsMesh *)results->obstacle[i].mesh);
    }
    for (int i = 0; i < results->point_count; ++i) free((char *)results->point[i].name);
    for (int i = 0; i < results->body_count; ++i) free((char *)results->body[i].name);
    free(results->row);
    free(results->snapshot);
    free(results->stage);
    free(results->line_name);
    free(results->line_length);
    free(results->line_elements);
    free(results->line_point);
    for (int i = 0; i < results->line_count; ++i)
        for (int e = 0; e < 2; ++e) cps_set_release((CpsSet *)results->line_constraint[i][e].set);
    free(results->line_constraint);
    free(results->point);
    free(results->body);
    free(results->obstacle);
    free(results->title);
    if (results->locale) freelocale(results->locale);
    free(results);
}
