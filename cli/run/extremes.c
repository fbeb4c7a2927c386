/* SPDX-License-Identifier: BSD-3-Clause */
/* Extremes of a run (extremes.h). */
#include "run/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "printable.h"

enum { QUANTITY_WIDTH = 18, LINE_WIDTH = 14, STEP_WIDTH = 16 };

static const char *const END[] = {"A", "B"};
static const double DEGREES = 57.29577951308232;
/* Of more lines than these the table says nothing; docs/results.md. */
enum { LISTED_LINES = 2000 };
/* A force below this share of the largest tension of the line is rounding. */
static const double ROUNDING = 1e-9;

/* More names of steps. */
static bool grow(Extremes *extremes) {
    const int capacity = extremes->capacity > 0 ? 2 * extremes->capacity : 64;
    void *names = realloc(extremes->step_name, (size_t)capacity * sizeof extremes->step_name[0]);
    if (!names) return false;
    extremes->step_name = names;
    extremes->capacity = capacity;
    return true;
}

static void widen(CpsExtreme *extreme, double value, int step) {
    if (!extreme->has_values || value < extreme->least) {
        extreme->least = value;
        extreme->least_step = step;
    }
    if (!extreme->has_values || value > extreme->greatest) {
        extreme->greatest = value;
        extreme->greatest_step = step;
    }
    extreme->has_values = true;
}

/* A body without a place has no pose to count. */
static void note_body(CpsExtreme *of, const CpsBodyReport *body, int step) {
    if (!body->has_place) return;
    double angle[4];
    cps_body_angles(body, angle, &angle[3]);
    for (int a = 0; a < 3; ++a) widen(&of[a], body->position[a], step);
    for (int a = 0; a < 4; ++a) widen(&of[3 + a], DEGREES * angle[a], step);
    for (int a = 0; a < 3; ++a) widen(&of[7 + a], body->lines[a], step);
}

/* Memory of the first step. */
static bool begin(Extremes *extremes, int lines, int bodies) {
    if (!extremes->line) extremes->line = calloc((size_t)lines, sizeof *extremes->line);
    if (!extremes->body && bodies > 0)
        extremes->body = calloc((size_t)bodies * EXTREMES_OF_BODY, sizeof *extremes->body);
    return extremes->line && (extremes->body || bodies == 0);
}

bool extremes_note_step(Extremes *extremes, const CpsEvolution *evolution) {
    const int lines = cps_evolution_line_count(evolution),
              bodies = cps_evolution_body_count(evolution);
    if (!begin(extremes, lines, bodies)) return false;
    if (extremes->step_count == extremes->capacity && !grow(extremes)) return false;
    const CpsStepReport step = cps_evolution_report(evolution);
    snprintf(extremes->step_name[extremes->step_count], sizeof extremes->step_name[0], "%s",
             step.name);
    for (int i = 0; i < lines; ++i) {
        const CpsLineReport report = cps_evolution_line_report(evolution, i);
        cps_extremes_add(&extremes->line[i], &report, extremes->step_count);
    }
    for (int i = 0; i < bodies; ++i) {
        const CpsBodyReport report = cps_evolution_body_report(evolution, i);
        note_body(&extremes->body[i * EXTREMES_OF_BODY], &report, extremes->step_count);
    }
    extremes->step_count++;
    return true;
}

/* The table while one line of it is printed. */
typedef struct Columns {
    FILE *out;
    const Extremes *extremes;
    const char *line;
} Columns;

/* `step`: -1 where all steps have the value */
static void print_value(const Columns *table, double value, int step) {
    fprintf(table->out, " %12.6g  ", value);
    cli_print_text(table->out, step < 0 ? "throughout" : table->extremes->step_name[step],
                   STEP_WIDTH, true);
}

/* A row, unless the quantity is always zero, up to `rounding`; `end`: "A", "B" or neither. */
static void print_row(const Columns *table, const char *quantity, const char *end, const char *unit,
                      const CpsExtreme *extreme, double per_unit, double rounding) {
    const double least = fabs(extreme->least) > rounding ? extreme->least : 0,
                 greatest = fabs(extreme->greatest) > rounding ? extreme->greatest : 0;
    if (!extreme->has_values || (least == 0 && greatest == 0)) return;
    char name[QUANTITY_WIDTH + 1];
    snprintf(name, sizeof name, "%s %s%s[%s]", quantity, end, *end ? " " : "", unit);
    fprintf(table->out, "%-*s ", QUANTITY_WIDTH, name);
    cli_print_text(table->out, table->line, LINE_WIDTH, true);
    const bool is_constant =
        greatest - least <= ROUNDING * fmax(fabs(least), fabs(greatest)) + rounding;
    print_value(table, per_unit * least, is_constant ? -1 : extreme->least_step);
    print_value(table, per_unit * greatest, is_constant ? -1 : extreme->greatest_step);
    fputc('\n', table->out);
}

