"""Starts the programs under test for the end-to-end tests: the virtual machine tool and the command line."""

import csv
import json
import os
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time

BIN = os.environ.get("ZERODRIFT_BIN_DIR") or os.path.join(os.path.dirname(__file__), "../../build/release/bin")

# Durations are judged in `./check --long` alone, which does one thing at a time: a busy computer is late.
judges_durations = os.environ.get("ZERODRIFT_LONG", "0") not in ("", "0")


class VirtualMachine:
    """zerodrift-machine on free ports; `with VirtualMachine(seed=1) as machine: machine.profile ...`"""

    def __init__(self, folder, speedup=240, seed=1, *extra):
        self.profile = os.path.join(folder, "profile.json")
        self.truth = os.path.join(folder, "truth.csv")
        self.command = [os.path.join(BIN, "zerodrift-machine"), "--speedup", str(speedup), "--seed", str(seed),
                        "--port", "0", "--camera-port", "0", "--profile", self.profile, "--truth", self.truth, *extra]

    def __enter__(self):
        self.process = subprocess.Popen(self.command, stdout=subprocess.PIPE, text=True)
        while True:
            line = self.process.stdout.readline()
            if line.startswith("ready "):
                self.ready = dict(word.split("=", 1) for word in line.split()[1:])
                return self
            if not line:
                raise RuntimeError("zerodrift-machine ended before it was ready")

    def __exit__(self, *unused):
        self.process.send_signal(signal.SIGTERM)
        try:
            self.process.wait(20)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def truth_rows(self):
        with open(self.truth, newline="") as file:
            return [{k: float(v) if v else float("nan") for k, v in row.items()} for row in csv.DictReader(file)]


def rows_on_disk(job):
    """Rows that a reader beside the writer sees: what was committed, and so acknowledged."""
    if not os.path.exists(job):
        return 0
    try:
        with sqlite3.connect(f"file:{job}?mode=ro", uri=True, timeout=5) as database:
            chunks = database.execute("SELECT coalesce(sum(rows), 0) FROM chunk").fetchone()[0]
            return chunks + database.execute("SELECT count(*) FROM open_row").fetchone()[0]
    except sqlite3.OperationalError:
        return 0  # being made


def cli(*arguments, check=True, timeout=600):
    """Runs zerodrift-cli; returns (exit code, stdout, stderr)."""
    done = subprocess.run([os.path.join(BIN, "zerodrift-cli"), *map(str, arguments)], capture_output=True, text=True,
                          timeout=timeout)
    if check and done.returncode != 0:
        raise AssertionError(f"zerodrift-cli {' '.join(map(str, arguments))}: exit {done.returncode}\n"
                             f"{done.stdout}\n{done.stderr}")
    return done.returncode, done.stdout, done.stderr


def write_json(path, value):
    with open(path, "w") as file:
        json.dump(value, file, indent=1)
    return path


def warm_up_plan(hours=4.0, measure_period_s=120):
    """A stepped warm-up with a rest, as a service engineer would run it."""
    def step(share, rpm, coolant):
        return {"duration_s": hours * 3600 * share, "spindle_rpm": rpm, "coolant_on": coolant,
                "path": "cycle" if rpm else "still"}
    return {"name": "warm-up", "sample_period_s": 10, "measure_period_s": measure_period_s,
            "measure_position_mm": {"X": 0, "Y": 0, "Z": 0},
            "steps": [step(0.5, 3000, True), step(0.2, 6000, True), step(0.15, 1500, False), step(0.15, 0, False)]}


def run_in_folder(test):
    """Runs a test in a temporary folder that is removed when it passes."""
    started = time.time()
    with tempfile.TemporaryDirectory() as folder:
        test(folder)
    print(f"passed in {time.time() - started:.0f} s")
    sys.exit(0)
