/* SPDX-License-Identifier: BSD-3-Clause */
/* The errors of steps against those that the stages of a scene ask for. */
#include <math.h>
#include <stdlib.h>

#include "compare.h"
#include "failure.h"
#include "joint_motion.h"
#include "pace.h"

/* Steps of an entry with an error are no shorter than this share of the longest one, and have a
 * larger error only where they are no longer. */
static const double LEAST = 1e-4;

static void compare_step(Compare *compare, size_t step, double said, const StepError *own) {
    Part part;
    const bool staged = stage_of(compare, step, &part) && !is_break(&compare->source, step);
    const CpsStage *stage = staged ? &compare->scene->stage[part.stage] : NULL;
    const double asked = stage && stage->duration > 0 ? stage->error : 0,
                 shortest = stage ? LEAST * stage->duration / stage->step_count : 0,
                 length = step_length_of(&compare->source, step);
    if (!(asked > 0) && said != 0)
        find(compare, "step_error of step %zu is %.9g m, and no error is asked for", step, said);
    if (!(asked > 0)) return;
    if (!pace_agrees(said, own))
        find(compare, "step_error of step %zu is %.9g m, expected %.9g m", step, said, own->most);
    if (said > asked && length > (1 + 1e-9) * shortest)
        find(compare, "step_error of step %zu is %.9g m, and %.9g m is asked for", step, said,
             asked);
}

int compare_pace(Compare *compare) {
    const size_t steps = compare->source.steps;
    double *said = calloc(steps + 1, sizeof *said);
    StepError *own = calloc(steps + 1, sizeof *own);
    bool any = false;
    int bad = said && own ? pace_said(&compare->source, said, compare->log) : -1;
    for (int k = 0; k < compare->scene->stage_count; k++)
        any = any || compare->scene->stage[k].error > 0;
    if (!bad && any) bad = pace_errors(&compare->source, own, compare->log);
    if (!bad)
        for (size_t s = 0; s < steps; s++) compare_step(compare, s, said[s], &own[s]);
    free(said);
    free(own);
    return bad;
}
