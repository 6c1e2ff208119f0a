# SPDX-License-Identifier: BSD-3-Clause
"""`vericone cone` of two ellipsoids."""
import json
import math
import os
import re
import tempfile
import unittest

from command import SOURCE, ball, run


class Cone(unittest.TestCase):
    def cone(self, scene, *arguments):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.yaml")
            with open(path, "w", encoding="utf-8") as f:
                f.write(scene)
            result = run("cone", path, "--json", *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            return json.loads(result.stdout)

    SPHERES = "agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\nobstacle: {center: [5, 0, 0], semi_axes: [2, 2, 2]}\n"

    def test_many_scenes_one_a_line(self):
        """Answers are those of single scenes, in order, with their ids; a bad line says so and the others are answered."""
        scenes = [{"id": i, "agent": {"center": [0, 0, 0], "semi_axes": [1, 1, 1]},
                   "obstacle": {"center": [d, 0, 0], "semi_axes": axes}}
                  for i, (d, axes) in enumerate([(5, [2, 2, 2]), (9, [1, 2, 3]), (5, [2, -2, 2]), (30, [4, 4, 1])])]
        lines = "".join(json.dumps(s) + "\n" for s in scenes)
        result = run("cone", "-", "--cases", input=lines)
        self.assertEqual(result.returncode, 2)
        answers = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([a["id"] for a in answers], [0, 1, 2, 3])
        self.assertIn("obstacle.semi_axes[1]", answers[2]["error"])
        for scene, answer in zip(scenes, answers):
            if "error" in answer:
                continue
            text = json.dumps({k: v for k, v in scene.items() if k != "id"})
            alone = self.cone(text)
            for data in (alone, answer):
                data.pop("seconds", None)
                data.pop("id", None)
            self.assertEqual(answer, alone)
        refused = run("cone", "-", "--cases", "--out", "nowhere", input=lines)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--out", refused.stderr)

    def test_the_picture_shows_the_velocity_of_the_scene(self):
        with open(os.path.join(SOURCE, "docs", "examples", "source-6.5.yaml"), encoding="utf-8") as f:
            text = f.read()
        with tempfile.TemporaryDirectory() as folder:
            for velocity, verdict in (("[3.0461275, 0, 7.9354336]", "in"), ("[9, 0, 4]", "out")):
                scene = os.path.join(folder, "scene.yaml")
                with open(scene, "w", encoding="utf-8") as f:
                    f.write(re.sub(r"agent_velocity: \[.*?\]", "agent_velocity: " + velocity, text))
                self.assertEqual(run("cone", scene, "--json", "--no-figures", "--out", folder).returncode, 0)
                with open(os.path.join(folder, "engagement.json"), encoding="utf-8") as f:
                    course = json.load(f)["course"]
                self.assertEqual(course["verdict"], verdict)
                self.assertEqual("contact_point" in course, verdict == "in")

    def test_text_says_the_verdict_first_and_what_is_certain(self):
        for scene, *arguments in (["source-6.5.yaml"], ["source-6.5.yaml", "--tolerance", "0.01"], ["biconcave.yaml"],
                                  ["source-6.5.yaml", "--method", "slice"], ["planar.yaml"], ["first.yaml"],
                                  ["window.yaml", "--map", "0.1"]):
            with self.subTest(scene=scene, arguments=arguments):
                path = os.path.join(SOURCE, "docs", "examples", scene)
                text = run("cone", path, *arguments).stdout
                self.assertTrue(text.startswith("verdict "), text)
                for number in re.findall(r"(?<![\w.])-?\d+\.\d+", text):
                    self.assertLessEqual(len(number.replace(".", "").lstrip("-0")), 6, number)
                between = re.search(r"sr, proved between (\S+) and (\S+) sr", text)
                answer = json.loads(run("cone", path, "--json", *arguments).stdout)
                self.assertEqual(bool(between), bool(answer.get("error_bound")))
                if between:
                    self.assertLessEqual(float(between[1]), answer["inner"]["solid_angle"])
                    self.assertGreaterEqual(float(between[2]), answer["outer"]["solid_angle"])

    def test_bodies_too_far_apart_for_numbers(self):
        for zeros, far in (("0, 0, 0", "1.0e200, 0, 0"), ("0, 0", "1.0e200, 0")):
            axes = ", ".join(["1"] * len(zeros.split(",")))
            scene = f"agent: {{center: [{zeros}], semi_axes: [{axes}]}}\nobstacle: {{center: [{far}], semi_axes: [{axes}]}}\n"
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "scene.yaml")
                with open(path, "w", encoding="utf-8") as f:
                    f.write(scene)
                result = run("cone", path)
                self.assertEqual(result.returncode, 2)
                self.assertIn("obstacle.center: got 1e+200 m from the agent's, must be at most 1e154 m", result.stderr)
        near = self.cone(self.SPHERES.replace("[5, 0, 0]", "[1.0e150, 0, 0]"))
        self.assertAlmostEqual(near["solid_angle"] * 1e300 / (9 * math.pi), 1, delta=1e-9)

    def test_spheres_in_closed_form(self):
        half = math.asin(3 / 5)
        for method in ("exact", "slice"):
            c = self.cone(self.SPHERES, "--method", method, "--planes", "3600", "--samples", "48")
            digits = 12 if method == "exact" else 5
            self.assertAlmostEqual(c["solid_angle"], 2 * math.pi * (1 - math.cos(half)), digits)
            self.assertAlmostEqual(c["cross_section_area"], math.pi * math.tan(half) ** 2, digits)
            for d in c["directions"]:
                self.assertAlmostEqual(d[0], math.cos(half), 12)
        c = self.cone(self.SPHERES, "--samples", "48")
        truth = 2 * math.pi * (1 - math.cos(half))
        self.assertLess(c["inner"]["solid_angle"], truth)
        self.assertGreater(c["outer"]["solid_angle"], truth)
        self.assertLess(abs(c["solid_angle"] - truth), c["error_bound"])
        self.assertEqual(len(c["directions"]), 48)
        self.assertGreater(c["seconds"], 0)

    def test_the_source_6_5(self):
        # Errata, 4.2: on the plane of largest psi, 77.8 degrees, y = -0.3277; on all planes -0.183 .. -0.328.
        with open(os.path.join(SOURCE, "docs", "examples", "source-6.5.yaml"), encoding="utf-8") as f:
            c = self.cone(f.read(), "--method", "slice", "--planes", "720")
        widest = max(c["sectors"], key=lambda s: s["psi"])
        self.assertAlmostEqual(math.degrees(widest["psi"]), 77.8, delta=0.05)
        self.assertAlmostEqual(widest["y"], -0.3277, delta=5e-5)
        self.assertAlmostEqual(max(s["y"] for s in c["sectors"]), -0.183, delta=5e-4)
        self.assertTrue(all(s["v_r_hat"] < 0 for s in c["sectors"]))

    def test_slice_says_nothing_about_its_error(self):
        c = self.cone(self.SPHERES, "--method", "slice", "--planes", "12")
        self.assertEqual(len(c["directions"]), 24)
        self.assertIsNone(c["error_bound"])
        self.assertIsNone(c["outer"])

    def test_wide_cone_has_no_section(self):
        # Two parallel needles side by side: the plane across the line of centres does not separate them.
        turn = "rotation: [0.9238795325112867, 0, 0, 0.3826834323650898]"
        c = self.cone("agent: {center: [0, 0, 0], semi_axes: [10, 0.1, 0.1], %s}\n"
                      "obstacle: {center: [0.3, 0, 0], semi_axes: [10, 0.1, 0.1], %s}\n" % (turn, turn),
                      "--samples", "400")
        self.assertEqual(c["relation"], "disjoint")
        self.assertIsNone(c["cross_section_area"])
        self.assertLess(c["outer"]["solid_angle"], 2 * math.pi)
        self.assertLessEqual(c["inner"]["solid_angle"], c["solid_angle"])
        self.assertLessEqual(c["solid_angle"], c["outer"]["solid_angle"])
        self.assertLess(c["error_bound"], 0.01 * c["solid_angle"])

    def test_overlapping_and_touching_are_answers(self):
        touching = self.cone(self.SPHERES.replace("5, 0, 0", "3, 0, 0"))
        self.assertEqual((touching["relation"], touching["solid_angle"]), ("touching", 2 * math.pi))
        overlapping = self.cone(self.SPHERES.replace("5, 0, 0", "2, 0, 0"))
        self.assertEqual((overlapping["relation"], overlapping["solid_angle"]), ("overlapping", 4 * math.pi))
        self.assertEqual(overlapping["answer"]["verdict"], "overlapping")

    def test_no_picture_of_a_cone_that_cannot_be_drawn(self):
        mesh = "agent: {center: [0.2, 0.2, 0.2], semi_axes: [1, 1, 1]}\nobstacle: {points: %s}\n" % (
            [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
        # A ball beside a waist, within the rims: the cone reaches more than 90 degrees from the line of centres.
        mouth = ("agent: {center: [2.2, 0, 0], semi_axes: [0.5, 0.5, 0.5]}\n"
                 "obstacle: {center: [0, 0, 0], semi_axes: [7, 7, 9], hyperboloids: [{sheets: 1, semi_axes: [1.5, 1, 1], "
                 "rotation: [[0, 0, -1], [0, 1, 0], [1, 0, 0]]}]}\n")
        overlapping = self.SPHERES.replace("5, 0, 0", "2, 0, 0")
        for scene, verdict, why in ((overlapping, "overlapping", "not apart"), (mesh, "overlapping", "not apart"),
                                    (mouth, "out", "90 degrees")):
            with tempfile.TemporaryDirectory() as folder:
                result = run("cone", "-", "--out", os.path.join(folder, "out"), input=scene)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("verdict             " + verdict, result.stdout)
                self.assertIn("picture             none: ", result.stdout)
                self.assertIn(why, result.stdout)
                self.assertFalse(os.path.exists(os.path.join(folder, "out", "engagement.json")))

    def test_json_is_a_scene(self):
        c = self.cone(json.dumps({"agent": ball([0, 0, 0], 1), "obstacle": ball([5, 0, 0], 2)}))
        self.assertEqual(c["relation"], "disjoint")


if __name__ == "__main__":
    unittest.main()
