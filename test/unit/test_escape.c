/* SPDX-License-Identifier: BSD-3-Clause */
/* Text made safe for JSON, XML and CSV: every kind of byte sequence, whole, cut off and too long.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/io.h"
#include "io/base/text/escape.h"

typedef void Writer(FILE *out, const char *text);

static void assert_written(Writer *write, const char *text, const char *expected) {
    char *found;
    size_t size;
    FILE *out = open_memstream(&found, &size);
    assert_non_null(out);
    write(out, text);
    assert_int_equal(fclose(out), 0);
    assert_string_equal(found, expected);
    free(found);
}

/* Sequences of UTF-8 at the edges of what Unicode allows (its standard, table 3-7), and just
 * beyond. */
static const struct {
    const char *text;
    size_t length; /* of its first character, 0: none */
} SEQUENCE[] = {{"", 0},
                {"a", 1},
                {"\x7f", 1},
                {"\x80", 0},
                {"\xc1\xbf", 0},
                {"\xc2\x80", 2},
                {"\xdf\xbf", 2},
                {"\xdf", 0},
                {"\xdf\x7f", 0},
                {"\xe0\x9f\xbf", 0},
                {"\xe0\xa0\x80", 3},
                {"\xe1\x80\x80", 3},
                {"\xe1\x80", 0},
                {"\xed\x9f\xbf", 3},
                {"\xed\xa0\x80", 0},
                {"\xef\xbf\xbf", 3},
                {"\xf0\x8f\xbf\xbf", 0},
                {"\xf0\x90\x80\x80", 4},
                {"\xf1\x80\x80\x80", 4},
                {"\xf4\x8f\xbf\xbf", 4},
                {"\xf4\x90\x80\x80", 0},
                {"\xf5\x80\x80\x80", 0},
                {"\xff", 0}};

static void lengths_of_characters(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof SEQUENCE / sizeof *SEQUENCE; i++)
        assert_int_equal(cpsi_utf8_length(SEQUENCE[i].text), SEQUENCE[i].length);
}

static void texts_are_cut_between_characters(void **state) {
    (void)state;
    assert_int_equal(cpsi_utf8_cut("abc", 3), 3);
    assert_int_equal(cpsi_utf8_cut("abc", 2), 2);
    assert_int_equal(cpsi_utf8_cut("a\xe2\x82\xac", 3), 1);
    assert_int_equal(cpsi_utf8_cut("\xe2\x82\xac", 2), 0);
    assert_int_equal(cpsi_utf8_cut("\x80\x80\x80", 2), 0); /* no character begins here */
}

static void json_text(void **state) {
    (void)state;
    assert_written(cps_json_text, NULL, "\"\"");
    assert_written(cps_json_text, "a\"b\\c", "\"a\\\"b\\\\c\"");
    assert_written(cps_json_text, "\x1f\x7f\xc2\x80\xc2\x9f", "\"\\u001f\\u007f\\u0080\\u009f\"");
    assert_written(cps_json_text, "\xc2\xa0\xc3\x80", "\"\xc2\xa0\xc3\x80\"");
    assert_written(cps_json_text, "\xe2\x82\xac\xf0\x9f\x98\x80",
                   "\"\xe2\x82\xac\xf0\x9f\x98\x80\"");
    assert_written(cps_json_text, "x\xff\xe2\x82", "\"x\\ufffd\\ufffd\\ufffd\"");
    cps_json_text(NULL, "nothing is written");
}

#define LOST "\xef\xbf\xbd"
static void xml_and_csv_text(void **state) {
    (void)state;
    assert_written(cpsi_write_xml, "<a b=\"'&'\">", "&lt;a b=&quot;&#39;&amp;&#39;&quot;&gt;");
    static Writer *const PLAIN[] = {cpsi_write_xml, cpsi_write_csv};
    /* what neither may hold: control characters, and the two code points U+FFFE and U+FFFF */
    static const char *const TEXT[][2] = {{"x\x1f", "x" LOST},
                                          {"x\x7f", "x" LOST},
                                          {"x\xc2\x85", "x" LOST},
                                          {"x\xc2\xa0", "x\xc2\xa0"},
                                          {"x\xc3\x80", "x\xc3\x80"},
                                          {"x\xff", "x" LOST},
                                          {"x\xef\xbf\xbe", "x" LOST},
                                          {"x\xef\xbf\xbd", "x\xef\xbf\xbd"},
                                          {"x\xef\xbe\xbf", "x\xef\xbe\xbf"},
                                          {"x\xe2\xbf\xbf", "x\xe2\xbf\xbf"},
                                          {"x\xf0\x9f\x98\x80", "x\xf0\x9f\x98\x80"}};
    for (size_t i = 0; i < sizeof TEXT / sizeof *TEXT; i++) {
        char quoted[32];
        snprintf(quoted, sizeof quoted, "\"%s\"", TEXT[i][1]);
        assert_written(PLAIN[0], TEXT[i][0], TEXT[i][1]);
        assert_written(PLAIN[1], TEXT[i][0], quoted);
    }
    assert_written(cpsi_write_csv, "", "\"\"");
    assert_written(cpsi_write_csv, "a\"b", "\"a\"\"b\"");
    /* what a spreadsheet takes for a formula */
    assert_written(cpsi_write_csv, "=1+1", "\"'=1+1\"");
}

static void numbers_come_back(void **state) {
    (void)state;
    static const double NUMBER[] = {0,       -0.0,   1,      0.1,  1.0 / 3, 0.30000000000000004,
                                    1e100,   1e-300, 5e-324, 1e23, 2.0 / 3, 123456789.12345678,
                                    -1.5e-7, 1.1e308};
    char text[CPSI_NUMBER_SIZE];
    for (size_t i = 0; i < sizeof NUMBER / sizeof *NUMBER; i++)
        assert_true(strtod(cpsi_number(text, NUMBER[i]), NULL) == NUMBER[i]);
    assert_string_equal(cpsi_number(text, 0.1), "0.1");
    assert_string_equal(cpsi_number(text, 0.30000000000000004), "0.30000000000000004");
    assert_string_equal(cpsi_number(text, NAN), "");
    assert_string_equal(cpsi_number(text, INFINITY), "");
    cps_json_number(NULL, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(lengths_of_characters),
                                       cmocka_unit_test(texts_are_cut_between_characters),
                                       cmocka_unit_test(json_text),
                                       cmocka_unit_test(xml_and_csv_text),
                                       cmocka_unit_test(numbers_come_back)};
    return cmocka_run_group_tests_name("text made safe", tests, NULL, NULL);
}
