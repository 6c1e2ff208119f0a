# SPDX-License-Identifier: BSD-3-Clause
"""vericone-mpi by a real mpirun: any number of processes writes, byte for byte, what the command alone writes; one that
is killed ends all, and the same call goes on. Skipped where either is missing. Environment: VERICONE, VERICONE_SOURCE;
VERICONE_CASES, how many processes are killed (1); VERICONE_CAMPAIGN=long, every command by every number of them."""
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, os.path.dirname(__file__))
from merge_test import TETRAHEDRON, command
from command import SOURCE, VERICONE, contents, drawn, run

PROGRAM = os.path.join(os.path.dirname(VERICONE), "vericone-mpi")
PURSUIT = os.path.join(SOURCE, "docs/examples/pursuits/two.yaml")
RANKS = 4
LONG = os.environ.get("VERICONE_CAMPAIGN") == "long"


class Mpi(unittest.TestCase):
    def setUp(self):
        if not os.path.exists(PROGRAM):
            self.skipTest("not built: vericone-mpi (VERICONE_MPI)")
        if not shutil.which("mpirun"):
            self.skipTest("not installed: mpirun (openmpi-bin)")
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def start(self, ranks, *words):
        return subprocess.Popen(["mpirun", "--oversubscribe", "--allow-run-as-root", "-n", str(ranks), PROGRAM, *words],
                                cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def ranks(self, ranks, *words):
        with self.start(ranks, *words) as process:
            out, error = process.communicate(timeout=250)
        return process.returncode, out, error

    def test_any_number_of_processes_writes_the_same(self):
        scan = self.path("scan.off")
        with open(scan, "w", encoding="utf-8") as f:
            f.write(TETRAHEDRON)
        commands = {name: command(name, scan) for name in ("accuracy", "combined", "scans", "trials")}
        commands["campaign"] = ["campaign", "-N", "410", "--laws", "clearance", "--seed", "9"]  # nine blocks
        if "pursue" in os.environ.get("VERICONE_PROGRAMS", "").split():
            commands["pursue"] = ["pursue", PURSUIT, "--camera", "exact", "--duration", "1", "--starts", "7"]
        for name in ["campaign", *drawn(sorted(commands.keys() - {"campaign"}), 3)]:
            words, whole = commands[name], self.path(name)
            one = run(*words, "--no-figures", "--quiet", "--out", whole)
            self.assertEqual(one.returncode, 0, one.stderr)
            # How the work is dealt out is one piece of code for all commands (apps/src/mpi/ranks.h).
            for ranks in (1, 2, RANKS) if name == "campaign" or LONG else (3,):
                with self.subTest(name, ranks=ranks):
                    folder = self.path(f"{name}-{ranks}")
                    status, out, error = self.ranks(ranks, *words, "--no-figures", "--quiet", "--out", folder)
                    self.assertEqual((status, error), (0, ""))
                    self.assertIn(folder, out)  # told once, by the first
                    self.assertEqual(out.count("\n"), one.stdout.count("\n"))
                    self.assertEqual(contents(folder), contents(whole))

    def test_the_parts_of_it_are_parts(self):
        words = command("campaign")
        whole = self.path("whole")
        self.assertEqual(run(*words, "--no-figures", "--quiet", "--out", whole).returncode, 0)
        status, _, error = self.ranks(3, *words, "--part", "1/2", "--quiet", "--out", self.path("one"))
        self.assertEqual((status, error), (0, ""))
        self.assertEqual(run(*words, "--part", "2/2", "--quiet", "--out", self.path("two")).returncode, 0)
        merged = run("merge", self.path("one"), self.path("two"), "--no-figures", "--quiet", "--out", self.path("merged"))
        self.assertEqual((merged.returncode, merged.stderr), (0, ""))
        self.assertEqual(contents(self.path("merged")), contents(whole))

    def test_what_is_wrong_is_said_once(self):
        for words, says in ((["campaign", "-N", "10", "--laws", "flap"], "vericone: --laws: got flap, must be "),
                            (["campaign", "--engagments", "10"], "vericone: no option --engagments, did you mean --engagements"),
                            (["campaign", "-N", "10", "--threads", "3"], "vericone: --threads: got 3, must be 1, or left out"),
                            (["fit", "bunny.ply"], "vericone: command: got fit, must be one of accuracy, campaign, ")):
            with self.subTest(says):
                status, out, error = self.ranks(3, *words, *(["--out", self.path("none")] if words[0] == "campaign" else []))
                self.assertEqual((status, out), (2, ""))
                lines = [line for line in error.splitlines() if line.startswith("vericone")]
                self.assertEqual(len(lines), 1, error)
                self.assertTrue(lines[0].startswith(says), lines[0])
                self.assertFalse(os.path.exists(self.path("none")))

    def processes(self):
        """Of vericone-mpi in this test's folder."""
        found = []
        for name in os.listdir("/proc"):
            if name.isdigit():
                try:
                    with open(f"/proc/{name}/cmdline", "rb") as f:
                        mine = f.read().startswith(PROGRAM.encode() + b"\0")
                    if mine and os.readlink(f"/proc/{name}/cwd") == os.path.realpath(self.folder):
                        found.append(int(name))
                except OSError:
                    pass
        return found

    def test_one_is_killed_and_the_same_call_goes_on(self):
        words = ["campaign", "-N", "6000", "--laws", "clearance", "--no-figures", "--quiet"]
        whole, killed = self.path("whole"), self.path("killed")
        self.assertEqual(run(*words, "--out", whole).returncode, 0)
        table = os.path.join(killed, "engagements.csv")
        size = len(contents(whole)["engagements.csv"])
        choose = random.Random(os.environ.get("VERICONE_SEED", 1))
        for _ in range(int(os.environ.get("VERICONE_CASES", 3 if LONG else 1))):
            shutil.rmtree(killed, ignore_errors=True)
            at = choose.uniform(0.05, 0.8)
            with self.start(RANKS, *words, "--out", killed) as process:
                while process.poll() is None and not (os.path.exists(table + ".partial") and
                                                      os.path.getsize(table + ".partial") > at * size):
                    time.sleep(0.005)
                there = self.processes()
                self.assertEqual(len(there), RANKS)
                os.kill(choose.choice(there), signal.SIGKILL)
                begun = time.monotonic()
                process.communicate(timeout=60)
                self.assertLess(time.monotonic() - begun, 10)
            self.assertNotEqual(process.returncode, 0)
            self.assertEqual(self.processes(), [])
            left = os.path.getsize(table + ".partial")
            self.assertTrue(0 < left < size, left)
            status, _, error = self.ranks(RANKS, *words, "--out", killed)
            self.assertEqual((status, error), (0, ""))
            self.assertEqual(contents(killed), contents(whole))


if __name__ == "__main__":
    unittest.main()
