#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Public headers stand alone and keep the house's rules. Read: what their text shows, in a second. Compiled: the compiler
takes each alone, which costs two minutes of processor time and so is a campaign. Environment: VERICONE_SOURCE (the
project); for Compiled, CXX (the compiler) and INCLUDES (folders of other packages, separated by :)."""

import os
import re
import subprocess
import sys
import unittest
from multiprocessing.pool import ThreadPool

from declarations import blanked, declarations, gives_an_answer
from house_test import ROOT, includes, public_headers

# Which header of the standard library brings a name of it.
BROUGHT_BY = {name: header for header, names in {
    "algorithm": "max min ranges", "atomic": "atomic memory_order_relaxed", "array": "array", "cmath": "abs copysign cos exp frexp hypot ilogb isfinite isinf ldexp log nextafter sin sqrt",
    "concepts": "convertible_to same_as", "cstddef": "ptrdiff_t size_t", "cstdint": "int8_t int64_t uint8_t uint16_t uint32_t uint64_t",
    "cstdlib": "getenv strtoull", "deque": "deque", "filesystem": "filesystem", "functional": "function", "iosfwd": "istream ostream",
    "limits": "numeric_limits", "memory": "shared_ptr unique_ptr", "numbers": "numbers", "optional": "nullopt optional",
    "random": "mt19937_64 seed_seq", "span": "span", "stdexcept": "invalid_argument", "string": "string to_string",
    "string_view": "string_view", "utility": "move pair swap", "variant": "get holds_alternative variant visit",
    "vector": "vector"}.items() for name in names.split()}


# Types and concepts of a namespace: those of a class stand farther right.
DECLARED = re.compile(r"^(?:class|struct|enum class|using|concept) ([A-Z]\w+)\b(?! *;)", re.MULTILINE)


class Read(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.headers = public_headers()
        self.text = {name: path.read_text(encoding="utf-8") for name, path in self.headers.items()}
        self.code = {name: blanked(text) for name, text in self.text.items()}

    def brought(self, name):
        """All that a header brings: itself, headers of the project, and what these include of others."""
        found, left = set(), [name]
        while left:
            header = left.pop()
            if header not in found:
                found.add(header)
                left += includes(self.headers[header]) if header in self.headers else []
        return found

    def test_names_of_the_standard_library(self):
        wrong = []
        for name, text in self.code.items():
            for used in sorted(set(re.findall(r"\bstd::(\w+)", text))):
                header = BROUGHT_BY.get(used)
                if header is None:
                    wrong.append(f"{name}: std::{used} is missing in BROUGHT_BY of headers_test.py")
                elif header not in includes(self.headers[name]):
                    wrong.append(f"{name}: std::{used} without <{header}>")
        self.assertEqual(wrong, [])

    def test_names_of_the_project_and_of_eigen(self):
        declared_in = {}
        for name, text in self.code.items():
            for declared in DECLARED.findall(text):
                declared_in.setdefault(declared, set()).add(name)
        wrong = []
        for name, text in self.code.items():
            brought = self.brought(name)
            if "Eigen::" in text and not any(other.startswith("Eigen/") for other in brought):
                wrong.append(f"{name}: Eigen")
            own = set(re.findall(r"\b(?:class|struct|enum|using|typename|concept) ([A-Z]\w+)", text))
            for used in sorted((set(re.findall(r"(?<![:\w])[A-Z]\w+", text)) - own) & declared_in.keys()):
                if not declared_in[used] & brought:
                    wrong.append(f"{name}: {used} of {' or '.join(sorted(declared_in[used]))}")
        self.assertEqual(wrong, [])

    def test_answers_are_not_discarded(self):
        """Who calls a function for its answer alone and drops it has made a mistake: [[nodiscard]] says so."""
        wrong = [f"{name}: {' '.join(declaration.split())}" for name, text in self.text.items()
                 for _, scope, declaration, end in declarations(text)
                 if gives_an_answer(scope, declaration, end) and "[[nodiscard]]" not in declaration]
        self.assertEqual(wrong, [])

    def test_promises_of_no_allocation_are_kept(self):
        """A header that promises it is included by a test that counts allocations."""
        counted = set()
        for path in sorted((ROOT / "tests").rglob("*_test.cpp")):
            if "support/allocations.h" in includes(path):
                counted.update(includes(path))
        promised = {name for name, text in self.text.items() if re.search(r"\b[Nn]o\s+(?://+\s+)?allocation\b", text)}
        self.assertEqual(promised - counted, set())
        self.assertGreater(len(promised), 10)


class Compiled(unittest.TestCase):
    def test_every_header_alone(self):
        folders = sorted({str(path)[:-len(name)] for name, path in public_headers().items()})
        options = [f"-I{folder}" for folder in folders]
        options += [f"-isystem{folder}" for folder in os.environ["INCLUDES"].split(":")]

        def said(name):
            done = subprocess.run([os.environ["CXX"], "-std=c++20", "-fsyntax-only", "-x", "c++", *options, "-"],
                                  input=f"#include <{name}>\n", capture_output=True, text=True, check=False)
            return f"{name}:\n{done.stderr}" if done.returncode else ""

        with ThreadPool(os.cpu_count()) as pool:
            self.assertEqual([text for text in pool.map(said, public_headers()) if text], [])


if __name__ == "__main__":
    sys.exit(unittest.main())
