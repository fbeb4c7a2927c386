/* SPDX-License-Identifier: BSD-3-Clause */
/* The words of a law file, how each is made from its values, and their table (see set_keys.h). */
#include "io/schema/tables/set_keys.h"

#include <stdlib.h>

#include "base/status.h"
#include "io/schema/rows.h"

typedef const CpsiSetValues *Values;
typedef CpsiSetMade *Made;

CpsStatus cpsi_set_match(const CpsiNumberRows *value, const char *name, int found, const char *what,
                         int expected, const char *reason, CpsError *err) {
    if (found == expected) return CPS_OK;
    return cpsi_fail_at(err, CPS_ERR_INPUT, "", value->node->line, value->node->column,
                        "'%s': found %d %s, expected %d, as many as %s", name, found, what,
                        expected, reason);
}

static const char COMPONENTS[] = "its set has components";

/* ---- primitives ---- */

static CpsStatus make_point(Values v, Made made, CpsError *err) {
    return cps_set_point(v->rows.columns, v->rows.x, &made->set, err);
}

static CpsStatus make_interval(Values v, Made made, CpsError *err) {
    return cps_set_interval(v->rows.x[0], v->rows.x[1], &made->set, err);
}

static CpsStatus make_disc(Values v, Made made, CpsError *err) {
    return cps_set_ball(2, NULL, v->number, &made->set, err);
}

static CpsStatus make_ball(Values v, Made made, CpsError *err) {
    return cps_set_ball(v->dimension, NULL, v->number, &made->set, err);
}

static CpsStatus make_ellipse(Values v, Made made, CpsError *err) {
    const size_t n = (size_t)v->rows.columns;
    double *shape = calloc(n * n, sizeof *shape);
    if (!shape) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    for (size_t i = 0; i < n; i++) shape[i * n + i] = v->rows.x[i] * v->rows.x[i];
    const CpsStatus status = cps_set_ellipsoid((int)n, NULL, shape, &made->set, err);
    free(shape);
    return status;
}

static CpsStatus make_ellipsoid(Values v, Made made, CpsError *err) {
    return cps_set_ellipsoid(v->rows.rows, NULL, v->rows.x, &made->set, err);
}

static CpsStatus make_box(Values v, Made made, CpsError *err) {
    const int n = v->rows.columns;
    return cps_set_box(n, v->rows.x, v->rows.x + n, &made->set, err);
}

static CpsStatus make_segment(Values v, Made made, CpsError *err) {
    const int n = v->rows.columns;
    return cps_set_segment(n, v->rows.x, v->rows.x + n, &made->set, err);
}

static CpsStatus make_polytope(Values v, Made made, CpsError *err) {
    return cps_set_hull_of_points(v->rows.columns, v->rows.rows, v->rows.x, &made->set, err);
}

static CpsStatus make_strip(Values v, Made made, CpsError *err) {
    const double half = 0.5 * v->number;
    return cps_set_strip(v->rows.columns, v->rows.x, -half, half, &made->set, err);
}

static CpsStatus make_half_space(Values v, Made made, CpsError *err) {
    return cps_set_half_space(v->rows.columns, v->rows.x, v->number, &made->set, err);
}

static CpsStatus make_inequalities(Values v, Made made, CpsError *err) {
    const CpsiNumberRows *rows = &v->rows, *offsets = &v->offsets;
    const CpsStatus status = cpsi_set_match(offsets, "offsets", offsets->columns, "numbers",
                                            rows->rows, "there are rows", err);
    if (status != CPS_OK) return status;
    return cps_set_inequalities(rows->columns, rows->rows, rows->x, offsets->x, &made->set, err);
}

static CpsStatus make_subspace(Values v, Made made, CpsError *err) {
    return cps_set_subspace(v->rows.columns, v->rows.rows, v->rows.x, &made->set, err);
}

static CpsStatus make_rays(Values v, Made made, CpsError *err) {
    return cps_set_cone_of_rays(v->rows.columns, v->rows.rows, v->rows.x, &made->set, err);
}

static CpsStatus make_friction_cone(Values v, Made made, CpsError *err) {
    return cps_set_friction_cone(v->dimension, v->number, &made->set, err);
}

/* ---- operations ---- */

static const CpsSet *const *sets(Values v) { return (const CpsSet *const *)v->set; }
static const CpsLaw *const *laws(Values v) { return (const CpsLaw *const *)v->law; }

static CpsStatus make_product(Values v, Made made, CpsError *err) {
    return cps_set_product(v->count, sets(v), &made->set, err);
}

static CpsStatus make_intersection(Values v, Made made, CpsError *err) {
    return cps_set_intersection(v->count, sets(v), &made->set, err);
}

