/* SPDX-License-Identifier: BSD-3-Clause */
/* How long one load step takes, over the number of elements, and what the machine allows.
 *
 *   souza   first step of S90 example 5.7: a rope of 6.28 m, EA = 10 N, 9.81 N/m, straight on a bed
 *           with mu = 0.0255, held at A, pulled at B by (0.5, 0.5, 0.5) N
 *   oc3     OC3-Hywind mooring line: 902.2 m, EA = 384.243 MN, 698.094 N/m, mu = 0.5, laid by
 *           statics with the fairlead 848.67 m out and 250 m up, then pulled 1.5 m further out: the
 *           step timed
 *
 * Each size runs in a process of its own, so that its peak memory is its own; each repeat prepares
 * the scene anew, and only the step is timed. The machine's limit is the rate at which a plain loop
 * a = b + s c streams (McCalpin's triad). Uses the public interface only. CSV on standard output,
 * or a table. */
#include <getopt.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "capstan/evolve.h"

enum { MOST_SIZES = 32, MOST_REPEATS = 101 };

/* Unless told how often: repeat until this much time is spent on a size, but at least three
 * times. */
static const double REPEAT_SECONDS = 2;
/* What --check asks. Smaller sizes drown in the cost of a call (time) and of whole pages
 * (memory). */
static const double MOST_GROWTH = 1.6, MOST_BYTES = 1000;
enum { TIME_FROM = 1000, MEMORY_FROM = 10000 };

static const char usage[] =
    "usage: step_bench [options]\n"
    "  --case NAME       souza, oc3 or all          (default all)\n"
    "  --elements LIST   numbers of elements, with commas\n"
    "                    (default 100,1000,10000,100000,1000000)\n"
    "  --repeat R        repeats per size, 1..101   (default: for about two seconds, at least 3)\n"
    "  --table           a table for reading, instead of CSV\n"
    "  --check           exit 1 unless all are solved, from 1000 elements on time per element\n"
    "                    stays within a factor of 1.6, and from 10000 on memory within 1000 bytes\n"
    "                    per element\n"
    "  --stream          measure memory bandwidth instead\n"
    "  --dump FILE       solve once and write the step problem and its answer (README.md); one\n"
    "                    case, one size\n";

typedef struct Options {
    const char *name, *dump;
    int sizes, repeat;
    int elements[MOST_SIZES];
    bool table, check, stream;
} Options;

/* One measured size. */
typedef struct Row {
    CpsOutcome outcome;
    int elements, repeats, iterations;
    double seconds, least; /* [s] of the step: median and minimum */
    double gap, residual;  /* gap/S; force residual over the largest force */
    double bytes;          /* peak memory per element */
} Row;

static void die(const char *what, const char *detail) {
    fprintf(stderr, "step_bench: %s%s%s\n", what, detail ? ": " : "", detail ? detail : "");
    exit(1);
}

/* Of the processor, not of what else the machine does. */
static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* the two cases -------------------------------------------------------------------------------- */

/* A scene and what it points to. */
typedef struct Setup {
    CpsScene scene;
    CpsLine line;
    CpsObstacle bed;
    CpsStage stage;
    CpsChange change;
    double point[6];
} Setup;

static void setup_souza(Setup *setup) {
    CpsLine *line = &setup->line;
    line->length = 6.28;
    line->weight = 9.81;
    line->stiffness = 10;
    setup->bed.friction = 0.0255;
    setup->point[3] = line->length;
    line->start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = setup->point};
    setup->change = (CpsChange){.end = CPS_END_B, .to = {CPS_END_KIND_FREE, {0.5, 0.5, 0.5}}};
}

static void setup_oc3(Setup *setup) {
    CpsLine *line = &setup->line;
    line->length = 902.2;
    line->weight = 698.094;
    line->stiffness = 384.243e6;
    setup->bed.friction = 0.5;
    setup->bed.point[2] = -320;
    line->start.kind = CPS_START_STATIC;
    line->end[CPS_END_A] = (CpsEnd){CPS_END_KIND_HELD, {0, 0, -320}};
    line->end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {848.67, 0, -70}};
    setup->change = (CpsChange){.end = CPS_END_B, .to = {CPS_END_KIND_HELD, {850.17, 0, -70}}};
}

typedef struct Case {
    const char *name;
    void (*fill)(Setup *setup);
} Case;

static const Case cases[] = {{"souza", setup_souza}, {"oc3", setup_oc3}};
enum { CASES = sizeof cases / sizeof *cases };

