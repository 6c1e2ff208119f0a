# SPDX-License-Identifier: BSD-3-Clause
"""A run of `vericone simulate`: the bodies on their ways at several times; y, clearance and accelerations over time."""

import numpy as np
from matplotlib.patches import Circle, Patch
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from vericone_figures.bodies import MANY, body_colors, is_planar, lit, outline, polygons, posed, rotation, surface
from vericone_figures.orifices import COLORS as PASSAGE, orifices
from vericone_figures.style import GREY, TWO_COLUMNS, folder, plt, read, save
from vericone_figures.tables import groups, row_at, rows

bodies = {name: columns for (name,), columns in groups(rows(folder(), "bodies.csv"), "body").items()}
encounters = groups(rows(folder(), "encounters.csv"), "agent", "obstacle")
events, proof, run = rows(folder(), "events.csv"), read("proof.json"), read("run.json")
shapes = {s["name"]: s for s in read("shapes.json")}
planar = is_planar(shapes)
rims, passages = orifices(folder()), proof.get("passages", [])
ways = groups(rows(folder(), "orifices.csv"), "agent", "orifice")
agents = list(dict.fromkeys(agent for agent, _ in [*encounters, *ways]))
NEAREST = 6  # pairs that are drawn over time where there are more
end = run["end"]
instants = np.linspace(0, end, 5)
has_m = bool(encounters)
has_y = any(np.isfinite(c["y"]).any() for c in encounters.values())

COLORS = body_colors(list(bodies), agents)  # the same in all panels


def nearness(pair):
    """Of two bodies: what is proved of their distance; of those that touched none is nearer."""
    for p in proof["pairs"]:
        if {p["a"], p["b"]} == set(pair):
            return p["least_distance"] if p["verdict"] == "avoided" else -1
    return np.nanmin(encounters[pair]["m"], initial=np.inf)


both_once = {frozenset(pair): pair for pair in reversed(encounters)}.values()
pairs = sorted(both_once, key=nearness)[:NEAREST]


def draw_pair(axis, pair, values):
    """In the colour of the other body; of several agents in both bodies' colours."""
    t, (agent, other) = encounters[pair]["t"], pair
    lines = axis.plot(t, values, color=COLORS[agent if len(agents) > 1 else other], linewidth=1.2)
    if len(agents) > 1:
        lines += axis.plot(t, values, color=COLORS[other], linewidth=1.2, linestyle=(0, (4, 4)))
    return tuple(lines)


WHOLE = ("mesh", "cloud", "boxes", "pieces")  # drawn once where they stand still


def around_the_run(row):
    """Of a map: what is around the agents' ways, cut open a little above them; in its own frame."""
    ways = np.vstack([np.stack([bodies[n][c] for c in "xyz"], axis=-1) for n in agents or bodies])
    own = (ways - [row["x"], row["y"], row["z"]]) @ rotation(row)
    aside = 0.15 * np.ptp(own, axis=0).max() + 1
    return own.min(axis=0) - [aside, aside, 1], own.max(axis=0) + [aside, aside, 0.2]


figure = plt.figure(figsize=(TWO_COLUMNS, 4.6))
if planar:
    space = figure.add_axes([0.07, 0.2, 0.47, 0.7])
    middle_point = np.mean([[c["x"][0], c["y"][0]] for c in bodies.values()], axis=0)
    for name, columns in bodies.items():
        space.plot(columns["x"], columns["y"], linewidth=0.8, color=COLORS[name])
        for t in instants[instants >= columns["t"][0]]:
            space.fill(*outline(shapes[name], row_at(columns, t)).T, facecolor=COLORS[name], edgecolor=COLORS[name],
                       alpha=0.15 + 0.5 * t / end, linewidth=0.6)
        if len(bodies) > MANY:  # no legend: beside its start, outwards
            start = np.array([columns["x"][0], columns["y"][0]])
            out = (start - middle_point) / max(np.linalg.norm(start - middle_point), 1e-12)
            space.annotate(name, start, fontsize=6, xytext=9 * out, textcoords="offset points", ha="center", va="center",
                           color=COLORS[name])
    for goal in run["goals"]:
        space.add_patch(Circle(goal["point"][:2], goal["reached"], fill=False, linewidth=0.6, linestyle=":",
                               edgecolor=COLORS[goal["agent"]], zorder=6))
        space.plot(*goal["point"][:2], "*", color=COLORS[goal["agent"]], markersize=8, markeredgecolor="w",
                   markeredgewidth=0.5, zorder=8)
    space.set_aspect("equal", adjustable="datalim")
    space.margins(0.08)
    space.set_xlabel("x (m)")
    space.set_ylabel("y (m)")
