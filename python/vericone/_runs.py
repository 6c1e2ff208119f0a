# SPDX-License-Identifier: BSD-3-Clause
"""What the commands `simulate`, `campaign`, `fit` and `scan` do, as functions: from files, arrays or values to values, and
to the same files where asked. They are attributes of the package: vericone.simulate and so on."""

from __future__ import annotations

import collections
import contextlib
import importlib
import itertools
import math
import numbers
import operator
import os
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Union

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from concurrent.futures import Executor, Future

    from . import InputError, Placed, VisibleCone, files, fits, fitting, montecarlo, scanning, scenes, simulation

__all__ = ["Campaign", "Scanned", "as_frame", "campaign", "fit", "load", "read_scenario", "read_scene", "read_table", "run_tables",
           "scan", "simulate", "units", "write_scene"]

PathLike = Union[str, "os.PathLike[str]"]
# Called with the share done, 0 to 1; False stops.
Progress = Callable[[float], object]
Array = npt.NDArray[Any]


def _part(name: str) -> Any:
    """A module of the package, loaded when it is needed: importing the package loads no file reader and no solver."""
    return importlib.import_module("vericone." + name)


def _refuse(field: str, value: object, requirement: str) -> InputError:
    error: InputError = importlib.import_module("vericone").InputError(field, str(value), requirement)
    return error


def _wrong_kind(field: str, value: object, requirement: str) -> TypeError:
    return TypeError(f"{field}: got {type(value).__name__}, must be {requirement}")


def _is_path(value: object) -> bool:
    return isinstance(value, (str, os.PathLike))


def _path(field: str, value: Any, what: str = "the path of a file") -> str:
    if not _is_path(value):
        raise _wrong_kind(field, value, what)
    path = os.fsdecode(value)
    if "\0" in path:
        raise _refuse(field, repr(path), what)
    return path


def _require_callable(field: str, value: object) -> None:
    if value is not None and not callable(value):
        raise _wrong_kind(field, value, "a function, or None")


@contextlib.contextmanager
def _whole(folder: PathLike) -> Iterator[str]:
    """A folder within `folder` whose files are moved to it together at the end, or are gone."""
    staged = _part("work").StagedFolder(_path("out", folder, "the path of a folder"))
    try:
        yield str(staged.path())
        staged.publish()
    finally:
        staged.abandon()


def _require_folder(out: PathLike | None) -> None:
    """What keeps a folder from being written to is told before the work. Nothing is left of the trial."""
    if out is not None:
        with _whole(out):
            pass


def _provenance(call: str, inputs: Sequence[str]) -> str:
    """What it takes to get the same result again, as the commands write it."""
    text: str = _part("work").provenance(call, 1, list(inputs))
    return text


def _share_of(progress: Progress | None, whole: float) -> Callable[[float], bool] | None:
    """What C++ calls with the part of `whole` that is done."""
    if progress is None:
        return None
    asked = progress
    return lambda done: asked(done / whole) is not False


# Scenes and scenarios --------------------------------------------------------------------------------------------------


def read_scene(file: PathLike) -> scenes.Scene:
    """The two bodies (metres), their velocities (m/s) and what they make, from a scene (YAML or JSON) and the files it
    names. Raises InputError naming the file or the field."""
    result: scenes.Scene = _part("scenes").read_scene(_path("file", file))
    return result


def load(source: Any, *, radius: float = 0.0, unknown: str = "occupied") -> Placed:
    """A body (metres) from one thing: the path of a mesh, a cloud of points (each a ball of `radius`, metres), an octree
    map (its `unknown` space "occupied" or "free"), a body's fields (YAML, JSON); or any object that has `vertices` (n, 3)
    and `faces` (m, 3), as meshes of other packages have. Raises InputError naming the file or the field."""
    package = importlib.import_module("vericone")
    made: Placed
    if not _is_path(source):
        if not (hasattr(source, "vertices") and hasattr(source, "faces")):
            raise _wrong_kind("source", source, "the path of a file, or an object with vertices and faces")
        made = package.Placed(package.Assembly.mesh(np.asarray(source.vertices), np.asarray(source.faces)))
        return made
    path = _path("source", source)
    kind = Path(path).suffix.lower()
    if kind in (".yaml", ".yml", ".json"):
        made = _part("scenes").read_body(path).placed
        return made
    if kind in (".bt", ".ot"):
        module = _part("octomap")
        if unknown not in ("occupied", "free"):
            raise _refuse("unknown", unknown, "occupied or free")
        boxes = module.obstacle_boxes(module.read_octree(path), module.OctreeMeaning(unknown_occupied=unknown == "occupied"))
        made = package.Placed(package.Assembly.boxes(boxes))
        return made
    file = _part("files").read_points(path)
    if not file.faces:
        made = package.Placed(package.Assembly.cloud(file.points, radius))
        return made
    mesh = _part("files").triangle_mesh(file)
    made = package.Placed(package.Assembly.mesh(mesh.points, mesh.triangles))
    return made


