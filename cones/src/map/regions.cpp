// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/map/cone_map.h>
#include <vericone/internal/cones/map/cell.h>

#include <vericone/geometry/error.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

namespace vericone {
namespace {

using Eigen::Vector3d;
using Index = std::uint32_t;
using Edge = std::array<Index, 2>;  // corners, from and to

class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), Index{0}); }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The smaller index represents both: it does not depend on the order.
  void join(Index i, Index k) {
    i = find(i);
    k = find(k);
    parent_[std::max(i, k)] = std::min(i, k);
  }

 private:
  std::vector<Index> parent_;
};

std::uint64_t key(Index a, Index b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

/// Part of an edge of a cell that no corner divides: every one has one cell on each side.
struct CellSide {
  std::uint64_t edge;
  Index cell;
  bool rising;  // the cell is to the left of the way from the smaller to the larger corner
  bool operator<(const CellSide& other) const {
    return std::pair(edge, rising) < std::pair(other.edge, other.rising);
  }
};

[[noreturn]] void refuse(const std::string& field, const std::string& what) {
  throw InputError(field, what, "that of a division of the sphere, as cone_map() returns it");
}

/// In pairs: those of one edge follow each other. Throws InputError where the map is no division of the
/// sphere.
std::vector<CellSide> sides_of(const ConeMap& map) {
  const auto is_corner = [&map](Index i) { return i < map.corners.size(); };
  for (std::size_t c = 0; c < map.cells.size(); ++c)
    if (!std::ranges::all_of(map.cells[c].corners, is_corner))
      refuse("map.cells[" + std::to_string(c) + "]", "a corner that there is not");
  for (std::size_t i = 0; i < map.between.size(); ++i)
    if (!std::ranges::all_of(map.between[i], is_corner))
      refuse("map.between[" + std::to_string(i) + "]", "a corner that there is not");
  std::unordered_map<std::uint64_t, Index> middles;
  middles.reserve(map.between.size());
  for (Index i = 0; i < map.between.size(); ++i)
    middles.emplace(key(map.between[i][0], map.between[i][1]), i);
  std::vector<CellSide> sides;
  sides.reserve(4 * map.cells.size());
  std::vector<Edge> stack;
  // A corner divides an edge of each of two cells at most.
  std::size_t left = 3 * map.cells.size() + 4 * map.between.size();
  for (Index c = 0; c < map.cells.size(); ++c) {
    const auto& corners = map.cells[c].corners;
    stack = {{corners[0], corners[1]}, {corners[1], corners[2]}, {corners[2], corners[0]}};
    while (!stack.empty()) {
      const auto [a, b] = stack.back();
      stack.pop_back();
      if (left-- == 0) refuse("map.between", "a corner that divides an edge which ends in it");
      if (const auto m = middles.find(key(a, b)); m != middles.end()) {
        stack.push_back({a, m->second});
        stack.push_back({m->second, b});
      } else {
        sides.push_back({key(a, b), c, a < b});
      }
    }
  }
  std::sort(sides.begin(), sides.end());
  for (std::size_t i = 0; i < sides.size(); i += 2)
    if (i + 1 == sides.size() || sides[i].edge != sides[i + 1].edge ||
        sides[i].rising == sides[i + 1].rising || (i > 0 && sides[i - 1].edge == sides[i].edge))
      refuse("map.cells[" + std::to_string(sides[i].cell) + "]", "an edge without a cell beyond it");
  return sides;
}

/// Chains directed edges with the region to their left to closed polygons. Where the region touches itself in
/// a corner the way goes on along the other wedge of it, the corner being of the region: the last edge
/// clockwise from where it came.
class Chains {
 public:
  Chains(const std::vector<Vector3d>& corners, std::vector<Edge> edges)
      : corners_(corners), edges_(std::move(edges)), used_(edges_.size()) {
    std::sort(edges_.begin(), edges_.end());
  }

  std::vector<std::vector<Vector3d>> loops() {
    std::vector<std::pair<double, std::vector<Vector3d>>> found;
    for (std::size_t first = 0; first < edges_.size(); ++first) {
      if (used_[first]) continue;
      auto& [length, loop] = found.emplace_back();
      std::size_t at = first;
      do {
        used_[at] = true;
        const auto [from, to] = edges_[at];
        loop.push_back(corners_[from]);
        length += std::atan2(corners_[from].cross(corners_[to]).norm(), corners_[from].dot(corners_[to]));
        at = next(at);
      } while (!used_[at]);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& x, const auto& y) { return x.first > y.first; });
    std::vector<std::vector<Vector3d>> result;
    for (auto& f : found) result.push_back(std::move(f.second));
    return result;
  }

 private:
  std::size_t next(std::size_t at) const {
    const auto [from, to] = edges_[at];
    auto edge = std::lower_bound(edges_.begin(), edges_.end(), Edge{to, 0});
    std::size_t best = static_cast<std::size_t>(edge - edges_.begin());
    double most = -1;
    for (; edge != edges_.end() && (*edge)[0] == to; ++edge) {
      const Vector3d &v = corners_[to], back = corners_[from] - v, out = corners_[(*edge)[1]] - v;
      double turn = std::atan2(v.dot(out.cross(back)), v.norm() * out.dot(back));
      if (turn <= 0) turn += 2 * std::numbers::pi;
      if (turn > most) {
        most = turn;
        best = static_cast<std::size_t>(edge - edges_.begin());
      }
    }
    return best;
  }

  const std::vector<Vector3d>& corners_;
  std::vector<Edge> edges_;
  std::vector<char> used_;
};

