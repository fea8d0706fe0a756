"""kill -9 during the warm-up run, at random moments: the job opens, nothing acknowledged is lost, the run resumes.

Usage: kill_test.py [COUNT]"""

import json
import os
import random
import signal
import subprocess
import sys
import time

from virtual_machine import BIN, VirtualMachine, cli, rows_on_disk, run_in_folder, warm_up_plan, write_json


def killed_runs(folder, count):
    dice = random.Random(7)
    # Three to four minutes of machine time pass with each kill: the run must not end before the last.
    plan = write_json(os.path.join(folder, "plan.json"), warm_up_plan(hours=4.0 + 0.1 * count, measure_period_s=300))
    job = os.path.join(folder, "job.zdj")
    with VirtualMachine(folder, 60, 1) as machine:
        command = [os.path.join(BIN, "zerodrift-cli"), "record", "--profile", machine.profile, "--plan", plan, "--job", job]
        before = 0
        while before == 0:  # the calibration comes first; then the kills begin
            run = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            deadline = time.time() + 120
            while rows_on_disk(job) == 0 and time.time() < deadline and run.poll() is None:
                time.sleep(0.2)
            assert run.poll() is None, "the run ended before it was killed"
            before = rows_on_disk(job)
            assert before > 0, "nothing was recorded in two minutes"
            run.send_signal(signal.SIGKILL)
            run.wait()
        for index in range(count):
            run = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            acknowledged = before
            patience = time.time() + 60
            while acknowledged <= before and time.time() < patience and run.poll() is None:
                acknowledged = max(acknowledged, rows_on_disk(job))
                time.sleep(0.01)
            deadline = time.time() + dice.uniform(0.0, 2.5)
            while time.time() < deadline:
                acknowledged = max(acknowledged, rows_on_disk(job))
                time.sleep(0.01)
            assert acknowledged > before, "the resumed run records nothing"
            assert run.poll() is None, f"the resumed run ended by itself with {run.returncode}"
            run.send_signal(signal.SIGKILL)
            run.wait()
            out = os.path.join(folder, "recording.csv")
            _, text, _ = cli("recording", "--job", job, "--out", out, "--json")
            stored = json.loads(text)["rows"]
            print(f"kill {index + 1}: acknowledged {acknowledged}, stored {stored}", flush=True)
            assert stored >= acknowledged, "acknowledged samples were lost"
            before = stored
        names = [line.split(",")[0] for line in open(out)]
        times = [float(value) for value in names[1:]]
        assert all(a < b for a, b in zip(times, times[1:])), "time went back"


if __name__ == "__main__":
    run_in_folder(lambda folder: killed_runs(folder, int(sys.argv[1]) if len(sys.argv) > 1 else 20))
