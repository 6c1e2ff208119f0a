// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/geometry/mesh/surface.h>

#include <vericone/geometry/error.h>
#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace vericone {
namespace {

using Loop = std::vector<std::uint32_t>;

/// From one end to the other as in its triangle.
struct RimEdge {
  std::uint32_t from, to;
};

std::vector<RimEdge> rim_edges(std::size_t points,
                               const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  struct Side {
    std::uint32_t low, high;
    bool upwards;
    bool operator<(const Side& other) const { return low != other.low ? low < other.low : high < other.high; }
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      if (a >= points)
        throw InputError("triangles[" + std::to_string(i) + "][" + std::to_string(k) + "]", std::to_string(a),
                         "less than the number of points, " + std::to_string(points));
      if (a != b) sides.push_back({std::min(a, b), std::max(a, b), a < b});
    }
  std::stable_sort(sides.begin(), sides.end());
  std::vector<RimEdge> edges;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && !(sides[i] < sides[end])) ++end;
    const Side& s = sides[i];
    if (end == i + 1) edges.push_back(s.upwards ? RimEdge{s.low, s.high} : RimEdge{s.high, s.low});
    i = end;
  }
  return edges;
}

}  // namespace

std::vector<Loop> boundary_loops(const std::vector<Eigen::Vector3d>& points,
                                 const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const std::vector<RimEdge> edges = rim_edges(points.size(), triangles);
  std::map<std::uint32_t, std::vector<std::size_t>> at;  // edges by their ends
  for (std::size_t e = 0; e < edges.size(); ++e) {
    at[edges[e].from].push_back(e);
    at[edges[e].to].push_back(e);
  }
  std::vector<bool> used(edges.size(), false);
  std::vector<Loop> loops;
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start]) continue;
    // A walk along unused edges; where it comes back to a point of its own, it has closed a loop.
    Loop way{edges[start].from};
    std::map<std::uint32_t, std::size_t> place{{edges[start].from, 0}};
    std::size_t edge = start;
    for (;;) {
      used[edge] = true;
      const std::uint32_t next = edges[edge].from == way.back() ? edges[edge].to : edges[edge].from;
      if (const auto before = place.find(next); before != place.end()) {
        const auto first = way.begin() + static_cast<std::ptrdiff_t>(before->second);
        loops.emplace_back(first, way.end());
        for (auto i = first + 1; i != way.end(); ++i) place.erase(*i);
        way.erase(first + 1, way.end());
      } else {
        place.emplace(next, way.size());
        way.push_back(next);
      }
      // On as triangles have it, if one of them goes that way.
      std::size_t onwards = edges.size();
      for (const std::size_t e : at[way.back()])
        if (!used[e] && (onwards == edges.size() || edges[e].from == way.back())) onwards = e;
      if (onwards == edges.size()) break;  // every end has an even number of edges: closed
      edge = onwards;
    }
  }
  const auto length = [&](const Loop& loop) {
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum += (points[loop[(i + 1) % loop.size()]] - points[loop[i]]).norm();
    return sum;
  };
  std::vector<std::pair<double, Loop>> sized;
  for (Loop& loop : loops) {
    const double metres = length(loop);
    if (loop.size() >= 3) sized.emplace_back(metres, std::move(loop));
  }
  std::stable_sort(sized.begin(), sized.end(),
                   [](const auto& x, const auto& y) { return x.first > y.first; });
  std::vector<Loop> sorted;
  for (auto& loop : sized) sorted.push_back(std::move(loop.second));
  return sorted;
}

}  // namespace vericone
