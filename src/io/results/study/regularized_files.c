/* SPDX-License-Identifier: BSD-3-Clause */
/* The files of a history by the regularised method alone: table, summary, a picture per line. */
#include <stdlib.h>

#include "base/status.h"
#include "io/base/directory/file_set.h"
#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/draw/study/methods_picture.h"
#include "io/results/writers.h"

/* the text that replaces a certificate */
static const char *const WARRANT =
    "none: a regularised solution is no equilibrium under dry friction; 'left' says by how much, "
    "against the certified step with frozen friction";

#define REPORT(member) CPSI_MEMBER(CpsRegularizedReport, member)

static const CpsiColumn COLUMN[] = {
    {"gradient", "N", REPORT(gradient)},
    {"total", "J", REPORT(total)},
    {"elastic", "J", REPORT(elastic)},
    {"potential", "J", REPORT(potential)},
    {"friction_energy", "J", REPORT(friction_energy)},
    {"bending", "J", REPORT(bending)},
    {"contact", "J", REPORT(contact)},
    {"compression", "N", REPORT(compression)},
    {"shortening", "-", REPORT(shortening)},
    {"penetration", "m", REPORT(penetration)},
    {"creep", "m", REPORT(creep)},
    {"friction_excess", "N", REPORT(friction_excess)},
    {"energy_error", "J", REPORT(energy_error)},
    {"tension_rms_error", "N", REPORT(tension_rms)},
    {"tension_max_error", "N", REPORT(tension_max)},
    {"position_max_error", "m", REPORT(position_max)},
};
/* The summary has those from `compression` on: what the four parameters leave. */
enum { COLUMNS = sizeof COLUMN / sizeof COLUMN[0], FIRST_LEFT = 7 };

static const double *tip(const CpsRegularizedLine *line, int step) {
    return line->position + 3 * ((size_t)(step + 1) * (size_t)line->point_count - 1);
}

/* ---- history.csv ---- */

static void write_row(const CpsRegularizedRun *run, int s, const CpsRegularizedLine *line,
                      FILE *out) {
    const CpsRegularizedParameters *p = &line->parameters[s];
    const CpsRegularizedReport *r = &line->report[s];
    cpsi_write_csv(out, run->step_name[s]);
    fputc(',', out);
    cpsi_write_csv(out, line->name);
    fprintf(out, ",%d,%d", r->converged, r->iteration_count);
    cpsi_csv_next(out, p->penalty);
    cpsi_csv_next(out, p->stiffness);
    cpsi_csv_next(out, p->delta);
    for (int k = 0; k < 2; ++k) cpsi_csv_next(out, r->end_tension[k]);
    for (int x = 0; x < 3; ++x) cpsi_csv_next(out, tip(line, s)[x]);
    cpsi_csv_values(out, COLUMN, COLUMNS, r);
    fputc('\n', out);
}

static void history(const void *what, FILE *out) {
    const CpsRegularizedRun *run = what;
    fputs("step,line,converged,iterations,lambda,1/n,delta,tension_A,tension_B,B.x,B.y,B.z", out);
    cpsi_csv_names(out, COLUMN, COLUMNS, NULL);
    fputs("\n,,,,N/m2,N m2,m,N,N,m,m,m", out);
    cpsi_csv_units(out, COLUMN, COLUMNS);
    fputc('\n', out);
    for (int s = 1; s < run->step_count; ++s)
        for (int i = 0; i < run->line_count; ++i) write_row(run, s, &run->line[i], out);
}

/* ---- summary.json ---- */

static void write_key(FILE *out, const char *key, const char *unit) {
    char text[64];
    const bool bare = unit[0] == '-';
    snprintf(text, sizeof text, "%s%s%s", key, bare ? "" : "_", bare ? "" : unit);
    cpsi_write_json_string(out, text);
    fputs(": ", out);
}

static void write_line(const CpsRegularizedLine *line, int s, FILE *out) {
    const CpsRegularizedParameters *p = &line->parameters[s];
    const CpsRegularizedReport *r = &line->report[s];
    fputs("        ", out);
    cpsi_write_json_string(out, line->name);
    fprintf(
        out,
        ": {\"converged\": %s, \"iterations\": %d,\n          \"parameters\": {\"lambda_N/m2\": ",
        r->converged ? "true" : "false", r->iteration_count);
    cpsi_write_json_number(out, p->penalty);
    fputs(", \"1/n_Nm2\": ", out);
    cpsi_write_json_number(out, p->stiffness);
    fputs(", \"delta_m\": ", out);
    cpsi_write_json_number(out, p->delta);
    fputs("},\n          \"B_m\": ", out);
    for (int x = 0; x < 3; ++x) {
        fputs(x ? ", " : "[", out);
        cpsi_write_json_number(out, tip(line, s)[x]);
    }
    fputs("],\n          \"left\": {", out);
    for (int i = FIRST_LEFT; i < COLUMNS; ++i) {
        fputs(i > FIRST_LEFT ? ", " : "", out);
        write_key(out, COLUMN[i].name, COLUMN[i].unit);
        cpsi_write_json_number(out, cpsi_member(r, COLUMN[i].member));
    }
    fputs("}}", out);
}

