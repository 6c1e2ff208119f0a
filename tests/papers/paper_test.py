# SPDX-License-Identifier: BSD-3-Clause
"""Claims and figures of papers/dhal2022, by the command that makes them. Environment: VERICONE (the program)."""
import csv
import functools
import html
import html.parser
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
import yaml

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from printed_numbers import PRINTED  # noqa: E402

sys.path.append(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "support"))
from drawn import drawn  # noqa: E402

VERICONE = os.path.abspath(os.environ["VERICONE"])
VERDICTS = {"given", "consistent", "reproduced", "by the authors' code", "fitted", "not engaged",
            "not decided by what is printed", "differs", "source wrong"}
HOLDS = {"reproduced", "fitted", "by the authors' code", "consistent"}
KINDS = {"result", "by the authors' code", "the source's own arithmetic", "given"}
STEP = 0.01  # s, of 5.4
SOURCES = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Two thirds of the time are the cameras and trackers of chapter 4.
CHAPTERS = ("2", "3", "5", "6", "7", *drawn(["4"], 3))


def run(*arguments, folder=None):
    return subprocess.run([VERICONE, *arguments], capture_output=True, text=True, check=False, cwd=folder)


@functools.lru_cache
def claims(*of):
    """All, or of some sections. What is tested is how verdicts come about: 8 trials of each law do for the 1000 of 7.18."""
    with tempfile.TemporaryDirectory() as folder:
        paper = folder + "/dhal2022"
        shutil.copytree(os.path.join(SOURCES, "papers", "dhal2022"), paper)
        with open(paper + "/claims.yaml", encoding="utf-8") as f:
            text = f.read()
        assert text.count(" -N 1000}") == 1
        with open(paper + "/claims.yaml", "w", encoding="utf-8") as f:
            f.write(text.replace(" -N 1000}", " -N 8 --no-figures}"))
        result = run("claims", *of, "--paper", paper, "--json", "--quiet")
    assert result.returncode == 0, result.stderr
    return {c["id"]: c for c in json.loads(result.stdout)["claims"]}


@functools.lru_cache
def registry():
    """claims.yaml as it stands, with what entries take from templates."""
    with open(os.path.join(SOURCES, "papers", "dhal2022", "claims.yaml"), encoding="utf-8") as f:
        return yaml.safe_load(f)


