/* SPDX-License-Identifier: BSD-3-Clause */
/* Poses, forces and moments of rigid bodies (bodies.h).
 *
 * A point s of the body is at x + R s, R the rotation matrix of the quaternion. On a body act the
 * lines at its points, with moments (R s) x f; its load; and the support of a held one, or of fixed
 * directions:
 *
 *     lines + load + support = residual
 *
 * The load is weight W at R g, buoyancy B at R b, the given load, and what the energy E = q' C q/2
 * of the water loses: q = (x - x_0, v), v the rotation vector of R R_0'. The moment of the last is
 * -dE/dt of the pose that turns on by t about each axis, by differences of the energy itself. */
#include "bodies.h"

#include "bodies_together.h"
#include "groups.h"
#include "joint_motion.h"
#include "points.h"

#include <float.h>
#include <math.h>
#include <netcdf.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BODIES = 1000, MOST_NAME = 256 };

/* Sums of a few numbers of the file per sum of their sizes; a balance, in tolerances of the step;
 * places per length; unit quaternions. */
static const double SUMS = 1e-12, BALANCED = 100, COPIED = 1e-12, UNIT = 1e-12,
                    TURNED = 1e-9, /* [rad] rounding of quaternions that are read */
    ROUNDINGS = 16;                /* roundings of places in an acceleration */

/* ---- reading ---- */

static int complain(FILE *log, const char *sentence, const char *what) {
    if (log) fprintf(log, "%s %s\n", sentence, what);
    return -1;
}

/* A variable with these lengths of its dimensions, from `start` in the first of them, `each` of
 * that; all numbers must be finite, unless they may miss. */
static int read_array(const Source *source, const char *name, size_t rank, const size_t *length,
                      size_t start, size_t each, bool may_miss, double *value, FILE *log) {
    size_t from[4] = {start}, count[4] = {each}, numbers = each, found = 0;
    int id, found_rank = 0, dimension[NC_MAX_VAR_DIMS];
    int status = nc_inq_varid(source->nc, name, &id);
    if (!status) status = nc_inq_varndims(source->nc, id, &found_rank);
    if (status || (size_t)found_rank != rank)
        return complain(log, "missing or misshapen variable", name);
    status = nc_inq_vardimid(source->nc, id, dimension);
    for (size_t d = 0; d < rank && !status; d++) {
        status = nc_inq_dimlen(source->nc, dimension[d], &found);
        if (!status && found != length[d]) status = NC_EBADDIM;
        if (d > 0) numbers *= count[d] = length[d];
    }
    if (!status) status = nc_get_vara_double(source->nc, id, from, count, value);
    if (may_miss) numbers = 0;
    for (size_t i = 0; i < numbers && !status; i++)
        if (!isfinite(value[i])) status = NC_ERANGE;
    return status ? complain(log, "wrong shape of, or a value that cannot be in,", name) : 0;
}

/* A constant of body k, of `width` numbers (and rows of as many, `square`). */
static int read_constant(const Source *source, const Bodies *bodies, const char *name, size_t k,
                         size_t width, bool square, double *value, FILE *log) {
    const size_t length[] = {bodies->count, width, width};
    return read_array(source, name,
                      width == 0 ? 1
                      : square   ? 3
                                 : 2,
                      length, k, 1, false, value, log);
}

/* One of the four 3x3 blocks of a 6x6 matrix, row by row. */
static void put_block(const double *block, int which, double *matrix) {
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            matrix[SIX * (3 * (which / 2) + i) + 3 * (which % 2) + k] = block[3 * i + k];
}

