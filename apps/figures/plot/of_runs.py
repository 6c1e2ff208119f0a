# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""Runs and fits."""
import os
import sys
import tempfile
from typing import Any

import matplotlib.pyplot as plt
import numpy as np

from . import hulls, runs
from .objects import has, points_of, quadric_shape, value, word, wrong_kind
from .solids import View
from .style import TWO_COLUMNS, style


def flown_of(source: Any, scenario: Any) -> runs.Flown:
    """From a run's folder, or from a Run and its Scenario by the files that it would leave."""
    if scenario is None:
        if isinstance(source, (str, os.PathLike)):
            return runs.flown(source)
        if has(source, "tracks"):
            raise wrong_kind("scenario", scenario, "the Scenario of the run")
    if not has(source, "tracks"):
        raise wrong_kind("source", source, "the folder of a run, or a Run with its Scenario")
    library = sys.modules["vericone"]
    with tempfile.TemporaryDirectory() as folder:
        origin = library.scenario.RunOrigin(file="", seconds=0.0, text="", provenance="{}")
        library.scenario.write_run(scenario, source, origin, folder)
        return runs.flown(folder)


def run(source: Any, scenario: Any = None) -> tuple[Any, ...]:
    """Draws a run: the bodies on their ways (metres), y, miss distances (metres) and accelerations (m/s²) over time
    (seconds), and the verdict. `source`: the folder that `simulate(..., out=folder)` or `vericone simulate --out`
    wrote, or a Run, with its Scenario. Returns the axes, that of the ways first."""
    flown = flown_of(source, scenario)
    with style():
        return tuple(runs.picture(flown).axes)


def ways(source: Any, scenario: Any = None, *, axes: Any = None) -> Any:
    """Draws the ways of a run's bodies alone, metres; `source` as of run(). Returns the axes of the plane or of
    space."""
    flown = flown_of(source, scenario)
    with style():
        own = axes is None
        if own:
            figure = plt.figure(figsize=(0.6 * TWO_COLUMNS, 3.6))
            axes = (figure.add_axes([0.14, 0.14, 0.82, 0.82]) if flown.planar else
                    figure.add_axes([0.02, 0.04, 0.94, 0.92], projection="3d", computed_zorder=False))
        (runs.ways_in_plane if flown.planar else runs.ways_in_space)(axes, flown)
        if own and not flown.planar:
            runs.fill(axes, (0.08, 0.12, 0.78, 0.82), 40 if flown.rims else 55)
        runs.mark_contacts(axes, flown)
    return axes


def mesh_of(body: Any) -> dict[str, Any]:
    """The surface of a combined body as the library divides it."""
    surface = sys.modules["vericone"].surface(body)
    return {"vertices": np.asarray(surface.vertices),
            "triangles": np.array([np.asarray(t.vertices) for t in surface.triangles]),
            "quadrics": np.array([t.quadric for t in surface.triangles])}


def piece_data(piece: Any) -> dict[str, Any]:
    if piece.footprint is not None:
        turn = np.linspace(0, 2 * np.pi, 97)[:-1]
        ring = np.asarray(piece.footprint.center()) + np.stack([np.cos(turn), np.sin(turn)], axis=1) @ np.asarray(
            piece.footprint.factor()).T
        n = len(ring)
        around = [[i, (i + 1) % n, n + i] for i in range(n)] + [[(i + 1) % n, n + (i + 1) % n, n + i] for i in range(n)]
        return {"footprint": {"center": piece.footprint.center(), "factor": piece.footprint.factor(), "low": piece.low,
                              "high": piece.high},
                "mesh": {"vertices": np.vstack([np.column_stack([ring, np.full(n, z)])
                                                for z in (piece.low, piece.high)]),
                         "triangles": around, "quadrics": np.zeros(2 * n, int)}}
    return {"body": quadric_shape(piece.body), "part": "whole", "mesh": mesh_of(piece.body)}


def fit_data(result: Any, sample: Any) -> dict[str, Any]:
    """As fit_picture.json: what a fit found, of a Sample, a mesh or points (n, 3)."""
    if not has(result, "pieces", "certificate"):
        raise wrong_kind("result", result, "a FitResult")
    points = points_of(value(sample.points) if has(sample, "points") else sample, "sample")
    triangles = np.asarray(value(sample.triangles)) if has(sample, "triangles") else np.zeros((0, 3), int)
    scan = {"triangles": points[triangles]} if len(triangles) else {"points": points}
    touching = points[np.asarray(result.certificate.touching, int)]
    size = "" if result.volume is None else ", %.4g m³" % result.volume.value
    proved = ", proved to contain it" if result.certified else ""
    return {"hull": [piece_data(p) for p in result.pieces], "scan": {**scan, "thinned": False},
            "touching": touching.tolist(), "title": "%s%s%s" % (word(result.shape), size, proved)}


def fit(result: Any, sample: Any, *, axes: Any = None, azimuth: float = -60.0, elevation: float = 25.0) -> Any:
    """Draws a FitResult over the points (n, 3) or mesh that it was made of, metres. Without `axes`: from the front,
    from the side, from above and askew, and returns the four axes; else askew alone, seen from `azimuth` and
    `elevation` (degrees), and returns `axes`."""
    data = fit_data(result, sample)
    with style():
        if axes is None:
            return tuple(hulls.fit(data).axes)
        solids, everything = hulls.parts(data)
        view = View(azimuth, elevation)
        hulls.draw(axes, view, data, solids)
        hulls.limits(axes, view, everything)
        axes.axis("off")
        axes.set_title(data["title"])
    return axes
