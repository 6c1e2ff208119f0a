# SPDX-License-Identifier: BSD-3-Clause
"""Tables as the commands write them, by the names of their columns without units."""
import csv
import os
from typing import Any

import numpy as np

from .kinds import Path

WORDS = ("body", "agent", "obstacle", "orifice", "event", "status", "unit")


def number(text: str) -> Any:
    try:
        return float(text)
    except ValueError:
        return float("nan") if text == "" else text


def rows(folder: Path, name: str) -> list[dict[str, Any]]:
    """The rows of a table, each a dictionary; none where there is no such file."""
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        return []
    with open(path, newline="", encoding="utf-8") as f:
        table = csv.reader(line for line in f if not line.startswith("#"))  # a line of settings
        names = [n.split(" [")[0] for n in next(table)]
        return [{n: v if n in WORDS else number(v) for n, v in zip(names, row)} for row in table]


def groups(table: Any, *keys: str) -> Any:
    """Columns as arrays, one group for each different value of the keys, in order of appearance."""
    found: dict[Any, Any] = {}
    for row in table:
        found.setdefault(tuple(row[k] for k in keys), []).append(row)
    return {key: {n: np.array([r[n] for r in part]) for n in part[0]} for key, part in found.items()}


def row_at(columns: Any, t: float) -> dict[str, Any]:
    """The row nearest in time."""
    i = int(np.argmin(np.abs(columns["t"] - t)))
    return {n: v[i] for n, v in columns.items()}


def goal_at(goal: Any, bodies: Any, t: float) -> Any:
    """Where a goal of run.json is at a time, metres. `bodies`: the columns of bodies.csv of each."""
    at = np.array(goal["point"]) + t * np.array(goal.get("velocity", (0, 0, 0)))
    if "follows" in goal:
        row = row_at(bodies[goal["follows"]], t)
        at = at + np.nan_to_num([row["x"], row["y"], row["z"]])
    return at
