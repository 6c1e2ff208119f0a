# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Bodies of every kind, points, openings and ways, on axes of the plane or of space, metres."""
import importlib
import weakref
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .bodies import lit, outline, polygons, posed, shaded, surface
from .objects import Numbers, has, points_of, refused, shape_and_row, vector_of, wrong_kind
from .style import AGENT, OBSTACLE, style

FEW = 60  # points of a hull whose faces are found here
SPHERES = 300  # balls of a cloud that are drawn as such; more of them are dots of their size
EXTENTS: "weakref.WeakKeyDictionary[Any, Any]" = weakref.WeakKeyDictionary()  # of axes in space: corners of what is drawn on them
# Of axes in space: dots that stand for balls, and the radius of these, metres. References: dots hold their axes.
BALLS: "weakref.WeakKeyDictionary[Any, Any]" = weakref.WeakKeyDictionary()


def space(figsize: tuple[float, float] = (4.2, 3.8)) -> Any:
    """New axes in space. What is drawn on them later keeps equal scales on x, y and z."""
    with style():
        axes = plt.figure(figsize=figsize).add_axes([0.02, 0.04, 0.9, 0.92], projection="3d", computed_zorder=False)
        axes.set_proj_type("ortho")
        return axes


def plane(figsize: tuple[float, float] = (4.2, 3.2)) -> Any:
    """New axes of the plane with equal scales, metres."""
    with style():
        axes = plt.figure(figsize=figsize, constrained_layout=True).add_subplot()
        frame_plane(axes)
        return axes


def frame_plane(axes: Any) -> None:
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_axisbelow(True)
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")


def fit_space(axes: Any, points: Any) -> None:
    """Widens axes in space so that points (n, 3) are seen, with equal scales."""
    points = np.asarray(points, float).reshape(-1, 3)
    corners = np.array([points.min(axis=0), points.max(axis=0)])
    if axes in EXTENTS:
        corners = np.array([np.minimum(corners[0], EXTENTS[axes][0]), np.maximum(corners[1], EXTENTS[axes][1])])
    EXTENTS[axes] = corners
    middle, sides = corners.mean(axis=0), np.ptp(corners, axis=0)
    sides = np.maximum(sides, 0.25 * max(sides.max(), 1e-300))
    axes.set_box_aspect(sides.copy(), zoom=0.92)  # it scales what it is given
    for name, at, side in zip("xyz", middle, sides):
        getattr(axes, "set_%slim" % name)(at - side / 2, at + side / 2)
        getattr(axes, "set_%slabel" % name)("%s (m)" % name)
        axes.locator_params(axis=name, nbins=5 if side > 0.5 * sides.max() else 3)
    axes.tick_params(labelsize=6)
    for reference, radius in BALLS.get(axes, []):
        dots = reference()
        if dots is not None:
            dots.set_sizes(np.array([dot_size(axes, radius)]))


def axes_for(axes: Any, flat: bool) -> Any:
    """The axes that are given, where they are of the plane or of space as wanted; else new ones."""
    if axes is None:
        return plane() if flat else space()
    if not has(axes, "plot", "get_xlim"):
        raise wrong_kind("axes", axes, "axes of Matplotlib")
    if flat == has(axes, "get_zlim"):
        kinds = ("axes of the plane", "axes of space")
        raise refused("axes", kinds[flat], "%s, as plot.%s() makes" % (kinds[not flat], "plane" if flat else "space"))
    return axes


def dot_size(axes: Any, radius: float) -> float:
    """The area, square points, of a dot as large as a ball of this radius (m) in the middle of axes in space."""
    axes.apply_aspect()
    middle = np.array([sum(getattr(axes, "get_%slim" % name)()) / 2 for name in "xyz"])
    ends = np.vstack([middle, middle + radius * np.eye(3)])
    at = axes.get_proj() @ np.column_stack([ends, np.ones(4)]).T
    pixels = axes.transData.transform((at[:2] / at[3]).T)
    reach = np.linalg.svd(pixels[1:] - pixels[0], compute_uv=False)[0]
    return float(max(2 * reach * 72 / axes.figure.dpi, 1.2) ** 2)


