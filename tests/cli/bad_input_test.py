# SPDX-License-Identifier: BSD-3-Clause
"""Input that every command refuses, and the table of it in docs/reference/bad-input.md."""
import os
import unittest

import bad_input_cases
from command import SOURCE, VERICONE


class BadInput(unittest.TestCase):
    def test_every_bad_line_names_its_field(self):
        self.every_line(bad_input_cases.QUERIES, "query")

    def test_every_bad_state_names_its_field(self):
        self.every_line(bad_input_cases.LAWS, "law")

    def every_line(self, cases, command):
        _, answers, result = bad_input_cases.run_queries(VERICONE, cases, command)
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr, "")
        self.assertEqual(len(answers), len(cases))
        for (what, _), answer in zip(cases, answers):
            with self.subTest(what):
                self.assertIn("error", answer)
                self.assertRegex(answer["error"], r"^\S.*: got .+, must be .+")
                self.assertNotIn("\n", answer["error"])
                if what not in ("a line that is a list", "a line that is a number", "a broken line", "not a number",
                                "a number out of range", "a field given twice", "a line nested too deeply", "a broken line of states"):
                    self.assertEqual(answer["id"], 7)

    def test_every_bad_command_says_why(self):
        for what, arguments, scene in bad_input_cases.COMMANDS:
            with self.subTest(what):
                _, result, left = bad_input_cases.run_command(VERICONE, arguments, scene)
                self.assertEqual(result.returncode, 2)
                self.assertEqual(result.stdout, "")
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertLessEqual(len(left), 1, "something half written: %s" % left)

    def test_every_bad_track_says_why(self):
        for what, arguments, files in bad_input_cases.TRACKS:
            with self.subTest(what):
                result, left = bad_input_cases.run_track(VERICONE, arguments, files)
                self.assertEqual((result.returncode, result.stdout, left), (2, "", []))
                self.assertRegex(result.stderr, r"^vericone: \S.*: got .+, must be .+\n$")

    def test_the_table_is_the_truth(self):
        with open(os.path.join(SOURCE, "docs", "reference", "bad-input.md"), encoding="utf-8") as f:
            self.assertEqual(f.read(), bad_input_cases.table(VERICONE))
        self.assertGreaterEqual(len(bad_input_cases.QUERIES) + len(bad_input_cases.COMMANDS), 30)


if __name__ == "__main__":
    unittest.main()
