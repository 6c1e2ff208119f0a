# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Bodies of a run (docs/reference/scenarios.md) as curves and meshes: true outlines and surfaces. Those of quadrics are
star-shaped about their centres: a distance for every direction, the least over what delimits them."""
import itertools
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import to_rgb

from .kinds import Array, Row, Shape
from .style import AGENT, EXACT, GREY, OBSTACLE, SLICE

MANY = 8  # bodies, or lines: more of them nobody can tell apart


def rotation(row: Row) -> Array:
    w, x, y, z = (row[n] for n in ("qw", "qx", "qy", "qz"))
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                     [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                     [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def regions(shape: Shape, k: float) -> list[tuple[Array, float]]:
    """Pairs (M, level): the body is where x.Mx <= level for all."""
    if shape["kind"] in ("dented_conic", "dented_quadric"):
        axes = np.array(shape.get("dented") or [shape["a_c"], shape["b_c"]])
        signs = np.full(len(axes), -1.0)
        signs[0] = 1
        return [(np.diag(axes ** -2.0), 1 + k), (np.diag(signs * axes ** -2.0), 1 - k)]
    inverse = np.linalg.inv(np.array(shape["factor"]))
    return [(inverse.T @ inverse, 1.0)] + [(np.array(d["matrix"]), d["level"]) for d in shape.get("delimiters", [])]


def radii(shape: Shape, k: float, directions: Array) -> Array:
    """How far the body reaches from its centre."""
    reach = np.full(directions.shape[:-1], np.inf)
    for m, level in regions(shape, k):
        form = np.einsum("...i,ij,...j->...", directions, m, directions)
        with np.errstate(divide="ignore", invalid="ignore"):
            reach = np.minimum(reach, np.where(form > 0, np.sqrt(level / form), np.inf))
    return reach


def outline(shape: Shape, row: Row, n: int = 181) -> Array:
    """A planar body's boundary at a row of bodies.csv."""
    angle = np.linspace(0, 2 * np.pi, n)
    u = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    points = radii(shape, row["k"], u)[:, None] * u
    return points @ rotation(row)[:2, :2].T + [row["x"], row["y"]]


def surface(shape: Shape, row: Row, n: int = 25) -> Array:
    """A body's boundary in space as a grid; not of hulls. Rings about its x axis, the axis of its dents, so that rims
    run along the mesh."""
    polar, around = np.linspace(0, np.pi, n), np.linspace(0, 2 * np.pi, 2 * n - 1)
    s = np.sin(polar)[:, None]
    u = np.stack(np.broadcast_arrays(np.cos(polar)[:, None], s * np.cos(around), s * np.sin(around)), axis=-1)
    u = u @ (np.array(shape["factor"], float) if "factor" in shape else np.diag(np.array(shape["dented"], float))).T
    u /= np.linalg.norm(u, axis=-1, keepdims=True)
    points = radii(shape, row["k"], u)[..., None] * u + np.array(shape.get("center", [0, 0, 0]))
    return points @ rotation(row).T + [row["x"], row["y"], row["z"]]


def facets(shape: Shape, row: Row, n: int = 25) -> Array:
    """Polygons of a body in space, and their outer normals."""
    if shape["kind"] == "hull":
        faces, middle = [posed(f, row) for f in hull_faces(shape["points"])], posed(np.mean(shape["points"], axis=0), row)
    else:
        grid = surface(shape, row, n)
        faces = [grid[[i, i + 1, i + 1, i], [j, j, j + 1, j + 1]] for i in range(n - 1) for j in range(2 * n - 2)]
        middle = posed(shape.get("center", [0, 0, 0]), row)
    shown, normals = [], []
    for face in faces:
        normal = np.cross(face[2] - face[0], face[-1] - face[1])
        size = np.linalg.norm(normal)
        if size < 1e-12:  # where the rings shrink to a point
            continue
        shown.append(face)
        normals.append(normal / size * (1 if normal @ (face.mean(axis=0) - middle) > 0 else -1))
    return shown, np.array(normals)


