# SPDX-License-Identifier: BSD-3-Clause
"""Calls that are answered, each with something of the right kind, size and sense: of what random arguments hardly reach,
and of most of the rest. every_overload.py makes them, and asks that nothing stays without a call.

A group asks one namespace: where a part of the package was not built, its group ends there."""

import fractions
import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import vericone

v: Any = vericone
EXAMPLES = Path(os.environ["VERICONE_SOURCE"]) / "docs/examples"
Ask = Callable[..., Any]

BALL, LONG = v.Ellipsoid(), v.Ellipsoid.from_axes([8, 1, 2], [3, 1, 1])
DISC, FLAT = v.Ellipse(), v.Ellipse.from_axes([6, 1], [2, 1])
DENT = v.CombinedEllipsoid(v.Ellipsoid.from_axes([7, 0, 1], [2, 2, 1]), [v.Delimiter3(np.diag([1.0, -1.0, -1.0]), 0.5)])
STAR = v.CombinedEllipse(FLAT, [v.hyperbola([0.8, 1.0])])
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1.0]])
SIDES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
RING = np.array([[5, -2, -2], [5, 2, -2], [5, 2, 2], [5, -2, 2], [5, -4, -4], [5, 4, -4], [5, 4, 4], [5, -4, 4.0]])
RING_SIDES = np.array([[0, 4, 5], [0, 5, 1], [1, 5, 6], [1, 6, 2], [2, 6, 7], [2, 7, 3], [3, 7, 4], [3, 4, 0]])
QUARTER = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
TURN = [[0.6, -0.8], [0.8, 0.6]]
TURN_3 = [[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]]
CELL = [[1.0, 0, 0], [0, 1, 0], [0, 0, 1]]
SQUARE: Any = [[0, 0], [1, 0], [1, 1], [0, 1.0]]
THIRD: Any = fractions.Fraction(1, 3)
EXACT_2: Any = [[2, THIRD], [THIRD, 1]]
EXACT_3: Any = [[2, THIRD, 0], [THIRD, 1, 0], [0, 0, 1]]


def cloud(count: int = 60) -> Any:
    """Points on an ellipsoid with semi-axes of 3, 2 and 1 m."""
    k = np.arange(count) + 0.5
    z, angle = 1 - 2 * k / count, 2.399963 * k
    ring = np.sqrt(1 - z * z)
    return np.stack([3 * ring * np.cos(angle), 2 * ring * np.sin(angle), z], axis=1)


def write(path: Path, text: str) -> Path:
    path.write_text(text, encoding="utf-8")
    return path


def kind(own: object) -> str:
    """Of what class it is, as ask() names it."""
    return f"{type(own).__module__}.{type(own).__qualname__}".removeprefix("vericone.")


def each(ask: Ask, own: object, names: str, *given: Any) -> None:
    """Asks methods of an object that are given the same arguments."""
    for name in names.split():
        ask(f"{kind(own)}.{name}", own, *given)


def geometry(ask: Ask) -> None:
    for r in (TURN, TURN_3):
        n = len(r)
        ask("orthonormal", r)
        ask("turned", r, np.diag([1.0, 2, 3][:n]))
        ask("min_volume_ellipsoid", cloud()[:, :n])
    ask("rotation_3d", [0.6, 0, 0, 0.8])
    ask("dented_conic", [6, 1], 2, 1, 0.5, 0.3)
    ask("hyperboloid", 1, [0.8, 1, 1])
    ask("boundary_loops", RING, RING_SIDES)
    ask("part", v.surface(DENT, 0.1), v.SurfacePart.ellipsoid)
    for body in (DISC, BALL, STAR, DENT):
        ask("side", body, body.center())
    ask("side", DISC.quadric(), [1, 0])
    ask("side", BALL.quadric(), [1, 0, 0])
    ask("side", quadrics=[DISC.quadric()], point=[1, 0])
    ask("side", quadrics=[BALL.quadric()], point=[1, 0, 0])
    ask("Ellipse.from_axes", [6, 1], [2, 1], TURN)
    ask("Ellipse.from_shape", [6, 1], np.diag([4.0, 1]))
    ask("Ellipsoid.from_axes", [6, 1, 0], [2, 1, 1], TURN_3)
    ask("Ellipsoid.from_shape", [6, 1, 0], np.diag([4.0, 1, 1]))
    ask("Quadric", np.diag([1.0, 1, 1, -1]))
    ask("AxisFrame", [1, 2, 3])
    ask("Body", LONG)
    ask("HullBody.box", [0, 0, 0], [1, 2, 3])
    ask("Assembly.mesh", CORNERS + [5, 1, 0], SIDES)