static int read_body(const Source *source, const Bodies *bodies, size_t k, FILE *log) {
    BodyData *data = &bodies->data[k];
    double kind, fixed[SIX];
    int bad = read_constant(source, bodies, "kind_of_body", k, 0, false, &kind, log);
    bad |= read_constant(source, bodies, "weight_of_body", k, 0, false, &data->weight, log);
    bad |= read_constant(source, bodies, "buoyancy_of_body", k, 0, false, &data->buoyancy, log);
    bad |= read_constant(source, bodies, "fixed_of_body", k, SIX, false, fixed, log);
    bad |= read_constant(source, bodies, "centre_of_gravity_of_body", k, 3, false,
                         data->centre_of_gravity, log);
    bad |= read_constant(source, bodies, "centre_of_buoyancy_of_body", k, 3, false,
                         data->centre_of_buoyancy, log);
    bad |= read_constant(source, bodies, "start_position_of_body", k, 3, false,
                         data->start_position, log);
    bad |= read_constant(source, bodies, "start_rotation_of_body", k, FOUR, false,
                         data->start_rotation, log);
    static const char *const BLOCK[] = {"hydrostatics_xx_of_body", "hydrostatics_xr_of_body",
                                        "hydrostatics_rx_of_body", "hydrostatics_rr_of_body"};
    for (int i = 0; i < 4; i++) {
        double block[9] = {0};
        bad |= read_constant(source, bodies, BLOCK[i], k, 3, true, block, log);
        put_block(block, i, data->hydrostatics);
    }
    if (bad) return -1;
    for (int i = 0; i < SIX; i++) data->fixed[i] = fixed[i] != 0;
    if (!(kind >= 0 && kind < BODY_KINDS) || !(data->weight >= 0) || !(data->buoyancy >= 0))
        return complain(log, "senseless kind, weight or buoyancy of body", data->name);
    data->kind = (int)kind;
    return 0;
}

/* The names, separated by blanks. */
static int read_names(const Source *source, Bodies *bodies, FILE *log) {
    size_t bytes = 0, found = 0;
    int status = nc_inq_attlen(source->nc, NC_GLOBAL, "bodies", &bytes);
    if (status || bytes > bodies->count * MOST_NAME)
        return complain(log, "cannot read attribute", "bodies");
    char *text = calloc(bytes + 1, 1);
    if (!text) return complain(log, "out of memory for", "bodies");
    status = nc_get_att_text(source->nc, NC_GLOBAL, "bodies", text);
    for (char *name = strtok(text, " "); name; name = strtok(NULL, " ")) {
        if (found < bodies->count) bodies->data[found].name = strdup(name);
        found++;
    }
    free(text);
    for (size_t k = 0; k < bodies->count; k++)
        if (!bodies->data[k].name) status = NC_ENOMEM;
    if (status || found != bodies->count)
        return complain(log, "as many names as the dimension says are not in", "bodies");
    return 0;
}

static int read_points(const Source *source, Bodies *bodies, FILE *log) {
    const size_t n = source->points, length[] = {n, 3};
    double *body = calloc(n + 1, sizeof *body);
    bodies->of_point = calloc(n + 1, sizeof *bodies->of_point);
    bodies->place = calloc(n + 1, sizeof *bodies->place);
    int bad = body && bodies->of_point && bodies->place
                  ? 0
                  : complain(log, "out of memory for", "points");
    if (!bad) bad = read_array(source, "body_of_point", 1, length, 0, n, false, body, log);
    if (!bad)
        bad = read_array(source, "place_on_body_of_point", 2, length, 0, n, true, bodies->place[0],
                         log);
    for (size_t k = 0; k < n && !bad; k++) {
        const bool is_on = source->point_kind[k] == POINT_KIND_ON_BODY;
        if (!(body[k] >= ON_NO_BODY && body[k] < (double)bodies->count) ||
            is_on != (body[k] >= 0) ||
            (is_on && !(isfinite(bodies->place[k][0]) && isfinite(bodies->place[k][1]) &&
                        isfinite(bodies->place[k][2]))))
            bad = complain(log, "senseless body of point", source->point_name[k]);
        else
            bodies->of_point[k] = (int)body[k];
    }
    free(body);
    return bad;
}

int bodies_open(const Source *source, Bodies *bodies, FILE *log) {
    int dimension;
    *bodies = (Bodies){0};
    if (nc_inq_dimid(source->nc, "body", &dimension) != NC_NOERR) {
        for (size_t k = 0; k < source->points; k++)
            if (source->point_kind[k] == POINT_KIND_ON_BODY)
                return complain(log, "on a body, of which the file has none, is point",
                                source->point_name[k]);
        return 0;
    }
    size_t count = 0;
    if (nc_inq_dimlen(source->nc, dimension, &count) != NC_NOERR || count == 0 ||
        count > MOST_BODIES)
        return complain(log, "senseless dimension", "body");
    bodies->data = calloc(count, sizeof *bodies->data);
    if (!bodies->data) return complain(log, "out of memory for", "bodies");
    bodies->count = count;
    if (read_names(source, bodies, log)) return -1;
    for (size_t k = 0; k < count; k++)
        if (read_body(source, bodies, k, log)) return -1;
    return read_points(source, bodies, log);
}

