/* SPDX-License-Identifier: BSD-3-Clause */
/* Members of bodies by the C interface: bad values, and the added mass of what is wet as a scene
 * begins. */
#include <math.h>
#include <string.h>

#include "check.h"

#include "capstan/evolve.h"

/* A body with two members on a line, in water. */
typedef struct Parts {
    CpsMember member[2];
    CpsBody body;
    CpsPoint point;
    CpsCurrentRow row;
    CpsCurrent current;
    double from[6];
    CpsLine line;
    CpsStage stage;
    CpsScene scene;
} Parts;

static void make(Parts *p) {
    *p = (Parts){.from = {9, 0, 0, 0, 0, 0}};
    for (int i = 0; i < 2; i++)
        p->member[i] = (CpsMember){.from = {0, 0, -2}, .to = {0, 0, 3}, .diameter = 1, .normal = 1};
    p->body = cps_body_default();
    p->body.name = "hull";
    p->body.kind = CPS_BODY_KIND_FREE;
    p->body.mass = 10;
    p->body.weight = 98.1;
    for (int i = 0; i < 3; i++) p->body.inertia[i] = 5;
    p->body.member_count = 2;
    p->body.member = p->member;
    p->point = cps_point_default();
    p->point.name = "eye";
    p->point.kind = CPS_POINT_KIND_ON_BODY;
    p->row = (CpsCurrentRow){.z = 0};
    p->current = (CpsCurrent){.density = 1000, .row_count = 1, .row = &p->row};
    p->line = cps_line_default();
    p->line.name = "leash";
    p->line.length = 9;
    p->line.element_count = 4;
    p->line.weight = 5;
    p->line.inertia = 0.5;
    p->line.stiffness = 1e6;
    p->line.start = (CpsStart){.kind = CPS_START_STRAIGHT, .point_count = 2, .point = p->from};
    p->line.end[CPS_END_B].kind = CPS_END_KIND_POINT;
    p->stage = cps_stage_default();
    p->stage.name = "swing";
    p->stage.duration = 0.2;
    p->stage.step_count = 2;
    p->scene = cps_scene_default();
    p->scene.line_count = p->scene.point_count = p->scene.body_count = p->scene.stage_count = 1;
    p->scene.line = &p->line;
    p->scene.point = &p->point;
    p->scene.body = &p->body;
    p->scene.stage = &p->stage;
    p->scene.current = &p->current;
    p->scene.has_water_surface = true;
    p->scene.water_surface = 0;
}

static void refused(const Parts *p, CpsStatus wanted, const char *message) {
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    CHECK_INT(cps_evolution_create(&p->scene, &evolution, &err), wanted);
    assert_null(evolution);
    assert_non_null(strstr(err.message, message));
}

static void test_bad_values(void **state) {
    (void)state;
    Parts p;
    CpsError err = {0};
    make(&p);
    assert_int_equal(cps_scene_check(&p.scene, &err), CPS_OK);
    static const double BAD[] = {NAN, INFINITY, -1, -INFINITY};
    for (int i = 0; i < 4; i++)
        for (int what = 0; what < 6; what++) {
            make(&p);
            CpsMember *member = &p.member[1];
            double *value[] = {&member->diameter,     &member->normal,  &member->tangential,
                               &member->added_normal, &member->from[2], &member->to[0]};
            if (what > 3 && BAD[i] == -1) continue; /* a place as any other */
            *value[what] = BAD[i];
            refused(&p, CPS_ERR_ARGUMENT,
                    what > 3 ? "body 'hull': members: number 2 goes from"
                             : "body 'hull': members: number 2 has the diameter");
        }
    make(&p);
    memcpy(p.member[0].to, p.member[0].from, sizeof p.member[0].to);
    refused(&p, CPS_ERR_ARGUMENT,
            "members: number 1 goes from (0, 0, -2) m to (0, 0, -2) m, expected two places apart");
    make(&p);
    p.member[0].diameter = 0;
    refused(&p, CPS_ERR_ARGUMENT, "members: number 1 has the diameter 0 m");
    make(&p);
    p.member[0].strip_count = CPS_MAX_STRIPS + 1;
    refused(&p, CPS_ERR_LIMIT, "members: number 1 has 1001 strips, expected 1 to 1000");
    p.member[0].strip_count = -1;
    refused(&p, CPS_ERR_LIMIT, "members: number 1 has -1 strips");
    make(&p);
    p.body.member_count = -1;
    refused(&p, CPS_ERR_ARGUMENT, "body 'hull': members: found -1, expected 0 or more");
    p.body.member_count = CPS_MAX_MEMBERS + 1;
    refused(&p, CPS_ERR_LIMIT, "body 'hull': members: found 201, the limit is 200");
    make(&p);
    p.body.member = NULL;
    refused(&p, CPS_ERR_ARGUMENT, "body 'hull': members: found 2, expected 0 or more");
    make(&p);
    p.scene.current = NULL;
    refused(&p, CPS_ERR_ARGUMENT,
            "body 'hull': members: a step of the history has a duration, and there is no water "
            "that they could move in: give water_density");
}

/* Without time and water they do nothing, as the drag of lines. */
static void test_without_water(void **state) {
    (void)state;
    Parts p;
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    make(&p);
    p.scene.current = NULL;
    p.stage.duration = 0;
    p.body.kind = CPS_BODY_KIND_HELD;
    assert_int_equal(cps_evolution_create(&p.scene, &evolution, &err), CPS_OK);
    assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
    CHECK_NEAR(cps_evolution_body_report(evolution, 0).load[0], 0, 0);
    cps_evolution_destroy(evolution);
}

/* Of an upright cylinder of which 2 m are wet, m = rho pi d^2/4 a per metre: sums of m, m z and
 * m z^2 from -2 to 0; beside what is given; turned on its side nothing, or all of it, is wet. */
static void test_added_mass(void **state) {
    (void)state;
    Parts p;
    double added[36];
    make(&p);
    p.body.member_count = 1;
    p.member[0].added_normal = 0.8;
    p.body.added_mass[14] = 7;
    const double m = 1000 * acos(-1) / 4 * 0.8;
    cps_body_added_mass(&p.scene, 0, added);
    for (int i = 0; i < 36; i++) {
        const double wanted = i == 0 || i == 7     ? 2 * m
                              : i == 14            ? 7
                              : i == 4 || i == 24  ? -2 * m
                              : i == 9 || i == 19  ? 2 * m
                              : i == 21 || i == 28 ? 8 * m / 3
                                                   : 0;
        CHECK_NEAR(added[i], wanted, 1e-12 * m);
    }
    p.scene.water_surface = -2.5;
    cps_body_added_mass(&p.scene, 0, added);
    CHECK_NEAR(added[0], 0, 0);
    p.scene.has_water_surface = false;
    cps_body_added_mass(&p.scene, 0, added);
    CHECK_NEAR(added[0], 5 * m, 1e-12 * m);
    cps_body_added_mass(&p.scene, 1, added);
    CHECK_NEAR(added[0], 0, 0);
    cps_body_added_mass(NULL, 0, added);
    cps_body_added_mass(&p.scene, 0, NULL);
    CHECK_NEAR(added[0], 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bad_values),
        cmocka_unit_test(test_without_water),
        cmocka_unit_test(test_added_mass),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
