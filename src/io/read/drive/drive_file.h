/* SPDX-License-Identifier: BSD-3-Clause */
/* The kinds of driven system made from their values, one function each. The results are freed with
 * the file, also on failure. */
#ifndef CAPSTAN_SRC_IO_READ_DRIVE_DRIVE_FILE_H
#define CAPSTAN_SRC_IO_READ_DRIVE_DRIVE_FILE_H

#include "capstan/io.h"
#include "io/read/law/set_build.h"
#include "io/schema/tables/drive_keys.h"

CpsStatus cpsi_build_system(CpsiSetBuild *b, const CpsiSystemValues *values, CpsDriveSystem *out);
CpsStatus cpsi_build_body(CpsiSetBuild *b, const CpsiBodyValues *values, bool vehicle,
                          CpsDriveBody *out);
CpsStatus cpsi_build_planimeter(CpsiSetBuild *b, const CpsiPlanimeterValues *values,
                                CpsDrivePlanimeter *out);
CpsStatus cpsi_build_rope(CpsiSetBuild *b, const CpsiRopeValues *values, CpsDriveRope *out);
CpsStatus cpsi_build_sweep(CpsiSetBuild *b, const CpsiSweepValues *values, CpsDriveSweep *out);

#endif
