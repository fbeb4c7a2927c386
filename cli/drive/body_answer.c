/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan drive: bodies and vehicles; their law in numbers, pushes, and a tow along its path. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "drive/system_answer.h"
#include "law/set_answer.h"
#include "plot_file.h"
#include "progress.h"

/* The history of a tow: poses and driven ends, of which the first is the start. */
typedef struct TowHistory {
    int count;
    double *pose, *end; /* (count, 3), (count, 2) */
    CpsTow tow;
    CpsTowStep last;
    int not_converged, slack, inaccurate;
    double lower, upper; /* [J] bounds of the dissipation */
} TowHistory;

/* ---- the law ---- */

/* Figures of a body: forces at unit motions, and the largest distance of the exact limit surface
 * inside the ellipsoid. */
typedef struct Facts {
    double load, fx, fy, torque, torque_lower, torque_upper, cells;
    /* smallest ratio of the exact surface's length to the ellipsoid's along a ray in (Fx, M), and
     * vx/(w torque/fx) there */
    double ellipsoid, ratio;
} Facts;

/* length of the exact surface's point for the motion (cos a, 0, sin a), as a share of the
 * ellipsoid's */
static double share_of_ellipsoid(const CpsPlanar *body, const Facts *f, double a) {
    const double twist[3] = {cos(a) / f->fx, 0, sin(a) / f->torque};
    double wrench[3];
    CpsSetAnswer answer;
    CpsError unused;
    if (cps_planar_dissipation(body, twist, wrench, NULL, &answer, &unused) != CPS_OK) return 1;
    return hypot(wrench[0] / f->fx, wrench[2] / f->torque);
}

/* the smallest share: a scan, then golden section search around its minimum */
static void find_ellipsoid(const CpsPlanar *body, Facts *f) {
    const double quarter = 1.57079632679489662, golden = 0.61803398874989485;
    int best = 0;
    double least = INFINITY;
    for (int i = 1; i < 200; i++) {
        const double share = share_of_ellipsoid(body, f, quarter * i / 200);
        if (share < least) {
            least = share;
            best = i;
        }
    }
    double low = quarter * (best - 1) / 200, high = quarter * (best + 1) / 200;
    for (int i = 0; i < 60; i++) {
        const double a = high - golden * (high - low), b = low + golden * (high - low);
        if (share_of_ellipsoid(body, f, a) < share_of_ellipsoid(body, f, b))
            high = b;
        else
            low = a;
    }
    const double at = 0.5 * (low + high);
    f->ellipsoid = fmin(least, share_of_ellipsoid(body, f, at));
    f->ratio = tan(quarter - at);
}

static bool query_facts(DriveRun *run, Facts *f) {
    const CpsDriveBody *b = &run->file->body;
    *f = (Facts){.ellipsoid = NAN, .ratio = NAN};
    double *const to[3] = {&f->fx, &f->fy, &f->torque};
    CpsSetAnswer answer;
    CpsPlanarBounds bounds;
    for (int i = 0; i < b->patch_count; i++) f->load += b->patch[i].load;
    for (int k = 0; k < 3; k++) {
        const double twist[3] = {k == 0, k == 1, k == 2};
        if (cps_planar_dissipation(b->planar, twist, NULL, NULL, &answer, &run->err) != CPS_OK)
            return false;
        *to[k] = answer.value;
    }
    const double turn[3] = {0, 0, 1};
    if (cps_planar_bounds(b->planar, turn, 1e-5, &bounds, &run->err) != CPS_OK) return false;
    f->torque_lower = bounds.lower;
    f->torque_upper = bounds.upper;
    f->cells = bounds.cell_count;
    if (f->fx > 0 && f->torque > 0) find_ellipsoid(b->planar, f);
    return true;
}

