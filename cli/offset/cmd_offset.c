/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan offset: what the lines of a body oppose to an offset, heading by heading, there and back,
 * from where the history of its scene has left it; and where it is with each line missing. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/io.h"
#include "capstan/results.h"
#include "commands.h"
#include "destination.h"
#include "offset/offset_run.h"
#include "offset/without_line.h"
#include "options.h"
#include "printable.h"
#include "progress.h"
#include "signals.h"

enum { MAX_CURVES = 72, MAX_STEPS = 1000, DEFAULT_STEPS = 10, NAME_WIDTH = 16 };
/* Without --to the largest offset is this share of the longest line: a choice, not a limit. */
static const double DEFAULT_SHARE = 0.01;

static const char *const DEFAULT_HEADINGS = "0,45,90,135,180,225,270,315";

/* What is asked for, and what is found. */
typedef struct Offsets {
    const CliOptions *options;
    const CpsScene *scene;
    int body, curves, steps;
    double heading[MAX_CURVES], to;
    CpsOffsetCurve curve[MAX_CURVES];
    CpsOffsetPlace *place;  /* (curves, 2 steps + 1) */
    CpsOffsetCase *outcome; /* (1 + lines); NULL: not asked for */
    const char **line_name;
    int found; /* curves */
    bool certified;
} Offsets;

static int usage(const char *option, const char *found, const char *expected) {
    fputs("capstan offset: ", stderr);
    cli_printf(stderr, "%s: found '%.80s', expected %s\n", option, found, expected);
    return EXIT_USAGE;
}

/* A number that ends at `end`, or at the end of the text. */
static bool read_number(const char *text, char stop, double *value, const char **rest) {
    char *end;
    errno = 0;
    *value = strtod(text, &end);
    if (end == text || errno != 0 || !isfinite(*value) || (*end && *end != stop)) return false;
    *rest = *end ? end + 1 : end;
    return true;
}

static int read_headings(Offsets *offsets, const char *text) {
    static const char *const EXPECTED = "1 to 72 angles in degrees separated by commas";
    const char *rest = text;
    do {
        if (offsets->curves == MAX_CURVES ||
            !read_number(rest, ',', &offsets->heading[offsets->curves], &rest))
            return usage("--headings", text, EXPECTED);
        offsets->curves++;
    } while (*rest);
    return EXIT_OK;
}

static int read_options(Offsets *offsets) {
    const CliOptions *o = offsets->options;
    const char *rest;
    double value;
    const int code = read_headings(offsets, o->headings ? o->headings : DEFAULT_HEADINGS);
    if (code != EXIT_OK) return code;
    if (o->to && (!read_number(o->to, 0, &offsets->to, &rest) || !(offsets->to > 0)))
        return usage("--to", o->to, "an offset in metres, > 0");
    offsets->steps = DEFAULT_STEPS;
    if (o->steps) {
        if (!read_number(o->steps, 0, &value, &rest) || !(value >= 1 && value <= MAX_STEPS) ||
            value != floor(value))
            return usage("--steps", o->steps, "a number of steps from 1 to 1000");
        offsets->steps = (int)value;
    }
    return EXIT_OK;
}

static int find_body(Offsets *offsets) {
    const char *name = offsets->options->body;
    if (offsets->scene->body_count == 0) {
        fprintf(stderr, "capstan offset: the scene has no body whose offset could be given; its "
                        "lines end at points of a body (bodies in docs/formats.md)\n");
        return EXIT_INPUT;
    }
    for (int i = 0; i < offsets->scene->body_count; ++i)
        if (!name || strcmp(offsets->scene->body[i].name, name) == 0) {
            offsets->body = i;
            return EXIT_OK;
        }
    return usage("--body", name, "the name of a body of the scene");
}

/* Offsets are those of lines at rest: a history that ends in motion has no place to begin from. */
static int check_history(const CpsScene *scene) {
    for (int k = 0; k < scene->stage_count; ++k)
        if (scene->stage[k].duration > 0) {
            fputs("capstan offset: ", stderr);
            cli_printf(stderr,
                       "step '%.80s' of the history has a duration, and offsets are those "
                       "of lines at rest: leave its duration out\n",
                       scene->stage[k].name);
            return EXIT_INPUT;
        }
    return EXIT_OK;
}

static int out_of_memory(void) {
    fprintf(stderr, "capstan: out of memory\n");
    return EXIT_LIMIT;
}