def write_scene(scene: scenes.Scene, file: PathLike) -> None:
    """Writes a scene that read_scene() reads as the same, to the bit; lengths in metres, velocities in m/s. A hull reads
    back as an assembly of one. Raises InputError naming a body that no fields give: delimited by hyperboloids, a map's
    boxes, an ellipsoid with a pose (in_world() gives one without)."""
    _part("scenes").write_scene(scene, _path("file", file))


def read_scenario(file: PathLike) -> simulation.Scenario:
    """What is to be flown, from a scenario (YAML): bodies (metres, m/s), pilots, goals, times (s). Raises InputError
    naming the file or the field."""
    result: simulation.Scenario = _part("scenario").read_scenario(_path("file", file))
    return result


# Tables ----------------------------------------------------------------------------------------------------------------


def _array(table: simulation.Table) -> Array:
    """Its rows. A unit is in the title of a field, so that array["r [m]"] is array["r"]."""
    columns = [np.array(c.words, dtype=f"U{max([1, *map(len, c.words)])}") if c.text else np.asarray(c.numbers, dtype=float)
               for c in table.columns]
    fields: list[Any] = [((f"{c.name} [{c.unit}]", c.name) if c.unit else c.name, own.dtype)
                         for c, own in zip(table.columns, columns)]
    rows = np.empty(table.rows(), dtype=fields)
    for c, own in zip(table.columns, columns):
        rows[c.name] = own
    return rows


def run_tables(scenario: simulation.Scenario, run: simulation.Run) -> dict[str, Array]:
    """What a run says, as structured arrays by name: bodies, encounters, events, and planes, sights, vehicles, orifices
    where there are any. Columns and numbers are those of the command's CSV files (docs/reference/scenarios.md); NaN is
    an empty field. units() has their units; array["V_r [m/s]"] is array["V_r"]."""
    return {table.name: _array(table) for table in _part("simulation").run_tables(scenario, run)}


def units(table: Array) -> dict[str, str]:
    """The unit of each column of a table, as "m/s"; the empty text where there is none."""
    _require_table(table)
    fields: Any = table.dtype.fields or {}
    return {name: fields[name][2][len(name) + 2:-1] if len(fields[name]) > 2 else "" for name in table.dtype.names or ()}


def as_frame(table: Array) -> Any:
    """The table as a pandas.DataFrame, with units() in its attrs["units"]. Needs pandas."""
    _require_table(table)
    frame = importlib.import_module("pandas").DataFrame({name: table[name] for name in table.dtype.names or ()})
    frame.attrs["units"] = units(table)
    return frame


def _require_table(table: object) -> None:
    if not isinstance(table, np.ndarray) or table.dtype.names is None:
        raise _wrong_kind("table", table, "a structured array, as run_tables() and read_table() return")


def read_table(file: PathLike) -> Array:
    """A CSV file of a command (bodies.csv, engagements.csv, ...) as a structured array; as run_tables(), with the units
    that its header has. Numbers are the doubles that were written. Raises InputError naming the file for one that is cut
    off, or has rows of too few or too many fields."""
    path = Path(_path("file", file, "the path of a CSV file"))
    if not path.is_file():
        raise _refuse("file", path, "the path of a CSV file")
    try:
        with open(path, encoding="utf-8", newline="") as lines:
            return _array(_part("simulation").table_of_csv(lines.read(), str(path)))
    except UnicodeDecodeError as error:
        raise _refuse(str(path), f"byte {error.object[error.start]:#04x}", "text in UTF-8") from None


