/* SPDX-License-Identifier: BSD-3-Clause */
/* A request to end a solution early. */
#ifndef CAPSTAN_SRC_IPM_INTERRUPT_H
#define CAPSTAN_SRC_IPM_INTERRUPT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct CpsiInterrupt {
    bool (*asked)(void *user); /* NULL: the solution is never interrupted */
    void *user;
    bool seen; /* whether asked() has returned true; everything then ends as soon as it can */
} CpsiInterrupt;

/* Ask, and return whether to end. `interrupt` may be NULL. */
static inline bool cpsi_interrupt_look(CpsiInterrupt *interrupt) {
    if (!interrupt || !interrupt->asked) return false;
    if (!interrupt->seen) interrupt->seen = interrupt->asked(interrupt->user);
    return interrupt->seen;
}

static inline bool cpsi_interrupt_seen(const CpsiInterrupt *interrupt) {
    return interrupt && interrupt->seen;
}

#endif