def cones(ask: Ask) -> None:
    oracle, sectors = v.ConeOracle(BALL, LONG), v.SectorOracle(DISC, FLAT)
    pair, w, still, up = v.Pair(BALL, LONG), [1, 0.1, 0.2], [0, 0, 0], [0, 0, 1]
    ask("ConeOracle.membership", oracle, w)
    ask("ConeOracle.verdict", oracle, w, still, v.Horizon(until=9))
    ask("SectorOracle.membership", sectors, [1, 0.1])
    for name in ("membership", "verdict"):
        ask(f"ConeOracle.{name}", oracle, w, still)
        ask(f"SectorOracle.{name}", sectors, [1, 0.1], [0, 0])
    ask("separates", DISC, FLAT, [1, 0])
    ask("separates", BALL, LONG, [1, 0, 0])
    sector = ask("Pair.sector", pair, up)
    ask("sector_rates", sector, 1, 2, [0.1, 0.2, 0], 0.1)
    ask("central_section", DENT, [1, 0, 0], [0, 1, 0], [0, 0])
    ask("cone_function", 0.3, 0.1, [2, 0.2], [-1, 0])
    ask("time_to_contact", oracle, w, still)
    ask("time_to_contact", BALL, LONG, w)
    ask("enclose_plane_sector", BALL, LONG, up)
    ask("cone_bounds", v.true_cone(BALL, LONG, 64), BALL, LONG)
    ask("combined_slice_cone", v.CombinedEllipsoid(BALL), DENT, 8, v.SliceSector(0))
    opening = v.PlacedOpening(v.Opening.ellipse([2, 1.5]), [6, 0.5, 0])
    ask("Opening.ellipse", [2, 1.5])
    ask("Opening.polygon", SQUARE)
    ask("facing_orifice_transit", [5, 0.1, 0], 0.5, 2, [1, 0, 0])
    ask("opening_clearance", BALL, opening, w)
    ask("opening_clearance", v.WorldBody(v.HullBody(CORNERS)), opening, [1, 0, 0])
    ask("rim_distance", BALL, opening, v.RimQuestion())
    window = ask("MeshWindow", RING, RING_SIDES, 0)
    ask("MeshWindow.crossings", window, [0, 0, 0], [9, 0.1, 0.2])
    seen = lambda frame: [[5, 1], [4, 0.2], [5, -1.0]]  # noqa: E731
    ask("visible_cone", BALL, seen, [5, 0, 0], 4)
    ask("visible_cone", [0, 0, 0], lambda frame: [[-1, -1], [1, -1], [1, 1], [-1, 1.0]], seen, [5, 0, 0], 4)
    ask("probability_of_passing_through", BALL, LONG, w, np.eye(3) * 0.1)
    ask("collision_probability_bound", BALL, LONG, w, v.GaussianErrors(np.eye(3) * 0.1, np.eye(3) * 0.01), 5)
    ask("robust_verdict", BALL, LONG, w, still, v.RelativeErrors())
    ask("robust_verdict", pair, w, still, v.RelativeErrors())
    turning = v.BodyMotion(velocity=[1, 0, 0], spin=[0, 0, 0.5])
    ask("motion_answer", v.Placed(v.Body(BALL)), turning, v.Placed(v.Body(LONG)), v.BodyMotion(), v.Horizon(until=5))
    ask("ErrorSet.sum", 0.1, [np.eye(3)], [[1, 0, 0]])
    planes = ask("PlaneCones", v.WorldBody(BALL), v.WorldBody(LONG), [0, 0, 0], [8, 1, 2], v.SectorMethod.slice)
    along, across = np.array([8, 1, 2]) / 69**0.5, np.array([1, -8, 0]) / 65**0.5
    each(ask, planes, "on", along, across, [])


def exact(ask: Ask) -> None:
    for matrix, vector in ((EXACT_2, [1, THIRD]), (EXACT_3, [1, THIRD, 0])):
        ask("exact.determinant", matrix)
        ask("exact.positive_definite", matrix)
        ask("exact.to_rational", np.eye(len(vector)))
        ask("exact.to_rational", [0.5] * len(vector))
        name = f"RationalBody{len(vector)}"
        ask(f"exact.{name}", vector, matrix)
        near, far = (getattr(v.exact, name)([x] + [0] * (len(vector) - 1), matrix) for x in (0, 9))
        ask("exact.membership", near, far, vector)
        ask("exact.side", near, vector)
        n = len(vector) + 1
        ask("exact.side", [[(i == j) * (-1 if i == n - 1 else 1) for j in range(n)] for i in range(n)], vector)


def guidance(ask: Ask) -> None:
    g = v.guidance
    a = g.BodyState(shape=v.WorldBody(BALL), velocity=[2, 0.2, 0])
    b = g.BodyState(shape=v.WorldBody(v.Ellipsoid.from_axes([9, 1, 2], [2, 1, 1])), position=[9, 1, 2], velocity=[-1, 0, 0.3])
    method, rates = v.SectorMethod.slice, g.RateMethod(0)
    ask("guidance.plane_view", a, b, [0, 0, 1], method, rates)
    ask("guidance.all_planes", a, b, method, 8)
    centres, speeds = [[8, 1], [10, 1], [9, 2.0]], [[1, 0], [1, 0.1], [1, -0.1]]
    ellipse = ask("guidance.enclosing_ellipse", centres, speeds, 0)
    ask("guidance.EllipseFollower.step", g.EllipseFollower(2), centres, speeds)
    state = g.PlanarState(r=10, theta=0.1, v_theta=0.2, v_r=-1, alpha=0.2, beta=0.3, speed_a=2, speed_b=1)
    ask("guidance.rendezvous_law", state, [0, 0.1], g.RendezvousGains())
    ask("guidance.miss_distance", [0, 0], [1, 0.1], ellipse)
    ask("guidance.pursuit_law", [0, 0], [2, 0.1], ellipse, [0, 0], g.PursuitGains())
    ask("guidance.cone_confidence", [0, 0], [2, 0.1], ellipse, np.eye(4) * 0.01, 2)
    ask("guidance.ConstantVelocityFilter.step", g.ConstantVelocityFilter(), np.zeros(6), np.eye(6), 0.1)
    members = g.SetMembershipFilter()
    ask("guidance.SetMembershipFilter.step", members, [9, 1, 0], [1, 0, 0], [0.1, 0.1, 0.1], [0.1, 0.1, 0.1], 0.1)
    for name in ("position", "velocity", "position_radius", "velocity_radius"):
        ask(f"guidance.SetMembershipFilter.{name}", members)
    singer = g.SingerFilter()
    ask("guidance.SingerFilter.start", singer, np.zeros(6), np.eye(6), 0)
    ask("guidance.SingerFilter.step", singer, [0.1, 0.1], np.eye(2), 0.1)
    ask("guidance.SingerFilter.step_as_source", singer, np.eye(2), 0.2)


def words(ask: Ask) -> None:
    ask("may_collide", v.Verdict(0))
    ask("to_text", 0.1)


