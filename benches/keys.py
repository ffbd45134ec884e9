"""From a key to the redrawn line, at a prompt in a pseudo-terminal; see docs/performance.md.

    cargo build --release && python3 benches/keys.py [target/release/linkwork]

Prints the median, the 95th percentile and the longest of 200 keys: in an empty session; with 10,000
points and their bars; and at the end of a block of 300 lines with these. A redraw is over when nothing
has come for some milliseconds; what is told is when its last byte came, and how long the processor worked
for a key.
"""

import fcntl
import os
import pty
import select
import struct
import sys
import tempfile
import termios
import time

N_KEYS = 200
QUIET = 0.02
# Bytes at a time: a pseudo-terminal holds 4096.
PIECE = 1024


def start(program, folder, *arguments):
    pid, fd = pty.fork()
    if pid == 0:
        os.chdir(folder)
        environment = {"HOME": folder, "PATH": os.environ["PATH"], "TERM": "xterm-256color"}
        os.execve(program, [program, *arguments], environment)
    fcntl.ioctl(fd, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    return pid, fd


def worked(pid):
    """Seconds of the processor so far."""
    with open(f"/proc/{pid}/schedstat", encoding="utf-8") as file:
        return int(file.read().split()[0]) / 1e9


def read(fd, quiet):
    """All that comes until it is quiet; gives when the last of it came."""
    last = None
    while select.select([fd], [], [], quiet)[0]:
        try:
            if not os.read(fd, 1 << 16):
                break
        except OSError:
            break
        last = time.perf_counter()
    return last


def paste(fd, text):
    """Pastes as a terminal does: it takes what is shown while it sends."""
    rest = b"\x1b[200~" + text.replace("\n", "\r").encode() + b"\x1b[201~"
    while rest:
        sent = os.write(fd, rest[:PIECE])
        rest = rest[sent:]
        read(fd, QUIET)
    read(fd, 5.0)


def keys(pid, fd, name):
    times = []
    before = worked(pid)
    for k in range(N_KEYS):
        begun = time.perf_counter()
        os.write(fd, b"x" if k % 2 == 0 else b"\x7f")
        last = read(fd, QUIET)
        if last is not None:
            times.append(last - begun)
    times.sort()
    cells = [times[len(times) // 2], times[len(times) * 95 // 100], times[-1]]
    cells.append((worked(pid) - before) / N_KEYS)
    print(f"| {name} | " + " | ".join(f"{1e3 * cell:.2f}" for cell in cells) + " |", flush=True)


def main():
    program = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else "target/release/linkwork")
    script = "point p[0] = (0, 0) frozen\nfor i in 1..9999 { point p[i] = (i, 0); length p[i-1] p[i] = 1 }\n"
    block = "for k in 1..2 {\n" + "".join(
        f"  point q[k][{i}] = (k, {i}) + polar({i}, 30deg) # the {i}th\n" for i in range(298)
    )
    print("| a key, ms | median | 95 % | longest | processor |\n| --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "big.link"), "w") as file:
            file.write(script)
        for name, arguments in (("an empty session", []), ("10,000 points", ["-i", "big.link"])):
            pid, fd = start(program, folder, *arguments)
            read(fd, 5.0)
            os.write(fd, b"length p[3] p[4] = ")
            read(fd, 0.5)
            keys(pid, fd, name)
            if arguments:
                os.write(fd, b"\x03")
                read(fd, 0.5)
                paste(fd, block)
                keys(pid, fd, "10,000 points, a block of 300 lines")
            os.close(fd)
            os.kill(pid, 9)
            os.waitpid(pid, 0)


if __name__ == "__main__":
    main()
