#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Damaged certificates of fits and of runs: refused, or what they then say is true: of fits by fractions, corner by corner and,
beside dents, at a grid of each triangle; of runs at samples of time. Environment: VERICONE_SOURCE, VERICONE_CASES."""
import random
import unittest
from fractions import Fraction

import make
from checker_test import CASES, changed_number, damaged, status

GRID = [(Fraction(i, 12), Fraction(j, 12), Fraction(12 - i - j, 12)) for i in range(13) for j in range(13 - i)]


def fit(rng):
    """A mesh of small numbers, and an ellipsoid that contains it, in part with a dent that it leaves free."""
    dented = rng.random() < 0.5
    points = [[rng.randint(-4, 4), rng.choice([-1, 1]) * rng.randint(3, 6) if dented else rng.randint(-6, 6), rng.randint(-4, 4)]
              for _ in range(6)]
    if dented:  # each triangle on one side of the dent, x^2 - y^2 <= 8
        points.sort(key=lambda p: p[1])
    triangles = [rng.sample(range(6), 3) for _ in range(3)]
    if dented:
        low = [i for i, p in enumerate(points) if p[1] < 0]
        high = [i for i, p in enumerate(points) if p[1] > 0]
        triangles = [[rng.choice(side) for _ in range(3)] for side in (low, high) if side]
    obstacle = {"kind": "delimited" if dented else "ellipsoid", "factor": [[9, 0, 0], [0, 10, 1], [0, 0, 9]]}
    if dented:
        obstacle["delimiters"] = [{"matrix": [[1, 0, 0], [0, -1, 0], [0, 0, 0]], "level": 8}]
    agent = {"kind": "mesh", "points": points, "triangles": triangles}
    return make.certificate({"says": "inside", "agent": agent, "obstacle": obstacle}, {"rule": "vertices"})


def vector(values):
    return [Fraction(x) for x in values]


def true_fit(claim):
    """Whether all corners, and of dents a grid of each triangle, are in the obstacle: by its equations, solved by Cramer."""
    body, mesh = claim["obstacle"], claim["agent"]
    place = vector(body.get("center", [0, 0, 0]))
    f = [vector(row) for row in body["factor"]]

    def determinant(m):
        return sum(m[0][i] * (m[1][i - 2] * m[2][i - 1] - m[1][i - 1] * m[2][i - 2]) for i in range(3))

    def inside(x):
        y, whole = [a - b for a, b in zip(x, place)], determinant(f)
        u = [determinant([[y[r] if c == k else f[r][c] for c in range(3)] for r in range(3)]) / whole for k in range(3)]
        return sum(a * a for a in u) <= 1 and all(
            sum(y[i] * Fraction(cut["matrix"][i][j]) * y[j] for i in range(3) for j in range(3)) <= Fraction(cut["level"])
            for cut in body.get("delimiters", ()))
    moved = vector(mesh.get("center", [0, 0, 0]))
    points = [[a + b for a, b in zip(vector(p), moved)] for p in mesh["points"]]
    weights = GRID if "delimiters" in body else [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    return all(inside([sum(w * points[i][axis] for w, i in zip(some, triangle)) for axis in range(3)])
               for triangle in mesh["triangles"] for some in weights)


class DamagedFits(unittest.TestCase):
    def test_refused_or_still_true(self):
        rng, seen = random.Random(21), {0: 0, 1: 0, 2: 0}
        good = [one for one in (fit(random.Random(seed)) for seed in range(CASES)) if status(one)[0] == 0]
        self.assertGreater(len(good), CASES // 4)
        for one in good:
            self.assertTrue(true_fit(one["claim"]), one)
        for _ in range(CASES * 5):
            document = rng.choice(good)
            bad = damaged(rng, document)
            code, said = status(bad)
            seen[code] += 1
            if code == 0:
                self.assertEqual(bad["claim"]["says"], "inside")
                self.assertTrue(true_fit(bad["claim"]), f"{document} became {bad}: {said}")
        self.assertGreater(min(seen.values()), CASES // 20, seen)


class DamagedRuns(unittest.TestCase):
    def test_refused_or_still_true(self):
        rng, seen, good = random.Random(22), {0: 0, 1: 0, 2: 0}, []
        for seed in range(max(3, CASES // 20)):
            its, flights = make.run(make.generator(seed), 2, duration=2)
            proof = make.pieces(flights[0], flights[1], its["to"])
            if proof:
                good.append(make.certificate(its, {"rule": "pairs", "pairs": {"0 1": proof}}))
        for _ in range(CASES // 2):
            document = rng.choice(good)
            bad = changed_number(rng, document) if rng.random() < 0.5 else damaged(rng, document)
            code, said = status(bad)
            seen[code] += 1
            if code:
                continue
            its = bad["claim"]
            flights = [make.Flight(*both) for both in zip(its["bodies"], its["tracks"])]
            start, end, by = (float(Fraction(its[name])) for name in ("from", "to", "by"))
            for k in range(8):
                t = start + (end - start) * (k + 0.5) / 8
                gap = max(make.best_normal(flights[0], flights[1], t, n)[1] for n in ([0, 1.0, 0], [0, -1.0, 0], [1.0, 0, 0]))
                self.assertGreater(gap, by - 1e-9, f"{its} at {t}: {said}")
        self.assertGreater(seen[1], CASES // 20, seen)


if __name__ == "__main__":
    unittest.main()
