/* SPDX-License-Identifier: BSD-3-Clause */
/* The forces that hold a line in its configuration, as a program (force_set.h).
 *
 * A contact's force varies in a span of one to three directions: along n + F/R where it slips,
 * which keeps F = -mu R u/|u|; in n and the tangents where it sticks; with frozen friction, in F
 * within its disc and in R separately. Balance at node j reads
 *
 *     dT_j t_j - dT_j+1 t_j+1 = sum of the directions times their coefficients.
 *
 * With fewer than three directions this leaves equations for the two tensions: the components of
 * t_j and t_j+1 orthogonal to the span are independent (both tensions stay), parallel (their ratio
 * is fixed) or zero (both vary freely). */
#include "cable/force_set.h"

#include <math.h>
#include <string.h>

#include "cable/contact.h"
#include "cable/end_set.h"
#include "cable/friction_law.h"
#include "chain/frame.h"
#include "ipm/ipm.h"
#include "linalg/dense.h"

/* Directions that differ by less [rad] count as parallel. A tension that passes there is out of
 * balance by this share at most, and the angle between force and element adds its square to the
 * gap. */
static const double ANGLE = 1e-8;
/* Elements shorter than their length by less are taut, and nodes that moved by less per length of
 * the line stick: the accuracy of the loop. */
static const double EXACT = 1e-9;
/* The cones are widened by this share of the largest force, so that a set with a single member has
 * an interior; it is below what the certificate tolerates. */
static const double CONE_SLACK = 1e-12;
/* Targets of the loop, tried in this order: rounding may stop it early near the boundary of many
 * cones, or where multipliers are large. */
static const double TARGETS[] = {1e-12, 1e-10, 1e-8};
/* Tensions that grow from node to node may be far larger than the largest force, and the loop then
 * needs many iterations to find their size. */
enum { MAX_ITERATIONS = 200, PATIENCE = 60, CONES = 5, COLUMNS = 6 };

/* The directions in which the force of one contact may vary, and their cones. */
typedef struct Contact {
    int columns, cones, rows;
    double column[3][3]; /* the directions */
    double rise[3];      /* the change of R per unit of each */
    double disc[3][2];   /* and of F, in the tangents of the contact */
    int dim[CONES];
    double row[CONES][3], h[CONES]; /* of the cones, for the coefficients of the columns */
} Contact;

/* The directions in which the forces at a node may vary. */
typedef struct Node {
    int contacts, which[2], first[2]; /* first: the column where a contact begins */
    Contact contact[2];
    int columns, own;
    double left[COLUMNS],
        right[COLUMNS]; /* the coefficients that balance t of the element before, and after */
    double null_space[CPSI_SITE_OWN][COLUMNS]; /* coefficients of zero resultant */
    double left_rest[3], right_rest[3];        /* the parts of t that no columns balance */
    int rest_count;
} Node;

/* contacts ------------------------------------------------------------------------------------- */

static bool touches(const CpsiLine *line, int c) {
    if (!isfinite(line->gap[c])) return false;
    const int j = cpsi_line_node(line, c);
    const Vec3 u = vec3_sub(vec3_at(line->position, j), vec3_at(line->reference, j));
    return line->state[c] != CPS_NODE_STATE_FREE ||
           vec3_dot(vec3_at(line->normal, c), u) + line->gap[c] <= CPSI_TOUCH * line->length;
}

static void add_row(Contact *contact, int dim, const double row[3], double h) {
    if (dim > 0) contact->dim[contact->cones++] = dim;
    memcpy(contact->row[contact->rows], row, sizeof contact->row[0]);
    contact->h[contact->rows++] = h;
}

static void add_column(Contact *contact, Vec3 direction, double rise, const double disc[2]) {
    const int k = contact->columns++;
    vec3_store(contact->column[k], direction);
    contact->rise[k] = rise;
    memcpy(contact->disc[k], disc, sizeof contact->disc[k]);
}

/* Along which of the two tangents may friction vary? Not where it slips, nor where there is
 * none. */
