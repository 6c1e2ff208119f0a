#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""docs/reference/commands.md is what the helps say. Environment: VERICONE, VERICONE_SOURCE, VERICONE_PROGRAMS."""

import os
import shutil
import subprocess
import sys
import unittest

import commands
import manual
from pages import ROOT, text_of


class Commands(unittest.TestCase):
    maxDiff = None

    def test_the_page_is_written_from_the_helps(self):
        if not {"fit", "mpi", "pursue", "rows", "scan", "track", "verify"} <= set(os.environ["VERICONE_PROGRAMS"].split()):
            self.skipTest("needs the programs fit, mpi, pursue, rows, scan, track and verify")
        written = "".join("\n".join(map(commands.wrapped, part.split("\n"))) + "\n"
                          for part in commands.reference(os.environ["VERICONE"]))
        self.assertEqual(written, text_of(ROOT / "docs/reference/commands.md"),
                         "write it again: tests/docs/commands.py says how")

    def test_the_manual_page_has_the_helps(self):
        page = "".join(part + "\n" for part in manual.manual(os.environ["VERICONE"]))
        for name, _ in commands.commands(os.environ["VERICONE"]):
            self.assertIn("\n.SS " + name.replace("-", "\\-") + "\n", page)
        if not shutil.which("groff"):
            self.skipTest("its look: needs groff")
        shown = subprocess.run(["groff", "-man", "-Tascii", "-ww"], input=page, capture_output=True, text=True, check=True)
        self.assertEqual(shown.stderr, "")
        self.assertIn("--resolution", shown.stdout)

    def test_every_command_has_an_example(self):
        self.assertEqual({name for name, _ in commands.commands(os.environ["VERICONE"])}, set(commands.EXAMPLES))


if __name__ == "__main__":
    sys.exit(unittest.main())
