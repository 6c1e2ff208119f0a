# SPDX-License-Identifier: BSD-3-Clause
"""The JSON schemas of docs/schemas against what `vericone schema` prints, against the examples, against mistakes, and against what the program itself takes.
Environment as for command.py."""
import glob
import json
import os
import re
import sys
import tempfile
import unittest

import yaml

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../docs"))
import bad_input_cases  # noqa: E402
import fields  # noqa: E402
from command import SOURCE, run  # noqa: E402

FOLDER = os.path.join(SOURCE, "docs/schemas")


def schema(name):
    with open(os.path.join(FOLDER, name + ".schema.json"), encoding="utf-8") as file:
        return json.load(file)


class Validator:
    """The keywords that our schemas use; any other is a mistake of ours."""
    KEYWORDS = {"$schema", "$defs", "$ref", "title", "description", "type", "properties", "required", "anyOf", "enum",
                "additionalProperties", "items", "minItems", "maxItems", "minimum", "maximum", "exclusiveMinimum",
                "default", "unit", "absent", "read_by"}  # the last four are for readers (tests/docs/fields.py)
    TYPES = {"object": dict, "array": list, "string": str, "boolean": bool}

    def __init__(self, name):
        self.files = {name + ".schema.json": schema(name)}
        self.root = self.files[name + ".schema.json"]

    def resolve(self, ref, root):
        file, path = ref.split("#/")
        if file:
            root = self.files.setdefault(file, schema(file.removesuffix(".schema.json")))
        node = root
        for key in path.split("/"):
            node = node[key]
        return node, root

    def errors(self, value, node=None, root=None, path=""):
        root = root or self.root
        node = self.root if node is None else node
        unknown = set(node) - self.KEYWORDS
        assert not unknown, f"keywords {unknown} of a schema"
        found = []
        if "$ref" in node:
            target, other = self.resolve(node["$ref"], root)
            found += self.errors(value, target, other, path)
        kind = node.get("type")
        if isinstance(kind, list):  # a number, or text with its unit
            assert kind == ["number", "string"], kind
            kind = "string" if isinstance(value, str) else "number"
        if kind in ("number", "integer"):
            if isinstance(value, bool) or not isinstance(value, (int, float)) or (kind == "integer" and value % 1):
                found.append(f"{path}: no {kind}")
            elif ("minimum" in node and value < node["minimum"] or "maximum" in node and value > node["maximum"] or
                  "exclusiveMinimum" in node and value <= node["exclusiveMinimum"]):
                found.append(f"{path}: out of range")
        elif kind and not isinstance(value, self.TYPES[kind]):
            return found + [f"{path}: no {kind}"]
        if "enum" in node and value not in node["enum"]:
            found.append(f"{path}: none of {node['enum']}")
        if "anyOf" in node and all(self.errors(value, one, root, path) for one in node["anyOf"]):
            found.append(f"{path}: none of its forms")
        if isinstance(value, list):
            if not node.get("minItems", 0) <= len(value) <= node.get("maxItems", len(value)):
                found.append(f"{path}: {len(value)} items")
            if "items" in node:
                for i, item in enumerate(value):
                    found += self.errors(item, node["items"], root, f"{path}[{i}]")
        if isinstance(value, dict) and kind == "object":
            properties = node.get("properties", {})
            found += [f"{path}.{key}: missing" for key in node.get("required", []) if key not in value]
            for key, item in value.items():
                if key in properties:
                    found += self.errors(item, properties[key], root, f"{path}.{key}")
                elif node.get("additionalProperties") is False:
                    found.append(f"{path}.{key}: unknown")
                elif "additionalProperties" in node:
                    found += self.errors(item, node["additionalProperties"], root, f"{path}.{key}")
        return found