static void free_tangents(const CpsiLine *line, const CpsiForceLaw *law, int c,
                          const CpsiFrictionLaw *contact_law, bool out[2]) {
    double slip[3];
    cpsi_line_local_slip(line, c, slip);
    for (int a = 0; a < 2; a++) slip[a] = fabs(contact_law->ratio[a] * slip[a]);
    const double still = EXACT * line->length;
    const bool rest_count = line->state[c] == CPS_NODE_STATE_STICK && !law->exact;
    for (int a = 0; a < 2; a++) {
        const double size =
            contact_law->box ? slip[a] : sqrt(slip[0] * slip[0] + slip[1] * slip[1]);
        out[a] = contact_law->ratio[a] > 0 && (rest_count || size <= still);
    }
}

/* The cones of a contact whose friction is free along `free` of its tangents: columns are that of
 * the normal, if `normal`, then those of the free tangents. */
static void add_cones(Contact *contact, const CpsiFrictionLaw *contact_law, const bool free[2],
                      bool normal, double mu, double reaction, double bound,
                      const double force[2]) {
    const int first = normal ? 1 : 0, count = free[0] + free[1];
    const double follow = normal ? mu : 0; /* change of the bound per unit of the normal column */
    if (normal && (count == 0 || mu == 0))
        add_row(contact, 1, (const double[3]){1, 0, 0}, reaction);
    if (count == 2 && !contact_law->box) {
        add_row(contact, 3, (const double[3]){follow, 0, 0}, bound);
        for (int a = 0; a < 2; a++) {
            double row[3] = {0};
            row[first + a] = 1 / contact_law->ratio[a];
            add_row(contact, 0, row, force[a] / contact_law->ratio[a]);
        }
        return;
    }
    for (int a = 0, k = first; a < 2; a++) {
        if (!free[a]) continue;
        for (int sign = -1; sign < 2; sign += 2) {
            double row[3] = {normal ? contact_law->ratio[a] * follow : 0, 0, 0};
            row[k] = sign;
            add_row(contact, 1, row, contact_law->ratio[a] * bound + sign * force[a]);
        }
        k++;
    }
}

/* The directions in which the force of contact c may vary; false where it has a general friction
 * set, whose force stays. Forces are in units of `unit`. */
static bool build_contact(const CpsiLine *line, const CpsiForceLaw *law, double unit, int c,
                          Contact *out) {
    static const double none[2] = {0, 0};
    *out = (Contact){0};
    const CpsiFrictionLaw *contact_law = &line->friction_law[c];
    const double *axes = cpsi_line_axes(line, c), reaction = line->reaction[c] / unit;
    const bool touching = touches(line, c), discs = !law->frictionless && contact_law->friction > 0;
    const bool given = discs && contact_law->given && (touching || line->friction_bound[c] > 0);
    double force[3];
    cpsi_frame_to(force, axes, &line->friction_force[3 * c]);
    for (int a = 0; a < 2; a++) force[a] /= unit;
    bool free[2] = {false, false};
    const Vec3 n = vec3_at(line->normal, c);
    if (given && !law->frozen) return false;
    if (law->frozen || !discs) {
        /* R varies by itself; F varies within its fixed bound, which has no unbounded directions */
        const bool varies = discs && !given && !law->directions && line->friction_bound[c] > 0;
        if (varies) free_tangents(line, law, c, contact_law, free);
        if (touching) add_column(out, n, 1, none);
    } else {
        if (!touching) return true;
        free_tangents(line, law, c, contact_law, free);
        const bool slips = !(free[0] && free[1]);
        if (slips && !(reaction > 0)) return true;
        double disc[2] = {0, 0};
        Vec3 slip = n;
        if (slips)
            for (int a = 0; a < 2; a++) {
                if (free[a]) continue;
                disc[a] = force[a] / reaction;
                slip = vec3_axpy(disc[a], vec3_at(axes, a), slip);
            }
        add_column(out, slip, 1, disc);
    }
    const bool normal = out->columns > 0;
    for (int a = 0; a < 2; a++)
        if (free[a]) add_column(out, vec3_at(axes, a), 0, (const double[2]){a == 0, a == 1});
    const double follow = law->frozen || !discs ? 0 : contact_law->friction;
    add_cones(out, contact_law, free, normal, follow, reaction,
              law->frozen ? line->friction_bound[c] / unit : follow * reaction, force);
    return !given;
}

