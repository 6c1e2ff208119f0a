#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes docs/reference/commands.md from the helps of all commands, and docs/measured/commands.md by running them:

/usr/bin/python3 tests/docs/commands.py reference build/release/apps/vericone > docs/reference/commands.md
/usr/bin/python3 tests/docs/commands.py times build/release/apps/vericone > docs/measured/commands.md

from the project's folder. commands_test.py holds the first against the helps."""

import json
import math
import os
import random
import resource
import subprocess
import sys
import tempfile
import textwrap
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "apps/completion"))
from manual import commands, help_of  # noqa: E402

# One command line for each command, which examples_test.py runs; then what is measured besides.
EXAMPLES = {
    "cone": "cone docs/examples/source-6.5.yaml --method slice --planes 72",
    "query": "query docs/examples/cases.jsonl --rung",
    "view": "view docs/examples/first.yaml --quiet",
    "merge": "merge out/part-1 out/part-2 --no-figures --out out/whole",
    "rows": "rows docs/examples/track.csv --quiet",
    "mpi": "mpi --help",
    "bands": "bands docs/examples/bands.jsonl",
    "avoid": "avoid docs/examples/avoid.jsonl",
    "robust-law": "robust-law docs/examples/robust-law.jsonl",
    "law": "law docs/examples/law.jsonl",
    "estimate": "estimate docs/examples/track.csv --noise 0.3",
    "accuracy": "accuracy -N 500 --planes 8,16,32 --no-figures --quiet",
    "signmap": "signmap --seed 12 --no-figures",
    "gallery": "gallery build/scans/elephant.off --no-figures --quiet",
    "scan": "scan docs/examples/scan.yaml --no-figures --quiet",
    "fit": "fit build/scans/elephant.off --shape ellipsoid --pieces 4 --no-figures --quiet",
    "track": "track docs/examples/street --truth docs/examples/street-truth.txt --no-figures --quiet",
    "pursue": "pursue docs/examples/pursuits/two.yaml --duration 4 --no-figures --quiet",
    "shapes": "shapes --figure notch --no-figures",
    "check": "check docs/examples/scenarios/clearance.yaml",
    "schema": "schema scan",
    "reach": "reach docs/examples/scenarios/orifices.yaml --current --quiet",
    "certify": "certify docs/examples/tracks/tracks.yaml --quiet",
    "simulate": "simulate docs/examples/scenarios/elephant.yaml --no-figures --quiet",
    "campaign": "campaign -N 500 --no-figures --quiet",
    "swarm": "swarm circle -N 30 --no-figures --quiet",
    "trials": "trials docs/examples/scenarios/noise.yaml -N 40 --levels x1,x2 --laws di,clearance --no-figures --quiet",
    "claims": "claims 5.4.2 --quiet",
    "paper": "paper new out/papers/mine",
    "figures": "figures --list",
    "verify": "verify --cases 1000 --pairs 1 --quiet",
}
STATUS = {"query": 2}  # of the examples, where it is not 0
MEASURED = [
    "cone docs/examples/first.yaml --out OUT", "cone docs/examples/source-6.5.yaml --out OUT",
    "cone docs/examples/mesh.yaml --map", "cone docs/examples/mesh.yaml --out OUT", "cone docs/examples/map.yaml",
    "cone docs/examples/map.yaml --out OUT", "accuracy -N 10000 --quiet --out OUT", "signmap --seed 12 --out OUT",
    "gallery build/scans/elephant.off --quiet --out OUT",
    "scan docs/examples/scan.yaml --quiet --out OUT",
    "fit build/scans/elephant.off --shape biconvex --quiet --out OUT", "fit build/scans/elephant.off --quiet --out OUT",
    "fit build/scans/elephant.off --shape biconvex --cone around:4 --no-figures --quiet --out OUT",
    "shapes --out OUT", "simulate docs/examples/scenarios/clearance.yaml --quiet --out OUT",
    "simulate docs/examples/scenarios/elephant.yaml --animate --quiet --out OUT",
    "simulate docs/examples/scenarios/corridor.yaml --no-figures --quiet --out OUT",
    "campaign -N 2000 --no-figures --quiet --out OUT", "figures 5.6 --quiet --out OUT", "figures --quiet --out OUT",
    "verify --quiet",
]


