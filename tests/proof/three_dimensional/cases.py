"""Draws concealed cases on the three-dimensional machines.

    cases.py --models DIR --out DIR --seed N --cases N [--kind none|single|pair|unlisted|<effect>] [--structure NAME]

Each case folder holds machine.json, r1.csv, r2.csv if there is a second recording, and expected.json (judge.py).
"""

import argparse
import copy
import csv
import json
import math
import pathlib
import random
import sys

import numpy as np

from machines import MACHINES
from solid_run import REFERENCE_C, Reduced, Scaled, SolidRun, lagged
from structures import STRUCTURES

MATERIALS = {
    "steel": {"conductivity_W_mK": 45, "density_kg_m3": 7850, "heat_capacity_J_kgK": 460, "expansion_1_K": 1.15e-5},
    "cast iron": {"conductivity_W_mK": 48, "density_kg_m3": 7200, "heat_capacity_J_kgK": 500, "expansion_1_K": 1.05e-5},
}
SINGLE = (
    "extra_heat_source",
    "convection",
    "speed_convection",
    "contact_resistance",
    "bearing_preload",
    "bearing_viscosity",
    "coolant",
    "sensor_lag",
    "sensor_offset",
    "sensor_gain",
    "structure_bending",
    "structure_ambient",
    "draught",
    "switched_heat",
    "standing_heat",
    "film_driver",
    "logged_heat",
)
UNLISTED = ("unlisted:creep", "unlisted:slip", "unlisted:wander")
SIZES = (0.6, 1.5)  # of the whole structure, against the mesh
# In standard deviations of noise and of what a description in rods and lumps cannot say of a solid, together.
STRENGTH_SIGMA = (3.0, 30.0)
FORM_ERROR = {"C": (0.1, 0.005), "um": (1.0, 0.01)}  # absolute and of the channel's range
SMALLEST = {"film": 2.0, "power_W": 2.0, "lag_s": 20.0, "gain": 0.03, "contact_R": 2e-5}  # smaller ones nobody would hide
# Beyond these the machine would be no machine.
LIMITS = {
    "film": 80.0,
    "contact_R": 4e-3,
    "preload_1_K": 0.12,
    "viscosity_1_K": 0.06,
    "power_W": 600.0,
    "lag_s": 900.0,
    "offset_K": 4.0,
    "gain": 0.3,
    "um": 60.0,
}
INDOORS_FILM = 1.0  # inside a hollow casting, W/(m2 K)


def round_to(value, digits):
    return float(f"{value:.{digits}g}")


class Draw(random.Random):
    def scale(self, sigma):
        """A factor off by a relative sigma, never beyond two."""
        return 1.0 + sigma * max(-2.0, min(2.0, self.gauss(0, 1)))

    def log_uniform(self, low, high):
        return math.exp(self.uniform(math.log(low), math.log(high)))


def draw_truth(d, structure, machine, tolerance):
    """The machine as built, and the film that the engineer states."""
    parts = {part.name: part for part in structure.parts}
    film = d.uniform(6.0, 15.0)
    truth = {"sources": [], "recording": 0, "film_nominal": round_to(film, 2)}
    common = {key: d.scale(tolerance[key]) for key in ("conductivity", "heat_capacity", "expansion", "film")}
    truth["conductivity"] = {n: p.material["k"] * common["conductivity"] * d.scale(0.02) for n, p in parts.items()}
    truth["storage_J_m3K"] = {
        n: p.material["rho"] * p.material["c"] * common["heat_capacity"] * d.scale(0.01) for n, p in parts.items()
    }
    truth["expansion"] = {n: common["expansion"] for n in parts}
    surfaces = list(parts) + list(structure.surfaces)
    truth["films"] = {}
    for surface in surfaces:
        h = film * common["film"] * d.scale(0.1)
        if surface == "floor" or surface == "wall_behind":
            h = 0.0
        elif surface.endswith("inside") or surface.endswith("bore") or surface == "bearing_seat":
            h = INDOORS_FILM
        truth["films"][surface] = h
    contacts = {}
    for part in structure.parts:
        for other in structure.parts:
            pair = (part.name, other.name)
            if pair in structure.contacts:
                nominal = structure.contacts[pair]
                contacts[f"{pair[0]}|{pair[1]}"] = nominal if nominal >= 1e5 else nominal * math.exp(d.gauss(0, 0.25))
    truth["contacts"] = contacts
    truth["bridges"] = {name: nominal * machine.size**2 * math.exp(d.gauss(0, 0.2)) for name, (_, _, nominal) in machine.bridges.items()}
    described = machine.sources(d)
    for source in described:
        # Heat grows with the surface that carries it away.
        for key in ("rated_power_W", "friction_N", "load_N"):
            if key in source:
                source[key] = round_to(source[key] * machine.size**2, 2)
        for key in ("from_mm", "to_mm", "mean_diameter_mm"):
            if key in source:
                source[key] = machine.mm(source[key])
        if source.get("load"):
            truth["sources"].append(dict(source, scale=d.scale(tolerance["heat_source_power"])))
    return truth, described


