/* SPDX-License-Identifier: BSD-3-Clause */
/* Inextensible lines at rest: which tensions are reported, and between which values they lie.
 *
 * On a bed that rubs by mu w per length a node takes at most mu w h from the tension, an end node
 * half of that. So with a force f at the free end B the element k from there has |T_k - f| <= q (k
 * + 1/2), q = mu w h, and the least sum of l (T - T_R)^2 is
 *
 *     T_R = 0, pulled by f:                T_k = max(0, f - q (k + 1/2))
 *     let go after that:                   T_k = min(T_R,k, q (k + 1/2))
 *
 * for both lie in the bounds of the end and are nearest to T_R element by element.
 *
 * Over a drum each node that turns a massless line by d lets T'/T lie in [1/k, k], k = (1 + mu
 * tan(d/2))/(1 - mu tan(d/2)): from T' cos(d/2) - T cos(d/2) = F, (T' + T) sin(d/2) = R, |F| <= mu
 * R.
 *
 * In a groove between walls at half angle alpha friction holds a node whatever presses it where
 * tan(alpha) <= mu: R grows with the friction that presses back. Then no tension is too large.
 *
 * Everything else, and these cases too, is compared with test/checker/rest.c, another program
 * solved by another method. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capstan/results.h"
#include "checker.h"
#include "rest.h"
#include "rig.h"
#include "sample.h"

static const double PI = 3.14159265358979323846;

/* by the checker ------------------------------------------------------------------------------- */

enum { NODES = 65, CONTACTS = 2 * NODES };

static double length_of(const double *v) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* The line of a view for the checker; touching and sliding by the places alone, to `fine` of the
 * length. */
typedef struct Copy {
    RestLine line;
    double normal[CONTACTS][3], slip[CONTACTS][3], friction[CONTACTS];
    RestContact contact[CONTACTS];
    bool held[CONTACTS];
} Copy;

/* False where friction acts on a node that has left its obstacle, as frozen friction lets it. */
static bool copy(const Rig *rig, const CpsLineView *view, const CpsLineReport *report, Copy *out) {
    const int n = view->element_count + 1;
    const double fine = 1e-9 * rig->line.length;
    memset(out, 0, sizeof *out);
    out->line = (RestLine){.elements = (size_t)view->element_count,
                           .contacts = (size_t)view->contact_count,
                           .element_length = view->element_length,
                           .position = (const double(*)[3])(const void *)view->position,
                           .load = (const double(*)[3])(const void *)view->load,
                           .normal = (const double(*)[3])(const void *)out->normal,
                           .slip = (const double(*)[3])(const void *)out->slip,
                           .friction = out->friction,
                           .contact = out->contact,
                           .frozen = rig->scene.friction_policy == CPS_FRICTION_POLICY_FROZEN,
                           .held = out->held,
                           .force = report->certificate.largest_force};
    out->held[0] = view->end[0].kind == CPS_END_KIND_HELD;
    out->held[n - 1] = view->end[1].kind == CPS_END_KIND_HELD;
    for (int c = 0; c < view->contact_count * n; c++) {
        const double *x = &view->position[3 * (c % n)], *from = &view->reference[3 * (c % n)],
                     *normal = &view->normal[3 * c];
        const int on = view->obstacle[c];
        double open = view->gap[c], up = 0;
        memcpy(out->normal[c], normal, sizeof out->normal[c]);
        for (int a = 0; a < 3; a++) up += normal[a] * (x[a] - from[a]);
        for (int a = 0; a < 3; a++) out->slip[c][a] = view->slip[3 * c + a];
        open += up;
        if (on < 0 || !(open <= fine)) {
            if (view->friction_bound[c] > 1e-9 * out->line.force) return false;
            continue;
        }
        out->friction[c] = out->line.frozen ? view->friction_bound[c] : rig->obstacle[on].friction;
        out->contact[c] =
            length_of(out->slip[c]) > fine && out->friction[c] > 0 ? REST_SLIPS : REST_STICKS;
    }
    return true;
}

static double worst_difference; /* of all that was compared, per largest force */

/* The range of both ends is that of the checker, each value between the bounds beside it, and the
 * tension found lies within. */
