# SPDX-License-Identifier: BSD-3-Clause
"""A scene in the plane, from engagement.json: both bodies, the inner common tangents, the sector of colliding
velocities drawn at the agent, and where the scene's relative velocity leads, seen from the obstacle."""
from plot.in_plane import engagement
from vericone_figures.style import read, save

save(engagement(read("engagement.json")), "engagement")
