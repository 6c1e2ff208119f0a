# SPDX-License-Identifier: BSD-3-Clause
"""The same two orifices in several attitudes, from above: the ways of the agent, the rims when they are passed."""
import numpy as np

from plot.orifices import RIM, orifices
from vericone_figures.runs import Sheet, figure
from vericone_figures.style import AGENT, TWO_COLUMNS, plt, save

data = figure()
sheet = Sheet()
drawn = plt.figure(figsize=(TWO_COLUMNS, 2.6), constrained_layout=True).subplots(1, len(data["runs"]), sharex=True, sharey=True)
for axes, (role, run) in zip(np.atleast_1d(drawn), data["runs"].items()):
    for name, body in run.bodies.items():
        sheet.line(axes, role, "way of " + name, body["x"], body["y"], color=AGENT, linewidth=1.2)
        axes.plot(body["x"][0], body["y"][0], "o", color=AGENT, markersize=3)
    for orifice in orifices(run.folder):
        passage = next(p for p in run.proof()["passages"] if p["orifice"] == orifice.name)
        rim = orifice.rim(passage["time"] if passage["time"] is not None else orifice.appears)
        sheet.line(axes, role, "rim of " + orifice.name, rim[:, 0], rim[:, 1], color=RIM, linewidth=1.4)
        middle = rim.mean(axis=0)
        says = "%s: %.3g s,\n%.2f m from the rim" % (orifice.name, passage["time"], passage["least_distance"]) \
            if passage["verdict"] == "passed" else "%s: %s" % (orifice.name, passage["verdict"])
        axes.annotate(says, middle[:2], fontsize=6, xytext=(0, 26), textcoords="offset points", ha="center")
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlabel("x [m]")
    axes.set_title(role, fontsize=7)
    axes.set_xlim(-5.5, 6.5)
    axes.set_ylim(-3.5, 4.5)
np.atleast_1d(drawn)[0].set_ylabel("y [m]")
sheet.write(data["name"])
save(np.atleast_1d(drawn)[0].figure, data["name"])
