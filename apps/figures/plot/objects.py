# SPDX-License-Identifier: BSD-3-Clause
"""vericone's objects as the plain numbers that the drawing code takes (docs/reference/formats.md). They are known by
what they have, not by their types: the scripts of the command draw without the library's modules."""
import numbers
import sys
from typing import Any

import numpy as np

from .orifices import quaternion

Numbers = Any  # what numpy makes an array of


def has(thing: Any, *names: str) -> bool:
    return all(hasattr(thing, name) for name in names)


def refused(argument: str, given: str, requirement: str) -> ValueError:
    """An argument whose value cannot be used: vericone's InputError, where the library is there."""
    library: Any = sys.modules.get("vericone")
    if library is not None:
        error: ValueError = library.InputError(argument, given, requirement)
        return error
    return ValueError("%s: got %s, must be %s" % (argument, given, requirement))


def wrong_kind(argument: str, given: Any, requirement: str) -> TypeError:
    """An argument of another kind."""
    return TypeError("%s: got %s, must be %s" % (argument, type(given).__name__, requirement))


def array_of(given: Numbers, argument: str, requirement: str) -> Any:
    """An array of finite numbers."""
    if isinstance(given, (str, bytes)) or given is None:
        raise wrong_kind(argument, given, requirement)
    try:
        array = np.asarray(given, float)
    except (TypeError, ValueError):
        raise wrong_kind(argument, given, requirement) from None
    wrong = np.argwhere(~np.isfinite(array))
    if len(wrong):
        raise refused(argument + "".join("[%d]" % i for i in wrong[0]), str(array[tuple(wrong[0])]), "finite")
    return array


def points_of(given: Numbers, argument: str, sides: tuple[int, ...] = (3,)) -> Any:
    """Points (n, 3), or (n, 2) where `sides` has 2, metres."""
    wanted = "points of shape %s" % " or ".join("(n, %d)" % side for side in sides)
    points = array_of(given, argument, wanted)
    if points.ndim != 2 or points.shape[1] not in sides or not len(points):
        raise refused(argument, "no points" if not points.size else "an array of shape %s" % (points.shape,), wanted)
    return points


def vector_of(given: Numbers, argument: str, sides: tuple[int, ...] = (3,)) -> Any:
    """A vector of 3 numbers, or of 2 where `sides` has 2."""
    wanted = "a vector of shape %s" % " or ".join("(%d,)" % side for side in sides)
    vector = array_of(given, argument, wanted)
    if vector.shape not in [(side,) for side in sides]:
        raise refused(argument, "an array of shape %s" % (vector.shape,), wanted)
    return vector


def direction_of(given: Numbers, argument: str) -> Any:
    """The unit vector along a vector that is not zero."""
    vector = vector_of(given, argument)
    largest = np.abs(vector).max()
    if largest == 0:
        raise refused(argument, "[0, 0, 0]", "a vector that is not zero")
    vector = vector / largest
    return vector / np.linalg.norm(vector)


def number_of(given: Any, argument: str, least: float) -> float:
    if not isinstance(given, numbers.Real):
        raise wrong_kind(argument, given, "a number")
    if not least <= float(given) < np.inf:
        raise refused(argument, str(given), "finite, %g or more" % least)
    return float(given)


def value(thing: Any) -> Any:
    """A field is read, a method without arguments is called."""
    return thing() if callable(thing) else thing


def word(answer: Any) -> str:
    """The name of a value of an enumeration: "in" of Verdict.in_."""
    return str(getattr(answer, "name", answer)).rstrip("_")


def row_of(position: Numbers, rotation: Numbers) -> dict[str, float]:
    """A pose as a row of bodies.csv."""
    turn = np.eye(3)
    given = np.asarray(rotation, float)
    turn[:len(given), :len(given)] = given
    x, y, z = [*np.asarray(position, float), 0.0][:3]
    w, i, j, k = quaternion(turn)
    return {"x": x, "y": y, "z": z, "qw": w, "qx": i, "qy": j, "qz": k, "k": float("nan")}


def quadric_shape(body: Any) -> dict[str, Any]:
    """Of an ellipse or ellipsoid, delimited or not."""
    ellipsoid = body.ellipsoid() if has(body, "delimiters") else body
    center, factor = np.asarray(ellipsoid.center()), np.asarray(ellipsoid.factor())
    given = [] if body is ellipsoid else body.delimiters()
    delimiters = [{"matrix": np.asarray(d.matrix), "level": d.level} for d in given]
    return {"kind": "ellipse" if len(center) == 2 else "ellipsoid", "center": center, "factor": factor,
            "delimiters": delimiters}


