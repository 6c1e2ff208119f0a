# SPDX-License-Identifier: BSD-3-Clause
"""Box plots of the times of one picture, beside the source's means."""
from vericone_figures.runs import Sheet, figure
from vericone_figures.style import EXACT, SLICE, TWO_COLUMNS, plt, save
from plot.tables import groups, rows

data = figure()
times = groups(rows(data["data"]["run"], "times.csv"))[()]
PARTS = {"controller": r"$Δt_C$", "ellipse": r"$Δt_E$", "filter": r"$Δt_F$", "tracker": r"$Δt_T$", "total": r"$Δt_Σ$"}
sheet = Sheet()
fig, axes = plt.subplots(figsize=(0.75 * TWO_COLUMNS, 2.6), constrained_layout=True)
for i, (part, name) in enumerate(PARTS.items()):
    values = times[part][1:]  # the first picture starts the tracker
    axes.boxplot([values], positions=[i], widths=0.5, whis=(1, 99), showfliers=False, medianprops={"color": EXACT})
    axes.plot([i - 0.35, i + 0.35], [data[part]] * 2, color=SLICE, linestyle="--",
              label="the source's mean, on its machine" if i == 0 else None)
    sheet.add("time [ms]", part, times["t"][1:], values)
axes.set_yscale("log")
axes.set_xticks(range(len(PARTS)))
axes.set_xticklabels(["%s\n%s" % (name, part) for part, name in PARTS.items()])
axes.set_ylabel("time of a picture [ms]")
axes.legend(loc="upper left")
sheet.write(data["name"])
save(fig, data["name"])
