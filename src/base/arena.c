/* SPDX-License-Identifier: BSD-3-Clause */
/* One block of memory, measured and divided by the same function (see arena.h). */
#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { CACHE_LINE = 64 };

void *cpsi_arena_take(CpsiArena *arena, size_t count, size_t size) {
    size_t bytes = 0, end = 0;
    /* One more line of padding than necessary, so that equal arrays do not start at addresses that
     * share cache sets. */
    if (__builtin_mul_overflow(count, size, &bytes) ||
        __builtin_add_overflow(bytes, (size_t)(2 * CACHE_LINE - 1), &bytes) ||
        __builtin_add_overflow(arena->used, bytes / CACHE_LINE * CACHE_LINE, &end)) {
        arena->overflow = true;
        return NULL;
    }
    void *place = arena->base ? arena->base + arena->used : NULL;
    arena->used = end;
    return place;
}

bool cpsi_arena_allocate(CpsiArena *arena) {
    if (arena->overflow || arena->used > SIZE_MAX / 2) return false;
    /* One line more, aligned by hand, because the C library is slow to reuse blocks of
     * aligned_alloc. */
    const size_t bytes = arena->used + CACHE_LINE;
    arena->block = malloc(bytes);
    if (!arena->block) return false;
    memset(arena->block, 0, bytes); /* touch every page before the first step */
    const size_t over = (uintptr_t)arena->block % CACHE_LINE;
    arena->base = (char *)arena->block + (over > 0 ? CACHE_LINE - over : 0);
    arena->used = 0;
    return true;
}

void cpsi_arena_free(CpsiArena *arena) {
    free(arena->block);
    *arena = (CpsiArena){0};
}
