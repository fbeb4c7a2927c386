/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes of set expressions: construction, reference count, and their text. */
#include "set/set.h"
#include "base/words.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const CpsiWords OUTCOME[] = {CPS_SET_OUTCOME_LIST(CPSI_WORDS_WITH_NAME)};

const char *cps_set_outcome_name(CpsSetOutcome outcome) {
    return CPSI_WORDS(OUTCOME, outcome).name;
}

const char *cps_set_outcome_text(CpsSetOutcome outcome) {
    return CPSI_WORDS(OUTCOME, outcome).text;
}

CpsStatus cpsi_set_new(CpsiSetKind kind, int n, int count, const CpsSet *const *parts,
                       size_t doubles, CpsSet **out, CpsError *err) {
    const size_t held = parts ? (size_t)count : 0;
    /* one block for the node, its parts and its numbers; sizes are bounded by CPS_SET_MAX_... */
    const size_t head = (sizeof(CpsSet) + held * sizeof(CpsSet *) + 15) / 16 * 16;
    CpsSet *set = doubles < (SIZE_MAX / 2 - head) / sizeof(double)
                      ? calloc(1, head + doubles * sizeof(double))
                      : NULL;
    if (!set) return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a set");
    atomic_init(&set->refcount, 1);
    set->kind = kind;
    set->n = n;
    set->count = count;
    set->a = (double *)(void *)((char *)set + head);
    if (parts) set->part = (CpsSet **)(void *)((char *)set + sizeof(CpsSet));
    for (size_t k = 0; k < held; k++) {
        set->part[k] = cps_set_retain(parts[k]);
        set->closure = set->closure || (parts[k]->closure && kind != CPSI_SET_POLAR);
    }
    *out = set;
    return CPS_OK;
}

CpsStatus cpsi_set_from_conic_form(CpsiConicForm *form, CpsSet **out, CpsError *err) {
    CpsSet *set = NULL;
    const CpsStatus status = cpsi_set_new(CPSI_SET_CONIC, form->n, 0, NULL, 0, &set, err);
    if (status) {
        cpsi_conic_form_free(form);
        return status;
    }
    set->form = form;
    *out = set;
    return CPS_OK;
}

CpsSet *cps_set_retain(const CpsSet *set) {
    CpsSet *held = (CpsSet *)(uintptr_t)set; /* a set is constant except for its reference count */
    if (held) atomic_fetch_add(&held->refcount, 1);
    return held;
}

void cps_set_release(CpsSet *set) {
    if (!set || atomic_fetch_sub(&set->refcount, 1) > 1) return;
    if (set->part)
        for (int k = 0; k < set->count; k++) cps_set_release(set->part[k]);
    cpsi_conic_form_free(set->form);
    cpsi_conic_form_free(set->dual);
    cpsi_hull_free(set->hull);
    free(set);
}

int cps_set_space(const CpsSet *set) { return set ? set->n : 0; }

CpsStatus cpsi_set_finite(const char *name, size_t count, const double *numbers, CpsError *err) {
    for (size_t i = 0; i < count; i++)
        if (!isfinite(numbers[i]))
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s[%zu] is %g, expected a finite number", name,
                             i, numbers[i]);
    return CPS_OK;
}

bool cpsi_set_has_user(const CpsSet *set) {
    if (set->kind == CPSI_SET_USER) return true;
    if (set->part)
        for (int k = 0; k < set->count; k++)
            if (cpsi_set_has_user(set->part[k])) return true;
    return false;
}

double *cpsi_scratch_take(CpsiScratch *scratch, size_t count) {
    const size_t few = sizeof scratch->few / sizeof *scratch->few;
    scratch->many = count > few ? malloc(count * sizeof(double)) : NULL;
    return count > few ? scratch->many : scratch->few;
}

void cpsi_scratch_give(CpsiScratch *scratch) { free(scratch->many); }

/* ---- a typical length ---- */

static double largest(size_t count, const double *numbers) {
    double most = 0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(numbers[i])) most = fmax(most, fabs(numbers[i]));
    return most;
}

/* largest coordinate of the data, 0 for sets without a length */
static double reach(const CpsSet *set) {
    const size_t n = (size_t)set->n, count = (size_t)set->count;
    double most = 0;
    switch (set->kind) {
    case CPSI_SET_POINTS: return largest(count * n, set->a);
    case CPSI_SET_BALL: return set->scalar + largest(n, set->a);
    case CPSI_SET_ELLIPSOID: return sqrt(largest(n * n, set->b)) + largest(n, set->a);
    case CPSI_SET_BOX: return fmax(largest(n, set->a), largest(n, set->b));
    case CPSI_SET_INEQUALITIES:
        for (size_t k = 0; k < count; k++)
            if (isfinite(set->b[k]))
                most = fmax(most, fabs(set->b[k]) / largest(n, &set->a[k * n]));
        return most;
    case CPSI_SET_CONIC: /* without offsets it is a cone, which has no size */
        if (largest((size_t)set->form->rows, set->form->b) > 0) most = set->form->size;
        return fmax(most, largest(n, set->form->origin));
    case CPSI_SET_SUBSPACE:
    case CPSI_SET_RAYS:
    case CPSI_SET_USER: return 0;
    case CPSI_SET_POLAR: most = reach(set->part[0]); return most > 0 ? 1 / most : 0;
    default: break;
    }
    for (size_t k = 0; k < count; k++) most = fmax(most, reach(set->part[k]));
    switch (set->kind) {
    case CPSI_SET_TRANSLATE: return most + largest(n, set->a);
    case CPSI_SET_SCALE: return most * fabs(set->scalar);
    case CPSI_SET_IMAGE: return most * largest(n * (size_t)set->part[0]->n, set->a);
    case CPSI_SET_PREIMAGE: {
        const double map = largest(n * (size_t)set->part[0]->n, set->a);
        return map > 0 ? (most + largest((size_t)set->part[0]->n, set->b)) / map : most;
    }
    default: return most;
    }
}

