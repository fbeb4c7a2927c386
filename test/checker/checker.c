/* SPDX-License-Identifier: BSD-3-Clause */
/* The checks: the claims of each outcome compared with the recomputed quantities. */
#include "checker.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "bodies.h"
#include "carried.h"
#include "caught.h"
#include "elongation.h"
#include "ends.h"
#include "events.h"
#include "failure.h"
#include "grasps.h"
#include "groups.h"
#include "inertia.h"
#include "loads.h"
#include "long_element.h"
#include "measure.h"
#include "motion.h"
#include "pace.h"
#include "passing.h"
#include "places.h"
#include "points.h"
#include "ranges.h"
#include "reach.h"
#include "rounding.h"
#include "sets.h"
#include "settling.h"
#include "winches.h"

/* A balance is accepted when no node is off by more than this part of the largest force: rounding
 * leaves 1e-16 per operation, and a drag over thousands of nodes must not hide in it. The same for
 * friction above its bound, friction off the tangent plane and forces where nothing can carry
 * them. */
static const double FORCE_TOLERANCE = 1e-9;
/* Positions (held ends, depth below the obstacle) per length of the line, and strains: what
 * rounding of the coordinates leaves is taken off first. */
static const double PLACE_TOLERANCE = 1e-9;
/* An imposed position is copied, not computed. */
static const double COPY_TOLERANCE = 1e-12;
/* Claimed figures against recomputed ones: they are reports, six digits are enough; */
static const double CLAIM_TOLERANCE = 1e-6;
/* below these parts of the scale or of the largest force they are rounding and no figure at all. */
static const double ENERGY_FLOOR = 1e-12, FORCE_FLOOR = 1e-12;
/* Below this, in newtons or joules, there is no load at all (a line without weight that nobody
 * pulls). */
static const double NOTHING = 1e-200;
/* Angles of forces and coefficients, recomputed; and a ratio of tensions that is neither here nor
 * there. */
static const double BEND_TOLERANCE = 1e-9;
/* From mu tan(d/2) = 0.9 on a bend locks: (1 + 0.9)/(1 - 0.9) is the ratio of tensions that it
 * holds then. */
static const double LOCKING_RATIO = 19;
/* Taut: the distance of the ends equals the length within this part of it. */
static const double TAUT_TOLERANCE = 1e-12;

/* Paths round an obstacle are the shorter ones. They are those that were taken where an obstacle
 * turns by a quarter of a turn at most in a part of a step, and a node goes round it by no more:
 * this much is rounding of a quarter that is asked for, and of a node that is carried along by
 * it. */
static const double TURN_ROUNDING = 1e-9, GONE_ROUNDING = 2e-6;

typedef struct Findings {
    FILE *log;
    const char *line;
    size_t step;
    int count;
} Findings;

__attribute__((format(printf, 2, 3))) static void find(Findings *findings, const char *format,
                                                       ...) {
    findings->count++;
    if (!findings->log) return;
    va_list list;
    va_start(list, format);
    fprintf(findings->log, "step %zu line %s: ", findings->step, findings->line);
    vfprintf(findings->log, format, list);
    fprintf(findings->log, "\n");
    va_end(list);
}

/* value <= bound, with NaN a finding */
static void at_most(Findings *findings, const char *what, double value, double bound) {
    if (!(value <= bound)) find(findings, "%s is %.6g, allowed %.3g", what, value, bound);
}

static void same(Findings *findings, const char *what, double claimed, double found, double floor) {
    if (!(fabs(claimed - found) <= CLAIM_TOLERANCE * fabs(found) + floor + NOTHING)) {
        find(findings, "claimed %s %.9g, recomputed %.9g (floor %.3g)", what, claimed, found,
             floor);
    }
}

/* Does the file call the step's own equations solved, though its answer is not certified? */
static bool solves_equations_only(const Record *r) {
    return r->outcome == OUTCOME_COARSE || r->outcome == OUTCOME_PASSES;
}

/* Does the file call the step certified, or without a solution? */
static bool claims_something(const Record *r) {
    return r->outcome != OUTCOME_STALLED && r->outcome != OUTCOME_LIMIT &&
           !solves_equations_only(r);
}

/* A step without friction has no bounds to be compared with the reactions. */
static double claimed_residual(const Record *r, const Measures *m) {
    for (size_t c = 0; c < r->contacts * r->nodes + r->elements; c++)
        if (r->friction_bound[c] > 0) return m->bound_residual;
    return r->claim[CLAIM_FRICTION_RESIDUAL] == 0 ? 0 : m->bound_residual;
}

/* A step in one part that makes energy, more than 5 % of what it dissipates and of the positive
 * work in it and more than places known to 1e-9 leave of it, says how much; one that does not says
 * 0. */
