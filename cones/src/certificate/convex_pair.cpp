// SPDX-License-Identifier: BSD-3-Clause
//
// A search in doubles proposes, fractions check. Where the bodies meet, both are shrunk about a point amid
// them until they only touch: what they touch at is then deep in both, and stays there when it is rounded.
#include "certificate/convex_pair.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "hulls/search.h"

namespace vericone::certificates {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSimple = 0;                                 // in place of binary digits: the simplest fraction
constexpr int kDigits[] = {3, 6, 10, 14, 20, 28, 38, 50};  // binary, of what is rounded

/// The part of a hull that is farthest along n, and the point of it, about the hull's place.
struct FarthestPart {
  std::uint32_t part = 0;
  double value = -std::numeric_limits<double>::infinity();
  Vector3d point = Vector3d::Zero();
};
FarthestPart farthest_part(const RoundedHull& hull, const Vector3d& n) {
  FarthestPart best;
  for (std::uint32_t i = 0; i < hull.parts.size(); ++i) {
    const RoundPart& part = hull.parts[i];
    const double round = (part.factor.transpose() * n).norm();
    const Vector3d middle = part.middle();
    const double value = n.dot(middle) + round + part.margin * n.norm();
    if (!(value > best.value)) continue;
    best = {i, value, middle};
    if (round > 0) best.point += part.factor * (part.factor.transpose() * n) / round;
    if (part.margin > 0) best.point += n * (part.margin / n.norm());
  }
  return best;
}

double size_about(const RoundedHull& hull, const Vector3d& middle) {
  double most = 0;
  for (const RoundPart& part : hull.parts)
    most = std::max(most, (part.middle() - middle).norm() + part.factor.norm() + part.margin);
  return most;
}

/// The multiple of 2^-bits of 2^(exponent of size) that is nearest to x.
Rational nearest_multiple(double x, double size, int bits) {
  const int unit = log2_of(size) - bits;
  return Rational(std::ldexp(std::nearbyint(std::ldexp(x, -unit)), unit));
}

/// Of x >= 0, the fraction of the least denominator within `off` of it.
Rational simplest(double x, double off) {
  Integer above = 1, below = 0, above_before = 0, below_before = 1;
  double rest = x;
  for (int step = 0; step < 30; ++step) {
    const Integer whole(std::floor(rest));
    const Integer above_next = whole * above + above_before, below_next = whole * below + below_before;
    above_before = above, below_before = below, above = above_next, below = below_next;
    const double value = static_cast<double>(Rational(above, below));
    const double left = rest - std::floor(rest);
    if (std::abs(value - x) <= off || left < 1e-12) break;
    rest = 1 / left;
  }
  return Rational(above, below);
}

/// Nearly x, which is about as large as `size`: of some digits, or a simple fraction.
Rational nearly(double x, double size, int bits) {
  if (bits != kSimple) return nearest_multiple(x, size, bits);
  return (x < 0 ? -1 : 1) * simplest(std::abs(x) < 1e-9 * size ? 0 : std::abs(x), 1e-9 * size);
}

/// The multiple of a power of two at most `slack` that is at or next above x.
Rational up_to(const Rational& x, const Rational& slack) {
  const int unit = static_cast<int>(msb(numerator(slack))) - static_cast<int>(msb(denominator(slack))) - 1;
  const Integer scale = Integer(1) << static_cast<unsigned>(std::abs(unit));
  const Rational scaled = unit >= 0 ? Rational(x / Rational(scale)) : Rational(x * Rational(scale));
  Integer whole = numerator(scaled) / denominator(scaled);
  if (Rational(whole) < scaled) ++whole;
  return unit >= 0 ? Rational(Integer(whole * scale)) : Rational(whole, scale);
}

Vector backwards(const Vector& n) { return {-n[0], -n[1], -n[2]}; }

}  // namespace

/// A point of the difference, and where it comes from.
struct ConvexPair::Tried {
  Vector3d n;
  std::uint32_t agent, obstacle;
  bool at_end;
};

struct ConvexPair::Found {
  HullSimplex<3> simplex;
  std::vector<Tried> tried;
  Vector3d normal = Vector3d::Zero();  // that of the widest gap
  double gap = -std::numeric_limits<double>::infinity();
  double share = 1;  // of their size that the bodies were shrunk to
};

/// By how much a number of a common point moves the agent's point away from the obstacle's.
struct ConvexPair::Direction {
  enum class Of : std::uint8_t { weight, along, time } of;
  bool agent = true;
  std::size_t share = 0;
  int axis = 0;
  Vector3d way;  // scaled to what it may change
};

