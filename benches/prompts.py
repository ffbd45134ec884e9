"""From the start of a program to its first prompt, beside other prompts; see docs/performance.md.

    cargo build --release && python3 benches/prompts.py [target/release/linkwork]

Each program that is installed is started in a pseudo-terminal, in turn, in an empty home; what is told is
the median of the time until its prompt is there, and of the work of the processor until then.
"""

import os
import pty
import select
import shutil
import signal
import statistics
import sys
import tempfile
import time

ROUNDS = 21
# A program, and what it asks with.
PROMPTS = [
    ("sqlite3", b"sqlite> "),
    ("node", b"> "),
    ("python3", b">>> "),
    ("ipython", b"In ["),
    ("julia", b"julia> "),
    ("numbat", b">>> "),
    ("gnuplot", b"gnuplot> "),
]


def first_prompt(command, prompt, home):
    """Seconds until the prompt is there, and those of the processor."""
    begun = time.perf_counter()
    pid, fd = pty.fork()
    if pid == 0:
        environment = {**os.environ, "HOME": home, "TERM": "xterm-256color"}
        os.chdir(home)
        os.execvpe(command[0], command, environment)
    seen = b""
    while prompt not in seen:
        if not select.select([fd], [], [], 20)[0]:
            break
        piece = os.read(fd, 1 << 16)
        # Some ask where the cursor is, and wait for the answer.
        if b"\x1b[6n" in piece:
            os.write(fd, b"\x1b[1;1R")
        seen += piece
    took = time.perf_counter() - begun
    os.kill(pid, signal.SIGKILL)
    usage = os.wait4(pid, 0)[2]
    os.close(fd)
    return took, usage.ru_utime + usage.ru_stime


def main():
    program = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else "target/release/linkwork")
    # Beside this Python first: what stands in for it elsewhere takes time of its own.
    path = os.path.dirname(sys.executable) + os.pathsep + os.environ["PATH"]
    there = [(shutil.which(name, path=path), prompt) for name, prompt in PROMPTS]
    cases = [([program], b"> ")] + [([name], prompt) for name, prompt in there if name]
    found = [[] for _ in cases]
    with tempfile.TemporaryDirectory() as home:
        for _ in range(ROUNDS):
            for (command, prompt), times in zip(cases, found):
                times.append(first_prompt(command, prompt, home))
    print("| program | to its prompt, ms | of the processor, ms |\n| --- | --- | --- |")
    for (command, _), times in zip(cases, found):
        cells = (1e3 * statistics.median(column) for column in zip(*times))
        name = os.path.basename(command[0])
        print(f"| {name} | " + " | ".join(f"{cell:.1f}" for cell in cells) + " |")


if __name__ == "__main__":
    main()