class Regions {
 public:
  explicit Regions(const ConeMap& map)
      : map_(map), own_(map.cells.size()), possible_{Sets(map.cells.size()), Sets(map.cells.size())} {
    sides_ = sides_of(map);
    for (std::size_t i = 0; i + 1 < sides_.size(); i += 2) {
      const Index a = sides_[i].cell, b = sides_[i + 1].cell;
      for (const Certified l : {Certified::in, Certified::out})
        if (may_be(a, l) && may_be(b, l)) possible(l).join(a, b);
    }
    join_at_corners();
  }

  /// All, or only that of a cell.
  std::vector<ConeMapRegion> collect(const Index* only) {
    std::unordered_map<Index, std::size_t> index;  // of the region, by its first cell
    std::vector<ConeMapRegion> result;
    std::unordered_map<Index, int> regions_in[2];  // of a possible region
    std::unordered_map<Index, double> size_of[2];
    for (Index c = 0; c < map_.cells.size(); ++c) {
      const double area = vericone::solid_angle(map_.cell(c));
      for (const Certified l : {Certified::in, Certified::out})
        if (may_be(c, l)) size_of[side(l)][possible(l).find(c)] += area;
      if (label(c) == Certified::undecided) continue;
      const Index root = own_.find(c);
      if (root == c) ++regions_in[side(label(c))][possible(label(c)).find(c)];
      if (only && root != own_.find(*only)) continue;
      const auto [entry, fresh] = index.try_emplace(root, result.size());
      if (fresh) result.emplace_back().label = label(c);
      ConeMapRegion& region = result[entry->second];
      region.cells.push_back(c);
      region.solid_angle += area;
    }
    for (ConeMapRegion& region : result) {
      const int s = side(region.label);
      const Index root = possible(region.label).find(region.cells.front());
      region.most_solid_angle = size_of[s].at(root);
      region.possible = root;
      region.surely_separate = regions_in[s].at(root) == 1;
    }
    std::vector<std::vector<Edge>> rims(result.size());
    for (std::size_t i = 0; i + 1 < sides_.size(); i += 2)
      for (const auto& [here, there] : {std::pair(sides_[i], sides_[i + 1]), {sides_[i + 1], sides_[i]}}) {
        if (own_.find(here.cell) == own_.find(there.cell)) continue;
        const auto entry = index.find(own_.find(here.cell));
        if (entry == index.end()) continue;
        const auto low = static_cast<Index>(here.edge >> 32), high = static_cast<Index>(here.edge);
        rims[entry->second].push_back(here.rising ? Edge{low, high} : Edge{high, low});
      }
    for (std::size_t r = 0; r < result.size(); ++r)
      result[r].boundary = Chains(map_.corners, std::move(rims[r])).loops();
    std::stable_sort(result.begin(), result.end(),
                     [](const auto& x, const auto& y) { return x.solid_angle > y.solid_angle; });
    return result;
  }

 private:
  /// Cells of one label that have a corner in common, be it in the middle of an edge.
  void join_at_corners() {
    const auto none = static_cast<Index>(map_.cells.size());
    std::vector<std::array<Index, 2>> first(map_.corners.size(), {none, none});
    for (const CellSide& s : sides_) {
      if (label(s.cell) == Certified::undecided) continue;
      for (const auto corner : {static_cast<Index>(s.edge >> 32), static_cast<Index>(s.edge)}) {
        Index& cell = first[corner][side(label(s.cell))];
        if (cell == none) cell = s.cell;
        own_.join(cell, s.cell);
      }
    }
  }

  Certified label(Index cell) const { return map_.cells[cell].label; }
  bool may_be(Index cell, Certified l) const {
    return label(cell) == l || label(cell) == Certified::undecided;
  }
  static int side(Certified l) { return l == Certified::in ? 0 : 1; }
  Sets& possible(Certified l) { return possible_[side(l)]; }

  const ConeMap& map_;
  Sets own_;
  Sets possible_[2];
  std::vector<CellSide> sides_;
};

}  // namespace

std::vector<ConeMapRegion> regions(const ConeMap& map) { return Regions(map).collect(nullptr); }

std::optional<ConeMapRegion> region_around(const ConeMap& map, const Vector3d& direction) {
  const auto cell = static_cast<Index>(cell_at(map, direction));
  if (map.cells[cell].label == Certified::undecided) return std::nullopt;
  return std::move(Regions(map).collect(&cell).front());
}

}  // namespace vericone
