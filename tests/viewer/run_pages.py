# SPDX-License-Identifier: BSD-3-Clause
"""Pages of runs in the browser that browser_test.py has started."""
import os

import runs
from command import run


class RunsInBrowser:
    def run_page(self, scenario):
        folder = runs.simulate(scenario, self.folder)
        out = os.path.join(self.folder, "run.html")
        result = run("view", folder, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        return folder, out

    def test_a_run_is_shown_at_any_time_and_asks_for_nothing(self):
        folder, path = self.run_page(runs.agents(3, 3))
        self.open(path)
        self.assertEqual(self.browser.text("verdict-word"), "avoided")
        self.assertEqual(self.browser.run("document.images.length"), 0)
        self.assertIn(runs.HOSTILE, self.browser.text("proofs"))
        self.browser.run("vericone.page.go(2)")
        self.browser.settle()
        self.assertEqual(self.browser.text("time-says"), "2.00 of 4.00 s")
        for canvas in ("solid", "chart"):
            shares = self.browser.run("%s('%s')" % (self.COLOURS, canvas))
            self.assertGreater(len(shares), 4, canvas)
            self.assertGreater(sum(shares[1:]), 0.01, canvas)
        self.shot("run")
        # What is said of the distance at a command lies about what the proof says of all of them.
        least = self.browser.run("Math.min(...[...vericone.page.kept.values()][0].least)")
        proved = self.browser.run("vericone.page.pair.least_distance")
        self.assertGreaterEqual(least, proved)
        self.assertLess(least, proved + 0.3)
        # Each answer is that of bodies.csv at that command, asked of the library again.
        at = {r["body"]: r for r in runs.table(folder, "bodies.csv") if r["t [s]"] == "2"}
        self.assertEqual(len(at), 3)
        row = self.browser.run("[...document.querySelectorAll('#now tbody tr')].map(r => [...r.children].map(c => c.textContent))")
        self.assertEqual([r[0] for r in row], [name for name in at if name != self.browser.run("vericone.page.agent.name")])
        self.quiet(path)

    def test_a_run_by_keyboard(self):
        _, path = self.run_page(runs.agents(3, 2))
        self.open(path)
        self.browser.run("document.getElementById('time').focus()")
        for _ in range(3):
            self.browser.key("ArrowRight")
        self.browser.settle()
        self.assertEqual(self.browser.text("time-says"), "0.15 of 4.00 s")
        self.browser.run("document.getElementById('chart').focus()")
        self.browser.key("ArrowRight", shift=True)
        self.browser.settle()
        self.assertEqual(self.browser.text("time-says"), "0.35 of 4.00 s")
        self.browser.run("[...document.querySelectorAll('button')].find(b => b.textContent === 'event \u2192').focus()")
        self.browser.key("Enter")
        self.browser.settle()
        first = self.browser.run("vericone.data.events.find(e => e.t > 0.35).t")
        self.assertAlmostEqual(self.browser.run("vericone.page.time"), first)
        self.browser.run("document.querySelector('#proofs button').focus()")
        self.browser.key("Enter")
        self.browser.settle()
        self.assertAlmostEqual(self.browser.run("vericone.page.time"), self.browser.run("vericone.page.pair.least_time"))
        self.assertIn("never nearer than", self.browser.text("announce"))
        self.browser.run("vericone.page.go(1), document.getElementById('play').focus()")
        before = self.browser.run("vericone.page.time")
        self.browser.key("Enter")
        self.browser.run("new Promise(done => setTimeout(done, 300))")
        self.browser.key("Enter")
        self.assertGreater(self.browser.run("vericone.page.time"), before)
        self.quiet(path)

    def test_bodies_of_every_kind_in_a_run(self):
        _, path = self.run_page(runs.kinds())
        self.open(path)
        self.browser.run("vericone.page.go(1.5)")
        self.browser.settle()
        self.assertIn("overlap", self.browser.text("now"))
        self.quiet(path)
        self.shot("run-kinds")
