/* SPDX-License-Identifier: BSD-3-Clause */
/* Decimal points (see numbers.h). */
#include "io/base/text/numbers.h"

bool cpsi_numbers_begin(CpsiNumbers *numbers) {
    numbers->plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (numbers->plain) numbers->before = uselocale(numbers->plain);
    return numbers->plain;
}

void cpsi_numbers_end(CpsiNumbers *numbers) {
    uselocale(numbers->before);
    freelocale(numbers->plain);
}
