# SPDX-License-Identifier: BSD-3-Clause
"""Shares of trials proved avoided, by law and noise, each with the interval that holds the true share."""
import numpy as np

from vericone_figures.style import AGENT, BOUND, EXACT, GREY, OBSTACLE, SLICE, TWO_COLUMNS, plt, read, save

COLORS = {"di": SLICE, "di-filter": "#e8b04a", "rdi": BOUND, "rdi-filter": EXACT, "di-rates": "#b07a2e",
          "di-analytic": "#7fb58a", "di-state": AGENT, "di-margin": "#245c31", "clearance": OBSTACLE, "robust": "#b3202a"}
FOOT = 1.5  # of a bar, below 0

data = read("trials.json")
shares = data["shares"]
levels = list(dict.fromkeys(s["level"] for s in shares))
laws = list(dict.fromkeys(s["law"] for s in shares))


def words(level):
    if level.startswith("x"):
        return "sensor " + level.replace("x", "× ")
    position, velocity = level.split(":")
    return "position %s %%,\nvelocity %s %%" % (position, velocity)


figure, axis = plt.subplots(figsize=(TWO_COLUMNS, 2.9))
width = 0.8 / len(laws)
for i, law in enumerate(laws):
    mine = [next(s for s in shares if s["level"] == level and s["law"] == law) for level in levels]
    x = np.arange(len(levels)) + (i - 0.5 * (len(laws) - 1)) * width
    share = np.array([100 * s["share"] for s in mine])
    low, high = (np.array([100 * s[key] for s in mine]) for key in ("low", "high"))
    # From below 0: a share of 0 is a bar that is seen.
    axis.bar(x, share + FOOT, bottom=-FOOT, width=0.92 * width, color=COLORS.get(law, GREY), label=law)
    axis.errorbar(x, share, yerr=[share - low, high - share], fmt="none", ecolor="black", elinewidth=0.7, capsize=1.5)
    for at, top, value in zip(x, high, share):
        axis.text(at, top + 1.5, "%.0f" % value if value in (0, 100) else "%.1f" % value, ha="center", va="bottom", fontsize=5.5,
                  rotation=90 if len(laws) * len(levels) > 15 else 0)
axis.set_xticks(range(len(levels)))
axis.set_xticklabels([words(level) for level in levels])
axis.set_ylim(-FOOT, 118)
axis.set_yticks(range(0, 101, 20))
axis.set_ylabel("trials proved avoided [%]")
axis.set_xlabel("noise of the measured position and velocity" if ":" in levels[0] else "noise")
axis.grid(axis="x", visible=False)
axis.legend(ncol=min(len(laws), 5), frameon=False, loc="upper left", bbox_to_anchor=(0, 1.22), fontsize=6.5)
axis.set_title("%s, %d trials each" % (data["scenario"], data["trials"]), loc="right", fontsize=7, pad=3)
figure.tight_layout()
save(figure, "trials")
