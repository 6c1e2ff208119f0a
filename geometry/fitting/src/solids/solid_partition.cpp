// SPDX-License-Identifier: BSD-3-Clause
#include "solids/solid_partition.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "solids/corners.h"

namespace vericone::fitting {
namespace {

using Eigen::Vector3d;

/// Items that belong together, the corners of their hull, and the smallest solid found around them.
struct Group {
  std::vector<std::uint32_t> items;
  std::vector<Vector3d> corners;
  Solid solid;
  double volume = 0;
};

class SolidGrouper {
 public:
  SolidGrouper(const CanonicalSample& sample, const std::vector<std::vector<Vector3d>>& chords,
               const std::vector<SolidKind>& kinds, std::vector<std::uint32_t> items)
      : sample_(sample), chords_(chords), kinds_(kinds), items_(std::move(items)) {}

  std::vector<Group> run(int count, const std::function<void(double)>& told) {
    std::vector<Group> groups = components();
    const std::size_t wanted = std::size_t(count), many = count == 1 ? 1 : 2 * wanted + 4;
    std::vector<std::optional<std::pair<Group, Group>>> cuts;
    for (const Group& g : groups) cuts.push_back(best_cut(g));
    while (groups.size() < many) {
      told(0.5 * double(groups.size()) / double(many));
      std::size_t best = groups.size();
      double most = 0;
      for (std::size_t i = 0; i < groups.size(); ++i) {
        if (!cuts[i]) continue;
        const double gain = groups[i].volume - cuts[i]->first.volume - cuts[i]->second.volume;
        if (gain > most) std::tie(most, best) = std::pair(gain, i);
      }
      if (best == groups.size()) break;
      auto [low, high] = std::move(*cuts[best]);
      cuts[best] = best_cut(low);
      cuts.push_back(best_cut(high));
      groups[best] = std::move(low);
      groups.push_back(std::move(high));
    }
    join(groups, wanted, told);
    return settled(std::move(groups));
  }

  /// Each item, also those that were left out so far, to the solid that it is deepest in.
  std::vector<int> nearest(const std::vector<Group>& groups, const std::vector<std::uint32_t>& items) const {
    std::vector<int> of;
    for (const std::uint32_t item : items) {
      double least = std::numeric_limits<double>::infinity();
      of.push_back(0);
      for (std::size_t k = 0; k < groups.size(); ++k) {
        double most = 0;
        each_corner(item, [&](const Vector3d& x) { most = std::max(most, depth_ratio(groups[k].solid, x)); });
        if (most >= least) continue;
        least = most;
        of.back() = int(k);
      }
    }
    return of;
  }

 private:
  template <typename Function>
  void each_corner(std::uint32_t item, const Function& function) const {
    if (!sample_.is_mesh()) return function(sample_.points[item]);
    for (const std::uint32_t corner : sample_.triangles[item]) function(sample_.points[corner]);
    for (const Vector3d& end : chords_[item]) function(end);
  }

  Vector3d middle(std::uint32_t item) const {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    each_corner(item, [&](const Vector3d& x) { sum += x, ++count; });
    return sum / count;
  }

  Group grouped(std::vector<std::uint32_t> items, const std::vector<Vector3d>& points) const {
    const Corners corners = corners_of(points, Effort::quick);
    const Solid solid = smallest_of(corners, kinds_, Effort::quick);
    return {std::move(items), corners.points, solid, solid.volume()};
  }

  Group group_of(std::vector<std::uint32_t> items) const {
    std::vector<Vector3d> points;
    for (const std::uint32_t item : items) each_corner(item, [&](const Vector3d& x) { points.push_back(x); });
    return grouped(std::move(items), points);
  }

  Group joined(const Group& a, const Group& b) const {
    std::vector<std::uint32_t> items = a.items;
    items.insert(items.end(), b.items.begin(), b.items.end());
    std::vector<Vector3d> points = a.corners;
    points.insert(points.end(), b.corners.begin(), b.corners.end());
    return grouped(std::move(items), points);
  }

