# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Cones of colliding velocities: in space at the agent, as the agent sees them, as maps of all directions; sectors of
planes; verdicts and clearances of many velocities."""
import weakref
from collections.abc import Callable
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap, TwoSlopeNorm
from matplotlib.patches import Arc, Patch, Rectangle, Wedge

from . import course as courses
from . import in_space, sphere
from .objects import (Numbers, course_of, direction_of, has, loops_of, map_data, number_of, refused, shape_and_row,
                      solid_angle_of, vector_of, word, wrong_kind)
from .of_bodies import axes_for, body, draw_in_space, fit_space, space
from .signs import ANSWERS
from .style import AGENT, EXACT, GREY, OBSTACLE, SLICE, style

COMPARED = (EXACT, AGENT, OBSTACLE, "#b8860b", "#00808f")  # of cones on the same axes
OTHERS = (OBSTACLE, EXACT, "#b8860b", "#00808f", SLICE)  # of obstacles

TOWARDS: "weakref.WeakKeyDictionary[Any, Any]" = weakref.WeakKeyDictionary()  # of axes that show directions: the one in their middle


def seen_from_agent(axes: Any, towards: Numbers, argument: str = "towards") -> Any:
    """Axes of directions: angles from the direction in their middle keep their size, degrees (azimuthal
    equidistant)."""
    axes_in_plane(axes)
    direction = direction_of(towards, argument)
    if axes is None:
        axes = plt.figure(figsize=(3.9, 3.5), constrained_layout=True).add_subplot()
    if axes not in TOWARDS:
        TOWARDS[axes] = direction
        axes.set_aspect("equal", adjustable="datalim")
        axes.set_axisbelow(True)
        axes.set_xlabel("to the right of the line of sight (deg)")
        axes.set_ylabel("above it (deg)")
        axes.plot(0, 0, "+", color=GREY, markersize=5)
    return axes


def axes_in_plane(axes: Any) -> None:
    """New ones are made where there are none."""
    if axes is not None:
        axes_for(axes, True)


def pair_of(thing: Any) -> Any:
    if not has(thing, "agent", "obstacle", "verdict", "miss"):
        raise wrong_kind("pair", thing, "a Pair")
    return thing


def above(axes: Any) -> None:
    """The legend, where it covers nothing."""
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), frameon=False, borderaxespad=0.2, labelspacing=0.2)


def new_color(axes: Any, first: Any) -> Any:
    """One that no line on the axes has yet, as long as there are some; the first choice where it is free."""
    taken = [line.get_color() for line in axes.get_lines()]
    return next((color for color in (first, *COMPARED) if color not in taken), first)


def new_name(axes: Any, name: str) -> str:
    """With a number where cones are on the axes already."""
    before = sum(text.split(":")[0].startswith(name) for text in axes.get_legend_handles_labels()[1])
    return "%s %d" % (name, before + 1) if before else name


def on_view(axes: Any, directions: Numbers) -> Any:
    """Where directions (..., 3) are on axes of directions, degrees."""
    return sphere.on_view(np.asarray(directions, float), TOWARDS[axes])


def cone(thing: Any, *, axes: Any = None, towards: Numbers | None = None, color: Any = None,
         label: str | None = None) -> Any:
    """Draws the directions of relative velocity that collide, as the agent sees them, in degrees from the line of
    sight, and returns the axes. `thing`: a Cone (filled: surely collides; line: surely safe beyond), TrueCone,
    SliceCone, PolyhedralCone or ConeMap; several on the same axes compare, each in a colour and with a
    name of its own. Solid angles in the legend are steradian. `towards`: the direction in the middle, the cone's axis if
    left out."""
    if has(thing, "cells", "corners"):
        return cone_map(thing, axes=axes, towards=towards)
    inner, outer, axis = loops_of(thing)
    if not outer:
        raise refused("thing", "a cone without a border", "one of bodies that are apart")
    if towards is None:
        towards = axis if axis is not None and np.any(axis) else np.mean(outer[0], axis=0)
    with style():
        axes = seen_from_agent(axes, towards)
        if color is None:
            color = new_color(axes, SLICE if has(thing, "slices") else EXACT)
        for loop in inner:
            axes.fill(*on_view(axes, loop).T, color=color, alpha=0.2, linewidth=0)
        low, high = solid_angle_of(thing)
        size = "%.4g sr" % low if high - low < 1e-4 * high else "%.4g to %.4g sr" % (low, high)
        for n, loop in enumerate(outer):
            axes.plot(*on_view(axes, np.vstack([loop, loop[:1]])).T, ".-" if has(thing, "slices") else "-", color=color,
                      markersize=3, linewidth=1,
                      label=None if n else "%s: %s" % (label or new_name(axes, "cone"), size))
        above(axes)
    return axes


def velocity(relative_velocity: Numbers, *, axes: Any = None, towards: Numbers | None = None, verdict: Any = None,
             label: str | None = None) -> Any:
    """Marks the direction of a relative velocity (m/s) on axes of directions, in the colour of its verdict; returns
    them. `towards`: the direction in the middle of new ones, the velocity itself if left out."""
    direction_of(relative_velocity, "relative_velocity")
    fresh = axes is None
    with style():
        axes = seen_from_agent(axes, relative_velocity if towards is None else towards)
        if fresh:  # a point alone has no scale
            reach = max(60.0, 1.1 * float(np.abs(on_view(axes, relative_velocity)).max()))
            axes.set_xlim(-reach, reach)
            axes.set_ylim(-reach, reach)
        color = courses.COLORS.get(word(verdict), GREY) if verdict is not None else "k"
        text = label or (courses.WORDS.get(word(verdict)) if verdict is not None else None)
        axes.plot(*on_view(axes, relative_velocity), "o", color=color, markersize=5, markeredgecolor="w",
                  markeredgewidth=0.7, label=text, zorder=5)
        if text:
            above(axes)
    return axes


def cone_map(thing: Any, *, axes: Any = None, towards: Numbers | None = None, reach: float = 60.0,
             pixels: int = 600) -> Any:
    """Draws a ConeMap and returns the axes: around the direction `towards` as the agent sees it, up to `reach` degrees
    from it; without one the whole sphere by azimuth and elevation, degrees. Solid angles in the legend are
    steradian."""
    data = map_data(thing)
    axes_in_plane(axes)
    direction = None if towards is None else direction_of(towards, "towards")
    labels = sphere.Map(data)
    with style():
        if axes is None:
            axes = plt.figure(figsize=(4.6, 2.9 if direction is None else 3.6), constrained_layout=True).add_subplot()
        if direction is not None:
            TOWARDS[axes] = direction
            sphere.view(axes, labels, data, direction, pixels, reach)
        else:
            sphere.whole(axes, labels, data, None, 2 * pixels)
        axes.grid(False)
        axes.legend(handles=sphere.handles(data), loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=3, frameon=False)
    return axes


def sector(thing: Any, *, axes: Any = None, radius: float = 1.0, center: Numbers = (0.0, 0.0),
           color: Any = EXACT, label: str | None = None) -> Any:
    """Draws the colliding directions of a plane and returns the axes. A PlaneSector: in its plane, the line of sight to
    the right, `across` up. A Sector of two planar bodies: at `center`, metres, in world axes, with its tangents.
    `radius` in the units of the axes."""
    axes_in_plane(axes)
    if not has(thing, "left", "right") or not (has(thing, "line_of_sight") or has(thing, "theta_b", "psi")):
        raise wrong_kind("thing", thing, "a PlaneSector, of Pair.sector(), or a Sector of planar bodies")
    center = vector_of(center, "center", (2,))
    low, high = ((-thing.right.angle, thing.left.angle) if has(thing, "line_of_sight") else
                 (thing.theta_b - 0.5 * thing.psi, thing.theta_b + 0.5 * thing.psi))
    with style():
        if axes is None:
            axes = plt.figure(figsize=(3.9, 3.2), constrained_layout=True).add_subplot()
            axes.set_xlabel("along the line of sight (1)" if has(thing, "line_of_sight") else "x (m)")
            axes.set_ylabel("across (1)" if has(thing, "line_of_sight") else "y (m)")
        degrees = np.degrees([low, high])
        axes.add_patch(Wedge(center, radius, *degrees, facecolor=color, alpha=0.15, linewidth=0))
        axes.add_patch(Arc(center, 2 * radius, 2 * radius, theta1=degrees[0], theta2=degrees[1], color=color,
                           linewidth=0.9))
        for n, angle in enumerate((low, high)):
            tip = np.asarray(center) + radius * np.array([np.cos(angle), np.sin(angle)])
            text = "%s, $\\psi$ = %.4g°" % (label or "colliding directions", np.degrees(high - low))
            axes.plot(*np.stack([center, tip]).T, color=color, linewidth=1, label=None if n else text)
        for edge in (thing.left, thing.right):
            if has(edge, "point_on_a"):
                points = np.stack([edge.point_on_a, edge.point_on_b])
                axes.plot(*points.T, ".-", color=GREY, linewidth=0.7, markersize=4)
        if has(thing, "line_of_sight"):
            axes.plot([0, radius], [0, 0], "--", color=GREY, linewidth=0.7, label="line of sight")
        axes.set_aspect("equal", adjustable="datalim")
        axes.legend(loc="upper left")
    return axes


def bands(thing: Any, *, axes: Any = None, heading: float | None = None) -> Any:
    """Draws the headings of Bands as a compass, north up: what is free, what is in conflict, and returns the axes, which
    are polar. `heading`: the present one, radians clockwise from north."""
    if not has(thing, "heading", "speed", "climb") or not has(thing.heading, "free", "conflict"):
        raise wrong_kind("thing", thing, "Bands, of guidance.bands()")
    with style():
        if axes is None:
            axes = plt.figure(figsize=(3.9, 3.5), constrained_layout=True).add_subplot(projection="polar")
        elif axes.name != "polar":
            raise refused("axes", axes.name, 'polar: add_subplot(projection="polar")')
        axes.set_theta_zero_location("N")
        axes.set_theta_direction(-1)
        axes.set_ylim(0, 1)
        axes.set_yticks([])
        for ranges, color, label in ((thing.heading.conflict, SLICE, "conflict"), (thing.heading.free, AGENT, "free")):
            for n, span in enumerate(ranges):
                middle, width = 0.5 * (span.from_ + span.to), span.to - span.from_
                axes.bar(middle, 0.35, width=width, bottom=0.65, color=color, alpha=0.8 if color == SLICE else 0.35,
                         linewidth=0.4, edgecolor=color, label=None if n else label)
        if heading is not None:
            axes.annotate("", (heading, 0.62), (0, 0), arrowprops={"arrowstyle": "-|>", "color": GREY})
        axes.legend(loc="center", bbox_to_anchor=(0.5, 0.32), frameon=False)
    return axes


def velocity_map(thing: Any, *, axes: Any = None) -> Any:
    """Draws a section of a VelocityMap, one whose box has no width along one axis, and returns the axes, m/s: what is
    safe, undecided, and what meets which obstacle, the darker the sooner (all that may be another is hatched)."""
    if not has(thing, "cells", "colliding", "safe_regions"):
        raise wrong_kind("thing", thing, "a VelocityMap, of guidance.velocity_map()")
    axes_in_plane(axes)
    low, high = np.array([cell.low for cell in thing.cells]), np.array([cell.high for cell in thing.cells])
    flat = [axis for axis in range(3) if np.all(low[:, axis] == high[:, axis])]
    if len(flat) != 1:
        raise refused("thing", "a map of %s" % ("a box" if not flat else "a line"), "a section: low and high equal along one axis")
    across, up = (axis for axis in range(3) if axis != flat[0])
    with style():
        if axes is None:
            axes = plt.figure(figsize=(4.6, 3.9), constrained_layout=True).add_subplot()
        met = [cell for cell in thing.cells if cell.label.name.startswith("in")]
        soonest, latest = (f([cell.earliest for cell in met], default=0.0) for f in (min, max))
        seen: dict[str, Any] = {}
        for cell, a, b in zip(thing.cells, low, high, strict=True):
            name = cell.label.name
            colliding = name.startswith("in")
            label = "meets %d" % cell.obstacle if colliding else "safe" if name == "out" else name
            color = OTHERS[cell.obstacle % len(OTHERS)] if colliding else AGENT if name == "out" else GREY
            sooner = (latest - cell.earliest) / max(latest - soonest, 1e-300)
            alpha = 0.25 + 0.65 * sooner if colliding else 0.18 if name == "out" else 0.6
            hatch = "///" if colliding and not cell.first else None
            axes.add_patch(Rectangle((a[across], a[up]), b[across] - a[across], b[up] - a[up], facecolor=color, alpha=alpha,
                                     linewidth=0, hatch=hatch))
            seen[label] = Patch(facecolor=color, alpha=0.18 if label == "safe" else 0.6)
        axes.set_xlim(low[:, across].min(), high[:, across].max())
        axes.set_ylim(low[:, up].min(), high[:, up].max())
        axes.set_aspect("equal")
        axes.set_xlabel("$v_%s$ (m/s)" % "xyz"[across])
        axes.set_ylabel("$v_%s$ (m/s)" % "xyz"[up])
        axes.grid(False)
        names = sorted(seen)
        axes.legend([seen[name] for name in names], names, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=4,
                    frameon=False)
    return axes


def look_at(axes: Any, axis: Any, velocity: Any) -> None:
    """From the side of the line of centres, the agent on the left; from above, where the velocity turns off it sideways."""
    if abs(axis[2]) > 0.9:  # it rises: across the plane that holds both
        in_space.look_across(axes, axis, velocity if np.any(np.cross(axis, velocity)) else np.ones(3), np.ones(3))
        return
    normal = np.cross(axis, velocity)
    upwards = abs(normal[2]) / max(float(np.linalg.norm(normal)), 1e-300)
    axes.view_init(elev=20 + 30 * upwards, azim=np.degrees(np.arctan2(axis[1], axis[0])) - 70)


def engagement(pair: Any, agent_velocity: Numbers | None = None, obstacle_velocity: Numbers = (0.0, 0.0, 0.0), *,
               cone: Any = True, axes: Any = None) -> Any:
    """Draws a Pair in space, metres, and returns the axes: the agent (green), the obstacle (violet), the cone of
    relative velocities that collide as far as the obstacle, and where the velocities (m/s) lead, seen from the
    obstacle. `cone`: one that is there already, or whether to ask the pair for it (of meshes seconds: pair.cone())."""
    agent, obstacle = pair_of(pair).agent(), pair.obstacle()
    if agent_velocity is not None:
        agent_velocity = vector_of(agent_velocity, "agent_velocity")
    obstacle_velocity = vector_of(obstacle_velocity, "obstacle_velocity")
    start, end = np.asarray(agent.middle()), np.asarray(obstacle.middle())
    distance = float(np.linalg.norm(end - start))
    shown = pair.cone() if cone is True else cone or None
    with style():
        axes = space((4.6, 4.0)) if axes is None else axes_for(axes, False)
        body(agent, axes=axes, color=AGENT)
        body(obstacle, axes=axes, color=OBSTACLE)
        if shown is not None:
            _, outer, axis = loops_of(shown)
            axis = (end - start) / distance if axis is None or not np.any(axis) else axis
            for loop in outer:
                fit_space(axes, in_space.cone(axes, start, axis, loop, distance, EXACT, 0.12))
        if agent_velocity is not None:
            course = course_of(pair, agent_velocity, obstacle_velocity)
            says = courses.color(course)
            if np.any(course["velocity"]):
                way = courses.travel(course)
                way = way if way is not None and np.any(way) else 0.5 * distance * sphere.unit(course["velocity"])
                axes.plot(*np.stack([start, start + way]).T, color=says, linewidth=1.5, zorder=6)
                axes.quiver(*(start + 0.8 * way), *(0.2 * way), color=says, linewidth=1.5, arrow_length_ratio=0.5,
                            zorder=6)
                shape, row = shape_and_row(agent)  # where it first touches, or is nearest
                then = dict(zip("xyz", np.array([row[c] for c in "xyz"]) + way))
                fit_space(axes, draw_in_space(axes, shape, {**row, **then}, AGENT, 0.15))
            if "contact_point" in course:
                axes.plot(*course["contact_point"][:, None], "o", color=says, markersize=4, zorder=9)
            axes.text2D(0.02, 0.98, courses.sentence(course), transform=axes.transAxes, color=says, fontsize=8,
                        va="top")
            look_at(axes, (end - start) / distance, np.asarray(course["velocity"]))
    return axes


def plane_engagement(agent: Any, obstacle: Any, sector_of_pair: Any = None, *, axes: Any = None) -> Any:
    """Draws two planar bodies, metres, with their Sector of colliding directions at the agent; returns the axes."""
    for argument, thing in (("agent", agent), ("obstacle", obstacle)):
        if shape_and_row(thing, argument)[0]["kind"] != "ellipse":
            raise wrong_kind(argument, thing, "a planar body: an Ellipse or a CombinedEllipse")
    axes = body(agent, axes=axes, color=AGENT, label="agent")
    body(obstacle, axes=axes, color=OBSTACLE, label="obstacle")
    if sector_of_pair is not None:
        center = np.asarray(shape_and_row(agent)[0]["center"])
        apart = float(np.linalg.norm(np.asarray(shape_and_row(obstacle)[0]["center"]) - center))
        sector(sector_of_pair, axes=axes, center=center, radius=0.6 * apart)
    return axes


def directions_around(towards: Numbers, reach: float = 60.0, n: int = 121) -> Any:
    """Unit directions (n, n, 3) for a picture as the agent sees it: up to `reach` degrees right, left, up and down of
    the one in the middle."""
    x, y = np.meshgrid(np.linspace(-reach, reach, n), np.linspace(-reach, reach, n))
    return sphere.on_sky(x, y, direction_of(towards, "towards"))


def clearance_field(pair: Any, speed: float, obstacle_velocity: Numbers = (0.0, 0.0, 0.0), *, reach: float = 60.0,
                    n: int = 121, progress: Callable[[float], object] | None = None, axes: Any = None) -> Any:
    """Draws by how much a pair misses for every heading of the agent at `speed` (m/s): metres, negative where they meet
    (then how far the agent would have to be shifted); the line is where they graze. Headings in degrees from the line
    of sight. `progress` is called with the share of the rows that are answered, from the lowest up; where it returns
    False, the others stay empty. Returns the axes. Cost: n² questions, of scans some 0.1 ms each."""
    towards = np.asarray(pair_of(pair).obstacle().middle()) - np.asarray(pair.agent().middle())
    axes_in_plane(axes)
    headings = directions_around(towards, number_of(reach, "reach", 0), int(number_of(n, "n", 2)))
    velocities, still = number_of(speed, "speed", 0) * headings, vector_of(obstacle_velocity, "obstacle_velocity")
    if progress is not None and not callable(progress):
        raise wrong_kind("progress", progress, "a function, or None")
    miss = np.full(headings.shape[:2], np.nan)
    for row, asked in enumerate(velocities):
        miss[row] = np.asarray(pair.miss(asked, still).distance)
        if progress is not None and progress((row + 1) / len(miss)) is False:
            break
    with style():
        axes = seen_from_agent(axes, towards)
        low, high = float(np.nanmin(miss)), float(np.nanmax(miss))
        norm = TwoSlopeNorm(0.0, min(low, -1e-12), max(high, 1e-12))
        half = reach * (1 + 1 / (n - 1))
        image = axes.imshow(miss, origin="lower", extent=(-half, half, -half, half), cmap="RdBu", norm=norm,
                            interpolation="nearest")
        if low < 0 < high:
            line = np.linspace(-reach, reach, n)
            axes.contour(line, line, miss, levels=[0.0], colors="k", linewidths=0.9)
        axes.set_aspect("equal", adjustable="box")
        axes.grid(False)
        bar = axes.figure.colorbar(image, ax=axes, shrink=0.85)
        bar.set_label("miss distance (m), below 0: meets")
        axes.set_xlabel("heading, to the right of the line of sight (deg)")
        axes.set_ylabel("heading, above it (deg)")
    return axes


def sign_map(verdicts: Any, *, axes: Any = None, title: str | None = None, unit: str = "ulps") -> Any:
    """Draws verdicts (n, n) of velocities beside each other, the middle one in the middle, as colours of in, on and
    out; returns the axes. `unit`: what a step is called."""
    grid = np.asarray(verdicts)
    axes_in_plane(axes)
    if grid.ndim != 2 or grid.dtype.kind not in "iuf" or not grid.size:
        raise refused("verdicts", "an array of shape %s, %s" % (grid.shape, grid.dtype), "verdicts of shape (n, n)")
    half = [size // 2 + 0.5 for size in grid.shape]
    with style():
        if axes is None:
            axes = plt.figure(figsize=(3.0, 3.2), constrained_layout=True).add_subplot()
        axes.imshow(grid, origin="lower", cmap=ListedColormap(list(ANSWERS.values())), vmin=0, vmax=2,
                    extent=(-half[1], half[1], -half[0], half[0]), interpolation="nearest")
        axes.set_xlabel("%s of $w_x$" % unit)
        axes.set_ylabel("%s of $w_y$" % unit)
        axes.grid(False)
        if title:
            axes.set_title(title)
        axes.legend(handles=[Patch(facecolor=color, edgecolor=GREY, linewidth=0.4, label=answer)
                             for answer, color in ANSWERS.items()],
                    loc="upper center", bbox_to_anchor=(0.5, -0.18), ncol=3, frameon=False, handlelength=1.2)
    return axes
