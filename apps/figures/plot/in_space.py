# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Engagements in space: bodies, the cone of colliding velocities at the agent, and where a relative velocity leads."""
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from . import course as courses
from .kinds import Array, Axes, Data
from .style import AGENT, EXACT, GREY, OBSTACLE, SLICE, TWO_COLUMNS


def basis(axis: Array) -> tuple[Array, Array]:
    """Two unit vectors across a direction."""
    first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    first /= np.linalg.norm(first)
    return first, np.cross(axis, first)


def ellipsoid(body: Data, shift: Array = (0, 0, 0)) -> Array:
    """A grid on the surface {"center", "factor"}, coordinates first."""
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 49), np.linspace(0, np.pi, 25))
    sphere = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)])
    points = np.tensordot(np.array(body["factor"]), sphere, axes=1)
    return points + (np.array(body["center"]) + np.array(shift))[:, None, None]


def cone(axes: Axes, apex: Array, axis: Array, directions: Array, reach: float, color: Any, alpha: float) -> Array:
    """The cone of a polygon of directions, as far as the plane at `reach` metres along its axis. Returns its rim."""
    tips = apex + directions / np.maximum(directions @ axis, 0.2)[:, None] * reach
    faces = [[apex, tips[i], tips[(i + 1) % len(tips)]] for i in range(len(tips))]
    axes.add_collection3d(Poly3DCollection(faces, facecolor=color, edgecolor="none", alpha=alpha))
    axes.plot(*np.vstack([tips, tips[:1]]).T, color=color, linewidth=1)
    return tips


def travel(axes: Axes, course: Data, agent: Array, reach: float, moved: Any = None) -> Any:
    """The way along a relative velocity, to the first contact or to where it is nearest, else `reach` metres. `moved`:
    the agent's surface after a shift. Returns points that must be seen."""
    velocity = np.array(course["velocity"])
    way, seen = courses.travel(course), []
    if way is not None and way.any():  # where it first touches, or is nearest
        if moved is not None:
            grid = moved(way)
            axes.plot_wireframe(*grid, color=AGENT, linewidth=0.25, rstride=3, cstride=3)
            seen.append(grid.reshape(3, -1).T)
    else:
        way = reach * velocity / np.linalg.norm(velocity)
        seen.append((agent + way)[None])
    axes.plot(*np.vstack([agent, agent + way]).T, color="k", linewidth=1.3)
    if "contact_point" in course:
        axes.scatter(*course["contact_point"], color="red", s=14, depthshade=False)
    if "nearest_on_agent" in course:
        axes.plot(*np.array([course["nearest_on_agent"], course["nearest_on_obstacle"]]).T, color=courses.color(course),
                  linewidth=1.6, marker="o", markersize=2.5)
    return seen


def frame(axes: Axes, extent: Array, zoom: float = 0.88) -> None:
    """Equal scales around points (n, 3), metres; room for the labels."""
    sides = np.ptp(extent, axis=0)
    axes.set_box_aspect(sides.copy(), zoom=zoom)  # it scales what it is given
    for name, i in (("x", 0), ("y", 1), ("z", 2)):
        getattr(axes, "set_%slim" % name)(extent[:, i].min(), extent[:, i].max())
        scale = getattr(axes, name + "axis")
        scale.set_rotate_label(False)  # otherwise the view may turn it upside down
        scale.set_label_text("%s (m)" % name, rotation=0)
        scale.labelpad = -3
        axes.locator_params(axis=name, nbins=5 if sides[i] > 0.5 * sides.max() else 3)
    axes.tick_params(pad=-2, labelsize=6)


def clear_labels(axes: Axes) -> None:
    """Moves the labels of the axes, as they are seen now, away from their numbers."""
    figure = axes.figure
    for _ in range(8):
        figure.canvas.draw()
        # As they were drawn: get_majorticklabels() puts them where they would be in a plane.
        crowded = [axis for axis in (axes.xaxis, axes.yaxis, axes.zaxis)
                   if any(axis.label.get_window_extent().overlaps(tick.label1.get_window_extent())
                          for tick in axis.get_major_ticks())]
        for axis in crowded:
            axis.labelpad += 1.5
        if not crowded:
            return


def look_across(axes: Axes, axis: Array, velocity: Array, other: Any) -> None:
    """Across the plane that holds the line of centres and the velocity: the contact is then in profile. `other` is used
    where the velocity is along the line."""
    normal = np.cross(axis, velocity)
    if np.linalg.norm(normal) < 1e-6 * np.linalg.norm(velocity):
        normal = np.cross(axis, other)
    normal /= np.linalg.norm(normal)
    if normal[2] < 0:
        normal = -normal
    aside = 15 if np.abs(normal).max() > 0.95 else 0  # an axis seen from its end has no room for its numbers
    axes.view_init(elev=np.degrees(np.arcsin(normal[2])) + aside,
                   azim=np.degrees(np.arctan2(normal[1], normal[0])) + aside)