# Runs ------------------------------------------------------------------------------------------------------------------


def simulate(scenario: PathLike | simulation.Scenario, *, seed: int | None = None, out: PathLike | None = None,
             progress: Progress | None = None, trial: int = 0, log: bool = True, prove: bool = True) -> simulation.Run:
    """Carries out a scenario, or the one of a file: what moved where (metres, seconds), what was commanded, what
    happened, and what is proved of it. `seed` in place of the scenario's; `trial` other noise of the same seed.

    `out`: a folder for the files of `vericone simulate` (docs/reference/scenarios.md), all of them or none: tables,
    run.json, proof.json, shapes.json, and scenario.yaml where `scenario` is a file; no pictures, which
    vericone.plot.run(out) draws. `progress` is called with the share of the duration that was flown; where it returns
    False the run ends there, `interrupted`, and nothing is written. Raises InputError naming the file or the field."""
    simulation_module, scenario_module = _part("simulation"), _part("scenario")
    if not _is_path(scenario) and not isinstance(scenario, simulation_module.Scenario):
        raise _wrong_kind("scenario", scenario, "a Scenario, or the path of its file")
    _require_callable("progress", progress)
    _require_folder(out)
    file, text = None, ""
    if isinstance(scenario, (str, os.PathLike)):
        file = Path(scenario)
        scenario = read_scenario(file)
        text = file.read_text(encoding="utf-8") if file.is_file() else ""
    changed = scenario if seed is None else scenario.replace(seed=seed)
    options = simulation_module.RunOptions(trial=trial, log=log, prove=prove, progress=_share_of(progress, changed.duration))
    start = time.perf_counter()
    run: simulation.Run = simulation_module.simulate(changed, options)
    seconds = time.perf_counter() - start
    if out is not None and not run.interrupted:
        call = f"vericone.simulate({str(file) if file else changed.name!r}, seed={seed}, trial={trial})"
        origin = scenario_module.RunOrigin(file=str(file or ""), seconds=seconds, text=text,
                                           provenance=_provenance(call, [str(file)] if file else []))
        with _whole(out) as stage:
            scenario_module.write_run(changed, run, origin, stage)
    return run


class Campaign(NamedTuple):
    """What campaign() found: `rows`, a structured array, a row for each engagement; `summary` of all; `violations`,
    how many flights met that a proved statement had called safe: none, if the theorems hold. `finished` is False
    where progress stopped it."""
    rows: Array
    summary: montecarlo.Summary
    violations: int
    finished: bool


def _engagements(settings: montecarlo.Campaign, first: int, end: int, version: str) -> str:
    """In a worker of an executor: rows of a campaign."""
    here = importlib.import_module("vericone").__version__
    if here != version:
        raise RuntimeError(f"a worker has vericone {here}, who asks has {version}")
    rows: str = _part("scenario").campaign_rows(settings, first, end)
    return rows


_AHEAD = 1000  # blocks that are with an executor: enough for some hundred workers, few enough for its memory


@contextlib.contextmanager
def _rows_by(executor: Executor | None, settings: montecarlo.Campaign) -> Iterator[Callable[[int, int], str] | None]:
    """What C++ asks for one block of rows after the other."""
    if executor is None:
        yield None
        return
    if not callable(getattr(executor, "submit", None)):
        raise _wrong_kind("executor", executor, "a concurrent.futures.Executor, or None")
    workers = executor
    version = importlib.import_module("vericone").__version__
    waiting: collections.deque[Future[str]] = collections.deque()
    begins: Iterator[int] = iter(())

    def rows(first: int, end: int) -> str:
        nonlocal begins
        size = end - first
        if not waiting:
            begins = iter(range(first, settings.engagements, size))
        for begin in itertools.islice(begins, _AHEAD - len(waiting)):
            waiting.append(workers.submit(_engagements, settings, begin, min(begin + size, settings.engagements), version))
        return waiting.popleft().result()

    try:
        yield rows
    finally:
        for future in waiting:
            future.cancel()


