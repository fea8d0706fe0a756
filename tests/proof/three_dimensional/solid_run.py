"""Runs the reduced model of a structure: what its sensors read and how far its nose moves, without noise."""

import math

import numpy as np

GAMMA = 1.0 - math.sqrt(0.5)  # of the L-stable SDIRK of second order (Alexander 1977)
STEP_S = 20.0
REFERENCE_C = 20.0


class Reduced:
    """The matrices that matrices.py stored; temperatures are above 20 C."""

    def __init__(self, path):
        self.data = dict(np.load(path))
        self.size = int(self.data["size"][1])
        self.uniform = self.data["uniform"]

    def keys(self, kind):
        return [key.split(" ", 1)[1] for key in self.data if key.startswith(kind + " ")]

    def __call__(self, kind, name):
        return self.data[f"{kind} {name}"]


# How the stored matrices grow with the size of the whole structure.
POWER_OF_SIZE = {"K": 1, "M": 3, "F": 2, "f": 2, "C": 2, "J": 2, "g": 1, "area_m2": 2, "volume_m3": 3}


class Scaled(Reduced):
    """The same structure, all its lengths larger by a factor."""

    def __init__(self, model, factor):
        self.size, self.uniform = model.size, model.uniform
        self.data = {key: value * factor ** POWER_OF_SIZE.get(key.split(" ")[0], 0) for key, value in model.data.items()}


def palmgren_W(rpm, bearing, viscosity_factor=1.0, load_factor=1.0):
    if rpm <= 0:
        return 0.0
    nu_n = bearing["oil_viscosity_mm2_s"] * viscosity_factor * rpm
    diameter = bearing["mean_diameter_mm"]
    oil = (1e-7 * nu_n ** (2 / 3) if nu_n >= 2000 else 160e-7) * bearing["f0"] * diameter**3
    return 1.047e-4 * rpm * (oil + bearing["f1"] * bearing["load_N"] * load_factor * diameter)


def heat_W(source, inputs, row, viscosity_factor=1.0, load_factor=1.0):
    if source["kind"] == "motor":
        return source["rated_power_W"] * (1 - source["efficiency"]) * inputs["spindle_rpm"][row] / source["rated_speed_rpm"]
    if source["kind"] == "bearing":
        return palmgren_W(inputs["spindle_rpm"][row], source, viscosity_factor, load_factor)
    return source["friction_N"] * abs(inputs[source["channel"]][row]) / 60000.0


def lagged(values, times, lag_s):
    """First order, linear between the samples."""
    out = np.empty(len(values))
    out[0] = values[0]
    for i in range(1, len(values)):
        step = times[i] - times[i - 1]
        a = math.exp(-step / lag_s)
        b = 1 - lag_s / step * (1 - a)
        out[i] = a * out[i - 1] + (1 - a - b) * values[i - 1] + b * values[i]
    return out


