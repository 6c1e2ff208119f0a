# SPDX-License-Identifier: BSD-3-Clause
"""Pages of `vericone view` in a real Chromium: what they answer against `vericone query`, what they ask for, show and say.
VERICONE_CASES: velocities a kind (60; the campaign's 10,000). VERICONE_KEEP: a folder for screenshots. Environment as for
command.py."""
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(os.path.dirname(HERE), "cli")]
import kinds  # noqa: E402
from browser import Browser  # noqa: E402
from command import SOURCE, VERICONE, run  # noqa: E402
import runs  # noqa: E402
from run_pages import RunsInBrowser  # noqa: E402

CASES = int(os.environ.get("VERICONE_CASES", "10000" if os.environ.get("VERICONE_CAMPAIGN") == "long" else "60"))
KEEP = os.environ.get("VERICONE_KEEP")
AXE = os.path.join(SOURCE, "viewer", "node_modules", "axe-core", "axe.min.js")
COLOURS = """(id => {
  const canvas = document.getElementById(id), found = new Map();
  const data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  for (let i = 0; i < data.length; i += 4) { const c = data[i] << 16 | data[i + 1] << 8 | data[i + 2]; found.set(c, (found.get(c) || 0) + 1); }
  return [...found.values()].sort((a, b) => b - a).map(n => n / canvas.width / canvas.height);
})"""
ASK = """((data, velocities) => {
  const { core, Pair } = vericone, [a, b] = data.bodies.map(x => core.body(x.numbers)), [p, q] = data.bodies;
  const pair = new Pair(core, a, p.position, p.rotation, b, q.position, q.rotation);
  return velocities.map(v => [pair.verdict(v, [0, 0, 0]), pair.rung(v, [0, 0, 0])]);
})"""


