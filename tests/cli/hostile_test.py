# SPDX-License-Identifier: BSD-3-Clause
"""Input by strangers, folders that refuse, runs that are killed. Environment: VERICONE (the program)."""
import json
import os
import random
import resource
import signal
import subprocess
import tempfile
import time
import unittest

VERICONE = os.path.abspath(os.environ["VERICONE"])
GIGABYTE = 10 ** 9

SCENARIO = """duration: 2
step: 0.02
bodies:
  - {name: A, shape: {semi_axes: [3, 1.5, 1]}, position: [0, 0, 0], speed: 10, heading_deg: [0, 0],
     pilot: {law: clearance, clearance: {required: 1}, gain: 4, most: 15}}
  - {name: B, shape: {semi_axes: [5, 2, 2]}, position: [45, 3, 1], velocity: [-5, -0.5, 0]}
"""
SCENE = "agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\nobstacle: {center: [5, 0, 0], semi_axes: [2, 2, 2]}\n"
REST = ('"agent": {"center": [0, 0, 0], "semi_axes": [1, 1, 1]}, "obstacle": {"center": [5, 0, 0], '
        '"semi_axes": [2, 2, 2]}, "agent_velocity": [4, 3, 0], "obstacle_velocity": [0, 0, 0]}')
GOOD = '{"id": 2, ' + REST


def limited():
    resource.setrlimit(resource.RLIMIT_AS, (GIGABYTE, GIGABYTE))


class InFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = holder.name

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        with open(path, "wb") as f:
            f.write(content if isinstance(content, bytes) else content.encode())
        return path

    def run_limited(self, *arguments, **options):
        options = {"text": True, "timeout": 60, "preexec_fn": limited, "cwd": self.folder, **options}
        return subprocess.run([VERICONE, *arguments], capture_output=True, check=False, **options)

    def refused(self, result, *parts):
        """One line with these parts, status 2, nothing on standard output."""
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertEqual(result.stdout, "")
        self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
        self.assertNotRegex(result.stderr, "[\x00-\x09\x0b-\x1f\x7f]")
        self.assertRegex(result.stderr, r"^vericone: .*got .+, must be .+")
        for part in parts:
            self.assertIn(part, result.stderr)


class HostileScenes(InFolder):
    def scene(self, content, *parts):
        path = self.write("scene.yaml", content)
        before = sorted(os.listdir(self.folder))
        self.refused(self.run_limited("cone", path), *parts)
        self.refused(self.run_limited("simulate", path, "--quiet"), *parts)
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_aliases_that_multiply(self):
        lines, before = ["x0: &x0 [a, a, a, a, a, a, a, a, a]"], "x0"
        for i in range(1, 10):
            lines.append("x%d: &x%d [%s]" % (i, i, ", ".join(["*" + before] * 9)))
            before = "x%d" % i
        self.scene("\n".join(lines), "more than 1000000 values")

    def test_aliases_are_what_they_name(self):
        path = self.write("scene.yaml", "agent: {center: [0, 0, 0], semi_axes: &r [1, 1, 1]}\n"
                          "obstacle: {center: [5, 0, 0], semi_axes: *r}\n")
        self.assertEqual(self.run_limited("cone", path, "--json").returncode, 0)

    def test_nesting_by_aliases_and_within_itself(self):
        lines = ["x0: &x0 [1]"] + ["x%d: &x%d [*x%d]" % (i, i, i - 1) for i in range(1, 60)]
        self.scene("\n".join(lines), "more than 20 levels")
        self.scene("a: &a [*a]\n", "itself")
        self.scene("[" * 100, "more than 20 levels")

    def test_text_that_is_none(self):
        self.scene(b"name: caf\xe9\n" + SCENARIO.encode(), "name: ", "\\xe9", "UTF-8")
        self.scene('name: "red \\e[31m"\n' + SCENARIO, "name: ", "control characters")
        self.scene('name: "two\\nlines"\n' + SCENARIO, "name: ", "one line")
        self.scene('"na\\tme": 1\n' + SCENARIO, "control characters")

    def test_two_documents(self):
        self.scene(SCENARIO + "---\n" + SCENARIO, "more than one document")

    def test_what_is_no_file(self):
        self.refused(self.run_limited("cone", self.folder), "cannot be read", "directory")
        self.refused(self.run_limited("cone", "/dev/zero"), "more than 16 MiB")
        self.refused(self.run_limited("simulate", "/dev/zero", "--quiet"), "more than 16 MiB")

    def test_pipes_are_files(self):
        self.assertEqual(self.run_limited("cone", "/dev/stdin", input=SCENE).returncode, 0)
        result = self.run_limited("simulate", "/dev/stdin", "--out", "out", "--no-figures", "--quiet", input=SCENARIO)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(os.path.join(self.folder, "out", "scenario.yaml"), encoding="utf-8") as f:
            self.assertEqual(f.read(), SCENARIO)

    def test_names_of_files_reach_no_terminal(self):
        self.refused(self.run_limited("cone", "red\x1b[31m\n.yaml"), "\\x1b[31m\\x0a.yaml")

    def test_runs_too_long_for_memory(self):
        path = self.write("long.yaml", SCENARIO.replace("duration: 2", "duration: 100000"))
        self.refused(self.run_limited("simulate", path, "--quiet"), "step: got 0.02", "3000000 rows")