def align(truth, model):
    """Contacts by the names under which the model has them."""
    have = set(model.keys("C"))
    contacts = {}
    for name in have:
        a, b = name.split("|")
        contacts[name] = truth["contacts"].get(name, truth["contacts"].get(f"{b}|{a}", 1e5))
    truth["contacts"] = contacts


def conductance_W_K(model, machine, truth, coupling):
    """Of a joint with the ways of the heat inside both bodies: what a heat in the lump drives through it, steadily."""
    A = sum(model("K", p) * truth["conductivity"][p] for p in truth["conductivity"])
    for pair, contact in truth["contacts"].items():
        A = A + contact * model("C", pair)
    for name, (a, b, _) in machine.bridges.items():
        difference = model("load", a) - model("load", b)
        A = A + truth["bridges"][name] * np.outer(difference, difference)
    for surface, film in truth["films"].items():
        A = A + film * model("F", surface)

    lump = model("mean", machine.lumps[coupling.lump][0])
    other = model("average", coupling.name)
    theta = np.linalg.solve(A, lump)
    if coupling.across in machine.bridges:
        a, b, _ = machine.bridges[coupling.across]
        flow = truth["bridges"][coupling.across] * (model("load", a) - model("load", b)) @ theta
    else:
        name = "|".join(coupling.across)
        if name not in truth["contacts"]:
            name = "|".join(reversed(coupling.across))
        flow = truth["contacts"][name] * model("J", name) @ theta
    return abs(flow) / abs((lump - other) @ theta)


def describe(d, model, structure, machine, truth, described, tolerance, with_convection):
    parts = {part.name: part for part in structure.parts}
    components = []
    for name, rod in machine.rods().items():
        geometry = {key: machine.mm(rod[key]) for key in ("length_mm", "outer_diameter_mm", "bore_diameter_mm")}
        components.append({"id": name, **geometry, "material": MATERIALS[rod["material"]], "heat_sources": []})
    for lump, members in machine.lumps.items():
        capacity = sum(float(model("volume_m3", p)) * parts[p].material["rho"] * parts[p].material["c"] for p in members)
        area = 0.0
        for surface in list(parts) + list(structure.surfaces):
            owner = surface if surface in parts else structure.surfaces[surface][0]
            if owner in members and truth["films"][surface] > INDOORS_FILM:
                area += float(model("area_m2", surface))
        component = {"id": lump, "kind": "lump", "heat_capacity_J_K": round_to(capacity, 3), "area_mm2": round_to(area * 1e6, 3)}
        components.append(dict(component, heat_sources=[]))
    by_id = {c["id"]: c for c in components}
    originals = {source["id"]: source for source in described}
    for source in described:
        entry = {k: v for k, v in source.items() if k not in ("component", "load", "share", "like")}
        original = originals.get(source.get("like"), source)
        for key in ("friction_N", "mean_diameter_mm", "f0", "f1", "load_N", "oil_viscosity_mm2_s"):
            if key in original:
                entry[key] = original[key]
        share = source.get("share", 1.0)
        for key in ("friction_N", "f0", "f1"):
            if key in entry:
                entry[key] = entry[key] * share
        if by_id[source["component"]].get("kind") == "lump":
            entry.pop("from_mm", None)
            entry.pop("to_mm", None)
        by_id[source["component"]]["heat_sources"].append(entry)
    couplings = []
    for coupling in machine.couplings():
        other = {"component": coupling.other, "position_mm": machine.mm(coupling.place_mm)}
        # An engineer's estimate of the joint and the ways to it; some do not dare one.
        estimate = conductance_W_K(model, machine, truth, coupling) * math.exp(d.gauss(0, 0.7 * tolerance["conductance"]))
        known = d.random() < 0.85
        couplings.append({"between": [{"component": coupling.lump}, other], "conductance_W_K": round_to(estimate, 2) if known else None})
    document = {
        "format": "zerodrift-machine/1",
        "name": machine.name.replace("_", " "),
        "components": components,
        "couplings": couplings,
        "effects": ["convection"] if with_convection else [],
        "effect_parameters": {"convection": {"h_W_m2K": truth["film_nominal"]}} if with_convection else {},
        "tolerances": {k: round_to(v, 2) for k, v in tolerance.items()},
        "reference_temperature_C": REFERENCE_C,
        "sensors": [],
        "displacements": [],
    }
    for component in components:
        if not component["heat_sources"]:
            del component["heat_sources"]
    return document


