// SPDX-License-Identifier: BSD-3-Clause
//
// As of ellipsoids: a search in doubles proposes, integers check, and where doubles do not tell the search of
// hulls/exact.h goes on.
#include "certificate/polytopes.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "answers/stretch.h"
#include "hulls/search.h"

namespace vericone::certificates {
namespace {

using Eigen::Vector3d;

constexpr int kWeightBits[] = {60, 80, 100, 130, 180, 250, 400, 700};
constexpr std::uint32_t kEnd = 0x80000000;  // of a simplex's points: at the end of the way

Vector3d middle_of(const std::vector<Vector3d>& points) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& x : points) sum += x;
  return sum / static_cast<double>(points.size());
}

std::vector<Vector3d> points_of(const Piece& piece) {
  if (const Ellipsoid* body = piece.round()) return {body->center()};
  return piece.corners;
}

Integer floor_of(const Rational& x) {
  Integer quotient = numerator(x) / denominator(x);
  if (quotient * denominator(x) > numerator(x)) --quotient;
  return quotient;
}

Integer determinant(const Vector& x, const Vector& y, const Vector& z) { return dot(x, cross(y, z)); }

exact::Rows<3> identity() { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }

void divide_out(std::vector<Crossing::Term>& terms) {
  Integer common = 0;
  for (const auto& term : terms) common = gcd(common, term.weight);
  if (common > 1)
    for (auto& term : terms) term.weight /= common;
}

}  // namespace

/// Where the search for the point of K nearest to the way ended, in the scene's units.
struct PolytopePair::Found {
  HullSimplex<3> simplex;
  Vector3d normal = Vector3d::Zero();  // that of the widest gap
  double gap = -std::numeric_limits<double>::infinity();
  double share = 0;  // of the way

  [[nodiscard]] double size() const { return simplex.nearest.norm(); }
};

PolytopePair::PolytopePair(const Piece& a, const Vector3d& a_at, const Piece& b, const Vector3d& b_at,
                           const Vector3d& v_a, const Vector3d& v_b, const Horizon& horizon, int grid)
    : scene_(points_of(a), a_at, points_of(b), b_at, middle_of(points_of(a)) + a_at,
             a.round() ? a.round() : b.round()),
      motion_(v_a, v_b, horizon.from, horizon.until,
              grid == kProposals ? std::min({0, grid_of(v_a), grid_of(v_b)}) : grid),
      agent_(grid == kProposals ? Convex() : a.on(grid, a_at)),
      obstacle_(grid == kProposals ? Convex() : b.on(grid, b_at)),
      v_a_(v_a),
      v_b_(v_b),
      w_(v_a - v_b),
      horizon_(horizon) {}

/// Until they have passed, where the horizon has no end.
double PolytopePair::end_of_way() const {
  if (!moves()) return horizon_.from;
  if (!std::isinf(horizon_.until)) return horizon_.until;
  const double speed = w_.norm() * std::ldexp(1.0, -scene_.exponent);
  return horizon_.from + 4 * ((scene_.reach.norm() + scene_.factor.norm()) / speed + horizon_.from);
}

PolytopePair::Found PolytopePair::search(double from, double until) const {
  Found found;
  if (!scene_.usable) return found;
  const double unit = std::ldexp(1.0, -scene_.exponent);
  const Vector3d start = from * unit * w_, end = until * unit * w_;
  const Eigen::Matrix3d& g = scene_.to_ball;
  HullSimplex<3>& simplex = found.simplex;
  simplex.add(scene_.start, g * (scene_.difference(scene_.start) - start));
  double last = std::numeric_limits<double>::infinity();
  for (int step = 0; step < 100; ++step) {
    simplex.reduce();
    const double length = simplex.nearest.squaredNorm();
    if (!(length < last) || simplex.surrounds) break;
    last = length;
    Vector3d n = g.transpose() * simplex.normal;
    n /= n.cwiseAbs().maxCoeff();
    if (!n.allFinite()) break;
    const HullSupport support = least_support(scene_, n);
    const bool at_end = n.dot(w_) > 0;
    const double radius = scene_.ellipsoid ? (scene_.factor.transpose() * n).norm() : 0;
    const double gap = (support.value() - n.dot(at_end ? end : start) - radius) / n.norm();
    if (gap > found.gap) found.gap = gap, found.normal = n;
    const Vector3d image = g * (scene_.difference(support.pair) - (at_end ? end : start));
    const double gain = simplex.normal.dot(simplex.z[0] - image);
    if (!(gain > 1e-15 * simplex.normal.norm() * simplex.z[0].norm())) break;
    simplex.add({support.pair.obstacle, support.pair.agent | (at_end ? kEnd : 0)}, image);
  }
  double share = 0;
  for (int i = 0; i < simplex.count; ++i)
    if (simplex.pair[i].agent & kEnd) share += simplex.weight[i];
  double sum = 0;
  for (int i = 0; i < simplex.count; ++i) sum += simplex.weight[i];
  found.share = sum > 0 ? share / sum : 0;
  if (simplex.surrounds) found.gap = -1;
  return found;
}

