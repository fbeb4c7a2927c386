/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines with a static and a dynamic stiffness (docs/theory.md 1): the static one is followed
 * slowly, the dynamic one holds about the state reached so.
 *
 * A line without weight between two held ends has one tension T. With f_s and f_d the strains of a
 * section at T by its two stiffnesses, its distance is
 *
 *     D = sum l (1 + f_s(T))                 by the static one
 *     D = sum l (1 + r + f_d(T)),            r = f_s(T_0) - f_d(T_0), T_0 the tension before
 *
 * solved for T by bisection. A hanging line has H and V - w s along it; by the dynamic stiffness
 * each piece has the rest strain of its own tension T_0(s) before:
 *
 *     x = int H/T (1 + r + T/K_d) ds,    z = int (V - w s)/T (1 + r + T/K_d) ds,    r = T_0 (1/K_s
 * - 1/K_d) */
#include <stdlib.h>
#include <string.h>

#include "capstan/two_stiffnesses.h"
#include "cases.h"
#include "splitmix.h"

enum { SECTIONS = 3, ROWS = 4, STAGES = 8 };

/* One stiffness: a table, the last slope going on. */
typedef struct Table {
    int rows;
    CpsStiffnessRow row[ROWS];
} Table;

static double strain_of(const Table *t, double tension) {
    int i = 1;
    while (i + 1 < t->rows && tension > t->row[i].tension) i++;
    const CpsStiffnessRow *a = &t->row[i - 1], *b = &t->row[i];
    return a->strain + (tension - a->tension) * (b->strain - a->strain) / (b->tension - a->tension);
}

