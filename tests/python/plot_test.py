# SPDX-License-Identifier: BSD-3-Clause
"""Pictures: what is drawn is where it is said to be, axes name their units, Matplotlib's settings stay as they were."""
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

import vericone as vc  # noqa: E402
from vericone import plot  # noqa: E402
from vericone.plot.of_bodies import EXTENTS  # noqa: E402

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
BALL = vc.Ellipsoid.from_axes([0, 0, 0], [1, 1, 1])
AHEAD = vc.Ellipsoid.from_axes([10 / 3, 0, 0], [1, 1, 1])
HALF_ANGLE = np.degrees(np.arcsin(0.6))  # of the cone of the two
STILL = np.zeros(3)
DENTED = vc.CombinedEllipsoid(vc.Ellipsoid.from_axes([6, 0, 0], [2, 3, 3]), [vc.hyperboloid(2, [0.7, 1.2, 1.2])])
CUBE = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], float)
SIDES = np.array([[0, 1, 3], [0, 3, 2], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                  [0, 6, 4], [1, 3, 7], [1, 7, 5]])
# Each body with the corners of a box that holds it.
BODIES: dict[str, tuple[Any, list[list[float]]]] = {
    "ellipsoid": (vc.Ellipsoid.from_axes([3, 0, 0], [1, 2, 1]), [[2, -2, -1], [4, 2, 1]]),
    "combined": (DENTED, [[4, -3, -3], [8, 3, 3]]),
    "hull": (vc.HullBody.box([0, 0, 0], [1, 2, 3]), [[0, 0, 0], [1, 2, 3]]),
    "mesh": (vc.Assembly.mesh(CUBE, SIDES), [[0, 0, 0], [1, 1, 1]]),
    "cloud": (vc.Assembly.cloud(CUBE, 0.1), [[-0.1, -0.1, -0.1], [1.1, 1.1, 1.1]]),
    "boxes": (vc.Assembly.boxes([vc.Box(low=[0, 0, 0], high=[1, 2, 3])]), [[0, 0, 0], [1, 2, 3]]),
    "polyhedra": (vc.Assembly.polyhedra([vc.HullBody.box([0, 0, 0], [1, 1, 1]), vc.HullBody.box([2, 0, 0], [3, 1, 1])]),
                  [[0, 0, 0], [3, 1, 1]]),
    "body": (vc.Body(DENTED), [[4, -3, -3], [8, 3, 3]]),
    "union": (vc.Body.pieces([vc.CombinedEllipsoid(BALL), DENTED]), [[-1, -3, -3], [8, 3, 3]]),
    "placed": (vc.Placed(vc.Body(BALL), vc.Pose(position=[5, 6, 7])), [[4, 5, 6], [6, 7, 8]]),
    "turned": (vc.Placed(vc.HullBody.box([0, 0, 0], [1, 2, 3]),
                         vc.Pose(position=[5, 0, 0], rotation=[[0, -1, 0], [1, 0, 0], [0, 0, 1]])),
               [[3, 0, 0], [5, 1, 3]]),
    "world": (vc.WorldBody(DENTED), [[4, -3, -3], [8, 3, 3]]),
    "points": (CUBE, [[0, 0, 0], [1, 1, 1]]),
}
REACHED = ("ellipsoid", "hull", "mesh", "boxes", "polyhedra", "placed", "turned", "points")  # the box is the least


@pytest.fixture(autouse=True)
def closed() -> Any:
    """No test leaves a figure or a setting behind."""
    before = dict(plt.rcParams)
    yield
    plt.close("all")
    assert [name for name, value in before.items() if plt.rcParams[name] != value] == []


def lines(axes: Any) -> list[Any]:
    return [np.column_stack(line.get_data()) for line in axes.lines if len(line.get_xdata()) > 2]


@pytest.mark.parametrize("kind", BODIES)
def test_bodies_are_drawn_where_they_are(kind: str) -> None:
    thing, box = BODIES[kind]
    axes = plot.body(thing, label=kind)
    assert [axes.get_xlabel(), axes.get_ylabel(), axes.get_zlabel()] == ["x (m)", "y (m)", "z (m)"]
    low, high = EXTENTS[axes]
    assert np.all(low >= np.array(box[0]) - 1e-9) and np.all(high <= np.array(box[1]) + 1e-9)
    if kind in REACHED:
        assert np.allclose([low, high], box, atol=0.02)


