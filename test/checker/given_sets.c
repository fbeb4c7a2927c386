/* SPDX-License-Identifier: BSD-3-Clause */
/* What the scene has of sets that ends are held to, beside what the file says (compare.h). */
#include <math.h>
#include <netcdf.h>
#include <stdio.h>

#include "compare.h"
#include "conic.h"
#include "sets.h"

static void compare_numbers(Compare *compare, const char *line, const char *what, int e,
                            const double *wanted, size_t count, const double *from) {
    const size_t start[2] = {(size_t)e, 0}, counts[2] = {1, count};
    char name[300], of[300];
    double found[4];
    int id;
    snprintf(name, sizeof name, "%.200s_%s", line, what);
    snprintf(of, sizeof of, "%.200s, end %c", line, e ? 'B' : 'A');
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
static void compare_forms(Compare *compare, const char *line, int e, const CpsConstraint *on,
                          const Conic *form) {
    enum { DIRECTIONS = 60 };
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
        find(compare,
             "set of line %s, end %c, reaches %.17g along (%.3g, %.3g, %.3g), in the scene "
             "%.17g",
             line, e ? 'B' : 'A', file, d[0], d[1], d[2], answer.value);
        return;
    }
}

void sets_compare(Compare *compare, const CpsLine *line, const Record *r) {
    const bool any = line->constraint[0].kind != CPS_CONSTRAINT_KIND_NONE ||
                     line->constraint[1].kind != CPS_CONSTRAINT_KIND_NONE;
    if (any != (r->sets != NULL)) find(compare, "sets of the ends of %s", line->name);
    if (!any || !r->sets) return;
    for (int e = 0; e < 2; e++) {
        const CpsConstraint *on = &line->constraint[e];
        const double kind = on->kind;
        compare_numbers(compare, line->name, "set_kind", e, &kind, 1, NULL);
        compare_numbers(compare, line->name, "set_point", e, on->point, 3, compare->source.origin);
        compare_numbers(compare, line->name, "set_axis", e, on->axis, 3, NULL);
        compare_numbers(compare, line->name, "set_length", e, &on->length, 1, NULL);
        compare_numbers(compare, line->name, "set_radius", e, &on->radius, 1, NULL);
        compare_numbers(compare, line->name, "set_size", e, on->size, 3, NULL);
        compare_numbers(compare, line->name, "set_rotation", e, on->rotation, 4, NULL);
        const Conic *form = sets_form(r, e);
        if ((form != NULL) != (on->kind == CPS_CONSTRAINT_KIND_SET))
            find(compare, "set of an end of %s: one of the two has no form", line->name);
        else if (form)
            compare_forms(compare, line->name, e, on, form);
    }
}
