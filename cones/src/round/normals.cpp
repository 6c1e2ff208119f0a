// SPDX-License-Identifier: BSD-3-Clause
#include "round/normals.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace vericone::round {
namespace {

using Vector = IntegerVector<3>;

Vector times(const IntegerMatrix<3>& s, const Vector& n) {
  return {inner(s[0], n), inner(s[1], n), inner(s[2], n)};
}

Vector cross(const Vector& x, const Vector& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

Integer floor_of(const Integer& x, const Integer& y) {  // floor(x / y), y > 0
  Integer r = x / y;
  return r * y > x ? Integer(r - 1) : r;
}

/// 2^bits times n.p + sqrt(n'Sn), about.
Integer support_of(const LatticePiece& piece, const Vector& n, unsigned bits) {
  Integer r = inner(n, piece.p) << bits;
  if (piece.round) r += floor_root(inner(n, times(piece.shape, n)) << (2 * bits));
  return r;
}

const LatticePiece& farthest(const std::vector<LatticePiece>& pieces, const Vector& n) {
  const LatticePiece* best = &pieces[0];
  Integer most = support_of(pieces[0], n, 8);
  for (std::size_t i = 1; i < pieces.size(); ++i)
    if (Integer value = support_of(pieces[i], n, 8); value > most) {
      most = std::move(value);
      best = &pieces[i];
    }
  return *best;
}

/// 2^bits times a point of K that is farthest along n, each coordinate up to 3 too small.
Vector point_along(const LatticeDifference& k, const Vector& n, unsigned bits) {
  Vector x{0, 0, 0};
  const auto add = [&](const Vector& along, const Integer& square) {
    if (square == 0) return;  // flat there: its centre will do
    // along / sqrt(square), rounded once down and with a root of many digits.
    const auto digits = bits + 64;
    const Integer root = floor_root(square << (2 * digits));
    for (int i = 0; i < 3; ++i) x[i] += floor_of(along[i] << (bits + digits), root);
  };
  for (const auto* pieces : {&k.obstacle, &k.agent}) {
    const LatticePiece& piece = farthest(*pieces, n);
    for (int i = 0; i < 3; ++i) x[i] += piece.p[i] << bits;
    if (!piece.round) continue;
    const Vector along = times(piece.shape, n);
    add(along, inner(n, along));
  }
  if (k.squared_margin > 0) {
    Vector along = n;
    for (Integer& e : along) e *= k.squared_margin;
    add(along, inner(n, along));
  }
  return x;
}

/// A triangle of directions n = a + s (b - a) + t (c - a), and the part of it that is left: a convex polygon
/// of points (s, t), in units of 2^-digits.
class Part {
 public:
  using Point = std::array<Integer, 2>;

  Part(const Vector& a, const Vector& b, const Vector& c, unsigned digits)
      : a_(a), b_(minus(b, a)), c_(minus(c, a)), digits_(digits) {
    // A little larger than the triangle, so that parts overlap.
    const Integer one = Integer(1) << digits, more = Integer(1) << kMoreBits;
    corners_ = {{-more, -more}, {one + 2 * more, -more}, {-more, one + 2 * more}};
  }

  [[nodiscard]] bool empty() const { return corners_.empty(); }

  [[nodiscard]] Vector direction(const Point& p) const {
    Vector n;
    for (int i = 0; i < 3; ++i) n[i] = (a_[i] << digits_) + p[0] * b_[i] + p[1] * c_[i];
    return n;
  }

  /// Twice the area, in units of 2^(-2 digits).
  [[nodiscard]] Integer area() const {
    Integer sum = 0;
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i) sum += triangle(i);
    return sum;
  }

  [[nodiscard]] Vector center() const {
    if (corners_.size() < 3) return direction(corners_[0]);
    Point sum{0, 0};
    Integer weights = 0;
    for (std::size_t i = 1; i + 1 < corners_.size(); ++i) {
      const Integer weight = triangle(i) + 1;
      weights += 3 * weight;
      for (int c = 0; c < 2; ++c) sum[c] += weight * (corners_[0][c] + corners_[i][c] + corners_[i + 1][c]);
    }
    return direction({floor_of(sum[0], weights), floor_of(sum[1], weights)});
  }

  /// Keeps all directions with n.x <= 0, for any x that differs from the given one by at most 4 in each
  /// coordinate; whether any was cut off.
  bool cut(const Vector& x) {
    const std::array<Integer, 3> value{inner(a_, x), inner(b_, x), inner(c_, x)};
    // What was rounded in x, and the corners of 2^18 cuts.
    Integer slack = 0;
    for (int i = 0; i < 3; ++i) slack += 5 * (abs(a_[i]) + 2 * abs(b_[i]) + 2 * abs(c_[i]));
    slack <<= digits_;
    for (const Integer& v : value) slack += abs(v) << kSlackBits;
    std::vector<Integer> beyond;
    for (const Point& p : corners_)
      beyond.push_back((value[0] << digits_) + p[0] * value[1] + p[1] * value[2] - slack);
    std::vector<Point> kept;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const std::size_t j = (i + 1) % corners_.size();
      if (beyond[i] <= 0) kept.push_back(corners_[i]);
      if ((beyond[i] <= 0) != (beyond[j] <= 0) && beyond[i] != 0 && beyond[j] != 0) {
        const Integer by = abs(beyond[i]) + abs(beyond[j]);
        Point p;
        for (int c = 0; c < 2; ++c)
          p[c] = floor_of(corners_[i][c] * abs(beyond[j]) + corners_[j][c] * abs(beyond[i]), by);
        if (kept.empty() || kept.back() != p) kept.push_back(std::move(p));
      }
    }
    corners_ = std::move(kept);
    return std::any_of(beyond.begin(), beyond.end(), [](const Integer& e) { return e > 0; });
  }

