/* SPDX-License-Identifier: BSD-3-Clause */
/* Random numbers of the tests: the same from a state on every machine. */
#ifndef CAPSTAN_TEST_SPLITMIX_H
#define CAPSTAN_TEST_SPLITMIX_H

#include <stdint.h>

/* The next number of the stream, between low and high. */
static inline double splitmix(uint64_t *state, double low, double high) {
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
    return low + (high - low) * ((double)(z >> 11) * 0x1p-53);
}

#endif
