/* SPDX-License-Identifier: BSD-3-Clause */
/* The kinds of file that drive_file.c reads, one function each; what they make is let go with the file, also on
 * failure. */
#ifndef CAPSTAN_SRC_IO_READ_DRIVE_FILE_H
#define CAPSTAN_SRC_IO_READ_DRIVE_FILE_H

#include "capstan/drive_io.h"
#include "io/read/drive_fields.h"

CpsStatus cpsi_drive_read_system(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveSystem *out);
CpsStatus cpsi_drive_read_body(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveBody *out);
CpsStatus cpsi_drive_read_vehicle(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveBody *out);
CpsStatus cpsi_drive_read_planimeter(CpsiDriveRead *r, const CpsiYaml *node, CpsDrivePlanimeter *out);
CpsStatus cpsi_drive_read_rope(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveRope *out);
CpsStatus cpsi_drive_read_sweep(CpsiDriveRead *r, const CpsiYaml *node, CpsDriveSweep *out);

#endif
