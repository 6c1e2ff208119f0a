# SPDX-License-Identifier: BSD-3-Clause
"""`vericone campaign --verdicts`: the same bytes for any number of threads and parts, in memory that does not grow; shares
against closed forms. Environment as for command.py."""
import json
import math
import os
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), ".."))
from command import SOURCE, VERICONE, contents, run

BALLS = ("agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\n"
         "obstacle: {center: [1000, 0, 0], semi_axes: [2, 2, 2]}\nagent_velocity: [100, 0, 0]\n")
FIXED = BALLS + "drawn: {agent: {vy: {normal: [0, 1]}, vz: {normal: [0, 1]}}}\n"
RARE = (BALLS + "drawn: {obstacle: {y: {normal: [0, 2121.319]}, z: {normal: [0, 2121.319]}}}\n"
        "proposal: {obstacle: {y: {normal: [0, 3]}, z: {normal: [0, 3]}}}\nper_hour: 20\n")


class Populations(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def file(self, text, name="population.yaml"):
        with open(self.path(name), "w", encoding="utf-8") as f:
            f.write(text)
        return self.path(name)

    def campaign(self, text, out, *words):
        result = run("campaign", "--verdicts", self.file(text), "--quiet", "--no-figures", "--out", self.path(out), *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def test_threads_and_parts_change_no_byte(self):
        for name, text, count in (("fixed", FIXED, 300_001), ("rare", RARE, 10_000)):
            for threads in (1, 2, 4):
                self.campaign(text, f"{name}-{threads}", "-N", str(count), "--threads", str(threads))
            whole = contents(self.path(f"{name}-1"))
            self.assertEqual(set(whole), {"blocks.csv", "summary.json"})
            self.assertEqual(contents(self.path(f"{name}-2")), whole)
            self.assertEqual(contents(self.path(f"{name}-4")), whole)
            parts = [f"{name}-part-{k}" for k in range(1, 17)]
            for k, part in enumerate(parts, 1):
                self.campaign(text, part, "-N", str(count), "--part", f"{k}/16")
            result = run("merge", *map(self.path, parts), "--quiet", "--no-figures", "--out", self.path(f"{name}-merged"))
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(contents(self.path(f"{name}-merged")), whole)

    def test_a_share_of_one_in_a_million(self):
        share = -math.expm1(-0.5 * (3 / 2121.319) ** 2)
        found = json.loads(self.campaign(RARE, "rare", "-N", "10000", "--json"))
        self.assertLess(abs(found["share"] - share), 0.05 * share)
        for bounds in (found, found["covered"]):
            self.assertLess(bounds["low"], found["share"])
            self.assertGreater(bounds["high"], found["share"])
        self.assertLess(found["covered"]["high"] - found["covered"]["low"], 0.12e-6)
        self.assertGreater(found["low"], 0.8 * found["share"])
        self.assertEqual(found["largest_weight"], 10)
        self.assertEqual((found["interval"], found["uncovered"]), ("Waudby-Smith and Ramdas", 0))
        self.assertAlmostEqual(found["per_hour"]["collisions"], 20 * found["share"], delta=1e-12)
        # The sums are those of the blocks, by a reader of another kind.
        with open(self.path("rare/blocks.csv"), encoding="utf-8") as f:
            lines = f.read().splitlines()
        columns = lines[1].split(",")
        rows = [dict(zip(columns, map(float, line.split(",")))) for line in lines[2:]]
        self.assertEqual(sum(row["encounters"] for row in rows), 10_000)
        self.assertAlmostEqual(math.fsum(row["collides"] for row in rows) / 10_000, found["share"], delta=1e-15)
        self.assertEqual(found["growth"][-1]["share"], found["share"])

    def test_what_it_tells(self):
        text = self.campaign(FIXED, "fixed", "-N", "100000", "--seed", "4")
        # Directions whose tangent across is below that of asin(3 / 1000).
        share = -math.expm1(-0.5 * (100 * math.tan(math.asin(0.003))) ** 2)
        with open(self.path("fixed/summary.json"), encoding="utf-8") as f:
            found = json.load(f)
        self.assertLess(abs(found["share"] - share), 4 * math.sqrt(share / 100_000))
        self.assertEqual(text.splitlines()[0],
                         f"100000 encounters, 100000 verdicts: {found['in']} collide (0 now), 0 touch, 0 undecided")
        self.assertRegex(text.splitlines()[1], r"^share     0\.\d+, with 95 % confidence between .* \(Clopper and Pearson\)$")
        few = self.campaign(RARE.replace("[0, 3]", "[0, 900]"), "few", "-N", "1000")
        self.assertIn("few collisions carry this share", few)
        # A proposal above the way, of a population of which half of what collides is below it.
        missed = self.campaign(RARE.replace("2121.319", "10").replace("z: {normal: [0, 3]}", "z: {uniform: [0, 3]}"), "missed",
                               "-N", "10000")
        self.assertRegex(missed, r"\nuncovered \d+ collisions were drawn where the proposal hardly draws: ")

    def test_strata(self):
        text = FIXED + "strata: {of: agent.vz, edges: [-0.4, 0.4]}\n"
        share = -math.expm1(-0.5 * (100 * math.tan(math.asin(0.003))) ** 2)
        found = json.loads(self.campaign(text, "strata", "-N", "30000", "--json"))
        self.assertLess(abs(found["share"] - share), 4 * math.sqrt(share / 30_000))
        self.assertLess(found["low"], share)
        self.assertGreater(found["high"], share)
        self.assertAlmostEqual(found["mean_weight"], 1, delta=1e-12)  # since each stratum has as many
        result = run("campaign", "--verdicts", self.file(text), "-N", "1000", "--out", self.path("no"))
        self.assertEqual((result.returncode, result.stderr),
                         (2, f"vericone: -N: got 1000, must be a multiple of 3, the strata of {self.path('population.yaml')}\n"))
        for bad, said in (("of: agent.vx, edges: [0]", "strata.of: got agent.vx, must be one of what `drawn` has, such as obstacle.x"),
                          ("of: agent.vz, edges: [1, 0]", "strata.edges[1]: got 0, must be ascending, with a probability"),
                          ("of: agent.vz, edges: [9]", "strata.edges[0]: got 9, must be ascending, with a probability")):
            result = run("campaign", "--verdicts", self.file(FIXED + "strata: {" + bad + "}\n"), "--out", self.path("no"))
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn(said, result.stderr)

    def test_refusals_name_the_file(self):
        result = run("campaign", "--verdicts", self.file("# nothing\n"), "--out", self.path("no"))
        self.assertEqual((result.returncode, result.stderr),
                         (2, f"vericone: {self.path('population.yaml')}: got nothing, must be a population: a mapping of fields "
                             "(docs/reference/formats.md)\n"))
        result = run("campaign", "-N", "1", "-N", "2")
        self.assertEqual((result.returncode, result.stderr),
                         (2, "vericone: --engagements: given 2 times, must be given once (see vericone campaign --help)\n"))
        wide = FIXED.replace("vy: {normal: [0, 1]}", "vy: {uniform: [-1e308, 1e308]}")
        self.assertIn("drawn.agent.vy.uniform: got ", run("campaign", "--verdicts", self.file(wide), "--out", self.path("no")).stderr)

    def test_memory_does_not_grow(self):
        words = [VERICONE, "campaign", "--verdicts", self.file(FIXED), "--quiet", "--no-figures", "--threads", "1", "-N", "10000000"]
        script = "import resource, subprocess, sys; subprocess.run(sys.argv[1:], check=True, stdout=subprocess.DEVNULL); " \
                 "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss)"
        result = subprocess.run([sys.executable, "-c", script, *words, "--out", self.path("many")], capture_output=True, text=True,
                                check=True)
        self.assertLess(int(result.stdout), 200_000)  # kB

    def test_the_examples_run(self):
        folder = os.path.join(SOURCE, "docs/examples/populations")
        for name in sorted(os.listdir(folder)):
            result = run("campaign", "--verdicts", os.path.join(folder, name), "-N", "500", "--quiet", "--no-figures", "--json",
                         "--out", self.path(name))
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(json.loads(result.stdout)["encounters"], 500)


if __name__ == "__main__":
    unittest.main()
