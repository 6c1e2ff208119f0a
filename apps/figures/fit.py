# SPDX-License-Identifier: BSD-3-Clause
"""A scan and its quadric hull, from fit_picture.json: from the front, from the side, from above, and askew."""
from plot.hulls import fit
from vericone_figures.style import read, save

save(fit(read("fit_picture.json")), "fit")
