/* SPDX-License-Identifier: BSD-3-Clause */
/* Axes of a node: Q (3, 3) row by row, its rows orthonormal. A vector v of the common axes is Q v
 * in the node's. */
#ifndef CAPSTAN_SRC_CHAIN_FRAME_H
#define CAPSTAN_SRC_CHAIN_FRAME_H

/* out = Q v: from the common axes to the node's. out is not v. */
static inline void cpsi_frame_to(double out[3], const double q[9], const double v[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = q[3 * i] * v[0] + q[3 * i + 1] * v[1] + q[3 * i + 2] * v[2];
}

/* out = Q^T v: back. */
static inline void cpsi_frame_from(double out[3], const double q[9], const double v[3]) {
    for (int i = 0; i < 3; i++) out[i] = q[i] * v[0] + q[3 + i] * v[1] + q[6 + i] * v[2];
}

/* out = P Q^T: what takes the axes Q to the axes P. */
static inline void cpsi_frame_relative(double out[9], const double p[9], const double q[9]) {
    for (int i = 0; i < 3; i++) cpsi_frame_to(&out[3 * i], q, &p[3 * i]);
}

/* out = Q M Q^T */
static inline void cpsi_frame_turn(double out[9], const double q[9], const double m[9]) {
    double qm[9];
    for (int i = 0; i < 3; i++) cpsi_frame_from(&qm[3 * i], m, &q[3 * i]);
    cpsi_frame_relative(out, qm, q);
}

#endif
