#!/usr/bin/env python3
"""How soon Ctrl-C ends a command that takes long, and that a second one ends the program.

    cargo build --release && python3 benches/stops.py [target/release/linkwork] [WORD]

Each command is typed at a prompt and gets SIGINT at moments in its middle. Time is that of the
processor, all threads together, which others who use the machine do not change: from the signal to the
next prompt. Of what is done before it is stopped it is said how long it takes. WORD measures those alone
whose name has it.
"""

import os
import pty
import select
import signal
import sys
import tempfile
import time

# When it is stopped, seconds after it was typed.
MOMENTS = (0.02, 0.05, 0.15, 0.6)
# How long anything may take, seconds on the wall.
PATIENCE = 40

CHAIN = "point p[0] = (0, 0) frozen; for i in 1..%d { point p[i] = (i, mod(i, 2)); length p[i - 1] p[i] }"
NET = (
    "for i in 1..{n} {{ for k in 1..{n} {{ point p[i][k] = (i + 0.01 * sin(k), k) }} }}",
    "for i in 2..{n} {{ for k in 1..{n} {{ length p[i - 1][k] p[i][k] = 1 }} }}",
    "for i in 1..{n} {{ for k in 2..{n} {{ length p[i][k - 1] p[i][k] = 1 }} }}",
    "freeze p[1][1] p[{n}][1]",
)
FOUR_BARS = (
    "for i in 1..%d { point A[i] = (0, 6 * i) frozen, D[i] = (4, 6 * i) frozen, B[i] = (1, 6 * i), "
    "C[i] = (3, 6 * i + 2.9); motor A[i] B[i] speed 1rev; length B[i] C[i] = 3.5; length C[i] D[i] = 3 }"
)
CRANK = "point A = (0, 0) frozen, B = (1, 0); motor A B speed 1rev"


def net(n):
    return [line.format(n=n) for line in NET]


CASES = [
    ("`for` without a body", [], "for i in 1..1e12 {}"),
    ("`for` with a `let`", [], "for i in 1..1e9 { let q = i }"),
    ("`for` that makes points", [], "for i in 1..4e6 { point p[i] = (i, 0) }"),
    ("a parameter on parameters", [CRANK, "let x[0] = B.x"], "for i in 1..1e6 { let x[i] = x[i - 1] + 1 }"),
    ("`use` within `use`", [CRANK, "define d(x, P) { length A B <= 3 + abs(x) }"],
     "for i in 1..1e6 { use d(B.x + i, B) }"),
    ("`include` of 60 MB", [], 'include "long.link"'),
    ("`load` of 60 MB", [], 'load "long.link"'),
    ("`load` of a saved chain of 300,000", [CHAIN % 300000, 'save "chain.link"', "clear"], 'load "chain.link"'),
    ("`step` of a chain of 300,000 for the first time", [CHAIN % 300000], "step"),
    ("`solve` of a net of 128 x 128", net(128), "solve"),
    ("`solve` of a net of 300 x 300", net(300), "solve"),
    ("`step` of a net of 128 x 128", [*net(128), "solve", "spin: motor p[64][64] p[64][65] speed 1rev"], "step 100000"),
    ("`check` of a net of 100 x 100", net(100), "check"),
    ("`limits` of a chain of 1000", [CHAIN % 1000, "crank: motor p[0] p[1] speed 1rev; freeze p[1000]"],
     "limits crank"),
    ("`why` in a net of 60 x 60", [*net(60), "bad: length p[1][1] p[60][60] = 1"], "why bad"),
    ("`effects` of 33,333 four-bars", [FOUR_BARS % 33333], "effects"),
    ("`accuracy` of a four-bar", [FOUR_BARS % 1], "accuracy"),
    ("`accuracy` of 3333 four-bars", [FOUR_BARS % 3333, "step 20"], "accuracy"),
    ("`step` of a crank", [CRANK], "step 1e9"),
    ("`run` of 33,333 four-bars", [FOUR_BARS % 33333], "run 1000"),
    ("`drag` of a chain of 10,000", [CHAIN % 10000, "freeze p[5000]"], "drag p[10000] to (0, 5000) over 1e5"),
    ("`pull` of a chain of 1000", [CHAIN % 1000], "pull p[1000] to (2000, 0) over 1e5"),
    ("`relax` of a chain of 100,000", [CHAIN % 100000], "relax 1e9"),
    ("`svg` of a chain of 300,000", [CHAIN % 300000], 'svg "chain.svg"'),
    ("`svg` of a trace of 5 million", [CRANK, "trace B; step 5e6"], 'svg "trace.svg"'),
    ("`show` of a chain of 300,000", [CHAIN % 300000], "show"),
    ("`export` of a chain of 100,000 as strokes", [CHAIN % 100000], 'export "s.svg"'),
    ("`export` of a chain of 100,000 as parts", [CHAIN % 100000], 'export "p.dxf" scale 9 width 2 hole 1'),
    ("`save` of a chain of 300,000", [CHAIN % 300000], 'save "chain.link"'),
    ("`list` of a chain of 300,000", [CHAIN % 300000], "list"),
    ("`record` to a table", [CRANK, 'record "t.csv"'], "step 9e6"),
    ("`record stop` of a movie", [CRANK, 'record "t.svg"', "step 250000"], "record stop"),
    ("`record stop` of pictures", [CRANK, 'record "t/"', "step 20000"], "record stop"),
    ("`record stop` of a table", [CRANK, 'record "t.csv"', "step 3e6"], "record stop"),
    ("`plot` of 4 million", ['for i in 1..4e6 { sample "s" = sin(i) }'], 'plot "s.svg"'),
    ("`assert` in a loop with pictures", [CRANK], 'for i in 1..1e5 { step; svg "a.svg"; assert 1 = 1 }'),
    ("`freeze all`, a million points", ["for i in 1..1e6 { point p[i] = (i, 0) }"], "freeze all"),
    ("`delete p`, cascade, of a chain of 300,000", [CHAIN % 300000], "delete p cascade"),
    ("`undo` of a chain of 300,000", [CHAIN % 300000], "undo"),
    ("`redo` of a chain of 300,000", [CHAIN % 300000, "undo"], "redo"),
    ("`reset` of 33,333 four-bars", [FOUR_BARS % 33333, "step 10"], "reset"),
    ("`clear` of 100,000 four-bars", [FOUR_BARS % 100000], "clear"),
]


