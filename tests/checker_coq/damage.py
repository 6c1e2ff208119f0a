# SPDX-License-Identifier: BSD-3-Clause
"""Small damages of certificates: one number, one index, one field, one entry of a list, two bodies exchanged."""
import copy
import json
import math
import re

NUMBER = re.compile(r"-?[0-9]+(/[0-9]+)?")


def leaves(value, found, parent=None, key=None):
    """(parent, key) of all numbers, and of all lists and objects."""
    if isinstance(value, dict):
        found[1].append((parent, key))
        for k, v in value.items():
            leaves(v, found, value, k)
    elif isinstance(value, list):
        found[1].append((parent, key))
        for k, v in enumerate(value):
            leaves(v, found, value, k)
    elif isinstance(value, (int, float)) or (isinstance(value, str) and NUMBER.fullmatch(value)):
        found[0].append((parent, key))


def other_number(rng, x):
    kind = rng.randrange(9)
    if isinstance(x, str):
        top, _, bottom = x.partition("/")
        return [f"{int(top) + 1}/{bottom or 1}", f"{int(top) - 1}/{bottom or 1}", f"{-int(top)}/{bottom or 1}",
                f"{top}/{int(bottom or 1) + 1}", f"{top}/0", "0", f"{int(top) * 10 + 1}/{int(bottom or 1) * 10}",
                x + " ", f"{top}/-{bottom or 1}"][kind]
    if kind == 0:
        return math.nextafter(float(x), math.inf)
    if kind == 1:
        return math.nextafter(float(x), -math.inf)
    if kind == 2:
        return -x
    if kind == 3:
        return 0
    if kind == 4:
        return x + 1
    if kind == 5:
        return x - 1
    if kind == 6:
        return x * 2
    if kind == 7:
        return x * (1 + 1e-12) + 1e-15
    digits = list(repr(x))
    at = rng.choice([i for i, c in enumerate(digits) if c.isdigit()])
    digits[at] = str(rng.randrange(10))
    try:
        return json.loads("".join(digits))
    except ValueError:
        return x + 3


def damaged(rng, certificate, another):
    """A copy with one damage. Another certificate lends its claim or its proof."""
    value = copy.deepcopy(certificate)
    found = ([], [])
    leaves(value["claim"], found, value, "claim")
    leaves(value["proof"], found, value, "proof")
    kind = rng.randrange(20)
    if kind < 13:
        parent, key = rng.choice(found[0])
        parent[key] = other_number(rng, parent[key])
        return value
    lists = [one for parent, key in found[1] if isinstance(one := parent[key], list) and one]
    if kind < 15 and lists:
        one = rng.choice(lists)
        what = rng.randrange(3)
        if what == 0:
            del one[rng.randrange(len(one))]
        elif what == 1:
            one.append(copy.deepcopy(rng.choice(one)))
        else:
            i, j = rng.randrange(len(one)), rng.randrange(len(one))
            one[i], one[j] = one[j], one[i]
        return value
    claim = value["claim"]
    if kind == 15 and "agent" in claim:
        claim["agent"], claim["obstacle"] = claim["obstacle"], claim["agent"]
    elif kind == 16 and "agent" in claim:
        claim["says"] = rng.choice(["out", "in", "on", "disjoint", "overlapping", "touching"])
    elif kind == 17:
        value["proof"] = copy.deepcopy(another["proof"])
    elif kind == 18:
        parent, key = rng.choice(found[1])
        if isinstance(parent[key], dict):
            names = list(parent[key])
            if rng.random() < 0.5 and names:
                del parent[key][rng.choice(names)]
            else:
                parent[key]["further"] = 1
    elif "horizon" in claim:
        claim["horizon"] = rng.choice([None, 0, 1, [0, None], [1, 2], [2, 1], -1])
    return value