def assembly_shape(assembly: Any) -> dict[str, Any]:
    """Of triangles, balls, boxes or hulls."""
    kind, parts = word(assembly.kind()), assembly.by_slot()
    if kind == "triangle":
        return {"kind": "mesh", "triangles": np.asarray(parts.triangles, float).reshape(-1, 3, 3)}
    if kind == "ball":
        return {"kind": "cloud", "points": np.asarray(parts.balls, float), "radius": assembly.radius()}
    if kind == "box":
        low = np.array([np.asarray(box.low) for box in parts.boxes])
        high = np.array([np.asarray(box.high) for box in parts.boxes])
        return {"kind": "boxes", "triangles": box_triangles(low, high)}
    if kind == "convex":
        rings = 16 if len(parts.convexes) <= 20 else 6
        return {"kind": "mesh", "triangles": np.concatenate([convex_triangles(b, rings) for b in parts.convexes])}
    return {"kind": "pieces", "pieces": [{"kind": "hull", "points": np.asarray(h.points())} for h in parts.hulls]}


def convex_triangles(body: Any, rings: int = 16) -> Any:
    """The surface between the points farthest along a grid of directions about z, in the body's frame."""
    polar = np.pi * np.clip((np.arange(rings + 2) - 0.5) / rings, 0, 1)[:, None]
    azimuth = np.pi * (np.arange(2 * rings) + 0.5) / rings
    normals = np.stack(np.broadcast_arrays(np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)), -1)
    grid = np.array([[np.asarray(body.support_point(n)) for n in ring] for ring in normals])
    a, b, c, d = grid[:-1], grid[1:], np.roll(grid[1:], -1, axis=1), np.roll(grid[:-1], -1, axis=1)
    faces = np.stack([np.stack([a, b, c], 2), np.stack([a, c, d], 2)], 2).reshape(-1, 3, 3)
    areas = np.linalg.norm(np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0]), axis=1)
    return faces[areas > 1e-9 * np.ptp(grid.reshape(-1, 3), axis=0).max() ** 2]


def box_triangles(low: Any, high: Any) -> Any:
    """Twelve triangles a box, from opposite corners (n, 3)."""
    corner = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)])
    at = np.where(corner[None], high[:, None], low[:, None])
    sides = [[0, 1, 3], [0, 3, 2], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 3, 7], [2, 7, 6], [0, 2, 6],
             [0, 6, 4], [1, 3, 7], [1, 7, 5]]
    return at[:, sides].reshape(-1, 3, 3)


def shape_and_row(thing: Any, argument: str = "thing") -> tuple[dict[str, Any], dict[str, float]]:
    """What a body is and where it stands; `argument` is named in errors. Takes ellipses, ellipsoids, combined bodies, hulls, assemblies, bodies,
    placed ones, bodies of scenes and of the world, meshes ({points, triangles}), and arrays of points (n, 3)."""
    if isinstance(thing, dict):
        return thing, row_of([0, 0, 0], np.eye(3))
    if isinstance(thing, (np.ndarray, list, tuple)):
        return {"kind": "cloud", "points": points_of(thing, argument), "radius": 0.0}, row_of([0, 0, 0], np.eye(3))
    if isinstance(thing, type):
        raise TypeError("%s: got the type %s, must be an object" % (argument, thing.__name__))
    if has(thing, "placed") and value(thing.placed) is not None:
        return shape_and_row(value(thing.placed), argument)
    if has(thing, "body", "pose"):
        shape, _ = shape_and_row(thing.body, argument)
        return shape, row_of(thing.pose.position, thing.pose.rotation)
    at_origin = row_of([0, 0, 0], np.eye(3))
    if has(thing, "factor", "center") or has(thing, "delimiters", "ellipsoid"):
        return quadric_shape(thing), at_origin
    if has(thing, "by_slot"):
        return assembly_shape(thing), at_origin
    if has(thing, "support_point", "margin"):
        return {"kind": "convex", "triangles": convex_triangles(thing)}, at_origin
    if has(thing, "flat", "quadric", "hull"):  # a body of the world that is not placed
        parts = (thing.flat(), thing.quadric(), thing.hull())
        return shape_and_row(next(part for part in parts if part is not None), argument)
    if has(thing, "kind", "shape"):
        made_of = thing.shape()
        if not isinstance(made_of, list):
            return shape_and_row(made_of, argument)
        return {"kind": "pieces", "pieces": [quadric_shape(piece) for piece in made_of]}, at_origin
    if has(thing, "points", "triangles"):
        points, triangles = points_of(value(thing.points), argument + ".points"), np.asarray(value(thing.triangles))
        if len(triangles):
            if triangles.min() < 0 or triangles.max() >= len(points):
                raise refused(argument + ".triangles", "a point %d" % triangles.max(), "of points 0 to %d" % (len(points) - 1))
            return {"kind": "mesh", "triangles": points[triangles]}, at_origin
        return {"kind": "cloud", "points": points, "radius": 0.0}, at_origin
    if has(thing, "points"):
        return {"kind": "hull", "points": points_of(value(thing.points), argument + ".points")}, at_origin
    raise wrong_kind(argument, thing, "a body, a placed one, a mesh, or points (n, 3)")


