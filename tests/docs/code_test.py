#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The C and C++ of the pages is that of examples/, word for word, and the block after it is what the program prints.

tests/consumer builds and runs the programs against an installation first. Environment: VERICONE_OUTPUTS, a folder with
what each program NAME printed in the file NAME; VERICONE_SOURCE (the project)."""

import os
import sys
import unittest
from pathlib import Path

from pages import ROOT, blocks, pages, text_of

FRAGMENTS = 0  # blocks that are no programs, `<!-- not compiled: WHY -->`


class Code(unittest.TestCase):
    maxDiff = None

    def test_programs_and_what_they_print(self):
        programs = {text_of(path).rstrip("\n"): path.stem for path in (ROOT / "examples").glob("*.c*")}
        printed = {name: text_of(Path(os.environ["VERICONE_OUTPUTS"]) / name).rstrip("\n") for name in programs.values()}
        shown, fragments, wrong = set(), 0, []
        for page in pages():
            found = blocks(page)
            for block, after in zip(found, found[1:] + [None]):
                if block.language not in ("c", "cpp"):
                    continue
                if block.note[:1] == ("not compiled",):
                    fragments += 1
                    continue
                name = programs.get(block.text)
                if name is None:
                    wrong.append(f"{block}: not a program of examples/")
                elif after is None or after.language != "text" or after.text != printed[name]:
                    wrong.append(f"{block}: the block after it is not what {name} prints:\n{printed[name]}")
                shown.add(name)
        self.assertEqual("\n".join(wrong), "")
        self.assertEqual(set(programs.values()) - shown, set())
        self.assertEqual(fragments, FRAGMENTS)


if __name__ == "__main__":
    sys.exit(unittest.main())