class HostileCases(InFolder):
    def answers(self, *lines):
        result = self.run_limited("query", "-", input="\n".join(lines) + "\n")
        self.assertEqual(result.stderr, "")
        answers = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual(len(answers), len(lines))
        return result, answers

    def test_nested_deeply(self):
        deep = "[" * 100000 + "]" * 100000
        result, answers = self.answers(GOOD, '{"id": ' + deep + ", " + REST, deep, "[" * 100000, GOOD)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(["error" in a for a in answers], [False, True, True, True, False])
        self.assertEqual([a["id"] for a in answers], [2, None, None, None, 2])
        self.assertIn("100001 levels", answers[1]["error"])

    def test_very_many_keys_and_values(self):
        start = time.monotonic()
        keys = "{" + ", ".join('"k%d": 1' % i for i in range(30000)) + "}"
        _, answers = self.answers(keys, "[" + ",".join(["{}"] * 200000) + "]", GOOD)
        self.assertEqual(["error" in a for a in answers], [True, True, False])
        self.assertIn("more than 100 fields", answers[0]["error"])
        self.assertLess(time.monotonic() - start, 5)  # 0.3 s; 7 s and a minute before

    def test_ids_come_back_as_written(self):
        ids = ["123456789012345678901234567890", "9007199254740993", "-0.10", "1E5", '"\\u00e9"', "null",
               '{"a": [1, 12345678901234567890123]}', '"id"', '[",", "}", "\\""]']
        lines = ['{"id": %s, %s' % (i, REST) for i in ids]
        result = self.run_limited("query", "-", input="\n".join(lines) + "\n")
        self.assertEqual(result.returncode, 0)
        for given, line in zip(ids, result.stdout.splitlines(), strict=True):
            self.assertTrue(line.startswith('{"id":%s,"verdict":"on"' % given), line)
        result = self.run_limited("query", "-", input='{"id":\t[1,\r{"a"\t: 2}] , ' + REST + "\n" + GOOD + "\0}\n")
        first, second = result.stdout.split("\n")[:2]
        self.assertTrue(first.startswith('{"id":[1, {"a" : 2}],"verdict":"on"'), first)
        self.assertIn("a zero byte", second)
        _, (last, inner, escaped) = self.answers("{" + REST[:-1] + ', "id": 7}', '{"agent": {"id": 8}, "id": 9}',
                                                 '{"\\u0069d": 5, ' + REST)
        self.assertEqual((last["id"], inner["id"], escaped["id"]), (7, 9, 5))

    def test_endless_lines_and_what_is_no_file(self):
        self.refused(self.run_limited("query", "/dev/zero"), "/dev/zero:1", "16 MiB")
        self.refused(self.run_limited("query", self.folder), "directory")
        self.refused(self.run_limited("query", "nowhere.jsonl"), "no such file")
        path = self.write("long.jsonl", GOOD + "\n" + " " * (17 << 20))
        result = self.run_limited("query", path)
        self.assertEqual((result.returncode, len(result.stdout.splitlines())), (2, 1))
        self.assertIn(":2: got a line of more than 16 MiB", result.stderr)

    def test_faces_left_out_are_told(self):
        self.write("mesh.obj", "v 9 -1 -1\nv 9 1 -1\nv 9 0 1\nv nan 0 0\nf 1 2 3\nf 1 2 4\n")
        _, (answer,) = self.answers('{"agent": {"center": [0, 0, 0], "semi_axes": [1, 1, 1]}, "obstacle": {"mesh": '
                                    '"mesh.obj"}, "agent_velocity": [1, 0, 0], "obstacle_velocity": [0, 0, 0]}')
        self.assertEqual((answer["verdict"], answer["dropped_faces"]), ("in", 1))


    def test_a_triangle_of_any_size(self):
        """The plane 0.6 x + 0.8 y = 5, or x = 5, in triangles that are exact in doubles: the time is right, or not told."""
        told = 0
        for size in (1, 1e3, 1e6, 1e9, 1e12, 1e15, 1e50, 1e300):
            for tilted in (False, True) if size < 1e13 else (False,):
                across = (-4, 3) if tilted else (0, 5)
                corners = [((3 if tilted else 5) + a * size * across[0], (4 if tilted else 0) + a * size * across[1], b * size)
                           for a, b in ((-1, -1), (1, -1), (0, 2))]
                self.write("t.off", "OFF\n3 1 0\n" + "".join("%r %r %r\n" % tuple(map(float, c)) for c in corners) + "3 0 1 2\n")
                for w in ((1, 0, 0), (0.5, 1, 0.25)):
                    _, (answer,) = self.answers(json.dumps({
                        "agent": {"center": [0, 0, 0], "semi_axes": [1, 1, 1]}, "obstacle": {"mesh": "t.off"},
                        "agent_velocity": w, "obstacle_velocity": [0, 0, 0]}))
                    if answer["verdict"] == "out":
                        self.assertEqual(size, 1)
                        continue
                    true = 4 / (0.6 * w[0] + 0.8 * w[1] if tilted else w[0])
                    low, high = answer["time_enclosure"]
                    self.assertTrue(low <= true * (1 + 1e-15) and (high is None or true <= high * (1 + 1e-15)), answer)
                    if answer["time_to_contact"] is not None:
                        told += 1
                        self.assertAlmostEqual(answer["time_to_contact"], true, delta=1e-9 * true)
        self.assertGreaterEqual(told, 10)  # up to 1000 km they are


