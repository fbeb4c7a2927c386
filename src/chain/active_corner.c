/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes in the corner between two obstacles, in Newton's method on the active set (active_set.c).
 *
 * x is along the corner, the normals n1 = z and n2 lie in the plane across it (step_program.c). A
 * node that slips in it moves along x alone; its reactions are what balances it across the corner,
 *
 *     g + R1 a1 + R2 a2 = 0 in y and z,     a = n + mu q,     q opposite to the slip of the
 * contact,
 *
 * and the equation left is that along x, F = R1 a1x + R2 a2x = -(k_y g_y + k_z g_z). In the linear
 * system y and z are rigid, and k couples friction to what acts on them.
 *
 * At a node at rest forces and reactions are not determined by what balances it. It keeps those
 * that the guess has; what the force on it has changed since is shared between the two contacts,
 * across the corner along the normals, along it by what each can still bear. Where they do not bear
 * that, the method does not know whether it rests. */
#include <float.h>
#include <string.h>

#include "chain/newton.h"

/* Normals nearer to each other than this are taken for parallel: they are no corner. */
static const double LEAST_SINE = 1e-3;
/* The normals lie across the corner up to this. */
static const double ACROSS = 1e-9;
static const double RIGID = 1e30;
/* A shorter slip has no direction. */
static const double NO_SLIP = 1e-12;

/* Slips along the corner on the two obstacles differ by what these turn between rounds; by more
 * than this share of them where the obstacles move against each other, which is not treated. */
static const double ALIKE = 0.5;

typedef struct CornerContact {
    int unilateral, disc; /* -1: no friction */
    double normal[3];     /* n */
    double weight;        /* w */
    double friction;      /* mu */
    double tangent[2][3]; /* of the disc */
    double slip[2], size; /* in these, and its size */
    double along;         /* its part along the corner */
    double q[2];          /* the direction of friction, in the tangents */
    double a[3];          /* n + mu q */
    double turns;         /* mu (1 - q_x^2)/|s|: what a move along x adds to the force, per R */
} CornerContact;

typedef struct Corner {
    int node;
    CornerContact contact[2];
} Corner;

static CornerContact contact_of(const CpsiNewton *newton, const CpsiCorner *corner, int c) {
    const int node = corner->node, unilateral = corner->unilateral[c], disc = corner->disc[c];
    const double way = corner->way;
    const CpsiChainProgram *program = newton->program;
    CornerContact out = {.unilateral = unilateral,
                         .disc = disc,
                         .weight = program->unilateral.weight[unilateral],
                         .normal = {0, 0, 1}};
    if (program->unilateral.second[unilateral])
        for (int a = 0; a < 3; a++) out.normal[a] = program->unilateral.normal[unilateral][a];
    for (int a = 0; a < 3; a++) out.a[a] = out.normal[a];
    if (disc < 0) return out;
    const double *map = program->disc.map[disc], *u = &program->base.u[3 * node];
    out.friction = program->disc.friction[disc];
    for (int i = 0; i < 2; i++) {
        out.slip[i] = program->disc.offset[disc][i];
        for (int a = 0; a < 3; a++) {
            out.tangent[i][a] = map[3 * i + a];
            out.slip[i] += map[3 * i + a] * u[a];
        }
    }
    out.size = cpsi_newton_size(out.slip);
    out.along = out.slip[0] * out.tangent[0][0] + out.slip[1] * out.tangent[1][0];
    if (out.size > NO_SLIP && out.along * way <= 0) {
        for (int i = 0; i < 2; i++) out.q[i] = -out.slip[i] / out.size;
    } else {
        const double x[2] = {way * out.tangent[0][0], way * out.tangent[1][0]},
                     size = cpsi_newton_size(x);
        if (size > 0)
            for (int i = 0; i < 2; i++) out.q[i] = x[i] / size;
    }
    const double along = out.q[0] * out.tangent[0][0] + out.q[1] * out.tangent[1][0];
    for (int a = 0; a < 3; a++)
        out.a[a] += out.friction * (out.q[0] * out.tangent[0][a] + out.q[1] * out.tangent[1][a]);
    out.turns = out.friction * fmax(0, 1 - along * along) / fmax(out.size, NO_SLIP);
    return out;
}

