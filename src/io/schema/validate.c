/* SPDX-License-Identifier: BSD-3-Clause */
/* A parsed scene file against the table of keys. The recursion is as deep as the table, not as the file. */
#include "io/schema/validate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "io/schema/scene_keys.h"

typedef struct Valid {
    const char *file;
    const CpsiYaml *root;
    CpsError *err;
} Valid;

static CpsStatus check_value(const Valid *v, CpsiYaml *node, const CpsiKey *key, const char *name);

static CpsStatus wrong(const Valid *v, const CpsiYaml *node, const CpsiKey *key, const char *name, const char *hint) {
    char accepted[400], expected[460];
    snprintf(expected, sizeof expected, "%s%s", cpsi_key_expected(key, accepted, sizeof accepted), hint);
    return cpsi_key_wrong(v->file, node, name, expected, v->err);
}

/* ---- scalars ---- */

/* A scalar that is a finite number, or infinite where the key allows it. */
static CpsStatus check_number(const Valid *v, CpsiYaml *node, const CpsiKey *key, const char *name) {
    if (node->kind != CPSI_YAML_SCALAR || !node->plain) return wrong(v, node, key, name, "");
    if (!cpsi_yaml_number(node->text, &node->number)) {
        const bool unit = strspn(node->text, "+-.0123456789eE") > 0 && strpbrk(node->text, "0123456789");
        const bool comma = strchr(node->text, ',') != NULL;
        return wrong(v, node, key, name,
                     !unit   ? ""
                     : comma ? ": write a decimal point"
                             : ": write the number alone, without a unit");
    }
    const double x = node->number;
    const bool above = key->open ? x > key->low : x >= key->low;
    if (!above || !(x <= key->high)) return wrong(v, node, key, name, "");
    if (isinf(x) || fabs(x) <= 1e100) return CPS_OK;
    return wrong(v, node, key, name, ", at most 1e100");
}

static CpsStatus check_integer(const Valid *v, CpsiYaml *node, const CpsiKey *key, const char *name) {
    const CpsStatus status = check_number(v, node, key, name);
    if (status != CPS_OK) return status;
    return node->number == floor(node->number) ? CPS_OK : wrong(v, node, key, name, "");
}

static CpsStatus check_text(const Valid *v, const CpsiYaml *node, const CpsiKey *key, const char *name) {
    const bool empty = node->kind == CPSI_YAML_SCALAR && !node->text[0];
    return node->kind == CPSI_YAML_SCALAR && !empty ? CPS_OK : wrong(v, node, key, name, "");
}

/* Is the scalar one of the key's words? */
static bool take_word(CpsiYaml *node, const CpsiKey *key) {
    const int number = node->kind == CPSI_YAML_SCALAR ? cpsi_key_word(key, node->text) : -1;
    node->number = number;
    return number >= 0;
}

/* ---- lists ---- */

static CpsStatus check_vector(const Valid *v, CpsiYaml *node, const CpsiKey *key, const char *name) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count != 3) return wrong(v, node, key, name, "");
    CpsStatus status = CPS_OK;
    CpsiKey component = *key;
    component.type = CPSI_NUMBER;
    for (CpsiYaml *x = node->child; x && status == CPS_OK; x = x->next) status = check_number(v, x, &component, name);
    return status;
}

static CpsStatus check_points(const Valid *v, CpsiYaml *node, const CpsiKey *key, const char *name) {
    if (node->kind != CPSI_YAML_SEQUENCE || node->count < 2) return wrong(v, node, key, name, "");
    CpsStatus status = CPS_OK;
    CpsiKey point = *key;
    point.type = CPSI_POINT;
    for (CpsiYaml *x = node->child; x && status == CPS_OK; x = x->next) status = check_vector(v, x, &point, name);
    return status;
}

/* A count, or a list of lengths and of [count, length]. */
static CpsStatus check_elements(const Valid *v, CpsiYaml *node, const CpsiKey *key, const char *name) {
    CpsiKey count = *key, length = *key;
    count.type = CPSI_INTEGER, count.low = 1, count.open = false;
    length.type = CPSI_NUMBER, length.unit = "m";
    if (node->kind == CPSI_YAML_SCALAR) {
        double x;
        const bool number = node->plain && cpsi_yaml_number(node->text, &x);
        return number ? check_integer(v, node, &count, name) : wrong(v, node, key, name, "");
    }
    if (node->kind != CPSI_YAML_SEQUENCE || node->count == 0) return wrong(v, node, key, name, "");
    CpsStatus status = CPS_OK;
    for (CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next) {
        if (item->kind == CPSI_YAML_SCALAR) {
            status = check_number(v, item, &length, name);
        } else if (item->kind == CPSI_YAML_SEQUENCE && item->count == 2) {
            status = check_integer(v, item->child, &count, name);
            if (status == CPS_OK) status = check_number(v, item->child->next, &length, name);
        } else {
            status = wrong(v, item, key, name, "");
        }
    }
    return status;
}

/* ---- objects ---- */

/* LINE.END and OBSTACLE.turn: what stands before the last dot must be one of those under `where`, "lines" or
 * "obstacles". */
static CpsStatus check_owner(const Valid *v, const CpsiYaml *node, const char *where) {
    const CpsiYaml *all = cpsi_yaml_child(v->root, where);
    const char *dot = strrchr(node->key, '.');
    const size_t n = (size_t)(dot - node->key);
    char wanted[80] = ""; /* stays empty for what is too long for a name */
    if (n < sizeof wanted) memcpy(wanted, node->key, n);
    if (wanted[0] && cpsi_yaml_child(all, wanted)) return CPS_OK;
    CpsiSuggestion suggestion = {.word = wanted};
    for (const CpsiYaml *one = all ? all->child : NULL; one; one = one->next) cpsi_suggest(&suggestion, one->key);
    const int letters = (int)strlen(where) - 1; /* "line" of "lines" */
    if (suggestion.best)
        return cpsi_fail_at(v->err, CPS_ERR_INPUT, v->file, node->line, node->column,
                            "'%.80s': there is no such %.*s; did you mean '%.64s%s'?", node->key, letters, where,
                            suggestion.best, dot);
    return cpsi_fail_at(v->err, CPS_ERR_INPUT, v->file, node->line, node->column,
                        "'%.80s': there is no such %.*s under '%s'", node->key, letters, where, where);
}

