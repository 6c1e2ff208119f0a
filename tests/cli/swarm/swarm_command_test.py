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
        self.folder = folder.name
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

    def test_flies_the_agents_of_a_scenario(self):
        scenario = os.path.join(self.folder, "three.yaml")
        with open(scenario, "w", encoding="utf-8") as file:
            file.write("step: 0.1\nduration: 90\nbodies:\n")
            for k, orientation in enumerate(("fixed", "heading", "fixed")):
                file.write(f"  - name: agent{k}\n    shape: {{semi_axes: [1.5, 0.5, 0.5]}}\n    position: [0, {6 * k}, 0]\n"
                           f"    velocity: [0, 0, 0]\n    orientation: {orientation}\n"
                           "    pilot: {law: clearance, clearance: {required: 0.1, longitudinal: true}, most: 2, fastest: 1.5,\n"
                           f"            goal: {{point: [30, {12 - 6 * k}, 0], most: 2}}}}\n")
            file.write("  - name: rock\n    shape: {semi_axes: [2, 4, 1]}\n    position: [15, 6, 0]\n    velocity: [0, 0, 0]\n")
        status, summary = self.swarm(scenario)
        self.assertEqual((status, summary["start"], summary["step"], summary["agents"], summary["obstacles"]),
                         (0, "three", 0.1, 3, 1))
        self.assertEqual((summary["touched"], summary["undecided"], summary["arrived"]), (0, 0, 3))
        result = run("swarm", scenario, "-N", "4", "--quiet", "--out", self.out + "2")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertEqual(result.stderr, "vericone: --agents: got 4, must be left out: the scenario has its agents\n")

    def test_says_what_arrived_means_and_where_there_is_no_pair(self):
        result = run("swarm", "circle", "-N", "1", "--no-figures", "--quiet", "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("0 undecided, no others: proved\n", result.stdout)
        self.assertIn("arrived   1 of 1 within their reach of the last goal, the last after ", result.stdout)
        result = run("swarm", "circle", "-N", "3", "--duration", "2", "--no-figures", "--quiet", "--out", self.out + "2")
        self.assertIn("arrived   0 of 3 within their reach of the last goal, in 2 s;", result.stdout)

    def test_writes_the_same_on_any_number_of_threads(self):
        found = []
        for threads in ("1", "2", "4"):
            self.swarm("slender", "-N", "40", "--duration", "30", "--threads", threads, "--lost", "0.05")
            found.append(self.files())
        self.assertEqual(found[0], found[1])
        self.assertEqual(found[0], found[2])

    def test_refuses_in_one_line(self):
        for words, line in (
                (["square"], "start: got square, must be circle, sphere, crossing, gap, forest, slender, turning, room, "
                             "imazu-01 to imazu-22, harbour or a scenario's file"),
                (["circle", "-N", "3", "--step", "1e9"], "--duration: got 600, must be at least a step (seconds)"),
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
