// SPDX-License-Identifier: BSD-3-Clause
#include "hulls/exact.h"

#include <algorithm>
#include <limits>

namespace vericone::exact {
namespace {

template <int D>
Integer dot(const IntegerVector<D>& x, const IntegerVector<D>& y) {
  Integer sum = x[0] * y[0];
  for (int i = 1; i < D; ++i) sum += x[i] * y[i];
  return sum;
}

template <int D>
bool is_zero(const IntegerVector<D>& x) {
  return std::all_of(x.begin(), x.end(), [](const Integer& e) { return e.is_zero(); });
}

/// Without its common factor: a direction.
template <int D>
IntegerVector<D> primitive(IntegerVector<D> x) {
  Integer common = 0;
  for (const Integer& e : x) common = gcd(common, e);
  if (common > 1)
    for (Integer& e : x) e /= common;
  return x;
}

IntegerVector<3> cross(const IntegerVector<3>& x, const IntegerVector<3>& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

Integer cross(const IntegerVector<2>& x, const IntegerVector<2>& y) { return x[0] * y[1] - x[1] * y[0]; }

/// About n over its largest entry; every entry off by less than 2^-60 and one rounding.
Eigen::Vector3d rounded_direction(const IntegerVector<3>& n) {
  unsigned bits = 0;
  for (const Integer& e : n)
    if (!e.is_zero()) bits = std::max(bits, static_cast<unsigned>(msb(abs(e))) + 1);
  Eigen::Vector3d r;
  for (int k = 0; k < 3; ++k) {
    const Integer top = bits > 62 ? Integer(abs(n[k]) >> (bits - 62)) : Integer(abs(n[k]) << (62 - bits));
    const double size = std::ldexp(static_cast<double>(static_cast<std::int64_t>(top)), -62);
    r(k) = n[k].sign() < 0 ? -size : size;
  }
  return r;
}

/// The points that may have the least sign * n.x: those within the rounding of the least found.
template <int kSign, typename Consider>
void candidates(const HullScene& scene, const std::vector<Eigen::Vector3d>& points,
                const CentredPoints& centred, const Eigen::Vector3d& n, double least,
                const Consider& consider) {
  if (!scene.usable) {
    for (std::size_t i = 0; i < points.size(); ++i) consider(i);
    return;
  }
  // The direction is rounded too: relative to its largest entry, which is at least 1/2.
  const double slack = 4 * support_slack(scene, n.cwiseAbs() + Eigen::Vector3d::Constant(0x1p-8));
  for (std::size_t i = 0; i < centred.size(); ++i)
    if (kSign * (n.x() * centred.x[i] + n.y() * centred.y[i] + n.z() * centred.z[i]) <= least + slack)
      consider(i);
}

/// Position of the origin in a hull seen through a map to the line, where it is known to be inside. Where it
/// is at an end, `supporting` has no point of the hull below it.
bool inside_interval(const HullScene& scene, const IntegerVector<3>& n, IntegerVector<3>& supporting) {
  const IntegerVector<3> minus{-n[0], -n[1], -n[2]};
  for (const IntegerVector<3>* side : {&n, &minus})
    if (exact_support(scene, *side).value >= 0) {
      supporting = *side;
      return false;
    }
  return true;
}

template <int D>
class Image {
 public:
  using Vector = IntegerVector<D>;

  Image(const HullScene& scene, const Rows<D>& rows) : scene_(scene), rows_(rows), round_(scene.ellipsoid) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) shape_[i][j] = metric_[i][j] = i == j;
    if (!round_) return;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        shape_[i][j] = 0;
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) shape_[i][j] += rows[i][r] * rows[j][c] * scene.exact_shape[r][c];
      }
    if constexpr (D == 2) {
      metric_ = {{{shape_[1][1], -shape_[0][1]}, {-shape_[1][0], shape_[0][0]}}};
    } else {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int r0 = (j + 1) % 3, r1 = (j + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
          metric_[i][j] = shape_[r0][c0] * shape_[r1][c1] - shape_[r0][c1] * shape_[r1][c0];
        }
    }
  }

  /// Ends: every step that does not answer adds a point with n.s < n.y, so that the next nearest point is
  /// strictly nearer; a nearest point is that of the affine hull of its face, and there are finitely many
  /// faces.
  OriginIn position(const std::vector<HullPair>& start, IntegerVector<3>* normal, Shown* shown) {
    shown_ = shown;
    const OriginIn answer = position(start);
    if (normal && answer == OriginIn::outside) *normal = supporting_;
    if (shown) shown->normal = supporting_;
    return answer;
  }

 private:
  OriginIn position(const std::vector<HullPair>& start) {
    for (const HullPair& p : start) add(p);
    if (points_.empty()) add({0, 0});
    for (;;) {
      reduce();
      show();
      if (is_zero<D>(nearest_)) return round_ ? OriginIn::interior : around_face();
      const IntegerVector<3> n = supporting_ = in_space(nearest_);
      const Vector& m = nearest_;
      // The nearest point's plane n.x = level; rho(n)^2 = m^T M m.
      const Integer level = dot<D>(m, points_[0].x);
      const Integer squared_radius = round_ ? quadratic(shape_, m) : Integer(0);
      if (round_ && level * level < squared_radius) return OriginIn::interior;
      const ExactSupport support = exact_support(scene_, n);
      if (support.value > 0 && support.value * support.value > squared_radius) return OriginIn::outside;
      if (support.value >= level) return OriginIn::boundary;  // level > 0 is the distance, equal to rho
      add(support.pair);
    }
  }

  struct Point {
    HullPair pair;
    Vector x;
  };

  void show() {
    if (!shown_) return;
    shown_->pairs.clear();
    for (const Point& p : points_) shown_->pairs.push_back(p.pair);
    shown_->weights = weights_;
  }

  static Integer quadratic(const IntegerMatrix<D>& s, const Vector& v) {
    Integer sum = 0;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) sum += s[i][j] * v[i] * v[j];
    return sum;
  }

  Vector times_metric(const Vector& v) const {
    Vector r;
    for (int i = 0; i < D; ++i) r[i] = dot<D>(metric_[i], v);
    return r;
  }

  IntegerVector<3> in_space(const Vector& m) const {
    IntegerVector<3> n{0, 0, 0};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < D; ++i) n[k] += m[i] * rows_[i][k];
    return n;
  }

  void add(HullPair pair) {
    const IntegerVector<3> b = scene_.exact_obstacle(pair.obstacle), a = scene_.exact_agent(pair.agent);
    const IntegerVector<3> d{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    Point p{pair, {}};
    for (int i = 0; i < D; ++i) p.x[i] = dot<3>(rows_[i], d);
    points_.push_back(std::move(p));
  }

  /// Weights, up to a common positive factor, of the point of the affine hull of `face` nearest to the
  /// origin; false where the face is degenerate or a weight is not positive.
  bool weights(const std::vector<int>& face, std::vector<Integer>& w) const {
    const auto x = [&](std::size_t i) -> const Vector& { return points_[face[i]].x; };
    const auto minus = [](const Vector& p, const Vector& q) {
      Vector r;
      for (int i = 0; i < D; ++i) r[i] = p[i] - q[i];
      return r;
    };
    const std::size_t m = face.size();
    w.clear();
    if (m == 1) {
      w = {1};
      return true;
    }
    if (m == D + 1) {
      if constexpr (D == 2) {
        w = {cross(x(1), x(2)), cross(x(2), x(0)), cross(x(0), x(1))};
      } else {
        const IntegerVector<3> cd = cross(x(2), x(3)), ab = cross(x(0), x(1));
        w = {dot<3>(x(1), cd), -dot<3>(x(0), cd), dot<3>(x(3), ab), -dot<3>(x(2), ab)};
      }
      if (w[0] < 0)
        for (Integer& e : w) e = -e;
    } else if (m == 2) {
      const Vector e = times_metric(minus(x(1), x(0)));
      w = {dot<D>(x(1), e), -dot<D>(x(0), e)};
    } else {
      const Vector e1 = minus(x(1), x(0)), e2 = minus(x(2), x(0)), q1 = times_metric(e1),
                   q2 = times_metric(e2);
      const Integer g11 = dot<D>(e1, q1), g12 = dot<D>(e1, q2), g22 = dot<D>(e2, q2), p1 = dot<D>(x(0), q1),
                    p2 = dot<D>(x(0), q2), det = g11 * g22 - g12 * g12;
      const Integer t1 = p2 * g12 - p1 * g22, t2 = p1 * g12 - p2 * g11;
      if (det.sign() <= 0) return false;
      w = {det - t1 - t2, t1, t2};
    }
    return std::all_of(w.begin(), w.end(), [](const Integer& e) { return e.sign() > 0; });
  }

  /// Keeps the face with the nearest point: the one whose weights are positive and beyond whose plane, as
  /// seen from the origin, all other points lie. One exists: the nearest point is inside some affinely
  /// independent face, and then nearest in that face's plane.
  void reduce() {
    for (unsigned mask = 1; mask < (1U << points_.size()); ++mask) {
      std::vector<int> face;
      for (std::size_t i = 0; i < points_.size(); ++i)
        if (mask >> i & 1) face.push_back(static_cast<int>(i));
      std::vector<Integer> w;
      if (face.size() > D + 1 || !weights(face, w)) continue;
      Vector y;
      for (int i = 0; i < D; ++i) {
        y[i] = 0;
        for (std::size_t f = 0; f < face.size(); ++f) y[i] += w[f] * points_[face[f]].x[i];
      }
      const Vector n = primitive<D>(round_ ? times_metric(y) : y);
      const Integer level = dot<D>(n, points_[face[0]].x);
      if (!std::all_of(points_.begin(), points_.end(),
                       [&](const Point& p) { return dot<D>(n, p.x) >= level; }))
        continue;
      std::vector<Point> kept;
      for (const int f : face) kept.push_back(std::move(points_[f]));
      points_ = std::move(kept);
      weights_ = std::move(w);
      nearest_ = n;
      return;
    }
  }

  // The origin is inside the face that is left. It is in the interior of the hull iff it is in the interior
  // of the hull's image under a map whose kernel is the span of the face: a supporting plane at the origin
  // contains the face.
  OriginIn around_face() {
    const auto answer = [](bool interior) { return interior ? OriginIn::interior : OriginIn::boundary; };
    switch (points_.size()) {
      case 1:
        return answer(around_zero());
      case 2: {
        const Vector& v = points_[0].x;
        if constexpr (D == 2) {
          return answer(inside_interval(scene_, in_space({-v[1], v[0]}), supporting_));
        } else {
          const Rows<2> rows = shadow_rows(v);
          Image<2> along(scene_, compose(rows));
          const bool interior = along.around_zero();
          supporting_ = along.supporting_;
          return answer(interior);
        }
      }
      case 3:
        if constexpr (D == 3)
          return answer(inside_interval(scene_, in_space(cross(points_[0].x, points_[1].x)), supporting_));
        return OriginIn::interior;
      default:
        return OriginIn::interior;
    }
  }

  Rows<2> compose(const Rows<2>& outer) const {
    Rows<2> r;
    for (int i = 0; i < 2; ++i) {
      Vector m;
      for (int k = 0; k < D; ++k) m[k] = outer[i][k];
      r[i] = in_space(m);
    }
    return r;
  }

 public:
  /// Whether the origin, known to be in the hull, is in its interior. Searches the hull of the points other
  /// than 0: a direction in which no point is negative supports the hull at the origin, and otherwise the
  /// point found is not 0.
  bool around_zero() {
    points_.clear();
    Vector e;
    for (int i = 0; i < D; ++i) e[i] = i == 0;
    supporting_ = in_space(e);
    const ExactSupport first = exact_support(scene_, supporting_);
    if (first.value >= 0) return false;
    add(first.pair);
    for (;;) {
      reduce();
      if (is_zero<D>(nearest_)) return around_face() == OriginIn::interior;
      supporting_ = in_space(nearest_);
      const ExactSupport support = exact_support(scene_, supporting_);
      if (support.value >= 0) return false;
      add(support.pair);
    }
  }

 private:
  template <int>
  friend class Image;
  const HullScene& scene_;
  Rows<D> rows_;
  bool round_;
  IntegerMatrix<D> shape_, metric_;  // M and adj(M) of the ellipsoid's image; the identity without one
  std::vector<Point> points_;
  std::vector<Integer> weights_;  // of the nearest point, up to a common factor
  IntegerVector<3> supporting_{0, 0, 0};
  Shown* shown_ = nullptr;
  Vector nearest_;  // metric times the nearest point of the points' hull, up to a positive factor
};

}  // namespace

