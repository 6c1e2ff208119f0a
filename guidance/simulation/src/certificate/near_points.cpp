// SPDX-License-Identifier: BSD-3-Clause
//
// A piece is a core, the hull of points, ellipses and ellipsoids, and a margin about it. The nearest points
// of two cores are means of points that are farthest along some directions, so they are said by weights.
#include "certificate/near_points.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

#include "certificate/tube.h"
#include "proof/least_point.h"

namespace vericone::simulation::certified {
namespace {

using Eigen::Vector3d;

constexpr double kSpare = 1e-9;           // of sizes and places: some 10^5 roundings
constexpr double kWithin = 1 - 1e-9;      // of what rounding must not carry out of a body
constexpr std::int64_t kUnits = 1 << 30;  // of weights, so that they have the sum 1
constexpr std::size_t kMostPairs = 4'000'000;

std::string listed(const Vector3d& v) {
  return "[" + text_of(v.x()) + ", " + text_of(v.y()) + ", " + text_of(v.z()) + "]";
}

/// What a mean takes of a corner or a part.
struct Share {
  double weight = 0;
  Vector3d along = Vector3d::Zero();  // m of S m, m.S m <= weight^2
};

class OnePiece {
 public:
  OnePiece(const Solid& solid, std::uint32_t number) : solid_(&solid), number_(number) {
    if (!solid.rounds.empty()) {
      const Ellipsoid& body = solid.rounds[number].ellipsoid();
      shape_ = body.shape();
    }
  }

  [[nodiscard]] bool by_weights() const {
    return solid_->cornered() ? !is_box() && !is_ball() : !solid_->convexes.empty();
  }
  [[nodiscard]] double margin() const {
    return solid_->convexes.empty() ? solid_->radius : solid_->convexes[number_].margin();
  }
  /// Of its core: a point farthest along n, and which corner or part it is of.
  [[nodiscard]] std::pair<std::uint32_t, Vector3d> farthest(const Vector3d& n) const {
    if (!solid_->rounds.empty()) {
      const Vector3d along = shape_ * n;
      return {0, solid_->rounds[number_].ellipsoid().center() + along / std::sqrt(n.dot(along))};
    }
    if (is_box()) {
      const Box& box = solid_->boxes[number_];
      return {0, (n.array() > 0).select(box.high, box.low)};
    }
    std::pair<std::uint32_t, Vector3d> best{0, Vector3d::Zero()};
    double most = -std::numeric_limits<double>::infinity();
    const auto consider = [&](std::uint32_t i, const Vector3d& x) {
      if (const double value = n.dot(x); value > most) {
        most = value;
        best = {i, x};
      }
    };
    if (solid_->convexes.empty()) {
      const auto& corners = solid_->pieces[number_];
      for (std::uint32_t i = 0; i < corners.size(); ++i) consider(i, solid_->points[corners[i]]);
    } else {
      const auto& parts = solid_->convexes[number_].pieces();
      for (std::uint32_t i = 0; i < parts.size(); ++i) consider(i, parts[i].center + image(i, along(i, n)));
    }
    return best;
  }
  /// m of part i for its farthest point along n, a little within.
  [[nodiscard]] Vector3d along(std::uint32_t i, const Vector3d& n) const {
    if (solid_->convexes.empty()) return Vector3d::Zero();
    const double square = n.dot(image(i, n));
    return square > 0 ? Vector3d(kWithin / std::sqrt(square) * n) : Vector3d::Zero();
  }
  [[nodiscard]] Vector3d mean(const std::map<std::uint32_t, Share>& shares) const {
    Vector3d x = Vector3d::Zero();
    for (const auto& [i, share] : shares)
      x += share.weight * (solid_->convexes.empty() ? solid_->points[solid_->pieces[number_][i]]
                                                    : solid_->convexes[number_].pieces()[i].center) +
           image(i, share.along);
    return x;
  }
  /// Of a round body or a box: a little within.
  [[nodiscard]] Vector3d within(const Vector3d& x) const {
    const Vector3d middle = is_box()    ? solid_->boxes[number_].center()
                            : is_ball() ? solid_->points[solid_->pieces[number_][0]]
                                        : solid_->rounds[number_].ellipsoid().center();
    return middle + (1 - 1e-7) * (x - middle);
  }
  /// Of a box or an ellipsoid: rho, where x +- 2 rho e_i are in it; not above 0 outside.
  [[nodiscard]] double depth(const Vector3d& x) const {
    if (is_box()) {
      const Box& box = solid_->boxes[number_];
      return 0.499 * std::min((x - box.low).minCoeff(), (box.high - x).minCoeff());
    }
    if (solid_->rounds.empty()) return 0;
    const Eigen::Matrix3d inverse = shape_.inverse();
    const Vector3d y = x - solid_->rounds[number_].ellipsoid().center();
    return 0.999 * (1 - std::sqrt(y.dot(inverse * y))) / (2 * std::sqrt(inverse.diagonal().maxCoeff()));
  }
  [[nodiscard]] bool is_box() const { return !solid_->boxes.empty(); }
  [[nodiscard]] bool is_ball() const { return solid_->kind == Solid::Kind::cloud; }
  [[nodiscard]] bool only() const { return solid_->size() == 1; }
  [[nodiscard]] std::uint32_t number() const { return number_; }