static bool print_body(DriveRun *run) {
    const CpsDriveBody *b = &run->file->body;
    Facts f;
    if (!query_facts(run, &f)) return false;
    if (run->json) {
        printf(", \"patches\": %d", b->patch_count);
        drive_json("load_N", f.load);
        drive_json("force_x_N", f.fx);
        drive_json("force_y_N", f.fy);
        drive_json("torque_Nm", f.torque);
        drive_json("torque_lower_Nm", f.torque_lower);
        drive_json("torque_upper_Nm", f.torque_upper);
        drive_json("ellipsoid_share", f.ellipsoid);
        drive_json("ellipsoid_at", f.ratio);
        return true;
    }
    printf("%s on %d %s%s, %.6g N in all\n", b->vehicle ? "vehicle" : "body", b->patch_count,
           b->vehicle ? "wheel" : "patch",
           b->patch_count == 1 ? ""
           : b->vehicle        ? "s"
                               : "es",
           f.load);
    printf("friction when it slides along x: %.10g N; along y: %.10g N; when it turns: %.10g N m\n",
           f.fx, f.fy, f.torque);
    printf("  the last, proved by sums over cells (%.3g): from %.10g to %.10g N m\n", f.cells,
           f.torque_lower, f.torque_upper);
    if (f.ellipsoid < 1 - 1e-9)
        printf("limit surface in (Fx, M), seen along Fy: as little as %.8g of the ellipsoid "
               "through its axes\n"
               "  along one ray (%.3g %% off), where vx/w = %.4g m\n",
               f.ellipsoid, 100 * (1 - f.ellipsoid), f.ratio * f.torque / f.fx);
    else if (isfinite(f.ellipsoid))
        puts("limit surface in (Fx, M), seen along Fy: nowhere inside the ellipsoid through its "
             "axes");
    return true;
}

/* ---- pushes ---- */

static void print_push(const CpsDrivePush *push, const CpsPlanarMotion *m, const double low[3],
                       const double high[3]) {
    static const char *const NAME[] = {"vx", "vy", "w"};
    if (m->outcome == CPS_SET_OUTCOME_NOT_ATTAINED) {
        printf("  no motion: %s\n", cps_set_outcome_text(m->outcome));
        return;
    }
    printf("  gamma = %.12g W, proved between bounds %.2g W apart\n", m->upper + 0.0,
           m->upper - m->lower);
    fputs("  twist (vx, vy, w) = ", stdout);
    law_print_vector(3, m->twist);
    /* m; for a larger distance the body does not turn */
    if (hypot(m->centre[0], m->centre[1]) < 1e9)
        printf(", turns about (%.10g, %.10g)", m->centre[0] + 0.0, m->centre[1] + 0.0);
    puts("");
    /* where motions are unique, those that dissipate at most 1e-9 more than the least differ by the
     * order of its square root */
    const double width = 1e-3 * (fabs(m->twist[0]) + fabs(m->twist[1]) + fabs(m->twist[2]));
    for (int k = 0; k < 3; k++)
        if (high[k] - low[k] > width)
            printf("  not unique: %s from %.6g to %.6g\n", NAME[k], low[k] + 0.0, high[k] + 0.0);
    fputs("  driving force: ", stdout);
    law_print_vector(push->row_count, m->drive);
    fputs("; wrench of friction ", stdout);
    law_print_vector(3, m->wrench);
    puts("");
}

static void json_push(const CpsDrivePush *push, const CpsPlanarMotion *m, const double low[3],
                      const double high[3]) {
    printf("{\"outcome\": \"%s\"", cps_set_outcome_name(m->outcome));
    drive_json_list("velocity", push->row_count, push->velocity);
    drive_json("lower_W", m->lower);
    drive_json("upper_W", m->upper);
    drive_json_list("twist", 3, m->twist);
    drive_json_list("wrench", 3, m->wrench);
    drive_json_list("drive", push->row_count, m->drive);
    drive_json_list("centre", 2, m->centre);
    drive_json_list("low", 3, low);
    drive_json_list("high", 3, high);
    putchar('}');
}

static bool answer_push(DriveRun *run, int i) {
    const CpsDriveBody *b = &run->file->body;
    const CpsDrivePush *push = &b->push[i];
    CpsPlanarMotion m;
    double low[3], high[3];
    if (cps_planar_drive(b->planar, push->row_count, push->map, push->velocity, &m, &run->err) !=
            CPS_OK ||
        cps_planar_motions(b->planar, push->row_count, push->map, push->velocity, 0, low, high,
                           &run->err) != CPS_OK)
        return false;
    run->answered &= m.outcome == CPS_SET_OUTCOME_ANSWERED;
    if (run->json) {
        if (i) fputs(",\n    ", stdout);
        json_push(push, &m, low, high);
        return true;
    }
    printf("push %d", i + 1);
    if (push->at_point) {
        fputs(" at ", stdout);
        law_print_vector(2, push->point);
    }
    fputs(push->row_count == 1   ? " at normal speed "
          : push->row_count == 2 ? " with velocity "
                                 : " with twist ",
          stdout);
    law_print_vector(push->row_count, push->velocity);
    puts("");
    print_push(push, &m, low, high);
    return true;
}

/* ---- tow ---- */