class Claims(unittest.TestCase):
    def test_every_claim_has_a_verdict_a_note_and_a_figure(self):
        figures = {line.split("\t")[0] for line in run("figures", "--list").stdout.splitlines()}
        for c in claims(*CHAPTERS).values():
            with self.subTest(c["id"]):
                self.assertIn(c["verdict"], VERDICTS)
                for field in ("section", "what", "printed", "ours", "tolerance_reason", "note"):
                    self.assertTrue(c[field], field)
                self.assertTrue(set(c["figures"]) and set(c["figures"]) <= figures)
                self.assertIn(c["kind"], KINDS)

    def test_every_printed_number_is_there(self):
        for section, numbers in PRINTED.items():
            if section[0] not in CHAPTERS:
                continue
            for name, text in numbers:
                with self.subTest(section=section, name=name, text=text):
                    found = [c for c in claims(*CHAPTERS).values() if c["section"] == section and name in c["id"]
                             and text in c["printed"]]
                    self.assertTrue(found)

    def test_verdicts_follow_from_the_values(self):
        for c in claims(*CHAPTERS).values():
            if None in (c["printed_value"], c["ours_value"]) or c["kind"] == "given" or c["verdict"] == "not engaged":
                continue
            with self.subTest(c["id"]):
                off, most = c["ours_value"] - c["printed_value"], c["tolerance"] * (1 + 1e-9)
                within = off <= most and off >= (-1e-9 if c["tolerance_one_sided"] else -most)
                self.assertEqual(within, c["verdict"] in HOLDS)

    def test_given_values_are_those_printed(self):
        for c in claims(*CHAPTERS).values():
            if c["id"] not in ("6.3.1/engagements", "7.18/trials"):  # fewer here
                self.assertEqual(c["kind"] == "given", c["verdict"] == "given", c["id"])

    def test_what_was_chosen_to_agree_is_not_called_reproduced(self):
        groups = {}
        for c in claims(*CHAPTERS).values():
            with self.subTest(c["id"]):
                if c["verdict"] == "fitted":
                    self.assertTrue(c["fits"])
                if c["verdict"] == "reproduced":
                    self.assertEqual((c["kind"], c["fits"]), ("result", []))
                for fit in c["fits"]:
                    self.assertEqual(fit["free_numbers"], sum(fit["free"].values()))
                    groups.setdefault(fit["name"], []).append((c, fit))
        self.assertGreater(len(groups), 10)
        left_out = {name for name, members in groups.items() if members[0][1]["not_measured"]}
        if "4" in CHAPTERS:
            self.assertEqual((set(groups), left_out), (set(registry()["fits"]), set()))
        for name, members in groups.items():
            for _, fit in members if name not in left_out else ():  # those that fail count, too
                self.assertEqual((fit["of"], fit["not_measured"]), (len(members), 0), name)
                self.assertEqual(fit["explains"], sum(m["verdict"] in HOLDS for m, _ in members), name)
        self.assertTrue(any(c["verdict"] not in HOLDS for c, _ in groups["gains and speeds of 2.4"]))

    def test_what_measures_nothing_is_not_reproduced(self):
        for c in claims(*CHAPTERS).values():
            with self.subTest(c["id"]):
                if c["kind"] == "the source's own arithmetic":
                    self.assertFalse(c["measured_on"])
                    self.assertNotIn(c["verdict"], ("reproduced", "fitted", "differs"))
                if c["verdict"] in ("reproduced", "fitted", "by the authors' code"):
                    self.assertTrue(c["measured_on"])

    def test_nothing_rests_on_a_clock(self):
        """times.csv holds wall-clock times; no claim may read it."""
        with open(os.path.join(SOURCES, "papers", "dhal2022", "claims.yaml"), encoding="utf-8") as f:
            self.assertNotIn("times.csv", f.read())

    def test_what_was_chosen_lies_in_its_range(self):
        paths = 0
        for name, fit in registry()["fits"].items():
            for what, chosen in fit.items():
                if not isinstance(chosen, dict):
                    continue
                several = {k: v if isinstance(v, list) else [v] for k, v in chosen.items()}
                for file in several["in"]:
                    with open(os.path.join(SOURCES, "papers", "dhal2022", file), encoding="utf-8") as f:
                        fields = yaml.safe_load(f)
                    for path, low, high in zip(several["at"], several["from"], several["to"]):
                        node = fields
                        for word in path.split("."):
                            node = (next(n for n in node if n.get("name") == word) if isinstance(node, list) and not word.isdigit()
                                    else node[int(word)] if isinstance(node, list) else node[word])
                        with self.subTest(fit=name, chosen=what, file=file, path=path):
                            self.assertTrue(low <= node <= high, node)
                            paths += 1
        self.assertGreater(paths, 40)


