/* SPDX-License-Identifier: BSD-3-Clause */
/* Findings of a comparison (compare.h). */
#include "compare.h"

#include <math.h>
#include <stdarg.h>

void find(Compare *compare, const char *format, ...) {
    compare->findings++;
    if (!compare->log) return;
    va_list list;
    va_start(list, format);
    fputs("not the scene's: ", compare->log);
    vfprintf(compare->log, format, list);
    fputc('\n', compare->log);
    va_end(list);
}

double size(const double *v) { return hypot(hypot(v[0], v[1]), v[2]); }

void same(Compare *compare, const char *what, const char *of, const double *file,
          const double *scene, size_t count, double noise) {
    double most = 0;
    for (size_t i = 0; i < count; i++) most = fmax(most, fabs(scene[i]));
    for (size_t i = 0; i < count; i++)
        if (!(fabs(file[i] - scene[i]) <= noise * most)) {
            find(compare, "%s of %s is %.17g, in the scene %.17g", what, of, file[i], scene[i]);
            return;
        }
}

void same_number(Compare *compare, const char *what, const char *of, double file, double scene) {
    same(compare, what, of, &file, &scene, 1, COPIED);
}
