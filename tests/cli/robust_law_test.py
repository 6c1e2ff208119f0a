# SPDX-License-Identifier: BSD-3-Clause
"""`vericone robust-law`: instances of (7.20)-(7.24) in, corrections out."""
import json
import os
import subprocess
import unittest
from pathlib import Path

from command import VERICONE

EXAMPLES = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2])) / "docs/examples"
CASE = {"id": 1, "z": -0.05, "K": 2, "nu": 1.4, "lambda": 0.03, "dt": 0.01, "mu": 2, "Q": 1, "R": 1e-5,
        "u_min": -15, "u_max": 15, "sign_b": -1}


def answers(*cases):
    lines = "\n".join(case if isinstance(case, str) else json.dumps(case) for case in cases) + "\n"
    result = subprocess.run([VERICONE, "robust-law", "-"], input=lines, capture_output=True, text=True, timeout=60)
    return result.returncode, [json.loads(line) for line in result.stdout.splitlines()]


class RobustLaw(unittest.TestCase):
    def test_the_example(self):
        result = subprocess.run([VERICONE, "robust-law", EXAMPLES / "robust-law.jsonl"], capture_output=True, text=True,
                                timeout=60)
        self.assertEqual(result.returncode, 0, result.stderr)
        found = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual([x["status"] for x in found], ["solved", "infeasible", "solved", "infeasible"])
        self.assertEqual([x["limit"] for x in found], [None, "saturation", None, "attenuation"])
        for x in found:
            self.assertEqual(list(x), ["id", "status", "limit", "gain", "delta", "gamma", "norm"])

    def test_the_sign_of_b_turns_the_correction(self):
        status, (one, other) = answers(CASE, {**CASE, "sign_b": 1})
        self.assertEqual(status, 0)
        self.assertAlmostEqual(one["delta"], -other["delta"], 9)
        self.assertLess(one["delta"], 0)  # z < 0 and b < 0: a negative command raises y

    def test_bad_lines_name_their_field_and_the_others_are_answered(self):
        without = {k: v for k, v in CASE.items() if k != "z"}
        bad = [("b_min", {**CASE, "b_min": 0.04}), ("dt", {**CASE, "dt": 0}), ("z", without), ("mu", {**CASE, "mu": -1}),
               ("nu", {**CASE, "nu": 0}), ("a", {**CASE, "a": [0.5, 1.5]}), ("sign_b", {**CASE, "sign_b": 2}),
               ("u_max", {**CASE, "u_max": -20}), ("polytope", {**CASE, "polytope": "mine"}),
               ("k", {**CASE, "k": 1}), ("line 11", "{")]
        status, found = answers(*[case for _, case in bad], CASE)
        self.assertEqual(status, 2)
        self.assertEqual(found[-1]["status"], "solved")
        for (field, _), answer in zip(bad, found):
            self.assertTrue(answer["error"].startswith(field + ": got "), (field, answer))


if __name__ == "__main__":
    unittest.main()