Dyadic PolytopePair::nearest(double time, int beat) const {
  const double whole = std::nearbyint(std::ldexp(time, -beat));
  const Dyadic rounded = Dyadic::of(std::abs(whole) < 0x1p52 ? std::ldexp(whole, beat) : time);
  if (exact::compare(rounded, motion_.from) < 0) return motion_.from;
  if (motion_.until && exact::compare(rounded, *motion_.until) > 0) return *motion_.until;
  return rounded;
}

int PolytopePair::least_bits(double left) const {
  return std::clamp(-log2_of(left / (scene_.reach.norm() + scene_.factor.norm())) / 2, 1, 40);
}

/// Largest entry of n, or of what it is of the axes across w, about 2^bits.
Plane PolytopePair::rounded_plane(Vector3d n, int bits, bool across) const {
  const int k = largest_entry(motion_.w), i = (k + 1) % 3, j = (k + 2) % 3;
  if (across) n = Vector3d(n(i) / w_(k), n(j) / w_(k), 0);
  n /= n.cwiseAbs().maxCoeff();
  if (!n.allFinite()) return {};
  Vector whole;
  for (int e = 0; e < 3; ++e)
    whole[e] = Integer(static_cast<std::int64_t>(std::nearbyint(std::ldexp(n(e), bits))));
  const Integer common = std::max(Integer(1), Integer(gcd(gcd(whole[0], whole[1]), whole[2])));
  for (Integer& e : whole) e /= common;
  return across ? plane_across(motion_.w, k, whole[0], whole[1]) : Plane{whole};
}

std::optional<Plane> PolytopePair::short_plane(const Vector3d& n, double left, bool across) const {
  for (int bits = least_bits(left); bits <= 52; bits += bits < 20 ? 2 : 5) {
    Plane plane = rounded_plane(n, bits, across);
    if (!is_zero(plane.normal) && separates(agent_, obstacle_, motion_, plane.normal)) return plane;
  }
  return std::nullopt;
}

std::vector<Plane> PolytopePair::proposals() const {
  const Found found = search(horizon_.from, end_of_way());
  std::vector<Plane> planes;
  if (!(found.gap > 0)) return planes;
  const bool within = moves() && found.share > 1e-12 && found.share < 1 - 1e-12;
  const int least = least_bits(found.gap);
  for (const bool across : {true, false})
    for (const int bits : {least + 2, least + 8, 40})
      if (within || !across) planes.push_back(rounded_plane(found.normal, bits, across));
  std::erase_if(planes, [](const Plane& plane) { return is_zero(plane.normal); });
  return planes;
}

/// A normal of few digits near an exact one, or that.
std::optional<Plane> PolytopePair::shortened(const Vector& n) const {
  const bool across = moves() && dot(n, motion_.w).is_zero();
  const int k = largest_entry(motion_.w), i = (k + 1) % 3, j = (k + 2) % 3;
  int size = 0;
  for (const Integer& e : n)
    if (!e.is_zero()) size = std::max(size, exact::log2_floor(e));
  const auto cut = [](const Integer& x, int by) {
    const Integer top = abs(x) >> static_cast<unsigned>(std::max(0, by));
    return x.sign() < 0 ? Integer(-top) : top;
  };
  for (int bits = 16; bits < 2 * size + 16; bits *= 2) {
    const int by = size - bits;
    Plane plane{{cut(n[0], by), cut(n[1], by), cut(n[2], by)}};
    if (across) {
      const bool back = motion_.w[k].sign() < 0;
      const Integer a = back ? Integer(-plane.normal[i]) : plane.normal[i],
                    b = back ? Integer(-plane.normal[j]) : plane.normal[j];
      plane = plane_across(motion_.w, k, a, b);
    }
    if (!is_zero(plane.normal) && separates(agent_, obstacle_, motion_, plane.normal)) return plane;
  }
  return std::nullopt;
}

