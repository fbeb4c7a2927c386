/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a law file: bytes -> tree (scene_yaml.h) -> sets and laws (law_build.h). */
#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "capstan/law_io.h"
#include "io/file_bytes.h"
#include "io/law_build.h"

struct CpsLawFile {
    char title[256];
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

const char *cps_law_file_title(const CpsLawFile *file) { return file->title; }

int cps_law_file_space(const CpsLawFile *file) {
    return file->law ? cps_law_space(file->law) : cps_resistance_space(file->resistance);
}

const CpsSet *cps_law_file_set(const CpsLawFile *file) {
    if (file->loaded) return cps_loaded_law_set(file->loaded);
    return file->law ? cps_law_set(file->law) : NULL;
}

const CpsLoadedLaw *cps_law_file_loaded(const CpsLawFile *file) { return file->loaded; }

const CpsResistance *cps_law_file_resistance(const CpsLawFile *file) { return file->resistance; }

bool cps_law_file_composition(const CpsLawFile *file, CpsComposition *composition, int *line) {
    *composition = file->composition;
    *line = file->composition_line;
    return file->has_preimage;
}

static CpsStatus take_title(const CpsiLawFile *f, const CpsiYaml *node, CpsLawFile *out) {
    if (!node) return CPS_OK;
    if (node->kind != CPSI_YAML_SCALAR || strlen(node->text) >= sizeof out->title)
        return cpsi_law_wrong(f, node, "'title'", "a text of at most 255 bytes");
    memcpy(out->title, node->text, strlen(node->text) + 1);
    return CPS_OK;
}

static CpsStatus take_load(CpsiLawBuild *b, const CpsiYaml *node, CpsLawFile *out) {
    int n;
    double *load;
    CpsError found;
    const CpsStatus status = cpsi_law_vector(&b->file, node, "'load'", &n, &load);
    if (status != CPS_OK) return status;
    if (n != cps_law_space(out->law))
        return cpsi_fail_at(b->file.err, CPS_ERR_INPUT, b->file.name, node->line, node->column,
                            "'load': found %d components, but the law has %d", n, cps_law_space(out->law));
    return cps_law_load(out->law, load, &out->loaded, &found) == CPS_OK ? CPS_OK : cpsi_law_place(b, node, &found);
}

static CpsStatus build(CpsiLawBuild *b, const CpsiYaml *root, CpsLawFile *out) {
    static const char *const KEY[] = {"capstan", "?title", "?law", "?load", "?resistance", NULL};
    enum { VERSION, TITLE, LAW, LOAD, RESISTANCE, KEYS };
    const CpsiYaml *child[KEYS];
    int version;
    CpsStatus status = cpsi_law_keys(&b->file, root, "law file", KEY, child);
    if (status == CPS_OK) status = cpsi_law_count(&b->file, child[VERSION], "'capstan'", 1, &version);
    if (status == CPS_OK) status = take_title(&b->file, child[TITLE], out);
    if (status != CPS_OK) return status;
    if (!child[LAW] == !child[RESISTANCE])
        return cpsi_fail_at(b->file.err, CPS_ERR_INPUT, b->file.name, root->line, root->column,
                            "law file: %s, expected exactly one of 'law', 'resistance'",
                            child[LAW] ? "too much given" : "nothing given");
    if (child[LOAD] && !child[LAW])
        return cpsi_fail_at(b->file.err, CPS_ERR_INPUT, b->file.name, child[LOAD]->line, child[LOAD]->column,
                            "'load': goes with 'law'; a resistance law takes no load");
    if (child[RESISTANCE]) return cpsi_law_build_resistance(b, child[RESISTANCE], &out->resistance);
    status = cpsi_law_build_law(b, child[LAW], &out->law);
    return status == CPS_OK && child[LOAD] ? take_load(b, child[LOAD], out) : status;
}

static CpsStatus read_law(const char *path, const CpsReadLimits *limits, CpsLawFile *out, CpsError *err) {
    const char *name = strcmp(path, "-") == 0 ? "standard input" : path;
    char *bytes = NULL;
    size_t size = 0;
    CpsiPool tree = {0};
    CpsiYaml *root = NULL;
    CpsStatus status = cpsi_read_file(path, name, limits->max_bytes, &bytes, &size, err);
    if (status == CPS_OK) status = cpsi_yaml_parse(name, bytes, size, limits->max_depth, &tree, &root, err);
    free(bytes);
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
