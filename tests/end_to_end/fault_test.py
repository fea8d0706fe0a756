"""Each fault of the virtual machine gives a named problem or is survived; none gives a wrong number.

Usage: fault_test.py [FAULT ...]"""

import bisect
import csv
import os
import sys

from virtual_machine import VirtualMachine, cli, run_in_folder, write_json

# What a device that is broken, now and then or for good (":always"), must be called.
BROKEN = {"stuck-sensor": "stuck", "dead-sensor": "dead", "camera-freeze": "frozen", "camera-occluded": "occluded",
          "mark-occluded": "reference 2"}
LINK_NAMES = {"busy": "machine_busy", "late": "machine_silent", "wrong-transaction": "machine_bad_reply",
              "truncated": "machine_silent", "drop": "machine_link_lost", "bytewise": "reply_in_pieces"}


# Faults that come and go last the last 600 s (sensor) or 300 s (camera) of each 1800 s: whenever the run begins, it
# sees one of them whole. A busy machine reads a sensor every 20 or 30 s, and a stuck one is told after some 17 readings.
# The link's faults come all the time.
def short_plan(folder, fault):
    duration_s = 1000 if fault in LINK_NAMES else 2500
    return write_json(os.path.join(folder, "plan.json"), {
        "name": "short", "sample_period_s": 10, "measure_period_s": 60, "measure_position_mm": {"X": 0, "Y": 0, "Z": 0},
        "steps": [{"duration_s": duration_s, "spindle_rpm": 3000, "coolant_on": True, "path": "cycle"}]})


def begin_of_turning_s(rows, time, speed):
    """Between these two moments the spindle began to turn."""
    first = next(i for i, row in enumerate(rows) if row[speed] > 0)
    return rows[max(0, first - 1)][time], rows[first][time]


def recorded_numbers_are_true(folder, job, machine):
    """Every recorded error, X, Y and Z, is the machine's truth at that moment, counted from the first of them.

    The two clocks are matched at the spindle's start, which the recording knows to the time between two of its samples
    (late replies stretch it): of the offsets between, the one that fits best counts. The machine drifts up to 2 um/min;
    2 um are allowed."""
    out = os.path.join(folder, "recording.csv")
    cli("recording", "--job", job, "--out", out)
    with open(out, newline="") as file:
        rows = [{key: float(value) if value else float("nan") for key, value in row.items()}
                for row in csv.DictReader(file)]
    truth = machine.truth_rows()
    _, began_s = begin_of_turning_s(truth, "time_s", "spindle_rpm")
    earliest_s, latest_s = begin_of_turning_s(rows, "time_s", "spindle_rpm")
    times = [row["time_s"] for row in truth]
    measured = {axis: [(row["time_s"], row[f"d{axis}_um"]) for row in rows if row[f"d{axis}_um"] == row[f"d{axis}_um"]]
                for axis in "XYZ"}

    def worst_of(offset_s):
        worst = (0.0, "")
        for axis, values in measured.items():
            if len(values) < 2:
                continue
            true = [truth[min(bisect.bisect_left(times, time_s + offset_s), len(truth) - 1)][f"thermal_d{axis}_um"]
                    for time_s, _ in values]
            start = true[0] - values[0][1]
            for (time_s, value), expected in zip(values, true):
                said = f"{axis} at {time_s:.0f} s: {value + start:.2f} um recorded, {expected:.2f} um true"
                worst = max(worst, (abs(value + start - expected), said))
        return worst

    steps = max(1, round(latest_s - earliest_s))
    worst_um, said = min(worst_of(began_s - latest_s + i * (latest_s - earliest_s) / steps) for i in range(steps + 1))
    assert worst_um < 2.0, said
    return sum(len(values) for values in measured.values()), worst_um


def fault_run(folder, fault):
    folder = os.path.join(folder, fault.replace(":", "-"))
    os.mkdir(folder)
    plan = short_plan(folder, fault)
    job = os.path.join(folder, "job.zdj")
    # What covers the view goes after 300 machine seconds: a busy computer, too, measures within five of its own.
    speedup = 60 if fault in ("camera-occluded", "mark-occluded") else 120
    # Drawing and reading pictures is most of the work; where no camera is at fault, half of them do.
    of_the_camera = fault.startswith(("camera", "mark"))
    pictures = [] if of_the_camera else ["--camera-fps", "10"]
    with VirtualMachine(folder, speedup, 3, "--fault", fault, *pictures) as machine:
        code, out, err = cli("machine", "check", "--profile", machine.profile, "--json", check=False, timeout=120)
        said = err
        if code == 0:
            said += out
        code2, out2, err2 = cli("record", "--profile", machine.profile, "--plan", plan, "--job", job, "--json",
                                check=False, timeout=300)
        said += err2 + out2
        count, worst_um = 0, 0.0
    if os.path.exists(job) and code2 == 0:
        count, worst_um = recorded_numbers_are_true(folder, job, machine)
    print(f"{fault}: check {code}, record {code2}, {count} errors recorded, at most {worst_um:.2f} um wrong: "
          f"{err2.strip()[:200]}", flush=True)
    assert code in (0, 1) and code2 in (0, 1), (code, code2, err, err2)
    if code2 == 1:
        assert len(err2.strip()) > 20, "a refusal without words"
    word = (BROKEN | LINK_NAMES).get(fault.removesuffix(":always"))
    said = said.replace(folder, "")  # the fault's name is in the folder's
    assert word is None or word in said.lower(), f"{fault} was not named: {said[:2000]}"
    if fault in LINK_NAMES:
        assert code2 == 0, f"{fault}: a sporadic fault of the link ended the run: {err2}"
        assert count > 5


def all_faults(folder):
    faults = sys.argv[1:] or list(LINK_NAMES) + list(BROKEN) + [fault + ":always" for fault in BROKEN]
    for fault in faults:
        fault_run(folder, fault)


if __name__ == "__main__":
    run_in_folder(all_faults)