static bool compare(const char *name, const Rig *rig, const CpsLineView *view,
                    const CpsLineReport *report) {
    static Copy like;
    if (!copy(rig, view, report, &like)) return false;
    const double force = report->certificate.largest_force;
    for (int end = 0; end < 2; end++) {
        const CpsTensionRange *range = &report->end[end].range;
        const size_t e = end == CPS_END_A ? 0 : (size_t)view->element_count - 1;
        const double least = rest_tension(&like.line, e, -1),
                     greatest = rest_tension(&like.line, e, 1);
        const double close = 1e-7 * force; /* to which the program's values and bounds agree */
        printf("%s %c: tension %.9g in [%.9g, %.9g], by the checker [%.9g, %.9g]\n", name,
               "AB"[end], view -> tension[e], range -> least, range -> greatest, least, greatest);
        CHECK_INT(range->kind, isinf(greatest) ? CPS_RANGE_UNBOUNDED : CPS_RANGE_BOUNDED);
        CHECK_NEAR(range->least, least, close);
        CHECK_NEAR(range->greatest, greatest, close);
        CHECK_BETWEEN(view->tension[e], range->least - 1e-9 * force,
                      range->greatest + 1e-9 * force);
        /* primal and dual agree to the loop's gap of 1e-9 */
        CHECK_NEAR(range->least, range->least_bound, 1e-8 * force);
        CHECK_NEAR(range->greatest, range->greatest_bound, 1e-8 * force);
        worst_difference = fmax(worst_difference, fabs(range->least - least) / force);
        if (isfinite(greatest))
            worst_difference = fmax(worst_difference, fabs(range->greatest - greatest) / force);
    }
    return true;
}

/* on a bed ------------------------------------------------------------------------------------- */

enum { ELEMENTS = 40 };

/* A straight rope of length 2 from the origin along x on a bed with mu = 0.5, w = 9.81; A held
 * unless `turned`, when B is. */
