# SPDX-License-Identifier: BSD-3-Clause
"""`vericone query --certificate`: what it answers is read by the checker, which shares no line with the library."""
import collections
import json
import os
import random
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.environ["VERICONE_SOURCE"], "tests", "cli"))
from command import ball, check_certificates, engagement, run


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
    return check_certificates(path)


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
    elif kind == "cylinder":
        made["cylinder"] = {"radius": axes[0], "height": 2 * axes[1]}
    elif kind == "capsule":
        made["capsule"] = {"radius": axes[0], "length": 2 * axes[1]}
    elif kind == "cone":
        made["cone"] = {"radius": axes[0], "height": 2 * axes[1]}
    elif kind == "disc":
        made["disc"] = {"radius": axes[0]}
    elif kind == "rounded":
        made.update(points=points(rng, rng.randint(1, 7), 2, whole), margin=axes[0])
    elif kind == "towers":
        made["pieces"] = [{"cylinder": {"radius": 1, "height": 2 * rng.randint(1, 3)}, "center": vector(rng, 3, whole)} for _ in range(3)]
    elif kind == "pieces":
        made["pieces"] = [{"points": points(rng, 4, 2, whole)} for _ in range(3)]
    elif kind == "balls":
        made["pieces"] = [ball(vector(rng, 2, whole), 1) for _ in range(2)]
    else:
        made[{"mesh": "mesh", "cloud": "cloud"}[kind]] = "body.ply"
        if kind == "cloud":
            made["radius"] = rng.choice([0, 1])
    return made


MESH = []  # the points of the file that the bodies are made of


def farthest(made, axis, sign):
    """The point of a body of whole numbers about the origin that is farthest along an axis (of a dented one not x)."""
    for word in WORDS[:4]:
        if word in made:
            half = made[word].get("height", made[word].get("length", 0)) // 2
            along = half + made["capsule"]["radius"] if word == "capsule" else half
            across = 0 if axis == 2 else sign * made[word]["radius"]
            return [across * (axis == 0), across * (axis == 1), sign * along if axis == 2 else -half if word == "cone" else 0]
    if "semi_axes" in made:
        return [sign * (size if i == axis else 0) for i, size in enumerate(made["semi_axes"])]
    if "pieces" in made:
        found = [[x + y for x, y in zip(piece.get("center", (0, 0, 0)), farthest(piece, axis, sign))] for piece in made["pieces"]]
    else:
        found = made.get("points", MESH)
    point = list(max(found, key=lambda x: sign * x[axis]))
    point[axis] += sign * (made.get("radius", 0) + made.get("margin", 0))
    return point


def write_mesh(folder, rng):
    corners = MESH[:] = points(rng, 30, 3, True)
    faces = [rng.sample(range(30), 3) for _ in range(40)]
    with open(os.path.join(folder, "body.ply"), "w", encoding="ascii") as file:
        file.write("ply\nformat ascii 1.0\nelement vertex 30\nproperty double x\nproperty double y\nproperty double z\n"
                   "element face 40\nproperty list uchar int vertex_indices\nend_header\n")
        file.writelines(" ".join(map(str, x)) + "\n" for x in corners)
        file.writelines("3 " + " ".join(map(str, f)) + "\n" for f in faces)


KINDS = ("ellipsoid", "hull", "mesh", "cloud", "pieces", "balls", "dented")
WORDS = ("cylinder", "capsule", "cone", "disc", "rounded", "towers")  # of flat, round and straight parts
ROUND = WORDS + ("ellipsoid", "hull", "mesh", "cloud")
# How many of each; a campaign asks for many, and is told what has none.
SCALE = int(os.environ.get("VERICONE_CASES", "0")) / 400 or 1


def errors(rng, most):
    kind = rng.choice(("ball", "box", "semi_axes", "none"))
    if kind == "ball":
        return {"ball": rng.uniform(0, most)}
    if kind == "box":
        return {"box": [rng.choice([0, rng.uniform(0, most)]) for _ in range(3)]}
    return {"semi_axes": [rng.uniform(0.05, most) for _ in range(3)], "rotation": quaternion(rng)} if kind != "none" else None


def kind_of(fields):
    for word in WORDS:
        if word in fields:
            return word
    for kind, field in (("rounded", "margin"), ("dented", "hyperboloids"), ("hull", "points"), ("mesh", "mesh"), ("cloud", "cloud"), ("pieces", "pieces")):
        if field in fields:
            return kind
    return "ellipsoid"


