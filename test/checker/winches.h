/* SPDX-License-Identifier: BSD-3-Clause */
/* Winches: what is off their drums, by lengths of the whole line and what the file says is stored.
 * A record is that of the line off the drums: all that is checked of a line is checked of it. */
#ifndef CAPSTAN_CHECKER_WINCHES_H
#define CAPSTAN_CHECKER_WINCHES_H

#include "record.h"

/* Prepare a record whose whole line has been read; a line without winches has none. Both return 0,
 * or -1 after one sentence on log. */
int winches_create(const Source *source, const char *line, Record *record, FILE *log);
/* Make a record the whole line again, before a step is read. */
void winches_whole(Record *record);
/* Of the step that was read, leave what is off the drums. Those on a drum must be where it is, and
 * carry nothing. */
int winches_read(const Source *source, const char *line, size_t step, Record *record, FILE *log);
void winches_destroy(Record *record);

/* Does the reference of a step begin where the step before has ended, of the whole line? */
bool winches_continue(const Record *record, const Record *before);
/* Do winches wind in a step? */
bool winches_wind(const Record *record, const Record *before);

/* [J] What the ledger of a step in one part in which winches wind has to say. */
typedef struct WinchLedger {
    Real elastic, gravity, winches, size; /* size: of the terms */
    bool known;                           /* the gravity is */
} WinchLedger;
WinchLedger winches_ledger(const Source *source, const Record *record, const Record *before);
/* [N] The pull on the drum of an end. */
Real winches_pull(const Source *source, const Record *record, int end);

#endif
