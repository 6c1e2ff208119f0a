#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""any_calls.py [--calls N] [--seed S] [--most PART]: calls everything in the package with arguments of every kind, and of
the kinds that are asked for. Nothing may crash; what is raised must be one of the documented exceptions; and no call may
take long and hear nothing of an interruption. Works in a folder of its own that it removes.

The last line of standard output is JSON: calls, answered, faults. While it runs, the file --log holds the call that is
being made, so that whoever finds it dead knows why."""

import argparse
import copy
import enum
import faulthandler
import fractions
import json
import os
import pickle
import random
import resource
import signal
import sys
import tempfile
import time
import types
from decimal import Decimal
from typing import Any, Callable as Function

import numpy as np

import signatures

import vericone

SECONDS_A_CALL = 1.0  # then it is interrupted
DEAF_SECONDS = 20  # then it has not heard
MOST_BYTES = 6 * 2**30  # of address space: what asks for more gets a MemoryError
KEPT = 6  # objects of a type
EXAMPLES, QUICK_SECONDS = 2, 2e-3  # of calls of one name


class Own(Exception):
    """What an object of the caller raises: it comes back as it is."""


class TooLong(BaseException):
    """What the alarm raises, as Ctrl-C raises KeyboardInterrupt."""


# ImportError: of a part that was not built. RuntimeError: what fails beside the input, such as a codec; it has a text.
DOCUMENTED = (vericone.InputError, TypeError, MemoryError, OSError, ImportError, TooLong, Own)

DTYPES = ["?", "i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f2", "f4", "f8", "g", "c8", "c16", "O", "U3", "S3", "M8[s]", "m8[s]",
          ">f8", ">i4", "V8", "f8,i4"]
NUMBERS: list[Any] = [0, 1, -1, 2, 3, 7, 100, 2**31, -(2**31), 2**53 + 1, 2**63, -(2**64), 10**400, 0.0, -0.0, 0.5, 1.0, 3.25, -2.0,
                      1e-320, 1e-160, 1e-9, 1e9, 1e160, 1.7e308, float("inf"), float("-inf"), float("nan"), True, False, 1j,
                      fractions.Fraction(1, 3), fractions.Fraction(10**400, 3), Decimal("0.1"), np.float32(0.1), np.int8(-3), np.uint64(2**64 - 1),
                      np.longdouble("0.1"), np.float64(2.5), np.bool_(True)]
TEXTS: list[Any] = ["", "a", "in", "scene.yaml", "a.ply", "\0", "ü∞", "x" * 5000, b"", b"ab", "..", "no/such/folder/file.obj", "\udc80"]


class Strange:
    """Whatever is asked of it is refused."""

    def __getattr__(self, name: str) -> Any:
        raise Own(name)

    def __repr__(self) -> str:
        return "Strange()"


class Liar:
    """Says that it is an array and a sequence, and is none."""

    __array_interface__ = {"shape": (3,), "typestr": "<f8", "version": 3, "data": None}

    def __len__(self) -> int:
        return 3

    def __getitem__(self, index: Any) -> Any:
        raise IndexError(index) if index else Own("no")

    def __float__(self) -> float:
        raise Own("no float")

    def __index__(self) -> int:
        return 2**70

    def __repr__(self) -> str:
        return "Liar()"


class Clearing:
    """A number in a list that it empties when it is asked for its value."""

    def __init__(self, home: list[Any]) -> None:
        self.home = home

    def __float__(self) -> float:
        self.home.clear()
        return 1.0

    def __index__(self) -> int:
        self.home.clear()
        return 1

    def __repr__(self) -> str:
        return "Clearing()"


def clearing(length: int, at: int, rows: int) -> list[Any]:
    """A list of numbers, or of `rows` of them, that is emptied while it is read."""
    home: list[Any] = [1.0] * length
    home[at % length] = Clearing(home)
    if not rows:
        return home
    outer: list[Any] = [home, *([1.0] * length for _ in range(rows))]
    outer[-1][0] = Clearing(outer)
    return outer


class Arguments:
    """Draws values, from what `draw` chooses; hypothesis can choose for it, and makes a counterexample small."""

    def __init__(self, draw: random.Random, pool: dict[str, list[Any]]) -> None:
        self.draw = draw
        self.pool = pool

    def one_of(self, choices: Any) -> Any:
        return choices[self.draw.randrange(len(choices))]

    def shape(self) -> tuple[int, ...]:
        common = [(3,), (3,), (2,), (5, 3), (4, 2), (3, 3), (2, 2), (4, 4), (2, 4, 3), (1, 3), (0, 3), (), (0,), (1,), (6,), (7,), (3, 0), (1, 1, 1, 1, 3)]
        if self.draw.random() < 0.85:
            return self.one_of(common)  # type: ignore[no-any-return]
        return tuple(self.draw.randrange(5) for _ in range(self.draw.randrange(7)))

    def floats(self, shape: tuple[int, ...]) -> "np.ndarray[Any, np.dtype[np.float64]]":
        count = int(np.prod(shape))
        scale = self.one_of([1.0, 1.0, 1.0, 10.0, 1e-6, 1e6, 1e150])
        values = [self.draw.uniform(-scale, scale) for _ in range(count)]
        if count and self.draw.random() < 0.15:
            values[self.draw.randrange(count)] = self.one_of([float("nan"), float("inf"), 0.0, 1e308, 5e-324])
        return np.array(values, dtype=float).reshape(shape)

    def array(self) -> Any:
        made: Any = self.floats(self.shape())
        if self.draw.random() < 0.4:
            with np.errstate(all="ignore"):
                try:
                    made = made.astype(np.dtype(self.one_of(DTYPES)))
                except (TypeError, ValueError, OverflowError):
                    pass
        how = self.draw.randrange(8)
        if how == 0:
            made = np.asfortranarray(made)
        elif how == 1 and made.ndim:
            made = np.repeat(made, 2, axis=0)[::2]
        elif how == 2 and made.ndim:
            made = made[::-1]
        elif how == 3:
            made = np.broadcast_to(made, (2, *made.shape))
        elif how == 4:
            made.setflags(write=False)
        elif how == 5 and made.dtype.kind in "fiu":
            made = made.tolist()
        elif how == 6:
            made = np.ma.masked_array(made)
        return made

    def thing(self) -> Any:
        """Anything at all."""
        kind = self.draw.randrange(8)
        if kind == 0:
            return self.one_of(NUMBERS)
        if kind == 1:
            return self.one_of(TEXTS)
        if kind in (2, 3):
            return self.array()
        if kind in (4, 5) and self.pool:
            return self.one_of(self.pool[self.one_of(sorted(self.pool))])
        if kind == 6:
            return self.one_of([None, ..., (), [], {}, set(), object(), Strange(), Liar(), int, vericone, vericone.InputError, len, iter([1]), range(3),
                                slice(None), memoryview(b"12345678"), bytearray(8), np.dtype("f8"), np.array(None), lambda *a, **k: None, NotImplemented,
                                clearing(self.one_of([2, 3, 3, 4, 6]), self.draw.randrange(6), self.one_of([0, 0, 1, 3]))])
        return [self.thing() for _ in range(self.draw.randrange(4))]

    def of_kind(self, annotation: str) -> Any:
        """What the parameter asks for, mostly."""
        words = [word for word in annotation.replace("|", " ").replace("[", " ").replace("]", " ").replace(",", " ").split() if word]
        known = [name for word in words for name in self.pool if name == word.strip("'\"") or name.endswith("." + word.strip("'\"").split(".")[-1])
                 or name == word.strip("'\"").split(".")[-1]]
        choices: list[Function[[], Any]] = []
        if known:
            choices += [lambda: self.one_of(self.pool[self.one_of(known)])] * 4
            if any(word.split(".")[-1] in ("Sequence", "list", "Iterable") for word in words):
                choices += [lambda: [self.one_of(self.pool[self.one_of(known)]) for _ in range(self.draw.randrange(4))]] * 4
        if any("rray" in word for word in words) or "Sequence" in words and "_Number" in words:
            shape = self.one_of([(3,), (3,), (3,), (2,), (2,), (3, 3), (2, 2), (4,), (5, 3), (6, 2), (20, 3)])
            choices += [lambda: self.floats(shape), lambda: abs(self.floats(shape)), lambda: np.eye(3), self.array]
        for word in words:
            name = word.split(".")[-1]
            if name in ("float", "_Number"):
                choices += [lambda: self.draw.uniform(-5, 5), lambda: self.draw.uniform(0, 1), lambda: self.one_of(NUMBERS)]
            elif name == "_Exact":
                choices += [lambda: fractions.Fraction(self.draw.randrange(-9, 9), self.draw.randrange(1, 9))]
            elif name == "Callable":
                choices += [lambda: lambda *_: None, lambda: lambda *_: True]
            elif name in ("int", "SupportsIndex"):
                choices += [lambda: self.draw.randrange(-2, 20), lambda: self.draw.randrange(1, 5), lambda: self.one_of(NUMBERS)]
            elif name == "bool":
                choices += [lambda: self.draw.random() < 0.5]
            elif name in ("str", "Path", "PathLike"):
                choices += [lambda: self.one_of(TEXTS)]
            elif name == "None":
                choices += [lambda: None]
        return self.one_of(choices)() if choices else self.thing()

    def for_call(self, signature: signatures.Signature) -> tuple[list[Any], dict[str, Any]]:
        wild = self.draw.random() < 0.25
        positional: list[Any] = []
        named: dict[str, Any] = {}
        for name, annotation, optional, by_name in signature.parameters:
            if optional and self.draw.random() < 0.6:
                by_name = True
                if self.draw.random() < 0.7:
                    continue
            value = self.thing() if wild or self.draw.random() < 0.1 else self.of_kind(annotation)
            if by_name or named:
                named[name] = value
            else:
                positional.append(value)
        if self.draw.random() < 0.03:
            positional.append(self.thing())
        if self.draw.random() < 0.03:
            named[self.one_of(["threads", "rung", "progress", "nothing", "agent"])] = self.thing()
        # One at a time: what many threads share is tested elsewhere, and takes the machine.
        if isinstance(named.get("threads"), int):
            named["threads"] = min(named["threads"], 2)
        return positional, named


class Spoiler:
    """Changes something deep inside a value that was answered: an index, a number, a length, a part that is another's."""

    INDICES = (-1, 0, 1, 2, 3, 5, 17, 1000, 2**20, 2**31 - 1, -(2**31))
    NUMBERS = (0.0, -1.0, 1e-300, 1e300, float("nan"), float("inf"))

    def __init__(self, draw: random.Random, pool: dict[str, list[Any]]) -> None:
        self.draw = draw
        self.pool = pool

    def fields(self, record: Any) -> list[str]:
        return [name for name, own in vars(type(record)).items() if isinstance(own, types.GetSetDescriptorType)]

    def spoilt(self, value: Any, depth: int = 0) -> Any:
        draw = self.draw
        if isinstance(value, enum.Enum):
            return draw.choice(list(type(value)))
        if isinstance(value, (bool, str, bytes, type(None))) or depth > 6:
            return value
        if isinstance(value, (int, np.integer)):
            return draw.choice([*self.INDICES, int(value) + 1, int(value) - 1])
        if isinstance(value, (float, np.floating)):
            return draw.choice([*self.NUMBERS, -float(value), float(value) * draw.uniform(0.5, 2)])
        if isinstance(value, np.ndarray) and value.dtype.names is None:
            changed = value.copy()
            if changed.ndim and len(changed) and draw.random() < 0.5:
                return draw.choice([changed[:-1], changed[:0], changed[1:], np.concatenate([changed, changed[:1]])])
            if changed.size:
                flat = changed.reshape(-1)
                flat[draw.randrange(flat.size)] = self.spoilt(flat[draw.randrange(flat.size)].item(), depth + 1)
            return changed
        if isinstance(value, (list, tuple)):
            parts = list(value)
            how = draw.randrange(6)
            if how == 0:
                parts = parts[:-1]
            elif how == 1:
                parts = parts + parts[:1]
            elif how == 2 and depth > 0:
                parts = []
            elif parts:
                i = draw.randrange(len(parts))
                parts[i] = self.spoilt(parts[i], depth + 1)
            return type(value)(parts) if type(value) in (list, tuple) else parts
        if hasattr(value, "replace") and (fields := self.fields(value)):
            deep = [name for name in fields if not isinstance(getattr(value, name), (bool, str, bytes, type(None)))]
            if deep:
                name = draw.choice(deep)
                return value.replace(**{name: self.spoilt(getattr(value, name), depth + 1)})
            return value
        kind = type(value)
        others = next((own for own in self.pool.values() if type(own[0]) is kind), None)
        return draw.choice(others) if others else value


