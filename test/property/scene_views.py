# SPDX-License-Identifier: BSD-3-Clause
"""The same scene seen from elsewhere: turned, mirrored and shifted, in other units, with its lines from the other end, and in another order.

A view takes a place x to length Q x + shift, a force f to force Q f and a time t to time t. What a mirror turns round, moments and axes of
rotations, gets the sign of det Q; the own axes of a body are mirrored with it."""
import copy
import math


def dot(a, b):
    return sum(x*y for x, y in zip(a, b))


def apply(rows, v):
    return [dot(row, v) for row in rows]


def product(a, b):
    return [[dot(row, column) for column in zip(*b)] for row in a]


def transposed(a):
    return [list(column) for column in zip(*a)]


def of_quaternion(q):
    """the rows of the rotation"""
    w, x, y, z = (c/math.sqrt(dot(q, q)) for c in q)
    return [[1 - 2*(y*y + z*z), 2*(x*y - z*w), 2*(x*z + y*w)], [2*(x*y + z*w), 1 - 2*(x*x + z*z), 2*(y*z - x*w)],
            [2*(x*z - y*w), 2*(y*z + x*w), 1 - 2*(x*x + y*y)]]


ONE = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
MIRROR = [[1, 0, 0], [0, -1, 0], [0, 0, 1]]

PLACE, VECTOR, AXIAL, OWN, OWN_AXIAL, NUMBER, ROTATION, SPACE_MATRIX, OWN_MATRIX, KEPT = range(10)

# what a key is, by the kind of mapping that it is in: its kind, and the powers of length, force and time in its unit
KEYS = {
    "scene": {"gravity": (VECTOR, 1, 0, -2), "water_density": (NUMBER, -4, 1, 2)},
    "plane": {"point": (PLACE,), "normal": (VECTOR,)},
    "line": {"length": (NUMBER, 1), "weight": (NUMBER, -1, 1), "mass": (NUMBER, -2, 1, 2), "diameter": (NUMBER, 1), "stiffness": (NUMBER, 0, 1),
             "damping": (NUMBER, 0, 1, 1)},
    "drag": {"diameter": (NUMBER, 1)},
    "straight": {"from": (PLACE,), "to": (PLACE,)},
    "end": {"held": (PLACE,), "position": (PLACE,), "move": (VECTOR, 1), "force": (VECTOR, 0, 1), "stored": (NUMBER, 1)},
    "point weight": {"at": (NUMBER, 1), "weight": (NUMBER, 0, 1), "mass": (NUMBER, -1, 1, 2), "volume": (NUMBER, 3)},
    "point": {"held": (PLACE,), "free": (PLACE,), "at": (OWN, 1), "weight": (NUMBER, 0, 1), "mass": (NUMBER, -1, 1, 2), "force": (VECTOR, 0, 1),
              "move": (VECTOR, 1), "position": (PLACE,)},
    "body": {"free": (PLACE,), "rotation": (ROTATION,), "weight": (NUMBER, 0, 1), "mass": (NUMBER, -1, 1, 2), "buoyancy": (NUMBER, 0, 1),
             "centre_of_gravity": (OWN, 1), "centre_of_buoyancy": (OWN, 1), "hydrostatics": (SPACE_MATRIX, -1, 1), "added_mass": (OWN_MATRIX, -1, 1, 2),
             "damping": (OWN_MATRIX, -1, 1, 1), "moments_of_inertia": (KEPT, 1, 1, 2), "velocity": (VECTOR, 1, 0, -1), "turn_rate": (AXIAL, 0, 0, -1),
             "force": (VECTOR, 0, 1), "moment": (AXIAL, 1, 1), "arm": (VECTOR, 1), "position": (PLACE,)},
    "entry": {"duration": (NUMBER, 0, 0, 1), "gravity": (VECTOR, 1, 0, -2)},
}
# what is in a mapping under these keys
INSIDE = {"obstacles": "obstacle", "lines": "line", "points": "point", "bodies": "body", "ends": "end", "point_weights": "point weight", "history": "entry",
          "plane": "plane", "straight": "straight", "drag": "drag", "start": "start"}
ENTRIES = {"A": "end", "B": "end", "point": "point", "body": "body"}


