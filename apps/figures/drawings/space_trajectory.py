# SPDX-License-Identifier: BSD-3-Clause
"""Ways of spatial bodies, with their surfaces at several times, and the rims of orifices when they are passed."""
import numpy as np
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from plot.bodies import facets
from plot.orifices import RIM, orifices
from vericone_figures.runs import Sheet, dark, figure, first_run
from vericone_figures.style import GREY, TWO_COLUMNS, plt, save
from plot.tables import row_at

data = figure()
run = first_run(data)
sheet = Sheet()
elevation, azimuth = data.get("view", [22, -62])
axes = plt.figure(figsize=(TWO_COLUMNS, 4.2)).add_axes([0.0, 0.04, 0.97, 0.96], projection="3d", computed_zorder=False)
e, a = np.radians([elevation, azimuth])
eye = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
light = eye + np.array([0.3 * np.sin(a), -0.3 * np.cos(a), 0.6])
light /= np.linalg.norm(light)

polygons, colors, everything = [], [], []
for name, body in run.bodies.items():
    way = np.stack([body["x"], body["y"], body["z"]], axis=1)
    everything.append(way)
    base = np.array(to_rgb(run.color(name)))
    for column, c in zip("xyz", way.T):
        sheet.add("trajectory, %s against t" % column, name, body["t"], c)
    axes.plot(*way.T, color=base, linewidth=1.3, zorder=3)
    shown = sorted({t for t in data["times"].get(name, []) if body["t"][0] - 1e-6 <= t <= body["t"][-1] + 1e-6})
    for t in shown:
        row = row_at(body, t)
        faces, normals = facets(run.shapes[name], row, 37)
        strength = 0.45 + 0.55 * np.maximum(0, normals @ light)
        facing = normals @ eye > 0
        polygons += [f for f, seen in zip(faces, facing) if seen]
        colors += [np.clip(base * s + 0.25 * (s - 0.45), 0, 1) for s, seen in zip(strength, facing) if seen]
        everything.append(np.vstack(faces))
        for column in "xyz":
            sheet.add("centre of a body drawn, %s against t" % column, name, [row["t"]], [row[column]])
        p = np.array([row["x"], row["y"], row["z"]])
        axes.text(*(p + [0, 0, np.vstack(faces)[:, 2].max() - p[2] + 0.75 * data.get("room", 2)]), "%g s" % t, fontsize=6, color=dark(run.color(name)),
                  ha="center", zorder=10, bbox={"boxstyle": "round,pad=0.05", "facecolor": "white", "edgecolor": "none",
                                                "alpha": 0.6})
if polygons:
    axes.add_collection3d(Poly3DCollection(polygons, facecolors=colors, edgecolors=colors, linewidths=0.15, zorder=5))
rims = orifices(run.folder)
for orifice in rims:
    passed = [p["time"] for p in run.proof()["passages"] if p["orifice"] == orifice.name and p["time"] is not None]
    t = passed[0] if passed else orifice.appears
    rim = orifice.rim(t)
    axes.plot(*rim.T, color=RIM, linewidth=1.6, zorder=4)
    axes.text(*rim[np.argmax(rim[:, 2])], "%s, %.4g s" % (orifice.name, t), fontsize=6, color=dark(RIM), ha="center", va="bottom")
    everything.append(rim)
    for column, c in zip("xyz", rim.T):
        sheet.add("rim, %s" % column, orifice.name, np.arange(len(c)), c)
everything = np.vstack(everything)
room = data.get("room", 2)  # m, around everything
low, high = everything.min(axis=0) - room, everything.max(axis=0) + room
axes.set_xlim(low[0], high[0])
axes.set_ylim(low[1], high[1])
axes.set_zlim(low[2], high[2])
# Wide scenes leave the frame's height free.
axes.set_box_aspect(high - low, zoom=1.25 if high[0] - low[0] > 2 * (high[2] - low[2]) else 1.03)
axes.view_init(elev=elevation, azim=azimuth)
axes.set_proj_type("ortho")
axes.yaxis.set_major_locator(MaxNLocator(4))
axes.set_xlabel("x [m]")
axes.set_ylabel("y [m]", labelpad=-2)
axes.set_zlabel("z [m]", labelpad=-4)
axes.tick_params(pad=-1)
axes.legend(handles=[Line2D([], [], color=run.color(n), label=n) for n in run.bodies] +
            [Line2D([], [], color=RIM, label="orifices, when passed")] * bool(rims), loc="upper left",
            bbox_to_anchor=(0.7 if rims else 0.02, 0.99 if rims else 0.97))
axes.text2D(0.98, 0.95, run.idle_note(), transform=axes.transAxes, fontsize=7, color=GREY, ha="right")
sheet.write(data["name"])
save(axes.figure, data["name"])
