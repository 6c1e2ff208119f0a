# SPDX-License-Identifier: BSD-3-Clause
"""`vericone law`: states in, what pursuit laws command out. `vericone estimate`: a measured track through Singer's filter."""
import csv
import json
import math
import os
import random
import subprocess
import tempfile
import unittest
from pathlib import Path

from command import VERICONE

EXAMPLES = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2])) / "docs/examples"


def call(*words, given=""):
    return subprocess.run([VERICONE, *map(str, words)], input=given, capture_output=True, text=True, timeout=60, check=False)


def laws(*cases):
    result = call("law", "-", given="\n".join(map(json.dumps, cases)) + "\n")
    return result.returncode, [json.loads(line) for line in result.stdout.splitlines()]


class PursuitLaws(unittest.TestCase):
    def test_the_example(self):
        result = call("law", EXAMPLES / "law.jsonl")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        lane, parked, focal, between, vertical, ours = map(json.loads, result.stdout.splitlines())
        # errata 4.3
        self.assertAlmostEqual(lane["lateral"], -0.818093, 6)
        self.assertAlmostEqual(lane["longitudinal"], -0.909, 6)
        self.assertAlmostEqual(lane["y1"], 74364.5, 1)
        self.assertEqual((parked["status"], parked["acceleration"]), ("singular", [0, 0]))
        self.assertAlmostEqual(focal["y1"] / 4.84422e8, 1, 5)
        self.assertAlmostEqual(focal["ellipse"]["semi_axes"][0], 22.06463, 5)
        self.assertEqual((between["status"], between["in_cone"], between["least_sum"] < 0), ("steering", True, True))
        self.assertEqual(vertical["mode"], "altitude")
        self.assertAlmostEqual(ours["y1"], focal["y1"], delta=1e-6 * focal["y1"])
        self.assertEqual((ours["in_cone"], ours["probability"]), (False, 0))
        self.assertLess(ours["y1_bounds"][0], ours["y1"])
        self.assertGreater(ours["y1_bounds"][1], ours["y1"])
        self.assertLessEqual(math.hypot(*ours["acceleration"]), 10 + 1e-9)

    def test_the_source_has_no_command_between_the_foci_and_the_polynomial_has(self):
        case = {"law": "focal", "agent": {"position": [0, 0], "velocity": [20, 0]}, "foci": [[100, -10], [100, 14]],
                "foci_velocities": [[5, 0], [5, 0]], "a": 20}
        status, (source, polynomial) = laws(case, {**case, "form": "polynomial"})
        self.assertEqual(status, 0)
        self.assertEqual((source["status"], source["in_layer"]), ("singular", True))
        self.assertEqual((polynomial["status"], polynomial["in_layer"]), ("steering", False))

    def test_gains_are_used(self):
        case = {"law": "vertical", "size": 127, "size_rate": 0, "altitude": 425, "climb": 0}
        status, (one, other) = laws(case, {**case, "gains": {"altitude_p": 0.012}})
        self.assertEqual(status, 0)
        self.assertAlmostEqual(other["acceleration"], 2 * one["acceleration"], 9)

    def test_an_ellipse_that_outgrows_the_agent_has_no_least_sum(self):
        status, (answer,) = laws({"law": "focal", "agent": {"position": [0, 0], "velocity": [0, 0]}, "a": 6, "a_rate": 2,
                                  "foci": [[100, 0], [110, 0]], "foci_velocities": [[1, 0], [1, 0]]})
        self.assertEqual((status, answer["least_sum"]), (0, None))


def track(rows):
    return "t,x,y\n" + "".join("%r,%s,%s\n" % (t, "" if x is None else repr(x), "" if y is None else repr(y)) for t, x, y in rows)


class Estimate(unittest.TestCase):
    def test_times_may_be_seconds_since_1970(self):
        rows = [(k / 4, 40 * k + k % 3, -15 * k) for k in range(40)]  # exact in doubles, also after a shift
        told = []
        for start in (0, 1731000000):
            with tempfile.TemporaryDirectory() as folder:
                file = Path(folder, "track.csv")
                file.write_text(track([(start + t, x, y) for t, x, y in rows]))
                result = call("estimate", file, "--json")
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            told.append(json.loads(result.stdout)["rows"])
        self.assertEqual([[row[0] + 1731000000, *row[1:]] for row in told[0]], told[1])

    def test_the_example(self):
        result = call("estimate", EXAMPLES / "track.csv", "--noise", 0.3)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        rows = list(csv.DictReader(result.stdout.splitlines()))
        self.assertEqual(len(rows), 101)
        self.assertEqual([row["t"] for row in rows if not row["nis"]][1], "5")  # the first row, then hidden ones
        self.assertLess(abs(float(rows[-1]["vx"]) - 22.22), 0.5)
        told = json.loads(call("estimate", EXAMPLES / "track.csv", "--noise", 0.3, "--json").stdout)
        self.assertEqual((told["measured"], told["hidden"], len(told["rows"])), (81, 20, 101))
        self.assertEqual([float(rows[50][name]) for name in told["columns"][:-1]], told["rows"][50][:-1])

    def test_noise_is_filtered_and_deviations_are_true(self):
        rng = random.Random(3)
        rows = [(0.1 * i, 15 * 0.1 * i + rng.gauss(0, 2), 3 + rng.gauss(0, 2)) for i in range(400)]
        out = list(csv.DictReader(call("estimate", "-", "--noise", 2, given=track(rows)).stdout.splitlines()))
        within = sum(abs(float(r["x"]) - 15 * float(r["t"])) < 2 * float(r["sx"]) for r in out[50:])
        self.assertGreater(within / 350, 0.85)
        self.assertLess(float(out[-1]["sx"]), 1)

    def test_hidden_targets(self):
        rows = [(0.1 * i, 2.0 * i if i < 100 else None, 0.0 if i < 100 else None) for i in range(150)]
        ours, source = (list(csv.DictReader(call("estimate", "-", "--hidden", how, given=track(rows)).stdout.splitlines()))
                        for how in ("skip", "source"))
        self.assertLess(abs(float(ours[-1]["x"]) - 298), 1)
        self.assertGreater(298 - float(source[-1]["x"]), 10)  # the source's falls behind
        self.assertGreater(float(ours[-1]["sx"]), 2 * float(source[-1]["sx"]))

    def test_before_the_first_measurement_nothing_is_said(self):
        rows = [(0.0, None, None), (0.1, 1.0, 2.0)]
        out = list(csv.DictReader(call("estimate", "-", given=track(rows)).stdout.splitlines()))
        self.assertEqual([out[0]["x"], out[0]["sx"], out[1]["x"]], ["", "", "1"])

    def test_a_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            result = call("estimate", EXAMPLES / "track.csv", "--out", folder)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            self.assertEqual(sorted(os.listdir(folder)), ["estimate.csv", "estimate.json", "provenance.json"])
            with open(os.path.join(folder, "estimate.csv"), encoding="utf-8") as f:
                self.assertEqual(f.read(), call("estimate", EXAMPLES / "track.csv").stdout)


if __name__ == "__main__":
    unittest.main()