ConvexPair::ConvexPair(const RoundedHull& agent, const RoundedHull& obstacle, const Vector3d& v_a,
                       const Vector3d& v_b, const Horizon& horizon)
    : agent_(agent),
      obstacle_(obstacle),
      v_a_(v_a),
      v_b_(v_b),
      w_(v_a - v_b),
      exact_v_a_(fractions(v_a)),
      exact_v_b_(fractions(v_b)),
      from_(horizon.from),
      start_(horizon.from),
      end_(horizon.until) {
  if (!std::isinf(horizon.until)) until_ = Rational(horizon.until);
  take_middle(agent_, middle_of_agent_, agent_middle_);
  take_middle(obstacle_, middle_of_obstacle_, obstacle_middle_);
  size_ = size_about(agent_, agent_middle_) + size_about(obstacle_, obstacle_middle_);
  // Until they have passed, where the horizon has no end.
  const Vector3d apart = obstacle_.place - agent_.place + obstacle_middle_ - agent_middle_;
  if (!moves()) end_ = start_;
  if (std::isinf(end_)) end_ = start_ + 2 * ((apart.norm() + size_) / w_.norm() + start_);
}

/// All parts where they are few, else those that are farthest along the axes.
void ConvexPair::take_middle(const RoundedHull& hull, std::vector<std::uint32_t>& parts,
                             Vector3d& middle) const {
  if (hull.parts.size() <= 8) {
    for (std::uint32_t i = 0; i < hull.parts.size(); ++i) parts.push_back(i);
  } else {
    for (int k = 0; k < 6; ++k) {
      const Vector3d n =
          (k < 3 ? 1.0 : -1.0) * Vector3d(Vector3d::Unit(k % 3) + 0.1 * Vector3d::Unit((k + 1) % 3));
      const std::uint32_t i = farthest_part(hull, n).part;
      if (std::find(parts.begin(), parts.end(), i) == parts.end()) parts.push_back(i);
    }
  }
  middle.setZero();
  for (const std::uint32_t i : parts) middle += hull.parts[i].middle() / static_cast<double>(parts.size());
}

/// For the point nearest to the origin of obstacle - agent - w t, all shrunk about their middles.
ConvexPair::Found ConvexPair::search(double share) const {
  Found found;
  found.share = share;
  const double middle_time = 0.5 * (start_ + end_), half_time = 0.5 * (end_ - start_) * share;
  const Vector3d apart = obstacle_.place - agent_.place;
  const auto add = [&](const Vector3d& n) {  // that is nearest along n
    const FarthestPart a = farthest_part(agent_, n), b = farthest_part(obstacle_, -n);
    const bool at_end = n.dot(w_) > 0;
    const Vector3d of_a = agent_middle_ + share * (a.point - agent_middle_),
                   of_b = obstacle_middle_ + share * (b.point - obstacle_middle_);
    found.tried.push_back({n, a.part, b.part, at_end});
    return Vector3d(apart + of_b - of_a - (middle_time + (at_end ? half_time : -half_time)) * w_);
  };
  HullSimplex<3>& simplex = found.simplex;
  Vector3d n = apart + obstacle_middle_ - agent_middle_ - middle_time * w_;
  if (!(n.norm() > 1e-12 * size_)) n = Vector3d::UnitX();
  simplex.add({0, 0}, add(n));
  double last = std::numeric_limits<double>::infinity();
  for (std::uint32_t step = 1; step < 200; ++step) {
    simplex.reduce();
    const double length = simplex.nearest.squaredNorm();
    if (!(length < last) || simplex.surrounds) break;
    last = length;
    n = simplex.normal / simplex.normal.cwiseAbs().maxCoeff();
    if (!n.allFinite()) break;
    const Vector3d x = add(n);
    const double gap = n.dot(x) / n.norm();
    if (gap > found.gap) found.gap = gap, found.normal = n;
    if (!(n.dot(simplex.z[0] - x) > 1e-15 * n.norm() * (simplex.z[0].norm() + x.norm()))) break;
    simplex.add({step, step}, x);
  }
  if (simplex.surrounds) found.gap = -1;
  return found;
}