static void bed(Rig *rig, double stiffness, bool turned, double lengths, double forces) {
    rig_begin(rig, ELEMENTS, 9.81 * forces / lengths, stiffness);
    rig_length(rig, 2 * lengths);
    rig_obstacle(rig, CPS_OBSTACLE_PLANE, 0.5);
    const double far = 2 * lengths;
    rig_point(rig, turned ? far : 0, 0, 0);
    rig_point(rig, turned ? 0 : far, 0, 0);
    rig_end(rig, turned ? CPS_END_B : CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
    rig_end(rig, turned ? CPS_END_A : CPS_END_B, CPS_END_KIND_FREE, 0, 0, 0);
}

static void pulled_and_let_go(bool turned, double lengths, double forces) {
    static Rig rig;
    const double q = 0.5 * 9.81 * forces * 2 / ELEMENTS, f = 4 * forces;
    const int near = turned ? CPS_END_A : CPS_END_B;
    bed(&rig, INFINITY, turned, lengths, forces);
    rig_stage(&rig, 1);
    rig_stage(&rig, 2);
    rig_change(&rig, near, CPS_END_KIND_FREE, f, 0, 0);
    rig_stage(&rig, 2);
    rig_change(&rig, near, CPS_END_KIND_FREE, 0, 0, 0);
    rig_stage(&rig, 3);
    RigRun run = rig_open(&rig);
    for (int stage = 0; stage < 4; stage++) {
        const CpsLineView view = rig_next(&run);
        for (int k = 0; k < ELEMENTS; k++) {
            const double fall = q * (k + 0.5), had = fmax(0, f - fall);
            const double want = stage == 0 ? 0 : stage == 1 ? had : fmin(had, fall);
            /* rounding, and the root of the loop's gap of 1e-13 where a node stands at its limit by
             * itself */
            CHECK_NEAR(view.tension[turned ? k : ELEMENTS - 1 - k], want, 1e-6 * f);
        }
        const double end = stage == 1 ? f : 0, all = q * (ELEMENTS - 0.5);
        const CpsTensionRange *range = &run.report.end[1 - near].range;
        CHECK_NEAR(range->least, fmax(0, end - all), 1e-9 * f);
        CHECK_NEAR(range->greatest, end + all, 1e-9 * f);
        CHECK_NEAR(run.report.end[near].range.greatest, end + q / 2, 1e-9 * f);
        if (stage != 1) continue;
        printf("bed: tension at the held end %.9g, least %.9g, greatest %.9g\n",
               view.tension[turned ? ELEMENTS - 1 : 0], range->least, range->greatest);
    }
    rig_close(&run);
}

static void on_a_bed(void **state) {
    (void)state;
    pulled_and_let_go(false, 1, 1);
    pulled_and_let_go(true, 1, 1);
    for (int k = -6; k <= 6; k += 3) {
        pulled_and_let_go(k % 2 == 0, pow(10, k), pow(10, -k));
        pulled_and_let_go(false, pow(10, k), pow(10, k));
    }
}

/* A rope with no force on it has none in it. */
static void without_force(void **state) {
    (void)state;
    static Rig rig;
    bed(&rig, INFINITY, false, 1, 1);
    rig_stage(&rig, 3);
    RigRun run = rig_open(&rig);
    const CpsLineView view = rig_next(&run);
    for (int e = 0; e < ELEMENTS; e++)
        CHECK_NEAR(view.tension[e], 0, 1e-9); /* rounding of forces of 10 N */
    CHECK_NEAR(run.report.end[CPS_END_A].range.least, 0, 0);
    rig_close(&run);
}

/* EA = 1e12 and infinite agree to 1e-3 at equal steps: pulled, let go, pulled again, with forces of
 * 60 kN. */
static void as_stiff_ones(void **state) {
    (void)state;
    static Rig rig[2];
    const double f = 6e4;
    RigRun run[2];
    for (int k = 0; k < 2; k++) {
        bed(&rig[k], k ? INFINITY : 1e12, false, 1, 1e4);
        rig_stage(&rig[k], 3);
        rig_change(&rig[k], CPS_END_B, CPS_END_KIND_FREE, f, 0, 0);
        rig_stage(&rig[k], 2);
        rig_change(&rig[k], CPS_END_B, CPS_END_KIND_FREE, f / 6, 0, 0);
        rig_stage(&rig[k], 4);
        rig_change(&rig[k], CPS_END_B, CPS_END_KIND_FREE, f / 2, 0, 0);
        run[k] = rig_open(&rig[k]);
    }
    for (int stage = 0; stage < 3; stage++) {
        const CpsLineView stiff = rig_next(&run[0]), firm = rig_next(&run[1]);
        double worst = 0;
        for (int e = 0; e < ELEMENTS; e++)
            worst = fmax(worst, fabs(stiff.tension[e] - firm.tension[e]));
        printf("EA = 1e12 and infinite: tensions differ by %.3g of the force, stage %d\n",
               worst / f, stage);
        CHECK_LESS(worst / f, 1e-3);
    }
    rig_close(&run[0]);
    rig_close(&run[1]);
}

/* Along a straight line only the axial coefficient counts, whatever the lateral one and the shape
 * of the set, in zones their mean; with a set given as such no range is told. */
static void with_directions(void **state) {
    (void)state;
    static Rig rig;
    static const double LATERAL[] = {0.8, 0.5, 0.1, 0};
    static const CpsFrictionZone zone = {.from = 0.5, .to = 1.5, .factor = 0.4};
    const double f = 4;
    CpsError err;
    CpsSet *disc = NULL;
    assert_int_equal(cps_set_ball(2, (const double[2]){0, 0}, 0.5, &disc, &err), CPS_OK);
    for (int k = 0; k < 18; k++) {
        const bool zones = k >= 8 && k < 16, given = k >= 16;
        bed(&rig, INFINITY, k % 3 == 0, 1, 1);
        if (k % 5 == 0) rig.scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
        if (given)
            rig.obstacle[0].friction_set = disc;
        else
            rig_lateral(&rig.obstacle[0], LATERAL[k % 4]);
        rig.obstacle[0].friction_shape =
            k / 4 % 2 ? CPS_FRICTION_SHAPE_BOX : CPS_FRICTION_SHAPE_ELLIPSE;
        if (zones) {
            rig.line.zone = &zone;
            rig.line.zone_count = 1;
        }
        const int near = k % 3 == 0 ? CPS_END_A : CPS_END_B;
        rig_stage(&rig, 1);
        rig_stage(&rig, 1);
        rig_change(&rig, near, CPS_END_KIND_FREE, f, 0, 0);
        CpsEvolution *evolution;
        assert_int_equal(cps_evolution_create(&rig.scene, &evolution, &err), CPS_OK);
        while (cps_evolution_remaining_count(evolution) > 0)
            assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
        const CpsLineReport report = cps_evolution_line_report(evolution, 0);
        CHECK_INT(report.outcome, CPS_OUTCOME_SOLVED);
        const CpsTensionRange *range = &report.end[1 - near].range;
        /* all but the held end's half element, which lies in no zone */
        const double length = (zones ? 1 + 0.4 : 2) - 1.0 / ELEMENTS, all = 0.5 * 9.81 * length;
        if (given) {
            CHECK_INT(range->kind, CPS_RANGE_NOT_GIVEN);
        } else {
            CHECK_NEAR(range->greatest, f + all, 1e-7 * f);
            CHECK_NEAR(range->least, fmax(0, f - all), 1e-7 * f);
        }
        cps_evolution_destroy(evolution);
    }
    cps_set_release(disc);
}

/* Where forces have no choice the range is a point: a line that hangs, and one that slides all
 * along. */
static void without_choice(void **state) {
    (void)state;
    static Rig rig;
    for (int slides = 0; slides < 2; slides++) {
        bed(&rig, INFINITY, false, 1, 1);
        if (!slides) rig.scene.obstacle_count = 0;
        rig_stage(&rig, 1);
        rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, slides ? 2.1 : 1.3, 0, slides ? 0 : 0.4);
        if (slides) rig_change(&rig, CPS_END_A, CPS_END_KIND_FREE, 0, 0, 0);
        CpsEvolution *evolution;
        assert_int_equal(cps_evolution_create(&rig.scene, &evolution, NULL), CPS_OK);
        assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
        const CpsLineReport report = cps_evolution_line_report(evolution, 0);
        CHECK_INT(report.outcome, CPS_OUTCOME_SOLVED);
        for (int end = 0; end < 2; end++) {
            const CpsTensionRange *range = &report.end[end].range;
            CHECK_INT(range->kind, CPS_RANGE_BOUNDED);
            CHECK_NEAR(range->greatest, range->least, 1e-9 * report.certificate.largest_force);
        }
        /* the pull of all friction but that of the half element at B, which moves with its
         * support */
        if (slides)
            CHECK_NEAR(report.end[CPS_END_B].range.least, 0.5 * 9.81 * (2 - 1.0 / ELEMENTS), 1e-8);
        cps_evolution_destroy(evolution);
    }
}

