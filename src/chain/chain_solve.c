/* SPDX-License-Identifier: BSD-3-Clause */
/* Solves with the factor of block_tridiagonal.c: forward from both ends to the middle node, and
 * back. */
#include "chain/chain_factor.h"
#include "chain/frame.h"

static inline double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Vectors of the nodes `from` in the axes of the nodes `to`. */
static inline void change_axes(const CpsiMatrix *a, const int to[2], const int from[2],
                               CpsiHalves v[3]) {
    CPSI_FOR_HALVES(l) {
        const double own[3] = {v[0][l], v[1][l], v[2][l]};
        double common[3], other[3];
        cpsi_frame_from(common, &a->frame[9 * from[l]], own);
        cpsi_frame_to(other, &a->frame[9 * to[l]], common);
        for (int i = 0; i < 3; i++) v[i][l] = other[i];
    }
}

/* m of the elements between, in the axes of the nodes `to`. */
CPSI_HALVES_FUNCTION void directions(CpsiHalves m[3], const CpsiMatrix *a, const CpsiPlaces *at,
                                     const int to[2], const bool plain) {
    for (int i = 0; i < 3; i++) m[i] = at->sign * cpsi_halves_get(a->direction, at->element, 3, i);
    if (plain || !a->frame) return;
    CPSI_FOR_HALVES(l) {
        const double common[3] = {m[0][l], m[1][l], m[2][l]};
        double own[3];
        cpsi_frame_to(own, &a->frame[9 * to[l]], common);
        for (int i = 0; i < 3; i++) m[i][l] = own[i];
    }
}

/* x of two nodes, t of the elements before them. */
typedef struct Found {
    CpsiHalves x[3], t;
} Found;

CPSI_HALVES_FUNCTION void put_found(const CpsiUnknowns *of, const CpsiPlaces *at,
                                    const Found *found) {
    for (int i = 0; i < 3; i++) cpsi_halves_put(of->x, at->node, 3, i, found->x[i]);
    if (at->passed > 0) cpsi_halves_put(of->t, at->element, 1, 0, found->t);
}

/* The change of f of a node's second direction for a change of the force on the node and of the
 * tension before it. */
static inline double second_force(const CpsiChainSecond *second, const double force[3],
                                  double tension) {
    return dot(second->w, force) - dot(second->w, second->v) * tension;
}

/* f of the second directions for the forces f on the nodes, and what their right-hand sides add to
 * x and t. */
static inline void forward_second(const CpsiChainFactor *chain, const CpsiMatrix *a,
                                  const CpsiPlaces *at, const CpsiHalves f[3], double *second_f,
                                  Found *found) {
    const CpsiChainBlock *block = &chain->block[at->passed];
    const double right[2] = {second_f[at->node[0]], second_f[at->node[1]]};
    CPSI_FOR_HALVES(l) {
        const CpsiChainSecond *own = &chain->second[at->node[l]];
        const double force[3] = {f[0][l], f[1][l], f[2][l]}, g = right[l];
        const bool has = cpsi_chain_has_second(a, at->node[l]);
        if (has && g != 0) {
            found->t[l] += own->pull * block->tt[l] * g;
            for (int i = 0; i < 3; i++)
                found->x[i][l] += (own->column[i] - block->y[i][l] * own->pull) * g;
        }
        second_f[at->node[l]] = has ? second_force(own, force, found->t[l]) + own->corner * g : 0;
    }
}

/* f of the second directions, for a change of the forces on the nodes and of t. */
static inline void pull_second(const CpsiChainFactor *chain, const CpsiMatrix *a,
                               const CpsiPlaces *at, const CpsiHalves pull[3], CpsiHalves dt,
                               double *second_f) {
    const double before[2] = {second_f[at->node[0]], second_f[at->node[1]]};
    CPSI_FOR_HALVES(l) {
        const double force[3] = {pull[0][l], pull[1][l], pull[2][l]};
        const int j = at->node[l];
        if (cpsi_chain_has_second(a, j))
            second_f[j] = before[l] + second_force(&chain->second[j], force, dt[l]);
    }
}

