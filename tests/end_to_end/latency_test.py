"""A run measured with cameras that are late and slow, by a plan that leaves the measuring position to the profile.

Usage: latency_test.py [SEED [SPEEDUP [HOURS [LATENCY [FPS]]]]]

No recorded error may be further from the machine's own truth than LARGEST_UM, and every measurement has its latency and
its time of standstill beside it. Without a position in plan and profile nothing is begun."""

import json
import os
import sqlite3
import sys

from camera_test import Truth, run_rows
from virtual_machine import VirtualMachine, cli, run_in_folder, warm_up_plan, write_json

LARGEST_UM = 6.0  # machine time passes while one waits


def plan_without_position(folder, hours):
    plan = warm_up_plan(hours)
    del plan["measure_position_mm"]
    return write_json(os.path.join(folder, "plan.json"), plan)


def refused_without_any(folder, machine, plan):
    with open(machine.profile) as file:
        document = json.load(file)
    del document["measure_position_mm"]
    profile = write_json(os.path.join(folder, "nowhere.json"), document)
    for command in ("record", "commission"):
        job = os.path.join(folder, command + "-nowhere.zdj")
        more = ["--report", os.path.join(folder, "r.pdf"), "--yes"] if command == "commission" else []
        code, _, stderr = cli(command, "--profile", profile, "--plan", plan, "--job", job, *more, check=False)
        assert code == 1 and "where the errors are measured" in stderr, (command, code, stderr)
    rows = machine.truth_rows()
    assert all(row[f"{axis}_mm"] == 0.0 for row in rows for axis in "XYZ"), "nothing may move"


def settled(job):
    with sqlite3.connect(job) as database:
        found = database.execute("SELECT details FROM event WHERE kind = 'measured'").fetchall()
    return [view for row in found for view in json.loads(row[0])["views"]]


def late_cameras(folder, seed, speedup, hours, latency, fps):
    plan = plan_without_position(folder, hours)
    job = os.path.join(folder, "job.zdj")
    with VirtualMachine(folder, speedup, seed, "--camera-latency", latency, "--camera-fps", str(fps)) as machine:
        refused_without_any(folder, machine, plan)
        _, out, stderr = cli("record", "--profile", machine.profile, "--plan", plan, "--job", job, "--json",
                             timeout=3000)
    print(stderr.strip())
    made = json.loads(out)
    print(f"{made['measurements']} measurements, {made['refused']} refused, in {made['duration_s']:.0f} s")
    truth = Truth(machine.truth_rows())
    rows = run_rows(folder, job, "warm-up")
    first_s = next(time_s for time_s, row in rows if row["dZ_um"])
    largest = 0.0
    for axis in "XYZ":
        for time_s, row in rows:
            if not row[f"d{axis}_um"]:
                continue
            true_um = truth.error(time_s, axis) - truth.error(first_s, axis)
            largest = max(largest, abs(float(row[f"d{axis}_um"]) - true_um))
    views = settled(job)
    print(f"largest deviation from the truth {largest:.2f} um; latency "
          f"{min(v['latency_s'] for v in views):.2f} to {max(v['latency_s'] for v in views):.2f} s, spread up to "
          f"{max(v['spread_s'] for v in views):.2f} s, standstill {min(v['standstill_s'] for v in views):.2f} s at least")
    assert largest < LARGEST_UM, largest
    assert made["measurements"] - made["refused"] >= 5, made
    assert len(views) >= 2 * (made["measurements"] - made["refused"])
    assert all(v["standstill_s"] >= v["latency_s"] + v["spread_s"] - 1e-6 for v in views)


if __name__ == "__main__":
    words = sys.argv[1:]
    seed, speedup, hours, latency, fps = (words + ["1", "60", "1.0", "0.8:0.4", "8"][len(words):])[:5]
    run_in_folder(lambda folder: late_cameras(folder, int(seed), int(speedup), float(hours), latency, float(fps)))
