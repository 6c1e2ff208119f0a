# SPDX-License-Identifier: BSD-3-Clause
"""Every command that writes: whole files, all of them or none, one run a folder; every long one ends on Ctrl-C.
Environment: VERICONE (the program), VERICONE_PROGRAMS (those of the family that were built), VERICONE_KILLS (of each
command; 2), VERICONE_TELL (prints how long interruptions took)."""
import fcntl
import hashlib
import json
import math
import os
import random
import resource
import shutil
import signal
import subprocess
import time
import unittest

from bad_input_cases import street
from command import drawn
from hostile_test import SCENARIO, SCENE, VERICONE, InFolder

PROGRAMS = os.environ.get("VERICONE_PROGRAMS", "fit scan track verify").split()
KILLS = int(os.environ.get("VERICONE_KILLS", "2"))
LONG_CAMPAIGN = os.environ.get("VERICONE_CAMPAIGN") == "long"

MESH = "OFF\n4 4 0\n0 0 0\n3 0 0\n0 2 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n"
BALL = {"center": [-9, 1, 1], "semi_axes": [0.5, 0.5, 0.5]}
BEAMS = {"rows": 20, "columns": 20, "horizontal": 0.8, "vertical": 0.8}
LIDARS = json.dumps({"agent": BALL, "obstacle": {"mesh": "t.off"}, "agent_velocity": [1, 0, 0],
                     "lidars": [{"position": [0, 0, 0.6], "towards": [1, 0, 0], "beams": BEAMS}]})
PLANAR = json.dumps({"agent": {"center": [0, 0], "semi_axes": [1, 2]}, "agent_velocity": [1, 0],
                     "obstacle": {"center": [9, 1], "semi_axes": [3, 2], "hyperbolas": [{"semi_axes": [1, 1]}]}})
PIECES = json.dumps({"agent": BALL, "obstacle": {"mesh": "t.off"}, "agent_velocity": [1, 0, 0]})

PURSUIT = json.dumps({
    "duration": 20, "step": 0.02, "picture_step": 0.04, "uas": {"position": [0, 0, 120], "velocity": [20, 0, 0]},
    "cars": [{"name": "B", "position": [5, 5], "road": {"kind": "lanes", "velocity": [20, 0]}}],
    "cameras": {"source": {"width": 320, "height": 240, "field_of_view_deg": 50, "ground": {"plain": True}},
                "perspective": {"width": 320, "height": 240, "field_of_view_deg": 50, "mount": {"kind": "gimbal"}}}})
NOISE = SCENARIO.replace("law: clearance, clearance: {required: 1}", "law: avoidance, manner: source")

# Words of each command that writes.
WRITERS = {
    "signmap": ["signmap", "--cells", "31", "--no-figures"],
    "shapes": ["shapes", "--figure", "biconcave,section", "--mesh", "obj", "--no-figures"],
    "accuracy": ["accuracy", "-N", "60", "--planes", "4,8", "--threads", "1", "--no-figures", "--quiet"],
    "accuracy of dents": ["accuracy", "--obstacle", "biconcave", "-N", "6", "--planes", "4,8", "--tolerance", "0.2",
                          "--no-figures", "--quiet"],
    "estimate": ["estimate", "track.csv"],
    "campaign": ["campaign", "-N", "15", "--threads", "1", "--no-figures", "--quiet"],
    "swarm": ["swarm", "circle", "-N", "3", "--threads", "1", "--no-figures", "--quiet"],
    "cone": ["cone", "scene.yaml", "--map", "0.05", "--no-figures"],
    "cone in the plane": ["cone", "planar.yaml", "--no-figures"],
    "cone of pieces": ["cone", "mesh.yaml", "--map", "0.05", "--no-figures"],
    "gallery": ["gallery", "t.off", "u.off", "--map", "0.02", "--no-figures", "--quiet"],
    "simulate": ["simulate", "scenario.yaml", "--no-figures", "--quiet"],
    "simulate with a page": ["simulate", "scenario.yaml", "--no-figures", "--animate", "--quiet"],
    "trials": ["trials", "noise.yaml", "-N", "4", "--levels", "5:10", "--laws", "di", "--threads", "1", "--no-figures", "--quiet"],
    "claims": ["claims", "5.4.2", "--quiet"],
    "figures": ["figures", "5.6", "--quiet"],
    "fit": ["fit", "ball.xyz", "--shape", "ellipsoid", "--no-figures", "--quiet"],
    "pursue": ["pursue", "pursuit.yaml", "--camera", "exact", "--duration", "150", "--no-figures", "--quiet"],
    "pursue from starts": ["pursue", "pursuit.yaml", "--camera", "exact", "--duration", "80", "--starts", "8", "--threads", "1",
                           "--no-figures", "--quiet"],
    "scan": ["scan", "scan.yaml", "--levels", "2", "--no-figures", "--quiet"],
    "track": ["track", "frames", "--box", "8,16,16,10", "--no-figures", "--quiet"],
}
# Of these an interruption leaves what was done by then; of the others nothing but a table to go on with.
BY_PARTS = ("gallery", "figures")
RESUMED = ("accuracy", "accuracy of dents", "campaign", "pursue from starts", "trials")

