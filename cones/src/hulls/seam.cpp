// SPDX-License-Identifier: BSD-3-Clause
#include "hulls/seam.h"

#include <cmath>

#include "ellipsoids/within.h"
#include "hulls/search.h"

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

/// The plane by which a line enters K, by the simplex method: of three points of K around the line the plane
/// through them, in place of one of them the point farthest beyond it, and so on. It is the method on columns
/// (L k, 1), L the shadow along w, whose sum with weights >= 0 is to be (0, 0, 1), and costs k_axis, which
/// grow along w. Columns are asked for when they are needed, so each step costs as much as K has points.
class EntryPlane {
 public:
  EntryPlane(const HullScene& scene, const Vector& w)
      : scene_(scene),
        rows_(shadow_rows(w)),
        axis_(w[0] != 0   ? 0
              : w[1] != 0 ? 1
                          : 2),
        sign_(w[std::size_t(axis_)].sign()) {}

  /// |k_axis| of where the line begins to be in K; nothing where it never is.
  std::optional<Rational> solve(const std::vector<HullPair>& start) {
    Shown shown;
    if (origin_in_image<2>(scene_, rows_, start, nullptr, &shown) == OriginIn::outside) return std::nullopt;
    begin(shown.pairs);
    for (bool stays = false;;) {
      weigh();
      const ExactSupport support = exact_support(scene_, normal_);
      if (support.value >= price_[2]) return Rational(price_[2], volume_);
      // Where the last step has not moved, that with the first column that could enter ends all the same
      // (Bland's rule).
      stays = !enter(column(stays ? first_below() : support.pair));
    }
  }

 private:
  struct Column {
    Vector entry;
    Integer cost;
    std::optional<HullPair> pair;  // none: stands in until there is one, with weight 0
  };
  static bool before(const HullPair& p, const HullPair& q) {
    return std::pair(p.obstacle, p.agent) < std::pair(q.obstacle, q.agent);
  }

  Column column(const HullPair& pair) const {
    const Vector b = scene_.exact_obstacle(pair.obstacle), a = scene_.exact_agent(pair.agent);
    const Vector k{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return {{dot<3>(rows_[0], k), dot<3>(rows_[1], k), 1}, sign_ * k[std::size_t(axis_)], pair};
  }

  /// With up to three pairs that all have weights > 0.
  void begin(const std::vector<HullPair>& pairs) {
    std::size_t i = 0;
    for (; i < pairs.size(); ++i) basis_[i] = column(pairs[i]);
    if (i == 2) {
      const Vector y = basis_[0].entry;  // and the other one's is opposite
      basis_[i++] = {{-y[1], y[0], 0}, 0, {}};
    }
    for (int k = 0; i < 3; ++k) basis_[i++] = {{k == 0, k == 1, 0}, 0, {}};
  }

  /// The basis' inverse times its determinant, > 0; prices of its rows; the plane's normal in space.
  void weigh() {
    for (std::size_t i = 0; i < 3; ++i)
      inverse_[i] = cross(basis_[(i + 1) % 3].entry, basis_[(i + 2) % 3].entry);
    volume_ = dot<3>(inverse_[0], basis_[0].entry);
    if (volume_ < 0) {
      volume_ = -volume_;
      for (Vector& row : inverse_)
        for (Integer& e : row) e = -e;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      price_[k] = 0;
      for (std::size_t i = 0; i < 3; ++i) price_[k] += basis_[i].cost * inverse_[i][k];
      normal_[k] = 0;
    }
    normal_[std::size_t(axis_)] = sign_ * volume_;
    for (std::size_t k = 0; k < 3; ++k) normal_[k] -= price_[0] * rows_[0][k] + price_[1] * rows_[1][k];
  }

  /// Whether the plane moves.
  bool enter(Column entering) {
    Vector share;  // times the volume; the weights are inverse_[.][2]
    for (std::size_t i = 0; i < 3; ++i) share[i] = dot<3>(inverse_[i], entering.entry);
    std::size_t leave = 3;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!basis_[i].pair && share[i] != 0) {
        basis_[i] = std::move(entering);
        return false;
      }
      if (share[i] <= 0) continue;
      if (leave < 3) {
        const Integer more = inverse_[i][2] * share[leave] - inverse_[leave][2] * share[i];
        if (more > 0 || (more == 0 && before(*basis_[leave].pair, *basis_[i].pair))) continue;
      }
      leave = i;
    }
    const bool moves = inverse_[leave][2] > 0;
    basis_[leave] = std::move(entering);
    return moves;
  }

  /// The first pair below the plane.
  HullPair first_below() const {
    std::vector<Integer> agent;
    for (std::size_t i = 0; i < scene_.agent.size(); ++i)
      agent.push_back(dot<3>(normal_, scene_.exact_agent(i)) + price_[2]);
    for (std::size_t j = 0; j < scene_.obstacle.size(); ++j) {
      const Integer at = dot<3>(normal_, scene_.exact_obstacle(j));
      for (std::size_t i = 0; i < agent.size(); ++i)
        if (at < agent[i]) return {std::uint32_t(j), std::uint32_t(i)};
    }
    return {};  // never
  }

  const HullScene& scene_;
  Rows<2> rows_;
  int axis_, sign_;
  std::array<Column, 3> basis_;
  std::array<Vector, 3> inverse_;
  Integer volume_;
  Vector price_, normal_;
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
  const Vector direction = direction_on_grid<3>(w);
  const auto least = EntryPlane(scene, direction).solve(around_line(scene, w / w.cwiseAbs().maxCoeff()));
  if (!least) return std::nullopt;
  const double along = std::abs(direction[0] != 0 ? w.x() : direction[1] != 0 ? w.y() : w.z());
  // In two factors, neither of which leaves the doubles; rounded once.
  const int half = scene.grid / 2;
  const Rational seconds = *least / Rational(along) * Rational(std::ldexp(1.0, half)) *
                           Rational(std::ldexp(1.0, scene.grid - half));
  const auto time = static_cast<double>(seconds);
  if (!(time > 0x1p-1000 && time < 0x1p1000)) return std::nullopt;
  return std::pair(time * (1 - 0x1p-51), time * (1 + 0x1p-51));
}

}  // namespace vericone::exact
