"""Runs inside LinuxCNC as its display: homes the joint, moves through the positions asked for and writes what the motor
is told beside what the joint is told. Positions come from drive.json beside the INI file; results go to driven.json."""

import json
import os
import sys
import time

import hal
import linuxcnc


def pin(name):
    return hal.get_value(name)  # in full; halcmd prints seven digits


def wait_until(condition, what, seconds=30.0):
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            said = linuxcnc.error_channel().poll()
            raise RuntimeError(f"{what} did not happen within {seconds:.0f} s; LinuxCNC says {said}")
        time.sleep(0.01)


def start(command, status):
    def polled(test):
        def look():
            status.poll()
            return test()
        return look

    command.state(linuxcnc.STATE_ESTOP_RESET)
    command.wait_complete()
    command.state(linuxcnc.STATE_ON)
    wait_until(polled(lambda: status.task_state == linuxcnc.STATE_ON), "machine on")
    command.mode(linuxcnc.MODE_MANUAL)
    command.wait_complete()
    command.home(0)
    wait_until(polled(lambda: status.homed[0]), "homing")
    command.mode(linuxcnc.MODE_MDI)
    command.wait_complete()


def settled():
    """The trim is slewed: read until the motor rests."""
    last = None
    while True:
        now = (pin("joint.0.pos-cmd"), pin("joint.0.motor-pos-cmd"))
        if now == last:
            return now
        last = now
        time.sleep(0.05)


def thermal():
    return {"offset_mm": pin("zd-limit-x.out"), "drive_mm": pin("zd-offset-x.out")}


def main():
    folder = os.path.dirname(sys.argv[sys.argv.index("-ini") + 1])
    with open(os.path.join(folder, "drive.json")) as file:
        asked = json.load(file)
    component = hal.component("zerodrift-drive")  # pins are read by components only
    component.ready()
    try:
        result = drive(asked)
    except RuntimeError as error:
        result = {"failed": str(error)}
    with open(os.path.join(folder, "driven.json"), "w") as file:
        json.dump(result, file)


def drive(asked):
    command, status = linuxcnc.command(), linuxcnc.stat()
    start(command, status)
    rows = []
    for x in asked["positions_mm"]:
        command.mdi(f"G1 F{asked['feed_mm_min']} X{x:.6f}")
        command.wait_complete(60)
        wait_until(lambda: abs(pin("joint.0.pos-cmd") - x) < 1e-5, f"the move to {x}")
        joint, motor = settled()
        rows.append({"x_mm": x, "joint_mm": joint, "motor_mm": motor})
        if asked.get("thermal"):
            time.sleep(asked["wait_s"])
            rows[-1].update(thermal())
    if asked.get("then") == "watch":
        with open("moved", "w"):
            pass
        time.sleep(8.0)
        rows.append(thermal())
    return rows


if __name__ == "__main__":
    main()
