# SPDX-License-Identifier: BSD-3-Clause
"""A swarm: the ways of its agents from above and from the side, and when they arrive."""
import csv
import os

import numpy as np
from matplotlib.patches import Ellipse, Rectangle
from vericone_figures.style import AGENT, GREY, OBSTACLE, TWO_COLUMNS, folder, plt, read, save


def table(name):
    with open(os.path.join(folder(), name), encoding="utf-8") as f:
        rows = list(csv.DictReader(f))
    return {key: np.array([float(row[key]) for row in rows]) for key in (rows[0] if rows else ())}


summary, rows, agents, obstacles = read("summary.json"), table("positions.csv"), table("agents.csv"), table("obstacles.csv")
count = summary["agents"]
places = {axis: rows[axis].reshape(-1, count) for axis in "xyz"}
times = rows["t"].reshape(-1, count)[:, 0]
# Half way through, bodies are drawn.
half = len(times) // 2
reach = agents["reach"]
touched = sorted({pair[key] for pair in summary["touched_pairs"] for key in "ab" if pair[key] < count})

figure, axes = plt.subplots(1, 3, figsize=(TWO_COLUMNS, 0.36 * TWO_COLUMNS), width_ratios=[1, 1, 0.8])
hues = plt.get_cmap("viridis")(np.linspace(0, 0.95, count))
for axis, (u, v) in zip(axes, (("x", "y"), ("x", "z"))):
    low_u, high_u = places[u].min() - 5, places[u].max() + 5
    low_v, high_v = places[v].min() - 5, places[v].max() + 5
    bodies = len(obstacles.get("x", ()))
    if bodies > 2000:  # a map: how much of it stands behind each place
        amounts, edges_u, edges_v = np.histogram2d(obstacles[u], obstacles[v], bins=200,
                                                   weights=obstacles["half_x"] * obstacles["half_y"] * obstacles["half_z"])
        axis.pcolormesh(edges_u, edges_v, np.log1p(amounts.T / max(amounts.max() * 1e-3, 1e-12)), cmap="Greys", alpha=0.6, rasterized=True)
        low_u, high_u, low_v, high_v = edges_u[0], edges_u[-1], edges_v[0], edges_v[-1]
        bodies = 0
    for k in range(bodies):
        a, b = obstacles["half_" + u][k], obstacles["half_" + v][k]
        if obstacles["box"][k]:
            axis.add_patch(Rectangle((obstacles[u][k] - a, obstacles[v][k] - b), 2 * a, 2 * b, color=OBSTACLE, alpha=0.25, lw=0))
        else:
            axis.add_patch(Ellipse((obstacles[u][k], obstacles[v][k]), 2 * a, 2 * b, color=OBSTACLE, alpha=0.15, lw=0))
    for i in range(count):
        axis.plot(places[u][:, i], places[v][:, i], color=hues[i], lw=0.35, alpha=min(1, 60 / count + 0.15))
    for i in range(count):
        color = "#b3202a" if i in touched else AGENT
        axis.add_patch(Ellipse((places[u][half, i], places[v][half, i]), 2 * reach[i], 2 * reach[i], color=color, alpha=0.5, lw=0))
    axis.set_aspect("equal")
    axis.set_xlim(low_u, high_u)
    axis.set_ylim(low_v, high_v)
    axis.set_xlabel(u + " (m)")
    axis.set_ylabel(v + " (m)")
axes[0].set_title("from above, balls about the bodies at %g s" % times[half], fontsize=6)
axes[1].set_title("from the side", fontsize=6)
arrived = np.sort(agents["arrived"][np.isfinite(agents["arrived"])])
axes[2].step(np.concatenate([[0], arrived, [max(summary["end"], 1)]]),
             np.concatenate([[0], np.arange(1, len(arrived) + 1), [len(arrived)]]), where="post", color=AGENT, label="flown")
straight = np.sort(agents["straight"])
axes[2].step(np.concatenate([[0], straight]), np.arange(count + 1), where="post", color=GREY, ls=":", label="straight, at 1 m/s")
axes[2].set_xlabel("t (s)")
axes[2].set_ylabel("arrived")
axes[2].legend(fontsize=6, frameon=False, loc="upper left")
least = summary["least_distance"]
axes[2].set_title("%s: %d pairs touched%s" % (summary["method"], summary["touched"],
                                              "" if least is None else ",\nthe others %.2g m or more apart" % least), fontsize=6)
figure.tight_layout(pad=0.4)
save(figure, "swarm")
