"""The main job, from an empty folder to the report, judged by the machine's own truth.

Usage: commission_test.py SEED [SEED ...]"""

import json
import os
import sys
import time

from virtual_machine import VirtualMachine, cli, judges_durations, run_in_folder, warm_up_plan, write_json

LARGEST_Z_BEFORE_UM = 40.0  # at least
LARGEST_Z_AFTER_UM = 5.0    # at most
LONGEST_S = 300.0


def commission(folder, seed):
    folder = os.path.join(folder, str(seed))
    os.mkdir(folder)
    plan = write_json(os.path.join(folder, "plan.json"), warm_up_plan())
    job = os.path.join(folder, "job.zdj")
    report = os.path.join(folder, "report.pdf")
    with VirtualMachine(folder, 240, seed) as machine:
        started = time.time()
        _, out, _ = cli("commission", "--profile", machine.profile, "--plan", plan, "--job", job, "--report", report,
                        "--yes", "--json")
        took = time.time() - started
    result = json.loads(out)
    rows = machine.truth_rows()
    start, end = result["verification_machine_time_s"]
    before = max(abs(row["thermal_dZ_um"]) for row in rows if row["time_s"] < start)
    after = max(abs(row["dZ_um"]) for row in rows if start <= row["time_s"] <= end)
    print(f"seed {seed}: {took:.0f} s, true |dZ| before {before:.1f} um, after {after:.2f} um, measured before "
          f"{result['peak_error_before_um']['Z']:.1f}, after {result['peak_error_after_um']['Z']:.2f}, "
          f"sensors {result['sensors']}, {result['verdict']}", flush=True)
    assert took < LONGEST_S or not judges_durations, f"took {took:.0f} s"
    assert before > LARGEST_Z_BEFORE_UM, before
    assert after < LARGEST_Z_AFTER_UM, after
    assert os.path.getsize(report) > 10_000
    figures_equal_the_job(folder, job, result)


def figures_equal_the_job(folder, job, result):
    """The report's figures and the command's answer are the job's, to the digit shown."""
    table = os.path.join(folder, "report.csv")
    cli("report", "--job", job, "--out", table)
    import csv
    with open(table, newline="") as file:
        shown = {row["figure"]: row["value"] for row in csv.DictReader(file)}
    for direction, peak in result["peak_error_after_um"].items():
        assert abs(float(shown[f"peak_after_{direction}_um"]) - peak) <= 0.0500001, (shown, result)
    for direction, peak in result["peak_error_before_um"].items():
        assert abs(float(shown[f"peak_before_{direction}_um"]) - peak) <= 0.0500001, (shown, result)


if __name__ == "__main__":
    run_in_folder(lambda folder: [commission(folder, int(seed)) for seed in sys.argv[1:] or ["1"]])
