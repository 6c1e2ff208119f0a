# SPDX-License-Identifier: BSD-3-Clause
"""What objects show in Jupyter: numbers with units, and a picture."""
import base64
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import vericone as vc

pytest.importorskip("matplotlib")

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
BALL = vc.Ellipsoid.from_axes([0, 0, 0], [1, 1, 1])
AHEAD = vc.Ellipsoid.from_axes([10 / 3, 0, 0], [1, 1, 1])
PAIR = vc.Pair(BALL, AHEAD)
PICTURED: dict[str, tuple[Any, str]] = {
    "ellipse": (vc.Ellipse.from_axes([1, 2], [3, 1]), "m²"), "ellipsoid": (BALL, "m³"),
    "combined": (vc.CombinedEllipsoid(BALL, [vc.hyperboloid(2, [0.3, 0.5, 0.5])]), "1 hyperboloids"),
    "hull": (vc.HullBody.box([0, 0, 0], [1, 1, 1]), "8"), "body": (vc.Body(BALL), "ellipsoid"),
    "convex": (vc.Body(vc.Convex.cylinder(1, 2)).convex().swollen(0.25), "0.25 m"),
    "placed": (vc.Placed(BALL, vc.Pose(position=[1, 2, 3])), "(1, 2, 3) m"), "pair": (PAIR, "exact"),
    "cloud": (vc.Assembly.cloud(np.eye(3), 0.1), "3 of the kind ball"),
    "cone": (PAIR.cone(), " sr, proved"), "true cone": (vc.true_cone(BALL, AHEAD, 24), " sr"),
    "slice cone": (vc.slice_cone(BALL, AHEAD, 24), "too small"),
    "map": (vc.cone_map([PAIR], vc.ConeMapOptions(resolution=0.1)), " sr"),
    "sector": (PAIR.sector([0, 1, 0]), "degrees"),
    "fit": (vc.fitting.fit(vc.fitting.Sample(points=np.random.default_rng(1).normal(size=(100, 3))),
                           vc.fitting.FitOptions(shape=vc.fitting.Shape.ellipsoid)), "100 of 100 points, exact"),
}
NUMBERS: dict[str, tuple[Any, str]] = {
    "contact": (PAIR.contact([1, 0, 0], [0, 0, 0]), " s, proved"), "miss": (PAIR.miss([1, 3, 0], [0, 0, 0]), " m, proved"),
    "interval": (vc.Interval.between(1.0, 2.0), " to 2"),
}


@pytest.mark.parametrize("name", PICTURED)
def test_a_picture_and_numbers(name: str) -> None:
    thing, text = PICTURED[name]
    shown = thing._repr_html_()
    assert text in shown and "vericone." + type(thing).__name__ in shown
    picture = re.search(r"data:image/png;base64,([^']+)'", shown)
    assert picture is not None and base64.b64decode(picture.group(1)).startswith(b"\x89PNG")


def test_runs_say_what_is_proved() -> None:
    scenario = vc.read_scenario(ROOT / "docs/examples/scenarios/clearance.yaml")
    shown = vc.simulate(scenario)._repr_html_()
    assert len(re.findall(r"avoided, [\d.]+ m or more apart, proved", shown)) == 3 and "data:image/png" in shown


@pytest.mark.parametrize("name", NUMBERS)
def test_numbers_alone(name: str) -> None:
    thing, text = NUMBERS[name]
    shown = thing._repr_html_()
    assert text in shown and "<img" not in shown


def test_what_its_text_says_shows_nothing() -> None:
    assert vc.ConeOptions()._repr_html_() is None


def test_showing_opens_no_window_and_keeps_no_figure() -> None:
    import matplotlib.pyplot as plt
    before = plt.get_fignums()
    PAIR._repr_html_()
    assert plt.get_fignums() == before


def test_numbers_without_matplotlib() -> None:
    code = ("import sys; sys.modules['matplotlib'] = None; import vericone as vc; "
            "shown = vc.Ellipsoid()._repr_html_(); assert 'm³' in shown and '<img' not in shown")
    subprocess.run([sys.executable, "-c", code], check=True)


def test_importing_the_package_loads_no_display() -> None:
    code = "import sys, vericone; assert 'vericone.display' not in sys.modules and 'matplotlib' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_text_is_short() -> None:
    """Long arrays are named by their shape, within lists too."""
    shown = repr(vc.Pair(vc.Ellipsoid(), vc.Ellipsoid.from_axes([10, 2, 0], [2, 3, 1])).cone())
    assert "inner=[<array (" in shown and len(shown) < 1_500


def test_bodies_pairs_and_answers_print_in_a_line() -> None:
    corners = np.random.default_rng(1).normal(size=(200, 3))
    hull, rotated = vc.HullBody(corners), vc.Ellipsoid.from_axes([1 / 3, 0, 0], [1, 2, 3], np.linalg.qr(corners[:3])[0] * 1.0)
    for value in (vc.Pair(hull, rotated), vc.Placed(hull), vc.Body(rotated), rotated, vc.Pair(rotated, hull).miss([1, 0, 0], [0, 0, 0]),
                  vc.Pair(vc.Ellipsoid(), vc.Ellipsoid.from_axes([10, 2, 0], [2, 3, 1])).cone().solid_angle):
        assert len(repr(value)) < 400 and "\n" not in repr(value), repr(value)
    assert repr(vc.Pose([1, 2, 3])).startswith("Pose(position=[1.0, 2.0, 3.0], ")


def test_refusals_say_how_objects_are_made() -> None:
    for make, made_by in ((lambda: vc.Ellipsoid([0, 0, 0], np.eye(3)), "Ellipsoid.from_axes()"), (lambda: vc.Ellipse(center=[0, 0]), "Ellipse.from_axes()"),
                          (lambda: vc.Assembly([[0, 0, 0]]), "use Assembly.mesh(), Assembly.cloud()"), (lambda: vc.Opening(), "Opening.polygon()"),
                          (lambda: vc.HullBody(3, 4, 5), "HullBody.box()")):
        with pytest.raises(TypeError, match=re.escape(made_by)):
            make()  # type: ignore[no-untyped-call]
    with pytest.raises(TypeError) as raised:
        vc.Pair(1, 2)  # type: ignore[call-overload]
    assert str(raised.value).count("Pair(agent, obstacle, options=..., or fields of PairOptions)") == 1


def test_names_with_a_slip_are_suggested() -> None:
    done = subprocess.run([sys.executable, "-c", "import vericone; vericone.Ellipsiod()"], capture_output=True, text=True, check=False)
    assert "Did you mean: 'Ellipsoid'?" in done.stderr
