/* SPDX-License-Identifier: BSD-3-Clause */
/* The length of a line for a wanted tension (capstan/pretension.h), by static starts of the line
 * alone.
 *
 * The pull at an end falls as the line gets longer, from where it is straight, and may rise again
 * where it hangs deep: it has one minimum. Lengths are tried from the taut side in growing steps,
 * until the pull is below the one wanted; if it rises before, its minimum is looked for by golden
 * section. Where nothing is taut it only rises, and lengths are tried until it is above. Between a
 * length on either side the root is enclosed by false position, with bisection where that is slow.
 */
#include "capstan/pretension.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "capstan/evolve.h"
#include "evolve/points.h"
#include "evolve/ranges.h"
#include "evolve/stiffness_table.h"

/* The first step away from the straight line, and the last one, per distance of the ends or length
 * that weighs what is wanted; each step is twice the one before. The least length that is tried,
 * per length of the section; and one that is well above the distance in which elements end
 * together. */
static const double FIRST = 1e-9, LONGEST = 100, LEAST = 1e-6, SHORTEST = 1e-8;
/* A line that hangs from one place weighs twice the pull; so many times the length that weighs as
 * much as it are tried. The tension with which a shortest line is made is raised so many times. */
static const double HANGS = 4;
enum { TIGHTENINGS = 24 };
/* ln of pull over wanted that is rounding of a static start. */
static const double CLOSE = 1e-12;
/* ... by which it rises where it is not rounding; and beyond which a length does not have the pull:
 * it jumps there. */
static const double RISE = 1e-6, OFF = 1e-6;
enum { MOST_TRIALS = 120, GOLDEN_STEPS = 40 };

typedef struct LengthSearch {
    CpsScene scene; /* of the line alone */
    CpsLine line;   /* with the arrays below */
    const CpsLine *given;
    CpsLineArrays arrays;
    int section, end;
    CpsPull pull;
    double wanted;      /* [N] */
    double nearest, at; /* [N] pull found; [m] */
    CpsError *err;
    CpsStatus status;
} LengthSearch;

/* A length and ln of its pull over the one wanted. */
typedef struct LengthTrial {
    double length, over;
} LengthTrial;

/* [N] */
static double pull_of(const LengthSearch *search, const double force[3]) {
    const Vec3 f = vec3_load(force), g = vec3_load(search->scene.gravity);
    if (search->pull == CPS_PULL_TENSION) return vec3_norm(f);
    return vec3_norm(vec3_reject(f, vec3_scale(1 / vec3_norm(g), g)));
}

static LengthTrial fail_at(LengthSearch *search, double length, const char *what) {
    search->status =
        cpsi_fail(search->err, CPS_ERR_ARGUMENT,
                  "line '%s': pretension: its static start at a length of %.9g m is %s: the length "
                  "cannot be found",
                  search->given->name, length, what);
    return (LengthTrial){length, 0};
}

/* The static start at a length; a line that is too short pulls without bound. */
static LengthTrial try_length(LengthSearch *search, double length) {
    CpsEvolution *evolution = NULL;
    LengthTrial trial = {length, INFINITY};
    if (search->status != CPS_OK) return trial;
    search->line = *search->given;
    cps_line_resize(&search->line, search->section, length, &search->arrays);
    search->status = cps_evolution_create(&search->scene, &evolution, search->err);
    if (search->status == CPS_OK) search->status = cps_evolution_step(evolution, search->err);
    if (search->status == CPS_OK) {
        const CpsLineReport report = cps_evolution_line_report(evolution, 0);
        const double pull = pull_of(search, report.end[search->end].force);
        if (report.outcome == CPS_OUTCOME_SOLVED) {
            trial.over = log(pull / search->wanted);
            if (fabs(trial.over) < fabs(log(search->nearest / search->wanted))) {
                search->nearest = pull;
                search->at = length;
            }
        } else if (report.outcome != CPS_OUTCOME_INFEASIBLE && report.outcome != CPS_OUTCOME_TAUT) {
            trial = fail_at(search, length, cps_outcome_name(report.outcome));
        }
    }
    cps_evolution_destroy(evolution);
    return trial;
}

static CpsStatus none(const LengthSearch *search) {
    if (!isfinite(search->nearest))
        return cpsi_fail(search->err, CPS_ERR_ARGUMENT,
                         "line '%s': pretension: found no length with %g N at end %s: the line has "
                         "a tension at none of those tried",
                         search->given->name, search->wanted, cpsi_end_letter(search->end));
    return cpsi_fail(search->err, CPS_ERR_ARGUMENT,
                     "line '%s': pretension: found no length with %g N at end %s: the nearest is "
                     "%g N, at %.9g m",
                     search->given->name, search->wanted, cpsi_end_letter(search->end),
                     search->nearest, search->at);
}

