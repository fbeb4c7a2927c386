/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan law: read a law, answer velocities with sets of forces and forces with sets of
 * velocities, draw it. */
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/io.h"
#include "capstan/results.h"
#include "law/law_query.h"
#include "law/set_answer.h"
#include "plot_file.h"
#include "printable.h"

typedef struct LawRun {
    const CpsLawFile *file;
    const CpsSet *set; /* NULL: a resistance law */
    const CpsResistance *resistance;
    int n;
    bool json;
    /* every query so far has a mathematical answer; otherwise the command ends with
     * EXIT_NOT_CERTIFIED */
    bool answered;
    CpsError err;
} LawRun;

/* whether the outcome leaves the query without an answer */
static bool is_open(CpsSetOutcome outcome) {
    return outcome == CPS_SET_OUTCOME_NOT_AVAILABLE || outcome == CPS_SET_OUTCOME_INACCURATE;
}

static const char *separator(int i) { return i ? ",\n    " : "\n    "; }

/* ---- the law itself ---- */

/* the set's expression, shortened with an ellipsis where it is long */
static void set_text(const LawRun *run, char *text, size_t size) {
    const size_t length = cps_set_text(run->set, text, size);
    if (length >= size) memcpy(text + size - 4, "...", 4);
}

/* properties of the whole set. A sum over very many contacts is too large for them, though not for
 * its answers. */
static bool query_set(LawRun *run, CpsSetFacts *facts, CpsSetMeasure *measure) {
    if (!run->set || (!run->json && run->n != 2)) return true;
    CpsStatus status = cps_set_facts(run->set, 0, facts, NULL, NULL, &run->err);
    if (status == CPS_OK && run->n == 2 && facts->bounded)
        status = cps_set_measure(run->set, measure, &run->err);
    if (status == CPS_ERR_LIMIT) facts->outcome = CPS_SET_OUTCOME_NOT_AVAILABLE;
    return status == CPS_OK || status == CPS_ERR_LIMIT;
}

static bool print_law(LawRun *run) {
    char text[400];
    CpsComposition composition;
    int line;
    const bool composed = cps_law_file_composition(run->file, &composition, &line);
    const char *kind = run->resistance                          ? "resistance law"
                       : cps_law_file_loaded(run->file) != NULL ? "loaded law"
                                                                : "friction law";
    CpsSetMeasure measure = {.outcome = CPS_SET_OUTCOME_NOT_PLANAR};
    CpsSetFacts facts = {.outcome = CPS_SET_OUTCOME_NOT_AVAILABLE};
    if (!query_set(run, &facts, &measure)) return false;
    if (run->set) set_text(run, text, sizeof text);
    const bool measured = measure.outcome == CPS_SET_OUTCOME_ANSWERED;
    if (!run->json) {
        if (*cps_law_file_title(run->file)) {
            cli_print_text(stdout, cps_law_file_title(run->file), INT_MAX, false);
            putchar('\n');
        }
        printf("%s, %d component%s", kind, run->n, run->n == 1 ? "" : "s");
        if (run->set) printf("\nset of forces: %s", text);
        if (measured)
            printf("\narea %.10g (gap %.2g), perimeter %.10g (gap %.2g)", measure.area,
                   measure.area_gap, measure.perimeter, measure.perimeter_gap);
        if (composed)
            printf("\ncomposition rule (line %d): %s: %s", line, cps_composition_name(composition),
                   cps_composition_text(composition));
        puts("");
        return true;
    }
    fputs("{\"title\": ", stdout);
    cps_json_text(stdout, cps_law_file_title(run->file));
    printf(", \"kind\": \"%s\", \"components\": %d", kind, run->n);
    if (run->set) {
        fputs(", \"set\": ", stdout);
        cps_json_text(stdout, text);
    }
    if (facts.outcome == CPS_SET_OUTCOME_ANSWERED)
        printf(", \"dimension\": %d, \"bounded\": %s", facts.dimension,
               facts.bounded ? "true" : "false");
    if (measured) {
        static const char *const KEY[] = {"area", "area_gap", "perimeter", "perimeter_gap"};
        const double number[] = {measure.area, measure.area_gap, measure.perimeter,
                                 measure.perimeter_gap};
        for (int k = 0; k < 4; k++) {
            printf(", \"%s\": ", KEY[k]);
            law_json_number(number[k], stdout);
        }
    }
    if (composed)
        printf(", \"composition\": {\"condition\": \"%s\", \"line\": %d}",
               cps_composition_name(composition), line);
    return true;
}

/* ---- queries ---- */

/* the dissipated power at V, for a resistance law also phi, which is another number, and the
 * forces */