/* nodes ---------------------------------------------------------------------------------------- */

/* Coefficients of the columns that balance `t`, and the remainder of t; q (3, columns) becomes an
 * orthonormal basis of the rows. */
static int decompose(const Node *node, const double t[3], double *q, double amounts[COLUMNS],
                     double rest[3]) {
    const int d = node->columns;
    double rhs[3];
    int k = 0;
    for (int i = 0; i < node->contacts; i++)
        for (int m = 0; m < node->contact[i].columns; m++, k++)
            for (int a = 0; a < 3; a++) q[a * d + k] = node->contact[i].column[m][a];
    memcpy(rhs, t, sizeof rhs);
    const int rank = d > 0 ? cpsi_orthonormal_span(3, d, q, rhs, ANGLE) : 0;
    for (int m = 0; m < d; m++) {
        amounts[m] = 0;
        for (int r = 0; r < rank; r++) amounts[m] += rhs[r] * q[r * d + m];
    }
    for (int r = rank; r < 3; r++) rest[r - rank] = rhs[r];
    return rank;
}

/* The directions of node j and their balance; elements beyond the ends have no tangent. */
static void build_node(CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law, int j,
                       Node *node) {
    static const double none[3] = {0, 0, 0};
    double q[COLUMNS * COLUMNS];
    *node = (Node){0};
    for (int c = j; c < cpsi_line_contacts(line); c += line->n) {
        Contact *contact = &node->contact[node->contacts];
        if (!build_contact(line, law, set->force, c, contact)) set->partial = true;
        if (contact->columns == 0) continue;
        node->which[node->contacts] = c;
        node->first[node->contacts++] = node->columns;
        node->columns += contact->columns;
    }
    const double *before = j > 0 ? &set->tangent[3 * (j - 1)] : none,
                 *after = j + 1 < line->n ? &set->tangent[3 * j] : none;
    decompose(node, before, q, node->left, node->left_rest);
    const int rank = decompose(node, after, q, node->right, node->right_rest);
    node->rest_count = 3 - rank;
    node->own = node->columns - rank;
    if (node->own > 0) cpsi_complete_rows(rank, node->columns, q);
    for (int k = 0; k < node->own; k++)
        memcpy(node->null_space[k], &q[(rank + k) * node->columns],
               (size_t)node->columns * sizeof *q);
}

static double dot(int n, const double *a, const double *b) { return cpsi_dot(n, a, b); }

typedef struct Relation {
    bool left_stays, right_stays, linked;
    double ratio; /* change of the tension after over that before */
} Relation;

/* [rad] To what the places tell the directions of the two elements at node j. The forces in them
 * balance to rounding and are along them to the root of twice the gap over its scale; so a line
 * that runs straight between two nodes may be bent by the angles of its forces to its elements. */
static double known_angle(const CpsiForceSet *set, const CpsiLine *line, int j) {
    const CpsCertificate *certificate = &line->report.certificate;
    double sum = 0;
    if (!(certificate->gap > 0 && certificate->scale > 0)) return ANGLE;
    for (int e = j > 0 ? j - 1 : 0; e <= j && e + 1 < line->n; e++) {
        const Vec3 t = vec3_at(set->tangent, e), force = vec3_at(line->segment_force, e);
        const double across = vec3_norm(vec3_axpy(-set->tension[e], t, force));
        if (set->tension[e] > 0) sum += across / set->tension[e];
    }
    return fmax(ANGLE, fmin(sum, sqrt(2 * certificate->gap / certificate->scale)));
}

/* The condition of balance orthogonal to the span on the tensions before and after the node, whose
 * directions are one where they differ by no more than an angle. */