  [[nodiscard]] const std::vector<Point>& corners() const { return corners_; }

  /// The two that are farthest from each other.
  [[nodiscard]] std::pair<Point, Point> ends() const {
    std::pair<Point, Point> best{corners_[0], corners_[0]};
    Integer most = -1;
    for (std::size_t i = 0; i < corners_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Integer d0 = corners_[i][0] - corners_[j][0], d1 = corners_[i][1] - corners_[j][1];
        if (Integer d = d0 * d0 + d1 * d1; d > most) {
          most = std::move(d);
          best = {corners_[i], corners_[j]};
        }
      }
    return best;
  }

 private:
  static constexpr unsigned kSlackBits = 20, kMoreBits = 24;

  static Vector minus(const Vector& x, const Vector& y) { return {x[0] - y[0], x[1] - y[1], x[2] - y[2]}; }

  [[nodiscard]] Integer triangle(std::size_t i) const {
    const Point &o = corners_[0], &p = corners_[i], &q = corners_[i + 1];
    return abs(Integer((p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0])));
  }

  Vector a_, b_, c_;
  unsigned digits_;
  std::vector<Point> corners_;
};

bool less(const Ratio& x, const Ratio& y) {
  return x.numerator * y.denominator < y.numerator * x.denominator;
}

/// The simplest direction whose coordinates, relative to the largest one, are between those of the given
/// ones.
Vector simplest_direction(std::vector<Vector> between) {
  int k = 0;
  for (int i = 1; i < 3; ++i)
    if (abs(between[0][i]) > abs(between[0][k])) k = i;
  const int sign = between[0][k].sign();
  Vector n{0, 0, 0};
  if (sign == 0) return n;
  for (Vector& v : between) {
    if (v[k].sign() != sign) return n;
    for (Integer& x : v) x *= sign;
  }
  std::array<Ratio, 3> ratio;
  Integer common = 1;
  for (int i = 0; i < 3; ++i) {
    if (i == k) continue;
    Ratio lo{between[0][i], between[0][k]}, hi = lo;
    for (const Vector& v : between) {
      const Ratio r{v[i], v[k]};
      if (less(r, lo)) lo = r;
      if (less(hi, r)) hi = r;
    }
    ratio[i] = simplest_between(lo, hi);
    common = lcm(common, ratio[i].denominator);
  }
  for (int i = 0; i < 3; ++i)
    n[i] = sign * (i == k ? common : Integer(ratio[i].numerator * (common / ratio[i].denominator)));
  return n;
}

