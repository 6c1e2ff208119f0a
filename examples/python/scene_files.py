# SPDX-License-Identifier: BSD-3-Clause
"""A scene as the command reads it: `vericone cone biconcave.yaml` from Python."""
from pathlib import Path

import vericone as vc

folder = Path(__file__).resolve().parents[2] / "docs" / "examples"
scene = vc.scenes.read_scene(folder / "biconcave.yaml")
pair = scene.pair()
print(scene.agent.name, "and", scene.obstacle.name)
print(pair.verdict(scene.agent.velocity, scene.obstacle.velocity))
cone = pair.cone()
print("solid angle between %.4f and %.4f sr, proved" % (cone.solid_angle.lo(), cone.solid_angle.hi()))
try:
    vc.scenes.scene_of_text("agent: {center: [0, 0, 0], semi_axes: [1, -1, 1]}\nobstacle: {}\n", Path("typed.yaml"))
except vc.InputError as error:
    print("refused:", error.field)
