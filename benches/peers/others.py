"""Fetches the programs that are only run beside ours, and says how each is started.

python-solvespace is under the GPL and planegcs under the LGPL: neither is linked, both run as
processes of their own. Each goes into a folder below `target/` that this makes.
"""

import pathlib
import shutil
import subprocess
import sys
import venv

HERE = pathlib.Path(__file__).resolve().parent
ROOM = HERE / "target" / "others"

SOLVESPACE = "python-solvespace==3.0.8"
PLANEGCS = "@salusoft89/planegcs@1.3.0"


def quietly(*command, **options):
    """Runs a command; whether it went well."""
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=sys.stderr, **options)
    return done.returncode == 0


def solvespace():
    """The command that runs SolveSpace's solver, or none."""
    python = ROOM / "venv" / "bin" / "python"
    if not python.exists():
        venv.create(ROOM / "venv", with_pip=True)
    if not quietly(python, "-c", "import python_solvespace", stdin=subprocess.DEVNULL):
        if not quietly(python, "-m", "pip", "--quiet", "install", SOLVESPACE):
            return None
    return f"{python} {HERE / 'beside' / 'solvespace.py'}"


def planegcs():
    """The command that runs planegcs, or none."""
    if shutil.which("npm") is None:
        return None
    room = ROOM / "npm"
    if not (room / "node_modules" / "@salusoft89").exists():
        room.mkdir(parents=True, exist_ok=True)
        (room / "package.json").write_text('{"private": true}\n')
        if not quietly("npm", "install", "--silent", PLANEGCS, cwd=room):
            return None
    return f"node {HERE / 'beside' / 'planegcs.mjs'} {room}"


def commands():
    """The name and command of each that can be had."""
    found = {"python-solvespace": solvespace(), "planegcs (wasm)": planegcs()}
    for name, command in found.items():
        if command is None:
            print(f"{name} is not to be had here; its row is left out", file=sys.stderr)
    return {name: command for name, command in found.items() if command}


if __name__ == "__main__":
    for name, command in commands().items():
        print(f"{name}={command}")
