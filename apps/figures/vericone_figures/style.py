# SPDX-License-Identifier: BSD-3-Clause
"""What every script does with its folder: read the data, save PDF and PNG side by side. No screen is needed."""
import json
import os
import sys

os.environ.setdefault("SOURCE_DATE_EPOCH", "0")  # the same data give the same bytes
import matplotlib  # noqa: E402

matplotlib.use("Agg")
from plot.style import (AGENT, BOUND, EXACT, GREY, LOOK, OBSTACLE, ONE_COLUMN, SLICE, TWO_COLUMNS,  # noqa: E402, F401
                        plt)

plt.rcParams.update(LOOK)


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


def legend_below(axes):
    """The legend under the axis, where no curve is."""
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.22), ncol=2, fontsize=6, handlelength=1.6, columnspacing=1,
                frameon=False)


def save(figure, name):
    for extension in ("pdf", "png"):
        path = os.path.join(folder(), name + "." + extension)
        figure.savefig(path)
        print("picture " + path)
    plt.close(figure)
