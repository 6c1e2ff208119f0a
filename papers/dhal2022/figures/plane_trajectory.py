# SPDX-License-Identifier: BSD-3-Clause
"""Figs 5.6 and 5.11: ways of planar bodies, with their true outlines at several times."""
import numpy as np

from bodies import outline
from runs import Sheet, at, figure
from style import GREY, ONE_COLUMN, TWO_COLUMNS, plt, save

data = figure()
run = data["runs"]["source"]
sheet = Sheet()
times = np.array(data["times"])
ways = {name: np.stack([b["x [m]"], b["y [m]"]]) for name, b in run.bodies.items()}
outlines = {name: [(t, outline(run.shapes[name], at(b, t))) for t in times
                   if b["t [s]"][0] - 1e-6 <= t <= b["t [s]"][-1] + 1e-6] for name, b in run.bodies.items()}
everything = np.vstack([w.T for w in ways.values()] + [c for parts in outlines.values() for _, c in parts] +
                       ([np.array([data["goal"]])] if data.get("goal") else []))
low, high = everything.min(axis=0), everything.max(axis=0)
pad = 0.04 * (high - low).max()
width = ONE_COLUMN if (high - low)[0] < 1.3 * (high - low)[1] else TWO_COLUMNS
height = (width - 0.6) * (high - low + 2 * pad)[1] / (high - low + 2 * pad)[0] + 0.55
axes = plt.figure(figsize=(width, min(height, 4.6)), constrained_layout=True).gca()
for name in run.bodies:
    color = run.color(name)
    sheet.line(axes, "trajectory", name, *ways[name], color=color, label=name, zorder=2)
    for i, (t, curve) in enumerate(outlines[name]):
        strength = 0.25 + 0.6 * i / max(1, len(outlines[name]) - 1)
        axes.fill(*curve.T, facecolor=color, alpha=0.3 * strength, zorder=1)
        sheet.line(axes, "outline", "%s at %g s" % (name, t), *curve.T, color=color, linewidth=0.8, alpha=strength, zorder=3)
    row = at(run.bodies[name], run.bodies[name]["t [s]"][0])
    axes.plot(row["x [m]"], row["y [m]"], "o", color=color, markersize=2.5, zorder=4)
first = run.agents()[0]
for t, curve in outlines[first]:
    row = at(run.bodies[first], t)
    heading = row["azimuth [rad]"]
    side = np.array([-np.sin(heading), np.cos(heading)])
    axes.annotate("%g s" % t, (row["x [m]"], row["y [m]"]), xytext=14 * side, textcoords="offset points", fontsize=6,
                  color=GREY, ha="center", va="center", zorder=6,
                  bbox={"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.7})
if data.get("goal"):
    axes.plot(*data["goal"], "*", color="k", markersize=7, label="goal", zorder=5)
    sheet.add("trajectory", "goal", data["goal"][:1], data["goal"][1:2])
axes.set_xlim(low[0] - pad, high[0] + pad)
axes.set_ylim(low[1] - pad, high[1] + pad)
axes.set_aspect("equal")
axes.set_xlabel("x [m]")
axes.set_ylabel("y [m]")
axes.legend(loc="best")
sheet.write(data["name"])
save(axes.figure, data["name"])
