# SPDX-License-Identifier: BSD-3-Clause
"""y and psi on all planes logged, and on the plane of the largest opening."""
import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from vericone_figures.runs import Sheet, figure, first_run
from vericone_figures.style import GREY, TWO_COLUMNS, plt, save

data = figure()
run = first_run(data)
sheet = Sheet()
agent = run.agents()[0]
planes = {o: p for (a, o), p in run.planes().items() if a == agent}
panels = plt.figure(figsize=(TWO_COLUMNS, 4.2), constrained_layout=True).subplots(2, 1, sharex=True)
# Cyclic colours: a plane is the same after half a turn.
colors = plt.get_cmap("twilight_shifted")


def from_horizontal(e, p):
    """Azimuths of the planes logged, from the horizontal about the line of sight: those logged are from an axis that
    jumps where another coordinate of the line of sight becomes the least."""
    theta, phi = (np.interp(p["t"], e["t"], e[n]) for n in ("theta", "phi"))
    u = np.stack([np.cos(phi) * np.cos(theta), np.cos(phi) * np.sin(theta), np.sin(phi)], axis=1)
    first = np.cross(np.eye(3)[np.argmin(np.abs(u), axis=1)], u)
    first /= np.linalg.norm(first, axis=1)[:, None]
    level = np.stack([-np.sin(theta), np.cos(theta), 0 * theta], axis=1)
    return np.mod(p["azimuth"] + np.arctan2(np.sum(np.cross(level, first) * u, axis=1), np.sum(level * first, axis=1)),
                  np.pi)


for obstacle, logged in planes.items():
    shown = run.engaged(agent, obstacle, after=0)
    logged = {n: c[logged["t"] <= shown["t"][-1] + 1e-9] for n, c in logged.items()}
    azimuth = from_horizontal(run.encounters[agent, obstacle], logged)
    for angle in sorted(set(np.round(logged["azimuth"], 6))):
        rows = np.abs(logged["azimuth"] - angle) < 1e-5
        t, a = logged["t"][rows], azimuth[rows]
        # Half-turns do not matter, jumps of the logged axis do.
        jumps = np.abs(np.mod(np.diff(a) + np.pi / 2, np.pi) - np.pi / 2) > 0.05
        for part in np.split(np.arange(len(t)), np.nonzero(jumps | (np.diff(t) > 0.1))[0] + 1):
            if len(part) < 2:
                continue
            for axes, column, scale, panel in ((panels[0], "y", 1, "y"), (panels[1], "psi", 180 / np.pi, "psi [deg]")):
                middle = a[part[len(part) // 2]]
                sheet.line(axes, panel, "%s, plane at %.4g deg" % (obstacle, np.degrees(middle)), t[part],
                           scale * logged[column][rows][part], color=colors(middle / np.pi), linewidth=0.7)
    for axes, value in ((panels[0], shown["y"]), (panels[1], np.degrees(shown["psi"]))):
        axes.plot(shown["t"], value, color="k", linewidth=1.3, linestyle=(0, (3, 1.5)),
                  label="plane taken" if obstacle == list(planes)[0] else None)
    start = shown["t"][0]
    for axes in panels:
        axes.axvline(start, color=GREY, linewidth=0.6, linestyle=":")
    panels[0].annotate(obstacle, (start, 1), xycoords=("data", "axes fraction"), xytext=(3, -9),
                       textcoords="offset points", fontsize=8)
panels[0].axhline(0, color="k", linewidth=0.6)
panels[0].set_ylabel("y [1]")
panels[1].set_ylabel("ψ [deg]")
panels[1].set_xlabel("t [s]")
panels[1].legend(loc="upper left")
bar = panels[0].figure.colorbar(ScalarMappable(Normalize(0, 180), colors), ax=panels, pad=0.01)
bar.set_label("azimuth of the plane from the horizontal [deg]")
bar.set_ticks([0, 45, 90, 135, 180])
if run.idle_note():
    panels[0].figure.suptitle(run.idle_note(), fontsize=7, color=GREY)
sheet.write(data["name"])
save(panels[0].figure, data["name"])
