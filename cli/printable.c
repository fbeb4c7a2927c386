/* SPDX-License-Identifier: BSD-3-Clause */
/* Printing text that does not come from the program (see printable.h). */
#include "printable.h"

#include <limits.h>
#include <stdarg.h>
#include <string.h>

/* The bytes of a character at c that controls a terminal: a control character of ASCII or its
 * second set (U+0080 to U+009F), or one that changes the order or the lines in which text is shown
 * (U+061C, U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069). 0 if it is none. */
static int control_size(const unsigned char *c) {
    if (*c < 0x20 || *c == 0x7F) return 1;
    if (c[0] == 0xC2 && c[1] >= 0x80 && c[1] < 0xA0) return 2;
    if (c[0] == 0xD8 && c[1] == 0x9C) return 2;
    if (c[0] != 0xE2) return 0;
    const bool orders =
        c[1] == 0x80 && (c[2] == 0x8E || c[2] == 0x8F || (c[2] >= 0xA8 && c[2] <= 0xAE));
    const bool isolates = c[1] == 0x81 && c[2] >= 0xA6 && c[2] <= 0xA9;
    return orders || isolates ? 3 : 0;
}

/* Length in bytes of the UTF-8 character at c (RFC 3629), 0 if it is not one. */
static int character_length(const unsigned char *c) {
    const int length = c[0] < 0x80 ? 1 : c[0] < 0xC2 ? 0 : c[0] < 0xE0 ? 2 : c[0] < 0xF0 ? 3 : 4;
    for (int i = 1; i < length; ++i)
        if ((c[i] & 0xC0) != 0x80) return 0;
    const bool outside = c[0] > 0xF4 || (c[0] == 0xF4 && c[1] > 0x8F) || /* beyond U+10FFFF */
                         (c[0] == 0xE0 && c[1] < 0xA0) || (c[0] == 0xF0 && c[1] < 0x90) ||
                         (c[0] == 0xED && c[1] > 0x9F); /* written too long, surrogates */
    return outside ? 0 : length;
}

void cli_print_text(FILE *out, const char *text, int width, bool pad) {
    int used = 0;
    for (const unsigned char *c = (const unsigned char *)text; *c && used < width; ++used) {
        const int length = character_length(c);
        if (length == 0 || control_size(c) > 0)
            fputc('?', out); /* 0x9B begins a sequence on a terminal of eight bits */
        else
            fwrite(c, 1, (size_t)length, out);
        c += length ? length : 1;
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
