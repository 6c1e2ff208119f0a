# SPDX-License-Identifier: BSD-3-Clause
"""vericone certify: 1,000 recorded poses beside the map of a building (fr_078_tidyup.bt, 234,183 boxes), with its certificate,
and ten times as many poses of the same way. Environment as for command.py; VERICONE_DATA_DIR: where the map is."""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import unittest

sys.path[:0] = [os.path.dirname(os.path.abspath(__file__)), os.path.dirname(os.path.dirname(os.path.abspath(__file__)))]
from command import SOURCE, run  # noqa: E402

CHECKER = os.path.join(SOURCE, "checker", "vericone_check.py")
MAP = os.path.join(os.environ.get("VERICONE_DATA_DIR", os.path.join(SOURCE, "..", "shared", "data")), "fr_078_tidyup.bt")
POSES, SECONDS = 1000, 30


def poses(count):
    """t x y z qx qy qz qw of a way above the middle of the building, straight between every tenth of 10,000."""
    def at(s):
        s = min(max(s, 0.0), 1.0)
        return (-1 + 2 * s, 0.4 * math.sin(3 * s), 5.6 + 0.3 * math.cos(4 * s)), 1.5 * s

    def knot(k):
        return at(k / (POSES - 1))
    lines = []
    for i in range(count):
        place = i * (POSES - 1) / (count - 1)
        k = min(int(place), POSES - 2)
        (a, turn_a), (b, turn_b) = knot(k), knot(k + 1)
        part = place - k
        x = [p + part * (q - p) for p, q in zip(a, b)]
        turn = turn_a + part * (turn_b - turn_a)
        lines.append(" ".join(repr(v) for v in (SECONDS * place / (POSES - 1), *x, 0, 0, math.sin(turn / 2), math.cos(turn / 2))))
    return "\n".join(lines) + "\n"


@unittest.skipUnless(os.path.exists(MAP), MAP + " is not here; set VERICONE_DATA_DIR to the folder with it")
class TracksInAMap(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def tracks(self, count):
        name = "poses%d.tum" % count
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(poses(count))
        path = os.path.join(self.folder, "tracks%d.yaml" % count)
        with open(path, "w", encoding="utf-8") as file:
            file.write("bodies:\n  - {name: recorded, shape: {capsule: {radius: 0.1, length: 0.3}}, radius: 0.01, track: {kind: poses, "
                       "file: %s}}\n  - {name: building, shape: {octree: %s, unknown: free}}\n" % (name, os.path.abspath(MAP)))
        return path

    def test_apart_with_a_certificate(self):
        out = os.path.join(self.folder, "certificate.json")
        path = self.tracks(POSES)
        answer = json.loads(run("certify", path, "--quiet", "--json", "--certificate", out).stdout)
        pair = answer["pairs"][0]
        self.assertEqual((pair["verdict"], answer["certificate"]["none"]), ("apart", []))
        checked = subprocess.run([sys.executable, CHECKER, out, "--memory", "1000"], capture_output=True, text=True, check=False)
        self.assertEqual(checked.returncode, 0, checked.stdout[-1000:])
        text = run("certify", path, "--quiet").stdout
        seconds = float(re.search(r"^time\s+(\S+) s$", text, re.MULTILINE)[1])
        print("1,000 poses beside the map: apart by %.4f m, %d pieces, %.3f s; certificate %.2f MB" % (
            pair["least_distance"], pair["pieces"], seconds, os.path.getsize(out) / 1e6))
        more = json.loads(run("certify", self.tracks(10 * (POSES - 1) + 1), "--quiet", "--json").stdout)["pairs"][0]
        self.assertEqual(more["verdict"], "apart")
        self.assertAlmostEqual(more["least_distance"], pair["least_distance"], delta=0.02 * pair["least_distance"])


if __name__ == "__main__":
    unittest.main()
