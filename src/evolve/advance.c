/* SPDX-License-Identifier: BSD-3-Clause */
/* A load step in parts (advance.h).
 *
 * Friction depends on the path, and a step goes straight from one load to the next. A part of a
 * step is accepted
 *   - when it converged, if the path's accuracy is not asked for;
 *   - when besides going it in two halves leads to the same place and tensions within the path
 *       tolerance, and neither half goes nearly
 *     all the way: the two halves are kept;
 *   - in either case, when it accounts for its energy, or its halves do: equilibria before and
 *       after that lie on different branches
 *     differ by more than was put in. Then the halves are kept.
 * Otherwise it is halved, at most `halvings` times. A part that small is accepted; if it still is
 * not what its halves are it is a snap, and reported: the line jumps by a way that does not get
 * smaller with the load. A part that small which does not converge is not cut further: the rest of
 * the step slides without end, which is proved; or the line goes on as overdamped motion
 * (relaxation.h), a snap as well, and from where it comes to rest as before; or the rest is taken
 * in one go and reported as it is.
 *
 * A way round an obstacle is known only where neither the obstacle turns nor a node goes round it
 * by more than a quarter of a turn (cable/contact.h). A step in which an obstacle turns farther is
 * cut beforehand into equal stretches of a quarter at most, each of which is taken as above. A part
 * in which a node with friction goes farther has not converged. */
#include "evolve/advance.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "cable/bend.h"
#include "cable/contact.h"
#include "evolve/ledger.h"
#include "evolve/relaxation.h"

/* A part whose halves agree this much better than asked is followed by one twice as long. */
static const double EASY = 0.25;

/* Motion that follows the load goes about half its way in each half of a part: 0.71 of it in the
 * one before a limit load, where it grows like a square root, 0.75 where slip grows like the square
 * of the load. A jump goes in one half all its way. */
static const double SUDDEN = 0.9;

/* A line slides without end where the power of its loads is beyond what friction can take by this
 * share. A certified equilibrium may have forces askew by the root of its relative gap of 1e-8, and
 * the power of its loads may be off by as much. */
static const double SLIDES_LEAST = 1e-4;
/* ... by so much that smaller parts need not be tried. */
static const double SLIDES_CLEARLY = 0.01;

/* A part that cannot account for more than this share of what it dissipates and of the positive
 * work in it is taken in halves: of the imbalance that a coarse part leaves when it follows the
 * path this is far above the common one. */
static const double MUCH = 0.05;
/* [-] Places are known to this much of the length: a node so near to an obstacle touches it. */
static const double PLACES = CPSI_TOUCH;
/* ... and strains to this, beside what their coordinates' last digits make. */
static const double ROUNDED_STRAIN = 1e-12;
/* After so many parts as small as may be that cannot either, no more of a step are cut for their
 * energy: it would take all of them, and what is left is reported. */
static const int JUMPS = 8;

/* So many parts of a step may be gone as overdamped motion. */
static const int RELAXATIONS = 8;
/* This share of what is left of a step is not: its end is an equilibrium. */
static const double LAST = 0.0625;

/* So many iterations times nodes spent on parts that are not kept end the cutting of a step, unless
 * its path is asked for: about a second of one processor. Each iteration costs as much as that of
 * some nodes more; a given set of friction forces makes a node dearer. */
static const double IN_VAIN = 2e6, NODES_BESIDE = 30, SET_COST = 30;

/* An angle that is a whole number of quarters but for rounding is that number. */
static const double ROUNDING = 1e-9;

void cpsi_advance_layout(CpsiAdvance *room, CpsiArena *arena, int n, int contacts,
                         bool path_tolerance) {
    const size_t all = (size_t)contacts * (size_t)n;
    room->reaction = CPSI_TAKE(arena, all, double);
    room->tension = CPSI_TAKE(arena, n, double);
    room->state = CPSI_TAKE(arena, all, unsigned char);
    room->on = CPSI_TAKE(arena, all, int);
    room->position = CPSI_TAKE(arena, 3 * (size_t)n, double);
    room->trial = path_tolerance ? CPSI_TAKE(arena, 4 * (size_t)n, double) : NULL;
}

