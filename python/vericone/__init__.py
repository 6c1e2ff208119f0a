# SPDX-License-Identifier: BSD-3-Clause
"""Collision, rendezvous and orifice cones with certified bounds.

The names are those of the C++ library, and so are the namespaces: vericone.Pair, vericone.guidance.Navigator,
vericone.fitting.fit. Vectors are arrays of shape (3,), or (..., 3) for many questions at once. What the commands do with
files is here too: vericone.simulate, campaign, fit, scan, read_scene.
"""
import importlib as _importlib
import sys as _sys
from typing import Any as _Any

from vericone._errors import InputError as InputError
from vericone._root import *  # noqa: F401,F403

# Loaded when they are first asked for.
_MODULES = ("exact", "files", "fits", "fitting", "guidance", "lidar", "montecarlo", "octomap", "plot", "scanning",
            "scenario", "scenes", "ships", "simulation", "swarm", "vehicles", "vision", "work")
_LATER = {"__version__": "_version", "many": "_many", "Many": "_many", **dict.fromkeys(
    ("Campaign", "Scanned", "as_frame", "campaign", "fit", "load", "read_scenario", "read_scene", "read_table", "run_tables", "scan",
     "simulate", "units", "write_scene"), "_runs")}


def __getattr__(name: str) -> _Any:
    if name in _MODULES:
        return _importlib.import_module("vericone." + name)
    if name in _LATER:
        value = getattr(_importlib.import_module("vericone." + _LATER[name]), name)
        globals()[name] = value
        return value
    raise AttributeError(f"module 'vericone' has no attribute '{name}'", name=name, obj=_sys.modules[__name__])


def __dir__() -> list[str]:
    return sorted({*globals(), *_MODULES, *_LATER})
