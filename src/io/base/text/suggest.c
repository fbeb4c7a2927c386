/* SPDX-License-Identifier: BSD-3-Clause */
/* The nearest of several words, for messages "did you mean ..?" (cps_suggest of capstan/io.h). */
#include <ctype.h>
#include <string.h>

#include "capstan/io.h"

/* Number of edits (insert, delete, replace a letter; capitals ignored) between two words of at most
 * 31 letters; else 32. */
static int edit_distance(const char *a, const char *b) {
    enum { MOST = 32 };
    const size_t na = strlen(a), nb = strlen(b);
    if (na >= MOST || nb >= MOST) return MOST;
    int row[MOST];
    for (size_t j = 0; j <= nb; j++) row[j] = (int)j;
    for (size_t i = 1; i <= na; i++) {
        int diagonal = row[0];
        row[0] = (int)i;
        for (size_t j = 1; j <= nb; j++) {
            const int above = row[j];
            const bool same = tolower((unsigned char)a[i - 1]) == tolower((unsigned char)b[j - 1]);
            int least = diagonal + (same ? 0 : 1);
            if (above + 1 < least) least = above + 1;
            if (row[j - 1] + 1 < least) least = row[j - 1] + 1;
            row[j] = least;
            diagonal = above;
        }
    }
    return row[nb];
}

void cps_suggest(CpsSuggestion *suggestion, const char *candidate) {
    if (!suggestion || !suggestion->word || !candidate) return;
    const size_t length = strlen(suggestion->word);
    const bool begins =
        length >= 2 && strncmp(suggestion->word, candidate, length) == 0 && candidate[length];
    const int distance = begins ? 1 : edit_distance(suggestion->word, candidate);
    const int allowed = ((int)strlen(candidate) + 2) / 3;
    if (distance <= allowed && (!suggestion->best || distance < suggestion->distance)) {
        suggestion->best = candidate;
        suggestion->distance = distance;
    }
}
