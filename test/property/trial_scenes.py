# SPDX-License-Identifier: BSD-3-Clause
"""Random scenes of 27 classes, each fixed by its class and a seed. scene(name, seed) is a mapping that json.dumps turns into a scene file.

What varies in all of them: the size of the line (from 0.1 to 1000 m, half of the scenes), of the forces (0.01 N to 10 kN), the number of
elements, inextensible or elastic, straight, bent and static starts, ends that are pulled, moved and put somewhere, one step or several an entry,
friction consistent (three of four) or frozen, friction zero now and then, and a turn and shift of everything in space (two of five)."""
import math
import random

UP = (0.0, 0.0, 1.0)


def add(a, b, by=1.0):
    return [x + by*y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x*y for x, y in zip(a, b))


def cross(a, b):
    return [a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]]


def times(s, a):
    return [s*x for x in a]


def size(a):
    return math.sqrt(dot(a, a))


def distance(obstacle, x):
    """of x from the surface of an obstacle"""
    (kind, at), = ((k, v) for k, v in obstacle.items() if k in ("plane", "cylinder", "sphere"))
    if kind == "plane":
        return dot(add(x, at["point"], -1), at["normal"])/size(at["normal"])
    arm = add(x, at["centre" if kind == "sphere" else "point"], -1)
    if kind == "cylinder":
        arm = add(arm, at["axis"], -dot(arm, at["axis"])/dot(at["axis"], at["axis"]))
    return size(arm) - at["radius"]


