/* SPDX-License-Identifier: BSD-3-Clause */
/* The reader of YAML by itself: numbers of the core schema, what no file may hold, places in a
 * tree, and the lines that are refused before they are parsed. */
#include <limits.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "capstan/base.h"
#include "io/base/yaml/pool.h"
#include "io/base/yaml/yaml.h"
#include "io/base/yaml/yaml_lines.h"

static void numbers(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double value;
    } NUMBER[] = {{"12", 12},         {"-1.5e3", -1500},   {"+.5", 0.5},         {"5.", 5},
                  {"1e-2", 0.01},     {"1E+2", 100},       {"0x1f", 31},         {"0o17", 15},
                  {".inf", INFINITY}, {"+.Inf", INFINITY}, {"-.INF", -INFINITY}, {"007", 7}};
    double x;
    for (size_t i = 0; i < sizeof NUMBER / sizeof *NUMBER; i++) {
        assert_true(cpsi_yaml_number(NUMBER[i].text, &x));
        assert_true(x == NUMBER[i].value);
    }
    static const char *const NOT_A_NUMBER[] = {".nan", ".NaN", ".NAN"};
    for (size_t i = 0; i < 3; i++) {
        assert_true(cpsi_yaml_number(NOT_A_NUMBER[i], &x));
        assert_true(isnan(x));
    }
    static const char *const NO_NUMBER[] = {"",     "x",   "-",     ".",    "e5",   "1e",
                                            "1e+",  "1x",  "0x",    "0xg",  "0o",   "0o8",
                                            "nan",  "inf", ".n",    "1 2",  "1.5.", "--1",
                                            "0x1 ", "- 1", "-.nan", ".infx"};
    for (size_t i = 0; i < sizeof NO_NUMBER / sizeof *NO_NUMBER; i++)
        if (cpsi_yaml_number(NO_NUMBER[i], &x)) fail_msg("'%s' is a number", NO_NUMBER[i]);
}

static CpsStatus parse(CpsiPool *pool, const char *text, CpsiYaml **root, CpsError *err) {
    return cpsi_yaml_parse("name", "scene", text, strlen(text), 8, pool, root, err);
}

static void assert_refused(const char *text, int line, int column, const char *why) {
    CpsiPool pool = {0};
    CpsiYaml *root;
    CpsError err = {0};
    const CpsStatus status = parse(&pool, text, &root, &err);
    cpsi_pool_free(&pool);
    if (status != CPS_ERR_INPUT || err.line != line || err.column != column ||
        !strstr(err.message, why))
        fail_msg("'%s': %s:%d:%d: %s", text, cps_status_name(status), err.line, err.column,
                 err.message);
}

static void what_no_file_may_hold(void **state) {
    (void)state;
    assert_refused("", 1, 1, "an empty file");
    assert_refused("a: 1\nb: \x7f\n", 2, 4, "control character");
    assert_refused("a: \xc2\x85\n", 1, 4, "control character");
    assert_refused("a: \xc3\x28\n", 1, 4, "not UTF-8");
    assert_refused("a: \"\\x07\"\n", 1, 4, "line break, a tab or a control character");
    assert_refused("a: \"\\N\"\n", 1, 4, "line break, a tab or a control character");
    /* the second of three that are the same, in whatever order they are sorted */
    assert_refused("b: 1\na: 1\nc: 1\na: 2\na: 3\n", 4, 1, "given twice, first in line 2");
    assert_refused("{b: 1, a: 1, c: 1, a: 2, a: 3}\n", 1, 20, "given twice, first in line 1");
    assert_refused("a: &x 1\n", 1, 5, "anchor");
    assert_refused("a: !x 1\n", 1, 4, "tag");
    /* an error is given back without a place for it, too */
    CpsiPool pool = {0};
    CpsiYaml *root;
    assert_int_equal(parse(&pool, "a: [\n", &root, NULL), CPS_ERR_INPUT);
    cpsi_pool_free(&pool);
    /* a message that is cut off in the middle of a character */
    CpsError err = {0};
    char text[400];
    memset(text, 'x', sizeof text);
    for (int i = 0; i < 199; i++) memcpy(text + 2 * i + 1, "\xc3\xa4", 2);
    text[399] = '\0';
    cpsi_fail_at(&err, CPS_ERR_INPUT, "name", 1, 1, "%s", text);
    for (const char *c = err.message; *c; c++) assert_true(*c == '?' || *c == 'x' || *c & 0x80);
}