def at_distance_one(directions: Array, axis: Array) -> Array:
    """Where directions meet the plane at distance 1 along the axis, as a closed line: two arrays."""
    first, second = basis(axis)
    on_plane = directions / (directions @ axis)[:, None]
    closed = np.vstack([on_plane, on_plane[:1]])
    return closed @ first, closed @ second


def section(axes: Axes, data: Data, axis: Array, course: Data) -> None:
    """Slice cone and true cone at distance 1 along the line of centres, and velocities."""
    first, second = basis(axis)
    exact, slices = np.array(data["exact_directions"]), np.array(data["slice_directions"])
    gap, velocity = np.array(data["gap_velocity"]), np.array(course["velocity"])
    axes.fill(*at_distance_one(exact, axis), color=EXACT, alpha=0.15)
    axes.plot(*at_distance_one(exact, axis), color=EXACT, label="true cone (exact, m = %d)" % data["samples"])
    axes.fill(*at_distance_one(slices, axis), color=SLICE, alpha=0.25)
    axes.plot(*at_distance_one(slices, axis), ".-", color=SLICE, markersize=3, linewidth=0.8,
              label="slice cone (n = %d)" % data["planes"])
    mark = gap / (gap @ axis)
    axes.plot([mark @ first], [mark @ second], "o", color="red", markersize=4,
              label="velocity in the gap: really %s" % courses.WORDS[data["gap_verdict"]])
    if "course" in data and velocity @ axis > 0:
        mark = velocity / (velocity @ axis)
        axes.plot([mark @ first], [mark @ second], "D", color=courses.color(course), markersize=4,
                  label="the scene's velocity: %s" % courses.word(course))
    axes.plot([0], [0], "+", color=GREY)
    axes.set_aspect("equal", adjustable="datalim")
    missing = 100 * (1 - data["slice_area"] / data["exact_area"])
    axes.set_title("section at distance 1\nslices miss %.1f %% of the area" % missing, fontsize=7)
    axes.set_xlabel("across the line of centres (1)")
    axes.set_ylabel("across the line of centres (1)")


def engagement(data: dict[str, Any]) -> plt.Figure:
    """Two ellipsoids, from engagement.json: slice cone inside the true cone, in space and at distance 1, the scene's
    velocity, and one between the two cones, which is shown in space where the scene has none."""
    agent, obstacle = np.array(data["agent"]["center"]), np.array(data["obstacle"]["center"])
    axis = obstacle - agent
    distance = float(np.linalg.norm(axis))
    axis = axis / distance
    exact, slices = np.array(data["exact_directions"]), np.array(data["slice_directions"])
    course = data.get("course") or {k[4:]: v for k, v in data.items() if k.startswith("gap_")}

    figure = plt.figure(figsize=(TWO_COLUMNS, 3.7))
    space = figure.add_axes([0.02, 0.04, 0.56, 0.86], projection="3d")
    tips = cone(space, agent, axis, exact, distance, EXACT, 0.10)
    cone(space, agent, axis, slices, distance, SLICE, 0.22)
    for body, color in ((data["agent"], AGENT), (data["obstacle"], OBSTACLE)):
        space.plot_surface(*ellipsoid(body), color=color, alpha=0.65, linewidth=0)
    extent = [tips, ellipsoid(data["agent"]).reshape(3, -1).T, ellipsoid(data["obstacle"]).reshape(3, -1).T]
    extent += travel(space, course, agent, 0.5 * distance, lambda way: ellipsoid(data["agent"], way))
    frame(space, np.vstack(extent))
    look_across(space, axis, np.array(course["velocity"]), np.array(data["gap_velocity"]))
    clear_labels(space)

    plane = figure.add_axes([0.67, 0.13, 0.31, 0.62])
    if data["exact_area"] is not None:
        section(plane, data, axis, course)
        figure.legend(*plane.get_legend_handles_labels(), loc="lower left", bbox_to_anchor=(0.63, 0.81), frameon=False)
    else:
        plane.axis("off")
        plane.text(0.5, 0.5, "the cone reaches 90 degrees from its axis:\nno bounded section", ha="center")
    # What the black line leads to: the contact is red, the gap where they are nearest in the colour of the verdict.
    figure.text(0.01, 0.98, "Agent (green) and obstacle (violet)", fontsize=8, va="top")
    whose = "the scene's velocity" if "course" in data else "a velocity in the gap"
    figure.text(0.01, 0.94, "%s, %s" % (whose, courses.sentence(course)), fontsize=8, va="top", color=courses.color(course))
    return figure
