/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets as answers (see set_answer.h). */
#include "law/set_answer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A larger number of vertices or rays is counted, not listed. */
enum { MOST_LISTED = 64 };

static const double DEGREES = 57.295779513082320877;

/* ---- numbers ---- */

void law_print_vector(int n, const double *x) {
    putchar('(');
    for (int i = 0; i < n; i++) printf("%s%.10g", i ? ", " : "", x[i] + 0.0);
    putchar(')');
}

void law_json_number(double x, FILE *out) { cps_json_number(out, x + 0.0); } /* x + 0.0 avoids -0 */

void law_json_vector(int n, const double *x, FILE *out) {
    fputc('[', out);
    for (int i = 0; i < n; i++) {
        if (i) fputs(", ", out);
        law_json_number(x[i], out);
    }
    fputc(']', out);
}

/* ---- queries ---- */

static bool take_block(SetAnswer *a) {
    const size_t n = (size_t)a->n;
    a->block = calloc(2 * n * n + 3 * n + 2 * MOST_LISTED * n, sizeof *a->block);
    if (!a->block) return false;
    a->centre = a->block;
    a->low = a->centre + n;
    a->high = a->low + n;
    a->vertex = a->high + n;
    a->ray = a->vertex + MOST_LISTED * n;
    a->basis = a->ray + MOST_LISTED * n;
    a->line = a->basis + n * n;
    return true;
}

/* a segment's centre is its middle */
static void take_middle(SetAnswer *a) {
    double along = 0.5 * (a->low[0] + a->high[0]);
    for (int i = 0; i < a->n; i++) along -= a->basis[i] * a->centre[i];
    for (int i = 0; i < a->n; i++) a->centre[i] += along * a->basis[i];
}

/* The pointed part of a cone, normal to its lines: rays where it has dimension 1 or 2, and the
 * lines in both directions. */
static CpsStatus query_pointed(const CpsSet *cone, SetAnswer *a, CpsError *err) {
    const size_t n = (size_t)a->n, lines = (size_t)a->lineality;
    CpsSet *across = NULL, *pointed = NULL;
    CpsSetAnswer listed;
    int count = 0;
    CpsStatus status =
        cps_set_subspace(a->n, a->n - a->lineality, a->line + lines * n, &across, err);
    if (status == CPS_OK)
        status = cps_set_intersection(2, (const CpsSet *const[]){cone, across}, &pointed, err);
    if (status == CPS_OK && a->facts.dimension > a->lineality)
        status = cps_set_rays(pointed, 0, MOST_LISTED, a->ray, &count, &listed, err);
    const bool known = status == CPS_OK && (a->facts.dimension == a->lineality ||
                                            listed.outcome == CPS_SET_OUTCOME_ANSWERED);
    if (known && (size_t)count + 2 * lines <= MOST_LISTED) {
        a->ray_count = count;
        for (size_t k = 0; k < 2 * lines; k++)
            for (size_t i = 0; i < n; i++) {
                a->ray[(size_t)a->ray_count * n + i] = (k % 2 ? -1 : 1) * a->line[k / 2 * n + i];
                a->ray_count += i == n - 1;
            }
    }
    cps_set_release(across);
    cps_set_release(pointed);
    return status;
}

/* The largest subspace in a cone N: the intersection of N and -N. */
static CpsStatus query_lines(const CpsSet *cone, SetAnswer *a, CpsError *err) {
    CpsSet *turned = NULL, *both = NULL;
    CpsSetFacts facts = {.outcome = CPS_SET_OUTCOME_INACCURATE};
    CpsStatus status = cps_set_scale(-1, cone, &turned, err);
    if (status == CPS_OK)
        status = cps_set_intersection(2, (const CpsSet *const[]){cone, turned}, &both, err);
    if (status == CPS_OK) status = cps_set_facts(both, 0, &facts, NULL, a->line, err);
    if (status == CPS_OK && facts.outcome == CPS_SET_OUTCOME_ANSWERED)
        a->lineality = facts.dimension;
    cps_set_release(turned);
    cps_set_release(both);
    return status == CPS_OK && a->lineality > 0 ? query_pointed(cone, a, err) : status;
}

