# SPDX-License-Identifier: BSD-3-Clause
"""Figs 6.9 and 6.15: y and psi on all planes logged, and on the plane of the largest opening."""
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from runs import Sheet, figure
from style import GREY, TWO_COLUMNS, plt, save

data = figure()
run = data["runs"]["source"]
sheet = Sheet()
agent = run.agents()[0]
planes = {o: p for (a, o), p in run.planes().items() if a == agent}
panels = plt.figure(figsize=(TWO_COLUMNS, 4.2), constrained_layout=True).subplots(2, 1, sharex=True)
# Planes turn with the line of sight: they are told apart by their number among those at equal angles.
colors = plt.get_cmap("twilight")
for obstacle, all_planes in planes.items():
    shown = run.engaged(agent, obstacle)
    end = shown["t [s]"][-1]
    azimuth = np.mod(all_planes["azimuth [rad]"], np.pi)
    for angle in sorted(set(np.round(azimuth, 6))):
        rows = (np.abs(azimuth - angle) < 1e-5) & (all_planes["t [s]"] <= end)
        t = all_planes["t [s]"][rows]
        for axes, column, scale, panel in ((panels[0], "y", 1, "y"), (panels[1], "psi [rad]", 180 / np.pi, "psi [deg]")):
            value = scale * all_planes[column][rows]
            gap = np.nonzero(np.diff(t) > 1.5 * np.median(np.diff(t)))[0] + 1 if len(t) > 2 else []
            sheet.line(axes, panel, "%s, plane at %.4g deg" % (obstacle, np.degrees(angle)), np.insert(t, gap, np.nan),
                       np.insert(value, gap, np.nan), color=colors(angle / np.pi), linewidth=0.6)
    for axes, value in ((panels[0], shown["y"]), (panels[1], np.degrees(shown["psi [rad]"]))):
        axes.plot(shown["t [s]"], value, color="k", linewidth=1.4, linestyle=(0, (4, 1.2)),
                  label="plane of the largest ψ" if obstacle == list(planes)[0] else None)
    start = shown["t [s]"][0]
    for axes in panels:
        axes.axvline(start, color=GREY, linewidth=0.6, linestyle=":")
    panels[0].annotate(obstacle, (start, 1), xycoords=("data", "axes fraction"), xytext=(3, -9),
                       textcoords="offset points", fontsize=8)
panels[0].axhline(0, color="k", linewidth=0.6)
panels[0].set_ylabel("y [1]")
panels[1].set_ylabel("ψ [deg]")
panels[1].set_xlabel("t [s]")
panels[1].legend(loc="best")
bar = panels[0].figure.colorbar(ScalarMappable(Normalize(0, 180), colors), ax=panels, pad=0.01)
bar.set_label("azimuth of the plane about the line of sight [deg]")
bar.set_ticks([0, 45, 90, 135, 180])
sheet.write(data["name"])
save(panels[0].figure, data["name"])