static void check_unaccounted(Findings *findings, const Record *r, const Measures *m) {
    static const double MUCH = 0.05;
    const double *entry = r->ledger, made = -entry[LEDGER_IMBALANCE];
    double beside = r->dissipated + fmax(0, entry[LEDGER_ENDS]) + fmax(0, entry[LEDGER_OBSTACLES]) +
                    fmax(0, r->loads ? r->loads->ledger : 0) + fmax(0, r->winch_work) +
                    fmax(0, -entry[LEDGER_ELASTIC]) + fmax(0, -entry[LEDGER_GRAVITY]);
    double least = fmax(MUCH * beside, m->gap + PLACE_TOLERANCE * m->largest_force * m->length +
                                           strain_energy_of_rounding(r, m));
    if (r->unaccounted != 0) same(findings, "unaccounted", r->unaccounted, made, 0);
    if (made > (1 + CLAIM_TOLERANCE) * least && r->unaccounted == 0)
        find(findings, "energy of %.6g J is made beside %.6g J, and not said to be unaccounted",
             made, beside);
    if (made < (1 - CLAIM_TOLERANCE) * least && r->unaccounted != 0)
        find(findings, "energy of %.6g J is said to be unaccounted beside %.6g J", r->unaccounted,
             beside);
}

/* The ledger closes, whatever it says; of a step taken in one part its entries are those of the
 * arrays, but for the work of the ends, which needs the forces before. */
static void check_ledger(Findings *findings, const Record *r, const Measures *m,
                         double ends_carried, double floor) {
    const double *entry = r->ledger;
    const double loads = r->loads ? r->loads->ledger : 0;
    double spent = entry[LEDGER_ELASTIC] + entry[LEDGER_GRAVITY] + r->dissipated +
                   entry[LEDGER_IMBALANCE] - loads + r->time_entry[TIME_GROWTH] +
                   r->time_entry[TIME_SETTLING],
           sizes = r->dissipated + fabs(loads) + fabs(r->time_entry[TIME_SETTLING]);
    for (int k = 0; k < LEDGER_ENTRIES; k++) sizes += fabs(entry[k]);
    sizes += fabs(r->winch_work);
    // entries are sums over the parts, which may cancel but for rounding
    if (r->substeps > 1) sizes += m->largest_force * m->length;
    at_most(findings, "ledger: ends + obstacles - all else",
            fabs(entry[LEDGER_ENDS] + entry[LEDGER_OBSTACLES] + r->winch_work - spent),
            COPY_TOLERANCE * sizes + NOTHING);
    if (r->substeps > 1) return;
    check_unaccounted(findings, r, m);
    if (r->loads) same(findings, "ledger_loads", loads, m->loads, floor + loads_open_work(r));
    if (!loads_are_convex(r)) find(findings, "the potential is no convex function");
    if (!r->winds) {
        same(findings, "ledger_elastic", entry[LEDGER_ELASTIC], m->elastic - r->kept, floor);
        same(findings, "ledger_gravity", entry[LEDGER_GRAVITY], m->gravity, floor);
    }
    same(findings, "ledger_obstacles", entry[LEDGER_OBSTACLES],
         m->carried + m->pushed + ends_carried, floor);
}

/* Forces, tensions and friction of the half elements at the ends; the sums of their dissipation and
 * of their work on the path of obstacles that turn. */
static void check_ends(Findings *findings, const Source *source, const Record *r, const Measures *m,
                       double *slid, double *carried) {
    *slid = *carried = 0;
    for (int e = 0; e < 2; e++) {
        const End end = end_measure(source, r, e);
        const double force = FORCE_TOLERANCE * m->largest_force + NOTHING + inertia_rounding(r, e);
        const double *said = r->end_force[e];
        double off = 0, friction_error = 0;
        for (int k = 0; k < 3; k++) off = fmax(off, fabs(said[k] - (double)end.force[k]));
        for (int k = 0; k < 3; k++)
            friction_error =
                fmax(friction_error, fabs(r->end_friction_force[e][k] - (double)end.friction[k]));
        at_most(findings, "end_force against the half element's balance", off, force);
        at_most(findings, "end_friction_force against the neighbour's per length", friction_error,
                force);
        at_most(findings, "end_tension against the size of end_force",
                fabs(r->end_tension[e] - hypot(hypot(said[0], said[1]), said[2])), force / 1000);
        at_most(findings, "reaction on a held end against what presses there",
                fabs(r->reaction[e ? r->elements : 0] - (double)end.reaction), force);
        *slid += (double)end.slid;
        *carried += (double)end.carried;
    }
}

/* a step of statics: no friction at all */
static bool without_friction(const Record *r) {
    for (size_t c = 0; c < r->contacts * r->nodes + r->elements; c++)
        if (r->friction_bound[c] != 0) return false;
    return true;
}

/* A line that is laid comes from nowhere and has no ledger; the other lines of that step do. */
static bool is_static(const Record *r) {
    bool blank = r->dissipated == 0;
    for (int k = 0; k < LEDGER_ENTRIES; k++) blank = blank && r->ledger[k] == 0;
    return blank && without_friction(r);
}

/* the figures of the certificate; `ends`: what friction dissipates on the half elements at held
 * ends */