  /// What shares corners; all as one where these are too many to be joined again one by one.
  std::vector<Group> components() const {
    constexpr std::size_t kMost = 80;
    std::vector<std::uint32_t> above(sample_.points.size());
    std::iota(above.begin(), above.end(), 0U);
    const auto root = [&](std::uint32_t i) {
      while (above[i] != i) i = above[i] = above[above[i]];
      return i;
    };
    std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
    if (sample_.is_mesh()) {
      for (const auto& t : sample_.triangles)
        for (int k = 1; k < 3; ++k) above[root(t[std::size_t(k)])] = root(t[0]);
      for (const std::uint32_t item : items_) parts[root(sample_.triangles[item][0])].push_back(item);
    }
    if (parts.size() < 2 || parts.size() > kMost) return {group_of(items_)};
    std::vector<Group> groups;
    for (auto& [first, items] : parts) groups.push_back(group_of(std::move(items)));
    return groups;
  }

  std::optional<std::pair<Group, Group>> best_cut(const Group& whole) const {
    constexpr int kPlaces = 6;
    if (whole.items.size() < 2) return std::nullopt;
    const Solid box = small_solid(Corners{whole.corners, axes_of(whole)}, SolidKind::box, Effort::quick);
    std::optional<std::pair<Group, Group>> best;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> along;
      for (const std::uint32_t item : whole.items)
        along.push_back(box.rotation.col(axis).dot(middle(item) - box.center));
      const auto [low, high] = std::minmax_element(along.begin(), along.end());
      for (int place = 1; place < kPlaces; ++place) {
        const double at = *low + (*high - *low) * place / kPlaces;
        std::vector<std::uint32_t> below, above;
        for (std::size_t i = 0; i < along.size(); ++i)
          (along[i] <= at ? below : above).push_back(whole.items[i]);
        if (below.empty() || above.empty()) continue;
        Group a = group_of(std::move(below));
        if (best && a.volume >= best->first.volume + best->second.volume) continue;
        Group b = group_of(std::move(above));
        if (best && a.volume + b.volume >= best->first.volume + best->second.volume) continue;
        best = {std::move(a), std::move(b)};
      }
    }
    return best;
  }

  /// Worth trying as axes of a box.
  std::vector<Vector3d> axes_of(const Group& group) const {
    return corners_of(group.corners, Effort::quick).directions;
  }

  void join(std::vector<Group>& groups, std::size_t wanted, const std::function<void(double)>& told) const {
    const auto cost = [&](const Group& both, const Group& a, const Group& b) {
      return both.volume - a.volume - b.volume;
    };
    std::map<std::pair<std::size_t, std::size_t>, double> costs;
    std::vector<std::size_t> alive(groups.size());
    std::iota(alive.begin(), alive.end(), std::size_t(0));
    const auto ask = [&](std::size_t i, std::size_t j) {
      costs[{i, j}] = cost(joined(groups[i], groups[j]), groups[i], groups[j]);
    };
    if (alive.size() <= wanted) return;
    for (std::size_t j = 0; j < groups.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) ask(i, j);
    const double first = double(groups.size() - wanted);
    while (alive.size() > wanted) {
      told(0.5 + 0.4 * (1 - double(alive.size() - wanted) / first));
      const auto least = std::min_element(costs.begin(), costs.end(),
                                          [](const auto& a, const auto& b) { return a.second < b.second; });
      const auto [i, j] = least->first;
      groups[i] = joined(groups[i], groups[j]);
      std::erase(alive, j);
      std::erase_if(costs, [&, i = i, j = j](const auto& of) {
        const auto& [a, b] = of.first;
        return a == i || b == i || a == j || b == j;
      });
      for (const std::size_t k : alive)
        if (k != i) ask(std::min(i, k), std::max(i, k));
    }
    std::vector<Group> left;
    for (const std::size_t k : alive) left.push_back(std::move(groups[k]));
    groups = std::move(left);
  }

