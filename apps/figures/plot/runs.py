# SPDX-License-Identifier: BSD-3-Clause
# mypy: disable-error-code="import"
"""A run: the bodies on their ways at several times; y, clearance and accelerations over time."""
import collections
import collections.abc
import json
import os
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, Patch
from mpl_toolkits.mplot3d import proj3d
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from .bodies import MANY, body_colors, is_planar, lit, outline, polygons, posed, rotation, surface
from .kinds import Array, Axes, Data, Figure, Path, Row, Shape, Tables
from .orifices import COLORS as PASSAGE
from .orifices import orifices
from .style import GREY, TWO_COLUMNS
from .tables import goal_at, groups, row_at, rows

NEAREST = 6  # pairs that are drawn over time where there are more
WHOLE = ("mesh", "cloud", "boxes", "pieces")  # drawn once where they stand still
DASHES = {"leaves-cone": ":", "passes": "--", "goes-through": "--", "goes-beside": ":", "contact": "-"}


class Flown:
    """What is drawn of a run: its tables by the names of their columns, its shapes, what is proved."""

    def __init__(self, bodies: Tables, encounters: Tables, events: collections.abc.Sequence[Row], proof: Data, run: Data,
                 shapes: dict[str, Shape], rims: collections.abc.Iterable[Any] = (), ways: Tables | None = None) -> None:
        self.bodies, self.encounters, self.events = bodies, encounters, events
        self.proof, self.run, self.shapes, self.rims, self.ways = proof, run, shapes, list(rims), ways or {}
        self.passages = proof.get("passages", [])
        self.planar = is_planar(shapes)
        self.agents = list(dict.fromkeys(agent for agent, _ in [*encounters, *self.ways]))
        self.end = run["end"]
        self.instants = np.linspace(0, self.end, 5)
        self.colors = body_colors(list(bodies), self.agents)  # the same in all panels
        self.both_once: Any = {frozenset(pair): pair for pair in reversed(encounters)}.values()
        self.pairs = sorted(self.both_once, key=self.nearness)[:NEAREST]

    def nearness(self, pair: Any) -> Any:
        """Of two bodies: what is proved of their distance; of those that touched none is nearer."""
        for p in self.proof["pairs"]:
            if {p["a"], p["b"]} == set(pair):
                return p["least_distance"] if p["verdict"] == "avoided" else -1
        return np.nanmin(self.encounters[pair]["m"], initial=np.inf)

    def goals(self) -> Any:
        """Agent, place at the end, metres, and how near to it is there, of every goal."""
        return [(goal["agent"], goal_at(goal, self.bodies, self.end), goal["reached"]) for goal in self.run["goals"]]

    def around(self, row: Row) -> Array:
        """Of a map: what is around the agents' ways, cut open a little above them; in its own frame."""
        ways = np.vstack([np.stack([self.bodies[n][c] for c in "xyz"], axis=-1) for n in self.agents or self.bodies])
        own = (ways - [row["x"], row["y"], row["z"]]) @ rotation(row)
        aside = 0.15 * np.ptp(own, axis=0).max() + 1
        return own.min(axis=0) - [aside, aside, 1], own.max(axis=0) + [aside, aside, 0.2]


def flown(folder: Path) -> Flown:
    """From the folder of a run, as `vericone simulate --out` writes it."""
    def read(name: str) -> Any:
        with open(os.path.join(folder, name), encoding="utf-8") as f:
            return json.load(f)

    return Flown({name: columns for (name,), columns in groups(rows(folder, "bodies.csv"), "body").items()},
                 groups(rows(folder, "encounters.csv"), "agent", "obstacle"), rows(folder, "events.csv"),
                 read("proof.json"), read("run.json"), {s["name"]: s for s in read("shapes.json")}, orifices(folder),
                 groups(rows(folder, "orifices.csv"), "agent", "orifice"))


