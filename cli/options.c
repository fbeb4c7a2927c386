/* SPDX-License-Identifier: BSD-3-Clause */
/* Command-line options: one table defines the parser, the help and the suggestions. */
#include "options.h"
#include "capstan/io.h"
#include "printable.h"

#include <stddef.h>
#include <string.h>

typedef struct Option {
    const char *name;     /* --name */
    char letter;          /* -l, 0: none */
    const char *argument; /* name of its argument in the help, NULL: none */
    unsigned commands;    /* FOR_ bits */
    size_t field;         /* of CliOptions: bool without argument, const char * with one, CliList if
                             repeated */
    bool repeated;
    const char *help;
} Option;

static const Option OPTIONS[] = {
    {"output", 'o', "DIR", FOR_RUN | FOR_STUDY | FOR_OFFSET, offsetof(CliOptions, output), false,
     "directory of the results (default: results/SCENE, of others SCENE-study, SCENE-offset)"},
    {"json", 0, NULL, FOR_RUN | FOR_LAW | FOR_DRIVE, offsetof(CliOptions, json), false,
     "print one JSON object on standard output"},
    {"path-tolerance", 't', "TOL", FOR_RUN, offsetof(CliOptions, path_tolerance), false,
     "path_tolerance of the scene: cut steps until halves agree (0: steps as given)"},
    {"resume", 'r', NULL, FOR_RUN, offsetof(CliOptions, resume), false,
     "go on where a run into the same directory was stopped or killed"},
    {"force", 0, NULL, FOR_RUN | FOR_STUDY | FOR_OFFSET, offsetof(CliOptions, overwrite), false,
     "write into a directory that is not capstan's, or begin a run anew where one was interrupted"},
    {"no-paraview", 0, NULL, FOR_RUN, offsetof(CliOptions, no_paraview), false,
     "write no .vtp and .pvd files"},
    {"stiffness", 0, NULL, FOR_RUN, offsetof(CliOptions, stiffness), false,
     "write stiffness.csv: stiffness of the ends of all lines after each step"},
    {"out-table", 0, NULL, FOR_RUN, offsetof(CliOptions, out_table), false,
     "write history.out: of a history in time, tensions, places and motions with MoorDyn's names"},
    {"fields", 0, "NAME,..", FOR_RUN, offsetof(CliOptions, fields), false,
     "fields along the lines in result.nc, or none (default: all, which the checker needs)"},
    {"sync", 0, "WHEN", FOR_RUN, offsetof(CliOptions, sync), false,
     "step (default): wait for the disk after each step; end: once, faster, and a power cut may "
     "take the run"},
    {"threads", 0, "N", FOR_RUN, offsetof(CliOptions, threads), false,
     "threads that share the lines of the scene (default: 1); the results are the same"},
    {"method", 'm', "NAME", FOR_RUN, offsetof(CliOptions, method), false,
     "exact (default), or regularized: the method of 1990, without certificate"},
    {"velocity", 'v', "V,..", FOR_LAW | FOR_DRIVE, offsetof(CliOptions, velocity), true,
     "law: its forces at V; drive: the motion at V; - reads CSV"},
    {"force", 'f', "F,..", FOR_LAW | FOR_DRIVE, offsetof(CliOptions, force), true,
     "velocities of the law (drive: the reduced one) at F; - reads CSV"},
    {"plot", 'p', "FILE.svg", FOR_LAW | FOR_DRIVE, offsetof(CliOptions, plot), false,
     "draw the law, or the driven system, with what was asked"},
    {"axes", 0, "I,J", FOR_LAW | FOR_DRIVE, offsetof(CliOptions, axes), false,
     "components drawn by --plot (default: 1,2)"},
    {"history", 0, NULL, FOR_STUDY, offsetof(CliOptions, history), false,
     "all steps by three methods side by side, instead of one"},
    {"complete", 'c', "SHAPE", FOR_STUDY, offsetof(CliOptions, complete), false,
     "lay the slack of the step out, so that |x'| = 1: shortest, straight or meander"},
    {"judge", 'j', "FILE.csv", FOR_STUDY, offsetof(CliOptions, judge), false,
     "is this configuration a solution of the step, and if not, why; - reads standard input"},
    {"tolerance", 0, "TOL", FOR_STUDY, offsetof(CliOptions, tolerance), false,
     "with which configurations are judged: gaps up to TOL times their scale are none (default: "
     "1e-8)"},
    {"h", 0, "H", FOR_STUDY, offsetof(CliOptions, h), false,
     "length of the finest cells of the method of 1990, m (default: a quarter of an element)"},
    {"lambda", 0, "LAMBDA", FOR_RUN | FOR_STUDY, offsetof(CliOptions, lambda), false,
     "its penalty for contact, N/m2; the study ends there (default: sinks 1e-7 of the length)"},
    {"n", 0, "N", FOR_RUN | FOR_STUDY, offsetof(CliOptions, n), false,
     "its vanishing stiffness is 1/N, 1/(N m2); inf: none, P5.1 (default: 4e8 on example 5.7)"},
    {"delta", 0, "DELTA", FOR_RUN | FOR_STUDY, offsetof(CliOptions, delta), false,
     "its smoothing of friction, m (default: 3e-9 of the length)"},
    {"step", 's', "NAME", FOR_STUDY, offsetof(CliOptions, step), false,
     "the step to study, by its name or its number from 1 (default: the first)"},
    {"line", 'l', "NAME", FOR_STUDY, offsetof(CliOptions, line), false,
     "the line to study (default: the first)"},
    {"eliminate", 'e', NULL, FOR_DRIVE, offsetof(CliOptions, eliminate), false,
     "the law between driving velocity and resistance, all else eliminated"},
    {"body", 'b', "NAME", FOR_OFFSET, offsetof(CliOptions, body), false,
     "the body that is moved (default: the first)"},
    {"headings", 0, "DEG,..", FOR_OFFSET, offsetof(CliOptions, headings), false,
     "directions of the offset, from x towards y (default: 0,45,..,315)"},
    {"to", 0, "M", FOR_OFFSET, offsetof(CliOptions, to), false,
     "largest offset, m (default: a hundredth of the longest line)"},
    {"steps", 0, "N", FOR_OFFSET, offsetof(CliOptions, steps), false,
     "load steps out, and as many back (default: 10)"},
    {"broken", 0, NULL, FOR_OFFSET, offsetof(CliOptions, broken), false,
     "where the body is with each line missing in turn"},
    {"quiet", 'q', NULL, FOR_RUN | FOR_STUDY | FOR_DRIVE | FOR_OFFSET, offsetof(CliOptions, quiet),
     false, "no progress, no table; only errors"},
    {"help", 'h', NULL, FOR_ALL, offsetof(CliOptions, help), false, "show this help"},
    {"version", 'V', NULL, FOR_ALL, offsetof(CliOptions, version), false,
     "show version, commit and build flags"},
};
enum { OPTION_COUNT = sizeof OPTIONS / sizeof OPTIONS[0] };

