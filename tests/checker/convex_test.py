#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Bodies of flat, round and straight parts: what checker/vericone_check.py accepts of random ones, right and damaged, is true
by their support functions in doubles, minimized over all normals. Environment: VERICONE_SOURCE, VERICONE_CASES."""
import math
import random
import unittest
from fractions import Fraction

import make
from checker_test import CASES, changed, numbers_of, status

SQUARES = [(3, 4, 5), (5, 12, 13), (8, 15, 17), (0, 1, 1), (1, 0, 1)]


def body(rng):
    """Two to four parts, points, discs and ellipsoids, of small whole numbers, and a margin."""
    def part():
        flat = [[rng.randint(-2, 2), rng.randint(-2, 2), 0] for _ in range(3)]
        factor = rng.choice([None, flat, [[rng.randint(1, 2) if i == j else 0 for j in range(3)] for i in range(3)]])
        return {"center": [rng.randint(-2, 2) for _ in range(3)], **({"factor": factor} if factor else {})}
    return {"kind": "convex", "parts": [part() for _ in range(rng.randint(1, 4))], "margin": rng.choice([0, 1, "1/2"])}


def reach(its, n):
    """max n.x over the body at t = 0."""
    found = -math.inf
    for part in its["parts"]:
        columns = list(zip(*part.get("factor", ()))) if "factor" in part else []
        root = math.sqrt(sum(sum(float(Fraction(f)) * x for f, x in zip(column, n)) ** 2 for column in columns))
        found = max(found, sum(float(Fraction(c)) * x for c, x in zip(part["center"], n)) + root)
    return found + float(Fraction(its.get("margin", 0))) * math.hypot(*n) + sum(
        float(Fraction(c)) * x for c, x in zip(its.get("center", (0, 0, 0)), n))


def overlap(a, b):
    """The least of h_A(n) + h_B(-n) over unit normals: above 0 where they overlap, below where they are apart."""
    def value(n):
        length = math.hypot(*n)
        return (reach(a, n) + reach(b, [-x for x in n])) / length
    rng, best = random.Random(7), math.inf
    starts = [[rng.gauss(0, 1) for _ in range(3)] for _ in range(40)]
    starts = sorted(starts, key=value)[:4]
    for n in starts:
        now, step = value(n), 0.3
        n = [x / math.hypot(*n) for x in n]
        while step > 1e-7:
            tried = [x + step * rng.gauss(0, 1) for x in n]
            other = value(tried)
            if other < now:
                n, now = [x / math.hypot(*tried) for x in tried], other
            else:
                step *= 0.9
        best = min(best, now)
    return best


def factor_times(part, u):
    return [sum(Fraction(x) * y for x, y in zip(row, u)) for row in part["factor"]] if "factor" in part else [Fraction(0)] * 3


def shape_times(part, m):
    columns = list(zip(*part["factor"]))
    u = [sum(Fraction(x) * y for x, y in zip(column, m)) for column in columns]
    return factor_times(part, u), sum(x * x for x in u)


def mean(rng, its, strictly):
    """(weights, the point) of some parts, by weights of sum 1 and vectors m with m.S m below or up to the weight's square."""
    count = len(its["parts"])
    shares = [Fraction(rng.randint(1, 5)) for _ in range(count)]
    shares = [x / sum(shares) for x in shares]
    weights, point = [], [Fraction(0)] * 3
    for i, (part, share) in enumerate(zip(its["parts"], shares)):
        point = [x + share * Fraction(c) for x, c in zip(point, part["center"])]
        if "factor" not in part:
            weights.append([i, make.text(share)])
            continue
        m = [Fraction(rng.randint(-3, 3)) for _ in range(3)]
        square = shape_times(part, m)[1]
        scale = share / (math.isqrt(math.ceil(square)) + 1) * (Fraction(4, 5) if strictly else 1)
        m = [x * scale for x in m]
        point = [x + y for x, y in zip(point, shape_times(part, m)[0])]
        weights.append([i, make.text(share), [make.text(x) for x in m]])
    return weights, point


def overlapping(rng):
    a, b = body(rng), body(rng)
    of_a, x = mean(rng, a, True)
    of_b, y = mean(rng, b, True)
    b["center"] = [make.text(p - q) for p, q in zip(x, y)]
    proof = {"rule": "point", "time": 0, "point": [make.text(p) for p in x], "agent_weights": of_a, "obstacle_weights": of_b,
             "inside": rng.choice(["agent", "obstacle", "both"])}
    return make.certificate({"says": "overlapping", "agent": a, "obstacle": b}, proof)


def disjoint(rng):
    a, b = body(rng), body(rng)
    b["center"] = [rng.randint(-8, 8) for _ in range(3)]
    x, y, z = rng.choice(SQUARES)
    n = rng.choice([[x, y, 0], [0, x, y], b["center"], b["center"]])
    if not any(n) or z == 0:
        n = [1, 0, 0]
    low, high = -reach(b, [-x for x in n]), reach(a, n)
    off = rng.choice([0, 1e-9, 1e-3, 1e-3, -1e-9])
    return make.certificate({"says": "disjoint", "agent": a, "obstacle": b}, {
        "rule": "plane", "n": n, "agent_at_most": high + off, "obstacle_at_least": low - off})


class Convex(unittest.TestCase):
    def test_accepted_is_true(self):
        seen = {"disjoint": 0, "overlapping": 0}
        for seed in range(CASES * 2):
            rng = random.Random(seed)
            document = (disjoint if seed % 2 else overlapping)(rng)
            for k in range(3):
                code, said = status(document)
                if code == 0:
                    claim = document["claim"]
                    depth = overlap(claim["agent"], claim["obstacle"])
                    self.assertTrue(depth > -1e-9 if claim["says"] == "overlapping" else depth < 1e-9, (seed, k, depth, document, said))
                    seen[claim["says"]] += 1
                path = list(rng.choice([path for path in numbers_of(document) if path[0] != "version"]))
                new = rng.choice([0, 1, 2, -1, "1/2", "1/3"])
                document = changed(document, path, new)
        self.assertGreater(min(seen.values()), CASES // 8, seen)


if __name__ == "__main__":
    unittest.main()
