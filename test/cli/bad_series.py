#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bad CSV files of time series and of waves, and bad references to them: each must be refused with its exit code, its place and its message.

usage: bad_series.py CAPSTAN

Every case is one change to a good scene or to one of the good files beside it. Expected is the exit code and what follows the folder's name in
the message; standard error must be one line, and standard output empty.
"""
import os
import subprocess
import sys
import tempfile

from checks import is_told

INPUT, IO, LIMIT = 3, 4, 6
GOOD = {"scene.yaml": """\
capstan: 1
water_density: 1025
water_surface: 2
waves: {depth: 20, file: sea.csv}
bodies:
  hull: {held: [9, 0, 0]}
  buoy: {free: [30, 0, 0], mass: 200, moments_of_inertia: [9, 9, 9], radiation: kernel.csv}
points:
  eye: {body: hull, at: [0, 0, 0]}
  knot: {held: [0, 0, 0]}
  ring: {body: buoy, at: [0, 0, 0]}
lines:
  cable: {length: 9, elements: 4, mass: 1, stiffness: 1e6, start: {straight: {from: [0, 0, 0], to: [9, 0, 0]}}, drag: {diameter: 0.1, normal: 1}, ends: {A: {point: knot}, B: {point: eye}}}
  leash: {length: 9, elements: 4, mass: 1, stiffness: 1e6, start: {straight: {from: [21, 0, 0], to: [30, 0, 0]}}, ends: {A: held, B: {point: ring}}}
history:
  - {name: swing, duration: 2, time_step: 0.1, hull.body: {move: [0, 0, 0], series: hull.csv}, knot.point: {move: [0, 0, 0], series: knot.csv}, buoy.body: {force: [0, 0, 0], series: load.csv}, leash.A: {move: [0, 0, 0], series: knot.csv}}
