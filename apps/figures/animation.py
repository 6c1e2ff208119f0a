# SPDX-License-Identifier: BSD-3-Clause
"""A run of `vericone simulate --animate` as one page, simulation.html: the data in the page of animation.html, which draws
them. Shapes in their own frames, the rows of bodies.csv (thinned), goals, events, contacts."""
import json
import os

import numpy as np
from matplotlib.colors import to_rgb

from plot.bodies import body_colors, is_planar, outline, polygons, posed, radii, surface
from plot.orifices import RIM, orifices, quaternion
from vericone_figures.style import folder, read
from plot.tables import goal_at, groups, rows

MOST_ROWS = 400  # of a body; in between the page interpolates
HAPPENS = {"enters-cone": "enters the cone of", "leaves-cone": "leaves the cone of", "aligned": "is aligned with its goal",
           "reaches-goal": "reaches its goal", "contact": "meets", "cannot-avoid": "cannot avoid",
           "goes-through": "goes through", "goes-beside": "crosses the plane beside", "loses": "loses sight of"}
AT_ORIGIN = {"x": 0.0, "y": 0.0, "z": 0.0, "qw": 1.0, "qx": 0.0, "qy": 0.0, "qz": 0.0, "k": float("nan")}


def numbers(values, digits=6):
    """As short as they may be: a page shows no more digits than these."""
    return [float("%.*g" % (digits, x)) for x in np.ravel(values)]


def unit_grid(n=17):
    """Unit vectors, and the triangles between them."""
    longitude, height = np.meshgrid(np.linspace(0, 2 * np.pi, 2 * n - 1), np.linspace(0, np.pi, n))
    u = np.stack([np.cos(height), np.sin(height) * np.cos(longitude), np.sin(height) * np.sin(longitude)], axis=-1)
    return u.reshape(-1, 3), grid_triangles(*height.shape)


def grid_triangles(across, along):
    index = np.arange(across * along).reshape(across, along)
    a, b, c, d = index[:-1, :-1].ravel(), index[1:, :-1].ravel(), index[1:, 1:].ravel(), index[:-1, 1:].ravel()
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])


def flat_shape(shape):
    if shape["kind"] == "dented_conic":
        angle = np.linspace(0, 2 * np.pi, 120, endpoint=False)
        return {"dented": [shape["a_c"], shape["b_c"]], "points": np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)}
    edge = outline(shape, AT_ORIGIN, 121)[:-1]
    return {"points": np.column_stack([edge, np.zeros(len(edge))])}


def solid_shape(shape, near):
    if shape["kind"] == "dented_quadric":
        u, triangles = unit_grid()
        return {"dented": shape["dented"], "points": u, "triangles": triangles}
    if "boxes" in shape:  # of a map what is around the ways
        boxes = np.array(shape["boxes"]).reshape(-1, 4)
        boxes = boxes[np.all((boxes[:, :3] >= near[0]) & (boxes[:, :3] <= near[1]), axis=1)]
        return {"points": boxes[:, :3], "sizes": boxes[:, 3]}
    if shape["kind"] == "cloud":
        return {"points": np.array(shape["points"]).reshape(-1, 3), "sizes": np.full(len(shape["points"]), shape["radius"])}
    points, triangles, count = [], [], 0
    for face in polygons(shape):
        points.append(np.asarray(face))
        triangles += [[count, count + i, count + i + 1] for i in range(1, len(face) - 1)]
        count += len(face)
    quadrics = [p for p in shape["pieces"] if p["kind"] != "hull"] if "pieces" in shape else [] if points else [shape]
    for quadric in quadrics:
        grid = surface(quadric, AT_ORIGIN, 13)
        points.append(grid.reshape(-1, 3))
        triangles += (count + grid_triangles(*grid.shape[:2])).tolist()
        count += len(points[-1])
    merged, where = np.unique(np.round(np.vstack(points), 12), axis=0, return_inverse=True)
    return {"points": merged, "triangles": where[np.array(triangles)]}


def drawn(shape, row):
    """Points of the shape in the world, to see how far it reaches."""
    points = shape["points"]
    if "dented" in shape:
        kind = {"kind": "dented_quadric", "dented": shape["dented"]}
        points = radii(kind, row["k"], points[:, :len(shape["dented"])])[:, None] * points
    return posed(points, row)


