# SPDX-License-Identifier: BSD-3-Clause
"""The documentation as a site: scripts/site makes it without warnings or dead links, and its pages ask for nothing but
themselves, the search too. Environment as for tests/cli/command.py."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = os.environ.get("VERICONE_SOURCE", os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__)))))
sys.path[:0] = [os.path.join(SOURCE, "tests", "viewer")]
from browser import Browser  # noqa: E402


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        out = os.path.join(folder.name, "site")
        cls.made = subprocess.run([os.path.join(SOURCE, "scripts/site"), "--out", out], capture_output=True, text=True, check=False)
        cls.pages = os.path.join(out, "html")

    def setUp(self):
        self.assertEqual((self.made.returncode, self.made.stderr), (0, ""), self.made.stdout)

    def test_pages_headers_and_stubs(self):
        pages, headers, stubs = map(int, re.search(r"(\d+) pages, (\d+) headers, (\d+) stubs", self.made.stdout).groups())
        self.assertGreater(pages, headers + stubs + 80)
        self.assertEqual(headers, len(os.listdir(os.path.join(self.pages, "api", "cpp"))))
        for name in ("first.html", "quadrotor.html"):
            self.assertGreater(os.path.getsize(os.path.join(self.pages, "live", name)), 500_000)

    @unittest.skipUnless(shutil.which("chromium"), "Debian's chromium is not installed (packages.txt, browser)")
    def test_nothing_is_asked_for_and_the_search_finds(self):
        browser = Browser()
        self.addCleanup(browser.close)
        for page in ("index.html", "README.html", "search.html?q=clearance_ahead"):
            browser.requests, browser.complaints = [], []
            browser.send("Page.navigate", url="file://%s/%s" % (self.pages, page))
            browser.run("new Promise(done => setTimeout(done, 3000))")
            self.assertEqual(browser.complaints, [], page)
            self.assertEqual([r for r in browser.requests if not r.startswith(("file://" + self.pages, "data:"))], [], page)
        found = browser.run("[...document.querySelectorAll('#search-results li')].map(e => e.textContent)")
        self.assertIn("vericone/cones/ellipsoids/clearance.h", " ".join(found))


if __name__ == "__main__":
    unittest.main()
