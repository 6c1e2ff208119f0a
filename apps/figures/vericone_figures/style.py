# SPDX-License-Identifier: BSD-3-Clause
"""Common look of the figures: IEEE widths, embedded TrueType fonts, PDF and PNG side by side."""
import json
import os
import sys

os.environ.setdefault("SOURCE_DATE_EPOCH", "0")  # the same data give the same bytes
import matplotlib  # noqa: E402

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

ONE_COLUMN, TWO_COLUMNS = 3.5, 7.16  # inches
SLICE, EXACT, BOUND, AGENT, OBSTACLE, GREY = "#d1602b", "#1f6fb4", "#5aa3d9", "#3a8f4d", "#8d6bb0", "#6b6b6b"

plt.rcParams.update({
    "pdf.fonttype": 42, "ps.fonttype": 42, "font.size": 8, "axes.labelsize": 8, "axes.titlesize": 8,
    "legend.fontsize": 7, "xtick.labelsize": 7, "ytick.labelsize": 7, "axes.grid": True, "grid.alpha": 0.3,
    "grid.linewidth": 0.5, "lines.linewidth": 1.2, "lines.markersize": 3.5, "savefig.dpi": 200,
})


def folder():
    if len(sys.argv) != 2:
        sys.exit("usage: %s FOLDER" % os.path.basename(sys.argv[0]))
    return sys.argv[1]


def read(name):
    with open(os.path.join(folder(), name)) as f:
        return json.load(f)


def plane_axis(axis, planes):
    axis.set_xscale("log")
    shown = sorted(int(n) for n in planes)
    if len(shown) > 8:  # too many for numbers side by side
        shown = [n for n in (3, 6, 12, 24, 60, 180, 360) if shown[0] <= n <= shown[-1]]
    axis.set_xticks(shown)
    axis.set_xticklabels([str(n) for n in shown])
    axis.minorticks_off()
    axis.set_xlabel("planes n")


def save(figure, name):
    for extension in ("pdf", "png"):
        path = os.path.join(folder(), name + "." + extension)
        figure.savefig(path)
        print("picture " + path)
    plt.close(figure)
