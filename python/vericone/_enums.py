# SPDX-License-Identifier: BSD-3-Clause
"""What the enumerations of C++ are in Python."""
from __future__ import annotations

import enum


class NamedInt(enum.IntEnum):
    """An int that prints as its name: "in", "disjoint"."""

    def __str__(self) -> str:
        return self.name.rstrip("_")

    def __format__(self, spec: str) -> str:
        return format(str(self), spec)