class Maker:
    """Draws the parts of a scene."""

    def __init__(self, name, seed):
        self.random = random.Random(f"{name} {seed}")
        self.length = self.between(0.5, 2)
        self.force = 1.0
        if self.chance(0.5):
            self.length *= self.decade(-1, 3)
            self.force = self.decade(-2, 4)
        self.gravity = [0.0, 0.0, -9.81]
        self.obstacles, self.lines, self.history, self.more = {}, {}, [], {}
        self.friction = "consistent" if self.chance(0.75) else "frozen"

    def between(self, a, b):
        return self.random.uniform(a, b)

    def decade(self, a, b):
        return 10**self.random.uniform(a, b)

    def chance(self, p):
        return self.random.random() < p

    def count(self, a, b):
        return self.random.randint(a, b)

    def normal(self, scale=1.0):
        return [self.random.gauss(0, scale) for _ in range(3)]

    # friction ----------------------------------------------------------------------------------------------------------

    def coefficient(self):
        return 0 if self.chance(0.08) else self.between(0.02, 1)

    def two_coefficients(self):
        """along and across, one of them zero now and then; ellipse or box, along the line or along a grain"""
        friction = {k: self.between(0.02, 1) if self.chance(0.93) else 0.0 for k in ("axial", "lateral")}
        if self.chance(0.4):
            friction["shape"] = "box"
        if self.chance(0.4):
            friction["grain"] = [self.between(-1, 1), self.between(-1, 1), self.between(-0.2, 0.2)]
        return friction

    def set_of_forces(self):
        """a rectangle off its middle, a disc with a rib, a disc beside the origin, a rounded box, a triangle, or a segment without any width"""
        b, kind = self.between, self.count(0, 5)
        a, c, d, e = b(0.05, 0.9), b(0.05, 0.9), b(0.05, 0.9), b(0.05, 0.9)
        forces = [{"polytope": [[-a, -d], [c, -d], [c, e], [-a, e]]},
                  {"hull": [{"disc": 0.5*a}, {"segment": [[0, -c], [0, d]]}]},
                  {"translate": {"by": [b(-0.2, 0.2), b(-0.2, 0.2)], "of": {"disc": 0.3}}},
                  {"sum": [{"ellipse": [0.5*a, 0.5*c]}, {"box": [[-0.3*d, 0.3*e], 0.2]}]},
                  {"polytope": [[0, -0.3], [0.5, 0.4], [-0.4, 0.5]]},
                  {"segment": [[-0.6*a, 0], [0.6*c, 0]]}][kind]
        friction = {"set": forces}
        if self.chance(0.5):
            friction["grain"] = [b(-1, 1), b(-1, 1), b(-0.2, 0.2)]
        return friction

    def draw_friction(self, kind=None):
        return {None: self.coefficient, "two": self.two_coefficients, "set": self.set_of_forces}[kind]()

    # obstacles ---------------------------------------------------------------------------------------------------------

    def plane(self, name, point=(0.0, 0.0, 0.0), normal=UP, kind=None):
        self.obstacles[name] = {"plane": {"point": list(point), "normal": list(normal)}, "friction": self.draw_friction(kind)}

    def cylinder(self, name, point, axis, radius, kind=None):
        self.obstacles[name] = {"cylinder": {"point": list(point), "axis": list(axis), "radius": radius}, "friction": self.draw_friction(kind)}

    def ball(self, name, centre, radius, kind=None):
        axis = [self.between(-1, 1), self.between(-1, 1), 1.0]
        self.obstacles[name] = {"sphere": {"centre": list(centre), "radius": radius, "axis": axis}, "friction": self.draw_friction(kind)}

    def tilted(self, most):
        angle = self.between(0, most)
        return [math.sin(angle), 0.0, math.cos(angle)]

    def pipe_on_bed(self, share, kind=None):
        """a pipe that lies in the bed, in so many of the scenes"""
        if self.chance(share):
            self.cylinder("pipe", [self.between(-0.5, 0.5)*self.length, 0, 0], [self.between(-0.3, 0.3), 1, 0], self.length*self.between(0.05, 0.2), kind)

    def ball_on_bed(self, share):
        if self.chance(share):
            self.ball("ball", [self.between(-0.5, 0.5)*self.length, 0, 0], self.length*self.between(0.05, 0.2))

    def lift(self, points):
        """how far up all of them are clear of the obstacles"""
        up = 0.0
        for _ in range(400):
            low = min((distance(o, add(p, UP, up)) for o in self.obstacles.values() for p in points), default=1)
            if low >= -1e-13:
                break
            up += max(-low, 1e-9)
        return up

    # lines -------------------------------------------------------------------------------------------------------------

    def line(self, name, length, start, **given):
        ends = {"A": given.get("A", "held"), "B": given.get("B", "free")}
        stiff = ".inf" if given.get("inextensible", self.chance(0.3)) else self.decade(0.5, 7)*self.force
        self.lines[name] = {"length": length, "elements": given.get("elements", self.count(1, 60)),
                            "weight": given.get("weight", self.force/length), "stiffness": stiff, "start": start, "ends": ends}
        return self.lines[name]

    def straight(self, length, start=(0.0, 0.0, 0.0), heading=None, climb=0.0):
        heading = self.between(0, 2*math.pi) if heading is None else heading
        direction = [length*math.cos(heading)*math.cos(climb), length*math.sin(heading)*math.cos(climb), length*math.sin(climb)]
        up = self.lift([add(start, direction, i/500) for i in range(501)])
        return {"straight": {"from": add(start, UP, up), "to": add(add(start, direction), UP, up)}}

    def bent(self, length):
        heading, corner, corners = self.between(0, 6.28), [0.0, 0.0, 0.0], [[0.0, 0.0, 0.0]]
        for _ in range(self.count(2, 6)):
            heading += self.between(-1.5, 1.5)
            rise = self.between(-0.3, 0.3) if self.chance(0.2) else 0.0
            corner = add(corner, [math.cos(heading), math.sin(heading), rise], self.between(0.3, 1))
            corners.append(corner)
        whole = sum(size(add(b, a, -1)) for a, b in zip(corners, corners[1:]))
        corners = [times(length/whole, p) for p in corners]
        up = self.lift([add(a, add(b, a, -1), i/100) for a, b in zip(corners, corners[1:]) for i in range(101)])
        return {"polyline": [add(p, UP, up) for p in corners]}

    def rope(self, name, length, **given):
        """somewhere on or above the obstacles: straight, bent, or laid between two places"""
        kind = self.between(0, 1)
        if kind < 0.75:
            start = self.straight(length, climb=0 if self.chance(0.6) else self.between(0, 1.3)) if kind < 0.45 else self.bent(length)
            return self.line(name, length, start, **given)
        heading, climb, reach = self.between(0, 6.28), 0 if self.chance(0.5) else self.between(0, 1.2), self.between(0.5, 0.98)*length
        far = [reach*math.cos(heading)*math.cos(climb), reach*math.sin(heading)*math.cos(climb), reach*math.sin(climb)]
        ends = {k: {"held": add(p, UP, self.lift([p]))} for k, p in (("A", [0.0, 0.0, 0.0]), ("B", far))}
        return self.line(name, length, "static", **{**given, **ends})

    # history -----------------------------------------------------------------------------------------------------------

    def pull(self, low=-2.0, high=0.7):
        """a force on an end, level or upwards mostly"""
        v = self.normal()
        if self.chance(0.4):
            v[2] = 0.0
        elif self.chance(0.7):
            v[2] = abs(v[2])
        return times(self.force*self.decade(low, high)/size(v), v)

    def place(self, name, reach=0.97):
        """within reach of end A, clear of the obstacles"""
        line = self.lines[name]
        start = line["start"]
        a = line["ends"]["A"]["held"] if start == "static" else start["straight"]["from"] if "straight" in start else start["polyline"][0]
        v = self.normal()
        v[2] = abs(v[2]) if self.chance(0.6) else 0.0
        x = add(a, v, line["length"]*self.between(0.1, reach)/size(v))
        return add(x, UP, self.lift([x]))

    def happen(self, entries=None, steps=(1, 3), pulled=0.6, moved=0.15, ends="B", low=-2.0, high=0.7):
        """entries in which ends are pulled, moved or put somewhere, and round obstacles turn"""
        held = {(n, e): not (s == "free" or isinstance(s, dict) and "force" in s) for n, line in self.lines.items() for e, s in line["ends"].items()}
        for i in range(entries if entries is not None else self.count(1, 4)):
            entry = {"name": f"s{i}", "steps": self.count(*steps)}
            for n in self.lines:
                for e in ends:
                    if not self.chance(0.85 if len(self.lines) == 1 else 0.6):
                        continue
                    kind = self.between(0, 1)
                    if kind < pulled:
                        entry[f"{n}.{e}"] = {"force": self.pull(low, high)}
                    elif kind < pulled + moved and held[n, e]:
                        entry[f"{n}.{e}"] = {"move": self.normal(0.1*self.lines[n]["length"])}
                    else:
                        entry[f"{n}.{e}"] = {"position": self.place(n)}
                    held[n, e] = "force" not in entry[f"{n}.{e}"]
            for n, o in self.obstacles.items():
                if "plane" not in o and self.chance(0.3):
                    entry[f"{n}.turn"] = self.between(-40, 40)
            self.history.append(entry)

    def scene(self):
        out = {"capstan": 1, "gravity": self.gravity, "friction_policy": self.friction, **self.more}
        if self.obstacles:
            out["obstacles"] = self.obstacles
        out["lines"], out["history"] = self.lines, self.history
        if self.chance(0.4):
            out = moved(out, turn(self), self.normal(self.between(0, 5)))
        return out


