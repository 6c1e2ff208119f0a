# SPDX-License-Identifier: BSD-3-Clause
"""vericone fit with capsules, cylinders, boxes and spheres: what is written is proved anew in rationals, from the
numbers of the bodies alone. Environment as for command.py."""
import json
import math
import os
import random
import subprocess
import sys
import unittest
from fractions import Fraction

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from command import SOURCE, query, run  # noqa: E402
from fit_test import CUBE, SIDES, Files, fit, peanut, rows, triangles_of  # noqa: E402
from pieces_test import obj  # noqa: E402

KINDS = ["sphere", "capsule", "cylinder", "box"]


def local(body, x):
    """rotation^-1 (x - center), by Cramer's rule in rationals."""
    r = [[Fraction(v) for v in row] for row in body["rotation"]]
    d = [Fraction(a) - Fraction(b) for a, b in zip(x, body["center"])]

    def det(m):
        return (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]))

    whole = det(r)
    return [det([[d[i] if j == k else r[i][j] for j in range(3)] for i in range(3)]) / whole for k in range(3)]


def holds(body, x):
    a, b, c = local(body, x)
    if "capsule" in body:
        radius, length = (Fraction(body["capsule"][f]) for f in ("radius", "length"))
        beyond = max(abs(c) - length / 2, 0)
        return a * a + b * b + beyond * beyond <= radius * radius
    if "cylinder" in body:
        radius, height = (Fraction(body["cylinder"][f]) for f in ("radius", "height"))
        return a * a + b * b <= radius * radius and abs(c) <= height / 2
    if "box" in body:
        return all(abs(y) <= Fraction(h) for y, h in zip((a, b, c), body["box"]["half_widths"]))
    return sum((y / Fraction(s)) ** 2 for y, s in zip((a, b, c), body["semi_axes"])) <= 1


def turned(points, q=(0.2, 0.5, -0.3, 0.79), by=(3, -2, 5)):
    """By a rotation about an odd axis."""
    n = math.sqrt(sum(c * c for c in q))
    w, x, y, z = (c / n for c in q)
    r = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return [[sum(r[i][k] * p[k] for k in range(3)) + by[i] for i in range(3)] for p in points]


def cylinder_points(radius, height, n=24):
    return [[radius * math.cos(2 * math.pi * k / n), radius * math.sin(2 * math.pi * k / n), z]
            for k in range(n) for z in (-height / 2, height / 2)]


def capsule_points(radius, length, n=300):
    source, points = random.Random(5), []
    for k in range(n):
        u = [source.gauss(0, 1) for _ in range(3)]
        size = math.sqrt(sum(c * c for c in u))
        end = length / 2 if k % 2 else -length / 2
        u[2] = abs(u[2]) if k % 2 else -abs(u[2])
        points.append([radius * u[0] / size, radius * u[1] / size, end + radius * u[2] / size])
    return points


def hand_written(body, points=8):
    """A fit.json that claims one body of the points of a mesh."""
    return json.dumps({"pieces": [{"quadrics": None, "body": body}], "certified": True, "coverage": 1.0, "margin": 0.0,
                       "certificate": {"points": points, "points_inside": points, "triangles": 12,
                                       "triangles_inside": 12, "margins_inside": points}})


