/* SPDX-License-Identifier: BSD-3-Clause */
/* User text escaped for JSON, XML and CSV, and numbers that are read back unchanged.
 *
 * Names and titles come from scene files. Quotes, control characters, invalid UTF-8 and spreadsheet
 * formulas in them must remain text. Bytes that are not UTF-8 and control characters become U+FFFD
 * where the format has no escape for them. Numbers are printed in the calling thread's locale,
 * which the writers of results set to "C". */
#ifndef CAPSTAN_SRC_IO_BASE_TEXT_ESCAPE_H
#define CAPSTAN_SRC_IO_BASE_TEXT_ESCAPE_H

#include <stddef.h>
#include <stdio.h>

enum { CPSI_NUMBER_SIZE = 32 };

/* Length in bytes of the UTF-8 character at text, 0 if it is not one (RFC 3629). The text ends with
 * a zero byte. */
size_t cpsi_utf8_length(const char *text);

/* Longest start of text with at most `size` bytes that does not cut a character. */
size_t cpsi_utf8_cut(const char *text, size_t size);

/* The shortest of 15, 16 or 17 digits that reads back as x; "" when x is not finite. Returns
 * out. */
const char *cpsi_number(char out[CPSI_NUMBER_SIZE], double x);

void cpsi_write_json_string(FILE *out, const char *text);
void cpsi_write_json_number(FILE *out, double x); /* null when x is not finite */
void cpsi_write_xml(FILE *out, const char *text);
/* A cell in quotes; a cell that a spreadsheet would evaluate as a formula begins with an
 * apostrophe. */
void cpsi_write_csv(FILE *out, const char *text);
void cpsi_write_csv_number(FILE *out, double x); /* empty when x is not finite */

#endif
