# SPDX-License-Identifier: BSD-3-Clause
"""vericone-check is built in a temporary folder and held against fractions: `python3 -m pytest tests/checker_coq -s`.

Skipped where Coq, OCaml or Zarith is not installed (checker/coq/packages.txt)."""
import importlib.util
import json
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import time
from fractions import Fraction
from pathlib import Path

import pytest

import damage
import make
import truth

ROOT = Path(__file__).resolve().parents[2]
SOURCES = ROOT / "checker" / "coq"
AXIOMS = {"ClassicalDedekindReals.sig_not_dec", "ClassicalDedekindReals.sig_forall_dec",
          "FunctionalExtensionality.functional_extensionality_dep"}


def missing():
    """What is needed and not installed."""
    for program in ("coqc", "ocamlfind", "gcc"):
        if not shutil.which(program):
            return program
    if subprocess.run(["ocamlfind", "query", "zarith"], capture_output=True, check=False).returncode:
        return "zarith"
    return None


@pytest.fixture(scope="session")
def built(tmp_path_factory):
    """A folder with the compiled proofs and vericone-check; VERICONE_CHECK_BUILD names one that stands already."""
    if ready := os.environ.get("VERICONE_CHECK_BUILD"):
        return Path(ready)
    if lacks := missing():
        pytest.skip(f"{lacks} is not installed")
    folder = tmp_path_factory.mktemp("coq")
    began = time.monotonic()
    subprocess.run([SOURCES / "build", folder], check=True)
    print(f"\nproved and compiled in {time.monotonic() - began:.0f} s")
    return folder


@pytest.fixture(scope="session")
def check(built, tmp_path_factory):
    """(exit status, answers) of lines."""
    folder = tmp_path_factory.mktemp("lines")

    def run(lines):
        path = folder / "lines.json"
        path.write_bytes(b"\n".join(line if isinstance(line, bytes) else line.encode() for line in lines) + b"\n")
        done = subprocess.run([built / "vericone-check", path], capture_output=True, check=False, timeout=600)
        assert done.stderr == b""
        found = [line.partition(": ")[2].partition(": ")[2] for line in done.stdout.decode(errors="replace").splitlines()]
        return done.returncode, found
    return run


def test_nothing_is_admitted():
    for path in SOURCES.glob("*.v"):
        text = re.sub(r"\(\*.*?\*\)", "", path.read_text(), flags=re.S)
        assert not re.search(r"\b(Admitted|admit|Axiom|Axioms|Parameter|Parameters|Conjecture|Abort)\b", text), path


def test_axioms_are_those_of_the_reals(built):
    shutil.copy(SOURCES / "Theorems.v", built)
    done = subprocess.run(["coqc", "-q", "-Q", ".", "Vericone", "Theorems.v"], cwd=built, capture_output=True, text=True, check=True)
    names = re.findall(r"^([A-Za-z_.]+)(?: :|$)", done.stdout.partition("Axioms:")[2], flags=re.M)
    assert names and set(names) <= AXIOMS, done.stdout
    assert done.stdout.count("Axioms:") == 6


def test_constructed_certificates_are_accepted(check):
    maker = make.Maker(7)
    values = [getattr(maker, maker.RULES[k % len(maker.RULES)])() for k in range(1100)]
    began = time.monotonic()
    status, answers = check([json.dumps(value) for value in values])
    print(f"\n{len(values)} constructed: {1e3 * (time.monotonic() - began) / len(values):.3f} ms each, read and printed")
    assert [a[:300] for a in answers if not a.startswith("accepted: ")] == []
    assert status == 0
    assert len(answers) == len(values)