std::optional<Plane> ConvexPair::plane_near(const Vector3d& n, int bits, bool across) const {
  const auto whole = [bits](double x) {
    return Integer(static_cast<std::int64_t>(std::nearbyint(std::ldexp(x, bits))));
  };
  Plane plane;
  if (across) {
    const int grid = std::min(grid_of(v_a_), grid_of(v_b_));
    const Vector w = on_grid(v_a_, grid) - on_grid(v_b_, grid);
    const int k = largest_entry(w), i = (k + 1) % 3, j = (k + 2) % 3;
    const double most = std::max(std::abs(n(i)), std::abs(n(j))), sign = w_(k) < 0 ? -1 : 1;
    if (!(most > 0)) return std::nullopt;
    plane = plane_across(w, k, whole(sign * n(i) / most), whole(sign * n(j) / most));
  } else {
    const Vector3d scaled = n / n.cwiseAbs().maxCoeff();
    if (!scaled.allFinite()) return std::nullopt;
    plane.normal = primitive({whole(scaled(0)), whole(scaled(1)), whole(scaled(2))});
  }
  if (is_zero(plane.normal)) return std::nullopt;
  return plane;
}

std::optional<Plane> ConvexPair::with_levels(Plane plane) const {
  const Vector& n = plane.normal;
  Rational most = agent_.reach(n), least = -obstacle_.reach(backwards(n));
  const Fractions along{Rational(n[0]), Rational(n[1]), Rational(n[2])};
  const Rational speed = dot(along, exact_v_a_) - dot(along, exact_v_b_);
  if (speed.sign() > 0 && !until_) return std::nullopt;
  const Rational gap = least - most - (speed.sign() > 0 ? *until_ : from_) * speed;
  if (gap.sign() <= 0) return std::nullopt;
  most = up_to(most, gap / 8);
  least = -up_to(-least, gap / 8);
  if (plane.across) {  // the file's n has w in m/s, ours has it on a grid
    const Rational unit(std::ldexp(1.0, std::min(grid_of(v_a_), grid_of(v_b_))));
    most *= unit;
    least *= unit;
  }
  plane.levels = {most, least};
  return plane;
}

std::optional<Plane> ConvexPair::plane() const {
  const Found found = search(1);
  if (!(found.gap > 0)) return std::nullopt;
  const double along = std::abs(found.normal.dot(w_)) / (found.normal.norm() * w_.norm());
  for (const bool across : {true, false}) {
    if (across && (!moves() || !(along < 1e-4))) continue;
    for (const int bits : kDigits) {
      const auto plane = plane_near(found.normal, bits, across);
      if (!plane) continue;
      if (auto proved = with_levels(*plane)) return proved;
    }
  }
  return std::nullopt;
}

/// The largest share of their size at which they do not meet yet, and where they then touch.
ConvexPair::Found ConvexPair::grown() const {
  const double rounding = 1e-13 * (size_ + w_.norm() * std::abs(end_));
  double low = 0, high = 1;
  Found best = search(0);
  if (best.simplex.nearest.norm() <= rounding) return best;
  for (int step = 0; step < 45 && high - low > 1e-11; ++step) {
    const double share = 0.5 * (low + high);
    Found found = search(share);
    if (found.gap > rounding && !found.simplex.surrounds) {
      low = share;
      best = std::move(found);
    } else {
      high = share;
      // Where it touches to rounding, and its simplex is no less.
      if (!found.simplex.surrounds && found.simplex.nearest.norm() <= rounding) best = std::move(found);
    }
  }
  return best;
}