def reference(program):
    yield "# Commands and their options\n"
    yield filled("Every option of every command, from the helps themselves (`vericone COMMAND --help`), with an example that"
                 " runs in the project's folder. `./run COMMAND` stands for `vericone COMMAND` where nothing is installed."
                 " How long they take: [measured](../measured/commands.md). Words, units and exit statuses:"
                 " [conventions](conventions.md). This page is written by `tests/docs/commands.py`.")
    for name, summary in commands(program):
        yield f"## {name}\n\n{summary}.\n\n```text\n{help_of(program, name)}\n```\n"
        if name in EXAMPLES:
            status = f"\n$ echo $?\n{STATUS[name]}" if name in STATUS else ""
            yield f"```console\n$ ./run {EXAMPLES[name]}{status}\n```\n"


def filled(text):
    return textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False) + "\n"


def wrapped(line, width=120):
    """Lines of a help that are wider than a page are broken where the help's column of words begins."""
    out = []
    while len(line) > width:
        at = line.rfind(" ", 30, width)
        out.append(line[:at])
        line = " " * 30 + line[at + 1:]
    return "\n".join(out + [line])


def measured(program):
    today = time.strftime("%-d %B %Y")
    yield "# How long each command takes\n"
    yield filled(f"**Measured** {today}, `/usr/bin/python3 tests/docs/commands.py times build/release/apps/vericone`, on two"
                 " cores shared with other work, so these are upper bounds. **Who notices a change:** `tests/docs/examples_test.py` an"
                 " example that takes more than a minute; nobody the rest.")
    yield filled("Wall: seconds until the command ends, files and pictures included. Processor: seconds of all threads."
                 " Matplotlib takes most of the time of a command that draws; `--no-figures` leaves pictures out. The files of"
                 " a command are in OUT.")
    yield "| command | wall, s | processor, s |\n|---|---|---|"
    with tempfile.TemporaryDirectory() as folder:
        for line in [*EXAMPLES.values(), *MEASURED]:
            if line.startswith("merge "):  # of what other commands have left
                continue
            arguments = line.replace("OUT", os.path.join(folder, "out")).split()
            if "--out" not in arguments and arguments[0] not in ("query", "bands", "avoid", "check", "claims", "verify", "cone", "rows") and "--list" not in arguments:
                arguments += ["--out", os.path.join(folder, "out")]
            before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
            done = subprocess.run([program, *arguments], capture_output=True, check=False)
            wall, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
            processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            if done.returncode != STATUS.get(arguments[0], 0):
                raise SystemExit(f"{line}: {done.stderr.decode()}")
            yield f"| `{line}` | {wall:.2g} | {processor:.2g} |"
    yield ""
    yield from many_lines(program)


def many_lines(program, count=100_000):
    """What a line of `query` costs, beside what Python's json module takes to read the same file."""
    rng = random.Random(1)

    def body(*center):
        turn = [rng.gauss(0, 1) for _ in range(4)]
        return {"center": [rng.gauss(x, 4) for x in center], "semi_axes": [rng.uniform(0.5, 3) for _ in range(3)],
                "rotation": [x / math.hypot(*turn) for x in turn]}

    def velocity(x):
        return [rng.gauss(x, 2), rng.gauss(0, 2), rng.gauss(0, 2)]

    yield "## Many lines\n"
    yield filled(f"{count} lines of two ellipsoids in space, some 690 bytes each, from a file to /dev/null; Python: `json.loads` of"
                 " each line in the same run. `/usr/bin/python3 tests/docs/commands.py lines build/release/apps/vericone`")
    yield "| what | processor time a line, us | lines a second and processor | as fast as Python reads | wall, s |\n|---|---|---|---|---|"
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "cases.jsonl")
        with open(path, "w", encoding="utf-8") as file:
            for i in range(count):
                file.write(json.dumps({"id": i, "agent": body(0, 0, 0), "obstacle": body(20, 0, 0), "agent_velocity": velocity(8),
                                       "obstacle_velocity": velocity(-3)}) + "\n")
        began, wall = time.process_time(), time.monotonic()
        with open(path, encoding="utf-8") as file:
            for line in file:
                json.loads(line)
        python, wall = time.process_time() - began, time.monotonic() - wall
        rows = [("Python's `json`", python, wall)]
        for threads in (1, 2):
            runs = []
            for _ in range(3):
                before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
                subprocess.run([program, "query", path, "--threads", str(threads)], stdout=subprocess.DEVNULL, check=True)
                wall, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
                runs.append((after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall))
            rows.append((f"`query --threads {threads}`", *min(runs)))
        for what, processor, wall in rows:
            yield f"| {what} | {1e6 * processor / count:.2g} | {count / processor:.3g} | {python / processor:.2g} | {wall:.2g} |"


if __name__ == "__main__":
    what, program_path = sys.argv[1:]
    for part in {"reference": reference, "times": measured, "lines": many_lines}[what](program_path):
        print("\n".join(wrapped(line) for line in part.split("\n")))
