"""What a frame does, counted in instructions: `python3 benches/counting.py`.

Runs the program itself under callgrind with some number of frames and with that number more;
the difference is what those frames did, file of source by file of source.
"""

import collections
import pathlib
import re
import subprocess
import sys
import tempfile

from program import build, table

FRAMES = 200

FOUR_BAR = """
point A = (0, 0) frozen, D = (4, 0) frozen
point B = (1, 0), C = (3, 2.9)
motor A B radius 1 speed 1rev
length B C = 3.5
length C D = 3
set dt 1/360
"""
STILL = """
for i in 1..25000 {
  point P[i] = (i, 10) frozen, Q[i] = (i, 11), R[i] = (i + 1, 11), S[i] = (i + 1, 10)
  length P[i] Q[i] = 1
  length Q[i] R[i] = 1
  length R[i] S[i] = 1
  length S[i] P[i] = 1
}
"""
OTHERS = """
for i in 2..10000 {
  point A[i] = (0, 6 * i) frozen, D[i] = (4, 6 * i) frozen
  point B[i] = (1, 6 * i), C[i] = (3, 6 * i + 2.9)
  motor A[i] B[i] radius 1 speed SPEED
  length B[i] C[i] = 3.5
  length C[i] D[i] = 3
}
"""
RUN = """
step 20
step frames
"""

# An effect: the files that carry it out and nothing else, and what calls for it.
EFFECTS = {
    "cog wheels": (
        ["constraint/cog.rs", "constraint/cog_velocity.rs"],
        "point E = (2, -3) frozen, F = (3, -3)\nlength E F = 1\ncog A B, E F ratio 1\n",
    ),
    "racks": (
        ["constraint/rack.rs"],
        "point G = (-9, 1) frozen, H = (9, 1) frozen\nrack A B on G H\n",
    ),
    "motors": (["constraint/motor.rs"], ""),
    "live values": (
        ["world/formula.rs", "world/arithmetic.rs"],
        "point E = (9, 9) frozen, F = (9, 8)\nlength E F = 1 + 0.1 * sin(time)\n",
    ),
    "traces": (["world/trace.rs"], "trace C\n"),
    "ghosts": (["session/recorder.rs"], "expose every 10\n"),
    "rates": (["solve/rates.rs", "constraint/jet.rs"], "let v = norm(velocity(C))\nlength A X = 9 + v\n"),
}

linkwork = build()
room = pathlib.Path(tempfile.mkdtemp())


def callgrind(script, frames):
    """Instructions of a run, by file of source."""
    file, out = room / "scene.link", room / "callgrind.out"
    file.write_text(f"let frames = {frames}\n{script}{RUN}")
    tool = ["valgrind", "--tool=callgrind", "--compress-strings=no", f"--callgrind-out-file={out}"]
    done = subprocess.run([*tool, linkwork, "run", file], capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    counts = collections.Counter()
    source, is_call = "", False
    for line in out.read_text().splitlines():
        if match := re.match(r"f[lie]=(.*)", line):
            source = match[1]
        elif line.startswith("calls="):
            is_call = True
        elif re.match(r"[+\-*\d]", line):
            # The line after a call holds what was called: counted where it was done.
            if not is_call:
                counts[source] += int(line.split()[1])
            is_call = False
    return counts


def frame(script):
    """Instructions of one frame, by file of source."""
    more, less = callgrind(script, 2 * FRAMES), callgrind(script, FRAMES)
    return {file: (more[file] - less[file]) / FRAMES for file in more}


def total(script):
    return sum(frame(script).values())


def percent(value, base):
    return f"{100 * (value / base - 1):+.2f} %"


alone = total(FOUR_BAR)
still = total(FOUR_BAR + STILL)
rows = [["a four-bar", f"{alone:.0f}", ""]]
rows.append(["with 100,000 still constraints", f"{still:.0f}", percent(still, alone)])
for name, speed in {"switched off": "0\noff motor{i}", "at speed 0": "0"}.items():
    ...
