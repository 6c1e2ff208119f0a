#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""leaks.py [--calls N] [--repeats N]: makes calls of everything in the package (any_calls.py), then each of them again and
again, answered and refused ones, and counts the bytes that stay allocated. Run it with PYTHONMALLOC=malloc, so that every
byte is counted. The last line of standard output is JSON: calls, names, leaks (bytes that each call leaves behind)."""

import argparse
import ctypes
import gc
import json
import os
import random
import sys
import tempfile
from typing import Any

from any_calls import DOCUMENTED, Calls, prepare

# What memory of a call may stay: caches of Python and numpy fill up, but not by more and more with every call.
MOST_BYTES_A_CALL = 8  # a block has 24 or more: of every third call
# Of each thread that has built a scene Embree keeps some 200 bytes (a program of C++ alone shows it); long calls have a
# thread of their own.
KEPT_BY_OTHERS = {"lidar.MeshScene": 300}


class MallInfo(ctypes.Structure):
    """struct mallinfo2 of glibc."""

    _fields_ = [(name, ctypes.c_size_t) for name in ("arena", "ordblks", "smblks", "hblks", "hblkhd", "usmblks", "fsmblks", "uordblks",
                                                     "fordblks", "keepcost")]


LIBC = ctypes.CDLL(None)
LIBC.mallinfo2.restype = MallInfo


def allocated() -> int:
    """Bytes in use, of all threads."""
    info = LIBC.mallinfo2()
    return int(info.uordblks + info.hblkhd)


def repeat(example: tuple[Any, list[Any], dict[str, Any]], times: int) -> None:
    target, positional, named = example
    for _ in range(times):
        try:
            target(*positional, **named)
        except (*DOCUMENTED, RuntimeError):  # files that cannot be written
            pass


def left_by(example: tuple[Any, list[Any], dict[str, Any]], times: int) -> float:
    """Bytes a call. What grows by less and less, or once, is a cache: the least of three series counts."""
    repeat(example, 20)
    least = float("inf")
    for collected in (False, True, True):
        if collected:
            gc.collect()
        before = allocated()
        repeat(example, times)
        if collected:
            gc.collect()
        least = min(least, (allocated() - before) / times)
        if least <= MOST_BYTES_A_CALL:
            break
    return least


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=10_000)
    parser.add_argument("--repeats", type=int, default=100)
    parser.add_argument("--seed", type=int, default=5)
    options = parser.parse_args()
    if os.environ.get("PYTHONMALLOC") != "malloc":
        sys.exit("PYTHONMALLOC: got nothing, must be malloc, or Python's own memory is not counted")
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        prepare()
        calls, draw = Calls(), random.Random(options.seed)
        while calls.calls < options.calls:
            calls.make(draw)
        gc.freeze()  # what is there by now need not be looked at by every collection below
        leaks: dict[str, float] = {}
        count = 0
        for (name, answered), examples in sorted(calls.examples.items(), key=lambda item: item[0]):
            for example in examples:
                times = options.repeats
                left = left_by(example, times)
                count += times
                # A block that the heap took once, or a cache: numpy's own, of what it makes of a timedelta64, is full
                # after some 5,000 calls and 40 kB. What leaks goes on leaking.
                for _ in range(2):
                    if left > MOST_BYTES_A_CALL:
                        times *= 20
                        left = left_by(example, times)
                if left > KEPT_BY_OTHERS.get(name, MOST_BYTES_A_CALL):
                    leaks[f"{name}{'' if answered else ', refused'}"] = left
        os.chdir("/")
    print(json.dumps({"calls": count, "names": len({name for name, _ in calls.examples}), "leaks": leaks}))
    return 1 if leaks else 0


if __name__ == "__main__":
    sys.exit(main())
