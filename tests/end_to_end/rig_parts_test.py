"""The parts of the virtual machine's rig, read with software that no one here wrote: mbpoll and pymodbus on the serial
line and at the amplifier, an XML parser for the agent, mosquitto_sub behind a real mosquitto; and the operator's
endpoint of --manual."""

import json
import os
import re
import subprocess
import time
import urllib.error
import urllib.request
import xml.etree.ElementTree as xml

from pymodbus.client import ModbusSerialClient, ModbusTcpClient
from pymodbus.payload import BinaryPayloadDecoder
from pymodbus.constants import Endian

from broker import Broker, wait_for
from virtual_machine import BIN, VirtualMachine, run_in_folder

STREAMS = "{urn:mtconnect.org:MTConnectStreams:1.5}"
ILLEGAL_ADDRESS = 2


def signed(words):
    return [word - 65536 if word >= 32768 else word for word in words]


def http(url, body=None):
    """(status, text)"""
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(url, data, {"Content-Type": "application/json"})
    try:
        with urllib.request.urlopen(request, timeout=60) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()


def read_modules(device):
    """Temperatures of the sixteen channels, C."""
    line = ModbusSerialClient(device, baudrate=19200, parity="N", timeout=1)
    assert line.connect()
    temperatures = []
    for unit in (1, 2):
        for read in (line.read_input_registers, line.read_holding_registers):
            reply = read(0, 8, slave=unit)
            assert not reply.isError(), (unit, reply)
        temperatures += [value / 100 for value in signed(reply.registers)]
    beyond = line.read_input_registers(1, 8, slave=1)
    assert beyond.isError() and beyond.exception_code == ILLEGAL_ADDRESS, beyond
    coils = line.read_coils(0, 1, slave=2)
    assert coils.isError() and coils.exception_code == 1, coils
    assert line.read_input_registers(0, 8, slave=3).isError(), "no unit 3 answers"
    assert not line.read_input_registers(0, 8, slave=2).isError(), "the line goes on after a unit that is not there"
    line.close()
    return temperatures


def mbpoll_second_module(device):
    command = ["mbpoll", "-m", "rtu", "-b", "19200", "-P", "none", "-a", "2", "-t", "3", "-r", "1", "-c", "8", "-1", device]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return [int(value) / 100 for value in re.findall(r"^\[\d\]:\s+(-?\d+)", done.stdout, re.MULTILINE)]


def read_amplifier(port):
    client = ModbusTcpClient("127.0.0.1", port=port)
    assert client.connect()
    words = client.read_holding_registers(0, 12, slave=1).registers
    assert client.read_holding_registers(0, 13, slave=1).isError()
    client.close()
    decoder = BinaryPayloadDecoder.fromRegisters(words[2:], byteorder=Endian.Big, wordorder=Endian.Big)
    return words[0], [decoder.decode_32bit_float() for _ in range(5)]


def check_control_alone(port):
    control = ModbusTcpClient("127.0.0.1", port=port)
    assert control.connect()
    for address in (96, 100, 119, 160, 162):
        reply = control.read_holding_registers(address, 1, slave=1)
        assert reply.isError() and reply.exception_code == ILLEGAL_ADDRESS, address
    assert control.read_holding_registers(0, 3, slave=1).registers == [0x5A44, 1, 0b0111]
    control.close()


class Agent:
    def __init__(self, url):
        self.url = url

    def streams(self, path):
        status, text = http(self.url + path)
        assert status == 200, (path, status, text)
        root = xml.fromstring(text)
        assert root.tag == STREAMS + "MTConnectStreams", root.tag
        return root.find(STREAMS + "Header").attrib, [node for node in root.iter() if "dataItemId" in node.attrib]

    def values(self):
        return {node.attrib["dataItemId"]: node.text for node in self.streams("current")[1]}


def check_agent(url):
    """The documents of an agent; returns its temperatures, C."""
    agent = Agent(url)
    header, items = agent.streams("current")
    assert {node.attrib["dataItemId"] for node in items} == {
        "avail", "Xact", "Yact", "Zact", "S1speed", "S1load", "T17", "T18", "T19", "T20", "room"}
    assert int(header["instanceId"]) > 0 and int(header["nextSequence"]) == int(header["lastSequence"]) + 1
    _, described = http(url + "probe")
    assert {item.attrib["id"] for item in xml.fromstring(described).iter("{urn:mtconnect.org:MTConnectDevices:1.5}DataItem")
            } == {node.attrib["dataItemId"] for node in items}
    time.sleep(0.5)
    sequences, start = [], int(header["nextSequence"])
    for _ in range(3):
        following, items = agent.streams(f"sample?from={start}&count=5")
        sequences += sorted(int(node.attrib["sequence"]) for node in items)
        start = int(following["nextSequence"])
    first = int(header["nextSequence"])
    assert sequences == list(range(first, first + len(sequences))) and len(sequences) == 15, sequences
    assert http(url + "sample?from=999999999")[0] == 404 and http(url + "sample?from=x")[0] == 400
    values = agent.values()
    return {name: float(values[name]) for name in ("T17", "T18", "T19", "T20", "room")}


