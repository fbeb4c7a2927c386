/* SPDX-License-Identifier: BSD-3-Clause */
/* The words of a law file, how each is made of its values, and their table (see set_words.h). */
#include "io/schema/set_words.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"

typedef const CpsiLawValue *Values;

CpsStatus cpsi_law_match(const CpsiLawValue *value, const char *name, int found, const char *what, int expected,
                         const char *reason, CpsError *err) {
    if (found == expected) return CPS_OK;
    return cpsi_fail_at(err, CPS_ERR_INPUT, "", value->node->line, value->node->column,
                        "'%s': found %d %s, expected %d, as many as %s", name, found, what, expected, reason);
}

static const char COMPONENTS[] = "its set has components";

/* ---- primitives ---- */

static CpsStatus make_point(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_point(v[0].columns, v[0].x, &made->set, err);
}

static CpsStatus make_interval(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_interval(v[0].x[0], v[0].x[1], &made->set, err);
}

static CpsStatus make_disc(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_ball(2, NULL, v[0].x[0], &made->set, err);
}

static CpsStatus make_ball(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_ball((int)v[1].x[0], NULL, v[0].x[0], &made->set, err);
}

static CpsStatus make_ellipse(Values v, CpsiLawMade *made, CpsError *err) {
    const size_t n = (size_t)v[0].columns;
    double *shape = calloc(n * n, sizeof *shape);
    if (!shape) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    for (size_t i = 0; i < n; i++) shape[i * n + i] = v[0].x[i] * v[0].x[i];
    const CpsStatus status = cps_set_ellipsoid((int)n, NULL, shape, &made->set, err);
    free(shape);
    return status;
}

static CpsStatus make_ellipsoid(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_ellipsoid(v[0].rows, NULL, v[0].x, &made->set, err);
}

static CpsStatus make_box(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_box(v[0].columns, v[0].x, v[0].x + v[0].columns, &made->set, err);
}

static CpsStatus make_segment(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_segment(v[0].columns, v[0].x, v[0].x + v[0].columns, &made->set, err);
}

static CpsStatus make_polytope(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_hull_of_points(v[0].columns, v[0].rows, v[0].x, &made->set, err);
}

static CpsStatus make_strip(Values v, CpsiLawMade *made, CpsError *err) {
    const double half = 0.5 * v[1].x[0];
    return cps_set_strip(v[0].columns, v[0].x, -half, half, &made->set, err);
}

static CpsStatus make_half_space(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_half_space(v[0].columns, v[0].x, v[1].x[0], &made->set, err);
}

static CpsStatus make_inequalities(Values v, CpsiLawMade *made, CpsError *err) {
    const CpsStatus status =
        cpsi_law_match(&v[1], "offsets", v[1].columns, "numbers", v[0].rows, "there are rows", err);
    return status ? status : cps_set_inequalities(v[0].columns, v[0].rows, v[0].x, v[1].x, &made->set, err);
}

static CpsStatus make_subspace(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_subspace(v[0].columns, v[0].rows, v[0].x, &made->set, err);
}

static CpsStatus make_rays(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_cone_of_rays(v[0].columns, v[0].rows, v[0].x, &made->set, err);
}

static CpsStatus make_friction_cone(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_friction_cone((int)v[1].x[0], v[0].x[0], &made->set, err);
}

/* ---- operations ---- */

static const CpsSet *const *sets(Values v) { return (const CpsSet *const *)v->set; }

static CpsStatus make_product(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_product(v[0].count, sets(v), &made->set, err);
}

static CpsStatus make_intersection(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_intersection(v[0].count, sets(v), &made->set, err);
}

static CpsStatus make_sum(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_sum(v[0].count, sets(v), &made->set, err);
}

static CpsStatus make_hull(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_hull(v[0].count, sets(v), &made->set, err);
}

