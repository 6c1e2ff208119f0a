# SPDX-License-Identifier: BSD-3-Clause
"""What objects show in Jupyter: a picture and the numbers that matter, with units. Loaded when the first one is
shown."""
from __future__ import annotations

import base64
import html as escape
import io
from collections.abc import Callable
from typing import Any

import numpy as np

Rows = list[tuple[str, str]]
Draw = Callable[[Any], object]
QUICK = ("ellipsoids", "hulls")  # families whose cones take no longer than a picture
MOST_PIECES = 20_000  # of a body that is drawn


def html(thing: Any) -> str | None:
    """A picture and numbers of an object as HTML; None where its text says all. Costs some 0.1 s; never raises for want
    of Matplotlib, and then shows the numbers alone."""
    shown = SHOWN.get(type(thing).__name__)
    if shown is None:
        return None
    rows, flat, draw = shown(thing)
    title = "vericone." + type(thing).__name__
    table = "".join("<tr><th style='text-align:left'>%s</th><td style='text-align:left'>%s</td></tr>" % (
        escape.escape(name), escape.escape(text)) for name, text in rows)
    return "<div style='display:flex;gap:1em;align-items:center'>%s<div><b>%s</b><table>%s</table></div></div>" % (
        picture(draw, flat), title, table)


def picture(draw: Draw | None, flat: bool) -> str:
    """Drawn on a figure of its own, which no window shows and nothing keeps."""
    if draw is None:
        return ""
    try:
        from matplotlib.figure import Figure

        from .plot import style
    except ImportError:
        return ""
    with style():
        figure = Figure(figsize=(3.4, 2.7), constrained_layout=flat)
        axes = (figure.add_subplot() if flat else
                figure.add_axes((0.02, 0.04, 0.9, 0.92), projection="3d", computed_zorder=False))
        if flat:
            axes.set_aspect("equal", adjustable="datalim")
        draw(axes)
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png", dpi=110)
    return "<img alt='' src='data:image/png;base64,%s'>" % base64.b64encode(buffer.getvalue()).decode()


def word(answer: Any) -> str:
    return str(getattr(answer, "name", answer)).rstrip("_")


def vector(x: Any, unit: str) -> str:
    return "(%s) %s" % (", ".join("%.6g" % value for value in np.asarray(x, float).ravel()), unit)


def interval(x: Any, unit: str) -> str:
    """An enclosure: proved to contain the true value."""
    return "%.9g to %.9g %s, proved" % (x.lo(), x.hi(), unit)


def draw_body(thing: Any) -> Draw:
    def draw(axes: Any) -> None:
        from . import plot
        plot.body(thing, axes=axes)
        if not hasattr(axes, "get_zlim"):
            axes.set_xlabel("x (m)")
            axes.set_ylabel("y (m)")
    return draw


def ellipsoid(thing: Any) -> tuple[Rows, bool, Draw | None]:
    flat = len(thing.center()) == 2
    return ([("center", vector(thing.center(), "m")), ("semi-axes", vector(thing.semi_axes(), "m")),
             ("area" if flat else "volume", "%.6g %s" % (thing.volume(), "m²" if flat else "m³"))], flat, draw_body(thing))


def combined(thing: Any) -> tuple[Rows, bool, Draw | None]:
    flat = len(thing.center()) == 2
    return ([("center", vector(thing.center(), "m")), ("semi-axes", vector(thing.ellipsoid().semi_axes(), "m")),
             ("delimited by", "%d %s" % (len(thing.delimiters()), "hyperbolas" if flat else "hyperboloids"))], flat,
            draw_body(thing))


def bounds(box: Any) -> Rows:
    return [("from", vector(box.low, "m")), ("to", vector(box.high, "m"))]


def hull(thing: Any) -> tuple[Rows, bool, Draw | None]:
    points = np.asarray(thing.points())
    return [("corners", str(len(points))), ("from", vector(points.min(axis=0), "m")),
            ("to", vector(points.max(axis=0), "m"))], False, draw_body(thing)


def convex(thing: Any) -> tuple[Rows, bool, Draw | None]:
    swollen = [("margin", "%.6g m" % thing.margin())] if thing.margin() else []
    return [("is", thing.word()), *swollen, *bounds(thing.bounds())], False, draw_body(thing)


def assembly(thing: Any) -> tuple[Rows, bool, Draw | None]:
    return ([("pieces", "%d of the kind %s" % (thing.size(), word(thing.kind()))), *bounds(thing.bounds())], False,
            draw_body(thing) if thing.size() <= MOST_PIECES else None)


def few(body: Any) -> bool:
    return body.assembly() is None or body.assembly().size() <= MOST_PIECES


def body(thing: Any) -> tuple[Rows, bool, Draw | None]:
    return [("kind", word(thing.kind())), *bounds(thing.bounds())], False, draw_body(thing) if few(thing) else None


def placed(thing: Any) -> tuple[Rows, bool, Draw | None]:
    return ([("kind", word(thing.body.kind())), ("position", vector(thing.pose.position, "m")),
             ("middle", vector(thing.middle(), "m"))], False, draw_body(thing) if few(thing.body) else None)


def pair(thing: Any) -> tuple[Rows, bool, Draw | None]:
    promise, now = thing.guarantee(), thing.relation()
    rows = [("bodies", "%s, %s" % (word(thing.agent().body.kind()), word(thing.obstacle().body.kind()))),
            ("now", word(now) if now is not None else "undecided"), ("family", str(promise.family)),
            ("verdicts", "exact" if promise.exact else "right or undecided, tolerance %g" % promise.tolerance)]
    quick = promise.family in QUICK and word(now) == "disjoint"

    def draw(axes: Any) -> None:
        from . import plot
        plot.engagement(thing, axes=axes, cone=quick)

    return rows, False, draw if few(thing.agent().body) and few(thing.obstacle().body) else None