def convex_bodies(ask: Ask) -> None:
    """Cylinders and their kin, and what a margin makes of others."""
    cylinder = ask("Convex.cylinder", 1, 2)
    ask("Convex.elliptic_cylinder", 1, 2, 3)
    ask("Convex.capsule", 1, 2)
    ask("Convex.cone", 1, 2)
    ask("Convex.frustum", 1, 0.5, 2)
    ask("Convex.disc", 1)
    ask("Convex.ellipse", 1, 2)
    ask("Convex.box", [1, 2, 3])
    ask("Convex.point")
    ask("Convex.point", [1, 2, 3])
    ask("Convex.segment", [0, 0, 0], [1, 2, 3])
    ask("Convex.rounded", v.HullBody(CORNERS), 0.1)
    ask("Convex.rounded", LONG, 0.1)
    ask("Convex.hull_of", BALL, LONG)
    ask("Convex.of_pieces", cylinder.pieces())
    ask("Convex.of_pieces", cylinder.pieces(), 0.1)
    each(ask, cylinder, "called", "tin")
    each(ask, cylinder, "support support_point", [1, 0.2, 0.3])
    each(ask, cylinder, "swollen", 0.1)
    each(ask, cylinder, "translated", [1, 2, 3])
    each(ask, cylinder, "scaled", 2)
    ask("in_world", cylinder, v.Pose([6, 1, 0.5]))
    both = ask("Assembly.convexes", [cylinder, cylinder.translated([4, 0, 0])])
    each(ask, both, "convex_piece", 1)
    ask("Body", cylinder)
    for own in (v.Body(LONG), v.Body(cylinder), v.Body(both)):
        ask("swollen", own, 0.1)


def bodies(ask: Ask) -> None:
    convex_bodies(ask)
    hull, pose = v.HullBody(CORNERS), v.Pose([6, 1, 0.5])
    for name in ("Ellipse", "Ellipsoid", "CombinedEllipse", "CombinedEllipsoid", "HullBody", "Body", "WorldBody", "ErrorSet", "Interval", "nadir"):
        ask(name)
    flat, solid = v.WorldBody(FLAT), v.WorldBody(LONG)
    each(ask, flat, "containing_ellipse")
    for own, x in ((FLAT, [1, 0.2]), (LONG, [1, 0.2, 0.3]), (STAR, [1, 0.2]), (DENT, [1, 0.2, 0.3])):
        name = kind(own)
        each(ask, own, "translated", x)
        each(ask, own, "scaled", 2)
        each(ask, own, "gauge" if own in (STAR, DENT) else "radius support support_point", x)
        ask("WorldBody", own)
        if own in (STAR, DENT):
            ask(name, own.ellipsoid())
            ask(name, own.ellipsoid(), own.delimiters())
            each(ask, own.delimiters()[0], "value", x)
        else:
            ask(f"{name}.from_quadric", own.quadric())
            ask(type(own.quadric()).__name__, own.quadric().matrix())
            each(ask, own.quadric(), "value polar", x)
    each(ask, hull, "support", [1, 0.2, 0.3])
    each(ask, hull, "translated", [1, 0.2, 0.3])
    each(ask, hull, "scaled", 2)
    mesh, cloud_of_balls = v.Assembly.mesh(CORNERS + [5, 0, 0], SIDES), ask("Assembly.cloud", CORNERS + [6, 0, 1], 0.2)
    boxes = [v.Box([0, 0, 0], [1, 1, 1]), v.Box([2, 0, 0], [3, 1, 1])]
    ask("Assembly.boxes", boxes)
    ask("Assembly.polyhedra", [hull, hull.translated([4, 0, 0])])
    each(ask, mesh, "piece", 0)
    ask("HullBody", CORNERS)
    for own in (LONG, DENT, hull, mesh):
        ask("Body", own)
        ask("WorldBody", v.Placed(v.Body(own)) if own is mesh else own)
    each(ask, ask("Body.pieces", [LONG, DENT]), "support", [1, 0, 0])
    each(ask, ask("Placed", v.Body(hull), pose), "support", [1, 0, 0])
    each(ask, solid, "gauge support_point", [1, 0.2, 0.3])
    each(ask, solid, "inflated", 0.1)
    each(ask, solid, "posed", [1, 2, 3], TURN_3)
    each(ask, solid, "moved", [0, 0, 0], [1, 0, 0], [0, 0, 0.1], v.BodyRate(), 0.1)
    each(ask, flat, "support_point", [1, 0.2, 0])
    each(ask, boxes[0], "contains", [0.5, 0.5, 0.5])
    each(ask, boxes[0], "include", boxes[1])
    for own in (LONG, DENT, hull):
        ask("in_world", own, pose)
    ask("composed", pose, pose)
    each(ask, pose, "to_body to_world", [1, 2, 3])
    ask("inverse", pose)
    ask("raised", DISC, 2)
    for name in ("area", "corners", "outline"):
        ask(name, STAR)
    ask("volume", DENT)
    shown = ask("surface", DENT, 0.2)
    for name in ("rims", "enclosed_volume", "to_obj", "to_ply"):
        ask(name, shown)
    ask("ErrorSet.ball", 0.2)
    ask("ErrorSet.box", [0.1, 0.2, 0.3])
    each(ask, ask("ErrorSet.ellipsoid", [0.1, 0.2, 0.3]), "support support_point", [1, 0, 0])
    ask("ErrorSet.zonotope", np.eye(3))
    frame = v.PlaneFrame([0, 0, 0.5], [1, 0, 0], [0, 1, 0])
    each(ask, frame, "direction_to_plane", [1, 2, 3])
    each(ask, frame, "direction_to_space to_space", [1, 2])
    each(ask, v.AxisFrame([1, 2, 3]), "across", 0.3)
    ask("section", BALL.quadric(), frame)
    ask("hyperbola", [0.8, 1.0], 0.2)
    camera = ask("Camera.of_field_of_view", 320, 240, 1.0)
    each(ask, camera, "project projection_rates", [0.1, 0.2, 5])
    each(ask, camera, "ray sees", [100, 90])
    above = v.Pose([0, 0, 50], v.nadir())
    ask("ground_point", camera, above, [100, 90])
    ask("plane_homography", camera, above)


def numbers(ask: Ask) -> None:
    ask("Interval", 1)
    ask("Interval", 1, 0.1)
    ask("Interval.between", 1, 2)
    ask("Pose.from_quaternion", [1, 2, 3], [0.8, 0, 0.6, 0])
    each(ask, v.Interval(1, 0.1), "contains", 1)
    ask("hull", v.Interval(1), v.Interval(2))
    ask("rotation_2d", 0.3)
    ask("rotation_from_heading", 0.3, 0.2)
    ask("solid_angle", CELL)
    ask("points_near_plane", CORNERS, 0.1)


def predicates(ask: Ask) -> None:
    for a, b in ((DISC, FLAT), (BALL, LONG)):
        for name in ("position", "relation"):
            ask(name, a, b)
    ask("relation_of", v.Position(0))
    ask("relation_of", v.WorldBody(BALL), v.WorldBody(DENT), 1e-6)


