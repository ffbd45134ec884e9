"""Prints the whole comparison: `python3 benches/peers/run.py [W1 W2 W5a ...]`."""

import pathlib
import subprocess
import sys

import others

HERE = pathlib.Path(__file__).resolve().parent

beside = []
for name, command in others.commands().items():
    beside += ["--beside", f"{name}={command}"]
manifest = ["--manifest-path", str(HERE / "Cargo.toml")]
cargo = ["cargo", "run", "--release", "--quiet", *manifest, "--", *sys.argv[1:], *beside]
sys.exit(subprocess.run(cargo).returncode)
