# SPDX-License-Identifier: BSD-3-Clause
"""`vericone pursue`, and what `vericone track --own` makes of its pictures. Environment as for command.py."""
import csv
import json
import os
import tempfile
import unittest

import bad_input_cases
from command import SOURCE, VERICONE, run


class Pursue(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.out = os.path.join(self.folder, "out")
        self.file = os.path.join(self.folder, "pursuit.yaml")
        with open(self.file, "w", encoding="utf-8") as f:
            f.write(bad_input_cases.pursuit(camera="{width: 480, height: 360, field_of_view_deg: 50, noise: 3}"))

    def pursue(self, *arguments, file=None):
        result = run("pursue", file or self.file, "--no-figures", "--quiet", "--json", "--out", self.out, *arguments)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return json.loads(result.stdout)

    def rows(self, name):
        with open(os.path.join(self.out, name), newline="", encoding="utf-8") as f:
            return list(csv.DictReader(line for line in f if not line.startswith("#")))

    def test_answers_are_those_of_the_tables(self):
        answer = self.pursue()
        uas, cars = self.rows("uas.csv"), self.rows("cars.csv")
        self.assertEqual((answer["pictures"], len(uas), len(cars)), (51, 51, 51))
        late = [float(r["r_c [m]"]) for r in uas if float(r["t [s]"]) >= answer["end"] / 3]
        self.assertAlmostEqual(answer["mean_distance"], sum(late) / len(late), 9)
        seen = [r for r in cars if r["x_meas [m]"]]
        off = [(float(r["box_x [px]"]) + float(r["box_w [px]"]) / 2 - float(r["true_x [px]"]) - float(r["true_w [px]"]) / 2) ** 2 +
               (float(r["box_y [px]"]) + float(r["box_h [px]"]) / 2 - float(r["true_y [px]"]) - float(r["true_h [px]"]) / 2) ** 2
               for r in seen]
        self.assertAlmostEqual(answer["cars"][0]["pixels_rms"], (sum(off) / len(off)) ** 0.5, 9)
        self.assertTrue(answer["cars"][0]["followed"])

    def test_pictures_and_own_poses_repeat_what_was_believed(self):
        frames = os.path.join(self.folder, "frames")
        for tracker in ("ours", "source"):
            self.pursue("--frames", frames, "--tracker", tracker)
            with open(os.path.join(frames, "boxes.txt"), encoding="utf-8") as f:
                boxes = f.read().split()
            again = os.path.join(self.folder, "again")
            result = run("track", frames, *boxes, "--own", os.path.join(frames, "own.csv"), "--camera",
                         os.path.join(frames, "camera.yaml"), "--no-figures", "--quiet", "--out", again)
            self.assertEqual((result.returncode, result.stderr), (0, ""))
            with open(os.path.join(again, "estimates.csv"), encoding="utf-8") as a, open(
                    os.path.join(self.out, "estimates.csv"), encoding="utf-8") as b:
                self.assertEqual(a.read(), b.read())

    def test_starts_and_occlusions(self):
        answer = self.pursue("--camera", "exact", "--law", "ours", "--starts", "6", "--within", "0.5", "--threads", "2")
        means = sorted(float(r["mean_r [m]"]) for r in self.rows("starts.csv"))
        self.assertEqual((len(means), answer["mean_r"]["least"], answer["mean_r"]["greatest"]), (6, means[0], means[-1]))
        answer = self.pursue("--random", "2")
        rows = self.rows("occlusions.csv")
        self.assertEqual((answer["runs"], len(rows)), (2, 2))
        for row in rows:  # the roof hides for 3 s, and some pictures more
            self.assertTrue(2.9 < float(row["hidden [s]"]) < 3.6, row)

    def test_a_video_and_a_picture(self):
        video = os.path.join(self.folder, "seen.mp4")
        result = run("pursue", self.file, "--quiet", "--video", video, "--out", self.out)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertGreater(os.path.getsize(video), 10_000)
        self.assertTrue(os.path.exists(os.path.join(self.out, "pursuit.png")))

    def test_only_the_camera_in_use_is_needed(self):
        text = bad_input_cases.pursuit(top="duration: 0.2\n")
        for camera, others in (("source", ["perspective"]), ("perspective", ["source"]), ("exact", ["perspective", "source"])):
            for other in others:
                with self.subTest(camera, without=other), open(self.file, "w", encoding="utf-8") as f:
                    f.write("\n".join(line for line in text.split("\n") if not line.startswith("  %s:" % other)))
                self.assertEqual(self.pursue("--camera", camera)["camera"], camera)

    def test_the_papers_pursuits_are_read(self):
        folder = os.path.join(SOURCE, "papers/dhal2022/pursuits")
        for name in sorted(os.listdir(folder)):
            with self.subTest(name):
                answer = self.pursue("--camera", "exact", "--duration", "1", file=os.path.join(folder, name))
                self.assertEqual(answer["end"], 1)


    def test_check_says_what_a_pursuit_means(self):
        told = run("check", os.path.join(SOURCE, "docs/examples/pursuits/two.yaml"))
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertIn("followed, at (20, 12, 0) m; moves at 20 m/s", told.stdout)
        as_json = json.loads(run("check", self.file, "--json").stdout)
        self.assertEqual(as_json[0], {"label": "pursuit", "text": self.file})

    def test_gains_are_read_by_their_former_names(self):
        with open(self.file, encoding="utf-8") as f:
            text = f.read().replace("duration: 2\n", "duration: 2\nlaws: {source: {kind: focal, K_1: 1, K_sp: 0.3}}\n")
        runs = []
        for given in (text, text.replace("K_1", "cone").replace("K_sp", "speed_error")):
            with open(self.file, "w", encoding="utf-8") as f:
                f.write(given)
            self.pursue("--camera", "exact", "--law", "source")
            runs.append(self.rows("uas.csv"))
        self.assertEqual(*runs)


class PursueBadInput(unittest.TestCase):
    def test_every_bad_pursuit_says_why(self):
        self.assertGreaterEqual(len(bad_input_cases.PURSUITS), 20)
        for what, arguments, text in bad_input_cases.PURSUITS:
            with self.subTest(what):
                result, left = bad_input_cases.run_pursuit(VERICONE, arguments, text)
                self.assertEqual((result.returncode, result.stdout, left), (2, "", []), result.stderr)
                self.assertRegex(result.stderr, r"\Avericone: \S.*: got .+, must be .+\n\Z")


if __name__ == "__main__":
    unittest.main()