def sphere_faces(n: int) -> Any:
    """Faces (2 n (n - 1), 4, 3) of the unit sphere, and their outer normals."""
    polar, around = np.linspace(0, np.pi, n), np.linspace(0, 2 * np.pi, 2 * n + 1)
    s = np.sin(polar)[:, None]
    grid = np.stack(np.broadcast_arrays(s * np.cos(around), s * np.sin(around), np.cos(polar)[:, None]), axis=-1)
    faces = np.stack([grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]], axis=2).reshape(-1, 4, 3)
    return faces, faces.mean(axis=1)


def draw_balls(axes: Any, centers: Any, radius: float, color: Any, alpha: float) -> Any:
    """Returns corners of boxes around them."""
    if len(centers) <= SPHERES:
        faces, normals = sphere_faces(15 if len(centers) <= 30 else 8)
        shown = centers[:, None, None] + radius * faces
        colors = np.column_stack([shaded(normals, color), np.full(len(faces), alpha)])
        axes.add_collection3d(Poly3DCollection(shown.reshape(-1, 4, 3), facecolor=np.tile(colors, (len(centers), 1)), linewidth=0))
    else:
        dots = axes.scatter(*centers.T, color=color, linewidths=0, alpha=alpha)
        BALLS.setdefault(axes, []).append((weakref.ref(dots), radius))
    return np.vstack([centers - radius, centers + radius])


def faces_of(shape: dict[str, Any]) -> list[Any]:
    """Polygons in the body's own frame; of hulls of many points none."""
    if shape["kind"] == "hull" and len(shape["points"]) > FEW:
        return hull_triangles(shape["points"])
    return polygons(shape) if shape["kind"] != "boxes" else list(shape["triangles"])


def hull_triangles(points: Any) -> list[Any]:
    """Of a hull of many points, where SciPy is installed; else its points are drawn."""
    try:
        hull = importlib.import_module("scipy.spatial").ConvexHull(points)
    except ImportError:
        return []
    return list(points[hull.simplices])


def draw_in_space(axes: Any, shape: dict[str, Any], row: dict[str, float], color: Any, alpha: float) -> Any:
    """Returns points of what is drawn."""
    if shape["kind"] == "cloud" or (shape["kind"] == "hull" and not faces_of(shape)):
        points = posed(shape["points"], row)
        if shape.get("radius"):
            return draw_balls(axes, points, shape["radius"], color, alpha)
        axes.scatter(*points.T, s=1.5, color=color, linewidths=0, alpha=alpha)
        return points
    quadrics = [p for p in shape.get("pieces", [shape]) if "factor" in p]
    seen = []
    for quadric in quadrics:
        grid = surface(quadric, row, 31)
        axes.plot_surface(*np.moveaxis(grid, -1, 0), rstride=1, cstride=1, color=color, alpha=alpha, linewidth=0)
        seen.append(grid.reshape(-1, 3))
    if not quadrics:
        faces = [posed(face, row) for face in faces_of(shape)]
        edges = {"edgecolor": "k", "linewidth": 0.2} if len(faces) <= 300 else {"linewidth": 0}
        colors = np.column_stack([lit(faces, color), np.full(len(faces), alpha)])
        axes.add_collection3d(Poly3DCollection(faces, facecolor=colors, **edges))
        seen += faces
    return np.vstack(seen)


