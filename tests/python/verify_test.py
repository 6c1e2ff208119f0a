# SPDX-License-Identifier: BSD-3-Clause
"""The cross-checks with CGAL, asked from Python: they and the package agree, about pairs that were made to be hard."""

from __future__ import annotations

import math
from fractions import Fraction

import pytest

import vericone

check = pytest.importorskip("vericone_verify", reason="built without CGAL: VERICONE_VERIFY is off")

RELATIONS = {"separated": vericone.Relation.disjoint, "touching": vericone.Relation.touching, "overlapping": vericone.Relation.overlapping}


@pytest.mark.parametrize("family", check.PlanarFamily, ids=lambda family: str(family.name))
def test_relations_of_ellipses_are_those_of_exact_arithmetic(family: vericone_verify.PlanarFamily) -> None:  # type: ignore[name-defined]  # noqa: F821
    for index in range(25):
        a, b = check.planar_pair(family, 7, index)
        assert vericone.relation(a, b) == RELATIONS[check.exact_relation(a, b).name]


def sector(a: vericone.Ellipse, b: vericone.Ellipse) -> vericone_verify.PlanarAnswer:  # type: ignore[name-defined]  # noqa: F821
    relation = vericone.relation(a, b)
    name = next(name for name, own in RELATIONS.items() if own == relation)
    answer = check.PlanarAnswer(answered=True, relation=check.PlanarRelation[name])
    if relation != vericone.Relation.disjoint:
        return answer
    found = vericone.sector_by_support(a, b)
    return answer.replace(theta_b=found.theta_b, psi=found.psi)


def test_a_method_in_python_is_measured() -> None:
    """Its sectors are compared with tangents that CGAL constructs exactly."""
    report = check.run_planar_family(sector, check.PlanarFamily.regular, 20, 3)
    assert report.cases == 20 and report.wrong_relations == 0 and report.not_answered == 0
    assert report.compared == report.separated > 10
    assert report.psi_ulps.error < 100 and report.theta_b.error < 1e-14
    assert "regular" in check.to_markdown([report])
    wrong = check.run_planar_family(lambda a, b: sector(a, b).replace(psi=1.0), check.PlanarFamily.regular, 5, 3)
    assert wrong.psi_relative.error > 0.01


def test_what_a_method_raises_comes_back() -> None:
    def stop(a: vericone.Ellipse, b: vericone.Ellipse) -> None:
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        check.run_planar_family(stop, check.PlanarFamily.regular, 1, 1)


def test_cones_of_ellipsoids_lie_between_polyhedra() -> None:
    report = check.run_spatial_family(check.SpatialFamily.regular, 3, 11)
    assert report.failures() == 0 and report.polyhedra.tried > 100 and report.march.tried > 100


def test_numbers_of_the_corpus_are_read_as_they_are_written() -> None:
    for x in (Fraction(0), Fraction(-7, 3), Fraction(5, 2**120), Fraction(2**200), Fraction(math.pi)):
        assert check.parse_number(check.number_text(x)) == x
    with pytest.raises(RuntimeError):
        check.parse_number("1/0x")


def body(case: vericone_verify.CorpusCase, name: str) -> vericone.exact.RationalBody3:  # type: ignore[name-defined]  # noqa: F821
    """From the upper half of its shape."""
    xx, xy, xz, yy, yz, zz = case.values(f"{name}.shape")
    return vericone.exact.RationalBody3(case.values(f"{name}.center"), [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def test_the_corpus_is_answered_exactly() -> None:
    """Bodies within rounding of touching, in rational numbers, by the answer that they were built to have."""
    cases = [case for case in check.corpus_cases("relation", 1) if case.dimension() == 3 and case.has("a.shape") and case.has("b.shape")]
    assert len(cases) > 100 and len({case.truth for case in cases}) > 1
    for case in cases:
        assert vericone.exact.relation(body(case, "a"), body(case, "b")).name == case.truth, case.label()