def questions(ask: Ask) -> None:
    """More of cones: oracles, and what is asked of two bodies."""
    hull, w, still = v.HullBody(CORNERS), [1, 0.1, 0.2], [0, 0, 0]
    oracle = ask("ConeOracle", BALL, LONG)
    ask("SectorOracle", DISC, FLAT)
    each(ask, oracle, "naive_membership passage", w)
    for name in ("sector_by_support", "sector_by_degenerate_conics"):
        ask(name, DISC, FLAT)
    for name in ("clearance", "contact_time", "enclose_clearance"):
        ask(name, BALL, LONG, w)
    for name in ("separation", "enclose_separation"):
        ask(name, BALL, LONG)
    ask("clearance_ahead", oracle, w, still)
    ask("robust_clearance", BALL, LONG, w, v.ErrorSet.ball(0.1), v.ErrorSet.ball(0.01))
    ask("slice_cone", BALL, LONG, 8)
    ask("true_cone", BALL, LONG, 64)
    ask("sector_rates", v.Pair(BALL, LONG).sector([0, 0, 1]), v.Twist(), v.Twist())
    ask("sector_rates", v.sector_by_support(DISC, FLAT), DISC, FLAT, v.PlanarMotion(v_a=[1, 0]))
    ask("has_sectors", v.WorldBody(BALL), v.WorldBody(DENT), v.SectorMethod.slice)
    ask("pair_of", v.WorldBody(BALL), v.WorldBody(DENT))
    ask("Pair", DISC, STAR)
    pair = ask("Pair", BALL, DENT)
    ask("Pair.certificate", pair, [1, 0, 0], [0, 0, 0], v.Horizon(until=9), "7")
    ask("Pair.certificate", pair, [1, 0, 0], [0, 0, 0], v.RelativeErrors(position=v.ErrorSet.ball(0.1)), "7")
    each(ask, pair, "contact miss passage rung verdict", w, still)
    each(ask, pair, "sector", still, [7, 0, 1], [0, 1, 0])
    each(ask, pair, "cone distance")
    each(ask, ask("Pair.cone", pair, v.ConeOptions()), "contains", w)
    coarse = v.ConeMapOptions(resolution=0.3)
    found = ask("cone_map", [pair], coarse)
    ask("cone_map", pair, coarse)
    each(ask, found, "cell", 0)
    ask("region_around", found, [1, 0, 0.1])
    ask("regions", found)
    each(ask, v.cone_map([v.Pair(BALL, LONG)], coarse), "cell", 1)
    opening = v.PlacedOpening(ask("Opening.circle", 2), [6, 0.5, 0])
    each(ask, opening, "at", [0.1, 0.2])
    each(ask, v.Opening.polygon(SQUARE), "depth", [0.5, 0.5])
    for one in (opening, v.Orifice()):
        each(ask, ask("OrificeOracle", BALL, one), "transit", w)
    ask("rim_distance", BALL, LONG, opening)
    ask("rim_distance", v.WorldBody(hull), opening)
    window = v.MeshWindow(RING, RING_SIDES, 0)
    each(ask, window, "cone", BALL, [1, 0, 0], coarse)
    each(ask, window, "crossings_along", still, [1, 0.01, 0.02])
    each(ask, window, "transit", v.Pair(BALL, window.mesh()), [1, 0, 0])
    each(ask, window, "transit", BALL, [1, 0, 0])


def laws(ask: Ask) -> None:
    """More of guidance."""
    g = v.guidance
    state = g.PlanarState(r=10, theta=0.1, v_theta=0.2, v_r=-1, alpha=0.2, beta=0.3, speed_a=2, speed_b=1)
    spatial = g.SpatialState(r=8, theta=0.1, phi=0.2, v_theta=0.3, v_phi=0.1, v_r=-2, speed_a=2, speed_b=1)
    cone, options, errors = g.PlaneCone(psi=0.3, theta_b=0.1), g.LawOptions(), g.Measured(v_r=0.01, v_theta=0.02, theta=0.001, theta_b=0.001, psi=0.002)
    a = g.BodyState(shape=v.WorldBody(BALL), velocity=[2, 0.2, 0])
    b = g.BodyState(shape=v.WorldBody(v.Ellipsoid.from_axes([9, 1, 2], [2, 1, 1])), position=[9, 1, 2], velocity=[-1, 0, 0.3])
    for name, more in (("avoidance", [options]), ("cooperative_avoidance", [options, 0.5]), ("cooperative_rendezvous", [options]), ("cone_rates", []),
                       ("matching_rendezvous", [options, 1]), ("measured", [errors]), ("noise_gradients", [1]), ("noise_range", [errors]),
                       ("noise_terms", [errors, 1])):
        ask(f"guidance.{name}", state, cone, *more)
    for name in ("common_deviation", "deviation"):
        ask(f"guidance.{name}", errors, errors)
    for one in (state, spatial):
        ask("guidance.cartesian", one)
    ask("guidance.planar_state", g.Cartesian2(p_b=[5, 1], v_a=[1, 0.1]))
    motion = g.Cartesian3(p_b=[5, 0.1, 0.1], v_a=[1, 0.1, 0])
    ask("guidance.spatial_state", motion)
    ask("guidance.planar_rates", state, g.PlanarInputs())
    ask("guidance.spatial_rates", spatial, g.DirectedAcceleration(), g.DirectedAcceleration())
    ask("guidance.rendezvous_cone", state, 0.5)
    ask("guidance.clearance_law", a, b, g.ClearanceOptions())
    other = g.Intruder(body=v.Placed(v.Body(LONG)), velocity=[0, 0, 0])
    ask("guidance.bands", v.Placed(v.Body(BALL)), [1, 0, 0], [other], g.BandOptions(horizon=v.Horizon(until=9)))
    ask("guidance.alert_bands", v.Placed(v.Body(BALL)), [1, 0, 0], [other], [1, 0], g.BandOptions(horizon=v.Horizon(until=9)))
    ask("guidance.avoid", v.Placed(v.Body(BALL)), [1, 0, 0], [1, 0, 0], [other], g.AvoidOptions(until=9))
    ask("guidance.velocity_map", v.Placed(v.Body(BALL)), [other], g.VelocityMapOptions(resolution=0.5, until=9))
    ask("guidance.barrier", v.Pair(BALL, LONG), [1, 0, 0], [0, 0, 0], 9)
    ask("guidance.choose_plane", a, b, v.SectorMethod.slice, g.PlaneOptions())
    ask("guidance.guide", a, b, g.GuideOptions(), g.GuideMemory(), 0)
    ring = g.OrificeState(opening=v.PlacedOpening(v.Opening.ellipse([2, 1.5]), [6, 0.5, 0]))
    each(ask, ring, "after", 0.5)
    ask("guidance.orifice_aim", a, ring)
    ask("guidance.passage_law", a, ring, g.PassageLawOptions())
    ask("guidance.orifice_law", motion, 2, 0.5, g.OrificeLawOptions())
    for one in (a, options, g.ClearanceOptions(), g.GuideOptions()):
        ask("guidance.check", one)
    ask("guidance.check", g.RobustModel(), g.RobustOptions())
    ask("guidance.robust_correction", 0.1, 0, 1, g.RobustModel(), g.RobustOptions())
    foci = g.FocalState(position=[0, 0], velocity=[2, 0], foci=([8, 1], [10, 1]), a=2)
    for form in g.FocalForm:
        ask("guidance.focal_cone", foci, form)
    ask("guidance.least_focal_sum", foci)
    each(ask, ask("guidance.FocalLaw", g.FocalGains(), g.FocalForm.polynomial), "step", foci, 0)
    each(ask, ask("guidance.VerticalLaw", g.VerticalGains()), "step", 200, 1, 100, 0)
    each(ask, g.EnclosingEllipse(centre=[9, 1], a=2, b=1, angle=0.3), "reach", [1, 0])
    for name in ("ConstantVelocityFilter", "SetMembershipFilter"):
        ask(f"guidance.{name}")
    each(ask, ask("guidance.SingerFilter"), "start", np.zeros(6), np.eye(6), 0)
    started = v.guidance.SingerFilter()
    started.start(np.zeros(6), np.eye(6), 0)
    each(ask, started, "predicted", 0.5)
    ask("guidance.EllipseFollower", 2)
    each(ask, ask("guidance.Navigator", g.NavigatorOptions()), "step", a, [b], None, 0, 0.1)


