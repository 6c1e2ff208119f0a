# SPDX-License-Identifier: BSD-3-Clause
"""The two loops of chapter 7 as blocks: in the plane, and in space with the projection on a plane and its filters."""
from vericone_figures.runs import Sheet, figure
from vericone_figures.style import AGENT, EXACT, GREY, SLICE, TWO_COLUMNS, plt, save

data = figure()
space = bool(data.get("space"))
sheet = Sheet()
axes = plt.figure(figsize=(TWO_COLUMNS, 2.5), constrained_layout=True).gca()
axes.set_axis_off()
axes.set_xlim(0, 10.4)
axes.set_ylim(0, 4.2)


def block(x, y, text, color, width=1.75, height=0.95):
    axes.add_patch(plt.Rectangle((x, y), width, height, facecolor=color, alpha=0.15, edgecolor="none"))
    axes.add_patch(plt.Rectangle((x, y), width, height, fill=False, edgecolor=color, linewidth=1))
    axes.text(x + width / 2, y + height / 2, text, ha="center", va="center", fontsize=7)
    sheet.add("block", text.replace("\n", " "), [x], [y])


def arrow(points, text="", at=None, offset=(0, 0.1), ha="center"):
    for (x0, y0), (x1, y1) in zip(points[:-2], points[1:-1]):
        axes.plot([x0, x1], [y0, y1], color="k", linewidth=0.8, solid_capstyle="butt")
    axes.annotate("", points[-1], points[-2], arrowprops={"arrowstyle": "->", "linewidth": 0.8, "shrinkA": 0, "shrinkB": 0})
    if text:
        x, y = at or ((points[0][0] + points[1][0]) / 2, points[0][1])
        axes.text(x + offset[0], y + offset[1], text, ha=ha, va="bottom", fontsize=7)


block(0.2, 2.75, "reference w", GREY, width=1.2)
block(2.0, 2.75, "dynamic inversion\n(6.17)", SLICE)
block(7.3, 2.75, "engagement\n" + ("(7.26)" if space else "(5.8)"), AGENT)
block(4.6, 0.15, "outer loop: LMIs\n(7.20)-(7.24)", EXACT)
arrow([(1.4, 3.22), (2.0, 3.22)])
arrow([(3.75, 3.22), (5.96, 3.22)], r"$\tilde a_{lat,A}$", at=(4.8, 3.22))
axes.add_patch(plt.Circle((6.1, 3.22), 0.14, fill=False, linewidth=0.9))
axes.text(6.1, 3.22, "+", ha="center", va="center", fontsize=7)
arrow([(6.24, 3.22), (7.3, 3.22)], r"$\bar a_{lat,A}$")
arrow([(6.35, 0.62), (6.75, 0.62), (6.75, 1.6), (6.1, 1.6), (6.1, 3.08)], r"$\Delta a_{lat,A}$", at=(6.0, 2.3), ha="right")
arrow([(9.05, 3.22), (9.75, 3.22), (9.75, 1.6), (9.35, 1.6)], "X" if not space else r"$\bar X$", at=(9.4, 3.22))
block(7.6, 1.12, "sensors\n+ noise", GREY)
if space:
    block(5.15 - 1.35, 1.35, "projection on\nthe plane chosen", AGENT, width=1.55, height=0.75)
    arrow([(7.6, 1.75), (5.35, 1.75)], r"noisy $\bar X$", at=(7.0, 1.75))
    block(2.0, 1.25, "filters of y, ψ', θ_b'", EXACT, height=0.85)
    arrow([(3.8, 1.72), (3.75, 1.72)])
else:
    block(2.0, 1.25, "filters of y, ψ', θ_b'", EXACT, height=0.85)
    arrow([(7.6, 1.75), (3.75, 1.75)], "noisy X", at=(5.0, 1.75))
arrow([(2.87, 2.1), (2.87, 2.75)], "ψ', θ_b', y", at=(2.95, 2.32), offset=(0, 0), ha="left")
arrow([(2.87, 1.25), (2.87, 0.62), (4.6, 0.62)], "z = y − w", at=(3.7, 0.62))
sheet.write(data["name"])
save(axes.figure, data["name"])
