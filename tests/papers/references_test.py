# SPDX-License-Identifier: BSD-3-Clause
"""Every reference to a section of docs/reference/errata.md leads to one, and every file and test that it names is there."""
import os
import re
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOLDERS = ("apps", "cones", "docs", "geometry", "guidance", "papers", "tests", "verify")
KINDS = (".cpp", ".h", ".md", ".py", ".yaml", ".txt")
# "errata 3.5", "(docs/reference/errata.md, 4.2)", "[errata](errata.md), 3.6", "errata, 4.2 and 3.6".
REFERENCE = re.compile(r"errata(?:\.md)?\)?,?\s+((?:\d+(?:\.\d+)?)(?:(?:,? and |, )\d+(?:\.\d+)?)*)")


def files():
    for folder in FOLDERS:
        for path, _, names in os.walk(os.path.join(ROOT, folder)):
            for name in names:
                if name.endswith(KINDS):
                    yield os.path.join(path, name)


def text_of(path):
    with open(path, encoding="utf-8") as f:
        return f.read()


def sections(text):
    return set(re.findall(r"^#+ (\d+(?:\.\d+)?) ", text, re.MULTILINE))


def dangling(text, known):
    # A reference may be broken over lines of comments and of string literals.
    joined = re.sub(r'"?\s*\n\s*(?:///?|#|"|\*)?\s*', " ", text)
    return [(whole.group(0), n) for whole in REFERENCE.finditer(joined)
            for n in re.findall(r"\d+(?:\.\d+)?", whole.group(1)) if n not in known]


class References(unittest.TestCase):
    def setUp(self):
        self.errata = text_of(os.path.join(ROOT, "docs", "reference", "errata.md"))

    def test_references_to_the_errata(self):
        known, found = sections(self.errata), 0
        self.assertLessEqual({"3.5", "3.6", "4.1", "4.2"}, known)
        for path in files():
            if os.path.samefile(path, __file__):
                continue
            text = text_of(path)
            found += len(REFERENCE.findall(text))
            self.assertEqual(dangling(text, known), [], path)
        self.assertGreater(found, 20)

    def test_a_dangling_one_is_found(self):
        for text in ("(docs/reference/errata.md, 9.9)", "errata 9.9", "[errata](errata.md), 9.9", "errata, 4.2 and 9.9",
                     '"(docs/reference/errata.md, "\n   "9.9)"', "// as in errata,\n// 9.9"):
            self.assertEqual([n for _, n in dangling(text, {"4.2"})], ["9.9"], text)

    def test_what_the_errata_cite(self):
        cited = re.findall(r"`(tests/[^`]*)`", self.errata)
        self.assertGreater(len(cited), 10)
        for path in cited:
            self.assertTrue(os.path.exists(os.path.join(ROOT, path)), path)
        tests = "\n".join(text_of(p) for p in files() if p.startswith(os.path.join(ROOT, "tests")) and p.endswith(".cpp"))
        names = re.findall(r"`([A-Z]\w+)\.([A-Z]\w+)`", self.errata)
        self.assertGreater(len(names), 10)
        for suite, name in names:
            self.assertRegex(tests, r"TEST(_F|_P)?\(%s,\s*%s\)" % (suite, name))


class ClaimsCited(unittest.TestCase):
    def test_claims_that_the_errata_cite(self):
        claims = text_of(os.path.join(ROOT, "papers", "dhal2022", "claims.yaml"))
        cited = re.findall(r"`(\d+\.[\d.]*/[\w-]+)`", text_of(os.path.join(ROOT, "docs", "reference", "errata.md")))
        self.assertGreater(len(cited), 4)
        for claim in cited:
            self.assertRegex(claims, r"(?m)^    id: %s$" % re.escape(claim))


if __name__ == "__main__":
    unittest.main()
