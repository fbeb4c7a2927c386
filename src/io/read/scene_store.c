/* SPDX-License-Identifier: BSD-3-Clause */
/* Values to the places that their rows name (see scene_store.h). */
#include "io/read/scene_store.h"

#include <string.h>

static bool store_text(const CpsiYaml *node, CpsiPool *pool, char *to) {
    const char *text = cpsi_pool_text(pool, node->text, strlen(node->text));
    memcpy(to, &text, sizeof text);
    return text != NULL;
}

static bool store_value(const CpsiKey *key, const CpsiYaml *node, CpsiPool *pool, char *to) {
    const int whole = (int)node->number;
    switch (key->type) {
    case CPSI_TEXT:
        return store_text(node, pool, to);
    case CPSI_INTEGER:
    case CPSI_WORD:
        memcpy(to, &whole, sizeof whole);
        return true;
    case CPSI_POINT:
        for (const CpsiYaml *x = node->child; x; x = x->next, to += sizeof x->number) memcpy(to, &x->number, sizeof x->number);
        return true;
    default:
        memcpy(to, &node->number, sizeof node->number);
        return true;
    }
}

bool cpsi_scene_store(CpsiObject object, const CpsiYaml *node, CpsiPool *pool, void *out) {
    bool good = true;
    for (const CpsiYaml *child = node ? node->child : NULL; child && good; child = child->next) {
        const CpsiKey *key = cpsi_key_find(object, child->key);
        if (!key || key->offset == CPSI_BY_HAND) continue;
        if (child->kind == CPSI_YAML_MAPPING)
            good = cpsi_scene_store((CpsiObject)key->inside, child, pool, out);
        else
            good = store_value(key, child, pool, (char *)out + key->offset);
    }
    return good;
}
