# SPDX-License-Identifier: BSD-3-Clause
"""Wheels of what CMake builds: configures, builds and takes the folder python/NAME of the build into the wheel.

VERICONE_BUILD_FOLDER names a build that is there already, with -DVERICONE_PYTHON=ON: it is brought up to date, and
nothing is compiled twice. Without it the build is build/wheel, with every part whose packages are installed.
VERICONE_WHEEL=core takes the core's module alone, which needs no library but those of C and C++.
"""

import atexit
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path
from typing import Sequence

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]

# What the modules are made of besides the core, each after those that it needs.
PARTS = ("FILES", "OCTOMAP", "SIMULATION", "SCENES", "FITTING", "LIDAR", "VISION")


def version() -> str:
    """The one of CMakeLists.txt."""
    found = re.search(r"project\(vericone VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
    assert found
    return found.group(1)


VERSION = version()


def run(*command: str) -> str:
    """Prints what the command prints; all of it, if it fails."""
    try:
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
    except FileNotFoundError:
        sys.exit(f"vericone: {command[0]} is not there; install the package {command[0]}")
    except subprocess.CalledProcessError as error:
        sys.exit(f"{error.stdout}\nvericone: {' '.join(command)} ended with status {error.returncode}")


def configure(folder: Path, *options: str) -> bool:
    """Whether CMake finds all that these options need."""
    generator = ["-G", "Ninja"] if shutil.which("ninja") and not (folder / "CMakeCache.txt").exists() else []
    command = ["cmake", "-S", str(ROOT), "-B", str(folder), *generator, *(f"-DVERICONE_{option}" for option in options)]
    return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False).returncode == 0


def own_build(*more: str) -> Path:
    """A build of the wheel's own, with all parts that can be configured here."""
    folder = ROOT / "build/wheel"
    base = ("CORE_ONLY=ON", "PYTHON=ON", "TESTS=OFF", *more)
    if not configure(folder, *base, *(f"{part}=ON" for part in PARTS)):
        # One by one: what does not find its packages is left out, and says so when it is imported.
        run("cmake", "-S", str(ROOT), "-B", str(folder), *(f"-DVERICONE_{option}" for option in base),
            *(f"-DVERICONE_{part}=OFF" for part in PARTS))
        for part in PARTS:
            if not configure(folder, f"{part}=ON"):
                print(f"vericone: built without VERICONE_{part}: its packages are not installed (packages.txt)")
                configure(folder, f"{part}=OFF")
    return folder


class CMakeBuild(build_ext):
    """Builds one target and takes the folder of its package."""

    wheel: str
    target: str

    def run(self) -> None:
        if getattr(self, "editable_mode", False) or self.inplace:
            sys.exit("vericone: an editable installation is not made; set PYTHONPATH to python/ of a build instead")
        given = os.environ.get("VERICONE_BUILD_FOLDER")
        if given is None:
            folder = own_build(*(["VERIFY=ON"] if self.wheel == "vericone_verify" else []))
        else:
            folder = Path(given) if Path(given).is_absolute() else ROOT / given
            if not (folder / "CMakeCache.txt").exists():
                sys.exit(f"VERICONE_BUILD_FOLDER: got {given}, must be a folder that CMake has configured")
        run("cmake", "--build", str(folder), "--target", self.target, "--parallel", str(os.cpu_count() or 1))
        self.take(folder / "python" / self.wheel)

    def take(self, built: Path) -> None:
        suffix = sysconfig.get_config_var("EXT_SUFFIX")
        modules = list(built.glob("*.so"))
        others = [module.name for module in modules if not module.name.endswith(suffix)]
        if not modules or others:
            sys.exit(f"vericone: {built} has modules {others or 'of no kind'}, must have some for this Python ({suffix})")
        taken = Path(self.build_lib) / self.wheel
        shutil.rmtree(taken, ignore_errors=True)
        left_out = ["__pycache__"]
        if os.environ.get("VERICONE_WHEEL") == "core":
            left_out += [module.name for module in modules if not module.name.startswith("_core.")]
        shutil.copytree(built, taken, ignore=shutil.ignore_patterns(*left_out))


def set_up(package: str, target: str, needs: Sequence[str] = ()) -> None:
    """Calls setuptools. Its own files lie in build/ while it runs, and nowhere else in the tree."""
    base = Path("build")
    base.mkdir(exist_ok=True)
    work = os.path.relpath(tempfile.mkdtemp(prefix="setuptools-", dir=base))
    atexit.register(shutil.rmtree, work, ignore_errors=True)
    command = type("build_ext", (CMakeBuild,), {"wheel": package, "target": target})
    setup(
        version=VERSION,
        packages=[],
        # Without sources: it says that the wheel is of one kind of machine, and calls CMake.
        ext_modules=[Extension(f"{package}._core", sources=[])],
        cmdclass={"build_ext": command},
        options={"build": {"build_base": work}, "egg_info": {"egg_base": work}},
        **({"install_requires": list(needs)} if needs else {}),
    )
