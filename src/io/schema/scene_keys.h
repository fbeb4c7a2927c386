/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of a scene file's keys. It drives the validation and its messages (validate.c), the reading of what needs no more than a row
 * (cpsi_scene_store), the suggestions for unknown keys and the JSON schema (scene_json.c).
 *
 * Keys of a form: "NAME" stands for any name, "LINE.END" for an end of a line, as cable.B, "OBSTACLE.turn" for drum.turn. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_SCENE_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_SCENE_KEYS_H

#include "io/schema/keys.h"

/* The mappings of a scene file; their keys are in scene_keys.c. */
typedef enum CpsiObject {
    CPSI_SCENE,
    CPSI_OBSTACLES, /* {NAME: obstacle} */
    CPSI_OBSTACLE,
    CPSI_PLANE,
    CPSI_CYLINDER,
    CPSI_SPHERE,
    CPSI_FRICTION,
    CPSI_LINES, /* {NAME: line} */
    CPSI_LINE,
    CPSI_ZONE,
    CPSI_START,
    CPSI_STRAIGHT,
    CPSI_ARC,
    CPSI_ENDS,
    CPSI_END,
    CPSI_SOLVER,
    CPSI_STAGE,
    CPSI_CHANGE,
    CPSI_OBJECT_COUNT
} CpsiObject;

/* The rows of an object: *count of them. */
const CpsiKey *cpsi_keys(CpsiObject object, int *count);

/* What an object is called in messages and in the schema: "line", "entry", ... */
const char *cpsi_object_name(CpsiObject object);

/* The row for a key written in an object; NULL: there is none. A name, LINE.END and OBSTACLE.turn are recognised by
 * their form alone. */
const CpsiKey *cpsi_key_find(CpsiObject object, const char *written);

/* The 'A' or 'B' after the last dot of LINE.END; 0: no such form. */
char cpsi_key_end(const char *written);

/* Is this of the form OBSTACLE.turn? */
bool cpsi_key_is_turn(const char *written);

/* What a row accepts, for messages: "a number in m, greater than 0".
 * text   (size) written, always terminated; returns text */
const char *cpsi_key_expected(const CpsiKey *key, char *text, size_t size);

#endif