static int prepare(Offsets *offsets) {
    const CpsScene *scene = offsets->scene;
    const size_t lines = (size_t)scene->line_count,
                 places = (size_t)offsets->curves * (2 * (size_t)offsets->steps + 1);
    double longest = 0;
    for (size_t i = 0; i < lines; ++i) longest = fmax(longest, scene->line[i].length);
    if (!(offsets->to > 0)) offsets->to = DEFAULT_SHARE * longest;
    offsets->place = calloc(places, sizeof *offsets->place);
    offsets->line_name = calloc(lines, sizeof *offsets->line_name);
    if (offsets->options->broken) offsets->outcome = calloc(lines + 1, sizeof *offsets->outcome);
    if (!offsets->place || !offsets->line_name || (offsets->options->broken && !offsets->outcome))
        return out_of_memory();
    for (size_t i = 0; i < lines; ++i) offsets->line_name[i] = scene->line[i].name;
    offsets->certified = true;
    return EXIT_OK;
}

/* curves --------------------------------------------------------------------------------------- */

static void print_head(void) {
    printf("%8s %10s %14s %14s %14s  %-*s\n%8s %10s %14s %14s %14s\n", "heading", "offset",
           "restoring", "back", "tension", NAME_WIDTH, "line", "deg", "m", "N", "N", "N");
}

/* The row of an offset: on the way out, and what is left on the way back. */
static void print_row(const Offsets *offsets, const CpsOffsetCurve *curve, int i) {
    const CpsOffsetPlace *out = &curve->place[i];
    printf("%8.6g %10.5g", curve->heading, out->offset);
    if (!out->certified) {
        printf("  not certified\n");
        return;
    }
    printf(" %14.7g", out->restoring);
    const CpsOffsetPlace *back = NULL;
    for (int k = curve->count - 1; k > i && !back; --k)
        if (curve->place[k].offset == out->offset && curve->place[k].certified)
            back = &curve->place[k];
    if (back)
        printf(" %14.7g", back->restoring);
    else
        printf(" %14s", "");
    printf(" %14.7g  ", out->tension);
    cli_print_text(stdout, offsets->line_name[out->tension_line], NAME_WIDTH, false);
    fputc('\n', stdout);
}

static int find_curves(Offsets *offsets, CpsEvolution *evolution, Progress *progress) {
    CpsError err;
    for (int k = 0; k < offsets->curves; ++k) {
        CpsOffsetCurve *curve = &offsets->curve[k];
        CpsOffsetPlace *place = offsets->place + (size_t)k * (2 * (size_t)offsets->steps + 1);
        *curve = (CpsOffsetCurve){.heading = offsets->heading[k], .place = place};
        if (offset_curve(evolution, offsets->body, curve->heading, offsets->to, offsets->steps,
                         place, &curve->count, &err) != CPS_OK)
            return cli_report(&err);
        for (int i = 0; i < curve->count; ++i)
            offsets->certified = offsets->certified && place[i].certified;
        offsets->found++;
        progress_step(progress, k + 1, "offsets");
    }
    return EXIT_OK;
}

/* lines missing -------------------------------------------------------------------------------- */

static int find_case(Offsets *offsets, int line, CpsOffsetCase *out) {
    WithoutLine without = {.scene = *offsets->scene};
    CpsError err;
    CpsOutcome worst;
    if (line >= 0 && !without_line(offsets->scene, line, &without)) return out_of_memory();
    *out = (CpsOffsetCase){.missing = line >= 0 ? offsets->line_name[line] : NULL};
    int code = EXIT_OK;
    CpsEvolution *evolution =
        without.scene.line_count > 0 ? offset_begin(&without.scene, &worst, &err) : NULL;
    if (evolution) {
        offset_case(&without.scene, evolution, offsets->body, out);
        out->certified = cps_outcome_is_certified(worst);
    } else if (without.scene.line_count > 0) {
        code = cli_report(&err);
    }
    for (int a = 0; a < 3; ++a) out->from[a] = out->position[a] - offsets->outcome[0].position[a];
    cps_evolution_destroy(evolution);
    without_line_clear(&without);
    return code;
}

static void print_cases(const Offsets *offsets) {
    printf("\n%-*s %12s %12s %12s %8s %14s  %-*s %12s\n%-*s %12s %12s %12s %8s %14s  %-*s %12s\n",
           NAME_WIDTH, "missing", "from x", "from y", "from z", "heel", "tension", NAME_WIDTH,
           "line", "uplift", NAME_WIDTH, "", "m", "m", "m", "deg", "N", NAME_WIDTH, "", "N");
    for (int i = 0; i <= offsets->scene->line_count; ++i) {
        const CpsOffsetCase *now = &offsets->outcome[i];
        cli_print_text(stdout, now->missing ? now->missing : "none", NAME_WIDTH, true);
        if (!now->certified) {
            printf("  not certified\n");
            continue;
        }
        printf(" %12.5g %12.5g %12.5g %8.4g %14.7g  ", now->from[0], now->from[1], now->from[2],
               now->heel, now->tension);
        cli_print_text(stdout, now->tension_line, NAME_WIDTH, true);
        printf(" %12.6g\n", now->uplift);
    }
}