std::optional<Plane> PolytopePair::exact_plane() const {
  Vector n{0, 0, 0};
  if (moves() &&
      exact::origin_in_image<2>(scene_, exact::shadow_rows(motion_.w), {}, &n) == exact::OriginIn::outside)
    if (auto plane = shortened(primitive(n))) return plane;
  if (!moves()) {
    if (exact::origin_in_image<3>(scene_, identity(), {}, &n) == exact::OriginIn::outside)
      return shortened(primitive(n));
    return std::nullopt;
  }
  const HullScene way(scene_, Stretch{v_a_, v_b_, horizon_.from, horizon_.until});
  if (exact::origin_in_image<3>(way, identity(), {}, &n) == exact::OriginIn::outside)
    return shortened(primitive(n));
  return std::nullopt;
}

std::optional<Plane> PolytopePair::plane() const {
  const Found found = search(horizon_.from, end_of_way());
  if (found.gap > 0) {
    const bool within = moves() && found.share > 1e-12 && found.share < 1 - 1e-12;
    if (within)
      if (auto plane = short_plane(found.normal, found.gap, true)) return plane;
    if (auto plane = short_plane(found.normal, found.gap, false)) return plane;
  }
  return exact_plane();
}

namespace {

/// Each corner once, with the sum of its weights.
template <typename Weight>
void count(std::vector<std::pair<std::uint32_t, Weight>>& weights, std::uint32_t corner,
           const Weight& weight) {
  for (auto& [old, sum] : weights)
    if (old == corner) {
      sum += weight;
      return;
    }
  weights.emplace_back(corner, weight);
}

/// Of parts that are rounded down, the sum made right at the largest.
void sum_up(std::vector<std::pair<std::uint32_t, Integer>>& parts, unsigned bits) {
  Integer left = Integer(1) << bits;
  for (const auto& part : parts) left -= part.second;
  const auto largest = std::max_element(parts.begin(), parts.end(),
                                        [](const auto& x, const auto& y) { return x.second < y.second; });
  largest->second += left;
  std::erase_if(parts, [](const auto& part) { return part.second.is_zero(); });
}

}  // namespace

/// With parts / 2^bits.
std::optional<CornerMeeting> PolytopePair::checked(
    const std::vector<std::pair<std::uint32_t, Integer>>& parts, unsigned bits, const Dyadic& time) const {
  const bool of_agent = obstacle_.round.has_value();
  const Convex &hull = of_agent ? agent_ : obstacle_, &body = of_agent ? obstacle_ : agent_;
  const unsigned finer = bits + time.exponent;
  Vector x{0, 0, 0};
  CornerMeeting found{{time, {}, finer}, {}, of_agent};
  for (const auto& [corner, part] : parts) {
    if (part.sign() <= 0) return std::nullopt;
    x = x + part * hull.points[corner];
    found.weights.emplace_back(corner, Rational(part, Integer(1) << bits));
  }
  const auto moved = [&](const Vector& v) { return (time.numerator * v) << bits; };
  x = (x << time.exponent) + moved(of_agent ? motion_.v_a : motion_.v_b);
  const Vector from_center = x - (body.points.front() << finer) - moved(of_agent ? motion_.v_b : motion_.v_a);
  if (!body.round->holds(from_center, finer)) return std::nullopt;
  found.meeting.point = x;
  return found;
}

std::optional<CornerMeeting> PolytopePair::rounded_meeting(
    const std::vector<std::pair<std::uint32_t, double>>& weights, double time) const {
  const double size = scene_.factor.colwise().norm().minCoeff() * std::ldexp(1.0, scene_.exponent);
  const double speed = w_.cwiseAbs().maxCoeff();
  for (const unsigned bits : {2U, 5U, 9U, 14U, 20U, 28U, 38U, 52U}) {
    const int beat = speed > 0 ? log2_of(size / speed) - static_cast<int>(bits) : 0;
    std::vector<std::pair<std::uint32_t, Integer>> parts;
    for (const auto& [corner, weight] : weights)
      parts.emplace_back(corner,
                         static_cast<std::int64_t>(std::floor(std::ldexp(weight, static_cast<int>(bits)))));
    sum_up(parts, bits);
    if (auto found = checked(parts, bits, nearest(time, beat))) return found;
  }
  return std::nullopt;
}

