"""Sessions killed at random moments: is what was carried out in their journals?

    cargo build --release && python3 benches/kills.py [target/release/linkwork] [N]

Each of N sessions (1000) is typed at as fast as it takes lines and killed with signal 9 after a
random time. Of the lines whose answer was seen none may be missing from the journal, and what is
there must load.
"""

import os
import pty
import random
import re
import select
import signal
import subprocess
import sys
import tempfile
import time


def lines():
    yield "point p[0] = (0, 0) frozen"
    k = 0
    while True:
        k += 1
        yield f"point p[{k}] = ({k}, 0); length p[{k - 1}] p[{k}] = 1"
        yield f"let r[{k}] = {k}"
        if k % 5 == 0:
            yield "step 2"
        if k % 17 == 0:
            yield "undo"
        yield f"r[{k}] + 0" if k % 17 else "time"


def session(program, folder, seconds):
    """Types until the time is up; gives the lines behind which the next prompt was seen."""
    pid, fd = pty.fork()
    if pid == 0:
        environment = {"HOME": folder, "PATH": os.environ["PATH"], "TERM": "dumb"}
        os.execve(program, [program], environment)
    end = time.monotonic() + seconds
    seen, typed = b"", lines()
    n_prompts = n_sent = 0
    carried_out = []
    sent = []
    while time.monotonic() < end:
        if select.select([fd], [], [], 0.001)[0]:
            seen += os.read(fd, 1 << 16)
        n_prompts = seen.count(b"\n> ") + seen.startswith(b"> ")
        if n_prompts > n_sent:
            carried_out = sent[:]
            line = next(typed)
            sent.append(line)
            os.write(fd, line.encode() + b"\n")
            n_sent += 1
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    os.close(fd)
    return carried_out


def main():
    program = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else "target/release/linkwork")
    n = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    rng = random.Random(1)
    n_lines = n_lost = n_broken = 0
    for k in range(n):
        with tempfile.TemporaryDirectory() as folder:
            done = session(program, folder, rng.uniform(0.01, 0.4))
            journal = os.path.join(folder, ".local/state/linkwork/journal")
            files = [f for f in os.listdir(journal) if f.endswith(".link")] if os.path.isdir(journal) else []
            marks = [line for line in done if line.startswith("let ")]
            n_lines += len(done)
            if not files:
                n_lost += bool(marks)
                continue
            path = os.path.join(journal, files[0])
            text = open(path).read()
            out = subprocess.run([program, "-q", path], capture_output=True, text=True)
            n_broken += out.returncode != 0
            # Undo takes one `let` back at most.
            names = [re.match(r"let (\S+)", line).group(1) for line in marks]
            lost = [name for name in names if f"let {name} = " not in text]
            if len(lost) > done.count("undo"):
                n_lost += 1
                print(f"session {k}: {lost} of {len(names)} lost")
    print(f"{n} sessions killed, {n_lines} lines carried out; {n_lost} lost some, {n_broken} cannot be loaded")


if __name__ == "__main__":
    main()
