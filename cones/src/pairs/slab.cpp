// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/slab.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/exact/rational.h>
#include <vericone/geometry/interval.h>
#include <vericone/internal/geometry/rotation.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "pairs/family.h"
#include "round/root_sum.h"

namespace vericone {
namespace {

using Eigen::Vector3d;
using exact::Rational;

constexpr double kEver = std::numeric_limits<double>::infinity();

/// normal.x <= height is behind it.
struct Side {
  Vector3d normal;
  double height;
};

/// A part of the agent: turned as in the world, about `at`.
struct Part {
  Convex body;
  /// How far it is in front of each side, times the normal's length; negative: it reaches behind it.
  std::array<Interval, 2> gap;
  std::array<int, 2> sign;  // exact
};

std::vector<Convex> parts_of(const Body& body) {
  std::vector<Convex> parts;
  const auto add = [&](const CombinedEllipsoid& quadric) {
    if (!quadric.is_ellipsoid())
      throw InputError("agent", to_string(body.kind()), "a body without hyperboloids, before a slab");
    parts.push_back(Convex::rounded(quadric.ellipsoid(), 0));
  };
  if (const auto* quadric = body.quadric()) add(*quadric);
  if (const auto* quadrics = body.quadrics())
    for (const CombinedEllipsoid& one : *quadrics) add(one);
  if (const HullBody* hull = body.hull()) parts.push_back(Convex::rounded(*hull, 0));
  if (const Convex* convex = body.convex()) parts.push_back(*convex);
  if (const Assembly* assembly = body.assembly())
    for (std::size_t i = 0; i < assembly->size(); ++i) parts.push_back(assembly->convex_piece(i));
  return parts;
}

template <typename N>
N dot(const std::array<N, 3>& x, const std::array<N, 3>& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}
std::array<Interval, 3> intervals(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }

/// What stands under the root of a piece: |F^T n|^2, or n.S n of one given by its shape.
template <typename N, typename Vector>
N square_of(const Convex::Piece& piece, const std::array<N, 3>& n, const Vector& vector) {
  if (piece.shape) {
    std::array<N, 3> image;
    for (int i = 0; i < 3; ++i) image[std::size_t(i)] = dot(vector(piece.shape->col(i)), n);
    return dot(image, n);
  }
  N sum = 0;
  for (int k = 0; k < piece.rank; ++k) {
    const N one = dot(vector(piece.factor.col(k)), n);
    sum = sum + one * one;
  }
  return sum;
}

Interval gap_of(const Convex& body, const Vector3d& at, const Side& side) {
  const auto n = intervals(side.normal);
  const Interval base =
      dot(intervals(at), n) - Interval(side.height) - Interval(body.margin()) * sqrt(dot(n, n));
  double lo = kEver, hi = kEver;
  for (const Convex::Piece& piece : body.pieces()) {
    const Interval gap = base + dot(intervals(piece.center), n) -
                         sqrt(square_of<Interval>(piece, n, [](const auto& x) { return intervals(x); }));
    if (!gap.finite()) return {0, kEver};
    lo = std::min(lo, gap.lo());
    hi = std::min(hi, gap.hi());
  }
  return Interval::between(lo, hi);
}

/// Of a dyadic number, the least k with which x 2^k is whole.
unsigned bits_of(const Rational& x) { return msb(denominator(x)); }

/// whole + sqrt(p) + sqrt(q), dyadic and p, q >= 0.
int sign_of(const Rational& whole, const Rational& p, const Rational& q) {
  const unsigned bits = std::max({bits_of(whole), (bits_of(p) + 1) / 2, (bits_of(q) + 1) / 2});
  const Rational once = Rational(round::Integer(1) << bits), twice = once * once;
  return round::sign({numerator(whole * once), {numerator(p * twice), numerator(q * twice)}});
}

/// Of the gap after `shift`, n.w t: exact.
int exact_sign(const Convex& body, const Vector3d& at, const Side& side, const Rational& shift) {
  const auto n = exact::to_rational<3>(side.normal);
  const Rational margin = body.margin(), around = margin * margin * dot(n, n);
  const Rational base = Rational(side.height) - dot(exact::to_rational<3>(at), n) - shift;
  int least = 1;
  for (const Convex::Piece& piece : body.pieces()) {
    const Rational under =
        square_of<Rational>(piece, n, [](const auto& x) { return exact::to_rational<3>(Vector3d(x)); });
    least = std::min(least, -sign_of(base - dot(exact::to_rational<3>(piece.center), n), under, around));
    if (least < 0) break;
  }
  return least;
}

Rational product(const Vector3d& n, const Vector3d& v_a, const Vector3d& v_b) {
  Rational sum = 0;
  for (int i = 0; i < 3; ++i) sum += Rational(n(i)) * (Rational(v_a(i)) - Rational(v_b(i)));
  return sum;
}

Interval interval_product(const Vector3d& n, const Vector3d& v_a, const Vector3d& v_b) {
  return dot(intervals(n), intervals(v_a)) - dot(intervals(n), intervals(v_b));
}

int sign_of_product(const Vector3d& n, const Vector3d& v_a, const Vector3d& v_b) {
  const Interval rough = interval_product(n, v_a, v_b);
  if (rough.finite() && (rough.positive() || rough.negative())) return rough.positive() ? 1 : -1;
  return product(n, v_a, v_b).sign();
}

std::vector<Side> sides_of(const Slab& slab) {
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(slab.normal(k)))
      throw InputError("slab.normal[" + std::to_string(k) + "]", to_text(slab.normal(k)), "a finite number");
  if (slab.normal.isZero(0)) throw InputError("slab.normal", "[0, 0, 0]", "not zero");
  if (std::isnan(slab.low) || slab.low == kEver)
    throw InputError("slab.low", to_text(slab.low), "a number, or -infinity for a half-space");
  if (std::isnan(slab.high) || slab.high == -kEver || slab.low > slab.high)
    throw InputError("slab.high", to_text(slab.high), "a number no less than slab.low");
  if (std::isinf(slab.low) && std::isinf(slab.high))
    throw InputError("slab.high", to_text(slab.high),
                     "finite where slab.low is not: all of space is no slab");
  std::vector<Side> sides;
  if (std::isfinite(slab.high)) sides.push_back({slab.normal, slab.high});
  if (std::isfinite(slab.low)) sides.push_back({-slab.normal, -slab.low});
  // The square of a normal is to be a double. A power of two changes nothing else, where nothing is lost.
  const int scale = -std::ilogb(slab.normal.cwiseAbs().maxCoeff());
  const auto scaled = [&](double x) { return std::scalbn(x, scale); };
  const auto kept = [&](double x) { return std::isfinite(scaled(x)) && std::scalbn(scaled(x), -scale) == x; };
  const bool exact = std::abs(scale) > 300 && std::all_of(sides.begin(), sides.end(), [&](const Side& side) {
                       return kept(side.height) && std::all_of(side.normal.begin(), side.normal.end(), kept);
                     });
  if (exact)
    for (Side& side : sides) side = {side.normal.unaryExpr(scaled), scaled(side.height)};
  return sides;
}

/// Outwards until it is not within the side: by roundings.
void move_out(Vector3d& corner, const Side& side) {
  int k = 0;
  const double largest = side.normal.cwiseAbs().maxCoeff(&k);
  // A corner may have cancelled to 0, and the plane is not there.
  constexpr double kPart = std::numeric_limits<double>::epsilon();
  const double size = std::max(kPart * corner.cwiseAbs().maxCoeff(), kPart * std::abs(side.height) / largest);
  for (double step = size / 8;
       std::isfinite(step) &&
       dot(exact::to_rational<3>(side.normal), exact::to_rational<3>(corner)) < Rational(side.height);
       step *= 2)
    corner(k) += std::copysign(std::max(step, std::numeric_limits<double>::denorm_min()), side.normal(k));
}

}  // namespace