/* A line that hangs almost straight has one tension field: of two elements T = w h/(2 sin(angle)).
 * A node there holds its neighbours by their tension times a shallow angle, and what the checker
 * leaves a node to be off balance by is magnified by one over that angle. */
static void shallow(void **state) {
    (void)state;
    static Rig rig;
    for (int k = 0; k < 16; k++) {
        const int elements = k < 8 ? 2 : 2 + 3 * (k - 8) / 2;
        const double length = 2, slack = pow(10, -3 - (elements == 2 ? 0.75 : 0.5) *
                                                          (k % 8)); /* per length, from 6e-9 */
        rig_begin(&rig, elements, 9.81, INFINITY);
        rig_length(&rig, length);
        rig.line.start.kind = CPS_START_STATIC;
        rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_HELD, length * (1 - slack), 0, 0);
        rig_stage(&rig, 1);
        RigRun run = rig_open(&rig);
        const CpsLineView view = rig_next(&run);
        if (elements == 2) {
            const double sine = sqrt(slack * (2 - slack)), tension = 9.81 * length / 2 / (2 * sine);
            /* 1e-14 of the length is rounding, dT/T = d slack/(2 slack); and 1e-7 to which value
             * and bound agree */
            const double close = 1e-7 + 1e-14 / (2 * slack);
            CHECK_RELATIVE(run.report.end[CPS_END_A].range.least, tension, close);
            CHECK_RELATIVE(run.report.end[CPS_END_A].range.greatest, tension, close);
        }
        compare("shallow", &rig, &view, &run.report);
        rig_close(&run);
    }
}