Rational PolytopePair::time_of(exact::Shown& shown) const {
  const auto half = static_cast<std::uint32_t>(agent_.points.size());
  Integer all = 0, end = 0;
  for (std::size_t i = 0; i < shown.pairs.size(); ++i) {
    all += shown.weights[i];
    if (shown.pairs[i].agent < half) continue;
    end += shown.weights[i];
    shown.pairs[i].agent -= half;
  }
  const Rational from = to_rational(motion_.from);
  if (!motion_.until) return from;
  return from + (to_rational(*motion_.until) - from) * Rational(end, all);
}

std::optional<CornerMeeting> PolytopePair::exact_meeting(const exact::Shown& shown,
                                                         const std::optional<Rational>& at) const {
  Integer all = 0;
  Vector sum{0, 0, 0};
  for (std::size_t i = 0; i < shown.pairs.size(); ++i) {
    all += shown.weights[i];
    sum = sum + shown.weights[i] * difference(shown.pairs[i]);
  }
  Rational time;
  if (at) {
    time = *at;
  } else {  // when the point is deepest in the ellipsoid
    const Matrix inverse = adjugate(round().shape());
    const Vector across = inverse * motion_.w;
    time = Rational(dot(sum, across), all * dot(motion_.w, across));
  }
  const bool of_agent = obstacle_.round.has_value();
  for (const int bits : kWeightBits) {
    std::vector<std::pair<std::uint32_t, Integer>> parts;
    for (std::size_t i = 0; i < shown.pairs.size(); ++i) {
      const std::uint32_t corner = of_agent ? shown.pairs[i].agent : shown.pairs[i].obstacle;
      const Integer part = (shown.weights[i] << static_cast<unsigned>(bits)) / all;
      count(parts, corner, part);
    }
    sum_up(parts, static_cast<unsigned>(bits));
    Dyadic t{floor_of(time * (Integer(1) << static_cast<unsigned>(bits))), static_cast<unsigned>(bits)};
    if (exact::compare(t, motion_.from) < 0) t = motion_.from;
    if (motion_.until && exact::compare(t, *motion_.until) > 0) t = *motion_.until;
    if (auto found = checked(parts, static_cast<unsigned>(bits), t)) return found;
  }
  return std::nullopt;
}

std::optional<CornerMeeting> PolytopePair::meeting() const {
  const Found found = search(horizon_.from, end_of_way());
  const bool of_agent = obstacle_.round.has_value();
  if (found.simplex.count > 0 && found.size() < 1) {
    std::vector<std::pair<std::uint32_t, double>> weights;
    double sum = 0;
    for (int i = 0; i < found.simplex.count; ++i) sum += found.simplex.weight[i];
    for (int i = 0; i < found.simplex.count; ++i) {
      const HullPair pair = found.simplex.pair[i];
      const std::uint32_t corner = of_agent ? pair.agent & ~kEnd : pair.obstacle;
      const double weight = found.simplex.weight[i] / sum;
      count(weights, corner, weight);
    }
    if (auto meeting = rounded_meeting(weights, horizon_.from + found.share * (end_of_way() - horizon_.from)))
      return meeting;
  }
  exact::Shown shown;
  if (!moves()) {
    static_cast<void>(exact::origin_in_image<3>(scene_, identity(), {}, nullptr, &shown));
    return exact_meeting(shown, to_rational(motion_.from));
  }
  static_cast<void>(exact::origin_in_image<2>(scene_, exact::shadow_rows(motion_.w), {}, nullptr, &shown));
  if (auto meeting = exact_meeting(shown, std::nullopt)) return meeting;
  if (!motion_.until) return std::nullopt;
  const HullScene way(scene_, Stretch{v_a_, v_b_, horizon_.from, horizon_.until});
  static_cast<void>(exact::origin_in_image<3>(way, identity(), {}, nullptr, &shown));
  const Rational time = time_of(shown);
  return exact_meeting(shown, time);
}

namespace {

/// Directions all around, in space.
std::vector<Vector3d> all_around() {
  std::vector<Vector3d> directions;
  for (int code = 14; code < 27; ++code) {
    const Vector3d n(code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1);
    directions.insert(directions.end(), {n, -n});
  }
  return directions;
}

}  // namespace

