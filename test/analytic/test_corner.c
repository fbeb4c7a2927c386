/* SPDX-License-Identifier: BSD-3-Clause */
/* A node on two obstacles at once.
 *
 * A block of weight W at the end of a string lies in a corner, where two planes (or a plane and a
 * pipe) meet along e. With normals n1, n2 across e and the load p besides the pull f along e, the
 * reactions are those of statics,
 *
 *     R1 n1 + R2 n2 = -(p - (p.e) e),
 *
 * and while it slides along e each plane has the friction mu_i R_i against e: with F = mu1 R1 + mu2
 * R2 the string carries T = f + p.e - F and is longer by T L/K. So it rests where the pull f + p.e
 * is less than F. Where it rests, reactions are not unique: friction across e may press the block
 * into the corner, and what it then bears along e grows in the first order while what it spends
 * grows in the second. Hence above F it may slide or rest, and it must slide above the limit G of
 * limit analysis with associated flow, where a motion e + lambda, lambda across e, parts from each
 * plane by mu_i of its slip:
 *
 *     G <= lambda.P for lambda.n_i = mu_i sqrt(1 + (lambda.t_i)^2), t_i = n_i x e, P the load
 *         across
 *     V-groove: G = F/sqrt(1 - mu^2 cot^2 alpha); none where tan(alpha) <= mu: there it may jam
 *
 * by weak duality: sum f_i is at most lambda.P for all f_i^2 + c_i^2 <= mu_i^2 R_i^2 with sum R_i
 * n_i + c_i t_i = P.
 *
 *     bed and wall         R1 = W, R2 = P, the force across; at 45 degrees f = P: F is reached at P
 *                          = mu1 W/(1 - mu2)
 *     V-groove             half angle alpha, force Q across: R = (W/sin(alpha) -+ Q/cos(alpha))/2
 *     inclined by theta    W cos(theta) for W, and W sin(theta) pulls: F is reached at tan(theta) =
 *                          mu/sin(alpha)
 *     bed and buried pipe  R2 = P/n2y, R1 = W - R2 n2z
 *
 * A string in a corner slides as on a bed with the friction q = mu1 w1 + mu2 w2 per length: its tip
 * moves by H^2/(2 q K). */
#include <stdio.h>
#include <string.h>

#include "rig.h"
#include "splitmix.h"

static const double PI = 3.14159265358979323846;
static const double LENGTH = 1, STIFFNESS = 50, WEIGHT = 2; /* W of the block is half of that */

/* The string lies along e from the origin, its end B free under the load p in all. */
static void block(Rig *rig, const double e[3]) {
    rig_begin(rig, 1, WEIGHT, STIFFNESS);
    rig_length(rig, LENGTH);
    rig_point(rig, 0, 0, 0);
    rig_point(rig, LENGTH * e[0], LENGTH * e[1], LENGTH * e[2]);
    rig_end(rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, 0);
}

static CpsObstacle *plane(Rig *rig, const double n[3], double mu) {
    CpsObstacle *out = rig_obstacle(rig, CPS_OBSTACLE_PLANE, mu);
    for (int a = 0; a < 3; a++) out->normal[a] = n[a];
    return out;
}

static double along(const double *v, const double e[3]) {
    return v[0] * e[0] + v[1] * e[1] + v[2] * e[2];
}

/* What a case says: normals at the block, the load P that they balance across e, and what they then
 * carry each. */
typedef struct Corner {
    const char *name;
    double e[3], normal[2][3], mu[2], load[3], reaction[2];
} Corner;

/* The reactions of R1 n1 + R2 n2 = P, from the components of P along both normals. */
static void balance(Corner *corner) {
    const double *n = corner->normal[0], *m = corner->normal[1], c = along(n, m);
    const double a = along(n, corner->load), b = along(m, corner->load);
    corner->reaction[0] = (a - c * b) / (1 - c * c);
    corner->reaction[1] = (b - c * a) / (1 - c * c);
}

static double limit_of(const Corner *corner) {
    return corner->mu[0] * corner->reaction[0] + corner->mu[1] * corner->reaction[1];
}

/* The bound of G, lambda by iteration from 0, which grows to it; INFINITY where there is none: it
 * may jam, or lean on one plane alone. */