/* turning radius of the hitch in the last step */
static double turning_radius(const TowHistory *t) {
    const double *w = t->last.twist, *h = t->tow.hitch;
    return w[2] != 0 ? hypot(w[0] - w[2] * h[1], w[1] + w[2] * h[0]) / fabs(w[2]) : INFINITY;
}

static bool go(DriveRun *run, TowHistory *t) {
    const CpsDriveTow *tow = &run->file->body.tow;
    t->tow = tow->start;
    t->count = tow->step_count + 1;
    t->pose = malloc((size_t)t->count * 3 * sizeof *t->pose);
    t->end = malloc((size_t)t->count * 2 * sizeof *t->end);
    if (!t->pose || !t->end) {
        run->err = (CpsError){.status = CPS_ERR_MEMORY, .message = "out of memory"};
        return false;
    }
    cps_drive_walk(2, tow->point_count, tow->path, t->count, t->end);
    Progress progress =
        progress_begin(tow->step_count, run->options->quiet || tow->step_count < 2000);
    memcpy(t->pose, t->tow.pose, sizeof t->tow.pose);
    bool good = true;
    for (int i = 1; i < t->count && good; i++) {
        good = cps_planar_tow(run->file->body.planar, &t->tow, t->end + 2 * (size_t)i, &t->last,
                              &run->err) == CPS_OK;
        if (good && t->last.outcome != CPS_SET_OUTCOME_ANSWERED) t->inaccurate++;
        if (good && t->last.pulled) {
            t->not_converged += !t->last.converged;
            t->lower += t->last.lower;
            t->upper += t->last.upper;
        }
        t->slack += good && !t->last.pulled;
        memcpy(t->pose + 3 * (size_t)i, t->tow.pose, sizeof t->tow.pose);
        progress_step(&progress, i, "tow");
    }
    progress_end(&progress);
    return good;
}

static void print_tow(DriveRun *run, const TowHistory *t) {
    const double radius = turning_radius(t);
    run->answered &= t->inaccurate == 0;
    if (run->json) {
        printf(", \"tow\": {\"steps\": %d", t->count - 1);
        drive_json("work_J", t->tow.work);
        drive_json("dissipated_J", t->tow.dissipated);
        drive_json("lower_J", t->lower);
        drive_json("upper_J", t->upper);
        drive_json("turning_radius_m", radius);
        printf(", \"not_converged\": %d, \"slack\": %d, \"inaccurate\": %d", t->not_converged,
               t->slack, t->inaccurate);
        drive_json_rows("pose", 3, t->count, t->pose);
        drive_json_rows("end", 2, t->count, t->end);
        putchar('}');
        return;
    }
    printf("tow in %d steps: ends at (x, y, angle) = ", t->count - 1);
    law_print_vector(3, t->tow.pose);
    printf("\n  dissipated %.10g J (bounds of each step together %.2g J apart), work %.10g J\n",
           t->tow.dissipated, t->upper - t->lower, t->tow.work);
    if (isfinite(radius))
        printf("  the hitch turns on a radius of %.8g m in the last step\n", radius);
    if (t->slack)
        printf("  nothing moved in %d steps: the rope was slack, or its end rested\n", t->slack);
    if (t->not_converged)
        printf("  note: %d steps did not converge: the motion jumps with the orientation there\n",
               t->not_converged);
    if (t->inaccurate)
        printf("  note: %d steps have no certified motion; shorten them\n", t->inaccurate);
}

/* ---- the whole answer ---- */

typedef struct Drawing {
    const CpsDriveFile *file;
    const TowHistory *trail;
} Drawing;

static CpsStatus draw(void *user, FILE *out, CpsError *err) {
    const Drawing *d = user;
    return cps_drive_draw_body(d->file, d->trail->count, d->trail->pose, d->trail->end, out, err);
}

int drive_answer_body(DriveRun *run) {
    const CpsDriveBody *b = &run->file->body;
    TowHistory trail = {.count = 0};
    bool good = print_body(run);
    if (run->json) fputs(",\n  \"pushes\": [", stdout);
    for (int i = 0; i < b->push_count && good; i++) good = answer_push(run, i);
    if (run->json) putchar(']');
    if (good && b->tow.point_count > 0 && (good = go(run, &trail))) print_tow(run, &trail);
    int code = good ? EXIT_OK : cli_report(&run->err);
    Drawing drawing = {run->file, &trail};
    if (code == EXIT_OK && run->options->plot) code = cli_plot(draw, &drawing, run->options->plot);
    free(trail.pose);
    free(trail.end);
    return code;
}
