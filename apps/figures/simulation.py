# SPDX-License-Identifier: BSD-3-Clause
"""A run of `vericone simulate`: the bodies on their ways at several times; y, clearance and accelerations over time."""
from plot.runs import flown, picture
from vericone_figures.style import folder, save

save(picture(flown(folder())), "simulation")