def numbers_of_bodies(ask: Ask) -> None:
    """More of the exact numbers."""
    ask("exact.sign", THIRD)
    for name, a, b in (("exact.RationalBody2", DISC, FLAT), ("exact.RationalBody3", BALL, LONG)):
        ask(name)
        both = [ask(name, body) for body in (a, b)]
        ask("exact.position", *both)
        ask("exact.relation", *both)


def files(ask: Ask) -> None:
    here = Path.cwd()
    ask("files.write_points", here / "cloud.ply", cloud())
    ask("files.write_points", here / "mesh.off", CORNERS, SIDES)
    ask("files.read_points", here / "cloud.ply")
    ask("files.triangle_mesh", v.files.read_points(write(here / "tetrahedron.obj", OBJ)))
    ask("files.triangles_of", CORNERS, [[0, 1, 2, 3]])
    dent = v.files.Polygon(outline=[[0, 0], [4, 0], [4, 4], [2, 1], [0, 4]])
    ask("files.convex_pieces", dent)
    ask("files.raised", dent, 4.0)
    ask("files.are_collinear", [0, 0, 0], [1, 1, 1], [2, 2, 2])


def fitting(ask: Ask) -> None:
    f, here = v.fitting, Path.cwd()
    sample = f.Sample(points=cloud())
    shape = f.Shape.ellipsoid
    ask("fitting.parameters", shape)
    ask("fitting.check", [[LONG.quadric()]], f.Sample(points=cloud() * 0.3 + [8, 1, 2]), 0)
    ask("fitting.inside_certificate", [[LONG.quadric()]], f.Sample(points=cloud() * 0.3 + [8, 1, 2]))
    options = f.FitOptions(shape=shape)
    found = ask("fitting.fit", sample, options)
    pieces = found.pieces
    ask("fitting.scan_to_hull", pieces, sample)
    ask("fitting.hull_to_scan", pieces, f.Sample(points=CORNERS, triangles=SIDES), 50)
    ask("fitting.volume", pieces)
    ask("fitting.enclose", pieces, sample, f.Assignment(points=[0] * 60))
    ask("fitting.enclosed_volume", f.Sample(points=CORNERS, triangles=SIDES))
    ask("fitting.rounded", [0.1, 0.2, 0.3])
    each(ask, f.Frame(), "to_frame to_world", [1, 2, 3])
    v.files.write_points(here / "scan.ply", cloud())
    scan = ask("fits.read_scan", str(here / "scan.ply"))
    ask("fits.describe", scan)
    ask("fits.write_fit", scan, options, found, 0.1, here)


def scenes(ask: Ask) -> None:
    here, file = Path.cwd(), EXAMPLES / "first.yaml"
    ask("scenes.scene_of_text", file.read_text(encoding="utf-8"), file)
    scene = ask("scenes.read_scene", file)
    ask("scenes.write_scene", scene, here / "scene.yaml")
    ask("scenes.write_body", v.scenes.SceneBody(placed=v.Placed(v.Body(LONG))), here / "body.yaml")
    ask("scenes.read_body", here / "body.yaml")


def vehicles(ask: Ask) -> None:
    p, water = v.vehicles, v.simulation.Current([0.1, 0, 0])
    fish, swims = p.FishParameters(), p.FishState(u=0.05)
    drone = p.QuadrotorOptions()
    for one in (fish, drone):
        ask("vehicles.check", one)
    for name in ("ellipsoid_of", "sphere_of"):
        ask(f"vehicles.{name}", fish)
    ask("vehicles.fish_forces", fish, swims, p.TailAngle(0.1, 0.2, 0), 3)
    ask("vehicles.fish_rates", fish, swims, p.TailAngle(0.1, 0.2, 0), 0, 3, water, 0)
    ask("vehicles.fish", p.FishOptions(depth=3))
    start = v.simulation.Motion(velocity=[1, 0, 0])
    model = ask("vehicles.quadrotor", drone)
    each(ask, model, "limits", start)
    vehicle = ask("simulation.VehicleModel.launch", model, start, 0, v.simulation.Current())
    ask("simulation.Vehicle.advance", vehicle, v.simulation.VehicleCommand(), 0, 0.1, [])
    ask("simulation.Vehicle.log", vehicle, [])
    for name in ("motion", "broken"):
        ask(f"simulation.Vehicle.{name}", vehicle)


