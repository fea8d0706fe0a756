"""Three machine parts as solids: geometry for gmsh, parts, surfaces, and how an engineer would describe them.

x runs along the described component in millimetres, from its fixed end. A part is a body of one material; parts that
touch are joined by an interface with a contact conductance.
"""

import math
from dataclasses import dataclass, field

STEEL = {"k": 45.0, "rho": 7850.0, "c": 460.0, "alpha": 1.15e-5, "E": 2.1e11, "nu": 0.3}
CAST_IRON = {"k": 48.0, "rho": 7200.0, "c": 500.0, "alpha": 1.05e-5, "E": 1.2e11, "nu": 0.26}
# Laminations and windings with their housing, averaged.
MOTOR = {"k": 22.0, "rho": 6800.0, "c": 480.0, "alpha": 1.2e-5, "E": 1.0e11, "nu": 0.3}
# Two rings with balls and oil between them: little conducts, the axial stiffness is that of the contact.
BEARING = {"k": 5.0, "rho": 6500.0, "c": 460.0, "alpha": 1.15e-5, "E": 5.0e9, "nu": 0.3}
FLOATING_BEARING = dict(BEARING, E=5.0e6)


@dataclass
class Part:
    name: str
    material: dict
    volumes: list  # gmsh volume tags
    elastic: bool = True


@dataclass
class Structure:
    name: str
    geo: str
    parts: list
    # surface name -> (part, test of a triangle's centre x, y, z); what no test takes is "<part>" itself
    surfaces: dict
    contacts: dict  # (part, part) -> W/(m2 K) nominal, of both sides together; absent: 1e5, one casting
    fixed: object  # test of a point: the elastic body is held there
    displacements: dict  # channel -> (direction 0..2, test of the points whose mean moves, test of the reference or None)
    symmetric: set = field(default_factory=set)  # displacements that stay 0 unless something is lopsided


def box(tag, x, y, z):
    return f"Box({tag}) = {{{x[0]}, {y[0]}, {z[0]}, {x[1] - x[0]}, {y[1] - y[0]}, {z[1] - z[0]}}};\n"


def cylinder(tag, x, radius):
    return f"Cylinder({tag}) = {{{x[0]}, 0, 0, {x[1] - x[0]}, 0, 0, {radius}}};\n"


def difference(tag, body, tools):
    volumes = ", ".join(str(t) for t in tools)
    return f"BooleanDifference({tag}) = {{ Volume{{{body}}}; Delete; }}{{ Volume{{{volumes}}}; Delete; }};\n"


def fragments(tags, sizes):
    head = f"BooleanFragments{{ Volume{{{tags[0]}}}; Delete; }}{{ Volume{{{', '.join(map(str, tags[1:]))}}}; Delete; }}\n"
    lines = [f"MeshSize{{ PointsOf{{ Volume{{{tag}}}; }} }} = {size};\n" for tag, size in sizes]
    return head + "".join(lines)


GEO_HEAD = 'SetFactory("OpenCASCADE");\nMesh.Algorithm3D = 1;\nMesh.Optimize = 1;\nMesh.SaveAll = 1;\n'