bool cpsi_set_is_cone(const CpsSet *set) { return reach(set) == 0; }

double cpsi_set_size(const CpsSet *set) {
    const double size = reach(set);
    return size > 0 && isfinite(size) ? size : 1;
}

/* ---- text ---- */

typedef struct ExpressionText {
    char *at;
    size_t size, length;
} ExpressionText;

__attribute__((format(printf, 2, 3))) static void put(ExpressionText *text, const char *format,
                                                      ...) {
    va_list args;
    va_start(args, format);
    const size_t left = text->length < text->size ? text->size - text->length : 0;
    const int wrote = vsnprintf(left ? text->at + text->length : NULL, left, format, args);
    va_end(args);
    if (wrote > 0) text->length += (size_t)wrote;
}

/* Of numbers, and of rows of them, this many are written; ".." stands for the others. */
enum { MOST_WRITTEN = 8 };

/* numbers separated by blanks */
static void write_numbers(ExpressionText *text, size_t count, const double *numbers) {
    for (size_t i = 0; i < count && i < MOST_WRITTEN; i++)
        put(text, "%s%.9g", i ? " " : "", numbers[i]);
    if (count > MOST_WRITTEN) put(text, " ..");
}

/* rows of n numbers separated by semicolons, each with its bound where there are bounds */
static void write_rows(ExpressionText *text, size_t n, size_t count, const double *numbers,
                       const double *bound) {
    for (size_t k = 0; k < count && k < MOST_WRITTEN; k++) {
        put(text, "%s", k ? "; " : "");
        write_numbers(text, n, &numbers[k * n]);
        if (bound) put(text, " <= %.9g", bound[k]);
    }
    if (count > MOST_WRITTEN) put(text, "; ..");
}

static void write_set(ExpressionText *text, const CpsSet *set) {
    static const char *const NAME[] = {[CPSI_SET_POINTS] = "points",
                                       [CPSI_SET_BALL] = "ball",
                                       [CPSI_SET_ELLIPSOID] = "ellipsoid",
                                       [CPSI_SET_BOX] = "box",
                                       [CPSI_SET_INEQUALITIES] = "inequalities",
                                       [CPSI_SET_SUBSPACE] = "subspace",
                                       [CPSI_SET_RAYS] = "rays",
                                       [CPSI_SET_USER] = "user",
                                       [CPSI_SET_CONIC] = "conic",
                                       [CPSI_SET_PRODUCT] = "product",
                                       [CPSI_SET_INTERSECTION] = "intersection",
                                       [CPSI_SET_PREIMAGE] = "preimage",
                                       [CPSI_SET_IMAGE] = "image",
                                       [CPSI_SET_SUM] = "sum",
                                       [CPSI_SET_TRANSLATE] = "translate",
                                       [CPSI_SET_SCALE] = "scale",
                                       [CPSI_SET_HULL] = "hull",
                                       [CPSI_SET_POLAR] = "polar"};
    const size_t n = (size_t)set->n, count = (size_t)set->count;
    const bool point = set->kind == CPSI_SET_POINTS && count == 1,
               half_space = set->kind == CPSI_SET_INEQUALITIES && count == 1;
    put(text, "%s(", point ? "point" : half_space ? "half_space" : NAME[set->kind]);
    switch (set->kind) {
    case CPSI_SET_BALL:
        write_numbers(text, n, set->a);
        put(text, "; r %.9g", set->scalar);
        break;
    case CPSI_SET_ELLIPSOID:
        write_numbers(text, n, set->a);
        put(text, "; ");
        write_numbers(text, n * n, set->b);
        break;
    case CPSI_SET_BOX:
        for (size_t i = 0; i < n && i < MOST_WRITTEN; i++)
            put(text, "%s%.9g .. %.9g", i ? ", " : "", set->a[i], set->b[i]);
        if (n > MOST_WRITTEN) put(text, ", ..");
        break;
    case CPSI_SET_POINTS:
    case CPSI_SET_RAYS:
    case CPSI_SET_SUBSPACE: write_rows(text, n, count, set->a, NULL); break;
    case CPSI_SET_INEQUALITIES: write_rows(text, n, count, set->a, set->b); break;
    case CPSI_SET_CONIC:
        put(text, "%zu; %d unknowns, %d cones", n, set->form->unknowns, set->form->cones);
        break;
    case CPSI_SET_SCALE: put(text, "%.9g, ", set->scalar); break;
    case CPSI_SET_TRANSLATE:
        write_numbers(text, n, set->a);
        put(text, ", ");
        break;
    case CPSI_SET_PREIMAGE:
    case CPSI_SET_IMAGE:
        write_numbers(text, n * (size_t)set->part[0]->n, set->a);
        put(text, ", ");
        break;
    default: break;
    }
    if (set->part)
        for (size_t k = 0; k < count; k++) {
            put(text, "%s", k ? ", " : "");
            write_set(text, set->part[k]);
        }
    put(text, ")");
}

size_t cps_set_text(const CpsSet *set, char *text, size_t size) {
    ExpressionText out = {text, text ? size : 0, 0};
    if (out.size) text[0] = 0;
    if (set) write_set(&out, set);
    return out.length;
}
