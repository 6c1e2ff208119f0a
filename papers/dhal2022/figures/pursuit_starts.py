# SPDX-License-Identifier: BSD-3-Clause
"""Mean distances of pursuits from starts within 1 mm, by scenario and law."""
import numpy as np

from vericone_figures.runs import Sheet, figure
from vericone_figures.style import AGENT, SLICE, TWO_COLUMNS, plt, save
from plot.tables import groups, rows

data = figure()
tables = {role: groups(rows(folder, "starts.csv"))[()] for role, folder in data["data"].items()}
sections = list(dict.fromkeys(role.split()[0] for role in tables))
sheet = Sheet()
fig, drawn = plt.subplots(1, len(sections), figsize=(TWO_COLUMNS, 2.3), constrained_layout=True, sharey=True)
for axes, section in zip(drawn, sections):
    for law, color in (("source", SLICE), ("ours", AGENT)):
        mean = np.sort(np.maximum(tables[section + " " + law]["mean_r"], 1e-4))
        share = np.arange(1, len(mean) + 1) / len(mean)
        axes.step(np.concatenate([mean[:1], mean]), np.concatenate([[0], share]), where="post", color=color,
                  label={"source": "the source's law", "ours": "ours"}[law])
        sheet.add(section, law, mean, share)
    axes.set_xscale("log")
    axes.set_xlim(1e-4, 30)
    axes.set_xlabel("mean distance, %s [m], 0.0001 at least" % section)
    axes.set_ylim(0, 1.02)
    axes.legend(loc="best")
drawn[0].set_ylabel("part of 40 starts")
sheet.write(data["name"])
save(fig, data["name"])
