# SPDX-License-Identifier: BSD-3-Clause
"""The vericone command as a user meets it: real processes, real files. Environment: VERICONE (the program),
VERICONE_SOURCE (the project)."""
import json
import os
import subprocess

VERICONE = os.path.abspath(os.environ["VERICONE"])
SOURCE = os.environ["VERICONE_SOURCE"]


def contents(folder):
    """Of a folder's files by name, but of how it was made."""
    found = {}
    for name in sorted(os.listdir(folder)):
        if name != "provenance.json":
            with open(os.path.join(folder, name), "rb") as f:
                found[name] = f.read()
    return found


def run(*arguments, **options):
    return subprocess.run([VERICONE, *arguments], capture_output=True, text=True, check=False, **options)


def ball(center, radius):
    return {"center": center, "semi_axes": [radius] * 3}


def engagement(agent, obstacle, v_a, v_b=(0, 0, 0), id=1):
    return {"id": id, "agent": agent, "obstacle": obstacle, "agent_velocity": list(v_a), "obstacle_velocity": list(v_b)}


def query(*cases):
    result = run("query", "-", input="".join(json.dumps(c) + "\n" for c in cases))
    return result, [json.loads(line) for line in result.stdout.splitlines()]
