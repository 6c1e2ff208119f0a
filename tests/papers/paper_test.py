# SPDX-License-Identifier: BSD-3-Clause
"""Claims and figures of papers/dhal2022, by the command that makes them. Environment: VERICONE (the program)."""
import csv
import functools
import html.parser
import json
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from printed_numbers import PRINTED  # noqa: E402

VERICONE = os.path.abspath(os.environ["VERICONE"])
VERDICTS = {"reproduced", "differs", "not decided by what is printed", "source wrong"}
STEP = 0.01  # s, of 5.4


def run(*arguments):
    return subprocess.run([VERICONE, *arguments], capture_output=True, text=True, check=False)


@functools.lru_cache
def claims():
    result = run("claims", "--json", "--quiet")
    assert result.returncode == 0, result.stderr
    return {c["id"]: c for c in json.loads(result.stdout)["claims"]}


class Claims(unittest.TestCase):
    def test_every_claim_has_a_verdict_a_note_and_a_figure(self):
        figures = {line.split("\t")[0] for line in run("figures", "--list").stdout.splitlines()}
        for c in claims().values():
            with self.subTest(c["id"]):
                self.assertIn(c["verdict"], VERDICTS)
                for field in ("section", "what", "printed", "ours", "tolerance_reason", "note"):
                    self.assertTrue(c[field], field)
                self.assertTrue(set(c["figures"]) and set(c["figures"]) <= figures)
                self.assertIn(c["kind"], ("given", "result"))

    def test_every_printed_number_is_there(self):
        for section, numbers in PRINTED.items():
            for name, text in numbers:
                with self.subTest(section=section, name=name, text=text):
                    found = [c for c in claims().values() if c["section"] == section and name in c["id"]
                             and text in c["printed"]]
                    self.assertTrue(found)

    def test_verdicts_follow_from_the_values(self):
        for c in claims().values():
            if c["printed_value"] is None or c["ours_value"] is None or c["kind"] == "given":
                continue
            with self.subTest(c["id"]):
                within = abs(c["ours_value"] - c["printed_value"]) <= c["tolerance"] * (1 + 1e-9)
                self.assertEqual(within, c["verdict"] == "reproduced")

    def test_given_values_are_those_printed(self):
        for c in claims().values():
            if c["kind"] == "given" and c["id"] != "6.3.1/engagements":
                self.assertEqual(c["verdict"], "reproduced", c["id"])

    def test_what_can_be_reproduced(self):
        c = claims()
        self.assertAlmostEqual(c["5.4.1/y-0"]["ours_value"], -0.0452, delta=0.00005)
        self.assertAlmostEqual(c["5.4.2/y-0"]["ours_value"], -0.053, delta=0.0005)
        self.assertAlmostEqual(c["5.4.1/out-of-F2"]["ours_value"], 0.80, delta=STEP)
        self.assertAlmostEqual(c["5.4.2/out-of-F2"]["ours_value"], 0.84, delta=STEP)
        for name in ("5.4.1/positive", "5.4.1/negative", "5.4.1/constant", "6.5/noncooperative/y-0",
                     "6.5/noncooperative/V_r-0", "6.5/cooperative/mu", "6.3.1/bound"):
            self.assertEqual(c[name]["verdict"], "reproduced", name)

    def test_what_cannot_is_listed_with_ours(self):
        for name in ("5.4.1/psi-2.13", "5.4.1/passes-F3", "6.5/noncooperative/clear-of-B"):
            c = claims()[name]
            self.assertEqual(c["verdict"], "not decided by what is printed", name)
            self.assertIsNotNone(c["ours_value"])
            self.assertIn("assumed", c["note"])


def boundary(kind, center, heading, k=None, count=1500):
    """Points of a body of 6 x 2 m: an ellipse, or the conic (5.5)."""
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    u, v = np.cos(angle) / 6, np.sin(angle) / 2
    if kind == "ellipse":
        r = 1 / np.hypot(u, v)
    else:
        with np.errstate(divide="ignore", invalid="ignore"):
            dent = np.where(np.abs(u) > np.abs(v), np.sqrt((1 - k) / (u * u - v * v)), np.inf)
        r = np.minimum(np.sqrt((1 + k) / (u * u + v * v)), dent)
        # The tips, where both conics meet, are in every sample.
        tips = np.array([[sx * 6, sy * 2 * np.sqrt(k)] for sx in (1, -1) for sy in (1, -1)])
    body = np.stack([r * np.cos(angle), r * np.sin(angle)], axis=1)
    if kind != "ellipse":
        body = np.vstack([body, tips])
    c, s = np.cos(heading), np.sin(heading)
    return np.array(center) + body @ np.array([[c, s], [-s, c]])


def y_of(a, b, v_a, v_b):
    """(5.1) from all differences of boundary points: the directions in which some point of A meets one of B."""
    d = (b[:, None] - a[None]).reshape(-1, 2)
    middle = np.mean(d, axis=0)
    angles = np.arctan2(middle[0] * d[:, 1] - middle[1] * d[:, 0], d @ middle)
    psi, bisector = np.ptp(angles), 0.5 * (angles.min() + angles.max()) + np.arctan2(middle[1], middle[0])
    v = np.array(v_a) - np.array(v_b)
    assert v @ [np.cos(bisector), np.sin(bisector)] > 0
    return np.sin(np.arctan2(v[1], v[0]) - bisector) ** 2 - np.sin(psi / 2) ** 2


