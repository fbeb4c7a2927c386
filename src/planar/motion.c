/* SPDX-License-Identifier: BSD-3-Clause */
/* A driven body: minimum dissipation over the twists that the drive leaves free (M77 Proposition
 * 2), with its proof.
 *
 * Twists are y = (vx, vy, reach w), so that all three are velocities. The drive fixes y in an
 * affine space of at most two free directions b_1, b_2. A convex function of one of them, minimised
 * over the other, has its minimum where its slope changes sign, which a bracket encloses. At the
 * two ends of the bracket there are two wrenches of the law with slopes of opposite sign; their
 * convex combination with slope zero lies in C as well. So the search ends with a wrench of C in
 * equilibrium with the drive, which gives Moreau's lower bound -<W, G> <= gamma(W), beside the
 * upper one phi(y). Kinks (a point contact at rest, a wheel that rolls) need no special treatment:
 * there the convex combination is the wrench in equilibrium. */
#include <float.h>
#include <math.h>

#include "base/status.h"
#include "planar/planar.h"

/* Maps whose rows are less independent than this are refused, since half of the digits would be
 * lost. */
static const double INDEPENDENT = 1e-8;

/* The upper and lower bound are promised to differ by at most this, relative to the upper one. */
static const double PROMISED = 1e-8;

/* Number of doublings of the first step, which is half the initial speed, after which a minimum
 * counts as not attained: at 1e6 times that speed. */
enum { DOUBLINGS = 22 };

/* Motions are searched up to this many times the driven speed; beyond, rounding hides the
 * differences between them. */
static const double FAR = 1e6;

/* Rounding of phi and of <y, G>, and the effect of the shortest bracket at a kink, relative to |y|
 * and the largest force found. */
static const double ROUNDING = 64 * DBL_EPSILON;

/* A point of the search. */
typedef struct Place {
    double y[3], force[3]; /* force: (Fx, Fy, M/reach) of C */
    double value, gap;
} Place;

typedef struct MotionSearch {
    const CpsPlanar *body;
    int rows;
    /* orthonormal: the first `rows` span the map's rows, the others are free directions */
    double q[3][3];
    double lower[3][3]; /* the map is lower q */
    double start[3];    /* the shortest y that agrees with the drive */
    double scale;       /* its length */
    double strongest;   /* largest force found */
    CpsSetOutcome outcome;
    CpsStatus status;
    CpsError *err;
} MotionSearch;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void add(double k, const double a[3], double to[3]) {
    for (int i = 0; i < 3; i++) to[i] += k * a[i];
}

/* ---- the affine space of the drive ---- */

/* Gram-Schmidt of a vector against q[0..k-1], twice for orthogonality to rounding. The coefficients
 * are written into row[]. Returns the remaining length, and sets q[k] where it is not 0. */
static double orthogonalise(double q[3][3], int k, const double vector[3], double *row) {
    double rest[3] = {vector[0], vector[1], vector[2]};
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < k; i++) {
            const double c = dot(q[i], rest);
            add(-c, q[i], rest);
            if (row) row[i] += c;
        }
    const double length = sqrt(dot(rest, rest));
    for (int i = 0; i < 3; i++) q[k][i] = length > 0 ? rest[i] / length : 0;
    return length;
}

/* Complete q[0..k-1] to three directions, using the axis with the largest remainder. */
static void complete(double q[3][3], int k) {
    for (; k < 3; k++) {
        int best = 0;
        double longest = -1;
        for (int axis = 0; axis < 3; axis++) {
            const double unit[3] = {axis == 0, axis == 1, axis == 2};
            const double length = orthogonalise(q, k, unit, NULL);
            if (length > longest) {
                longest = length;
                best = axis;
            }
        }
        orthogonalise(q, k, (double[3]){best == 0, best == 1, best == 2}, NULL);
    }
}

