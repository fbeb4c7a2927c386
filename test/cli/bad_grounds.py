#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bad files of ground: each must be refused with its exit code, its place and its message, and good files of each form give one ground.

usage: bad_grounds.py CAPSTAN

Every case is one change to a good file of a form, or its whole contents; of a netCDF file a change of bytes. Expected is the exit code and what
follows the file name in the message; standard error must be one line, and standard output empty.
"""
import os
import struct
import subprocess
import sys
import tempfile

from checks import is_told

INPUT, IO, LIMIT = 3, 4, 6
SCENE = """\
capstan: 1
obstacles: {bed: {ground: {%s}, friction: 0.5}}
lines:
  cable: {length: 2, elements: 4, mass: 1, stiffness: 1e6, start: {straight: {from: [11, 21, 40], to: [13, 21, 40]}}, ends: {A: held, B: held}}
history: []
"""
# x 10 12 14, y 20 22: heights 1 2 3 in the south and 4 5 6 in the north
ESRI = "ncols 3\nnrows 2\nxllcorner 9\nyllcorner 19\ncellsize 2\nNODATA_value -99\n4 5 6\n1 2 3\n"
XYZ = "# x y z\n10 20 1\n12,20,2\n14\t20\t3\n10 22 4\n12; 22; 5\n14 22 6\n"
C = "3 2\n10 12 14\n20 22\n10 20 1\n10 22 4\n12 20 2\n12 22 5\n14 20 3\n14 22 6\n"
F = "--- MoorDyn Bathymetry Input File ---\nnGridX 3\nnGridY 2\n10 12 14\n20 -1 -2 -3\n22 -4 -5 -6\n"
GOOD = {"esri": ESRI, "xyz": XYZ, "moordyn_c": C, "moordyn_f": F}
SAYS = "bed: ground of 3 x 2 points, x 10 to 14 m, y 20 to 22 m, z 1 to 6 m, friction 0.5"


def padded(data):
    return data + b"\0" * (-len(data) % 4)


def word(n):
    return struct.pack(">I", n)


def text(name):
    return word(len(name)) + padded(name.encode())


def netcdf(version=1, dims=(("y", 2), ("x", 3)), variables=None, units="m", magic=None, kind=6, extra=b""):
    """A classic file, by the specification of the format."""
    pack = {5: "f", 6: "d", 3: "h", 4: "i"}[kind]
    variables = variables or [("x", (1,), (10, 12, 14)), ("y", (0,), (20, 22)), ("z", (0, 1), (1, 2, 3, 4, 5, 6))]

    def header(begin):
        out = (magic or b"CDF" + bytes([version])) + word(0)
        out += word(10) + word(len(dims)) + b"".join(text(n) + word(k) for n, k in dims) + word(0) * 2
        out += word(11) + word(len(variables))
        for (name, shape, values), at in zip(variables, begin):
            attributes = word(12) + word(1) + text("units") + word(2) + word(len(units)) + padded(units.encode()) if name != "z" else \
                (extra or word(0) * 2)
            out += text(name) + word(len(shape)) + b"".join(word(d) for d in shape) + attributes + word(kind)
            out += word(len(padded(b"0" * struct.calcsize(pack) * len(values)))) + (word(0) if version == 2 else b"") + word(at)
        return out

    begin = [0] * len(variables)
    size = len(header(begin))
    data = []
    for k, (_, _, values) in enumerate(variables):
        begin[k] = size + sum(map(len, data))
        data.append(padded(b"".join(struct.pack(">" + pack, v) for v in values)))
    return header(begin) + b"".join(data)


def attribute(name, value):
    return word(12) + word(1) + text(name) + word(6) + word(1) + struct.pack(">d", value)


def says(name, words):
    return word(12) + word(1) + text(name) + word(2) + word(len(words)) + padded(words.encode())


# name, form, what is replaced, by what, exit code, expected after "FILE"
CHANGES = [
    # ESRI ASCII grid
    ("empty", "esri", ESRI, "", INPUT, ":1:1: the header is not whole: ncols, nrows,"),
    ("no ncols", "esri", "ncols 3\n", "", INPUT, ":5:14: the header is not whole"),
    ("no nrows", "esri", "nrows 2\n", "", INPUT, ":5:14: the header is not whole"),
    ("no corner", "esri", "xllcorner 9\n", "", INPUT, ":5:14: the header is not whole"),
    ("no cellsize", "esri", "cellsize 2\n", "", INPUT, ":5:14: the header is not whole"),
    ("a key twice", "esri", "nrows 2", "ncols 2", INPUT, ":2:1: this is given twice"),
    ("corner and centre", "esri", "xllcorner 9", "xllcorner 9\nxllcenter 9", INPUT, ":4:1: this is given twice"),
    ("an unknown key", "esri", "cellsize", "cell", INPUT, ":5:1: found 'cell', expected one of ncols"),
    ("a word for a count", "esri", "ncols 3", "ncols three", INPUT, ":1:7: found 'three', expected ncols: a number"),
    ("a fraction of a column", "esri", "ncols 3", "ncols 2.5", INPUT, ":1:7: found 2.5, expected ncols: a whole number from 2 to 20000"),
    ("one column", "esri", "ncols 3", "ncols 1", INPUT, ":1:7: found 1, expected ncols"),
    ("a negative count", "esri", "nrows 2", "nrows -2", INPUT, ":2:7: found -2, expected nrows"),
    ("too many columns", "esri", "ncols 3", "ncols 20001", INPUT, ":1:7: found 20001, expected ncols"),
    ("a huge count", "esri", "ncols 3", "ncols 1e300", INPUT, ":1:7: found '1e300', expected ncols"),
    ("huge counts", "esri", "ncols 3\nnrows 2", "ncols 20000\nnrows 20000", LIMIT, ":6:14: 20000 times 20000 points, the limit is 100000000"),
    ("more than there is", "esri", "ncols 3\nnrows 2", "ncols 3000\nnrows 3000", INPUT, ":6:14: the file is too short for 3000 times 3000 points"),
    ("cells of no size", "esri", "cellsize 2", "cellsize 0", INPUT, ":6:14: the cellsize is 0, expected more than 0"),
    ("cells of negative size", "esri", "cellsize 2", "cellsize -2", INPUT, ":6:14: the cellsize is -2"),
    ("cells too small to tell apart", "esri", "cellsize 2", "cellsize 1e-30", INPUT, "SCENE:2:19: ground: x[1] is 9 m after 9 m, expected increasing"),
    ("a corner that is no number", "esri", "xllcorner 9", "xllcorner west", INPUT, ":3:11: found 'west', expected a number of the header"),
    ("a corner too far", "esri", "xllcorner 9", "xllcorner 1e101", INPUT, ":3:11: found '1e101'"),
    ("a height missing", "esri", "1 2 3\n", "1 2\n", INPUT, ":9:1: found the end of the file, expected a height"),
    ("a height too many", "esri", "1 2 3\n", "1 2 3 7\n", INPUT, ":8:7: found '7' after the last height"),
    ("a word", "esri", "4 5 6", "4 five 6", INPUT, ":7:3: found 'five', expected a height"),
    ("nan", "esri", "4 5 6", "4 nan 6", INPUT, ":7:3: found 'nan', expected a height"),
    ("infinity", "esri", "4 5 6", "4 inf 6", INPUT, ":7:3: found 'inf', expected a height"),
    ("a hexadecimal number", "esri", "4 5 6", "4 0x5 6", INPUT, ":7:3: found '0x5', expected a height"),
    ("too large a height", "esri", "4 5 6", "4 1e200 6", INPUT, ":7:3: found '1e200', expected a height"),
    ("no data", "esri", "4 5 6", "4 -99 6", INPUT, ":7:3: found -99 at (12, 22) m, the value for no data"),
    ("no data by default", "esri", "NODATA_value -99\n4 5 6", "4 -9999 6", INPUT, ":6:3: found -9999 at (12, 22) m, the value for no data"),
    ("a zero byte", "esri", "4 5 6", "4 \0 6", INPUT, ": found a zero byte: is this text?"),
    ("two points in a number", "esri", "4 5 6", "4 5.5.5 6", INPUT, ":7:3: found '5.5.5'"),
    ("a long word", "esri", "4 5 6", "4 " + "5" * 200 + " 6", INPUT, ":7:3: found '" + "5" * 60 + "', expected a height"),
    ("another form", "esri", ESRI, XYZ, INPUT, ":1:1: the header is not whole"),
    ("a binary file", "esri", ESRI, "\x7fELF\x02\x01", INPUT, ":1:1: found '"),
    ("only a header", "esri", "4 5 6\n1 2 3\n", "", INPUT, ":7:1: found the end of the file, expected a height"),
    ("a key without a value", "esri", "nrows 2\n", "nrows\n", INPUT, ":3:1: found 'xllcorner', expected nrows"),
    ("a comment in place of a value", "esri", "nrows 2\n", "nrows # 2\n", INPUT, ":3:1: found 'xllcorner', expected nrows"),
    ("a decimal comma", "esri", "cellsize 2", "cellsize 2,5", INPUT, ":6:1: found 'NODATA_value', expected a height"),
    ("degrees", "esri", "", "GEOGCS", INPUT, ": its coordinates are degrees, as the file .prj beside it says"),
    # points
    ("empty", "xyz", XYZ, "", INPUT, ":1:1: found 0 points, expected rows x y z"),
    ("only a comment", "xyz", XYZ, "# x y z\n", INPUT, ":1:1: found 0 points"),
    ("three points", "xyz", XYZ, "0 0 1\n1 0 1\n0 1 1\n", INPUT, ":3:5: found 3 points"),
    ("a line of names", "xyz", "# x y z", "x y z", INPUT, ":1:1: found 'x', expected x of a point"),
    ("two columns", "xyz", "10 20 1\n", "10 20\n", INPUT, ":3:1: found the end of line 2, expected x, y and z in one line"),
    ("one column", "xyz", "10 20 1\n", "10\n", INPUT, ":3:1: found the end of line 2"),
    ("four columns", "xyz", "10 20 1\n", "10 20 1 1\n", INPUT, ":3:1: found the end of line 2"),
    ("a word", "xyz", "12,20,2", "12,20,two", INPUT, ":3:7: found 'two', expected z of a point"),
    ("nan", "xyz", "12,20,2", "12,20,nan", INPUT, ":3:7: found 'nan'"),
    ("nothing between commas", "xyz", "12,20,2", "12,,2", INPUT, ":4:1: found the end of line 3"),
    ("a point twice", "xyz", "12,20,2", "10,20,2", INPUT, ":3:1: the point (10, 20) is given twice"),
    ("a point missing", "xyz", "12,20,2\n", "", INPUT, ":6:7: the points are no grid of 3 x 2: there is none at (12, 20)"),
    ("a point beside the grid", "xyz", "12,20,2", "12.1,20,2", INPUT, ":7:7: the points are no grid of 4 x 2: there is none at (12, 20)"),
    ("points on a line", "xyz", XYZ, "0 0 1\n1 0 1\n2 0 1\n3 0 1\n", INPUT, ":4:5: 4 points with 4 different x and 1 different y are no grid"),
    ("one place", "xyz", XYZ, "1 1 1\n" * 5, INPUT, ":5:5: 5 points with 1 different x and 1 different y are no grid"),
    ("scattered points", "xyz", XYZ, "".join(f"{k} {k * k} 1\n" for k in range(9)), INPUT, ":9:6: 9 points with 9 different x and 9 different y"),
    ("too far", "xyz", "14 22 6", "1e101 22 6", INPUT, ":7:1: found '1e101', expected x of a point"),
    ("a zero byte", "xyz", "14 22 6", "14 22 6\0", INPUT, ": found a zero byte"),
    ("the end within a point", "xyz", "14 22 6\n", "14 22", INPUT, ":7:6: found the end of the file, expected z of a point"),
    ("another form", "xyz", XYZ, ESRI, INPUT, ":1:1: found 'ncols', expected x of a point"),
    ("a word for x", "xyz", "12,20,2", "west,20,2", INPUT, ":3:1: found 'west', expected x of a point"),
    ("a word for y", "xyz", "12,20,2", "12,north,2", INPUT, ":3:4: found 'north', expected y of a point"),
    ("infinity", "xyz", "12,20,2", "12,20,inf", INPUT, ":3:7: found 'inf', expected z of a point"),
    ("nan for x", "xyz", "12,20,2", "nan,20,2", INPUT, ":3:1: found 'nan', expected x of a point"),
    ("a hexadecimal number", "xyz", "12,20,2", "12,0x14,2", INPUT, ":3:4: found '0x14', expected y of a point"),
    ("too large a height", "xyz", "12,20,2", "12,20,1e200", INPUT, ":3:7: found '1e200', expected z of a point"),
    ("two points in a number", "xyz", "12,20,2", "12,20,2.2.2", INPUT, ":3:7: found '2.2.2', expected z of a point"),
    ("a long word", "xyz", "12,20,2", "12,20," + "5" * 200, INPUT, ":3:7: found '" + "5" * 60 + "', expected z of a point"),
    ("a unit behind a number", "xyz", "12,20,2", "12,20,2m", INPUT, ":3:7: found '2m', expected z of a point"),
    ("a decimal comma", "xyz", "12,20,2", "12,5,20,2", INPUT, ":4:1: found the end of line 3, expected x, y and z in one line"),
    ("only separators", "xyz", "12,20,2", ",;,", INPUT, ":7:7: the points are no grid of 3 x 2: there is none at (12, 20)"),
    ("a comment in a row", "xyz", "12,20,2", "12 20 # 2", INPUT, ":4:1: found the end of line 3, expected x, y and z in one line"),
    ("a first row of one number", "xyz", "# x y z", "6", INPUT, ":2:1: found the end of line 1, expected x, y and z in one line"),
    ("a point at its end once more", "xyz", "14 22 6\n", "14 22 6\n14 22 6\n", INPUT, ":8:1: the point (14, 22) is given twice"),
    ("the same place with another height", "xyz", "14 22 6\n", "14 22 6\n10 20 9\n", INPUT, ":8:1: the point (10, 20) is given twice"),
    ("a row more than the grid", "xyz", "14 22 6\n", "14 22 6\n10 24 7\n", INPUT, ":8:7: the points are no grid of 3 x 3: there is none at (12, 24)"),
    ("a column more than the grid", "xyz", "14 22 6\n", "14 22 6\n16 20 7\n", INPUT, ":8:7: the points are no grid of 4 x 2: there is none at (16, 22)"),
    ("too far below", "xyz", "14 22 6", "14 -1e101 6", INPUT, ":7:4: found '-1e101', expected y of a point"),
    ("a quoted number", "xyz", "14 22 6", '"14" 22 6', INPUT, ":7:1: found '\"14\"', expected x of a point"),
    ("a date", "xyz", "14 22 6", "14 22 2024-01-01", INPUT, ":7:7: found '2024-01-01', expected z of a point"),
    ("a binary file", "xyz", XYZ, "\x7fELF\x02\x01\x01", INPUT, ":1:1: found '?ELF???', expected x of a point"),
    ("MoorDyn's form", "xyz", XYZ, C, INPUT, ":2:1: found the end of line 1, expected x, y and z in one line"),
    ("a plus and a minus", "xyz", "14 22 6", "14 22 +-6", INPUT, ":7:7: found '+-6', expected z of a point"),
    ("two columns all along", "xyz", XYZ, "10 20\n12 20\n10 22\n12 22\n", INPUT, ":2:1: found the end of line 1, expected x, y and z in one line"),
    # MoorDyn in C
    ("empty", "moordyn_c", C, "", INPUT, ":1:1: found the end of the file, expected the number of x"),
    ("only a title", "moordyn_c", C, "--- title ---", INPUT, ":1:14: found the end of the file, expected the number of x"),
    ("one x", "moordyn_c", "3 2\n", "1 2\n", INPUT, ":1:1: found 1, expected the number of x: a whole number from 2"),
    ("a word for a count", "moordyn_c", "3 2\n", "3 y\n", INPUT, ":1:3: found 'y', expected the number of y"),
    ("huge counts", "moordyn_c", "3 2\n", "20000 20000\n", LIMIT, ":1:7: 20000 times 20000 points"),
    ("more than there is", "moordyn_c", "3 2\n", "300 200\n", INPUT, ":1:5: the file is too short for 300 times 200 points"),
    ("x that fall", "moordyn_c", "10 12 14\n", "10 14 12\n", INPUT, ":2:7: found 12 after 14, expected x that increase"),
    ("x twice", "moordyn_c", "10 12 14\n", "10 12 12\n", INPUT, ":2:7: found 12 after 12, expected x that increase"),
    ("y that fall", "moordyn_c", "20 22\n", "22 20\n", INPUT, ":3:4: found 20 after 22, expected y that increase"),
    ("a point missing", "moordyn_c", "14 22 6\n", "", INPUT, ":9:1: found the end of the file, expected x of a point"),
    ("a point too many", "moordyn_c", "14 22 6\n", "14 22 6\n14 22 6\n", INPUT, ":10:1: found '14' after the last point"),
    ("a point twice", "moordyn_c", "14 22 6\n", "10 20 6\n", INPUT, ":9:1: the point (10, 20) is given twice"),
    ("a point of another grid", "moordyn_c", "14 22 6\n", "15 22 6\n", INPUT, ":9:1: the point (15, 22) is none of the grid's"),
    ("two numbers in a row", "moordyn_c", "12 20 2\n", "12 20\n", INPUT, ":7:1: found the end of line 6"),
    ("nan", "moordyn_c", "12 20 2\n", "12 20 NaN\n", INPUT, ":6:7: found 'NaN', expected z of a point"),
    ("the other form", "moordyn_c", C, F, INPUT, ":2:1: found 'nGridX', expected the number of x"),
    ("one y", "moordyn_c", "3 2\n", "3 1\n", INPUT, ":1:3: found 1, expected the number of y: a whole number from 2 to 20000"),
    ("a negative count", "moordyn_c", "3 2\n", "-3 2\n", INPUT, ":1:1: found -3, expected the number of x: a whole number from 2 to 20000"),
    ("a fraction", "moordyn_c", "3 2\n", "3 2.5\n", INPUT, ":1:3: found 2.5, expected the number of y: a whole number from 2 to 20000"),
    ("a huge count", "moordyn_c", "3 2\n", "3 1e300\n", INPUT, ":1:3: found '1e300', expected the number of y"),
    ("nan for a count", "moordyn_c", "3 2\n", "nan 2\n", INPUT, ":1:1: found 'nan', expected the number of x"),
    ("too many x", "moordyn_c", "3 2\n", "20001 2\n", INPUT, ":1:1: found 20001, expected the number of x: a whole number from 2 to 20000"),
    ("no counts", "moordyn_c", "3 2\n", "", INPUT, ":1:4: the file is too short for 10 times 12 points"),
    ("one count", "moordyn_c", "3 2\n", "3\n", INPUT, ":2:1: the file is too short for 3 times 10 points"),
    ("an x missing", "moordyn_c", "10 12 14\n", "10 12\n", INPUT, ":4:1: found 10 after 22, expected y that increase"),
    ("an x too many", "moordyn_c", "10 12 14\n", "10 12 14 16\n", INPUT, ":4:1: found the end of line 3, expected x, y and z in one line"),
    ("a word for x", "moordyn_c", "10 12 14\n", "10 twelve 14\n", INPUT, ":2:4: found 'twelve', expected x"),
    ("infinite x", "moordyn_c", "10 12 14\n", "10 12 inf\n", INPUT, ":2:7: found 'inf', expected x"),
    ("x too far", "moordyn_c", "10 12 14\n", "10 12 1e101\n", INPUT, ":2:7: found '1e101', expected x"),
    ("a y missing", "moordyn_c", "20 22\n", "20\n", INPUT, ":4:1: found 10 after 20, expected y that increase"),
    ("a word for y", "moordyn_c", "20 22\n", "20 north\n", INPUT, ":3:4: found 'north', expected y"),
    ("y twice", "moordyn_c", "20 22\n", "20 20\n", INPUT, ":3:4: found 20 after 20, expected y that increase"),
    ("nan for y", "moordyn_c", "20 22\n", "20 nan\n", INPUT, ":3:4: found 'nan', expected y"),
    ("infinite height", "moordyn_c", "12 20 2\n", "12 20 -inf\n", INPUT, ":6:7: found '-inf', expected z of a point"),
    ("a hexadecimal height", "moordyn_c", "12 20 2\n", "12 20 0x2\n", INPUT, ":6:7: found '0x2', expected z of a point"),
    ("too large a height", "moordyn_c", "12 20 2\n", "12 20 1e200\n", INPUT, ":6:7: found '1e200', expected z of a point"),
    ("a word for x of a point", "moordyn_c", "12 20 2\n", "west 20 2\n", INPUT, ":6:1: found 'west', expected x of a point"),
    ("four numbers in a row", "moordyn_c", "12 20 2\n", "12 20 2 2\n", INPUT, ":7:1: found the end of line 6, expected x, y and z in one line"),
    ("points beside the grid by rounding", "moordyn_c", "12 20 2\n", "12.001 20 2\n", INPUT, ":6:1: the point (12.001, 20) is none of the grid's"),
    ("a zero byte", "moordyn_c", "12 20 2\n", "12 20 2\0\n", INPUT, ": found a zero byte: is this text?"),
    ("no points", "moordyn_c", "10 20 1\n10 22 4\n12 20 2\n12 22 5\n14 20 3\n14 22 6\n", "", INPUT, ":1:3: the file is too short for 3 times 2 points"),
    ("the end within a point", "moordyn_c", "14 22 6\n", "14 22", INPUT, ":9:6: found the end of the file, expected z of a point"),
    ("a binary file", "moordyn_c", C, "\x7fELF\x02\x01\x01", INPUT, ":1:1: found '?ELF???', expected the number of x"),
    ("ESRI", "moordyn_c", C, ESRI, INPUT, ":1:1: found 'ncols', expected the number of x"),
    ("points", "moordyn_c", C, XYZ, INPUT, ":2:4: the file is too short for 10 times 20 points"),
    ("a long word", "moordyn_c", "12 20 2\n", "12 20 " + "5" * 200 + "\n", INPUT, ":6:7: found '" + "5" * 60 + "', expected z of a point"),
    # MoorDyn in Fortran
    ("empty", "moordyn_f", F, "", INPUT, ":1:1: found '', expected nGridX and a number"),
    ("no nGridY", "moordyn_f", "nGridY 2\n", "", INPUT, ":3:1: found '10', expected nGridY and a number"),
    ("a fraction", "moordyn_f", "nGridX 3", "nGridX 3.5", INPUT, ":2:8: found 3.5, expected nGridX"),
    ("huge counts", "moordyn_f", "nGridX 3\nnGridY 2", "nGridX 20000\nnGridY 20000", LIMIT, ":3:8: 20000 times 20000 points"),
    ("more than there is", "moordyn_f", "nGridX 3", "nGridX 300", INPUT, ":3:8: the file is too short for 300 times 2 points"),
    ("x that fall", "moordyn_f", "10 12 14\n", "10 9 14\n", INPUT, ":4:4: found 9 after 10, expected x that increase"),
    ("y that fall", "moordyn_f", "22 -4", "19 -4", INPUT, ":6:1: found 19 after 20, expected y that increase"),
    ("a depth missing", "moordyn_f", "-5 -6\n", "-5\n", INPUT, ":7:1: found the end of the file, expected a depth"),
    ("a depth too many", "moordyn_f", "-5 -6\n", "-5 -6 -7\n", INPUT, ":6:13: found '-7' after the last depth"),
    ("a word", "moordyn_f", "-5 -6\n", "-5 deep\n", INPUT, ":6:10: found 'deep', expected a depth"),
    ("the other form", "moordyn_f", F, C, INPUT, ":1:1: found '3', expected nGridX and a number"),
    ("no nGridX", "moordyn_f", "nGridX 3\n", "", INPUT, ":2:1: found 'nGridY', expected nGridX and a number"),
    ("one x", "moordyn_f", "nGridX 3", "nGridX 1", INPUT, ":2:8: found 1, expected nGridX: a whole number from 2 to 20000"),
    ("a negative count", "moordyn_f", "nGridY 2", "nGridY -2", INPUT, ":3:8: found -2, expected nGridY: a whole number from 2 to 20000"),
    ("a word for a count", "moordyn_f", "nGridX 3", "nGridX three", INPUT, ":2:8: found 'three', expected nGridX"),
    ("a huge count", "moordyn_f", "nGridX 3", "nGridX 1e300", INPUT, ":2:8: found '1e300', expected nGridX"),
    ("nan for a count", "moordyn_f", "nGridY 2", "nGridY nan", INPUT, ":3:8: found 'nan', expected nGridY"),
    ("too many x", "moordyn_f", "nGridX 3", "nGridX 20001", INPUT, ":2:8: found 20001, expected nGridX: a whole number from 2 to 20000"),
    ("a count without a value", "moordyn_f", "nGridX 3\n", "nGridX\n", INPUT, ":3:1: found 'nGridY', expected nGridX"),
    ("a key twice", "moordyn_f", "nGridY 2", "nGridX 2", INPUT, ":3:1: found 'nGridX', expected nGridY and a number"),
    ("only a title", "moordyn_f", F, "--- MoorDyn Bathymetry Input File ---\n", INPUT, ":2:1: found '', expected nGridX and a number"),
    ("an x missing", "moordyn_f", "10 12 14\n", "10 12\n", INPUT, ":6:4: found -4 after -1, expected y that increase"),
    ("an x too many", "moordyn_f", "10 12 14\n", "10 12 14 16\n", INPUT, ":5:10: found -3 after 16, expected y that increase"),
    ("x twice", "moordyn_f", "10 12 14\n", "10 12 12\n", INPUT, ":4:7: found 12 after 12, expected x that increase"),
    ("a word for x", "moordyn_f", "10 12 14\n", "10 twelve 14\n", INPUT, ":4:4: found 'twelve', expected x"),
    ("nan for x", "moordyn_f", "10 12 14\n", "10 nan 14\n", INPUT, ":4:4: found 'nan', expected x"),
    ("x too far", "moordyn_f", "10 12 14\n", "10 12 1e101\n", INPUT, ":4:7: found '1e101', expected x"),
    ("y twice", "moordyn_f", "22 -4", "20 -4", INPUT, ":6:1: found 20 after 20, expected y that increase"),
    ("a word for y", "moordyn_f", "22 -4", "north -4", INPUT, ":6:1: found 'north', expected y"),
    ("infinite y", "moordyn_f", "22 -4", "inf -4", INPUT, ":6:1: found 'inf', expected y"),
    ("y too far", "moordyn_f", "22 -4", "1e101 -4", INPUT, ":6:1: found '1e101', expected y"),
    ("nan", "moordyn_f", "-5 -6\n", "-5 nan\n", INPUT, ":6:10: found 'nan', expected a depth"),
    ("infinity", "moordyn_f", "-5 -6\n", "-5 -inf\n", INPUT, ":6:10: found '-inf', expected a depth"),
    ("a hexadecimal depth", "moordyn_f", "-5 -6\n", "-5 0x6\n", INPUT, ":6:10: found '0x6', expected a depth"),
    ("too large a depth", "moordyn_f", "-5 -6\n", "-5 1e200\n", INPUT, ":6:10: found '1e200', expected a depth"),
    ("a zero byte", "moordyn_f", "-5 -6\n", "-5 -6\0\n", INPUT, ": found a zero byte: is this text?"),
    ("a row missing", "moordyn_f", "22 -4 -5 -6\n", "", INPUT, ":6:1: found the end of the file, expected y"),
    ("a row too many", "moordyn_f", "22 -4 -5 -6\n", "22 -4 -5 -6\n24 -7 -8 -9\n", INPUT, ":7:1: found '24' after the last depth, expected the end of the file"),
    ("no depths", "moordyn_f", "20 -1 -2 -3\n22 -4 -5 -6\n", "", INPUT, ":5:1: found the end of the file, expected y"),
    ("a depth missing in the first row", "moordyn_f", "20 -1 -2 -3", "20 -1 -2", INPUT, ":6:4: found -4 after 20, expected y that increase"),
    ("a long word", "moordyn_f", "-5 -6\n", "-5 " + "6" * 200 + "\n", INPUT, ":6:10: found '" + "6" * 60 + "', expected a depth"),
    ("a binary file", "moordyn_f", F, "\x7fELF\x02\x01\x01", INPUT, ":1:1: found '?ELF???', expected nGridX and a number"),
    ("ESRI", "moordyn_f", F, ESRI, INPUT, ":1:1: found 'ncols', expected nGridX and a number"),
    ("points", "moordyn_f", F, XYZ, INPUT, ":2:1: found '10', expected nGridX and a number"),
]

WHOLE = netcdf()
# name, bytes, expected after "FILE"
BINARY = [
    ("empty", b"", ": this is no classic netCDF file"),
    ("text", ESRI.encode(), ": this is no classic netCDF file"),
    ("netCDF-4", b"\x89HDF\r\n\x1a\n" + b"\0" * 100, ": this is no classic netCDF file (CDF-1 or CDF-2): convert it"),
    ("64-bit data", netcdf(magic=b"CDF\x05"), ": this is no classic netCDF file"),
    ("only the magic", b"CDF\x01", ": its header is not whole"),
    *[(f"cut after {n} bytes", WHOLE[:n], ": ") for n in range(5, len(WHOLE), 29)],
    ("no values", WHOLE[:-48], ": the file is too short for the grid that its header describes"),
    ("one byte less", WHOLE[:-1], ": the file is too short for the grid that its header describes"),
    ("an unknown version", netcdf(magic=b"CDF\x03"), ": this is no classic netCDF file"),
    ("another variable", netcdf(variables=[("x", (1,), (10, 12, 14)), ("y", (0,), (20, 22)), ("h", (0, 1), (1,) * 6)]), ": it has no variable 'z'"),
    ("one dimension", netcdf(variables=[("x", (1,), (10, 12, 14)), ("y", (0,), (20, 22)), ("z", (0,), (1, 2))]), ": it has no variable 'z' over two"),
    ("no coordinates", netcdf(variables=[("x", (1,), (10, 12, 14)), ("z", (0, 1), (1,) * 6)]), ": a dimension of the grid has no variable of its name"),
    ("coordinates over another dimension", netcdf(variables=[("x", (0,), (10, 12)), ("y", (0,), (20, 22)), ("z", (0, 1), (1,) * 6)]), ": a dimension of the grid has no"),
    ("x that go back and forth", netcdf(variables=[("x", (1,), (10, 14, 12)), ("y", (0,), (20, 22)), ("z", (0, 1), (1,) * 6)]), ": the coordinates of a dimension neither increase"),
    ("x twice", netcdf(variables=[("x", (1,), (10, 12, 12)), ("y", (0,), (20, 22)), ("z", (0, 1), (1,) * 6)]), ": the coordinates of a dimension neither increase"),
    ("degrees", netcdf(units="degrees_east"), ": its coordinates are degrees, expected metres"),
    ("kilometres", netcdf(units="km"), ": the units of its coordinates are not metres: convert it"),
    ("feet", netcdf(extra=says("units", "ft")), "SCENE:2:28: 'file': its units are not metres: convert it"),
    ("heights in degrees", netcdf(extra=says("units", "degrees")), "SCENE:2:28: 'file': its units are not metres: convert it"),
    ("depths", netcdf(extra=says("positive", "down")), "SCENE:2:28: 'file': its variable is positive downwards: it has depths"),
    ("x before y", netcdf(dims=(("x", 2), ("y", 3)), variables=[("x", (0,), (10, 12)), ("y", (1,), (20, 22, 24)), ("z", (0, 1), (1,) * 6)]),
     ": its variable has the dimensions x, y, expected y, x"),
    ("nan", netcdf(variables=[("x", (1,), (10, 12, 14)), ("y", (0,), (20, 22)), ("z", (0, 1), (1, 2, float("nan"), 4, 5, 6))]), ": height number 3 is"),
    ("infinite coordinate", netcdf(variables=[("x", (1,), (10, 12, float("inf"))), ("y", (0,), (20, 22)), ("z", (0, 1), (1,) * 6)]), ": coordinate number 3 is inf"),
    ("a missing value", netcdf(extra=attribute("_FillValue", 5)), ": height number 5 is 5, which is missing"),
    ("another missing value", netcdf(extra=attribute("missing_value", 1)), ": height number 1 is 1, which is missing"),
    ("a scale of nothing", netcdf(extra=attribute("scale_factor", float("nan"))), ": height number 1 is 1"),
    ("huge dimensions", netcdf(dims=(("y", 20000), ("x", 20000))), ": 20000 times 20000 points, the limit is"),
    ("dimensions beyond the file", netcdf(dims=(("y", 3000), ("x", 3000))), ": the file is too short for 3000 times 3000 points"),
    ("more than may be", netcdf(dims=(("y", 2**32 - 1), ("x", 3))), ": 'z' has 3 x 4294967295 points, expected 2 to 20000"),
    ("one row", netcdf(dims=(("y", 1), ("x", 3))), ": 'z' has 3 x 1 points, expected 2 to 20000"),
    ("an unlimited dimension", netcdf(dims=(("y", 0), ("x", 3))), ": 'z' has 3 x 0 points"),
    ("a dimension that is not there", netcdf(variables=[("x", (1,), (10, 12, 14)), ("y", (0,), (20, 22)), ("z", (0, 7), (1,) * 6)]), ": its header is not whole"),
    ("a rank beyond the file", WHOLE.replace(text("z") + word(2), text("z") + word(2**31)), ": its header is not whole"),
    ("a name beyond the file", WHOLE.replace(word(10) + word(2) + word(1), word(10) + word(2) + word(2**31)), ": its header is not whole"),
    ("characters for heights", WHOLE.replace(word(0) * 2 + word(6), word(0) * 2 + word(2)), ": a variable of the grid is no number"),
    ("too many dimensions", netcdf(dims=[(f"d{k}", 2) for k in range(65)]), ": its header is not whole"),
]

# name, the mapping under ground, expected after the scene's name, exit code
SCENES = [
    ("no file", "form: esri", ":2:19: 'ground': 'file' is missing", INPUT),
    ("no form", "file: bed", ":2:19: 'ground': 'form' is missing", INPUT),
    ("an unknown form", "file: bed, form: tiff", ":2:39: 'form': found 'tiff', expected one of: esri xyz netcdf moordyn_c moordyn_f", INPUT),
    ("a file elsewhere", "file: ../bed, form: esri", ":2:28: 'file': found '../bed', expected the name of a file beside this one", INPUT),
    ("a file that is not there", "file: none, form: esri", "none: ", IO),
    ("a variable of text", "file: bed, form: esri, variable: z", ":2:51: 'variable': it does not go with this form", INPUT),
    ("other points", "file: bed, form: esri, friction_factor: small", ":2:51: 'friction_factor': found 2 x 2 points, expected the 3 x 2 points of 'file'", INPUT),
    ("a negative factor", "file: bed, form: esri, friction_factor: minus", ":2:19: ground: the factor of friction at (10, 20) m is -1, expected a finite number >= 0", INPUT),
    ("a line beyond the grid", "file: bed, form: esri, point: [100, 0, 0]", ":4:60: line 'cable': start: node 0 at (11, 21) m lies beyond the grid of ground 'bed'", INPUT),
    ("a line below the ground", "file: bed, form: esri, point: [0, 0, 100], extend: true", ":4:60: line 'cable': start: node 0 lies", INPUT),
    ("a plane as well", "file: bed, form: esri}, plane: {", ":2:13: obstacle 'bed': too much given", INPUT),
]


class Suite:
    def __init__(self, capstan, folder):
        self.capstan, self.folder, self.count, self.failed = capstan, folder, 0, 0

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, data):
        with open(self.path(name), "wb") as file:
            file.write(data if isinstance(data, bytes) else data.encode("latin-1"))

    def check(self, keys):
        self.write("scene.yaml", SCENE % keys)
        return subprocess.run([self.capstan, "check", self.path("scene.yaml")], stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=20, check=False)

    def refused(self, name, keys, code, wanted, file="bed"):
        self.count += 1
        wanted = wanted.replace("SCENE", "scene.yaml") if wanted.startswith("SCENE") else file + wanted
        found = self.check(keys)
        told = found.stderr.decode("latin-1")
        if found.returncode == code and not found.stdout and told.count("\n") <= 1 and told.startswith(f"capstan: {self.path(wanted)}"):
            return
        self.failed += 1
        print(f"{name}: exit {found.returncode}, expected {code}: {wanted}\n    {told}{found.stdout.decode()}")

    def accepted(self, name, keys):
        found = self.check(keys)
        if found.returncode == 0 and SAYS in found.stdout.decode():
            return
        self.failed += 1
        print(f"{name}: exit {found.returncode}: {found.stderr.decode()}{found.stdout.decode()}")


def check_good(suite):
    """All forms of one ground, with values in all types of netCDF, reversed axes, scales and depths."""
    for form, good in GOOD.items():
        suite.write("bed", good)
        suite.accepted(form, f"file: bed, form: {form}")
        suite.write("bed", good.replace("\n", "\r\n"))
        suite.accepted(f"{form}, other ends of lines", f"file: bed, form: {form}")
    suite.write("bed", ESRI.replace("corner 9", "center 10").replace("corner 19", "center 20").upper())
    suite.accepted("esri, centres in capitals", "file: bed, form: esri")
    suite.write("bed", "10 20 -1\n12 20 -2\n14 20 -3\n10 22 -4\n12 22 -5\n14 22 -6")
    suite.accepted("xyz, depths, no end of the last line", "file: bed, form: xyz, depths: true")
    for version in (1, 2):
        for kind in (3, 4, 5, 6):
            suite.write("bed", netcdf(version=version, kind=kind))
            suite.accepted(f"netcdf {version}, type {kind}", "file: bed, form: netcdf")
    suite.write("bed", netcdf(variables=[("x", (1,), (14, 12, 10)), ("y", (0,), (22, 20)), ("z", (0, 1), (6, 5, 4, 3, 2, 1))]))
    suite.accepted("netcdf, reversed", "file: bed, form: netcdf")
    suite.write("bed", netcdf(variables=[("x", (1,), (10, 12, 14)), ("y", (0,), (20, 22)), ("h", (0, 1), (1, 2, 3, 4, 5, 6))]))
    suite.accepted("netcdf, another name", "file: bed, form: netcdf, variable: h")
    suite.write("bed", netcdf(variables=[("x", (1,), (10, 12, 14)), ("y", (0,), (20, 22)), ("z", (0, 1), (2, 4, 6, 8, 10, 12))], extra=attribute("scale_factor", 0.5)))
    suite.accepted("netcdf, scaled", "file: bed, form: netcdf")


def main():
    with tempfile.TemporaryDirectory() as folder:
        suite = Suite(sys.argv[1], folder)
        check_good(suite)
        for name, form, old, new, code, wanted in CHANGES:
            good = GOOD[form]
            assert not old or good.count(old) == 1, name
            suite.write("bed", good.replace(old, new) if old else good)
            if name == "degrees":
                suite.write("bed.prj", 'GEOGCS["WGS 84"]')
            suite.refused(f"{form}: {name}", f"file: bed, form: {form}", code, wanted)
            if name == "degrees":
                os.remove(suite.path("bed.prj"))
        for name, data, wanted in BINARY:
            suite.write("bed", data)
            suite.refused(f"netcdf: {name}", "file: bed, form: netcdf", LIMIT if "the limit" in wanted else INPUT, wanted)
        suite.write("bed", ESRI)
        suite.write("small", "ncols 2\nnrows 2\nxllcorner 9\nyllcorner 19\ncellsize 2\n1 1\n1 1\n")
        suite.write("minus", ESRI.replace("1 2 3", "-1 2 3"))
        for name, keys, wanted, code in SCENES:
            suite.refused(name, keys, code, wanted, "" if wanted.startswith("none") else "scene.yaml")
        print(f"{suite.count} cases, {suite.failed} failed")
        return 0 if is_told(suite.count) and not suite.failed else 1


if __name__ == "__main__":
    sys.exit(main())
