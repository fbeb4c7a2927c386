/* SPDX-License-Identifier: BSD-3-Clause */
/* Words and their values, read and made (see set_build.h): read_values and make_word call each other down the file. */
#include "io/read/set_build.h"

#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "io/schema/keys.h"

static CpsStatus build_law(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out);

CpsStatus cpsi_law_place(const CpsiLawFile *f, const CpsiYaml *node, const CpsError *found) {
    const CpsStatus status = found->status == CPS_ERR_ARGUMENT ? CPS_ERR_INPUT : found->status;
    const char *message = found->message;
    if (found->line > 0) return cpsi_fail_at(f->err, status, f->name, found->line, found->column, "%s", message);
    if (!node->key) return cpsi_fail_at(f->err, status, f->name, node->line, node->column, "%s", message);
    return cpsi_fail_at(f->err, status, f->name, node->line, node->column, "'%.64s': %s", node->key, message);
}

/* ---- sizes ---- */

/* Polytopes of more components have no closed forms (docs/sets.md). */
enum { MOST_CLOSED = 3 };

static bool is_open_polytope(const CpsiLawWord *word, int components) {
    return components > MOST_CLOSED && strcmp(word->name, "polytope") == 0;
}

/* A set just made of a word with `items` points or rows: not too large to be asked questions. solved: by a conic program. */
static CpsStatus weigh(CpsiLawBuild *b, const CpsiYaml *node, int components, int items, bool solved) {
    if (components > CPSI_LAW_MOST_COMPONENTS)
        return cpsi_fail_at(b->file.err, CPS_ERR_LIMIT, b->file.name, node->line, node->column,
                            "'%.64s': a set of %d components, at most %d", node->key, components,
                            (int)CPSI_LAW_MOST_COMPONENTS);
    if (solved && (b->solved_size += components + items) > CPSI_LAW_MOST_SOLVED)
        return cpsi_fail_at(b->file.err, CPS_ERR_LIMIT, b->file.name, node->line, node->column,
                            "'%.64s': the sets up to here that are not answered in closed form have %d components, "
                            "points and rows together, at most %d",
                            node->key, b->solved_size, (int)CPSI_LAW_MOST_SOLVED);
    return CPS_OK;
}

/* ---- words ---- */

static CpsStatus unknown_word(const CpsiLawFile *f, const CpsiYaml *node, const CpsiLawGroup *group, int groups,
                              const char *what) {
    CpsiSuggestion suggestion = {.word = node->key};
    char list[400] = "";
    for (int g = 0; g < groups; g++) {
        int count;
        const CpsiLawWord *word = cpsi_law_words(group[g], &count);
        for (int i = 0; i < count; i++) {
            if (g > 0 && cpsi_law_word(group[0], word[i].name)) continue;
            cpsi_suggest(&suggestion, word[i].name);
            const size_t used = strlen(list);
            snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", word[i].name);
        }
    }
    if (suggestion.best)
        return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column,
                            "unknown %s '%.64s'; did you mean '%s'?", what, node->key, suggestion.best);
    return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, node->line, node->column,
                        "unknown %s '%.64s', expected one of: %s", what, node->key, list);
}

/* {WORD: value}: read the values, make it of them */
static CpsStatus make_word(CpsiLawBuild *b, const CpsiYaml *node, const CpsiLawWord *word, CpsiLawMade *made) {
    char what[80];
    CpsError found = {.status = CPS_OK};
    CpsiLawValue value[CPSI_LAW_MOST_KEYS] = {{.node = NULL}};
    snprintf(what, sizeof what, "'%s'", word->name);
    b->solved_depth += word->solved;
    CpsStatus status = cpsi_law_read_values(b, node, word, what, value);
    if (status == CPS_OK && word->make(value, made, &found) != CPS_OK) status = cpsi_law_place(&b->file, node, &found);
    cpsi_law_release(value);
    const int components = made->set ? cps_set_space(made->set) : made->law ? cps_law_space(made->law) : 0;
    const bool solved = b->solved_depth > 0 || is_open_polytope(word, components);
    if (status == CPS_OK && components > 0) status = weigh(b, node, components, made->set ? value[0].rows : 0, solved);
    b->solved_depth -= word->solved;
    if (status == CPS_OK && made->composed && (!b->has_preimage || made->composition > b->composition)) {
        b->has_preimage = true;
        b->composition = made->composition, b->composition_line = node->line;
    }
    return status;
}