 private:
  [[nodiscard]] Vector3d image(std::uint32_t i, const Vector3d& m) const {
    if (solid_->convexes.empty()) return Vector3d::Zero();
    const vericone::Convex::Piece& part = solid_->convexes[number_].pieces()[i];
    return part.shape ? Vector3d(*part.shape * m) : Vector3d(part.factor * (part.factor.transpose() * m));
  }

  const Solid* solid_;
  std::uint32_t number_;
  Eigen::Matrix3d shape_;
};

/// A point of a piece that stands somewhere, and what says that it is one.
struct Said {
  Vector3d core, x;  // of the core; of the piece
  double depth = 0;  // m
  std::map<std::uint32_t, Share> weights;
};

/// Weights that are whole numbers of units.
std::map<std::uint32_t, Share> rounded(const std::map<std::uint32_t, Share>& shares) {
  std::map<std::uint32_t, Share> found;
  std::int64_t left = kUnits;
  auto most = shares.begin();
  for (auto it = shares.begin(); it != shares.end(); ++it)
    if (it->second.weight > most->second.weight) most = it;
  for (const auto& [i, share] : shares) {
    const std::int64_t units = std::llround(share.weight * kUnits);
    if (units <= 0 || i == most->first) continue;
    left -= units;
    const double weight = static_cast<double>(units) / kUnits;
    found[i] = {weight, weight / share.weight * share.along};
  }
  const double weight = static_cast<double>(left) / kUnits;
  found[most->first] = {weight, weight / most->second.weight * most->second.along};
  return found;
}

Said said(const OnePiece& piece, const Placement& at, const std::vector<MeanPart>& made_of, double sign) {
  Said found;
  std::map<std::uint32_t, Share> shares;
  Vector3d own = Vector3d::Zero();
  for (const auto& [direction, weight] : made_of) {
    const Vector3d n = at.rotation.transpose() * (sign * direction);
    const auto [i, x] = piece.farthest(n);
    own += weight * x;
    shares[i].weight += weight;
    shares[i].along += weight * piece.along(i, n);
  }
  if (piece.by_weights()) {
    found.weights = rounded(shares);
    own = piece.mean(found.weights);
  } else if (!piece.is_ball()) {
    own = piece.within(own);
  }
  found.core = found.x = at.position + at.rotation * own;
  return found;
}

std::string point_of(const std::string& who, const OnePiece& piece, const Said& its) {
  std::string text;
  if (!piece.only()) text += ", \"" + who + "_piece\": " + std::to_string(piece.number());
  if (piece.by_weights()) {
    text += ", \"" + who + "_weights\": [";
    const char* between = "[";
    for (const auto& [i, share] : its.weights) {
      text += between + std::to_string(i) + ", " + text_of(share.weight);
      if (!share.along.isZero(0)) text += ", " + listed(share.along);
      text += "]";
      between = ", [";
    }
    text += "]";
  }
  if (!piece.by_weights() || piece.margin() > 0) text += ", \"" + who + "_point\": " + listed(its.x);
  if (its.depth > 0) text += ", \"" + who + "_depth\": " + text_of(its.depth);
  return text;
}

/// The nearest points of two pieces; none nearer than `best`: nothing.
std::optional<NearPoints> between(const PairQuestion& question, const OnePiece& a, const OnePiece& b,
                                  const Placement& at_a, const Placement& at_b, double t) {
  const auto farthest = [&](const Vector3d& d) -> Vector3d {
    return at_b.position + at_b.rotation * b.farthest(at_b.rotation.transpose() * d).second - at_a.position -
           at_a.rotation * a.farthest(at_a.rotation.transpose() * -d).second;
  };
  std::vector<MeanPart> made_of;
  const Vector3d start = at_b.position - at_a.position;
  least_point(farthest, start.isZero(0) ? Vector3d(Vector3d::UnitX()) : start, &made_of);
  Said of_a = said(a, at_a, made_of, -1), of_b = said(b, at_b, made_of, 1);
  const Vector3d way = of_b.core - of_a.core;
  const double distance = way.norm(), margin_a = a.margin(), margin_b = b.margin(),
               both = margin_a + margin_b;
  const Vector3d along = distance > 0 ? Vector3d(way / distance) : Vector3d::Zero();
  // What remains of the margins beyond the points; more than is needed where the bodies overlap.
  const double share = both > 0 ? std::min(1.0, distance / both) * kWithin : 0;
  of_a.x += share * margin_a * along;
  of_b.x -= share * margin_b * along;
  of_a.depth = std::max(0.0, kWithin * kWithin * margin_a - share * margin_a);
  of_b.depth = std::max(0.0, kWithin * kWithin * margin_b - share * margin_b);
  for (const auto& [piece, at, its] : {std::tuple{&a, &at_a, &of_a}, std::tuple{&b, &at_b, &of_b}})
    if (piece->is_ball())
      its->depth *= 0.499;  // x +- twice that along each axis
    else if (!piece->by_weights())
      its->depth = std::max(0.0, piece->depth(at->rotation.transpose() * (its->x - at->position)));
  NearPoints found;
  found.room = question.by - question.track_a.radius - question.track_b.radius + of_a.depth + of_b.depth -
               (of_a.x - of_b.x).norm() - kSpare * (1 + of_a.x.norm() + of_b.x.norm());
  found.proof = R"({"rule": "point", "time": )" + text_of(t) + point_of("agent", a, of_a) +
                point_of("obstacle", b, of_b) + "}";
  return found;
}

/// Boxes of the pieces in the world.
std::vector<Box> boxes_of(const Solid& solid, const Placement& at) {
  std::vector<Box> boxes;
  for (std::uint32_t k = 0; k < solid.size(); ++k) {
    const Box own = solid.bounds(k);
    const Vector3d middle = at.position + at.rotation * own.center(),
                   half = at.rotation.cwiseAbs() * (0.5 * (own.high - own.low));
    boxes.push_back({middle - half, middle + half});
  }
  return boxes;
}

double distance(const Box& a, const Box& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0).norm();
}

}  // namespace