CpsStatus law_answer_ask(const CpsSet *set, bool cone, SetAnswer *a, CpsError *err) {
    *a = (SetAnswer){.n = cps_set_space(set), .vertex_count = -1, .ray_count = -1};
    if (!take_block(a)) {
        *err = (CpsError){.status = CPS_ERR_MEMORY, .message = "out of memory"};
        return CPS_ERR_MEMORY;
    }
    CpsStatus status = cps_set_facts(set, 0, &a->facts, a->centre, a->basis, err);
    if (status != CPS_OK || a->facts.outcome != CPS_SET_OUTCOME_ANSWERED) return status;
    if (!cone)
        for (int i = 0; i < a->facts.dimension && status == CPS_OK; i++) {
            CpsSetExtent extent;
            status = cps_set_extent(set, a->basis + (size_t)i * (size_t)a->n, &extent, err);
            if (status != CPS_OK) break;
            a->low[i] = extent.low;
            a->high[i] = extent.high;
            a->gap = fmax(a->gap, extent.gap);
        }
    if (status == CPS_OK && !cone && a->facts.dimension == 1 && a->facts.bounded) take_middle(a);

    /* what can be listed: the rays of a cone, the corners of a bounded set */
    CpsSetAnswer listed;
    int count = 0;
    if (status == CPS_OK && cone) {
        status = cps_set_rays(set, 0, MOST_LISTED, a->ray, &count, &listed, err);
        if (status == CPS_OK && listed.outcome == CPS_SET_OUTCOME_ANSWERED) a->ray_count = count;
        if (status == CPS_OK && a->facts.dimension > 0) status = query_lines(set, a, err);
    } else if (status == CPS_OK && a->facts.bounded) {
        status = cps_set_vertices(set, 0, MOST_LISTED, a->vertex, &count, &listed, err);
        if (status == CPS_OK && listed.outcome == CPS_SET_OUTCOME_ANSWERED) a->vertex_count = count;
    }
    return status;
}

void law_answer_free(SetAnswer *answer) {
    free(answer->block);
    answer->block = NULL;
}

/* ---- text ---- */

static void print_list(const SetAnswer *a, const double *x, int count) {
    for (int i = 0; i < count && i < MOST_LISTED; i++) {
        fputs(i ? ", " : " ", stdout);
        law_print_vector(a->n, x + (size_t)i * (size_t)a->n);
    }
    if (count > MOST_LISTED) fputs(", ...", stdout);
}

static void print_extents(const SetAnswer *a) {
    for (int i = 0; i < a->facts.dimension; i++) {
        printf("\n    along ");
        law_print_vector(a->n, a->basis + (size_t)i * (size_t)a->n);
        printf(": from %.10g to %.10g", a->low[i], a->high[i]);
    }
}

/* degrees between two unit vectors */
static double angle(const SetAnswer *a, const double *u, const double *v) {
    double less = 0, more = 0;
    for (int i = 0; i < a->n; i++) {
        less += (u[i] - v[i]) * (u[i] - v[i]);
        more += (u[i] + v[i]) * (u[i] + v[i]);
    }
    return 2 * atan2(sqrt(less), sqrt(more)) * DEGREES;
}

/* "line", "plane" or "space of dimension 3" */
static void print_flat(int dimension) {
    if (dimension > 2)
        printf("space of dimension %d", dimension);
    else
        fputs(dimension > 1 ? "plane" : "line", stdout);
}

/* Print the lines first; the description that follows refers to the part normal to them. */
static void print_cone_with_lines(const SetAnswer *a) {
    const int d = a->facts.dimension, l = a->lineality;
    if (l == d && d == 1) {
        fputs("a line along", stdout);
    } else if (l == d) {
        fputs("a whole ", stdout);
        print_flat(d);
        fputs(", spanned by", stdout);
    } else if (l == d - 1) {
        fputs(d == 2 ? "a half-plane, bounded by the line along" : "a half-space", stdout);
        if (d > 2) {
            printf(" of dimension %d, bounded by the ", d);
            print_flat(l);
            fputs(" spanned by", stdout);
        }
    } else {
        printf("a cone of dimension %d with the ", d);
        print_flat(l);
        fputs(l == 1 ? " along" : " spanned by", stdout);
    }
    print_list(a, a->line, l);
    if (l == d) return;
    if (l == d - 1 && a->ray_count > 0) {
        fputs(", on the side of", stdout);
        print_list(a, a->ray, 1);
    } else if (l == d - 2 && a->ray_count > 1) {
        printf(", and across it a sector of %.6g degrees between", angle(a, a->ray, a->ray + a->n));
        print_list(a, a->ray, 2);
    } else {
        fputs(", around", stdout);
        print_list(a, a->centre, 1);
    }
}

static void print_cone(const SetAnswer *a) {
    const int d = a->facts.dimension;
    if (d == 0) {
        fputs("only the velocity 0", stdout);
    } else if (a->lineality > 0) {
        print_cone_with_lines(a);
    } else if (a->ray_count == 1 && d == 1) {
        fputs("a ray along", stdout);
        print_list(a, a->ray, 1);
    } else if (a->ray_count == 2 && d == 2) {
        printf("a sector of %.6g degrees between", angle(a, a->ray, a->ray + a->n));
        print_list(a, a->ray, 2);
    } else if (a->ray_count > 0) {
        printf("a cone of dimension %d, generated by", d);
        print_list(a, a->ray, a->ray_count);
    } else {
        printf("a cone of dimension %d around", d);
        print_list(a, a->centre, 1);
    }
}

