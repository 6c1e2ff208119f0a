# SPDX-License-Identifier: BSD-3-Clause
"""Engagements of combined quadrics, from the figures of shapes.json with "inner": bodies, true cone, slice cone, the
cone of the convex hulls, a plane section with its tangents, a velocity."""
import numpy as np

from plot import course as courses
from plot.solids import HYPERBOLOID, ELLIPSOID, Solid, View, draw_lines, draw_solids, frame, scale_bar, triad
from vericone_figures.style import AGENT, EXACT, GREY, SLICE, TWO_COLUMNS, plt, read, save

VIEWS = {"section": (-70, 32), "notch": (133, 14)}


def basis(axis):
    """Across the line of centres: horizontal and as far upwards as can be."""
    up = np.array([0, 0, 1.0]) - axis[2] * axis
    up /= np.linalg.norm(up)
    return np.cross(up, axis), up


def at_distance_one(directions, axis):
    first, second = basis(axis)
    d = directions / (directions @ axis)[:, None]
    return np.stack([d @ first, d @ second], axis=1)


def hull(points):
    """Convex hull in the plane, counter-clockwise: the section of the cone of the bodies' convex hulls."""
    def half(sequence):
        chain = []
        for p in sequence:
            while len(chain) > 1 and np.cross(chain[-1] - chain[-2], p - chain[-2]) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    ordered = points[np.lexsort(points.T[::-1])]
    return np.array(half(ordered) + half(ordered[::-1]))


def closed(points):
    return np.vstack([points, points[:1]])


def cone_lines(axes, view, data, solids, reach, generators=24):
    """The true cone as far as the plane at `reach` metres along the line of centres: border and generators."""
    apex, axis = np.array(data["a"]["body"]["center"]), np.array(data["axis"])
    directions = np.array(data["inner"])
    tips = apex + reach * directions / (directions @ axis)[:, None]
    border = closed(tips)
    draw_lines(axes, view, [border], solids, color=EXACT, width=1.1, hidden_width=0.5, zorder=6)
    length = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(border, axis=0), axis=1))])
    s = np.linspace(0, length[-1], generators, endpoint=False)
    for tip in np.stack([np.interp(s, length, c) for c in border.T], axis=1):
        draw_lines(axes, view, [np.linspace(apex, tip, 60)], solids, color=EXACT, width=0.35, hidden_width=0,
                   zorder=6)
    return tips


def side_view(axis):
    """From the side of the line of centres, a little from above."""
    return np.degrees(np.arctan2(axis[1], axis[0])) - 75, 25


