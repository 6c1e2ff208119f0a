# SPDX-License-Identifier: BSD-3-Clause
"""`vericone signmap` and `vericone accuracy`."""
import hashlib
import json
import math
import os
import signal
import subprocess
import tempfile
import time
import unittest

from command import SOURCE, VERICONE, ball, run


class SignMap(unittest.TestCase):
    def test_table_and_provenance(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("signmap", "--cells", "41", "--no-figures", "--out", folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            tables = [n for n in os.listdir(folder) if n.endswith(".csv")]
            self.assertEqual(len(tables), 1)
            with open(os.path.join(folder, tables[0]), encoding="utf-8") as f:
                rows = [line.strip().split(",") for line in f if not line.startswith("#")]
            header, cells = rows[0], rows[1:]
            self.assertEqual(len(cells), 41 * 41)
            exact = {tuple(map(int, c[:2])): c[header.index("library")] for c in cells}
            self.assertEqual(exact[0, 0], "on")  # the velocity in the middle grazes, by construction
            self.assertGreater(sum(v == "in" for v in exact.values()), 300)
            self.assertGreater(sum(v == "out" for v in exact.values()), 300)
            self.assertIn("provenance.json", os.listdir(folder))

    def test_refuses_what_it_cannot_draw(self):
        result = run("signmap", "--cells", "0", "--no-figures")
        self.assertEqual(result.returncode, 2)
        self.assertIn("cells", result.stderr)


class Accuracy(unittest.TestCase):
    ARGUMENTS = ("accuracy", "--planes", "3,6,12,24,96", "--no-figures", "--quiet", "--seed", "5")

    def read(self, folder, name):
        with open(os.path.join(folder, name), encoding="utf-8") as f:
            return f.read()

    def test_threads_and_interruptions_do_not_change_the_table(self):
        with tempfile.TemporaryDirectory() as folder:
            whole, parts = os.path.join(folder, "whole"), os.path.join(folder, "parts")
            long = (*self.ARGUMENTS, "-N", "10000")  # seconds of work, stopped at its first and second written rows
            self.assertEqual(run(*long, "--threads", "1", "--out", whole).returncode, 0)
            partial = os.path.join(parts, "engagements.csv.partial")
            size = 0
            for _ in range(2):
                with subprocess.Popen([VERICONE, *long, "--threads", "2", "--out", parts],
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as p:
                    while p.poll() is None and (not os.path.exists(partial) or os.path.getsize(partial) <= size):
                        time.sleep(0.001)
                    p.send_signal(signal.SIGINT)
                    p.communicate()
                self.assertEqual(p.returncode, 130)
                size = os.path.getsize(partial)
            self.assertEqual(run(*long, "--threads", "2", "--out", parts).returncode, 0)
            self.assertEqual(self.read(whole, "engagements.csv"), self.read(parts, "engagements.csv"))
            self.assertEqual([n for n in os.listdir(parts) if n.endswith(".partial")], [])

    def test_unfinished_work_of_other_settings_is_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            partial = os.path.join(folder, "engagements.csv.partial")
            content = "# vericone accuracy, seed 9, 10 engagements, planes 3 12\nx\n"
            with open(partial, "w", encoding="utf-8") as f:
                f.write(content)
            result = run(*self.ARGUMENTS, "-N", "400", "--out", folder)
            self.assertEqual(result.returncode, 2)
            self.assertIn("--out", result.stderr)
            self.assertEqual(self.read(folder, "engagements.csv.partial"), content)

    def test_rows_that_are_not_these_are_refused(self):
        for words in (("accuracy", "-N", "60", "--planes", "4,8", "--no-figures"), ("campaign", "-N", "60", "--no-figures")):
            with tempfile.TemporaryDirectory() as folder:
                words = (*words, "--quiet", "--out", folder)
                self.assertEqual(run(*words).returncode, 0)
                whole = self.read(folder, "engagements.csv").splitlines()
                partial = os.path.join(folder, "engagements.csv.partial")
                nothing = ",".join(["20"] + ["nan"] * whole[1].count(","))
                for what, lines in {"doubled": whole[:22] + [whole[21]], "exchanged": [*whole[:22], whole[23], whole[22]],
                                    "left out": whole[:22] + whole[23:25], "nan": [*whole[:22], nothing, whole[23]],
                                    "short": [*whole[:22], "20,1"]}.items():
                    with self.subTest(what, command=words[0]):
                        content = "\n".join(lines) + "\n"
                        with open(partial, "w", encoding="utf-8") as f:
                            f.write(content)
                        result = run(*words)
                        self.assertEqual((result.returncode, result.stdout), (2, ""))
                        self.assertRegex(result.stderr, "^vericone: --out: got .* has row 20 in line 23; delete that file")
                        self.assertEqual(self.read(folder, "engagements.csv.partial"), content)
                with open(partial, "w", encoding="utf-8") as f:
                    f.write("\n".join(whole[:30]) + "\n" + whole[30][:7])  # broken off where it was written
                self.assertEqual(run(*words).returncode, 0)
                self.assertEqual(self.read(folder, "engagements.csv").splitlines(), whole)

    def test_summary_and_provenance(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(run(*self.ARGUMENTS, "-N", "400", "--out", folder).returncode, 0)
            summary = json.loads(self.read(folder, "summary.json"))["random"]
            # The finest count is the reference, and has no error against itself.
            self.assertEqual([row["above_two_over_n"] for row in summary["slice"]], [0, 0, 0, 0, None])
            self.assertIsNone(summary["slice"][-1]["discretisation_error"])
            self.assertAlmostEqual(summary["slice_order"], -2, delta=0.3)
            self.assertEqual([row["bound_violations"] for row in summary["exact"]], [0] * len(summary["exact"]))
            self.assertGreater(summary["slice_bias"]["mean"], 0.08)  # errata: 8 to 12 % on average
            self.assertLess(summary["slice_bias"]["mean"], 0.15)
            origin = json.loads(self.read(folder, "provenance.json"))
            for key in ("command", "commit", "compiler", "flags", "processor", "seed"):
                self.assertTrue(str(origin[key]))
            self.assertRegex(origin["compiler"], r"^(GNU|Clang) [0-9]+\.")
            self.assertIn("-ffp-contract=off", origin["flags"].split())

    def table(self, folder):
        settings, header, *rows = self.read(folder, "engagements.csv").splitlines()
        return settings, [dict(zip(header.split(","), row.split(","))) for row in rows]

    def test_own_distribution(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("accuracy", "-N", "60", "--semi-axes", "0.2", "0.5", "--distance", "2", "20", "--planes", "8", "16",
                         "32", "--no-figures", "--quiet", "--out", folder)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stdout, r"\n +32 +- +- +6.2e-02 +- ")
            settings, rows = self.table(folder)
            self.assertIn("semi-axes 0.2 to 0.5, distance 2 to 20", settings)
            self.assertEqual(len(rows), 60)
            distances = [float(r["distance"]) for r in rows]
            self.assertTrue(all(2 <= x <= 20 for x in distances))
            self.assertTrue(min(distances) < 4 and max(distances) > 18, "not spread over the range")
            for r in rows:
                for body in ("agent", "obstacle"):
                    axes = [float(r[body + "_semi_axis_" + k]) for k in "abc"]
                    self.assertTrue(0.5 >= axes[0] >= axes[1] >= axes[2] >= 0.2, axes)
                    trace = sum(float(r[body + "_shape_" + k]) for k in ("xx", "yy", "zz"))
                    self.assertAlmostEqual(trace, sum(x * x for x in axes), 12)
                self.assertAlmostEqual(math.hypot(*(float(r["to_obstacle_" + k]) for k in "xyz")), float(r["distance"]), 12)

    def test_own_cases(self):
        with tempfile.TemporaryDirectory() as folder:
            cases = os.path.join(folder, "cases.jsonl")
            with open(cases, "w", encoding="utf-8") as f:
                f.write(json.dumps({"id": "balls", "agent": ball([1, 0, 0], 1), "obstacle": ball([6, 0, 0], 2)}) + "\n\n")
                f.write(json.dumps({"agent": ball([0, 0, 0], 1), "obstacle": ball([0, 0, 9], 1)}) + "\n")
            out = os.path.join(folder, "out")
            result = run("accuracy", "--cases", cases, "--planes", "3,36", "--no-figures", "--quiet", "--out", out)
            self.assertEqual(result.returncode, 0, result.stderr)
            settings, rows = self.table(out)
            self.assertEqual([r["engagement"] for r in rows], ["balls", "3"])
            self.assertEqual([r["distance"] for r in rows], ["5", "9"])
            # Two balls: the section of the cone is a disc, sin(psi) = 3/5.
            self.assertAlmostEqual(float(rows[0]["exact_area"]), math.pi * 9 / 16, 12)
            with open(cases, "rb") as f:
                digest = hashlib.sha256(f.read()).hexdigest()
            self.assertIn("cases " + digest, settings)
            self.assertEqual(json.loads(self.read(out, "provenance.json"))["inputs"], [{"file": cases, "sha256": digest}])
            # The same as JSON, and the threads that were asked for.
            result = run("accuracy", "--cases", cases, "--planes", "3,36", "--no-figures", "--quiet", "--json", "--threads",
                         "3", "--out", out)
            self.assertEqual(json.loads(result.stdout), json.loads(self.read(out, "summary.json")))
            self.assertEqual(json.loads(self.read(out, "provenance.json"))["threads"], 3)

    def test_hashes_of_all_lengths(self):
        # The end of a SHA-256 stands in the last block or in one more: lengths around the edges.
        with tempfile.TemporaryDirectory() as folder:
            cases = os.path.join(folder, "cases.jsonl")
            line = json.dumps({"agent": ball([1, 0, 0], 1), "obstacle": ball([6, 0, 0], 2)}) + "\n"
            for length in (119, 120, 127, 128, 129, 183, 184, 191, 192):
                content = (line + " " * length)[:length].encode()
                with open(cases, "wb") as f:
                    f.write(content)
                result = run("accuracy", "--cases", cases, "--planes", "3,4", "--no-figures", "--quiet", "--out", folder)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn(hashlib.sha256(content).hexdigest(), self.table(folder)[0], length)

    def test_combined_obstacles(self):
        arguments = ("accuracy", "--obstacle", "biconcave", "-N", "16", "--planes", "3,6,12,96", "--tolerance", "0.1",
                     "--no-figures", "--quiet")
        with tempfile.TemporaryDirectory() as folder:
            one, two = os.path.join(folder, "one"), os.path.join(folder, "two")
            result = run(*arguments, "--threads", "1", "--out", one)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertEqual(run(*arguments, "--threads", "2", "--out", two).returncode, 0)
            self.assertEqual(self.read(one, "engagements.csv"), self.read(two, "engagements.csv"))
            summary = json.loads(self.read(one, "summary.json"))["random"]
            self.assertEqual(summary["obstacle"], "biconcave")
            self.assertEqual([row["above_two_over_n"] for row in summary["slice"]], [0, 0, 0, None])
            self.assertLessEqual(summary["reference_gap"]["worst"], 0.1)
            low, high = summary["slice_bias"]["mean"]
            self.assertGreater(high, low)
            self.assertGreater(high, 0.03)  # the slices miss something
            self.assertGreater(summary["slice_bias"]["worst"][0], 0.05)  # proved
            self.assertEqual(json.loads(self.read(one, "provenance.json"))["tolerance"], 0.1)
            # Unfinished work of another tolerance is kept.
            os.rename(os.path.join(one, "engagements.csv"), os.path.join(one, "engagements.csv.partial"))
            other = run(*arguments[:-3], "0.2", "--no-figures", "--quiet", "--out", one)
            self.assertEqual(other.returncode, 2)
            self.assertIn("--out", other.stderr)

    def test_figures(self):
        if subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], capture_output=True, check=False).returncode:
            self.skipTest("no /usr/bin/python3 with matplotlib")
        with tempfile.TemporaryDirectory() as folder:
            scan = os.path.join(folder, "tetrahedron.off")
            with open(scan, "w", encoding="utf-8") as f:
                f.write("OFF\n4 0 0\n0 0 0\n3 0 0\n0 2 0\n0 0 1\n")
            result = run("accuracy", "-N", "30", "--planes", "3,12,36", "--approaches", "20", "--quiet", "--scan", scan,
                         "--out", os.path.join(folder, "out"))
            self.assertEqual(result.returncode, 0, result.stderr)
            pictures = [line.split()[1] for line in result.stdout.splitlines() if line.startswith("picture")]
            self.assertEqual(sorted(os.path.basename(p) for p in pictures),
                             ["accuracy.pdf", "accuracy.png", "engagement.pdf", "engagement.png", "scans.pdf", "scans.png"])
            result = run("accuracy", "--obstacle", "biconcave", "-N", "5", "--planes", "3,12,36", "--tolerance", "0.2",
                         "--quiet", "--out", os.path.join(folder, "dented"))
            self.assertEqual(result.returncode, 0, result.stderr)
            dented = [line.split()[1] for line in result.stdout.splitlines() if line.startswith("picture")]
            self.assertEqual(sorted(os.path.basename(p) for p in dented), ["accuracy.pdf", "accuracy.png"])
            scene = os.path.join(SOURCE, "docs", "examples", "biconcave.yaml")
            result = run("cone", scene, "--tolerance", "0.1", "--picture", os.path.join(folder, "scene"))
            self.assertEqual(result.returncode, 0, result.stderr)
            shown = [line.split()[1] for line in result.stdout.splitlines() if line.startswith("picture")]
            self.assertEqual(sorted(os.path.basename(p) for p in shown), ["engagement.pdf", "engagement.png"])
            for p in pictures + dented + shown:
                with open(p, "rb") as f:
                    self.assertIn(f.read(4), (b"%PDF", b"\x89PNG"))


if __name__ == "__main__":
    unittest.main()
