# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Directions as pictures: distance to the first contact by colour, safe directions white."""
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LogNorm, Normalize
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from . import course as courses
from .kinds import Array, Axes, Data
from .style import EXACT

NEAR_TO_FAR = "viridis_r"


def masked(rows: Any) -> Array:
    return np.ma.masked_invalid(np.array([[np.nan if x is None else x for x in row] for row in rows]))  # type: ignore[no-untyped-call]


def norm_of(values: Any) -> Array:
    """Logarithmic where distances differ much."""
    seen = values.compressed()
    if not len(seen):
        return Normalize(0, 1)
    low, high = seen.min(), seen.max()
    return LogNorm(low, high) if 0 < 5 * low < high else Normalize(low, high)


def colour_bar(axes: Axes, image: Any) -> None:
    bar = plt.colorbar(image, ax=axes, shrink=0.85, pad=0.03)
    bar.set_label("distance to first contact (m)")
    if isinstance(image.norm, LogNorm):
        bar.ax.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        bar.ax.yaxis.set_major_formatter(FuncFormatter(lambda x, _: "%g" % x))
        bar.ax.yaxis.set_minor_formatter(NullFormatter())
    bar.ax.tick_params(labelsize=6)


def in_view(data: Data, direction: Array) -> Array:
    """Degrees to the right and up from the axis."""
    d = np.array(direction) / np.linalg.norm(direction)
    x, y = d @ np.array(data["view"]["right"]), d @ np.array(data["view"]["up"])
    away = np.degrees(np.arctan2(np.hypot(x, y), d @ np.array(data["axis"])))
    return away * np.array([x, y]) / max(np.hypot(x, y), 1e-12)


def along_axis(axes: Axes, data: Data) -> Any:
    """Around the axis: the angle from it is the distance from the middle, in degrees."""
    reach = np.degrees(data["view"]["reach"])
    values = masked(data["view"]["distances"])
    n = len(values)
    edge = reach * (1 + 1 / (n - 1))
    image = axes.imshow(values, origin="lower", extent=(-edge, edge, -edge, edge), cmap=NEAR_TO_FAR, norm=norm_of(values),
                        interpolation="nearest", zorder=1)
    edges = [in_view(data, d) for d in data["directions"] if d is not None]
    if edges:
        axes.plot(*np.array(edges + edges[:1]).T, ".-", color=EXACT, linewidth=0.7, markersize=2.2, zorder=3,
                  label="extreme directions, %d half-planes" % len(data["directions"]))
    if data["course"]:
        at = in_view(data, data["course"]["velocity"])
        if max(np.abs(at)) < edge:
            mark(axes, at, data["course"])
    axes.set_xlabel("from the axis, to the right (degrees)")
    axes.set_ylabel("from the axis, up (degrees)")
    axes.set_aspect("equal")
    return image


def mark(axes: Axes, at: Any, course: Data) -> None:
    """The scene's relative velocity among the directions."""
    axes.plot(*at, "o", color=courses.color(course), markersize=4.5, markeredgecolor="w", markeredgewidth=0.6, zorder=4,
              label="the scene's velocity: %s" % courses.word(course))
