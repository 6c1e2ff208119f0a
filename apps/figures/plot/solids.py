# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Combined quadrics in parallel projection with true outlines: the rims, and the contours where surfaces turn away
from the eye, as lines; what is behind something is found by intersecting the line of sight with the quadrics, not
with the mesh."""
from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb

from .kinds import Array, Axes, Data

ELLIPSOID, HYPERBOLOID, HIDDEN = "#8d6bb0", "#dd9a3c", "#9a9a9a"


class View:
    """Parallel projection along the direction from the eye; angles in degrees."""

    def __init__(self, azimuth: float, elevation: float) -> None:
        a, e = np.radians([azimuth, elevation])
        self.toward = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])  # to the eye
        self.right = np.array([-np.sin(a), np.cos(a), 0])
        self.up = np.cross(self.toward, self.right)
        self.light = self.toward + 0.5 * self.up - 0.45 * self.right
        self.light /= np.linalg.norm(self.light)

    def project(self, points: Array) -> Array:
        return np.stack([points @ self.right, points @ self.up], axis=-1)


class Solid:
    """One entry of "solids": the body's forms, which of its quadrics are shown, and their triangles."""

    def __init__(self, data: Data, colors: Any = (ELLIPSOID, HYPERBOLOID), shift: Array = (0, 0, 0)) -> None:
        body = data["body"]
        self.center = np.array(body["center"]) + np.array(shift)
        inverse = np.linalg.inv(np.array(body["factor"]))
        self.forms = [(inverse.T @ inverse, 1.0)]
        self.forms += [(np.array(d["matrix"]), d["level"]) for d in body["delimiters"]]
        self.extent = np.linalg.norm(np.array(body["factor"]), 2)
        mesh = data["mesh"]
        self.points = np.array(mesh["vertices"]) + np.array(shift) - self.center
        self.triangles, self.quadrics = np.array(mesh["triangles"]), np.array(mesh["quadrics"])
        self.shown = {"whole": range(len(self.forms)), "ellipsoid": [0],
                      "delimiters": range(1, len(self.forms))}[data["part"]]
        self.closed = data["part"] == "whole"
        self.colors = [np.array(to_rgb(c)) for c in colors]

    def color(self, quadric: int) -> Any:
        return self.colors[min(quadric, len(self.colors) - 1)]

    def hides(self, points: Array, toward: Array) -> Array:
        """Whether the way from each point to the eye meets a shown surface."""
        p = points - self.center
        hidden = np.zeros(len(p), bool)
        for i in self.shown:
            m, level = self.forms[i]
            a, b, c = toward @ m @ toward, p @ m @ toward, np.einsum("ij,jk,ik->i", p, m, p) - level
            root = np.sqrt(np.maximum(b * b - a * c, 0))
            with np.errstate(divide="ignore", invalid="ignore"):
                q = -(b + np.where(b < 0, -root, root))
                for s in (q / a, c / q):
                    y = p + s[:, None] * toward
                    hit = (b * b >= a * c) & (s > 1e-3 * self.extent) & np.isfinite(s)
                    for j, (other, bound) in enumerate(self.forms):
                        if j != i:
                            hit &= np.einsum("ij,jk,ik->i", y, other, y) <= bound + 1e-9
                    hidden |= hit
        return hidden

    def beside(self, points: Array) -> Array:
        """Points of chords of the surface moved off it: outwards, and inwards if the inside may be seen."""
        p = points - self.center
        if not self.closed:
            return [self.center + 1.004 * p, self.center + 0.996 * p]
        size = np.max([np.einsum("ij,jk,ik->i", p, m, p) / level for m, level in self.forms if level > 0], axis=0)
        return [self.center + 1.002 * p / np.sqrt(size)[:, None]]

    def gradients(self, points: Array) -> Array:
        """Of each triangle's form at a point of it."""
        g = np.empty_like(points)
        for q in np.unique(self.quadrics):
            g[self.quadrics == q] = points[self.quadrics == q] @ self.forms[q][0]
        return g

    def cut(self, other: Any) -> Array:
        """Cuts the triangles along the surfaces of another solid about the same centre; returns the curves."""
        links = []
        for m, level in other.forms:
            values = np.einsum("ij,jk,ik->i", self.points, m, self.points) - level
            values[np.abs(values) < 1e-9] = 0
            points, new, triangles, quadrics = list(self.points), {}, [], []

            def crossing(i: Any, j: Any, form: Any) -> Array:
                key = (min(i, j), max(i, j))
                if key not in new:
                    y, d = self.points[i], self.points[j] - self.points[i]
                    a, b, c = d @ m @ d, y @ m @ d, values[i]
                    roots = np.roots([a, 2 * b, c]) if a else np.array([-c / (2 * b)])
                    t = [r.real for r in roots if abs(r.imag) < 1e-9 and -1e-9 <= r.real <= 1 + 1e-9][0]
                    y = y + t * d
                    for _ in range(6):  # onto both surfaces: Newton's steps of least length
                        both = np.stack([form[0] @ y, m @ y])
                        y = y - np.linalg.lstsq(2 * both, both @ y - [form[1], level], rcond=None)[0]
                    new[key] = len(points)
                    points.append(y)
                return new[key]

            for t, q in zip(self.triangles, self.quadrics):
                f = values[t]
                parts = [t]
                for k in range(3):
                    u, v, w = t[k], t[(k + 1) % 3], t[(k + 2) % 3]
                    if values[v] * values[w] < 0 and f[k] == 0:
                        x = crossing(v, w, self.forms[q])
                        parts = [(u, v, x), (u, x, w)]
                        links.append((u, x))
                    elif values[u] * values[v] < 0 and values[u] * values[w] < 0:
                        x, y = crossing(u, v, self.forms[q]), crossing(u, w, self.forms[q])
                        parts = [(u, x, y), (x, v, w), (x, w, y)]
                        links.append((x, y))
                triangles += parts
                quadrics += [q] * len(parts)
            self.points, self.triangles, self.quadrics = np.array(points), np.array(triangles), np.array(quadrics)
        return chains([[(i, self.points[i]), (j, self.points[j])] for i, j in links], self.center)

    def contours(self, toward: Array) -> Array:
        """Where the surface turns away: toward.M y = 0, a plane through the centre for each quadric, so exact."""
        links = []
        values = np.stack([self.gradients(self.points[self.triangles[:, k]]) @ toward for k in range(3)], axis=1)
        for t in np.nonzero((values.min(axis=1) < 0) & (values.max(axis=1) >= 0))[0]:
            m, level = self.forms[self.quadrics[t]]
            if level == 0:
                continue
            ends = []
            for k in range(3):
                i, j = self.triangles[t][k], self.triangles[t][(k + 1) % 3]
                f, g = values[t][k], values[t][(k + 1) % 3]
                if (f < 0) != (g < 0):
                    y = (g * self.points[i] - f * self.points[j]) / (g - f)
                    size = y @ m @ y
                    ends.append(((min(i, j), max(i, j)), y * np.sqrt(level / size) if size > 0 else y))
            links.append(ends)
        return chains(links, self.center)

    def rims(self) -> Array:
        """Edges between different quadrics, and the borders of open surfaces."""
        seen: dict[Any, list[int]] = {}
        for t, q in zip(self.triangles, self.quadrics):
            for k in range(3):
                e = tuple(sorted((t[k], t[(k + 1) % 3])))
                seen.setdefault(e, []).append(q)
        links = [[(i, self.points[i]) for i in e] for e, q in seen.items() if len(set(q)) > 1 or len(q) == 1]
        return chains(links, self.center)