def check_broker(broker):
    """The wireless sensors, and that they come back with their broker; returns temperatures, C."""
    assert wait_for(lambda: len(broker.messages(3, 2)) == 3)
    broker.stop()
    time.sleep(1.5)
    broker.start()
    wait_for(lambda: len(broker.messages(3, 2)) == 3)
    kept = wait_for(lambda: {topic: one for topic, one in broker.messages(3, 2).items() if one[1]})
    assert set(kept) == {"shop/T19", "shop/T20", "shop/room"}, kept
    return {topic[5:]: json.loads(text)["temperature_C"] for topic, (text, _) in kept.items()}


def check_rig(folder):
    with Broker(folder) as broker:
        with VirtualMachine(folder, 240, 1, "--rig", "--mqtt-broker", f"127.0.0.1:{broker.port}") as machine:
            ready = machine.ready
            assert ready["mqtt"] == f"127.0.0.1:{broker.port}", ready
            found = {f"T{i}": value for i, value in enumerate(read_modules(ready["rtu"]), 1)}
            polled = mbpoll_second_module(ready["rtu"])
            assert all(abs(value - found[f"T{i}"]) < 1.0 for i, value in enumerate(polled, 9)), polled
            valid, probes = read_amplifier(int(ready["amplifier"]))
            assert valid == 1 and all(abs(um) < 50 for um in probes), probes
            check_control_alone(int(ready["modbus"]))
            agent = check_agent(ready["mtconnect"])
            shop = check_broker(broker)
            assert all(abs(shop[name] - agent[name]) < 1.0 for name in shop), (shop, agent)
            found.update(agent)
            profile = json.load(open(machine.profile))
        rows = machine.truth_rows()
    found["ambient"] = found.pop("room")
    assert len(found) == 21
    for name, value in found.items():  # 0.1 C of noise, 0.08 C of offset
        truth = [row[name + "_C"] for row in rows]
        assert min(truth) - 0.6 < value < max(truth) + 0.6, (name, value, min(truth), max(truth))
    devices = {device["id"]: device for device in profile["devices"]}
    assert devices["module-1"]["device"] == devices["module-2"]["device"] == ready["rtu"]
    assert devices["amplifier"]["port"] == int(ready["amplifier"]) and devices["agent"]["url"] == ready["mtconnect"]
    assert devices["shop"]["port"] == broker.port
    assert {sensor["device"] for sensor in profile["sensors"]} == set(devices) - {"amplifier"}


def check_manual(folder):
    with VirtualMachine(folder, 240, 1, "--manual") as machine:
        ready = machine.ready
        assert set(ready) == {"camera", "rtu", "amplifier", "mtconnect", "operator"}, ready
        knob = ready["operator"]
        agent = Agent(ready["mtconnect"])
        assert len(read_modules(ready["rtu"])) == 16
        assert http(knob + "spindle", {"rpm": 3000}) == (200, '{"done":true}')
        assert http(knob + "move", {"X": 12.5, "Y": 0, "Z": -3}) == (200, '{"done":true}')
        state = json.loads(http(knob + "state")[1])
        assert abs(state["rpm"] - 3000) < 1 and state["position_mm"] == {"X": 12.5, "Y": 0.0, "Z": -3.0}, state
        assert not state["moving"] and not state["compensation_on"] and not state["coolant_on"], state
        values = agent.values()
        assert abs(float(values["S1speed"]) - 3000) < 1 and float(values["Xact"]) == 12.5, values
        valid, probes = read_amplifier(int(ready["amplifier"]))
        assert valid == 0 and all(um != um for um in probes), "out of the probes' range"
        status, text = http(knob + "spindle", {"rpm": "fast"})
        assert status == 400 and "rpm" in json.loads(text)["error"], (status, text)
        profile = json.load(open(machine.profile))
        assert "controller" not in profile and {"id": "control", "kind": "manual"} in profile["devices"]
        assert profile["speed"] == {"device": "agent", "signal": "S1speed"}


def check_usage():
    program = os.path.join(BIN, "zerodrift-machine")
    for words in (["--mqtt-broker", "127.0.0.1:1883"], ["--rig", "--mqtt-broker", "127.0.0.1"],
                  ["--rig", "--mqtt-broker", "127.0.0.1:0"]):
        done = subprocess.run([program, *words], capture_output=True, text=True, timeout=20)
        assert done.returncode == 2 and "--mqtt-broker" in done.stderr and not done.stdout, (words, done)


def test(folder):
    check_usage()
    check_rig(folder)
    check_manual(folder)


if __name__ == "__main__":
    run_in_folder(test)
