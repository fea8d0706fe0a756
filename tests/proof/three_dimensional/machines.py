"""What runs on each structure: heat sources, sensors, places where something may be hidden, and the description.

The description is the one that an engineer would write from drawings: the long part as a rod of the same section and
surface, what hangs on it as lumps joined by estimated conductances.
"""

import copy
import math

from structures import STRUCTURES


def near(x0, width):
    return lambda x, y, z: math.exp(-0.5 * ((x - x0) / width) ** 2)


def within(low, high):
    return lambda x, y, z: 1.0 if low <= x <= high else 0.0


def series(*conductances):
    return 1.0 / sum(1.0 / g for g in conductances)


class Coupling:
    """A joint between a lump and the rod (at a place) or another lump; `across`: the interface or bridge it stands for."""

    def __init__(self, lump, other, place_mm, across):
        self.lump, self.other, self.place_mm, self.across = lump, other, place_mm, across
        self.name = f"{self.other} at {self.place_mm:g}"


class Machine:
    """Of each structure; lengths in mm, heats in W. Lengths are those of the mesh times `size`."""

    size = 1.0

    name = ""
    rod = ""  # the component that is long
    length = 0.0
    outer = bore = 0.0
    rod_parts = ()
    rod_material = ""
    further_rods = {}
    lumps = {}  # component -> parts
    turning = ()  # surfaces whose film grows with the speed
    speed_film_component = ""
    further_sensors = {}  # reading -> (rod, place)
    joint = None  # interface that a hidden contact resistance opens
    joint_mm = 0.0
    bridges = {}  # name -> (load, load, W/K): heat between the means of two loads
    heat_places = {}  # load -> (component, position in mm or None)
    sides = {}  # source -> lopsided twin of its load, for bending
    displacements = ()
    bending = ""  # the displacement across, whose nominal value is 0
    growth = ""
    rpm = (1000, 6000)
    feed = None  # m/min
    coolant = None  # (surface, component, from, to)
    fan = None  # (surfaces, component)
    draught = ()  # surfaces

    def solid_loads(self, solid):
        raise NotImplementedError

    def loads(self, solid):
        return self.solid_loads(solid)

    def scaled(self, size):
        """The machine that a structure of another size carries."""
        other = copy.copy(self)
        other.size = size
        return other

    def mm(self, length):
        """A length of the mesh in that of this machine, as a drawing would state it."""
        return None if length is None else round(length * self.size, 1)

    def averages(self, solid):
        """Means over a rod's section where a lump is joined to it."""
        rows = {}
        for coupling in self.couplings():
            rod = self.rods()[coupling.other]
            weight = near(coupling.place_mm + rod["starts_at_mm"], 0.03 * rod["length_mm"])
            masses = [solid.M[solid.names.index(part)] @ [weight(*p) for p in solid.points] for part in rod["parts"]]
            total = sum(masses)
            rows[coupling.name] = total / total.sum()
        return rows

    def rods(self):
        """Components described as rods; x of the solid is starts_at_mm where theirs is 0."""
        main = {
            "length_mm": self.length,
            "outer_diameter_mm": self.outer,
            "bore_diameter_mm": self.bore,
            "material": self.rod_material,
            "parts": self.rod_parts,
            "starts_at_mm": 0.0,
        }
        return {self.rod: main, **self.further_rods}


