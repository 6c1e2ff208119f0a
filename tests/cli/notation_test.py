# SPDX-License-Identifier: BSD-3-Clause
"""One notation of a body: what a scene takes as its obstacle, a case takes, a scenario takes as a body and as a shape, and
all of them take by the name of a file. Environment as for command.py."""
import json
import os
import re
import sys
import tempfile
import unittest

import yaml

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from command import SOURCE, run  # noqa: E402

WINDOW = os.path.join(SOURCE, "docs/examples/window.obj")
MAP = "/usr/share/doc/liboctomap-dev/examples/data/geb079.bt"
FOUR = os.path.join(SOURCE, "docs/examples/bodies/elephant-pieces.yaml")

BODIES = {
    "axes": "{center: [8, 1, 0], semi_axes: [1, 2, 0.5], rotation: [0.8, 0, 0.6, 0]}",
    "matrix": "{center: [8, 1, 0], shape: [[1, 0.1, 0], [0.1, 2, 0], [0, 0, 1]]}",
    "quadric": "{quadric: [[1, 0, 0, -8], [0, 1, 0, 0], [0, 0, 1, 0], [-8, 0, 0, 63]]}",
    "dents": "{center: [8, 1, 0], semi_axes: [2, 3, 3], hyperboloids: [{sheets: 2, semi_axes: [0.7, 1.2, 1.2]}]}",
    "points": "{points: [[8, 0, 0], [9, 0, 0], [8, 1, 0], [8, 0, 1]]}",
    "mesh": f"{{mesh: {WINDOW}, center: [8, 0, 0]}}",
    "cloud": f"{{cloud: {WINDOW}, radius: 0.1, center: [8, 0, 0]}}",
    "hull": f"{{hull: {WINDOW}, center: [8, 0, 0]}}",
    "octree": f"{{octree: {MAP}, unknown: free, center: [60, 0, 0]}}",
    "union": "{pieces: [{center: [8, 0, 0], semi_axes: [1, 1, 1]}, {center: [9, 0, 0], semi_axes: [1, 1, 1]}]}",
    "hulls": "{pieces: [{points: [[8, 0, 0], [9, 0, 0], [8, 1, 0], [8, 0, 1]]}, "
             "{points: [[8, 0, 0], [9, 0, 0], [8, -1, 0], [8, 0, -1]]}], center: [0, 1, 0]}",
    "fitted": f"{{pieces: {FOUR}, center: [8, 0, 0], rotation: [0.7071067811865476, 0.7071067811865476, 0, 0]}}",
}
AGENT = "{center: [0, 0, 0], semi_axes: [0.5, 0.3, 0.3]}"


