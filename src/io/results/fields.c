/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of fields, and the selection of fields by name (fields.h). */
#include "io/results/fields.h"

#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "base/status.h"

#define VIEW(member) offsetof(CpsLineView, member)

const CpsiField cpsi_field[CPSI_FIELDS] = {
    {"arc_length", "natural abscissa of the nodes", "m", CPSI_PLACE_NODE, false, true, false,
     VIEW(arc_length)},
    {"element_length", "natural length of the elements", "m", CPSI_PLACE_ELEMENT, false, true,
     false, VIEW(element_length)},
    {"reference", "configuration in which the step starts", "m", CPSI_PLACE_NODE, true, false,
     false, VIEW(reference)},
    {"position", "configuration", "m", CPSI_PLACE_NODE, true, false, false, VIEW(position)},
    {"load", "weight and forces on free ends", "N", CPSI_PLACE_NODE, true, false, false,
     VIEW(load)},
    {"normal", "normal of the obstacle touched or nearest, 0 without one", "1", CPSI_PLACE_NODE,
     true, false, true, VIEW(normal)},
    {"contact_gap",
     "distance that the displacement may close, infinite where no contact is looked for", "m",
     CPSI_PLACE_NODE, false, false, true, VIEW(gap)},
    {"friction_bound", "largest friction force", "N", CPSI_PLACE_NODE, false, false, true,
     VIEW(friction_bound)},
    {"friction_force", "friction force on the line", "N", CPSI_PLACE_NODE, true, false, true,
     VIEW(friction_force)},
    {"reaction", "reaction of the obstacle along its normal", "N", CPSI_PLACE_NODE, false, false,
     true, VIEW(reaction)},
    {"slip", "slip on the obstacle in the step, tangential", "m", CPSI_PLACE_NODE, true, false,
     true, VIEW(slip)},
    {"segment_force", "force of the B side of an element on its A side", "N", CPSI_PLACE_ELEMENT,
     true, false, false, VIEW(segment_force)},
    {"tension", "tension from the elongation", "N", CPSI_PLACE_ELEMENT, false, false, false,
     VIEW(tension)},
    /* only where elements are kept out of round obstacles */
    {"element_share", "place of the contact on an element, as a fraction of it from A to B", "1",
     CPSI_PLACE_ELEMENT_CONTACT, false, false, false, VIEW(element_share)},
    {"element_normal", "normal of the obstacle there, 0 without one", "1",
     CPSI_PLACE_ELEMENT_CONTACT, true, false, false, VIEW(element_normal)},
    {"element_contact_gap",
     "distance that the displacement there may close, infinite where no contact is looked for", "m",
     CPSI_PLACE_ELEMENT_CONTACT, false, false, false, VIEW(element_gap)},
    {"element_friction_bound", "largest friction force on the element", "N",
     CPSI_PLACE_ELEMENT_CONTACT, false, false, false, VIEW(element_friction_bound)},
    {"element_friction_force", "friction force on the element", "N", CPSI_PLACE_ELEMENT_CONTACT,
     true, false, false, VIEW(element_friction_force)},
    {"element_reaction", "reaction of the obstacle on the element, along its normal", "N",
     CPSI_PLACE_ELEMENT_CONTACT, false, false, false, VIEW(element_reaction)},
    {"element_slip",
     "slip on the obstacle of the place where the element touches, in the step, tangential", "m",
     CPSI_PLACE_ELEMENT_CONTACT, true, false, false, VIEW(element_slip)},
    {"node_load", "given loads and drag on the nodes, a part of their load", "N", CPSI_PLACE_LOAD,
     true, false, false, VIEW(node_load)},
    {"node_stiffness", "stiffness of the springs of a node along x, y and z", "N m-1",
     CPSI_PLACE_SPRING, true, true, false, VIEW(node_stiffness)},
    {"node_coupling", "the same, of x and y, x and z, y and z", "N m-1", CPSI_PLACE_SPRING, true,
     true, false, VIEW(node_coupling)},
    {"node_place", "place at which they are without force", "m", CPSI_PLACE_SPRING, true, true,
     false, VIEW(node_place)},
    {"node_beside", "how far beside the node its springs are taken in the balance of forces", "m",
     CPSI_PLACE_SPRING, true, false, false, VIEW(node_beside)},
    {"motion", "velocity that proves that the line slides without end, else 0", "1",
     CPSI_PLACE_NODE, true, false, false, VIEW(motion)},
};

/* Names of earlier versions. */
static const struct {
    const char *former, *name;
} RENAMED[] = {{"friction", "friction_force"},
               {"element_friction", "element_friction_force"},
               {"slide", "slip"},
               {"element_slide", "element_slip"}};
enum { RENAMED_FIELDS = sizeof RENAMED / sizeof RENAMED[0] };

static bool is_name(const char *given, size_t length, const char *name) {
    return strlen(name) == length && memcmp(given, name, length) == 0;
}

static CpsStatus refuse(const char *name, size_t given, CpsError *err) {
    char known[800] = "";
    const int length = given < 40 ? (int)given : 40;
    for (int k = 0; k < RENAMED_FIELDS; ++k)
        if (is_name(name, given, RENAMED[k].former))
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "fields: '%s' is now '%s'", RENAMED[k].former,
                             RENAMED[k].name);
    for (int f = 0; f < CPSI_FIELDS; ++f) {
        if (cpsi_field[f].fixed) continue;
        const size_t used = strlen(known);
        snprintf(known + used, sizeof known - used, "%s, ", cpsi_field[f].name);
    }
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "fields: found '%.*s', expected none or some of %sstate, obstacle", length,
                     name, known);
}

CpsStatus cpsi_fields_choose(const char *list, unsigned *wanted, CpsError *err) {
    *wanted = list ? 0 : ~0u;
    if (!list || strcmp(list, "none") == 0) return CPS_OK;
    for (const char *name = list;; ++name) {
        const size_t length = strcspn(name, ",");
        unsigned bit = 0;
        for (int f = 0; f < CPSI_FIELDS; ++f)
            if (!cpsi_field[f].fixed && is_name(name, length, cpsi_field[f].name)) bit = 1u << f;
        if (is_name(name, length, "state")) bit = CPSI_WANTED_STATE;
        if (is_name(name, length, "obstacle")) bit = CPSI_WANTED_OBSTACLE;
        if (!bit) return refuse(name, length, err);
        *wanted |= bit;
        name += length;
        if (*name == '\0') return CPS_OK;
    }
}
