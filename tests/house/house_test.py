#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What the folders promise (docs/explanation/architecture.md), read from the includes of all sources."""

import os
import re
import sys
import unittest
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
SOURCES = ("geometry", "cones", "guidance", "c", "scenes", "vision", "verify", "apps", "papers", "benchmarks", "python", "tests")

# What each library may include, beside itself.
MAY_INCLUDE = {
    "geometry": (),
    "files": ("geometry",),
    "octomap": ("geometry",),
    "fitting": ("geometry",),
    "lidar": ("geometry",),
    "cones": ("geometry",),
    "guidance": ("geometry", "cones"),
    "c": ("geometry", "cones", "guidance"),
    "simulation": ("geometry", "cones", "guidance"),
    "vehicles": ("geometry", "simulation"),
    "swarm": ("geometry", "cones", "simulation"),
    "ships": ("geometry", "cones", "simulation"),
    "scenes": ("geometry", "files", "octomap", "cones"),
    "work": ("geometry", "scenes"),
    "scenarios": ("geometry", "files", "cones", "guidance", "simulation", "vehicles", "scenes"),
    "fits": ("geometry", "files", "fitting"),
    "pursuits": ("geometry", "guidance", "simulation", "scenes", "scenarios", "vision", "vision/scene", "vision/footage",
                 "vision/pursuit"),
    "scanning": ("geometry", "lidar", "cones", "scenes"),
    "vision": ("geometry",),
    "vision/scene": ("geometry", "vision"),
    "vision/footage": ("geometry", "vision"),
    "vision/pursuit": ("geometry", "cones", "guidance", "simulation", "vehicles", "vision", "vision/scene"),
    "verify": ("geometry", "cones"),
}
# Of cones: each folder may include itself and what stands before it.
FAMILIES = ["", "answers", "ellipsoids", "planar", "combined", "hulls", "round", "opening", "times", "assembly", "composite",
            "slices", "map", "pairs", "uncertain", "certificate"]
LIBRARY_FOLDERS = ("geometry", "cones", "guidance", "c", "scenes", "vision", "verify")
MOST_FILES = 25


def library_of(path):
    parts = path.relative_to(ROOT).parts
    if parts[0] == "geometry" and parts[1] in ("files", "octomap", "fitting", "lidar"):
        return parts[1]
    if parts[0] == "guidance" and parts[1] == "simulation":
        return "simulation"
    if parts[0] == "guidance" and parts[1] in ("vehicles", "swarm", "ships"):
        return parts[1]
    if parts[0] == "scenes" and parts[1] in ("work", "scenarios", "fit", "scan", "pursuits"):
        return {"fit": "fits", "scan": "scanning"}.get(parts[1], parts[1])
    if parts[0] == "vision" and parts[1] in ("scene", "footage", "pursuit"):
        return "vision/" + parts[1]
    return parts[0]


def folder_of(path):
    """The folder of a library's sources, "" of what stands beside them."""
    parts = path.relative_to(ROOT).parts[:-1]
    return "/".join(parts) if "src" in parts and parts[-1] != "src" else ""


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


def words_of(include):
    """Of a header of ours, the names of its library and of the folders below: mechanism (internal/) stands beside the rest."""
    return [part for part in include.split("/") if part != "internal"]


class House(unittest.TestCase):
    def test_libraries_include_only_what_the_table_says(self):
        wrong = []
        for path in sources(*LIBRARY_FOLDERS):
            own = library_of(path)
            for name in includes(path):
                parts = words_of(name)
                other = "/".join(parts[1:3]) if "/".join(parts[1:3]) in MAY_INCLUDE else parts[1] if len(parts) > 1 else ""
                if parts[0] in ("apps", "papers", "benchmarks", "python") or (
                        parts[0] == "vericone" and other in MAY_INCLUDE and other not in (own, *MAY_INCLUDE[own])):
                    wrong.append(f"{path.relative_to(ROOT)}: {name}")
        self.assertEqual(wrong, [])

    def test_folders_of_sources_have_no_circles(self):
        """Files that stand beside the folders of a library, its face or its ground, are left out."""
        for top in ("geometry", "cones", "guidance", "scenes", "vision", "verify", "apps"):
            below = {}
            for path in sources(top):
                own = folder_of(path)
                for name in re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.MULTILINE):
                    other = next((folder_of(base / name) for base in path.parents if (base / name).is_file()), None)
                    if own and other and own != other:
                        below.setdefault(own, set()).add(other)
            with self.subTest(top):
                try:
                    TopologicalSorter(below).prepare()
                except CycleError as circle:
                    self.fail(" -> ".join(circle.args[1]))

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

    def test_folders_are_small_enough_to_read(self):
        large = []
        for top in SOURCES:
            for folder, _, files in os.walk(ROOT / top):
                count = sum(name.endswith((".h", ".cpp", ".py")) for name in files)
                if count > MOST_FILES:
                    large.append(f"{Path(folder).relative_to(ROOT)}: {count}")
        self.assertEqual(large, [])

    def test_kinds_of_two_bodies_are_asked_for_where_pairs_are_chosen(self):
        """Who serves a pair is known in cones/src/pairs alone: elsewhere no condition asks two bodies for their kinds, but
        where every answer is right and one is sharper; and no switch is on the kind of a body, but in geometry (what a body
        is) and where bodies are read and written."""
        sharper = ("cones/src/motion/", "guidance/simulation/src/proof/", "guidance/src/clearance_law.cpp", "apps/src/cone/cone.cpp")
        kind = r"(\w+(?:\.\w+)*)\s*(?:\.|->)\s*(?:quadric|quadrics|hull|placed|flat|assembly|delimited)\(\)"
        two = re.compile(r"!?" + kind + r"\s*(?:&&|\|\|)\s*\(?!?" + kind)
        one = re.compile(r"[=!]= BodyKind::|case BodyKind::")
        wrong = []
        for path in sources("geometry", "cones", "guidance", "scenes", "vision", "apps"):
            name, text = str(path.relative_to(ROOT)), path.read_text(encoding="utf-8")
            if not name.startswith(("cones/src/pairs/", *sharper)):
                wrong += [f"{name}: {found[0]}" for found in two.finditer(text) if found[1] != found[2]]
            if one.search(text) and not name.startswith(("cones/src/pairs/", "cones/testing/", "geometry/", "scenes/")):
                wrong.append(f"{name}: BodyKind::")
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