/// Adds one whose difference is a new one.
void PolytopePair::add(Pairs& pairs, HullPair pair) const {
  pair.agent &= ~kEnd;
  const Vector d = difference(pair);
  for (const HullPair& old : pairs)
    if (difference(old) == d) return;
  pairs.push_back(pair);
}

/// The points of the simplex, and where the origin is on one of its faces, points on both sides of that.
PolytopePair::Pairs PolytopePair::around(const Found& found) const {
  Pairs pairs;
  const auto& s = found.simplex;
  for (int i = 0; i < s.count; ++i) add(pairs, s.pair[i]);
  if (s.surrounds) return pairs;
  const auto both = [&](const Vector3d& n) {
    add(pairs, least_support(scene_, n).pair);
    add(pairs, least_support(scene_, -n).pair);
  };
  if (s.count == 3) {
    both((s.z[1] - s.z[0]).cross(s.z[2] - s.z[0]).normalized());
  } else if (s.count == 2) {
    const Vector3d e = (s.z[1] - s.z[0]).normalized(), p = e.unitOrthogonal();
    both(p);
    both(e.cross(p));
  } else {
    for (int k = 0; k < 3; ++k) both(Vector3d::Unit(k));
  }
  return pairs;
}

/// Pairs whose differences, seen along w, lie around the origin.
PolytopePair::Pairs PolytopePair::around_line(bool widely) const {
  const Vector3d along = w_.normalized(), p = along.unitOrthogonal();
  Eigen::Matrix<double, 2, 3> g;
  g.row(0) = p.transpose();
  g.row(1) = along.cross(p).transpose();
  HullSimplex<2> simplex;
  search_hull<2>(
      scene_, g, simplex, [](const auto&) { return false; },
      [](const auto&, const Vector3d&, const HullSupport&) { return false; });
  Pairs pairs;
  for (int i = 0; i < simplex.count; ++i) add(pairs, simplex.pair[i]);
  const auto support = [&](const Eigen::Vector2d& n) {
    add(pairs, least_support(scene_, g.transpose() * n).pair);
  };
  if (simplex.count == 2) {
    const Eigen::Vector2d e = (simplex.z[1] - simplex.z[0]).normalized(), n(-e.y(), e.x());
    support(n);
    support(-n);
  }
  constexpr int kDirections = 16;
  for (int i = 0; widely && i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    support({std::cos(angle), std::sin(angle)});
  }
  return pairs;
}

/// Of pairs whose differences have a multiple of w in the interior of their cone.
std::optional<Crossing> PolytopePair::crossing_along(const Pairs& pairs) const {
  std::vector<Vector> d;
  Vector all{0, 0, 0};
  for (const HullPair& pair : pairs) {
    d.push_back(difference(pair));
    all = all + d.back();
  }
  const Vector& w = motion_.w;
  const auto within = [&](Crossing crossing) -> std::optional<Crossing> {
    if (crossing.time <= to_rational(motion_.from)) return std::nullopt;
    if (motion_.until && crossing.time >= to_rational(*motion_.until)) return std::nullopt;
    divide_out(crossing.terms);
    return crossing;
  };
  const std::size_t m = d.size();
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i + 1; j < m; ++j)
      for (std::size_t k = j + 1; k < m; ++k) {
        Integer whole = determinant(d[i], d[j], d[k]);
        if (whole.is_zero()) continue;
        const auto solve = [&](const Vector& r) {
          Vector s{determinant(r, d[j], d[k]), determinant(d[i], r, d[k]), determinant(d[i], d[j], r)};
          if (whole.sign() < 0)
            for (Integer& e : s) e = -e;
          return s;
        };
        const Vector of_w = solve(w);
        if (of_w[0].sign() > 0 && of_w[1].sign() > 0 && of_w[2].sign() > 0) {
          const Integer sum = of_w[0] + of_w[1] + of_w[2];
          if (auto found = within({Rational(abs(whole), sum),
                                   {{pairs[i], of_w[0]}, {pairs[j], of_w[1]}, {pairs[k], of_w[2]}}}))
            return found;
          continue;
        }
        // tau w - (sum of all) as a sum of the three with weights >= 0; then all count at least one.
        const Vector of_all = solve(all);
        Rational low = 0, high = -1;
        bool possible = true;
        for (int e = 0; e < 3; ++e) {
          if (of_w[e].is_zero()) {
            possible = possible && of_all[e].sign() <= 0;
          } else {
            const Rational bound =
                of_w[e].sign() > 0 ? Rational(of_all[e], of_w[e]) : Rational(-of_all[e], -of_w[e]);
            if (of_w[e].sign() > 0)
              low = std::max(low, bound);
            else
              high = high.sign() < 0 ? bound : std::min(high, bound);
            possible = possible && (of_w[e].sign() > 0 || bound.sign() > 0);
          }
        }
        if (!possible || (high.sign() >= 0 && high < low)) continue;
        const Rational tau = low.sign() > 0 ? low : high.sign() > 0 ? high : Rational(1);
        const Integer above = numerator(tau), below = denominator(tau), unit = abs(whole) * below;
        Crossing crossing;
        Integer sum = 0;
        for (std::size_t e = 0; e < m; ++e) {
          Integer weight = unit;
          const int place = e == i ? 0 : e == j ? 1 : e == k ? 2 : -1;
          if (place >= 0) weight += above * of_w[place] - below * of_all[place];
          sum += weight;
          crossing.terms.push_back({pairs[e], weight});
        }
        crossing.time = Rational(above * abs(whole), sum);
        if (auto found = within(std::move(crossing))) return found;
      }
  return std::nullopt;
}

