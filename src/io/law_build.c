/* SPDX-License-Identifier: BSD-3-Clause */
/* Expressions of sets (see law_build.h): one table of words, one small function each. The recursion is as deep as the
 * file, which the YAML reader limits. What the library refuses is reported at the word that asked for it. */
#include "io/law_build.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "io/keys.h"

static const double ANY = -INFINITY;

/* a message without the name of the C function, which the file's user has not called */
static const char *without_call(const char *message) {
    const size_t name = strspn(message, "abcdefghijklmnopqrstuvwxyz_");
    return strncmp(message, "cps_", 4) == 0 && strncmp(message + name, ": ", 2) == 0 ? message + name + 2 : message;
}

CpsStatus cpsi_law_place(const CpsiLawBuild *b, const CpsiYaml *node, const CpsError *found) {
    const CpsStatus status = found->status == CPS_ERR_ARGUMENT ? CPS_ERR_INPUT : found->status;
    if (node->key)
        return cpsi_fail_at(b->file.err, status, b->file.name, node->line, node->column, "'%.64s': %s", node->key,
                            without_call(found->message));
    return cpsi_fail_at(b->file.err, status, b->file.name, node->line, node->column, "%s",
                        without_call(found->message));
}

/* ---- primitives ---- */

static CpsStatus build_point(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    int n;
    double *x;
    const CpsStatus status = cpsi_law_vector(&b->file, node, "'point'", &n, &x);
    return status != CPS_OK ? status : CPSI_PLACED(b, node, cps_set_point(n, x, out, &found));
}

/* b stands for [-b, b] */
static CpsStatus build_interval(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    double end[2];
    CpsStatus status;
    if (node->kind == CPSI_YAML_SEQUENCE && node->count == 2) {
        status = cpsi_law_number(&b->file, node->child, "'interval'", ANY, false, &end[0]);
        if (status == CPS_OK) status = cpsi_law_number(&b->file, node->child->next, "'interval'", ANY, false, &end[1]);
    } else if (node->kind == CPSI_YAML_SCALAR) {
        status = cpsi_law_number(&b->file, node, "'interval'", 0, false, &end[1]);
        end[0] = -end[1];
    } else {
        return cpsi_law_wrong(&b->file, node, "'interval'", "a number b for -b .. b, or two, as in [-1, 2]");
    }
    return status != CPS_OK ? status : CPSI_PLACED(b, node, cps_set_interval(end[0], end[1], out, &found));
}

static CpsStatus build_disc(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    double radius;
    const CpsStatus status = cpsi_law_number(&b->file, node, "'disc'", 0, false, &radius);
    return status != CPS_OK ? status : CPSI_PLACED(b, node, cps_set_ball(2, NULL, radius, out, &found));
}

