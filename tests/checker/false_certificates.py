# SPDX-License-Identifier: BSD-3-Clause
"""What is changed in an example (rule, what it says, which of these) and where: each makes it false, or no certificate."""

DROP = object()  # in place of a value: nothing is left there

# The false certificates that a checker with one mistake would accept: what is changed in an example.
OUT, POINT, TOUCH = ("plane", "out"), ("point", "in"), ("touch", None)
MEET, DENT = ("point", "meet", 1), ("pairs", "apart", 1)
CYLINDER, DISC, STANDS = ("plane", "out", 2), ("point", "in", 1), ("touch", "touching")
FALSE = [
    # numbers
    *((OUT, ["claim", "agent", "velocity", 0], x) for x in (
        "0/0", "1/0", "1/-1", "1_000", " 1/2", "1/2 ", "１", "+1", "1e3", "0x1", "", "-", "1/", "1/2/3", "inf", "nan", None, True,
        [], {}, "1" * 4301, "1\n")),
    (OUT, ["proof", "across_w"], ["0/0", "0/0", "0/0"]), (OUT, ["proof", "across_w"], [0, "0/0", "0/0"]),
    (OUT, ["proof", "across_w"], [0, 0, 0]), (OUT, ["proof", "across_w"], [1, 1, 0]), (OUT, ["proof", "across_w"], [True, 1, 0]),
    (OUT, ["proof", "across_w"], [-3, 1, 0]), (OUT, ["proof", "across_w"], [0.0, 1, 0]), (OUT, ["proof", "across_w"], [0, -1, 0]),
    # squares: a support below, with the right square
    (OUT, ["proof", "agent_at_most"], -10), (OUT, ["proof", "agent_at_most"], "99999/10000"),
    (OUT, ["proof", "obstacle_at_least"], "800001/10000"), (OUT, ["proof", "obstacle_at_least"], 10),
    (TOUCH, ["claim", "agent", "radius"], -1), (TOUCH, ["claim", "obstacle", "shape", 1, 1], -1),
    (TOUCH, ["claim", "obstacle", "shape", 2, 2], 0), (TOUCH, ["claim", "obstacle", "shape", 0, 1], 1),
    (TOUCH, ["proof", "n"], [0, -1, 0]), (TOUCH, ["proof", "n"], [0, 0, 0]), (TOUCH, ["proof", "n"], [1, 1, 0]),
    (TOUCH, ["proof", "n"], [0, 1]), (TOUCH, ["proof", "time"], -5), (TOUCH, ["proof", "point", 1], "1000001/1000000"),
    (TOUCH, ["claim", "obstacle", "center", 1], "1999999/1000000"), (TOUCH, ["claim", "obstacle", "center", 1], "2000001/1000000"),
    (TOUCH, ["claim", "horizon"], 4), (TOUCH, ["claim", "horizon"], [6, None]), (TOUCH, ["claim", "says"], "in"),
    (TOUCH, ["claim", "says"], "out"), (TOUCH, ["claim", "says"], "touching"), (POINT, ["claim", "says"], "on"),
    (POINT, ["proof", "point"], ["11/2", "1/2", "0"]), (POINT, ["proof", "time"], 10), (POINT, ["claim", "horizon"], [0, 4]),
    (POINT, ["claim", "horizon"], [5, 4]), (POINT, ["claim", "horizon"], [-1, 5]), (POINT, ["claim", "horizon"], -1),
    (POINT, ["claim", "horizon"], []), (POINT, ["claim", "horizon"], DROP), (POINT, ["proof", "inside"], "neither"),
    (POINT, ["proof", "obstacle_weights"], []), (POINT, ["proof", "obstacle_weights"], DROP),
    (POINT, ["proof", "obstacle_weights"], [[0, "1/2"], [1, "1/6"], [2, "1/3"]]),
    (POINT, ["proof", "obstacle_weights", 0], [0, "-1/2"]), (POINT, ["proof", "obstacle_weights", 0], [-4, "1/2"]),
    (POINT, ["proof", "obstacle_weights", 0], [1, "1/2"]), (POINT, ["proof", "obstacle_weights", 0], [4, "1/2"]),
    (POINT, ["proof", "obstacle_piece"], -1), (POINT, ["proof", "obstacle_piece"], 1), (POINT, ["proof", "agent_piece"], True),
    (POINT, ["proof", "agent_piece"], False), (POINT, ["proof", "agent_piece"], ""), (POINT, ["proof", "agent_piece"], 0.0),
    (("forms", "out"), ["proof", "products"], False), (("forms", "out"), ["proof", "products"], ""),
    # flat, round and straight parts
    (CYLINDER, ["proof", "agent_at_most"], "999999/1000000"), (CYLINDER, ["proof", "obstacle_at_least"], "2500001/1000000"),
    (CYLINDER, ["claim", "obstacle", "margin"], 0.50001),
    (CYLINDER, ["claim", "obstacle", "margin"], -0.5), (CYLINDER, ["claim", "agent", "margin"], "1/1000000"),
    (CYLINDER, ["claim", "agent", "parts", 1, "factor", 1, 1], 1.0001), (CYLINDER, ["claim", "agent", "parts", 1, "factor", 1, 0], 0.01),
    (CYLINDER, ["claim", "agent", "parts"], []), (CYLINDER, ["claim", "agent", "parts", None], {"center": [0, 1.01, 0]}),
    (CYLINDER, ["claim", "agent", "parts", None], {"center": [0, 0]}), (CYLINDER, ["claim", "agent", "parts", None], {}),
    (CYLINDER, ["claim", "agent", "parts", 0, "shape"], [[1, 0, 0], [0, 1, 0], [0, 0, 1]]), (CYLINDER, ["proof", "agent_multipliers"], [1]),
    (CYLINDER, ["claim", "agent", "parts", 0], {"center": [0, 0, 0], "shape": [[1, 0, 0], [0, 1, 0], [0, 0, 0]]}),
    (CYLINDER, ["claim", "agent", "parts", 0, "factor"], [[1, 0], [0, 1]]), (CYLINDER, ["claim", "agent", "parts", 0, "margin"], 0),
    (CYLINDER, ["claim", "agent", "parts", 0], []), (CYLINDER, ["proof"], {"rule": "plane", "n": [0, 1, 0]}),
    (DISC, ["proof", "inside"], "agent"), (DISC, ["proof", "inside"], "obstacle"), (DISC, ["proof", "time"], 4),
    (DISC, ["claim", "obstacle", "points", 0], [0, 0, 0]), (DISC, ["claim", "obstacle", "points", 1], [1, 0, 1]),
    (DISC, ["proof", "agent_weights"], [[0, "1/2"]]), (DISC, ["proof", "agent_weights"], [[0, 1, ["1/100", 0, 0]]]),
    (DISC, ["proof", "agent_weights"], [[0, 1, [0, 0]]]), (DISC, ["proof", "agent_weights"], [[0, 1, 0]]), (DISC, ["proof", "agent_weights"], [[1, 1]]),
    (DISC, ["proof", "agent_weights"], DROP), (DISC, ["proof", "obstacle_weights"], [[0, "1/2"], [1, "1/2", [0, 0, 0]]]),
    (STANDS, ["proof", "agent_weights", 0, 2], ["4/5", "3/5", "1/1000"]), (STANDS, ["proof", "agent_weights", 0, 0], 0),
    (STANDS, ["proof", "agent_weights"], [[1, 1, [2, 0, 0]]]), (STANDS, ["claim", "agent", "margin"], "1/1000"),
    (STANDS, ["claim", "agent", "parts", 1, "factor", 0, 0], "1/2"), (STANDS, ["claim", "agent", "parts", 1, "center", 2], "1001/1000"),
    # the statement
    (OUT, ["version"], 2), (OUT, ["version"], True), (OUT, ["version"], 1.0), (OUT, ["version"], "1"), (OUT, ["format"], "vericone"),
    (OUT, ["extra"], 1), (OUT, ["claim", "extra"], 1), (OUT, ["proof", "extra"], 1), (OUT, ["claim", "agent", "extra"], 1),
    (OUT, ["proof", "agent"], {"kind": "ball"}), (OUT, ["claim", "says"], "in"), (OUT, ["claim", "says"], "on"),
    (OUT, ["claim", "says"], "in_for_all"), (OUT, ["claim", "says"], ["out"]), (OUT, ["claim", "says"], "inside"),
    (OUT, ["claim", "says"], "overlapping"), (OUT, ["claim", "horizon"], DROP), (OUT, ["claim", "agent", "velocity"], [10, 1, 0]),
    (OUT, ["claim", "agent", "velocity"], DROP), (OUT, ["claim", "by"], 8), (OUT, ["claim", "by"], -1), (OUT, ["claim", "id"], {}),
    (OUT, ["claim", "obstacle", "points"], []), (OUT, ["claim", "obstacle", "points", None], [40, 0, 0]),
    (OUT, ["claim", "obstacle", "points", None], [40, 9]), (OUT, ["claim", "obstacle", "kind"], "HULL"),
    (OUT, ["claim", "agent", "factor"], [[3, 0, 0], [0, 1, 0]]), (OUT, ["claim", "agent", "shape"], [[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
    (OUT, ["claim", "position_error"], {"ball": 1}), (OUT, ["claim", "velocity_error"], {"ball": "1/1000000"}),
    (OUT, ["claim", "position_error"], {"ball": -1}), (OUT, ["claim", "position_error"], {"box": [0, -1, 0]}),
    (OUT, ["claim", "position_error"], {}), (OUT, ["proof", "position_error_at_most"], 0), (OUT, ["proof"], []), (OUT, ["proof"], {}),
    (OUT, ["claim", "agent"], {"kind": "file", "name": "../x", "sha256": "0" * 64, "velocity": [0, 0, 0]}),
    # pieces
    (("groups", "out"), ["proof", "runs"], [[0, 1]]), (("groups", "out"), ["proof", "runs"], [[0, 2]]),
    (("groups", "out"), ["proof", "runs"], [[0, 1], [1, 2]]), (("groups", "out"), ["proof", "runs"], []),
    (("groups", "out"), ["proof", "runs"], [[1, 1], [0, 1]]), (("groups", "out"), ["proof", "runs"], [[0, 1], [0, 0], [1, 1]]),
    (("groups", "out"), ["proof", "runs"], [[0, 1], [-1, 1]]), (("groups", "out"), ["proof", "runs"], [[0, 3], [1, -1]]),
    (("groups", "out"), ["proof", "of"], "agent"), (("groups", "out"), ["proof", "proofs"], []),
    (("groups", "out"), ["proof", "proofs", None], {"rule": "plane", "n": [0, 1, 0]}),
    (("groups", "out"), ["claim", "obstacle", "triangles", 0], [0, 1, 5]), (("groups", "out"), ["claim", "obstacle", "triangles", 0], [0, 1, -1]),
    (("groups", "out"), ["claim", "obstacle", "triangles", None], [0, 1, 3]), (("groups", "out"), ["claim", "obstacle", "triangles"], []),
    (("groups", "out"), ["claim", "says"], "on"),
    # times
    (("times", "out"), ["proof", "cuts"], [4]), (("times", "out"), ["proof", "cuts"], [11]), (("times", "out"), ["proof", "cuts"], [-1]),
    (("times", "out"), ["proof", "cuts"], [0]), (("times", "out"), ["proof", "cuts"], []),
    (("times", "out"), ["proof", "cuts"], ["3/2", "3/2"]), (("times", "out"), ["proof", "proofs", 1], DROP),
    # multipliers
    (("forms", "out"), ["proof", "agent"], [-5]), (("forms", "out"), ["proof", "agent"], [0]), (("forms", "out"), ["proof", "obstacle"], [0, 0]),
    (("forms", "out"), ["proof", "obstacle"], [1]), (("forms", "out"), ["proof", "obstacle"], [-1, 1]), (("forms", "out"), ["proof", "agent"], []),
    (("forms", "out"), ["proof", "products", 0, 2], -2), (("forms", "out"), ["proof", "products", 0, 0], "until"),
    (("forms", "out"), ["proof", "products", 0, 0], ["cut", 0]), (("forms", "out"), ["proof", "products", 0, 0], ["agent", [1, 0, 0]]),
    (("forms", "out"), ["claim", "agent", "velocity"], [-1, 0, 0]), (("forms", "out"), ["claim", "obstacle", "delimiters", 0, "matrix", 0, 1], 1),
    (("forms", "out"), ["claim", "obstacle", "delimiters"], []), (("forms", "out"), ["claim", "by"], 0.1),
    (("forms", "out"), ["claim", "position_error"], {"ball": 100}), (("forms", "out"), ["claim", "velocity_error"], {"ball": 100}),
    (("halves", "disjoint"), ["claim", "position_error"], {"ball": 100}),
    (("halves", "disjoint"), ["proof", "above"], {"rule": "plane", "n": [0, 1, 0]}), (("halves", "disjoint"), ["proof", "above"], DROP),
    (("halves", "disjoint"), ["proof", "normal"], [0, 1]), (("halves", "disjoint"), ["proof", "below", "products", 2, 0], ["cut", 1]),
    # errors
    (("octants", "in"), ["proof", "nodes", 7], DROP), (("octants", "in"), ["proof", "nodes", 7, 0], 11), (("octants", "in"), ["proof", "nodes", 0, 0], 0),
    (("octants", "in"), ["proof", "nodes", 0, 1], ["9/10", "9/10", 0]), (("octants", "in"), ["claim", "position_error", "ball"], 1),
    (("octants", "in"), ["claim", "velocity_error", "box", 1], 1), (("octants", "in"), ["claim", "horizon"], 4),
    (("errors", "depends"), ["proof", "collides", "position"], [0, "-51/100", 0]), (("errors", "depends"), ["proof", "passes", "position"], [0, 1, 0]),
    (("errors", "depends"), ["proof", "passes", "velocity"], [0, -1, 0]), (("errors", "depends"), ["claim", "position_error"], DROP),
    # inside
    (("vertices", "inside", 1), ["claim", "agent", "points", 2, 2], "21/10"), (("vertices", "inside", 1), ["claim", "agent", "points", 0, 1], "1/1000"),
    # crossings
    (("cross", "in"), ["proof", "pairs", 0, 2], -1), (("cross", "in"), ["proof", "pairs", 0, 2], 0), (("cross", "in"), ["proof", "pairs", 0, 1], -1),
    (("cross", "in"), ["proof", "time"], 6), (("cross", "in"), ["claim", "horizon"], 5), (("cross", "in"), ["proof", "pairs"], []),
    (("cross", "in"), ["proof", "pairs"], [[0, 1, 1], [0, 2, 1]]), (("cross", "in"), ["claim", "obstacle", "points", 0], [5, -3, 1]),
    # runs
    *((("pairs", "apart"), ["proof", "pairs", "0 1", *path], value) for path, value in (
        (["times"], [0, 1]), (["times"], [1, 2]), (["times"], [0, 2, 1]), (["times"], [0, 1, 1, 2]),
        (["planes", 0, 0], [0, -1, 0]), (["planes", 0, 0], [0, 0, 0]), (["planes", 0, 1], "99/100"), (["planes", 0, 1], -1),
        (["planes", 0, 2], ["1/2", "1/2"]), (["planes", 0, 3], ["24/100"]), (["planes", 0, 2], []), (["planes", 1], DROP), (["planes", 0, 2], [2]))),
    (("pairs", "apart"), ["claim", "by"], "3/4"), (("pairs", "apart"), ["claim", "by"], DROP), (("pairs", "apart"), ["claim", "pairs"], []),
    (("pairs", "apart"), ["claim", "pairs"], [[1, 0]]), (("pairs", "apart"), ["claim", "pairs"], [[0, 1], [0, 1]]),
    (("pairs", "apart"), ["claim", "pairs"], [[0, 0]]), (("pairs", "apart"), ["claim", "pairs"], [[0, 2]]), (("pairs", "apart"), ["proof", "pairs"], {}),
    (("pairs", "apart"), ["claim", "tracks", 0, "radius"], "1/2"), (("pairs", "apart"), ["claim", "tracks", 0, "radius"], -1),
    (("pairs", "apart"), ["claim", "tracks", 0, "turns", 0], [[1, 0, 0, 0], [-1, 0, 0, 0]]),
    (("pairs", "apart"), ["claim", "tracks", 0, "turns", 0], [[0, 0, 0, 0], [0, 0, 0, 0]]),
    (("pairs", "apart"), ["claim", "tracks", 0, "turns", 0], [[1, 0, 0, 0], [0, 0, 0, 1]]),
    (("pairs", "apart"), ["claim", "tracks", 0, "times"], [0, 1]), (("pairs", "apart"), ["claim", "tracks", 0, "times"], [0, 0]),
    (("pairs", "apart"), ["claim", "tracks", 1, "grid"], 2), (("pairs", "apart"), ["claim", "tracks", 1, "grid"], -1),
    (("pairs", "apart"), ["claim", "tracks", 0, "grid"], False), (("pairs", "apart"), ["claim", "tracks", 1, "grid"], None),
    (("pairs", "apart"), ["proof", "pairs", "0 1", "planes", 0, 0], [0, 1]), (OUT, ["claim", "id"], None), (("pairs", "apart"), ["claim", "tracks", 0, "grid"], 1.0),
    (("pairs", "apart"), ["claim", "tracks", 1, "grid"], True), (("pairs", "apart"), ["claim", "tracks", 1, "positions", 0, 1], [8, 2, 0]),
    (("pairs", "apart"), ["claim", "to"], 3), (("pairs", "apart"), ["claim", "from"], -1), (("pairs", "apart"), ["claim", "from"], 2),
    (("pairs", "apart"), ["claim", "tracks", 1], DROP), (("pairs", "apart"), ["claim", "bodies", 1, "radius"], 1),
    # octrees and covers
    *((("cover", "disjoint"), path, value) for path, value in (
        (["claim", "obstacle", "tree"], "+....#.+####..........."), (["claim", "obstacle", "tree"], "+....#.+####...........#........"),
        (["claim", "obstacle", "tree"], "+....#.+####...........x"), (["claim", "obstacle", "tree"], "+....#.+"), (["claim", "obstacle", "tree"], ""),
        (["claim", "obstacle", "tree"], "........"), (["claim", "obstacle", "tree"], "+....#.+###+...........#"),
        (["claim", "obstacle", "tree"], "+....#.+###....#...........#"), (["claim", "obstacle", "tree"], "#....#.+####...........#"),
        (["claim", "obstacle", "depth"], 0), (["claim", "obstacle", "depth"], 2), (["claim", "obstacle", "depth"], -1), (["claim", "obstacle", "depth"], 10 ** 9),
        (["claim", "obstacle", "cell"], 0), (["claim", "obstacle", "cell"], -1), (["claim", "obstacle", "cell"], 1), (["claim", "obstacle", "low"], [0, 0]),
        (["claim", "obstacle", "low", 2], "1/1000"), (["claim", "obstacle", "center"], [1, 0, 0]), (["claim", "agent", "radius"], 1),
        (["proof", "boxes", 0, 1, 2], "499/1000"), (["proof", "boxes", 0, 0], [1, 1, "1/2"]), (["proof", "boxes", 1, 0, 2], "501/500"),
        (["proof", "boxes"], []), (["proof", "boxes", 1], DROP), (["proof", "boxes", None], [[0, 0, 0], [1, 1, 1]]), (["proof", "boxes", 0], [[1, 1, 1], [0, 0, 0]]),
        (["proof", "boxes", 0, 0], [0, 0]), (["proof", "runs"], [[1, 4], [0, 2]]), (["proof", "runs"], [[0, 4]]), (["proof", "runs"], [[0, 4], [1, 3]]),
        (["proof", "runs"], [[0, 5], [1, 1]]), (["proof", "runs"], [[0, 6], [1, 0]]), (["proof", "of"], "agent"), (["proof", "proof"], DROP),
        (["proof", "boxes", 0, 1, 0], 2), (["claim", "says"], "touching"), (["claim", "says"], "overlapping"))),
    # nearness, for all motions within the tubes
    *((("point", "near"), path, value) for path, value in (
        (["claim", "by"], "2/5"), (["claim", "by"], "41/100"), (["claim", "by"], DROP), (["claim", "by"], -1), (["claim", "says"], "meet"), (["claim", "says"], "apart"),
        (["claim", "tracks", 0, "radius"], "2/10"), (["claim", "tracks", 1, "radius"], "2/10"), (["proof", "time"], 1), (["proof", "time"], 5), (["proof", "time"], -1),
        (["proof", "agent_weights"], [[0, 1]]), (["proof", "agent_weights"], DROP), (["proof", "agent_weights"], [[1, 2]]), (["proof", "agent_weights"], []),
        (["proof", "obstacle_point"], [2, 1, 0]), (["proof", "obstacle_point"], DROP), (["proof", "agent_depth"], 1), (["proof", "obstacle_depth"], "1/10"),
        (["proof", "agent_point"], [2, "6/5", 0]), (["claim", "tracks", 0, "turns", 0, 0], [1, 0, 0, 0]), (["claim", "pair"], [1, 0]), (["claim", "pair"], [0, 0]),
        (["claim", "pairs"], [[0, 1]]), (["claim", "from"], 3), (["claim", "tracks", 0, "turns", 0, 0], [0, 0, 0, 0]))),
    *((MEET, path, value) for path, value in (
        (["claim", "tracks", 0, "radius"], "11/100"), (["claim", "tracks", 1, "radius"], "21/100"), (["proof", "agent_depth"], "2/10"), (["proof", "agent_depth"], DROP),
        (["proof", "agent_depth"], -1), (["proof", "obstacle_depth"], "2/10"), (["proof", "point"], [2, "9/10", 0]), (["proof", "point"], DROP),
        (["claim", "by"], 1), (["claim", "bodies", 0], {"kind": "delimited", "factor": [[2, 0, 0], [0, 1, 0], [0, 0, 1]], "delimiters": [
            {"matrix": [[0, 0, 0], [0, 0, 0], [0, 0, 0]], "level": 1}]}))),
    # multipliers in runs
    *((DENT, path, value) for path, value in (
        (["claim", "tracks", 1, "radius"], "1/4"), (["claim", "bodies", 0, "delimiters", 0, "level"], 3),
        (["claim", "bodies", 0, "delimiters", 0, "matrix", 0, 0], -9), (["claim", "bodies", 0, "shape", 1, 1], 9),
        (["claim", "tracks", 0, "turns", 0, 1], [8, 0, 0, 8]), (["claim", "by"], "2/10"))),
    *((DENT, ["proof", "pairs", "0 1", "planes", 0, k], value) for k, value in (
        (2, ["16/10"]), (4, []), (4, [5]), (4, [5, -1]), (4, [0, 0]), (4, [5, 1, 1]), (5, [1]), (5, DROP), (1, "1/2"), (0, [0, -1, 0]), (3, [-1]))),
    (("point", "meet"), ["proof", "time"], 1), (("point", "meet"), ["proof", "time"], 5), (("point", "meet"), ["claim", "tracks", 0, "radius"], "1/10"),
    (("point", "meet"), ["proof", "point"], [2, 4, 0]), (("point", "meet"), ["claim", "pair"], [1, 1]),
]
