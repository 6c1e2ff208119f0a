# SPDX-License-Identifier: BSD-3-Clause
"""Objects that questions can be asked of: what is drawn at random hardly makes them."""

import enum
from typing import Any

import numpy as np

import vericone

import signatures


def objects() -> list[Any]:
    """Of every kind that is asked, some."""
    v = vericone
    ball, long, small = v.Ellipsoid(), v.Ellipsoid.from_axes([8, 1, 2], [3, 1, 1]), v.Ellipsoid.from_axes([1, 0.5, 0], [0.5, 0.4, 0.3])
    disc, flat = v.Ellipse(), v.Ellipse.from_axes([6, 1], [2, 1])
    dent = v.CombinedEllipsoid(v.Ellipsoid.from_axes([7, 0, 1], [2, 2, 1]), [v.Delimiter3(np.diag([1.0, -1.0, -1.0]), 0.5)])
    star = v.CombinedEllipse(flat, [v.hyperbola([0.8, 1.0])])
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
    sides = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    hull, far = v.HullBody(corners), v.HullBody(corners + [6, 1, 0])
    mesh, cloud = v.Assembly.mesh(corners + [5, 1, 0], sides), v.Assembly.cloud(corners + [6, 0, 1], 0.2)
    pose = v.Pose([6, 1, 0.5])
    opening = v.PlacedOpening(v.Opening.ellipse([2, 1.5]), [6, 0.5, 0])
    window = v.MeshWindow(np.array([[5, -2, -2], [5, 2, -2], [5, 2, 2], [5, -2, 2], [5, -4, -4], [5, 4, -4], [5, 4, 4], [5, -4, 4.0]]),
                          np.array([[0, 4, 5], [0, 5, 1], [1, 5, 6], [1, 6, 2], [2, 6, 7], [2, 7, 3], [3, 7, 4], [3, 4, 0]]), 0)
    bodies = [v.Body(x) for x in (ball, dent, hull)]
    made = [ball, long, small, disc, flat, dent, star, hull, far, mesh, cloud, pose, opening, window, *bodies,
            v.CombinedEllipse(disc), v.CombinedEllipsoid(ball), v.ConeOracle(ball, long), v.SectorOracle(disc, flat), v.OrificeOracle(ball, opening), v.Pair(ball, long), v.Pair(dent, hull), v.Pair(v.Body(mesh), v.Placed(v.Body(ball), pose)),
            v.WorldBody(ball), v.WorldBody(dent), v.true_cone(ball, long, 64), v.AxisFrame([1, 2, 3.0]), v.PlaneFrame([0, 0, 0], [1, 0, 0], [0, 1, 0]),
            v.Box([0, 0, 0], [1, 2, 3]), v.Convex.cylinder(1, 2), v.Convex.capsule(0.5, 1).translated([7, 1, 0])]
    g = v.guidance
    made += [g.BodyState(shape=v.WorldBody(x), position=at, velocity=w) for x, at, w in
             ((ball, [0, 0, 0], [2, 0.2, 0]), (v.Ellipsoid.from_axes([9, 1, 2], [2, 1, 1]), [9, 1, 2], [-1, 0, 0.3]), (dent, [7, 0, 1], [-1, 0, 0]))]
    made += [g.OrificeState(opening=opening), g.OrificeState(opening=v.PlacedOpening(v.Opening.ellipse([3, 3]), [8, 0, 0]), velocity=[0, 0.1, 0])]
    made += [g.PlanarState(r=r, theta=0.1, v_theta=0.2, v_r=v_r, alpha=0.2, beta=0.3, speed_a=2, speed_b=1) for r, v_r in ((10, -1), (7, -2), (20, 1))]
    made += [g.SpatialState(r=r, theta=0.1, phi=0.2, v_theta=0.3, v_phi=0.1, v_r=-2, speed_a=2, speed_b=1) for r in (8, 15)]
    made += [g.PlaneCone(psi=psi, theta_b=0.1) for psi in (0.3, 0.4)]
    made += [g.Measured(v_r=0.01 * k, v_theta=0.02, theta=0.001, theta_b=0.001, psi=0.002) for k in (1, 2)]
    made += [v.exact.RationalBody3(x) for x in (ball, long)] + [v.exact.RationalBody2(x) for x in (disc, flat)]
    made += [v.PlanarMotion(v_a=[1, 0], v_b=[-1, 0.1], omega_b=0.2), v.SpatialMotion(v_a=[1, 0, 0], v_b=[0, 0.1, 0])]
    made += [g.Cartesian2(p_b=p, v_a=[1, 0.1], v_b=[0, 0.2]) for p in ([5, 1], [7, 3])] + [g.Cartesian3(p_b=p, v_a=[1, 0.1, 0], v_b=[0, 0.2, 0.1]) for p in ([5, 1, 1], [7, 3, 2])]
    made.append(v.cone_map([v.Pair(ball, long)], v.ConeMapOptions(resolution=0.3)))
    made += [g.EnclosingEllipse(centre=[9, 1], a=2, b=1, angle=0.3, foci=([8, 1], [10, 1])), g.FocalState(velocity=[1, 0], foci=([8, 1], [10, 1]), a=2)]
    # Options, mostly: as they are without a word.
    for own in signatures.callables(v):
        if own.kind == "class" and not issubclass(own.target, (enum.Enum, BaseException)):
            try:
                made.append(own.target())
            except (TypeError, v.InputError):
                pass
    return made
