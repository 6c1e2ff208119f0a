#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the folders promise (docs/explanation/architecture.md), read from the includes of all sources."""

import os
import re
import sys
import unittest
from pathlib import Path

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
SOURCES = ("geometry", "cones", "guidance", "scenes", "vision", "verify", "apps", "papers", "benchmarks", "python", "tests")

# Libraries, and within them folders, each of which may include itself and what stands before it.
LIBRARIES = ["geometry", "files", "octomap", "fitting", "lidar", "cones", "guidance", "simulation", "vehicles", "scenes", "work", "scenarios", "fits", "scanning", "vision", "vision/scene", "vision/footage", "vision/pursuit", "verify"]
BESIDE = {("fitting", "octomap"), ("fitting", "files"), ("fitting", "lidar"), ("lidar", "octomap"), ("lidar", "fitting"),
          ("cones", "files"), ("cones", "octomap"), ("cones", "fitting"), ("cones", "lidar"),
          ("guidance", "files"), ("guidance", "octomap"), ("guidance", "fitting"), ("guidance", "lidar"),
          ("simulation", "files"), ("simulation", "octomap"), ("simulation", "fitting"), ("simulation", "lidar"),
          ("vehicles", "files"), ("vehicles", "octomap"), ("vehicles", "fitting"), ("vehicles", "lidar"), ("verify", "vehicles"),
          ("scenes", "vehicles"),
          ("verify", "octomap"), ("verify", "fitting"), ("verify", "lidar"), ("verify", "guidance"),
          ("verify", "simulation"), ("verify", "scenes"), ("verify", "scenarios"), ("scenes", "guidance"),
          ("fits", "simulation"), ("fits", "scenarios"), ("fits", "lidar"), ("verify", "fits"), ("verify", "scanning"), ("scanning", "fits"), ("scanning", "scenarios"), ("scanning", "simulation"), ("scanning", "fitting"), ("scenes", "simulation"), ("scenes", "fitting"), ("scenes", "lidar"), ("scenarios", "fitting"), ("scenarios", "lidar"), ("octomap", "fitting"), ("octomap", "lidar")}
# The tracker knows geometry alone; pictures and files nothing of guidance.
BESIDE |= {(own, other) for own in ("vision", "vision/scene", "vision/footage")
           for other in LIBRARIES[1:LIBRARIES.index("vision")]}
BESIDE |= {("vision/footage", "vision/scene")} | {("verify", other) for other in LIBRARIES if other.startswith("vision")}
BESIDE |= {("vision/pursuit", other) for other in ("files", "octomap", "fitting", "lidar", "scenes", "scenarios", "fits", "scanning")}
FAMILIES = ["", "answers", "ellipsoids", "planar", "combined", "hulls", "opening", "times", "assembly", "composite",
            "slices", "map", "pairs", "uncertain"]
MOST_FILES = 25

def library_of(path):
    parts = path.relative_to(ROOT).parts
    if parts[0] == "geometry" and parts[1] in ("files", "octomap", "fitting", "lidar"):
        return parts[1]
    if parts[0] == "guidance" and parts[1] == "simulation":
        return "simulation"
    if parts[0] == "guidance" and parts[1] == "vehicles":
        return "vehicles"
    if parts[0] == "scenes" and parts[1] in ("work", "scenarios", "fit", "scan"):
        return {"fit": "fits", "scan": "scanning"}.get(parts[1], parts[1])
    if parts[0] == "vision" and parts[1] in ("scene", "footage", "pursuit"):
        return "vision/" + parts[1]
    return parts[0]


def sources(*folders):
    for folder in folders or SOURCES:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in (".h", ".cpp"):
                yield path


def includes(path):
    return re.findall(r'^#include [<"]([^>"]+)[>"]', path.read_text(encoding="utf-8"), re.MULTILINE)


def public_headers():
    return {str(path).split("/include/", 1)[1]: path
            for folder in ("geometry", "cones", "guidance", "scenes", "vision", "verify")
            for path in (ROOT / folder).rglob("include/**/*.h")}


def library_named(include):
    """Of a header of ours, the names of its library and of the folders below: mechanism (internal/) stands beside the rest."""
    return [part for part in include.split("/") if part != "internal"]


