# SPDX-License-Identifier: BSD-3-Clause
"""Bands and the nearest safe velocity from files of cases: closed forms of balls, what is refused."""
import json
import math
import unittest

from command import SOURCE, run


def ask(command, *cases):
    result = run(command, "-", input="".join(json.dumps(case) + "\n" for case in cases))
    return result, [json.loads(line) for line in result.stdout.splitlines()]


def ball(center, radius, velocity=None):
    return {"center": center, "semi_axes": [radius] * 3, **({"velocity": velocity} if velocity else {})}


def case(**fields):
    return {"id": 1, "agent": ball([0, 0, 0], 1), "agent_velocity": [0, 4, 0], "obstacles": [ball([0, 10, 0], 1, [0, 0, 0])],
            "horizon": 60, **fields}


class Decisions(unittest.TestCase):
    def test_bands_of_a_ball_ahead(self):
        answer = ask("bands", case())[1][0]
        half = math.degrees(math.asin(0.2))
        for found, right in zip(sum(answer["heading"]["free"], []), (half, 360 - half)):
            self.assertAlmostEqual(found, right, 9)
        self.assertAlmostEqual(answer["heading"]["conflict"][0][1], half, 9)
        self.assertAlmostEqual(answer["speed"]["free"][0][1], 8 / 60, 9)
        self.assertAlmostEqual(answer["climb"]["free"][1][0], 4 * math.tan(math.asin(0.2)), 9)
        self.assertAlmostEqual(answer["time_to_violation"], 2, 12)
        self.assertAlmostEqual(answer["last_manoeuvre"]["heading"], 2, 4)
        self.assertNotIn("altitude", answer)
        higher = ask("bands", case(limits={"altitude": [-5, 5]}))[1][0]["altitude"]
        self.assertAlmostEqual(higher["conflict"][0][1], 2, 9)

    def test_bands_with_wind_and_with_a_turn(self):
        # Drift alone leads past it.
        beside = ask("bands", case(wind=[2, 0, 0]))[1][0]
        self.assertIsNone(beside["time_to_violation"])
        slow = ask("bands", case(limits={"lateral": 2}))[1][0]
        at_once = ask("bands", case())[1][0]
        wide = lambda answer: sum(to - start for start, to in answer["heading"]["free"])
        self.assertLess(wide(slow), wide(at_once))
        self.assertLess(slow["last_manoeuvre"]["heading"], at_once["last_manoeuvre"]["heading"])
        inside = ask("bands", case(obstacles=[ball([0, 1, 0], 5, [0, 1, 0])]))[1][0]
        self.assertEqual(inside["heading"]["free"], [])
        self.assertIn("recovery", inside)

    def test_bands_with_a_margin_and_levels(self):
        half = lambda radius: math.degrees(math.asin(radius / 10))
        answer = ask("bands", case(margin=1))[1][0]
        self.assertAlmostEqual(answer["heading"]["conflict"][0][1], half(3), 9)
        self.assertAlmostEqual(answer["time_to_violation"], 7 / 4, 9)
        levels = ask("bands", case(levels=[3, 1, 0]))[1][0]["levels"]
        for level, margin in zip(levels, (3, 1, 0), strict=True):
            self.assertEqual(level["margin"], margin)
            self.assertAlmostEqual(level["heading"]["conflict"][0][1], half(2 + margin), 9)
        # Within the outer level now, the inner one ahead: out soonest straight away from it, and not through it.
        within = ask("bands", case(levels=[9, 0]))[1][0]
        self.assertEqual(within["levels"][0]["heading"]["free"], [])
        self.assertAlmostEqual(within["recovery"]["heading"], 180, delta=3)
        self.assertAlmostEqual(within["recovery"]["time"], 1 / 4, delta=0.01)

    def test_conflict_by_a_turn(self):
        answer = ask("bands", case(limits={"lateral": 2, "longitudinal": 1}))[1][0]
        for name, whole in (("heading", 360), ("speed", 8)):
            wide = {key: sum(to - start for start, to in answer[name][key]) for key in ("free", "conflict")}
            self.assertGreater(wide["conflict"], 0)
            self.assertAlmostEqual(sum(wide.values()), whole, delta=1e-3 * whole)

    def test_out_of_a_dent(self):
        dented = {"center": [0, 0, 0], "semi_axes": [5, 5, 5], "velocity": [0, 0, 0],
                  "hyperboloids": [{"semi_axes": [1, 1, 1], "sheets": 2}]}
        inside = case(agent=ball([3, 0, 0], 0.3), agent_velocity=[1, 0, 0], obstacles=[dented], horizon=5)
        answer = ask("bands", inside)[1][0]
        self.assertEqual(len(answer["heading"]["free"]), 1)
        start, to = answer["heading"]["free"][0]
        self.assertTrue(start < 30 and to > 150)
        self.assertIsNone(answer["time_to_violation"])
        self.assertEqual(ask("avoid", inside)[1][0]["distance"], 0)

    def test_the_nearest_safe_velocity(self):
        answer = ask("avoid", case(wanted=[0, 4, 0], limits={"speed": [0, 20]}))[1][0]
        self.assertEqual(answer["status"], "free")
        right = min(4 * 0.2, 4 - 8 / 60)  # out at the side of the cone, or slower
        self.assertGreaterEqual(answer["distance"], right * (1 - 1e-12))
        self.assertLessEqual(answer["distance"], right * 1.0101)
        self.assertLessEqual(answer["lower"], right * (1 + 1e-12))
        wider = ask("avoid", case(margin=1, limits={"speed": [0, 20]}))[1][0]
        self.assertGreaterEqual(wider["distance"], 4 * 0.3 * (1 - 1e-12))
        held = ask("avoid", case(wanted=[0, 0, 0]))[1][0]
        self.assertEqual((held["distance"], held["velocity"]), (0, [0, 0, 0]))

    def test_a_map_of_velocities(self):
        # In the plane through a ball, of what arrives in time: |v| within asin(0.2) of it, faster than 8 / 60.
        given = {"low": [-2, 1, 0], "high": [2, 5, 0], "resolution": 0.05, "time": 0.5}
        found = ask("avoid", case(map=given))[1][0]["map"]
        tangent = math.tan(math.asin(0.2))
        area = tangent * (5 ** 2 - 1 ** 2) / 4 ** 2  # a trapezium, of the square
        self.assertLessEqual(found["colliding"], area)
        self.assertGreaterEqual(found["colliding"] + found["undecided"], area)
        self.assertLess(found["undecided"], 0.05)
        self.assertEqual((found["safe_regions"], found["complete"]), (2, True))
        for cell in found["cells"]:
            x, y = (0.5 * (cell["low"][i] + cell["high"][i]) for i in (0, 1))
            if cell["label"] != "undecided":
                self.assertEqual(cell["label"] == "colliding", abs(x) < tangent * y)
            if cell["label"] == "colliding":
                speed = math.hypot(x, y)
                first = (10 * y / speed - math.sqrt(4 - (10 * x / speed) ** 2)) / speed
                self.assertTrue(cell["first"] and cell["obstacle"] == 0)
                self.assertLessEqual(cell["time"][0], first + 1e-9)
                self.assertGreaterEqual(cell["time"][1], first - 1e-9)
        for wrong, field in (({"low": [0, 0, 0]}, "map.high"), ({**given, "resolution": -1}, "map.resolution"),
                             ({**given, "high": [-3, 5, 0]}, "map.high[0]"), ({**given, "until": 1}, "map.until")):
            self.assertIn(field + ": got", ask("avoid", case(map=wrong))[1][0]["error"])

    def test_examples(self):
        answers = [json.loads(line) for line in run("avoid", SOURCE + "/docs/examples/avoid.jsonl").stdout.splitlines()]
        one, window, walls = answers
        self.assertEqual((one["status"], window["status"], walls["status"]), ("free", "free", "nothing_safe"))
        self.assertEqual(window["distance"], 0)
        self.assertIsNone(walls["lower"])
        # The walls are 2 m off on either side and 2 m/s fast: who stands still has a second; they are thinner farther out.
        self.assertGreaterEqual(walls["latest"], 1 - 1e-9)
        self.assertLessEqual(walls["latest"], 1.2)
        self.assertLessEqual(walls["latest"], 1.2 * walls["safe_until"])
        self.assertLessEqual(walls["safe_until"], walls["first"]["time"] + 1e-9)
        self.assertEqual((one["safe_until"], one["latest"]), (20, None))

    def test_what_is_refused(self):
        for command, fields, field in (
                ("bands", {"obstacles": 3}, "obstacles"), ("bands", {"obstacles": [ball([9, 0, 0], 1)]}, "obstacles[0].velocity"),
                ("bands", {"agent_velocity": [0, 4]}, "agent_velocity"), ("bands", {"limits": {"speed": [2, 1]}}, "limits.speed"),
                ("bands", {"limits": {"latteral": 1}}, "limits.latteral"), ("bands", {"horizon": [2, 1]}, "horizon"),
                ("bands", {"wanted": [0, 0, 0]}, "wanted"), ("avoid", {"horizon": [1, 2]}, "horizon"),
                ("bands", {"margin": -1}, "margin"), ("bands", {"levels": [1, 2]}, "levels[1]"), ("bands", {"levels": 3}, "levels"),
                ("bands", {"levels": [1], "margin": 1}, "margin"), ("avoid", {"margin": -1}, "margin"), ("avoid", {"limits": {"altitude": [0, 1]}}, "limits.altitude"),
                ("avoid", {"limits": {"lateral": 1}}, "limits.longitudinal"), ("avoid", {"wanted": [0, 1]}, "wanted")):
            result, answers = ask(command, case(**fields), case())
            self.assertEqual(result.returncode, 2, fields)
            self.assertTrue(answers[0]["error"].startswith(field + ":"), answers[0]["error"])
            self.assertNotIn("error", answers[1])


if __name__ == "__main__":
    unittest.main()
