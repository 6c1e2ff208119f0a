#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The tables of fields are what the schemas say, and leave none out. Environment: VERICONE_SOURCE."""

import sys
import unittest

import fields
from pages import ROOT, text_of


class Fields(unittest.TestCase):
    maxDiff = None

    def test_tables_are_written_from_the_schemas(self):
        for page in fields.PAGES:
            text = text_of(ROOT / page)
            self.assertEqual(fields.written(text), text, f"{page}: write it again: tests/docs/fields.py says how")

    def test_every_field_stands_in_a_table_and_says_what_it_means(self):
        marks = [mark for page in fields.PAGES for mark in fields.marks(text_of(ROOT / page))]
        self.assertGreater(len(marks), 10)
        shown = {}
        for name, definition, only in marks:
            nodes, _ = fields.properties(name, definition)
            shown.setdefault((name, definition), set()).update(fields.chosen(nodes, only))
            for field in fields.chosen(nodes, only):
                self.assertTrue(fields.said(name, nodes[field], "description"), f"{name} {definition} {field}")
        for name, definitions in (("body", ("body", "hyperboloid", "hyperbola")), ("scene", (None,)), ("scan", ("lidar", "pose_error")),
                                  ("scenario", (None, "proof", "by_shape", "pilot", "goal", "plane", "clearance", "orifice", "opening", "vehicle",
                                                "vehicle_limits", "fish_trial", "quadrotor", "lanes", "lane_change", "squircle", "current", "shear", "gusts"))):
            for definition in definitions:
                nodes, _ = fields.properties(name, definition)
                self.assertEqual(shown.get((name, definition)), set(nodes), (name, definition))

    def test_a_change_of_a_schema_is_noticed(self):
        before = "<!-- fields: scenario goal -->\n| field |\n|---|\n\nafter"
        after = fields.written(before)
        self.assertIn("| `reached` | positive number, m | `1` |", after)
        self.assertTrue(after.endswith("\n\nafter"))
        self.assertEqual(fields.written(after), after)


if __name__ == "__main__":
    sys.exit(unittest.main())
