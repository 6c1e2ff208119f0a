#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs what the pages say one can run, and compares what it prints with what they show (pages.py has the notation).

All commands run one after the other in one folder that looks like the project's; the same command is run once. `./run`
stands for the vericone command there. Environment: VERICONE (the program), VERICONE_SOURCE (the project),
VERICONE_CGAL_MESHES (the archive of meshes), VERICONE_PROGRAMS (the programs that are built besides)."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest
from pathlib import Path

from pages import ROOT, blocks, commands, pages, pattern, shortened, text_of

# Blocks that are not run, and why. Whoever adds one counts it here.
NOT_RUN = {"installs packages": 5, "takes minutes": 10, "builds with CMake": 8, "builds the package": 7,
           "waits for callers": 1}
LONGEST = 60  # seconds that one command may take, however busy the machine


class Examples(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        archive = Path(os.environ["VERICONE_CGAL_MESHES"])
        if not archive.exists() or not {"fit", "mpi", "pursue", "rows", "scan", "track", "verify"} <= set(os.environ["VERICONE_PROGRAMS"].split()):
            self.skipTest("needs libcgal-demo and the programs fit, mpi, pursue, rows, scan, track and verify")
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copytree(ROOT / "docs/examples", self.folder / "docs/examples")
        for name in ("papers", "examples", "tests", "checker"):
            (self.folder / name).symlink_to(ROOT / name)
        scans = self.folder / "build/scans"
        scans.mkdir(parents=True)
        with tarfile.open(archive) as file:
            (scans / "elephant.off").write_bytes(file.extractfile("data/meshes/elephant.off").read())
        program = os.path.abspath(os.environ["VERICONE"])
        (self.folder / "run").write_text(f'#!/bin/sh\nexec "{program}" "$@"\n')
        (self.folder / "run").chmod(0o755)
        # Where CONTRIBUTING.md has the build, and what it writes.
        (self.folder / "build/release/apps").mkdir(parents=True)
        (self.folder / "build/release/apps/vericone").symlink_to(program)
        (self.folder / "docs/reference").mkdir()
        self.environment = {**os.environ, "PATH": f"{os.path.dirname(program)}:/usr/bin:/bin"}
        self.done = {}

    def said(self, command):
        """What it prints, both streams, and its exit status."""
        if command not in self.done:
            began = time.monotonic()
            done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, text=True, check=False,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            took = time.monotonic() - began
            print(f"{took:6.2f} s  {command}")
            self.assertLess(took, LONGEST, command)
            self.done[command] = done.stdout, done.returncode
        return self.done[command]

    def hold(self, block):
        """What is wrong. With VERICONE_WRITE_PAGES outputs that differ are written into the page instead."""
        status, wrong = 0, []
        for command, output in commands(block):
            if command == "echo $?":
                if output.strip() != str(status):
                    wrong.append(f"{block}: the exit status is {status}, not {output.strip()}")
                status = 0
                continue
            if status:
                wrong.append(f"{block}: exit status {status} and nobody says so")
            printed, status = self.said(command)
            if output and not pattern(output).fullmatch(re.sub(r"[ ]+$", "", printed.rstrip("\n"), flags=re.M) + "\n"):
                if os.environ.get("VERICONE_WRITE_PAGES"):
                    text, before = text_of(block.page), f"\n$ {command}\n"
                    block.page.write_text(text.replace(before + output, before + shortened(printed.rstrip("\n"))), encoding="utf-8")
                    continue
                wrong.append(f"{block}: $ {command}\n--- the page\n{output}\n--- printed\n{printed}")
        if status:
            wrong.append(f"{block}: exit status {status} and nobody says so:\n{printed}")
        return wrong

    def test_all(self):
        wrong, left_out, run = [], dict.fromkeys(NOT_RUN, 0), 0
        for page in pages():
            for block in blocks(page):
                kind, note = block.note or ("", "")
                if kind == "file":
                    path = self.folder / note
                    path.parent.mkdir(parents=True, exist_ok=True)
                    path.write_text(block.text + "\n", encoding="utf-8")
                if block.language != "console":
                    continue
                if kind == "not run":
                    reason = next((r for r in NOT_RUN if note.startswith(r)), None)
                    self.assertIsNotNone(reason, f"{block}: '{note}' is none of {list(NOT_RUN)}")
                    left_out[reason] += 1
                    continue
                wrong += self.hold(block)
                run += 1
        self.assertEqual("\n\n".join(wrong), "")
        self.assertEqual(left_out, NOT_RUN)
        self.assertGreater(run, 20)


class Notation(unittest.TestCase):
    """What the comparison lets pass, and what not."""

    def held(self, output, printed):
        return bool(pattern(output).fullmatch(printed + "\n"))

    def test_patterns(self):
        self.assertTrue(self.held("a 1.5\nb", "a 1.5\nb"))
        self.assertFalse(self.held("a 1.5\nb", "a 1.6\nb"))
        self.assertFalse(self.held("a 1.5", "a 1.5\nb"))
        self.assertTrue(self.held("a ... s\nb", "a 17.2 s\nb"))
        self.assertFalse(self.held("a ... s\nb", "a 17.2 m\nb"))
        self.assertFalse(self.held("a ...", "a 17\nb"))
        self.assertTrue(self.held("a\n...\nb", "a\n1\n2\nb"))
        self.assertTrue(self.held("time  0.1 s, of 2", "time  3e-05 s, of 17.25"))
        self.assertFalse(self.held("time  0.1 s", "time  0.2 m"))
        self.assertFalse(self.held("a time 0.1 s", "a time 0.2 s"))

    def test_numbers_are_shortened(self):
        long = "0.16879360097282148 sr, -17.67766952966369 m, 2.2712345678e-05 s, 0.0029469785325895296, 1234567890, 0.250000, 5558"
        short = "0.168793... sr, -17.6776... m, 2.27123...e-05 s, 0.00294697..., 1234567890, 0.250000, 5558"
        self.assertEqual(shortened(long), short)
        self.assertTrue(self.held(short, long))
        self.assertFalse(self.held(short, long.replace("17.6776", "17.6775")))
        self.assertEqual(shortened('{"m":0.16879360097282148}'), '{"m":0.16879360097282148}')

    def test_a_page(self):
        page = Path(tempfile.mkdtemp()) / "page.md"
        self.addCleanup(shutil.rmtree, page.parent)
        page.write_text("<!-- not run: takes minutes -->\n\n```console\n$ a \\\n  b\nc\n\n$ d\n```\n\nx\n\n```text\n```\n")
        first, second = blocks(page)
        self.assertEqual((first.language, first.note), ("console", ("not run", "takes minutes")))
        self.assertEqual(commands(first), [("a \\\n  b", "c"), ("d", "")])
        self.assertEqual((second.language, second.note), ("text", ()))
        self.assertEqual(text_of(page)[:4], "<!--")


if __name__ == "__main__":
    sys.exit(unittest.main())