def test_damaged_certificates_are_accepted_exactly_where_true(check):
    maker, rng = make.Maker(8), random.Random(8)
    values = [getattr(maker, maker.RULES[k % len(maker.RULES)])() for k in range(1100)]
    lines = [json.dumps(damage.damaged(rng, rng.choice(values), rng.choice(values))) for _ in range(10000)]
    _, answers = check(lines)
    decided = [truth.decide(line) for line in lines]
    wrong = [(line, answer[:200], true) for line, answer, true in zip(lines, answers, decided)
             if answer.startswith("accepted: ") != (true is True)]
    print(f"\n{len(lines)} damaged: {decided.count(True)} still true, {decided.count(False)} false, "
          f"{decided.count(None)} no certificates")
    assert len(answers) == len(lines)
    assert wrong == [], f"{len(wrong)}: {wrong[0]}"
    assert decided.count(True) > 500
    assert decided.count(False) > 1000


BALLS = {"format": "vericone-certificate", "version": 1, "claim": {"says": "out", "horizon": None,
         "agent": {"kind": "ball", "center": [0, 0, 0], "radius": 1, "velocity": [1, 0, 0]},
         "obstacle": {"kind": "ball", "center": [5, 0, 0], "radius": 1, "velocity": [0, 0, 0]}},
         "proof": {"rule": "plane", "n": ["0/0", "0/0", "0/0"]}}


def changed(value, path, new):
    value = json.loads(json.dumps(value))
    *way, last = path
    place = value
    for key in way:
        place = place[key]
    place[last] = new
    return value


@pytest.mark.parametrize("number", ["0/0", "1/0", "1/-1", "-1/0", " 1", "1 ", "1_0", "+1", "１", "1/2/3", "", "-", "/", "0x1",
                                    "1e3", "0.5", "9" * 4301, True, None, [], {}, "1/00"])
def test_no_number(check, number):
    for path in (("proof", "n", 0), ("claim", "agent", "radius"), ("claim", "horizon")):
        if path[-1] != "horizon" or number not in (None, []):
            assert check([json.dumps(changed(changed(BALLS, ("proof", "n"), [1, 0, 0]), path, number))])[0] == 2


def test_the_false_certificate_of_zero_by_zero(check):
    status, answers = check([json.dumps(BALLS)])
    assert status == 2
    assert "denominator of 0" in answers[0]


def test_forms_prove_nothing_of_errors(check):
    page = (ROOT / "docs" / "reference" / "certificates.md").read_text()
    for one in map(json.loads, re.findall(r"```json\n(.*?)```", page, flags=re.S)):
        if one["claim"]["says"] == "out" and one["proof"]["rule"] == "forms":
            for name in ("position_error", "velocity_error"):
                assert check([json.dumps(one)])[0] == 0
                assert check([json.dumps(changed(one, ("claim", name), {"ball": 100}))])[0] == 1


@pytest.mark.parametrize("text", [
    "", "{", "[]", "1", "nul", "{}", '{"a": 1, "a": 2}', '{"format": "vericone-certificate"}', "NaN", "Infinity", "-", "01", "1.",
    ".5", '"\\ud800"', '"\\x"', "[1,]", '{"a" 1}', "\x00", "[1e999]", '"' + "a" * 10])
def test_no_certificate(check, text):
    assert check([text + " "])[0] == 2


def test_deep_nesting_is_no_certificate(check):
    for text in ("[" * 100000, '{"a":' * 100000, "[" * 10**6 + "]" * 10**6):
        assert check([text])[0] == 2


def test_doubled_fields_and_unknown_ones(check):
    good = json.dumps(changed(changed(BALLS, ("proof", "n"), [0, 1, 0]), ("claim", "obstacle", "center"), [0, 5, 0]))
    assert check([good])[0] == 0
    for old, new in (('"version": 1', '"version": 1, "version": 1'), ('"version": 1', '"version": 2'),
                     ('"version": 1', '"version": 1.0'), ('"version": 1', '"version": true'), ('"radius": 1', '"radius": 1, "x": 1'),
                     ('"rule"', '"note": "", "rule"'), ('"horizon": null, ', ""), ('"kind": "ball"', '"kind": "bal"'),
                     ('"radius": 1', '"radius": -1'), ("vericone-certificate", "vericone"), ('"n"', '"across_w": [0, 1, 0], "n"')):
        assert old in good
        assert check([good.replace(old, new, 1)])[0] == 2, new