unsigned bits_of(const Integer& x) { return x == 0 ? 0 : static_cast<unsigned>(msb(Integer(abs(x)))) + 1; }

unsigned size_bits(const LatticeDifference& k) {
  unsigned bits = bits_of(k.squared_margin) / 2;
  for (const auto* pieces : {&k.obstacle, &k.agent})
    for (const LatticePiece& piece : *pieces)
      for (int i = 0; i < 3; ++i)
        bits = std::max({bits, bits_of(piece.p[i]), bits_of(piece.shape[i][i]) / 2});
  return bits;
}

/// The normals that may have h_K <= 0.
class NormalSearch {
 public:
  NormalSearch(const LatticeDifference& k, unsigned digits)
      : k_(k), digits_(digits), point_bits_(digits + 8 - std::min(digits, size_bits(k))) {
    const Vector a{611, -379, -233}, b{-449, 521, -197}, c{-101, -307, 733};
    const Vector d{-61, 165, -303};  // with the others it spans all directions positively
    for (const auto& [x, y, z] : {std::tuple{a, b, c}, {a, b, d}, {b, c, d}, {a, c, d}})
      parts_.emplace_back(x, y, z, digits);
  }

  Place place() {
    for (unsigned step = 1; step < 6 * digits_; ++step) {
      const auto largest = std::max_element(parts_.begin(), parts_.end(),
                                            [](const Part& x, const Part& y) { return x.area() < y.area(); });
      const Vector n = largest->center();
      if (decides(n)) return place_;
      if (step % 24 == 0 && touches_in(*largest)) return place_;
      const Vector x = point_along(k_, n, point_bits_);
      bool smaller = false;
      for (Part& part : parts_) smaller |= part.cut(x);
      std::erase_if(parts_, [](const Part& part) { return part.empty(); });
      if (parts_.empty()) return {Relation::overlapping, {}};
      if (!smaller) break;  // no digits left
    }
    for (const Part& part : parts_)
      if (touches_in(part)) return place_;
    return {};
  }

 private:
  bool decides(const Vector& n) {
    if (n[0] == 0 && n[1] == 0 && n[2] == 0) return false;
    const int s = support_sign(k_, n);
    if (s > 0 || (s == 0 && !origin_in_face(k_, n))) return false;
    place_ = {s < 0 ? Relation::disjoint : Relation::touching, n};
    return true;
  }

  bool touches_in(const Part& part) { return decides(single(part)) || decides(in_sliver(part)); }

  static Vector single(const Part& part) {
    std::vector<Vector> corners;
    for (const auto& p : part.corners()) corners.push_back(part.direction(p));
    return simplest_direction(std::move(corners));
  }

  /// Where an edge of K passes through the origin the normals are an arc, orthogonal to the edge.
  [[nodiscard]] Vector in_sliver(const Part& part) const {
    const auto [p, q] = part.ends();
    const Vector from = part.direction(p), to = part.direction(q), exact_edge = cross(from, to);
    // With half of the digits.
    std::vector<Vector> around(2, exact_edge);
    Integer largest = 0;
    for (const Integer& x : exact_edge) largest = std::max(largest, Integer(abs(x)));
    for (int i = 0; i < 3; ++i) {
      const bool is_largest = abs(exact_edge[i]) == largest;  // others are relative to it
      const Integer wide = is_largest ? Integer(0) : largest;
      around[0][i] = (exact_edge[i] << (digits_ / 3)) - wide;
      around[1][i] = (exact_edge[i] << (digits_ / 3)) + wide;
    }
    const Vector edge = simplest_direction(std::move(around));
    Vector across = cross(part.center(), edge);
    unsigned bits = 0;
    for (const Integer& x : across) bits = std::max(bits, bits_of(x));
    for (Integer& x : across) x = floor_of(x, Integer(1) << (bits - std::min(bits, 24U)));
    return cross(edge, across);
  }

