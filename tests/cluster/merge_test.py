# SPDX-License-Identifier: BSD-3-Clause
"""`--part K/N` of the commands whose rows are in tables, and `vericone merge`: what they write together is byte for
byte what one run writes."""
import csv
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
from command import SOURCE, VERICONE, ball, contents, engagement, run

SCENARIO = os.path.join(SOURCE, "docs/examples/scenarios/noise.yaml")
TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n2 0 0\n0 3 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"


def command(name, scan=""):
    return {"campaign": ["campaign", "-N", "41", "--laws", "clearance", "--seed", "9"],
            "accuracy": ["accuracy", "-N", "25", "--planes", "4,8,16", "--seed", "9"],
            "combined": ["accuracy", "-N", "7", "--obstacle", "star", "--planes", "4,8"],
            "scans": ["accuracy", "-N", "9", "--planes", "4,8", "--scan", scan, "--approaches", "5"],
            "trials": ["trials", SCENARIO, "-N", "9"]}[name]


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

    def kept(self, name, *words):
        """What --rows leaves in the folder, beside the summaries, which are those of all rows."""
        result = run(*words, "--no-figures", "--quiet", "--out", self.path(name))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        files = contents(self.path(name))
        self.assertEqual({file: files.pop(file) for file in ("summary.csv", "summary.json")},
                         {file: self.whole[file] for file in ("summary.csv", "summary.json")})
        for file in files:
            self.assertIn(os.path.join(self.path(name), file), result.stdout)
        return files

    def test_what_is_kept_of_the_rows(self):
        words = command("campaign")
        self.assertEqual(run(*words, "--no-figures", "--quiet", "--out", self.path("whole")).returncode, 0)
        self.whole = contents(self.path("whole"))
        lines = self.whole["engagements.csv"].splitlines(keepends=True)
        self.assertEqual(self.kept("none", *words, "--rows", "none"), {})
        self.assertEqual(self.kept("named", *words, "--rows", "mine.csv"), {"mine.csv": self.whole["engagements.csv"]})

        def scrambled(row, mask=2**64 - 1):  # SplitMix64, of the row's number
            x = (row + 0x9e3779b97f4a7c15) & mask
            x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9 & mask
            x = (x ^ x >> 27) * 0x94d049bb133111eb & mask
            return x ^ x >> 31

        chosen = sorted(sorted(range(41), key=scrambled)[:7])
        sample = {"engagements.sample.csv": lines[0][:-1] + b", a sample of 7 rows\n" + lines[1] + b"".join(lines[2 + i] for i in chosen)}
        parts = [self.part([*words, "--rows", "sample:7"], k, 3, f"sampled-{k}") for k in (1, 2, 3)]
        for threads in ("1", "3"):
            self.assertEqual(self.kept("sample-" + threads, *words, "--rows", "sample:7", "--threads", threads), sample)
        self.assertEqual(self.kept("sample-merged", "merge", *parts), sample)
        self.assertEqual(len(self.kept("most", *words, "--rows", "sample:1000")["engagements.sample.csv"].splitlines()), 43)
        # An earlier table does not stay beside what is kept now.
        self.assertEqual(self.kept("whole", *words, "--rows", "none"), {})
        scan = self.path("scan.off")
        with open(scan, "w", encoding="utf-8") as f:
            f.write(TETRAHEDRON)
        for rows, of, says in (("some", words, "none, sample:N, or the name of a file in --out that ends with .csv or .h5"),
                               ("a/b.csv", words, "none, sample:N, or"), ("sample:0", words, "sample:N, N from 1 to 1000000"),
                               ("mine.csv", command("scans", scan), "none or sample:N: there are 2 tables")):
            result = run(*of, "--rows", rows, "--out", self.path("refused"))
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertTrue(result.stderr.startswith(f"vericone: --rows: got {rows}, must be {says}"), result.stderr)
            self.assertFalse(os.path.exists(self.path("refused")))
        result = run("trials", SCENARIO, "--trial", "1", "--rows", "none")
        self.assertEqual((result.returncode, result.stdout, result.stderr), (2, "", "vericone: --rows: got none, must be left out with --trial\n"))
        result = run(*words, "--rows", "summary.csv", "--no-figures", "--quiet", "--out", self.path("same"))
        self.assertEqual((result.returncode, result.stderr), (2, "vericone: --rows: got summary.csv, must be the name of no other file in --out\n"))
        # Its rows are done, and serve the next try.
        self.assertEqual(os.listdir(self.path("same")), ["engagements.csv.partial"])
        self.assertEqual(self.kept("same", *words, "--rows", "none"), {})
        if os.path.exists(os.path.join(os.path.dirname(VERICONE), "vericone-rows")):
            self.assertEqual(set(self.kept("packed", *words, "--rows", "mine.h5")), {"mine.h5"})
            again = self.path("again.csv")
            self.assertEqual(run("rows", self.path("packed/mine.h5"), "--out", again, "--quiet").returncode, 0)
            with open(again, "rb") as f:
                self.assertEqual(f.read(), self.whole["engagements.csv"])

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

    def test_the_summary_is_that_of_the_rows(self):
        """Its medians are found bit by bit, without keeping the rows."""
        for count in ("1", "2", "301"):
            folder = self.path(count)
            self.assertEqual(run("campaign", "-N", count, "--laws", "slice,clearance", "--no-figures", "--quiet", "--out",
                                 folder).returncode, 0)
            with open(os.path.join(folder, "engagements.csv"), encoding="utf-8") as f:
                next(f)
                rows = list(csv.DictReader(f))
            with open(os.path.join(folder, "summary.json"), encoding="utf-8") as f:
                summary = json.load(f)
            self.assertEqual(summary["engagements"], len(rows))
            self.assertEqual(len(summary["laws"]), 4)
            for law in summary["laws"]:
                name, avoided = law["name"], [row for row in rows if row[law["name"]] == "avoided"]
                peaks = sorted(float(row[name + " peak [m/s^2]"]) for row in avoided)
                left = sorted(float(row[name + " left cone [s]"]) for row in avoided if row[name + " left cone [s]"])
                peaks = [p for p in peaks if p > 0]
                self.assertEqual(law["avoided"], len(avoided))
                self.assertEqual(law["met"], sum(row[name] == "met" for row in rows))
                self.assertEqual(law["made_worse"], sum(row[name] == "met" and row["straight"] == "avoided" for row in rows))
                self.assertEqual(law["median_peak"], peaks[len(peaks) // 2] if peaks else None)
                self.assertEqual(law["median_left_cone"], left[len(left) // 2] if left else None)
                self.assertEqual(sum(law["least_distances"]), len(avoided))

    def test_a_file_that_has_changed_is_named(self):
        scenario = self.path("noise.yaml")
        shutil.copy(SCENARIO, scenario)
        words = ["trials", scenario, "-N", "4"]
        parts = [self.part(words, k, 2) for k in (1, 2)]
        with open(scenario, "a", encoding="utf-8") as f:
            f.write("# later\n")
        self.refused(*parts, says=f"{scenario}: got another content, must be what {parts[0]} was made of, SHA-256 [0-9a-f]{{64}}: ")
        os.remove(scenario)
        self.refused(*parts, says=f"{scenario}: got nothing, must be what {parts[0]} was made of")
        shutil.copy(SCENARIO, scenario)
        self.assertEqual(run("merge", *parts, "--no-figures", "--quiet", "--out", self.path("whole")).returncode, 0)

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


class QueryParts(unittest.TestCase):
    """Answers of the parts of a file, one after the other, are those of the file."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.file = os.path.join(temporary.name, "cases.jsonl")

    def of_parts(self, of):
        answers, status = [], 0
        for k in range(1, of + 1):
            result = run("query", self.file, "--part", f"{k}/{of}")
            self.assertEqual(result.stderr, "")
            answers.append(result.stdout)
            status = max(status, result.returncode)
        return answers, status

    def test_answers_of_all_parts_are_those_of_the_file(self):
        good = engagement(ball([0, 0, 0], 1), ball([9, 0.5, 0], 1), [1, 0, 0])
        short = [json.dumps(good), "", "no case", "  ", json.dumps({**good, "id": "ä" * 40}), "{}", json.dumps({**good, "id": 2})]
        # Three blocks and more of what the command reads at once.
        long = [json.dumps({**good, "id": i, "obstacle_velocity": [0, 1e-3 * (i % 700), 0]}) for i in range(20_000)]
        long[12_345] = "bad"
        for lines, end, parts in ((short, "\n", (1, 2, 3, 7, 50)), (short, "", (2, 5)), (long, "\n", (1, 3, 16)), ([], "", (3,))):
            with open(self.file, "w", encoding="utf-8") as f:
                f.write("\n".join(lines) + (end if lines else ""))
            whole = run("query", self.file)
            for of in parts:
                answers, status = self.of_parts(of)
                self.assertEqual("".join(answers), whole.stdout)
                self.assertEqual(status, whole.returncode)
                if lines is long and of > 1:
                    self.assertGreater(min(len(text) for text in answers), len(whole.stdout) / of / 2)
            if lines is long:
                self.assertIn("line 12346", "".join(answers))  # of the file, not of the part

    def test_what_has_no_parts(self):
        result = run("query", "-", "--part", "1/2", input="")
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertEqual(result.stderr, "vericone: --part: got 1/2, must be left out, or given with a file: - is none\n")
        result = run("query", "--scene", os.path.join(SOURCE, "docs/examples/first.yaml"), "--part", "1/2")
        self.assertEqual((result.returncode, result.stderr), (2, "vericone: --part: got 1/2, must be left out with --scene\n"))


if __name__ == "__main__":
    unittest.main()