static CpsStatus query_velocity(LawRun *run, const double *velocity, double *power,
                                double *potential, CpsSet **forces, CpsSetAnswer *answer) {
    if (run->resistance) {
        CpsResistanceValue value = {.potential = NAN};
        CpsStatus status =
            cps_resistance_forces(run->resistance, velocity, 0, forces, answer, &run->err);
        if (status == CPS_OK)
            status = cps_resistance_value(run->resistance, velocity, &value, NULL, &run->err);
        *power = answer->value;
        *potential = value.potential;
        return status;
    }
    const CpsStatus status = cps_set_forces(run->set, velocity, 0, forces, answer, &run->err);
    *power = status == CPS_OK && answer->outcome == CPS_SET_OUTCOME_UNBOUNDED ? INFINITY
                                                                              : answer->value + 0.0;
    return status;
}

/* the velocities at a force */
static CpsStatus query_force(LawRun *run, const double *force, CpsSet **velocities,
                             CpsSetAnswer *answer) {
    return run->set
               ? cps_set_velocities(run->set, force, 0, velocities, answer, &run->err)
               : cps_resistance_velocities(run->resistance, force, velocities, answer, &run->err);
}

/* Whether the answer to a force is a cone. With dry terms alone it is, unless it is a single
 * point. */
static bool is_cone(const LawRun *run, const SetAnswer *about) {
    if (run->set) return true;
    return about->facts.outcome == CPS_SET_OUTCOME_ANSWERED && about->facts.dimension > 0 &&
           cps_resistance_is_dry(run->resistance);
}

/* one velocity with its forces, or one force with its velocities */
static bool print_answer(LawRun *run, bool velocity, const double *asked, int i) {
    bool cone = !velocity && run->set;
    CpsSet *set = NULL;
    CpsSetAnswer answer;
    SetAnswer about = {.n = run->n};
    double power = NAN, potential = NAN;
    CpsStatus status = velocity ? query_velocity(run, asked, &power, &potential, &set, &answer)
                                : query_force(run, asked, &set, &answer);
    if (status == CPS_OK && set) status = law_answer_ask(set, cone, &about, &run->err);
    if (status == CPS_OK && set && !velocity && !cone && is_cone(run, &about)) {
        law_answer_free(&about);
        cone = true;
        status = law_answer_ask(set, cone, &about, &run->err);
    }
    cps_set_release(set);
    if (status != CPS_OK) {
        law_answer_free(&about);
        return false;
    }
    const bool some = answer.outcome == CPS_SET_OUTCOME_ANSWERED;
    run->answered =
        run->answered && !is_open(answer.outcome) && !(some && is_open(about.facts.outcome));
    if (run->json) {
        printf("%s{\"%s\": ", separator(i), velocity ? "velocity" : "force");
        law_json_vector(run->n, asked, stdout);
        if (velocity) {
            fputs(", \"dissipation_W\": ", stdout);
            law_json_number(some ? power : NAN, stdout);
        }
        if (velocity && run->resistance) {
            fputs(", \"potential_W\": ", stdout);
            law_json_number(some ? potential : NAN, stdout);
        }
        printf(", \"%s\": ", velocity ? "forces" : "velocities");
        if (some)
            law_answer_json(&about, cone, stdout);
        else
            printf("{\"outcome\": \"%s\"}", cps_set_outcome_name(answer.outcome));
        fputs(", \"gap\": ", stdout);
        law_json_number(answer.gap, stdout);
        if (velocity) printf(", \"exact\": %s", answer.exact ? "true" : "false");
        fputc('}', stdout);
    } else {
        fputs(velocity ? "velocity " : "force ", stdout);
        law_print_vector(run->n, asked);
        if (velocity && some && !isfinite(power))
            fputs("\n  dissipates more than can be written", stdout);
        if (velocity && some && isfinite(power))
            printf("\n  dissipates %.12g W%s (gap %.2g W)", power, answer.exact ? ", exact" : "",
                   answer.gap);
        if (velocity && run->resistance && some && isfinite(potential))
            printf("; phi = %.12g W", potential);
        fputs(velocity ? "\n  forces: " : "\n  velocities: ", stdout);
        if (some)
            law_answer_print(&about, cone);
        else
            printf("none: %s", cps_set_outcome_text(answer.outcome));
        puts("");
    }
    law_answer_free(&about);
    return true;
}

