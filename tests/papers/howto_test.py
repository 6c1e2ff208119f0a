# SPDX-License-Identifier: BSD-3-Clause
"""The how-to of docs/reference/papers.md, word by word, in an empty folder: it ends in claims, figures and report."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
VERICONE = os.environ["VERICONE"]


class HowTo(unittest.TestCase):
    def test_word_by_word(self):
        with open(os.path.join(ROOT, "docs", "reference", "papers.md"), encoding="utf-8") as page:
            section = re.search(r"^## Add a paper$.*?(?=^## )", page.read(), re.MULTILINE | re.DOTALL).group(0)
        blocks = re.findall(r"^```bash\n(.*?)^```$", section, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(blocks), 5)
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "run"), "w", encoding="utf-8") as run:
                run.write('#!/bin/sh\nexec "%s" "$@"\n' % VERICONE)
            os.chmod(os.path.join(folder, "run"), 0o755)
            os.mkdir(os.path.join(folder, "papers"))
            result = subprocess.run(["bash", "-e", "-c", "\n".join(blocks)], cwd=folder, capture_output=True, text=True,
                                    timeout=250)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            made = os.path.join(folder, "out", "mine")
            with open(os.path.join(made, "claims.json"), encoding="utf-8") as file:
                claims = json.load(file)["claims"]
            self.assertGreaterEqual(len(claims), 4)
            for name in ("fig-1.png", "fig-2.pdf", "fig-2.csv", "report.html", os.path.join("runs", "wall", "bodies.csv")):
                self.assertGreater(os.path.getsize(os.path.join(made, name)), 0, name)
            with open(os.path.join(made, "report.html"), encoding="utf-8") as file:
                report = file.read()
            self.assertEqual(len(re.findall("data:image/png", report)), 2)
            self.assertIn("A ball and a wall", report)


if __name__ == "__main__":
    sys.exit(unittest.main())
