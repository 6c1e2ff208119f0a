# SPDX-License-Identifier: BSD-3-Clause
"""Options by the names of their fields, and bodies from one thing."""
from __future__ import annotations

import inspect
import types
from pathlib import Path

import numpy as np
import pytest

import vericone as vc
from vericone import guidance

PAIR = vc.Pair(vc.Ellipsoid(), vc.CombinedEllipsoid(vc.Ellipsoid.from_axes([8, 0, 0], [2, 3, 3]), [vc.hyperboloid(2, [0.5, 1, 1])]))


def test_fields_stand_for_their_options() -> None:
    assert PAIR.cone(tolerance=0.05).solid_angle == PAIR.cone(vc.ConeOptions(tolerance=0.05)).solid_angle
    assert vc.Pair(PAIR.agent(), PAIR.obstacle(), tolerance=1e-2).guarantee().tolerance == 1e-2
    state = guidance.BodyState(shape=vc.WorldBody(vc.CombinedEllipsoid(vc.Ellipsoid())), velocity=[1, 0, 0])
    assert guidance.Navigator(most=5, required=0.1).step(state, [], None, 0, 0.1).status == guidance.NavigatorStatus.straight


def test_what_is_no_field_is_refused() -> None:
    with pytest.raises(TypeError, match="tolerence.*or fields of ConeOptions"):
        PAIR.cone(tolerence=0.05)  # type: ignore[call-overload]
    with pytest.raises(TypeError, match="got both 'options' and fields of it"):
        guidance.Navigator(options=guidance.NavigatorOptions(), most=5)
    with pytest.raises(vc.InputError, match="^tolerance: got -1"):
        PAIR.cone(tolerance=-1)
    with pytest.raises(TypeError, match="^tolerance: got str"):
        PAIR.cone(tolerance="fine")  # type: ignore[call-overload]


def test_signatures_and_docstrings_say_so() -> None:
    assert "fields" in inspect.signature(guidance.Navigator).parameters
    assert "its fields, by name: " in (vc.min_volume_ellipsoid.__doc__ or "") + (vc.Pair.cone.__doc__ or "")


def test_zero_is_the_safe_answer_alone() -> None:
    assert vc.Verdict.out == vc.Membership.out == vc.Certified.out == vc.RobustVerdict.out == vc.Relation.disjoint == 0
    for kind in (vc.Verdict, vc.Membership, vc.Certified, vc.RobustVerdict, vc.Relation):
        assert sum(int(member) == 0 for member in kind) == 1
    pair = vc.Pair(vc.Ellipsoid(), vc.Ellipsoid.from_axes([10, 0, 0], [1, 1, 1]))
    verdicts = pair.verdict([[1, 0, 0], [0, 1, 0], [-1, 0, 0]], np.zeros(3))
    assert verdicts.astype(bool).tolist() == [True, False, False] and np.count_nonzero(verdicts) == 1


def test_a_pose_of_a_quaternion_and_a_distance() -> None:
    angle = 0.3
    pose = vc.Pose.from_quaternion([1, 2, 3], [np.cos(angle / 2), 0, 0, np.sin(angle / 2)])
    assert np.allclose(pose.to_world([1, 0, 0]), [1 + np.cos(angle), 2 + np.sin(angle), 3], atol=1e-15)
    with pytest.raises(vc.InputError, match="^rotation: .* a unit quaternion"):
        vc.Pose.from_quaternion([0, 0, 0], [1, 1, 0, 0])
    for obstacle in (vc.Ellipsoid.from_axes([10, 0, 0], [2, 2, 2]), vc.HullBody.box([8, -1, -1], [9, 1, 1])):
        assert vc.Pair(vc.Ellipsoid(), obstacle).distance() == pytest.approx(7, abs=1e-9)
    assert vc.Pair(vc.Ellipsoid(), vc.Ellipsoid.from_axes([2.5, 0, 0], [2, 2, 2])).distance() == 0


def test_bodies_from_one_thing(tmp_path: Path, source: Path) -> None:
    mesh = vc.load(source / "docs/examples/window.obj")
    assert mesh.body.kind() == vc.BodyKind.mesh
    read = vc.files.triangle_mesh(vc.files.read_points(source / "docs/examples/window.obj"))
    assert vc.load(types.SimpleNamespace(vertices=read.points, faces=read.triangles)) == mesh
    cloud = tmp_path / "three.xyz"
    cloud.write_text("0 0 0\n1 0 0\n0 1 0\n")
    still = np.zeros(3)
    for radius in (0.0, 0.25):
        pair = vc.Pair(vc.Ellipsoid.from_axes([-5, 0, 0], [1, 1, 1]), vc.load(cloud, radius=radius))
        assert pair.miss(still, still).least == pytest.approx(4 - radius, abs=1e-9)
    body = tmp_path / "ball.yaml"
    body.write_text("center: [1, 2, 3]\nsemi_axes: [1, 1, 1]\n")
    assert vc.load(body).body.kind() == vc.BodyKind.ellipsoid
    with pytest.raises(TypeError, match="vertices and faces"):
        vc.load(3)
    with pytest.raises(vc.InputError, match="not-there.obj"):
        vc.load(tmp_path / "not-there.obj")
