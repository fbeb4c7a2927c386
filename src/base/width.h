/* SPDX-License-Identifier: BSD-3-Clause */
/* Files with loops over lanes (base/lanes.h) are compiled several times, for registers of 128, 256
 * and 512 bits, with CPSI_WIDTH defined as that number. Which of these is used is decided when a
 * program is laid out. The results are the same bits. */
#ifndef CAPSTAN_SRC_BASE_WIDTH_H
#define CAPSTAN_SRC_BASE_WIDTH_H

#ifndef CPSI_WIDTH
#define CPSI_WIDTH 128
#endif

/* The name of a function or table in the compilation for this width. */
#define CPSI_WIDE(name)               CPSI_WIDE_JOIN(name, CPSI_WIDTH)
#define CPSI_WIDE_JOIN(name, width)   CPSI_WIDE_JOINED(name, width)
#define CPSI_WIDE_JOINED(name, width) name##_##width

typedef enum CpsiWidth { CPSI_WIDTH_128, CPSI_WIDTH_256, CPSI_WIDTH_512 } CpsiWidth;
enum { CPSI_WIDTHS = 3 };

/* The widest of this processor, or less if the environment variable CAPSTAN_WIDTH says 128 or 256
 * [bits]. A virtual machine may take 50 microseconds for that. */
CpsiWidth cpsi_width(void);

/* The same, asked once: *known is 0 before and then tells it. */
static inline CpsiWidth cpsi_width_once(int *known) {
    if (*known == 0) *known = 1 + (int)cpsi_width();
    return (CpsiWidth)(*known - 1);
}

#endif
