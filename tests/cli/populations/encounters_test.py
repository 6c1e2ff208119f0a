# SPDX-License-Identifier: BSD-3-Clause
"""`vericone trials --encounters`: probabilities of near misses and risk ratios against a script of its own, straight
encounters against closed forms, tables in other units, parts. Environment as for command.py."""
import csv
import json
import math
import os
import random
import re
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from command import run

SCENARIO = """duration: 60
step: 0.1
seed: 3
stop_when_passed: true
bodies:
  - name: agent
    shape: {semi_axes: [8, 8, 2]}
    position: [0, 0, 0]
    velocity: [60, 0, 0]
    pilot: {law: %s, manner: source, gain: 0.5, most: 3}
  - name: intruder
    shape: {semi_axes: [8, 8, 2]}
    position: [4000, 0, 0]
    velocity: [-60, 0, 0]
"""
RADIUS, HALF_HEIGHT = 152.4, 30.48  # 500 ft, 100 ft


def gamma_cdf(shape, x):
    """Of a gamma distribution: the series of the incomplete gamma function."""
    if x <= 0:
        return 0.0
    term = total = 1 / shape
    k = 0
    while abs(term) > 1e-17 * abs(total):
        k += 1
        term *= x / (shape + k)
        total += term
    return min(1.0, total * math.exp(-x + shape * math.log(x) - math.lgamma(shape)))


def gamma_quantile(shape, probability):
    low, high = 0.0, 10 * shape + 100
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if gamma_cdf(shape, middle) < probability else (low, middle)
    return 0.5 * (low + high)


def bounds(weights, largest, confidence):
    """Fay and Feuer's, of a weighted sum of counts."""
    total, squares, tail = math.fsum(weights), math.fsum(w * w for w in weights), 0.5 * (1 - confidence)
    low = squares / total * gamma_quantile(total * total / squares, tail) if weights else 0
    most = max(weights, default=largest)
    total, squares = total + most, squares + most * most
    return low, squares / total * gamma_quantile(total * total / squares, 1 - tail)


def ratio(rows, first, second):
    """(ratio, low, high) of two laws on the same encounters."""
    both, mine, other = ([w for w, a, b in rows if (a[first], b[second]) == pair]
                         for pair in ((True, True), (True, False), (False, True)))
    (c_low, c_high), (a_low, a_high), (b_low, b_high) = (
        bounds(weights, max(w for w, _, _ in rows), 1 - 0.05 / 3) for weights in (both, mine, other))
    return ((sum(both) + sum(mine)) / (sum(both) + sum(other)),
            min((c + a_low) / (c + b_high) for c in (c_low, c_high)),
            max((c + a_high) / (c + b_low) if c + b_low else math.inf for c in (c_low, c_high)))


def straight_enters(agent, intruder, seconds):
    """Whether two bodies that go straight on come within the volume: the times at which they are within its radius and
    within its heights are intervals."""
    p = [b - a for a, b in zip(agent[0], intruder[0])]
    v = [b - a for a, b in zip(agent[1], intruder[1])]
    across, along, off = v[0] ** 2 + v[1] ** 2, p[0] * v[0] + p[1] * v[1], p[0] ** 2 + p[1] ** 2 - RADIUS ** 2
    root = along * along - across * off
    if root <= 0:
        return False
    near = ((-along - math.sqrt(root)) / across, (-along + math.sqrt(root)) / across)
    level = sorted(((-HALF_HEIGHT - p[2]) / v[2], (HALF_HEIGHT - p[2]) / v[2])) if v[2] else (
        (-math.inf, math.inf) if abs(p[2]) < HALF_HEIGHT else (1, 0))
    return max(near[0], level[0], 0) < min(near[1], level[1], seconds)


