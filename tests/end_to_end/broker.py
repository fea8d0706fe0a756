"""A real MQTT broker for the tests."""

import os
import shutil
import socket
import subprocess
import time


class Broker:
    """A mosquitto on a free port of this computer."""

    def __init__(self, folder):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.port = free.getsockname()[1]
        self.configuration = os.path.join(folder, "mosquitto.conf")
        with open(self.configuration, "w") as file:
            file.write(f"listener {self.port} 127.0.0.1\nallow_anonymous true\npersistence false\n")
        self.program = shutil.which("mosquitto") or "/usr/sbin/mosquitto"

    def start(self):
        self.process = subprocess.Popen([self.program, "-c", self.configuration], stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)

    def stop(self):
        self.process.terminate()
        self.process.wait(10)

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *unused):
        self.stop()

    def messages(self, count, wait_s=20):
        """Topic -> (text, retained) of the first messages, from any topic of the shop."""
        command = ["mosquitto_sub", "-h", "127.0.0.1", "-p", str(self.port), "-t", "shop/#", "-C", str(count), "-W",
                   str(wait_s), "-F", "%t %r %p"]
        lines = subprocess.run(command, capture_output=True, text=True).stdout.splitlines()
        return {topic: (text, retained == "1") for topic, retained, text in (line.split(" ", 2) for line in lines)}


def wait_for(what, wait_s=20):
    end = time.time() + wait_s
    while time.time() < end:
        result = what()
        if result:
            return result
        time.sleep(0.2)
    raise AssertionError("it did not come")
