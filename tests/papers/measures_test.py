# SPDX-License-Identifier: BSD-3-Clause
"""Every form of a value against a number computed by hand or read from the run's tables by numpy; every verdict; what is
refused. Environment: VERICONE (the program)."""
import csv
import json
import os
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

VERICONE = os.path.abspath(os.environ["VERICONE"])
SOURCES = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
OURS = sorted(p for p in os.listdir(os.path.join(SOURCES, "papers")))


def run(*arguments, folder=None):
    return subprocess.run([VERICONE, *arguments], capture_output=True, text=True, check=False, cwd=folder)


class Copied(unittest.TestCase):
    """A new paper in a folder of its own."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = os.path.join(self.temporary.name, "mine")
        made = run("paper", "new", self.folder)
        self.assertEqual(made.returncode, 0, made.stderr)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as f:
            f.write(text)

    def text(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as f:
            return f.read()

    def claims(self):
        result = run("claims", "--paper", self.folder, "--json", "--quiet")
        self.assertEqual(result.returncode, 0, result.stderr)
        return {c["id"]: c for c in json.loads(result.stdout)["claims"]}

    def measured(self, values, templates=None):
        """Numbers by name; None where there is none."""
        claims = [{"id": name, "section": "1", "figures": ["1"], "what": name, "printed": "0", "ours": name,
                   "tolerance": {"value": 1, "reason": "none"}, "note": "none"} for name in values]
        self.write("claims.yaml", json.dumps({"templates": templates or {}, "values": values, "claims": claims}))
        return {name: c["ours_value"] for name, c in self.claims().items()}


class Values(Copied):
    def setUp(self):
        super().setUp()
        out = os.path.join(self.temporary.name, "run")
        done = run("simulate", os.path.join(self.folder, "scenarios/two-circles.yaml"), "--no-figures", "--quiet", "--out", out)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.tables = {}
        for name in ("bodies", "encounters", "events"):
            with open(os.path.join(out, name + ".csv"), newline="", encoding="utf-8") as f:
                self.tables[name] = [{n.split(" [")[0]: x for n, x in row.items()} for row in csv.DictReader(f)]
        with open(os.path.join(out, "proof.json"), encoding="utf-8") as f:
            self.proof = json.load(f)["pairs"][0]

    def column(self, table, name, **words):
        return np.array([float(r[name] or "nan") for r in self.tables[table] if all(r[c] == w for c, w in words.items())])

    def test_what_is_taken_from_rows(self):
        bodies = {"run": "two-circles", "table": "bodies", "body": "A"}
        got = self.measured({
            "first": dict(bodies, first="x"), "last": dict(bodies, last="x"), "least": dict(bodies, least="lateral"),
            "greatest": dict(bodies, greatest="hypot(vx, vy)"), "mean": dict(bodies, mean="y"), "sum": dict(bodies, sum="a"),
            "count": dict(bodies, count="a > 0"), "where": dict(bodies, first="y", where="t >= 1 - 1e-9"),
            "step": dict(bodies, greatest="t - t_before"), "with": {**bodies, "with": {"square": "x^2", "more": "square + y^2"}, "last": "sqrt(more)"},
            "none": dict(bodies, first="x", where="t > 100"), "no_row": dict(bodies, count="1", where="t > 100")})
        x, y, t, a = (self.column("bodies", n, body="A") for n in ("x", "y", "t", "a"))
        lateral, vx, vy = (self.column("bodies", n, body="A") for n in ("lateral", "vx", "vy"))
        right = {"first": x[0], "last": x[-1], "least": lateral.min(), "greatest": np.hypot(vx, vy).max(), "mean": y.mean(),
                 "sum": a.sum(), "count": (a > 0).sum(), "where": y[np.argmin(np.abs(t - 1))], "step": np.diff(t).max(),
                 "with": np.hypot(x[-1], y[-1])}
        self.assertLess(lateral.min(), -0.1)  # it did steer
        for name, value in right.items():
            self.assertAlmostEqual(got[name], value, delta=1e-9 * max(1, abs(value)), msg=name)
        self.assertIsNone(got["none"])
        self.assertEqual(got["no_row"], 0)

    def test_tables_beside_each_other(self):
        """The distance of the centres, from two bodies, is the r of the encounter."""
        got = self.measured({
            "apart": {"run": "two-circles", "table": "bodies", "body": "A", "beside": {"b": {"run": "two-circles", "table": "bodies", "body": "B"}},
                      "least": "hypot(b.x - x, b.y - y)"},
            "r": {"run": "two-circles", "table": "encounters", "agent": "A", "obstacle": "B", "least": "r"},
            "off": {"run": "two-circles", "table": "looks", "agent": "A", "obstacle": "B",
                    "beside": {"e": {"run": "two-circles", "table": "encounters"}}, "greatest": "abs(r - e.r)"}})
        a, b = (np.stack([self.column("bodies", n, body=name) for n in "xy"]) for name in "AB")
        self.assertAlmostEqual(got["apart"], np.hypot(*(b - a)).min(), delta=1e-9)
        self.assertAlmostEqual(got["r"], got["apart"], delta=1e-9)
        self.assertLess(got["off"], 1e-9)

    def test_looks_are_the_cone_of_two_circles(self):
        """In closed form: sin(psi/2) = R/r, y = V_theta^2/V^2 - R^2/r^2, from the positions that numpy reads."""
        look = {"run": "two-circles", "table": "looks", "agent": "A", "obstacle": "B", "where": "t > 1.5 - 1e-9"}
        got = self.measured({n: dict(look, first=n) for n in ("t", "r", "y", "psi", "theta", "theta_b", "V_r", "V_theta", "V_r_hat")})
        t = self.column("bodies", "t", body="A")
        i = int(np.argmin(np.abs(t - 1.5)))
        at = {name: [self.column("bodies", n, body=name)[i] for n in ("x", "y", "vx", "vy")] for name in "AB"}
        d, v = np.subtract(at["B"][:2], at["A"][:2]), np.subtract(at["B"][2:], at["A"][2:])
        r, u = np.hypot(*d), d / np.hypot(*d)
        v_r, v_theta = v @ u, u[0] * v[1] - u[1] * v[0]
        right = {"t": 1.5, "r": r, "psi": 2 * np.arcsin(3 / r), "y": v_theta ** 2 / (v @ v) - 9 / r ** 2, "V_r": v_r,
                 "V_theta": v_theta, "theta": np.arctan2(d[1], d[0]), "theta_b": 0, "V_r_hat": v_r}
        for name, value in right.items():
            self.assertAlmostEqual(got[name], value, delta=1e-9, msg=name)

    def test_events_proofs_and_courses(self):
        pair = {"run": "two-circles", "agent": "A", "obstacle": "B"}
        got = self.measured({
            "passes": dict(pair, table="events", event="passes", first="t"), "passed": dict(pair, table="encounters", first="passed"),
            "avoided": dict(pair, table="proofs", first="avoided"), "least": dict(pair, table="proofs", first="least_distance"),
            "turned": {"run": "two-circles", "agent": "B", "obstacle": "A", "table": "proofs", "first": "least_time"},
            "on": dict(pair, course=0), "off": dict(pair, course="2 + 2")})
        passes = [float(e["t"]) for e in self.tables["events"] if e["event"] == "passes"][0]
        self.assertEqual((got["passes"], got["passed"]), (passes, passes))
        self.assertEqual((got["avoided"], self.proof["verdict"]), (1, "avoided"))
        self.assertEqual((got["least"], got["turned"]), (self.proof["least_distance"], self.proof["least_time"]))
        self.assertEqual((got["on"], got["off"]), (1, 0))  # straight at it at first, 20 m ahead; out of the cone later

    def test_fields_commands_and_formulas(self):
        scene = "agent: {center: [0, 0], semi_axes: [1, 1]}\nobstacle: {center: [10, 0], semi_axes: [1, 1]}\n"
        self.write("pair.yaml", scene)
        got = self.measured({
            "gain": {"run": "two-circles", "field": "bodies.A.pilot.gain"},
            "either": {"run": "two-circles", "field": ["bodies.A.shape.a_c", "bodies.0.shape.semi_axes.1"]},
            "length": {"run": "two-circles", "length": "bodies"}, "absent": {"run": "two-circles", "field": "bodies.A.nothing"},
            "psi": {"command": "cone pair.yaml", "field": "psi"},
            "rows": {"command": "accuracy --engagements 7 --planes 3 12 --no-figures", "table": "engagements.csv", "count": "exact_area > 0"},
            "formula": "degrees(atan2(1, 1)) + radians(180) / pi + hypot(3, 4) + trunc(-1.7) + ln(exp(2))",
            "choice": "known(absent) ? 1 : !0 && 2 < 3", "gap": "nothing + 1", "of_others": "2 * gain"})
        self.assertEqual((got["gain"], got["either"], got["length"], got["of_others"], got["rows"]), (3, 1, 2, 6, 7))
        self.assertAlmostEqual(got["psi"], 2 * np.arcsin(0.2), delta=1e-12)
        self.assertAlmostEqual(got["formula"], 45 + 1 + 5 - 1 + 2, delta=1e-12)
        self.assertEqual((got["choice"], got["gap"], got["absent"]), (1, None, None))

    def test_trials(self):
        """Without a command the circles meet at 3 m between their centres: 20 - 5 t and 1 m aside. With one they do not."""
        trial = {"run": "two-circles", "agent": "A", "obstacle": "B",
                 "trial": {"until": 6, "sets": [{"c": 0}, {"c": -5}], "with": {"double": "2 * c"}, "command": "double / 2"}}
        got = self.measured({"touched": dict(trial, count="touched"), "met": dict(trial, first="to"),
                             "which": dict(trial, first="c", where="avoided")})
        self.assertEqual((got["touched"], got["which"]), (1, -5))
        self.assertAlmostEqual(got["met"], (20 - np.sqrt(8)) / 5, delta=1e-4)

    def test_ascents(self):
        """A step takes 25 products a point, the first look 24; counted on three boxes, and on ten times as many."""
        some = {"ascent": {"boxes": [3, 30], "draws": 4, "tolerance": 0.01}}
        got = self.measured({"rows": dict(some, count="points == 4 * boxes"), "ratio": dict(some, greatest="ratio"),
                             "least": dict(some, least="ratio"),
                             "products": dict(some, count="products == points * (25 * steps + 24)"), "steps": dict(some, greatest="steps"),
                             "coarse": {"ascent": {"boxes": [3], "tolerance": 0.1}, "greatest": "steps"}})
        self.assertEqual((got["rows"], got["products"]), (8, 8))
        self.assertLessEqual(got["ratio"], 1.01)
        self.assertGreater(got["least"], 1)
        self.assertTrue(10 < got["coarse"] < got["steps"] / 5, got)

    def test_templates(self):
        got = self.measured({"one": {"like": ["of A", "early"], "last": "t"}, "own": {"like": "of A", "body": "B", "first": "x"}},
                            {"of A": {"run": "two-circles", "table": "bodies", "body": "A"}, "early": {"where": "t < 1.005"}})
        self.assertAlmostEqual(got["one"], 1, delta=1e-9)
        self.assertEqual(got["own"], 20)


class Verdicts(Copied):
    def verdict(self, measured=True, **fields):
        """Of a claim whose numbers rest on a run, or on nothing."""
        claim = {"id": "x", "section": "1", "figures": ["1"], "what": "x", "note": "none",
                 "values": {"zero": {"run": "two-circles", "table": "bodies", "body": "A", "first": "0 * x"}}, **fields}
        for field in ("ours", "holds"):
            if measured and field in claim and not isinstance(claim[field], list):
                claim[field] = "(%s) + zero" % claim[field]
        self.write("claims.yaml", json.dumps({"fits": {"f": {"a": 2, "b": 1}, "g": {"c": 1}}, "claims": [claim]}))
        return self.claims()["x"]

    def test_numbers(self):
        for printed, ours, verdict in (("0.80", 0.8049, "reproduced"), ("0.80", 0.8051, "differs"), ("0.8", 0.8499, "reproduced"),
                                       ("after -4.70", -4.7049, "reproduced"), ("11", 11.6, "differs")):
            claim = self.verdict(printed=printed, ours=ours)
            self.assertEqual((claim["verdict"], claim["kind"], claim["measured_on"]), (verdict, "result", ["run two-circles"]), (printed, ours))
        self.assertEqual(self.verdict(printed="1", ours=2, otherwise="not decided")["verdict"], "not decided by what is printed")
        self.assertEqual(self.verdict(printed="1", ours="nothing")["ours"], "does not happen")

    def test_what_was_chosen_counts_met_or_not(self):
        claim = self.verdict(printed="1", ours=1, fit="f")
        self.assertEqual((claim["verdict"], claim["fits"][0]["free_numbers"], claim["fits"][0]["explains"], claim["fits"][0]["of"]),
                         ("fitted", 3, 1, 1))
        claim = self.verdict(printed="1", ours=2, fit=["f", "g"], otherwise="not decided")
        self.assertEqual([(f["name"], f["explains"], f["of"]) for f in claim["fits"]], [("f", 0, 1), ("g", 0, 1)])

    def test_what_could_not_have_failed(self):
        """Nothing of ours is in it: the source's own arithmetic, whatever is said of it."""
        for ours, verdict in ((46.71, "consistent"), (47, "source wrong")):
            claim = self.verdict(measured=False, printed="46.7", ours=ours, otherwise="source wrong")
            self.assertEqual((claim["verdict"], claim["kind"], claim["measured_on"]), (verdict, "the source's own arithmetic", []))

    def test_values_of_the_authors_code(self):
        claim = self.verdict(printed="1", ours=1, code=True)
        self.assertEqual((claim["verdict"], claim["kind"]), ("by the authors' code",) * 2)

    def test_tolerances(self):
        late = {"value": "2 * half_digit", "reason": "late by {half_digit}", "one_sided": True}
        for ours, verdict in ((5.59, "reproduced"), (5.49, "differs"), (5.61, "differs")):
            claim = self.verdict(printed="5.5", ours=ours, tolerance=late)
            self.assertEqual((claim["verdict"], claim["tolerance_reason"]), (verdict, "late by 0.05"))

    def test_statements_and_texts(self):
        text = ["{3 * 0.333333:2}", {"if": "1 < 2", "text": ", so"}, {"if": "1 > 2", "text": ", not so"}, ", gone {nothing}"]
        for fields, verdict in (({"holds": "1"}, "reproduced"), ({"holds": "0"}, "differs"), ({"holds": "nothing"}, "differs"),
                                ({"holds": "0", "otherwise": "source wrong"}, "source wrong"),
                                ({"holds": "1", "engaged": "0"}, "not engaged"), ({"holds": "1", "given": True}, "given")):
            claim = self.verdict(printed="so", text=text, **fields)
            self.assertEqual((claim["verdict"], claim["ours"]), (verdict, "1, so"), fields)

    def test_given_numbers(self):
        for ours, verdict in ((["1 + 1e-13", 2], "given"), (["1 + 1e-9", 2], "differs")):
            claim = self.verdict(printed=[1, 2], unit="m", ours=ours, given=True)
            self.assertEqual((claim["verdict"], claim["printed"]), (verdict, "(1, 2) m"))


