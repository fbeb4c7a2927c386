/* SPDX-License-Identifier: BSD-3-Clause */
/* The force of a scene's waves on its bodies, from its definition (body.h). */
#ifndef CAPSTAN_CHECKER_EXCITATION_H
#define CAPSTAN_CHECKER_EXCITATION_H

#include "capstan/scene.h"

/* Force and moment on a body of the scene at a time, and to how much each component is known. */
void excitation(const CpsScene *scene, int body, double time, double out[6], double noise[6]);

#endif
