# SPDX-License-Identifier: BSD-3-Clause
"""The wheel: made from the build, installed into a fresh virtual environment, used outside of the source tree."""

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

MOST_BYTES = 24_000_000  # of the wheel, 22.1 million now: notices symbols for debuggers, or a library that is there twice

pytestmark = pytest.mark.skipif("VERICONE_PRELOAD" in os.environ, reason="a build with sanitizers is not installed")


def run(*command: str | Path, cwd: Path) -> str:
    clean = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PIP_FIND_LINKS")}
    done = subprocess.run(list(map(str, command)), cwd=cwd, capture_output=True, text=True, check=False, timeout=250,
                          env=clean | {"VERICONE_BUILD_FOLDER": os.environ["VERICONE_BUILD"]})
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory, source: Path) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    run("/usr/bin/python3", "-m", "pip", "wheel", "--no-index", "--no-build-isolation", "--no-deps", "-w", folder, source, cwd=folder)
    (made,) = folder.glob("vericone-*.whl")
    return made


@pytest.fixture(scope="module")
def python(tmp_path_factory: pytest.TempPathFactory, wheel: Path) -> Path:
    """Of a fresh environment with the package, which sees numpy of the system."""
    folder = tmp_path_factory.mktemp("environment")
    run("/usr/bin/python3", "-m", "venv", "--system-site-packages", folder, cwd=folder)
    run(folder / "bin/python", "-m", "pip", "install", "--no-index", wheel, cwd=folder)
    return folder / "bin/python"


def test_the_wheel_is_small(wheel: Path) -> None:
    assert wheel.stat().st_size < MOST_BYTES


def test_the_wheel_is_of_this_python_and_machine(wheel: Path, source: Path) -> None:
    found = re.search(r"project\(vericone VERSION (\S+)", (source / "CMakeLists.txt").read_text(encoding="utf-8"))
    assert found
    tag = "cp{}{}".format(*sys.version_info)
    assert re.fullmatch(rf"vericone-{re.escape(found.group(1))}-{tag}-{tag}-linux_\w+\.whl", wheel.name)


def test_the_wheel_has_types_and_licence(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    assert {"vericone/py.typed", "vericone/__init__.pyi", "vericone/_root.pyi", "vericone/guidance.pyi"} <= names
    assert any(re.search(r"\.dist-info/(licenses/)?LICENSE$", name) for name in names)


def test_the_wheel_holds_nothing_under_the_gpl(wheel: Path) -> None:
    archive = zipfile.ZipFile(wheel)
    assert [name for name in archive.namelist() if "verify" in name] == []
    for name in archive.namelist():
        if name.endswith((".py", ".pyi", ".so")):
            content = archive.read(name)
            assert b"GPL-3.0" not in content and b"CGAL" not in content, name


def test_the_modules_name_no_folder_of_the_build(wheel: Path, tmp_path: Path) -> None:
    """Where they look for libraries is the system's business."""
    archive = zipfile.ZipFile(wheel)
    modules = [name for name in archive.namelist() if name.endswith(".so")]
    assert modules
    for name in modules:
        archive.extract(name, tmp_path)
        dynamic = run("readelf", "-d", tmp_path / name, cwd=tmp_path)
        assert "RUNPATH" not in dynamic and "RPATH" not in dynamic, name


def test_every_module_is_imported_where_it_is_installed(python: Path, tmp_path: Path) -> None:
    code = """
import importlib, pkgutil, sys
import vericone
for module in pkgutil.walk_packages(vericone.__path__, "vericone."):
    importlib.import_module(module.name)
    print(module.name)
assert vericone.__file__.startswith(sys.prefix), vericone.__file__
"""
    assert "vericone._core" in run(python, "-c", code, cwd=tmp_path).split()


def test_it_answers(python: Path, tmp_path: Path) -> None:
    """Spheres of radius 1, 10 m apart: a velocity straight at the other hits, one across it does not."""
    code = """
import numpy as np, vericone
a, b = (vericone.Ellipsoid.from_axes([x, 0, 0], [1, 1, 1]) for x in (0, 10))
pair = vericone.Pair(a, b)
print([pair.verdict(v, [0, 0, 0]).name for v in ([1, 0, 0], [0, 1, 0])])
"""
    assert run(python, "-c", code, cwd=tmp_path).strip() == "['in_', 'out']"


def test_pip_finds_no_fault(python: Path, tmp_path: Path) -> None:
    done = subprocess.run([python, "-m", "pip", "check"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert [line for line in done.stdout.splitlines() if line.startswith("vericone")] == []


def test_the_source_distribution_holds_what_a_build_reads(source: Path, tmp_path: Path) -> None:
    """Every file that CMake has read or compiled for the package, and nothing under the GPL."""
    run(sys.executable, "setup.py", "-q", "sdist", "-d", tmp_path, cwd=source)
    (archive,) = tmp_path.glob("*.tar.gz")
    assert archive.stat().st_size < MOST_BYTES
    if not (source / ".git").exists():
        pytest.skip("not a checkout: which files are the project's is not known")
    names = {name.split("/", 1)[1] for name in run("tar", "-tzf", archive, cwd=tmp_path).split() if "/" in name}
    tracked = run("git", "ls-files", "CMakeLists.txt", "cmake", "geometry", "cones", "guidance", "scenes", "vision", "python",
                  "setup.py", "pyproject.toml", "LICENSE", cwd=source).split()
    assert [name for name in tracked if name not in names and not name.startswith("python/verify/")] == []
    assert [name for name in names if name.startswith(("verify/", "python/verify/", "apps/src/verify/"))] == []
