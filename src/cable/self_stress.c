/* SPDX-License-Identifier: BSD-3-Clause */
/* Self-stresses (self_stress.h).
 *
 * Where the lines are too short their excess e = max(0, |X_B - X_A|/l - 1) is minimised, as the
 * energy sum l e^2/(2c) of one element for each line. Its stationarity is the balance of the forces
 * p = (e/c) t at the joints, t the direction of the line, and sum p.(X_B - X_A) - |p| l is then the
 * sum of l e^2/c: positive wherever the least excess is not zero. */
#include "cable/self_stress.h"

#include <math.h>
#include <string.h>

#include "ipm/ipm.h"

/* The compliance is of the size of the excess, so that forces are of order one: so many tries, each
 * from the excess that the last one found. */
static const double FIRST = 1, LEAST = 1e-11;
enum { TRIES = 3, ITERATIONS = 100 };
static const double TARGET = 1e-13;
/* What is missing must exceed this share of the sum of |p| times the size of the numbers, which is
 * rounding, */
static const double ROUNDING = 1e-13;
/* ... and by this factor what the imbalance of the forces might bring at other places. */
static const double BEYOND = 2;

static Vec3 held_end(const CpsiLine *line, int end) { return vec3_load(line->end[end].value); }

/* The place of the end of a line in the program's start. */
static Vec3 start_of(const CpsiLine *line, const CpsiNetworkPart *part, int k, int end) {
    const int joint = part->at[k][end];
    return joint == CPSI_NO_JOINT ? held_end(&line[part->number[k]], end)
                                  : part->joint[joint].position;
}

/* Does line k take part? A line with a loose end bears no constant force; those at free bodies are
 * left out. */
static bool takes_part(const CpsiLine *line, const CpsiNetworkPart *part, int k) {
    const CpsiLine *one = &line[part->number[k]];
    for (int end = 0; end < 2; end++)
        if (part->at[k][end] >= part->own ||
            (part->at[k][end] == CPSI_NO_JOINT && one->end[end].kind != CPS_END_KIND_HELD))
            return false;
    return one->compliance == 0;
}

/* A chain of one element from end to end. */
static void fill_chain(CpsiChainProgram *chain, Vec3 span, double length, double unit,
                       double compliance) {
    cpsi_chain_program_resize(chain, 2, false);
    chain->drag = 0;
    chain->disc.count = chain->unilateral.count = chain->conic.count = 0;
    chain->bounds_coupled = false;
    memset(chain->base.load, 0, 6 * sizeof(double));
    memset(chain->base.u, 0, 6 * sizeof(double));
    chain->held[0] = chain->held[1] = 1;
    chain->segment.compliance = compliance;
    chain->segment.compliance_factor = NULL;
    chain->segment.length[1] = length / unit;
    vec3_store(&chain->segment.s[1][1], vec3_scale(1 / length, span));
}

/* Number the unknowns of the joints at which a line takes part, and let the matrix have the blocks
 * of those alone. Returns how many unknowns there are. */
static int number_joints(CpsiNetwork *network, const CpsiLine *line, const CpsiNetworkPart *part,
                         int *node) {
    CpsiNetworkProgram *program = &network->program;
    int count = 0;
    for (int j = 0; j < part->joints; j++) program->map[j].width = 0;
    for (int k = 0; k < part->lines; k++)
        for (int end = 0; end < 2; end++)
            if (takes_part(line, part, k) && part->at[k][end] != CPSI_NO_JOINT)
                program->map[part->at[k][end]].width = 3;
    for (int j = 0; j < part->own; j++) {
        if (program->map[j].width == 0) continue;
        node[count] = node[j];
        program->map[j] = cpsi_joint_map_of_point(3 * count++);
    }
    cpsi_graph_matrix_use(program->matrix, count, node);
    return 3 * count;
}

/* The program of the lines that take part, with so many unknowns. */
static void fill(CpsiNetwork *network, const CpsiLine *line, const CpsiNetworkPart *part,
                 double unit, double compliance, int unknowns) {
    CpsiNetworkProgram *program = &network->program;
    program->count = program->bodies = 0;
    program->joints = part->joints;
    for (int k = 0; k < part->lines; k++) {
        if (!takes_part(line, part, k)) continue;
        const CpsiLine *one = &line[part->number[k]];
        CpsiChainProgram *chain = &program->chain[program->count];
        *chain = network->chain[part->number[k]];
        const Vec3 span =
            vec3_sub(start_of(line, part, k, CPS_END_B), start_of(line, part, k, CPS_END_A));
        fill_chain(chain, span, one->length, unit, compliance);
        memset(program->beyond[program->count], 0, sizeof program->beyond[0]);
        memcpy(program->joint[program->count++], part->at[k], sizeof program->joint[0]);
    }
    program->base.size = unknowns;
    memset(program->base.load, 0, (size_t)unknowns * sizeof(double));
    memset(program->base.u, 0, (size_t)unknowns * sizeof(double));
}

