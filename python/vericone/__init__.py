# SPDX-License-Identifier: BSD-3-Clause
"""Collision, rendezvous and orifice cones with certified bounds.

The names are those of the C++ library, and so are the namespaces: vericone.Pair, vericone.guidance.Navigator,
vericone.fitting.fit. Vectors are arrays of shape (3,), or (..., 3) for many questions at once.
"""
from __future__ import annotations

import importlib
from typing import Any

from vericone._errors import InputError as InputError
from vericone._root import *  # noqa: F401,F403

_MODULES = ("exact", "engagements", "guidance", "simulation", "vehicles", "files", "scenes", "scenario", "octomap", "fitting",
            "lidar", "vision", "plot", "display", "montecarlo", "fits", "scanning")
# What commands do, as functions.
_RUNS = ("Campaign", "Scanned", "as_frame", "campaign", "fit", "read_scenario", "read_scene", "read_table", "run_tables", "scan",
         "simulate", "units", "write_scene")


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return importlib.import_module("vericone." + name)
    if name in _RUNS:
        return getattr(importlib.import_module("vericone._runs"), name)
    raise AttributeError(f"module 'vericone' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted([*globals(), *_MODULES, *_RUNS])
