#!/usr/bin/python3
"""A controller served by python3-pymodbus, as docs/register-map.md says: a Modbus stack that is not this project's.

A simple thermal machine (first-order lags) stands behind it: speed warms twenty sensors, and they move the nose.
  peer_server.py [--port P] [--profile FILE] [--speedup N] [--rtu DEVICE] [--strict]
prints "ready modbus=PORT" when it serves. --strict answers reads across undocumented registers with exception 2.
"""
import argparse
import json
import math
import socket
import struct
import sys
import time
import zlib

from pymodbus.datastore import ModbusSequentialDataBlock, ModbusServerContext, ModbusSlaveContext
from pymodbus.server import StartSerialServer, StartTcpServer
from pymodbus.transaction import ModbusRtuFramer

SENSORS = 20
SIZE = 6000
AXES = "XYZ"
BLOCKS = [(0, 127), (140, 159), (160, 175), (200, 219), (1000, 2999), (4000, 5999)]
HOLES = [3 + 10, 14, 15, 19, *range(46, 64), *range(77, 96), 97, 98, 99, *range(120, 128), *range(148, 160), 161,
         *range(172, 176), *range(214, 220)]
WRITABLE = {11, *range(64, 77), *range(140, 147), *range(200, 206), *range(1000, 3000)}


def float_words(value):
    return list(struct.unpack(">HH", struct.pack(">f", value)))


def words_float(words):
    return struct.unpack(">f", struct.pack(">HH", *words))[0]


class Thermal:
    """Sensor temperatures above a drifting room, and the errors at the nose they cause."""

    def __init__(self):
        self.time_s = 0.0
        self.rise = [0.0] * SENSORS
        self.hidden = 0.0
        self.offset = [0.05 * math.sin(7.0 * i) for i in range(SENSORS)]

    def ambient(self):
        return 20.0 + 0.8 * math.sin(2.0 * math.pi * self.time_s / 86400.0)

    def step(self, dt, rpm, coolant, cycle):
        heat = (rpm / 3000.0) ** 1.2
        for i in range(SENSORS):
            if i < 6:
                gain, tau = heat * (14.0 - 2.0 * i), 900.0 + 250.0 * i
            elif i < 12:
                gain, tau = (4.0 if cycle else 0.0) * (1.0 - 0.1 * (i - 6)) + 0.8 * heat, 2400.0
            else:
                gain, tau = 0.5 * heat + (-0.4 if coolant else 0.0), 5400.0
            self.rise[i] += (gain - self.rise[i]) * -math.expm1(-dt / tau)
        self.time_s += dt

    def temperature(self, i):
        noise = 0.03 * math.sin(12.9898 * i + 78.233 * self.time_s)
        return self.ambient() + self.rise[i] + self.offset[i] + noise

    def errors(self):
        r = self.rise
        return (0.4 * r[1] - 0.9 * r[7], -1.2 * r[3] + 0.7 * (self.ambient() - 20.0), 3.1 * r[0] + 1.4 * r[4])


class Table:
    """The words of a table, decoded as the register map says."""

    def __init__(self, words):
        self.axes = {}
        if not words:
            return
        if words[0] != 1 or words[1] > 3:
            raise ValueError("format")
        at = 2
        for _ in range(words[1]):
            axis, terms, points, _ = words[at:at + 4]
            at += 4

            def take():
                nonlocal at
                value = words_float(words[at:at + 2])
                at += 2
                return value

            record = {"head": [take() for _ in range(4)], "terms": [], "points": []}
            for _ in range(terms):
                sensor = words[at]
                at += 1
                record["terms"].append((sensor, take(), take(), take()))
            for _ in range(points):
                record["points"].append([take() for _ in range(4)])
            self.axes[axis] = record
        if at != len(words):
            raise ValueError("format")

    def compensation(self, axis, x, upwards, temperature):
        record = self.axes.get(axis)
        if record is None:
            return 0.0
        offset, x0, most, _ = record["head"]
        total, first = offset, 0.0
        for n, (sensor, k, reference, slope) in enumerate(record["terms"]):
            dT = temperature(sensor) - reference
            first = dT if n == 0 else first
            total += (k + slope * (x - x0) / 1000.0) * dT
        points = record["points"]
        if points:
            values = [p[1 if upwards else 2] + p[3] * first for p in points]
            if x <= points[0][0]:
                total += values[0]
            elif x >= points[-1][0]:
                total += values[-1]
            else:
                i = next(n for n, p in enumerate(points) if p[0] >= x)
                f = (x - points[i - 1][0]) / (points[i][0] - points[i - 1][0])
                total += values[i - 1] + f * (values[i] - values[i - 1])
        return max(-most, min(most, total))