/* A node whose element has a point, twice. */
static void forward_point(const CpsiChainFactor *chain, const CpsiMatrix *a, const CpsiUnknowns *of,
                          const CpsiPlaces *at, const CpsiHalves f[3], CpsiHalves h, Found *found) {
    const int j = at->node[0];
    const double force[3] = {f[0][0], f[1][0], f[2][0]},
                 before[3] = {found->x[0][0], found->x[1][0], found->x[2][0]};
    double x[3], t, second = of->f ? of->f[j] : 0;
    cpsi_chain_point_solve(&chain->point[j], a, j, force, h[0], before, x, &t,
                           &of->x[3 * (a->n + j)], &second);
    if (of->f) of->f[j] = second;
    for (int i = 0; i < 3; i++) found->x[i] = cpsi_halves(x[i], x[i]);
    found->t = cpsi_halves(t, t);
}

/* x and t of the next nodes, each of the chain that ends with it, from those of the nodes before.
 */
CPSI_HALVES_FUNCTION void forward(const CpsiChainFactor *chain, const CpsiMatrix *a,
                                  const CpsiUnknowns *of, int passed, const bool both, Found *found,
                                  const bool plain) {
    const CpsiPlaces at = cpsi_chain_next(a, passed, both);
    const CpsiChainBlock *block = &chain->block[passed];
    CpsiHalves f[3], m[3], h = {0, 0};
    for (int i = 0; i < 3; i++) f[i] = cpsi_halves_get(of->x, at.node, 3, i);
    if (passed > 0) {
        const CpsiHalves k = cpsi_halves_get(a->stiffness, at.element, 1, 0);
        if (!plain && a->frame) change_axes(a, at.node, at.before, found->x);
        directions(m, a, &at, at.node, plain);
        h = cpsi_halves_get(of->t, at.element, 1, 0) + cpsi_halves_dot(m, found->x);
        for (int i = 0; i < 3; i++) f[i] += k * found->x[i];
    }
    if (!plain && passed > 0 && cpsi_point_is_set(a, at.node[0])) {
        forward_point(chain, a, of, &at, f, h, found);
    } else {
        cpsi_halves_apply(found->x, block->c, f);
        for (int i = 0; i < 3; i++) found->x[i] += block->y[i] * h;
        found->t = cpsi_halves_dot(block->yt, f) - block->tt * h;
        if (!plain && of->f) forward_second(chain, a, &at, f, of->f, found);
    }
    put_found(of, &at, found);
}

/* The force `pull` on two nodes changes what `forward` has found. */
CPSI_HALVES_FUNCTION void pull_nodes(const CpsiChainFactor *chain, const CpsiMatrix *a,
                                     const CpsiUnknowns *of, const CpsiPlaces *at,
                                     const CpsiHalves pull[3], Found *found, const bool plain) {
    const CpsiChainBlock *block = &chain->block[at->passed];
    const CpsiHalves dt = cpsi_halves_dot(block->yt, pull);
    CpsiHalves dx[3];
    cpsi_halves_apply(dx, block->c, pull);
    for (int i = 0; i < 3; i++) found->x[i] = cpsi_halves_get(of->x, at->node, 3, i) + dx[i];
    if (at->passed > 0) found->t = cpsi_halves_get(of->t, at->element, 1, 0) + dt;
    if (!plain && of->f) pull_second(chain, a, at, pull, dt, of->f);
    put_found(of, at, found);
}

/* The same of a node whose element has a point, twice. */
static void pull_point(const CpsiChainFactor *chain, const CpsiMatrix *a, const CpsiUnknowns *of,
                       const CpsiPlaces *at, const CpsiHalves pull[3], Found *found) {
    const int j = at->node[0];
    const double force[3] = {pull[0][0], pull[1][0], pull[2][0]};
    double more[CPSI_CHAIN_POINT];
    cpsi_chain_point_add(&chain->point[j], force, more);
    for (int i = 0; i < 3; i++) of->x[3 * j + i] += more[i];
    of->t[j] += more[3];
    for (int i = 0; i < 3; i++) of->x[3 * (a->n + j) + i] += more[4 + i];
    if (of->f) of->f[j] += more[7];
    for (int i = 0; i < 3; i++) found->x[i] = cpsi_halves(of->x[3 * j + i], of->x[3 * j + i]);
    found->t = cpsi_halves(of->t[j], of->t[j]);
}

/* The next nodes, from those after them: x of these and t of the elements between act on the nodes
 * with the force k x + m t. */
