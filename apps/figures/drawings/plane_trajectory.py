# SPDX-License-Identifier: BSD-3-Clause
"""Ways of planar bodies, with their true outlines at several times."""
import numpy as np

from plot.bodies import outline
from vericone_figures.runs import Sheet, dark, figure, first_run
from vericone_figures.style import ONE_COLUMN, TWO_COLUMNS, plt, save
from plot.tables import row_at

data = figure()
run = first_run(data)
sheet = Sheet()
times = np.array(data["times"])
ways = {name: np.stack([b["x"], b["y"]]) for name, b in run.bodies.items()}
outlines = {name: [(t, outline(run.shapes[name], row_at(b, t), 721)) for t in times
                   if b["t"][0] - 1e-6 <= t <= b["t"][-1] + 1e-6] for name, b in run.bodies.items()}
everything = np.vstack([w.T for w in ways.values()] + [c for parts in outlines.values() for _, c in parts] +
                       ([np.array([data["goal"]])] if data.get("goal") else []))
low, high = everything.min(axis=0), everything.max(axis=0)
pad = 0.07 * (high - low).max()
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
    row = row_at(run.bodies[name], run.bodies[name]["t"][0])
    axes.plot(row["x"], row["y"], "o", color=color, markersize=2.5, zorder=4)

for t, where, pair in run.contacts():
    axes.plot(*where[:2], "x", color="red", markersize=6, zorder=7, label="%s and %s touch, %.4g s" % (*pair, t))
    sheet.add("trajectory", "contact", where[:1], where[1:2])
if data.get("goal"):
    axes.plot(*data["goal"], "*", color="k", markersize=7, label="goal", zorder=5)
    sheet.add("trajectory", "goal", data["goal"][:1], data["goal"][1:2])
axes.set_xlim(low[0] - pad, high[0] + pad)
axes.set_ylim(low[1] - pad, high[1] + pad)
axes.set_aspect("equal")
axes.set_xlabel("x [m]")
axes.set_ylabel("y [m]")
axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncol=2, frameon=False)

# Times beside the bodies, in their colours, where neither a body nor a way nor another time is.
axes.figure.canvas.draw()
points = 72 / axes.figure.dpi
taken = points * axes.transData.transform(np.vstack([c for parts in outlines.values() for _, c in parts] +
                                                    [w.T for w in ways.values()]))
inside = points * np.array(axes.get_window_extent().get_points())
boxes = []


def is_free(low, high):
    return (np.all(low > inside[0]) and np.all(high < inside[1]) and
            not np.any(np.all((taken > low - 1) & (taken < high + 1), axis=1)) and
            not any(np.all(low < h + 1) and np.all(high > l - 1) for l, h in boxes))


for name in run.bodies:
    for t, _ in outlines[name]:
        row, text = row_at(run.bodies[name], t), "%g s" % t
        here = points * axes.transData.transform((row["x"], row["y"]))
        half = 0.5 * np.array([3.3 * len(text), 6.0])
        angles = row["azimuth"] + np.pi / 2 + np.array([0, 1, 0.25, -0.25, 0.75, -0.75, 0.5, -0.5]) * np.pi
        spots = [here + r * np.array([np.cos(q), np.sin(q)]) for r in (11, 14, 17, 21, 26, 32) for q in angles]
        spot = next((s for s in spots if is_free(s - half, s + half)), spots[0])
        boxes.append((spot - half, spot + half))
        axes.annotate(text, (row["x"], row["y"]), xytext=spot - here, textcoords="offset points", fontsize=5.5,
                      color=dark(run.color(name)), ha="center", va="center", zorder=6)
sheet.write(data["name"])
save(axes.figure, data["name"])