class Shuffled(unittest.TestCase):
    """What is reproduced holds for any of the numbers that were chosen; what moves with them says so."""

    @staticmethod
    def shuffled(*words):
        result = run("claims", *words, "--json", "--quiet")
        assert result.returncode == 0, result.stderr
        return {c["id"]: c for c in json.loads(result.stdout)["claims"]}, json.loads(result.stdout)["draws"]

    def test_gains_and_sizes(self):
        found, draws = self.shuffled("2.1", "2.4", "5.4", "6.5", "--shuffle", "8")
        for name, c in found.items():
            with self.subTest(name):
                self.assertFalse(c["moved"] and not c["names_a_fit"], c)
                if c["verdict"] == "reproduced":
                    self.assertEqual(c["says"], "holds for any")
        for name in ("2.4/passes-one", "5.4.1/out-of-F2", "5.4.2/out-of-F2", "5.4.1/out-of-F3"):
            self.assertEqual(found[name]["says"], "fitted", name)
        for fit in draws.values():
            for values in fit.values():
                self.assertEqual(len(set(values)), 8)

    def test_seeds_of_noise(self):
        """Of seeds drawn as whole numbers each comes once."""
        found, draws = self.shuffled("7.2/avoids-D", "7.2/start", "--shuffle", "6", "--only", "7.2's noise", "--seed", "2")
        self.assertEqual(list(draws), ["7.2's noise.seed"])
        self.assertTrue(all(1 <= x <= 60 and x == int(x) for x in draws["7.2's noise.seed"]["seed"]))
        self.assertEqual(found["7.2/start"]["says"], "holds for any")


class Altered(unittest.TestCase):
    """The registry measures: a scenario that is altered changes what is said of it."""

    @staticmethod
    def claims_with(scenario, *changes, of):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(os.path.join(SOURCES, "papers", "dhal2022"), folder + "/dhal2022")
            path = "%s/dhal2022/scenarios/%s.yaml" % (folder, scenario)
            with open(path) as f:
                text = f.read()
            for pattern, new in changes:
                text, count = re.subn(pattern, new, text, count=1)
                assert count == 1, pattern
            with open(path, "w") as f:
                f.write(text)
            result = run("claims", *of, "--paper", folder + "/dhal2022", "--json", "--quiet")
            assert result.returncode == 0, result.stderr
            return {c["id"]: c for c in json.loads(result.stdout)["claims"]}

    def test_printed_values_and_gains(self):
        changed = self.claims_with("5.4.1", (r"speed: 20 ", "speed: 21 "), (r"gain: 3\.4", "gain: 8"), of=["5.4"])
        self.assertEqual(changed["5.4.1/5.4.1/F2-speed"]["verdict"], "differs")
        self.assertAlmostEqual(changed["5.4.1/5.4.1/F2-speed"]["ours_value"], 21)
        for name in ("5.4.1/y-0", "5.4.1/out-of-F2"):
            self.assertNotIn(changed[name]["verdict"], HOLDS, name)
        self.assertEqual(changed["5.4.2/out-of-F2"]["ours"], claims("5.4")["5.4.2/out-of-F2"]["ours"])

    def test_an_agent_that_never_steers_is_not_engaged(self):
        # F2 is 400 m aside: nothing is on a collision course.
        changed = self.claims_with("5.4.2", (r"position: \[45, 0\]", "position: [45, -400]"), of=["5.4.2"])
        self.assertEqual(changed["5.4.2/avoids-F2"]["verdict"], "not engaged")
        self.assertIn("avoided, proved", changed["5.4.2/avoids-F2"]["ours"])

    def test_a_run_that_touches_is_not_reproduced(self):
        # Too weak to get out of the way.
        changed = self.claims_with("5.4.2", (r"most: 15", "most: 0.01"), of=["5.4.2"])
        self.assertNotIn(changed["5.4.2/avoids-F2"]["verdict"], HOLDS)
        self.assertIn("touched, proved", changed["5.4.2/avoids-F2"]["ours"])

    def test_one_sided(self):
        self.assertTrue(claims("6.5/cooperative/clear-of-B1")["6.5/cooperative/clear-of-B1"]["tolerance_one_sided"])

    def test_what_is_asked_for(self):
        asked = claims("5.4.2", "7.2/start")
        self.assertEqual({c["section"] for c in asked.values()}, {"5.4.2", "7.2"})
        self.assertEqual(asked["5.4.2/out-of-F2"]["fits"][0]["not_measured"], 9)
        refused = run("claims", "5.4.9", "--quiet")
        self.assertEqual((refused.returncode, refused.stdout, len(refused.stderr.splitlines())), (2, "", 1))
        self.assertIn("claims: got 5.4.9, must be a claim or a section of ", refused.stderr)


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


