"""Each fault of the virtual machine gives a named problem or is survived; none gives a wrong number.

Usage: fault_test.py [FAULT ...]"""

import os
import sys

from virtual_machine import VirtualMachine, cli, run_in_folder, write_json

LINK_FAULTS = ["busy", "late", "wrong-transaction", "truncated", "drop", "bytewise"]
# What a device that stays broken (":always") must be called.
LASTING = {"stuck-sensor": "stuck", "dead-sensor": "dead", "camera-freeze": "frozen", "camera-occluded": "occluded"}


def short_plan(folder):
    return write_json(os.path.join(folder, "plan.json"), {
        "name": "short", "sample_period_s": 10, "measure_period_s": 60, "measure_position_mm": {"X": 0, "Y": 0, "Z": 0},
        "steps": [{"duration_s": 1800, "spindle_rpm": 3000, "coolant_on": True, "path": "cycle"}]})


def recorded_numbers_are_true(folder, job, machine):
    """Every recorded error lies within 3 um of the machine's truth at that moment (it drifts up to 1 um/min)."""
    out = os.path.join(folder, "recording.csv")
    cli("recording", "--job", job, "--out", out)
    with open(out) as file:
        header = file.readline().strip().split(",")
        rows = [dict(zip(header, line.strip().split(","))) for line in file]
    values = [float(row["dZ_um"]) for row in rows if row.get("dZ_um")]
    truth = [row["thermal_dZ_um"] for row in machine.truth_rows()]
    low, high = min(truth), max(truth)
    for value in values:
        # Errors count from the start of the run, so the truth's range is widened by its own start.
        assert low - abs(truth[0]) - 3.0 <= value <= high + abs(truth[0]) + 3.0, (value, low, high)
    return len(values)


def fault_run(folder, fault):
    folder = os.path.join(folder, fault.replace(":", "-"))
    os.mkdir(folder)
    plan = short_plan(folder)
    job = os.path.join(folder, "job.zdj")
    with VirtualMachine(folder, 120, 3, "--fault", fault) as machine:
        code, out, err = cli("machine", "check", "--profile", machine.profile, "--json", check=False, timeout=120)
        said = err
        if code == 0:
            said += out
        code2, out2, err2 = cli("record", "--profile", machine.profile, "--plan", plan, "--job", job, "--json",
                                check=False, timeout=300)
        said += err2 + out2
        count = 0
    if os.path.exists(job) and code2 == 0:
        count = recorded_numbers_are_true(folder, job, machine)
    print(f"{fault}: check {code}, record {code2}, {count} errors recorded: {err2.strip()[:200]}", flush=True)
    assert code in (0, 1) and code2 in (0, 1), (code, code2, err, err2)
    if code2 == 1:
        assert len(err2.strip()) > 20, "a refusal without words"
    word = LASTING.get(fault.removesuffix(":always")) if fault.endswith(":always") else None
    assert word is None or word in said.lower(), f"{fault} was not named: {said[:2000]}"
    if fault in LINK_FAULTS:
        assert code2 == 0, f"{fault}: a sporadic fault of the link ended the run: {err2}"
        assert count > 5


def all_faults(folder):
    for fault in sys.argv[1:] or LINK_FAULTS + [fault + ":always" for fault in LASTING]:
        fault_run(folder, fault)


if __name__ == "__main__":
    run_in_folder(all_faults)