/* The least pull between lengths of which the middle one has less than the others. */
static LengthTrial lowest(LengthSearch *search, double low, LengthTrial middle, double high) {
    static const double GOLDEN = 0.3819660112501051;
    for (int k = 0; k < GOLDEN_STEPS && middle.over > 0; k++) {
        const bool left = middle.length - low > high - middle.length;
        const double to = left ? low : high;
        const LengthTrial next = try_length(search, middle.length + GOLDEN * (to - middle.length));
        if (next.over < middle.over) {
            if (left)
                high = middle.length;
            else
                low = middle.length;
            middle = next;
        } else if (left) {
            low = next.length;
        } else {
            high = next.length;
        }
    }
    return middle;
}

/* [m] The length at which the line, pulled straight over the distance, has the tension all along;
 * not positive: the other sections are long enough for that. */
static double straight_length(const LengthSearch *search, double distance, double tension) {
    const CpsLine *line = search->given;
    double natural = 0, pulled = 0;
    if (line->section_count == 0)
        return distance / (1 + cpsi_stiffness_strain(line->stiffness, line->stiffness_row,
                                                     line->stiffness_row_count, tension));
    for (int k = 0; k < line->section_count; k++) {
        const CpsSection *of = &line->section[k];
        if (k == search->section) continue;
        natural += of->length;
        pulled += of->length * (1 + cpsi_stiffness_strain(of->stiffness, of->stiffness_row,
                                                          of->stiffness_row_count, tension));
    }
    if (search->section < 0) return distance * natural / pulled;
    const CpsSection *own = &line->section[search->section];
    return (distance - pulled) / (1 + cpsi_stiffness_strain(own->stiffness, own->stiffness_row,
                                                            own->stiffness_row_count, tension));
}

/* [N] All that pulls the line down, and what lifts it, at its length. */
static double weight_of(const CpsLine *line) {
    double sum = line->section_count == 0 ? line->weight * line->length : 0;
    for (int k = 0; k < line->section_count; k++)
        sum += line->section[k].weight * line->section[k].length;
    for (int k = 0; k < line->point_weight_count; k++) sum += fabs(line->point_weight[k].weight);
    return sum;
}

/* [m] Lengths between which the one looked for lies, and the unit of the steps between. */
typedef struct LengthRange {
    double least, unit, most, hangs; /* hangs: ... of one whose ends are at one place */
} LengthRange;

static LengthRange range_of(const LengthSearch *search, double distance) {
    const CpsLine *line = search->given;
    const double own = search->section < 0 ? line->length : line->section[search->section].length,
                 weight = weight_of(line);
    return (LengthRange){.least = fmax(LEAST * (distance > 0 ? fmin(distance, own) : own),
                                       SHORTEST * line->length),
                         .unit = fmax(distance, LEAST * line->length),
                         .most = LONGEST * distance,
                         .hangs = weight > 0 && distance <= LEAST * line->length
                                      ? HANGS * line->length * search->wanted / weight
                                      : 0};
}

/* The shortest length to try: that of a line which is straight with the pull and its weight, or
 * where more is needed, as over a post or straight up, with more; the least one where the other
 * sections reach. */
static LengthTrial shortest(LengthSearch *search, double distance, double level,
                            const LengthRange *range) {
    const double steep = search->pull == CPS_PULL_HORIZONTAL && level > 0 ? distance / level : 1;
    double tension = steep * (search->wanted + weight_of(search->given));
    LengthTrial trial = {.over = NAN};
    for (int k = 0; k < TIGHTENINGS && search->status == CPS_OK; k++, tension *= 4) {
        const double length = straight_length(search, distance, tension);
        trial = try_length(search, fmax(length, range->least));
        if (trial.over > 0 || !(length > range->least)) break;
    }
    return trial;
}

/* Lengths on either side of the one looked for, the pull of `low` the larger one; false: there are
 * none. A line whose ends are at one place, and one whose other sections reach, may have no taut
 * length: there the pull only rises. */
static bool enclose(LengthSearch *search, Vec3 between, LengthTrial *low, LengthTrial *high) {
    double way[3];
    vec3_store(way, between);
    const double distance = vec3_norm(between), level = pull_of(search, way);
    const LengthRange range = range_of(search, distance);
    *low = shortest(search, distance, level, &range);
    const double from = low->length;
    LengthTrial before = *low, last = *low, least = *low; /* before: the least one */
    for (double more = FIRST * range.unit; search->status == CPS_OK; more *= 2) {
        if (more > range.most && (last.over > 0 || more > range.hangs)) return false;
        const LengthTrial next = try_length(search, from + more);
        if ((last.over > 0) != (next.over > 0)) {
            *low = last.over > 0 ? last : next;
            *high = last.over > 0 ? next : last;
            return search->status == CPS_OK;
        }
        if (last.over > 0 && next.over > least.over + RISE) {
            *high = lowest(search, before.length, least, next.length);
            *low = before;
            return search->status == CPS_OK && high->over <= 0;
        }
        if (next.over < least.over) {
            before = last;
            least = next;
        }
        last = next;
    }
    return false;
}