tracks = {name: columns for (name,), columns in groups(rows(folder(), "bodies.csv"), "body").items()}
encounters = groups(rows(folder(), "encounters.csv"), "agent", "obstacle")
proof, run = read("proof.json"), read("run.json")
shapes = {s["name"]: s for s in read("shapes.json")}
planar = is_planar(shapes)
agents = list(dict.fromkeys(agent for agent, _ in encounters))
colors = body_colors(list(tracks), agents)
flown = np.nan_to_num(np.vstack([np.stack([tracks[n][c] for c in "xyz"], axis=-1) for n in agents or tracks]))

bodies, extent = [], [goal_at(g, tracks, t)[None] for g in run["goals"] for t in (0, run["end"])]
for name, columns in tracks.items():
    kept = np.unique(np.linspace(0, len(columns["t"]) - 1, MOST_ROWS).round().astype(int))
    track = {n: np.nan_to_num(v[kept]) for n, v in columns.items() if n != "body"}
    first = {n: v[0] for n, v in track.items()}
    aside = 0.15 * np.ptp(flown, axis=0).max() + 1
    inverse = {**first, "qx": -first["qx"], "qy": -first["qy"], "qz": -first["qz"], "x": 0, "y": 0, "z": 0}
    own = posed(flown - [first["x"], first["y"], first["z"]], inverse)
    shape = flat_shape(shapes[name]) if planar else solid_shape(shapes[name], (own.min(axis=0) - [aside, aside, 1],
                                                                               own.max(axis=0) + [aside, aside, 1]))
    for i in np.unique(np.linspace(0, len(kept) - 1, 20).round().astype(int)):
        extent.append(drawn(shape, {n: v[i] for n, v in track.items()}))
    body = {"name": name, "color": numbers(to_rgb(colors[name]), 3), "t": numbers(track["t"], 9),
            "at": numbers(np.stack([track[c] for c in "xyz"], axis=1), 9),
            "turn": numbers(np.stack([track["q" + c] for c in "wxyz"], axis=1)),
            "points": [numbers(p) for p in shape["points"]]}
    if "dented" in shape:
        body.update({"dented": shape["dented"], "k": numbers(track["k"])})
    if "triangles" in shape:
        body["triangles"] = np.asarray(shape["triangles"]).tolist()
    if "sizes" in shape:
        body["sizes"] = numbers(shape["sizes"])
    for goal in [g for g in run["goals"] if g["agent"] == name]:
        moves = "velocity" in goal or "follows" in goal
        point = numbers([goal_at(goal, tracks, t) for t in track["t"]], 9) if moves else goal["point"]
        body.setdefault("goals", []).append({"point": point, "reached": goal["reached"]})
    bodies.append(body)

for orifice in orifices(folder()):  # rims, as flat bands
    times = np.linspace(orifice.appears, run["end"], 2 if not orifice.spin.any() else MOST_ROWS)
    points, triangles = orifice.band(0.06 * np.linalg.norm(orifice.own, axis=1).max())
    turns, before = [], None
    for t in times:
        q = np.array(quaternion(orifice.rotation(t)))
        turns.append(-q if before is not None and q @ before < 0 else q)
        before = turns[-1]
    extent += [orifice.rim(t) for t in np.linspace(orifice.appears, run["end"], 20)]
    bodies.append({"name": orifice.name, "color": numbers(to_rgb(RIM), 3), "t": numbers(times, 9),
                   "at": numbers([orifice.center(t) for t in times], 9), "turn": numbers(turns),
                   "points": [numbers(p) for p in points], "triangles": triangles.tolist()})

extent = np.vstack([e.reshape(-1, 3) for e in extent])
low, high = extent.min(axis=0), extent.max(axis=0)
room = np.maximum(0.03 * (high - low), 0.02 * (high - low).max())
events = [{"t": e["t"], "text": ("%.2f s: %s %s %s" % (e["t"], e["agent"], HAPPENS.get(e["event"], e["event"]), e["obstacle"])).strip()}
          for e in rows(folder(), "events.csv")]
contacts = [{"t": p["from"], "place": p["place"]} for p in proof["pairs"] + proof.get("passages", [])
            if p["verdict"] == "touched"]
data = {"title": "%s: %s%s" % (run["scenario"], run["verdict"], "" if run["verdict"] == "undecided" else ", proved"),
        "planar": planar, "end": run["end"], "low": numbers(low - room), "high": numbers(high + room),
        "bodies": bodies, "events": events, "contacts": contacts}
with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "animation.html"), encoding="utf-8") as f:
    page = f.read()
# No name of a body can end the element that holds the data.
text = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
with open(os.path.join(folder(), "simulation.html"), "w", encoding="utf-8") as f:
    f.write(page.replace("@DATA@", text))