class Draws(Copied):
    """A gain between 1 and 8 and a place of B, of claims that rest on both, on one, on none, and do not say so."""

    FITS = {"gain": {"K": {"in": "scenarios/two-circles.yaml", "at": "bodies.A.pilot.gain", "from": 1, "to": 8}},
            "place": {"x and y": {"in": ["scenarios/two-circles.yaml"], "at": ["bodies.B.position.0", "bodies.B.position.1"],
                                  "from": [19, 0.5], "to": [30, 1.5]}},
            "whole": {"n": {"in": "scenarios/two-circles.yaml", "at": "bodies.A.speed", "from": 3, "to": 6, "whole": True}}}

    def said(self, claims, *words, fits=None):
        values = {"gain": {"run": "two-circles", "field": "bodies.A.pilot.gain"},
                  "far": {"run": "two-circles", "table": "looks", "agent": "A", "obstacle": "B", "first": "r"},
                  "speed": {"run": "two-circles", "table": "bodies", "body": "A", "first": "speed"}}
        list_ = [{"id": name, "section": "1", "figures": ["1"], "what": name, "note": "none", "printed": "so", **fields}
                 for name, fields in claims.items()]
        self.write("claims.yaml", json.dumps({"fits": fits or self.FITS, "values": values, "claims": list_}))
        result = run("claims", "--paper", self.folder, "--json", "--quiet", *words)
        self.assertEqual(result.returncode, 0, result.stderr)
        answer = json.loads(result.stdout)
        return {c["id"]: c for c in answer["claims"]}, answer["draws"]

    def test_what_holds_throughout_and_at_one_place(self):
        said, draws = self.said({
            "any": {"holds": "far > 10", "fit": "place"}, "one": {"holds": "abs(gain - 3) < 0.1", "fit": "gain"},
            "some": {"holds": "gain > 4", "fit": "gain"}, "none": {"holds": "gain > 9", "fit": "gain"},
            "unnamed": {"holds": "gain < 3.5"}, "still": {"holds": "far > 1"}, "sum": {"holds": "2 > 1"},
            "number": {"printed": "3.0", "ours": "gain", "fit": "gain"}}, "--shuffle", "14")
        self.assertEqual({name: c["says"] for name, c in said.items()},
                         {"any": "holds for any", "one": "fitted", "some": "not met as chosen", "none": "holds for none", "unnamed": "fitted",
                          "still": "holds for any", "number": "fitted"})  # arithmetic is not shuffled
        self.assertEqual([n for n, c in said.items() if c["moved"] and not c["names_a_fit"]], ["unnamed"])
        # One in each of 14 equal parts of the range.
        gains = sorted(draws["gain.K"]["bodies.A.pilot.gain"])
        self.assertEqual([int((x - 1) / 0.5) for x in gains], list(range(14)))
        self.assertEqual((said["some"]["agrees"], said["number"]["least"], said["number"]["greatest"]),
                         (sum(x > 4 for x in gains), gains[0], gains[-1]))
        self.assertEqual(set(draws), {"gain.K", "place.x and y", "whole.n"})
        self.assertEqual(len(draws["place.x and y"]), 2)

    def test_one_fit_alone_and_whole_numbers(self):
        said, draws = self.said({"n": {"printed": "4", "ours": "speed", "fit": "whole"}, "gain": {"holds": "gain == 3", "fit": "gain"}},
                                "--shuffle", "4", "--only", "whole")
        self.assertEqual(sorted(draws["whole.n"]["bodies.A.speed"]), [3, 4, 5, 6])
        self.assertEqual((said["gain"]["says"], said["n"]["agrees"]), ("holds for any", 1))

    def test_the_same_seed_draws_the_same(self):
        claims = {"n": {"printed": "3", "ours": "gain", "fit": "gain"}}
        first, again, other = (self.said(claims, "--shuffle", "3", "--seed", s)[1] for s in ("5", "5", "6"))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)

    def test_refused(self):
        claim = {"n": {"printed": "3", "ours": "gain", "fit": "f"}}
        here = {"in": "scenarios/two-circles.yaml", "at": "bodies.A.pilot.gain", "from": 1, "to": 8}
        for change, message in (({"to": 1}, "fits.f.K.to: got 1, must be above from"), ({"at": []}, "fits.f.K.at: got 0 paths"),
                                ({"from": [1, 2]}, "fits.f.K.at: got 1 paths, must be as many as from and to have numbers"),
                                ({"at": "bodies.A.pilot.gian"}, "fits.f.K.at: got bodies.A.pilot.gian, must be the path of a number in scenarios"),
                                ({"in": "scenarios/no.yaml"}, "fits.f.K.in: got scenarios/no.yaml, must be a file in "),
                                ({"from": -1, "logarithmic": True}, "fits.f.K.to: got 8, must be above from, both positive")):
            with self.assertRaises(AssertionError) as refused:
                self.said(claim, "--shuffle", "2", fits={"f": {"K": {**here, **change}}})
            self.assertIn(message, str(refused.exception))
        for words, message in ((("--only", "g"), "--only: got g, must be the name of one of fits"), (("--out", "o"), "--out: got o, must be left out")):
            with self.assertRaises(AssertionError) as refused:
                self.said(claim, "--shuffle", "2", *words, fits={"f": {"K": here}})
            self.assertIn(message, str(refused.exception))