def scene(axes, name, data, hull_border=False):
    view = View(*VIEWS.get(name, side_view(data["axis"])))
    agent, obstacle = Solid(data["a"], colors=(AGENT, AGENT)), Solid(data["b"])
    solids = [agent, obstacle]
    draw_solids(axes, view, solids)
    apex, axis = np.array(data["a"]["body"]["center"]), np.array(data["axis"])
    reach = 1.0 * np.linalg.norm(obstacle.center - agent.center)
    shown = [s.points + s.center for s in solids]
    if "course" in data:
        course = data["course"]
        w, says, travel = np.array(course["velocity"]), courses.color(course), courses.travel(course)
        if travel is not None and travel.any():  # where it first touches, or is nearest
            ghost = Solid(data["a"], colors=(AGENT, AGENT), shift=travel)
            draw_solids(axes, view, [ghost, obstacle], fill=False, hidden_rims=False)
            shown.append(ghost.points + ghost.center)
        far = max(0.5 * reach, 0 if travel is None else np.linalg.norm(travel) * (1 if "contact_time" in course else 1.5))
        path = np.linspace(apex, apex + far * w / np.linalg.norm(w), 300)
        draw_lines(axes, view, [path[20:]], solids, color=says, width=1.2, hidden_width=0.7, zorder=7)
        axes.annotate("", xy=view.project(path[-1]), xytext=view.project(path[-6]), zorder=8,
                      arrowprops={"arrowstyle": "-|>", "color": says, "lw": 1.2, "shrinkA": 0, "shrinkB": 0})
        shown.append(path)
        if "contact_point" in course:
            axes.plot(*view.project(np.array(course["contact_point"])), "o", color=says, markersize=3, zorder=9)
        if "nearest_on_agent" in course:
            gap = view.project(np.array([course["nearest_on_agent"], course["nearest_on_obstacle"]]))
            axes.plot(*gap.T, color="k", linewidth=1.1, marker="o", markersize=2, zorder=9)
    tips = cone_lines(axes, view, data, solids, reach)
    shown.append(tips)
    if hull_border:
        first, second = basis(axis)
        border = hull(at_distance_one(np.array(data["outer"]), axis))
        line = apex + reach * (axis + border @ np.array([first, second]))
        draw_lines(axes, view, [closed(line)], solids, color=GREY, width=0.8, hidden_width=0.5, zorder=6)
    for label, s, offset in (("A", agent, (0, -10)), ("B", obstacle, (-14, -2))):
        flat = view.project(s.points + s.center)
        at = flat[flat[:, 1].argmin() if label == "A" else flat[:, 1].argmax()]
        axes.annotate(label, at, xytext=offset, textcoords="offset points", ha="center", fontsize=9)
    frame(axes, view, np.vstack(shown), margin=0.05, below=0.12)
    triad(axes, view, length=0.09)
    scale_bar(axes, 2)


def cross_section(axes, data, hulls=True):
    """Cones at distance 1 along the line of centres."""
    axis = np.array(data["axis"])
    inner, outer, slices = (at_distance_one(np.array(data[k]), axis) for k in ("inner", "outer", "slices"))
    if hulls:
        around = hull(outer)
        axes.fill(*around.T, color=GREY, alpha=0.12, linewidth=0)
        axes.plot(*closed(around).T, "--", color=GREY, linewidth=1, label="cone of the convex hulls")
    axes.fill(*inner.T, color=EXACT, alpha=0.2, linewidth=0)
    axes.plot(*closed(outer).T, color=EXACT, linewidth=0.6)
    axes.plot(*closed(inner).T, color=EXACT, linewidth=0.9,
              label="true cone, inner and outer\n%.4f ± %.4f sr" % (data["solid_angle"], data["solid_angle_error"]))
    axes.plot(*closed(slices).T, ".-", color=SLICE, markersize=2, linewidth=0.7,
              label="slices, n = %d: %.4f sr" % (data["planes"], data["slice_solid_angle"]))
    course = data.get("course")
    if course and np.array(course["velocity"]) @ axis > 0:
        mark = at_distance_one(np.array([course["velocity"]]), axis)
        axes.plot(*mark.T, "o", color=courses.color(course), markersize=4.5, label="velocity: %s" % courses.word(course))
    if "notch" in data:
        notch = data["notch"]
        others = at_distance_one(np.array([notch["above"], notch["below"]]), axis)
        axes.plot(*others.T, ":", color=courses.COLORS["in"], linewidth=0.8)
        both = notch["above_verdict"] == notch["below_verdict"] == "in"
        axes.plot(*others.T, "x", color=courses.COLORS["in"], markersize=4,
                  label="above, below: %s" % ("collide" if both else "?"))
    axes.plot([0], [0], "+", color="k")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("across the line of centres (1)")
    axes.set_ylabel("upwards (1)")


