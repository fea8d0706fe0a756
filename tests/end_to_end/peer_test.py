"""A Modbus peer that no one here wrote (pymodbus) serves the documented register map and is commissioned; mbpoll reads
back from the virtual machine what was pushed to it.

Usage: peer_test.py"""

import json
import os
import re
import subprocess
import sys
import time

from virtual_machine import VirtualMachine, cli, run_in_folder, warm_up_plan, write_json

HERE = os.path.dirname(os.path.abspath(__file__))


def commission_the_peer(folder):
    profile = os.path.join(folder, "peer.json")
    server = subprocess.Popen([sys.executable, os.path.join(HERE, "../controller/peer_server.py"), "--port", "0",
                               "--profile", profile, "--speedup", "480"], stdout=subprocess.PIPE, text=True)
    try:
        assert server.stdout.readline().strip(), "the peer did not start"
        deadline = time.time() + 20
        while not os.path.exists(profile) and time.time() < deadline:
            time.sleep(0.1)
        plan = write_json(os.path.join(folder, "plan.json"), warm_up_plan(hours=2.0, measure_period_s=60))
        job = os.path.join(folder, "peer.zdj")
        _, out, _ = cli("commission", "--profile", profile, "--plan", plan, "--job", job, "--report",
                        os.path.join(folder, "peer.html"), "--yes", "--json")
        result = json.loads(out)
        print("pymodbus peer:", result["peak_error_before_um"], result["peak_error_after_um"], result["table_version"])
        assert result["table_version"] >= 1
        assert result["peak_error_after_um"]["Z"] < result["peak_error_before_um"]["Z"] / 3
    finally:
        server.terminate()
        server.wait(10)


def mbpoll_words(port, address, count):
    words = []
    while count > 0:
        block = min(count, 100)
        out = subprocess.run(["mbpoll", "-m", "tcp", "-p", str(port), "-a", "1", "-0", "-r", str(address), "-c", str(block),
                              "-t", "4:hex", "-1", "-q", "127.0.0.1"], capture_output=True, text=True, check=True).stdout
        words += [int(word, 16) for word in re.findall(r"\]:\s+0x([0-9A-Fa-f]{1,4})", out)]
        address += block
        count -= block
    return words


def table_is_read_back(folder):
    table = {"format": "zerodrift-table/1", "machine": "", "version": 1, "axes": {
        axis: {"temperature": {"offset_um": 0.5, "reference_position_mm": 0, "terms": [
            {"sensor": "T1_C", "um_per_K": factor, "reference_C": 21.0},
            {"sensor": "T3_C", "um_per_K": -0.5 * factor, "reference_C": 22.0}]},
            "limits": {"max_um": 150, "max_um_per_s": 2}} for axis, factor in (("X", 0.4), ("Y", -0.7), ("Z", 2.1))},
        "valid": {"T1_C": [10, 60]}}
    with VirtualMachine(folder, 1, 2) as machine:
        with open(machine.profile) as file:
            table["machine"] = json.load(file)["name"]
        path = write_json(os.path.join(folder, "table.json"), table)
        cli("push", "--profile", machine.profile, "--table", path, "--yes")
        count = mbpoll_words(machine.ready["modbus"], 210, 1)[0]
        words = mbpoll_words(machine.ready["modbus"], 4000, count)
        staged = mbpoll_words(machine.ready["modbus"], 1000, count)
        crc = mbpoll_words(machine.ready["modbus"], 208, 2)
    import struct
    import zlib
    assert len(words) == count > 40
    assert words == staged, "the active table is not the one that was staged"
    assert zlib.crc32(b"".join(struct.pack(">H", word) for word in words)) == (crc[0] << 16 | crc[1])
    # The words of axis Z, decoded here from the documented layout: compensation = -error.
    at = 2
    for axis in range(3):
        number, terms, points, _ = words[at:at + 4]
        floats = struct.unpack(">4f", b"".join(struct.pack(">H", word) for word in words[at + 4:at + 12]))
        at += 12
        first = struct.unpack(">f", struct.pack(">HH", *words[at + 1:at + 3]))[0]
        expected = -(0.4, -0.7, 2.1)[number]
        assert number == axis and terms == 2 and points == 0
        assert abs(first - expected) < 1e-6 and abs(floats[0] + 0.5) < 1e-6, (first, floats)
        at += 7 * terms
    print(f"mbpoll: {count} registers as pushed")


def peers(folder):
    table_is_read_back(folder)
    commission_the_peer(folder)


if __name__ == "__main__":
    run_in_folder(peers)