""",
        "sea.csv": "amplitude,period,direction,phase\nm,s,degree,degree\n0.5,5,0,10\n0.2,3,40,0\n",
        "hull.csv": "time,x,ry\ns,m,deg\n0,0,0\n1,0.2,3\n2,0.1,-2\n",
        "knot.csv": "# east\ntime,x,y,z\n0,0,0,0\n1,0.1,0,0.2\n3,0,0,0\n",
        "kernel.csv": "time,k11,k15,k55\ns,N/m,N,N m\n0,9,1,8\n0.5,3,0,1\n1,0,0,0\n",
        "load.csv": "time,fx,mz\n-1,0,0\n4,900,20\n"}
HULL = "time, x (optional), y (optional), z (optional), rx (optional), ry (optional), rz (optional)"
KNOT = "time, x (optional), y (optional), z (optional)"
LOAD = "time, fx (optional), fy (optional), fz (optional), mx (optional), my (optional), mz (optional)"
KERNEL = "time, k11 (optional), k12 (optional) .. k66 (optional)"
SEA = "amplitude, period (optional), frequency (optional), direction, phase (optional)"
# name, file, what is replaced in it (empty: all), by what, exit code, expected after the folder
CHANGES = [
    ("no kernel file", "scene.yaml", "kernel.csv", "kernels.csv", IO, "kernels.csv: "),
    ("a kernel in numbers", "scene.yaml", "kernel.csv", "[[0, 1]]", INPUT, "scene.yaml:7:"),
    ("a kernel of another name", "kernel.csv", "k55", "k77", INPUT, f"kernel.csv:1:14: found the column 'k77', expected a line of names: {KERNEL}"),
    ("a kernel without time", "kernel.csv", "time", "k12", INPUT, f"kernel.csv:1:1: the column 'time' is missing, expected a line of names: {KERNEL}"),
    ("a kernel of times alone", "kernel.csv", "", "time\n0\n1\n", INPUT, "kernel.csv: found times alone, expected a column beside them"),
    ("a kernel of one row", "kernel.csv", "0.5,3,0,1\n1,0,0,0\n", "", INPUT, "kernel.csv: found one row, expected at least two"),
    ("a kernel at uneven times", "kernel.csv", "0.5,3", "0.6,3", INPUT, "scene.yaml:7:70: body 'buoy': radiation: row 2 is at 0.6 s, expected finite numbers, and times 0, g, 2 g, .. of one spacing, here 0.5 s"),
    ("a kernel that begins later", "kernel.csv", "0,9,1,8\n", "0.1,9,1,8\n", INPUT, "scene.yaml:7:70: body 'buoy': radiation: row 1 is at 0.1 s"),
    ("a kernel that ends at once", "kernel.csv", "0.5,3,0,1\n1,0,0,0\n", "0,1,1,1\n", INPUT, "scene.yaml:7:70: body 'buoy': radiation: the last row is at 0 s, expected a time > 0"),
    ("a kernel that drives", "kernel.csv", "0,9,1,8", "0,9,10,8", INPUT, "scene.yaml:7:70: body 'buoy': radiation: the kernel at 0 s would drive some motion: its symmetric part has a negative eigenvalue"),
    ("a negative kernel", "kernel.csv", "0,9,1,8", "0,-9,1,8", INPUT, "scene.yaml:7:70: body 'buoy': radiation: the kernel at 0 s would drive some motion"),
    ("NaN in a kernel", "kernel.csv", "0.5,3", "0.5,nan", INPUT, "kernel.csv:4:5: "),
    ("no such file", "scene.yaml", "series: hull.csv", "series: hul.csv", IO, "hul.csv: "),
    ("a file elsewhere", "scene.yaml", "series: hull.csv", "series: ../hull.csv", INPUT, "scene.yaml:16:77: 'series': found '../hull.csv', expected the name of a file beside this one, without '/'"),
    ("a series in numbers", "scene.yaml", "series: hull.csv", "series: [[0, 0], [1, 1]]", INPUT, "scene.yaml:16:77: 'series': found a list of 2"),
    ("a misspelt series", "scene.yaml", "series: hull.csv", "serie: hull.csv", INPUT, "scene.yaml:16:77: 'hull.body': unknown key 'serie'; did you mean 'series'?"),
    ("a series without time", "scene.yaml", "duration: 2, time_step: 0.1", "steps: 3", INPUT, "scene.yaml:16:175: stage 1: leash.A oscillates in time, but the stage has no duration"),
    ("a series of what is let go", "scene.yaml", "leash.A: {move: [0, 0, 0]", "leash.A: {release: true", INPUT, "scene.yaml:16:219: 'series': found beside 'release': what is let go is led nowhere"),
    ("a series that ends early", "scene.yaml", "duration: 2", "duration: 2.5", INPUT, "scene.yaml:16:50: stage 1: the series of hull.body goes from 0 s to 2 s, and the entry from 0 to 2.5 s: give a series that covers it"),
    ("an empty file", "hull.csv", "", "", INPUT, "hull.csv: found no row of numbers, expected some below a line of names"),
    ("names alone", "hull.csv", "s,m,deg\n0,0,0\n1,0.2,3\n2,0.1,-2\n", "", INPUT, "hull.csv: found no row of numbers, expected some below a line of names"),
    ("one row", "hull.csv", "1,0.2,3\n2,0.1,-2\n", "", INPUT, "hull.csv: found one row, expected at least two"),
    ("times alone", "hull.csv", "", "time\n0\n2\n", INPUT, "hull.csv: found times alone, expected a column beside them"),
    ("no names", "hull.csv", "time,x,ry\ns,m,deg\n", "", INPUT, f"hull.csv:1:1: found the column '0', expected a line of names: {HULL}"),
    ("no time", "hull.csv", "time,x,ry\ns,m,deg\n", "x,y,z\n", INPUT, f"hull.csv:1:1: the column 'time' is missing, expected a line of names: {HULL}"),
    ("another column", "hull.csv", "time,x,ry", "time,x,pitch", INPUT, f"hull.csv:1:8: found the column 'pitch', expected a line of names: {HULL}"),
    ("a load on what is held", "hull.csv", "time,x,ry", "time,fx,ry", INPUT, f"hull.csv:1:6: found the column 'fx', expected a line of names: {HULL}"),
    ("a place of what is loaded", "load.csv", "time,fx,mz", "time,x,mz", INPUT, f"load.csv:1:6: found the column 'x', expected a line of names: {LOAD}"),
    ("a rotation of a point", "knot.csv", "time,x,y,z", "time,x,y,rz", INPUT, f"knot.csv:2:10: found the column 'rz', expected a line of names: {KNOT}"),
    ("a column twice", "hull.csv", "time,x,ry", "time,x,x", INPUT, "hull.csv:1:8: the column 'x' is given twice"),
    ("another unit", "hull.csv", "s,m,deg", "s,ft,deg", INPUT, "hull.csv:2:3: the unit of x: found 'ft', expected m, or numbers"),
    ("units again", "hull.csv", "1,0.2,3", "s,m,deg", INPUT, "hull.csv:4:1: time: found 's', expected a number in s"),
    ("a short row", "hull.csv", "1,0.2,3", "1,0.2", INPUT, "hull.csv:4:1: found 2 cells, expected 3 as in the line of names"),
    ("a long row", "hull.csv", "1,0.2,3", "1,0.2,3,4", INPUT, "hull.csv:4:1: found more than 3 cells, expected 3 as in the line of names"),
    ("NaN", "hull.csv", "1,0.2,3", "1,nan,3", INPUT, "hull.csv:4:3: x: found 'nan', expected a number in m"),
    ("NaN as YAML has it", "hull.csv", "1,0.2,3", "1,.nan,3", INPUT, "hull.csv:4:3: x: found '.nan', expected a number in m"),
    ("an infinite number", "hull.csv", "1,0.2,3", "1,0.2,inf", INPUT, "hull.csv:4:7: ry: found 'inf', expected a number in deg"),
    ("a number beyond all", "hull.csv", "1,0.2,3", "1,1e200,3", INPUT, "hull.csv:4:3: x: found '1e200', expected a number in m"),
    ("an empty cell", "hull.csv", "1,0.2,3", "1,,3", INPUT, "hull.csv:4:3: x: found '', expected a number in m"),
    ("a word", "knot.csv", "1,0.1,0,0.2", "1,0.1, up,0.2", INPUT, "knot.csv:4:8: y: found 'up', expected a number in m"),
    ("a decimal comma", "hull.csv", "1,0.2,3", "1;0,2;3", INPUT, "hull.csv:4:1: found 2 cells, expected 3"),
    ("a zero byte", "hull.csv", "1,0.2,3", "1,0.2\0,3", INPUT, "hull.csv: found a zero byte: is this text?"),
    ("times out of order", "hull.csv", "1,0.2,3", "3,0.2,3", INPUT, "hull.csv:5:1: time: found 2 s after 3 s, expected times that increase"),
    ("a time twice", "hull.csv", "1,0.2,3", "0,0.2,3", INPUT, "hull.csv:4:1: time: found 0 s after 0 s, expected times that increase"),
    ("a series that begins late", "hull.csv", "0,0,0", "0.5,0,0", INPUT, "scene.yaml:16:48: stage 1: the series of hull.body goes from 0.5 s to 2 s, and the entry from 0 to 2 s: give a series that covers it"),
    ("a place that jumps", "knot.csv", "0,0,0,0\n1", "0,0,0,0.3\n1", INPUT, "scene.yaml:16:194: stage 1: the series of leash.A begins with (0, 0, 0.3), and a place does not jump: let it begin with 0, and lead leash.A there in an entry before"),
    ("a rotation that jumps", "hull.csv", "0,0,0", "0,0,2", INPUT, "scene.yaml:16:48: stage 1: the series of hull.body begins with (0, 0, 0), and a place does not jump"),
    ("no such sea", "scene.yaml", "file: sea.csv", "file: see.csv", IO, "see.csv: "),
    ("a sea elsewhere", "scene.yaml", "file: sea.csv", "file: /sea.csv", INPUT, "scene.yaml:4:20: 'file': found '/sea.csv', expected the name of a file beside this one, without '/'"),
    ("a sea beside components", "scene.yaml", "file: sea.csv", "file: sea.csv, components: [{amplitude: 1, period: 9, direction: 0}]", INPUT, "scene.yaml:4:35: 'components': it does not go with 'file': leave one of them out"),
    ("a sea without amplitudes", "sea.csv", "amplitude,period,direction,phase\nm,s,", "phase,period,direction,frequency\ndegree,s,", INPUT, f"sea.csv:1:1: the column 'amplitude' is missing, expected a line of names: {SEA}"),
    ("a sea without directions", "sea.csv", "", "amplitude,period\n1,9\n", INPUT, f"sea.csv:1:1: the column 'direction' is missing, expected a line of names: {SEA}"),
    ("a sea without periods", "sea.csv", "", "amplitude,direction\n1,9\n", INPUT, "sea.csv:1:1: found neither, expected either the column period or the column frequency"),
    ("periods and frequencies", "sea.csv", "", "amplitude,direction,period,frequency\n1,9,5,0.2\n", INPUT, "sea.csv:1:1: found both, expected either the column period or the column frequency"),
    ("a negative period", "sea.csv", "0.2,3,40,0", "0.2,-3,40,0", INPUT, "sea.csv:4:1: period: found -3, expected a number in s, greater than 0"),
    ("an amplitude of 0", "sea.csv", "0.5,5,0,10", "0,5,0,10", INPUT, "sea.csv:3:1: amplitude: found 0, expected a number in m, greater than 0"),
    ("NaN in a sea", "sea.csv", "0.2,3,40,0", "0.2,3,nan,0", INPUT, "sea.csv:4:7: direction: found 'nan', expected a number in degree"),
    ("a wave of a file that breaks", "sea.csv", "0.2,3,40,0", "4,3,40,0", INPUT, "scene.yaml:4:1: waves: component 2 would be 8 m high, but in this depth a wave with the period 3 s breaks at 1.995 m"),
    ("too many components", "sea.csv", "0.2,3,40,0\n", "0.2,3,40,0\n" * 1001, LIMIT, "scene.yaml:4:1: waves: found 1002 components, the limit is 1000"),
]


def main():
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        def run(files):
            for name, text in files.items():
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
            return subprocess.run([sys.argv[1], "check", os.path.join(folder, "scene.yaml")], capture_output=True, text=True, check=False)

        good = run(GOOD)
        if good.returncode:
            failed += 1
            print("the good scene:", good.stderr)
        for name, text in GOOD.items():  # as spreadsheets write UTF-8
            marked = run({**GOOD, name: "\ufeff" + text})
            if marked.returncode:
                failed += 1
                print(f"{name} with a byte order mark:", marked.stderr)
        for name, file, old, new, code, wanted in CHANGES:
            assert not old or GOOD[file].count(old) == 1, name
            done = run({**GOOD, file: GOOD[file].replace(old, new) if old else new})
            told = done.stderr.replace("capstan: ", "", 1).replace(folder + "/", "", 1)
            if done.returncode != code or done.stdout or done.stderr.count("\n") != 1 or not told.startswith(wanted):
                failed += 1
                print(f"{name}: exit code {done.returncode}, expected {code}; {done.stderr.rstrip()}\n    expected {wanted}")
    print(f"{len(CHANGES)} cases, {failed} failed")
    return 0 if is_told(len(CHANGES)) and not failed else 1


if __name__ == "__main__":
    sys.exit(main())
