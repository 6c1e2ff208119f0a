# SPDX-License-Identifier: BSD-3-Clause
"""The source's law on slices beside the same law on the true cone and the clearance law, on the same engagement."""
from vericone_figures.runs import Sheet, figure
from vericone_figures.style import EXACT, GREY, SLICE, TWO_COLUMNS, plt, save

LAWS = {"source": ("source's law", SLICE, "-"), "exact": ("source's law, true cone", EXACT, (0, (4, 1.2))),
        "clearance": ("clearance law", "#3a8f4d", "-")}
data = figure()
sheet = Sheet()
panels = plt.figure(figsize=(TWO_COLUMNS, 4.6), constrained_layout=True).subplots(2, 2)
bars = []
for n, (key, run) in enumerate(data["runs"].items()):
    label, color, dash = LAWS[key]
    agent = run.agents()[0]
    for i, obstacle in enumerate(o for a, o in run.encounters if a == agent):
        e = run.engaged(agent, obstacle, after=0)
        name = label if i == 0 else None
        if key != "clearance":
            sheet.line(panels[0, 0], "y", "%s, %s" % (label, obstacle), e["t"], e["y"], color=color, linestyle=dash,
                       label=name)
        sheet.line(panels[0, 1], "m [m]", "%s, %s" % (label, obstacle), e["t"], e["m"], color=color, linestyle=dash,
                   label=name)
    b = run.bodies[agent]
    sheet.line(panels[1, 0], "|a| [m/s^2]", label, b["t"], b["a"], color=color, linestyle=dash, label=label)
    pairs = {}
    for p in run.proof()["pairs"]:
        if agent in (p["a"], p["b"]):
            pairs[p["b"] if p["a"] == agent else p["a"]] = p
    for i, (obstacle, p) in enumerate(pairs.items()):
        proved = p["verdict"] == "avoided"
        pale = obstacle in run.idle(agent)  # what it does there says nothing about its law
        x = i + 0.26 * (n - 0.5 * (len(data["runs"]) - 1))
        panels[1, 1].bar(x, p["least_distance"] if proved else 0, 0.24, color=color,
                           alpha=0.3 if pale else 1)
        panels[1, 1].annotate("%.2g" % p["least_distance"] if proved else p["verdict"],
                              (x, p["least_distance"] if proved else 0), xytext=(0, 2), textcoords="offset points",
                              fontsize=6, ha="center", va="bottom", rotation=0 if proved else 90)
        if proved:
            sheet.add("least distance proved [m]", "%s, %s" % (label, obstacle), [p["least_time"]], [p["least_distance"]])
        bars.append((i, obstacle))
panels[0, 0].axhline(0, color="k", linewidth=0.6)
panels[0, 1].axhline(0, color="k", linewidth=0.6)
if data.get("required"):
    panels[0, 1].axhline(data["required"], color=GREY, linewidth=0.8, linestyle=":")
    panels[0, 1].annotate("required", (1, data["required"]), xycoords=("axes fraction", "data"), xytext=(-2, 2),
                          textcoords="offset points", fontsize=6.5, ha="right", color=GREY)
panels[0, 0].set_ylabel("y on the plane chosen [1]")
panels[0, 1].set_ylabel("miss distance m [m]")
panels[1, 0].set_ylabel("acceleration |a| [m/s²]")
panels[1, 1].set_ylabel("least distance, proved [m]")
for axes in (panels[0, 0], panels[0, 1], panels[1, 0]):
    axes.set_xlabel("t [s]")
low, high = panels[0, 1].get_ylim()
panels[0, 1].set_ylim(low, min(high, 8) + 0.8)  # far obstacles are of no interest
largest = max(bar.get_height() for bar in panels[1, 1].patches)
if largest > 5:
    panels[1, 1].set_yscale("symlog", linthresh=1)
    panels[1, 1].yaxis.set_major_formatter("{x:g}")
panels[1, 1].set_ylim(0, (2 if largest > 5 else 1.12) * largest)
panels[1, 1].set_xticks([i for i, _ in sorted(set(bars))])
panels[1, 1].set_xticklabels([o for _, o in sorted(set(bars))])
panels[1, 1].set_xlabel("obstacle (pale: never steered against)" if any(r.idle(r.agents()[0]) for r in
                        data["runs"].values()) else "obstacle")
panels[1, 1].grid(False, axis="x")
figure_legend = panels[1, 0].get_legend_handles_labels()
panels[0, 0].legend(*figure_legend, loc="best")
sheet.write(data["name"])
save(panels[0, 0].figure, data["name"])
