# SPDX-License-Identifier: BSD-3-Clause
"""vericone simulate and vericone campaign as a user meets them: spheres in closed form, files, interruptions.
Environment as for command.py."""
import csv
import json
import math
import os
import re
import signal
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bad_input_cases  # noqa: E402
from command import SOURCE, VERICONE, run  # noqa: E402

BALLS = """name: balls
duration: 6
step: 0.02
bodies:
  - name: A
    shape: {semi_axes: [1, 1, 1]}
    position: [0, 0, 0]
    velocity: [5, 0, 0]
    pilot: {law: LAW}
  - name: B
    shape: {semi_axes: [2, 2, 2]}
    position: [20, ASIDE, 0]
    velocity: [-1, 0, 0]
"""


def balls(law="avoidance, most: 1.0e-9", aside=0):
    return BALLS.replace("LAW", law).replace("ASIDE", str(aside))


class Files(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = self.temporary.name
        self.out = os.path.join(self.folder, "out")

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, text):
        path = os.path.join(self.folder, "scenario.yaml")
        with open(path, "w", encoding="utf-8") as f:
            f.write(text)
        return path

    def simulate(self, text, *arguments):
        result = run("simulate", self.write(text), "--out", self.out, "--quiet", "--no-figures", "--json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr, "")
        return json.loads(result.stdout)

    def table(self, name):
        with open(os.path.join(self.out, name), newline="", encoding="utf-8") as f:
            return list(csv.DictReader(f))

    def content(self, name):
        with open(os.path.join(self.out, name), "rb") as f:
            return f.read()


class Simulate(Files):
    def test_balls_that_cannot_turn_meet_when_they_must(self):
        proof = self.simulate(balls())["proof"]
        self.assertEqual(proof["verdict"], "touched")
        pair, contact = proof["pairs"][0], 17 / 6
        self.assertLessEqual(pair["from"], contact + 1e-6)
        self.assertGreaterEqual(pair["to"], contact - 1e-6)
        self.assertLess(pair["to"] - pair["from"], 1e-5)
        self.assertLess(math.dist(pair["place"], [5 * contact + 1, 0, 0]), 1e-3)
        event = [e for e in self.table("events.csv") if e["event"] == "contact"][0]
        self.assertEqual((event["agent"], event["obstacle"], event["unit"]), ("A", "B", "s"))
        self.assertAlmostEqual(float(event["t [s]"]), contact, 5)

    def test_balls_that_miss_are_as_far_apart_as_they_are(self):
        proof = self.simulate(balls(aside=5))["proof"]
        self.assertEqual(proof["verdict"], "avoided")
        pair = proof["pairs"][0]
        self.assertLessEqual(pair["least_distance"], 2)
        self.assertGreater(pair["least_distance"], 1.99)
        self.assertEqual((pair["from"], pair["to"]), (0, 6))
        for row in self.table("encounters.csv"):
            self.assertAlmostEqual(float(row["m [m]"]), 2, 9)
            self.assertEqual(float(row["a [m/s^2]"]), 0)
        passed = [e for e in self.table("events.csv") if e["event"] == "passes"][0]
        self.assertAlmostEqual(float(passed["t [s]"]), 20 / 6, 6)
        self.assertAlmostEqual(float(passed["value"]), 5, 6)

    def test_the_clearance_law_keeps_its_metres(self):
        proof = self.simulate(balls("clearance, gain: 3, most: 30, clearance: {required: 1.5}", aside=1))["proof"]
        self.assertEqual(proof["verdict"], "avoided")
        bodies = self.table("bodies.csv")
        place = {(r["body"], r["t [s]"]): [float(r[c + " [m]"]) for c in "xyz"] for r in bodies}
        nearest = min(math.dist(p, place["B", t]) for (name, t), p in place.items() if name == "A") - 3
        # As its own law flies it; a guarded pilot keeps `beyond` besides, 0.1 m.
        self.assertGreater(nearest, 1.5)
        self.assertLess(nearest, 1.75)
        self.assertTrue(proof["pairs"][0]["kept"])
        by_law = self.simulate(balls("clearance, manner: source, gain: 3, most: 30, clearance: {required: 1.5}", aside=1))
        self.assertAlmostEqual(by_law["proof"]["pairs"][0]["least_distance"], 1.5, delta=0.02)
        self.assertLessEqual(proof["pairs"][0]["least_distance"], nearest + 1e-9)
        for row in bodies:  # lateral: the speed stays
            if row["body"] == "A":
                self.assertAlmostEqual(float(row["speed [m/s]"]), 5, 8)

    def test_every_pair_counts(self):
        """Two bodies without pilots fly through each other; two that fly together are named."""
        two = """duration: 6
bodies:
  - {name: A, shape: {semi_axes: [1, 1, 1]}, position: [0, 0, 0], velocity: [5, 0, 0]}
  - {name: B, shape: {semi_axes: [1, 1, 1]}, position: [20, 0, 0], velocity: [-5, 0, 0]}
"""
        proof = self.simulate(two)["proof"]
        self.assertEqual((proof["verdict"], len(proof["pairs"]), proof["not_checked"]), ("touched", 1, []))
        proof = self.simulate(two.replace("-5", "5"))["proof"]
        self.assertEqual(proof, {"verdict": "none", "pairs": [], "not_checked": [{"a": "A", "b": "B", "why": "together"}]})

    def test_what_was_reached_and_how_long_it_took_is_said(self):
        scenario = os.path.join(SOURCE, "docs/examples/scenarios/quadrotor.yaml")
        result = run("simulate", scenario, "--out", self.out, "--no-figures")
        self.assertEqual(result.stderr.splitlines(), ["simulating quadrotor", "proving quadrotor", "writing"])
        with open(os.path.join(self.out, "run.json"), encoding="utf-8") as f:
            told = json.load(f)
        acceleration, = told["accelerations"]
        self.assertEqual((acceleration["agent"], acceleration["most"]), ("quadrotor", 6))
        flown = max(float(r["a [m/s^2]"]) for r in self.table("bodies.csv") if r["body"] == "quadrotor")
        self.assertGreaterEqual(acceleration["reached"], flown)
        self.assertLess(acceleration["reached"], 1.5 * flown)
        self.assertIn("commands at most 6 m/s^2", result.stdout)
        self.assertEqual("; reached up to" in result.stdout, acceleration["reached"] > 6)
        times = told["times"]
        self.assertEqual(times["decisions"], len({r["t [s]"] for r in self.table("encounters.csv")}))
        self.assertTrue(0 < times["mean"] <= times["worst"] and times["within"] <= times["worst"] and times["proofs"] > 0)
        self.assertLess(times["mean"] * times["decisions"] + times["proofs"], told["seconds"])
        self.assertRegex(result.stdout, r"(?m)^time of decisions +mean .* ms, 99 %% within .* ms, worst .* ms, of %d; proofs .* s$"
                         % times["decisions"])

    def test_what_was_not_kept_is_said(self):
        # Gain 1/s is too little here: it passes nearer than 1 m.
        text = balls("clearance, manner: source, gain: 0.3", aside=3.1)
        pair = self.simulate(text)["proof"]["pairs"][0]
        self.assertFalse(pair["kept"])
        self.assertEqual(pair["required"], 1)
        result = run("simulate", self.write(text), "--out", self.out, "--quiet", "--no-figures")
        self.assertRegex(result.stdout, r"verdict +avoided, proved; nearer than required: 0\.\d+ of 1 m\n")
        self.assertIn("A is on course to pass B nearer than 1 m, at 0.1 m", result.stdout)

    def test_goals_are_flown_to_one_after_the_other(self):
        goals = ("[{point: [10, 0, 0], most: 2, stay: 0.5}, {point: [0, 9, 0], most: 2, follows: B, velocity: [0, 0, 1]}]")
        text = balls("avoidance, most: 1.0e-9, goals: " + goals, 100)
        run_json = self.simulate(text)["run"]
        self.assertEqual(run_json["goals"], [
            {"agent": "A", "point": [10, 0, 0], "reached": 1, "stay": 0.5},
            {"agent": "A", "point": [0, 9, 0], "reached": 1, "velocity": [0, 0, 1], "follows": "B"}])
        reached = [r for r in self.table("events.csv") if r["event"] == "reaches-goal"]
        self.assertEqual([round(float(r["t [s]"]), 9) for r in reached], [1.8])
        checked = run("check", os.path.join(self.folder, "scenario.yaml"))
        self.assertIn("goal (10, 0, 0) m; stays 0.5 s\n", checked.stdout)
        self.assertIn("goal (0, 9, 0) m from B; moves at (0, 0, 1) m/s\n", checked.stdout)

    def test_what_goals_and_sensors_cannot_be_is_said(self):
        exact = "avoidance, manner: source, sensor: {noise: isotropic, position: 0, velocity: 0, %s}"
        engagement = "avoidance, manner: source, sensor: {noise: engagement, period: 1}"
        goal = "{point: [9, 0, 0], most: 1%s}"
        for law, field, must_be in (
                ("avoidance, goal: %s, goals: [%s]" % (goal % "", goal % ""), "goals", "left out beside goal"),
                ("avoidance, goals: []", "goals", "a list of goals"),
                ("avoidance, goal: " + goal % ", follows: A", "goal.follows", "the name of another body"),
                ("avoidance, goals: [%s]" % goal % ", follows: C", "goals[0].follows", "the name of another body"),
                ("avoidance, goals: [%s]" % goal % ", stay: -1", "goals[0].stay", "a number, 0 or more (s)"),
                ("avoidance, manner: source, looks: 9", "looks", "left out: only a guarded pilot reads it"),
                ("avoidance, fastest: 9", "fastest", "left out, or given with clearance.longitudinal: true: else it keeps its speed"),
                ("cooperative-avoidance, looks: 9", "looks", "left out: only avoidance, clearance reads it"),
                (engagement, "sensor.period", "left out: only per-axis, isotropic, bounded reads it"),
                (exact % "dropout: 1", "sensor.dropout", "a number, 0 or more, below 1"),
                (exact % "view_deg: 200", "sensor.view_deg", "a positive number, at most 180 (degrees)"),
                (exact % "range: 0", "sensor.range", "a positive number (metres)")):
            result = run("simulate", self.write(balls(law)), "--out", self.out, "--quiet", "--no-figures")
            self.assertEqual(result.returncode, 2, law)
            self.assertRegex(result.stderr, r"\Avericone: bodies\[0\]\.pilot\.%s: got .+, must be %s\n\Z"
                             % (re.escape(field), re.escape(must_be)))

    def test_a_body_that_comes_within_range_is_seen(self):
        sensor = "avoidance, manner: source, sensor: {noise: isotropic, position: 0, velocity: 0, range: 9.01}"
        text = balls(sensor, 5)
        self.simulate(text)
        events = [(r["event"], float(r["t [s]"])) for r in self.table("events.csv")]
        # Of a ball of 2 m that comes at 6 m/s, 5 m aside: hypot(20 - 6 t, 5) = 11.01, at the next command.
        first = (20 - math.sqrt(11.01 ** 2 - 25)) / 6
        self.assertEqual([round(t, 9) for e, t in events if e == "sees"], [round(math.ceil(first / 0.02) * 0.02, 9)])
        text = run("simulate", self.write(text), "--out", self.out + "2", "--no-figures").stdout
        self.assertIn("A sees B", text)
        self.assertIn("A loses sight of B", text)

    def test_defaults_avoid_a_ball_at_rest(self):
        for law in ("avoidance", "clearance"):
            proof = self.simulate(balls(law).replace("[-1, 0, 0]", "[0, 0, 0]"))["proof"]
            self.assertEqual(proof["verdict"], "avoided")

    def test_the_example_scenarios(self):
        for name in ("avoidance", "clearance"):
            result = run("simulate", os.path.join(SOURCE, "docs", "examples", "scenarios", name + ".yaml"), "--out", self.out, "--quiet",
                         "--no-figures")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertIn("verdict             avoided, proved\n", result.stdout)
            self.assertEqual(sorted(os.listdir(self.out)),
                             ["bodies.csv", "encounters.csv", "events.csv", "proof.json", "run.json", "scenario.yaml",
                              "shapes.json"])
            times = {r["t [s]"] for r in self.table("bodies.csv")}
            self.assertEqual(len(self.table("bodies.csv")), 3 * len(times))
            with open(os.path.join(SOURCE, "docs", "examples", "scenarios", name + ".yaml"), "rb") as f:
                self.assertEqual(self.content("scenario.yaml"), f.read())

    def scenario_of_placed(self, name, unpacked=None):
        """An example scenario, its files found from a folder elsewhere; the same without its pilot."""
        folder = os.path.join(SOURCE, "docs", "examples", "scenarios")
        with open(os.path.join(folder, name + ".yaml"), encoding="utf-8") as f:
            text = f.read()
        text = text.replace("../../../build/scans/elephant.off", unpacked or "none.off")
        text = text.replace("../bodies/elephant-pieces.yaml", os.path.join(SOURCE, "docs", "examples", "bodies", "elephant-pieces.yaml"))
        guided = re.compile(r"^    pilot:\n(      .*\n)+", re.MULTILINE)
        self.assertEqual(len(guided.findall(text)), 1)
        return text, guided.sub("", text)

    def avoided_and_touched(self, name, unpacked=None):
        """With guidance avoided and arrived, without it touched: both proved. The two proofs."""
        guided, unguided = self.scenario_of_placed(name, unpacked)
        avoided = self.simulate(guided)["proof"]
        self.assertEqual(avoided["verdict"], "avoided")
        self.assertTrue(avoided["pairs"][0]["kept"])
        self.assertIn("reaches-goal", [r["event"] for r in self.table("events.csv")])
        self.way = [[float(r[c + " [m]"]) for c in "xyz"] for r in self.table("bodies.csv")
                    if r["body"] == avoided["pairs"][0]["a"]]
        touched = self.simulate(unguided)["proof"]
        self.assertEqual(touched["verdict"], "touched")
        return avoided["pairs"][0], touched["pairs"][0]

    def test_openings_of_every_outline_are_passed(self):
        """The example's three openings: passed, proved; where the middle crosses each plane, by code of its own."""
        with open(os.path.join(SOURCE, "docs", "examples", "scenarios", "orifices.yaml"), encoding="utf-8") as f:
            answer = self.simulate(f.read())
        self.assertEqual(answer["proof"]["verdict"], "passed")
        orifices = {o["name"]: o for o in json.loads(self.content("orifices.json"))}
        way = [[float(r[c]) for c in ("t [s]", "x [m]", "y [m]", "z [m]")] for r in self.table("bodies.csv")]
        for passage in answer["proof"]["passages"]:
            self.assertEqual((passage["verdict"], passage["ordered"]), ("passed", True))
            orifice = orifices[passage["orifice"]]
            self.assertEqual(orifice["spin"][1:], [0, 0])
            heights, t = [], passage["time"]
            for row in (max(r for r in way if r[0] <= t), min(r for r in way if r[0] > t)):
                c = [x - p - row[0] * v for x, p, v in zip(row[1:], orifice["position"], orifice["velocity"])]
                angle = -row[0] * orifice["spin"][0]  # turned back about x
                c = [c[0], math.cos(angle) * c[1] - math.sin(angle) * c[2], math.sin(angle) * c[1] + math.cos(angle) * c[2]]
                x, y, z = (sum(orifice["rotation"][i][k] * c[i] for i in range(3)) for k in range(3))
                heights.append(z)
                outline = orifice["opening"]
                if "semi_axes" in outline:
                    self.assertLess((x / outline["semi_axes"][0]) ** 2 + (y / outline["semi_axes"][1]) ** 2, 1)
                else:
                    sides = [(a, b) for a, b in zip(outline["polygon"], outline["polygon"][1:] + outline["polygon"][:1])]
                    crossed = sum((a[1] > y) != (b[1] > y) and x < a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) for a, b in sides)
                    self.assertEqual(crossed % 2, 1)
            self.assertLess(heights[0] * heights[1], 0)
        self.assertEqual([e["event"] for e in self.table("events.csv")], ["goes-through"] * 3)

    def test_a_window_of_a_real_mesh_is_passed_and_another_one_is_not(self):
        if not os.path.exists("/usr/share/doc/libcgal-dev/data.tar.gz"):
            self.skipTest("libcgal-demo is not installed")
        path = os.path.join(self.folder, "holes.off")
        with tarfile.open("/usr/share/doc/libcgal-dev/data.tar.gz") as archive, open(path, "wb") as f:
            f.write(archive.extractfile(next(m for m in archive.getmembers() if m.name.endswith("meshes/holes.off"))).read())
        with open(os.path.join(SOURCE, "docs", "examples", "scenarios", "bust.yaml"), encoding="utf-8") as f:
            text = f.read().replace("../../../build/windows/holes.off", path)
        passage, = self.simulate(text)["proof"]["passages"]
        self.assertEqual(passage["verdict"], "passed")
        # No corner of the mesh is nearer to the middle than what is proved and the least half-length.
        with open(path, encoding="utf-8") as f:
            words = f.read().split()
        corners = [[float(x) for x in words[4 + 3 * i:7 + 3 * i]] for i in range(int(words[1]))]
        way = [[float(r[c + " [m]"]) for c in "xyz"] for r in self.table("bodies.csv")]
        nearest = min(math.dist(p, corner) for p in way[::4] for corner in corners)
        self.assertGreaterEqual(nearest, passage["least_distance"] + 0.05)
        # Straight on, without the law, it meets the mesh or passes beside it.
        straight = re.sub(r"most: 0.5", "most: 1.0e-6", text)
        self.assertIn(self.simulate(straight)["proof"]["passages"][0]["verdict"], ("touched", "missed"))

    def test_a_mesh_is_avoided_and_touched_without_guidance(self):
        if not os.path.exists("/usr/share/doc/libcgal-dev/data.tar.gz"):
            self.skipTest("libcgal-demo is not installed")
        with tarfile.open("/usr/share/doc/libcgal-dev/data.tar.gz") as archive:
            member = next(m for m in archive.getmembers() if m.name.endswith("meshes/elephant.off"))
            data = archive.extractfile(member).read()
        path = os.path.join(self.folder, "elephant.off")
        with open(path, "wb") as f:
            f.write(data)
        avoided, touched = self.avoided_and_touched("elephant", path)
        # The corners of the mesh, upright, by code of its own: none is nearer to the centre than the distance proved and
        # the ball of the least half-length, which the aircraft contains.
        words = data.decode().split()
        corners = [[float(x) for x in words[4 + 3 * i:7 + 3 * i]] for i in range(int(words[1]))]
        nearest = min(math.dist(p, (x, -z, y)) for p in self.way[::4] for x, y, z in corners)
        self.assertGreaterEqual(nearest, avoided["least_distance"] + 0.03)
        self.assertLess(nearest, 0.4)
        self.assertGreater(avoided["least_distance"], 0.1)
        # Without guidance: straight ahead at 1 m/s, which has a corner within the largest half-length and an edge.
        at = (-2 + touched["to"], 0.1, 0.05)
        self.assertLess(min(math.dist(at, (x, -z, y)) for x, y, z in corners), 0.15)

    def test_a_union_of_fitted_pieces_is_avoided_and_touched_without_guidance(self):
        avoided, touched = self.avoided_and_touched("union")
        self.assertGreater(avoided["least_distance"], 0.1)
        # The pieces contain the elephant: they are met no later than it.
        self.assertLess(touched["to"], 2)

    def test_a_map_is_avoided_and_touched_without_guidance(self):
        if not os.path.exists("/usr/share/doc/liboctomap-dev/examples/data/geb079.bt"):
            self.skipTest("liboctomap-dev is not installed")
        avoided, touched = self.avoided_and_touched("corridor")
        self.assertGreater(avoided["least_distance"], 0.1)
        self.assertAlmostEqual(touched["to"], 1.142, delta=1e-3)

    def test_the_same_bytes_again_and_no_file_of_an_earlier_run(self):
        names = ("bodies.csv", "encounters.csv", "events.csv", "proof.json", "shapes.json")
        self.simulate("planes_logged: 5\n" + balls("avoidance, most: 20"))
        self.assertEqual(len(self.table("planes.csv")) % 5, 0)
        first = [self.content(n) for n in names]
        self.simulate(balls("avoidance, most: 20"))
        self.assertEqual(first, [self.content(n) for n in names])
        self.assertFalse(os.path.exists(os.path.join(self.out, "planes.csv")))

    def test_a_body_in_the_plane_that_changes_and_appears_late(self):
        self.simulate("""name: "with, comma"
duration: 3
step: 0.1
bodies:
  - {name: "F, 1", shape: {semi_axes: [2, 1]}, position: [0, 0], speed: 10, heading_deg: 90,
     pilot: {law: avoidance, most: 10, gain: 2, reference: 0.05}}
  - {name: F2, shape: {a_c: 2, b_c: 1, k: {offset: 0.2, amplitude: 0.1, rate: 3}}, position: [0, 60], velocity: [0, -10],
     appears: 0.25}
""")
        rows = self.table("bodies.csv")
        late = [r for r in rows if r["body"] == "F2"]
        self.assertEqual(float(late[0]["t [s]"]), 0.25)
        self.assertAlmostEqual(float(late[3]["k"]), 0.2 + 0.1 * math.sin(3 * float(late[3]["t [s]"])), 12)
        agent = [r for r in rows if r["body"] == "F, 1"]
        self.assertAlmostEqual(float(agent[0]["azimuth [rad]"]), math.pi / 2, 12)
        for row in agent:
            self.assertEqual(float(row["z [m]"]), 0)
            self.assertAlmostEqual(abs(float(row["lateral [m/s^2]"])), float(row["a [m/s^2]"]), 9)
        self.assertTrue(any(float(r["a [m/s^2]"]) > 0 for r in agent))
        shapes = json.loads(self.content("shapes.json"))
        self.assertEqual([s["kind"] for s in shapes], ["ellipse", "dented_conic"])

    def test_an_interrupted_run_leaves_nothing(self):
        path = self.write(balls("avoidance, most: 1").replace("duration: 6", "duration: 900").replace("step: 0.02", "step: 0.001"))
        process = subprocess.Popen([VERICONE, "simulate", path, "--out", self.out, "--quiet"], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE)
        time.sleep(0.5)
        self.assertIsNone(process.poll(), "too quick to be interrupted")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(60), 130)
        process.communicate()
        self.assertEqual(os.listdir(self.folder), ["scenario.yaml"])

    def test_every_bad_scenario_says_why(self):
        self.assertGreaterEqual(len(bad_input_cases.SCENARIOS), 40)
        for what, text in bad_input_cases.SCENARIOS:
            with self.subTest(what):
                result, left = bad_input_cases.run_scenario(VERICONE, text)
                self.assertEqual((result.returncode, result.stdout, left), (2, "", []), result.stderr)
                self.assertRegex(result.stderr, r"\Avericone: \S.*: got .+, must be .+\n\Z")


