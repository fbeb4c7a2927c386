/* SPDX-License-Identifier: BSD-3-Clause */
/* The state of an evolution as bytes: everything that steps change and that later steps or views
 * read.
 *
 * The same functions measure, save and load the state. Numbers are copied bit by bit, so that a run
 * continued from a saved state gives the same bits as one that was never interrupted; a state is
 * only valid for the same program on the same kind of machine. Structs are copied field by field:
 * the bytes contain no padding and no address, and are the same in every run. */
#include "evolve/checkpoint.h"

#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "cable/damping.h"
#include "cable/place_form.h"
#include "cable/soft.h"
#include "cable/two_stiffnesses.h"
#include "cable/winch.h"
#include "evolve/failure.h"
#include "evolve/hash.h"
#include "evolve/state_check.h"
#include "evolve/sways.h"
#include "evolve/velocities.h"

/* The header of a state. */
typedef struct Head {
    char magic[8];
    uint64_t size, fingerprint;
    uint64_t history; /* hash of all stages: a journal compares it */
    uint64_t past;    /* hash of the stages that have begun */
} Head;

/* The number at its end is raised when the bytes of a state change. Journals need no more: they are
 * tied to the build. */
static const char MAGIC[8] = {'c', 'a', 'p', 's', 't', 'a', '2', '9'};

/* A cursor over the bytes of a state, which are written, read, or only counted. */
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

#define PASS(tape, field) pass(tape, &(field), sizeof(field))

/* A flag as a byte: any that is not 0 is read as true, for a bool may hold nothing but 0 and 1. */
static void pass_flag(Tape *tape, bool *flag) {
    unsigned char byte = *flag;
    PASS(tape, byte);
    if (tape->in) *flag = byte != 0;
}

/* A field that is added to one of these structs has to be added to its function below as well. */
#if UINTPTR_MAX == 0xffffffffffffffff
_Static_assert(sizeof(CpsCertificate) == 18 * 8 && sizeof(CpsLedger) == 8 * 8 &&
                   sizeof(CpsTensionRange) == 5 * 8,
               "add the new field to pass_energies or pass_end_report, then its size here");
_Static_assert(sizeof(CpsEndReport) == 17 * 8 + sizeof(CpsTensionRange) && sizeof(CpsBend) == 7 * 8,
               "add the new field to pass_end_report or pass_bend, then its size here");
_Static_assert(sizeof(CpsLineReport) == 26 * 8 + sizeof(CpsCertificate) + sizeof(CpsLedger) +
                                            2 * sizeof(CpsEndReport) + sizeof(CpsBend),
               "add the new field to pass_line_report, then its size here");
_Static_assert(sizeof(CpsStepReport) == 9 * 8 + sizeof(CpsCertificate) + sizeof(CpsLedger),
               "add the new field to pass_step_report, then its size here");
_Static_assert(sizeof(CpsBodyReport) == 85 * 8, "add the new field to pass_body, then its size");
_Static_assert(sizeof(CpsPointReport) == 47 * 8,
               "add the new field to pass_point, then its size here");
_Static_assert(sizeof(CpsBreak) == 5 * 8, "add the new field to pass_break, then its size here");
_Static_assert(sizeof(CpsEnd) == 4 * 8, "add the new field to pass_end, then its size here");
#endif

static void pass_energies(Tape *tape, CpsCertificate *certificate, CpsLedger *ledger) {
    pass(tape, certificate, offsetof(CpsCertificate, has_tension_bound)); /* numbers */
    pass_flag(tape, &certificate->has_tension_bound);
    PASS(tape, *ledger);
}

static void pass_break(Tape *tape, CpsBreak *parted) {
    pass_flag(tape, &parted->is_break);
    PASS(tape, parted->line);
    PASS(tape, parted->end);
    PASS(tape, parted->tension);
    PASS(tape, parted->break_at);
    PASS(tape, parted->arc_length);
}

static void pass_end(Tape *tape, CpsEnd *end) {
    PASS(tape, end->kind);
    PASS(tape, end->value);
}

static void pass_load_change(Tape *tape, CpsiLoadChange *change) {
    pass_flag(tape, &change->known);
    PASS(tape, change->grasp_count);
    for (int k = 0; k < CPS_MAX_GRASPS; k++) {
        PASS(tape, change->grasp[k].node);
        PASS(tape, change->grasp[k].kind);
        PASS(tape, change->grasp[k].by);
    }
    PASS(tape, change->kind);
    PASS(tape, change->end);
    PASS(tape, change->weight);
    PASS(tape, change->turn);
    pass_flag(tape, &change->winds);
}

static void pass_end_report(Tape *tape, CpsEndReport *end) {
    pass(tape, end, offsetof(CpsEndReport, range)); /* numbers */
    CpsTensionRange *range = &end->range;
    PASS(tape, range->kind);
    pass_flag(tape, &range->has_values);
    PASS(tape, range->least);
    PASS(tape, range->least_bound);
    PASS(tape, range->greatest);
    PASS(tape, range->greatest_bound);
}

