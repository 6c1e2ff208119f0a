# SPDX-License-Identifier: BSD-3-Clause
"""vericone fit ROBOT --urdf/--sdf: what is written is read by an XML library of Python's, its angles turned by sine and
cosine of 60 digits in rationals, and every triangle of each link is found inside one piece. check_urdf (urdfdom) and
libsdformat load it where they are installed. Environment as for command.py."""
import json
import math
import os
import re
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree
from fractions import Fraction

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from command import run  # noqa: E402
from fit_test import CUBE, SIDES, Files, peanut, triangles_of  # noqa: E402
from pieces_test import obj  # noqa: E402

LOADER = """#include <sdf/sdf.hh>
#include <iostream>
int main(int, char** a) {
  sdf::Root root;
  const auto errors = root.Load(a[1]);
  for (const auto& e : errors) std::cerr << e.Message() << std::endl;
  if (!errors.empty()) return 1;
  const auto* link = root.Model()->LinkByIndex(0);
  for (unsigned i = 0; i < link->CollisionCount(); ++i)
    std::cout << static_cast<int>(link->CollisionByIndex(i)->Geom()->Type()) << std::endl;
}
"""

URDF = """<?xml version="1.0"?>
<!-- <link name="none"><collision/></link> -->
<robot name="two &amp; a half">
  <link name="base">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><geometry><mesh filename="peanut.obj"/></geometry></visual>
    <collision name="body">
      <origin xyz="0.1 -0.2 0.3" rpy="0.4 -0.5 2.6"/>
      <geometry><mesh filename="package://shapes/peanut.obj" scale="0.5 0.25 -0.125"/></geometry>
    </collision>
    <collision><geometry><sphere radius="0.1"/></geometry></collision>
  </link>
  <link name="arm"><collision><origin rpy="0 1.5707963267948966 0"/><geometry><mesh filename="cube.obj"/></geometry>
  </collision></link>
  <joint name="hinge" type="fixed"><parent link="base"/><child link="arm"/><origin xyz="1 0 0"/></joint>
</robot>
"""

SDF = """<?xml version="1.0"?>
<sdf version="1.9"><model name="m"><link name="base"><pose>1 2 3 0 0 0</pose>
  <collision name="body"><pose degrees="true">0.1 -0.2 0.3 23 -31 150</pose>
    <geometry><mesh><uri>peanut.obj</uri><scale>0.5 0.25 0.125</scale></mesh></geometry>
    <surface><friction><ode><mu>0.7</mu></ode></friction></surface></collision>
  <collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link></model></sdf>
"""


def sine_cosine(angle):
    """Of a Fraction: to 60 digits, by Taylor's series."""
    bound, sine, cosine, term, k = Fraction(1, 10 ** 60), Fraction(0), Fraction(0), Fraction(1), 0
    while abs(term) > bound or k < 4:
        if k % 2:
            sine += term if k % 4 == 1 else -term
        else:
            cosine += term if k % 4 == 0 else -term
        k += 1
        term = term * angle / k
        term = Fraction(round(term * 10 ** 70), 10 ** 70)
    return sine, cosine


def rotation(rpy):
    (sr, cr), (sp, cp), (sy, cy) = (sine_cosine(a) for a in rpy)
    return [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]]


def numbers(text):
    return [Fraction(x) for x in text.split()]


class Collision:
    """A <collision> of either format: its place and its shape."""

    def __init__(self, element, urdf):
        if urdf:
            origin = element.find("origin")
            place = {} if origin is None else origin.attrib
            self.at, rpy = numbers(place.get("xyz", "0 0 0")), numbers(place.get("rpy", "0 0 0"))
        else:
            pose = element.find("pose")
            six = numbers("0 0 0 0 0 0" if pose is None else pose.text)
            self.at, rpy = six[:3], six[3:]
            if pose is not None and pose.get("degrees"):
                pi = Fraction(314159265358979323846264338327950288419716939937510, 10 ** 50)
                rpy = [a * pi / 180 for a in rpy]
        self.turn = rotation(rpy)
        shape = element.find("geometry")[0]
        self.kind = shape.tag
        get = shape.get if urdf else shape.findtext
        self.sizes = {name: numbers(get(name)) for name in ("radius", "length", "size", "radii") if get(name)}

    def to_link(self, x):
        return [sum(self.turn[i][k] * x[k] for k in range(3)) + self.at[i] for i in range(3)]

    def holds(self, x):
        d = [a - b for a, b in zip(x, self.at)]
        y = [sum(self.turn[k][i] * d[k] for k in range(3)) for i in range(3)]
        across = y[0] ** 2 + y[1] ** 2
        if self.kind == "box":
            return all(abs(a) <= edge / 2 for a, edge in zip(y, self.sizes["size"]))
        if self.kind == "ellipsoid":
            return sum((a / r) ** 2 for a, r in zip(y, self.sizes["radii"])) <= 1
        radius = self.sizes["radius"][0]
        half = self.sizes.get("length", [0])[0] / 2
        if self.kind == "cylinder":
            return across <= radius ** 2 and abs(y[2]) <= half
        return across + max(abs(y[2]) - half, 0) ** 2 <= radius ** 2  # capsule, sphere