static CpsStatus build_ball(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    static const char *const KEY[] = {"radius", "dimension", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    double radius = 0;
    int n = 0;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'ball'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_number(&b->file, child[0], "'radius'", 0, false, &radius);
    if (status == CPS_OK) status = cpsi_law_count(&b->file, child[1], "'dimension'", CPS_SET_MAX_SPACE, &n);
    return status != CPS_OK ? status : CPSI_PLACED(b, node, cps_set_ball(n, NULL, radius, out, &found));
}

/* semi-axes along the coordinates */
static CpsStatus build_ellipse(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    int n;
    double *axis;
    CpsStatus status = cpsi_law_vector(&b->file, node, "'ellipse'", &n, &axis);
    for (const CpsiYaml *x = node->child; x && status == CPS_OK; x = x->next) {
        double length;
        status = cpsi_law_number(&b->file, x, "'ellipse'", 0, true, &length);
    }
    if (status != CPS_OK) return status;
    if (n > CPS_SET_MAX_SPACE) return cpsi_law_wrong(&b->file, node, "'ellipse'", "at most 4096 semi-axes");
    double *shape = CPSI_POOL_TAKE(b->file.pool, (size_t)n * (size_t)n, double);
    if (!shape) return cpsi_law_no_memory(&b->file);
    for (int i = 0; i < n; i++) shape[(size_t)i * (size_t)n + (size_t)i] = axis[i] * axis[i];
    return CPSI_PLACED(b, node, cps_set_ellipsoid(n, NULL, shape, out, &found));
}

static CpsStatus build_ellipsoid(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    int rows, columns;
    double *shape;
    const CpsStatus status = cpsi_law_matrix(&b->file, node, "'ellipsoid'", &rows, &columns, &shape);
    if (status != CPS_OK) return status;
    if (rows != columns) return cpsi_law_wrong(&b->file, node, "'ellipsoid'", "a square shape matrix");
    return CPSI_PLACED(b, node, cps_set_ellipsoid(rows, NULL, shape, out, &found));
}

/* half widths, or [low, high] for each component */
static CpsStatus build_box(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_law_wrong(&b->file, node, "'box'",
                              "half widths, as in [300, 100], or sides, as in [[-1, 2], [0, 5]]");
    double *low = CPSI_POOL_TAKE(b->file.pool, node->count, double);
    double *high = CPSI_POOL_TAKE(b->file.pool, node->count, double);
    if (!low || !high) return cpsi_law_no_memory(&b->file);
    CpsStatus status = CPS_OK;
    int n = 0;
    for (const CpsiYaml *x = node->child; x && status == CPS_OK; x = x->next, n++) {
        if (x->kind == CPSI_YAML_SEQUENCE && x->count == 2) {
            status = cpsi_law_number(&b->file, x->child, "'box'", ANY, false, &low[n]);
            if (status == CPS_OK) status = cpsi_law_number(&b->file, x->child->next, "'box'", ANY, false, &high[n]);
        } else {
            status = cpsi_law_number(&b->file, x, "'box'", 0, false, &high[n]);
            low[n] = -high[n];
        }
    }
    return status != CPS_OK ? status : CPSI_PLACED(b, node, cps_set_box(n, low, high, out, &found));
}

static CpsStatus build_segment(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    int rows, n;
    double *x;
    const CpsStatus status = cpsi_law_matrix(&b->file, node, "'segment'", &rows, &n, &x);
    if (status != CPS_OK) return status;
    if (rows != 2) return cpsi_law_wrong(&b->file, node, "'segment'", "its two ends");
    return CPSI_PLACED(b, node, cps_set_segment(n, x, x + n, out, &found));
}

static CpsStatus build_polytope(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    int rows, n;
    double *x;
    const CpsStatus status = cpsi_law_matrix(&b->file, node, "'polytope'", &rows, &n, &x);
    return status != CPS_OK ? status : CPSI_PLACED(b, node, cps_set_hull_of_points(n, rows, x, out, &found));
}

/* {x : rows x <= offsets} */
static CpsStatus build_inequalities(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    static const char *const KEY[] = {"rows", "offsets", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    int rows, n, count;
    double *x, *offset;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'inequalities'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_matrix(&b->file, child[0], "'rows'", &rows, &n, &x);
    if (status == CPS_OK) status = cpsi_law_vector(&b->file, child[1], "'offsets'", &count, &offset);
    if (status != CPS_OK) return status;
    if (count != rows) return cpsi_law_wrong(&b->file, child[1], "'offsets'", "one number for each row");
    return CPSI_PLACED(b, node, cps_set_inequalities(n, rows, x, offset, out, &found));
}

static CpsStatus build_strip(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    static const char *const KEY[] = {"normal", "width", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    int n;
    double *normal, width;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'strip'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_vector(&b->file, child[0], "'normal'", &n, &normal);
    if (status == CPS_OK) status = cpsi_law_number(&b->file, child[1], "'width'", 0, false, &width);
    return status != CPS_OK ? status
                            : CPSI_PLACED(b, node, cps_set_strip(n, normal, -0.5 * width, 0.5 * width, out, &found));
}

static CpsStatus build_half_space(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    static const char *const KEY[] = {"normal", "offset", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    int n;
    double *normal, offset;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'half_space'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_vector(&b->file, child[0], "'normal'", &n, &normal);
    if (status == CPS_OK) status = cpsi_law_number(&b->file, child[1], "'offset'", ANY, false, &offset);
    return status != CPS_OK ? status : CPSI_PLACED(b, node, cps_set_half_space(n, normal, offset, out, &found));
}

static CpsStatus build_subspace(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    int rows, n;
    double *x;
    const CpsStatus status = cpsi_law_matrix(&b->file, node, "'subspace'", &rows, &n, &x);
    return status != CPS_OK ? status : CPSI_PLACED(b, node, cps_set_subspace(n, rows, x, out, &found));
}

/* ---- operations ---- */

typedef CpsStatus ManySets(int count, const CpsSet *const *parts, CpsSet **out, CpsError *err);

static CpsStatus build_many(CpsiLawBuild *b, const CpsiYaml *node, ManySets *operation, CpsSet **out) {
    char what[80];
    CpsError found;
    CpsSet **part = NULL;
    snprintf(what, sizeof what, "'%s'", node->key);
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_law_wrong(&b->file, node, what, "a list of sets, as in [{interval: 60}, {disc: 500}]");
    part = CPSI_POOL_TAKE(b->file.pool, node->count, CpsSet *);
    if (!part) return cpsi_law_no_memory(&b->file);
    CpsStatus status = CPS_OK;
    int count = 0;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next) {
        status = cpsi_law_build_set(b, item, &part[count]);
        if (status == CPS_OK) count++;
    }
    if (status == CPS_OK) status = CPSI_PLACED(b, node, operation(count, (const CpsSet *const *)part, out, &found));
    while (count > 0) cps_set_release(part[--count]);
    return status;
}

static CpsStatus build_product(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    return build_many(b, node, cps_set_product, out);
}

static CpsStatus build_intersection(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    return build_many(b, node, cps_set_intersection, out);
}

static CpsStatus build_sum(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    return build_many(b, node, cps_set_sum, out);
}

static CpsStatus build_hull(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    return build_many(b, node, cps_set_hull, out);
}

/* {map: matrix, of: set}: reads both */
static CpsStatus map_and_set(CpsiLawBuild *b, const CpsiYaml *node, const char *what, int *rows, int *columns,
                             double **map, CpsSet **set) {
    static const char *const KEY[] = {"map", "of", NULL};
    const CpsiYaml *child[2];
    CpsStatus status = cpsi_law_keys(&b->file, node, what, KEY, child);
    if (status == CPS_OK) status = cpsi_law_matrix(&b->file, child[0], "'map'", rows, columns, map);
    return status == CPS_OK ? cpsi_law_build_set(b, child[1], set) : status;
}

static CpsStatus build_preimage(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    int rows, columns;
    double *map;
    CpsSet *set = NULL;
    CpsStatus status = map_and_set(b, node, "'preimage'", &rows, &columns, &map, &set);
    if (status == CPS_OK) status = cpsi_law_check_map(b, node, rows, cps_set_space(set), "rows");
    if (status == CPS_OK) status = CPSI_PLACED(b, node, cps_set_preimage(columns, map, NULL, set, out, &found));
    cps_set_release(set);
    return status;
}

static CpsStatus build_image(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    int rows, columns;
    double *map;
    CpsSet *set = NULL;
    CpsStatus status = map_and_set(b, node, "'image'", &rows, &columns, &map, &set);
    if (status == CPS_OK) status = cpsi_law_check_map(b, node, columns, cps_set_space(set), "columns");
    if (status == CPS_OK) status = CPSI_PLACED(b, node, cps_set_image(rows, map, set, out, &found));
    cps_set_release(set);
    return status;
}

static CpsStatus build_translate(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    static const char *const KEY[] = {"by", "of", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    int n;
    double *shift;
    CpsSet *set = NULL;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'translate'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_vector(&b->file, child[0], "'by'", &n, &shift);
    if (status == CPS_OK) status = cpsi_law_build_set(b, child[1], &set);
    if (status == CPS_OK && n != cps_set_space(set)) {
        char expected[80];
        snprintf(expected, sizeof expected, "one number for each of the set's %d components", cps_set_space(set));
        status = cpsi_law_wrong(&b->file, child[0], "'by'", expected);
    }
    if (status == CPS_OK) status = CPSI_PLACED(b, node, cps_set_translate(shift, set, out, &found));
    cps_set_release(set);
    return status;
}

static CpsStatus build_scale(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    static const char *const KEY[] = {"by", "of", NULL};
    const CpsiYaml *child[2];
    CpsError found;
    double factor;
    CpsSet *set = NULL;
    CpsStatus status = cpsi_law_keys(&b->file, node, "'scale'", KEY, child);
    if (status == CPS_OK) status = cpsi_law_number(&b->file, child[0], "'by'", ANY, false, &factor);
    if (status == CPS_OK) status = cpsi_law_build_set(b, child[1], &set);
    if (status == CPS_OK) status = CPSI_PLACED(b, node, cps_set_scale(factor, set, out, &found));
    cps_set_release(set);
    return status;
}

static CpsStatus build_polar(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsError found;
    CpsSet *set = NULL;
    CpsStatus status = cpsi_law_build_set(b, node, &set);
    if (status == CPS_OK) status = CPSI_PLACED(b, node, cps_set_polar(set, out, &found));
    cps_set_release(set);
    return status;
}

/* coulomb, unit_load and contacts are laws; inside a set they stand for their set of forces */
static CpsStatus build_law_as_set(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsLaw *law = NULL;
    const CpsStatus status = cpsi_law_build_word(b, node, &law);
    if (status == CPS_OK) *out = cps_set_retain(cps_law_set(law));
    cps_law_destroy(law);
    return status;
}

/* ---- words ---- */

typedef struct Word {
    const char *name;
    CpsStatus (*build)(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out);
} Word;

static const Word WORDS[] = {
    {"point", build_point},
    {"interval", build_interval},
    {"disc", build_disc},
    {"ball", build_ball},
    {"ellipse", build_ellipse},
    {"ellipsoid", build_ellipsoid},
    {"box", build_box},
    {"segment", build_segment},
    {"polytope", build_polytope},
    {"strip", build_strip},
    {"half_space", build_half_space},
    {"inequalities", build_inequalities},
    {"subspace", build_subspace},
    {"product", build_product},
    {"intersection", build_intersection},
    {"sum", build_sum},
    {"hull", build_hull},
    {"preimage", build_preimage},
    {"image", build_image},
    {"translate", build_translate},
    {"scale", build_scale},
    {"polar", build_polar},
    {"coulomb", build_law_as_set},
    {"unit_load", build_law_as_set},
    {"contacts", build_law_as_set},
};
enum { WORD_COUNT = sizeof WORDS / sizeof WORDS[0] };

static CpsStatus unknown_word(const CpsiLawBuild *b, const CpsiYaml *node) {
    CpsiSuggestion suggestion = {.word = node->key};
    char list[400] = "";
    for (int i = 0; i < WORD_COUNT; i++) {
        cpsi_suggest(&suggestion, WORDS[i].name);
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", WORDS[i].name);
    }
    if (suggestion.best)
        return cpsi_fail_at(b->file.err, CPS_ERR_INPUT, b->file.name, node->line, node->column,
                            "unknown word '%.64s'; did you mean '%s'?", node->key, suggestion.best);
    return cpsi_fail_at(b->file.err, CPS_ERR_INPUT, b->file.name, node->line, node->column,
                        "unknown word '%.64s', expected one of: %s", node->key, list);
}

CpsStatus cpsi_law_build_set(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    if (node->kind != CPSI_YAML_MAPPING || node->count != 1)
        return cpsi_law_wrong(&b->file, node, node->key ? node->key : "set",
                              "one word with its value, as in {disc: 500}");
    for (int i = 0; i < WORD_COUNT; i++)
        if (strcmp(node->child->key, WORDS[i].name) == 0) return WORDS[i].build(b, node->child, out);
    return unknown_word(b, node->child);
}
