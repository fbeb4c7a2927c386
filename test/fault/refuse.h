/* SPDX-License-Identifier: BSD-3-Clause */
/* Allocations that fail when a test says so, and a count of the blocks held; by the linker's --wrap
 * of malloc, calloc, realloc, aligned_alloc and free, with REFUSE_TEXT of strdup, newlocale and
 * open_memstream as well. For one file of a test program. */
#ifndef CAPSTAN_TEST_FAULT_REFUSE_H
#define CAPSTAN_TEST_FAULT_REFUSE_H

#include <execinfo.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

static long allowed = -1,
            live; /* allocations until the one that fails (negative: none fails); blocks held */

/* While recording none fails; `first` are the first allocations asked for from each place. A place
 * is known by the functions that are being called there, the innermost ones. */
static bool recording;
enum { DEEPEST = 8, MOST_PLACES = 1 << 15 };
static long asked, places, first[MOST_PLACES];
static uint64_t seen[2 * MOST_PLACES]; /* hashes of places; 0: free */

static void *counted(void *block) {
    live += block != NULL;
    return block;
}
static void record(void) {
    void *caller[DEEPEST + 2];
    const int depth = backtrace(caller, DEEPEST + 2);
    uint64_t hash = 14695981039346656037u;
    for (int i = 2; i < depth; i++) hash = (hash ^ (uint64_t)(uintptr_t)caller[i]) * 1099511628211u;
    size_t at = hash % (2 * MOST_PLACES);
    while (seen[at] != 0 && seen[at] != hash) at = (at + 1) % (2 * MOST_PLACES);
    if (seen[at] == 0 && places < MOST_PLACES) first[places++] = asked;
    if (places < MOST_PLACES) seen[at] = hash;
    asked++;
}

/* Where it is set, it decides about each allocation instead of `allowed`. */
static bool (*is_refused)(void);

static __attribute__((noinline)) bool refuse(void) {
    if (recording) record();
    if (is_refused) return is_refused();
    return allowed >= 0 && allowed-- == 0;
}

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *block);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *block);

void *__wrap_malloc(size_t size) { return refuse() ? NULL : counted(__real_malloc(size)); }
void *__wrap_calloc(size_t count, size_t size) {
    return refuse() ? NULL : counted(__real_calloc(count, size));
}
void *__wrap_realloc(void *block, size_t size) {
    if (refuse()) return NULL;
    return block ? __real_realloc(block, size) : counted(__real_realloc(block, size));
}
void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return refuse() ? NULL : counted(__real_aligned_alloc(alignment, size));
}
void __wrap_free(void *block) {
    live -= block != NULL;
    __real_free(block);
}

#ifdef REFUSE_TEXT
#include <locale.h>
#include <stdio.h>

char *__real_strdup(const char *text);
locale_t __real_newlocale(int mask, const char *name, locale_t base);
locale_t __wrap_newlocale(int mask, const char *name, locale_t base);
FILE *__real_open_memstream(char **text, size_t *size);
FILE *__wrap_open_memstream(char **text, size_t *size);
char *__wrap_strdup(const char *text);

char *__wrap_strdup(const char *text) { return refuse() ? NULL : counted(__real_strdup(text)); }
locale_t __wrap_newlocale(int mask, const char *name, locale_t base) {
    return refuse() ? (locale_t)0 : __real_newlocale(mask, name, base);
}
/* the block is the text, which the caller frees */
FILE *__wrap_open_memstream(char **text, size_t *size) {
    return refuse() ? NULL : counted(__real_open_memstream(text, size));
}
#endif

#endif
