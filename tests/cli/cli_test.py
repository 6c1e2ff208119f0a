# SPDX-License-Identifier: BSD-3-Clause
"""The vericone command as a user meets it: real processes, real files. Environment: VERICONE (the program),
VERICONE_SOURCE (the project)."""
import hashlib
import json
import math
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bad_input_cases  # noqa: E402

VERICONE = os.path.abspath(os.environ["VERICONE"])
SOURCE = os.environ["VERICONE_SOURCE"]


def run(*arguments, **options):
    return subprocess.run([VERICONE, *arguments], capture_output=True, text=True, check=False, **options)


def ball(center, radius):
    return {"center": center, "semi_axes": [radius] * 3}


def engagement(agent, obstacle, v_a, v_b=(0, 0, 0), id=1):
    return {"id": id, "agent": agent, "obstacle": obstacle, "agent_velocity": list(v_a), "obstacle_velocity": list(v_b)}


def query(*cases):
    result = run("query", "-", input="".join(json.dumps(c) + "\n" for c in cases))
    return result, [json.loads(line) for line in result.stdout.splitlines()]


class Query(unittest.TestCase):
    def test_spheres_in_closed_form(self):
        # Radii 1 and 2, centres 5 apart along x; a line at distance 3 grazes: direction (4, 3, 0) / 5.
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        result, answers = query(
            engagement(a, b, [1, 0, 0], id="head-on"), engagement(a, b, [4, 3, 0], id="graze"),
            engagement(a, b, [4, math.nextafter(3, 4), 0], id="just out"),
            engagement(a, b, [4, math.nextafter(3, 2), 0], id="just in"),
            engagement(a, b, [-1, 0, 0], id="behind"), engagement(a, b, [0, 0, 0], id="rest"),
            engagement(a, b, [0, 2, 0], id="across"),
            engagement(a, ball([3, 0, 0], 2), [1, 0, 0], id="touching"),
            engagement(a, ball([2, 0, 0], 2), [1, 0, 0], id="overlapping"))
        self.assertEqual(result.returncode, 0, result.stderr)
        by_id = {x["id"]: x for x in answers}
        self.assertEqual([x["verdict"] for x in answers],
                         ["in", "on", "out", "in", "out", "out", "out", "touching", "overlapping"])
        self.assertAlmostEqual(by_id["head-on"]["clearance"], -3, 12)
        self.assertAlmostEqual(by_id["head-on"]["time_to_contact"], 2, 12)
        self.assertEqual(by_id["graze"]["clearance"], 0)
        self.assertAlmostEqual(by_id["graze"]["time_to_contact"], 4 / 5, 12)
        self.assertGreater(by_id["just out"]["clearance"], 0)
        self.assertLess(by_id["just in"]["clearance"], 0)
        self.assertAlmostEqual(by_id["behind"]["clearance"], 2, 12)  # moving apart: the distance now
        self.assertIsNone(by_id["behind"]["time_to_contact"])
        self.assertAlmostEqual(by_id["across"]["clearance"], 2, 12)
        self.assertEqual(by_id["touching"]["time_to_contact"], 0)
        self.assertEqual(list(answers[0]), ["id", "verdict", "clearance", "time_to_contact"])

    def test_rung_says_what_decided(self):
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        far = ball([3e7, 1e7, 2e7], 2)
        cases = [engagement(a, b, [1, 0, 0], id="plain"), engagement(a, b, [4, 3, 0], id="graze"),
                 engagement(a, far, [3, 1, 2.00000001], id="distant"),
                 engagement(a, ball([3, 0, 0], 2), [1, 0, 0], id="touching"),
                 engagement(a, ball([2, 0, 0], 2), [1, 0, 0], id="overlapping")]
        text = "".join(json.dumps(c) + "\n" for c in cases)
        answers = [json.loads(line) for line in run("query", "--rung", "-", input=text).stdout.splitlines()]
        self.assertEqual([x["rung"] for x in answers], ["triage", "exact", "triage", "exact", "triage"])
        plain = [json.loads(line) for line in run("query", "-", input=text).stdout.splitlines()]
        for with_rung, without in zip(answers, plain):
            self.assertEqual({k: v for k, v in with_rung.items() if k != "rung"}, without)

    def test_velocities_are_subtracted_without_rounding(self):
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        tiny = 2.0 ** -60  # 3 + tiny rounds to 3
        _, answers = query(engagement(a, b, [4, 3, 0]), engagement(a, b, [4, 3, 0], [0, -tiny, 0]),
                           engagement(a, b, [4, 3, 0], [0, tiny, 0]))
        self.assertEqual([x["verdict"] for x in answers], ["on", "out", "in"])

    def test_numbers_at_the_ends_of_the_doubles(self):
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        disc = {"center": [5, 0, 0], "semi_axes": [1e20, 1e-3, 1]}
        result, answers = query(
            engagement(a, ball([1e200, 0, 0], 2), [4, 1, 0]), engagement(a, b, [1e200, 0, 0]),
            engagement(a, b, [5e-324, 0, 0]), engagement(a, disc, [4, 3, 0]),
            engagement(a, b, [1.7e308, 0, 0], [-1.7e308, 0, 0]))
        self.assertEqual(result.returncode, 0, result.stdout)
        far, fast, slow, thin, faster = answers
        self.assertAlmostEqual(far["clearance"] / 1e200, 1 / math.sqrt(17), 12)
        self.assertAlmostEqual(fast["time_to_contact"] * 1e200, 2, 12)
        self.assertEqual((slow["verdict"], slow["time_to_contact"]), ("in", None))
        self.assertEqual(thin["verdict"], "overlapping")
        self.assertIn(thin["clearance"], (None, -2))
        self.assertEqual(faster["verdict"], "in")
        self.assertAlmostEqual(faster["clearance"], -3, 12)
        self.assertAlmostEqual(faster["time_to_contact"] * 1.7e308, 1, 12)

    def test_shape_and_axes_agree(self):
        q = [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
        body = {"center": [9, 1, 0], "semi_axes": [1, 2, 3], "rotation": q}
        same = {"center": [9, 1, 0], "shape": [[4, 0, 0], [0, 1, 0], [0, 0, 9]]}
        _, answers = query(engagement(ball([0, 0, 0], 1), body, [1, 0.2, 0.1]),
                           engagement(ball([0, 0, 0], 1), same, [1, 0.2, 0.1]))
        self.assertEqual(answers[0]["verdict"], answers[1]["verdict"])
        self.assertAlmostEqual(answers[0]["clearance"], answers[1]["clearance"], 12)
        self.assertAlmostEqual(answers[0]["time_to_contact"], answers[1]["time_to_contact"], 12)

    def test_bad_lines_do_not_stop_the_run(self):
        good = json.dumps(engagement(ball([0, 0, 0], 1), ball([5, 0, 0], 2), [1, 0, 0]))
        result = run("query", "-", input=good + "\nnonsense\n\n" + good + "\n")
        answers = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual(result.returncode, 2)
        self.assertEqual([("error" in x) for x in answers], [False, True, False])

    def test_each_answer_comes_at_once(self):
        with subprocess.Popen([VERICONE, "query", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as p:
            for i in range(3):
                p.stdin.write(json.dumps(engagement(ball([0, 0, 0], 1), ball([5, 0, 0], 2), [1, 0, 0], id=i)) + "\n")
                p.stdin.flush()
                self.assertEqual(json.loads(p.stdout.readline())["id"], i)
            p.stdin.close()


class BadInput(unittest.TestCase):
    def test_every_bad_line_names_its_field(self):
        _, answers, result = bad_input_cases.run_queries(VERICONE)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr, "")
        self.assertEqual(len(answers), len(bad_input_cases.QUERIES))
        for (what, _), answer in zip(bad_input_cases.QUERIES, answers):
            with self.subTest(what):
                self.assertIn("error", answer)
                self.assertRegex(answer["error"], r"^\S.*: got .+, must be .+")
                self.assertNotIn("\n", answer["error"])
                if what not in ("a line that is a list", "a line that is a number", "a broken line", "not a number",
                                "a number out of range", "a field given twice", "a line nested too deeply"):
                    self.assertEqual(answer["id"], 7)

    def test_every_bad_command_says_why(self):
        for what, arguments, scene in bad_input_cases.COMMANDS:
            with self.subTest(what):
                _, result, left = bad_input_cases.run_command(VERICONE, arguments, scene)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stdout, "")
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertLessEqual(len(left), 1, "something half written: %s" % left)

    def test_the_table_is_the_truth(self):
        with open(os.path.join(SOURCE, "docs", "bad-input.md"), encoding="utf-8") as f:
            self.assertEqual(f.read(), bad_input_cases.table(VERICONE))
        self.assertGreaterEqual(len(bad_input_cases.QUERIES) + len(bad_input_cases.COMMANDS), 30)


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

    def test_json_is_a_scene(self):
        c = self.cone(json.dumps({"agent": ball([0, 0, 0], 1), "obstacle": ball([5, 0, 0], 2)}))
        self.assertEqual(c["relation"], "disjoint")


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
        self.assertEqual(list(answer), ["id", "verdict", "rung", "clearance", "time_to_contact", "time_enclosure"])
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
        # The sector is found in the plane, the verdict in space (see docs/formats.md): independent.
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
        self.assertIn("V_r_hat             -27.67", self.scene(self.PLANAR, text=True))
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
        self.assertIn("not defined", self.scene(scene, text=True))
        _, (hit,) = query(engagement(scene["agent"], obstacle, [2, 0], [0, 0]))
        self.assert_time(hit, (1.2 - 0.5 - 0.25) / 2)
        out = query(engagement(scene["agent"], obstacle, [-2, 0], [0, 0]))[1][0]
        self.assertEqual(out["verdict"], "out")  # back out of the mouth


class SignMap(unittest.TestCase):
    def test_table_and_provenance(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("signmap", "--cells", "41", "--no-figures", "--out", folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            tables = [n for n in os.listdir(folder) if n.endswith(".csv")]
            self.assertEqual(len(tables), 1)
            with open(os.path.join(folder, tables[0]), encoding="utf-8") as f:
                rows = [line.strip().split(",") for line in f if not line.startswith("#")]
            header, cells = rows[0], rows[1:]
            self.assertEqual(len(cells), 41 * 41)
            exact = {tuple(map(int, c[:2])): c[header.index("library")] for c in cells}
            self.assertEqual(exact[0, 0], "on")  # the velocity in the middle grazes, by construction
            self.assertGreater(sum(v == "in" for v in exact.values()), 300)
            self.assertGreater(sum(v == "out" for v in exact.values()), 300)
            self.assertIn("provenance.json", os.listdir(folder))

    def test_refuses_what_it_cannot_draw(self):
        result = run("signmap", "--cells", "0", "--no-figures")
        self.assertEqual(result.returncode, 2)
        self.assertIn("cells", result.stderr)


class Accuracy(unittest.TestCase):
    ARGUMENTS = ("accuracy", "--planes", "3,6,12,24,96", "--no-figures", "--quiet", "--seed", "5")

    def read(self, folder, name):
        with open(os.path.join(folder, name), encoding="utf-8") as f:
            return f.read()

    def test_threads_and_interruptions_do_not_change_the_table(self):
        with tempfile.TemporaryDirectory() as folder:
            whole, parts = os.path.join(folder, "whole"), os.path.join(folder, "parts")
            long = (*self.ARGUMENTS, "-N", "10000")  # seconds of work, stopped at its first and second written rows
            self.assertEqual(run(*long, "--threads", "1", "--out", whole).returncode, 0)
            partial = os.path.join(parts, "engagements.csv.partial")
            size = 0
            for _ in range(2):
                with subprocess.Popen([VERICONE, *long, "--threads", "2", "--out", parts],
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as p:
                    while p.poll() is None and (not os.path.exists(partial) or os.path.getsize(partial) <= size):
                        time.sleep(0.001)
                    p.send_signal(signal.SIGINT)
                    p.communicate()
                self.assertEqual(p.returncode, 130)
                size = os.path.getsize(partial)
            self.assertEqual(run(*long, "--threads", "2", "--out", parts).returncode, 0)
            self.assertEqual(self.read(whole, "engagements.csv"), self.read(parts, "engagements.csv"))
            self.assertEqual([n for n in os.listdir(parts) if n.endswith(".partial")], [])

    def test_unfinished_work_of_other_settings_is_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            partial = os.path.join(folder, "engagements.csv.partial")
            content = "# vericone accuracy, seed 9, 10 engagements, planes 3 12\nx\n"
            with open(partial, "w", encoding="utf-8") as f:
                f.write(content)
            result = run(*self.ARGUMENTS, "-N", "400", "--out", folder)
            self.assertEqual(result.returncode, 2)
            self.assertIn("--out", result.stderr)
            self.assertEqual(self.read(folder, "engagements.csv.partial"), content)

    def test_summary_and_provenance(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(run(*self.ARGUMENTS, "-N", "400", "--out", folder).returncode, 0)
            summary = json.loads(self.read(folder, "summary.json"))["random"]
            # The finest count is the reference, and has no error against itself.
            self.assertEqual([row["above_two_over_n"] for row in summary["slice"]], [0, 0, 0, 0, None])
            self.assertIsNone(summary["slice"][-1]["discretisation_error"])
            self.assertAlmostEqual(summary["slice_order"], -2, delta=0.3)
            self.assertEqual([row["bound_violations"] for row in summary["exact"]], [0] * len(summary["exact"]))
            self.assertGreater(summary["slice_bias"]["mean"], 0.08)  # errata: 8 to 12 % on average
            self.assertLess(summary["slice_bias"]["mean"], 0.15)
            origin = json.loads(self.read(folder, "provenance.json"))
            for key in ("command", "commit", "compiler", "flags", "processor", "seed"):
                self.assertTrue(str(origin[key]))
            self.assertRegex(origin["compiler"], r"^(GNU|Clang) [0-9]+\.")
            self.assertIn("-ffp-contract=off", origin["flags"].split())

    def table(self, folder):
        settings, header, *rows = self.read(folder, "engagements.csv").splitlines()
        return settings, [dict(zip(header.split(","), row.split(","))) for row in rows]

    def test_own_distribution(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("accuracy", "-N", "60", "--semi-axes", "0.2", "0.5", "--distance", "2", "20", "--planes", "8", "16",
                         "32", "--no-figures", "--quiet", "--out", folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stdout, r"\n +32 +- +- +6.2e-02 +- ")
            settings, rows = self.table(folder)
            self.assertIn("semi-axes 0.2 to 0.5, distance 2 to 20", settings)
            self.assertEqual(len(rows), 60)
            distances = [float(r["distance"]) for r in rows]
            self.assertTrue(all(2 <= x <= 20 for x in distances))
            self.assertTrue(min(distances) < 4 and max(distances) > 18, "not spread over the range")
            for r in rows:
                for body in ("agent", "obstacle"):
                    axes = [float(r[body + "_semi_axis_" + k]) for k in "abc"]
                    self.assertTrue(0.5 >= axes[0] >= axes[1] >= axes[2] >= 0.2, axes)
                    trace = sum(float(r[body + "_shape_" + k]) for k in ("xx", "yy", "zz"))
                    self.assertAlmostEqual(trace, sum(x * x for x in axes), 12)
                self.assertAlmostEqual(math.hypot(*(float(r["to_obstacle_" + k]) for k in "xyz")), float(r["distance"]), 12)

    def test_own_cases(self):
        with tempfile.TemporaryDirectory() as folder:
            cases = os.path.join(folder, "cases.jsonl")
            with open(cases, "w", encoding="utf-8") as f:
                f.write(json.dumps({"id": "balls", "agent": ball([1, 0, 0], 1), "obstacle": ball([6, 0, 0], 2)}) + "\n\n")
                f.write(json.dumps({"agent": ball([0, 0, 0], 1), "obstacle": ball([0, 0, 9], 1)}) + "\n")
            out = os.path.join(folder, "out")
            result = run("accuracy", "--cases", cases, "--planes", "3,36", "--no-figures", "--quiet", "--out", out)
            self.assertEqual(result.returncode, 0, result.stderr)
            settings, rows = self.table(out)
            self.assertEqual([r["engagement"] for r in rows], ["balls", "3"])
            self.assertEqual([r["distance"] for r in rows], ["5", "9"])
            # Two balls: the section of the cone is a disc, sin(psi) = 3/5.
            self.assertAlmostEqual(float(rows[0]["exact_area"]), math.pi * 9 / 16, 12)
            with open(cases, "rb") as f:
                digest = hashlib.sha256(f.read()).hexdigest()
            self.assertIn("cases " + digest, settings)
            self.assertEqual(json.loads(self.read(out, "provenance.json"))["inputs"], [{"file": cases, "sha256": digest}])
            # The same as JSON, and the threads that were asked for.
            result = run("accuracy", "--cases", cases, "--planes", "3,36", "--no-figures", "--quiet", "--json", "--threads",
                         "3", "--out", out)
            self.assertEqual(json.loads(result.stdout), json.loads(self.read(out, "summary.json")))
            self.assertEqual(json.loads(self.read(out, "provenance.json"))["threads"], 3)

    def test_hashes_of_all_lengths(self):
        # The end of a SHA-256 stands in the last block or in one more: lengths around the edges.
        with tempfile.TemporaryDirectory() as folder:
            cases = os.path.join(folder, "cases.jsonl")
            line = json.dumps({"agent": ball([1, 0, 0], 1), "obstacle": ball([6, 0, 0], 2)}) + "\n"
            for length in (119, 120, 127, 128, 129, 183, 184, 191, 192):
                content = (line + " " * length)[:length].encode()
                with open(cases, "wb") as f:
                    f.write(content)
                result = run("accuracy", "--cases", cases, "--planes", "3,4", "--no-figures", "--quiet", "--out", folder)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(hashlib.sha256(content).hexdigest(), self.table(folder)[0], length)

    def test_combined_obstacles(self):
        arguments = ("accuracy", "--obstacle", "biconcave", "-N", "16", "--planes", "3,6,12,96", "--tolerance", "0.1",
                     "--no-figures", "--quiet")
        with tempfile.TemporaryDirectory() as folder:
            one, two = os.path.join(folder, "one"), os.path.join(folder, "two")
            result = run(*arguments, "--threads", "1", "--out", one)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(run(*arguments, "--threads", "2", "--out", two).returncode, 0)
            self.assertEqual(self.read(one, "engagements.csv"), self.read(two, "engagements.csv"))
            summary = json.loads(self.read(one, "summary.json"))["random"]
            self.assertEqual(summary["obstacle"], "biconcave")
            self.assertEqual([row["above_two_over_n"] for row in summary["slice"]], [0, 0, 0, None])
            self.assertLessEqual(summary["reference_gap"]["worst"], 0.1)
            low, high = summary["slice_bias"]["mean"]
            self.assertGreater(high, low)
            self.assertGreater(high, 0.03)  # the slices miss something
            self.assertGreater(summary["slice_bias"]["worst"][0], 0.05)  # proved
            self.assertEqual(json.loads(self.read(one, "provenance.json"))["tolerance"], 0.1)
            # Unfinished work of another tolerance is kept.
            os.rename(os.path.join(one, "engagements.csv"), os.path.join(one, "engagements.csv.partial"))
            other = run(*arguments[:-3], "0.2", "--no-figures", "--quiet", "--out", one)
            self.assertEqual(other.returncode, 2)
            self.assertIn("--out", other.stderr)

    def test_figures(self):
        if subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], capture_output=True, check=False).returncode:
            self.skipTest("no /usr/bin/python3 with matplotlib")
        with tempfile.TemporaryDirectory() as folder:
            scan = os.path.join(folder, "tetrahedron.off")
            with open(scan, "w", encoding="utf-8") as f:
                f.write("OFF\n4 0 0\n0 0 0\n3 0 0\n0 2 0\n0 0 1\n")
            result = run("accuracy", "-N", "30", "--planes", "3,12,36", "--approaches", "20", "--quiet", "--scan", scan,
                         "--out", os.path.join(folder, "out"))
            self.assertEqual(result.returncode, 0, result.stderr)
            pictures = [line.split()[1] for line in result.stdout.splitlines() if line.startswith("picture")]
            self.assertEqual(sorted(os.path.basename(p) for p in pictures),
                             ["accuracy.pdf", "accuracy.png", "engagement.pdf", "engagement.png", "scans.pdf", "scans.png"])
            result = run("accuracy", "--obstacle", "biconcave", "-N", "5", "--planes", "3,12,36", "--tolerance", "0.2",
                         "--quiet", "--out", os.path.join(folder, "dented"))
            self.assertEqual(result.returncode, 0, result.stderr)
            dented = [line.split()[1] for line in result.stdout.splitlines() if line.startswith("picture")]
            self.assertEqual(sorted(os.path.basename(p) for p in dented), ["accuracy.pdf", "accuracy.png"])
            scene = os.path.join(SOURCE, "docs", "examples", "biconcave.yaml")
            result = run("cone", scene, "--tolerance", "0.1", "--picture", os.path.join(folder, "scene"))
            self.assertEqual(result.returncode, 0, result.stderr)
            shown = [line.split()[1] for line in result.stdout.splitlines() if line.startswith("picture")]
            self.assertEqual(sorted(os.path.basename(p) for p in shown), ["engagement.pdf", "engagement.png"])
            for p in pictures + dented + shown:
                with open(p, "rb") as f:
                    self.assertIn(f.read(4), (b"%PDF", b"\x89PNG"))


if __name__ == "__main__":
    unittest.main()
