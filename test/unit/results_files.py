# SPDX-License-Identifier: BSD-3-Clause
"""Read directories of results with independent readers: json, csv, an XML parser, and the layout of VTK's appended
data. Arguments: the directories. A directory named *infeasible must hold a proof."""
import csv, json, math, os, re, struct, sys, zlib
import xml.etree.ElementTree as tree

STEP_KEYS = {"name", "outcome", "iterations", "energy", "tension_bound_rms_N", "tension_estimate_N",
             "force_residual_N", "largest_force_N", "law_residual_J", "contact_residual_N", "contact_residual_J",
             "friction_residual_N", "element_push_N", "elongation_residual", "stretch_residual", "penetration_m", "element_penetration_m", "dissipated_J", "substeps", "jumps", "jump_m", "unaccounted_J", "ledger_J",
             "wall_s", "lines"}
LINE_KEYS = {"outcome", "iterations", "places_not_unique", "grounded_m", "slipping_m", "slack_m", "sweep_m", "dissipated_J", "tension_mesh_estimate_N", "A", "B"}
POINT_DATA = {"tension_N", "contact_force_N", "friction_state", "displacement_m"}
SIZE = {"Float64": 8, "Int64": 8, "Int32": 4, "UInt8": 1}


def no_constant(name):
    raise ValueError(name + " is not JSON")


