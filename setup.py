# SPDX-License-Identifier: BSD-3-Clause
"""The wheel `vericone`: what CMake builds as python/vericone, without the parts under the GPL."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python/packaging"))

from cmake_build import set_up  # noqa: E402

set_up("vericone", target="vericone_python")
