#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""checker/vericone_check.py: what it accepts is true, by decide.py; the false certificates that one can think of; damaged
ones; anything at all as a file. Environment: VERICONE_SOURCE (the project), VERICONE_CASES (how many random ones)."""
import contextlib
import copy
import hashlib
import importlib.util
import io
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from fractions import Fraction
from pathlib import Path

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import make  # noqa: E402
from false_certificates import DROP, FALSE, OUT  # noqa: E402

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
PROGRAM = ROOT / "checker/vericone_check.py"
PAGE = ROOT / "docs/reference/certificates.md"
CASES = int(os.environ.get("VERICONE_CASES", "60"))

spec = importlib.util.spec_from_file_location("vericone_check", PROGRAM)
checker = importlib.util.module_from_spec(spec)
sys.modules["vericone_check"] = checker
sys.dont_write_bytecode = True
spec.loader.exec_module(checker)


def status(document):
    """(exit status, what is printed) of one certificate, an object or text."""
    data = document if isinstance(document, bytes) else (
        document if isinstance(document, str) else json.dumps(document)).encode()
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        found = checker.checked(io.BytesIO(data), "test", 160 * 10 ** 6)
    return (1 if 1 in found else max(found)), said.getvalue()


def examples():
    return [json.loads(block) for block in re.findall(r"```json\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)]


def example(rule, says=None, which=0):
    return copy.deepcopy([x for x in examples() if x["proof"].get("rule") == rule and says in (None, x["claim"]["says"])][which])


def changed(document, path, value):
    """A copy with another value at that place; `None` as path's last item appends."""
    out = copy.deepcopy(document)
    at = out
    for key in path[:-1]:
        at = at[key]
    if value is DROP:
        del at[path[-1]]
    elif path[-1] is None:
        at.append(value)
    else:
        at[path[-1]] = value
    return out


class Examples(unittest.TestCase):
    def test_each_is_accepted_and_every_rule_has_one(self):
        rules = set()

        def collect(proof):
            if isinstance(proof, dict):
                rules.update([proof["rule"]] if isinstance(proof.get("rule"), str) else [])
                for x in proof.values():
                    collect(x)
            elif isinstance(proof, list):
                for x in proof:
                    collect(x)
        for document in examples():
            self.assertEqual(status(document)[0], 0, status(document)[1])
            collect(document["proof"])
        self.assertEqual(rules, {rule for _, rule in checker.RULES} | {"pairs"})

    def test_the_file_of_examples_has_them(self):
        lines = (ROOT / "docs/examples/certificates.jsonl").read_text(encoding="utf-8").splitlines()
        self.assertEqual([json.loads(line) for line in lines], examples())

    def test_what_is_printed_is_what_was_read(self):
        said = status(example("plane"))[1]
        self.assertIn('out: no common point at any time of the horizon. {"says": "out", "id": "17", "horizon": null, "agent": '
                      '{"kind": "ellipsoid", "factor": [[3, 0, 0], [0, 1, 0], [0, 0, 1]], "velocity": [10, 0, 0]}', said)

    def test_it_is_small_and_alone(self):
        text = PROGRAM.read_text(encoding="utf-8")
        self.assertNotIn("vericone.", re.sub(r"docs/\S+", "", text))
        self.assertLessEqual(set(re.findall(r"^(?:import|from) (\w+)", text, re.MULTILINE)), set(sys.stdlib_module_names))
        self.assertLessEqual(max(map(len, text.splitlines())), 110)

    def test_the_schema_takes_them(self):
        schema = json.loads((ROOT / "checker/certificate.schema.json").read_text(encoding="utf-8"))
        for document in examples():
            self.assertEqual(wrong_with(document, schema, schema), [])
        self.assertNotEqual(wrong_with(changed(examples()[0], ["version"], 2), schema, schema), [])


