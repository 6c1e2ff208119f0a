# SPDX-License-Identifier: BSD-3-Clause
"""A campaign of guidance laws: what became of the engagements under each law, and the least distances."""
import numpy as np

from vericone_figures.style import BOUND, EXACT, GREY, OBSTACLE, SLICE, TWO_COLUMNS, plt, read, save

data = read("summary.json")
total, straight, laws = data["engagements"], data["straight"], data["laws"]
COLORS = {"slice": SLICE, "exact": EXACT, "motion": BOUND, "clearance": OBSTACLE}
TITLES = {"slice": "slice sector", "exact": "true sector", "motion": "true sector,\nplane of motion", "clearance": "clearance"}
PARTS = [("avoided", "avoided, proved", "#7fb58a"), ("undecided", "undecided", "#c9c9c9"),
         ("infeasible", "met, not called safe", "#e8b04a"),
         ("called_safe_and_met", "met after the law called it safe (number)", "#b3202a")]


def kind(law):
    return law["name"].rsplit("-", 1)[0]


limits = list(dict.fromkeys(law["most"] for law in laws))
figure = plt.figure(figsize=(TWO_COLUMNS, 3.5))
bars = figure.add_axes([0.08, 0.25, 0.46, 0.54])
labels, positions = ["straight\non"], [0.0]
rows = [{"avoided": straight["avoided"], "undecided": straight["undecided"], "infeasible": straight["met"],
         "called_safe_and_met": 0}]
position = 1.5
for most in limits:
    for law in laws:
        if law["most"] == most:
            labels.append(TITLES[kind(law)])
            positions.append(position)
            rows.append(law)
            position += 1
    position += 0.5
bottom = np.zeros(len(rows))
for key, label, color in PARTS:
    share = np.array([100 * row[key] / total for row in rows])
    bars.bar(positions, share, bottom=bottom, width=0.8, color=color, label=label)
    bottom += share
for x, row in zip(positions[1:], rows[1:]):
    bars.text(x, 101, "%d" % row["called_safe_and_met"], ha="center", va="bottom", fontsize=6,
              color="#b3202a" if row["called_safe_and_met"] else GREY)
bars.set_xticks(positions)
bars.set_xticklabels(labels, rotation=60, ha="right", rotation_mode="anchor", fontsize=6)
bars.set_ylim(0, 108)
bars.set_yticks(range(0, 101, 20))
bars.set_ylabel("engagements (%)")
bars.grid(axis="x", visible=False)
for most in limits:
    at = [x for x, row in zip(positions[1:], rows[1:]) if row["most"] == most]
    bars.text(np.mean(at), 110, "at most %g m/s²" % most, ha="center", fontsize=7)
figure.legend(*bars.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(0.06, 1.0), ncol=2, frameon=False,
              fontsize=6.5, columnspacing=1)

edges = data["bin"] * np.arange(len(laws[0]["least_distances"]))
panels = [figure.add_axes([0.63, 0.57, 0.36, 0.3]), figure.add_axes([0.63, 0.13, 0.36, 0.3])]
for axis, most in zip(panels, limits):
    for law in laws:
        if law["most"] == most:
            axis.step(edges, law["least_distances"], where="post", color=COLORS[kind(law)],
                      label=TITLES[kind(law)].replace("\n", " "), linewidth=1)
    axis.set_title("at most %g m/s²" % most, fontsize=7, pad=3)
    axis.set_ylabel("engagements\nper %g m" % data["bin"])
    axis.set_xlim(0, 8)
    axis.set_yscale("log")
panels[0].legend(frameon=False, fontsize=6)
panels[-1].set_xlabel("least distance between the bodies, avoided (m)")
figure.text(0.99, 0.985, "%s engagements, %.1f %% meet straight on" % ("{:,}".format(total), 100 * straight["met"] / total),
            ha="right", va="top", fontsize=7)
save(figure, "campaign")
