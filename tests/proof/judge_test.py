#!/usr/bin/env python3
"""The judge of cases on answers written by hand."""

import unittest

from judge import calibration, intervals_of, judge, overlap


def answer(verdict, *effects, channels=None, mismatch=None):
    named = [
        {"id": e[0], "confidence": e[1], "component": None, "channel": None, "position_mm": None, **(e[2] if len(e) > 2 else {})}
        for e in effects
    ]
    return {"verdict": verdict, "effects": named, "channels": channels or [], "mismatch": mismatch or {}}


def hidden(name, half=(), **facts):
    return {"name": name, "right": [name], "half": list(half), **facts}


SOURCE = hidden("extra_heat_source", ["standing_heat"], component="rod", position_mm=200, tolerance_mm=30)
DRAUGHT = hidden("draught", intervals_s=[[100, 300]])


class Outcomes(unittest.TestCase):
    def outcome(self, expected_hidden, given, **expected):
        return judge({"hidden": expected_hidden, **expected}, given)["outcome"]

    def test_right_place_is_right_and_another_place_half(self):
        near = answer("missing_effect", ("extra_heat_source", 0.9, {"component": "rod", "position_mm": 215}))
        far = answer("missing_effect", ("extra_heat_source", 0.9, {"component": "rod", "position_mm": 260}))
        self.assertEqual(self.outcome([SOURCE], near), "right")
        self.assertEqual(self.outcome([SOURCE], far), "half")

    def test_another_component_is_wrong(self):
        given = answer("missing_effect", ("extra_heat_source", 0.95, {"component": "bed"}))
        said = judge({"hidden": [SOURCE]}, given)
        self.assertEqual(said["outcome"], "wrong")
        self.assertTrue(said["sure_and_wrong"])

    def test_acceptable_effect_is_half(self):
        given = answer("missing_effect", ("standing_heat", 0.9, {"component": "rod"}))
        self.assertEqual(self.outcome([SOURCE], given), "half")

    def test_acceptable_only_below_a_confidence(self):
        one = [hidden("convection", [{"id": "structure_lag", "max_confidence": 0.8}])]
        self.assertEqual(self.outcome(one, answer("missing_effect", ("structure_lag", 0.7))), "half")
        self.assertEqual(self.outcome(one, answer("missing_effect", ("structure_lag", 0.9))), "wrong")

    def test_further_wrong_effect_leaves_the_first_right(self):
        given = answer("missing_effect", ("extra_heat_source", 0.9, {"component": "rod"}), ("sensor_lag", 0.6))
        self.assertEqual(self.outcome([SOURCE], given), "first")

    def test_tolerated_effect_does_not_count(self):
        given = answer("missing_effect", ("sensor_lag", 0.95), ("extra_heat_source", 0.9, {"component": "rod"}))
        self.assertEqual(self.outcome([SOURCE], given, tolerated=["sensor_lag"]), "right")

    def test_intervals_decide(self):
        good = answer("missing_effect", ("draught", 0.9, {"intervals_s": [[110, 320]]}))
        late = answer("missing_effect", ("draught", 0.9, {"parameters": {"from_s": 500, "to_s": 700}}))
        self.assertEqual(self.outcome([DRAUGHT], good), "right")
        self.assertEqual(self.outcome([DRAUGHT], late), "half")

    def test_unexplained_is_honest_unless_a_wrong_effect_is_named_with_it(self):
        self.assertEqual(self.outcome([SOURCE], answer("unexplained")), "honest")
        self.assertEqual(self.outcome([SOURCE], answer("unexplained", ("radiation", 0.5))), "honest")
        self.assertEqual(self.outcome([SOURCE], answer("unexplained", ("radiation", 0.85))), "wrong")

    def test_unexplained_has_to_point_at_the_time_where_it_is_known(self):
        there = answer("unexplained", mismatch={"time_s": [[250, 400]]})
        elsewhere = answer("unexplained", mismatch={"time_s": [[600, 900]]})
        self.assertEqual(self.outcome([DRAUGHT], there, honest={"intervals_s": [[100, 300]]}), "honest")
        self.assertEqual(self.outcome([DRAUGHT], elsewhere, honest={"intervals_s": [[100, 300]]}), "wrong")

    def test_consistent_although_something_is_hidden_is_missed(self):
        self.assertEqual(self.outcome([SOURCE], answer("consistent")), "missed")
        self.assertEqual(self.outcome([{"name": "creep", "right": [], "half": []}], answer("consistent"), unlisted=True), "missed")

    def test_nothing_hidden(self):
        self.assertEqual(self.outcome([], answer("consistent")), "right")
        self.assertEqual(self.outcome([], answer("unexplained")), "honest")
        self.assertEqual(self.outcome([], answer("missing_effect", ("convection", 0.5))), "wrong")
        self.assertEqual(self.outcome([], answer("unexplained", ("convection", 0.4))), "honest")
        self.assertEqual(self.outcome([], answer("unexplained", ("convection", 0.6))), "wrong")

    def test_unlisted_is_right_when_unexplained(self):
        one = [{"name": "unlisted:creep", "right": [], "half": ["bracket_slip"]}]
        self.assertEqual(self.outcome(one, answer("unexplained"), unlisted=True), "right")
        self.assertEqual(self.outcome(one, answer("missing_effect", ("sensor_lag", 0.7)), unlisted=True), "wrong")
        self.assertEqual(self.outcome(one, answer("missing_effect", ("bracket_slip", 0.7)), unlisted=True), "half")

    def test_verdict_that_is_right_by_itself(self):
        self.assertEqual(self.outcome([SOURCE], answer("unexplained"), right_verdicts=["unexplained"]), "right")

    def test_pair_needs_both(self):
        both = [SOURCE, hidden("sensor_lag", channel="T1_C")]
        source = ("extra_heat_source", 0.9, {"component": "rod"})
        self.assertEqual(self.outcome(both, answer("missing_effect", source, ("sensor_lag", 0.9, {"channel": "T1_C"}))), "right")
        self.assertEqual(self.outcome(both, answer("missing_effect", source)), "first")
        self.assertEqual(self.outcome(both, answer("missing_effect", source, ("sensor_lag", 0.9, {"channel": "T2_C"}))), "first")

    def test_required_effect(self):
        both = [hidden("convection", required=True), hidden("heater_body")]
        self.assertEqual(self.outcome(both, answer("missing_effect", ("heater_body", 0.9))), "wrong")

    def test_what_nothing_names_is_right_when_its_channel_is_unexplained(self):
        both = [hidden("convection"), {"name": "Z by the bed", "right": [], "half": [], "channel": "dZ_um"}]
        left = [{"channel": "dZ_um", "verdict": "unexplained"}]
        self.assertEqual(self.outcome(both, answer("missing_effect", ("convection", 0.9), channels=left)), "right")
        self.assertEqual(self.outcome(both, answer("missing_effect", ("convection", 0.9))), "first")


class Figures(unittest.TestCase):
    def test_overlap_is_intersection_over_union(self):
        self.assertAlmostEqual(overlap([[0, 10]], [[5, 15]]), 5 / 15)
        self.assertAlmostEqual(overlap([[0, 2], [4, 6]], [[0, 6]]), 4 / 6)
        self.assertIsNone(overlap([], [[0, 1]]))

    def test_intervals_of_an_effect_that_is_there_twice(self):
        effect = {"parameters": [{"from_s": 1, "to_s": 2}, {"from_s": 5, "to_s": 9}]}
        self.assertEqual(intervals_of(effect), [[1, 2], [5, 9]])

    def test_calibration_error_weighs_bins_by_their_effects(self):
        judged = [{"confidence": [[0.95, "right"]] * 3 + [[0.55, "wrong"]]}]
        bins, error = calibration(judged)
        self.assertEqual([one["effects"] for one in bins], [1, 3])
        self.assertAlmostEqual(error, 0.75 * 0.05 + 0.25 * 0.55)


if __name__ == "__main__":
    unittest.main()
