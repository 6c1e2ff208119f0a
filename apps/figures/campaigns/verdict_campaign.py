# SPDX-License-Identifier: BSD-3-Clause
"""The share of a population that collides, as the campaign grew, with its interval."""
import numpy as np

from vericone_figures.style import AGENT, GREY, ONE_COLUMN, plt, read, save

data = read("summary.json")
growth = data["growth"]
count, share, low, high = (np.array([point[key] for point in growth]) for key in ("encounters", "share", "low", "high"))
seen = share > 0

figure, axis = plt.subplots(figsize=(ONE_COLUMN, 2.4))
floor = 0.5 * np.min(low[low > 0]) if np.any(low > 0) else 0.1 * high[-1]
axis.fill_between(count, np.maximum(low, floor), high, color=AGENT, alpha=0.25, linewidth=0,
                  label="95 %% interval (%s)" % data["interval"])
axis.plot(count[seen], share[seen], color=AGENT, linewidth=1, label="share")
axis.axhline(max(data["share"], floor), color=GREY, linewidth=0.6, linestyle=":")
axis.set_xscale("log")
axis.set_yscale("log")
axis.set_xlabel("encounters")
axis.set_ylabel("share that collides")
axis.legend(frameon=False, fontsize=6.5)
axis.set_title("%s: %.3g, between %.3g and %.3g" % (data["population"], data["share"], data["low"], data["high"]), fontsize=7)
figure.tight_layout()
save(figure, "share")
