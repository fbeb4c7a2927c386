/* SPDX-License-Identifier: BSD-3-Clause */
/* The rotation Q at which tr(Q' M) is largest, for any matrix M (3, 3). */
#ifndef CAPSTAN_SRC_LINALG_FARTHEST_ROTATION_H
#define CAPSTAN_SRC_LINALG_FARTHEST_ROTATION_H

/* Returns that trace, and the rotation as a unit quaternion w, x, y, z. */
double cpsi_farthest_rotation(double m[3][3], double quaternion[4]);

#endif