def chains(links: Any, center: Array) -> list[Array]:
    """Joins segments with the same ends to polylines."""
    at: dict[Any, list[int]] = {}
    where: dict[Any, Array] = {}
    for n, link in enumerate(links):
        for key, point in link:
            at.setdefault(key, []).append(n)
            where[key] = point
    used, lines = set(), []

    def walk(key: Any) -> Array:
        line = [key]
        while True:
            following = [n for n in at[key] if n not in used]
            if not following:
                return line
            used.add(following[0])
            ends = [k for k, _ in links[following[0]]]
            key = ends[1] if ends[0] == key else ends[0]
            line.append(key)

    for key in sorted(at, key=lambda k: len(at[k])):  # open ends first
        while any(n not in used for n in at[key]):
            lines.append(np.array([where[k] for k in walk(key)]) + center)
    return lines


def runs(line: Array, hidden: Array) -> Any:
    """The line cut where it becomes hidden or visible: (points, hidden)."""
    start = 0
    for i in range(1, len(hidden) + 1):
        if i == len(hidden) or hidden[i] != hidden[start]:
            yield line[start:i + 1], hidden[start]
            start = i


def refined(line: Array, steps: int = 4) -> Array:
    s = np.arange(0, len(line) - 1 + 1e-9, 1 / steps)
    return np.stack([np.interp(s, np.arange(len(line)), c) for c in line.T], axis=1)


