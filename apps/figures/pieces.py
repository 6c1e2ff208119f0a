# SPDX-License-Identifier: BSD-3-Clause
"""The cone around a mesh, a cloud, a map or a hull seen from outside, from pieces.json: agent, body and the cone's
surface in parallel projection; and every direction around the axis, coloured by the distance to the first contact."""
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import to_rgb

from plot import course as courses
from plot.directions import along_axis, colour_bar
from plot.solids import View, frame, scale_bar, triad
from vericone_figures.style import AGENT, EXACT, GREY, OBSTACLE, TWO_COLUMNS, plt, read, save

data = read("pieces.json")
apex, axis, e1, e2 = (np.array(x) for x in (data["agent"]["center"], data["axis"], data["e1"], data["e2"]))


def view_of():
    """From the side of the axis and from above; from the left or the right as it is."""
    if abs(axis[2]) > 0.9:
        return View(-60, 15)
    return View(np.degrees(np.arctan2(axis[1], axis[0])) - 55, 24)


def ball_triangles(body, steps=24):
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 2 * steps + 1), np.linspace(0, np.pi, steps + 1), indexing="ij")
    x = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)], axis=-1)
    x = x @ np.array(body["factor"]).T + np.array(body["center"])
    a, b, c, d = x[:-1, :-1], x[1:, :-1], x[1:, 1:], x[:-1, 1:]
    quads = np.stack([a, b, c, d], axis=2).reshape(-1, 4, 3)
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def cubes(boxes, view):
    """The sides of each box that are turned to the eye, as triangles."""
    c, h = boxes[:, None, :3], boxes[:, 3][:, None, None]
    sides = []
    for k in range(3):
        s = 1 if view.toward[k] > 0 else -1
        u, v = np.eye(3)[(k + 1) % 3], np.eye(3)[(k + 2) % 3]
        corners = np.stack([s * np.eye(3)[k] + i * u + j * v for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
        quad = c + h * corners[None]
        sides += [quad[:, [0, 1, 2]], quad[:, [0, 2, 3]]]
    return np.concatenate(sides)


def shade(triangles, view, color):
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(normal, axis=1)
    normal = normal / np.where(length > 0, length, 1)[:, None]
    facing = normal @ view.toward
    light = np.maximum(0, (normal * np.where(facing > 0, 1, -1)[:, None]) @ view.light)
    base = np.array(to_rgb(color))
    return np.clip(base * (0.42 + 0.45 * light[:, None]) + 0.28 * light[:, None] ** 2, 0, 1)


class Depth:
    """How near to the eye something is drawn, on a grid over the picture."""

    def __init__(self, view, points, cells=220):
        self.view = view
        flat = view.project(points)
        self.low, self.size = flat.min(axis=0), max(np.ptp(flat, axis=0).max(), 1e-12) / cells
        self.grid = np.full((cells + 2, cells + 2), -np.inf)
        i, j = self.cell(points)
        np.maximum.at(self.grid, (i, j), points @ view.toward)

    def cell(self, points):
        at = ((self.view.project(points) - self.low) / self.size).astype(int)
        return at[:, 0], at[:, 1]

    def hides(self, points):
        i, j = self.cell(points)
        inside = (i >= 0) & (j >= 0) & (i < len(self.grid)) & (j < len(self.grid))
        hidden = np.zeros(len(points), bool)
        hidden[inside] = self.grid[i[inside], j[inside]] > points[inside] @ self.view.toward + 2 * self.size
        return hidden


def filled(triangles):
    """Corners, middles of sides and centroids: enough points for the depth grid."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return np.concatenate([a, b, c, (a + b) / 2, (b + c) / 2, (a + c) / 2, (a + b + c) / 3])


def line(axes, points, depth, color, width, hidden_width=0.0, zorder=6):
    middles = 0.5 * (points[1:] + points[:-1])
    hidden = depth.hides(middles)
    flat = depth.view.project(points)
    parts = np.stack([flat[:-1], flat[1:]], axis=1)
    axes.add_collection(LineCollection(parts[~hidden], colors=color, linewidths=width, zorder=zorder, capstyle="round"))
    if hidden_width:
        axes.add_collection(LineCollection(parts[hidden], colors=color, linewidths=hidden_width, alpha=0.35, zorder=1.5))


def body_triangles(view):
    body = data["body"]
    if "triangles" in body:
        return np.array(body["triangles"]).reshape(-1, 3, 3)
    if "boxes" in body:
        return cubes(np.array(body["boxes"]), view)
    return np.zeros((0, 3, 3))


def hull_outline(points, view):
    """The outline of a convex hull in the picture."""
    p = view.project(points)
    p = p[np.lexsort(p.T[::-1])]

    def half(sequence):
        chain = []
        for q in sequence:
            while len(chain) > 1 and np.cross(chain[-1] - chain[-2], q - chain[-2]) <= 0:
                chain.pop()
            chain.append(q)
        return chain[:-1]

    return np.array(half(p) + half(p[::-1]))


def outline(axes, points, view, color, zorder):
    axes.fill(*hull_outline(points, view).T, facecolor=color, alpha=0.45, edgecolor=color, linewidth=0.9, zorder=zorder)


def extreme_curve(reach):
    """Of the cone's surface at a distance from the agent; the directions between half-planes on circles."""
    found = [d if d is None else np.array(d) for d in data["directions"]]
    return [None if d is None else apex + reach * d for d in found]


def space(axes):
    view = view_of()
    triangles = body_triangles(view)
    colors = shade(triangles, view, OBSTACLE)
    cloud = np.array(data["body"].get("points", [])).reshape(-1, 3)
    hulls = [np.array(h) for h in data["body"].get("hulls", [])]
    solid = filled(triangles) if len(triangles) else np.zeros((0, 3))
    shown = [solid, cloud] + hulls
    agent = data["agent"]
    if "factor" in agent:
        ball = ball_triangles(agent)
        triangles, colors = np.concatenate([triangles, ball]), np.concatenate([colors, shade(ball, view, AGENT)])
        shown.append(filled(ball))
    else:
        shown.append(np.array(agent["points"]))
    order = np.argsort(triangles.mean(axis=1) @ view.toward) if len(triangles) else []
    axes.add_collection(PolyCollection(view.project(triangles[order]), facecolors=colors[order], edgecolors="face",
                                       linewidths=0.25, zorder=2, rasterized=True))
    if len(cloud):
        near = cloud @ view.toward
        order = np.argsort(near)
        tint = 0.35 + 0.65 * (near - near.min()) / max(np.ptp(near), 1e-12)
        axes.scatter(*view.project(cloud[order]).T, s=1.2, linewidths=0, zorder=2, rasterized=True,
                     c=1 - tint[order, None] * (1 - np.array(to_rgb(OBSTACLE))))
    for h in hulls:
        outline(axes, h, view, OBSTACLE, 2)
    if "points" in agent:
        outline(axes, np.array(agent["points"]), view, AGENT, 2)
    everything = np.concatenate(shown)
    reach = np.median(np.linalg.norm(np.concatenate([solid, cloud] + hulls) - apex, axis=1))
    tips = [t for t in extreme_curve(reach)]
    depth = Depth(view, everything)
    for n, tip in enumerate(tips):
        if tip is None:
            continue
        following = tips[(n + 1) % len(tips)]
        if following is not None:
            line(axes, np.linspace(tip, following, 8), depth, EXACT, 1.1, 0.5)
        if n % max(len(tips) // 24, 1) == 0:
            line(axes, np.linspace(apex, tip, 60), depth, EXACT, 0.35, 0.2, zorder=5)
    points = [everything] + [t[None] for t in tips if t is not None]
    if data["course"]:
        course = data["course"]
        w, says = np.array(course["velocity"]), courses.color(course)
        far = course.get("contact_time") or max(1.15 * reach / np.linalg.norm(w), course.get("nearest_time", 0))
        path = np.linspace(apex, apex + far * w, 200)
        line(axes, path, depth, says, 1.2, 0.6, zorder=7)
        axes.annotate("", xy=view.project(path[-1]), xytext=view.project(path[-8]), zorder=8,
                      arrowprops={"arrowstyle": "-|>", "color": says, "lw": 1.2, "shrinkA": 0, "shrinkB": 0})
        points.append(path)
        travel = courses.travel(course)
        if travel is not None and travel.any() and "factor" in agent:
            u = np.linspace(0, 2 * np.pi, 100)
            f = np.stack([view.right, view.up]) @ np.array(agent["factor"])
            left, values, _ = np.linalg.svd(f)
            ring = (left * values) @ np.stack([np.cos(u), np.sin(u)])
            ring = view.project(apex + travel)[:, None] + ring
            axes.plot(*ring, "--", color=AGENT, linewidth=0.8, zorder=7)
            points.append(apex + travel + np.array(agent["factor"]).T)
        if "contact_point" in course:
            points.append(np.array(course["contact_point"])[None])
            axes.plot(*view.project(np.array(course["contact_point"])), "o", color=says, markersize=3, zorder=9)
        if "nearest_on_agent" in course:
            gap = np.array([course["nearest_on_agent"], course["nearest_on_obstacle"]])
            points.append(gap)
            axes.plot(*view.project(gap).T, color="k", linewidth=1.1, marker="o", markersize=2, zorder=9)
    frame(axes, view, np.vstack(points), margin=0.05, below=0.14)
    triad(axes, view, length=0.09)
    width = np.ptp(axes.get_xlim())
    nice = 10 ** np.floor(np.log10(width / 4))
    scale_bar(axes, nice * max(k for k in (1, 2, 5) if k * nice <= width / 4))


figure = plt.figure(figsize=(TWO_COLUMNS, 3.3))
left = figure.add_axes([0.0, 0.0, 0.52, 0.9])
space(left)
right = figure.add_axes([0.585, 0.13, 0.40, 0.68])
colour_bar(right, along_axis(right, data))
right.legend(loc="lower left", bbox_to_anchor=(0, 1.0), frameon=False, borderaxespad=0.2)
note = ", drawn thinned" if data["body"]["thinned"] else ""
figure.text(0.01, 0.94, data["title"] + note, fontsize=8)
if data["course"]:
    figure.text(0.01, 0.885, courses.sentence(data["course"]), fontsize=7, color=courses.color(data["course"]))
save(figure, "cone")
