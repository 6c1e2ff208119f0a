# SPDX-License-Identifier: BSD-3-Clause
"""The ellipse of least area around several vehicles, on the ground or in the picture, with what steers the altitude."""
import numpy as np

from vericone_figures.runs import COLORS, Sheet, figure
from vericone_figures.style import EXACT, GREY, ONE_COLUMN, SLICE, plt, save
from plot.tables import groups, row_at, rows

SIDE = 8.0  # m, of the square around every vehicle
data = figure()
folder, picture = data["data"]["run"], bool(data.get("picture"))
uas = row_at(groups(rows(folder, "uas.csv"))[()], data["time"])
cars = {name: row_at(car, data["time"]) for (name,), car in groups(rows(folder, "cars.csv"), "body").items()}
sheet = Sheet()
fig, axes = plt.subplots(figsize=(1.4 * ONE_COLUMN, 1.15 * ONE_COLUMN), constrained_layout=True)
middle = np.array([uas["x"], uas["y"]])
if picture:
    width, height = data["width"], data["height"]
    scale = 0.5 * width / np.tan(0.5 * np.radians(data["field_of_view_deg"])) / uas["z"]  # px a metre


def shown(points):
    points = np.atleast_2d(points)
    return (points - middle) * [scale, -scale] + [0.5 * width, 0.5 * height] if picture else points


axis = np.array([np.cos(uas["angle"]), np.sin(uas["angle"])])
centre = np.array([uas["c_x"], uas["c_y"]])
turn = np.linspace(0, 2 * np.pi, 361)
outline = shown(centre + np.outer(uas["a"] * np.cos(turn), axis) + np.outer(uas["b"] * np.sin(turn), [-axis[1], axis[0]]))
axes.plot(*outline.T, color=EXACT, label="least-area ellipse E")
sheet.add("outline", "E", *outline.T)
corners = []
for color, (name, car) in zip(COLORS, cars.items()):
    place = np.array([car["x"], car["y"]])
    square = place + 0.5 * SIDE * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1], [-1, -1]])
    corners.append(square[:4])
    axes.plot(*shown(square).T, color=color, linewidth=1)
    axes.annotate(name, shown(place)[0], color=color, fontsize=7, ha="center", va="center")
    sheet.add("square", name, *shown(square).T)
foci = shown(np.array([[uas["F1_x"], uas["F1_y"]], [uas["F2_x"], uas["F2_y"]]]))
if picture:
    low, high = outline.min(axis=0), outline.max(axis=0)
    axes.plot([low[0], high[0], high[0], low[0], low[0]], [low[1], low[1], high[1], high[1], low[1]], color=SLICE,
              label="control area")
    axes.plot(*np.stack([low, high]).T, color=SLICE, linestyle="--", linewidth=0.8)
    axes.annotate("$x_S$ = %.0f px" % uas["x_S"], 0.25 * low + 0.75 * high, color=SLICE, fontsize=7, xytext=(6, -4),
                  textcoords="offset points")
    image = np.array([0.5 * width, 0.5 * height])
    axes.plot(*np.stack([image, 0.5 * (low + high)]).T, color=GREY, linewidth=1)
    axes.plot(*image, "+", color="k", label="middle of the picture")
    axes.annotate("$x_C$ = %.0f px" % uas["x_C"], 0.5 * image + 0.25 * (low + high), color=GREY, fontsize=7, xytext=(5, 5),
                  textcoords="offset points")
    axes.set_xlim(0, width)
    axes.set_ylim(height, 0)
    axes.set_xlabel("u, to the right [px]")
    axes.set_ylabel("v, down [px]")
else:
    axes.plot(*np.concatenate(corners).T, "x", color="#b03030", markersize=4, label="corners")
    axes.plot(*foci.T, "o", color=EXACT, markersize=3, label="foci")
    axes.set_xlabel("x, east [m]")
    axes.set_ylabel("y, north [m]")
axes.set_aspect("equal", adjustable="box" if picture else "datalim")
axes.legend(loc="upper right", fontsize=6)
sheet.write(data["name"])
save(fig, data["name"])