def without_collisions(text):
    return re.sub(r"\s*<collision\b.*?</collision>", "", text, flags=re.DOTALL)


class FitRobot(Files):
    def setUp(self):
        super().setUp()
        self.points, self.faces = peanut()
        self.write("peanut.obj", obj(self.points, self.faces))
        self.write("cube.obj", obj(CUBE, SIDES))

    def fit(self, name, text, *arguments):
        urdf = name.endswith(".urdf")
        written = os.path.join(self.folder, "new." + ("urdf" if urdf else "sdf"))
        answer = run("fit", self.write(name, text), "--urdf" if urdf else "--sdf", written, "--quiet", *arguments)
        self.assertEqual(answer.returncode, 0, answer.stderr)
        with open(written, encoding="utf-8") as f:
            new = f.read()
        # Nothing but collisions changed.
        self.assertEqual(without_collisions(new), without_collisions(text))
        return answer, new, written

    def assert_inside(self, old, new, link, points, faces, scale):
        """Every triangle of the link's mesh, placed in rationals, is in one of the new collisions."""
        urdf = "<robot" in old
        before = Collision(ElementTree.fromstring(old).find(f".//link[@name='{link}']/collision"), urdf)
        after = [Collision(e, urdf) for e in ElementTree.fromstring(new).findall(f".//link[@name='{link}']/collision")]
        corners = [before.to_link([Fraction(c) * s for c, s in zip(p, scale)]) for p in points]
        where = [{k for k, body in enumerate(after) if body.holds(x)} for x in corners]
        for t in triangles_of(faces):
            self.assertTrue(set.intersection(*(where[i] for i in t)), t)
        return [body.kind for body in after]

    def test_urdf_contains_every_triangle(self):
        for kinds, pieces in (("cylinder,box,sphere", "3"), ("box", "1"), ("capsule", "2"), ("cylinder", "2")):
            answer, new, written = self.fit("robot.urdf", URDF, "--kinds", kinds, "--pieces", pieces, "--package",
                                            "shapes=" + self.folder)
            self.assertIn("certified           yes: every triangle of each link", answer.stdout)
            package = ["--package", "shapes=" + self.folder]
            old = os.path.join(self.folder, "robot.urdf")
            self.assertIn("certificate         holds", run("fit", old, "--check", written, *package).stdout)
            half = [Fraction(1, 2), Fraction(1, 4), Fraction(-1, 8)]
            self.assert_inside(URDF, new, "base", self.points, self.faces, half)
            found = self.assert_inside(URDF, new, "arm", CUBE, SIDES, [1, 1, 1])
            self.assertLessEqual(set(found), set(kinds.split(",")))
            if "sphere" in kinds:  # it is kept as it is written
                self.assertIn('<collision><geometry><sphere radius="0.1"/></geometry></collision>', new)
            self.assertEqual(run("check", self.write("scene.yaml", f"agent: {{center: [9, 0, 0], semi_axes: [1, 1, 1], "
                                 f"velocity: [-1, 0, 0]}}\nobstacle: {{robot: {written}}}\n")).returncode, 0)
            if shutil.which("check_urdf"):
                loaded = subprocess.run(["check_urdf", written], capture_output=True, text=True, check=False)
                self.assertEqual(loaded.returncode, 0, loaded.stdout + loaded.stderr)
                # urdfdom 3 knows no capsule, and leaves it out.
                self.assertEqual("Error" in loaded.stderr + loaded.stdout, "capsule" in kinds, loaded.stderr)

    def test_sdf_contains_every_triangle_and_keeps_properties(self):
        for kinds in ("ellipsoid,capsule,box,cylinder,sphere", "ellipsoid", "capsule"):
            _, new, written = self.fit("robot.sdf", SDF, "--kinds", kinds, "--pieces", "3")
            found = self.assert_inside(SDF, new, "base", self.points, self.faces,
                                       [Fraction(1, 2), Fraction(1, 4), Fraction(1, 8)])
            self.assertLessEqual(set(found), {*kinds.split(","), "sphere"})
            self.assertGreaterEqual(new.count("<mu>0.7</mu>"), 1)
            self.assertEqual(run("check", self.write("scene.yaml", f"agent: {{center: [9, 0, 0], semi_axes: [1, 1, 1], "
                                 f"velocity: [-1, 0, 0]}}\nobstacle: {{robot: {written}}}\n")).returncode, 0)

    def test_names_with_quotes_and_entities(self):
        text = """<robot name="r"><link name="l &quot;x&quot; &lt;1&gt;"><collision name='q"u'>
  <geometry><mesh filename="cube.obj"/></geometry></collision></link></robot>"""
        _, new, written = self.fit("quoted.urdf", text, "--kinds", "box")
        self.assertEqual([e.get("name") for e in ElementTree.fromstring(new).iter("collision")], ['q"u_fit_0'])
        self.assertEqual(run("fit", os.path.join(self.folder, "quoted.urdf"), "--check", written).returncode, 0)

    def test_check_tells_a_link_that_sticks_out(self):
        _, new, _ = self.fit("robot.sdf", SDF, "--kinds", "box,sphere", "--pieces", "2")
        old = os.path.join(self.folder, "robot.sdf")
        smaller = new
        for size in re.findall("<size>(.*?)</size>", new):
            edges = size.split()
            smaller = smaller.replace(size, " ".join([repr(float(edges[0]) * (1 - 1e-9)), *edges[1:]]))
        answer = run("fit", old, "--check", self.write("smaller.sdf", smaller), "--json")
        self.assertEqual(answer.returncode, 1, answer.stdout + answer.stderr)
        link = json.loads(answer.stdout)["links"][0]
        self.assertLess(link["triangles_inside"], link["triangles"])
        self.assertEqual((link["shapes"], link["shapes_inside"]), (1, 1))
        without = self.write("without.sdf", re.sub("<geometry><sphere>.*?</geometry>",
                                                   "<geometry><sphere><radius>0.09</radius></sphere></geometry>", new))
        self.assertEqual(run("fit", old, "--check", without).returncode, 1)

    def test_other_shapes_are_inside_what_replaces_them(self):
        """A sphere by its box; a cylinder by a box."""
        text = ('<robot name="r"><link name="l"><collision><origin xyz="1 2 3" rpy="0.3 0.2 0.1"/><geometry>'
                '<cylinder radius="0.5" length="2"/></geometry></collision></link></robot>\n')
        _, new, _ = self.fit("robot.urdf", text, "--kinds", "box")
        body = Collision(ElementTree.fromstring(new).find(".//collision"), True)
        old = Collision(ElementTree.fromstring(text).find(".//collision"), True)
        self.assertEqual(body.kind, "box")
        for k in range(64):
            for z in (-1, 1):
                s, c = sine_cosine(Fraction(k, 10))
                self.assertTrue(body.holds(old.to_link([c / 2, s / 2, Fraction(z)])))
        self.assertLess(math.prod(float(x) for x in body.sizes["size"]), 2.0001)

    def test_the_public_reader_of_sdf_loads_it(self):
        compiler, flags = shutil.which("g++"), None
        if compiler and shutil.which("pkg-config"):
            flags = subprocess.run(["pkg-config", "--cflags", "--libs", "sdformat12"], capture_output=True, text=True,
                                   check=False)
        if flags is None or flags.returncode:
            self.skipTest("libsdformat-dev is not installed")
        _, _, written = self.fit("robot.sdf", SDF, "--kinds", "ellipsoid,capsule,box,cylinder", "--pieces", "3")
        source, program = self.write("loader.cpp", LOADER), os.path.join(self.folder, "loader")
        subprocess.run([compiler, source, "-o", program, *flags.stdout.split()], check=True, timeout=250)
        loaded = subprocess.run([program, written], capture_output=True, text=True, check=False)
        self.assertEqual(loaded.returncode, 0, loaded.stderr)
        self.assertGreaterEqual(len(loaded.stdout.split()), 2)

    def test_what_does_not_fit_is_refused_in_one_line(self):
        robot, scene = self.write("robot.urdf", URDF), self.write("robot.sdf", SDF)
        package = ["--package", "shapes=" + self.folder]
        for arguments, says in (([robot, "--urdf", "new", "--kinds", "ellipsoid", *package], "URDF has no ellipsoid"),
                                ([robot, "--sdf", "new", *package], "is URDF, --urdf writes that"),
                                ([scene, "--urdf", "new"], "is SDF, --sdf writes that"),
                                ([robot, "--urdf", "new"], "--package shapes=FOLDER"),
                                ([robot, "--urdf", "new", "--package", "shapes"], "NAME=FOLDER"),
                                ([robot, "--urdf", "new", "--pieces", "0", *package], "--pieces"),
                                ([robot, "--urdf", "new", "--shape", "star", *package], "--shape"),
                                ([scene, "--sdf", "new", "--urdf", "other"], "given without --sdf"),
                                ([os.path.join(self.folder, "cube.obj"), "--urdf", "new"], "an element")):
            answer = run("fit", *arguments, "--quiet", cwd=self.folder)
            self.assertEqual(answer.returncode, 2, arguments)
            self.assertEqual(answer.stderr.count("\n"), 1, answer.stderr)
            self.assertIn(says, answer.stderr)
            self.assertFalse(os.path.exists(os.path.join(self.folder, "new")))


if __name__ == "__main__":
    unittest.main()
