// SPDX-License-Identifier: BSD-3-Clause
#include "figure.h"

#include <vericone/geometry/error.h>
#include <algorithm>

#include "json/json_value.h"

namespace vericone::dhal2022 {
namespace {

const std::vector<std::pair<std::string, std::string>> kRun1{{"source", "5.4.1"}}, kRun2{{"source", "5.4.2"}},
    kAlone{{"source", "6.5-noncooperative"}}, kTogether{{"source", "6.5-cooperative"}};

Json panels(std::initializer_list<const char*> names) { return {{"panels", Json(names)}}; }

Json with_partners(Json parameters) {
  parameters["partners"] = {"B1", "B2"};
  return parameters;
}

std::vector<Figure> make() {
  return {
      {"5.6",
       "Simulation 1 of 5.4: ways of the agent F1, the ellipse F2 and the dented conic F3, with their "
       "outlines at the times given beside each. F3 appears at 2.13 s; the star is the goal; a red cross, if "
       "any, is a contact that is proved.",
       "plane_trajectory.py",
       kRun1,
       {{"times", {0, 0.8, 1.6, 2.13, 2.7, 3.74, 4.88}}, {"goal", {80, 100}}}},
      {"5.7",
       "Simulation 1 of 5.4: lateral acceleration commanded, positive to the left, and heading of F1. The "
       "dotted line "
       "is where F3 appears.",
       "histories.py", kRun1, panels({"lateral", "heading"})},
      {"5.8",
       "Simulation 1 of 5.4: opening of the cone of each obstacle until it has been passed, V_r_hat >= 0 "
       "along the bisector.",
       "histories.py", kRun1, panels({"psi"})},
      {"5.9",
       "Simulation 1 of 5.4: cone function and relative velocity along and across the line of sight. F1 "
       "collides with "
       "constant velocities where y < 0 and it closes in.",
       "histories.py", kRun1, panels({"y", "V_r", "V_theta"})},
      {"5.10",
       "Simulation 2 of 5.4: F2 changes its shape. Arrows on the bodies: velocities over half a second; "
       "black: the "
       "velocity of F1 relative to F2; dashed: the edges of its collision sector.",
       "plane_snapshots.py",
       kRun2,
       {{"times", {0, 0.2, 0.4, 0.6, 0.84, 1.1, 1.4, 1.8}}}},
      {"5.11",
       "Simulation 2 of 5.4: ways of F1 and of the shape-changing F2, with their outlines.",
       "plane_trajectory.py",
       kRun2,
       {{"times", {0, 0.4, 0.84, 1.2, 1.6, 2.2, 2.8}}}},
      {"5.12",
       "Simulation 2 of 5.4: lateral acceleration and heading of F1, and the opening of the cone of F2, "
       "whose shape changes. The comb after 0.84 s is the law's chatter about y = 0: F1 is brought out of "
       "the cone, commands nothing, is in it again as F2 changes, and so on.",
       "histories.py", kRun2, panels({"lateral", "heading", "psi"})},
      {"6.5",
       "Accuracy of cones in space on random pairs of ellipsoids. (a) slice cones against that with 360 "
       "planes, as the "
       "source measures, and its 2/n; (b) slice cones against the true cone; (c) the true cone's own error "
       "and certified bound. 1000 pairs here; of 10,000 one is above 2/n (docs/errata.md, 3.6).",
       "",
       {},
       {}},
      {"6.8",
       "Non-cooperative case of 6.5: ways of the agent A and of the ellipsoid B, the biconcave C, the "
       "shape-changing D "
       "and the polyhedron E, with the bodies at the times given in their colours; bodies of different times "
       "do not meet where they overlap. An obstacle that nothing is commanded against is named in the "
       "picture.",
       "space_trajectory.py",
       kAlone,
       {{"times",
         {{"A", {0, 2.5, 4.7, 8, 10.5, 14}},
          {"B", {0, 2.5}},
          {"C", {4.7, 8}},
          {"D", {8, 10.5}},
          {"E", {10.5, 14}}}}}},
      {"6.9",
       "Non-cooperative case of 6.5: y and psi on twelve planes through the line of sight; dashed: on the "
       "plane chosen, "
       "where psi is largest.",
       "planes.py",
       kAlone,
       {}},
      {"6.10",
       "Non-cooperative case of 6.5: components of the relative velocity, until each obstacle has been "
       "passed.",
       "histories.py", kAlone, panels({"V_r", "V_theta", "V_phi"})},
      {"6.11",
       "Non-cooperative case of 6.5: magnitude, azimuth and elevation of the acceleration of A. Combs are "
       "the chatter of the law about the y at which it ceases; where the acceleration changes its sign its "
       "azimuth jumps by 180 deg.",
       "histories.py", kAlone, panels({"acceleration", "delta", "gamma"})},
      {"6.12", "Non-cooperative case of 6.5: azimuth and elevation of the heading of A.", "histories.py",
       kAlone, panels({"azimuth", "elevation"})},
      {"6.13",
       "Non-cooperative case of 6.5: y and psi on the plane chosen, where psi is largest, "
       "until each obstacle recedes. An obstacle never steered against is named above.",
       "histories.py", kAlone, panels({"y", "psi"})},
      {"6.14",
       "Cooperative case of 6.5: ways of the agent A, the ellipsoid B1 and the biconcave B2, with the bodies "
       "at the times given in their colours. Where nothing is commanded against B2, as the picture then "
       "says, the second engagement of the source does not take place.",
       "space_trajectory.py",
       kTogether,
       {{"times", {{"A", {0, 3, 5.5, 8.5, 12}}, {"B1", {0, 3, 5.5}}, {"B2", {5.5, 8.5, 12}}}}}},
      {"6.15",
       "Cooperative case of 6.5: y and psi on twelve planes through the line of sight; dashed: on the plane "
       "chosen.",
       "planes.py",
       kTogether,
       {}},
      {"6.16",
       "Cooperative case of 6.5: components of the relative velocity, until each obstacle has been passed.",
       "histories.py", kTogether, panels({"V_r", "V_theta", "V_phi"})},
      {"6.17",
       "Cooperative case of 6.5: magnitude, azimuth and elevation of all accelerations; mu = -0.5. No "
       "acceleration of A and B2 after 5.5 s means that their engagement does not take place.",
       "histories.py", kTogether, with_partners(panels({"acceleration", "delta", "gamma"}))},
      {"6.18",
       "Cooperative case of 6.5: azimuth and elevation of the headings of all. They stay where nothing is "
       "commanded.",
       "histories.py", kTogether, with_partners(panels({"azimuth", "elevation"}))},
      {"6.19",
       "Cooperative case of 6.5: y and psi on the plane chosen, where psi is largest, "
       "until each obstacle recedes. An obstacle never steered against is named above.",
       "histories.py", kTogether, panels({"y", "psi"})},
      {"laws-5.4.1",
       "Ours: simulation 1 of 5.4 with the source's law and with the clearance law, which passes at a "
       "distance in "
       "metres. m is the distance at which the bodies, an ellipse around the dented one, would pass with "
       "constant velocities. The bars are proved over the whole run, the turn to the goal included, which is "
       "no part of either law.",
       "comparison.py",
       {{"source", "5.4.1"}, {"clearance", "5.4.1-clearance"}},
       {{"required", 1}}},
      {"laws-6.5",
       "Ours: the non-cooperative case of 6.5 with the source's law on slices, the same law on the true "
       "cone, "
       "and the clearance law. Only the engagement with B is the same for all: after it each flies "
       "elsewhere, and a distance from C, D or E says something about a law only where it had to steer, so "
       "compare B. y is of the plane chosen: it may be negative when the relative velocity has "
       "left "
       "the cone. m is the distance at which the bodies, ellipsoids around those with dents or corners, "
       "would "
       "pass with constant velocities; the bars are lower bounds of the distance over the whole run, proved.",
       "comparison.py",
       {{"source", "6.5-noncooperative"},
        {"exact", "6.5-noncooperative-exact"},
        {"clearance", "6.5-noncooperative-clearance"}},
       {{"required", 1}}},
  };
}

}  // namespace

const std::vector<Figure>& all_figures() {
  static const std::vector<Figure> figures = make();
  return figures;
}

std::vector<Figure> choose_figures(const std::vector<std::string>& ids) {
  for (const std::string& id : ids) {
    const auto& all = all_figures();
    if (std::any_of(all.begin(), all.end(), [&](const Figure& f) { return f.id == id; })) continue;
    std::string known;
    for (const Figure& f : all) known.append(known.empty() ? "" : ", ").append(f.id);
    throw InputError("figures", id, "among " + known);
  }
  std::vector<Figure> chosen;
  for (const Figure& figure : all_figures())
    if (ids.empty() || std::find(ids.begin(), ids.end(), figure.id) != ids.end()) chosen.push_back(figure);
  return chosen;
}

}  // namespace vericone::dhal2022