def motions(ask: Ask) -> None:
    s, here = v.simulation, [1, 0, 0]
    wave = s.Oscillation(offset=0.4, amplitude=0.3, rate=1)
    each(ask, wave, "at rate_at", 0.5)
    each(ask, wave, "range", 0, 1)
    ask("simulation.ShapeInTime")
    for shape in (s.RigidShape(v.WorldBody(BALL)), s.DentedConic(3, 1, wave), s.DentedQuadric([3, 1, 1], wave)):
        ask("simulation.ShapeInTime", shape)
        for name in ("check", "planar", "reach"):
            ask(f"simulation.{name}", shape)
    ask("simulation.Current")
    water = ask("simulation.Current", [0.1, 0, 0], s.Shear(), s.Gusts())
    each(ask, water, "carried", here)
    each(ask, water, "velocity", -1, 2)
    each(ask, water, "acceleration", 2)
    each(ask, water, "most", -5, 0)
    start = s.Motion(velocity=[2, 0.2, 0])
    arc = ask("simulation.Arc", start, [0, 0.1, 0], s.Orientation.fixed, 0, 2)
    curve = ask("simulation.Curve.steady", start, [0, 0, 0.1], 0, 2)
    jets = s.Jet(here), s.Jet([2, 0, 0])
    way = ask("simulation.quintic", *jets, 2)
    ask("simulation.Curve", way, np.zeros((6, 3)), np.eye(3), 0, 2)
    for leg in (arc, curve):
        for name in ("at", "acceleration", "turn"):
            ask(f"simulation.Leg.{name}", leg, 1)
            ask(f"{kind(leg)}.{name}", leg, 1)
    track = ask("simulation.Track", s.RigidShape(v.WorldBody(BALL)), start, s.Orientation.fixed, 0)
    each(ask, track, "advance", [0, 0.1, 0], 2)
    each(ask, track, "append", s.Curve.steady(track.motion(2), [0, 0, 0.1], 2, 6))
    each(ask, track, "motion acceleration state", 1)
    each(ask, track, "bounds", 0, 2)
    other = s.Track(s.RigidShape(v.WorldBody(BALL)), s.Motion(position=[9, 6, 0], velocity=[-1, 0, 0]), s.Orientation.fixed, 0)
    other.advance([0, 0, 0], 6)
    ask("simulation.prove", track, other, 0, 4)
    ring = s.MovingOrifice(name="ring", opening=v.Opening.circle(3), position=[5, 0.5, 0], rotation=[[0, 0, 1], [1, 0, 0], [0, 1, 0]])
    each(ask, ring, "at", 1)
    ask("simulation.prove_passage", track, ring, 0, 4)
    window = v.MeshWindow(RING, RING_SIDES, 0)
    wall = s.Track(s.RigidShape(v.WorldBody(window.mesh())), s.Motion(), s.Orientation.fixed, 0)
    wall.advance([0, 0, 0], 6)
    ask("simulation.prove_passage", track, window, wall, 0, 4)
    road = ask("simulation.lane_road", [0, 0], [10, 0], [s.LaneChange(at=1, seconds=2, acceleration=1)])
    ask("simulation.squircle_road", [0, 0], 50, 0.8, 60)
    ask("simulation.start_of", road, 0)
    ask("simulation.curves_of", road, 0, 0, 5, 0.1)
    ask("simulation.Road.at", road, 1)
    ask("simulation.Road.jumps", road)
    sensor, draw = s.Sensor(noise=s.Noise.isotropic, position=0.1, velocity=0.1), s.Draw(seed=1)
    ask("simulation.check", sensor)
    each(ask, sensor, "times", 2)
    each(ask, draw, "uniform normal", 3)
    a, b = track.state(1), other.state(1)
    ask("simulation.measure", sensor, a, b, draw)
    ask("simulation.share_of", 7, 10)
    ask("simulation.paired", [True, False], [False, False])


def runs(ask: Ask) -> None:
    s, here, file = v.simulation, Path.cwd(), EXAMPLES / "scenarios/noise.yaml"
    ask("scenario.scenario_of_text", file.read_text(encoding="utf-8"), "noise.yaml")
    whole = ask("scenario.read_scenario", str(file))
    scenario = whole.replace(duration=0.4)
    ask("simulation.check", scenario)
    ask("simulation.time_of_step", scenario, 3)
    for name in ("guarded", "minds_bodies", "most_commanded"):
        ask(f"simulation.{name}", scenario.bodies[0].pilot)
    own = ask("simulation.pilot_by", lambda t, agent, others: np.zeros(3))
    each(ask, own, "most orifices in_metres may_rest name")
    each(ask, own, "required", "B")
    each(ask, own, "limits", scenario.bodies[0], 0.01)
    run = ask("simulation.simulate", scenario, s.RunOptions())
    tables = ask("simulation.run_tables", scenario, run)
    text = ask("simulation.csv", tables[0])
    ask("simulation.Table.find", ask("simulation.table_of_csv", text, "text"), "t")
    ask("simulation.Table.rows", tables[0])
    ask("simulation.largest_drift", scenario, run)
    ask("simulation.find_event", scenario, run, s.EventKind.enters_cone, "agent", "obstacle")
    ask("simulation.sample_at", scenario, run, "agent", "obstacle", 0.2)
    rings = v.scenario.read_scenario(str(EXAMPLES / "scenarios/orifices.yaml")).replace(duration=0.4)
    ask("simulation.reach", rings)
    ask("simulation.largest_current", rings, [1, 0, 0], 0.1, 2)
    law, level = s.TrialLaw.di, s.TrialLevel(name="x2", times=2)
    ask("simulation.fly_trial", ask("simulation.trial_scenario", whole, law, level), 1)
    ask("scenario.write_run", scenario, run, v.scenario.RunOrigin(), here)


