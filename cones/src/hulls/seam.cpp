// SPDX-License-Identifier: BSD-3-Clause
#include "hulls/seam.h"

#include <cmath>

#include "ellipsoids/within.h"

namespace vericone::exact {
namespace {

using Vector = IntegerVector<3>;

template <int D>
Integer dot(const IntegerVector<D>& x, const IntegerVector<D>& y) {
  Integer sum = x[0] * y[0];
  for (int i = 1; i < D; ++i) sum += x[i] * y[i];
  return sum;
}

Vector cross(const Vector& x, const Vector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}
int turn(const IntegerVector<2>& x, const IntegerVector<2>& y) { return (x[0] * y[1] - x[1] * y[0]).sign(); }

/// Without its common factor.
Vector primitive(Vector x) {
  const Integer common = gcd(gcd(x[0], x[1]), x[2]);
  if (common > 1)
    for (Integer& e : x) e /= common;
  return x;
}

/// All that is between these rays, in the order of their turn about it.
using Wedge = std::vector<Vector>;

/// The part with sign * n.x >= 0.
Wedge clipped(const Wedge& wedge, const Vector& n, int sign) {
  Wedge part;
  for (std::size_t i = 0; i < wedge.size(); ++i) {
    const Vector &a = wedge[i], &b = wedge[(i + 1) % wedge.size()];
    const Integer at_a = sign * dot<3>(n, a), at_b = sign * dot<3>(n, b);
    if (at_a.sign() >= 0) part.push_back(a);
    if (at_a.sign() * at_b.sign() >= 0) continue;
    Vector between;
    for (int k = 0; k < 3; ++k) between[k] = abs(at_b) * a[k] + abs(at_a) * b[k];
    part.push_back(primitive(std::move(between)));
  }
  part.erase(std::unique(part.begin(), part.end()), part.end());
  return part;
}

/// The eight wedges between the axes.
std::vector<Wedge> octants() {
  std::vector<Wedge> all;
  for (int i = 0; i < 8; ++i) {
    Wedge wedge(3, Vector{0, 0, 0});
    for (int k = 0; k < 3; ++k) wedge[std::size_t(k)][k] = i >> k & 1 ? -1 : 1;
    all.push_back(std::move(wedge));
  }
  return all;
}

/// Whether the vectors span space.
template <class Vectors>
bool spans(const Vectors& vectors) {
  Vector first{0, 0, 0}, normal{0, 0, 0};
  bool line = false, plane = false;
  for (const Vector& v : vectors) {
    if (plane) {
      if (dot<3>(normal, v) != 0) return true;
    } else if (line) {
      normal = cross(first, v);
      plane = normal != Vector{0, 0, 0};
    } else if (v != Vector{0, 0, 0}) {
      first = v;
      line = true;
    }
  }
  return false;
}

/// Whether some of the wedge is in none of the cones from the k-th on.
bool left_over(Wedge wedge, const std::vector<std::vector<Vector>>& cones, std::size_t k) {
  for (; k < cones.size(); ++k) {
    const bool apart = std::any_of(cones[k].begin(), cones[k].end(), [&](const Vector& n) {
      return std::all_of(wedge.begin(), wedge.end(), [&](const Vector& x) { return dot<3>(n, x) <= 0; });
    });
    if (apart) continue;
    for (const Vector& n : cones[k]) {
      if (Wedge outside = clipped(wedge, n, -1);
          spans(outside) && left_over(std::move(outside), cones, k + 1))
        return true;
      wedge = clipped(wedge, n, 1);
    }
    return false;
  }
  return true;
}

std::vector<Vector> differences(const HullScene& scene) {
  std::vector<Vector> all;
  all.reserve(scene.obstacle.size() * scene.agent.size());
  for (std::size_t j = 0; j < scene.obstacle.size(); ++j) {
    const Vector b = scene.exact_obstacle(j);
    for (std::size_t i = 0; i < scene.agent.size(); ++i) {
      const Vector a = scene.exact_agent(i);
      all.push_back({b[0] - a[0], b[1] - a[1], b[2] - a[2]});
    }
  }
  return all;
}

/// The least cost of a sum of columns with weights >= 0 that is (0, 0, 1): the simplex method, with Bland's
/// rule, which ends.
class LeastCost {
 public:
  struct Column {
    Rational entry[3], cost, lacking = 0;
  };
  explicit LeastCost(std::vector<Column> columns) : columns_(std::move(columns)), count_(columns_.size()) {
    columns_.push_back({{0, 0, 1}, 0});
    // It begins with weights of three columns that are none, whose sum is to vanish first.
    for (Column& c : columns_)
      for (const Rational& e : c.entry) c.lacking -= e;
    for (int r = 0; r < 3; ++r) basis_[r] = count_ + std::size_t(r);
  }

