# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Maps of all directions: around one of them, as the agent sees it, and the whole sphere; what collides, what is safe,
what is undecided, and the rim of the region around that direction."""
import collections.abc
from itertools import combinations
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from . import course as courses
from .kinds import Array, Axes, Data
from .style import EXACT, GREY, TWO_COLUMNS

COLORS = {"i": "#e0a58a", "o": "#dcebf5", "u": GREY}
NAMES = {"i": "collides", "o": "safe", "u": "undecided"}
RIM = EXACT


def unit(x: Any) -> Array:
    return x / np.linalg.norm(x, axis=-1, keepdims=True)


def dot(a: Array, b: Array) -> Array:
    return np.einsum("...i,...i", a, b)


class Map:
    """Labels of directions: cells are parts of an icosahedron's faces, halved along their edges."""

    def __init__(self, data: Data) -> None:
        corners = np.array(data["corners"])
        cells = corners[np.array(data["cells"])]
        self.labels = np.frombuffer(data["labels"].encode(), np.uint8)
        roots = corners[:12]
        edge = min(np.linalg.norm(a - b) for a, b in combinations(roots, 2))

        def near(a: Array, b: Array) -> bool:
            return bool(np.linalg.norm(a - b) < 1.2 * edge)

        self.faces = np.array([f if np.linalg.det(f) > 0 else (f[0], f[2], f[1]) for f in combinations(roots, 3)
                               if near(f[0], f[1]) and near(f[1], f[2]) and near(f[2], f[0])])
        level = np.round(np.log2(edge / np.linalg.norm(cells[:, 0] - cells[:, 1], axis=1))).astype(int)
        self.index = []  # by level: sorted numbers of cells, and which cells they are
        numbers = self.descend(cells.sum(axis=1), level.max())
        for k in range(level.max() + 1):
            here = np.flatnonzero(level == k)
            number = numbers[k][here]
            order = np.argsort(number)
            self.index.append((number[order], here[order]))

    def descend(self, directions: Array, levels: int) -> Array:
        """Numbers of the cells of each level that contain the directions."""
        # A direction is in the face of the regular icosahedron whose middle is nearest.
        number = np.argmax(directions @ self.faces.sum(axis=1).T, axis=1)
        a, b, c = (self.faces[number][:, k] for k in range(3))
        result = [number]
        for _ in range(levels):
            ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)

            def beyond(p: Any, q: Any, corner: Any) -> Array:
                normal = np.cross(p, q)
                return dot(directions, normal) * dot(corner, normal) > 0

            at = np.select([beyond(ab, ca, a), beyond(bc, ab, b), beyond(ca, bc, c)], [0, 1, 2], 3)[:, None]
            a, b, c = (np.choose(at, [a, ab, ca, ab]), np.choose(at, [ab, b, bc, bc]),
                       np.choose(at, [ca, bc, c, ca]))
            number = 4 * number + at[:, 0]
            result.append(number)
        return result

    def label(self, directions: Array) -> Array:
        found = np.zeros(len(directions), np.uint8)
        for (numbers, cells), here in zip(self.index, self.descend(directions, len(self.index) - 1)):
            if len(numbers) == 0:
                continue
            place = np.minimum(np.searchsorted(numbers, here), len(numbers) - 1)
            hit = numbers[place] == here
            found[hit] = self.labels[cells[place[hit]]]
        return found


def show(axes: Axes, labels: Any, extent: Array) -> None:
    order = "iou"
    number = np.zeros(labels.shape, int)
    for k, letter in enumerate(order):
        number[labels == ord(letter)] = k
    axes.imshow(number, cmap=ListedColormap([COLORS[k] for k in order]), vmin=0, vmax=2, extent=extent,
                origin="lower", interpolation="nearest", aspect="equal")


def frame(towards: Array) -> tuple[Array, Array]:
    up = np.array([0, 0, 1.0]) if abs(towards[2]) < 0.999 else np.array([1.0, 0, 0])
    up = unit(up - (up @ towards) * towards)
    return np.cross(towards, up), up


def on_view(directions: Array, towards: Array) -> Array:
    """Degrees to the right of and above a unit direction; angles from it keep their size (azimuthal equidistant)."""
    right, up = frame(towards)
    d = unit(np.array(directions))
    angle = np.arctan2(np.linalg.norm(np.cross(d, towards), axis=-1), d @ towards)
    across = np.stack([d @ right, d @ up], axis=-1)
    length = np.linalg.norm(across, axis=-1, keepdims=True)
    return np.degrees(angle)[..., None] * across / np.maximum(length, 1e-300)


def on_sky(x: Any, y: Any, towards: Array) -> Array:
    """The unit directions that on_view() shows at (x, y), degrees."""
    right, up = frame(towards)
    angle = np.hypot(x, y)
    across = (x[..., None] * right + y[..., None] * up) / np.maximum(angle, 1e-300)[..., None]
    t = np.radians(angle)[..., None]
    return np.cos(t) * towards + np.sin(t) * across