def test_axes_in_space_keep_one_scale_and_grow() -> None:
    axes = plot.body(BALL)
    plot.body(vc.Ellipsoid.from_axes([20, 0, 0], [1, 5, 1]), axes=axes)
    sides = [np.ptp(getattr(axes, "get_%slim" % name)()) for name in "xyz"]
    scale = np.asarray(axes._box_aspect) / sides
    assert np.allclose(scale, scale[0]) and sides[0] >= 22


def test_planar_bodies_are_their_outlines() -> None:
    ellipse = vc.Ellipse.from_axes([5, 1], [3, 1], vc.rotation_2d(0.4))
    axes = plot.body(ellipse)
    outline = lines(axes)[0] - [5, 1]
    inverse = np.linalg.inv(np.asarray(ellipse.shape()))
    assert np.allclose(np.einsum("ni,ij,nj->n", outline, inverse, outline), 1)
    assert (axes.get_xlabel(), axes.get_aspect()) == ("x (m)", 1)


@pytest.mark.parametrize("make", [lambda: vc.Pair(BALL, AHEAD).cone(), lambda: vc.true_cone(BALL, AHEAD, 48),
                                  lambda: vc.slice_cone(BALL, AHEAD, 48),
                                  lambda: vc.slice_cone(BALL, AHEAD, 48).polyhedral()])
def test_cones_of_balls_are_circles(make: Any) -> None:
    axes = plot.cone(make(), towards=[1, 0, 0])
    away = np.hypot(*lines(axes)[0].T)
    assert away == pytest.approx(HALF_ANGLE, abs=0.3)
    assert "(deg)" in axes.get_xlabel() and " sr" in axes.get_legend().get_texts()[0].get_text()


def test_maps_agree_with_the_cone() -> None:
    cells = vc.cone_map([vc.Pair(BALL, AHEAD)], vc.ConeMapOptions(resolution=0.05))
    around = plot.cone(cells, towards=[1, 0, 0])
    shown = np.asarray(around.images[0].get_array())
    angle = (np.arange(len(shown)) + 0.5) / len(shown) * 120 - 60
    away = np.hypot(*np.meshgrid(angle, angle))
    assert np.all(shown[away < HALF_ANGLE - 4] == 0) and np.all(shown[away > HALF_ANGLE + 4] == 1)
    assert plot.cone_map(cells).get_xlabel() == "azimuth (deg)"


def test_clearances_are_those_of_the_pair() -> None:
    pair = vc.Pair(BALL, AHEAD)
    axes = plot.clearance_field(pair, 2.0, n=21)
    field = np.asarray(axes.images[0].get_array())
    assert field[10, 10] == pytest.approx(pair.miss([2.0, 0, 0], STILL).distance)
    assert field[10, 10] < 0 < field[0, 0]
    assert any("(m)" in bar.get_ylabel() for bar in axes.figure.axes)


def test_engagements_of_every_kind() -> None:
    for obstacle in (AHEAD, vc.Placed(vc.HullBody.box([4, -1, -1], [6, 1, 1])), DENTED):
        pair = vc.Pair(BALL, obstacle)
        for velocity in ([1.0, 0, 0], [1.0, 2, 0], [0.0, 0, 0]):
            axes = plot.engagement(pair, velocity)
            assert axes.texts[0].get_text().startswith(pair.verdict(velocity, STILL).name.rstrip("_"))
    mesh = vc.Pair(BALL, vc.Placed(BODIES["mesh"][0], vc.Pose(position=[4, 0, 0])))
    plot.engagement(mesh, [1.0, 0, 0], cone=False)


def test_lines_arrows_and_openings() -> None:
    square = vc.PlacedOpening(opening=vc.Opening.polygon([[-1, -1], [1, -1], [1, 1], [-1, 1]]), center=[5, 0, 0],
                              axes=[[0, 0], [1, 0], [0, 1]])
    axes = plot.opening(square)
    rim = np.column_stack(axes.lines[0].get_data_3d())
    assert np.allclose(rim[:, 0], 5) and np.allclose(np.abs(rim[:, 1:]), 1) and np.array_equal(rim[0], rim[-1])
    plot.line([[0, 0, 0], [5, 0, 0]], axes=axes, label="way")
    plot.arrow([0, 0, 0], [0, 0, 9], axes=axes)
    assert np.allclose(EXTENTS[axes], [[0, -1, -1], [5, 1, 9]])
    assert plot.arrow([0, 0], [1, 2], axes=plot.plane()).get_xlabel() == "x (m)"
    ring = plot.opening(vc.PlacedOpening(opening=vc.Opening.circle(2.0)))
    assert np.allclose(np.hypot(*ring.lines[0].get_data_3d()[:2]), 2)