  std::vector<Group> settled(std::vector<Group> groups) const {
    constexpr int kTurns = 10;
    const auto sum = [](const std::vector<Group>& of) {
      double all = 0;
      for (const Group& g : of) all += g.volume;
      return all;
    };
    for (int turn = 0; turn < kTurns && groups.size() > 1; ++turn) {
      std::vector<std::vector<std::uint32_t>> lists(groups.size());
      const std::vector<int> of = nearest(groups, items_);
      for (std::size_t i = 0; i < of.size(); ++i) lists[std::size_t(of[i])].push_back(items_[i]);
      std::vector<Group> next;
      for (auto& list : lists)
        if (!list.empty()) next.push_back(group_of(std::move(list)));
      if (!(sum(next) < sum(groups) * (1 - 1e-9))) break;
      groups = std::move(next);
    }
    return groups;
  }

  const CanonicalSample& sample_;
  const std::vector<std::vector<Vector3d>>& chords_;
  const std::vector<SolidKind>& kinds_;
  std::vector<std::uint32_t> items_;
};

}  // namespace

double depth_ratio(const Solid& solid, const Vector3d& x) {
  const auto ratio = [](double part, double whole) {
    return whole > 0 ? part / whole : part > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  };
  const Vector3d y = solid.rotation.transpose() * (x - solid.center);
  const Vector3d& s = solid.sizes;
  switch (solid.kind) {
    case SolidKind::sphere:
      return ratio(y.norm(), s(0));
    case SolidKind::capsule: {
      const double end = std::clamp(y.z(), -0.5 * s(1), 0.5 * s(1));
      return ratio(Vector3d(y.x(), y.y(), y.z() - end).norm(), s(0));
    }
    case SolidKind::cylinder:
      return std::max(ratio(std::hypot(y.x(), y.y()), s(0)), ratio(std::abs(y.z()), 0.5 * s(1)));
    case SolidKind::box:
      return std::max(
          {ratio(std::abs(y.x()), s(0)), ratio(std::abs(y.y()), s(1)), ratio(std::abs(y.z()), s(2))});
    case SolidKind::ellipsoid:
      break;
  }
  return y.cwiseQuotient(s).norm();
}

std::vector<std::uint32_t> some_items(const CanonicalSample& sample) {
  constexpr std::size_t kMostItems = 3000;
  const std::size_t all = sample.is_mesh() ? sample.triangles.size() : sample.points.size();
  const std::size_t stride = (all + kMostItems - 1) / kMostItems;
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < all; i += stride) some.push_back(std::uint32_t(i));
  return some;
}

SolidGroups solid_groups(const CanonicalSample& sample, const std::vector<std::vector<Vector3d>>& chords,
                         const std::vector<SolidKind>& kinds, int count,
                         const std::function<void(double)>& told) {
  const std::size_t all = sample.is_mesh() ? sample.triangles.size() : sample.points.size();
  SolidGroups result;
  result.group.assign(all, 0);
  if (count == 1) return result;
  const std::vector<std::uint32_t> some = some_items(sample);
  SolidGrouper grouper(sample, chords, kinds, some);
  const std::vector<Group> groups = grouper.run(count, told);
  result.count = int(groups.size());
  if (some.size() < all) {
    std::vector<std::uint32_t> every(all);
    std::iota(every.begin(), every.end(), 0U);
    result.group = grouper.nearest(groups, every);
  } else {
    for (std::size_t k = 0; k < groups.size(); ++k)
      for (const std::uint32_t item : groups[k].items) result.group[item] = int(k);
  }
  // A group that the whole sample leaves empty is none.
  std::map<int, int> number;
  for (const int g : result.group) number.emplace(g, 0);
  int next = 0;
  for (auto& [g, of] : number) of = next++;
  for (int& g : result.group) g = number[g];
  result.count = next;
  return result;
}

}  // namespace vericone::fitting
