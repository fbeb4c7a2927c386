/* SPDX-License-Identifier: BSD-3-Clause */
/* The energy of a history in time (see energy.h). */
#include "run/energy.h"

void energy_note_step(Energy *energy, const CpsEvolution *evolution) {
    const CpsStepReport report = cps_evolution_report(evolution);
    const CpsStepMotion motion = cps_evolution_motion(evolution);
    cps_ledgers_add(&report.ledger, &motion.ledger, &energy->sum, &energy->motion);
    energy->in_time = energy->in_time || cps_evolution_pace(evolution).length > 0;
}

typedef struct Entry {
    const char *name;
    double value;
} Entry;

/* The entries that are not 0. */
static void print_entries(const char *head, const Entry *entry, int count, FILE *out) {
    fprintf(out, "  %-10s", head);
    for (int i = 0; i < count; ++i)
        if (entry[i].value != 0) fprintf(out, " %s %.6g ", entry[i].name, entry[i].value);
    fputc('\n', out);
}

void energy_print(const Energy *energy, FILE *out) {
    if (!energy->in_time) return;
    const CpsLedger *sum = &energy->sum;
    const CpsMotionLedger *motion = &energy->motion;
    const Entry in[] = {{"ends", sum->ends},
                        {"obstacles", sum->obstacles},
                        {"winches", sum->winches},
                        {"loads", sum->loads},
                        {"waves", motion->waves}};
    const Entry to[] = {{"elastic", sum->elastic},      {"gravity", sum->gravity},
                        {"kinetic", motion->kinetic},   {"friction", sum->dissipated},
                        {"impact", motion->impact},     {"damping", motion->damping},
                        {"drag", motion->drag},         {"added", motion->added},
                        {"settling", motion->settling}, {"scheme", motion->scheme}};
    fputs("\nenergy over all steps [J]\n", out);
    print_entries("work of", in, sizeof in / sizeof *in, out);
    print_entries("goes to", to, sizeof to / sizeof *to, out);
    fprintf(out, "  %-10s %.3g", "remainder", sum->imbalance);
    if (motion->turnover > 0)
        fprintf(out, ", %.1e of the sizes of all entries of all steps",
                (sum->imbalance < 0 ? -sum->imbalance : sum->imbalance) / motion->turnover);
    fputc('\n', out);
}
