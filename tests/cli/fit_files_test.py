# SPDX-License-Identifier: BSD-3-Clause
"""What vericone fit writes: the folder, the check of a written result, and real meshes proved anew. Environment as for
command.py; meshes of Debian's libcgal-demo and the folder of real scans are looked for."""
import json
import os
import signal
import subprocess
import sys
import tarfile
import time
import unittest
from fractions import Fraction

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from command import SOURCE, VERICONE, run  # noqa: E402
from fit_test import CUBE, SIDES, Files, exactly, fit, inside, peanut, rows, shell, value  # noqa: E402
from pieces_test import DATA, obj  # noqa: E402

ARCHIVE = "/usr/share/doc/libcgal-dev/data.tar.gz"


def read_off(path):
    with open(path, encoding="ascii") as f:
        numbers = f.read().split()
    n, m = int(numbers[1]), int(numbers[2])
    points = [[float(c) for c in numbers[4 + 3 * i:7 + 3 * i]] for i in range(n)]
    at = 4 + 3 * n
    faces = []
    for _ in range(m):
        k = int(numbers[at])
        faces.append(tuple(int(i) for i in numbers[at + 1:at + 1 + k]))
        at += 1 + k
    return points, faces


class FitFolder(Files):
    def mesh_of(self, name):
        """Points and faces of the OBJ that was written, by group."""
        points, groups, group = [], {}, None
        for line in self.read(name).splitlines():
            key, *rest = line.split()
            if key == "v":
                points.append([float(x) for x in rest])
            elif key == "g":
                group = groups.setdefault(rest[0], [])
            elif key == "f":
                group.append([int(i) - 1 for i in rest])
        return points, groups

    def test_everything_is_written_and_fits_together(self):
        mesh = self.write("peanut.obj", obj(*peanut()))
        result = run("fit", mesh, "--shape", "biconvex", "--out", self.out)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(sorted(os.listdir(self.out)),
                         ["body.yaml", "fit.json", "fit.pdf", "fit.png", "fit_picture.json", "hull.obj", "hull.ply",
                          "provenance.json"])
        self.assertEqual([n for n in os.listdir(self.folder) if "partial" in n], [])
        written = json.loads(self.read("fit.json"))
        self.assertIn("hull                biconvex, containing", result.stdout)
        self.assertIn("certified           yes: all", result.stdout)
        with open(os.path.join(self.out, "fit.png"), "rb") as f:
            self.assertEqual(f.read(8), b"\x89PNG\r\n\x1a\n")
        # The surface: closed, outward, of about the volume, each point on the quadrics of its group.
        points, groups = self.mesh_of("hull.obj")
        self.assertEqual(sorted(groups), ["piece_0_quadric_0", "piece_0_quadric_1"])
        volume, edges = 0, set()
        for name, faces in groups.items():
            q = written["pieces"][0]["quadrics"][int(name[-1])]
            for f in faces:
                a, b, c = (points[i] for i in f)
                volume += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                           a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
                for i, j in zip(f, f[1:] + f[:1]):
                    self.assertNotIn((i, j), edges)
                    edges.add((i, j))
                self.assertAlmostEqual(float(value([[Fraction(x) for x in r] for r in q], a)), 0, 7)
        self.assertTrue(all((j, i) in edges for i, j in edges))
        self.assertAlmostEqual(volume / written["volume"], 1, delta=0.02)
        header = self.read("hull.ply").split("end_header")[0]
        self.assertIn("element vertex %d\n" % len(points), header)
        self.assertIn("element face %d\n" % sum(len(f) for f in groups.values()), header)

    def test_the_body_is_a_scene(self):
        points, faces = peanut()
        mesh = self.write("peanut.obj", obj(points, faces))
        for shape in ("ellipsoid", "biconvex"):
            with self.subTest(shape):
                result = fit(mesh, "--shape", shape, out=self.out)
                scene = self.write("scene.yaml", self.read("body.yaml") + "agent: {center: [9, 0, 0], semi_axes: [1, 1, 1]}\n"
                                   "agent_velocity: [-1, 0, 0]\n")
                cone = run("cone", scene, "--json")
                self.assertEqual(cone.returncode, 0, cone.stderr)
                self.assertEqual(json.loads(cone.stdout)["relation"], "disjoint")
                # The fields alone, as any reader of scenes takes them: each vertex is met by a ball of radius 1e-6.
                body = result["pieces"][0]["body"]
                ask = [{"id": i, "agent": {"center": p, "semi_axes": [1e-6] * 3}, "obstacle": body,
                        "agent_velocity": [0, 0, 0], "obstacle_velocity": [0, 0, 0]} for i, p in enumerate(points[::7])]
                answers = run("query", "-", input="".join(json.dumps(a) + "\n" for a in ask)).stdout.splitlines()
                self.assertEqual({json.loads(a)["verdict"] for a in answers}, {"overlapping"})

    def test_a_second_run_leaves_nothing_of_the_first(self):
        mesh = self.write("cube.obj", obj(CUBE, SIDES))
        self.assertEqual(run("fit", mesh, "--out", self.out, "--quiet").returncode, 0)
        self.write("out/mine.txt", "kept")
        self.assertEqual(run("fit", mesh, "--out", self.out, "--quiet", "--no-figures").returncode, 0)
        self.assertNotIn("fit.png", os.listdir(self.out))
        self.assertIn("mine.txt", os.listdir(self.out))

    def test_interrupted_it_writes_nothing(self):
        cloud = self.write("cloud.xyz", rows(shell(60000, noise=0.05)))
        with subprocess.Popen([VERICONE, "fit", cloud, "--pieces", "8", "--out", self.out], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as p:
            p.stderr.readline()  # at work: interruptions are caught from before the first line on
            p.send_signal(signal.SIGINT)
            started = time.monotonic()
            output, _ = p.communicate(timeout=60)
        self.assertEqual(p.returncode, 130)
        self.assertEqual(output, "")
        self.assertLess(time.monotonic() - started, 20)
        self.assertEqual(os.listdir(self.folder), ["cloud.xyz"])

    def test_cones_of_scan_and_hulls(self):
        mesh = self.write("peanut.obj", obj(*peanut()))
        result = run("fit", mesh, "--shape", "biconvex", "--cone", "0,8,0,0.5", "--out", self.out, "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("fit_cones.png", os.listdir(self.out))
        self.assertIsNotNone(json.loads(self.read("fit.json"))["cones"])
        self.assertIn("convex hull", result.stdout)


class FitCheck(Files):
    def check(self, file, *arguments):
        return run("fit", file, "--check", os.path.join(self.out, "fit.json"), *arguments)

    def change(self, change):
        result = json.loads(self.read("fit.json"))
        change(result)
        self.write("out/fit.json", json.dumps(result))

    def test_a_certificate_holds_for_its_scan_and_for_no_other(self):
        points, faces = peanut()
        mesh = self.write("peanut.obj", obj(points, faces))
        fit(mesh, "--shape", "biconvex", out=self.out)
        result = self.check(mesh)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("certificate         holds", result.stdout)
        answer = json.loads(self.check(mesh, "--json").stdout)
        self.assertEqual((answer["holds"], answer["points_outside"], answer["triangles_outside"]), (True, 0, 0))
        moved = self.write("moved.obj", obj([[x + 0.01, y, z] for x, y, z in points], faces))
        result = self.check(moved)
        self.assertEqual(result.returncode, 1)
        self.assertIn("does NOT hold", result.stdout)

    def test_a_quadric_made_smaller_by_a_millionth_is_found_out(self):
        points, faces = peanut()
        mesh = self.write("peanut.obj", obj(points, faces))
        result = fit(mesh, "--shape", "ellipsoid", out=self.out)

        def shrink(written):
            q = written["pieces"][0]["quadrics"][0]
            q[3][3] *= 1 + 1e-6  # larger or smaller, by the sign of its value at the centre
            if value([[Fraction(x) for x in r] for r in q], result["pieces"][0]["body"]["center"]) < value(
                    exactly(result["pieces"][0])[0], result["pieces"][0]["body"]["center"]):
                q[3][3] /= (1 + 1e-6) ** 2
        self.change(shrink)
        answer = json.loads(self.check(mesh, "--json").stdout)
        self.assertFalse(answer["holds"])
        self.assertEqual(answer["points"] - answer["points_outside"], inside(json.loads(self.read("fit.json")), points))

    def test_nothing_claimed_is_nothing_proved(self):
        cloud = self.write("cloud.xyz", rows(shell(300, noise=0.02)))
        fit(cloud, "--mode", "least-squares", "--shape", "ellipsoid", out=self.out)
        result = self.check(cloud)
        self.assertEqual(result.returncode, 1)
        self.assertIn("claims nothing", result.stdout)

    def test_triangles_count_where_corners_do_not_tell(self):
        # Two opposite dents reach into a needle of a triangle whose corners are inside.
        q = [[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -4]], [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0],
                                                                         [0, 0, 0, -0.25]]]
        os.makedirs(self.out)
        self.write("out/fit.json", json.dumps({
            "pieces": [{"quadrics": q}], "certified": True, "coverage": 1, "margin": 0,
            "certificate": {"points": 3, "points_inside": 3, "triangles": 1, "triangles_inside": 1, "margins_inside": 3}}))
        across = self.write("across.obj", obj([[-1, 0.9, 0], [1, 0.9, 0], [1, 0.9, 0.1]], [(0, 1, 2)]))
        answer = json.loads(self.check(across, "--json").stdout)
        self.assertEqual((answer["points_outside"], answer["triangles_outside"], answer["holds"]), (0, 1, False))
        along = self.write("along.obj", obj([[-1, 0.4, 0], [1, 0.4, 0], [1, 0.4, 0.1]], [(0, 1, 2)]))
        self.assertEqual(self.check(along).returncode, 0)


