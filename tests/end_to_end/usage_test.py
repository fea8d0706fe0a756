"""Wrong usage of the command line ends with 2 and a sentence, and a file that is read is never written over. What came
to nothing ends with 1 and says what, and the window's program leaves no option aside without a word.

Usage: usage_test.py"""

import os
import random
import shutil
import signal
import struct
import subprocess
import time
import zlib

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
    refused_frames(folder)
    pipes(folder, recording)
    window(folder)


def grey_png(path, width, height, value):
    """value(x, y) -> 0..255"""
    rows = b"".join(b"\0" + bytes(value(x, y) for x in range(width)) for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def refused_frames(folder):
    """No frame measured: the file says why of each, and the command does not end as if all were well."""
    draw = random.Random(3)
    spots = [[draw.choice((30, 220)) for _ in range(20)] for _ in range(15)]
    template = os.path.join(folder, "template.png")
    grey_png(template, 160, 120, lambda x, y: spots[y // 8][x // 8])
    frames = os.path.join(folder, "frames")
    os.mkdir(frames)
    for i in range(2):
        grey_png(os.path.join(frames, f"{i}.png"), 160, 120, lambda x, y: 128)
    out = os.path.join(folder, "positions.csv")
    done = subprocess.run([os.path.join(BIN, "zerodrift-cli"), "locate", "--template", template, "--roi", "40,30,80,60",
                           "--frames", frames, "--out", out], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and "none of 2 frames" in done.stderr, (done.returncode, done.stderr)
    with open(out) as file:
        rows = file.read().splitlines()
    assert len(rows) == 3 and all(",0," in row for row in rows[1:]), rows


def pipes(folder, recording):
    """A pipe is read to its end; one that nobody writes to is given up at the first signal."""
    cli = os.path.join(BIN, "zerodrift-cli")
    out = os.path.join(folder, "clusters.json")
    done = subprocess.run(["bash", "-c", f"'{cli}' cluster --recording <(sleep 0.3; cat '{recording}') --out '{out}'"],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and os.path.exists(out), (done.returncode, done.stderr)
    silent = os.path.join(folder, "silent.csv")
    os.mkfifo(silent)
    for told in (signal.SIGINT, signal.SIGTERM):
        waiting = subprocess.Popen([cli, "cluster", "--recording", silent, "--out", out], stderr=subprocess.PIPE,
                                   text=True)
        time.sleep(1.0)
        assert waiting.poll() is None
        waiting.send_signal(told)
        _, said = waiting.communicate(timeout=10)
        assert waiting.returncode == 1 and "cancelled" in said, (waiting.returncode, said)
    # Writing into a pipe that nobody reads cannot be given up half way: the second signal ends the program.
    waiting = subprocess.Popen([cli, "cluster", "--recording", recording, "--out", silent], stderr=subprocess.PIPE)
    time.sleep(2.0)
    waiting.send_signal(signal.SIGTERM)
    time.sleep(1.0)
    waiting.send_signal(signal.SIGTERM)
    waiting.communicate(timeout=10)
    assert waiting.returncode == -signal.SIGTERM, waiting.returncode


def window(folder):
    program = os.path.join(BIN, "zerodrift")
    if not os.path.exists(program):
        return
    quiet = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "HOME": folder}

    def run(program, *arguments):
        return subprocess.run([program, *arguments], capture_output=True, text=True, timeout=120, env=quiet)

    tour = os.path.join(folder, "tour")
    for arguments in (("--size", "1280x720"), ("--fault", "drop"), ("--demo", "--size", "1280x720"),
                      ("--tour", tour, "--size", "big"), ("--tour", tour, "job.zdj")):
        done = run(program, *arguments)
        assert done.returncode == 2 and "--" in done.stderr, (arguments, done.returncode, done.stderr)
    # Without its resources a tour ends and names what is not there.
    alone = os.path.join(folder, "alone")
    os.mkdir(alone)
    for name in ("zerodrift", "zerodrift-machine"):
        shutil.copy(os.path.join(BIN, name), alone)
    done = run(os.path.join(alone, "zerodrift"), "--tour", tour)
    assert done.returncode == 1 and "register_maps" in done.stderr, (done.returncode, done.stderr)


if __name__ == "__main__":
    run_in_folder(check)
    print("wrong usage is named and writes nothing")
