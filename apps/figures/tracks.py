# SPDX-License-Identifier: BSD-3-Clause
"""The tracks of targets over the first picture, from tracks.csv and first_picture.png."""
import csv
import os

from vericone_figures.style import TWO_COLUMNS, folder, plt, save

COLOURS = ("#e6550d", "#3182bd", "#31a354", "#756bb1", "#de2d26", "#1c9099", "#fdae6b", "#9ecae1")

with open(os.path.join(folder(), "tracks.csv"), encoding="utf-8") as f:
    rows = list(csv.DictReader(f))
picture = plt.imread(os.path.join(folder(), "first_picture.png"))
high, wide = picture.shape[:2]
figure, axis = plt.subplots(figsize=(TWO_COLUMNS, max(2.5, TWO_COLUMNS * high / wide)))
axis.imshow(picture, extent=(-0.5, wide - 0.5, high - 0.5, -0.5), cmap="gray")
for k, target in enumerate(sorted({row["target"] for row in rows}, key=int)):
    own = [row for row in rows if row["target"] == target]
    u = [float(row["x"]) + 0.5 * float(row["w"]) for row in own]
    v = [float(row["y"]) + 0.5 * float(row["h"]) for row in own]
    seen = [row["state"] in ("no_occlusion", "partial") for row in own]
    colour = COLOURS[k % len(COLOURS)]
    axis.plot([a if s else float("nan") for a, s in zip(u, seen)], [b if s else float("nan") for b, s in zip(v, seen)], color=colour,
              label="target %s: measured" % target)
    if not all(seen):
        axis.plot([float("nan") if s else a for a, s in zip(u, seen)], [float("nan") if s else b for b, s in zip(v, seen)], ":",
                  color=colour, label="expected")
    axis.plot(u[:1], v[:1], "o", color=colour, markeredgecolor="white")
axis.set_xlim(-0.5, wide - 0.5)
axis.set_ylim(high - 0.5, -0.5)
axis.grid(False)
axis.set_xlabel("u (px)")
axis.set_ylabel("v (px)")
axis.legend(loc="best", fontsize=6)
figure.tight_layout(pad=0.4)
save(figure, "tracks")