HullBody clipped(const Slab& slab, const Vector3d& about, double extent) {
  const std::vector<Side> sides = sides_of(slab);
  if (!about.allFinite()) throw InputError("about", "a number that is not finite", "finite (m)");
  if (!(extent > 0) || std::isinf(extent)) throw InputError("extent", to_text(extent), "positive (m)");
  const Vector3d n = sides.front().normal.stableNormalized();
  int axis = 0;
  n.cwiseAbs().maxCoeff(&axis);
  const bool along_axis = (n.array() != 0).count() == 1;
  const Vector3d u = along_axis ? Vector3d(Vector3d::Unit((axis + 1) % 3)) : n.unitOrthogonal();
  const Vector3d v = n.cross(u), foot = about - n.dot(about) * n;
  const double length = sides.front().normal.stableNorm(), near = sides.front().height / length,
               other = sides.size() == 2 ? -sides.back().height / length : near;
  if (!(near - extent < near))
    throw InputError("extent", to_text(extent), "no less than the digits of the plane's place");
  // By more than roundings may take away.
  const double slack = 0x1p-48 * (about.cwiseAbs().maxCoeff() + std::abs(near) + std::abs(other));
  const double wide = extent * (1 + 0x1p-48) + slack, far = sides.size() == 2 ? other : near - wide;
  std::vector<Vector3d> corners;
  for (std::size_t k = 0; k < 2; ++k)
    for (const double x : {-wide, wide})
      for (const double y : {-wide, wide}) {
        Vector3d& corner = corners.emplace_back(foot + (k == 0 ? near : far) * n + x * u + y * v);
        if (!corner.allFinite()) throw InputError("extent", to_text(extent), "one whose corners are doubles");
        if (k < sides.size()) move_out(corner, sides[k]);
      }
  return HullBody(std::move(corners));
}

