# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""A scan and its quadric hull. The scan is drawn solid, the hull translucent over it with its outlines and rims; rings
where points touch the hull."""
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path

from .kinds import Array, Axes, Data
from .solids import Solid, View, draw_lines
from .style import EXACT, GREY, SLICE, TWO_COLUMNS

SCAN, TOUCH = "#7f8f7a", "#c01f1f"
FRONT, SIDE, ABOVE, ASKEW = View(-90, 0), View(0, 0), View(-90, 90), View(-60, 25)


class Cylinder:
    """The upright cylinder over a footprint, with what Solid has of it for outlines: its rims, and its sides."""

    def __init__(self, piece: Data) -> None:
        footprint, mesh = piece["footprint"], piece["mesh"]
        self.center = np.zeros(3)
        self.points = np.array(mesh["vertices"])
        self.triangles, self.quadrics = np.array(mesh["triangles"]), np.array(mesh["quadrics"])
        turn = np.linspace(0, 2 * np.pi, 145)
        self.ring = np.array(footprint["center"]) + np.stack([np.cos(turn), np.sin(turn)], axis=1) @ np.array(
            footprint["factor"]).T
        self.heights = (footprint["low"], footprint["high"])

    def rims(self) -> Array:
        return [np.column_stack([self.ring, np.full(len(self.ring), z)]) for z in self.heights]

    def contours(self, toward: Array) -> Array:
        across = self.ring @ np.array([-toward[1], toward[0]])
        if np.hypot(*toward[:2]) < 1e-9:
            return []
        return [np.array([[*self.ring[i], z] for z in self.heights]) for i in (across.argmin(), across.argmax())]

    def hides(self, points: Array, _: Any) -> Array:
        return np.zeros(len(points), bool)

    def beside(self, points: Array) -> Array:
        return [points]


class Faceted:
    """A solid by its surface alone, with what Solid has of it for outlines: the edges at which it turns."""

    def __init__(self, piece: Data) -> None:
        mesh = piece["mesh"]
        self.center = np.zeros(3)
        self.points = np.array(mesh["vertices"])
        self.triangles, self.quadrics = np.array(mesh["triangles"]), np.array(mesh["quadrics"])
        self.normals = corner_normals(self.points[self.triangles])
        sides: dict[tuple[int, int], list[int]] = {}
        for number, (a, b, c) in enumerate(self.triangles):
            for edge in ((a, b), (b, c), (c, a)):
                sides.setdefault((min(edge), max(edge)), []).append(number)
        self.edges = [(edge, of) for edge, of in sides.items() if len(of) == 2]

    def rims(self) -> Array:
        sharp = [edge for edge, (i, j) in self.edges if self.normals[i] @ self.normals[j] < 0.8]
        return [self.points[list(edge)] for edge in sharp]

    def contours(self, toward: Array) -> Array:
        front = self.normals @ toward > 0
        return [self.points[list(edge)] for edge, (i, j) in self.edges if front[i] != front[j]]

    def hides(self, points: Array, _: Any) -> Array:
        return np.zeros(len(points), bool)

    def beside(self, points: Array) -> Array:
        return [points]


def corner_normals(triangles: Array) -> Array:
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(normal, axis=1)
    return normal / np.where(length > 0, length, 1)[:, None]


def draw_scan(axes: Axes, view: "View", scan: Data) -> None:
    if "points" in scan:
        points = np.array(scan["points"])
        depth = points @ view.toward
        order = np.argsort(depth)
        near = (depth - depth.min()) / max(np.ptp(depth), 1e-300)
        colors = np.array(to_rgb(SCAN)) * (1.25 - 0.75 * near[:, None])
        axes.scatter(*view.project(points[order]).T, s=1.6, c=np.clip(colors[order], 0, 1), linewidths=0, zorder=2,
                     rasterized=True)
        return
    triangles = np.array(scan["triangles"]).reshape(-1, 3, 3)
    normal = corner_normals(triangles)
    facing = normal @ view.toward
    light = np.maximum(0, (normal * np.where(facing > 0, 1, -1)[:, None]) @ view.light)[:, None]
    colors = np.clip(np.array(to_rgb(SCAN)) * (0.45 + 0.5 * light) + 0.25 * light ** 2, 0, 1)
    order = np.argsort(triangles.mean(axis=1) @ view.toward)
    axes.add_collection(PolyCollection(view.project(triangles[order]), facecolors=colors[order], edgecolors="face",
                                       linewidths=0.2, zorder=2, rasterized=True))


def draw_hull(axes: Axes, view: "View", solids: Any) -> None:
    for s in solids:
        corners = s.points[s.triangles] + s.center
        front = corner_normals(corners) @ view.toward > 0
        for of, color in ((s.quadrics == 0, EXACT), (s.quadrics != 0, SLICE if isinstance(s, Solid) else EXACT)):
            flat = view.project(corners[front & of])
            if len(flat) == 0:
                continue
            # One path of all triangles: separate translucent ones would show their common edges.
            closed = np.concatenate([flat, flat[:, :1]], axis=1).reshape(-1, 2)
            codes = np.tile([Path.MOVETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY], len(flat))
            axes.add_patch(PathPatch(Path(closed, codes), facecolor=color, alpha=0.16, linewidth=0, zorder=3))
    for s in solids:
        draw_lines(axes, view, s.contours(view.toward), solids, s, color=EXACT, hidden_width=0, zorder=6)
        draw_lines(axes, view, s.rims(), solids, s, color=SLICE if isinstance(s, Solid) else EXACT, hidden_width=0.45,
                   zorder=6)


def draw(axes: Axes, view: "View", data: Data, solids: Any) -> None:
    draw_scan(axes, view, data["scan"])
    draw_hull(axes, view, solids)
    if data["touching"]:
        axes.plot(*view.project(np.array(data["touching"])).T, "o", markersize=3, markerfacecolor="none",
                  markeredgecolor=TOUCH, markeredgewidth=0.6, zorder=8)


def flat_range(view: "View", points: Array) -> Array:
    flat = view.project(points)
    low, high = flat.min(axis=0), flat.max(axis=0)
    pad = 0.05 * (high - low).max()
    return low - pad, high + pad


def limits(axes: Axes, view: "View", points: Array) -> None:
    low, high = flat_range(view, points)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal")
    axes.ticklabel_format(useOffset=False, style="plain")
    axes.locator_params(nbins=6)


def parts(data: Data) -> tuple[list[Any], Array]:
    """The pieces of the hull, and all points that must be seen."""
    solids: list[Any] = [Cylinder(p) if "footprint" in p else Solid(p, colors=(EXACT, SLICE)) if "body" in p else
                         Faceted(p) for p in data["hull"]]
    scan = data["scan"]
    shown = np.array(scan["points"]) if "points" in scan else np.array(scan["triangles"]).reshape(-1, 3)
    return solids, np.vstack([s.points + s.center for s in solids] + [shown])


def fit(data: dict[str, Any]) -> plt.Figure:
    """From fit_picture.json: from the front, from the side, from above, and askew."""
    solids, everything = parts(data)
    size = np.ptp(everything, axis=0)
    # All three views at about the same scale: columns as wide as x and y, rows as high as z and y; thin ones still legible.
    size = np.maximum(size, 0.35 * size.max())
    height = min(max(1.5 + 5.6 * (size[2] + size[1]) / (size[0] + size[1]), 4.2), 8.4)
    figure = plt.figure(figsize=(TWO_COLUMNS, height))
    gap = 0.66  # inches, for the labels below one row and the titles of the next
    grid = figure.add_gridspec(2, 2, width_ratios=size[[0, 1]], height_ratios=size[[2, 1]], left=0.09, right=0.985,
                               bottom=0.5 / height, top=1 - 0.72 / height, wspace=0.24,
                               hspace=2 * gap / (height - 1.22 - gap))
    for place, view, title, names in ((grid[0, 0], FRONT, "from the front", "xz"), (grid[0, 1], SIDE, "from the side", "yz"),
                                      (grid[1, 0], ABOVE, "from above", "xy")):
        axes = figure.add_subplot(place)
        draw(axes, view, data, solids)
        limits(axes, view, everything)
        axes.set_title(title)
        axes.set_xlabel(names[0] + " (m)")
        axes.set_ylabel(names[1] + " (m)")
    axes = figure.add_subplot(grid[1, 1])
    draw(axes, ASKEW, data, solids)
    limits(axes, ASKEW, everything)
    axes.axis("off")
    axes.set_title("askew, in parallel projection")
    figure.suptitle(data["title"], fontsize=9, y=1 - 0.1 / height)
    handles = [Patch(color=SCAN, label="scan" + (", thinned for the picture" if data["scan"]["thinned"] else "")),
               Patch(facecolor=(*to_rgb(EXACT), 0.3), edgecolor=EXACT, label="hull"),
               Line2D([], [], color=GREY, linewidth=0.6, linestyle=(0, (3, 2)), label="behind")]
    if any(len(set(s.quadrics)) > 1 for s in solids if isinstance(s, Solid)):
        handles.insert(2, Patch(facecolor=(*to_rgb(SLICE), 0.3), edgecolor=SLICE, label="its hyperboloids"))
    else:
        handles.pop()
    if data["touching"]:
        handles.append(Line2D([], [], color=TOUCH, marker="o", markersize=3, markerfacecolor="none", linestyle="",
                              label="touches"))
    figure.legend(handles=handles, loc="upper center", ncol=len(handles), frameon=False,
                  bbox_to_anchor=(0.5, 1 - 0.26 / height))
    return figure
