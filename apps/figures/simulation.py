# SPDX-License-Identifier: BSD-3-Clause
"""A run of `vericone simulate`: the bodies on their ways at several times; y, clearance and accelerations over time."""

import numpy as np
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from runs import groups, lit, outline, polygons, posed, rotation, row_at, rows, surface
from style import AGENT, BOUND, EXACT, GREY, OBSTACLE, SLICE, TWO_COLUMNS, folder, plt, read, save

bodies = {name: columns for (name,), columns in groups(rows(folder(), "bodies.csv"), "body").items()}
encounters = groups(rows(folder(), "encounters.csv"), "agent", "obstacle")
events, proof, run = rows(folder(), "events.csv"), read("proof.json"), read("run.json")
shapes = {s["name"]: s for s in read("shapes.json")}
planar = all(s["kind"] in ("ellipse", "dented_conic") for s in shapes.values())
agents = list(dict.fromkeys(agent for agent, _ in encounters))
COLORS = [EXACT, SLICE, OBSTACLE, BOUND, "#b0894f", GREY]
DASHES = ["-", (0, (4, 1.2)), (0, (1, 1)), (0, (5, 1, 1, 1))]
MANY = 8  # of lines or verticals: more of them nobody can tell apart
end = run["end"]
instants = np.linspace(0, end, 5)
has_y = any(np.isfinite(c["y"]).any() for c in encounters.values())