def mark(axes: Axes, data: Data, project: collections.abc.Callable[[Any], Any]) -> None:
    """The scene's velocity, where the data have it."""
    if data.get("course"):
        axes.plot(*np.ravel(project(data["course"]["velocity"])), "o", color=courses.color(data["course"]), markersize=5,
                  markeredgecolor="w", markeredgewidth=0.7)


def view(axes: Axes, sphere: "Map", data: Data, towards: Array, pixels: int = 900,
         reach: float | None = None) -> None:
    """Angles from the direction keep their size: azimuthal equidistant."""
    def project(d: Any) -> Array:
        return on_view(d, towards)

    loops = [project(loop) for loop in data["region"]["boundary"]] if data["region"] else []
    if reach is None:
        reach = max((np.abs(loop).max() for loop in loops), default=60)
        reach = min(1.35 * reach, 100) if loops else 60
    x = (np.arange(pixels) + 0.5) / pixels * 2 * reach - reach
    x, y = np.meshgrid(x, x)
    directions = on_sky(x, y, towards)
    show(axes, sphere.label(directions.reshape(-1, 3)).reshape(x.shape), (-reach, reach, -reach, reach))
    for loop in loops:
        axes.plot(*np.vstack([loop, loop[:1]]).T, color=RIM, linewidth=1)
    axes.plot(0, 0, "k+", markersize=5)
    mark(axes, data, project)
    axes.set_xlim(-reach, reach)
    axes.set_ylim(-reach, reach)
    axes.set_xlabel("to the right of the direction + (deg)")
    axes.set_ylabel("above it (deg)")
    axes.set_title("as seen by the agent", fontsize=8)


def whole(axes: Axes, sphere: "Map", data: Data, towards: Array, pixels: int = 1440) -> None:
    azimuth = np.radians((np.arange(pixels) + 0.5) / pixels * 360 - 180)
    elevation = np.radians((np.arange(pixels // 2) + 0.5) / pixels * 360 - 90)
    a, e = np.meshgrid(azimuth, elevation)
    directions = np.stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)], axis=-1)
    show(axes, sphere.label(directions.reshape(-1, 3)).reshape(a.shape), (-180, 180, -90, 90))

    def project(d: Any) -> Array:
        d = unit(np.array(d))
        return np.degrees(np.stack([np.arctan2(d[..., 1], d[..., 0]), np.arcsin(np.clip(d[..., 2], -1, 1))], axis=-1))

    for loop in data["region"]["boundary"] if data["region"] else []:
        points = project(loop + loop[:1])
        jump = np.flatnonzero(np.abs(np.diff(points[:, 0])) > 180) + 1
        points = np.insert(points, jump, np.nan, axis=0)
        axes.plot(*points.T, color=RIM, linewidth=1)
    if towards is not None:
        axes.plot(*project(towards), "k+", markersize=5)
    mark(axes, data, project)
    axes.set_xlim(180, -180)  # as seen from inside
    axes.set_ylim(-90, 90)
    axes.set_xticks(range(180, -181, -60))
    axes.set_yticks(range(-90, 91, 30))
    axes.set_xlabel("azimuth (deg)")
    axes.set_ylabel("elevation (deg)")
    axes.set_title("all directions of relative velocity", fontsize=8)


def handles(data: Data) -> list[Any]:
    """What the colours mean, with solid angles."""
    size = {"i": data["colliding"], "o": data["safe"], "u": data["undecided"]}
    return [Patch(facecolor=COLORS[k], edgecolor="#888888", linewidth=0.4, label="%s %.4g sr" % (NAMES[k], size[k]))
            for k in "iou"]


def cone_map(data: dict[str, Any]) -> plt.Figure:
    """A cone map, from cone_map.json."""
    towards = unit(np.array(data["towards"]))
    sphere = Map(data)
    figure, (left, right) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 3.4 if data.get("course") else 3.2), width_ratios=(1, 1.75))
    view(left, sphere, data, towards)
    whole(right, sphere, data, towards)
    for axes in (left, right):
        axes.set_axisbelow(False)
        axes.grid(False)
    shown = handles(data)
    region = data["region"]
    if region:
        shown.append(Line2D([], [], color=RIM, label="region around +: %s, %.4g to %.4g sr" % (
            NAMES[region["label"][0]], region["solid_angle"], region["most_solid_angle"])))
    else:
        shown.append(Line2D([], [], color="k", marker="+", linestyle="", label="direction asked about: undecided"))
    course = data.get("course")
    if course:
        shown.append(Line2D([], [], color=courses.color(course), marker="o", linestyle="", label="the scene's velocity, " +
                              courses.sentence(course)))
    figure.legend(handles=shown, loc="lower center", ncols=min(len(shown), 4 if not course else 3), frameon=False, columnspacing=1.2)
    title = data["title"] or "Cone map"
    figure.suptitle("%s: %s cells, edges below %.3g rad%s" % (
        title, format(len(data["cells"]), ","), data["resolution"], "" if data["complete"] else ", not complete"),
        fontsize=8.5)
    figure.tight_layout(rect=(0, 0.08 if not course else 0.14, 1, 1))
    return figure