void bodies_close(Bodies *bodies) {
    for (size_t k = 0; k < bodies->count; k++) free(bodies->data[k].name);
    free(bodies->data);
    free(bodies->of_point);
    free(bodies->place);
    *bodies = (Bodies){0};
}

/* One step of a variable (step, body, width, width). */
static int read_step(const Source *source, const Bodies *bodies, const char *name, size_t step,
                     size_t width, bool square, double *value, FILE *log) {
    const size_t length[] = {source->steps, bodies->count, width, width};
    return read_array(source, name,
                      width == 0 ? 2
                      : square   ? 4
                                 : 3,
                      length, step, 1, false, value, log);
}

int bodies_read(const Source *source, const Bodies *bodies, size_t step, BodyState *all,
                FILE *log) {
    enum { FIELDS = 19, BLOCKS = 11, WORDS = 15, MOST = 9 };
    static const struct {
        const char *name;
        size_t width;
    } FIELD[FIELDS] = {{"position_of_body", 3},     {"rotation_of_body", FOUR},
                       {"lines_of_body", 3},        {"lines_moment_of_body", 3},
                       {"load_of_body", 3},         {"load_moment_of_body", 3},
                       {"support_of_body", 3},      {"support_moment_of_body", 3},
                       {"residual_of_body", 3},     {"residual_moment_of_body", 3},
                       {"proof_of_body", 3},        {"stiffness_xx_of_body", 3},
                       {"stiffness_xr_of_body", 3}, {"stiffness_rx_of_body", 3},
                       {"stiffness_rr_of_body", 3}, {"state_of_body", 0},
                       {"stable_of_body", 0},       {"has_place_of_body", 0},
                       {"proof_moment_of_body", 0}};
    double *value = calloc(bodies->count * MOST, sizeof *value);
    if (!value) return complain(log, "out of memory for", "bodies");
    int bad = 0;
    for (int i = 0; i < FIELDS && !bad; i++) {
        const bool is_block = i >= BLOCKS && i < WORDS;
        const size_t n = is_block ? 9 : i >= WORDS ? 1 : FIELD[i].width;
        bad = read_step(source, bodies, FIELD[i].name, step, FIELD[i].width, is_block, value, log);
        for (size_t k = 0; k < bodies->count && !bad; k++) {
            BodyState *at = &all[k];
            double *const to[BLOCKS] = {at->position,     at->rotation,    at->lines,
                                        &at->lines[3],    at->load,        &at->load[3],
                                        at->support,      &at->support[3], at->residual,
                                        &at->residual[3], at->proof};
            const double *from = value + n * k;
            if (i < BLOCKS) memcpy(to[i], from, n * sizeof *from);
            if (is_block) put_block(from, i - BLOCKS, at->stiffness);
            if (i == WORDS && !(*from >= 0 && *from < BODY_KINDS))
                bad = complain(log, "unknown state of body", bodies->data[k].name);
            else if (i == WORDS)
                at->kind = (int)*from;
            if (i == WORDS + 1) at->is_stable = *from != 0;
            if (i == WORDS + 2) at->has_place = *from != 0;
            if (i == WORDS + 3) at->proof_moment = *from;
        }
    }
    free(value);
    return bad;
}

/* ---- rotations ---- */

