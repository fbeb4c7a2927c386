/* SPDX-License-Identifier: BSD-3-Clause */
/* The hash by which a saved state knows its scene: FNV-1a, 64 bits. */
#ifndef CAPSTAN_SRC_EVOLVE_HASH_H
#define CAPSTAN_SRC_EVOLVE_HASH_H

#include <stddef.h>
#include <stdint.h>

static const uint64_t HASH_START = 14695981039346656037u;

static inline void hash_bytes(uint64_t *hash, const void *data, size_t size) {
    const unsigned char *byte = data;
    for (size_t i = 0; i < size; i++) *hash = (*hash ^ byte[i]) * 1099511628211u;
}

static inline void hash_numbers(uint64_t *hash, size_t count, const double *number) {
    hash_bytes(hash, number, count * sizeof *number);
}

#endif
