/* SPDX-License-Identifier: BSD-3-Clause */
/* What a scene gives of the surface of the water, and of what floats (water_check.h). */
#include "evolve/water_check.h"

#include "base/status.h"
#include "evolve/ranges.h"

CpsStatus cpsi_water_check(const CpsScene *scene, const double gravity[3], const char *what,
                           CpsError *err) {
    if (!scene->has_water_surface) return CPS_OK;
    if (gravity[0] == 0 && gravity[1] == 0 && gravity[2] <= 0) return CPS_OK;
    return CPSI_FAIL_AT("gravity", err, CPS_ERR_ARGUMENT,
                        "%s: (%g, %g, %g) m/s2 in a scene with a water surface, which is a plane "
                        "z = constant: expected (0, 0, -g)",
                        what, gravity[0], gravity[1], gravity[2]);
}

CpsStatus cpsi_water_point_check(const CpsScene *scene, const CpsPoint *point, CpsError *err) {
    if (!cpsi_is_not_negative(point->displaced_weight))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "point '%s': it displaces water of %g N, expected a finite number, at "
                         "least 0",
                         point->name, point->displaced_weight);
    if (!cpsi_is_not_negative(point->height))
        return CPSI_FAIL_AT("height", err, CPS_ERR_ARGUMENT,
                            "point '%s': height is %g m, expected a finite number >= 0",
                            point->name, point->height);
    if (point->height > 0 && !(scene->has_water_surface && point->displaced_weight > 0))
        return CPSI_FAIL_AT("height", err, CPS_ERR_ARGUMENT,
                            "point '%s': height: it is that of what floats, but %s", point->name,
                            scene->has_water_surface
                                ? "the point displaces no water: give its volume, or leave the "
                                  "height out"
                                : "the water has no surface: give water_surface, or leave the "
                                  "height out");
    return CPS_OK;
}
