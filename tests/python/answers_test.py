# SPDX-License-Identifier: BSD-3-Clause
"""The package answers as the command does: verdicts and rungs, and every double to the bit, on the corpus and on random
pairs, one by one and many at once. VERICONE is the command; the campaign asks 100,000 cases."""

from __future__ import annotations

import json
import math
import os
import subprocess
from fractions import Fraction
from pathlib import Path
from typing import Any, Optional

import numpy as np
import numpy.typing as npt
import pytest

import vericone
from vericone import scenes

ROOT = Path(os.environ.get("VERICONE_SOURCE", Path(__file__).resolve().parents[2]))
COMMAND = os.environ.get("VERICONE", str(ROOT / "build/release/apps/vericone"))
Array = npt.NDArray[Any]


def query(cases: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The answers of `vericone query --rung`."""
    text = "".join(json.dumps(case) + "\n" for case in cases)
    done = subprocess.run([COMMAND, "query", "--rung", "-"], input=text, capture_output=True, text=True, check=False)
    answers = [json.loads(line) for line in done.stdout.splitlines()]
    assert len(answers) == len(cases), done.stderr
    return answers


def name(value: Any) -> str:
    return str(value.name).rstrip("_")


def same(a: Optional[float], b: Optional[float]) -> bool:
    """Equal to the bit, as far as numbers in JSON go: null is nothing, NaN or infinite."""
    if b is None:
        return a is None or not math.isfinite(a)
    return a is not None and a == b and math.copysign(1, a) == math.copysign(1, b)


def check(pair: vericone.Pair, v_a: Any, v_b: Any, answer: dict[str, Any]) -> None:
    """One question, as answer.cpp of the command asks it."""
    verdict, rung = pair.verdict(v_a, v_b), pair.rung(v_a, v_b)
    assert name(verdict) == answer["verdict"]
    assert ("certified" if rung is None else name(rung)) == answer["rung"]
    family = pair.guarantee().family
    contact = pair.contact(v_a, v_b)
    if family == "ellipsoids":
        assert same(pair.miss(v_a, v_b).distance, answer["clearance"])
        # The command tells the estimate as it is, a contact keeps it within what is proved.
        time = answer["time_to_contact"]
        within = min(max(time, contact.earliest), contact.latest) if contact and time is not None else time
        assert same(contact.time if contact else None, within)
        assert time is None or contact is None or abs(contact.time - time) <= 1e-6 * (1 + time)
    elif family != "combined" and name(verdict) == "out":
        miss = pair.miss(v_a, v_b)
        assert same(miss.distance, answer["clearance"])
        assert all(map(same, (miss.least, miss.most), answer["clearance_enclosure"]))
    elif contact is not None and name(verdict) != "undecided" and answer["time_enclosure"] is not None:
        assert same(contact.earliest, answer["time_enclosure"][0])
        assert same(contact.latest, answer["time_enclosure"][1])
        assert same(contact.time, answer["time_to_contact"])


# The corpus ------------------------------------------------------------------------------------------------------------


def number(text: str) -> Fraction:
    mantissa, power, exponent = text.partition("*2^")
    return Fraction(mantissa) * Fraction(2) ** int(exponent) if power else Fraction(text)


def numbers(text: str) -> Optional[list[float]]:
    """The doubles; nothing where they are none."""
    exact = [number(one) for one in text.split(",")]
    rounded = [float(one) for one in exact]
    return rounded if all(Fraction(x) == y for x, y in zip(rounded, exact)) else None


def symmetric(upper: list[float]) -> list[list[float]]:
    if len(upper) == 3:
        xx, xy, yy = upper
        return [[xx, xy], [xy, yy]]
    xx, xy, xz, yy, yz, zz = upper
    return [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]


def body_of(fields: dict[str, list[float]], which: str) -> Optional[dict[str, Any]]:
    if which + ".points" in fields:
        points = fields[which + ".points"]
        return {"points": [points[i:i + 3] for i in range(0, len(points), 3)]}
    if which + ".shape" in fields:
        return {"center": fields[which + ".center"], "shape": symmetric(fields[which + ".shape"])}
    if which + ".axes" in fields:
        return {"center": fields[which + ".center"], "semi_axes": fields[which + ".axes"]}
    return None


def corpus(predicate: str) -> list[dict[str, Any]]:
    """Cases for query: those whose numbers are doubles."""
    cases = []
    for line in (ROOT / "tests/corpus" / f"{predicate}.txt").read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        words = line.split(" ")
        fields = {field.partition("=")[0]: numbers(field.partition("=")[2]) for field in words[7:]}
        if any(values is None for values in fields.values()):
            continue
        known = {key: values for key, values in fields.items() if values is not None}
        agent, obstacle = body_of(known, "a"), body_of(known, "b")
        assert agent and obstacle, line
        w = known.get("w", [0.0] * len(agent.get("center", [0, 0, 0])))
        cases.append({"id": words[4], "agent": agent, "obstacle": obstacle, "agent_velocity": w,
                      "obstacle_velocity": [0.0] * len(w)})
    return cases


def placed(body: dict[str, Any], alone: bool = False) -> vericone.Placed:
    """A body by its own constructor; of points, as the command has it, an assembly of one hull unless `alone`."""
    if "points" in body:
        hull = vericone.HullBody(np.array(body["points"]))
        return vericone.Placed(vericone.Body(hull if alone else vericone.Assembly.polyhedra([hull])))
    if "shape" in body:
        return vericone.Placed(vericone.Body(vericone.Ellipsoid.from_shape(body["center"], body["shape"])))
    return vericone.Placed(vericone.Body(vericone.Ellipsoid.from_axes(body["center"], body["semi_axes"])))


def flat(body: dict[str, Any]) -> vericone.CombinedEllipse:
    made = vericone.Ellipse.from_shape(body["center"], body["shape"]) if "shape" in body else \
        vericone.Ellipse.from_axes(body["center"], body["semi_axes"])
    return vericone.CombinedEllipse(made)


def pair_of(case: dict[str, Any]) -> vericone.Pair:
    """Made by the package's own calls, not from the text."""
    if len(case["agent_velocity"]) == 2:
        return vericone.Pair(flat(case["agent"]), flat(case["obstacle"]))
    return vericone.Pair(placed(case["agent"], "points" in case["obstacle"]), placed(case["obstacle"]))


def in_space(velocity: list[float]) -> list[float]:
    return velocity + [0.0] * (3 - len(velocity))


@pytest.mark.parametrize("predicate,least", [("membership", 600), ("sector", 600), ("hull", 500), ("relation", 300),
                                             ("position", 500)])
def test_the_corpus_is_answered_as_by_the_command(predicate: str, least: int) -> None:
    cases = corpus(predicate)
    assert len(cases) >= least
    refused = 0
    for case, answer in zip(cases, query(cases)):
        if "error" in answer:  # the library refuses the body: so does the package
            with pytest.raises(vericone.InputError) as raised:
                pair_of(case)
            assert raised.value.requirement in answer["error"]
            refused += 1
            continue
        check(pair_of(case), in_space(case["agent_velocity"]), in_space(case["obstacle_velocity"]), answer)
        if predicate in ("membership", "sector", "hull"):
            assert answer["verdict"] in (case["id"], "touching", "overlapping")
    assert refused < len(cases) / 10


@pytest.mark.parametrize("predicate", ["membership", "hull"])
def test_scenes_of_text_are_answered_as_by_the_command(predicate: str) -> None:
    cases = corpus(predicate)[::7]
    for case, answer in zip(cases, query(cases)):
        if "error" in answer:
            continue
        scene = scenes.scene_of_text(json.dumps({key: case[key] for key in case if key != "id"}), "none.yaml")
        check(scene.pair(), scene.agent.velocity, scene.obstacle.velocity, answer)


# Random pairs ----------------------------------------------------------------------------------------------------------


def random_body(random: np.random.Generator, center: Array) -> dict[str, Any]:
    if random.uniform() < 0.2:
        return {"points": (center + random.uniform(-2, 2, (8, 3))).tolist()}
    axes = random.uniform(0.2, 3, 3)
    if random.uniform() < 0.5:
        return {"center": center.tolist(), "semi_axes": axes.tolist()}
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    shape = turn @ np.diag(axes**2) @ turn.T
    return {"center": center.tolist(), "shape": (0.5 * (shape + shape.T)).tolist()}


def random_pair(random: np.random.Generator) -> tuple[dict[str, Any], dict[str, Any]]:
    place = random.normal(size=3)
    place *= random.uniform(3, 20) / np.linalg.norm(place)
    return random_body(random, np.zeros(3)), random_body(random, place)


def velocities_towards(random: np.random.Generator, obstacle: dict[str, Any], count: int) -> tuple[Array, Array]:
    """Relative velocities about the obstacle; all floats of 32 bits, so that these are the same numbers."""
    middle = np.mean(obstacle["points"], axis=0) if "points" in obstacle else np.array(obstacle["center"])
    v_b = random.normal(size=(count, 3)).astype(np.float32)
    w = random.uniform(0.1, 3, (count, 1)) * (middle + random.normal(size=(count, 3)) * random.uniform(0, 4, (count, 1)))
    return (w + v_b).astype(np.float32), v_b


@pytest.mark.parametrize("seed", range(4))
def test_random_pairs_are_answered_as_by_the_command(seed: int) -> None:
    ask_random_pairs(seed)


@pytest.mark.campaign
@pytest.mark.parametrize("seed", range(4, 104))
def test_many_random_pairs_are_answered_as_by_the_command(seed: int) -> None:
    ask_random_pairs(seed)


def ask_random_pairs(seed: int) -> None:
    """A thousand cases."""
    random = np.random.default_rng(seed)
    for _ in range(20):
        agent, obstacle = random_pair(random)
        v_a, v_b = velocities_towards(random, obstacle, 50)
        answers = query([{"agent": agent, "obstacle": obstacle, "agent_velocity": [float(x) for x in a],
                          "obstacle_velocity": [float(x) for x in b]} for a, b in zip(v_a, v_b)])
        pair = pair_of({"agent": agent, "obstacle": obstacle, "agent_velocity": [0.0, 0.0, 0.0]})
        for a, b, answer in zip(v_a[:10], v_b[:10], answers):
            check(pair, a, b, answer)
        verdicts = [vericone.Verdict[{"in": "in_"}.get(answer["verdict"], answer["verdict"])] for answer in answers]
        rungs = [answer["rung"] for answer in answers]
        clearances = [answer["clearance"] for answer in answers]
        wide = np.zeros((2 * len(v_a), 6))
        wide[::2, 1::2] = v_a
        arrays = (v_a.astype(float), np.asfortranarray(v_a.astype(float)), v_a, wide[::2, 1::2])
        for array in arrays:
            assert pair.verdict(array, v_b).tolist() == verdicts
            found = pair.rung(array, v_b)
            assert ["certified" if rung is None else name(vericone.Rung(rung)) for rung in found] == rungs
            miss = pair.miss(array, v_b)
            if pair.guarantee().family == "ellipsoids":
                assert all(same(x, y) for x, y in zip(miss.distance.tolist(), clearances))
        # Broadcast: every agent's velocity against one of the obstacle.
        assert pair.verdict(v_a, v_b[0]).tolist() == [pair.verdict(a, v_b[0]) for a in v_a]
        assert pair.verdict(v_a, v_b, threads=2).tolist() == verdicts