/* The same of a mooring line laid between anchor and fairlead on a bed, drawn out until all of it
 * slides, paid back, held and drawn out again: elements rest, slip, lift and come down. */
static void moored_as_a_stiff_one(void **state) {
    (void)state;
    static const double TO[] = {840, 800, 0, 840};
    static Rig rig[2];
    RigRun run[2];
    for (int k = 0; k < 2; k++) {
        rig_begin(&rig[k], 60, 698.1, k ? INFINITY : 1e12);
        rig_length(&rig[k], 902.2);
        rig_obstacle(&rig[k], CPS_OBSTACLE_PLANE, 1);
        rig[k].line.start.kind = CPS_START_STATIC;
        rig_end(&rig[k], CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
        rig_end(&rig[k], CPS_END_B, CPS_END_KIND_HELD, 800, 0, 250);
        for (int stage = 0; stage < 4; stage++) {
            rig_stage(&rig[k], 3);
            if (TO[stage] > 0) rig_change(&rig[k], CPS_END_B, CPS_END_KIND_HELD, TO[stage], 0, 250);
        }
        run[k] = rig_open(&rig[k]);
    }
    double worst = 0, most = 0;
    for (int step = 0; step < 13; step++) {
        const CpsLineView stiff = rig_step(&run[0]), firm = rig_step(&run[1]);
        for (int e = 0; e < 60; e++) {
            worst = fmax(worst, fabs(stiff.tension[e] - firm.tension[e]));
            most = fmax(most, firm.tension[e]);
        }
    }
    printf(
        "mooring line, EA = 1e12 and infinite: tensions differ by %.3g of the largest, 13 steps\n",
        worst / most);
    CHECK_LESS(worst / most, 1e-3);
    rig_close(&run[0]);
    rig_close(&run[1]);
}

/* over a drum ---------------------------------------------------------------------------------- */

/* A massless line over `nodes` vertices of a polygon on a drum of radius 1, each turning it by d;
 * legs of length 0.5. */
static void drum(Rig *rig, int nodes, double d, double mu, bool held, double f) {
    double angle = PI - d / 2, x = -1,
           z = 0; /* direction of the chord that follows, and the first vertex */
    const double chord = 2 * sin(d / 2);
    rig_begin(rig, nodes + 1, 0, INFINITY);
    CpsObstacle *cylinder = rig_obstacle(rig, CPS_OBSTACLE_CYLINDER, mu);
    cylinder->axis[0] = 0;
    cylinder->axis[1] = 1;
    cylinder->axis[2] = 0;
    angle = PI / 2 - d / 2; /* of the chord from the first vertex at (-1, 0) upwards */
    double end[3];
    rig_point(rig, x - 0.5 * cos(angle + d), 0, z - 0.5 * sin(angle + d));
    memcpy(end, rig->point, sizeof end);
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, end[0], 0, end[2]);
    rig->element_length[0] = rig->element_length[nodes] = 0.5;
    rig_point(rig, x, 0, z);
    for (int k = 1; k < nodes; k++, angle -= d) {
        x += chord * cos(angle);
        z += chord * sin(angle);
        rig->element_length[k] = chord;
        rig_point(rig, x, 0, z);
    }
    rig_point(rig, x + 0.5 * cos(angle), 0, z + 0.5 * sin(angle));
    rig_graded(rig);
    const double *last = &rig->point[3 * (nodes + 1)];
    if (held)
        rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, last[0], 0, last[2]);
    else
        rig_end(rig, CPS_END_B, CPS_END_KIND_FREE, f * cos(angle), 0, f * sin(angle));
}

