"""Sweeps with Dask on two workers, kills one of them midway, and compares with a sweep in one go."""

import contextlib
import csv
import os
import signal
import subprocess
import threading
import time
from pathlib import Path

from dask.distributed import Client, LocalCluster
from recipe import sweep

GRID = ["--set", "b=3.2..5:0.02", "--set", "c=3,3.5,4"]
PARTS = 12


def kill_one(client, done, killed):
    """Kills a worker, and all that it started, once some parts are there and some are not."""
    while not done.is_set():
        begun = [path for path in Path("out").glob("part-*.csv") if path.stat().st_size > 0]
        if 2 <= len(begun) < PARTS:
            pid = next(iter(client.run(os.getpid).values()))
            children = subprocess.run(
                ["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True, check=False
            ).stdout.split()
            os.kill(pid, signal.SIGKILL)
            killed.append(pid)
            for child in children:
                # It may have ended by itself.
                with contextlib.suppress(ProcessLookupError):
                    os.kill(int(child), signal.SIGKILL)
            print("killed a worker after", len(begun), "parts were begun")
            return
        time.sleep(0.01)


if __name__ == "__main__":
    Path("out").mkdir()
    whole = ["linkwork", "sweep", "four-bar.link", *GRID, "--quiet", "--to", "whole.csv"]
    subprocess.run(whole, check=True)
    with LocalCluster(n_workers=2, threads_per_worker=1, processes=True) as cluster:
        with Client(cluster) as client:
            done, killed = threading.Event(), []
            killer = threading.Thread(target=kill_one, args=(client, done, killed))
            killer.start()
            heading, rows = sweep(client, "four-bar.link", GRID, "out", PARTS)
            done.set()
            killer.join()
    assert killed, "the sweep was over before a worker was killed: GRID is too small"
    with open("whole.csv", newline="") as table:
        expected_heading, *expected = csv.reader(table)
    assert heading == expected_heading, heading
    assert rows == expected, f"{len(rows)} rows, not the {len(expected)} of a sweep in one go"
    print(f"{len(rows)} rows in {PARTS} parts, the same as in one go")
