"""What an edit costs where everything holds, in the largest scenes: `python3 benches/edits.py [PROGRAM...]`.

Processor time of a bar taken out of the middle of a chain that hangs still, a frame, the bar put back,
and a frame: that of a script with many such rounds, less that of the same without. The least of three,
the programs in turn.
"""

import resource
import subprocess
import sys
import tempfile

from program import build, table

# How many bars, and how many rounds.
SIZES = {1000: 400, 10_000: 200, 100_000: 100}
ROUNDS = 3

programs = sys.argv[1:] or [build()]


def script(n, n_rounds):
    """A chain of n bars, and so many edits."""
    edit = f"off L[{n // 2}]\nstep\non L[{n // 2}]\nstep\n"
    return f"""set dt 1/360
point P[0] = (0, 0) frozen
for i in 1..{n} {{ point P[i] = (i, 0.01 * i^2 / {n}); L[i]: length P[i-1] P[i] }}
step 3
{edit * n_rounds}"""


def seconds(program, text):
    """Processor time of a run."""
    with tempfile.NamedTemporaryFile("w", suffix=".link") as file:
        file.write(text)
        file.flush()
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([program, "--threads", "1", "run", file.name], capture_output=True, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


rows = []
for n, n_rounds in SIZES.items():
    times = {program: ([], []) for program in programs}
    for _ in range(ROUNDS):
        for program in programs:
            for runs, rounds in zip(times[program], (0, n_rounds)):
                runs.append(seconds(program, script(n, rounds)))
    least = [(min(many) - min(none)) / n_rounds for none, many in times.values()]
    rows.append([f"{n} bars", *(f"{1e3 * time:.3f}" for time in least)])
print(table(["ms a round", *programs], rows))