def wrong_with(value, node, root, path=""):
    """The keywords of JSON schema that ours uses."""
    known = {"$schema", "title", "description", "$defs", "$ref", "type", "properties", "required", "additionalProperties", "items",
             "minItems", "maxItems", "anyOf", "const", "enum", "pattern", "minimum", "exclusiveMinimum", "patternProperties"}
    assert set(node) <= known, set(node) - known
    if "$ref" in node:
        return wrong_with(value, root["$defs"][node["$ref"].rsplit("/", 1)[1]], root, path)
    types = {"object": dict, "array": list, "string": str, "integer": int, "number": (int, float), "null": type(None)}
    names = [node["type"]] if isinstance(node.get("type"), str) else node.get("type", [])
    if names and (isinstance(value, bool) or not any(isinstance(value, types[name]) for name in names)):
        return [f"{path}: no {names}"]
    wrong = []
    if "const" in node and value != node["const"] or "enum" in node and value not in node["enum"]:
        wrong.append(f"{path}: {value}")
    if "anyOf" in node and all(wrong_with(value, one, root, path) for one in node["anyOf"]):
        wrong.append(f"{path}: none of them")
    if isinstance(value, str) and "pattern" in node and not re.search(node["pattern"], value):
        wrong.append(f"{path}: {value}")
    if isinstance(value, (int, float)) and ("minimum" in node and value < node["minimum"]):
        wrong.append(f"{path}: {value}")
    if isinstance(value, list):
        if not node.get("minItems", 0) <= len(value) <= node.get("maxItems", len(value)):
            wrong.append(f"{path}: {len(value)} items")
        for x in value if "items" in node else []:
            wrong += wrong_with(x, node["items"], root, path + "[]")
    if isinstance(value, dict):
        wrong += [f"{path}: {name} is missing" for name in node.get("required", []) if name not in value]
        for name, x in value.items():
            if name in node.get("properties", {}):
                wrong += wrong_with(x, node["properties"][name], root, f"{path}.{name}")
            elif node.get("additionalProperties") is False:
                wrong.append(f"{path}.{name}: unknown")
    return wrong