def test_sectors() -> None:
    sector = vc.Pair(BALL, AHEAD).sector([0, 1, 0])
    assert sector is not None
    axes = plot.sector(sector)
    ends = [line.get_xydata()[1] for line in axes.lines[:2]]
    assert np.degrees(np.arctan2(*ends[1][::-1])) == pytest.approx(HALF_ANGLE, abs=1e-6)
    a, b = vc.Ellipse.from_axes([0, 0], [1, 1]), vc.Ellipse.from_axes([10 / 3, 0], [1, 1])
    assert plot.plane_engagement(a, b, vc.sector_by_support(a, b)).get_xlabel() == "x (m)"


def test_runs_and_their_folders_are_the_same_picture(tmp_path: Path) -> None:
    scenario = vc.read_scenario(ROOT / "docs/examples/scenarios/clearance.yaml")
    flown = vc.simulate(scenario, out=tmp_path)
    space, *panels = plot.run(tmp_path)
    assert any("miss distance m (m)" == axes.get_ylabel() for axes in panels) and panels[-1].get_xlabel() == "time (s)"
    for one, other in zip([space, *panels], plot.run(flown, scenario)):
        assert len(one.lines) == len(other.lines)
        for drawn, redrawn in zip(one.lines, other.lines):
            assert np.array_equal(drawn.get_xdata(), redrawn.get_xdata(), equal_nan=True)
    assert plot.ways(tmp_path).get_zlabel() == "z (m)"
    plot.track(flown.tracks[0])


def test_fits() -> None:
    points = np.random.default_rng(1).normal(size=(300, 3)) * [2, 1, 1]
    sample = vc.fitting.Sample(points=points)
    for shape in (vc.fitting.Shape.ellipsoid, vc.fitting.Shape.biconcave, vc.fitting.Shape.ellipse):
        found = vc.fitting.fit(sample, vc.fitting.FitOptions(shape=shape))
        assert [axes.get_xlabel() for axes in plot.fit(found, sample)][:3] == ["x (m)", "y (m)", "x (m)"]
        axes = plot.plane()
        assert plot.fit(found, points, axes=axes) is axes


def test_what_is_no_body_is_told() -> None:
    with pytest.raises(TypeError, match="body: str is none"):
        plot.body("bunny.off")
    with pytest.raises(ValueError, match=r"\(n, 3\) are wanted, these are \(3, 2\)"):
        plot.body(np.zeros((3, 2)))
    with pytest.raises(TypeError, match="cone: Ellipsoid is none"):
        plot.cone(BALL)


def test_the_package_draws_without_the_modules() -> None:
    """The scripts of the command import it beside themselves, with no vericone anywhere."""
    code = ("import sys; sys.path.insert(0, %r); import matplotlib; matplotlib.use('Agg'); import plot; "
            "plot.body({'kind': 'ellipsoid', 'center': [1, 0, 0], 'factor': [[1, 0, 0], [0, 2, 0], [0, 0, 1]]}); "
            "assert 'vericone' not in sys.modules" % str(ROOT / "apps" / "figures"))
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    subprocess.run([sys.executable, "-c", code], check=True, env=environment)


def test_importing_decides_nothing_for_matplotlib() -> None:
    code = ("import matplotlib.pyplot as plt; before = dict(plt.rcParams); "
            "import vericone.plot; assert dict(plt.rcParams) == before")
    subprocess.run([sys.executable, "-c", code], check=True, env={**os.environ, "MPLBACKEND": "agg"})


def test_the_page_about_pictures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (ROOT / "docs/howto/plots.md").read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    for code in re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        exec(compile(code, "plots.md", "exec"), {})
    assert sorted(file.name for file in tmp_path.iterdir()) == ["engagement.pdf", "pictures.png"]
    told = set(re.findall(r"`(\w+)\(", page))
    assert set(plot.__all__) - told == {"directions_around", "style"}