class Encounters(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def file(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as f:
            f.write(text)
        return self.path(name)

    def trials(self, out, *words, law="clearance, clearance: {required: 200}"):
        scenario = self.file("scenario.yaml", SCENARIO % law)
        result = run("trials", scenario, "--quiet", "--no-figures", "--out", self.path(out), *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        with open(self.path(out) + "/trials.csv", encoding="utf-8") as f:
            rows = list(csv.DictReader(line for line in f if not line.startswith("#")))
        with open(self.path(out) + "/trials.json", encoding="utf-8") as f:
            return rows, json.load(f)["encounters"]

    def table(self, count):
        """Straight encounters that come within 1000 m or so in 50 s."""
        numbers = random.Random(4)
        self.ways, lines = [], ["encounter,body,weight,t [s],x [m],y [m],z [m]"]
        for i in range(count):
            course, climb, seconds = numbers.uniform(1, 5.2), numbers.uniform(-2, 2), numbers.uniform(25, 45)
            velocity = (60 * math.cos(course), 60 * math.sin(course), climb)
            at = (60 * seconds + numbers.gauss(0, 250), numbers.gauss(0, 250), numbers.gauss(0, 40))
            start = tuple(a - seconds * v for a, v in zip(at, velocity))
            weight = round(numbers.uniform(0.1, 3), 3)
            self.ways.append((weight, ((0, 0, 0), (60, 0, 0)), (start, velocity)))
            for body, (place, v) in (("agent", self.ways[-1][1]), ("intruder", self.ways[-1][2])):
                for t in (0, 60):
                    lines.append("%d,%s,%r,%d,%s" % (i, body, weight, t, ",".join(repr(p + t * s) for p, s in zip(place, v))))
        return self.file("encounters.csv", "\n".join(lines) + "\n")

    def test_risks_are_those_of_a_script_of_its_own(self):
        rows, found = self.trials("out", "--encounters", self.table(120), "--levels", "x1", "--laws", "own")
        self.assertEqual(len(rows), 120)
        weights = [float(row["weight"]) for row in rows]
        column = " within 500 ft:100 ft"
        entered = {law: [row[law + column] == "yes" for row in rows] for law in ("none", "x1 own")}
        self.assertEqual(entered["none"], [straight_enters(a, b, 60) for _, a, b in self.ways])
        self.assertGreater(sum(entered["none"]), 10)
        laws = {law["law"]: law for law in found["laws"]}
        for law, yes in entered.items():
            share = math.fsum(w for w, y in zip(weights, yes) if y) / math.fsum(weights)
            volume = laws[law]["volumes"][0]
            self.assertAlmostEqual(volume["share"], share, delta=1e-12)
            low, high = bounds([w for w, y in zip(weights, yes) if y], max(weights), 0.95)
            self.assertAlmostEqual(volume["low"], low / math.fsum(weights), delta=1e-9)
            self.assertAlmostEqual(volume["high"], high / math.fsum(weights), delta=1e-9)
        mine = laws["x1 own"]["volumes"][0]["ratios"][0]
        self.assertEqual(mine["to"], "none")
        expected = ratio([(w, {0: a}, {0: b}) for w, a, b in zip(weights, entered["x1 own"], entered["none"])], 0, 0)
        self.assertLess(expected[0], 0.9)  # the law is of use
        for key, value in zip(("ratio", "low", "high"), expected):
            self.assertAlmostEqual(mine[key], value, delta=1e-8)
        # Needless: alerts on encounters that pass without one.
        needless = math.fsum(w for w, row, yes in zip(weights, rows, entered["none"]) if row["x1 own alert [s]"] and not yes)
        self.assertAlmostEqual(laws["x1 own"]["needless_alerts"]["share"], needless / math.fsum(weights), delta=1e-12)
        self.assertIsNone(laws["none"]["median_alert"])
        for row, (_, a, b) in zip(rows, self.ways):
            hmd, vmd = float(row["none HMD [m]"]), float(row["none VMD [m]"])
            self.assertEqual(max(hmd / RADIUS, vmd / HALF_HEIGHT) < 1, straight_enters(a, b, 60))

    def test_units_weights_and_parts(self):
        metres = self.table(12)
        with open(metres, encoding="utf-8") as f:
            lines = f.read().splitlines()
        feet = ["encounter,body,weight,t [s],x [ft],y [ft],z [ft]"]
        for line in lines[1:]:
            cells = line.split(",")
            feet.append(",".join(cells[:4] + [repr(float(x) / 0.3048) for x in cells[4:]]))
        words = ("--levels", "x1", "--laws", "own", "--volumes", "500 ft:100 ft,0.5 nmi:500 ft")
        rows, found = self.trials("metres", "--encounters", metres, *words)
        other, _ = self.trials("feet", "--encounters", self.file("feet.csv", "\n".join(feet) + "\n"), *words)
        for row, same in zip(rows, other):
            self.assertEqual(row["none within 0.5 nmi:500 ft"], same["none within 0.5 nmi:500 ft"])
            self.assertAlmostEqual(float(row["none HMD [m]"]), float(same["none HMD [m]"]), delta=1e-6)
        self.assertEqual([v["volume"] for v in found["laws"][0]["volumes"]], ["500 ft:100 ft", "0.5 nmi:500 ft"])
        self.assertGreater(found["laws"][0]["volumes"][1]["share"], found["laws"][0]["volumes"][0]["share"])
        scenario = self.path("scenario.yaml")
        for k in (1, 2, 3):
            self.assertEqual(run("trials", scenario, "--encounters", metres, *words, "--quiet", "--no-figures", "--part", f"{k}/3",
                                 "--out", self.path(f"part-{k}")).returncode, 0)
        merged = run("merge", *(self.path(f"part-{k}") for k in (1, 2, 3)), "--quiet", "--no-figures", "--out", self.path("merged"))
        self.assertEqual((merged.returncode, merged.stderr), (0, ""))
        for name in ("trials.csv", "trials.json"):
            with open(self.path("merged/" + name), "rb") as one, open(self.path("metres/" + name), "rb") as two:
                self.assertEqual(one.read(), two.read())

    def test_encounters_of_a_population(self):
        population = self.file("population.yaml", "agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\n"
                               "obstacle: {center: [4000, 0, 0], semi_axes: [1, 1, 1]}\n"
                               "agent_velocity: [60, 0, 0]\nobstacle_velocity: [-60, 0, 0]\n"
                               "drawn: {obstacle: {y: {uniform: [-3000, 3000]}, z: {uniform: [-600, 600]}}}\n"
                               "proposal: {obstacle: {y: {uniform: [-300, 300]}}}\n")
        _, found = self.trials("out", "--encounters", population, "-N", "300", "--levels", "x1", "--laws", "own")
        volume = found["laws"][0]["volumes"][0]
        share = (2 * RADIUS / 6000) * (2 * HALF_HEIGHT / 1200)  # 0.00258
        self.assertLess(volume["low"], share)
        self.assertGreater(volume["high"], share)
        self.assertLess(volume["high"], 3 * share)

    def test_what_is_wrong_is_named(self):
        scenario, table = self.file("scenario.yaml", SCENARIO % "avoidance"), self.table(2)
        with open(table, encoding="utf-8") as f:
            good = f.read()
        for text, says in ((good.replace("intruder", "intrudor"), "row 3, body: got intrudor, must be a name of the"),
                           (good.replace(",60,", ",0,"), "encounter 0, agent: got times that do not ascend, must be asc"),
                           (good.replace("weight", "wieght"), "got column wieght, must be columns encounter, body, t, x, y, z, and maybe"),
                           (re.sub(r"(?m)^0,intruder,([^,]*),0,", r"0,intruder,\1,10,", good),
                            "encounter 0, intruder, t: got 10, must be at first that of"),
                           (good.replace("z [m]", "height [m]"), "got other columns, must be columns encounter"),
                           (good.replace("x [m]", "x [kg]"), "x: got "),
                           (good.splitlines()[0] + "\n", "got "),
                           (good.replace("1,intruder", "2,intruder"), "no rows, must be a row or more of each body")):
            result = run("trials", scenario, "--encounters", self.file("wrong.csv", text), "--quiet", "--levels", "x1", "--laws", "own",
                         "--out", self.path("refused"))
            self.assertEqual((result.returncode, result.stdout), (2, ""), says)
            self.assertIn(says, result.stderr)
            self.assertEqual(result.stderr.count("\n"), 1)
            self.assertFalse(os.path.exists(self.path("refused")))
        for words, says in ((("-N", "3"), "--trials: got 3, must be at most the file's 2"),
                            (("--random",), "--random: got given, must be left out beside --encounters"),
                            (("--volumes", "500"), "--volumes: got 500, must be radius:half-height")):
            result = run("trials", scenario, "--encounters", self.file("good.csv", good), *words, "--quiet", "--levels", "x1",
                         "--laws", "own", "--out", self.path("refused"))
            self.assertEqual(result.returncode, 2)
            self.assertIn(says, result.stderr)


if __name__ == "__main__":
    unittest.main()
