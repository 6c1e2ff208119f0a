#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Passages and corridors: what checker/vericone_check.py accepts of random ones, damaged in one place, is true at samples of
time, by distances from the ring and from the leg that are computed apart. Environment: VERICONE_SOURCE, VERICONE_CASES."""
import math
import random
import unittest
from fractions import Fraction

import make
from checker_test import CASES, changed_number, damaged, example, status

TIMES = 60


def number(x):
    return float(Fraction(x))


def value(track, name, t):
    """A track's Bernstein polynomial at a time; between two segments by the earlier one."""
    times = [number(x) for x in track["times"]]
    k = next(k for k in range(len(times) - 1) if t <= times[k + 1])
    tau = (t - times[k]) / (times[k + 1] - times[k])
    points = [[number(x) / 2 ** track.get("grid", 0) for x in p] for p in track[name][k]]
    while len(points) > 1:
        points = [[a + tau * (b - a) for a, b in zip(p, q)] for p, q in zip(points, points[1:])]
    return points[0]


def turned(track, t, x, back=False):
    """R x, or its inverse."""
    if "turns" not in track:
        return x
    w, *u = value(track, "turns", t)
    if back:
        u = [-c for c in u]

    def cross(a, b):
        return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]
    twice = [2 * c for c in cross(u, x)]
    length = w * w + sum(c * c for c in u)
    return [a + (w * b + c) / length for a, b, c in zip(x, twice, cross(u, twice))]


def to_segment(x, a, b):
    """The distance of a point of the plane or of space."""
    way = [q - p for p, q in zip(a, b)]
    square = sum(c * c for c in way)
    share = min(1, max(0, sum((y - p) * c for y, p, c in zip(x, a, way)) / square)) if square else 0
    return math.dist(x, [p + share * c for p, c in zip(a, way)])


def within(x, outline):
    """Whether a point is in a polygon, by the crossings of a ray."""
    odd = False
    for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1]):
        if (ay > x[1]) != (by > x[1]) and x[0] < ax + (x[1] - ay) / (by - ay) * (bx - ax):
            odd = not odd
    return odd


def from_ring(x, outline, extent):
    """The distance of a point, in the ring's frame."""
    outer = [[extent * c for c in v] for v in outline]
    flat = x[:2]
    if within(flat, outline):
        beside = min(to_segment(flat, a, b) for a, b in zip(outline, outline[1:] + outline[:1]))
    else:
        beside = 0 if within(flat, outer) else min(to_segment(flat, a, b) for a, b in zip(outer, outer[1:] + outer[:1]))
    return math.hypot(beside, x[2])


def true_passage(claim):
    """Of a ball, at samples: apart from the ring, and beside it at the ends, wherever both are within their tubes."""
    ball, wall = (claim["bodies"][k] for k in claim["pair"])
    agent, obstacle = (claim["tracks"][k] for k in claim["pair"])
    outline, extent = [[number(x) for x in v] for v in wall["outline"]], number(wall["extent"])
    start, end = number(claim["from"]), number(claim["to"])
    room = number(ball["radius"]) + number(agent["radius"]) + number(obstacle["radius"])
    for k in range(TIMES + 1):
        t = start + (end - start) * k / TIMES
        middle = [a + b for a, b in zip(value(agent, "positions", t), turned(agent, t, [number(x) for x in ball["center"]]))]
        seen = turned(obstacle, t, [a - b for a, b in zip(middle, value(obstacle, "positions", t))], back=True)
        if from_ring(seen, outline, extent) < room - 1e-9:
            return False
        if k in (0, TIMES) and claim["along"] * (-1 if k == 0 else 1) * seen[2] < room - 1e-9:
            return False
    return True


def true_stay(claim):
    """Of an ellipsoid in a body of two parts, points, at samples: 200 points of it are near enough to the leg."""
    body, leg = (claim["bodies"][k] for k in claim["pair"])
    agent, obstacle = (claim["tracks"][k] for k in claim["pair"])
    ends = [[number(x) for x in part["center"]] for part in leg["parts"]]
    moved = [number(x) for x in leg.get("center", [0, 0, 0])]
    half = [math.sqrt(number(body["shape"][i][i])) for i in range(3)]
    start, end = number(claim["from"]), number(claim["to"])
    rng = random.Random(3)
    for k in range(TIMES + 1):
        t = start + (end - start) * k / TIMES
        at, place = value(agent, "positions", t), value(obstacle, "positions", t)
        for _ in range(20):
            u = [rng.gauss(0, 1) for _ in range(3)]
            x = turned(agent, t, [c + h * a / math.hypot(*u) for c, h, a in zip(
                [number(x) for x in body.get("center", [0, 0, 0])], half, u)])
            seen = [a + b - c - d for a, b, c, d in zip(at, x, place, moved)]
            if to_segment(seen, ends[0], ends[-1]) > number(leg["margin"]) - number(agent["radius"]) - number(
                    obstacle["radius"]) + 1e-9:
                return False
    return True


