# SPDX-License-Identifier: BSD-3-Clause
"""What a better hull buys, fit_cones.json: the directions that collide with a scan and with hulls of it, as the agent
sees them, and by how much the cones of the hulls are too large."""
import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path

from vericone_figures.style import GREY, OBSTACLE, SLICE, TWO_COLUMNS, EXACT, plt, read, save

COLORS = {"ellipsoid": SLICE, "hull": EXACT, "convex hull": OBSTACLE}
SCAN, SAVED, BETWEEN = "#b9b9b9", "#cfe8cf", "#f3f3f3"
DASHES = {"ellipsoid": "-", "hull": "-", "convex hull": (0, (3, 1.5))}


def unit(x):
    return x / np.linalg.norm(x, axis=-1, keepdims=True)


class View:
    """Angles from the line of sight keep their size: azimuthal equidistant, degrees."""

    def __init__(self, towards):
        self.towards = unit(np.array(towards))
        up = np.array([0, 0, 1.0]) if abs(self.towards[2]) < 0.999 else np.array([1.0, 0, 0])
        self.up = unit(up - (up @ self.towards) * self.towards)
        self.right = np.cross(self.towards, self.up)

    def project(self, directions):
        d = unit(np.array(directions))
        angle = np.degrees(np.arctan2(np.linalg.norm(np.cross(d, self.towards), axis=-1), d @ self.towards))
        across = np.stack([d @ self.right, d @ self.up], axis=-1)
        return angle[:, None] * across / np.maximum(np.linalg.norm(across, axis=-1, keepdims=True), 1e-300)


def compound(loops):
    points, codes = [], []
    for loop in loops:
        points.extend([*loop, loop[0]])
        codes.extend([Path.MOVETO] + [Path.LINETO] * (len(loop) - 1) + [Path.CLOSEPOLY])
    return Path(points, codes)


def show_cones(axes, shown, names):
    view = View(shown["towards"])
    loops = {row["what"]: [view.project(loop) for loop in row["loops"]] for row in shown["rows"]}
    everything = [what for what, own in loops.items() if not own]
    points = np.vstack([loop for own in loops.values() for loop in own])
    low, high = points.min(axis=0), points.max(axis=0)
    low, high = low - 0.06 * (high - low), high + 0.06 * (high - low)

    def fill(what, color):
        if loops.get(what):
            axes.add_patch(PathPatch(compound(loops[what]), facecolor=color, edgecolor="none"))

    if "ellipsoid" in everything and "hull" not in everything:
        axes.set_facecolor(SAVED)
    fill("ellipsoid", SAVED)
    fill("hull", BETWEEN)
    fill("scan", SCAN)
    if loops.get("scan"):
        axes.add_patch(PathPatch(compound(loops["scan"]), facecolor="none", edgecolor=GREY, linewidth=0.5))
    for what in ("convex hull", "ellipsoid", "hull"):
        if loops.get(what):
            axes.add_patch(PathPatch(compound(loops[what]), facecolor="none", edgecolor=COLORS[what],
                                     linestyle=DASHES[what], linewidth=1.1))
    axes.plot(0, 0, "k+", markersize=5)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal",
             xlabel="to the right of the line of sight (deg)", ylabel="above it (deg)")
    axes.set_title("directions of relative velocity, as the agent sees them", fontsize=8)
    sizes = {row["what"]: 0.5 * (row["low"] + row["high"]) for row in shown["rows"]}
    handles = [Patch(facecolor=SCAN, edgecolor=GREY, linewidth=0.5, label="collides: scan %.4g sr" % sizes["scan"])]
    for what in ("ellipsoid", "hull", "convex hull"):
        if what in sizes:
            size = "every direction" if what in everything else "%.4g sr" % sizes[what]
            handles.append(Line2D([], [], color=COLORS[what], linestyle=DASHES[what],
                                  label="%s %s" % (names[what], size)))
    if "ellipsoid" in sizes and "hull" in sizes:
        handles.append(Patch(facecolor=SAVED, label="refused by the ellipsoid, free by the hull"))
    return handles


def show_excess(axes, data, names):
    rows = [row for row in data["mean"] if row["what"] != "scan"]
    several = len(data["agents"]) > 1
    for place, row in enumerate(rows):
        low = 100 * row["excess_low"]
        bounded = row["excess_high"] is not None
        high = 100 * row["excess_high"] if bounded else low
        axes.bar(place, 0.5 * (low + high), width=0.6, color=COLORS[row["what"]], alpha=0.75)
        axes.errorbar(place, 0.5 * (low + high), yerr=0.5 * (high - low), color="k", linewidth=0.8, capsize=3)
        note = "%.1f to %.1f" % (low, high) if bounded else "at least %.1f" % low
        top = max(high, 0)
        if several:
            each = [50 * (r["excess_low"] + r["excess_high"]) for agent in data["agents"] for r in agent["rows"]
                    if r["what"] == row["what"] and r["excess_high"] is not None]
            axes.plot(place + np.linspace(-0.22, 0.22, len(each)), sorted(each), ".", color="k", markersize=2.5,
                      markeredgewidth=0)
            top = max(top, *each)
        axes.annotate(note, (place, top), xytext=(0, 4), textcoords="offset points", ha="center", fontsize=7)
    axes.axhline(0, color="k", linewidth=0.6)
    axes.margins(y=0.12)
    axes.set_xticks(range(len(rows)))
    axes.set_xticklabels([names[row["what"]] for row in rows])
    axes.set_ylabel("excess over the scan's cone (%)")
    axes.grid(False, axis="x")
    axes.set_title("mean of %d agents, each a dot" % len(data["agents"]) if several else "this agent", fontsize=8)


data = read("fit_cones.json")
names = {"ellipsoid": "ellipsoid", "hull": "hull of the fit", "convex hull": "convex hull"}
figure, (left, right) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 3.9), width_ratios=(1.35, 1))
left.set_axisbelow(True)
handles = show_cones(left, data["shown"], names)
show_excess(right, data, names)
figure.suptitle("%s: %s" % (data["title"], data["shown"]["agent"]), fontsize=8.5)
figure.legend(handles=handles, loc="lower center", ncols=3, frameon=False, columnspacing=1.2, handlelength=1.6)
figure.tight_layout(rect=(0, 0.1, 1, 1))
save(figure, "fit_cones")