def brief(least: float) -> str:
    """Three digits, rounded down: what is proved stays true."""
    power = 10.0 ** (2 - np.floor(np.log10(least))) if least > 0 else 1.0
    return "%.3g" % (np.floor(least * power * (1 + 1e-12)) / power)


def draw_pair(axis: Axes, run: Flown, pair: tuple[str, str], values: Array) -> tuple[Any, ...]:
    """In the colour of the other body; of several agents in both bodies' colours."""
    t, (agent, other) = run.encounters[pair]["t"], pair
    lines = axis.plot(t, values, color=run.colors[agent if len(run.agents) > 1 else other], linewidth=1.2)
    if len(run.agents) > 1:
        lines += axis.plot(t, values, color=run.colors[other], linewidth=1.2, linestyle=(0, (4, 4)))
    return tuple(lines)


def ways_in_plane(space: Axes, run: Flown) -> None:
    """Planar bodies on their ways."""
    bodies, colors = run.bodies, run.colors
    middle_point = np.mean([[c["x"][0], c["y"][0]] for c in bodies.values()], axis=0)
    for name, columns in bodies.items():
        space.plot(columns["x"], columns["y"], linewidth=0.8, color=colors[name])
        for t in run.instants[run.instants >= columns["t"][0]]:
            space.fill(*outline(run.shapes[name], row_at(columns, t)).T, facecolor=colors[name], edgecolor=colors[name],
                       alpha=0.15 + 0.5 * t / run.end, linewidth=0.6)
        if len(bodies) > MANY:  # no legend: beside its start, outwards
            start = np.array([columns["x"][0], columns["y"][0]])
            out = (start - middle_point) / max(float(np.linalg.norm(start - middle_point)), 1e-12)
            space.annotate(name, start, fontsize=6, xytext=9 * out, textcoords="offset points", ha="center", va="center",
                           color=colors[name])
    for agent, at, reached in run.goals():
        space.add_patch(Circle(at[:2], reached, fill=False, linewidth=0.6, linestyle=":", edgecolor=colors[agent],
                               zorder=6))
        space.plot(*at[:2], "*", color=colors[agent], markersize=8, markeredgecolor="w", markeredgewidth=0.5, zorder=8)
    space.set_aspect("equal", adjustable="datalim")
    space.margins(0.08)
    space.set_xlabel("x (m)")
    space.set_ylabel("y (m)")


def draw_shape(space: Axes, run: Flown, name: str, row: Row, alpha: float, order: int) -> list[Any]:
    """A body in space as it stands at a row of its table. Returns points of it."""
    shape, color, extent = run.shapes[name], run.colors[name], []
    faces = [posed(f, row) for f in polygons(shape, run.around(row))]
    if faces and shape["kind"] in WHOLE:
        space.add_collection3d(Poly3DCollection(faces, facecolor=lit(faces, color), linewidth=0, zorder=order,
                                                alpha=0.5 if shape["kind"] == "boxes" else 0.9))
        extent += faces
    elif faces:
        few = len(faces) <= 300
        space.add_collection3d(Poly3DCollection(faces, facecolor=color if few else lit(faces, color), edgecolor="k" if few else None,
                                                linewidth=0.2 if few else 0, zorder=order, alpha=alpha))
        extent += faces
    for piece in [p for p in shape["pieces"] if p["kind"] != "hull"] if "pieces" in shape else [] if faces else [shape]:
        if "factor" not in piece and "k" not in piece:
            continue  # of a map nothing is near
        points = surface(piece, row)
        space.plot_surface(*np.moveaxis(points, -1, 0), color=color, alpha=0.5 if shape["kind"] in WHOLE else alpha,
                           linewidth=0, zorder=order)
        extent.append(points.reshape(-1, 3))
    return extent


