"""A controller has one owner among the programs; what is refused or broken off leaves nothing behind; a table goes to the
machine it was made for; the switch by itself.

Usage: owner_test.py"""

import json
import os
import pty
import signal
import subprocess
import time

from rollback_test import table, words
from virtual_machine import BIN, VirtualMachine, cli, run_in_folder, warm_up_plan, write_json


def refused(word, *arguments):
    code, out, err = cli(*arguments, check=False)
    assert code == 1 and word in err, (arguments, code, out, err)
    return err


def stopped_at(question, *arguments, typed=()):
    """Ctrl+C at a question on a terminal: the exit code, what was shown, and how long the end took."""
    main, other = pty.openpty()
    process = subprocess.Popen([os.path.join(BIN, "zerodrift-cli"), *map(str, arguments)], stdin=other, stdout=other,
                               stderr=other, close_fds=True)
    os.close(other)
    shown = ""
    typed = list(typed)
    asked = None
    while True:
        try:
            read = os.read(main, 4096).decode(errors="replace")
        except OSError:  # the other end is closed
            break
        shown += read
        if typed and typed[0][0] in shown:
            os.write(main, (typed.pop(0)[1] + "\n").encode())
        if asked is None and question in shown:
            time.sleep(0.2)
            asked = time.time()
            process.send_signal(signal.SIGINT)
    code = process.wait(60)
    took = time.time() - (asked or 0)
    os.close(main)
    return code, shown, took


def files_of(folder):
    return sorted(os.listdir(folder))


def broken_off_at_a_question(folder, machine, name):
    before = words(machine.profile, folder)
    new = write_json(os.path.join(folder, "new.json"), table(name, 3.0, 4))
    code, shown, took = stopped_at("Type yes", "push", "--profile", machine.profile, "--table", new)
    assert code == 1 and took < 1.0, (code, took, shown)
    assert words(machine.profile, folder) == before
    # Its name is asked before anything is made or moved.
    plan = write_json(os.path.join(folder, "plan.json"), warm_up_plan(0.5))
    there = files_of(folder)
    code, shown, took = stopped_at("Engineer", "commission", "--profile", machine.profile, "--plan", plan, "--job",
                                   os.path.join(folder, "job.zdj"), "--report", os.path.join(folder, "r.html"))
    assert code == 1 and took < 1.0 and "cancelled" in shown, (code, took, shown)
    assert files_of(folder) == there, files_of(folder)
    print(f"Ctrl+C at a question: ended within {took:.2f} s")


def refused_runs_leave_nothing(folder, machine):
    with open(machine.profile) as file:
        profile = json.load(file)
    profile["controller"].update({"port": 9, "timeout_ms": 200})
    nobody = write_json(os.path.join(folder, "nobody.json"), profile)
    plan = write_json(os.path.join(folder, "plan.json"), warm_up_plan(0.5))
    note = os.path.join(folder, "note.csv")
    with open(note, "w") as file:
        file.write("remark\nnothing to read here\n")
    there = files_of(folder)
    job = os.path.join(folder, "job.zdj")
    refused("No connection", "record", "--profile", nobody, "--plan", plan, "--job", job)
    refused("No connection", "commission", "--profile", nobody, "--plan", plan, "--job", job, "--report",
            os.path.join(folder, "r.html"), "--yes", "--engineer", "ann")
    refused("note.csv", "import", note, "--job", job)
    # With the compensation on, a run begins with a look at the machine and ends there.
    cli("compensation", "on", machine.profile, "--yes")
    refused("ON", "record", "--profile", machine.profile, "--plan", plan, "--job", job)
    cli("compensation", "off", machine.profile, "--yes")
    left = [one for one in files_of(folder) if one not in there]
    if left:  # what a calibration before it found is no empty file
        _, out, _ = cli("recording", "--job", job, check=False)
        assert left == ["job.zdj"] and os.path.getsize(job) > 100_000, left
        os.remove(job)
    where = os.path.join(folder, "not", "there")
    err = refused(where, "record", "--profile", machine.profile, "--plan", plan, "--job", os.path.join(where, "j.zdj"))
    assert "no folder" in err and "Choose a folder" in err, err