def test_an_answer_with_another_verdict_is_refused(check):
    good = changed(changed(BALLS, ("proof", "n"), [0, 1, 0]), ("claim", "obstacle", "center"), [0, 5, 0])
    assert check([json.dumps({"verdict": "out", "certificate": good})])[0] == 0
    assert check([json.dumps({"verdict": "in", "certificate": good})])[0] == 1


def test_a_number_is_the_nearest_double(check):
    rng = random.Random(9)
    for _ in range(300):
        bits = rng.getrandbits(63)
        x = struct.unpack("<d", struct.pack("<Q", bits))[0]
        if x != x or x == float("inf"):
            continue
        text = rng.choice([repr(x), f"{x:.25e}", f"{x:.17g}"])
        line = json.dumps(changed(BALLS, ("proof", "n"), [0, 1, 0])).replace('"radius": 1', f'"radius": {text}', 1)
        said = re.search(r"ball of radius (\S+) about", check([line])[1][0]).group(1)
        assert Fraction(said) == Fraction(x), text


def test_examples_of_the_page(check):
    page = (ROOT / "docs" / "reference" / "certificates.md").read_text()
    examples = re.findall(r"```json\n(.*?)```", page, flags=re.S)
    answers = [check([json.dumps(json.loads(one))])[1][0] for one in examples]
    accepted = sum(a.startswith("accepted: ") for a in answers)
    unknown = [a for a in answers if a.startswith("not known to this checker: ")]
    print(f"\n{accepted} of {len(examples)} accepted; {unknown}")
    assert accepted >= 13
    assert accepted + len(unknown) == len(examples)


def test_a_map_held_by_boxes(check, tmp_path):
    """A ball on its way beside cells of an octree, which boxes stand for; a time in two parts. What is false is refused, by both."""
    beside = {"rule": "groups", "of": "obstacle", "runs": [[0, 1], [1, 1]], "proofs": [
        {"rule": "pieces", "times": [0, 1], "planes": [[n, 1, ["1/4"], [most]]]} for n, most in (([-1, 0, 0], 1), ([0, 0, 1], -1))]}
    later = json.loads(json.dumps(beside).replace("[0, 1], \"planes\"", "[1, 2], \"planes\""))
    good = {"format": "vericone-certificate", "version": 1, "claim": {
        "says": "apart", "by": "1/2", "from": 0, "to": 2, "pairs": [[0, 1]],
        "bodies": [{"kind": "ball", "center": [0, 0, 0], "radius": "1/4"},
                   {"kind": "octree", "low": [0, 0, 0], "cell": "1/2", "depth": 1, "tree": "+....#.+####...........#"}],
        "tracks": [{"times": [0, 2], "positions": [[[2, 1, 0], [2, 3, 0]]], "radius": "1/100"},
                   {"times": [0, 2], "positions": [[[0, 0, 0]]], "radius": 0}]},
        "proof": {"rule": "pairs", "pairs": {"0 1": {
            "rule": "cover", "of": "obstacle", "boxes": [[[0, 0, 0], [1, 1, "1/2"]], [[1, 0, 1], [2, 2, 2]]], "runs": [[0, 4], [1, 2]],
            "proof": {"rule": "times", "cuts": [1], "proofs": [beside, later]}}}}}
    cover, tree = ("proof", "pairs", "0 1"), ("claim", "bodies", 1, "tree")
    time_ = (*cover, "proof")
    bad = [changed(good, path, value) for path, value in (
        (("claim", "by"), 1), ((*cover, "runs"), [[0, 5], [1, 1]]), ((*cover, "runs"), [[0, 4]]), ((*cover, "runs"), [[0, 4], [1, 3]]),
        ((*cover, "boxes", 0, 1, 2), "499/1000"), ((*cover, "boxes", 1, 0, 2), "501/500"), ((*cover, "boxes", 0, 1, 0), 2),
        ((*cover, "boxes", 0, 0, 1), "1/1000"), ((*cover, "of"), "agent"), ((*time_, "cuts"), []), ((*time_, "cuts"), [0]), ((*time_, "cuts"), [2]),
        ((*time_, "cuts"), ["1/2"]), ((*time_, "proofs"), [beside, beside]), ((*time_, "proofs"), [later, beside]), ((*time_, "proofs"), [beside]),
        (tree, "+....#.+####...........#........"), (tree, "+....#.+####..........."), (tree, "........"), (tree, "+....#.+#+##...........#"),
        (tree, "#....#.+####...........#"), (tree, "+....#.+#.##...........#"), (("claim", "bodies", 1, "depth"), 0), (("claim", "bodies", 1, "cell"), 0),
        (("claim", "bodies", 1, "cell"), 1), (("claim", "bodies", 1, "low", 2), "1/1000"), (("claim", "tracks", 0, "radius"), 1))]
    lines = [json.dumps(one) for one in (good, *bad)]
    (tmp_path / "lines").write_text("\n".join(lines), encoding="utf-8")
    python = subprocess.run([sys.executable, ROOT / "checker" / "vericone_check.py", tmp_path / "lines"], capture_output=True, text=True, check=False)
    for said in (check(lines)[1], [line.split(": ", 2)[2] for line in python.stdout.splitlines()]):
        assert [one.startswith("accepted: ") for one in said] == [True] + [False] * len(bad), said