def draw_rims(space: Axes, run: Flown) -> list[Any]:
    """Orifices when they are passed, else when they appear and at the end. Returns points of them."""
    extent = []
    for rim in run.rims:
        verdicts = {p["verdict"] for p in run.passages if p["orifice"] == rim.name and p["ordered"]}
        color = next((PASSAGE[v] for v in ("touched", "undecided", "missed", "passed") if v in verdicts), GREY)
        through = [p["time"] for p in run.passages if p["orifice"] == rim.name and p["time"] is not None]
        for t in (through or [rim.appears, run.end]) if rim.velocity.any() or rim.spin.any() else [0]:
            space.plot(*rim.rim(t).T, color=color, linewidth=1.4, zorder=6)
            if faces := rim.faces(t):
                space.add_collection3d(Poly3DCollection(faces, facecolor=lit(faces, GREY), linewidth=0, alpha=0.35, zorder=1))
                extent += faces
            extent.append(rim.rim(t))
        at = rim.rim(through[0] if through else rim.appears)
        space.text(*at[np.argmax(at[:, 2])], rim.name, fontsize=6, ha="center", va="bottom", color=color, zorder=9)
    return extent


def ways_in_space(space: Axes, run: Flown) -> None:
    """Spatial bodies on their ways, orifices, goals."""
    bodies, colors, extent = run.bodies, run.colors, []
    for name, columns in bodies.items():
        way = np.stack([columns[c] for c in "xyz"], axis=-1)
        space.plot(*way.T, linewidth=0.9, color=colors[name], zorder=5)
        extent.append(way)
        shown = run.instants[run.instants >= columns["t"][0]]
        still = all(np.ptp(columns[c]) == 0 for c in ("x", "y", "z", "qw", "qx", "qy", "qz"))
        for t in shown[-1:] if still and run.shapes[name]["kind"] in WHOLE else shown:
            extent += draw_shape(space, run, name, row_at(columns, t), 0.12 + 0.4 * t / run.end,
                                 3 if name in run.agents else 2)
        if len(bodies) > MANY:
            space.text(*way[0], name, fontsize=6, ha="center", color=colors[name], zorder=9)
    extent += draw_rims(space, run)
    for agent, at, _ in run.goals():
        extent.append(at[None])
        space.plot(*at[None].T, "*", color=colors[agent], markersize=8, markeredgecolor="w", markeredgewidth=0.5, zorder=8)
    frame(space, np.vstack(extent))


def frame(space: Axes, extent: Array, zoom: float = 0.95) -> None:
    """Equal scales around points (n, 3), metres; flat scenes are not drawn flatter than a quarter."""
    sides = np.maximum(np.ptp(extent, axis=0), 0.25 * np.ptp(extent, axis=0).max())
    middle_point = (extent.min(axis=0) + extent.max(axis=0)) / 2
    space.set_box_aspect(sides.copy(), zoom=zoom)  # it scales what it is given
    for name, i in (("x", 0), ("y", 1), ("z", 2)):
        getattr(space, "set_%slim" % name)(middle_point[i] - sides[i] / 2, middle_point[i] + sides[i] / 2)
        getattr(space, "set_%slabel" % name)("%s (m)" % name, labelpad=(1, 0, -6)[i])
    space.tick_params(pad=-2, labelsize=6)
    space.tick_params(axis="z", pad=0)
    space.locator_params(nbins=5)
    for name, i in (("y", 1), ("z", 2)):
        space.locator_params(axis=name, nbins=5 if sides[i] > 0.5 * sides.max() else 3)