static double sure_limit(const Corner *corner) {
    const double *n = corner->normal[0], *m = corner->normal[1], c = along(n, m);
    double lambda[3] = {0}, t[2][3], value = 0;
    for (int k = 0; k < 2; k++)
        for (int a = 0; a < 3; a++)
            t[k][a] = corner->normal[k][(a + 1) % 3] * corner->e[(a + 2) % 3] -
                      corner->normal[k][(a + 2) % 3] * corner->e[(a + 1) % 3];
    for (int i = 0; i < 10000; i++) {
        const double a = corner->mu[0] * hypot(1, along(lambda, t[0])),
                     b = corner->mu[1] * hypot(1, along(lambda, t[1]));
        for (int x = 0; x < 3; x++)
            lambda[x] = ((a - c * b) * n[x] + (b - c * a) * m[x]) / (1 - c * c);
        value = along(lambda, corner->load);
        if (value > 1e3 * limit_of(corner)) return INFINITY;
    }
    return value;
}

/* What must come of it. */
typedef enum Must { MUST_REST, MAY_REST, MUST_SLIDE } Must;

static void check_slide(const Corner *corner, const CpsLineView *view, double pull,
                        const double moved[3], double load) {
    const double tension = pull - limit_of(corner);
    /* the loop ends at a gap of 1e-13 of its scale, which leaves 3e-7 of forces if they are
     * degenerate; a block that slides is not, and keeps 1e-8 of them with room */
    CHECK_NEAR(rig_show(corner->name, "path along the corner [m]", tension * LENGTH / STIFFNESS,
                        along(moved, corner->e)),
               0, 1e-8 * load * LENGTH / STIFFNESS);
    CHECK_NEAR(along(&view->segment_force[0], corner->e), tension, 1e-8 * load);
    for (int k = 0; k < 2; k++) { /* obstacle k, whichever contact it is */
        const int c = view->obstacle[1] == k ? 1 : 3;
        CHECK_INT(view->obstacle[c], k);
        CHECK_NEAR(rig_show(corner->name, k ? "second reaction [N]" : "first reaction [N]",
                            corner->reaction[k], view->reaction[c]),
                   0, 1e-8 * load);
        CHECK_NEAR(along(&view->friction_force[3 * c], corner->e),
                   -corner->mu[k] * corner->reaction[k], 1e-8 * load);
        if (corner->mu[k] > 0) CHECK_INT(view->state[c], CPS_NODE_STATE_SLIP);
    }
}

/* One load step to the end force `force`, which pulls along e by `pull` together with what the
 * weight does. Returns whether the block slides. */
static bool expect(const Corner *corner, Rig *rig, const double force[3], double pull, Must must) {
    rig_stage(rig, 1);
    rig_change(rig, CPS_END_B, CPS_END_KIND_FREE, force[0], force[1], force[2]);
    RigRun run = rig_open(rig);
    const CpsLineView view = rig_step(&run);
    CHECK_INT(view.contact_count, 2);
    const double *e = corner->e, load = pull + corner->reaction[0] + corner->reaction[1];
    double moved[3], friction = 0;
    for (int a = 0; a < 3; a++) moved[a] = view.position[3 + a] - LENGTH * e[a];
    for (int c = 1; c < 4; c += 2) friction += along(&view.friction_force[3 * c], e);
    const bool slides = must == MUST_SLIDE || (must == MAY_REST && along(moved, e) > 1e-8 * LENGTH);
    if (slides)
        check_slide(corner, &view, pull, moved, load);
    else { /* rests to what the certificate says of tensions, which are those of an element not
              elongated */
        const double off = run.report.certificate.tension_bound + 1e-12 * load;
        CHECK_NEAR(along(&view.segment_force[0], e), 0, off);
        CHECK_NEAR(friction, -pull, off);
        CHECK_NEAR(rig_show(corner->name, "rests: path [m]", 0, along(moved, e)), 0,
                   off * LENGTH / STIFFNESS + 1e-12 * LENGTH);
    }
    rig_close(&run);
    return slides;
}

/* Below F, above F and, where there is one, above G. */
static double side(const Corner *corner, int k, Must *must) {
    const double limit = limit_of(corner), sure = sure_limit(corner);
    *must = (Must)k;
    if (k == 2) rig_show(corner->name, "limits F and G [N]", limit, sure);
    return k == 0 ? 0.999 * limit : k == 1 ? 1.001 * limit : 1.001 * sure;
}