static void summary(const void *what, FILE *out) {
    const CpsRegularizedRun *run = what;
    bool converged = true;
    for (int i = 0; i < run->line_count; ++i)
        for (int s = 1; s < run->step_count; ++s) converged &= run->line[i].report[s].converged;
    fputs("{\n  \"capstan\": ", out);
    cpsi_write_json_string(out, cps_version());
    fputs(",\n  \"title\": ", out);
    cpsi_write_json_string(out, run->title);
    fputs(",\n  \"method\": \"regularized\",\n  \"certificate\": ", out);
    cpsi_write_json_string(out, WARRANT);
    fprintf(out, ",\n  \"converged\": %s,\n  \"complete\": %s,\n  \"wall_s\": ",
            converged ? "true" : "false", run->complete ? "true" : "false");
    cpsi_write_json_number(out, run->wall);
    fputs(",\n  \"steps\": [", out);
    for (int s = 1; s < run->step_count; ++s) {
        fputs(s > 1 ? ",\n    {\"name\": " : "\n    {\"name\": ", out);
        cpsi_write_json_string(out, run->step_name[s]);
        fputs(",\n      \"lines\": {\n", out);
        for (int i = 0; i < run->line_count; ++i) {
            if (i) fputs(",\n", out);
            write_line(&run->line[i], s, out);
        }
        fputs("}}", out);
    }
    fputs("]", out);
}

/* ---- pictures ---- */

typedef struct Portrait {
    const CpsRegularizedRun *run;
    int line;
    char name[32];
} Portrait;

static void portrait(const void *what, FILE *out) {
    const Portrait *p = what;
    const CpsRegularizedLine *line = &p->run->line[p->line];
    const CpsMethodHistory history = {line->name, line->position};
    const CpsiMethods m = {
        .title = p->run->title,
        .note = "Regularised, 1990: plan and elevation (heights stretched), step by step",
        .methods = 1,
        .steps = p->run->step_count,
        .points = line->point_count,
        .method = &history,
        .step_name = p->run->step_name};
    cpsi_picture_methods(&m, out);
}

/* ---- the whole set ---- */

/* marks a run that was initialised by its default function */
static const uint32_t RUN_COOKIE = 0x52454755;

CpsRegularizedRun cps_regularized_run_default(void) {
    return (CpsRegularizedRun){.cookie = RUN_COOKIE};
}

static CpsStatus check(const CpsRegularizedRun *run, CpsError *err) {
    if (run && run->cookie != RUN_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the run was not made by cps_regularized_run_default()");
    if (!run || !run->title || !run->step_name || !run->line)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "run, its title, step_name or line is NULL");
    if (run->step_count < 1 || run->line_count < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "found %d steps and %d lines, expected at least 1 and 1", run->step_count,
                         run->line_count);
    for (int i = 0; i < run->line_count; ++i) {
        const CpsRegularizedLine *line = &run->line[i];
        if (!line->name || !line->position || !line->parameters || !line->report ||
            line->point_count < 2)
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "line %d has no name, points or results", i);
    }
    for (int s = 0; s < run->step_count; ++s)
        if (!run->step_name[s]) return cpsi_fail(err, CPS_ERR_ARGUMENT, "step %d has no name", s);
    return CPS_OK;
}

CpsStatus cps_regularized_summary(const CpsRegularizedRun *run, FILE *out, CpsError *err) {
    const CpsStatus status = check(run, err);
    if (status != CPS_OK) return status;
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL");
    const CpsiFile file = {"summary.json", summary, run};
    return cpsi_file_set_write_member(&file, out, err);
}

CpsStatus cps_regularized_write(const char *directory, const CpsRegularizedRun *run,
                                CpsError *err) {
    CpsStatus status = check(run, err);
    if (status != CPS_OK) return status;
    if (!directory) return cpsi_fail(err, CPS_ERR_ARGUMENT, "directory is NULL");
    CpsiFile *set = calloc((size_t)run->line_count + 1, sizeof *set);
    Portrait *portraits = calloc((size_t)run->line_count, sizeof *portraits);
    if (set && portraits) {
        set[0] = (CpsiFile){"history.csv", history, run};
        for (int i = 0; i < run->line_count; ++i) {
            portraits[i] = (Portrait){.run = run, .line = i};
            snprintf(portraits[i].name, sizeof portraits[i].name, "line-%d.svg", i + 1);
            set[1 + i] = (CpsiFile){portraits[i].name, portrait, &portraits[i]};
        }
        const CpsiFile last = {"summary.json", summary, run};
        status = cpsi_file_set_write(directory, set, run->line_count + 1, &last,
                                     cpsi_results_replaces, err);
    } else {
        status = cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    }
    free(set);
    free(portraits);
    return status;
}
