#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Whatever a page, a comment, a help or a message names is there: links and their sections, files, commands, options.
Environment: VERICONE (the program), VERICONE_SOURCE (the project), VERICONE_PROGRAMS (what is built besides)."""

import json
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

import yaml

from pages import LANGUAGES, ROOT, anchors, blocks, commands, pages, prose, text_of

SOURCES = ("apps", "benchmarks", "c", "cmake", "cones", "docs", "examples", "geometry", "guidance", "packaging", "papers", "python", "scripts",
           "setup.py", "tests", "verify", "CMakeLists.txt", "LICENSE", "check", "run", "packages.txt")
KINDS = {".h", ".cpp", ".py", ".md", ".txt", ".yaml", ".json", ".cmake", ".js", ""}
# What other programs take: CTest, CMake, git, googletest, Google Benchmark, g++, pip, and this project's scripts.
OF_OTHERS = re.compile(r"--(gtest_\w+|benchmark_\w+|preset|build|install|prefix|target|param|tree|table|before|narrow|"
                       r"again|cflags|libs|test-dir|as-needed|packages|no-index|no-build-isolation|system-site-packages)$")
PROGRAMS = {"fit", "mpi", "pursue", "rows", "scan", "track", "verify"} - set(os.environ.get("VERICONE_PROGRAMS", "").split())
# Not of this form: a table that its own test writes, a log, a page under work.
OF_ANOTHER_FORM = {"docs/reference/bad-input.md", "docs/reference/papers.md"}
WIDTH = 120


def relative(path):
    return str(path.relative_to(ROOT))


def code_spans(page):
    return re.findall(r"(?<!`)`([^`\n]+)`(?!`)", prose(page))


def sources():
    for name in SOURCES:
        top = ROOT / name
        for path in sorted(top.rglob("*")) if top.is_dir() else [top]:
            if path.is_file() and path.suffix in KINDS and "__pycache__" not in path.parts:
                yield path


class Links(unittest.TestCase):
    maxDiff = None

    def test_links_lead_somewhere(self):
        wrong, seen = [], 0
        for page in pages():
            for target in re.findall(r"\]\(([^)\s]+)\)", prose(page)):
                if re.match(r"[a-z]+:", target):
                    continue
                seen += 1
                path, _, section = target.partition("#")
                file = (page.parent / path).resolve() if path else page
                if not file.exists():
                    wrong.append(f"{relative(page)}: {target}")
                elif section and section not in anchors(file):
                    wrong.append(f"{relative(page)}: {target}: no such section")
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 100)

    def test_every_page_can_be_reached(self):
        """From docs/README.md in one step: it is the index."""
        index = ROOT / "docs/README.md"
        linked = {(index.parent / target.partition("#")[0]).resolve()
                  for target in re.findall(r"\]\(([^)\s]+)\)", prose(index))}
        missing = [relative(page) for page in (ROOT / "docs").rglob("*.md") if page.resolve() not in linked | {index}]
        self.assertEqual(missing, [])

    def test_every_picture_is_shown(self):
        shown = {(page.parent / target).resolve() for page in pages()
                 for target in re.findall(r"!\[[^\]]*\]\(([^)\s]+)\)", prose(page))}
        self.assertEqual([p.name for p in sorted((ROOT / "docs/images").iterdir()) if p.resolve() not in shown], [])

    def test_pages_named_in_sources(self):
        wrong, seen = [], 0
        for path in sources():
            for name in re.findall(r"(?<!tests/)\bdocs/[\w/.-]+[\w]", text_of(path)):
                seen += 1
                if not (ROOT / name).exists() and not list(ROOT.glob(name + "*")):
                    wrong.append(f"{relative(path)}: {name}")
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 100)

    def test_numbered_sections(self):
        """"docs/explanation/theory.md, 7" in sources, "[theory](theory.md), 7" in pages."""
        known = set(re.findall(r"^## (\d+)\. ", text_of(ROOT / "docs/explanation/theory.md"), re.MULTILINE))
        self.assertIn("7", known)
        wrong = [f"{relative(path)}: {whole}" for path in sources()
                 for whole, number in re.findall(r"(theory\.md\)?, (\d+))", text_of(path)) if number not in known]
        self.assertEqual(wrong, [])

    def test_files_named_in_pages(self):
        """A path from the root, from a folder of headers or within a library; a name alone of a header or source."""
        roots = [ROOT, ROOT / "apps/src", *ROOT.glob("*/include"), *ROOT.glob("*/include/vericone"),
                 *ROOT.glob("*/include/vericone/*"), *ROOT.glob("*/include/vericone/internal/*"), *ROOT.glob("*/*/include"), *ROOT.glob("*/*/include/vericone"), *ROOT.glob("*/src"), *ROOT.glob("*/*/src"),
                 ROOT / "cones", ROOT / "geometry", ROOT / "guidance", ROOT / "docs", ROOT / "verify"]
        names = {path.name for path in sources()} | {p.name for top in ("tests", "docs") for p in (ROOT / top).rglob("*")}
        wrong, seen = [], 0
        for page in pages():
            for span in code_spans(page):
                for name in re.findall(r"^[\w./*-]+\.(?:h|cpp|py|md|cmake|g)$|^(?:docs|tests|apps|papers|examples)/[\w./*-]+$", span):
                    seen += 1
                    if "/" not in name:
                        found = name in names
                    elif "*" in name:
                        found = any(True for top in (ROOT, page.parent) for _ in top.glob(name))
                    else:
                        found = any((root / name).exists() for root in [page.parent, *roots])
                    if not found:
                        wrong.append(f"{relative(page)}: {name}")
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 100)


class Tables(unittest.TestCase):
    """What is read by machines too: the interface by question, citations."""

    def test_the_interface_names_what_the_headers_declare(self):
        wrong, seen = [], 0
        headers = {str(path).split("/include/", 1)[1]: path for path in ROOT.rglob("include/vericone/**/*.h")
                   if "build" not in path.relative_to(ROOT).parts}
        for row in re.findall(r"^\|(.*\.h`) \|$", text_of(ROOT / "docs/reference/api.md"), re.MULTILINE):
            _, calls, header = [cell.strip() for cell in row.split("|")]
            path = headers[header.strip("`")]
            near = [path] + [headers[name] for name in re.findall(r"^#include <(vericone/.*)>", text_of(path), re.MULTILINE)]
            text = "\n".join(re.sub(r"//.*", "", text_of(other)) for other in near)
            for call in re.findall(r"`([^`]+)`", calls):
                name = re.findall(r"\w+", re.sub(r"[({].*|\.\.\.$", "", call))[-1]
                seen += 1
                if not re.search(rf"\b{name}" if call.endswith("...") else rf"\b{name}\b", text) and not call.endswith(".h"):
                    wrong.append(f"{call} in {header}")
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 40)

    def test_blocks_of_data_can_be_read(self):
        readers, read = {"yaml": yaml.safe_load, "json": json.loads}, 0
        for page in pages():
            for block in blocks(page):
                if block.language in readers:
                    self.assertTrue(readers[block.language](block.text), str(block))
                    read += 1
        self.assertGreater(read, 4)

    def test_citation(self):
        """CFF 1.2: what it requires, and the version of the project."""
        with open(ROOT / "CITATION.cff", encoding="utf-8") as file:
            citation = yaml.safe_load(file)
        self.assertEqual(citation["cff-version"], "1.2.0")
        for field in ("message", "title", "authors"):
            self.assertTrue(citation[field])
        version = re.search(r"project\(vericone VERSION ([\d.]+)", text_of(ROOT / "CMakeLists.txt")).group(1)
        self.assertEqual(citation["version"], version)

    def test_references(self):
        text = text_of(ROOT / "docs/reference/references.bib")
        entries = re.findall(r"^@\w+\{(\w+),\n((?:  .*\n)+)\}$", text, re.MULTILINE)
        self.assertEqual(len(entries), text.count("@"))
        self.assertEqual(len({key for key, _ in entries}), len(entries))
        for key, fields in entries:
            self.assertEqual(fields.count("{"), fields.count("}"), key)
            for field in ("author", "title", "year"):
                self.assertRegex(fields, rf"(?m)^  {field} +=", key)
        for name in re.findall(r"[\w/-]+\.(?:h|cpp|md)\b", text):
            self.assertTrue((ROOT / name).exists(), name)


class Words(unittest.TestCase):
    """Commands and options."""

    maxDiff = None

    @classmethod
    def setUpClass(cls):
        cls.program = os.environ["VERICONE"]
        cls.options = {name: set(re.findall(r"(?<![\w-])--?[A-Za-z][\w-]*", cls.help(name)))
                       for name in re.findall(r"^  ([a-z][a-z-]*) ", cls.help(), re.MULTILINE) if name not in PROGRAMS}
        cls.all = set().union(*cls.options.values()) | {"--version", "--help"}

    @classmethod
    def help(cls, *names):
        return subprocess.run([cls.program, *names, "--help"], capture_output=True, text=True, check=True).stdout

    def lines(self):
        """(where, line of shell or code) of all pages but the one of mistakes."""
        for page in pages():
            if relative(page) == "docs/reference/bad-input.md":
                continue
            for block in blocks(page):
                if block.language == "console":
                    for command, _ in commands(block):
                        yield block, command
            for span in code_spans(page):
                yield relative(page), span

    def test_commands_and_their_options(self):
        wrong, seen = [], 0
        for where, line in self.lines():
            for piece in re.split(r"[|;]|&&", line):
                call = re.search(r"(?:^|[ (])(?:\./run|(?:build/release/apps/)?vericone(?: |-(?=fit|pursue|scan|track|verify))) *([a-z][a-z-]*)(?![\w:.])(.*)", piece)
                if not call or call.group(1) in PROGRAMS:
                    continue
                name, rest = call.groups()
                seen += 1
                if name not in self.options:
                    wrong.append(f"{where}: no command {name}: {line}")
                    continue
                wrong += [f"{where}: {name} has no option {option}: {line}"
                          for option in re.findall(r"(?<![\w-])--[a-z][\w-]*", rest) if option not in self.options[name]]
        self.assertEqual(wrong, [])
        self.assertGreater(seen, 60)

    def test_options_alone(self):
        wrong = [f"{where}: {option}" for where, line in self.lines()
                 for option in re.findall(r"(?<![\w-])--[a-z][\w-]*", line)
                 if option not in self.all and not OF_OTHERS.match(option)]
        self.assertEqual(wrong if not PROGRAMS else [], [])

    def test_commands_and_options_in_messages(self):
        """String literals of the programs."""
        wrong = []
        for path in sources():
            if path.suffix != ".cpp" or path.relative_to(ROOT).parts[0] not in ("apps", "papers"):
                continue
            for literal in re.findall(r'"((?:\\.|[^"\\\n])*)"', text_of(path)):
                wrong += [f"{relative(path)}: {option}" for option in re.findall(r"(?<![\w-])--[a-z][\w-]+", literal)
                          if option not in self.all]
                wrong += [f"{relative(path)}: vericone {name}" for name in re.findall(r"(?<!this )\bvericone ([a-z][a-z-]*)\b", literal)
                          if name not in self.options]
        self.assertEqual(wrong if not PROGRAMS else [], [])


class Form(unittest.TestCase):
    """One form of all pages."""

    maxDiff = None

    def test_pages_that_use_its_words_link_the_conventions(self):
        words = re.compile(r"\b(psi|theta_b|V_r|V_theta|certified|undecided|relative velocit|quaternion|[vV]erdict)")
        missing = [relative(page) for page in self.own()
                   if relative(page).startswith("docs/") and words.search(prose(page)) and "conventions.md" not in prose(page)
                   and page.name != "conventions.md"]
        self.assertEqual(missing, [])

    def own(self):
        return [page for page in pages() if relative(page) not in OF_ANOTHER_FORM and not relative(page).startswith("tests/")]

    def test_width(self):
        wrong = []
        for page in self.own():
            console = {block.line + n for block in blocks(page) if block.language == "console"
                       for n in range(block.text.count("\n") + 2)}
            wrong += [f"{relative(page)}:{n}: {len(line)}" for n, line in enumerate(text_of(page).split("\n"), 1)
                      if len(line) > WIDTH and not line.startswith("|") and n not in console]
        self.assertEqual(wrong, [])

    def test_blocks_say_what_they_are(self):
        """So no command hides in a block that nobody runs."""
        wrong = []
        for page in self.own():
            for block in blocks(page):
                if block.language not in LANGUAGES:
                    wrong.append(f"{block}: '{block.language}'")
                if block.language != "console" and re.search(r"^(\$ |\./run|vericone )", block.text, re.MULTILINE):
                    wrong.append(f"{block}: a command")
        self.assertEqual(wrong, [])

    def test_no_row_of_a_table_stands_twice(self):
        seen, wrong = {}, []
        for page in self.own():
            for row in re.findall(r"^\|(.*)\|$", prose(page), re.MULTILINE):
                cells = [cell.strip() for cell in row.split("|")]
                if sum(len(cell) for cell in cells) < 40 or not re.search(r"\w", row):
                    continue
                first = seen.setdefault(tuple(cells), page)
                if first != page:
                    wrong.append(f"{relative(page)} and {relative(first)}: {row[:60]}")
        self.assertEqual(wrong, [])

    def says_how(self, text):
        return any(re.match(r"\*\*Measured\*\* .*2\d{3}", part) and "**Who notices a change:** " in part.replace("\n", " ")
                   for part in text.split("\n\n"))

    def test_measured_pages_say_how(self):
        """Each page or section with a table: when it was measured, with which command, and who notices if it is stale."""
        wrong = []
        for page in sorted((ROOT / "docs/measured").glob("*.md")):
            parts = re.split(r"^(?=## )", text_of(page), flags=re.MULTILINE)
            if not self.says_how(parts[0]):
                wrong += [f"{relative(page)}: {part.splitlines()[0]}" for part in parts
                          if re.search(r"^\|", part, re.MULTILINE) and not self.says_how(part)]
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    sys.exit(unittest.main())