static void bed_and_wall(void **state) {
    (void)state;
    static const double MU[][2] = {{0.4, 0.3}, {0.1, 0.8}, {0.6, 0}, {0, 0.25}};
    const double weight = WEIGHT * LENGTH / 2;
    int slid = 0;
    for (size_t i = 0; i < sizeof MU / sizeof *MU; i++)
        for (int k = 0; k < 3; k++) {
            Rig rig;
            Corner corner = {"bed and wall",       {1, 0, 0}, {{0, 0, 1}, {0, -1, 0}},
                             {MU[i][0], MU[i][1]}, {0},       {0}};
            /* at 45 degrees: the limit F is at press = F, and above it by a thousandth of press F
             * grows by less */
            const double limit = MU[i][0] * weight / (1 - MU[i][1]);
            double press = limit > 0 ? (k ? 1.001 : 0.999) * limit : 0.999, pull = press;
            corner.load[1] = -press;
            corner.load[2] = weight;
            balance(&corner);
            Must must = k ? MAY_REST : MUST_REST;
            if (k == 2) pull = side(&corner, 2, &must); /* not at 45 degrees any more */
            if (limit == 0) must = MUST_SLIDE;          /* one plane without friction: F = G */
            block(&rig, corner.e);
            for (int n = 0; n < 2; n++) plane(&rig, corner.normal[n], corner.mu[n]);
            slid += expect(&corner, &rig, (double[]){pull, press, 0}, pull, must);
        }
    printf("%d slid\n", slid);
}

/* A groove along e, `tilt` down from the horizontal, its planes alpha from the plane upright over
 * e; yawed, so that no axis is special. `across` pulls sideways. */
static Corner groove(double alpha, double tilt, double across, const double mu[2]) {
    const double yaw = 0.7, up[3] = {sin(tilt) * cos(yaw), sin(tilt) * sin(yaw), cos(tilt)};
    const double level[3] = {-sin(yaw), cos(yaw), 0};
    Corner out = {.name = tilt > 0 ? "inclined V-groove" : "V-groove",
                  .e = {cos(tilt) * cos(yaw), cos(tilt) * sin(yaw), -sin(tilt)},
                  .mu = {mu[0], mu[1]}};
    for (int a = 0; a < 3; a++) {
        for (int k = 0; k < 2; k++)
            out.normal[k][a] = sin(alpha) * up[a] + (k ? -1 : 1) * cos(alpha) * level[a];
        out.load[a] = WEIGHT * LENGTH / 2 * cos(tilt) * up[a] - across * level[a];
    }
    balance(&out);
    return out;
}

static void v_groove(void **state) {
    (void)state;
    static const double ALPHA[] = {15, 30, 45, 60, 85}, ACROSS[] = {0, 0.6},
                        MU[][2] = {{0.3, 0.3}, {0.5, 0.1}};
    const double weight = WEIGHT * LENGTH / 2;
    int slid = 0;
    for (size_t i = 0; i < sizeof ALPHA / sizeof *ALPHA; i++)
        for (int q = 0; q < 2; q++)
            for (int m = 0; m < 2; m++)
                for (int k = 0; k < 3; k++) {
                    Rig rig;
                    /* across by a share of what would lift it off one plane */
                    const double alpha = ALPHA[i] * PI / 180, by = ACROSS[q] * weight / tan(alpha),
                                 *mu = MU[m];
                    const Corner corner = groove(alpha, 0, by, mu);
                    CHECK_RELATIVE(corner.reaction[0], (weight / sin(alpha) - by / cos(alpha)) / 2,
                                   1e-12);
                    CHECK_RELATIVE(corner.reaction[1], (weight / sin(alpha) + by / cos(alpha)) / 2,
                                   1e-12);
                    Must must;
                    const double pull = side(&corner, k, &must), jam = mu[0] / tan(alpha);
                    if (q == 0 && m == 0 && jam < 1)
                        CHECK_RELATIVE(sure_limit(&corner), limit_of(&corner) / sqrt(1 - jam * jam),
                                       1e-12);
                    if (isinf(pull)) continue;
                    double force[3];
                    for (int a = 0; a < 3; a++)
                        force[a] = pull * corner.e[a] - corner.load[a] + (a == 2 ? weight : 0);
                    block(&rig, corner.e);
                    for (int n = 0; n < 2; n++) plane(&rig, corner.normal[n], mu[n]);
                    slid += expect(&corner, &rig, force, pull, must);
                }
    printf("%d slid\n", slid);
}

/* Its weight alone draws it down: rests below tan(tilt) = mu/sin(alpha), slides above that over
 * sqrt(1 - mu^2 cot^2 alpha). */
