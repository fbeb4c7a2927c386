/* SPDX-License-Identifier: BSD-3-Clause */
/* --h, --lambda, --n and --delta (see regularized_options.h). */
#include "run/regularized_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "printable.h"

/* A number > 0, NaN where none is given; false where the text is something else. */
static bool read_number(const char *text, const char *name, const char *command, bool infinite,
                        double *out) {
    *out = NAN;
    if (!text) return true;
    char *end = NULL;
    *out = strtod(text, &end);
    if (end != text && *end == '\0' && *out > 0 && (isfinite(*out) || infinite)) return true;
    cli_printf(stderr, "capstan %s: --%s '%.40s': expected a number above 0%s\n", command, name,
               text, infinite ? ", or inf" : "");
    return false;
}

bool regularized_options_read(const CliOptions *options, const char *command,
                              RegularizedOptions *out) {
    double n;
    const bool good = read_number(options->h, "h", command, false, &out->h) &&
                      read_number(options->lambda, "lambda", command, false, &out->penalty) &&
                      read_number(options->n, "n", command, true, &n) &&
                      read_number(options->delta, "delta", command, false, &out->delta);
    if (good) out->stiffness = 1 / n;
    return good;
}

bool regularized_options_given(const CliOptions *options) {
    return options->h || options->lambda || options->n || options->delta;
}

CpsRegularizedParameters regularized_options_apply(const RegularizedOptions *given,
                                                   const CpsRegularized *regularized) {
    CpsRegularizedParameters p = cps_regularized_fine(regularized);
    if (!isnan(given->penalty)) p.penalty = given->penalty;
    if (!isnan(given->stiffness)) p.stiffness = given->stiffness;
    if (!isnan(given->delta)) p.delta = given->delta;
    if (!isnan(given->h))
        p.cell_count =
            (int)fmin(1e6,
                      fmax(2, ceil(cps_regularized_step(regularized).length / given->h - 1e-9)));
    return p;
}