/* The force of a chain on what is at its end B is -p; p = -z. */
static Vec3 pull_of(const CpsiChainProgram *chain) { return vec3_load(&chain->segment.z[1][1]); }

/* How far a joint may be from where the program has put it: the lines reach no farther. */
static double reach(const CpsiNetworkPart *part, const CpsiLine *line, const CpsiNetwork *network,
                    double unit) {
    double lengths = 0, apart = 0;
    for (int k = 0; k < part->lines; k++) {
        if (!takes_part(line, part, k)) continue;
        const Vec3 span =
            vec3_sub(start_of(line, part, k, CPS_END_B), start_of(line, part, k, CPS_END_A));
        lengths += line[part->number[k]].length;
        apart += vec3_norm(span);
    }
    const CpsiProgram *base = &network->program.base;
    for (int i = 0; i < base->size; i++) apart += 2 * unit * fabs(base->u[i]);
    return lengths + apart;
}

/* [m] sum of p.(X_B - X_A) - |p| l with the largest |p| as unit, at the places of the program, less
 * what the imbalance may bring elsewhere and what is rounding; not positive: no proof. */
static double proven(CpsiNetwork *network, const CpsiLine *line, const CpsiNetworkPart *part,
                     double unit) {
    CpsiNetworkProgram *program = &network->program;
    double most = 0, sum = 0, sizes = 0, imbalance = 0, *left = program->base.residual;
    memset(left, 0, (size_t)program->base.size * sizeof *left);
    for (int k = 0, c = 0; k < part->lines; k++) {
        if (!takes_part(line, part, k)) continue;
        const Vec3 pull = pull_of(&program->chain[c++]);
        const double size = vec3_norm(pull);
        Vec3 span = vec3(0, 0, 0);
        for (int end = 0; end < 2; end++) {
            const int j = part->at[k][end];
            Vec3 x = start_of(line, part, k, end);
            sizes += size * vec3_norm(x);
            if (j != CPSI_NO_JOINT) {
                const int first = program->map[j].first;
                x = vec3_axpy(unit, vec3_load(&program->base.u[first]), x);
                for (int a = 0; a < 3; a++)
                    left[first + a] += (end == CPS_END_A ? -1 : 1) * (&pull.x)[a];
            }
            span = end == CPS_END_A ? vec3_scale(-1, x) : vec3_add(span, x);
        }
        most = fmax(most, size);
        sum -= vec3_dot(pull, span) + size * line[part->number[k]].length;
        sizes += size * line[part->number[k]].length;
    }
    for (int i = 0; i < program->base.size; i++) imbalance += fabs(left[i]);
    const double sure =
        sum - ROUNDING * sizes - BEYOND * imbalance * reach(part, line, network, unit);
    return most > 0 && sure > 0 ? sum / most : 0;
}

/* Write the forces, the largest 1. */
static void store(const CpsiNetwork *network, const CpsiLine *line, const CpsiNetworkPart *part,
                  const CpsiNetworkMove *out) {
    double most = 0;
    for (int c = 0; c < network->program.count; c++)
        most = fmax(most, vec3_norm(pull_of(&network->program.chain[c])));
    for (int k = 0, c = 0; k < part->lines; k++) {
        Vec3 pull = vec3(0, 0, 0);
        if (takes_part(line, part, k))
            pull = vec3_scale(1 / most, pull_of(&network->program.chain[c++]));
        vec3_store(&out->pull[6 * k + 3], pull);
        vec3_store(&out->pull[6 * k], vec3_scale(-1, pull));
    }
}

/* [-] The largest excess of a line that the program has found. */
static double largest_excess(const CpsiNetwork *network, double compliance) {
    double most = 0;
    for (int c = 0; c < network->program.count; c++)
        most = fmax(most, compliance * network->program.chain[c].segment.z[1][0]);
    return most;
}

bool cpsi_network_is_too_short(CpsiNetwork *network, const CpsiLine *line,
                               const CpsiNetworkPart *part, int *node, const CpsiNetworkMove *out,
                               double *missing) {
    const int unknowns = number_joints(network, line, part, node);
    if (unknowns == 0) return false;
    double unit = 0, compliance = FIRST;
    for (int k = 0; k < part->lines; k++) unit = fmax(unit, line[part->number[k]].length);
    for (int i = 0; i < TRIES; i++) {
        fill(network, line, part, unit, compliance, unknowns);
        const CpsiIpmOptions ipm = {.target = TARGET, .scale = 1, .max_iterations = ITERATIONS};
        (void)cpsi_ipm_solve(&network->program.base, &ipm);
        *missing = proven(network, line, part, unit);
        if (*missing > 0) {
            store(network, line, part, out);
            return true;
        }
        const double excess = largest_excess(network, compliance);
        if (!(excess > LEAST && excess < 0.1 * compliance)) return false;
        compliance = excess;
    }
    return false;
}
