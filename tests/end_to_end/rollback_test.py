"""An upload taken back from the command line, on the virtual machine at the speed of a real one: the table before is
active, whole and known within 5 s, for a small and for a full table; twice taken back is two tables back; any version can
be chosen; everything that was active stays in the list; and what was not written from here is not guessed at.

Usage: rollback_test.py"""

import json
import os
import time

from virtual_machine import VirtualMachine, cli, judges_durations, run_in_folder, write_json


def table(name, size_um, points):
    axis = {"temperature": {"offset_um": size_um, "reference_position_mm": 0, "terms": [
                {"sensor": "T1_C", "um_per_K": 0.3, "reference_C": 21.0}]},
            "points": [{"position_mm": 2.0 * i, "error_up_um": size_um * (i % 7) / 7, "error_down_um": 0.5}
                       for i in range(points)],
            "limits": {"max_um": 150, "max_um_per_s": 2}}
    return {"format": "zerodrift-table/1", "machine": name, "version": 1, "axes": {"X": axis}, "valid": {"T1_C": [-50, 90]}}


def words(profile, folder):
    _, out, _ = cli("read-back", "--profile", profile, "--out", os.path.join(folder, "back.json"), "--json")
    return json.loads(out)["words"]


def listed(profile):
    _, out, _ = cli("rollback", "--profile", profile, "--list", "--json")
    entries = json.loads(out)
    assert [entry["active"] for entry in entries] == [False] * (len(entries) - 1) + [True], "the last one is active"
    times = [entry["time"] for entry in entries]
    assert times == sorted(times) and all(len(text) == 24 and text.endswith("Z") for text in times), times
    return [(entry["version"], entry["kind"], entry["of_version"]) for entry in entries]


def rolled_back(profile, *more):
    start = time.monotonic()
    _, out, _ = cli("rollback", "--profile", profile, "--yes", "--json", *more)
    whole_s = time.monotonic() - start
    record = json.loads(out)
    assert record["state"] == "done", record["state"]
    steps = {step["state"]: step["time"] for step in record["steps"]}
    return whole_s, record, steps


def test(folder):
    os.environ["ZERODRIFT_STATE_DIR"] = os.path.join(folder, "state")
    with VirtualMachine(folder, 1, 3) as machine:
        with open(machine.profile) as file:
            name = json.load(file)["name"]
        small = write_json(os.path.join(folder, "small.json"), table(name, 3.0, 4))
        full = write_json(os.path.join(folder, "full.json"), table(name, 6.0, 240))
        code, _, err = cli("rollback", "--profile", machine.profile, "--yes", check=False)
        assert code == 1 and err.strip(), "there is nothing to go back to, and it says so"
        empty = words(machine.profile, folder)
        cli("push", "--profile", machine.profile, "--table", small, "--yes")
        first = words(machine.profile, folder)
        code, _, _ = cli("rollback", "--profile", machine.profile, check=False)
        assert code == 1 and words(machine.profile, folder) == first, "without --yes nobody is asked here: refused"
        cli("push", "--profile", machine.profile, "--table", full, "--yes")
        second = words(machine.profile, folder)
        assert len(second) > 1900 and second != first
        for wanted, what in ((first, "full -> small"), (empty, "small -> none")):
            seconds, record, steps = rolled_back(machine.profile)
            print(f"{what}: {seconds:.2f} s in all, ramp included; {len(record['new_words'])} registers")
            back = words(machine.profile, folder)
            assert back == wanted or (not wanted and len(back) <= 2), "the table before is not what is active"
            assert seconds < 5.0 or not judges_durations, f"{seconds:.2f} s"
        code, _, _ = cli("rollback", "--profile", machine.profile, "--yes", check=False)
        assert code == 1, "nothing is left to go back to"
        chain = [(0, "found", None), (1, "upload", None), (2, "upload", None), (3, "rollback", 1), (4, "rollback", 0)]
        assert listed(machine.profile) == chain, listed(machine.profile)
        # Any version at once, forward as well as back.
        seconds, record, _ = rolled_back(machine.profile, "--to", "2")
        print(f"none -> full: {seconds:.2f} s in all; {record['steps']}")
        assert words(machine.profile, folder) == second and record["rolled_back_to"] == 2
        assert seconds < 5.0 or not judges_durations, f"{seconds:.2f} s"
        assert listed(machine.profile) == chain + [(5, "rollback", 2)]
        code, _, err = cli("rollback", "--profile", machine.profile, "--to", "77", "--yes", check=False)
        assert code == 1 and "77" in err, err
        # A table that came from elsewhere in between: the history of this computer does not fit it.
        cli("push", "--profile", machine.profile, "--table", small, "--yes")
        own = os.environ["ZERODRIFT_STATE_DIR"]
        os.environ["ZERODRIFT_STATE_DIR"] = os.path.join(folder, "another")
        cli("push", "--profile", machine.profile, "--table", full, "--yes")
        # The larger table back to the one before, from the computer that wrote it.
        seconds, _, _ = rolled_back(machine.profile)
        assert seconds < 5.0 and words(machine.profile, folder) == first
        cli("push", "--profile", machine.profile, "--table", full, "--yes")
        os.environ["ZERODRIFT_STATE_DIR"] = own
        code, _, err = cli("rollback", "--profile", machine.profile, "--yes", check=False)
        assert code == 1 and "not written from here" in err, err
        assert words(machine.profile, folder) == second
        rolled_back(machine.profile, "--to", "1")  # chosen by a person: done, and the stranger's is kept as well
        assert words(machine.profile, folder) == first
        assert [kind for _, kind, _ in listed(machine.profile)[-3:]] == ["upload", "found", "rollback"]


if __name__ == "__main__":
    run_in_folder(test)