def check_summary(directory):
    with open(os.path.join(directory, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file, parse_constant=no_constant)
    assert set(summary) == {"capstan", "title", "outcome", "wall_s", "extremes", "steps", "files"}, set(summary)
    listed = {entry["name"]: (entry["bytes"], entry["crc32"]) for entry in summary["files"]}
    for name, entry in listed.items():
        with open(os.path.join(directory, name), "rb") as file:
            data = file.read()
        assert entry == (len(data), f"{zlib.crc32(data):08x}"), name
    assert set(listed) == set(os.listdir(directory)) - {".capstan", "summary.json"}
    for step in summary["steps"]:
        assert set(step) == STEP_KEYS, set(step) ^ STEP_KEYS
        ledger = step["ledger_J"]
        assert set(ledger) == {"ends", "obstacles", "elastic", "gravity", "dissipated", "imbalance"}, ledger
        spent = ledger["elastic"] + ledger["gravity"] + ledger["dissipated"] + ledger["imbalance"]
        # sums of a few numbers of this size, rounded
        assert abs(ledger["ends"] + ledger["obstacles"] - spent) <= 1e-12 * sum(abs(x) for x in ledger.values()), ledger
        assert set(step["energy"]) == {"primal_J", "dual_J", "gap_J", "scale_J"}
        for name, line in step["lines"].items():
            assert set(line) - {"proof", "bend"} == LINE_KEYS, set(line)
            assert set(line["A"]) == {"position_m", "force_N", "tension_N", "uplift_N", "angle_rad", "suspended_m", "touchdown_m", "tension_range_N"} and len(line["B"]["force_N"]) == 3
            assert name in step["tension_bound_rms_N"]
    assert "\x1b[31m" in summary["title"] and "</title>" in summary["title"], summary["title"]
    if directory.endswith("infeasible"):
        last = summary["steps"][-1]["lines"]["mooring-2"]
        assert summary["outcome"] == last["outcome"] == "infeasible"
        assert abs(sum(x * x for x in last["proof"]["direction"]) - 1) < 1e-12  # a unit vector, rounded
        assert last["proof"]["excess_m"] > 0
    return summary


def check_history(directory, summary):
    with open(os.path.join(directory, "history.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    names, units, rows = rows[0], rows[1], rows[2:]
    assert len(rows) == len(summary["steps"]) and len(set(names)) == len(names) == len(units)
    assert all(unit in ("", "1", "s", "m", "N", "J", "rad") for unit in units), units
    for row, step in zip(rows, summary["steps"]):
        assert len(row) == len(names)
        value = dict(zip(names, row))
        assert float(value["gravity"]) == step["ledger_J"]["gravity"] and int(value["substeps"]) == step["substeps"]
        assert value["outcome"] == step["outcome"] and float(value["gap"]) == step["energy"]["gap_J"]
        assert not value["name"].startswith("="), "a formula"
        for name, line in step["lines"].items():
            assert float(value[name + ".B.fx"]) == line["B"]["force_N"][0]
            assert float(value[name + ".grounded"]) == line["grounded_m"]


def check_loop(directory):
    """The printed work against the trapezoidal sum of force and displacement in history.csv: no step is cut."""
    with open(os.path.join(directory, "loop-surge.svg"), encoding="utf-8") as file:
        printed, unit = re.search(r"at this end: ([-0-9.e+]+) (k?)J", file.read()).groups()
    with open(os.path.join(directory, "history.csv"), encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    column = {name: i for i, name in enumerate(rows[0])}
    force = [float(row[column["mooring-2.B.fx"]]) for row in rows[3:]]
    place = [float(row[column["mooring-2.B.x"]]) for row in rows[3:]]
    work = sum((force[i] + force[i - 1]) / 2 * (place[i] - place[i - 1]) for i in range(1, len(force)))
    found = float(printed) * (1000 if unit else 1)
    assert abs(found - work) <= 1e-3 * abs(work), (found, work)  # four digits are printed
    assert work > 0


def check_vtp(path, lines):
    """Sizes and offsets of the blocks against the header, and the polylines."""
    with open(path, "rb") as file:
        data = file.read()
    begin = data.index(b"<AppendedData encoding=\"raw\">")
    mark = data.index(b"_", begin)
    root = tree.fromstring(data[:begin] + b"</VTKFile>")
    order = {"LittleEndian": "<", "BigEndian": ">"}[root.get("byte_order")]
    assert root.get("type") == "PolyData" and root.get("header_type") == "UInt64"
    piece = root.find("PolyData/Piece")
    points, cells = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfLines"))
    assert cells == lines and {a.get("Name") for a in piece.find("PointData")} == POINT_DATA
    end, block = mark + 1, {}
    for section, count in (("Points", points), ("Lines", None), ("PointData", points), ("CellData", cells)):
        for array in piece.find(section):
            count_here = {"connectivity": points, "offsets": cells}.get(array.get("Name"), count)
            at = mark + 1 + int(array.get("offset"))
            assert at == end, "blocks lie end to end"
            size = struct.unpack_from(order + "Q", data, at)[0]
            assert size == count_here * SIZE[array.get("type")] * int(array.get("NumberOfComponents"))
            block[array.get("Name")] = data[at + 8:at + 8 + size]
            end = at + 8 + size
    assert data[end:].strip().startswith(b"</AppendedData>")
    assert struct.unpack(order + "%dq" % points, block["connectivity"]) == tuple(range(points))
    assert struct.unpack(order + "%dq" % cells, block["offsets"])[-1] == points
    assert set(block["friction_state"]) <= {0, 1, 2}


def check_obstacles(path, turned):
    """The mesh: the bed is flat, its cells are quadrilaterals of points that exist, and a drum is round. Its first point is
    where a turn of the drum about y by the right-hand rule has taken it: z towards x."""
    piece = tree.parse(path).getroot().find("PolyData/Piece")
    array = {a.get("Name"): a.text.split() for a in piece.iter("DataArray")}
    points = [float(x) for x in array["Points"]]
    count, cells = int(piece.get("NumberOfPoints")), int(piece.get("NumberOfPolys"))
    corners = [int(i) for i in array["connectivity"]]
    assert len(points) == 3 * count and len(corners) == 4 * cells and set(corners) == set(range(count))
    assert [int(i) for i in array["offsets"]] == list(range(4, 4 * cells + 1, 4))
    assert len(array["obstacle_id"]) == cells == len(array["sector"])
    drum = [(obstacle, sector) for obstacle, sector in zip(array["obstacle_id"], array["sector"]) if obstacle == "1"]
    assert not drum or len(set(drum)) == 8 and drum.count(("1", "0")) == len(drum) // 8
    for corner in corners[:4]:
        assert points[3 * corner + 2] == 0  # the bed z = 0 comes first
    for corner in corners[4:]:
        x, _, z = points[3 * corner:3 * corner + 3]
        assert abs((x * x + (z - 30) ** 2) ** 0.5 - 2) < 1e-9, (x, z)  # twelve digits are printed
    if drum:
        x, _, z = points[12:15]
        assert abs(x - 2 * math.cos(turned)) < 1e-9 and abs(z - 30 + 2 * math.sin(turned)) < 1e-9, (path, x, z)


def check_directory(directory):
    files = sorted(os.listdir(directory))
    assert not [f for f in files if f.startswith(".") and f != ".capstan" or f.endswith(".part")], files
    summary = check_summary(directory)
    check_history(directory, summary)
    steps = len(summary["steps"])
    vtp = [f for f in files if f.endswith(".vtp") and not f.endswith("obstacles.vtp")]
    assert vtp == ["step-%05d.vtp" % i for i in range(steps)], vtp
    for name in vtp:
        check_vtp(os.path.join(directory, name), len(summary["steps"][0]["lines"]))
    listed = [d.get("file") for d in tree.parse(os.path.join(directory, "result.pvd")).iter("DataSet")]
    # a drum turns by -0.75 rad in each of the steps 2 to 5
    turns = range(2, 6) if directory.endswith("obstacles") else range(0)
    surfaces = ["step-%05d-obstacles.vtp" % min(i, turns[-1]) if turns and i >= turns[0] else "obstacles.vtp" for i in range(steps)]
    assert listed == [name for pair in zip(vtp, surfaces) for name in pair], listed
    assert [f for f in files if f.endswith("obstacles.vtp")] == sorted(set(surfaces)), files
    check_obstacles(os.path.join(directory, "obstacles.vtp"), 0)
    for i in turns:
        check_obstacles(os.path.join(directory, "step-%05d-obstacles.vtp" % i), -0.75 * (i - 1))
    for name in [f for f in files if f.endswith(".svg")]:
        root = tree.parse(os.path.join(directory, name)).getroot()
        assert root.tag == "{http://www.w3.org/2000/svg}svg"
        assert not [e for e in root.iter() if e.tag.endswith("script")], "text became an element"
        with open(os.path.join(directory, name), encoding="utf-8") as file:
            assert not re.search(r"\b(nan|inf)\b|href|url\((?!#)", file.read()), name
    for name in ("plan.svg", "elevation.svg", "tension.svg", "history.svg", "step-00000-plan.svg", "step-00000-elevation.svg"):
        assert name in files, name
    if not directory.endswith("infeasible"):
        check_loop(directory)
    if directory.endswith("obstacles"):  # the drum is seen from its end; -3 rad at the end of the second stage
        with open(os.path.join(directory, "step-00005-elevation.svg"), encoding="utf-8") as file:
            picture = file.read()
        assert picture.count("<ellipse") == 1 and "turned -171.9" in picture
        with open(os.path.join(directory, "step-00005-plan.svg"), encoding="utf-8") as file:
            assert "<ellipse" not in file.read()  # from above it is a band
    print("%s: %d steps, %d files" % (directory, steps, len(files)))


for argument in sys.argv[1:]:
    if os.path.isdir(argument):
        check_directory(argument)
    else:
        assert argument.endswith("locale"), argument + " is missing"  # no such locale on this machine