static CpsStatus make_preimage(Values v, CpsiLawMade *made, CpsError *err) {
    const CpsSet *of = v[1].set[0];
    const CpsStatus status = cpsi_law_match(&v[0], "map", v[0].rows, "rows", cps_set_space(of), COMPONENTS, err);
    return status ? status : cps_set_preimage(v[0].columns, v[0].x, NULL, of, &made->set, err);
}

static CpsStatus make_image(Values v, CpsiLawMade *made, CpsError *err) {
    const CpsSet *of = v[1].set[0];
    const CpsStatus status = cpsi_law_match(&v[0], "map", v[0].columns, "columns", cps_set_space(of), COMPONENTS, err);
    return status ? status : cps_set_image(v[0].rows, v[0].x, of, &made->set, err);
}

static CpsStatus make_translate(Values v, CpsiLawMade *made, CpsError *err) {
    const CpsSet *of = v[1].set[0];
    const CpsStatus status = cpsi_law_match(&v[0], "by", v[0].columns, "numbers", cps_set_space(of), COMPONENTS, err);
    return status ? status : cps_set_translate(v[0].x, of, &made->set, err);
}

static CpsStatus make_scale(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_scale(v[0].x[0], v[1].set[0], &made->set, err);
}

static CpsStatus make_polar(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_set_polar(v[0].set[0], &made->set, err);
}

/* ---- laws ---- */

static CpsStatus law_coulomb(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_law_coulomb(v[0].x[0], v[1].x[0], &made->law, err);
}

static CpsStatus law_unit_load(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_law_unit_load(v[1].set[0], v[0].x[0], &made->law, err);
}

static CpsStatus law_product(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_law_product(v[0].count, (const CpsLaw *const *)v[0].law, &made->law, err);
}

static CpsStatus law_preimage(Values v, CpsiLawMade *made, CpsError *err) {
    const CpsLaw *of = v[1].law[0];
    const CpsStatus status = cpsi_law_match(&v[0], "map", v[0].rows, "rows", cps_law_space(of), COMPONENTS, err);
    if (status) return status;
    made->composed = true;
    return cps_law_preimage(v[0].columns, v[0].x, of, &made->composition, &made->law, err);
}

static CpsStatus law_contacts(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_law_contacts(v[0].columns, v[0].count, (const CpsLaw *const *)v[0].law, v[0].map, &made->law, err);
}

/* ---- terms of resistance laws ---- */

static CpsStatus term_dry(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_resistance_dry(v[0].law[0], &made->term, err);
}

static CpsStatus term_viscous(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_resistance_viscous(v[0].rows, v[0].x, &made->term, err);
}

static CpsStatus term_power(Values v, CpsiLawMade *made, CpsError *err) {
    return cps_resistance_power(v[2].law[0], v[0].x[0], v[1].x[0], &made->term, err);
}

static CpsStatus term_table(Values v, CpsiLawMade *made, CpsError *err) {
    const int count = v[0].rows;
    return cps_resistance_table(v[1].law[0], count, v[0].x, v[0].x + count, &made->term, err);
}

/* ---- the table ---- */

/* clang-format off */

/* type, need, place (none: values are taken by position), unit, range, most, inside, words, default; the help follows */
#define ANY(type, need, most) CPSI_##type, CPSI_##need, CPSI_BY_HAND, "", -INFINITY, CPSI_LARGEST, false, most, 0, NULL, NULL
#define NUMBER       ANY(NUMBER, REQUIRED, 0)
#define AT_LEAST_0   CPSI_NUMBER, CPSI_REQUIRED, CPSI_BY_HAND, "", 0, CPSI_LARGEST, false, 0, 0, NULL, NULL
#define VECTOR       ANY(VECTOR, REQUIRED, CPSI_LAW_MOST_COMPONENTS)
#define LENGTHS      CPSI_VECTOR, CPSI_REQUIRED, CPSI_BY_HAND, "", 0, CPSI_LARGEST, true, CPSI_LAW_MOST_COMPONENTS, 0, NULL, NULL
#define OFFSETS      ANY(VECTOR, REQUIRED, CPS_SET_MAX_ITEMS)
#define UP_TO(count) CPSI_INTEGER, CPSI_REQUIRED, CPSI_BY_HAND, "", 1, count, false, 0, 0, NULL, NULL
#define DIMENSION    UP_TO(CPSI_LAW_MOST_COMPONENTS)
#define PLAIN(type)  ANY(type, REQUIRED, CPSI_LAW_MOST_COMPONENTS)
#define GIVEN(type, most) CPSI_##type, CPSI_OPTIONAL, CPSI_BY_HAND, "", -INFINITY, CPSI_LARGEST, false, most, 0, NULL, NULL