class SolidRun:
    """`truth`: what the machine really is (cases.py). `inputs`: columns by name with time_s and room_C."""

    def __init__(self, model, machine, truth):
        self.model, self.machine, self.truth = model, machine, truth
        self.M = sum(model("M", p) * truth["storage_J_m3K"][p] for p in truth["storage_J_m3K"])
        self.K = sum(model("K", p) * truth["conductivity"][p] for p in truth["conductivity"])
        for pair, contact in truth["contacts"].items():
            self.K = self.K + contact * model("C", pair)
        for name, (a, b, conductance) in machine.bridges.items():
            difference = model("load", a) - model("load", b)
            self.K = self.K + truth["bridges"][name] * np.outer(difference, difference)
        self.solvers = {}

    def films(self, time_s, rpm, inputs, row):
        """Film of each surface now; the coolant's surface apart, since it loses to another temperature."""
        truth = self.truth
        films = dict(truth["films"])
        if truth.get("speed_film", 0.0) > 0 and rpm > 0:
            for surface in self.machine.turning:
                films[surface] += truth["speed_film"] * (rpm / self.machine.rpm[1]) ** 0.7
        if truth.get("fan_film", 0.0) > 0:
            for surface in self.machine.fan[0]:
                films[surface] += truth["fan_film"] * inputs["fan_percent"][row] / 100.0
        for start, end in truth.get("draught_s", ()):
            if truth["recording"] == 0 and start <= time_s < end:
                for surface in self.machine.draught:
                    films[surface] += truth["draught_film"]
        coolant = truth.get("coolant_film", 0.0) * (inputs["coolant_on"][row] if "coolant_on" in inputs else 0.0)
        return films, coolant

    def solver(self, films, coolant, step):
        key = (tuple(films.values()), coolant, round(step, 6))
        if key not in self.solvers:
            if len(self.solvers) > 400:
                self.solvers.clear()
            A = self.K.copy()
            room = np.zeros(self.model.size)
            for surface, film in films.items():
                if film:
                    A += film * self.model("F", surface)
                    room += film * self.model("f", surface)
            cold = np.zeros(self.model.size)
            if coolant:
                A += coolant * self.model("F", self.machine.coolant[0])
                cold = coolant * self.model("f", self.machine.coolant[0])
            self.solvers[key] = (np.linalg.inv(self.M + GAMMA * step * A), A, room, cold)
        return self.solvers[key]

    def heats(self, theta, inputs, row, time_s):
        truth, model = self.truth, self.model
        load = np.zeros(model.size)
        for source in truth["sources"]:
            row_of_load = model("load", source["load"])
            warm = row_of_load @ theta
            viscosity = math.exp(-truth.get("viscosity_1_K", 0.0) * warm) if source["kind"] == "bearing" else 1.0
            preload = max(0.0, 1 + truth.get("preload_1_K", 0.0) * warm) if source["kind"] == "bearing" else 1.0
            watts = source["scale"] * heat_W(source, inputs, row, viscosity, preload)
            lopsided = truth.get("lopsided", 0.0) if source["load"] + " lopsided" in model.keys_of_loads else 0.0
            load += watts * (1 - lopsided) * row_of_load
            if lopsided:
                load += watts * lopsided * model("load", source["load"] + " lopsided")
        for extra in truth.get("extra", ()):
            watts = extra["power_W"]
            law = extra["law"]
            relative = inputs["spindle_rpm"][row] / self.machine.rpm[1]
            if law == "intervals":
                active = truth["recording"] == 0 and any(a <= time_s < b for a, b in extra["intervals_s"])
                watts *= float(active)
            elif law in inputs:
                watts *= inputs[law][row]
            elif law == "wander":
                watts *= float(np.interp(time_s, extra["knots_s"], extra["knots"]))
            else:
                watts *= {"constant": 1.0, "on": float(relative > 0), "n": relative, "n2": relative**2}[law]
            load += watts * model("load", extra["load"])
        return load

    def simulate(self, inputs, start, rows):
        """`start`: state at the first sample; `rows`: sensor -> reading. Returns readings in C, growths in um, state."""
        model, truth = self.model, self.truth
        model.keys_of_loads = getattr(model, "keys_of_loads", None) or set(model.keys("load"))
        times = inputs["time_s"]
        theta = start.copy()
        states = np.empty((len(times), model.size))
        states[0] = theta
        cold = truth.get("coolant_C", REFERENCE_C) - REFERENCE_C
        for i in range(len(times) - 1):
            span = times[i + 1] - times[i]
            count = max(1, int(math.ceil(span / STEP_S)))
            step = span / count
            for k in range(count):
                time_s = times[i] + k * step
                films, coolant = self.films(time_s, inputs["spindle_rpm"][i], inputs, i)
                inverse, A, room, chill = self.solver(films, coolant, step)
                load = self.heats(theta, inputs, i, time_s) + cold * chill

                def warm(at):
                    share = (k + at) / count
                    air = (1 - share) * inputs["room_C"][i] + share * inputs["room_C"][i + 1] - REFERENCE_C
                    return load + air * room

                first = inverse @ (warm(GAMMA) - A @ theta)
                second = inverse @ (warm(1.0) - A @ (theta + (1 - GAMMA) * step * first))
                theta = theta + step * ((1 - GAMMA) * first + GAMMA * second)
            states[i + 1] = theta
        readings = {key: REFERENCE_C + states @ row for key, row in rows.items()}
        growths = {}
        for channel in self.machine_channels():
            gain = sum(model("g", f"{channel} {p}") * truth["expansion"][p] for p in truth["expansion"])
            growths[channel] = 1e6 * ((states - states[0]) @ gain)
        self._hidden_growth(growths, inputs)
        return readings, growths, theta

    def machine_channels(self):
        return sorted({key.split(" ")[0] for key in self.model.keys("g")})

    def _hidden_growth(self, growths, inputs):
        truth, times = self.truth, inputs["time_s"]
        main = growths[self.machine.growth]
        if truth.get("ambient_um_K", 0.0):
            room = inputs["room_C"] - inputs["room_C"][0]
            main += truth["ambient_um_K"] * lagged(room, times, truth["ambient_lag_s"])
        if truth.get("creep_um", 0.0):
            main += truth["creep_um"] * np.log1p(times / truth["creep_s"])
        if truth.get("slip_um", 0.0) and truth["recording"] == 0:
            # The clamp gives way each time the part has grown by another step.
            grown = np.abs(main) / max(1e-9, np.max(np.abs(main)))
            main += truth["slip_um"] * np.floor(3.2 * np.maximum.accumulate(grown))
