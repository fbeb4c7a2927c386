/* SPDX-License-Identifier: BSD-3-Clause */
/* The report of a step: the state of each node, lengths and sums, the ends. */
#ifndef CAPSTAN_SRC_CABLE_REPORT_H
#define CAPSTAN_SRC_CABLE_REPORT_H

#include "cable/line.h"
#include "chain/chain_program.h"

/* Free, stick or slip, and slack, from the pairs of the solution; slack length, dissipation. */
void cpsi_line_classify(CpsiLine *line, const CpsiChainProgram *program);

/* Forces and tensions at the ends, and what the friction of their half elements dissipates. */
void cpsi_line_report_ends(CpsiLine *line);

/* The vertical parts and angles of the forces at the ends, these having been reported; against
 * gravity is up, or z without gravity. */
void cpsi_line_report_uplift(CpsiLine *line, const double gravity[3]);

/* Lengths that lie on an obstacle and that slid there, those from the ends to the first contact and
 * where that is, the ends having been reported. */
void cpsi_line_report_lengths(CpsiLine *line);

/* The history starts where the line is. */
void cpsi_line_keep_start(CpsiLine *line);

/* How far what touches is to the side of where it was at the start, in plan; up as for uplift. */
void cpsi_line_report_sweep(CpsiLine *line, const double gravity[3]);

/* The largest tension over the breaking load, where the line has one, the ends having been
 * reported. */
void cpsi_line_report_utilisation(CpsiLine *line);

/* [m] The slip of an end on obstacle k in this step: the path of the node, less that of an obstacle
 * that turns. */
Vec3 cpsi_line_end_slip(const CpsiLine *line, int end, int k);

#endif