def campaign(settings: montecarlo.Campaign | None = None, *, out: PathLike | None = None, threads: int = 0,
             progress: Progress | None = None, resume: bool = True, executor: Executor | None = None) -> Campaign:
    """Random engagements of moving ellipsoids under every law, each with a proof of what became of it: `vericone
    campaign` (docs/measured/campaign.md). `settings` has their number, the seed, the laws and their limits (m/s^2, 1/s,
    m, s); `threads` how many work at once, 0 for all processors. 3 ms an engagement.

    `out`: a folder for engagements.csv, which grows as engagements.csv.partial: interrupted, the same call goes on
    there, or begins anew without `resume`. `progress` is called with the share done; False stops. `executor`: who flies
    them in place of threads, with the same result: a concurrent.futures.ProcessPoolExecutor, an
    mpi4py.futures.MPIPoolExecutor, that of a dask client (docs/howto/many-machines.md). Raises InputError naming a
    setting, or `out` where it holds an unfinished run of other settings."""
    module = _part("montecarlo")
    asked: montecarlo.Campaign = settings if settings is not None else module.Campaign()
    if not isinstance(asked, module.Campaign):
        raise _wrong_kind("settings", asked, "a montecarlo.Campaign, or None")
    _require_callable("progress", progress)
    try:
        threads = operator.index(threads)
    except TypeError:
        raise _wrong_kind("threads", threads, "an integer") from None
    folder = None if out is None else _path("out", out, "the path of a folder")
    with _rows_by(executor, asked) as rows:
        found = _part("scenario").fly_campaign(asked, out=folder, threads=threads, resume=resume, rows=rows,
                                               progress=_share_of(progress, 1))
    return Campaign(_array(found.table), found.summary, found.violations, found.finished)


# Fits ------------------------------------------------------------------------------------------------------------------


def _named(kind: Any, field: str, name: Any) -> Any:
    """An enumerator by its name, as commands write it."""
    if not isinstance(name, str):
        return name
    known = {member.name.rstrip("_").replace("_", "-"): member for member in kind}
    if name.replace("_", "-") not in known:
        raise _refuse(field, name, "one of " + ", ".join(known))
    return known[name.replace("_", "-")]


def _scan_of(data: Any) -> fits.Scan:
    module, fitting_module = _part("fits"), _part("fitting")
    if isinstance(data, (str, os.PathLike)):
        result: fits.Scan = module.read_scan(os.fspath(data))
        return result
    kind = module.ScanKind.cloud
    if isinstance(data, tuple) and len(data) == 2:
        data = fitting_module.Sample(points=data[0], triangles=data[1])
    elif hasattr(data, "points") and hasattr(data, "triangles"):
        data = data if isinstance(data, fitting_module.Sample) else fitting_module.Sample(points=data.points,
                                                                                        triangles=data.triangles)
    else:
        data = fitting_module.Sample(points=data)
    if len(data.triangles):
        kind = module.ScanKind.mesh
    made: fits.Scan = module.Scan(file="", format="", kind=kind, sample=data)
    return made


def fit(data: PathLike | npt.ArrayLike | tuple[npt.ArrayLike, npt.ArrayLike] | files.TriangleMesh | fitting.Sample, *,
        mode: str | fitting.Mode = "containing", shape: str | fitting.Shape | None = None, coverage: float | None = None,
        margin: float = 0.0, pieces: int = 1, seed: int = 1, out: PathLike | None = None,
        progress: Callable[[str, float], object] | None = None) -> fitting.FitResult:
    """Ellipsoids, delimited by hyperboloids where that helps, about points (metres) as `vericone fit` finds them
    (docs/explanation/fitting.md), with the proof that what was to be inside is.

    `data`: a file (mesh, cloud, octree map), points (n, 3), points and triangles, or a mesh. `mode`: "containing",
    "least-squares" or "robust"; `shape`: "ellipse", "ellipsoid", "biconcave", "biconvex", "star", or None to choose;
    `coverage`: the share of the points to be inside; `margin` (m) about each; `pieces`: the bodies of the union. `out`:
    a folder for fit.json, body.yaml, hull.obj and hull.ply. `progress` is called with what is done and its share; False
    stops with KeyboardInterrupt. Raises InputError naming the file, "points" or the option."""
    module, fits_module = _part("fitting"), _part("fits")
    _require_callable("progress", progress)
    _require_folder(out)
    tell = progress
    options = module.FitOptions(mode=_named(module.Mode, "mode", mode),
                                shape=None if shape is None or shape == "auto" else _named(module.Shape, "shape", shape),
                                coverage=coverage, margin=margin, pieces=pieces, seed=seed,
                                progress=None if tell is None else lambda what, share: tell(what, share) is not False)
    given = _scan_of(data)
    start = time.perf_counter()
    result: fitting.FitResult = module.fit(given.sample, options)
    seconds = time.perf_counter() - start
    if out is not None:
        with _whole(out) as stage:
            fits_module.write_fit(given, options, result, seconds, stage)
            call = f"vericone.fit({given.file!r}, mode={mode!r}, shape={shape!r}, coverage={coverage}, margin={margin}, " \
                   f"pieces={pieces}, seed={seed})"
            inputs = [given.file] if given.file else []
            Path(stage, "provenance.json").write_text(_provenance(call, inputs), encoding="utf-8")
    return result