def described(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return f"array({str(value.tolist())[:200]}, dtype={value.dtype}, shape={value.shape}, strides={value.strides})"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(described, value[:5])) + "]"
    return repr(value)[:300]


class Calls:
    """Calls the package; remembers what it returned, for later arguments, and what went wrong."""

    def __init__(self, log: int | None = None, most: str = "") -> None:
        # What draws is Python, of matplotlib's manners.
        self.callables = [c for c in signatures.callables(vericone) if not c.name.startswith(("plot.", "display."))
                          and not (isinstance(c.target, type) and issubclass(c.target, (enum.Enum, BaseException)))]
        self.functions = {c.name for c in self.callables if c.kind != "property" and c.target != "replace"}
        # Called most; what they take comes from the others.
        self.favoured = [c for c in self.callables if c.name.startswith(tuple(most.split(",")))]
        self.pool: dict[str, list[Any]] = {}
        self.complete = False  # nothing comes to the pool any more
        self.faults: dict[str, str] = {}
        self.answered: dict[str, int] = {}
        self.overloads: dict[str, set[int]] = {}  # that answered
        self.calls = 0
        self.log = log
        self.late: list[str] = []  # calls that were interrupted
        # Of each name, calls that were answered and calls that were refused, quickly: (what, arguments, named ones).
        self.examples: dict[tuple[str, bool], list[tuple[Any, list[Any], dict[str, Any]]]] = {}

    def keep(self, value: Any, draw: random.Random, depth: int = 0) -> None:
        if self.complete:
            return
        kind = type(value)
        if kind.__module__.split(".")[0] == "vericone" and not isinstance(value, np.ndarray):
            name = kind.__qualname__
            space = kind.__module__.removeprefix("vericone").lstrip("._")
            own = self.pool.setdefault(f"{space}.{name}" if space and not space.startswith("_") else name, [])
            if len(own) < KEPT:
                own.append(value)
            else:
                own[draw.randrange(KEPT)] = value
        elif isinstance(value, (list, tuple)) and depth < 2:
            for part in value[:4]:
                self.keep(part, draw, depth + 1)

    def begin_with_examples(self, draw: random.Random) -> None:
        """Calls that are answered, to spoil."""
        import examples

        def ask(name: str, /, *positional: Any, **named: Any) -> Any:
            target: Any = vericone
            for part in name.split("."):
                target = getattr(target, part)
            answer = target(*positional, **named)
            self.keep(answer, draw)
            if name in self.functions:
                self.examples.setdefault((name, True), []).append((target, list(positional), named))
            return answer

        for group in examples.ALL:
            try:
                group(ask)
            except (ImportError, AttributeError):  # of parts that were not built
                pass

    def make(self, draw: random.Random) -> str | None:
        """One call. What is wrong with it, if something is."""
        arguments = Arguments(draw, self.pool)
        chosen = arguments.one_of(self.favoured if self.favoured and draw.random() < 0.7 else self.callables)
        positional, named = arguments.for_call(arguments.one_of(chosen.signatures) if chosen.signatures else signatures.Signature())
        target = chosen.target
        if chosen.owner and chosen.kind != "static":
            own = self.pool.get(chosen.owner)
            if not own:
                return None  # none was made yet
            # The receiver is the first of what is given.
            if chosen.kind == "property":
                positional, named = [], {}
                target = lambda receiver: getattr(receiver, chosen.target)  # noqa: E731
            else:
                target = lambda receiver, /, *some, **others: getattr(receiver, chosen.target)(*some, **others)  # noqa: E731
            positional.insert(0, arguments.one_of(own))
        return self.run(chosen.name, target, positional, named, draw)

    def spoil(self, draw: random.Random) -> str | None:
        """A call that was answered, with one of its arguments spoilt."""
        answered = [key for key, examples in self.examples.items() if key[1] and examples and key[0] in self.functions]
        if not answered:
            return None
        name, _ = draw.choice(answered)
        target, positional, named = draw.choice(self.examples[name, True])
        places: list[Any] = [*range(len(positional)), *named]
        if not places:
            return None
        positional, named, place = list(positional), dict(named), draw.choice(places)
        given = positional if isinstance(place, int) else named
        try:
            given[place] = Spoiler(draw, self.pool).spoilt(given[place])
        except (*DOCUMENTED, ValueError, OverflowError):
            return None  # the record itself refuses it
        return self.run(name, target, positional, named, draw)

    def also(self, draw: random.Random) -> str | None:
        """What every value can: print, compare, copy, pickle, be changed into another."""
        if not self.pool:
            return None
        arguments = Arguments(draw, self.pool)
        value, other = arguments.thing(), arguments.thing()
        if type(value).__module__.split(".")[0] != "vericone":
            value = arguments.one_of(self.pool[arguments.one_of(sorted(self.pool))])
        name = type(value).__qualname__

        def operators() -> None:
            for use in (repr, str, hash, copy.copy, copy.deepcopy, pickle.dumps, dir, lambda v: v == other, lambda v: v != other, lambda v: v == v,
                        lambda v: list(v)[:3], lambda v: v[0], lambda v: len(v), lambda v: v.__reduce_ex__(2), lambda v: v < other):
                try:
                    use(value)
                except (TypeError, IndexError, pickle.PicklingError):
                    pass
                except (AttributeError, ValueError) as error:
                    # Of a function of the caller that cannot be pickled; of numpy, asked for the truth of an array.
                    if "pickle" not in str(error) and "truth value" not in str(error):
                        raise
            with_state = type(value)
            if isinstance(value, enum.Enum):
                return  # what is none of its members is a ValueError of Python's own
            for use in (lambda: with_state.__new__(with_state), lambda: with_state(other), 
                        lambda: setattr(value, arguments.one_of(["x", "center", "replace"]), other), lambda: value.replace(**{"threads": other})):
                try:
                    self.keep(use(), draw)
                except (TypeError, AttributeError, vericone.InputError):
                    pass

        return self.run(f"operators of {name}", operators, [], {}, draw)

    def run(self, name: str, target: Any, positional: list[Any], named: dict[str, Any], draw: random.Random) -> str | None:
        text = f"{name}({', '.join([*map(described, positional), *(f'{key}={described(value)}' for key, value in named.items())])})"
        if self.log is not None:
            os.ftruncate(self.log, 0)
            os.pwrite(self.log, f"{self.calls}: {text}\n".encode("utf-8", "backslashreplace"), 0)
        self.calls += 1
        wrong: BaseException | None = None
        answered = False
        began = time.perf_counter()
        faulthandler.dump_traceback_later(DEAF_SECONDS, exit=True)
        signal.setitimer(signal.ITIMER_REAL, SECONDS_A_CALL)
        try:
            try:
                result = target(*positional, **named)
            finally:
                signal.setitimer(signal.ITIMER_REAL, 0)
            answered = True
            if name in self.functions and hasattr(vericone, "_core"):
                self.overloads.setdefault(name, set()).add(vericone._core._answered_overload())
            self.answered[name] = self.answered.get(name, 0) + 1
            self.keep(result, draw)
        except vericone.InputError as error:
            if not error.field or not error.requirement or "\n" in str(error):
                wrong = error
        except DOCUMENTED as error:
            if isinstance(error, TooLong):
                self.late.append(text[:1000])
        except RuntimeError as error:
            if not str(error) or "has no text" in str(error):
                wrong = error
        except BaseException as error:  # pylint: disable=broad-except
            wrong = error
        finally:
            faulthandler.cancel_dump_traceback_later()
        own = self.examples.setdefault((name, answered), [])
        if time.perf_counter() - began < QUICK_SECONDS:
            if len(own) < EXAMPLES:
                own.append((target, positional, named))
            elif draw.random() < 0.2:
                own[draw.randrange(EXAMPLES)] = (target, positional, named)
        if wrong is None:
            return None
        fault = f"{name}: {type(wrong).__name__}: {str(wrong)[:160]}"
        self.faults.setdefault(f"{name}: {type(wrong).__name__}", f"{fault}\n  {text[:1000]}")
        return f"{fault}\n  {text[:1000]}"


    def wait_for_left(self) -> None:
        """What was interrupted and left behind ends at last."""
        left = getattr(getattr(vericone, "_core", None), "_left_behind", lambda: 0)
        began = time.perf_counter()
        while left() and time.perf_counter() - began < DEAF_SECONDS:
            time.sleep(0.05)
        if left():
            self.faults["deaf"] = "one of these never ends:\n  " + "\n  ".join(self.late)


