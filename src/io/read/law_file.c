/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a law file: bytes -> tree (yaml.h) -> sets and laws (set_build.h). The file is read as one more word,
 * whose values are kept. */
#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "capstan/law_io.h"
#include "io/base/read_file.h"
#include "io/schema/file_kind.h"
#include "io/read/set_build.h"

struct CpsLawFile {
    char title[CPSI_LAW_LONGEST_TITLE + 1];
    CpsLaw *law;
    CpsLoadedLaw *loaded;
    CpsResistance *resistance;
    bool has_preimage;
    CpsComposition composition;
    int composition_line;
};

void cps_law_file_destroy(CpsLawFile *file) {
    if (!file) return;
    cps_law_destroy(file->law);
    cps_loaded_law_destroy(file->loaded);
    cps_resistance_destroy(file->resistance);
    free(file);
}

const char *cps_law_file_title(const CpsLawFile *file) { return file ? file->title : ""; }

int cps_law_file_space(const CpsLawFile *file) {
    if (!file) return 0;
    return file->law ? cps_law_space(file->law) : cps_resistance_space(file->resistance);
}

const CpsSet *cps_law_file_set(const CpsLawFile *file) {
    if (!file) return NULL;
    if (file->loaded) return cps_loaded_law_set(file->loaded);
    return file->law ? cps_law_set(file->law) : NULL;
}

const CpsLoadedLaw *cps_law_file_loaded(const CpsLawFile *file) { return file ? file->loaded : NULL; }

const CpsResistance *cps_law_file_resistance(const CpsLawFile *file) { return file ? file->resistance : NULL; }

bool cps_law_file_composition(const CpsLawFile *file, CpsComposition *composition, int *line) {
    if (!file || !composition || !line) return false;
    *composition = file->composition;
    *line = file->composition_line;
    return file->has_preimage;
}

static CpsStatus take_load(const CpsiLawFile *f, const CpsiLawValue *load, CpsLawFile *out) {
    CpsError found;
    if (!load->node) return CPS_OK;
    if (!out->law)
        return cpsi_fail_at(f->err, CPS_ERR_INPUT, f->name, load->node->line, load->node->column,
                            "'load': goes with 'law'; a resistance law takes no load");
    if (cpsi_law_match(load, "load", load->columns, "numbers", cps_law_space(out->law), "the law has components",
                       &found) == CPS_OK &&
        cps_law_load(out->law, load->x, &out->loaded, &found) == CPS_OK)
        return CPS_OK;
    return cpsi_law_place(f, load->node, &found);
}

static CpsStatus take_resistance(const CpsiLawFile *f, const CpsiLawValue *terms, CpsLawFile *out) {
    CpsError found;
    if (cps_resistance_sum(terms->count, (const CpsResistance *const *)terms->term, &out->resistance, &found) == CPS_OK)
        return CPS_OK;
    return cpsi_law_place(f, terms->node, &found);
}

static CpsStatus build(CpsiLawBuild *b, const CpsiYaml *root, CpsLawFile *out) {
    CpsiLawValue value[CPSI_LAW_MOST_KEYS] = {{.node = NULL}};
    CpsiLawValue *law = &value[CPSI_LAW_OF_FRICTION], *terms = &value[CPSI_LAW_OF_RESISTANCE];
    CpsStatus status = cpsi_law_read_values(b, root, &cpsi_law_file_word, cpsi_law_file_word.name, value);
    if (status == CPS_OK && !law->node == !terms->node)
        status = cpsi_fail_at(b->file.err, CPS_ERR_INPUT, b->file.name, root->line, root->column,
                              "law file: %s, expected exactly one of 'law', 'resistance'",
                              law->node ? "too much given" : "nothing given");
    if (status == CPS_OK) {
        if (value[CPSI_LAW_TITLE].node) strcpy(out->title, value[CPSI_LAW_TITLE].text);
        if (law->node)
            out->law = law->law[0], law->law[0] = NULL;
        else
            status = take_resistance(&b->file, terms, out);
    }
    if (status == CPS_OK) status = take_load(&b->file, &value[CPSI_LAW_LOAD], out);
    cpsi_law_release(value);
    return status;
}

static CpsStatus read_law(const char *path, const CpsReadLimits *limits, CpsLawFile *out, CpsError *err) {
    const char *name = strcmp(path, "-") == 0 ? "standard input" : path;
    char *bytes = NULL;
    size_t size = 0;
    CpsiPool tree = {0};
    CpsiYaml *root = NULL;
    CpsStatus status = cpsi_read_file(path, name, limits->max_bytes, &bytes, &size, err);
    if (status == CPS_OK) status = cpsi_yaml_parse(name, "law", bytes, size, limits->max_depth, &tree, &root, err);
    free(bytes);
    if (status == CPS_OK) status = cpsi_file_expect(name, root, CPSI_FILE_LAW, err);
    CpsiLawBuild b = {.file = {.name = name, .pool = &tree, .err = err}};
    if (status == CPS_OK) status = build(&b, root, out);
    out->has_preimage = b.has_preimage;
    out->composition = b.composition;
    out->composition_line = b.composition_line;
    cpsi_pool_free(&tree);
    return status;
}

CpsStatus cps_law_read(const char *path, const CpsReadLimits *limits, CpsLawFile **out, CpsError *err) {
    if (!path || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "path or out is NULL");
    *out = NULL;
    const CpsReadLimits defaults = cps_read_limits_default();
    if (!limits) limits = &defaults;
    if (limits->max_depth < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "limits are not positive: start from cps_read_limits_default()");

    /* numbers have a decimal point whatever the program's locale */
    const locale_t numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    CpsLawFile *file = calloc(1, sizeof *file);
    if (!numbers || !file) {
        if (numbers) freelocale(numbers);
        free(file);
        return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    }
    const locale_t before = uselocale(numbers);
    const CpsStatus status = read_law(path, limits, file, err);
    uselocale(before);
    freelocale(numbers);
    if (status == CPS_OK)
        *out = file;
    else
        cps_law_file_destroy(file);
    return status;
}