def one_owner(folder, machine, name):
    """Two programs at one machine: the second is refused before it moves or writes anything, and may look."""
    plan = write_json(os.path.join(folder, "plan.json"), warm_up_plan(4.0))
    new = write_json(os.path.join(folder, "new.json"), table(name, 3.0, 4))
    job = os.path.join(folder, "first.zdj")
    cli("compensation", "off", machine.profile, "--yes")  # a table that was pushed is on
    first = subprocess.Popen([os.path.join(BIN, "zerodrift-cli"), "record", "--profile", machine.profile, "--plan", plan,
                              "--job", job], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    deadline = time.time() + 120
    while time.time() < deadline and not os.path.exists(job):
        time.sleep(0.1)
    time.sleep(2.0)  # the job is made just before the machine is opened
    process = f"process {first.pid}"
    before = words(machine.profile, folder)  # reading stays possible
    cli("machine", "check", "--profile", machine.profile)
    cli("push", "--profile", machine.profile, "--table", new, "--dry-run")
    err = refused(process, "push", "--profile", machine.profile, "--table", new, "--yes")
    assert "another Zerodrift program" in err, err
    refused(process, "record", "--profile", machine.profile, "--plan", plan, "--job", os.path.join(folder, "second.zdj"))
    refused(process, "compensation", "on", machine.profile, "--yes")
    assert not os.path.exists(os.path.join(folder, "second.zdj"))
    assert words(machine.profile, folder) == before and first.poll() is None
    first.kill()  # however it ends
    first.communicate(timeout=60)
    cli("push", "--profile", machine.profile, "--table", new, "--yes")
    assert words(machine.profile, folder) != before
    print(f"one owner: refused by {process}")


def switch_by_itself(folder, machine):
    refused("--yes", "compensation", "on", machine.profile)
    _, out, _ = cli("compensation", "off", machine.profile, "--yes", "--json")
    _, out, _ = cli("compensation", "on", "--profile", machine.profile, "--yes", "--json")
    assert json.loads(out) == {"compensation_on": True, "was_on": False}, out
    _, out, _ = cli("compensation", "on", machine.profile, "--yes")
    assert "as it was" in out, out
    with open(os.path.join(folder, "state", next(f for f in os.listdir(os.path.join(folder, "state"))
                                                 if f.endswith(".jsonl")))) as file:
        switched = [line["on"] for line in map(json.loads, file) if line["line"] == "switch"]
    assert switched[-1] is True, switched
    _, out, _ = cli("rollback", "--profile", machine.profile, "--list", "--json")
    assert json.loads(out), "the history is read as before"
    cli("compensation", "off", machine.profile, "--yes")


def table_of_another_machine(folder, machine, other):
    """Two machines of one kind and name: the serial number tells them apart."""
    axis = os.path.join(folder, "axis.csv")
    with open(axis, "w") as file:
        file.write("position_mm,error_um\n" + "".join(f"{x},{0.02 * x}\n" for x in range(0, 401, 40)))
    cli("axis-table", "--laser", axis, "--out", os.path.join(folder, "axis.json"))
    made = os.path.join(folder, "made.json")
    cli("table", "--profile", machine.profile, "--axis-table", os.path.join(folder, "axis.json"), "--out", made)
    with open(machine.profile) as one, open(other.profile) as two:
        assert json.load(one)["name"] == json.load(two)["name"]
    cli("push", "--profile", machine.profile, "--table", made, "--yes")
    before = words(other.profile, folder)
    err = refused("serial", "push", "--profile", other.profile, "--table", made, "--yes")
    assert "machine" in err and words(other.profile, folder) == before, err
    # A profile that was copied and leads to another machine.
    with open(machine.profile) as one, open(other.profile) as two:
        profile, there = json.load(one), json.load(two)
    profile["controller"]["port"] = there["controller"]["port"]
    copied = write_json(os.path.join(folder, "copied.json"), profile)
    refused("serial", "push", "--profile", copied, "--table", made, "--yes")
    _, _, err = cli("push", "--profile", other.profile, "--table", os.path.join(folder, "axis.json"), "--dry-run")
    assert "does not say for which machine" in err, err


def test(folder):
    os.environ["ZERODRIFT_STATE_DIR"] = os.path.join(folder, "state")
    os.environ["XDG_CONFIG_HOME"] = os.path.join(folder, "config")
    os.mkdir(os.path.join(folder, "state"))
    elsewhere = os.path.join(folder, "elsewhere")
    os.mkdir(elsewhere)
    with VirtualMachine(folder, 240, 3) as machine, VirtualMachine(elsewhere, 240, 4) as other:
        with open(machine.profile) as file:
            name = json.load(file)["name"]
        broken_off_at_a_question(folder, machine, name)
        switch_by_itself(folder, machine)
        refused_runs_leave_nothing(folder, machine)
        table_of_another_machine(folder, machine, other)
        one_owner(folder, machine, name)


if __name__ == "__main__":
    run_in_folder(test)
