# SPDX-License-Identifier: BSD-3-Clause
"""What the pictures of `vericone cone --out` show of a scene's velocities: the data they are drawn from, against closed
forms and sampling, and the pictures; pictures of runs. Environment as for cli_test.py."""
import json
import math
import os
import random
import re
import shutil
import subprocess
import unittest

from command import SOURCE
from hostile_test import InFolder

DRAWS = not subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], capture_output=True, check=False).returncode
DENTED = {"center": [12, 3], "semi_axes": [4, 2.5], "rotation": 0.3, "hyperbolas": [{"semi_axes": [1.5, 1.2], "rotation": 0.8}]}
MESH = "OFF\n8 6 0\n" + "".join("%d %d %d\n" % (8 + x, y, z) for x in (0, 1) for y in (-1, 1) for z in (-1, 1)) + \
       "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n"


def ball(center, radius):
    return {"center": center, "semi_axes": [radius] * len(center)}


def scene(agent, obstacle, v_a=None, v_b=None):
    given = {"agent": agent, "obstacle": obstacle, "agent_velocity": v_a, "obstacle_velocity": v_b}
    return json.dumps({k: v for k, v in given.items() if v is not None})


# Of the picture of a run: its texts, the dots among the curves, and how much of the picture the box of space takes.
DRAWN = """
import json, sys
import numpy as np
from mpl_toolkits.mplot3d import proj3d
from plot.runs import flown, picture
figure = picture(flown(sys.argv[1]))
space = figure.axes[0]
corners = np.array(np.meshgrid(space.get_xlim(), space.get_ylim(), space.get_zlim())).reshape(3, -1)
space.apply_aspect()
x, y, _ = proj3d.proj_transform(*corners, space.get_proj())
at = figure.transFigure.inverted().transform(space.transData.transform(np.column_stack([x, y])))
dots = [line.get_xydata()[0].tolist() for axis in figure.axes[1:] for line in axis.lines if line.get_marker() == "o"]
print(json.dumps({"texts": [t.get_text() for t in figure.texts], "dots": dots, "space": np.ptp(at, axis=0).tolist()}))
"""



# Draws as a script of apps/figures does, and looks at the figure in place of saving it.
LOOK_AT = """
import runpy, sys
scripts, script, folder = sys.argv[1:]
sys.path.insert(0, scripts)
sys.argv = [script, folder]
import vericone_figures.style as style

def look(figure, name):
    figure.canvas.draw()
    everything = figure.bbox.padded(1)
    for text in [*figure.texts, figure._suptitle, *(a.title for a in figure.axes)]:
        if text is not None and text.get_text():
            box = text.get_window_extent()
            assert everything.containsx(box.x0) and everything.containsx(box.x1), (name, "cut off", text.get_text())
    for axes in figure.axes:
        legend = axes.get_legend()
        for line in axes.get_lines() if legend else []:
            inside = legend.get_window_extent().count_contains(line.get_transform().transform(line.get_xydata()))
            assert not inside, (name, "legend on", line.get_label())
        for axis in axes._axis_map.values():
            label = axis.label.get_window_extent()
            for tick in axis.get_major_ticks():
                assert not label.overlaps(tick.label1.get_window_extent()), (name, axis.label.get_text(), tick.label1.get_text())
    print("looked at", name)

style.save = look
runpy.run_path(script, run_name="__main__")
"""