class Column(Machine):
    name = "column"
    rod = "column"
    length, outer, bore = 900.0, 446.0, 384.0
    rod_parts = ("lower", "upper", "rails")
    lumps = {"bed": ("bed",), "carriage": ("carriage",), "motor": ("motor",)}
    turning = ("motor",)
    speed_film_component = "motor"
    joint, joint_mm = ("lower", "upper"), 540.0
    heat_places = {
        "heat 250": ("column", 250.0),
        "heat 420": ("column", 420.0),
        "heat 720": ("column", 720.0),
        "heat bed": ("bed", None),
        "heat carriage": ("carriage", None),
    }
    growth, bending = "dZ_um", "dY_um"
    symmetric = "dX_um"
    rpm = (1000, 8000)
    feed = (4.0, 20.0)
    coolant = ("lower", "column", 0.0, 540.0)
    fan = (("motor",), "motor")
    draught = ("lower", "upper", "rails", "carriage", "motor", "bed")
    rod_material = "cast iron"

    def solid_loads(self, solid):
        run = solid.surface_load("rails_run", within(150, 800))
        carriage = solid.volume_load("carriage", lambda x, y, z: 1.0)
        return {
            "motor": solid.volume_load("motor", lambda x, y, z: 1.0),
            "guide": 0.5 * run + 0.5 * carriage,
            "guide lopsided": 0.5 * solid.surface_load("rails_run", lambda x, y, z: float(150 < x < 800 and z > 0)) + 0.5 * carriage,
            "heat 250": solid.surface_load("lower", lambda x, y, z: near(250, 45)(x, y, z) * (y < -149)),
            "heat 420": solid.surface_load("lower", lambda x, y, z: near(420, 45)(x, y, z) * (abs(z) > 199)),
            "heat 720": solid.surface_load("upper", lambda x, y, z: near(720, 45)(x, y, z) * (y < -149)),
            "heat bed": solid.surface_load("bed", lambda x, y, z: float(y < -299)),
            "heat carriage": solid.surface_load("carriage", lambda x, y, z: 1.0),
            "heat back": solid.surface_load("lower", lambda x, y, z: float(y < -149)),
        }

    def readings(self, solid):
        rows = {}
        for x in range(30, 900, 30):
            sides = {"front": (x, 150, 12), "side": (x, -10, 200), "back": (x, -150, 15), "other": (x, 10, -200)}
            for key, point in sides.items():
                rows[f"column {x} {key}"] = solid.reading(point, ("lower", "upper"))
        rows["bed"] = solid.reading((-60, 300, 80))
        rows["carriage"] = solid.reading((470, 245, 20), ("carriage",))
        rows["motor"] = solid.reading((1000, 80, 10), ("motor",))
        return rows

    def sources(self, d):
        """Heat sources of the description, with the load each stands for; `d` draws."""
        return [
            {"component": "motor", "load": "motor", "id": "motor", "kind": "motor", "rated_power_W": d.choice([2200, 3700, 5500]), "efficiency": d.choice([0.9, 0.92]), "rated_speed_rpm": 8000},
            {"component": "column", "load": "guide", "share": 0.5, "id": "guide", "kind": "guide", "channel": "feed_x_mm_min", "from_mm": 150, "to_mm": 800, "friction_N": d.choice([300, 450, 600])},
            {"component": "carriage", "load": None, "share": 0.5, "id": "carriage_guide", "kind": "guide", "channel": "feed_x_mm_min", "like": "guide"},
        ]

    def couplings(self):
        return [
            Coupling("bed", "column", 20.0, ("bed", "lower")),
            Coupling("carriage", "column", 475.0, ("rails", "carriage")),
            Coupling("motor", "column", 885.0, ("upper", "motor")),
        ]


BASE_SENSOR_MM = 360.0


class BallScrew(Machine):
    name = "ball_screw"
    rod = "screw"
    length, outer, bore = 1000.0, 39.3, 0.0  # of the threaded section, 40 over the crests
    rod_parts = ("screw", "screw_far")
    lumps = {
        "fixed_housing": ("fixed_housing", "fixed_bearing"),
        "floating_housing": ("floating_housing", "floating_bearing"),
        "nut": ("nut", "table"),
    }
    # The base is as long as the screw: no lump. A rod of its section and its perimeter.
    further_rods = {
        "base": {
            "length_mm": 1120.0,
            "outer_diameter_mm": 185.0,
            "bore_diameter_mm": 107.0,
            "material": "cast iron",
            "parts": ("base",),
            "starts_at_mm": -60.0,
        }
    }
    turning = ("screw", "screw_far")
    speed_film_component = "screw"
    joint, joint_mm = ("screw", "screw_far"), 300.0
    bridges = {"nut on screw": ("nut stroke", "nut body", 5.0)}
    heat_places = {
        "heat 190": ("screw", 190.0),
        "heat 820": ("screw", 820.0),
        "heat fixed_housing": ("fixed_housing", None),
        "heat base": ("base", 560.0),
    }
    growth, bending = "dX_um", "dY_um"
    symmetric = None
    rpm = (600, 3000)
    feed = (3.0, 24.0)
    coolant = ("fixed_housing", "fixed_housing", None, None)
    fan = (("floating_housing",), "floating_housing")
    further_sensors = {"base": ("base", BASE_SENSOR_MM)}
    draught = ("screw", "screw_far", "fixed_housing", "floating_housing", "nut", "table", "base")
    rod_material = "steel"

    def solid_loads(self, solid):
        stroke = solid.volume_load("screw_far", within(320, 700))
        nut = solid.volume_load("nut", lambda x, y, z: 1.0)
        return {
            "fixed_bearing": solid.volume_load("fixed_bearing", lambda x, y, z: 1.0),
            "floating_bearing": solid.volume_load("floating_bearing", lambda x, y, z: 1.0),
            "nut": 0.5 * stroke + 0.5 * nut,
            "nut stroke": stroke,
            "nut body": nut,
            "heat 190": solid.volume_load("screw", near(190, 15)),
            "heat 820": solid.volume_load("screw_far", near(820, 15)),
            "heat fixed_housing": solid.surface_load("fixed_housing"),
            "heat base": solid.surface_load("base", near(500, 60)),
        }

    def readings(self, solid):
        rows = {}
        for x in range(100, 910, 30):
            rows[f"screw {x} side"] = solid.reading((x, 14.2, 14.1), ("screw", "screw_far"))
        rows["fixed_housing"] = solid.reading((40, 60, 12), ("fixed_housing",))
        rows["floating_housing"] = solid.reading((960, 60, 12), ("floating_housing",))
        rows["nut"] = solid.reading((500, 60, 8), ("nut",))
        rows["base"] = solid.reading((BASE_SENSOR_MM - 60, 100, -90), ("base",))
        return rows

    def sources(self, d):
        fixed = {"kind": "bearing", "mean_diameter_mm": 65, "f0": 2.0, "f1": 0.001, "load_N": d.choice([600, 900, 1500]), "oil_viscosity_mm2_s": d.choice([32, 46])}
        floating = dict(fixed, load_N=d.choice([100, 200]), f0=1.5)
        return [
            dict(fixed, component="screw", load="fixed_bearing", share=0.5, id="fixed_bearing", from_mm=10, to_mm=70),
            dict(fixed, component="fixed_housing", load=None, share=0.5, id="fixed_bearing_outer", like="fixed_bearing"),
            dict(floating, component="screw", load="floating_bearing", share=0.5, id="floating_bearing", from_mm=930, to_mm=990),
            dict(floating, component="floating_housing", load=None, share=0.5, id="floating_bearing_outer", like="floating_bearing"),
            {"component": "screw", "load": "nut", "share": 0.5, "id": "nut", "kind": "nut", "channel": "feed_x_mm_min", "from_mm": 320, "to_mm": 700, "friction_N": d.choice([150, 250, 400])},
            {"component": "nut", "load": None, "share": 0.5, "id": "nut_body", "kind": "nut", "channel": "feed_x_mm_min", "like": "nut"},
        ]

    def couplings(self):
        return [
            Coupling("fixed_housing", "screw", 40.0, ("fixed_bearing", "screw")),
            Coupling("floating_housing", "screw", 960.0, ("floating_bearing", "screw_far")),
            Coupling("nut", "screw", 510.0, "nut on screw"),
            Coupling("fixed_housing", "base", 100.0, ("base", "fixed_housing")),
            Coupling("floating_housing", "base", 1020.0, ("base", "floating_housing")),
        ]


