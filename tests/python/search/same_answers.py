#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""same_answers.py [--calls N] [--threads N]: makes calls of everything in the package (any_calls.py), then each of those
that were answered from several threads at once, on the same objects: the answers are those of one thread. The last line
of standard output is JSON: names, compared, differ."""

import argparse
import copy
import json
import os
import random
import sys
import tempfile
import threading
from typing import Any

import numpy as np

from any_calls import DOCUMENTED, Calls, described, prepare


def same(a: Any, b: Any) -> bool:
    """Equal to the bit; NaN is NaN."""
    if type(a) is not type(b):
        return False
    if isinstance(a, np.ndarray):
        return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()
    if isinstance(a, (list, tuple)):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, float):
        return a == b or (a != a and b != b)
    return bool(a == b) or repr(a) == repr(b)


def changes(thing: Any) -> bool:
    """Whether it is an object that calls change: a copy of one that never changes is itself."""
    if type(thing).__module__.split(".")[0] != "vericone":
        return False
    try:
        return copy.copy(thing) is not thing
    except TypeError:
        return True


def answer(example: tuple[Any, list[Any], dict[str, Any]]) -> Any:
    target, positional, named = example
    try:
        return target(*positional, **named)
    except DOCUMENTED as error:
        return f"{type(error).__name__}: {error}"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=5_000)
    parser.add_argument("--threads", type=int, default=8)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seed", type=int, default=9)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        prepare()
        calls, draw = Calls(), random.Random(options.seed)
        while calls.calls < options.calls:
            calls.make(draw)
        examples = [(name, example) for (name, answered), own in sorted(calls.examples.items(), key=lambda item: item[0]) if answered
                    for example in own]
        # What answers otherwise when it is asked again, as often as the threads will, has a memory, and what is
        # asked of an object that other calls change: all threads call it, and it is not compared.
        expected = [answer(example) for _, example in examples]
        again = options.threads * options.rounds + 1
        steady = [not any(map(changes, (getattr(example[0], "__self__", None), *example[1], *example[2].values()))) and
                  all(same(answer(example), was) for _ in range(again)) for (_, example), was in zip(examples, expected)]
        differ: dict[str, str] = {}
        start = threading.Barrier(options.threads)

        def work(number: int) -> None:
            order = list(range(len(examples)))
            random.Random(number % 2).shuffle(order)  # half of them side by side, half in another order
            for _ in range(options.rounds):
                start.wait()
                for i in order:
                    name, example = examples[i]
                    got = answer(example)
                    if steady[i] and not same(got, expected[i]):
                        differ[name] = f"{described(got)} instead of {described(expected[i])}"

        threads = [threading.Thread(target=work, args=(i,)) for i in range(options.threads)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        os.chdir("/")
    for name, text in differ.items():
        print(f"{name}: {text}")
    print(json.dumps({"names": len({name for name, _ in examples}), "compared": sum(steady), "differ": sorted(differ)}))
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main())