static Relation relate(const Node *node, double angle) {
    const double a = sqrt(dot(node->rest_count, node->left_rest, node->left_rest));
    const double b = sqrt(dot(node->rest_count, node->right_rest, node->right_rest));
    if (a <= ANGLE || b <= ANGLE)
        return (Relation){.left_stays = a > ANGLE, .right_stays = b > ANGLE};
    const double ratio = dot(node->rest_count, node->left_rest, node->right_rest) / (b * b);
    double off = 0;
    for (int k = 0; k < node->rest_count; k++)
        off += pow(node->left_rest[k] - ratio * node->right_rest[k], 2);
    if (!(sqrt(off) <= angle * a)) return (Relation){.left_stays = true, .right_stays = true};
    return (Relation){.linked = true, .ratio = ratio};
}

/* elements ------------------------------------------------------------------------------------- */

/* Tangents and tensions of the elements, and which are taut. */
static void measure_elements(CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law) {
    for (int e = 0; e + 1 < line->n; e++) {
        const Vec3 dx = vec3_sub(vec3_at(line->position, e + 1), vec3_at(line->position, e));
        const double size = vec3_norm(dx), missing = 1 - size / line->element_length[e];
        const Vec3 t = size > 0 ? vec3_scale(1 / size, dx) : vec3(0, 0, 0);
        vec3_store(&set->tangent[3 * e], t);
        set->tension[e] = vec3_dot(vec3_at(line->segment_force, e), t);
        const bool pulls = !law->exact && set->tension[e] > missing * set->force;
        set->scalar[e] = !law->shares && size > 0 && (missing <= EXACT || pulls) ? 0 : -1;
    }
}

/* Number the scalars: one for each run of elements whose tensions are proportional. A run in which
 * one tension stays has none. Returns their count. */
static int number_scalars(CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law) {
    int scalars = 0;
    Node node;
    for (int first = 0; first + 1 < line->n;) {
        int last = first;
        bool stays = set->scalar[first] < 0;
        double gain = 1, most = 1;
        set->gain[first] = 1;
        if (!cpsi_line_is_held(line, first)) {
            build_node(set, line, law, first, &node);
            stays = relate(&node, known_angle(set, line, first)).right_stays || stays;
        }
        for (;; last++) {
            if (cpsi_line_is_held(line, last + 1)) break;
            build_node(set, line, law, last + 1, &node);
            const Relation relation = relate(&node, known_angle(set, line, last + 1));
            stays = stays || relation.left_stays;
            if (last + 2 >= line->n || !relation.linked) break;
            gain *= relation.ratio;
            stays = stays || set->scalar[last + 1] < 0 || !isfinite(gain);
            set->gain[last + 1] = gain;
            most = fmax(most, fabs(gain));
        }
        for (int e = first; e <= last; e++) {
            set->gain[e] /= most;
            set->scalar[e] = stays ? -1 : scalars;
        }
        if (!stays) scalars++;
        first = last + 1;
    }
    return scalars;
}

/* the program ---------------------------------------------------------------------------------- */

/* T >= 0 */
static void add_element(CpsiForceSet *set, const CpsiForceLaw *law, int e) {
    if (set->scalar[e] < 0) return;
    cpsi_scalar_program_site(&set->program, set->scalar[e], -1, 0);
    const int row = cpsi_scalar_program_cone(&set->program, 1);
    set->program.g[row][0] = set->gain[e];
    set->program.h[row] = (law->directions ? 0 : set->tension[e] / set->force) + CONE_SLACK;
}

/* Scalar and gain of element e, which may lie beyond the ends. */
static int scalar_of(const CpsiForceSet *set, const CpsiLine *line, int e, double *gain) {
    const bool is = e >= 0 && e + 1 < line->n && set->scalar[e] >= 0;
    *gain = is ? set->gain[e] : 0;
    return is ? set->scalar[e] : -1;
}

