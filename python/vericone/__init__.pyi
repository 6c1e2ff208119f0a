# SPDX-License-Identifier: BSD-3-Clause
from vericone._errors import InputError as InputError
from vericone._root import *
from vericone._runs import (
    Campaign as Campaign,
    Scanned as Scanned,
    as_frame as as_frame,
    campaign as campaign,
    fit as fit,
    read_scenario as read_scenario,
    read_scene as read_scene,
    read_table as read_table,
    run_tables as run_tables,
    scan as scan,
    simulate as simulate,
    units as units,
    write_scene as write_scene,
)
