# SPDX-License-Identifier: BSD-3-Clause
"""Accuracy of slice and exact cones, from summary.json: random engagements, then scanned objects."""
import numpy as np

from vericone_figures.style import BOUND, EXACT, GREY, SLICE, TWO_COLUMNS, legend_below, plane_axis, plt, read, save


def column(rows, *keys):
    values = []
    for row in rows:
        for key in keys:
            row = row[key] if row is not None else None
        values.append(row)
    return np.array(values, dtype=float)


def random_engagements(data):
    slices, exact = data["slice"], data["exact"]
    planes, samples = column(slices, "planes"), column(exact, "samples")
    finest = data["finest_planes"]
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(TWO_COLUMNS, 3.3), constrained_layout=True)

    coarse = planes < finest
    left.plot(planes, 2 / planes, "--", color=GREY, label="2/n")
    left.plot(planes[coarse], column(slices, "discretisation_error", "worst")[coarse], "v-", color=SLICE, label="worst")
    left.plot(planes[coarse], column(slices, "discretisation_error", "median")[coarse], "o-", color=SLICE,
              markerfacecolor="white", label="median")
    left.set_yscale("log")
    left.set_ylabel("relative area error against n = %d" % finest)
    left.set_title("(a) slice: discretisation error")
    plane_axis(left, planes)
    legend_below(left)

    middle.plot(planes, 100 * column(slices, "error_against_true_cone", "worst"), "v-", color=SLICE, label="worst")
    middle.plot(planes, 100 * column(slices, "error_against_true_cone", "mean"), "o-", color=SLICE,
                markerfacecolor="white", label="mean")
    middle.axhline(100 * data["slice_bias"]["mean"], color=GREY, linestyle=":", linewidth=0.8)
    middle.set_ylim(0, 100)
    middle.set_ylabel("area of the true cone missing (%)")
    middle.set_title("(b) slice: bias")
    plane_axis(middle, planes)
    legend_below(middle)
    above = 100 * np.max(column(slices, "error_against_true_cone", "worst")) < 62
    inset = middle.inset_axes([0.45, 0.7 if above else 0.29, 0.5, 0.2])
    inset.hist(100 * np.array(data["slice_bias_values"]), bins=40, range=(0, 80), color=SLICE)
    inset.set_xlabel("missing at n = %d (%%)" % finest, fontsize=6, labelpad=1)
    inset.set_yticks([])
    inset.set_title("distribution", fontsize=6, pad=2)
    inset.tick_params(labelsize=6, pad=1)
    inset.grid(False)

    tiny = 1e-16  # below it is rounding
    right.plot(samples, column(exact, "certified_bound", "worst"), "v-", color=BOUND, label="bound, worst")
    right.plot(samples, column(exact, "certified_bound", "median"), "o-", color=BOUND, markerfacecolor="white",
               label="bound, median")
    right.plot(samples, np.maximum(column(exact, "error", "worst"), tiny), "v-", color=EXACT, label="error, worst")
    right.plot(samples, np.maximum(column(exact, "error", "median"), tiny), "o-", color=EXACT, markerfacecolor="white",
               label="error, median")
    right.set_xscale("log")
    right.set_yscale("log")
    right.set_xticks(samples)
    right.set_xticklabels(["%d" % m for m in samples])
    right.minorticks_off()
    right.set_xlabel("boundary samples m")
    right.set_ylabel("relative area error")
    right.set_title("(c) exact: error and bound")
    legend_below(right)
    figure.suptitle("%d %s" % (data["engagements"], data["drawn"]), fontsize=8)
    save(figure, "accuracy")


def scanned_objects(scans):
    figure, (left, right) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 1.3 + 0.24 * max(len(scans), 7)),
                                         constrained_layout=True, gridspec_kw={"width_ratios": [1.2, 1]})
    names = ["%s (%d points)" % (s["name"], s["points"]) for s in scans]
    values = [100 * np.array(s["slice_bias_values"]) for s in scans]
    positions = np.arange(len(scans))[::-1]
    left.boxplot(values, positions=positions, vert=False, widths=0.6, showfliers=True, whis=(5, 95),
                 medianprops={"color": SLICE}, flierprops={"markersize": 1.5, "markeredgecolor": GREY})
    left.set_yticks(positions)
    left.set_yticklabels(names)
    left.set_xlim(left=0)
    left.set_xlabel("area of the true cone missing (%)")
    left.set_title("slice bias at n = %d (box: quartiles, whiskers: 5, 95 %%)" % scans[0]["finest_planes"])
    for i, s in enumerate(scans):
        planes = column(s["slice"], "planes")
        coarse = planes < s["finest_planes"]
        right.plot(planes[coarse], column(s["slice"], "discretisation_error", "worst")[coarse], "-",
                   color=SLICE, linewidth=0.7, label="one line an object" if i == 0 else None)
    planes = column(scans[0]["slice"], "planes")
    right.plot(planes, 2 / planes, "--", color=GREY, label="2/n")
    right.set_yscale("log")
    right.set_ylabel("worst error against n = %d" % scans[0]["finest_planes"])
    right.set_title("slice: discretisation error")
    right.legend(loc="lower left")
    plane_axis(right, planes)
    figure.suptitle("Scanned objects in their minimum-volume ellipsoids, %d approaches of an ellipsoidal agent each"
                    % scans[0]["engagements"], fontsize=8)
    save(figure, "scans")


summary = read("summary.json")
random_engagements(summary["random"])
if summary.get("scans"):
    scanned_objects(summary["scans"])
