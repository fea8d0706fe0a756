"""kill -9 during the warm-up run, at random moments: the job opens, nothing acknowledged is lost, the run resumes.

Usage: kill_test.py [COUNT]"""

import json
import os
import random
import signal
import subprocess
import sys
import time

from virtual_machine import BIN, VirtualMachine, cli, run_in_folder, warm_up_plan, write_json


def rows_in(job, folder):
    """Rows of the recording in the job, by the program's own export."""
    out = os.path.join(folder, "recording.csv")
    cli("record", "--job", job, "--export", out)
    with open(out) as file:
        return sum(1 for _ in file) - 1


def killed_runs(folder, count, seed=1):
    dice = random.Random(seed)
    plan = write_json(os.path.join(folder, "plan.json"), warm_up_plan(hours=4.0, measure_period_s=300))
    job = os.path.join(folder, "job.zdj")
    with VirtualMachine(folder, 60, seed) as machine:
        command = [os.path.join(BIN, "zerodrift-cli"), "record", "--profile", machine.profile, "--plan", plan,
                   "--job", job, "--acknowledge"]
        cli("calibrate-machine", "--profile", machine.profile, "--job", job)
        before = 0
        for index in range(count):
            run = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            acknowledged = before
            deadline = time.time() + dice.uniform(2.0, 5.0)
            os.set_blocking(run.stdout.fileno(), False)
            text = ""
            while time.time() < deadline:
                text += run.stdout.read() or ""
                time.sleep(0.02)
            run.send_signal(signal.SIGKILL)
            run.wait()
            os.set_blocking(run.stdout.fileno(), True)
            text += run.stdout.read() or ""
            for line in text.splitlines():
                if line.startswith("stored "):
                    acknowledged = int(line.split()[1])
            stored = rows_in(job, folder)
            print(f"kill {index + 1}: acknowledged {acknowledged}, stored {stored}", flush=True)
            assert stored >= acknowledged, "acknowledged samples were lost"
            assert stored >= before
            before = stored
        assert before > 20, "the runs never recorded anything"


if __name__ == "__main__":
    run_in_folder(lambda folder: killed_runs(folder, int(sys.argv[1]) if len(sys.argv) > 1 else 20))