struct SlabPair::Data {
  std::vector<Side> sides;
  std::vector<Part> parts;
  Vector3d at;
  Relation relation = Relation::disjoint;

  /// The side that a part is in front of; of one that is not, -1.
  int side_of(const Part& part) const {
    for (std::size_t k = 0; k < sides.size(); ++k)
      if (part.sign[k] > 0) return int(k);
    return -1;
  }
};

SlabPair::SlabPair(const Placed& agent, const Slab& obstacle) {
  static_cast<void>(is_upright(agent.pose));  // throws where it is none
  Data data;
  data.sides = sides_of(obstacle);
  data.at = agent.pose.position;
  for (const Convex& body : parts_of(agent.body)) {
    Part part{in_world(body, {Vector3d::Zero(), agent.pose.rotation}), {}, {}};
    int most = -1;  // in front of a side, at it, or behind all
    for (std::size_t k = 0; k < data.sides.size(); ++k) {
      part.gap[k] = gap_of(part.body, data.at, data.sides[k]);
      part.sign[k] = part.gap[k].positive()   ? 1
                     : part.gap[k].negative() ? -1
                                              : exact_sign(part.body, data.at, data.sides[k], 0);
      most = std::max(most, part.sign[k]);
    }
    if (most < 0)
      data.relation = Relation::overlapping;
    else if (most == 0 && data.relation == Relation::disjoint)
      data.relation = Relation::touching;
    data.parts.push_back(std::move(part));
  }
  data_ = std::make_shared<const Data>(std::move(data));
}

Relation SlabPair::relation() const { return data_->relation; }

Verdict SlabPair::verdict(const Vector3d& v_a, const Vector3d& v_b) const { return verdict(v_a, v_b, kEver); }

Verdict SlabPair::verdict(const Vector3d& v_a, const Vector3d& v_b, double until) const {
  if (!(until >= 0)) throw InputError("horizon", to_text(until), "0 or more (s)");
  static_cast<void>(pairs::relative_velocity(v_a, v_b));
  if (data_->relation == Relation::overlapping) return Verdict::overlapping;
  if (data_->relation == Relation::touching) return Verdict::touching;
  Verdict found = Verdict::out;
  for (const Part& part : data_->parts) {
    const auto k = std::size_t(data_->side_of(part));
    const Side& side = data_->sides[k];
    if (sign_of_product(side.normal, v_a, v_b) >= 0) continue;
    if (std::isinf(until)) return Verdict::in;
    const Interval then = part.gap[k] + Interval(until) * interval_product(side.normal, v_a, v_b);
    const int sign =
        then.finite() && then.positive() ? 1
        : then.finite() && then.negative()
            ? -1
            : exact_sign(part.body, data_->at, side, Rational(until) * product(side.normal, v_a, v_b));
    if (sign < 0) return Verdict::in;
    if (sign == 0) found = Verdict::on;
  }
  return found;
}

