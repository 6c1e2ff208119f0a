# SPDX-License-Identifier: BSD-3-Clause
"""`vericone cone --glb` and `simulate --glb`: the files against the specification (glb_file.py, and Khronos' validator
where it is installed), what they show against the bodies, the cone and the run. Environment as for command.py."""
import csv
import json
import math
import os
import sys
import tempfile
import unittest

sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)), os.path.dirname(os.path.dirname(os.path.abspath(__file__)))]
import glb_file  # noqa: E402
from command import SOURCE, query, run  # noqa: E402
from glb_file import Glb, volume  # noqa: E402

BALL = "{center: [20, 0, 0], semi_axes: [1, 1, 1]}"
# Kind: fields, volume of what is drawn, how much of it may be lost to chords.
BODIES = {
    "ellipsoid": ("{center: [1, 2, 3], semi_axes: [3, 2, 1], rotation: [0.8, 0, 0.6, 0]}", 8 * math.pi, 0.03),
    "waisted": ("{center: [0, 0, 0], semi_axes: [3, 2, 1], hyperboloids: [{sheets: 1, semi_axes: [2, 0.7, 0.6]}]}", None, 0),
    "hull": ("{points: [[0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 4], [0.2, 0.2, 0.2]]}", 4, 1e-6),
    "box": ("{box: {half_widths: [1, 2, 3]}, center: [5, 5, 5]}", 48, 1e-6),
    "cylinder": ("{cylinder: {radius: 2, height: 3}}", 12 * math.pi, 0.01),
    "capsule": ("{capsule: {radius: 1, length: 3}}", math.pi * 13 / 3, 0.02),
    "cone": ("{cone: {radius: 1, height: 3}}", math.pi, 0.02),
    "margin": ("{box: {half_widths: [1, 1, 1]}, margin: 0.5}", 8 + 12 + 3 * math.pi / 2 + math.pi / 6, 0.02),
    "union": ("{pieces: [{center: [0, 0, 0], semi_axes: [1, 1, 1]}, {center: [5, 0, 0], semi_axes: [1, 1, 1]}]}",
              8 * math.pi / 3, 0.03),
    "hulls": ("{pieces: [{points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}, {points: [[3, 0, 0], [4, 0, 0], [3, 1, 0], "
              "[3, 0, 1]]}]}", 1 / 3, 1e-6),
    "rounds": ("{pieces: [{cylinder: {radius: 1, height: 1}}, {center: [5, 0, 0], semi_axes: [1, 1, 1]}]}",
               math.pi * 7 / 3, 0.02),
}


