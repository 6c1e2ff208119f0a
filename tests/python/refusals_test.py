# SPDX-License-Identifier: BSD-3-Clause
"""What callers get wrong in what they pass on: indices of others, parts of other lengths, places that do not agree. Each is
refused by name, or answered as it is meant; none reads memory that is not its own."""

import array
import pickle
import subprocess
import sys
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

import vericone
import vericone.files
import vericone.simulation

BALL, FAR = vericone.Ellipsoid(), vericone.Ellipsoid.from_axes([5, 0, 0], [1, 1, 1])
PAIR = vericone.Pair(BALL, FAR)
ORACLE = vericone.ConeOracle(BALL, FAR)
STILL = [0, 0, 0]
DENT = vericone.CombinedEllipsoid(vericone.Ellipsoid.from_axes([7, 0, 1], [2, 2, 1]), [vericone.Delimiter3(np.diag([1.0, -1.0, -1.0]), 0.5)])
g, s = vericone.guidance, vericone.simulation


def state(at: list[float], **more: Any) -> Any:
    return g.BodyState(shape=vericone.WorldBody(BALL.translated(at)), position=at, **more)


REFUSED: dict[str, tuple[Callable[[], Any], str]] = {
    "corners of other points": (lambda: vericone.files.triangle_mesh(vericone.files.PointFile(points=np.eye(3), faces=[[0, 1, 3]])), r"faces\[0\]"),
    "columns of other lengths": (lambda: s.csv(s.Table(columns=[s.Column(name="a", numbers=[1, 2]), s.Column(name="b", numbers=[1])])), r"columns\[1\]"),
    "a passage of another run": (lambda: s.largest_drift(s.Scenario(), s.Run(passages=[s.PassageOutcome(agent=9, ordered=True)])), "run.passages"),
    "an orifice that is not there": (lambda: s.reach(s.Scenario(bodies=[s.Body(pilot=s.Pilot(through=s.Through(orifices=["x"])))])), "through"),
    "masked values": (lambda: PAIR.verdict(np.ma.array([1.0, 0, 0], mask=[1, 0, 0]), STILL), "masked"),
    "uint64 beyond 2^53": (lambda: BALL.translated(np.array([2**53 + 1, 0, 0], np.uint64)), "2\\^53"),
    "int64 beyond 2^53 beside floats": (lambda: ORACLE.membership([np.array([2**53 + 1, 0, 0]), [0.5, 0, 0]]), "2\\^53"),
    "points of four numbers": (lambda: vericone.min_volume_ellipsoid(np.zeros((7, 4))), r"\(n, 2\) or of shape \(n, 3\)"),
    "no function": (lambda: vericone.visible_cone(BALL, None, [1, 0, 0], 3), "obstacle"),
    "a body in two places": (lambda: g.clearance_law(state(STILL), state(STILL).replace(position=[10, 0.1, 0]), g.ClearanceOptions()), r"b\.shape"),
    "a velocity that is none": (lambda: g.clearance_law(state(STILL, velocity=[1, 0, float("nan")]), state([9, 0, 0]), g.ClearanceOptions()), r"a\.velocity\[2\]"),
    "a gain that steers at it": (lambda: g.clearance_law(state(STILL), state([9, 0, 0]), g.ClearanceOptions(gain=-1)), r"options\.gain"),
    "a navigator that keeps nan": (lambda: g.Navigator(g.NavigatorOptions(required=float("nan"))), "required"),
    "a navigator without a place": (lambda: g.Navigator(g.NavigatorOptions()).step(state(STILL, velocity=[3, 0, 0]).replace(position=[float("nan")] * 3), [],
                                                                                   None, 0, 0.1), r"agent\.position\[0\]"),
    "one body flat, one not": (lambda: g.Navigator(g.NavigatorOptions()).step(state(STILL, velocity=[3, 0, 0]), [g.BodyState()], None, 0, 0.1), r"others\[0\]"),
    "a radius below 0": (lambda: vericone.Interval(1, -3), "rad"),
    "a limit below 0": (lambda: g.VerticalLaw(g.VerticalGains(most=-1)), "most"),
    "limits the wrong way round": (lambda: g.robust_correction(0.1, 1, -1, g.RobustModel(), g.RobustOptions()), "low, high"),
    "a plane that is none": (lambda: vericone.section(BALL.quadric(), vericone.PlaneFrame(
        origin=STILL, x_axis=[float("inf"), 0, 0], y_axis=[0, 1, 0])), "plane"),
    "the depth of nowhere": (lambda: vericone.Opening.ellipse([2, 1]).depth([float("nan"), 0]), "point"),
    "a mesh of points that are none": (lambda: vericone.files.triangle_mesh(vericone.files.PointFile(points=np.eye(3) * np.inf, faces=[[0, 1, 2]])),
                                       r"points\[0\]"),
    "a plane along the line": (lambda: g.plane_view(state(STILL), state([9, 0, 0]), [1, 0, 0], vericone.SectorMethod.slice, g.RateMethod.none), "across"),
    "a mesh beyond every ray": (lambda: vericone.lidar.MeshScene(np.eye(3) * 1e300, [[0, 1, 2]]), "points"),
    "a camera without pixels": (lambda: vericone.vision.Scene(vericone.vision.SceneOptions()).truth(vericone.Camera(width=0, height=2), vericone.Pose(), [], 0),
                                "camera"),
    "a pursuit from nowhere": (lambda: vericone.vision.pursue(vericone.vision.Pursuit(start=s.Motion(position=[float("inf"), 0, 0]))), "start"),
    "a line through nowhere": (lambda: vericone.files.are_collinear([float("nan"), 0, 0], STILL, [1, 0, 0]), "a, b, c"),
    "corners apart beyond every picture": (lambda: vericone.vision.source_tracker(vericone.vision.SourceTrackerOptions(distance=2**31 - 1)), "distance"),
    "planes without end": (lambda: g.choose_plane(state(STILL), state([9, 0, 0]), vericone.SectorMethod.slice, g.PlaneOptions(planes=2**30)), "planes"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_refused_by_name(what: str) -> None:
    call, field = REFUSED[what]
    with pytest.raises(vericone.InputError, match=field) as error:
        call()
    assert "\n" not in str(error.value)


def test_overloads_of_plane_and_space_are_told_by_shape() -> None:
    for n in (2, 3):
        assert vericone.orthonormal(np.eye(n)).shape == (n, n)
        points = np.vstack([np.eye(n), -np.eye(n)])
        for given in (points, points.tolist()):
            assert np.allclose(vericone.min_volume_ellipsoid(given).body.shape(), np.eye(n), atol=1e-6)
        assert vericone.exact.to_rational(np.eye(n)) == tuple(tuple(Fraction(i == j) for j in range(n)) for i in range(n))


def test_a_cone_pickles() -> None:
    cone = PAIR.cone()
    assert pickle.loads(pickle.dumps(cone)) == cone


def test_what_says_what_array_it_is() -> None:
    class Frame:
        """As those of pandas."""

        def __init__(self, values: Any) -> None:
            self.values = values

        def __array__(self, *_: Any) -> Any:
            return np.array(self.values)

    for given in (Frame([1.0, 0, 0]), memoryview(np.array([1.0, 0, 0])), array.array("d", [1, 0, 0])):
        assert PAIR.verdict(given, STILL) == vericone.Verdict.in_
        assert (BALL.translated(given).center() == [1, 0, 0]).all()
    assert PAIR.verdict(Frame(np.eye(3)), STILL).tolist() == PAIR.verdict(np.eye(3), STILL).tolist()
    assert BALL.scaled(np.array(2.0)) == BALL.scaled(2)
    assert ORACLE.membership([]).shape == (0,)
    itself = np.empty((), object)
    itself[()] = itself
    for wrong in (np.bool_(True), itself, np.array("2")):
        with pytest.raises(TypeError):
            BALL.scaled(wrong)


def test_functions_of_the_library_are_functions() -> None:
    near = vericone.points_near_plane(np.eye(3), 0.5)
    frame = vericone.PlaneFrame([0, 0, 0], [1, 0, 0], [0, 1, 0])
    assert near(frame).tolist() == [[1, 0], [0, 1]]
    with pytest.raises(TypeError):
        near()


def test_answers_have_no_truth_value() -> None:
    for answer in (PAIR.verdict([1, 0, 0], STILL), PAIR.cone().contains([1, 0, 0])):
        with pytest.raises(TypeError, match="neither true nor false"):
            bool(answer)


def test_a_vehicle_outlives_the_name_of_its_model() -> None:
    vehicle = vericone.vehicles.quadrotor(vericone.vehicles.QuadrotorOptions()).launch(s.Motion(position=[0, 0, 10]), 0, s.Current())
    vericone.vehicles.quadrotor(vericone.vehicles.QuadrotorOptions(mass=1))  # where the first one was
    vehicle.advance(s.VehicleCommand(), 0, 0.5, [])
    assert vehicle.motion().position[2] == pytest.approx(10, abs=0.5)


def test_planes_without_memory_of_edges() -> None:
    planes = vericone.PlaneCones(vericone.WorldBody(BALL), vericone.WorldBody(FAR), [0, 0, 0], [5, 0, 0], vericone.SectorMethod.slice)
    assert planes.on([1, 0, 0], [0, 0, 1]) is not None


def test_classes_of_two_kinds_are_of_one() -> None:
    class Both(vericone.PairOptions, vericone.Contact):  # type: ignore[misc]
        """Its value is that of the first."""

    with pytest.raises(TypeError, match="no field 'normal'"):
        Both().normal  # pylint: disable=expression-not-assigned


def test_damaged_pickles_are_refused() -> None:
    for kind in (vericone.Assembly, vericone.Body, vericone.WorldBody, vericone.Ellipsoid, vericone.Pose):
        with pytest.raises(TypeError):
            vericone._core._restore(kind, ())  # type: ignore[attr-defined]
    axes = np.diag([2.0, 1, 1])
    for shape, factor in ((axes, axes), (axes**2, axes * np.nan), (np.diag([4.0, 1, 0]), np.diag([2.0, 1, 0]))):
        with pytest.raises(vericone.InputError, match="as an ellipsoid was pickled"):
            vericone._core._restore(vericone.Ellipsoid, (np.zeros(3), shape, factor, True))  # type: ignore[attr-defined]


WORK = {
    "batches": "w = np.zeros((2_000_000, 3)) + [1, 0.1, 0]\nwork = lambda: o.membership(w)",
    "calls": "w = np.array([1, 0.1, 0])\nwork = lambda: o.membership(w)",
    "callbacks": "work = lambda: v.cone_map([v.Pair(a, b)], v.ConeMapOptions(resolution=0.05, progress=lambda x: True))",
}


@pytest.mark.parametrize("what", WORK)
def test_python_ends_while_threads_work(what: str) -> None:
    program = ("import threading, time, numpy as np, vericone as v\na, b = v.Ellipsoid(), v.Ellipsoid.from_axes([5, 0, 0], [1, 1, 1])\n"
               f"o = v.ConeOracle(a, b)\n{WORK[what]}\ndef on():\n    while True: work()\n"
               "for _ in range(3): threading.Thread(target=on, daemon=True).start()\ntime.sleep(0.3)")
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