std::optional<Contact> SlabPair::contact(const Vector3d& v_a, const Vector3d& v_b) const {
  static_cast<void>(pairs::relative_velocity(v_a, v_b));
  Contact contact;
  contact.time = kEver;
  if (data_->relation != Relation::disjoint) {
    contact.time = contact.latest = 0;
    return contact;
  }
  double earliest = kEver;
  for (const Part& part : data_->parts) {
    const auto k = std::size_t(data_->side_of(part));
    const Side& side = data_->sides[k];
    if (sign_of_product(side.normal, v_a, v_b) >= 0) continue;
    const Interval time = part.gap[k] / -interval_product(side.normal, v_a, v_b);
    earliest = std::min(earliest, time.finite() ? std::max(time.lo(), 0.0) : 0.0);
    if (!time.finite() || !(time.hi() < contact.latest)) continue;
    contact.latest = time.hi();
    contact.time = time.mid();
    const Vector3d n = side.normal.stableNormalized();
    contact.normal = Vector3d::Zero() - n;
    contact.point = data_->at + part.body.support_point(-n) + time.mid() * v_a;
  }
  if (std::isinf(earliest)) return std::nullopt;
  contact.earliest = earliest;
  if (std::isinf(contact.time)) contact.time = std::numeric_limits<double>::quiet_NaN();
  return contact;
}

Miss SlabPair::miss(const Vector3d& v_a, const Vector3d& v_b) const {
  Miss miss;
  const Verdict verdict = this->verdict(v_a, v_b);
  if (verdict == Verdict::overlapping) {
    const auto depth = penetration();
    miss.depth = depth->most;
    miss.normal = depth->normal;
    miss.distance = -miss.depth;
  }
  if (verdict != Verdict::out) return miss;
  miss.least = miss.most = kEver;
  for (const Part& part : data_->parts) {
    const auto k = std::size_t(data_->side_of(part));
    const auto n = intervals(data_->sides[k].normal);
    const Interval distance = part.gap[k] / sqrt(dot(n, n));
    miss.least = std::min(miss.least, distance.finite() ? std::max(distance.lo(), 0.0) : 0.0);
    if (!distance.finite() || !(distance.hi() < miss.most)) continue;
    miss.most = distance.hi();
    miss.distance = distance.mid();
    miss.normal = Vector3d::Zero() - data_->sides[k].normal.stableNormalized();
  }
  return miss;
}

std::optional<Penetration> SlabPair::penetration() const {
  if (data_->relation != Relation::overlapping) return std::nullopt;
  Penetration best;
  best.least = best.most = kEver;
  for (std::size_t k = 0; k < data_->sides.size(); ++k) {
    const auto n = intervals(data_->sides[k].normal);
    const Interval length = sqrt(dot(n, n));
    // Moved by s along the normal a part is behind this side before -gap / length, and in front of the other
    // up to its gap / length: the first s at which no part is between the two.
    const auto first_free = [&](bool widest) {
      double s = 0;
      for (bool again = true; again;) {
        again = false;
        for (const Part& part : data_->parts) {
          const Interval out = -part.gap[k] / length,
                         other = data_->sides.size() == 2 ? part.gap[1 - k] / length : Interval(-kEver);
          const double from = widest ? other.lo() : other.hi(), to = widest ? out.hi() : out.lo();
          if (std::isnan(from) || std::isnan(to)) return widest ? kEver : s;
          if (!(from < s && s < to)) continue;
          s = to;
          again = true;
        }
      }
      return s;
    };
    const double least = first_free(false), most = first_free(true);
    best.least = std::min(best.least, least);
    if (!(most < best.most)) continue;
    best.most = most;
    best.normal = Vector3d::Zero() - data_->sides[k].normal.stableNormalized();
  }
  return best;
}

std::optional<SafeHalfSpace> SlabPair::safe_half_space() const {
  if (data_->relation != Relation::disjoint) return std::nullopt;
  const int k = data_->side_of(data_->parts.front());
  SafeHalfSpace safe{-data_->sides[std::size_t(k)].normal, kEver};
  for (const Part& part : data_->parts) {
    if (data_->side_of(part) != k) return std::nullopt;
    safe.room = std::min(safe.room, part.gap[std::size_t(k)].lo());
  }
  return safe;
}

}  // namespace vericone
