#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""docs/reference/commands.md is what the helps say. Environment: VERICONE, VERICONE_SOURCE, VERICONE_PROGRAMS."""

import os
import shutil
import subprocess
import sys
import unittest

import commands
from pages import ROOT, text_of


class Commands(unittest.TestCase):
    maxDiff = None

    def test_the_page_is_written_from_the_helps(self):
        if not {"fit", "scan", "track", "verify"} <= set(os.environ["VERICONE_PROGRAMS"].split()):
            self.skipTest("needs the programs fit, scan and verify")
        written = "".join("\n".join(map(commands.wrapped, part.split("\n"))) + "\n"
                          for part in commands.reference(os.environ["VERICONE"]))
        self.assertEqual(written, text_of(ROOT / "docs/reference/commands.md"),
                         "write it again: tests/docs/commands.py says how")

    def test_the_manual_page_is_written_from_the_helps(self):
        if not {"fit", "scan", "track", "verify"} <= set(os.environ["VERICONE_PROGRAMS"].split()):
            self.skipTest("needs the programs fit, scan and verify")
        page = ROOT / "apps/completion/vericone.1"
        self.assertEqual("".join(part + "\n" for part in commands.manual(os.environ["VERICONE"])), text_of(page),
                         "write it again: tests/docs/commands.py says how")
        if not shutil.which("groff"):
            self.skipTest("its look: needs groff")
        shown = subprocess.run(["groff", "-man", "-Tascii", "-ww", str(page)], capture_output=True, text=True, check=True)
        self.assertEqual(shown.stderr, "")
        self.assertIn("--resolution", shown.stdout)

    def test_every_command_has_an_example(self):
        self.assertEqual({name for name, _ in commands.commands(os.environ["VERICONE"])}, set(commands.EXAMPLES))


if __name__ == "__main__":
    sys.exit(unittest.main())
