/* SPDX-License-Identifier: BSD-3-Clause */
/* Where ends are on the way of a load step (move.h). */
#include "evolve/move.h"

#include <math.h>

#include "cable/contact.h"

CpsEnd cpsi_move_between(const CpsEnd *from, const CpsEnd *to, double share) {
    CpsEnd at = *to;
    if (share < 1)
        for (int a = 0; a < 3; a++)
            at.value[a] = from->value[a] + share * (at.value[a] - from->value[a]);
    return at;
}

CpsiObstacle cpsi_move_obstacle(const CpsiLine *line, const CpsiMove *move, int k, double share) {
    CpsiObstacle obstacle = move->shift ? move->obstacle[k] : line->obstacle[k];
    if (!move->shift || !(share < 1)) return obstacle;
    const CpsiShift back = cpsi_shift_part(&move->shift[k], 1, share);
    cpsi_obstacle_shift(&obstacle, &back);
    return obstacle;
}

static double gap_at(const CpsiMove *move, const CpsiLine *line, int k, double share,
                     const double place[3]) {
    const CpsiObstacle obstacle = cpsi_move_obstacle(line, move, k, share);
    return cpsi_obstacle_gap(&obstacle, vec3_load(place));
}

/* Does an end that is held touch obstacle k before the move and after it? */
static bool rides(const CpsiLine *line, const CpsiMove *move, int k, int end) {
    const double near = CPSI_TOUCH * line->length;
    return move->from[end].kind == CPS_END_KIND_HELD &&
           fabs(gap_at(move, line, k, 1, move->to[end].value)) <= near &&
           fabs(gap_at(move, line, k, 0, move->from[end].value)) <= near;
}

CpsEnd cpsi_move_end(const CpsiLine *line, const CpsiMove *move, int end, double share) {
    CpsEnd to = move->to[end];
    const int obstacles = share > 0 && share < 1 ? line->obstacle_count : 0;
    for (int k = 0; k < obstacles; k++) {
        if (!rides(line, move, k, end)) continue;
        const CpsiShift none = {0}, *shift = move->shift ? &move->shift[k] : &none,
                        back = cpsi_shift_part(shift, 1, 0),
                        part = cpsi_shift_part(shift, 0, share);
        vec3_store(to.value, cpsi_shift_carry(&back, vec3_load(to.value)));
        to = cpsi_move_between(&move->from[end], &to, share);
        const CpsiObstacle obstacle = cpsi_move_obstacle(line, move, k, share);
        const Vec3 x = cpsi_shift_carry(&part, vec3_load(to.value));
        const double gap = cpsi_obstacle_gap(&obstacle, x),
                     out = gap < -CPSI_TOUCH * line->length ? -gap : 0;
        vec3_store(to.value, vec3_axpy(out, cpsi_obstacle_normal(&obstacle, x), x));
        return to;
    }
    return cpsi_move_between(&move->from[end], &to, share);
}