def tracks_of_others(ask: Ask) -> None:
    s, here = v.simulation, Path.cwd()
    times, points = [0.0, 1.0, 2.0], np.array([[0, 0, 0], [1, 0, 0], [2, 1, 0.0]])
    way = ask("simulation.piecewise_through", times, points)
    ask("simulation.piecewise_through", times, points, ask("simulation.velocities_through", times, points))
    ask("simulation.piecewise_of_powers", times, [points, points + [2, 1, 0]])
    ask("simulation.piecewise_of_spline", 2, [0, 0, 0, 1, 1, 1], points)
    each(ask, way, "at", 0.5)
    each(ask, way, "from_ to")
    ask("simulation.greatest", way, 1)
    trajectory = ask("simulation.turned_through", s.Trajectory(position=way), times, [np.eye(3)] * 3)
    ask("simulation.turned_along", s.Trajectory(position=v.simulation.piecewise_of_powers([0, 1], [points + [1, 0, 0]])), 1e-4)
    ball = s.ShapeInTime(s.RigidShape(v.WorldBody(BALL)))
    ask("simulation.fitted_track", ball, trajectory)
    bodies = [s.TrackedBody(name="A", shape=ball, trajectory=trajectory, most_speed=3),
              s.TrackedBody(name="B", shape=ball, start=s.Motion(position=[0, 9, 0]), radius=0.1)]
    certified = ask("simulation.certify", bodies, s.CertifyOptions(required=0.5))
    each(ask, certified, "verdict")
    ask("simulation.certificates", bodies, certified, s.CertifyOptions(required=0.5))
    file = EXAMPLES / "tracks/tracks.yaml"
    ask("scenario.read_tracks", str(file))
    ask("scenario.tracks_of_text", file.read_text(encoding="utf-8"), str(file))


def campaigns(ask: Ask) -> None:
    m, here = v.montecarlo, Path.cwd()
    settings, campaign = m.FlightSettings(), m.Campaign(engagements=1, laws=["exact"])
    flown = ask("montecarlo.laws_of", campaign)
    ask("scenario.fly_campaign", campaign)
    row = ask("montecarlo.measure", 1, 0, flown, settings)
    lines = [ask("montecarlo.settings_line", campaign), ask("montecarlo.csv_header", flown), ask("montecarlo.csv_row", 0, row)]
    ask("montecarlo.row_of", lines[-1], len(flown))
    ask("montecarlo.read_table", write(here / "engagements.csv", "".join(f"{line}\n" for line in lines)), len(flown))
    ask("montecarlo.violations", ask("montecarlo.summarise", [row], flown))


def swarm(ask: Ask) -> None:
    s = v.swarm
    balls = [s.Solid(), ask("swarm.Solid.ball", 1.5), s.Solid(half=[3, 1, 1])]
    each(ask, balls[2], "reach")
    for nearest in (s.Nearest.in_shape, s.Nearest.in_speed):
        ask("swarm.reciprocal_plane", balls[0], balls[1], [9, 1, 0], [1, 0, 0], 20, nearest)
    ask("swarm.nearest_velocity", [s.VelocityHalfSpace(normal=[0, 1, 0], offset=0.5)], 2, [1, 0, 0])
    agents = [s.Agent(body=balls[1], position=[x, 0, 0], goals=[[-x, 0.1, 0]]) for x in (-9, 9)]
    wall = [s.Obstacle(body=s.Solid(half=[1, 1, 1], box=True), position=[0, 9, 0])]
    flying = ask("swarm.Swarm", agents, wall, s.SwarmOptions())
    ask("swarm.SwarmOptions.published")
    ask("swarm.Swarm.step", flying)
    for name in ("time", "agents", "obstacles", "flown", "counts", "options", "heading"):
        ask(f"swarm.Swarm.{name}", flying)
    ask("swarm.fly", flying, s.FlightOptions(duration=1))
    ask("swarm.start_of", ask("swarm.start_names")[0], 5, 1)
    room = [s.Obstacle(body=s.Solid(half=np.where(np.eye(3)[k] > 0, 0.1, 9), box=True), position=9.0 * side * np.eye(3)[k])
            for k in range(3) for side in (-1, 1)]
    ask("swarm.start_amid", room, 1, 1)
    ask("swarm.start_of", v.scenario.scenario_of_text(SCENARIO_OF_AGENTS, "agents"))


def ships(ask: Ask) -> None:
    s = v.ships
    east, north = s.Sighting(velocity=[6, 0]), s.Sighting(position=[4000, -4000], velocity=[0, 6], ahead=[0, 1])
    for name in ("closest_approach", "classify"):
        ask(f"ships.{name}", east, north)
    ask("ships.compare_approach", east, north, 500)
    ask("ships.share_of_effort", s.Encounter.head_on)
    for name in ("fujii", "coldwell", "coldwell_overtaking"):
        ask(f"ships.Domain.{name}", 150)
    domain = ask("ships.Domain.goodwin")
    about = ask("ships.Domain.about", domain, [0, 0], 0.5)
    each(ask, domain, "reach")
    ask("ships.pass_with", s.Side.port, v.Ellipse(), about.translated([9000, 0]), [0, 6])
    ask("ships.encounter_names")
    ask("ships.Voyage.kept", ask("ships.sail", ask("ships.ships_of", "imazu-01"), s.FleetOptions(), s.VoyageOptions(duration=60)))


def octomap(ask: Ask) -> None:
    """A map of two cells."""
    file = Path.cwd() / "two.bt"
    file.write_bytes(b"# Octomap OcTree binary file\nid OcTree\nsize 3\nres 1e-4\ndata\n\x06\x00")
    tree, meaning = ask("octomap.read_octree", file), v.octomap.OctreeMeaning()
    each(ask, tree, "box", tree.cells[0])
    ask("octomap.obstacle_boxes", tree, meaning)