# Long work, and what it says on standard error once it is at work; None: it is given half a second from the time on when it
# listens to signals.
LONG = {
    "gallery": (["gallery", "t.off", "u.off", "--map", "0.0001", "--no-figures"], "[1/2]"),
    "accuracy": (["accuracy", "-N", "100000000", "--no-figures"], None),
    "accuracy of many planes": (["accuracy", "-N", "1000", "--planes", "50000,100000", "--no-figures", "--out", "out"], None),
    "accuracy of dents": (["accuracy", "--obstacle", "star", "-N", "100000", "--tolerance", "0.001", "--no-figures"], None),
    "campaign": (["campaign", "-N", "100000000", "--no-figures"], None),
    "swarm": (["swarm", "sphere", "-N", "5000", "--no-figures"], "flying"),
    "trials": (["trials", "noise.yaml", "-N", "10000000", "--no-figures"], None),
    "cone": (["cone", "near.yaml", "--map", "0.0001", "--threads", "1"], None),
    "cone with a folder": (["cone", "near.yaml", "--map", "0.0001", "--threads", "1", "--out", "out"], None),
    "cone of dents": (["cone", "dents.yaml", "--map", "0.0001", "--tolerance", "1e-7", "--threads", "1"], None),
    "cone of pieces": (["cone", "mesh.yaml", "--map", "0.0005", "--out", "out"], None),
    "query": (["query", "-"], None),
    "law": (["law", "-"], None),
    "estimate": (["estimate", "-"], None),
    "signmap": (["signmap", "--cells", "2001", "--no-figures"], None),
    "shapes": (["shapes", "--resolution", "0.02", "--no-figures"], None),
    "claims": (["claims"], "measuring"),
    "figures": (["figures"], "running"),
    "fit": (["fit", "ball.xyz", "--shape", "star", "--pieces", "4", "--no-figures"], "reading"),
    "fit with cones": (["fit", "ball.xyz", "--shape", "ellipsoid", "--cone", "around:100", "--no-figures"], "reading"),
    "pursue": (["pursue", "pursuit.yaml", "--duration", "9000", "--no-figures"], "pursuing"),
    "pursue from starts": (["pursue", "pursuit.yaml", "--camera", "exact", "--starts", "100000", "--no-figures"], None),
    "scan": (["scan", "scan.yaml", "--levels", "8", "--planes", "8000", "--no-figures"], None),
    "track": (["track", "frames", "--box", "8,16,16,10"], "following"),
    "verify of predicates": (["verify", "--cases", "10000000000", "--pairs", "0"], None),
    "verify of pairs": (["verify", "--cases", "0", "--pairs", "1000000"], None),
}


