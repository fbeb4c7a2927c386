/* SPDX-License-Identifier: BSD-3-Clause */
/* What the scene has on the drums of winches, beside what the file says (compare.h). */
#include <math.h>

#include "compare.h"

/* [m] After a step; NaN: there is no winch at this end. */
static double stored_after(const Compare *compare, const CpsLine *line, int index, int end,
                           size_t step) {
    double stored = line->winch[end].stored;
    Part part;
    if (!line->winch[end].is_there) return NAN;
    if (!stage_of(compare, step, &part)) return stored;
    for (int s = 0; s <= part.stage; s++) {
        const CpsStage *at = &compare->scene->stage[s];
        for (int k = 0; k < at->pay_out_count; k++)
            if (at->pay_out[k].line == index && at->pay_out[k].end == end)
                stored -= at->pay_out[k].length * (s < part.stage ? 1 : part.to);
    }
    return stored;
}

void winches_compare(Compare *compare, const CpsLine *line, int index, size_t step,
                     const Record *r) {
    const bool any = line->winch[0].is_there || line->winch[1].is_there;
    if (any != (r->drums != NULL)) find(compare, "winches of %s", line->name);
    /* where there is no equilibrium the drums have turned on the way to it, or not */
    if (!any || !r->drums || r->outcome > 1) return;
    for (int end = 0; end < 2; end++) {
        const double wanted = stored_after(compare, line, index, end, step);
        if (isnan(wanted) == isnan(r->stored[end]) &&
            !(fabs(wanted - r->stored[end]) > COMPUTED * line->length))
            continue;
        find(compare, "stored of %s, end %c, step %zu, is %.17g m, in the scene %.17g m",
             line->name, end ? 'B' : 'A', step, r->stored[end], wanted);
    }
}