static void inclined_groove(void **state) {
    (void)state;
    static const double ALPHA[] = {20, 45, 70}, MU[2] = {0.2, 0.2};
    for (size_t i = 0; i < sizeof ALPHA / sizeof *ALPHA; i++)
        for (int k = 0; k < 3; k++) {
            Rig rig;
            const double alpha = ALPHA[i] * PI / 180, jam = MU[0] / tan(alpha);
            const double steep = MU[0] / sin(alpha) *
                                 (k == 0   ? 0.999
                                  : k == 1 ? 1.001
                                           : 1.001 / sqrt(1 - jam * jam));
            const Corner corner = groove(alpha, atan(steep), 0, MU);
            block(&rig, corner.e);
            for (int n = 0; n < 2; n++) plane(&rig, corner.normal[n], MU[n]);
            expect(&corner, &rig, (double[]){0, 0, 0}, WEIGHT * LENGTH / 2 * sin(atan(steep)),
                   (Must)k);
        }
}

/* The pipe lies along x with its axis `height` above the bed, less than its radius. */
static void bed_and_pipe(void **state) {
    (void)state;
    static const double HEIGHT[] = {-0.2, 0, 0.15}, MU[2] = {0.4, 0.25};
    const double weight = WEIGHT * LENGTH / 2, radius = 0.3, press = 0.7;
    for (size_t i = 0; i < sizeof HEIGHT / sizeof *HEIGHT; i++)
        for (int k = 0; k < 3; k++) {
            Rig rig;
            const double height = HEIGHT[i], half = sqrt(radius * radius - height * height);
            Corner corner = {"bed and pipe",
                             {1, 0, 0},
                             {{0, 0, 1}, {0, half / radius, -height / radius}},
                             {MU[0], MU[1]},
                             {0, press, weight},
                             {0}};
            balance(&corner);
            CHECK_RELATIVE(corner.reaction[1], press * radius / half, 1e-12);
            block(&rig, corner.e);
            plane(&rig, corner.normal[0], MU[0]);
            CpsObstacle *pipe = rig_obstacle(&rig, CPS_OBSTACLE_CYLINDER, MU[1]);
            pipe->radius = radius;
            pipe->axis[0] = 1;
            pipe->axis[1] = 0;
            pipe->point[1] = -half;
            pipe->point[2] = height;
            Must must;
            const double pull = side(&corner, k, &must);
            if (!isinf(pull)) expect(&corner, &rig, (double[]){pull, -press, 0}, pull, must);
        }
}

/* Gravity leans by as much as the bed takes w1 and the wall w2 of the weight. */
static void string_in_a_corner(void **state) {
    (void)state;
    static const double UP[3] = {0, 0, 1}, ASIDE[3] = {0, -1, 0}, MU[2] = {0.5, 0.2};
    const double length = 10, weight = 4, stiffness = 500, lean = 0.5, pull = 8;
    const double w[2] = {weight * cos(lean), weight * sin(lean)}, q = MU[0] * w[0] + MU[1] * w[1];
    for (int n = 50; n <= 200; n *= 2) {
        Rig rig;
        rig_begin(&rig, n, weight, stiffness);
        rig_length(&rig, length);
        rig.scene.gravity[1] = 9.81 * sin(lean);
        rig.scene.gravity[2] = -9.81 * cos(lean);
        rig_point(&rig, 0, 0, 0);
        rig_point(&rig, length, 0, 0);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, 0);
        plane(&rig, UP, MU[0]);
        plane(&rig, ASIDE, MU[1]);
        rig_stage(&rig, 4);
        rig_change(&rig, CPS_END_B, CPS_END_KIND_FREE, pull, 0, 0);
        RigRun run = rig_open(&rig);
        const CpsLineView view = rig_next(&run);
        const double h = length / n, motion = pull * pull / (2 * q * stiffness);
        /* forces are exact at the middles of elements; the one in which sliding ends moves the tip
         * by q h^2/(8 K) at most, and the certified gap leaves what rig.h calls motion */
        const double error = rig_show("string in a corner", "path of the tip [m]", motion,
                                      view.position[3 * n] - length);
        CHECK_LESS(fabs(error), q * h * h / (8 * stiffness) + run.motion);
        for (int j = 1; j < n; j++)
            if (view.state[j] == CPS_NODE_STATE_SLIP)
                for (int c = j; c < 2 * (n + 1); c += n + 1)
                    CHECK_NEAR(view.reaction[c], w[view.obstacle[c]] * h,
                               1e-8 * pull); /* as above */
        rig_close(&run);
    }
}

/* ---- one set, two ways ---- */

