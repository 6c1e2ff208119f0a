# SPDX-License-Identifier: BSD-3-Clause
"""Scenes of every kind of pair, and velocities around what grazes: where verdicts change, down to neighbouring doubles."""
import json
import math
import os
import random
import struct

BALLS = "[{center: [0, 0, 0], semi_axes: [1, 0.6, 0.5]}, {center: [0.9, 0.5, 0], semi_axes: [0.4, 0.7, 0.3]}]"
DENTED = "{center: [6, 0.4, 0], semi_axes: [1.4, 1, 0.8], rotation: [0.8, 0, 0.6, 0], hyperboloids: [{sheets: %d, semi_axes: [0.6, 0.5, 0.5]}]}"
# The obstacle of each; the agent is an ellipsoid, unless it says otherwise.
AGENT = "{center: [0, 0, 0], semi_axes: [1, 0.7, 0.4], rotation: [0.6, 0, 0, 0.8]}"
SCENES = {
    "ellipsoids": (AGENT, "{center: [6, 0.4, 0.2], semi_axes: [1.5, 1, 0.6], rotation: [0.8, 0.6, 0, 0]}"),
    "shape": (AGENT, "{center: [6, 0.4, 0.2], shape: [[2, 0.3, 0.1], [0.3, 1, 0.2], [0.1, 0.2, 0.7]]}"),
    "biconcave": (AGENT, DENTED % 2),
    "waisted": (AGENT, DENTED % 1),
    "hull": (AGENT, "{points: [[5, 0, 0], [7, 0.3, 0.1], [6, 1.3, 0], [6, 0, 1.1], [5.5, -0.7, -0.4]]}"),
    "hulls": ("{points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], rotation: [0.8, 0, 0.6, 0]}",
              "{box: {half_widths: [0.5, 0.7, 0.9]}, center: [6, 0.4, 0.2]}"),
    "cylinders": ("{capsule: {radius: 0.3, length: 1}, rotation: [0.8, 0, 0.6, 0]}",
                  "{cylinder: {radius: 0.7, height: 1.1}, center: [6, 0.4, 0.2]}"),
    "margin": (AGENT, "{box: {half_widths: [0.5, 0.7, 0.9]}, margin: 0.25, center: [6, 0.4, 0.2]}"),
    "union": (AGENT, "{pieces: %s, center: [6, 0, 0], rotation: [0.8, 0, 0.6, 0]}" % BALLS),
    "mesh": (AGENT, "{mesh: mesh.obj, center: [6, 0.4, 0.2], rotation: [0.8, 0, 0.6, 0]}"),
    "cloud": (AGENT, "{cloud: mesh.obj, radius: 0.2, center: [6, 0.4, 0.2]}"),
    "plane": ("{center: [0, 0], semi_axes: [1, 0.6], rotation: 0.3}", "{center: [6, 0.5], semi_axes: [1.5, 1], rotation: 1}"),
    "dented in the plane": ("{center: [0, 0], semi_axes: [1, 0.6], rotation: 0.3}", "{center: [6, 0.5], a_c: 1, b_c: 1.2, k: 0.6, phi: 0.4}"),
}
EXACT = tuple(name for name in SCENES if name not in ("biconcave", "waisted", "dented in the plane"))
OCTAHEDRON = ("v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1.3\n"
              "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n")


def write(name, folder):
    """The scene of that name; its path."""
    with open(os.path.join(folder, "mesh.obj"), "w", encoding="utf-8") as f:
        f.write(OCTAHEDRON)
    agent, obstacle = SCENES[name]
    path = os.path.join(folder, name.replace(" ", "-") + ".yaml")
    velocity = "[1, 0.05]" if "plane" in name else "[1, 0.05, 0.02]"
    with open(path, "w", encoding="utf-8") as f:
        f.write("agent: %s\nobstacle: %s\nagent_velocity: %s\n" % (agent, obstacle, velocity))
    return path


def stepped(x, n):
    """n doubles further."""
    bits = struct.unpack("<q", struct.pack("<d", x))[0]
    place = (bits if bits >= 0 else -(bits & 0x7fffffffffffffff)) + n
    return struct.unpack("<d", struct.pack("<q", place))[0] if place >= 0 else -struct.unpack("<d", struct.pack("<q", -place))[0]


def velocities(count, planar, verdict_of, seed):
    """Random ones, and, by halving between one that collides and one that does not, the doubles around what grazes:
    half of them. `verdict_of` takes a list of velocities."""
    chosen = random.Random(seed)

    def direction():
        v = [chosen.gauss(0, 1) for _ in range(3)]
        v = [abs(v[0]) + 0.5, 0.45 * v[1], 0 if planar else 0.45 * v[2]]
        speed = 10 ** chosen.uniform(-3, 3)
        return [speed * x / math.hypot(*v) for x in v]

    found = [direction() for _ in range(count - count // 2)]
    verdicts = verdict_of(found)
    outs = [v for v, said in zip(found, verdicts) if said == "out"]
    ins = [v for v, said in zip(found, verdicts) if said in ("in", "on")]
    pairs = [[chosen.choice(ins), chosen.choice(outs)] for _ in range(max(1, count // 50))] if ins and outs else []
    for _ in range(60 if pairs else 0):
        middles = [[(a + b) / 2 for a, b in zip(*pair)] for pair in pairs]
        for pair, middle, said in zip(pairs, middles, verdict_of(middles)):
            pair[said == "out"] = middle
    ends = [v for pair in pairs for v in pair]
    while len(found) < count:
        v = list(chosen.choice(ends)) if ends else direction()
        for k in range(2 if planar else 3):
            v[k] = stepped(v[k], chosen.randint(-4, 4))
        found.append(v)
    return found


def lines_of(path, all_of_them):
    """Cases for `vericone query`, beside the scene."""
    import yaml
    with open(path, encoding="utf-8") as f:
        scene = yaml.safe_load(f)
    two = len(scene["agent_velocity"]) == 2
    for v in all_of_them:
        yield json.dumps({"agent": scene["agent"], "obstacle": scene["obstacle"], "agent_velocity": v[:2] if two else v,
                          "obstacle_velocity": [0, 0] if two else [0, 0, 0]}) + "\n"