def fill(space: Axes, box: tuple[float, float, float, float], highest: float = 55) -> None:
    """Makes what axes of space show as large as fits into a box (left, bottom, width, height of the figure), in its
    middle, flat scenes seen from higher up, to `highest` degrees. Numbers and names of the axes stand outside."""
    left, bottom, width, height = box
    limits = [getattr(space, "get_%slim" % name)() for name in "xyz"]
    corners = np.array(np.meshgrid(*limits)).reshape(3, -1)
    space.patch.set_visible(False)  # the axes' own frame is larger than the box, or it would cut things off
    around, zoom = np.array([left - width / 2, bottom - height / 2]), 1.0
    for k in range(12):  # the nearer a part is the more it grows
        space.set_box_aspect(np.ptp(limits, axis=1), zoom=zoom)
        space.set_position([*around, 2 * width, 2 * height])
        space.apply_aspect()
        x, y, _ = proj3d.proj_transform(*corners, space.get_proj())
        at = space.figure.transFigure.inverted().transform(space.transData.transform(np.column_stack([x, y])))
        low, high = at.min(axis=0), at.max(axis=0)
        if k < 8 and (high - low)[1] / height < 0.9 * (high - low)[0] / width and space.elev < highest - 4:
            space.view_init(elev=space.elev + 4, azim=space.azim)
        zoom *= min([width, height] / (high - low))
        around += [left + width / 2, bottom + height / 2] - (low + high) / 2
    for axis, pad in ((space.xaxis, 16), (space.yaxis, 10), (space.zaxis, -3)):
        axis.labelpad = pad


def nearest(run: Flown) -> Any:
    """Of the pairs with an agent the one that met first, or came nearest: its proof, when, and what is to be said."""
    pairs = [p for p in run.proof["pairs"] if {p["a"], p["b"]} & set(run.agents) and p["verdict"] != "undecided"]
    if not pairs:
        return None
    met = [p for p in pairs if p["verdict"] == "touched"]
    p = min(met, key=lambda p: float(p["to"])) if met else min(pairs, key=lambda p: float(p["least_distance"]))
    t = p["to"] if met else p["least_time"]
    said = "meet" if met else "%s m apart or more, proved" % brief(p["least_distance"])
    return p, t, "%s and %s\nat %.4g s, to scale:\n%s" % (p["a"], p["b"], t, said)


def size(run: Flown, name: str, t: float) -> Any:
    """Points of a body that is no scan or map, at a time; nothing of those."""
    shape, row = run.shapes[name], row_at(run.bodies[name], t)
    if shape["kind"] in WHOLE:
        return None
    faces = [posed(f, row) for f in polygons(shape)]
    return np.vstack(faces) if faces else surface(shape, row).reshape(-1, 3)


def close_up(figure: Figure, run: Flown, space: Axes) -> bool:
    """The nearest pair where its bodies are small among the ways, beside what it shows. Whether there is one."""
    near = nearest(run)
    if not near:
        return False
    pair, t, said = near
    shown = [size(run, pair[name], t) for name in ("a", "b")]
    if any(s is None for s in shown):
        return False
    sizes = [np.ptp(s, axis=0).max() for s in shown]
    whole = max(np.ptp(getattr(space, "get_%slim" % name)()) for name in "xyz")
    if max(sizes) > 0.05 * whole:
        return False
    axes = figure.add_axes([0.02, 0.12, 0.2, 0.2], projection="3d", computed_zorder=False)
    for name in (pair["a"], pair["b"]):
        draw_shape(axes, run, name, row_at(run.bodies[name], t), 0.7, 3)
    extent = np.vstack(shown)
    frame(axes, extent)
    middle_point, half = (extent.min(axis=0) + extent.max(axis=0)) / 2, 0.5 * np.ptp(extent, axis=0).max()
    for name in (pair["a"], pair["b"]):
        way = np.stack([run.bodies[name][c] for c in "xyz"], axis=-1)
        way[np.abs(way - middle_point).max(axis=1) > half] = np.nan
        axes.plot(*way.T, linewidth=0.9, color=run.colors[name], zorder=2)
    axes.set_axis_off()
    fill(axes, (0.03, 0.13, 0.22, 0.18), 30)
    figure.text(0.29, 0.22, said, fontsize=7, va="center", color=GREY)
    return True


