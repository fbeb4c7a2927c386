/* SPDX-License-Identifier: BSD-3-Clause */
/* One block of memory, laid out twice by the same function: first without a block, to measure its
 * size, and then in the block. The two passes cannot disagree, and nothing is allocated
 * afterwards.
 *
 *     CpsiArena arena = {0};
 *     layout(&arena, ...);                       measures
 *     cpsi_arena_allocate(&arena);               one calloc, checked
 *     layout(&arena, ...);                       places */
#ifndef CAPSTAN_SRC_BASE_ARENA_H
#define CAPSTAN_SRC_BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>

typedef struct CpsiArena {
    char *base;    /* NULL while measuring; aligned, inside block */
    void *block;   /* as allocated */
    size_t used;   /* bytes taken so far */
    bool overflow; /* a size did not fit into size_t */
    int width;     /* of registers, as cpsi_width_once keeps it (width.h) */
} CpsiArena;

/* Memory for count items of `size` bytes, aligned to a cache line; NULL while measuring. */
void *cpsi_arena_take(CpsiArena *arena, size_t count, size_t size);

/* Turn a measuring arena into a real one, zeroed; false when memory or size_t does not suffice. */
bool cpsi_arena_allocate(CpsiArena *arena);
void cpsi_arena_free(CpsiArena *arena);

/* Arrays that are never in use at the same time may lie in the same memory. Place those of one use
 * from arena->used on, return to there, place those of the other, then join: what follows lies
 * behind both. */
static inline size_t cpsi_arena_return(CpsiArena *arena, size_t begin) {
    const size_t end = arena->used;
    arena->used = begin;
    return end;
}

static inline void cpsi_arena_join(CpsiArena *arena, size_t end) {
    if (arena->used < end) arena->used = end;
}

/* Place an array: from here on it points to `count` items of its type. */
#define CPSI_PLACE(arena, array, count) \
    ((array) = cpsi_arena_take((arena), (size_t)(count), sizeof *(array)))

#endif
