/* SPDX-License-Identifier: BSD-3-Clause */
/* Tables and pictures of configurations side by side: a history by several methods; several
 * completions of slack. */
#include <math.h>

#include "base/status.h"
#include "base/vec3.h"
#include "io/base/directory/file_set.h"
#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/draw/study/methods_picture.h"

enum { MAX_METHODS = 4 };

/* ---- a history by several methods ---- */

static const double *place(const CpsiMethods *m, int method, int step, int point) {
    return m->method[method].position + 3 * ((size_t)step * (size_t)m->points + (size_t)point);
}

static double farthest(const CpsiMethods *m, int method, int step) {
    double most = 0;
    for (int p = 0; p < m->points; ++p) {
        const Vec3 difference =
            vec3_sub(vec3_load(place(m, method, step, p)), vec3_load(place(m, 0, step, p)));
        most = fmax(most, vec3_norm(difference));
    }
    return most;
}

static void methods_table(const void *what, FILE *out) {
    const CpsiMethods *m = what;
    fputs("step,method,B.x,B.y,B.z,farthest_from_first\n,,m,m,m,m\n", out);
    for (int s = 0; s < m->steps; ++s)
        for (int k = 0; k < m->methods; ++k) {
            cpsi_write_csv(out, m->step_name[s]);
            fputc(',', out);
            cpsi_write_csv(out, m->method[k].name);
            for (int x = 0; x < 3; ++x) cpsi_csv_next(out, place(m, k, s, m->points - 1)[x]);
            cpsi_csv_next(out, farthest(m, k, s));
            fputc('\n', out);
        }
}

static void methods_picture(const void *what, FILE *out) { cpsi_picture_methods(what, out); }

CpsStatus cps_methods_write(const char *directory, const char *title, int methods,
                            const CpsMethodHistory *method, int steps, int points,
                            const char *const *step_name, CpsError *err) {
    if (!directory || !title || !method || !step_name)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "directory, title, method or step_name is NULL");
    if (methods < 1 || methods > MAX_METHODS || steps < 1 || points < 2)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "found %d methods, %d steps, %d points; expected 1 to %d, and at least 1 and 2",
            methods, steps, points, (int)MAX_METHODS);
    for (int i = 0; i < methods; ++i)
        if (!method[i].name || !method[i].position)
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "method %d has no name or no positions", i);
    for (int s = 0; s < steps; ++s)
        if (!step_name[s]) return cpsi_fail(err, CPS_ERR_ARGUMENT, "step %d has no name", s);
    const CpsiMethods m = {.title = title,
                           .note = "Plan and elevation (heights stretched), step by step",
                           .methods = methods,
                           .steps = steps,
                           .points = points,
                           .method = method,
                           .step_name = step_name};
    const CpsiFile set[] = {{"methods.csv", methods_table, &m},
                            {"methods.svg", methods_picture, &m}};
    const CpsiFile summary = {"methods.json", cpsi_file_set_title, title};
    return cpsi_file_set_write(directory, set, sizeof set / sizeof *set, &summary, NULL, err);
}

/* ---- slack laid out ---- */

/* nodes of the longest loose part, or all where there is none */
static void find_loose(const CpsLineView *view, int *first, int *last) {
    enum { PARTS = 64 };
    CpsSlackPart part[PARTS];
    const int parts = cps_solution_slack(view, PARTS, part);
    double longest = 0;
    *first = 0;
    *last = view->element_count;
    for (int i = 0; i < parts && i < PARTS; ++i) {
        if (!part[i].loose || !(part[i].to - part[i].from > longest)) continue;
        longest = part[i].to - part[i].from;
        for (int j = 0; j <= view->element_count; ++j) {
            if (view->arc_length[j] <= part[i].from) *first = j;
            if (view->arc_length[j] < part[i].to) *last = j + 1;
        }
    }
}

/* a file of nodes that a scene can start from (docs/formats.md), in the coordinates of the scene:
 * the value of an element is in the row of the node at its end */
static void completed_table(const void *what, FILE *out) {
    const CpsCompletedLine *c = what;
    const CpsLineView *view = c->view;
    fputs("arc_length,x,y,z,tension,reaction\nm,m,m,m,N,N\n", out);
    for (int j = 0; j <= view->element_count; ++j) {
        cpsi_write_csv_number(out, view->arc_length[j]);
        for (int x = 0; x < 3; ++x)
            cpsi_csv_next(out, view->origin[x] + c->position[c->chosen][3 * (size_t)j + (size_t)x]);
        cpsi_csv_next(out, j > 0 ? view->tension[j - 1] : NAN);
        cpsi_csv_next(out, view->reaction[j]);
        fputc('\n', out);
    }
}

/* the computed configuration, and each completion, near the longest loose part */
static void completed_picture(const void *what, FILE *out) {
    const CpsCompletedLine *c = what;
    int first, last;
    find_loose(c->view, &first, &last);
    CpsMethodHistory shape[1 + CPS_COMPLETION_COUNT] = {
        {"as found", c->view->position + 3 * (size_t)first}};
    for (int k = 0; k < CPS_COMPLETION_COUNT; ++k)
        shape[1 + k] = (CpsMethodHistory){cps_completion_name((CpsCompletion)k),
                                          c->position[k] + 3 * (size_t)first};
    char note[160];
    snprintf(note, sizeof note,
             "Slack from %.6g to %.6g m in plan: all have the same tensions and the same energy",
             c->view->arc_length[first], c->view->arc_length[last]);
    const char *const step = "";
    const CpsiMethods m = {.title = c->title,
                           .note = note,
                           .methods = 1 + CPS_COMPLETION_COUNT,
                           .steps = 1,
                           .points = last - first + 1,
                           .method = shape,
                           .step_name = &step,
                           .plan_only = true};
    cpsi_picture_methods(&m, out);
}

/* marks a line that was initialised by its default function */
static const uint32_t LINE_COOKIE = 0x434f4d50;

CpsCompletedLine cps_completed_line_default(void) {
    return (CpsCompletedLine){.cookie = LINE_COOKIE};
}

CpsStatus cps_completed_write(const char *directory, const CpsCompletedLine *line, CpsError *err) {
    if (line && line->cookie != LINE_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the line was not made by cps_completed_line_default()");
    if (!directory || !line || !line->title || !line->view ||
        (unsigned)line->chosen >= CPS_COMPLETION_COUNT)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "directory, line, its title or view is NULL, or none is chosen");
    for (int k = 0; k < CPS_COMPLETION_COUNT; ++k)
        if (!line->position[k]) return cpsi_fail(err, CPS_ERR_ARGUMENT, "position %d is NULL", k);
    const CpsiFile set[] = {{"completed.csv", completed_table, line},
                            {"completed.svg", completed_picture, line}};
    const CpsiFile summary = {"completed.json", cpsi_file_set_title, line->title};
    return cpsi_file_set_write(directory, set, sizeof set / sizeof *set, &summary, NULL, err);
}
