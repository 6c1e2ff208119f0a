# SPDX-License-Identifier: BSD-3-Clause
"""`vericone shapes`: its files against the bodies' definitions, its engagement against distances. Environment as for
command.py."""
import json
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from command import run  # noqa: E402


def form(matrix, y):
    return sum(matrix[i][j] * y[i] * y[j] for i in range(3) for j in range(3))


def read_ply(path):
    with open(path, encoding="ascii") as f:
        lines = f.read().split("\n")
    end = lines.index("end_header")
    vertices, faces = (int(next(line for line in lines[:end] if line.startswith("element " + name)).split()[2])
                       for name in ("vertex", "face"))
    points = [tuple(map(float, line.split())) for line in lines[end + 1:end + 1 + vertices]]
    return points, [list(map(int, line.split())) for line in lines[end + 1 + vertices:end + 1 + vertices + faces]]


class Shapes(unittest.TestCase):
    def shapes(self, *arguments):
        result = run("shapes", *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_surfaces_are_closed_and_on_their_quadrics(self):
        with tempfile.TemporaryDirectory() as folder:
            self.shapes("--figure", "biconcave,stars", "--no-figures", "--mesh", "ply", "--resolution", "0.3", "--out",
                        folder)
            with open(os.path.join(folder, "biconcave.json"), encoding="utf-8") as f:
                figure = json.load(f)
            self.assertEqual(len(figure["panels"]), 4)
            whole = figure["panels"][3]["solids"][0]
            points, faces = read_ply(os.path.join(folder, "biconcave.ply"))
            self.assertEqual(len(faces), len(whole["mesh"]["triangles"]))
            edges = set()
            for count, *corners, quadric in faces:
                self.assertEqual(count, 3)
                for k in range(3):
                    edge = corners[k], corners[(k + 1) % 3]
                    self.assertNotIn(edge, edges)
                    edges.add(edge)
                for v in corners:
                    if quadric > 0:
                        d = whole["body"]["delimiters"][quadric - 1]
                        self.assertAlmostEqual(form(d["matrix"], points[v]), d["level"], 9)
                    else:  # semi-axes 2, 3, 3
                        x, y, z = points[v]
                        self.assertAlmostEqual(x * x / 4 + (y * y + z * z) / 9, 1, 9)
            self.assertTrue(all((j, i) in edges for i, j in edges))
            self.assertEqual(len(points) - len(edges) // 2 + len(faces), 2)
            # The parts (b) and (c) are the whole.
            parts = [len(figure["panels"][i]["solids"][0]["mesh"]["triangles"]) for i in (1, 2)]
            self.assertEqual(sum(parts), len(faces))
            for name in ("star_8.ply", "star_20.ply", "shapes.json", "provenance.json"):
                self.assertIn(name, os.listdir(folder))

    def test_velocity_in_the_notch_passes(self):
        with tempfile.TemporaryDirectory() as folder:
            self.shapes("--figure", "notch", "--no-figures", "--resolution", "0.1", "--out", folder)
            with open(os.path.join(folder, "notch.json"), encoding="utf-8") as f:
                notch = json.load(f)
            v = notch["notch"]
            self.assertEqual((notch["course"]["verdict"], v["above_verdict"], v["below_verdict"]), ("out", "in", "in"))
            radius = notch["a"]["body"]["factor"][0][0]

            def passing_distance(w):  # of the ball's centre from the obstacle's points
                ww = sum(x * x for x in w)
                least = 1e9
                for p in notch["b"]["mesh"]["vertices"]:
                    t = sum(x * y for x, y in zip(p, w)) / ww
                    least = min(least, sum((x - t * y) ** 2 for x, y in zip(p, w)) ** 0.5)
                return least

            # The vertices are on the surface, the nearest of them a little beside where it passes.
            course = notch["course"]
            beyond = passing_distance(course["velocity"]) - radius - course["miss_distance"]
            self.assertGreater(course["miss_distance"], 0)
            self.assertGreaterEqual(beyond, -1e-9)
            self.assertLess(beyond, 0.01)
            self.assertLess(passing_distance(v["above"]), radius)
            self.assertLess(passing_distance(v["below"]), radius)

    def test_pictures(self):
        with tempfile.TemporaryDirectory() as folder:
            result = self.shapes("--figure", "dented_conic", "--out", folder)
            for name in ("dented_conic.pdf", "dented_conic.png"):
                self.assertIn(name, result.stdout)
                self.assertGreater(os.path.getsize(os.path.join(folder, name)), 10000)
            with open(os.path.join(folder, "dented_conic.pdf"), "rb") as f:
                content = f.read()
            self.assertNotIn(b"/Type3", content)
            self.assertNotIn(b"/Subtype /Image", content)  # lines, not pixels

    def test_refuses_what_it_cannot_draw(self):
        for arguments, field in ((("--figure", "no-such"), "--figure"), (("--mesh", "stl"), "--mesh"),
                                 (("--resolution", "5"), "--resolution"), (("--resolution", "nan"), "--resolution")):
            with tempfile.TemporaryDirectory() as folder:
                result = run("shapes", "--no-figures", "--out", os.path.join(folder, "new"), *arguments)
                self.assertEqual(result.returncode, 2, arguments)
                self.assertIn(field, result.stderr)
                self.assertEqual(result.stderr.count("\n"), 1)
                self.assertEqual(os.listdir(folder), [])


if __name__ == "__main__":
    unittest.main()