def cone_of(a, b, v_a, v_b):
    """(5.1) from all differences of boundary points: the directions in which some point of A meets one of B. y, psi, and
    V_r_hat = -v cos: v is that of A relative to B."""
    d = (b[:, None] - a[None]).reshape(-1, 2)
    middle = np.mean(d, axis=0)
    angles = np.arctan2(middle[0] * d[:, 1] - middle[1] * d[:, 0], d @ middle)
    psi, bisector = np.ptp(angles), 0.5 * (angles.min() + angles.max()) + np.arctan2(middle[1], middle[0])
    v = np.array(v_a) - np.array(v_b)
    y = np.sin(np.arctan2(v[1], v[0]) - bisector) ** 2 - np.sin(psi / 2) ** 2
    return y, psi, -v @ [np.cos(bisector), np.sin(bisector)]


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

    def cone(self, scenario, t, obstacle="F2"):
        bodies = self.rows(scenario, t)
        points, velocity = {}, {}
        for name in ("F1", obstacle):
            b = bodies[name]
            points[name] = boundary("conic" if "k" in b else "ellipse", (b["x [m]"], b["y [m]"]), b["azimuth [rad]"],
                                    b.get("k"))
            velocity[name] = (b["vx [m/s]"], b["vy [m/s]"])
        return cone_of(points["F1"], points[obstacle], velocity["F1"], velocity[obstacle])

    def test_first_value(self):
        for scenario in ("5.4.1", "5.4.2"):
            y, _, v_r_hat = self.cone(scenario, 0)
            self.assertLess(v_r_hat, 0)
            self.assertAlmostEqual(y, claims("5.4")[scenario + "/y-0"]["ours_value"], delta=2e-6)

    def test_out_of_the_cone(self):
        """Ours is the first sample with y > 0."""
        for scenario in ("5.4.1", "5.4.2"):
            out = claims("5.4")[scenario + "/out-of-F2"]["ours_value"]
            self.assertGreater(self.cone(scenario, out)[0], 0)
            self.assertLess(self.cone(scenario, 0.4)[0], 0)
            self.assertLess(self.cone(scenario, round(out - STEP, 2))[0], 0)

    def test_passing(self):
        """Ours is the first sample with V_r_hat >= 0; nothing else is asked of it."""
        for obstacle in ("F2", "F3"):
            past = claims("5.4")["5.4.1/passes-" + obstacle]["ours_value"]
            if past is None:  # they met before
                self.assertIn("touched", claims("5.4")["5.4.1/avoids-" + obstacle]["ours"])
                continue
            self.assertGreaterEqual(self.cone("5.4.1", past, obstacle)[2], 0)
            self.assertLess(self.cone("5.4.1", round(past - STEP, 2), obstacle)[2], 0)

    def test_when_the_second_obstacle_appears(self):
        y, psi, _ = self.cone("5.4.1", 2.13, "F3")
        self.assertAlmostEqual(y, claims("5.4")["5.4.1/y-2.13"]["ours_value"], delta=2e-5)
        self.assertAlmostEqual(np.degrees(psi), claims("5.4")["5.4.1/psi-2.13"]["ours_value"], delta=2e-3)


def equations():
    return claims("2.6", "2.3.3", "3.3.1", "3.4/V_r", "3.6", "4.2", "4.3/dimension", "5.2", "6.1", "6.2", "7.1", "7.3")