static Corner corner_at(const CpsiNewton *newton, int i) {
    const CpsiCorner *at = &newton->corner[i];
    Corner out = {.node = at->node};
    for (int c = 0; c < 2; c++) out.contact[c] = contact_of(newton, at, c);
    return out;
}

/* The shares of the force f, in y and z, along v and w. */
static void shares(const double v[3], const double w[3], const double f[3], double out[2]) {
    const double det = v[1] * w[2] - v[2] * w[1];
    out[0] = (f[1] * w[2] - f[2] * w[1]) / det;
    out[1] = (v[1] * f[2] - v[2] * f[1]) / det;
}

/* One coefficient of friction, and tangents of unit length. */
static bool is_isotropic(const CpsiChainProgram *program, int disc) {
    const double *b = program->disc.map[disc];
    if (cpsi_newton_shape(program, disc)) return false;
    for (int i = 0; i < 2; i++) {
        const double size =
            b[3 * i] * b[3 * i] + b[3 * i + 1] * b[3 * i + 1] + b[3 * i + 2] * b[3 * i + 2];
        if (!(fabs(size - 1) <= ACROSS)) return false;
    }
    return true;
}

/* Find the discs of a corner; false where it is of a kind that is not treated. */
static bool find_discs(const CpsiNewton *newton, CpsiCorner *corner) {
    const CpsiChainProgram *program = newton->program;
    const CpsiFrictionDisc *disc = &program->disc;
    int found = 0;
    for (int d = 0; d < disc->count; d++) {
        if (disc->node[d] != corner->node) continue;
        for (int c = 0; c < 2; c++)
            if (disc->unilateral[d] == corner->unilateral[c]) {
                if (corner->disc[c] >= 0 || !is_isotropic(program, d)) return false;
                corner->disc[c] = d;
            }
        found++;
    }
    return found == (corner->disc[0] >= 0) + (corner->disc[1] >= 0);
}

/* The sign of friction along the corner in the guess: against the slip or, where that is none, that
 * of its force. */
static int way_of(const CpsiNewton *newton, const CpsiCorner *corner) {
    double slip = 0, force = 0;
    for (int c = 0; c < 2; c++) {
        const CornerContact contact = contact_of(newton, corner, c);
        if (contact.disc < 0) continue;
        const double *z = newton->program->disc.z[contact.disc];
        slip += contact.along;
        force += z[1] * contact.tangent[0][0] + z[2] * contact.tangent[1][0];
    }
    if (fabs(slip) >= CPSI_LEAST_SLIP) return slip > 0 ? -1 : 1;
    return force < 0 ? -1 : 1;
}

bool cpsi_corner_begin(CpsiNewton *newton, int first, int second) {
    CpsiChainProgram *program = newton->program;
    const CpsiUnilateral *unilateral = &program->unilateral;
    const CpsiFrictionDisc *disc = &program->disc;
    const int j = unilateral->node[second];
    const double *n = unilateral->normal[second];
    if (!program->bounds_coupled || program->field || !disc->map || !disc->offset ||
        j >= program->n || newton->corner_count >= newton->most_corners)
        return false;
    if (first < 0 || unilateral->node[first] != j || !(unilateral->z[first] > 0) ||
        !(fabs(n[1]) >= LEAST_SINE) || !(fabs(n[0]) <= ACROSS))
        return false;
    CpsiCorner *corner = &newton->corner[newton->corner_count];
    *corner = (CpsiCorner){.node = j, .unilateral = {first, second}, .disc = {-1, -1}};
    if (!find_discs(newton, corner)) return false;
    newton->corner_count++;
    bool slips = true;
    for (int c = 0; c < 2; c++)
        if (corner->disc[c] >= 0 && !(disc->s[corner->disc[c]][0] > 0)) slips = false;
    newton->status[j] |= (unsigned char)(CPSI_CORNER | CPSI_CLOSED | (slips ? 0 : CPSI_STICKS));
    /* onto both surfaces, and where it rests to where it has not slipped */
    double by[3] = {0};
    const double *u = &program->base.u[3 * j];
    by[2] = -unilateral->gap[first] - u[2];
    by[1] = (-unilateral->gap[second] - n[0] * u[0] - n[2] * (u[2] + by[2])) / n[1] - u[1];
    const CornerContact contact = contact_of(newton, corner, corner->disc[0] >= 0 ? 0 : 1);
    if (corner->disc[0] >= 0 && corner->disc[1] >= 0) {
        const double other = contact_of(newton, corner, 1).along;
        if (!(fabs(contact.along - other) <= CPSI_LEAST_SLIP + ALIKE * fabs(contact.along)))
            return false;
    }
    if (!slips) by[0] = -contact.along;
    corner->way = way_of(newton, corner);
    cpsi_newton_move(newton, j, by[0], by[1], by[2]);
    return true;
}