def hull_faces(points: Array) -> list[Array]:
    """Corners of the facets of the convex hull of few points, in order around each."""
    points = np.unique(np.array(points), axis=0)
    size, seen, faces = np.ptp(points, axis=0).max(), set(), []
    for triple in itertools.combinations(range(len(points)), 3):
        a, b, c = points[list(triple)]
        normal = np.cross(b - a, c - a)
        if np.linalg.norm(normal) < 1e-12 * size * size:
            continue
        normal /= np.linalg.norm(normal)
        height = (points - a) @ normal
        if height.max() > 1e-9 * size and height.min() < -1e-9 * size:
            continue
        on = tuple(np.nonzero(np.abs(height) <= 1e-9 * size)[0])
        if on in seen:
            continue
        seen.add(on)
        corners = points[list(on)] - points[list(on)].mean(axis=0)
        e = np.cross(normal, corners[0])
        order = np.argsort(np.arctan2(corners @ e / np.linalg.norm(e), corners @ corners[0] / np.linalg.norm(corners[0])))
        faces.append(points[np.array(on)[order]])
    return faces


def polygons(shape: Shape, near: Any = None) -> list[Any]:
    """Faces of a mesh, a map or a union of hulls in the body's own frame, and the points of a cloud as small squares;
    nothing of shapes that surface() draws. `near`: two corners of the box beyond which a map is left out, own frame."""
    if "triangles" in shape:
        return list(np.array(shape["triangles"]).reshape(-1, 3, 3))
    if "boxes" in shape:
        boxes = np.array(shape["boxes"])
        if near is not None:
            boxes = boxes[np.all((boxes[:, :3] >= near[0]) & (boxes[:, :3] <= near[1]), axis=1)]
        faces = []
        for axis, side in itertools.product(range(3), (-1, 1)):
            u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
            corners = np.stack([side * np.eye(3)[axis] + i * u + j * v for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
            faces += list(boxes[:, None, :3] + boxes[:, 3][:, None, None] * corners[None])
        return faces
    if "points" in shape and shape["kind"] == "cloud":
        points, half = np.array(shape["points"]), max(shape["radius"], 0.002 * np.ptp(np.array(shape["points"]), axis=0).max())
        square = half * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
        return list(points[:, None] + square[None])
    if shape["kind"] == "hull":
        return hull_faces(shape["points"])
    return [face for piece in shape.get("pieces", []) if piece["kind"] == "hull" for face in hull_faces(piece["points"])]


def lit(faces: Any, color: Any) -> Array:
    """The colour of each face under a light from above; both sides of a face are the same."""
    corners = np.array([f[:3] for f in faces])
    return shaded(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), color)


def shaded(normal: Array, color: Any) -> Array:
    """The colour of faces with these normals (n, 3) of any length."""
    length = np.linalg.norm(normal, axis=1)
    light = np.abs(normal @ [-0.35, -0.45, 0.82]) / np.where(length > 0, length, 1)
    return np.clip(np.array(to_rgb(color)) * (0.45 + 0.55 * light[:, None]), 0, 1)


def is_planar(shapes: Any) -> bool:
    return all(s["kind"] in ("ellipse", "dented_conic") for s in shapes.values())


def body_colors(names: list[str], agents: list[str]) -> dict[str, Any]:
    """One colour a body, agents first: what all pictures of a run have."""
    ordered = agents + [n for n in names if n not in agents]
    few = [AGENT, EXACT, SLICE, OBSTACLE, "#b0894f", "#c2418f", "#2aa3a3", GREY]
    return dict(zip(ordered, few if len(ordered) <= MANY else plt.get_cmap("turbo")(np.linspace(0.05, 0.95, len(ordered)))))


def posed(points: Array, row: Row) -> Array:
    return np.asarray(points) @ rotation(row).T + [row["x"], row["y"], row["z"]]
