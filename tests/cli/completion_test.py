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
        listed = run("--help").stdout.split("Subcommands:\n")[1].split("\n\n")[0]
        self.assertEqual(self.words(""), re.findall(r"^  ([\w-]+) ", listed, re.MULTILINE))
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

    def test_files_are_left_to_bash(self):
        self.assertEqual(self.words("cone", "sce"), [])


if __name__ == "__main__":
    unittest.main()
