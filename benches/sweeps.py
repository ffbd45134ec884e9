"""A grid of four-bars over a turn each, ours beside numba and pylinkage, on one core and on two:
`python3 benches/sweeps.py [SIDE]`, of SIDE x SIDE variants (1000 unless told otherwise: a million).

Each keeps the least and the greatest transmission angle of every variant, which have a closed form.
`linkwork sweep` solves the first pose, checks every bar of every frame, looks for extremes between
frames, and writes a table; the others write nothing, and are told on which side the joint is.
"""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from program import build, interpreter, table

HERE = pathlib.Path(__file__).resolve().parent / "peers"
PACKAGES = ["pylinkage==1.3.0", "numba", "numpy"]
SCRIPT = """let b = 3.5, c = 3
point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
crank: motor A B radius 1 speed 1rev
length B C = b; length C D = c
solve
set dt 1/360
measure mu = angle(B, C, D, C) in deg
step 360
result least = mu.min, greatest = mu.max
"""


def other(name, side, cores):
    """What one of the others takes, and its worst error."""
    command = [python, str(HERE / "beside" / "sweeps.py"), name, str(side), str(cores)]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    return map(float, done.stdout.split())


def ours(side, cores):
    """What `linkwork sweep` takes, and its worst error."""
    with tempfile.TemporaryDirectory() as room:
        script = pathlib.Path(room) / "four-bar.link"
        script.write_text(SCRIPT)
        grid = []
        for name, to in (("b", 5), ("c", 4)):
            step = (to - 3) / side
            grid += ["--set", f"{name}=3..{to - step / 2!r}:{step!r}"]
        command = [linkwork, "sweep", str(script), *grid, "-j", str(cores), "--quiet", "--out", room]
        begun = time.perf_counter()
        child = subprocess.Popen(command)
        _, status, used = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - begun
        child.returncode = os.waitstatus_to_exitcode(status)
        assert child.returncode == 0, child.returncode
        with open(pathlib.Path(room) / "sweep.csv", newline="") as rows:
            worst = max(map(error, csv.DictReader(rows)))
    return seconds, used.ru_utime + used.ru_stime, worst


def error(row):
    """How far the extremes of a row are from the closed form, degrees."""
    from math import acos, degrees

    b, c = float(row["b"]), float(row["c"])
    exact = [degrees(acos((b * b + c * c - d * d) / (2 * b * c))) for d in (3, 5)]
    return max(abs(float(row[name]) - it) for name, it in zip(("least", "greatest"), exact))


side = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
linkwork = sys.argv[2] if len(sys.argv) > 2 else build()
python = interpreter("sweeps", PACKAGES)
RUNS = {
    "`linkwork sweep`": lambda cores: ours(side, cores),
    "pylinkage 1.3.0, `simulate_batch` and NumPy": lambda cores: other("pylinkage", side, cores),
    "two circles written out, compiled by numba": lambda cores: other("numba", side, cores),
}
lines = []
for name, run in RUNS.items():
    for cores in (1, 2):
        seconds, used, worst = run(cores)
        rate = f"{side * side / seconds:.3g}"
        each = f"{1e6 * used / side**2:.3g} us"
        lines.append([name, cores, f"{seconds:.3g} s", rate, each, f"{worst:.0e} deg"])
print(f"{side * side} four-bars x 360 frames\n")
head = ["", "cores", "from start to end", "variants a second", "of a processor, each", "worst extremum"]
print(table(head, lines))