/// Of pairs whose differences have the place at a time in their interior.
std::optional<Crossing> PolytopePair::crossing_at(const Pairs& pairs, const Dyadic& time) const {
  std::vector<Vector> d;
  Vector all{0, 0, 0};
  for (const HullPair& pair : pairs) {
    d.push_back((difference(pair) << time.exponent) - time.numerator * motion_.w);
    all = all + d.back();
  }
  const std::size_t m = d.size();
  const auto spans = [&] {
    for (std::size_t i = 1; i < m; ++i)
      for (std::size_t j = i + 1; j < m; ++j)
        for (std::size_t k = j + 1; k < m; ++k)
          if (!determinant(d[i] - d[0], d[j] - d[0], d[k] - d[0]).is_zero()) return true;
    return false;
  };
  if (m < 4 || !spans()) return std::nullopt;
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = i + 1; j < m; ++j)
      for (std::size_t k = j + 1; k < m; ++k) {
        const Integer whole = determinant(d[i], d[j], d[k]);
        if (whole.is_zero()) continue;
        Vector s{-determinant(all, d[j], d[k]), -determinant(d[i], all, d[k]), -determinant(d[i], d[j], all)};
        if (whole.sign() < 0)
          for (Integer& e : s) e = -e;
        if (s[0].sign() < 0 || s[1].sign() < 0 || s[2].sign() < 0) continue;
        Crossing crossing{to_rational(time), {}};
        for (std::size_t e = 0; e < m; ++e) {
          const int place = e == i ? 0 : e == j ? 1 : e == k ? 2 : -1;
          crossing.terms.push_back({pairs[e], place < 0 ? abs(whole) : Integer(abs(whole) + s[place])});
        }
        divide_out(crossing.terms);
        return crossing;
      }
  return std::nullopt;
}

std::optional<Crossing> PolytopePair::crossing() const {
  if (!scene_.usable) return std::nullopt;
  const bool open = moves() && horizon_.from < horizon_.until;
  // The second time for bodies that lie so that rounding misleads the search.
  for (const bool widely : {false, true}) {
    if (open)
      if (auto found = crossing_along(around_line(widely))) return found;
    const Found found = search(horizon_.from, end_of_way());
    const double speed = w_.norm() * std::ldexp(1.0, -scene_.exponent), size = scene_.reach.norm();
    const double time = horizon_.from + found.share * (end_of_way() - horizon_.from);
    for (const double aside : {0.0, 0.1, -0.1, 0.37, -0.37}) {
      const Dyadic at =
          moves() ? nearest(time + aside * size / speed, log2_of(size / speed) - 20) : motion_.from;
      const double t = to_double(at);
      Pairs pairs = around(search(t, t));
      if (widely)
        for (const Vector3d& n : all_around()) add(pairs, least_support(scene_, n).pair);
      if (auto crossing = crossing_at(pairs, at)) return crossing;
      if (!moves()) break;
    }
  }
  return std::nullopt;
}

