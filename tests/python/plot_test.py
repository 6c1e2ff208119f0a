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
from vericone.plot.of_bodies import BALLS, EXTENTS, SPHERES  # noqa: E402

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
    "cylinder": (vc.Convex.cylinder(2, 3), [[-2, -2, -1.5], [2, 2, 1.5]]),
    "capsules": (vc.Assembly.convexes([vc.Convex.capsule(0.5, 2), vc.Convex.box([1, 1, 1]).translated([5, 0, 0])]),
                 [[-0.5, -1, -1.5], [6, 1, 1.5]]),
    "body": (vc.Body(DENTED), [[4, -3, -3], [8, 3, 3]]),
    "union": (vc.Body.pieces([vc.CombinedEllipsoid(BALL), DENTED]), [[-1, -3, -3], [8, 3, 3]]),
    "placed": (vc.Placed(vc.Body(BALL), vc.Pose(position=[5, 6, 7])), [[4, 5, 6], [6, 7, 8]]),
    "turned": (vc.Placed(vc.HullBody.box([0, 0, 0], [1, 2, 3]),
                         vc.Pose(position=[5, 0, 0], rotation=[[0, -1, 0], [1, 0, 0], [0, 0, 1]])),
               [[3, 0, 0], [5, 1, 3]]),
    "world": (vc.WorldBody(DENTED), [[4, -3, -3], [8, 3, 3]]),
    "points": (CUBE, [[0, 0, 0], [1, 1, 1]]),
}
REACHED = ("ellipsoid", "hull", "mesh", "cloud", "boxes", "polyhedra", "placed", "turned", "points")  # the box is the least


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