/* All steps of a scene, each certified. */
static CpsEvolution *solved(const Rig *rig) {
    CpsError err = {0};
    CpsEvolution *out = NULL;
    CHECK_INT(cps_evolution_create(&rig->scene, &out, &err), CPS_OK);
    while (cps_evolution_remaining_count(out) > 0) {
        CHECK_INT(cps_evolution_step(out, &err), CPS_OK);
        CHECK_INT(cps_evolution_report(out).outcome, CPS_OUTCOME_SOLVED);
    }
    return out;
}

/* A line on a bed that is swept against a wall, or against a half-buried pipe, along which it is
 * drawn on. */
static void sweep(Rig *rig, bool pipe, int elements) {
    static const double UP[3] = {0, 0, 1}, ASIDE[3] = {0, -1, 0};
    rig_begin(rig, elements, 20, 1e4);
    rig_length(rig, 10);
    rig->scene.gravity[1] = 4; /* the line leans on what it meets, with all its nodes */
    rig_point(rig, 0, 0, 0);
    rig_point(rig, 10, 0, 0);
    rig_end(rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, 0);
    plane(rig, UP, 0.4)->grain[0] = 1;
    if (pipe) {
        CpsObstacle *round = rig_obstacle(rig, CPS_OBSTACLE_CYLINDER, 0.3);
        round->radius = 0.4;
        round->axis[0] = 1;
        round->axis[1] = 0;
        round->point[1] = 0.55;
    } else {
        plane(rig, ASIDE, 0.3)->point[1] = 0.3;
    }
    rig->obstacle[1].grain[0] = 1;
    rig->obstacle[1].grain[1] = 0.5;
    rig_stage(rig, 4);
    rig_change(rig, CPS_END_B, CPS_END_KIND_FREE, 60, 60, 0);
    rig_stage(rig, 4);
    rig_change(rig, CPS_END_B, CPS_END_KIND_FREE, 200, 60, 0);
}

static void the_same_set_given_twice(void **state) {
    (void)state;
    CpsError err = {0};
    const double mu[2][2] = {{0.4, 0.25}, {0.3, 0.15}};
    CpsSet *set[2];
    for (int k = 0; k < 2; k++) {
        const double shape[] = {mu[k][0] * mu[k][0], 0, 0, mu[k][1] * mu[k][1]};
        CHECK_INT(cps_set_ellipsoid(2, NULL, shape, &set[k], &err), CPS_OK);
    }
    for (int pipe = 0; pipe < 2; pipe++)
        for (int which = 1; which <= 3; which++) { /* bits: the bed's, the wall's */
            Rig rig[2];
            CpsEvolution *evolution[2];
            CpsLineView view[2];
            for (int i = 0; i < 2; i++) {
                sweep(&rig[i], pipe, 20);
                for (int k = 0; k < 2; k++) {
                    CpsObstacle *o = &rig[i].obstacle[k];
                    o->has_friction_lateral = true;
                    o->friction_lateral = mu[k][1];
                    if (i && which & 1 << k) o->friction_set = set[k];
                }
                evolution[i] = solved(&rig[i]);
                view[i] = cps_evolution_line_view(evolution[i], 0);
            }
            double place = 0, force = 0, pressed = 0, friction_error = 0;
            const int n = view[0].element_count + 1;
            for (int i = 0; i < 3 * n; i++)
                place = fmax(place, fabs(view[0].position[i] - view[1].position[i]));
            for (int c = 0; c < 2 * n;
                 c++) { /* which of two is the nearer is rounding where both touch */
                const int j = c % n, d = view[1].obstacle[j] == view[0].obstacle[c] ? j : j + n;
                CHECK_INT(view[0].obstacle[c], view[1].obstacle[d]);
                force = fmax(force, fabs(view[0].reaction[c] - view[1].reaction[d]));
                for (int a = 0; a < 3; a++)
                    friction_error = fmax(friction_error, fabs(view[0].friction_force[3 * c + a] -
                                                               view[1].friction_force[3 * d + a]));
                if (c >= n) pressed += fmin(view[0].reaction[c], view[0].reaction[j]);
            }
            const char *name = pipe ? "swept against a pipe" : "swept against a wall";
            rig_show(name, "places [m]", 0, place);
            rig_show(name, "reactions [N]", 0, force);
            rig_show(name, "frictions [N]", 0, friction_error);
            rig_show(name, "smaller of two reactions, sum [N]", 0, pressed);
            CHECK_GREATER(pressed, 1);
            /* the loops end at a relative gap of 1e-13; its root 3e-7 bounds what forces keep that
             * is not strictly complementary (test_friction_sets.c), of the pull of 200 N; places
             * keep the elongation that goes with it, 200/1e4 of that and 10 m */
            CHECK_LESS(place, 1e-8 * 10);
            CHECK_LESS(force, 3e-7 * 200);
            CHECK_LESS(friction_error, 3e-7 * 200);
            for (int i = 0; i < 2; i++) cps_evolution_destroy(evolution[i]);
        }
    cps_set_release(set[0]);
    cps_set_release(set[1]);
}