class FitCertificates(Files):
    """What --certificate writes, as the checker that shares no line with the library reads it."""

    def certificate(self, file):
        path = os.path.join(self.folder, "certificate.json")
        answer = json.loads(run("fit", file, "--check", os.path.join(self.out, "fit.json"), "--certificate", path,
                                "--json").stdout)
        self.assertEqual(answer["certificate"], path)
        with open(path, encoding="utf-8") as text:
            return json.load(text)

    def verdict(self, document):
        return subprocess.run([sys.executable, os.path.join(SOURCE, "checker", "vericone_check.py"), "-"],
                              input=json.dumps(document), capture_output=True, text=True, check=False)

    def test_of_meshes_clouds_and_unions(self):
        points, faces = peanut()
        for name, content, arguments in (
                ("mesh.obj", obj(points, faces), ("--shape", "biconvex")),
                ("mesh.obj", obj(points, faces), ("--shape", "ellipsoid", "--pieces", "2")),
                ("cloud.xyz", rows(shell(300, noise=0.02)), ("--shape", "ellipsoid")),
                ("flat.xyz", rows([x[:2] + [1] for x in shell(50)]), ("--shape", "ellipse"))):
            file = self.write(name, content)
            fit(file, *arguments, out=self.out)
            found = self.certificate(file)
            said = self.verdict(found)
            self.assertEqual(said.returncode, 0, said.stdout)
            self.assertIn("each point of the agent is in the obstacle", said.stdout)
            result = json.loads(self.read("fit.json"))
            pieces = found["claim"]["obstacle"].get("pieces", [found["claim"]["obstacle"]])
            self.assertEqual([piece["matrices"] for piece in pieces], [piece["quadrics"] for piece in result["pieces"]])
            with_one_out = json.loads(json.dumps(found))
            with_one_out["claim"]["agent"]["points"][0] = [9, 9, 9]
            self.assertEqual(self.verdict(with_one_out).returncode, 1)

    def test_of_triangles_beside_a_dent(self):
        # The needle of FitCheck, a triangle that bulges into the dent by less than its corners tell, and one beside it.
        q = [[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -4]], [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0],
                                                                         [0, 0, 0, -0.25]]]
        os.makedirs(self.out)
        for triangle, known in (([[-1, 0.5, 0], [1, 0.5, 0], [1, 0.4, 0.1]], True),
                                ([[-1, 0.5, 0], [1, 0.5, 0], [1, 0.5 + 2 ** -40, 0.1]], False),
                                ([[-0.5, 0.7, 0], [0.5, -0.7, 0], [0.5, -0.7, 0.1]], True)):
            self.write("out/fit.json", json.dumps({
                "pieces": [{"quadrics": q}], "certified": True, "coverage": 1, "margin": 0,
                "certificate": {"points": 3, "points_inside": 3, "triangles": 1, "triangles_inside": 1, "margins_inside": 3}}))
            file = self.write("one.obj", obj(triangle, [(0, 1, 2)]))
            if known:
                self.assertEqual(self.verdict(self.certificate(file)).returncode, 0)
                continue
            answer = json.loads(run("fit", file, "--check", os.path.join(self.out, "fit.json"), "--certificate",
                                    os.path.join(self.folder, "none.json"), "--json").stdout)
            self.assertIsNone(answer["certificate"])
            self.assertEqual(answer["no_certificate"], "1 of 1 triangles are in no piece as a whole")
            self.assertFalse(os.path.exists(os.path.join(self.folder, "none.json")))