static void check_claims(Findings *findings, const Record *r, const Measures *m, double ends) {
    const double *claim = r->claim;
    double energy = ENERGY_FLOOR * m->scale + 1e-13 * m->largest_force * m->extent +
                    strain_energy_of_rounding(r, m) + sets_rounding(r);
    double force = FORCE_FLOOR * m->largest_force;
    bool certified = claims_something(r) || solves_equations_only(r);
    same(findings, "primal", claim[CLAIM_PRIMAL], m->primal, energy);
    same(findings, "dual", claim[CLAIM_DUAL], m->dual, energy);
    same(findings, "scale", claim[CLAIM_SCALE], m->scale, 0);
    same(findings, "force_residual", claim[CLAIM_FORCE_RESIDUAL], m->force, force);
    same(findings, "largest_force", claim[CLAIM_LARGEST_FORCE], m->largest_force, force);
    same(findings, "tension_estimate", claim[CLAIM_TENSION_ESTIMATE], m->tension_estimate,
         force + tension_of_rounding(r, m));
    // the sum of phi(slip); by -F.slip it would differ by the law residual
    if (r->substeps == 1 && !in_time(r)) // in time on another way (inertia.c)
        same(findings, "dissipated", r->dissipated, m->slid + ends, energy + m->law);
    same(findings, "friction_residual", claim[CLAIM_FRICTION_RESIDUAL], claimed_residual(r, m),
         force * (double)r->nodes);
    same(findings, "penetration", claim[CLAIM_PENETRATION], m->depth,
         COPY_TOLERANCE * (m->length + m->reach));
    same(findings, "element_penetration", claim[CLAIM_ELEMENT_PENETRATION], m->pierced,
         COPY_TOLERANCE * (m->length + m->reach));
    // what lies outside its set, a force or a place, makes a gap larger here and not everywhere:
    // where that is no more than rounding there must be agreement
    if (!certified) return;
    same(findings, "gap", claim[CLAIM_GAP], m->gap, energy + m->overlong + m->beyond);
    same(findings, "element_push", claim[CLAIM_ELEMENT_PUSH], m->push, force);
    // last bits of the coordinates over the length of each element, of which a winch may have paid
    // out hardly any; an element without any force may be longer by 1e-12, which is none
    same(findings, "elongation_residual", claim[CLAIM_ELONGATION_RESIDUAL], m->elongation,
         4 * m->strain_rounding + (m->largest_force > 0 ? 1e-14 : 1e-12));
    same(findings, "law_residual", claim[CLAIM_LAW_RESIDUAL], m->law, energy + m->beyond);
    same(findings, "contact_residual", claim[CLAIM_CONTACT_RESIDUAL], m->contact, energy);
    // sqrt(2 gap / (c L)) of a gap known up to the floor
    double noise = sqrt(2 * (energy + m->beyond + NOTHING) / (r->least_compliance * m->length));
    if (r->compliance > 0 && isnan(claim[CLAIM_TENSION_BOUND])) {
        // no bound is claimed where it would exceed every force
        at_most(findings, "largest force, without a bound", m->largest_force,
                m->tension_bound + noise);
    } else if (r->compliance > 0) {
        same(findings, "tension_bound", claim[CLAIM_TENSION_BOUND], m->tension_bound, noise);
    } else {
        same(findings, "stretch_residual", fmax(claim[CLAIM_STRETCH_RESIDUAL], 0),
             fmax(m->stretch, 0), PLACE_TOLERANCE / 10);
    }
}

/* How near to its breaking load the line is, whatever the outcome: at an element's middle by the
 * force in it, at an end by the force there. */
static void check_utilisation(Findings *findings, const Record *r) {
    if (!r->breaking_load) return;
    const size_t last = r->elements - 1;
    double most = 0, arc = 0, there = 0;
    for (size_t i = 0; i <= last; i++) {
        const double own = r->tension[i] / r->breaking_load[i], l = r->element_length[i];
        most = fmax(most, own);
        if (fabs(arc + l / 2 - r->utilisation_at) <= 1e-9 * l) there = fmax(there, own);
        arc += l;
    }
    const double at_end[2] = {r->end_tension[0] / r->breaking_load[0],
                              r->end_tension[1] / r->breaking_load[last]};
    for (int e = 0; e < 2; e++) {
        most = fmax(most, at_end[e]);
        if (fabs(r->utilisation_at - (e ? arc : 0)) <= 1e-9 * arc) there = fmax(there, at_end[e]);
    }
    if (!(fabs(r->utilisation - most) <= 1e-12 * most))
        find(findings, "utilisation is %.9g, recomputed %.9g", r->utilisation, most);
    else if (!(there >= (1 - 1e-12) * most))
        find(findings, "utilisation at %.9g m is %.9g, not the largest, %.9g", r->utilisation_at,
             there, most);
}