/* Required keys, and exactly one of those of which one is needed. */
static CpsStatus check_needs(const Valid *v, const CpsiYaml *node, CpsiObject object, const char *name) {
    int count, alternatives = 0, given = 0;
    const CpsiKey *keys = cpsi_keys(object, &count);
    char list[200] = "";
    for (int i = 0; i < count; i++) {
        const bool present = cpsi_yaml_child(node, keys[i].name) != NULL;
        if (keys[i].need == CPSI_REQUIRED && !present)
            return cpsi_key_missing(v->file, node, name, &keys[i], v->err);
        if (keys[i].need != CPSI_ONE_OF) continue;
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s'%s'", alternatives ? ", " : "", keys[i].name);
        alternatives++;
        given += present;
    }
    if (alternatives == 0 || given == 1) return CPS_OK;
    return cpsi_fail_at(v->err, CPS_ERR_INPUT, v->file, node->line, node->column, "%s: %s, expected exactly one of %s",
                        name, given == 0 ? "nothing given" : "too much given", list);
}

/* A set stands for both coefficients and their shape. */
static CpsStatus check_friction(const Valid *v, const CpsiYaml *node) {
    const CpsiYaml *lateral = cpsi_yaml_child(node, "lateral"), *shape = cpsi_yaml_child(node, "shape"),
                   *extra = lateral ? lateral : shape;
    if (!extra || !cpsi_yaml_child(node, "set")) return CPS_OK;
    return cpsi_fail_at(v->err, CPS_ERR_INPUT, v->file, extra->line, extra->column,
                        "'%s': it goes with 'axial', not with 'set', which says everything", extra->key);
}

static CpsStatus check_object(const Valid *v, CpsiYaml *node, CpsiObject object, const char *name) {
    CpsStatus status = CPS_OK;
    for (CpsiYaml *child = node->child; child && status == CPS_OK; child = child->next) {
        const CpsiKey *key = cpsi_key_find(object, child->key);
        if (!key) {
            int count;
            const CpsiKey *keys = cpsi_keys(object, &count);
            return cpsi_key_unknown(v->file, child, name, keys, count, v->err);
        }
        char label[160];
        if (strcmp(key->name, "NAME") == 0) {
            snprintf(label, sizeof label, "%s '%.64s'", cpsi_object_name((CpsiObject)key->inside), child->key);
        } else {
            if (strcmp(key->name, "LINE.END") == 0) status = check_owner(v, child, "lines");
            if (strcmp(key->name, "OBSTACLE.turn") == 0) status = check_owner(v, child, "obstacles");
            snprintf(label, sizeof label, "'%.80s'", child->key);
        }
        if (status == CPS_OK) status = check_value(v, child, key, label);
    }
    if (status == CPS_OK) status = check_needs(v, node, object, name);
    return status == CPS_OK && object == CPSI_FRICTION ? check_friction(v, node) : status;
}

static CpsStatus check_list(const Valid *v, CpsiYaml *node, const CpsiKey *key, const char *name) {
    if (node->kind != CPSI_YAML_SEQUENCE) return wrong(v, node, key, name, "");
    CpsiKey item_key = {.type = CPSI_MAPPING, .inside = key->inside, .unit = ""};
    CpsStatus status = CPS_OK;
    for (CpsiYaml *item = node->child; item && status == CPS_OK; item = item->next)
        status = check_value(v, item, &item_key, cpsi_object_name((CpsiObject)key->inside));
    return status;
}

static CpsStatus check_value(const Valid *v, CpsiYaml *node, const CpsiKey *key, const char *name) {
    switch (key->type) {
    case CPSI_NUMBER:
        return check_number(v, node, key, name);
    case CPSI_INTEGER:
        return check_integer(v, node, key, name);
    case CPSI_TEXT:
        return check_text(v, node, key, name);
    case CPSI_WORD:
        return take_word(node, key) ? CPS_OK : wrong(v, node, key, name, "");
    case CPSI_POINT:
        return check_vector(v, node, key, name);
    case CPSI_POINTS:
        return check_points(v, node, key, name);
    case CPSI_ELEMENTS:
        return check_elements(v, node, key, name);
    case CPSI_LIST:
        return check_list(v, node, key, name);
    case CPSI_NUMBER_OR_MAPPING:
        return node->kind == CPSI_YAML_MAPPING ? check_object(v, node, (CpsiObject)key->inside, name)
                                               : check_number(v, node, key, name);
    case CPSI_SET:
        return CPS_OK; /* set_build.c reads it */
    case CPSI_MAPPING:
        if (node->kind == CPSI_YAML_MAPPING) return check_object(v, node, (CpsiObject)key->inside, name);
        return take_word(node, key) ? CPS_OK : wrong(v, node, key, name, "");
    default:
        return CPS_OK; /* not of scenes */
    }
}

CpsStatus cpsi_scene_validate(const char *file, CpsiYaml *root, CpsError *err) {
    const Valid v = {.file = file, .root = root, .err = err};
    const CpsiKey scene = {.type = CPSI_MAPPING, .inside = CPSI_SCENE, .unit = ""};
    return check_value(&v, root, &scene, "scene");
}