void body_matrix(const double q[FOUR], Real m[3][3]) {
    const Real w = q[0], x = q[1], y = q[2], z = q[3], s = 2 / (w * w + x * x + y * y + z * z);
    const Real rows[3][3] = {{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                             {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                             {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
    memcpy(m, rows, sizeof rows);
}

static void apply(Real m[3][3], const double *v, Real out[3]) {
    for (int i = 0; i < 3; i++) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
}

void body_place(const Vector position, const double rotation[FOUR], const Vector on_body,
                Real place[3]) {
    Real m[3][3];
    body_matrix(rotation, m);
    apply(m, on_body, place);
    for (int i = 0; i < 3; i++) place[i] += position[i];
}

/* The rotation vector of the rotation that leads from quaternion q0 to exp(t e_axis) q: by at most
 * half a turn, or with `near`, that of another pose, beyond it on the side of that one. */
static void turned_by(const double q0[FOUR], const double q[FOUR], int axis, Real t,
                      const Real *near, Real v[3]) {
    Real p[FOUR] = {cosl(t / 2), 0, 0, 0}, r[FOUR], w[FOUR];
    p[1 + axis] = sinl(t / 2);
    /* r = p q, w = r q0* */
    r[0] = p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3];
    r[1] = p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2];
    r[2] = p[0] * q[2] + p[2] * q[0] + p[3] * q[1] - p[1] * q[3];
    r[3] = p[0] * q[3] + p[3] * q[0] + p[1] * q[2] - p[2] * q[1];
    w[0] = r[0] * q0[0] + r[1] * q0[1] + r[2] * q0[2] + r[3] * q0[3];
    w[1] = -r[0] * q0[1] + r[1] * q0[0] - r[2] * q0[3] + r[3] * q0[2];
    w[2] = -r[0] * q0[2] + r[2] * q0[0] - r[3] * q0[1] + r[1] * q0[3];
    w[3] = -r[0] * q0[3] + r[3] * q0[0] - r[1] * q0[2] + r[2] * q0[1];
    const bool other = near && w[1] * near[0] + w[2] * near[1] + w[3] * near[2] < 0;
    const Real sign = (near ? other : w[0] < 0) ? -1 : 1,
               sine = sqrtl(w[1] * w[1] + w[2] * w[2] + w[3] * w[3]),
               angle = 2 * atan2l(sine, sign * w[0]);
    for (int i = 0; i < 3; i++)
        v[i] = sine > 0 ? sign * angle * w[1 + i] / sine : 2 * sign * w[1 + i] / fabsl(w[0]);
}

/* ---- load ---- */

/* Twice the energy of the water in the pose that has turned on by t about an axis. */
static Real twice_energy(const BodyData *data, const Vector position, const double rotation[FOUR],
                         int axis, Real t, const Real *near) {
    Real q[SIX], sum = 0;
    for (int i = 0; i < 3; i++) q[i] = (Real)position[i] - data->start_position[i];
    turned_by(data->start_rotation, rotation, axis, t, near, &q[3]);
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < SIX; k++) sum += q[i] * data->hydrostatics[SIX * i + k] * q[k];
    return sum;
}

static void add_force(Real load[SIX], const Real force[3], const Real arm[3]) {
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        load[i] += force[i];
        load[3 + i] += arm[k] * force[l] - arm[l] * force[k];
    }
}

/* [rad] Steps of differences: those of the fourth order leave the fourth power. */
static const Real TURN = 1e-4L;

void body_load_beside(const BodyData *data, const Vector position, const double rotation[FOUR],
                      const double side[FOUR], const double gravity[3], Real load[SIX]) {
    Real m[3][3], arm[3], force[3];
    memset(load, 0, SIX * sizeof *load);
    body_matrix(rotation, m);
    for (int i = 0; i < 3; i++) force[i] = (Real)data->weight * gravity[i];
    apply(m, data->centre_of_gravity, arm);
    add_force(load, force, arm);
    for (int i = 0; i < 3; i++) force[i] = -(Real)data->buoyancy * gravity[i];
    apply(m, data->centre_of_buoyancy, arm);
    add_force(load, force, arm);
    Real q[SIX], beside[3];
    for (int i = 0; i < 3; i++) q[i] = (Real)position[i] - data->start_position[i];
    turned_by(data->start_rotation, side, 0, 0, NULL, beside);
    /* half a turn from the start the vector jumps; derivatives are those on the side of the pose */
    const Real *near =
        beside[0] * beside[0] + beside[1] * beside[1] + beside[2] * beside[2] > 1 ? beside : NULL;
    turned_by(data->start_rotation, rotation, 0, 0, near, &q[3]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < SIX; k++) load[i] -= (Real)data->hydrostatics[SIX * i + k] * q[k];
    for (int i = 0; i < 3; i++) {
        Real e[4];
        for (int k = 0; k < 4; k++)
            e[k] =
                twice_energy(data, position, rotation, i, TURN * (Real[]){-2, -1, 1, 2}[k], near);
        load[3 + i] -= (8 * (e[2] - e[1]) - (e[3] - e[0])) / (24 * TURN);
    }
}

void body_load(const BodyData *data, const Vector position, const double rotation[FOUR],
               const double gravity[3], Real load[SIX]) {
    body_load_beside(data, position, rotation, rotation, gravity, load);
}

/* ---- check ---- */