class FalseCertificates(unittest.TestCase):
    maxDiff = None

    def test_each_is_refused(self):
        seen, accepted = set(), []
        for which, path, value in FALSE:
            code, said = status(changed(example(*which), path, value))
            accepted += [] if code else [f"{which}: {path} = {value}: {said}"]
            seen.add(code)
        self.assertEqual(accepted, [])
        self.assertEqual(seen, {1, 2})

    def test_texts_that_json_readers_take(self):
        good = json.dumps(example(*OUT))
        for old, new in (('"horizon": null', '"horizon": NaN'), ('"horizon": null', '"horizon": 1e999'), ("[10, 0, 0]", "[10, 0, Infinity]"),
                         ('"id": "17"', '"says": "out"'), ('"rule": "plane"', '"rule": "plane", "rule": "plane"'),
                         ('"version": 1', '"version": 1, "version": 1'), ('"id": "17"', '"\\u0073ays": "in"'),
                         ("[10, 0, 0]", "[10, 0, " + "1" * 5000 + "]"), ("[10, 0, 0]", "[10, 0, 01]"), (": 80}", ": 1e99999999999}")):
            self.assertIn(old, good)
            self.assertEqual(status(good.replace(old, new))[0], 2, new)
        self.assertEqual(status(good + good)[0], 2)
        self.assertEqual(status(good.encode("utf-16"))[0], 2)

    def test_an_integer_is_the_nearest_double(self):
        """2^53 + 1 is 2^53, so a proof for the one is none for the other."""
        document = example("plane", "disjoint")
        document["claim"].pop("by")
        document["claim"]["obstacle"]["center"] = [2 ** 53 + 1, 0, 0]
        document["proof"] = {"rule": "plane", "n": [1, 0, 0], "agent_at_most": 1, "obstacle_at_least": str(2 ** 53)}
        self.assertEqual(status(document)[0], 1)
        document["claim"]["obstacle"]["center"] = [str(2 ** 53 + 1), 0, 0]
        self.assertEqual(status(document)[0], 0)
        self.assertEqual(checker.number(checker.parsed("0.1")), Fraction(0.1))

    def test_delimited_bodies_are_not_convex(self):
        """By octants, all planes meet the hull of a body with dents: no proof that its errors collide."""
        document = example("octants")
        document["claim"]["obstacle"] = {"kind": "delimited", "center": [5, 0, 0], "velocity": [0, 0, 0], "factor": [
            [1, 0, 0], [0, 1, 0], [0, 0, 1]], "delimiters": [{"matrix": [[0, 0, 0], [0, 0, 0], [0, 0, 0]], "level": 1}]}
        self.assertEqual(status(document)[0], 2)

    def test_quadrics_are_only_what_something_is_inside_of(self):
        """A ball by its matrix: a fit's body. It has no support function here, so no plane is of it."""
        sphere = {"kind": "quadrics", "matrices": [[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -1]]]}
        corners = {"kind": "hull", "points": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}
        for body, center, code in ((sphere, [0, 0, 0], 0), (sphere, ["1/1000", 0, 0], 1), (sphere, [0, 0], 2),
                                   ({**sphere, "matrices": [[[1, 0, 0], [0, 1, 0], [0, 0, -1]]]}, [0, 0, 0], 2),
                                   ({**sphere, "matrices": []}, [0, 0, 0], 2), ({**sphere, "matrices": [[[1, 0], [0, -1]]]}, [0, 0, 0], 2),
                                   (changed(sphere, ["matrices", 0, 0, 3], 1), [0, 0, 0], 2)):
            document = make.certificate({"says": "inside", "agent": corners, "obstacle": {**body, "center": center}}, {"rule": "vertices"})
            self.assertEqual(status(document)[0], code, document)
        ball = {"kind": "ball", "center": [5, 0, 0], "radius": 1}
        for agent, obstacle in ((sphere, ball), ({**sphere, "center": [9, 0, 0]}, ball)):
            for proof in ({"rule": "plane", "n": [1, 0, 0]}, {"rule": "plane", "n": [1, 0, 0], "agent_at_most": 1, "obstacle_at_least": 4},
                          {"rule": "forms", "agent": [1], "obstacle": [1]}):
                self.assertEqual(status(make.certificate({"says": "disjoint", "agent": agent, "obstacle": obstacle}, proof))[0], 2)

    def test_triangles_in_a_dent(self):
        """x^2 - y^2 <= 1 in a large ball: exactly those triangles whose points all keep to it, by samples in fractions."""
        rng, seen = make.generator(9), {True: 0, False: 0}
        form = [[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 0], [0, 0, 0, -1]]
        large = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -100]]
        grid = [(Fraction(i, 24), Fraction(j, 24), Fraction(24 - i - j, 24)) for i in range(25) for j in range(25 - i)]
        for _ in range(500):
            points = [[rng.randint(-5, 5) for _ in range(3)] for _ in range(3)]
            document = make.certificate(
                {"says": "inside", "agent": {"kind": "mesh", "points": points, "triangles": [[0, 1, 2]]},
                 "obstacle": {"kind": "quadrics", "matrices": [form, large]}}, {"rule": "vertices"})
            corners = [[Fraction(x) for x in p] for p in points]
            means = ([sum(w * c[i] for w, c in zip(weights, corners)) for i in range(3)] for weights in grid)
            sampled = all(x * x - y * y <= 1 for x, y, _ in means)
            accepted = status(document)[0] == 0
            self.assertTrue(sampled or not accepted, points)
            seen[accepted] += 1
            if sampled and not accepted:  # by a hair, or never
                self.assertTrue(any(abs(x * x - y * y - 1) < Fraction(1, 2) for x, y, _ in
                                    ([sum(w * c[i] for w, c in zip(weights, corners)) for i in range(3)] for weights in grid)), points)
        self.assertGreater(min(seen.values()), 20)

    def test_never_negative(self):
        """Small whole numbers, against the values at a grid of the triangle."""
        rng, seen = make.generator(10), {True: 0, False: 0}
        grid = [(i, j, 24 - i - j) for i in range(25) for j in range(25 - i)]
        for _ in range(1500):
            a, b, c, d, e, f = (rng.randint(-6, 9) for _ in range(6))
            m = [checker.V(row) for row in ((abs(a), d, e), (d, abs(b), f), (e, f, abs(c)))]
            sampled = min(sum(x * m[i][j] * y for i, x in enumerate(w) for j, y in enumerate(w)) for w in grid)
            found = checker.never_negative(m)
            self.assertTrue(sampled >= 0 or not found, m)
            self.assertTrue(found or sampled < 24 * 24 / 4, m)  # the grid may miss the least value by little
            seen[found] += 1
        self.assertGreater(min(seen.values()), 200)

    def test_octrees_are_their_cells(self):
        """Random trees, read apart, as lists of boxes: the same proofs hold."""
        rng, accepted = make.generator(12), 0
        for _ in range(40):
            cells = []

            def node(low, edge, cells=cells):
                block, below = "", ""
                for bits in range(8):
                    at = [x + edge * (bits >> i & 1) for i, x in enumerate(low)]
                    what = rng.choice(".#+" if edge > 1 else "..#")
                    block += what
                    if what == "#":
                        cells.append([at, [x + edge for x in at]])
                    elif what == "+":
                        below += node(at, edge // 2)
                return block + below
            tree = node([0, 0, 0], 4)
            if not cells:
                continue
            ball = {"kind": "ball", "center": [rng.randint(-3, 12) for _ in range(3)], "radius": 1}
            proof = {"rule": "plane", "n": [4 - x for x in ball["center"]]}
            codes = {status(make.certificate({"says": "disjoint", "agent": ball, "obstacle": body}, proof))[0] for body in (
                {"kind": "octree", "low": [0, 0, 0], "cell": 1, "depth": 2, "tree": tree}, {"kind": "boxes", "boxes": cells})}
            self.assertEqual(len(codes), 1, tree)
            accepted += codes == {0}
        self.assertGreater(accepted, 9)

    def test_a_certificate_of_another_case(self):
        documents = examples()
        accepted = 0
        for i, one in enumerate(documents):
            for j, other in enumerate(documents):
                if i != j:
                    code, said = status({**one, "proof": other["proof"]})
                    accepted += code == 0
                    self.assertTrue(code or one["claim"]["says"] == other["claim"]["says"] in ("out", "disjoint", "near", "meet", "inside"), said)
        # a plane along e_y parts more than one of the examples
        self.assertLessEqual(accepted, 6)

    def test_answers(self):
        document = example(*OUT)
        answer = {"id": 17, "verdict": "out", "clearance": 3.0, "certificate": document}
        self.assertEqual(status(answer)[0], 0)
        self.assertEqual(status({**answer, "verdict": "in"})[0], 1)
        self.assertEqual(status({**answer, "verdict": None})[0], 1)
        self.assertEqual(status({**answer, "certificate": None})[0], 2)
        self.assertEqual(status({**answer, "certificate": answer})[0], 2)

    def test_jumps(self):
        """At a jump both segments count, and a piece of time lies in one of them."""
        document = example("pairs")
        document["claim"]["tracks"][0] = {"times": [0, 1, 2], "positions": [[[0, 0, 0]], [[0, -1, 0]]], "radius": 0}
        self.assertEqual(status(document)[0], 0)
        document["claim"]["tracks"][0]["positions"] = [[[0, 0, 0]], [[0, 1, 0]]]
        self.assertEqual(status(document)[0], 1)
        document["claim"]["tracks"][0] = {"times": [0, 1.5, 2], "positions": [[[0, 0, 0]], [[0, -1, 0]]], "radius": 0}
        self.assertEqual(status(document)[0], 1)

    def test_all_of_it_stands_in_the_file_in_space(self):
        document = example("groups", "out")
        velocity = document["claim"]["obstacle"].pop("velocity")
        data = json.dumps(document["claim"]["obstacle"]).encode()
        for body in ({"kind": "file", "name": "mesh.json", "sha256": hashlib.sha256(data).hexdigest()},
                     {"kind": "box", "low": [9, 9], "high": [10, 10]}, {"kind": "hull", "points": [[9, 9], [9, 9, 9]]}):
            document["claim"]["obstacle"] = {**body, "velocity": velocity}
            self.assertEqual(status(document)[0], 2)

    def test_unions_touch_by_pieces(self):
        ball = {"kind": "ball", "radius": 1}
        pieces = [{**ball, "center": [0, 2, 0]}, {**ball, "center": [0, 9, 0]}]
        document = make.certificate(
            {"says": "touching", "agent": {**ball, "center": [0, 0, 0]}, "obstacle": {"kind": "union", "pieces": pieces}},
            {"rule": "groups", "of": "obstacle", "runs": [[0, 1], [1, 1]], "proofs": [
                {"rule": "touch", "n": [0, 1, 0], "time": 0, "point": [0, 1, 0], "obstacle_piece": 0}, {"rule": "plane", "n": [0, 1, 0]}]})
        self.assertEqual(status(document)[0], 0)
        only = {"rule": "touch", "n": [0, 1, 0], "time": 0, "point": [0, 1, 0], "obstacle_piece": 0}
        self.assertEqual(status({**document, "proof": only})[0], 0)
        for piece in (1, -1, 2, None):
            self.assertNotEqual(status({**document, "proof": {**only, "obstacle_piece": piece}})[0], 0)
        pieces[1]["center"] = [0, 1.5, 0]  # overlaps
        self.assertNotEqual(status(document)[0], 0)
        self.assertNotEqual(status({**document, "proof": only})[0], 0)
        pieces[1]["center"] = [0, 9, 0]
        document["proof"]["proofs"][0] = {"rule": "plane", "n": [0, 1, 0]}
        self.assertNotEqual(status(document)[0], 0)
        pieces[0]["center"] = [0, 3, 0]  # none touches
        self.assertEqual(status(document)[0], 1)


def made(count, first=0):
    """(certificate, statement) of random pairs, every seventh in the plane."""
    found = [make.verdict(make.generator(seed)) for seed in range(first, first + count)]
    return [one for one in found if one]


SAID = {"disjoint": "out", "touching": "on", "overlapping": "in"}


class Made(unittest.TestCase):
    def test_random_verdicts_are_accepted_and_true(self):
        """Every exactly tangent pair, every `out`; `in` where this maker finds a point."""
        certificates = made(CASES)
        self.assertGreater(len(certificates), CASES // 2)
        for document, _ in certificates:
            says = document["claim"]["says"]
            self.assertEqual(make.true_verdict(document["claim"]), SAID.get(says, says), document)
            code, said = status(document)
            self.assertEqual(code, 0, said)
            self.assertLess(len(json.dumps(document)), 3000)

    def test_two_ellipsoids_take_below_5_ms(self):
        """A bound of machines ten times slower; the time itself is in the README."""
        document = example("touch")
        start = time.process_time()
        for _ in range(20):
            status(document)
        self.assertLess((time.process_time() - start) / 20, 0.05)


class Damaged(unittest.TestCase):
    def test_refused_or_still_true(self):
        rng = make.generator(1)
        certificates = made(CASES // 2, 1000)
        accepted = refused = 0
        for _ in range(CASES * 5):
            document, _ = rng.choice(certificates)
            bad = damaged(rng, document)
            code, said = status(bad)
            refused += code != 0
            if code == 0:
                accepted += 1
                says = bad["claim"]["says"]
                self.assertEqual(make.true_verdict(bad["claim"]), SAID.get(says, says), f"{document} became {bad}: {said}")
        self.assertGreater(refused, CASES)
        self.assertGreater(accepted, CASES // 10)


def numbers_of(value, path=()):
    if isinstance(value, (dict, list)):
        for key, x in value.items() if isinstance(value, dict) else enumerate(value):
            yield from numbers_of(x, (*path, key))
    elif isinstance(value, (int, float)) or isinstance(value, str) and re.fullmatch(r"-?\d+(/\d+)?", value):
        yield path


def lists_of(value, path=()):
    if isinstance(value, (dict, list)):
        if isinstance(value, list):
            yield path
        for key, x in value.items() if isinstance(value, dict) else enumerate(value):
            yield from lists_of(x, (*path, key))


def at(value, path):
    for key in path:
        value = value[key]
    return value


def damaged(rng, document):
    """A digit, a sign, an order, a number for another, A for B, a piece less, or another word."""
    document = copy.deepcopy(document)
    paths = [path for path in numbers_of(document) if path != ("version",)]
    how = rng.random()
    path = list(rng.choice(paths))
    old = at(document, path)
    if how < 0.4:
        digits = list(str(old) if isinstance(old, str) else repr(old))
        places = [i for i, c in enumerate(digits) if c.isdigit()]
        digits[rng.choice(places)] = rng.choice("0123456789")
        new = "".join(digits)
        return changed(document, path, new if isinstance(old, str) else float(new) if "." in new or "e" in new else int(new))
    if how < 0.55:
        return changed(document, path, (old[1:] if old[0] == "-" else "-" + old) if isinstance(old, str) else -old)
    if how < 0.65:
        return changed(document, path, at(document, rng.choice(paths)))
    if how < 0.8:
        some = list(rng.choice(list(lists_of(document))))
        new = list(at(document, some))
        if rng.random() < 0.5 and len(new) > 1:
            i, j = rng.sample(range(len(new)), 2)
            new[i], new[j] = new[j], new[i]
        elif new:
            del new[rng.randrange(len(new))]
        return changed(document, some, new)
    claim = document["claim"]
    if "agent" not in claim:
        which = rng.choice(["bodies", "tracks"])
        claim[which].reverse()
    elif how < 0.85:
        claim["agent"], claim["obstacle"] = claim["obstacle"], claim["agent"]
    elif how < 0.92 and "velocity" in claim["agent"]:
        claim["agent"]["velocity"], claim["obstacle"]["velocity"] = claim["obstacle"]["velocity"], claim["agent"]["velocity"]
    elif how < 0.96 and "horizon" in claim:
        claim["horizon"] = rng.choice([None, 0, 1, 100])
    else:
        claim["says"] = rng.choice(["in", "on", "out"] if "horizon" in claim else ["disjoint", "overlapping", "touching"])
    return document


class Runs(unittest.TestCase):
    def test_turning_bodies(self):
        """Two or three; what is accepted is not contradicted by samples; and damaged tracks."""
        rng, accepted, tried, refused = make.generator(5), 0, 0, 0
        for seed in range(max(4, CASES // 12)):
            its, flights = make.run(make.generator(seed), 2 + seed % 2, duration=3)
            proofs = {f"{i} {j}": make.pieces(flights[i], flights[j], its["to"]) for i, j in its["pairs"]}
            its["pairs"] = [[int(k) for k in name.split()] for name, proof in proofs.items() if proof]
            if not its["pairs"]:
                continue
            document = make.certificate(its, {"rule": "pairs", "pairs": {name: proof for name, proof in proofs.items() if proof}})
            tried += 1
            accepted += self.held(document)
            for _ in range(4):
                bad = changed_number(rng, document)
                code = self.held(bad)
                refused += not code
        self.assertGreater(accepted, tried // 2)
        self.assertGreater(refused, tried)

    def held(self, document):
        code, said = status(document)
        if code == 0:
            its = document["claim"]
            flights = [make.Flight(*both) for both in zip(its["bodies"], its["tracks"])]
            for i, j in its["pairs"]:
                for k in range(12):
                    t = float(its["from"] + (its["to"] - its["from"]) * (k + 0.5) / 12)
                    gap = max(make.best_normal(flights[i], flights[j], t, n)[1] for n in ([0, 1.0, 0], [0, -1.0, 0]))
                    self.assertGreater(gap, its["by"] - 1e-9, f"{its} at {t}: {said}")
        return code == 0


def changed_number(rng, document):
    paths = [path for path in numbers_of(document) if path[0] == "claim" and path[-1] not in ("from", "to", "grid") and path[1] != "pairs"
             and "times" not in path] if rng.random() < 0.5 else [path for path in numbers_of(document["proof"], ("proof",))]
    path = list(rng.choice(paths))
    old = at(document, path)
    new = Fraction(old) * rng.choice([-1, 0, 2, Fraction(9, 10), Fraction(11, 10)])
    return changed(document, path, make.text(new) if not isinstance(old, int) else int(new))


HOSTILE = {
    "deep lists": b"[" * 10 ** 6, "deep objects": b'{"a":' * 10 ** 6, "long text": b'"' + b"a" * 10 ** 8, "a long number": b"1" * 10 ** 7,
    "an exponent": b'{"format": 1e3000000000}', "many lists": b"[" + b"[]," * 3 * 10 ** 7, "many numbers": b"[" + b"0," * 5 * 10 ** 7,
    "many objects": b"[" + b"{}," * 2 * 10 ** 7, "zeros": bytes(10 ** 8), "many lines": b"{}\n" * 20000, "nothing": b"", "blank": b"\n\n",
}


class Program(unittest.TestCase):
    def run_it(self, *arguments, data=b""):
        return subprocess.run([sys.executable, PROGRAM, *arguments], input=data, capture_output=True, check=False, timeout=250)

    def test_exit_statuses(self):
        good, bad = json.dumps(example(*OUT)), json.dumps(changed(example(*OUT), ["proof", "agent_at_most"], 9))
        for lines, code in (((good,), 0), ((good, good), 0), ((good, bad), 1), ((good, "{"), 2), (("{}", bad), 1), ((bad, "x"), 1)):
            self.assertEqual(self.run_it("-", data="\n".join(lines).encode()).returncode, code, lines)
        self.assertEqual(self.run_it("-", data=json.dumps(example(*OUT), indent=2).encode()).returncode, 0)
        self.assertEqual(self.run_it("/nowhere/at/all").returncode, 2)
        self.assertEqual(self.run_it().returncode, 2)
        first = self.run_it("-", data=bad.encode()).stdout.decode()
        self.assertIn("-: 1: refused, this does not hold: agent: r^2 - n.S n is not negative", first)

    def test_hostile_files_take_little(self):
        most = "import resource, subprocess, sys; done = subprocess.run(sys.argv[1:], stdin=sys.stdin, capture_output=True); " \
            "print(done.returncode, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, done.stderr.decode()[-300:])"
        for name, data in HOSTILE.items():
            done = subprocess.run([sys.executable, "-c", most, sys.executable, PROGRAM, "-"], input=data, capture_output=True, check=True)
            code, kilobytes, *errors = done.stdout.decode().split()
            self.assertEqual((code, errors), ("2", []), name)
            self.assertLess(int(kilobytes), 200_000, name)

    def test_anything_as_a_file(self):
        """Bytes changed, cut and doubled: never accepted unless it says the same."""
        rng = make.generator(3)
        texts = [json.dumps(document).encode() for document in examples()]
        for _ in range(CASES * 10):
            data = bytearray(rng.choice(texts))
            for _ in range(rng.randint(1, 3)):
                i = rng.randrange(len(data))
                kind = rng.random()
                if kind < 0.5:
                    data[i] = rng.choice(b'0123456789-/.eE"[]{},: \n\x00\xff')
                elif kind < 0.75:
                    del data[i:i + rng.randint(1, 9)]
                else:
                    data[i:i] = data[i:i + rng.randint(1, 9)]
            code, said = status(bytes(data))
            self.assertIn(code, (0, 1, 2))
            if code == 0:
                json.loads(bytes(data))  # it is one

    def test_any_value_in_any_place(self):
        """Never anything but the three statuses."""
        rng, seen, documents = make.generator(4), set(), examples()
        for _ in range(CASES * 10):
            document = rng.choice(documents)
            path = list(rng.choice([path for path in places(document) if path]))
            value = rng.choice(VALUES) if rng.random() < 0.7 else at(document, rng.choice(list(places(document))))
            seen.add(status(changed(document, path, DROP if rng.random() < 0.1 else value))[0])
        self.assertEqual(seen, {0, 1, 2})


VALUES = [None, True, False, 0, -1, 1, "", "x", "0", "1/3", "-1", [], {}, [[]], [0], 1e308, 5e-324, "1" * 4000, "1/" + "7" * 4000,
          [0, 0, 0], [0, 0], [[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[1, 0], [0, 1]], 1.0, 2 ** 60]


def places(value, path=()):
    yield path
    if isinstance(value, (dict, list)):
        for key, x in value.items() if isinstance(value, dict) else enumerate(value):
            yield from places(x, (*path, key))


if __name__ == "__main__":
    unittest.main()
