"""How a frame grows up to the largest scenes: `python3 benches/scale.py`.

Wall time a frame, as the program's own receipt says it, of a second run or drag: the first one
makes the matrices. The least of nine, the sizes in turn, with the iterations a frame and the growth
as an exponent of the number of constraints.
"""

import math
import re
import subprocess
import tempfile

from program import ROOT, build, table

ROUNDS = 9
WARM = 5
UNITS = {"ns": 1e-3, "us": 1, "ms": 1e3, "s": 1e6}

linkwork = build()


def chain(n, frames):
    return f"drag p[{n}] to p[{n}] + {frames} * (0.1, 0.05) over {frames}"


def net(_, frames):
    return f"drag p[0][0] to p[0][0] + {frames} * (0.01, 0.005) over {frames}"


def four_bars(_, frames):
    return f"step {frames}"


# A script, what goes on with it, its sizes, and how many constraints each size makes.
SCENES = {
    "chain of {} bars": ("w5a-chain", chain, [1000, 10000, 100000], lambda n: n),
    "net of {0} x {0} squares": ("w5b-truss", net, [32, 64, 128], lambda n: 4 * n * n + 2 * n),
    "{} four-bars": ("w5c-four-bars", four_bars, [1000, 10000, 100000], lambda n: 3 * n),
}


def frame(script, n, more):
    """Microseconds and iterations a frame."""
    with tempfile.NamedTemporaryFile("w", suffix=".link") as file:
        file.write((ROOT / "scripts" / "bench" / f"{script}.link").read_text() + more)
        file.flush()
        command = [linkwork, "run", "--set", f"n={n}", "--set", f"frames={WARM}", file.name]
        told = subprocess.run(command, capture_output=True, text=True, check=True).stderr
    *_, (iterations, time, unit) = re.findall(r"([\d.]+) iterations and ([\d.]+) (\w+) a frame", told)
    return float(time) * UNITS[unit], iterations


rows = []
for name, (script, more, sizes, count) in SCENES.items():
    runs = {n: [] for n in sizes}
    for _ in range(ROUNDS):
        for n in sizes:
            frames = max(20, min(400, 2_000_000 // n)) if script == "w5c-four-bars" else 20
            runs[n].append(frame(script, n, more(n, frames)))
    last = None
    for n in sizes:
        micros, iterations = min(runs[n])
        growth = math.log(micros / last[0]) / math.log(count(n) / last[1]) if last else None
        shown = f"{growth:.2f}" if growth else ""
        rows.append([name.format(n), f"{micros / 1e3:.3g}", iterations, shown])
        last = micros, count(n)
print(table(["scene", "milliseconds a frame", "iterations", "growth"], rows))
