# SPDX-License-Identifier: BSD-3-Clause
"""The engagement in space of two bodies, or of a body and an orifice: line of sight, velocities and the acceleration of A,
each by azimuth and elevation."""
import numpy as np

from vericone_figures.runs import Sheet, figure
from vericone_figures.style import AGENT, EXACT, GREY, OBSTACLE, ONE_COLUMN, SLICE, plt, save

data = figure()
orifice = bool(data.get("orifice"))
bar = "" if orifice else "bar"  # chapter 7 marks what is noisy
sheet = Sheet()
axes = plt.figure(figsize=(1.35 * ONE_COLUMN, 1.1 * ONE_COLUMN)).add_subplot(projection="3d")
O, M = np.zeros(3), np.array([8.0, 5.0, 4.0])


def direction(azimuth, elevation):
    a, e = np.radians([azimuth, elevation])
    return np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])


def ellipsoid(centre, semi_axes, color):
    u, v = np.mgrid[0:2 * np.pi:40j, 0:np.pi:20j]
    x = [c + s * p for c, s, p in zip(centre, semi_axes, (np.cos(u) * np.sin(v), np.sin(u) * np.sin(v), np.cos(v)))]
    axes.plot_surface(*x, color=color, alpha=0.2, linewidth=0)


def arrow(start, along, color, name, dashed=False):
    end = start + along
    axes.quiver(*start, *along, color=color, linewidth=1.2, arrow_length_ratio=0.12, linestyle="--" if dashed else "-")
    axes.text(*(end + 0.25 * along / np.linalg.norm(along)), name, color=color, fontsize=7)
    sheet.add("arrow", name, [start[0], end[0]], [start[1], end[1]])


def angles(start, along, color, azimuth_name, elevation_name, radius):
    """Arcs of the azimuth, in the level plane, and of the elevation above it."""
    azimuth, elevation = np.degrees(np.arctan2(along[1], along[0])), np.degrees(np.arcsin(along[2] / np.linalg.norm(along)))
    level = np.array([start + radius * direction(t, 0) for t in np.linspace(0, azimuth, 30)])
    rise = np.array([start + radius * direction(azimuth, t) for t in np.linspace(0, elevation, 30)])
    axes.plot(*level.T, color=color, linewidth=0.8)
    axes.plot(*rise.T, color=color, linewidth=0.8)
    flat = np.stack([start, start + 1.15 * radius * direction(azimuth, 0)])
    axes.plot(*flat.T, color=color, linewidth=0.5, linestyle=":")
    axes.plot(*np.stack([start, start + [1.15 * radius, 0, 0]]).T, color=color, linewidth=0.5, linestyle=":")
    axes.text(*(level[15] + [0.15, 0.1, -0.35]), azimuth_name, color=color, fontsize=7)
    axes.text(*(rise[18] + [0.15, 0.15, 0]), elevation_name, color=color, fontsize=7)


if orifice:
    ellipsoid(O, (0.9, 0.9, 0.9), AGENT)
    across, turn = np.array([0.35, 0.94, 0.0]), np.linspace(0, 2 * np.pi, 73)[:, None]
    axes.plot(*(M + 1.9 * (np.cos(turn) * across + np.sin(turn) * [0, 0, 1])).T, color=OBSTACLE, linewidth=1.8)
    axes.text(*(M + [0.2, 0.2, 2.9]), r"orifice, radius $R_B$", color=OBSTACLE, fontsize=7, ha="center")
    axes.text(*(O + [0, 0, -1.6]), r"ball, radius $R_A$", color=AGENT, fontsize=7, ha="center")
else:
    ellipsoid(O, (2, 1.1, 0.8), AGENT)
    ellipsoid(M, (1.6, 1.2, 1.0), OBSTACLE)
axes.plot(*np.stack([O, M]).T, color=GREY, linewidth=1)
axes.text(*(0.55 * M + [0, 0, 0.35]), "r", color=GREY, fontsize=7)
axes.text(-0.5, -0.3, -0.6, "$P_1$" if orifice else "O", fontsize=7)
axes.text(*(M + [0.2, 0.2, 0.2]), "$P_2$" if orifice else "M", fontsize=7)


def noisy(letter, index=""):
    return "$%s$" % (("\\bar{%s}" % letter if bar else letter) + index)


angles(O, M, GREY, noisy("θ"), noisy("φ"), 4.2)
velocity_a, velocity_b = 4.5 * direction(-20, 35), 3.5 * direction(175, 8)
arrow(O, velocity_a, AGENT, r"$V_A$")
angles(O, velocity_a, AGENT, r"$β_A$", r"$α_A$", 2.6)
arrow(M, velocity_b, OBSTACLE, r"$V_B$")
across = np.cross(velocity_a, [0.3, 1, 0.2])
arrow(O, 2.6 * across / np.linalg.norm(across), SLICE, r"$a\ (δ, γ)$" if orifice else r"$a_A\ (δ_A, γ_A)$")
u = M / np.linalg.norm(M)
theta = np.array([-u[1], u[0], 0]) / np.hypot(u[0], u[1])
arrow(M, 2 * u, EXACT, noisy("V", "_r"), dashed=True)
arrow(M, 2 * theta, EXACT, noisy("V", "_θ"), dashed=True)
arrow(M, 2 * np.cross(u, theta), EXACT, noisy("V", "_φ"), dashed=True)
axes.set_box_aspect((10, 8, 6.5), zoom=1.15)
axes.set_xlim(-1, 10)
axes.set_ylim(-2, 8)
axes.set_zlim(-1, 7)
axes.set_xlabel("x", labelpad=-12)
axes.set_ylabel("y", labelpad=-12)
axes.set_zlabel("z", labelpad=-12)
axes.set_xticklabels([])
axes.set_yticklabels([])
axes.set_zticklabels([])
axes.view_init(22, -62)
sheet.write(data["name"])
save(axes.figure, data["name"])
