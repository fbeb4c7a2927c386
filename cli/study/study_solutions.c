/* SPDX-License-Identifier: BSD-3-Clause */
/* All solutions of a step on the command line (see study_solutions.h). */
#include "study/study_solutions.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "capstan/results.h"
#include "commands.h"
#include "printable.h"

enum { SHOWN_PARTS = 8 };

static int out_of_memory(void) {
    fprintf(stderr, "capstan: out of memory\n");
    return EXIT_LIMIT;
}

double study_find_tolerance(const char *text) {
    if (!text) return 1e-8; /* the accuracy to which a step is certified */
    char *end = NULL;
    const double tolerance = strtod(text, &end);
    if (end != text && *end == '\0' && tolerance > 0 && tolerance < 1) return tolerance;
    cli_printf(stderr,
               "capstan study: --tolerance '%.40s': expected a number above 0 and below 1\n", text);
    return NAN;
}

CpsCompletion study_find_completion(const char *name) {
    CpsCompletion how = CPS_COMPLETION_SHORTEST;
    while (how < CPS_COMPLETION_COUNT && strcmp(name, cps_completion_name(how)) != 0) ++how;
    if (how == CPS_COMPLETION_COUNT)
        cli_printf(
            stderr,
            "capstan study: --complete: found '%.40s', expected shortest, straight or meander\n",
            name);
    return how;
}

/* ---- slack ---- */

static const char *hold_of(const CpsSlackPart *part) {
    if (part->loose) return "loose";
    if (!part->has_friction) return "held by its ends";
    if (part->sliding) return "held by friction, at its bound: may slide on";
    return part->at_bound ? "held by friction, at its bound where nothing slides by itself"
                          : "held by friction";
}

static int print_parts(const CpsLineView *view) {
    CpsSlackPart part[SHOWN_PARTS];
    const int parts = cps_solution_slack(view, SHOWN_PARTS, part);
    printf("\nslack: %s\n", parts == 0 ? "none, the configuration is unique (result 4.4)" : "");
    for (int i = 0; i < parts && i < SHOWN_PARTS; ++i)
        printf("  %10.6g to %10.6g m  %s%s\n", part[i].from, part[i].to, hold_of(&part[i]),
               part[i].grounded ? ", kept on the obstacle by contact" : "");
    if (parts > SHOWN_PARTS) printf("  and %d more\n", parts - SHOWN_PARTS);
    return parts;
}

static void print_judgement(const char *what, const CpsLineView *view, const double *position,
                            double tolerance) {
    CpsError err;
    CpsJudgementReport report;
    if (cps_solution_judge(view, position, tolerance, &report, &err) == CPS_OK)
        printf("  %s: %s\n", what, cps_judgement_text(report.judgement));
}

void study_print_slack(const CpsLineView *view, double tolerance) {
    CpsError err;
    CpsSlackReport slack;
    char what[96];
    print_parts(view);
    print_judgement("as found", view, view->position, tolerance);
    double *position = malloc(3 * ((size_t)view->element_count + 1) * sizeof *position);
    if (position &&
        cps_solution_complete(view, CPS_COMPLETION_MEANDER, position, &slack, &err) == CPS_OK &&
        slack.part_count > 0) {
        snprintf(what, sizeof what, "laid out %s, %.6g m of it",
                 cps_completion_text(CPS_COMPLETION_MEANDER), slack.loose);
        print_judgement(what, view, position, tolerance);
    }
    free(position);
}

/* ---- a configuration from a file ---- */

static int bad_file(const char *path, int line, const char *found, const char *expected) {
    cli_printf(stderr, "capstan: %s:%d: found %s, expected %s\n", path, line, found, expected);
    return EXIT_INPUT;
}

/* Number of columns read from a table with names: those up to z. 0: the line is not a row of
 * names. */