ExactSupport exact_support(const HullScene& scene, const IntegerVector<3>& n) {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  HullSupport near;
  if (scene.usable) {
    direction = rounded_direction(n);
    near = least_support(scene, direction);
  }
  ExactSupport best;
  Integer least_b, most_a;
  bool first = true;
  candidates<1>(scene, scene.obstacle, scene.centred_obstacle, direction, near.obstacle_value,
                [&](std::size_t i) {
                  Integer v = dot<3>(n, scene.exact_obstacle(i));
                  if (!first && v >= least_b) return;
                  first = false;
                  least_b = std::move(v);
                  best.pair.obstacle = static_cast<std::uint32_t>(i);
                });
  first = true;
  candidates<-1>(scene, scene.agent, scene.centred_agent, direction, -near.agent_value, [&](std::size_t i) {
    Integer v = dot<3>(n, scene.exact_agent(i));
    if (!first && v <= most_a) return;
    first = false;
    most_a = std::move(v);
    best.pair.agent = static_cast<std::uint32_t>(i);
  });
  best.value = least_b - most_a;
  return best;
}

Rows<2> shadow_rows(const IntegerVector<3>& w) {
  const int k = w[0] != 0 ? 0 : w[1] != 0 ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
  Rows<2> rows{{{0, 0, 0}, {0, 0, 0}}};
  rows[0][i] = rows[1][j] = w[k];
  rows[0][k] = -w[i];
  rows[1][k] = -w[j];
  return rows;
}