static CpsStatus make_sum(Values v, Made made, CpsError *err) {
    return cps_set_sum(v->count, sets(v), &made->set, err);
}

static CpsStatus make_hull(Values v, Made made, CpsError *err) {
    return cps_set_hull(v->count, sets(v), &made->set, err);
}

/* Check that `map` has as many rows or columns (`found`) as the space has components. */
static CpsStatus match_map(Values v, int found, const char *what, int space, CpsError *err) {
    return cpsi_set_match(&v->rows, "map", found, what, space, COMPONENTS, err);
}

static CpsStatus make_preimage(Values v, Made made, CpsError *err) {
    const CpsStatus status = match_map(v, v->rows.rows, "rows", cps_set_space(v->set[0]), err);
    if (status != CPS_OK) return status;
    return cps_set_preimage(v->rows.columns, v->rows.x, NULL, v->set[0], &made->set, err);
}

static CpsStatus make_image(Values v, Made made, CpsError *err) {
    const CpsStatus status =
        match_map(v, v->rows.columns, "columns", cps_set_space(v->set[0]), err);
    return status ? status : cps_set_image(v->rows.rows, v->rows.x, v->set[0], &made->set, err);
}

static CpsStatus make_translate(Values v, Made made, CpsError *err) {
    const CpsStatus status = cpsi_set_match(&v->rows, "by", v->rows.columns, "numbers",
                                            cps_set_space(v->set[0]), COMPONENTS, err);
    return status ? status : cps_set_translate(v->rows.x, v->set[0], &made->set, err);
}

static CpsStatus make_scale(Values v, Made made, CpsError *err) {
    return cps_set_scale(v->number, v->set[0], &made->set, err);
}

static CpsStatus make_polar(Values v, Made made, CpsError *err) {
    return cps_set_polar(v->set[0], &made->set, err);
}

/* ---- laws ---- */

static CpsStatus law_coulomb(Values v, Made made, CpsError *err) {
    return cps_law_coulomb(v->number, v->load, &made->law, err);
}

static CpsStatus law_unit_load(Values v, Made made, CpsError *err) {
    return cps_law_unit_load(v->set[0], v->load, &made->law, err);
}

static CpsStatus law_product(Values v, Made made, CpsError *err) {
    return cps_law_product(v->count, laws(v), &made->law, err);
}

static CpsStatus law_preimage(Values v, Made made, CpsError *err) {
    const CpsStatus status = match_map(v, v->rows.rows, "rows", cps_law_space(v->law[0]), err);
    if (status != CPS_OK) return status;
    made->composed = true;
    return cps_law_preimage(v->rows.columns, v->rows.x, v->law[0], &made->composition, &made->law,
                            err);
}

static CpsStatus law_contacts(Values v, Made made, CpsError *err) {
    return cps_law_contacts(v->columns, v->count, laws(v), v->map, &made->law, err);
}

/* ---- terms of resistance laws ---- */

static CpsStatus term_dry(Values v, Made made, CpsError *err) {
    return cps_resistance_dry(v->law[0], &made->term, err);
}

static CpsStatus term_viscous(Values v, Made made, CpsError *err) {
    return cps_resistance_viscous(v->rows.rows, v->rows.x, &made->term, err);
}

static CpsStatus term_power(Values v, Made made, CpsError *err) {
    return cps_resistance_power(v->law[0], v->degree, v->number, &made->term, err);
}

static CpsStatus term_table(Values v, Made made, CpsError *err) {
    const size_t count = (size_t)v->rows.rows;
    double *speed = calloc(2 * count, sizeof *speed), *factor = speed ? speed + count : NULL;
    if (!speed) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    for (size_t i = 0; i < count; i++) {
        speed[i] = v->rows.x[2 * i];
        factor[i] = v->rows.x[2 * i + 1];
    }
    const CpsStatus status =
        cps_resistance_table(v->law[0], (int)count, speed, factor, &made->term, err);
    free(speed);
    return status;
}

/* ---- the tables ---- */

/* Values of words that occur more than once. */
#define AT_LEAST_0  REQUIRED, NUMBER(Set, number), NOT_NEGATIVE
#define FACTOR      REQUIRED, NUMBER(Set, number), ANY
#define LOAD        REQUIRED, NUMBER(Set, load), NOT_NEGATIVE
#define DIMENSION   REQUIRED, INTEGER(Set, dimension), 1, CPSI_LAW_MOST_COMPONENTS, false
#define DIRECTION   REQUIRED, VECTOR(Set, rows, CPSI_LAW_MOST_COMPONENTS), ANY
#define MATRIX      REQUIRED, ROWS(Set, rows, 0), 1, CPS_SET_MAX_ITEMS, false
#define SYMMETRIC   REQUIRED, SQUARE(Set, rows), 1, CPS_SET_MAX_ITEMS, false
#define PART(kind)  REQUIRED, EXPRESSION(Set, kind), .inside = &cpsi_set_words
#define PARTS(kind) REQUIRED, EXPRESSIONS(Set, kind), .inside = &cpsi_set_words
#define UNDER(word) REQUIRED, AROUND, .inside = &word

