# SPDX-License-Identifier: BSD-3-Clause
"""Certificates of tracks and runs of bodies of every kind, of passages, and of what comes nearer than required: read by
checker/vericone_check.py, which shares nothing with the library; damaged ones are refused. Environment as for command.py."""
import copy
import json
import math
import os
import random
import sys
import tempfile
import unittest

sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)), os.path.dirname(os.path.dirname(os.path.abspath(__file__)))]
from command import SOURCE, check_certificates, run  # noqa: E402

EXAMPLES = os.path.join(SOURCE, "docs", "examples", "scenarios")
PAPERS = os.path.join(SOURCE, "papers", "dhal2022", "scenarios")
BOX = "[[-0.4, -0.2, -0.1], [0.4, -0.2, -0.1], [-0.4, 0.2, -0.1], [0.4, 0.2, -0.1], [-0.4, -0.2, 0.1], [0.4, 0.2, 0.1]]"

# Each is within 0.7 m of its middle, and holds a ball of 0.05 m about it but for the flat ones.
SHAPES = {"ellipsoid": "{semi_axes: [0.4, 0.3, 0.2]}", "hull": "{points: %s}" % BOX, "capsule": "{capsule: {radius: 0.2, length: 0.6}}",
          "cylinder": "{cylinder: {radius: 0.3, height: 0.5}}", "cone": "{cone: {radius: 0.3, height: 0.6}}",
          "frustum": "{frustum: {radii: [0.3, 0.15], height: 0.5}}", "disc": "{disc: {radius: 0.4}}",
          "box": "{box: {half_widths: [0.3, 0.2, 0.1]}}", "round box": "{box: {half_widths: [0.2, 0.2, 0.1]}, margin: 0.1}",
          "swollen hull": "{points: %s, margin: 0.05}" % BOX}


