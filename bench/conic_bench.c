/* SPDX-License-Identifier: BSD-3-Clause */
/* Time and accuracy of the sparse conic solver on random programs.
 *     usage: conic_bench [--kind banded|random] [--unknowns N] [--seed S] [--repeats R]
 *                        [--dump FILE] [--table]
 *
 * The programs are those of test/property/random_program.h, and so is the error. `--dump` writes
 * program and time for compare_conic.py.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "random_program.h"

/* Residual and gap above which an answer is not accepted, as in drive/. */
static const double ACCEPT = 1e-7;

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t); /* not what else the machine does */
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void row_of(FILE *file, const char *name, size_t count, const double *number) {
    fprintf(file, "%s %zu", name, count);
    for (size_t k = 0; k < count; k++) fprintf(file, " %.17g", number[k]);
    fprintf(file, "\n");
}

/* One line per thing: its name, the count of numbers, the numbers. */
static void dump(const char *path, const RandomProgram *made, double seconds, double error,
                 const CpsiConicResult *found) {
    FILE *file = fopen(path, "w");
    if (!file) {
        perror(path);
        exit(1);
    }
    const CpsiSparseData *d = &made->data;
    const size_t n = (size_t)d->unknowns, m = (size_t)d->equations;
    fprintf(file, "# capstan conic program 1\n");
    row_of(file, "c", n, d->c);
    row_of(file, "h", m, d->h);
    row_of(file, "E", d->start[m], d->value);
    fprintf(file, "columns %zu", d->start[m]);
    for (size_t e = 0; e < d->start[m]; e++) fprintf(file, " %d", d->column[e]);
    fprintf(file, "\n");
    for (int k = 0; k < d->blocks; k++) {
        const CpsiBlock *block = &d->block[k];
        fprintf(file, "block %d", block->cones);
        for (int cone = 0; cone < block->cones; cone++) fprintf(file, " %d", block->dim[cone]);
        fprintf(file, "\n");
        row_of(file, "A", (size_t)block->rows * (size_t)block->unknowns, block->a);
        row_of(file, "b", (size_t)block->rows, block->b);
    }
    row_of(file, "answer", 3, (const double[]){seconds, found->iterations, error});
    if (fclose(file)) {
        perror(path);
        exit(1);
    }
}

static void solve(const char *kind, int unknowns, uint64_t seed, int repeats, const char *path) {
    const RandomProgramKind shape = {.unknowns = unknowns, .banded = !strcmp(kind, "banded")};
    RandomProgram made = random_program_new(&shape, seed);
    double seconds = INFINITY;
    for (int k = 0; k < repeats; k++) {
        CpsError err;
        CpsiSparseProgram *program = NULL;
        const double begin = now();
        if (cpsi_sparse_program_new(&made.data, &program, &err) != CPS_OK) {
            printf("%8s %8d  %s\n", kind, unknowns, err.message);
            break;
        }
        const CpsiConicResult found = cpsi_sparse_program_solve(program, ACCEPT);
        seconds = fmin(seconds, now() - begin);
        if (k == repeats - 1) {
            const double error = random_program_error(&made, &found);
            printf("%8s %8d %6llu %10.3f %10d %10.1e  %s\n", kind, unknowns,
                   (unsigned long long)seed, 1e3 * seconds, found.iterations, error,
                   found.outcome == CPSI_CONIC_SOLVED ? "solved" : "NOT ACCEPTED");
            if (path) dump(path, &made, seconds, error, &found);
        }
        cpsi_sparse_program_free(program);
    }
    fflush(stdout);
    random_program_free(&made);
}

int main(int argc, char **argv) {
    const char *kind = "banded", *path = NULL;
    int unknowns = 1000, repeats = 3;
    uint64_t seed = 1;
    bool table = false;
    for (int i = 1; i < argc; i++) {
        const char *option = argv[i];
        if (!strcmp(option, "--table")) {
            table = true;
            continue;
        }
        const char *value = i + 1 < argc ? argv[++i] : "";
        if (!strcmp(option, "--kind") && (!strcmp(value, "banded") || !strcmp(value, "random")))
            kind = value;
        else if (!strcmp(option, "--unknowns"))
            unknowns = atoi(value);
        else if (!strcmp(option, "--seed"))
            seed = strtoull(value, NULL, 10);
        else if (!strcmp(option, "--repeats"))
            repeats = atoi(value);
        else if (!strcmp(option, "--dump"))
            path = value;
        else {
            fprintf(stderr, "conic_bench: what is %s %s?\n", option, value);
            return 2;
        }
    }
    if (unknowns < RANDOM_PROGRAM_LEAST || unknowns > 10000000 || repeats < 1) {
        fprintf(stderr, "conic_bench: %d to 10000000 unknowns, at least 1 repeat\n",
                RANDOM_PROGRAM_LEAST);
        return 2;
    }
    printf("%8s %8s %6s %10s %10s %10s\n", "kind", "unknowns", "seed", "ms", "iterations", "error");
    if (!table) {
        solve(kind, unknowns, seed, repeats, path);
        return 0;
    }
    for (int n = 100; n <= 100000; n *= 10) solve("banded", n, seed, repeats, NULL);
    for (int n = 100; n <= 1000; n *= 10) solve("random", n, seed, repeats, NULL);
    return 0;
}