static void setup_fill(Setup *setup, const Case *which, int elements) {
    *setup = (Setup){.scene = cps_scene_default(),
                     .line = cps_line_default(),
                     .bed = cps_obstacle_default()};
    setup->line.name = which->name;
    setup->line.element_count = elements;
    setup->bed.name = "bed";
    which->fill(setup);
    setup->stage = (CpsStage){.cookie = cps_stage_default().cookie,
                              .name = "step",
                              .step_count = 1,
                              .change_count = 1,
                              .change = &setup->change};
    setup->scene.obstacle = &setup->bed;
    setup->scene.obstacle_count = 1;
    setup->scene.line = &setup->line;
    setup->scene.line_count = 1;
    setup->scene.stage = &setup->stage;
    setup->scene.stage_count = 1;
}

/* Run the history to its last step, the one that counts, and set `spent` to the time of that
 * step. */
static CpsEvolution *run(const Case *which, int elements, double *spent) {
    Setup setup;
    CpsError err;
    CpsEvolution *evolution;
    setup_fill(&setup, which, elements);
    if (cps_evolution_create(&setup.scene, &evolution, &err) != CPS_OK)
        die(which->name, err.message);
    while (cps_evolution_remaining_count(evolution) > 0) {
        const double begin = seconds();
        if (cps_evolution_step(evolution, &err) != CPS_OK) die(which->name, err.message);
        *spent = seconds() - begin;
    }
    return evolution;
}

/* measure -------------------------------------------------------------------------------------- */

