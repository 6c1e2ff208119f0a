# SPDX-License-Identifier: BSD-3-Clause
"""How large pages are, and how fast: times.py, with the environment of the tests. In processor time of the page's thread,
which other work on the machine slows little; of many repetitions the least and the median. Prints the table of
docs/measured/pages.md."""
import os
import statistics
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(os.path.dirname(HERE), "cli")]
import kinds  # noqa: E402
import runs  # noqa: E402
from browser import Browser  # noqa: E402
from command import run  # noqa: E402

# A step, and the picture after it.
STEP = """(async i => {
  const page = vericone.page;
  %s;
  await new Promise(done => requestAnimationFrame(() => setTimeout(done)));
})(%d)"""
DRAG = "page.choose([1, 0.001 * i, 0], false)"
PLAY = "page.go(page.data.end * i / 60)"


def line(what, numbers, unit):
    print("| %s | %.3g | %.3g | %s |" % (what, min(numbers), statistics.median(numbers), unit), flush=True)


def work(browser):
    """Seconds of processor time of the page's thread until now."""
    return {m["name"]: m["value"] for m in browser.send("Performance.getMetrics")["metrics"]}["ThreadTime"]


def spent(browser, do):
    before = work(browser)
    do()
    after = work(browser)
    return after - before if after >= before else after  # a page may begin a process of its own


def main():
    with tempfile.TemporaryDirectory() as folder:
        pages = {"two ellipsoids": (os.path.join(folder, "scene.html"), kinds.write("ellipsoids", folder), "a velocity dragged: answer and pictures", DRAG),
                 "16 s, five agents": (os.path.join(folder, "run.html"), runs.simulate(runs.agents(5, 3, 16, 0.02), folder), "a picture of the run", PLAY)}
        browser = Browser()
        browser.send("Performance.enable")
        print("| page | least | median | |\n|---|---|---|---|")
        try:
            for name, (page, what, words, step) in pages.items():
                assert run("view", what, "--out", page).returncode == 0
                print("| %s: size | %d | | kB |" % (name, os.path.getsize(page) / 1000))
                line("%s: first picture" % name, [spent(browser, lambda: browser.open(page)) for _ in range(5)], "s")
                browser.run("new Promise(done => setTimeout(done, 5000))")  # until all squares are there
                line("%s: %s" % (name, words),
                     [1000 * spent(browser, lambda: browser.run(STEP % (step, i))) for i in range(30)], "ms")
        finally:
            browser.close()


if __name__ == "__main__":
    main()
