/* SPDX-License-Identifier: BSD-3-Clause */
/* Velocities and forces as text (see law_query.h). */
#include "law_query.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows read at most: answers are printed one by one, but kept until the picture is drawn. */
enum { MOST_ROWS = 1000000, LONGEST_LINE = 1 << 20 };

static int bad(const char *where, int line, const char *what, const char *text) {
    if (line > 0)
        fprintf(stderr, "capstan: standard input:%d: %s: found '%.60s'\n", line, what, text);
    else
        fprintf(stderr, "capstan law: --%s: %s: found '%.60s'\n", where, what, text);
    return line > 0 ? EXIT_INPUT : EXIT_USAGE;
}

static bool make_room(QueryList *list) {
    if (list->count < list->room) return true;
    const int room = list->room > 0 ? 2 * list->room : 16;
    double *row = realloc(list->row, (size_t)room * (size_t)list->n * sizeof *row);
    if (!row) return false;
    list->row = row, list->room = room;
    return true;
}

/* one row "1, 2" of list->n finite numbers; line 0: of the command line */
static int add_row(const char *text, const char *option, int line, QueryList *list) {
    char expected[80];
    snprintf(expected, sizeof expected, "expected %d number%s separated by commas", list->n, list->n == 1 ? "" : "s");
    if (list->count == MOST_ROWS || !make_room(list)) {
        fprintf(stderr, "capstan: out of memory, or more than %d rows\n", (int)MOST_ROWS);
        return EXIT_LIMIT;
    }
    double *row = list->row + (size_t)list->count * (size_t)list->n;
    const char *at = text;
    for (int i = 0; i < list->n; i++) {
        char *end;
        row[i] = strtod(at, &end);
        if (end == at || !isfinite(row[i])) return bad(option, line, expected, text);
        end += strspn(end, " \t");
        if (*end != (i + 1 < list->n ? ',' : '\0')) return bad(option, line, expected, text);
        at = end + 1;
    }
    list->count++;
    return EXIT_OK;
}

/* rows of standard input; blank lines, comments (#) and a line of column names at the top are passed over */
static int read_rows(const char *option, QueryList *list) {
    char *text = NULL;
    size_t room = 0;
    int code = EXIT_OK, line = 0;
    bool first = true;
    for (ssize_t length; code == EXIT_OK && (length = getline(&text, &room, stdin)) >= 0;) {
        line++;
        if (length > LONGEST_LINE) code = bad(option, line, "the line is longer than 1 MiB", "...");
        text[strcspn(text, "\r\n")] = '\0';
        const char *start = text + strspn(text, " \t");
        if (code != EXIT_OK || !*start || *start == '#') continue;
        const bool names = first && !strchr("+-.0123456789", *start);
        first = false;
        if (!names) code = add_row(start, option, line, list);
    }
    free(text);
    if (code == EXIT_OK && ferror(stdin)) {
        fprintf(stderr, "capstan: cannot read standard input\n");
        code = EXIT_IO;
    }
    return code;
}

int law_query_read(const CliList *given, const char *option, QueryList *list) {
    int code = EXIT_OK;
    for (int i = 0; i < given->count && code == EXIT_OK; i++)
        code = strcmp(given->item[i], "-") == 0 ? read_rows(option, list) : add_row(given->item[i], option, 0, list);
    return code;
}