def draw_sensors(d, model, machine, document):
    """Sensors on the rod and on lumps; returns channel -> reading."""
    readings = {}
    rows = {}
    places = {}
    for key in model.keys("reading"):
        words = key.split(" ")
        if len(words) == 3:
            places.setdefault(int(words[1]), {})[words[2]] = key
    lumps = [lump for lump in machine.lumps if lump in model.keys("reading")]
    on_rod = d.randint(2, 7)
    if d.random() < 0.25:
        lumps = d.sample(lumps, max(1, len(lumps) - 1))
    accuracy = d.choice([0.1, 0.2, 0.3, 0.5])
    grid = sorted(places)
    chosen = set()
    for i in range(on_rod):
        wanted = (i + 0.5 + d.uniform(-0.3, 0.3)) / on_rod * (grid[-1] - grid[0]) + grid[0]
        chosen.add(min(grid, key=lambda x: abs(x - wanted)))
    usual = d.choice(sorted(places[grid[0]]))
    for i, x in enumerate(sorted(chosen)):
        sides = places[x]
        side = usual if d.random() < 0.75 else d.choice(sorted(sides))
        channel = f"T{i + 1}_C"
        rows[channel] = model("reading", sides[side])
        document["sensors"].append({"channel": channel, "component": machine.rod, "position_mm": machine.mm(x), "accuracy_C": accuracy})
    for lump in lumps:
        channel = f"{lump}_C"
        rows[channel] = model("reading", lump)
        document["sensors"].append({"channel": channel, "component": lump, "accuracy_C": accuracy})
    for key, (rod, place) in machine.further_sensors.items():
        if d.random() < 0.8:
            rows[f"{key}_C"] = model("reading", key)
            document["sensors"].append({"channel": f"{key}_C", "component": rod, "position_mm": machine.mm(place), "accuracy_C": accuracy})
    readings.update(rows)
    return readings, accuracy


def draw_inputs(d, machine, hours, period, columns, room_swing):
    """A schedule of steps with stops; columns that the case needs beside speed and feed."""
    count = int(hours * 3600 / period) + 1
    times = np.arange(count) * period
    inputs = {"time_s": times}
    rpm = np.zeros(count)
    feed = np.zeros(count)
    t = 0.0
    rest_first = d.random() < 0.5
    speeds = [round(machine.rpm[0] + (machine.rpm[1] - machine.rpm[0]) * f, -2) for f in (0.15, 0.35, 0.6, 1.0)]
    # A short run still has a stop and two speeds.
    typical = min(2400.0, hours * 3600 / 6)
    while t < times[-1]:
        span = d.uniform(0.5, 1.6) * typical
        now = (times >= t) & (times < t + span)
        if not (t == 0.0 and rest_first) and d.random() < 0.75:
            rpm[now] = d.choice(speeds)
            if machine.feed and d.random() < 0.75:
                feed[now] = round(1000 * d.uniform(*machine.feed), -1)
        t += span
    if d.random() < 0.6:
        rpm[times > times[-1] * d.uniform(0.75, 0.9)] = 0
    if np.mean(rpm > 0) < 0.25:
        rpm[(times > 0.1 * times[-1]) & (times < 0.6 * times[-1])] = speeds[-1]
    if machine.feed:
        inputs["feed_x_mm_min"] = np.where(rpm > 0, feed, 0.0) if d.random() < 0.5 else feed
    inputs["spindle_rpm"] = rpm
    for column in columns:
        inputs[column] = np.zeros(count)
        t = d.uniform(0.05, 0.3) * times[-1]
        while t < times[-1]:
            span = d.uniform(0.08, 0.25) * times[-1]
            level = 1.0 if column != "fan_percent" else float(d.choice([40, 60, 100]))
            inputs[column][(times >= t) & (times < t + span)] = level
            t += span + d.uniform(0.08, 0.3) * times[-1]
    start = d.uniform(18.0, 25.0)
    period_s = d.uniform(0.5, 2.0) * 8 * 3600
    phase = d.uniform(0, 2 * math.pi)
    wave = np.sin(2 * math.pi * times / period_s + phase) - math.sin(phase)
    short = d.uniform(0.1, 0.4) * np.sin(2 * math.pi * times / d.uniform(600, 2400))
    inputs["room_C"] = start + room_swing * wave + short
    return inputs