/* a solved step: admissible configuration, admissible forces, balance, gap */
static void check_solved(Findings *findings, const Source *source, const Record *r,
                         const Measures *m, bool laid) {
    /* on curved ground elongations are those of the last round and as good as the certified gap
     * says: no element's share (d - c |p|)^2 l/(2 c) exceeds it */
    double tolerance = source->tolerance, element = m->length / (double)r->elements;
    double strain = PLACE_TOLERANCE +
                    (source->follows ? sqrt(2 * r->largest_compliance * m->gap / element) : 0);
    double force = FORCE_TOLERANCE * m->largest_force + NOTHING,
           place = PLACE_TOLERANCE * m->length;
    at_most(findings, "sum of local gaps", m->gap,
            tolerance * m->scale + strain_energy_of_rounding(r, m) +
                contact_work_of_rounding(r, m) + NOTHING);
    at_most(findings, "primal - dual against the local gaps", fabs(m->identity),
            m->identity_noise + NOTHING);
    // an element that pushes with P costs 2 P l of the gap, one too long by x only l x^2/(2c): the
    // tolerance, and its root
    at_most(findings, "elements that push", m->push, tolerance * m->largest_force + NOTHING);
    at_most(findings, "elongation that no force explains", m->elongation, sqrt(tolerance));
    at_most(findings, "imbalance of forces", m->force, force);
    at_most(findings, "friction above its bound", m->friction_excess, force);
    at_most(findings, "friction along the normal", m->friction_normal, force);
    at_most(findings, "force without an obstacle or on a held end", m->stray_force, force);
    at_most(findings, "adhesion (-R)", -m->reaction_least, 0);
    at_most(findings, "compression (-T)", -m->tension_least, 0);
    at_most(findings, "depth below the obstacle", m->penetration, place);
    // contact of the reference keeps out only what the reference touches
    if (!source->touching_only) at_most(findings, "depth below an obstacle", m->sunk, place);
    if (!source->touching_only)
        at_most(findings, "depth of an element inside an obstacle", m->pierced, place);
    at_most(findings, "contacts that are not with the nearest obstacles", m->misplaced, 0);
    at_most(findings, "normal against the obstacle's", m->normal_error, COPY_TOLERANCE);
    at_most(findings, "place of an element's contact against the nearest", m->share_error,
            COPY_TOLERANCE * (m->length + m->reach));
    at_most(findings, "slip against the path from the reference", m->slip_error,
            COPY_TOLERANCE * (m->length + m->reach));
    at_most(findings, "quarters of a turn of an obstacle in one part", m->quarters,
            1 + TURN_ROUNDING);
    at_most(findings, "quarters of a turn of an obstacle by the number of parts",
            m->quarters / (r->share * r->substeps), 1 + TURN_ROUNDING);
    at_most(findings, "quarters of a turn that a node with friction went", m->gone_quarters,
            1 + GONE_ROUNDING);
    at_most(findings, "contact_gap against the distance", m->gap_error,
            COPY_TOLERANCE * (m->length + m->reach));
    // statics keeps a line out of everything, with contact of the reference as well
    if (!(laid && source->touching_only))
        at_most(findings, "contacts not looked for", m->unwatched, 0);
    at_most(findings, "elongation beyond the tension", m->strain_error, strain);
    at_most(findings, "distance of a held end", m->held_error,
            COPY_TOLERANCE * (m->length + m->extent));
    for (int e = 0; e < 2; e++) {
        char text[160];
        if (range_is_wrong(source, r, e, m->largest_force, text, sizeof text))
            find(findings, "%s", text);
    }
    double slid, carried;
    at_most(findings, "grasp_force against the balance of its node", grasps_force_error(r),
            FORCE_TOLERANCE * m->largest_force + NOTHING);
    check_ends(findings, source, r, m, &slid, &carried);
    check_claims(findings, r, m, slid);
    if (!laid && !in_time(r))
        check_ledger(findings, r, m, carried,
                     ENERGY_FLOOR * m->scale + 1e-13 * m->largest_force * m->reach +
                         strain_energy_of_rounding(r, m));
}

static void check_taut(Findings *findings, const Record *r, const Measures *m) {
    if (r->compliance != 0)
        find(findings, "taut, but the line is elastic (compliance %.3g)", r->compliance);
    Span span = {.distance = NAN};
    longest_span(r, &span);
    at_most(findings, "distance of the ends - length", fabs(span.distance - span.length),
            TAUT_TOLERANCE * m->length + 1e-15 * m->extent);
    at_most(findings, "stretch", m->strain_error, PLACE_TOLERANCE);
    at_most(findings, "distance of a held end", m->held_error,
            COPY_TOLERANCE * (m->length + m->extent));
    at_most(findings, "depth below the obstacle", m->penetration, PLACE_TOLERANCE * m->length);
}

/* the ends are near enough to each other, but an obstacle is between them */
static void check_reach(Findings *findings, const Source *source, const Record *r,
                        const Measures *m, bool statics) {
    double missing, off;
    if (r->compliance != 0)
        find(findings, "infeasible, but the line is elastic (compliance %.3g)", r->compliance);
    const char *what = reach_contradiction(source, r, statics, &missing, &off);
    if (what) {
        find(findings, "infeasible, but %s", what);
        return;
    }
    // the coordinates are about the obstacle there, which may be far larger than the line
    double size = m->length + m->extent + (double)source->surface[r->proof_obstacle].radius;
    same(findings, "proof_length", r->proof_length, missing, COPY_TOLERANCE * size);
    at_most(findings, "proof vector off the shortest path", off, CLAIM_TOLERANCE);
    at_most(findings, "length of the proof vector - 1",
            fabs(hypot(hypot(r->proof[0], r->proof[1]), r->proof[2]) - 1), COPY_TOLERANCE);
}

/* ... or a single element is too long to go round it */
static void check_long_element(Findings *findings, const Source *source, const Record *r,
                               const Measures *m) {
    double deep;
    if (r->compliance != 0)
        find(findings, "infeasible, but the line is elastic (compliance %.3g)", r->compliance);
    const char *what = long_element_contradiction(source, r, &deep);
    if (what) {
        find(findings, "infeasible, but %s", what);
        return;
    }
    double size = m->length + m->extent + (double)source->surface[r->proof_obstacle].radius;
    same(findings, "proof_length", r->proof_length, deep, COPY_TOLERANCE * size);
}