static CpsStatus not_one_word(const CpsiLawFile *f, const CpsiYaml *node, const char *what) {
    return cpsi_law_wrong(f, node, node->key ? node->key : what, "one word with its value, as in {disc: 500}");
}

static CpsStatus build_set(CpsiLawBuild *b, const CpsiYaml *node, CpsSet **out) {
    static const CpsiLawGroup GROUP[] = {CPSI_LAW_SET_WORDS, CPSI_LAW_LAW_WORDS};
    if (node->kind != CPSI_YAML_MAPPING || node->count != 1) return not_one_word(&b->file, node, "set");
    const CpsiLawWord *word = cpsi_law_word(GROUP[0], node->child->key);
    if (!word) word = cpsi_law_word(GROUP[1], node->child->key);
    if (!word) return unknown_word(&b->file, node->child, GROUP, 2, "word");
    /* coulomb, unit_load and contacts are laws; inside a set they stand for their set of forces */
    CpsiLawMade made = {.set = NULL};
    const CpsStatus status = make_word(b, node->child, word, &made);
    if (status == CPS_OK) *out = cps_set_retain(made.law ? cps_law_set(made.law) : made.set);
    cps_set_release(made.set);
    cps_law_destroy(made.law);
    return status;
}

static CpsStatus build_law(CpsiLawBuild *b, const CpsiYaml *node, CpsLaw **out) {
    const bool one = node->kind == CPSI_YAML_MAPPING && node->count == 1;
    const CpsiLawWord *word = one ? cpsi_law_word(CPSI_LAW_LAW_WORDS, node->child->key) : NULL;
    if (word) {
        CpsiLawMade made = {.set = NULL};
        const CpsStatus status = make_word(b, node->child, word, &made);
        if (status == CPS_OK)
            *out = made.law;
        else
            cps_law_destroy(made.law);
        return status;
    }

    /* every other word is a set, which must hold 0 */
    CpsError found;
    CpsSet *set = NULL;
    CpsStatus status = build_set(b, node, &set);
    if (status == CPS_OK && cps_law_friction(set, out, &found) != CPS_OK)
        status = cpsi_law_place(&b->file, node->child, &found);
    cps_set_release(set);
    return status;
}

static CpsStatus build_term(CpsiLawBuild *b, const CpsiYaml *node, CpsResistance **out) {
    static const CpsiLawGroup GROUP[] = {CPSI_LAW_TERM_WORDS};
    if (node->kind != CPSI_YAML_MAPPING || node->count != 1)
        return cpsi_law_wrong(&b->file, node, "term", "one of dry, viscous, power, table, as in {dry: {disc: 500}}");
    const CpsiLawWord *word = cpsi_law_word(GROUP[0], node->child->key);
    if (!word) return unknown_word(&b->file, node->child, GROUP, 1, "term");
    CpsiLawMade made = {.set = NULL};
    const CpsStatus status = make_word(b, node->child, word, &made);
    *out = made.term;
    return status;
}

/* one contact: its law and map join the list's */
static CpsStatus build_contact(CpsiLawBuild *b, const CpsiYaml *node, int i, CpsiLawValue *list) {
    CpsError found;
    CpsiLawValue part[CPSI_LAW_MOST_KEYS] = {{.node = NULL}};
    CpsStatus status = cpsi_law_read_values(b, node, &cpsi_law_contact_word, "contact", part);
    const CpsiLawValue *map = &part[CPSI_LAW_CONTACT_MAP];
    if (status == CPS_OK) {
        CpsLaw **law = part[CPSI_LAW_CONTACT_OF].law;
        list->law[i] = law[0], list->map[i] = map->x;
        law[0] = NULL;
        if (i == 0) list->columns = map->columns;
        if (cpsi_law_match(map, "map", map->rows, "rows", cps_law_space(list->law[i]), "its law has components",
                           &found) ||
            cpsi_law_match(map, "map", map->columns, "columns", list->columns, "the first contact's map has", &found))
            status = cpsi_law_place(&b->file, node, &found);
    }
    cpsi_law_release(part);
    return status;
}

