#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""every_overload.py OVERLOADS.json: calls all that is public, each of its overloads, until it answers: what examples.py
says, and for what is left random arguments. Works in a folder of its own that it removes. The last line of standard
output is JSON: overloads, how many there are; examples_failed; missing, those that nothing was answered by. What this
build has not is in none of them, nor is what begins with verify, which is built apart."""

import importlib
import json
import os
import random
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import any_calls
import examples
import made
import signatures

import vericone

core: Any = importlib.import_module("vericone._core")

TRIES, SECONDS = 300, 2.0  # of calls with random arguments, for one name


class Absent(Exception):
    """What is asked for was not built."""


def absent_parts() -> set[str]:
    """Modules of the package that this build has not."""
    absent = {"verify"}
    for part in set(dir(vericone)) - {"plot"}:  # Python, and no overloads
        try:
            getattr(vericone, part)
        except ImportError:
            absent.add(part)
    return absent


class Asked:
    """Asks examples; remembers what answered, and which did not."""

    def __init__(self, calls: any_calls.Calls, absent: set[str]) -> None:
        self.calls = calls
        self.absent = absent
        self.draw = random.Random(1)
        self.failed: list[str] = []

    def __call__(self, name: str, /, *positional: Any, **named: Any) -> Any:
        """What vericone.NAME answers; None where it does not."""
        frame = sys._getframe(1)
        while frame.f_code is examples.each.__code__ and frame.f_back is not None:
            frame = frame.f_back
        place = f"{Path(examples.__file__).name}:{frame.f_lineno}"
        if name.split(".")[0] in self.absent:
            raise Absent(name)
        target: Any = vericone
        try:
            for part in name.split("."):
                target = getattr(target, part)
            answer = target(*positional, **named)
        except Exception as error:  # pylint: disable=broad-except
            self.failed.append(f"{place}: {name}: {type(error).__name__}: {str(error)[:400]}")
            return None
        self.calls.overloads.setdefault(name, set()).add(core._answered_overload())
        self.calls.keep(answer, self.draw)
        return answer

    def group(self, asks: Callable[[Callable[..., Any]], None]) -> None:
        """All of a group, or as much as was built."""
        try:
            asks(self)
        except Absent:
            pass
        except Exception as error:  # pylint: disable=broad-except
            if not (isinstance(error, ImportError) and len(self.absent) > 1):
                self.failed.append(f"{asks.__name__}(): {type(error).__name__}: {str(error)[:400]}")


def targets_of(calls: any_calls.Calls, own: signatures.Callable) -> list[tuple[Any, list[Any]]]:
    """What is called, and the object that is its first argument where there is one: each that is known."""
    if not own.owner or own.kind == "static":
        return [(own.target, [])]
    kind: Any = vericone
    for part in own.owner.split("."):
        kind = getattr(kind, part)
    return [(getattr(kind, own.target), [value]) for values in calls.pool.values() if isinstance(values[0], kind) for value in values]


def draw_for(calls: any_calls.Calls, own: signatures.Callable, count: int) -> None:
    """Calls of one callable until each of its `count` overloads answered: with nothing where that can do, then at random."""
    draw = random.Random(own.name)  # does not depend on the others
    arguments = any_calls.Arguments(draw, calls.pool)
    targets, taken = targets_of(calls, own), own.signatures or [signatures.Signature()]
    bare = targets if any(all(optional for _, _, optional, _ in signature.parameters) for signature in taken) else []
    began = time.perf_counter()
    for k in range(len(bare) + TRIES):
        if not targets or len(calls.overloads.get(own.name, ())) >= count or time.perf_counter() - began > SECONDS:
            return
        target, receiver = bare[k] if k < len(bare) else arguments.one_of(targets)
        positional, named = ([], {}) if k < len(bare) else arguments.for_call(taken[k % len(taken)])
        calls.run(own.name, target, [*receiver, *positional], named, draw)


def main() -> int:
    wanted = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        any_calls.prepare()
        calls, absent = any_calls.Calls(), absent_parts()
        asked = Asked(calls, absent)
        for thing in made.objects():
            calls.keep(thing, asked.draw)
        for group in examples.ALL:
            asked.group(group)
        wanted = {name: overloads for name, overloads in wanted.items() if name.split(".")[0] not in absent}
        left = {name for name, overloads in wanted.items() if len(calls.overloads.get(name, ())) < len(overloads)}
        for own in calls.callables:
            if own.name in left:
                draw_for(calls, own, len(wanted[own.name]))
        calls.wait_for_left()
        os.chdir("/")
    asked.failed += [f"{name}, overload {i}: answered, though examples.py says that nothing can be, {why}"
                     for (name, i), why in examples.UNREACHED.items() if i in calls.overloads.get(name, ())]
    missing = [f"{name}: {parameters}" for name, overloads in wanted.items() for i, parameters in enumerate(overloads)
               if i not in calls.overloads.get(name, ()) and (name, i) not in examples.UNREACHED]
    print(json.dumps({"overloads": sum(map(len, wanted.values())), "examples_failed": asked.failed, "missing": missing}), flush=True)
    if "deaf" in calls.faults:
        os._exit(1)  # Python would wait for it
    return 1 if asked.failed or missing else 0


if __name__ == "__main__":
    sys.exit(main())
