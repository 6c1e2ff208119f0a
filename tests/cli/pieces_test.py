# SPDX-License-Identifier: BSD-3-Clause
"""Meshes, clouds, octree maps and convex hulls in the command: small files written here, answers in closed form.
Environment as for command.py; VERICONE_DATA_DIR names a folder of real scans, by default ../shared/data beside the
project."""
import json
import math
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from command import SOURCE, ball, engagement, query, run  # noqa: E402

DATA = os.environ.get("VERICONE_DATA_DIR", os.path.join(SOURCE, "..", "shared", "data"))
CORNERS = [[x, y, z] for x in (4, 6) for y in (-1, 1) for z in (-1, 1)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def write(folder, name, content):
    path = os.path.join(folder, name)
    with open(path, "wb") as f:
        f.write(content if isinstance(content, bytes) else content.encode())
    return path


def obj(points, faces):
    return ("".join("v %r %r %r\n" % tuple(map(float, p)) for p in points) +
            "".join("f %s\n" % " ".join(str(i + 1) for i in f) for f in faces))


def map_of_two_cells(last=0x06):
    """An octree map, cells of 1 m: [0, 1]^3 occupied, the next one along x free (0x0A: occupied), nothing else known."""
    inner = [(0x00, 0xC0)] + 14 * [(0x03, 0x00)] + [(last, 0x00)]
    head = "# Octomap OcTree binary file\nid OcTree\nsize %d\nres 1\ndata\n" % (len(inner) + 2)
    return head.encode() + bytes(b for pair in inner for b in pair)


def framed_window():
    """A wall in the plane x = 5, 20 m wide, with a square window of 4 m in its middle."""
    outer = [[5, y, z] for y, z in ((-10, -10), (10, -10), (10, 10), (-10, 10))]
    hole = [[5, y, z] for y, z in ((-2, -2), (2, -2), (2, 2), (-2, 2))]
    return obj(outer + hole, [(i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i) for i in range(4)])


class Pieces(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp()
        self.mesh = write(self.folder, "cube.obj", obj(CORNERS, SIDES))
        self.map = write(self.folder, "two.bt", map_of_two_cells())

    def cone(self, scene, *arguments, text=False):
        path = write(self.folder, "scene.yaml", json.dumps(scene))
        result = run("cone", path, *([] if text else ["--json"]), *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout if text else json.loads(result.stdout)

    def assert_time(self, answer, truth):
        self.assertAlmostEqual(answer["time_to_contact"], truth, 9)
        low, high = answer["time_enclosure"]
        self.assertLessEqual(low, truth + 1e-12)
        self.assertGreaterEqual(high, truth - 1e-12)
        self.assertLess(high - low, 1e-8)

    def bodies(self):
        return {"points": {"points": CORNERS}, "hull": {"hull": self.mesh}, "mesh": {"mesh": self.mesh}}

    def test_a_cube_in_closed_form(self):
        for kind, cube in self.bodies().items():
            with self.subTest(kind):
                result, answers = query(
                    engagement(ball([0, 0, 0], 1), cube, [2, 0, 0]),
                    engagement(ball([0, 2, 0], 1), cube, [1, 0, 0]),
                    engagement(ball([0, math.nextafter(2, 3), 0], 1), cube, [1, 0, 0]),
                    engagement(ball([0, math.nextafter(2, 1), 0], 1), cube, [1, 0, 0]),
                    engagement(ball([0, 2.5, 0], 1), cube, [1, 0, 0]),
                    engagement(ball([0, 0, 0], 1), cube, [-1, 0, 0]),
                    engagement(ball([0, 0, 0], 1), cube, [0, 0, 0]),
                    engagement(ball([3, 0, 0], 1), cube, [1, 0, 0]),
                    engagement(ball([3.5, 0, 0], 1), cube, [1, 0, 0]))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual([a.get("verdict", a) for a in answers],
                                 ["in", "on", "out", "in", "out", "out", "out", "touching", "overlapping"])
                self.assert_time(answers[0], 1.5)
                self.assertEqual([round(x, 9) for x in answers[0]["contact_normal"]], [1, 0, 0])
                self.assertAlmostEqual(answers[0]["contact_point"][0], 4, 9)
                self.assertIsNone(answers[0]["clearance"])
                self.assertEqual(answers[1]["clearance"], 0)
                for answer, truth in zip(answers[4:7], (0.5, 3, 3)):
                    self.assertAlmostEqual(answer["clearance"], truth, 7)
                    low, high = answer["clearance_enclosure"]
                    self.assertLessEqual(low, truth + 1e-12)
                    self.assertGreaterEqual(high, truth - 1e-12)
                    self.assertIsNone(answer["time_to_contact"])
                self.assertEqual([a["time_to_contact"] for a in answers[7:]], [0, 0])
                self.assertEqual([a["clearance"] for a in answers[7:]], [0, None])

    def test_where_a_moving_body_is_met(self):
        # The ball chases a cube that moves away upwards: they meet at 4 + 3 vertically.
        _, (answer,) = query(engagement(ball([0, 0, 0], 1), {"points": CORNERS}, [1, 0, 1], [0, 0, 1]))
        self.assert_time(answer, 3)
        self.assertAlmostEqual(answer["contact_point"][0], 4, 9)
        self.assertGreaterEqual(answer["contact_point"][2], 3 - 1 - 1e-9)
        self.assertLessEqual(answer["contact_point"][2], 3 + 1 + 1e-9)

    def test_a_closed_mesh_is_its_surface(self):
        inside = ball([5, 0, 0], 0.25)
        _, (room, solid) = query(engagement(inside, {"mesh": self.mesh}, [1, 0, 0]),
                                 engagement(inside, {"hull": self.mesh}, [1, 0, 0]))
        self.assertEqual((room["verdict"], solid["verdict"]), ("in", "overlapping"))
        self.assert_time(room, 0.75)
        c = self.cone({"agent": inside, "obstacle": {"mesh": self.mesh}})
        self.assertEqual(c["half_planes_reaching_pi"], 64)
        self.assertAlmostEqual(c["envelope_solid_angle"], 4 * math.pi, 6)
        self.assertIn("surrounded          on all half-planes", self.cone({"agent": inside, "obstacle": {"mesh": self.mesh}}, text=True))

    def test_place_turn_and_scale(self):
        # x_world = center + R scale x: the cube is [8, 12] x [-2, 2]^2, then along y, then moved up by 1.
        turn = [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
        for kind, cube in self.bodies().items():
            with self.subTest(kind):
                moved = {**cube, "center": [0, 0, 1], "rotation": turn, "scale": 2}
                _, answers = query(engagement(ball([0, 0, 1], 1), moved, [0, 1, 0]),
                                   engagement(ball([0, 0, 5], 1), moved, [0, 1, 0]))
                self.assert_time(answers[0], 7)
                self.assertEqual(answers[1]["verdict"], "out")
                self.assertAlmostEqual(answers[1]["clearance"], 1, 7)

    def test_clouds_are_balls(self):
        cloud = write(self.folder, "points.xyz", "5 0 0\n5 0 3\n")
        _, answers = query(*(engagement(ball([0, y, 0], 1), {"cloud": cloud, "radius": 2}, [1, 0, 0])
                             for y in (0, 3, math.nextafter(3, 4))))
        self.assertEqual([a["verdict"] for a in answers], ["in", "on", "out"])
        self.assert_time(answers[0], 2)
        one = write(self.folder, "point.xyz", "5 0 0\n")
        half = math.asin(3 / 5)
        c = self.cone({"agent": ball([0, 0, 0], 1), "obstacle": {"cloud": one, "radius": 2}}, "--tolerance", "1e-7",
                      "--map", "0.05")
        self.assertEqual(len(c["extremes"]), 64)
        for x in c["extremes"]:
            self.assertLessEqual(x["low"], half + 1e-12)
            self.assertGreaterEqual(x["high"], half - 1e-12)
            self.assertLessEqual(x["high"] - x["low"], 1e-7)
        truth = 2 * math.pi * (1 - math.cos(half))
        self.assertAlmostEqual(c["envelope_solid_angle"], truth, 5)
        self.assertLessEqual(c["map"]["colliding"], truth)
        self.assertGreaterEqual(c["map"]["colliding"] + c["map"]["undecided"], truth)
        self.assertLess(c["map"]["undecided"], 0.3)
        self.assertEqual(c["obstacle"]["pieces"], 1)

    def test_numbers_that_were_not_found_are_absent(self):
        with tempfile.TemporaryDirectory() as folder:
            write(folder, "big.obj", obj([[-1e12, -1e12, 0], [1e12, -1e12, 0], [0, 1e12, 0]], [[0, 1, 2]]))
            mesh = {"mesh": os.path.join(folder, "big.obj")}
            result, (hit, fast) = query(
                engagement(ball([50, 50, 30], 1), mesh, [-5, -5, -3]),
                engagement(ball([50, 50, 30], 1), mesh, [0, 0, -1.7e308], [0, 0, 1.7e308]))
        self.assertEqual(hit["verdict"], "in")
        low, high = hit["time_enclosure"]
        time = (30 - 1) / 3
        self.assertLessEqual(low, time)
        if hit["time_to_contact"] is None:
            self.assertIsNone(hit["contact_normal"])
        else:
            self.assertAlmostEqual(hit["time_to_contact"], time, 6)
            self.assertAlmostEqual(hit["contact_normal"][2], -1, 6)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(fast["error"], "agent_velocity[2]: got -1.7e+308, "
                         "must be at most 1.8e308 from the obstacle's, 1.7e+308")

    def test_octree_maps(self):
        agent = ball([-3, 0.5, 0.5], 0.25)
        around = {"octree": self.map, "region": [[-1, 0, 0], [2, 1, 1]]}
        _, answers = query(engagement(agent, {"octree": self.map}, [1, 0, 0]),
                           engagement(agent, around, [1, 0, 0]),
                           engagement(agent, {**around, "unknown": "free"}, [1, 0, 0]),
                           engagement(ball([5, 0.5, 0.5], 0.25), {"octree": self.map}, [-1, 0, 0]),
                           engagement(ball([5, 0.5, 0.5], 0.25), {"octree": self.map, "free": "occupied"}, [-1, 0, 0]),
                           engagement(agent, {"octree": self.map, "scale": 0.5, "center": [0, 0.25, 0.25]}, [1, 0, 0]))
        for answer, truth in zip(answers, (2.75, 1.75, 2.75, 3.75, 2.75, 2.75)):
            self.assert_time(answer, truth)

    def test_maps_say_what_unknown_space_counts_for(self):
        block = write(self.folder, "block.bt", map_of_two_cells(0x0A))
        agent = ball([-3, 0.5, 0.5], 0.25)
        for octree, unknown, word in ((self.map, {}, "unknown space of the map counts as occupied"),
                                      (block, {}, "the map has no free cells"), (block, {"unknown": "free"}, None)):
            scene = {"agent": agent, "obstacle": {"octree": octree, **unknown}, "agent_velocity": [1, 0, 0]}
            text = self.cone(scene, "--planes", "4", text=True)
            notes = self.cone(scene, "--planes", "4")["obstacle"]["notes"]
            path = write(self.folder, "scene.yaml", json.dumps(scene))
            checked = run("check", path).stdout
            body = run("check", write(self.folder, "body.yaml", json.dumps(scene["obstacle"]))).stdout
            scenario = {"bodies": [{"name": "A", **agent, "velocity": [1, 0, 0]}, {"name": "B", **scene["obstacle"]}]}
            flown = run("check", write(self.folder, "scenario.yaml", json.dumps(scenario)))
            self.assertEqual(flown.returncode, 0, flown.stderr)
            for told in (text, checked, body, flown.stdout, "\n".join(notes)):
                self.assertEqual("unknown space" in told, word is not None, told)
                self.assertIn(word or "", told)

    def test_polyhedral_agents(self):
        cube = {"points": [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]}
        small = write(self.folder, "small.off", "OFF\n4 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n")
        _, answers = query(engagement({**cube, "center": [0, 0.1, 0.05]}, {"mesh": self.mesh}, [1, 0, 0]),
                           engagement({**cube, "center": [0, 2, 0]}, {"mesh": self.mesh}, [1, 0, 0]),
                           engagement({"hull": small, "scale": 2, "center": [0, 0.3, 0.1]}, {"mesh": self.mesh}, [1, 0, 0]))
        self.assertEqual([a["verdict"] for a in answers], ["in", "on", "in"])
        self.assert_time(answers[0], 3)
        self.assert_time(answers[2], 2)
        c = self.cone({"agent": cube, "obstacle": {"mesh": self.mesh}}, "--planes", "8")
        self.assertEqual(len(c["extremes"]), 8)
        # The sum of the cubes, [3, 7] x [-2, 2]^2, seen from its outside, spans atan(2/3) to atan(2 sqrt(2)/3).
        for x in c["extremes"]:
            self.assertGreaterEqual(x["high"], math.atan(2 / 3) - 1e-9)
            self.assertLessEqual(x["low"], math.atan(2 * math.sqrt(2) / 3) + 1e-9)

    def test_the_orifice_cone_of_a_window(self):
        window = write(self.folder, "window.obj", framed_window())
        c = self.cone({"agent": ball([0, 0, 0], 1), "obstacle": {"mesh": window}}, "--map", "0.02", "--around", "1,0,0")
        # Through the window: at most this from x along y and along z, each by itself; a square pyramid.
        a = math.tan(math.atan(2 / 5) - math.asin(1 / math.sqrt(29)))
        truth = 4 * math.asin(a * a / (1 + a * a))
        region = c["map"]["around"]
        self.assertEqual((region["label"], region["surely_separate"]), ("safe", True))
        self.assertLessEqual(region["solid_angle"], truth)
        self.assertGreaterEqual(region["most_solid_angle"], truth)
        self.assertGreater(region["solid_angle"], 0.6 * truth)
        self.assertGreater(c["envelope_solid_angle"], 3 * truth)  # its hole is not taken off
        text = self.cone({"agent": ball([0, 0, 0], 1), "obstacle": {"mesh": window}}, "--map", "0.1", "--around=1,0,0",
                         text=True)
        self.assertIn("cone map            colliding ", text)

    def test_maps_of_ellipsoids_and_combined_bodies(self):
        truth = 2 * math.pi * (1 - math.cos(math.asin(3 / 5)))
        c = self.cone({"agent": ball([0, 0, 0], 1), "obstacle": ball([5, 0, 0], 2)}, "--map")["map"]
        self.assertEqual(c["resolution"], 0.02)
        self.assertLessEqual(c["colliding"], truth)
        self.assertGreaterEqual(c["colliding"] + c["undecided"], truth)
        self.assertAlmostEqual(c["colliding"] + c["undecided"] + c["safe"], 4 * math.pi, 9)
        self.assertLess(c["undecided"], 0.1)
        scene = {"agent": ball([0, 0, 0], 0.25), "obstacle": {
            "center": [8, 0, 0], "semi_axes": [2, 3, 3], "hyperboloids": [{"sheets": 2, "semi_axes": [0.5, 1, 1]}]}}
        c = self.cone(scene, "--map", "0.05")
        self.assertLessEqual(c["map"]["colliding"], c["outer"]["solid_angle"])
        self.assertGreaterEqual(c["map"]["colliding"] + c["map"]["undecided"], c["inner"]["solid_angle"])

    def test_slices_of_a_mesh(self):
        scene = {"agent": ball([0, 0, 0], 1), "obstacle": {"mesh": self.mesh}}
        c = self.cone(scene, "--method", "slice", "--planes", "2")
        corner = math.atan(1 / 4) + math.asin(1 / math.sqrt(17))
        self.assertEqual(c["planes_without_answer"], 0)
        for s in c["sectors"]:
            self.assertAlmostEqual(s["psi"], 2 * corner, 9)  # the planes of the sides of the square
        fine = self.cone(scene, "--method", "slice", "--planes", "200")
        true = self.cone(scene, "--planes", "400")
        self.assertLess(fine["solid_angle"], true["envelope_solid_angle"])
        self.assertIn("slice, 36 planes", self.cone(scene, "--method", "slice", text=True))

    def test_answers_as_text(self):
        scene = {"agent": ball([0, 0, 0], 1), "obstacle": {"mesh": "cube.obj"}, "agent_velocity": [1, 0, 0]}
        text = self.cone(scene, text=True)  # the file is beside the scene
        self.assertIn("obstacle            mesh of 12 triangles (cube.obj)", text)
        self.assertIn("verdict             in (of the scene's velocities, exact)", text)
        self.assertIn("first contact       after ", text)
        overlapping = self.cone({**scene, "agent": ball([4, 0, 0], 1)})
        self.assertEqual((overlapping["relation"], overlapping["extremes"]), ("overlapping", None))

    def test_rung(self):
        case = engagement(ball([0, 2, 0], 1), {"points": CORNERS}, [1, 0, 0])
        answer = json.loads(run("query", "--rung", "-", input=json.dumps(case) + "\n").stdout)
        self.assertEqual((answer["verdict"], answer["rung"]), ("on", "exact"))

    def test_many_lines_with_one_file(self):
        cases = [engagement(ball([0, 2, 0], 1), {"mesh": self.mesh}, [1, 0, 0], id=i) for i in range(2000)]
        _, answers = query(*cases)
        self.assertEqual({a["verdict"] for a in answers}, {"on"})

    def test_cases_beside_their_files(self):
        path = write(self.folder, "cases.jsonl", json.dumps(
            engagement(ball([0, 0, 0], 1), {"mesh": "cube.obj"}, [1, 0, 0])) + "\n")
        self.assertEqual(json.loads(run("query", path).stdout)["verdict"], "in")

    def test_pictures(self):
        scenes = {"outside": {"agent": ball([0, 0, 0], 1), "obstacle": {"mesh": self.mesh}, "agent_velocity": [1, 0, 0]},
                  "inside": {"agent": ball([5, 0, 0], 0.25), "obstacle": {"mesh": self.mesh}, "agent_velocity": [1, 0, 0]},
                  "map": {"agent": ball([-3, 0.5, 0.5], 0.25), "obstacle": {"octree": self.map}},
                  "hulls": {"agent": {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]},
                            "obstacle": {"points": CORNERS}}}
        for name, scene in scenes.items():
            with self.subTest(name):
                out = os.path.join(self.folder, name)
                # A map looks the same from all bodies but for a course in it.
                mapped = ["--map", "0.1"] if name in ("outside", "map") else []
                self.cone(scene, "--picture", out, *mapped, text=True)
                for picture in ("cone.png", "cone.pdf", *(["cone_map.png", "cone_map.pdf"] if mapped else [])):
                    with open(os.path.join(out, picture), "rb") as f:
                        self.assertIn(f.read(4), (b"%PDF", b"\x89PNG"))

    def test_gallery(self):
        write(self.folder, "junk.off", "OFF\n3 1 0\nnonsense")
        out = os.path.join(self.folder, "out")
        cloud = write(self.folder, "points.xyz", "5 0 0\n5 0 3\n6 1 1\n")
        result = run("gallery", self.mesh, os.path.join(self.folder, "junk.off"), cloud, self.map,
                     os.path.join(self.folder, "nowhere.obj"), "--no-figures", "--map", "0.2", "--out", out)
        self.assertEqual(result.returncode, 2)  # two files are bad
        self.assertIn("junk.off: ", result.stderr)
        with open(os.path.join(out, "gallery.json"), encoding="utf-8") as f:
            rows = json.load(f)["rows"]
        self.assertEqual(["error" in row for row in rows], [False, True, False, False, True])
        self.assertEqual(rows[0]["what"], "mesh of 12 triangles (cube.obj)")
        # Seen from 1.5 sizes off, a ball of a tenth of the size: within the cone of the ball around the cube.
        self.assertLess(rows[0]["cone"]["widest_degrees"],
                        math.degrees(math.asin((0.1 + math.sqrt(3) / 2) / 1.5)) + 0.01)
        with open(os.path.join(out, "gallery.md"), encoding="utf-8") as f:
            self.assertEqual(len(f.read().splitlines()), 2 + len(rows))
        with open(os.path.join(out, "cube-obj", "cone.json"), encoding="utf-8") as f:
            self.assertEqual(json.load(f)["relation"], "disjoint")


class Scan(unittest.TestCase):
    """Needs a command with LiDARs."""
    BEAMS = {"rows": 40, "columns": 40, "horizontal": 0.8, "vertical": 0.8}

    def scan(self, *arguments, **scene):
        folder = tempfile.mkdtemp()
        write(folder, "cube.obj", obj(CORNERS, SIDES))
        scene = {"agent": ball([0, 0.3, 0.2], 0.5), "obstacle": {"mesh": "cube.obj"}, "agent_velocity": [1, 0, 0],
                 "lidars": [{"position": [0, 0, 0.6], "towards": [1, 0, -0.1], "beams": self.BEAMS}], **scene}
        path = write(folder, "scene.yaml", json.dumps(scene))
        out = os.path.join(folder, "out")
        result = run("scan", path, "--out", out, "--levels", "2", *arguments)
        if "without LiDARs" in result.stderr:
            self.skipTest("this vericone was built without LiDARs")
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(os.path.join(out, "scan.json"), encoding="utf-8") as f:
            return json.load(f), out, result

    def points(self, out):
        with open(os.path.join(out, "cloud.ply"), encoding="utf-8") as f:
            lines = f.read().split("end_header\n")[1].splitlines()
        return [[float(x) for x in line.split()] for line in lines]

    def test_returns_are_on_the_mesh(self):
        scan, out, result = self.scan("--no-figures")
        points = self.points(out)
        self.assertEqual(len(points), scan["cloud"]["points"])
        self.assertGreater(len(points), 300)
        for x, y, z in points:
            self.assertAlmostEqual(max(abs(x - 5), abs(y), abs(z)), 1, 9)
            self.assertGreaterEqual(max(4 - x, z - 1), -1e-9)  # the face before the agent, or the upper one
        sectors = scan["sectors"]
        self.assertEqual(sectors["planes_without_answer"], 0)
        self.assertEqual(len(sectors["sectors"]), 36)
        self.assertLess(sectors["solid_angle"], scan["whole"]["cone"]["solid_angle"] * 1.02)
        self.assertGreater(sectors["solid_angle"], 0.5 * scan["whole"]["cone"]["solid_angle"])
        self.assertIn("cloud.ply", result.stdout)
        with open(os.path.join(out, "provenance.json"), encoding="utf-8") as f:
            self.assertIn("scan", json.load(f)["command"])

    def test_lidars_turn_with_the_agent(self):
        beams = {"elevations": [-0.2, -0.1, 0, 0.1, 0.2], "azimuths": 720}
        forwards = {"rows": 20, "columns": 20, "horizontal": 0.6, "vertical": 0.6}
        back = {"center": [0, 0, 0], "semi_axes": [0.5] * 3, "rotation": [0, 0, 0, 1]}  # half a turn about z
        around = self.scan("--no-figures", lidars=[{"beams": beams}])[0]
        self.assertGreater(around["cloud"]["points"], 100)
        seen = self.scan("--no-figures", agent=back, lidars=[{"beams": forwards, "towards": [-1, 0, 0]}])[0]
        self.assertGreater(seen["cloud"]["points"], 100)

    def test_the_seed_decides(self):
        noisy = [{"position": [0, 0, 0.6], "towards": [1, 0, -0.1], "beams": self.BEAMS, "range_noise": 0.01,
                  "dropout": 0.1}]
        one = self.points(self.scan("--no-figures", lidars=noisy)[1])
        self.assertEqual(one, self.points(self.scan("--no-figures", lidars=noisy)[1]))
        self.assertNotEqual(one, self.points(self.scan("--no-figures", "--seed", "2", lidars=noisy)[1]))

    def test_pictures(self):
        pictures = [line.split()[1] for line in self.scan()[2].stdout.splitlines() if line.startswith("picture")]
        self.assertEqual(sorted(os.path.basename(p) for p in pictures),
                         ["scan_convergence.pdf", "scan_convergence.png", "visible_section.pdf", "visible_section.png"])


class RealFiles(unittest.TestCase):
    def test_scans_and_maps(self):
        names = ["stanford-bunny.obj", "bun000.ply", "lamppost.pcd", "geb079.bt"]
        found = [os.path.join(DATA, n) for n in names if os.path.exists(os.path.join(DATA, n))]
        if not found:
            self.skipTest("no real scans in " + DATA)
        with tempfile.TemporaryDirectory() as folder:
            result = run("gallery", *found, "--no-figures", "--out", folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(os.path.join(folder, "gallery.json"), encoding="utf-8") as f:
                for row in json.load(f)["rows"]:
                    self.assertLessEqual(row["cone"]["map"]["colliding"], row["cone"]["envelope_solid_angle"] + 1e-3)
                    self.assertLess(row["cone"]["nodes_a_half_plane"], 0.05)


if __name__ == "__main__":
    unittest.main()
