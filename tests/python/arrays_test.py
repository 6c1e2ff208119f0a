# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of questions: of any real type and layout, broadcast, refused at the very number that is wrong; and what values
are: compared, copied, pickled, derived from."""

from __future__ import annotations

import copy
import fractions
import math
import pickle
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import vericone
from any_calls import clearing

Array = npt.NDArray[Any]
AGENT, OBSTACLE = vericone.Ellipsoid(), vericone.Ellipsoid.from_axes([9, 1, 0], [2, 3, 1])
ORACLE, PAIR = vericone.ConeOracle(AGENT, OBSTACLE), vericone.Pair(AGENT, OBSTACLE)
VELOCITIES = np.random.default_rng(3).integers(-9, 10, size=(600, 3)).astype(float)
STILL = [0.0, 0.0, 0.0]


def answers(velocities: Any, **options: Any) -> tuple[Array, Array, Array]:
    return (ORACLE.membership(velocities, **options), PAIR.verdict(velocities, STILL, **options),
            vericone.clearance_ahead(ORACLE, velocities, STILL, **options))


def same(a: tuple[Array, ...], b: tuple[Array, ...]) -> bool:
    return all(x.tobytes() == y.tobytes() and x.shape == y.shape for x, y in zip(a, b))


EXPECTED = answers(VELOCITIES)


def test_many_are_what_each_is() -> None:
    for i in range(0, len(VELOCITIES), 7):
        w = VELOCITIES[i]
        assert ORACLE.membership(w) == EXPECTED[0][i] and PAIR.verdict(w, STILL) == EXPECTED[1][i]
        assert vericone.clearance_ahead(ORACLE, w, STILL) == EXPECTED[2][i]
    assert EXPECTED[0].dtype == EXPECTED[1].dtype == np.int8 and len(set(EXPECTED[0])) > 1


@pytest.mark.parametrize("dtype", ["i1", "i2", "i4", "i8", "f2", "f4", "f8", ">f8", ">f4", ">i4", ">i8", "<f8"])
@pytest.mark.parametrize("threads", [1, 2])
def test_any_real_type(dtype: str, threads: int) -> None:
    assert same(answers(VELOCITIES.astype(dtype), threads=threads), EXPECTED)


@pytest.mark.parametrize("dtype", ["u1", "u2", "u4", "u8"])
def test_natural_numbers(dtype: str) -> None:
    natural = abs(VELOCITIES)
    assert same(answers(natural.astype(dtype)), answers(natural))


def unaligned(a: Array) -> Array:
    room = np.empty(a.nbytes + 1, dtype="u1")[1:].view(a.dtype).reshape(a.shape)
    room[...] = a
    return room


def read_only(a: Array) -> Array:
    a = a.copy()
    a.setflags(write=False)
    return a


@pytest.mark.parametrize("layout", [
    np.asfortranarray, unaligned, read_only, np.ndarray.tolist,
    lambda a: np.repeat(a, 2, axis=0)[::2],
    lambda a: np.ascontiguousarray(a[::-1])[::-1],
    lambda a: np.hstack([a, a])[:, :3],
    lambda a: np.ascontiguousarray(a[:, ::-1])[:, ::-1],
    lambda a: np.dstack([a, a]).astype("f4")[..., 1],
], ids=["Fortran", "unaligned", "read only", "lists", "every second row", "backwards", "within wider rows", "columns backwards", "every second float"])
def test_any_layout(layout: Any) -> None:
    assert same(answers(layout(VELOCITIES)), EXPECTED)


def test_arguments_broadcast() -> None:
    a, b = VELOCITIES[:20].reshape(5, 1, 4, 3), VELOCITIES[20:32].reshape(3, 4, 3)
    both = PAIR.verdict(a, b)
    assert both.shape == (5, 3, 4)
    for i, j, k in np.ndindex(5, 3, 4):
        assert both[i, j, k] == PAIR.verdict(a[i, 0, k], b[j, k])
    assert PAIR.verdict(np.empty((0, 3)), STILL).shape == (0,)
    assert PAIR.verdict(np.empty((2, 0, 3)), STILL).shape == (2, 0)
    with pytest.raises(vericone.InputError, match="broadcast"):
        PAIR.verdict(VELOCITIES[:5], VELOCITIES[:4])


def test_rows_of_records_have_no_byte_that_is_left_over() -> None:
    """The same questions have the same bytes, whatever the memory held before."""
    discs = [vericone.Ellipse.from_axes([5, k], [1, 2]) for k in range(-8, 9)]
    first = vericone.sector_by_degenerate_conics(vericone.Ellipse(), discs).tobytes()
    for k in range(50):
        dirt = [np.full(len(first) // 8, k + 0.5) for _ in range(8)]
        del dirt
        assert vericone.sector_by_degenerate_conics(vericone.Ellipse(), discs).tobytes() == first


def test_many_pairs_in_one_call() -> None:
    pairs = [vericone.Pair(AGENT, vericone.Ellipsoid.from_axes([9, k, 0], [1, 2, 1])) for k in range(6)]
    velocities = VELOCITIES[:6]
    own = vericone.many(pairs).verdict(velocities, STILL)
    assert own.tolist() == [int(pair.verdict(w, STILL)) for pair, w in zip(pairs, velocities)]
    table = vericone.many(pairs).verdict(VELOCITIES[:40, None], STILL, threads=2)
    assert table.shape == (40, 6)
    assert all(table[i, j] == pairs[j].verdict(VELOCITIES[i], STILL) for i, j in np.ndindex(40, 6))


@pytest.mark.parametrize("given", [
    VELOCITIES.astype("g"), VELOCITIES.astype(complex), VELOCITIES.astype(object), VELOCITIES.astype(str), VELOCITIES > 0,
    np.full((4, 3), 2**53 + 1), np.full((4, 3), 2**64 - 1, dtype="u8"), np.zeros((4, 2)), np.zeros((4, 4)), np.zeros(()), np.zeros(4),
    [[1, 2, 3], [1, 2]], [[1, 2, "3"]], "abc", None, 3.0, [1, 2, fractions.Fraction(1, 3)], np.zeros(5, dtype="M8[s]"),
    np.zeros((3, 3), dtype="f8,f8"), {"a": 1}, {1.0, 2.0, 3.0},
], ids=lambda given: f"{type(given).__name__}-{getattr(given, 'dtype', '')}-{getattr(given, 'shape', '')}")
def test_what_would_be_rounded_or_is_none_is_refused(given: Any) -> None:
    with pytest.raises((vericone.InputError, TypeError)) as raised:
        PAIR.verdict(given, STILL)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize(("row", "component"), [(0, 0), (1, 2), (12_345, 1), (69_999, 2)])
@pytest.mark.parametrize("wrong", [float("nan"), float("inf"), 2**53 + 1])
@pytest.mark.parametrize("question", ["membership", "verdict"])
def test_the_number_that_is_wrong_is_named(question: str, wrong: float, row: int, component: int, threads: int) -> None:
    """The first of all, whoever meets it."""
    velocities = np.ones((70_000, 3), dtype="i8" if isinstance(wrong, int) else "f8")
    velocities[row, component] = velocities[69_999, 2] = wrong
    with pytest.raises(vericone.InputError) as raised:
        ORACLE.membership(velocities, threads=threads) if question == "membership" else PAIR.verdict(velocities, STILL, threads=threads)
    assert raised.value.field.endswith(f"[{row}][{component}]"), raised.value
    assert raised.value.value in (str(wrong), "nan", "inf") and raised.value.requirement
    with pytest.raises(vericone.InputError) as raised:
        PAIR.verdict(STILL, velocities.reshape(100, 700, 3), threads=threads)
    assert raised.value.field.endswith(f"[{row // 700}][{row % 700}][{component}]"), raised.value


@pytest.mark.parametrize("length", [3, 4])
@pytest.mark.parametrize("rows", [0, 3])
@pytest.mark.parametrize("at", [0, 1, 2])
def test_a_list_that_changes_while_it_is_read(at: int, rows: int, length: int) -> None:
    for use in (lambda x: PAIR.verdict(x, STILL), vericone.HullBody, lambda x: vericone.Ellipsoid.from_axes(x, [1, 1, 1]),
                lambda x: vericone.exact.determinant(x), lambda x: vericone.Assembly.cloud(x, 0.1)):
        try:
            use(clearing(length, at, rows))
        except (vericone.InputError, TypeError, IndexError):
            pass


@pytest.mark.parametrize("nothing", [(), [], [[]], np.zeros((0, 3)), np.zeros((3, 0))])
def test_nothing_is_no_matrix(nothing: Any) -> None:
    for make in (vericone.BodyRate, vericone.Conic, lambda m: vericone.Ellipsoid.from_shape([0, 0, 0], m), vericone.Pose):
        with pytest.raises((vericone.InputError, TypeError)):
            make(nothing)


VALUES: list[Any] = [
    AGENT, vericone.Ellipse.from_axes([1, 2], [3, 1]), vericone.CombinedEllipsoid(AGENT, [vericone.hyperboloid(2, [0.9, 0.8, 0.8])]),
    vericone.Pose([1, 2, 3]), vericone.Interval.between(1, 2), vericone.ConeOptions(tolerance=1e-3), vericone.Body(OBSTACLE),
    vericone.guidance.PlaneCone(psi=0.3, theta_b=0.1), vericone.exact.RationalBody3(AGENT),
    PAIR.contact([5, 0.5, 0], STILL), vericone.Verdict.in_, vericone.HullBody(np.random.default_rng(1).normal(size=(9, 3)))]


@pytest.mark.parametrize("value", VALUES, ids=lambda value: type(value).__name__)
def test_values_compare_copy_pickle_and_print(value: Any) -> None:
    again = pickle.loads(pickle.dumps(value))
    assert again == value and not again != value and type(again) is type(value)
    assert copy.copy(value) == value and copy.deepcopy(value) == value
    assert value != object() and len(repr(value)) < 2000 and repr(value) == repr(again)


def test_exact_numbers_arrive_as_they_are() -> None:
    """The tangent of two balls has a square root in it: it lies between neighbours of any denominator."""
    third = fractions.Fraction(1, 3)
    ball = vericone.exact.RationalBody3([third, 0, 0], [[third, 0, 0], [0, third, 0], [0, 0, third]])
    assert ball.center == (third, 0, 0) and ball.shape[0][0] == third
    # Unit balls 5 apart: the cone's edge has sine 2/5, tangent 2/sqrt(21).
    def unit(x: int) -> Any:
        return vericone.exact.RationalBody3([x, 0, 0], [[1, 0, 0], [0, 1, 0], [0, 0, 1]])

    for digits in (10, 40, 80):
        scale = 10**digits
        root = fractions.Fraction(math.isqrt(4 * scale**2 // 21), scale)  # from below
        assert vericone.exact.membership(unit(0), unit(5), [1, root, 0]) == vericone.Membership.in_
        assert vericone.exact.membership(unit(0), unit(5), [1, root + fractions.Fraction(1, scale), 0]) == vericone.Membership.out


def test_many_exact_vectors_are_asked_at_once() -> None:
    bodies = [vericone.exact.RationalBody3([x, 0, 0], np.eye(3).tolist()) for x in (0, 5, 7)]
    vectors = [[1, fractions.Fraction(k, 10), 0] for k in range(-6, 7)]
    each = [int(vericone.exact.membership(bodies[0], bodies[1], w)) for w in vectors]
    assert vericone.exact.membership(bodies[0], bodies[1], vectors).tolist() == each and len(set(each)) > 1
    assert vericone.exact.membership(bodies[0], bodies[1], [vectors, vectors], threads=2).tolist() == [each, each]
    table = vericone.exact.membership(bodies[0], bodies[1:], [[w] for w in vectors])
    assert table.shape == (13, 2) and table[:, 0].tolist() == each
    array = np.random.default_rng(2).normal(size=(40, 3))
    own = vericone.ConeOracle(AGENT, vericone.Ellipsoid.from_axes([5, 0, 0], [1, 1, 1]))
    for given in (array, array.astype("f4"), np.ones((2, 0, 3))):
        assert np.array_equal(vericone.exact.membership(bodies[0], bodies[1], given), own.membership(given))
    with pytest.raises(vericone.InputError, match=r"w\[1\]"):
        vericone.exact.membership(bodies[0], bodies[1], [vectors, vectors[1:]])
    with pytest.raises(vericone.InputError, match=r"w\[2\]\[1\]"):
        vericone.exact.membership(bodies[0], bodies[1], [[1, 0, 0], [1, 1, 0], [1, float("nan"), 0]])
    with pytest.raises(TypeError):
        vericone.exact.membership(bodies[0], bodies[1], [[1, 0], [1, 1]])


class Named(vericone.Ellipsoid):
    """With a name of its own."""

    label = "boat"


class Careful(vericone.ConeOptions):
    """A record."""


def test_classes_can_be_derived_from() -> None:
    class Watched(vericone.guidance.ConstantVelocityFilter):
        """One with a memory."""

    boat = Named()
    boat.label = "ship"
    assert type(boat) is Named and boat.label == "ship"
    assert vericone.Pair(boat, OBSTACLE).verdict([5, 0.5, 0], STILL) == PAIR.verdict([5, 0.5, 0], STILL)
    careful = Careful(tolerance=1e-2)
    assert type(careful) is Careful and careful.tolerance == 1e-2 and PAIR.cone(careful) == PAIR.cone(vericone.ConeOptions(tolerance=1e-2))
    assert type(careful.replace(threads=2)) is vericone.ConeOptions
    assert type(Watched()) is Watched and not Watched().started()
    for made in (boat, careful):
        again = pickle.loads(pickle.dumps(made))
        assert type(again) is type(made) and again == made and vars(again) == vars(made)
