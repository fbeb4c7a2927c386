/* SPDX-License-Identifier: BSD-3-Clause */
/* A check of the lines of a file before libfyaml parses it (see yaml_lines.h). */
#include "io/base/yaml/yaml_lines.h"

#include <limits.h>
#include <string.h>

/* A directive is '%YAML 1.2'; empty lines separate sections. For both, and for blanks after '-',
 * '?', '!' or a quote, libfyaml 0.7 to 0.9 needs quadratic time: 160 kB of '%' take half a minute,
 * and so do 40 kB of line breaks in a block text, 40 000 directives '%TAG' and 250 kB of blanks in
 * one run. Within these limits a file of 1 MB takes less than a second. */
enum { DIRECTIVE_MOST = 80, DIRECTIVES_MOST = 100, EMPTY_MOST = 500, BLANKS_MOST = 1000 };

/* Length of the line break at s, 0: none. YAML 1.1, which a directive can select, also has U+0085,
 * U+2028 and U+2029. */
static size_t line_break(const char *s, size_t left) {
    if (s[0] == '\r') return left > 1 && s[1] == '\n' ? 2 : 1;
    if (s[0] == '\n') return 1;
    if (!(s[0] & 0x80)) return 0; /* the others are not ASCII */
    if (left > 1 && memcmp(s, "\xc2\x85", 2) == 0) return 2;
    return left > 2 && (memcmp(s, "\xe2\x80\xa8", 3) == 0 || memcmp(s, "\xe2\x80\xa9", 3) == 0) ? 3
                                                                                                : 0;
}

bool cpsi_yaml_lines(const char *bytes, size_t size, int *line, const char **found) {
    size_t at = size > 2 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0, empty = 0;
    int directives = 0;
    for (*line = 1; at < size; *line += *line < INT_MAX) {
        const size_t begin = at;
        bool blank = true;
        size_t after = 0, run = 0, longest = 0;
        for (; at < size && !(after = line_break(bytes + at, size - at)); ++at) {
            const bool here = bytes[at] == ' ' || bytes[at] == '\t';
            run = here ? run + 1 : 0;
            longest = run > longest ? run : longest;
            blank = blank && here;
        }
        *found = "more than 1000 blanks one after another: remove some";
        if (longest > BLANKS_MOST) return false;
        *found = "a long line that begins with '%': a directive is '%YAML 1.2'";
        if (bytes[begin] == '%' && at - begin > DIRECTIVE_MOST) return false;
        *found = "more than 100 lines that begin with '%': a directive is '%YAML 1.2'";
        if (bytes[begin] == '%' && ++directives > DIRECTIVES_MOST) return false;
        *found = "more than 500 empty lines one after another: remove some";
        empty = blank ? empty + 1 : 0;
        if (empty > EMPTY_MOST) return false;
        at += after;
    }
    return true;
}
