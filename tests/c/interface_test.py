#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The shared library as others meet it: what it exports is what its header declares, and who knows the declarations alone
(here ctypes, as Julia, MATLAB or Rust would) gets answers. abidiff holds the header against interface.abi, the interface as
it was promised; after an addition: `tests/c/interface_test.py write`.

Environment: VERICONE_C, the library; VERICONE_SOURCE, the project."""

import ctypes
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

LIBRARY = Path(os.environ.get("VERICONE_C", "build/release/c/libvericone_c.so.1"))
HEADER = Path(os.environ.get("VERICONE_SOURCE", ".")) / "c/include/vericone_c.h"
PROMISED = Path(__file__).with_name("interface.abi")
Vector = ctypes.c_double * 3


class Interface(unittest.TestCase):
    def test_exports_are_the_declarations(self):
        declared = set(re.findall(r"^VERICONE_API [^(]*?\b(vericone_\w+)\(", HEADER.read_text(encoding="utf-8"), re.MULTILINE))
        listed = subprocess.run(["nm", "-D", "--defined-only", LIBRARY], check=True, capture_output=True, text=True).stdout
        exported = {line.split()[2].split("@")[0] for line in listed.splitlines() if " A " not in line}
        self.assertEqual(exported, declared)
        self.assertGreater(len(declared), 30)

    def test_it_needs_no_library_but_those_of_cpp_and_c(self):
        read = subprocess.run(["readelf", "-d", LIBRARY], check=True, capture_output=True, text=True).stdout
        needed = re.findall(r"\(NEEDED\).*\[(.*?)\.so", read)
        self.assertLessEqual(set(needed), {"libstdc++", "libm", "libgcc_s", "libc", "ld-linux-x86-64", "ld-linux-aarch64"})

    def test_by_declarations_alone(self):
        library = ctypes.CDLL(str(LIBRARY))
        for name in ("vericone_body_ellipsoid", "vericone_pair_new"):
            getattr(library, name).restype = ctypes.c_void_p
        library.vericone_error.restype = ctypes.c_char_p
        ball = ctypes.c_void_p(library.vericone_body_ellipsoid(Vector(), Vector(1, 1, 1), None))
        pair = ctypes.c_void_p(library.vericone_pair_new(ball, Vector(), None, ball, Vector(0, 4, 0), None, ctypes.c_double(0)))
        self.assertEqual(library.vericone_pair_verdict(pair, Vector(0, 1, 0), Vector()), 2)
        self.assertEqual(library.vericone_pair_verdict(pair, Vector(1, 0, 0), Vector()), 0)
        self.assertEqual(library.vericone_pair_verdict(pair, Vector(float("inf"), 0, 0), Vector()), -1)
        self.assertIn(b"agent_velocity[0]: got inf", library.vericone_error())
        library.vericone_pair_free(pair)
        library.vericone_body_free(ball)

    @unittest.skipUnless(shutil.which("abidiff"), "Debian's abigail-tools are not installed")
    def test_nothing_promised_has_changed(self):
        with tempfile.TemporaryDirectory() as folder:
            compared = subprocess.run(["abidiff", "--no-added-syms", PROMISED, stub(Path(folder))], check=False,
                                      capture_output=True, text=True)
        self.assertEqual((compared.returncode, compared.stdout), (0, ""))


def stub(folder):
    """A library with the interface alone: every function of the header, empty."""
    text = re.sub(r"^(VERICONE_API [^;]*\));", r"\1 { abort(); }", HEADER.read_text(encoding="utf-8"), flags=re.MULTILINE)
    source, library = folder / "stub.c", folder / "libvericone_c.so.1"
    source.write_text("#include <stdlib.h>\n" + text, encoding="utf-8")
    subprocess.run(["cc", "-g", "-shared", "-fPIC", "-w", "-Wl,-soname,libvericone_c.so.1", "-o", library, source], check=True)
    return library


if __name__ == "__main__":
    if sys.argv[1:] == ["write"]:
        with tempfile.TemporaryDirectory() as to:
            subprocess.run(["abidw", "--no-show-locs", "--no-corpus-path", "--no-comp-dir-path", "--no-elf-needed",
                            "--no-parameter-names", "--out-file", PROMISED, stub(Path(to))], check=True)
            PROMISED.write_text(PROMISED.read_text(encoding="utf-8").replace(to + "/", ""), encoding="utf-8")
    else:
        sys.exit(unittest.main())
