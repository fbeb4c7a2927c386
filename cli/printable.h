/* SPDX-License-Identifier: BSD-3-Clause */
/* Printing text that does not come from the program: names and titles of files, arguments. Control
 * characters, those that change the direction of text, and bytes that are not UTF-8 are replaced,
 * so that none of them can control a terminal or show a text other than it is. */
#ifndef CAPSTAN_CLI_PRINTABLE_H
#define CAPSTAN_CLI_PRINTABLE_H

#include <stdbool.h>
#include <stdio.h>

/* Print at most `width` characters of the text; where `pad` is set, fill up with blanks. */
void cli_print_text(FILE *out, const char *text, int width, bool pad);

/* As fprintf. Line ends are kept, and the text after 4000 bytes is dropped. */
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
void cli_printf(FILE *out, const char *format, ...);

#endif