/* for as many forces as velocities: the residual of each pair */
static bool print_pair(LawRun *run, const double *force, const double *velocity, int i) {
    double gap = NAN, distance = NAN;
    CpsSetResidual r = {.outcome = CPS_SET_OUTCOME_ANSWERED};
    const CpsStatus status =
        run->set
            ? cps_set_residual(run->set, force, velocity, 0, &r, &run->err)
            : cps_resistance_residual(run->resistance, force, velocity, &gap, &distance, &run->err);
    if (status != CPS_OK) return false;
    if (run->set) {
        gap = r.dissipation;
        distance = r.normal_cone;
    }
    if (run->json) {
        printf("%s{\"gap_W\": ", separator(i));
        law_json_number(gap, stdout);
        fputs(", \"distance_N\": ", stdout);
        law_json_number(distance, stdout);
        if (run->set) {
            fputs(", \"outside_N\": ", stdout);
            law_json_number(r.outside, stdout);
            fputs(", \"scale_W\": ", stdout);
            law_json_number(r.scale, stdout);
        }
        fputc('}', stdout);
    } else {
        printf("pair %d: gap %.3g W, distance %.3g N\n", i + 1, gap, distance);
    }
    return true;
}

static bool print_all(LawRun *run, const QueryList *velocity, const QueryList *force) {
    const size_t n = (size_t)run->n;
    if (!print_law(run)) return false;
    if (run->json) fputs(",\n  \"answers\": [", stdout);
    for (int i = 0; i < velocity->count; i++)
        if (!print_answer(run, true, velocity->row + (size_t)i * n, i)) return false;
    for (int i = 0; i < force->count; i++)
        if (!print_answer(run, false, force->row + (size_t)i * n, velocity->count + i))
            return false;
    if (run->json) fputs("]", stdout);
    if (force->count == velocity->count && force->count > 0) {
        if (run->json) fputs(",\n  \"pairs\": [", stdout);
        for (int i = 0; i < force->count; i++)
            if (!print_pair(run, force->row + (size_t)i * n, velocity->row + (size_t)i * n, i))
                return false;
        if (run->json) fputs("]", stdout);
    } else if (force->count > 0 && velocity->count > 0 && !run->json) {
        printf("no pairs: %d velocities and %d forces; pairs are given for as many of each, in the "
               "order given\n",
               velocity->count, force->count);
    }
    if (run->json) puts("}");
    return true;
}

/* ---- the picture ---- */

/* before the first answer: check the axes of the picture */
static int check_picture(const LawRun *run, const CliOptions *options) {
    int axis[2];
    if (options->axes && !options->plot) {
        fprintf(stderr, "capstan law: --axes goes with --plot\n");
        return EXIT_USAGE;
    }
    if (!options->plot || law_plot_axes(options->axes, run->n, axis)) return EXIT_OK;
    cli_printf(
        stderr,
        "capstan law: --axes: found '%.40s', expected two components from 1 to %d, as in 1,2\n",
        options->axes, run->n);
    return EXIT_USAGE;
}

static int draw(LawRun *run, const CliOptions *options, const QueryList *velocity,
                const QueryList *force) {
    CpsLawPicture picture = {.cookie = cps_law_picture_default().cookie,
                             .title = cps_law_file_title(run->file),
                             .velocity_count = velocity->count,
                             .velocity = velocity->row,
                             .force_count = force->count,
                             .force = force->row};
    law_plot_axes(options->axes, run->n, picture.axis);
    return law_plot(run->set, run->resistance, &picture, options->plot);
}

/* ---- the whole answer ---- */

static int answer(LawRun *run, const CliOptions *options) {
    QueryList velocity = {.command = "law", .n = run->n}, force = {.command = "law", .n = run->n};
    int code = check_picture(run, options);
    if (code == EXIT_OK) code = law_query_read(&options->velocity, "velocity", &velocity);
    if (code == EXIT_OK) code = law_query_read(&options->force, "force", &force);
    if (code == EXIT_OK && !print_all(run, &velocity, &force)) code = cli_report(&run->err);
    if (code == EXIT_OK && options->plot) code = draw(run, options, &velocity, &force);
    free(velocity.row);
    free(force.row);
    return code == EXIT_OK && !run->answered ? EXIT_NOT_CERTIFIED : code;
}

int cmd_law(int argc, char **argv) {
    CliOptions options;
    if (!cli_parse(argc, argv, FOR_LAW, "LAW.yaml", &options)) return EXIT_USAGE;

    CpsLawFile *file = NULL;
    CpsError err;
    const int input =
        law_query_check_input("law", options.operand, &options.velocity, &options.force);
    if (input != EXIT_OK) return input;
    if (cps_law_read(options.operand, NULL, &file, &err) != CPS_OK) return cli_report(&err);
    LawRun run = {.file = file,
                  .set = cps_law_file_set(file),
                  .resistance = cps_law_file_resistance(file),
                  .n = cps_law_file_space(file),
                  .json = options.json,
                  .answered = true};
    const int code = answer(&run, &options);
    cps_law_file_destroy(file);
    return code;
}