/* Names of earlier versions. */
static const struct { const char *former, *name; } RENAMED[] = {{"tol", "path-tolerance"}};
enum { RENAMED_COUNT = sizeof RENAMED / sizeof RENAMED[0] };

void cli_print_options(FILE *out, unsigned commands) {
    for (int i = 0; i < OPTION_COUNT; i++) {
        const Option *o = &OPTIONS[i];
        if (!(o->commands & commands)) continue;
        char left[64];
        snprintf(left, sizeof left, "%c%c%s --%s%s%s", o->letter ? '-' : ' ',
                 o->letter ? o->letter : ' ', o->letter ? "," : " ", o->name,
                 o->argument ? " " : "", o->argument ? o->argument : "");
        fprintf(out, "  %-20s %s\n", left, o->help);
    }
}

/* the option of a command with this long name (of length n) or letter, or NULL */
static const Option *find_option(unsigned command, const char *name, size_t n, char letter) {
    for (int i = 0; i < OPTION_COUNT; i++) {
        const Option *o = &OPTIONS[i];
        bool same =
            letter ? o->letter == letter : strlen(o->name) == n && memcmp(o->name, name, n) == 0;
        if ((o->commands & command) && same) return o;
    }
    return NULL;
}

/* what an option of the command that earlier versions had is called now, or NULL */
static const char *renamed_option(unsigned command, const char *given) {
    if (given[1] != '-') return NULL;
    for (int i = 0; i < RENAMED_COUNT; i++) {
        const size_t n = strlen(RENAMED[i].former);
        const bool former =
            strcspn(given + 2, "=") == n && memcmp(given + 2, RENAMED[i].former, n) == 0;
        if (former && find_option(command, RENAMED[i].name, strlen(RENAMED[i].name), 0))
            return RENAMED[i].name;
    }
    return NULL;
}

