# SPDX-License-Identifier: BSD-3-Clause
"""A cone map, cone_map.json: around the direction asked about, as the agent sees it, and the whole sphere; what
collides, what is safe, what is undecided, and the rim of the region around that direction."""
from plot.sphere import cone_map
from vericone_figures.style import read, save

save(cone_map(read("cone_map.json")), "cone_map")
