# SPDX-License-Identifier: BSD-3-Clause
"""How the cone from simulated LiDARs converges with the number of beams, from scan.json or several scan-NAME.json: to the
cone of what they can see, and what of the true cone that misses."""
import glob
import os

import numpy as np

from vericone_figures.style import EXACT, GREY, SLICE, AGENT, OBSTACLE, TWO_COLUMNS, folder, plt, read, save

COLORS = (EXACT, AGENT, OBSTACLE, SLICE)
MARKS = ("o", "s", "^", "v")

names = sorted(os.path.basename(p) for p in glob.glob(os.path.join(folder(), "scan*.json")))
studies = {n[4:-5].lstrip("-").lstrip("0123456789_").replace("_", " "): read(n) for n in names}
names = list(studies)


def edges(cone):
    return np.array(cone["edges"], dtype=float)  # null: NaN


def errors(level, limit, kind):
    off = np.abs(edges(level[kind]) - edges(limit[kind]))
    return (np.nanmax(off), np.nanmean(off)) if np.isfinite(off).any() else (np.nan, np.nan)


figure, (error, missing) = plt.subplots(1, 2, figsize=(TWO_COLUMNS, 3.6))
first = studies[names[0]]
beams = np.array([level["beams"] for level in first["levels"]], dtype=float)
for kind, color, label in (("sections", SLICE, "tangents on each plane (6.3.3)"), ("cone", EXACT, "true cone of the points")):
    off = np.array([errors(level, first["visible"], kind) for level in first["levels"]])
    error.loglog(beams, off[:, 0], "o-", color=color, label=label + ": largest")
    error.loglog(beams, off[:, 1], "o:", color=color, label="mean", markersize=2.5)
start = [e for e in (errors(first["levels"][0], first["visible"], k)[0] for k in ("sections", "cone")) if np.isfinite(e)]
if start:
    error.loglog(beams, max(start) * np.sqrt(beams[0] / beams), "--", color=GREY, linewidth=0.8, label="1 / √beams")
error.set_xlabel("beams")
error.set_ylabel("error of an edge against the seen part (rad)")
error.set_title("(a) against the cone of what is seen%s" % (": " + names[0] if len(names) > 1 else ""))
error.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.17), ncol=2, columnspacing=1)

bottom = 1.0
for name, color, mark in zip(names, COLORS, MARKS):
    study = studies[name]
    whole = study["whole"]["cone"]["solid_angle"]
    part = np.array([np.nan if level["cone"]["solid_angle"] is None else 1 - level["cone"]["solid_angle"] / whole
                     for level in study["levels"]])
    floor = 1 - study["visible"]["cone"]["solid_angle"] / whole
    hidden = 1 - study["visible"]["area"] / study["whole"]["area"]
    counts = [level["beams"] for level in study["levels"]]
    what = "%.2g %% of the cone hidden" % (100 * floor) if floor > 1e-6 else "nothing of the cone hidden"
    missing.loglog(counts, np.abs(part), mark + "-", color=color,
                   label="%s%.0f %% of the surface unseen, %s" % (name + ": " if name else "", 100 * hidden, what))
    # Noise makes cones too large: shown by size, hollow.
    large = part < 0
    if large.any():
        missing.loglog(np.array(counts)[large], -part[large], mark, color=color, markerfacecolor="white", zorder=5,
                       label="hollow: too large by that (noise)")
    if floor > 1e-6:
        missing.axhline(floor, color=color, linestyle=":", linewidth=1)
    bottom = min([bottom] + [abs(p) for p in part if p] + ([floor] if floor > 1e-6 else []))
missing.set_ylim(bottom / 2, 1)
missing.set_xlabel("beams")
missing.set_ylabel("part of the true cone's solid angle missed")
missing.set_title("(b) against the whole; dotted: with beams everywhere")
missing.legend(frameon=False, loc="upper center", bbox_to_anchor=(0.5, -0.17))
figure.tight_layout(pad=0.4, w_pad=1.2)
save(figure, "scan_convergence")