/* (x + factor d) */
static void print_sum(int n, const double *x, double factor, const double *d) {
    putchar('(');
    for (int i = 0; i < n; i++)
        printf("%s%.10g", i ? ", " : "", (x ? x[i] : 0) + factor * d[i] + 0.0);
    putchar(')');
}

/* A half-line from its end, or a line. */
static void print_line(const SetAnswer *a) {
    const bool down = isfinite(a->high[0]), ends = down || isfinite(a->low[0]);
    double along = down ? a->high[0] : ends ? a->low[0] : 0;
    if (ends)
        for (int i = 0; i < a->n; i++) along -= a->basis[i] * a->centre[i];
    fputs(ends ? "a half-line from " : "a line through ", stdout);
    print_sum(a->n, a->centre, along, a->basis);
    fputs(" along ", stdout);
    print_sum(a->n, NULL, down ? -1 : 1, a->basis);
}

static void print_set(const SetAnswer *a) {
    const int d = a->facts.dimension;
    if (d == 0) {
        fputs("one: ", stdout);
        law_print_vector(a->n, a->centre);
    } else if (d == 1 && a->vertex_count == 2) {
        printf("a segment between");
        print_list(a, a->vertex, 2);
    } else if (d == 1 && !a->facts.bounded) {
        print_line(a);
    } else {
        printf("a set of dimension %d around ", d);
        law_print_vector(a->n, a->centre);
        print_extents(a);
        if (a->vertex_count > 0) {
            printf("\n    %d corners", a->vertex_count);
            print_list(a, a->vertex, a->vertex_count);
        }
    }
}

void law_answer_print(const SetAnswer *answer, bool cone) {
    if (answer->facts.outcome != CPS_SET_OUTCOME_ANSWERED)
        printf("no answer: %s", cps_set_outcome_text(answer->facts.outcome));
    else if (cone)
        print_cone(answer);
    else
        print_set(answer);
}

/* ---- JSON ---- */

static void json_list(const SetAnswer *a, const char *key, const double *x, int count, FILE *out) {
    fprintf(out, ", \"%s\": [", key);
    for (int i = 0; i < count && i < MOST_LISTED; i++) {
        if (i) fputs(", ", out);
        law_json_vector(a->n, x + (size_t)i * (size_t)a->n, out);
    }
    fputc(']', out);
}

static const char *description(const SetAnswer *a, bool cone) {
    static const char *const SET[] = {"point", "segment", "planar set"};
    static const char *const CONE[] = {"zero", "ray", "sector"};
    const int d = a->facts.dimension;
    if (!cone && d == 1 && !a->facts.bounded)
        return isfinite(a->low[0]) || isfinite(a->high[0]) ? "half-line" : "line";
    if (!cone) return d <= 2 ? SET[d] : "set";
    if (a->lineality > 0 && a->lineality == d) return d == 1 ? "line" : d == 2 ? "plane" : "space";
    if (a->lineality > 0 && a->lineality == d - 1) return d == 2 ? "half-plane" : "half-space";
    return d == 0 || (d <= 2 && a->ray_count == d) ? CONE[d] : "cone";
}

void law_answer_json(const SetAnswer *a, bool cone, FILE *out) {
    if (a->facts.outcome != CPS_SET_OUTCOME_ANSWERED) {
        fprintf(out, "{\"outcome\": \"%s\"}", cps_set_outcome_name(a->facts.outcome));
        return;
    }
    fprintf(out, "{\"dimension\": %d, \"description\": \"%s\", \"centre\": ", a->facts.dimension,
            description(a, cone));
    law_json_vector(a->n, a->centre, out);
    if (a->vertex_count >= 0) json_list(a, "vertices", a->vertex, a->vertex_count, out);
    if (a->ray_count >= 0) json_list(a, "rays", a->ray, a->ray_count, out);
    if (cone) fprintf(out, ", \"lineality\": %d", a->lineality);
    if (cone && a->lineality > 0) json_list(a, "lines", a->line, a->lineality, out);
    if (!cone) {
        fputs(", \"extent\": [", out);
        for (int i = 0; i < a->facts.dimension; i++) {
            fprintf(out, "%s{\"direction\": ", i ? ", " : "");
            law_json_vector(a->n, a->basis + (size_t)i * (size_t)a->n, out);
            fputs(", \"low\": ", out);
            law_json_number(a->low[i], out);
            fputs(", \"high\": ", out);
            law_json_number(a->high[i], out);
            fputc('}', out);
        }
        fputc(']', out);
    }
    fputs(", \"tolerance\": ", out);
    law_json_number(a->facts.tolerance, out);
    fputc('}', out);
}
