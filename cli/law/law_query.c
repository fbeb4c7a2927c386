/* SPDX-License-Identifier: BSD-3-Clause */
/* Velocities and forces as text (see law_query.h). */
#include "law/law_query.h"
#include "capstan/io.h"
#include "printable.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Largest number of rows: answers are printed one by one, but stored until the picture is drawn. */
enum { MOST_ROWS = 1000000, LONGEST_LINE = 1 << 20 };

static int bad(const QueryList *list, const char *where, int line, const char *what,
               const char *text) {
    if (line > 0)
        cli_printf(stderr, "capstan: standard input:%d: %s: found '%.60s'\n", line, what, text);
    else
        cli_printf(stderr, "capstan %s: --%s: %s: found '%.60s'\n", list->command, where, what,
                   text);
    return line > 0 ? EXIT_INPUT : EXIT_USAGE;
}

static bool make_room(QueryList *list) {
    if (list->count < list->capacity) return true;
    const int capacity = list->capacity > 0 ? 2 * list->capacity : 16;
    double *row = realloc(list->row, (size_t)capacity * (size_t)list->n * sizeof *row);
    if (!row) return false;
    list->row = row;
    list->capacity = capacity;
    return true;
}

static void print_expected(const QueryList *list, char *text, size_t size) {
    snprintf(text, size,
             list->n == 1 ? "expected %d number of at most 1e100"
                          : "expected %d numbers separated by commas, at most 1e100",
             list->n);
}

/* one row "1, 2" of list->n numbers; line 0: from the command line */
static int add_row(const char *text, const char *option, int line, QueryList *list) {
    char expected[80];
    print_expected(list, expected, sizeof expected);
    if (list->count == MOST_ROWS || !make_room(list)) {
        fprintf(stderr, "capstan: out of memory, or more than %d rows\n", (int)MOST_ROWS);
        return EXIT_LIMIT;
    }
    double *row = list->row + (size_t)list->count * (size_t)list->n;
    const char *rest;
    if (cps_row_read(text, ",", list->n, row, &rest) < list->n || *rest)
        return bad(list, option, line, expected, text);
    list->count++;
    return EXIT_OK;
}

/* "vx, vy": as many words as there are columns, each beginning with a letter, none of them a number
 * (nan) */
static bool is_names(const char *text, int columns) {
    int words = 0;
    for (;; text++) {
        char *end;
        text += strspn(text, " \t\"");
        const unsigned char c = (unsigned char)*text;
        strtod(text, &end);
        if (!(isalpha(c) || c == '_' || c >= 0x80) || (end > text && strchr(", \t", *end)))
            return false;
        words++;
        text += strcspn(text, ",");
        if (!*text) return words == columns;
    }
}

/* rows of standard input; blank lines, comments (#) and a line of column names at the beginning are
 * skipped */
static int read_rows(const char *option, QueryList *list) {
    char *text = NULL, expected[80];
    size_t capacity = 0;
    int code = EXIT_OK, line = 0;
    bool first = true;
    const int before = list->count;
    for (ssize_t length; code == EXIT_OK && (length = getline(&text, &capacity, stdin)) >= 0;) {
        line++;
        if (length > LONGEST_LINE)
            code = bad(list, option, line, "the line is longer than 1 MiB", "...");
        if (strlen(text) != (size_t)length)
            code = bad(list, option, line, "a zero byte: is this text?", text);
        text[strcspn(text, "\r\n")] = '\0';
        const char *start = text + strspn(text, " \t");
        if (code != EXIT_OK || !*start || *start == '#') continue;
        const bool names = first && is_names(start, list->n);
        first = false;
        if (!names) code = add_row(start, option, line, list);
    }
    free(text);
    if (code == EXIT_OK && ferror(stdin)) {
        fprintf(stderr, "capstan: cannot read standard input\n");
        code = EXIT_IO;
    } else if (code == EXIT_OK && list->count == before) {
        print_expected(list, expected, sizeof expected);
        fprintf(stderr, "capstan: standard input: found no rows, %s in each\n", expected);
        code = EXIT_INPUT;
    }
    return code;
}

int law_query_check_input(const char *command, const char *file, const CliList *velocity,
                          const CliList *force) {
    const CliList *list[2] = {velocity, force};
    int readers = strcmp(file, "-") == 0;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < list[k]->count; i++) readers += strcmp(list[k]->item[i], "-") == 0;
    if (readers < 2) return EXIT_OK;
    fprintf(stderr, "capstan %s: '-' is given %d times, but standard input can be read once\n",
            command, readers);
    return EXIT_USAGE;
}

int law_query_read(const CliList *given, const char *option, QueryList *list) {
    int code = EXIT_OK;
    for (int i = 0; i < given->count && code == EXIT_OK; i++)
        code = strcmp(given->item[i], "-") == 0 ? read_rows(option, list)
                                                : add_row(given->item[i], option, 0, list);
    return code;
}
