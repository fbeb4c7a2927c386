/* SPDX-License-Identifier: BSD-3-Clause */
/* What the scene has of sets that ends and points are held to, beside what the file says
 * (compare.h). */
#include <math.h>
#include <netcdf.h>
#include <stdio.h>

#include "compare.h"
#include "conic.h"
#include "sets.h"

/* Whose set it is: end `index` of a line, or where there is no line point `index`. */
typedef struct Owner {
    const char *line, *point;
    size_t index;
} Owner;

static void describe(const Owner *owner, char of[300]) {
    if (owner->line)
        snprintf(of, 300, "%.200s, end %c", owner->line, owner->index ? 'B' : 'A');
    else
        snprintf(of, 300, "point %.200s", owner->point);
}

static void compare_numbers(Compare *compare, const Owner *owner, const char *what,
                            const double *wanted, size_t count, const double *from) {
    const size_t start[2] = {owner->index, 0}, counts[2] = {1, count};
    char name[300], of[300];
    double found[4];
    int id;
    if (owner->line)
        snprintf(name, sizeof name, "%.200s_%s", owner->line, what);
    else
        snprintf(name, sizeof name, "%.200s_of_point", what);
    describe(owner, of);
    if (nc_inq_varid(compare->source.nc, name, &id) ||
        nc_get_vara_double(compare->source.nc, id, start, counts, found)) {
        find(compare, "%s is missing", name);
        return;
    }
    for (size_t k = 0; k < count; k++)
        if (!isinf(wanted[k]) || wanted[k] != found[k])
            same_number(compare, what, of, found[k], wanted[k] - (from ? from[k] : 0));
}

/* Two sets with the same support in directions all over the sphere, to what small programs leave.
 */
static void compare_forms(Compare *compare, const Owner *owner, const CpsConstraint *on,
                          const Conic *form) {
    enum { DIRECTIONS = 60 };
    char of[300];
    describe(owner, of);
    for (int i = 0; i < DIRECTIONS; i++) {
        const double z = (2 * i + 1.0) / DIRECTIONS - 1, across = sqrt(1 - z * z),
                     angle = 2.399963229728653 * i; /* that of the golden section */
        const double d[3] = {across * cos(angle), across * sin(angle), z};
        CpsSetAnswer answer;
        if (cps_set_support(on->set, d, NULL, &answer, NULL) != CPS_OK ||
            answer.outcome != CPS_SET_OUTCOME_ANSWERED)
            return;
        const double file = (double)conic_support(form, (Real[]){d[0], d[1], d[2]});
        if (fabs(file - answer.value) <= answer.gap + 1e-9 * (double)form->reach) continue;
        find(compare, "set of %s reaches %.17g along (%.3g, %.3g, %.3g), in the scene %.17g", of,
             file, d[0], d[1], d[2], answer.value);
        return;
    }
}

static void compare_set(Compare *compare, const Owner *owner, const CpsConstraint *on,
                        const Conic *form) {
    const double kind = on->kind;
    char of[300];
    describe(owner, of);
    compare_numbers(compare, owner, "set_kind", &kind, 1, NULL);
    compare_numbers(compare, owner, "set_point", on->point, 3, compare->source.origin);
    compare_numbers(compare, owner, "set_axis", on->axis, 3, NULL);
    compare_numbers(compare, owner, "set_length", &on->length, 1, NULL);
    compare_numbers(compare, owner, "set_radius", &on->radius, 1, NULL);
    compare_numbers(compare, owner, "set_size", on->size, 3, NULL);
    compare_numbers(compare, owner, "set_rotation", on->rotation, 4, NULL);
    if ((form != NULL) != (on->kind == CPS_CONSTRAINT_KIND_SET))
        find(compare, "set of %s: one of the two has no form", of);
    else if (form)
        compare_forms(compare, owner, on, form);
}

void point_sets_compare(Compare *compare, const CpsScene *scene) {
    bool any = false;
    int bad;
    for (int k = 0; k < scene->point_count; k++)
        any = any || scene->point[k].constraint.kind != CPS_CONSTRAINT_KIND_NONE;
    PointSets *sets = point_sets_open(&compare->source, &bad, NULL);
    if (bad || any != (sets != NULL)) find(compare, "sets of the points%s", "");
    const int count = sets && !bad ? scene->point_count : 0;
    for (int k = 0; k < count; k++)
        compare_set(compare, &(Owner){NULL, scene->point[k].name, (size_t)k},
                    &scene->point[k].constraint, point_sets_form(sets, (size_t)k));
    point_sets_free(sets);
}

void sets_compare(Compare *compare, const CpsLine *line, const Record *r) {
    const bool any = line->constraint[0].kind != CPS_CONSTRAINT_KIND_NONE ||
                     line->constraint[1].kind != CPS_CONSTRAINT_KIND_NONE;
    if (any != (r->sets != NULL)) find(compare, "sets of the ends of %s", line->name);
    if (!any || !r->sets) return;
    for (int e = 0; e < 2; e++)
        compare_set(compare, &(Owner){line->name, NULL, (size_t)e}, &line->constraint[e],
                    sets_form(r, e));
}