class View:
    def __init__(self, name, turn=None, shift=(0, 0, 0), length=1.0, force=1.0, time=1.0):
        self.name, self.turn, self.shift, self.length, self.force, self.time = name, turn or ONE, shift, length, force, time
        self.sign = dot(self.turn[0], [self.turn[1][i]*self.turn[2][j] - self.turn[1][j]*self.turn[2][i] for i, j in ((1, 2), (2, 0), (0, 1))])
        self.own = MIRROR if self.sign < 0 else ONE

    def unit(self, length=0, force=0, time=0):
        return self.length**length*self.force**force*self.time**time

    def matrix(self, m, turn, *unit):
        """6x6, of forces and moments: those of rotations have one more length"""
        sign = 1 if turn is ONE else self.sign
        six = [row + [0, 0, 0] for row in turn] + [[0, 0, 0] + [sign*x for x in row] for row in turn]
        m = product(product(six, m), transposed(six))
        return [[m[i][j]*self.unit(*unit)*self.length**((i > 2) + (j > 2)) for j in range(6)] for i in range(6)]

    def value(self, value, kind, *unit):
        scale = self.unit(*unit)
        if kind == NUMBER:
            return value if value == ".inf" else value*scale
        if kind == PLACE:
            return [self.length*x + s for x, s in zip(apply(self.turn, value), self.shift)]
        if kind in (VECTOR, AXIAL):
            return [x*scale*(self.sign if kind == AXIAL else 1) for x in apply(self.turn, value)]
        if kind == OWN:
            return [x*scale for x in apply(self.own, value)]
        if kind == KEPT:
            return [x*scale for x in value]
        if kind == ROTATION:  # that of Q R M, M the mirror of the own axes
            return {"quaternion": quaternion(product(product(self.turn, of_quaternion(value["quaternion"])), self.own))}
        return self.matrix(value, self.turn if kind == SPACE_MATRIX else self.own, *unit)

    def mapping(self, value, kind):
        out = {}
        for key, v in value.items():
            if key in KEYS.get(kind, {}):
                out[key] = self.value(v, *KEYS[kind][key])
            elif kind == "entry" and "." in key:
                word = key.rsplit(".", 1)[1]
                out[key] = v*self.length if word.startswith("pay_out") else self.mapping(v, ENTRIES[word])
            elif key in INSIDE and isinstance(v, list):
                out[key] = [self.mapping(x, INSIDE[key]) for x in v]
            elif key in ("obstacles", "lines", "points", "bodies", "ends"):
                out[key] = {name: self.mapping(x, INSIDE[key]) if isinstance(x, dict) else x for name, x in v.items()}
            else:
                out[key] = self.mapping(v, INSIDE[key]) if isinstance(v, dict) else v
        if kind == "body" and "free" in value and "rotation" not in value:
            out["rotation"] = self.value({"quaternion": [1, 0, 0, 0]}, ROTATION)
        return out

    def scene(self, scene):
        return self.mapping(scene, "scene")

    def back(self, x):
        """a place of this view, as the first one has it"""
        return [v/self.length for v in apply(transposed(self.turn), [a - s for a, s in zip(x, self.shift)])]


def quaternion(r):
    """of the rows of a rotation, by its largest component"""
    squares = [1 + r[0][0] + r[1][1] + r[2][2]] + [1 + 2*r[i][i] - r[0][0] - r[1][1] - r[2][2] for i in range(3)]
    k = max(range(4), key=lambda i: squares[i])
    skew = [r[(i + 2) % 3][(i + 1) % 3] - r[(i + 1) % 3][(i + 2) % 3] for i in range(3)]
    if k == 0:
        return [squares[0]] + skew
    return [skew[k - 1]] + [squares[k] if i == k - 1 else r[i][k - 1] + r[k - 1][i] for i in range(3)]


def from_the_other_end(scene, names):
    """these lines from B to A"""
    scene, other = copy.deepcopy(scene), {"A": "B", "B": "A"}
    for name in names:
        line = scene["lines"][name]
        line["ends"] = {other[e]: line["ends"][e] for e in "AB"}
        if line["start"] != "static":
            line["start"] = {"straight": {"from": line["start"]["straight"]["to"], "to": line["start"]["straight"]["from"]}}
        if "point_weights" in line:
            line["point_weights"] = [{**w, "at": line["length"] - w["at"]} for w in reversed(line["point_weights"])]
        ends = [f"{name}.{word}{e}" for word in ("", "pay_out_") for e in "AB"]
        scene["history"] = [{k[:-1] + other[k[-1]] if k in ends else k: v for k, v in entry.items()} for entry in scene["history"]]
    return scene


def in_another_order(scene, random):
    """lines, points, obstacles and changes of an entry"""
    def mixed(mapping):
        items = list(mapping.items())
        random.shuffle(items)
        return dict(items)
    return {k: mixed(v) if isinstance(v, dict) else [mixed(e) for e in v] if k == "history" else v for k, v in scene.items()}
