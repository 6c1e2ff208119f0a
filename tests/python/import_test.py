# SPDX-License-Identifier: BSD-3-Clause
"""`import vericone` is light: what is large is loaded by the first use of what needs it."""

import subprocess
import sys
from pathlib import Path

import pytest
import vericone

HEAVY_LIBRARIES = ("Open3D", "libopencv", "libceres", "embree", "liboctomap", "libav", "libgdal", "libvtk")
HEAVY_MODULES = ("matplotlib", "pandas", "scipy", "IPython", "cv2", "open3d", "pytest")


def loaded(code: str) -> tuple[list[str], list[str]]:
    """Files of shared libraries and names of modules, after this code in a Python of its own."""
    report = "import sys\nprint(*sorted({line.split()[-1] for line in open('/proc/self/maps') if '.so' in line}))\nprint(*sorted(sys.modules))"
    done = subprocess.run([sys.executable, "-c", f"{code}\n{report}"], capture_output=True, text=True, check=True)
    libraries, modules = done.stdout.splitlines()[-2:]
    return libraries.split(), modules.split()


def test_nothing_heavy_is_loaded() -> None:
    libraries, modules = loaded("import vericone")
    assert any("vericone/_core" in name for name in libraries)
    assert [name for name in libraries if any(heavy in name for heavy in HEAVY_LIBRARIES)] == []
    assert [name for name in modules if name.split(".")[0] in HEAVY_MODULES] == []


def test_only_the_core_module_is_loaded() -> None:
    libraries, _ = loaded("import vericone")
    assert [name for name in libraries if "/vericone/" in name and "vericone/_core" not in name] == []


def test_beside_numpy_little_is_loaded() -> None:
    """The modules of Python and files of libraries that it brings besides numpy's own: few enough for 0.15 s."""
    with_it, without = loaded("import vericone"), loaded("import numpy, enum, fractions")
    assert len(set(with_it[0]) - set(without[0])) <= 12
    assert len(set(with_it[1]) - set(without[1])) <= 40


SPACES = sorted({path.stem for path in Path(vericone.__file__).parent.glob("*.pyi")} - {"__init__", "_root"})
LOOKED_AT = """
import enum
for name, kind in vars(space).items():
    if isinstance(kind, type) and not issubclass(kind, (enum.Enum, BaseException)) and not name.startswith("_"):
        try:
            value = kind()
        except TypeError:  # it has no default
            continue
        repr(value)
        for part in dir(value):
            getattr(value, part)
"""


@pytest.mark.parametrize("name", [name for name in SPACES if not name.startswith("_")])
def test_a_module_brings_the_types_of_its_records(name: str) -> None:
    """Imported alone: what its records hold can be looked at, also where another module has its type."""
    pytest.importorskip(f"vericone.{name}", reason=f"vericone.{name} is not built")
    subprocess.run([sys.executable, "-c", f"import vericone.{name} as space\n{LOOKED_AT}"], check=True)