  std::optional<Rational> solve() {
    minimise(&Column::lacking);
    if (columns_[count_].lacking != 0) return std::nullopt;
    // What is left of them has weight 0, and goes where its row says anything.
    for (int r = 0; r < 3; ++r)
      for (std::size_t j = 0; j < count_ && basis_[r] >= count_; ++j)
        if (columns_[j].entry[r] != 0) exchange(r, j);
    minimise(&Column::cost);
    return -columns_[count_].cost;
  }

 private:
  void minimise(Rational Column::*cost) {
    for (;;) {
      std::size_t enter = 0;
      while (enter < count_ && columns_[enter].*cost >= 0) ++enter;
      if (enter == count_) return;
      int leave = -1;
      Rational least;
      for (int r = 0; r < 3; ++r) {
        if (columns_[enter].entry[r] <= 0) continue;
        const Rational ratio = columns_[count_].entry[r] / columns_[enter].entry[r];
        if (leave >= 0 && (ratio > least || (ratio == least && basis_[r] > basis_[leave]))) continue;
        leave = r;
        least = ratio;
      }
      if (leave < 0) return;  // never: the weights' sum is bounded
      exchange(leave, enter);
    }
  }
  void exchange(int row, std::size_t enter) {
    const Column by = columns_[enter];
    for (Column& c : columns_) {
      const Rational share = c.entry[row] / by.entry[row];
      if (share == 0) continue;
      for (int r = 0; r < 3; ++r) c.entry[r] -= by.entry[r] * share;
      c.entry[row] = share;
      c.cost -= by.cost * share;
      c.lacking -= by.lacking * share;
    }
    basis_[row] = enter;
  }

