# SPDX-License-Identifier: BSD-3-Clause
"""Two pursuits of the same vehicles: distance from their middle, and errors of the estimates."""
import numpy as np

from vericone_figures.runs import COLORS, Sheet, figure
from vericone_figures.style import AGENT, SLICE, TWO_COLUMNS, plt, save
from plot.tables import groups, rows

data = figure()
sheet = Sheet()
fig, (distance, error) = plt.subplots(2, 1, figsize=(TWO_COLUMNS, 3.6), constrained_layout=True, sharex=True)
for role, color, name in (("source", SLICE, "the source's camera and law"), ("ours", AGENT, "a real camera, our law")):
    uas = groups(rows(data["data"][role], "uas.csv"))[()]
    sheet.line(distance, "distance [m]", name, uas["t"], uas["r_c"], color=color, label=name)
for color, ((name,), car) in zip(COLORS, groups(rows(data["data"]["ours"], "cars.csv"), "body").items()):
    off = np.hypot(car["x_est"] - car["x"], car["y_est"] - car["y"])
    sheet.line(error, "error [m]", name, car["t"], off, color=color, label=name, linewidth=0.8)
    hidden = np.array([s in ("total", "lost") for s in car["status"]])
    error.plot(car["t"][hidden], 0 * car["t"][hidden], "|", color=color, markersize=6, alpha=0.4)
distance.set_ylabel("UAS to their middle [m]")
distance.set_yscale("log")
distance.legend(loc="best")
error.set_ylabel("error of ours [m]")
error.set_xlabel("t [s]; bars: said to be hidden")
error.legend(loc="best")
sheet.write(data["name"])
save(fig, data["name"])