class House(unittest.TestCase):
    def test_libraries_include_only_those_below(self):
        wrong = []
        for path in sources("geometry", "cones", "guidance", "scenes", "vision", "verify"):
            own = library_of(path)
            for name in includes(path):
                parts = library_named(name)
                if parts[:2] == ["vericone", "vision"] and parts[2] in ("scene", "footage", "pursuit"):
                    parts[1] = "vision/" + parts[2]
                if parts[0] in ("apps", "papers", "benchmarks", "python"):
                    wrong.append(f"{path}: {name}")
                if parts[0] != "vericone" or parts[1] not in LIBRARIES:
                    continue
                if LIBRARIES.index(parts[1]) > LIBRARIES.index(own) or (own, parts[1]) in BESIDE:
                    wrong.append(f"{path.relative_to(ROOT)}: {name}")
        self.assertEqual(wrong, [])

    def test_families_of_cones_include_only_those_below(self):
        wrong = []
        for path in sources("cones"):
            text = str(path.relative_to(ROOT))
            inner = text.split("/src/" if "/src/" in text else "/include/vericone/", 1)[1].removeprefix("internal/").removeprefix("cones/")
            own = inner.split("/")[0] if "/" in inner else ""
            if own == "" or text.startswith("cones/testing/"):
                # What users read: it stands on the families, and answers.h and the like below them.
                continue
            for name in includes(path):
                other = name.replace("/internal/", "/").removeprefix("vericone/cones/")
                if "/" not in other or other.split("/")[0] not in FAMILIES:
                    continue
                if FAMILIES.index(other.split("/")[0]) > FAMILIES.index(own):
                    wrong.append(f"{text}: {name}")
        self.assertEqual(wrong, [])

    def test_headers_bring_no_integers_of_any_length_unasked(self):
        """boost::multiprecision is 60,000 lines: only headers that are called exact bring it."""
        headers = public_headers()

        def brings(name, seen):
            if "multiprecision" in name:
                return True
            if name in seen or name not in headers:
                return False
            seen.add(name)
            return any(brings(other, seen) for other in includes(headers[name]))

        heavy = sorted(name for name in headers
                       if "/verify/" not in name and "exact" not in name and brings(name, set()))
        self.assertEqual(heavy, [])

    def test_installed_headers_bring_no_json_and_nothing_of_their_own_folder(self):
        wrong = [f"{name}: {other}" for name, path in public_headers().items() for other in includes(path)
                 if "nlohmann" in other or "yaml" in other or other.startswith(("json/", "input/", "scenarios/"))]
        self.assertEqual(wrong, [])

    def test_benchmarks_know_no_command(self):
        own = {path.name for path in sources("benchmarks")}
        wrong = []
        for path in sources("benchmarks"):
            for name in re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.MULTILINE):
                if Path(name).name not in own and (ROOT / "apps/src" / name).exists():
                    wrong.append(f"{path.relative_to(ROOT)}: {name}")
        self.assertEqual(wrong, [])

    def test_folders_of_apps_include_in_no_circle(self):
        top, below = ROOT / "apps/src", {}
        for path in sources("apps/src"):
            own = path.relative_to(top).parts[0]
            folders = (name.split("/")[0] for name in includes(path) if "/" in name)
            below.setdefault(own, set()).update(other for other in folders if other != own and (top / other).is_dir())

        def circle(folder, on_the_way):
            if folder in on_the_way:
                return [*on_the_way[on_the_way.index(folder):], folder]
            return next(filter(None, (circle(other, [*on_the_way, folder]) for other in sorted(below.get(folder, ())))), [])

        for folder in sorted(below):
            self.assertEqual(circle(folder, []), [])

    def test_folders_are_small_enough_to_read(self):
        large = []
        for top in SOURCES:
            for folder, _, files in os.walk(ROOT / top):
                count = sum(name.endswith((".h", ".cpp", ".py")) for name in files)
                if count > MOST_FILES:
                    large.append(f"{Path(folder).relative_to(ROOT)}: {count}")
        self.assertEqual(large, [])

    def test_kinds_of_bodies_are_asked_for_in_three_folders(self):
        """geometry/src (what a body is), cones/src/pairs (who serves a pair), scenes/input (who reads).

        No other variant is asked for its kind in these folders either, so that no pattern has to guess what a body is."""
        allowed = ("geometry/src/", "cones/src/pairs/", "scenes/input/")
        asks = re.compile(r"\bstd::(visit|get_if|holds_alternative)\b|\bstd::get<[A-Z]|[=!]= BodyKind::")
        wrong = [str(path.relative_to(ROOT)) for path in sources("geometry", "cones", "guidance", "scenes", "apps", "papers")
                 if not str(path.relative_to(ROOT)).startswith(allowed) and asks.search(path.read_text(encoding="utf-8"))]
        self.assertEqual(wrong, [])

    def test_papers_hold_no_programs_to_compile(self):
        """Scenarios, figures.yaml, claims.yaml, bibliography; Python where a figure needs its own drawing."""
        kinds = {path.suffix for path in (ROOT / "papers").rglob("*") if path.is_file() and "__pycache__" not in path.parts}
        self.assertLessEqual(kinds, {".yaml", ".jsonl", ".bib", ".py", ".md"})
        known = [str(path) for path in sources("apps") if "/measures/" in str(path) and "dhal" in path.read_text(encoding="utf-8")]
        self.assertEqual(known, [])

    def test_headers_name_themselves_once(self):
        wrong = [str(path) for path in sources("geometry", "cones", "guidance", "scenes", "verify")
                 if path.suffix == ".h" and "#pragma once" not in path.read_text(encoding="utf-8")]
        self.assertEqual(wrong, [])


if __name__ == "__main__":
    sys.exit(unittest.main())