def turn(maker):
    """a random turn, row by row, from a random quaternion"""
    q = [maker.random.gauss(0, 1) for _ in range(4)]
    w, x, y, z = times(1/math.sqrt(sum(a*a for a in q)), q)
    return [[1 - 2*(y*y + z*z), 2*(x*y - z*w), 2*(x*z + y*w)], [2*(x*y + z*w), 1 - 2*(x*x + z*z), 2*(y*z - x*w)],
            [2*(x*z - y*w), 2*(y*z + x*w), 1 - 2*(x*x + y*y)]]


PLACES = {"point", "centre", "from", "to", "held", "position", "polyline"}
DIRECTIONS = {"normal", "axis", "grain", "force", "move", "gravity"}


def moved(value, rows, shift, key=None):
    """everything turned and shifted; a set's numbers are not of space, and those of a friction zone are lengths"""
    if key in ("set", "friction_zones", "elements"):
        return value
    if isinstance(value, dict):
        return {k: moved(v, rows, shift, k) for k, v in value.items()}
    if key == "polyline":
        return [moved(p, rows, shift, "point") for p in value]
    if key in DIRECTIONS:
        return [dot(row, value) for row in rows]
    if key in PLACES and isinstance(value, list):
        return add([dot(row, value) for row in rows], shift)
    if key == "history":
        return [moved(entry, rows, shift) for entry in value]
    return value


