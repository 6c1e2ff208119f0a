# SPDX-License-Identifier: BSD-3-Clause
"""One engagement in space, from engagement.json: both bodies, the slice cone inside the true cone, the scene's velocity
with where it leads, and a velocity between the two cones, which is shown in space where the scene has none."""
import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from vericone_figures import course as courses
from vericone_figures.style import AGENT, EXACT, GREY, OBSTACLE, SLICE, TWO_COLUMNS, plt, read, save

data = read("engagement.json")


def surface(body, shift=(0, 0, 0)):
    u, v = np.meshgrid(np.linspace(0, 2 * np.pi, 49), np.linspace(0, np.pi, 25))
    sphere = np.stack([np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)])
    points = np.tensordot(np.array(body["factor"]), sphere, axes=1)
    return points + (np.array(body["center"]) + np.array(shift))[:, None, None]


agent, obstacle = np.array(data["agent"]["center"]), np.array(data["obstacle"]["center"])
axis = obstacle - agent
distance = np.linalg.norm(axis)
axis = axis / distance
first = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
first /= np.linalg.norm(first)
second = np.cross(axis, first)
exact, slices = np.array(data["exact_directions"]), np.array(data["slice_directions"])
gap = np.array(data["gap_velocity"])
bounded = data["exact_area"] is not None
course = data.get("course") or {k[4:]: v for k, v in data.items() if k.startswith("gap_")}

figure = plt.figure(figsize=(TWO_COLUMNS, 3.7))
space = figure.add_axes([0.02, 0.04, 0.56, 0.86], projection="3d")


def cone(directions, color, alpha):
    tips = agent + directions / np.maximum(directions @ axis, 0.2)[:, None] * distance
    faces = [[agent, tips[i], tips[(i + 1) % len(tips)]] for i in range(len(tips))]
    space.add_collection3d(Poly3DCollection(faces, facecolor=color, edgecolor="none", alpha=alpha))
    space.plot(*np.vstack([tips, tips[:1]]).T, color=color, linewidth=1)
    return tips


tips = cone(exact, EXACT, 0.10)
cone(slices, SLICE, 0.22)
for body, color in ((data["agent"], AGENT), (data["obstacle"], OBSTACLE)):
    space.plot_surface(*surface(body), color=color, alpha=0.65, linewidth=0)
extent = [tips, surface(data["agent"]).reshape(3, -1).T, surface(data["obstacle"]).reshape(3, -1).T]
velocity = np.array(course["velocity"])
travel = courses.travel(course)
if travel is not None and travel.any():  # where it first touches, or is nearest
    moved = surface(data["agent"], travel)
    space.plot_wireframe(*moved, color=AGENT, linewidth=0.25, rstride=3, cstride=3)
    extent.append(moved.reshape(3, -1).T)
else:
    travel = 0.5 * distance * velocity / np.linalg.norm(velocity)
    extent.append((agent + travel)[None])
space.plot(*np.vstack([agent, agent + travel]).T, color="k", linewidth=1.3)
if "contact_point" in course:
    space.scatter(*course["contact_point"], color="red", s=14, depthshade=False)
if "nearest_on_agent" in course:
    space.plot(*np.array([course["nearest_on_agent"], course["nearest_on_obstacle"]]).T, color=courses.color(course),
               linewidth=1.6, marker="o", markersize=2.5)
extent = np.vstack(extent)
space.set_box_aspect(np.ptp(extent, axis=0), zoom=0.88)  # room for the labels
for name, i in (("x", 0), ("y", 1), ("z", 2)):
    getattr(space, "set_%slim" % name)(extent[:, i].min(), extent[:, i].max())
    scale = getattr(space, name + "axis")
    scale.set_rotate_label(False)  # otherwise the view may turn it upside down
    scale.set_label_text("%s (m)" % name, rotation=0)
    scale.labelpad = -3
space.tick_params(pad=-2, labelsize=6)
# Look across the plane that holds the line of centres and the velocity: the contact is then in profile.
normal = np.cross(axis, velocity)
if np.linalg.norm(normal) < 1e-6 * np.linalg.norm(velocity):
    normal = np.cross(axis, gap)
normal /= np.linalg.norm(normal)
if normal[2] < 0:
    normal = -normal
aside = 15 if np.abs(normal).max() > 0.95 else 0  # an axis seen from its end has no room for its numbers
space.view_init(elev=np.degrees(np.arcsin(normal[2])) + aside,
                azim=np.degrees(np.arctan2(normal[1], normal[0])) + aside)

plane = figure.add_axes([0.67, 0.13, 0.31, 0.62])


def section(directions):
    on_plane = directions / (directions @ axis)[:, None]
    closed = np.vstack([on_plane, on_plane[:1]])
    return closed @ first, closed @ second


if bounded:
    plane.fill(*section(exact), color=EXACT, alpha=0.15)
    plane.plot(*section(exact), color=EXACT, label="true cone (exact, m = %d)" % data["samples"])
    plane.fill(*section(slices), color=SLICE, alpha=0.25)
    plane.plot(*section(slices), ".-", color=SLICE, markersize=3, linewidth=0.8,
               label="slice cone (n = %d)" % data["planes"])
    mark = gap / (gap @ axis)
    plane.plot([mark @ first], [mark @ second], "o", color="red", markersize=4,
               label="velocity in the gap: really %s" % courses.WORDS[data["gap_verdict"]])
    if "course" in data and velocity @ axis > 0:
        mark = velocity / (velocity @ axis)
        plane.plot([mark @ first], [mark @ second], "D", color=courses.color(course), markersize=4,
                   label="the scene's velocity: %s" % courses.word(course))
    plane.plot([0], [0], "+", color=GREY)
    plane.set_aspect("equal", adjustable="datalim")
    missing = 100 * (1 - data["slice_area"] / data["exact_area"])
    plane.set_title("section at distance 1\nslices miss %.1f %% of the area" % missing, fontsize=7)
    plane.set_xlabel("across the line of centres (1)")
    plane.set_ylabel("across the line of centres (1)")
    figure.legend(*plane.get_legend_handles_labels(), loc="lower left", bbox_to_anchor=(0.63, 0.81), frameon=False)
else:
    plane.axis("off")
    plane.text(0.5, 0.5, "the cone reaches 90 degrees from its axis:\nno bounded section", ha="center")
# What the black line leads to: the contact is red, the gap where they are nearest in the colour of the verdict.
figure.text(0.01, 0.98, "Agent (green) and obstacle (violet)", fontsize=8, va="top")
whose = "the scene's velocity" if "course" in data else "a velocity in the gap"
figure.text(0.01, 0.94, "%s, %s" % (whose, courses.sentence(course)), fontsize=8, va="top", color=courses.color(course))
save(figure, "engagement")