static int named_columns(const char *text) {
    static const char WITH[] = "arc_length,x,y,z", WITHOUT[] = "x,y,z";
    return strncmp(text, WITH, sizeof WITH - 1) == 0         ? 4
           : strncmp(text, WITHOUT, sizeof WITHOUT - 1) == 0 ? 3
                                                             : 0;
}

/* Read the numbers of a row into `value`: `named` of them, whatever follows, or where that is 0 all
 * numbers of the row, at most 4; -1 where there is anything else. */
static int read_row(const char *text, int named, double value[4]) {
    const char *rest;
    const int n = cps_row_read(text, ",", named ? named : 4, value, &rest);
    return n > 0 && (!*rest || (n == named && *rest == ',')) ? n : -1;
}

/* Positions relative to the origin of the step's coordinates. */
static int read_nodes(const CpsLineView *view, const char *path, FILE *file, double *position) {
    static const char EXPECTED[] = "x,y,z or arc_length,x,y,z, finite numbers, one row per node";
    char text[512], found[64];
    double value[4];
    int line = 0, node = 0, columns = 0, named = 0;
    while (fgets(text, sizeof text, file)) {
        if (++line == 1) named = named_columns(text);
        if (!strchr(text, '\n') && !feof(file))
            return bad_file(path, line,
                            strlen(text) + 1 < sizeof text ? "a zero byte"
                                                           : "a row of more than 510 bytes",
                            EXPECTED);
        const int n = read_row(text, named, value);
        if (n < 0 && node == 0 && line <= 2) continue; /* names, units */
        if (n < 3 || (columns > 0 && n != columns))
            return bad_file(path, line, "another row", EXPECTED);
        if (node > view->element_count) break;
        if (n == 4 && !(fabs(value[0] - view->arc_length[node]) <=
                        1e-6 * view->arc_length[view->element_count])) {
            snprintf(found, sizeof found, "arc length %.9g m", value[0]);
            return bad_file(path, line, found, "that of the line's nodes, in order");
        }
        columns = n;
        for (int x = 0; x < 3; ++x)
            position[3 * (size_t)node + (size_t)x] = value[n - 3 + x] - view->origin[x];
        ++node;
    }
    if (ferror(file)) {
        cli_printf(stderr, "capstan: %s: %s\n", path, strerror(errno));
        return EXIT_IO;
    }
    if (node == view->element_count + 1 && feof(file)) return EXIT_OK;
    cli_printf(stderr, "capstan: %s: found %s%d rows of nodes, expected %d\n", path,
               feof(file) ? "" : "more than ", node, view->element_count + 1);
    return EXIT_INPUT;
}

/* A regular file, or NULL with errno, 0 where it is something else: reading a pipe could wait
 * forever. */
static FILE *open_regular(const char *path) {
    const int fd = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY);
    struct stat about = {0};
    if (fd < 0) return NULL;
    if (fstat(fd, &about) == 0 && S_ISREG(about.st_mode)) return fdopen(fd, "r");
    close(fd);
    errno = S_ISDIR(about.st_mode) ? EISDIR : 0;
    return NULL;
}

/* `path` "-": standard input, which may be a pipe. */
static int read_configuration(const CpsLineView *view, const char *path, double *position) {
    if (strcmp(path, "-") == 0) return read_nodes(view, "standard input", stdin, position);
    FILE *file = open_regular(path);
    if (!file) {
        fputs("capstan: ", stderr);
        cli_print_text(stderr, path, INT_MAX, false);
        fprintf(stderr, ": %s\n", errno ? strerror(errno) : "is not a regular file");
        return EXIT_IO;
    }
    const int code = read_nodes(view, path, file, position);
    fclose(file);
    return code;
}

