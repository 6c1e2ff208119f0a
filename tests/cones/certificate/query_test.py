# SPDX-License-Identifier: BSD-3-Clause
"""`vericone query --certificate`: what it answers is read by the checker, which shares no line with the library."""
import json
import os
import random
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.environ["VERICONE_SOURCE"], "tests", "cli"))
from command import SOURCE, ball, engagement, run

CHECKER = os.path.join(SOURCE, "checker", "vericone_check.py")


def answers(cases, folder):
    """The lines of the answers, and those as values."""
    text = "".join(json.dumps(c) + "\n" for c in cases)
    result = run("query", "-", "--certificate", input=text, cwd=folder)
    if result.returncode != 0:
        raise AssertionError(result.stderr + "\n".join(x for x in result.stdout.splitlines() if '"error"' in x)[:2000])
    return result.stdout.splitlines(), [json.loads(line) for line in result.stdout.splitlines()]


def checked(lines, folder):
    """What the checker says of certificates in a file, a line each."""
    path = os.path.join(folder, "answers.jsonl")
    with open(path, "w", encoding="utf-8") as file:
        file.write("".join(line + "\n" for line in lines))
    return subprocess.run(["/usr/bin/python3", CHECKER, path], capture_output=True, text=True, check=False)


def vector(rng, most, whole):
    return [rng.randint(-most, most) if whole else rng.uniform(-most, most) for _ in range(3)]


def quaternion(rng):
    q = [rng.gauss(0, 1) for _ in range(4)]
    length = sum(x * x for x in q) ** 0.5
    return [x / length for x in q]


def points(rng, count, most, whole):
    return [vector(rng, most, whole) for _ in range(count)]


def body(rng, kind, center, whole):
    """Of whole numbers, which touch exactly now and then, or of any."""
    made = {"center": center}
    if not whole and kind != "planar" and rng.random() < 0.5:
        made["rotation"] = quaternion(rng)
    axes = [rng.randint(1, 3) if whole else rng.uniform(0.3, 2) for _ in range(3)]
    if kind == "ellipsoid":
        made["semi_axes"] = axes
    elif kind == "dented":
        made["semi_axes"] = [2, 1.5, 1.5]
        made["hyperboloids"] = [{"sheets": 2, "semi_axes": [0.8, 0.7, 0.9]}]
    elif kind == "hull":
        made["points"] = points(rng, rng.randint(1, 7), 2, whole)
    elif kind == "pieces":
        made["pieces"] = [{"points": points(rng, 4, 2, whole)} for _ in range(3)]
    elif kind == "balls":
        made["pieces"] = [ball(vector(rng, 2, whole), 1) for _ in range(2)]
    else:
        made[{"mesh": "mesh", "cloud": "cloud"}[kind]] = "body.ply"
        if kind == "cloud":
            made["radius"] = rng.choice([0, 1])
    return made


def write_mesh(folder, rng):
    corners = points(rng, 30, 3, True)
    faces = [rng.sample(range(30), 3) for _ in range(40)]
    with open(os.path.join(folder, "body.ply"), "w", encoding="ascii") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex 30\nproperty double x\nproperty double y\nproperty double z\n"
                   "element face 40\nproperty list uchar int vertex_indices\nend_header\n")
        file.writelines(" ".join(map(str, x)) + "\n" for x in corners)
        file.writelines("3 " + " ".join(map(str, f)) + "\n" for f in faces)


KINDS = ("ellipsoid", "hull", "mesh", "cloud", "pieces", "balls", "dented")


class Certificates(unittest.TestCase):
    def cases(self, rng, whole, count):
        for i in range(count):
            a, b = (body(rng, rng.choice(KINDS), center, whole)
                    for center in ([0, 0, 0], vector(rng, 8, whole)))
            v = vector(rng, 2, whole) if rng.random() < 0.5 else [x / 4 for x in b["center"]]
            case = engagement(a, b, v, vector(rng, 1, whole) if rng.random() < 0.3 else (0, 0, 0), id=i)
            if rng.random() < 0.3:
                case["horizon"] = rng.randint(1, 12) / 4
            yield case

    def accepted(self, whole, seed, count):
        rng = random.Random(seed)
        with tempfile.TemporaryDirectory() as folder:
            write_mesh(folder, rng)
            lines, values = answers(self.cases(rng, whole, count), folder)
            self.assertEqual(len(values), count)
            self.assertGreaterEqual({v["verdict"] for v in values}, {"in", "out"})
            proved = [line for line, value in zip(lines, values) if value["certificate"]]
            for value in values:
                if not value["certificate"]:
                    self.assertTrue(value["no_certificate"])
                else:
                    self.assertEqual(value["certificate"]["claim"]["says"], value["verdict"])
                    self.assertEqual(value["certificate"]["claim"]["id"], value["id"])
            self.assertGreaterEqual(len(proved), 0.98 * count)
            result = checked(proved, folder)
            self.assertEqual(result.returncode, 0, "\n".join(x for x in result.stdout.splitlines() if ": accepted" not in x))
            self.assertEqual(result.stdout.count(": accepted"), len(proved))

    def test_bodies_of_whole_numbers(self):
        self.accepted(True, 901, 400)

    def test_any_bodies(self):
        self.accepted(False, 902, 300)

    def test_the_proof_of_one_verdict_is_none_of_another(self):
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        with tempfile.TemporaryDirectory() as folder:
            lines, values = answers([engagement(a, b, v) for v in ([4, 3, 0], [1, 0, 0], [0, 1, 0])], folder)
            self.assertEqual([v["verdict"] for v in values], ["on", "in", "out"])
            self.assertEqual(checked(lines, folder).returncode, 0)
            for value in values:
                for other in ("on", "in", "out"):
                    if other == value["verdict"]:
                        continue
                    false = json.loads(json.dumps(value))
                    false["verdict"] = false["certificate"]["claim"]["says"] = other
                    self.assertNotEqual(checked([json.dumps(false)], folder).returncode, 0)

    def test_planar_bodies_are_stated_as_the_spatial_ones_that_stand_for_them(self):
        disc = {"center": [0, 0], "semi_axes": [1, 2]}
        with tempfile.TemporaryDirectory() as folder:
            lines, values = answers([engagement(disc, {"center": [9, 1], "semi_axes": [1, 1]}, [1, 0], [0, 0])], folder)
            self.assertEqual(values[0]["verdict"], "in")
            self.assertEqual(checked(lines, folder).returncode, 0)


if __name__ == "__main__":
    unittest.main()
