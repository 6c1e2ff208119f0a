# SPDX-License-Identifier: BSD-3-Clause
"""vericone swarm: what it counts against its own tables, both methods, threads, refusals. Environment as for command.py."""
import csv
import json
import math
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from command import run  # noqa: E402


class Swarms(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = os.path.join(folder.name, "out")

    def swarm(self, *words):
        result = run("swarm", *words, "--no-figures", "--quiet", "--json", "--out", self.out)
        self.assertEqual(result.stderr, "")
        return result.returncode, json.loads(result.stdout)

    def table(self, name):
        with open(os.path.join(self.out, name), encoding="utf-8") as file:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]

    def files(self):
        found = {}
        for name in ("positions.csv", "agents.csv", "obstacles.csv", "summary.json"):
            with open(os.path.join(self.out, name), "rb") as file:
                found[name] = file.read()
        return found

    def test_counts_what_its_tables_have(self):
        status, summary = self.swarm("forest", "-N", "9", "--seed", "5")
        self.assertEqual((status, summary["touched"], summary["undecided"], summary["arrived"]), (0, 0, 0, 9))
        agents = self.table("agents.csv")
        self.assertEqual(max(row["arrived"] for row in agents), summary["last_arrival"])
        self.assertAlmostEqual(sum(row["path"] for row in agents) / sum(row["straight"] for row in agents),
                               summary["path_ratio"], delta=1e-12)
        self.assertEqual(len(self.table("obstacles.csv")), 90)
        rows = self.table("positions.csv")
        first = {row["agent"]: row for row in rows if row["t"] == 0}
        for agent in agents:  # the way is no shorter than its samples say
            own = [row for row in rows if row["agent"] == agent["agent"] and row["t"] <= agent["arrived"]]
            way = sum(math.dist([a[k] for k in "xyz"], [b[k] for k in "xyz"]) for a, b in zip(own, own[1:]))
            self.assertGreaterEqual(agent["path"], way - 1e-9)
            self.assertIn(agent["agent"], first)

    def test_orca_touches_where_the_other_does_not(self):
        status, proved = self.swarm("circle", "-N", "24", "--seed", "2")
        self.assertEqual((status, proved["touched"]), (0, 0))
        self.assertGreater(proved["least_distance"], 0)
        status, orca = self.swarm("circle", "-N", "24", "--seed", "2", "--method", "orca")
        self.assertEqual(status, 0)
        self.assertGreater(orca["touched"], 0)
        self.assertEqual(len(orca["touched_pairs"]), orca["touched"])

    def test_writes_the_same_on_any_number_of_threads(self):
        found = []
        for threads in ("1", "2", "4"):
            self.swarm("slender", "-N", "40", "--duration", "30", "--threads", threads, "--lost", "0.05")
            found.append(self.files())
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])

    def test_refuses_in_one_line(self):
        for words, line in (
                (["square"], "start: got square, must be circle, sphere, crossing, gap, forest or slender"),
                (["circle", "--method", "rvo"], "--method: got rvo, must be proved or orca"),
                (["circle", "-N", "2000000"], "--agents: got 2000000, must be 1 to 1000000"),
                (["circle", "--step", "0"], "--step: got 0, must be a positive finite number"),
                (["circle", "--lost", "2"], "--lost: got 2, must be 0 to 1"),
                (["circle", "--duration", "-1"], "--duration: got -1, must be a positive finite number (seconds)")):
            with self.subTest(line):
                result = run("swarm", *words, "--quiet", "--out", self.out)
                self.assertEqual((result.returncode, result.stdout), (2, ""))
                self.assertEqual(result.stderr, "vericone: " + line + "\n")
                self.assertFalse(os.path.exists(self.out))


if __name__ == "__main__":
    unittest.main()