def column():
    """A box column of two castings on its bed, guideways with a carriage in front, a motor on top."""
    geo = GEO_HEAD
    geo += box(1, (-150, 0), (-300, 300), (-350, 350))
    geo += box(2, (0, 540), (-150, 150), (-200, 200))
    geo += box(21, (0, 540), (-120, 120), (-170, 170))
    geo += difference(3, 2, [21])
    geo += box(4, (540, 900), (-150, 150), (-200, 200))
    geo += box(22, (540, 870), (-120, 120), (-170, 170))
    geo += difference(5, 4, [22])
    geo += box(6, (60, 840), (150, 175), (-150, -115))
    geo += box(7, (60, 840), (150, 175), (115, 150))
    geo += box(8, (350, 600), (175, 245), (-170, 170))
    geo += box(9, (900, 1080), (-80, 80), (-80, 80))
    tags = [1, 3, 5, 6, 7, 8, 9]
    geo += fragments(tags, [(1, 80), (9, 38), (8, 38), (3, 34), (5, 34), (6, 26), (7, 26)])
    parts = [
        Part("bed", CAST_IRON, [1]),
        Part("lower", CAST_IRON, [3]),
        Part("upper", CAST_IRON, [5]),
        Part("rails", STEEL, [6, 7]),
        Part("carriage", CAST_IRON, [8]),
        Part("motor", MOTOR, [9]),
    ]

    def inside(x, y, z):
        return abs(y) < 121 and abs(z) < 171 and 0 < x < 871

    surfaces = {
        "lower_inside": ("lower", inside),
        "upper_inside": ("upper", inside),
        "floor": ("bed", lambda x, y, z: x < -149.0),
        "rails_run": ("rails", lambda x, y, z: y > 174.0),
    }
    contacts = {
        ("bed", "lower"): 6000.0,
        ("lower", "upper"): 1e5,
        ("lower", "rails"): 8000.0,
        ("upper", "rails"): 8000.0,
        ("rails", "carriage"): 1500.0,
        ("upper", "motor"): 2500.0,
    }
    return Structure(
        "column",
        geo,
        parts,
        surfaces,
        contacts,
        fixed=lambda x, y, z: x < -149.9,
        displacements={
            "dZ_um": (0, lambda x, y, z: abs(x - 900) < 0.1, lambda x, y, z: abs(x) < 0.1 and abs(y) < 151 and abs(z) < 201),
            "dY_um": (1, lambda x, y, z: abs(x - 900) < 0.1, None),
            "dX_um": (2, lambda x, y, z: abs(x - 900) < 0.1, None),
        },
        symmetric={"dX_um"},
    )


def ball_screw():
    """A ball screw between two bearing housings on their base; the nut carries a table."""
    geo = GEO_HEAD
    geo += box(1, (-60, 1060), (-100, 100), (-150, -60))
    geo += box(2, (0, 80), (-60, 60), (-60, 60))
    geo += cylinder(21, (0, 80), 45)
    geo += difference(3, 2, [21])
    geo += box(4, (920, 1000), (-60, 60), (-60, 60))
    geo += cylinder(22, (920, 1000), 45)
    geo += difference(5, 4, [22])
    geo += cylinder(6, (0, 80), 45)
    geo += cylinder(23, (0, 80), 20)
    geo += difference(7, 6, [23])
    geo += cylinder(8, (920, 1000), 45)
    geo += cylinder(24, (920, 1000), 20)
    geo += difference(9, 8, [24])
    geo += cylinder(10, (0, 300), 20)
    geo += cylinder(11, (300, 1000), 20)
    geo += box(12, (440, 560), (-60, 60), (-50, 60))
    geo += cylinder(25, (440, 560), 25)
    geo += difference(13, 12, [25])
    geo += box(14, (400, 600), (-110, 110), (60, 90))
    tags = [1, 3, 5, 7, 9, 10, 11, 13, 14]
    geo += fragments(tags, [(1, 60), (14, 40), (13, 24), (3, 24), (5, 24), (7, 15), (9, 15), (10, 11), (11, 11)])
    parts = [
        Part("base", CAST_IRON, [1]),
        Part("fixed_housing", CAST_IRON, [3]),
        Part("floating_housing", CAST_IRON, [5]),
        Part("fixed_bearing", BEARING, [7]),
        Part("floating_bearing", FLOATING_BEARING, [9]),
        Part("screw", STEEL, [10]),
        Part("screw_far", STEEL, [11]),
        Part("nut", STEEL, [13], elastic=False),
        Part("table", CAST_IRON, [14], elastic=False),
    ]
    surfaces = {
        "floor": ("base", lambda x, y, z: z < -149.0),
        "nut_bore": ("nut", lambda x, y, z: math.hypot(y, z) < 26.0),
        "screw_end": ("screw", lambda x, y, z: x < 0.5),
        "screw_far_end": ("screw_far", lambda x, y, z: x > 999.5),
    }
    contacts = {
        ("base", "fixed_housing"): 4000.0,
        ("base", "floating_housing"): 4000.0,
        ("fixed_housing", "fixed_bearing"): 5000.0,
        ("floating_housing", "floating_bearing"): 3000.0,
        ("fixed_bearing", "screw"): 5000.0,
        ("floating_bearing", "screw_far"): 5000.0,
        ("screw", "screw_far"): 1e5,
        ("nut", "table"): 4000.0,
    }
    return Structure(
        "ball_screw",
        geo,
        parts,
        surfaces,
        contacts,
        fixed=lambda x, y, z: z < -149.9 and x < 120,
        displacements={
            "dX_um": (0, lambda x, y, z: x > 999.9 and math.hypot(y, z) < 20.1, lambda x, y, z: x < 0.1 and math.hypot(y, z) < 20.1),
            "dY_um": (2, lambda x, y, z: x > 999.9 and math.hypot(y, z) < 20.1, None),
        },
        symmetric=set(),
    )


