/* SPDX-License-Identifier: BSD-3-Clause */
/* The check of names (names.h). */
#include "evolve/names.h"

#include <stdbool.h>
#include <string.h>

#include "base/status.h"

static bool name_is_valid(const char *name) {
    static const char LETTERS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    static const char OTHERS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-";
    return name && name[0] && strchr(LETTERS, name[0]) && strnlen(name, 65) <= 64 &&
           strspn(name, OTHERS) == strlen(name);
}

CpsStatus cpsi_name_check(const char *what, int index, const char *name, CpsError *err) {
    if (name_is_valid(name)) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "%s %d: its name is '%.80s', expected a letter followed by letters, digits, "
                     "'_' or '-', at most 64 in all",
                     what, index + 1, name ? name : "(none)");
}
