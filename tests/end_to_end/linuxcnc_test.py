"""A real LinuxCNC, headless and simulated, loads what `export` wrote: what it adds to the command is the table's
compensation in sign and size, both directions, both file types, beyond the ends too. Then a thermal offset at run time:
the host compensator writes it over Modbus to a server no one here wrote (pymodbus), LinuxCNC's mb2hal reads it, and the
shipped HAL file limits it, adds it between motor command and drive, and takes it out when the compensator dies.

Usage: linuxcnc_test.py   Exit code 77: linuxcnc-uspace is not installed (apt-get install linuxcnc-uspace)."""

import json
import os
import pwd
import random
import shutil
import socket
import subprocess
import sys
import time

from virtual_machine import BIN, cli, run_in_folder, write_json

HERE = os.path.dirname(os.path.abspath(__file__))
SKIPPED = 77
PYTHON = "/usr/bin/python3"  # the one that has the module linuxcnc

INI = """[EMC]
MACHINE = zerodrift-test
VERSION = 1.1
DEBUG = 0
[DISPLAY]
DISPLAY = {folder}/drive
[TASK]
TASK = milltask
CYCLE_TIME = 0.01
[RS274NGC]
PARAMETER_FILE = {folder}/linuxcnc.var
[EMCMOT]
EMCMOT = motmod
COMM_TIMEOUT = 1.0
SERVO_PERIOD = 1000000
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = {folder}/tool.tbl
[HAL]
HALFILE = {folder}/test.hal
[KINS]
KINEMATICS = trivkins coordinates=X
JOINTS = 1
[TRAJ]
COORDINATES = X
LINEAR_UNITS = mm
ANGULAR_UNITS = degree
MAX_LINEAR_VELOCITY = 400
DEFAULT_LINEAR_VELOCITY = 100
[AXIS_X]
MIN_LIMIT = -2000
MAX_LIMIT = 2000
MAX_VELOCITY = 400
MAX_ACCELERATION = 4000
[JOINT_0]
TYPE = LINEAR
HOME = 0
HOME_SEQUENCE = 0
MIN_LIMIT = -2000
MAX_LIMIT = 2000
MAX_VELOCITY = 400
MAX_ACCELERATION = 4000
FERROR = 5
MIN_FERROR = 5
{compensation}
"""

HAL = """loadrt trivkins coordinates=X
loadrt motmod servo_period_nsec=1000000 num_joints=1
addf motion-command-handler servo-thread
addf motion-controller servo-thread
net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net tool-prepare iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net tool-change iocontrol.0.tool-change => iocontrol.0.tool-changed
net motor joint.0.motor-pos-cmd => joint.0.motor-pos-fb
{thermal}
"""

# The gateway of the shipped register map: temperatures, switch, heartbeat, offsets, and a clock in tenths of a second.
GATEWAY = """import sys, threading, time
from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server import StartTcpServer
block = ModbusSequentialDataBlock(0, [0] * 200)
block.setValues(10, [int(word) for word in sys.argv[2].split(",")])
block.setValues(40, [1])
def clock():
    started = time.monotonic()
    while True:
        time.sleep(0.05)
        tenths = int(10 * (time.monotonic() - started))
        block.setValues(60, [tenths >> 16, tenths & 0xFFFF])
threading.Thread(target=clock, daemon=True).start()
slave = ModbusSlaveContext(hr=block, zero_mode=True)
StartTcpServer(context=ModbusServerContext(slaves=slave, single=True), address=("127.0.0.1", int(sys.argv[1])))
"""


def own(path):
    """LinuxCNC refuses to run as root: then nobody runs it and owns the folder."""
    if os.geteuid() == 0:
        nobody = pwd.getpwnam("nobody")
        os.chown(path, nobody.pw_uid, nobody.pw_gid)


