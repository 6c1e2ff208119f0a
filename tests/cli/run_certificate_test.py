# SPDX-License-Identifier: BSD-3-Clause
"""vericone simulate --certificate: what it writes, read by checker/vericone_check.py, which shares nothing with it.
Environment as for command.py."""
import copy
import json
import math
import os
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from command import SOURCE, check_certificates, run  # noqa: E402

EXAMPLES = os.path.join(SOURCE, "docs", "examples", "scenarios")
PAPERS = os.path.join(SOURCE, "papers", "dhal2022", "scenarios")

FLIGHT = """name: flight
duration: 6
step: 0.02
bodies:
  - name: A
    shape: {semi_axes: [3, 1, 1]}
    position: [0, 0, 0]
    velocity: [5, 0, 0]
    pilot: {law: avoidance, most: 8}
  - name: B
    shape: {semi_axes: [2, 1.5, 1]}
    position: [20, 1, 0]
    velocity: [-1, 0, 0]
  - name: C
    shape: {points: [[-1, -1, -1], [1, -1, -1], [0, 1, -1], [0, 0, 1]]}
    position: [0, -9, 2]
    velocity: [1, 0.5, 0]
"""


RING = """name: ring
duration: 5
step: 0.02
bodies:
  - name: A
    shape: {points: [[-1, -1, -1], [1, -1, -1], [0, 1, -1], [0, 0, 1]]}
    position: [-8, 0, 0]
    velocity: [3, 0.2, 0]
    pilot: {law: avoidance, most: 1.0e-9}
  - name: ring
    shape: {mesh: ring.off}
    position: [0, 0.5, 0]
    velocity: [0, 0, 0]
"""