static void add_contact(CpsiForceSet *set, const CpsiForceLaw *law, const Node *node, int i,
                        const double gain[2], bool one) {
    const Contact *contact = &node->contact[i];
    const int first = node->first[i], d = contact->columns;
    for (int k = 0, r = 0; k < contact->cones; k++) {
        const int row = cpsi_scalar_program_cone(&set->program, contact->dim[k]);
        for (int m = 0; m < contact->dim[k]; m++, r++) {
            double *g = set->program.g[row + m];
            const double before = gain[0] * dot(d, contact->row[r], &node->left[first]);
            const double after = -gain[1] * dot(d, contact->row[r], &node->right[first]);
            g[0] = one ? before + after : before;
            g[1] = one ? 0 : after;
            for (int a = 0; a < node->own; a++)
                g[2 + a] = dot(d, contact->row[r], &node->null_space[a][first]);
            set->program.h[row + m] =
                (law->directions ? 0 : contact->h[r]) + (m == 0 ? CONE_SLACK : 0);
        }
    }
}

static void add_node(CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law, int j) {
    set->site[j] = -1;
    if (cpsi_line_is_held(line, j)) return;
    Node node;
    double gain[2];
    build_node(set, line, law, j, &node);
    const int before = scalar_of(set, line, j - 1, &gain[0]),
              after = scalar_of(set, line, j, &gain[1]);
    if (node.columns == 0 || (before < 0 && after < 0 && node.own == 0)) return;
    const bool one = before >= 0 && before == after;
    set->site[j] = set->program.sites;
    cpsi_scalar_program_site(&set->program, before, after, node.own);
    for (int i = 0; i < node.contacts; i++) add_contact(set, law, &node, i, gain, one);
}

bool cpsi_force_set_build(CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law) {
    set->force = line->report.certificate.largest_force;
    for (int e = 0; e + 1 < line->n; e++) set->force = fmax(set->force, line->tension_before[e]);
    /* such forces stay as they are */
    set->partial = cpsi_contact_holds_element(line) || cpsi_line_has_sets(line);
    if (!isfinite(set->force)) return false;
    if (!(set->force > 0)) set->force = 1; /* no forces: any unit will do */
    measure_elements(set, line, law);
    const int scalars = number_scalars(set, line, law);
    cpsi_scalar_program_begin(&set->program, scalars);
    for (int j = 0; j < line->n; j++) {
        add_node(set, line, law, j);
        if (j + 1 < line->n) add_element(set, law, j);
    }
    cpsi_scalar_program_end(&set->program);
    return set->program.base.size > 0;
}

bool cpsi_force_set_solve(CpsiForceSet *set) {
    for (size_t k = 0; k < sizeof TARGETS / sizeof *TARGETS; k++) {
        const CpsiIpmOptions options = {.target = TARGETS[k],
                                        .scale = 1,
                                        .max_iterations = MAX_ITERATIONS,
                                        .patience = PATIENCE};
        cpsi_scalar_program_end(&set->program);
        if (cpsi_ipm_solve(&set->program.base, &options).outcome == CPSI_IPM_SOLVED) return true;
    }
    return false;
}

/* back ----------------------------------------------------------------------------------------- */

static void store_contact(const CpsiForceSet *set, CpsiLine *line, const CpsiForceLaw *law, int c,
                          const Contact *contact, const double *amount) {
    const CpsiFrictionLaw *contact_law = &line->friction_law[c];
    const double *axes = cpsi_line_axes(line, c);
    double force[3], reaction = line->reaction[c];
    cpsi_frame_to(force, axes, &line->friction_force[3 * c]);
    for (int k = 0; k < contact->columns; k++) {
        reaction += set->force * amount[k] * contact->rise[k];
        for (int a = 0; a < 2; a++) force[a] += set->force * amount[k] * contact->disc[k][a];
    }
    line->reaction[c] = fmax(0, reaction);
    if (law->frictionless) return;
    if (!law->frozen) line->friction_bound[c] = contact_law->friction * line->reaction[c];
    if (!contact_law->given)
        cpsi_friction_law_clip(contact_law, line->friction_bound[c], line->friction_bound[c],
                               force);
    force[2] = 0;
    cpsi_frame_from(&line->friction_force[3 * c], axes, force);
}

