# SPDX-License-Identifier: BSD-3-Clause
"""True outlines and surfaces of the bodies of a run. All are star-shaped about their centres: a distance for every
direction, the least over what delimits them."""
import itertools

import numpy as np


def rotation(q):
    """Of a unit quaternion (w, x, y, z)."""
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def forms(shape, k):
    """Matrices M and levels: the body is where x.M x <= level for all, in its own frame."""
    if "a_c" in shape or "dented" in shape:  # (5.5) and its counterpart in space: ellipse of 1 + k, hyperbola of 1 - k
        axes = np.array([shape["a_c"], shape["b_c"]] if "a_c" in shape else shape["dented"], float)
        signs = np.array([1.0] + [-1.0] * (len(axes) - 1))
        return [(np.diag(axes ** -2), 1 + k), (np.diag(signs * axes ** -2), 1 - k)]
    inverse = np.linalg.inv(np.array(shape["factor"], float))
    return [(inverse.T @ inverse, 1.0)] + [(np.array(d["matrix"], float), d["level"]) for d in shape.get("delimiters", [])]


def reach(shape, k, directions):
    """Distance of the boundary along unit directions, given as rows."""
    distance = np.full(len(directions), np.inf)
    for m, level in forms(shape, k):
        size = np.einsum("ij,jk,ik->i", directions, m, directions)
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = np.minimum(distance, np.where(size > 0, np.sqrt(level / size), np.inf))
    return distance


def pose(row):
    return rotation([row["qw"], row["qx"], row["qy"], row["qz"]]), np.array([row["x [m]"], row["y [m]"], row["z [m]"]])


def outline(shape, row, points=721):
    """Closed curve of a planar body at a row of its table."""
    angle = np.linspace(0, 2 * np.pi, points)
    directions = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    r, p = pose(row)
    return p[:2] + (directions * reach(shape, row["k"], directions)[:, None]) @ r[:2, :2].T


def hull_faces(points):
    """Facets of the convex hull of few points, as closed rings: every plane through three that has all on one side."""
    points = np.array(points, float)
    scale, faces = np.ptp(points), {}
    for triple in itertools.combinations(range(len(points)), 3):
        a, b, c = points[list(triple)]
        n = np.cross(b - a, c - a)
        if np.linalg.norm(n) < 1e-9 * scale ** 2:
            continue
        n /= np.linalg.norm(n)
        side = (points - a) @ n
        if side.max() > 1e-9 * scale:
            n, side = -n, -side
        if side.max() > 1e-9 * scale:
            continue
        ring = np.nonzero(np.abs(side) <= 1e-9 * scale)[0]
        middle = points[ring].mean(axis=0)
        u = points[ring[0]] - middle
        v = np.cross(n, u)
        order = np.argsort(np.arctan2((points[ring] - middle) @ v, (points[ring] - middle) @ u))
        faces[tuple(ring)] = points[ring[order]]
    return list(faces.values())


def surface(shape, row, n=36):
    """Polygons of a spatial body at a row of its table, and their outer normals."""
    r, p = pose(row)
    if "points" in shape:
        polygons = hull_faces(shape["points"])
        center = np.mean(shape["points"], axis=0)
    else:
        # Rings about the body's x axis, the axis of its dents, so that rims run along the mesh.
        polar, around = np.linspace(0, np.pi, n + 1), np.linspace(0, 2 * np.pi, 2 * n + 1)
        s = np.sin(polar)[:, None]
        d = np.stack(np.broadcast_arrays(np.cos(polar)[:, None], s * np.cos(around), s * np.sin(around)), axis=-1)
        scale = np.array(shape.get("semi_axes", shape.get("dented")), float)
        d = d * scale
        d /= np.linalg.norm(d, axis=-1, keepdims=True)
        grid = d * reach(shape, row["k"], d.reshape(-1, 3)).reshape(d.shape[:2])[..., None]
        polygons = [grid[[i, i + 1, i + 1, i], [j, j, j + 1, j + 1]] for i in range(n) for j in range(2 * n)]
        center = np.zeros(3)
    world, normals = [], []
    for polygon in polygons:
        diagonals = np.cross(polygon[2] - polygon[0], polygon[-1] - polygon[1])
        size = np.linalg.norm(diagonals)
        if size < 1e-12:
            continue
        normal = diagonals / size
        normal *= 1 if normal @ (polygon.mean(axis=0) - center) > 0 else -1
        world.append(p + polygon @ r.T)
        normals.append(r @ normal)
    return world, np.array(normals)