class Refused(Copied):
    """Bad input of both files: one line that names the file, the field, the value and what would be right."""

    def test_one_line(self):
        cases = (
            ("claims.yaml", "ours: first_y ", "ours: first_z ", "claims.yaml: claims[1].ours: got first_z, must be a name of values"),
            ("claims.yaml", "ours: first_y ", "ours: 2 + ", "claims.yaml: claims[1].ours: got \"2 +\", must be a formula: "),
            ("claims.yaml", 'printed: "-0.0200"', "printed: -0.0200", "claims.yaml: claims[1].printed: got -0.02, must be what the source prints, as text, in quotes"),
            ("claims.yaml", 'printed: "-0.0200"', 'printed: "none"', 'claims[1].printed: got "none", must be text with one number, as printed'),
            ("claims.yaml", "first: y}", "second: y}", "claims[1].values.first_y.second: got an unknown field, must be one of run, "),
            ("claims.yaml", "table: looks, first: y}", "table: views, first: y}", "claims[1].values.first_y.table: got views, must be bodies, "),
            ("claims.yaml", "first: y}", "first: z}", "claims[1].values.first_y.first: got z, must be a name of values or a column"),
            ("claims.yaml", "run: two-circles, agent", "run: three-circles, agent", "run: got three-circles, must be a scenario: there is no scenarios/three-circles.yaml"),
            ("claims.yaml", "obstacle: B}", "obstacle: C}", "obstacle: got C, must be a body of the scenario two-circles: A, B"),
            ("claims.yaml", "like: A and B\n    id: y-0", "like: B and A\n    id: y-0", "claims[1].like: got B and A, must be the name of one of templates"),
            ("claims.yaml", "otherwise: not decided", "otherwise: undecided", 'claims[2].otherwise: got "undecided", must be one of differs, not decided, source wrong'),
            ("claims.yaml", "    id: out", "    id: y-0", "claims[2].id: got y-0, must be a name of the claim's own: another claim has it"),
            ("claims.yaml", 'figures: ["2"]', 'figures: ["9"]', "claims.yaml: y-0.figures: got 9, must be the id of a figure of figures.yaml"),
            ("claims.yaml", "never nearer than {least:3}", "never nearer than {least:3", "claims[3].text[0]: got "),
            ("claims.yaml", "first_y: {table: looks, first: y}", "first_y: first_y + 1", "claims[1].values.first_y: got first_y, must be a value that does not rest on itself"),
            ("claims.yaml", "speed: 4,", "speed: four,", 'claims[0].printed[0]: got "four", must be a finite number'),
            ("figures.yaml", 'id: "1"', "id: 5.10", "figures.yaml: figures[0].id: got 5.1, must be the figure's number or name, in quotes"),
            ("figures.yaml", "drawing: plane_trajectory", "script: plane.py", "figures[0].script: got plane.py, must be a file in the paper's folder"),
            ("figures.yaml", "drawing: plane_trajectory", "drawing: drawn", "figures.yaml: figures[0].drawing: got \"drawn\", must be one of plane_trajectory"),
            ("figures.yaml", "y: y, label", "y: yy, label", "figures.yaml: figures[1].panels[0].y: got yy, must be a name"),
            ("figures.yaml", 'label: "y [1]", ', "", "figures[1].panels[0].label: got nothing, must be what the axis shows"),
            ("figures.yaml", "runs: {shown: two-circles}     #", "runs: {shown: no}     #", "figures.yaml: runs: got no, must be a scenario"),
            ("figures.yaml", "title:", "titel:", "figures.yaml: titel: got an unknown field"),
        )
        for file, old, new, message in cases:
            with self.subTest(message):
                text = self.text(file)
                self.assertIn(old, text)
                self.write(file, text.replace(old, new))
                out = os.path.join(self.temporary.name, "out")
                result = run("claims", "--paper", self.folder, "--quiet")
                if result.returncode == 0:  # what only a picture needs
                    result = run("figures", "--paper", self.folder, "--quiet", "--out", out)
                self.write(file, text)
                self.assertEqual((result.returncode, result.stdout), (2, ""), result.stderr)
                self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)
                self.assertIn(message, result.stderr)
                shutil.rmtree(out, ignore_errors=True)

    def test_papers_that_are_not_there(self):
        for arguments in (("claims", "--paper", "nowhere"), ("figures", "--paper", self.temporary.name, "--list")):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn("--paper: got %s, must be a folder with figures.yaml and claims.yaml" % arguments[2], result.stderr)

    def test_nothing_is_overwritten(self):
        before = {name: self.text(name) for name in ("claims.yaml", "figures.yaml", "README.md")}
        result = run("paper", "new", self.folder)
        self.assertEqual((result.returncode, len(result.stderr.splitlines())), (2, 1))
        self.assertIn("must be a folder that is empty or not there", result.stderr)
        self.assertEqual(before, {name: self.text(name) for name in before})
        self.assertEqual(run("paper", "old", self.folder).returncode, 2)


