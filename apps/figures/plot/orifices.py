# SPDX-License-Identifier: BSD-3-Clause
"""Orifices of a run (orifices.json): where their rims are at a time."""
import json
import os
from typing import Any

import numpy as np

from .kinds import Array, Data, Path
from .style import GREY

RIM = "#b08a1e"
COLORS = {"passed": "#3a8f4d", "missed": GREY, "touched": "red", "undecided": "#b07d00"}


def turned(vector: Array) -> Array:
    """The rotation by a rotation vector."""
    angle = np.linalg.norm(vector)
    if angle == 0:
        return np.eye(3)
    x, y, z = np.array(vector) / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


class Orifice:
    def __init__(self, data: Data) -> None:
        self.name, self.wall, self.appears = data["name"], data["wall"], data["appears"]
        self.position, self.velocity = np.array(data["position"]), np.array(data["velocity"])
        self.attitude, self.spin = np.array(data["rotation"]), np.array(data["spin"])
        opening = data["opening"]
        self.mesh = np.array(opening["mesh"]["triangles"]).reshape(-1, 3, 3) if "mesh" in opening else None
        if "rim" in opening:
            rim = np.array(opening["rim"])
            self.own = np.vstack([rim, rim[:1]])
            return
        if "polygon" in opening:
            corners = np.array(opening["polygon"])
            self.own = np.vstack([corners, corners[:1]])
        else:
            angle = np.linspace(0, 2 * np.pi, 73)
            self.own = np.stack([np.cos(angle), np.sin(angle)], axis=-1) * opening["semi_axes"]
        self.own = np.column_stack([self.own, np.zeros(len(self.own))])

    def center(self, t: float) -> Array:
        return self.position + (t - self.appears) * self.velocity

    def rotation(self, t: float) -> Array:
        return turned((t - self.appears) * self.spin) @ self.attitude

    def rim(self, t: float) -> Array:
        """A closed line."""
        return self.center(t) + self.own @ self.rotation(t).T

    def faces(self, t: float) -> list[Any]:
        """Of a window, the mesh around it; nothing of other orifices."""
        return [] if self.mesh is None else list(self.center(t) + self.mesh @ self.rotation(t).T)


def orifices(folder: Path) -> list[Orifice]:
    """All of a run; none of a run without."""
    path = os.path.join(folder, "orifices.json")
    if not os.path.exists(path):
        return []
    with open(path, encoding="utf-8") as f:
        return [Orifice(data) for data in json.load(f)]


def quaternion(matrix: Array) -> Array:
    """w, x, y, z of a rotation."""
    values, vectors = np.linalg.eigh(np.array([
        [matrix[0, 0] - matrix[1, 1] - matrix[2, 2], matrix[0, 1] + matrix[1, 0], matrix[0, 2] + matrix[2, 0],
         matrix[2, 1] - matrix[1, 2]],
        [0, matrix[1, 1] - matrix[0, 0] - matrix[2, 2], matrix[1, 2] + matrix[2, 1], matrix[0, 2] - matrix[2, 0]],
        [0, 0, matrix[2, 2] - matrix[0, 0] - matrix[1, 1], matrix[1, 0] - matrix[0, 1]],
        [0, 0, 0, np.trace(matrix)]]), UPLO="U")
    x, y, z, w = vectors[:, np.argmax(values)]
    return w, x, y, z