def lidar(ask: Ask) -> None:
    k = v.lidar
    shown = v.surface(DENT, 0.3)
    points, triangles = shown.vertices, [side.vertices for side in shown.triangles]
    mesh = ask("lidar.MeshScene", points, triangles)
    each(ask, mesh, "first_hit", [0, 0, 1], [1, 0, 0])
    each(ask, mesh, "sees", [0, 0, 1], [5, 0, 1], 1e-6)
    beams = ask("lidar.raster", 16, 16, 0.8, 0.8)
    each(ask, beams, "direction", 5)
    ask("lidar.spinning", [-0.1, 0, 0.1], 90)
    sensor = k.Lidar(beams=beams, min_range=0.1, max_range=50)
    ask("lidar.check", sensor)
    scan = ask("lidar.scan", mesh, sensor, np.eye(4), 1)
    each(ask, scan, "count", k.Beam.returned)
    ask("lidar.visible_part", mesh, points, triangles, [sensor], np.eye(4), 0.5)
    ask("lidar.fuse", [scan.sensor_points()] * 2, [np.eye(4)] * 2)


def scanning(ask: Ask) -> None:
    here = Path.cwd()
    write(here / "dent.obj", v.to_obj(v.surface(DENT, 0.5)))
    write(here / "scan.yaml", SCAN)
    setup = ask("scanning.read_scan_scene", here / "scan.yaml").setup.replace(planes=4, levels=1)
    mesh = v.lidar.MeshScene(setup.points, setup.triangles)
    ask("scanning.look", setup, mesh, setup.lidars)
    ask("scanning.study", setup)
    found = ask("scanning.scan_and_study", setup)
    ask("scanning.write_scan", setup, found, [1, 0, 0], [0, 0, 0], 0.1, here)


def vision(ask: Ask) -> None:
    s, here = v.vision, Path.cwd()
    camera, pose = v.Camera.of_field_of_view(160, 120, 0.8), v.Pose([0, 0, 60], v.nadir())
    ask("vision.most_acceleration_in_sight", camera, [0, 0, 60], 0, [[2, 1, 0]], [1, 0])
    each(ask, ask("vision.CameraMount", s.MountOptions()), "at", 0, pose)
    scene = ask("vision.Scene", s.SceneOptions(vehicles=[s.VehicleLook()]))
    placed = [s.PlacedVehicle(position=[2, 1])]
    pictures = [ask("vision.Scene.render", scene, camera, pose, placed, 0, 0, s.Image())]
    pictures.append(scene.render(camera, pose, [s.PlacedVehicle(position=[2.3, 1])], 0.04, 1, s.Image()))
    box = ask("vision.Scene.truth", scene, camera, pose, placed, 0)[0].box
    ask("vision.overlap", box, box)
    each(ask, scene, "set_occluders", [s.Occluder(centre=[20, 0], size=[5, 5], bottom=4, top=5)])
    ask("vision.Image")
    ask("vision.Image", 8, 6, 3)
    grey = [ask("vision.grey_of", picture) for picture in pictures]
    ask("vision.draw_sighting", s.Image(160, 120, 3), s.Sighting(box=box), "A")
    ask("vision.write_picture", here / "00.png", pictures[0])
    ask("vision.read_picture", here / "00.png", 3, "picture")
    video = ask("vision.VideoWriter", here / "video.mp4", 160, 120, 25)
    each(ask, video, "add", s.Image(160, 120, 3))
    each(ask, video, "close")
    reader = ask("vision.open_footage", here, 1, "footage")
    ask("vision.Reader.next", reader, s.Image())
    for name in ("rate", "frames", "broken"):
        ask(f"vision.Reader.{name}", reader)
    for name in ("source_tracker", "tracker"):
        tracker = ask(f"vision.{name}")
        ask("vision.Tracker.start", tracker, grey[0], [box])
        ask("vision.Tracker.step", tracker, grey[1], None, [])
        ask("vision.Tracker.add", tracker, box)


def work(ask: Ask) -> None:
    here = Path.cwd()
    ask("work.provenance", "a call", 1, [])
    staged = ask("work.StagedFolder", here / "staged")
    for name in ("path", "field"):
        ask(f"work.StagedFolder.{name}", staged)
    ask("work.StagedFolder.published", staged, staged.path())
    ask("work.StagedFolder.resumable", staged, "table.csv")
    ask("work.StagedFolder.publish", staged, [])
    ask("work.StagedFolder.abandon", staged)


def pursuits(ask: Ask) -> None:
    s = v.vision
    cars = [s.Car(name=name, road=v.simulation.lane_road(at, [20, 0], [])) for name, at in (("B1", [20, 12]), ("B2", [10, -14]))]
    view = s.View(camera=v.Camera.of_field_of_view(400, 300, 0.87), height=0.8)
    pursuit = s.Pursuit(duration=0.2, source_view=view, perspective_view=view, step=0.01, picture_step=0.04,
                        start=v.simulation.Motion(position=[0, 0, 140], velocity=[20, 0, 0]), cars=cars)
    ask("vision.perception_of", pursuit)
    run = ask("vision.pursue", pursuit)
    ask("vision.read_pursuit", str(EXAMPLES / "pursuits/two.yaml"))
    ask("vision.summarise", pursuit, run)


OBJ = "".join(f"v {x} {y} {z}\n" for x, y, z in CORNERS) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in SIDES)
SCAN = """
agent: {center: [0, 0, 0], semi_axes: [0.5, 0.5, 0.3]}
obstacle: {mesh: dent.obj}
agent_velocity: [1, 0, 0]
lidars:
  - {position: [0.2, 0, 0], towards: [1, 0, 0.1], beams: {rows: 16, columns: 16, horizontal: 0.8, vertical: 0.8}}
"""
SCENARIO_OF_AGENTS = """
name: agents
duration: 9
step: 0.1
bodies:
  - name: a
    shape: {semi_axes: [1, 1, 1]}
    position: [0, 0, 0]
    velocity: [0, 0, 0]
    pilot: {law: clearance, most: 2, fastest: 2, goals: [{point: [9, 0, 0], most: 2}]}
"""
# Why no call is answered by an overload: (name, its index).
UNREACHED: dict[tuple[str, int], str] = {}
ALL = (geometry, bodies, numbers, predicates, cones, questions, exact, numbers_of_bodies, guidance, laws, words, files, scenes, fitting,
       vehicles, motions, runs, tracks_of_others, campaigns, swarm, ships, octomap,
       lidar, scanning, vision, work, pursuits)
