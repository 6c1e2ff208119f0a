# SPDX-License-Identifier: BSD-3-Clause
"""The vericone command as a user meets it: real processes, real files. Environment: VERICONE (the program),
VERICONE_SOURCE (the project)."""
import contextlib
import io
import json
import os
import subprocess
import sys

VERICONE = os.path.abspath(os.environ["VERICONE"])
SOURCE = os.environ["VERICONE_SOURCE"]
sys.path.append(os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "support"))
from drawn import drawn  # noqa: E402, F401


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


def check_certificates(path):
    """What checker/vericone_check.py does with a file, without a process of its own, which takes longer than the check."""
    sys.path.insert(0, os.path.join(SOURCE, "checker"))
    import vericone_check  # pylint: disable=import-outside-toplevel
    del sys.path[0]
    with open(path, "rb") as stream, contextlib.redirect_stdout(io.StringIO()) as said:
        statuses = vericone_check.checked(stream, path, 160 * 10 ** 6)  # as it has by itself
    return subprocess.CompletedProcess(path, 1 if 1 in statuses else max(statuses), said.getvalue(), "")


def ball(center, radius):
    return {"center": center, "semi_axes": [radius] * 3}


def engagement(agent, obstacle, v_a, v_b=(0, 0, 0), id=1):
    return {"id": id, "agent": agent, "obstacle": obstacle, "agent_velocity": list(v_a), "obstacle_velocity": list(v_b)}


def query(*cases):
    result = run("query", "-", input="".join(json.dumps(c) + "\n" for c in cases))
    return result, [json.loads(line) for line in result.stdout.splitlines()]