/* ... or the line cannot get out from between the obstacle and a plane */
static void check_caught(Findings *findings, const Source *source, const Record *r,
                         const Measures *m) {
    double missing;
    if (r->compliance != 0)
        find(findings, "infeasible, but the line is elastic (compliance %.3g)", r->compliance);
    const char *what = caught_contradiction(source, r, &missing);
    if (what) {
        find(findings, "infeasible, but %s", what);
        return;
    }
    double size = m->length + m->extent + (double)source->surface[r->proof_obstacle].radius;
    same(findings, "proof_length", r->proof_length, missing, COPY_TOLERANCE * size);
}

static void find_number(void *user, const char *what, double said, double expected) {
    find(user, "%s: %.9g, expected %.9g", what, said, expected);
}

/* a constant force t along the unit vector from A to B has the dual value t (distance - length) */
static void check_infeasible(Findings *findings, const Source *source, const Record *r,
                             const Measures *m) {
    if (r->compliance != 0)
        find(findings, "infeasible, but the line is elastic (compliance %.3g)", r->compliance);
    Span span = {.distance = NAN};
    longest_span(r, &span);
    const bool of_sets = r->sets && (r->proof_plane >= 0 || !(span.distance > span.length));
    if (of_sets)
        sets_check_infeasible(source, r, m->length + m->extent, find_number, findings);
    else if (!(span.distance > span.length))
        find(findings, "infeasible, but held nodes are %.17g apart and the length is %.17g",
             span.distance, span.length);
    if (of_sets || !(span.distance > span.length)) return;
    double excess = span.distance - span.length, along = 0;
    for (int k = 0; k < 3; k++)
        along += r->proof[k] * (node_place(r, span.to)[k] - node_place(r, span.from)[k]);
    same(findings, "proof_length", r->proof_length, excess,
         COPY_TOLERANCE * (m->length + m->extent));
    at_most(findings, "proof vector off the line of the ends", span.distance - along,
            PLACE_TOLERANCE * m->length);
    at_most(findings, "proof vector longer than 1",
            hypot(hypot(r->proof[0], r->proof[1]), r->proof[2]) - 1, COPY_TOLERANCE);
}

static void check_unbounded(Findings *findings, const Record *r, const Measures *m) {
    for (size_t j = 0; j < r->nodes; j++)
        if (node_is_held(r, j)) {
            find(findings, "unbounded, but a node is held");
            break;
        }
    double size = hypot(hypot(r->proof[0], r->proof[1]), r->proof[2]);
    at_most(findings, "length of the rigid motion - 1", fabs(size - 1), PLACE_TOLERANCE);
    if (!sets_let(r)) find(findings, "unbounded, but a set holds an end");
    if (!(m->rigid_fall > 0))
        find(findings, "unbounded, but the energy falls by %.3g N along the proof", m->rigid_fall);
    if (m->meets) find(findings, "unbounded, but the line meets an obstacle on its path");
    at_most(findings, "rigid motion into the obstacle", -m->rigid_rise_least, COPY_TOLERANCE);
    same(findings, "proof_force", r->proof_force, m->rigid_fall, FORCE_FLOOR * m->largest_force);
}

static void check_slides(Findings *findings, const Source *source, const Record *r) {
    double power;
    const char *what = motion_contradiction(source, r, &power);
    if (what)
        find(findings, "slides without end, but %s", what);
    else
        same(findings, "proof_force", r->proof_force, power, 0);
}

/* Contact is seen from where the nodes end up, but from the reference on one plane, where it is the
 * same, and where friction is frozen and contact of the reference; frozen friction itself always
 * from the reference, but in a line laid by statics. */
static Measures measure_where(const Source *source, const Record *r, size_t step) {
    const Sight frozen = source->touching_only ? SIGHT_REFERENCE : SIGHT_FROZEN;
    Measures m = measure(source, r,
                         !source->follows     ? SIGHT_REFERENCE
                         : source->consistent ? SIGHT_REACHED
                                              : frozen);
    if (source->consistent || !source->follows || !source->has_static || step > 0) return m;
    Measures laid = measure(source, r, SIGHT_REACHED);
    return laid.normal_error <= m.normal_error && laid.slip_error <= m.slip_error ? laid : m;
}

/* The sharpest bend, and whether the mesh is too coarse for it. Of a step in several parts the
 * sharpest may have been in an earlier one. */
static void check_bend(Findings *findings, const Record *r, const Measures *m) {
    const Bend *bend = &m->bend;
    bool coarse = r->outcome == OUTCOME_COARSE, whole = r->substeps == 1;
    if (r->outcome == OUTCOME_SOLVED && bend->ratio > LOCKING_RATIO * (1 + BEND_TOLERANCE))
        find(findings, "certified, but friction at one contact holds tensions in the ratio %.6g",
             bend->ratio);
    if (!whole) return;
    if (coarse && bend->ratio < LOCKING_RATIO * (1 - BEND_TOLERANCE))
        find(findings,
             "mesh too coarse, but friction at one contact holds tensions in the ratio %.6g only",
             bend->ratio);
    same(findings, "bend_turn", r->bend_turn, bend->turn, BEND_TOLERANCE);
    same(findings, "bend_friction", r->bend_friction, bend->friction, BEND_TOLERANCE);
    same(findings, "turn at bend_at", r->bend_turn, bend->there, BEND_TOLERANCE);
}