std::optional<NearPoints> near_points(const PairQuestion& question, double t) {
  if (question.dents || question.a.size() > kMostPairs / question.b.size()) return std::nullopt;
  const Placement at_a = placement_at(question.track_a, t), at_b = placement_at(question.track_b, t);
  const std::vector<Box> of_a = boxes_of(question.a, at_a), of_b = boxes_of(question.b, at_b);
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = 0; i < of_a.size(); ++i)
    for (std::uint32_t j = 0; j < of_b.size(); ++j) pairs.emplace_back(distance(of_a[i], of_b[j]), i, j);
  const auto later = [](const auto& x, const auto& y) { return x > y; };
  std::make_heap(pairs.begin(), pairs.end(), later);
  constexpr int kMostLooks = 200;
  std::optional<NearPoints> best;
  const double spare = question.by - question.track_a.radius - question.track_b.radius;
  for (int looks = 0; !pairs.empty() && looks < kMostLooks; ++looks) {
    const auto [least, i, j] = pairs.front();
    if (best && spare - least < best->room) break;
    auto now = between(question, OnePiece(question.a, i), OnePiece(question.b, j), at_a, at_b, t);
    if (now && (!best || now->room > best->room)) best = std::move(now);
    std::pop_heap(pairs.begin(), pairs.end(), later);
    pairs.pop_back();
  }
  return best;
}

}  // namespace vericone::simulation::certified