class RunCertificates(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = self.temporary.name

    def tearDown(self):
        self.temporary.cleanup()

    def simulate(self, scenario):
        """(the file of certificates or None, what is said of them)."""
        out = os.path.join(self.folder, "out")
        result = run("simulate", scenario, "--out", out, "--quiet", "--no-figures", "--json", "--certificate")
        self.assertEqual(result.returncode, 0, result.stderr)
        path = os.path.join(out, "certificate.json")
        return (path if os.path.exists(path) else None), json.loads(result.stdout)["certificate"]

    def written(self, text):
        path = os.path.join(self.folder, "scenario.yaml")
        with open(path, "w", encoding="utf-8") as f:
            f.write(text)
        return path

    def check(self, path):
        return check_certificates(path)

    def status(self, document):
        path = os.path.join(self.folder, "damaged.json")
        with open(path, "w", encoding="utf-8") as f:
            json.dump(document, f)
        return self.check(path).returncode

    def flight(self):
        path, said = self.simulate(self.written(FLIGHT))
        self.assertEqual(said, {"pairs": 3, "none": []})
        with open(path, encoding="utf-8") as f:
            documents = [json.loads(line) for line in f]
        self.assertEqual([len(d["claim"]["pairs"]) for d in documents], [3])
        return documents[0]

    def test_scenarios_are_accepted(self):
        for folder, name in ((PAPERS, "5.4.1-clearance"), (EXAMPLES, "avoidance"), (EXAMPLES, "clearance"), (EXAMPLES, "fish"),
                             (EXAMPLES, "four-aircraft"), (EXAMPLES, "quadrotor"), (EXAMPLES, "union"),
                             (PAPERS, "6.5-noncooperative-clearance"), (PAPERS, "7.2")):
            with self.subTest(name):
                path, said = self.simulate(os.path.join(folder, name + ".yaml"))
                self.assertLess(os.path.getsize(path), 1e6)
                with open(path, encoding="utf-8") as f:
                    documents = [json.loads(line) for line in f]
                self.assertEqual(sum(len(d["claim"].get("pairs", [0])) for d in documents), said["pairs"])
                checked = self.check(path)
                self.assertEqual(checked.returncode, 0, checked.stdout)
                self.assertEqual(checked.stdout.count("accepted: "), len(documents))
                self.assertEqual([none for none in said["none"] if "meet" not in none["reason"] and "one has dents" not in none["reason"]], [])

    def test_a_distance_that_is_required_is_claimed(self):
        path, _ = self.simulate(os.path.join(EXAMPLES, "four-aircraft.yaml"))
        with open(path, encoding="utf-8") as f:
            self.assertEqual([json.loads(line)["claim"]["by"] for line in f], [20])

    def test_the_radius_is_what_the_run_is_known_to(self):
        for track in self.flight()["claim"]["tracks"]:
            self.assertGreaterEqual(track["radius"], 2e-8)
            self.assertLess(track["radius"], 4e-3)

    def test_damage_is_refused(self):
        whole = self.flight()
        self.assertEqual(self.status(whole), 0)

        def damaged(change):
            document = copy.deepcopy(whole)
            change(document["claim"], document["proof"]["pairs"]["0 1"])
            return document

        changes = {
            "by": lambda claim, proof: claim.update(by=30),
            "radius": lambda claim, proof: claim["tracks"][0].update(radius=30),
            "a piece missing": lambda claim, proof: proof["planes"].pop(),
            "times beyond": lambda claim, proof: claim.update(to=7),
            "normal turned": lambda claim, proof: proof["planes"][0].__setitem__(
                0, [-x for x in proof["planes"][0][0]]),
            "bodies exchanged": lambda claim, proof: claim.update(
                bodies=claim["bodies"][::-1], tracks=claim["tracks"][::-1]),
            "support": lambda claim, proof: proof["planes"][0].__setitem__(2, [0, 0]),
            "one track for two": lambda claim, proof: claim["tracks"].__setitem__(1, claim["tracks"][0]),
        }
        for name, change in changes.items():
            with self.subTest(name):
                self.assertIn(self.status(damaged(change)), (1, 2))

    def test_a_support_below_the_middle_is_refused_wherever_it_stands(self):
        """Bodies hold their own middle, so no support about it is below 0."""
        whole = self.flight()
        count = len(whole["proof"]["pairs"]["0 1"]["planes"])
        self.assertGreater(count, 1)
        for k in range(count):
            document = copy.deepcopy(whole)
            document["proof"]["pairs"]["0 1"]["planes"][k][2 + k % 2][k % 2] = -1
            self.assertEqual(self.status(document), 1)

    def test_through_a_mesh_by_groups_of_triangles(self):
        """A ring of 2,304 triangles that no plane parts from what flies through it."""
        around, about = 48, 24
        with open(os.path.join(self.folder, "ring.off"), "w", encoding="utf-8") as f:
            f.write(f"OFF\n{around * about} {2 * around * about} 0\n")
            for i in range(around):
                for j in range(about):
                    phi, psi = 2 * math.pi * i / around, 2 * math.pi * j / about
                    r = 4 + math.cos(psi)
                    f.write(f"{math.sin(psi)} {r * math.cos(phi)} {r * math.sin(phi)}\n")
            for i in range(around):
                for j in range(about):
                    a, b = i * about + j, i * about + (j + 1) % about
                    c, d = (i + 1) % around * about + j, (i + 1) % around * about + (j + 1) % about
                    f.write(f"3 {a} {b} {c}\n3 {b} {d} {c}\n")
        path, said = self.simulate(self.written(RING))
        self.assertEqual(said, {"pairs": 1, "none": []})
        with open(path, encoding="utf-8") as f:
            document = json.load(f)
        self.assertEqual(document["proof"]["pairs"]["0 1"]["rule"], "groups")
        self.assertEqual(len(document["claim"]["bodies"][1]["triangles"]), 2 * around * about)
        checked = self.check(path)
        self.assertEqual(checked.returncode, 0, checked.stdout[-2000:])
        for one in document["proof"]["pairs"]["0 1"]["runs"]:
            one[0] = 1 - one[0]  # each half gets the other's planes and boxes
        self.assertIn(self.status(document), (1, 2))

    def test_bodies_that_meet(self):
        straight = FLIGHT.replace("most: 8", "most: 1.0e-9").replace("[20, 1, 0]", "[20, 0, 0]")
        path, said = self.simulate(self.written(straight))
        self.assertEqual(said, {"pairs": 3, "none": []})
        checked = self.check(path)
        self.assertEqual((checked.returncode, checked.stdout.count("accepted: meet")), (0, 1), checked.stdout)
        with open(path, encoding="utf-8") as f:
            meeting = next(d for d in map(json.loads, f) if d["claim"]["says"] == "meet")
        self.assertGreater(min(track["radius"] for track in meeting["claim"]["tracks"]), 0)
        for path_of, value in ((("claim", "tracks", 0, "radius"), 3), (("proof", "time"), 0.1), (("proof", "agent_depth"), 2)):
            document = copy.deepcopy(meeting)
            *way, last = path_of
            at = document
            for key in way:
                at = at[key]
            at[last] = value
            self.assertEqual(self.status(document), 1)

    @unittest.skipUnless(os.path.exists("/usr/share/doc/liboctomap-dev/examples/data/geb079.bt"), "liboctomap-dev is not installed")
    def test_a_map_is_stated_in_less_than_a_megabyte(self):
        """137,258 boxes, stated as an octree and held by a few hundred boxes."""
        path, said = self.simulate(os.path.join(EXAMPLES, "corridor.yaml"))
        self.assertEqual(said, {"pairs": 1, "none": []})
        self.assertLess(os.path.getsize(path), 1e6)
        checked = self.check(path)
        self.assertEqual(checked.returncode, 0, checked.stdout[-2000:])
        with open(path, encoding="utf-8") as f:
            document = json.load(f)
        building = document["claim"]["bodies"][1]
        self.assertEqual(building["kind"], "octree")
        # A cell more in the middle of the way is in none of the boxes.
        building["tree"] = building["tree"].replace(".", "#", 1)
        self.assertEqual(self.status(document), 1)

    def test_without_the_option_nothing_is_written(self):
        out = os.path.join(self.folder, "out")
        result = run("simulate", self.written(FLIGHT), "--out", out, "--quiet", "--no-figures", "--json")
        self.assertNotIn("certificate", json.loads(result.stdout))
        self.assertNotIn("certificate.json", os.listdir(out))


if __name__ == "__main__":
    unittest.main()
