# SPDX-License-Identifier: BSD-3-Clause
"""The source's Fig 6.7 for a scanned object, from section.json: one plane through the line of sight with the agent's
section, the points that its LiDARs return, what they do not see, and the common tangents."""
import numpy as np

from vericone_figures.style import AGENT, EXACT, GREY, OBSTACLE, SLICE, TWO_COLUMNS, plt, read, save

data = read("section.json")
agent, returns = np.array(data["agent"]), np.array(data["returns"]).reshape(-1, 2)
everything = np.vstack([agent, returns, data["sensors"]] + [np.array(line) for line in data["obstacle"]])
reach = 1.12 * np.linalg.norm(everything, axis=1).max()
width, height = np.ptp(everything, axis=0)
figure, axes = plt.subplots(figsize=(TWO_COLUMNS, np.clip(1.6 + 1.15 * TWO_COLUMNS * height / width, 2.8, 7)))
axes.fill(*agent.T, color=AGENT, alpha=0.2, linewidth=0)
axes.plot(*np.vstack([agent, agent[:1]]).T, color=AGENT)
axes.annotate("A", agent[np.argmin(agent[:, 1])], xytext=(0, 4), textcoords="offset points", ha="center")
for n, line in enumerate(data["obstacle"]):
    axes.plot(*np.array(line).T, ":", color=OBSTACLE, linewidth=1, label=None if n else "section of the obstacle, not known to A")
axes.plot(*returns.T, ".", color=SLICE, markersize=2.5,
          label="%d returns within %.1f mm of the plane" % (len(returns), 1e3 * data["half_thickness"]))
axes.plot(*np.array(data["sensors"]).T, "x", color="k", markersize=4, label="LiDAR")
for n, tangent in enumerate(data["tangents"]):
    a, b = np.array(tangent["on_agent"]), np.array(tangent["on_obstacle"])
    d = (b - a) / np.linalg.norm(b - a)
    line = np.array([a - 0.12 * reach * d, a + d * (reach - a @ d)])
    axes.plot(*line.T, color=EXACT, linewidth=1, label=None if n else "common tangents of A and the points")
    axes.plot(*np.array([a, b]).T, "o", color=EXACT, markersize=3, zorder=5)
for n, (angle, side) in enumerate(((data["whole_left"], 1), (data["whole_right"], -1))):
    if angle is None:
        continue
    # Parallel to the true cone's edge, where it touches A's section.
    d = np.array([np.cos(angle), side * np.sin(angle)])
    normal = np.array([d[1], -d[0]]) * side
    a = agent[np.argmax(agent @ normal)]
    line = np.array([a - 0.12 * reach * d, a + d * (reach - a @ d)])
    axes.plot(*line.T, "--", color=GREY, linewidth=1, label=None if n else "edges of the true cone of the whole obstacle")
axes.set_aspect("equal")
axes.set_xlabel("along the line of sight (m)")
axes.set_ylabel("across, in the plane (m)")
if data["tangents"]:
    axes.set_title("$\\psi$ = %.2f° from %d points tried; the true cone on this plane: %s" % (
        np.degrees(data["psi"]), data["tried"],
        "none" if data["whole_left"] is None or data["whole_right"] is None
        else "%.2f°" % np.degrees(data["whole_left"] + data["whole_right"])))
else:
    axes.set_title("no answer: " + (data["reason"] or "no common tangents"))
figure.legend(loc="lower center", ncol=3, frameon=False, columnspacing=1.2)
figure.tight_layout(pad=0.4, rect=(0, 0.4 / figure.get_figheight(), 1, 0.99))
save(figure, "visible_section")
