# SPDX-License-Identifier: BSD-3-Clause
"""Every public C++ name is in the list of names, and has its Python one or a reason why not. The list is the binding's own,
names.json; that nothing is missing in it is read from the text of the headers, by another reader than the binding's. Concepts
say what C++ types must have; they, macros, mechanism (vericone/internal) and the library for tests in C++ (cones/testing)
are none of Python's business. Swarms have no Python yet."""

import importlib
import json
import os
import re
import sys
from collections import Counter
from pathlib import Path
from typing import Any, Iterator

import pytest

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
sys.path.insert(0, str(ROOT / "tests/house"))

from declarations import declarations  # type: ignore[import]  # noqa: E402

LIBRARIES = ("geometry", "cones", "guidance", "scenes", "vision")
# Namespaces that no user is to use.
HIDDEN = re.compile(r"^namespace (?:\w+::)*(detail|pairs|courses) \{.*?^\}  // namespace (?:\w+::)*\1$", re.MULTILINE | re.DOTALL)


@pytest.fixture(scope="module")
def names(build: Path) -> list[dict[str, str]]:
    listed: list[dict[str, str]] = json.loads((build / "python/names.json").read_text(encoding="utf-8"))
    return listed


def declared(text: str) -> Iterator[str]:
    """Names of types, functions, aliases and constants in the namespaces of a header."""
    text = HIDDEN.sub(lambda match: re.sub(r"[^\n]", " ", match.group(0)), text)
    for _, scope, declaration, end in declarations(text):
        declaration = re.sub(r"\[\[[^\]]*\]\]\s*", "", declaration)
        if scope != "namespace" or not declaration or re.match(r"namespace\b|static_assert|template\b|requires\b|concept\b|[A-Z_]+\(", declaration):
            continue
        kind = re.match(r"(?:class|struct|enum class|enum)\s+(\w+)(?: final)?\s*(?:[:{].*)?$", declaration, re.DOTALL)
        if kind:
            if end == "{":  # and not only announced
                yield kind.group(1)
            continue
        other = re.match(r"using (\w+) =", declaration) or re.search(r"(?<!operator)\b(\w+)\s*\(", declaration)
        if other:
            if not re.search(r"\boperator\b", declaration):
                yield other.group(1)
            continue
        constant = re.search(r"(\w+)\s*(?:=.*)?$", declaration, re.DOTALL)
        if constant and re.match(r"inline|constexpr|extern|const\b", declaration):
            yield constant.group(1)


def headers() -> list[Path]:
    return [path for library in LIBRARIES for path in sorted((ROOT / library).rglob("include/vericone/**/*.h"))
            if not {"testing", "internal"} & set(path.parts)]


@pytest.mark.parametrize("header", headers(), ids=lambda path: str(path).split("/include/vericone/")[1])
def test_every_name_of_a_header_is_listed(names: list[dict[str, str]], header: Path) -> None:
    listed = {part.split("<")[0] for entry in names for part in entry["cpp"].split("::")}
    assert [name for name in declared(header.read_text(encoding="utf-8")) if name not in listed] == []


def test_the_other_reader_sees_the_headers() -> None:
    assert sum(len(list(declared(path.read_text(encoding="utf-8")))) for path in headers()) > 600


def resolve(name: str) -> Any:
    """The object that a Python name such as "guidance.Navigator.step" stands for."""
    parts = name.split(".")
    if parts[0] == "verify":  # a package of its own
        value: Any = importlib.import_module("vericone_verify")
        if value.__file__ is None:
            raise ImportError("vericone_verify was not built")
        for part in parts[1:]:
            value = getattr(value, part)
        return value
    for n in range(len(parts), -1, -1):
        try:
            value = importlib.import_module(".".join(["vericone", *parts[:n]]))
            break
        except ModuleNotFoundError:
            continue
    for part in parts[n:]:
        value = getattr(value, part)
    return value


def test_every_listed_name_is_there(names: list[dict[str, str]]) -> None:
    wrong, seen = [], 0
    for entry in names:
        if not entry["python"]:
            continue
        seen += 1
        try:
            resolve(entry["python"])
        except ImportError:
            continue  # of a part that was not built
        except AttributeError:
            wrong.append(entry["python"])
    assert wrong == []
    assert seen > 1000


def test_what_is_not_bound_has_a_reason(names: list[dict[str, str]]) -> None:
    assert [entry["cpp"] for entry in names if not entry["python"] and len(entry["reason"].split()) < 2] == []


def test_most_names_are_bound(names: list[dict[str, str]]) -> None:
    """Reasons are for what has no meaning in Python, and few: errors, ways to stop, and a class that owns what it is given."""
    kinds = Counter((entry["kind"], bool(entry["python"])) for entry in names)
    for kind in ("struct", "enum", "function"):
        assert kinds[kind, True] > 9 * kinds[kind, False], kind
    assert kinds["class", False] <= 5


def test_the_parts_under_the_gpl_are_apart(names: list[dict[str, str]]) -> None:
    assert not hasattr(importlib.import_module("vericone"), "verify")
    assert [entry["cpp"] for entry in names
            if entry["python"] and entry["header"].startswith("verify/") != entry["python"].startswith("verify.")] == []