static void pass_bend(Tape *tape, CpsBend *bend) {
    pass(tape, bend, offsetof(CpsBend, obstacle)); /* numbers */
    PASS(tape, bend->obstacle);
}

static void pass_line_report(Tape *tape, CpsLineReport *report) {
    PASS(tape, report->outcome);
    PASS(tape, report->iteration_count);
    PASS(tape, report->places);
    pass_energies(tape, &report->certificate, &report->ledger);
    PASS(tape, report->dissipated);
    PASS(tape, report->substep_count);
    PASS(tape, report->warm_count);
    PASS(tape, report->share);
    PASS(tape, report->jump_count);
    PASS(tape, report->jump);
    PASS(tape, report->unaccounted);
    for (int end = 0; end < 2; end++) pass_end_report(tape, &report->end[end]);
    PASS(tape, report->grounded);
    PASS(tape, report->slipping);
    PASS(tape, report->slack);
    PASS(tape, report->sweep);
    pass_flag(tape, &report->has_slipping);
    pass_flag(tape, &report->has_tension_mesh);
    pass_flag(tape, &report->has_touchdown);
    PASS(tape, report->tension_mesh);
    pass_flag(tape, &report->has_utilisation);
    PASS(tape, report->utilisation);
    PASS(tape, report->utilisation_arc_length);
    pass_flag(tape, &report->has_pierced_obstacle);
    PASS(tape, report->pierced_obstacle);
    pass_bend(tape, &report->bend);
    PASS(tape, report->proof);
    PASS(tape, report->proof_length);
    PASS(tape, report->proof_force);
    pass_flag(tape, &report->has_proof_obstacle);
    PASS(tape, report->proof_obstacle);
    pass_flag(tape, &report->has_proof_plane);
    PASS(tape, report->proof_plane);
    PASS(tape, report->coulomb);
}

/* all but its name, which is the evolution's step_name */
static void pass_step_report(Tape *tape, CpsStepReport *report) {
    PASS(tape, report->step_count);
    PASS(tape, report->outcome);
    PASS(tape, report->iteration_count);
    pass_energies(tape, &report->certificate, &report->ledger);
    PASS(tape, report->dissipated);
    PASS(tape, report->substep_count);
    PASS(tape, report->warm_count);
    PASS(tape, report->jump_count);
    PASS(tape, report->places);
    PASS(tape, report->jump);
    PASS(tape, report->unaccounted);
    PASS(tape, report->wall);
}

static void pass_inertia(Tape *tape, CpsiLine *line) {
    CpsiInertia *inertia = &line->inertia;
    const size_t n = (size_t)line->n;
    double *const vectors[] = {inertia->rest_velocity, inertia->start, inertia->velocity,
                               inertia->before, inertia->before_velocity};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
        pass(tape, vectors[i], 3 * n * sizeof(double));
    pass(tape, inertia->span, n * sizeof *inertia->span);
    for (size_t j = 0; j < n; j++) pass_flag(tape, &inertia->restarts[j]);
    double *const damped[] = {inertia->damping.elongation, inertia->damping.before,
                              inertia->damping.rest, line->element_length, line->compliance_factor};
    if (cpsi_line_has_damping(line)) {
        for (size_t i = 0; i < sizeof damped / sizeof *damped; i++)
            pass(tape, damped[i], (n - 1) * sizeof(double));
        for (size_t j = 0; j < n; j++) pass_flag(tape, &inertia->is_euler[j]);
    }
    pass_flag(tape, &inertia->is_moving);
    for (int end = 0; end < 2; end++) pass_flag(tape, &inertia->velocity_given[end]);
    PASS(tape, inertia->kinetic);
    PASS(tape, inertia->position_bound);
    PASS(tape, inertia->ledger);
    PASS(tape, inertia->landed);
    PASS(tape, inertia->changed);
    PASS(tape, inertia->snatched);
}

