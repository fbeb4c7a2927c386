/* SPDX-License-Identifier: BSD-3-Clause */
/* A load step in parts (advance.h).
 *
 * Friction depends on the path, and a step goes straight from one load to the next. A part of a step is accepted
 *   - when it converged, if the path's accuracy is not asked for;
 *   - when besides going it in two halves leads to the same place and tensions within the path tolerance, and neither half goes nearly
 *     all the way: the two halves are kept.
 * Otherwise it is halved, at most `halvings` times. A part that small is accepted; if it still is not what its halves are it is a
 * snap, and reported: the line jumps by a way that does not get smaller with the load. A part that small which does not converge is
 * not cut further: the rest of the step is taken in one go and reported as it is.
 *
 * A way round an obstacle is known only where neither the obstacle turns nor a node goes round it by more than a quarter of a turn
 * (cable/contact.h). A step in which an obstacle turns farther is cut beforehand into equal stretches of a quarter at most, each of
 * which is taken as above. A part in which a node with friction goes farther has not converged. */
#include "evolve/advance.h"

#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "cable/contact.h"
#include "evolve/ledger.h"

/* A part whose halves agree this much better than asked is followed by one twice as long. */
static const double EASY = 0.25;

/* Motion that follows the load goes about half its way in each half of a part: 0.71 of it in the one before a limit load, where it grows like
 * a square root, 0.75 where slip grows like the square of the load. A jump goes in one half all its way. */
static const double SUDDEN = 0.9;

/* An angle that is a whole number of quarters but for rounding is that number. */
static const double ROUNDING = 1e-9;

void cpsi_advance_layout(CpsiAdvance *room, CpsiArena *arena, int n, int contacts, bool path_tolerance) {
    const size_t all = (size_t)contacts*(size_t)n;
    room->reaction = CPSI_TAKE(arena, all, double);
    room->tension = CPSI_TAKE(arena, n, double);
    room->state = CPSI_TAKE(arena, all, unsigned char);
    room->on = CPSI_TAKE(arena, all, int);
    room->position = path_tolerance ? CPSI_TAKE(arena, 3*(size_t)n, double) : NULL;
    room->trial = path_tolerance ? CPSI_TAKE(arena, 4*(size_t)n, double) : NULL;
}

static void save(const CpsiLine *line, CpsiAdvance *room) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_contacts(line);
    memcpy(room->reaction, line->reaction, contacts*sizeof *line->reaction);
    memcpy(room->tension, line->tension, (n - 1)*sizeof *line->tension);
    memcpy(room->state, line->state, contacts*sizeof *line->state);
    if (line->follows) memcpy(room->on, line->on, contacts*sizeof *line->on);
    memcpy(room->end, line->report.end, sizeof room->end);
    if (room->position) memcpy(room->position, line->position, 3*n*sizeof *line->position);
}

/* Back to the start of the part; one step after `save` the reference still is where it started. */
static void restore(CpsiLine *line, const CpsiAdvance *room) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_contacts(line);
    memcpy(line->reaction, room->reaction, contacts*sizeof *line->reaction);
    memcpy(line->tension, room->tension, (n - 1)*sizeof *line->tension);
    memcpy(line->state, room->state, contacts*sizeof *line->state);
    if (line->follows) memcpy(line->on, room->on, contacts*sizeof *line->on);
    memcpy(line->report.end, room->end, sizeof room->end);
    memcpy(line->position, room->position ? room->position : line->reference, 3*n*sizeof *line->position);
}

/* What a part of a step did. */
typedef struct Part {
    CpsLineReport report;
    CpsLedger ledger;
} Part;

/* An end at a share of the move. */
static CpsEnd end_at(const CpsiMove *move, int end, double share) {
    CpsEnd at = move->to[end];
    for (int a = 0; a < 3 && share < 1; a++) {
        const double from = move->from[end].value[a];
        at.value[a] = from + share*(at.value[a] - from);
    }
    return at;
}

/* The part of the move from share `from` to share `to`. */
static Part take(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, const CpsiMove *move,
                 CpsiAdvance *room, double from, double to, bool known) {
    CpsEnd before[2];
    for (int end = 0; end < 2; end++) {
        before[end] = end_at(move, end, from);
        line->end[end] = end_at(move, end, to);
    }
    for (int k = 0; k < line->obstacle_count; k++) room->turn[k] = (to - from)*move->angle[k];
    const CpsiLedgerStart start = cpsi_ledger_start(line, before, known);
    cpsi_line_step(line, program, options);
    if (cps_outcome_is_certified(line->report.outcome) && cpsi_contact_rounds(line)) line->report.outcome = CPS_STALLED;
    line->report.share = to - from;
    Part part = {.report = line->report};
    if (!cps_outcome_is_final(line->report.outcome)) part.ledger = cpsi_ledger_close(line, &start);
    return part;
}

static bool converged(const Part *part) { return cps_outcome_is_certified(part->report.outcome); }

/* Add a part to the whole: sums, the worst outcome, else the later state. */
static void add(CpsLineReport *whole, CpsLedger *ledger, const Part *part) {
    const CpsLineReport before = *whole;
    *whole = part->report;
    whole->parts = before.parts + 1;
    whole->snaps = before.snaps;
    whole->jump = before.jump;
    whole->outcome = cps_outcome_worse(before.outcome, whole->outcome);
    whole->iterations += before.iterations;
    whole->dissipated += before.dissipated;
    cpsi_ledger_add(ledger, &part->ledger);
    whole->ledger = *ledger;
}