static void over_a_drum(void **state) {
    (void)state;
    static Rig rig;
    for (int k = 0; k < 6; k++) {
        const int nodes = 5 + 6 * k;
        const double d = 0.1 + 0.02 * k, mu = 0.2 + 0.1 * k, f = pow(10, k - 2);
        const double turn = mu * tan(d / 2), ratio = pow((1 + turn) / (1 - turn), nodes);
        drum(&rig, nodes, d, mu, false, f);
        rig_stage(&rig, 1);
        rig_stage(&rig, 3);
        RigRun run = rig_open(&rig);
        const CpsLineView first = rig_next(&run);
        const double found = first.tension[0];
        const CpsTensionRange range = run.report.end[CPS_END_A].range;
        printf("drum of %d nodes: %.9g in [%.9g, %.9g], expected [%.9g, %.9g]\n", nodes, found / f,
               range.least / f, range.greatest / f, 1 / ratio, ratio);
        /* the loop's gap of 1e-9 of the largest force, which is that of the end */
        CHECK_NEAR(range.least / f, 1 / ratio, 1e-8);
        CHECK_RELATIVE(range.greatest / f, ratio, 1e-8);
        const CpsLineView held = rig_next(&run);
        /* nothing moves, and it keeps what it has */
        CHECK_NEAR(held.tension[0], found, 1e-9 * f);
        if (nodes <= 23) compare("drum", &rig, &held, &run.report);
        rig_close(&run);
        drum(&rig, nodes, d, mu, true, f);
        CpsEvolution *evolution;
        assert_int_equal(cps_evolution_create(&rig.scene, &evolution, NULL), CPS_OK);
        assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
        const CpsLineReport report = cps_evolution_line_report(evolution, 0);
        for (int end = 0; end < 2; end++) {
            CHECK_NEAR(report.end[end].range.least, 0, 0);
            CHECK_INT(report.end[end].range.kind, CPS_RANGE_UNBOUNDED);
        }
        cps_evolution_destroy(evolution);
    }
}

/* in a groove ---------------------------------------------------------------------------------- */

static void in_a_groove(void **state) {
    (void)state;
    static Rig rig;
    const double alpha = PI / 5;
    for (int k = 0; k < 8; k++) {
        const double mu = 0.2 + 0.15 * k, n = 3; /* tan(alpha) = 0.727 */
        rig_begin(&rig, 3, 5, INFINITY);
        rig_length(&rig, n);
        for (int side = -1; side < 2; side += 2) {
            CpsObstacle *wall = rig_obstacle(&rig, CPS_OBSTACLE_PLANE, mu);
            wall->normal[0] = 0;
            wall->normal[1] = side * cos(alpha);
            wall->normal[2] = sin(alpha);
        }
        rig_point(&rig, 0, 0, 0);
        rig_point(&rig, n, 0, 0);
        rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 1, 0, 0);
        rig_stage(&rig, 1);
        rig_stage(&rig, 3);
        RigRun run = rig_open(&rig);
        const CpsLineView first = rig_next(&run);
        const double before = first.tension[0],
                     reaction[2] = {first.reaction[1], first.reaction[5]};
        const bool swapped = first.obstacle[1] == 1;
        CHECK_INT(run.report.end[CPS_END_A].range.kind,
                  tan(alpha) <= mu ? CPS_RANGE_UNBOUNDED : CPS_RANGE_BOUNDED);
        const CpsLineView view = rig_next(&run);
        compare("groove", &rig, &view, &run.report);
        /* held: tensions and reactions stay, to the root of the loop's gap */
        CHECK_NEAR(view.tension[0], before, 1e-6 * 5);
        CHECK_NEAR(view.reaction[swapped == (view.obstacle[1] == 1) ? 1 : 5], reaction[0],
                   1e-5 * 5);
        CHECK_NEAR(view.reaction[swapped == (view.obstacle[1] == 1) ? 5 : 1], reaction[1],
                   1e-5 * 5);
        rig_close(&run);
    }
}

/* at random ------------------------------------------------------------------------------------ */

static double uniform(uint64_t *seed, double low, double high) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*seed >> 11) * 0x1p-53;
}

/* A line that winds about on a tilted bed, or on a bed with a wall or a pipe, pulled a little and
 * let go; a held end is moved so that a part of it comes loose or slides. */
