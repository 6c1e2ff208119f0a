# SPDX-License-Identifier: BSD-3-Clause
"""Runs to look at: folders that `vericone simulate` writes, and what their tables hold."""
import csv
import json
import math
import os

from command import run

HOSTILE = "</script><img src=x onerror=document.body.remove()>"
MESH = "OFF\n8 6 0\n" + "".join("%d %d %d\n" % (x, y, z) for x in (0, 1) for y in (-1, 1) for z in (-1, 1)) + \
       "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n"


def agents(count, d, duration=4.0, step=0.05):
    """On a ring, each on its way to the other side; names are hostile."""
    bodies = []
    for i in range(count):
        at = [8 * math.cos(2 * math.pi * i / count), 8 * math.sin(2 * math.pi * i / count), 0][:d]
        bodies.append({"name": HOSTILE if i == 1 else "A%d" % i, "shape": {"semi_axes": [0.5, 0.3, 0.3][:d]}, "position": at,
                       "velocity": [-x / 4 for x in at],
                       "pilot": {"law": "clearance", "most": 6, "clearance": {"required": 0.3},
                                 "goal": {"point": [-x for x in at], "most": 3, "reached": 0.5}}})
    return {"duration": duration, "step": step, "bodies": bodies}


def kinds():
    """A body of every kind, at rest but for one."""
    changing = {"offset": 0.5, "amplitude": 0.3, "rate": 2}
    still = {"velocity": [0, 0, 0]}
    return {"duration": 2, "step": 0.1, "bodies": [
        {"name": "ball", "shape": {"semi_axes": [1, 1, 1]}, "position": [0, 0, 0], "velocity": [4, 0, 0]},
        {"name": "box", "shape": {"mesh": "box.off"}, "position": [4, 5, 0], **still},
        {"name": "late", "shape": {"dented": [1, 2, 1], "k": changing}, "position": [4, -6, 0], "appears": 1, **still},
        {"name": "waist", "shape": {"semi_axes": [2, 1, 1], "hyperboloids": [{"sheets": 1, "semi_axes": [1, 0.5, 0.5]}]},
         "position": [4, 0, 6], **still},
        {"name": "hull", "shape": {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "position": [5, 0.2, 0.1], **still},
        {"name": "cloud", "shape": {"cloud": "box.off", "radius": 0.1}, "position": [-6, 0, 0], **still},
        {"name": "union", "position": [4, 9, 0], **still, "shape": {"pieces": [
            {"center": [0, 0, 0], "semi_axes": [1, 1, 1]}, {"center": [1, 0, 0], "semi_axes": [1, 1, 1]}]}}]}


def simulate(scenario, folder, *more):
    """The folder of a run of it."""
    with open(os.path.join(folder, "box.off"), "w", encoding="utf-8") as f:
        f.write(MESH)
    path = os.path.join(folder, "scenario.yaml")
    with open(path, "w", encoding="utf-8") as f:
        json.dump(scenario, f)
    out = os.path.join(folder, "run")
    result = run("simulate", path, "--quiet", "--no-figures", "--out", out, *more)
    assert result.returncode == 0, result.stderr
    return out


def table(folder, name):
    with open(os.path.join(folder, name), newline="", encoding="utf-8") as f:
        return list(csv.DictReader(f))
