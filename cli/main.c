/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan: the command line. Finds the command, answers --help and --version, turns errors into
 * exit codes. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "capstan/io.h"
#include "commands.h"
#include "options.h"
#include "printable.h"
#include "signals.h"

typedef struct Command {
    const char *name;
    int (*call)(int argc, char **argv);
    unsigned options;    /* FOR_ bit */
    const char *operand; /* see cli_parse */
    const char *help;
} Command;

static const Command COMMANDS[] = {
    {"run", cmd_run, FOR_RUN, "SCENE.yaml", "solve a scene and write its results and pictures"},
    {"check", cmd_check, FOR_CHECK, "SCENE.yaml",
     "read a scene and say what is in it, or what is wrong with it"},
    {"law", cmd_law, FOR_LAW, "LAW.yaml",
     "forces and velocities of a friction law, with a picture"},
    {"drive", cmd_drive, FOR_DRIVE, "DRIVE.yaml",
     "driven systems: bodies, vehicles, ropes, planimeters; least dissipation"},
    {"study", cmd_study, FOR_STUDY, "SCENE.yaml",
     "a step by the method of 1990: its four limits, and first order"},
    {"offset", cmd_offset, FOR_OFFSET, "SCENE.yaml",
     "what the lines of a body oppose to its offset; and where it is with each line missing"},
    {"schema", cmd_schema, FOR_SCHEMA, "[scene|law|drive]",
     "print the JSON schema of scenes, laws or driven systems (for editors)"},
};
enum { COMMAND_COUNT = sizeof COMMANDS / sizeof COMMANDS[0] };

static void print_help(FILE *out, const Command *command) {
    if (command) {
        fprintf(out, "usage: capstan %s [options] %s\n\n%s\n\noptions:\n", command->name,
                command->operand, command->help);
        cli_print_options(out, command->options);
    } else {
        fprintf(out, "usage: capstan COMMAND [options] [FILE.yaml]\n\n"
                     "Ropes, cables and mooring lines with exact dry friction, every answer "
                     "certified.\n\ncommands:\n");
        for (int i = 0; i < COMMAND_COUNT; i++)
            fprintf(out, "  %-8s %s\n", COMMANDS[i].name, COMMANDS[i].help);
        fprintf(out, "\noptions:\n");
        cli_print_options(out, FOR_ALL);
    }
    fprintf(out, "\nA file named '-' is read from standard input.\n"
                 "Exit codes: 0 done and certified, 1 not certified, 2 usage, 3 bad file, 4 file "
                 "cannot be read or\n"
                 "written, 5 no solution (with proof), 6 out of memory or over a limit, 130/143 "
                 "stopped by a signal.\n");
}

static void print_version(void) {
    printf("capstan %s\ncommit %s\nbuild  %s\n", cps_version(), CAPSTAN_COMMIT, CAPSTAN_BUILD);
}

int cli_report(const CpsError *err) {
    /* names and texts may come from files, and their control characters must not reach a
     * terminal */
    fputs("capstan: ", stderr);
    cli_print_text(stderr, err->file, INT_MAX, false);
    if (err->file[0] && err->line > 0) fprintf(stderr, ":%d:%d", err->line, err->column);
    if (err->file[0]) fputs(": ", stderr);
    cli_print_text(stderr, err->message, INT_MAX, false);
    fputc('\n', stderr);
    switch (err->status) {
    case CPS_OK: return EXIT_OK;
    case CPS_ERR_ARGUMENT:
    case CPS_ERR_INPUT: return EXIT_INPUT;
    case CPS_ERR_IO: return EXIT_IO;
    case CPS_ERR_MEMORY:
    case CPS_ERR_LIMIT: return EXIT_LIMIT;
    case CPS_ERR_INTERRUPTED: return 128 + cli_interrupted();
    }
    return EXIT_INPUT;
}

static int unknown_command(const char *given) {
    fputs("capstan: unknown command '", stderr);
    cli_print_text(stderr, given, INT_MAX, false);
    fputc('\'', stderr);
    CpsSuggestion suggestion = {.word = given};
    for (int i = 0; i < COMMAND_COUNT; i++) cps_suggest(&suggestion, COMMANDS[i].name);
    if (suggestion.best) fprintf(stderr, "; did you mean '%s'?", suggestion.best);
    fprintf(stderr, "\nTry 'capstan --help'.\n");
    return EXIT_USAGE;
}

static int run_command(int argc, char **argv) {
    for (int i = 0; i < COMMAND_COUNT; i++) {
        const Command *command = &COMMANDS[i];
        if (strcmp(argv[0], command->name) != 0) continue;
        CliOptions options;
        if (!cli_parse(argc, argv, command->options, command->operand, &options)) return EXIT_USAGE;
        if (options.help) {
            print_help(stdout, command);
            return EXIT_OK;
        }
        if (options.version) {
            print_version();
            return EXIT_OK;
        }
        return command->call(argc, argv);
    }
    return unknown_command(argv[0]);
}

/* Make sure that standard input, output and error are open. Otherwise a file opened later would get
 * one of their numbers, and printed text would be written into it. */
static bool hold_standard_streams(void) {
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++) {
        if (fcntl(fd, F_GETFD) != -1 || errno != EBADF) continue;
        if (open("/dev/null", fd == STDIN_FILENO ? O_RDONLY : O_WRONLY) != fd) return false;
    }
    return true;
}

int main(int argc, char **argv) {
    if (!hold_standard_streams()) return EXIT_IO;
    signal(SIGXFSZ, SIG_IGN); /* a file over the limit of size is an error as a full disk is */
    /* without a command: --help, --version, or a usage error */
    int code;
    if (argc < 2) {
        print_help(stderr, NULL);
        code = EXIT_USAGE;
    } else if (argv[1][0] == '-') {
        CliOptions options;
        argv[0] = "";
        bool parsed = cli_parse(argc, argv, FOR_ALL, NULL, &options);
        if (parsed && options.help) print_help(stdout, NULL);
        if (parsed && options.version) print_version();
        code = parsed ? EXIT_OK : EXIT_USAGE;
    } else {
        code = run_command(argc - 1, argv + 1);
    }

    /* a full disk is detected only here, or where a command has reported it with this exit code */
    errno = 0;
    const bool failed = fflush(stdout) != 0 || ferror(stdout);
    if (failed && code != EXIT_IO) {
        fprintf(stderr, "capstan: cannot write standard output: %s\n",
                strerror(errno ? errno : EIO));
        if (code == EXIT_OK || code == EXIT_NOT_CERTIFIED) code = EXIT_IO;
    }
    return code;
}