class FitRealFiles(Files):
    PARTS = 3

    def prove(self, file, points, *arguments):
        result = fit(file, *arguments)
        self.assertTrue(result["certified"])
        self.assertEqual(inside(result, points), len(points))
        return result

    def test_the_elephant_in_rationals(self):
        if not os.path.exists(ARCHIVE):
            self.skipTest(ARCHIVE + " is not here (libcgal-demo)")
        with tarfile.open(ARCHIVE) as archive:
            member = next(m for m in archive.getmembers() if m.name.endswith("meshes/elephant.off"))
            path = self.write("elephant.off", archive.extractfile(member).read())
        points, _ = read_off(path)
        plain = self.prove(path, points, "--shape", "ellipsoid")
        best = self.prove(path, points)
        self.assertLessEqual(best["volume"], plain["volume"] * (1 + 1e-9))
        self.assertEqual(best["certificate"]["triangles"], 5558)

    def test_a_robust_fit_of_a_whole_figure_is_refused(self):
        """A figure of 0.27 m, to whose points an ellipsoid 0.73 m long is nearest."""
        path = os.path.join(DATA, "chef.pcd")
        if not os.path.exists(path):
            self.skipTest(path + " is not here; set VERICONE_DATA_DIR to the folder with it")
        for arguments in ((), ("--shape", "ellipsoid")):
            result = run("fit", path, "--mode", "robust", *arguments, "--out", self.out, "--quiet", "--no-figures")
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn("a surface that is not determined by these points: it reaches 0.36", result.stderr)

    def test_kleopatra(self):
        path = os.path.join(DATA, "216Kleopatra.obj")
        if not os.path.exists(path):
            self.skipTest(path + " is not here; set VERICONE_DATA_DIR to the folder with it")
        with open(path, encoding="ascii") as f:
            points = [[float(x) for x in line.split()[1:4]] for line in f if line.startswith("v ")]
        result = self.prove(path, points)
        self.assertNotEqual(result["shape"], "ellipsoid")
        self.assertLess(result["volume"], 0.9 * result["ellipsoid_volume"])


if __name__ == "__main__":
    unittest.main()
