/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan schema: the JSON schema of scene or law files on standard output. */
#include <stdio.h>
#include <string.h>

#include "capstan/law_io.h"
#include "commands.h"
#include "options.h"

int cmd_schema(int argc, char **argv) {
    CliOptions options;
    if (!cli_parse(argc, argv, FOR_SCHEMA, "[scene|law]", &options)) return EXIT_USAGE;
    CpsError err;
    CpsStatus status;
    if (!options.operand || strcmp(options.operand, "scene") == 0) {
        status = cps_scene_write_schema(stdout, &err);
    } else if (strcmp(options.operand, "law") == 0) {
        status = cps_law_write_schema(stdout, &err);
    } else {
        fprintf(stderr, "capstan schema: found '%s', expected scene or law\n", options.operand);
        return EXIT_USAGE;
    }
    return status == CPS_OK ? EXIT_OK : cli_report(&err);
}