class WritesGlb(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def of_scene(self, text, *options):
        scene, file = os.path.join(self.folder, "scene.yaml"), os.path.join(self.folder, "scene.glb")
        with open(scene, "w", encoding="utf-8") as f:
            f.write(text)
        done = run("cone", scene, "--glb", file, *options)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(file, "rb") as f:
            return f.read()

    def test_bodies_of_all_kinds_are_as_large_as_they_are(self):
        for kind, (fields, size, lost) in BODIES.items():
            with self.subTest(kind=kind):
                glb = Glb(self.of_scene(f"agent: {BALL}\nobstacle: {fields}\n"))
                points, triangles = glb.mesh("obstacle")
                drawn = volume(points, triangles)
                self.assertGreater(drawn, 0)
                if size:
                    self.assertLessEqual(drawn, size * (1 + 1e-5))
                    self.assertGreaterEqual(drawn, size * (1 - lost))
                edges = [(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)]
                self.assertEqual(sorted(edges), sorted((b, a) for a, b in edges))  # closed

    def test_files_of_pieces(self):
        mesh, cloud = os.path.join(self.folder, "m.obj"), os.path.join(self.folder, "c.xyz")
        with open(mesh, "w", encoding="utf-8") as f:
            f.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        with open(cloud, "w", encoding="utf-8") as f:
            f.write("0 0 0\n3 0 0\n")
        glb = Glb(self.of_scene(f"agent: {BALL}\nobstacle: {{mesh: {mesh}, scale: 2}}\n"))
        self.assertAlmostEqual(volume(*glb.mesh("obstacle")), 8 / 6, places=6)
        glb = Glb(self.of_scene(f"agent: {BALL}\nobstacle: {{cloud: {cloud}, radius: 0.5}}\n"))
        self.assertAlmostEqual(volume(*glb.mesh("obstacle")), math.pi / 3, delta=0.03)
        glb = Glb(self.of_scene(f"agent: {BALL}\nobstacle: {{cloud: {cloud}, radius: 0}}\n"))
        points, triangles = glb.mesh("obstacle")
        self.assertEqual((sorted(points), triangles), ([[0, 0, 0], [3, 0, 0]], []))

    def test_points_of_an_ellipsoid_lie_on_it(self):
        glb = Glb(self.of_scene("agent: {center: [1e6, 2, -3], semi_axes: [3, 2, 1]}\nobstacle: " + BALL))
        node = glb.json["nodes"][glb.node("agent")]
        self.assertEqual(node["translation"], [1e6, 2, -3])
        points, _ = glb.mesh("agent")
        self.assertGreater(len(points), 300)
        for x, y, z in points:
            self.assertAlmostEqual(((x - 1e6) / 3) ** 2 + ((y - 2) / 2) ** 2 + (z + 3) ** 2, 1, places=5)

    def test_the_cone_is_that_of_the_verdicts(self):
        agent = {"center": [0, 0, 0], "semi_axes": [1, 0.5, 0.5]}
        obstacle = {"cylinder": {"radius": 2, "height": 3}, "center": [9, 2, 1], "rotation": [0.8, 0.6, 0, 0]}
        glb = Glb(self.of_scene(json.dumps({"agent": agent, "obstacle": obstacle, "agent_velocity": [1, 0, 0]})))
        points, triangles = glb.mesh("cone")
        self.assertEqual((len(points), len(triangles), points[0]), (73, 72, [0, 0, 0]))
        sight = [9, 2, 1]
        cases = []
        for x in points[1:]:
            for share in (0.99, 1.01):  # of the way from the line of sight
                cases.append({"id": len(cases), "agent": agent, "obstacle": obstacle,
                              "agent_velocity": [s + share * (a - s) for s, a in zip(sight, x)], "obstacle_velocity": [0, 0, 0]})
        result, answers = query(*cases)
        self.assertEqual(result.returncode, 0)
        self.assertEqual([a["verdict"] for a in answers], ["in", "out"] * 72)
        line, _ = glb.mesh("relative velocity")
        self.assertAlmostEqual(math.dist(line[1], [math.hypot(*sight), 0, 0]), 0, places=5)

    def test_what_is_proved_stands_in_the_extras(self):
        glb = Glb(self.of_scene(f"agent: {BALL}\nobstacle: {BODIES['cylinder'][0]}\nagent_velocity: [-1, 0, 0]\n"))
        says = glb.json["asset"]["extras"]["vericone"]
        self.assertEqual((says["what"], says["answer"]["verdict"]), ("scene", "in"))
        self.assertIn("cylinder", glb.json["nodes"][glb.node("obstacle")]["extras"]["is"])
        overlapping = Glb(self.of_scene(f"agent: {BALL}\nobstacle: {BALL}\n"))
        self.assertNotIn("cone", [node["name"] for node in overlapping.json["nodes"]])

    def test_planar_scenes_are_flat(self):
        glb = Glb(self.of_scene("agent: {center: [0, 0], semi_axes: [1, 1]}\nobstacle: {center: [4, 3], semi_axes: [2, 1], "
                                "rotation: 0.5, hyperbolas: [{semi_axes: [0.5, 1]}]}\nagent_velocity: [1, 1]\n"))
        for name in ("agent", "obstacle", "cone"):
            points, triangles = glb.mesh(name)
            self.assertTrue(triangles and all(z == 0 for _, _, z in points), name)

    def test_the_same_scene_gives_the_same_bytes(self):
        text = f"agent: {BALL}\nobstacle: {BODIES['rounds'][0]}\n"
        self.assertEqual(self.of_scene(text), self.of_scene(text, "--json"))

    def simulated(self, path):
        out = os.path.join(self.folder, "run")
        done = run("simulate", path, "--glb", "--no-figures", "--quiet", "--out", out)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(os.path.join(out, "simulation.glb"), "rb") as f:
            return Glb(f.read()), out

    def test_runs_move_as_their_tables_say(self):
        glb, out = self.simulated(os.path.join(SOURCE, "docs/examples/scenarios/avoidance.yaml"))
        rows = {}
        with open(os.path.join(out, "bodies.csv"), encoding="utf-8") as f:
            for row in csv.DictReader(f):
                rows.setdefault(row["body"], []).append({k.split("[")[0].strip(): v for k, v in row.items()})
        keys = [k for k in rows["A"][0] if k in ("x", "y", "z", "t") or k.split(" ")[0] in ("x", "y", "z", "t")]
        self.assertEqual(len(keys), 4)
        for body, way in rows.items():
            samples = glb.track(body, "translation")
            self.assertGreater(len(samples), 1)
            at = {round(float(row["t"] if "t" in row else row[keys[0]]), 9): row for row in way}
            met = 0
            for t, place in samples:
                # Between two rows the way is nearly straight; at the ends it is the row.
                times = sorted(at)
                before = max((x for x in times if x <= t + 1e-6), default=times[0])
                after = min((x for x in times if x >= t - 1e-6), default=times[-1])
                share = 0 if after == before else (t - before) / (after - before)
                for k, axis in enumerate("xyz"):
                    low, high = float(at[before][axis]), float(at[after][axis])
                    self.assertAlmostEqual(place[k], low + share * (high - low), delta=2e-3)
                met += 1
            self.assertEqual(met, len(samples))
        proof = glb.json["asset"]["extras"]["vericone"]["proof"]
        self.assertEqual(proof["verdict"], "avoided")
        self.assertTrue(glb.track("A", "rotation"))

    def test_planar_runs(self):
        glb, _ = self.simulated(os.path.join(SOURCE, "docs/examples/scenarios/four-aircraft.yaml"))
        points, _ = glb.mesh("south")
        middle = glb.json["nodes"][glb.node("south")]["translation"]
        self.assertAlmostEqual(max(math.dist(p, middle) for p in points), 4630, delta=0.01)

    def test_what_cannot_be_written_is_said(self):
        scene = os.path.join(SOURCE, "docs/examples/first.yaml")
        done = run("cone", scene, "--glb", os.path.join(self.folder, "none/scene.glb"))
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("none/scene.glb", done.stderr)
        done = run("cone", "--cases", scene, "--glb", "x.glb")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--glb", done.stderr)

    def test_bodies_and_fits_alone(self):
        file = os.path.join(self.folder, "body.glb")

        def checked(fields):
            path = os.path.join(self.folder, "body.yaml")
            with open(path, "w", encoding="utf-8") as f:
                f.write(fields)
            return run("check", path, "--glb", file)

        fit = {"file": "scan.ply", "mode": "containing", "certified": True, "seconds": 3,
               "pieces": [{"body": {"center": [0, 0, 0], "semi_axes": [1, 1, 1]}}]}
        for fields, size in ((BODIES["box"][0], 48), (json.dumps(fit), 4 * math.pi / 3)):
            done = checked(fields)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            with open(file, "rb") as f:
                glb = Glb(f.read())
            self.assertAlmostEqual(volume(*glb.mesh("body")) / size, 1, delta=0.03)
        self.assertEqual(glb.json["asset"]["extras"]["vericone"],
                         {"what": "body", "fit": {"file": "scan.ply", "mode": "containing", "certified": True}})
        scene = run("check", os.path.join(SOURCE, "docs/examples/first.yaml"), "--glb", file)
        self.assertEqual(scene.returncode, 2)
        self.assertIn("--glb", scene.stderr)

    def test_the_checker_sees_mistakes(self):
        data = self.of_scene(f"agent: {BALL}\nobstacle: {BODIES['box'][0]}\n")
        glb = Glb(data)

        def damaged(change):
            copy = json.loads(json.dumps(glb.json))
            change(copy)
            text = json.dumps(copy).encode()
            text += b" " * (-len(text) % 4)
            head = b"glTF" + (2).to_bytes(4, "little") + (28 + len(text) + len(glb.buffer)).to_bytes(4, "little")
            return (head + len(text).to_bytes(4, "little") + b"JSON" + text + len(glb.buffer).to_bytes(4, "little")
                    + b"BIN\0" + glb.buffer)

        Glb(damaged(lambda file: None))
        for change in (lambda file: file["accessors"][0]["min"].__setitem__(0, -9),
                       lambda file: file["accessors"][0].__setitem__("count", 10 ** 6),
                       lambda file: file["bufferViews"][1].__setitem__("byteOffset", 3),
                       lambda file: file["nodes"][1].__setitem__("rotation", [1, 1, 0, 0]),
                       lambda file: file["nodes"][0]["children"].append(1),
                       lambda file: file["meshes"][0]["primitives"][0].__setitem__("indices", 0)):
            with self.assertRaises((glb_file.Wrong, Exception)):
                Glb(damaged(change))

    def test_khronos_validator_accepts_all(self):
        issues = glb_file.validator()
        if not issues:
            self.skipTest("no glTF-Validator (VERICONE_GLTF_VALIDATOR names its folder)")
        files = []
        for kind, (fields, _, _) in BODIES.items():
            files.append((kind, self.of_scene(f"agent: {BALL}\nobstacle: {fields}\nagent_velocity: [-1, 0, 0]\n")))
        for name in ("avoidance", "four-aircraft", "union"):
            _, out = self.simulated(os.path.join(SOURCE, f"docs/examples/scenarios/{name}.yaml"))
            with open(os.path.join(out, "simulation.glb"), "rb") as f:
                files.append((name, f.read()))
            os.rename(out, out + name)
        for name, data in files:
            path = os.path.join(self.folder, "one.glb")
            with open(path, "wb") as f:
                f.write(data)
            found = issues(path)
            self.assertEqual((found["numErrors"], found["numWarnings"], found["messages"]), (0, 0, []), name)


if __name__ == "__main__":
    unittest.main()
