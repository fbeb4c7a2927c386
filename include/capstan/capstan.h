/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/capstan.h: everything but files (those are in io.h and results.h,
 * library capstan-io). */
#ifndef CAPSTAN_CAPSTAN_H
#define CAPSTAN_CAPSTAN_H

#include "capstan/base.h"
#include "capstan/drive.h"
#include "capstan/evolve.h"
#include "capstan/law.h"
#include "capstan/planar.h"
#include "capstan/regularized.h"
#include "capstan/scene.h"
#include "capstan/set.h"
#include "capstan/step.h"

#endif