static void save(const CpsiLine *line, CpsiAdvance *room) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    memcpy(room->reaction, line->reaction, contacts * sizeof *line->reaction);
    memcpy(room->tension, line->tension, (n - 1) * sizeof *line->tension);
    memcpy(room->state, line->state, contacts * sizeof *line->state);
    if (line->follows) memcpy(room->on, line->on, contacts * sizeof *line->on);
    memcpy(room->end, line->report.end, sizeof room->end);
    memcpy(room->position, line->position, 3 * n * sizeof *line->position);
}

/* Back to the start of the part. */
static void restore(CpsiLine *line, const CpsiAdvance *room) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    memcpy(line->reaction, room->reaction, contacts * sizeof *line->reaction);
    memcpy(line->tension, room->tension, (n - 1) * sizeof *line->tension);
    memcpy(line->state, room->state, contacts * sizeof *line->state);
    if (line->follows) memcpy(line->on, room->on, contacts * sizeof *line->on);
    memcpy(line->report.end, room->end, sizeof room->end);
    memcpy(line->position, room->position, 3 * n * sizeof *line->position);
}

/* What a part of a step did. */
typedef struct Part {
    CpsLineReport report;
    CpsLedger ledger;
} Part;

/* A step under way: what it is of, and what has been done of it. */
typedef struct Advance {
    CpsiLine *line;
    CpsiChainProgram *program;
    const CpsiStepOptions *options;
    const CpsiMove *move;
    CpsiAdvance *room;
    bool known;     /* the forces at the ends are those of an equilibrium */
    int iterations; /* of everything that was solved, kept or not */
    double in_vain; /* iterations times nodes, of what was not kept, path tolerance apart */
    int relaxed;    /* parts that were tried as overdamped motion */
    int jumps;      /* parts as small as may be whose energy is open */
    CpsLineReport whole;
    CpsLedger ledger;
} Advance;

/* An end at a share of the move. */
static CpsEnd end_at(const CpsiMove *move, int end, double share) {
    CpsEnd at = move->to[end];
    for (int a = 0; a < 3 && share < 1; a++) {
        const double from = move->from[end].value[a];
        at.value[a] = from + share * (at.value[a] - from);
    }
    return at;
}

/* The weight at a share of the move. */
static void weigh(const CpsiMove *move, double share, double weight[3]) {
    for (int a = 0; a < 3; a++) {
        const double from = move->weight_from[a], to = move->weight_to[a];
        weight[a] = share < 1 ? from + share * (to - from) : to;
    }
}

/* What the part of the move from share `from` to share `to` imposes. */
static void impose(const Advance *advance, double from, double to) {
    weigh(advance->move, from, advance->line->weight_before);
    weigh(advance->move, to, advance->line->weight);
    for (int end = 0; end < 2; end++) advance->line->end[end] = end_at(advance->move, end, to);
    for (int k = 0; k < advance->line->obstacle_count; k++)
        advance->room->turn[k] = (to - from) * advance->move->angle[k];
}

/* What the mesh makes of a bend it makes in smaller parts as well. */
static bool is_answer(CpsOutcome outcome) {
    return cps_outcome_is_certified(outcome) || outcome == CPS_MESH_TOO_COARSE;
}

/* The part of the move from share `from` to share `to`. */
static Part take(Advance *advance, double from, double to, bool known) {
    CpsiLine *line = advance->line;
    const CpsiMove *move = advance->move;
    CpsEnd before[2];
    for (int end = 0; end < 2; end++) before[end] = end_at(move, end, from);
    impose(advance, from, to);
    const CpsiLedgerStart start = cpsi_ledger_start(line, before, known);
    cpsi_line_step(line, advance->program, advance->options);
    if (is_answer(line->report.outcome) && cpsi_contact_rounds(line))
        line->report.outcome = CPS_STALLED;
    line->report.share = to - from;
    advance->iterations += line->report.iterations;
    Part part = {0};
    if (!cps_outcome_is_final(line->report.outcome)) part.ledger = cpsi_ledger_close(line, &start);
    part.report = line->report;
    return part;
}