  const LatticeDifference& k_;
  unsigned digits_, point_bits_;
  std::vector<Part> parts_;
  Place place_;
};

}  // namespace

Ratio simplest_between(const Ratio& lo, const Ratio& hi) {
  const Integer floor_lo = floor_of(lo.numerator, lo.denominator);
  if (floor_lo * lo.denominator == lo.numerator) return {floor_lo, 1};
  if ((floor_lo + 1) * hi.denominator <= hi.numerator) {
    // Whole numbers between: the one nearest to 0.
    if (floor_lo + 1 > 0) return {floor_lo + 1, 1};
    const Integer last = floor_of(hi.numerator, hi.denominator);
    return {last < 0 ? last : Integer(0), 1};
  }
  const Ratio rest = simplest_between({hi.denominator, hi.numerator - floor_lo * hi.denominator},
                                      {lo.denominator, lo.numerator - floor_lo * lo.denominator});
  return {floor_lo * rest.numerator + rest.denominator, rest.numerator};
}

bool origin_in_face(const LatticeDifference& k, const Vector& n) {
  // All roots of pieces that are farthest along n are whole, since their sum with whole numbers is 0.
  struct Farthest {
    const LatticePiece* piece;
    Vector along;  // S n
    Integer root;
  };
  const auto farthest_of = [&](const std::vector<LatticePiece>& pieces) {
    std::vector<Farthest> found;
    std::optional<Integer> most;
    for (const LatticePiece& piece : pieces) {
      Farthest f{&piece, times(piece.shape, n), 0};
      const auto root = whole_root(inner(n, f.along));
      if (!root) continue;
      f.root = *root;
      const Integer value = inner(n, piece.p) + f.root;
      if (most && value < *most) continue;
      if (!most || value > *most) found.clear();
      most = value;
      found.push_back(std::move(f));
    }
    return found;
  };
  const std::vector<Farthest> obstacle = farthest_of(k.obstacle), agent = farthest_of(k.agent);
  const Integer margin_root = floor_root(k.squared_margin * inner(n, n));
  Integer unit = margin_root == 0 ? Integer(1) : margin_root;
  for (const auto* found : {&obstacle, &agent})
    for (const Farthest& f : *found)
      if (f.root != 0) unit = lcm(unit, f.root);
  LatticeDifference face;
  const auto add = [&](const std::vector<Farthest>& found, std::vector<LatticePiece>& pieces) {
    for (const Farthest& f : found) {
      LatticePiece piece;
      for (int i = 0; i < 3; ++i) {
        piece.p[i] = f.piece->p[i] * unit;
        if (f.root != 0) piece.p[i] += f.along[i] * (unit / f.root);
        for (int j = 0; j < 3; ++j)
          piece.shape[i][j] = f.root == 0 ? Integer(f.piece->shape[i][j] * unit * unit) : Integer(0);
      }
      piece.round = f.root == 0 && f.piece->round;
      pieces.push_back(std::move(piece));
    }
  };
  add(obstacle, face.obstacle);
  add(agent, face.agent);
  if (margin_root != 0)
    for (LatticePiece& piece : face.obstacle)
      for (int i = 0; i < 3; ++i) piece.p[i] += k.squared_margin * n[i] * (unit / margin_root);
  const Plane plane(n);
  return least_support_sign(face, plane.u, plane.v) >= 0;
}

Place place_of_origin(const LatticeDifference& k) {
  for (const unsigned digits : {256U, 1024U})
    if (Place place = NormalSearch(k, digits).place(); place.relation) return place;
  return {};
}

}  // namespace vericone::round
