# SPDX-License-Identifier: BSD-3-Clause
"""Files, runs, campaigns, fits and scans as functions: the same as the commands, to the bit."""

from __future__ import annotations

import json
import os
from fractions import Fraction
import subprocess
from pathlib import Path
from typing import Any, Callable

import numpy as np
import numpy.typing as npt
import pytest

import vericone
from vericone import files, montecarlo, scenes

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
COMMAND = os.environ.get("VERICONE", str(ROOT / "build/release/apps/vericone"))
SCENARIOS = ROOT / "docs/examples/scenarios"
Array = npt.NDArray[Any]


def command(*arguments: str) -> None:
    done = subprocess.run([COMMAND, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def same_bits(a: Array, b: Array) -> bool:
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def test_the_package_lists_what_it_has() -> None:
    assert {"Any", "sys", "importlib", "annotations"}.isdisjoint(dir(vericone))
    assert {"__version__", "Pair", "guidance", "simulate", "many", "InputError"} <= set(dir(vericone))
    version = subprocess.run([COMMAND, "--version"], capture_output=True, text=True, check=True).stdout.split()[1]
    assert vericone.__version__ == version


# Runs ------------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["avoidance", "clearance", "fish", "noise", "orifices", "quadrotor"])
def test_runs_are_those_of_the_command(name: str, tmp_path: Path) -> None:
    file = SCENARIOS / f"{name}.yaml"
    command("simulate", str(file), "--no-figures", "--quiet", "--out", str(tmp_path / "command"))
    run = vericone.simulate(file, out=tmp_path / "package")
    theirs, ours = tmp_path / "command", tmp_path / "package"
    assert sorted(os.listdir(theirs)) == sorted(os.listdir(ours))
    for written in sorted(os.listdir(theirs)):
        if written != "run.json":
            assert (theirs / written).read_bytes() == (ours / written).read_bytes(), written
    told, said = json.loads((theirs / "run.json").read_text()), json.loads((ours / "run.json").read_text())
    assert vericone.__version__ and said["provenance"]["version"] == told["provenance"]["version"] == vericone.__version__
    for apart in ("seconds", "times", "real_time_factor", "provenance"):
        del told[apart], said[apart]
    assert told == said
    # Tables are the CSV files.
    tables = vericone.run_tables(vericone.read_scenario(file), run)
    assert {f"{table}.csv" for table in tables} == {f for f in os.listdir(theirs) if f.endswith(".csv")}
    for table, rows in tables.items():
        read = vericone.read_table(theirs / f"{table}.csv")
        assert rows.dtype.names == read.dtype.names and vericone.units(rows) == vericone.units(read)
        for column in rows.dtype.names or ():
            if rows[column].dtype.kind == "f":
                assert same_bits(np.nan_to_num(rows[column], nan=1e301), np.nan_to_num(read[column], nan=1e301)), column
            else:
                assert rows[column].tolist() == read[column].tolist(), column


def test_tables_know_their_units() -> None:
    scenario = vericone.read_scenario(SCENARIOS / "avoidance.yaml")
    bodies = vericone.run_tables(scenario, vericone.simulate(scenario))["bodies"]
    assert vericone.units(bodies)["vx"] == "m/s" and vericone.units(bodies)["body"] == ""
    assert bodies["vx [m/s]"] is not None and same_bits(bodies["vx [m/s]"], bodies["vx"])
    assert set(bodies["body"]) == {body.name for body in scenario.bodies}


@pytest.mark.parametrize(("text", "value", "requirement"), [
    ("", "no columns", "a table whose first line names its columns, each by another name"),
    ("# settings\n", "no columns", "a table whose first line names its columns, each by another name"),
    ("x [m],x\n1,2\n", "columns ['x [m]', 'x']", "a table whose first line names its columns, each by another name"),
    ("x [m],y\n1,2\n3\n", "row 2 of 1 fields", "a table whose rows have 2 fields, one for each column"),
    ("x [m],y\n1,2,3\n", "row 1 of 3 fields", "a table whose rows have 2 fields, one for each column"),
    ("x [m],y\n1,2\n\n", "row 2 of 0 fields", "a table whose rows have 2 fields, one for each column"),
    ("x [m],y\n1,2\n3,4.2", "no line break after row 2", "a whole table: this one may be cut off"),
    ("x [m],y\n1,2\n3,4..2\n", "'4..2' in row 2, column y", "a number like others of the column, or empty"),
    ("x [m],y\n1,2\n3_0,4\n", "'3_0' in row 2, column x", "a number like others of the column, or empty"),
    ("x [m],y\n1,\"2\n", "unexpected end of data", "a table of comma-separated fields"),
    ("x [m],y\n1,\udcff\n", "byte 0xff", "text in UTF-8")])
def test_tables_that_are_not_whole_are_refused(text: str, value: str, requirement: str, tmp_path: Path) -> None:
    file = tmp_path / "bodies.csv"
    file.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(vericone.InputError) as raised:
        vericone.read_table(file)
    assert (raised.value.field, raised.value.value, raised.value.requirement) == (str(file), value, requirement)


def test_tables_have_empty_fields_and_comments(tmp_path: Path) -> None:
    file = tmp_path / "table.csv"
    file.write_text("# settings, of a command\nx [m],body,law\n1e-3,7,di\n,#2,\n", encoding="utf-8")
    table = vericone.read_table(file)
    assert table["body"].tolist() == ["7", "#2"] and table["law"].tolist() == ["di", ""] and vericone.units(table)["x"] == "m"
    assert table["x"][0] == 1e-3 and np.isnan(table["x"][1])


def test_a_frame_of_pandas() -> None:
    pytest.importorskip("pandas")
    scenario = vericone.read_scenario(SCENARIOS / "avoidance.yaml")
    table = vericone.run_tables(scenario, vericone.simulate(scenario))["encounters"]
    frame = vericone.as_frame(table)
    assert list(frame.columns) == list(table.dtype.names or ())
    assert frame.attrs["units"]["r"] == "m" and len(frame) == len(table)


def test_seeds_and_trials_make_other_noise() -> None:
    scenario = vericone.read_scenario(SCENARIOS / "noise.yaml")
    first, again = vericone.simulate(scenario), vericone.simulate(scenario)
    other, trial = vericone.simulate(scenario, seed=scenario.seed + 1), vericone.simulate(scenario, trial=1)

    def measured(run: Any) -> Array:
        return vericone.run_tables(scenario, run)["sights"]["x"]

    assert same_bits(measured(first), measured(again))
    assert measured(first).tolist() != measured(other).tolist()
    assert measured(first).tolist() != measured(trial).tolist()


def test_progress_is_told_and_stops(tmp_path: Path) -> None:
    shares: list[float] = []

    def told(share: float) -> bool:
        shares.append(share)
        return share < 0.3

    run = vericone.simulate(SCENARIOS / "avoidance.yaml", progress=told, out=tmp_path / "out")
    assert run.interrupted and not (tmp_path / "out").exists()
    assert shares == sorted(shares) and shares[-1] >= 0.3 and shares[-2] < 0.3
    finished: list[float] = []
    run = vericone.simulate(SCENARIOS / "avoidance.yaml", progress=finished.append)  # nothing returned: goes on
    assert not run.interrupted and len(finished) > len(shares)


def test_an_error_in_progress_is_raised() -> None:
    def fails(_: float) -> bool:
        raise ZeroDivisionError("of the callback")

    with pytest.raises(ZeroDivisionError, match="of the callback"):
        vericone.simulate(SCENARIOS / "avoidance.yaml", progress=fails)


@pytest.mark.parametrize("call,field", [
    (lambda: vericone.simulate("none.yaml"), "none.yaml"), (lambda: vericone.read_scene("none.yaml"), "none.yaml"),
    (lambda: vericone.read_table("none.csv"), "file"), (lambda: vericone.fit("none.ply"), "none.ply"),
    (lambda: vericone.fit(np.zeros((9, 3)), mode="quick"), "mode"), (lambda: vericone.fit(np.zeros((9, 3)), shape="cube"), "shape"),
    (lambda: vericone.fit(np.zeros((9, 3))), "points"), (lambda: vericone.scan("none.yaml"), "none.yaml"),
    (lambda: vericone.campaign(threads=-1), "threads"), (lambda: vericone.scan("none.yaml", azimuth=float("nan"), out="none"), "azimuth"),
    (lambda: vericone.many([]), "objects"), (lambda: vericone.simulate("none.yaml", out="a\0b"), "out"),
    (lambda: vericone.campaign(montecarlo.Campaign(engagements=0)), "engagements"),
    (lambda: vericone.campaign(montecarlo.Campaign(laws=["flap"])), "laws")])
def test_bad_input_is_named(call: Callable[[], object], field: str) -> None:
    with pytest.raises(vericone.InputError) as raised:
        call()
    assert raised.value.field == field


UNTYPED: Any = vericone  # what a type checker would refuse


@pytest.mark.parametrize(("call", "message"), [
    (lambda: UNTYPED.simulate(None), "scenario: got NoneType, must be a Scenario, or the path of its file"),
    (lambda: UNTYPED.simulate("none.yaml", progress=1), "progress: got int, must be a function, or None"),
    (lambda: UNTYPED.simulate("none.yaml", out=1), "out: got int, must be the path of a folder"),
    (lambda: UNTYPED.campaign(1), "settings: got int, must be a montecarlo.Campaign, or None"),
    (lambda: UNTYPED.campaign(threads="2"), "threads: got str, must be an integer"),
    (lambda: UNTYPED.campaign(threads=1.5), "threads: got float, must be an integer"),
    (lambda: UNTYPED.scan(None), "scene: got NoneType, must be a scanning.Setup, or the path of a scene"),
    (lambda: UNTYPED.scan("none.yaml", azimuth="1"), "azimuth: got str, must be a number (rad)"),
    (lambda: UNTYPED.read_scene(None), "file: got NoneType, must be the path of a file"),
    (lambda: UNTYPED.read_table(1), "file: got int, must be the path of a CSV file"),
    (lambda: UNTYPED.units([1.0]), "table: got list, must be a structured array, as run_tables() and read_table() return"),
    (lambda: UNTYPED.many(1), "objects: got int, must be a list of objects of one type")])
def test_arguments_of_a_wrong_kind_are_named(call: Callable[[], object], message: str) -> None:
    with pytest.raises(TypeError) as raised:
        call()
    assert str(raised.value) == message


@pytest.mark.parametrize("name", ["simulate", "campaign", "fit", "scan"])
def test_a_folder_that_cannot_be_made_is_told_before_the_work(name: str, tmp_path: Path) -> None:
    """The work would fail by another error, or tell its progress."""
    (tmp_path / "file").write_text("")

    def never(*_: object) -> object:
        raise AssertionError("the work has begun")

    calls: dict[str, Callable[[Path], object]] = {
        "simulate": lambda out: vericone.simulate(SCENARIOS / "avoidance.yaml", progress=never, out=out),
        "campaign": lambda out: vericone.campaign(montecarlo.Campaign(engagements=5), threads=1, progress=never, out=out),
        "fit": lambda out: vericone.fit(dumbbell(), progress=never, out=out),
        "scan": lambda out: vericone.scan(tmp_path / "none.yaml", out=out)}
    for out in ("file", "file/a/b"):
        with pytest.raises(vericone.InputError, match=f"out: got .*/{out}, must be a folder; .*/file is a file"):
            calls[name](tmp_path / out)
    if name != "campaign":  # it leaves what it has done, to go on with
        with pytest.raises((AssertionError, vericone.InputError)):
            calls[name](tmp_path / "new/folder")
        assert os.listdir(tmp_path) == ["file"]


# Campaigns -------------------------------------------------------------------------------------------------------------


def test_campaigns_are_those_of_the_command(tmp_path: Path) -> None:
    command("campaign", "--engagements", "60", "--seed", "7", "--no-figures", "--quiet", "--out", str(tmp_path / "command"))
    settings = montecarlo.Campaign(engagements=60, seed=7)
    found = vericone.campaign(settings, out=tmp_path / "package", threads=2)
    assert found.finished and found.violations == 0 and found.summary.engagements == 60
    theirs = tmp_path / "command" / "engagements.csv"
    assert theirs.read_bytes() == (tmp_path / "package" / "engagements.csv").read_bytes()
    read = vericone.read_table(theirs)
    assert found.rows.dtype == read.dtype and found.rows.tolist().__repr__() == read.tolist().__repr__()
    summary = json.loads((tmp_path / "command" / "summary.json").read_text())
    assert summary["straight"]["avoided"] == found.summary.straight.avoided
    assert [law["avoided"] for law in summary["laws"]] == [law.counts.avoided for law in found.summary.laws]


def test_campaigns_go_on_where_they_were_stopped(tmp_path: Path) -> None:
    settings = montecarlo.Campaign(engagements=230, laws=["exact"])
    stopped = vericone.campaign(settings, out=tmp_path, threads=2, progress=lambda share: share < 0.4)
    partial = tmp_path / "engagements.csv.partial"
    assert not stopped.finished and 0 < len(stopped.rows) < 230 and partial.exists()
    lines = partial.read_text(encoding="utf-8").splitlines(True)
    partial.write_text("".join(lines[:5] + lines[4:]), encoding="utf-8")  # a row twice
    with pytest.raises(vericone.InputError, match="out: got .* has row 3 in line 6"):
        vericone.campaign(settings, out=tmp_path)
    partial.write_text("".join(lines) + "99,half a li", encoding="utf-8")  # as a killed one leaves it
    with pytest.raises(vericone.InputError, match="other settings"):
        vericone.campaign(montecarlo.Campaign(engagements=230, laws=["slice"]), out=tmp_path)
    shares: list[float] = []
    finished = vericone.campaign(settings, out=tmp_path, threads=1, progress=shares.append)
    assert finished.finished and not partial.exists() and shares[0] * 230 > len(stopped.rows)
    whole = vericone.campaign(settings, threads=2)
    assert finished.rows.tolist().__repr__() == whole.rows.tolist().__repr__()


def test_two_campaigns_do_not_write_to_one_folder(tmp_path: Path) -> None:
    settings = montecarlo.Campaign(engagements=60)

    def second(_: float) -> bool:
        with pytest.raises(vericone.InputError, match="out: got .*no other run is writing to"):
            vericone.campaign(settings, out=tmp_path)
        done = subprocess.run([COMMAND, "campaign", "-N", "60", "--out", str(tmp_path)], capture_output=True, text=True, check=False)
        assert done.returncode != 0 and "no other run is writing to" in done.stderr
        return False

    assert not vericone.campaign(settings, out=tmp_path, progress=second).finished
    assert vericone.campaign(settings, out=tmp_path).finished


# Fits ------------------------------------------------------------------------------------------------------------------


def dumbbell() -> Array:
    """Points on two spheres that touch: what one ellipsoid encloses badly."""
    random = np.random.default_rng(1)
    points = random.normal(size=(400, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    points[::2, 0] += 1.5
    points[1::2, 0] -= 1.5
    return points


def test_fits_are_those_of_the_command(tmp_path: Path) -> None:
    file = tmp_path / "points.ply"
    files.write_points(file, dumbbell())
    command("fit", str(file), "--shape", "biconvex", "--no-figures", "--quiet", "--out", str(tmp_path / "command"))
    result = vericone.fit(file, shape="biconvex", out=tmp_path / "package")
    assert result.certified and result.certificate.points_inside == 400
    for name in ("body.yaml", "hull.obj", "hull.ply"):
        assert (tmp_path / "command" / name).read_bytes() == (tmp_path / "package" / name).read_bytes()
    theirs, ours = (json.loads((tmp_path / by / "fit.json").read_text()) for by in ("command", "package"))
    for apart in ("seconds", "seconds_read"):
        del theirs[apart], ours[apart]
    assert theirs == ours
    assert json.loads((tmp_path / "package" / "provenance.json").read_text())["version"] == vericone.__version__
    # The body in a scene encloses the points.
    body = scenes.read_body(tmp_path / "package" / "body.yaml")
    assert body.quadric() is not None


def test_a_file_that_was_written_again_is_read_again(tmp_path: Path) -> None:
    corners = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    (tmp_path / "scene.yaml").write_text("agent: {center: [0, 0, 0], semi_axes: [1, 1, 1]}\nobstacle: {mesh: m.off, center: [5, 0, 0]}\n")
    for size in (1.0, 2.0):
        files.write_points(tmp_path / "m.off", size * corners, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
        pieces = vericone.read_scene(tmp_path / "scene.yaml").obstacle.pieces()
        assert pieces is not None and pieces.bounds().high.tolist() == [size] * 3


def test_fits_take_points_meshes_and_files(tmp_path: Path) -> None:
    points = dumbbell()
    assert vericone.fit(points, shape="ellipsoid").pieces == vericone.fit(points.tolist(), shape="ellipsoid").pieces
    corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
    triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    files.write_points(tmp_path / "mesh.off", corners, triangles)
    of_file = vericone.fit(tmp_path / "mesh.off", shape="ellipsoid")
    assert of_file.pieces == vericone.fit((corners, triangles), shape="ellipsoid").pieces
    mesh = files.triangle_mesh(files.read_points(tmp_path / "mesh.off"))
    assert of_file.pieces == vericone.fit(mesh, shape="ellipsoid").pieces
    assert of_file.certificate.triangles_inside == 4


def test_fits_tell_what_they_do_and_stop() -> None:
    told: list[tuple[str, float]] = []
    vericone.fit(dumbbell(), progress=lambda what, share: told.append((what, share)))
    assert told[0][0] == "reading the points" and [share for _, share in told] == sorted(share for _, share in told)
    with pytest.raises(KeyboardInterrupt):
        vericone.fit(dumbbell(), progress=lambda what, share: share < 0.5)


# Scans -----------------------------------------------------------------------------------------------------------------


needs_scans = pytest.mark.skipif(not (ROOT / "build/scans/elephant.off").exists(),
                                 reason="build/scans/elephant.off is not there: ./run unpacks it from libcgal-demo")


@needs_scans
def test_scans_are_those_of_the_command(tmp_path: Path) -> None:
    if not Path(COMMAND).with_name("vericone-scan").exists():
        pytest.skip("this build has no vericone scan")
    probe = subprocess.run([COMMAND, "scan", str(ROOT / "docs/examples/scan.yaml"), "--levels", "1", "--no-figures", "--quiet",
                            "--out", str(tmp_path)], capture_output=True, text=True, check=False)
    assert probe.returncode == 0, probe.stderr
    found = vericone.scan(ROOT / "docs/examples/scan.yaml", levels=1, out=tmp_path / "ours")
    read = files.read_points(tmp_path / "cloud.ply")
    assert same_bits(np.asarray(read.points), found.points)
    study = json.loads((tmp_path / "scan.json").read_text())
    assert found.study is not None and study["cloud"]["points"] == len(found.points)
    assert study["levels"][0]["cone"]["solid_angle"] == found.study.levels[0].cone.solid_angle
    for name in ("cloud.ply", "section.json"):
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / name).read_bytes()
    ours = json.loads((tmp_path / "ours/scan.json").read_text())
    for one in (*study["levels"], *ours["levels"]):
        for seconds in [key for key in one if key.startswith("seconds")]:
            del one[seconds]
    assert ours == study and found.cone is not None and len(found.cone.planes) == 36
    assert json.loads((tmp_path / "ours/provenance.json").read_text())["inputs"][0]["sha256"]
    assert vericone.scan(ROOT / "docs/examples/scan.yaml", levels=1, study=False).study is None
    with pytest.raises(vericone.InputError, match="study: got False"):
        vericone.scan(ROOT / "docs/examples/scan.yaml", study=False, out=tmp_path / "none")
    assert not (tmp_path / "none").exists()


# Scenes and files ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["biconcave", "first", pytest.param("mesh", marks=needs_scans), "planar", "source-5.4.2", "source-6.5", "window"])
def test_scenes_are_written_as_they_are_read(name: str, tmp_path: Path) -> None:
    scene = vericone.read_scene(ROOT / f"docs/examples/{name}.yaml")
    vericone.write_scene(scene, tmp_path / "scene.yaml")
    read = vericone.read_scene(tmp_path / "scene.yaml")
    assert read.agent.placed.pose == scene.agent.placed.pose and read.obstacle.placed.pose == scene.obstacle.placed.pose
    assert (read.agent.velocity == scene.agent.velocity).all() and (read.obstacle.velocity == scene.obstacle.velocity).all()
    for ours, theirs in ((read.agent, scene.agent), (read.obstacle, scene.obstacle)):
        assert ours.name == theirs.name
        if theirs.quadric() is not None:
            assert ours.quadric() == theirs.quadric()
    velocities = np.random.default_rng(1).normal(size=(200, 3))
    if scene.planar is not None:
        velocities[:, 2] = 0
    assert (read.pair().verdict(velocities, [0, 0, 0]) == scene.pair().verdict(velocities, [0, 0, 0])).all()


def test_scenes_of_programs_are_written(tmp_path: Path) -> None:
    agent = vericone.Ellipsoid.from_axes([0, 0, 0], [1, 2, 3], vericone.rotation_from_heading(0.3, 0.2))
    scene = scenes.Scene(
        agent=scenes.SceneBody(placed=vericone.Placed(vericone.Body(agent)), velocity=[1, 0, 0]),
        obstacle=scenes.SceneBody(placed=vericone.Placed(vericone.Body(vericone.Assembly.cloud(dumbbell() + 9, 0.1)))))
    vericone.write_scene(scene, tmp_path / "pair.yaml")
    assert sorted(os.listdir(tmp_path)) == ["pair-obstacle.ply", "pair.yaml"]
    read = vericone.read_scene(tmp_path / "pair.yaml")
    assert read.agent.ellipsoid() == agent
    assert read.obstacle.pieces().size() == 400  # type: ignore[union-attr]


HULL = vericone.HullBody(np.array([[0.1, 0, 0], [1, 0, 0], [0, 1.3, 0], [0, 0, 1]]))
MOVED = vericone.Pose(position=[0.1, 7.0, 0.3], rotation=[[0, -1, 0], [1, 0, 0], [0, 0, 1]])


@pytest.mark.parametrize("other", [vericone.Ellipsoid(), vericone.Assembly.mesh(HULL.points(), [[0, 1, 2], [1, 2, 3]]), HULL])
@pytest.mark.parametrize("pose", [vericone.Pose(), MOVED])
def test_hulls_of_programs_are_written(other: Any, pose: vericone.Pose, tmp_path: Path) -> None:
    """As agents, as obstacles, and alone; with a pose or without. They read back as assemblies of one, or as hulls."""
    def points(placed: vericone.Placed) -> Any:
        hull, pieces = placed.body.hull(), placed.body.assembly()
        if hull is None:
            assert pieces is not None and pieces.size() == 1
            hull = pieces.by_slot().hulls[0]
        return np.asarray(hull.points()).tolist()

    hull = scenes.SceneBody(placed=vericone.Placed(vericone.Body(HULL), pose))
    beside = scenes.SceneBody(placed=vericone.Placed(vericone.Body(other)))
    for n, (agent, obstacle) in enumerate([(hull, beside), (beside, hull), (hull, hull)]):
        file = tmp_path / f"scene-{n}.yaml"
        vericone.write_scene(scenes.Scene(agent=agent, obstacle=obstacle), file)
        read = vericone.read_scene(file)
        for ours, theirs in ((read.agent, agent), (read.obstacle, obstacle)):
            assert ours.placed.pose == theirs.placed.pose
            if theirs is hull:
                assert points(ours.placed) == np.asarray(HULL.points()).tolist()
        velocities = np.random.default_rng(1).normal(size=(50, 3))
        given = vericone.Pair(agent.placed, obstacle.placed)
        assert (read.pair().verdict(velocities, [0, 0, 0]) == given.verdict(velocities, [0, 0, 0])).all()
    scenes.write_body(hull, tmp_path / "body.yaml")
    assert points(scenes.read_body(tmp_path / "body.yaml").placed) == np.asarray(HULL.points()).tolist()


def test_an_ellipsoid_with_a_pose_is_refused(tmp_path: Path) -> None:
    ellipsoid = vericone.Ellipsoid.from_axes([0, 0, 0], [1, 2, 3])
    moved = scenes.SceneBody(placed=vericone.Placed(vericone.Body(ellipsoid), MOVED))
    with pytest.raises(vericone.InputError, match=r"obstacle: got ellipsoid, must be .* without a pose \(in_world\(\) makes one\)"):
        vericone.write_scene(scenes.Scene(obstacle=moved), tmp_path / "scene.yaml")
    there = scenes.SceneBody(placed=vericone.Placed(vericone.Body(vericone.in_world(ellipsoid, MOVED))))
    vericone.write_scene(scenes.Scene(obstacle=there), tmp_path / "scene.yaml")
    assert vericone.read_scene(tmp_path / "scene.yaml").obstacle.ellipsoid() == vericone.in_world(ellipsoid, MOVED)


@pytest.mark.parametrize("name", ["cloud.ply", "cloud.pcd", "cloud.xyz", "mesh.ply", "mesh.obj", "mesh.off"])
def test_points_are_written_as_they_are_read(name: str, tmp_path: Path) -> None:
    points = dumbbell() * 1e-7
    triangles = np.arange(399, dtype=np.uint32).reshape(-1, 3) if name.startswith("mesh") else np.empty((0, 3), np.uint32)
    files.write_points(tmp_path / name, points, triangles)
    read = files.read_points(tmp_path / name)
    assert same_bits(np.asarray(read.points), points)
    assert [list(face) for face in read.faces] == triangles.tolist()


def test_files_that_cannot_be_written_are_errors_of_the_system(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for write in (lambda path: files.write_points(path, [[0.0, 0, 0]]), lambda path: vericone.scenes.write_body(scenes.SceneBody(), path)):
        with pytest.raises(FileNotFoundError, match="could not write .*none"):
            write(tmp_path / "none/a.ply")
        with pytest.raises(NotADirectoryError, match="could not write .*file"):
            write(tmp_path / "file/a.ply")


def test_writing_refuses_what_no_file_holds(tmp_path: Path) -> None:
    with pytest.raises(vericone.InputError) as raised:
        files.write_points(tmp_path / "a.ply", [[0.0, float("nan"), 0.0]])
    assert raised.value.field == "points[0][1]" and not os.listdir(tmp_path)


def test_the_page_of_files_and_runs_says_what_works(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its blocks, one after the other, in a folder that has docs/ beside."""
    (tmp_path / "docs").symlink_to(ROOT / "docs")
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs/howto/python-files.md").read_text(encoding="utf-8")
    blocks = [part.split("```")[0] for part in page.split("```python\n")[1:]]
    assert len(blocks) >= 4
    names: dict[str, Any] = {}
    for block in blocks:
        exec(compile(block, "python-files.md", "exec"), names)  # noqa: S102
    assert (tmp_path / "copy.yaml").exists() and (tmp_path / "out/fit/body.yaml").exists()
    assert names["unit"] == "m/s" and same_bits(names["speed"], names["bodies"]["speed"])
    assert names["found"].violations == 0 and names["result"].certified


@pytest.mark.parametrize(("origin", "field"), [({"provenance": "{"}, "origin.provenance"), ({"file": "no/such.yaml"}, "origin.file"),
                                               ({"file": "/"}, "origin.file")])
def test_a_run_refuses_its_origin_before_it_writes(tmp_path: Path, origin: dict[str, str], field: str) -> None:
    scenario = vericone.read_scenario(next(SCENARIOS.glob("*.yaml"))).replace(duration=0.01)
    run = vericone.simulation.simulate(scenario)
    with pytest.raises(vericone.InputError) as raised:
        vericone.scenario.write_run(scenario, run, vericone.scenario.RunOrigin(**origin), tmp_path)
    assert raised.value.field == field and not os.listdir(tmp_path)


def test_what_is_too_long_to_print_prints_short() -> None:
    body = vericone.exact.RationalBody2([Fraction(1, 3**9000), 0], [[1, 0], [0, 1]])
    assert "bits>" in repr(body) and len(repr(body)) < 300
    assert "<class 'int'>" in repr(vericone.ConeMapOptions(progress=int))
