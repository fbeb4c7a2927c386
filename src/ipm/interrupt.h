/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether a solve is to be given up while it is under way. */
#ifndef CAPSTAN_SRC_IPM_INTERRUPT_H
#define CAPSTAN_SRC_IPM_INTERRUPT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct CpsiInterrupt {
    bool (*asked)(void *user); /* NULL: never given up */
    void *user;
    bool seen; /* asked() was true: from then on everything ends as soon as it can */
} CpsiInterrupt;

/* `interrupt` may be NULL. */
static inline bool cpsi_interrupt_look(CpsiInterrupt *interrupt) {
    if (!interrupt || !interrupt->asked) return false;
    if (!interrupt->seen) interrupt->seen = interrupt->asked(interrupt->user);
    return interrupt->seen;
}

static inline bool cpsi_interrupt_seen(const CpsiInterrupt *interrupt) {
    return interrupt && interrupt->seen;
}

#endif
