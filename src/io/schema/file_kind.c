/* SPDX-License-Identifier: BSD-3-Clause */
/* Recognition of the kind of a file by the keys that only one kind has (see file_kind.h). */
#include "io/schema/file_kind.h"

typedef struct Kind {
    const char *name, *commands;
    /* keys that only this kind has; every file of the kind has at least one of them */
    const char *key[8];
} Kind;

static const Kind KIND[] = {
    [CPSI_FILE_SCENE] = {"a scene", "'capstan run', 'check' and 'study' take", {"lines"}},
    [CPSI_FILE_LAW] = {"a law", "'capstan law' takes", {"law", "resistance"}},
    [CPSI_FILE_DRIVE] = {"a driven system",
                         "'capstan drive' takes",
                         {"system", "body", "vehicle", "planimeter", "rope", "sweep"}},
};
enum { KINDS = sizeof KIND / sizeof KIND[0] };

/* The first of the kind's keys that is given; NULL: none. */
static const CpsiYaml *own_key(const CpsiYaml *root, const Kind *kind) {
    const CpsiYaml *given = NULL;
    for (int i = 0; kind->key[i] && !given; i++) given = cpsi_yaml_child(root, kind->key[i]);
    return given;
}

CpsStatus cpsi_file_expect(const char *file, const CpsiYaml *root, CpsiFileKind expected,
                           CpsError *err) {
    if (own_key(root, &KIND[expected])) return CPS_OK;
    for (int k = 0; k < KINDS; k++) {
        const CpsiYaml *given = own_key(root, &KIND[k]);
        if (given)
            return cpsi_fail_at(err, CPS_ERR_INPUT, file, given->line, given->column,
                                "found %s ('%s'), which %s; expected %s", KIND[k].name, given->key,
                                KIND[k].commands, KIND[expected].name);
    }
    return CPS_OK;
}
