#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""All scenarios of docs/examples and papers: what is proved of them has a certificate that checker/vericone_check.py accepts, but
what stands in WITHOUT, with its reason. Prints the table of docs/measured/certificates.md. Those whose meshes and maps are not
here are named. Environment: VERICONE (the command), VERICONE_SOURCE (the project), VERICONE_ONLY (names with this text alone)."""
import glob
import json
import os
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ["VERICONE_SOURCE"]
CHECKER = os.path.join(SOURCE, "checker", "vericone_check.py")
SCENARIOS = sorted(glob.glob(os.path.join(SOURCE, "docs/examples/scenarios/*.yaml")) +
                   glob.glob(os.path.join(SOURCE, "papers/*/scenarios/*.yaml")))

# Scenario: (what, a text of the reason) of all that have none, or less than the run says.
ENDS, DENTS = "not wholly on both sides", "planes do not reach into dents"
WITHOUT = {"orifices": [("A, window", ENDS)], "grazing": [("A, B", "as near as 1.0")], "2.4-ours-oblique": [("fish, two", ENDS)],
           "2.4-rings-source": [("fish, first", "they touch")], "5.4.1-clearance": [("F1, F3", "one has dents")],
           "5.4.1": [("F1, F3", DENTS)], "5.4.2": [("F1, F2", DENTS)]}


def simulated(scenario, folder):
    """(what is said as JSON, the file of certificates or None), or why there is no run."""
    out = os.path.join(folder, "out")
    done = subprocess.run([os.environ["VERICONE"], "simulate", scenario, "--out", out, "--quiet", "--no-figures", "--json",
                           "--certificate"], capture_output=True, text=True, check=False)
    if done.returncode:
        return done.stderr.strip(), None
    path = os.path.join(out, "certificate.json")
    return json.loads(done.stdout), path if os.path.exists(path) else None


class Scenarios(unittest.TestCase):
    def test_what_is_proved_has_a_certificate(self):
        self.assertGreater(len(SCENARIOS), 30)
        seen = 0
        print("| scenario | certificates: pairs apart, near, in contact, passages | kB | to check, s | none of, why |")
        print("|---|---|---|---|---|")
        for scenario in SCENARIOS:
            name = os.path.splitext(os.path.basename(scenario))[0]
            if os.environ.get("VERICONE_ONLY", "") not in name:
                continue
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                said, path = simulated(scenario, folder)
                if isinstance(said, str):
                    print(f"| {name} | not here: {said[:90]} | | | |", flush=True)
                    self.assertRegex(said, r"\.(off|obj|ply|bt|stl)")
                    continue
                counts, size, seconds = {"apart": 0, "near": 0, "meet": 0, "passed": 0}, 0, 0.0
                if path:
                    size = os.path.getsize(path)
                    before = os.times()
                    checked = subprocess.run([sys.executable, CHECKER, path], capture_output=True, text=True, check=False)
                    after = os.times()
                    seconds = after.children_user - before.children_user
                    self.assertEqual(checked.returncode, 0, checked.stdout[-2000:])
                    with open(path, encoding="utf-8") as file:
                        claims = [json.loads(line)["claim"] for line in file]
                    for claim in claims:
                        counts[claim["says"]] += len(claim.get("pairs", [0]))
                    self.assertEqual(checked.stdout.count("accepted: "), len(claims))
                none = said["certificate"]["none"]
                print(f"| {name} | {', '.join(map(str, counts.values()))} | {size / 1000:.0f} | {seconds:.1f} | " +
                      "; ".join(f"{one['what']}: {one['reason']}" for one in none) + " |", flush=True)
                seen += 1
                known = WITHOUT.get(name, [])
                self.assertEqual([one["what"] for one in none], [what for what, _ in known])
                for one, (_, reason) in zip(none, known):
                    self.assertIn(reason, one["reason"])
        self.assertGreater(seen, 0)


if __name__ == "__main__":
    unittest.main()