def there(words):
    return words[0] in PROGRAMS or words[0] not in ("fit", "pursue", "scan", "track", "verify")


class InPreparedFolder(InFolder):
    def setUp(self):
        super().setUp()
        rng = random.Random(1)
        points = ""
        for _ in range(3000):
            x = [rng.gauss(0, 1) for _ in range(3)]
            n = math.hypot(*x)
            points += "%f %f %f\n" % (3 * x[0] / n, 2 * x[1] / n, x[2] / n)
        track = "t,x,y\n" + "".join("%g,%g,%g\n" % (0.1 * i, 2 * i, i % 7) for i in range(200))
        for name, content in {"track.csv": track, "scene.yaml": SCENE, "scenario.yaml": SCENARIO, "noise.yaml": NOISE, "t.off": MESH, "u.off": MESH,
                              "mesh.yaml": PIECES, "scan.yaml": LIDARS, "pursuit.yaml": PURSUIT, "ball.xyz": points, "planar.yaml": PLANAR,
                              "near.yaml": SCENE.replace("[5, 0", "[3.05, 0"),
                              "dents.yaml": SCENE.replace("[5, 0", "[3.05, 0").replace("[2, 2, 2]}", "[2, 2, 2], hyperboloids: [{sheets: 2, "
                                                          "semi_axes: [1, 1, 1]}]}")}.items():
            self.write(name, content)
        os.mkdir(os.path.join(self.folder, "frames"))
        for k in range(24):
            with open(os.path.join(self.folder, "frames", "%d.png" % k), "wb") as f:
                f.write(street(k))
        self.out = os.path.join(self.folder, "out")

    def digest(self, name, content):
        """The same of runs that do the same; of what tells times, that it is whole."""
        if name.endswith(".pdf"):
            return content.rstrip().endswith(b"%%EOF")
        if name.endswith(".md"):
            return content.endswith(b"|\n")
        if name.endswith(".json") and (b'"seconds' in content or b'"finished"' in content or b'"ms_median' in content):
            return bool(json.loads(content))
        return hashlib.sha256(content).hexdigest()

    def listing(self):
        """Files in the folder by name, but those that are kept to go on with, and whether anything is unfinished."""
        found, unfinished = {}, []
        for folder, _, names in os.walk(self.out):
            for name in names:
                path = os.path.join(folder, name)
                relative = os.path.relpath(path, self.out)
                if ".partial" in relative:
                    unfinished.append(relative)
                    continue
                with open(path, "rb") as f:
                    found[relative] = self.digest(name, f.read())
        return found, sorted(unfinished)

    def run_limited(self, *arguments, **options):
        return super().run_limited(*arguments, **{"timeout": 280, **options})

    def start(self, words, **options):
        return subprocess.Popen([VERICONE, *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                text=True, **options)


class WritersStopped(InPreparedFolder):
    """Killed at random moments, and interrupted."""
    def reference(self, words):
        """What two whole runs write, the hashes of what both write alike, and how long one takes."""
        runs = []
        for _ in range(2):
            shutil.rmtree(self.out, ignore_errors=True)
            start = time.monotonic()
            result = self.run_limited(*words, preexec_fn=None)
            self.assertEqual(result.returncode, 0, result.stderr)
            seconds = time.monotonic() - start
            files, unfinished = self.listing()
            self.assertEqual(unfinished, [])
            self.assertGreater(len(files), 0)
            runs.append(files)
        self.assertEqual(sorted(runs[0]), sorted(runs[1]))
        return sorted(files), {name: h for name, h in files.items() if runs[0][name] == h}, seconds

    def stop(self, name, words, files, same, sent, after):
        if sent == signal.SIGINT:
            shutil.rmtree(self.out, ignore_errors=True)
        before = set(self.listing()[0])
        with self.start(words) as process:
            time.sleep(after)
            process.send_signal(sent)
            process.communicate()
        found, unfinished = self.listing()
        for one, digest in found.items():
            self.assertEqual(digest, same.get(one, digest), one)  # whole, or not there
        if sent == signal.SIGINT:
            # -2: it had only just begun.
            self.assertIn(process.returncode, (130, 0, -signal.SIGINT))
            self.assertEqual([u for u in unfinished if name not in RESUMED or not u.endswith(".csv.partial")], [])
            if name not in BY_PARTS:
                self.assertEqual(sorted(found), files if process.returncode == 0 else [])
            if not found and not unfinished:
                self.assertFalse(os.path.exists(self.out))
        else:
            self.assertLessEqual(before, set(found))  # what an earlier run wrote is still there
        result = self.run_limited(*words, preexec_fn=None)
        self.assertEqual(result.returncode, 0, result.stderr)
        found, unfinished = self.listing()
        self.assertEqual((sorted(found), unfinished), (files, []))
        self.assertEqual({one: found[one] for one in same}, same)

    def test_whole_files_all_or_none(self):
        rng = random.Random(int(os.environ.get("VERICONE_SEED", "1")))
        for name in drawn(filter(lambda name: there(WRITERS[name]), WRITERS), 3):
            words = [*WRITERS[name], "--out", "out"]
            files, same, seconds = self.reference(words)
            for i in range(KILLS):
                sent = signal.SIGINT if i % 2 else signal.SIGKILL
                after = rng.random() * seconds * 1.2
                if rng.random() < 0.5:
                    shutil.rmtree(self.out, ignore_errors=True)
                with self.subTest(command=name, sent=sent, after=after):
                    self.stop(name, words, files, same, sent, after)


class WritersRefused(InPreparedFolder):
    def test_one_run_a_folder(self):
        os.mkdir(self.out)
        held = os.open(self.out, os.O_RDONLY)
        self.addCleanup(os.close, held)
        fcntl.flock(held, fcntl.LOCK_EX)  # as another run has it
        for name, words in WRITERS.items():
            if there(words):
                with self.subTest(command=name):
                    self.refused(self.run_limited(*words, "--out", "out", preexec_fn=None), "--out: got out", "no other run")
                    self.assertEqual(os.listdir(self.out), [])

    def test_folders_that_cannot_be(self):
        self.write("file", "")
        for name, words in WRITERS.items():
            if there(words):
                for out in ("/proc/vericone", "file", "file/out"):
                    with self.subTest(command=name, out=out):
                        self.refused(self.run_limited(*words, "--out", out, preexec_fn=None), "--out: got " + out, "a folder")

    def test_a_full_disk(self):
        # A limit on the size of files stands for the disk: the write fails with another reason.
        def small():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))
        for name, words in WRITERS.items():
            if there(words) and name not in BY_PARTS:
                with self.subTest(command=name):
                    shutil.rmtree(self.out, ignore_errors=True)
                    result = self.run_limited(*words, "--out", "out", preexec_fn=small)
                    self.assertEqual((result.returncode, len(result.stderr.splitlines())), (1, 1), result.stderr)
                    self.assertIn("File too large", result.stderr)
                    self.assertEqual(self.listing()[0], {})
                    if name not in RESUMED:
                        self.assertFalse(os.path.exists(self.out))

    def test_a_new_paper_on_a_full_disk(self):
        def small():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))
        result = self.run_limited("paper", "new", "mine", preexec_fn=small)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"^vericone: could not write mine/\S+: File too large\n$")
        self.assertFalse(os.path.exists(os.path.join(self.folder, "mine")))

    def test_pictures_of_an_earlier_run_go(self):
        draws = (name for name, words in WRITERS.items()
                 if there(words) and "--no-figures" in words and not name.startswith(("shapes", "gallery")))
        for name in drawn(draws, 3):
            with self.subTest(command=name):
                shutil.rmtree(self.out, ignore_errors=True)
                os.mkdir(self.out)
                names = ("accuracy", "engagement", "scans", "campaign", "swarm", "trials", "cone", "cone_map", "signmap", "simulation", "fit",
                         "visible_section", "scan_convergence", "tracks", "pursuit", "starts")
                for picture in names:
                    self.write("out/%s.png" % picture, "old")
                self.write("out/mine.png", "not ours")
                self.assertEqual(self.run_limited(*WRITERS[name], "--out", "out", preexec_fn=None).returncode, 0)
                left = [n for n in os.listdir(self.out) if n.endswith(".png")]
                self.assertIn("mine.png", left)
                self.assertLess(len(left), len(names) + 1)