typedef struct Check {
    const Source *source;
    const Bodies *bodies;
    Record *line;                                      /* (lines) of the step */
    Junction *point;                                   /* (points) of the step */
    BodyState *now, *before, *older;                   /* (count) */
    BodyMotion *motion, *motion_before, *motion_older; /* (count) */
    double *arm;     /* (count) [m] of its farthest point; else its longest line */
    int *sign;       /* (count) of its stiffness, with those of others (bodies_together.h) */
    double largest;  /* [N] of the step */
    double rounding; /* [N] of the tensions by that of places */
    size_t step, body;
    BodyFinding *find;
    void *user;
} Check;

__attribute__((format(printf, 2, 3))) static void find(const Check *c, const char *format, ...) {
    char sentence[300];
    va_list list;
    va_start(list, format);
    vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    c->find(c->user, c->bodies->data[c->body].name, c->step, sentence);
}

/* value <= bound, with NaN a finding */
static void at_most(const Check *c, const char *what, double value, double bound) {
    if (!(value <= bound)) find(c, "%s is %.6g, allowed %.3g", what, value, bound);
}

static double size(const double *v) { return hypot(hypot(v[0], v[1]), v[2]); }

static double apart(const double *a, const Real *b) {
    return hypot(hypot(a[0] - (double)b[0], a[1] - (double)b[1]), a[2] - (double)b[2]);
}

static bool is_on(const Check *c, size_t point) {
    return c->bodies->of_point[point] == (int)c->body;
}

static void check_places(const Check *c, const BodyState *at) {
    const double length =
        hypot(hypot(at->rotation[0], at->rotation[1]), hypot(at->rotation[2], at->rotation[3]));
    at_most(c, "length of the quaternion beside 1", fabs(length - 1), UNIT);
    for (size_t k = 0; k < c->source->points; k++) {
        Real place[3];
        if (!is_on(c, k)) continue;
        if (c->point[k].state != POINT_ON_BODY)
            find(c, "point %s is said to be off it", c->source->point_name[k]);
        body_place(at->position, at->rotation, c->bodies->place[k], place);
        at_most(c, "distance of a point from its place on the body",
                apart(c->point[k].position, place),
                COPIED *
                    (size(at->position) + size(c->bodies->place[k]) + size(c->source->origin)));
    }
}

/* Force and moment of the ends of lines at its points. */
static void check_lines(const Check *c, const BodyState *at) {
    Real sum[SIX] = {0}, m[3][3];
    double forces = 0, moments = 0;
    body_matrix(at->rotation, m);
    for (size_t i = 0; i < c->source->lines; i++)
        for (int e = 0; e < 2; e++) {
            const int k = c->line[i].end_point[e];
            if (k < 0 || !is_on(c, (size_t)k)) continue;
            Real pull[3], arm[3];
            for (int a = 0; a < 3; a++) pull[a] = -(Real)c->line[i].end_force[e][a];
            apply(m, c->bodies->place[k], arm);
            add_force(sum, pull, arm);
            forces += size(c->line[i].end_force[e]);
            moments += size(c->line[i].end_force[e]) * size(c->bodies->place[k]);
        }
    at_most(c, "force of the lines against that of their ends", apart(at->lines, sum),
            SUMS * forces);
    at_most(c, "moment of the lines against that of their ends", apart(&at->lines[3], &sum[3]),
            SUMS * moments);
}

/* [N], [N m] Sizes whose sum the load is: their rounding is in it. */
static void sizes_of_load(const Check *c, const BodyState *at, double noise[2]) {
    const BodyData *data = &c->bodies->data[c->body];
    noise[0] = data->weight + data->buoyancy + size(at->lines) + size(at->load) + size(at->support);
    noise[1] = data->weight * size(data->centre_of_gravity) +
               data->buoyancy * size(data->centre_of_buoyancy) + size(&at->lines[3]) +
               size(&at->load[3]) + size(&at->support[3]) + c->arm[c->body] * c->largest;
}

