# SPDX-License-Identifier: BSD-3-Clause
"""What a pair of velocities leads to, "course" of the data (apps/src/picture/course.h): colours and words, the same in all
pictures."""
from typing import Any

import numpy as np

from .kinds import Data
from .style import GREY

COLORS = {"in": "#c01f1f", "on": "#b07d00", "out": "#0f7f80", "touching": "#c01f1f", "overlapping": "#c01f1f"}
WORDS = {"in": "collides", "on": "grazes", "out": "passes", "touching": "touching now", "overlapping": "overlapping now",
         "undecided": "undecided"}


def color(course: Data) -> Any:
    return COLORS.get(course["verdict"], GREY)


def word(course: Data) -> str:
    return WORDS[course["verdict"]]


def speed(course: Data) -> float:
    largest = np.abs(course["velocity"]).max()
    return float(largest * np.linalg.norm(np.array(course["velocity"]) / (largest or 1)))


def metres(x: Any) -> str:
    """A length in four digits, or all before the point."""
    return "%.0f m" % x if 1e4 <= x < 1e9 else "%.4g m" % x


def sentence(course: Data) -> str:
    """One line: what happens, when, and at which distance."""
    says, w = word(course), speed(course)
    if course.get("contact_time"):
        return "%s: %s after %.4g s" % (course["verdict"], says, course["contact_time"])
    if "miss_distance" not in course:
        return "%s: %s" % (course["verdict"], says) if says != course["verdict"] else says
    far = metres(course["miss_distance"])
    if w == 0:
        return "out: at rest to each other, %s apart" % far
    if course["nearest_time"] == 0:
        return "out: never nearer than now, %s" % far
    return "out: passes at %s after %.4g s" % (far, course["nearest_time"])


def travel(course: Data) -> Any:
    """How far the agent goes until the first contact, or until it is nearest; nothing where neither is known."""
    time = course.get("contact_time", course.get("nearest_time"))
    return None if time is None else time * np.array(course["velocity"])