class Independent(unittest.TestCase):
    """y by brute force on boundary points, in this file alone."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        result = run("figures", "5.8", "5.12", "--quiet", "--out", cls.folder.name + "/out")
        assert result.returncode == 0, result.stderr

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def rows(self, scenario, t):
        with open("%s/out/runs/%s/bodies.csv" % (self.folder.name, scenario), newline="") as f:
            rows = [r for r in csv.DictReader(f) if abs(float(r["t [s]"]) - t) < 1e-9]
        return {r["body"]: {n: float(x) for n, x in r.items() if n != "body" and x} for r in rows}

    def y(self, scenario, t):
        bodies = self.rows(scenario, t)
        points, velocity = {}, {}
        for name in ("F1", "F2"):
            b = bodies[name]
            points[name] = boundary("conic" if "k" in b else "ellipse", (b["x [m]"], b["y [m]"]), b["azimuth [rad]"],
                                    b.get("k"))
            velocity[name] = (b["vx [m/s]"], b["vy [m/s]"])
        return y_of(points["F1"], points["F2"], velocity["F1"], velocity["F2"])

    def test_first_value(self):
        self.assertAlmostEqual(self.y("5.4.1", 0), claims()["5.4.1/y-0"]["ours_value"], delta=2e-6)
        self.assertAlmostEqual(self.y("5.4.2", 0), claims()["5.4.2/y-0"]["ours_value"], delta=2e-6)

    def test_out_of_the_cone(self):
        for scenario, printed in (("5.4.1", 0.80), ("5.4.2", 0.84)):
            self.assertLess(self.y(scenario, round(printed - 2 * STEP, 2)), 0)
            out = claims()[scenario + "/out-of-F2"]["ours_value"]
            after = round(np.ceil(out / STEP) * STEP, 2)
            self.assertGreater(self.y(scenario, after), 0)
            self.assertLess(self.y(scenario, round(after - STEP, 2)), 0)


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.open, self.pictures, self.links, self.headings = [], [], [], 0

    def handle_starttag(self, tag, attributes):
        if tag not in ("img", "meta", "link", "br"):
            self.open.append(tag)
        self.headings += tag == "h2"
        for name, value in attributes:
            if name == "src":
                self.pictures.append(value)
            if name == "href":
                self.links.append(value)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open)
        self.open.pop()


class Figures(unittest.TestCase):
    def test_files_and_report(self):
        with tempfile.TemporaryDirectory() as folder:
            result = run("figures", "5.6", "5.10", "6.9", "6.13", "6.14", "--out", folder + "/here")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("figure 5.6", result.stderr)
            files = set(os.listdir(folder + "/here"))
            for name in ("5.6", "5.10", "6.9", "6.13", "6.14"):
                stem = folder + "/here/fig-" + name
                with open(stem + ".png", "rb") as f:
                    self.assertTrue(f.read().startswith(b"\x89PNG"))
                with open(stem + ".pdf", "rb") as f:
                    pdf = f.read()
                self.assertTrue(pdf.startswith(b"%PDF"))
                self.assertNotIn(b"/Type3", pdf)
                with open(stem + ".csv", newline="") as f:
                    rows = list(csv.DictReader(f))
                self.assertGreater(len(rows), 50)
                self.assertTrue(all(np.isfinite([float(r["x"]), float(r["y"])]).all() for r in rows))
                with open(stem + ".json") as f:
                    origin = json.load(f)
                for field in ("command", "commit", "compiler", "processor", "version"):
                    self.assertTrue(origin["provenance"][field])
            self.assertEqual(set(os.listdir(folder)), {"here"})  # nothing half-written is left
            self.assertEqual(files & {"report.html", "claims.json", "runs"}, {"report.html", "claims.json", "runs"})
            with open(folder + "/here/report.html", encoding="utf-8") as f:
                text = f.read()
            page = Page()
            page.feed(text)
            page.close()
            self.assertEqual(page.open, [])
            self.assertEqual(len(page.pictures), 5)
            self.assertTrue(all(p.startswith("data:image/png;base64,") for p in page.pictures))
            self.assertTrue(all(link.startswith("#") for link in page.links))  # nothing is loaded
            for c in claims().values():
                self.assertIn(c["verdict"], text)
            self.assertEqual(page.headings, 1 + len(run("figures", "--list").stdout.splitlines()))


class BadInput(unittest.TestCase):
    def refused(self, *arguments):
        result = run(*arguments)
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertEqual(len(result.stderr.splitlines()), 1)
        return result.stderr

    def test_unknown_figure(self):
        self.assertIn('figures: got 5.99, must be among 5.6, 5.7', self.refused("figures", "5.99"))

    def test_folder_that_is_a_file(self):
        with tempfile.NamedTemporaryFile() as file:
            self.assertIn("--out", self.refused("figures", "5.8", "--out", file.name))
            self.assertIn("--out", self.refused("claims", "--quiet", "--out", file.name + "/below"))


if __name__ == "__main__":
    unittest.main()
