/* SPDX-License-Identifier: BSD-3-Clause */
/* Text made safe for JSON (RFC 8259), XML 1.0 and CSV (RFC 4180); see escape.h. */
#include "io/base/text/escape.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/io.h"

static const char REPLACEMENT[] = "\xEF\xBF\xBD"; /* U+FFFD */

size_t cpsi_utf8_length(const char *text) {
    const unsigned char *s = (const unsigned char *)text;
    if (s[0] < 0x80) return s[0] ? 1 : 0;
    const size_t length = s[0] >= 0xF0 ? 4 : s[0] >= 0xE0 ? 3 : 2;
    if (s[0] < 0xC2 || s[0] > 0xF4) return 0;
    for (size_t i = 1; i < length; ++i)
        if ((s[i] & 0xC0) != 0x80) return 0;
    /* overlong forms, surrogates and code points beyond U+10FFFF */
    if (s[0] == 0xE0 && s[1] < 0xA0) return 0;
    if (s[0] == 0xED && s[1] > 0x9F) return 0;
    if (s[0] == 0xF0 && s[1] < 0x90) return 0;
    if (s[0] == 0xF4 && s[1] > 0x8F) return 0;
    return length;
}

size_t cpsi_utf8_cut(const char *text, size_t size) {
    const size_t length = strlen(text);
    if (length <= size) return length;
    while (size > 0 && ((unsigned char)text[size] & 0xC0) == 0x80) --size;
    return size;
}

/* C0, delete and C1 control characters, and the two code points XML does not allow */
static bool is_control(const char *text, size_t length) {
    const unsigned char *s = (const unsigned char *)text;
    if (length == 1) return s[0] < 0x20 || s[0] == 0x7F;
    if (length == 2) return s[0] == 0xC2 && s[1] < 0xA0;
    return length == 3 && s[0] == 0xEF && s[1] == 0xBF && s[2] >= 0xBE;
}

const char *cpsi_number(char out[CPSI_NUMBER_SIZE], double x) {
    out[0] = '\0';
    if (!isfinite(x)) return out;
    for (int digits = 15; digits < 17; ++digits) {
        snprintf(out, CPSI_NUMBER_SIZE, "%.*g", digits, x);
        if (strtod(out, NULL) == x) return out;
    }
    snprintf(out, CPSI_NUMBER_SIZE, "%.17g", x); /* always suffices */
    return out;
}

void cpsi_write_json_string(FILE *out, const char *text) {
    fputc('"', out);
    while (*text) {
        const size_t length = cpsi_utf8_length(text);
        if (length == 0)
            fputs("\\ufffd", out);
        else if (*text == '"' || *text == '\\')
            fprintf(out, "\\%c", *text);
        else if (length == 1 && is_control(text, 1))
            fprintf(out, "\\u%04x", (unsigned)*text);
        else if (length == 2 && is_control(text, 2))
            fprintf(out, "\\u%04x", (unsigned char)text[1]);
        else
            fwrite(text, 1, length, out);
        text += length ? length : 1;
    }
    fputc('"', out);
}

void cpsi_write_json_number(FILE *out, double x) {
    char buffer[CPSI_NUMBER_SIZE];
    fputs(isfinite(x) ? cpsi_number(buffer, x) : "null", out);
}

/* one character of XML or CSV text without a special meaning there */
static size_t write_plain(FILE *out, const char *text) {
    const size_t length = cpsi_utf8_length(text);
    if (length == 0 || is_control(text, length))
        fputs(REPLACEMENT, out);
    else
        fwrite(text, 1, length, out);
    return length ? length : 1;
}

void cpsi_write_xml(FILE *out, const char *text) {
    while (*text) {
        switch (*text) {
        case '&':
            fputs("&amp;", out);
            ++text;
            break;
        case '<':
            fputs("&lt;", out);
            ++text;
            break;
        case '>':
            fputs("&gt;", out);
            ++text;
            break;
        case '"':
            fputs("&quot;", out);
            ++text;
            break;
        case '\'':
            fputs("&#39;", out);
            ++text;
            break;
        default: text += write_plain(out, text);
        }
    }
}

void cpsi_write_csv(FILE *out, const char *text) {
    fputc('"', out);
    if (*text && strchr("=+-@\t\r", *text)) fputc('\'', out);
    while (*text) {
        if (*text == '"') {
            fputs("\"\"", out);
            ++text;
        } else {
            text += write_plain(out, text);
        }
    }
    fputc('"', out);
}

void cpsi_write_csv_number(FILE *out, double x) {
    char buffer[CPSI_NUMBER_SIZE];
    fputs(cpsi_number(buffer, x), out);
}

/* ---- public functions ---- */

void cps_json_text(FILE *out, const char *text) {
    if (out) cpsi_write_json_string(out, text ? text : "");
}

void cps_json_number(FILE *out, double x) {
    if (out) cpsi_write_json_number(out, x);
}