template <int D>
OriginIn origin_in_image(const HullScene& scene, const Rows<D>& rows, const std::vector<HullPair>& start,
                         IntegerVector<3>* normal, Shown* shown) {
  return Image<D>(scene, rows).position(start, normal, shown);
}
template OriginIn origin_in_image<2>(const HullScene&, const Rows<2>&, const std::vector<HullPair>&,
                                     IntegerVector<3>*, Shown*);
template OriginIn origin_in_image<3>(const HullScene&, const Rows<3>&, const std::vector<HullPair>&,
                                     IntegerVector<3>*, Shown*);

Relation relation(const HullScene& scene) {
  switch (origin_in_image<3>(scene, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}, nullptr)) {
    case OriginIn::interior:
      return Relation::overlapping;
    case OriginIn::boundary:
      return Relation::touching;
    case OriginIn::outside:
      break;
  }
  return Relation::disjoint;
}

bool separates(const HullScene& scene, const IntegerVector<3>& n) {
  const ExactSupport support = exact_support(scene, n);
  if (support.value.sign() <= 0) return false;
  if (!scene.ellipsoid) return true;
  Integer squared_radius = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) squared_radius += n[i] * n[j] * scene.exact_shape[i][j];
  return support.value * support.value > squared_radius;
}

}  // namespace vericone::exact
