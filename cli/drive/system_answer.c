/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan drive: systems; one motion per velocity with its proof, all motions and forces, or the
 * reduced law. */
#include "drive/system_answer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "law/set_answer.h"
#include "plot_file.h"
#include "progress.h"

/* All solutions are computed for systems up to the first size, and components are printed up to the
 * second number; JSON contains all components. */
enum { MOST_DENSE = 120, MOST_PRINTED = 24 };

/* ---- JSON ---- */

void drive_json_word(const char *key, const char *text) {
    printf(", \"%s\": ", key);
    cps_json_text(stdout, text);
}

void drive_json(const char *key, double x) {
    printf(", \"%s\": ", key);
    law_json_number(x, stdout);
}

void drive_json_list(const char *key, int n, const double *x) {
    printf(", \"%s\": ", key);
    law_json_vector(n, x, stdout);
}

void drive_json_rows(const char *key, int n, int count, const double *x) {
    printf(", \"%s\": [", key);
    for (int i = 0; i < count; i++) {
        if (i) fputs(", ", stdout);
        law_json_vector(n, x + (size_t)i * (size_t)n, stdout);
    }
    putchar(']');
}

int drive_no_memory(void) {
    fprintf(stderr, "capstan: out of memory\n");
    return EXIT_LIMIT;
}

/* ---- one motion ---- */

/* The set of all V, or of all F: extents of the components. */
typedef struct All {
    int n;
    CpsSolutionSet set;
    double *low, *high;
} All;

/* All solutions for one motion. */
typedef struct Solutions {
    All velocities, forces, resistances;
    bool asked, known, continuous; /* Proposition 2, second half, computed for small systems */
} Solutions;

static int force_components(const CpsSystem *system) {
    int n = 0;
    for (int k = 0; k < cps_system_law_count(system); k++) n += cps_system_law_space(system, k);
    return n;
}

typedef enum Asked { VELOCITIES, FORCES, RESISTANCES } Asked;

