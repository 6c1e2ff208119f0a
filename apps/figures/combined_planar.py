# SPDX-License-Identifier: BSD-3-Clause
"""The source's conic (5.5): an ellipse dented by a hyperbola, from dented_conic.json."""
import numpy as np

from plot.solids import ELLIPSOID, HYPERBOLOID
from vericone_figures.style import TWO_COLUMNS, plt, read, save

data = read("dented_conic.json")
figure, (one, family) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 2.9), gridspec_kw={"width_ratios": [1.15, 1]})
body, k, phi = data["body"], data["k"], data["phi"]
center = np.array(body["center"])
a, b = data["a_c"], data["b_c"]
turn = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])


def placed(points):
    return center[:, None] + turn @ points


t = np.linspace(0, 2 * np.pi, 400)
one.plot(*placed(np.sqrt(1 + k) * np.array([a * np.cos(t), b * np.sin(t)])), "--", color=ELLIPSOID, linewidth=0.8)
s = np.linspace(-1.6, 1.6, 200)
for side in (1, -1):
    one.plot(*placed(np.sqrt(1 - k) * np.array([side * a * np.cosh(s), b * np.sinh(s)])), "--", color=HYPERBOLOID,
             linewidth=0.8)
outline = np.vstack([arc["points"] for arc in body["arcs"]])
one.fill(*outline.T, color=ELLIPSOID, alpha=0.15, linewidth=0)
labelled = {}
for arc in body["arcs"]:
    label = "ellipse" if arc["conic"] == 0 else "hyperbola"
    one.plot(*np.array(arc["points"]).T, color=ELLIPSOID if arc["conic"] == 0 else HYPERBOLOID, linewidth=1.8,
             label=None if label in labelled else label)
    labelled[label] = True
# The letters of the source: A, B, C, D counter-clockwise from the corner in the body's first quadrant.
corners = np.array(body["corners"])
local = (corners - center) @ turn
order = np.argsort(np.mod(np.arctan2(local[:, 1], local[:, 0]), 2 * np.pi))
for name, i in zip("ABCD", order):
    away = turn @ (np.sign(local[i]) * [0.75, 0.75])
    one.plot(*corners[i], "k.", markersize=5, zorder=5)
    one.text(*(corners[i] + away), name, ha="center", va="center")
for end, text in (((a * 1.55, 0), "x'"), ((0, b * 2.1), "y'")):
    tip = placed(np.array(end)[:, None])[:, 0]
    one.annotate("", xy=tip, xytext=center, arrowprops={"arrowstyle": "-|>", "lw": 0.6, "color": "k", "mutation_scale": 6,
                                                        "shrinkA": 0})
    one.text(*(tip + 0.6 * (tip - center) / np.linalg.norm(tip - center)), text, ha="center", va="center")
arc = np.linspace(0, phi, 30)
one.plot([center[0], center[0] + 4.2], [center[1], center[1]], color="k", linewidth=0.5)
one.plot(center[0] + 3.4 * np.cos(arc), center[1] + 3.4 * np.sin(arc), color="k", linewidth=0.5)
one.text(center[0] + 2.7 * np.cos(phi / 2), center[1] + 2.7 * np.sin(phi / 2), "$\\phi$", ha="center", va="center")
one.set_aspect("equal")
one.set_xlabel("x (m)")
one.set_ylabel("y (m)")
one.set_title("(a) $a_c = %g$ m, $b_c = %g$ m, $k = %g$, $\\phi = %.0f°$" % (a, b, k, np.degrees(phi)))
one.legend(loc="lower right", frameon=False)
colors = plt.get_cmap("viridis")(np.linspace(0, 0.85, len(data["family"])))
for color, member in zip(colors, data["family"]):
    line = np.vstack([arc["points"] for arc in member["arcs"]])
    family.plot(*np.vstack([line, line[:1]]).T, color=color, label="k = %g" % member["k"])
    if member["corners"]:
        family.plot(*np.array(member["corners"]).T, ".", color=color, markersize=4)
family.set_aspect("equal")
family.set_xlabel("x' (m)")
family.set_ylabel("y' (m)")
family.set_title("(b) $k$ from 0 (ellipse) to 1 (pinched)")
family.legend(loc="upper center", bbox_to_anchor=(0.5, -0.26), ncol=5, frameon=False, columnspacing=1, handlelength=1.2)
figure.tight_layout(pad=0.4, w_pad=1.2)
save(figure, "dented_conic")