def draw_lines(axes: Axes, view: View, lines: Any, solids: Any,
               surface: Any = None, color: Any = "k", width: float = 0.9, hidden_width: float = 0.5, zorder: float = 5) -> None:
    """Lines, on the surface of a solid or free; what is behind one of the solids dashed or left out."""
    if not lines:
        return
    lines = [refined(line) for line in lines]
    middles = np.vstack([0.5 * (line[1:] + line[:-1]) for line in lines])
    hidden = np.ones(len(middles), bool)
    for moved in surface.beside(middles) if surface else (middles,):
        hidden &= np.any([s.hides(moved, view.toward) for s in solids], axis=0)
    start = 0
    for line in lines:
        for piece, behind in runs(line, hidden[start:start + len(line) - 1]):
            if behind and not hidden_width:
                continue
            axes.plot(*view.project(piece).T, color=HIDDEN if behind else color,
                      linewidth=hidden_width if behind else width, linestyle=(0, (3, 2)) if behind else "-",
                      solid_capstyle="round", solid_joinstyle="round", zorder=zorder - 1 if behind else zorder)
        start += len(line) - 1


def draw_solids(axes: Axes, view: View, solids: Any, hidden_rims: bool = True, alpha: float = 1.0, fill: bool = True) -> None:
    faces, colors, depths = [], [], []
    for s in solids:
        corners = s.points[s.triangles]
        middles = corners.mean(axis=1)
        normals = s.gradients(middles)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        facing = normals @ view.toward
        light = np.maximum(0, (normals * np.where(facing > 0, 1, -1)[:, None]) @ view.light)
        seen = facing > 0 if s.closed else np.ones(len(facing), bool)
        for other in solids:  # far behind; the rest is painted over
            if other is not s:
                behind = other.hides(s.points + s.center, view.toward)
                seen &= ~behind[s.triangles].all(axis=1)
        for i in np.nonzero(seen)[0]:
            base = s.color(s.quadrics[i])
            base = base if facing[i] > 0 else 0.75 * base + 0.1
            colors.append(np.clip(base * (0.45 + 0.4 * light[i]) + 0.3 * light[i] ** 2, 0, 1))
        faces += list(view.project(corners[seen] + s.center))
        depths += list((middles[seen] + s.center) @ view.toward)
    if fill and faces:
        order = np.argsort(depths)
        # Edges in the colour of the faces close the seams that viewers leave between neighbours.
        axes.add_collection(PolyCollection([faces[i] for i in order], facecolors=[colors[i] for i in order],
                                           edgecolors="face", linewidths=0.25, alpha=alpha, zorder=2))
    for s in solids:
        draw_lines(axes, view, s.contours(view.toward), solids, s, hidden_width=0)
        draw_lines(axes, view, s.rims(), solids, s, hidden_width=0.45 if hidden_rims else 0)


def frame(axes: Axes, view: View, points: Array, margin: float = 0.04, below: float = 0.14) -> None:
    """Limits around all points with room below for the scale bar, from which lengths are read; no ticks."""
    flat = view.project(points)
    low, high = flat.min(axis=0), flat.max(axis=0)
    pad = margin * (high - low).max()
    axes.set_xlim(low[0] - pad, high[0] + pad)
    axes.set_ylim(low[1] - pad - below * (high[1] - low[1]), high[1] + pad)
    axes.set_aspect("equal")
    axes.axis("off")


def triad(axes: Axes, view: View, length: float = 0.1, at: Any = (0.1, 0.1)) -> None:
    """The directions of x, y and z in a corner, in parts of the axes' width."""
    inset = axes.inset_axes([at[0] - length, at[1] - length, 2 * length, 2 * length])
    for name, e in zip("xyz", np.eye(3)):
        tip = view.project(e)
        inset.annotate("", xy=tip, xytext=(0, 0), arrowprops={"arrowstyle": "-|>", "lw": 0.7, "color": "k",
                                                              "shrinkA": 0, "shrinkB": 0, "mutation_scale": 5})
        far = np.linalg.norm(tip)
        inset.text(*(tip + 0.32 * (tip / far if far > 0.2 else np.array([0.8, -0.6]))), name, fontsize=6.5,
                   ha="center", va="center")
    inset.set_xlim(-1.5, 1.5)
    inset.set_ylim(-1.5, 1.5)
    inset.set_aspect("equal")
    inset.axis("off")


def scale_bar(axes: Axes, length: float, x: Any = 0.97, y: Any = 0.04) -> None:
    """A bar of `length` metres in the lower right corner."""
    x1 = axes.get_xlim()[0] + x * np.ptp(axes.get_xlim())
    y0 = axes.get_ylim()[0] + y * np.ptp(axes.get_ylim())
    tick = 0.012 * np.ptp(axes.get_ylim())
    axes.add_collection(LineCollection([[(x1 - length, y0), (x1, y0)], [(x1 - length, y0 - tick), (x1 - length, y0 + tick)],
                                        [(x1, y0 - tick), (x1, y0 + tick)]], colors="k", linewidths=0.8, zorder=9))
    axes.text(x1 - length / 2, y0 + 1.5 * tick, "%g m" % length, fontsize=6.5, ha="center", va="bottom", zorder=9)
