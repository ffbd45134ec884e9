"""Many frames in one call, ours and others', beside the closed form: `python3 benches/compiled.py`.

pylinkage compiles a linkage, CasADi an equation; NumPy evaluates the closed form over an array of
frames; SciPy solves each frame from the last (W1 and W2). The closed form in C pays for the sines and
cosines of what drives it, once with each frame waiting for the last, as frames do that go on from each other, and
once with frames that overlap. All take turns; times are of the processor, medians of the rounds.
"""

import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

from program import ROOT, build, cost, interpreter, table

HERE = pathlib.Path(__file__).resolve().parent / "peers"
PACKAGES = ["pylinkage==1.3.0", "numba", "numpy", "scipy", "casadi"]
# Each with the frames it is given.
OTHERS = {
    "pylinkage 1.3.0, `step_fast`": ("pylinkage-step_fast", 360_000),
    "NumPy, all frames as an array": ("numpy-array", 36_000),
    "CasADi, Newton over all frames": ("casadi-newton", 3_600),
    "pylinkage 1.3.0, `step`": ("pylinkage-step", 3_600),
    "SciPy, `root` frame by frame": ("scipy-root", 720),
}
SCRIPTS = {
    "W1": "w1-four-bar",
    "W2": "w2-jansen",
    "W3": "w3-peaucellier",
    "W4": "w4-crankshaft",
}
# Those that the others are asked for.
COMPARED = ["W1", "W2"]
ROUNDS = 5
FRAMES = 1_000_000

linkwork = sys.argv[1] if len(sys.argv) > 1 else build()
room = pathlib.Path(tempfile.mkdtemp())


def answer(*command):
    done = subprocess.run(list(map(str, command)), check=True, capture_output=True, text=True)
    return list(map(float, done.stdout.split()))


def ours(work):
    """Nanoseconds a frame of `step n`: a long run less one half as long."""
    text = (ROOT / "scripts" / "bench" / f"{SCRIPTS[work]}.link").read_text()
    used = []
    for n in (FRAMES, 2 * FRAMES):
        script = room / f"{work}-{n}.link"
        script.write_text(re.sub(r"let frames = \d+", f"let frames = {n}", text))
        used.append(cost([linkwork, "run", "--out", str(room), str(script)])[1])
    return 1e9 * (used[1] - used[0]) / FRAMES


def c_compiler():
    return shutil.which("cc") or sys.exit("there is no C compiler here")


limit = room / "closed_form"
source = HERE / "beside" / "closed_form.c"
subprocess.run([c_compiler(), "-O2", "-o", limit, source, "-lm"], check=True)
python = interpreter("compiled", PACKAGES)
rows = {"closed form in C, each frame waits for the last": {}}
errors = {}
rows.update({"linkwork, `step n`": {}, **{name: {} for name in OTHERS}})
rows["closed form in C, frames overlap"] = {}
for work in SCRIPTS:
    times = {name: [] for name in rows}
    for _ in range(ROUNDS):
        dependent, overlapped, *_ = answer(limit, work, 3 * FRAMES)
        times["closed form in C, each frame waits for the last"].append(dependent)
        times["closed form in C, frames overlap"].append(overlapped)
        times["linkwork, `step n`"].append(ours(work))
        for name, (run, n) in OTHERS.items() if work in COMPARED else ():
            used, error, *_ = answer(python, HERE / "beside" / "compiled.py", run, work, n)
            times[name].append(used)
            errors[name] = max(errors.get(name, 0.0), error)
    for name, all_rounds in times.items():
        if all_rounds:
            rows[name][work] = statistics.median(all_rounds)
first = rows["closed form in C, each frame waits for the last"]
lines = []
for name, of in rows.items():
    cells = [
        f"{of[work]:.3g} ns ({of[work] / first[work]:.2f}x)" if work in of else ""
        for work in SCRIPTS
    ]
    error = errors.get(name)
    lines.append([name, *cells, "" if error is None else f"{error:.0e}"])
print(table(["a frame", *SCRIPTS, "worst bar / size"], lines))
