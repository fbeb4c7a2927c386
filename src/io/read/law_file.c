/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a law file: bytes -> tree (yaml.h) -> sets and laws (set_build.h). The file is read as one more word,
 * whose values are kept. */
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "capstan/law_io.h"
#include "io/read/document.h"
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

static CpsStatus read_load(const CpsiLawFile *f, const CpsiLawValue *load, CpsLawFile *out) {
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

static CpsStatus read_resistance(const CpsiLawFile *f, const CpsiLawValue *terms, CpsLawFile *out) {
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
            status = read_resistance(&b->file, terms, out);
    }
    if (status == CPS_OK) status = read_load(&b->file, &value[CPSI_LAW_LOAD], out);
    cpsi_law_release(value);
    return status;
}

static CpsStatus build_file(const CpsiDocument *d, void *out) {
    CpsLawFile *file = out;
    CpsiLawBuild b = {.file = {.name = d->name, .pool = d->pool, .err = d->err}};
    const CpsStatus status = build(&b, d->root, file);
    file->has_preimage = b.has_preimage;
    file->composition = b.composition;
    file->composition_line = b.composition_line;
    return status;
}

CpsStatus cps_law_read(const char *path, const CpsReadLimits *limits, CpsLawFile **out, CpsError *err) {
    if (!path || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "path or out is NULL");
    *out = NULL;
    CpsiPool tree = {0};
    CpsLawFile *file = calloc(1, sizeof *file);
    if (!file) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const CpsStatus status = cpsi_document_read(path, limits, CPSI_FILE_LAW, &tree, build_file, file, err);
    cpsi_pool_free(&tree);
    if (status == CPS_OK)
        *out = file;
    else
        cps_law_file_destroy(file);
    return status;
}