class FitSolids(Files):
    def assert_contains(self, result, points, triangles=()):
        bodies = [p["body"] for p in result["pieces"]]
        self.assertTrue(result["certified"])
        self.assertTrue(all(p["quadrics"] is None for p in result["pieces"]))
        where = [{k for k, body in enumerate(bodies) if holds(body, x)} for x in points]
        self.assertTrue(all(where))
        for t in triangles:  # convex: where the corners are
            self.assertTrue(set.intersection(*(where[i] for i in t)), t)

    def test_every_kind_contains_every_point_and_triangle_in_rationals(self):
        clouds = {"cube.obj": obj(CUBE, SIDES), "peanut.obj": obj(*peanut())}
        meshes = {"cube.obj": (CUBE, SIDES), "peanut.obj": peanut()}
        for name, text in clouds.items():
            points, faces = meshes[name]
            file = self.write(name, text)
            for kind in KINDS:
                with self.subTest(name=name, kind=kind):
                    result = fit(file, "--shape", kind)
                    self.assertEqual((result["shape"], result["pieces"][0]["kind"]), (kind, kind))
                    self.assert_contains(result, points, triangles_of(faces))
        far = turned(CUBE, by=(5e6, -3e6, 1e3))
        for kind in KINDS:
            self.assert_contains(fit(self.write("far.xyz", rows(far)), "--shape", kind), far)

    def test_corners_of_triangles_without_area_are_inside(self):
        points = [[0, 0, 0], [1, 0, 0.1], [0.2, 1, 0.1], [0.1, 0.3, 1], [5, 5, 5]]
        faces = [(0, 1, 2), (0, 1, 3), (0, 2, 3), (4, 4, 1)]
        file = self.write("lone.obj", obj(points, faces))
        for kind in KINDS:
            self.assert_contains(fit(file, "--shape", kind), points)
        long = [[8 + x, y, z] for x, y, z in CUBE]
        joined = self.write("joined.obj", obj(CUBE + long, list(SIDES) + [tuple(i + 8 for i in f) for f in SIDES] + [(0, 8, 8)]))
        self.assert_contains(fit(joined, "--kinds", "box,sphere", "--pieces", "2"), CUBE + long, [(0, 8, 8)])

    def test_least_bodies_are_found(self):
        cases = [("box", [[2 * x, 3 * y, z] for x, y, z in CUBE], 48),
                 ("cylinder", cylinder_points(2, 5), 20 * math.pi),
                 ("cylinder", cylinder_points(2, 0.3), 1.2 * math.pi), ("sphere", CUBE, 4 / 3 * math.pi * 3 ** 1.5)]
        for kind, points, volume in cases:
            result = fit(self.write("scan.xyz", rows(turned(points))), "--shape", kind)
            self.assertAlmostEqual(result["volume"] / volume, 1, delta=1e-6, msg=kind)
            self.assertLess(result["volume_error"], 1e-9 * volume)
        result = fit(self.write("scan.xyz", rows(turned(capsule_points(1, 4)))), "--shape", "capsule")
        self.assertLess(result["volume"], math.pi * (4 + 4 / 3) * 1.002)
        self.assertGreater(result["volume"], math.pi * (4 + 4 / 3) * 0.97)  # random points touch it nearly everywhere

    def test_kinds_take_the_smallest_for_each_piece(self):
        points = turned(cylinder_points(1, 6))
        file = self.write("scan.xyz", rows(points))
        of_each = {kind: fit(file, "--shape", kind)["volume"] for kind in KINDS}
        best = fit(file, "--kinds", ",".join(KINDS))
        self.assertEqual(best["shape"], "sphere,capsule,cylinder,box")
        self.assertEqual(best["pieces"][0]["kind"], min(of_each, key=of_each.get))
        self.assertLess(best["volume"], min(of_each.values()) * (1 + 1e-9))

    def test_pieces_follow_what_hangs_together(self):
        """A table: five boxes that touch nowhere are five boxes again, filled and not in sheets."""
        legs = [(0.1, 0.1, 1, x, y, -1.2) for x in (-1.5, 1.5) for y in (-1.5, 1.5)]
        points, faces = [], []
        for a, b, c, x, y, z in [*legs, (2, 2, 0.1, 0, 0, 0)]:
            faces += [tuple(len(points) + i for i in f) for f in SIDES]
            points += [[x + a * p[0], y + b * p[1], z + c * p[2]] for p in CUBE]
        points = turned(points)
        result = fit(self.write("table.obj", obj(points, faces)), "--kinds", "box,cylinder,ellipsoid", "--pieces", "5")
        self.assertEqual([p["kind"] for p in result["pieces"]], ["box"] * 5)
        volume = 4 * 0.08 + 3.2
        self.assertAlmostEqual(result["volume"] / volume, 1, delta=1e-4)
        self.assertAlmostEqual(result["scan_volume"] / volume, 1, delta=1e-9)
        self.assertLess(result["hull_distance"]["max"], 1e-6)
        self.assert_contains(result, points, triangles_of(faces))

    def test_overlapping_pieces_count_once(self):
        points, faces = [], []
        for shift in (-0.5, 0.5):  # two cubes, the middle third in both
            faces += [tuple(len(points) + i for i in f) for f in SIDES]
            points += [[x + shift, 0.3 * y, 0.2 * z] for x, y, z in CUBE]
        result = fit(self.write("two.obj", obj(turned(points), faces)), "--kinds", "box", "--pieces", "2")
        self.assertAlmostEqual(result["volume"], 3 * 0.6 * 0.4, delta=1e-3)
        self.assertLess(abs(result["volume"] - 3 * 0.6 * 0.4), 10 * result["volume_error"] + 1e-9)

    def test_margins_are_inside_too(self):
        file = self.write("cube.obj", obj(CUBE, SIDES))
        result = fit(file, "--shape", "box", "--margin", "0.25")
        self.assertAlmostEqual(result["volume"], 2.5 ** 3, delta=1e-9)
        for p in CUBE:
            for k in range(3):
                x = list(map(Fraction, p))
                x[k] += Fraction(1, 4) * (1 if p[k] > 0 else -1)
                self.assertTrue(holds(result["pieces"][0]["body"], x))

    def test_check_tells_a_number_in_its_last_place(self):
        mesh = self.write("cube.obj", obj(CUBE, SIDES))
        still = {"center": [0, 0, 0], "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}
        tall = self.write("tall.obj", obj([[3 * x, 4 * y, 2 * z] for x, y, z in CUBE], SIDES))
        less = lambda x: math.nextafter(x, 0)  # noqa: E731
        for scan, good, bad in (
                (mesh, {"box": {"half_widths": [1, 1, 1]}}, {"box": {"half_widths": [1, 1, less(1)]}}),
                (tall, {"cylinder": {"radius": 5, "height": 4}}, {"cylinder": {"radius": less(5), "height": 4}}),
                (tall, {"cylinder": {"radius": 5, "height": 4}}, {"cylinder": {"radius": 5, "height": less(4)}}),
                (tall, {"capsule": {"radius": 5, "length": 4}}, {"capsule": {"radius": less(5), "length": 4}}),
                (tall, {"capsule": {"radius": 5.5, "length": 0}}, {"capsule": {"radius": 5, "length": less(4)}}),
                (tall, {"semi_axes": [6, 8, 4]}, {"semi_axes": [4, 8, 4]})):
            result = self.write("fit.json", hand_written({**still, **good}))
            self.assertEqual(run("fit", scan, "--check", result).returncode, 0, good)
            result = self.write("fit.json", hand_written({**still, **bad}))
            answer = run("fit", scan, "--check", result)
            self.assertEqual(answer.returncode, 1, bad)
            self.assertIn("does NOT hold", answer.stdout)

    def test_written_bodies_are_read_by_scenes(self):
        """Every corner meets the body of each kind, also of a union of kinds."""
        points, faces = peanut()
        points = turned(points)
        file = self.write("peanut.obj", obj(points, faces))
        for arguments in (["--shape", "capsule"], ["--shape", "box"], ["--shape", "cylinder"], ["--shape", "sphere"],
                          ["--kinds", "ellipsoid,cylinder,box", "--pieces", "3"]):
            answer = run("fit", file, *arguments, "--quiet", "--no-figures", "--out", self.out)
            self.assertEqual(answer.returncode, 0, answer.stderr)
            self.assertIn("coverage            1, proved: no gap\nprotrusion          mean", answer.stdout)
            body = {"file": os.path.join(self.out, "body.yaml")}
            cases = [{"id": k, "agent": {"points": [x]}, "obstacle": body, "agent_velocity": [1, 0, 0],
                      "obstacle_velocity": [0, 0, 0]} for k, x in enumerate(points)]
            _, answers = query(*cases)
            self.assertEqual({a["verdict"] for a in answers}, {"overlapping"}, arguments)
            self.assertEqual(run("fit", file, "--check", os.path.join(self.out, "fit.json")).returncode, 0)

    def test_pictures_and_meshes_are_written(self):
        file = self.write("peanut.obj", obj(*peanut()))
        answer = run("fit", file, "--kinds", "capsule,box", "--pieces", "2", "--quiet", "--out", self.out)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        with open(os.path.join(self.out, "fit.png"), "rb") as f:
            self.assertEqual(f.read(8), b"\x89PNG\r\n\x1a\n")
        self.assertIn("g piece_1_quadric_0", self.read("hull.obj"))

    def test_certificates_are_accepted(self):
        points, faces = peanut()
        file = self.write("peanut.obj", obj(turned(points), faces))
        checker = [sys.executable, os.path.join(SOURCE, "checker", "vericone_check.py")]
        for kinds in ("box", "cylinder", "sphere", "cylinder,box,ellipsoid"):
            fit(file, "--kinds", kinds, "--pieces", "2", out=self.out)
            proof = os.path.join(self.folder, "proof.json")
            answer = run("fit", file, "--check", os.path.join(self.out, "fit.json"), "--certificate", proof)
            self.assertEqual(answer.returncode, 0, answer.stdout + answer.stderr)
            checked = subprocess.run([*checker, proof], capture_output=True, text=True, check=False)
            self.assertEqual(checked.returncode, 0, kinds + checked.stdout + checked.stderr)
        fit(file, "--shape", "capsule", out=self.out)
        answer = run("fit", file, "--check", os.path.join(self.out, "fit.json"), "--certificate", proof)
        self.assertIn("not written         a piece is a capsule", answer.stdout)

    def test_what_does_not_apply_is_refused_in_one_line(self):
        file = self.write("cube.obj", obj(CUBE, SIDES))
        for arguments, field in ((["--kinds", "box,box"], "--kinds"), (["--kinds", "cone"], "--kinds"),
                                 (["--kinds", "box", "--shape", "ellipsoid"], "--kinds"),
                                 (["--shape", "box", "--mode", "robust"], "--shape"),
                                 (["--shape", "box", "--coverage", "0.5"], "--shape"),
                                 (["--kinds", "box,ellipsoid", "--margin", "0.1"], "--margin"),
                                 (["--kinds", "box", "--pieces", "65"], "--pieces"),
                                 (["--kinds", "box", "--cone", "9,0,0,1"], "--kinds")):
            answer = run("fit", file, *arguments, "--quiet", "--out", self.out)
            self.assertEqual(answer.returncode, 2, arguments)
            self.assertEqual(answer.stderr.count("\n"), 1, answer.stderr)
            self.assertIn(field + ": got ", answer.stderr)


if __name__ == "__main__":
    unittest.main()
