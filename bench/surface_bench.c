/* SPDX-License-Identifier: BSD-3-Clause */
/* Time and memory of ground and meshes by their size: making one of the same waves as a grid and as
 * triangles, and a query at a random place near the surface. On a grid of any size it takes the
 * same time. On a mesh it grows with the logarithm of the triangles if the place is as near as they
 * are wide; at a fixed distance it grows faster, since more and more of them are nearly as near.
 *
 * usage: surface_bench */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "capstan/ground.h"
#include "capstan/mesh.h"

enum { QUERIES = 200000 };

static double seconds(void) { return (double)clock() / CLOCKS_PER_SEC; }

static double height(double a, double b) { return 0.05 * (sin(9 * a) + cos(7 * b)); }

static double random_share(unsigned *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state / 4294967296.0;
}

static void bench_grid(int n, const double *x, const double *z) {
    CpsGroundGrid grid = cps_ground_grid_default();
    CpsGround *ground = NULL;
    CpsError err;
    unsigned state = 1;
    double sum = 0;
    grid.x_count = grid.y_count = n + 1;
    grid.x = grid.y = x;
    grid.z = z;
    const double start = seconds();
    if (cps_ground_create(&grid, &ground, &err)) {
        fprintf(stderr, "%s\n", err.message);
        exit(1);
    }
    const double made = seconds();
    for (int k = 0; k < QUERIES; k++) {
        const double a = random_share(&state), b = random_share(&state);
        sum += cps_ground_height(ground, a, b, NULL);
    }
    const double asked = seconds();
    printf("grid, %8d cells: made in %6.3f s, %6.1f MB, %5.0f ns a query (mean %.3g m)\n", n * n,
           made - start, 8e-6 * (n + 1) * (n + 1), 1e9 * (asked - made) / QUERIES, sum / QUERIES);
    cps_ground_release(ground);
}

static void bench_mesh(int n, const double *x, const double *z) {
    const int points = (n + 1) * (n + 1);
    CpsMeshTriangles of = cps_mesh_triangles_default();
    double *vertex = malloc(3 * (size_t)points * sizeof *vertex);
    int *triangle = malloc(6 * (size_t)n * (size_t)n * sizeof *triangle), *next = triangle;
    CpsMesh *mesh = NULL;
    CpsError err;
    unsigned state = 1;
    double sum = 0;
    if (!vertex || !triangle) exit(1);
    for (int k = 0; k < points; k++) {
        vertex[3 * k] = x[k % (n + 1)];
        vertex[3 * k + 1] = x[k / (n + 1)];
        vertex[3 * k + 2] = z[k];
    }
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            const int a = j * (n + 1) + i, b = a + n + 1;
            const int both[6] = {a, a + 1, b + 1, a, b + 1, b};
            for (int k = 0; k < 6; k++) *next++ = both[k];
        }
    of.vertex_count = points;
    of.vertex = vertex;
    of.triangle_count = 2 * n * n;
    of.triangle = triangle;
    const double start = seconds();
    if (cps_mesh_create(&of, &mesh, &err)) {
        fprintf(stderr, "%s\n", err.message);
        exit(1);
    }
    const double made = seconds(), above[2] = {1.0 / n, 0.01};
    double took[2];
    for (int i = 0; i < 2; i++) {
        const double begin = seconds();
        for (int k = 0; k < QUERIES; k++) {
            const double a = random_share(&state), b = random_share(&state);
            const double at[3] = {a, b, height(a, b) + above[i]};
            sum += cps_mesh_distance(mesh, at, NULL);
        }
        took[i] = 1e9 * (seconds() - begin) / QUERIES;
    }
    printf("mesh, %8d triangles: made in %6.3f s, %6.1f MB, %5.0f ns a query one cell above it, "
           "%5.0f ns 0.01 m above it (mean %.3g m)\n",
           2 * n * n, made - start, 1e-6 * (double)cps_mesh_report(mesh).bytes, took[0], took[1],
           sum / QUERIES / 2);
    cps_mesh_release(mesh);
    free(vertex);
    free(triangle);
}

int main(void) {
    for (int n = 16; n <= 1024; n *= 4) {
        double *x = malloc((size_t)(n + 1) * sizeof *x),
               *z = malloc((size_t)(n + 1) * (size_t)(n + 1) * sizeof *z);
        if (!x || !z) return 1;
        for (int i = 0; i <= n; i++) x[i] = (double)i / n;
        for (int j = 0; j <= n; j++)
            for (int i = 0; i <= n; i++)
                z[(size_t)j * (size_t)(n + 1) + (size_t)i] = height(x[i], x[j]);
        bench_grid(n, x, z);
        bench_mesh(n, x, z);
        free(x);
        free(z);
    }
    return 0;
}
