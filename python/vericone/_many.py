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
        from vericone._errors import InputError

        try:
            listed = list(objects)
        except TypeError:
            raise TypeError(f"objects: got {type(objects).__name__}, must be a list of objects of one type") from None
        if not listed:
            raise InputError("objects", "an empty list", "at least one: its type says what can be asked")
        types = {type(thing) for thing in listed}
        if len(types) > 1:
            names = ", ".join(sorted(t.__name__ for t in types))
            raise TypeError(f"many(): the objects are of several types: {names}")
        self.objects = np.empty(len(listed), object)
        for i, thing in enumerate(listed):  # a list of lists would be taken for a matrix
            self.objects[i] = thing
        self._type = types.pop()

    def __len__(self) -> int:
        return len(self.objects)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        from vericone._load import module

        if not name.startswith("_"):
            space = self._type.__module__.removeprefix("vericone").removeprefix(".")
            question = module("_core")._names["_many"].get(f"{space + '.' if space else ''}{self._type.__qualname__}.{name}")
            if question is not None:
                return functools.partial(question, self.objects)
            raise AttributeError(f"many of {self._type.__name__} have no question '{name}'", name=name, obj=self)
        raise AttributeError(f"'Many' object has no attribute '{name}'", name=name, obj=self)


def many(objects: Sequence[Any] | npt.NDArray[Any]) -> Many:
    """These objects, to be asked together: many(pairs).miss(v_a, v_b)."""
    return Many(objects)