class Bodies(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def check(self, path):
        done = check_certificates(path)
        return done.returncode, done.stdout

    def status(self, document):
        return self.check(self.path("damaged.json", json.dumps(document)))[0]

    def certified(self, text):
        """(pairs, what is said of certificates, the certificates)."""
        out = os.path.join(self.folder, "certificate.json")
        result = run("certify", self.path("tracks.yaml", text), "--quiet", "--json", "--certificate", out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        answer = json.loads(result.stdout)
        with open(out, encoding="utf-8") as file:
            documents = [json.loads(line) for line in file]
        code, said = self.check(out)
        self.assertEqual(code, 0, said)
        return answer["pairs"], answer["certificate"], documents

    def simulated(self, scenario):
        out = os.path.join(self.folder, "out")
        result = run("simulate", scenario, "--out", out, "--quiet", "--no-figures", "--json", "--certificate")
        self.assertEqual(result.returncode, 0, result.stderr)
        path = os.path.join(out, "certificate.json")
        code, said = self.check(path)
        self.assertEqual(code, 0, said)
        with open(path, encoding="utf-8") as file:
            return json.loads(result.stdout)["certificate"], [json.loads(line) for line in file]

    def flight(self, shapes, aside, top="", radius=0.01):
        """The first turns and flies by all the others, `aside` metres from their middles."""
        rng = random.Random(str(sorted(shapes)) + str(aside))
        first, *others = shapes
        text = top + ("bodies:\n  - {name: flyer, radius: %s, shape: %s, track: {kind: poses, between: linear, times: [0, 1, 2, 3], points: "
                      "[[-3, 0, 0], [-1, 0.1, 0], [1, -0.1, 0], [3, 0, 0]], rotations: [[1, 0, 0, 0], [0.8, 0.6, 0, 0], [0.8, 0, "
                      "0.6, 0], [0.6, 0, 0, 0.8]]}}\n" % (radius, SHAPES[first]))
        for i, name in enumerate(others):
            angle = 2 * math.pi * i / len(others)
            text += "  - {name: %s %d, shape: %s, position: [%.3f, %.3f, %.3f], spin: [%.2f, 0.3, 0]}\n" % (
                name, i, SHAPES[name], rng.uniform(-1, 1), aside * math.cos(angle), aside * math.sin(angle), rng.uniform(-1, 1))
        return text

    def test_every_kind_beside_every_other(self):
        for first in SHAPES:
            with self.subTest(first):
                pairs, said, documents = self.certified(self.flight([first, *SHAPES], 1.45))
                self.assertEqual({pair["verdict"] for pair in pairs}, {"apart"})
                self.assertEqual((said["pairs"], said["none"]), (len(SHAPES), []))
                self.assertEqual({len(document["claim"]["pairs"]) for document in documents}, {len(SHAPES)})
                claim = documents[0]["claim"]
                near = copy.deepcopy(documents[0])
                near["claim"]["by"] = 1.5
                self.assertEqual(self.status(near), 1)
                bodies = [k for k, body in enumerate(claim["bodies"]) if body["kind"] == "convex"]
                self.assertGreaterEqual(len(bodies), len(SHAPES) - 3)
                for k in bodies[:2]:  # grown until it reaches the flyer, or the flyer reaches the others
                    grown = copy.deepcopy(documents[0])
                    grown["claim"]["bodies"][k]["margin"] = 1.5
                    self.assertEqual(self.status(grown), 1)

    def test_every_kind_into_every_other(self):
        """What meets is told to: of round bodies that they meet, of others that they come as near as their tubes are wide."""
        for first in SHAPES:
            with self.subTest(first):
                pairs, said, documents = self.certified(self.flight([first, *SHAPES], 0.05))
                self.assertEqual({pair["verdict"] for pair in pairs}, {"contact"})
                self.assertEqual(len(documents), len(SHAPES), said)
                for document in documents:
                    self.assertIn(document["claim"]["says"], ("meet", "near"))
                    self.assertLess(document["claim"].get("by", 0), 0.03)
                for document in documents[:2] + documents[-1:]:
                    wider = copy.deepcopy(document)
                    wider["claim"]["tracks"][0]["radius"] = 1
                    self.assertEqual(self.status(wider), 1)
                    other = copy.deepcopy(document)  # at a time at which the two are not near
                    other["proof"]["time"] = 0.01
                    self.assertEqual(self.status(other), 1)
        rounded = [d for d in documents if d["claim"]["says"] == "meet"]
        self.assertGreaterEqual(len(rounded), 2)

    def test_nearer_than_required(self):
        """The tracks themselves come as near as radii and the required distance together."""
        for first in ("hull", "cylinder", "ellipsoid", "swollen hull"):
            with self.subTest(first):
                pairs, said, documents = self.certified(self.flight([first, *SHAPES], 1.45, "required: 1.4\n"))
                self.assertEqual({pair["verdict"] for pair in pairs}, {"nearer"})
                near = [d for d in documents if d["claim"]["says"] == "near"]
                self.assertEqual((len(near), said["none"]), (len(SHAPES), []))
                self.assertEqual({round(document["claim"]["by"], 12) for document in near}, {1.41})
                for document in near[::4]:
                    document["claim"]["by"] = 0.2
                    self.assertEqual(self.status(document), 1)

    def test_passages(self):
        # The run of orifices ends before the last is surely behind.
        for folder, name, passed, none in ((EXAMPLES, "orifices", 2, ["A, window"]), (EXAMPLES, "window", 1, []), (PAPERS, "2.4-rings", 2, [])):
            with self.subTest(name):
                said, documents = self.simulated(os.path.join(folder, name + ".yaml"))
                self.assertEqual([one["what"] for one in said["none"]], none)
                through = [d for d in documents if d["claim"]["says"] == "passed"]
                self.assertEqual(len(through), passed)
                self.assertGreaterEqual(sum(len(d["claim"].get("pairs", ())) for d in documents), passed)
                for document in through:
                    back = copy.deepcopy(document)
                    back["claim"]["along"] *= -1
                    self.assertEqual(self.status(back), 1)
                    for k in range(2):
                        wide = copy.deepcopy(document)
                        wide["claim"]["tracks"][k]["radius"] = 3
                        self.assertEqual(self.status(wide), 1)
                    small = copy.deepcopy(document)  # a smaller hole; the ring reaches as far
                    small["claim"]["bodies"][1]["outline"] = [[x / 64, y / 64] for x, y in small["claim"]["bodies"][1]["outline"]]
                    small["claim"]["bodies"][1]["extent"] *= 64
                    self.assertEqual(self.status(small), 1)
                    early = copy.deepcopy(document)
                    early["claim"]["to"] = (early["claim"]["from"] + early["claim"]["to"]) / 2
                    self.assertEqual(self.status(early), 1)

    def test_corridors(self):
        scenario = self.path("scenario.yaml", """name: legs
duration: 30
step: 0.05
bodies:
  - name: A
    shape: {semi_axes: [0.6, 0.3, 0.2]}
    position: [0, 0, 0]
    velocity: [2, 0, 0]
    pilot:
      law: clearance
      clearance: {required: 0.1, longitudinal: true}
      most: 2
      manner: guarded
      goals: [{point: [20, 0, 0], most: 2, reached: 0.5, corridor: 2}, {point: [20, 14, 0], most: 2, reached: 0.5, corridor: 4}]
  - {name: B, shape: {semi_axes: [0.5, 0.5, 0.5]}, position: [10, 0.2, 0], velocity: [0, 0, 0]}
""")
        said, documents = self.simulated(scenario)
        self.assertEqual(said["none"], [])
        stays = [d for d in documents if d["claim"]["says"] == "stays"]
        self.assertEqual(len(stays), 2)
        for document in stays:
            narrow = copy.deepcopy(document)
            narrow["claim"]["bodies"][1]["margin"] = 0.6
            self.assertEqual(self.status(narrow), 1)
            shifted = copy.deepcopy(document)
            shifted["claim"]["tracks"][1]["positions"] = [[[0, 0, 5]]]
            self.assertEqual(self.status(shifted), 1)

    def test_runs_of_round_bodies(self):
        scenario = self.path("scenario.yaml", """name: round
duration: 4
step: 0.02
bodies:
  - {name: A, shape: {capsule: {radius: 0.3, length: 1}}, position: [0, 0, 0], velocity: [3, 0, 0], pilot: {law: avoidance, most: 8}}
  - {name: B, shape: {cylinder: {radius: 0.5, height: 1}}, position: [9, 0.3, 0], velocity: [-1, 0, 0]}
  - {name: C, shape: {cone: {radius: 0.5, height: 1}}, position: [5, -4, 0], velocity: [0, 0.1, 0]}
""")
        said, documents = self.simulated(scenario)
        self.assertEqual(said, {"pairs": 3, "none": []})
        self.assertEqual({body["kind"] for body in documents[0]["claim"]["bodies"]}, {"convex"})


if __name__ == "__main__":
    unittest.main()
