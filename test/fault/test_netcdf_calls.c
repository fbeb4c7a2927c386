/* SPDX-License-Identifier: BSD-3-Clause */
/* libnetcdf is not there, lacks one of its functions, or each call of it fails in turn: the run
 * says that result.nc cannot be written, and leaves nothing. The functions that open a library, and
 * the clock, are replaced (linked with --wrap). */
#include <dlfcn.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>
#include <netcdf.h>

#include "io/results/writers.h"
#include "small_run.h"

void *__real_dlopen(const char *path, int how);
void *__real_dlsym(void *handle, const char *name);
void *__wrap_dlopen(const char *path, int how);
void *__wrap_dlsym(void *handle, const char *name);
int __real_timespec_get(struct timespec *now, int base);
int __wrap_timespec_get(struct timespec *now, int base);

static bool none;             /* there is no library */
static int asked, lacks;      /* functions asked for so far; the one that is missing, from 0 */
static long called, fails_at; /* calls so far; the one that fails, from 0 */
static int why;               /* what it returns */
static enum { WORKS, STOPPED, BEYOND_YEARS } clock_state;
static bool clock_asked;

static bool fails(void) { return called++ == fails_at; }

/* One function of the library, which may fail. */
#define FUNCTION(name, parameters, arguments)  \
    static __typeof__(nc_##name) *real_##name; \
    static int fake_##name parameters { return fails() ? why : real_##name arguments; }
typedef const size_t *Sizes;
FUNCTION(create, (const char *path, int how, int *id), (path, how, id))
FUNCTION(set_fill, (int id, int mode, int *before), (id, mode, before))
FUNCTION(def_dim, (int id, const char *name, size_t n, int *to), (id, name, n, to))
FUNCTION(def_var, (int id, const char *name, nc_type type, int n, const int *shape, int *to),
         (id, name, type, n, shape, to))
FUNCTION(enddef, (int id), (id))
FUNCTION(sync, (int id), (id))
static __typeof__(nc_close) *real_close; /* what it holds is given back even so */
static int fake_close(int id) {
    const int status = real_close(id);
    return fails() ? why : status;
}
FUNCTION(put_att_text, (int id, int of, const char *name, size_t n, const char *text),
         (id, of, name, n, text))
FUNCTION(put_att_int, (int id, int of, const char *name, nc_type type, size_t n, const int *x),
         (id, of, name, type, n, x))
FUNCTION(put_att_double,
         (int id, int of, const char *name, nc_type type, size_t n, const double *x),
         (id, of, name, type, n, x))
FUNCTION(put_var_double, (int id, int of, const double *x), (id, of, x))
FUNCTION(put_var1_int, (int id, int of, Sizes at, const int *x), (id, of, at, x))
FUNCTION(put_vara_text, (int id, int of, Sizes at, Sizes n, const char *x), (id, of, at, n, x))
FUNCTION(put_vara_int, (int id, int of, Sizes at, Sizes n, const int *x), (id, of, at, n, x))
FUNCTION(put_vara_uchar, (int id, int of, Sizes at, Sizes n, const unsigned char *x),
         (id, of, at, n, x))
FUNCTION(put_vara_double, (int id, int of, Sizes at, Sizes n, const double *x), (id, of, at, n, x))

static void *replace(const char *name, void *found) {
#define SWAP(function)                                      \
    if (strcmp(name, "nc_" #function) == 0) {               \
        __typeof__(real_##function) fake = fake_##function; \
        memcpy(&real_##function, &found, sizeof found);     \
        memcpy(&found, &fake, sizeof found);                \
    }
    SWAP(create)
    SWAP(set_fill)
    SWAP(def_dim)
    SWAP(def_var)
    SWAP(enddef)
    SWAP(sync)
    SWAP(close)
    SWAP(put_att_text)
    SWAP(put_att_int)
    SWAP(put_att_double)
    SWAP(put_var_double)
    SWAP(put_var1_int)
    SWAP(put_vara_text)
    SWAP(put_vara_int)
    SWAP(put_vara_uchar)
    SWAP(put_vara_double)
    return found;
}

/* none of this name: the linker says why */
void *__wrap_dlopen(const char *path, int how) {
    return __real_dlopen(none ? "libnetcdf-is-not-here.so" : path, how);
}
void *__wrap_dlsym(void *handle, const char *name) {
    if (asked++ == lacks) return NULL;
    return replace(name, __real_dlsym(handle, name));
}

/* BEYOND_YEARS: its year is no int. */
int __wrap_timespec_get(struct timespec *now, int base) {
    clock_asked = true;
    if (clock_state == STOPPED) return 0;
    const int answer = __real_timespec_get(now, base);
    if (clock_state == BEYOND_YEARS) now->tv_sec = INT64_MAX;
    return answer;
}

/* Elements that the next line seen has, 0: as many as it has. */
static int huge;
CpsLineView __real_cps_evolution_line_view(const CpsEvolution *evolution, int line);
CpsLineView __wrap_cps_evolution_line_view(const CpsEvolution *evolution, int line);
CpsLineView __wrap_cps_evolution_line_view(const CpsEvolution *evolution, int line) {
    CpsLineView view = __real_cps_evolution_line_view(evolution, line);
    if (huge > 0) view.element_count = huge;
    huge = 0;
    return view;
}

static CpsStatus run(CpsError *err) {
    asked = 0;
    called = 0;
    const CpsStatus status = small_run("netcdf-out", 3, err);
    if (status != CPS_OK) {
        assert_int_not_equal(access("netcdf-out", F_OK), 0);
        assert_non_null(strstr(err->message, "result.nc"));
    }
    return status;
}

static int start(void **state) {
    (void)state;
    none = false;
    lacks = -1;
    fails_at = -1;
    why = NC_EHDFERR;
    clock_state = WORKS;
    clock_asked = false;
    return system("rm -rf netcdf-out");
}

static void no_library(void **state) {
    (void)state;
    CpsError err;
    none = true;
    if (run(&err) == CPS_OK) skip(); /* built as shared libraries it cannot be reached */
    assert_int_equal(err.status, CPS_ERR_IO);
    assert_non_null(strstr(err.message, "without"));
    assert_non_null(strstr(err.message, "libnetcdf-is-not-here.so"));
}

/* A line of more nodes than a record of result.nc can hold is refused before anything is opened. */
static void too_many_nodes(void **state) {
    (void)state;
    const double point[6] = {0, 0, 0, 6, 0, 0};
    const CpsLine line = small_rope(3, point);
    const CpsResultsOptions options = cps_results_options_default();
    CpsScene scene = cps_scene_default();
    scene.line_count = 1;
    scene.line = &line;
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    CpsiNetcdf *netcdf = NULL;
    assert_int_equal(cps_evolution_create(&scene, &evolution, &err), CPS_OK);
    huge = 178956970; /* 4294967292 bytes hold one node less, with 3 doubles each */
    const CpsStatus status =
        cpsi_netcdf_open("netcdf-huge.nc", &scene, evolution, &options, &netcdf, &err);
    const bool reached = huge == 0;
    huge = 0;
    cps_evolution_destroy(evolution);
    if (!reached) skip();
    assert_int_equal(status, CPS_ERR_LIMIT);
    assert_null(netcdf);
    assert_non_null(strstr(err.message, "178956970 elements"));
    assert_int_not_equal(access("netcdf-huge.nc", F_OK), 0);
}

static void a_function_is_missing(void **state) {
    (void)state;
    CpsError err;
    const CpsStatus whole = run(&err);
    const int functions = asked;
    assert_int_equal(whole, CPS_OK);
    if (functions == 0) skip();
    for (int i = 0; i < functions; i++) {
        assert_int_equal(start(NULL), 0);
        lacks = i;
        assert_int_equal(run(&err), CPS_ERR_IO);
        assert_non_null(strstr(err.message, "lacks a function"));
    }
}

static void each_call_fails(void **state) {
    (void)state;
    CpsError err;
    assert_int_equal(run(&err), CPS_OK);
    const long calls = called;
    if (calls == 0) skip();
    /* the definitions alone are more: 30 variables with their names and units */
    assert_in_range(calls, 100, 100000);
    for (long k = 0; k < calls; k++) {
        assert_int_equal(start(NULL), 0);
        fails_at = k;
        if (k % 7 == 0) why = NC_ENOMEM;
        const CpsStatus status = run(&err);
        if (status != (why == NC_ENOMEM ? CPS_ERR_MEMORY : CPS_ERR_IO))
            fail_msg("call %ld of %ld: %s: %s", k, calls, cps_status_name(status), err.message);
    }
    print_message("%ld calls of the library, each failed once\n", calls);
}

/* The attribute `history` of the file that a run has written. */
static void read_history(char *text, size_t size) {
    CpsError err;
    int id;
    size_t length;
    assert_int_equal(run(&err), CPS_OK);
    assert_int_equal(nc_open("netcdf-out/result.nc", NC_NOWRITE, &id), NC_NOERR);
    assert_int_equal(nc_inq_attlen(id, NC_GLOBAL, "history", &length), NC_NOERR);
    assert_in_range(length, 1, size - 1);
    memset(text, 0, size);
    assert_int_equal(nc_get_att_text(id, NC_GLOBAL, "history", text), NC_NOERR);
    assert_int_equal(nc_close(id), NC_NOERR);
}

/* Without a clock the file says by what it was written, and no time. */
static void no_clock(void **state) {
    (void)state;
    char text[128], expected[128];
    snprintf(expected, sizeof expected, "written by capstan %s", cps_version());
    read_history(text, sizeof text);
    if (!clock_asked) skip();
    assert_string_equal(strstr(text, "written"), expected);
    assert_true(text[4] == '-' && text[10] == 'T' && strtol(text, NULL, 10) > 2000);
    clock_state = STOPPED;
    read_history(text, sizeof text);
    assert_string_equal(text, expected);
    clock_state = BEYOND_YEARS;
    read_history(text, sizeof text);
    assert_string_equal(text, expected);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup(no_library, start),
                                       cmocka_unit_test_setup(a_function_is_missing, start),
                                       cmocka_unit_test_setup(each_call_fails, start),
                                       cmocka_unit_test_setup(no_clock, start),
                                       cmocka_unit_test_setup(too_many_nodes, start)};
    return cmocka_run_group_tests_name("libnetcdf that fails", tests, NULL, NULL);
}
