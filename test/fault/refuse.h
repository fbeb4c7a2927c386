/* SPDX-License-Identifier: BSD-3-Clause */
/* Allocations that fail when a test says so, and a count of the blocks held; by the linker's --wrap
 * of malloc, calloc, realloc, aligned_alloc and free, with REFUSE_TEXT of strdup and open_memstream
 * as well. For one file of a test program. */
#ifndef CAPSTAN_TEST_FAULT_REFUSE_H
#define CAPSTAN_TEST_FAULT_REFUSE_H

#include <stdlib.h>

static long allowed = -1,
            live; /* allocations until the one that fails (negative: none fails); blocks held */

static void *counted(void *block) {
    live += block != NULL;
    return block;
}
static int refuse(void) { return allowed >= 0 && allowed-- == 0; }

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
#include <stdio.h>

char *__real_strdup(const char *text);
FILE *__real_open_memstream(char **text, size_t *size);
FILE *__wrap_open_memstream(char **text, size_t *size);
char *__wrap_strdup(const char *text);

char *__wrap_strdup(const char *text) { return refuse() ? NULL : counted(__real_strdup(text)); }
/* the block is the text, which the caller frees */
FILE *__wrap_open_memstream(char **text, size_t *size) {
    return refuse() ? NULL : counted(__real_open_memstream(text, size));
}
#endif

#endif