class Campaign(Files):
    def campaign(self, *arguments, out=None):
        result = run("campaign", "--out", out or self.out, "--quiet", "--no-figures", "--json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr + result.stdout[-500:])
        return json.loads(result.stdout)

    def test_counts_are_those_of_the_table_and_no_word_is_broken(self):
        summary = self.campaign("-N", "200", "--seed", "3")
        self.assertEqual(summary["violations"], 0)
        self.assertGreater(summary["straight"]["slice_called_safe_and_met"], 0)
        with open(os.path.join(self.out, "engagements.csv"), newline="", encoding="utf-8") as f:
            next(f)
            rows = list(csv.DictReader(f))
        self.assertEqual(len(rows), 200)
        for row in rows:  # the proof of straight flight and the exact predicate agree
            self.assertEqual(row["straight"] == "avoided", row["straight safe"] == "1")
            self.assertEqual(row["straight safe"], row["exact safe"])
        self.assertGreater(sum(r["straight"] == "met" for r in rows), 100)
        self.assertEqual(len(summary["laws"]), 8)
        for law in summary["laws"]:
            fates = [(r[law["name"]], r[law["name"] + " safe"]) for r in rows]
            self.assertEqual(law["avoided"], sum(f == "avoided" for f, _ in fates))
            self.assertEqual(law["infeasible"], fates.count(("met", "0")))
            self.assertEqual(law["called_safe_and_met"], fates.count(("met", "1")))
            self.assertEqual(law["avoided"] + law["met"] + law["undecided"], 200)
            if not law["name"].startswith("slice"):
                self.assertGreater(law["avoided"], summary["straight"]["avoided"])
            for row in rows:
                self.assertLessEqual(float(row[law["name"] + " peak [m/s^2]"]), law["most"] * (1 + 1e-9))

    def test_threads_and_interruptions_change_nothing(self):
        other = os.path.join(self.folder, "other")
        arguments = ("-N", "400", "--laws", "motion,clearance")
        self.campaign(*arguments, "--threads", "2", out=other)
        partial = os.path.join(self.out, "engagements.csv.partial")
        process = subprocess.Popen([VERICONE, "campaign", "--out", self.out, "--quiet", "--no-figures", "--threads", "1",
                                    *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while process.poll() is None and not (os.path.exists(partial) and os.path.getsize(partial) > 20_000):
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, 130)
        refused = run("campaign", "--out", self.out, "-N", "400", "--seed", "9", "--quiet")
        self.assertEqual(refused.returncode, 2)
        self.assertRegex(refused.stderr, r"^vericone: --out: got .+, must be .+")
        self.campaign(*arguments, "--threads", "1")
        with open(os.path.join(other, "engagements.csv"), "rb") as f:
            self.assertEqual(self.content("engagements.csv"), f.read())

    def test_every_bad_campaign_says_why(self):
        for what, arguments in bad_input_cases.CAMPAIGNS:
            with self.subTest(what):
                result, left = bad_input_cases.run_campaign(VERICONE, arguments)
                self.assertEqual((result.returncode, result.stdout, left), (2, "", []), result.stderr)
                self.assertRegex(result.stderr, r"\Avericone: \S.*: got .+, must be .+\n\Z")


class Trials(Files):
    SCENARIO = os.path.join(SOURCE, "docs/examples/scenarios/noise.yaml")
    ARGUMENTS = ("-N", "60", "--levels", "x1,10:20", "--laws", "di,rdi-filter,clearance")

    def trials(self, *arguments, out=None):
        result = run("trials", self.SCENARIO, "--out", out or self.out, "--quiet", "--no-figures", "--json", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr + result.stdout[-500:])
        return json.loads(result.stdout)

    def rows(self):
        with open(os.path.join(self.out, "trials.csv"), newline="", encoding="utf-8") as f:
            next(f)
            return list(csv.DictReader(f))

    def test_shares_are_those_of_the_table_and_a_trial_alone_is_the_same(self):
        summary = self.trials(*self.ARGUMENTS)
        rows = self.rows()
        self.assertEqual([r["trial"] for r in rows], [str(i) for i in range(60)])
        self.assertEqual(len(summary["shares"]), 6)
        for share in summary["shares"]:
            name = share["level"] + " " + share["law"]
            verdicts = [r[name] for r in rows]
            for verdict in ("avoided", "touched", "undecided"):
                self.assertEqual(share[verdict], verdicts.count(verdict))
            self.assertAlmostEqual(share["share"], share["avoided"] / 60)
            self.assertTrue(share["low"] <= share["share"] <= share["high"])
            self.assertAlmostEqual(share["effort"], sum(float(r[name + " effort [m/s]"]) for r in rows) / 60, places=9)
        self.assertLess(summary["shares"][0]["share"], 1)  # the noise does something
        pair = next(p for p in summary["paired"] if (p["level"], p["first"], p["second"]) == ("x1", "di", "clearance"))
        both = [(r["x1 di"] == "avoided", r["x1 clearance"] == "avoided") for r in rows]
        self.assertEqual((pair["first_alone"], pair["second_alone"]), (both.count((True, False)), both.count((False, True))))
        alone = json.loads(run("trials", self.SCENARIO, "--trial", "41", "--json", *self.ARGUMENTS).stdout)
        for cell in alone:
            row, name = rows[41], cell["level"] + " " + cell["law"]
            self.assertEqual(row[name], cell["verdict"])
            self.assertEqual(float(row[name + " effort [m/s]"]), cell["effort"])
            if cell["verdict"] == "avoided":
                self.assertEqual(float(row[name + " least distance [m]"]), cell["least_distance"])

    def test_any_scenario_that_simulate_takes(self):
        for name, verdict in (("quadrotor", "avoided"), ("orifices", "avoided"), ("clearance", "avoided"), ("fish", "avoided")):
            scenario = os.path.join(SOURCE, "docs/examples/scenarios", name + ".yaml")
            cell, = json.loads(run("trials", scenario, "--trial", "3", "--json").stdout)
            self.assertEqual((cell["law"], cell["level"], cell["verdict"]), ("own", "x1", verdict))
        result = run("trials", scenario, "-N", "2", "--out", self.out, "--quiet", "--no-figures")
        self.assertIn("all trials are the same flight", result.stdout)
        text = balls("clearance, most: 20, sensor: {noise: isotropic, position: 0.2, velocity: 0.1}", aside=1)
        cells = [json.loads(run("trials", self.write(text), "--trial", k, "--json").stdout)[0] for k in "09"]
        self.assertEqual(self.simulate(text)["proof"]["pairs"][0]["least_distance"], cells[0]["least_distance"])
        self.assertNotEqual(cells[0]["least_distance"], cells[1]["least_distance"])

    def test_threads_and_a_kill_change_nothing(self):
        other = os.path.join(self.folder, "other")
        self.trials(*self.ARGUMENTS, "--threads", "2", out=other)
        partial = os.path.join(self.out, "trials.csv.partial")
        process = subprocess.Popen([VERICONE, "trials", self.SCENARIO, "--out", self.out, "--quiet", "--no-figures", "--threads",
                                    "1", *self.ARGUMENTS], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while process.poll() is None and not (os.path.exists(partial) and os.path.getsize(partial) > 3_000):
            time.sleep(0.005)
        process.kill()
        process.communicate()
        self.trials(*self.ARGUMENTS, "--threads", "1")
        with open(os.path.join(other, "trials.csv"), "rb") as f:
            self.assertEqual(self.content("trials.csv"), f.read())

    def test_random_engagements_are_others_in_every_trial(self):
        summary = self.trials("-N", "12", "--levels", "5:10", "--laws", "clearance", "--random")
        self.assertIn("random engagements", summary["settings"])
        efforts = {r["5:10 clearance effort [m/s]"] for r in self.rows()}
        self.assertGreater(len(efforts), 6)

    def test_every_bad_trial_says_why(self):
        for what, arguments in bad_input_cases.TRIALS:
            with self.subTest(what):
                result, left = bad_input_cases.run_trials(VERICONE, arguments)
                self.assertEqual((result.returncode, result.stdout, left), (2, "", []), result.stderr)
                self.assertRegex(result.stderr, r"\Avericone: \S.*: got .+, must be .+\n\Z")


RING = """name: ring
duration: 12
step: 0.1
orifices:
  - {name: O, opening: {radius: 1}, position: [5, 0, 0], normal: [1, 0, 0], wall: false}
bodies:
  - name: A
    shape: {semi_axes: [0.5, 0.5, 0.5]}
    position: [0, 0, 0]
    velocity: [1, 0, 0]
    pilot: {law: passage, through: [O], margin: 0.1, most: 0.5}
"""


class Reach(Files):
    def reach(self, text, *arguments):
        result = run("reach", self.write(text), "--quiet", "--json", *arguments)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return json.loads(result.stdout)

    def test_straight_ahead(self):
        """5 m at 1 m/s: reached at 5 s at the earliest, and by a run that goes straight through."""
        answer = self.reach(RING)
        agent = answer["agents"][0]
        self.assertEqual((agent["agent"], agent["limits"]["acceleration"], agent["limits"]["climb"]), ("A", 0.5, None))
        orifice = agent["orifices"][0]
        self.assertEqual((orifice["orifice"], orifice["verdict"]), ("O", "passed"))
        for where in ("edge", "center"):
            self.assertAlmostEqual(orifice[where]["not_before"], 5, 6)
            self.assertEqual((orifice[where]["limit"], orifice[where]["unreachable"]), ("speed", False))
        self.assertAlmostEqual(orifice["by"], 5, 9)
        self.assertNotIn("current", answer)
        text = run("reach", self.write(RING), "--quiet").stdout
        self.assertRegex(text, r"A +at most 1(\.\d+)? m/s, 0\.5 m/s\^2, turns by 28\.\d+ deg/s\n")
        self.assertRegex(text, r"O: not before (5|4\.999) s \(too far for its speed\), .*; passed by 5 s, proved\n")
        self.assertFalse(os.path.exists(self.out))

    def test_out_of_reach(self):
        orifice = self.reach(RING.replace("duration: 12", "duration: 4"))["agents"][0]["orifices"][0]
        self.assertEqual(orifice["edge"], {"not_before": None, "unreachable": True, "limit": "speed"})
        self.assertEqual((orifice["by"], orifice["verdict"]), (None, "missed"))

    def test_what_current_a_recorded_run_endures(self):
        """0.5 m of room: carried aside it touches in the plane, before 5.5 s, or is just through by then."""
        current = self.reach(RING, "--current")["current"]
        self.assertEqual(current["sampled"], [])
        self.assertGreater(current["recorded"], 0.5 / 6)
        self.assertLess(current["recorded"], 0.5 / 5)

    def test_bad_input(self):
        result = run("reach", self.write(balls()), "--quiet")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertRegex(result.stderr, r"\Avericone: bodies: got no agent with `through`, must be .+\n\Z")
        result = run("reach", self.write(RING), "--directions", "0")
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr, r"\Avericone: --directions: .+\n\Z")


if __name__ == "__main__":
    unittest.main()