class Schemas(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, text):
        path = os.path.join(self.folder.name, "given.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def test_files_are_what_the_command_prints(self):
        """Write them again: tests/docs/fields.py says how."""
        self.assertEqual(sorted(fields.KINDS), sorted(name.removesuffix(".schema.json") for name in os.listdir(FOLDER)))
        for kind in fields.KINDS:
            done = run("schema", kind)
            if "a command without" not in done.stderr:
                with open(os.path.join(FOLDER, kind + ".schema.json"), encoding="utf-8") as file:
                    self.assertEqual((file.read(), done.stderr), (done.stdout, ""), kind)

    def test_examples_are_valid(self):
        count = 0
        for pattern, name in (("docs/examples/*.yaml", "scene"), ("docs/examples/scenarios/*.yaml", "scenario"),
                              ("papers/*/scenarios/*.yaml", "scenario"), ("papers/*/claims.yaml", "claims"),
                              ("papers/*/figures.yaml", "figures"), ("papers/*/scenes/*.yaml", "scene"), ("docs/examples/bodies/*.yaml", "body"),
                              ("docs/examples/pursuits/*.yaml", "pursuit"), ("docs/examples/tracks/*.yaml", "tracks"), ("docs/examples/populations/*.yaml", "population"), ("papers/*/pursuits/*.yaml", "pursuit")):
            validator = Validator(name)
            for path in glob.glob(os.path.join(SOURCE, pattern)):
                with open(path, encoding="utf-8") as file:
                    self.assertEqual(validator.errors(yaml.safe_load(file)), [], path)
                count += 1
        self.assertGreater(count, 20)
        with open(os.path.join(SOURCE, "docs/examples/combined.jsonl"), encoding="utf-8") as file:
            bodies = [json.loads(line) for line in file if "agent" in line]
        body = Validator("body")
        for case in bodies[:-1]:  # the last one is a mistake
            for which in ("agent", "obstacle"):
                self.assertEqual(body.errors(case[which]), [], case)

    def test_mistakes_that_a_schema_can_see_are_seen(self):
        validator = Validator("scenario")
        seen = []
        for what, text in bad_input_cases.SCENARIOS:
            try:
                seen.append((what, bool(validator.errors(yaml.safe_load(text)))))
            except yaml.YAMLError:
                continue
        unknown = [what for what, found in seen if "unknown" in what and not found]
        self.assertEqual(unknown, [])
        # The rest depends on other fields, on files, or on arithmetic.
        self.assertGreater(sum(found for _, found in seen), 0.4 * len(seen), [what for what, found in seen if not found])

    def taken(self, command, text, path):
        """The fields that the program names where `zzz` is none of them."""
        done = run(command, self.write(text))
        self.assertEqual(done.returncode, 2, text)
        said = re.search(re.escape(path) + r": got an unknown field, must be one of (.*)", done.stderr)
        self.assertTrue(said, done.stderr)
        return set(said.group(1).strip().split(", "))

    def test_fields_are_those_of_the_program(self):
        scenario, scene, body = schema("scenario"), schema("scene"), schema("body")
        top = "duration: 5\nbodies:\n  - {name: A, shape: {semi_axes: [1, 1, 1]}, position: [0, 0, 0], velocity: [1, 0, 0]%s}\n"
        road = "duration: 5\nbodies:\n  - {name: A, shape: {semi_axes: [1, 1, 1]}, position: [0, 0, 0], road: {%s}}\n"
        defs = scenario["$defs"]
        for text, path, properties in (
                ("zzz: 1\n" + top % "", "zzz", scenario["properties"]),
                (top % ", zzz: 1", "bodies[0].zzz", defs["by_shape"]["properties"]),
                (top % ", pilot: {law: clearance, zzz: 1}", "bodies[0].pilot.zzz", defs["pilot"]["properties"]),
                (top % ", pilot: {law: clearance, goal: {zzz: 1}}", "bodies[0].pilot.goal.zzz", defs["goal"]["properties"]),
                (top % ", pilot: {law: clearance, clearance: {zzz: 1}}", "bodies[0].pilot.clearance.zzz",
                 defs["clearance"]["properties"]),
                (top % ", pilot: {law: avoidance, plane: {zzz: 1}}", "bodies[0].pilot.plane.zzz", defs["plane"]["properties"]),
                (top % ", vehicle: {kind: fish, zzz: 1}", "bodies[0].vehicle.zzz", defs["vehicle"]["properties"]),
                (top % ", vehicle: {kind: quadrotor, zzz: 1}", "bodies[0].vehicle.zzz", defs["quadrotor"]["properties"]),
                (road % "kind: lanes, velocity: [1, 0], zzz: 1", "bodies[0].road.zzz", defs["lanes"]["properties"]),
                (road % "kind: lanes, velocity: [1, 0], changes: [{zzz: 1}]", "bodies[0].road.changes[0].zzz",
                 defs["lane_change"]["properties"]),
                (road % "kind: squircle, zzz: 1", "bodies[0].road.zzz", defs["squircle"]["properties"]),
                (top % ", vehicle: {kind: fish, limits: {zzz: 1}}", "bodies[0].vehicle.limits.zzz",
                 defs["vehicle_limits"]["properties"]),
                (top % ", vehicle: {kind: fish, control: none, trial: {zzz: 1}}", "bodies[0].vehicle.trial.zzz",
                 defs["fish_trial"]["properties"]),
                ("current: {zzz: 1}\n" + top % "", "current.zzz", defs["current"]["properties"]),
                ("current: {shear: {zzz: 1}}\n" + top % "", "current.shear.zzz", defs["shear"]["properties"]),
                ("current: {gusts: {zzz: 1}}\n" + top % "", "current.gusts.zzz", defs["gusts"]["properties"]),
                ("proof: {zzz: 1}\n" + top % "", "proof.zzz", scenario["properties"]["proof"]["properties"])):
            self.assertEqual(self.taken("check", text, path), set(properties), path)
        pair = "agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\nobstacle: %s\n"
        self.assertEqual(self.taken("check", "zzz: 1\n" + pair % "{center: [9, 0, 0], semi_axes: [1, 1, 1]}", "zzz"),
                         set(scene["properties"]))
        # Every kind of body names its own fields; together they are the schema's, but for what every body may have.
        fields = {"file", "velocity"}
        for kind in ("center: [9, 0, 0], semi_axes: [1, 1, 1]", "mesh: a", "cloud: a", "octree: a", "hull: a", "points: []",
                     "cylinder: {}", "capsule: {}", "cone: {}", "frustum: {}", "box: {}", "disc: {}", "half_space: {}", "slab: {}",
                     "robot: a", "pieces: []", "file: a"):
            fields |= self.taken("check", pair % f"{{{kind}, zzz: 1}}", "obstacle.zzz")
        flat = "agent: {center: [0, 0], semi_axes: [1, 1]}\nobstacle: {center: [9, 0], semi_axes: [1, 1], zzz: 1}\n"
        fields |= self.taken("check", flat, "obstacle.zzz")
        words = "agent: {center: [0, 0], semi_axes: [1, 1]}\nobstacle: {polygon: [], zzz: 1}\n"
        of_scenes = self.taken("check", words, "obstacle.zzz") - fields
        self.assertEqual(of_scenes, {"polygon", "holes", "stadium"})
        of_queries = {"spin", "acceleration", "braking"}
        self.assertEqual(fields | of_scenes | of_queries, set(body["$defs"]["body"]["properties"]))
        # Where no field says the kind, that one may be misspelt: all are named.
        self.assertEqual(self.taken("check", pair % "{center: [9, 0, 0], zzz: 1}", "obstacle.zzz"),
                         fields - {"a_c", "b_c", "k", "phi", "hyperbolas"})
        # A scenario's shape takes these, changes in time, and no velocity.
        shape = set(defs["shape"]["properties"])
        self.assertEqual(shape, fields - {"velocity"} | {"dented"})
        own = {"name", "speed", "heading", "heading_deg", "orientation", "appears", "pilot", "vehicle", "road", "velocity"}
        self.assertEqual(set(defs["as_in_scenes"]["properties"]), shape | own)

    def test_defaults_are_those_of_the_program(self):
        """A run with every default written out is, to the last digit, the run without."""
        defs = schema("scenario")["$defs"]

        def defaults(name, *but):
            node = schema("scenario") if name is None else defs.get(name) or schema("scenario")["properties"][name]
            return {k: v["default"] for k, v in node["properties"].items() if "default" in v and k not in but}

        obstacle = {"name": "B", "shape": {"semi_axes": [2, 1, 1]}, "position": [20, 0.5, 0], "velocity": [-1, 0, 0]}
        goal = {"point": [40, 0, 0], "most": 5}
        for law, own, parts in (
                ("avoidance", {"most": 9, "goal": goal}, {"goal": {**defaults("goal"), **goal}}),
                ("avoidance", {"manner": "source", "most": 9}, {"plane": defaults("plane")}),
                ("clearance", {"most": 9}, {"clearance": defaults("clearance")}),
                ("cooperative-avoidance", {"most": 9, "partners": ["B"]}, {"plane": defaults("plane")})):
            read = {k for k, v in defs["pilot"]["properties"].items() if "default" in v and (
                v["read_by"] == "all" or v["read_by"] == law or v["read_by"].startswith("all but clearance") and law != "clearance"
                or v["read_by"] == "both avoidance laws" and law.endswith("avoidance")
                or v["read_by"] == "avoidance, clearance" and law in ("avoidance", "clearance"))}
            told = {k: v for k, v in defaults("pilot").items() if k in read}
            self.assertIn("gain", told)
            with self.subTest(law=law, own=own):
                runs = []
                for number, (top, body, pilot) in enumerate((({}, {}, {}), (
                        {**defaults(None), "proof": defaults("proof")}, defaults("by_shape"), {**told, **parts}))):
                    agent = {"name": "A", "shape": {"semi_axes": [1, 1, 1]}, "position": [0, 0, 0], "velocity": [5, 0, 0],
                             **body, "pilot": {"law": law, **pilot, **own}}
                    if "goal" in parts and number:
                        agent["pilot"]["goal"] = parts["goal"]
                    out = os.path.join(self.folder.name, f"{law}-{len(own)}-{'goal' in own}-{number}")
                    path = self.write(json.dumps({**top, "bodies": [agent, obstacle]}))
                    done = run("simulate", path, "--no-figures", "--quiet", "--out", out)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    with open(os.path.join(out, "bodies.csv"), encoding="utf-8") as rows, \
                            open(os.path.join(out, "encounters.csv"), encoding="utf-8") as looks:
                        runs.append((rows.read(), looks.read()))
                self.assertTrue(runs[0] == runs[1], "the runs differ")

    def test_defaults_of_vehicles_and_currents_are_those_of_the_program(self):
        defs = schema("scenario")["$defs"]

        def defaults(name):
            return {k: v["default"] for k, v in defs[name]["properties"].items() if "default" in v}

        for control in ("ours", "source", "none"):
            runs = []
            for number in range(2):
                vehicle = {**(defaults("vehicle") if number else {}), "kind": "fish", "control": control}
                if control == "none":
                    vehicle["trial"] = {**(defaults("fish_trial") if number else {}), "amplitude_deg": 20}
                gusts = {**(defaults("gusts") if number else {}), "most": 0.01}
                shear = {**(defaults("shear") if number else {}), "rate": [0.02, 0]}
                current = {**(defaults("current") if number else {}), "gusts": gusts, "shear": shear}
                body = {"name": "A", "position": [0, 0, 0], "velocity": [0.1, 0, 0], "vehicle": vehicle}
                out = os.path.join(self.folder.name, f"fish-{control}-{number}")
                path = self.write(json.dumps({"duration": 5, "step": 0.05, "current": current, "bodies": [body]}))
                done = run("simulate", path, "--no-figures", "--quiet", "--out", out)
                self.assertEqual(done.returncode, 0, done.stderr)
                with open(os.path.join(out, "bodies.csv"), encoding="utf-8") as rows:
                    runs.append(rows.read())
            self.assertTrue(runs[0] == runs[1], f"the runs under {control} differ")
        runs = []
        for number in range(2):
            agent = {"name": "A", "shape": {"semi_axes": [1, 1, 1]}, "position": [0, 0, 0], "velocity": [1, 2, 0],
                     "vehicle": {**(defaults("quadrotor") if number else {}), "kind": "quadrotor"},
                     "pilot": {"law": "clearance", "most": 9, "goal": {"point": [20, -9, 3], "most": 4}}}
            change = {**(defaults("lane_change") if number else {}), "at": 1, "acceleration": 1}
            others = [{"name": name, "shape": {"semi_axes": [1, 1, 1]}, "position": [9 + at, 2, 0], "road": road}
                      for name, at, road in (("B", 0, {"kind": "lanes", "velocity": [0, -1], "changes": [change]}),
                                             ("C", 9, {**(defaults("squircle") if number else {}), "kind": "squircle",
                                                       "radius": 9, "period": 9}))]
            out = os.path.join(self.folder.name, f"quadrotor-{number}")
            path = self.write(json.dumps({"duration": 5, "step": 0.05, "bodies": [agent, *others]}))
            done = run("simulate", path, "--no-figures", "--quiet", "--out", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            with open(os.path.join(out, "bodies.csv"), encoding="utf-8") as rows:
                runs.append(rows.read())
        self.assertTrue(runs[0] == runs[1], "the runs of a quadrotor and roads differ")

    def test_fields_of_papers_are_those_of_the_program(self):
        folder = os.path.join(self.folder.name, "paper")
        self.assertEqual(run("paper", "new", folder).returncode, 0)

        def taken(name, old, new, path):
            file = os.path.join(folder, name)
            with open(file, encoding="utf-8") as f:
                text = f.read()
            self.assertIn(old, text)
            with open(file, "w", encoding="utf-8") as f:
                f.write(text.replace(old, new, 1))
            said = run("check", file)
            with open(file, "w", encoding="utf-8") as f:
                f.write(text)
            found = re.match(r"vericone: %s: %s: got an unknown field, must be one of (.*)" % (name, re.escape(path)), said.stderr)
            self.assertTrue(found, said.stderr)
            return set(found.group(1).split(", "))

        claims, figures = schema("claims")["$defs"], schema("figures")["$defs"]
        top, entry = set(schema("claims")["properties"]), set(claims["claim"]["properties"])
        self.assertEqual(taken("claims.yaml", "claims:\n", "zzz: 1\nclaims:\n", "zzz") | {"templates"}, top)
        fields = taken("claims.yaml", "    id: y-0 ", "    zzz: 1\n    id: y-0 ", "claims[1].zzz")
        fields |= taken("claims.yaml", "{body: A,", "{zzz: 1, body: A,", "claims[0].zzz")
        self.assertEqual(fields | {"like"}, entry)
        values = taken("claims.yaml", "{table: looks, first: y}", "{zzz: 1, table: looks, first: y}", "claims[1].values.first_y.zzz")
        self.assertEqual(values | {"like"}, set(claims["value"]["properties"]))
        top = set(schema("figures")["properties"])
        self.assertEqual(taken("figures.yaml", "figures:\n", "zzz: 1\nfigures:\n", "zzz") | {"templates"}, top)
        self.assertEqual(taken("figures.yaml", "    drawing:", "    zzz: 1\n    drawing:", "figures[0].zzz") | {"like"},
                         set(figures["figure"]["properties"]))
        line = taken("figures.yaml", "{table: looks, y: y,", "{zzz: 1, table: looks, y: y,", "figures[1].panels[0].zzz")
        self.assertEqual(line | {"like"}, set(figures["line"]["properties"]))
        with open(os.path.join(SOURCE, "docs/reference/papers.md"), encoding="utf-8") as f:
            page = f.read()
        for field in entry | top | values | line | set(figures["figure"]["properties"]) | set(figures["panel"]["properties"]):
            self.assertRegex(page, rf"(`|, ){field}[:`,]|\b{field}`", field)

    def test_every_field_is_documented(self):
        with open(os.path.join(SOURCE, "docs/reference/formats.md"), encoding="utf-8") as file:
            formats = file.read()
        with open(os.path.join(SOURCE, "docs/reference/scenarios.md"), encoding="utf-8") as file:
            scenarios = file.read()
        for field in schema("body")["$defs"]["body"]["properties"]:
            self.assertRegex(formats, rf"`{field}`", field)
        defs = schema("scenario")["$defs"]
        for properties in (schema("scenario")["properties"], defs["pilot"]["properties"], defs["by_shape"]["properties"],
                           defs["goal"]["properties"]):
            for field in properties:
                self.assertRegex(scenarios, rf"`{field}`", field)


if __name__ == "__main__":
    unittest.main()