static void pass_line(Tape *tape, CpsiLine *line) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    double *const nodes[] = {line->reference, line->position, line->load, line->motion};
    double *const vectors[] = {line->normal, line->friction_force, line->slip};
    double *const scalars[] = {line->gap, line->friction_bound, line->reaction};
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes; i++)
        pass(tape, nodes[i], 3 * n * sizeof(double));
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
        pass(tape, vectors[i], 3 * contacts * sizeof(double));
    for (size_t i = 0; i < sizeof scalars / sizeof *scalars; i++)
        pass(tape, scalars[i], contacts * sizeof(double));
    pass(tape, line->segment_force, 3 * (n - 1) * sizeof(double));
    pass(tape, line->tension, (n - 1) * sizeof(double));
    if (line->has_node_loads) {
        pass(tape, line->field.load, 3 * n * sizeof(double));
        pass(tape, line->field.drag, 3 * n * sizeof(double));
        pass(tape, line->field.all, 3 * n * sizeof(double));
        if (line->has_inertia) {
            pass(tape, line->field.added, 3 * n * sizeof(double));
            pass(tape, line->field.wave, 3 * n * sizeof(double));
        }
        PASS(tape, line->field.left);
    }
    if (line->has_potential) {
        pass(tape, line->field.pull, 3 * n * sizeof(double));
        pass(tape, line->field.energy, n * sizeof(double));
    }
    if (line->has_field) {
        pass(tape, line->field.stiffness, 6 * n * sizeof(double));
        pass(tape, line->field.place, 3 * n * sizeof(double));
        pass(tape, line->field.beside, 3 * n * sizeof(double));
        PASS(tape, line->field.size);
    }
    pass(tape, line->state, contacts * sizeof *line->state);
    if (line->obstacle_index)
        pass(tape, line->obstacle_index, contacts * sizeof *line->obstacle_index);
    if (line->beta) pass(tape, line->beta, n * sizeof *line->beta);
    for (int end = 0; end < 2; end++) pass_end(tape, &line->end[end]);
    PASS(tape, line->grasp_count);
    for (int k = 0; k < CPS_MAX_GRASPS; k++) {
        PASS(tape, line->grasp[k].node);
        pass_end(tape, &line->grasp[k].imposed);
        PASS(tape, line->grasp[k].force);
        pass_end(tape, &line->grasp_from[k]);
    }
    PASS(tape, line->weight);
    PASS(tape, line->weight_before);
    pass_load_change(tape, &line->last_change);
    PASS(tape, line->newton.failures);
    PASS(tape, line->newton.pause);
    pass_flag(tape, &line->newton.useful);
    if (line->has_inertia) pass_inertia(tape, line);
    if (!line->has_inertia) PASS(tape, line->inertia.ledger);
    if (cpsi_line_has_winch(line)) {
        double stored[2] = {line->drums.stored[CPS_END_A], line->drums.stored[CPS_END_B]};
        PASS(tape, stored);
        if (tape->in) cpsi_winch_set(line, stored);
    }
    for (int end = 0; end < 2; end++)
        if (line->on[end].is_there) PASS(tape, line->on[end].reaction);
    pass_line_report(tape, &line->report);
}

static void pass_two_stiffnesses(Tape *tape, CpsiLine *line) {
    if (!line->two.exists) return;
    pass_flag(tape, &line->two.is_dynamic);
    pass(tape, line->two.rest_strain, ((size_t)line->n - 1) * sizeof *line->two.rest_strain);
    if (tape->in) cpsi_line_set_stiffness(line);
}

/* all but the mass, which is constant */
static void pass_point_inertia(Tape *tape, CpsiPointInertia *inertia) {
    pass_flag(tape, &inertia->is_moving);
    pass_flag(tape, &inertia->restarts);
    pass_flag(tape, &inertia->bore);
    pass_flag(tape, &inertia->landed);
    pass_flag(tape, &inertia->velocity_given);
    PASS(tape, inertia->span);
    PASS(tape, inertia->reference);
    PASS(tape, inertia->rest_velocity);
    PASS(tape, inertia->velocity);
    PASS(tape, inertia->before);
    PASS(tape, inertia->before_velocity);
    PASS(tape, inertia->kinetic);
    PASS(tape, inertia->ledger);
}

static void pass_point(Tape *tape, CpsiPoint *point) {
    CpsPointReport *report = &point->report;
    PASS(tape, point->kind);
    PASS(tape, point->position);
    PASS(tape, point->force);
    PASS(tape, point->from);
    PASS(tape, point->before);
    PASS(tape, point->move);
    PASS(tape, report->state);
    PASS(tape, report->water);
    pass(tape, report->position, /* numbers */
         offsetof(CpsPointReport, obstacle) - offsetof(CpsPointReport, position));
    PASS(tape, point->dragged);
    PASS(tape, point->surface);
    PASS(tape, point->on.reaction);
    PASS(tape, report->obstacle);
    PASS(tape, report->trial_count);
    pass_flag(tape, &report->has_place);
    pass_point_inertia(tape, &point->inertia);
}

/* Vectors and a quaternion, all of them numbers. */
_Static_assert(sizeof(CpsiBodyPhase) == 28 * sizeof(double) && sizeof(CpsiPose) == 56,
               "a phase and a pose have numbers only");

static void pass_body_inertia(Tape *tape, CpsiBodyInertia *inertia) {
    pass_flag(tape, &inertia->held_now);
    pass_flag(tape, &inertia->held_before);
    pass_flag(tape, &inertia->is_moving);
    pass_flag(tape, &inertia->restarts);
    pass_flag(tape, &inertia->velocity_given);
    PASS(tape, inertia->span);
    PASS(tape, inertia->now);
    PASS(tape, inertia->before);
    PASS(tape, inertia->rest);
    PASS(tape, inertia->kinetic);
    PASS(tape, inertia->dissipated);
    PASS(tape, inertia->ledger);
}