def test_what_readers_of_the_other_checker_tried(check):
    """The false certificates of tests/checker: none is accepted here either."""
    there = importlib.util.spec_from_file_location("false_certificates", ROOT / "tests" / "checker" / "false_certificates.py")
    false = importlib.util.module_from_spec(there)
    there.loader.exec_module(false)
    page = (ROOT / "docs" / "reference" / "certificates.md").read_text(encoding="utf-8")
    examples = [json.loads(block) for block in re.findall(r"```json\n(.*?)```", page, flags=re.S)]
    lines, tried = [], []
    for (rule, says, *which), path, value in false.FALSE:
        one = [x for x in examples if x["proof"]["rule"] == rule and says in (None, x["claim"]["says"])][which[0] if which else 0]
        bad = json.loads(json.dumps(one))
        place = bad
        for key in path[:-1]:
            place = place[key]
        if value is false.DROP:
            del place[path[-1]]
        elif path[-1] is None:
            place.append(value)
        else:
            place[path[-1]] = value
        lines.append(json.dumps(bad))
        tried.append((rule, says, path, value))
    answers = check(lines)[1]
    assert len(answers) == len(tried) > 400
    assert [bad for bad, said in zip(tried, answers) if said.startswith("accepted: ")] == []
    assert sum(said.startswith("refused") for said in answers) > 90


def test_noise_is_no_certificate(check):
    rng, maker = random.Random(10), make.Maker(10)
    lines = []
    for _ in range(2000):
        line = bytearray(json.dumps(maker.any()).encode())
        for _ in range(rng.randint(1, 5)):
            at = rng.randrange(len(line))
            what = rng.randrange(3)
            if what == 0:
                line[at] = rng.choice([c for c in range(256) if c != 10])
            elif what == 1:
                del line[at:at + rng.randint(1, 20)]
            else:
                line[at:at] = line[at:at + rng.randint(1, 20)]
        lines.append(bytes(line))
    _, answers = check(lines)
    assert len(answers) == len(lines)
    for line, answer in zip(lines, answers):
        try:
            true = truth.decide(line.decode())
        except UnicodeDecodeError:
            true = None
        assert answer.startswith("accepted: ") == (true is True), (line, answer[:200])