/* "capstan check: ", or "capstan: " before any command (an empty name) */
static void begin_message(const char *command) {
    fprintf(stderr, "capstan%s%s: ", *command ? " " : "", command);
}

static bool end_message(const char *command) {
    fprintf(stderr, "\nTry 'capstan%s%s --help'.\n", *command ? " " : "", command);
    return false;
}

static bool unknown_option(const char *command_name, unsigned command, const char *given) {
    begin_message(command_name);
    const char *now = renamed_option(command, given);
    if (now) {
        cli_printf(stderr, "option '%.*s' is now '--%s'", (int)strcspn(given, "="), given, now);
        return end_message(command_name);
    }
    cli_printf(stderr, "unknown option '%s'", given);
    CpsSuggestion suggestion = {.word = given + 2};
    if (given[1] == '-')
        for (int i = 0; i < OPTION_COUNT; i++)
            if (OPTIONS[i].commands & command) cps_suggest(&suggestion, OPTIONS[i].name);
    if (suggestion.best) fprintf(stderr, "; did you mean '--%s'?", suggestion.best);
    return end_message(command_name);
}

/* read one option at argv[*i], with its argument if it has one */
static bool take_option(int argc, char **argv, int *i, unsigned command, CliOptions *out) {
    const char *given = argv[*i];
    bool is_long = given[1] == '-';
    const char *name = given + (is_long ? 2 : 1);
    size_t n = is_long ? strcspn(name, "=") : 1;
    const Option *o = find_option(command, name, n, is_long ? 0 : *name);
    if (!o) return unknown_option(argv[0], command, given);

    /* the text after the name in the same word: "=value", or for a letter "value" */
    const char *attached = name[n] ? name + n + (is_long ? 1 : 0) : NULL;
    char *field = (char *)out + o->field;
    if (!o->argument) {
        if (attached) {
            begin_message(argv[0]);
            cli_printf(stderr, "'%s': option '--%s' takes no argument", given, o->name);
            return end_message(argv[0]);
        }
        *(bool *)field = true;
        return true;
    }
    const char *value = attached ? attached : *i + 1 < argc ? argv[++*i] : NULL;
    if (!value || !*value) {
        begin_message(argv[0]);
        fprintf(stderr, "option '--%s' needs an argument: --%s %s", o->name, o->name, o->argument);
        return end_message(argv[0]);
    }
    if (!o->repeated) {
        memcpy(field, &value, sizeof value);
        return true;
    }
    CliList *list = (CliList *)(void *)field;
    if (list->count == CLI_LIST_MOST) {
        begin_message(argv[0]);
        fprintf(stderr, "'--%s' is given more than %d times: use CSV on standard input", o->name,
                (int)CLI_LIST_MOST);
        return end_message(argv[0]);
    }
    list->item[list->count++] = value;
    return true;
}

bool cli_parse(int argc, char **argv, unsigned command, const char *operand, CliOptions *out) {
    *out = (CliOptions){0};
    bool options_ended = false;
    for (int i = 1; i < argc; i++) {
        const char *word = argv[i];
        if (!options_ended && strcmp(word, "--") == 0) {
            options_ended = true;
        } else if (!options_ended && word[0] == '-' && word[1]) {
            if (!take_option(argc, argv, &i, command, out)) return false;
        } else if (operand && !out->operand && *word) {
            out->operand = word;
        } else {
            begin_message(argv[0]);
            cli_printf(stderr, "unexpected '%s'", word);
            return end_message(argv[0]);
        }
    }
    if (operand && operand[0] != '[' && !out->operand && !out->help && !out->version) {
        begin_message(argv[0]);
        fprintf(stderr, "no file given: capstan %s %s ('-' reads standard input)", argv[0],
                operand);
        return end_message(argv[0]);
    }
    return true;
}
