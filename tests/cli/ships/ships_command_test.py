# SPDX-License-Identifier: BSD-3-Clause
"""vericone swarm of ships: its tables against each other and against its summary, refusals. Environment as for command.py."""
import csv
import json
import math
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from command import run  # noqa: E402


class Ships(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = os.path.join(folder.name, "out")

    def table(self, name):
        with open(os.path.join(self.out, name), encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_tables_and_summary_are_of_one_voyage(self):
        result = run("swarm", "imazu-10", "--no-figures", "--quiet", "--json", "--sample", "10", "--current", "0.4,-0.3", "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        summary = json.loads(result.stdout)
        self.assertEqual((summary["ships"], summary["arrived"], summary["pairs_kept"], summary["current"]), (3, 3, 3, [0.4, -0.3]))
        pairs, rows = self.table("pairs.csv"), self.table("positions.csv")
        self.assertEqual([row["starts_as"] for row in pairs], ["crossing gives way", "crossing stands on", "crossing stands on"])
        self.assertEqual([pair["starts_as"].replace(",", "") for pair in summary["pairs"]], [row["starts_as"] for row in pairs])
        # Nobody acts in the first step: CPA of the first two rows, which a current does not change.
        places = {(float(row["t"]), int(row["ship"])): (float(row["x"]), float(row["y"])) for row in rows}
        for row in pairs:
            a, b = int(row["a"]), int(row["b"])
            c = [q - p for p, q in zip(places[0, a], places[0, b])]
            w = [(q - p) / 10 - (s - r) / 10 for p, q, r, s in
                 zip(places[0, a], places[10, a], places[0, b], places[10, b])]
            tcpa = (c[0] * w[0] + c[1] * w[1]) / (w[0] ** 2 + w[1] ** 2)
            self.assertAlmostEqual(float(row["tcpa"]) / tcpa, 1, delta=0.05)
            nearest = min(math.dist(places[t, a], places[t, b]) for t, ship in places if ship == a)
            self.assertAlmostEqual(float(row["nearest"]), nearest, delta=1e-6)
        self.assertEqual(min(float(row["least_domain_distance"]) for row in pairs), summary["least_domain_distance"])

    def test_refuses_in_one_line(self):
        for words, line in (
                (["imazu-01", "-N", "5"], "--agents: got 5, must be left out with imazu-01"),
                (["imazu-01", "--method", "orca"], "--method: got orca, must be proved with imazu-01"),
                (["imazu-01", "--current", "1"], "--current: got 1 numbers, must be two: EAST,NORTH (m/s)"),
                (["imazu-01", "--step", "60"], "--step: got 60, must be 1 to 20 (s)"),
                (["circle", "--current", "1,1"], "--current: got a current, must be left out: circle has no water")):
            with self.subTest(line):
                result = run("swarm", *words, "--quiet", "--out", self.out)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertTrue(result.stderr.startswith("vericone: " + line), result.stderr)
                self.assertFalse(os.path.exists(self.out))


if __name__ == "__main__":
    unittest.main()
