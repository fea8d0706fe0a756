"""One rule of consent for every entrance (docs/access.md): a commissioning and a correction write with --yes or after a
yes on a terminal; without either they refuse before anything moves. What is written stands in the audit trail, the switch
too, and a job that is complete is not done again.

Usage: consent_test.py"""

import json
import os
import pty
import re
import subprocess
import threading
import time

from virtual_machine import BIN, VirtualMachine, cli, judges_durations, rows_on_disk, run_in_folder, warm_up_plan, write_json


def words(profile, folder):
    _, out, _ = cli("read-back", "--profile", profile, "--out", os.path.join(folder, "back.json"), "--json")
    return json.loads(out)["words"]


def trail(job):
    _, out, _ = cli("audit", "--job", job, "--json")
    return [(entry["action"], entry["result"]) for entry in json.loads(out)["entries"]]


def on_a_terminal(answers, *arguments, seen=None):
    """Runs zerodrift-cli on a terminal of its own; each answer is typed when its question has come. `seen` is told what
    stands there."""
    main, other = pty.openpty()
    process = subprocess.Popen([os.path.join(BIN, "zerodrift-cli"), *arguments], stdin=other, stdout=other, stderr=other,
                               close_fds=True)
    os.close(other)
    shown = ""
    answers = list(answers)
    while True:
        try:
            read = os.read(main, 4096).decode(errors="replace")
        except OSError:  # the other end is closed
            break
        if not read:
            break
        shown += read
        if seen:
            seen(shown)
        if answers and answers[0][0] in shown:
            os.write(main, (answers.pop(0)[1] + "\n").encode())
    code = process.wait(600)
    os.close(main)
    return code, shown


def refused(*arguments):
    started = time.time()
    code, out, err = cli(*arguments, check=False)
    assert code == 1 and "not confirmed" in err and "--yes" in err, (arguments, code, out, err)
    assert time.time() - started < 10 or not judges_durations, "refused at the end of the work instead of at its beginning"


def test(folder):
    os.environ["ZERODRIFT_STATE_DIR"] = os.path.join(folder, "state")
    os.environ["XDG_CONFIG_HOME"] = os.path.join(folder, "config")
    plan = write_json(os.path.join(folder, "plan.json"), warm_up_plan(0.75))
    job = os.path.join(folder, "job.zdj")
    report = os.path.join(folder, "report.html")
    with VirtualMachine(folder, 240, 3) as machine:
        run = ["commission", "--profile", machine.profile, "--plan", plan, "--report", report, "--job", job]
        before = words(machine.profile, folder)
        refused(*run)
        assert not os.path.exists(job), "a refused commissioning leaves nothing behind"
        # A table that is active already is switched off, and the trail says so.
        with open(machine.profile) as file:
            name = json.load(file)["name"]
        other = {"format": "zerodrift-table/1", "machine": name, "version": 1,
                 "axes": {"X": {"temperature": {"offset_um": 1.0, "reference_position_mm": 0, "terms": []},
                                "points": [], "limits": {"max_um": 150, "max_um_per_s": 2}}}, "valid": {}}
        cli("push", "--profile", machine.profile, "--yes", "--table",
            write_json(os.path.join(folder, "other.json"), other))
        foreign = words(machine.profile, folder)
        assert foreign != before
        code, shown = on_a_terminal([("Engineer", "ann"), ("Switching the compensation off", "yes"),
                                     ("Writing the table", "no")], *run)
        assert code == 1 and "Writing the table was not confirmed" in shown, (code, shown[-2000:])
        assert words(machine.profile, folder) == foreign, "a no is a no"
        # The table that was active compensates again.
        switched = 2 * [("switch compensation", "started"), ("switch compensation", "done")]
        assert trail(job) == switched, trail(job)
        # Stopped while it measures.
        stopped = os.path.join(folder, "stopped.zdj")
        process = subprocess.Popen([os.path.join(BIN, "zerodrift-cli"), *run[:-1], stopped, "--yes"],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while rows_on_disk(stopped) == 0 and process.poll() is None:
            time.sleep(0.1)
        process.terminate()
        _, said = process.communicate(timeout=120)
        assert process.returncode == 1 and "cancelled" in said and "Nothing was changed" not in said, said
        assert trail(stopped) == switched, trail(stopped)
        # Gone on with: what was measured and analysed is current, and the yes is given.
        code, shown = on_a_terminal([("Writing the table", "yes")] + 2 * [("Writing the table", "yes")], *run)
        assert code == 0, shown[-2000:]
        _, out, _ = cli("audit", "--job", job, "--json")
        for entry in json.loads(out)["entries"]:
            if entry["action"] in ("upload table", "correct table"):
                assert re.match(r"version \d+, \d+ registers", entry["old"]), entry["old"]
                assert json.loads(entry["new"])["version"] > int(entry["old"].split()[1].strip(",")), entry["old"]
        actions = [action for action, result in trail(job) if result == "done"]
        assert actions[:4] == ["switch compensation", "switch compensation", "test offset", "upload table"], actions
        written = words(machine.profile, folder)
        assert written != foreign
        refused("verify", "--profile", machine.profile, "--job", job, "--correct")
        # Complete: nothing is measured, fitted or written again.
        started = time.time()
        entries = len(trail(job))
        _, out, _ = cli(*run, "--yes", "--json")
        if json.loads(out)["verdict"] == "passed" and len(trail(job)) == entries:
            assert time.time() - started < 60 or not judges_durations
            assert words(machine.profile, folder) == written
        another_table_meanwhile(machine, job, os.path.join(folder, "other.json"))
    elsewhere = os.path.join(folder, "elsewhere")
    os.mkdir(elsewhere)
    with VirtualMachine(elsewhere, 240, 4) as machine:
        code, _, err = cli("verify", "--profile", machine.profile, "--job", job, check=False)
        assert code == 1 and "serial" in err, "a job of another machine is not verified here: " + err


def another_table_meanwhile(machine, job, table):
    """While one program measures, no other writes a table: what was measured would prove nothing."""
    measuring = threading.Event()
    written = []

    def write():
        measuring.wait(300)
        written.append(cli("push", "--profile", machine.profile, "--yes", "--table", table, check=False))

    writer = threading.Thread(target=write)
    writer.start()
    # The progress says when the run is under way.
    code, said = on_a_terminal([], "verify", "--profile", machine.profile, "--job", job,
                               seen=lambda shown: re.search(r"[1-9]\d* % ", shown) and measuring.set())
    measuring.set()
    writer.join()
    assert code == 0, said[-2000:]
    refused_code, _, err = written[0]
    assert refused_code == 1 and "another Zerodrift program, process" in err, written


if __name__ == "__main__":
    run_in_folder(test)
