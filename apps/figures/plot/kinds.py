# SPDX-License-Identifier: BSD-3-Clause
"""What the drawing code calls its arguments. Files that import Matplotlib tell mypy that it may be without types:
Debian's is."""
import os
from collections.abc import Mapping
from typing import Any

Array = Any  # numpy's; points (n, 3) or (n, 2), metres
Axes = Any  # Matplotlib's, of the plane or of space
Figure = Any
Data = dict[str, Any]  # as the command writes it, JSON
Shape = dict[str, Any]  # a body in its own frame, as in shapes.json
Row = Mapping[str, Any]  # a row of bodies.csv: pose and k
Path = str | os.PathLike[str]
Tables = Mapping[Any, Mapping[str, Any]]  # columns by name, one table for each body or pair
