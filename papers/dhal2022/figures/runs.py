# SPDX-License-Identifier: BSD-3-Clause
"""What the figures read: the tables of runs (docs/reference/scenarios.md), and the table that each figure writes of what it shows."""
import csv
import json
import os

import numpy as np
from matplotlib.colors import to_rgb

import style

PILOT = style.AGENT
COLORS = [style.EXACT, style.SLICE, style.OBSTACLE, "#b08a1e", style.GREY]


def table(path):
    """Columns of a CSV file; those of numbers as arrays, empty cells as NaN."""
    with open(path, newline="") as f:
        rows = list(csv.reader(f))
    columns = {}
    for name, cells in zip(rows[0], zip(*rows[1:])) if len(rows) > 1 else ((n, ()) for n in rows[0]):
        try:
            columns[name] = np.array([float(c) if c != "" else np.nan for c in cells])
        except ValueError:
            columns[name] = np.array(cells)
    return columns


def grouped(columns, *names):
    """The rows of equal names, as tables of their own, in the order of their first row."""
    keys = list(zip(*(columns[n] for n in names)))
    groups = {}
    for i, key in enumerate(keys):
        groups.setdefault(key if len(names) > 1 else key[0], []).append(i)
    return {key: {n: c[rows] for n, c in columns.items()} for key, rows in groups.items()}


class Run:
    """The folder of one run."""

    def __init__(self, folder):
        self.folder = folder
        self.bodies = grouped(table(os.path.join(folder, "bodies.csv")), "body")
        self.encounters = grouped(table(os.path.join(folder, "encounters.csv")), "agent", "obstacle")
        self.events = table(os.path.join(folder, "events.csv"))
        with open(os.path.join(folder, "shapes.json")) as f:
            self.shapes = {s["name"]: s for s in json.load(f)}

    def planes(self):
        return grouped(table(os.path.join(self.folder, "planes.csv")), "agent", "obstacle")

    def proof(self):
        with open(os.path.join(self.folder, "proof.json")) as f:
            return json.load(f)

    def agents(self):
        return list(dict.fromkeys(agent for agent, _ in self.encounters))

    def color(self, name):
        agents = self.agents()[:1]
        if name in agents:
            return PILOT
        others = [b for b in self.bodies if b not in agents]
        return COLORS[others.index(name) % len(COLORS)]

    def event(self, kind, agent, obstacle):
        """Times of events of a kind."""
        e = self.events
        return [t for t, k, a, o in zip(e["t [s]"], e["event"], e["agent"], e["obstacle"])
                if (k, a, o) == (kind, agent, obstacle)]

    def idle(self, agent):
        """Obstacles against which the agent never steered."""
        return [o for (a, o), e in self.encounters.items()
                if a == agent and not np.any((e["attended"] == 1) & (e["a [m/s^2]"] > 0))]

    def contacts(self):
        """(time, place, the two names) of each pair that is proved to touch."""
        return [(p["to"], np.array(p["place"]), (p["a"], p["b"])) for p in self.proof()["pairs"] if p["verdict"] == "touched"]

    def engaged(self, agent, obstacle, after=0.4):
        """The encounter from the appearance until shortly after the bodies have passed."""
        e = self.encounters[agent, obstacle]
        passed = self.event("passes", agent, obstacle)
        return {n: c[e["t [s]"] <= passed[0] + after] for n, c in e.items()} if passed else e


def at(body, t):
    """A row of a body's table as a dictionary: the nearest in time."""
    i = int(np.argmin(np.abs(body["t [s]"] - t)))
    return {n: c[i] for n, c in body.items()}


def dark(color):
    """For text: readable on white, and still the body's colour."""
    return tuple(0.6 * c for c in to_rgb(color))


def idle_note(run, agent):
    """What a reader misses in the curves; empty where the agent steered against all."""
    names = run.idle(agent)
    return "nothing is commanded against %s" % " and ".join(names) if names else ""


class Sheet:
    """Plots lines and keeps their points: the figure's own table."""

    def __init__(self):
        self.rows = []

    def line(self, axes, panel, series, x, y, **look):
        axes.plot(x, y, **look)
        self.add(panel, series, x, y)

    def add(self, panel, series, x, y):
        self.rows += [(panel, series, repr(float(a)), repr(float(b))) for a, b in zip(x, y) if np.isfinite(a + b)]

    def write(self, name):
        with open(os.path.join(style.folder(), name + ".csv"), "w", newline="") as f:
            writer = csv.writer(f, lineterminator="\n")
            writer.writerow(("panel", "series", "x", "y"))
            writer.writerows(self.rows)


def figure():
    """What this figure is asked to show: figure.json, with the runs opened."""
    data = style.read("figure.json")
    data["runs"] = {name: Run(os.path.join(style.folder(), path)) for name, path in data["runs"].items()}
    return data
