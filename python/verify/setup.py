# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheel `vericone-verify`: what CMake builds as python/vericone_verify."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "packaging"))

from cmake_build import VERSION, set_up  # noqa: E402

set_up("vericone_verify", target="vericone_verify_python", needs=[f"vericone=={VERSION}", "numpy>=1.24"])
