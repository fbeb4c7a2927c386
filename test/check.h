/* SPDX-License-Identifier: BSD-3-Clause */
/* Numeric checks on top of cmocka.
 *
 * Each check prints value, expected value, difference and tolerance with file and line, then fails
 * the running test. All are written so that NaN fails. CHECK_RELATIVE measures the difference in
 * units of the expected value. */
#ifndef CAPSTAN_TEST_CHECK_H
#define CAPSTAN_TEST_CHECK_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define CHECK_NEAR(got, want, tolerance) \
    check_near_(#got, (got), (want), (tolerance), __FILE__, __LINE__)
#define CHECK_RELATIVE(got, want, tolerance) \
    check_relative_(#got, (got), (want), (tolerance), __FILE__, __LINE__)
#define CHECK_VECTOR(got, want, tolerance) \
    check_vector_(#got, (got), (want), (tolerance), __FILE__, __LINE__)
#define CHECK_BETWEEN(got, low, high) check_between_(#got, (got), (low), (high), __FILE__, __LINE__)
#define CHECK_LESS(got, bound)        check_less_(#got, (got), (bound), __FILE__, __LINE__)
#define CHECK_GREATER(got, bound)     check_greater_(#got, (got), (bound), __FILE__, __LINE__)
#define CHECK_FINITE(got)             check_finite_(#got, (got), __FILE__, __LINE__)
#define CHECK_INT(got, want)          check_int_(#got, (got), (want), __FILE__, __LINE__)

/* |got - want| <= tolerance; equal infinities pass */
static inline void check_near_(const char *text, double got, double want, double tolerance,
                               const char *file, int line) {
    double difference = got - want;
    if (got == want || fabs(difference) <= tolerance) return;
    print_error("%s: got %.17g, expected %.17g, difference %.3g, tolerance %.3g\n", text, got, want,
                difference, tolerance);
    _fail(file, line);
}

/* |got - want| <= tolerance |want| */
static inline void check_relative_(const char *text, double got, double want, double tolerance,
                                   const char *file, int line) {
    double difference = (got - want) / fabs(want);
    if (got == want || fabs(difference) <= tolerance) return;
    print_error("%s: got %.17g, expected %.17g, relative difference %.3g, tolerance %.3g\n", text,
                got, want, difference, tolerance);
    _fail(file, line);
}

/* the same for each of three components */
static inline void check_vector_(const char *text, const double *got, const double *want,
                                 double tolerance, const char *file, int line) {
    for (int k = 0; k < 3; k++) check_near_(text, got[k], want[k], tolerance, file, line);
}

static inline void check_between_(const char *text, double got, double low, double high,
                                  const char *file, int line) {
    if (got >= low && got <= high) return;
    print_error("%s: got %.17g, expected a value from %.17g to %.17g\n", text, got, low, high);
    _fail(file, line);
}

static inline void check_less_(const char *text, double got, double bound, const char *file,
                               int line) {
    if (got < bound) return;
    print_error("%s: got %.17g, expected less than %.17g, difference %.3g\n", text, got, bound,
                got - bound);
    _fail(file, line);
}

static inline void check_greater_(const char *text, double got, double bound, const char *file,
                                  int line) {
    if (got > bound) return;
    print_error("%s: got %.17g, expected more than %.17g, difference %.3g\n", text, got, bound,
                got - bound);
    _fail(file, line);
}

static inline void check_finite_(const char *text, double got, const char *file, int line) {
    if (isfinite(got)) return;
    print_error("%s: got %g, expected a finite number\n", text, got);
    _fail(file, line);
}

static inline void check_int_(const char *text, long long got, long long want, const char *file,
                              int line) {
    if (got == want) return;
    print_error("%s: got %lld, expected %lld\n", text, got, want);
    _fail(file, line);
}

#endif