def cone(thing: Any) -> tuple[Rows, bool, Draw | None]:
    angle = thing.solid_angle
    rows = [("solid angle", interval(angle, "sr") if hasattr(angle, "lo") else "%.9g sr" % angle)]
    if hasattr(thing, "relation"):
        rows.append(("bodies", word(thing.relation) if thing.relation is not None else "undecided"))
    if getattr(thing, "method", ""):
        rows.append(("method", str(thing.method)))

    def draw(axes: Any) -> None:
        from . import plot
        plot.cone(thing, axes=axes)
        axes.set_xlabel("right of the line of sight (deg)")
        axes.set_ylabel("above it (deg)")

    has_border = any(len(getattr(thing, name, ())) for name in ("outer", "boundary", "directions"))
    return rows, True, draw if has_border else None


def slice_cone(thing: Any) -> tuple[Rows, bool, Draw | None]:
    rows = [("solid angle", "%.9g sr, of the slices: too small" % thing.polyhedral().solid_angle),
            ("planes", str(len(thing.slices))), ("bodies", word(thing.relation))]

    def draw(axes: Any) -> None:
        from . import plot
        plot.cone(thing, axes=axes)

    return rows, True, draw if len(thing.slices) else None


def cone_map(thing: Any) -> tuple[Rows, bool, Draw | None]:
    rows = [("collides", "%.6g sr" % thing.colliding), ("safe", "%.6g sr" % thing.safe),
            ("undecided", "%.6g sr" % thing.undecided), ("cells", str(len(thing.cells)))]

    def draw(axes: Any) -> None:
        from . import plot
        plot.cone_map(thing, axes=axes)

    return rows, True, draw


def plane_sector(thing: Any) -> tuple[Rows, bool, Draw | None]:
    psi, theta = (x() if callable(x) else x for x in (thing.psi, thing.theta_b))
    rows = [("psi", "%.9g rad, %.6g degrees" % (psi, np.degrees(psi))),
            ("theta_b", "%.9g rad, %.6g degrees" % (theta, np.degrees(theta)))]
    if hasattr(thing, "distance"):
        rows.append(("distance", "%.6g m" % thing.distance))

    def draw(axes: Any) -> None:
        from . import plot
        plot.sector(thing, axes=axes)

    return rows, True, draw


def enclosure(thing: Any) -> tuple[Rows, bool, Draw | None]:
    return [("contains", "%.17g to %.17g, proved" % (thing.lo(), thing.hi())),
            ("width", "%.3g" % (thing.hi() - thing.lo()))], True, None


def contact(thing: Any) -> tuple[Rows, bool, Draw | None]:
    rows = [("first contact", "%.9g s" % thing.time),
            ("not before", "%.17g s, proved" % thing.earliest), ("no later than", "%.17g s, proved" % thing.latest)]
    if thing.point is not None:
        rows.append(("point", vector(thing.point, "m")))
    if thing.normal is not None:
        rows.append(("normal", vector(thing.normal, "")))
    return rows, True, None


def miss(thing: Any) -> tuple[Rows, bool, Draw | None]:
    return [("nearest", "%.9g m, after %.6g s" % (thing.distance, thing.time)),
            ("between", "%.9g and %.9g m, proved" % (thing.least, thing.most)),
            ("normal", vector(thing.normal, ""))], True, None


def run(thing: Any) -> tuple[Rows, bool, Draw | None]:
    rows = [("verdict", word(thing.verdict())), ("end", "%.6g s" % thing.end), ("bodies", str(len(thing.tracks)))]
    for outcome in list(thing.proofs)[:10]:
        proof, name = outcome.proof, word(outcome.proof.verdict)
        says = (", %.6g m or more apart, proved" % proof.least_distance if name == "avoided" else
                ", at %.6g s" % proof.to if name == "touched" else "")
        rows.append(("bodies %d, %d" % (outcome.a, outcome.b), name + says))

    def draw(axes: Any) -> None:
        from . import plot
        for n, track in enumerate(thing.tracks):
            plot.track(track, axes=axes, color="C%d" % (n % 10), bodies=3)

    return rows, False, draw


def fit(thing: Any) -> tuple[Rows, bool, Draw | None]:
    certificate = thing.certificate
    rows = [("shape", "%s, %d piece%s" % (word(thing.shape), len(thing.pieces), "s" * (len(thing.pieces) > 1))),
            ("mode", word(thing.mode)),
            ("inside", "%d of %d points, exact" % (certificate.points_inside, certificate.points))]
    if thing.volume is not None:
        rows.append(("volume", "%.6g m³" % thing.volume.value))

    def draw(axes: Any) -> None:
        from . import plot
        for piece in thing.pieces:
            plot.body(piece.body, axes=axes)

    return rows, False, draw if all(piece.footprint is None for piece in thing.pieces) else None


SHOWN: dict[str, Callable[[Any], tuple[Rows, bool, Draw | None]]] = {
    "Ellipse": ellipsoid, "Ellipsoid": ellipsoid, "CombinedEllipse": combined, "CombinedEllipsoid": combined,
    "HullBody": hull, "Convex": convex, "Assembly": assembly, "Body": body, "Placed": placed, "Pair": pair, "Cone": cone,
    "TrueCone": cone, "ConeBounds": cone, "PolyhedralCone": cone, "SliceCone": slice_cone, "CombinedSliceCone": slice_cone,
    "ConeMap": cone_map, "PlaneSector": plane_sector, "Sector": plane_sector, "Interval": enclosure, "Contact": contact,
    "Miss": miss, "Run": run, "FitResult": fit,
}
