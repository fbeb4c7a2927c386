/* SPDX-License-Identifier: BSD-3-Clause */
/* Words made from their values (see set_build.h). make_word and build_parts call each other
 * recursively. */
#include "io/read/law/set_build.h"

#include <math.h>
#include <stdio.h>

#include "base/status.h"
#include "io/read/key_reader.h"
#include "io/schema/tables/set_keys.h"

/* ---- sizes ---- */

/* The most components, points and rows of sets over which conic programs are solved, where one of
 * them has this many components. */
static int most_solved(int components) {
    return (int)cbrt((double)CPSI_LAW_MOST_WORK / components);
}

/* Check that a set just made from a word with `items` points or rows is not too large for
 * queries.
 *   solved  by a conic program */
static CpsStatus weigh(CpsiSetBuild *b, const CpsiYaml *node, int components, int items,
                       bool solved) {
    if (components > CPSI_LAW_MOST_COMPONENTS)
        return cpsi_document_fail(b->d, CPS_ERR_LIMIT, node,
                                  "'%.64s': a set of %d components, at most %d", node->key,
                                  components, (int)CPSI_LAW_MOST_COMPONENTS);
    if (!solved) return CPS_OK;
    b->solved_size += components + items;
    if (components > b->solved_components) b->solved_components = components;
    const int most = most_solved(b->solved_components);
    if (b->solved_size > most)
        return cpsi_document_fail(
            b->d, CPS_ERR_LIMIT, node,
            "'%.64s': the sets up to here that are not answered in closed form have %d components, "
            "points and rows together, at most %d with sets of %d components",
            node->key, b->solved_size, most, b->solved_components);
    return CPS_OK;
}

/* Number of points or rows of a word, as they are written: no word makes more of its own. */
static int items_of(const CpsiKey *word, const CpsiSetValues *values) {
    if (word->type == CPSI_EXPRESSION || word->type == CPSI_EXPRESSIONS) return 0;
    return values->rows.rows > 0 ? values->rows.rows : 1;
}

/* ---- parts ---- */

static CpsStatus read_laws(const CpsiSetBuild *b, int count, CpsiSetValues *v) {
    v->law = CPSI_POOL_TAKE(b->d->pool, count, CpsLaw *);
    v->map = CPSI_POOL_TAKE(b->d->pool, count, const double *);
    if (!v->law || !v->map) return cpsi_document_no_memory(b->d);
    v->count = count;
    return CPS_OK;
}

/* The first expression of a list, or a single one, and their number. */
static const CpsiYaml *expressions(const CpsiYaml *node, int *count) {
    const bool list = node->kind == CPSI_YAML_SEQUENCE;
    *count = list ? node->count : 1;
    return list ? node->child : node;
}

static CpsStatus build_sets(CpsiSetBuild *b, CpsiSetValues *v) {
    int count;
    const CpsiYaml *part = expressions(v->sets, &count);
    v->set = CPSI_POOL_TAKE(b->d->pool, count, CpsSet *);
    if (!v->set) return cpsi_document_no_memory(b->d);
    v->count = count;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < count && status == CPS_OK; i++, part = part->next)
        status = cpsi_build_set(b, part, &v->set[i]);
    return status;
}

static CpsStatus build_laws(CpsiSetBuild *b, CpsiSetValues *v) {
    int count;
    const CpsiYaml *part = expressions(v->laws, &count);
    CpsStatus status = read_laws(b, count, v);
    for (int i = 0; i < count && status == CPS_OK; i++, part = part->next)
        status = cpsi_build_law(b, part, &v->law[i]);
    return status;
}

static CpsStatus build_contacts(CpsiSetBuild *b, CpsiSetValues *v) {
    const CpsiContactValues *contact = v->contacts.item;
    CpsError found = {.status = CPS_OK};
    CpsStatus status = read_laws(b, v->contacts.count, v);
    v->columns = contact->map.columns;
    for (int i = 0; i < v->count && status == CPS_OK; i++, contact++) {
        const CpsiNumberRows *map = &contact->map;
        v->map[i] = map->x;
        status = cpsi_build_law(b, contact->of, &v->law[i]);
        if (status != CPS_OK) return status;
        if (cpsi_set_match(map, "map", map->rows, "rows", cps_law_space(v->law[i]),
                           "its law has components", &found) ||
            cpsi_set_match(map, "map", map->columns, "columns", v->columns,
                           "the first contact's map has", &found))
            status = cpsi_document_place(b->d, contact->node, &found);
    }
    return status;
}

static CpsStatus build_parts(CpsiSetBuild *b, CpsiSetValues *v) {
    if (v->sets) return build_sets(b, v);
    if (v->laws) return build_laws(b, v);
    return v->contacts.node ? build_contacts(b, v) : CPS_OK;
}