# Scans -----------------------------------------------------------------------------------------------------------------


class Scanned(NamedTuple):
    """What LiDARs saw: `points` (n, 3), metres, in the world, fused where their poses were known badly (empty where that
    failed: seen.not_fused says why); `seen`, the scans themselves; `study`, how near the cones of finer and finer scans
    (sr, rad) are to that of all that can be seen; `cone`, the source's sectors of the points. The last two are None where
    they were not asked for."""
    points: Array
    seen: scanning.Seen
    study: scanning.Study | None
    cone: VisibleCone | None


def scan(scene: PathLike | scanning.Setup, *, seed: int = 1, planes: int = 36, levels: int = 5, study: bool = True,
         azimuth: float = 0.0, out: PathLike | None = None, told: Callable[[str], object] | None = None) -> Scanned:
    """What the LiDARs of a scene return of its obstacle, a mesh, and what cone they get from it: `vericone scan`
    (docs/explanation/lidar.md). `scene`: a file, or a scanning.Setup made of an agent, a mesh (metres) and LiDARs, of
    which seed, planes and levels are replaced. Without `study` the LiDARs look once, in a moment.

    `out`: a folder for cloud.ply, scan.json and section.json, the picture on the plane at `azimuth` (rad), all of them or
    none. `told` hears a line now and then. Raises InputError naming the file, the field, "agent" or "lidars"."""
    module = _part("scanning")
    if not _is_path(scene) and not isinstance(scene, module.Setup):
        raise _wrong_kind("scene", scene, "a scanning.Setup, or the path of a scene")
    if not isinstance(azimuth, numbers.Real):
        raise _wrong_kind("azimuth", azimuth, "a number (rad)")
    if not math.isfinite(azimuth):
        raise _refuse("azimuth", azimuth, "finite (rad)")
    _require_callable("told", told)
    if not study and out is not None:
        raise _refuse("study", study, "True where files are written: they hold it")
    _require_folder(out)
    read = module.read_scan_scene(os.fspath(scene)) if isinstance(scene, (str, os.PathLike)) else None
    setup = (read.setup if read else scene).replace(seed=seed, planes=planes, levels=levels)
    if not study:
        seen = module.look(setup, _part("lidar").MeshScene(setup.points, setup.triangles), setup.lidars)
        return Scanned(np.asarray(seen.points, dtype=float).reshape(-1, 3), seen, None, None)
    found = module.scan_and_study(setup, *([] if told is None else [told]))
    if out is not None:
        velocities = [read.scene.agent.velocity, read.scene.obstacle.velocity] if read else [np.zeros(3), np.zeros(3)]
        with _whole(out) as stage:
            module.write_scan(setup, found, *velocities, azimuth, stage)
            inputs = [str(scene), str(Path(scene).parent / read.scene.obstacle.file)] if read else []
            call = f"vericone.scan({str(scene) if read else 'setup'!r}, seed={seed}, planes={planes}, levels={levels}, azimuth={azimuth})"
            Path(stage, "provenance.json").write_text(_provenance(call, inputs), encoding="utf-8")
    return Scanned(np.asarray(found.seen.points, dtype=float).reshape(-1, 3), found.seen, found.study, found.cone)
