/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of the ends (end_table.h). */
#define _POSIX_C_SOURCE 200809L
#include "run/end_table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "printable.h"

enum { NAME_WIDTH = 18, LINE_WIDTH = 10, PLACE_WIDTH = 30 };

static const double DEGREES = 57.29577951308232;
/* A force below this share of the largest one of the line is rounding. */
static const double ROUNDING = 1e-9;

bool end_table_begin(EndTable *table) {
    *table = (EndTable){0};
    table->out = open_memstream(&table->text, &table->size);
    return table->out != NULL;
}

static void print_head(FILE *out) {
    static const char *const END[] = {"A", "B"};
    fprintf(out, "%-*s %-*s", NAME_WIDTH, "step", LINE_WIDTH, "line");
    for (int end = 0; end < 2; ++end) fprintf(out, "   angle %s     uplift %s", END[end], END[end]);
    fprintf(out, "      sweep  util.  %-*s touchdown from B", PLACE_WIDTH, "touchdown from A");
    fprintf(out, "\n%-*s %-*s", NAME_WIDTH, "", LINE_WIDTH, "");
    for (int end = 0; end < 2; ++end) fputs("   degrees            N", out);
    fprintf(out, "          m      1  %-*s m\n", PLACE_WIDTH, "m");
}

/* Where the line touches down from an end: - where it touches nothing. */
static void print_touchdown(FILE *out, const CpsLineReport *line, int end) {
    const CpsEndReport *at = &line->end[end];
    const double *x = at->touchdown, size = 1e-9 * (fabs(x[0]) + fabs(x[1]) + fabs(x[2]));
    char text[3 * 16];
    if (!line->has_touchdown)
        snprintf(text, sizeof text, "-");
    else if (at->suspended == 0)
        snprintf(text, sizeof text, "lies there");
    else
        snprintf(text, sizeof text, "%.6g, %.6g, %.6g", fabs(x[0]) < size ? 0 : x[0],
                 fabs(x[1]) < size ? 0 : x[1], fabs(x[2]) < size ? 0 : x[2]);
    fprintf(out, " %-*s", end == CPS_END_A ? PLACE_WIDTH : 1, text);
}

static void add_line(EndTable *table, const char *step, const char *name,
                     const CpsLineReport *line) {
    FILE *out = table->out;
    const double rounding = ROUNDING * line->certificate.largest_force;
    cli_print_text(out, step, NAME_WIDTH, true);
    fputc(' ', out);
    cli_print_text(out, name, LINE_WIDTH, true);
    for (int end = 0; end < 2; ++end) {
        const CpsEndReport *at = &line->end[end];
        const bool pulls = at->tension > rounding, lifts = fabs(at->uplift) > rounding;
        fprintf(out, " %9.4g %12.6g", pulls && lifts ? DEGREES * at->angle : 0,
                lifts ? at->uplift : 0);
        table->says_something = table->says_something || lifts;
    }
    fprintf(out, " %10.4g ", line->sweep);
    table->says_something = table->says_something || line->sweep > 0 || line->has_utilisation;
    if (line->has_utilisation)
        fprintf(out, "%6.3f ", line->utilisation);
    else
        fprintf(out, "%6s ", "-");
    for (int end = 0; end < 2; ++end) print_touchdown(out, line, end);
    fputc('\n', out);
}

void end_table_add(EndTable *table, const CpsEvolution *evolution) {
    const CpsStepReport step = cps_evolution_report(evolution);
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i) {
        const CpsLineReport line = cps_evolution_line_report(evolution, i);
        add_line(table, i == 0 ? step.name : "", cps_evolution_line_view(evolution, i).name, &line);
    }
}

bool end_table_print(EndTable *table, FILE *out) {
    const bool whole = fclose(table->out) == 0;
    table->out = NULL;
    if (!whole) return false;
    if (!table->says_something) return true;
    fputc('\n', out);
    print_head(out);
    fwrite(table->text, 1, table->size, out);
    return true;
}

void end_table_free(EndTable *table) {
    if (table->out) fclose(table->out);
    free(table->text);
    memset(table, 0, sizeof *table);
}
