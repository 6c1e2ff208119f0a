#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the tables of fields in docs/reference from the JSON schemas, from the project's folder:

/usr/bin/python3 tests/docs/fields.py [PROGRAM]

With the program it writes the schemas first, in docs/schemas, as `vericone schema` prints them. A table stands after a line `<!-- fields: SCHEMA [DEFINITION] [: FIELD...] -->`, up to the next empty line. Without a
definition it has the fields of the schema itself, without fields all. What it says of a field: its type (`title`, `type`,
`enum` and bounds), `unit`, `default` or `absent` (in words what is taken if it is left out), `read_by`, `description`.
fields_test.py holds the pages against the schemas."""

import json
import re
import subprocess
import sys

from pages import ROOT, text_of

PAGES = ("docs/reference/formats.md", "docs/reference/pursuits.md", "docs/reference/scenarios.md")
KINDS = ("body", "claims", "figures", "population", "pursuit", "scan", "scenario", "scene", "tracks")
MARK = re.compile(r"^<!-- fields: (\w+)(?: (\w+))?(?:: ([\w ]+))? -->$")
TYPES = {"string": "text", "boolean": "true or false", "integer": "whole number", "number": "number", "object": "object",
         "array": "list"}


def schema(name):
    return json.loads(text_of(ROOT / f"docs/schemas/{name}.schema.json"))


def found(name, reference):
    """(schema's name, node) that a $ref leads to."""
    file, path = reference.split("#/")
    name = file.removesuffix(".schema.json") or name
    node = schema(name)
    for key in path.split("/"):
        node = node[key]
    return name, node


def said(name, node, key):
    """What a node or the one it refers to says."""
    while key not in node and "$ref" in node:
        name, node = found(name, node["$ref"])
    return node.get(key)


def type_of(node):
    """A number that may have its unit written out is a number or text."""
    return node["type"][0] if isinstance(node["type"], list) else node["type"]


def kind(name, node):
    if "enum" in node:
        return ", ".join(f"`{value}`" for value in node["enum"])
    if "title" in node:
        return node["title"]
    if "$ref" in node:
        return kind(*found(name, node["$ref"]))
    if "minimum" in node:
        above = f" to {node['maximum']}" if "maximum" in node else " or more"
        return f"{TYPES[type_of(node)]}, {node['minimum']}{above}"
    return TYPES[type_of(node)]


def shown(value):
    return "`" + (value if isinstance(value, str) else json.dumps(value)) + "`"


def otherwise(name, node, required):
    if required:
        return "required"
    default = said(name, node, "default")
    return shown(default) if default is not None else said(name, node, "absent") or ""


def properties(name, definition):
    node = schema(name)
    if definition:
        name, node = found(name, f"#/$defs/{definition}" if definition in node["$defs"] else f"#/properties/{definition}")
    return node["properties"], node.get("required", [])


def chosen(nodes, fields):
    """All, those named, or after the word "but" all others."""
    words = fields.split() if fields else []
    if words[:1] == ["but"]:
        return [field for field in nodes if field not in words]
    return words or list(nodes)


def table(name, definition=None, fields=None):
    nodes, required = properties(name, definition)
    rows = []
    readers = any("read_by" in node for node in nodes.values())
    head = ["field", *(["read by"] if readers else []), "type", "if left out", "meaning"]
    for field in chosen(nodes, fields):
        node = nodes[field]
        unit = said(name, node, "unit")
        cells = [f"`{field}`", *([node.get("read_by", "")] if readers else []),
                 kind(name, node) + (f", {unit}" if unit else ""), otherwise(name, node, field in required),
                 said(name, node, "description") or ""]
        rows.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |")
    return [re.sub(r"  +", " ", row) for row in ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *rows]]


def written(text):
    """The page with its tables as the schemas have them."""
    lines, old = [], False
    for line in text.split("\n"):
        old = old and line.startswith("|")
        if not old:
            lines.append(line)
        mark = MARK.match(line)
        if mark:
            lines += table(*mark.groups())
            old = True
    return "\n".join(lines)


def marks(text):
    return [match.groups() for match in map(MARK.match, text.split("\n")) if match]


if __name__ == "__main__":
    for KIND in KINDS if len(sys.argv) > 1 else ():
        TEXT = subprocess.run([sys.argv[1], "schema", KIND], capture_output=True, text=True, check=True).stdout
        (ROOT / f"docs/schemas/{KIND}.schema.json").write_text(TEXT, encoding="utf-8")
    for page in PAGES:
        (ROOT / page).write_text(written(text_of(ROOT / page)), encoding="utf-8")
