#!/usr/bin/env python3
"""The motor flange, meshed and assembled anew: what theory says of it, and that its cases can be repeated.

Skipped (77) without gmsh, FreeFEM, numpy or scipy.
"""

import filecmp
import json
import pathlib
import shutil
import sys
import tempfile
import unittest

missing = [name for name in ("gmsh", "FreeFem++-nw") if shutil.which(name) is None]
try:
    import numpy as np
    import scipy  # noqa: F401
except ImportError:
    missing.append("python3-numpy python3-scipy")
if missing:
    print("skipped: needs " + ", ".join(missing) + " (Debian: gmsh freefem++ libfreefem++ python3-numpy python3-scipy)")
    sys.exit(77)

import cases
import matrices
from solid_run import Reduced, Scaled, SolidRun
from structures import STRUCTURES

NAME = "motor_flange"


class MotorFlange(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = matrices.reduce(NAME, pathlib.Path(cls.folder.name))
        cls.model = Reduced(cls.path)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def gain(self, channel):
        return sum(self.model("g", key) for key in self.model.keys("g") if key.startswith(channel + " "))

    def test_reduced_model_follows_the_full_one(self):
        self.assertLess(float(self.model.data["error"]), 1e-3)

    def test_uniform_warming_lengthens_the_lantern_by_alpha_l(self):
        grown = 1e6 * self.gain("dZ_um") @ self.model.uniform
        self.assertAlmostEqual(grown, 1.15e-5 * 265e3, delta=0.05 * 1.15e-5 * 265e3)

    def test_uniform_warming_does_not_move_it_sideways(self):
        self.assertLess(abs(1e6 * self.gain("dY_um") @ self.model.uniform), 0.02)

    def test_volumes_are_those_of_the_drawing(self):
        self.assertAlmostEqual(float(self.model("volume_m3", "wall")), 0.4 * 0.4 * 0.04, places=6)
        self.assertAlmostEqual(float(self.model("volume_m3", "motor")), np.pi * 0.09**2 * 0.2, delta=1e-4)  # a polygon

    def test_larger_structure_has_the_scaled_volume_and_growth(self):
        twice = Scaled(self.model, 2.0)
        self.assertAlmostEqual(float(twice("volume_m3", "wall")), 8 * float(self.model("volume_m3", "wall")))
        grown = sum(twice("g", key) for key in twice.keys("g") if key.startswith("dZ_um ")) @ twice.uniform
        self.assertAlmostEqual(1e6 * grown, 2e6 * self.gain("dZ_um") @ self.model.uniform, places=6)

    def test_heat_put_in_is_stored_where_nothing_is_lost(self):
        draw = cases.Draw(1)
        machine, structure = cases.MACHINES[NAME], STRUCTURES[NAME]()
        tolerance = dict.fromkeys(("conductivity", "heat_capacity", "heat_source_power", "film", "expansion"), 0.05)
        truth, _ = cases.draw_truth(draw, structure, machine, tolerance)
        cases.align(truth, self.model)
        truth["films"] = dict.fromkeys(truth["films"], 0.0)
        truth["sources"] = []
        truth["extra"] = [{"load": "motor", "law": "constant", "power_W": 50.0}]
        times = np.arange(0, 3601, 60.0)
        inputs = {"time_s": times, "spindle_rpm": 0 * times, "room_C": 0 * times + 20.0}
        run = SolidRun(self.model, machine, truth)
        _, _, end = run.simulate(inputs, np.zeros(self.model.size), {})
        stored = self.model.uniform @ run.M @ end
        self.assertAlmostEqual(stored / (50.0 * 3600.0), 1.0, places=3)

    def test_same_seed_gives_the_same_case_and_states_what_is_hidden(self):
        folder = pathlib.Path(self.folder.name)
        for out in ("first", "again"):
            case = cases.Case("5", 3, {NAME: self.model}, "sensor_lag", NAME)
            case.write(folder / out)
        names = ["machine.json", "r1.csv", "expected.json"]
        self.assertEqual(filecmp.cmpfiles(folder / "first", folder / "again", names, shallow=False)[0], names)
        expected = json.loads((folder / "first" / "expected.json").read_text())
        self.assertEqual(expected["hidden"][0]["right"], ["sensor_lag"])
        self.assertGreaterEqual(expected["hidden"][0]["strength"], cases.STRENGTH_SIGMA[0])


if __name__ == "__main__":
    unittest.main()