static bool converged(const Part *part) { return is_answer(part->report.outcome); }

/* Add a part to the whole: sums, the worst outcome, else the later state. */
static void add(Advance *advance, const Part *part) {
    CpsLineReport *whole = &advance->whole;
    const CpsLineReport before = *whole;
    *whole = part->report;
    whole->parts = before.parts + 1;
    whole->snaps = before.snaps;
    whole->jump = before.jump;
    whole->unaccounted = before.unaccounted;
    whole->outcome = cps_outcome_worse(before.outcome, whole->outcome);
    if (before.places > whole->places) whole->places = before.places;
    if (cpsi_bend_is_sharper(&before.bend, &whole->bend)) whole->bend = before.bend;
    whole->iterations = advance->iterations;
    whole->dissipated += before.dissipated;
    for (int end = 0; end < 2; end++) whole->end[end].work += before.end[end].work;
    cpsi_ledger_add(&advance->ledger, &part->ledger);
    whole->ledger = advance->ledger;
}

static void keep_trial(const CpsiLine *line, double *trial) {
    for (int j = 0; j < line->n; j++) {
        memcpy(&trial[4 * j], &line->position[3 * j], 3 * sizeof *trial);
        trial[4 * j + 3] = j > 0 ? line->tension[j - 1] : 0;
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
        way = cpsi_larger(way, vec3_norm(vec3_sub(vec3_load(&line->position[3 * j]),
                                                  vec3_load(&trial[4 * j]))));
        if (j > 0) tension = cpsi_larger(tension, fabs(line->tension[j - 1] - trial[4 * j + 3]));
    }
    const double force = line->report.certificate.largest_force;
    return (Apart){way / line->length, force > 0 ? tension / force : 0};
}

/* The energy that a part, or two of them, cannot account for: what it made, and where the path
 * counts what it lost as well; but for what the certificate and the accuracy of places leave open
 * of an energy. */
typedef struct Open {
    double energy, beside; /* [J] it, and dissipated plus positive work */
    double noise;          /* [J] */
} Open;

/* [J] What rounding of coordinates makes of the elongation of a line on which no force acts. */
static double rounding_energy(const CpsiLine *line) {
    if (!(line->compliance > 0)) return 0;
    double reach = 0, shortest = line->length;
    for (int j = 0; j < line->n; j++)
        reach = cpsi_larger(reach, vec3_norm(vec3_load(&line->position[3 * j])));
    for (int e = 0; e + 1 < line->n; e++)
        if (line->element_length[e] < shortest) shortest = line->element_length[e];
    const double strain = ROUNDED_STRAIN + 8 * DBL_EPSILON * reach / shortest;
    return 0.5 * line->length * strain * (strain / line->compliance);
}

static Open open_energy(const Advance *advance, const Part *first, const Part *second) {
    Open open = {0};
    for (int k = 0; k < (second ? 2 : 1); k++) {
        const Part *part = k ? second : first;
        open.energy -= part->ledger.imbalance;
        open.beside += cpsi_ledger_exchanged(&part->ledger);
        const CpsCertificate *found = &part->report.certificate;
        open.noise += found->gap + (found->largest_force > 0
                                        ? PLACES * found->largest_force * advance->line->length
                                        : rounding_energy(advance->line));
    }
    if (advance->options->solver.path_tolerance > 0) open.energy = fabs(open.energy);
    return open;
}

static bool is_open(const Open *open) {
    return open->energy > MUCH * open->beside && open->energy > open->noise;
}

