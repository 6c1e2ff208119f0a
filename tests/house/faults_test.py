#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Planted faults (tests/faults) still fit the sources: each would be planted, none is compiled here."""

import os
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
FAULTS = sorted((ROOT / "tests/faults").glob("*.patch"))


class Faults(unittest.TestCase):
    @unittest.skipUnless(shutil.which("patch"), "Debian's patch is not installed")
    def test_each_applies(self):
        """With the options of scripts/faults."""
        self.assertGreater(len(FAULTS), 150)
        for fault in FAULTS:
            with self.subTest(fault.stem):
                tried = subprocess.run(["patch", "-p1", "--fuzz=2", "--forward", "--dry-run", "-i", fault], cwd=ROOT,
                                       stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
                self.assertEqual(tried.returncode, 0, tried.stdout + tried.stderr)

    def test_each_says_what_is_wrong_and_what_notices_it(self):
        for fault in FAULTS:
            with self.subTest(fault.stem):
                first, second = fault.read_text(encoding="utf-8").splitlines()[:2]
                self.assertRegex(first, r"^fault: \S")
                self.assertRegex(second, r"^noticed-by: \S")
                re.compile(second.removeprefix("noticed-by: "))

    def test_the_table_has_no_others(self):
        table = (ROOT / "tests/faults/RESULTS.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| ([a-z0-9-]+) \|", table, re.MULTILINE)
        self.assertEqual(sorted(set(rows) - {fault.stem for fault in FAULTS} - {"name"}), [])


if __name__ == "__main__":
    sys.exit(unittest.main())