/* What hangs beside an end that is off the ground, and where it touches down. */
static void print_touchdown(const Columns *table, const CpsExtremes *of, int end) {
    if (!(of->suspended[end].greatest > 0)) return;
    static const char *const AXIS[] = {"x", "y", "z"};
    const double least = ROUNDING * of->suspended[end].greatest;
    print_row(table, "suspended", END[end], "m", &of->suspended[end], 1, 0);
    for (int a = 0; a < 3; ++a) {
        char quantity[16];
        snprintf(quantity, sizeof quantity, "touch %s", AXIS[a]);
        print_row(table, quantity, END[end], "m", &of->touchdown[end][a], 1, least);
    }
}

static void print_line(const Columns *table, const CpsExtremes *of) {
    const double least =
        ROUNDING * fmax(of->tension[CPS_END_A].greatest, of->tension[CPS_END_B].greatest);
    for (int end = 0; end < 2; ++end) {
        print_row(table, "tension", END[end], "N", &of->tension[end], 1, least);
        if (!(of->tension[end].greatest > least)) continue;
        print_row(table, "uplift", END[end], "N", &of->uplift[end], 1, least);
        print_row(table, "angle", END[end], "degrees", &of->angle[end], DEGREES, ROUNDING);
    }
    if (!(of->grounded.greatest > 0)) return;
    for (int end = 0; end < 2; ++end) print_touchdown(table, of, end);
    print_row(table, "grounded", "", "m", &of->grounded, 1, 0);
    print_row(table, "slipping", "", "m", &of->slipping, 1, 0);
    print_row(table, "slack", "", "m", &of->slack, 1, 0);
    print_row(table, "sweep", "", "m", &of->sweep, 1, ROUNDING * of->grounded.greatest);
}

static void print_head(FILE *out, const char *of) {
    fprintf(out, "\n%-*s %-*s %12s  %-*s %12s  step\n", QUANTITY_WIDTH, "over all steps",
            LINE_WIDTH, of, "least", STEP_WIDTH, "step", "greatest");
}

/* Where a body was, and the force of its lines on it. */
static void print_body(const Columns *table, const CpsExtreme *of) {
    static const char *const NAME[] = {"x",   "y",    "z",       "roll",    "pitch",
                                       "yaw", "heel", "lines x", "lines y", "lines z"};
    double force = 0;
    for (int k = 7; k < EXTREMES_OF_BODY; ++k)
        force = fmax(force, fmax(fabs(of[k].least), fabs(of[k].greatest)));
    for (int k = 0; k < EXTREMES_OF_BODY; ++k)
        print_row(table, NAME[k], "",
                  k < 3   ? "m"
                  : k < 7 ? "degrees"
                          : "N",
                  &of[k], 1, k < 7 ? ROUNDING : ROUNDING * force);
}

void extremes_print(const Extremes *extremes, const CpsScene *scene, const CpsEvolution *evolution,
                    FILE *out) {
    const int lines = cps_evolution_line_count(evolution),
              bodies = cps_evolution_body_count(evolution);
    if (extremes->step_count < 2 || lines > LISTED_LINES) return;
    print_head(out, "line");
    for (int i = 0; i < lines; ++i) {
        const Columns table = {out, extremes, cps_evolution_line_view(evolution, i).name};
        print_line(&table, &extremes->line[i]);
    }
    if (bodies > 0) print_head(out, "body");
    for (int i = 0; i < bodies; ++i) {
        const Columns table = {out, extremes, scene->body[i].name};
        print_body(&table, &extremes->body[i * EXTREMES_OF_BODY]);
    }
}

void extremes_free(Extremes *extremes) {
    free(extremes->line);
    free(extremes->body);
    free(extremes->step_name);
    memset(extremes, 0, sizeof *extremes);
}