class WritersDraw(InPreparedFolder):
    def test_pictures_in_an_active_environment(self):
        if subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], capture_output=True, check=False).returncode:
            self.skipTest("no /usr/bin/python3 with matplotlib")
        environment = os.path.join(self.folder, "v")  # without packages
        subprocess.run(["/usr/bin/python3", "-m", "venv", "--without-pip", environment], check=True)
        active = {**os.environ, "PATH": os.path.join(environment, "bin") + ":" + os.environ["PATH"],
                  "VIRTUAL_ENV": environment, "PYTHONPATH": self.folder}
        for name in drawn((n for n, words in WRITERS.items() if there(words) and n not in ("claims", "estimate")), 4):
            words = WRITERS[name]
            with self.subTest(command=name):
                shutil.rmtree(self.out, ignore_errors=True)
                left_out = ["--no-figures"]
                if name == "cone of pieces":
                    left_out += ["--map", "0.05"]  # the cone's is drawn by the same script
                result = self.run_limited(*(w for w in words if w not in left_out), "--out", "out", preexec_fn=None, env=active)
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                found, unfinished = self.listing()
                # What a camera saw is no drawing.
                pictures = [n for n in found if n.endswith(".png") and n not in ("first_picture.png", "seen.png")]
                self.assertGreater(len(pictures), 0)
                self.assertEqual(unfinished, [])
                for picture in pictures:
                    self.assertIn(picture[:-4] + ".pdf", found)
                    with open(os.path.join(self.out, picture), "rb") as f:
                        self.assertEqual(f.read(4), b"\x89PNG")