/* A part as it was taken, whole or in its two halves, and what is to be thought of it. */
typedef struct Trial {
    Part first, second;
    bool halved; /* the line is at the end of the second half */
    bool good;   /* converged */
    bool agrees; /* with the halves, as far as they were asked for */
    bool sudden;
    Apart error;
    double longest; /* [m] way of a node in one of the halves */
    Open open;      /* of what is kept */
} Trial;

/* Take the halves of a part that was taken whole. */
static void halve(Advance *advance, double from, double middle, double to, Trial *trial) {
    restore(advance->line, advance->room);
    trial->first = take(advance, from, middle, advance->known);
    trial->longest = cpsi_line_longest_way(advance->line, advance->line->reference);
    if (converged(&trial->first)) trial->second = take(advance, middle, to, true);
    trial->good = converged(&trial->first) && converged(&trial->second);
    trial->halved = true;
}

/* Do the halves account for the energy that the whole part left open? */
static bool closes(const Advance *advance, Trial *trial) {
    const Open whole = trial->open;
    trial->open = open_energy(advance, &trial->first, &trial->second);
    return !is_open(&whole) || (!is_open(&trial->open) && trial->open.energy < 0.5 * whole.energy);
}

/* The path is asked for: the halves are kept, where they lead to the same place. */
static void compare(Advance *advance, double from, double middle, double to, Trial *trial) {
    const double tolerance = advance->options->solver.path_tolerance,
                 whole_way = cpsi_line_longest_way(advance->line, advance->line->reference);
    keep_trial(advance->line, advance->room->trial);
    halve(advance, from, middle, to, trial);
    if (trial->good) trial->error = apart(advance->line, advance->room->trial);
    trial->longest =
        cpsi_larger(trial->longest, cpsi_line_longest_way(advance->line, advance->line->reference));
    trial->sudden =
        trial->longest > SUDDEN * whole_way && trial->longest > tolerance * advance->line->length;
    trial->agrees =
        !trial->sudden && trial->error.way <= tolerance && trial->error.tension <= tolerance;
    if (trial->good && !closes(advance, trial)) trial->agrees = false;
}

/* Energy is open: the halves are kept where they close it. If they do not converge the whole part
 * is all there is. */
static void divide(Advance *advance, double from, double middle, double to, Trial *trial) {
    const Trial whole = *trial;
    halve(advance, from, middle, to, trial);
    trial->agrees = trial->good && closes(advance, trial);
    if (trial->good) return;
    restore(advance->line, advance->room);
    *trial = whole;
    trial->first = take(advance, from, to, advance->known);
}

/* May there be another branch that cutting finds?  With frozen friction a step is one convex
 * problem by definition (S90 P2.1): friction of the reference may make energy in it, and the path
 * says how much that matters, if it is asked for. */
static bool may_branch(const Advance *advance) {
    return advance->options->friction == CPS_FRICTION_CONSISTENT && advance->jumps < JUMPS;
}

/* May the line jump?  Strict contact beside frozen friction has one convex problem for a step, and
 * no path. */
static bool may_relax(const Advance *advance) {
    const CpsiStepOptions *options = advance->options;
    const bool strict =
        options->friction == CPS_FRICTION_FROZEN && options->contact == CPS_CONTACT_STRICT;
    return !strict && advance->relaxed < RELAXATIONS;
}

/* A part of the step; `cut`: it may be made smaller. */
static Trial try_part(Advance *advance, double from, double middle, double to, bool cut) {
    save(advance->line, advance->room);
    Trial trial = {.first = take(advance, from, to, advance->known), .agrees = true};
    trial.good = converged(&trial.first);
    if (!trial.good) return trial;
    trial.open = open_energy(advance, &trial.first, NULL);
    if (advance->options->solver.path_tolerance > 0)
        compare(advance, from, middle, to, &trial);
    else if (cut && may_branch(advance) && is_open(&trial.open))
        divide(advance, from, middle, to, &trial);
    return trial;
}

