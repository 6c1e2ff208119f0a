# SPDX-License-Identifier: BSD-3-Clause
"""`vericone cone`, `query` and `check` of polygons and stadiums in the plane, and of half-spaces: against angles and
times by elementary geometry. Environment as for command.py."""
import json
import math
import os
import sys
import tempfile
import unittest

sys.path[:0] = [os.path.dirname(os.path.dirname(os.path.abspath(__file__)))]
from command import SOURCE, query, run  # noqa: E402

SQUARE = "{polygon: [[-1, -1], [1, -1], [1, 1], [-1, 1]]}"


class Flat(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, text, name="scene.yaml"):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as f:
            f.write(text)
        return path

    def cone(self, text, *options):
        result = run("cone", self.write(text), "--json", *options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_the_sector_is_that_of_the_tangents(self):
        # A disc of radius 1 at (-10, 0) and a square of side 2: K is the square swollen by 1; its tangents from the
        # disc's centre touch the arc about the corner (-1, 1).
        cone = self.cone("agent: {stadium: {radius: 1, length: 0}, center: [-10, 0]}\nobstacle: " + SQUARE +
                         "\nagent_velocity: [1, 0]")
        half = math.atan2(1, 9) + math.asin(1 / math.hypot(9, 1))
        self.assertEqual((cone["method"], cone["relation"]), ("planar", "disjoint"))
        self.assertAlmostEqual(cone["psi"], 2 * half, 7)
        self.assertAlmostEqual(cone["theta_b"], 0, 7)
        self.assertAlmostEqual(math.atan2(*cone["left"]["direction"][::-1]), half, 7)
        self.assertAlmostEqual(cone["left"]["point_on_obstacle"][1], 1, 5)
        self.assertEqual(cone["answer"]["verdict"], "in")
        self.assertAlmostEqual(cone["answer"]["time_to_contact"], 8, 6)
        self.assertEqual(cone["answer"]["contact_point"][2], 0)
        self.assertLess(cone["y"], 0)

    def test_a_notch_is_part_of_the_sector_and_not_of_the_body(self):
        # A small disc heads into the notch of a U, and out through its open side.
        u = "{polygon: [[0, 0], [9, 0], [9, 9], [6, 9], [6, 3], [3, 3], [3, 9], [0, 9]]}"
        agent = "agent: {stadium: {radius: 0.5, length: 0}, center: [4.5, 5]}\n"
        self.assertEqual(self.cone(agent + "obstacle: " + u + "\nagent_velocity: [0, 1]")["answer"]["verdict"], "out")
        down = self.cone(agent + "obstacle: " + u + "\nagent_velocity: [0, -2]")
        self.assertEqual(down["answer"]["verdict"], "in")
        self.assertAlmostEqual(down["answer"]["time_to_contact"], 0.75, 6)
        self.assertGreater(down["psi"], math.pi)
        self.assertTrue(down["hulls_overlap"])
        self.assertIsNone(down["y"])

    def test_the_example_heads_through_the_door_and_is_drawn(self):
        example = os.path.join(SOURCE, "docs", "examples", "rooms.yaml")
        text = run("check", example)
        self.assertEqual(text.returncode, 0, text.stderr)
        self.assertIn("polygon of 4 corners with a hole", text.stdout)
        result = run("cone", example, "--json", "--no-figures", "--out", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(os.path.join(self.folder, "engagement.json"), encoding="utf-8") as f:
            drawn = json.load(f)
        areas = [sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(arc["points"], arc["points"][1:] + arc["points"][:1])) / 2
                 for arc in drawn["obstacle"]["arcs"]]
        self.assertTrue(all(area > 0 for area in areas))
        self.assertAlmostEqual(sum(areas), 12 * 8 - (11.4 * 7.4 - 0.4 * (2.7 + 2.7)), 9)

    def test_bodies_that_overlap_have_no_picture_and_a_depth(self):
        text = "agent: {stadium: {radius: 1, length: 2}, center: [1.5, 0]}\nobstacle: " + SQUARE
        refused = run("cone", self.write(text), "--no-figures", "--out", os.path.join(self.folder, "out"))
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--out", refused.stderr)
        cone = self.cone(text)
        self.assertEqual((cone["relation"], cone["left"], cone["theta_b"]), ("overlapping", None, None))
        low, high = cone["answer"]["penetration"]["depth"]  # to x = 3 is 1.5, to y = 2 is 2
        self.assertLessEqual(low, 1.5)
        self.assertGreaterEqual(high, 1.5)
        self.assertLess(high - low, 1e-9)

    def test_files_of_the_plane(self):
        self.write("{polygon: [[0, 0], [4, 0], [4, 4], [3, 4], [3, 1], [0, 1]], margin: 0.1}\n", "corner.yaml")
        path = self.write("agent: {center: [9, 0], semi_axes: [1, 1]}\nobstacle: {file: corner.yaml}\nagent_velocity: [-1, 0]")
        self.assertIn("verdict             in", run("cone", path).stdout)
        self.assertIn("polygon of 6 corners with a margin of 0.1 m",
                      run("check", os.path.join(self.folder, "corner.yaml")).stdout)
        glb = os.path.join(self.folder, "scene.glb")
        self.assertEqual(run("cone", path, "--glb", glb).returncode, 0)
        self.assertGreater(os.path.getsize(glb), 1000)

    def test_half_spaces_are_met_when_the_lowest_point_is(self):
        cylinder = {"cylinder": {"radius": 3, "height": 4}, "center": [1, 2, 9]}
        ground = {"half_space": {"normal": [0, 0, 1], "offset": 1}}
        case = {"agent": cylinder, "obstacle": ground, "agent_velocity": [50, 0, -2], "obstacle_velocity": [0, 0, 0]}
        slanted = {**case, "obstacle": {"half_space": {"normal": [0.6, 0, 0.8], "offset": 0}}}
        level = {**case, "agent_velocity": [50, 0, 0]}
        deep = {**case, "agent": {**cylinder, "center": [1, 2, 2.5]}}
        late = {**case, "horizon": 3}
        just = {**case, "horizon": 3.0000001}
        flat = {"agent": {"stadium": {"radius": 1, "length": 2}, "center": [0, 5]},
                "obstacle": {"slab": {"normal": [0, 1], "offsets": [-1, 2]}},
                "agent_velocity": [0, -1], "obstacle_velocity": [0, 1]}
        low = {"agent": {"stadium": {"radius": 1, "length": 2}, "center": [0, 3]},
               "obstacle": {"half_space": {"normal": [0, 1], "offset": -5}},
               "agent_velocity": [0, -1], "obstacle_velocity": [0, 0]}
        result, answers = query(case, slanted, level, deep, late, just, flat, low)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([a["verdict"] for a in answers],
                         ["in", "out", "out", "overlapping", "on", "in", "in", "in"])
        self.assertAlmostEqual(answers[0]["time_to_contact"], 3, 12)
        self.assertEqual(answers[0]["contact_normal"], [0, 0, -1])
        self.assertAlmostEqual(answers[0]["contact_point"][2], 1, 12)
        # 0.6 * 1 + 0.8 * 9 less 0.6 * 3 and 0.8 * 2.
        self.assertAlmostEqual(answers[1]["clearance"], 0.6 + 7.2 - 1.8 - 1.6, 12)
        self.assertEqual(answers[2]["clearance"], 6)
        self.assertAlmostEqual(answers[3]["penetration"]["depth"][1], 0.5, 12)
        self.assertAlmostEqual(answers[6]["time_to_contact"], 1, 12)
        self.assertEqual((answers[7]["contact_point"][1:], answers[7]["contact_normal"]), ([-5, 0], [0, -1, 0]))

    def test_half_spaces_of_scenes_and_elsewhere(self):
        text = ("agent: {box: {half_widths: [1, 1, 1]}, center: [0, 0, 5], velocity: [0, 0, -1]}\n"
                "obstacle: {half_space: {normal: [0, 0, 1], offset: 0}}\n")
        answer = run("query", "--scene", self.write(text))
        self.assertEqual(json.loads(answer.stdout)["time_to_contact"], 4)
        cone = self.cone(text)
        self.assertEqual((cone["axis"], cone["half_angle"]), ([0, 0, -1], math.pi / 2))
        self.assertEqual(cone["solid_angle"], 2 * math.pi)
        self.assertEqual((cone["answer"]["verdict"], cone["answer"]["time_to_contact"]), ("in", 4))
        text_of = run("cone", self.write(text)).stdout
        self.assertIn("half-angle 90 degrees", text_of)
        for option in ("--map", "--certificate"):
            refused = run("cone", self.write(text), "--json", option)
            self.assertEqual(refused.returncode, 2)
            self.assertIn(option, refused.stderr)
            self.assertEqual(len(refused.stderr.splitlines()), 1)
        # In the plane, and its part, a body like others.
        plane = ("agent: {stadium: {radius: 1, length: 2}, center: [0, 5]}\nobstacle: {half_space: %s}\n"
                 "agent_velocity: [0, -1]\n")
        cone = self.cone(plane % "{normal: [0, 1], offset: 1}")
        self.assertEqual((cone["psi"], cone["theta_b"]), (math.pi, -math.pi / 2))
        part = self.cone(plane % "{normal: [0, 1], offset: 1, extent: 1e6}")
        self.assertAlmostEqual(math.pi - part["psi"], 2 * 3 / 1e6, 8)  # 3 m from its lowest point to the wall
        self.assertAlmostEqual(part["answer"]["time_to_contact"], 3, 9)
        self.assertEqual(cone["answer"]["time_to_contact"], 3)
        drawn = os.path.join(self.folder, "part")  # its outline goes around it
        run("cone", self.write(plane % "{normal: [3, 4], offset: 1, extent: 10}"), "--no-figures", "--out", drawn)
        with open(os.path.join(drawn, "engagement.json"), encoding="utf-8") as f:
            (arc,) = json.load(f)["obstacle"]["arcs"]
        area = sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(arc["points"], arc["points"][1:] + arc["points"][:1])) / 2
        self.assertAlmostEqual(area, 2 * 10 * 10, 9)
        both = self.cone("agent: {pieces: [{center: [0, 0, 5], semi_axes: [1, 1, 1]}, "
                         "{center: [0, 0, -5], semi_axes: [1, 1, 1]}]}\nobstacle: {slab: {normal: [0, 0, 1], "
                         "offsets: [-1, 1]}}\nagent_velocity: [1, 0, 0]\n")
        self.assertEqual((both["axis"], both["solid_angle"], both["answer"]["verdict"]), (None, 4 * math.pi, "out"))
        # Where no reader knows how far it is to go.
        for name, scene in (("agent.half_space.extent", "agent: {half_space: {normal: [0, 0, 1], offset: 0}}\n"
                             "obstacle: {box: {half_widths: [1, 1, 1]}}\n"),
                            ("obstacle.pieces[0].half_space.extent",
                             "agent: {box: {half_widths: [1, 1, 1]}}\n"
                             "obstacle: {pieces: [{half_space: {normal: [0, 0, 1], offset: 0}}]}\n")):
            refused = run("cone", self.write(scene))
            self.assertEqual(refused.returncode, 2)
            self.assertIn(name, refused.stderr)
            self.assertEqual(len(refused.stderr.splitlines()), 1)


if __name__ == "__main__":
    unittest.main()
