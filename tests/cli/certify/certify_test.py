# SPDX-License-Identifier: BSD-3-Clause
"""vericone certify: files of all kinds, what is proved of them by hand, certificates read by checker/vericone_check.py,
which shares nothing with it. Environment as for command.py."""
import json
import math
import os
import sys
import tempfile
import unittest

sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)), os.path.dirname(os.path.dirname(os.path.abspath(__file__)))]
import certify_cases  # noqa: E402
from command import SOURCE, VERICONE, check_certificates, run  # noqa: E402

EXAMPLES = os.path.join(SOURCE, "docs", "examples", "tracks")


class Tracks(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, name, text):
        path = os.path.join(self.folder.name, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def certified(self, path, *arguments):
        result = run("certify", path, "--quiet", "--json", *arguments)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return json.loads(result.stdout)

    def checked(self, path):
        return check_certificates(path)

    def test_the_same_flight_in_every_form(self):
        """x = t^2 / 2 for 4 s past a ball at rest 2.25 m aside, radii 1 and 1: 0.25 m between at the nearest."""
        ball = "  - {name: B, shape: {semi_axes: [1, 1, 1]}, position: [3, 2.25, 0]}\n"
        self.write("powers.csv", "duration,x^0,x^1,x^2,y^0,z^0\n2,0,0,0.5,0,0\n2,2,2,0.5,0,0\n")
        self.write("points.txt", "0 0 0\n0 0 0\n2 0 0\n8 0 0\n8 0 0\n")
        rows = "".join(f"{t / 10},{t * t / 200},0,0,{t / 10},0,0\n" for t in range(41))
        self.write("samples.csv", "t,x,y,z,vx,vy,vz\n" + rows)
        for what, track in {
                "powers": "{kind: powers, file: powers.csv}",
                "lists": "{kind: powers, times: [0, 4], pieces: [[[0, 0], [0, 0], [0.5, 0]]]}",
                "later": "{kind: powers, start: 7, times: [-7, -3], pieces: [[[0, 0, 0], [0, 0, 0], [0.5, 0, 0]]]}",
                "bernstein": "{kind: bernstein, times: [0, 4], pieces: [[[0, 0, 0], [0, 0, 0], [8, 0, 0]]]}",
                "clamped": "{kind: spline, degree: 2, knots: [0, 0, 0, 4, 4, 4], points: [[0, 0, 0], [0, 0, 0], [8, 0, 0]]}",
                "uniform": "{kind: spline, degree: 2, interval: 2, points: [[0, 0, 0], [0, 0, 0], [4, 0, 0], [12, 0, 0]]}",
                "samples": "{kind: poses, file: samples.csv, between: hermite}"}.items():
            text = f"bodies:\n  - {{name: A, shape: {{semi_axes: [1, 1, 1]}}, track: {track}}}\n" + ball
            with self.subTest(what):
                pair = self.certified(self.write("tracks.yaml", text))["pairs"][0]
                self.assertEqual((pair["verdict"], pair["from"], pair["to"]), ("apart", 0, 4))
                self.assertLessEqual(pair["least_distance"], 0.25 + 1e-9)
                self.assertGreater(pair["least_distance"], 0.247)
                self.assertAlmostEqual(pair["least_time"], math.sqrt(6), delta=0.1)
                near = self.certified(self.write("near.yaml", "required: 0.3\n" + text))["pairs"][0]
                self.assertEqual(near["verdict"], "nearer")
                # From (3 - x)^2 = 2.3^2 - 2.25^2 on.
                self.assertAlmostEqual(near["to"], math.sqrt(2 * (3 - math.sqrt(2.3 ** 2 - 2.25 ** 2))), delta=1e-5)

    def test_poses_of_tum_and_of_kitti(self):
        """The same poses, a helix that turns with its heading, as both write them: the same answers."""
        tum = kitti = times = ""
        for i in range(21):
            t, a = i / 10, i / 20
            c, s = math.cos(a), math.sin(a)
            tum += f"{t!r} {3 * c!r} {3 * s!r} {t / 10!r} 0 0 {math.sin(a / 2)!r} {math.cos(a / 2)!r}\n"
            kitti += f"{c!r} {-s!r} 0 {3 * c!r} {s!r} {c!r} 0 {3 * s!r} 0 0 1 {t / 10!r}\n"
            times += f"{t!r}\n"
        self.write("poses.tum", tum)
        self.write("poses.txt", kitti)
        self.write("times.txt", times)
        found = []
        for track in ("file: poses.tum", "file: poses.txt, times_file: times.txt", "file: poses.txt, interval: 0.1",
                      "file: poses.txt, interval: 100 ms"):
            path = self.write("tracks.yaml", f"bodies:\n  - {{name: A, shape: {{semi_axes: [1, 0.2, 0.2]}}, track: {{kind: poses, {track}}}}}\n"
                                             "  - {name: B, shape: {semi_axes: [1, 1, 1]}, position: [0, 0, 0]}\n")
            pair = self.certified(path)["pairs"][0]
            found.append((pair["verdict"], pair["from"], pair["to"], round(pair["least_distance"], 9)))
        self.assertEqual([one[:3] for one in found], [("apart", 0, 2)] * 4)
        self.assertEqual(len({one[3] for one in found}), 1, found)
        # Chords between poses come 0.05^2 / 8 of the radius nearer, a body across the radius has 0.2 towards the middle.
        self.assertAlmostEqual(found[0][3], 1, delta=0.01)

    def test_check_says_what_tracks_are(self):
        done = run("check", os.path.join(EXAMPLES, "tracks.yaml"), "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        said = {line["label"]: line["text"] for line in json.loads(done.stdout)}
        self.assertIn("speed at most 1.5 m/s", said["eight"])
        self.assertIn("track from", said["recorded"])
        self.assertIn("0.05 m", said["pairs"])
        done = run("check", self.write("bad.yaml", "bodies: [{name: A, track: {kind: poses}}]"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("bodies[0].shape", done.stderr)

    def test_examples_and_their_certificates(self):
        certificate = os.path.join(self.folder.name, "certificate.json")
        answer = self.certified(os.path.join(EXAMPLES, "tracks.yaml"), "--certificate", certificate)
        self.assertEqual(answer["verdict"], "nearer")
        self.assertEqual(len(answer["pairs"]), 9)
        self.assertEqual({limit["verdict"] for limit in answer["limits"]}, {"kept"})
        self.assertEqual(answer["certificate"]["pairs"], 10)  # of "eight, rotor": the tracks are apart, and as near as radii allow
        self.assertEqual(answer["certificate"]["none"], [])
        done = self.checked(certificate)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("accepted: apart", done.stdout)
        with open(certificate, encoding="utf-8") as file:
            claim = json.loads(file.readline())
        self.assertEqual(claim["claim"]["by"], 0.05)
        # A tube holds its body's radius.
        self.assertGreaterEqual(min(track["radius"] for track in claim["claim"]["tracks"][:2]), 0.03)
        # With another track it is no proof.
        positions = claim["claim"]["tracks"][0]["positions"]
        for segment in positions:
            for point in segment:
                point[0] += 2 << claim["claim"]["tracks"][0].get("grid", 0)
        self.assertEqual(self.checked(self.write("damaged.json", json.dumps(claim))).returncode, 1)

    def test_a_picture_and_its_data(self):
        out = os.path.join(self.folder.name, "out")
        done = run("certify", os.path.join(EXAMPLES, "tracks.yaml"), "--quiet", "--out", out)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("certified.json", done.stdout)
        with open(os.path.join(out, "certified.json"), encoding="utf-8") as file:
            data = json.load(file)
        self.assertEqual((len(data["bodies"]), len(data["pairs"]), data["required"]), (5, 9, 0.05))
        self.assertEqual(data["pairs"][0]["there"], [0, 10])
        self.assertEqual(len(data["bodies"][0]["positions"]), 400)
        if os.path.exists("/usr/lib/python3/dist-packages/matplotlib"):
            self.assertGreater(os.path.getsize(os.path.join(out, "certified.png")), 20000)
        again = run("certify", os.path.join(EXAMPLES, "tracks.yaml"), "--quiet", "--out", out, "--no-figures")
        self.assertEqual(again.returncode, 0)
        self.assertEqual(os.listdir(out), ["certified.json"])

    def test_a_swarm(self):
        answer = self.certified(os.path.join(EXAMPLES, "swarm.yaml"))
        self.assertEqual((answer["verdict"], len(answer["pairs"]), len(answer["limits"])), ("apart", 66, 24))
        text = run("certify", os.path.join(EXAMPLES, "swarm.yaml"), "--quiet").stdout
        self.assertIn("and 54 more pairs", text)
        self.assertIn("24 of 24 kept, proved", text)

    def test_in_the_plane(self):
        text = ("bodies:\n  - {name: A, shape: {a_c: 2, b_c: 1, k: {offset: 0.5, amplitude: 0.3, rate: 2}}, track: {kind: "
                "poses, times: [0, 4], points: [[-6, 0], [6, 0]]}}\n"
                "  - {name: B, shape: {semi_axes: [1, 1]}, position: [0, %s]}\n")
        self.assertEqual(self.certified(self.write("a.yaml", text % 4))["verdict"], "apart")
        self.assertEqual(self.certified(self.write("b.yaml", text % 0.5))["verdict"], "contact")

    def test_broken_limits(self):
        text = ("bodies:\n  - {name: A, shape: {semi_axes: [1, 1, 1]}, limits: {speed: 2, acceleration: 2}, track: {kind: "
                "powers, times: [0, 3], pieces: [[[0, 0, 0], [0, 0, 0], [0.5, 0, 0]]]}}\n")
        answer = self.certified(self.write("tracks.yaml", text))
        self.assertEqual(answer["verdict"], "none")
        speed, acceleration = answer["limits"]
        self.assertEqual((speed["verdict"], acceleration["verdict"]), ("broken", "kept"))
        self.assertAlmostEqual(speed["at_least"], 3, delta=1e-8)
        self.assertEqual(speed["time"], 3)

    def test_bad_input(self):
        for what, text in certify_cases.CASES:
            with self.subTest(what):
                result, left = certify_cases.run_tracks(VERICONE, text)
                self.assertEqual((result.returncode, result.stdout, left), (2, "", []), result.stderr)
                self.assertRegex(result.stderr, r"^vericone: \S.*: got .+, must be .+\n$")


if __name__ == "__main__":
    unittest.main()