class Machine(ModbusSequentialDataBlock):
    def __init__(self, speedup, strict):
        super().__init__(0, [0] * SIZE)
        self.thermal, self.speedup, self.strict = Thermal(), speedup, strict
        self.start = time.monotonic()
        self.on = self.coolant = self.cycle = 0
        self.rpm = self.command_rpm = 0.0
        self.position = [0.0, 0.0, 0.0]
        self.active, self.active_sequence, self.table = [], 0, Table([])
        self.host, self.ramp, self.beat_at = [0.0] * 3, 0.0, 0.0
        self.host_state, self.last_beat = 0, 0
        self.applied = [0.0] * 3
        self.values[0:8] = [0x5A44, 1, 15, 2000, 0, 4711, SENSORS, 5]
        self.values[12] = max(1, round(speedup))
        self.values[146] = 10
        self.values[201] = 1000

    def advance(self):
        target = (time.monotonic() - self.start) * self.speedup
        while self.thermal.time_s < target:
            dt = min(max((target - self.thermal.time_s) / 50.0, 0.5), target - self.thermal.time_s)
            self.rpm += (self.command_rpm - self.rpm) * -math.expm1(-dt / 2.0)
            self.thermal.step(dt, self.rpm, self.coolant, self.cycle)
            self.ramp = min(1.0, self.ramp + dt / 5.0) if self.on else max(0.0, self.ramp - dt / 5.0)
            self.follow(dt)
        if self.host_state and self.thermal.time_s - self.beat_at > self.values[146]:
            self.host_state = 2

    def follow(self, dt):
        if self.host_state == 2:
            self.host = [math.copysign(max(0.0, abs(h) - 2.0 * dt), h) for h in self.host]
        for i in range(3):
            record = self.table.axes.get(i)
            rate = record["head"][3] if record else 2.0
            goal = self.ramp * self.table.compensation(i, self.position[i], True, self.sensor) + self.host[i]
            self.applied[i] += max(-rate * dt, min(rate * dt, goal - self.applied[i]))

    def sensor(self, number):
        return self.thermal.ambient() if number == 0 else self.thermal.temperature(number - 1)

    def refresh(self):
        self.advance()
        v, now = self.values, self.thermal.time_s
        ticks = int(now * 100)
        v[8:11] = [ticks >> 16 & 0xFFFF, ticks & 0xFFFF, int(now) & 0xFFFF]
        v[16:19] = [4 | (1 if self.cycle else 0), self.on, self.coolant]
        for i in range(3):
            v[20 + 2 * i:22 + 2 * i] = float_words(self.position[i])
            v[34 + 2 * i:36 + 2 * i] = float_words(6000.0 if self.cycle else 0.0)
            v[40 + 2 * i:42 + 2 * i] = float_words(self.applied[i])
        v[30:32] = float_words(self.rpm)
        v[32:34] = float_words(0.2 * self.rpm)
        for n, address in [(0, 96)] + [(i + 1, 100 + i) for i in range(SENSORS)]:
            v[address] = round(self.sensor(n) * 16) & 0xFFFF
        v[147] = self.host_state
        error = [e + a for e, a in zip(self.thermal.errors(), self.applied)]
        still = not self.cycle and all(abs(p) <= 0.5 for p in self.position)
        v[160] = 1 if still else 0
        for i, value in enumerate((error[0], error[0] + 0.5, error[1], error[1] - 0.5, error[2])):
            v[162 + 2 * i:164 + 2 * i] = float_words(value)
        v[213] = round(100 * self.ramp)

    def validate(self, address, count=1):
        if not any(low <= address and address + count - 1 <= high for low, high in BLOCKS):
            return False
        return not (self.strict and any(address <= hole < address + count for hole in HOLES))

    def getValues(self, address, count=1):
        self.refresh()
        return self.values[address:address + count]

    def setValues(self, address, values):
        """A refusal is raised; pymodbus answers it with exception 4."""
        values = list(values)
        for offset, value in enumerate(values):
            if address + offset not in WRITABLE:
                raise ValueError(f"register {address + offset} is read-only")
            if 1000 <= address + offset < 3000 and self.on:
                raise ValueError("staging while the switch is on")
        if 140 <= address <= 145 and not self.on:
            raise ValueError("offset while the switch is off")
        self.advance()
        self.values[address:address + len(values)] = values
        self.react(range(address, address + len(values)))

    def react(self, touched):
        v = self.values
        if 11 in touched:
            self.beat_at = self.thermal.time_s
        if 70 in touched and v[70] == 1:
            self.position = [words_float(v[64 + 2 * i:66 + 2 * i]) for i in range(3)]
            self.cycle, v[70], v[75] = 0, 0, 0
        if 72 in touched or 73 in touched:
            self.command_rpm = words_float(v[72:74])
        self.coolant, self.cycle = v[74], v[75]
        if 76 in touched:
            self.on = v[76]
            if not self.on:
                self.host, self.host_state = [0.0] * 3, 0
        if 140 in touched:
            self.host = [words_float(v[140 + 2 * i:142 + 2 * i]) for i in range(3)]
            self.host_state, self.beat_at = 1, self.thermal.time_s
        if 205 in touched and v[205]:
            self.commit()

    def commit(self):
        v = self.values
        words = v[1000:1000 + min(v[200], 2000)]
        reason = 0
        crc = zlib.crc32(struct.pack(f">{len(words)}H", *words))
        if self.on:
            reason = 5
        elif v[204] == 0 or v[204] != v[205]:
            reason = 8
        elif v[201] != 1000:
            reason = 7
        elif v[200] > 2000:
            reason = 2
        elif crc != (v[202] << 16 | v[203]):
            reason = 1
        else:
            try:
                self.table = Table(words)
            except (ValueError, struct.error, IndexError):
                reason = 3
        v[205], v[206], v[207], v[212] = 0, 4 if reason else 3, v[204], reason
        if not reason:
            v[208:212] = [crc >> 16, crc & 0xFFFF, len(words), v[204]]
            v[4000:6000] = words + [0] * (2000 - len(words))