static void release_parts(const CpsiSetValues *v) {
    for (int i = 0; i < v->count; i++) {
        if (v->set) cps_set_release(v->set[i]);
        if (v->law) cps_law_release(v->law[i]);
    }
}

/* ---- words ---- */

/* {WORD: value}: read the values, make the object */
static CpsStatus make_word(CpsiSetBuild *b, const CpsiYaml *node, const CpsiKey *word,
                           CpsiSetMade *made) {
    char what[80];
    CpsError found = {.status = CPS_OK};
    CpsiSetValues values = {.count = 0};
    snprintf(what, sizeof what, "'%s'", word->name);
    b->solved_depth += word->solved;
    CpsStatus status = cpsi_read_value(b->d, node, word, what, &values);
    if (status == CPS_OK) status = build_parts(b, &values);
    if (status == CPS_OK && word->make(&values, made, &found) != CPS_OK)
        status = cpsi_document_place(b->d, node, &found);
    release_parts(&values);
    const int components = made->set   ? cps_set_space(made->set)
                           : made->law ? cps_law_space(made->law)
                                       : 0;
    const bool solved = b->solved_depth > 0 || (word->closed > 0 && components > word->closed);
    if (status == CPS_OK && components > 0)
        status = weigh(b, node, components, made->set ? items_of(word, &values) : 0, solved);
    b->solved_depth -= word->solved;
    if (status == CPS_OK && made->composed &&
        (!b->has_preimage || made->composition > b->composition)) {
        b->has_preimage = true;
        b->composition = made->composition;
        b->composition_line = node->line;
    }
    return status;
}

/* The word is searched for in `first`, and then among those of sets; NULL: only there. */
static CpsStatus make_expression(CpsiSetBuild *b, const CpsiYaml *node, const CpsiMapping *first,
                                 CpsiSetMade *made) {
    const CpsiYaml *value = node->child;
    const CpsiKey *word = first ? cpsi_key_find(first, value->key) : NULL;
    if (!word) word = cpsi_key_find(&cpsi_set_words, value->key);
    if (!word) return cpsi_key_unknown(b->d->name, value, "", &cpsi_set_words, b->d->err);
    return make_word(b, value, word, made);
}

static void release_made(const CpsiSetMade *made) {
    cps_set_release(made->set);
    cps_law_release(made->law);
}

CpsStatus cpsi_build_set(CpsiSetBuild *b, const CpsiYaml *node, CpsSet **out) {
    CpsiSetMade made = {.set = NULL};
    const CpsStatus status = make_expression(b, node, NULL, &made);
    if (status == CPS_OK) *out = cps_set_retain(made.law ? cps_law_set(made.law) : made.set);
    release_made(&made);
    return status;
}

CpsStatus cpsi_build_law(CpsiSetBuild *b, const CpsiYaml *node, CpsLaw **out) {
    CpsError found;
    CpsiSetMade made = {.set = NULL};
    CpsStatus status = make_expression(b, node, &cpsi_law_words, &made);
    if (status == CPS_OK && made.law) {
        *out = made.law;
        made.law = NULL;
    } else if (status == CPS_OK && cps_law_friction(made.set, out, &found) != CPS_OK) {
        status = cpsi_document_place(b->d, node->child, &found);
    }
    release_made(&made);
    return status;
}

static CpsStatus build_term(CpsiSetBuild *b, const CpsiYaml *node, CpsResistance **out) {
    const CpsiKey *word = cpsi_key_find(&cpsi_term_words, node->key);
    CpsiSetMade made = {.set = NULL};
    if (!word) return cpsi_key_unknown(b->d->name, node, "", &cpsi_term_words, b->d->err);
    const CpsStatus status = make_word(b, node, word, &made);
    *out = made.term;
    return status;
}

CpsStatus cpsi_build_resistance(CpsiSetBuild *b, const CpsiYaml *list, CpsResistance **out) {
    CpsError found;
    CpsResistance **term = CPSI_POOL_TAKE(b->d->pool, list->count, CpsResistance *);
    if (!term) return cpsi_document_no_memory(b->d);
    CpsStatus status = CPS_OK;
    int count = 0;
    for (const CpsiYaml *item = list->child; item && status == CPS_OK; item = item->next)
        status = build_term(b, item->child, &term[count++]);
    if (status == CPS_OK &&
        cps_resistance_sum(count, (const CpsResistance *const *)term, out, &found) != CPS_OK)
        status = cpsi_document_place(b->d, list, &found);
    for (int i = 0; i < count; i++) cps_resistance_release(term[i]);
    return status;
}
