/* SPDX-License-Identifier: BSD-3-Clause */
/* Acceleration of the rounds of a group (point_rounds.h). Without it a net that slides over a ball
 * takes hundreds of rounds, each of which turns the axes by three hundredths less. */
#include "evolve/point_rounds.h"

#include <string.h>

#include "cable/obstacle_side.h"
#include "evolve/newton_step.h"

/* Below this angle [rad] the error after a round is linear in the error before it. */
static const double LINEAR = 0.1;

/* Write where the points and the inner nodes of the lines are, each with its reaction as weight;
 * returns how many there are. Ends of lines are where their points are, or held. */
static int gather(CpsiBalance *balance) {
    CpsiPointRounds *rounds = &balance->rounds;
    int count = 0;
    for (int k = 0; k < balance->count; k++) {
        vec3_store(&rounds->place[3 * count], balance->at[k].place);
        rounds->weight[count++] = balance->guess.state[k] != CPSI_JOINT_OFF;
    }
    for (int item = 0; item < balance->line_count; item++) {
        const CpsiLine *line = &balance->evolution->line[balance->line[item]];
        for (int j = 1; j + 1 < line->n; j++) {
            memcpy(&rounds->place[3 * count], &line->base[3 * j], 3 * sizeof *line->base);
            double weight = 0;
            for (int c = j; c < cpsi_line_contacts(line); c += line->n) weight += line->reaction[c];
            if (line->element_contacts > 0)
                for (int e = j - 1; e <= j; e++)
                    weight += line->reaction[cpsi_line_contacts(line) + e];
            rounds->weight[count++] = weight > 0;
        }
    }
    return count;
}

/* Move points and nodes to the places of the rounds: points out of obstacles, and no line across
 * one. */
static void scatter(CpsiBalance *balance) {
    const double *place = balance->rounds.place;
    for (int k = 0; k < balance->count; k++, place += 3) {
        CpsiFree *at = &balance->at[k];
        const CpsiFree from = {.place = at->place, .obstacle = CPS_NO_OBSTACLE};
        double move[3];
        vec3_store(move, vec3_sub(vec3_load(place), at->place));
        at->place = cpsi_place_after(balance, &from, move, 1);
    }
    for (int item = 0; item < balance->line_count; item++) {
        CpsiLine *line = &balance->evolution->line[balance->line[item]];
        const size_t inner = 3 * (size_t)(line->n - 2);
        memcpy(&line->base[3], place, inner * sizeof *place);
        place += inner;
        if (cpsi_obstacle_side_share(line, line->position, line->base, 1) < 1)
            memcpy(line->base, line->position, 3 * (size_t)line->n * sizeof *line->base);
    }
}

void cpsi_point_rounds_accelerate(CpsiBalance *balance, double turned) {
    CpsiPointRounds *rounds = &balance->rounds;
    const int count = gather(balance);
    if (!(turned <= LINEAR)) {
        cpsi_anderson_start(&rounds->anderson, count, rounds->place);
        return;
    }
    cpsi_anderson_accelerate(&rounds->anderson, count, rounds->weight, rounds->place);
    scatter(balance);
}