def course_of(pair: Any, agent_velocity: Numbers, obstacle_velocity: Numbers) -> dict[str, Any]:
    """What a pair of velocities (m/s) leads to, seen from the obstacle, as apps/src/picture/course.h writes it."""
    contact, miss = pair.contact(agent_velocity, obstacle_velocity), pair.miss(agent_velocity, obstacle_velocity)
    course: dict[str, Any] = {"velocity": np.subtract(agent_velocity, obstacle_velocity),
                              "verdict": word(pair.verdict(agent_velocity, obstacle_velocity))}
    if contact is not None:
        course["contact_time"] = contact.time if np.isfinite(contact.time) else contact.earliest
        if contact.point is not None:
            course["contact_point"] = contact.point - course["contact_time"] * np.asarray(obstacle_velocity, float)
    elif course["verdict"] == "out":
        course["miss_distance"], course["nearest_time"] = miss.distance, miss.time
    return course


def loops_of(cone: Any, argument: str = "thing") -> tuple[list[Any], list[Any], Any]:
    """Inner and outer polygons of directions of a cone of any kind, and its axis (nothing where it does not say)."""
    wanted = "a Cone, TrueCone, SliceCone, PolyhedralCone, ConeBounds or ConeMap"
    if has(cone, "verdict", "cone"):
        raise wrong_kind(argument, cone, wanted + ": its cone() is one")
    axis = np.asarray(cone.axis) if has(cone, "axis") else None
    if has(cone, "inner", "outer"):
        inner, outer = cone.inner, cone.outer
        if has(inner, "directions"):  # bounds of a cone of two ellipsoids
            inner, outer = [inner.directions], [outer.directions]
        return [np.asarray(x) for x in inner], [np.asarray(x) for x in outer], axis
    if has(cone, "boundary"):
        loop = np.array([np.asarray(sample.direction) for sample in cone.boundary])
    elif has(cone, "directions") and not callable(cone.directions):
        loop = np.asarray(cone.directions)
    elif has(cone, "polyhedral"):
        loop = np.asarray(cone.polyhedral().directions)
    else:
        raise wrong_kind(argument, cone, wanted)
    return [loop], [loop], axis


def solid_angle_of(cone: Any) -> tuple[float, float]:
    """Steradian, between which the true value lies; of a slice cone its own twice."""
    angle = value(cone.solid_angle) if has(cone, "solid_angle") else cone.polyhedral().solid_angle
    if has(angle, "lo", "hi"):
        return float(angle.lo()), float(angle.hi())
    off = cone.solid_angle_error if has(cone, "solid_angle_error") else 0.0
    return float(angle) - off, float(angle) + off


def map_data(cone_map: Any) -> dict[str, Any]:
    """A map as cone_map.json has it, without its region."""
    if not has(cone_map, "cells", "corners", "undecided"):
        raise wrong_kind("thing", cone_map, "a ConeMap" + ("; cone() draws cones" if has(cone_map, "solid_angle") else ""))
    cells = cone_map.cells
    letters = "".join(cell.label.name[0] for cell in cells)
    return {"title": "", "corners": np.asarray(cone_map.corners),
            "cells": np.array([np.asarray(cell.corners) for cell in cells]), "labels": letters,
            "colliding": cone_map.colliding, "safe": cone_map.safe, "undecided": cone_map.undecided,
            "complete": cone_map.complete, "region": None}