/* `before` is the step before it, or NULL. */
static void check_record(const Source *source, const Record *r, const Record *before,
                         const char *line, size_t step, FILE *log, CheckerReport *report) {
    Findings findings = {log, line, step, 0};
    Measures m = measure_where(source, r, step);
    if (source->moves && !m.missing) m.pushed = (double)places_work(source, r, before);
    const char *wrong;
    bool laid;
    report->records++;
    report->outcome[r->outcome]++;
    if (m.missing) {
        find(&findings, "%s holds a value that cannot be (NaN, infinite or negative)", m.missing);
        report->not_finite++;
    } else {
        if (r->proof_length != 0 && r->outcome != OUTCOME_INFEASIBLE)
            find(&findings, "proof_length of a line that is not infeasible");
        if (r->proof_plane >= 0 && r->outcome != OUTCOME_INFEASIBLE)
            find(&findings, "proof_plane of a line that is not infeasible");
        if (r->proof_force != 0 && r->outcome != OUTCOME_UNBOUNDED && r->outcome != OUTCOME_SLIDES)
            find(&findings, "proof_force of a line that is neither unbounded nor slides");
        check_utilisation(&findings, r);
        switch (r->outcome) {
        case OUTCOME_SOLVED:
        case OUTCOME_COARSE: // solved as well, but for the mesh
        case OUTCOME_PASSES: // ... and but for the path
            laid = source->has_static && step == 0 && is_static(r);
            check_solved(&findings, source, r, &m, laid);
            check_bend(&findings, r, &m);
            wrong = passing_contradiction(source, r, laid);
            if (wrong) find(&findings, "%s", wrong);
            break;
        case OUTCOME_TAUT: check_taut(&findings, r, &m); break;
        case OUTCOME_INFEASIBLE:
            if (groups_claim(r)) break; // checked with the points
            if (r->proof_plane >= 0 && (r->proof_obstacle >= 0 || !r->sets))
                check_caught(&findings, source, r, &m);
            else if (r->proof_obstacle >= 0 && r->proof[0] == 0 && r->proof[1] == 0 &&
                     r->proof[2] == 0)
                check_long_element(&findings, source, r, &m);
            else if (r->proof_obstacle >= 0)
                check_reach(&findings, source, r, &m, source->has_static && step == 0);
            else
                check_infeasible(&findings, source, r, &m);
            break;
        case OUTCOME_UNBOUNDED:
            if (!groups_claim(r)) check_unbounded(&findings, r, &m);
            break;
        case OUTCOME_SLIDES: check_slides(&findings, source, r); break;
        default:
            check_claims(&findings, r, &m,
                         (double)(end_measure(source, r, 0).slid + end_measure(source, r, 1).slid));
            break;
        }
    }
    bool claimed = claims_something(r);
    if (findings.count > 0) {
        report->refuted++;
    } else if (claimed) {
        report->certified++;
    } else {
        report->uncertified++;
        if (log) fprintf(log, "step %zu line %s: not certified, as the file says\n", step, line);
    }
    if (r->outcome != OUTCOME_SOLVED || m.missing) return;
    report->gap = fmax(report->gap, m.gap > NOTHING && m.scale > 0 ? m.gap / m.scale : 0);
    report->force = fmax(report->force, m.force > NOTHING ? m.force / m.largest_force : 0);
    report->stretch = fmax(report->stretch, m.stretch);
    report->penetration = fmax(report->penetration, m.penetration / m.length);
}

/* The work of the ends and of the grasps that is nearest to what the file says. It does not say
 * which of the nodes were let go from the force that held them, and which at once. */
static double nearest_work(const Record *r, const Record *before, double said) {
    const double ends = (double)ends_work(r, before);
    double nearest = INFINITY;
    for (unsigned at_once = 0; at_once < 1u << r->grasps; at_once++) {
        const double work = ends + (double)grasps_work(r, before, at_once);
        if (fabs(work - said) < fabs(nearest - said)) nearest = work;
    }
    return nearest;
}

/* The work of the ends needs the forces that they had at the end of the step before. */
static void check_work(const Record *r, const Record *before, const Source *source, size_t step,
                       Findings *findings) {
    if ((r->outcome != OUTCOME_SOLVED && !solves_equations_only(r)) || r->substeps > 1 ||
        before->outcome > OUTCOME_TAUT)
        return;
    const Measures m = measure_where(source, r, step);
    if (m.missing) return;
    const double said = r->ledger[LEDGER_ENDS];
    /* forces that another stiffness has changed are those after it, and so are those of a motion */
    Record as_if = r->settles ? *r : *before;
    for (int e = 0; e < 2 && elongation_jumps(r, before); e++)
        if (r->end_kind[e] == END_HELD)
            for (int k = 0; k < 3; k++) {
                as_if.end_force[e][k] = r->end_force[e][k];
                as_if.end_friction_force[e][k] = r->end_friction_force[e][k];
            }
    same(findings, "ledger_ends", said, nearest_work(r, &as_if, said),
         ENERGY_FLOOR * m.scale + 1e-13 * m.largest_force * m.reach);
}

