/* SPDX-License-Identifier: BSD-3-Clause */
/* Read a law file: bytes -> tree (yaml.h) -> values (key_reader.h) -> sets and laws (set_build.h).
 */
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "capstan/io.h"
#include "io/read/document.h"
#include "io/read/key_reader.h"
#include "io/read/law/set_build.h"
#include "io/schema/tables/set_keys.h"

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
    cps_law_release(file->law);
    cps_loaded_law_release(file->loaded);
    cps_resistance_release(file->resistance);
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

const CpsLoadedLaw *cps_law_file_loaded(const CpsLawFile *file) {
    return file ? file->loaded : NULL;
}

const CpsResistance *cps_law_file_resistance(const CpsLawFile *file) {
    return file ? file->resistance : NULL;
}

bool cps_law_file_composition(const CpsLawFile *file, CpsComposition *composition, int *line) {
    if (!file || !composition || !line) return false;
    *composition = file->composition;
    *line = file->composition_line;
    return file->has_preimage;
}

static CpsStatus read_load(const CpsiDocument *d, const CpsiNumberRows *load, CpsLawFile *out) {
    CpsError found;
    if (cpsi_set_match(load, "load", load->columns, "numbers", cps_law_space(out->law),
                       "the law has components", &found) == CPS_OK &&
        cps_law_load(out->law, load->x, &out->loaded, &found) == CPS_OK)
        return CPS_OK;
    return cpsi_document_place(d, load->node, &found);
}

static CpsStatus build(const CpsiDocument *d, void *out) {
    CpsLawFile *file = out;
    CpsiSetBuild b = {.d = d};
    CpsiLawFileValues values = {.node = NULL};
    CpsStatus status = cpsi_read_mapping(d, d->root, &cpsi_law_file, cpsi_law_file.name, &values);
    if (status != CPS_OK) return status;
    if (values.title) strcpy(file->title, values.title);
    if (values.law)
        status = cpsi_build_law(&b, values.law, &file->law);
    else
        status = cpsi_build_resistance(&b, values.resistance, &file->resistance);
    if (status == CPS_OK && values.load.node) status = read_load(d, &values.load, file);
    file->has_preimage = b.has_preimage;
    file->composition = b.composition;
    file->composition_line = b.composition_line;
    return status;
}

/* from the file at `path`, or from `text` */
static CpsStatus read_law(const char *path, const char *text, const CpsReadLimits *limits,
                          CpsLawFile **out, CpsError *err) {
    *out = NULL;
    CpsiPool tree = {0};
    CpsLawFile *file = calloc(1, sizeof *file);
    if (!file) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    const CpsStatus status =
        cpsi_document_read(path, text, limits, CPSI_FILE_LAW, &tree, build, file, err);
    cpsi_pool_free(&tree);
    if (status == CPS_OK)
        *out = file;
    else
        cps_law_file_destroy(file);
    return status;
}

CpsStatus cps_law_read(const char *path, const CpsReadLimits *limits, CpsLawFile **out,
                       CpsError *err) {
    if (!path || !out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "path or out is NULL");
    return read_law(path, NULL, limits, out, err);
}

CpsStatus cps_law_read_text(const char *text, const char *name, const CpsReadLimits *limits,
                            CpsLawFile **out, CpsError *err) {
    if (!text || !name || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "text, name or out is NULL");
    return read_law(name, text, limits, out, err);
}
