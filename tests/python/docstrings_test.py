# SPDX-License-Identifier: BSD-3-Clause
"""The docstring of a quantity names its unit, itself or by that of the class that it is of."""

import inspect
import re
from typing import Any

import pytest

import signatures

import vericone

# A word for a unit, or for a number that has none; or signs of units: m/s^2, 1/s, px^2.
WORDS = (r"metres?|km|mm|seconds?|radians?|degrees?|steradians?|pixels?|units?|no unit|dimensionless|ratio|relative|fraction|share|part of|parts?"
         r"|times as|times the|probability|quantile|likelihood|orthonormal|rotation|normalised|sine|cosine|tangent|weights?|exponent|quaternion"
         r"|standard deviations?|sigmas?|coefficients?|0 to 1|scale|factor|per second|noise|homogeneous")
SIGN = r"(?:m|s|ms|us|ns|rad|sr|kg|N|Hz|px|K|Pa|W)(?:\^\d)?"
UNIT = re.compile(rf"\b(?i:{WORDS})\b|(?<![\w/^])(?:(?:1|{SIGN})/{SIGN}|{SIGN})(?![\w^])")
# What a stub says of what has a unit: numbers, arrays of them, intervals.
QUANTITY = re.compile(r"\bfloat\b|_Floats|\bInterval\b")


def documented() -> list[signatures.Callable]:
    return [c for c in signatures.callables(vericone) if c.kind in ("function", "class", "method", "static", "property")]


def value_of(name: str) -> Any:
    value: Any = vericone
    for part in name.split("."):
        value = inspect.getattr_static(value, part) if inspect.isclass(value) else getattr(value, part)
    return value


def owner_doc(c: signatures.Callable) -> str:
    return inspect.getdoc(value_of(c.owner)) or "" if c.owner else ""


BY_OWNER: dict[str, list[signatures.Callable]] = {}
for _c in documented():
    BY_OWNER.setdefault(_c.owner or _c.name, []).append(_c)


@pytest.mark.parametrize("owner", sorted(BY_OWNER))
def test_docstrings(owner: str) -> None:
    """Each quantity that is answered, or is a field, says in which unit."""
    without = []
    for c in BY_OWNER[owner]:
        if c.kind == "class" or not any(QUANTITY.search(s.returns) and "Callable" not in s.returns for s in c.signatures):
            continue
        if not UNIT.search(f"{inspect.getdoc(value_of(c.name)) or ''}\n{owner_doc(c)}"):
            without.append(c.name)
    assert without == []


def test_there_are_many() -> None:
    assert len(documented()) > 1000
