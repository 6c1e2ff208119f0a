# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Engagements in the plane: both bodies, the inner common tangents, the sector of colliding velocities drawn at the
agent, and where the scene's relative velocity leads, seen from the obstacle."""
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.patches import Arc, Patch, Wedge
from numpy.typing import NDArray

from . import course as courses
from .style import AGENT, EXACT, GREY, OBSTACLE, ONE_COLUMN


def pale(color: Any, share: float) -> Any:
    """The color on white paper, not transparent."""
    return tuple(1 - share * (1 - x) for x in to_rgb(color))


def view(seen: list[NDArray[Any]]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Corners of what the picture shows: at most one and a half times as high as wide, and no flatter than a third."""
    everything = np.vstack(seen)
    low, high = everything.min(axis=0), everything.max(axis=0)
    pad = 0.05 * (high - low).max()
    low, high = low - pad, high + pad
    size = high - low
    grow = np.maximum(np.array([size[1] / 1.5, size[0] / 3]) - size, 0) / 2
    return low - grow, high + grow


def draw_gap(axes: plt.Axes, course: dict[str, Any], width: float, around: list[NDArray[Any]]) -> None:
    """Where the bodies are nearest, with the distance; `around`: what it should not cover."""
    gap = np.array([course["nearest_on_agent"], course["nearest_on_obstacle"]])
    axes.plot(*gap.T, color="k", linewidth=1.2, marker="o", markersize=2.2, zorder=7)
    # Beside the middle of the gap, on the side with more room.
    across = np.array([-1, 1]) * (gap[1] - gap[0])[::-1]
    across = across / max(float(np.linalg.norm(across)), 1e-300) if course["miss_distance"] > 0 else np.array([0.0, 1.0])
    middle = gap.mean(axis=0)
    taken = np.vstack(around)
    room = [np.linalg.norm(middle + side * 0.13 * width * across - taken, axis=1).min() for side in (1, -1)]
    across = across if room[0] > room[1] else -across
    axes.annotate(courses.metres(course["miss_distance"]), middle, xytext=9 * across, textcoords="offset points", zorder=8,
                  ha="left" if across[0] > 0.5 else "right" if across[0] < -0.5 else "center",
                  va="bottom" if across[1] > 0.5 else "top" if across[1] < -0.5 else "center",
                  bbox={"facecolor": "w", "edgecolor": "none", "alpha": 0.75, "pad": 0.8})


def engagement(data: dict[str, Any]) -> plt.Figure:
    """A planar scene, from engagement.json."""
    course = data["course"]
    outlines = {name: np.vstack([arc["points"] for arc in data[name]["arcs"]]) for name in ("agent", "obstacle")}
    agent, obstacle = (np.array(data[name]["center"]) for name in ("agent", "obstacle"))
    apart, w = data["relation"] == "disjoint", np.array(course["velocity"])
    edges = [data[side] for side in ("left", "right") if data[side]]
    says = courses.color(course)
    sizes = {name: np.linalg.norm(points - data[name]["center"], axis=1).max() for name, points in outlines.items()}
    distance = np.linalg.norm(obstacle - agent)
    travel = courses.travel(course)
    if travel is None:
        travel = np.zeros(2)

    # What has to be seen: its bounds give the picture its height.
    seen = [*outlines.values(), outlines["agent"] + travel]
    radius = max(0.45 * distance, 1.25 * sizes["agent"])  # of the sector
    turn = np.linspace(-0.5, 0.5, 61) * data["psi"] + data["theta_b"]
    sector = agent + radius * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    if data["relation"] != "overlapping":
        seen.append(sector)
    arrow = None
    if w.any():
        length = max(1.15 * np.linalg.norm(travel), 1.3 * radius)
        arrow = agent + length * w / courses.speed(course)
        seen.append(arrow[None])
    low, high = view(seen)
    size = high - low

    figure = plt.figure(figsize=(ONE_COLUMN, 1))
    axes = figure.add_axes([0, 0, 1, 1])
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal")
    axes.set_axisbelow(True)

    if data["relation"] != "overlapping":
        axes.add_patch(Wedge(agent, radius, *np.degrees(turn[[0, -1]]), facecolor=EXACT, alpha=0.14, linewidth=0, zorder=1.5))
        for end in sector[[0, -1]]:
            axes.plot(*np.stack([agent, end]).T, color=EXACT, linewidth=0.7, zorder=2)
        middle = agent + radius * np.array([np.cos(data["theta_b"]), np.sin(data["theta_b"])])
        axes.plot(*np.stack([agent, middle]).T, color=EXACT, linewidth=0.8, linestyle=(0, (6, 2, 1, 2)), zorder=2)
        axes.add_patch(Arc(agent, 2 * radius, 2 * radius, theta1=np.degrees(turn[0]), theta2=np.degrees(turn[-1]), color=EXACT,
                           linewidth=0.9, zorder=2))
    for edge in edges:
        a, b = np.array(edge["point_on_agent"]), np.array(edge["point_on_obstacle"])
        beyond = 0.12 * np.linalg.norm(b - a) * np.array(edge["direction"])
        axes.plot(*np.stack([a - beyond, b + beyond]).T, color=GREY, linewidth=0.7, zorder=3)
        axes.plot(*np.stack([a, b]).T, "o", color=GREY, markersize=2.6, zorder=5)
    for name, color in (("agent", AGENT), ("obstacle", OBSTACLE)):
        if data[name].get("parts"):  # convex ones: their edges first, so that those within the union are covered
            parts = [np.array(arc["points"]) for arc in data[name]["arcs"]]
            for part in parts:
                axes.fill(*part.T, facecolor="none", edgecolor=color, linewidth=2.2, zorder=3, joinstyle="round")
            for part in parts:
                axes.fill(*part.T, facecolor=pale(color, 0.4), linewidth=0, zorder=4)
            continue
        axes.fill(*outlines[name].T, facecolor=color, alpha=0.4, linewidth=0, zorder=3)
        axes.fill(*outlines[name].T, facecolor="none", edgecolor=color, linewidth=1.1, zorder=4)
    for arc in data["agent"]["arcs"] if data["agent"].get("parts") else [{"points": outlines["agent"]}]:
        if travel.any():
            axes.fill(*(np.array(arc["points"]) + travel).T, facecolor="none", edgecolor=AGENT, linewidth=0.9,
                      linestyle=(0, (3, 1.5)), zorder=4)
    if arrow is not None:
        axes.annotate("", xy=arrow, xytext=agent, zorder=6,
                      arrowprops={"arrowstyle": "-|>", "color": says, "lw": 1.2, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 8})
    if "contact_point" in course:
        axes.plot(*course["contact_point"], "o", color=says, markersize=4.2, markeredgecolor="w", markeredgewidth=0.5, zorder=7)
    if "nearest_on_agent" in course:
        draw_gap(axes, course, size[0], [*outlines.values(), outlines["agent"] + travel,
                                         *(agent + s * (sector - agent) for s in (0.4, 0.7, 1))])
    axes.ticklabel_format(scilimits=(-3, 4))
    axes.locator_params(nbins=7)
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")

    # The legend stands below the plot, and what the scene comes to above it.
    handles = [Patch(facecolor=AGENT, alpha=0.5, label="agent"), Patch(facecolor=OBSTACLE, alpha=0.5, label="obstacle")]
    if edges:
        handles.append(plt.Line2D([], [], color=GREY, linewidth=0.7, marker="o", markersize=2.6, label="inner common tangents"))
    if data["relation"] != "overlapping":
        handles.append(Patch(facecolor=EXACT, alpha=0.25, label="colliding directions, $\\psi$ = %.4g°" % np.degrees(data["psi"])))
        handles.append(plt.Line2D([], [], color=EXACT, linewidth=0.8, linestyle=(0, (6, 2, 1, 2)),
                                  label="bisector, $\\theta_b$ = %.4g°" % np.degrees(data["theta_b"])))
    if w.any():
        handles.append(plt.Line2D([], [], color=says, linewidth=1.2, label="relative velocity $w$, %.4g m/s" % courses.speed(course)))
    if travel.any():
        where = "at the first contact" if "contact_point" in course else "where it is nearest"
        handles.append(plt.Line2D([], [], color=AGENT, linewidth=0.9, linestyle=(0, (3, 1.5)), label="agent %s" % where))
    left, right, row = 0.52, 0.06, 0.135  # inches
    below, above = 0.42 + row * len(handles), 0.36
    width = ONE_COLUMN - left - right
    height = width * size[1] / size[0]
    total = below + height + above
    figure.set_size_inches(ONE_COLUMN, total)
    axes.set_position([left / ONE_COLUMN, below / total, width / ONE_COLUMN, height / total])
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.04, 0.0), frameon=False, labelspacing=0.25, handlelength=1.8,
                  borderaxespad=0.2)
    title = {"overlapping": "the bodies overlap: every velocity collides",
             "touching": "the bodies touch: half of all velocities collide"}.get(data["relation"], courses.sentence(course))
    figure.text(0.04, 1 - 0.05 / total, title, color=says, fontsize=8.5, va="top", weight="bold")
    figure.text(0.04, 1 - 0.19 / total, "seen from the obstacle, which stands still", color=GREY, fontsize=6.5, va="top")
    return figure