/// Of what was found the agent's or the obstacle's point, its numbers rounded to some digits.
Mean ConvexPair::mean_of(const Found& found, bool agent, int bits) const {
  const RoundedHull& hull = agent ? agent_ : obstacle_;
  const auto& middle = agent ? middle_of_agent_ : middle_of_obstacle_;
  std::vector<double> weight(hull.parts.size(), 0);
  std::vector<Vector3d> along(hull.parts.size(), Vector3d::Zero());
  for (const std::uint32_t i : middle) weight[i] += (1 - found.share) / static_cast<double>(middle.size());
  Vector3d rest = Vector3d::Zero();
  double sum = 0;
  for (int k = 0; k < found.simplex.count; ++k) sum += found.simplex.weight[k];
  for (int k = 0; k < found.simplex.count; ++k) {
    const Tried& tried = found.tried[found.simplex.pair[k].agent];
    const Vector3d n = agent ? tried.n : Vector3d(-tried.n);
    const std::uint32_t i = agent ? tried.agent : tried.obstacle;
    const RoundPart& part = hull.parts[i];
    const double counts = found.share * found.simplex.weight[k] / sum,
                 round = (part.factor.transpose() * n).norm();
    weight[i] += counts;
    if (round > 0) along[i] += n * (counts / round);
    rest += n * (counts * part.margin / n.norm());
  }
  Mean mean;
  Rational all = 0;
  std::size_t largest = 0;
  for (std::uint32_t i = 0; i < hull.parts.size(); ++i) {
    if (!(weight[i] > 0)) continue;
    Share share{i, nearest_multiple(weight[i], 1, bits), {}};
    for (int k = 0; k < 3; ++k)
      share.along[k] = nearest_multiple(along[i](k), 1 / std::max(hull.parts[i].factor.norm(), 1e-300), bits);
    if (share.weight.sign() <= 0) continue;
    all += share.weight;
    mean.shares.push_back(share);
    if (share.weight > mean.shares[largest].weight) largest = mean.shares.size() - 1;
  }
  if (!mean.shares.empty()) mean.shares[largest].weight += 1 - all;
  for (int k = 0; k < 3; ++k)
    mean.rest[k] = nearly(rest(k), std::max(hull.parts.front().margin, 1e-300), bits);
  return mean;
}

double ConvexPair::time_of(const Found& found) const {
  double sum = 0, at_end = 0;
  for (int k = 0; k < found.simplex.count; ++k) {
    sum += found.simplex.weight[k];
    if (found.tried[found.simplex.pair[k].agent].at_end) at_end += found.simplex.weight[k];
  }
  return 0.5 * (start_ + end_) + (end_ - start_) * found.share * (at_end / sum - 0.5);
}

/// To some digits, or to a simple fraction; in the horizon.
Rational ConvexPair::time_of(const Found& found, int bits) const {
  if (!moves() || start_ == end_) return from_;
  const double time = time_of(found);
  const Rational rounded =
      bits == kSimple ? simplest(time, 1e-9 * end_) : nearest_multiple(time, size_ / w_.norm(), bits);
  if (rounded < from_) return from_;
  return until_ && rounded > *until_ ? *until_ : rounded;
}

std::vector<ConvexPair::Direction> ConvexPair::ways(const CommonPoint& at) const {
  std::vector<Direction> found;
  for (const bool agent : {true, false}) {
    const RoundedHull& hull = agent ? agent_ : obstacle_;
    const Mean& mean = agent ? at.agent : at.obstacle;
    const double sign = agent ? 1 : -1;
    const auto number = [&](std::size_t i) { return static_cast<double>(mean.shares[i].weight); };
    const auto place = [&](std::size_t i) { return hull.parts[mean.shares[i].part].middle(); };
    for (std::size_t i = 0; i < mean.shares.size(); ++i) {
      const RoundPart& part = hull.parts[mean.shares[i].part];
      if (i > 0)
        found.push_back({Direction::Of::weight, agent, i, 0,
                         sign * std::min(number(i), number(0)) * (place(i) - place(0))});
      if (part.is_point()) continue;
      const Matrix3d shape = part.factor * part.factor.transpose();
      for (int k = 0; k < 3; ++k)
        found.push_back({Direction::Of::along, agent, i, k,
                         Vector3d(sign * number(i) / part.factor.norm() * shape.col(k))});
    }
  }
  if (moves() && within(at.time))
    found.push_back({Direction::Of::time, true, 0, 0, w_ * (size_ / w_.norm())});
  return found;
}

