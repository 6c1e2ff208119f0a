# SPDX-License-Identifier: BSD-3-Clause
"""Directions as pictures: distance to the first contact by colour, safe directions white."""
import numpy as np

from style import EXACT, plt

NEAR_TO_FAR = "viridis_r"


def masked(rows):
    return np.ma.masked_invalid(np.array([[np.nan if x is None else x for x in row] for row in rows]))


def colour_limits(values):
    """All but the farthest 2 %, which would leave the rest one colour."""
    seen = values.compressed()
    return (seen.min(), np.percentile(seen, 98)) if len(seen) else (0, 1)


def colour_bar(axes, image, values):
    low, high = colour_limits(values)
    bar = plt.colorbar(image, ax=axes, shrink=0.85, pad=0.03, extend="max" if values.max() > high else "neither")
    bar.set_label("distance to first contact (m)")
    bar.ax.tick_params(labelsize=6)
    return bar


def along_axis(axes, data):
    """Around the axis: the angle from it is the distance from the middle, in degrees."""
    reach = np.degrees(data["view"]["reach"])
    values = masked(data["view"]["distances"])
    low, high = colour_limits(values)
    n = len(values)
    edge = reach * (1 + 1 / (n - 1))
    image = axes.imshow(values, origin="lower", extent=(-edge, edge, -edge, edge), cmap=NEAR_TO_FAR, vmin=low, vmax=high,
                        interpolation="nearest", zorder=1)
    azimuth = np.array([x["azimuth"] for x in data["extremes"]])
    angle = np.degrees([np.nan if x["low"] is None else (x["low"] + x["high"]) / 2 for x in data["extremes"]])
    x, y = angle * np.sin(azimuth), angle * np.cos(azimuth)  # azimuths count from upwards
    axes.plot(np.append(x, x[0]), np.append(y, y[0]), ".-", color=EXACT, linewidth=0.7, markersize=2.2, zorder=3,
              label="extreme directions, %d half-planes" % len(azimuth))
    if data["velocity"]:
        w = np.array(data["velocity"]["w"])
        a, b, c = (w @ np.array(data[k]) / np.linalg.norm(w) for k in ("e1", "e2", "axis"))
        away = np.degrees(np.arccos(np.clip(c, -1, 1)))
        if away < edge:
            axes.plot(*(away * np.array([b, a]) / max(np.hypot(a, b), 1e-12)), "o", color="#c01f1f", markersize=4, zorder=4,
                      label="velocity: %s" % verdict(data["velocity"]))
    axes.set_xlabel("from the axis, to the right (degrees)")
    axes.set_ylabel("from the axis, up (degrees)")
    axes.set_aspect("equal")
    return image, values


def verdict(velocity):
    return {"in": "collides", "on": "grazes", "out": "passes"}[velocity["verdict"]]
