# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the Python package share. They import it from PYTHONPATH, the folder python/ of a build.
Environment: VERICONE_SOURCE (the project), VERICONE_BUILD (the build), VERICONE (the command)."""

import os
import sys
from pathlib import Path

import pytest

# Programs that look for wrong calls, in processes of their own; tests use parts of them.
sys.path.insert(0, str(Path(__file__).parent / "search"))


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "campaign: takes long; run by campaigns alone (ctest -L campaign)")


@pytest.fixture(scope="session")
def source() -> Path:
    """The project."""
    return Path(os.environ["VERICONE_SOURCE"])


@pytest.fixture(scope="session")
def build() -> Path:
    """The build folder."""
    return Path(os.environ["VERICONE_BUILD"])
