# SPDX-License-Identifier: BSD-3-Clause
"""`import vericone` is light: what is large is loaded by the first use of what needs it."""

import subprocess
import sys

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
