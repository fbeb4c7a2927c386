/* SPDX-License-Identifier: BSD-3-Clause */
/* One block of the chain with a point (chain_point.h). */
#include "chain/chain_point.h"

#include <math.h>
#include <string.h>

#include "chain/frame.h"
#include "chain/point.h"
#include "linalg/dense.h"

enum { SIZE = CPSI_CHAIN_POINT, BORDER = 4, NODE = 3 };

static double dot(const double *p, const double *q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

/* P and N of the unknowns (t, phi), and P' and N' of their equations, all transposed: a row for
 * each unknown. */
typedef struct Border {
    double here[BORDER][NODE], there[BORDER][NODE], reads[BORDER][NODE], reads_there[BORDER][NODE];
} Border;

static void border_of(Border *border, const CpsiMatrix *a, int j, const CpsiPointLaw *law,
                      const double m[3]) {
    double r[9];
    const double b = a->share[j];
    cpsi_point_turn(a, j, law->axes, r);
    for (int i = 0; i < NODE; i++) {
        border->here[0][i] = border->reads[0][i] = m[i];
        border->there[0][i] = border->reads_there[0][i] = -m[i];
        /* component i of a position is row i of R in the axes of the point */
        for (int k = 0; k < 3; k++) {
            border->here[1 + k][i] = b * r[3 * i + k];
            border->there[1 + k][i] = (1 - b) * r[3 * i + k];
            const double read = law->e[k] / law->size[k] * r[3 * i + k];
            border->reads[1 + k][i] = b * read;
            border->reads_there[1 + k][i] = (1 - b) * read;
        }
    }
}

/* The rows and columns of (t, phi), A with them. */
static void fill_border(double s[SIZE][SIZE], const CpsiMatrix *a, int j, const double c[9],
                        const double m[3]) {
    const CpsiPointLaw law = cpsi_point_law(a, j);
    const double k = a->stiffness[j];
    Border border;
    border_of(&border, a, j, &law, m);
    for (int p = 0; p < BORDER; p++) {
        double cn[3]; /* C N of this unknown */
        for (int i = 0; i < NODE; i++) cn[i] = dot(&c[3 * i], border.there[p]);
        if (!a->held[j])
            for (int i = 0; i < NODE; i++) {
                const double *reads = border.reads_there[p];
                s[i][NODE + p] = border.here[p][i] + k * cn[i];
                s[NODE + p][i] = border.reads[p][i] +
                                 k * (c[i] * reads[0] + c[3 + i] * reads[1] + c[6 + i] * reads[2]);
            }
        for (int q = 0; q < BORDER; q++) s[NODE + q][NODE + p] = -dot(border.reads_there[q], cn);
    }
    s[NODE][NODE] -= a->compliance[j];
    for (int i = 0; i < 3; i++) s[NODE + 1 + i][NODE + 1 + i] -= 1 / law.size[i];
    for (int i = 0; i < 2; i++) s[NODE + 1 + i][NODE + 3] += law.c[i] / law.size[i];
}

bool cpsi_chain_point_factor(CpsiChainPoint *point, const CpsiMatrix *a, int j, const double x[9],
                             const double c[9], const double m[3]) {
    double s[SIZE][SIZE] = {{0}};
    int pivot[SIZE];
    const bool second = !a->held[j] && cpsi_second_is_set(a->second, j);
    for (int i = 0; i < NODE; i++)
        for (int l = 0; l < NODE; l++) s[i][l] = a->held[j] ? i == l : x[3 * i + l];
    fill_border(s, a, j, c, m);
    s[SIZE - 1][SIZE - 1] = second ? -a->second->compliance[j] : 1;
    if (second)
        for (int i = 0; i < NODE; i++) {
            s[SIZE - 1][i] = a->second->row[3 * j + i];
            s[i][SIZE - 1] = a->second->column[3 * j + i];
        }
    if (!cpsi_lu_factor(SIZE, s[0], pivot)) return false;
    for (int l = 0; l < SIZE; l++) {
        double column[SIZE] = {0};
        column[l] = 1;
        cpsi_lu_solve(SIZE, s[0], pivot, column);
        for (int i = 0; i < SIZE; i++) point->inverse[SIZE * i + l] = column[i];
    }
    if (a->held[j])
        for (int i = 0; i < NODE; i++) point->inverse[(SIZE + 1) * i] = 0;
    return true;
}

void cpsi_chain_point_compliance(const CpsiChainPoint *point, double c[9]) {
    for (int i = 0; i < NODE; i++) memcpy(&c[3 * i], &point->inverse[SIZE * i], NODE * sizeof *c);
}

void cpsi_chain_point_solve(const CpsiChainPoint *point, const CpsiMatrix *a, int j,
                            const double f[3], double h, const double before[3], double x[3],
                            double *t, double phi[3], double *second) {
    const CpsiPointLaw law = cpsi_point_law(a, j);
    double r[9], along[3], right[SIZE] = {f[0], f[1], f[2], h, [SIZE - 1] = *second}, out[SIZE];
    cpsi_point_turn(a, j, law.axes, r);
    cpsi_frame_from(along, r, before);
    for (int k = 0; k < 3; k++)
        right[NODE + 1 + k] = phi[k] - (1 - a->share[j]) * (law.e[k] / law.size[k] * along[k]);
    for (int i = 0; i < SIZE; i++) out[i] = cpsi_dot(SIZE, &point->inverse[SIZE * i], right);
    memcpy(x, out, NODE * sizeof *x);
    *t = out[NODE];
    memcpy(phi, &out[NODE + 1], 3 * sizeof *phi);
    *second = out[SIZE - 1];
}

void cpsi_chain_point_add(const CpsiChainPoint *point, const double force[3], double more[SIZE]) {
    for (int i = 0; i < SIZE; i++) more[i] = dot(&point->inverse[SIZE * i], force);
}

void cpsi_chain_point_pull(const CpsiMatrix *a, int j, const double phi[3], double pull[3]) {
    const CpsiPointLaw law = cpsi_point_law(a, j + 1);
    double r[9], here[3];
    cpsi_point_turn(a, j, law.axes, r);
    cpsi_frame_to(here, r, phi);
    for (int i = 0; i < 3; i++) pull[i] -= (1 - a->share[j + 1]) * here[i];
}