def plane_section(axes, data):
    """The sections by one plane through the line of centres with corners and common tangents."""
    for key, colors in (("section_a", (AGENT, AGENT)), ("section_b", (ELLIPSOID, HYPERBOLOID))):
        body = data[key]
        axes.fill(*np.vstack([a["points"] for a in body["arcs"]]).T, color=colors[0], alpha=0.15, linewidth=0)
        for arc in body["arcs"]:
            axes.plot(*np.array(arc["points"]).T, color=colors[arc["conic"] > 0], linewidth=1.5)
    center = np.array(data["section_b"]["center"])
    for name, corner in zip("LMNP", sorted(data["section_b"]["corners"], key=lambda p: np.arctan2(*(p - center)[::-1]))):
        away = (np.array(corner) - center) / np.linalg.norm(np.array(corner) - center)
        axes.plot(*corner, "k.", markersize=4.5, zorder=6)
        axes.annotate(name, corner, xytext=9 * away, textcoords="offset points", ha="center", va="center")
    for n, tangent in enumerate(data["tangents"]):
        a, b, d = (np.array(tangent[k]) for k in ("on_a", "on_b", "direction"))
        line = np.array([a - 1.2 * d, b + 1.5 * d])
        axes.plot(*line.T, color=EXACT, linewidth=0.9, zorder=4)
        axes.plot(*np.array([a, b]).T, "o", color=EXACT, markersize=3, zorder=5)
        axes.annotate("$t_%d$" % (n + 1), line[1], xytext=8 * d, textcoords="offset points", ha="center", va="center",
                      color=EXACT)
    lines = [np.array([t["on_a"], t["direction"]]) for t in data["tangents"]]
    s = np.linalg.solve(np.array([lines[0][1], -lines[1][1]]).T, lines[1][0] - lines[0][0])
    apex = lines[0][0] + s[0] * lines[0][1]
    angles = data["theta_b"] + np.linspace(-0.5, 0.5, 40) * data["psi"]
    axes.plot(apex[0] + 1.4 * np.cos(angles), apex[1] + 1.4 * np.sin(angles), color="k", linewidth=0.6)
    axes.text(*(apex + 1.75 * np.array([np.cos(data["theta_b"]), np.sin(data["theta_b"])])), "$\\psi$", ha="center",
              va="center")
    touch = ["$t_%d$ %s" % (n + 1, "through a corner of B" if t["corner_b"] else "touches the ellipse of B")
             for n, t in enumerate(data["tangents"])]
    axes.text(0.015, 0.95, "$\\psi$ = %.2f°\n%s" % (np.degrees(data["psi"]), "\n".join(touch)), transform=axes.transAxes,
              va="top", fontsize=7)
    axes.text(0, 0, "A", ha="center", va="center")
    axes.text(*(center + [0.6, 0]), "B", ha="center", va="center")
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("along the line of centres (m)")
    axes.set_ylabel("across, in the plane (m)")


for name in read("shapes.json")["figures"]:
    data = read(name + ".json")
    if "inner" not in data:
        continue
    if "tangents" in data:
        figure = plt.figure(figsize=(TWO_COLUMNS, 5.6))
        plane_section(figure.add_axes([0.08, 0.56, 0.9, 0.4]), data)
        scene(figure.add_axes([0.0, 0.0, 0.6, 0.48]), name, data)
        right = figure.add_axes([0.68, 0.08, 0.3, 0.27])
        cross_section(right, data, hulls=False)
        figure.text(0.01, 0.975, "(a)", fontsize=8)
        figure.text(0.01, 0.47, "(b)", fontsize=8)
        figure.text(0.6, 0.47, "(c)", fontsize=8)
        figure.legend(*right.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(0.62, 0.48), frameon=False)
    else:
        figure = plt.figure(figsize=(TWO_COLUMNS, 3.5))
        scene(figure.add_axes([0.0, 0.0, 0.58, 1.0]), name, data, hull_border=True)
        right = figure.add_axes([0.66, 0.12, 0.33, 0.55])
        cross_section(right, data)
        figure.legend(*right.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(0.6, 1.0), frameon=False)
        if "course" in data:
            figure.text(0.01, 0.98, courses.sentence(data["course"]), fontsize=8, va="top", color=courses.color(data["course"]))
    save(figure, name)