/// Moves one of the points to where the other is, exactly.
bool ConvexPair::close(CommonPoint& at) const {
  const auto gap = [&] {
    return obstacle_.point(at.obstacle) + at.time * exact_v_b_ - agent_.point(at.agent) -
           at.time * exact_v_a_;
  };
  const Fractions left = gap();
  if (is_zero(left)) return true;
  if (agent_.parts.front().margin > 0 || obstacle_.parts.front().margin > 0) {
    if (agent_.parts.front().margin > obstacle_.parts.front().margin)
      at.agent.rest = at.agent.rest + left;
    else
      at.obstacle.rest = at.obstacle.rest - left;
    return true;
  }
  // The three ways (or two, or one) that span the most.
  std::vector<Direction> all = ways(at), chosen;
  std::vector<Vector3d> across;
  for (const Direction& way : all) across.push_back(way.way);
  for (int k = 0; k < 3 && !all.empty(); ++k) {
    const auto longest = static_cast<std::size_t>(
        std::max_element(across.begin(), across.end(),
                         [](const auto& x, const auto& y) { return x.squaredNorm() < y.squaredNorm(); }) -
        across.begin());
    const double length = across[longest].norm();
    if (!(length > 1e-11 * size_)) break;
    const Vector3d unit = across[longest] / length;
    chosen.push_back(all[longest]);
    for (Vector3d& x : across) x -= unit.dot(x) * unit;
  }
  // By the squares of their exact ways: sum_j (way_i . way_j) x_j = way_i . left.
  const std::size_t count = chosen.size();
  std::vector<Fractions> exact;
  for (const Direction& way : chosen) {
    const RoundedHull& hull = way.agent ? agent_ : obstacle_;
    const Mean& mean = way.agent ? at.agent : at.obstacle;
    const Rational sign = way.agent ? 1 : -1;
    if (way.of == Direction::Of::time)
      exact.push_back(exact_v_a_ - exact_v_b_);
    else if (way.of == Direction::Of::weight)
      exact.push_back(sign * (hull.center(mean.shares[way.share].part) - hull.center(mean.shares[0].part)));
    else
      exact.push_back(sign * hull.parts[mean.shares[way.share].part].exact_shape()[way.axis]);
  }
  std::vector<std::vector<Rational>> rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) rows[i].push_back(dot(exact[i], exact[j]));
    rows[i].push_back(dot(exact[i], left));
  }
  for (std::size_t k = 0; k < count; ++k) {
    if (rows[k][k].is_zero()) return false;
    for (std::size_t i = 0; i < count; ++i) {
      if (i == k) continue;
      const Rational factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= count; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  for (std::size_t k = 0; k < count; ++k) {
    const Rational x = rows[k][count] / rows[k][k];
    Mean& mean = chosen[k].agent ? at.agent : at.obstacle;
    switch (chosen[k].of) {
      case Direction::Of::time:
        at.time += x;
        break;
      case Direction::Of::weight:
        mean.shares[chosen[k].share].weight += x;
        mean.shares[0].weight -= x;
        break;
      case Direction::Of::along:
        mean.shares[chosen[k].share].along[chosen[k].axis] += x;
        break;
    }
  }
  return is_zero(gap());
}

/// What was found, rounded and made exact; `within`: not on the rim of either.
std::optional<CommonPoint> ConvexPair::checked(const Found& found, int bits, bool within) const {
  CommonPoint at{time_of(found, bits), {}, mean_of(found, true, bits), mean_of(found, false, bits)};
  if (at.agent.shares.empty() || at.obstacle.shares.empty() || !close(at)) return std::nullopt;
  if (at.time < from_ || (until_ && at.time > *until_)) return std::nullopt;
  if (!agent_.holds(at.agent, within) || !obstacle_.holds(at.obstacle, within)) return std::nullopt;
  at.point = agent_.point(at.agent) + at.time * exact_v_a_;
  return at;
}

/// One that is within both, not on their rims; or, of faces that touch at their rims, one of simple
/// fractions.
std::optional<CommonPoint> ConvexPair::common_point(bool or_rim) const {
  const Found found = grown();
  if (or_rim && found.share > 1 - 1e-6)
    if (auto at = checked(search(1), kSimple, false)) return at;
  for (const int bits : kDigits)
    if (auto at = checked(found, bits, true)) return at;
  return std::nullopt;
}

std::optional<DeepPoint> ConvexPair::meeting() const {
  const auto at = common_point(false);
  if (!at) return std::nullopt;
  std::vector<Fractions> of_agent = agent_.directions(at->agent),
                         of_obstacle = obstacle_.directions(at->obstacle);
  DeepPoint deep{*at};
  if (span(of_agent)) {
    deep.inside = DeepPoint::Inside::agent;
  } else if (span(of_obstacle)) {
    deep.inside = DeepPoint::Inside::obstacle;
  } else {
    of_agent.insert(of_agent.end(), of_obstacle.begin(), of_obstacle.end());
    if (within(at->time)) of_agent.push_back(exact_v_a_ - exact_v_b_);
    if (!span(of_agent)) return std::nullopt;
  }
  return deep;
}

/// Normals of few digits near n, in the order of their digits.
std::vector<Vector> ConvexPair::simple_normals(const Vector3d& n) const {
  std::vector<Vector> found;
  const auto offer = [&](const Vector& normal) {
    if (!is_zero(normal) && std::find(found.begin(), found.end(), normal) == found.end())
      found.push_back(normal);
  };
  const Vector3d scaled = n / n.cwiseAbs().maxCoeff();
  if (!scaled.allFinite()) return found;
  const int grid = moves() ? std::min(grid_of(v_a_), grid_of(v_b_)) : 0;
  for (const double off : {1e-3, 1e-4, 1e-5, 1e-7, 1e-9}) {
    std::array<Rational, 3> entries;
    for (int k = 0; k < 3; ++k)
      entries[k] =
          (scaled(k) < 0 ? -1 : 1) * simplest(std::abs(scaled(k)) < off ? 0 : std::abs(scaled(k)), off);
    const Integer below = lcm(lcm(denominator(entries[0]), denominator(entries[1])), denominator(entries[2]));
    Vector whole;
    for (int k = 0; k < 3; ++k) whole[k] = numerator(Rational(entries[k] * Rational(below)));
    offer(primitive(whole));
    if (!moves()) continue;
    const Vector w = on_grid(v_a_, grid) - on_grid(v_b_, grid);
    const int k = largest_entry(w), i = (k + 1) % 3, j = (k + 2) % 3;
    const bool back = w[k].sign() < 0;
    offer(primitive(
        plane_across(w, k, back ? Integer(-whole[i]) : whole[i], back ? Integer(-whole[j]) : whole[j])
            .normal));
  }
  return found;
}

std::optional<CommonFace> ConvexPair::touch_along(const Vector& n) const {
  const auto most = agent_.exact_reach(n), back = obstacle_.exact_reach(backwards(n));
  if (!most || !back) return std::nullopt;
  const Fractions along{Rational(n[0]), Rational(n[1]), Rational(n[2])};
  const Rational speed = dot(along, exact_v_a_) - dot(along, exact_v_b_), gap = -*back - *most;
  if (speed.sign() > 0 && !until_) return std::nullopt;
  Rational time = speed.sign() > 0 ? *until_ : from_;
  if (gap != time * speed) return std::nullopt;
  std::vector<std::uint32_t> of_agent, of_obstacle;
  const auto a = agent_.face(n, *most, of_agent), b = obstacle_.face(backwards(n), *back, of_obstacle);
  if (!a || !b) return std::nullopt;
  const double fixed = static_cast<double>(time);
  Horizon span_of_time{static_cast<double>(from_),
                       until_ ? static_cast<double>(*until_) : std::numeric_limits<double>::infinity()};
  if (speed.sign() != 0) span_of_time = {fixed, fixed};
  auto at = ConvexPair(*a, *b, v_a_, v_b_, span_of_time).common_point(true);
  if (!at) return std::nullopt;
  // What the faces' parts are in the bodies.
  const auto length = [&](const Rational& q) {
    return Rational(Integer(sqrt(numerator(q))), Integer(sqrt(denominator(q))));
  };
  const auto of_body = [&](Mean& mean, const RoundedHull& hull, const std::vector<std::uint32_t>& parts,
                           const Fractions& outward) {
    const Rational margin(hull.parts.front().margin);
    if (margin > 0) mean.rest = Rational(margin / length(dot(outward, outward))) * outward;
    for (Share& share : mean.shares) {
      share.part = parts[share.part];
      const Rational q = dot(outward, image_of(hull.parts[share.part].exact_shape(), outward));
      if (q.sign() > 0) share.along = Rational(share.weight / length(q)) * outward;
    }
  };
  of_body(at->agent, agent_, of_agent, along);
  of_body(at->obstacle, obstacle_, of_obstacle, Rational(-1) * along);
  return CommonFace{n, *at};
}

std::optional<CommonFace> ConvexPair::touch() const {
  const Found found = search(1 - 1e-6), other = search(1 - 1e-3);
  std::vector<Vector3d> tried{found.normal, other.normal};
  for (int k = 0; k < 3; ++k) tried.push_back(Vector3d::Unit(k));  // of flat bodies there are many
  const Vector3d apart = obstacle_.place - agent_.place + obstacle_middle_ - agent_middle_;
  tried.push_back(apart);
  if (moves()) {
    tried.push_back(apart - w_ * (w_.dot(apart) / w_.squaredNorm()));
    for (int k = 0; k < 3; ++k) tried.push_back(w_.cross(Vector3d::Unit(k)));
  }
  for (const Vector3d& n : tried)
    for (const double sign : {1.0, -1.0})
      for (const Vector& normal : simple_normals(sign * n))
        if (auto touch = touch_along(normal)) return touch;
  return std::nullopt;
}

}  // namespace vericone::certificates
