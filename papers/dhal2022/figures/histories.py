# SPDX-License-Identifier: BSD-3-Clause
"""Quantities against time, one panel each; figure.json says which: Figs 5.7-5.9, 5.12, 6.10-6.13, 6.16-6.19."""
import numpy as np

from runs import Sheet, figure, idle_note
from style import GREY, ONE_COLUMN, TWO_COLUMNS, plt, save

data = figure()
run = data["runs"]["source"]
sheet = Sheet()
agent = run.agents()[0]
piloted = [b for b in run.bodies if b == agent or b in data.get("partners", [])]
dashes = {b: "-" if i == 0 else (0, (4, 1.2)) for i, b in enumerate(piloted)}


def of_bodies(axes, panel, value, names=piloted):
    for name in names:
        b = run.bodies[name]
        sheet.line(axes, panel, name, b["t [s]"], value(b), color=run.color(name), linestyle=dashes.get(name, "-"),
                   label=name)


def of_encounters(axes, panel, value, zero=False):
    for (pilot, obstacle) in run.encounters:
        if pilot != agent:
            continue
        e = run.engaged(pilot, obstacle)
        if not np.isfinite(value(e)).any():  # never in sight of a cone
            continue
        sheet.line(axes, panel, obstacle, e["t [s]"], value(e), color=run.color(obstacle), label=obstacle)
    if zero:
        axes.axhline(0, color="k", linewidth=0.6)


def commanded(b, angle):
    """An angle of the acceleration, where there is one."""
    return np.where(b["a [m/s^2]"] > 1e-9, np.degrees(angle), np.nan)


def azimuth(b):
    return commanded(b, np.arctan2(b["ay [m/s^2]"], b["ax [m/s^2]"]))


def elevation(b):
    return commanded(b, np.arctan2(b["az [m/s^2]"], np.hypot(b["ax [m/s^2]"], b["ay [m/s^2]"])))


PANELS = {
    "lateral": ("lateral $a$ of %s [m/s²]" % agent,
                lambda x, p: of_bodies(x, p, lambda b: b["lateral [m/s^2]"])),
    "heading": ("heading of %s [deg]" % agent, lambda x, p: of_bodies(x, p, lambda b: np.degrees(b["azimuth [rad]"]))),
    "psi": ("ψ [deg]", lambda x, p: of_encounters(x, p, lambda e: np.degrees(e["psi [rad]"]))),
    "y": ("y [1]", lambda x, p: of_encounters(x, p, lambda e: e["y"], zero=True)),
    "V_r": ("$V_r$ [m/s]", lambda x, p: of_encounters(x, p, lambda e: e["V_r [m/s]"], zero=True)),
    "V_theta": ("$V_θ$ [m/s]", lambda x, p: of_encounters(x, p, lambda e: e["V_theta [m/s]"], zero=True)),
    "V_phi": ("$V_φ$ [m/s]", lambda x, p: of_encounters(x, p, lambda e: e["V_phi [m/s]"], zero=True)),
    "acceleration": ("|a| [m/s²]", lambda x, p: of_bodies(x, p, lambda b: b["a [m/s^2]"])),
    "delta": ("δ, azimuth of a [deg]", lambda x, p: of_bodies(x, p, azimuth)),
    "gamma": ("γ, elevation of a [deg]", lambda x, p: of_bodies(x, p, elevation)),
    "azimuth": ("azimuth of heading [deg]", lambda x, p: of_bodies(x, p, lambda b: np.degrees(b["azimuth [rad]"]))),
    "elevation": ("elevation of heading [deg]",
                  lambda x, p: of_bodies(x, p, lambda b: np.degrees(b["elevation [rad]"]))),
}

names = data["panels"]
width = TWO_COLUMNS if len(names) > 2 else ONE_COLUMN
rows, columns = (1, len(names)) if len(names) == 3 else (len(names), 1)
panels = plt.figure(figsize=(width, 2.3 if rows == 1 else 0.4 + 1.7 * rows), constrained_layout=True).subplots(
    rows, columns, sharex=True, squeeze=False).ravel()
for axes, name in zip(panels, names):
    label, draw = PANELS[name]
    draw(axes, label)
    axes.set_ylabel(label)
    low, high = axes.get_ylim()
    if high - low < 1 and name not in ("y", "lateral", "acceleration"):  # constant up to rounding: no magnified noise
        axes.set_ylim(low - 1, high + 1)
if len(panels[0].get_legend_handles_labels()[0]) > 1:  # colours are the same in all panels
    panels[0].legend(loc="best")
note = idle_note(run, agent)
if note:
    panels[0].figure.suptitle(note, fontsize=7, color=GREY)
starts = [b["t [s]"][0] for b in run.bodies.values()]
end = data.get("until", max(b["t [s]"][-1] for b in run.bodies.values()))
for axes in panels:
    for t in sorted(set(starts)):
        if t > 0:
            axes.axvline(t, color=GREY, linewidth=0.6, linestyle=":")
    axes.set_xlim(0, end)
for axes in panels if rows == 1 else panels[-1:]:
    axes.set_xlabel("t [s]")
sheet.write(data["name"])
save(panels[0].figure, data["name"])
