/* SPDX-License-Identifier: BSD-3-Clause */
/* Printing text that does not come from the program (see printable.h). */
#include "printable.h"

#include <limits.h>
#include <stdarg.h>
#include <string.h>

void cli_print_text(FILE *out, const char *text, int width, bool pad) {
    int used = 0;
    for (const unsigned char *c = (const unsigned char *)text; *c && used < width; ++c) {
        const bool c1 = c[0] == 0xC2 && c[1] >= 0x80 && c[1] < 0xA0;
        if (*c < 0x20 || *c == 0x7F || c1) {
            fputc('?', out);
            c += c1;
        } else {
            fputc(*c, out);
            /* the following bytes of the same character */
            while (*c >= 0x80 && (c[1] & 0xC0) == 0x80) fputc(*++c, out);
        }
        ++used;
    }
    if (pad)
        while (used++ < width) fputc(' ', out);
}

void cli_printf(FILE *out, const char *format, ...) {
    char text[4000];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *line = text, *end; *line; line = end) {
        end = line + strcspn(line, "\n");
        const bool more = *end == '\n';
        *end = '\0';
        cli_print_text(out, line, INT_MAX, false);
        if (more) {
            fputc('\n', out);
            end++;
        }
    }
}