/* Keep a part, and say of it what cutting could not mend. */
static void keep(Advance *advance, const Trial *trial) {
    CpsLineReport *whole = &advance->whole;
    add(advance, &trial->first);
    if (trial->halved) add(advance, &trial->second);
    advance->known = true;
    if (trial->sudden || trial->error.way > advance->options->solver.path_tolerance) {
        whole->snaps++;
        whole->jump = cpsi_larger(whole->jump, trial->longest);
    } else if (is_open(&trial->open)) {
        whole->unaccounted += trial->open.energy;
        advance->jumps++;
    }
}

/* A stretch of a step. */
typedef struct Stretch {
    double from, to; /* shares of the step */
} Stretch;

/* Where in the step a share of the stretch is. */
static double within(const Stretch *stretch, double share) {
    return share < 1 ? stretch->from + share * (stretch->to - stretch->from) : stretch->to;
}

/* From share `from` to share `to`, the end of a stretch, the line slides without end: what follows
 * is no more than that. */
static bool add_slide(Advance *advance, double from, double to, double margin) {
    impose(advance, from, to);
    if (!cpsi_line_step_slides(advance->line, advance->options, margin)) return false;
    Part part = {0};
    part.report = advance->line->report;
    part.report.share = to - from;
    add(advance, &part);
    return true;
}

/* From share `from` to share `to` as overdamped motion: from there on the line may have an
 * equilibrium again. False where it may not go so, or does not come to rest; then it is where it
 * was. */
static bool relax(Advance *advance, double from, double to) {
    CpsiLine *line = advance->line;
    CpsLineReport *whole = &advance->whole;
    CpsiRelaxation done;
    CpsEnd before[2];
    if (!may_relax(advance)) return false;
    advance->relaxed++;
    for (int end = 0; end < 2; end++) before[end] = end_at(advance->move, end, from);
    impose(advance, from, to);
    const bool rests = cpsi_line_relax(line, advance->program, advance->options, before,
                                       advance->room->turn, advance->known, &done);
    advance->iterations += done.iterations;
    if (!rests) {
        restore(line, advance->room);
        return false;
    }
    whole->parts++;
    whole->snaps++;
    whole->jump = cpsi_larger(whole->jump, cpsi_line_longest_way(line, advance->room->position));
    whole->dissipated += done.dissipated;
    for (int end = 0; end < 2; end++) whole->end[end].work += done.work[end];
    cpsi_ledger_add(&advance->ledger, &done.ledger);
    whole->ledger = advance->ledger;
    advance->known = true;
    return true;
}

/* Is the line too short for where its ends are to be at the end of the step?  Before anything is
 * cut: ends that go straight meet this at the end, if at all, on the way round a cylinder
 * (docs/theory.md 5). */
static bool add_shortfall(Advance *advance) {
    impose(advance, 0, 1);
    if (!cpsi_line_step_falls_short(advance->line, advance->options)) return false;
    Part part = {0};
    part.report = advance->line->report;
    part.report.share = 1;
    add(advance, &part);
    return true;
}

/* What has been solved since there were so many iterations: these times the nodes. What converged
 * is cut alike whatever its friction is given as. */
static double cost_of(const Advance *advance, int before, bool good) {
    const CpsiLine *line = advance->line;
    double nodes = line->n + NODES_BESIDE;
    for (int k = 0; k < line->obstacle_count && !good; k++)
        if (line->obstacle[k].has_set) nodes = fmax(nodes, SET_COST * line->n);
    return (double)(advance->iterations - before) * nodes;
}

/* As add_slide, from the start of the part, to which the line returns if it does not slide. */
static bool end_in_slide(Advance *advance, double from, double to) {
    restore(advance->line, advance->room);
    if (add_slide(advance, from, to, SLIDES_LEAST)) return true;
    restore(advance->line, advance->room);
    return false;
}