static int find_cases(Offsets *offsets, Progress *progress) {
    for (int i = 0; i <= offsets->scene->line_count; ++i) {
        const int code = find_case(offsets, i - 1, &offsets->outcome[i]);
        if (code != EXIT_OK) return code;
        offsets->certified = offsets->certified && offsets->outcome[i].certified;
        progress_step(progress, offsets->curves + i + 1, "missing lines");
    }
    return EXIT_OK;
}

/* the whole ------------------------------------------------------------------------------------ */

static int write_files(const Offsets *offsets, const char *directory) {
    CpsOffsets files = cps_offsets_default();
    CpsError err;
    files.title = offsets->scene->title;
    files.body = offsets->scene->body[offsets->body].name;
    files.line_count = offsets->scene->line_count;
    files.line_name = offsets->line_name;
    files.curve_count = offsets->found;
    files.curve = offsets->curve;
    files.case_count = offsets->outcome ? offsets->scene->line_count + 1 : 0;
    files.outcome = offsets->outcome;
    files.complete = offsets->certified;
    if (cps_offsets_write(directory, &files, &err) != CPS_OK) return cli_report(&err);
    if (!offsets->options->quiet)
        cli_printf(stdout, "\nresults   %s: offset.csv%s\npictures  %s: offset.svg\n", directory,
                   offsets->outcome ? ", broken.csv" : "", directory);
    return EXIT_OK;
}

static int compute(Offsets *offsets, const char *directory) {
    CpsError err;
    CpsOutcome worst;
    CpsEvolution *evolution = offset_begin(offsets->scene, &worst, &err);
    if (!evolution) return cli_report(&err);
    int code = EXIT_OK;
    if (!cps_outcome_is_certified(worst)) {
        fprintf(stderr, "capstan offset: the history of the scene: %s\n", cps_outcome_text(worst));
        code = cps_outcome_is_final(worst) ? EXIT_NO_SOLUTION : EXIT_NOT_CERTIFIED;
    }
    const int parts = offsets->curves + (offsets->outcome ? offsets->scene->line_count + 1 : 0);
    Progress progress = progress_begin(parts, offsets->options->quiet);
    if (code == EXIT_OK) code = find_curves(offsets, evolution, &progress);
    cps_evolution_destroy(evolution);
    if (code == EXIT_OK && offsets->outcome) code = find_cases(offsets, &progress);
    progress_end(&progress);
    if (code != EXIT_OK) return code;
    if (!offsets->options->quiet) {
        print_head();
        for (int k = 0; k < offsets->curves; ++k)
            for (int i = 0; i < offsets->curve[k].count; ++i)
                if (i == 0 ||
                    offsets->curve[k].place[i].offset > offsets->curve[k].place[i - 1].offset)
                    print_row(offsets, &offsets->curve[k], i);
        if (offsets->outcome) print_cases(offsets);
    }
    code = write_files(offsets, directory);
    return code == EXIT_OK && !offsets->certified ? EXIT_NOT_CERTIFIED : code;
}

int cmd_offset(int argc, char **argv) {
    CliOptions options;
    if (!cli_parse(argc, argv, FOR_OFFSET, "SCENE.yaml", &options)) return EXIT_USAGE;
    Offsets offsets = {.options = &options};
    int code = read_options(&offsets);
    if (code != EXIT_OK) return code;
    CpsSceneFile *file = NULL;
    CpsError err;
    if (cps_scene_read(options.operand, NULL, &file, &err) != CPS_OK) return cli_report(&err);
    offsets.scene = cps_scene_file_scene(file);
    char *directory = NULL;
    code = find_body(&offsets);
    if (code == EXIT_OK) code = check_history(offsets.scene);
    if (code == EXIT_OK) code = prepare(&offsets);
    if (code == EXIT_OK) directory = cli_destination(&options, CPS_RESULTS_KIND_OFFSET, 0, &code);
    if (directory) {
        cli_catch_signals();
        code = compute(&offsets, directory);
    }
    free(directory);
    free(offsets.place);
    free(offsets.outcome);
    free(offsets.line_name);
    cps_scene_file_destroy(file);
    return code;
}