static void check_balance(const Check *c, const BodyState *at, bool certified) {
    const BodyData *data = &c->bodies->data[c->body];
    Real sum[SIX];
    double noise[2];
    sizes_of_load(c, at, noise);
    const BodyMotion *motion = &c->motion[c->body];
    for (int i = 0; i < SIX; i++)
        sum[i] = (Real)at->lines[i] + at->load[i] + at->support[i] + motion->inertia[i] +
                 motion->damped[i];
    noise[0] += size(motion->inertia) + size(motion->damped);
    noise[1] += size(&motion->inertia[3]) + size(&motion->damped[3]);
    at_most(c, "residual force against the sum", apart(at->residual, sum), SUMS * noise[0]);
    at_most(c, "residual moment against the sum", apart(&at->residual[3], &sum[3]),
            SUMS * noise[1]);
    for (int i = 0; i < SIX; i++) {
        const bool is_held = at->kind == BODY_HELD || data->fixed[i];
        if (!is_held)
            at_most(c, "support in a direction that is not fixed", fabs(at->support[i]), 0);
        if (is_held)
            at_most(c, "residual where it is held", fabs(at->residual[i]), SUMS * noise[i / 3]);
    }
    const double left = fmax(size(at->residual), size(&at->residual[3]) / c->arm[c->body]);
    const bool is_balanced =
        left <= BALANCED * c->source->tolerance * c->largest + SUMS * noise[0] + c->rounding;
    if (at->has_place && !is_balanced)
        find(c, "it is said to have a place, but %.6g N are left, of %.6g N", left, c->largest);
    if (!at->has_place && certified)
        find(c, "it has no place, but lines that end on it are certified");
}

/* Whether the symmetric part in the directions that are not fixed, lengths in arms, has only
 * positive pivots; 0: some are too small to say. */
static int sign_of(const BodyData *data, const double *stiffness, double arm) {
    Real m[SIX * SIX], most = 0;
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < SIX; k++) {
            const double unit = (i < 3 ? 1 : arm) * (k < 3 ? 1 : arm);
            const bool out = data->fixed[i] || data->fixed[k];
            m[SIX * i + k] =
                out ? 0 : 0.5 * (stiffness[SIX * i + k] + stiffness[SIX * k + i]) / unit;
            most = fmaxl(most, fabsl(m[SIX * i + k]));
        }
    for (int i = 0; i < SIX; i++)
        if (data->fixed[i]) m[(SIX + 1) * i] = most > 0 ? most : 1;
    return pivots_of(m, SIX);
}

/* Of each free body, together with those that lines connect to it. */
static void find_signs(Check *c) {
    const double none[3] = {0, 0, 0};
    const StiffnessStep step = {c->source, c->bodies, c->line, none, c->step, false};
    for (size_t k = 0; k < c->bodies->count; k++)
        c->sign[k] = c->now[k].kind == BODY_FREE
                         ? sign_of(&c->bodies->data[k], c->now[k].stiffness, c->arm[k])
                         : 1;
    bodies_together(&step, c->now, c->point, c->arm, c->sign);
}

static void check_stable(const Check *c, const BodyState *at) {
    if (at->kind == BODY_HELD) {
        if (!at->is_stable || !at->has_place)
            find(c, "it is held, but not stable or without a place");
        for (int i = 0; i < SIX * SIX; i++)
            if (at->stiffness[i] != 0) {
                find(c, "it is held, but has a stiffness");
                break;
            }
        return;
    }
    const int sign = c->sign[c->body];
    if (sign != 0 && at->is_stable != (sign > 0))
        find(c, "it is said to be %s, but its stiffness is %s",
             at->is_stable ? "stable" : "not stable",
             sign > 0 ? "positive"
             : sign_of(&c->bodies->data[c->body], at->stiffness, c->arm[c->body]) > 0
                 ? "not with that of others"
                 : "not");
}

/* The vector of the one turn by which `to` follows `from`, unit quaternions. */
static void turn_between(const double *from, const double *to, double turn[3]) {
    const double w = to[0] * from[0] + to[1] * from[1] + to[2] * from[2] + to[3] * from[3];
    double v[3];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        v[i] = to[1 + i] * from[0] - to[0] * from[1 + i] - to[1 + j] * from[1 + k] +
               to[1 + k] * from[1 + j];
    }
    const double sine = size(v), angle = 2 * atan2(sine, fabs(w));
    for (int i = 0; i < 3; i++) turn[i] = sine > 0 ? (w < 0 ? -1 : 1) * angle * v[i] / sine : 0;
}

/* In a step of one part the turn of a body has no component about a fixed axis. */
static void check_turn(const Check *c, const double *from, const double *to) {
    const BodyData *data = &c->bodies->data[c->body];
    for (size_t i = 0; i < c->source->lines; i++)
        if (c->line[i].substeps != 1) return;
    double turn[3];
    turn_between(from, to, turn);
    for (int i = 0; i < 3; i++)
        if (data->fixed[3 + i]) at_most(c, "rotation about a fixed axis", fabs(turn[i]), TURNED);
}

