# SPDX-License-Identifier: BSD-3-Clause
"""Slice cones of combined quadrics against planes, held against certified inner and outer cones (summary.json)."""
import numpy as np

from vericone_figures.style import (BOUND, EXACT, GREY, SLICE, TWO_COLUMNS, legend_below, plane_axis, plt, read,
                                    save)

data = read("summary.json")["random"]
slices = data["slice"]
planes = np.array([row["planes"] for row in slices])
finest = data["finest_planes"]


figure, (left, middle, right) = plt.subplots(1, 3, figsize=(TWO_COLUMNS, 3.3), constrained_layout=True)

coarse = planes < finest
left.plot(planes, 2 / planes, "--", color=GREY, label="2/n")
for measure, style in (("worst", {}), ("median", {"markerfacecolor": "white"})):
    values = np.array([row["discretisation_error"][measure] for row in slices if row["planes"] < finest])
    left.plot(planes[coarse], values, "v-" if measure == "worst" else "o-", color=SLICE, label=measure, **style)
left.set_yscale("log")
left.set_ylabel("relative area error against n = %d" % finest)
left.set_title("(a) discretisation error")
legend_below(left)
plane_axis(left, planes)

for measure, colour in (("worst", SLICE), ("mean", EXACT)):
    bounds = 100 * np.array([row["error_against_true_cone"][measure] for row in slices])
    middle.fill_between(planes, bounds[:, 0], bounds[:, 1], color=colour, alpha=0.35, linewidth=0)
    for k in (0, 1):
        middle.plot(planes, bounds[:, k], "-", color=colour, linewidth=0.8, label=measure if k else None)
middle.axhline(0, color=GREY, linewidth=0.6)
middle.set_ylim(top=100)
middle.set_ylabel("area of the true cone missing (%)")
middle.set_title("(b) bias: proved between")
legend_below(middle)
plane_axis(middle, planes)

values = 100 * np.array(data["slice_bias_values"])
values = values[np.argsort(values.mean(axis=1))]
rank = np.arange(len(values)) / max(len(values) - 1, 1) * 100
right.fill_between(rank, values[:, 0], values[:, 1], color=BOUND, linewidth=0, label="proved between")
right.axhline(0, color=GREY, linewidth=0.6)
right.set_xlabel("engagements, by bias (%)")
right.set_ylabel("area missing at n = %d (%%)" % finest)
right.set_title("(c) bias of each engagement")
legend_below(right)
right.set_xlim(0, 100)

figure.suptitle("%d random engagements of an ellipsoid with a %s obstacle\n%s; reference certified to %g %%"
                % (data["engagements"], data["obstacle"], data["drawn"], 100 * data["tolerance"]), fontsize=8)
save(figure, "accuracy")
