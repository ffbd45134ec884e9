#!/usr/bin/env python3
"""What a command costs in a large scene, typed one by one, and what it keeps for `undo`.

    cargo build --release
    python3 benches/commands.py [PROGRAM ...]

Several programs are measured by turns in one run, so that their ratios hold on a machine that others use.
A command is typed many times; its time is that of the processor, a long session less one a third as long.
"""

import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PROGRAMS = sys.argv[1:] or [os.path.join(ROOT, "target/release/linkwork")]

FOUR_BARS = """set dt 1/360
for i in 1..{n} {{
  point A[i] = (0, 6 * i) frozen, D[i] = (4, 6 * i) frozen
  point B[i] = (1, 6 * i), C[i] = (3, 6 * i + 2.9)
  {drive}
  length B[i] C[i] = 3.5
  length C[i] D[i] = 3
}}
"""
CHAIN = """set dt 1/360
point P[0] = (0, 0) frozen
for i in 1..{n} {{ point P[i] = (i, 0.01 * i^2 / {n}); length P[i-1] P[i] }}
"""
FAR = "point Y = (-90, 0) frozen, Z = (-90, 1)\nlength Y Z = 2\nstep 3\n"
MOTOR, ROD = "motor A[i] B[i] radius 1 speed 1rev", "length A[i] B[i] = 1"


def four_bars(n, drive):
    return FOUR_BARS.format(n=n, drive=drive) + FAR


def chain(n):
    return CHAIN.format(n=n) + FAR


STILL = [
    ("`step`", ["step"]),
    ("`move` a far point, `step`", ["move Z to (-90, 1)", "step"]),
    ("a `for` that fails", ["for i in 1..2 { step; move Z to (-90, i); print nowhere }"]),
    ("`undo`, `redo`", ["undo", "redo"]),
]
SCENES = [(f"{n} four-bars at rest", four_bars(n, ROD), STILL, 10) for n in (3333, 33333)]
SCENES += [
    (f"{n} four-bars driven", four_bars(n, MOTOR), [("`step`", ["step"])], 5) for n in (3333, 33333)
]
SCENES += [(f"chain of {n}, at rest", chain(n), STILL, 10) for n in (1000, 10000, 100000)]
SCENES += [
    (f"chain of {n}, dragged", chain(n), [("`drag` over 1", ["drag P[%d] to (%d, 1) over 1" % (n, n - 1),
     "drag P[%d] to (%d, 2) over 1" % (n, n - 1)])], 4)
    for n in (1000, 10000)
]


def run(program, text):
    """Types a text into a session: seconds of the processor, and the most memory in MiB."""
    with tempfile.TemporaryFile() as file:
        file.write(text.encode())
        file.seek(0)
        child = subprocess.Popen(
            [program, "--quiet", "--threads", "1"],
            stdin=file,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        _, _, usage = os.wait4(child.pid, 0)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def measure(program, scene, commands, n):
    """Microseconds and KiB a command: the difference between 3 n rounds and n rounds."""
    (few, little), (many, much) = (
        min(run(program, scene + "\n".join(commands * rounds) + "\n") for _ in range(2))
        for rounds in (n, 3 * n)
    )
    n_commands = 2 * n * len(commands)
    return 1e6 * (many - few) / n_commands, 1024 * (much - little) / n_commands


def main():
    head = "".join(f" microseconds, {k} | KiB kept, {k} |" for k in range(1, len(PROGRAMS) + 1))
    print(f"| scene | command |{head}")
    print("|" + " --- |" * (2 + 2 * len(PROGRAMS)))
    for name, scene, commands, n in SCENES:
        for label, texts in commands:
            cells = (measure(program, scene, texts, n) for program in PROGRAMS)
            row = "".join(f" {us:.0f} | {kib:.0f} |" for us, kib in cells)
            print(f"| {name} | {label} |{row}", flush=True)


if __name__ == "__main__":
    main()