/* The rest of a stretch in one go, as it is. */
static void take_rest(Advance *advance, double from, double to) {
    Trial rest = {.first = take(advance, from, to, advance->known)};
    if (converged(&rest.first)) rest.open = open_energy(advance, &rest.first, NULL);
    keep(advance, &rest);
}

/* Take a stretch in parts, each halved up to `halvings` times. */
static void advance_stretch(Advance *advance, Stretch stretch, int halvings) {
    const double tolerance = advance->options->solver.path_tolerance, least = ldexp(1, -halvings);
    for (double at = 0, part = 1;
         at < 1 && !cpsi_interrupt_seen(advance->program->base.interrupt);) {
        const double end = at + part < 1 ? at + part : 1,
                     middle = within(&stretch, at + 0.5 * (end - at));
        const double from = within(&stretch, at), to = within(&stretch, end);
        const int before = advance->iterations;
        const Trial trial = try_part(advance, from, middle, to, part > least);
        if (cps_outcome_is_final(trial.first.report.outcome)) {
            add(advance, &trial.first);
            return;
        }
        const bool kept = trial.good && trial.agrees;
        if (!trial.good || (!kept && tolerance == 0))
            advance->in_vain += cost_of(advance, before, trial.good);
        if (!kept && part > least && advance->in_vain < IN_VAIN) {
            restore(advance->line, advance->room);
            if (!trial.good && part == 1 && add_slide(advance, from, stretch.to, SLIDES_CLEARLY))
                return;
            restore(advance->line, advance->room);
            part *= 0.5;
            continue;
        }
        if (!trial.good) { /* no smaller */
            if (end_in_slide(advance, from, stretch.to)) return;
            const double jump = fmin(ldexp(part, advance->relaxed), (1 - LAST) * (1 - at));
            if (relax(advance, from, within(&stretch, at + jump))) {
                at += jump;
                continue;
            }
            take_rest(advance, from, stretch.to);
            return;
        }
        keep(advance, &trial);
        at = end;
        if (trial.error.way <= EASY * tolerance && trial.error.tension <= EASY * tolerance)
            part *= 2;
    }
}

/* Equal stretches of a step in none of which an obstacle turns by more than a quarter. */
static int stretches(const CpsiLine *line, const CpsiMove *move) {
    double most = 0;
    for (int k = 0; k < line->obstacle_count; k++) most = cpsi_larger(most, fabs(move->angle[k]));
    const double quarters = ceil(most / CPSI_QUARTER - ROUNDING);
    return quarters > 1 ? (int)quarters : 1;
}

void cpsi_line_advance(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                       const CpsiMove *move, CpsiAdvance *room, bool known) {
    Advance advance = {line, program, options, move, room, .known = known};
    const int count = add_shortfall(&advance) ? 0 : stretches(line, move);
    for (int k = 0; k < count && !cps_outcome_is_final(advance.whole.outcome); k++) {
        /* once one part is not certified nothing is gained by cutting the rest */
        const int halvings =
            cps_outcome_is_certified(advance.whole.outcome) ? options->solver.halvings : 0;
        advance_stretch(&advance, (Stretch){(double)k / count, (double)(k + 1) / count}, halvings);
    }
    line->report = advance.whole;
}

void cpsi_line_lay(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                   CpsiAdvance *room) {
    CpsiRelaxation done;
    save(line, room);
    for (int k = 0; k < line->obstacle_count; k++) room->turn[k] = 0;
    const bool short_of = cpsi_line_step_falls_short(line, options);
    if (!short_of) cpsi_line_step(line, program, options);
    int iterations = line->report.iterations;
    if (line->report.outcome == CPS_STALLED) {
        restore(line, room);
        if (!cpsi_line_relax(line, program, options, line->end, room->turn, false, &done))
            restore(line, room);
        cpsi_line_step(line, program, options);
        iterations += done.iterations + line->report.iterations;
    }
    line->report.iterations = iterations;
    line->report.parts = 1;
    line->report.share = 1;
}
