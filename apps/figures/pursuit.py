# SPDX-License-Identifier: BSD-3-Clause
"""A pursuit: ways on the ground, distance, what the estimates are off, speeds, size in the picture and altitude."""
import os

import numpy as np

from vericone_figures.style import AGENT, GREY, SLICE, TWO_COLUMNS, folder, plt, save
from plot.tables import groups, rows

COLORS = ["#8d6bb0", "#1f6fb4", "#d1602b", "#5aa3d9", "#a08030", "#b04070"]
STATES = {"partial": "#e0a020", "total": "#c03030", "lost": GREY}

uas = groups(rows(folder(), "uas.csv"))[()]
cars = {key[0]: table for key, table in groups(rows(folder(), "cars.csv"), "body").items()}
from_pixels = not all(np.isnan(np.asarray(c["visible"], float)).all() for c in cars.values())

seen = os.path.join(folder(), "seen.png")
pictured = os.path.exists(seen)
figure = plt.figure(figsize=(TWO_COLUMNS, 8.4 if pictured else 6.2), constrained_layout=True)
grid = figure.add_gridspec(6 if pictured else 4, 2)
if pictured:  # with the boxes of the tracker, at about the middle of the run
    picture = figure.add_subplot(grid[0:2, 0])
    picture.imshow(plt.imread(seen))
    picture.set_xlabel("u, to the right [px]")
    picture.set_ylabel("v, down [px]")
    picture.grid(False)
    ways = figure.add_subplot(grid[0:2, 1])
    grid = grid[2:6, :].subgridspec(3, 2)
    distance, error = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[0, 1])
    speeds, commands = figure.add_subplot(grid[1, 0]), figure.add_subplot(grid[1, 1])
    size, altitude = figure.add_subplot(grid[2, 0]), figure.add_subplot(grid[2, 1])
else:
    ways = figure.add_subplot(grid[0:2, 0])
    distance, error = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])
    speeds, commands = figure.add_subplot(grid[2, 0]), figure.add_subplot(grid[2, 1])
    size, altitude = figure.add_subplot(grid[3, 0]), figure.add_subplot(grid[3, 1])
ways.plot(uas["x"], uas["y"], color=AGENT, label="UAS", zorder=3)
for color, (name, car) in zip(COLORS, cars.items()):
    ways.plot(car["x"], car["y"], color=color, label=name, linewidth=1)
ways.plot(uas["x"][0], uas["y"][0], "o", color=AGENT, markersize=4)
ways.set_aspect("equal", adjustable="datalim")
ways.set_xlabel("x, east [m]")
ways.set_ylabel("y, north [m]")
ways.legend(loc="best")

for color, (name, car) in zip(COLORS, cars.items()):
    distance.plot(car["t"], car["r"], color=color, label=name)
distance.plot(uas["t"], uas["r_c"], color="k", linewidth=0.8, label="centre")
distance.set_ylabel("distance [m]")
distance.legend(loc="best")

for color, (name, car) in zip(COLORS, cars.items()):
    off = np.hypot(car["x_est"] - car["x"], car["y_est"] - car["y"])
    error.plot(car["t"], off, color=color)
    if from_pixels:
        for state, mark in STATES.items():
            hidden = np.array([s == state for s in car["status"]])
            if hidden.any():
                error.plot(car["t"][hidden], np.zeros(hidden.sum()), "|", color=mark, markersize=6)
error.set_ylabel("error [m]")
if from_pixels:
    for state, mark in STATES.items():
        error.plot([], [], "|", color=mark, label=state)
    error.legend(loc="best", title="said of a vehicle")

speeds.plot(uas["t"], uas["speed"], color=AGENT, label="UAS")
for color, (name, car) in zip(COLORS, cars.items()):
    speeds.plot(car["t"], np.hypot(car["v_x"], car["v_y"]), color=color, linewidth=0.8)
speeds.set_ylabel("speed [m/s]")

for name, label, color in (("a_lat", "lateral", "#1f6fb4"), ("a_long", "along", SLICE), ("a_z", "up", GREY)):
    commands.plot(uas["t"], uas[name], color=color, label=label, linewidth=0.8)
commands.set_ylabel("commanded [m/s²]")
commands.legend(loc="best", ncol=3)

size.plot(uas["t"], uas["x_S"], color="#1f6fb4", label="$x_S$")
size.plot(uas["t"], uas["x_C"], color=SLICE, label="$x_C$")
size.set_ylabel("in the picture [px]")
size.legend(loc="best")
altitude.plot(uas["t"], uas["z"], color=AGENT)
altitude.set_ylabel("altitude [m]")
for axes in (distance, error, speeds, commands, size, altitude):
    axes.set_xlabel("t [s]")
save(figure, "pursuit")