def curves_of_ways(axis: Axes, run: Flown, column: str, edge: str, text: str) -> None:
    for i, ((agent, name), w) in enumerate(run.ways.items()):
        axis.plot(w["t"], w[column], color=run.colors[agent], linewidth=1.2, linestyle=("-", "--", "-.", ":")[i % 4],
                  label="%s, %s" % (agent, name) if len(run.agents) > 1 else name)
    axis.set_ylabel(text)
    if len(run.ways) <= MANY:
        axis.legend(frameon=False, fontsize=6, title=edge, title_fontsize=6)


def over_time(figure: Figure, run: Flown) -> Any:
    """What there is to show over time, from the top: panels by name, and the lines of the pairs."""
    has_y = any(np.isfinite(c["y"]).any() for c in run.encounters.values())
    wanted = []
    if has_y:
        wanted.append("y")
    if run.encounters:
        wanted.append("m")
    if run.ways:
        by_y = [np.isfinite(w["y"]).any() and not np.isfinite(w["m"]).any() for w in run.ways.values()]
        wanted += ["orifice y"] * any(by_y) + ["orifice m"] * (not all(by_y))
    wanted.append("a")
    height = {2: 0.37, 3: 0.24}.get(len(wanted), 0.75 / len(wanted))
    bottoms = {2: (0.56, 0.11), 3: (0.69, 0.4, 0.11)}.get(
        len(wanted), [0.11 + 0.85 / len(wanted) * i for i in range(len(wanted))][::-1])
    panels = dict(zip(wanted, [figure.add_axes([0.66, bottom, 0.32, height]) for bottom in bottoms]))
    drawn = {}
    proofs = {frozenset((p["a"], p["b"])): p for p in run.proof["pairs"] if p["verdict"] == "avoided"}
    for pair in run.pairs:
        drawn[pair] = draw_pair(panels["m"], run, pair, run.encounters[pair]["m"])
        if p := proofs.get(frozenset(pair)):  # m is what would come of straight ways; this is what came
            panels["m"].plot(p["least_time"], p["least_distance"], "o", color=run.colors[pair[0] if len(run.agents) > 1 else pair[1]],
                             markersize=4.5, markeredgecolor=run.colors[pair[1]], zorder=5, clip_on=False)
        for way in (pair, pair[::-1]) if has_y else ():
            if way in run.encounters:
                draw_pair(panels["y"], run, way, run.encounters[way]["y"])
    if len(run.both_once) > len(run.pairs):
        figure.text(0.66, 0.958, "lines: the %d nearest of %d pairs" % (len(run.pairs), len(run.both_once)), fontsize=6.5,
                    va="top", color=GREY)
    if has_y:
        panels["y"].set_ylabel("y, plane chosen (1)")
    if run.encounters:
        panels["m"].set_ylabel("miss distance m (m)")
    if "orifice y" in panels:
        curves_of_ways(panels["orifice y"], run, "y", "through, below 0", "y of (2.2) (m²)")
    if "orifice m" in panels:
        curves_of_ways(panels["orifice m"], run, "m", "through, above 0", "clearance m (m)")
    lower = panels["a"]
    lower.set_ylabel("lateral accel. (m/s²)" if run.planar else "acceleration (m/s²)")
    lower.set_xlabel("time (s)")
    for axis in panels.values():
        axis.set_xlim(0, run.end)
        axis.axhline(0, color="k", linewidth=0.5)
        if axis is not lower:
            axis.set_xticklabels([])
    for name in (n for n in run.bodies if np.any(run.bodies[n]["a"] > 0) or n in run.agents):
        lower.step(run.bodies[name]["t"], run.bodies[name]["lateral" if run.planar else "a"], where="post",
                   color=run.colors[name], linewidth=1.2 if len(run.agents) <= MANY else 0.6)
    return panels, drawn


