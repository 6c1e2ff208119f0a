# SPDX-License-Identifier: BSD-3-Clause
"""Combined quadrics in space, from the figures with "panels" that shapes.json lists."""
import numpy as np

from plot.solids import ELLIPSOID, HYPERBOLOID, Solid, View, draw_lines, draw_solids, frame, scale_bar, triad
from vericone_figures.style import TWO_COLUMNS, plt, read, save

VIEWS = {"biconcave": (28, 18), "biconvex": (-62, 20), "stars": (25, 25)}


def view_of(panel, name):
    key = name
    if name == "combinations":  # each panel as in the figure of its body
        key = "biconvex" if "one-sheeted" in panel["title"] or "biconvex" in panel["title"] else "biconcave"
    return View(*VIEWS[key])


def draw(axes, panel, name):
    view = view_of(panel, name)
    solids = [Solid(s) for s in panel["solids"]]
    if len(solids) == 2:  # two surfaces through each other
        ellipsoid, hyperboloid = solids
        draw_lines(axes, view, hyperboloid.cut(ellipsoid), solids, hyperboloid, hidden_width=0)
        ellipsoid.cut(hyperboloid)
    draw_solids(axes, view, solids, hidden_rims=len(solids) == 1 and name != "stars")
    return view, solids


def planar(axes, body, title):
    for arc in body["arcs"]:
        axes.plot(*np.array(arc["points"]).T, color=ELLIPSOID if arc["conic"] == 0 else HYPERBOLOID, linewidth=1.4)
    axes.fill(*np.vstack([a["points"] for a in body["arcs"]]).T, color=ELLIPSOID, alpha=0.15, linewidth=0)
    axes.plot(*np.array(body["corners"]).T, "k.", markersize=3.5)
    axes.set_aspect("equal")
    axes.set_xlabel("x (m)")
    axes.set_ylabel("y (m)")
    axes.set_title(title, fontsize=8)


for name in read("shapes.json")["figures"]:
    data = read(name + ".json")
    if "panels" not in data:
        continue
    panels, extra = data["panels"], "planar" in data
    count = len(panels) + extra
    columns = count if count <= 3 else 2
    rows = -(-count // columns)
    figure = plt.figure(figsize=(TWO_COLUMNS, rows * (2.5 if rows == 1 else 2.75)))
    if extra:
        axes = figure.add_subplot(rows, columns, 1)
        planar(axes, data["planar"], data["planar_title"])
    drawn = []
    for i, panel in enumerate(panels):
        axes = figure.add_subplot(rows, columns, i + 1 + extra)
        axes.set_title(panel["title"], fontsize=8)
        drawn.append((axes, panel, *draw(axes, panel, name)))
    # Panels of the same body at the same scale.
    for axes, panel, view, solids in drawn:
        same = [s for _, p, v, group in drawn for s in group if np.allclose(v.toward, view.toward)]
        if name == "stars":
            same = solids
        frame(axes, view, np.vstack([s.points + s.center for s in same]))
        triad(axes, view)
        scale_bar(axes, 2)
    figure.subplots_adjust(left=0.07 if extra else 0.01, right=0.99, bottom=0.17 if extra else 0.01,
                           top=0.91 if rows == 1 else 0.95, wspace=0.05 if rows > 1 else 0.02, hspace=0.1)
    save(figure, name)