class ViewInBrowser(RunsInBrowser, unittest.TestCase):
    COLOURS = COLOURS

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def page(self, name="ellipsoids", scene=None):
        """The path of a page, and its data."""
        out = os.path.join(self.folder, name.replace(" ", "-") + ".html")
        result = run("view", scene or kinds.write(name, self.folder), "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(out, encoding="utf-8") as f:
            return out, json.loads(re.search(r'id="data">(.*?)</script>', f.read(), re.DOTALL)[1])

    def open(self, path):
        self.browser.open(path)
        self.browser.settle()
        self.assertEqual(self.browser.run("document.documentElement.dataset.ready"), "yes", self.browser.text("complaint"))

    def quiet(self, path):
        self.assertEqual(self.browser.requests, ["file://" + path])
        self.assertEqual(self.browser.complaints, [])
        self.assertEqual(self.browser.text("complaint"), "")

    def shot(self, name):
        if KEEP:
            os.makedirs(KEEP, exist_ok=True)
            self.browser.picture(os.path.join(KEEP, name + ".png"))

    def ask(self, data, velocities):
        chunks = [velocities[i:i + 200] for i in range(0, len(velocities), 200)]
        return [x for chunk in chunks for x in self.browser.run("%s(%s, %s)" % (ASK, json.dumps(data), json.dumps(chunk)))]

    def test_verdicts_and_rungs_are_those_of_query(self):
        path, _ = self.page()
        self.open(path)
        differ = {}
        for name in kinds.SCENES:
            scene = kinds.write(name, self.folder)
            _, data = self.page(name)
            count = CASES if name in kinds.EXACT else max(20, CASES // 10)
            velocities = kinds.velocities(count, "plane" in name, lambda list_: [x[0] for x in self.ask(data, list_)], 4301)
            cases = os.path.join(self.folder, "cases.jsonl")
            with open(cases, "w", encoding="utf-8") as f:
                f.writelines(kinds.lines_of(scene, velocities))
            said = subprocess.run([VERICONE, "query", "--rung", cases], capture_output=True, text=True, check=True).stdout
            expected = [[answer["verdict"], answer["rung"]] for answer in map(json.loads, said.splitlines())]
            found = self.ask(data, velocities)
            self.assertEqual(len(found), count)
            self.assertGreater(len({v for v, _ in found}), 1, name)
            if name == "ellipsoids":
                self.assertIn("exact", {rung for _, rung in found} | {"exact"} if CASES < 1000 else {rung for _, rung in found})
            differ[name] = sum(a != b for a, b in zip(expected, found))
            if CASES > 1000:
                print("%s: %d velocities, %d differ" % (name, count, differ[name]), file=sys.stderr, flush=True)
        self.assertEqual(differ, dict.fromkeys(kinds.SCENES, 0))

    def test_pages_of_each_kind_show_bodies_and_velocities_and_ask_for_nothing(self):
        for name in kinds.SCENES if CASES > 1000 else ("ellipsoids", "biconcave", "mesh", "plane"):
            with self.subTest(name):
                path, data = self.page(name)
                self.open(path)
                self.browser.run("new Promise(done => setTimeout(done, 200))")
                for canvas in ("plane", "solid"):
                    shares = self.browser.run("%s('%s')" % (COLOURS, canvas))
                    self.assertGreater(len(shares), 4, canvas)
                    self.assertGreater(sum(shares[1:]), 0.02, canvas)  # more than the paper
                self.assertEqual(self.browser.text("verdict-word"), data["answer"]["verdict"])
                self.quiet(path)
                self.shot(name.replace(" ", "-"))

    def test_typed_dragged_and_stepped_velocities(self):
        path, _ = self.page()
        self.open(path)
        first = self.browser.text("verdict-word")
        self.assertEqual(first, "in")
        field = "document.querySelector('input[aria-label=\"velocity of the agent, y\"]')"
        self.browser.run(field + ".focus()")
        self.browser.run(field + ".select()")
        self.browser.type("0.90000000000000002")
        self.browser.key("Enter")
        self.assertEqual(self.browser.text("verdict-word"), "out")
        self.assertEqual(self.browser.run(field + ".value"), "0.9")
        self.browser.key("ArrowUp")
        self.assertEqual(self.browser.run(field + ".value"), "0.9000000000000001")
        self.browser.run(field + ".select()")
        self.browser.type("fast")
        self.browser.key("Enter")
        self.assertEqual(self.browser.text("complaint"), 'velocity of the agent, y: got "fast", must be a finite number')
        self.assertEqual(self.browser.run(field + ".getAttribute('aria-invalid')"), "true")
        self.browser.run("document.getElementById('plane').scrollIntoView({block: 'center'})")
        box = self.browser.run("(r => [r.left, r.top, r.width, r.height])(document.getElementById('plane').getBoundingClientRect())")
        at = lambda x, y: (box[0] + x * box[2], box[1] + y * box[3])  # noqa: E731
        self.browser.drag(at(0.5, 0.05), at(0.7, 0.5))
        self.assertEqual(self.browser.text("verdict-word"), "in")
        self.browser.run("new Promise(done => setTimeout(done, 600))")
        self.assertIn("They will overlap", self.browser.text("announce"))

    def test_by_keyboard_alone(self):
        path, _ = self.page()
        self.open(path)
        seen = []
        for _ in range(60):
            self.browser.key("Tab")
            seen.append(self.browser.run("(e => e.id || e.getAttribute('aria-label') || e.textContent)(document.activeElement)"))
            if seen[1:] and seen[-1] == seen[0]:
                break
        for wanted in ("velocity of the agent, x", "velocity of the obstacle, z: the next larger double", "plane", "plane-name", "solid",
                       "axes", "nearer", "from above", "reset the view", "Move a body by (m)", "As a table"):
            self.assertIn(wanted, seen)
        self.browser.run("document.getElementById('plane').focus()")
        before = self.browser.run("document.querySelector('input').value")
        for _ in range(12):
            self.browser.key("ArrowUp", shift=True)
        self.assertNotEqual(self.browser.run("[...document.querySelectorAll('input')].map(i => i.value).join()"), before)
        self.assertEqual(self.browser.text("verdict-word"), "out")
        self.browser.run("document.getElementById('solid').focus()")
        picture = self.browser.run("document.getElementById('solid').toDataURL()")
        self.browser.key("ArrowLeft")
        self.browser.settle()
        self.assertNotEqual(self.browser.run("document.getElementById('solid').toDataURL()"), picture)

    def test_names_are_shown_as_text(self):
        name = "x\"><img src=x onerror=document.body.remove()><!--.yaml"
        scene = os.path.join(self.folder, name)
        os.rename(kinds.write("ellipsoids", self.folder), scene)
        path, _ = self.page(scene=scene)
        self.open(path)
        self.assertEqual(self.browser.text("title"), name)
        self.assertEqual(self.browser.run("document.images.length"), 0)
        self.quiet(path)

    @unittest.skipUnless(os.path.exists(AXE), "axe-core is not there (viewer/build brings it)")
    def test_accessible_in_light_and_dark_on_a_screen_and_a_phone(self):
        pages = {"": self.page()[0], "run-": self.run_page(runs.agents(3, 3))[1]}
        with open(AXE, encoding="utf-8") as f:
            axe = f.read()
        self.addCleanup(lambda: (self.browser.like(prefers_color_scheme="light"), self.browser.size(1280, 900)))
        for name, path in pages.items():
            for scheme, width in (("light", 1280), ("dark", 1280), ("light", 380)):
                self.browser.size(width, 900)
                self.browser.like(prefers_color_scheme=scheme)
                self.open(path)
                self.browser.run("document.querySelectorAll('details').forEach(d => d.open = true)")
                self.browser.run(axe + "; 0")
                found = self.browser.run(
                    "axe.run().then(r => r.violations.map(v => v.id + ': ' + v.nodes.map(n => n.target).join(' ')))")
                self.assertEqual(found, [], name + scheme)
                self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), width)
                self.shot("axe-%s%s-%d" % (name, scheme, width))


if __name__ == "__main__":
    unittest.main()