def test_balls_are_as_large_as_they_are() -> None:
    """A few as spheres, many as dots that keep their size when the axes grow."""
    few = plot.body(vc.Assembly.cloud(CUBE, 0.2))
    corners = few.collections[0]._vec[:3].T
    assert np.linalg.norm(corners[:, None] - CUBE, axis=2).min(axis=1) == pytest.approx(0.2)
    axes = plot.body(vc.Assembly.cloud(np.tile(CUBE, (SPHERES // 8 + 1, 1)), 0.2))
    assert np.allclose(EXTENTS[axes], [[-0.2] * 3, [1.2] * 3])
    dots = BALLS[axes][0][0]()

    def diameters() -> tuple[float, float]:
        """Of a dot, and of the picture of an edge of the cube, both in points."""
        axes.figure.canvas.draw()
        ends = axes.get_proj() @ np.array([[0, 0, 0, 1], [0, 0, 1, 1]]).T
        pixels = axes.transData.transform((ends[:2] / ends[3]).T)
        return float(np.sqrt(dots.get_sizes()[0])), float(np.linalg.norm(pixels[1] - pixels[0]) * 72 / axes.figure.dpi)

    turn = np.cos(np.radians(axes.elev))  # an upright edge as it is seen
    before = diameters()
    assert before[0] == pytest.approx(0.4 * before[1] / turn, rel=0.02)
    plot.body(vc.Ellipsoid.from_axes([6, 0, 0], [1, 1, 1]), axes=axes)
    after = diameters()
    assert after[0] == pytest.approx(0.4 * after[1] / turn, rel=0.02) and after[0] < 0.6 * before[0]


def test_planar_bodies_are_their_outlines() -> None:
    ellipse = vc.Ellipse.from_axes([5, 1], [3, 1], vc.rotation_2d(0.4))
    axes = plot.body(ellipse)
    outline = lines(axes)[0] - [5, 1]
    inverse = np.linalg.inv(np.asarray(ellipse.shape()))
    assert np.allclose(np.einsum("ni,ij,nj->n", outline, inverse, outline), 1)
    assert (axes.get_xlabel(), axes.get_aspect()) == ("x (m)", 1)


def test_cones_on_the_same_axes_are_told_apart() -> None:
    axes = plot.cone(PAIR.cone())
    for _ in range(2):
        assert plot.cone(PAIR.cone(), axes=axes) is axes
    handles, labels = axes.get_legend_handles_labels()
    assert [text.split(":")[0] for text in labels] == ["cone", "cone 2", "cone 3"]
    assert len({handle.get_color() for handle in handles}) == 3
    assert plot.cone(PAIR.cone(), axes=axes, color="k", label="mine").get_lines()[-1].get_color() == "k"



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


def test_maps_of_velocities_cover_their_section() -> None:
    g = vc.guidance
    others = [g.Intruder(body=vc.Placed(vc.Body(AHEAD)), velocity=[0, 0, 0])]
    section = g.velocity_map(vc.Placed(vc.Body(BALL)), others, g.VelocityMapOptions(low=[0, -2, 0], high=[4, 2, 0], resolution=0.1, until=30))
    axes = plot.velocity_map(section)
    area = sum(patch.get_width() * patch.get_height() for patch in axes.patches)
    assert abs(area - 16) < 1e-9 and axes.get_xlabel() == "$v_x$ (m/s)"
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    assert names == ["meets 0", "safe", "undecided"]
    box = g.velocity_map(vc.Placed(vc.Body(BALL)), others, g.VelocityMapOptions(resolution=2, until=30))
    with pytest.raises(vc.InputError, match="thing: got a map of a box, must be a section"):
        plot.velocity_map(box)


def test_clearances_are_those_of_the_pair() -> None:
    pair = vc.Pair(BALL, AHEAD)
    axes = plot.clearance_field(pair, 2.0, n=21)
    field = np.asarray(axes.images[0].get_array())
    assert field[10, 10] == pytest.approx(pair.miss([2.0, 0, 0], STILL).distance)
    assert field[10, 10] < 0 < field[0, 0]
    assert any("(m)" in bar.get_ylabel() for bar in axes.figure.axes)


def test_clearances_say_how_far_they_are_and_stop() -> None:
    pair, shares = vc.Pair(BALL, AHEAD), list[float]()
    plot.clearance_field(pair, 2.0, n=5, progress=shares.append)
    assert shares == pytest.approx([0.2, 0.4, 0.6, 0.8, 1.0])
    axes = plot.clearance_field(pair, 2.0, n=5, progress=lambda share: share < 0.5)
    assert np.isnan(np.ma.filled(axes.images[0].get_array(), np.nan)).sum(axis=1).tolist() == [0, 0, 0, 5, 5]


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
    assert plot.arrow([0, 0], [1, 2]).get_xlabel() == "x (m)"
    assert np.allclose(EXTENTS[plot.arrow([1, 1, 1], [0, 0, 2])], [[1, 1, 1], [1, 1, 3]])
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


def test_velocities_make_axes_of_their_own() -> None:
    axes = plot.velocity([2, 0, 0], verdict=vc.Verdict.in_)
    assert axes.get_legend().get_texts()[0].get_text() == "collides" and axes.lines[-1].get_xydata() == pytest.approx(np.zeros((1, 2)))
    aside = plot.velocity([0, 2, 0], towards=[1, 0, 0])
    assert np.hypot(*aside.lines[-1].get_xydata()[0]) == pytest.approx(90)


PAIR = vc.Pair(BALL, AHEAD)
NAN = float("nan")


@pytest.mark.parametrize(("call", "kind", "message"), [
    (lambda: plot.body("bunny.off"), TypeError, "thing: got str, must be a body, a placed one, a mesh, or points (n, 3)"),
    (lambda: plot.body(vc.Ellipsoid), TypeError, "thing: got the type Ellipsoid, must be an object"),
    (lambda: plot.body(np.zeros((3, 2))), vc.InputError, "thing: got an array of shape (3, 2), must be points of shape (n, 3)"),
    (lambda: plot.body([]), vc.InputError, "thing: got no points, must be points of shape (n, 3)"),
    (lambda: plot.body([[1.0, NAN, 3.0]]), vc.InputError, "thing[0][1]: got nan, must be finite"),
    (lambda: plot.body(vc.fitting.Sample(points=CUBE, triangles=[[0, 1, 8]])), vc.InputError,
     "thing.triangles: got a point 8, must be of points 0 to 7"),
    (lambda: plot.body(BALL, axes=plot.plane()), vc.InputError, "axes: got axes of the plane, must be axes of space, as plot.space() makes"),
    (lambda: plot.body(vc.Ellipse(), axes=plot.space()), vc.InputError, "axes: got axes of space, must be axes of the plane, as plot.plane() makes"),
    (lambda: plot.line([1, 2, 3]), vc.InputError, "points: got an array of shape (3,), must be points of shape (n, 3) or (n, 2)"),
    (lambda: plot.arrow([0, 0, 0], [1, 2]), vc.InputError, "vector: got an array of shape (2,), must be a vector of shape (3,)"),
    (lambda: plot.velocity([0, 0, 0]), vc.InputError, "relative_velocity: got [0, 0, 0], must be a vector that is not zero"),
    (lambda: plot.cone(BALL), TypeError, "thing: got Ellipsoid, must be a Cone, TrueCone, SliceCone, PolyhedralCone, ConeBounds or ConeMap"),
    (lambda: plot.cone(PAIR), TypeError,
     "thing: got Pair, must be a Cone, TrueCone, SliceCone, PolyhedralCone, ConeBounds or ConeMap: its cone() is one"),
    (lambda: plot.cone(PAIR.cone(), towards=[0, 0, 0]), vc.InputError, "towards: got [0, 0, 0], must be a vector that is not zero"),
    (lambda: plot.cone_map(PAIR.cone()), TypeError, "thing: got Cone, must be a ConeMap; cone() draws cones"),
    (lambda: plot.engagement(BALL), TypeError, "pair: got Ellipsoid, must be a Pair"),
    (lambda: plot.plane_engagement(vc.Ellipse(), BALL), TypeError,
     "obstacle: got Ellipsoid, must be a planar body: an Ellipse or a CombinedEllipse"),
    (lambda: plot.clearance_field(PAIR, NAN), vc.InputError, "speed: got nan, must be finite, 0 or more"),
    (lambda: plot.clearance_field(PAIR, 1.0, progress=True), TypeError, "progress: got bool, must be a function, or None"),
    (lambda: plot.sector(PAIR), TypeError, "thing: got Pair, must be a PlaneSector, of Pair.sector(), or a Sector of planar bodies"),
    (lambda: plot.sign_map([0, 1, 2]), vc.InputError, "verdicts: got an array of shape (3,), int64, must be verdicts of shape (n, n)"),
    (lambda: plot.opening(BALL), TypeError, "placed: got Ellipsoid, must be a PlacedOpening"),
    (lambda: plot.track(BALL), TypeError, "flown: got Ellipsoid, must be a Track, as Run.tracks has them"),
    (lambda: plot.fit(BALL, CUBE), TypeError, "result: got Ellipsoid, must be a FitResult"),
    (lambda: plot.run(vc.simulation.Run()), TypeError, "scenario: got NoneType, must be the Scenario of the run"),
    (lambda: plot.run(None), TypeError, "source: got NoneType, must be the folder of a run, or a Run with its Scenario")])
def test_what_cannot_be_drawn_is_told(call: Any, kind: type[Exception], message: str) -> None:
    with pytest.raises(kind) as raised:
        call()
    assert type(raised.value) is kind and str(raised.value) == message


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


def test_a_program_that_draws_is_typed(tmp_path: Path) -> None:
    """By mypy without our settings, which know that Matplotlib may have no types."""
    pytest.importorskip("mypy")
    (tmp_path / "program.py").write_text("import vericone\nfrom vericone import plot\nplot.body(vericone.Ellipsoid())\n", encoding="utf-8")
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--config-file", "", "--cache-dir", "cache", "program.py"], cwd=tmp_path,
                          capture_output=True, text=True, check=False, env=os.environ | {"MYPYPATH": os.environ["PYTHONPATH"]})
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_page_about_pictures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (ROOT / "docs/howto/plots.md").read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    for code in re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL):
        exec(compile(code, "plots.md", "exec"), {})
    assert sorted(file.name for file in tmp_path.iterdir()) == ["engagement.pdf", "pictures.png"]
    told = set(re.findall(r"`(\w+)\(", page))
    assert set(plot.__all__) - told == {"directions_around", "style"}
