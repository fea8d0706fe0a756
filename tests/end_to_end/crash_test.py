"""kill -9 at random moments while a table is written into the machine and while a model is fitted: the machine's table is
the old one or the new one, whole; what is on the disk is a whole file or none; and the next try works.

Usage: crash_test.py [COUNT]"""

import json
import os
import random
import signal
import subprocess
import sys
import time

from rollback_test import table
from virtual_machine import BIN, VirtualMachine, cli, run_in_folder, write_json


def killed(command, life_s):
    """True when it was killed; False when it had ended before."""
    run = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        run.wait(life_s)
        return False
    except subprocess.TimeoutExpired:
        run.send_signal(signal.SIGKILL)
        run.wait()
        return True


def length_of(command):
    started = time.monotonic()
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
    return time.monotonic() - started


def active(profile, folder):
    _, out, _ = cli("read-back", "--profile", profile, "--out", os.path.join(folder, "back.json"), "--json")
    return json.loads(out)["words"]


def uploads(folder, count):
    os.environ["ZERODRIFT_STATE_DIR"] = os.path.join(folder, "state")
    dice = random.Random(11)
    counts = {"old": 0, "new": 0, "ended": 0}
    with VirtualMachine(folder, 240, 3) as machine:
        with open(machine.profile) as file:
            name = json.load(file)["name"]
        files = [write_json(os.path.join(folder, f"{i}.json"), table(name, 3.0 + i, 100)) for i in range(2)]
        commands = [[os.path.join(BIN, "zerodrift-cli"), "push", "--profile", machine.profile, "--table", file, "--yes"]
                    for file in files]
        life_s = length_of(commands[0])
        words = [active(machine.profile, folder)]
        length_of(commands[1])
        words.append(active(machine.profile, folder))
        assert words[0] != words[1]
        now = 1
        for index in range(count):
            was_killed = killed(commands[1 - now], dice.uniform(0.0, 1.1 * life_s))
            found = active(machine.profile, folder)
            assert found in words, f"kill {index}: a table that nobody wrote is active"
            counts["ended" if not was_killed else "new" if found == words[1 - now] else "old"] += 1
            assert was_killed or found == words[1 - now], "done, and the old table is active"
            now = words.index(found)
        cli("push", "--profile", machine.profile, "--table", files[1 - now], "--yes")
        assert active(machine.profile, folder) == words[1 - now], "after all the kills an upload works"
    print(f"{count} uploads: {counts['old']} killed with the old table active, {counts['new']} with the new one, "
          f"{counts['ended']} had ended; none half")


def fits(folder, count):
    dice = random.Random(12)
    recording = os.path.join(folder, "r.csv")
    with open(recording, "w") as file:
        file.write("time_s," + ",".join(f"T{i}_C" for i in range(1, 13)) + ",dZ_um\n")
        for row in range(1500):
            warm = 1 - 2.718 ** (-row / 400)
            cells = [20 + (i + 1) * warm + dice.gauss(0, 0.05) for i in range(12)]
            file.write(f"{10 * row}," + ",".join(f"{c:.3f}" for c in cells) + f",{40 * warm + dice.gauss(0, 0.2):.2f}\n")
    out = os.path.join(folder, "model.json")
    command = [os.path.join(BIN, "zerodrift-cli"), "fit", "--recording", recording, "--out", out]
    life_s = length_of(command)
    whole = 0
    for index in range(count):
        if index % 2 == 0 and os.path.exists(out):
            os.remove(out)
        killed(command, dice.uniform(0.0, 1.1 * life_s))
        if os.path.exists(out):
            with open(out) as file:
                json.load(file)
            whole += 1
    length_of(command)
    cli("predict", "--model", out, "--recording", recording, "--out", os.path.join(folder, "p.csv"))
    print(f"{count} fits killed: {whole} times a whole model, else none")


def test(folder):
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    uploads(folder, count)
    fits(folder, count)


if __name__ == "__main__":
    run_in_folder(test)
