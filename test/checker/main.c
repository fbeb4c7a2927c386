/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan-checker FILE.nc [-v]: recompute every residual of a result file and say whether its claims hold. */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "checker.h"

int main(int argc, char **argv) {
    bool verbose = argc == 3 && strcmp(argv[2], "-v") == 0;
    if (argc != 2 && !verbose) {
        fprintf(stderr, "usage: capstan-checker FILE.nc [-v]\n");
        return 2;
    }
    CheckerReport report;
    int result = checker_file(argv[1], &report, stderr);
    if (verbose || result != 0) {
        printf("records %d, certified %d, not certified %d, refuted %d, not finite %d\n", report.records,
               report.certified, report.uncertified, report.refuted, report.not_finite);
        printf("worst gap / scale %.3g, imbalance / largest force %.3g, stretch %.3g, depth / length %.3g\n",
               report.gap, report.force, report.stretch, report.penetration);
    }
    return result == 0 ? 0 : 1;
}
