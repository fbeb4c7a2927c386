/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps for ParaView: one .vtp per step (VTK XML PolyData 1.0, appended raw data, 64-bit headers,
 * the byte order of this machine), each line one polyline, and result.pvd that lists the steps.
 *
 * A block of appended data is its size in bytes as a 64-bit integer, then the data. The header
 * gives offsets into the appended part, so the sizes are summed first, then everything is written
 * in the same order. */
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "io/base/text/escape.h"
#include "io/results/writers.h"

/* In the order in which they are stored in the file. */
typedef enum Block {
    BLOCK_POINTS,
    BLOCK_CONNECTIVITY,
    BLOCK_OFFSETS,
    BLOCK_TENSION,
    BLOCK_CONTACT_FORCE,
    BLOCK_FRICTION_STATE,
    BLOCK_DISPLACEMENT,
    BLOCK_LINE_ID,
    BLOCK_RELEASE, /* where ends may be let go */
    BLOCKS
} Block;

typedef struct Blocks {
    int lines, blocks;
    uint64_t points;
    uint64_t bytes[BLOCKS];
    uint64_t offset[BLOCKS]; /* of the block's size, from the start of the appended data */
} Blocks;

/* The sizes fit 64 bits: a node takes more bytes in the evolution than in the file. */
static void measure(const CpsEvolution *evolution, bool lets_go, Blocks *out) {
    static const uint64_t PER_POINT[BLOCKS] = {24, 8, 0, 8, 24, 1, 24, 0, 0},
                          PER_LINE[BLOCKS] = {
                              [BLOCK_OFFSETS] = 8, [BLOCK_LINE_ID] = 4, [BLOCK_RELEASE] = 2};
    memset(out, 0, sizeof *out);
    out->lines = cps_evolution_line_count(evolution);
    out->blocks = lets_go ? BLOCKS : BLOCK_RELEASE;
    for (int i = 0; i < out->lines; ++i)
        out->points += (uint64_t)cps_evolution_line_view(evolution, i).element_count + 1;
    uint64_t end = 0;
    for (int b = 0; b < BLOCKS; ++b) {
        out->offset[b] = end;
        out->bytes[b] = out->points * PER_POINT[b] + (uint64_t)out->lines * PER_LINE[b];
        end += out->bytes[b] + sizeof(uint64_t);
    }
}

static void write_array(FILE *out, const Blocks *layout, Block block, const char *type,
                        const char *name, int components) {
    fprintf(out,
            "        <DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" "
            "format=\"appended\" offset=\"%llu\"/>\n",
            type, name, components, (unsigned long long)layout->offset[block]);
}

static void write_header(FILE *out, const Blocks *layout) {
    const uint16_t probe = 1;
    const bool little = *(const unsigned char *)&probe == 1;
    fprintf(out,
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"%s\" header_type=\"UInt64\">\n"
            "  <PolyData>\n"
            "    <Piece NumberOfPoints=\"%llu\" NumberOfVerts=\"0\" NumberOfLines=\"%d\" "
            "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"
            "      <Points>\n",
            little ? "LittleEndian" : "BigEndian", (unsigned long long)layout->points,
            layout->lines);
    write_array(out, layout, BLOCK_POINTS, "Float64", "Points", 3);
    fputs("      </Points>\n      <Lines>\n", out);
    write_array(out, layout, BLOCK_CONNECTIVITY, "Int64", "connectivity", 1);
    write_array(out, layout, BLOCK_OFFSETS, "Int64", "offsets", 1);
    fputs("      </Lines>\n      <PointData Scalars=\"tension_N\" Vectors=\"contact_force_N\">\n",
          out);
    write_array(out, layout, BLOCK_TENSION, "Float64", "tension_N", 1);
    write_array(out, layout, BLOCK_CONTACT_FORCE, "Float64", "contact_force_N", 3);
    write_array(out, layout, BLOCK_FRICTION_STATE, "UInt8", "friction_state", 1);
    write_array(out, layout, BLOCK_DISPLACEMENT, "Float64", "displacement_m", 3);
    fputs("      </PointData>\n      <CellData Scalars=\"line_id\">\n", out);
    write_array(out, layout, BLOCK_LINE_ID, "Int32", "line_id", 1);
    if (layout->blocks == BLOCKS) write_array(out, layout, BLOCK_RELEASE, "UInt8", "release", 2);
    fputs("      </CellData>\n    </Piece>\n  </PolyData>\n  <AppendedData encoding=\"raw\">\n_",
          out);
}

/* mean of the elements on both sides of a node */
static double node_tension(const CpsLineView *view, int j) {
    if (j == 0) return view->tension[0];
    if (j == view->element_count) return view->tension[j - 1];
    return 0.5 * (view->tension[j - 1] + view->tension[j]);
}