/* The weight before a step in one part is that after the one before, by the load of node 1. */
static void check_weight(const Record *r, const Record *before, Findings *findings) {
    if (!r->has_weight_before || r->substeps != 1 || before->nodes < 3 ||
        before->outcome > OUTCOME_TAUT)
        return;
    const double share = before->weight_length ? before->weight_length[1]
                                               : (r->element_length[0] + r->element_length[1]) / 2;
    Real own[3] = {before->load[1][0], before->load[1][1], before->load[1][2]};
    node_load(before, 1, own);
    for (int k = 0; k < 3; k++)
        if (!(fabs(share * r->weight_before[k] - (double)own[k]) <=
              1e-14 * fabs(before->load[1][k]))) {
            find(findings, "weight_before is not the weight of the step before");
            return;
        }
}

/* The same of an element's contact, which has no other place where its reaction may have been,
 * unless it is the third contact of a node. */
static void check_element_bound(const Record *r, const Record *before, size_t c, double largest,
                                double shared, bool all, Findings *findings) {
    const bool third = r->share_of[c - r->contacts * r->nodes] == 1;
    const double w = r->friction_bound[c],
                 R = third ? places_reaction_on(before, r, c - r->contacts * r->nodes + 1, c)
                     : before->obstacle[c] == r->obstacle[c] ? before->reaction[c]
                                                             : 0;
    // with the zone's factor at the point where that reaction was
    const double expected = (third ? r->mu[c] : before->mu[c]) * R;
    if (r->obstacle[c] < 0 || (w == 0 && !all && R <= 1e-3 * largest + NOTHING)) return;
    // the mean of two factors, and as of a node
    const size_t i = c - r->contacts * r->nodes;
    double noise = r->factor_noise
                       ? fmax(r->factor_noise[i], r->factor_noise[i + 1]) * R * fmax(1, r->mu[c])
                       : 0;
    // rounds leave the point to 1e-10 of the element, along which the factor changes
    if (r != before && r->factor)
        noise += 1e-9 * fabs(r->factor[i + 1] - r->factor[i]) * R * fmax(1, r->mu[c]);
    if (!(fabs(w - expected) <= 1e-14 * expected + noise + shared))
        find(findings, "friction bound %.9g on element %zu, expected %.9g times the reaction %.9g",
             w, i, before->mu[c], R);
}

/* Rounding in the factor of ground by which friction is multiplied; and the coefficient where the
 * reaction was, with frozen friction at the reference. */
static double ground_coefficient(const Source *source, const Record *r, size_t c, double *noise) {
    const size_t j = c % r->nodes;
    const bool known = r->obstacle[c] >= 0 && r->obstacle[c] < (double)source->surfaces;
    const Surface *on = known ? &source->surface[(size_t)r->obstacle[c]] : NULL;
    if (!on || !on->ground || !on->ground->factor) return r->mu[c];
    const double factor = (r->factor ? r->factor[j] : 1) * (double)surface_friction(on);
    const double *at = source->consistent ? r->position[j] : r->reference[j];
    *noise += factor * ground_factor_noise(on->ground, at, on->point);
    return factor * (double)surface_factor(on, (Real[]){at[0], at[1], at[2]});
}

/* Friction bounds are reactions times the coefficient of the obstacle: the reactions of the step
 * before (frozen friction) or of the step itself (consistent friction), which is `before`. Frozen
 * friction takes nodes that carry less than 1e-3 of the largest load or reaction, or 1e-7 of the
 * largest tension, for free, if it likes; a held node has no friction, nor one that no contact is
 * looked for. */
static void check_bounds(const Source *source, const Record *r, const Record *before,
                         Findings *findings) {
    const size_t contacts = r->contacts * r->nodes + (r->has_elements ? r->elements : 0);
    double largest = 0;
    for (size_t c = 0; c < contacts; c++) {
        const double *b = before->load[c % r->nodes];
        largest = fmax(largest, fmax(before->reaction[c], hypot(hypot(b[0], b[1]), b[2])));
    }
    // where nothing has weight: a node that only just touches has a reaction and a distance of
    // about the root of the loop's 1e-13 each
    if (!source->consistent)
        for (size_t i = 0; i < r->elements; i++) largest = fmax(largest, 1e-4 * before->tension[i]);
    // which nodes a step that is not certified left free is no claim of it either
    const bool known = claims_something(before) || solves_equations_only(before);
    // what is not certified claims nothing; where nothing is found, the reactions are still those
    // of the step before
    if (!claims_something(r) && !solves_equations_only(r)) return;
    bool solved = r->outcome <= OUTCOME_TAUT || solves_equations_only(r);
    // a line free at both ends balances its forces by a last correction of its reactions
    bool loose = r->end_kind[0] == END_FREE && r->end_kind[1] == END_FREE;
    double shared = source->consistent && loose ? FORCE_FLOOR * 10 * largest : 0;
    for (size_t c = 0; c < contacts; c++) {
        if (c >= r->contacts * r->nodes) {
            check_element_bound(r, before, c, largest, shared, source->consistent && solved,
                                findings);
            continue;
        }
        size_t j = c % r->nodes;
        bool held = node_is_held(r, j), was_held = node_is_held(before, j);
        // rounding of a mean over zones; a coefficient above 1 goes with both
        double noise = r->factor_noise ? r->factor_noise[j] * fmax(1, r->mu[c]) : 0;
        double w = r->friction_bound[c], R = places_reaction_on(before, r, j, c),
               mu = ground_coefficient(source, r, c, &noise), expected = mu * R;
        bool free = was_held || !known || R <= 1e-3 * largest + NOTHING;
        if (held || (w == 0 && isinf(r->gap[c]))) continue;
        if (w == 0 && free && !(source->consistent && solved)) continue;
        // one product and its rounding
        if (!(fabs(w - expected) <= 1e-14 * expected + noise * R + shared)) {
            find(findings, "friction bound %.9g at node %zu, expected %.9g times the reaction %.9g",
                 w, j, mu, R);
            return;
        }
    }
}