def run_linuxcnc(folder, compensation, thermal, asked, when_driven=None):
    """Drives the joint through the positions asked for; the rows of driven.json. `when_driven` is called once the drive
    script has left a file "moved"."""
    os.makedirs(folder)
    shutil.copy(os.path.join(HERE, "linuxcnc_drive.py"), folder)
    files = {"test.ini": INI.format(folder=folder, compensation=compensation), "test.hal": HAL.format(thermal=thermal),
             "tool.tbl": "T1 P1 D0 Z0 ;none\n", "linuxcnc.var": "",
             "drive": f"#!/bin/sh\nexec {PYTHON} {folder}/linuxcnc_drive.py \"$@\"\n"}
    for name, text in files.items():
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)
        os.chmod(os.path.join(folder, name), 0o755)
        own(os.path.join(folder, name))
    write_json(os.path.join(folder, "drive.json"), asked)
    own(folder)
    environment = {"HOME": folder, "PATH": "/usr/bin:/bin", "LANG": "C"}
    as_nobody = {"user": "nobody", "group": "nogroup", "extra_groups": []} if os.geteuid() == 0 else {}
    with open(os.path.join(folder, "said"), "w+") as said:
        running = subprocess.Popen(["linuxcnc", os.path.join(folder, "test.ini")], cwd=folder, env=environment,
                                   stdout=said, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, **as_nobody)
        deadline = time.monotonic() + 180
        while running.poll() is None and time.monotonic() < deadline:
            time.sleep(0.1)
            if when_driven is not None and os.path.exists(os.path.join(folder, "moved")):
                when_driven()
                when_driven = None
        running.terminate()
        running.wait(30)
        said.seek(0)
        text = said.read()
    result = os.path.join(folder, "driven.json")
    if not os.path.exists(result):
        raise AssertionError("LinuxCNC did not finish the moves:\n" + text[-3000:])
    assert "too many compensation entries" not in text, text
    with open(result) as file:
        rows = json.load(file)
    assert isinstance(rows, list), rows
    return rows


def interpolated(points, x, column):
    if x <= points[0][0]:
        return points[0][column]
    for a, b in zip(points, points[1:]):
        if x <= b[0]:
            return a[column] + (x - a[0]) / (b[0] - a[0]) * (b[column] - a[column])
    return points[-1][column]


def random_axis(seed, count):
    """Uneven positions, errors of some 20 um with a reversal of some 6 um."""
    random.seed(seed)
    x, points, drift = -120.0, [], 0.0
    for _ in range(count):
        drift += random.uniform(-3.0, 3.0)
        points.append((round(x, 3), round(drift, 2), round(drift + 6.0 + random.uniform(-2.0, 2.0), 2)))
        x += random.uniform(8.0, 40.0)
    return points


def there_and_back(points, seed):
    """Joints, between them, and beyond both ends."""
    random.seed(seed)
    inside = [p[0] for p in points[::4]]
    inside += [round(random.uniform(points[0][0], points[-1][0]), 3) for _ in range(10)]
    way = sorted(inside) + [points[-1][0] + 30.0]
    return [points[0][0] - 40.0] + way + way[-2::-1] + [points[0][0] - 30.0]


def table_of(points):
    return {"format": "zerodrift-table/1", "machine": "", "version": 1, "axes": {"X": {"points": [
        {"position_mm": x, "error_up_um": up, "error_down_um": down, "um_per_K": 0.0} for x, up, down in points]}}}


def exported_files(folder):
    for file_type in (0, 1):
        points = random_axis(7 + file_type, 40)
        table = write_json(os.path.join(folder, f"table{file_type}.json"), table_of(points))
        out = os.path.join(folder, f"x{file_type}.comp")
        result = json.loads(cli("export", "--table", table, "--format", "linuxcnc", "--type", file_type, "--out", out,
                                "--json")[1])
        os.chmod(out, 0o644)
        asked = {"positions_mm": there_and_back(points, 3), "feed_mm_min": 20000}
        rows = run_linuxcnc(os.path.join(folder, f"type{file_type}"),
                            f"COMP_FILE = {out}\nCOMP_FILE_TYPE = {file_type}", "", asked)
        wrong = raw = left = 0.0
        last = 0.0
        for row in rows:
            column = 1 if row["x_mm"] > last else 2
            last = row["x_mm"]
            error = interpolated(points, row["joint_mm"], column)
            added = 1000.0 * (row["motor_mm"] - row["joint_mm"])
            wrong = max(wrong, abs(added + error))
            raw = max(raw, abs(error))
            left = max(left, abs(1000.0 * (row["motor_mm"] - row["joint_mm"]) +
                                 interpolated(points, row["motor_mm"], column)))
        print(f"linuxcnc type {file_type}: {len(rows)} positions, error {raw:.3f} um, left {left:.3f} um; the trim is "
              f"-error within {wrong:.4f} um")
        assert raw > 8.0
        assert wrong <= result["loss_um"] + 0.002, wrong
        assert left < 0.02, left


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def shipped(name):
    with open(os.path.join(HERE, "../../resources/linuxcnc", name)) as file:
        return file.read()


