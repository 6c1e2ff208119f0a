# SPDX-License-Identifier: BSD-3-Clause
"""What the enumerations of C++ are in Python."""
from __future__ import annotations

import enum


class NamedInt(enum.IntEnum):
    """An int that prints as its name: "in", "disjoint"."""

    def __bool__(self) -> bool:
        kind = type(self).__name__
        raise TypeError(f"{kind}.{self.name} is neither true nor false: ask whether it is {kind}.{self.name}, or another member")

    def __str__(self) -> str:
        return self.name.rstrip("_")

    def __format__(self, spec: str) -> str:
        return format(str(self), spec)
