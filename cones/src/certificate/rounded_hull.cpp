// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/rounded_hull.h"

#include <algorithm>
#include <cmath>

namespace vericone::certificates {

using Eigen::Vector3d;

Fractions operator+(const Fractions& x, const Fractions& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}
Fractions operator-(const Fractions& x, const Fractions& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
Fractions image_of(const FractionMatrix& m, const Fractions& x) {
  return {dot(m[0], x), dot(m[1], x), dot(m[2], x)};
}
bool is_zero(const Fractions& x) { return x[0].is_zero() && x[1].is_zero() && x[2].is_zero(); }

namespace {

Fractions in_fractions(const Vector& n) { return {Rational(n[0]), Rational(n[1]), Rational(n[2])}; }

/// sqrt(q) where it is a fraction.
std::optional<Rational> root_of(const Rational& q) {
  const auto whole = [](const Integer& x) -> std::optional<Integer> {
    const Integer root = sqrt(x);
    if (root * root == x) return root;
    return std::nullopt;
  };
  const auto above = whole(numerator(q)), below = whole(denominator(q));
  if (!above || !below) return std::nullopt;
  return Rational(*above, *below);
}

Rational square(const FractionMatrix& shape, const Fractions& n) { return dot(n, image_of(shape, n)); }

}  // namespace

Vector3d RoundPart::middle() const {
  Vector3d x = center;
  for (int k = 0; k < 3; ++k)
    if (!shift[k].is_zero()) x(k) += static_cast<double>(shift[k]);
  return x;
}

FractionMatrix RoundPart::exact_shape() const {
  FractionMatrix s;
  if (shape) {
    for (int i = 0; i < 3; ++i) s[i] = fractions(shape->row(i).transpose());
    return s;
  }
  FractionMatrix f;
  for (int i = 0; i < 3; ++i) f[i] = fractions(factor.row(i).transpose());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) s[i][j] = s[j][i] = dot(f[i], f[j]);
  return s;
}

Fractions RoundedHull::center(std::size_t part) const {
  return fractions(place) + fractions(parts[part].center) + parts[part].shift;
}

std::vector<std::uint32_t> RoundedHull::farthest(const Vector& n) const {
  constexpr double kRoundings = 64 * 0x1p-53;  // more than any sum below has
  int most = 0;
  for (const Integer& e : n)
    if (!e.is_zero()) most = std::max(most, exact::log2_floor(e));
  const Vector3d along = to_double(n, -most);
  std::vector<double> high(parts.size());
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const RoundPart& part = parts[i];
    const Vector3d middle = part.middle();
    const double size = part.center.cwiseAbs().sum() + middle.cwiseAbs().sum() +
                        3 * part.factor.cwiseAbs().sum() + 2 * part.margin;
    // The root of what an ellipsoid given by its shape rounds away.
    const double slack = (part.shape ? 0x1p-24 : kRoundings) * size * along.cwiseAbs().sum();
    const double value =
        along.dot(middle) + (part.factor.transpose() * along).norm() + part.margin * along.norm();
    high[i] = value + slack;
    best = std::max(best, value - slack);
  }
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < parts.size(); ++i)
    if (!(high[i] < best)) found.push_back(i);
  return found;
}

Rational RoundedHull::reach(const Vector& n) const {
  const Fractions along = in_fractions(n);
  const Rational length = dot(along, along);
  std::optional<Rational> most;
  for (const std::uint32_t i : farthest(n)) {
    Rational value = dot(along, center(i));
    if (!parts[i].is_point()) value += root_above(square(parts[i].exact_shape(), along));
    if (parts[i].margin > 0)
      value += root_above(length * Rational(parts[i].margin) * Rational(parts[i].margin));
    if (!most || value > *most) most = value;
  }
  return *most;
}

std::optional<Rational> RoundedHull::exact_reach(const Vector& n) const {
  const Fractions along = in_fractions(n);
  const auto length = root_of(dot(along, along));
  std::optional<Rational> most;
  for (const std::uint32_t i : farthest(n)) {
    const auto root = root_of(square(parts[i].exact_shape(), along));
    if (!root || (parts[i].margin > 0 && !length)) return std::nullopt;
    Rational value = dot(along, center(i)) + *root;
    if (parts[i].margin > 0) value += *length * Rational(parts[i].margin);
    if (!most || value > *most) most = value;
  }
  return most;
}

