#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The stable interface, api.txt: what the public headers declare. Whoever takes a name away or changes one does so here
too (`tests/house/api_test.py write`), and says so in the CHANGELOG. Mechanism (include/vericone/internal) is none of
it."""

import re
import sys
import unittest
import zlib
from pathlib import Path

from declarations import blanked, declarations
from house_test import public_headers

LIST = Path(__file__).with_name("api.txt")
MOST_HEADERS = 93  # bodies that spin and accelerate; two for certificates: what others check stands apart from what is asked for; tracks of others; maps of velocities; two for shapes; swarms; what has no end is no body; ships


def public():
    return {name: path for name, path in sorted(public_headers().items()) if "/internal/" not in name}


def name_of(declaration):
    """The last word before the parentheses of a function, the value of a constant, or the body of a type."""
    plain = re.sub(r"\[\[\w+\]\] ?|\[.*?\]|\b\w+::|^friend ", "", declaration)
    while re.search(r"<[^<>]*>", plain):
        plain = re.sub(r"<[^<>]*>", "", plain)
    named = (re.match(r"(?:class|struct|enum class|enum|using|concept) (\w+)", plain) or
             re.search(r"(operator *[^\s(]+|operator\(\)|\w+)\s*(?=\(|=|\{|$)", plain) or
             re.search(r"(\w+)\W*$", plain))
    return named.group(1)


def interface(text):
    """Of each type and function of a header: its name, all its declarations, the names of its public members."""
    text = re.sub(r"^namespace detail \{.*?^\}  // namespace detail", "", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"^( *) (?:private|protected):\n.*?(?=^\1\};)", "", text, flags=re.DOTALL | re.MULTILINE)
    code, found, last = blanked(text), {}, None
    for at, scope, declaration, end in declarations(text):
        declaration = " ".join(declaration.split())
        if not declaration or declaration.startswith(("namespace", "static_assert")):
            continue
        if declaration.startswith("enum") and end == "{":
            opened = code.index("{", at)
            declaration += " " + " ".join(code[opened:code.index("}", opened) + 1].split())
        if scope == "namespace":
            last = found.setdefault(name_of(declaration), ([], []))
        elif name_of(declaration) not in last[1]:
            last[1].append(name_of(declaration))
        last[0].append(declaration)
    return found


def listed():
    """A line for each name: a sum of its declarations, which changes where one does, and its members."""
    lines = []
    for header, path in public().items():
        lines.append(header)
        for name, (said, members) in interface(path.read_text(encoding="utf-8")).items():
            changes = f"{zlib.crc32(' '.join(said).encode()):08x}"
            lines.append(" ".join(["", "", name, changes + ":" * bool(members), *members]))
    return "".join(f"{line}\n" for line in lines)


class Interface(unittest.TestCase):
    maxDiff = None

    def test_is_as_listed(self):
        self.assertEqual(LIST.read_text(encoding="utf-8").splitlines(), listed().splitlines())

    def test_is_small(self):
        self.assertLessEqual(len(public()), MOST_HEADERS)


if __name__ == "__main__":
    if "write" in sys.argv:
        LIST.write_text(listed(), encoding="utf-8")
    else:
        sys.exit(unittest.main())
