# SPDX-License-Identifier: BSD-3-Clause
"""Runs with one vehicle hidden: how soon it is said, and how soon the vehicle is found again."""
import os

import numpy as np

from vericone_figures.style import AGENT, SLICE, TWO_COLUMNS, folder, plt, save
from plot.tables import groups, rows

# The table stands beside the pictures' folder until all of them are there.
table = groups(rows(os.path.join(folder(), ".."), "occlusions.csv.partial"))[()]
count = len(table["run"])
figure, (said, found) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 2.2), constrained_layout=True, sharey=True)
for axes, name, color, label in ((said, "said", SLICE, "until total is said [s]"),
                                 (found, "regained", AGENT, "from when it is seen again until it is found [s]")):
    values = np.asarray(table[name], float)
    known = np.sort(values[~np.isnan(values)])
    axes.step(np.concatenate([[0], known]), np.arange(len(known) + 1) / count, where="post", color=color)
    axes.set_xlabel(label)
    axes.set_ylim(0, 1.02)
said.set_ylabel("part of the runs")
save(figure, "occlusions")