/* The length between two, by false position: the value at an end that stays is halved. */
static LengthTrial root(LengthSearch *search, LengthTrial low, LengthTrial high) {
    LengthTrial best = fabs(low.over) < fabs(high.over) ? low : high;
    int stayed = 0; /* 1: low has moved last, -1: high */
    for (int k = 0; k < MOST_TRIALS && fabs(best.over) > CLOSE && search->status == CPS_OK; k++) {
        const double width = high.length - low.length;
        const bool bisect = k % 4 == 3 || !isfinite(low.over) || !isfinite(high.over);
        const double share = bisect ? 0.5 : low.over / (low.over - high.over);
        const LengthTrial next = try_length(search, low.length + share * width);
        if (!((next.length > low.length) == (width > 0)) ||
            !((next.length < high.length) == (width > 0)) || next.length == low.length ||
            next.length == high.length)
            break;
        if (fabs(next.over) < fabs(best.over)) best = next;
        if (next.over > 0) {
            if (stayed > 0) high.over *= 0.5;
            low = next;
            stayed = 1;
        } else {
            if (stayed < 0) low.over *= 0.5;
            high = next;
            stayed = -1;
        }
    }
    return best;
}

static CpsStatus check(const CpsScene *scene, int line, int section, int end, CpsPull pull,
                       double wanted, CpsError *err) {
    if (line < 0 || line >= scene->line_count)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "line %d: the scene has %d", line,
                         scene->line_count);
    const CpsLine *of = &scene->line[line];
    if (section < CPS_WHOLE_LINE || section >= of->section_count)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': pretension: found section %d, it has %d", of->name,
                         section + 1, of->section_count);
    if ((end != CPS_END_A && end != CPS_END_B) || (unsigned)pull > CPS_PULL_HORIZONTAL)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': pretension: end %d or pull %d, expected one of the "
                         "enumerations",
                         of->name, end, (int)pull);
    if (!cpsi_is_positive(wanted))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': pretension: found %g N, expected a positive finite number",
                         of->name, wanted);
    if (of->start.kind != CPS_START_STATIC)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': pretension: the line starts as a shape of its length, "
                         "expected a static start",
                         of->name);
    for (int k = 0; k < 2; k++)
        if (of->end[k].kind == CPS_END_KIND_FREE)
            return cpsi_fail(err, CPS_ERR_ARGUMENT,
                             "line '%s': pretension: end %s is free, expected ends that are held "
                             "or at points: the force on a free end is given",
                             of->name, cpsi_end_letter(k));
    if (pull == CPS_PULL_HORIZONTAL && !cpsi_is_direction(scene->gravity))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': pretension: gravity is zero, nothing is horizontal", of->name);
    return CPS_OK;
}

/* The arrays of the search, in one block. */
static void *arrays_for(const CpsLine *line, CpsLineArrays *arrays) {
    const size_t elements = (size_t)line->element_count, sections = (size_t)line->section_count,
                 weights = (size_t)line->point_weight_count, zones = (size_t)line->zone_count;
    char *block = malloc(elements * sizeof(double) + sections * sizeof(CpsSection) +
                         weights * sizeof(CpsPointWeight) + zones * sizeof(CpsFrictionZone));
    if (!block) return NULL;
    arrays->section = (CpsSection *)block;
    arrays->point_weight = (CpsPointWeight *)(arrays->section + sections);
    arrays->zone = (CpsFrictionZone *)(arrays->point_weight + weights);
    arrays->element_length = (double *)(arrays->zone + zones);
    return block;
}

CpsStatus cps_scene_length_for(const CpsScene *scene, int line, int section, int end, CpsPull pull,
                               double wanted, double *length, CpsError *err) {
    if (!length) return cpsi_fail(err, CPS_ERR_ARGUMENT, "length is NULL");
    CpsStatus status = cps_scene_check(scene, err);
    if (status == CPS_OK) status = check(scene, line, section, end, pull, wanted, err);
    CpsiHeldScene held = {.block = NULL};
    if (status == CPS_OK) status = cpsi_held_scene(scene, &held, err);
    if (status != CPS_OK) return status;
    LengthSearch search = {.scene = *scene,
                           .given = &held.scene.line[line],
                           .section = section,
                           .end = end,
                           .pull = pull,
                           .wanted = wanted,
                           .nearest = INFINITY,
                           .err = err};
    search.scene.line = &search.line;
    search.scene.line_count = 1;
    search.scene.point_count = search.scene.body_count = search.scene.stage_count = 0;
    const Vec3 a = vec3_load(search.given->end[CPS_END_A].value),
               b = vec3_load(search.given->end[CPS_END_B].value);
    void *block = arrays_for(search.given, &search.arrays);
    if (!block) search.status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the search");
    LengthTrial low = {0}, high = {0};
    const bool enclosed = block && enclose(&search, vec3_sub(b, a), &low, &high);
    if (search.status == CPS_OK && !enclosed) search.status = none(&search);
    if (search.status == CPS_OK) {
        const LengthTrial found = root(&search, low, high);
        if (search.status == CPS_OK && !(fabs(found.over) <= OFF)) search.status = none(&search);
        if (search.status == CPS_OK) *length = found.length;
    }
    free(block);
    free(held.block);
    return search.status;
}
