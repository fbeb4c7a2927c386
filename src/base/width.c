/* SPDX-License-Identifier: BSD-3-Clause */
/* The width of the processor's registers (width.h). The compilers' own test of features would need
 * their run-time library beside libc and libm. */
#include "base/width.h"

#include <stdlib.h>

#ifdef CPSI_HAS_WIDTHS

/* What the processor says of itself, by page and part of it: a, b, c, d. */
static void ask(unsigned page, unsigned part, unsigned out[4]) {
    __asm__ volatile("cpuid"
                     : "=a"(out[0]), "=b"(out[1]), "=c"(out[2]), "=d"(out[3])
                     : "a"(page), "c"(part));
}

/* By the features that the wide files are compiled for (src/CMakeLists.txt), where the system keeps
 * such registers for a program, as XCR0 tells. What tells of XCR0 has the page of features beyond
 * too. A virtual machine may take 15 microseconds for each page. */
static CpsiWidth widest(void) {
    const unsigned tells = 1u << 27, avx2 = 1u << 5, avx512 = 1u << 16 | 1u << 17 | 1u << 31;
    const unsigned ymm = 0x6, zmm = 0xe6; /* of XCR0; zmm with the masks */
    unsigned features[4], extended[4], kept, high;
    ask(1, 0, features);
    if (!(features[2] & tells)) return CPSI_WIDTH_128;
    __asm__ volatile("xgetbv" : "=a"(kept), "=d"(high) : "c"(0));
    if ((kept & ymm) != ymm) return CPSI_WIDTH_128;
    ask(7, 0, extended);
    if ((kept & zmm) == zmm && (extended[1] & avx512) == avx512) return CPSI_WIDTH_512;
    return extended[1] & avx2 ? CPSI_WIDTH_256 : CPSI_WIDTH_128;
}
#else
static CpsiWidth widest(void) { return CPSI_WIDTH_128; }
#endif

CpsiWidth cpsi_width(void) {
    const CpsiWidth has = widest();
    const char *asked = getenv("CAPSTAN_WIDTH");
    const long bits = asked ? strtol(asked, NULL, 10) : 0;
    const CpsiWidth most = bits == 128   ? CPSI_WIDTH_128
                           : bits == 256 ? CPSI_WIDTH_256
                                         : CPSI_WIDTH_512;
    return most < has ? most : has;
}