# the classes -----------------------------------------------------------------------------------------------------------

def slope(m):
    """a line on a slope about as steep as friction holds, exactly so now and then"""
    mu = m.between(0.05, 1.2)
    angle = min(math.atan(mu)*m.between(0.3, 1.8), 1.5)
    if m.chance(0.2):
        angle = math.atan(mu)*(1 + m.random.choice((-1, 1))*m.decade(-9, -3))
    m.plane("slope", normal=[math.sin(angle), 0, math.cos(angle)])
    m.obstacles["slope"]["friction"] = mu
    heading = m.between(0, 2*math.pi)
    direction = add(times(math.cos(heading), [math.cos(angle), 0, -math.sin(angle)]), [0, math.sin(heading), 0])
    m.line("a", m.length, {"straight": {"from": [0.0, 0.0, 0.0], "to": times(m.length, direction)}}, A="free" if m.chance(0.15) else "held",
           B="held" if m.chance(0.3) else "free")
    m.history.append({"name": "rest", "steps": m.count(1, 2)})
    if m.chance(0.7):
        m.happen()


def planes(m):
    """two to four planes that face upwards"""
    for i in range(m.count(2, 4)):
        normal = m.normal()
        m.plane(f"p{i}", m.normal(0.3*m.length), [normal[0], normal[1], abs(normal[2]) + 0.2], "two" if m.chance(0.15) else None)
    m.rope("a", m.length)
    m.happen()


def pipes(m):
    """a bed with pipes of all directions, half buried or free"""
    m.plane("bed")
    for i in range(m.count(1, 3)):
        r = m.length*m.between(0.03, 0.2)
        m.cylinder(f"c{i}", [m.between(-0.6, 0.6)*m.length, m.between(-0.3, 0.3)*m.length, m.between(-0.8, 1.2)*r],
                   [m.between(-1, 1), m.between(-1, 1), m.between(-0.2, 0.2)], r)
    m.rope("a", m.length, elements=m.count(10, 60))
    m.happen()


def balls(m):
    """boulders, on a bed or without"""
    if m.chance(0.7):
        m.plane("bed")
    for i in range(m.count(1, 4)):
        r = m.length*m.between(0.05, 0.25)
        m.ball(f"b{i}", [m.between(-0.7, 0.7)*m.length, m.between(-0.4, 0.4)*m.length, m.between(-0.8, 0.8)*r], r)
    m.rope("a", m.length, elements=m.count(10, 60))
    m.happen()


def drum(m):
    """round a drum that turns, pulled at both ends or held at one, below it as well as over it; within the capstan limit or not"""
    radius, n = m.length/m.between(1, 6), m.count(8, 60)
    angle = 0.9*min(m.length/radius, 6.0)
    m.cylinder("drum", [0, 0, 0], [0, 1, 0], radius, "two" if m.chance(0.3) else None)
    friction = m.obstacles["drum"]["friction"]
    mu, length = friction["axial"] if isinstance(friction, dict) else friction, 2*radius*math.sin(angle/2/n)*n
    arc = {"arc": {"from": [-radius, 0, 0], "centre": [0, 0, 0], "axis": [0, m.random.choice((-1.0, 1.0)), 0]}}
    ratio = math.exp(m.between(-0.85, 0.85)*mu*math.pi) if m.chance(0.75) else m.decade(-1, 1)
    m.line("a", length, arc, elements=n, weight=m.force/length*m.decade(-3, 0.3) if m.chance(0.7) else 0.0,
           A={"force": [0, 0, -m.force]} if m.chance(0.6) else "held", B={"force": [0, 0, -m.force*ratio]})
    for i in range(m.count(1, 4)):
        entry = {"name": f"s{i}", "steps": m.count(1, 5)}
        if m.chance(0.7):
            entry["drum.turn"] = m.between(-120, 120)
        if m.chance(0.3):
            entry["a.B"] = {"force": [0, 0, -m.force*math.exp(m.between(-0.8, 0.8)*mu*math.pi)]}
        m.history.append(entry)