class Interruptions(InPreparedFolder):
    @staticmethod
    def caught(pid):
        """The signals that a process handles, one a bit: none before it is the program that was called."""
        with open("/proc/%d/status" % pid, encoding="ascii") as f:
            return next(int(line.split()[1], 16) for line in f if line.startswith("SigCgt:"))

    def test_long_work_ends_at_once(self):
        signals = (signal.SIGINT, signal.SIGTERM)
        for name in drawn((name for name, (words, _) in LONG.items() if there(words)), 2):
            words, sign = LONG[name]
            turn = list(LONG).index(name)
            # One handler takes both (scenes/work/interrupt.cpp): a command has one of them, in the campaign both.
            for sent in signals if LONG_CAMPAIGN else signals[turn % 2:turn % 2 + 1]:
                with self.subTest(command=name, sent=sent), self.start(words, stdin=subprocess.PIPE) as process:
                    if sign:
                        while sign not in (line := process.stderr.readline()):
                            self.assertTrue(line, "ended before it began")
                    while process.poll() is None and not self.caught(process.pid) & 1 << signal.SIGINT - 1:
                        time.sleep(0.01)
                    time.sleep(0.1 if sign else 0.5)
                    self.assertIsNone(process.poll(), "too quick to be interrupted")
                    start = time.monotonic()
                    process.send_signal(sent)
                    said, _ = process.communicate()
                    seconds = time.monotonic() - start
                    if "VERICONE_TELL" in os.environ:
                        print("%-26s %-8s %.2f s" % (name, sent.name, seconds))
                    self.assertEqual(process.returncode, 130)
                    self.assertLess(seconds, 3)  # 0.4 s where processors are free (docs/reference/formats.md)
                    if words[0] == "verify":
                        self.assertIn("interrupted; by then 0 wrong of ", said)


if __name__ == "__main__":
    unittest.main()
