/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies: from the values of a scene file to the scene's structs (see body_build.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/math.h"
#include "io/read/scene/parts/body_build.h"

static void copy_vector(double out[3], const double x[3]) { memcpy(out, x, 3 * sizeof *out); }

/* ---- rotations ---- */

/* a b, which turns by b and then by a */
static void multiply(const double a[4], const double b[4], double out[4]) {
    out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    out[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    out[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

/* Yaw about z, pitch about the new y and roll about the new x are, in axes that
 * stay, first roll about x, then pitch about y, then yaw about z. */
void cpsi_rotation_build(const CpsiRotationValues *values, double out[4]) {
    if (values->form == CPSI_ROTATION_QUATERNION) {
        memcpy(out, values->quaternion, 4 * sizeof *out);
        return;
    }
    double about[3][4] = {{0}}, both[4];
    for (int i = 0; i < 3; i++) {
        const double half = 0.5 * values->angle[i] * CPSI_DEGREE;
        about[i][0] = cos(half);
        about[i][1 + i] = sin(half);
    }
    multiply(about[1], about[0], both);
    multiply(about[2], both, out);
}

/* Add the moment of a force at an arm. */
static void add_arm(const double arm[3], const double force[3], double moment[3]) {
    for (int i = 0; i < 3; i++) {
        const int k = (i + 1) % 3, l = (i + 2) % 3;
        moment[i] += arm[k] * force[l] - arm[l] * force[k];
    }
}

/* ---- bodies ---- */

/* `centre` goes with one of two other keys. */
static CpsStatus check_centre(const CpsiDocument *d, const CpsiYaml *node, const char *centre,
                              const char *one, const char *other) {
    const CpsiYaml *given = cpsi_yaml_child(node, centre);
    if (!given || cpsi_yaml_child(node, one) || cpsi_yaml_child(node, other)) return CPS_OK;
    return cpsi_document_fail(d, CPS_ERR_INPUT, given,
                              "'%s': it goes with '%s' or '%s', of which neither is given", centre,
                              one, other);
}

/* What is free is held by lines and has a weight, or water under it: without a word of either it
 * was forgotten. */
static bool has_own_forces(const CpsiYaml *node) {
    static const char *const KEYS[] = {"mass", "weight", "volume", "buoyancy", "hydrostatics"};
    bool any = false;
    for (size_t i = 0; i < sizeof KEYS / sizeof *KEYS; i++)
        any = any || cpsi_yaml_child(node, KEYS[i]);
    return any;
}

static CpsStatus check_body(const CpsiMaterials *m, const CpsiSceneBodyValues *values) {
    const CpsiYaml *node = values->node, *volume = cpsi_yaml_child(node, "volume");
    if (values->body.kind == CPS_BODY_KIND_FREE && !has_own_forces(node))
        return cpsi_document_fail(
            m->d, CPS_ERR_INPUT, node,
            "body '%s': it is free and has neither mass nor hydrostatics: give "
            "its 'mass' or 'weight' (0 of one without), 'volume', 'buoyancy' "
            "or 'hydrostatics'",
            node->key);
    CpsStatus status = check_centre(m->d, node, "centre_of_gravity", "mass", "weight");
    if (status == CPS_OK)
        status = check_centre(m->d, node, "centre_of_buoyancy", "volume", "buoyancy");
    if (status == CPS_OK && volume && values->volume > 0 && m->water == 0)
        return cpsi_document_fail(m->d, CPS_ERR_INPUT, volume,
                                  "'volume': it displaces water, but the scene has no "
                                  "'water_density': give that, or the 'buoyancy' in N");
    return status;
}

/* A matrix given as rows or as its diagonal. */
static void build_matrix(const CpsiNumberRows *rows, const CpsiDiagonalValues *diagonal,
                         double out[36]) {
    if (rows->node) memcpy(out, rows->x, 36 * sizeof *out);
    if (diagonal->node)
        for (int i = 0; i < CPS_BODY_DIRECTIONS; i++)
            out[(CPS_BODY_DIRECTIONS + 1) * i] = diagonal->k[i];
}

/* Of steps in time; what is given by its weight has the mass that weighs it. */
static void build_motion(const CpsiMaterials *m, const CpsiSceneBodyValues *values, CpsBody *body) {
    body->mass = !isnan(values->mass) ? values->mass
                 : m->gravity > 0     ? body->weight / m->gravity
                                      : 0;
    copy_vector(body->inertia, values->moments);
    copy_vector(&body->inertia[3], values->products);
    copy_vector(body->velocity, values->velocity);
    copy_vector(&body->velocity[3], values->turn_rate);
    build_matrix(&values->added_mass, &values->added_diagonal, body->added_mass);
    build_matrix(&values->damping, &values->damping_diagonal, body->damping);
    build_matrix(&values->quadratic, &values->quadratic_diagonal, body->quadratic_damping);
}

static CpsStatus build_excitation(const CpsiMaterials *m, const CpsiList *rows, CpsBody *body) {
    const CpsiExcitationValues *values = rows->item;
    CpsExcitation *row = CPSI_POOL_TAKE(m->pool, rows->count, CpsExcitation);
    if (!row) return cpsi_document_no_memory(m->d);
    for (int k = 0; k < rows->count; k++) {
        row[k].period = isnan(values[k].period) ? 1 / values[k].frequency : values[k].period;
        row[k].direction = values[k].direction * CPSI_DEGREE;
        for (int j = 0; j < CPS_BODY_DIRECTIONS; j++) {
            row[k].amplitude[j] = values[k].amplitude[j];
            row[k].lead[j] = values[k].phase[j] * CPSI_DEGREE;
        }
    }
    body->excitation = row;
    body->excitation_count = rows->count;
    return CPS_OK;
}

/* A kernel is symmetric where one of two entries is given. */
static CpsStatus build_radiation(const CpsiMaterials *m, const CpsiSceneBodyValues *values,
                                 CpsBody *body) {
    enum { SIX = CPS_BODY_DIRECTIONS, COLUMNS = 1 + SIX * SIX, LONGEST = 4 };
    CpsiCsvColumn column[COLUMNS] = {{"time", "s", CPSI_CSV_REQUIRED}};
    char name[COLUMNS][LONGEST];
    CpsiCsvTable table;
    const char *path;
    const CpsiYaml *node = cpsi_yaml_child(values->node, "radiation");
    for (int i = 0; i < SIX; i++)
        for (int k = 0; k < SIX; k++) {
            const int c = 1 + SIX * i + k;
            snprintf(name[c], LONGEST, "k%d%d", i + 1, k + 1);
            column[c] = (CpsiCsvColumn){name[c],
                                        i < 3 && k < 3   ? "N/m"
                                        : i < 3 || k < 3 ? "N"
                                                         : "N m",
                                        CPSI_CSV_OPTIONAL};
        }
    const CpsStatus status =
        cpsi_document_table(m->d, node, values->radiation, column, COLUMNS, m->pool, &table, &path);
    if (status != CPS_OK) return status;
    CpsRadiation *row = CPSI_POOL_TAKE(m->pool, table.rows, CpsRadiation);
    if (!row) return cpsi_document_no_memory(m->d);
    bool any = false;
    for (int c = 1; c < COLUMNS; c++) any = any || table.has[c];
    if (!any || table.rows < 2)
        return cpsi_fail_at(m->d->err, CPS_ERR_INPUT, path, 0, 0,
                            any ? "found one row, expected at least two"
                                : "found times alone, expected a column beside them");
    for (int r = 0; r < table.rows; r++) {
        const double *value = &table.value[COLUMNS * r];
        row[r].time = value[0];
        for (int i = 0; i < SIX; i++)
            for (int k = 0; k < SIX; k++) {
                const bool has = table.has[1 + SIX * i + k];
                row[r].kernel[SIX * i + k] = value[1 + (has ? SIX * i + k : SIX * k + i)];
            }
    }
    body->radiation = row;
    body->radiation_count = table.rows;
    return CPS_OK;
}

static CpsStatus build_members(const CpsiMaterials *m, const CpsiList *members, CpsBody *body) {
    const CpsiMemberValues *values = members->item;
    CpsMember *member = CPSI_POOL_TAKE(m->pool, members->count, CpsMember);
    if (!member) return cpsi_document_no_memory(m->d);
    for (int k = 0; k < members->count; k++) member[k] = values[k].member;
    body->member = member;
    body->member_count = members->count;
    return CPS_OK;
}

static CpsStatus build_body(const CpsiMaterials *m, const CpsiSceneBodyValues *values,
                            CpsBody *body) {
    const CpsiYaml *name = values->node;
    const CpsStatus status = check_body(m, values);
    if (status != CPS_OK) return status;
    *body = values->body;
    body->name = cpsi_pool_text(m->pool, name->key, strlen(name->key));
    if (!body->name) return cpsi_document_no_memory(m->d);
    if (values->rotation.node) cpsi_rotation_build(&values->rotation, body->rotation);
    if (!isnan(values->mass)) body->weight = values->mass * m->gravity;
    if (!isnan(values->volume)) body->buoyancy = m->water * values->volume * m->gravity;
    build_matrix(&values->hydrostatics, &values->diagonal, body->hydrostatics);
    add_arm(values->arm, body->force, body->moment);
    build_motion(m, values, body);
    if (values->members.count > 0) {
        const CpsStatus built = build_members(m, &values->members, body);
        if (built != CPS_OK) return built;
    }
    if (values->radiation) {
        const CpsStatus built = build_radiation(m, values, body);
        if (built != CPS_OK) return built;
    }
    return values->excitation.count > 0 ? build_excitation(m, &values->excitation, body) : CPS_OK;
}

CpsStatus cpsi_bodies_build(const CpsiMaterials *m, const CpsiList *bodies, CpsScene *scene,
                            CpsiHeldPose **held) {
    const CpsiSceneBodyValues *values = bodies->item;
    *held = NULL;
    if (bodies->count == 0) return CPS_OK;
    CpsBody *body = CPSI_POOL_TAKE(m->pool, bodies->count, CpsBody);
    *held = CPSI_POOL_TAKE(m->d->pool, bodies->count, CpsiHeldPose);
    if (!body || !*held) return cpsi_document_no_memory(m->d);
    scene->body = body;
    scene->body_count = bodies->count;
    for (int k = 0; k < bodies->count; k++) {
        const CpsStatus status = build_body(m, &values[k], &body[k]);
        if (status != CPS_OK) return status;
        CpsiHeldPose *pose = &(*held)[k];
        pose->is_known = body[k].kind == CPS_BODY_KIND_HELD;
        copy_vector(pose->position, body[k].position);
        memcpy(pose->rotation, body[k].rotation, sizeof pose->rotation);
    }
    return CPS_OK;
}

CpsStatus cpsi_body_find(const CpsiDocument *d, const CpsScene *scene, const CpsiYaml *node,
                         int *index) {
    CpsSuggestion suggestion = {.word = node->text};
    for (int k = 0; k < scene->body_count; k++) {
        cps_suggest(&suggestion, scene->body[k].name);
        if (strcmp(scene->body[k].name, node->text) != 0) continue;
        *index = k;
        return CPS_OK;
    }
    if (scene->body_count == 0)
        return cpsi_document_fail(d, CPS_ERR_INPUT, node,
                                  "'body': found '%.64s', but the scene has no 'bodies': give it "
                                  "there, held or free",
                                  node->text);
    if (suggestion.best)
        return cpsi_document_fail(d, CPS_ERR_INPUT, node,
                                  "'body': there is no body '%.64s'; did you mean '%.64s'?",
                                  node->text, suggestion.best);
    return cpsi_document_fail(d, CPS_ERR_INPUT, node,
                              "'body': found '%.64s', expected the name of one of the %d bodies of "
                              "the scene",
                              node->text, scene->body_count);
}

/* ---- changes ---- */

/* The pose of one that is held; what is not given stays as it was. */
static CpsStatus build_pose(const CpsiDocument *d, const CpsiBodyChangeValues *values,
                            CpsiHeldPose *held, CpsBodyChange *change) {
    const CpsiYaml *node = values->node, *move = cpsi_yaml_child(node, "move");
    const bool moves = cpsi_yaml_child(node, "position"), turns = values->rotation.node;
    if (!held->is_known && !(moves && turns))
        return cpsi_document_fail(d, CPS_ERR_INPUT, move ? move : node->child,
                                  "'%s': the body's pose before it is not known (it is free): "
                                  "give both its 'position' and its 'rotation'",
                                  node->key);
    if (moves) copy_vector(held->position, values->position);
    if (move)
        for (int i = 0; i < 3; i++) held->position[i] += values->move[i];
    if (turns) cpsi_rotation_build(&values->rotation, held->rotation);
    held->is_known = true;
    change->kind = CPS_BODY_KIND_HELD;
    copy_vector(change->position, held->position);
    memcpy(change->rotation, held->rotation, sizeof change->rotation);
    return CPS_OK;
}

void cpsi_held_pose_sway(CpsiHeldPose *held, const double by[6]) {
    const double angle = hypot(hypot(by[3], by[4]), by[5]);
    double turn[4] = {cos(0.5 * angle)}, before[4];
    for (int i = 0; i < 3; i++) {
        held->position[i] += by[i];
        turn[1 + i] = angle > 0 ? sin(0.5 * angle) * (by[3 + i] / angle) : 0;
    }
    memcpy(before, held->rotation, sizeof before);
    multiply(turn, before, held->rotation);
}

CpsStatus cpsi_body_change_build(const CpsiDocument *d, const CpsiBodyChangeValues *values,
                                 CpsiHeldPose *held, CpsBodyChange *change) {
    const CpsiYaml *node = values->node;
    const bool poses = cpsi_yaml_child(node, "position") || cpsi_yaml_child(node, "move") ||
                       cpsi_yaml_child(node, "rotation");
    const bool loads = cpsi_yaml_child(node, "force") || cpsi_yaml_child(node, "moment");
    if (poses == loads)
        return cpsi_document_fail(d, CPS_ERR_INPUT, node,
                                  "'%s': %s, expected a pose ('position' or 'move', 'rotation') "
                                  "or a load ('force', 'moment')",
                                  node->key, poses ? "both given" : "nothing given");
    if (poses) return build_pose(d, values, held, change);
    held->is_known = false;
    change->kind = CPS_BODY_KIND_FREE;
    copy_vector(change->force, values->force);
    copy_vector(change->moment, values->moment);
    add_arm(values->arm, change->force, change->moment);
    return CPS_OK;
}