def look(i):
    """Colour and dash of line i: different for all that a legend names."""
    return {"color": COLORS[i % len(COLORS)], "linestyle": DASHES[i // len(COLORS) % len(DASHES)]}


def look_of(pair):
    """One agent: a line of its own for each obstacle, of the obstacle's colour in space. Several: that of the agent."""
    return look(agents.index(pair[0]) if len(agents) > 1 else [o for _, o in encounters].index(pair[1]))


def color_of(name):
    """As in the plots: a single agent is green, obstacles that it minds have the colour of their line."""
    if name in agents:
        return AGENT if len(agents) == 1 else look(agents.index(name))["color"]
    if len(agents) == 1 and (agents[0], name) in encounters:
        return look_of((agents[0], name))["color"]
    return OBSTACLE


def way_of(name):
    return look(agents.index(name)) if len(agents) > 1 and name in agents else {"color": color_of(name)}


WHOLE = ("mesh", "cloud", "boxes", "pieces")  # drawn once where they stand still


def around_the_run(row):
    """Of a map: what is around the agents' ways, cut open a little above them; in its own frame."""
    ways = np.vstack([np.stack([bodies[n][c] for c in "xyz"], axis=-1) for n in agents or bodies])
    own = (ways - [row["x"], row["y"], row["z"]]) @ rotation(row)
    aside = 0.15 * np.ptp(own, axis=0).max() + 1
    return own.min(axis=0) - [aside, aside, 1], own.max(axis=0) + [aside, aside, 0.2]


figure = plt.figure(figsize=(TWO_COLUMNS, 4.3))
if planar:
    space = figure.add_axes([0.07, 0.1, 0.47, 0.78])
    for name, columns in bodies.items():
        space.plot(columns["x"], columns["y"], linewidth=0.8, **way_of(name))
        for t in instants[instants >= columns["t"][0]]:
            space.fill(*outline(shapes[name], row_at(columns, t)).T, facecolor=color_of(name), edgecolor=color_of(name),
                       alpha=0.15 + 0.5 * t / end, linewidth=0.6)
        space.annotate(name, (columns["x"][0], columns["y"][0]), fontsize=7, xytext=(4, 3), textcoords="offset points",
                       color=way_of(name)["color"] if len(agents) > 1 else "k")
    space.set_aspect("equal", adjustable="datalim")
    space.set_xlabel("x (m)")
    space.set_ylabel("y (m)")
else:
    space = figure.add_axes([0.0, 0.02, 0.53, 0.88], projection="3d")
    extent = []
    for name, columns in bodies.items():
        way = np.stack([columns[c] for c in "xyz"], axis=-1)
        space.plot(*way.T, linewidth=0.9, **way_of(name))
        before = len(extent)
        extent.append(way)
        shape, shown = shapes[name], instants[instants >= columns["t"][0]]
        still = all(np.ptp(columns[c]) == 0 for c in ("x", "y", "z", "qw", "qx", "qy", "qz"))
        for t in shown[-1:] if still and shape["kind"] in WHOLE else shown:
            row, alpha = row_at(columns, t), 0.12 + 0.4 * t / end
            faces = [posed(f, row) for f in polygons(shape, around_the_run(row))]
            if faces and shape["kind"] in WHOLE:
                space.add_collection3d(Poly3DCollection(faces, facecolor=lit(faces, color_of(name)), linewidth=0,
                                                        alpha=0.5 if shape["kind"] == "boxes" else 0.9))
                extent += faces
            elif faces:
                space.add_collection3d(Poly3DCollection(faces, facecolor=color_of(name), edgecolor="k", linewidth=0.2,
                                                        alpha=alpha))
                extent += faces
            for piece in [p for p in shape["pieces"] if p["kind"] != "hull"] if "pieces" in shape else [] if faces else [shape]:
                if "factor" not in piece and "k" not in piece:
                    continue  # of a map nothing is near
                points = surface(piece, row)
                space.plot_surface(*np.moveaxis(points, -1, 0), color=color_of(name), alpha=0.5 if shape["kind"] in WHOLE else alpha,
                                   linewidth=0)
                extent.append(points.reshape(-1, 3))
        # Above the first pose, or all of a body that is drawn once, where no body hides it; not above a whole map.
        high = shape["kind"] in WHOLE and shape["kind"] != "boxes"
        first = np.vstack([np.reshape(p, (-1, 3)) for p in extent[before + 1:None if high else before + 2] or [way[:1]]])
        space.text(*way[0][:2], first[:, 2].max(), name, fontsize=7, va="bottom", color=way_of(name)["color"] if len(agents) > 1 else "k")
    extent = np.vstack(extent)
    sides = np.maximum(np.ptp(extent, axis=0), 0.25 * np.ptp(extent, axis=0).max())
    middle_point = (extent.min(axis=0) + extent.max(axis=0)) / 2
    space.set_box_aspect(sides.copy(), zoom=0.95)  # it scales what it is given
    for name, i in (("x", 0), ("y", 1), ("z", 2)):
        getattr(space, "set_%slim" % name)(middle_point[i] - sides[i] / 2, middle_point[i] + sides[i] / 2)
        getattr(space, "set_%slabel" % name)("%s (m)" % name, labelpad=-4 if i < 2 else -7)
    space.tick_params(pad=-2, labelsize=6)
    space.tick_params(axis="z", pad=0)
    space.locator_params(nbins=5)
figure.text(0.01, 0.985, "%s: %s%s" % (run["scenario"], run["verdict"], "" if run["verdict"] == "undecided" else ", proved"),
            fontsize=9, va="top")
figure.text(0.01, 0.945, "bodies at t = %s s, later ones darker%s" % (", ".join("%.3g" % t for t in instants), "; the agent green" if len(agents) == 1 else "; plots in the agents' colours and dashes"),
            fontsize=7, va="top", color=GREY)

if has_y:
    upper, middle, lower = panels = [figure.add_axes([0.66, bottom, 0.33, 0.25]) for bottom in (0.71, 0.41, 0.11)]
else:  # the clearance law has m alone
    middle, lower = panels = [figure.add_axes([0.66, bottom, 0.33, 0.39]) for bottom in (0.57, 0.11)]
for i, ((agent, obstacle), columns) in enumerate(encounters.items()):
    # Of several agents the legend names each once: its lines are those to all others.
    label = obstacle if len(agents) == 1 else agent
    style = dict(look_of((agent, obstacle)), linewidth=1.2 if len(encounters) <= MANY else 0.6)
    if i and label in [line.get_label() for line in middle.get_lines()]:
        label = None
    if has_y:
        upper.plot(columns["t"], columns["y"], label=label, **style)
    middle.plot(columns["t"], columns["m"], label=label, **style)
if has_y:
    upper.set_ylabel("y, plane chosen (1)")
middle.set_ylabel("miss distance m (m)")
lower.set_ylabel("lateral accel. (m/s²)" if planar else "acceleration (m/s²)")
lower.set_xlabel("time (s)")
for axis in panels:
    axis.set_xlim(0, end)
    axis.axhline(0, color="k", linewidth=0.5)
    if axis is not lower:
        axis.set_xticklabels([])
if encounters:
    shown = panels[0].get_legend_handles_labels()[1]
    if len(agents) == 1 and len(shown) > 4:  # room above the lines
        low, high = panels[0].get_ylim()
        panels[0].set_ylim(low, high + 0.1 * (1 + len(shown) // (1 + len(shown) // 5)) * (high - low))
    if len(agents) == 1 or len(shown) <= 4:  # more agents: their names stand at their ways, in their colours
        panels[0].legend(frameon=False, loc="best" if len(shown) <= 4 else "upper left", ncol=1 + len(shown) // 5, fontsize=7 if len(shown) <= 4 else 5.5,
                         title=None if len(agents) == 1 else "agent, to each other body", title_fontsize=5.5,
                         handlelength=2.2, columnspacing=1, labelspacing=0.3)
for i, name in enumerate(n for n in bodies if np.any(bodies[n]["a"] > 0) or n in agents):
    columns = bodies[name]
    value = columns["lateral"] if planar else columns["a"]
    lower.step(columns["t"], value, where="post", label=name, linewidth=1.2 if len(agents) <= MANY else 0.6,
               **way_of(name))
if len(lower.get_lines()) > 2 and len(agents) == 1:
    lower.legend(frameon=False)
marked = [e for e in events if e["event"] in ("leaves-cone", "passes", "contact")]
if len(marked) > 2 * MANY:  # a forest says nothing; contacts always do
    marked = [e for e in marked if e["event"] == "contact"]
for event in marked:
    dash = {"leaves-cone": ":", "passes": "--", "contact": "-"}[event["event"]]
    color = "red" if event["event"] == "contact" else GREY
    for axis in panels:
        axis.axvline(event["t"], color=color, linestyle=dash, linewidth=0.7)
forest = not any(e["event"] != "contact" for e in marked)
figure.text(0.66, 0.985, "red: meets" if forest else "dotted: out of the cone, dashed: passes, red: meets", fontsize=6.5, va="top", color=GREY)
for pair in proof["pairs"]:
    if pair["verdict"] == "touched":
        place = pair["place"][:2] if planar else pair["place"]
        space.plot(*[[c] for c in place], "x", color="red", markersize=6, zorder=9)
save(figure, "simulation")
