/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan schema: the JSON schema of scenes, laws or driven systems on standard output. */
#include <stdio.h>
#include <string.h>

#include "capstan/io.h"
#include "commands.h"
#include "options.h"
#include "printable.h"

int cmd_schema(int argc, char **argv) {
    static const struct {
        const char *name;
        CpsStatus (*write)(FILE *out, CpsError *err);
    } KIND[] = {{"scene", cps_scene_write_schema},
                {"law", cps_law_write_schema},
                {"drive", cps_drive_write_schema}};
    CliOptions options;
    if (!cli_parse(argc, argv, FOR_SCHEMA, "[scene|law|drive]", &options)) return EXIT_USAGE;
    for (size_t k = 0; k < sizeof KIND / sizeof KIND[0]; k++) {
        CpsError err;
        if (options.operand && strcmp(options.operand, KIND[k].name) != 0) continue;
        const CpsStatus status = KIND[k].write(stdout, &err);
        if (status == CPS_ERR_IO) snprintf(err.file, sizeof err.file, "standard output");
        return status == CPS_OK ? EXIT_OK : cli_report(&err);
    }
    cli_printf(stderr, "capstan schema: found '%s', expected scene, law or drive\n",
               options.operand);
    return EXIT_USAGE;
}
