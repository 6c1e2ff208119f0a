# SPDX-License-Identifier: BSD-3-Clause
"""Planar bodies at several times, with their velocities and the sector of the inner common tangents."""
import numpy as np

from plot.bodies import outline
from vericone_figures.runs import Sheet, figure, first_run
from vericone_figures.style import BOUND, ONE_COLUMN, TWO_COLUMNS, plt, save
from plot.tables import row_at

CLEAR = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.85}
data = figure()
run = first_run(data)
sheet = Sheet()
times = data["times"]
columns = 4 if len(times) > 4 else len(times)
rows = -(-len(times) // columns)
panels = plt.figure(figsize=(TWO_COLUMNS, 1.95 * rows), constrained_layout=True).subplots(
    rows, columns, sharex=True, sharey=True, squeeze=False)
curves = {(t, n): outline(run.shapes[n], row_at(b, t), 721) for t in times for n, b in run.bodies.items()}
everything = np.vstack(list(curves.values()))
low, high = everything.min(axis=0) - [3, 3], everything.max(axis=0) + [3, 12]  # room for the text
agent = run.agents()[0]
for t, axes in zip(times, panels.flat):
    for name, body in run.bodies.items():
        row, color = row_at(body, t), run.color(name)
        axes.fill(*curves[t, name].T, facecolor=color, alpha=0.3)
        sheet.line(axes, "outline at %g s" % t, name, *curves[t, name].T, color=color, linewidth=0.9, label=name)
        start = np.array([row["x"], row["y"]])
        tip = start + 0.5 * np.array([row["vx"], row["vy"]])
        axes.annotate("", xy=tip, xytext=start, arrowprops={"arrowstyle": "-|>", "lw": 0.8, "color": color,
                                                             "shrinkA": 0, "shrinkB": 0, "mutation_scale": 7})
        sheet.add("velocity at %g s, over 0.5 s" % t, name, *np.stack([start, tip], axis=1))
        if np.isfinite(row["k"]):
            axes.text(0.97, 0.84, "k = %.2f" % row["k"], transform=axes.transAxes, fontsize=6.5, ha="right", zorder=9,
                      bbox=CLEAR)
    for (pilot, obstacle), e in run.encounters.items():
        now = row_at(e, t)
        if pilot != agent or abs(now["t"] - t) > 1e-6 or not np.isfinite(now["psi"]):
            continue
        start = np.array([row_at(run.bodies[agent], t)[c] for c in ("x", "y")])
        for side in (-0.5, 0.5):
            angle = now["theta"] + now["theta_b"] + side * now["psi"]
            ray = np.stack([start, start + 60 * np.array([np.cos(angle), np.sin(angle)])], axis=1)
            sheet.line(axes, "sector at %g s" % t, "edge", *ray, color=BOUND, linewidth=0.7, linestyle="--", zorder=0)
        v = np.array([np.cos(now["theta"]) * now["V_r"] - np.sin(now["theta"]) * now["V_theta"],
                      np.sin(now["theta"]) * now["V_r"] + np.cos(now["theta"]) * now["V_theta"]])
        axes.annotate("", xy=start - 0.5 * v, xytext=start, arrowprops={
            "arrowstyle": "-|>", "lw": 0.8, "color": "k", "shrinkA": 0, "shrinkB": 0, "mutation_scale": 6})
        y = "%.3f" % now["y"] if abs(now["y"]) >= 5e-4 else "%.0e" % now["y"]
        axes.text(0.97, 0.92, "y = " + y, transform=axes.transAxes, fontsize=6.5, ha="right", zorder=9, bbox=CLEAR)
    axes.set_title("t = %g s" % t, fontsize=7.5)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal")
for axes in panels.flat[len(times):]:
    axes.axis("off")
for axes in panels[-1]:
    axes.set_xlabel("x [m]")
for axes in panels[:, 0]:
    axes.set_ylabel("y [m]")
panels[0, 0].legend(loc="upper left")
sheet.write(data["name"])
save(panels[0, 0].figure, data["name"])
