"""Wrong usage of the command line ends with 2 and a sentence, and a file that is read is never written over.

Usage: usage_test.py"""

import os
import subprocess

from virtual_machine import BIN, run_in_folder


def usage(*arguments):
    done = subprocess.run([os.path.join(BIN, "zerodrift-cli"), *arguments], capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and done.stderr.strip(), (arguments, done.returncode, done.stderr)
    return done.stderr


def check(folder):
    recording = os.path.join(folder, "r.csv")
    with open(recording, "w") as file:
        file.write("time_s,T1_C,T2_C,dZ_um\n")
        for i in range(200):
            file.write(f"{30 * i},{20 + 0.05 * i},{20 + 0.02 * i},{0.1 * i}\n")
    with open(recording) as file:
        before = file.read()
    other = os.path.join(folder, "out.json")
    assert "--recording" in usage("fit", "--recording", recording, "--out", recording)
    usage("cluster", "--recording", recording, "--out", os.path.join(folder, ".", "r.csv"))
    with open(recording) as file:
        assert file.read() == before
    picture = os.path.join(folder, "frame.png")
    with open(picture, "wb") as file:
        file.write(b"a picture")
    assert "picture" in usage("fit", "--recording", recording, "--out", picture)
    with open(picture, "rb") as file:
        assert file.read() == b"a picture"
    machine = os.path.join(folder, "machine.json")
    with open(machine, "w") as file:
        file.write("{}")
    assert "same file" in usage("diagnose", "--machine", machine, "--recording", recording, "--out", other,
                                "--refined", other)
    for clusters in ("0", "-3", "abc"):
        usage("cluster", "--recording", recording, "--clusters", clusters, "--out", other)
    usage("cluster", "--recording", recording, "--seed", "-1", "--out", other)
    usage("cluster", "--recording", recording, "--errors", "dX_um,,dZ_um", "--out", other)
    usage("fit", "--recording", recording, "--coverage", "500", "--out", other)
    usage("fit", "--recording", recording, "--sensors", "", "--out", other)
    usage("fit", "--recording", recording, "--errors", ",", "--out", other)
    usage("export", "--table", other, "--format", "bogus", "--out", other)
    usage("axis-table", "--laser", recording, "--threshold", "2", "--out", other)
    usage("axis-table", "--laser", recording, "--start-points", "1", "--out", other)
    usage("axis-table", "--laser", recording, "--tolerance-um", "-1", "--out", other)
    usage()
    usage("no-such-command")
    assert not os.path.exists(other)


if __name__ == "__main__":
    run_in_folder(check)
    print("wrong usage is named and writes nothing")