static void check_winches(const Record *r, const Record *before, const Source *source, size_t step,
                          Findings *findings) {
    const Measures m = measure_where(source, r, step);
    if (r->outcome > OUTCOME_TAUT || m.missing) return;
    for (int e = 0; e < 2; e++)
        if (!isnan(r->stored[e]))
            same(findings, "winch_pull", r->winch_pull[e], (double)winches_pull(source, r, e),
                 FORCE_TOLERANCE * m.largest_force + NOTHING);
    if (!before || r->substeps > 1 || before->outcome > OUTCOME_TAUT) return;
    const WinchLedger own = winches_ledger(source, r, before);
    double floor = ENERGY_FLOOR * m.scale + strain_energy_of_rounding(r, &m) +
                   1e-13 * (m.largest_force * m.reach + (double)own.size);
    same(findings, "ledger_winches", r->winch_work, (double)own.winches, r->winds ? floor : 0);
    if (!r->winds) return;
    same(findings, "ledger_elastic", r->ledger[LEDGER_ELASTIC], (double)own.elastic, floor);
    if (own.known)
        same(findings, "ledger_gravity", r->ledger[LEDGER_GRAVITY], (double)own.gravity, floor);
}

static int check_line(const Source *source, const char *line, FILE *log, CheckerReport *report) {
    Record record = {0}, previous = {0}, older = {0};
    int bad = record_create(source, line, &record, log) ||
              record_create(source, line, &previous, log) ||
              record_create(source, line, &older, log);
    for (size_t step = 0; step < source->steps && !bad; step++) {
        bad = record_read(source, line, step, &record, log);
        if (bad) break;
        const Record *before = step > 0 ? &previous : NULL, *first = step > 1 ? &older : NULL;
        record.winds = step > 0 && winches_wind(&record, &previous);
        settling_begin(&record, before);
        carried_begin(&record, before, first);
        check_record(source, &record, before, line, step, log, report);
        Findings findings = {log, line, step, 0};
        if (step > 0 && record.substeps == 1 && !in_time(&record) &&
            !winches_continue(&record, &previous))
            find(&findings, "the reference is not the position of the step before");
        const char *fault = elongation_rest_fault(&record, before);
        if (fault) find(&findings, "%s", fault);
        inertia_check(source, &record, before, first, find_number, &findings);
        settling_check(source, &record, before, find_number, &findings);
        if (step > 0) events_add(&record, &previous, &report->events);
        if (step > 0 && !in_time(&record)) check_work(&record, &previous, source, step, &findings);
        if (record.outcome <= OUTCOME_TAUT) sets_check(&record, find_number, &findings);
        if (step > 0) check_weight(&record, &previous, &findings);
        if (record.drums) check_winches(&record, before, source, step, &findings);
        // with frozen friction reactions before a first step, or its last part, are not known
        bool statics = step == 0 && source->has_static && without_friction(&record);
        if (!statics && (source->consistent || (step > 0 && record.substeps == 1)))
            check_bounds(source, &record, source->consistent ? &record : &previous, &findings);
        report->refuted += findings.count > 0;
        Record swap = older;
        older = previous;
        previous = record;
        record = swap;
    }
    record_destroy(&record);
    record_destroy(&previous);
    record_destroy(&older);
    return bad;
}

static bool is_certified(int outcome) {
    return outcome != OUTCOME_STALLED && outcome != OUTCOME_LIMIT;
}

/* Findings on points, bodies and releases. */
typedef struct OtherFindings {
    const char *of;
    FILE *log;
    CheckerReport *report;
} OtherFindings;

static void find_at(void *user, const char *name, size_t step, const char *sentence) {
    const OtherFindings *findings = user;
    findings->report->refuted++;
    if (findings->log)
        fprintf(findings->log, "step %zu %s %s: %s\n", step, findings->of, name, sentence);
}

int checker_file(const char *path, CheckerReport *worst, FILE *log) {
    CheckerReport unused, *report = worst ? worst : &unused;
    *report = (CheckerReport){0};
    Source source;
    int bad = source_open(path, &source, log);
    report->steps = bad ? 0 : (int)source.steps;
    if (!bad && source.steps == 0 && log) fprintf(log, "%s holds no step\n", path);
    Findings times = {log, "times", 0, 0};
    if (!bad) bad = pace_check(&source, find_number, &times, log);
    report->refuted += times.count > 0;
    for (size_t i = 0; i < source.lines && !bad; i++)
        bad = check_line(&source, source.line_name[i], log, report);
    OtherFindings point = {"point", log, report}, body = {"body", log, report},
                  release = {"line", log, report};
    if (!bad) bad = points_check(&source, is_certified, find_at, &point, log);
    if (!bad) bad = bodies_check(&source, is_certified, find_at, &body, log);
    if (!bad) bad = failures_check(&source, find_at, &release, log);
    source_close(&source);
    if (bad) report->refuted++;
    if (bad) return 2;
    return report->refuted > 0 || report->uncertified > 0 || report->records == 0;
}
