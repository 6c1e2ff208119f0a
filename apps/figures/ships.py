# SPDX-License-Identifier: BSD-3-Clause
"""Ships: their ways with the domains, when each pair is nearest; and how near all come."""
import csv
import os

import numpy as np
from matplotlib.patches import Ellipse
from vericone_figures.style import GREY, TWO_COLUMNS, folder, plt, read, save

MILE = 1852


def table(name):
    with open(os.path.join(folder(), name), encoding="utf-8") as f:
        return list(csv.DictReader(f))


summary, ships = read("summary.json"), table("ships.csv")
rows = table("positions.csv")
count = len(ships)
column = {key: np.array([float(row[key]) for row in rows]).reshape(-1, count) for key in ("t", "x", "y", "heading")}
times, x, y, heading = column["t"][:, 0], column["x"] / MILE, column["y"] / MILE, column["heading"]
hues = plt.get_cmap("viridis")(np.linspace(0, 0.85, count))


def outline(axis, k, i, ahead, abeam, center, **look):
    turn = np.array([[np.cos(heading[k, i]), -np.sin(heading[k, i])], [np.sin(heading[k, i]), np.cos(heading[k, i])]])
    at = np.array([x[k, i], y[k, i]]) + turn @ np.array(center) / MILE
    axis.add_patch(Ellipse(at, 2 * ahead / MILE, 2 * abeam / MILE, angle=np.degrees(heading[k, i]), **look))


figure, (axis, apart) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 0.48 * TWO_COLUMNS), width_ratios=[1.1, 1])
for i in range(count):
    axis.plot(x[:, i], y[:, i], color=hues[i], lw=0.8)
    axis.plot(x[0, i], y[0, i], "o", color=hues[i], ms=3)
    axis.annotate(str(i), (x[0, i], y[0, i]), textcoords="offset points", xytext=(3, 3), fontsize=6, color=hues[i])
shown, handles = set(), {}
for pair in summary["pairs"]:
    a, b = pair["a"], pair["b"]
    between = np.hypot(x[:, a] - x[:, b], y[:, a] - y[:, b])
    nearest = int(between.argmin())
    shown |= {(nearest, a), (nearest, b)} if pair["seen"] is not None else set()
    # In the colours of both ships by turns.
    looks = [(GREY, ":")] if pair["seen"] is None else [(hues[a], "-"), (hues[b], (0, (3, 3)))]
    lines = [apart.plot(times / 60, between, color=color, lw=0.8, ls=style)[0] for color, style in looks]
    handles["%d and %d: %s" % (a, b, "no risk" if pair["seen"] is None else pair["encounter"])] = tuple(lines)
for k, i in sorted(shown):
    ship = {key: float(value) for key, value in ships[i].items()}
    outline(axis, k, i, ship["domain_ahead"], ship["domain_abeam"], (ship["center_ahead"], ship["center_port"]),
            fill=False, edgecolor=hues[i], lw=0.7)
    outline(axis, k, i, ship["length"] / 2, ship["beam"] / 2, (0, 0), color=hues[i], lw=0)
axis.set_aspect("equal", adjustable="datalim")
axis.set_xlabel("east (nautical miles)")
axis.set_ylabel("north (nautical miles)")
axis.set_title("%s: domains where a pair with a risk is nearest" % summary["start"], fontsize=6)
apart.set_yscale("log")
apart.set_xlabel("t (min)")
apart.set_ylabel("distance of middles (nautical miles)")
least = summary["least_domain_distance"]
kept, pairs = summary["pairs_kept"], len(summary["pairs"])
by = "" if least is None else ", by %.3g m: proved" % least
apart.set_title("%d of %d pairs kept both domains%s" % (kept, pairs, by), fontsize=6)
apart.legend(handles.values(), handles.keys(), fontsize=5, loc="lower left", ncol=1 if pairs < 7 else 2,
             facecolor="white", framealpha=0.9, edgecolor="none", handlelength=3)
figure.tight_layout(pad=0.4)
save(figure, "ships")