class MotorFlange(Machine):
    name = "motor_flange"
    rod = "lantern"
    length, outer, bore = 265.0, 100.0, 60.0
    rod_parts = ("flange", "lantern")
    lumps = {"wall": ("wall",), "motor": ("motor",)}
    turning = ("motor",)
    speed_film_component = "motor"
    joint, joint_mm = ("flange", "lantern"), 145.0
    heat_places = {
        "heat 105": ("lantern", 105.0),
        "heat 190": ("lantern", 190.0),
        "heat wall": ("wall", None),
        "heat motor": ("motor", None),
    }
    growth, bending = "dZ_um", "dY_um"
    symmetric = "dY_um"
    rpm = (1000, 6000)
    coolant = ("cooling_ring", "lantern", 195.0, 245.0)
    fan = (("lantern", "flange"), "lantern")
    draught = ("flange", "lantern", "motor", "wall")
    rod_material = "steel"

    def solid_loads(self, solid):
        return {
            "motor": solid.volume_load("motor", lambda x, y, z: 1.0),
            "bearing": solid.surface_load("bearing_seat"),
            "bearing lopsided": solid.surface_load("bearing_seat", lambda x, y, z: float(y > 0)),
            "heat 105": solid.surface_load("flange", lambda x, y, z: near(105, 10)(x, y, z) * (math.hypot(y, z) > 45)),
            "heat 190": solid.surface_load("lantern_bore", near(190, 10)),
            "heat wall": solid.surface_load("wall", lambda x, y, z: 1.0),
            "heat motor": solid.surface_load("motor", lambda x, y, z: 1.0),
            "heat top": solid.surface_load("lantern", lambda x, y, z: float(y > 30)),
        }

    def readings(self, solid):
        rows = {}
        for x in range(40, 260, 10):
            rows[f"lantern {x} side"] = solid.reading((x, 12, 48.5), ("flange", "lantern"))
            rows[f"lantern {x} other"] = solid.reading((x, -10, -49), ("flange", "lantern"))
        rows["motor"] = solid.reading((365, 20, 88), ("motor",))
        rows["wall"] = solid.reading((0, 150, 120), ("wall",))
        return rows

    def sources(self, d):
        return [
            {"component": "motor", "load": "motor", "id": "motor", "kind": "motor", "rated_power_W": d.choice([1500, 2200, 3000]), "efficiency": d.choice([0.92, 0.94]), "rated_speed_rpm": 6000},
            {"component": "lantern", "load": "bearing", "id": "bearing", "kind": "bearing", "from_mm": 30, "to_mm": 65, "mean_diameter_mm": 60, "f0": 2.0, "f1": 0.001, "load_N": d.choice([300, 600]), "oil_viscosity_mm2_s": d.choice([22, 32])},
        ]

    def couplings(self):
        return [
            Coupling("wall", "lantern", 12.0, ("wall", "flange")),
            Coupling("motor", "lantern", 258.0, ("lantern", "motor")),
        ]


MACHINES = {"column": Column(), "ball_screw": BallScrew(), "motor_flange": MotorFlange()}
assert set(MACHINES) == set(STRUCTURES)