def prepare() -> None:
    """This process is for calls alone."""
    faulthandler.enable()

    def alarm(*_: object) -> None:
        raise TooLong

    signal.signal(signal.SIGALRM, alarm)
    if "VERICONE_PRELOAD" not in os.environ:  # sanitizers reserve terabytes
        resource.setrlimit(resource.RLIMIT_AS, (MOST_BYTES, MOST_BYTES))
    resource.setrlimit(resource.RLIMIT_FSIZE, (2**26, 2**26))
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    # Whoever reads from it, gets nothing.
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)


def search(calls: Calls, examples: int) -> None:
    """Calls that hypothesis chooses, and makes small where one is wrong: it raises AssertionError then."""
    import hypothesis
    from hypothesis import strategies

    calls.complete = True  # what it draws must not depend on what it has drawn

    @hypothesis.settings(max_examples=examples, deadline=None, derandomize=True, database=None,
                         suppress_health_check=list(hypothesis.HealthCheck))
    @hypothesis.given(strategies.randoms(use_true_random=False))
    def one(draw: random.Random) -> None:
        wrong = calls.make(draw)
        assert wrong is None, wrong

    one()


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--hypothesis", type=int, default=0, help="examples that hypothesis chooses afterwards")
    parser.add_argument("--most", default="", help="what the names begin with that are called most, by commas: guidance.,lidar.")
    parser.add_argument("--without", nargs="*", default=[], help="names that are not called, to look for further faults")
    parser.add_argument("--bare", action="store_true", help="begin without objects: of a package that has none of vericone's")
    parser.add_argument("--log", default="", help="file for the call that is being made")
    options = parser.parse_args()
    log = os.open(options.log, os.O_RDWR | os.O_CREAT, 0o644) if options.log else None
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        prepare()
        calls = Calls(log, options.most)
        calls.callables = [c for c in calls.callables if c.name not in options.without]
        calls.favoured = [c for c in calls.favoured if c.name not in options.without]
        draw = random.Random(options.seed)
        if not options.bare:
            import made

            for thing in made.objects():
                calls.keep(thing, draw)
            if not options.most:
                calls.begin_with_examples(draw)
        while calls.calls < options.calls:
            faulthandler.dump_traceback_later(2 * DEAF_SECONDS, exit=True)  # what is printed and compared can wait for ever too
            kind = draw.random()
            if kind < 0.05:
                calls.also(draw)
            elif kind < 0.35:
                calls.spoil(draw)
            else:
                calls.make(draw)
        faulthandler.cancel_dump_traceback_later()
        if options.hypothesis and not calls.faults:
            search(calls, options.hypothesis)
        calls.wait_for_left()
        os.chdir("/")
    never = [c.name for c in calls.callables if c.name not in calls.answered]
    for fault in calls.faults.values():
        print(fault)
    print(json.dumps({"calls": calls.calls, "callables": len(calls.callables), "answered": sum(calls.answered.values()), "never": never,
                      "overloads": {name: sorted(own) for name, own in calls.overloads.items()}, "faults": len(calls.faults)}), flush=True)
    if "deaf" in calls.faults:
        os._exit(1)  # Python would wait for it
    return 1 if calls.faults else 0


if __name__ == "__main__":
    sys.exit(main())