/* all solutions of small systems; else an outcome that says that they were not computed */
static bool query_all(DriveRun *run, const CpsMotion *motion, Asked what, All *all) {
    typedef CpsStatus Ask(const CpsMotion *, double, CpsSolutionSet *, double *, double *,
                          CpsError *);
    static Ask *const ASK[] = {cps_motion_velocities, cps_motion_forces, cps_motion_resistances};
    const CpsDriveSystem *s = &run->file->system;
    all->n = what == FORCES       ? force_components(s->system)
             : what == VELOCITIES ? s->parameter_count
                                  : s->driven_count;
    all->set = (CpsSolutionSet){.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    all->low = NULL;
    const CpsMotionOutcome outcome = cps_motion_report(motion).outcome;
    if (s->parameter_count + force_components(s->system) > MOST_DENSE ||
        outcome == CPS_MOTION_OUTCOME_NO_BALANCE || outcome == CPS_MOTION_OUTCOME_BLOCKED ||
        outcome == CPS_MOTION_OUTCOME_NOT_ATTAINED)
        return true;
    all->low = calloc(2 * (size_t)all->n + 1, sizeof *all->low);
    if (!all->low) {
        run->err = (CpsError){.status = CPS_ERR_MEMORY, .message = "out of memory"};
        return false;
    }
    all->high = all->low + all->n;
    return ASK[what](motion, 0, &all->set, all->low, all->high, &run->err) == CPS_OK;
}

static void free_all(All *all) {
    cps_solution_set_clear(&all->set);
    free(all->low);
    all->low = NULL;
}

static void print_all(const All *all, const char *what) {
    if (all->set.outcome != CPS_SET_OUTCOME_ANSWERED)
        printf("  all %s: %s\n", what,
               all->low ? cps_set_outcome_text(all->set.outcome)
                        : "not looked for (no solution, or a large system)");
    else if (all->set.unique)
        printf("  %s: no other\n", what);
    else
        printf("  not unique: the %s are a set of dimension %d\n", what, all->set.dimension);
}

/* Whether the extent of component i exceeds the tolerance. */
static bool is_open(const All *all, int i) {
    const double low = all->low[i], high = all->high[i];
    return !isfinite(low) || !isfinite(high) ||
           high - low > all->set.tolerance * (fabs(low) + fabs(high));
}

/* rounding is printed as 0 */
static double tidy(double x, double scale) { return fabs(x) <= 1e-13 * scale ? 0 : x; }

/* "omega 0", or "omega 0 (from -3.3 to 0)" where it is not unique */
static void print_component(const char *name, double x, double scale, const All *all, int i) {
    printf("%s%s %.10g", i ? ", " : "", name, tidy(x, scale));
    if (all->set.outcome == CPS_SET_OUTCOME_ANSWERED && !all->set.unique &&
        all->high[i] - all->low[i] > all->set.tolerance)
        printf(" (from %.6g to %.6g)", tidy(all->low[i], scale), tidy(all->high[i], scale));
}

static void print_velocity(const CpsDriveSystem *s, const double *v, const All *all) {
    double scale = all->set.outcome == CPS_SET_OUTCOME_ANSWERED ? all->set.tolerance : 0;
    for (int i = 0; i < s->parameter_count; i++) scale = fmax(scale, fabs(v[i]));
    fputs("  V: ", stdout);
    for (int i = 0; i < s->parameter_count && i < MOST_PRINTED; i++)
        print_component(s->parameter[i], v[i], scale, all, i);
    puts(s->parameter_count > MOST_PRINTED ? ", .." : "");
}

static void print_laws(const CpsDriveSystem *s, const CpsMotion *motion, const All *all) {
    for (int k = 0, at = 0; k < cps_system_law_count(s->system) && k < MOST_PRINTED; k++) {
        const int n = cps_system_law_space(s->system, k);
        printf("  %s: force ", cps_system_law_name(s->system, k));
        law_print_vector(n, cps_motion_law_force(motion, k));
        printf(", dissipates %.10g W",
               tidy(cps_motion_law_share(motion, k).dissipated, cps_motion_report(motion).scale));
        if (all->set.outcome == CPS_SET_OUTCOME_ANSWERED)
            for (int i = 0; i < n; i++, at++)
                if (is_open(all, at))
                    printf("; component %d from %.6g to %.6g N", i + 1, all->low[at] + 0.0,
                           all->high[at] + 0.0);
        puts("");
    }
}

/* the other resistances that the device may have; prints nothing where G is unique, or unknown */
static void print_resistances(const All *all) {
    if (all->set.outcome != CPS_SET_OUTCOME_ANSWERED || all->set.unique) return;
    printf("  not unique: the resistances are a set of dimension %d", all->set.dimension);
    for (int i = 0; i < all->n && i < MOST_PRINTED; i++)
        if (is_open(all, i))
            printf("; component %d from %.6g to %.6g N", i + 1, all->low[i] + 0.0,
                   all->high[i] + 0.0);
    puts("");
}

static void print_lambda(const CpsMotion *motion) {
    const int count = cps_motion_constraint_count(motion);
    if (count == 0) return;
    fputs("  constraint forces lambda = ", stdout);
    law_print_vector(count < MOST_PRINTED ? count : MOST_PRINTED,
                     cps_motion_constraint_forces(motion));
    puts(count > MOST_PRINTED ? " .." : "");
}

static void print_not_attained(const CpsDriveSystem *s, const CpsMotion *motion,
                               const All *velocities) {
    const CpsMotionReport r = cps_motion_report(motion);
    printf("  %s\n", cps_motion_outcome_text(r.outcome));
    printf("  gamma = %.8g W is an infimum, between bounds %.2g W apart, and not attained; it is "
           "approached along\n",
           fabs(r.value) <= r.minimum ? 0 : r.value, r.minimum);
    print_velocity(s, cps_motion_direction(motion), velocities);
    printf("  Proposition 1, %s: %s\n", cps_composition_name(r.composition),
           cps_composition_text(r.composition));
}

static void print_motion(DriveRun *run, const CpsMotion *motion, const Solutions *all) {
    const All *velocities = &all->velocities, *forces = &all->forces;
    const CpsDriveSystem *s = &run->file->system;
    const CpsMotionReport r = cps_motion_report(motion);
    if (r.outcome == CPS_MOTION_OUTCOME_NO_BALANCE || r.outcome == CPS_MOTION_OUTCOME_BLOCKED) {
        printf("  no motion: %s\n", cps_motion_outcome_text(r.outcome));
        if (r.outcome == CPS_MOTION_OUTCOME_NO_BALANCE) {
            fputs("  proof, a velocity at which the load runs away:\n", stdout);
            print_velocity(s, cps_motion_velocity(motion), velocities);
        } else {
            fputs("  proof, forces that need no load and resist without bound: G = ", stdout);
            law_print_vector(s->driven_count, cps_motion_resistance(motion));
            puts("");
        }
        return;
    }
    if (r.outcome == CPS_MOTION_OUTCOME_NOT_ATTAINED) {
        print_not_attained(s, motion, velocities);
        return;
    }
    if (isfinite(r.minimum))
        printf("  gamma = %.12g W, proved between bounds %.2g W apart\n", r.value + 0.0, r.minimum);
    else
        printf("  gamma is at most %.12g W; no forces in equilibrium were found that bound it from "
               "below\n",
               r.value + 0.0);
    /* with resistance laws gamma is not the dissipated power */
    if (isfinite(r.minimum) && fabs(r.value + r.load_power - r.dissipated) > 1e-6 * r.scale)
        printf("  gamma is the least of the potential phi less the load's power; the laws "
               "dissipate %.12g W\n",
               r.dissipated);
    if (r.outcome != CPS_MOTION_OUTCOME_SOLVED)
        printf("  note: %s\n", cps_motion_outcome_text(r.outcome));
    print_velocity(s, cps_motion_velocity(motion), velocities);
    print_all(velocities, "velocities");
    fputs("  resistance G = ", stdout);
    law_print_vector(s->driven_count, cps_motion_resistance(motion));
    puts("");
    print_resistances(&all->resistances);
    print_lambda(motion);
    print_laws(s, motion, forces);
    print_all(forces, "forces");
    if (s->loaded) printf("  load: gives %.10g W; ", tidy(r.load_power, r.scale));
    if (s->loaded && isnan(r.load_factor)) puts("how much of it can be balanced is not known");
    if (s->loaded && isfinite(r.load_factor))
        printf("up to %.6g times as much can be balanced\n", r.load_factor);
    if (s->loaded && isinf(r.load_factor)) puts("any multiple of it can be balanced");
    printf("  Proposition 1, %s: %s\n", cps_composition_name(r.composition),
           cps_composition_text(r.composition));
    if (all->asked && all->known && !all->continuous)
        puts("  Proposition 2: phi is continuous at no velocity that agrees with W, and a minimum "
             "of it need not be a motion");
    printf("  residuals: drive %.1e, constraints %.1e, equilibrium %.1e, laws %.1e; power gap %.1e "
           "of %.3g W\n",
           r.drive, r.constraint, r.equilibrium, r.outside, fmax(r.law, 0), r.scale);
}

static void json_all(const char *key, const All *all) {
    printf(", \"%s\": {\"outcome\": \"%s\"", key,
           all->low ? cps_set_outcome_name(all->set.outcome)
                    : cps_set_outcome_name(CPS_SET_OUTCOME_NOT_AVAILABLE));
    if (all->set.outcome == CPS_SET_OUTCOME_ANSWERED) {
        printf(", \"dimension\": %d, \"unique\": %s, \"bounded\": %s", all->set.dimension,
               all->set.unique ? "true" : "false", all->set.bounded ? "true" : "false");
        drive_json_list("low", all->n, all->low);
        drive_json_list("high", all->n, all->high);
        drive_json("tolerance", all->set.tolerance);
    }
    putchar('}');
}

static void json_laws(const CpsDriveSystem *s, const CpsMotion *motion) {
    fputs(", \"laws\": [", stdout);
    for (int k = 0; k < cps_system_law_count(s->system); k++) {
        const int n = cps_system_law_space(s->system, k);
        const CpsMotionShare share = cps_motion_law_share(motion, k);
        fputs(k ? ", {\"name\": " : "{\"name\": ", stdout);
        cps_json_text(stdout, cps_system_law_name(s->system, k));
        drive_json_list("velocity", n, cps_motion_law_velocity(motion, k));
        drive_json_list("force_N", n, cps_motion_law_force(motion, k));
        drive_json("dissipated_W", share.dissipated);
        drive_json("gap_W", share.gap);
        putchar('}');
    }
    putchar(']');
}

static void json_motion(DriveRun *run, const CpsMotion *motion, const Solutions *all) {
    const CpsDriveSystem *s = &run->file->system;
    const CpsMotionReport r = cps_motion_report(motion);
    drive_json_word("outcome", cps_motion_outcome_name(r.outcome));
    drive_json("gamma_W", r.value);
    drive_json("lower_W", r.lower);
    drive_json("upper_W", r.upper);
    drive_json("scale_W", r.scale);
    drive_json("dissipated_W", r.dissipated);
    drive_json_list("V", s->parameter_count, cps_motion_velocity(motion));
    if (r.outcome == CPS_MOTION_OUTCOME_NOT_ATTAINED)
        drive_json_list("direction", s->parameter_count, cps_motion_direction(motion));
    drive_json_list("G", s->driven_count, cps_motion_resistance(motion));
    json_laws(s, motion);
    if (cps_motion_constraint_count(motion) > 0)
        drive_json_list("lambda", cps_motion_constraint_count(motion),
                        cps_motion_constraint_forces(motion));
    json_all("velocities", &all->velocities);
    json_all("forces", &all->forces);
    json_all("resistances", &all->resistances);
    /* only where forces can be in equilibrium; otherwise the condition refers to no forces */
    if (r.outcome != CPS_MOTION_OUTCOME_NO_BALANCE && r.outcome != CPS_MOTION_OUTCOME_BLOCKED)
        drive_json_word("composition", cps_composition_name(r.composition));
    if (all->asked && all->known)
        printf(", \"continuous\": %s", all->continuous ? "true" : "false");
    drive_json("load_power_W", r.load_power);
    drive_json("load_factor", r.load_factor);
    printf(", \"residuals\": {\"drive\": ");
    law_json_number(r.drive, stdout);
    drive_json("constraint", r.constraint);
    drive_json("equilibrium", r.equilibrium);
    drive_json("outside", r.outside);
    drive_json("law_W", r.law);
    drive_json("minimum_W", r.minimum);
    putchar('}');
}

static bool answer_motion(DriveRun *run, const double *velocity, int i) {
    const CpsDriveSystem *s = &run->file->system;
    CpsMotion *motion = NULL;
    Solutions all = {.velocities = {.low = NULL}};
    bool good = cps_system_solve(s->system, velocity, NULL, &motion, &run->err) == CPS_OK &&
                query_all(run, motion, VELOCITIES, &all.velocities) &&
                query_all(run, motion, FORCES, &all.forces) &&
                query_all(run, motion, RESISTANCES, &all.resistances);
    all.asked = s->parameter_count + force_components(s->system) <= MOST_DENSE;
    if (good && all.asked)
        good = cps_motion_continuous(motion, &all.known, &all.continuous, &run->err) == CPS_OK;
    if (good && run->json) {
        printf("%s{\"velocity\": ", i ? ",\n    " : "\n    ");
        law_json_vector(s->driven_count, velocity, stdout);
        json_motion(run, motion, &all);
        putchar('}');
    } else if (good) {
        if (s->driven_count) {
            fputs("velocity W = ", stdout);
            law_print_vector(s->driven_count, velocity);
        }
        puts(s->driven_count ? "" : "nothing is driven");
        print_motion(run, motion, &all);
    }
    const CpsMotionOutcome outcome =
        good ? cps_motion_report(motion).outcome : CPS_MOTION_OUTCOME_SOLVED;
    run->answered &= outcome != CPS_MOTION_OUTCOME_INACCURATE;
    run->none = run->none || outcome == CPS_MOTION_OUTCOME_NO_BALANCE ||
                outcome == CPS_MOTION_OUTCOME_BLOCKED || outcome == CPS_MOTION_OUTCOME_NOT_ATTAINED;
    free_all(&all.velocities);
    free_all(&all.forces);
    free_all(&all.resistances);
    cps_motion_destroy(motion);
    return good;
}

/* ---- the reduced law ---- */

static bool print_reduced(DriveRun *run, const CpsSet *set, const double *asked, bool velocity,
                          int i) {
    const int n = run->file->system.driven_count;
    CpsSet *found = NULL;
    CpsSetAnswer answer;
    SetAnswer about = {.n = n};
    bool good =
        (velocity ? cps_set_forces(set, asked, 0, &found, &answer, &run->err)
                  : cps_set_velocities(set, asked, 0, &found, &answer, &run->err)) == CPS_OK;
    if (good && found) good = law_answer_ask(found, !velocity, &about, &run->err) == CPS_OK;
    const char *key = velocity ? "velocity" : "force";
    if (good && run->json) {
        printf("%s{\"%s\": ", i ? ",\n    " : "\n    ", key);
        law_json_vector(n, asked, stdout);
        if (velocity) drive_json("dissipation_W", found ? answer.value : NAN);
        printf(", \"%s\": ", velocity ? "forces" : "velocities");
        if (found)
            law_answer_json(&about, !velocity, stdout);
        else
            printf("{\"outcome\": \"%s\"}", cps_set_outcome_name(answer.outcome));
        drive_json("gap", answer.gap);
        if (velocity) printf(", \"exact\": %s", answer.exact ? "true" : "false");
        putchar('}');
    } else if (good) {
        printf("%s ", key);
        law_print_vector(n, asked);
        if (velocity && found)
            printf("\n  dissipates %.12g W%s (gap %.2g W)", answer.value + 0.0,
                   answer.exact ? ", exact" : "", answer.gap);
        printf("\n  %s: ", velocity ? "forces" : "velocities");
        if (found)
            law_answer_print(&about, !velocity);
        else
            printf("none: %s", cps_set_outcome_text(answer.outcome));
        puts("");
    }
    const bool open = answer.outcome == CPS_SET_OUTCOME_NOT_AVAILABLE ||
                      answer.outcome == CPS_SET_OUTCOME_INACCURATE;
    if (good) run->answered &= !open;
    law_answer_free(&about);
    cps_set_release(found);
    return good;
}

/* Print the set of forces that balance the load where the reduced set is empty. */
static bool print_empty(DriveRun *run) {
    run->none = true;
    if (run->json)
        printf(", \"components\": %d, \"forces\": {\"outcome\": \"%s\"}",
               run->file->system.driven_count, cps_set_outcome_name(CPS_SET_OUTCOME_EMPTY));
    else
        printf("no reduced law: %s\n", cps_motion_outcome_text(CPS_MOTION_OUTCOME_NO_BALANCE));
    return true;
}

static bool print_elimination(DriveRun *run, const CpsSet *set, CpsComposition composition) {
    CpsSetMeasure measure = {.outcome = CPS_SET_OUTCOME_NOT_PLANAR};
    const int n = run->file->system.driven_count;
    if (n == 2 && cps_set_measure(set, &measure, &run->err) != CPS_OK) return false;
    const bool measured = measure.outcome == CPS_SET_OUTCOME_ANSWERED;
    if (run->json) {
        printf(", \"components\": %d", n);
        drive_json_word("composition", cps_composition_name(composition));
        if (measured) {
            drive_json("area", measure.area);
            drive_json("perimeter", measure.perimeter);
        }
        return true;
    }
    printf("reduced law between W and G, %d component%s\n", n, n == 1 ? "" : "s");
    if (measured)
        printf("set of forces: area %.10g, perimeter %.10g\n", measure.area, measure.perimeter);
    printf("Proposition 1, %s: %s\n", cps_composition_name(composition),
           cps_composition_text(composition));
    return true;
}

static int draw_reduced(DriveRun *run, const CpsSet *set, const QueryList *velocity,
                        const QueryList *force) {
    const CliOptions *options = run->options;
    CpsLawPicture picture = {.cookie = cps_law_picture_default().cookie,
                             .title = run->file->title,
                             .velocity_count = velocity->count,
                             .velocity = velocity->row,
                             .force_count = force->count,
                             .force = force->row};
    const int n = run->file->system.driven_count;
    if (law_plot_axes(options->axes, n, picture.axis))
        return law_plot(set, NULL, &picture, options->plot);
    fprintf(stderr,
            "capstan drive: --plot and --axes: expected two different components from 1 to %d\n",
            n);
    return EXIT_USAGE;
}

/* Whether nothing can balance the load. Near the limit this proof may exist before the set is found
 * to be empty. */
static bool query_balance(DriveRun *run, bool *none) {
    const CpsDriveSystem *s = &run->file->system;
    CpsMotionOptions options = cps_motion_options_default();
    CpsMotion *motion = NULL;
    *none = false;
    if (!s->loaded) return true;
    double *rest = calloc((size_t)s->driven_count, sizeof *rest);
    options.composition = false;
    if (!rest) run->err = (CpsError){.status = CPS_ERR_MEMORY, .message = "out of memory"};
    const bool good =
        rest && cps_system_solve(s->system, rest, &options, &motion, &run->err) == CPS_OK;
    *none = good && cps_motion_report(motion).outcome == CPS_MOTION_OUTCOME_NO_BALANCE;
    cps_motion_destroy(motion);
    free(rest);
    return good;
}

static int answer_reduced(DriveRun *run, const QueryList *velocity, const QueryList *force) {
    CpsSet *set = NULL;
    CpsComposition composition = CPS_COMPOSITION_NOT_SATISFIED;
    CpsSetFacts facts = {.outcome = CPS_SET_OUTCOME_ANSWERED};
    const size_t n = (size_t)run->file->system.driven_count;
    bool empty = false, good = query_balance(run, &empty);
    if (good && !empty)
        good = cps_system_eliminate(run->file->system.system, NULL, &set, &composition,
                                    &run->err) == CPS_OK;
    if (!good) return cli_report(&run->err);
    if (!empty) good = cps_set_facts(set, 0, &facts, NULL, NULL, &run->err) == CPS_OK;
    empty |= facts.outcome == CPS_SET_OUTCOME_EMPTY;
    good = good && (empty ? print_empty(run) : print_elimination(run, set, composition));
    if (run->json) fputs(",\n  \"answers\": [", stdout);
    if (!empty) {
        for (int i = 0; i < velocity->count && good; i++)
            good = print_reduced(run, set, velocity->row + (size_t)i * n, true, i);
        for (int i = 0; i < force->count && good; i++)
            good = print_reduced(run, set, force->row + (size_t)i * n, false, velocity->count + i);
    }
    if (run->json) putchar(']');
    int code = good ? EXIT_OK : cli_report(&run->err);
    if (code == EXIT_OK && run->options->plot && !empty)
        code = draw_reduced(run, set, velocity, force);
    cps_set_release(set);
    return code;
}

/* ---- the whole answer ---- */

static void print_system(const DriveRun *run) {
    const CpsDriveSystem *s = &run->file->system;
    if (!run->json) {
        printf("system of %d parameter%s and %d law%s; driven:", s->parameter_count,
               s->parameter_count == 1 ? "" : "s", cps_system_law_count(s->system),
               cps_system_law_count(s->system) == 1 ? "" : "s");
        for (int i = 0; i < s->driven_count && i < MOST_PRINTED; i++)
            printf("%s %s", i ? "," : "", s->drive[i]);
        puts(s->driven_count ? "" : " nothing");
        return;
    }
    fputs(", \"parameters\": [", stdout);
    for (int i = 0; i < s->parameter_count; i++) {
        if (i) fputs(", ", stdout);
        cps_json_text(stdout, s->parameter[i]);
    }
    fputs("], \"drive\": [", stdout);
    for (int i = 0; i < s->driven_count; i++) {
        if (i) fputs(", ", stdout);
        cps_json_text(stdout, s->drive[i]);
    }
    putchar(']');
}

static void show_progress(void *user, int done, int all) {
    Progress *progress = user;
    progress->steps = all;
    /* a computation of less than a second shows no progress bar */
    if (cli_now() - progress->begun > 1) progress_step(progress, done, "map");
}

static CpsStatus draw_maps(void *user, FILE *out, CpsError *err) {
    DriveRun *run = user;
    Progress progress = progress_begin(1, run->options->quiet);
    const CpsStatus status = cps_drive_draw_system(run->file, show_progress, &progress, out, err);
    progress_end(&progress);
    return status;
}

static int answer_motions(DriveRun *run, const QueryList *velocity) {
    const CpsDriveSystem *s = &run->file->system;
    const int count = s->driven_count ? velocity->count : 1;
    if (run->json) fputs(",\n  \"answers\": [", stdout);
    for (int i = 0; i < count; i++)
        if (!answer_motion(run,
                           s->driven_count ? velocity->row + (size_t)i * (size_t)s->driven_count
                                           : NULL,
                           i))
            return cli_report(&run->err);
    if (run->json) putchar(']');
    if (count == 0 && !run->json)
        puts("nothing asked: add --velocity W, or 'velocity' in the file");
    return run->options->plot ? cli_plot(draw_maps, run, run->options->plot) : EXIT_OK;
}

int drive_answer_system(DriveRun *run) {
    const CpsDriveSystem *s = &run->file->system;
    QueryList velocity = {.command = "drive", .n = s->driven_count},
              force = {.command = "drive", .n = s->driven_count};
    const bool asked = run->options->velocity.count + run->options->force.count > 0;
    if (s->driven_count == 0 && (asked || run->options->eliminate)) {
        fprintf(stderr,
                "capstan drive: nothing is driven in this system: add 'drive' to the file\n");
        return EXIT_USAGE;
    }
    if (run->options->plot && !run->options->eliminate && s->driven_count != 2) {
        fprintf(stderr,
                "capstan drive: --plot draws maps over two driven components; this system has %d: "
                "ask with --velocity, or draw its law with --eliminate\n",
                s->driven_count);
        return EXIT_USAGE;
    }
    int code = law_query_read(&run->options->velocity, "velocity", &velocity);
    if (code == EXIT_OK) code = law_query_read(&run->options->force, "force", &force);
    if (code == EXIT_OK && !asked && s->velocity_count > 0) {
        const size_t size = (size_t)s->velocity_count * (size_t)s->driven_count * sizeof(double);
        velocity.row = malloc(size);
        if (velocity.row) {
            memcpy(velocity.row, s->velocity, size);
            velocity.count = s->velocity_count;
        }
        if (!velocity.row) code = drive_no_memory();
    }
    if (code == EXIT_OK) {
        print_system(run);
        code = run->options->eliminate ? answer_reduced(run, &velocity, &force)
                                       : answer_motions(run, &velocity);
    }
    free(velocity.row);
    free(force.row);
    return code;
}
