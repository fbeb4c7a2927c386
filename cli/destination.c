/* SPDX-License-Identifier: BSD-3-Clause */
/* The directory of a command's results (see destination.h). */
#include "destination.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "printable.h"

/* A name that consists only of dots would mean results itself, or its parent. */
static char *default_directory(const char *scene, const char *more) {
    const char *slash = strrchr(scene, '/');
    const char *stem = slash ? slash + 1 : scene;
    const char *dot = strrchr(stem, '.');
    size_t length = dot && dot != stem ? (size_t)(dot - stem) : strlen(stem);
    if (strcmp(scene, "-") == 0 || strspn(stem, ".") >= length) {
        stem = "scene";
        length = strlen(stem);
    }
    const size_t size = sizeof "results/" + length + strlen(more);
    char *path = malloc(size);
    if (path) snprintf(path, size, "results/%.*s%s", (int)length, stem, more);
    return path;
}

/* Report that the files in the directory belong to two runs. They remain until the command that
 * wrote them is run again. False after an error. */
static bool print_mixed(const char *directory, CpsError *err) {
    char missing[CPS_RESULT_NAME];
    if (cps_results_missing(directory, missing, err) != CPS_OK) return false;
    if (*missing)
        cli_printf(stderr,
                   "capstan: the files in %s are not all of one run: putting them in place was "
                   "interrupted, and %s is missing; the same command replaces them, `run` with "
                   "--resume or --force\n",
                   directory, missing);
    return true;
}

char *cli_destination(const CliOptions *options, CpsResultsKind kind, int line_count, int *code) {
    const char *more = kind == CPS_RESULTS_KIND_RUN           ? ""
                       : kind == CPS_RESULTS_KIND_REGULARIZED ? "-regularized"
                       : kind == CPS_RESULTS_KIND_OFFSET      ? "-offset"
                                                              : "-study";
    char *directory =
        options->output ? strdup(options->output) : default_directory(options->operand, more);
    CpsError err;
    *code = EXIT_LIMIT;
    if (!directory) {
        fprintf(stderr, "capstan: out of memory\n");
        return NULL;
    }
    /* the library makes the directory itself; its parent is made here only if it is `results` */
    if (!options->output && mkdir("results", 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "capstan: cannot make the directory results: %s; choose another with -o\n",
                strerror(errno));
        *code = EXIT_IO;
    } else if (cps_results_prepare(directory, kind, line_count, options->overwrite, &err) !=
                   CPS_OK ||
               !print_mixed(directory, &err)) {
        *code = cli_report(&err);
    } else {
        return directory;
    }
    free(directory);
    return NULL;
}