CPSI_HALVES_FUNCTION void backward(const CpsiChainFactor *chain, const CpsiMatrix *a,
                                   const CpsiUnknowns *of, int passed, const bool both,
                                   Found *found, const bool plain) {
    const CpsiPlaces at = cpsi_chain_next(a, passed, both),
                     after = cpsi_chain_next(a, passed + 1, both);
    const CpsiHalves k = cpsi_halves_get(a->stiffness, after.element, 1, 0);
    CpsiHalves pull[3], m[3];
    for (int i = 0; i < 3; i++) pull[i] = found->x[i];
    if (!plain && a->frame) change_axes(a, at.node, after.node, pull);
    directions(m, a, &after, at.node, plain);
    for (int i = 0; i < 3; i++) pull[i] = k * pull[i] + m[i] * found->t;
    if (!plain && cpsi_point_is_set(a, after.element[0])) {
        double force[3] = {pull[0][0], pull[1][0], pull[2][0]};
        cpsi_chain_point_pull(a, at.node[0], &of->x[3 * (a->n + after.node[0])], force);
        for (int i = 0; i < 3; i++) pull[i] = cpsi_halves(force[i], force[i]);
    }
    if (!plain && passed > 0 && cpsi_point_is_set(a, at.node[0]))
        pull_point(chain, a, of, &at, pull, found);
    else
        pull_nodes(chain, a, of, &at, pull, found, plain);
}

/* One number of each half twice. */
CPSI_HALVES_FUNCTION Found twice(const Found *found, const int half) {
    Found out;
    for (int i = 0; i < 3; i++) out.x[i] = cpsi_halves(found->x[i][half], found->x[i][half]);
    out.t = cpsi_halves(found->t[half], found->t[half]);
    return out;
}

/* The joint, before the middle node: the force of the last half, whose end has been found, goes
 * into the right-hand side of the middle node. Returns h of the joint. */
static double forward_joint(const CpsiMatrix *a, const CpsiUnknowns *of, Found *last) {
    const CpsiPlaces at = cpsi_chain_joint_places(a);
    CpsiHalves m[3];
    if (a->frame) change_axes(a, at.node, at.before, last->x);
    directions(m, a, &at, at.node, false);
    const double k = a->stiffness[at.element[0]];
    for (int i = 0; i < 3; i++) of->x[3 * at.node[0] + i] += k * last->x[i][0];
    return of->t[at.element[0]] + cpsi_halves_dot(m, last->x)[0];
}

/* The joint, after the middle node: its tension t, and the middle node under its force -v t. */
static Found backward_joint(const CpsiChainFactor *chain, const CpsiMatrix *a,
                            const CpsiUnknowns *of, double h, Found *middle) {
    const CpsiChainJoint *joint = &chain->joint;
    const CpsiPlaces at = cpsi_chain_next(a, cpsi_chain_middle(a), false);
    CpsiHalves pull[3];
    double t = -h;
    for (int i = 0; i < 3; i++) t += joint->vt[i] * middle->x[i][0];
    t *= joint->tt;
    for (int i = 0; i < 3; i++) pull[i] = cpsi_halves(-joint->v[i] * t, -joint->v[i] * t);
    pull_nodes(chain, a, of, &at, pull, middle, false);
    of->t[at.node[0] + 1] = t;
    Found out = *middle;
    out.t = cpsi_halves(t, t);
    return out;
}

/* Forward elimination and back substitution. */
CPSI_HALVES_FUNCTION void solve(const CpsiChainFactor *chain, const CpsiMatrix *a,
                                const CpsiUnknowns *of, const bool plain) {
    const int both = cpsi_chain_behind(a), middle = cpsi_chain_middle(a);
    double h = 0;
    Found found = {.t = {0, 0}}, last = found;
    for (int j = 0; j < both; j++) forward(chain, a, of, j, true, &found, plain);
    if (both > 0) {
        last = twice(&found, 1);
        found = twice(&found, 0);
        h = forward_joint(a, of, &last);
    }
    for (int j = both; j <= middle; j++) forward(chain, a, of, j, false, &found, plain);
    if (both > 0) last = backward_joint(chain, a, of, h, &found);
    for (int j = middle - 1; j >= both; j--) backward(chain, a, of, j, false, &found, plain);
    for (int i = 0; i < 3; i++) found.x[i][1] = last.x[i][1];
    found.t[1] = last.t[1];
    for (int j = both - 1; j >= 0; j--) backward(chain, a, of, j, true, &found, plain);
    of->t[0] = 0; /* there is no element 0 */
}

void cpsi_chain_pass(const CpsiLinsys *self, const CpsiMatrix *a, const CpsiUnknowns *of) {
    const CpsiChainFactor *chain = (const CpsiChainFactor *)self;
    if (cpsi_chain_is_plain(a))
        solve(chain, a, of, true);
    else
        solve(chain, a, of, false);
}