/* ---- values ---- */

/* room for `count` sets, laws or terms, all NULL */
static CpsStatus read_parts(const CpsiLawFile *f, CpsiValue type, int count, CpsiLawValue *value) {
    bool room;
    switch (type) {
    case CPSI_SET:
    case CPSI_SETS:
        room = (value->set = CPSI_POOL_TAKE(f->pool, count, CpsSet *)) != NULL;
        break;
    case CPSI_TERMS:
        room = (value->term = CPSI_POOL_TAKE(f->pool, count, CpsResistance *)) != NULL;
        break;
    case CPSI_CONTACTS:
        value->map = CPSI_POOL_TAKE(f->pool, count, const double *);
        room = value->map && (value->law = CPSI_POOL_TAKE(f->pool, count, CpsLaw *));
        break;
    default:
        room = (value->law = CPSI_POOL_TAKE(f->pool, count, CpsLaw *)) != NULL;
    }
    if (room) value->count = count;
    return room ? CPS_OK : cpsi_law_no_memory(f);
}

static CpsStatus build_part(CpsiLawBuild *b, const CpsiYaml *node, CpsiValue type, int i, CpsiLawValue *value) {
    switch (type) {
    case CPSI_SET:
    case CPSI_SETS:
        return build_set(b, node, &value->set[i]);
    case CPSI_TERMS:
        return build_term(b, node, &value->term[i]);
    case CPSI_CONTACTS:
        return build_contact(b, node, i, value);
    default:
        return build_law(b, node, &value->law[i]);
    }
}

static CpsStatus read_value(CpsiLawBuild *b, const CpsiYaml *node, const CpsiKey *key, const char *what,
                            CpsiLawValue *value) {
    const CpsiValue type = key->type;
    value->node = node;
    if (type < CPSI_SET) return cpsi_law_value(&b->file, node, key, what, value);
    if (type == CPSI_SET || type == CPSI_LAW) {
        const CpsStatus status = read_parts(&b->file, type, 1, value);
        return status ? status : build_part(b, node, type, 0, value);
    }
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 1)
        return cpsi_law_wrong(&b->file, node, what,
                              type == CPSI_TERMS ? "a list of terms, as in [{dry: {disc: 500}}]"
                              : type == CPSI_CONTACTS
                                  ? "a list of contacts, as in [{map: [[1, 0]], of: {interval: 5}}]"
                              : type == CPSI_LAWS ? "a list of laws, as in [{interval: 60}, {disc: 500}]"
                                                      : "a list of sets, as in [{interval: 60}, {disc: 500}]");
    CpsStatus status = read_parts(&b->file, type, node->count, value);
    int i = 0;
    for (const CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next)
        status = build_part(b, item, type, i++, value);
    return status;
}

CpsStatus cpsi_law_read_values(CpsiLawBuild *b, const CpsiYaml *node, const CpsiLawWord *word, const char *what,
                               CpsiLawValue value[CPSI_LAW_MOST_KEYS]) {
    const CpsiKey *key = word->key;
    if (!key[0].name) return read_value(b, node, &key[0], what, &value[0]);
    const CpsiYaml *child[CPSI_LAW_MOST_KEYS] = {NULL};
    CpsStatus status = cpsi_law_keys(&b->file, node, what, key, cpsi_law_key_count(word), child);
    for (int i = 0; i < CPSI_LAW_MOST_KEYS && status == CPS_OK; i++) {
        char name[80];
        if (!child[i]) continue;
        snprintf(name, sizeof name, "'%s'", key[i].name);
        status = read_value(b, child[i], &key[i], name, &value[i]);
    }
    return status;
}

void cpsi_law_release(CpsiLawValue value[CPSI_LAW_MOST_KEYS]) {
    for (int k = 0; k < CPSI_LAW_MOST_KEYS; k++)
        for (int i = 0; i < value[k].count; i++) {
            if (value[k].set) cps_set_release(value[k].set[i]);
            if (value[k].law) cps_law_destroy(value[k].law[i]);
            if (value[k].term) cps_resistance_destroy(value[k].term[i]);
        }
}
