# SPDX-License-Identifier: BSD-3-Clause
"""Ways of a UAS and the vehicles that it follows, in space."""
from matplotlib.ticker import MaxNLocator

from vericone_figures.runs import COLORS, Sheet, figure
from vericone_figures.style import AGENT, TWO_COLUMNS, plt, save
from plot.tables import groups, rows

data = figure()
folder = data["data"]["run"]
uas = groups(rows(folder, "uas.csv"))[()]
cars = groups(rows(folder, "cars.csv"), "body")
sheet = Sheet()
axes = plt.figure(figsize=(TWO_COLUMNS * 0.75, 3.6)).add_subplot(projection="3d")
axes.plot(uas["x"], uas["y"], uas["z"], color=AGENT, label="UAS")
sheet.add("way", "UAS", uas["x"], uas["y"])
for color, ((name,), car) in zip(COLORS, cars.items()):
    axes.plot(car["x"], car["y"], 0 * car["x"], color=color, label=name, linewidth=1)
    sheet.add("way", name, car["x"], car["y"])
axes.set_xlabel("x, east [m]")
axes.set_ylabel("y, north [m]")
axes.set_zlabel("z, up [m]")
for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
    axis.set_major_locator(MaxNLocator(4))
axes.set_box_aspect((2, 2, 1), zoom=1.1)
axes.legend(loc="upper left", bbox_to_anchor=(-0.05, 0.95))
sheet.write(data["name"])
save(axes.figure, data["name"])
