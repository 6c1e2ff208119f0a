# SPDX-License-Identifier: BSD-3-Clause
"""`vericone cone` and `query` of delimited and planar bodies."""
import json
import math
import os
import sys
import tempfile
import unittest

from command import SOURCE, ball, engagement, query, run


def turned(q, v):
    """v turned by the unit quaternion q."""
    w, x, y, z = q
    t = [2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])]
    return [v[0] + w * t[0] + y * t[2] - z * t[1], v[1] + w * t[1] + z * t[0] - x * t[2],
            v[2] + w * t[2] + x * t[1] - y * t[0]]


class Combined(unittest.TestCase):
    """Bodies delimited by hyperboloids, and planar ones."""
    DENT = {"sheets": 2, "semi_axes": [0.5, 1, 1]}
    WAIST = {"sheets": 1, "semi_axes": [1, 0.5, 0.5]}

    @staticmethod
    def body(center, axes, *hyperboloids, **other):
        return {"center": center, "semi_axes": axes, "hyperboloids": list(hyperboloids), **other}

    def scene(self, scene, *arguments, text=False):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.yaml")
            with open(path, "w", encoding="utf-8") as f:
                json.dump(scene, f)
            result = run("cone", path, *([] if text else ["--json"]), *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            return result.stdout if text else json.loads(result.stdout)

    def assert_time(self, answer, truth):
        low, high = answer["time_enclosure"]
        self.assertLessEqual(low, truth + 1e-12)
        self.assertGreaterEqual(high, truth - 1e-12)
        self.assertLess(high - low, 1e-3 * truth)
        self.assertAlmostEqual(answer["time_to_contact"], (low + high) / 2, 9)

    def test_a_ball_meets_the_bottom_of_a_dent(self):
        # Its radius, 1/4, is below the dent's radius of curvature there, c^2 / a = 2. Without the dent it meets
        # the ellipsoid's end, 3/2 m earlier.
        dented = self.body([8, 0, 0], [2, 3, 3], self.DENT)
        result, (hit, plain) = query(engagement(ball([0, 0, 0], 0.25), dented, [2, 0, 0]),
                                     engagement(ball([0, 0, 0], 0.25), self.body([8, 0, 0], [2, 3, 3]), [2, 0, 0]))
        self.assertEqual(result.returncode, 0)
        self.assertEqual(hit["verdict"], "in")
        self.assert_time(hit, (8 - 0.5 - 0.25) / 2)
        self.assertIsNone(hit["clearance"])
        self.assertNotIn("time_enclosure", plain)  # nothing delimits it: an ellipsoid
        self.assertAlmostEqual(plain["time_to_contact"], (8 - 2 - 0.25) / 2, 12)

    def test_a_ball_passes_the_waist(self):
        # The waist, radius 1/2 about the x axis, is passed at 1 m from it; the ellipsoid would be hit.
        waisted = self.body([8, 0, 0], [3, 2, 2], self.WAIST)
        up = [0.05, 1, 0]
        _, answers = query(
            engagement(ball([8, -20, 0.8], 0.25), waisted, [0, 1, 0], id="misses"),
            engagement(ball([8, -20, 0.7], 0.25), waisted, [0, 1, 0], id="hits"),
            engagement(ball([8, -20, 0.8], 0.25), self.body([8, 0, 0], [3, 2, 2]), [0, 1, 0], id="ellipsoid"),
            engagement(ball([8, -20, 0.8], 0.25), waisted, [0, 0, 0], id="rest"),
            engagement(ball([8, -20, 0.8], 0.25), waisted, [-x for x in up], id="away"),
            engagement(ball([8, 0, 0.6], 0.25), waisted, [0, 1, 0], id="overlapping"))
        self.assertEqual([a["verdict"] for a in answers], ["out", "in", "in", "out", "out", "overlapping"])
        self.assertEqual(answers[5]["time_to_contact"], 0)
        self.assertEqual([a["time_to_contact"] for a in (answers[0], answers[3], answers[4])], [None] * 3)
        # Nearest as it passes the waist's middle; at rest, and on the way away, now.
        self.assertAlmostEqual(answers[0]["nearest_time"], 20, 2)
        self.assertEqual([a["nearest_time"] for a in answers[1:]], [None, None, 0, 0, None])

    def test_hyperboloids_turn_with_the_body(self):
        q, h = [0.5, 0.5, 0.5, 0.5], [0.8, 0.36, 0, 0.48]
        cut = {"sheets": 2, "semi_axes": [0.4, 0.7, 1.1], "rotation": h}
        agent = {"semi_axes": [0.3, 0.3, 0.3], "center": [-9, 0.2, 0.1]}
        v = [1, 0.01, 0.02]
        _, (plain, whole) = query(
            engagement(agent, self.body([0, 0, 0], [2, 1.5, 2.5], cut), v),
            engagement({**agent, "center": turned(q, agent["center"])},
                       self.body([0, 0, 0], [2, 1.5, 2.5], cut, rotation=q), turned(q, v)))
        self.assertEqual(plain["verdict"], "in")
        self.assertEqual(whole["verdict"], "in")
        self.assertAlmostEqual(plain["time_to_contact"], whole["time_to_contact"], delta=1e-4)

    def test_rung(self):
        case = engagement(ball([0, 0, 0], 0.25), self.body([8, 0, 0], [2, 3, 3], self.DENT), [2, 0, 0])
        answer = json.loads(run("query", "--rung", "-", input=json.dumps(case) + "\n").stdout)
        self.assertEqual(list(answer), ["id", "verdict", "rung", "clearance", "nearest_time", "time_to_contact",
                                        "time_enclosure"])
        self.assertEqual(answer["rung"], "certified")

    def test_cone_from_within_the_mouth(self):
        # All edges pass by the rim, a circle: x^2/9 + r^2/16 = 1 and 4 x^2 - r^2 = 1.
        scene = {"agent": ball([-1.2, 0, 0], 0.25), "obstacle": self.body([0, 0, 0], [3, 4, 4], self.DENT)}
        x2 = 17 / (4 + 16 / 9)
        x, r = -math.sqrt(x2) + 1.2, math.sqrt(4 * x2 - 1)
        half = math.atan2(r, x) + math.asin(0.25 / math.hypot(r, x))
        truth = 2 * math.pi * (1 - math.cos(half))
        c = self.scene(scene, "--tolerance", "0.05")
        self.assertEqual((c["method"], c["relation"]), ("certified", "disjoint"))
        self.assertLess(c["inner"]["solid_angle"], truth)
        self.assertGreater(c["outer"]["solid_angle"], truth)
        self.assertLessEqual(abs(c["solid_angle"] - truth), c["error_bound"])
        self.assertIsNone(c["cross_section_area"])
        s = self.scene(scene, "--method", "slice", "--planes", "360")
        self.assertAlmostEqual(s["solid_angle"], truth, 3)
        self.assertEqual(s["planes_with_overlapping_hulls"], 360)
        self.assertEqual({p["y"] for p in s["sectors"]}, {None})  # psi is more than half a turn
        for p in s["sectors"]:
            self.assertAlmostEqual(p["psi"], 2 * half, 10)

    def test_the_sources_choice_of_tangents(self):
        scene = {"agent": {"center": [0, 0, 0], "semi_axes": [1, 0.6, 0.5]},
                 "obstacle": self.body([8, 1, 0], [2, 3, 3], {"sheets": 2, "semi_axes": [0.7, 1.2, 1.2]})}
        truth = self.scene(scene, "--method", "slice", "--planes", "12")
        self.assertNotIn("planes_without_tangents", truth)
        source = self.scene(scene, "--method", "slice", "--planes", "12", "--tangents", "by-sides")
        self.assertLessEqual(source["planes_without_tangents"] + source["planes_with_wrong_tangents"], 12)
        wrong = sum(abs(p["psi"] - q["psi"]) > 1e-9 for p, q in zip(truth["sectors"], source["sectors"]))
        self.assertEqual(wrong, source["planes_with_wrong_tangents"])
        self.assertIn("source's tangents   none on ",
                      self.scene(scene, "--method", "slice", "--tangents", "printed", text=True))

    def test_tolerance_of_ellipsoids_is_that_of_the_certified_cone(self):
        scene = {"agent": ball([0, 0, 0], 1), "obstacle": ball([5, 0, 0], 2)}
        truth = 2 * math.pi * (1 - math.cos(math.asin(3 / 5)))
        for tolerance in (0.1, 0.01):
            c = self.scene(scene, "--tolerance", str(tolerance))
            self.assertEqual(c["method"], "certified")
            self.assertLessEqual(2 * c["error_bound"], tolerance * c["outer"]["solid_angle"] * (1 + 1e-9))
            self.assertLess(c["inner"]["solid_angle"], truth)
            self.assertGreater(c["outer"]["solid_angle"], truth)

    def test_text(self):
        scene = {"agent": ball([0, 0, 0], 0.25), "obstacle": self.body([8, 0, 0], [2, 3, 3], self.DENT),
                 "agent_velocity": [1, 0, 0]}
        text = self.scene(scene, text=True)
        self.assertIn("certified, tolerance 0.01", text)
        self.assertIn("verdict             in (of the scene's velocities, certified)", text)
        overlapping = {**scene, "agent": ball([7, 0, 0], 0.75)}
        self.assertIn("bodies              overlapping", self.scene(overlapping, text=True))

    def test_planar_verdicts_follow_the_edges(self):
        # The sector is found in the plane, the verdict in space (see docs/reference/formats.md): independent.
        obstacles = [{"a_c": 3, "b_c": 1.5, "k": k, "phi": 0.4} for k in (0, 0.3, 0.9, 1)]
        obstacles.append({"semi_axes": [2, 3], "rotation": 0.3, "hyperbolas": [
            {"semi_axes": [0.8, 1]}, {"semi_axes": [1.1, 0.7], "rotation": 1.2}]})
        agent = {"center": [0, 0], "semi_axes": [1, 0.4], "rotation": -0.5}
        cases, truths = [], []
        for obstacle in obstacles:
            for x, y in ((6, 1), (3.2, -3), (-12, 4)):
                scene = {"agent": agent, "obstacle": {"center": [x, y], **obstacle}}
                c = self.scene(scene)
                self.assertEqual(c["relation"], "disjoint")
                for side in (1, -1):
                    for inwards, verdict in ((1e-5, "in"), (-1e-5, "out")):
                        t = c["theta_b"] + side * (c["psi"] / 2 - inwards)
                        cases.append({**scene, "agent_velocity": [math.cos(t), math.sin(t)], "obstacle_velocity": [0, 0]})
                        truths.append(verdict)
        answers = [a["verdict"] for a in query(*cases)[1]]
        for answer, truth, case in zip(answers, truths, cases):
            self.assertIn(answer, (truth, "undecided"), case)
        self.assertLess(answers.count("undecided"), 6)

    def test_examples(self):
        folder = os.path.join(SOURCE, "docs", "examples")
        for name in sorted(n for n in os.listdir(folder) if n.endswith(".yaml")):
            result = run("cone", os.path.join(folder, name))
            if "no such file" in result.stderr and name in ("map.yaml", "mesh.yaml", "scan.yaml"):
                print("%s left out: %s" % (name, result.stderr.strip()), file=sys.stderr)
                continue
            self.assertEqual(result.returncode, 0, result.stderr)
            verdict = "out" if name in ("mesh.yaml", "planar.yaml", "scan.yaml", "window.yaml") else "in"
            self.assertIn("verdict             %s (" % verdict, result.stdout, name)
        result = run("query", os.path.join(folder, "combined.jsonl"))
        self.assertEqual(result.returncode, 2)  # the last line is a mistake
        answers = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([a.get("verdict") for a in answers], ["in", "out", "out", None])
        self.assert_time(answers[0], (8 - 0.5 - 0.25) / 2)

    # Source, 5.4.2; y(0) and psi are those of errata, 4.
    PLANAR = {"agent": {"center": [0, 0], "semi_axes": [6, 2], "rotation": math.pi / 4},
              "obstacle": {"center": [45, 0], "a_c": 6, "b_c": 2, "k": 1, "phi": 2 * math.pi / 3},
              "agent_velocity": [25 * math.cos(math.pi / 4), 25 * math.sin(math.pi / 4)],
              "obstacle_velocity": [20 * math.cos(2 * math.pi / 3), 20 * math.sin(2 * math.pi / 3)]}

    def test_the_source_5_4_2(self):
        c = self.scene(self.PLANAR)
        self.assertEqual((c["method"], c["relation"]), ("planar", "disjoint"))
        self.assertAlmostEqual(c["y"], -0.05331, delta=1e-5)
        self.assertAlmostEqual(math.degrees(c["psi"]), 26.85, delta=0.005)
        self.assertLess(c["v_r_hat"], 0)
        self.assertEqual(c["left"]["touches_obstacle"], "corner 0 1")
        self.assertAlmostEqual(c["v_r_hat"], -27.67, delta=0.005)
        text = self.scene(self.PLANAR, text=True)
        self.assertIn("cone's angle        26.8", text)
        self.assertIn("left edge           from arc 0 of the agent to corner 0 1 of the obstacle", text)
        for letter in ("psi", "theta_b", "V_r_hat", "y  "):  # words, not letters
            self.assertNotIn("\n" + letter, text)
        _, (answer,) = query({**self.PLANAR, "id": "5.4.2"})
        self.assertEqual((answer["id"], answer["verdict"]), ("5.4.2", "in"))

    def test_planar_ellipses_are_exact(self):
        disc = lambda x, r: {"center": [x, 0], "semi_axes": [r, r]}  # noqa: E731
        _, answers = query(*(engagement(disc(0, 1), disc(x, 2), [4, y], [0, 0]) for x, y in
                             [(5, 3), (5, math.nextafter(3, 4)), (5, math.nextafter(3, 2)), (3, 3), (2, 3)]))
        self.assertEqual([a["verdict"] for a in answers], ["on", "out", "in", "touching", "overlapping"])
        self.assertAlmostEqual(answers[0]["time_to_contact"], 4 / 5, 12)
        _, (across,) = query(engagement(disc(0, 1), {"center": [5, 0], "shape": [[4, 0], [0, 4]]}, [0, 2],
                                       [0, 0]))
        self.assertAlmostEqual(across["clearance"], 2, 12)
        c = self.scene({"agent": disc(0, 1), "obstacle": disc(5, 2)})
        self.assertAlmostEqual(c["psi"], 2 * math.asin(3 / 5), 12)
        self.assertEqual(self.scene({"agent": disc(0, 1), "obstacle": disc(3, 2)})["psi"], math.pi)

    def test_a_disc_in_the_mouth_of_a_planar_body(self):
        # As in space, in the plane of the axis.
        obstacle = {"center": [0, 0], "semi_axes": [3, 4], "hyperbolas": [{"semi_axes": [0.5, 1]}]}
        scene = {"agent": {"center": [-1.2, 0], "semi_axes": [0.25, 0.25]}, "obstacle": obstacle,
                 "agent_velocity": [2, 0]}
        x2 = 17 / (4 + 16 / 9)
        x, r = -math.sqrt(x2) + 1.2, math.sqrt(4 * x2 - 1)
        c = self.scene(scene)
        self.assertAlmostEqual(c["psi"], 2 * (math.atan2(r, x) + math.asin(0.25 / math.hypot(r, x))), 10)
        self.assertIsNone(c["y"])
        self.assertTrue(c["hulls_overlap"])
        self.assertIn("cone's angle        206.481 degrees", self.scene(scene, text=True))
        _, (hit,) = query(engagement(scene["agent"], obstacle, [2, 0], [0, 0]))
        self.assert_time(hit, (1.2 - 0.5 - 0.25) / 2)
        out = query(engagement(scene["agent"], obstacle, [-2, 0], [0, 0]))[1][0]
        self.assertEqual(out["verdict"], "out")  # back out of the mouth


if __name__ == "__main__":
    unittest.main()
