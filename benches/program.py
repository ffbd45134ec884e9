"""The program itself, built and run, for the scripts that measure it."""

import json
import os
import pathlib
import subprocess
import time
import venv

ROOT = pathlib.Path(__file__).resolve().parent.parent


def build(profile="release"):
    """Builds the program, as its user gets it unless told otherwise; its path."""
    command = ["cargo", "build", "--profile", profile, "--bin", "linkwork"]
    command.append("--message-format=json")
    done = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True)
    for line in done.stdout.splitlines():
        message = json.loads(line)
        if message.get("executable") and message["target"]["name"] == "linkwork":
            return message["executable"]
    raise SystemExit("cargo did not say where the program is")


def cost(command):
    """Seconds from start to end of a process, and those of the processor among them."""
    with open(os.devnull, "wb") as nowhere:
        begun = time.perf_counter()
        child = subprocess.Popen(command, stdout=nowhere, stderr=nowhere)
        _, status, used = os.wait4(child.pid, 0)
        seconds = time.perf_counter() - begun
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{' '.join(command)} ended with {child.returncode}")
    return seconds, used.ru_utime + used.ru_stime


def memory(command):
    """The most memory that a run of scripts had, in bytes.

    What the kernel tells of a child that ended counts the memory of its parent too: a last
    script that never comes keeps the program waiting, and it is looked at then.
    """
    pipe = subprocess.PIPE
    child = subprocess.Popen([*command, "-"], stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL)
    room = pathlib.Path("/proc") / str(child.pid)
    n_asleep = 0
    while n_asleep < 10:
        time.sleep(0.02)
        is_asleep = (room / "stat").read_text().rpartition(")")[2].split()[0] == "S"
        n_asleep = n_asleep + 1 if is_asleep else 0
    lines = (room / "status").read_text().splitlines()
    kib = next(int(line.split()[1]) for line in lines if line.startswith("VmHWM"))
    child.communicate()
    return kib * 1024


def table(head, rows):
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def interpreter(name, packages):
    """A Python that has packages of others, in an environment of that name."""
    room = ROOT / "benches" / "peers" / "target" / "others" / name
    if not (room / "bin" / "python").exists():
        venv.create(room, with_pip=True)
        pip = [room / "bin" / "python", "-m", "pip", "--quiet", "install", *packages]
        subprocess.run(pip, check=True)
    return str(room / "bin" / "python")