static void print_report(const CpsJudgementReport *r, double tolerance, double length) {
    printf("%s\n\n", cps_judgement_text(r->judgement));
    printf("energy above the minimum  %12.5g J, of which\n", r->energy);
    printf("  tension                 %12.5g J  0 where tensions and their directions are those of "
           "the step\n",
           r->tension);
    printf("  contact                 %12.5g J  0 where what the obstacle pushes stays on it\n",
           r->contact);
    printf("  sliding                 %12.5g J  0 where it slides in the normal cone of the "
           "friction force\n",
           r->sliding);
    printf("inside the obstacle       %12.5g m\nheld ends off              %12.5g m\nlargest 1 - "
           "|x'|          %12.5g\n",
           r->penetration, r->end_error, r->shortening);
    if (r->judgement != CPS_JUDGEMENT_SOLUTION)
        printf("what fails is largest at a = %.6g m\n", r->arc_length);
    printf("tolerance %.3g: sums up to %.3g J, of the scale S = %.5g J; lengths up to %.3g m; 1 - "
           "|x'| up to %.3g, its root\n",
           tolerance, tolerance * r->scale, r->scale, tolerance * length, sqrt(tolerance));
}

int study_judge(const CpsLineView *view, const char *path, double tolerance, bool quiet) {
    CpsError err;
    CpsJudgementReport report;
    double *position = malloc(3 * ((size_t)view->element_count + 1) * sizeof *position);
    if (!position) return out_of_memory();
    int code = read_configuration(view, path, position);
    if (code == EXIT_OK && cps_solution_judge(view, position, tolerance, &report, &err) != CPS_OK)
        code = cli_report(&err);
    else if (code == EXIT_OK) {
        if (!quiet) {
            cli_print_text(stdout, strcmp(path, "-") == 0 ? "standard input" : path, 200, false);
            printf(": ");
            print_report(&report, tolerance, view->arc_length[view->element_count]);
        }
        code = report.judgement == CPS_JUDGEMENT_SOLUTION ? EXIT_OK : EXIT_NOT_CERTIFIED;
    }
    free(position);
    return code;
}

/* ---- completions ---- */

static CpsStatus complete_all(const CpsLineView *view, double *all, CpsCompletedLine *line,
                              CpsSlackReport *slack, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int k = 0; k < CPS_COMPLETION_COUNT && status == CPS_OK; ++k) {
        double *position = all + 3 * (size_t)k * ((size_t)view->element_count + 1);
        status = cps_solution_complete(view, (CpsCompletion)k, position, &slack[k], err);
        line->position[k] = position;
    }
    return status;
}

int study_complete(const CpsLineView *view, CpsCompletion how, double tolerance, const char *title,
                   const char *directory, bool quiet) {
    CpsError err;
    CpsSlackReport slack[CPS_COMPLETION_COUNT];
    CpsJudgementReport report = {0};
    CpsCompletedLine line = {.cookie = cps_completed_line_default().cookie,
                             .title = title,
                             .view = view,
                             .chosen = how};
    double *all =
        malloc(3 * CPS_COMPLETION_COUNT * ((size_t)view->element_count + 1) * sizeof *all);
    if (!all) return out_of_memory();
    CpsStatus status = complete_all(view, all, &line, slack, &err);
    if (status == CPS_OK)
        status = cps_solution_judge(view, line.position[how], tolerance, &report, &err);
    if (status == CPS_OK) status = cps_completed_write(directory, &line, &err);
    if (status == CPS_OK && !quiet) {
        print_parts(view);
        print_judgement("as found", view, view->position, tolerance);
        printf("  laid out %s, %.6g m of it in %d piece%s: %s\n", cps_completion_text(how),
               slack[how].loose, slack[how].part_count, slack[how].part_count == 1 ? "" : "s",
               cps_judgement_text(report.judgement));
        if (slack[how].left > 0)
            printf("  %.6g m keep |x'| < 1, between nodes held closer than their length\n",
                   slack[how].left);
        cli_printf(stdout, "\nresults   %s: completed.csv\npictures  %s: completed.svg\n",
                   directory, directory);
    }
    free(all);
    if (status != CPS_OK) return cli_report(&err);
    return report.judgement == CPS_JUDGEMENT_SOLUTION ? EXIT_OK : EXIT_NOT_CERTIFIED;
}
