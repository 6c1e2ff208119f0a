# SPDX-License-Identifier: BSD-3-Clause
"""Answers around an exactly grazing velocity, from signmap.csv and signmap.json: plain doubles, the library, and
the rung that decided."""
import csv
import os

import numpy as np

from plot.signs import ANSWERS, RUNGS, sign_map
from vericone_figures.style import folder, read, save

data = read("signmap.json")
n = data["cells"]
half = n // 2
grids = {name: np.zeros((n, n), dtype=int) for name in ("naive", "library", "rung")}
with open(os.path.join(folder(), "signmap.csv"), newline="") as f:
    for row in csv.DictReader(f):
        at = (int(row["ulps_y"]) + half, int(row["ulps_x"]) + half)
        for name, words in (("naive", ANSWERS), ("library", ANSWERS), ("rung", RUNGS)):
            grids[name][at] = list(words).index(row[name])
save(sign_map(data, grids), "signmap")
