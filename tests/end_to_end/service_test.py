"""The host compensator as a service: tells its supervisor that it is ready, alive and ending; runs the offset to 0 and turns
the switch off again when it is asked to end, by whatever signal; and when it is killed, the controller's watchdog takes the offset out.

Usage: service_test.py"""

import os
import random
import shutil
import signal
import socket
import subprocess
import time

from virtual_machine import BIN, VirtualMachine, cli, run_in_folder

HERE = os.path.dirname(os.path.abspath(__file__))
UNIT = os.path.join(HERE, "../../installer/systemd/zerodrift-compensate@.service")


def model_of(folder):
    """Error dZ = 2 um/K (T1 - 15) over a wide range: some 10 um at the machine's start."""
    recording = os.path.join(folder, "r.csv")
    random.seed(2)
    with open(recording, "w") as file:
        file.write("time_s,T1_C,T2_C,dZ_um\n")
        for i in range(300):
            t1 = 12.0 + 0.1 * i if i < 200 else 32.0 - 0.1 * (i - 200)
            file.write(f"{30 * i},{t1:.3f},{20.0 + random.random():.3f},{2.0 * (t1 - 15.0):.3f}\n")
    model = os.path.join(folder, "model.json")
    cli("fit", "--recording", recording, "--sensors", "T1_C", "--errors", "dZ_um", "--method", "mlr", "--out", model)
    return model


class Supervisor:
    def __init__(self, folder):
        self.path = os.path.join(folder, "notify")
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self.socket.bind(self.path)
        self.socket.settimeout(30)

    def start(self, profile, model):
        return subprocess.Popen([os.path.join(BIN, "zerodrift-cli"), "compensate", "--profile", profile, "--model", model,
                                 "--period", "0.1", "--switch-on"], env={**os.environ, "NOTIFY_SOCKET": self.path},
                                stdout=subprocess.DEVNULL)

    def hear(self, wanted):
        """Messages until one has the wanted line."""
        heard = []
        while not heard or wanted not in heard[-1].split("\n"):
            heard.append(self.socket.recv(1000).decode())
        return heard


def word(port, address, count=1):
    out = subprocess.run(["mbpoll", "-m", "tcp", "-p", str(port), "-a", "1", "-0", "-r", str(address), "-c", str(count),
                          "-t", "4:float" if count == 2 else "4", *(["-B"] if count == 2 else []), "-1", "-q", "127.0.0.1"],
                         capture_output=True, text=True, check=True).stdout
    return float(out.split("]:")[1].split()[0])


def offset_z(machine):
    return word(machine.ready["modbus"], 144, 2)


def service(folder):
    model = model_of(folder)
    supervisor = Supervisor(folder)
    with VirtualMachine(folder, 10, 4) as machine:
        process = supervisor.start(machine.profile, model)
        supervisor.hear("READY=1")
        time.sleep(3.0)
        moved = offset_z(machine)
        assert moved < -3.0, moved
        alive = sum("WATCHDOG=1" in message for message in supervisor.hear("WATCHDOG=1"))
        process.send_signal(signal.SIGTERM)
        heard = supervisor.hear("STOPPING=1")
        assert process.wait(60) == 0
        assert any("ending" in message for message in heard), heard
        assert alive and offset_z(machine) == 0.0
        assert word(machine.ready["modbus"], 17) == 0, "the switch is not off again"
        # A terminal that is closed, Ctrl+\\, Ctrl+C: the same.
        for request in (signal.SIGHUP, signal.SIGQUIT, signal.SIGINT):
            process = supervisor.start(machine.profile, model)
            supervisor.hear("READY=1")
            time.sleep(2.0)
            assert offset_z(machine) < -3.0
            process.send_signal(request)
            assert process.wait(60) == 0, request
            assert offset_z(machine) == 0.0 and word(machine.ready["modbus"], 17) == 0, request
        process = supervisor.start(machine.profile, model)
        supervisor.hear("READY=1")
        time.sleep(3.0)
        assert offset_z(machine) < -3.0
        process.kill()
        process.wait()
        deadline = time.monotonic() + 30.0
        while offset_z(machine) != 0.0 and time.monotonic() < deadline:
            time.sleep(0.2)
        assert offset_z(machine) == 0.0, "the controller's watchdog did not take the offset out"
        assert word(machine.ready["modbus"], 147) == 2
    print(f"offset {moved:.2f} um; 0 after the end and after a kill")
    if shutil.which("systemd-analyze"):
        done = subprocess.run(["systemd-analyze", "verify", UNIT], capture_output=True, text=True)
        # What only an installed package has: the program, its user, its manual page.
        absent = ("not executable", "Unknown user", "Command 'man ")
        faults = [line for line in done.stderr.splitlines()
                  if "zerodrift-compensate" in line and not any(word in line for word in absent)]
        assert not faults, faults


if __name__ == "__main__":
    run_in_folder(service)
