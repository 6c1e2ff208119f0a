# SPDX-License-Identifier: BSD-3-Clause
"""Curves in panels, as figures.yaml says; their points come with them. Colours of bodies are the same in all figures of a
run."""
import numpy as np

from vericone_figures.runs import COLORS, Sheet, figure, first_run
from vericone_figures.style import AGENT, GREY, ONE_COLUMN, TWO_COLUMNS, plt, save

data = figure()
run = first_run(data) if data["runs"] else None
sheet = Sheet()
panels, count = data["panels"], len(data["panels"])
over_time = all("x_label" not in p for p in panels)
width = TWO_COLUMNS if data.get("columns", 2 if count > 2 or (count == 2 and not over_time) else 1) == 2 else ONE_COLUMN
beside = count == 3 or not over_time
rows, columns = (1, count) if beside else (count, 1)
if over_time:
    height = 2.3 if rows == 1 else 0.4 + 1.7 * rows
else:
    height = min(0.85 * width / columns + 0.3, 5)
drawn = plt.figure(figsize=(width, height), constrained_layout=True).subplots(
    rows, columns, sharex=over_time, squeeze=False).ravel()


def numbers(values):
    return np.array([np.nan if v is None else v for v in values])


keys = {}  # what has which colour, behind those of the bodies: the same thing has the same one in all panels
taken = max(len(run.bodies) - 1, 0) if run is not None else 0


def color_of(line, alone):
    if run is not None and line["body"] in run.bodies:
        return run.color(line["body"])
    if line["filled"]:
        return GREY
    if line["name"] == "UAS":
        return AGENT
    if alone and not line["body"]:
        return COLORS[0]
    return keys.setdefault(line["body"] or line["name"], COLORS[(taken + len(keys)) % len(COLORS)])


for axes, panel in zip(drawn, panels):
    for line in panel["lines"]:
        color = color_of(line, len(panel["lines"]) == 1)
        x, y = numbers(line["x"]), numbers(line["y"])
        if line["filled"]:
            axes.fill(x, y, facecolor=color, alpha=0.2, label=line["name"])
            sheet.add(panel["label"], line["name"], x, y)
        else:
            sheet.line(axes, panel["label"], line["name"], x, y, color=color, label=line["name"],
                       linestyle=(0, (4, 1.2)) if line["dashed"] else "-")
    if panel.get("zero"):
        axes.axhline(0, color="k", linewidth=0.6)
    if panel.get("symlog"):
        axes.set_yscale("symlog", linthresh=panel["symlog"])
        axes.yaxis.get_major_locator().set_params(numticks=7)
    axes.set_ylabel(panel["label"])
    low, high = axes.get_ylim()
    least = panel.get("least_height", 0)
    if high - low < least:  # constant up to rounding: no magnified noise
        axes.set_ylim(low - least, high + least)
    if panel.get("equal"):
        axes.set_aspect("equal", adjustable="datalim")
    if not over_time:
        axes.set_xlabel(panel.get("x_label", "t [s]"))
told = set()  # colours are the same in all panels: a name is explained once
for axes, panel in zip(drawn, panels):
    handles, labels = axes.get_legend_handles_labels()
    new = [(h, n) for h, n in zip(handles, labels) if n not in told]
    told.update(labels)
    if len(labels) < 2 or not new:
        continue
    if over_time and len(labels) > 4:  # more than fits beside the curves
        axes.legend(*zip(*new), loc="lower left", bbox_to_anchor=(0, 1), ncol=4, frameon=False, fontsize=6)
    elif not over_time and len(labels) > 3:
        axes.legend(*zip(*new), loc="lower left", bbox_to_anchor=(0, 1), ncol=3, frameon=False, fontsize=6)
    else:
        axes.legend(*zip(*new), loc="best")
if over_time:
    for axes in drawn if rows == 1 else drawn[-1:]:
        axes.set_xlabel("t [s]")
if run is not None and run.idle_note():
    drawn[0].figure.suptitle(run.idle_note(), fontsize=7, color=GREY)
if run is not None and over_time:
    for axes in drawn:
        for t in sorted({b["t"][0] for b in run.bodies.values()}):
            if t > 0:
                axes.axvline(t, color=GREY, linewidth=0.6, linestyle=":")
        axes.set_xlim(0, max(b["t"][-1] for b in run.bodies.values()))
sheet.write(data["name"])
save(drawn[0].figure, data["name"])
