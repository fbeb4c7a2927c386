/* SPDX-License-Identifier: BSD-3-Clause */
/* The phase of a wave far from 0. */
#ifndef CAPSTAN_SRC_CABLE_WAVE_ORIGIN_H
#define CAPSTAN_SRC_CABLE_WAVE_ORIGIN_H

#include "capstan/waves.h"

/* [rad] k (e . origin) of a wave, e its direction, less whole turns: its phase at the origin beyond
 * that at 0, to rounding however far that is. number [1/m] is k to rounding, depth [m] > 0 may be
 * infinite, g [m/s2] > 0. */
double cpsi_wave_way(const CpsWave *given, double number, double depth, double g,
                     const double origin[3]);

#endif