def profile(port, speedup):
    sensors = [{"channel": f"T{i + 1}_C", "label": f"Sensor {i + 1}", "place": "spindle" if i < 6 else "machine"}
               for i in range(SENSORS)]
    return {"format": "zerodrift-profile/1", "name": "Peer", "time_factor": speedup,
            "controller": {"kind": "modbus-tcp", "host": "127.0.0.1", "port": port, "unit": 1, "timeout_ms": 1000,
                           "register_map": "zerodrift-virtual"},
            "cameras": [], "errors": {"source": "probes"}, "measure_position_mm": {"X": 0, "Y": 0, "Z": 0},
            "sensors": sensors, "limits": {"max_um": 200, "max_um_per_s": 2}}


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--port", type=int, default=0)
    parser.add_argument("--profile")
    parser.add_argument("--speedup", type=float, default=1.0)
    parser.add_argument("--rtu", help="serve on this serial port instead of TCP")
    parser.add_argument("--host-end", help="the serial port the profile names, the other end of the cable")
    parser.add_argument("--strict", action="store_true")
    options = parser.parse_args()
    port = options.port or free_port()
    if options.profile:
        document = profile(port, options.speedup)
        if options.rtu:
            document["controller"] = {"kind": "modbus-rtu", "device": options.host_end or options.rtu, "baud": 115200, "parity": "N",
                                      "register_map": "zerodrift-virtual"}
        with open(options.profile, "w", encoding="utf-8") as file:
            json.dump(document, file, indent=1)
    machine = Machine(options.speedup, options.strict)
    context = ModbusServerContext(slaves=ModbusSlaveContext(hr=machine, zero_mode=True), single=True)
    print(f"ready modbus={options.rtu or port}", flush=True)
    if options.rtu:
        StartSerialServer(context=context, framer=ModbusRtuFramer, port=options.rtu, baudrate=115200)
    else:
        StartTcpServer(context=context, address=("127.0.0.1", port))


if __name__ == "__main__":
    sys.exit(main())