static const CpsiLawWord SET_WORDS[] = {
    {"point", {{NULL, VECTOR, ""}}, make_point, false, "a point"},
    {"interval", {{NULL, PLAIN(SIDE), ""}}, make_interval, false, "b for -b .. b, or [low, high]; ends may be .inf"},
    {"disc", {{NULL, AT_LEAST_0, ""}}, make_disc, false, "disc in the plane around 0: its radius"},
    {"ball", {{"radius", AT_LEAST_0, "radius"}, {"dimension", DIMENSION, "number of components"}}, make_ball, false,
     "ball around 0"},
    {"ellipse", {{NULL, LENGTHS, ""}}, make_ellipse, false, "semi-axes along the components"},
    {"ellipsoid", {{NULL, PLAIN(SQUARE), ""}}, make_ellipsoid, false,
     "{x : x' S^-1 x <= 1}: the matrix S, symmetric positive definite"},
    {"box", {{NULL, PLAIN(SIDES), ""}}, make_box, false, "per component a half width or [low, high]; ends may be .inf"},
    {"segment", {{NULL, PLAIN(ENDS_OF_SEGMENT), ""}}, make_segment, false, "between two points"},
    {"polytope", {{NULL, PLAIN(MATRIX), ""}}, make_polytope, false, "convex hull of points"},
    {"strip", {{"normal", VECTOR, "direction across"}, {"width", AT_LEAST_0, "width, in units of 1/|normal|"}}, make_strip,
     false, "|<normal, x>| <= width/2"},
    {"half_space", {{"normal", VECTOR, "outward normal"}, {"offset", NUMBER, "largest <normal, x>"}}, make_half_space, false,
     "<normal, x> <= offset"},
    {"inequalities", {{"rows", PLAIN(MATRIX), "one normal per row"}, {"offsets", OFFSETS, "one per row"}}, make_inequalities,
     true, "<row, x> <= offset for each row"},
    {"subspace", {{NULL, PLAIN(MATRIX), ""}}, make_subspace, false, "spanned by the rows"},
    {"rays", {{NULL, PLAIN(MATRIX), ""}}, make_rays, false, "all sums of these rays with factors of at least 0"},
    {"friction_cone", {{"friction", AT_LEAST_0, "coefficient f"}, {"dimension", DIMENSION, "number of components, N the last"}},
     make_friction_cone, false, "{(F, N) : |F| <= f N}"},
    {"product", {{NULL, PLAIN(SETS), ""}}, make_product, false, "components one after the other"},
    {"intersection", {{NULL, PLAIN(SETS), ""}}, make_intersection, true, "common points"},
    {"sum", {{NULL, PLAIN(SETS), ""}}, make_sum, true, "Minkowski sum"},
    {"hull", {{NULL, PLAIN(SETS), ""}}, make_hull, true, "convex hull of the union"},
    {"preimage", {{"map", PLAIN(MATRIX), "matrix L"}, {"of", PLAIN(SET), "set"}}, make_preimage, true, "{x : L x in set}"},
    {"image", {{"map", PLAIN(MATRIX), "matrix L"}, {"of", PLAIN(SET), "set"}}, make_image, true, "{L x : x in set}"},
    {"translate", {{"by", VECTOR, "shift"}, {"of", PLAIN(SET), "set"}}, make_translate, false, "the set moved"},
    {"scale", {{"by", NUMBER, "factor"}, {"of", PLAIN(SET), "set"}}, make_scale, false, "the set scaled around 0"},
    {"polar", {{NULL, PLAIN(SET), ""}}, make_polar, true, "{x : <x, y> <= 1 for all y of the set}"},
};