static CpsStatus set_drive(MotionSearch *self, int rows, const double *map, const double *velocity,
                           CpsError *err) {
    if (rows < 1 || rows > 3)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%d rows are driven, expected from 1 to 3", rows);
    CpsStatus status = cpsi_law_check_vector("map", 3 * rows, map, err);
    if (status == CPS_OK) status = cpsi_law_check_vector("driving velocity", rows, velocity, err);
    if (status != CPS_OK) return status;
    self->rows = rows;
    for (int k = 0; k < rows; k++) {
        const double row[3] = {map[3 * k], map[3 * k + 1], map[3 * k + 2] / self->body->reach},
                     length = sqrt(dot(row, row));
        self->lower[k][k] = orthogonalise(self->q, k, row, self->lower[k]);
        if (!(self->lower[k][k] > INDEPENDENT * length))
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "row %d of the map is 0 or depends on the rows above it", k + 1);
        double z = velocity[k];
        for (int i = 0; i < k; i++) z -= self->lower[k][i] * dot(self->q[i], self->start);
        add(z / self->lower[k][k], self->q[k], self->start);
    }
    complete(self->q, rows);
    self->scale = sqrt(dot(self->start, self->start));
    return CPS_OK;
}

/* Forces on the rows: map' drive = -G. */
static void drive_forces(const MotionSearch *self, const double force[3], double drive[3]) {
    for (int k = self->rows - 1; k >= 0; k--) {
        double sum = -dot(self->q[k], force);
        for (int i = k + 1; i < self->rows; i++) sum -= self->lower[i][k] * drive[i];
        drive[k] = sum / self->lower[k][k];
    }
}

/* ---- the search ---- */

/* phi and a force at place->y; false where there is none. */
static bool evaluate(MotionSearch *self, Place *place) {
    const double reach = self->body->reach,
                 twist[3] = {place->y[0], place->y[1], place->y[2] / reach};
    CpsSetAnswer answer;
    self->status =
        cpsi_planar_dissipation_rate(self->body, twist, place->force, NULL, &answer, self->err);
    if (self->status != CPS_OK) return false;
    if (answer.outcome != CPS_SET_OUTCOME_ANSWERED) self->outcome = answer.outcome;
    place->force[2] /= reach;
    place->value = answer.value;
    place->gap = answer.gap;
    self->strongest = fmax(self->strongest, sqrt(dot(place->force, place->force)));
    return answer.outcome == CPS_SET_OUTCOME_ANSWERED;
}

static bool minimise(MotionSearch *self, int level, Place *place);

/* The least value with coordinate t along free direction `level`, minimised over the later
 * directions, and its slope as a function of t. */
static bool at(MotionSearch *self, int level, const double base[3], double t, Place *place,
               double *slope) {
    for (int i = 0; i < 3; i++) place->y[i] = base[i];
    add(t, self->q[level], place->y);
    if (!minimise(self, level + 1, place)) return false;
    *slope = -dot(place->force, self->q[level]);
    return true;
}

static bool flat(double slope, const Place *place) {
    return fabs(slope) <= 8 * DBL_EPSILON * sqrt(dot(place->force, place->force));
}

/* One end of a bracket. */
typedef struct End {
    double t, slope;
    Place place;
} End;

/* Narrow a bracket with slopes of opposite sign until it is as short as rounding permits or a slope
 * vanishes: interpolate, truncate towards the middle, project (Oliveira and Takahashi 2020, ITP).
 * It is as fast as the secant method where the slope is smooth, and never more than one step behind
 * bisection. */
static bool close_bracket(MotionSearch *self, int level, const double base[3], End end[2]) {
    const double first = fabs(end[1].t - end[0].t);
    const double limit = 2 * DBL_EPSILON * (self->scale + fmax(fabs(end[0].t), fabs(end[1].t)));
    double reach = limit;
    while (reach < first) reach *= 2;
    for (; fabs(end[1].t - end[0].t) > limit; reach *= 0.5) {
        const double width = end[1].t - end[0].t, middle = end[0].t + 0.5 * width;
        const double secant = end[0].t + end[0].slope / (end[0].slope - end[1].slope) * width;
        const double inward = copysign(1, middle - secant), shift = 0.2 * width * width / first;
        const double truncated = fabs(middle - secant) > shift ? secant + inward * shift : middle;
        const double most = fmax(reach - 0.5 * fabs(width), 0);
        End next = {.t = fabs(truncated - middle) <= most ? truncated : middle - inward * most};
        if (!at(self, level, base, next.t, &next.place, &next.slope)) return false;
        end[(next.slope > 0) == (end[1].slope > 0)] = next;
        if (flat(next.slope, &next.place)) return true;
    }
    return true;
}

