#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Random histories on obstacles that give, each checked by the independent checker.

usage: random_soft.py CAPSTAN CHECKER [--count N] [--seed S] [--only CLASS] [--keep FOLDER]

Of each class N scenes. The shapes and grounds are those of random_shapes.py and random_grounds.py, given a stiffness; `beds` are planes, level
or sloping, one or two of which one may be rigid, with a drum or a boulder now and then, on which lines lie or hang and are pulled, moved, let
go, grasped and shifted; `points` are such beds on which lines meet at one to three free points, clumps, knots and buoys, that are pulled
along, lifted off, let down, held, moved and let go; `moving` and `moving round` are such beds and shapes with steps in time, on which obstacles may be damped; `moored` is a
float in waves on lines that lie on such a bed, damped or not, some with a clump. By its weight a line sinks by 1e-4 to 0.03 of its size. Of each class at least 99 of 100 steps must be certified, and
the checker must refute none; of `moored` 995 of 1000.
"""
import math
import os
import random
import re
import sys

sys.dont_write_bytecode = True  # nothing is left in the source folder
import checked  # noqa: E402
import random_grounds  # noqa: E402
import random_in_time  # noqa: E402
import random_shapes  # noqa: E402


STEPS = 16
FINER, STIFFER = 10, 30  # times as many steps in time, times as stiff
CERTIFIED = 0.99
MOORED = 0.995  # of the class of that name
CLASSES = ["beds", "points", "grounds", "moving", "moving round", "moored"] + random_shapes.CLASSES


def vector(values):
    return "[" + ", ".join(repr(float(v)) for v in values) + "]"


def sinks(dice):
    """[-] by which a line sinks under its weight, per its size"""
    return 10 ** dice.uniform(-4, -1.5)


def beds(dice, folder):
    size, weight, width = 10 ** dice.uniform(-1, 2), 10 ** dice.uniform(0, 3), 10 ** dice.uniform(-3, 0)
    far = [dice.uniform(-1, 1) * 1e4 * size * (dice.random() < 0.15) for _ in range(3)]
    at = lambda x: vector([far[k] + size * x[k] for k in range(3)])  # noqa: E731
    friction = lambda: dice.choice([repr(dice.uniform(0, 1)), "0", f"{{axial: {dice.uniform(0, 1)!r}, lateral: {dice.uniform(0, 1)!r}}}"])  # noqa: E731
    gives = lambda: repr(weight / (size * width * sinks(dice)))  # noqa: E731
    slope = [dice.uniform(-0.2, 0.2), dice.uniform(-0.2, 0.2), 1] if dice.random() < 0.5 else [0, 0, 1]
    obstacles = {"bed": f"plane: {{point: {at([0, 0, 0])}, normal: {vector(slope)}}}, friction: {friction()}, stiffness: {gives()}"}
    if dice.random() < 0.3:
        stiff = f", stiffness: {gives()}" if dice.random() < 0.5 else ""
        obstacles["bank"] = f"plane: {{point: {at([-0.2, 0, 0])}, normal: [1, 0, {dice.uniform(0.5, 1)!r}]}}, friction: {friction()}{stiff}"
    if dice.random() < 0.3:
        round_one = dice.choice([f"sphere: {{centre: {at([0.5, 0.05, 0])}, radius: {0.12 * size!r}}}",
                                 f"cylinder: {{point: {at([0.5, 0, -0.02])}, axis: [{dice.uniform(-0.3, 0.3)!r}, 1, 0], radius: {0.1 * size!r}}}"])
        obstacles["lump"] = f"{round_one}, friction: {friction()}, stiffness: {gives()}"
    shifted = dice.random() < 0.2
    lies = dice.random() < 0.6 and len(obstacles) == 1
    elements = dice.randint(10, 80)
    stiffness = ".inf" if dice.random() < 0.3 else repr(weight * size * 10 ** dice.uniform(1.5, 5))
    normal = [s / sum(c * c for c in slope) ** 0.5 for s in slope]
    along = [normal[2], 0, -normal[0]]
    long = sum(c * c for c in along) ** 0.5
    end = [c / long for c in along]
    if lies:
        start, ends = f"{{straight: {{from: {at([0, 0, 0])}, to: {at(end)}}}}}", f"A: {{held: {at([0, 0, 0])}}}, B: {{force: [0, 0, 0]}}"
    else:
        ends = f"A: {{held: {at([0, 0, 0.1])}}}, B: {{held: {at([0.85, dice.uniform(-0.1, 0.1), 0.3])}}}"
        start = "static"
    entries = []
    grasped = dice.random() < 0.2
    for k in range(4):
        what = dice.random()
        if lies and what < 0.6:
            pull = [dice.uniform(-1, 2), dice.uniform(-0.5, 0.5), dice.uniform(-0.1, 0.8)]
            change = f"line.B: {{force: {vector([weight * size * p for p in pull])}}}" if what < 0.45 else "line.B: {force: [0, 0, 0]}"
        else:
            change = f"line.B: {{position: {at([dice.uniform(0.7, 0.9), dice.uniform(-0.3, 0.3), dice.uniform(0.02, 0.3)])}}}"
        if grasped and k == 1:
            change += f", line.node: {{at: {size / 2!r}, force: {vector([0, 0, 0.3 * weight * size])}}}"
        if grasped and k == 2:
            change += f", line.node: {{at: {size / 2!r}, release: true}}"
        if shifted:
            change += f", bed.obstacle: {{move: {vector([dice.uniform(-0.02, 0.02) * size for _ in range(3)])}}}"
        if "lump" in obstacles and dice.random() < 0.4:
            change += f", lump.turn: {dice.uniform(-40, 40)!r}"
        entries.append(f"  - {{name: stage{k}, steps: {STEPS // 4}, {change}}}\n")
    text = "capstan: 1\nobstacles:\n" + "".join(f"  {name}: {{{o}}}\n" for name, o in obstacles.items())
    text += f"lines:\n  line:\n    length: {size!r}\n    elements: {elements}\n    weight: {weight!r}\n    bearing_width: {width!r}\n    stiffness: {stiffness}\n"
    text += f"    start: {start}\n    ends: {{{ends}}}\nhistory:\n{''.join(entries)}"
    return write(folder, text)


def points(dice, folder):
    size, weight, width = 10 ** dice.uniform(-1, 2), 10 ** dice.uniform(0, 3), 10 ** dice.uniform(-3, 0)
    far = [dice.uniform(-1, 1) * 1e4 * size * (dice.random() < 0.15) for _ in range(3)]
    at = lambda x: vector([far[k] + size * x[k] for k in range(3)])  # noqa: E731
    friction = lambda: dice.choice([repr(dice.uniform(0, 1)), "0"])  # noqa: E731
    gives = lambda: repr(weight / (size * width * sinks(dice)))  # noqa: E731
    slope = [dice.uniform(-0.2, 0.2), dice.uniform(-0.2, 0.2), 1] if dice.random() < 0.4 else [0, 0, 1]
    pressure = weight / (size * width * sinks(dice))
    obstacles = {"bed": f"plane: {{point: {at([0, 0, 0])}, normal: {vector(slope)}}}, friction: {friction()}, stiffness: {pressure!r}"}
    if dice.random() < 0.25:
        round_one = dice.choice([f"sphere: {{centre: {at([0.3, 0.1, 0.05])}, radius: {0.2 * size!r}}}",
                                 f"cylinder: {{point: {at([0.3, 0, 0.02])}, axis: [{dice.uniform(-0.3, 0.3)!r}, 1, 0], radius: {0.2 * size!r}}}"])
        stiff = f", stiffness: {gives()}" if dice.random() < 0.7 else ""
        obstacles["lump"] = f"{round_one}, friction: {friction()}{stiff}"
    shifted = dice.random() < 0.2
    stiffness = ".inf" if dice.random() < 0.15 else repr(weight * size * 10 ** dice.uniform(1.5, 5))
    count = dice.choice([1, 1, 2, 3])
    place = [[0.7 * k + dice.uniform(-0.1, 0.1), dice.uniform(-0.1, 0.1), dice.uniform(0.05, 0.3)] for k in range(count)]
    if dice.random() < 0.4:
        place = [[x, y, -(slope[0] * x + slope[1] * y)] for x, y, _ in place]
    heavy, text_of_points = [], ""
    for k in range(count):
        kind = dice.random()
        load = weight * size * 10 ** dice.uniform(-1.5, 0.7) * (-1 if kind > 0.85 else kind > 0.25)
        heavy.append(load)
        area = abs(load) / (pressure * size * sinks(dice)) if dice.random() < 0.7 else 0
        text_of_points += f"  knot{k}: {{free: {at(place[k])}, weight: {load!r}" + (f", bearing_area: {area!r}" if area > 0 else "") + "}\n"
    lines, anchors = "", []

    def line(name, one, other, length):
        return (f"  {name}: {{length: {length!r}, elements: {dice.randint(6, 40)}, weight: {weight!r}, bearing_width: {width!r}, "
                f"stiffness: {stiffness}, start: static, ends: {{A: {one}, B: {other}}}}}\n")

    for k in range(count):
        turn = dice.uniform(0, 2 * math.pi)
        legs = dice.randint(1 if count > 1 else 2, 3)
        for leg in range(legs):
            angle = turn + 2 * math.pi * leg / legs + dice.uniform(-0.3, 0.3)
            long = dice.uniform(0.5, 1)
            foot = [place[k][0] + long * dice.uniform(0.6, 0.95) * math.cos(angle), place[k][1] + long * dice.uniform(0.6, 0.95) * math.sin(angle), 0]
            foot[2] = dice.choice([0.2, -0.005, 0]) * dice.random() - (slope[0] * foot[0] + slope[1] * foot[1])
            anchors.append((f"leg{k}{leg}", foot, long))
            lines += line(anchors[-1][0], f"{{held: {at(foot)}}}", f"{{point: knot{k}}}", long * size)
        if k > 0:
            apart = math.dist(place[k - 1], place[k])
            lines += line(f"between{k}", f"{{point: knot{k - 1}}}", f"{{point: knot{k}}}", apart * dice.uniform(1.02, 1.4) * size)
    if "lump" in obstacles and "stiffness" not in obstacles["lump"]:  # no end is held in a rigid one, nor put there
        wide = 0.35 if "sphere" in obstacles["lump"] else 0.5  # a cylinder goes on, and its axis slants
        if any(abs(x[0] - 0.3) < wide and ("cylinder" in obstacles["lump"] or abs(x[1] - 0.1) < wide) for x in place + [foot for _, foot, _ in anchors]):
            del obstacles["lump"]
    entries = ""
    for stage in range(4):
        changes = []
        for k in range(count):
            what = dice.random()
            unit = max(abs(heavy[k]), 0.2 * weight * size)
            if what < 0.3:
                changes.append(f"knot{k}.point: {{force: {vector([unit * dice.uniform(-1, 1), unit * dice.uniform(-1, 1), 0])}}}")
            elif what < 0.5:
                changes.append(f"knot{k}.point: {{force: {vector([unit * dice.uniform(-0.3, 0.3), unit * dice.uniform(-0.3, 0.3), unit * dice.uniform(0, 3)])}}}")
            elif what < 0.7:
                changes.append(f"knot{k}.point: {{force: [0, 0, 0]}}")
            elif what < 0.85 and stiffness != ".inf":
                x, y = (place[k][a] + dice.uniform(-0.03, 0.03) for a in range(2))
                changes.append(f"knot{k}.point: {{position: {at([x, y, dice.uniform(-0.01, 0.1) - (slope[0] * x + slope[1] * y)])}}}")
        if dice.random() < 0.4 and stiffness != ".inf":
            name, foot, long = dice.choice(anchors)
            changes.append(f"{name}.A: {{position: {at([foot[0] + 0.1 * long * dice.uniform(-1, 1), foot[1] + 0.1 * long * dice.uniform(-1, 1), foot[2] + 0.1 * long * dice.random()])}}}")
        if shifted:
            changes.append(f"bed.obstacle: {{move: {vector([dice.uniform(-0.02, 0.02) * size for _ in range(3)])}}}")
        if "lump" in obstacles and dice.random() < 0.4:
            changes.append(f"lump.turn: {dice.uniform(-40, 40)!r}")
        entries += f"  - {{name: stage{stage}, steps: {STEPS // 4}" + "".join(f", {c}" for c in changes) + "}\n"
    text = "capstan: 1\nobstacles:\n" + "".join(f"  {name}: {{{o}}}\n" for name, o in obstacles.items())
    return write(folder, text + f"points:\n{text_of_points}lines:\n{lines}history:\n{entries}")


def write(folder, text):
    path = os.path.join(folder, "scene.yaml")
    with open(path, "w", encoding="ascii") as out:
        out.write(text)
    return path


def softened(dice, folder, text):
    """a scene of rigid obstacles, which give; a boulder may stay rigid"""
    weight, size = (float(re.search(rf"^    {key}: (\S+)$", text, re.M).group(1)) for key in ("weight", "length"))
    width = 10 ** dice.uniform(-3, 0)
    text = text.replace("friction_policy: frozen\n", "")
    text = re.sub(r"^(    friction: .*)$", lambda m: f"{m.group(1)}\n    stiffness: {weight / (size * width * sinks(dice))!r}", text, flags=re.M)
    text = re.sub(r"^(    weight: .*)$", rf"\1\n    bearing_width: {width!r}", text, flags=re.M)
    return write(folder, text)


def moving(dice, folder, path):
    """a scene with mass, of which entries have a duration"""
    with open(path, encoding="ascii") as scene:
        text = scene.read()
    # inertia presses a line many times deeper than its weight, and it must not go through what is round
    text = re.sub(r"(?<=[ ,]stiffness: )([^,}\s]+)(?=[^\n]*\n(?:  \w|lines|    damp))", lambda m: repr(STIFFER * float(m.group(1))), text)
    weight, size = (float(re.search(rf"^    {key}: (\S+)$", text, re.M).group(1)) for key in ("weight", "length"))
    swing = math.sqrt(size / 9.81)
    time = lambda: swing * 10 ** dice.uniform(0.5, 1.5)  # noqa: E731
    text = re.sub(r"^(    weight: .*)$", rf"\1\n    inertia: {weight / 9.81!r}", text, flags=re.M)
    damped = lambda m: m.group(0) + (f", damping: {float(m.group(1)) * swing * 10 ** dice.uniform(-3, 0)!r}" if dice.random() < 0.5 else "")  # noqa: E731
    text = re.sub(r"(?<=friction: )(?:[^\n]*), stiffness: ([^,}\n]+)", damped, text)
    text = re.sub(r"(?<=\n)    stiffness: (\S+)(?=\n(?:  \w|lines))", lambda m: damped(m).replace(", damping", "\n    damping"), text)
    return write(folder, re.sub(r"steps: (\d+)", lambda m: f"steps: {FINER * int(m.group(1))}, duration: {time()!r}", text))


def write_scene(dice, folder, kind):
    if kind in ("beds", "points"):
        return (beds if kind == "beds" else points)(dice, folder)
    if kind == "moving":
        return moving(dice, folder, beds(dice, folder))
    if kind == "moving round":
        return moving(dice, folder, write_scene(dice, folder, dice.choice(random_shapes.CLASSES)))
    if kind == "moored":
        return write(folder, random_in_time.Scene(dice, kind).text())
    path = random_grounds.write_scene(dice, folder) if kind == "grounds" else random_shapes.write_scene(dice, folder, kind)
    with open(path, encoding="ascii") as scene:
        return softened(dice, folder, scene.read())


def one_class(given, kind):
    steps = certified = refuted = refused = 0
    for seed in checked.seeds(given, kind):
        folder = checked.folder_of(given, kind, seed)
        scene = write_scene(random.Random(f"soft {kind} {seed}"), folder, kind)
        out = os.path.join(folder, "out")
        found = checked.run(given.capstan, "run", scene, "-o", out, "--force", "--no-paraview")
        if not os.path.exists(os.path.join(out, "result.nc")) or found.returncode not in (0, 1, 5):
            refused += 1
            print(f"{kind} {seed}: {found.stderr.strip()[-300:]}")
            continue
        found, words = checked.check(given.checker, out, scene)
        steps += found[0]
        certified += found[1]
        refuted += found[3] + found[4]
        if found[1] < found[0] or found[3]:
            print(f"{kind} {seed}: {words}")
    print(f"{kind}: {given.count} scenes from seed {given.seed}, {steps} steps, {certified} certified, {refuted} refuted, {refused} refused", flush=True)
    return steps > 0 and certified >= (MOORED if kind == "moored" else CERTIFIED) * steps and refuted == 0 and refused == 0


if __name__ == "__main__":
    checked.main(CLASSES, one_class, 2)
