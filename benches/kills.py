#!/usr/bin/env python3
"""Sessions killed at random moments: does the journal bring back what was carried out?

    cargo build --release && python3 benches/kills.py [target/release/linkwork] [N]

Each of N sessions (1000) is typed at as fast as it takes lines and killed with signal 9 after a
random time. Its journal must load, and what it makes must be to the byte what the lines make that
were carried out, or these and the one that was under way, or as many statements of that as were done.
"""

import os
import pty
import random
import select
import signal
import subprocess
import sys
import tempfile
import time


# What is included, in the folder of each session.
PART = "let part = 3\nstep 5\n"


def lines():
    """What is typed: edits, motion, loops, undo, files; each leaves something behind."""
    yield "point p[0] = (0, 0) frozen, q = (1, 0)"
    yield "spin: motor p[0] q speed 1rev"
    k = 0
    while True:
        k += 1
        yield f"point p[{k}] = ({k}, 0); length p[{k - 1}] p[{k}] = 1"
        yield f"let r[{k}] = {k}"
        if k % 3 == 0:
            yield f"for i in 1..20 {{ let s[{k}][i] = i; step }}"
        if k % 5 == 0:
            yield "step 2000"
        if k % 7 == 0:
            yield "undo 2"
            yield "redo"
        if k % 8 == 0:
            yield 'include "part.link"'
            yield "undo"
            yield "redo"
        if k % 11 == 0:
            yield 'save "kept.link"'
            yield 'load "kept.link"'


def write_part(folder):
    with open(os.path.join(folder, "part.link"), "w", encoding="utf-8") as file:
        file.write(PART)


def session(program, folder, seconds):
    """Types until the time is up and kills; gives the lines carried out, and the one under way."""
    write_part(folder)
    pid, fd = pty.fork()
    if pid == 0:
        os.chdir(folder)
        environment = {"HOME": folder, "PATH": os.environ["PATH"], "TERM": "dumb"}
        os.execve(program, [program], environment)
    end = time.monotonic() + seconds
    seen, typed, sent = b"", lines(), []
    while time.monotonic() < end:
        if select.select([fd], [], [], 0.001)[0]:
            seen += os.read(fd, 1 << 16)
        n_prompts = seen.count(b"\n> ") + seen.startswith(b"> ")
        if n_prompts > len(sent):
            sent.append(next(typed))
            os.write(fd, sent[-1].encode() + b"\n")
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    os.close(fd)
    return sent[:-1], sent[-1:]


def made(program, typed):
    """The script of what lines on a pipe make; none where one of them fails."""
    with tempfile.TemporaryDirectory() as folder:
        write_part(folder)
        text = "\n".join([*typed, 'save "made.link"', ""])
        out = subprocess.run([program, "-q", "--allow-any-path"], input=text, cwd=folder, text=True,
                             stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        if out.returncode != 0:
            print(out.stderr)
            return None
        with open(os.path.join(folder, "made.link"), encoding="utf-8") as file:
            return file.read()


def statements(line):
    """The statements of a line one by one; a block is one."""
    return [line] if "{" in line else line.split("; ")


def main():
    program = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else "target/release/linkwork")
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    rng = random.Random(1)
    n_lines = n_before = n_within = n_after = n_none = n_wrong = 0
    for k in range(n):
        with tempfile.TemporaryDirectory() as folder:
            done, under_way = session(program, folder, rng.uniform(0.01, 0.6))
            n_lines += len(done)
            journals = os.path.join(folder, ".local/state/linkwork/journal")
            files = os.listdir(journals) if os.path.isdir(journals) else []
            files = [file for file in files if file.endswith(".link")]
            if not files:
                n_none += 1
                n_wrong += bool(done)
                continue
            back = made(program, [f'load "{os.path.join(journals, files[0])}"'])
            parts = [part for line in under_way for part in statements(line)]
            n_parts = (k for k in range(len(parts) + 1) if back == made(program, done + parts[:k]))
            n_done = None if back is None else next(n_parts, None)
            if n_done is None:
                n_wrong += 1
                print(f"session {k}: after {len(done)} lines, in {under_way}", flush=True)
            elif n_done == 0:
                n_before += 1
            elif n_done == len(parts):
                n_after += 1
            else:
                n_within += 1
    print(f"{n} sessions killed, {n_lines} lines carried out: {n_before} came back as after their last "
          f"answer, {n_within} within the line under way, {n_after} after it, {n_none} were killed before "
          f"they began; {n_wrong} lost something")
    sys.exit(n_wrong > 0)


if __name__ == "__main__":
    main()
