/* SPDX-License-Identifier: BSD-3-Clause */
/* Newton's method on the two end equations, with the exact Jacobian of the catenary. */
#include "catenary.h"

#include <math.h>

/* span and rise of the part that hangs between vertical forces low and high, and their
 * derivatives */
typedef struct Span {
    double x, z, x_h, x_high, x_low, z_h, z_high, z_low;
} Span;

static Span hanging(double h, double low, double high, double w, double ea) {
    double top = hypot(h, high), bottom = hypot(h, low);
    double turn = asinh(high / h) - asinh(low / h), length = (high - low) / w;
    return (Span){
        .x = h / w * turn + h * length / ea,
        .z = (top - bottom) / w + (high * high - low * low) / (2 * w * ea),
        .x_h = (turn - high / top + low / bottom) / w + length / ea,
        .x_high = h / w / top + h / (w * ea),
        .x_low = -h / w / bottom - h / (w * ea),
        .z_h = (h / top - h / bottom) / w,
        .z_high = high / top / w + high / (w * ea),
        .z_low = -low / bottom / w - low / (w * ea),
    };
}

bool catenary_solve(Catenary *c, double x, double z) {
    double w = c->weight, ea = c->stiffness, total = w * c->length;
    for (int k = 0; k < 200; k++) {
        bool rests = c->bed && c->v < total;
        double low = rests ? 0 : c->v - total, resting = rests ? c->length - c->v / w : 0;
        Span s = hanging(c->h, low, c->v, w, ea);
        double error_x = s.x + resting * (1 + c->h / ea) - x, error_z = s.z - z;
        if (fabs(error_x) + fabs(error_z) <= 1e-13 * (x + fabs(z))) return true;
        // derivatives by h and v; low moves with v unless it rests
        double a = s.x_h + resting / ea, b = s.x_high + (rests ? -(1 + c->h / ea) / w : s.x_low);
        double d = s.z_h, e = s.z_high + (rests ? 0 : s.z_low), det = a * e - b * d;
        double dh = -(e * error_x - b * error_z) / det, dv = -(a * error_z - d * error_x) / det;
        double keep = c->h + dh < 0.2 * c->h ? -0.8 * c->h / dh : 1; // h stays positive
        c->h += keep * dh;
        c->v += keep * dv;
    }
    return false;
}

void catenary_point(const Catenary *c, double s, double *x, double *z) {
    double low = c->v - c->weight * c->length;
    Span part = hanging(c->h, low, low + c->weight * s, c->weight, c->stiffness);
    *x = part.x;
    *z = part.z;
}
