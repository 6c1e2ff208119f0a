# SPDX-License-Identifier: BSD-3-Clause
"""The engagement of a UAS and one vehicle, or the ellipse around several, seen from above, with its rendezvous cone."""
import numpy as np

from vericone_figures.runs import COLORS, Sheet, figure
from vericone_figures.style import AGENT, EXACT, GREY, ONE_COLUMN, SLICE, plt, save
from plot.tables import groups, row_at, rows

data = figure()
folder = data["data"]["run"]
uas = row_at(groups(rows(folder, "uas.csv"))[()], data["time"])
cars = {name: row_at(car, data["time"]) for (name,), car in groups(rows(folder, "cars.csv"), "body").items()}
sheet = Sheet()
fig, axes = plt.subplots(figsize=(1.4 * ONE_COLUMN, 1.2 * ONE_COLUMN), constrained_layout=True)
A = np.array([uas["x"], uas["y"]])
several = len(cars) > 1


def arrow(start, along, color, name, scale=1.0):
    end = start + scale * along
    axes.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": color, "linewidth": 1.3})
    axes.annotate(name, end, xytext=(3, 3), textcoords="offset points", color=color, fontsize=7)
    axes.plot(*end, alpha=0)  # the axes are as wide as the arrows
    sheet.add("arrow", name, [start[0], end[0]], [start[1], end[1]])


if several:
    centre, angle = np.array([uas["c_x"], uas["c_y"]]), uas["angle"]
    a, b = uas["a"], uas["b"]
    targets = {"$F_1$": np.array([uas["F1_x"], uas["F1_y"]]), "$F_2$": np.array([uas["F2_x"], uas["F2_y"]])}
else:
    car = next(iter(cars.values()))
    centre, angle, a, b = np.array([car["x"], car["y"]]), 0.0, 2.5, 2.5
    targets = {"B": centre}
turn = np.linspace(0, 2 * np.pi, 721)
axis = np.array([np.cos(angle), np.sin(angle)])
outline = centre + np.outer(a * np.cos(turn), axis) + np.outer(b * np.sin(turn), [-axis[1], axis[0]])
axes.fill(*outline.T, facecolor=EXACT, alpha=0.2, edgecolor=EXACT)
sheet.add("outline", "E" if several else "R", *outline.T)
directions = np.unwrap(np.arctan2(outline[:, 1] - A[1], outline[:, 0] - A[0]))
far = 1.2 * np.linalg.norm(centre - A)
low, high = directions.min(), directions.max()
wedge = np.array([A, *(A + far * np.array([np.cos(t), np.sin(t)]) for t in np.linspace(low, high, 30))])
axes.fill(*wedge.T, facecolor=SLICE, alpha=0.15, label="rendezvous cone X, of relative velocities")
for i, (name, place) in enumerate(targets.items()):
    axes.plot(*np.stack([A, place]).T, color=GREY, linewidth=0.8)
    axes.annotate("$r_%d$" % (i + 1) if several else "r", 0.55 * A + 0.45 * place, fontsize=7, color=GREY,
                  xytext=(4, 2 if i == 0 else -9), textcoords="offset points")
    axes.plot(*place, "o", color=EXACT, markersize=3)
    axes.annotate(name, place, xytext=(3, 3), textcoords="offset points", fontsize=7, color=EXACT)
arrow(A, np.array([uas["v_x"], uas["v_y"]]), AGENT, "$V_A$, heading α")
for color, (name, car) in zip(COLORS, cars.items()):
    place = np.array([car["x"], car["y"]])
    axes.plot(*place, "s", color=color, markersize=4)
    arrow(place, np.array([car["v_x"], car["v_y"]]), color, "$V_B$, heading β" if not several else "$V_{%s}$" % name)
axes.plot(*np.stack([A, A + [0.35 * far, 0]]).T, color=GREY, linewidth=0.6, linestyle=":")
theta = np.arctan2(*(targets["$F_1$"] - A if several else centre - A)[::-1])
arc = np.array([A + 0.25 * far * np.array([np.cos(t), np.sin(t)]) for t in np.linspace(0, theta, 40)])
axes.plot(*arc.T, color=GREY, linewidth=0.8)
axes.annotate("$θ_1$" if several else "θ", arc[22], xytext=(4, -2), textcoords="offset points", fontsize=7, color=GREY)
axes.plot(*A, "o", color=AGENT, markersize=4)
axes.annotate("A", A, xytext=(-9, 4), textcoords="offset points", color=AGENT, fontsize=8)
axes.set_aspect("equal", adjustable="datalim")
axes.set_xlabel("x, east [m]")
axes.set_ylabel("y, north [m]")
axes.legend(loc="lower left")
sheet.write(data["name"])
save(fig, data["name"])