class Notation(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)
        return self.path(name)

    def case(self, body):
        fields = {"agent": yaml.safe_load(AGENT), "obstacle": yaml.safe_load(body),
                  "agent_velocity": [1, 0.1, 0], "obstacle_velocity": [0, 0, 0]}
        done = run("query", self.write("case.jsonl", json.dumps(fields) + "\n"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(done.stdout)

    def scene(self, body):
        scene = self.write("scene.yaml", f"agent: {AGENT}\nobstacle: {body}\nagent_velocity: [1, 0.1, 0]\n")
        done = run("cone", scene, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def fly(self, second, duration):
        first = AGENT.replace("{", "{name: A, velocity: [1, 0.1, 0], orientation: fixed, rotation: [1, 0, 0, 0], ", 1)
        scenario = self.write("run.yaml", f"duration: {duration}\nstep: {duration / 2}\n"
                                          f"bodies:\n  - {first}\n  - {second}\n")
        done = run("simulate", scenario, "--json", "--no-figures", "--quiet", "--out", self.path("out"))
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)["proof"]

    def test_every_body_in_scene_case_and_scenario_and_by_file(self):
        for name, body in BODIES.items():
            if name == "octree" and not os.path.exists(MAP):
                continue
            with self.subTest(name):
                self.write(name + ".yaml", body)
                named = f"{{file: {name}.yaml}}"
                answer = self.case(body)
                self.assertEqual(self.case(named), answer)
                cone = self.scene(body)
                self.assertEqual(self.scene(named)["relation"], cone["relation"])
                self.assertEqual(cone["relation"], "disjoint")
                hit = answer["time_to_contact"]
                duration = 20 if hit is None else 1.1 * hit
                # As a body of a scenario, and as the shape of one at the origin; inline and by file.
                at_origin = "{name: B, position: [0, 0, 0], velocity: [0, 0, 0], orientation: fixed, " \
                            "rotation: [1, 0, 0, 0], shape: "
                for text in (body, named):
                    # In a scenario a body's x points along its velocity unless it says otherwise.
                    for second in (text.replace("{", "{name: B, orientation: fixed, ", 1) if "rotation" in text else
                                   text.replace("{", "{name: B, orientation: fixed, rotation: [1, 0, 0, 0], ", 1)
                                   if "file" not in text else at_origin + text + "}",
                                   at_origin.replace("velocity: [0, 0, 0], ", "") + text + "}"):  # at rest without one
                        proof = self.fly(second, duration)
                        self.assertEqual(proof["verdict"], "avoided" if hit is None else "touched", second)
                        if hit is not None:
                            # Of dented bodies the proof of contact comes a little later than the contact.
                            self.assertLessEqual(proof["pairs"][0]["from"], hit * (1 + 1e-5))
                            self.assertGreaterEqual(proof["pairs"][0]["to"], hit * (1 - 1e-5))
                            self.assertLessEqual(proof["pairs"][0]["to"], hit * (1.01 if name == "dents" else 1 + 1e-5))

    def test_velocities_beside_the_bodies(self):
        beside = self.write("a.yaml", f"agent: {AGENT.replace('{', '{velocity: [1, 0, 0], ', 1)}\nobstacle: "
                                      f"{BODIES['axes'].replace('{', '{velocity: [0, 1, 0], ', 1)}\n")
        apart = self.write("b.yaml", f"agent: {AGENT}\nobstacle: {BODIES['axes']}\n"
                                     "agent_velocity: [1, 0, 0]\nobstacle_velocity: [0, 1, 0]\n")
        first, second = (json.loads(run("cone", scene, "--json").stdout) for scene in (beside, apart))
        first.pop("seconds"), second.pop("seconds")
        self.assertEqual(first, second)

    def test_a_file_that_is_moved(self):
        self.write("body.yaml", "{center: [1, 2, 3], semi_axes: [3, 2, 1], rotation: [0.8, 0, 0, 0.6]}")
        moved = self.case("{file: body.yaml, center: [8, 0, 0], rotation: [0.6, 0.8, 0, 0]}")
        # (0.6, 0.8 i)(0.8, 0.6 k) = 0.48 + 0.64 i - 0.48 j + 0.36 k; (1, 2, 3) turns by 106.26 degrees about x.
        cosine, sine = 0.6 ** 2 - 0.8 ** 2, 2 * 0.6 * 0.8
        place = [9, 2 * cosine - 3 * sine, 2 * sine + 3 * cosine]
        by_hand = self.case(f"{{center: {place}, semi_axes: [3, 2, 1], rotation: [0.48, 0.64, -0.48, 0.36]}}")
        self.assertAlmostEqual(moved["clearance"], by_hand["clearance"], delta=1e-12)

    def test_files_in_other_folders(self):
        os.mkdir(self.path("parts"))
        self.write("parts/box.off", "OFF 4 4 0\n8 0 0\n9 0 0\n8 1 0\n8 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n")
        self.write("parts/box.yaml", "mesh: box.off\n")
        self.write("again.yaml", "file: parts/box.yaml\n")
        for body in ("{file: parts/box.yaml}", "{file: again.yaml}", "{mesh: parts/box.off}"):
            self.assertEqual(self.case(body)["time_to_contact"], self.case("{mesh: parts/box.off}")["time_to_contact"])

    def test_check_says_what_a_file_means(self):
        for name, said in (("planar.yaml", "cut by 1 hyperbola"), ("source-6.5.yaml", "exact: every verdict is right"),
                           ("biconcave.yaml", "certified: a verdict is right or undecided"),
                           ("window.yaml", "surface of 8 triangles"), ("scenarios/avoidance.yaml", "avoidance, true sector"),
                           ("bodies/elephant-pieces.yaml", "union of 4 ellipsoids")):
            done = run("check", os.path.join(SOURCE, "docs/examples", name))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(said, done.stdout)
        # 10 m between the centres, less 1 m and 2 m.
        scene = self.write("balls.yaml", "agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\n"
                                         "obstacle: {center: [10, 0, 0], semi_axes: [2, 2, 2], velocity: [0, -3, 4]}\n")
        text = run("check", scene).stdout
        self.assertIn("now                 7 m apart", text)
        self.assertIn("moves at 5 m/s, azimuth -90, elevation 53.13 degrees", text)
        done = run("check", self.write("bad.yaml", "agent: {center: [0, 0, 0], semi_axes: [1, 0, 1]}\nobstacle: {}\n"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("agent.semi_axes[1]: got 0", done.stderr)

    def test_what_is_refused(self):
        self.write("loop.yaml", "file: loop.yaml\n")
        self.write("moved.yaml", "{file: moved.yaml, center: [0, 0, 1]}\n")
        self.write("scene.yaml", f"agent: {AGENT}\n")
        self.write("flat.yaml", "{center: [8, 0], semi_axes: [1, 2]}")
        self.write("q.yaml", BODIES["quadric"])
        for body, said in (
                ("{file: missing.yaml}", "obstacle.file: got missing.yaml"),
                ("{file: loop.yaml}", "names 8 others"),
                ("{file: moved.yaml}", "names 8 others"),
                ("{file: moved.yaml, center: [1, 0, 0]}", "names 8 others"),
                ("{file: scene.yaml}", "obstacle.file: got scene.yaml, a scene, must be a file with a body"),
                ("{file: q.yaml, center: [1, 0, 0]}", "obstacle.center: got [1.0,0.0,0.0], must be left out"),
                ("{file: q.yaml, radius: 1}", "obstacle.radius: got an unknown field"),
                ("{pieces: []}", "obstacle.pieces: got [], must be a list of bodies"),
                ("{pieces: [{points: [[0, 0, 0]]}, {center: [0, 0, 0], semi_axes: [1, 1, 1], "
                 "hyperboloids: [{sheets: 2, semi_axes: [0.5, 1, 1]}]}]}", "obstacle.pieces[1]")):
            with self.subTest(body):
                scene = self.write("bad.yaml", f"agent: {AGENT}\nobstacle: {body}\n")
                done = run("cone", scene)
                self.assertEqual(done.returncode, 2)
                self.assertIn(said, done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)

    def test_files_of_another_kind(self):
        """Each command says what it was given, and who reads that."""
        kinds = {"scene": ("a scene", "vericone cone reads scenes", f"{{agent: {AGENT}, obstacle: {AGENT}}}"),
                 "scenario": ("a scenario", "vericone simulate reads scenarios", f"bodies: [{AGENT}]"),
                 "pursuit": ("a pursuit", "vericone pursue reads pursuits", "{uas: {}, cars: [], cameras: {}}"),
                 "paper": ("figures or claims of a paper", "--paper", "claims: []"),
                 "body": ("a body", "{file: NAME}", AGENT)}
        names = {kind: name for kind, (name, _, _) in kinds.items()} | {"cases": "a file of cases, one JSON object a line"}
        readers = {"cone": "scene", "simulate": "scenario", "reach": "scenario", "trials": "scenario",
                   "query": "cases", "law": "cases"}
        programs = os.environ.get("VERICONE_PROGRAMS", "").split()
        readers |= {name: kind for name, kind in (("scan", "scene"), ("pursue", "pursuit")) if name in programs}
        for command, wanted in readers.items():
            for kind, (name, reader, text) in kinds.items():
                with self.subTest(command=command, given=kind):
                    done = run(command, self.write("given.yaml", text))
                    said = re.match(r"vericone: \S*given.yaml: got (.*), must be (.*); (.*)\n$", done.stderr)
                    if kind == wanted:
                        self.assertIsNone(said, done.stderr)
                    else:
                        self.assertEqual(done.returncode, 2)
                        self.assertIsNotNone(said, done.stderr)
                        self.assertEqual(said.group(1, 2), (name, names[wanted]), done.stderr)
                        self.assertIn(reader, said.group(3))
        # Written over several lines, as JSON too; a line that begins as a case is one.
        for text, said in (("agent:\n  semi_axes: [1, 1, 1]\n", "got a scene, must be"),
                           ('{\n  "bodies": []\n}\n', "got a scenario, must be"),
                           ('{"agent": {},}\n', "")):
            done = run("query", self.write("given.yaml", text))
            self.assertIn(said, done.stderr)
            self.assertEqual("line 1" in done.stdout, not said, done.stdout)
        self.assertIn("uas.position: got nothing" if "pursue" in programs else "got a command without a camera",
                      run("check", self.write("given.yaml", kinds["pursuit"][2])).stderr)


if __name__ == "__main__":
    unittest.main()
