# SPDX-License-Identifier: BSD-3-Clause
"""Runs of one pursuit from starts near each other: how far apart their mean distances are."""
import os

import numpy as np

from vericone_figures.style import AGENT, GREY, ONE_COLUMN, folder, plt, save
from plot.tables import groups, rows

# The table stands beside the pictures' folder until all of them are there.
table = groups(rows(os.path.join(folder(), ".."), "starts.csv.partial"))[()]
mean = np.sort(table["mean_r"])
figure, axes = plt.subplots(figsize=(ONE_COLUMN, 2.3), constrained_layout=True)
axes.step(mean, np.arange(1, len(mean) + 1) / len(mean), where="post", color=AGENT)
axes.axvline(table["mean_r"][0], color=GREY, linestyle="--", label="the scenario's own start")
axes.set_xlabel("mean distance over the last two thirds [m]")
axes.set_ylabel("part of the starts")
axes.set_ylim(0, 1.02)
axes.legend(loc="best")
save(figure, "starts")