class Session:
    def __init__(self, program, folder):
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            os.chdir(folder)
            environment = {"HOME": folder, "PATH": os.environ["PATH"], "TERM": "dumb"}
            limits = ["statements", "points", "constraints", "printed-bytes", "undo-bytes"]
            args = [word for name in limits for word in ("--limit", f"{name}=none")]
            os.execve(program, [program, "--no-pager", *args], environment)
        self.seen = b""
        self.wait()

    def wait(self, seconds=PATIENCE, until=lambda: False):
        """Waits for the prompt, no longer than until something holds; gives whether it came."""
        end = time.monotonic() + seconds
        # Behind an answer, or behind what told how far it is.
        while not self.seen.endswith((b"\n> ", b"\r> ")) and self.seen != b"> ":
            if time.monotonic() > end or until():
                return False
            if select.select([self.fd], [], [], 0.002)[0]:
                try:
                    self.seen = (self.seen + os.read(self.fd, 1 << 16))[-4096:]
                except OSError:
                    return True
        return True

    def worked(self):
        """Seconds of the processor so far."""
        total = 0
        for task in os.listdir(f"/proc/{self.pid}/task"):
            try:
                with open(f"/proc/{self.pid}/task/{task}/schedstat", encoding="utf-8") as file:
                    total += int(file.read().split()[0])
            except OSError:
                pass
        return total / 1e9

    def kill(self):
        os.kill(self.pid, signal.SIGKILL)
        self.end()

    def type(self, line):
        self.seen = b""
        os.write(self.fd, line.encode() + b"\n")
        # The echo of the line ends where its work begins.
        while line.encode()[-20:] not in self.seen:
            self.seen += os.read(self.fd, 1 << 16)

    def interrupt(self):
        os.kill(self.pid, signal.SIGINT)

    def end(self):
        """Ends the program; gives its exit status, none where it had to be killed."""
        for _ in range(200):
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                os.close(self.fd)
                return os.waitstatus_to_exitcode(status)
            if select.select([self.fd], [], [], 0)[0]:
                self.drain()
            time.sleep(0.01)
        os.kill(self.pid, signal.SIGKILL)
        os.waitpid(self.pid, 0)
        os.close(self.fd)
        return None

    def drain(self):
        try:
            os.read(self.fd, 1 << 16)
        except OSError:
            pass


def prepared(program, folder, before):
    session = Session(program, folder)
    for line in before:
        session.type(line)
        if not session.wait():
            session.kill()
            raise TimeoutError
    return session


def stopped(program, folder, before, command, moment):
    """Seconds from the stop to the prompt, and nothing; or the other way, those of the whole command."""
    session = prepared(program, folder, before)
    begun = session.worked()
    session.type(command)
    is_done = session.wait(until=lambda: session.worked() - begun > moment)
    before_stop = session.worked()
    if not is_done:
        session.interrupt()
        is_stopped = session.wait()
    took = session.worked() - before_stop if not is_done else before_stop - begun
    session.kill()
    if is_done:
        return None, took
    return (took if is_stopped else float("inf")), None


def ended(program, folder, before, command):
    """The exit status where Ctrl-C is pressed twice; nothing where the command was done before."""
    session = prepared(program, folder, before)
    begun = session.worked()
    session.type(command)
    if session.wait(until=lambda: session.worked() - begun > MOMENTS[0]):
        session.kill()
        return None
    session.interrupt()
    time.sleep(0.001)
    session.interrupt()
    return session.end()


def main():
    program = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else "target/release/linkwork")
    word = sys.argv[2] if len(sys.argv) > 2 else ""
    print("| command | longest time to stop, s | pressed twice, status |\n| --- | --- | --- |")
    for name, before, command in CASES:
        if word not in name:
            continue
        with tempfile.TemporaryDirectory() as folder:
            if "long.link" in command:
                with open(os.path.join(folder, "long.link"), "w", encoding="utf-8") as file:
                    file.writelines(f"let q[{i}] = {i} + 1\n" for i in range(2_700_000))
            longest, done, status = 0.0, None, None
            try:
                for moment in MOMENTS:
                    took, done = stopped(program, folder, before, command, moment)
                    if took is None:
                        break
                    longest = max(longest, took)
                status = ended(program, folder, before, command)
            except TimeoutError:
                print(f"| {name} | too slow to begin | - |", flush=True)
                continue
        cell = f"{longest:.3f}" if longest else "-"
        if done is not None:
            cell += f", done in {done:.2f}"
        print(f"| {name} | {cell} | {'-' if status is None else status} |", flush=True)


if __name__ == "__main__":
    main()