class Equations(unittest.TestCase):
    """Numbers of the claims on misprints, from formulas of this file."""

    def test_corrected_is_what_happens(self):
        """As printed, by the motion, and corrected: the last two agree, the first does not."""
        found = 0
        for c in equations().values():
            number = r"(-?[\d.]+(?:e-?\d+)?)"
            moved = re.match(number + r", by the motion itself; " + number + " corrected", c["ours"])
            if not moved:
                continue
            with self.subTest(c["id"]):
                found += 1
                moved, corrected = float(moved.group(1)), float(moved.group(2))
                printed = float(re.match(number, c["printed"]).group(1))
                self.assertEqual(c["verdict"], "source wrong")
                self.assertAlmostEqual(moved, corrected, delta=2e-3 * max(abs(moved), abs(printed - moved)))
                self.assertGreater(abs(printed - moved), 5 * abs(corrected - moved))
        self.assertGreaterEqual(found, 15)

    def number(self, claim, pattern):
        found = re.search(pattern, equations()[claim]["ours"])
        self.assertTrue(found, equations()[claim]["ours"])
        return float(found.group(1))

    def test_foci(self):
        a, b, k = 6, 2, 0.9
        self.assertAlmostEqual(self.number("5.5/confocal", r"at ([\d.]+) m \(ellipse"),
                               np.sqrt((1 + k) * (a * a - b * b)), delta=5e-4)
        self.assertAlmostEqual(self.number("5.5/confocal", r"and ([\d.]+) m \(hyperbola"),
                               np.sqrt((1 - k) * (a * a + b * b)), delta=5e-4)

    def test_row_of_v_phi(self):
        """V_phi = r phi' of straight motions, by differences."""
        elevation = np.radians(69)
        start, v = np.array([-10.0, 0, 20]), np.array([5, 0, 0]) - 8.5 * np.array([np.cos(elevation), 0, np.sin(elevation)])

        def v_phi(t, h=1e-4):
            r = [start + v * (t + s) for s in (-h, 0, h)]
            phi = [np.arctan2(x[2], np.hypot(x[0], x[1])) for x in r]
            return np.linalg.norm(r[1]) * (phi[2] - phi[0]) / (2 * h)
        row = (v_phi(1e-3) - v_phi(-1e-3)) / 2e-3
        self.assertAlmostEqual(self.number("6.10/V_phi", r"^(-?[\d.]+) m/s"), row, delta=1e-3)

    def test_signs_of_determinants(self):
        for name, signs in (("ellipsoid", (1, 1, 1)), ("one-sheeted", (1, 1, -1)), ("two-sheeted", (1, -1, -1))):
            self.assertEqual(self.number("6.1/det", name + r" (-?\d+)"), round(np.linalg.det(np.diag(signs + (-1,)))))


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.open, self.pictures, self.links, self.headings, self.viewport = [], [], [], 0, ""
        self.scrolling, self.bare_tables = [], 0

    def handle_starttag(self, tag, attributes):
        if tag not in ("img", "meta", "link", "br"):
            self.open.append(tag)
        self.headings += tag == "h2"
        if tag == "div":
            self.scrolling.append(("class", "scroll") in attributes)
        self.bare_tables += tag == "table" and not any(self.scrolling)
        if tag == "meta" and ("name", "viewport") in attributes:
            self.viewport = dict(attributes)["content"]
        for name, value in attributes:
            if name == "src":
                self.pictures.append(value)
            if name == "href":
                self.links.append(value)

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, (tag, self.open)
        self.open.pop()
        if tag == "div":
            self.scrolling.pop()


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
            # A narrow screen: tables scroll by themselves, links wrap.
            self.assertEqual(page.bare_tables, 0)
            self.assertIn("width=device-width", page.viewport)
            self.assertRegex(text, r"nav \{[^}]*flex-wrap: wrap")
            self.assertRegex(text, r"\.scroll \{[^}]*overflow-x: auto")
            self.assertTrue(all(p.startswith("data:image/png;base64,") for p in page.pictures))
            self.assertTrue(all(link.startswith("#") for link in page.links))  # nothing is loaded
            with open(folder + "/here/claims.json", encoding="utf-8") as f:
                shown = json.load(f)["claims"]
            # Those of the figures that are there, and no others.
            self.assertGreater(len(shown), 30)
            for c in shown:
                self.assertTrue({"5.6", "5.10", "6.9", "6.13", "6.14"} & set(c["figures"]), c["id"])
                self.assertIn(html.escape(c["verdict"]), text)
                for words in c["measured_on"]:  # as the report's first sentence says
                    self.assertIn(html.escape(words), text)
            self.assertEqual(page.headings, 2 + len(run("figures", "--list").stdout.splitlines()))