static void keep_trial(const CpsiLine *line, double *trial) {
    for (int j = 0; j < line->n; j++) {
        memcpy(&trial[4*j], &line->position[3*j], 3*sizeof *trial);
        trial[4*j + 3] = j > 0 ? line->tension[j - 1] : 0;
    }
}

/* How far the line is from where the trial went. */
typedef struct Apart {
    double way;     /* largest, per length of the line */
    double tension; /* largest, per largest force */
} Apart;

static Apart apart(const CpsiLine *line, const double *trial) {
    double way = 0, tension = 0;
    for (int j = 0; j < line->n; j++) {
        way = cpsi_larger(way, vec3_norm(vec3_sub(vec3_load(&line->position[3*j]), vec3_load(&trial[4*j]))));
        if (j > 0) tension = cpsi_larger(tension, fabs(line->tension[j - 1] - trial[4*j + 3]));
    }
    const double force = line->report.certificate.largest_force;
    return (Apart){way/line->length, force > 0 ? tension/force : 0};
}

/* [m] The longest way of a node since the reference. */
static double way_of(const CpsiLine *line) {
    double way = 0;
    for (int j = 0; j < line->n; j++)
        way = cpsi_larger(way, vec3_norm(vec3_sub(vec3_load(&line->position[3*j]), vec3_load(&line->reference[3*j]))));
    return way;
}

/* Equal stretches of a step in none of which an obstacle turns by more than a quarter. */
static int stretches(const CpsiLine *line, const CpsiMove *move) {
    double most = 0;
    for (int k = 0; k < line->obstacle_count; k++) most = cpsi_larger(most, fabs(move->angle[k]));
    const double quarters = ceil(most/CPSI_QUARTER - ROUNDING);
    return quarters > 1 ? (int)quarters : 1;
}

/* A stretch of a step, and what has been done of the step. */
typedef struct Stretch {
    double from, to; /* shares of the step */
    CpsLineReport whole;
    CpsLedger ledger;
    bool known;
} Stretch;

/* Where in the step a share of the stretch is. */
static double within(const Stretch *stretch, double share) {
    return share < 1 ? stretch->from + share*(stretch->to - stretch->from) : stretch->to;
}

/* Take a stretch in parts, each halved up to `halvings` times. */
static void advance(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, const CpsiMove *move,
                    CpsiAdvance *room, int halvings, Stretch *stretch) {
    const double tolerance = options->solver.path_tolerance, least = ldexp(1, -halvings);
    CpsLineReport *whole = &stretch->whole;
    CpsLedger *ledger = &stretch->ledger;
    for (double at = 0, part = 1; at < 1;) {
        const double end = at + part < 1 ? at + part : 1, middle = within(stretch, at + 0.5*(end - at));
        const double from = within(stretch, at), to = within(stretch, end);
        save(line, room);
        Part taken = take(line, program, options, move, room, from, to, stretch->known), second = {0};
        if (cps_outcome_is_final(taken.report.outcome) || (!converged(&taken) && part == 1 && least == 1)) {
            add(whole, ledger, &taken);
            return;
        }
        bool good = converged(&taken);
        const bool halves = tolerance > 0 && good;
        Apart error = {0};
        double longest = 0; /* way of a node in one of the halves */
        bool sudden = false;
        if (halves) {
            const double whole_way = way_of(line);
            keep_trial(line, room->trial);
            restore(line, room);
            taken = take(line, program, options, move, room, from, middle, stretch->known);
            longest = way_of(line);
            if (converged(&taken)) second = take(line, program, options, move, room, middle, to, true);
            good = converged(&taken) && converged(&second);
            if (good) error = apart(line, room->trial);
            longest = cpsi_larger(longest, way_of(line));
            sudden = longest > SUDDEN*whole_way && longest > tolerance*line->length;
        }
        if (!(good && !sudden && error.way <= tolerance && error.tension <= tolerance) && part > least) {
            restore(line, room);
            part *= 0.5;
            continue;
        }
        if (!good) { /* no smaller: the rest in one go */
            restore(line, room);
            taken = take(line, program, options, move, room, from, stretch->to, stretch->known);
            add(whole, ledger, &taken);
            return;
        }
        add(whole, ledger, &taken);
        if (halves) add(whole, ledger, &second);
        if (sudden || error.way > tolerance) {
            whole->snaps++;
            whole->jump = cpsi_larger(whole->jump, longest);
        }
        stretch->known = true;
        at = end;
        if (error.way <= EASY*tolerance && error.tension <= EASY*tolerance) part *= 2;
    }
}

void cpsi_line_advance(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options, const CpsiMove *move,
                       CpsiAdvance *room, bool known) {
    const int count = stretches(line, move);
    Stretch stretch = {.known = known};
    for (int k = 0; k < count && !cps_outcome_is_final(stretch.whole.outcome); k++) {
        stretch.from = (double)k/count, stretch.to = (double)(k + 1)/count;
        /* once one part is not certified nothing is gained by cutting the rest */
        const int halvings = cps_outcome_is_certified(stretch.whole.outcome) ? options->solver.halvings : 0;
        advance(line, program, options, move, room, halvings, &stretch);
    }
    line->report = stretch.whole;
}
