#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What readers of checker/vericone_check.py tried who asked which false certificate it would accept: none of these. Those of
one changed value are in false_certificates.py. Environment: VERICONE_SOURCE."""
import copy
import json
import subprocess
import sys
import time
import unittest

import make
from checker_test import PROGRAM, example, status

BALL = {"kind": "ball", "center": [0, 0, 0], "radius": 1}
FAR = {"kind": "ball", "center": [9, 0, 0], "radius": 1}
UNIT = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
HUGE, TINY = "1" + "0" * 4000, "1/1" + "0" * 4000
PLANE = {"rule": "plane", "n": [1, 0, 0]}


def disjoint(obstacle, proof, agent=None, **more):
    return make.certificate({"says": "disjoint", "agent": agent or BALL, "obstacle": obstacle, **more}, proof)


def moving(says, obstacle, proof, velocity, horizon=None, **more):
    return make.certificate({"says": says, "horizon": horizon, "agent": {**BALL, "velocity": velocity},
                             "obstacle": {**obstacle, "velocity": [0, 0, 0]}, **more}, proof)


def run_of(says, bodies, tracks, proof, **more):
    return make.certificate({"says": says, "from": 0, "to": 2, "bodies": bodies, "tracks": tracks, **more}, proof)


def track(*positions, times=(0, 2), radius=0, **more):
    return {"times": list(times), "positions": [list(p) for p in positions], "radius": radius, **more}


def apart(tracks, planes, times=(0, 2), bodies=(BALL, BALL), **more):
    return run_of("apart", list(bodies), tracks, {"rule": "pairs", "pairs": {"0 1": {
        "rule": "pieces", "times": list(times), "planes": planes}}}, by=0, pairs=[[0, 1]], **more)


class Attacks(unittest.TestCase):
    def refused(self, document, codes=(1, 2)):
        code, said = status(document)
        self.assertIn(code, codes, f"{document}: {said}")

    def accepted(self, document):
        code, said = status(document)
        self.assertEqual(code, 0, said)

    def test_what_is_no_body(self):
        """Where a proof does not look at all of a body, what stands there must be one all the same."""
        dented = {"kind": "delimited", "center": [9, 0, 0], "factor": UNIT}
        self.accepted(disjoint({**dented, "delimiters": [{"matrix": UNIT, "level": 1}]}, PLANE))
        for matrix in ([[1, 0], [0, 1]], [], [[1]], [[1, 2, 0], [0, 1, 0], [0, 0, 1]]):
            self.refused(disjoint({**dented, "delimiters": [{"matrix": matrix, "level": 1}]}, PLANE), (2,))
        flat = {"kind": "delimited", "center": [9, 0], "factor": [[1, 0], [0, 1]], "delimiters": [{"matrix": UNIT, "level": 1}]}
        self.refused(disjoint(flat, {"rule": "plane", "n": [1, 0]}, {"kind": "ball", "center": [0, 0], "radius": 1}), (2,))
        quadrics = {"kind": "quadrics", "matrices": [[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, -4]]]}
        deep = {"rule": "point", "time": 0, "point": [0, 0, 0], "inside": "agent"}
        for body in (quadrics, {"kind": "union", "pieces": [quadrics]}):
            self.refused(make.certificate({"says": "overlapping", "agent": BALL, "obstacle": body}, deep), (2,))
            self.refused(run_of("near", [BALL, body], [track([[0, 0, 0]])] * 2, {"rule": "point", "time": 1, "point": [0, 0, 0]},
                                by=1, pair=[0, 1]), (2,))
        for body in ({"kind": "mesh", "points": [[9, 0, 0]], "triangles": []}, {"kind": "cloud", "points": [], "radius": 1},
                     {"kind": "boxes", "boxes": []}, {"kind": "union", "pieces": []}, {"kind": "hull", "points": []},
                     {"kind": "cloud", "points": [[9, 0, 0], [9, 0]], "radius": 1}, {**FAR, "radius": -1}, {**FAR, "radius": "-0/1"},
                     {**FAR, "radius": "nan"}, {**FAR, "radius": "NaN"}, {**FAR, "center": [9, 0, "inf"]}, {**FAR, "center": [9, 0]},
                     {"kind": "box", "low": [9, 0, 0], "high": [8, 1, 1]}, {"kind": "wall", "outline": [[1, 0], [0, 1]], "extent": 2},
                     {"kind": "ellipsoid", "shape": [[1, 0, 0], [0, 1, 2], [0, 2, 1]], "center": [9, 0, 0]},
                     {"kind": "union", "pieces": [{"kind": "union", "pieces": [FAR]}]}):
            self.refused(disjoint(body, PLANE), (0, 2) if body.get("radius") == "-0/1" else (2,))

    def test_planes(self):
        """Levels of which one is too near, made up for by the other; a normal that vanishes, is huge, is tiny."""
        near = {**BALL, "center": [2, 0, 0]}
        self.accepted(disjoint(FAR, {**PLANE, "agent_at_most": 1, "obstacle_at_least": 8}))
        for obstacle, n, low, high in ((near, 1, 0, 1), (near, 1, 1, 2), (near, 1, 1, "1000001/1000000"), (near, 0, -1, 1), (near, 0, 0, 0),
                                       (near, HUGE, HUGE, HUGE), (near, TINY, TINY, TINY), (near, TINY, 0, TINY), (near, -1, 1, 3),
                                       (near, "1/3", "1/3", "333334/1000000"), (near, 1, "999999/1000000", 1)):
            self.refused(disjoint(obstacle, {"rule": "plane", "n": [n, 0, 0], "agent_at_most": low, "obstacle_at_least": high}))
        for n in (0, HUGE, TINY, -1, 1):
            self.refused(disjoint(near, {"rule": "plane", "n": [n, 0, 0]}))
        for n in (HUGE, TINY, 1):  # the size of n means nothing
            self.accepted(disjoint(FAR, {"rule": "plane", "n": [n, 0, 0]}))
        for radius in (1, "1" + "0" * 300, 1e300):
            self.refused(disjoint({**FAR, "radius": radius, "center": [radius, 0, 0]}, PLANE))
        hair = {**BALL, "center": [f"2{'0' * 300}1/1{'0' * 301}", 0, 0]}  # apart by 10^-301
        levels = {**PLANE, "agent_at_most": 1, "obstacle_at_least": f"1{'0' * 300}1/1{'0' * 301}"}
        self.accepted(disjoint(hair, levels))
        self.refused(disjoint({**hair, "radius": f"1{'0' * 300}1/1{'0' * 301}"}, levels))

    def test_time(self):
        """Before the horizon, after it, between the pieces of it."""
        past = {**FAR, "center": [-9, 0, 0]}
        hit = {"rule": "point", "time": -9, "point": [-9, 0, 0], "inside": "agent"}
        self.refused(moving("in", past, hit, [1, 0, 0]))
        self.refused(moving("in", past, hit, [1, 0, 0], [-9, None]), (2,))
        self.accepted(moving("out", past, {"rule": "plane", "n": [-1, 0, 0]}, [1, 0, 0]))
        self.refused(moving("out", FAR, PLANE, [1, 0, 0]))
        self.refused(moving("out", FAR, PLANE, [1, 0, 0], 7))
        self.accepted(moving("out", FAR, PLANE, [1, 0, 0], 6.99))
        either = [PLANE, {"rule": "plane", "n": [-1, 0, 0]}]
        for cuts in ([6.9], [12], [6.9, 6.9], [12, 6.9], [9], [-1], [None], [HUGE], [TINY], []):
            proofs = (either * 2)[:len(cuts) + 1]
            self.refused(moving("out", FAR, {"rule": "times", "cuts": cuts, "proofs": proofs}, [1, 0, 0]))
        nested = {"rule": "times", "cuts": [20], "proofs": [{"rule": "times", "cuts": [3], "proofs": either}, either[1]]}
        self.refused(moving("out", FAR, nested, [1, 0, 0]))

    def test_groups(self):
        """A piece that no proof has, has twice, or has from the other body; groups that hold nothing."""
        three = {"kind": "cloud", "points": [[9, 0, 0], [0, 9, 0], [0, 0, 1]], "radius": 1}  # the third one overlaps
        x, y, z = ({"rule": "plane", "n": [float(i == k) for i in range(3)]} for k in range(3))
        for runs, proofs in (([[0, 1], [1, 1]], [x, y]), ([[0, 1], [1, 2]], [x, y]), ([[0, 1], [1, 1], [0, 1]], [x, y]),
                             ([[0, 1], [1, 1], [1, 0]], [x, y]), ([[0, 1], [1, 1], [2, 1]], [x, y, z]), ([[0, 1], [1, 1], [2, 1]], [x, y]),
                             ([[0, 1], [0, 1], [1, 1]], [x, y]), ([[0, 1], [1, 1], [1, True]], [x, y]), ([[0, 1.0], [1, 2]], [x, y]),
                             ([], []), ([[0, 3]], [x])):
            self.refused(disjoint(three, {"rule": "groups", "of": "obstacle", "runs": runs, "proofs": proofs}))
            self.refused(disjoint(three, {"rule": "groups", "of": "agent", "runs": [[0, 1]], "proofs": [
                {"rule": "groups", "of": "obstacle", "runs": runs, "proofs": proofs}]}))
        two = {**three, "points": three["points"][:2]}
        both = {"rule": "groups", "of": "obstacle", "runs": [[0, 1], [1, 1]], "proofs": [x, y]}
        self.accepted(disjoint(two, both))
        self.refused(disjoint(two, {**both, "proofs": [both, y]}))  # of one piece two groups
        self.refused(disjoint(two, {**both, "proofs": [{**both, "of": "agent"}, y]}))
        for boxes in ([[[8, -1, -1], [10, 1, 1]], [[-1, 8, -1], [1, 10, 0.999]]], [[[8, -1, -1], [10, 1, 1]], [[-1, 10, -1], [1, 8, 1]]],
                      [[[8, -1, -1], [10, 1, 1]]] * 2, [[[8, -1, -1], [10, 1, 1]], [[-1, 8], [1, 10]]]):
            self.refused(disjoint(two, {"rule": "cover", "of": "obstacle", "boxes": boxes, "runs": [[0, 1], [1, 1]], "proof": both}))
        far = {"kind": "cloud", "points": [[9, 0, 0], [0, 2, 0]], "radius": 1}
        touch = {"rule": "touch", "n": [0, 1, 0], "time": 0, "point": [0, 1, 0], "obstacle_piece": 1}
        on = {"rule": "groups", "of": "obstacle", "runs": [[0, 1], [1, 1]], "proofs": [x, touch]}
        touching = make.certificate({"says": "touching", "agent": BALL, "obstacle": far}, on)
        self.accepted(touching)
        for proofs in ([touch, touch], [touch, x], [x, y], [{**touch, "obstacle_piece": 0}, touch], [x, {**touch, "obstacle_piece": 0}]):
            self.refused({**touching, "proof": {**on, "proofs": proofs}})

    def test_dents(self):
        """Cuts that are none, taken twice, from beside; products that are negative, and multipliers of another body."""
        document = example("halves", "disjoint")
        for name, value in (("at", 1), ("at", -1), ("normal", [0, 0, 0]), ("normal", [0, -1, 0]), ("normal", [1, 0, 0])):
            bad = copy.deepcopy(document)
            bad["proof"][name] = value
            self.refused(bad)
        for side, other in (("below", "above"), ("above", "below")):
            bad = copy.deepcopy(document)
            bad["proof"][side] = bad["proof"][other]
            self.refused(bad)
        for cut in (1, -1, True, None, "0", 0.0):
            bad = copy.deepcopy(document)
            bad["proof"]["below"]["products"][2][0] = ["cut", cut]
            self.refused(bad)
        self.refused({**document, "proof": document["proof"]["below"]})  # its cut is none without
        larger = copy.deepcopy(document)
        larger["claim"]["agent"]["low"][0] = "-11/10"  # from one dent to the other
        self.refused(larger)
        for products in ([["one", "one", 1]], [["from", "until", 1]], [["until", "one", 1]], [["one", "one", -1]], [["agent", "one", 1]]):
            self.refused(disjoint({**BALL, "center": [1, 0, 0]}, {"rule": "forms", "agent": [1], "obstacle": [1], "products": products}))

    def test_means(self):
        """An ellipsoid and a ball as one part of themselves; weights twice, of sum 2, of a part that is none, of what has dents."""
        its = {"kind": "ellipsoid", "center": ["5/2", 0, 0], "factor": [[2, 0, 0], [0, 1, 0], [0, 0, 1]]}

        def at(x, m, inside, body=its, **more):
            return make.certificate({"says": "overlapping", "agent": BALL, "obstacle": body}, {
                "rule": "point", "time": 0, "point": [x, 0, 0], "inside": inside, "obstacle_weights": [[0, 1, [m, 0, 0]]], **more})
        for x, m, inside in (("9/10", "-2/5", "agent"), ("9/10", "-2/5", "obstacle"), ("9/10", "-2/5", "both"), ("1/2", "-1/2", "agent")):
            self.accepted(at(x, m, inside))
            self.accepted(at(x, m, inside, agent_weights=[[0, 1]]))
        dented = {**its, "kind": "delimited", "delimiters": [{"matrix": UNIT, "level": 0}]}
        for bad in (at("1/2", "-1/2", "obstacle"), at("46/100", "-51/100", "agent"), at("9/10", "-39/100", "agent"), at(1, "-3/8", "agent"),
                    at(1, "-3/8", "agent", agent_weights=[[0, 1]]), at("11/10", "-7/20", "obstacle", agent_weights=[[0, 1]]),
                    at("9/10", "-2/5", "agent", dented), at("9/10", "-2/5", "agent", agent_weights=[[1, 1]]),
                    at("9/10", "-2/5", "agent", agent_weights=[[0, 2]]), at("9/10", "-2/5", "agent", agent_weights=[[0, "1/2"], [0, "1/2"]]),
                    at("9/10", "-2/5", "agent", obstacle_weights=[[0, 2, ["-2/5", 0, 0]], [0, -1]])):
            self.refused(bad)

    def test_errors(self):
        """Sets that change places, are larger than what is proved, are of the plane."""
        hit = {"rule": "plane", "n": [0, 1, 0], "agent_at_most": 1, "obstacle_at_least": 2}
        beside = {**BALL, "center": [5, 3, 0]}
        for more, levels in (({"position_error": {"ball": 1}}, {"position_error_at_most": 1}),
                             ({"position_error": {"ball": "1/2"}}, {"position_error_at_most": "1/4"}),
                             ({"position_error": {"ball": "1/2"}}, {}), ({}, {"position_error_at_most": 0}),
                             ({"position_error": {"ball": "1/2"}}, {"velocity_error_at_most": "1/2"}),
                             ({"position_error": {"box": [0, "1/2"]}}, {"position_error_at_most": "1/2"}),
                             ({"position_error": {"ball": "1/2", "box": [0, 0, 0]}}, {"position_error_at_most": "1/2"}),
                             ({"velocity_error": {"ball": TINY}}, {"velocity_error_at_most": TINY})):
            self.refused(moving("out", beside, {**hit, **levels}, [1, 0, 0], **more))
        self.accepted(moving("out", beside, {**hit, "position_error_at_most": "1/2"}, [1, 0, 0], position_error={"ball": "1/2"}))
        document = example("errors", "depends")
        document["proof"]["collides"], document["proof"]["passes"] = document["proof"]["passes"], document["proof"]["collides"]
        self.refused(document)

    def test_runs(self):
        """No pairs, planar bodies, time that goes back, overlaps or is left out, jumps, a segment that is not looked at."""
        line = track([[0, 0, 0]]), track([[9, 0, 0]])
        x = [[1, 0, 0], 1, [1], [1]]
        self.accepted(apart(line, [x]))
        for pairs in ({}, [], [[]], [[0]], [[0, 1, 1]], {"0 1": 1}):
            document = apart(line, [x])
            document["claim"]["pairs"] = pairs
            for proofs in ({}, document["proof"]["pairs"]):
                document["proof"] = {"rule": "pairs", "pairs": proofs}
                self.refused(document)
        for times, planes in (((0, 1), [x]), ((1, 2), [x]), ((0, 2, 1, 2), [x] * 3), ((0, 1, 1, 2), [x] * 3), ((0, 3), [x]), ((2, 0), [x]),
                              ((0, 1, 2), [x]), ((0, 2), [x, x]), ((0, 2), []), ((-1, 2), [x])):
            self.refused(apart(line, planes, times))
        for other in (track([[9, 0, 0]], [[1, 0, 0]], times=(0, 1, 2)), track([[9, 0, 0], [-9, 0, 0]]), track([[9, 0, 0], [-99, 0, 0], [9, 0, 0]]),
                      track([[9, 0, 0]], [[1, 0, 0]], [[9, 0, 0]], times=(0, 1, "1000001/1000000", 2)), track([[9, 0]]),
                      track([[9, 0, 0]], times=(0, 1)), track([[9, 0, 0]], times=(2, 0)), track([[9, 0, 0]], radius=7), track([[9, 0, 0]], radius=-7),
                      track([[9, 0, 0]], radius="nan"), track([[9, 0, 0]], grid=1074), track([[9, 0, 0]], turns=[[[0, 0, 0, 0]]]),
                      track([[9, 0, 0]], turns=[[[1, 0, 0]]]), track([[9, 0, 0]], turns=[[[1, 0, 0, 0]]] * 2), track([[9, 0, 0]], turns=[])):
            self.refused(apart((line[0], other), [x]))
            self.refused(apart((line[0], other), [x, x], (0, 1, 2)))
        for plane in ([[1, 0, 0], 1, [1, -99, 1], [1]], [[1, 0, 0], 0, [1], [1]], [[1, 0, 0], 1, [1], ["99/100"]], [[0, 0, 0], 0, [0], [0]],
                      [[1, 0, 0], 1, [1], [1], []], [[1, 0, 0], 1, [1], [1], [0], []], [[1, 0, 0], 1, [1], [1], [-1], []], [[1, 0], 1, [1], [1]]):
            self.refused(apart(line, [plane]))
        leg = example("chords", "stays")
        leg["claim"]["bodies"][0] = {"kind": "ball", "center": [0, 0], "radius": "1/4"}
        self.refused(leg, (2,))
        leg["claim"]["bodies"][0] = {"kind": "ball", "center": [0, 0, 0], "radius": "1/4"}
        self.accepted(leg)
        leg["claim"]["pair"] = [1, 0]
        self.refused(leg)

    def test_ids_and_answers(self):
        """An answer's verdict is that of its certificate; its id is not looked at, nor that of the claim: it means nothing."""
        document = example("plane", "out")
        for answer in ({"verdict": "in"}, {"verdict": ["out"]}, {"verdict": "OUT"}, {"verdict": None}, {"format": "vericone-certificate"}):
            self.refused({"certificate": document, **answer})
        self.accepted({"certificate": document, "verdict": "out", "id": "another"})
        for value in ([], {}, True, [17]):
            bad = copy.deepcopy(document)
            bad["claim"]["id"] = value
            self.refused(bad, (2,))

    def test_exactly_at_the_edge(self):
        """A body that comes exactly as far as the wall's outer edge does not keep nearer to its middle."""
        proofs = [{"rule": "pieces", "times": [0, 2], "planes": [[n, 1, ["1/2"], ["-1"]]]}
                  for n in ([1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0])]
        for extent, attempt in ((8, self.refused), ("79/10", self.refused), ("8001/1000", self.accepted)):
            wall = {"kind": "wall", "outline": [[1, -1], [1, 1], [-1, 1], [-1, -1]], "extent": extent}
            attempt(run_of("passed", [{**BALL, "radius": "1/2"}, wall], [track([[0, 0, "-15/2"], [0, 0, "15/2"]]), track([[0, 0, 0]])],
                           {"rule": "through", "room": "15/2", "reach": "1/2", "proof": {
                               "rule": "groups", "of": "obstacle", "runs": [[k, 1] for k in range(4)], "proofs": proofs}},
                           pair=[0, 1], along=1))

    def test_meeting_where_a_track_jumps(self):
        """At a time between two segments both count."""
        near, far, there = [[10, 0, 0], [2, 0, 0]], [[100, 0, 0]], [[2, 0, 0], [9, 0, 0]]
        for its, at, attempt in ((track(near, far, times=(0, 1, 2)), 1, self.refused), (track(far, there, times=(0, 1, 2)), 1, self.refused),
                                 (track(near, there, times=(0, 1, 2)), 1, self.accepted), (track(near), 2, self.accepted),
                                 (track(far, there, times=(-1, 0, 2)), 0, self.accepted), (track(near, far, times=(0, 2, 3)), 2, self.accepted)):
            tracks = [its, track([[0, 0, 0]])]
            attempt(run_of("meet", [BALL, BALL], tracks, {"rule": "point", "time": at, "point": [1, 0, 0]}, pair=[0, 1]))
            attempt(run_of("near", [BALL, BALL], tracks, {"rule": "point", "time": at, "point": [1, 0, 0]}, pair=[0, 1], by=0))

    def test_all_of_the_claim_is_told(self):
        def digits(count):
            return "1/" + "7" * count
        tiny, errors = [digits(600)] * 3, {"factor": [[digits(630), 0, 0], [0, digits(630), 0], [0, 0, digits(630)]]}
        obstacle = {"kind": "octree", "center": tiny, "low": ["9" + "0" * 600] * 3, "cell": "7" * 1990, "depth": 0, "tree": "." * 7 + "#"}
        document = moving("out", obstacle, {"rule": "plane", "n": [0, 1, 0]}, tiny, [digits(980), digits(970)], id="i" * 1990,
                          position_error=errors, velocity_error=errors)
        document["claim"]["agent"].update(center=[0, "-" + "7" * 1900, 0], radius=digits(1900))
        document["claim"]["obstacle"]["velocity"] = tiny
        code, said = status(document)
        self.assertEqual(code, 0, said)
        self.assertEqual(json.loads(said[said.index("{"):]), document["claim"])
        self.assertGreater(len(said), 20000)

    def test_covers_of_what_is_none(self):
        box = {"rule": "cover", "boxes": [[[-1, -1, -1], [1, 1, 1]]], "runs": [[0, 1]]}
        for of in ("x", "w", "says", "t0", "agent ", ""):
            self.refused(disjoint(FAR, {**box, "of": of, "proof": PLANE}), (2,))
            document = apart((track([[0, 0, 0]]), track([[9, 0, 0]])), [[[1, 0, 0], 1, [1], [1]]])
            document["proof"]["pairs"]["0 1"] = {**box, "of": of, "proof": document["proof"]["pairs"]["0 1"]}
            self.refused(document, (2,))
        self.accepted(disjoint(FAR, {**box, "of": "agent", "proof": PLANE}))

    def test_files_begin_with_what_they_begin_with(self):
        document = json.dumps(example("plane", "out")).encode()
        for data in (b"\n" + document + b"\n" + document, b" \r\n\n" + document + b"\n\n" + document + b"\n"):
            code, said = status(data)
            self.assertEqual((code, said.count("accepted")), (0, 2), said)
        self.accepted(b"\n\n" + json.dumps(example("plane", "out"), indent=1).encode())

    def test_small_files_take_little(self):
        """Long denominators of many points, of many bodies; octrees without cells, or with escaped ones; long characters."""
        def cloud(count, ends=(), **more):
            return {"kind": "cloud", "radius": 1, "points": [[f"1/{end}", 0, 0] for end in ends] + [[k, 1, 1] for k in range(count)], **more}
        wide, unit = [10 ** 640 + 1, 10 ** 641 + 3], {**PLANE, "n": [-1, 0, 0]}
        before = {**FAR, "center": [-9, 0, 0]}
        octree = {"kind": "octree", "low": [0, 0, 0], "cell": 1, "depth": 0, "tree": "#......."}
        many = apart([track([[0, 0, 0]])] * 40, [[[1, 0, 0], 1, [1], [1]]], bodies=[cloud(900, (10 ** 2300 + 1, 10 ** 2301 + 3))] * 40)
        files = [disjoint(before, unit, cloud(30000, wide)), disjoint(before, unit, cloud(30000, center=[f"1/{wide[0] * wide[1]}", 0, 0])),
                 json.dumps(disjoint(before, unit, {**octree, "tree": "." * 10 ** 7})),
                 json.dumps(disjoint(before, unit, {**octree, "tree": "@" * 400000})).replace("@", "\\u0023"),
                 json.dumps(disjoint(before, unit, {**octree, "kind": "\U0001f600" + "." * 39 * 10 ** 6}), ensure_ascii=False),
                 json.dumps(disjoint(before, unit, {**octree, "kind": "\U0001f600" + "." * 39 * 10 ** 6}))]
        most = "import resource, subprocess, sys; done = subprocess.run(sys.argv[1:], stdin=sys.stdin, capture_output=True); " \
            "print(done.returncode, resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss, done.stderr.decode()[-300:])"
        for k, data in enumerate([*files, *([many] if sys.platform == "linux" else [])]):
            data = (data if isinstance(data, str) else json.dumps(data)).encode()
            done = subprocess.run([sys.executable, "-c", most, sys.executable, PROGRAM, "-"], input=data, capture_output=True, check=True)
            code, kilobytes, *errors = done.stdout.decode().split()
            self.assertEqual((code, errors), ("2", []), k)
            self.assertLess(int(kilobytes), 195_000, k)
        self.accepted(disjoint(before, unit, cloud(3, wide)))

    def test_time_of_unions(self):
        """It grows as the number of pieces does."""
        seconds = []
        for count in (2000, 20000):
            start = time.process_time()
            self.accepted(disjoint({**FAR, "center": [-9, 0, 0]}, {**PLANE, "n": [-1, 0, 0]}, {"kind": "union", "pieces": [BALL] * count}))
            seconds.append(time.process_time() - start)
        self.assertLess(seconds[1], 20 * seconds[0])


if __name__ == "__main__":
    unittest.main()
