# SPDX-License-Identifier: BSD-3-Clause
"""`vericone view` without a browser: one file that asks for nothing, whose data is the scene, to the bit. Environment as
for command.py."""
import base64
import gzip
import hashlib
import html.parser
import json
import os
import re
import sys
import tempfile
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(os.path.dirname(HERE), "cli")]
import kinds  # noqa: E402
import runs  # noqa: E402
from command import SOURCE, run  # noqa: E402


class Elements(html.parser.HTMLParser):
    def __init__(self, page):
        super().__init__()
        self.all, self.open = [], None
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.all.append((tag, dict(attrs), []))
        self.open = self.all[-1] if tag in ("script", "style") else None

    def handle_endtag(self, tag):
        self.open = None

    def handle_data(self, data):
        if self.open:
            self.open[2].append(data)

    def text(self, tag, **attributes):
        return ["".join(text) for name, attrs, text in self.all
                if name == tag and all(attrs.get(k) == v for k, v in attributes.items())]


class ViewPages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def view(self, scene, *more):
        out = os.path.join(self.folder, "page.html")
        result = run("view", scene, "--out", out, *more)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(out, encoding="utf-8") as f:
            return f.read()

    def test_every_kind_with_all_its_digits_and_the_same_bytes_again(self):
        for name in kinds.SCENES:
            with self.subTest(name):
                scene = kinds.write(name, self.folder)
                page = self.view(scene)
                self.assertEqual(page, self.view(scene))
                self.assertLess(len(page), 1_700_000)
                data = json.loads(Elements(page).text("script", id="data")[0])
                self.assertEqual(data["planar"], "plane" in name)
                self.assertEqual(data["guarantee"]["exact"], name in kinds.EXACT)
                self.assertEqual(data["bodies"][0]["velocity"][:2], [1, 0.05])
                for body in data["bodies"]:
                    self.assertGreater(len(body["surface"]["points"]), 9)
                answer = json.loads(run("query", "--scene", "--rung", scene).stdout)
                self.assertEqual({k: data["answer"][k] for k in ("verdict", "rung")}, {k: answer[k] for k in ("verdict", "rung")})

    def test_asks_for_nothing_and_runs_nothing_else(self):
        elements = Elements(self.view(kinds.write("ellipsoids", self.folder)))
        policy = [attrs["content"] for tag, attrs, _ in elements.all if attrs.get("http-equiv") == "Content-Security-Policy"][0]
        self.assertTrue(policy.startswith("default-src 'none'; "))
        scripts = [text for text in elements.text("script") if text in elements.text("script", type=None)]
        for text, of in ((elements.text("style")[0], "style-src"), (scripts[-1], "script-src")):
            digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()
            self.assertIn("%s 'sha256-%s'" % (of, digest), policy)
        self.assertNotIn("unsafe-inline", policy)
        self.assertNotIn("'unsafe-eval'", policy)
        self.assertEqual(sum(1 for tag, attrs, _ in elements.all if tag == "script" and "type" not in attrs), 1)
        for tag, attrs, _ in elements.all:
            self.assertNotIn("src", attrs, tag)
            self.assertFalse([a for a in attrs if a.startswith("on")], tag)
            self.assertRegex(attrs.get("href", "#"), "^(#|data:,)")
        core = gzip.decompress(base64.b64decode(elements.text("script", id="core")[0]))
        self.assertEqual(core[:8], b"\0asm\1\0\0\0")

    def test_names_are_text(self):
        name = "<script>alert(1)<!--&'\".yaml"
        path = os.path.join(self.folder, name)
        os.rename(kinds.write("ellipsoids", self.folder), path)
        page = self.view(path)
        self.assertNotIn("<script>alert", page)
        self.assertEqual(json.loads(Elements(page).text("script", id="data")[0])["title"], name)

    def test_what_a_page_cannot_hold_is_one_line_and_nothing_is_written(self):
        with open(os.path.join(self.folder, "many.xyz"), "w", encoding="utf-8") as f:
            f.writelines("%d 0 %d\n" % (10 + i % 400, i // 400) for i in range(100_001))
        many = os.path.join(self.folder, "many.yaml")
        with open(many, "w", encoding="utf-8") as f:
            f.write("agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\nobstacle: {cloud: many.xyz, radius: 0.1}\n")
        good = kinds.write("ellipsoids", self.folder)
        for arguments, line in (
                ((many, "--out", self.folder + "/page.html"),
                 "vericone: obstacle: got 100001 pieces, must be one of at most 100000 in a page (vericone cone and query take more)"),
                ((good, "--out", self.folder), "vericone: --out: got %s, must be the name of a file for the page" % self.folder),
                (("none.yaml", "--out", self.folder + "/page.html"), None)):
            result = run("view", *arguments)
            self.assertEqual(result.returncode, 2, result.stderr)
            self.assertEqual(len(result.stderr.splitlines()), 1)
            if line:
                self.assertEqual(result.stderr.strip(), line)
            self.assertFalse(os.path.exists(self.folder + "/page.html"))

    def test_licences_of_all_that_is_in_it(self):
        page = self.view(kinds.write("ellipsoids", self.folder))
        for words in ("Mozilla Public License 2.0", "Boost Software License", "Apache License 2.0 with LLVM exceptions", "musl",
                      "Redistribution and use in source and binary forms"):
            self.assertIn(words, page)

    def test_json_says_where_it_is(self):
        out = os.path.join(self.folder, "page.html")
        said = json.loads(run("view", kinds.write("ellipsoids", self.folder), "--out", out, "--json").stdout)
        self.assertEqual(said, {"page": out, "bytes": os.path.getsize(out)})


class RunPages(unittest.TestCase):
    """Pages of runs, by `view` and by `simulate --animate`: what they hold against the tables."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def page(self, scenario):
        """Its folder, the page and its data."""
        folder = runs.simulate(scenario, self.folder, "--animate")
        out = os.path.join(self.folder, "page.html")
        result = run("view", folder, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        with open(out, encoding="utf-8") as f, open(os.path.join(folder, "simulation.html"), encoding="utf-8") as same:
            page = f.read()
            self.assertEqual(page, same.read())  # one drawing code
        return folder, page, json.loads(Elements(page).text("script", id="data")[0])

    def test_rows_events_and_proofs_are_those_of_the_tables(self):
        for d in (2, 3):
            folder, page, data = self.page(runs.agents(3, d))
            self.assertEqual((data["what"], data["planar"], data["end"]), ("run", d == 2, 4))
            rows = runs.table(folder, "bodies.csv")
            for body in data["bodies"]:
                own = [r for r in rows if r["body"] == body["name"]]
                self.assertEqual(body["t"], [float(r["t [s]"]) for r in own])
                for name, columns in (("at", ("x [m]", "y [m]", "z [m]")), ("velocity", ("vx [m/s]", "vy [m/s]", "vz [m/s]")),
                                      ("turn", ("qw", "qx", "qy", "qz"))):
                    self.assertEqual(body[name], [float(r[c]) for r in own for c in columns])  # all digits
                self.assertGreater(len(body["surface"]["triangles"]), 30)
                self.assertIsNotNone(body["flies"])
            with open(os.path.join(folder, "proof.json"), encoding="utf-8") as f:
                self.assertEqual(data["proof"], json.load(f))
            events = runs.table(folder, "events.csv")
            self.assertEqual([(e["t"], e["event"], e["agent"]) for e in data["events"]],
                             [(float(e["t [s]"]), e["event"], e["agent"]) for e in events])
            self.assertEqual([g["reached"] for g in data["goals"]], [0.5] * 3)
            self.assertEqual(sum(len(e["t"]) for e in data["encounters"]), len(runs.table(folder, "encounters.csv")))
            self.assertEqual(data["bodies"][1]["name"], runs.HOSTILE)
            self.assertNotIn("<img src=x", page)

    def test_bodies_of_every_kind_and_long_runs(self):
        _, page, data = self.page(runs.kinds())
        for body in data["bodies"]:
            self.assertGreater(len(body["surface"]["points"]), 9, body["name"])
            self.assertEqual("numbers" in body, body["name"] != "late", body["name"])
        self.assertEqual(data["bodies"][2]["dented"], [1, 2, 1])
        self.assertGreaterEqual(data["bodies"][2]["t"][0], 1)
        folder, page, data = self.page(runs.agents(5, 3, duration=16, step=0.01))
        self.assertLess(len(page), 5_000_000)
        rows = [r for r in runs.table(folder, "bodies.csv") if r["body"] == "A0"]
        self.assertEqual(len(data["bodies"][0]["t"]), min(400, len(rows)))
        self.assertEqual((data["bodies"][0]["t"][0], data["bodies"][0]["t"][-1]), (0, float(rows[-1]["t [s]"])))

    def test_a_folder_that_is_none_of_a_run_is_one_line(self):
        folder = runs.simulate(runs.agents(2, 2), self.folder)
        for gone in ("bodies.csv", "scenario.yaml", "run.json"):
            os.remove(os.path.join(folder, gone))
            result = run("view", folder, "--out", os.path.join(self.folder, "page.html"))
            self.assertEqual((result.returncode, result.stderr), (
                2, "vericone: run: got %s without %s, must be a folder that vericone simulate has written\n" % (folder, gone)))
            self.assertFalse(os.path.exists(os.path.join(self.folder, "page.html")))


class ViewTemplate(unittest.TestCase):
    """The page that is kept is the one that its sources give, but for the core, which takes minutes (viewer/build)."""

    def test_style_text_and_licences_are_those_of_the_sources(self):
        viewer = os.path.join(SOURCE, "viewer")
        with open(os.path.join(viewer, "page", "template.html"), encoding="utf-8") as f:
            page = f.read()
        with open(os.path.join(viewer, "src", "page.html"), encoding="utf-8") as f:
            source = f.read()
        with open(os.path.join(viewer, "src", "page.css"), encoding="utf-8") as f:
            self.assertIn(f.read(), page)
        parts = re.split(r"@[A-Z]+@", source)
        at = 0
        for part in parts:
            self.assertIn(part, page[at:])
            at = page.index(part, at) + len(part)
        self.assertIn("@DATA@", page)
        self.assertLess(len(page), 1_500_000)


if __name__ == "__main__":
    unittest.main()
