"""Who may write: without a PIN everybody, with one only who has it; what was written stands in a trail that shows every
change; a camera's password is nowhere but in the profile it came in; and nothing listens but what was started to listen,
and that at 127.0.0.1 alone.

Usage: access_test.py"""

import json
import os
import sqlite3
import subprocess
import time

from rollback_test import table, words
from virtual_machine import BIN, VirtualMachine, cli, run_in_folder, write_json

SECRET = "s3cret-of-the-camera"


def refused(word, *arguments):
    code, out, err = cli(*arguments, check=False)
    assert code == 1 and word in err, (arguments, code, out, err)
    return err


def pin_file(folder, name, pin):
    path = os.path.join(folder, name)
    with open(path, "w") as file:
        file.write(pin + "\n")
    return path


def writing_needs_the_pin(folder, machine):
    with open(machine.profile) as file:
        name = json.load(file)["name"]
    push = ["push", "--profile", machine.profile, "--table",
            write_json(os.path.join(folder, "t.json"), table(name, 3.0, 4))]
    cli(*push, "--yes")  # no PIN is set
    right = pin_file(folder, "right", "2718281")
    wrong = pin_file(folder, "wrong", "2718282")
    refused("6 to 64", "access", "set-pin", "--new-pin-file", pin_file(folder, "short", "123"))
    cli("access", "set-pin", "--new-pin-file", right)
    kept = os.path.join(os.environ["XDG_CONFIG_HOME"], "zerodrift/access.json")
    assert os.stat(kept).st_mode & 0o777 == 0o600
    with open(kept) as file:
        assert "2718281" not in file.read()
    before = words(machine.profile, folder)  # reading needs no PIN
    cli("machine", "check", "--profile", machine.profile)
    cli(*push, "--dry-run")
    push[-1] = write_json(os.path.join(folder, "t2.json"), table(name, 5.0, 4))
    plan = write_json(os.path.join(folder, "plan.json"), {"name": "p", "sample_period_s": 10, "measure_period_s": 60,
                      "measure_position_mm": {"X": 0, "Y": 0, "Z": 0}, "steps": [{"duration_s": 60, "spindle_rpm": 0}]})
    job = os.path.join(folder, "new.zdj")
    refused("engineer", *push, "--yes")
    refused("PIN is not right", *push, "--yes", "--pin-file", wrong)
    refused("engineer", "rollback", "--profile", machine.profile, "--yes")
    refused("engineer", "record", "--profile", machine.profile, "--plan", plan, "--job", job)
    refused("engineer", "commission", "--profile", machine.profile, "--plan", plan, "--job", job, "--report",
            os.path.join(folder, "r.pdf"))
    assert words(machine.profile, folder) == before, "something was written all the same"
    cli(*push, "--yes", "--pin-file", right)
    assert words(machine.profile, folder) != before
    refused("PIN is not right", "access", "clear-pin", "--pin-file", wrong)
    cli("access", "clear-pin", "--pin-file", right)
    cli("rollback", "--profile", machine.profile, "--yes")


def secrets_stay_at_home(folder, machine):
    with open(machine.profile) as file:
        profile = json.load(file)
    for camera in profile["cameras"]:
        camera["url"] = camera["url"].replace("http://", f"http://ann:{SECRET}@")
    named = write_json(os.path.join(folder, "secret-profile.json"), profile)
    plan = write_json(os.path.join(folder, "plan.json"), {
        "name": "short", "sample_period_s": 10, "measure_period_s": 60, "measure_position_mm": {"X": 0, "Y": 0, "Z": 0},
        "steps": [{"duration_s": 600, "spindle_rpm": 3000, "coolant_on": True, "path": "cycle"}]})
    job = os.path.join(folder, "secret.zdj")
    said = "".join(cli("machine", "check", "--profile", named, "--json")[1:])
    said += "".join(cli("record", "--profile", named, "--plan", plan, "--job", job, "--json", timeout=300)[1:])
    for ending in ("html", "csv", "pdf"):
        report = os.path.join(folder, "r." + ending)
        said += "".join(cli("report", "--job", job, "--out", report)[1:])
    assert SECRET not in said
    for name in os.listdir(folder):
        path = os.path.join(folder, name)
        if name == "secret-profile.json" or not os.path.isfile(path):
            continue
        with open(path, "rb") as file:
            assert SECRET.encode() not in file.read(), f"the password stands in {name}"
    return job


def trail_shows_every_change(folder, job):
    trail = json.loads(cli("audit", "--job", job, "--json")[1])
    assert trail["whole"]
    with sqlite3.connect(job) as database:
        database.execute("INSERT INTO audit (utc, engineer, machine, action, subject, old_value, new_value, result, "
                         "previous_hash, hash) VALUES ('','','','upload table','','','','done','','')")
    refused("damaged", "audit", "--job", job)


def listening(process):
    """(address, port) of every socket of this process and its children that takes connections or datagrams."""
    inodes = set()
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{number}/stat") as file:
                parent = int(file.read().rsplit(")", 1)[1].split()[1])
            if process not in (int(number), parent):
                continue
            links = [os.readlink(f"/proc/{number}/fd/{name}") for name in os.listdir(f"/proc/{number}/fd")]
        except OSError:  # it has just ended
            continue
        inodes |= {link[8:-1] for link in links if link.startswith("socket:[")}
    found = set()
    for table_name, state in (("tcp", "0A"), ("tcp6", "0A"), ("udp", "07"), ("udp6", "07")):
        with open(f"/proc/{process}/net/{table_name}") as file:
            for row in map(str.split, file.readlines()[1:]):
                if row[3] == state and row[9] in inodes:
                    address, port = row[1].split(":")
                    found.add((address, int(port, 16)))
    return found


def nothing_listens_that_was_not_started(folder, machine):
    served = listening(machine.process.pid)
    assert len(served) >= 2, f"the machine and its cameras: {served}"
    assert {address for address, _ in served} == {"0100007F"}, f"127.0.0.1 alone: {served}"
    environment = dict(os.environ, QT_QPA_PLATFORM="offscreen", HOME=folder)
    window = subprocess.Popen([os.path.join(BIN, "zerodrift")], env=environment, stderr=subprocess.DEVNULL)
    try:
        for _ in range(20):
            time.sleep(0.25)
            assert window.poll() is None, "the window ended by itself"
            assert listening(window.pid) == set(), listening(window.pid)
    finally:
        window.kill()
        window.wait()


def test(folder):
    os.environ["ZERODRIFT_STATE_DIR"] = os.path.join(folder, "state")
    os.environ["XDG_CONFIG_HOME"] = os.path.join(folder, "config")
    with VirtualMachine(folder, 240, 3) as machine:
        nothing_listens_that_was_not_started(folder, machine)
        trail_shows_every_change(folder, secrets_stay_at_home(folder, machine))
        writing_needs_the_pin(folder, machine)  # it leaves the compensation on


if __name__ == "__main__":
    run_in_folder(test)