def body(thing: Any, *, axes: Any = None, color: Any = OBSTACLE, alpha: float = 0.7, label: str | None = None) -> Any:
    """Draws a body where it stands, metres, and returns the axes: of the plane for ellipses and combined ellipses, else
    of space. `thing`: an ellipsoid, a combined body, a hull, an assembly, a Body, a Placed, a mesh, or points (n, 3).
    `axes`: on which to draw; they grow. Balls of a cloud are as large as they are; of more than 300 those are dots,
    flat. Cost: a second for 50,000 triangles."""
    shape, row = shape_and_row(thing)
    flat = shape["kind"] == "ellipse"
    with style():
        axes = axes_for(axes, flat)
        if flat:
            center = dict(zip("xy", np.asarray(shape["center"]) + [row["x"], row["y"]]))
            points = outline(shape, {**row, **center}, 721)
            axes.fill(*points.T, facecolor=color, alpha=0.55 * alpha, linewidth=0)
            axes.plot(*points.T, color=color, linewidth=1.1, label=label)
        else:
            fit_space(axes, draw_in_space(axes, shape, row, color, alpha))
            if label:
                axes.plot([], [], [], "s", color=color, label=label)
        if label:
            axes.legend(loc="upper left")
    return axes


def opening(placed: Any, *, axes: Any = None, color: Any = "#b08a1e", label: str | None = None) -> Any:
    """Draws the rim of a PlacedOpening, metres, and returns the axes in space."""
    if not has(placed, "opening", "center", "axes"):
        raise wrong_kind("placed", placed, "a PlacedOpening")
    own = placed.opening
    if own.polygonal():
        rim = np.vstack([own.vertices(), own.vertices()[:1]])
    else:
        turn = np.linspace(0, 2 * np.pi, 97)
        rim = np.stack([np.cos(turn), np.sin(turn)], axis=1) * np.asarray(own.semi_axes())
    points = np.asarray(placed.center) + rim @ np.asarray(placed.axes).T
    return line(points, axes=axes, color=color, label=label)


def line(points: Numbers, *, axes: Any = None, color: Any = "k", label: str | None = None, width: float = 1.4) -> Any:
    """Draws a line through points (n, 3) or (n, 2), metres, and returns the axes."""
    points = points_of(points, "points", (3, 2))
    with style():
        axes = axes_for(axes, points.shape[1] == 2)
        axes.plot(*points.T, color=color, linewidth=width, label=label)
        if points.shape[1] == 3:
            fit_space(axes, points)
        if label:
            axes.legend(loc="upper left")
    return axes


def arrow(start: Numbers, vector: Numbers, *, axes: Any = None, color: Any = "k", label: str | None = None) -> Any:
    """Draws an arrow from a point, (3,) or (2,), metres, and returns the axes. A velocity (m/s) is drawn as long as it
    goes in a second."""
    start = vector_of(start, "start", (3, 2))
    vector = vector_of(vector, "vector", (len(start),))
    with style():
        axes = axes_for(axes, len(start) == 2)
        if len(start) == 3:
            axes.quiver(*start, *vector, color=color, linewidth=1.3, arrow_length_ratio=0.12, label=label)
            fit_space(axes, np.array([start, start + vector]))
        else:
            axes.plot(*np.array([start, start + vector]).T, color=color, linewidth=1.2, label=label)
            axes.annotate("", xy=start + vector, xytext=start,
                          arrowprops={"arrowstyle": "-|>", "color": color, "lw": 1.2, "shrinkA": 0, "shrinkB": 0})
        if label:
            axes.legend(loc="upper left")
    return axes


def track(flown: Any, *, axes: Any = None, color: Any = AGENT, bodies: int = 5, label: str | None = None) -> Any:
    """Draws the way of a Track with its body at some instants, metres, and returns the axes in space."""
    if not has(flown, "appears", "end", "motion", "state"):
        raise wrong_kind("flown", flown, "a Track, as Run.tracks has them")
    times = np.linspace(flown.appears(), flown.end(), 200)
    axes = line(np.array([np.asarray(flown.motion(t).position) for t in times]), axes=axes, color=color, label=label)
    for n, t in enumerate(np.linspace(flown.appears(), flown.end(), bodies)):
        body(flown.state(t).shape, axes=axes, color=color, alpha=0.15 + 0.4 * n / max(bodies - 1, 1))
    return axes