else:
    space = figure.add_axes([0.0, 0.12, 0.53, 0.82], projection="3d", computed_zorder=False)
    extent = []
    for name, columns in bodies.items():
        way = np.stack([columns[c] for c in "xyz"], axis=-1)
        space.plot(*way.T, linewidth=0.9, color=COLORS[name], zorder=5)
        extent.append(way)
        shape, shown = shapes[name], instants[instants >= columns["t"][0]]
        still = all(np.ptp(columns[c]) == 0 for c in ("x", "y", "z", "qw", "qx", "qy", "qz"))
        order = 3 if name in agents else 2
        for t in shown[-1:] if still and shape["kind"] in WHOLE else shown:
            row, alpha = row_at(columns, t), 0.12 + 0.4 * t / end
            faces = [posed(f, row) for f in polygons(shape, around_the_run(row))]
            if faces and shape["kind"] in WHOLE:
                space.add_collection3d(Poly3DCollection(faces, facecolor=lit(faces, COLORS[name]), linewidth=0, zorder=order,
                                                        alpha=0.5 if shape["kind"] == "boxes" else 0.9))
                extent += faces
            elif faces:
                space.add_collection3d(Poly3DCollection(faces, facecolor=COLORS[name], edgecolor="k", linewidth=0.2,
                                                        zorder=order, alpha=alpha))
                extent += faces
            for piece in [p for p in shape["pieces"] if p["kind"] != "hull"] if "pieces" in shape else [] if faces else [shape]:
                if "factor" not in piece and "k" not in piece:
                    continue  # of a map nothing is near
                points = surface(piece, row)
                space.plot_surface(*np.moveaxis(points, -1, 0), color=COLORS[name], alpha=0.5 if shape["kind"] in WHOLE else alpha,
                                   linewidth=0, zorder=order)
                extent.append(points.reshape(-1, 3))
        if len(bodies) > MANY:
            space.text(*way[0], name, fontsize=6, ha="center", color=COLORS[name], zorder=9)
    for rim in rims:
        verdicts = {p["verdict"] for p in passages if p["orifice"] == rim.name and p["ordered"]}
        color = next((PASSAGE[v] for v in ("touched", "undecided", "missed", "passed") if v in verdicts), GREY)
        through = [p["time"] for p in passages if p["orifice"] == rim.name and p["time"] is not None]
        for t in (through or [rim.appears, end]) if rim.velocity.any() or rim.spin.any() else [0]:
            space.plot(*rim.rim(t).T, color=color, linewidth=1.4, zorder=6)
            if faces := rim.faces(t):
                space.add_collection3d(Poly3DCollection(faces, facecolor=lit(faces, GREY), linewidth=0, alpha=0.35, zorder=1))
                extent += faces
            extent.append(rim.rim(t))
        at = rim.rim(through[0] if through else rim.appears)
        space.text(*at[np.argmax(at[:, 2])], rim.name, fontsize=6, ha="center", va="bottom", color=color, zorder=9)
    for goal in run["goals"]:
        extent.append(np.array([goal["point"]]))
        space.plot(*np.array([goal["point"]]).T, "*", color=COLORS[goal["agent"]], markersize=8, markeredgecolor="w",
                   markeredgewidth=0.5, zorder=8)
    extent = np.vstack(extent)
    sides = np.maximum(np.ptp(extent, axis=0), 0.25 * np.ptp(extent, axis=0).max())
    middle_point = (extent.min(axis=0) + extent.max(axis=0)) / 2
    space.set_box_aspect(sides.copy(), zoom=0.95)  # it scales what it is given
    for name, i in (("x", 0), ("y", 1), ("z", 2)):
        getattr(space, "set_%slim" % name)(middle_point[i] - sides[i] / 2, middle_point[i] + sides[i] / 2)
        getattr(space, "set_%slabel" % name)("%s (m)" % name, labelpad=(1, 0, -6)[i])
    space.tick_params(pad=-2, labelsize=6)
    space.tick_params(axis="z", pad=0)
    space.locator_params(nbins=5)
    for name, i in (("y", 1), ("z", 2)):
        space.locator_params(axis=name, nbins=5 if sides[i] > 0.5 * sides.max() else 3)
figure.text(0.01, 0.985, "%s: %s%s" % (run["scenario"], run["verdict"], "" if run["verdict"] == "undecided" else ", proved"),
            fontsize=9, va="top")
figure.text(0.01, 0.945, "bodies at t = %s s, later ones darker" % ", ".join("%.3g" % t for t in instants), fontsize=7, va="top",
            color=GREY)

def curves_of_ways(axis, column, edge, text):
    for i, ((agent, name), w) in enumerate(ways.items()):
        axis.plot(w["t"], w[column], color=COLORS[agent], linewidth=1.2, linestyle=("-", "--", "-.", ":")[i % 4],
                  label="%s, %s" % (agent, name) if len(agents) > 1 else name)
    axis.set_ylabel(text)
    if len(ways) <= MANY:
        axis.legend(frameon=False, fontsize=6, title=edge, title_fontsize=6)