def pegs(m):
    """a line over and under pegs in a row, which turn"""
    n, radius = m.count(2, 4), m.length*m.between(0.02, 0.08)
    for i in range(n):
        m.cylinder(f"c{i}", [0.8*m.length/(n + 1)*(i + 1), 0, (-1)**i*radius*m.between(1, 1.4)], [0, 1, 0], radius)
    m.line("a", m.length, {"straight": {"from": [0.0, 0.0, 0.0], "to": [m.length, 0.0, 0.0]}}, elements=m.count(20, 120),
           B="held" if m.chance(0.5) else {"force": [m.force, 0, 0]}, weight=0.0 if m.chance(0.4) else m.force/m.length)
    for i in range(m.count(1, 4)):
        entry = {"name": f"s{i}", "steps": m.count(1, 5)}
        if m.chance(0.6):
            entry["a.B"] = {"force": [m.force*m.decade(-1, 1), m.force*m.between(-0.3, 0.3), m.force*m.between(-1, 1)]}
        entry.update({f"c{k}.turn": m.between(-90, 90) for k in range(n) if m.chance(0.4)})
        m.history.append(entry)


def zones(m):
    """friction zones along the line, smooth ones too"""
    m.plane("bed", normal=m.tilted(0.3), kind="two" if m.chance(0.3) else None)
    m.pipe_on_bed(0.3)
    line, at, found = m.rope("a", m.length), 0.0, []
    while at < 0.9:
        start = at + m.between(0, 0.3)
        at = min(1.0, start + m.between(0.01, 0.4))
        if start >= 1 or at <= start:
            break
        found.append({"from": start*m.length, "to": at*m.length, "factor": 0 if m.chance(0.2) else m.decade(-1, 1)})
    if found:
        line["friction_zones"] = found
    m.happen()


def directed(m, kind):
    where = m.count(0, 3)
    if where <= 1:
        m.plane("bed", normal=m.tilted(0.4) if m.chance(0.5) else UP, kind=kind)
    if where == 1:
        m.pipe_on_bed(1, kind)
    if where == 2:
        m.cylinder("c", [0, 0, -0.3*m.length], [m.between(-0.3, 0.3), 1, 0], 0.3*m.length, kind)
    if where == 3:
        m.ball("b", [0, 0, -0.5*m.length], 0.5*m.length, kind)
    m.rope("a", m.length, elements=m.count(5, 50))
    m.happen(steps=(1, 5), high=0.3)


def two_coefficients(m):
    """along and across the line or a grain, on planes, pipes and hills"""
    directed(m, "two")


def sets(m):
    """friction given as sets of forces"""
    directed(m, "set")


def both_ends(m):
    """both ends pulled, moved and put, in many entries"""
    m.plane("bed", normal=m.tilted(0.2))
    m.rope("a", m.length)
    m.happen(entries=m.count(3, 8), ends="AB", pulled=0.45, moved=0.2)


def graded(m):
    """elements from fine to coarse, or of any length, up to six decades"""
    m.plane("bed")
    m.pipe_on_bed(0.3)
    n, span = m.count(2, 60), m.between(0, 6)
    parts = [10**m.between(-span, 0) for _ in range(n)] if m.chance(0.5) else [10**(-span*(1 - i/(n - 1))) for i in range(n)]
    m.rope("a", m.length, elements=[m.length*p/sum(parts) for p in parts])
    m.happen()


def fine(m):
    """hundreds or thousands of elements"""
    m.plane("bed", kind="two" if m.chance(0.3) else None)
    m.pipe_on_bed(0.5)
    m.rope("a", m.length, elements=int(m.decade(2, 3.3)))
    m.happen(entries=2, steps=(1, 2))