/* Three planes meet in an apex and open upwards; where they have no friction, a block in it is
 * borne by all three, R1 n1 + R2 n2 + R3 n3 = -load, whatever the reactions. The slack string has
 * no tension. */
static void pit_of_three_planes(void **state) {
    (void)state;
    static const double APEX[3] = {0.3, -0.2, 0.1};
    uint64_t random = 11;
    double worst = 0, deepest = 0;
    int rough = 0;
    for (int i = 0; i < 40; i++) {
        Rig rig;
        double n[3][3], reaction[3], load[3] = {0, 0, 0.5 * WEIGHT * LENGTH};
        const double mu = i < 20 ? 0 : splitmix(&random, 0.05, 0.4);
        rig_begin(&rig, 1 + i % 2, WEIGHT, STIFFNESS);
        rig_length(&rig, LENGTH);
        for (int k = 0; k < 3; k++) {
            const double around = 2 * PI / 3 * k + splitmix(&random, -0.4, 0.4),
                         up = splitmix(&random, 0.3, 0.8), across = sqrt(1 - up * up);
            n[k][0] = across * cos(around);
            n[k][1] = across * sin(around);
            n[k][2] = up;
            reaction[k] = splitmix(&random, 1, 5);
            memcpy(plane(&rig, n[k], mu)->point, APEX, sizeof APEX);
            for (int a = 0; a < 3; a++) load[a] -= reaction[k] * n[k][a];
        }
        /* half the weight of the last element is at its end; the other nodes lie in the pit too */
        if (i % 2) load[2] -= 0.25 * WEIGHT * LENGTH;
        rig_point(&rig, APEX[0], APEX[1], APEX[2] + 0.5);
        rig_point(&rig, APEX[0] + 0.1, APEX[1] + 0.05, APEX[2] + 0.5 + sqrt(1 - 0.0125));
        rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, 1.2 * WEIGHT);
        rig_stage(&rig, 1);
        rig_change(&rig, CPS_END_B, CPS_END_KIND_FREE, load[0], load[1], load[2]);
        RigRun run = rig_open(&rig);
        CHECK_INT(rig_try(&run), CPS_OUTCOME_SOLVED); /* and the audit */
        const CpsLineView v = run.view;
        const int j = v.element_count, c[3] = {j, j + v.element_count + 1, j - 1};
        rough += mu > 0 && v.element_obstacle[j - 1] >= 0 && v.element_reaction[j - 1] > 0;
        const int count = mu == 0 ? 3 : 0; /* reactions that are unique */
        for (int a = 0; a < count; a++) {
            const int on = a < 2 ? v.obstacle[c[a]] : v.element_obstacle[c[a]];
            const double found = a < 2 ? v.reaction[c[a]] : v.element_reaction[c[a]];
            CHECK_INT(on >= 0 && on < 3, 1);
            worst = fmax(worst, fabs(found - reaction[on]));
            deepest = fmax(deepest, fabs(v.position[3 * j + a] - APEX[a]));
        }
        rig_close(&run);
    }
    rig_show("pit of three planes", "reactions, worst of 20 [N]", 0, worst);
    rig_show("pit of three planes", "of 20 with friction, borne by all three", 20, rough);
    rig_show("pit of three planes", "block off the apex, worst of 20 [m]", 0, deepest);
    /* the loop ends at 1e-13 of its scale, and the reactions are not degenerate */
    CHECK_LESS(worst, 1e-8 * 15);
    CHECK_LESS(deepest, 1e-8 * LENGTH);
    CHECK_GREATER(rough, 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bed_and_wall),
        cmocka_unit_test(v_groove),
        cmocka_unit_test(inclined_groove),
        cmocka_unit_test(bed_and_pipe),
        cmocka_unit_test(pit_of_three_planes),
        cmocka_unit_test(string_in_a_corner),
        cmocka_unit_test(the_same_set_given_twice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