static void pass_body(Tape *tape, CpsiBody *body) {
    CpsBodyReport *report = &body->report;
    PASS(tape, body->kind);
    PASS(tape, body->pose);
    PASS(tape, body->from);
    PASS(tape, body->load);
    PASS(tape, body->load_from);
    PASS(tape, report->kind);
    PASS(tape, report->position);
    PASS(tape, report->rotation);
    PASS(tape, report->lines);
    PASS(tape, report->load);
    PASS(tape, report->support);
    PASS(tape, report->inertia);
    PASS(tape, report->damping);
    PASS(tape, report->residual);
    PASS(tape, report->stiffness);
    PASS(tape, report->proof);
    PASS(tape, report->proof_moment);
    pass_flag(tape, &report->is_stable);
    pass_flag(tape, &report->has_place);
    PASS(tape, report->trial_count);
    pass_body_inertia(tape, &body->inertia);
    PASS(tape, body->radiation.kept);
    const size_t past = 6 * (size_t)body->radiation.rows * sizeof(double);
    if (past > 0) pass(tape, body->radiation.past, past);
}

size_t cpsi_line_state_size(const CpsiLine *line) {
    Tape tape = {0};
    pass_line(&tape, (CpsiLine *)(uintptr_t)line); /* counts only */
    return tape.at;
}

void cpsi_line_keep(const CpsiLine *line, void *state) {
    pass_line(&(Tape){.out = state}, (CpsiLine *)(uintptr_t)line); /* only read */
}

void cpsi_line_restore(CpsiLine *line, const void *state) { pass_line(&(Tape){.in = state}, line); }

static void pass_obstacle(Tape *tape, CpsEvolution *evolution, int k) {
    CpsiObstacle *obstacle = &evolution->obstacle[k];
    PASS(tape, obstacle->frame);
    PASS(tape, obstacle->grain);
    PASS(tape, evolution->shift[k]);
    PASS(tape, evolution->angle[k]);
}

static size_t pass_state(Tape *tape, CpsEvolution *evolution) {
    tape->at = sizeof(Head);
    pass_step_report(tape, &evolution->report);
    PASS(tape, evolution->step_name);
    PASS(tape, evolution->done);
    PASS(tape, evolution->current);
    PASS(tape, evolution->part);
    PASS(tape, evolution->move_count);
    PASS(tape, evolution->gravity);
    PASS(tape, evolution->gravity_from);
    PASS(tape, evolution->time);
    PASS(tape, evolution->interval);
    PASS(tape, evolution->elapsed);
    PASS(tape, evolution->next);
    PASS(tape, evolution->pace.length);
    PASS(tape, evolution->pace.error);
    PASS(tape, evolution->pace.rejected);
    pass_flag(tape, &evolution->ground_moved);
    for (int i = 0; i < 2 * evolution->line_count; i++) pass_end(tape, &evolution->from[i]);
    pass(tape, evolution->release, 2 * (size_t)evolution->line_count * sizeof *evolution->release);
    pass_break(tape, &evolution->parted);
    PASS(tape, evolution->break_count);
    for (int i = 0; i < evolution->line_count; i++) {
        pass_line(tape, &evolution->line[i]);
        pass(tape, evolution->line[i].start_element,
             3 * (size_t)(evolution->line[i].n - 1) * sizeof(float));
        PASS(tape, evolution->line[i].start_end);
        pass_two_stiffnesses(tape, &evolution->line[i]);
    }
    for (int k = 0; k < evolution->obstacle_count; k++) pass_obstacle(tape, evolution, k);
    for (int i = 0; i < evolution->points.count; i++) pass_point(tape, &evolution->points.point[i]);
    for (int i = 0; i < evolution->bodies.count; i++) pass_body(tape, &evolution->bodies.body[i]);
    return tape->at;
}

static void hash_waves(uint64_t *hash, const CpsiWaves *waves) {
    hash_numbers(hash, 3, (const double[3]){waves->surface, waves->depth, waves->ramp});
    for (int k = 0; k < waves->count; k++)
        hash_bytes(hash, &waves->wave[k], sizeof waves->wave[k]); /* numbers only */
}

static void hash_flow(uint64_t *hash, const CpsiFlow *flow) {
    const double given[] = {flow->density,           flow->drag.diameter,
                            flow->drag.normal,       flow->drag.tangential,
                            flow->drag.added_normal, flow->drag.added_tangential,
                            flow->given != NULL};
    hash_numbers(hash, sizeof given / sizeof *given, given);
    for (int k = 0; k < flow->row_count; k++) {
        hash_numbers(hash, 1, &flow->row[k].z);
        hash_numbers(hash, 3, flow->row[k].velocity);
    }
    if (flow->waves) hash_waves(hash, flow->waves);
}

