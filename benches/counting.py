"""What a frame does, counted in instructions: `python3 benches/counting.py`.

Runs the program itself under callgrind with some number of frames and with that number more;
the difference is what those frames did, by file of source. tests/it/work.rs asserts the same of
the solver's own counters.
"""

import collections
import pathlib
import re
import subprocess
import tempfile

from program import build, table

FRAMES = 2000

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


def others(motor):
    """9,999 further four-bars, driven by this."""
    return f"""
for i in 2..10000 {{
  point A[i] = (0, 6 * i) frozen, D[i] = (4, 6 * i) frozen
  point B[i] = (1, 6 * i), C[i] = (3, 6 * i + 2.9)
  {motor}
  length B[i] C[i] = 3.5
  length C[i] D[i] = 3
}}
"""


# What a four-bar is given further, and how it is to be told.
LOADS = {
    "100,000 still constraints": STILL,
    "9,999 four-bars without a motor": others(""),
    "9,999 four-bars, motors off": others("crank[i]: motor A[i] B[i] radius 1; off crank[i]"),
    "9,999 four-bars, motors at speed 0": others("motor A[i] B[i] radius 1 speed 0"),
}
# An effect: the files that carry it out and nothing else, and a statement that calls for it.
EFFECTS = {
    "cog wheels": (
        ["constraint/kinds/cog.rs", "constraint/kinds/cog_velocity.rs"],
        "point E = (2, 0) frozen, F = (3, 0)\ncog A B, E F ratio 1",
    ),
    "racks": (
        ["constraint/kinds/rack.rs"],
        "point G = (-9, -1) frozen, H = (9, -1) frozen, W = (6, 0), R = (6, -1)\n"
        "length W R = 1\nrack W R on G H",
    ),
    "live values": (
        ["world/formula.rs", "world/arithmetic.rs"],
        "point E = (9, 9) frozen, F = (9, 8)\nlength E F = 1 + 0.1 * sin(time)",
    ),
    "derivatives": (["solve/velocity.rs"], "print velocity(C)"),
    "traces": (["world/trace.rs"], "trace C"),
    "ghosts and recordings": (["session/undo/recorder.rs"], 'record "paths.csv"'),
}

linkwork = build("profiling")
room = pathlib.Path(tempfile.mkdtemp())


def callgrind(script, frames):
    """Instructions of a run, by file of source."""
    file, out = room / "scene.link", room / "callgrind.out"
    file.write_text(f"{script}\nstep 20\nstep {frames}\n")
    tool = ["valgrind", "--tool=callgrind", "--compress-strings=no", f"--callgrind-out-file={out}"]
    run = [*tool, linkwork, "run", "--out", str(room), str(file)]
    done = subprocess.run(run, capture_output=True, text=True)
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


def of_files(counts, files):
    return sum(n for source, n in counts.items() if source.endswith(tuple(files)))


four_bar = frame(FOUR_BAR)
alone = sum(four_bar.values())
rows = [["a four-bar", f"{alone:.0f}", ""]]
for name, load in LOADS.items():
    with_load = sum(frame(FOUR_BAR + load).values())
    change = 100 * (with_load / alone - 1)
    rows.append([f"with {name}", f"{with_load:.0f}", f"{change:+.2f} %"])
print(table(["scene", "instructions a frame", "more than alone"], rows), flush=True)

rows = []
whole = callgrind(FOUR_BAR, FRAMES)
for name, (files, statement) in EFFECTS.items():
    script = f"{FOUR_BAR}{statement}\n"
    rows.append([
        name,
        ", ".join(f"`{file}`" for file in files),
        of_files(whole, files),
        of_files(callgrind(script, FRAMES), files),
        f"{sum(frame(script).values()) - alone:.0f}",
    ])
print()
head = [
    "effect",
    "files that carry it out",
    "their instructions in a run without it",
    "in a run with it",
    "all instructions a frame more with it",
]
print(table(head, rows))
