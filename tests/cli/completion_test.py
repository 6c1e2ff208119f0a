# SPDX-License-Identifier: BSD-3-Clause
"""Completion for bash, against the helps."""
import os
import re
import subprocess
import unittest

from command import SOURCE, VERICONE, run

SCRIPT = os.path.join(SOURCE, "apps", "completion", "vericone.bash")


class Completion(unittest.TestCase):
    def words(self, *typed):
        """What bash offers for the last word."""
        script = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _vericone; printf "%s\\n" "${COMPREPLY[@]}"'
        done = subprocess.run(["bash", "-c", script, "bash", SCRIPT, VERICONE, *typed], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return [line for line in done.stdout.splitlines() if line]

    def test_commands(self):
        text = run("--help").stdout
        self.assertEqual(self.words(""), re.findall(r"^  ([a-z][a-z-]*) ", text, re.MULTILINE))
        self.assertIn("pursue", self.words(""))
        # Each stands in the group of its job.
        groups = {title: re.findall(r"^  ([a-z-]+) ", rows, re.MULTILINE)
                  for title, rows in re.findall(r"^([A-Z][^\n]*):\n((?:  [a-z].*\n)+)", text, re.MULTILINE)}
        self.assertEqual(sum(groups.values(), []), self.words(""))
        self.assertIn("query", groups["Verdicts and cones"])
        self.assertIn("simulate", groups["Flights"])
        self.assertIn("fit", groups["Scans, meshes and maps"])
        self.assertIn("figures", groups["Papers and pictures"])
        self.assertEqual(self.words("sim"), ["simulate"])
        self.assertEqual(self.words("bogus"), [])

    def test_options(self):
        self.assertEqual(self.words("cone", "scene.yaml", "--js"), ["--json"])
        self.assertEqual(self.words("cone", "--tol"), ["--tolerance"])
        for command in ("cone", "query"):
            offered = self.words(command, "--")
            for option in offered:
                self.assertRegex(run(command, "--help").stdout, re.escape(option) + r"\b")
            self.assertIn("--help", offered)

    def test_kinds_of_schemas(self):
        self.assertEqual(sorted(self.words("schema", "")), ["body", "claims", "figures", "population", "pursuit", "scan", "scenario", "scene",
                                                           "tracks"])
        self.assertEqual(self.words("schema", "sc"), ["scene", "scenario", "scan"])

    def test_files_are_left_to_bash(self):
        self.assertEqual(self.words("cone", "sce"), [])


if __name__ == "__main__":
    unittest.main()
