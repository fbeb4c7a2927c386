/* SPDX-License-Identifier: BSD-3-Clause */
/* Random programs of the sparse conic solver: every answer satisfies the conditions of an optimum.
 *     usage: random_programs [--cases N] [--seed S] [--unknowns N]
 *
 * Programs of 16 to 400 unknowns (random_program.h), a third of them with unknowns in no block, a
 * third with equations that stand twice. With --unknowns all are banded and have so many, and of
 * ten at most one may take more than one run of the loop. Optimality is checked with arithmetic of
 * its own. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "random_program.h"
#include "splitmix.h"

/* Residual and gap above which an answer is not accepted, as in drive/. */
static const double ACCEPT = 1e-7;
/* What an answer may miss, in units of 1 + the largest unknown. The solver looks for 1e-14;
 * where no polish comes to it, the best iterate is the answer. */
static const double ERROR = 1e-12;
/* One run of the loop ends below this number of iterations. */
enum { ONE_RUN = 40 };

int main(int argc, char **argv) {
    int cases = 1000, size = 0, repeated = 0, failures = 0;
    uint64_t seed = 1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--cases")) cases = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--unknowns")) size = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--seed")) seed = strtoull(argv[i + 1], NULL, 10);
    }
    double worst = 0;
    for (int k = 0; k < cases; k++) {
        uint64_t state = seed + (uint64_t)k;
        const double drawn = splitmix(&state, log(RANDOM_PROGRAM_LEAST), log(401));
        const int unknowns = size > 0 ? size : (int)exp(drawn);
        RandomProgramKind kind = {.unknowns = unknowns};
        kind.banded = splitmix(&state, 0, 1) < 0.5 || size > 0;
        kind.loose = splitmix(&state, 0, 3) < 1 ? 1 + unknowns / 50 : 0;
        kind.repeated = splitmix(&state, 0, 3) < 1 ? 1 + unknowns / 20 : 0;
        RandomProgram made = random_program_new(&kind, seed + (uint64_t)k);
        CpsiSparseProgram *program = NULL;
        CpsError err;
        if (cpsi_sparse_program_new(&made.data, &program, &err) != CPS_OK) {
            fprintf(stderr, "seed %llu: %s\n", (unsigned long long)seed + (unsigned)k, err.message);
            return 1;
        }
        const CpsiConicResult found = cpsi_sparse_program_solve(program, ACCEPT);
        double largest = 0;
        for (int j = 0; j < unknowns; j++) largest = fmax(largest, fabs(found.x[j]));
        const double error = random_program_error(&made, &found) / (1 + largest);
        worst = fmax(worst, error);
        if (found.iterations > ONE_RUN) repeated++;
        if (found.outcome != CPSI_CONIC_SOLVED || !(error <= ERROR)) {
            fprintf(stderr, "seed %llu: %d unknowns, outcome %d, error %.2g, allowed %.2g\n",
                    (unsigned long long)seed + (unsigned)k, unknowns, (int)found.outcome, error,
                    ERROR);
            failures++;
        }
        cpsi_sparse_program_free(program);
        random_program_free(&made);
    }
    if (size > 0 && 10 * repeated > cases) failures++;
    printf("%d programs: largest error %.2g, %d took more than %d iterations, %d failures\n", cases,
           worst, repeated, (int)ONE_RUN, failures);
    return failures > 0;
}
