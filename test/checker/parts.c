/* SPDX-License-Identifier: BSD-3-Clause */
/* Which step of a file is which of its scene (compare.h). */
#include <netcdf.h>
#include <stdlib.h>

#include "compare.h"
#include "failure.h"

/* How many steps a stage has, whose first one is `first` of the file without its breaks. Those of
 * a stage with an error end where its duration has passed; if the file ends before, there is one
 * more. */
static size_t steps_of(const Compare *compare, int stage, size_t first) {
    const CpsStage *at = &compare->scene->stage[stage];
    if (!(at->error > 0) || !compare->time) return (size_t)at->step_count;
    const double begin = first > 0 && first <= compare->source.steps ? compare->time[first - 1] : 0,
                 end = begin + at->duration * (1 - 1e-9);
    size_t count = 0;
    while (first + count < compare->source.steps && compare->time[first + count] < end) count++;
    return count + 1;
}

bool stage_of(const Compare *compare, size_t step, Part *part) {
    size_t first = compare->source.has_static;
    *part = (Part){.to = 1};
    for (size_t i = step + 1; i-- > 0;) step -= is_break(&compare->source, i);
    if (step < first) return false;
    for (int k = 0; k < compare->scene->stage_count; k++) {
        const CpsStage *at = &compare->scene->stage[k];
        const size_t steps = steps_of(compare, k, first);
        if (step >= first + steps) {
            first += steps;
            continue;
        }
        const double number = (double)(step - first + 1), all = at->step_count;
        *part =
            (Part){k, (int)number, (number - 1) / all, number / all, at->duration * number / all,
                   0};
        if (!(at->error > 0) || !compare->time) return true;
        const double begin = first > 0 ? compare->time[first - 1] : 0;
        const bool last = step + 1 == first + steps;
        part->from = number > 1 ? (compare->time[step - 1] - begin) / at->duration : 0;
        part->end = last ? at->duration : compare->time[step] - begin;
        part->to = last ? 1 : part->end / at->duration;
        /* times are sums of as many steps */
        part->noise = 1e-15 * number + 1e-15 * compare->time[step] / at->duration;
        return true;
    }
    return false;
}

size_t planned(const Compare *compare) {
    size_t steps = 0, breaks = 0;
    bool first = false;
    for (int i = 0; i < compare->scene->line_count; i++)
        first = first || compare->scene->line[i].start.kind == CPS_START_STATIC;
    for (int i = 0; i < compare->scene->stage_count; i++)
        steps += steps_of(compare, i, steps + first);
    for (size_t i = 0; i < compare->source.steps; i++) breaks += is_break(&compare->source, i);
    return (steps + first > 0 ? steps + first : 1) + breaks;
}

bool read_times(Compare *compare) {
    int id;
    if (nc_inq_varid(compare->source.nc, "time", &id) || compare->source.steps == 0) return true;
    compare->time = calloc(compare->source.steps, sizeof *compare->time);
    return compare->time && nc_get_var_double(compare->source.nc, id, compare->time) == NC_NOERR;
}