void cpsi_corner_decide(CpsiNewton *newton) {
    for (int i = 0; i < newton->corner_count; i++) {
        const CpsiCorner *corner = &newton->corner[i];
        if (newton->status[corner->node] & CPSI_STICKS) continue;
        const CornerContact contact = contact_of(newton, corner, corner->disc[0] >= 0 ? 0 : 1);
        if (!(contact.along * corner->way > DBL_EPSILON)) continue;
        newton->status[corner->node] |= CPSI_STICKS;
        cpsi_newton_move(newton, corner->node, -contact.along, 0, 0);
        newton->changed = true;
    }
}

/* The reactions of a node that slips in its corner. */
static void slipping_reactions(const CpsiNewton *newton, const Corner *corner, double r[2]) {
    const double *g = &newton->program->base.residual[3 * corner->node];
    const double f[3] = {-g[0], -g[1], -g[2]};
    shares(corner->contact[0].a, corner->contact[1].a, f, r);
}

void cpsi_corner_load(CpsiNewton *newton) {
    CpsiChainProgram *program = newton->program;
    CpsiMatrixSecond *second = &program->node_frames.second;
    bool any = false;
    for (int i = 0; i < newton->corner_count; i++) {
        const Corner corner = corner_at(newton, i);
        const int j = corner.node;
        const double *g = &program->base.residual[3 * j];
        double *f = &program->base.du[3 * j], *diagonal = &program->matrix.diagonal[6 * j], r[2];
        if (newton->held[j]) continue;
        if (!any) {
            const size_t n = (size_t)program->n;
            memset(second->row, 0, 3 * n * sizeof *second->row);
            memset(second->column, 0, 3 * n * sizeof *second->column);
            any = true;
        }
        const CornerContact *one = &corner.contact[0], *two = &corner.contact[1];
        slipping_reactions(newton, &corner, r);
        if (!(r[0] > 0) || !(r[1] > 0)) newton->lost = true;
        /* k of y and z */
        double k[2];
        for (int a = 0; a < 2; a++) {
            const double unit[3] = {0, a == 0, a == 1};
            double share[2];
            shares(one->a, two->a, unit, share);
            k[a] = one->a[0] * share[0] + two->a[0] * share[1];
        }
        const double error = g[0] + one->a[0] * r[0] + two->a[0] * r[1];
        memset(diagonal, 0, 6 * sizeof *diagonal);
        diagonal[0] = one->turns * r[0] + two->turns * r[1];
        diagonal[5] = RIGID;
        program->matrix.skew[2 * j] = k[1] * RIGID;
        program->matrix.skew[2 * j + 1] = 0;
        second->row[3 * j + 1] = second->column[3 * j + 1] = 1;
        second->column[3 * j] = k[0];
        second->compliance[j] = 1 / RIGID;
        f[0] = error;
        f[1] = f[2] = 0;
        newton->force_error = fmax(newton->force_error, fabs(error));
    }
    program->matrix.second = any ? second : NULL;
}