/* A free body does not move along its fixed axes. */
static void check_fixed(const Check *c, const BodyState *at) {
    const BodyData *data = &c->bodies->data[c->body];
    const BodyState *was = &c->before[c->body];
    const bool first = c->step == 0;
    if (at->kind != BODY_FREE || (first ? data->kind : was->kind) != BODY_FREE) return;
    const double *from = first ? data->start_position : was->position,
                 *turned = first ? data->start_rotation : was->rotation;
    const double allowed =
        COPIED * (size(at->position) + size(c->source->origin) + c->arm[c->body]);
    for (int i = 0; i < 3; i++)
        if (data->fixed[i])
            at_most(c, "displacement in a fixed direction", fabs(at->position[i] - from[i]),
                    allowed);
    if (!first) check_turn(c, turned, at->rotation);
    double product = 0, sizes[2] = {0};
    for (int k = 0; k < FOUR; k++) {
        product += at->rotation[k] * turned[k];
        sizes[0] += at->rotation[k] * at->rotation[k];
        sizes[1] += turned[k] * turned[k];
    }
    if (data->fixed[3] && data->fixed[4] && data->fixed[5]) /* 1 - cos of half the turn */
        at_most(c, "rotation of a body that does not turn",
                1 - fabs(product) / sqrt(sizes[0] * sizes[1]), COPIED);
}

/* Whether a line that ends on it claims to be certified. */
static bool is_claimed(const Check *c, bool (*certified)(int outcome)) {
    for (size_t i = 0; i < c->source->lines; i++)
        for (int e = 0; e < 2; e++) {
            const int k = c->line[i].end_point[e];
            if (k >= 0 && is_on(c, (size_t)k) && certified(c->line[i].outcome) &&
                !groups_claim(&c->line[i]))
                return true;
        }
    return false;
}

static void find_in_time(void *user, const char *what, double said, double expected) {
    find(user, "%s: %.9g, expected %.9g", what, said, expected);
}

static void check_motion(Check *c) {
    const size_t k = c->body;
    const BodySteps steps = {.data = &c->bodies->data[k],
                             .now = &c->now[k],
                             .before = c->step > 0 ? &c->before[k] : NULL,
                             .older = c->step > 1 ? &c->older[k] : NULL,
                             .motion = &c->motion[k],
                             .motion_before = &c->motion_before[k],
                             .motion_older = &c->motion_older[k],
                             .h = step_length_of(c->source, c->step),
                             .h_before = c->step > 0 ? step_length_of(c->source, c->step - 1) : 0,
                             .reach = size(c->now[k].position) + c->arm[k]};
    body_motion_check(&steps, find_in_time, c);
}

/* [N] M ((x - x*)/k - v*)/k rounds as poses do, which short steps magnify: M the mass of the body
 * and of the water about the reference point, places by the largest coordinate, turns by 1, moments
 * over the arm. */
static double rounding_of_inertia(const Check *c, size_t k) {
    const BodyMotion *motion = &c->motion[k];
    const double *g = c->bodies->data[k].centre_of_gravity, arm = c->arm[k],
                 place = size(c->now[k].position) + size(g);
    double of[2] = {motion->mass * place, motion->mass * place * size(g)};
    for (int i = 0; i < 3; i++) of[1] += fabs(motion->moments[i]) + 2 * fabs(motion->products[i]);
    for (int i = 0; i < SIX; i++)
        for (int j = 0; j < SIX; j++)
            of[i / 3] += fabs(motion->added[SIX * i + j]) * (j < 3 ? place : 1);
    return ROUNDINGS * DBL_EPSILON * fmax(of[0], of[1] / arm) / (motion->span * motion->span);
}

/* [N] The largest force in elastic lines and of loads. */
static void find_largest(Check *c) {
    c->largest = c->rounding = 0;
    for (size_t i = 0; i < c->source->lines; i++) {
        c->largest = fmax(c->largest, acts_in_line(&c->line[i]));
        c->rounding = fmax(c->rounding, rounding_in_line(&c->line[i]));
    }
    for (size_t k = 0; k < c->source->points; k++)
        c->largest = fmax(c->largest, size(c->point[k].load));
    for (size_t k = 0; k < c->bodies->count; k++)
        c->largest = fmax(c->largest, body_acting(c->source, &c->bodies->data[k], &c->now[k],
                                                  &c->motion[k], c->arm[k]));
    for (size_t k = 0; k < c->bodies->count; k++)
        if (c->motion[k].span > 0) c->rounding = fmax(c->rounding, rounding_of_inertia(c, k));
}

