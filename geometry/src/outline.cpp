// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/internal/geometry/outline.h>

#include <vericone/geometry/error.h>
#include <vericone/internal/geometry/exact/integer.h>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace vericone::outlines {

using Eigen::Vector2d;

int turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double left = (b.x() - a.x()) * (c.y() - a.y()), right = (b.y() - a.y()) * (c.x() - a.x());
  // Differences, products and their difference: each of the two terms is off by less than four roundings.
  const double bound = 0x1p-51 * (std::abs(left) + std::abs(right)) + 1e-300;
  if (std::abs(left - right) > bound) return left > right ? 1 : -1;
  Eigen::Matrix<double, 6, 1> all;
  all << a, b, c;
  const auto x = exact::direction_on_grid<6>(all);
  return ((x[2] - x[0]) * (x[5] - x[1])).compare((x[3] - x[1]) * (x[4] - x[0]));
}

bool within(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return std::min(a.x(), b.x()) <= c.x() && c.x() <= std::max(a.x(), b.x()) &&
         std::min(a.y(), b.y()) <= c.y() && c.y() <= std::max(a.y(), b.y());
}

bool meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  if (std::max(a.x(), b.x()) < std::min(c.x(), d.x()) || std::max(c.x(), d.x()) < std::min(a.x(), b.x()) ||
      std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y()))
    return false;
  const int abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) || (cda == 0 && within(c, d, a)) ||
         (cdb == 0 && within(c, d, b));
}

void require_simple(const std::vector<Vector2d>& p, const std::string& name) {
  const auto named = [&](std::size_t i) { return name + "[" + std::to_string(i) + "]"; };
  const std::size_t n = p.size();
  const auto end = [&](std::size_t i) -> const Vector2d& { return p[i + 1 == n ? 0 : i + 1]; };
  const auto left = [&](std::size_t i) { return std::min(p[i].x(), end(i).x()); };
  std::vector<std::size_t> order(n), open;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return left(i) < left(j); });
  // Along x: only edges that are over one place at once can meet.
  std::size_t meets = n, met = n;  // the first edge that meets one before it
  for (const std::size_t i : order) {
    std::erase_if(open, [&](std::size_t j) { return std::max(p[j].x(), end(j).x()) < left(i); });
    for (const std::size_t j : open) {
      const std::size_t first = std::min(i, j), second = std::max(i, j);
      const bool follows = second == first + 1, closes = first == 0 && second + 1 == n;
      bool crosses = false;
      if (follows || closes) {
        // They share a vertex: wrong only where one folds back onto the other.
        const Vector2d &a = follows ? p[first] : end(first), &b = follows ? p[second] : p[first],
                       &c = follows ? end(second) : p[second];
        crosses = turn(a, b, c) == 0 && (within(a, b, c) || within(b, c, a));
      } else {
        crosses = meet(p[i], end(i), p[j], end(j));
      }
      if (crosses && std::pair(second, first) < std::pair(meets, met)) {
        meets = second;
        met = first;
      }
    }
    open.push_back(i);
  }
  if (meets < n)
    throw InputError(named(meets), "an edge that meets the one from " + named(met),
                     "the start of an edge that meets no other (a simple polygon)");
}

std::size_t leftmost(const std::vector<Vector2d>& p) {
  return static_cast<std::size_t>(std::min_element(p.begin(), p.end(),
                                                   [](const Vector2d& a, const Vector2d& b) {
                                                     return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
                                                   }) -
                                  p.begin());
}

}  // namespace vericone::outlines