static const CpsiLawWord LAW_WORDS[] = {
    {"coulomb", {{"friction", AT_LEAST_0, "coefficient"}, {"load", AT_LEAST_0, "normal force, N"}}, law_coulomb, false,
     "disc of radius friction x load"},
    {"unit_load", {{"load", AT_LEAST_0, "normal force, N"}, {"of", PLAIN(SET), "set of friction coefficients"}}, law_unit_load,
     false, "load times a set of friction coefficients"},
    {"product", {{NULL, PLAIN(LAWS), ""}}, law_product, false, "independent laws, components one after the other"},
    {"preimage", {{"map", PLAIN(MATRIX), "matrix L"}, {"of", PLAIN(LAW), "law"}}, law_preimage, true,
     "forces G with L G in the law: internal velocities eliminated"},
    {"contacts", {{NULL, PLAIN(CONTACTS), ""}}, law_contacts, false, "a body on several contacts"},
};

static const CpsiLawWord TERM_WORDS[] = {
    {"dry", {{NULL, PLAIN(LAW), ""}}, term_dry, false, "dissipation function of a set"},
    {"viscous", {{NULL, PLAIN(SQUARE), ""}}, term_viscous, false, "<V, D V>/2: the matrix D, positive semidefinite, N s/m"},
    {"power", {{"degree", NUMBER, "above 1"}, {"factor", NUMBER, "not negative"}, {"of", PLAIN(LAW), "set"}}, term_power,
     false, "factor g^degree/degree"},
    {"table", {{"points", PLAIN(PAIRS), "[speed, factor], speeds from 0, factors not falling"}, {"of", PLAIN(LAW), "set"}},
     term_table, false, "the set times a factor that depends on speed"},
};

const CpsiLawWord cpsi_law_file_word = {"law file",
    {{"capstan", UP_TO(1), "version of this file format"},
     {"title", GIVEN(TEXT, CPSI_LAW_LONGEST_TITLE), "heading of answers and pictures"},
     {"law", GIVEN(LAW, 0), "friction law: its set of forces, which must contain 0"},
     {"load", GIVEN(VECTOR, CPSI_LAW_MOST_COMPONENTS), "constant force on the system, N"},
     {"resistance", GIVEN(TERMS, 0), "resistance law: its terms"}}, NULL, false, "a law"};

const CpsiLawWord cpsi_law_contact_word = {"contact",
    {{"map", PLAIN(MATRIX), "B, takes the body's velocity to the contact's"}, {"of", PLAIN(LAW), "law of the contact"}},
    NULL, false, "a contact"};
/* clang-format on */

const CpsiLawWord *cpsi_law_words(CpsiLawGroup group, int *count) {
#define TABLE(words)                                                                                                   \
    { words, sizeof words / sizeof words[0] }
    static const struct {
        const CpsiLawWord *word;
        int count;
    } GROUP[] = {TABLE(SET_WORDS), TABLE(LAW_WORDS), TABLE(TERM_WORDS)};
    *count = GROUP[group].count;
    return GROUP[group].word;
}

int cpsi_law_key_count(const CpsiLawWord *word) {
    int n = 0;
    while (n < CPSI_LAW_MOST_KEYS && word->key[n].type) n++;
    return n;
}

const CpsiLawWord *cpsi_law_word(CpsiLawGroup group, const char *name) {
    int count;
    const CpsiLawWord *word = cpsi_law_words(group, &count);
    for (int i = 0; i < count; i++)
        if (strcmp(word[i].name, name) == 0) return &word[i];
    return NULL;
}