static int check_steps(Check *c, bool (*certified)(int outcome), FILE *log) {
    const Source *source = c->source;
    for (c->step = 0; c->step < source->steps; c->step++) {
        int bad = bodies_read(source, c->bodies, c->step, c->now, log);
        if (!bad) bad = junctions_read(source, c->step, c->point, log);
        if (!bad) bad = body_motions_read(source, c->bodies->count, c->step, c->motion, log);
        for (size_t i = 0; i < source->lines && !bad; i++)
            bad = record_read(source, source->line_name[i], c->step, &c->line[i], log);
        if (bad) return -1;
        find_largest(c);
        find_signs(c);
        for (c->body = 0; c->body < c->bodies->count; c->body++) {
            const BodyState *at = &c->now[c->body];
            check_places(c, at);
            check_lines(c, at);
            check_balance(c, at, is_claimed(c, certified));
            check_stable(c, at);
            check_fixed(c, at);
            check_motion(c);
        }
        BodyState *swap = c->older;
        BodyMotion *swap_motion = c->motion_older;
        c->older = c->before;
        c->before = c->now;
        c->now = swap;
        c->motion_older = c->motion_before;
        c->motion_before = c->motion;
        c->motion = swap_motion;
    }
    return 0;
}

/* The lines of the file, and how far the points of each body are from its reference point. */
static int open_lines(Check *c, FILE *log) {
    for (size_t i = 0; i < c->source->lines; i++)
        if (record_create(c->source, c->source->line_name[i], &c->line[i], log)) return -1;
    for (c->body = 0; c->body < c->bodies->count; c->body++) {
        double longest = 0, *arm = &c->arm[c->body];
        for (size_t k = 0; k < c->source->points; k++)
            if (is_on(c, k)) *arm = fmax(*arm, size(c->bodies->place[k]));
        for (size_t i = 0; i < c->source->lines; i++) {
            double length = 0;
            for (size_t k = 0; k < c->line[i].elements; k++) length += c->line[i].element_length[k];
            for (int e = 0; e < 2; e++)
                if (c->line[i].end_point[e] >= 0 && is_on(c, (size_t)c->line[i].end_point[e]))
                    longest = fmax(longest, length);
        }
        if (!(*arm > 0)) *arm = longest;
    }
    return 0;
}

int bodies_check(const Source *source, bool (*certified)(int outcome), BodyFinding *finding,
                 void *user, FILE *log) {
    Bodies bodies;
    Check c = {.source = source, .bodies = &bodies, .find = finding, .user = user};
    int bad = bodies_open(source, &bodies, log);
    if (!bad && bodies.count > 0) {
        c.line = calloc(source->lines, sizeof *c.line);
        c.point = calloc(source->points + 1, sizeof *c.point);
        c.now = calloc(bodies.count, sizeof *c.now);
        c.before = calloc(bodies.count, sizeof *c.before);
        c.older = calloc(bodies.count, sizeof *c.older);
        c.motion = calloc(bodies.count, sizeof *c.motion);
        c.motion_before = calloc(bodies.count, sizeof *c.motion_before);
        c.motion_older = calloc(bodies.count, sizeof *c.motion_older);
        c.arm = calloc(bodies.count, sizeof *c.arm);
        c.sign = calloc(bodies.count, sizeof *c.sign);
        bad = !c.line || !c.point || !c.now || !c.before || !c.older || !c.motion ||
                      !c.motion_before || !c.motion_older || !c.arm || !c.sign
                  ? -1
                  : open_lines(&c, log);
        if (!bad) bad = check_steps(&c, certified, log);
    }
    for (size_t i = 0; i < source->lines && c.line; i++) record_destroy(&c.line[i]);
    free(c.line);
    free(c.point);
    free(c.now);
    free(c.before);
    free(c.older);
    free(c.motion);
    free(c.motion_before);
    free(c.motion_older);
    free(c.arm);
    free(c.sign);
    bodies_close(&bodies);
    return bad;
}