static int ascending(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double peak_bytes(void) {
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return 1024.0 * (double)used.ru_maxrss; /* Linux: kilobytes */
}

/* Peak memory per element of one evolution; a small one before it brings in code and libraries. */
static double memory_per_element(const Case *which, int elements) {
    double unused;
    cps_evolution_destroy(run(which, 10, &unused));
    const double before = peak_bytes();
    cps_evolution_destroy(run(which, elements, &unused));
    return (peak_bytes() - before) / elements;
}

static Row measure(const Case *which, int elements, const Options *options) {
    Row row = {.elements = elements, .bytes = memory_per_element(which, elements)};
    double spent[MOST_REPEATS];
    const double begin = seconds();
    do {
        CpsEvolution *evolution = run(which, elements, &spent[row.repeats++]);
        const CpsStepReport report = cps_evolution_report(evolution);
        row.outcome = report.outcome;
        row.iterations = report.iteration_count;
        row.gap = report.certificate.gap / report.certificate.scale;
        row.residual = report.certificate.force_residual / report.certificate.largest_force;
        cps_evolution_destroy(evolution);
    } while (options->repeat ? row.repeats < options->repeat
                             : row.repeats < 3 || (row.repeats < MOST_REPEATS &&
                                                   seconds() - begin < REPEAT_SECONDS));
    qsort(spent, (size_t)row.repeats, sizeof *spent, ascending);
    row.seconds = spent[row.repeats / 2];
    row.least = spent[0];
    return row;
}

/* Measure in a child, whose memory starts small and whose end gives everything back. */
static Row measure_apart(const Case *which, int elements, const Options *options) {
    int pipes[2], status = 0;
    Row row;
    fflush(stdout);
    if (pipe(pipes) != 0) die("no pipe", NULL);
    const pid_t child = fork();
    if (child < 0) die("no process", NULL);
    if (child == 0) {
        row = measure(which, elements, options);
        _exit(write(pipes[1], &row, sizeof row) == (ssize_t)sizeof row ? 0 : 1);
    }
    close(pipes[1]);
    const bool whole = read(pipes[0], &row, sizeof row) == (ssize_t)sizeof row;
    close(pipes[0]);
    waitpid(child, &status, 0);
    if (!whole || status != 0) die(which->name, "the measuring process failed");
    return row;
}

static void print_row(const Case *which, const Row *row, bool table) {
    const double per_element = 1e6 * row->seconds / row->elements;
    const double per_node =
        1e6 * row->seconds / ((row->elements + 1.0) * (row->iterations > 0 ? row->iterations : 1));
    const double median = 1e3 * row->seconds, least = 1e3 * row->least;
    const char *outcome = cps_outcome_name(row->outcome);
    if (table)
        printf("%-6s %9d %7d %10d %11.3f %11.3f %10.4f %10.3f %9.1e %9.1e %9.0f  %s\n", which->name,
               row->elements, row->repeats, row->iterations, median, least, per_node, per_element,
               row->gap, row->residual, row->bytes, outcome);
    else
        printf("%s,%d,%d,%d,%.6g,%.6g,%.6g,%.6g,%.3g,%.3g,%.6g,%s\n", which->name, row->elements,
               row->repeats, row->iterations, median, least, per_node, per_element, row->gap,
               row->residual, row->bytes, outcome);
}

static void print_head(bool table) {
    if (table)
        printf("case    elements repeats iterations   median ms      min ms us/node/it us/element  "
               "   gap/S  residual B/element  outcome\n");
    else
        printf(
            "case,elements,repeats,iterations,median_ms,min_ms,us_per_node_iteration,us_"
            "per_element,gap_over_scale,force_residual_relative,peak_bytes_per_element,outcome\n");
}

/* Does what was measured hold what is promised for all sizes? */
static bool check_rows(const char *name, const Row *row, int count) {
    double least = INFINITY, most = 0, bytes = 0;
    bool solved = true;
    for (int i = 0; i < count; i++) {
        const double per_element = row[i].least / row[i].elements;
        solved = solved && row[i].outcome == CPS_OUTCOME_SOLVED;
        if (row[i].elements >= TIME_FROM) {
            least = fmin(least, per_element);
            most = fmax(most, per_element);
        }
        if (row[i].elements >= MEMORY_FROM) bytes = fmax(bytes, row[i].bytes);
    }
    const bool good = solved && most <= MOST_GROWTH * least && bytes <= MOST_BYTES;
    printf("%s: %s, time per element within a factor of %.2f (at most %g), at most %.0f bytes per "
           "element (at most %g): %s\n",
           name, solved ? "all solved" : "NOT ALL SOLVED", most / least, MOST_GROWTH, bytes,
           MOST_BYTES, good ? "good" : "NOT GOOD");
    return good;
}

/* the machine ---------------------------------------------------------------------------------- */

/* Bytes per second of the triad over `bytes` of memory in all: the best of several sweeps, as its
 * author does. */
static double triad(size_t bytes) {
    const size_t n = bytes / (3 * sizeof(double));
    double *a = malloc(n * sizeof *a), *b = malloc(n * sizeof *b), *c = malloc(n * sizeof *c),
           best = 0;
    if (!a || !b || !c) die("out of memory", NULL);
    for (size_t i = 0; i < n; i++) {
        a[i] = 0;
        b[i] = 1;
        c[i] = (double)i;
    }
    /* enough sweeps at a time that the clock does not matter */
    const int sweeps = 1 + (int)(50000000 / bytes);
    for (int k = 0; k < 12; k++) {
        const double begin = seconds();
        for (int sweep = 0; sweep < sweeps; sweep++) {
            const double s = 1 + sweep;
            for (size_t i = 0; i < n; i++) a[i] = b[i] + s * c[i];
            /* each sweep's result is used, so none is left out */
            if (a[n / 2] < 0) puts("impossible");
        }
        const double rate = sweeps * (3.0 * sizeof(double) * (double)n) / (seconds() - begin);
        if (rate > best) best = rate;
    }
    free(a);
    free(b);
    free(c);
    return best;
}

static void print_stream(const Options *options) {
    if (options->table)
        printf("%12s %10s\n", "working set", "GB/s");
    else
        printf("working_set_bytes,triad_bytes_per_second\n");
    for (size_t bytes = 1 << 16; bytes <= (size_t)1 << 29; bytes *= 8) {
        const double rate = triad(bytes);
        if (options->table)
            printf("%9.3g MB %10.1f\n", 1e-6 * (double)bytes, 1e-9 * rate);
        else
            printf("%zu,%.4g\n", bytes, rate);
    }
}

/* hand the problem on -------------------------------------------------------------------------- */

static void print_vector(FILE *out, const double *x) {
    fprintf(out, ",%.17g,%.17g,%.17g", x[0], x[1], x[2]);
}

/* The step problem and its answer as a line view shows them, one row per node; the element of a row
 * ends at its node.
 */
static void write_view(FILE *out, const CpsLineView *view, const Row *row) {
    static const double none[3] = {0, 0, 0};
    fprintf(out, "# capstan step problem 1\n# compliance %.17g\n# iterations %d\n# seconds %.9g\n",
            view->compliance, row->iterations, row->seconds);
    for (int end = 0; end < 2; end++)
        fprintf(out, "# end %c %s %.17g %.17g %.17g\n", end == CPS_END_A ? 'A' : 'B',
                view->end[end].kind == CPS_END_KIND_HELD ? "held" : "free", view->end[end].value[0],
                view->end[end].value[1], view->end[end].value[2]);
    fprintf(out, "element_length,reference_x,reference_y,reference_z,load_x,load_y,load_z,normal_x,"
                 "normal_y,normal_z,gap,friction_bound,position_x,position_y,position_z,"
                 "friction_force_x,friction_force_y,friction_force_z,reaction,segment_force_x,"
                 "segment_force_y,segment_force_z\n");
    for (int j = 0; j <= view->element_count; j++) {
        fprintf(out, "%.17g", j > 0 ? view->element_length[j - 1] : 0);
        print_vector(out, &view->reference[3 * j]);
        print_vector(out, &view->load[3 * j]);
        print_vector(out, &view->normal[3 * j]);
        fprintf(out, ",%.17g,%.17g", view->gap[j], view->friction_bound[j]);
        print_vector(out, &view->position[3 * j]);
        print_vector(out, &view->friction_force[3 * j]);
        fprintf(out, ",%.17g", view->reaction[j]);
        print_vector(out, j > 0 ? &view->segment_force[3 * (j - 1)] : none);
        fprintf(out, "\n");
    }
}

static void dump(const Case *which, int elements, const Options *options) {
    double spent;
    CpsEvolution *evolution = run(which, elements, &spent);
    const CpsStepReport report = cps_evolution_report(evolution);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    const Row row = {.iterations = report.iteration_count, .seconds = spent};
    FILE *out = fopen(options->dump, "w");
    if (!out) die("cannot write", options->dump);
    write_view(out, &view, &row);
    if (ferror(out) || fclose(out) != 0) die("cannot write all of", options->dump);
    cps_evolution_destroy(evolution);
}

/* command line --------------------------------------------------------------------------------- */

static int whole_number(const char *text, long least, long most, const char *what) {
    char *end;
    const long value = strtol(text, &end, 10);
    if (end == text || *end || value < least || value > most) die(what, text);
    return (int)value;
}

static void read_sizes(Options *options, char *list) {
    options->sizes = 0;
    for (char *item = strtok(list, ","); item; item = strtok(NULL, ",")) {
        if (options->sizes == MOST_SIZES) die("too many sizes", NULL);
        options->elements[options->sizes++] =
            whole_number(item, 1, 10000000, "expected a number of elements, 1..1e7");
    }
}

static Options read_options(int argc, char **argv) {
    static const struct option known[] = {{"case", required_argument, NULL, 'c'},
                                          {"elements", required_argument, NULL, 'n'},
                                          {"repeat", required_argument, NULL, 'r'},
                                          {"table", no_argument, NULL, 't'},
                                          {"check", no_argument, NULL, 'k'},
                                          {"stream", no_argument, NULL, 'm'},
                                          {"dump", required_argument, NULL, 'd'},
                                          {"help", no_argument, NULL, 'h'},
                                          {NULL, 0, NULL, 0}};
    Options options = {.name = "all", .sizes = 5, .elements = {100, 1000, 10000, 100000, 1000000}};
    for (int key; (key = getopt_long(argc, argv, "h", known, NULL)) != -1;) {
        switch (key) {
        case 'c': options.name = optarg; break;
        case 'n': read_sizes(&options, optarg); break;
        case 'r':
            options.repeat = whole_number(optarg, 1, MOST_REPEATS, "expected 1..101 repeats");
            break;
        case 't': options.table = true; break;
        case 'k': options.check = true; break;
        case 'm': options.stream = true; break;
        case 'd': options.dump = optarg; break;
        default: fputs(usage, key == 'h' ? stdout : stderr); exit(key == 'h' ? 0 : 2);
        }
    }
    return options;
}

int main(int argc, char **argv) {
    const Options options = read_options(argc, argv);
    if (options.stream) {
        print_stream(&options);
        return 0;
    }
    if (options.dump && (options.sizes != 1 || strcmp(options.name, "all") == 0))
        die("--dump takes one --case and one of --elements", NULL);
    if (!options.dump) print_head(options.table);
    int found = 0;
    bool good = true;
    for (int k = 0; k < CASES; k++) {
        if (strcmp(options.name, "all") != 0 && strcmp(options.name, cases[k].name) != 0) continue;
        found++;
        if (options.dump) {
            dump(&cases[k], options.elements[0], &options);
            continue;
        }
        Row row[MOST_SIZES];
        for (int i = 0; i < options.sizes; i++) {
            row[i] = measure_apart(&cases[k], options.elements[i], &options);
            print_row(&cases[k], &row[i], options.table);
        }
        if (options.check) good = check_rows(cases[k].name, row, options.sizes) && good;
    }
    if (found == 0) die("no such case", options.name);
    return good ? 0 : 1;
}
