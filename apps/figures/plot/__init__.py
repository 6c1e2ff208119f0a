# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of bodies, cones, maps, fits and runs with Matplotlib. The figures of the vericone command are drawn by this
package; in Python it is `vericone.plot`.

Each function draws on the axes it is given, or on new ones, and returns them; labels name units. Matplotlib's settings
are left as they are: `with style():` has the look of these pictures."""
from .of_bodies import arrow, body, line, opening, plane, space, track
from .of_cones import (bands, clearance_field, cone, cone_map, directions_around, engagement, plane_engagement, sector,
                       sign_map, velocity, velocity_map)
from .of_runs import fit, run, ways
from .style import style

__all__ = ["arrow", "bands", "body", "clearance_field", "cone", "cone_map", "directions_around", "engagement", "fit", "line",
           "opening", "plane", "plane_engagement", "run", "sector", "sign_map", "space", "style", "track", "velocity",
           "velocity_map", "ways"]