/* reactions and friction of all contacts of a node */
static void contact_force(const CpsLineView *view, int j, double force[3]) {
    const int nodes = view->element_count + 1;
    for (int i = 0; i < view->contact_count; ++i)
        for (size_t c = (size_t)j + (size_t)i * (size_t)nodes, k = 0; k < 3; ++k)
            force[k] +=
                view->reaction[c] * view->normal[3 * c + k] + view->friction_force[3 * c + k];
}

static void write_node(FILE *out, const CpsLineView *view, Block block, int j) {
    double value[3] = {0};
    size_t count = 1;
    for (size_t k = 0; k < 3; ++k) {
        const size_t i = 3 * (size_t)j + k;
        if (block == BLOCK_POINTS) {
            value[k] = view->position[i];
            count = 3;
        }
        if (block == BLOCK_DISPLACEMENT) {
            value[k] = view->position[i] - view->reference[i];
            count = 3;
        }
    }
    if (block == BLOCK_TENSION) value[0] = node_tension(view, j);
    if (block == BLOCK_CONTACT_FORCE) {
        contact_force(view, j, value);
        count = 3;
    }
    fwrite(value, sizeof value[0], count, out);
}

static void write_block(FILE *out, const CpsEvolution *evolution, const Blocks *layout,
                        Block block) {
    fwrite(&layout->bytes[block], sizeof(uint64_t), 1, out);
    int64_t node = 0;
    for (int32_t i = 0; i < layout->lines; ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        switch (block) {
        case BLOCK_CONNECTIVITY:
            for (int64_t j = 0; j <= view.element_count; ++j)
                fwrite(&(int64_t){node + j}, sizeof(int64_t), 1, out);
            break;
        case BLOCK_OFFSETS:
            fwrite(&(int64_t){node + view.element_count + 1}, sizeof(int64_t), 1, out);
            break;
        case BLOCK_FRICTION_STATE:
            for (int j = 0; j <= view.element_count; ++j) fputc(cpsi_node_state(&view, j), out);
            break;
        case BLOCK_LINE_ID: fwrite(&i, sizeof i, 1, out); break;
        case BLOCK_RELEASE:
            for (int end = 0; end < 2; ++end)
                fputc((int)cps_evolution_line_failure(evolution, i).release[end], out);
            break;
        default:
            for (int j = 0; j <= view.element_count; ++j) write_node(out, &view, block, j);
        }
        node += (int64_t)view.element_count + 1;
    }
}

CpsStatus cpsi_paraview_step(CpsResults *results, const CpsEvolution *evolution, CpsError *err) {
    Blocks layout;
    measure(evolution, results->lets_go, &layout);
    char name[64];
    FILE *out = NULL;
    snprintf(name, sizeof name, "step-%05d.vtp", results->row_count - 1);
    const CpsStatus status = cpsi_directory_create(results->directory, name, &out, err);
    if (status) return status;
    write_header(out, &layout);
    for (int b = 0; b < layout.blocks; ++b) write_block(out, evolution, &layout, (Block)b);
    fputs("\n  </AppendedData>\n</VTKFile>\n", out);
    return cpsi_directory_close_file(results->directory, out, err);
}

CpsStatus cpsi_paraview_list(CpsResults *results, CpsError *err) {
    FILE *out = NULL;
    const CpsStatus status = cpsi_directory_create(results->directory, "result.pvd", &out, err);
    if (status) return status;
    fputs(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n  <Collection>\n",
        out);
    char surfaces[32];
    cpsi_paraview_obstacles_name(-1, surfaces);
    for (int i = 0; i < results->row_count; ++i) {
        if (cpsi_paraview_obstacles_move(results, i)) cpsi_paraview_obstacles_name(i, surfaces);
        fprintf(out, "    <DataSet timestep=\"%d\" part=\"0\" file=\"step-%05d.vtp\" name=\"", i,
                i);
        cpsi_write_xml(out, results->row[i].name);
        fputs("\"/>\n", out);
        if (results->obstacle_count > 0)
            fprintf(out,
                    "    <DataSet timestep=\"%d\" part=\"1\" file=\"%s\" name=\"obstacles\"/>\n", i,
                    surfaces);
        if (results->point_count > 0)
            fprintf(out,
                    "    <DataSet timestep=\"%d\" part=\"2\" file=\"step-%05d-points.vtp\" "
                    "name=\"points\"/>\n",
                    i, i);
        if (results->draws_sets)
            fprintf(out,
                    "    <DataSet timestep=\"%d\" part=\"3\" file=\"sets.vtp\" name=\"sets\"/>\n",
                    i);
    }
    fputs("  </Collection>\n</VTKFile>\n", out);
    return cpsi_directory_close_file(results->directory, out, err);
}