def motor_flange():
    """A motor on a lantern whose flange is bolted to a wall; a bearing sits in the bore, a cooling ring around it."""
    geo = GEO_HEAD
    geo += box(1, (-40, 0), (-200, 200), (-200, 200))
    geo += cylinder(2, (0, 25), 120)
    geo += cylinder(3, (25, 145), 50)
    geo += cylinder(4, (145, 265), 50)
    geo += cylinder(21, (0, 25), 30)
    geo += cylinder(22, (25, 145), 30)
    geo += cylinder(23, (145, 265), 30)
    geo += difference(5, 2, [21])
    geo += difference(6, 3, [22])
    geo += difference(7, 4, [23])
    geo += cylinder(8, (265, 465), 90)
    tags = [1, 5, 6, 7, 8]
    geo += fragments(tags, [(1, 45), (8, 28), (5, 18), (6, 12), (7, 12)])
    parts = [
        Part("wall", CAST_IRON, [1]),
        Part("flange", STEEL, [5, 6]),
        Part("lantern", STEEL, [7]),
        Part("motor", MOTOR, [8]),
    ]
    surfaces = {
        "bearing_seat": ("flange", lambda x, y, z: math.hypot(y, z) < 31 and 30 < x < 65),
        "flange_bore": ("flange", lambda x, y, z: math.hypot(y, z) < 31),
        "lantern_bore": ("lantern", lambda x, y, z: math.hypot(y, z) < 31),
        "motor_face": ("motor", lambda x, y, z: x < 265.5 and math.hypot(y, z) < 31),
        "cooling_ring": ("lantern", lambda x, y, z: math.hypot(y, z) > 45 and 195 < x < 245),
        "wall_behind": ("wall", lambda x, y, z: x < -39.5),
    }
    contacts = {("wall", "flange"): 5000.0, ("flange", "lantern"): 1e5, ("lantern", "motor"): 3000.0}
    return Structure(
        "motor_flange",
        geo,
        parts,
        surfaces,
        contacts,
        fixed=lambda x, y, z: x < -39.9 and math.hypot(y, z) > 150,
        displacements={
            "dZ_um": (0, lambda x, y, z: abs(x - 265) < 0.1 and math.hypot(y, z) < 50.1, lambda x, y, z: abs(x) < 0.1 and math.hypot(y, z) < 60),
            "dY_um": (1, lambda x, y, z: abs(x - 265) < 0.1 and math.hypot(y, z) < 50.1, None),
        },
        symmetric={"dY_um"},
    )


STRUCTURES = {"column": column, "ball_screw": ball_screw, "motor_flange": motor_flange}
