# SPDX-License-Identifier: BSD-3-Clause
"""Reads binary glTF 2.0 from its specification alone, and finds what is wrong with a file; the project's writer is not
used. Only what the writer may write: one buffer, floats, indices of 32 bits, triangles, points, line strips, animated
translations and rotations."""
import json
import math
import os
import shutil
import struct
import subprocess

WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
KINDS = {5126: ("f", 4), 5125: ("I", 4)}


class Wrong(Exception):
    """What is not as the specification has it."""


def require(holds, what):
    if not holds:
        raise Wrong(what)


class Glb:
    def __init__(self, data):
        require(len(data) >= 28 and data[:4] == b"glTF", "header")
        version, length = struct.unpack_from("<2I", data, 4)
        require(version == 2 and length == len(data) and length % 4 == 0, "version or length")
        size, kind = struct.unpack_from("<I4s", data, 12)
        require(kind == b"JSON" and size % 4 == 0, "chunk of JSON")
        self.json = json.loads(data[20:20 + size])
        at = 20 + size
        size, kind = struct.unpack_from("<I4s", data, at)
        require(kind == b"BIN\0" and size % 4 == 0 and at + 8 + size == length, "chunk of numbers")
        self.buffer = data[at + 8:]
        self.check()

    def numbers(self, index):
        """The elements of an accessor, tuples."""
        accessor = self.json["accessors"][index]
        view = self.json["bufferViews"][accessor["bufferView"]]
        letter, size = KINDS[accessor["componentType"]]
        width, count = WIDTHS[accessor["type"]], accessor["count"]
        begin = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        require(begin % size == 0, f"accessor {index}: alignment")
        require(accessor.get("byteOffset", 0) + count * width * size <= view["byteLength"], f"accessor {index}: bounds")
        flat = struct.unpack_from(f"<{count * width}{letter}", self.buffer, begin)
        return [flat[i:i + width] for i in range(0, len(flat), width)]

    def check(self):
        file = self.json
        require(file["asset"]["version"] == "2.0" and len(file["buffers"]) == 1, "asset")
        require(0 <= len(self.buffer) - file["buffers"][0]["byteLength"] < 4, "length of the buffer")
        end = 0
        for view in file["bufferViews"]:
            require(view["buffer"] == 0 and view["byteOffset"] >= end and view["byteLength"] > 0, "buffer view")
            end = view["byteOffset"] + view["byteLength"]
        require(end <= file["buffers"][0]["byteLength"], "buffer views")
        for i, accessor in enumerate(file["accessors"]):
            elements = self.numbers(i)
            require(elements, f"accessor {i}: empty")
            require(all(math.isfinite(x) for element in elements for x in element), f"accessor {i}: finite")
            for name, choose in (("min", min), ("max", max)):
                if name in accessor:
                    bound = [choose(column) for column in zip(*elements)]
                    require(bound == accessor[name], f"accessor {i}: {name}")
        for mesh in file["meshes"]:
            for primitive in mesh["primitives"]:
                self.check_primitive(primitive)
        self.check_nodes()
        for animation in file.get("animations", []):
            for channel in animation["channels"]:
                self.check_channel(channel, animation["samplers"][channel["sampler"]])

    def check_primitive(self, primitive):
        accessor = self.json["accessors"][primitive["attributes"]["POSITION"]]
        require(accessor["type"] == "VEC3" and {"min", "max"} <= set(accessor), "positions")
        require(primitive["mode"] in (0, 3, 4) and primitive["material"] < len(self.json["materials"]), "primitive")
        if "indices" in primitive:
            indices = [x for x, in self.numbers(primitive["indices"])]
            require(len(indices) % 3 == 0 and max(indices) < accessor["count"], "indices")
        else:
            require(primitive["mode"] != 4 and accessor["count"] > (1 if primitive["mode"] == 3 else 0), "no indices")

    def check_nodes(self):
        seen, stack = [], list(self.json["scenes"][self.json["scene"]]["nodes"])
        while stack:
            seen.append(stack.pop())
            stack += self.json["nodes"][seen[-1]].get("children", [])
        require(sorted(seen) == list(range(len(self.json["nodes"]))), "nodes: each once in the tree")
        for node in self.json["nodes"]:
            require("mesh" not in node or node["mesh"] < len(self.json["meshes"]), "mesh of a node")
            require(abs(math.hypot(*node["rotation"]) - 1) < 1e-6 and "matrix" not in node, "rotation of a node")

    def check_channel(self, channel, sampler):
        times = [t for t, in self.numbers(sampler["input"])]
        require({"min", "max"} <= set(self.json["accessors"][sampler["input"]]), "bounds of times")
        require(times[0] >= 0 and all(a < b for a, b in zip(times, times[1:])), "times ascend")
        values = self.numbers(sampler["output"])
        require(len(values) == len(times) and sampler["interpolation"] == "LINEAR", "samples")
        path = channel["target"]["path"]
        require(len(values[0]) == {"translation": 3, "rotation": 4}[path], "width of samples")
        require(path != "rotation" or all(abs(math.hypot(*q) - 1) < 1e-6 for q in values), "rotations")

    def node(self, name):
        found, = (i for i, node in enumerate(self.json["nodes"]) if node["name"] == name)
        return found

    def mesh(self, name):
        """Points in the project's axes and triangles of a node: its own place and turn, without the root's."""
        node = self.json["nodes"][self.node(name)]
        primitive, = self.json["meshes"][node["mesh"]]["primitives"]
        points = [[a + b for a, b in zip(turned(node["rotation"], p), node["translation"])]
                  for p in self.numbers(primitive["attributes"]["POSITION"])]
        flat = [x for x, in self.numbers(primitive["indices"])] if "indices" in primitive else []
        return points, [flat[i:i + 3] for i in range(0, len(flat), 3)]

    def track(self, name, path):
        """[(time, value)] of a node."""
        for animation in self.json.get("animations", []):
            for channel in animation["channels"]:
                if channel["target"] == {"node": self.node(name), "path": path}:
                    sampler = animation["samplers"][channel["sampler"]]
                    return [(t, value) for (t,), value in zip(self.numbers(sampler["input"]), self.numbers(sampler["output"]))]
        return []


def turned(q, x):
    u, w = q[:3], q[3]
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]  # noqa: E731
    twice = [2 * c for c in cross(u, x)]
    return [a + w * b + c for a, b, c in zip(x, twice, cross(u, twice))]


def volume(points, triangles):
    total = 0
    for a, b, c in triangles:
        p, q, r = points[a], points[b], points[c]
        total += (p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]))
    return total / 6


def validator():
    """A command that runs Khronos' glTF-Validator on a file, or None. The folder of node_modules that has it:
    VERICONE_GLTF_VALIDATOR."""
    folder = os.environ.get("VERICONE_GLTF_VALIDATOR")
    if not folder or not shutil.which("node"):
        return None
    script = ("const v = require('gltf-validator'); v.validateBytes(new Uint8Array(require('fs').readFileSync(process.argv[1])))"
              ".then(r => console.log(JSON.stringify(r.issues)), e => {console.log(JSON.stringify({numErrors: 1, messages: [String(e)]}))})")

    def issues(path):
        done = subprocess.run(["node", "-e", script, path], capture_output=True, text=True, check=True, cwd=folder)
        return json.loads(done.stdout)
    return issues