static void wind(Rig *rig, uint64_t *seed) {
    const int elements = 3 + (int)uniform(seed, 0, 14);
    const double lengths = pow(10, uniform(seed, -6, 6)), forces = pow(10, uniform(seed, -6, 6)),
                 h = lengths / elements;
    rig_begin(rig, elements, uniform(seed, 0.2, 2) * forces / lengths, INFINITY);
    if (uniform(seed, 0, 1) < 0.3) rig->scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    CpsObstacle *plane = rig_obstacle(rig, CPS_OBSTACLE_PLANE, uniform(seed, 0.1, 1));
    const double slope = uniform(seed, 0, 0.08);
    plane->normal[0] = -sin(slope);
    plane->normal[1] = 0;
    plane->normal[2] = cos(slope);
    double heading = uniform(seed, -PI, PI), x = 0, y = 0;
    for (int j = 0; j <= elements; j++) {
        rig_point(rig, x * cos(slope), y, x * sin(slope));
        x += h * cos(heading);
        y += h * sin(heading);
        heading += uniform(seed, -0.4, 0.4);
    }
    rig_length(rig, lengths);
    const bool both = uniform(seed, 0, 1) < 0.3;
    const int first = uniform(seed, 0, 1) < 0.5 ? CPS_END_A : CPS_END_B;
    const double *at[2] = {rig->point, &rig->point[3 * elements]};
    for (int end = 0; end < 2; end++)
        if (end == first || both)
            rig_end(rig, end, CPS_END_KIND_HELD, at[end][0], at[end][1], at[end][2]);
        else
            rig_end(rig, end, CPS_END_KIND_FREE, 0, 0, 0);
    rig_stage(rig, 1);
    for (int k = 0; k < 2; k++) {
        rig_stage(rig, 1 + (int)uniform(seed, 0, 3));
        const double size = both ? 0.1 * lengths : forces;
        double to[3];
        for (int a = 0; a < 3; a++) to[a] = uniform(seed, a < 2 ? -0.3 : 0, 0.3) * size;
        if (both)
            for (int a = 0; a < 2; a++)
                to[a] = at[1 - first][a] +
                        0.3 * (at[first][a] - at[1 - first][a]) * uniform(seed, 0, 1);
        if (both) to[2] = to[0] * tan(slope) + 1e-3 * lengths; /* a little above the bed */
        if (uniform(seed, 0, 1) < 0.7)
            rig_change(rig, 1 - first, both ? CPS_END_KIND_HELD : CPS_END_KIND_FREE, to[0], to[1],
                       to[2]);
    }
}

static void at_random(void **state) {
    (void)state;
    static Rig rig;
    int compared = 0, skipped = 0;
    for (uint64_t k = 0; k < 60; k++) {
        uint64_t seed = 977 * k + 5;
        wind(&rig, &seed);
        CpsEvolution *evolution;
        CpsError err = {0};
        if (cps_evolution_create(&rig.scene, &evolution, &err) != CPS_OK) {
            printf("seed %d: %s\n", (int)k, err.message);
            skipped++;
            continue;
        }
        for (int stage = 0;
             stage < rig.scene.stage_count && cps_evolution_remaining_count(evolution) > 0;
             stage++) {
            for (int step = 0;
                 step < rig.stage[stage].step_count && cps_evolution_remaining_count(evolution) > 0;
                 step++)
                cps_evolution_step(evolution, NULL);
            const CpsLineReport report = cps_evolution_line_report(evolution, 0);
            const CpsLineView view = cps_evolution_line_view(evolution, 0);
            char name[64];
            snprintf(name, sizeof name, "seed %d stage %d", (int)k, stage);
            const bool certified = cps_outcome_is_certified(report.outcome);
            const bool done = certified && compare(name, &rig, &view, &report);
            if (!certified) printf("%s: %s\n", name, cps_outcome_name(report.outcome));
            compared += done;
            skipped += !done;
        }
        cps_evolution_destroy(evolution);
    }
    printf("at random: %d ranges compared, %d not certified or lifted, largest difference %.2g of "
           "the force\n",
           compared, skipped, worst_difference);
    CHECK_GREATER(compared, 8 * skipped);
}