class Mutations(InFolder):
    """Good lines with bytes changed, cut, doubled and moved: one answer a line, no crash, in bounded memory."""
    COUNT = 3000
    TOKENS = ["{", "}", "[", "]", ",", ":", '"', "\\", "null", "1e999", "-", "1e-320", "9" * 40, "\x00", "\r", "\xe9",
              '"id":', '"agent":', '"shape": [[1,0,0],[0,1,0],[0,0,1]],', '"points": [[0,0,0],[1,0,0]],', "\\u0000"]

    def mutated(self, rng, line):
        text = list(line)
        for _ in range(rng.randint(1, 4)):
            i, j = sorted((rng.randrange(len(text) + 1), rng.randrange(len(text) + 1)))
            kind = rng.randrange(5)
            if kind == 0:
                text[i:i] = rng.choice(self.TOKENS)
            elif kind == 1:
                del text[i:min(j, i + 20)]
            elif kind == 2:
                text[i:i] = text[i:min(j, i + 200)]
            elif kind == 3 and i < len(text):
                text[i] = chr(rng.choice([c for c in range(256) if c != 10]))
            else:
                digits = [k for k, c in enumerate(text) if c.isdigit()]
                if digits:
                    text[rng.choice(digits)] = rng.choice(["0", "-1", "1e300", "1e-300", "7", "0.1"])
        return "".join(text).encode("latin-1")

    def test_one_answer_a_line(self):
        seed = int(os.environ.get("VERICONE_MUTATION_SEED", "1"))
        rng = random.Random(seed)
        good = [GOOD, GOOD.replace("}, \"agent_velocity", ', "rotation": [0.6, 0, 0.8, 0]}, "agent_velocity'),
                '{"id": [1, {"a": "b"}], ' + REST,
                '{"agent": {"center": [0, 0], "semi_axes": [1, 2]}, "obstacle": {"center": [9, 0], "semi_axes": [2, 1]}, '
                '"agent_velocity": [1, 0], "obstacle_velocity": [0, 0]}',
                GOOD.replace('"center": [5, 0, 0], "semi_axes": [2, 2, 2]',
                             '"points": [[4, 0, 0], [5, 1, 0], [5, 0, 1], [6, 0, 0]]')]
        lines = [self.mutated(rng, rng.choice(good)) for _ in range(self.COUNT)]
        result = self.run_limited("query", "-", input=b"\n".join(lines) + b"\n", text=False)
        self.assertIn(result.returncode, (0, 2), "seed %d: %s" % (seed, result.stderr))
        self.assertEqual(result.stderr, b"")
        answered = [line for line in lines if line.strip(b" \t\r")]
        answers = [json.loads(a) for a in result.stdout.splitlines()]
        self.assertEqual(len(answers), len(answered))
        good_answers = sum("error" not in a for a in answers)
        self.assertGreater(good_answers, self.COUNT // 50)
        self.assertLess(good_answers, self.COUNT // 2)


class Counts(InFolder):
    def test_counts_out_of_range(self):
        for command in (["accuracy"], ["campaign"], ["signmap"]):
            for seed in ("-1", "18446744073709551616", "99999999999999999999", "1.5", "x"):
                with self.subTest(command=command, seed=seed):
                    result = self.run_limited(*command, "--seed", seed)
                    self.assertEqual((result.returncode, result.stdout), (2, ""))
                    self.assertIn("--seed: got %s, must be a whole number" % seed, result.stderr)
        self.assertEqual(os.listdir(self.folder), [])


class Writing(InFolder):
    def simulate(self, out, *more):
        self.write("scenario.yaml", SCENARIO)
        return self.run_limited("simulate", "scenario.yaml", "--quiet", "--no-figures", "--out", out, *more)

    def names(self, *folders):
        return sorted(os.listdir(os.path.join(self.folder, *folders)))

    def test_a_folder_in_the_way_of_a_file(self):
        os.makedirs(os.path.join(self.folder, "out", "run.json"))
        self.refused(self.simulate("out"), "run.json")
        self.assertEqual(self.names("out"), ["run.json"])

    def test_everything_stays_within_the_folder(self):
        # Its parent is read only, as is that of a mounted volume.
        os.mkdir(os.path.join(self.folder, "here"))
        result = self.simulate("here/")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.names(), ["here", "scenario.yaml"])
        self.assertNotIn(".partial", "".join(self.names("here")))

    @unittest.skipIf(os.geteuid() == 0, "nothing is read only for root")
    def test_a_folder_that_is_read_only(self):
        os.mkdir(os.path.join(self.folder, "out"), 0o555)
        self.refused(self.simulate("out"), "can be written to; Permission denied")

    def test_a_folder_that_cannot_be_made(self):
        self.refused(self.simulate("/proc/vericone"), "can be written to; ")
        result = self.run_limited("accuracy", "-N", "10", "--out", "/proc/vericone")
        self.refused(result, "can be written to; ")

    def test_bad_input_leaves_no_folder(self):
        result = self.run_limited("simulate", "nowhere.yaml", "--out", "made/by/us")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(self.names(), [])

    def test_full_disk_is_told_at_once_and_work_goes_on_later(self):
        # A limit on the size of files stands for the disk: the write fails with another reason.
        def small():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, 20000))
        arguments = ["--seed", "3", "--planes", "3,6,12", "--no-figures", "--quiet", "--out", "out"]
        start = time.monotonic()
        result = self.run_limited("accuracy", "-N", "100000000", *arguments, preexec_fn=small)
        self.assertEqual(result.returncode, 1)
        self.assertIn("engagements.csv.partial: File too large", result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertLess(time.monotonic() - start, 20)  # all rows would take hours
        # What was written is used: the settings tell the number of engagements, so this one is refused.
        other = self.run_limited("accuracy", "-N", "200", *arguments)
        self.refused(other, "--out", "unfinished run of other settings")

    def test_a_link_to_itself_hides_no_other_file(self):
        os.mkdir(os.path.join(self.folder, "scans"))
        os.symlink("loop.obj", os.path.join(self.folder, "scans", "loop.obj"))
        self.write("scans/t.off", "OFF\n4 4 0\n0 0 0\n3 0 0\n0 2 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n3 1 2 3\n")
        result = self.run_limited("gallery", "scans", "--out", "out", "--no-figures", "--map", "0")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.names("out"), ["gallery.json", "gallery.md", "provenance.json", "t-off"])

    def test_two_runs_in_one_folder(self):
        with subprocess.Popen([VERICONE, "campaign", "-N", "10000000", "--quiet", "--out", "out"], cwd=self.folder) as first:
            partial = os.path.join(self.folder, "out", "engagements.csv.partial")
            while not os.path.exists(partial):
                time.sleep(0.01)
            self.refused(self.run_limited("campaign", "-N", "10", "--quiet", "--out", "out"), "no other run")
            self.refused(self.simulate("out/../out"), "no other run")
            self.assertEqual(self.simulate("out2").returncode, 0)
            first.kill()
        self.assertEqual(self.simulate("out").returncode, 0)  # a dead run holds nothing

    def test_what_a_killed_run_left_is_removed(self):
        os.makedirs(os.path.join(self.folder, "out", ".partial-123456"))
        self.write("out/.partial-123456/run.json", "half")
        self.write("out/mine.partial-123456", "not ours")
        self.assertEqual(self.simulate("out").returncode, 0)
        self.assertEqual([n for n in self.names("out") if "partial" in n], ["mine.partial-123456"])

    def test_interrupts_are_heeded_at_once(self):
        ball = "  - {name: B%d, shape: {semi_axes: [1, 1, 1]}, position: [%d, %d, 0], velocity: [-1, 0, 0]}\n"
        self.write("many.yaml", SCENARIO + "".join(ball % (i, 100 + 5 * (i % 50), 5 * (i // 50)) for i in range(3000)))
        with subprocess.Popen([VERICONE, "simulate", "many.yaml", "--out", "out"], cwd=self.folder,
                              stderr=subprocess.PIPE, text=True) as run:
            self.assertIn("simulating", run.stderr.readline())
            start = time.monotonic()
            run.send_signal(signal.SIGINT)
            self.assertEqual(run.wait(), 130)
            self.assertLess(time.monotonic() - start, 2)  # 0.3 s where processors are free
        self.assertEqual(self.names(), ["many.yaml"])


class Pictures(InFolder):
    def signmap(self, **environment):
        return self.run_limited("signmap", "--cells", "3", "--out", "out", preexec_fn=None,
                                env={**os.environ, **environment})

    def test_an_active_environment_changes_nothing(self):
        if subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], capture_output=True, check=False).returncode:
            self.skipTest("no /usr/bin/python3 with matplotlib")
        venv = os.path.join(self.folder, "v")
        subprocess.run(["/usr/bin/python3", "-m", "venv", "--without-pip", venv], check=True)
        result = self.signmap(PATH=os.path.join(venv, "bin") + ":" + os.environ["PATH"], VIRTUAL_ENV=venv,
                              PYTHONPATH=self.folder, PYTHONHOME=venv)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertTrue(os.path.exists(os.path.join(self.folder, "out", "signmap.png")))
        # One without packages, by name: everything but the pictures.
        result = self.signmap(VERICONE_PYTHON=os.path.join(venv, "bin", "python3"))
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, r"^vericone: no pictures: .*No module named.*VERICONE_PYTHON\n$")

    def test_without_python_the_numbers_are_given(self):
        result = self.signmap(VERICONE_PYTHON="/nowhere/python3")
        self.assertEqual(result.returncode, 0)
        self.assertRegex(result.stderr, r"^vericone: no pictures: no interpreter /nowhere/python3; .*\n$")
        self.assertIn("velocities around", result.stdout)
        self.assertTrue(os.path.exists(os.path.join(self.folder, "out", "signmap.csv")))
        self.write("scenario.yaml", SCENARIO)
        result = self.run_limited("simulate", "scenario.yaml", "--quiet", "--out", "run", preexec_fn=None,
                                  env={**os.environ, "VERICONE_PYTHON": "/nowhere/python3"})
        self.assertEqual((result.returncode, len(result.stderr.splitlines())), (0, 1))
        self.assertTrue(os.path.exists(os.path.join(self.folder, "run", "proof.json")))


if __name__ == "__main__":
    unittest.main()
