/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan schema: the JSON schema of scene files on standard output. */
#include <stdio.h>

#include "capstan/io.h"
#include "commands.h"

int cmd_schema(int argc, char **argv) {
    (void)argc, (void)argv;
    CpsError err;
    return cps_scene_write_schema(stdout, &err) == CPS_OK ? EXIT_OK : cli_report(&err);
}