  std::vector<Column> columns_;  // the last is (0, 0, 1)
  std::size_t count_, basis_[3];
};

}  // namespace

Generators generators(const HullScene& scene) {
  Generators all = differences(scene);
  for (Vector& x : all) x = primitive(std::move(x));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Membership within(const ConeOracle& oracle, const Stretch& stretch, Generators*) {
  return within(oracle.a(), oracle.b(), stretch);
}

Membership within(const HullOracle& oracle, const Stretch& stretch, Generators* covered) {
  const HullScene scene(scene_of(oracle), stretch);
  switch (relation(scene)) {
    case Relation::overlapping:
      return Membership::in;
    case Relation::touching:
      if (covered != nullptr && !scene.ellipsoid) *covered = generators(scene);
      return Membership::on;
    case Relation::disjoint:
      break;
  }
  return Membership::out;
}

bool has_interior(const Generators& cone) { return spans(cone); }

// The rays of the cone's dual, cut at the axes.
std::vector<Vector> sides(const Generators& cone) {
  std::vector<Vector> normals;
  for (Wedge dual : octants()) {
    for (const Vector& g : cone) {
      dual = clipped(dual, g, 1);
      if (dual.empty()) break;
    }
    normals.insert(normals.end(), dual.begin(), dual.end());
  }
  std::sort(normals.begin(), normals.end());
  normals.erase(std::unique(normals.begin(), normals.end()), normals.end());
  return normals;
}

std::optional<Sector> image(const Generators& cone, const Rows<2>& rows) {
  Sector sector;
  bool any = false, line = false, open = false;  // a direction, its opposite, one beside them
  for (const Vector& g : cone) {
    const IntegerVector<2> x{dot<3>(rows[0], g), dot<3>(rows[1], g)};
    if (x[0] == 0 && x[1] == 0) continue;
    if (!any) {
      sector = {x, x};
      any = true;
      continue;
    }
    const int from_low = turn(sector.low, x), from_high = turn(sector.high, x);
    const bool opposite_low = from_low == 0 && dot<2>(sector.low, x) < 0,
               opposite_high = from_high == 0 && dot<2>(sector.high, x) < 0;
    const IntegerVector<2> back{-sector.low[0], -sector.low[1]};
    if (!open) {
      if (from_low == 0) {
        line = line || opposite_low;
      } else {
        sector = from_low > 0 ? Sector{sector.low, line ? back : x} : Sector{line ? back : x, sector.high};
        open = true;
      }
    } else if (opposite_low) {
      sector.high = x;
    } else if (opposite_high || from_low < 0) {
      if (turn(sector.low, sector.high) != 0) sector.low = x;
    } else if (from_high > 0 && turn(sector.low, sector.high) != 0) {
      sector.high = x;
    }
  }
  if (!open) return std::nullopt;
  return sector;
}

bool cover_plane(const std::vector<Sector>& sectors) {
  // Beyond the end of each some other has to go on.
  const auto goes_on = [](const Sector& s, const IntegerVector<2>& x) {
    const int from_low = turn(s.low, x), width = turn(s.low, s.high);
    if (from_low == 0) return dot<2>(s.low, x) > 0;
    return from_low > 0 && (width == 0 || turn(x, s.high) > 0);
  };
  return !sectors.empty() && std::all_of(sectors.begin(), sectors.end(), [&](const Sector& ends) {
    return std::any_of(sectors.begin(), sectors.end(),
                       [&](const Sector& s) { return goes_on(s, ends.high); });
  });
}

bool cover_space(const std::vector<Generators>& cones) {
  std::vector<std::vector<Vector>> all;
  for (const Generators& cone : cones)
    if (spans(cone)) all.push_back(sides(cone));
  for (Wedge& wedge : octants())
    if (left_over(std::move(wedge), all, 0)) return false;
  return true;
}

bool is_flat(const std::vector<Eigen::Vector3d>& points) {
  Generators edges;
  for (const Eigen::Vector3d& x : points) edges.push_back(difference_on_grid<3>(x, points.front()));
  return !spans(edges);
}

std::optional<std::pair<double, double>> first_time(const HullScene& scene, const Eigen::Vector3d& w) {
  constexpr std::size_t kMostPoints = 200;  // milliseconds
  if (scene.obstacle.size() * scene.agent.size() > kMostPoints) return std::nullopt;
  const Vector direction = direction_on_grid<3>(w);
  const Rows<2> rows = shadow_rows(direction);
  const int axis = direction[0] != 0 ? 0 : direction[1] != 0 ? 1 : 2;
  const Rational along = w(axis);
  std::vector<LeastCost::Column> points;
  for (const Vector& k : differences(scene))
    points.push_back({{dot<3>(rows[0], k), dot<3>(rows[1], k), 1}, Rational(k[axis]) / along});
  const std::optional<Rational> least = LeastCost(std::move(points)).solve();
  if (!least) return std::nullopt;
  const double time = std::ldexp(static_cast<double>(*least), scene.grid);
  if (!(time > 0x1p-1000 && time < 0x1p1000)) return std::nullopt;
  return std::pair(time * (1 - 0x1p-51), time * (1 + 0x1p-51));
}

}  // namespace vericone::exact
