# SPDX-License-Identifier: BSD-3-Clause
"""A pursuit: ways on the ground, distance, what the estimates are off, speeds, size in the picture and altitude."""
import numpy as np

from vericone_figures.style import AGENT, GREY, SLICE, TWO_COLUMNS, folder, plt, save
from vericone_figures.tables import groups, rows

COLORS = ["#8d6bb0", "#1f6fb4", "#d1602b", "#5aa3d9", "#a08030", "#b04070"]
STATES = {"partial": "#e0a020", "total": "#c03030", "lost": GREY}

uas = groups(rows(folder(), "uas.csv"))[()]
cars = {key[0]: table for key, table in groups(rows(folder(), "cars.csv"), "body").items()}
from_pixels = not all(np.isnan(np.asarray(c["visible"], float)).all() for c in cars.values())

figure = plt.figure(figsize=(TWO_COLUMNS, 6.2), constrained_layout=True)
grid = figure.add_gridspec(4, 2)
ways = figure.add_subplot(grid[0:2, 0])
ways.plot(uas["x"], uas["y"], color=AGENT, label="UAS", zorder=3)
for color, (name, car) in zip(COLORS, cars.items()):
    ways.plot(car["x"], car["y"], color=color, label=name, linewidth=1)
ways.plot(uas["x"][0], uas["y"][0], "o", color=AGENT, markersize=4)
ways.set_aspect("equal", adjustable="datalim")
ways.set_xlabel("x, east [m]")
ways.set_ylabel("y, north [m]")
ways.legend(loc="best")

distance = figure.add_subplot(grid[0, 1])
for color, (name, car) in zip(COLORS, cars.items()):
    distance.plot(car["t"], car["r"], color=color, label=name)
distance.plot(uas["t"], uas["r_c"], color="k", linewidth=0.8, label="centre")
distance.set_ylabel("distance [m]")
distance.legend(loc="best")

error = figure.add_subplot(grid[1, 1])
for color, (name, car) in zip(COLORS, cars.items()):
    off = np.hypot(car["x_est"] - car["x"], car["y_est"] - car["y"])
    error.plot(car["t"], off, color=color)
    if from_pixels:
        for state, mark in STATES.items():
            hidden = np.array([s == state for s in car["status"]])
            if hidden.any():
                error.plot(car["t"][hidden], np.zeros(hidden.sum()), "|", color=mark, markersize=6)
error.set_ylabel("error of the estimate [m]")
if from_pixels:
    for state, mark in STATES.items():
        error.plot([], [], "|", color=mark, label=state)
    error.legend(loc="best", title="said of a vehicle")

speeds = figure.add_subplot(grid[2, 0])
speeds.plot(uas["t"], uas["speed"], color=AGENT, label="UAS")
for color, (name, car) in zip(COLORS, cars.items()):
    speeds.plot(car["t"], np.hypot(car["v_x"], car["v_y"]), color=color, linewidth=0.8)
speeds.set_ylabel("speed [m/s]")

commands = figure.add_subplot(grid[2, 1])
for name, label, color in (("a_lat", "lateral", "#1f6fb4"), ("a_long", "along", SLICE), ("a_z", "up", GREY)):
    commands.plot(uas["t"], uas[name], color=color, label=label, linewidth=0.8)
commands.set_ylabel("commanded [m/s²]")
commands.legend(loc="best", ncol=3)

size = figure.add_subplot(grid[3, 0])
size.plot(uas["t"], uas["x_S"], color="#1f6fb4", label="$x_S$")
size.plot(uas["t"], uas["x_C"], color=SLICE, label="$x_C$")
size.set_ylabel("in the picture [px]")
size.legend(loc="best")
altitude = figure.add_subplot(grid[3, 1])
altitude.plot(uas["t"], uas["z"], color=AGENT)
altitude.set_ylabel("altitude [m]")
for axes in (distance, error, speeds, commands, size, altitude):
    axes.set_xlabel("t [s]")
save(figure, "pursuit")
