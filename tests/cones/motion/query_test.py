# SPDX-License-Identifier: BSD-3-Clause
"""`vericone query` of bodies that spin, accelerate or brake, in cases and in scenes."""
import json
import math
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.environ["VERICONE_SOURCE"], "tests", "cli"))
from command import ball, engagement, query, run

STRAIGHT = "this answer is of straight motion"


class Motion(unittest.TestCase):
    def asked(self, agent, obstacle, **other):
        result, answers = query({**engagement(agent, obstacle, [0, 0, 0]), **other})
        self.assertEqual(result.returncode, 0, answers)
        self.assertEqual(answers[0]["guarantee"], "certified")
        return answers[0]

    def meets(self, answer, time):
        self.assertEqual(answer["verdict"], "in")
        low, high = answer["time_enclosure"]
        self.assertLessEqual(low, time * (1 + 1e-14))
        self.assertGreaterEqual(high, time * (1 - 1e-14))
        self.assertLess(high - low, 1e-9 * time)
        self.assertAlmostEqual(answer["time_to_contact"], time, 8)

    def test_balls_that_fall_and_a_bar_that_turns(self):
        fallen = self.asked({**ball([0, 0, 10], 1), "acceleration": [0, 0, -9.81]}, ball([0, 0, 0], 1))
        self.meets(fallen, math.sqrt(2 * 8 / 9.81))
        self.assertAlmostEqual(fallen["contact_normal"][2], -1, 9)
        self.assertAlmostEqual(fallen["contact_point"][2], 1, 9)
        bar = {"capsule": {"radius": 0, "length": 4}, "rotation": [math.sqrt(0.5), 0, math.sqrt(0.5), 0],
               "spin": [0, 0, 0.5]}
        self.meets(self.asked(bar, ball([0, 1.5, 0], 0.25), horizon=20), math.acos(0.25 / 1.5) / 0.5)
        passed = self.asked(bar, ball([0, 3, 0], 0.25), horizon=20)
        self.assertEqual(passed["verdict"], "out")
        low, high = passed["clearance_enclosure"]
        self.assertTrue(0.74 < low <= 0.75 <= high + 1e-12)
        self.assertAlmostEqual(math.sin(0.5 * passed["nearest_time"]) ** 2, 1, 2)

    def test_in_the_plane(self):
        needle = {"center": [0, 0], "semi_axes": [2, 0.01], "spin": 1}
        wheel = {"center": [0, 1.5], "semi_axes": [0.25, 0.25]}
        result, answers = query({"id": 1, "agent": needle, "obstacle": wheel, "agent_velocity": [0, 0],
                                 "obstacle_velocity": [0, 0], "horizon": 3})
        self.assertEqual(result.returncode, 0, answers)
        self.assertEqual(answers[0]["verdict"], "in")
        # The needle is 2 cm thick: it touches a little before the line does.
        self.assertLess(answers[0]["time_to_contact"], math.acos(0.25 / 1.5))
        self.assertGreater(answers[0]["time_to_contact"], math.acos(0.25 / 1.5) - 0.02)

    def test_a_scene_in_which_a_body_brakes(self):
        scene = """
agent: {box: {half_widths: [2, 1, 1]}, center: [0, 0, 0], velocity: [30, 0, 0], braking: 5}
obstacle: {box: {half_widths: [1, 5, 5]}, center: [%s, 0, 0]}
"""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.yaml")
            for gap, verdict in ((90.5, "out"), (80, "in")):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(scene % (gap + 3))
                result = run("query", "--scene", path)
                self.assertEqual(result.returncode, 0, result.stderr)
                answer = json.loads(result.stdout)
                self.assertEqual(answer["verdict"], verdict)
            self.meets(answer, 4)
            for command in (("cone", path), ("check", path)):
                refused = run(*command)
                self.assertNotEqual(refused.returncode, 0)
                self.assertIn("agent.braking: got 5", refused.stderr)
                self.assertIn(STRAIGHT, refused.stderr)
                self.assertEqual(refused.stderr.count("\n"), 1, refused.stderr)

    def test_an_ellipsoid_with_a_margin_turns_about_its_center(self):
        """Sphere swollen or not: as far from a ball as the two stand, however it spins."""
        for margin in (0, 0.2):
            turning = {"semi_axes": [0.5, 0.5, 0.4], "center": [5, 0, 0], "spin": [0, 0, 1], **({"margin": margin} if margin else {})}
            answer = self.asked(ball([0, 5, 0], 0.2), turning, horizon=2)
            self.assertEqual(answer["verdict"], "out")
            self.assertAlmostEqual(answer["clearance"], math.sqrt(50) - 0.7 - margin, delta=0.1)
        # A bar of half length 2.2 sweeps a ball 2 m beside its center a quarter of a turn later, less the ball's width.
        bar = {"semi_axes": [2, 0.1, 0.1], "margin": 0.2, "center": [5, 0, 0], "spin": [0, 0, 1]}
        answer = self.asked(ball([5, 2, 0], 0.2), bar, horizon=2)
        self.assertEqual(answer["verdict"], "in")
        self.assertTrue(1.2 < answer["time_to_contact"] < math.pi / 2)

    def test_a_scene_of_straight_motion_is_answered_as_its_case(self):
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        case = engagement(a, b, [4, 3, 0])
        answer = query(case)[1][0]
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.yaml")
            with open(path, "w", encoding="utf-8") as file:
                json.dump({k: v for k, v in case.items() if k != "id"}, file)
            found = json.loads(run("query", "--scene", path).stdout)
        self.assertEqual(found, {k: v for k, v in answer.items() if k != "id"})

    def test_what_is_of_straight_motion_alone(self):
        turning = {**ball([0, 0, 0], 1), "spin": [0, 0, 1]}
        result = run("query", "--certificate", "-", input=json.dumps(
            engagement(turning, ball([5, 0, 0], 1), [1, 0, 0])) + "\n")
        answer = json.loads(result.stdout)
        self.assertIsNone(answer["certificate"])
        self.assertIn("straight", answer["no_certificate"])
        case = json.dumps(engagement(turning, ball([5, 0, 0], 1), [1, 0, 0])) + "\n"
        refused = run("cone", "--cases", "-", input=case)
        self.assertIn("agent.spin", refused.stdout)
        self.assertIn(STRAIGHT, refused.stdout)

    def test_a_graze_says_when(self):
        _, answers = query({"id": 1, "agent": {**ball([0, 0, 0], 1), "acceleration": [0, -1, 0]},
                                 "obstacle": ball([2, 4, 0], 1), "agent_velocity": [1, 2, 0],
                                 "obstacle_velocity": [0, 0, 0]})
        self.assertEqual(answers[0]["verdict"], "undecided")
        low, high = answers[0]["undecided_between"]
        self.assertTrue(low < 2 < high)


if __name__ == "__main__":
    unittest.main()