void cpsi_force_set_apply(CpsiForceSet *set, CpsiLine *line, const CpsiForceLaw *law) {
    const double *u = set->program.base.u;
    for (int j = 0; j < line->n; j++) {
        if (set->site[j] < 0) continue;
        const CpsiSite *site = &set->program.site[set->site[j]];
        Node node;
        double gain[2], amount[COLUMNS];
        build_node(set, line, law, j, &node);
        const int before = scalar_of(set, line, j - 1, &gain[0]),
                  after = scalar_of(set, line, j, &gain[1]);
        for (int k = 0; k < node.columns; k++) {
            amount[k] = (before >= 0 ? gain[0] * u[before] * node.left[k] : 0) -
                        (after >= 0 ? gain[1] * u[after] * node.right[k] : 0);
            for (int a = 0; a < node.own; a++) amount[k] += u[site->at + a] * node.null_space[a][k];
        }
        for (int i = 0; i < node.contacts; i++)
            store_contact(set, line, law, node.which[i], &node.contact[i], &amount[node.first[i]]);
    }
    for (int e = 0; e + 1 < line->n; e++) {
        if (set->scalar[e] < 0) continue;
        const double tension =
            fmax(0, set->tension[e] + set->force * set->gain[e] * u[set->scalar[e]]);
        const Vec3 p = vec3_axpy(tension - set->tension[e], vec3_at(set->tangent, e),
                                 vec3_at(line->segment_force, e));
        vec3_store(&line->segment_force[3 * e], p);
        line->tension[e] = tension;
    }
}

int cpsi_force_set_share(const CpsiForceSet *set, const CpsiLine *line, const CpsiForceLaw *law,
                         int c, double share[CPSI_SITE_OWN]) {
    const int j = cpsi_line_node(line, c);
    if (set->site[j] < 0) return -1;
    Node node;
    CpsiForceSet view = *set;
    build_node(&view, line, law, j, &node);
    for (int i = 0; i < node.contacts; i++) {
        if (node.which[i] != c) continue;
        for (int a = 0; a < CPSI_SITE_OWN; a++)
            share[a] = a < node.own ? dot(node.contact[i].columns, node.contact[i].rise,
                                          &node.null_space[a][node.first[i]])
                                    : 0;
        return set->site[j];
    }
    return -1;
}

/* the fields as they were ---------------------------------------------------------------------- */

void cpsi_force_set_layout(CpsiForceSet *set, CpsiArena *arena, int n, int contacts) {
    const int all = n * contacts;
    cpsi_scalar_program_layout(&set->program, arena, n, 2 * n + 1, CONES * all + n + 1);
    CPSI_PLACE(arena, set->tangent, 3 * (size_t)n);
    CPSI_PLACE(arena, set->tension, n);
    CPSI_PLACE(arena, set->gain, n);
    CPSI_PLACE(arena, set->scalar, n);
    CPSI_PLACE(arena, set->site, n);
    CPSI_PLACE(arena, set->segment_force, 3 * (size_t)n);
    CPSI_PLACE(arena, set->kept_tension, n);
    CPSI_PLACE(arena, set->reaction, all);
    CPSI_PLACE(arena, set->friction_force, 3 * (size_t)all);
    CPSI_PLACE(arena, set->bound, all);
}

/* Copy the fields of a line to the set, or back. */
static void copy_fields(const CpsiForceSet *set, CpsiLine *line, bool back) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    const struct {
        double *copy, *field;
        size_t count;
    } fields[] = {{set->segment_force, line->segment_force, 3 * (n - 1)},
                  {set->kept_tension, line->tension, n - 1},
                  {set->reaction, line->reaction, contacts},
                  {set->friction_force, line->friction_force, 3 * contacts},
                  {set->bound, line->friction_bound, contacts}};
    for (size_t k = 0; k < sizeof fields / sizeof *fields; k++)
        memcpy(back ? fields[k].field : fields[k].copy, back ? fields[k].copy : fields[k].field,
               fields[k].count * sizeof(double));
}

void cpsi_force_set_keep(CpsiForceSet *set, const CpsiLine *line) {
    copy_fields(set, (CpsiLine *)(uintptr_t)line, false);
}
void cpsi_force_set_restore(const CpsiForceSet *set, CpsiLine *line) {
    copy_fields(set, line, true);
}