/* The keys of the words that have keys; they are stored in the same struct. */
#define WORD_KEYS(word, ...)                            \
    static const CpsiKey word##_KEYS[] = {__VA_ARGS__}; \
    static const CpsiMapping word = {KEYS(word##_KEYS)}

WORD_KEYS(BALL, {"radius", AT_LEAST_0, .help = "radius"},
          {"dimension", DIMENSION, .help = "number of components"});
WORD_KEYS(STRIP, {"normal", DIRECTION, .help = "direction across"},
          {"width", AT_LEAST_0, .help = "width, in units of 1/|normal|"});
WORD_KEYS(HALF_SPACE, {"normal", DIRECTION, .help = "outward normal"},
          {"offset", FACTOR, .help = "largest <normal, x>"});
WORD_KEYS(INEQUALITIES, {"rows", MATRIX, .help = "one normal per row"},
          {"offsets", REQUIRED, VECTOR(Set, offsets, CPS_SET_MAX_ITEMS), ANY,
           .help = "one per row"});
WORD_KEYS(FRICTION_CONE, {"friction", AT_LEAST_0, .help = "coefficient f"},
          {"dimension", DIMENSION, .help = "number of components, N the last"});
WORD_KEYS(MAP_OF_SET, {"map", MATRIX, .help = "matrix L"}, {"of", PART(sets), .help = "set"});
WORD_KEYS(TRANSLATE, {"by", DIRECTION, .help = "shift"}, {"of", PART(sets), .help = "set"});
WORD_KEYS(SCALE, {"by", FACTOR, .help = "factor"}, {"of", PART(sets), .help = "set"});
WORD_KEYS(COULOMB, {"friction", AT_LEAST_0, .help = "coefficient"},
          {"load", LOAD, .help = "normal force, N"});
WORD_KEYS(UNIT_LOAD, {"load", LOAD, .help = "normal force, N"},
          {"of", PART(sets), .help = "set of friction coefficients"});
WORD_KEYS(MAP_OF_LAW, {"map", MATRIX, .help = "matrix L"}, {"of", PART(laws), .help = "law"});
WORD_KEYS(POWER, {"degree", REQUIRED, NUMBER(Set, degree), ANY, .help = "above 1"},
          {"factor", FACTOR, .help = "not negative"}, {"of", PART(laws), .help = "set"});
WORD_KEYS(TABLE,
          {"points", REQUIRED, ROWS(Set, rows, 2), 1, CPS_SET_MAX_ITEMS, false,
           .help = "[speed, factor], speeds from 0, factors not falling"},
          {"of", PART(laws), .help = "set"});

/* Each row: word, value, function that makes it, help. SOLVED are words over parts or rows whose
 * queries solve a conic program over all of them, so that their size is limited more strictly
 * (CPSI_LAW_MOST_WORK). A single set with a conic form of fixed size, as the friction cone, is
 * MADE. */
#define MADE(function)   .make = function
#define SOLVED(function) .make = function, .solved = true

static const CpsiKey SET_WORDS[] = {
    {"point", DIRECTION, MADE(make_point), .help = "a point"},
    {"interval", REQUIRED, SIDE(Set, rows), ANY, MADE(make_interval),
     .help = "b for -b .. b, or [low, high]; ends may be .inf"},
    {"disc", AT_LEAST_0, MADE(make_disc), .help = "disc in the plane around 0: its radius"},
    {"ball", UNDER(BALL), MADE(make_ball), .help = "ball around 0"},
    {"ellipse", REQUIRED, VECTOR(Set, rows, CPSI_LAW_MOST_COMPONENTS), POSITIVE, MADE(make_ellipse),
     .help = "semi-axes along the components"},
    {"ellipsoid", SYMMETRIC, MADE(make_ellipsoid),
     .help = "{x : x' S^-1 x <= 1}: the matrix S, symmetric positive definite"},
    {"box", REQUIRED, SIDES(Set, rows, CPSI_LAW_MOST_COMPONENTS), ANY, MADE(make_box),
     .help = "per component a half width or [low, high]; ends may be .inf"},
    {"segment", REQUIRED, ROWS(Set, rows, 0), 2, 2, false, MADE(make_segment),
     .help = "between two points"},
    {"polytope", MATRIX, MADE(make_polytope), .closed = 3, .help = "convex hull of points"},
    {"strip", UNDER(STRIP), MADE(make_strip), .help = "|<normal, x>| <= width/2"},
    {"half_space", UNDER(HALF_SPACE), MADE(make_half_space), .help = "<normal, x> <= offset"},
    {"inequalities", UNDER(INEQUALITIES), SOLVED(make_inequalities),
     .help = "<row, x> <= offset for each row"},
    {"subspace", MATRIX, MADE(make_subspace), .help = "spanned by the rows"},
    {"rays", MATRIX, MADE(make_rays), .help = "all sums of these rays with factors of at least 0"},
    {"friction_cone", UNDER(FRICTION_CONE), MADE(make_friction_cone),
     .help = "{(F, N) : |F| <= f N}"},
    {"product", PARTS(sets), MADE(make_product), .help = "components one after the other"},
    {"intersection", PARTS(sets), SOLVED(make_intersection), .help = "common points"},
    {"sum", PARTS(sets), SOLVED(make_sum), .help = "Minkowski sum"},
    {"hull", PARTS(sets), SOLVED(make_hull), .help = "convex hull of the union"},
    {"preimage", UNDER(MAP_OF_SET), SOLVED(make_preimage), .help = "{x : L x in set}"},
    {"image", UNDER(MAP_OF_SET), SOLVED(make_image), .help = "{L x : x in set}"},
    {"translate", UNDER(TRANSLATE), MADE(make_translate), .help = "the set moved"},
    {"scale", UNDER(SCALE), MADE(make_scale), .help = "the set scaled around 0"},
    {"polar", PART(sets), SOLVED(make_polar), .help = "{x : <x, y> <= 1 for all y of the set}"},
    {"coulomb", UNDER(COULOMB), MADE(law_coulomb), .help = "disc of radius friction x load"},
    {"unit_load", UNDER(UNIT_LOAD), MADE(law_unit_load),
     .help = "load times a set of friction coefficients"},
    {"contacts", REQUIRED, LIST(Set, contacts, 1), .inside = &cpsi_contact, MADE(law_contacts),
     .help = "a body on several contacts"},
};

static const CpsiKey LAW_WORDS[] = {
    {"product", PARTS(laws), MADE(law_product),
     .help = "independent laws, components one after the other"},
    {"preimage", UNDER(MAP_OF_LAW), SOLVED(law_preimage),
     .help = "forces G with L G in the law: internal velocities eliminated"},
};

static const CpsiKey TERM_WORDS[] = {
    {"dry", PART(laws), MADE(term_dry), .help = "dissipation function of a set"},
    {"viscous", SYMMETRIC, MADE(term_viscous),
     .help = "<V, D V>/2: the matrix D, positive semidefinite, N s/m"},
    {"power", UNDER(POWER), MADE(term_power), .help = "factor g^degree/degree"},
    {"table", UNDER(TABLE), MADE(term_table),
     .help = "the set times a factor that depends on speed"},
};

const CpsiMapping cpsi_set_words = {"set", KEYS(SET_WORDS), .word = "word",
                                    .example = "{disc: 500}"};
const CpsiMapping cpsi_law_words = {"law", KEYS(LAW_WORDS), .word = "word",
                                    .example = "{disc: 500}"};
const CpsiMapping cpsi_term_words = {"term", KEYS(TERM_WORDS), .word = "term",
                                     .example = "{dry: {disc: 500}}"};

static const CpsiKey CONTACT_KEYS[] = {
    {"map", REQUIRED, ROWS(Contact, map, 0), 1, CPS_SET_MAX_ITEMS, false,
     .help = "B, takes the body's velocity to the contact's"},
    {"of", REQUIRED, EXPRESSION(Contact, of), .inside = &cpsi_set_words,
     .help = "law of the contact"},
};
const CpsiMapping cpsi_contact = {"contact", KEYS(CONTACT_KEYS), INTO(Contact),
                                  .example = "{map: [[1, 0]], of: {interval: 5}}"};

static const CpsiKey FILE_KEYS[] = {
    {"capstan", REQUIRED, INTEGER(LawFile, version), 1, 1, false,
     .help = "version of this file format"},
    {"title", OPTIONAL, TEXT(LawFile, title, CPSI_LAW_LONGEST_TITLE),
     .help = "heading of answers and pictures"},
    {"law", ONE_OF, EXPRESSION(LawFile, law), .inside = &cpsi_set_words,
     .help = "friction law: its set of forces, which must contain 0"},
    {"load", OPTIONAL, VECTOR(LawFile, load, CPSI_LAW_MOST_COMPONENTS), ANY, .with = "law",
     .help = "constant force on the system, N"},
    {"resistance", ONE_OF, EXPRESSIONS(LawFile, resistance), .inside = &cpsi_term_words,
     .help = "resistance law: its terms"},
};
const CpsiMapping cpsi_law_file = {"law file", "file", KEYS(FILE_KEYS), INTO(LawFile)};