/* The convex combination of two ends whose force has slope 0 along the direction; y and value are
 * those of the end with the smaller slope. */
static void join(const End end[2], Place *out) {
    const double weight = end[0].slope / (end[0].slope - end[1].slope);
    const End *best = fabs(end[0].slope) <= fabs(end[1].slope) ? &end[0] : &end[1];
    *out = best->place;
    for (int i = 0; i < 3; i++)
        out->force[i] = (1 - weight) * end[0].place.force[i] + weight * end[1].place.force[i];
    out->gap = fmax(end[0].place.gap, end[1].place.gap);
}

/* Minimise along free directions `level` and above, from place->y. */
static bool minimise(MotionSearch *self, int level, Place *place) {
    if (level == 3) return evaluate(self, place);
    const double base[3] = {place->y[0], place->y[1], place->y[2]};
    End end[2] = {{.t = 0}, {.t = 0}};
    if (!at(self, level, base, 0, &end[0].place, &end[0].slope)) return false;
    if (flat(end[0].slope, &end[0].place)) {
        *place = end[0].place;
        return true;
    }

    /* downhill with doubling steps, until the slope changes sign */
    const Place first = end[0].place;
    const double downhill = end[0].slope > 0 ? -1 : 1;
    double step = 0.5 * sqrt(dot(base, base));
    for (int doublings = 0;; doublings++) {
        end[1].t = end[0].t + downhill * step;
        if (!at(self, level, base, end[1].t, &end[1].place, &end[1].slope)) return false;
        if (flat(end[1].slope, &end[1].place)) {
            *place = end[1].place;
            return true;
        }
        if ((end[1].slope > 0) != (end[0].slope > 0)) break;
        if (doublings == DOUBLINGS) {
            /* A slope below rounding: every point is a minimiser. Otherwise the problem is
             * unbounded below. */
            const double fall = fabs(first.value - end[1].place.value);
            *place = first;
            place->gap += fall;
            if (!(fall <= 0.25 * PROMISED * first.value))
                self->outcome = CPS_SET_OUTCOME_NOT_ATTAINED;
            return self->outcome == CPS_SET_OUTCOME_ANSWERED;
        }
        end[0] = end[1];
        step *= 2;
    }
    if (!close_bracket(self, level, base, end)) return false;
    join(end, place);
    return true;
}

/* Of two free directions, the steeper one is minimised inside, so that its remaining slope is the
 * smaller part of the other's. */
static bool turn_free_directions(MotionSearch *self, Place *place) {
    if (!evaluate(self, place)) return false;
    if (self->rows > 1) return true;
    double plane[3][3] = {{self->q[0][0], self->q[0][1], self->q[0][2]}};
    const double length = orthogonalise(plane, 1, place->force, NULL);
    if (!(length > INDEPENDENT * self->strongest)) return true;
    complete(plane, 2);
    for (int i = 0; i < 3; i++) {
        self->q[1][i] = plane[2][i];
        self->q[2][i] = plane[1][i];
    }
    return true;
}

/* ---- calls ---- */

static CpsStatus begin(MotionSearch *self, const CpsPlanar *body, int rows, const double *map,
                       const double *velocity, CpsError *err) {
    *self = (MotionSearch){.body = body, .outcome = CPS_SET_OUTCOME_ANSWERED, .err = err};
    return set_drive(self, rows, map, velocity, err);
}

