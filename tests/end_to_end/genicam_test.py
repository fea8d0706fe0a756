"""camera list and camera show against Aravis' fake GigE Vision camera on the loopback, and machine-readable answers where
there is no camera. Ends with 77, skipped, where the package aravis-tools is not installed."""

import fcntl
import json
import os
import subprocess
import sys
import tempfile
import time

from virtual_machine import BIN, run_in_folder

FAKE = "/usr/bin/arv-fake-gv-camera-0.8"


def cli(*arguments):
    return subprocess.run([os.path.join(BIN, "zerodrift-cli"), *arguments], capture_output=True, text=True, timeout=120)


def listed(serial):
    cameras = json.loads(cli("camera", "list", "--json").stdout)["cameras"]
    return next((camera for camera in cameras if camera["serial"] == serial), None)


def check(folder):
    serial = f"ZD{os.getpid()}L"
    picture = os.path.join(folder, "picture.png")
    # The protocol has one port: one fake camera on this computer at a time.
    name = os.path.join(tempfile.gettempdir(), "zerodrift_fake_gige_camera.lock")
    if not os.path.exists(name):
        open(name, "a").close()
    with open(name) as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        camera = subprocess.Popen([FAKE, "-i", "127.0.0.1", "-s", serial], stdout=subprocess.DEVNULL)
        try:
            until = time.time() + 60
            while not listed(serial):
                assert time.time() < until, "the fake camera is not found"
            found = listed(serial)
            assert found["url"] == "aravis:" + serial and found["kind"] == "gige-vision", found
            assert (found["vendor"], found["model"], found["address"]) == ("Aravis", "Fake", "127.0.0.1"), found
            assert serial in cli("camera", "list").stdout
            # A busy computer without the right to read ahead loses whole pictures for a while.
            shown = None
            while not shown or shown.returncode != 0:
                assert time.time() < until, shown.stderr
                shown = cli("camera", "show", "--url", "aravis:" + serial, "--out", picture, "--exposure-us", "5000",
                            "--json")
            answer = json.loads(shown.stdout)
            assert (answer["width_px"], answer["height_px"]) == (512, 512), answer
            assert answer["serial"] == serial and answer["exposure_us"] == 5000, answer
            assert answer["health"]["pictures"] >= 5 and 0 < answer["brightness"]["mean"] < 255, answer
            with open(picture, "rb") as file:
                assert file.read(8) == b"\x89PNG\r\n\x1a\n"
            refused = cli("camera", "show", "--url", "aravis:no-such-serial", "--out", picture + ".png")
            assert refused.returncode == 1 and serial in refused.stderr, refused.stderr
        finally:
            camera.kill()
            camera.wait()
    assert cli("camera").returncode == 2
    assert cli("camera", "show", "--out", picture).returncode == 2


if not os.path.exists(FAKE):
    print("skipped: the package aravis-tools, the fake GigE camera, is not installed")
    sys.exit(77)
run_in_folder(check)