std::optional<CornerTouch> PolytopePair::touch_of(const exact::Shown& shown,
                                                  const std::optional<Rational>& at) const {
  const Vector n = primitive(shown.normal);
  if (is_zero(n)) return std::nullopt;
  Integer all = 0;
  Vector sum{0, 0, 0};
  for (std::size_t i = 0; i < shown.pairs.size(); ++i) {
    all += shown.weights[i];
    sum = sum + shown.weights[i] * difference(shown.pairs[i]);
  }
  const Integer along = dot(n, motion_.w);
  std::array<Rational, 3> offset;  // of the points, less the way
  for (int k = 0; k < 3; ++k) offset[k] = Rational(sum[k], all);
  Rational time = at.value_or(0), radius = 0;
  if (has_round()) {
    radius = Rational(dot(n, sum), all) - time * along;
    if (radius.sign() <= 0 || radius * radius != round().square(n)) return std::nullopt;
    const Vector image = round().shape() * n;
    for (int k = 0; k < 3; ++k) offset[k] -= image[k] / radius;
  }
  if (!at) {
    if (!along.is_zero()) return std::nullopt;
    const int k = largest_entry(motion_.w);
    time = offset[k] / motion_.w[k];
  }
  const Rational from = to_rational(motion_.from);
  if (time < from || (motion_.until && time > to_rational(*motion_.until))) return std::nullopt;
  for (int k = 0; k < 3; ++k)
    if (offset[k] != time * motion_.w[k]) return std::nullopt;
  // A supporting plane, with the bodies on their sides of it while they may meet.
  const Vector back{-n[0], -n[1], -n[2]};
  if (Rational(-obstacle_.support(back) - agent_.support(n)) - time * along != radius) return std::nullopt;
  if (along.sign() > 0 && !(motion_.until && time == to_rational(*motion_.until))) return std::nullopt;
  if (along.sign() < 0 && time != from) return std::nullopt;
  CornerTouch found{{n, radius, radius, time, {0, 0, 0}}, {}, {}};
  const auto weigh = [&](Weights& weights, bool of_agent) {
    for (std::size_t i = 0; i < shown.pairs.size(); ++i) {
      const std::uint32_t corner = of_agent ? shown.pairs[i].agent : shown.pairs[i].obstacle;
      const Rational weight(shown.weights[i], all);
      count(weights, corner, weight);
    }
  };
  if (!agent_.round) weigh(found.agent, true);
  if (!obstacle_.round) weigh(found.obstacle, false);
  const bool of_agent = !agent_.round;
  for (const auto& [corner, weight] : of_agent ? found.agent : found.obstacle)
    for (int k = 0; k < 3; ++k)
      found.touch.point[k] += weight * (of_agent ? agent_ : obstacle_).points[corner][k];
  for (int k = 0; k < 3; ++k) found.touch.point[k] += time * (of_agent ? motion_.v_a : motion_.v_b)[k];
  return found;
}

std::optional<CornerTouch> PolytopePair::touch() const {
  exact::Shown shown;
  if (!moves()) {
    static_cast<void>(exact::origin_in_image<3>(scene_, identity(), {}, nullptr, &shown));
    return touch_of(shown, to_rational(motion_.from));
  }
  static_cast<void>(exact::origin_in_image<2>(scene_, exact::shadow_rows(motion_.w), {}, nullptr, &shown));
  if (auto touch = touch_of(shown, std::nullopt)) return touch;
  const auto on_way = [&](double from, double until) -> std::optional<CornerTouch> {
    const HullScene way(scene_, Stretch{v_a_, v_b_, from, until});
    exact::Shown on;
    static_cast<void>(exact::origin_in_image<3>(way, identity(), {}, nullptr, &on));
    if (from == until) {
      static_cast<void>(time_of(on));
      return touch_of(on, to_rational(Dyadic::of(from)));
    }
    const Rational time = time_of(on);
    return touch_of(on, time);
  };
  if (!std::isinf(horizon_.until))
    if (auto touch = on_way(horizon_.from, horizon_.until)) return touch;
  if (auto touch = on_way(horizon_.from, horizon_.from)) return touch;
  return std::isinf(horizon_.until) ? std::nullopt : on_way(horizon_.until, horizon_.until);
}

}  // namespace vericone::certificates
