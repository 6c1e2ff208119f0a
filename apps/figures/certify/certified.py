# SPDX-License-Identifier: BSD-3-Clause
"""Tracks of `vericone certify --out` from certified.json: the ways from above, each as wide as its radius, and what is proved
of each pair over time."""
import numpy as np
from matplotlib.lines import Line2D

from vericone_figures.style import AGENT, BOUND, EXACT, GREY, OBSTACLE, SLICE, TWO_COLUMNS, plt, read, save

COLOURS = (EXACT, AGENT, OBSTACLE, BOUND, "#b58900", "#c2571a", "#6c71c4", "#2aa198")
APART, NEARER, CONTACT, UNDECIDED = "#3a8f4d", "#e0a030", "#c0392b", "#b8b8b8"
MOST_PAIRS = 16  # rows; of more those that are nearest


def draw_ways(axes, data):
    for i, body in enumerate(data["bodies"]):
        x = np.array(body["positions"])
        colour = COLOURS[i % len(COLOURS)]
        if np.ptp(x[:, :2], axis=0).max() > 0:
            axes.plot(x[:, 0], x[:, 1], color=colour, label=body["name"])
        axes.plot(*x[0, :2], "o", color=colour, label=None if np.ptp(x[:, :2], axis=0).max() > 0 else body["name"])
        if body["radius"] > 0:
            for side in (-1, 1):  # along the normal of the way
                way = np.gradient(x[:, :2], axis=0)
                length = np.maximum(np.hypot(*way.T), 1e-12)
                aside = np.column_stack([-way[:, 1], way[:, 0]]) / length[:, None] * body["radius"] * side
                axes.plot(*(x[:, :2] + aside).T, color=colour, linewidth=0.4, alpha=0.7)
    for pair in data["pairs"]:
        if pair["verdict"] != "apart":
            colour = {"contact": CONTACT, "nearer": NEARER}.get(pair["verdict"], UNDECIDED)
            axes.plot(pair["place"][0], pair["place"][1], "x", color=colour, markersize=7, markeredgewidth=1.6)
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    axes.set_title("ways from above, as wide as their radii")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=4, fontsize=6, frameon=False)


def said(pair):
    if pair["verdict"] == "apart":
        return "apart by %.3g m or more" % pair["least_distance"]
    if pair["verdict"] == "contact":
        return "contact at %.5g s" % pair["to"]
    if pair["verdict"] == "nearer":
        return "nearer at %.5g s" % pair["to"]
    return "undecided from %.5g s" % pair["from"]


def draw_pairs(axes, data):
    pairs = sorted(data["pairs"], key=lambda p: (p["verdict"] == "apart", p["least_distance"] or 0))
    shown = pairs[:MOST_PAIRS][::-1]
    for row, pair in enumerate(shown):
        begin, end = pair["there"]
        proved = end if pair["verdict"] == "apart" else pair["from"]
        axes.barh(row, proved - begin, left=begin, color=APART, height=0.55)
        if pair["verdict"] in ("contact", "nearer"):
            axes.barh(row, pair["to"] - proved, left=proved, color=UNDECIDED, height=0.55)
            axes.plot([pair["to"]], [row], "|", color=CONTACT if pair["verdict"] == "contact" else NEARER, markersize=13,
                      markeredgewidth=2.5)
            axes.barh(row, end - pair["to"], left=pair["to"], color="none", edgecolor=GREY, height=0.55, linewidth=0.4)
        elif pair["verdict"] == "undecided":
            axes.barh(row, pair["to"] - proved, left=proved, color=SLICE, height=0.75)
            axes.barh(row, end - pair["to"], left=pair["to"], color="none", edgecolor=GREY, height=0.55, linewidth=0.4)
        axes.text(begin, row + 0.31, " " + said(pair), fontsize=5.5, va="bottom")
    axes.set_yticks(range(len(shown)))
    axes.set_yticklabels(["%s, %s" % (p["a"], p["b"]) for p in shown], fontsize=6)
    axes.set_ylim(-0.6, len(shown) - 0.1)
    axes.set_xlabel("t (s)")
    axes.grid(axis="y", visible=False)
    more = " (the nearest %d of %d)" % (len(shown), len(pairs)) if len(pairs) > len(shown) else ""
    axes.set_title("farther apart than %.3g m, proved%s" % (data["required"], more))
    axes.legend(handles=[Line2D([], [], color=APART, linewidth=5, label="proved apart"),
                         Line2D([], [], color=CONTACT, marker="|", linestyle="", markersize=9, label="contact, proved"),
                         Line2D([], [], color=NEARER, marker="|", linestyle="", markersize=9, label="nearer, proved"),
                         Line2D([], [], color=SLICE, linewidth=5, label="undecided"),
                         Line2D([], [], color=GREY, linewidth=0.6, label="not asked after that")],
                loc="upper center", bbox_to_anchor=(0.45, -0.16), ncol=3, fontsize=6, frameon=False)


data = read("certified.json")
rows = max(1, min(MOST_PAIRS, len(data["pairs"])))
figure, (left, right) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, max(3.3, 1.4 + 0.24 * rows)), constrained_layout=True)
draw_ways(left, data)
draw_pairs(right, data)
figure.suptitle("%s: %s" % (data["name"], data["verdict"]), fontsize=8)
save(figure, "certified")