/* The pair of a contact with reaction r and friction f, in its tangents. */
static void write_pair(CpsiChainProgram *program, const CornerContact *contact, double r,
                       const double f[2], bool slips) {
    const int k = contact->unilateral, d = contact->disc;
    program->unilateral.s[k] = 0;
    program->unilateral.z[k] = r / contact->weight;
    if (d < 0) return;
    double *s = program->disc.s[d], *z = program->disc.z[d];
    z[0] = contact->friction * program->unilateral.z[k];
    s[0] = slips ? contact->size : 0;
    for (int i = 0; i < 2; i++) {
        s[1 + i] = slips ? contact->slip[i] : 0;
        z[1 + i] = f[i] / contact->weight;
    }
}

/* How much more friction along the corner, with this sign, a contact with friction f can bear. */
static double room_of(const CornerContact *contact, const double f[2], double bound, double sign) {
    const double t[2] = {sign * contact->tangent[0][0], sign * contact->tangent[1][0]};
    const double along = f[0] * t[0] + f[1] * t[1], across = f[1] * t[0] - f[0] * t[1];
    return fmax(0, sqrt(fmax(0, bound * bound - across * across)) - along);
}

/* What a node at rest bears: false where it is more than its contacts can. Its pairs are written
 * only if so asked. */
static bool rest(const CpsiNewton *newton, const Corner *corner, bool writes) {
    CpsiChainProgram *program = newton->program;
    const double *g = &program->base.residual[3 * corner->node],
                 noise = newton->noise * newton->force;
    double left[3] = {-g[0], -g[1], -g[2]}, r[2], more[2], f[2][2] = {{0}}, bound[2], room[2];
    for (int c = 0; c < 2; c++) {
        const CornerContact *contact = &corner->contact[c];
        r[c] = contact->weight * program->unilateral.z[contact->unilateral];
        for (int a = 0; a < 3; a++) left[a] -= r[c] * contact->normal[a];
        if (contact->disc < 0) continue;
        for (int i = 0; i < 2; i++) {
            f[c][i] = contact->weight * program->disc.z[contact->disc][1 + i];
            for (int a = 0; a < 3; a++) left[a] -= f[c][i] * contact->tangent[i][a];
        }
    }
    shares(corner->contact[0].normal, corner->contact[1].normal, left, more);
    for (int c = 0; c < 2; c++) {
        r[c] += more[c];
        bound[c] = corner->contact[c].friction * r[c];
        if (!(r[c] >= 0)) return false;
        room[c] = corner->contact[c].disc < 0
                      ? 0
                      : room_of(&corner->contact[c], f[c], bound[c], left[0] < 0 ? -1 : 1);
    }
    const double all = room[0] + room[1];
    if (!(fabs(left[0]) <= all + noise)) return false;
    for (int c = 0; c < 2; c++) {
        const CornerContact *contact = &corner->contact[c];
        const double share = all > 0 ? room[c] / all : 0;
        for (int i = 0; i < 2; i++) f[c][i] += share * left[0] * contact->tangent[i][0];
        const double size = cpsi_newton_size(f[c]);
        const double most = (1 - 4 * DBL_EPSILON) * bound[c];
        if (!(size <= bound[c] + noise)) return false;
        if (size > most)
            for (int i = 0; i < 2; i++) f[c][i] *= most / size;
        if (writes) write_pair(program, contact, r[c], f[c], false);
    }
    return true;
}

bool cpsi_corner_finish(const CpsiNewton *newton) {
    for (int i = 0; i < newton->corner_count; i++) {
        const Corner corner = corner_at(newton, i);
        if ((newton->status[corner.node] & CPSI_STICKS) && !rest(newton, &corner, false))
            return false;
    }
    for (int i = 0; i < newton->corner_count; i++) {
        const Corner corner = corner_at(newton, i);
        if (newton->status[corner.node] & CPSI_STICKS) {
            (void)rest(newton, &corner, true);
            continue;
        }
        double r[2];
        slipping_reactions(newton, &corner, r);
        for (int c = 0; c < 2; c++) {
            const CornerContact *contact = &corner.contact[c];
            const double by = contact->friction * r[c],
                         f[2] = {by * contact->q[0], by * contact->q[1]};
            write_pair(newton->program, contact, r[c], f, true);
        }
    }
    return true;
}
