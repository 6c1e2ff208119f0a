# SPDX-License-Identifier: BSD-3-Clause
"""Guidance and control of chapter 2 as blocks: from the engagement to an acceleration, from that to tail and gas."""
from vericone_figures.runs import Sheet, figure
from vericone_figures.style import AGENT, EXACT, GREY, OBSTACLE, SLICE, TWO_COLUMNS, plt, save

data = figure()
sheet = Sheet()
axes = plt.figure(figsize=(TWO_COLUMNS, 2.4), constrained_layout=True).gca()
axes.set_axis_off()
axes.set_xlim(0, 11.2)
axes.set_ylim(0, 4.1)


def block(x, y, text, color, width=1.7, height=0.95):
    axes.add_patch(plt.Rectangle((x, y), width, height, facecolor=color, alpha=0.15, edgecolor="none"))
    axes.add_patch(plt.Rectangle((x, y), width, height, fill=False, edgecolor=color, linewidth=1))
    axes.text(x + width / 2, y + height / 2, text, ha="center", va="center", fontsize=6.5)
    sheet.add("block", text.replace("\n", " "), [x], [y])


def arrow(points, text="", at=None, ha="center"):
    for (x0, y0), (x1, y1) in zip(points[:-2], points[1:-1]):
        axes.plot([x0, x1], [y0, y1], color="k", linewidth=0.8, solid_capstyle="butt")
    axes.annotate("", points[-1], points[-2], arrowprops={"arrowstyle": "->", "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0})
    if text:
        x, y = at or ((points[0][0] + points[1][0]) / 2, points[0][1] + 0.08)
        axes.text(x, y, text, ha=ha, va="bottom", fontsize=6.5)


block(0.1, 2.0, "orifice\nand fish", OBSTACLE, width=1.15)
block(1.95, 2.0, "cone function y\n(2.2)", GREY, width=1.35)
block(4.0, 2.0, "guidance law\n(2.4): a, δ, γ", SLICE, width=1.45)
block(6.3, 3.0, "gas volume V₃ (2.5),\nlimited rate", EXACT)
block(6.3, 1.6, "amplitude $A_m$ (2.10),\nodd strokes", EXACT)
block(6.3, 0.2, "bias $K_y Δy$, odd strokes;\n$-K_{α_1} α_1$, even ones", EXACT, width=1.9)
block(9.4, 1.6, "robotic fish:\nheave, sway, yaw", AGENT, width=1.55)
arrow([(1.25, 2.48), (1.95, 2.48)], "states")
arrow([(3.3, 2.48), (4.0, 2.48)], "y")
arrow([(5.45, 2.6), (5.85, 2.6), (5.85, 3.48), (6.3, 3.48)], "$a_z$", at=(6.05, 3.5))
arrow([(5.45, 2.3), (5.85, 2.3), (5.85, 2.08), (6.3, 2.08)], "$a_x, a_y$", at=(6.03, 2.12))
arrow([(8.0, 3.48), (10.2, 3.48), (10.2, 2.55)], "$\\dot V_3$", at=(9.0, 3.52))
arrow([(8.0, 2.08), (8.63, 2.08)], "$A_m$", at=(8.3, 2.12))
axes.add_patch(plt.Circle((8.77, 2.08), 0.14, fill=False, linewidth=0.9))
axes.text(8.77, 2.08, "+", ha="center", va="center", fontsize=7)
arrow([(8.2, 0.68), (8.77, 0.68), (8.77, 1.94)], "bias", at=(8.45, 0.72))
arrow([(8.91, 2.08), (9.4, 2.08)], "$α_1$", at=(9.15, 2.12))
arrow([(10.95, 2.08), (11.1, 2.08), (11.1, 0.02), (0.68, 0.02), (0.68, 2.0)])
arrow([(3.6, 0.02), (3.6, 0.68), (6.3, 0.68)], "y of fish and orifice", at=(4.9, 0.72))
sheet.write(data["name"])
save(axes.figure, data["name"])
