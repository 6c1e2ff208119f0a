# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Answers around an exactly grazing velocity, one cell a double."""
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from .style import TWO_COLUMNS

ANSWERS = {"in": "#d1602b", "on": "#111111", "out": "#cfe0f0"}
RUNGS = {"triage": "#e8efe6", "interval": "#8fbf8a", "exact": "#2f6b3a"}


def sign_map(data: dict[str, Any], grids: dict[str, Any]) -> plt.Figure:
    """Plain doubles, the library, and the rung that decided: signmap.json, and for "naive", "library" and "rung" the
    indices into ANSWERS and RUNGS, of shape (cells, cells)."""
    n = data["cells"]
    half = n // 2
    figure, panels = plt.subplots(1, 3, figsize=(TWO_COLUMNS, 3.2), sharey=True, constrained_layout=True)
    titles = ("(a) plain double: wrong on %.1f %%" % (100 * data["naive_wrong"] / n ** 2), "(b) vericone: exact",
              "(c) rung that decided")
    for panel, name, words, title in zip(panels, grids, (ANSWERS, ANSWERS, RUNGS), titles):
        panel.imshow(grids[name], origin="lower", cmap=ListedColormap(list(words.values())), vmin=0, vmax=2,
                     extent=(-half - 0.5, half + 0.5, -half - 0.5, half + 0.5), interpolation="nearest")
        panel.set_title(title)
        panel.set_xlabel("ulps of $w_x$")
        panel.grid(False)
        panel.legend(handles=[Patch(facecolor=color, edgecolor="#6b6b6b", linewidth=0.4, label=word)
                              for word, color in words.items()],
                     loc="upper center", bbox_to_anchor=(0.5, -0.2), ncol=3, frameon=False, handlelength=1.2)
    panels[0].set_ylabel("ulps of $w_y$")
    # The exactly grazing velocity is one cell: a ring shows where.
    panels[1].plot(0, 0, "o", markersize=7, markerfacecolor="none", markeredgecolor="#111111", markeredgewidth=0.8)
    panels[1].annotate("grazes exactly", (0, 0), (0.58, 0.06), textcoords="axes fraction", fontsize=7,
                       arrowprops={"arrowstyle": "-", "linewidth": 0.5, "shrinkB": 4},
                       bbox={"facecolor": "white", "edgecolor": "none", "pad": 1, "alpha": 0.8})
    figure.suptitle("Relative velocity around $w$ = (%g, %g, %g) m/s, one cell a double; 1 ulp = %.2g m/s"
                    % (*data["velocity"], data["ulp"][0]), fontsize=8)
    return figure
