/* SPDX-License-Identifier: BSD-3-Clause */
/* The field of a line (field.h).
 *
 * In the certificate the force of the field on a node is f = -K (z - a), z = x + y near the
 * position x. For any z that is a force of the field, and with the energy E and its conjugate E*
 * the local gap is
 *
 *     E(x) + E*(-f) + f.x = E(x) - E(z) - E'(z).(x - z) = y'K y/2 >= 0.
 *
 * y = 0 would do; but where K is large, rounding of x would be large forces. */
#include "cable/field.h"

#include <string.h>

#include "linalg/dense.h"
#include "linalg/symmetric.h"

/* Directions in which K is below this share of its largest are those that it does not resist. */
static const double LEAST_STIFFNESS = 1e-12;

Vec3 cpsi_line_load_at(const CpsiLine *line, int j) {
    const Vec3 weight = cpsi_line_weight_at(line, j);
    if (!line->has_field && !line->has_node_loads) return weight;
    Vec3 sum = cpsi_line_field_force(line, j, vec3_at(line->position, j));
    if (line->has_node_loads) sum = vec3_add(sum, vec3_at(line->field.all, j));
    return vec3_axpy(1 / cpsi_line_share(line, j), sum, weight);
}

static bool is_stiff(const double k[6]) { return k[0] > 0 || k[2] > 0 || k[5] > 0; }

void cpsi_line_field_clear(CpsiLine *line) {
    CpsiNodeField *field = &line->field;
    const size_t n = (size_t)line->n;
    if (field->load) memcpy(field->load, field->own_load, 3 * n * sizeof *field->load);
    if (!cpsi_line_has_field(line)) return;
    memcpy(field->stiffness, field->own_stiffness, 6 * n * sizeof *field->stiffness);
    memcpy(field->place, field->own_place, 3 * n * sizeof *field->place);
    field->size = 0;
    for (int j = 0; j < line->n; j++)
        if (!is_stiff(&field->stiffness[6 * j]))
            memcpy(&field->place[3 * j], &line->position[3 * j], 3 * sizeof *field->place);
}

/* x with K x = b, for b in the range of K; 0 in the directions that K does not resist. */
static Vec3 solve(const double k[6], Vec3 b) {
    Vec3 basis[3], x = vec3(0, 0, 0);
    const int rank = cpsi_field_range(k, basis);
    double m[9] = {0}, right[3] = {0};
    int pivot[3];
    for (int i = 0; i < rank; i++) {
        right[i] = vec3_dot(basis[i], b);
        for (int l = 0; l < rank; l++)
            m[rank * i + l] = vec3_dot(basis[i], cpsi_node_field_product(k, basis[l]));
    }
    if (rank == 0 || !cpsi_lu_factor(rank, m, pivot)) return x;
    cpsi_lu_solve(rank, m, pivot, right);
    for (int i = 0; i < rank; i++) x = vec3_axpy(right[i], basis[i], x);
    return x;
}

void cpsi_line_field_add(CpsiLine *line, int j, const double stiffness[6], Vec3 place) {
    double *k = &line->field.stiffness[6 * j], *a = &line->field.place[3 * j];
    /* the sum of both is least where K1 (a - a1) + K2 (a - a2) = 0 */
    const Vec3 by = cpsi_node_field_product(stiffness, vec3_sub(place, vec3_load(a)));
    for (int i = 0; i < 6; i++) k[i] += stiffness[i];
    vec3_store(a, vec3_add(vec3_load(a), solve(k, by)));
}

int cpsi_field_range(const double k[6], Vec3 basis[3]) {
    Vec3 row[3] = {vec3(k[0], k[1], k[3]), vec3(k[1], k[2], k[4]), vec3(k[3], k[4], k[5])};
    int rank = 0;
    double largest = 0;
    for (; rank < 3; rank++) {
        int best = 0;
        for (int i = 1; i < 3; i++)
            if (vec3_norm(row[i]) > vec3_norm(row[best])) best = i;
        const double size = vec3_norm(row[best]);
        if (rank == 0) largest = size;
        if (!(size > LEAST_STIFFNESS * largest)) break;
        Vec3 unit = vec3_scale(1 / size, row[best]);
        for (int i = 0; i < rank; i++) unit = vec3_reject(unit, basis[i]);
        basis[rank] = vec3_scale(1 / vec3_norm(unit), unit);
        for (int i = 0; i < 3; i++) row[i] = vec3_reject(row[i], basis[rank]);
        row[best] = vec3(0, 0, 0);
    }
    return rank;
}

bool cpsi_line_field_holds(const CpsiLine *line, int j) {
    Vec3 basis[3];
    return cpsi_line_has_field(line) && cpsi_field_range(&line->field.stiffness[6 * j], basis) == 3;
}

/* The sum of the K of all nodes. */
static void total(const CpsiLine *line, double sum[6]) {
    memset(sum, 0, 6 * sizeof *sum);
    for (int i = 0; i < 6 * line->n; i++) sum[i % 6] += line->field.stiffness[i];
}

Vec3 cpsi_line_field_free_part(const CpsiLine *line, Vec3 v) {
    double sum[6];
    Vec3 basis[3];
    if (!cpsi_line_has_field(line)) return v;
    total(line, sum);
    const int rank = cpsi_field_range(sum, basis);
    if (rank == 3) return vec3(0, 0, 0);
    for (int i = 0; i < rank; i++) v = vec3_reject(v, basis[i]);
    return v;
}

bool cpsi_line_field_lets(const CpsiLine *line, Vec3 v) {
    double sum[6];
    if (!cpsi_line_has_field(line)) return true;
    total(line, sum);
    return vec3_dot(v, cpsi_node_field_product(sum, v)) <=
           LEAST_STIFFNESS * (sum[0] + sum[2] + sum[5]);
}

double cpsi_line_field_size(const CpsiLine *line) {
    double sum = 0;
    if (!cpsi_line_has_field(line)) return 0;
    if (line->field.size > 0) return line->field.size;
    for (int j = 0; j < line->n; j++)
        sum += vec3_norm(cpsi_line_field_force(line, j, vec3_at(line->reference, j)));
    return sum;
}

void cpsi_line_field_take(CpsiLine *line, int j, Vec3 left, double unit) {
    double k[6], by[3];
    vec3_store(by, left);
    memcpy(k, &line->field.stiffness[6 * j], sizeof k);
    k[0] += unit;
    k[2] += unit;
    k[5] += unit;
    if (cpsi_symmetric_solve(k, by)) memcpy(&line->field.beside[3 * j], by, sizeof by);
}