def many_steps(m):
    """to and fro for fifty steps"""
    m.plane("bed", normal=m.tilted(0.1), kind="two" if m.chance(0.3) else None)
    m.pipe_on_bed(0.4)
    m.rope("a", m.length, elements=m.count(5, 40))
    n, pulls = m.count(5, 10), (m.pull(-1, 0.3), m.pull(-1, 0.3))
    for i in range(n):
        to = {"force": times(1 if m.chance(0.7) else m.between(0.5, 1.5), pulls[i % 2])} if m.chance(0.8) else {"position": m.place("a")}
        m.history.append({"name": f"s{i}", "steps": 50//n, "a.B": to})


def any_size(m):
    m.plane("bed", normal=m.tilted(0.2))
    m.pipe_on_bed(0.33)
    m.ball_on_bed(0.33)
    m.rope("a", m.length)
    m.happen()


def tiny(m):
    """millimetres and micronewtons"""
    m.length, m.force = m.decade(-3, -1), m.decade(-6, -3)
    any_size(m)


def huge(m):
    """kilometres and giganewtons"""
    m.length, m.force = m.decade(2, 4), m.decade(4, 9)
    any_size(m)


def other_gravity(m):
    """none, sideways, or upwards"""
    m.plane("bed")
    m.pipe_on_bed(0.4)
    line, kind = m.rope("a", m.length), m.count(0, 2)
    if kind == 0:
        m.gravity, line["mass"] = [0, 0, 0], line.pop("weight")
    else:
        m.gravity = m.normal(9.81) if kind == 1 else [0, 0, 9.81]
    m.happen()


def massless(m):
    """lines without weight"""
    kind = m.count(0, 2)
    if kind != 1:
        m.plane("bed")
    m.pipe_on_bed(kind >= 1)
    m.rope("a", m.length, weight=0.0)
    m.happen()


def jumps(m):
    """large changes of load in single steps"""
    m.plane("bed", normal=m.tilted(0.2))
    m.pipe_on_bed(0.33)
    m.ball_on_bed(0.33)
    m.rope("a", m.length)
    m.happen(entries=m.count(2, 5), steps=(1, 1), low=0, high=3, pulled=0.5)


def path_tolerance(m):
    """steps that are cut until the path is accurate"""
    m.plane("bed", normal=m.tilted(0.2), kind="two" if m.chance(0.3) else None)
    m.pipe_on_bed(0.4)
    m.rope("a", m.length, elements=m.count(5, 30))
    m.happen(entries=m.count(1, 3), steps=(1, 2), high=0.3)
    m.more["solver"] = {"path_tolerance": m.decade(-4, -1.5), "halvings": m.count(3, 8)}


def strict(m):
    """contact of what touches at the reference alone"""
    m.plane("bed", normal=m.tilted(0.3), kind="two" if m.chance(0.2) else None)
    m.pipe_on_bed(0.3)
    m.more["contact_policy"] = "reference"
    m.rope("a", m.length)
    m.happen()


def frozen(m):
    """frozen friction of all kinds, on curved ground"""
    m.friction, where = "frozen", m.count(0, 2)
    if where != 1:
        m.plane("bed", kind="set" if m.chance(0.2) else "two" if m.chance(0.3) else None)
    m.pipe_on_bed(where >= 1)
    m.ball_on_bed(0.3)
    m.rope("a", m.length)
    m.happen(steps=(1, 5), high=0.3)


def several(m):
    """two to six lines"""
    m.plane("bed", normal=m.tilted(0.2))
    m.pipe_on_bed(0.4)
    for i in range(m.count(2, 6)):
        m.rope(f"l{i}", m.length*m.between(0.3, 1), elements=m.count(2, 25))
    m.happen(entries=m.count(1, 3))


def into_obstacles(m):
    """an end sent into an obstacle: to be refused"""
    m.plane("bed")
    centre, radius, kind = [m.between(0.3, 0.6)*m.length, 0, 0], m.length*m.between(0.05, 0.2), m.count(0, 2)
    if kind == 1:
        m.cylinder("c", centre, [0, 1, 0], radius)
    if kind == 2:
        m.ball("b", centre, radius)
    m.rope("a", m.length)
    x = m.place("a")
    inside = [x[0], x[1], -m.length*m.decade(-6, -1)] if kind == 0 else add(centre, times(radius*m.between(0, 0.9), UP))
    m.history.append({"name": "in", "steps": m.count(1, 4), "a.B": {"position": inside}})


def limits(m):
    """what cannot be: a pipe too thick to be crossed, both ends free, ends too far apart, unequal weights over a peg, a jam between planes"""
    kind, length = m.count(0, 5), m.length
    if kind == 0:
        r = length*m.between(0.1, 0.3)
        m.cylinder("c", [0, 0, 0], [0, 1, 0], r)
        path = 2*(math.sqrt((0.45*length)**2 - r*r) + r*math.asin(r/(0.45*length)))
        m.line("a", max(path*m.between(0.97, 1), 0.9001*length), "static", elements=m.count(10, 60), inextensible=True,
               A={"held": [-0.45*length, 0, r]}, B={"held": [0.441*length, 0, r]})
        m.history.append({"name": "down", "steps": m.count(1, 6), "a.A": {"position": [-0.45*length, 0, 0]}, "a.B": {"position": [0.45*length, 0, 0]}})
    elif kind in (1, 2):
        if kind == 1:
            m.plane("bed", normal=m.tilted(0.5))
        m.line("a", length, m.straight(length), A="free")
        m.happen(pulled=1.0, ends="AB")
    elif kind == 3:
        m.plane("bed")
        m.rope("a", length, inextensible=True)
        x = m.place("a", 0.11)
        m.history.append({"name": "far", "steps": m.count(1, 5), "a.B": {"position": add(x, UP, length*(1 + m.decade(-12, 0.3)))}})
    elif kind == 4:
        m.cylinder("c", [0, 0, 0], [0, 1, 0], 0.1*length)
        m.line("a", length, m.straight(length, [-length*m.between(0.3, 0.7), 0, 0], 0.0), elements=m.count(20, 60),
               A={"force": [0, 0, -m.force*m.decade(-1, 1)]}, B={"force": [0, 0, -m.force*m.decade(-1, 1)]},
               weight=0.0 if m.chance(0.5) else m.force/length)
        m.history.append({"name": "x", "steps": m.count(1, 4), "a.B": {"force": [0, 0, -m.force*m.decade(-1, 1)]}})
    else:
        m.plane("left", normal=[1, 0, m.between(0.1, 2)])
        m.plane("right", normal=[-1, 0, m.between(0.1, 2)])
        m.line("a", length, m.straight(length, heading=math.pi/2), A="free")
        m.happen(pulled=1.0)


def wedge(m):
    """a groove between two planes, closed by a third now and then"""
    a, b = m.between(0.1, 1.4), m.between(0.1, 1.4)
    m.plane("left", normal=[math.cos(a), 0, math.sin(a)])
    m.plane("right", normal=[-math.cos(b), 0, math.sin(b)])
    if m.chance(0.3):
        m.plane("end", [0, 0.3*m.length, 0], [0, -1, m.between(-0.2, 1)])
    if m.chance(0.5):
        m.line("a", m.length, m.straight(m.length, heading=math.pi/2 if m.chance(0.8) else m.between(1.4, 1.7)))
    else:
        m.rope("a", m.length)
    m.happen(steps=(1, 4))


def coarse(m):
    """thin posts and pipes, elements longer than they are thick"""
    m.plane("bed")
    for i in range(m.count(1, 3)):
        m.cylinder(f"c{i}", [m.between(0.2, 0.8)*m.length, m.between(-0.1, 0.3)*m.length, 0], [0, 0, 1] if m.chance(0.7) else [0, 1, 0],
                   m.length*m.decade(-3, -1))
    m.line("a", m.length, m.straight(m.length, heading=m.between(-0.1, 0.1)), elements=m.count(2, 20))
    m.happen(pulled=0.5, steps=(1, 4), high=1)


def rough(m):
    """coefficients from 1 to 5, steep planes, walls"""
    m.plane("bed", normal=m.tilted(1.4))
    if m.chance(0.6):
        m.plane("wall", normal=[m.between(-1, 1), m.between(-1, 1), m.between(-0.2, 1)])
    m.pipe_on_bed(0.3)
    for obstacle in m.obstacles.values():
        obstacle["friction"] = m.between(1, 5)
    m.rope("a", m.length)
    m.happen(steps=(1, 4))


CLASSES = (slope, planes, pipes, balls, drum, pegs, zones, two_coefficients, sets, both_ends, graded, fine, many_steps, tiny, huge, other_gravity,
           massless, jumps, path_tolerance, strict, frozen, several, into_obstacles, limits, wedge, coarse, rough)


def scene(make, seed):
    maker = Maker(make.__name__, seed)
    make(maker)
    return maker.scene()