class DamagedPassages(unittest.TestCase):
    def attacked(self, document, true, plain):
        """Damaged ones that are refused, accepted and true, no certificates."""
        rng, seen = random.Random(str(document)[:40]), {0: 0, 1: 0, 2: 0}
        self.assertEqual(status(document)[0], 0)
        self.assertTrue(true(document["claim"]))
        for _ in range(CASES * 10):
            bad = changed_number(rng, document) if rng.random() < 0.7 else damaged(rng, document)
            code, said = status(bad)
            seen[code] += 1
            if code == 0 and plain(bad["claim"]):
                self.assertTrue(true(bad["claim"]), f"{bad}: {said}")
        self.assertGreater(min(seen.values()), CASES // 10, seen)

    def test_passages(self):
        self.attacked(example("through"), true_passage, lambda claim: claim["says"] == "passed" and [
            body["kind"] for body in claim["bodies"]] == ["ball", "wall"])

    def test_corridors(self):
        def plain(claim):
            return claim["says"] == "stays" and "shape" in claim["bodies"][0] and all(
                Fraction(x) == 0 for i, row in enumerate(claim["bodies"][0]["shape"]) for j, x in enumerate(row) if i != j)
        self.attacked(example("chords"), true_stay, plain)

    def test_a_wall_that_turns_over_is_no_passage(self):
        """A ball at rest, and a wall that is turned over between two segments of its track: as a set it is the same."""
        plane = [[0, 0, 1], 1, ["1/2"], [0]]
        document = {"format": "vericone-certificate", "version": 1,
                    "claim": {"says": "passed", "from": 0, "to": 2, "pair": [0, 1], "along": 1,
                              "bodies": [{"kind": "ball", "center": [0, 0, 0], "radius": "1/2"},
                                         {"kind": "wall", "outline": [[1, -1], [1, 1], [-1, 1], [-1, -1]], "extent": 8}],
                              "tracks": [{"times": [0, 2], "positions": [[[0, 0, -3]]], "radius": "1/10"},
                                         {"times": [0, 1, 2], "positions": [[[0, 0, 0]]] * 2,
                                          "turns": [[[1, 0, 0, 0]], [[0, 1, 0, 0]]], "radius": "1/100"}]},
                    "proof": {"rule": "through", "room": 4, "reach": "1/2",
                              "proof": {"rule": "pieces", "times": [0, 1, 2], "planes": [plane] * 2}}}
        code, said = status(document)
        self.assertEqual(code, 1, said)
        self.assertIn("obstacle: no jump at 1", said)

    def test_random_passages(self):
        """Balls that fly through a turning square, at random: the checker takes none that a sample refutes."""
        seen = {0: 0, 1: 0, 2: 0}
        for seed in range(CASES * 4):
            rng = random.Random(seed)
            document = example("through")
            claim = document["claim"]
            claim["bodies"][0]["radius"] = make.text(Fraction(rng.randint(1, 80), 100))
            for track in claim["tracks"]:
                track["radius"] = make.text(Fraction(rng.randint(0, 10), 100))
            middle = [make.text(Fraction(rng.randint(-30, 30), 100)) for _ in range(2)] + [make.text(Fraction(rng.randint(-20, 20), 100))]
            claim["tracks"][0]["positions"] = [[[0, 0, rng.choice([-4, -2, -1])], middle], [middle, [0, 0, rng.choice([4, 2, 1])]]]
            claim["bodies"][1]["extent"] = rng.choice([2, 4, 8, 8, 16])
            claim["tracks"][1]["turns"] = [[[8, 0, 0, 0], [8, rng.choice([0, 0, 1]), 0, rng.choice([0, 1, -1, 2])]]]
            document["proof"]["room"] = rng.choice([4, 4, 5, 2])
            code, said = status(document)
            seen[code] += 1
            if code == 0:
                self.assertTrue(true_passage(claim), f"{document}: {said}")
        self.assertGreater(seen[0], CASES // 10, seen)
        self.assertGreater(seen[1], CASES // 10, seen)


if __name__ == "__main__":
    unittest.main()
