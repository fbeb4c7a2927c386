/* SPDX-License-Identifier: BSD-3-Clause */
/* Text that does not come from the program: names and titles of files, arguments. Control
 * characters are replaced, so that none of it can steer a terminal. */
#ifndef CAPSTAN_CLI_PRINTABLE_H
#define CAPSTAN_CLI_PRINTABLE_H

#include <stdbool.h>
#include <stdio.h>

/* At most `width` characters of the text, padded to it when pad is set. */
void cli_print_text(FILE *out, const char *text, int width, bool pad);

/* fprintf; line ends stay, and what is longer than 4000 bytes is cut. */
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
void cli_printf(FILE *out, const char *format, ...);

#endif