class Whole(Copied):
    def made(self, paper, *more):
        out = os.path.join(self.temporary.name, "out")
        result = run("figures", "--paper", paper, "--quiet", "--out", out, *more)
        self.assertEqual(result.returncode, 0, result.stderr)
        return out

    def test_a_new_paper(self):
        out = self.made(self.folder)
        self.assertLessEqual({"fig-1.png", "fig-2.pdf", "fig-2.csv", "claims.json", "report.html", "runs"}, set(os.listdir(out)))
        with open(os.path.join(out, "fig-2.csv"), newline="", encoding="utf-8") as f:
            drawn = [(float(r["x"]), float(r["y"])) for r in csv.DictReader(f) if r["panel"] == "y [1]"]
        self.assertAlmostEqual(drawn[0][1], 1 / 401 - 9 / 401, delta=1e-12)
        self.assertGreater(len(drawn), 700)

    def test_the_paper_of_circles(self):
        out = self.made("chakravarthy1998")
        with open(os.path.join(out, "claims.json"), encoding="utf-8") as f:
            claims = json.load(f)["claims"]
        self.assertGreater(len(claims), 10)
        with open(os.path.join(out, "report.html"), encoding="utf-8") as f:
            page = f.read()
        for claim in claims:
            self.assertIn(claim["verdict"], page)
        self.assertEqual(page.count("data:image/png;base64,"), 4)

    def test_verdicts_of_the_circles_change_with_them(self):
        folder = os.path.join(self.temporary.name, "circles")
        shutil.copytree(os.path.join(SOURCES, "papers", "chakravarthy1998"), folder)

        def verdicts():
            result = run("claims", "--paper", folder, "--json", "--quiet")
            self.assertEqual(result.returncode, 0, result.stderr)
            return {c["id"]: c["verdict"] for c in json.loads(result.stdout)["claims"]}

        before = verdicts()
        for scenario, old, new, claim in (("miss", "position: [12, 7]", "position: [12, 4]", "miss"),
                                          ("hit", "position: [12, 2]", "position: [12, 8]", "hit"),
                                          ("grazing", "position: [12, 5]", "position: [12, 5.001]", "grazing"),
                                          ("avoid", "most: 6 ", "most: 0.01 ", "avoided")):
            path = os.path.join(folder, "scenarios", scenario + ".yaml")
            with open(path, encoding="utf-8") as f:
                text = f.read()
            self.assertIn(old, text)
            with open(path, "w", encoding="utf-8") as f:
                f.write(text.replace(old, new))
            self.assertEqual((before[claim], verdicts()[claim]), ("reproduced", "differs"), claim)
            with open(path, "w", encoding="utf-8") as f:
                f.write(text)

    def test_every_file_of_ours_says_what_it_means(self):
        for paper in OURS:
            for name in ("figures.yaml", "claims.yaml"):
                result = run("check", os.path.join(SOURCES, "papers", paper, name))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertGreater(len(result.stdout.splitlines()), 2)


if __name__ == "__main__":
    unittest.main()
