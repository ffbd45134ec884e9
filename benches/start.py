"""What it takes to begin: `python3 benches/start.py`.

From the start of a process to its end, with one frame solved on the way; the same without a
scene, and of a program that does nothing, in turn. Further: a million points from a loop, and
the memory of the largest scenes.
"""

import statistics
import tempfile

from program import ROOT, build, cost, memory, table

ROUNDS = 101

linkwork = build()
bench = ROOT / "scripts" / "bench"


def script(text):
    """A file with a script in it."""
    file = tempfile.NamedTemporaryFile("w", suffix=".link", delete=False)
    with file:
        file.write(text)
    return file.name


def run(file, **values):
    sets = [word for name, value in values.items() for word in ("--set", f"{name}={value}")]
    return [linkwork, "run", "--quiet", str(file), *sets]


cases = {
    "a program that does nothing": ["true"],
    "an empty script": run(script("")),
    "W1, one frame": run(bench / "w1-four-bar.link", frames=1),
    "W2, one frame": run(bench / "w2-jansen.link", frames=1),
    "W4, one frame": run(bench / "w4-crankshaft.link", frames=1),
}
found = {name: [] for name in cases}
for _ in range(ROUNDS):
    for name, command in cases.items():
        found[name].append(cost(command))
rows = []
for name, costs in found.items():
    wall, processor = ([1e3 * c[k] for c in costs] for k in (0, 1))
    command = cases[name]
    rows.append([
        name,
        f"{statistics.median(processor):.2f}",
        f"{min(wall):.2f}",
        f"{memory(command) / 2**20:.1f}" if command[0] == linkwork else "-",
    ])
head = ["process", "of the processor, median, ms", "from start to end, least, ms", "memory, MiB"]
print(table(head, rows), flush=True)

points = script("for i in 1..1000000 { point p[i] = (i, 0) }")
idle = memory(cases["an empty script"])
large = {
    "a million points from a `for`": (run(points), 0),
    "W5a, 100,000 bars, 1 frame": (run(bench / "w5a-chain.link", n=100000, frames=1), 100000),
    "W5b, 128 x 128, 1 frame": (
        run(bench / "w5b-truss.link", n=128, frames=1),
        2 * 128 * 129 + 2 * 128 * 128,
    ),
    "W5c, 100,000 four-bars, 1 frame": (
        run(bench / "w5c-four-bars.link", n=100000, frames=1),
        300000,
    ),
}
rows = []
for name, (command, n) in large.items():
    seconds = min(cost(command)[1] for _ in range(3))
    most = memory(command)
    each = f"{(most - idle) / n:.0f}" if n else "-"
    rows.append([name, f"{seconds:.2f}", f"{most / 2**20:.0f}", each])
print()
head = ["process", "seconds of the processor, least of 3", "memory, MiB", "bytes a constraint"]
print(table(head, rows))
