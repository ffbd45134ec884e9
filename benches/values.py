"""What follows many values of a parameter: `sweep`, `limits`, `accuracy`, of one program or of two that take
turns: `python3 benches/values.py [PROGRAM [OTHER]]`. Seconds of a processor, the least of several runs.

With two programs, what they wrote is compared: tables of sweeps and answers of `limits` to the byte, and of
`accuracy` all that is no time.
"""

import csv
import os
import pathlib
import subprocess
import sys
import tempfile

from program import build, table

ROUNDS = 5
N_VARIANTS = 1000
N_LIMITS = 100
BARS = """point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
crank: motor A B radius 1 speed 1rev
length B C = 3.5; length C D = 3
"""
SLIDER = """point A = (0, 0) frozen, E = (20, 0) frozen, B = (1, 0), S = (4, 0)
crank: motor A B radius 1 speed 1rev
length B S = 3; glider S on A E unbounded
"""
SIX_BAR = """point E = (6, 3), G = (8, 0) frozen
length C E = 3; length D E = 3.6
point H = (7, 3); length E H = 2; length H G = 3
"""
ROCKER = """point A = (0, 0) frozen, D = (4, 0) frozen, B = (1.5, 1), C = (3, 2)
crank: motor A B radius 1.8 speed 1rev
length B C = 2.2; length C D = 1.6
"""
SWEPT = """let b = 3.5
point A = (0, 0) frozen, D = (4, 0) frozen, B = (1, 0), C = (3, 3)
crank: motor A B radius 1 speed 1rev
length B C = b; length C D = 3
solve
set dt 1/360
"""
MEASURED = """measure mu = angle(B, C, D, C) in deg
step 360
result least = mu.min, greatest = mu.max
"""
LIMITS = f"solve\nfor k in 1..{N_LIMITS} {{ limits crank }}\n"
ACCURACY = "set dt 1/360\nstep 360\naccuracy\n"

SCENES = {
    f"`sweep` of a four-bar, {N_VARIANTS} lengths, 360 frames with a measure": ("sweep", SWEPT + MEASURED),
    f"`limits` of a four-bar, {N_LIMITS} times": ("run", BARS + LIMITS),
    f"`limits` of a four-bar between dead points, {N_LIMITS} times": ("run", ROCKER + LIMITS),
    f"`limits` of a crank-slider, {N_LIMITS} times": ("run", SLIDER + LIMITS),
    f"`limits` of a six-bar, {N_LIMITS} times": ("run", BARS + SIX_BAR + LIMITS),
    "`accuracy` of a four-bar, 360 frames": ("run", BARS + ACCURACY),
}


def once(program, command, script):
    """What a run takes, seconds of a processor, and what is to be the same whoever runs it."""
    with tempfile.TemporaryDirectory() as room:
        (pathlib.Path(room) / "scene.link").write_text(script)
        args = [program, command, "scene.link", "--quiet"]
        if command == "sweep":
            args += ["-j", "1", "--set", f"b=3..{5 - 1 / N_VARIANTS!r}:{2 / N_VARIANTS!r}"]
        child = subprocess.Popen(args, cwd=room, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        said = child.stdout.read()
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        assert child.returncode == 0, (args, said)
        tables = {path.name: path.read_text() for path in pathlib.Path(room).glob("*.csv")}
    if "accuracy.csv" in tables:
        rows = csv.DictReader(tables["accuracy.csv"].splitlines())
        same = ["method", "iterations", "tolerance", "residual", "position_error", "failed_frames"]
        said = [[row[name] for name in same] for row in rows]
        tables = {}
    return used.ru_utime + used.ru_stime, (said, tables)


programs = sys.argv[1:3] or [build()]
lines = []
for name, (command, script) in SCENES.items():
    # A study takes as long as it takes to be sure.
    rounds = 2 if "accuracy" in name else ROUNDS
    runs = [[once(program, command, script) for program in programs] for _ in range(rounds)]
    least = [min(run[k][0] for run in runs) for k in range(len(programs))]
    assert all(run[0][1] == run[-1][1] for run in runs), f"{name}: something else was said"
    ratio = [f"{least[0] / least[1]:.2f}"] if len(least) == 2 else []
    lines.append([name, *(f"{seconds:.3f}" for seconds in least), *ratio])
head = ["", *(f"`{program}`, s" for program in programs), "times as fast"]
print(table(head[: len(lines[0])], lines))