class PictureTexts(InFolder):
    """Titles are whole, legends cover no curve, labels no numbers."""
    @unittest.skipUnless(DRAWS, "no /usr/bin/python3 with matplotlib")
    def test_accuracy_and_engagements(self):
        scripts = os.path.join(SOURCE, "apps/figures")
        runs = {"combined_accuracy.py": ["accuracy", "--obstacle", "biconcave", "-N", "6", "--tolerance", "0.2", "--quiet"],
                "accuracy.py": ["accuracy", "-N", "60", "--quiet"], "engagement.py": ["accuracy", "-N", "60", "--quiet"]}
        for script, words in runs.items():
            with self.subTest(script):
                shutil.rmtree(os.path.join(self.folder, "out"), ignore_errors=True)
                result = self.run_limited(*words, "--planes", "3,6,12,36", "--no-figures", "--out", "out", preexec_fn=None)
                self.assertEqual(result.returncode, 0, result.stderr)
                done = subprocess.run(["/usr/bin/python3", "-c", LOOK_AT, scripts, os.path.join(scripts, script), "out"],
                                      cwd=self.folder, capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("looked at " + script.removesuffix(".py").removeprefix("combined_"), done.stdout)


class ConePictures(InFolder):
    def cone(self, content, *words):
        self.write("scene.yaml", content)
        result = self.run_limited("cone", "scene.yaml", *words, preexec_fn=None)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def data(self, content, name="engagement.json"):
        self.cone(content, "--out", "out", "--no-figures")
        with open(os.path.join(self.folder, "out", name), encoding="utf-8") as f:
            return json.load(f)

    def near(self, one, other, most):
        self.assertLess(math.dist(one, other), most)

    def test_circles_in_closed_form(self):
        # Radii 1 and 2, centres 5 apart along x; the obstacle moves too, and what is shown is seen from it.
        for d in (2, 3):
            def place(x, y, d=d):
                return [x, y, 0][:d]
            a, b = ball(place(0, 0), 1), ball(place(5, 0), 2)
            hit = self.data(scene(a, b, place(1, 7), place(-1, 7)))["course"]
            self.assertEqual((hit["verdict"], hit["velocity"]), ("in", place(2, 0)))
            self.assertAlmostEqual(hit["contact_time"], 1, 9)
            self.near(hit["contact_point"], place(3, 0), 1e-6)
            graze = self.data(scene(a, b, place(4, 3)))["course"]
            self.assertEqual(graze["verdict"], "on")
            self.assertAlmostEqual(graze["contact_time"], 4 / 5, 9)
            self.near(graze["contact_point"], place(5 - 2 * 3 / 5, 2 * 4 / 5), 1e-6)
            miss = self.data(scene(a, b, place(3, 4), place(0, 0)))["course"]
            self.assertEqual(miss["verdict"], "out")
            self.assertAlmostEqual(miss["miss_distance"], 4 - 3, 9)  # the line passes at 5 * 4 / 5
            self.assertAlmostEqual(miss["nearest_time"], 3 / 5, 6)  # the distance hardly changes there
            self.near(miss["nearest_on_agent"], place(1.8 + 0.8, 2.4 - 0.6), 1e-6)
            self.near(miss["nearest_on_obstacle"], place(5 - 1.6, 1.2), 1e-6)
            away = self.data(scene(a, b, place(-1, 1)))["course"]
            self.assertEqual((away["verdict"], away["nearest_time"]), ("out", 0))
            self.assertAlmostEqual(away["miss_distance"], 2, 9)

    def test_planar_scenes_of_every_kind(self):
        a = ball([0, 0], 1)
        rest = self.data(scene(a, ball([5, 0], 2)))
        self.assertAlmostEqual(rest["course"]["miss_distance"], 2, 9)
        self.assertAlmostEqual(rest["psi"], 2 * math.asin(3 / 5), 12)
        touching = self.data(scene(a, ball([3, 0], 2), [0, 1]))
        self.assertEqual((touching["relation"], touching["course"]["verdict"], touching["left"]), ("touching", "touching", None))
        self.near(touching["course"]["contact_point"], [1, 0], 1e-6)
        overlapping = self.data(scene(a, ball([2, 0], 2), [0, 1]))
        self.assertEqual((overlapping["relation"], overlapping["course"]),
                         ("overlapping", {"velocity": [0, 1], "verdict": "overlapping"}))

    def test_dents_against_sampling(self):
        rng = random.Random(1)
        seen = set()
        for _ in range(12):
            agent = {"center": [rng.uniform(-1, 1), rng.uniform(-3, 3)], "semi_axes": [rng.uniform(0.3, 2), 1], "rotation": rng.uniform(0, 3)}
            data = self.data(scene(agent, DENTED, [10, rng.uniform(-6, 6)]))
            course = data["course"]
            seen.add(course["verdict"])
            a, b = ([p for arc in data[name]["arcs"] for p in arc["points"]] for name in ("agent", "obstacle"))
            w = course["velocity"]

            def gap(p, q, w=w):
                d = [q[0] - p[0], q[1] - p[1]]
                t = max(0, (d[0] * w[0] + d[1] * w[1]) / (w[0] ** 2 + w[1] ** 2))
                return math.hypot(d[0] - t * w[0], d[1] - t * w[1])

            least = min(gap(p, q) for p in a for q in b)
            if course["verdict"] == "out":
                self.assertLessEqual(course["miss_distance"], least + 1e-9)
                self.assertGreater(course["miss_distance"], least - 0.01)  # chords cut off little
                self.assertAlmostEqual(math.dist(course["nearest_on_agent"], course["nearest_on_obstacle"]), course["miss_distance"], 9)
            else:
                self.assertEqual(course["verdict"], "in")
                self.assertLess(least, 0.05)
                # The point is on both outlines, the agent's where it is then.
                back = [x - course["contact_time"] * v for x, v in zip(course["contact_point"], w)]
                self.assertLess(min(math.dist(course["contact_point"], q) for q in b), 0.05)
                self.assertLess(min(math.dist(back, p) for p in a), 0.05)
        self.assertEqual(seen, {"in", "out"})

    def test_dents_and_meshes_in_space(self):
        # A ball of radius 1/2 passes above a body with dents along x whose rim is below its top, z = 2.
        dented = {"center": [8, 0, 0], "semi_axes": [2, 2, 2], "hyperboloids": [{"sheets": 2, "semi_axes": [1, 1, 1]}]}
        self.write("box.off", MESH)  # 8 <= x <= 9, |y|, |z| <= 1
        for obstacle, name, top, x in ((dented, "engagement.json", 2, 8), ({"mesh": "box.off"}, "pieces.json", 1, None)):
            miss = self.data(scene(ball([0, 0, 3], 0.5), obstacle, [2, 0, 0]), name)["course"]
            self.assertEqual(miss["verdict"], "out")
            self.assertAlmostEqual(miss["miss_distance"], 3 - 0.5 - top, 6)
            self.assertAlmostEqual(miss["nearest_on_obstacle"][2], top, 6)
            self.assertAlmostEqual(miss["nearest_on_agent"][2], 2.5, 6)
            if x:
                self.assertAlmostEqual(miss["nearest_time"], x / 2, 3)
            hit = self.data(scene(ball([0, 0, 0.75], 0.5), obstacle, [2, 0, 0]), name)["course"]
            self.assertEqual(hit["verdict"], "in")
            self.near(hit["contact_point"], [2 * hit["contact_time"], 0, 0.75], 0.5 + 1e-3)

    def test_maps_of_other_pairs(self):
        self.write("box.off", MESH)
        waist = {"center": [0, 0, 0], "semi_axes": [1, 1, 1], "hyperboloids": [{"sheets": 1, "semi_axes": [1, 0.5, 0.5]}]}
        for v, verdict in (([2, 0, 0], "in"), ([0, 2, 0], "out")):
            self.cone(scene(waist, {"mesh": "box.off"}, v), "--map", "0.2", "--out", "out", "--no-figures")
            with open(os.path.join(self.folder, "out", "cone_map.json"), encoding="utf-8") as f:
                course = json.load(f)["course"]
            self.assertEqual((course["velocity"], course["verdict"]), (v, verdict))
            if verdict == "in":  # the agent's tip, x = 1, and the side x = 8 of the box
                self.assertAlmostEqual(course["contact_time"], (8 - 1) / 2, 2)
            else:
                self.assertAlmostEqual(course["miss_distance"], 8 - 1, 2)

    def test_answers_do_not_depend_on_the_picture(self):
        for obstacle in (DENTED, ball([5, 1], 2)):
            content = scene(ball([0, 0], 1), obstacle, [9, 1])
            plain, drawn = json.loads(self.cone(content, "--json")), json.loads(self.cone(content, "--json", "--out", "out", "--no-figures"))
            plain.pop("seconds"), drawn.pop("seconds")
            self.assertEqual(plain, drawn)

    @unittest.skipUnless(DRAWS, "no /usr/bin/python3 with matplotlib")
    def test_planar_pictures_are_drawn(self):
        scenes = (scene(ball([0, 0], 1), DENTED, [9, 1]), scene(ball([0, 0], 1), ball([5, 0], 2), [4, 3]),
                  scene(ball([0, 0], 1), DENTED, [9, -6]), scene(ball([0, 0], 1), ball([5, 0], 2)),
                  scene(ball([0, 0], 1), ball([3, 0], 2), [0, 1]), scene(ball([0, 0], 1), ball([2, 0], 2)),
                  scene(ball([0, 0], 1e-6), {"center": [1e7, 1], "semi_axes": [1, 1e-7]}, [1, 1e-9]),
                  scene(ball([0, 0], 1), ball([1e140, 0], 2), [4, 3]), scene(ball([0, 0], 1), ball([9, 0], 2), [5e-324, 0]),
                  scene(ball([1e9, 1e9], 1), ball([1e9 + 9, 1e9], 1), [4, 0.3]))
        for content in scenes:
            with self.subTest(content):
                said = self.cone(content, "--picture", "out")
                self.assertIn("out/engagement.png", said)
                for name, begins in (("engagement.png", b"\x89PNG"), ("engagement.pdf", b"%PDF")):
                    with open(os.path.join(self.folder, "out", name), "rb") as f:
                        self.assertEqual(f.read(4), begins)


def agents(count, d, goals=True):
    """On a ring, each on its way to the other side."""
    bodies = []
    for i in range(count):
        at = [8 * math.cos(2 * math.pi * i / count), 8 * math.sin(2 * math.pi * i / count), 0][:d]
        goal = {"goal": {"point": [-x for x in at], "most": 3, "reached": 0.5}} if goals else {}
        bodies.append({"name": "A%d" % i, "shape": {"semi_axes": [0.5, 0.3, 0.3][:d]}, "position": at, "velocity": [-x / 4 for x in at],
                       "pilot": {"law": "clearance", "most": 6, "clearance": {"required": 0.3}, **goal}})
    return {"duration": 2, "step": 0.05, "bodies": bodies}


class RunPictures(InFolder):
    def simulate(self, scenario, *words):
        self.write("scenario.yaml", json.dumps(scenario))
        result = self.run_limited("simulate", "scenario.yaml", "--quiet", "--out", "out", *words, preexec_fn=None)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        with open(os.path.join(self.folder, "out", "run.json"), encoding="utf-8") as f:
            return json.load(f)

    def test_goals_are_told(self):
        for d in (2, 3):
            scenario = agents(3, d)
            del scenario["bodies"][1]["pilot"]["goal"]
            goals = self.simulate(scenario, "--no-figures")["goals"]
            self.assertEqual([(g["agent"], g["reached"]) for g in goals], [("A0", 0.5), ("A2", 0.5)])
            for goal, body in zip(goals, scenario["bodies"][::2]):
                self.assertEqual(goal["point"][:d], body["pilot"]["goal"]["point"])
                self.assertEqual(len(goal["point"]), 3)

    @unittest.skipUnless(DRAWS, "no /usr/bin/python3 with matplotlib")
    def test_few_and_many_bodies_are_drawn(self):
        rock = {"name": "rock", "shape": {"semi_axes": [1, 1, 1]}, "position": [0, 0, 0], "velocity": [0, 0, 0]}
        one = agents(1, 3)
        one["bodies"].append(rock)
        still = {"duration": 1, "bodies": [rock]}
        for scenario in (agents(2, 2), agents(10, 2), agents(10, 3, goals=False), one, still):
            with self.subTest(len(scenario["bodies"])):
                self.simulate(scenario)
                for name, begins in (("simulation.png", b"\x89PNG"), ("simulation.pdf", b"%PDF")):
                    with open(os.path.join(self.folder, "out", name), "rb") as f:
                        self.assertEqual(f.read(4), begins)


    @unittest.skipUnless(DRAWS, "no /usr/bin/python3 with matplotlib")
    def test_the_distance_kept_is_shown_and_space_fills_its_frame(self):
        far = agents(3, 3)  # small bodies: the nearest two are drawn again, larger
        far["duration"] = 6
        for body in far["bodies"]:
            body["position"] = [6 * x for x in body["position"]]
            body["velocity"] = [6 * x for x in body["velocity"]]
            body["pilot"]["goal"]["point"] = [6 * x for x in body["pilot"]["goal"]["point"]]
        for scenario, close in ((agents(3, 3), False), (far, True)):
            self.simulate(scenario, "--no-figures")
            with open(os.path.join(self.folder, "out", "proof.json"), encoding="utf-8") as f:
                proofs = json.load(f)["pairs"]
            self.assertEqual({p["verdict"] for p in proofs}, {"avoided"})
            drawn = subprocess.run(["/usr/bin/python3", "-c", DRAWN, os.path.join(self.folder, "out")], capture_output=True, text=True,
                                   check=False, env={**os.environ, "PYTHONPATH": os.path.join(SOURCE, "apps/figures")})
            self.assertEqual(drawn.returncode, 0, drawn.stderr)
            shown = json.loads(drawn.stdout)
            least = min(p["least_distance"] for p in proofs)
            said = float(re.search(r"avoided, proved: (.*) m apart or more", "\n".join(shown["texts"]))[1])
            self.assertTrue(0.99 * least <= said <= least, shown["texts"])
            for p in proofs:
                self.assertLess(min(math.dist(at, (p["least_time"], p["least_distance"])) for at in shown["dots"]), 1e-9)
            self.assertEqual(any("to scale" in text for text in shown["texts"]), close)
            wide, high = shown["space"]  # of the box that it has, 0.47 x 0.53 or more of the picture
            self.assertGreater(max(wide / 0.47, high / (0.53 if close else 0.7)), 0.97)
            self.assertGreater(min(wide / 0.47, high / (0.53 if close else 0.7)), 0.7)


if __name__ == "__main__":
    unittest.main()
