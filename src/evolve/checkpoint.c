/* SPDX-License-Identifier: BSD-3-Clause */
/* The state of an evolution as bytes: everything that steps change and that later steps or the views read.
 *
 * One walk over the state serves to measure, to save and to load. Numbers are copied as they are, so that a run that goes on from a
 * saved state gives the same bits as one that was never interrupted; a state is for the same program on the same kind of machine. */
#include "evolve/checkpoint.h"

#include <string.h>

#include "base/status.h"

/* What a state begins with. */
typedef struct Head {
    char magic[8];
    uint64_t size, fingerprint;
} Head;

static const char MAGIC[8] = "capstan2";

/* Bytes on their way out, in, or only counted. */
typedef struct Tape {
    unsigned char *out;
    const unsigned char *in;
    size_t at;
} Tape;

static void pass(Tape *tape, void *data, size_t size) {
    if (tape->out) memcpy(tape->out + tape->at, data, size);
    if (tape->in) memcpy(data, tape->in + tape->at, size);
    tape->at += size;
}

static void pass_line(Tape *tape, CpsiLine *line) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    double *const nodes[] = {line->reference, line->position, line->load};
    double *const vectors[] = {line->normal, line->friction_force, line->slide};
    double *const scalars[] = {line->gap, line->friction_bound, line->reaction};
    for (size_t i = 0; i < sizeof nodes/sizeof *nodes; i++) pass(tape, nodes[i], 3*n*sizeof(double));
    for (size_t i = 0; i < sizeof vectors/sizeof *vectors; i++)
        if (vectors[i]) pass(tape, vectors[i], 3*contacts*sizeof(double));
    for (size_t i = 0; i < sizeof scalars/sizeof *scalars; i++) pass(tape, scalars[i], contacts*sizeof(double));
    pass(tape, line->segment_force, 3*(n - 1)*sizeof(double));
    pass(tape, line->tension, (n - 1)*sizeof(double));
    pass(tape, line->state, contacts*sizeof *line->state);
    if (line->on) pass(tape, line->on, contacts*sizeof *line->on);
    if (line->beta) pass(tape, line->beta, n*sizeof *line->beta);
    pass(tape, line->end, sizeof line->end);
    pass(tape, &line->report, sizeof line->report);
}

static size_t pass_state(Tape *tape, CpsEvolution *evolution) {
    tape->at = sizeof(Head);
    pass(tape, &evolution->report, sizeof evolution->report);
    pass(tape, evolution->step_name, sizeof evolution->step_name);
    pass(tape, &evolution->done, sizeof evolution->done);
    pass(tape, &evolution->current, sizeof evolution->current);
    pass(tape, &evolution->part, sizeof evolution->part);
    pass(tape, &evolution->ended, sizeof evolution->ended);
    for (int k = 0; k < evolution->stage_count; k++)
        for (int i = 0; i < evolution->stage[k].change_count; i++)
            pass(tape, &evolution->stage[k].change[i].from, sizeof evolution->stage[k].change[i].from);
    for (int i = 0; i < evolution->line_count; i++) pass_line(tape, &evolution->line[i]);
    return tape->at;
}

/* FNV-1a, 64 bits. */
static void mix(uint64_t *hash, const void *data, size_t size) {
    const unsigned char *byte = data;
    for (size_t i = 0; i < size; i++) *hash = (*hash ^ byte[i])*1099511628211u;
}

static void mix_numbers(uint64_t *hash, size_t count, const double *number) { mix(hash, number, count*sizeof *number); }

static void mix_line(uint64_t *hash, const CpsiLine *line) {
    mix(hash, line->name, strlen(line->name) + 1);
    mix(hash, &line->n, sizeof line->n);
    mix_numbers(hash, 1, &line->length);
    mix_numbers(hash, 1, &line->compliance);
    mix_numbers(hash, 3, line->weight);
    mix_numbers(hash, (size_t)line->n - 1, line->element_length);
    mix_numbers(hash, 3*(size_t)line->n, line->position);
    if (line->friction_factor) mix_numbers(hash, (size_t)line->n, line->friction_factor);
    for (int end = 0; end < 2; end++) {
        mix(hash, &line->end[end].kind, sizeof line->end[end].kind);
        mix_numbers(hash, 3, line->end[end].value);
    }
}

