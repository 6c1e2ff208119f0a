# SPDX-License-Identifier: BSD-3-Clause
"""vericone fit as a user meets it: what is written is read again and proved anew, in rationals. Environment as for
command.py."""
import json
import math
import os
import random
import sys
import tempfile
import unittest
from fractions import Fraction

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bad_input_cases  # noqa: E402
from command import VERICONE, drawn, run  # noqa: E402
from pieces_test import map_of_two_cells, obj, write  # noqa: E402

CUBE = [[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def fit(file, *arguments, out=None):
    """The JSON of a fit."""
    with tempfile.TemporaryDirectory() as folder:
        result = run("fit", file, "--json", "--quiet", "--no-figures", "--out", out or os.path.join(folder, "fit"),
                     *arguments)
        assert result.returncode == 0, result.stderr
        assert result.stderr == "", result.stderr
        return json.loads(result.stdout)


def rows(points):
    return "".join("%r %r %r\n" % tuple(p) for p in points)


def shell(n, axes=(3.0, 2.0, 1.0), seed=1, center=(5.0, -2.0, 7.0), noise=0.0):
    """Points near an ellipsoid."""
    source = random.Random(seed)
    points = []
    for _ in range(n):
        u = [source.gauss(0, 1) for _ in range(3)]
        r = math.sqrt(sum(x * x for x in u)) / (1 + source.gauss(0, noise))
        points.append([c + a * x / r for c, a, x in zip(center, axes, u)])
    return points


def peanut(n=10):
    """A closed mesh with a waist about its long axis, x."""
    points, faces = [[-2.2, 0, 0], [2.2, 0, 0]], []
    for i in range(1, n):
        t = math.pi * i / n
        r = math.sin(t) * (0.25 + 0.75 * math.cos(t) ** 2)
        for k in range(n):
            a = 2 * math.pi * k / n
            points.append([-2.2 * math.cos(t), r * math.cos(a), r * math.sin(a)])
    ring = lambda i, k: 2 + (i - 1) * n + k % n  # noqa: E731
    for k in range(n):
        faces += [(0, ring(1, k), ring(1, k + 1)), (1, ring(n - 1, k + 1), ring(n - 1, k))]
        for i in range(1, n - 1):
            faces.append((ring(i, k), ring(i + 1, k), ring(i + 1, k + 1), ring(i, k + 1)))
    return points, [tuple(reversed(f)) for f in faces]


def triangles_of(faces):
    return [(f[0], f[k - 1], f[k]) for f in faces for k in range(2, len(f))]


def exactly(piece):
    return [[[Fraction(x) for x in row] for row in q] for q in piece["quadrics"]]


def value(q, x):
    x = [Fraction(c) for c in x] + [Fraction(1)]
    return sum(q[i][j] * x[i] * x[j] for i in range(4) for j in range(4))


def inside(result, points):
    """How many points the union of the written pieces contains, in rational arithmetic."""
    pieces = [exactly(p) for p in result["pieces"]]
    return sum(any(all(value(q, x) <= 0 for q in piece) for piece in pieces) for x in points)


class Files(unittest.TestCase):
    PARTS = 1  # of its tests, one of which ./check runs a day

    def setUp(self):
        if self._testMethodName not in drawn(sorted(unittest.TestLoader().getTestCaseNames(type(self))), self.PARTS):
            self.skipTest("drawn on another day (VERICONE_DAY); VERICONE_CAMPAIGN=long runs all")
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = self.temporary.name
        self.out = os.path.join(self.folder, "out")

    def tearDown(self):
        self.temporary.cleanup()

    def write(self, name, content):
        return write(self.folder, name, content)

    def read(self, name):
        with open(os.path.join(self.out, name), encoding="utf-8") as f:
            return f.read()


class Fit(Files):
    FIELDS = ["file", "format", "mode", "shape", "coverage", "margin", "seed", "pieces", "volume", "volume_error", "area",
              "scan_volume", "convex_hull_volume", "ellipsoid_volume", "volume_ratio_bound", "stationarity", "certified",
              "certificate", "inflation", "mean_distance", "rms_distance", "max_distance", "hull_distance", "why",
              "candidates", "notes", "cones", "seconds_read", "seconds"]
    OF_PIECES = ["quadrics", "body", "heights", "converged", "noise", "inliers", "seen", "center_error", "axes_error",
                 "unknown"]

    def test_the_ball_around_a_cube(self):
        result = fit(self.write("cube.obj", obj(CUBE, SIDES)), "--shape", "ellipsoid", "--seed", "7")
        self.assertEqual(list(result), self.FIELDS)
        self.assertEqual([list(p) for p in result["pieces"]], [self.OF_PIECES])
        self.assertEqual((result["mode"], result["shape"], result["seed"]), ("containing", "ellipsoid", 7))
        ball = 4 / 3 * math.pi * math.sqrt(3) ** 3
        for field, truth in (("volume", ball), ("ellipsoid_volume", ball), ("scan_volume", 8),
                             ("convex_hull_volume", 8)):
            self.assertAlmostEqual(result[field] / truth, 1, 6, field)
        self.assertLess(result["max_distance"], 1e-6)  # every corner touches it
        self.assertLess(result["volume_ratio_bound"], 1 + 1e-6)
        self.assertIsNone(result["why"])  # the shape was given
        self.assertTrue(result["certified"])
        certificate = result["certificate"]
        self.assertEqual([certificate[k] for k in ("points", "points_inside", "triangles", "triangles_inside")],
                         [8, 8, 12, 12])
        self.assertEqual(inside(result, CUBE), 8)

    def test_what_is_written_contains_the_points_in_rationals(self):
        points, faces = peanut()
        mesh = self.write("peanut.obj", obj(points, faces))
        for arguments in ((), ("--shape", "biconvex"), ("--shape", "star"), ("--pieces", "2"), ("--shape", "ellipse"),
                          ("--margin", "0.05")):
            with self.subTest(arguments):
                result = fit(mesh, *arguments)
                self.assertTrue(result["certified"])
                self.assertEqual(inside(result, points), len(points))
                self.assertEqual(result["certificate"]["triangles_inside"], result["certificate"]["triangles"])
                for piece in result["pieces"]:
                    for q in piece["quadrics"]:
                        self.assertEqual(q, [list(column) for column in zip(*q)])  # symmetric bit for bit

    def test_a_waist_saves_volume_and_the_choice_says_why(self):
        mesh = self.write("peanut.obj", obj(*peanut()))
        chosen, plain = fit(mesh), fit(mesh, "--shape", "ellipsoid")
        self.assertIn(chosen["shape"], ("biconvex", "star", "biconcave"))
        self.assertLess(chosen["volume"], 0.95 * plain["volume"])
        self.assertGreaterEqual(chosen["volume"], chosen["scan_volume"])
        self.assertAlmostEqual(plain["volume"] / chosen["ellipsoid_volume"], 1, 6)
        self.assertTrue(chosen["why"])
        self.assertIn("ellipsoid", [c["shape"] for c in chosen["candidates"]])

    def test_coverage(self):
        points = shell(200) + [[50.0, 50.0, 50.0]]
        cloud = self.write("cloud.xyz", rows(points))
        whole, most = fit(cloud, "--shape", "ellipsoid"), fit(cloud, "--shape", "ellipsoid", "--coverage", "0.99")
        self.assertEqual(inside(whole, points), 201)
        self.assertGreaterEqual(inside(most, points), math.ceil(0.99 * 201))
        self.assertEqual(inside(most, points), most["certificate"]["points_inside"])
        self.assertTrue(most["certified"])
        self.assertLess(most["volume"], 0.1 * whole["volume"])

    def test_one_far_point_is_named_with_what_it_costs(self):
        points = shell(200)
        points[17] = [50.0, 50.0, 50.0]
        notes = fit(self.write("cloud.xyz", rows(points)), "--shape", "ellipsoid")["notes"]
        self.assertTrue(any(n.startswith("point 17 (50, 50, 50) alone makes") for n in notes), notes)
        notes = fit(self.write("cloud.xyz", rows(shell(200))), "--shape", "ellipsoid")["notes"]
        self.assertFalse(any("alone makes" in n for n in notes), notes)

    def test_margin_is_the_radius_of_balls(self):
        # The least ellipsoid around balls of radius 0.5 at the corners of a cube is a ball, by symmetry.
        result = fit(self.write("cube.xyz", rows(CUBE)), "--shape", "ellipsoid", "--margin", "0.5")
        self.assertAlmostEqual((result["volume"] / (4 / 3 * math.pi)) ** (1 / 3) / (math.sqrt(3) + 0.5), 1, 5)
        self.assertEqual(result["certificate"]["margins_inside"], 8)

    def test_surfaces_near_points_are_found_and_nothing_is_claimed(self):
        points = shell(800, noise=0.01)
        result = fit(self.write("cloud.xyz", rows(points)), "--mode", "least-squares", "--shape", "ellipsoid")
        piece = result["pieces"][0]
        for found, truth in zip(sorted(piece["body"]["semi_axes"]), (1, 2, 3)):
            self.assertAlmostEqual(found, truth, delta=0.02)
        self.assertTrue(piece["converged"])
        self.assertEqual(piece["unknown"], [])
        self.assertAlmostEqual(piece["noise"], 0.02, delta=0.01)
        self.assertFalse(result["certified"])
        self.assertIsNone(result["coverage"])
        self.assertLess(result["certificate"]["points_inside"], 800)
        self.assertTrue(result["certificate"]["statement"].startswith("nothing is proved"))
        far = points + [[x + 40.0 * (i % 3 - 1), y + 30.0, z] for i, (x, y, z) in enumerate(points[:200])]
        robust = fit(self.write("far.xyz", rows(far)), "--mode", "robust", "--shape", "ellipsoid")["pieces"][0]
        for found, truth in zip(sorted(robust["body"]["semi_axes"]), (1, 2, 3)):
            self.assertAlmostEqual(found, truth, delta=0.03)
        self.assertAlmostEqual(robust["inliers"], 0.8, delta=0.03)

    def test_robust_with_coverage_is_proved(self):
        points = shell(400, noise=0.01)
        result = fit(self.write("cloud.xyz", rows(points)), "--mode", "robust", "--shape", "ellipsoid", "--coverage", "1")
        self.assertTrue(result["certified"])
        self.assertEqual(inside(result, points), 400)

    def test_flat_points_have_a_footprint(self):
        points = [[math.cos(i), 2 * math.sin(i), 0.25] for i in range(40)]
        result = fit(self.write("flat.xyz", rows(points)), "--shape", "ellipse")
        piece = result["pieces"][0]
        self.assertEqual(piece["heights"], [0.25, 0.25])
        self.assertIsNone(result["volume"])
        self.assertAlmostEqual(result["area"] / (2 * math.pi), 1, 3)
        self.assertEqual(inside(result, points), 40)

    def test_octree_maps_by_the_corners_of_their_cells(self):
        result = fit(self.write("map.bt", map_of_two_cells()), "--shape", "ellipsoid")
        self.assertAlmostEqual(result["volume"] / (4 / 3 * math.pi * math.sqrt(0.75) ** 3), 1, 6)
        self.assertEqual(inside(result, [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]), 8)

    def test_degenerate_triangles_and_equal_points_are_part_of_the_mesh(self):
        points = CUBE + CUBE + [[0.0, 0.0, 3.0]]
        faces = SIDES[:3] + [tuple(i + 8 for i in f) for f in SIDES[3:]] + [(0, 8, 16)]
        result = fit(self.write("cube.obj", obj(points, faces)), "--shape", "ellipsoid")
        self.assertEqual(inside(result, points), 17)
        self.assertEqual(result["certificate"]["points"], 9)
        self.assertTrue(any("no area" in n for n in result["notes"]), result["notes"])

    def test_a_mesh_covered_twice_counts_once_and_is_told(self):
        plain = fit(self.write("cube.obj", obj(CUBE, SIDES)), "--shape", "ellipsoid")
        for faces in (SIDES + SIDES, SIDES + [tuple(reversed(f)) for f in triangles_of(SIDES)]):
            result = fit(self.write("twice.obj", obj(CUBE, triangles_of(faces))), "--shape", "ellipsoid")
            self.assertEqual((result["scan_volume"], result["pieces"]), (plain["scan_volume"], plain["pieces"]))
            self.assertTrue(any("12 triangles were there twice" in n for n in result["notes"]), result["notes"])

    def test_a_mesh_without_an_inside_is_told(self):
        sheet = [[0.1, 0.3, 0.7], [1.1, 0.3, 0.7], [1.1, 1.3, 0.9], [0.1, 1.3, 0.9]]
        for faces, why in (([(0, 1, 2), (0, 2, 3), (1, 0, 3), (1, 3, 2)], "closed and has no inside"),
                           ([(0, 1, 2), (0, 2, 3)], "open")):
            result = fit(self.write("sheet.obj", obj(sheet, faces)), "--shape", "ellipsoid", "--margin", "0.1")
            self.assertIsNone(result["scan_volume"])
            self.assertTrue(any(why in n for n in result["notes"]), result["notes"])
        turned = [SIDES[0][::-1]] + SIDES[1:]
        result = fit(self.write("turned.obj", obj(CUBE, turned)), "--shape", "ellipsoid")
        self.assertIsNone(result["scan_volume"])
        self.assertTrue(any("disagree at 4 edges" in n for n in result["notes"]), result["notes"])


class FitSame(Files):
    PARTS = 3

    def without_times(self, result):
        return {k: v for k, v in result.items() if not k.startswith("seconds")}

    def test_the_same_bytes_again(self):
        mesh = self.write("peanut.obj", obj(*peanut()))
        once, again = (self.without_times(fit(mesh, "--seed", "3")) for _ in range(2))
        self.assertEqual(json.dumps(once), json.dumps(again))

    def test_the_order_of_the_points_does_not_matter(self):
        points = shell(120, noise=0.02)
        mixed = points[:]
        random.Random(4).shuffle(mixed)
        for mode in ("containing", "robust"):
            with self.subTest(mode):
                a, b = (fit(self.write(n, rows(p)), "--mode", mode) for n, p in (("a.xyz", points), ("b.xyz", mixed)))
                self.assertEqual(a["shape"], b["shape"])
                self.assertAlmostEqual(a["volume"] / b["volume"], 1, 9)
                for p, q in zip(a["pieces"], b["pieces"]):
                    self.assertAlmostEqual(math.dist(p["body"]["center"], q["body"]["center"]), 0, 8)
                    for x, y in zip(p["body"]["semi_axes"], q["body"]["semi_axes"]):
                        self.assertAlmostEqual(x / y, 1, 9)

    def test_scale(self):
        points = shell(200)
        a = fit(self.write("a.xyz", rows(points)))
        b = fit(self.write("b.xyz", rows([[1024 * c for c in p] for p in points])))
        self.assertEqual(a["shape"], b["shape"])
        self.assertAlmostEqual(b["volume"] / a["volume"] / 1024 ** 3, 1, 9)


class FitBadInput(unittest.TestCase):
    def test_every_bad_fit_says_why(self):
        self.assertGreaterEqual(len(bad_input_cases.FITS), 20)
        for what, arguments, files in bad_input_cases.FITS:
            with self.subTest(what):
                result, left = bad_input_cases.run_fit(VERICONE, arguments, files)
                self.assertEqual(result.returncode, 2, result.stderr)
                self.assertEqual(result.stdout, "")
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertRegex(result.stderr, r"^vericone: \S.*(: got .+, must be .+|see vericone fit --help)")
                self.assertEqual(left, [], "something half written")


if __name__ == "__main__":
    unittest.main()