def legend(figure: Figure, run: Flown, drawn: Any) -> None:
    """One, below the bodies: it covers nothing."""
    if len(run.bodies) <= MANY:
        named = [(Patch(facecolor=run.colors[n], alpha=0.8), n) for n in run.colors]
        if len(run.agents) > 1 and run.pairs:
            named.append((drawn.get(run.pairs[0]), "pair of bodies, in both colours"))
    else:
        near = [(pair, run.nearness(pair)) for pair in run.pairs]
        named = [(drawn[pair], "%s, %s%s" % (*pair, ": %.3g m" % m if m > 0 else "")) for pair, m in near]
    goals = collections.Counter(goal["agent"] for goal in run.run["goals"])
    several = len(goals) > 3
    for agent, count in list(goals.items())[:1 if several else 3]:
        named.append((plt.Line2D([], [], color=GREY if several else run.colors[agent], marker="*", markersize=7, linestyle=""),
                      "goals, each in its agent's colour" if several else
                      ("goal of " if count == 1 else "goals of ") + agent))
    if run.pairs and any(p["verdict"] == "avoided" for p in run.proof["pairs"]):
        named.append((plt.Line2D([], [], color=GREY, marker="o", markersize=4.5, linestyle=""), "least distance, proved"))
        named.append((plt.Line2D([], [], color=GREY, linewidth=1.2), "m: were all to go straight on"))
    if named:
        figure.legend(*zip(*named), loc="lower left", bbox_to_anchor=(0.01, 0.0), ncol=3, frameon=False, fontsize=6.5,
                      handlelength=1.8, columnspacing=1.2, labelspacing=0.3)


def mark_events(figure: Figure, panels: Any, run: Flown) -> None:
    marked = [e for e in run.events if e["event"] in DASHES]
    marked += [{"event": "contact", "t": p["to"]} for p in run.passages if p["verdict"] == "touched"]
    if len(marked) > 2 * MANY:  # a forest says nothing; contacts always do
        marked = [e for e in marked if e["event"] == "contact"]
    for event in marked:
        dash = DASHES[event["event"]]
        color = "red" if event["event"] == "contact" else GREY
        for axis in panels:
            axis.axvline(event["t"], color=color, linestyle=dash, linewidth=0.7)
    forest = not any(e["event"] != "contact" for e in marked)
    dotted = "out of the cone" if run.encounters else "beside"
    figure.text(0.66, 0.985, "red: meets" if forest else "dotted: %s, dashed: passes, red: meets" % dotted, fontsize=6.5,
                va="top", color=GREY)


def mark_contacts(space: Axes, run: Flown) -> None:
    for pair in [*run.proof["pairs"], *run.passages]:
        if pair["verdict"] == "touched":
            place = pair["place"][:2] if run.planar else pair["place"]
            space.plot(*[[c] for c in place], "x", color="red", markersize=6, zorder=10)


def picture(run: Flown) -> Any:
    """The whole picture, a figure."""
    figure = plt.figure(figsize=(TWO_COLUMNS, 4.6))
    if run.planar:
        space = figure.add_axes([0.07, 0.2, 0.47, 0.7])
        ways_in_plane(space, run)
    else:
        space = figure.add_axes([0.0, 0.12, 0.53, 0.82], projection="3d", computed_zorder=False)
        ways_in_space(space, run)
        low = 0.37 if close_up(figure, run, space) else 0.2
        fill(space, (0.04, low, 0.47, 0.9 - low), 40 if run.rims else 55)
    verdict = run.run["verdict"]
    kept = [p["least_distance"] for p in run.proof["pairs"] if p["verdict"] == "avoided"]
    said = {"undecided": "", "avoided": ", proved%s" % (": %s m apart or more" % brief(min(kept)) if kept else "")}
    figure.text(0.01, 0.985, "%s: %s%s" % (run.run["scenario"], verdict, said.get(verdict, ", proved")), fontsize=9, va="top")
    figure.text(0.01, 0.945, "bodies at t = %s s, later ones darker" % ", ".join("%.3g" % t for t in run.instants),
                fontsize=7, va="top", color=GREY)
    panels, drawn = over_time(figure, run)
    legend(figure, run, drawn)
    mark_events(figure, panels.values(), run)
    mark_contacts(space, run)
    return figure