def thermal_offset(folder):
    """2 um/K at 29.5 C against 20 C is an error of +19 um, so -19 um are added; and the offset is taken out by
    LinuxCNC's own watchdog when the compensator is killed."""
    port = free_port()
    profile = write_json(os.path.join(folder, "profile.json"), {
        "format": "zerodrift-profile/1", "name": "gateway",
        "controller": {"kind": "modbus-tcp", "host": "127.0.0.1", "port": port, "unit": 1,
                       "register_map": "linuxcnc-gateway"},
        "sensors": [{"channel": "T1_C"}, {"channel": "T2_C"}], "limits": {"max_um": 100, "max_um_per_s": 20}})
    model = model_of(folder)
    config = os.path.join(folder, "mb2hal.ini")
    with open(config, "w") as file:
        file.write(shipped("thermal-offset-mb2hal.ini").replace("TCP_PORT=1502", f"TCP_PORT={port}"))
    os.chmod(config, 0o644)
    hal = shipped("thermal-offset.hal").replace("config=thermal-offset-mb2hal.ini", f"config={config}")
    hal += "\nnet motor => zd-offset-x.in0\n"
    server = subprocess.Popen([PYTHON, "-c", GATEWAY, str(port), "295,200"])
    time.sleep(2.0)
    compensator = subprocess.Popen([os.path.join(BIN, "zerodrift-cli"), "compensate", "--profile", profile, "--model",
                                    model, "--period", "0.1"], stdout=subprocess.DEVNULL)
    try:
        # 4 s after the last move the drive script ends the compensator without a chance to run to 0.
        rows = run_linuxcnc(os.path.join(folder, "thermal"), "", hal,
                            {"positions_mm": [1.0, 2.0, 3.0, 4.0], "feed_mm_min": 5000, "thermal": True, "wait_s": 1.5,
                             "then": "watch"}, lambda: compensator.kill())
    finally:
        for process in (compensator, server):
            process.terminate()
            process.wait(30)
    moved, after = rows[-2], rows[-1]
    print(f"linuxcnc thermal offset: {1000 * moved['offset_mm']:.2f} um added for an error of +19 um; "
          f"{1000 * after['offset_mm']:.2f} um after the compensator was killed")
    assert abs(moved["offset_mm"] + 0.019) < 0.0002, moved
    assert abs(moved["drive_mm"] - moved["motor_mm"] - moved["offset_mm"]) < 1e-9, moved
    assert after["offset_mm"] == 0.0, after


def model_of(folder):
    """A recording whose error is exactly 2 um/K (T1 - 20), and its fit."""
    recording = os.path.join(folder, "r.csv")
    random.seed(5)
    with open(recording, "w") as file:
        file.write("time_s,spindle_rpm,T1_C,T2_C,dX_um\n")
        t1 = 20.0
        for i in range(400):
            t1 += 0.004 * (36.0 - t1) if i < 250 else 0.01 * (20.0 - t1)
            t2 = 20.0 + 0.3 * random.random()
            file.write(f"{30 * i},{3000 if i < 250 else 0},{t1:.4f},{t2:.4f},{2.0 * (t1 - 20.0):.4f}\n")
    model = os.path.join(folder, "model.json")
    cli("fit", "--recording", recording, "--sensors", "T1_C", "--errors", "dX_um", "--method", "mlr", "--out", model)
    return model


def linuxcnc(folder):
    os.chmod(folder, 0o755)
    exported_files(folder)
    thermal_offset(folder)


if __name__ == "__main__":
    if shutil.which("linuxcnc") is None:
        print("skipped: linuxcnc-uspace is not installed (./check --with-linuxcnc installs it)")
        sys.exit(SKIPPED)
    run_in_folder(linuxcnc)