static void hash_elasticity(uint64_t *hash, const CpsiLine *line, const CpsiElasticity *own) {
    hash_numbers(hash, (size_t)line->n - 1, own->compliance_factor);
    hash_bytes(hash, own->spring_at, (size_t)line->n * sizeof *own->spring_at);
    hash_numbers(hash, (size_t)own->spring_count, own->spring_start);
    hash_numbers(hash, (size_t)own->spring_count, own->spring_stiffness);
}

static void hash_form(uint64_t *hash, const CpsiConicSet *form, size_t space) {
    hash_bytes(hash, form->dim, (size_t)form->cones * sizeof *form->dim);
    hash_numbers(hash, (size_t)form->rows * (size_t)form->unknowns, form->a);
    hash_numbers(hash, (size_t)form->rows, form->b);
    hash_numbers(hash, space * (size_t)form->unknowns, form->p);
    hash_numbers(hash, space, form->origin);
}

static void hash_set(uint64_t *hash, const CpsiEndSet *on) {
    if (!on->is_there) return;
    if (on->form) hash_form(hash, cpsi_place_form_conic(on->form), 3);
    const double centre[3] = {on->set.centre.x, on->set.centre.y, on->set.centre.z},
                 radius = on->set.round + on->set.radius;
    hash_numbers(hash, 3, centre);
    hash_numbers(hash, 9, on->set.axes);
    hash_numbers(hash, 3, on->set.low);
    hash_numbers(hash, 3, on->set.high);
    hash_numbers(hash, 1, &radius);
}

static void hash_line(uint64_t *hash, const CpsiLine *line) {
    hash_bytes(hash, line->name, strlen(line->name) + 1);
    hash_bytes(hash, &line->n, sizeof line->n);
    hash_numbers(hash, 1, &line->length);
    hash_numbers(hash, 1, &line->compliance);
    hash_numbers(hash, 3, line->weight);
    hash_numbers(hash, (size_t)line->n - 1, line->element_length);
    hash_numbers(hash, 3 * (size_t)line->n, line->position);
    hash_numbers(hash, (size_t)line->n - 1, line->tension);
    hash_numbers(hash, (size_t)line->n, line->reaction);
    if (line->friction_factor) hash_numbers(hash, (size_t)line->n, line->friction_factor);
    if (line->has_sections) {
        hash_numbers(hash, (size_t)line->n, line->weight_length);
        hash_numbers(hash, (size_t)line->n - 1, line->weight_factor);
        hash_numbers(hash, (size_t)line->n - 1, line->compliance_factor);
    }
    if (line->has_field) {
        hash_numbers(hash, 6 * (size_t)line->n, line->field.own_stiffness);
        hash_numbers(hash, 3 * (size_t)line->n, line->field.own_place);
    }
    if (cpsi_line_has_soft(line)) hash_numbers(hash, 1, &line->bearing_width);
    if (line->has_node_loads) hash_numbers(hash, 3 * (size_t)line->n, line->field.own_load);
    if (line->field.flow) hash_flow(hash, line->field.flow);
    if (line->has_potential) { /* a function is known by what it gives */
        hash_numbers(hash, (size_t)line->n, line->field.share);
        hash_numbers(hash, (size_t)line->n, line->field.energy);
        hash_numbers(hash, 3 * (size_t)line->n, line->field.pull);
    }
    if (cpsi_line_has_damping(line)) hash_numbers(hash, 1, &line->inertia.damping.coefficient);
    if (line->spring_count > 0) {
        hash_bytes(hash, line->spring_at, (size_t)line->n * sizeof *line->spring_at);
        hash_numbers(hash, (size_t)line->spring_count, line->spring_start);
        hash_numbers(hash, (size_t)line->spring_count, line->spring_stiffness);
    }
    if (cpsi_line_has_winch(line)) {
        const int on[2] = {line->drums.on[CPS_END_A], line->drums.on[CPS_END_B]};
        hash_bytes(hash, on, sizeof on);
        hash_numbers(hash, 2, line->drums.stored);
        hash_numbers(hash, (size_t)line->n - 1, line->drums.length);
    }
    for (int end = 0; end < 2; end++) hash_set(hash, &line->on[end]);
    if (line->two.exists) hash_elasticity(hash, line, &line->two.elasticity[CPSI_DYNAMIC]);
    if (line->has_breaking_load) hash_numbers(hash, (size_t)line->n - 1, line->breaking_load);
    if (line->has_break_at) hash_numbers(hash, (size_t)line->n - 1, line->break_at);
    if (line->has_inertia) {
        hash_numbers(hash, (size_t)line->n, line->inertia.mass);
        hash_numbers(hash, 3 * (size_t)line->n, line->inertia.velocity);
    }
    for (int end = 0; end < 2; end++) {
        hash_bytes(hash, &line->end[end].kind, sizeof line->end[end].kind);
        hash_numbers(hash, 3, line->end[end].value);
    }
}