def event_intervals(d, duration, period, many):
    intervals = []
    count = d.randint(1, 3) if many else 1
    t = d.uniform(0.1, 0.4) * duration
    for _ in range(count):
        span = max(4 * period, d.log_uniform(0.03, 0.3) * duration)
        intervals.append([round(t), round(min(t + span, 0.97 * duration))])
        t += span + d.uniform(0.08, 0.25) * duration
        if t > 0.85 * duration:
            break
    return intervals


def tolerance_mm(machine):
    return max(0.1 * machine.length * machine.size, 25.0)


class Hidden:
    """One hidden effect: how it changes the truth by a size, and what an answer must say."""

    def __init__(self, kind, size, limit, apply, expected, smallest=0.0):
        self.kind, self.size, self.limit, self.apply, self.expected = kind, size, limit, apply, expected
        self.smallest = smallest


def draw_hidden(kind, d, machine, structure, truth, document, duration, period, model):
    L = machine.length * machine.size

    def effect(right, half=(), **facts):
        return {"name": kind, "right": list(right), "half": list(half), **facts}

    if kind in ("extra_heat_source", "standing_heat", "switched_heat", "logged_heat"):
        load, (component, place) = d.choice(sorted(machine.heat_places.items(), key=str))
        facts = {"component": component}
        if place is not None:
            facts.update(position_mm=machine.mm(place), tolerance_mm=tolerance_mm(machine))
        extra = {"load": load, "law": "constant"}
        if kind == "extra_heat_source":
            extra["law"] = d.choice(["on", "n", "n2"])
            at = machine.mm(place)
            near = [s for s in truth["sources"] if at is not None and "from_mm" in s and s["from_mm"] - 0.1 * L < at < s["to_mm"] + 0.1 * L]
            half = ["speed_heat_curve", "standing_heat", "switched_heat", "neighbour_heat"]
            if any(s["kind"] == "bearing" for s in near):
                half.append("bearing_preload")
            facts = effect(["extra_heat_source"], half, **facts)
        elif kind == "standing_heat":
            # Switched on with the machine when the recording starts.
            facts = effect(["standing_heat", "extra_heat_source", "switched_heat"], ["neighbour_heat"], **facts)
        elif kind == "switched_heat":
            extra.update(law="intervals", intervals_s=event_intervals(d, duration, period, True))
            facts = effect(["switched_heat"], ["extra_heat_source", "standing_heat"], intervals_s=extra["intervals_s"], **facts)
        else:
            extra["law"] = "pump_on"
            facts = effect(["extra_heat_source", "switched_heat"], ["standing_heat", "neighbour_heat"], driver="pump_on", **facts)

        def apply(t, size, extra=extra):
            t.setdefault("extra", []).append(dict(extra, power_W=size))

        return Hidden(kind, 20.0, LIMITS["power_W"], apply, facts, SMALLEST["power_W"])
    if kind == "convection":
        return Hidden(kind, 1.0, None, lambda t, size: None, effect(["convection"], ["room_sensor_fault"]))
    if kind == "speed_convection":

        def apply(t, size):
            t["speed_film"] = size

        facts = effect(["speed_convection"], ["film_driver"], component=machine.speed_film_component)
        return Hidden(kind, 15.0, LIMITS["film"], apply, facts, SMALLEST["film"])
    if kind == "film_driver":

        def apply(t, size):
            t["fan_film"] = size

        facts = effect(["film_driver"], ["draught", "coolant"], component=machine.fan[1], driver="fan_percent")
        return Hidden(kind, 20.0, LIMITS["film"], apply, facts, SMALLEST["film"])
    if kind == "contact_resistance":
        joint = "|".join(machine.joint)

        def apply(t, size):
            name = joint if joint in t["contacts"] else "|".join(reversed(machine.joint))
            t["contacts"][name] = 1.0 / (1e-5 + size)

        facts = effect(["contact_resistance"], component=machine.rod, position_mm=machine.mm(machine.joint_mm), tolerance_mm=tolerance_mm(machine))
        return Hidden(kind, 2e-4, LIMITS["contact_R"], apply, facts, SMALLEST["contact_R"])
    if kind in ("bearing_preload", "bearing_viscosity"):
        key = {"bearing_preload": "preload_1_K", "bearing_viscosity": "viscosity_1_K"}[kind]

        def apply(t, size):
            t[key] = size

        half = ["speed_heat_curve", "extra_heat_source"] if kind == "bearing_preload" else ["bearing_run_in", "speed_heat_curve"]
        return Hidden(kind, 0.03, LIMITS[key], apply, effect([kind], half))
    if kind == "coolant":

        def apply(t, size):
            t["coolant_film"] = size

        surface, component, _, _ = machine.coolant
        facts = effect(["coolant"], ["film_driver", "draught"], component=component, driver="coolant_on")
        return Hidden(kind, 40.0, 400.0, apply, facts)
    if kind in ("sensor_lag", "sensor_offset", "sensor_gain"):
        channel = d.choice([s["channel"] for s in document["sensors"]])
        component = next(s["component"] for s in document["sensors"] if s["channel"] == channel)
        sign = d.choice([-1, 1])
        key = {"sensor_lag": "lag_s", "sensor_offset": "offset_K", "sensor_gain": "gain"}[kind]

        def apply(t, size):
            t.setdefault("sensor", {})[channel] = {key: size * (1 if kind == "sensor_lag" else sign)}

        half = {"sensor_lag": ["casting_core", "heater_body"], "sensor_offset": ["sensor_gain"], "sensor_gain": ["sensor_offset"]}[kind]
        facts = effect([kind], half, channel=channel, half_component=component)
        # An offset within what the sensor is stated to is no fault.
        accuracy = next(s["accuracy_C"] for s in document["sensors"] if s["channel"] == channel)
        smallest = 3 * accuracy if key == "offset_K" else SMALLEST[key]
        return Hidden(kind, {"lag_s": 120.0, "offset_K": 1.0, "gain": 0.1}[key], LIMITS[key], apply, facts, smallest)
    if kind == "structure_bending":
        channel = machine.bending

        def apply(t, size):
            t["bent"] = True
            t["lopsided"] = min(1.0, size)

        facts = effect(["structure_bending"], ["structure_driver", "structure_lag"], channel=channel)
        lopsided = channel == machine.symmetric
        return Hidden(kind, 0.5, 1.0 if lopsided else None, apply, facts)
    if kind == "structure_ambient":
        lag = d.uniform(1500, 8000)
        sign = d.choice([-1, 1])

        def apply(t, size):
            t["ambient_um_K"], t["ambient_lag_s"] = sign * size, lag

        facts = effect(["structure_ambient"], ["structure_driver", "structure_lag"], channel=machine.growth)
        return Hidden(kind, 3.0, 20.0, apply, facts)
    if kind == "draught":
        intervals = event_intervals(d, duration, period, d.random() < 0.3)

        def apply(t, size):
            t["draught_s"], t["draught_film"] = intervals, size

        facts = effect(["draught"], ["switched_heat", "film_driver"], intervals_s=intervals)
        return Hidden(kind, 15.0, LIMITS["film"], apply, facts, SMALLEST["film"])
    if kind == "unlisted:creep":
        seconds = d.uniform(300, 3000)

        def apply(t, size):
            t["creep_um"], t["creep_s"] = size, seconds

        return Hidden(kind, 3.0, LIMITS["um"], apply, effect([], channel=machine.growth))
    if kind == "unlisted:slip":

        def apply(t, size):
            t["slip_um"] = size

        return Hidden(kind, 3.0, LIMITS["um"], apply, effect([], ["bracket_slip"], channel=machine.growth))
    if kind == "unlisted:wander":
        load, (component, place) = d.choice(sorted(machine.heat_places.items(), key=str))
        knots = [0.0] + [d.gauss(0, 1) for _ in range(40)]
        walk = np.abs(np.cumsum(knots))
        extra = {"load": load, "law": "wander", "knots_s": list(np.linspace(0, 30000, 41)), "knots": list(walk / max(walk))}

        def apply(t, size):
            t.setdefault("extra", []).append(dict(extra, power_W=size))

        facts = effect([], ["switched_heat", "extra_heat_source", "standing_heat"], component=component)
        return Hidden(kind, 30.0, LIMITS["power_W"], apply, facts)
    raise SystemExit(f"no effect is called {kind}")


