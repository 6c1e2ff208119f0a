# SPDX-License-Identifier: BSD-3-Clause
"""`--part K/N` of the commands whose rows are in tables, and `vericone merge`: what they write together is byte for
byte what one run writes."""
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "cli"))
from command import SOURCE, VERICONE, run

SCENARIO = os.path.join(SOURCE, "docs/examples/scenarios/noise.yaml")
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n2 0 0\n0 3 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"


def command(name, scan=""):
    return {"campaign": ["campaign", "-N", "41", "--laws", "clearance", "--seed", "9"],
            "accuracy": ["accuracy", "-N", "25", "--planes", "4,8,16", "--seed", "9"],
            "combined": ["accuracy", "-N", "7", "--obstacle", "star", "--planes", "4,8"],
            "scans": ["accuracy", "-N", "9", "--planes", "4,8", "--scan", scan, "--approaches", "5"],
            "trials": ["trials", SCENARIO, "-N", "9"]}[name]


def contents(folder):
    """Of a folder's files by name, but of how it was made."""
    files = {}
    for name in sorted(os.listdir(folder)):
        if name == "provenance.json":
            continue
        with open(os.path.join(folder, name), "rb") as f:
            files[name] = f.read()
    return files


class Merge(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def part(self, words, number, of, name=None):
        folder = self.path(name or f"part-{number}")
        result = run(*words, "--part", f"{number}/{of}", "--threads", "1", "--quiet", f"--out={folder}")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertRegex(result.stdout, f"^part {number}/{of} is in .*; vericone merge puts all parts together\n$")
        return folder

    def refused(self, *folders, says):
        out = self.path("refused")
        result = run("merge", *folders, "--out", out)
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertRegex(result.stderr, f"^vericone: {says}")
        self.assertEqual(result.stderr.count("\n"), 1)
        self.assertFalse(os.path.exists(out))

    def test_the_parts_are_the_whole(self):
        scan = self.path("scan.off")
        with open(scan, "w", encoding="utf-8") as f:
            f.write(TETRAHEDRON)
        for name, of in (("campaign", 8), ("accuracy", 4), ("combined", 9), ("scans", 3), ("trials", 2)):
            with self.subTest(name):
                words, whole = command(name, scan), self.path(name)
                result = run(*words, "--no-figures", "--quiet", "--out", whole)
                self.assertEqual(result.returncode, 0, result.stderr)
                parts = [self.part(words, k, of, f"{name}-{k}") for k in range(1, of + 1)]
                rows = [len(contents(part)[table].splitlines()) - 2 for part in parts
                        for table in contents(part) if table.endswith(".csv")]
                self.assertGreater(len([n for n in rows if n]), 1)  # or nothing was put together
                merged = self.path(name + "-merged")
                again = run("merge", *reversed(parts), "--no-figures", "--quiet", "--out", merged)
                self.assertEqual((again.returncode, again.stderr), (0, ""))
                self.assertEqual(contents(merged), contents(whole))
                self.assertEqual(*(re.sub(r"\d+\.\d s\b", "", text) for text in (again.stdout.replace(merged, whole), result.stdout)))

    def test_what_is_not_of_one_run_is_refused(self):
        words = command("campaign")
        one, two, three = (self.part(words, k, 3) for k in (1, 2, 3))
        self.refused(one, three, says="part: got 2 folders, must be all 3 parts; 2/3 is missing")
        self.refused(one, two, two, says=f"part: got {two}, must be another one than 2/3, which is in {two}")
        seed = self.part([*words[:-1], "10"], 2, 3, "seed")
        self.refused(one, seed, three, says=f'part: got {seed} with "campaign .* --seed 10", must be of "campaign .* --seed 9"')
        of_four = self.part(words, 2, 4, "four")
        self.refused(one, of_four, three, says=f"part: got {of_four} with 4 parts, must be of 3 parts, as {one}")
        result = run("merge", one, two, three, "--out", two)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr, f"vericone: --out: got {two}, must be another folder than those of the parts\n")
        self.assertEqual(os.listdir(two), os.listdir(one))
        self.refused(one, self.path("nowhere"), says="part: got .*nowhere, must be a folder in which a command with --part")
        whole = self.path("whole")
        self.assertEqual(run(*words, "--no-figures", "--quiet", "--out", whole).returncode, 0)
        self.refused(one, whole, says=f"part: got {whole}, must be a folder in which a command with --part has finished")
        other = self.path("other")
        shutil.copytree(two, other)
        with open(os.path.join(other, "provenance.json"), encoding="utf-8") as f:
            origin = json.load(f)
        origin["commit"] = "0" * 12
        with open(os.path.join(other, "provenance.json"), "w", encoding="utf-8") as f:
            json.dump(origin, f)
        self.refused(one, other, three, says=f"part: got {other} with version .* 000000000000, must be of version ")

    def test_rows_that_are_not_the_parts_own_are_refused(self):
        words = command("campaign")
        parts = [self.part(words, k, 3) for k in (1, 2, 3)]
        table = os.path.join(parts[1], "engagements.csv")
        with open(table, encoding="utf-8") as f:
            lines = f.read().splitlines()
        for what, kept in (("one is missing", lines[:5] + lines[6:]), ("the last is missing", lines[:-1]),
                           ("twice", lines[:5] + lines[4:])):
            with self.subTest(what), open(table, "w", encoding="utf-8") as f:
                f.write("\n".join(kept) + "\n")
            out = self.path(what)
            result = run("merge", *parts, "--quiet", "--no-figures", "--out", out)
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertEqual(result.stderr, f"vericone: part: got {table}, must be the table that its provenance.json tells of\n")

    def test_a_part_that_was_stopped_goes_on(self):
        words = ["campaign", "-N", "3000", "--laws", "clearance", "--no-figures", "--quiet", "--part", "2/2"]
        whole, stopped = self.path("at-once"), self.path("stopped")
        self.assertEqual(run(*words, "--out", whole).returncode, 0)
        partial = os.path.join(stopped, "engagements.csv.partial")
        with subprocess.Popen([VERICONE, *words, "--out", stopped], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as p:
            while p.poll() is None and not (os.path.exists(partial) and os.path.getsize(partial) > 2000):
                time.sleep(0.001)
            p.send_signal(signal.SIGINT)
            p.communicate()
        self.assertEqual(p.returncode, 130)
        self.assertEqual(run(*words, "--threads", "1", "--out", stopped).returncode, 0)
        self.assertEqual(contents(stopped), contents(whole))
        # What is there, finished or not, is of that part alone.
        before = contents(stopped)
        finished = run(*words[:-1], "1/2", "--out", stopped)
        self.assertEqual(finished.returncode, 2)
        self.assertIn("must be a folder without another result", finished.stderr)
        self.assertEqual(contents(stopped), before)
        self.assertEqual(run(*words, "--out", stopped).returncode, 0)  # itself again
        shutil.move(os.path.join(stopped, "engagements.csv"), partial)
        os.remove(os.path.join(stopped, "provenance.json"))
        unfinished = run(*words[:-1], "1/2", "--out", stopped)
        self.assertEqual(unfinished.returncode, 2)
        self.assertIn("without the unfinished run of other settings", unfinished.stderr)

    def test_words_that_are_no_part(self):
        for text in ("0/4", "5/4", "4", "1/0", "a/b", "1/4x", "-1/4", "1/99999999999", ""):
            result = run("campaign", "-N", "10", "--no-figures", "--quiet", f"--part={text}", "--out", self.path("x"))
            if text == "":
                continue  # the whole
            self.assertEqual(result.returncode, 2, text)
            self.assertEqual(result.stderr,
                             f"vericone: --part: got {text}, must be K/N, the K-th of N parts, such as 3/8\n")
        one = run("trials", SCENARIO, "--trial", "1", "--part", "1/2")
        self.assertEqual(one.returncode, 2)
        self.assertTrue(re.match("vericone: --part: got 1/2, must be left out with --trial", one.stderr), one.stderr)


if __name__ == "__main__":
    unittest.main()