static void hash_stage(uint64_t *hash, const CpsiEvolutionStage *stage) {
    hash_bytes(hash, stage->name, strlen(stage->name) + 1);
    hash_bytes(hash, &stage->steps, sizeof stage->steps);
    if (stage->error > 0) hash_numbers(hash, 1, &stage->error);
    const int gravity_changes = stage->gravity_changes;
    hash_bytes(hash, &gravity_changes, sizeof gravity_changes);
    if (stage->static_stiffness) hash_bytes(hash, "static", 6);
    hash_numbers(hash, 3, stage->gravity);
    hash_numbers(hash, 1, &stage->duration);
    for (int i = 0; i < stage->change_count; i++) {
        const CpsChange *change = &stage->change[i];
        const int what[3] = {change->line, change->end, (int)change->to.kind};
        hash_bytes(hash, what, sizeof what);
        hash_numbers(hash, 3, change->to.value);
    }
    for (int i = 0; i < stage->sway_count; i++) {
        const CpsSway *sway = &stage->sway[i];
        const int what[3] = {(int)sway->of, sway->owner, sway->end};
        hash_bytes(hash, what, sizeof what);
        hash_numbers(hash, 6, sway->sine);
        hash_numbers(hash, 6, sway->cosine);
        hash_numbers(hash, 1, &sway->period);
        hash_numbers(hash, cpsi_sways_numbers(1, sway), sway->row);
    }
    for (int i = 0; i < stage->point_change_count; i++) {
        const CpsPointChange *change = &stage->point_change[i];
        const int what[2] = {change->point, (int)change->kind};
        hash_bytes(hash, what, sizeof what);
        hash_numbers(hash, 3, change->value);
    }
    for (int i = 0; i < stage->body_change_count; i++) {
        const CpsBodyChange *change = &stage->body_change[i];
        const int what[2] = {change->body, (int)change->kind};
        const bool held = change->kind == CPS_BODY_KIND_HELD;
        hash_bytes(hash, what, sizeof what);
        hash_numbers(hash, 3, held ? change->position : change->force);
        hash_numbers(hash, held ? 4 : 3, held ? change->rotation : change->moment);
    }
    for (int i = 0; i < stage->grasp_change_count; i++) {
        const CpsGraspChange *change = &stage->grasp_change[i];
        const int what[5] = {change->line, change->node, (int)change->kind, change->stays,
                             change->at_once};
        hash_bytes(hash, what, sizeof what);
        if (!change->stays) hash_numbers(hash, 3, change->value);
    }
    for (int i = 0; i < stage->shift_count; i++) {
        hash_bytes(hash, &stage->shift[i].obstacle, sizeof stage->shift[i].obstacle);
        hash_numbers(hash, 3, stage->shift[i].by);
        hash_numbers(hash, 3, stage->shift[i].turn);
        hash_numbers(hash, 3, stage->shift[i].about);
    }
    for (int i = 0; i < stage->pay_out_count; i++) {
        const int what[2] = {stage->pay_out[i].line, stage->pay_out[i].end};
        hash_bytes(hash, what, sizeof what);
        hash_numbers(hash, 1, &stage->pay_out[i].length);
    }
    for (int i = 0; i < stage->turn_count; i++) {
        hash_bytes(hash, &stage->turn[i].obstacle, sizeof stage->turn[i].obstacle);
        hash_numbers(hash, 1, &stage->turn[i].angle);
    }
    cpsi_velocities_hash(hash, stage);
}

/* Of a surface the size alone: what its function gives is not known. */
static void hash_ground(uint64_t *hash, const CpsiObstacle *obstacle) {
    if (obstacle->kind == CPS_OBSTACLE_SURFACE) hash_numbers(hash, 1, &obstacle->surface.size);
    if (!obstacle->ground) return;
    const CpsGroundGrid grid = cps_ground_grid(obstacle->ground);
    const size_t columns = (size_t)grid.x_count, rows = (size_t)grid.y_count;
    const int what[3] = {grid.x_count, grid.y_count, grid.extends};
    hash_bytes(hash, what, sizeof what);
    hash_numbers(hash, columns, grid.x);
    hash_numbers(hash, rows, grid.y);
    hash_numbers(hash, columns * rows, grid.z);
    if (grid.friction_factor) hash_numbers(hash, columns * rows, grid.friction_factor);
}

static void hash_mesh(uint64_t *hash, const CpsMesh *mesh) {
    if (!mesh) return;
    const CpsMeshTriangles of = cps_mesh_triangles(mesh);
    const int what[3] = {of.vertex_count, of.triangle_count, of.two_sided};
    hash_bytes(hash, what, sizeof what);
    hash_numbers(hash, 3 * (size_t)of.vertex_count, of.vertex);
    hash_bytes(hash, of.triangle, 3 * (size_t)of.triangle_count * sizeof *of.triangle);
}