# What there is to show over time, from the top.
wanted = []
if has_y:
    wanted.append("y")
if has_m:
    wanted.append("m")
if ways:
    by_y = [np.isfinite(w["y"]).any() and not np.isfinite(w["m"]).any() for w in ways.values()]
    wanted += ["orifice y"] * any(by_y) + ["orifice m"] * (not all(by_y))
wanted.append("a")
height = {2: 0.37, 3: 0.24}.get(len(wanted), 0.75 / len(wanted))
bottoms = {2: (0.56, 0.11), 3: (0.69, 0.4, 0.11)}.get(len(wanted), [0.11 + 0.85 / len(wanted) * i for i in range(len(wanted))][::-1])
panels = dict(zip(wanted, [figure.add_axes([0.66, bottom, 0.32, height]) for bottom in bottoms]))
lower, drawn = panels["a"], {}
for pair in pairs:
    drawn[pair] = draw_pair(panels["m"], pair, encounters[pair]["m"])
    for way in (pair, pair[::-1]) if has_y else ():
        if way in encounters:
            draw_pair(panels["y"], way, encounters[way]["y"])
if len(both_once) > len(pairs):
    figure.text(0.66, 0.958, "lines: the %d nearest of %d pairs" % (len(pairs), len(both_once)), fontsize=6.5, va="top", color=GREY)
if has_y:
    panels["y"].set_ylabel("y, plane chosen (1)")
if has_m:
    panels["m"].set_ylabel("miss distance m (m)")
if "orifice y" in panels:
    curves_of_ways(panels["orifice y"], "y", "through, below 0", "y of (2.2) (m²)")
if "orifice m" in panels:
    curves_of_ways(panels["orifice m"], "m", "through, above 0", "clearance m (m)")
lower.set_ylabel("lateral accel. (m/s²)" if planar else "acceleration (m/s²)")
lower.set_xlabel("time (s)")
panels = list(panels.values())
for axis in panels:
    axis.set_xlim(0, end)
    axis.axhline(0, color="k", linewidth=0.5)
    if axis is not lower:
        axis.set_xticklabels([])
for name in (n for n in bodies if np.any(bodies[n]["a"] > 0) or n in agents):
    lower.step(bodies[name]["t"], bodies[name]["lateral" if planar else "a"], where="post", color=COLORS[name],
               linewidth=1.2 if len(agents) <= MANY else 0.6)
# One legend, below the bodies: it covers nothing.
if len(bodies) <= MANY:
    named = [(Patch(facecolor=COLORS[n], alpha=0.8), n) for n in COLORS]
    if len(agents) > 1 and pairs:
        named.append((drawn.get(pairs[0]), "pair of bodies, in both colours"))
else:
    named = [(drawn[pair], "%s, %s%s" % (*pair, ": %.3g m" % nearness(pair) if nearness(pair) > 0 else "")) for pair in pairs]
for goal in run["goals"] if len(run["goals"]) <= 3 else run["goals"][:1]:
    several = len(run["goals"]) > 3
    named.append((plt.Line2D([], [], color=GREY if several else COLORS[goal["agent"]], marker="*", markersize=7, linestyle=""),
                  "goals, each in its agent's colour" if several else "goal of " + goal["agent"]))
if named:
    figure.legend(*zip(*named), loc="lower left", bbox_to_anchor=(0.01, 0.0), ncol=3, frameon=False, fontsize=6.5,
                  handlelength=1.8, columnspacing=1.2, labelspacing=0.3)
DASHES = {"leaves-cone": ":", "passes": "--", "goes-through": "--", "goes-beside": ":", "contact": "-"}
marked = [e for e in events if e["event"] in DASHES]
marked += [{"event": "contact", "t": p["to"]} for p in passages if p["verdict"] == "touched"]
if len(marked) > 2 * MANY:  # a forest says nothing; contacts always do
    marked = [e for e in marked if e["event"] == "contact"]
for event in marked:
    dash = DASHES[event["event"]]
    color = "red" if event["event"] == "contact" else GREY
    for axis in panels:
        axis.axvline(event["t"], color=color, linestyle=dash, linewidth=0.7)
forest = not any(e["event"] != "contact" for e in marked)
dotted = "out of the cone" if encounters else "beside"
figure.text(0.66, 0.985, "red: meets" if forest else "dotted: %s, dashed: passes, red: meets" % dotted, fontsize=6.5, va="top", color=GREY)
for pair in [*proof["pairs"], *passages]:
    if pair["verdict"] == "touched":
        place = pair["place"][:2] if planar else pair["place"]
        space.plot(*[[c] for c in place], "x", color="red", markersize=6, zorder=10)
save(figure, "simulation")