class Certificates(unittest.TestCase):
    def cases(self, rng, whole, count, kinds=KINDS):
        for i in range(count):
            a, b = (body(rng, rng.choice(kinds), center, whole)
                    for center in ([0, 0, 0], vector(rng, 8, whole)))
            v = vector(rng, 2, whole) if rng.random() < 0.5 else [x / 4 for x in b["center"]]
            case = engagement(a, b, v, vector(rng, 1, whole) if rng.random() < 0.3 else (0, 0, 0), id=i)
            if rng.random() < 0.3:
                case["horizon"] = rng.randint(1, 12) / 4
            yield case

    def cases_with_errors(self, rng, count):
        for case in self.cases(rng, rng.random() < 0.3, count, ("ellipsoid", "hull") if rng.random() < 0.7 else KINDS):
            most = rng.choice((0.1, 0.3, 1, 3))
            for name, size in (("position_error", most), ("velocity_error", most / 4)):
                of_case = errors(rng, size)
                if of_case:
                    case[name] = of_case
            yield case

    def tangent_cases(self, rng, count, kinds=KINDS):
        """Bodies of whole numbers that touch in a plane across an axis: now, or after a flight along that plane."""
        for i in range(count):
            axis, sign = rng.choice((1, 2)), rng.choice((-1, 1))  # dents are along x
            bodies = [body(rng, rng.choice(kinds), [0, 0, 0], True) for _ in range(2)]
            points = [farthest(one, axis, side) for one, side in zip(bodies, (sign, -sign))]
            v = vector(rng, 2, True)
            v[axis] = 0
            flight = rng.choice((0, 1, 2, 3)) if any(v) else 0
            bodies[1]["center"] = [x - y + flight * z for x, y, z in zip(*points, v)]
            yield engagement(*bodies, v if flight else vector(rng, 2, True), id=i)

    def accepted(self, cases_of, seed, count, share=0.99):
        """Of random cases: those decided have a certificate, all but a few, that says the answer and is accepted. Printed are,
        by kinds, those that have none, undecided ones too."""
        rng, none, said = random.Random(seed), collections.Counter(), collections.Counter()
        with tempfile.TemporaryDirectory() as folder:
            write_mesh(folder, rng)
            cases = list(cases_of(rng, int(SCALE * count)))
            for first in range(0, len(cases), 2000):
                self.chunk(cases[first:first + 2000], folder, said, none)
                decided = sum(count for says, count in said.items() if says != "undecided")
                lacking = sum(count for (says, *_), count in none.items() if says != "undecided")
                if SCALE > 1:  # so that a campaign that is cut off has told what it found
                    print(f"{self._testMethodName}: {decided - lacking} of {decided} decided; {dict(said)}; none: {dict(none)}", flush=True)
        self.assertGreaterEqual(decided - lacking, share * decided, none)
        return said

    def chunk(self, cases, folder, said, none):
        lines, values = answers(cases, folder)
        proved = [line for line, value in zip(lines, values) if value["certificate"]]
        for value, case in zip(values, cases):
            says = value["robust" if "robust" in value else "verdict"]
            said[says] += 1
            if value["certificate"]:
                claim = value["certificate"]["claim"]
                self.assertIn(claim["says"], (says, value["verdict"]))
                self.assertEqual(claim["id"], value["id"])
            else:
                self.assertTrue(value["no_certificate"])
                none[says, *(kind_of(case[who]) for who in ("agent", "obstacle"))] += 1
        result = checked(proved, folder)
        self.assertEqual(result.returncode, 0, "\n".join(x for x in result.stdout.splitlines() if ": accepted" not in x))
        self.assertEqual(result.stdout.count(": accepted"), len(proved))

    def test_bodies_of_whole_numbers(self):
        said = self.accepted(lambda rng, count: self.cases(rng, True, count), 901, 400, 0.997)
        self.assertGreaterEqual(set(said), {"in", "out", "overlapping", "touching", "on"})

    def test_any_bodies(self):
        said = self.accepted(lambda rng, count: self.cases(rng, False, count), 902, 300, 0.997)
        self.assertGreaterEqual(set(said), {"in", "out", "overlapping"})

    def test_exact_tangencies(self):
        said = self.accepted(self.tangent_cases, 904, 300, 0.995)
        self.assertGreater(said["on"] + said["touching"], (sum(said.values()) - said["undecided"]) / 2)

    def test_flat_round_and_straight_parts(self):
        for whole, seed in ((True, 905), (False, 906)):
            said = self.accepted(lambda rng, count, whole=whole: self.cases(rng, whole, count, ROUND), seed, 200, 0.997)
            self.assertGreaterEqual(set(said), {"in", "out", "overlapping"})

    def test_exact_tangencies_of_such(self):
        said = self.accepted(lambda rng, count: self.tangent_cases(rng, count, ROUND), 907, 200, 0.98)
        self.assertGreater(said["on"] + said["touching"], (sum(said.values()) - said["undecided"]) / 2)

    def test_errors(self):
        said = self.accepted(lambda rng, count: (case for _ in range(8) for case in self.cases_with_errors(rng, count // 8)), 903, 400)
        self.assertGreaterEqual(set(said), {"in", "out", "depends"})

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

    def test_cone_has_the_certificate_of_its_verdict(self):
        scene = {"agent": {"cylinder": {"radius": 1, "height": 2}, "center": [0, 0, 0], "velocity": [1, 0, 0]},
                 "obstacle": {"semi_axes": [1, 1, 1], "center": [9, 1, 0], "velocity": [0, 0, 0]}}
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(scene, file)
            result = run("cone", path, "--json", "--certificate")
            self.assertEqual(json.loads(result.stdout)["certificate"]["claim"]["says"], "in", result.stderr)
            self.assertEqual(checked(result.stdout.splitlines(), folder).returncode, 0)
            result = run("cone", path, "--certificate")
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn("--certificate: got given alone", result.stderr)
            case = {**scene, "id": 7, "agent_velocity": [0, 1, 0], "obstacle_velocity": [0, 0, 0]}
            for who in ("agent", "obstacle"):
                case[who] = {name: x for name, x in scene[who].items() if name != "velocity"}
            result = run("cone", "-", "--cases", "--certificate", input=json.dumps(case) + "\n")
            claim = json.loads(result.stdout)["certificate"]["claim"]
            self.assertEqual((claim["says"], claim["id"]), ("out", 7))

    def test_planar_bodies_are_stated_as_the_spatial_ones_that_stand_for_them(self):
        disc = {"center": [0, 0], "semi_axes": [1, 2]}
        with tempfile.TemporaryDirectory() as folder:
            lines, values = answers([engagement(disc, {"center": [9, 1], "semi_axes": [1, 1]}, [1, 0], [0, 0])], folder)
            self.assertEqual(values[0]["verdict"], "in")
            self.assertEqual(checked(lines, folder).returncode, 0)


if __name__ == "__main__":
    unittest.main()
