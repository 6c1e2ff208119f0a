# SPDX-License-Identifier: BSD-3-Clause
"""`vericone query`: cases in, answers out."""
import json
import math
import os
import random
import re
import signal
import subprocess
import tempfile
import threading
import unittest

from command import VERICONE, ball, engagement, query, run


class Query(unittest.TestCase):
    def test_spheres_in_closed_form(self):
        # Radii 1 and 2, centres 5 apart along x; a line at distance 3 grazes: direction (4, 3, 0) / 5.
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        result, answers = query(
            engagement(a, b, [1, 0, 0], id="head-on"), engagement(a, b, [4, 3, 0], id="graze"),
            engagement(a, b, [4, math.nextafter(3, 4), 0], id="just out"),
            engagement(a, b, [4, math.nextafter(3, 2), 0], id="just in"),
            engagement(a, b, [-1, 0, 0], id="behind"), engagement(a, b, [0, 0, 0], id="rest"),
            engagement(a, b, [0, 2, 0], id="across"),
            engagement(a, ball([3, 0, 0], 2), [1, 0, 0], id="touching"),
            engagement(a, ball([2, 0, 0], 2), [1, 0, 0], id="overlapping"))
        self.assertEqual(result.returncode, 0, result.stderr)
        by_id = {x["id"]: x for x in answers}
        self.assertEqual([x["verdict"] for x in answers],
                         ["in", "on", "out", "in", "out", "out", "out", "touching", "overlapping"])
        self.assertAlmostEqual(by_id["head-on"]["clearance"], -3, 12)
        self.assertAlmostEqual(by_id["head-on"]["time_to_contact"], 2, 12)
        self.assertEqual(by_id["graze"]["clearance"], 0)
        self.assertAlmostEqual(by_id["graze"]["time_to_contact"], 4 / 5, 12)
        self.assertGreater(by_id["just out"]["clearance"], 0)
        self.assertLess(by_id["just in"]["clearance"], 0)
        self.assertAlmostEqual(by_id["behind"]["clearance"], 2, 12)  # moving apart: the distance now
        self.assertIsNone(by_id["behind"]["time_to_contact"])
        self.assertAlmostEqual(by_id["across"]["clearance"], 2, 12)
        self.assertEqual(by_id["touching"]["time_to_contact"], 0)
        self.assertEqual(list(answers[0]), ["id", "verdict", "clearance", "nearest_time", "time_to_contact"])

    def test_rung_says_what_decided(self):
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        far = ball([3e7, 1e7, 2e7], 2)
        cases = [engagement(a, b, [1, 0, 0], id="plain"), engagement(a, b, [4, 3, 0], id="graze"),
                 engagement(a, far, [3, 1, 2.00000001], id="distant"),
                 engagement(a, ball([3, 0, 0], 2), [1, 0, 0], id="touching"),
                 engagement(a, ball([2, 0, 0], 2), [1, 0, 0], id="overlapping")]
        text = "".join(json.dumps(c) + "\n" for c in cases)
        answers = [json.loads(line) for line in run("query", "--rung", "-", input=text).stdout.splitlines()]
        self.assertEqual([x["rung"] for x in answers], ["triage", "exact", "triage", "exact", "triage"])
        plain = [json.loads(line) for line in run("query", "-", input=text).stdout.splitlines()]
        for with_rung, without in zip(answers, plain):
            self.assertEqual({k: v for k, v in with_rung.items() if k != "rung"}, without)

    def test_bounded_errors(self):
        # Balls of radii 1 and 2, 20 m apart, aimed 6 m aside: the gap is 3 m, less what errors take.
        a, b = ball([0, 0, 0], 1), ball([20, 6, 0], 2)
        case = engagement(a, b, [10, 0, 0])
        verdict = lambda **errors: query({**case, **errors})[1][0]
        self.assertNotIn("robust", verdict())
        for kind, size in (("ball", lambda x: x), ("semi_axes", lambda x: [x, x, x]), ("box", lambda x: [0, x, 0])):
            out = verdict(position_error={kind: size(2.99)})
            self.assertEqual(out["robust"], "out")
            self.assertGreater(out["witness"]["normal"][1], 0.9)
        answer = verdict(position_error={"ball": 3.01})
        self.assertEqual(answer["robust"], "depends")
        collides, passes = answer["witness"]["collides"], answer["witness"]["passes"]
        self.assertEqual(passes, {"position": [0, 0, 0], "velocity": [0, 0, 0]})
        self.assertLessEqual(math.hypot(*collides["position"]), 3.01)
        moved = ball([20 + collides["position"][0], 6 + collides["position"][1], collides["position"][2]], 2)
        self.assertEqual(query(engagement(a, moved, [10, 0, 0]))[1][0]["verdict"], "in")
        # 3 m aside in about 2 s; and not before.
        self.assertEqual(verdict(velocity_error={"ball": 2})["robust"], "depends")
        self.assertEqual(verdict(velocity_error={"ball": 2}, horizon=1)["robust"], "out")
        self.assertEqual(verdict(position_error={"box": [0, 0, 0]}, horizon=1)["robust"], "out")
        # The verdict itself: 17 m to go at 10 m/s; a window after they have passed.
        hit = engagement(a, ball([20, 0, 0], 2), [10, 0, 0])
        for horizon, word in ((1.5, "out"), (1.6999, "out"), (1.7001, "in"), ([2.2, 9], "in"), ([2.3001, 9], "out")):
            self.assertEqual(query({**hit, "horizon": horizon})[1][0]["verdict"], word, horizon)
        self.assertEqual(query({**engagement(ball([0, 0, 0], 1), ball([5, 0, 0], 1), [1, 0, 0]), "horizon": 3})[1][0]["verdict"], "on")
        for bad in (0, -1, [2, 1], [-1, 2], "soon"):
            refused = query({**case, "horizon": bad})
            self.assertEqual(refused[0].returncode, 2)
            self.assertIn("horizon", refused[1][0]["error"])
        head_on = engagement(a, ball([20, 0, 0], 2), [10, 0, 0])
        answer = query({**head_on, "position_error": {"ball": 1}, "velocity_error": {"ball": 0.5}})[1][0]
        self.assertEqual((answer["robust"], answer["witness"]), ("in", None))
        box = {"points": [[x, y, z] for x in (-2, 2) for y in (-2, 2) for z in (-2, 2)], "center": [20, 0, 0]}
        answer = query({**engagement(a, box, [10, 0, 0]), "position_error": {"ball": 1}, "velocity_error": {"ball": 0.5}})[1][0]
        self.assertEqual((answer["robust"], answer["witness"]), ("in", None))
        # A graze, exactly: nothing is off, and the plane along the motion touches.
        graze = {**engagement(a, ball([20, 3, 0], 2), [10, 0, 0]), "horizon": 9, "position_error": {"box": [0, 0, 0]}}
        self.assertEqual((query(graze)[1][0]["verdict"], query(graze)[1][0]["robust"]), ("on", "in"))

    def test_when_they_are_nearest(self):
        # Two ships in the plane; of discs far apart the time is that of their centres to the size of both.
        a = {"center": [0, 0], "semi_axes": [70, 11]}
        b = {"center": [5200, 900], "semi_axes": [120, 17], "rotation": 3.0}
        apart = engagement(a, b, [7, 0], [-5.5, -0.25])
        box = {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "center": [10, 5, 0]}
        _, answers = query(apart, engagement(ball([0, 0, 0], 1), ball([10, 5, 0], 2), [2, 0, 0]),
                           engagement(ball([0, 0, 0], 1), box, [2, 0, 0]),
                           engagement(ball([0, 0, 0], 1), ball([10, 5, 0], 2), [-2, 0, 0]),
                           engagement(ball([0, 0, 0], 1), ball([10, 0, 0], 2), [2, 0, 0]))
        c, w = (5200, 900), (12.5, 0.25)
        self.assertEqual(answers[0]["verdict"], "out")
        self.assertAlmostEqual(answers[0]["nearest_time"], (c[0] * w[0] + c[1] * w[1]) / (w[0] ** 2 + w[1] ** 2),
                               delta=190 / math.hypot(*w))
        self.assertAlmostEqual(answers[1]["nearest_time"], 5, 9)
        # Beside the edge from (10, 5, 0) to (11, 5, 0): as near anywhere along it.
        self.assertAlmostEqual(answers[2]["clearance"], 4, 9)
        self.assertTrue(5 - 1e-9 <= answers[2]["nearest_time"] <= 5.5 + 1e-9)
        self.assertEqual(answers[3]["nearest_time"], 0)
        self.assertEqual((answers[4]["verdict"], answers[4]["nearest_time"]), ("in", None))

    def test_places_are_not_rounded(self):
        # The agent's corner passes 2e-16 beside one of the obstacle's; 8 + 3 is exact, and 8 - 1.0000000000000002 not.
        corner = {"points": [[0, -1.0000000000000002, -3]]}
        corners = [[0, 3, 2], [-3, 2, 0], [1, 0, -1], [3, 2, 2]]
        placed = {"points": corners, "center": [8, 8, 8]}
        moved = {"points": [[x + 8 for x in p] for p in corners]}
        v, still = [8, 12, 13], [0, 0, 0]
        _, answers = query(engagement(corner, placed, v), engagement(placed, corner, still, v),
                           engagement(corner, moved, v))
        self.assertEqual([x["verdict"] for x in answers], ["out"] * 3)

    def test_velocities_are_subtracted_without_rounding(self):
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        tiny = 2.0 ** -60  # 3 + tiny rounds to 3
        _, answers = query(engagement(a, b, [4, 3, 0]), engagement(a, b, [4, 3, 0], [0, -tiny, 0]),
                           engagement(a, b, [4, 3, 0], [0, tiny, 0]))
        self.assertEqual([x["verdict"] for x in answers], ["on", "out", "in"])

    def test_numbers_at_the_ends_of_the_doubles(self):
        a, b = ball([0, 0, 0], 1), ball([5, 0, 0], 2)
        disc = {"center": [5, 0, 0], "semi_axes": [1e20, 1e-3, 1]}
        result, answers = query(
            engagement(a, ball([1e200, 0, 0], 2), [4, 1, 0]), engagement(a, b, [1e200, 0, 0]),
            engagement(a, b, [5e-324, 0, 0]), engagement(a, disc, [4, 3, 0]),
            engagement(a, b, [1.7e308, 0, 0], [-1.7e308, 0, 0]))
        self.assertEqual(result.returncode, 0, result.stdout)
        far, fast, slow, thin, faster = answers
        self.assertAlmostEqual(far["clearance"] / 1e200, 1 / math.sqrt(17), 12)
        self.assertAlmostEqual(fast["time_to_contact"] * 1e200, 2, 12)
        self.assertEqual((slow["verdict"], slow["time_to_contact"]), ("in", None))
        self.assertEqual(thin["verdict"], "overlapping")
        self.assertIn(thin["clearance"], (None, -2))
        self.assertEqual(faster["verdict"], "in")
        self.assertAlmostEqual(faster["clearance"], -3, 12)
        self.assertAlmostEqual(faster["time_to_contact"] * 1.7e308, 1, 12)

    def test_shape_and_axes_agree(self):
        q = [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]
        body = {"center": [9, 1, 0], "semi_axes": [1, 2, 3], "rotation": q}
        same = {"center": [9, 1, 0], "shape": [[4, 0, 0], [0, 1, 0], [0, 0, 9]]}
        _, answers = query(engagement(ball([0, 0, 0], 1), body, [1, 0.2, 0.1]),
                           engagement(ball([0, 0, 0], 1), same, [1, 0.2, 0.1]))
        self.assertEqual(answers[0]["verdict"], answers[1]["verdict"])
        self.assertAlmostEqual(answers[0]["clearance"], answers[1]["clearance"], 12)
        self.assertAlmostEqual(answers[0]["time_to_contact"], answers[1]["time_to_contact"], 12)

    def test_bad_lines_do_not_stop_the_run(self):
        good = json.dumps(engagement(ball([0, 0, 0], 1), ball([5, 0, 0], 2), [1, 0, 0]))
        result = run("query", "-", input=good + "\nnonsense\n\n" + good + "\n")
        answers = [json.loads(line) for line in result.stdout.splitlines()]
        self.assertEqual(result.returncode, 2)
        self.assertEqual([("error" in x) for x in answers], [False, True, False])

    def lines(self, count):
        """Good lines, bad ones and blank ones, each with its own id."""
        rng = random.Random(1)
        for i in range(count):
            b = ball([5 + 9 * rng.random(), 4 * rng.random(), rng.gauss(0, 1)], 1 + rng.random())
            case = engagement(ball([0, 0, 0], 1), b, [1, rng.gauss(0, 0.3), rng.gauss(0, 0.3)], id=i)
            kind = rng.randrange(20)
            if kind == 0:
                case["agent"]["semi_axes"][rng.randrange(3)] = 0
            elif kind == 1:
                case["id"] = "%d \u00e9" % i
            elif kind == 2:
                case["obstacle"] = {"points": [[5 + x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]}
            yield {3: "nonsense", 4: "  "}.get(kind) or json.dumps(case)

    def test_threads_change_nothing(self):
        text = "\n".join(self.lines(4000))  # the last line has no end
        one, four = (run("query", "-", "--threads", threads, input=text) for threads in ("1", "4"))
        self.assertEqual((one.returncode, one.stderr), (2, ""))
        self.assertEqual(four.stdout, one.stdout)
        self.assertEqual(len(one.stdout.splitlines()), sum(line.strip() != "" for line in text.split("\n")))
        # Each is what the line alone gets, but for the number of the line.
        rng = random.Random(2)
        lines = [line for line in text.split("\n") if line.strip()]
        for i in rng.sample(range(len(lines)), 30):
            alone = run("query", "-", input=lines[i]).stdout
            self.assertEqual(alone.replace("line 1:", ""), re.sub(r"line \d+:", "", one.stdout.splitlines(True)[i]))

    def test_memory_does_not_grow(self):
        def most(count):
            text = ("\n".join(self.lines(500)) + "\n").encode() * (count // 500)
            with tempfile.TemporaryFile() as given:
                given.write(text)
                given.seek(0)
                process = subprocess.Popen([VERICONE, "query", "-", "--threads", "2"], stdin=given, stdout=subprocess.DEVNULL)
                _, status, used = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                self.assertEqual(process.returncode, 2)
                return used.ru_maxrss  # KiB
        self.assertLess(most(60_000) - most(6_000), 12_000)  # the lines alone have 10 MB, their answers 5

    def test_a_consumer_that_leaves(self):
        text = ("\n".join(self.lines(500)) + "\n") * 40
        with subprocess.Popen([VERICONE, "query", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True) as p:
            feeder = threading.Thread(target=self.feed, args=(p.stdin, text))
            feeder.start()
            self.assertEqual(json.loads(p.stdout.readline())["id"], 0)
            p.stdout.close()
            feeder.join()
            self.assertEqual((p.wait(), p.stderr.read()), (-signal.SIGPIPE, ""))

    @staticmethod
    def feed(stream, text):
        try:
            stream.write(text)
            stream.close()
        except BrokenPipeError:
            pass

    def test_each_answer_comes_at_once(self):
        with subprocess.Popen([VERICONE, "query", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as p:
            for i in range(3):
                p.stdin.write(json.dumps(engagement(ball([0, 0, 0], 1), ball([5, 0, 0], 2), [1, 0, 0], id=i)) + "\n")
                p.stdin.flush()
                self.assertEqual(json.loads(p.stdout.readline())["id"], i)
            p.stdin.close()


if __name__ == "__main__":
    unittest.main()
