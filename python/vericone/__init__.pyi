# SPDX-License-Identifier: BSD-3-Clause
from vericone import (
    exact as exact,
    files as files,
    fits as fits,
    fitting as fitting,
    guidance as guidance,
    lidar as lidar,
    montecarlo as montecarlo,
    octomap as octomap,
    plot as plot,
    scanning as scanning,
    scenario as scenario,
    scenes as scenes,
    ships as ships,
    simulation as simulation,
    swarm as swarm,
    vehicles as vehicles,
    vision as vision,
    work as work,
)
from vericone._errors import InputError as InputError
from vericone._many import Many as Many, many as many
from vericone._root import *
from vericone._runs import (
    Campaign as Campaign,
    Scanned as Scanned,
    as_frame as as_frame,
    campaign as campaign,
    fit as fit,
    load as load,
    read_scenario as read_scenario,
    read_scene as read_scene,
    read_table as read_table,
    run_tables as run_tables,
    scan as scan,
    simulate as simulate,
    units as units,
    write_scene as write_scene,
)
from vericone._version import __version__ as __version__

def __dir__() -> list[str]: ...