class Changed(unittest.TestCase):
    """Figures of other inputs say so."""
    def test_a_value_and_a_file(self):
        scenario = os.path.join(SOURCES, "papers", "dhal2022", "scenarios", "5.4.1.yaml")
        with tempfile.TemporaryDirectory() as folder:
            other = os.path.join(folder, "mine.yaml")
            with open(scenario, encoding="utf-8") as f:
                text = f.read()
            with open(other, "w", encoding="utf-8") as f:
                f.write(text.replace("speed: 18.8", "speed: 18.3"))
            out = os.path.join(folder, "out")
            result = run("figures", "5.6", "--scenario", other, "--set", "bodies.F1.pilot.gain=8",
                         "--set", "bodies.0.pilot.goal.point=[80, 90]", "--out", out, "--quiet")
            self.assertEqual(result.returncode, 0, result.stderr)
            with open(os.path.join(out, "fig-5.6.json"), encoding="utf-8") as f:
                changed = json.load(f)["changed"]
            self.assertEqual(changed, {"scenarios": ["5.4.1"], "file": other, "set": {
                "bodies.F1.pilot.gain": "8", "bodies.0.pilot.goal.point": "[80, 90]"}})
            with open(os.path.join(out, "runs", "5.4.1", "scenario.yaml"), encoding="utf-8") as f:
                flown = json.load(f)  # what was flown, as JSON
            self.assertEqual((flown["bodies"][0]["pilot"]["gain"], flown["bodies"][2]["speed"]), (8, 18.3))
            self.assertEqual(flown["bodies"][0]["pilot"]["goal"]["point"], [80, 90])
            with open(os.path.join(out, "report.html"), encoding="utf-8") as f:
                self.assertIn("Changed inputs", f.read())

    def test_what_is_not_there(self):
        with tempfile.TemporaryDirectory() as folder:
            for arguments, message in (
                    (("--set", "gain"), "--set: got gain, must be PATH=VALUE"),
                    (("--set", "bodies.F9.pilot.gain=1"), "there is no bodies.F9"),
                    (("--set", "bodies.F1.pilot.gian=1"), "bodies[0].pilot.gian: got an unknown field"),
                    (("laws-5.4.1", "--scenario", "x.yaml"), "for figures of one scenario; these show 5.4.1, 5.4.1-clearance"),
                    (("--scenario", folder + "/no.yaml"), "no such file")):
                result = run("figures", "5.6", *arguments, "--out", folder + "/out", "--quiet")
                self.assertEqual(result.returncode, 2, arguments)
                self.assertIn(message, result.stderr)
                self.assertEqual(os.listdir(folder), [])


class BadInput(unittest.TestCase):
    def refused(self, *arguments):
        result = run(*arguments)
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertEqual(len(result.stderr.splitlines()), 1)
        return result.stderr

    def test_unknown_figure(self):
        self.assertIn('figures: got 5.99, must be among 2.2, 2.3', self.refused("figures", "5.99"))

    def test_folder_that_is_a_file(self):
        with tempfile.NamedTemporaryFile() as file:
            self.assertIn("--out", self.refused("figures", "5.8", "--out", file.name))
            self.assertIn("--out", self.refused("claims", "--quiet", "--out", file.name + "/below"))


if __name__ == "__main__":
    unittest.main()