static void hash_obstacle(uint64_t *hash, const CpsiObstacle *obstacle,
                          const CpsiFrictionSet *set) {
    const int what[5] = {(int)obstacle->kind, (int)obstacle->shape, obstacle->has_grain,
                         obstacle->has_set, obstacle->moves};
    hash_bytes(hash, what, sizeof what);
    hash_numbers(hash, 3,
                 (const double[3]){obstacle->frame.point.x, obstacle->frame.point.y,
                                   obstacle->frame.point.z});
    const Vec3 axis = obstacle->frame.axis[2], grain = obstacle->grain;
    hash_numbers(hash, 6, (const double[6]){axis.x, axis.y, axis.z, grain.x, grain.y, grain.z});
    hash_numbers(hash, 3,
                 (const double[3]){obstacle->radius, obstacle->friction[0], obstacle->friction[1]});
    const CpsShape *shape = &obstacle->form;
    const Vec3 side = obstacle->frame.axis[0];
    if (cpsi_obstacle_is_rounded(obstacle))
        hash_numbers(hash, 10,
                     (const double[10]){shape->inside, shape->length, shape->main_radius,
                                        shape->angle, shape->size[0], shape->size[1],
                                        shape->size[2], side.x, side.y, side.z});
    if (obstacle->stiffness > 0) hash_numbers(hash, 1, &obstacle->stiffness);
    if (obstacle->damping > 0) hash_numbers(hash, 1, &obstacle->damping);
    hash_ground(hash, obstacle);
    hash_mesh(hash, obstacle->mesh);
    if (set) hash_form(hash, cpsi_friction_set_conic(set), 2);
}

static void hash_anchor(uint64_t *hash, const CpsPoint *given) {
    const int has[] = {given->has_holding_capacity, given->has_uplift_limit, given->drags};
    const double limit[] = {given->has_holding_capacity ? given->holding_capacity : 0,
                            given->has_uplift_limit ? given->uplift_limit : 0};
    hash_bytes(hash, has, sizeof has);
    hash_numbers(hash, 2, limit);
}

static void hash_points(uint64_t *hash, const CpsEvolution *evolution) {
    const CpsiPoints *points = &evolution->points;
    hash_bytes(hash, points->tie, 2 * (size_t)evolution->line_count * sizeof *points->tie);
    for (int i = 0; i < points->count; i++) {
        const CpsiPoint *point = &points->point[i];
        const int kind = (int)point->kind;
        hash_bytes(hash, point->name, strlen(point->name) + 1);
        hash_bytes(hash, &kind, sizeof kind);
        hash_numbers(hash, 3, point->position);
        hash_numbers(hash, 3, point->force);
        hash_numbers(hash, 3, (const double[3]){point->mass, point->displaced_mass, point->extent});
        hash_numbers(hash, 1, &points->given[i].inertia);
        hash_numbers(hash, points->given[i].bearing_area > 0, &points->given[i].bearing_area);
        hash_numbers(hash, 3, points->given[i].velocity);
        hash_anchor(hash, &points->given[i]);
        hash_set(hash, &point->on);
    }
    const int surface = points->has_surface;
    hash_bytes(hash, &surface, sizeof surface);
    hash_numbers(hash, 1, &points->surface);
}

static void hash_body(uint64_t *hash, const CpsiBody *body) {
    const CpsBody *given = &body->given;
    int what[1 + CPS_BODY_DIRECTIONS] = {(int)given->kind};
    for (int i = 0; i < CPS_BODY_DIRECTIONS; i++) what[1 + i] = given->fixed[i];
    hash_bytes(hash, body->name, strlen(body->name) + 1);
    hash_bytes(hash, what, sizeof what);
    hash_numbers(hash, 3, given->position);
    hash_numbers(hash, 4, given->rotation);
    hash_numbers(hash, 3, given->centre_of_gravity);
    hash_numbers(hash, 3, given->centre_of_buoyancy);
    hash_numbers(hash, 3, (const double[3]){given->weight, given->buoyancy, given->mass});
    hash_numbers(hash, 36, given->hydrostatics);
    hash_numbers(hash, 3, given->force);
    hash_numbers(hash, 3, given->moment);
    hash_numbers(hash, 6, given->inertia);
    hash_numbers(hash, 36, given->added_mass);
    hash_numbers(hash, 36, given->damping);
    hash_numbers(hash, 36, given->quadratic_damping);
    hash_numbers(hash, 6, given->velocity);
    hash_numbers(hash, 12 * (size_t)body->wave_count, body->excitation);
    hash_numbers(hash, 36 * (size_t)body->radiation.rows, body->radiation.kernel);
    hash_numbers(hash, 1, &body->radiation.spacing);
    for (int i = 0; i < body->member_count; i++) /* numbers only */
        hash_bytes(hash, &body->member[i], offsetof(CpsiCylinder, strips));
    for (int i = 0; i < body->member_count; i++) hash_flow(hash, &body->member[i].flow);
}

