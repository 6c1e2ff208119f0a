# SPDX-License-Identifier: BSD-3-Clause
"""What the figures of papers read, the runs that they show, and the table that each writes of what it draws."""
import csv
import json
import os

import numpy as np
from matplotlib.colors import to_rgb

from vericone_figures import style
from plot.tables import groups, rows

COLORS = [style.EXACT, style.SLICE, style.OBSTACLE, "#b08a1e", style.GREY]


class Run:
    """The folder of one run."""

    def __init__(self, folder):
        self.folder = folder
        self.bodies = {name: columns for (name,), columns in groups(rows(folder, "bodies.csv"), "body").items()}
        self.encounters = groups(rows(folder, "encounters.csv"), "agent", "obstacle")
        self.events = rows(folder, "events.csv")
        with open(os.path.join(folder, "shapes.json"), encoding="utf-8") as f:
            self.shapes = {s["name"]: s for s in json.load(f)}

    def planes(self):
        return groups(rows(self.folder, "planes.csv"), "agent", "obstacle")

    def proof(self):
        with open(os.path.join(self.folder, "proof.json"), encoding="utf-8") as f:
            return json.load(f)

    def agents(self):
        through = groups(rows(self.folder, "orifices.csv"), "agent")
        return list(dict.fromkeys([*(agent for agent, _ in self.encounters), *(agent for agent, in through)]))

    def color(self, name):
        agents = self.agents()[:1]
        if name in agents:
            return style.AGENT
        others = [b for b in self.bodies if b not in agents]
        return COLORS[others.index(name) % len(COLORS)] if name in others else style.GREY

    def event(self, kind, agent, obstacle):
        """Times of events of a kind."""
        return [e["t"] for e in self.events if (e["event"], e["agent"], e["obstacle"]) == (kind, agent, obstacle)]

    def idle(self, agent):
        """Obstacles against which the agent never steered."""
        return [o for (a, o), e in self.encounters.items()
                if a == agent and not np.any((e["attended"] == 1) & (e["a"] > 0))]

    def idle_note(self):
        """What a reader misses in the curves; empty where the agent steered against all, and where there is none."""
        names = self.idle(self.agents()[0]) if self.agents() else []
        return "nothing is commanded against %s" % " and ".join(names) if names else ""

    def contacts(self):
        """(time, place, the two names) of each pair that is proved to touch."""
        return [(p["to"], np.array(p["place"]), (p["a"], p["b"])) for p in self.proof()["pairs"] if p["verdict"] == "touched"]

    def engaged(self, agent, obstacle, after=0.4):
        """The encounter from the appearance until shortly after the bodies have passed."""
        e = self.encounters[agent, obstacle]
        passed = self.event("passes", agent, obstacle)
        return {n: c[e["t"] <= passed[0] + after] for n, c in e.items()} if passed else e


def dark(color):
    """For text: readable on white, and still the body's colour."""
    return tuple(0.6 * c for c in to_rgb(color))


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
        with open(os.path.join(style.folder(), name + ".csv"), "w", newline="", encoding="utf-8") as f:
            writer = csv.writer(f, lineterminator="\n")
            writer.writerow(("panel", "series", "x", "y"))
            writer.writerows(self.rows)


def figure():
    """What this figure is asked to show: figure.json, with the runs opened."""
    data = style.read("figure.json")
    data["runs"] = {name: Run(os.path.join(style.folder(), path)) for name, path in data["runs"].items()}
    return data


def first_run(data):
    return next(iter(data["runs"].values()))
