/* SPDX-License-Identifier: BSD-3-Clause */
/* A pool: blocks of increasing size, each divided among successive requests. */
#include "io/base/yaml/pool.h"

#include <stdalign.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

typedef struct CpsiPoolBlock {
    struct CpsiPoolBlock *older;
    size_t used, size; /* bytes of data */
    alignas(max_align_t) char data[];
} CpsiPoolBlock;

enum { FIRST_BLOCK = 4096, LARGEST_BLOCK = 1 << 20 };

void *cpsi_pool_take(CpsiPool *pool, size_t count, size_t size) {
    const size_t align = alignof(max_align_t);
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX / 4) return NULL;
    bytes = (bytes + align - 1) / align * align;

    CpsiPoolBlock *block = pool->newest;
    if (!block || block->size - block->used < bytes) {
        size_t capacity = !block                            ? FIRST_BLOCK
                          : block->size < LARGEST_BLOCK / 2 ? 2 * block->size
                                                            : LARGEST_BLOCK;
        if (capacity < bytes) capacity = bytes;
        block = calloc(1, sizeof *block + capacity);
        if (!block) return NULL;
        *block = (CpsiPoolBlock){.older = pool->newest, .size = capacity};
        pool->newest = block;
    }
    void *place = block->data + block->used;
    block->used += bytes;
    return place;
}

char *cpsi_pool_text(CpsiPool *pool, const char *text, size_t n) {
    char *copy = n < SIZE_MAX ? cpsi_pool_take(pool, n + 1, 1) : NULL;
    if (copy) memcpy(copy, text, n);
    return copy;
}

void cpsi_pool_free(CpsiPool *pool) {
    while (pool->newest) {
        CpsiPoolBlock *older = pool->newest->older;
        free(pool->newest);
        pool->newest = older;
    }
}