uint64_t cpsi_evolution_fingerprint(const CpsEvolution *evolution) {
    uint64_t hash = HASH_START;
    const CpsSolverOptions *solver = &evolution->options.solver;
    const int what[] = {evolution->line_count,
                        evolution->obstacle_count,
                        (int)evolution->options.friction_policy,
                        (int)evolution->options.contact_policy,
                        (int)evolution->time_scheme,
                        solver->max_iterations,
                        (int)solver->linear_system,
                        solver->max_halvings,
                        solver->cold};
    hash_bytes(&hash, what, sizeof what);
    hash_numbers(&hash, 2, (const double[2]){solver->tolerance, solver->path_tolerance});
    hash_numbers(&hash, 3, evolution->origin);
    hash_numbers(&hash, 3, evolution->gravity);
    for (int i = 0; i < evolution->line_count; i++) hash_line(&hash, &evolution->line[i]);
    if (evolution->points.count > 0) hash_points(&hash, evolution);
    for (int i = 0; i < evolution->bodies.count; i++) hash_body(&hash, &evolution->bodies.body[i]);
    CpsiFrictionSet **set = evolution->workspace[0].friction_sets.set;
    for (int k = 0; k < evolution->obstacle_count; k++)
        hash_obstacle(&hash, &evolution->obstacle[k], set ? set[k] : NULL);
    return hash;
}

void cpsi_evolution_hash_stages(CpsEvolution *evolution) {
    uint64_t hash = HASH_START;
    for (int k = 0; k < evolution->stage_count; k++) {
        hash_stage(&hash, &evolution->stage[k]);
        evolution->stage[k].hash = hash;
    }
}

/* The hash of the first `count` stages. */
static uint64_t history_hash(const CpsEvolution *evolution, int count) {
    return count > 0 ? evolution->stage[count - 1].hash : HASH_START;
}

/* ... and of those that have begun. */
static uint64_t past_hash(const CpsEvolution *evolution) {
    return history_hash(evolution, evolution->current + (evolution->part > 0 ? 1 : 0));
}

size_t cps_evolution_state_size(const CpsEvolution *evolution) {
    Tape tape = {0};
    if (!evolution) return 0;
    return pass_state(&tape, (CpsEvolution *)(uintptr_t)evolution); /* counts only */
}

void cpsi_evolution_keep(const CpsEvolution *evolution, void *state) {
    Head head = {.size = cps_evolution_state_size(evolution),
                 .fingerprint = evolution->fingerprint,
                 .history = history_hash(evolution, evolution->stage_count),
                 .past = past_hash(evolution)};
    memcpy(head.magic, MAGIC, sizeof MAGIC);
    memcpy(state, &head, sizeof head);
    Tape tape = {.out = state};
    pass_state(&tape, (CpsEvolution *)(uintptr_t)evolution); /* only read */
}

void cps_evolution_save(const CpsEvolution *evolution, void *state) {
    if (!evolution || !state) return;
    if (cpsi_move_failed(evolution))
        memcpy(state, evolution->before, cps_evolution_state_size(evolution));
    else
        cpsi_evolution_keep(evolution, state);
}

void cpsi_evolution_restore(CpsEvolution *evolution, const void *state) {
    pass_state(&(Tape){.in = state}, evolution);
    cpsi_follow_releases(evolution);
    evolution->waves.time = evolution->water.time = evolution->time;
    evolution->report.name = evolution->step_name;
    evolution->ended = cps_outcome_is_final(evolution->report.outcome);
}

CpsStatus cps_evolution_load(CpsEvolution *evolution, const void *state, size_t size,
                             CpsError *err) {
    if (!evolution || !state)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "evolution and state are both needed");
    Head head;
    if (size < sizeof head)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "a saved state of %zu bytes is cut short", size);
    memcpy(&head, state, sizeof head);
    if (memcmp(head.magic, MAGIC, sizeof MAGIC) != 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "this is no saved state of an evolution");
    if (head.fingerprint != evolution->fingerprint)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the saved state is of another scene than this one, or of other settings");
    if (head.size != size || size != cps_evolution_state_size(evolution))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the saved state has %zu bytes, expected %zu", size,
                         cps_evolution_state_size(evolution));
    /* a state is accepted only after its check, which needs it in place */
    unsigned char *before = malloc(size);
    if (!before) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while loading a state");
    cpsi_evolution_keep(evolution, before);
    const bool ended = evolution->ended;
    cpsi_evolution_restore(evolution, state);
    const char *fault = cpsi_state_fault(evolution);
    const bool other_past = !fault && past_hash(evolution) != head.past;
    if (fault || other_past) {
        cpsi_evolution_restore(evolution, before);
        evolution->ended = ended;
    } else {
        evolution->is_kept = false;
    }
    free(before);
    if (fault) return cpsi_fail(err, CPS_ERR_ARGUMENT, "the saved state is damaged: %s", fault);
    return other_past ? cpsi_fail(err, CPS_ERR_ARGUMENT,
                                  "the saved state is of another scene than this one: it has taken "
                                  "other stages")
                      : CPS_OK;
}
