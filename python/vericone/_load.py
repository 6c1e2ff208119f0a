# SPDX-License-Identifier: BSD-3-Clause
"""Loads the compiled modules when they are first asked for."""
from __future__ import annotations

import importlib
import os
from typing import Any

_NEEDS = {"_fitting": "Ceres and Qhull", "_lidar": "Embree and Open3D", "_octomap": "OctoMap", "_vision": "OpenCV"}


def module(name: str) -> Any:
    """The compiled module vericone.NAME; an ImportError that says what it needs where there is none."""
    try:
        return importlib.import_module("vericone." + name)
    except ModuleNotFoundError as error:
        if error.name != "vericone." + name:
            raise
        folder = os.path.dirname(os.path.abspath(__file__))
        raise ImportError(f"this vericone was built without {_NEEDS.get(name, name)}: there is no {name} in {folder}; "
                          "docs/howto/python.md says how to build it") from None
    except ImportError as error:
        if name not in _NEEDS:
            raise
        raise ImportError(f"vericone.{name} needs {_NEEDS[name]} on this machine: {error}") from error


def fill(names: dict[str, Any], space: str, modules: list[str]) -> None:
    """The names of a namespace, from the compiled modules that have some."""
    for name in modules:
        names.update(module(name)._names.get(space, {}))