static void places(void **state) {
    (void)state;
    CpsiPool pool = {0};
    CpsiYaml *root;
    CpsError err;
    assert_int_equal(parse(&pool, "a: {b.c: [1, {d: 2}], b: 3}\n'e': [[4]]\n", &root, &err),
                     CPS_OK);
    static const struct {
        const char *place, *text;
    } PLACE[] = {{"a.b.c[1]", "1"}, {"a.b.c[2].d", "2"}, {"a.b", "3"}, {"e[1][1]", "4"}};
    for (size_t i = 0; i < sizeof PLACE / sizeof *PLACE; i++)
        assert_string_equal(cpsi_yaml_at(root, PLACE[i].place)->text, PLACE[i].text);
    /* the nearest one around what is not there */
    const CpsiYaml *list = cpsi_yaml_at(root, "a.b.c");
    assert_int_equal(list->kind, CPSI_YAML_SEQUENCE);
    assert_ptr_equal(cpsi_yaml_at(root, "a.b.c[3]"), list);
    assert_ptr_equal(cpsi_yaml_at(root, "a.b.c.d"), list);
    assert_ptr_equal(cpsi_yaml_at(root, "z"), root);
    assert_ptr_equal(cpsi_yaml_at(root, ""), root);
    assert_null(cpsi_yaml_child(NULL, "a"));
    assert_null(cpsi_yaml_child(list, "a"));
    assert_null(cpsi_yaml_child(root, "z"));
    assert_non_null(cpsi_yaml_child(root, "e"));
    cpsi_pool_free(&pool);
}

static bool lines_are_good(const char *text, size_t size, int *line) {
    const char *found;
    return cpsi_yaml_lines(text, size, line, &found);
}

/* Empty lines with each line break, alone and cut off at the end of the file. */
static void lines(void **state) {
    (void)state;
    static const char *const BREAK[] = {"\n",       "\r",           "\r\n",        " \n",
                                        "\xc2\x85", "\xe2\x80\xa8", "\xe2\x80\xa9"};
    int line;
    for (size_t i = 0; i < sizeof BREAK / sizeof *BREAK; i++) {
        const size_t length = strlen(BREAK[i]);
        char text[3000];
        for (size_t n = 0; n < 600; n++) memcpy(text + n * length, BREAK[i], length);
        assert_true(lines_are_good(text, 500 * length, &line));
        assert_false(lines_are_good(text, 502 * length, &line));
        assert_int_equal(line, 501);
        for (size_t size = 0; size <= 2 * length; size++)
            assert_true(lines_are_good(text, size, &line));
    }
    char directive[100] = "\xef\xbb\xbf";
    memset(directive + 3, '%', 81);
    assert_false(lines_are_good(directive, 84, &line));
    assert_true(lines_are_good(directive, 83, &line));
    assert_true(lines_are_good("\xef\xbb", 2, &line));
    assert_true(lines_are_good("\xef\xbb\xbe", 3, &line));
    assert_true(lines_are_good("a\xc2\xa0\xe2\x80\x94\xe2\x82\xac b\xc2", 11, &line));
}

/* Sizes that no memory holds. */
static void pools(void **state) {
    (void)state;
    CpsiPool pool = {0};
    assert_null(cpsi_pool_take(&pool, SIZE_MAX, 2));
    assert_null(cpsi_pool_take(&pool, SIZE_MAX / 2, 1));
    assert_null(cpsi_pool_text(&pool, "", SIZE_MAX));
    for (int i = 0; i < 40; i++) assert_non_null(cpsi_pool_take(&pool, 100000, 1));
    cpsi_pool_free(&pool);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(numbers),
                                       cmocka_unit_test(what_no_file_may_hold),
                                       cmocka_unit_test(places), cmocka_unit_test(lines),
                                       cmocka_unit_test(pools)};
    return cmocka_run_group_tests_name("YAML", tests, NULL, NULL);
}
