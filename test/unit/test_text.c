/* SPDX-License-Identifier: BSD-3-Clause */
/* Text shared by library and command: rows of numbers, suggestions, files written as a whole. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "capstan/io.h"

/* ---- rows of numbers ---- */

/* `text` has the numbers 1, 2, .. and then `rest`. */
static void assert_row(const char *text, const char *separators, int most, int count,
                       const char *rest) {
    double value[4] = {NAN, NAN, NAN, NAN};
    const char *found;
    assert_int_equal(cps_row_read(text, separators, most, value, &found), count);
    assert_string_equal(found, rest);
    for (int i = 0; i < count; i++) assert_true(value[i] == i + 1);
}

static void rows_are_read(void **state) {
    (void)state;
    assert_row("1", ",", 4, 1, "");
    assert_row(" 1 ,\t2.0,3e0\r\n", ",", 4, 3, "");
    assert_row("1,2,3,4", ",", 4, 4, "");
    assert_row("1,2,3,4", ",", 3, 3, ",4");
    assert_row("1 2", " ,;", 2, 2, "");
    assert_row("1;2 , 3", " ,;", 4, 3, "");
}

static void other_text_ends_a_row(void **state) {
    (void)state;
    assert_row("", ",", 4, 0, "");
    assert_row("x, y", ",", 4, 0, "x, y");
    assert_row("1,,2", ",", 4, 1, ",,2");
    assert_row("1,2,", ",", 4, 2, ",");
    assert_row("1 2", ",", 4, 1, "2");
    assert_row("1;2", ",", 4, 1, ";2");
    assert_row("1,2m", ",", 4, 2, "m");
    assert_row("1,nan", ",", 4, 1, ",nan");
    assert_row("1,inf", ",", 4, 1, ",inf");
    assert_row("1,1.1e100", ",", 4, 1, ",1.1e100");
    assert_row("-2e100", ",", 4, 0, "-2e100");
    assert_row("1x2", " ,", 4, 1, "x2");
}

/* ---- suggestions ---- */

static const char *nearest(const char *word) {
    static const char *const WORD[] = {"length", "tolerance", "tol", "velocity", "quiet"};
    CpsSuggestion suggestion = {.word = word};
    for (size_t i = 0; i < sizeof WORD / sizeof *WORD; i++) cps_suggest(&suggestion, WORD[i]);
    return suggestion.best ? suggestion.best : "none";
}

static void nearest_word_is_found(void **state) {
    (void)state;
    assert_string_equal(nearest("lenght"), "length");
    assert_string_equal(nearest("LENGTH"), "length");
    assert_string_equal(nearest("tol"), "tol");
    assert_string_equal(nearest("tole"), "tolerance");
    assert_string_equal(nearest("vel"), "velocity");
    assert_string_equal(nearest("quite"), "quiet");
    assert_string_equal(nearest("v"), "none");
    assert_string_equal(nearest(""), "none");
    assert_string_equal(nearest("mass"), "none");
    assert_string_equal(nearest("lengthlengthlengthlengthlengthlength"), "none");
}

/* ---- files ---- */

/* Writes `user`, or fails after half of it where that begins with '!'. */
static CpsStatus write_text(void *user, FILE *out, CpsError *err) {
    fputs(user, out);
    if (*(const char *)user != '!') return CPS_OK;
    *err = (CpsError){.status = CPS_ERR_INPUT, .message = "given up"};
    return CPS_ERR_INPUT;
}

static void assert_content(const char *path, const char *expected) {
    char text[64] = "";
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_true(fread(text, 1, sizeof text - 1, file) < sizeof text);
    fclose(file);
    assert_string_equal(text, expected);
}

static void file_is_written_completely_or_not(void **state) {
    (void)state;
    CpsError err;
    char first[] = "first", second[] = "second", half[] = "!half";
    const char folder[] = "text-write", path[] = "text-write/text";
    (void)mkdir(folder, 0777);
    assert_int_equal(cps_write_file(path, write_text, first, &err), CPS_OK);
    assert_content(path, "first");
    assert_int_equal(cps_write_file(path, write_text, second, &err), CPS_OK);
    assert_content(path, "second");
    assert_int_equal(cps_write_file(path, write_text, half, &err), CPS_ERR_INPUT);
    assert_string_equal(err.message, "given up");
    assert_content(path, "second");
    assert_int_equal(cps_write_file(folder, write_text, first, &err), CPS_ERR_IO);
    assert_string_equal(err.file, folder);
    assert_int_equal(cps_write_file("text-none/text", write_text, first, &err), CPS_ERR_IO);
    assert_int_equal(cps_write_file("/dev/full", write_text, first, &err), CPS_ERR_IO);
    assert_int_equal(cps_write_file("/dev/null", write_text, first, &err), CPS_OK);
    assert_int_equal(cps_write_file(NULL, write_text, first, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_write_file(path, NULL, first, &err), CPS_ERR_ARGUMENT);
    /* no temporary file is left: the folder is empty once the file has been removed */
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_read),
        cmocka_unit_test(other_text_ends_a_row),
        cmocka_unit_test(nearest_word_is_found),
        cmocka_unit_test(file_is_written_completely_or_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
