# SPDX-License-Identifier: BSD-3-Clause
"""`vericone NAME` finds the program `vericone-NAME`, and the programs behave as one. Environment, besides that of
command.py: VERICONE_PROGRAMS, the names of those that were built."""
import json
import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from command import SOURCE, VERICONE, ball, engagement, run  # noqa: E402

PROGRAMS = os.environ["VERICONE_PROGRAMS"].split()
NEEDS = {"fit": "VERICONE_FITTING", "pursue": "VERICONE_VISION", "scan": "VERICONE_LIDAR", "track": "VERICONE_VISION",
         "verify": "VERICONE_VERIFY", "rows": "VERICONE_HDF5", "mpi": "VERICONE_MPI"}
HEAVY = ("CGAL", "gmp", "mpfr", "ceres", "embree", "Open3D", "opencv", "qhull")


def call(program, *arguments, **options):
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=False, **options)


def program_beside(name):
    return os.path.join(os.path.dirname(VERICONE), "vericone-" + name)


class Family(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.prefix = folder.name
        self.core = os.path.join(self.prefix, "bin", "vericone")
        os.mkdir(os.path.dirname(self.core))
        shutil.copy(VERICONE, self.core)

    def add_program(self, folder, name="echo"):
        """A script that prints where it stands and its arguments, one a line, and ends with 7."""
        folder = os.path.join(self.prefix, folder)
        os.makedirs(folder, exist_ok=True)
        path = os.path.join(folder, "vericone-" + name)
        with open(path, "w", encoding="utf-8") as f:
            f.write('#!/bin/sh\nprintf "%s\\n" "$0" "$@"\nexit 7\n')
        os.chmod(path, os.stat(path).st_mode | stat.S_IXUSR)
        return path

    def call_core(self, *arguments, path=""):
        return call(self.core, *arguments, env={**os.environ, "PATH": path})

    def test_one_version(self):
        version = run("--version").stdout
        self.assertRegex(version, r"^vericone \d+\.\d+\.\d+ \(.+\)\n$")
        for name in PROGRAMS:
            for result in (run(name, "--version"), call(program_beside(name), "--version")):
                self.assertEqual((result.returncode, result.stdout), (0, version), name)

    def test_one_help(self):
        for name in PROGRAMS:
            through, direct = run(name, "--help"), call(program_beside(name), "--help")
            self.assertEqual((through.returncode, direct.returncode), (0, 0))
            self.assertIn("Usage: %s %s [OPTIONS]" % (VERICONE, name), through.stdout)
            self.assertEqual(through.stdout.replace("%s %s " % (VERICONE, name), program_beside(name) + " "),
                             direct.stdout)
            self.assertEqual(run("--help", name).stdout, through.stdout)
            self.assertIn(through.stdout.splitlines()[0], run("--help").stdout)

    def test_errors_are_those_of_the_family(self):
        for name in PROGRAMS:
            result = call(program_beside(name), "--such")
            self.assertEqual(result.returncode, 2)
            self.assertEqual(result.stderr, "vericone: no option --such (see vericone %s --help)\n" % name)
            self.assertEqual(run(name, "--such").stderr, result.stderr)

    def test_a_full_standard_output(self):
        case = json.dumps(engagement(ball([0, 0, 0], 1), ball([5, 0, 0], 2), [1, 0, 0])) + "\n"
        scene = os.path.join(SOURCE, "docs/examples/first.yaml")
        for words in (["query", "-"], ["cone", scene], ["cone", scene, "--json"], ["estimate", "-"], ["--help"], ["cone", "--help"],
                      ["--version"]):
            for given in (case, 3000 * case) if words[0] == "query" else ("t,x,y\n0,1,2\n",):
                with self.subTest(words=words), open("/dev/full", "w", encoding="utf-8") as full:
                    done = subprocess.run([VERICONE, *words], input=given, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
                    self.assertEqual((done.returncode, done.stderr),
                                     (1, "vericone: could not write to standard output: No space left on device\n"))

    def test_every_help_has_examples_and_exit_statuses(self):
        commands = re.findall(r"^  ([a-z][a-z-]*) ", run("--help").stdout, re.MULTILINE)
        self.assertIn("cone", commands)
        for name in commands:
            if name in NEEDS and name not in PROGRAMS:
                continue
            text = run(name, "--help").stdout
            examples = re.findall(r"\n  vericone (%s .*)" % name, text) + re.findall(r"\n  vericone (%s)\n" % name, text)
            self.assertEqual(len(examples), 2, name)
            for status in ("0  ", "1  ", "2  ", "130"):
                self.assertEqual(len(re.findall(r"\n  %s  \S" % status, text)), 1, (name, status))
            # Every option of an example is one of this help.
            for option in re.findall(r" (--?[a-zA-Z][a-z-]*)", "\n".join(examples)):
                self.assertRegex(text, r"[ ,]%s[ ,\n]" % option, name)

    def test_options_mean_the_same_everywhere(self):
        have = {"--quiet": "cone query law estimate accuracy signmap gallery shapes view reach certify simulate campaign swarm trials claims figures pursue scan "
                           "fit track verify",
                "--json": "cone query law estimate accuracy signmap gallery shapes view reach certify simulate campaign swarm trials claims figures pursue scan "
                          "fit track verify",
                "--out": "cone estimate accuracy signmap gallery shapes simulate campaign swarm trials claims figures pursue scan fit track",
                "--no-figures": "cone accuracy signmap gallery shapes simulate campaign swarm trials pursue scan fit track",
                "--threads": "cone query accuracy gallery campaign swarm trials pursue verify",
                "--seed": "accuracy signmap campaign swarm trials pursue scan fit verify"}
        for option, commands in have.items():
            for name in commands.split():
                if name in NEEDS and name not in PROGRAMS:
                    continue
                self.assertRegex(run(name, "--help").stdout, r"\n  %s[ ,=]" % option, name)

    def test_the_nearest_word_is_named(self):
        for words, said in ((["querry"], "no subcommand querry, did you mean query (see vericone --help)"),
                            (["simulte"], "no subcommand simulte, did you mean simulate (see vericone --help)"),
                            (["cone", "--jsno"], "no option --jsno, did you mean --json (see vericone cone --help)"),
                            (["cone", "x", "--plane=3"], "no option --plane, did you mean --planes (see vericone cone --help)"),
                            (["query", "-z", "x"], "no option -z (see vericone query --help)")):
            result = run(*words)
            self.assertEqual((result.returncode, result.stdout, result.stderr), (2, "", "vericone: %s\n" % said))
        self.assertRegex(run("bogus").stderr, r"^vericone: no subcommand bogus; there are check, query, cone, .*\n$")

    def test_usage_without_words(self):
        alone = run()
        self.assertEqual((alone.returncode, alone.stdout), (2, ""))
        self.assertEqual(alone.stderr, run("--help").stdout + "vericone: no command given\n")
        self.assertEqual(run("help").stdout, run("--help").stdout)
        self.assertEqual(run("help", "cone").stdout, run("cone", "--help").stdout)

    @unittest.skipUnless("verify" in PROGRAMS, "this build has no vericone verify")
    def test_verify_ends_with_its_verdict(self):
        result = run("verify", "--cases", "20", "--pairs", "0", "--quiet")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        *_, ran, verdict = result.stdout.splitlines()
        self.assertRegex(ran, r"^--cases 20: 32 of each predicate, in blocks of 16")
        self.assertRegex(verdict, r"^0 wrong of \d+ statements; 0 intervals wider than asked \(not wrong\)$")
        told = json.loads(run("verify", "--cases", "20", "--pairs", "0", "--quiet", "--json").stdout)
        asked = sum(p["compared_with_exact"] + p["checked_against_cgal"] for p in told["predicates"])
        self.assertEqual(told["statements"], asked)
        self.assertIn(" %d statements" % asked, verdict)
        # Parts have all reports, each once, but for their times.
        parts = [json.loads(run("verify", "--cases", "20", "--pairs", "1", "--quiet", "--json", "--part", f"{k}/3").stdout) for k in (1, 2, 3)]
        whole = json.loads(run("verify", "--cases", "20", "--pairs", "1", "--quiet", "--json").stdout)
        for name in ("predicates", "sector_by_support", "sector_by_degenerate_conics", "cones_in_space", "assemblies"):
            def known(told):
                return sorted(json.dumps({k: v for k, v in report.items() if "nanoseconds" not in k}) for report in told[name])
            self.assertEqual(sorted(report for part in parts for report in known(part)), known(whole))
        self.assertEqual(sum(part["statements"] for part in parts), whole["statements"])

    def test_the_core_alone_says_what_is_missing(self):
        listed = self.call_core("--help").stdout
        for name, option in NEEDS.items():
            self.assertRegex(listed, r"\n  %s .*\(needs a build with %s\)\n" % (name, option))
            result = self.call_core(name, "x")
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertRegex(result.stderr, r"^vericone: %s: got a command without .*, must be a build with %s\n$"
                             % (name, option))

    def test_no_command_that_is_there_needs_anything(self):
        listed = run("--help").stdout
        for name in PROGRAMS:
            self.assertNotRegex(listed, r"\n  %s .*needs" % name)

    def test_places_in_order(self):
        first = self.add_program("bin")
        second = self.add_program(os.path.join("libexec", "vericone"))
        third = self.add_program("elsewhere")
        for expected in (first, second, third):
            result = self.call_core("echo", "a", "b c", "--json", path=os.path.dirname(third))
            where, *arguments = result.stdout.splitlines()
            self.assertTrue(os.path.samefile(where, expected), (where, expected))
            self.assertEqual((result.returncode, arguments), (7, ["a", "b c", "--json"]))
            os.remove(expected)
        self.assertEqual(self.call_core("echo", path=os.path.dirname(third)).returncode, 2)

    def test_only_names_are_looked_for(self):
        self.add_program("bin")
        self.add_program(os.path.join("bin", "vericone-x"), name="y")
        for name in ("x/vericone-y", "./echo", "ECHO", "echo*", ""):
            result = self.call_core(name)
            self.assertEqual((result.returncode, result.stdout), (2, ""), name)

    def test_core_commands_are_not_replaced(self):
        self.add_program("bin", name="cone")
        self.assertEqual(self.call_core("cone").stderr, run("cone").stderr)

    def test_the_core_loads_little(self):
        libraries = call("ldd", VERICONE).stdout
        self.assertIn("libc.so", libraries)
        for library in HEAVY:
            self.assertNotIn(library.lower(), libraries.lower())
        self.assertLess(len(libraries.splitlines()), 30)


if __name__ == "__main__":
    unittest.main()
