# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Common look of the figures: IEEE widths, fonts that are embedded as TrueType; colours mean the same in all of
them."""
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import matplotlib.pyplot as plt

ONE_COLUMN, TWO_COLUMNS = 3.5, 7.16  # inches
SLICE, EXACT, BOUND, AGENT, OBSTACLE, GREY = "#d1602b", "#1f6fb4", "#5aa3d9", "#3a8f4d", "#8d6bb0", "#6b6b6b"

LOOK: dict[str, Any] = {
    "pdf.fonttype": 42, "ps.fonttype": 42, "font.size": 8, "axes.labelsize": 8, "axes.titlesize": 8,
    "legend.fontsize": 7, "xtick.labelsize": 7, "ytick.labelsize": 7, "axes.grid": True, "grid.alpha": 0.3,
    "grid.linewidth": 0.5, "lines.linewidth": 1.2, "lines.markersize": 3.5, "savefig.dpi": 200,
}


@contextmanager
def style() -> Iterator[None]:
    """`with style():` what is drawn inside has this look; afterwards Matplotlib's settings are as before."""
    before = {name: plt.rcParams[name] for name in LOOK}
    plt.rcParams.update(LOOK)
    try:
        yield
    finally:
        plt.rcParams.update(before)
