# SPDX-License-Identifier: BSD-3-Clause
"""One question to many objects at once."""
from __future__ import annotations

import functools
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt


class Many:
    """Objects of one type whose questions are asked of all of them in one call, without the interpreter in between.

    `many(pairs).verdict(v_a, v_b)` asks each pair about its own velocities, or all about the same: the list broadcasts
    with the arguments like an array of shape (n,). `threads=` divides them.
    """

    def __init__(self, objects: Sequence[Any] | npt.NDArray[Any]) -> None:
        array = np.empty(len(objects), object)
        array[:] = objects
        types = {type(thing) for thing in array.flat}
        if len(types) > 1:
            names = ", ".join(sorted(t.__name__ for t in types))
            raise TypeError(f"many(): the objects are of several types: {names}")
        self.objects = array
        self._type = types.pop() if types else None

    def __len__(self) -> int:
        return len(self.objects)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        from vericone._load import module

        if self._type is not None and not name.startswith("__"):
            space = self._type.__module__.removeprefix("vericone").removeprefix(".")
            question = module("_core")._names["_many"].get(f"{space + '.' if space else ''}{self._type.__qualname__}.{name}")
            if question is not None:
                return functools.partial(question, self.objects)
        kind = self._type.__name__ if self._type else "nothing"
        raise AttributeError(f"many of {kind} have no question '{name}'")


def many(objects: Sequence[Any] | npt.NDArray[Any]) -> Many:
    """These objects, to be asked together: many(pairs).miss(v_a, v_b)."""
    return Many(objects)
