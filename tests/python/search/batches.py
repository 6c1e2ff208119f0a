#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""batches.py [--calls N] [--seed S]: asks everything that takes one or many with several arguments one by one, and then
with all of them at once: the answers must be the same. The last line of standard output is JSON: names, compared, differ,
never (what nothing was found for that it answers)."""

import argparse
import copy
import enum
import inspect
import json
import os
import random
import re
import sys
import tempfile
from typing import Any

import numpy as np

import vericone

import signatures

from any_calls import DOCUMENTED, Arguments, Calls, described, prepare
from made import objects

QUESTIONS = 5
TRIES = 40  # of arguments, until as many are answered


def agrees(one: Any, row: Any) -> bool:
    """An answer to one question, and its place in the array of many."""
    if one is None:
        if getattr(row, "dtype", None) is not None and row.dtype.names:
            return all(agrees(None, row[name]) for name in row.dtype.names)
        if getattr(row, "dtype", None) is not None and row.dtype.kind in "iub":
            return True  # beside numbers that are NaN
        return row is None or bool(np.all(np.isnan(np.asarray(row, dtype=float))))
    if isinstance(one, tuple) and isinstance(row, tuple):
        return len(one) == len(row) and all(map(agrees, one, row))
    if isinstance(one, enum.IntEnum) or isinstance(one, (bool, np.bool_)):
        return int(one) == int(row)
    if isinstance(one, (float, int, np.ndarray)):
        return np.array_equal(np.asarray(one), np.asarray(row), equal_nan=np.asarray(one).dtype.kind == "f")
    names = getattr(getattr(row, "dtype", None), "names", None)
    if names:
        return all(agrees(getattr(one, name)() if callable(getattr(one, name)) else getattr(one, name), row[name]) for name in names)
    if isinstance(one, vericone.Interval) and isinstance(row, np.ndarray):
        return agrees(one.lo(), row[0]) and agrees(one.hi(), row[1])
    return bool(one == row) or repr(one) == repr(row)


def stacked(values: list[Any]) -> Any:
    """Arguments of several questions as one."""
    if isinstance(values[0], (int, float, np.ndarray, list)) and not isinstance(values[0], enum.Enum):
        return np.stack([np.asarray(value, dtype=float) for value in values])
    together = np.empty(len(values), object)
    together[:] = values
    return together


def fits(value: Any, annotation: str) -> bool:
    """Whether it is one of what a parameter that may be many takes: a number, a vector or an object."""
    if annotation == "_Number":
        return isinstance(value, float)
    if annotation == "Sequence[_Number]":
        return isinstance(value, np.ndarray) and value.dtype == np.float64 and value.ndim == 1
    return type(value).__module__.startswith("vericone")


def kind(value: Any) -> Any:
    """What the arguments of several questions have in common."""
    return value.shape if isinstance(value, np.ndarray) else type(value)


class Batches:
    def __init__(self, seed: int) -> None:
        self.draw = random.Random(seed)
        self.calls = Calls()
        self.given = objects()
        self.compared = 0
        self.names: set[str] = set()
        self.never: list[str] = []
        self.differ: dict[str, str] = {}

    def questions(self, chosen: Any) -> list[list[str]]:
        """The parameters that may be many, as its docstring names them."""
        whole = getattr(self.class_of(chosen.owner), chosen.target) if chosen.owner and chosen.kind == "method" else chosen.target
        lines = re.findall(r"One or many: ([\w, ]+) broadcast", inspect.getdoc(whole) or "")
        return [list(names) for names in dict.fromkeys(tuple(name.strip() for name in line.split(",")) for line in lines)]

    def class_of(self, name: str) -> Any:
        value: Any = vericone
        for part in name.split("."):
            value = getattr(value, part)
        return value

    def compare(self, chosen: Any, signature: Any, many: list[str]) -> bool:
        """Whether there was something to compare."""
        arguments = Arguments(self.draw, self.calls.pool)
        kinds = {name: annotation for name, annotation, _, _ in signature.parameters}
        if not {*many, "threads"} <= set(kinds) or signature.returns == "Any":
            return False
        target = chosen.target
        receiver = None
        if chosen.owner and chosen.kind == "method":
            own = self.calls.pool.get(chosen.owner)
            if not own:
                return False
            receiver = arguments.one_of(own)
            try:
                if copy.copy(receiver) is not receiver and not hasattr(receiver, "replace"):
                    return False  # it has a memory, and is no record
            except TypeError:
                return False
            target = getattr(receiver, chosen.target)
        kept = {name: arguments.of_kind(annotation) for name, annotation, optional, _ in signature.parameters
                if name not in many and name not in ("threads", "rung", "effort") and (not optional or self.draw.random() < 0.3)}
        length = self.draw.choice([3, 3, 2])
        asked: list[dict[str, Any]] = []
        answers: list[Any] = []
        for _ in range(TRIES):
            some = {name: self.question(kinds[name], length) for name in many}
            if not all(fits(some[name], kinds[name]) for name in many):
                continue
            if asked and any(kind(some[name]) != kind(asked[0][name]) for name in many):
                continue
            try:
                answers.append(target(**kept, **some))
                asked.append(some)
            except DOCUMENTED:
                continue
            except RuntimeError:
                return False
            if len(asked) == QUESTIONS:
                break
        if len(asked) < 2:
            return False
        together = {name: stacked([some[name] for some in asked]) for name in many}
        # All many; then the last of them one, which all share.
        for shared in [None, many[-1]] if len(many) > 1 else [None]:
            use = dict(together)
            expected = answers
            if shared:
                use[shared] = asked[0][shared]
                try:
                    expected = [target(**kept, **{**some, shared: asked[0][shared]}) for some in asked]
                except (*DOCUMENTED, RuntimeError):
                    continue
            try:
                got = target(**kept, **use, **({"threads": 2} if self.draw.random() < 0.3 else {}))
            except (*DOCUMENTED, RuntimeError) as error:
                self.differ[chosen.name] = f"many: {type(error).__name__}: {error}; {described(list(use.values()))}"
                return True
            rows = list(zip(*got)) if isinstance(got, tuple) else got
            for one, row, some in zip(expected, rows, asked):
                self.compared += 1
                if not agrees(one, row):
                    self.differ[chosen.name] = f"{described(row)} instead of {described(one)} for {some!r:.400}"
        self.names.add(chosen.name)
        return True

    def question(self, annotation: str, length: int) -> Any:
        if annotation == "_Number":
            return self.draw.uniform(0.1, 5)
        if annotation == "Sequence[_Number]":
            return np.array([self.draw.uniform(-5, 5) for _ in range(length)])
        return Arguments(self.draw, self.calls.pool).of_kind(annotation)

    def run(self, calls: int, rounds: int) -> None:
        while self.calls.calls < calls:
            self.calls.make(self.draw)
        for chosen in self.calls.callables:
            many = self.questions(chosen)
            if not many:
                continue
            done = 0
            for _ in range(rounds * 20):
                for thing in self.given:  # not lost among what was drawn
                    self.calls.keep(thing, self.draw)
                for signature in chosen.signatures:
                    own = {name for name, annotation, _, _ in signature.parameters}
                    fitting = [names for names in many if set(names) <= own]
                    if fitting:
                        done += self.compare(chosen, signature, max(fitting, key=len))
                if done >= rounds:
                    break
            if not done:
                self.never.append(chosen.name)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=4_000, help="calls that make objects to ask")
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--seed", type=int, default=4)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        prepare()
        batches = Batches(options.seed)
        batches.run(options.calls, options.rounds)
        os.chdir("/")
    for name, text in batches.differ.items():
        print(f"{name}: {text}")
    print(json.dumps({"names": len(batches.names), "compared": batches.compared, "differ": sorted(batches.differ), "never": batches.never}))
    return 1 if batches.differ else 0


if __name__ == "__main__":
    sys.exit(main())
