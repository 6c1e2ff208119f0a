# SPDX-License-Identifier: BSD-3-Clause
"""`vericone track`: true boxes that are absent, and claims in the form of a truth file. Environment as for command.py."""
import json
import os
import tempfile
import unittest

import bad_input_cases
from command import SOURCE, run

AWAY = "nan,nan,nan,nan"


class Track(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def write(self, name, content):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as f:
            f.write(content if isinstance(content, bytes) else ("\n".join(content) + "\n").encode())
        return path

    def frames(self):
        for name, picture in bad_input_cases.FRAMES.items():
            self.write(name, picture)
        return os.path.join(self.folder, "frames")

    def track(self, *arguments):
        result = run("track", *arguments, "--no-figures", "--quiet", "--json", "--out", os.path.join(self.folder, "out"))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return json.loads(result.stdout)

    def test_frames_of_absence_are_counted_and_no_rows(self):
        # The thing moves a pixel a picture; the third picture's row says that it is not there.
        truth = self.write("truth.txt", ["8,16,16,10", "9,16,16,10", "NaN,NaN,NaN,NaN", "11,16,16,10"])
        said = self.track(self.frames(), "--truth", truth)
        self.assertEqual([said[k] for k in ("truth_rows", "claims", "false_claims", "absent_rows", "absent_claims")],
                         [2, 2, 0, 1, 1])
        self.assertAlmostEqual(said["success_auc"], 20 / 21, 12)  # both overlaps above 0.95, none above 1

    def test_absent_at_first(self):
        truth = self.write("truth.txt", [AWAY, "9,16,16,10", "10,16,16,10", AWAY])
        said = self.track(self.frames(), "--truth", truth)
        self.assertEqual((said["pictures"], said["truth_rows"], said["absent_rows"]), (4, 1, 1))

    def test_rows_of_several_targets_may_be_absent(self):
        street, truth = os.path.join(SOURCE, "docs/examples/street"), os.path.join(SOURCE, "docs/examples/street-truth.txt")
        with open(truth, encoding="utf-8") as f:
            rows = [line.strip() for line in f]
        rows[10] = ",".join(rows[10].split(",")[:2]) + "," + AWAY
        said = self.track(street, "--truth", self.write("truth.txt", rows))
        self.assertEqual((said["truth_rows"], said["absent_rows"]), (len(rows) - 3, 1))

    def test_claims_are_a_truth_file(self):
        street, truth = os.path.join(SOURCE, "docs/examples/street"), os.path.join(SOURCE, "docs/examples/street-truth.txt")
        for arguments in (["--box", "20,40,20,9"], ["--truth", truth]):
            self.track(street, *arguments)
            with open(os.path.join(self.folder, "out/claims.txt"), "rb") as f:
                claims = self.write("claims.txt", f.read())
            said = self.track(street, "--truth", claims)
            self.assertEqual((said["claims"], said["false_claims"], said["absent_claims"]), (said["truth_rows"], 0, 0))
            self.assertAlmostEqual(said["success_auc"], 20 / 21, 12)

    def test_what_is_not_seen_is_absent_from_the_claims(self):
        # Three pictures with the thing, then three without.
        for k in range(6):
            self.write("frames/%d.png" % k, bad_input_cases.street(k if k < 3 else 90))
        self.track(os.path.join(self.folder, "frames"), "--box", "8,16,16,10")
        with open(os.path.join(self.folder, "out/claims.txt"), encoding="utf-8") as f:
            rows = f.read().split()
        self.assertEqual([row == AWAY for row in rows], [False] * 3 + [True] * 3)


if __name__ == "__main__":
    unittest.main()
