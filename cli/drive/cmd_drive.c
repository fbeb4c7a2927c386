/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan drive: read a driven system, compute its motion of least dissipation, draw it. */
#include <limits.h>
#include <string.h>

#include "drive/system_answer.h"
#include "law/set_answer.h"
#include "printable.h"

static const char *const KIND[] = {"system", "body", "planimeter", "rope", "sweep"};

/* refuse options that belong to other kinds of file */
static int check_options(const CliOptions *options, CpsDriveKind kind) {
    const bool asked =
        options->velocity.count > 0 || options->force.count > 0 || options->eliminate;
    if (asked && kind != CPS_DRIVE_SYSTEM) {
        fprintf(stderr,
                "capstan drive: --velocity, --force and --eliminate go with 'system'; found '%s', "
                "which says in the file how it is driven\n",
                KIND[kind]);
        return EXIT_USAGE;
    }
    if (options->force.count > 0 && !options->eliminate) {
        fprintf(stderr, "capstan drive: --force asks the reduced law: add --eliminate\n");
        return EXIT_USAGE;
    }
    if (options->axes && !(options->plot && options->eliminate)) {
        fprintf(stderr, "capstan drive: --axes goes with --eliminate --plot\n");
        return EXIT_USAGE;
    }
    return EXIT_OK;
}

static int answer(DriveRun *run) {
    static int (*const ANSWER[])(DriveRun *) = {drive_answer_system, drive_answer_body,
                                                drive_answer_planimeter, drive_answer_rope,
                                                drive_answer_sweep};
    const CpsDriveFile *file = run->file;
    const char *kind =
        file->kind == CPS_DRIVE_BODY && file->body.vehicle ? "vehicle" : KIND[file->kind];
    if (run->json) {
        fputs("{\"title\": ", stdout);
        cps_json_text(stdout, file->title);
        printf(", \"kind\": \"%s\"", kind);
    } else if (*file->title) {
        cli_print_text(stdout, file->title, INT_MAX, false);
        putchar('\n');
    }
    const int code = ANSWER[file->kind](run);
    if (run->json) puts("}");
    return code;
}

int cmd_drive(int argc, char **argv) {
    CliOptions options;
    if (!cli_parse(argc, argv, FOR_DRIVE, "DRIVE.yaml", &options)) return EXIT_USAGE;
    CpsDriveFile *file = NULL;
    DriveRun run = {.options = &options, .json = options.json, .answered = true};
    int code = law_query_check_input("drive", options.operand, &options.velocity, &options.force);
    if (code != EXIT_OK) return code;
    if (cps_drive_read(options.operand, NULL, &file, &run.err) != CPS_OK)
        return cli_report(&run.err);
    run.file = file;
    code = check_options(&options, file->kind);
    if (code == EXIT_OK) code = answer(&run);
    cps_drive_file_destroy(file);
    if (code != EXIT_OK) return code;
    return !run.answered ? EXIT_NOT_CERTIFIED : run.none ? EXIT_NO_SOLUTION : EXIT_OK;
}