/* files ---------------------------------------------------------------------------------------- */

/* A file with ranges passes the checker; one with another least, greatest or bound does not. */
static void in_files(void **state) {
    (void)state;
    static Rig rig;
    rig_begin(&rig, 10, 9.81, INFINITY);
    rig_length(&rig, 2);
    rig_obstacle(&rig, CPS_OBSTACLE_PLANE, 0.5);
    rig_point(&rig, 0, 0, 0);
    rig_point(&rig, 2, 0, 0);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 4, 0, 0);
    rig_stage(&rig, 1);
    rig_stage(&rig, 2);
    CpsEvolution *evolution;
    CpsResults *results;
    CheckerReport report;
    char directory[] = "capstan-rest-XXXXXX", path[80], text[4096];
    assert_non_null(mkdtemp(directory));
    assert_int_equal(cps_evolution_create(&rig.scene, &evolution, NULL), CPS_OK);
    assert_int_equal(cps_results_open(directory, &rig.scene, evolution, NULL, &results, NULL),
                     CPS_OK);
    while (cps_evolution_remaining_count(evolution) > 0) {
        assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
        assert_int_equal(cps_results_append(results, evolution, NULL), CPS_OK);
    }
    assert_int_equal(cps_results_finish(results, 0, NULL), CPS_OK);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    snprintf(path, sizeof path, "%s/result.nc", directory);
    CHECK_INT(checker_file(path, &report, stderr), 0);
    /* at A: 0 to f + mu w (L - h/2) = 13.3195, in the first and the third step; NaN in the
     * second */
    static const struct {
        const char *variable, *finding;
        size_t index;
        double value, right;
    } TAMPER[] = {
        {"line_end_tension_greatest_bound", "and its bound differ", 0, 13.4, 13.3195},
        {"line_end_tension_least_bound", "and its bound differ", 4, 0.1, 0},
        {"line_end_tension_least", "is not whole", 2, 0, NAN},
    };
    for (size_t k = 0; k < sizeof TAMPER / sizeof *TAMPER; k++) {
        FILE *log = tmpfile();
        assert_non_null(log);
        CHECK_INT(sample_poke(path, TAMPER[k].variable, TAMPER[k].index, TAMPER[k].value), 0);
        CHECK_INT(checker_file(path, &report, log), 1);
        rewind(log);
        text[fread(text, 1, sizeof text - 1, log)] = 0;
        fclose(log);
        if (!strstr(text, TAMPER[k].finding))
            fail_msg("%s: expected \"%s\", got %s", TAMPER[k].variable, TAMPER[k].finding, text);
        CHECK_INT(sample_poke(path, TAMPER[k].variable, TAMPER[k].index, TAMPER[k].right), 0);
    }
    /* both numbers wrong together: only another program can tell */
    static const double WRONG[] = {13.32, INFINITY, 12};
    for (size_t k = 0; k < sizeof WRONG / sizeof *WRONG; k++) {
        CHECK_INT(checker_file(path, &report, stderr), 0);
        CHECK_INT(sample_poke(path, "line_end_tension_greatest", 0, WRONG[k]), 0);
        CHECK_INT(sample_poke(path, "line_end_tension_greatest_bound", 0, WRONG[k]), 0);
        CHECK_INT(checker_file(path, &report, NULL), 1);
        CHECK_INT(sample_poke(path, "line_end_tension_greatest", 0, 13.3195), 0);
        CHECK_INT(sample_poke(path, "line_end_tension_greatest_bound", 0, 13.3195), 0);
    }
    snprintf(path, sizeof path, "rm -rf '%s'", directory);
    CHECK_INT(system(path), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_force),   cmocka_unit_test(on_a_bed),
        cmocka_unit_test(as_stiff_ones),   cmocka_unit_test(moored_as_a_stiff_one),
        cmocka_unit_test(with_directions), cmocka_unit_test(without_choice),
        cmocka_unit_test(shallow),         cmocka_unit_test(over_a_drum),
        cmocka_unit_test(in_a_groove),     cmocka_unit_test(at_random),
        cmocka_unit_test(in_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
