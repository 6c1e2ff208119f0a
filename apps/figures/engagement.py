# SPDX-License-Identifier: BSD-3-Clause
"""One engagement in space, from engagement.json: both bodies, the slice cone inside the true cone, the scene's velocity
with where it leads, and a velocity between the two cones, which is shown in space where the scene has none."""
from plot.in_space import engagement
from vericone_figures.style import read, save

save(engagement(read("engagement.json")), "engagement")