static double tension_by(const Table *t, double strain) {
    double low = 0, high = 1;
    while (strain_of(t, high) < strain) high *= 2;
    for (int i = 0; i < 200; i++) {
        const double middle = 0.5 * (low + high);
        if (strain_of(t, middle) < strain)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* A rope of up to three sections, some of one stiffness only. */
typedef struct Rope {
    int sections;
    double length[SECTIONS];
    bool has_dynamic[SECTIONS];
    Table slow[SECTIONS], fast[SECTIONS];
} Rope;

static uint64_t random_state;
static double between(double low, double high) { return splitmix(&random_state, low, high); }

/* Rising slopes: of a table with one piece, a stiffness. */
static Table table(double stiffness) {
    Table t = {2 + (int)between(0, ROWS - 1), {{0, 0}}};
    for (int i = 1; i < t.rows; i++) {
        const double by = between(0.002, 0.02);
        t.row[i].strain = t.row[i - 1].strain + by;
        t.row[i].tension = t.row[i - 1].tension + by * stiffness;
        stiffness *= between(1.05, 3);
    }
    return t;
}

/* The same tensions at strains that are shares of the others', which fall from row to row. */
static Table stiffer(const Table *slow) {
    Table t = *slow;
    double share = between(0.2, 1), fall = between(0.3, 1);
    for (int i = 1; i < t.rows; i++) {
        t.row[i].strain =
            t.row[i - 1].strain + share * (slow->row[i].strain - slow->row[i - 1].strain);
        share *= fall;
    }
    return t;
}

static double distance_at(const Rope *rope, const double *rest, bool is_dynamic, double tension) {
    double sum = 0;
    for (int k = 0; k < rope->sections; k++)
        sum += rope->length[k] *
               (1 + rest[k] + strain_of(is_dynamic ? &rope->fast[k] : &rope->slow[k], tension));
    return sum;
}

/* 0 where the line is longer than the distance. */
static double tension_at(const Rope *rope, const double *rest, bool is_dynamic, double distance) {
    double low = 0, high = 1;
    if (distance_at(rope, rest, is_dynamic, 0) >= distance) return 0;
    while (distance_at(rope, rest, is_dynamic, high) < distance) high *= 2;
    for (int i = 0; i < 200; i++) {
        const double middle = 0.5 * (low + high);
        if (distance_at(rope, rest, is_dynamic, middle) < distance)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* The rest strains about the tension `before`; at first the strain is even, and the tensions are
 * not: the whole line is `begin` long. */
static void find_rest(const Rope *rope, double begin, double before, double *rest) {
    double length = 0;
    for (int k = 0; k < rope->sections; k++) length += rope->length[k];
    for (int k = 0; k < rope->sections; k++) {
        const double own = begin > 0 ? tension_by(&rope->slow[k], begin / length - 1) : before;
        rest[k] = strain_of(&rope->slow[k], own) - strain_of(&rope->fast[k], own);
    }
}

/* Fill a case with the rope; its elements are 4 to 8 a section. */
static void use_rope(Case *c, const Rope *rope, CpsSection *section, double *element) {
    double length = 0;
    int elements = 0;
    for (int k = 0; k < rope->sections; k++) {
        const int count = (int)between(4, 9);
        for (int e = 0; e < count; e++) element[elements++] = rope->length[k] / count;
        length += rope->length[k];
        section[k] = (CpsSection){.length = rope->length[k],
                                  .stiffness_row_count = rope->slow[k].rows,
                                  .stiffness_row = rope->slow[k].row,
                                  .has_dynamic_stiffness = rope->has_dynamic[k]};
        if (rope->has_dynamic[k])
            section[k].dynamic_stiffness =
                (CpsDynamicStiffness){.row_count = rope->fast[k].rows, .row = rope->fast[k].row};
        if (rope->slow[k].rows == 2 && k % 2 == 0) {
            const CpsStiffnessRow *s = &rope->slow[k].row[1], *f = &rope->fast[k].row[1];
            section[k].stiffness_row_count = 0;
            section[k].stiffness = s->tension / s->strain;
            if (rope->has_dynamic[k])
                section[k].dynamic_stiffness =
                    (CpsDynamicStiffness){.stiffness = f->tension / f->strain};
        }
    }
    case_begin(c, length, elements, 0, 1);
    c->line.element_length = element;
    c->line.section_count = rope->sections;
    c->line.section = section;
}

static void random_rope(Rope *rope) {
    const double stiffness = exp(between(8, 20)), size = exp(between(-1, 6));
    rope->sections = 1 + (int)between(0, SECTIONS);
    for (int k = 0; k < rope->sections; k++) {
        rope->length[k] = size * between(0.3, 1);
        rope->slow[k] = table(stiffness * between(0.3, 3));
        rope->has_dynamic[k] = k == 0 || between(0, 1) < 0.6;
        rope->fast[k] = rope->has_dynamic[k] ? stiffer(&rope->slow[k]) : rope->slow[k];
    }
}

/* Taut lines moved by stages of either kind, in any direction, by one or several steps. */
static void taut(uint64_t seed, double *worst, int *compared) {
    Rope rope = {0};
    Case c;
    CpsSection section[SECTIONS];
    double element[9 * SECTIONS], rest[SECTIONS] = {0}, want[STAGES];
    random_state = seed;
    random_rope(&rope);
    use_rope(&c, &rope, section, element);
    const double far = between(0, 1) < 0.2 ? 300 * c.line.length : 0, turn = between(0, 6.28),
                 rise = between(-1, 1), flat = sqrt(1 - rise * rise),
                 way[3] = {flat * cos(turn), flat * sin(turn), rise};
    c.line.start.kind = CPS_START_STRAIGHT;
    c.line.start.point_count = 2;
    const double begin = c.line.length * (1 + (between(0, 1) < 0.5 ? 0 : between(0, 0.01)));
    for (int a = 0; a < 3; a++) {
        c.point[a] = far;
        c.point[3 + a] = far + begin * way[a];
        c.line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {far, far, far}};
    }
    c.line.end[CPS_END_B] =
        (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {c.point[3], c.point[4], c.point[5]}};
    bool was_dynamic = false;
    double before = tension_at(&rope, rest, false, begin);
    for (int s = 0; s < STAGES; s++) {
        const bool is_static = between(0, 1) < 0.4;
        const double to = c.line.length * (1 + between(0, 0.03));
        case_move(&c, 1 + (int)between(0, 3), far + to * way[0], far + to * way[1],
                  far + to * way[2]);
        c.stage[s].static_stiffness = is_static;
        if (is_static) memset(rest, 0, sizeof rest);
        if (!is_static && !was_dynamic) find_rest(&rope, s == 0 ? begin : 0, before, rest);
        was_dynamic = !is_static;
        want[s] = before = tension_at(&rope, rest, was_dynamic, to);
        if (before == 0) c.scene.stage_count--; /* slack is another matter */
        if (before == 0) break;
    }
    if (c.scene.stage_count == 0) return;
    double stiffest = 0; /* slope of the line as a whole, at most */
    for (int k = 0; k < rope.sections; k++) {
        const Table *t = &rope.fast[k];
        const CpsStiffnessRow *b = &t->row[t->rows - 1], *a = b - 1;
        stiffest = fmax(stiffest, (b->tension - a->tension) / (b->strain - a->strain));
    }
    Run run = case_open(&c);
    for (int s = 0; s < c.scene.stage_count; s++) {
        for (int i = 0; i < c.stage[s].step_count; i++) (void)case_step(&run);
        const CpsEndReport end = cps_evolution_line_report(run.evolution, 0).end[CPS_END_B];
        const double found = hypot(hypot(end.force[0], end.force[1]), end.force[2]),
                     off = fabs(found - want[s]);
        /* strains are known to the last bits of coordinates, over the shortest element */
        const double noise = 1e-14 * (1 + 3 * far / (0.03 * c.line.length)) * stiffest;
        if (!(off <= 1e-8 * want[s] + noise)) print_error("seed %d, stage %d\n", (int)seed, s);
        CHECK_LESS(off, 1e-8 * want[s] + noise);
        *worst = fmax(*worst, off / (want[s] + noise));
        ++*compared;
    }
    case_close(&run);
}

static void taut_lines(void **state) {
    (void)state;
    double worst = 0;
    int compared = 0;
    for (uint64_t seed = 1; seed <= 60; seed++) taut(seed, &worst, &compared);
    printf("two stiffnesses, taut lines: %d stages of 60 scenes\n", compared);
    CHECK_LESS(200, compared);
    show("two stiffnesses, taut", "tension, worst relative error", 0, worst);
}

/* A number anyone can follow: 1000 m of EA 100 MN, slowly to 1 % and 1 MN; 2 m more by 300 MN add
 * 0.6 MN; back at 1010 m it is 1 MN; slowly at 1011 m 1.1 MN. */
static void by_hand(void **state) {
    (void)state;
    Case c;
    static const double TO[5] = {1010, 1012, 1010, 1011, 1010.5},
                        T[5] = {1e6, 1.6e6, 1e6, 1.1e6, 0.95e6};
    case_begin(&c, 1000, 10, 0, 1e8);
    c.line.has_dynamic_stiffness = true;
    c.line.dynamic_stiffness.stiffness = 3e8;
    case_straight(&c, 0, 1000);
    c.line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_HELD};
    c.line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {1000, 0, 0}};
    for (int s = 0; s < 5; s++) {
        case_move(&c, 1, TO[s], 0, 0);
        c.stage[s].static_stiffness = s == 0 || s == 3;
    }
    Run run = case_open(&c);
    double energy = 0, largest = 0;
    for (int s = 0; s < 5; s++) {
        CpsError err;
        CpsStiffness k;
        const CpsLineView view = case_step(&run);
        const CpsLineReport report = cps_evolution_line_report(run.evolution, 0);
        const CpsTwoStiffnesses two = cps_evolution_two_stiffnesses(run.evolution, 0);
        const double rest = s == 1 || s == 2 ? 1e6 / 1e8 - 1e6 / 3e8
                            : s == 4         ? 1.1e6 / 1e8 - 1.1e6 / 3e8
                                             : 0;
        CHECK_NEAR(report.end[CPS_END_B].force[0], T[s], 1e-4);
        CHECK_INT(two.exists, 1);
        CHECK_INT(two.is_dynamic, s != 0 && s != 3);
        CHECK_NEAR(two.rest_strain[3], rest, 1e-13);
        CHECK_NEAR(two.element_length[3], 100, 0);
        CHECK_NEAR(view.element_length[3], 100 * (1 + rest), 1e-10);
        CHECK_INT(cps_evolution_stiffness(run.evolution, 0, CPS_END_B, CPS_STIFFNESS_STEP, &k,
                                          &err),
                  CPS_OK);
        CHECK_RELATIVE(k.matrix[0], (s == 0 || s == 3 ? 1e8 : 3e8) / 1000, 1e-9);
        if (s == 1) energy = report.ledger.elastic;
        largest = fmax(largest, report.end[CPS_END_B].force[0]);
    }
    CHECK_NEAR(energy, 0.5 * (1e6 + 1.6e6) * 2, 1);
    show("two stiffnesses, by hand", "tension at 1012 m [N]", 1.6e6, largest);
    case_close(&run);
}

/* ---- hanging ---- */

typedef struct Hanging {
    double length, weight, slow, fast; /* m, N/m, N, N */
} Hanging;

/* From A to B with the force h, v at B; h_0, v_0 the one before, where the stiffness is dynamic. */
static void span(const Hanging *of, const double now[2], const double *before, double *out) {
    static const double AT[3] = {-0.774596669241483377, 0, 0.774596669241483377},
                        BY[3] = {5 / 9.0, 8 / 9.0, 5 / 9.0};
    enum { PARTS = 2000 };
    out[0] = out[1] = 0;
    for (int i = 0; i < PARTS; i++)
        for (int k = 0; k < 3; k++) {
            const double s = of->length * (i + 0.5 + 0.5 * AT[k]) / PARTS, /* from B */
                up = now[1] - of->weight * s, tension = hypot(now[0], up);
            double strain = tension / of->slow;
            if (before)
                strain = tension / of->fast + hypot(before[0], before[1] - of->weight * s) *
                                                  (1 / of->slow - 1 / of->fast);
            const double by = 0.5 * BY[k] * of->length / PARTS * (1 + strain) / tension;
            out[0] += by * now[0];
            out[1] += by * up;
        }
}

static void solve(const Hanging *of, double x, double z, const double *before, double now[2]) {
    double error = INFINITY;
    for (int i = 0; i < 100 && error > 1e-11 * of->length; i++) {
        double at[2], beside[2][2];
        const double d = 1e-6 * (now[0] + fabs(now[1]));
        span(of, now, before, at);
        for (int k = 0; k < 2; k++) {
            const double other[2] = {now[0] + (k == 0 ? d : 0), now[1] + (k == 1 ? d : 0)};
            span(of, other, before, beside[k]);
        }
        const double a = (beside[0][0] - at[0]) / d, b = (beside[1][0] - at[0]) / d,
                     c = (beside[0][1] - at[1]) / d, e = (beside[1][1] - at[1]) / d,
                     det = a * e - b * c, rx = x - at[0], rz = z - at[1];
        const double step = (e * rx - b * rz) / det;
        now[0] = step < -0.5 * now[0] ? 0.5 * now[0] : now[0] + step;
        now[1] += (a * rz - c * rx) / det;
        error = hypot(rx, rz);
    }
    CHECK_LESS(error, 1e-11 * of->length);
}

/* A heavy line laid by statics, moved slowly, then fast there and on: force at B. */
static void hanging(void **state) {
    (void)state;
    static const Hanging OF = {1200, 300, 6e7, 2.2e8};
    static const double PLACE[3][2] = {{1100, 400}, {1125, 405}, {1133, 398}};
    double now[3][2], error[3];
    memcpy(now[0], (double[2]){8e5, 4e5}, sizeof now[0]);
    solve(&OF, PLACE[0][0], PLACE[0][1], NULL, now[0]);
    memcpy(now[1], now[0], sizeof now[1]);
    solve(&OF, PLACE[1][0], PLACE[1][1], NULL, now[1]);
    memcpy(now[2], now[1], sizeof now[2]);
    solve(&OF, PLACE[2][0], PLACE[2][1], now[1], now[2]);
    double wrong[2];
    memcpy(wrong, now[1], sizeof wrong);
    solve(&OF, PLACE[2][0], PLACE[2][1], NULL, wrong);
    printf(
        "two stiffnesses, hanging: H %.3f N slowly at 1125 m; at 1133 m %.3f N fast, %.3f slowly\n",
        now[1][0], now[2][0], wrong[0]);
    for (int k = 0; k < 3; k++) {
        Case c;
        char figure[80];
        case_begin(&c, OF.length, 20 << k, OF.weight, OF.slow);
        c.line.has_dynamic_stiffness = true;
        c.line.dynamic_stiffness.stiffness = OF.fast;
        case_laid(&c, PLACE[0][0], PLACE[0][1]);
        case_move(&c, 2, PLACE[1][0], 0, PLACE[1][1]);
        c.stage[0].static_stiffness = true;
        case_move(&c, 3, PLACE[2][0], 0, PLACE[2][1]);
        Run run = case_open(&c);
        for (int i = 0; i < 3; i++) (void)case_step(&run);
        for (int i = 0; i < 3; i++) (void)case_step(&run);
        const double *f = cps_evolution_line_report(run.evolution, 0).end[CPS_END_B].force;
        error[k] = hypot(f[0] - now[2][0], f[2] - now[2][1]);
        snprintf(figure, sizeof figure, "force at B, %d elements, error [N]", 20 << k);
        show("two stiffnesses, hanging", figure, 0, error[k]);
        case_close(&run);
    }
    CHECK_NEAR(order(error[0], error[1]), 2, 0.1);
    CHECK_NEAR(order(error[1], error[2]), 2, 0.1);
    CHECK_LESS(error[2], 1e-4 * now[2][0]);
}

/* ---- states ---- */

static CpsEvolution *open_evolution(const Case *c) {
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    CHECK_INT(cps_evolution_create(&c->scene, &evolution, &err), CPS_OK);
    return evolution;
}

/* A saved state of any step goes on with the same bits; a move by the static stiffness and its
 * return leave no trace. */
static void states(void **state) {
    (void)state;
    static const Table FAST = {3, {{0, 0}, {0.002, 1e5}, {0.01, 9e5}}};
    Case c;
    CpsError err = {0};
    enum { N = 24, STEPS = 8 };
    case_begin(&c, 300, N, 200, 3e7);
    c.line.has_dynamic_stiffness = true;
    c.line.dynamic_stiffness = (CpsDynamicStiffness){.row_count = FAST.rows, .row = FAST.row};
    case_bed(&c, 0.4);
    case_laid(&c, 260, 100);
    case_move(&c, 2, 270, 5, 100);
    c.stage[0].static_stiffness = true;
    case_move(&c, 3, 274, 0, 101);
    case_move(&c, 2, 271, 0, 100);
    c.stage[2].static_stiffness = true;
    double place[STEPS][3 * (N + 1)];
    CpsEvolution *whole = open_evolution(&c);
    unsigned char *saved[STEPS];
    const size_t size = cps_evolution_state_size(whole);
    for (int s = 0; s < STEPS; s++) {
        CHECK_INT(cps_evolution_step(whole, &err), CPS_OK);
        CHECK_INT(cps_outcome_is_certified(cps_evolution_report(whole).outcome), 1);
        memcpy(place[s], cps_evolution_line_view(whole, 0).position, sizeof place[s]);
        cps_evolution_save(whole, saved[s] = malloc(size));
        /* the other stiffness, and back */
        CpsChange change = {.end = CPS_END_B,
                            .to = {.kind = CPS_END_KIND_HELD, .value = {268, 1, 99}}};
        CpsStage move = cps_stage_default();
        move.static_stiffness = s % 2 == 0;
        move.change_count = 1;
        move.change = &change;
        if (s == 0 || s == 2 || s == 5) {
            CHECK_INT(cps_evolution_move(whole, &move, &err), CPS_OK);
            CHECK_INT(cps_evolution_two_stiffnesses(whole, 0).is_dynamic, s % 2 != 0);
            CHECK_INT(cps_evolution_take_back(whole, &err), CPS_OK);
        }
    }
    for (int s = 0; s + 1 < STEPS; s++) {
        CpsEvolution *again = open_evolution(&c);
        CHECK_INT(cps_evolution_load(again, saved[s], size, &err), CPS_OK);
        for (int i = s + 1; i < STEPS; i++) {
            CHECK_INT(cps_evolution_step(again, &err), CPS_OK);
            assert_memory_equal(cps_evolution_line_view(again, 0).position, place[i],
                                sizeof place[i]);
        }
        cps_evolution_destroy(again);
    }
    /* another dynamic stiffness is another scene */
    c.line.dynamic_stiffness = (CpsDynamicStiffness){.stiffness = 9e8};
    CpsEvolution *other = open_evolution(&c);
    CHECK_INT(cps_evolution_load(other, saved[3], size, &err), CPS_ERR_ARGUMENT);
    cps_evolution_destroy(other);
    cps_evolution_destroy(whole);
    for (int s = 0; s < STEPS; s++) free(saved[s]);
    CHECK_INT(cps_evolution_two_stiffnesses(NULL, 0).exists, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(by_hand),
        cmocka_unit_test(taut_lines),
        cmocka_unit_test(hanging),
        cmocka_unit_test(states),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
