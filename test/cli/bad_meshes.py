#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bad files of meshes: each must be refused with its exit code, its place and its message, and good files of each form give one mesh.

usage: bad_meshes.py CAPSTAN

Every case is one change to a good file of a form, or its whole contents. Expected is the exit code and what follows the file name in the
message; standard error must be one line, and standard output empty.
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
obstacles: {rock: {mesh: {%s}, friction: 0.5}}
lines:
  cable: {length: 2, elements: 4, mass: 1, stiffness: 1e6, start: {straight: {from: [0, 0, 40], to: [2, 0, 40]}}, ends: {A: held, B: held}}
history: []
"""
# a tetrahedron, seen from outside counter-clockwise
POINTS = [(0, 0, 0), (3, 0, 0), (0, 2, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
SAYS = "rock: mesh of 4 triangles, x 0 to 3 m, y 0 to 2 m, z 0 to 1 m, rounded by 0.1 m, closed, lines outside, friction 0.5"
OBJ = "# rock\no rock\n" + "".join("v %g %g %g\n" % p for p in POINTS) + "vn 0 0 1\nvt 0 0\nusemtl grey\ns off\n" + \
    "f 1 3 2\nf 1/1/1 2/1/1 4/1/1\nf 2//1 3//1 4//1\nf -2 -4 -1\n"


def stl_text(points=tuple(POINTS), faces=tuple(FACES)):
    out = "solid rock of granite\n"
    for face in faces:
        corners = "".join("      vertex %g %g %g\n" % points[k] for k in face)
        out += f"  facet normal 0 0 0\n    outer loop\n{corners}    endloop\n  endfacet\n"
    return out + "endsolid rock of granite\n"


def stl_binary(count=None, header=b"rock", points=tuple(POINTS), faces=tuple(FACES), end=b""):
    out = header.ljust(80, b"\0") + struct.pack("<I", len(faces) if count is None else count)
    for face in faces:
        out += struct.pack("<3f", 0, 0, 0) + b"".join(struct.pack("<3f", *points[k]) for k in face) + b"\0\0"
    return out + end


TEXT, BINARY = stl_text(), stl_binary()
NAN, INF = float("nan"), float("inf")


def moved(k, point):
    return tuple(point if i == k else p for i, p in enumerate(POINTS))


# name, form, contents, exit code, expected after "FILE"
FILES = [
    # STL as text
    ("empty", "stl", "", INPUT, ": mesh: 0 vertices, expected 3 to"),
    ("a word", "stl", "granite", INPUT, ":1:1: found 'granite', expected 'solid'"),
    ("only a name", "stl", "solid rock", INPUT, ":1:11: found the end of the file, expected 'endsolid'"),
    ("no facets", "stl", "solid rock\nendsolid rock\n", INPUT, ": mesh: 0 vertices, expected 3 to"),
    ("no end", "stl", TEXT.replace("endsolid rock of granite\n", ""), INPUT, ":30:1: found the end of the file, expected 'endsolid'"),
    ("cut in a facet", "stl", TEXT[:TEXT.index("endloop")], INPUT, ":7:5: found the end of the file, expected 'endloop'"),
    ("cut in a number", "stl", TEXT[:TEXT.index("vertex 0 2 0") + 10], INPUT, ":5:17: found the end of the file, expected a coordinate"),
    ("cut in a normal", "stl", "solid a\nfacet normal 0 0", INPUT, ":2:17: found the end of the file, expected a normal"),
    ("no normal", "stl", TEXT.replace("facet normal 0 0 0", "facet", 1), INPUT, ":3:5: found 'outer', expected 'normal'"),
    ("two numbers of a normal", "stl", TEXT.replace("normal 0 0 0", "normal 0 0", 1), INPUT, ":3:11: found 'loop', expected 'outer'"),
    ("no loop", "stl", TEXT.replace("    outer loop\n", "", 1), INPUT, ":3:7: found 'vertex', expected 'outer'"),
    ("two corners", "stl", TEXT.replace("      vertex 0 2 0\n", "", 1), INPUT, ":6:5: found 'endloop', expected 'vertex'"),
    ("four corners", "stl", TEXT.replace("vertex 0 2 0\n", "vertex 0 2 0\nvertex 0 2 1\n", 1), INPUT, ":7:7: found 'vertex', expected 'endloop'"),
    ("two coordinates", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 2", 1), INPUT, ":6:7: found 'vertex', expected a coordinate: a number"),
    ("a word for a coordinate", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 two 0", 1), INPUT, ":5:16: found 'two', expected a coordinate"),
    ("nan", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 nan 0", 1), INPUT, ":5:16: found 'nan', expected a coordinate"),
    ("infinite", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 inf 0", 1), INPUT, ":5:16: found 'inf', expected a coordinate"),
    ("beyond all places", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 1e101 0", 1), INPUT, ":5:16: found '1e101', expected a coordinate"),
    ("beyond all meshes", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 1e99 0"), INPUT, ": mesh: vertex 1 has the coordinate 1e+99 m, expected"),
    ("no end of a facet", "stl", TEXT.replace("  endfacet\n", "", 1), INPUT, ":8:3: found 'facet', expected 'endfacet'"),
    ("a facet outside", "stl", TEXT.replace("solid rock of granite\n", "", 1), INPUT, ":1:3: found 'facet', expected 'solid'"),
    ("words after the end", "stl", TEXT + "and so on\n", INPUT, ":31:1: found 'and', expected 'solid'"),
    ("another word", "stl", TEXT.replace("  facet", "  face", 1), INPUT, ":2:3: found 'face', expected 'facet' or 'endsolid'"),
    ("OBJ", "stl", OBJ, INPUT, ":2:1: found 'o', expected 'solid'"),
    ("a facet of one place", "stl", stl_text(faces=[(0, 0, 0)]), INPUT, ": mesh: each of its 1 triangles has two corners in one place"),
    ("corners on a line", "stl", stl_text(faces=FACES + [(0, 1, 4)], points=POINTS + [(2, 0, 0)]), INPUT, ": mesh: the corners of triangle 4 lie on one line"),
    ("a facet turned over", "stl", stl_text(faces=FACES[:3] + [(0, 2, 3)]), INPUT, ": mesh: two triangles are turned against each other at the edge from"),
    ("a fifth facet at an edge", "stl", stl_text(faces=FACES + [(0, 1, 4)], points=POINTS + [(1, 1, 1)]), INPUT, ": mesh: more than two triangles meet at the edge from (0, 0, 0)"),
    ("both sides of a facet", "stl", stl_text(faces=[(0, 1, 2), (0, 2, 1)]), INPUT, ": mesh: two triangles lie on each other at the edge from"),
    ("no name and no facets", "stl", "solid", INPUT, ":1:6: found the end of the file, expected 'endsolid'"),
    ("a second body without an end", "stl", TEXT + "solid other\n", INPUT, ":32:1: found the end of the file, expected 'endsolid'"),
    ("one number of a normal", "stl", TEXT.replace("normal 0 0 0", "normal 0", 1), INPUT, ":4:7: found 'vertex', expected 'outer'"),
    ("four numbers of a normal", "stl", TEXT.replace("normal 0 0 0", "normal 0 0 0 0", 1), INPUT, ":2:22: found '0', expected 'outer'"),
    ("four coordinates", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 2 0 0", 1), INPUT, ":5:20: found '0', expected 'vertex'"),
    ("no end of a loop", "stl", TEXT.replace("    endloop\n", "", 1), INPUT, ":7:3: found 'endfacet', expected 'endloop'"),
    ("a hexadecimal coordinate", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 0x2 0", 1), INPUT, ":5:16: found '0x2', expected a coordinate"),
    ("a decimal comma", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 2,5 0", 1), INPUT, ":5:16: found '2,5', expected a coordinate"),
    ("a long word", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 " + "5" * 200 + " 0", 1), INPUT, ":5:16: found '" + "5" * 60 + "', expected a coordinate"),
    ("a zero byte", "stl", TEXT.replace("vertex 0 2 0", "vertex 0 2\0 0", 1), INPUT, ": found 512 bytes, expected 99090843284, as a binary STL file of 1981816864 triangles has"),
    ("a quad", "stl", TEXT.replace("outer loop", "outer quad", 1), INPUT, ":3:11: found 'quad', expected 'loop'"),
    ("an end within a body", "stl", TEXT.replace("  facet normal", "endsolid\n  facet normal", 1), INPUT, ":3:3: found 'facet', expected 'solid'"),
    # STL, binary
    ("zeros", "stl", b"\0" * 84, INPUT, ": mesh: 0 vertices, expected 3 to"),
    ("79 bytes", "stl", b"\0" * 79, INPUT, ": found 79 bytes, expected at least the 84"),
    *[(f"cut after {n} bytes", "stl", BINARY[:n], INPUT, f": found {n} bytes, expected 284, as a binary STL file of 4 triangles has") for n in range(90, 284, 40)],
    ("bytes behind", "stl", BINARY + b"\0", INPUT, ": found 285 bytes, expected 284"),
    ("one more than there is", "stl", stl_binary(count=5), INPUT, ": found 284 bytes, expected 334, as a binary STL file of 5 triangles has"),
    ("one less than there is", "stl", stl_binary(count=3), INPUT, ": found 284 bytes, expected 234"),
    ("four thousand million", "stl", stl_binary(count=2**32 - 1), INPUT, ": found 284 bytes, expected 214748364834, as"),
    ("a count from behind", "stl", stl_binary(count=4 << 24), INPUT, ": found 284 bytes, expected 3355443284"),
    ("nan, binary", "stl", stl_binary(points=moved(1, (3, NAN, 0))), INPUT, ": byte 124: found nan as a coordinate of triangle 1"),
    ("infinite, binary", "stl", stl_binary(points=moved(3, (0, 0, INF))), INPUT, ": byte 178: found inf as a coordinate of triangle 2"),
    ("one place, binary", "stl", stl_binary(faces=[(0, 0, 1)]), INPUT, ": mesh: each of its 1 triangles has two corners in one place"),
    ("on a line, binary", "stl", stl_binary(points=moved(3, (1, 0, 0))), INPUT, ": mesh: the corners of triangle 1 lie on one line"),
    ("turned over, binary", "stl", stl_binary(faces=FACES[:3] + [(0, 2, 3)]), INPUT, ": mesh: two triangles are turned against each other"),
    ("a header that says solid", "stl", stl_binary(header=b"solid rock")[:-1], INPUT, ": found 283 bytes, expected 284"),
    ("the header alone", "stl", BINARY[:80], INPUT, ": found 80 bytes, expected at least the 84 with which a binary STL file begins"),
    ("a part of the count", "stl", BINARY[:82], INPUT, ": found 82 bytes, expected at least the 84 with which a binary STL file begins"),
    ("a count of 0 and triangles", "stl", stl_binary(count=0), INPUT, ": found 284 bytes, expected 84, as a binary STL file of 0 triangles has"),
    ("a count of 2^31", "stl", stl_binary(count=2**31), INPUT, ": found 284 bytes, expected 107374182484, as a binary STL file of 2147483648 triangles has"),
    ("a count that wraps round", "stl", stl_binary(count=85899346), INPUT, ": found 284 bytes, expected 4294967384, as a binary STL file of 85899346 triangles has"),
    ("no last attribute", "stl", BINARY[:-2], INPUT, ": found 282 bytes, expected 284, as a binary STL file of 4 triangles has"),
    ("one byte less", "stl", BINARY[:-1], INPUT, ": found 283 bytes, expected 284, as a binary STL file of 4 triangles has"),
    ("a triangle behind", "stl", BINARY + BINARY[84:134], INPUT, ": found 334 bytes, expected 284, as a binary STL file of 4 triangles has"),
    ("twice", "stl", BINARY + BINARY, INPUT, ": found 568 bytes, expected 284, as a binary STL file of 4 triangles has"),
    ("nan of another sign, binary", "stl", stl_binary(points=moved(1, (3, 0, -NAN))), INPUT, ": byte 128: found "),
    ("infinite below, binary", "stl", stl_binary(points=moved(0, (-INF, 0, 0))), INPUT, ": byte 96: found -inf as a coordinate of triangle 1, expected a finite number"),
    ("nan in the last corner", "stl", BINARY[:-6] + struct.pack("<f", NAN) + b"\0\0", INPUT, ": byte 278: found nan as a coordinate of triangle 4, expected a finite number"),
    ("all in one place", "stl", stl_binary(points=[(1, 1, 1)] * 4), INPUT, ": mesh: each of its 4 triangles has two corners in one place"),
    ("both sides of a facet, binary", "stl", stl_binary(faces=[(0, 1, 2), (0, 2, 1)]), INPUT, ": mesh: two triangles lie on each other at the edge from (0, 0, 0) to (0, 2, 0) m"),
    ("a fifth facet at an edge, binary", "stl", stl_binary(faces=FACES + [(0, 1, 4)], points=POINTS + [(1, 1, 1)]), INPUT, ": mesh: more than two triangles meet at the edge from (0, 0, 0) to (3, 0, 0) m"),
    ("all on a line, binary", "stl", stl_binary(points=[(k, 0, 0) for k in range(4)]), INPUT, ": mesh: the corners of triangle 0 lie on one line, beside (0, 0, 0) m"),
    ("a sliver, binary", "stl", stl_binary(points=moved(3, (1.5, 1e-12, 0))), INPUT, ": mesh: the corners of triangle 1 lie on one line, beside (0, 0, 0) m"),
    ("largest numbers, binary", "stl", stl_binary(points=moved(1, (3e38, 0, 0))), INPUT, ": mesh: the corners of triangle 0 lie on one line, beside (0, 0, 0) m"),
    ("noise", "stl", bytes(range(256)), INPUT, ": found 256 bytes, expected 69895184884, as a binary STL file of 1397903696 triangles has"),
    ("a count of the other order", "stl", BINARY[:80] + struct.pack(">I", 4) + BINARY[84:], INPUT, ": found 284 bytes, expected 3355443284, as a binary STL file of 67108864 triangles has"),
    ("no triangles behind the count", "stl", BINARY[:84], INPUT, ": found 84 bytes, expected 284"),
    ("all bits", "stl", b"\xff" * 284, INPUT, ":1:1: found '"),
    # OBJ
    ("empty", "obj", "", INPUT, ":1:1: found 0 vertices and 0 triangles in faces: is this OBJ?"),
    ("no faces", "obj", OBJ[:OBJ.index("f 1")], INPUT, ":1:1: found 4 vertices and 0 triangles in faces"),
    ("no vertices", "obj", "f 1 2 3\n", INPUT, ":1:1: found 0 vertices and 1 triangles in faces"),
    ("STL as OBJ", "obj", TEXT, INPUT, ":1:1: found 0 vertices and 0 triangles"),
    ("a zero byte", "obj", OBJ + "\0", INPUT, ": found a zero byte: is this text?"),
    ("binary STL as OBJ", "obj", BINARY, INPUT, ": found a zero byte: is this text?"),
    ("two coordinates", "obj", OBJ.replace("v 3 0 0", "v 3 0"), INPUT, ":4:5: found the end of the line, expected x, y and z"),
    ("no coordinates", "obj", OBJ.replace("v 3 0 0", "v"), INPUT, ":4:1: found the end of the line, expected x, y and z"),
    ("a word", "obj", OBJ.replace("v 3 0 0", "v 3 nought 0"), INPUT, ":4:5: found 'nought', expected a coordinate"),
    ("nan", "obj", OBJ.replace("v 3 0 0", "v nan 0 0"), INPUT, ":4:3: found 'nan', expected a coordinate"),
    ("too far", "obj", OBJ.replace("v 3 0 0", "v 3 0 1e200"), INPUT, ":4:7: found '1e200', expected a coordinate"),
    ("two corners", "obj", OBJ.replace("f 1 3 2", "f 1 3"), INPUT, ":11:5: found a face with 2 corners, expected 3 or more"),
    ("no corners", "obj", OBJ.replace("f 1 3 2", "f"), INPUT, ":11:1: found a face with 0 corners"),
    ("vertex 0", "obj", OBJ.replace("f 1 3 2", "f 0 3 2"), INPUT, ":11:3: found '0', expected a corner of a face"),
    ("a vertex that is not there", "obj", OBJ.replace("f 1 3 2", "f 1 3 5"), INPUT, ":11:7: a face names vertex 5, but there are 4"),
    ("before the first one", "obj", OBJ.replace("-4", "-5"), INPUT, ":14:6: found '-5', expected a corner of a face"),
    ("a word for a corner", "obj", OBJ.replace("f 1 3 2", "f 1 three 2"), INPUT, ":11:5: found 'three', expected a corner"),
    ("a fraction of a corner", "obj", OBJ.replace("f 1 3 2", "f 1 2.5 2"), INPUT, ":11:5: found '2.5', expected a corner"),
    ("a huge corner", "obj", OBJ.replace("f 1 3 2", "f 1 99999999999999999999 2"), INPUT, ":11:5: found '99999999999999999999', expected a corner"),
    ("a corner beyond all", "obj", OBJ.replace("f 1 3 2", "f 1 999999999 2"), INPUT, ":11:5: a face names vertex 999999999, but there are 4"),
    ("only a slash", "obj", OBJ.replace("f 1 3 2", "f 1 /3 2"), INPUT, ":11:5: found '/3', expected a corner"),
    ("a line that goes on", "obj", OBJ.replace("f 1 3 2", "f 1 3 \\\n2"), INPUT, ":11:7: found '\\', expected a corner"),
    ("corners on a line", "obj", OBJ.replace("v 0 0 1", "v 1 0 0"), INPUT, ": mesh: the corners of triangle 1 lie on one line, beside (0, 0, 0) m"),
    ("turned over", "obj", OBJ.replace("f 1 3 2", "f 1 2 3"), INPUT, ": mesh: two triangles are turned against each other at the edge from"),
    ("a third triangle at an edge", "obj", OBJ + "v 1 1 -1\nf 1 2 5\n", INPUT, ": mesh: more than two triangles meet at the edge"),
    ("one coordinate", "obj", OBJ.replace("v 3 0 0", "v 3"), INPUT, ":4:3: found the end of the line, expected x, y and z"),
    ("infinite", "obj", OBJ.replace("v 3 0 0", "v inf 0 0"), INPUT, ":4:3: found 'inf', expected a coordinate"),
    ("a hexadecimal coordinate", "obj", OBJ.replace("v 3 0 0", "v 0x3 0 0"), INPUT, ":4:3: found '0x3', expected a coordinate"),
    ("a decimal comma", "obj", OBJ.replace("v 3 0 0", "v 3,5 0 0"), INPUT, ":4:3: found '3,5', expected a coordinate"),
    ("a long word", "obj", OBJ.replace("v 3 0 0", "v " + "3" * 200 + " 0 0"), INPUT, ":4:3: found '" + "3" * 60 + "', expected a coordinate"),
    ("one corner", "obj", OBJ.replace("f 1 3 2", "f 1"), INPUT, ":11:3: found a face with 1 corners, expected 3 or more in its line"),
    ("a corner of minus 0", "obj", OBJ.replace("f 1 3 2", "f -0 3 2"), INPUT, ":11:3: found '-0', expected a corner of a face"),
    ("a corner with a sign", "obj", OBJ.replace("f 1 3 2", "f +1 3 2"), INPUT, ":11:3: found '+1', expected a corner of a face"),
    ("a corner below all", "obj", OBJ.replace("f 1 3 2", "f -999999999 3 2"), INPUT, ":11:3: found '-999999999', expected a corner of a face"),
    ("a face before its vertices", "obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\n", INPUT, ":1:7: a face names vertex 3, but there are 2"),
    ("faces of one place", "obj", OBJ[:OBJ.index("f 1")] + "f 1 1 1\n", INPUT, ": mesh: each of its 1 triangles has two corners in one place"),
    ("all in one place", "obj", OBJ.replace("v 3 0 0", "v 0 0 0").replace("v 0 2 0", "v 0 0 0").replace("v 0 0 1", "v 0 0 0"), INPUT, ": mesh: each of its 4 triangles has two corners in one place"),
    ("both sides of a face", "obj", OBJ[:OBJ.index("f 1")] + "f 1 2 3\nf 1 3 2\n", INPUT, ": mesh: two triangles lie on each other at the edge from (0, 0, 0) to (0, 2, 0) m"),
    ("beyond all meshes", "obj", OBJ.replace("v 3 0 0", "v 1e99 0 0"), INPUT, ": mesh: vertex 1 has the coordinate 1e+99 m, expected a finite number of at most 1e+60"),
    ("a face with a corner twice on a line", "obj", OBJ[:OBJ.index("f 1")] + "v 6 0 0\nf 1 2 5\n", INPUT, ": mesh: the corners of triangle 0 lie on one line, beside (0, 0, 0) m"),
    ("noise", "obj", bytes(range(1, 256)), INPUT, ":1:1: found 0 vertices and 0 triangles in faces: is this OBJ?"),
]

# name, the mapping under mesh, expected after the scene's name, exit code
SCENES = [
    ("no file", "form: obj, radius: 0.1", ":2:20: 'mesh': 'file' is missing", INPUT),
    ("no form", "file: rock, radius: 0.1", ":2:20: 'mesh': 'form' is missing", INPUT),
    ("no radius", "file: rock, form: obj", ":2:20: 'mesh': 'radius' is missing", INPUT),
    ("a radius of 0", "file: rock, form: obj, radius: 0", ":2:50: 'radius': found '0', expected a number in m, greater than 0", INPUT),
    ("a small radius", "file: rock, form: obj, radius: 1e-6", ":2:50: obstacle 'rock': radius is 1e-06 m, expected a finite number of at least 3e-06 m", INPUT),
    ("an unknown form", "file: rock, form: ply, radius: 0.1", ":2:39: 'form': found 'ply', expected one of: stl obj", INPUT),
    ("a file elsewhere", "file: ../rock, form: obj, radius: 0.1", ":2:27: 'file': found '../rock', expected the name of a file beside this one", INPUT),
    ("a file that is not there", "file: none, form: obj, radius: 0.1", "none: ", IO),
    ("a scale of 0", "file: rock, form: obj, radius: 0.1, scale: 0", ":2:63: 'scale': found '0', expected a number, greater than 0", INPUT),
    ("a scale beyond all", "file: rock, form: obj, radius: 0.1, scale: 1e70", "rock: mesh: vertex 1 has the coordinate 3e+70 m", INPUT),
    ("no rotation", "file: rock, form: obj, radius: 0.1, rotation: {quaternion: [0, 0, 0, 0]}", ":2:63: 'quaternion': found zeros", INPUT),
    ("a point beyond all", "file: rock, form: obj, radius: 0.1, point: [0, 0, .inf]", ":2:77: 'point': found '.inf', expected a number in m, finite", INPUT),
    ("a line inside", "file: rock, form: obj, radius: 0.1, scale: 100, point: [-10, -10, 0]", ":4:60: line 'cable': start: node 0 lies", INPUT),
    ("a sphere as well", "file: rock, form: obj, radius: 0.1}, sphere: {radius: 1", ":2:13: obstacle 'rock': too much given", INPUT),
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

    def refused(self, name, keys, code, wanted):
        self.count += 1
        found = self.check(keys)
        told = found.stderr.decode("latin-1")
        if found.returncode == code and not found.stdout and told.count("\n") <= 1 and told.startswith(f"capstan: {self.path(wanted)}"):
            return
        self.failed += 1
        print(f"{name}: exit {found.returncode}, expected {code}: {wanted}\n    {told}{found.stdout.decode()}")

    def accepted(self, name, keys, says=SAYS):
        found = self.check(keys)
        if found.returncode == 0 and says in found.stdout.decode():
            return
        self.failed += 1
        print(f"{name}: exit {found.returncode}: {found.stderr.decode()}{found.stdout.decode()}")


def check_good(suite):
    """All forms of one mesh; in other units, turned, with triangles too many, as a sheet, turned inside out, and open."""
    stl, obj = "file: rock, form: stl, radius: 0.1", "file: rock, form: obj, radius: 0.1"
    for name, data, keys in [("text", TEXT, stl), ("text in capitals", TEXT.upper(), stl), ("text, other ends of lines", TEXT.replace("\n", "\r\n"), stl),
                             ("two bodies of text", TEXT.replace("endloop\n  endfacet\n", "endloop\n  endfacet\nendsolid\nsolid other\n", 1), stl),
                             ("normals that are none", TEXT.replace("normal 0 0 0", "normal -nan -nan -nan"), stl),
                             ("binary", BINARY, stl), ("binary with the header of text", stl_binary(header=b"solid rock"), stl),
                             ("OBJ", OBJ, obj), ("OBJ, other ends of lines", OBJ.replace("\n", "\r\n"), obj),
                             ("OBJ with colours", OBJ.replace("v 3 0 0", "v 3 0 0 0.5 0.5 0.5"), obj),
                             ("OBJ, a line at the end", OBJ.rstrip("\n"), obj)]:
        suite.write("rock", data)
        suite.accepted(name, keys)
    suite.write("rock", stl_binary(points=tuple(tuple(1000 * x for x in p) for p in POINTS)))
    suite.accepted("millimetres", stl + ", scale: 0.001")
    suite.write("rock", stl_text(points=tuple((y, -x, z) for x, y, z in POINTS)))
    suite.accepted("turned", stl + ", rotation: {quaternion: [1, 0, 0, 1]}", "closed, lines outside, friction 0.5")
    suite.write("rock", stl_text(points=tuple((x - 1, y - 2, z - 3) for x, y, z in POINTS)))
    suite.accepted("elsewhere", stl + ", point: [1, 2, 3]")
    suite.write("rock", stl_text(faces=FACES + [(0, 0, 1), (1, 3, 0)]))
    suite.accepted("a triangle without area and one twice", stl, "closed, lines outside, 2 triangles left out, friction 0.5")
    suite.write("rock", stl_text(faces=FACES[:3] + [(0, 2, 3)]))
    suite.accepted("a sheet", stl + ", two_sided: true", "closed, lines on both sides, friction 0.5")
    suite.write("rock", stl_text(faces=[(a, c, b) for a, b, c in FACES], points=[tuple(50 * x - 5 for x in p) for p in POINTS]))
    suite.accepted("inside out", "file: rock, form: stl, radius: 0.1, point: [0, 0, 36]", "closed, lines inside, friction 0.5")
    suite.write("rock", stl_text(faces=FACES[:3]))
    suite.accepted("open", stl, "open (3 edges at its rim), one-sided, friction 0.5")
    quad = "".join("v %g %g 0\n" % p for p in ((0, 0), (3, 0), (3, 2), (0, 2))) + "f 1 2 3 4\n"
    suite.write("rock", quad)
    suite.accepted("a face with four corners", obj, "mesh of 2 triangles, x 0 to 3 m, y 0 to 2 m, z 0 to 0 m")


def main():
    with tempfile.TemporaryDirectory() as folder:
        suite = Suite(sys.argv[1], folder)
        check_good(suite)
        for name, form, data, code, wanted in FILES:
            suite.write("rock", data)
            suite.refused(f"{form}: {name}", f"file: rock, form: {form}, radius: 0.1", code, "rock" + wanted)
        suite.write("rock", OBJ)
        for name, keys, wanted, code in SCENES:
            suite.refused(name, keys, code, wanted if wanted.startswith(("none", "rock")) else "scene.yaml" + wanted)
        print(f"{suite.count} cases, {suite.failed} failed")
        return 0 if is_told(suite.count) and not suite.failed else 1


if __name__ == "__main__":
    sys.exit(main())
