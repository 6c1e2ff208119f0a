# SPDX-License-Identifier: BSD-3-Clause
"""The cone around an agent within a map, from pieces.json: the map from above, and all directions by azimuth and
elevation, coloured by the distance to the first contact."""
import numpy as np
from matplotlib.colors import ListedColormap

from plot import course as courses
from plot.directions import NEAR_TO_FAR, colour_bar, mark, masked, norm_of
from vericone_figures.style import AGENT, OBSTACLE, TWO_COLUMNS, plt, read, save

data = read("pieces.json")
center = np.array(data["agent"]["center"])


def above(axes):
    top = data["top"]
    cells = np.array([[".+#".index(c) for c in row] for row in top["rows"]])
    (x, y), cell = top["low"], top["cell"]
    axes.imshow(cells, origin="lower", extent=(x, x + cell * cells.shape[1], y, y + cell * cells.shape[0]),
                cmap=ListedColormap(["white", "#e3dcec", OBSTACLE]), vmin=0, vmax=2, interpolation="nearest", zorder=1)
    if "factor" in data["agent"]:
        f = np.array(data["agent"]["factor"])[:2]
        u, values, _ = np.linalg.svd(f)
        t = np.linspace(0, 2 * np.pi, 80)
        axes.fill(*(center[:2, None] + (u * values) @ np.stack([np.cos(t), np.sin(t)])), color=AGENT, zorder=4)
    axes.plot(*center[:2], "+", color=AGENT, markersize=9, markeredgewidth=1.2, zorder=5, label="agent")
    if data["course"]:
        course = data["course"]
        w = np.array(course["velocity"])
        far = course.get("contact_time") or max(course.get("nearest_time", 0), 3 / max(np.hypot(*w[:2]), 1e-9))
        axes.annotate("", xy=center[:2] + far * w[:2], xytext=center[:2], zorder=6,
                      arrowprops={"arrowstyle": "-|>", "color": courses.color(course), "lw": 1.0, "shrinkA": 0, "shrinkB": 0})
        if "contact_point" in course:
            axes.plot(*course["contact_point"][:2], "o", color=courses.color(course), markersize=4, zorder=7)
        if "nearest_on_agent" in course:
            axes.plot(*np.array([course["nearest_on_agent"], course["nearest_on_obstacle"]])[:, :2].T, color="k",
                      linewidth=1.2, marker="o", markersize=2, zorder=7)
    axes.plot([], [], "s", color=OBSTACLE, label="occupied at the agent's height, %.2f to %.2f m" % tuple(data["heights"]))
    axes.plot([], [], "s", color="#e3dcec", label="only above or below")
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    axes.set_aspect("equal")
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1.0), ncol=3, frameon=False, borderaxespad=0.2, handletextpad=0.4)
    axes.grid(False)
    return cells.shape


def all_around(axes):
    values = masked(data["panorama"])
    image = axes.imshow(values, origin="lower", extent=(-180, 180, -90, 90), cmap=NEAR_TO_FAR, norm=norm_of(values),
                        interpolation="nearest", zorder=1, aspect="auto")
    if data["course"]:
        w = np.array(data["course"]["velocity"])
        mark(axes, np.degrees([np.arctan2(w[1], w[0]), np.arcsin(w[2] / np.linalg.norm(w))]), data["course"])
        axes.legend(loc="lower right", bbox_to_anchor=(1, 1), frameon=False, borderaxespad=0.2)
    axes.set_xticks(range(-180, 181, 45))
    axes.set_xlim(180, -180)  # as the agent sees it: what is to the left of x stands on the left
    axes.set_yticks(range(-90, 91, 30))
    axes.set_xlabel("azimuth of the velocity, from x towards y (degrees)")
    axes.set_ylabel("elevation (degrees)")
    colour_bar(axes, image)
    weight = np.cos(np.radians(np.linspace(-89.5, 89.5, values.shape[0])))
    safe = (values.mask * weight[:, None]).sum() / (weight.sum() * values.shape[1]) if np.ma.is_masked(values) else 0
    axes.set_title("white: no contact ever, %.1f %% of all directions (by the pixels)" % (100 * safe), fontsize=7, loc="left")


rows, columns = np.array([len(data["top"]["rows"]), len(data["top"]["rows"][0])])
share = min(max(rows / columns, 0.3), 1.0)
height = 0.9 * TWO_COLUMNS * share
figure = plt.figure(figsize=(TWO_COLUMNS, height + 3.9))
total = height + 3.9
figure.text(0.01, 1 - 0.2 / total, data["title"], fontsize=8)
if data["course"]:
    figure.text(0.99, 1 - 0.2 / total, courses.sentence(data["course"]), fontsize=8, ha="right", color=courses.color(data["course"]))
above(figure.add_axes([0.08, (3.4) / total, 0.9, (height - 0.1) / total]))
all_around(figure.add_axes([0.08, 0.45 / total, 0.92, 2.3 / total]))
save(figure, "cone")