def possible(kind, machine):
    bearings = {"ball_screw", "motor_flange"}
    if kind in ("bearing_preload", "bearing_viscosity"):
        return machine.name in bearings
    return True


class Case:
    def __init__(self, seed, index, models, kind="", structure_name=""):
        # One stream a case: a case does not change when others are added.
        self.d = d = Draw(f"{seed}/{index}")
        self.name = f"case-{index + 1:03d}"
        mixture = d.random()
        structure_name = structure_name or d.choice(sorted(STRUCTURES))
        size = d.log_uniform(*SIZES)
        self.machine = machine = MACHINES[structure_name].scaled(size)
        self.structure = STRUCTURES[structure_name]()
        self.model = Scaled(models[structure_name], size)
        self.kinds = self._kinds(d, kind, mixture, machine)
        for _ in range(60):
            if self._attempt():
                return
        raise RuntimeError(f"{self.name}: {self.kinds} on {structure_name} never reaches {STRENGTH_SIGMA} sigma")

    @staticmethod
    def _kinds(d, kind, mixture, machine):
        listed = [k for k in SINGLE if possible(k, machine)]
        if kind in SINGLE or kind in UNLISTED:
            return [kind]
        if kind == "none" or (not kind and mixture < 0.2):
            return []
        if kind == "unlisted" or (not kind and mixture < 0.27):
            return [d.choice(UNLISTED)]
        if kind == "pair" or (not kind and mixture < 0.4):
            while True:
                pair = d.sample(listed, 2)
                # Two of one channel or of one kind of event are a puzzle of their own.
                if len({k.split("_")[0] for k in pair}) == 2:
                    return sorted(pair)
        return [d.choice(listed)]

    def _attempt(self):
        d, machine, model = self.d, self.machine, self.model
        tolerance = {
            "conductivity": d.choice([0.05, 0.1]),
            "heat_capacity": d.choice([0.03, 0.05]),
            "heat_source_power": d.choice([0.1, 0.2]),
            "film": d.choice([0.2, 0.3]),
            "expansion": 0.04,
            "conductance": d.choice([0.4, 0.6]),
        }
        truth, described = draw_truth(d, self.structure, machine, tolerance)
        align(truth, model)
        document = describe(d, model, self.structure, machine, truth, described, tolerance, "convection" not in self.kinds)
        rows, self.accuracy = draw_sensors(d, model, machine, document)
        period = d.choice([5, 10, 15, 30, 60])
        rows_wanted = d.log_uniform(150, 1500)
        hours = min(6.0, max(1.2, rows_wanted * period / 3600))
        period = max(period, math.ceil(hours * 3600 / 1500))
        recordings = 1 if d.random() < 0.55 else 2
        columns = []
        if "coolant" in self.kinds or d.random() < 0.1:
            columns.append("coolant_on")
        if "film_driver" in self.kinds or d.random() < 0.1:
            columns.append("fan_percent")
        if "logged_heat" in self.kinds or d.random() < 0.05:
            columns.append("pump_on")
        swing = d.uniform(1.5, 3.0) if "structure_ambient" in self.kinds else d.uniform(0.2, 1.5)
        runs = []
        for i in range(recordings):
            length = hours * (1.0 if i == 0 else d.uniform(0.6, 1.3))
            inputs = draw_inputs(d, machine, min(length, 1500 * period / 3600), period, columns, swing)
            warm = d.random() < 0.25
            before = draw_inputs(d, machine, d.uniform(0.7, 2.5), 60.0, columns, 0.0) if warm else None
            runs.append((inputs, before))
        truth["coolant_C"] = d.uniform(18.0, 21.0)
        self._displacements(document)
        self.truth, self.runs, self.rows, self.document = truth, runs, rows, document
        self.noise_K = d.choice([0.02, 0.03, 0.05, 0.08])
        self.noise_um = d.choice([0.2, 0.3, 0.5, 1.0])
        self.hidden = [
            draw_hidden(k, d, machine, self.structure, truth, document, runs[0][0]["time_s"][-1], period, model) for k in self.kinds
        ]
        return self._size()

    def _displacements(self, document):
        machine = self.machine
        document["displacements"].append({"channel": machine.growth, "direction": machine.growth[1], "component": machine.rod})
        across = None
        if "structure_bending" in self.kinds:
            across = machine.bending
        elif machine.symmetric and self.d.random() < 0.5:
            across = machine.symmetric
        if across:
            document["displacements"].append({"channel": across, "direction": across[1], "component": machine.rod})

    def _truth_with(self, sizes):
        truth = copy.deepcopy(self.truth)
        for hidden, size in zip(self.hidden, sizes):
            if size:
                hidden.apply(truth, size)
        return truth

    def _readings(self, truth, which=0):
        truth = dict(truth, recording=which)
        inputs, before = self.runs[which]
        start = self.model.uniform * (inputs["room_C"][0] - REFERENCE_C)
        if before is not None:
            before = dict(before, room_C=np.full(len(before["time_s"]), inputs["room_C"][0]))
            earlier = dict(truth, recording=-1)
            _, _, start = SolidRun(self.model, self.machine, earlier).simulate(before, start, {})
        temperatures, growths, _ = SolidRun(self.model, self.machine, truth).simulate(inputs, start, self.rows)
        for channel, fault in truth.get("sensor", {}).items():
            values = temperatures[channel]
            if "lag_s" in fault:
                temperatures[channel] = lagged(values, inputs["time_s"], fault["lag_s"])
            elif "offset_K" in fault:
                temperatures[channel] = values + fault["offset_K"]
            else:
                temperatures[channel] = values + fault["gain"] * (values - values[0])
        wanted = {x["channel"] for x in self.document["displacements"]}
        return {**temperatures, **{c: v for c, v in growths.items() if c in wanted}}

    def _strength(self, with_it, without):
        """Of the change: in standard deviations of noise and form error, and of noise alone; the channel."""
        worst = (0.0, 0.0, "")
        for name, values in with_it.items():
            unit = "um" if name.endswith("_um") else "C"
            noise = self.noise_um if unit == "um" else self.noise_K
            absolute, relative = FORM_ERROR[unit]
            form = math.hypot(noise, absolute, relative * np.ptp(values))
            size = float(np.percentile(np.abs(values - without[name]), 90))
            worst = max(worst, (size / form, size / noise, name))
        return worst

    def _size(self):
        sizes = [h.size for h in self.hidden]
        self.strengths, self.worst = [], []
        for i, hidden in enumerate(self.hidden):
            wanted = self.d.log_uniform(*STRENGTH_SIGMA)
            for _ in range(5):
                with_it = self._readings(self._truth_with(sizes))
                without = [s if j != i else 0.0 for j, s in enumerate(sizes)]
                if hidden.kind == "convection":
                    # Hidden because nobody described it; its size is the machine's own.
                    bare = self._truth_with(sizes)
                    bare["films"] = dict.fromkeys(bare["films"], 0.0)
                    base = self._readings(bare)
                elif hidden.kind == "structure_bending" and self.machine.bending != self.machine.symmetric:
                    base = {k: v * (k != self.machine.bending) for k, v in with_it.items()}
                else:
                    base = self._readings(self._truth_with(without))
                strength, in_noise, channel = self._strength(with_it, base)
                if hidden.limit is None or abs(math.log(max(strength, 1e-9) / wanted)) < 0.1:
                    break
                factor = min(20.0, max(0.05, wanted / max(strength, 1e-9)))
                sizes[i] = min(hidden.limit, sizes[i] * factor)
            if strength < STRENGTH_SIGMA[0] or sizes[i] < hidden.smallest:
                return False
            self.strengths.append((strength, in_noise))
            self.worst.append(channel)
        self.sizes = sizes
        return True

    def write(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        d = self.d
        truth = self._truth_with(self.sizes)
        quantum = d.choice([0.001, 0.01, 0.1]) if self.noise_K > 0.02 else 0.001
        logged_room = d.random() < 0.92
        accuracy = self.accuracy
        document = self.document
        if logged_room:
            document["sensors"].append({"channel": "ambient_C", "component": "ambient", "accuracy_C": accuracy})
        else:
            document["room"] = {"channel": None, "temperature_C": None, "sigma_C": 1.0, "per_recording": True}
        for i, (inputs, _) in enumerate(self.runs):
            clean = self._readings(truth, i)
            columns = {"time_s": inputs["time_s"]}
            for name in ("spindle_rpm", "feed_x_mm_min", "coolant_on", "fan_percent", "pump_on"):
                if name in inputs:
                    columns[name] = inputs[name]
            generator = np.random.default_rng(d.getrandbits(63))
            for name, values in clean.items():
                if name.endswith("_um"):
                    columns[name] = np.round(values + generator.normal(0, self.noise_um, len(values)), 3)
                    continue
                offset = generator.normal(0, 0.5 * accuracy)
                noisy = values + offset + generator.normal(0, self.noise_K, len(values))
                columns[name] = np.round(np.round(noisy / quantum) * quantum, 4)
            if logged_room:
                room = inputs["room_C"] + generator.normal(0, 0.25 * accuracy) + generator.normal(0, self.noise_K, len(inputs["room_C"]))
                columns["ambient_C"] = np.round(np.round(room / quantum) * quantum, 4)
            with open(folder / f"r{i + 1}.csv", "w", newline="") as file:
                writer = csv.writer(file, lineterminator="\n")
                writer.writerow(columns)
                for row in zip(*columns.values()):
                    writer.writerow([f"{v:.6g}" for v in row])
        (folder / "machine.json").write_text(json.dumps(document, indent=1))
        (folder / "expected.json").write_text(json.dumps(self.expected(), indent=1))

    def expected(self):
        unlisted = any(k.startswith("unlisted") for k in self.kinds)
        effects = []
        for hidden, size, strength, channel in zip(self.hidden, self.sizes, self.strengths, self.worst):
            effects.append(dict(hidden.expected, size=size, strength=round(strength[0], 2), strength_sigma=round(strength[1], 2), worst_channel=channel))
        return {
            "case": self.name,
            "world": "three_dimensional",
            "structure": self.machine.name,
            "size": round(self.machine.size, 3),
            "hidden": effects,
            "unlisted": unlisted,
            "recordings": len(self.runs),
            "warm_start": [before is not None for _, before in self.runs],
            "noise": {"C": self.noise_K, "um": self.noise_um},
        }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--models", type=pathlib.Path, required=True, help="folder that matrices.py wrote")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--seed", required=True)
    parser.add_argument("--cases", type=int, default=30)
    parser.add_argument("--kind", default="")
    parser.add_argument("--structure", default="", choices=[""] + sorted(STRUCTURES))
    arguments = parser.parse_args()
    names = [arguments.structure] if arguments.structure else sorted(STRUCTURES)
    models = {name: Reduced(arguments.models / f"{name}.npz") for name in names}
    if not arguments.structure:
        names = sorted(STRUCTURES)
    for index in range(arguments.cases):
        case = Case(arguments.seed, index, models, arguments.kind, arguments.structure)
        case.write(arguments.out / case.name)
        print(case.name, case.machine.name, "+".join(case.kinds) or "none", [(round(a, 1), round(b)) for a, b in case.strengths], [round_to(x, 3) for x in case.sizes], flush=True)


if __name__ == "__main__":
    sys.exit(main())