static void mix_stage(uint64_t *hash, const CpsiEvolutionStage *stage) {
    mix(hash, stage->name, strlen(stage->name) + 1);
    mix(hash, &stage->steps, sizeof stage->steps);
    for (int i = 0; i < stage->change_count; i++) {
        const CpsiChange *change = &stage->change[i];
        const int what[3] = {change->line, change->end, (int)change->to.kind};
        mix(hash, what, sizeof what);
        mix_numbers(hash, 3, change->to.value);
    }
    for (int i = 0; i < stage->turn_count; i++) {
        mix(hash, &stage->turn[i].obstacle, sizeof stage->turn[i].obstacle);
        mix_numbers(hash, 1, &stage->turn[i].angle);
    }
}

static void mix_obstacle(uint64_t *hash, const CpsiObstacle *obstacle) {
    const int what[4] = {(int)obstacle->kind, (int)obstacle->shape, obstacle->has_grain, obstacle->has_set};
    mix(hash, what, sizeof what);
    mix_numbers(hash, 3, (const double[3]){obstacle->frame.point.x, obstacle->frame.point.y, obstacle->frame.point.z});
    const Vec3 axis = obstacle->frame.axis[2], grain = obstacle->grain;
    mix_numbers(hash, 6, (const double[6]){axis.x, axis.y, axis.z, grain.x, grain.y, grain.z});
    mix_numbers(hash, 3, (const double[3]){obstacle->radius, obstacle->friction[0], obstacle->friction[1]});
    if (!obstacle->set) return;
    const CpsiShapeForm *form = cpsi_friction_set_shape(obstacle->set);
    mix(hash, form->dim, (size_t)form->cones*sizeof *form->dim);
    mix_numbers(hash, (size_t)(form->rows*form->unknowns), form->a);
    mix_numbers(hash, (size_t)form->rows, form->b);
    mix_numbers(hash, 2*(size_t)form->unknowns, form->p);
    mix_numbers(hash, 2, form->origin);
}

uint64_t cpsi_evolution_fingerprint(const CpsEvolution *evolution) {
    uint64_t hash = 14695981039346656037u;
    const CpsSolverOptions *solver = &evolution->options.solver;
    const int what[] = {evolution->line_count,       evolution->stage_count,       evolution->obstacle_count,
                        (int)evolution->options.friction, (int)evolution->options.contact, solver->max_iterations,
                        (int)solver->linear_system,  solver->halvings};
    mix(&hash, what, sizeof what);
    mix_numbers(&hash, 2, (const double[2]){solver->tolerance, solver->path_tolerance});
    mix_numbers(&hash, 3, evolution->origin);
    for (int i = 0; i < evolution->line_count; i++) mix_line(&hash, &evolution->line[i]);
    for (int k = 0; k < evolution->obstacle_count; k++) mix_obstacle(&hash, &evolution->obstacle[k]);
    for (int k = 0; k < evolution->stage_count; k++) mix_stage(&hash, &evolution->stage[k]);
    return hash;
}

size_t cps_evolution_state_size(const CpsEvolution *evolution) {
    Tape tape = {0};
    return pass_state(&tape, (CpsEvolution *)(uintptr_t)evolution); /* counts only */
}

void cps_evolution_save(const CpsEvolution *evolution, void *state) {
    Head head = {.size = cps_evolution_state_size(evolution), .fingerprint = evolution->fingerprint};
    memcpy(head.magic, MAGIC, sizeof MAGIC);
    memcpy(state, &head, sizeof head);
    Tape tape = {.out = state};
    pass_state(&tape, (CpsEvolution *)(uintptr_t)evolution); /* only read */
}

CpsStatus cps_evolution_load(CpsEvolution *evolution, const void *state, size_t size, CpsError *err) {
    if (!evolution || !state) return cpsi_fail(err, CPS_ERR_ARGUMENT, "evolution and state are both needed");
    Head head;
    if (size < sizeof head) return cpsi_fail(err, CPS_ERR_ARGUMENT, "a saved state of %zu bytes is cut short", size);
    memcpy(&head, state, sizeof head);
    if (memcmp(head.magic, MAGIC, sizeof MAGIC) != 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "this is no saved state of an evolution");
    if (head.fingerprint != evolution->fingerprint)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the saved state is of another scene than this one, or of other settings");
    if (head.size != size || size != cps_evolution_state_size(evolution))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the saved state has %zu bytes, expected %zu", size,
                         cps_evolution_state_size(evolution));
    Tape tape = {.in = state};
    pass_state(&tape, evolution);
    evolution->report.name = evolution->step_name;
    return CPS_OK;
}