std::optional<RoundedHull> RoundedHull::face(const Vector& n, const Rational& reach,
                                             std::vector<std::uint32_t>& of) const {
  const Fractions along = in_fractions(n);
  const auto length = root_of(dot(along, along));
  RoundedHull found{place, {}};
  for (const std::uint32_t i : farthest(n)) {
    const RoundPart& part = parts[i];
    const FractionMatrix shape = part.exact_shape();
    const auto root = root_of(square(shape, along));
    if (!root || (part.margin > 0 && !length)) return std::nullopt;
    RoundPart flat{part.center, part.shift, part.factor, part.shape, 0};
    if (part.margin > 0) flat.shift = flat.shift + Rational(Rational(part.margin) / *length) * along;
    if (root->sign() > 0) {
      flat.shift = flat.shift + Rational(1 / *root) * image_of(shape, along);
      flat.factor.setZero();
      flat.shape.reset();
    }
    found.parts.push_back(flat);
    if (dot(along, found.center(found.parts.size() - 1)) < reach)
      found.parts.pop_back();
    else
      of.push_back(i);
  }
  if (found.parts.empty()) return std::nullopt;
  return found;
}

Fractions RoundedHull::point(const Mean& mean) const {
  Fractions x = mean.rest;
  for (const Share& share : mean.shares) {
    x = x + share.weight * center(share.part);
    if (!parts[share.part].is_point()) x = x + image_of(parts[share.part].exact_shape(), share.along);
  }
  return x;
}

bool RoundedHull::holds(const Mean& mean, bool within) const {
  const auto below = [within](const Rational& x, const Rational& y) { return within ? x < y : x <= y; };
  Rational sum = 0;
  for (const Share& share : mean.shares) {
    if (share.weight.sign() <= 0) return false;
    sum += share.weight;
    const RoundPart& part = parts[share.part];
    if (!part.is_point() && !below(square(part.exact_shape(), share.along), share.weight * share.weight))
      return false;
  }
  const Rational margin(parts.front().margin);
  return sum == 1 && (is_zero(mean.rest) || below(dot(mean.rest, mean.rest), margin * margin));
}

std::vector<Fractions> RoundedHull::directions(const Mean& mean) const {
  std::vector<Fractions> found;
  if (parts.front().margin > 0)
    for (int k = 0; k < 3; ++k) found.push_back(fractions(Vector3d::Unit(k)));
  for (const Share& share : mean.shares) {
    if (share.part != mean.shares.front().part)
      found.push_back(center(share.part) - center(mean.shares.front().part));
    if (parts[share.part].is_point()) continue;
    for (const Fractions& row : parts[share.part].exact_shape()) found.push_back(row);
  }
  return found;
}

bool span(const std::vector<Fractions>& vectors) {
  FractionMatrix sum{};
  for (const Fractions& v : vectors)
    for (int i = 0; i < 3; ++i) sum[i] = sum[i] + v[i] * v;
  const Rational det = sum[0][0] * (sum[1][1] * sum[2][2] - sum[1][2] * sum[2][1]) -
                       sum[0][1] * (sum[1][0] * sum[2][2] - sum[1][2] * sum[2][0]) +
                       sum[0][2] * (sum[1][0] * sum[2][1] - sum[1][1] * sum[2][0]);
  return det.sign() > 0;
}

void append(RoundedHull& hull, const Piece& piece) {
  if (piece.convex) {
    for (const auto& part : piece.convex->pieces())
      hull.parts.push_back({part.center, {}, part.factor, part.shape, piece.convex->margin()});
    return;
  }
  if (const Ellipsoid* body = piece.round()) {
    RoundPart part{body->center(), {}, body->factor(), {}, 0};
    if (!body->defined_by_factor()) part.shape = body->shape();
    hull.parts.push_back(part);
    return;
  }
  for (const Vector3d& x : piece.corners) hull.parts.push_back({x, {}, Eigen::Matrix3d::Zero(), {}, 0});
}

RoundedHull rounded_hull(const Piece& piece, const Vector3d& place) {
  RoundedHull hull{place, {}};
  append(hull, piece);
  return hull;
}

}  // namespace vericone::certificates
