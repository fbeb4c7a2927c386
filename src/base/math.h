/* SPDX-License-Identifier: BSD-3-Clause */
/* Constants of mathematics. */
#ifndef CAPSTAN_SRC_BASE_MATH_H
#define CAPSTAN_SRC_BASE_MATH_H

#define CPSI_PI     3.14159265358979323846
#define CPSI_DEGREE (CPSI_PI / 180) /* [rad] */

#endif