CpsStatus cps_planar_drive(const CpsPlanar *body, int rows, const double *map,
                           const double *velocity, CpsPlanarMotion *motion, CpsError *err) {
    if (!body || !motion) return cpsi_fail(err, CPS_ERR_ARGUMENT, "body or motion is NULL");
    MotionSearch self;
    CpsStatus status = begin(&self, body, rows, map, velocity, err);
    if (status != CPS_OK) return status;
    Place place = {.y = {self.start[0], self.start[1], self.start[2]}};
    const bool found = turn_free_directions(&self, &place) && minimise(&self, rows, &place);
    if (self.status != CPS_OK) return self.status;
    CpsPlanarMotion out = {.outcome = self.outcome};
    if (found) {
        out.scale = sqrt(dot(place.y, place.y)) * self.strongest;
        const double rounding = ROUNDING * out.scale, slack = rounding + place.gap;
        out.lower = fmax(-dot(place.force, self.start) - slack, 0);
        out.upper = place.value + slack;
        if (!(out.upper - out.lower <= PROMISED * out.upper + 4 * rounding))
            out.outcome = CPS_SET_OUTCOME_INACCURATE;
        for (int i = 0; i < 3; i++) {
            out.twist[i] = i < 2 ? place.y[i] : place.y[i] / body->reach;
            out.wrench[i] = i < 2 ? place.force[i] : place.force[i] * body->reach;
        }
        drive_forces(&self, place.force, out.drive);
        const bool turns = out.twist[2] != 0;
        out.centre[0] = turns ? -out.twist[1] / out.twist[2] : INFINITY;
        out.centre[1] = turns ? out.twist[0] / out.twist[2] : INFINITY;
    }
    *motion = out;
    return CPS_OK;
}

/* How far one can go from `middle` along the last free direction before the least value exceeds
 * `level`. */
static bool extent(MotionSearch *self, const double middle[3], double level, double direction,
                   double *reach) {
    Place place;
    double slope, inside = 0, outside = 1e-6 * self->scale;
    while (outside < FAR * self->scale) {
        if (!at(self, self->rows, middle, direction * outside, &place, &slope)) return false;
        if (place.value > level) break;
        inside = outside;
        outside *= 4;
    }
    *reach = INFINITY;
    if (!(outside < FAR * self->scale)) return true;
    while (outside - inside > 1e-12 * outside) {
        const double t = 0.5 * (inside + outside);
        if (!at(self, self->rows, middle, direction * t, &place, &slope)) return false;
        *(place.value > level ? &outside : &inside) = t;
    }
    *reach = outside;
    return true;
}

CpsStatus cps_planar_motions(const CpsPlanar *body, int rows, const double *map,
                             const double *velocity, double tolerance, double low[3],
                             double high[3], CpsError *err) {
    if (!low || !high) return cpsi_fail(err, CPS_ERR_ARGUMENT, "low or high is NULL");
    if (!(tolerance >= 0) || !isfinite(tolerance))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the tolerance is %g, expected a number >= 0",
                         tolerance);
    CpsPlanarMotion motion;
    CpsStatus status = cps_planar_drive(body, rows, map, velocity, &motion, err);
    if (status != CPS_OK) return status;
    if (motion.outcome != CPS_SET_OUTCOME_ANSWERED)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "there is no motion to look around: %s",
                         cps_set_outcome_text(motion.outcome));
    const double middle[3] = {motion.twist[0], motion.twist[1], motion.twist[2] * body->reach};
    const double level = motion.upper + (tolerance > 0 ? tolerance : 1e-9) * motion.upper;
    for (int component = 0; component < 3; component++) {
        MotionSearch self;
        double ends[2] = {0, 0};
        begin(&self, body, rows, map, velocity, err);

        /* the free direction along which this component changes most comes first, so that the
         * others are minimised inside */
        const double unit[3] = {component == 0, component == 1, component == 2};
        const double share = rows < 3 ? orthogonalise(self.q, rows, unit, NULL) : 0;
        const bool moves = share > INDEPENDENT;
        if (moves) complete(self.q, rows + 1);
        if (moves)
            for (int side = 0; side < 2; side++)
                if (!extent(&self, middle, level, side ? 1 : -1, &ends[side]))
                    return self.status != CPS_OK
                               ? self.status
                               : cpsi_fail(err, CPS_ERR_ARGUMENT,
                                           "there is no motion to look around: %s",
                                           cps_set_outcome_text(self.outcome));
        const double unit_size = component < 2 ? 1 : body->reach;
        low[component] = motion.twist[component] - share * ends[0] / unit_size;
        high[component] = motion.twist[component] + share * ends[1] / unit_size;
        if (!moves) low[component] = high[component] = motion.twist[component];
    }
    return CPS_OK;
}
